"""What the shell offers on TAB: materials, and values with the units of the quantity."""

from collections.abc import Callable

from .nomenclature import NOMENCLATURE

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
    """Materials for a word that begins with a letter, radii for one that begins with a number."""
    if incomplete[:1].isdigit():
        return _with_units(incomplete, "m")
    from .materials import known_materials
    from .request import materials_files

    head, comma, word = incomplete.rpartition(",")
    names = [*known_materials(*materials_files(None)).materials, "all"]
    return [head + comma + name for name in names if name.casefold().startswith(word.casefold())]


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
