"""The text that `--help` prints, from the declarations of the commands and their options."""

import sys
from collections.abc import Iterable, Sequence
from textwrap import wrap

from ..answers.questions import QUESTIONS
from ..text import columns, fitting
from .commands import COMMANDS, Option, flags_of

TITLE = "Adhesive contact of two elastic spheres: pull-off, rolling, chains, vibrations."
LISTS = "Lists (1nm,1um) and ranges (1nm:1um:50, or 1nm:1um:50:lin for equal steps) give one row each."
MAX_WIDTH = 98
MIN_WIDTH = 48
MIN_TEXT = 20


def help_of(name: str | None) -> str:
    """Return the help of a command, or of the program: usage, meaning, options, an example; as stdout can encode it."""
    width = max(MIN_WIDTH, min(MAX_WIDTH, columns() - 2))
    options = tuple(dict.fromkeys(flags_of(name).values()))
    listed = [_listed("Options", _rows(option for option in options if not option.hidden), width)]
    if more := _rows(option for option in options if option.hidden):
        listed.append(_listed("More options", more, width))
    if name is None:
        usage, sentence, example = "[OPTIONS] COMMAND [ARGS]...", TITLE, "report quartz 100nm"
        for section in dict.fromkeys(command.section for command in COMMANDS.values()):
            rows = [(one.name, one.sentence) for one in COMMANDS.values() if one.section == section]
            listed.append(_listed(section, rows, width))
    else:
        command = COMMANDS[name]
        usage, sentence = f"{name} [OPTIONS] {command.words.metavar}".rstrip(), command.sentence
        example = f"{name} {command.example}"
    parts = [
        _wrapped(f"Usage: jkroll {usage}", width),
        _wrapped(sentence, width, "  "),
        *listed,
        *([_wrapped(LISTS, width, "  ")] if name in QUESTIONS else []),
        _wrapped(f"Example: jkroll {example}", width, "  "),
    ]
    return fitting("\n\n".join("\n".join(lines) for lines in parts), sys.stdout)


def _rows(options: Iterable[Option]) -> list[tuple[str, str]]:
    """Return options as they are typed, those with one text together, and the text."""
    rows: dict[str, list[str]] = {}
    for option in options:
        typed = f"{', '.join(reversed(option.flags))} {option.metavar}".rstrip()
        rows.setdefault(option.sentence(), []).append(typed)
    return [(", ".join(flags), text) for text, flags in rows.items()]


def _listed(title: str, rows: Sequence[tuple[str, str]], width: int) -> list[str]:
    """Return rows in two columns below a title."""
    left = max(len(name) for name, _ in rows) + 4
    lines = [f"{title}:"]
    for name, text in rows:
        first, *rest = _wrapped(text, max(width, left + MIN_TEXT), " " * left)
        lines += [f"  {name}".ljust(left) + first[left:], *rest]
    return lines


def _wrapped(text: str, width: int, indent: str = "") -> list[str]:
    """Return the lines of a text, broken at spaces only."""
    return wrap(
        text,
        width,
        initial_indent=indent,
        subsequent_indent=indent,
        break_long_words=False,
        break_on_hyphens=False,
    )
