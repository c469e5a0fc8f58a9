"""Text to SI numbers and back: a strict grammar, exact arithmetic, and pint as the authority on what a name means.

A text is one decimal number and at most eight unit names with whole powers; nothing else is a quantity. pint never sees
a user's text: it is asked what a single, validated name means, and only if the shipped table (made from pint) does
not have it. Every value is computed as a ratio of integers and rounded to a double once.
"""

import re
from functools import cache, lru_cache
from typing import NamedTuple

from .errors import AmbiguousUnit, MalformedQuantity, UnknownUnit
from .unit_table import BASE_UNITS, PLAIN, PREFIXABLE, PREFIXES

MAX_TERMS = 8
MAX_NAME = 24
MAX_POWER = 12

Dimension = tuple[int, ...]
NUMBER: Dimension = (0,) * len(BASE_UNITS)


class Unit(NamedTuple):
    """A unit as numerator/denominator times SI base units to the powers of `dimension`."""

    numerator: int
    denominator: int
    dimension: Dimension


# Characters that mean the same as one of ours. Whatever else is outside the grammar is refused.
_SAME = str.maketrans(
    {"−": "-", "·": "*", "⋅": "*", "×": "*", "μ": "u", "µ": "u", "\u212b": "Å"}
    | dict.fromkeys("\t\u00a0\u2009\u200a\u202f\u2002\u2003\u2007\u2008", " ")
)
_SUPERSCRIPTS = str.maketrans("⁰¹²³⁴⁵⁶⁷⁸⁹⁻⁺", "0123456789-+")
_TERM = re.compile(r"([A-Za-zÅ°%_]+)(?: ?(?:\^|\*\*) ?([+-]?[0-9]+)|([+-]?[0-9]+)|([⁺⁻]?[⁰¹²³⁴⁵⁶⁷⁸⁹]+))?")
_SEPARATOR = re.compile(r" ?([*/]) ?| ")


def dimension_of(unit: str) -> Dimension:
    """Dimension of an SI unit as the nomenclature writes it, such as "N m" or "1"."""
    return si_unit(unit).dimension


@cache
def si_unit(unit: str) -> Unit:
    """Read a unit of the nomenclature."""
    return Unit(1, 1, NUMBER) if unit in ("1", "") else _parse_unit(unit, unit, unit)


def kind_of(dimension: Dimension) -> str:
    """What a dimension is called: "a length".

    >>> kind_of(dimension_of("N"))
    'a force'
    """
    return _kinds().get(dimension, "a quantity of another dimension")


@cache
def _kinds() -> dict[Dimension, str]:
    kinds = """1: a number; m: a length; kg: a mass; s: a time; K: a temperature; A: an electric current; rad: an angle; V: a voltage;
    m^2: an area; m^3: a volume; m/s: a speed; m/s^2: an acceleration; kg/m^3: a mass density; kg m^2: a moment of inertia;
    N: a force; J: an energy; W: a power; Pa: a pressure; J/m^2: a surface energy; Hz: a frequency; rad/s: an angular speed"""
    return {dimension_of(unit.strip()): kind for unit, kind in (pair.split(": ") for pair in kinds.split(";"))}


def convert(value: float, unit: Unit) -> float:
    """Express an SI value in another unit, rounded once.

    >>> convert(0.25, si_unit("N"))
    0.25
    """
    numerator, denominator = value.as_integer_ratio()
    try:
        return numerator * unit.denominator / (denominator * unit.numerator)
    except OverflowError:
        return float("inf") if value > 0 else float("-inf")


def _parse_unit(text: str, name: str, original: str) -> Unit:
    """Read unit names with whole powers, joined by `*`, `/` or a space."""
    numerator, denominator, dimension = 1, 1, NUMBER
    position, sign, divided, terms = 0, 1, False, 0
    if text.startswith(("1/", "1 /", "/")):
        position, sign, divided = text.index("/") + 1, -1, True
        position += text[position : position + 1] == " "
    while position < len(text) or sign < 0:
        match = _TERM.match(text, position)
        if match is None:
            raise MalformedQuantity(name, original, "is not a number and a unit")
        position = match.end()
        factor = _named(match[1], name, original)
        power_text = match[2] or match[3] or (match[4] or "1").translate(_SUPERSCRIPTS)
        power = sign * int(power_text) if len(power_text) <= 3 else MAX_POWER + 1
        terms += 1
        if abs(power) > MAX_POWER or terms > MAX_TERMS:
            raise MalformedQuantity(name, original, f"has more than {MAX_TERMS} units or a power above {MAX_POWER}")
        up, down = (factor.numerator, factor.denominator) if power > 0 else (factor.denominator, factor.numerator)
        numerator, denominator = numerator * up ** abs(power), denominator * down ** abs(power)
        dimension = tuple(total + power * one for total, one in zip(dimension, factor.dimension, strict=True))
        if position == len(text):
            break
        separator = _SEPARATOR.match(text, position)
        if separator is None or separator.end() == len(text):
            raise MalformedQuantity(name, original, "is not a number and a unit")
        if divided and separator[1] is None:
            raise AmbiguousUnit(name, original, text[: separator.start()], text[separator.end() :])
        sign = -1 if separator[1] == "/" else 1
        divided = divided or sign < 0
        position = separator.end()
    return Unit(numerator, denominator, dimension)


def _named(unit_name: str, name: str, original: str) -> Unit:
    """What one unit name means: as the shipped table has it, else as pint does."""
    unit = _in_table(unit_name)
    if unit is None and len(unit_name) <= MAX_NAME:
        unit = _in_pint(unit_name)
    if unit is None:
        raise UnknownUnit(name, original, unit_name)
    return unit


def _in_table(unit_name: str) -> Unit | None:
    found = PLAIN.get(unit_name) or PREFIXABLE.get(unit_name)
    if found is not None:
        return Unit(*found)
    for length in range(1, len(unit_name)):
        power_of_ten = PREFIXES.get(unit_name[:length])
        found = PREFIXABLE.get(unit_name[length:])
        if power_of_ten is not None and found is not None:
            numerator, denominator, dimension = found
            if power_of_ten > 0:
                return Unit(numerator * 10**power_of_ten, denominator, dimension)
            return Unit(numerator, denominator * 10**-power_of_ten, dimension)
    return None


@lru_cache(maxsize=1000)
def _in_pint(unit_name: str) -> Unit | None:
    """Pint's meaning of a single validated name; None for a name it does not know or that is not a plain factor."""
    from .pint_names import lookup

    found = lookup(unit_name)
    return None if found is None else Unit(*found)
