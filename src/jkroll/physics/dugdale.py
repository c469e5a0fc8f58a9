"""The curve of a Maugis contact in dimensionless form: Dugdale's constant traction in a ring around the contact circle.

The traction σ0 acts for a < r < c, where the gap is below w/σ0. Lengths along the surface are in units of
(πwR²/K)^(1/3), approaches of (π²w²R/K²)^(1/3), loads of πwR, with K = 4E*/3; λ = 2σ0/(πwK²/R)^(1/3).

Maugis (J. Colloid Interface Sci. 150, 243, 1992) has two equations for a and c at a load. Here one variable describes a
state, the edge ratio v = a/√(c² − a²): it is large where the ring is narrow (JKR), small where the ring is wide (DMT), and
0 where the spheres do not touch. All else is explicit in v, and so are both extremes of the curve:

    T = √(c² − a²) = 1/(⅔λ²G2 + √((⅔λ²G2)² + λG1/2))    a = vT    c = nT    q = 4λ/(3T)
    P = a³ − λT²G3    δ = a² − (4/3)λT    dP/dδ = (3/2)T(vG3 − qD)/(G3 − qh)
    pull-off: q = vG3/D    fold, where fixed grips let go: q = G3/h

    n = √(1 + v²)    θ = arctan(1/v)    h = tan(θ/2) = 1/(n + v)
    G1 = v + (1 − v²)θ    G2 = θ − h    G3 = v + n²θ    D = vh + n²θ²
"""

import math
from collections.abc import Callable
from typing import Any, NamedTuple

from .elementary import cbrt, pi, sqrt, where, within

FOLD_WITHOUT_CONTACT = 0.9379474572107123  # (9π/(16(π − 1)))^(1/3): below, a vanishes before fixed grips let go
JUMP_WITHOUT_CONTACT = 0.6551853485522241  # (9/32)^(1/3): below, approaching spheres attract before they touch

# Steps of Newton's method, each of which squares the error: one less leaves 5e-15 of an extreme and, for
# a load of 10⁶ times the pull-off force, 2e-10 of a state.
_EXTREME_STEPS = 3
_STATE_STEPS = 5

_NARROW = 0.2
_LAG_COEFFICIENTS = tuple(4 * k / (4 * k * k - 1) for k in range(12, 0, -1))


def length_unit(work_of_adhesion: Any, reduced_radius: Any, contact_modulus: Any) -> Any:
    """Return the unit of lengths along the surface, (πwR²/K)^(1/3)."""
    return cbrt(3 / 4 * pi * (work_of_adhesion / contact_modulus) * reduced_radius * reduced_radius)


class Shape(NamedTuple):
    """The functions of the edge ratio that the module names."""

    v: Any
    n: Any
    theta: Any
    h: Any
    lag: Any
    g1: Any
    g2: Any
    g3: Any
    d: Any


def shape(edge_ratio: Any) -> Shape:
    """Return the functions of an edge ratio v ≥ 0."""
    v = edge_ratio
    n = sqrt(1 + v * v)
    h = 1 / (n + v)
    theta = 2 * _arctan(h)
    lag = where(h < _NARROW, _lag_of_narrow(h), 1 - v * theta)
    g3 = v * (2 - lag) + theta
    return Shape(v, n, theta, h, lag, v * lag + theta, theta - h, g3, v * h + (g3 - v) * theta)


def _lag_of_narrow(h: Any) -> Any:
    """Return 1 − vθ where its terms are almost equal: Σ (−1)^(k+1) 4k/(4k² − 1) h^(2k), to 1e-17."""
    square = h * h
    total = 0.0
    for coefficient in _LAG_COEFFICIENTS:
        total = (coefficient - total) * square
    return total


def span(transition: Any, at: Shape) -> Any:
    """Return T of a contact, from λ and its shape."""
    half = 2 / 3 * (transition * transition) * at.g2
    return 1 / (half + sqrt(half * half + transition / 2 * at.g1))


def span_apart(transition: Any, approach: Any) -> Any:
    """Return T of spheres that attract without contact, where it is c.

    c²/2 − bc = δ + 2/(πλ), b = 8λ/3π; fixed grips hold the larger root.
    """
    b = 8 / (3 * pi) * transition
    square = b * b + 2 * (approach + 2 / (pi * transition))
    return b + sqrt(_at_least(square, 0.0))


def load(transition: Any, at: Shape, span: Any) -> Any:
    """Return P, in contact or apart."""
    square = span * span
    return square * (at.v * at.v * at.v * span - transition * at.g3)


def approach(transition: Any, at: Shape, span: Any) -> Any:
    """Return δ of a contact."""
    touching = at.v * span
    return touching * touching - 4 / 3 * transition * span


def stiffness(transition: Any, at: Shape, span: Any) -> Any:
    """Return dP/dδ, in contact or apart; it is 0 at pull-off, below 0 where only fixed grips hold the spheres."""
    return 3 / 2 * span * stiffness_ratio(at, 4 / 3 * transition / span)


def stiffness_ratio(at: Shape, q: Any) -> Any:
    """Return dP/dδ over that of a flat punch of radius T: v without attraction, −∞ at the fold."""
    give = at.g3 - q * at.h
    at_fold = give == 0
    return where(at_fold, -math.inf, (at.v * at.g3 - q * at.d) / where(at_fold, 1.0, give))


def energy(transition: Any, at: Shape, span: Any, approach: Any) -> Any:
    """Return the elastic and surface energy Φ, in contact or apart: dΦ = P dδ, and 0 for spheres that do not attract.

    Φ = ¾(aδ² − ⅔a³δ + a⁵/5) − c² + λT⁴(θ − v + (2v + 3v³)(1 − vθ))/4 + λT²(n²θ − v)(a² − δ) − (4/9)λ²T³(v + 2n)h²
    """
    v, n, theta = at.v, at.n, at.theta
    touching, outside, square = v * span, n * span, span * span
    spread = touching * touching
    punch = touching * (approach * (approach - 2 / 3 * spread) + spread * spread / 5)
    ring = theta - v + v * at.lag * (2 + 3 * v * v)
    pull = (theta - v * at.lag) * (spread - approach)
    inner = 4 / 9 * transition * span * (v + 2 * n) * at.h * at.h
    return 3 / 4 * punch - outside * outside + transition * square * (square * ring / 4 + pull - inner)


# --- Extremes -------------------------------------------------------------------------------------------------------


def pull_off_ratio(transition: Any) -> Any:
    """Return v where the tension is largest."""
    start = 1.3103706971044482 + (0.2903 / transition - 0.802) / (1 + transition * (1.413 + 1.186 * transition))
    v = transition / sqrt(start)
    for _ in range(_EXTREME_STEPS):
        at = shape(v)
        d_slope = at.h * (1 - v / at.n) + 2 * at.theta * (v * at.theta - 1)
        growth = 1 / v + 2 * v * at.theta / at.g3 - d_slope / at.d
        v = _step_to(transition, at, v * at.g3 / at.d, growth)
    return v


def fold_ratio(transition: Any) -> Any:
    """Return v where fixed grips let go; 0 where they hold on to spheres that no longer touch."""
    beyond = _at_least(transition - FOLD_WITHOUT_CONTACT, 0.0)
    difference = beyond - 0.46
    v = (difference + sqrt(difference * difference + 6.6 * beyond)) / 3.3
    for _ in range(_EXTREME_STEPS):
        at = shape(v)
        v = _at_least(_step_to(transition, at, at.g3 / at.h, 2 * v * at.theta / at.g3 + 1 / at.n), 0.0)
    return where(beyond > 0, v, 0.0)


def lowest_approach(transition: Any) -> Any:
    """Return δ at the fold, in contact or apart."""
    v = fold_ratio(transition)
    at = shape(v)
    b = 8 / (3 * pi) * transition
    apart = -b * b / 2 - 2 / (pi * transition)
    return where(v > 0, approach(transition, at, span(transition, at)), apart)


def _step_to(transition: Any, at: Shape, q: Any, growth: Any) -> Any:
    """Return v after a step of Newton's method towards the v whose extreme belongs to λ.

    λ = ¾qT with T³ = 8/(3q(G1 + 2qG2)) is the one whose extreme is at v; `growth` is d ln q/dv.
    """
    v, n = at.v, at.n
    g = at.g1 + 2 * q * at.g2
    own = cbrt(9 / 8 * q * q / g)
    g1_slope = 2 * v * (v / (n * n) - at.theta)
    g2_slope = at.h / n - 1 / (n * n)
    slope = own * (2 * growth - (g1_slope + 2 * q * (growth * at.g2 + g2_slope)) / g) / 3
    return v + (transition - own) / slope


# --- States ---------------------------------------------------------------------------------------------------------


def ratio_at_load(transition: Any, load_in_units: Any) -> Any:
    """Return v of the stable contact at a load; there is none beyond pull-off."""
    least = pull_off_ratio(transition)
    at = shape(least)
    pull_off = -load(transition, at, span(transition, at))
    excess = (load_in_units + pull_off) / pull_off
    excess = within(excess >= 0, excess)
    root = sqrt(transition)
    cube = root * transition
    scale = cube / (cube + 0.5 + 2.4 * root / (1 + 4 * transition))
    start = least * (1 + sqrt(excess) / scale) ** ((1 + 1 / ((1 + root) * (1 + root))) / 3)
    start = where(excess > 1e6, _no_wider(start, transition, cbrt(_at_least(load_in_units, 0.0))), start)

    def curve(at: Shape) -> tuple[Any, Any]:
        wide = span(transition, at)
        q = 4 / 3 * transition / wide
        slope = 3 / 2 / pull_off * wide * (at.v * at.g3 - q * at.d) * _stretch(at, wide, q)
        return load(transition, at, wide) / pull_off + 1, slope

    return _root(curve, excess, start, least)


def ratio_at_approach(transition: Any, approach_in_units: Any) -> Any:
    """Return v of the state that fixed grips hold at an approach: 0 without contact; there is none beyond the fold."""
    least = fold_ratio(transition)
    at = shape(least)
    lowest = approach(transition, at, span(transition, at))
    excess = within(approach_in_units >= lowest_approach(transition), approach_in_units - lowest)
    excess = _at_least(excess, 0.0)
    aim = sqrt(excess)
    start = least + (sqrt(aim * transition * (aim + transition)) + cbrt(transition * excess)) / 2
    start = where(excess > 1e4, _no_wider(start, transition, sqrt(_at_least(approach_in_units, 0.0))), start)

    def curve(at: Shape) -> tuple[Any, Any]:
        wide = span(transition, at)
        q = 4 / 3 * transition / wide
        return approach(transition, at, wide) - lowest, (at.g3 - q * at.h) * _stretch(at, wide, q)

    return _root(curve, excess, start, least)


def _no_wider(start: Any, transition: Any, radius: Any) -> Any:
    """Return a start for v that is not above v of a narrow ring around a wide contact, v³ = ⅔λa² + ⅔λ²av, by much."""
    bound = cbrt(2 / 3 * transition * radius * radius) + transition * sqrt(2 / 3 * radius)
    return where(bound < start, bound, start)


def _stretch(at: Shape, span: Any, q: Any) -> Any:
    """Return the factor that dP/dv and dδ/dv have in common, T²v(2 + q)/(n²(G1 + qG2))."""
    return span * span * at.v * (2 + q) / ((1 + at.v * at.v) * (at.g1 + q * at.g2))


def _root(curve: Callable[[Shape], tuple[Any, Any]], excess: Any, start: Any, least: Any) -> Any:
    """Return the v where a curve is as far above its least as wanted, by Newton's method.

    The root of the excess is solved for, not the excess: it is convex in v, and has a slope at the least as well. So
    the steps end to the right of the solution and come down to it. The bounds matter where rounding has the last word.
    """
    aim = sqrt(excess)
    most = start + (start - least)
    v = start
    for _ in range(_STATE_STEPS):
        value, slope = curve(shape(v))
        root = sqrt(_at_least(value, 0.0))
        v = v - 2 * root * (root - aim) / _at_least(slope, _TINY)
        v = _at_least(v, least)
        v = -_at_least(-v, -most)
    return v


_TINY = 1e-300


def _arctan(value: Any) -> Any:
    if isinstance(value, (float, int)):
        return math.atan(value)
    import numpy

    return numpy.arctan(value)


def _at_least(value: Any, bound: Any) -> Any:
    if isinstance(value, (float, int)):
        return max(value, bound)
    import numpy

    return numpy.maximum(value, bound)
