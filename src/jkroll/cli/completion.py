"""Completion with TAB: candidates for a partial word, written in the form that each shell reads.

`--install-completion` installs typer's scripts, which pass the typed words in environment variables. The answer is
written without typer, because importing it takes longer than the answer.
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

Candidate = tuple[str, str]  # a word, and its meaning, which some shells show


def is_asked_by(instruction: str) -> bool:
    """Return whether an instruction asks for candidates, as complete_bash does, and not for a script."""
    action, _, shell = instruction.partition("_")
    return action == "complete" and shell in SHELLS


def main() -> int:
    """Write the candidates for the shell that asks; return the exit code."""
    return finished(_write)


def _write() -> int:
    """Write the candidates; for fish, which first asks whether there are any, write nothing. Return the exit code."""
    _, _, shell = os.environ["_JKROLL_COMPLETE"].partition("_")
    offered = list(candidates(*_typed(shell)))
    if shell == "fish" and os.environ.get("_TYPER_COMPLETE_FISH_ACTION") == "is-args":
        return 0 if offered else FAILED  # without candidates fish offers files
    say(_written(shell, offered), sys.stdout)
    return 0


# --- Input from a shell, and output to it -----------------------------------------------------------------------------


def _typed(shell: str) -> tuple[list[str], str]:
    """Return the complete words after the name of the program, and the partial word, which may be empty."""
    if shell == "bash":
        words, position = _divided(os.environ.get("COMP_WORDS", "")), int(os.environ.get("COMP_CWORD", "0"))
        return words[1:position], words[position] if position < len(words) else ""
    line = os.environ.get("_TYPER_COMPLETE_ARGS", "")
    words = _divided(line)[1:]
    if shell in ("powershell", "pwsh"):
        begun = os.environ.get("_TYPER_COMPLETE_WORD_TO_COMPLETE", "")
        return words[:-1] if begun else words, begun
    if line.endswith(" ") or not words:
        return words, ""
    return words[:-1], words[-1]


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


def _written(shell: str, offered: Iterable[Candidate]) -> str:
    """Return candidates in the form that a shell reads."""
    lines = []
    for word, meaning in offered:
        if shell == "bash":
            lines.append(word)
        elif shell == "fish":
            lines.append(f"{word}\t{meaning}".rstrip())
        elif shell == "zsh":
            lines.append(_for_zsh(word, meaning))
        else:
            lines.append(f"{word}:::{meaning or ' '}")
    text = "\n".join(lines)
    if shell == "zsh":
        return f"_arguments '*: :(({text}))'" if lines else "_files"
    return text


_ESCAPED_FOR_ZSH = str.maketrans({'"': '""', "'": "''", "$": "\\$", "`": "\\`", ":": r"\\:"})


def _for_zsh(word: str, meaning: str) -> str:
    """Return a candidate in the form of zsh: "word":"meaning"."""
    text = f'"{word.translate(_ESCAPED_FOR_ZSH)}"'
    if meaning:
        text += f':"{meaning.translate(_ESCAPED_FOR_ZSH)}"'
    return text


# --- Candidates -------------------------------------------------------------------------------------------------------


def candidates(words: Sequence[str], begun: str) -> Iterator[Candidate]:
    """Iterate over the candidates for a partial word after other words.

    A candidate with a character that a shell could interpret is left out.
    """
    _, _, prefix = begun.rpartition("=")
    for word, meaning in _meant(words, begun):
        if word.startswith(prefix) and all(letter.isalnum() or letter in "_-−.+,@=:/" for letter in word):
            yield word, meaning


def _meant(words: Sequence[str], begun: str) -> Iterable[Candidate]:
    """Return the commands, options, arguments or values of options that a partial word after some words may mean."""
    command = next((COMMANDS[word] for word in words if word in COMMANDS), None)
    flags = flags_of(None if command is None else command.name)
    if begun.startswith("-") and "=" not in begun and "--" not in words:
        return _options({flag_and_value(word, flags)[0] for word in words}, flags.values())
    if command is None:
        return [] if "=" in begun else [(name, known.sentence) for name, known in COMMANDS.items()]
    flag, value, is_joined = _flag_and_value_begun(words, begun)
    if is_joined and not flag.startswith("-"):
        flag = f"--{flag}"  # as in gamma=25mJ/m2
    option = flags.get(flag)
    if option is not None and option.metavar:
        return _values(option.name, value)
    arguments: list[Candidate] = []
    if not is_joined:
        for placeholder in _placeholders(command, words, value):
            arguments += _values(placeholder, value)
    return arguments


def _flag_and_value_begun(words: Sequence[str], begun: str) -> tuple[str, str, bool]:
    """Return the flag before a partial value, the value, and whether "=" joins them.

    bash splits `--to=nN` into three words.
    """
    if begun == "=":
        return words[-1], "", True
    if words[-1:] == ["="]:
        return words[-2], begun, True
    flag, is_joined, value = begun.partition("=")
    return (flag, value, True) if is_joined else (words[-1], begun, False)


def _options(given: Set[str], options: Iterable[Option[Any]]) -> Iterator[Candidate]:
    """Iterate over the visible options; a given option is left out unless it may be repeated."""
    for option in dict.fromkeys(options):
        if not option.hidden and (option.repeats or given.isdisjoint(option.flags)):
            for flag in option.flags:
                yield flag, option.sentence()


def _placeholders(command: Command, words: Sequence[str], begun: str) -> Sequence[str]:
    """Return the placeholders that a partial word may fill.

    An empty word fills the first placeholder. Any other word fills the first placeholder that is still free and has a
    matching name; without such a placeholder, the word may fill any of them.
    """
    if not begun:
        return command.placeholders[:1]
    for placeholder in command.placeholders:
        names = {*_NAMES[placeholder]("")} if placeholder in _NAMES else set()
        if names.isdisjoint(words) and any(name.startswith(begun) for name in names):
            return [placeholder]
    return command.placeholders


def _values(placeholder: str, begun: str) -> list[Candidate]:
    """Return the values of a placeholder or an option: names, alone or in a list, or numbers with units."""
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
    """Return the units that occur in the examples of inputs with this SI unit, each once."""
    units: dict[str, None] = {}
    for quantity in NOMENCLATURE.values():
        if quantity.example and quantity.unit == unit and not quantity.is_word:
            units[quantity.example.lstrip("0123456789.e-")] = None
    return units


def _materials(begun: str) -> list[str]:
    """Return matching materials, or aliases if none matches; only shipped ones if the user's file has errors."""
    from ..materials.library import known_materials, materials_of_user

    try:
        materials = materials_of_user(None)
    except JkrollError:  # the call itself reports the error
        materials = known_materials()
    names = [name for name in (*materials.materials, "all") if name.startswith(begun)]
    return names or [name for name in materials.aliases if name.startswith(begun)]


def _quantities(_: str) -> Iterable[str]:
    """Iterate over quantities with an equation in the paper, or without limits to their values; skip variants."""
    for name, quantity in NOMENCLATURE.items():
        if not quantity.is_word and not quantity.variant_of and (quantity.equation or quantity.range is ANY):
            yield name


def _topics(_: str) -> Iterable[str]:
    """Return the pages of the manual."""
    from ..write.manual import topics

    return topics()


def _programs(_: str) -> Iterable[str]:
    """Return the programs for which `export` writes input."""
    from ..write.exports import PROGRAMS

    return PROGRAMS


def _models(_: str) -> Iterable[str]:
    return MODELS


def _profiles(_: str) -> Iterable[str]:
    return PROFILES


# The functions that return the names for a partial word, by placeholder or by name of the option.
_NAMES: Mapping[str, Callable[[str], Iterable[str]]] = {
    **dict.fromkeys(("MATERIAL", "material", "material2", "mark"), _materials),
    **dict.fromkeys(("QUANTITY", "NAME", "quantities"), _quantities),
    "TOPIC": _topics,
    "PROGRAM": _programs,
    "model": _models,
    "profile": _profiles,
}
