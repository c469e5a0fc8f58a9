"""The help: of the program by what is to be done, and of a command in groups of options, each on a screen."""

import re
from collections.abc import Iterable, Sequence

from ..answers.questions import QUESTIONS
from ..quantities.nomenclature import NOMENCLATURE, OF_THE_PAIR
from ..text import terminal_width, wrapped
from .commands import COMMANDS, HELP, JOBS, OTHERS, PROGRAM, Option

TITLE = "Two elastic spheres touch and stick: forces, rolling, vibrations, doubts."
EXAMPLES = (
    ("jkroll pull-off quartz 100nm", "two equal spheres"),
    ("jkroll pull-off quartz 2um --radius2 plane", "a sphere on a plane"),
    ("jkroll pull-off quartz,iron 10nm,1um", "a row for each pair"),
    ("jkroll pull-off 100nm --gamma 30mJ/m2", "your own solid"),
)
LISTS = "Lists 1nm,1um and ranges 1nm:1um:50 (with :lin equal steps) give a row each."
MAX_WIDTH = 98
MIN_WIDTH = 48
MIN_TEXT = 20
GUTTER = 10  # of the names of groups

_WITH_THE_PAIR = "material material2 work_of_adhesion monomers contacts filling_factor asperity_radius"

Row = tuple[str, str]  # what is typed, and its meaning


def help_of(name: str | None) -> str:
    """Return the help of a command, or of the program."""
    width = max(MIN_WIDTH, min(MAX_WIDTH, terminal_width() - 2))
    return "\n".join(_of_command(name, width) if name else _of_program(width))


def _of_program(width: int) -> list[str]:
    """Return the lines of the help of the program: examples, and the commands by what is to be done."""
    lines = [
        *wrapped("Usage: jkroll COMMAND [MATERIAL] [RADIUS]... [OPTIONS]", width),
        *_indented(TITLE, width, 2),
        *_listed("", EXAMPLES, width),
        "",
    ]
    for job in JOBS:
        rows = [(command.name, command.sentence) for command in COMMANDS.values() if command.job == job]
        lines += _listed(job, [(", ".join(name for name, _ in rows), "")] if job == OTHERS else rows, width)
    return [*lines, *_listed("Options", [(", ".join(option.flag for option in PROGRAM), "")], width)]


def _of_command(name: str, width: int) -> list[str]:
    """Return the lines of the help of a command: usage, meaning, groups of options, an example."""
    command = COMMANDS[name]
    options = (*command.options(), HELP)
    lines = [*wrapped(f"Usage: jkroll {name} {command.words} [OPTIONS]".replace("  ", " "), width)]
    lines += [*_indented(command.sentence, width, 2), ""]
    for group in dict.fromkeys(map(_group, options)):
        lines += _listed(group, _rows([option for option in options if _group(option) == group]), width)
    lines.append("")
    if name in QUESTIONS:
        lines += _indented(LISTS, width, 2)
    return [*lines, *_indented(f"Example: jkroll {name} {command.example}".rstrip(), width, 2)]


def _group(option: Option) -> str:
    """Return the group in which an option stands."""
    quantity = NOMENCLATURE.get(option.name)
    if quantity is None:
        return option.group
    return "Pair" if quantity.sphere or option.name in (*OF_THE_PAIR, *_WITH_THE_PAIR.split()) else "Assumed"


def _rows(options: Iterable[Option]) -> list[Row]:
    """Return options as they are typed, those with one text together, and the text; last hidden ones, without a text.

    An option that the text of another one names has no row.
    """
    rows: dict[str, list[str]] = {}
    for option in options:
        if not option.hidden:
            typed = f"{', '.join(reversed(option.flags))} {option.metavar}".rstrip()
            rows.setdefault(option.sentence(), []).append(typed)
    named = {*re.findall(r"--?[a-z][a-z0-9-]*", " ".join(rows))}
    shown = [
        (", ".join(own), text)
        for text, flags in rows.items()
        if (own := [flag for flag in flags if flag.split()[0] not in named])
    ]
    further = [option.flag for option in options if option.hidden and option.flag not in named]
    return [*shown, *([(", ".join(further), "")] if further else [])]


def _listed(title: str, rows: Sequence[Row], width: int) -> list[str]:
    """Return rows in two columns behind a title; a row without a meaning goes over both."""
    left = GUTTER + max((len(typed) for typed, meaning in rows if meaning), default=0) + 2
    lines = []
    for typed, meaning in rows:
        if meaning:
            first, *rest = _indented(meaning, max(width, left + MIN_TEXT), left)
            lines += [" " * GUTTER + typed.ljust(left - GUTTER) + first[left:], *rest]
        else:
            lines += _indented(typed, width, GUTTER)
    return [title.ljust(GUTTER) + lines[0][GUTTER:], *lines[1:]]


def _indented(text: str, width: int, indent: int) -> list[str]:
    """Return the lines of a text, each behind an indent."""
    return [" " * indent + line for line in wrapped(text, width - indent)]
