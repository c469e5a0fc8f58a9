"""Text to SI numbers: a strict grammar and exact arithmetic."""

import re

from .errors import BareNumber, MalformedQuantity, WrongDimension
from .nomenclature import NOMENCLATURE, RANGES, word_for_infinity
from .units import _SAME, Unit, _parse_unit, dimension_of

MAX_TEXT = 80


_NUMBER = re.compile(r"([+-]?)([0-9]*)(?:\.([0-9]*))?(?:[eE]([+-]?[0-9]+))?")


_KNOWN: dict[str, Unit] = {}  # units that were read: the values of a file have few


MAX_KNOWN = 1000


def parse_quantity(text: str, name: str) -> float:
    """Read the value of a quantity of the nomenclature, in SI units, correctly rounded.

    >>> parse_quantity("0.1 µm", "radius")
    1e-07

    Raises a `QuantityError` that names the quantity, quotes the text and shows the right form.
    """
    quantity = NOMENCLATURE[name]
    stripped = text.strip()
    if (word := word_for_infinity(name)) is not None and stripped.lower() == word:
        return float("inf")
    if len(text) > MAX_TEXT:
        raise MalformedQuantity(name, text[:MAX_TEXT], f"is longer than {MAX_TEXT} characters")
    mantissa, exponent, rest = _split_number(stripped.translate(_SAME), name, text)
    wanted = dimension_of(quantity.unit)
    if not rest and any(wanted):
        raise BareNumber(name, text)
    unit = _KNOWN.get(rest)
    if unit is None:
        unit = _parse_unit(rest, name, text)
        if len(_KNOWN) < MAX_KNOWN:
            _KNOWN[rest] = unit
    if unit.dimension != wanted:
        raise WrongDimension(name, text, unit.dimension)
    value = _rounded(mantissa, exponent, unit, name, text)
    limits = RANGES.get(quantity.range)
    if limits is not None and not limits.admits(value):
        raise MalformedQuantity(name, text, limits.words)
    return value


def unit_of(text: str, name: str) -> Unit:
    """Read a unit into which a quantity of the nomenclature is to be converted."""
    if len(text) > MAX_TEXT:
        raise MalformedQuantity(name, text[:MAX_TEXT], f"is longer than {MAX_TEXT} characters")
    return _parse_unit(text.strip().translate(_SAME), name, text)


def _split_number(text: str, name: str, original: str) -> tuple[int, int, str]:
    """The number at the head of a text as an integer times a power of ten, and what follows it."""
    match = _NUMBER.match(text)
    assert match is not None  # every part of the pattern is optional
    sign, whole, fraction, exponent = match.groups()
    rest = text[match.end() :]
    digits = whole + (fraction or "")
    if not digits:
        raise MalformedQuantity(name, original, "does not begin with a number")
    if rest.startswith(","):
        raise MalformedQuantity(name, original, "has a comma: write a decimal point")
    if rest[:1] in ("(", "±"):
        raise MalformedQuantity(name, original, "has an uncertainty: give the value alone")
    if exponent and len(exponent.lstrip("+-")) > 3:
        raise MalformedQuantity(name, original, "has an exponent of more than 3 digits")
    mantissa = int(sign + digits)
    return mantissa, int(exponent or 0) - len(fraction or ""), rest.removeprefix(" ")


def _rounded(mantissa: int, exponent: int, unit: Unit, name: str, original: str) -> float:
    """The double nearest to mantissa × 10^exponent × unit: one division of integers, which Python rounds correctly."""
    numerator, denominator = mantissa * unit.numerator, unit.denominator
    if exponent < 0:
        denominator *= 10**-exponent
    else:
        numerator *= 10**exponent
    try:
        value = numerator / denominator
    except OverflowError:
        raise MalformedQuantity(name, original, "is too large for a double") from None
    if mantissa and not value:
        raise MalformedQuantity(name, original, "is too small for a double")
    return value
