"""Values as text: rounded and with a suitable prefix to be read, or as the shortest text that parses back to the same value."""

from collections.abc import Mapping
from math import floor, isinf, log10
from types import MappingProxyType
from typing import NamedTuple

from .nomenclature import INFINITY, NOMENCLATURE, word_for_infinity
from .units import Unit, convert

DIGITS = 6  # significant, of a rounded value
_PREFIXES = dict(zip(range(-21, 18, 3), ("z", "a", "f", "p", "n", "µ", "m", "", "k", "M", "G", "T", "P"), strict=True))
_PREFIXABLE = ("m", "N", "J", "Pa", "Hz", "rad", "N m", "N/m", "J/m^2", "N m/rad")


class Format(NamedTuple):
    """Units and number of digits in which results are written."""

    units: Mapping[str, tuple[str, Unit]] = MappingProxyType({})  # by quantity: the unit to convert to
    digits: int | None = None

    def unit(self, name: str) -> str:
        """Return the unit in which a quantity is written for a program."""
        return self.units[name][0] if name in self.units else NOMENCLATURE[name].unit

    def number(self, name: str, value: float) -> float:
        """Convert an SI value to the unit in which it is written."""
        return convert(value, self.units[name][1]) if name in self.units else value

    def text(self, name: str, value: float | str) -> str:
        """Return a value as text for a program."""
        if isinstance(value, str):
            return value
        number = self.number(name, value)
        return repr(number + 0.0) if self.digits is None else f"{number + 0.0:.{self.digits}g}"

    def header(self, name: str) -> str:
        """Return a column header: name and unit."""
        unit = self.unit(name)
        return name if unit in ("", "1") else f"{name} [{unit}]"

    def rounded(self, name: str, value: float | str) -> tuple[str, str]:
        """Return a value and its unit, rounded and with a suitable prefix."""
        if isinstance(value, str):
            return value, ""
        digits = self.digits or DIGITS
        if name in self.units:
            return f"{self.number(name, value):.{digits}g}", self.units[name][0]
        return engineering(value, NOMENCLATURE[name].unit, digits)


def engineering(value: float, unit: str, digits: int = DIGITS) -> tuple[str, str]:
    """Round a value to significant digits and choose a prefix for its unit.

    >>> engineering(1.1780972e-08, "N")
    ('11.781', 'nN')
    """
    text = f"{value:.{digits}g}"
    rounded = float(text)
    if unit in ("1", ""):
        return text, ""
    if unit not in _PREFIXABLE or rounded == 0 or isinf(rounded):
        return text, unit
    exponent = 3 * floor(log10(abs(rounded)) / 3 + 1e-12)
    if exponent not in _PREFIXES:
        return text, unit
    return f"{convert(rounded, _power_of_ten(exponent)):.{digits}g}", _PREFIXES[exponent] + unit


def pretty(unit: str) -> str:
    """Return a unit with superscripts.

    >>> pretty("mJ/m^2"), pretty("m^-1")
    ('mJ/m²', 'm⁻¹')
    """
    return unit.replace("^2", "²").replace("^3", "³").replace("^-1", "⁻¹")


def _power_of_ten(exponent: int) -> Unit:
    return Unit(10 ** max(exponent, 0), 10 ** max(-exponent, 0), ())


AS_USUAL = Format()


def amount(name: str, value: float | str, form: Format = AS_USUAL) -> str:
    """Return a value with its unit, for a sentence.

    >>> amount("yield_displacement", 2e-10)
    '200 pm'
    """
    return " ".join(part for part in form.rounded(name, value) if part)


def in_words(name: str, value: float | str) -> float | str:
    """Return the word for an infinite value, and any other value unchanged.

    >>> in_words("radius2", float("inf")), in_words("radius2", 1e-7)
    ('plane', 1e-07)
    """
    if value != INFINITY:
        return value
    return word_for_infinity(name) or "infinite"
