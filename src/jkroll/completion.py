"""What the shell offers on TAB: materials, and values with the units of the quantity."""

from collections.abc import Callable, Iterable
from typing import TYPE_CHECKING

from .errors import JkrollError
from .nomenclature import NOMENCLATURE

if TYPE_CHECKING:
    from .materials import Material

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
    names = [*(material.name for material in materials), "all"]
    aliases = [alias for material in materials for alias in material.aliases]
    fitting = _beginning(names, word) or _beginning(aliases, word)
    return [head + comma + name for name in fitting if all(_is_plain(character) for character in name)]


def _materials() -> "list[Material]":
    """The materials that are known; while a user's file is broken, the shipped ones: here is no place to say so."""
    from .materials import known_materials
    from .request import materials_files

    try:
        return list(known_materials(*materials_files(None)).materials.values())
    except JkrollError:
        return list(known_materials().materials.values())


def _beginning(names: Iterable[str], word: str) -> list[str]:
    return [name for name in names if name.casefold().startswith(word.casefold())]


def _is_plain(character: str) -> bool:
    return character.isalnum() or character in "_-.+"


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
