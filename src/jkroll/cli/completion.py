"""Completion on TAB: what may stand in place of a begun word, written as the shell reads it.

The scripts are typer's, which `--install-completion` installs. They pass what was typed in variables of the environment
and stay where they are when typer changes. A key is answered without typer, whose import takes longer than an answer.
"""

import os
import shlex
import sys
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence, Set
from typing import Any

from ..errors import FAILED, JkrollError
from ..quantities.laws import MODELS, PROFILES
from ..quantities.nomenclature import NOMENCLATURE
from ..quantities.quantity import ANY
from ..text import say
from .commands import COMMANDS, Command, flags_of
from .options import Option
from .process import finished, flag_and_value

SHELLS = ("bash", "zsh", "fish", "powershell", "pwsh")

Candidate = tuple[str, str]  # a word, and what it means where a shell shows that


def is_asked_by(instruction: str) -> bool:
    """Return whether a script asks for candidates, as in complete_bash, and not for a script."""
    action, _, shell = instruction.partition("_")
    return action == "complete" and shell in SHELLS


def main() -> int:
    """Write the candidates for the shell that asks; return the exit code."""
    return finished(_write)


def _write() -> int:
    shell = os.environ["_JKROLL_COMPLETE"].partition("_")[2]
    found = list(candidates(*_typed(shell)))
    if shell == "fish" and os.environ.get("_TYPER_COMPLETE_FISH_ACTION") == "is-args":
        return 0 if found else FAILED  # fish offers files then
    say(_written(shell, found), sys.stdout)
    return 0


# --- What was typed, and what a shell reads ---------------------------------------------------------------------------


def _typed(shell: str) -> tuple[list[str], str]:
    """Return the words behind the name of the program, and the one that is begun, which may be empty."""
    if shell == "bash":
        words, position = _divided(os.environ.get("COMP_WORDS", "")), int(os.environ.get("COMP_CWORD", "0"))
        return words[1:position], (words[position:] or [""])[0]
    line = os.environ.get("_TYPER_COMPLETE_ARGS", "")
    words = _divided(line)[1:]
    if shell in ("powershell", "pwsh"):
        begun = os.environ.get("_TYPER_COMPLETE_WORD_TO_COMPLETE", "")
        return words[:-1] if begun else words, begun
    return (words, "") if line.endswith(" ") or not words else (words[:-1], words[-1])


def _divided(line: str) -> list[str]:
    """Return the words of a line, of which the last may have begun with a quote."""
    reader = shlex.shlex(line, posix=True)
    reader.whitespace_split, reader.commenters = True, ""
    words: list[str] = []
    try:
        words.extend(reader)
    except ValueError:
        words.append(reader.token)
    return words


def _written(shell: str, found: Sequence[Candidate]) -> str:
    """Return candidates as a shell reads them."""
    if shell == "bash":
        return "\n".join(word for word, _ in found)
    if shell == "fish":
        return "\n".join(f"{word}\t{meaning}".rstrip() for word, meaning in found)
    if shell != "zsh":
        return "\n".join(f"{word}:::{meaning or ' '}" for word, meaning in found)
    lines = [f'"{_for_zsh(word)}"' + (f':"{_for_zsh(meaning)}"' if meaning else "") for word, meaning in found]
    return "_arguments '*: :((" + "\n".join(lines) + "))'" if lines else "_files"


_FOR_ZSH = str.maketrans({'"': '""', "'": "''", "$": "\\$", "`": "\\`", ":": r"\\:"})


def _for_zsh(text: str) -> str:
    return text.translate(_FOR_ZSH)


# --- Candidates -------------------------------------------------------------------------------------------------------


def candidates(words: Sequence[str], begun: str) -> Iterator[Candidate]:
    """Iterate over what may stand in place of the begun word, behind other words.

    Nothing is offered that a shell could run.
    """
    for word, meaning in _fitting(words, begun):
        if word.startswith(begun.rpartition("=")[2]) and all(char.isalnum() or char in "_-−.+,@=:/" for char in word):
            yield word, meaning


def _fitting(words: Sequence[str], begun: str) -> Iterable[Candidate]:
    """Return what fits behind some words: commands, options, or words and values of these."""
    command = next((COMMANDS[word] for word in words if word in COMMANDS), None)
    flags = flags_of(command.name if command else None)
    if begun.startswith("-") and "=" not in begun and "--" not in words:
        return _options({flag_and_value(word, flags)[0] for word in words}, flags.values())
    if command is None:
        return [] if "=" in begun else [(each.name, each.sentence) for each in COMMANDS.values()]
    flag, value, is_joined = _flag_and_begun(words, begun)
    option = flags.get(flag if flag.startswith("-") or not is_joined else f"--{flag}")  # gamma=25mJ/m2
    if option is not None and option.metavar:
        places: Sequence[str] = [option.name]
    else:
        places = [] if is_joined else _placeholders(command, words, value)
    return [(word, "") for place in places for word in _values(place, value)]


def _flag_and_begun(words: Sequence[str], begun: str) -> tuple[str, str, bool]:
    """Return the word whose value may have begun, that value, and whether a "=" joins the two.

    bash divides `--to=nN` into three words.
    """
    if begun == "=":
        return words[-1], "", True
    if words[-1:] == ["="]:
        return words[-2], begun, True
    flag, is_joined, value = begun.partition("=")
    return (flag, value, True) if is_joined else (words[-1], begun, False)


def _options(given: Set[str], options: Iterable[Option[Any]]) -> Iterator[Candidate]:
    """Iterate over the options that are shown, but for those that were given and do not repeat."""
    for option in dict.fromkeys(options):
        if not option.hidden and (option.repeats or given.isdisjoint(option.flags)):
            for flag in option.flags:
                yield flag, option.sentence()


def _placeholders(command: Command, words: Sequence[str], begun: str) -> Sequence[str]:
    """Return the placeholders that a word may stand for: the first whose names it begins, if no word has that place.

    Without a begun word it is the first of the command; where none fits, all of them.
    """
    if not begun:
        return command.placeholders[:1]
    for place in command.placeholders:
        names = {*_NAMES[place]("")} if place in _NAMES else set()
        if names.isdisjoint(words) and any(name.startswith(begun) for name in names):
            return [place]
    return command.placeholders


def _values(place: str, begun: str) -> Iterable[str]:
    """Return words for a placeholder or values of an option: names, which may form a list, or numbers with units."""
    head, comma, word = begun.rpartition(",")
    if place in _NAMES:
        return [head + comma + name for name in _NAMES[place](word)]
    name = "radius" if place == "RADIUS" else place
    if name not in NOMENCLATURE:
        return []
    if not begun:
        return [] if place == "RADIUS" else [NOMENCLATURE[name].example]
    number = begun[: len(begun) - len(begun.lstrip("0123456789.-+−"))]
    return [number + unit for unit in _units(NOMENCLATURE[name].unit) if number]


def _units(unit: str) -> Iterable[str]:
    """Return the units of the examples of inputs of a dimension, in order."""
    alike = (quantity for quantity in NOMENCLATURE.values() if quantity.example and quantity.unit == unit)
    return dict.fromkeys(quantity.example.lstrip("0123456789.e-") for quantity in alike if not quantity.is_word)


def _materials(begun: str) -> list[str]:
    """Return materials, and aliases where no name fits; only the shipped ones while a user's file is broken."""
    from ..materials.library import known_materials, materials_of_user

    try:
        materials = materials_of_user(None)
    except JkrollError:  # which the call itself will report
        materials = known_materials()
    names = [name for name in (*materials.materials, "all") if name.startswith(begun)]
    return names or [name for name in materials.aliases if name.startswith(begun)]


def _topics(_: str) -> Iterable[str]:
    """Return the pages of the manual."""
    from ..write.manual import topics

    return topics()


def _programs(_: str) -> Iterable[str]:
    """Return the programs that `export` writes for."""
    from ..write.exports import PROGRAMS

    return PROGRAMS


_RESULTS = [  # the quantities that a formula gives, without variants and without what is only an input
    name
    for name, quantity in NOMENCLATURE.items()
    if not (quantity.is_word or quantity.variant_of) and (quantity.equation or quantity.range is ANY)
]
# The names that a begun word may become, by its placeholder, or by the name of the option whose value it is.
_NAMES: Mapping[str, Callable[[str], Iterable[str]]] = {
    **dict.fromkeys(("MATERIAL", "material", "material2", "mark"), _materials),
    **dict.fromkeys(("QUANTITY", "NAME", "quantities"), lambda _: _RESULTS),
    "TOPIC": _topics,
    "PROGRAM": _programs,
    "model": lambda _: MODELS,
    "profile": lambda _: PROFILES,
}
