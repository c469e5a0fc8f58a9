"""A value as text: for people six digits and a fitting prefix, for machines the shortest text that reads back the same."""

from collections.abc import Mapping
from math import floor, isinf, log10
from types import MappingProxyType
from typing import NamedTuple

from .nomenclature import INFINITY, NOMENCLATURE, word_for_infinity
from .units import Unit, convert

PEOPLE_DIGITS = 6
_PREFIXES = {
    -21: "z",
    -18: "a",
    -15: "f",
    -12: "p",
    -9: "n",
    -6: "µ",
    -3: "m",
    0: "",
    3: "k",
    6: "M",
    9: "G",
    12: "T",
    15: "P",
}
_PREFIXABLE = ("m", "N", "J", "Pa", "Hz", "rad", "N m", "N/m", "J/m^2", "N m/rad")


class Format(NamedTuple):
    """How results are to be written."""

    units: Mapping[str, tuple[str, Unit]] = MappingProxyType({})  # quantity → unit to convert to
    digits: int | None = None

    def unit(self, name: str) -> str:
        """The unit in which a quantity is written for machines."""
        return self.units[name][0] if name in self.units else NOMENCLATURE[name].unit

    def number(self, name: str, value: float) -> float:
        """A value in the unit in which it is written."""
        return convert(value, self.units[name][1]) if name in self.units else value

    def text(self, name: str, value: float | str) -> str:
        """A value as a machine reads it."""
        if isinstance(value, str):
            return value
        number = self.number(name, value)
        return repr(number + 0.0) if self.digits is None else f"{number + 0.0:.{self.digits}g}"

    def header(self, name: str) -> str:
        """A column header: name and unit."""
        unit = self.unit(name)
        return name if unit in ("", "1") else f"{name} [{unit}]"

    def people(self, name: str, value: float | str) -> tuple[str, str]:
        """A value and its unit as a person reads it."""
        if isinstance(value, str):
            return value, ""
        digits = self.digits or PEOPLE_DIGITS
        if name in self.units:
            return f"{self.number(name, value):.{digits}g}", self.units[name][0]
        return engineering(value, NOMENCLATURE[name].unit, digits)


def engineering(value: float, unit: str, digits: int = PEOPLE_DIGITS) -> tuple[str, str]:
    """A number of significant digits and a unit whose prefix fits it.

    >>> engineering(1.1780972e-08, "N")
    ('11.781', 'nN')
    """
    if unit in ("1", ""):
        return f"{value:.{digits}g}", ""
    if unit not in _PREFIXABLE or value == 0:
        return f"{value:.{digits}g}", unit
    rounded = float(f"{value:.{digits}g}")
    if isinf(rounded):
        return f"{value:.{digits}g}", unit
    exponent = 3 * floor(log10(abs(rounded)) / 3 + 1e-12)
    prefix = _PREFIXES.get(exponent)
    if prefix is None:
        return f"{value:.{digits}g}", unit
    return f"{convert(rounded, _power_of_ten(exponent)):.{digits}g}", prefix + unit


def pretty(unit: str) -> str:
    """A unit with superscripts.

    >>> pretty("mJ/m^2"), pretty("m^-1")
    ('mJ/m²', 'm⁻¹')
    """
    return unit.replace("^2", "²").replace("^3", "³").replace("^-1", "⁻¹")


def _power_of_ten(exponent: int) -> Unit:
    return Unit(10 ** max(exponent, 0), 10 ** max(-exponent, 0), ())


AS_USUAL = Format()


def amount(name: str, value: float | str, form: Format = AS_USUAL) -> str:
    """A value with its unit, for a sentence.

    >>> amount("yield_displacement", 2e-10)
    '200 pm'
    """
    return " ".join(part for part in form.people(name, value) if part)


def in_words(name: str, value: float | str) -> float | str:
    """Return the word for an infinite value, and any other value unchanged.

    >>> in_words("radius2", float("inf")), in_words("radius2", 1e-7)
    ('plane', 1e-07)
    """
    if value != INFINITY:
        return value
    return word_for_infinity(name) or "infinite"
