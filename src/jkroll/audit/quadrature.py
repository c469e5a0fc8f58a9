"""Integrals, derivatives and roots by plain arithmetic, so that a check needs no formula of the paper to test one."""

from collections.abc import Callable
from functools import cache
from math import cos, pi, sin, sqrt

Function = Callable[[float], float]

_NODES = 40
_DIRECTIONS = 24


@cache
def _gauss_legendre() -> tuple[tuple[float, float], ...]:
    """Nodes and weights on −1 … 1: the roots of a Legendre polynomial, by Newton's method."""
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
    """Integral of a smooth function."""
    middle, half = (low + high) / 2, (high - low) / 2
    return half * sum(weight * function(middle + half * node) for node, weight in _gauss_legendre())


def to_rim(function: Function, a: float) -> float:
    """Integral from 0 to a of a function that may have a square root at a, above or below a fraction line."""
    return integral(lambda angle: function(a * sin(angle)) * a * cos(angle), 0, pi / 2)


def across(function: Function, a: float) -> float:
    """Integral from −a to a of a function that may have a square root at both ends."""
    return to_rim(lambda s: function(s) + function(-s), a)


def over_disc(function: Callable[[float, float], float], a: float) -> float:
    """Integral over a circle of a function of x and y that may have a square root at the rim."""
    turn = 2 * pi / _DIRECTIONS
    angles = [(place + 0.5) * turn for place in range(_DIRECTIONS)]
    return to_rim(lambda r: turn * r * sum(function(r * cos(angle), r * sin(angle)) for angle in angles), a)


def principal_value(function: Function, x: float, a: float) -> float:
    """Cauchy principal value of the integral of f(s)/(√(a² − s²)(x − s)) from −a to a, for a smooth f and |x| < a.

    That of a constant f is 0, so that f(x) may be taken off and no singularity remains.
    """
    at_x = function(x)
    nodes = [a * cos(pi * (place + 0.5) / _NODES) for place in range(_NODES)]
    return pi / _NODES * sum((function(s) - at_x) / (x - s) for s in nodes)


def slope(function: Callable[[complex], complex], x: float) -> float:
    """Derivative, by a step so small and imaginary that nothing cancels."""
    step = 1e-30
    return function(complex(x, step)).imag / step


def first_order(function: Function, step: float) -> float:
    """Derivative at 0 of an odd function, to the third order of the step."""
    return (8 * function(step) - function(2 * step)) / (6 * step)


def root(function: Function, low: float, high: float) -> float:
    """Where a function that is negative at one end and positive at the other vanishes."""
    rising = function(high) > 0
    for _ in range(60):
        middle = (low + high) / 2
        low, high = (low, middle) if (function(middle) > 0) == rising else (middle, high)
    return (low + high) / 2


def lowest(function: Function, low: float, high: float) -> float:
    """Least value of a function with one minimum."""
    golden = (sqrt(5) - 1) / 2
    for _ in range(50):
        left, right = high - golden * (high - low), low + golden * (high - low)
        low, high = (low, right) if function(left) < function(right) else (left, high)
    return function((low + high) / 2)


def nearest(value: float, low: float, high: float) -> float:
    """The number of a range that is nearest to a value: the value itself if it is inside."""
    return min(max(value, low), high)
