"""Meanings of unit names in pint, as exact ratios and powers of the SI base units.

The only module that imports pint. It is asked for names that the grammar of `units` has validated, never for texts.
"""

from decimal import Decimal, localcontext
from functools import cache
from typing import Any

BASE_UNITS = ("kilogram", "meter", "second", "ampere", "kelvin", "mole", "candela", "radian")
_DIGITS = 60
_SPEED = (0, 1, -1, 0, 0, 0, 0, 0)


@cache
def registry(number: type = float) -> Any:
    """Return pint's default registry, which computes in a type of number.

    The registry of decimals caches factors with the precision of the context that asked first; only `lookup` uses it.
    """
    import pint

    return pint.UnitRegistry(non_int_type=number)


def lookup(name: str) -> tuple[int, int, tuple[int, ...]] | None:
    """Return numerator, denominator and dimension of a unit name in SI base units; None if pint has no plain factor for it.

    A temperature on a scale with an offset, a logarithmic unit and one outside the SI (a bit, a dollar) have none. Names that
    pint reads as nobody means them are left out: a prefix before a speed (kmph is no kilo-mile per hour) and the yarn count Nm.

    >>> lookup("nm")
    (1, 1000000000, (0, 1, 0, 0, 0, 0, 0, 0))
    """
    with localcontext(prec=_DIGITS):
        exact = registry(Decimal)
        candidates = exact.parse_unit_name(name)
        if not candidates:
            return None
        prefix, unit_name, _ = candidates[0]
        symbol = exact.get_symbol(unit_name)
        is_plural_of_symbol = symbol != unit_name and name.endswith(symbol + "s")  # GPas is no unit of pressure
        try:
            unit = exact.Unit(prefix + unit_name)
            zero, one = (exact.Quantity(Decimal(value), unit).to_root_units() for value in (0, 1))
        except Exception:  # logarithmic units fail in ways of their own; none of them is a plain factor
            return None
        powers = {str(base): power for base, power in one.unit_items()}
        kilogram = powers.pop("gram", 0)
        dimension = (kilogram, *(powers.pop(base, 0) for base in BASE_UNITS[1:]))
        if powers or any(power != int(power) for power in dimension) or zero.magnitude != 0 or one.magnitude <= 0:
            return None
        is_misread = is_plural_of_symbol or unit_name == "number_meter"
        if is_misread or (prefix and dimension == _SPEED and unit_name != "meter_per_second"):
            return None
        factor = Decimal(one.magnitude).scaleb(-3 * int(kilogram))
    numerator, denominator = factor.as_integer_ratio()
    return numerator, denominator, tuple(int(power) for power in dimension)
