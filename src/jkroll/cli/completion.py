"""Completion with TAB: candidates for a partial word, written in the form that each shell reads.

The scripts are those that typer's `--install-completion` installs. They pass the typed words in environment variables.
We answer without typer, because its import takes longer than an answer.
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

Candidate = tuple[str, str]  # a word, and its meaning for shells that show it


def is_asked_by(instruction: str) -> bool:
    """Return whether a script asks for candidates, as in complete_bash, rather than for a script."""
    action, _, shell = instruction.partition("_")
    return action == "complete" and shell in SHELLS


def main() -> int:
    """Write the candidates for the shell that asks; return the exit code."""
    return finished(_write)


def _write() -> int:
    shell = os.environ["_JKROLL_COMPLETE"].partition("_")[2]
    found = list(candidates(*_typed(shell)))
    if shell == "fish" and os.environ.get("_TYPER_COMPLETE_FISH_ACTION") == "is-args":
        return 0 if found else FAILED  # fish then offers files
    say(_written(shell, found), sys.stdout)
    return 0


# --- Input from a shell, and output to it -----------------------------------------------------------------------------


def _typed(shell: str) -> tuple[list[str], str]:
    """Return the words after the name of the program, and the partial word, which may be empty."""
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
    """Return the words of a line; the last one may have an open quote."""
    reader = shlex.shlex(line, posix=True)
    reader.whitespace_split, reader.commenters = True, ""
    words: list[str] = []
    try:
        words.extend(reader)
    except ValueError:
        words.append(reader.token)
    return words


def _written(shell: str, found: Sequence[Candidate]) -> str:
    """Return candidates in the form that a shell reads."""
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
    """Iterate over the candidates for a partial word after other words.

    Candidates contain no characters that a shell could interpret.
    """
    for word, meaning in _fitting(words, begun):
        if word.startswith(begun.rpartition("=")[2]) and all(char.isalnum() or char in "_-−.+,@=:/" for char in word):
            yield word, meaning


def _fitting(words: Sequence[str], begun: str) -> Iterable[Candidate]:
    """Return the candidates after some words: commands, options, arguments or values of options."""
    commands = [COMMANDS[word] for word in words if word in COMMANDS]
    command = commands[0] if commands else None
    flags = flags_of(command.name if command else None)
    if begun.startswith("-") and "=" not in begun and "--" not in words:
        return _options({flag_and_value(word, flags)[0] for word in words}, flags.values())
    if command is None:
        return [] if "=" in begun else [(each.name, each.sentence) for each in COMMANDS.values()]
    flag, value, is_joined = _flag_and_begun(words, begun)
    option = flags.get(flag if flag.startswith("-") or not is_joined else f"--{flag}")  # gamma=25mJ/m2
    if option is not None and option.metavar:
        return _values(option.name, value)
    found: list[Candidate] = []
    if not is_joined:
        for placeholder in _placeholders(command, words, value):
            found += _values(placeholder, value)
    return found


def _flag_and_begun(words: Sequence[str], begun: str) -> tuple[str, str, bool]:
    """Return the word whose value may be partial, that value, and whether "=" joins the two.

    bash splits `--to=nN` into three words.
    """
    if begun == "=":
        return words[-1], "", True
    if words[-1:] == ["="]:
        return words[-2], begun, True
    flag, is_joined, value = begun.partition("=")
    return (flag, value, True) if is_joined else (words[-1], begun, False)


def _options(given: Set[str], options: Iterable[Option[Any]]) -> Iterator[Candidate]:
    """Iterate over the visible options, except those given that do not repeat."""
    for option in dict.fromkeys(options):
        if not option.hidden and (option.repeats or given.isdisjoint(option.flags)):
            for flag in option.flags:
                yield flag, option.sentence()


def _placeholders(command: Command, words: Sequence[str], begun: str) -> Sequence[str]:
    """Return the placeholders that a partial word may fill: the first with a matching name that no other word fills.

    For an empty word it is the first placeholder of the command; if none matches, all of them.
    """
    if not begun:
        return command.placeholders[:1]
    for placeholder in command.placeholders:
        names = {*_NAMES[placeholder]("")} if placeholder in _NAMES else set()
        if names.isdisjoint(words) and any(name.startswith(begun) for name in names):
            return [placeholder]
    return command.placeholders


def _values(placeholder: str, begun: str) -> list[Candidate]:
    """Return values for a placeholder or an option: names, also within a list, or numbers with units."""
    head, comma, word = begun.rpartition(",")
    if placeholder in _NAMES:
        return [(head + comma + name, "") for name in _NAMES[placeholder](word)]
    name = "radius" if placeholder == "RADIUS" else placeholder
    if name not in NOMENCLATURE:
        return []
    if not begun:
        return [] if placeholder == "RADIUS" else [(NOMENCLATURE[name].example, "")]
    number = begun[: len(begun) - len(begun.lstrip("0123456789.-+−"))]
    return [(number + unit, "") for unit in _units(NOMENCLATURE[name].unit)] if number else []


def _units(unit: str) -> Iterable[str]:
    """Return the units in the examples of inputs of a dimension, in order."""
    alike = (quantity for quantity in NOMENCLATURE.values() if quantity.example and quantity.unit == unit)
    return dict.fromkeys(quantity.example.lstrip("0123456789.e-") for quantity in alike if not quantity.is_word)


def _materials(begun: str) -> list[str]:
    """Return matching materials, or else aliases; only shipped ones while a user's file has errors."""
    from ..materials.library import known_materials, materials_of_user

    try:
        materials = materials_of_user(None)
    except JkrollError:  # the call itself will report it
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


_RESULTS = [  # quantities with a formula, without variants
    name
    for name, quantity in NOMENCLATURE.items()
    if not (quantity.is_word or quantity.variant_of) and (quantity.equation or quantity.range is ANY)
]
# The names that a partial word may become, by placeholder or by the name of its option.
_NAMES: Mapping[str, Callable[[str], Iterable[str]]] = {
    **dict.fromkeys(("MATERIAL", "material", "material2", "mark"), _materials),
    **dict.fromkeys(("QUANTITY", "NAME", "quantities"), lambda _: _RESULTS),
    "TOPIC": _topics,
    "PROGRAM": _programs,
    "model": lambda _: MODELS,
    "profile": lambda _: PROFILES,
}
