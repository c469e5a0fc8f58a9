"""A plain line answered on TAB without typer: what the shell asks in its environment, the candidates, and the shell's own form.

The shells ask as typer's completion scripts make them; whatever is not plain (quotes, mistakes) is left to typer.
"""

import sys
from collections.abc import Callable, Iterable, Mapping, Sequence
from functools import partial
from typing import NamedTuple

from ..answers.questions import COMMANDS
from ..errors import JkrollError
from ..text import say
from .completion import ARGUMENTS, complete_option, complete_words
from .options import EXTRAS, Option, flags_of, room_for_words, sentence_of, sentences
from .reader import read_quickly

NOT_PLAIN = "'\"\\\t\r\n"
FILES = 1  # exit code by which fish is told to offer files


class NotFromBash(JkrollError):
    """A request as bash makes it, without what bash says with it."""

    def __str__(self) -> str:
        return "_JKROLL_COMPLETE=complete_bash is for bash: it sets COMP_WORDS, and COMP_CWORD to a number"


class Candidate(NamedTuple):
    """A word that could stand there, and what it means."""

    word: str
    meaning: str = ""


def quick_answer(environment: Mapping[str, str]) -> Callable[[], int] | None:
    """The call that prints what a shell asks for; None for a line that is not plain."""
    action, _, shell = environment.get("_JKROLL_COMPLETE", "").partition("_")
    asked = _asked(shell, environment) if action == "complete" else None
    found = None if asked is None else candidates(*asked)
    if asked is None or found is None:
        return None
    flag, has_value, _ = asked[1].partition("=")
    if has_value and shell != "bash":  # what bash completes begins behind the =, elsewhere it is the whole word
        found = [Candidate(f"{flag}={word}", meaning) for word, meaning in found]
    return partial(_answer, shell, found, environment.get("_TYPER_COMPLETE_FISH_ACTION", ""))


def _asked(shell: str, environment: Mapping[str, str]) -> tuple[list[str], str] | None:
    """The words before the one to be completed, without the program, and that one."""
    line = environment.get("COMP_WORDS" if shell == "bash" else "_TYPER_COMPLETE_ARGS", "")
    place = environment.get("COMP_CWORD", "")
    if shell == "bash":
        if "COMP_WORDS" not in environment or not _is_whole(place):
            raise NotFromBash
        line = line.replace("\n", " ")  # typer's script joins the words by line ends
    if any(character in NOT_PLAIN for character in line):
        return None
    words = line.split(" ")
    if shell in ("zsh", "fish") and len(words) > 1:
        return [word for word in words[1:-1] if word], words[-1]
    if shell == "bash" and place.isascii() and place.isdigit() and len(place) < 6 and 1 <= int(place) <= len(words):
        words = [word for word in words if word]
        return words[1 : int(place)], "".join(words[int(place) : int(place) + 1])
    return None


def _is_whole(text: str) -> bool:
    """Whether typer would make a number of a text."""
    try:
        int(text)
    except ValueError:
        return False
    return True


def candidates(words: Sequence[str], begun: str) -> list[Candidate] | None:
    """What can stand where a word was begun behind others; None where that is not plain."""
    if not words:
        return _flags(flags_of(None).items(), begun) if begun.startswith("-") else _commands(begun)
    name, *rest = words
    return _behind(name, rest, begun) if name in COMMANDS or name in EXTRAS else None


def _behind(name: str, rest: list[str], begun: str) -> list[Candidate] | None:
    """What can stand behind a command and other words."""
    flags = flags_of(name)
    pending = flags.get(rest[-1]) if rest else None
    if begun.startswith("-") and "=" in begun:
        flag, _, begun = begun.partition("=")
        pending = flags.get(flag)
        if pending is None or pending.kind is bool:
            return None
    elif pending is not None and pending.kind is not bool:
        rest = rest[:-1]
    else:
        pending = None
    read = read_quickly(rest, flags)
    if read is None or "help" in read[1] or "=" in (begun, *rest):
        return None
    if begun.startswith("-"):
        taken = read[1]
        return _flags(((flag, option) for flag, option in flags.items() if option.name not in taken), begun)
    if pending is not None:
        return _values(pending, begun)
    complete = ARGUMENTS.get(name, complete_words)
    return _fitting(complete(begun), begun) if len(read[0]) < room_for_words(name) else []


def _commands(begun: str) -> list[Candidate]:
    return [Candidate(name, sentence) for name, sentence in sentences().items() if name.startswith(begun)]


def _flags(flags: Iterable[tuple[str, Option]], begun: str) -> list[Candidate]:
    return [
        Candidate(flag, sentence_of(option)) for flag, option in flags if flag.startswith(begun) and not option.hidden
    ]


def _values(option: Option, begun: str) -> list[Candidate]:
    complete = complete_option(option.name)
    return _fitting(complete(begun) if complete else [], begun)


def _fitting(words: Iterable[str], begun: str) -> list[Candidate]:
    return [Candidate(word) for word in words if word.startswith(begun)]


def _answer(shell: str, found: Sequence[Candidate], fish_action: str) -> int:
    """Print candidates as a shell wants them; return the exit code."""
    if shell == "fish" and fish_action != "get-args":
        return 0 if found else FILES
    say(_WRITERS[shell](found), sys.stdout)
    return 0


def _for_bash(found: Sequence[Candidate]) -> str:
    return "\n".join(word for word, _ in found)


def _for_fish(found: Sequence[Candidate]) -> str:
    return "\n".join(f"{word}\t{meaning}" if meaning else word for word, meaning in found)


def _for_zsh(found: Sequence[Candidate]) -> str:
    items = "\n".join(":".join(f'"{_escaped(text)}"' for text in candidate if text) for candidate in found)
    return f"_arguments '*: :(({items}))'" if found else "_files"


def _escaped(text: str) -> str:
    return text.translate(_ESCAPES)


_ESCAPES = str.maketrans({'"': '""', "'": "''", "$": "\\$", "`": "\\`", ":": "\\\\:"})
_WRITERS = {"bash": _for_bash, "zsh": _for_zsh, "fish": _for_fish}
