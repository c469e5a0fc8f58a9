"""What the shell offers on TAB: materials, and values with the units of the quantity."""

from collections.abc import Callable, Iterable
from typing import TYPE_CHECKING

from ..errors import JkrollError
from ..quantities.nomenclature import NOMENCLATURE

if TYPE_CHECKING:
    from ..materials.library import Materials

_UNITS = {
    "m": ("nm", "um", "mm", "m", "angstrom"),
    "N": ("nN", "uN", "mN", "N", "dyn"),
    "J": ("J", "eV", "erg"),
    "Pa": ("GPa", "MPa", "Pa"),
    "J/m^2": ("mJ/m2", "J/m2", "erg/cm2", "mN/m"),
    "kg/m^3": ("g/cm3", "kg/m3"),
    "m/s": ("cm/s", "m/s", "km/s"),
    "m/s^2": ("m/s2", "standard_gravity"),
}


def complete_words(incomplete: str) -> list[str]:
    """Materials for a word that begins with a letter, radii for one that begins with a number.

    An alias is offered where no name fits; never what a shell would take for more than a word, such as $(date).
    """
    if incomplete[:1].isdigit():
        return _with_units(incomplete, "m")
    head, comma, word = incomplete.rpartition(",")
    materials = _materials()
    fitting = _beginning([*materials.names, "all"], word) or _beginning(materials.aliases, word)
    return [head + comma + name for name in fitting if all(_is_plain(character) for character in name)]


def _materials() -> "Materials":
    """The materials that are known; while a user's file is broken, the shipped ones: here is no place to say so."""
    from ..materials.library import known_materials
    from ..materials.places import materials_files

    try:
        return known_materials(*materials_files(None))
    except JkrollError:
        return known_materials()


def _beginning(names: Iterable[str], word: str) -> list[str]:
    return [name for name in names if name.casefold().startswith(word.casefold())]


def _is_plain(character: str) -> bool:
    return character.isalnum() or character in "_-.+"


def complete_map(incomplete: str) -> list[str]:
    """Quantities of a map, and what else it takes."""
    word = incomplete.replace("-", "_")
    quantities = [name for name in NOMENCLATURE if name.startswith(word) and NOMENCLATURE[name].equation]
    return [*quantities, *complete_words(incomplete)] if incomplete else quantities


def complete_figure(incomplete: str) -> list[str]:
    """The figures with data."""
    from ..pictures.figures import FIGURES
    from ..pictures.profiles import PROFILES

    return [name for name in sorted({*FIGURES, *PROFILES}) if name.startswith(incomplete)]


def complete_axis(incomplete: str) -> list[str]:
    """Quantities for an axis, each with a range to be changed."""
    ends = {name: f"{name}=" for name in NOMENCLATURE if NOMENCLATURE[name].range}
    return [text for name, text in ends.items() if text.startswith(incomplete)]


def complete_mark(incomplete: str) -> list[str]:
    """Materials, and after an @ radii."""
    head, at, radius = incomplete.rpartition("@")
    if at:
        return [f"{head}@{text}" for text in _with_units(radius, "m")]
    return [f"{name}@" for name in complete_words(incomplete) if name.rpartition(",")[2] != "all"]


ARGUMENTS = {"map": complete_map, "figure": complete_figure}
OPTIONS = {"x": complete_axis, "y": complete_axis, "mark": complete_mark}


def complete_option(name: str) -> Callable[[str], list[str]] | None:
    """The completer for the value of an option, if there is one."""
    return OPTIONS.get(name) or (complete_input(name) if name in NOMENCLATURE else None)


def complete_input(name: str) -> Callable[[str], list[str]]:
    """The completer for an option: materials, or values in the units of the quantity."""
    if name == "material2":
        return complete_words
    unit = NOMENCLATURE[name].unit
    example = NOMENCLATURE[name].example

    def complete(incomplete: str) -> list[str]:
        return _with_units(incomplete, unit) if incomplete else [example]

    return complete


def _with_units(incomplete: str, unit: str) -> list[str]:
    digits = len(incomplete) - len(incomplete.lstrip("0123456789.-+−"))
    number = incomplete[:digits]
    return [number + candidate for candidate in _UNITS.get(unit, ()) if (number + candidate).startswith(incomplete)]
