"""Markdown on a terminal, set by rich: running text in lines of the width, what a program prints in its own lines."""

from typing import ClassVar, TextIO

from rich.console import Console, ConsoleOptions, RenderResult
from rich.markdown import CodeBlock, Markdown
from rich.text import Text

from ..text import fitting, terminal_width

MAX_TEXT = 100  # columns of running text


class _Lines(CodeBlock):
    """A code block whose lines are left as they are, for the terminal to break where they are too long."""

    def __rich_console__(self, console: Console, options: ConsoleOptions) -> RenderResult:
        """Return the lines."""
        yield Text(str(self.text).rstrip(), style="cyan", no_wrap=True, overflow="ignore")


class _Page(Markdown):
    elements: ClassVar = {**Markdown.elements, "fence": _Lines, "code_block": _Lines}


def write_markdown(text: str, out: TextIO) -> None:
    """Write Markdown, in lines that are comfortable to read."""
    width = min(terminal_width(), MAX_TEXT)
    console = Console(file=out, width=width, highlight=False, markup=False, emoji=False)
    console.print(_Page(fitting(text, out), hyperlinks=False), crop=False, soft_wrap=False)
