"""What `--help` prints, from the declarations of the commands and their options."""

import sys
from collections.abc import Iterable, Sequence

from ..answers.questions import COMMANDS
from ..text import columns, fitting
from .options import EXTRAS, Option, flags_of, sentence_of, sentences

TITLE = "Adhesive contact of two elastic spheres: pull-off, rolling, chains, vibrations."
LISTS = "Lists (1nm,1um) and ranges (1nm:1um:50, or :50:lin) give a row each."
MAX_WIDTH = 98
MIN_WIDTH = 48
MIN_TEXT = 20


def help_of(name: str | None) -> str:
    """The help of a command, or of the program: usage, what it does, its options, an example; as the stream can write it."""
    width = max(MIN_WIDTH, min(MAX_WIDTH, columns() - 2))
    if name is None:
        usage, sentence, ends = "[OPTIONS] COMMAND [ARGS]...", TITLE, ["Example: jkroll report quartz 100nm"]
    elif name in COMMANDS:
        command = COMMANDS[name]
        usage, sentence = f"{name} [OPTIONS] [MATERIAL] [RADIUS]...", command.sentence
        ends = [LISTS, f"Example: jkroll {name} {command.example}"]
    else:
        extra = EXTRAS[name]
        usage, sentence = f"{name} [OPTIONS] {extra.argument}".rstrip(), extra.sentence
        ends = [f"Example: jkroll {name} {extra.example}"]
    options = dict.fromkeys(flags_of(name).values())
    parts = [
        _wrapped(f"Usage: jkroll {usage}", width),
        _wrapped(sentence, width, "  "),
        _listed("Options", _rows(options), width),
        *([_listed("Commands", list(sentences().items()), width)] if name is None else []),
        *(_wrapped(end, width, "  ") for end in ends),
    ]
    return fitting("\n\n".join("\n".join(lines) for lines in parts), sys.stdout)


def _rows(options: Iterable[Option]) -> list[tuple[str, str]]:
    """Options as they are typed, those of one meaning together, and what they mean."""
    rows: dict[str, list[str]] = {}
    for option in options:
        if not option.hidden:
            rows.setdefault(sentence_of(option), []).append(
                f"{', '.join(reversed(option.flags))} {option.metavar}".rstrip()
            )
    return [(", ".join(flags), text) for text, flags in rows.items()]


def _listed(title: str, rows: Sequence[tuple[str, str]], width: int) -> list[str]:
    """Rows below a title, in two columns."""
    left = max(len(name) for name, _ in rows) + 4
    lines = [f"{title}:"]
    for name, text in rows:
        first, *rest = _wrapped(text, max(width, left + MIN_TEXT), " " * left)
        lines += [f"  {name}".ljust(left) + first[left:], *rest]
    return lines


def _wrapped(text: str, width: int, indent: str = "") -> list[str]:
    """A text in lines that end between words."""
    lines = [""]
    for word in text.split():
        if lines[-1] and len(indent) + len(lines[-1]) + 1 + len(word) > width:
            lines.append("")
        lines[-1] += f" {word}" if lines[-1] else word
    return [indent + line for line in lines]
