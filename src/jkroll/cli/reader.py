"""Reader of plain command lines: a command, its words, and its options spelled in full.

It exists because importing typer doubles the time of a call. Everything that is not plain (mistakes, options written
together) is left to typer, which understands plain lines in the same way.
"""

import sys
from collections.abc import Mapping, Sequence
from functools import partial

from ..text import say
from .commands import COMMANDS, Action
from .options import Option


def plain_action(words: Sequence[str]) -> Action | None:
    """Return what plain words ask for; None for words that are not plain."""
    name, *rest = words
    if name not in COMMANDS:
        return _PROGRAM.get(name) if not rest else None
    command = COMMANDS[name]
    read = _read(rest, command.flags(), files=command.words.are_files)
    if read is None:
        return None
    arguments, given = read
    if "help" in given:
        return partial(_print_help, name)
    return command.action(arguments, given) if len(arguments) <= command.words.most else None


def _print_help(name: str | None) -> int:
    """Print the help of a command, or of the program."""
    from .help import help_of

    say(help_of(name), sys.stdout)
    return 0


def print_version() -> int:
    """Print the version."""
    from .. import __version__

    say(f"jkroll {__version__}", sys.stdout)
    return 0


_PROGRAM: Mapping[str, Action] = {
    "--help": partial(_print_help, None),
    "-h": partial(_print_help, None),
    "--version": print_version,
}


def _read(
    words: Sequence[str], flags: Mapping[str, Option], *, files: bool
) -> tuple[list[str], dict[str, str | bool]] | None:
    """Return the words without the options, and the texts of the options by name; None for words that are not plain.

    A value that begins with a hyphen and a digit is read where an option takes one, or where a word is a file.
    """
    arguments: list[str] = []
    given: dict[str, str | bool] = {}
    rest = iter(words)
    for word in rest:
        if _is_word(word) or (files and _is_negative(word)):
            arguments.append(word)
            continue
        flag, has_value, text = word.partition("=")
        option = flags.get(flag)
        if option is None or (option.name in given and option.kind is not bool):
            return None
        if option.kind is bool:
            if has_value:
                return None
            given[option.name] = True
            continue
        if has_value and not flag.startswith("--"):
            return None
        value = text if has_value else next(rest, "--")
        if not _is_word(value) and not _is_negative(value):
            return None
        given[option.name] = value
    return arguments, given


def _is_word(text: str) -> bool:
    """Return whether a text cannot be taken for an option; a single hyphen is standard input or output."""
    return text == "-" or not text.startswith("-")


def _is_negative(text: str) -> bool:
    """Return whether a text begins as a negative value does."""
    return len(text) > 1 and text[0] == "-" and text[1] in "0123456789."
