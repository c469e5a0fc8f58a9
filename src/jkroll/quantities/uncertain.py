"""Values with an uncertainty, and the texts that state one: 25±5 mJ/m2, 25(5) mJ/m2, 25 mJ/m2 ± 20%, 20 to 30 mJ/m2.

As in `parsing`, a number is computed as a ratio of integers and rounded once. A call without uncertainties never imports this
module: `parsing.has_uncertainty` tells which texts are for it.
"""

import re
from collections.abc import Collection
from typing import Any, Literal, NamedTuple

from .errors import QuantityError
from .nomenclature import NOMENCLATURE, RANGES
from .parsing import NoUnit, error_about, has_uncertainty, parse_quantity, ratio, rounded, split_number, unit_in
from .units import BadUnit, Dimension, Unit, dimension_of, normalized


class Measured(NamedTuple):
    """A value in SI units with one standard uncertainty on each side.

    >>> Measured(0.025, 0.005, 0.005).low
    0.02
    """

    value: float
    minus: float
    plus: float
    kind: Literal["standard"] = "standard"

    @property
    def low(self) -> float:
        """The value less its uncertainty."""
        return self.value - self.minus

    @property
    def high(self) -> float:
        """The value plus its uncertainty."""
        return self.value + self.plus

    @property
    def sides(self) -> dict[str, float]:
        """The uncertainty on each side."""
        return {"minus": self.minus, "plus": self.plus}

    def as_object(self) -> dict[str, float | str]:
        """Return the uncertainty as JSON states it."""
        return {"kind": self.kind, **self.sides}


class Interval(NamedTuple):
    """A range in SI units of which any value is possible, and a value inside it."""

    value: float
    low: float
    high: float
    kind: Literal["range"] = "range"

    @property
    def sides(self) -> dict[str, float]:
        """Both ends."""
        return {"low": self.low, "high": self.high}

    def as_object(self) -> dict[str, float | str]:
        """Return the range as JSON states it."""
        return {"kind": self.kind, **self.sides}


Uncertain = Measured | Interval


class UnclearUncertainty(BadUnit):
    """Error raised for an uncertainty that can be read in two ways, or in none."""

    def __init__(self, words: str, remedy: str) -> None:
        super().__init__(words)
        self._remedy = remedy

    def remedy(self, dimensions: Collection[Dimension]) -> str:  # noqa: ARG002
        """Return what to type instead."""
        return self._remedy


def parse_uncertain(text: str, name: str) -> float | Uncertain:
    """Read the value of a quantity of the nomenclature, with its uncertainty if the text states one, in SI units.

    >>> parse_uncertain("25±5 mJ/m2", "surface_energy")
    Measured(value=0.025, minus=0.005, plus=0.005, kind='standard')
    >>> parse_uncertain("20 to 30 nm", "radius")
    Interval(value=2.5e-08, low=2e-08, high=3e-08, kind='range')

    Raises a `QuantityError` that names the quantity, quotes the text and shows the right form.
    """
    try:
        found = _read(normalized(text).replace("+/-", "±").replace("+-", "±"), dimension_of(NOMENCLATURE[name].unit))
    except BadUnit as error:
        raise error_about(name, text, error) from None
    return parse_quantity(text, name) if found is None else checked(found, name, text)


def measured(value: Any, name: str) -> float | Uncertain:
    """Return the value of a number with `nominal_value` and `std_dev` in SI units, as the package `uncertainties` has them.

    The magnitude of a `pint.Measurement` is such a number.
    """
    uncertainty = float(value.std_dev)
    return checked(Measured(float(value.nominal_value), uncertainty, uncertainty), name, str(value))


def checked(found: Uncertain, name: str, text: str) -> float | Uncertain:
    """Return a value with an uncertainty if the quantity can have it, and a value alone if the uncertainty is 0."""
    limits = RANGES.get(NOMENCLATURE[name].range)
    if limits is not None:
        if not limits.admits(found.value):
            raise QuantityError(name, text, limits.words)
        is_positive = limits.low == 0
        if isinstance(found, Measured) and is_positive and 2 * found.minus >= found.value:
            raise QuantityError(name, text, "has an uncertainty of half the value or more", "give a range: FROM to TO")
        if not (limits.admits(found.low) and limits.admits(found.high)):
            raise QuantityError(name, text, f"{limits.words} at both ends")
    if isinstance(found, Measured) and found.minus == found.plus == 0:
        return found.value
    return found


_NUMBER = r"([+-]?[0-9.]+(?:[eE][+-]?[0-9]+)?)"
_UNIT = r" ?([^±()]*)"
_POWER = r"(?:[eE]([+-]?[0-9]{1,3}))?"
_IN_BRACKETS = re.compile(rf"\( ?{_NUMBER} ?± ?{_NUMBER} ?\){_POWER}{_UNIT}")  # (25±5)e-3 J/m2
_LAST_DIGITS = re.compile(rf"([+-]?[0-9.]+)\(([0-9]+)\){_POWER}{_UNIT}")  # 25.0(50) mJ/m2
_TWO_SIDES = re.compile(rf"{_NUMBER} ?\+ ?{_NUMBER} ?/ ?- ?{_NUMBER}{_UNIT}")  # 25 +6/-4 mJ/m2
_PLUS_MINUS = re.compile(r"([^±()]+)±([^±()]+)")  # 25±5 mJ/m2, 25 mJ/m2 ± 5 mJ/m2, 25 mJ/m2 ± 20%


def _read(text: str, dimension: Dimension) -> Uncertain | None:
    """Read a text in one of the forms above, or a range; None for any other."""
    if match := _IN_BRACKETS.fullmatch(text):
        value, uncertainty, power, unit = match.groups()
        return _symmetric(_decimal(value, power), _decimal(uncertainty, power), unit_in(unit, dimension))
    if match := _LAST_DIGITS.fullmatch(text):
        value, digits, power, unit = match.groups()
        places = len(value.partition(".")[2])
        nominal, uncertainty = _decimal(value, power), _decimal(f"{digits}e-{places}", power)
        if 2 * int(digits) > abs(float(value)):
            plain = f"{value}±{int(digits) / 10**places:.{places}f}"
            raise UnclearUncertainty(f"can be read as {plain} or as {value}e{digits}", "write the one that is meant")
        return _symmetric(nominal, uncertainty, unit_in(unit, dimension))
    if match := _TWO_SIDES.fullmatch(text):
        value, plus, minus, unit = match.groups()
        return _measured(_decimal(value), _decimal(minus), _decimal(plus), unit_in(unit, dimension))
    if match := _PLUS_MINUS.fullmatch(text):
        return _plus_minus(match[1], match[2], dimension)
    if " to " in text:
        return _interval(text, dimension)
    if has_uncertainty(text):
        raise UnclearUncertainty("has an uncertainty in an unknown form", "write it as in 25±5 mJ/m2 or 20 to 30 mJ/m2")
    return None


def _plus_minus(left: str, right: str, dimension: Dimension) -> Measured:
    """Read a value, with or without a unit, and its uncertainty with a unit or in percent of the value."""
    value, unit_text = _split(left)
    uncertainty, own_text = _split(right)
    if own_text.startswith("%"):
        if own_text != "%" or unit_text == "%":
            raise UnclearUncertainty("has a % that can be read in two ways", "write 25 mJ/m2 ± 20%, or (17±1) %")
        share = abs(value[0]) * uncertainty[0], value[1] + uncertainty[1] - 2
        return _symmetric(value, share, unit_in(unit_text, dimension))
    if unit_text and not own_text:
        raise NoUnit("has an uncertainty without a unit")
    own = unit_in(own_text, dimension)
    return _symmetric(value, uncertainty, unit_in(unit_text, dimension) if unit_text else own, own)


def _interval(text: str, dimension: Dimension) -> Interval:
    """Read a range of which the first end may leave its unit to the second."""
    left, _, right = text.partition(" to ")
    first, first_unit = _split(left)
    last, last_unit = _split(right)
    unit = unit_in(last_unit, dimension)
    low = ratio(*first, unit_in(first_unit, dimension) if first_unit else unit)
    high = ratio(*last, unit)
    middle = rounded(low[0] * high[1] + high[0] * low[1], 2 * low[1] * high[1])
    found = Interval(middle, rounded(*low), rounded(*high))
    if found.low >= found.high:
        raise BadUnit("does not rise from its first end to its second")
    return found


_Decimal = tuple[int, int]  # an integer and a power of ten


def _decimal(text: str, power: str | None = None) -> _Decimal:
    """Read a number without a unit, times a power of ten."""
    (mantissa, exponent), rest = _split(text)
    if rest:
        raise BadUnit("is not a number and a unit")
    return mantissa, exponent + int(power or 0)


def _split(text: str) -> tuple[_Decimal, str]:
    """Split a text into the number at its head and the unit after it."""
    mantissa, exponent, unit = split_number(text.strip(" "))
    return (mantissa, exponent), unit


def _symmetric(value: _Decimal, uncertainty: _Decimal, unit: Unit, own: Unit | None = None) -> Measured:
    """Return a value with the same uncertainty on both sides."""
    return _measured(value, uncertainty, uncertainty, unit, own)


def _measured(value: _Decimal, minus: _Decimal, plus: _Decimal, unit: Unit, own: Unit | None = None) -> Measured:
    """Return a value with an uncertainty on each side; `own` is the unit of both where it is not that of the value."""
    if minus[0] < 0 or plus[0] < 0:
        raise BadUnit("has a negative uncertainty")
    below, above = (rounded(*ratio(*side, own or unit)) for side in (minus, plus))
    return Measured(rounded(*ratio(*value, unit)), below, above)
