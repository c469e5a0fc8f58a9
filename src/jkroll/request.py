"""What a user typed, as scenes: words and options to materials and values, lists and ranges to a row each."""

import os
from collections.abc import Iterator, Mapping, Sequence
from functools import cached_property
from itertools import product
from pathlib import Path
from typing import Any

from .errors import BareNumber, JkrollError, MalformedQuantity, QuantityError, quoted
from .formatting import Format
from .materials import Material, Materials, known_materials
from .nomenclature import NOMENCLATURE
from .scene import Scene
from .units import dimension_of, parse_quantity, unit_of

MAX_SCENES = 1_000_000
ENVIRONMENT = "JKROLL_MATERIALS"


# Inputs of which one follows from the other.
_EXCLUSIVE = (
    ("energy", "energy_ratio", "speed"),
    ("surface_energy", "work_of_adhesion"),
    ("surface_energy2", "work_of_adhesion"),
    ("load", "approach_at_load"),
)


class BadRequest(JkrollError):
    """Words or options that do not make a request."""


class Request:
    """The words and options of one call, read as far as they are needed."""

    def __init__(self, words: Sequence[str], options: Mapping[str, str], files: Sequence[Path] = ()) -> None:
        """`words`: materials and radii; `options`: text by the name of the input; `files`: of materials, by rising precedence."""
        self.options = dict(options)
        self.files = files
        words = _joined(words)
        if "plane" in map(str.casefold, words):
            raise BadRequest("a plane is sphere 2: write --radius2 plane")
        radii = [word for word in words if not _is_material(word)]
        named = [word for word in words if _is_material(word)]
        if len(named) > 1:
            raise BadRequest(
                f"two materials, {quoted(named[0])} and {quoted(named[1])}; a list has commas, a second sphere has --material2"
            )
        self.material_words = named[0] if named else ""
        self.material2_words = self.options.pop("material2", "")
        if radii:
            self.options["radius"] = ",".join(radii)
        for alternatives in _EXCLUSIVE:
            given = [NOMENCLATURE[name].option for name in alternatives if name in options]
            if len(given) > 1:
                raise BadRequest(" and ".join(given) + " exclude each other")

    @cached_property
    def materials(self) -> Materials:
        """All materials that are known; the files are read when the first is asked for."""
        return known_materials(*self.files)

    def scenes(self) -> Iterator[Scene]:
        """A scene for each combination of the materials and values that were given."""
        values = {name: values_of(text, name) for name, text in self.options.items()}
        materials, materials2 = self._materials(self.material_words), self._materials(self.material2_words)
        order = sorted(values, key=list(NOMENCLATURE).index)
        count = len(materials) * len(materials2)
        for name in order:
            count *= len(values[name])
        if count > MAX_SCENES:
            raise BadRequest(f"{count} scenes are more than {MAX_SCENES}")
        for material, material2 in product(materials, materials2):
            for row in product(*(values[name] for name in order)):
                yield Scene(dict(zip(order, row, strict=True)), material, material2)

    def _materials(self, words: str) -> list[Material | None]:
        if not words:
            return [None]
        if words.casefold() == "all":
            return list(self.materials.materials.values())
        return [self.materials[word] for word in words.split(",")]


def _joined(words: Sequence[str]) -> list[str]:
    """The words, with a number and the unit that was typed after a space made one."""
    joined: list[str] = []
    for word in words:
        if joined and joined[-1][-1:].isdigit() and not joined[-1].strip("+-−.0123456789eE") and _is_material(word):
            joined[-1] += f" {word}"
        else:
            joined.append(word)
    return joined


def _is_material(word: str) -> bool:
    return word.casefold() == "all" or (word[:1].isalpha() and word.casefold() != "plane")


def values_of(text: str, name: str) -> list[float]:
    """The values that a text gives: one, several between commas, or a range `FROM:TO:COUNT` with `:lin` or `:log`.

    >>> values_of("1nm:1um:4", "radius")
    [1e-09, 1e-08, 1e-07, 1e-06]
    """
    values: list[float] = []
    items = text.split(",")
    for item in items:
        try:
            values += _range(item, name) if ":" in item else [parse_quantity(item, name)]
        except BareNumber:
            if len(items) > 1:
                raise MalformedQuantity(
                    name, text, "has a comma where a number has a point, or a number without a unit"
                ) from None
            raise
    return values


def _range(text: str, name: str) -> list[float]:
    first, last, *rest = text.split(":")
    scale = rest[1] if len(rest) == 2 else "log"
    if not 1 <= len(rest) <= 2 or not (rest[0].isascii() and rest[0].isdigit()) or scale not in ("log", "lin"):
        raise MalformedQuantity(name, text, "is not a range; write FROM:TO:COUNT, with :lin for equal steps")
    if len(rest[0]) > 7 or not 2 <= (count := int(rest[0])) <= MAX_SCENES:
        raise MalformedQuantity(name, text, f"needs a count from 2 to {MAX_SCENES}")
    low, high = parse_quantity(first, name), parse_quantity(last, name)
    if scale == "log" and not (low > 0 and high > 0):
        raise MalformedQuantity(name, text, "has an end that is not positive; end it with :lin")
    if max(abs(low), abs(high)) == float("inf"):
        raise MalformedQuantity(name, text, "has no end")
    steps = [place / (count - 1) for place in range(1, count - 1)]
    if scale == "lin":
        return [low, *(low + (high - low) * step for step in steps), high]
    return [low, *(float(f"{low * (high / low) ** step:.15g}") for step in steps), high]


def format_of(to: str | None, digits: int | None, quantities: Sequence[str]) -> Format:
    """How results are to be written: each unit of `--to` serves the quantities of its dimension."""
    units: dict[str, Any] = {}
    for text in to.split(",") if to else []:
        try:
            unit = unit_of(text, quantities[0])
        except QuantityError as error:
            raise BadRequest(f"--to: {quoted(text)} {error.problem()}") from None
        fitting = [name for name in quantities if dimension_of(NOMENCLATURE[name].unit) == unit.dimension]
        if not fitting:
            kinds = ", ".join(dict.fromkeys(f"{name} in {NOMENCLATURE[name].unit}" for name in quantities))
            raise BadRequest(f"--to: {quoted(text)} fits none of the results: {kinds}")
        units |= dict.fromkeys(fitting, (text.strip(), unit))
    return Format(units, digits)


def materials_files(option: str | None, configuration: Path) -> tuple[Path, ...]:
    """The user's own materials files by rising precedence: configuration directory, environment, option."""
    files = [configuration] if configuration.exists() else []
    files += [Path(path) for path in (os.environ.get(ENVIRONMENT), option) if path]
    if len(files) > 1 and files[-1] == files[-2]:
        files.pop()
    return tuple(files)
