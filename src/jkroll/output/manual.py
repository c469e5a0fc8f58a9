"""The manual: pages of Markdown, set by rich on a terminal, and as they are in a pipe."""

import os
import re
from collections.abc import Iterator, Mapping
from typing import ClassVar, NamedTuple, TextIO

from ..text import fitting, say, terminal_width

_FOLDER = os.path.join(os.path.dirname(os.path.dirname(os.path.abspath(__file__))), "guide")
_ENDING = ".md"

# Words of the field by which a section is sought, besides those of its heading.
FIELD_TERMS: Mapping[tuple[str, str], str] = {
    ("dem", "Other programs, and damping"): "dissipation viscous coefficient of restitution",
    ("dem", "What other codes call γ"): "cohesion energy density",
    ("energies", "Energies by convention"): "E_break E_roll stickiness sticking bouncing coefficient of restitution",
    ("measurements", "Rough and humid"): (
        "roughness asperities capillary meniscus humidity moisture water liquid wetting contact angle"
    ),
    ("models", "Between JKR and DMT"): "tabor parameter maugis law",
    ("tables", "Sweeps"): "mixture of sizes pairs and a wall lists ranges",
    ("validation", "Measurements"): "stickiness sticking bouncing coefficient of restitution",
}


MAX_TEXT = 100  # columns of running text
HISTORY = "changes"  # the page of what was, which is found where no other is


class Section(NamedTuple):
    """A section of a page: what stands under a heading of the second rank, or before the first of them."""

    page: str
    heading: str
    text: str  # Markdown, with the heading

    @property
    def title(self) -> str:
        """The words by which it is sought: page, heading and the terms of the field."""
        return f"{self.page} {self.heading} {FIELD_TERMS.get((self.page, self.heading), '')}"

    @property
    def prose(self) -> str:
        """The text without what programs print."""
        return re.sub(r"^```.*?^```", "", self.text, flags=re.DOTALL | re.MULTILINE)


def topics() -> tuple[str, ...]:
    """Return the topics of the manual."""
    names = sorted(os.listdir(_FOLDER))
    return tuple(name.removesuffix(_ENDING) for name in names if name.endswith(_ENDING))


def page(topic: str) -> str:
    """Return the page of a topic as Markdown."""
    with open(os.path.join(_FOLDER, topic + _ENDING), encoding="utf-8") as file:
        return file.read()


def sections() -> list[Section]:
    """Return the sections of all pages."""
    pieces = ((topic, piece) for topic in topics() for piece in re.split(r"^(?=## )", page(topic), flags=re.MULTILINE))
    return [Section(topic, piece.partition("\n")[0].lstrip("# "), piece) for topic, piece in pieces]


def write_text(text: str, out: TextIO) -> None:
    """Write Markdown: in a pipe as it is, on a terminal in lines that are comfortable to read."""
    if not out.isatty():
        out.write(fitting(text, out))
        return
    from rich.console import Console
    from rich.markdown import CodeBlock, Markdown
    from rich.text import Text

    class Lines(CodeBlock):
        """A code block whose lines are left as they are, for the terminal to break where they are too long."""

        def __rich_console__(self, *_: object) -> Iterator[Text]:
            yield Text(str(self.text).rstrip(), style="cyan", no_wrap=True, overflow="ignore")

    class Page(Markdown):
        elements: ClassVar = {**Markdown.elements, "fence": Lines, "code_block": Lines}

    width = min(terminal_width(), MAX_TEXT)
    console = Console(file=out, width=width, highlight=False, markup=False, emoji=False)
    console.print(Page(fitting(text, out), hyperlinks=False), crop=False, soft_wrap=False)


def write_topics(out: TextIO) -> None:
    """Write the topics, each with the title of its page."""
    names = topics()
    width = max(map(len, names))
    for topic in names:
        title = page(topic).partition("\n")[0].removeprefix("# ")
        say(f"{topic:{width}}  {title}", out)
