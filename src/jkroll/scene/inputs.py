"""The numbers that a scene takes: the range of each quantity, and magnitudes from which no formula leaves the doubles."""

from typing import Any

from ..quantities.errors import OutOfRange, UnknownQuantity
from ..quantities.nomenclature import INFINITY, NOMENCLATURE, RANGES

LEAST, MOST = 1e-60, 1e60  # of the size of an input in SI units, if it is neither 0 nor infinite
MAGNITUDE = "must lie between 1e-60 and 1e60 in SI units"
_LEAST_ORDINARY, _MOST_ORDINARY = 1e-30, 1e30  # products as high as w²R⁵ξ² of such inputs are normal doubles


def check_range(name: str, value: Any) -> None:
    """Raise OutOfRange for a number, or an array with an element, that a quantity cannot have."""
    if name not in NOMENCLATURE:
        raise UnknownQuantity(name)
    limits = RANGES.get(NOMENCLATURE[name].range)
    if isinstance(value, float | int):
        if limits is not None and not limits.admits(value):
            raise OutOfRange(name, value, limits.words)
        if not _has_magnitude(name, value):
            raise OutOfRange(name, value, MAGNITUDE)
        return
    refused = outside(name, value)
    if refused.any():
        first = value[refused].flat[0].item()
        raise OutOfRange(name, first, limits.words if limits and not limits.admits(first) else MAGNITUDE)


def outside(name: str, values: Any) -> Any:
    """Return which elements of an array a quantity cannot have."""
    import numpy

    if name not in _OF_ANY_SIZE and values.size and values.min() >= LEAST and values.max() <= MOST:
        return numpy.zeros(values.shape, dtype=bool)
    size = abs(values)
    admitted = (name in _OF_ANY_SIZE) | (size >= LEAST) & (size <= MOST) | (size == 0) | (size == INFINITY)
    limits = RANGES.get(NOMENCLATURE[name].range)
    if limits is not None:
        admitted &= values >= limits.low if limits.low_allowed else values > limits.low
        admitted &= values <= limits.high if limits.high_allowed else values < limits.high
    return ~admitted


def is_ordinary(name: str, value: Any) -> bool:
    """Check the range of an input; return whether it is a number because of which no formula can leave the doubles."""
    if isinstance(value, float) and _LEAST_ORDINARY <= value <= _MOST_ORDINARY and name in _SCALED:
        return True
    check_range(name, value)
    if not isinstance(value, float | int):
        return False
    return _LEAST_ORDINARY <= abs(value) <= _MOST_ORDINARY or value in (0, INFINITY) or name in _OF_ANY_SIZE


def _has_magnitude(name: str, value: float) -> bool:
    return LEAST <= abs(value) <= MOST or value in (0, INFINITY) or name in _OF_ANY_SIZE


_OF_ANY_SIZE = ("poisson_ratio", "poisson_ratio2")  # only 1 − ν² enters a formula
_SCALED = NOMENCLATURE.keys() - _OF_ANY_SIZE  # any ordinary positive number is within their range
