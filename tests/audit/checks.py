"""Checks: each compares a claim of the paper with the number that follows from the paper's premises.

Integrals, derivatives and roots are computed by plain arithmetic, so that a check of one formula needs no other formula
of the paper.
"""

from collections.abc import Callable
from math import cos, pi, sin, sqrt
from typing import Literal, NamedTuple

import numpy

Verdict = Literal["holds", "sign", "misprint", "wrong", "approximate"]
Terms = float | tuple[float, ...]  # one number, or several: the terms of a sum, the ends of a range, or cases

ROUNDING = 1e-9  # largest relative difference of two routes to one number


class Check(NamedTuple):
    """A claim of the paper: the printed number, and the number that follows from the premises."""

    equation: str  # numbers of equations, or the place in the prose
    claim: str
    expected: Verdict
    reason: str
    printed: Terms
    follows: Terms
    restated: Terms | None = None  # the claim as the paper prints it again elsewhere
    within: float = ROUNDING  # relative difference admitted by the printed digits or the order of a series
    hedge: float = 1.0  # factor admitted by an "about" or a "≈" of the paper

    @property
    def verdict(self) -> Verdict:
        """The verdict that the numbers give."""
        printed, follows = _terms(self.printed), _terms(self.follows)
        if _agree(printed, follows, self.within):
            return "holds"
        if _agree(tuple(map(abs, printed)), tuple(map(abs, follows)), self.within):
            return "sign"
        if self.restated is not None and _agree(_terms(self.restated), follows, self.within):
            return "misprint"
        if all(1 <= self.hedge * one / other <= self.hedge**2 for one, other in zip(printed, follows, strict=True)):
            return "approximate"
        return "wrong"

    @property
    def numbers(self) -> tuple[float, float]:
        """The printed number and the number that follows; of several pairs, the pair that differs most."""
        pairs = zip(_terms(self.printed), _terms(self.follows), strict=True)
        return max(pairs, key=lambda pair: _difference(*pair))


def _terms(value: Terms) -> tuple[float, ...]:
    return value if isinstance(value, tuple) else (value,)


def _difference(printed: float, follows: float) -> float:
    return abs(printed - follows) / abs(follows)


def _agree(printed: tuple[float, ...], follows: tuple[float, ...], within: float) -> bool:
    return all(_difference(one, other) <= within for one, other in zip(printed, follows, strict=True))


# --- Integrals, derivatives and roots ---------------------------------------------------------------------------------

Function = Callable[[float], float]

_NODES = 40  # of Gauss' rule, each with its weight
_RULE: list[tuple[float, float]] = [
    *zip(*map(numpy.ndarray.tolist, numpy.polynomial.legendre.leggauss(_NODES)), strict=True)
]
_DIRECTIONS = 24  # of the radii along which `over_disc` integrates


def integral(function: Function, low: float, high: float) -> float:
    """Return the integral of a smooth function."""
    middle, half = (low + high) / 2, (high - low) / 2
    return half * sum(weight * function(middle + half * node) for node, weight in _RULE)


def to_rim(function: Function, a: float) -> float:
    """Return the integral from 0 to a of a function that may have a factor √(a − s) or 1/√(a − s)."""
    return integral(lambda angle: function(a * sin(angle)) * a * cos(angle), 0, pi / 2)


def across(function: Function, a: float) -> float:
    """Return the integral from −a to a of a function that may have a factor √(a² − s²) or 1/√(a² − s²)."""
    return to_rim(lambda s: function(s) + function(-s), a)


def over_disc(function: Callable[[float, float], float], a: float) -> float:
    """Return the integral over a circle of a function of x and y that may have a factor √(a − r) or 1/√(a − r)."""
    turn = 2 * pi / _DIRECTIONS
    angles = [(index + 0.5) * turn for index in range(_DIRECTIONS)]
    return to_rim(lambda r: turn * r * sum(function(r * cos(angle), r * sin(angle)) for angle in angles), a)


def principal_value(function: Function, x: float, a: float) -> float:
    """Return the Cauchy principal value of ∫ f(s)/(√(a² − s²)(x − s)) ds from −a to a, for a smooth f and |x| < a.

    The value is 0 for a constant f. So f(x) is subtracted, which removes the singularity.
    """
    at_x = function(x)
    nodes = [a * cos(pi * (index + 0.5) / _NODES) for index in range(_NODES)]
    return pi / _NODES * sum((function(s) - at_x) / (x - s) for s in nodes)


def slope(function: Callable[[complex], complex], x: float) -> float:
    """Return the derivative by a complex step, which cancels no digits."""
    step = 1e-30
    return function(complex(x, step)).imag / step


def first_order(function: Function, step: float) -> float:
    """Return the derivative at 0 of an odd function; its cubic term leaves no error."""
    return (8 * function(step) - function(2 * step)) / (6 * step)


def root(function: Function, low: float, high: float) -> float:
    """Return a root of a function that changes sign between two ends, by bisection."""
    rising = function(high) > 0
    for _ in range(60):
        middle = (low + high) / 2
        low, high = (low, middle) if (function(middle) > 0) == rising else (middle, high)
    return (low + high) / 2


def lowest(function: Function, low: float, high: float) -> float:
    """Return the least value of a function with one minimum, by golden-section search."""
    golden = (sqrt(5) - 1) / 2
    for _ in range(50):
        left, right = high - golden * (high - low), low + golden * (high - low)
        low, high = (low, right) if function(left) < function(right) else (left, high)
    return function((low + high) / 2)


def nearest(value: float, low: float, high: float) -> float:
    """Return the number of a range that is nearest to a value."""
    return min(max(value, low), high)
