"""Text to SI numbers: a strict grammar and exact arithmetic.

A text is one decimal number and a unit; nothing else is a quantity. `uncertain` reads values with an uncertainty. A value is
computed as a ratio of integers and rounded to a double once.
"""

import re
from collections.abc import Collection
from typing import TYPE_CHECKING, Any

from .errors import BareNumber, QuantityError
from .nomenclature import INFINITY, NOMENCLATURE, RANGES, word_for_infinity
from .units import MAX_TEXT, BadUnit, Dimension, Unit, dimension_of, kind_of, normalized, parse_unit

if TYPE_CHECKING:
    from typing import TypeGuard

    from .uncertain import Uncertain

_NUMBER = re.compile(r"([+-]?)([0-9]*)(?:\.([0-9]*))?(?:[eE]([+-]?[0-9]+))?")
_MARKS = ("±", "(", "+-", "+−", "/-", "/−", " to ")  # /- as in +/- and in +6/-4


class NoUnit(BadUnit):
    """Error raised for a number without a unit where one is needed."""


def parse_quantity(text: str, name: str) -> float:
    """Read the value of a quantity of the nomenclature, in SI units, correctly rounded.

    >>> parse_quantity("0.1 µm", "radius")
    1e-07

    Raises a `QuantityError` that names the quantity, quotes the text and shows the right form.
    """
    quantity = NOMENCLATURE[name]
    word = word_for_infinity(name)
    if word is not None and text.strip().lower() == word:
        return INFINITY
    try:
        value = parse_value(text, dimension_of(quantity.unit))
    except BadUnit as error:
        raise error_about(name, text, error) from None
    limits = RANGES.get(quantity.range)
    if limits is not None and not limits.admits(value):
        raise QuantityError(name, text, limits.words)
    return value


def unit_of(text: str, name: str) -> Unit:
    """Read a unit for a quantity of the nomenclature. Raises a `QuantityError`; a unit of another dimension is not an error."""
    try:
        return parse_unit(text)
    except BadUnit as error:
        raise error_about(name, text, error) from None


def parse_value(text: str, dimension: Dimension) -> float:
    """Read a number with a unit of a dimension, in SI units, correctly rounded. Raises a `BadUnit`.

    >>> parse_value("36 km/h", dimension_of("m/s"))
    10.0
    """
    mantissa, exponent, unit_text = split_number(normalized(text))
    return rounded(*ratio(mantissa, exponent, unit_in(unit_text, dimension)))


def unit_in(text: str, dimension: Dimension) -> Unit:
    """Read a unit of a dimension. Raises a `BadUnit`."""
    if not text and any(dimension):
        raise NoUnit("has no unit")
    unit = parse_unit(text)
    if unit.dimension != dimension:
        raise BadUnit(f"is {kind_of(unit.dimension)}")
    return unit


def has_uncertainty(text: str) -> bool:
    """Return whether a text may state an uncertainty or a range: `quantities.uncertain` reads such texts.

    >>> has_uncertainty("25±5 mJ/m2"), has_uncertainty("20 to 30 nm"), has_uncertainty("25 mJ/m2"), has_uncertainty("1e+3 nm")
    (True, True, False, False)
    """
    return any(mark in text for mark in _MARKS)


def is_uncertain(value: Any) -> "TypeGuard[Uncertain]":
    """Return whether a value read from a text has an uncertainty, without an import of the types that have one."""
    return isinstance(value, tuple)


def error_about(
    name: str, text: str, error: BadUnit, dimensions: Collection[Dimension] = (), expected: str = ""
) -> QuantityError:
    """Return the error that says what is wrong with the text of a quantity, or of an option that is none.

    For an option, `dimensions` are those that its unit may have, and `expected` is the right form.
    """
    kind = BareNumber if isinstance(error, NoUnit) else QuantityError
    remedy = error.remedy(dimensions or [dimension_of(NOMENCLATURE[name].unit)])
    return kind(name, text[:MAX_TEXT], str(error), remedy or expected)


def split_number(text: str) -> tuple[int, int, str]:
    """Split a text into the number at its head, as an integer and a power of ten, and the unit after it."""
    match = _NUMBER.match(text)
    assert match is not None  # every part of the pattern is optional
    sign, whole, fraction, exponent = match.groups()
    rest = text[match.end() :]
    digits = whole + (fraction or "")
    if not digits:
        raise BadUnit("does not begin with a number")
    if rest.startswith(","):
        raise BadUnit("has a comma: write a decimal point")
    if has_uncertainty(rest):
        raise BadUnit("has an uncertainty: give the value alone")
    if exponent and len(exponent.lstrip("+-")) > 3:
        raise BadUnit("has an exponent of more than 3 digits")
    return int(sign + digits), int(exponent or 0) - len(fraction or ""), rest.removeprefix(" ")


def ratio(mantissa: int, exponent: int, unit: Unit) -> tuple[int, int]:
    """Return numerator and denominator of mantissa × 10^exponent × unit, in SI units."""
    return mantissa * unit.numerator * 10 ** max(exponent, 0), unit.denominator * 10 ** max(-exponent, 0)


def rounded(numerator: int, denominator: int) -> float:
    """Return the double nearest to a ratio: one division of integers, which Python rounds correctly."""
    try:
        value = numerator / denominator
    except OverflowError:
        raise BadUnit("is too large for a double") from None
    if numerator and not value:
        raise BadUnit("is too small for a double")
    return value
