"""Two numerical methods for functions of one variable: the highest point of an interval, and a logarithmic slope."""

from collections.abc import Callable
from math import inf, log, nan

from ..errors import JkrollError

_GOLDEN = 0.6180339887498949  # of an interval, the part that a step of the golden-section search keeps
_SEARCHES = 45  # steps of it: they leave 4e-10 of an interval, and all digits of a value that is flat there
_STEP = 1e-6  # relative, of the differences that give a slope


def highest_between(left: float, right: float, height: Callable[[float], float]) -> float:
    """Return where a function with one maximum between two points is highest, by golden-section search."""
    for _ in range(_SEARCHES):
        width = _GOLDEN * (right - left)
        low, high = right - width, left + width
        if height(low) > height(high):
            right = high
        else:
            left = low
    return (left + right) / 2


def logarithmic_slope(outcome: Callable[[float], float], value: float) -> float:
    """Return d ln(outcome)/d ln(value) by central differences, or one-sided ones where the outcomes end.

    It is infinite where the outcome is zero, and nan where there is no outcome on either side.
    """
    points = []
    for factor in (1 / (1 + _STEP), 1.0, 1 + _STEP):
        try:
            points.append((log(factor), outcome(value * factor)))
        except JkrollError:
            continue
    if len(points) < 2:
        return nan
    (first, low), (last, high) = points[0], points[-1]
    middle = outcome(value)
    return (high - low) / (last - first) / middle if middle else inf
