"""The ranges of numbers that a `Frame`, two spheres and their quantities, accepts as inputs and gives as results."""

from math import isfinite, isnan
from typing import Any

from ..physics.elementary import NUMBER
from ..quantities.nomenclature import INFINITY, NOMENCLATURE, UP_TO_INFINITE, UnknownQuantity
from ..quantities.values import QuantityError
from .plan import formula_of

# --- Inputs -----------------------------------------------------------------------------------------------------------

# Magnitudes of inputs in SI units. Smaller ones are accepted for an input that may be 0, and ∞ for one that may be ∞.
LEAST, MOST = 1e-30, 1e30


def check_range(name: str, value: Any) -> None:
    """Raise QuantityError if a number, or any element of an array, is outside the range of a quantity.

    Raises UnknownQuantity for a name outside the nomenclature.
    """
    if name not in NOMENCLATURE:
        raise UnknownQuantity(name)
    position: tuple[int, ...] = ()
    if not isinstance(value, NUMBER):
        if value.size and all(abs(end) <= MOST and takes(name, end) for end in (value.min(), value.max())):
            return  # a range that contains the least and the largest number contains all numbers
        are_refused = ~takes(name, value)
        if not are_refused.any():
            return
        position = tuple(indices[0].item() for indices in are_refused.nonzero())
        value = value[position].item()
    if not takes(name, value):
        raise QuantityError(name, value, _problem_of(name, value), position=position)


def _problem_of(name: str, value: float) -> str:
    """Return the reason why a number is refused."""
    limits = NOMENCLATURE[name].range
    if isnan(value):
        return "must be a number"
    if not isfinite(value) and not limits.admits(INFINITY):
        return "must be finite"
    if not limits.admits(value):
        return limits.words
    if limits.admits(0.0):
        return "must have a magnitude of at most 1e30 in SI units"
    return "must lie between 1e-30 and 1e30 in SI units"


def takes(name: str, value: Any) -> Any:
    """Return whether a frame accepts a number as the value of a quantity, element by element for arrays."""
    limits, size = NOMENCLATURE[name].range, abs(value)
    if isinstance(value, NUMBER) and LEAST <= size <= MOST:  # true of most inputs
        return limits.admits(value)
    is_large_enough = (size >= LEAST) | limits.admits(0.0)
    is_small_enough = (size <= MOST) | (value == INFINITY)
    return limits.admits(value) & is_large_enough & is_small_enough


# --- Results ----------------------------------------------------------------------------------------------------------

SMALLEST = 2.2250738585072014e-308  # the smallest double of full precision
# Quantities of sphere 2 that are infinite for a plane, such as the mass.
OF_A_PLANE = [
    name for name, quantity in NOMENCLATURE.items()
    if quantity.range is UP_TO_INFINITE and quantity.sphere == 2 and formula_of(name) is not None
]  # fmt: skip


def is_answer(name: str, value: Any) -> Any:
    """Return whether doubles are valid results: normal numbers, or zero or infinity where the quantity allows it."""
    size = abs(value)
    is_valid = size >= SMALLEST
    if name not in OF_A_PLANE:
        is_valid = is_valid & (size < INFINITY)
    return is_valid | (size == 0) if NOMENCLATURE[name].may_be_zero else is_valid
