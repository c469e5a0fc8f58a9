"""The numbers that a scene gives: results that doubles hold with all digits, and zeros where the physics has them."""

from typing import Any

from ..quantities.nomenclature import INFINITY, NOMENCLATURE

SMALLEST = 2.2250738585072014e-308  # of the doubles that have all their digits
MAY_BE_ZERO = frozenset(name for name, quantity in NOMENCLATURE.items() if quantity.may_be_zero)


def is_zero(name: str, value: float) -> bool:
    """Return whether a result is the zero that its quantity may be."""
    return value == 0 and name in MAY_BE_ZERO


def are_answers(name: str, values: Any) -> Any:
    """Return which elements of an array doubles hold with all digits, or are the zero that the quantity may be."""
    size = abs(values)
    fine = (size >= SMALLEST) & (size < INFINITY)
    return fine | (size == 0) if name in MAY_BE_ZERO else fine


def with_nan(name: str, values: Any) -> Any:
    """Return an array with nan in place of the elements that are no answer."""
    import numpy

    size = abs(values)
    if size.size and size.min() >= SMALLEST and size.max() < INFINITY:
        return values
    return numpy.where(are_answers(name, values), values, numpy.nan)
