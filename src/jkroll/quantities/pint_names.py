"""What pint says a unit name means, as an exact ratio and powers of the SI base units.

The only module that imports pint. It is asked for names that the grammar of `units` has validated, never for texts.
"""

from decimal import Decimal, localcontext
from functools import cache
from typing import Any

BASE_UNITS = ("kilogram", "meter", "second", "ampere", "kelvin", "mole", "candela", "radian")
_DIGITS = 60


@cache
def registry(number: type = float) -> Any:
    """Pint's default registry, in an arithmetic of its own.

    That in decimals keeps what it computes to the digits of the context it was asked in: it is `lookup`'s alone.
    """
    import pint

    return pint.UnitRegistry(non_int_type=number)


def lookup(name: str) -> tuple[int, int, tuple[int, ...]] | None:
    """Numerator, denominator and dimension of a unit name in SI base units; None if pint has no plain factor for it.

    A temperature on a scale with an offset, a logarithmic unit and one outside the SI (a bit, a dollar) have none.

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
        if symbol != unit_name and name.endswith(symbol + "s"):
            return None  # the plural of a symbol: GPas is no unit of pressure
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
        factor = Decimal(one.magnitude).scaleb(-3 * int(kilogram))
    numerator, denominator = factor.as_integer_ratio()
    return numerator, denominator, tuple(int(power) for power in dimension)
