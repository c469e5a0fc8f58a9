"""The numbers that a frame takes as inputs, and those that it gives as results."""

from math import isfinite
from typing import Any

from ..physics.elementary import NUMBER
from ..quantities.nomenclature import INFINITY, NOMENCLATURE, UP_TO_INFINITE, UnknownQuantity
from ..quantities.values import QuantityError
from .plan import formula_of

# --- Numbers that a frame takes ---------------------------------------------------------------------------------------

LEAST, MOST = 1e-30, 1e30  # of the size of an input in SI units; one that may be 0 may be smaller


def check_range(name: str, value: Any) -> None:
    """Raise QuantityError for a number, or an array with an element, that a quantity cannot have."""
    if name not in NOMENCLATURE:
        raise UnknownQuantity(name)
    place: tuple[int, ...] = ()
    if not isinstance(value, NUMBER):
        if value.size and all(abs(end) <= MOST and takes(name, end) for end in (value.min(), value.max())):
            return  # as nearly always: a range takes all between two of its values
        are_refused = ~takes(name, value)
        if not are_refused.any():
            return
        place = tuple(places[0].item() for places in are_refused.nonzero())
        value = value[place].item()
    if not takes(name, value):
        limits = NOMENCLATURE[name].range
        words = "must lie between 1e-30 and 1e30 in SI units" if limits.admits(value) else limits.words
        raise QuantityError(name, value, words if isfinite(value) else "must be finite", position=place)


def takes(name: str, value: Any) -> Any:
    """Return whether a frame takes a number, or each element of an array, as the value of a quantity."""
    limits, size = NOMENCLATURE[name].range, abs(value)
    if isinstance(value, NUMBER) and LEAST <= size <= MOST:  # as nearly always
        return limits.admits(value)
    is_large_enough = (size >= LEAST) | limits.admits(0.0)
    is_small_enough = (size <= MOST) | (value == INFINITY)
    return limits.admits(value) & is_large_enough & is_small_enough


# --- Numbers that a frame gives ---------------------------------------------------------------------------------------

SMALLEST = 2.2250738585072014e-308  # of the doubles that have all their digits
# The quantities of sphere 2 that are infinite for a plane, such as its mass.
OF_A_PLANE = [
    name for name, quantity in NOMENCLATURE.items()
    if quantity.range is UP_TO_INFINITE and quantity.sphere == 2 and formula_of(name) is not None
]  # fmt: skip


def is_answer(name: str, value: Any) -> Any:
    """Return whether doubles are results with all digits, or a zero or an infinity that the physics has."""
    size = abs(value)
    has_digits = size >= SMALLEST
    if name not in OF_A_PLANE:
        has_digits = has_digits & (size < INFINITY)
    return has_digits | (size == 0) if NOMENCLATURE[name].may_be_zero else has_digits
