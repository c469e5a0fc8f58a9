"""Integrals, derivatives and roots by plain arithmetic, so that a check needs no formula of the paper to test one."""

from collections.abc import Callable
from functools import cache
from math import cos, pi, sin, sqrt

Function = Callable[[float], float]

_NODES = 40
_DIRECTIONS = 24


@cache
def _gauss_legendre() -> tuple[tuple[float, float], ...]:
    """Return the nodes and weights on −1 … 1: the roots of a Legendre polynomial, by Newton's method."""
    rule = []
    for place in range(_NODES):
        node = cos(pi * (place + 0.75) / (_NODES + 0.5))
        for _ in range(6):
            before, value = 1.0, node
            for degree in range(2, _NODES + 1):
                before, value = value, ((2 * degree - 1) * node * value - (degree - 1) * before) / degree
            slope = _NODES * (node * value - before) / (node * node - 1)
            node -= value / slope
        rule.append((node, 2 / ((1 - node * node) * slope * slope)))
    return tuple(rule)


def integral(function: Function, low: float, high: float) -> float:
    """Return the integral of a smooth function."""
    middle, half = (low + high) / 2, (high - low) / 2
    return half * sum(weight * function(middle + half * node) for node, weight in _gauss_legendre())


def to_rim(function: Function, a: float) -> float:
    """Return the integral from 0 to a of a function with a factor √(a − s), or 1/√(a − s), if any."""
    return integral(lambda angle: function(a * sin(angle)) * a * cos(angle), 0, pi / 2)


def across(function: Function, a: float) -> float:
    """Return the integral from −a to a of a function with such a factor at both ends, if any."""
    return to_rim(lambda s: function(s) + function(-s), a)


def over_disc(function: Callable[[float, float], float], a: float) -> float:
    """Return the integral over a circle of a function of x and y with such a factor at the rim, if any."""
    turn = 2 * pi / _DIRECTIONS
    angles = [(place + 0.5) * turn for place in range(_DIRECTIONS)]
    return to_rim(lambda r: turn * r * sum(function(r * cos(angle), r * sin(angle)) for angle in angles), a)


def principal_value(function: Function, x: float, a: float) -> float:
    """Return the Cauchy principal value of ∫ f(s)/(√(a² − s²)(x − s)) ds from −a to a, for a smooth f and |x| < a.

    For a constant f it is 0. So f(x) is subtracted, and no singularity remains.
    """
    at_x = function(x)
    nodes = [a * cos(pi * (place + 0.5) / _NODES) for place in range(_NODES)]
    return pi / _NODES * sum((function(s) - at_x) / (x - s) for s in nodes)


def slope(function: Callable[[complex], complex], x: float) -> float:
    """Return the derivative by a complex step, in which nothing cancels."""
    step = 1e-30
    return function(complex(x, step)).imag / step


def first_order(function: Function, step: float) -> float:
    """Return the derivative at 0 of an odd function, to the third order of the step."""
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
