"""The state of a Maugis contact, as the edge ratio v of `dugdale`: at its extremes, at a load and at an approach.

Each is the root of a smooth function of v, found by Newton's method from a start that is near enough for a fixed number of
steps. All is dimensionless.
"""

from collections.abc import Callable
from typing import Any

from .dugdale import FOLD_WITHOUT_CONTACT, Shape, approach, g1, load, shape, span
from .elementary import at_least, at_most, cbrt, is_any, pi, sqrt, where, within

_STEPS = 3  # of Newton's method, each of which squares the error
_FAR = 32.0  # √(1 + P/P_c) beyond which another start is taken, and twice as many steps
_TINY = 1e-300  # in place of a slope of 0

# --- Extremes -------------------------------------------------------------------------------------------------------


def pull_off_ratio(transition: Any) -> Any:
    """Return v where the tension is largest."""
    return _nearer_to_pull_off(transition, pull_off(transition)[0])


def pull_off(transition: Any) -> tuple[Any, Any]:
    """Return v at pull-off to 3e-8, from a fit to 4e-4, and with all digits the tension, which is stationary there."""
    square = 0.2900717 / transition - 0.7981143
    square = square / (1 + transition * (1.456039 + transition * (0.960759 + transition * 0.109797)))
    v = _nearer_to_pull_off(transition, transition / sqrt(1.3103706971044482 + square))
    at = shape(v)
    return v, -load(transition, at, span(transition, at))


def _nearer_to_pull_off(transition: Any, v: Any) -> Any:
    """Return v after a step of Newton's method towards pull-off."""
    at = shape(v)
    d_slope = at.h * (1 - v / at.n) + 2 * at.theta * (v * at.theta - 1)
    growth = 1 / v + 2 * v * at.theta / at.g3 - d_slope / at.d
    return _step_to(transition, at, v * at.g3 / at.d, growth)


def fold_ratio(transition: Any) -> Any:
    """Return v where fixed grips let go; 0 where they hold on to spheres that no longer touch."""
    beyond = at_least(transition - FOLD_WITHOUT_CONTACT, 0.0)
    difference = beyond - 0.46
    v = (difference + sqrt(difference * difference + 6.6 * beyond)) / 3.3
    for _ in range(_STEPS):
        at = shape(v)
        v = at_least(_step_to(transition, at, at.g3 / at.h, 2 * v * at.theta / at.g3 + 1 / at.n), 0.0)
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
    g = g1(at) + 2 * q * at.g2
    own = cbrt(9 / 8 * q * q / g)
    g1_slope = 2 * v * (v / (n * n) - at.theta)
    g2_slope = at.h / n - 1 / (n * n)
    slope = own * (2 * growth - (g1_slope + 2 * q * (growth * at.g2 + g2_slope)) / g) / 3
    return v + (transition - own) / slope


# --- States ---------------------------------------------------------------------------------------------------------


def ratio_at_load(transition: Any, load_in_units: Any) -> Any:
    """Return v of the stable contact at a load; there is none beyond pull-off.

    The start is a fit, to 15 % for λ from 1e-4 to 1e4 and loads up to 10³ pull-off forces: the steps leave 1e-16.
    """
    least, tension = pull_off(transition)
    margin = load_in_units + tension
    aim = sqrt(within(margin >= 0, margin))
    reach = aim / sqrt(tension)
    root = sqrt(transition)
    cube = root * transition
    scale = cube / (cube + 0.65 + 1.2 * root / (1 + 9 * transition))
    power = (1 + 1 / ((1 + 0.82 * root) * (1 + 0.82 * root))) / 3
    start = least * (1 + reach / scale) ** power

    def curve(at: Shape) -> tuple[Any, Any]:
        wide = span(transition, at)
        q = 4 / 3 * transition / wide
        slope = 3 / 2 * wide * (at.v * at.g3 - q * at.d) * _stretch(transition, at, wide, q)
        return load(transition, at, wide) + tension, slope

    v = _root(curve, aim, start, least, power)
    is_far = reach > _FAR
    if is_any(is_far):
        start = _no_wider(start, transition, cbrt(at_least(load_in_units, 0.0)))
        v = where(is_far, _root(curve, aim, _root(curve, aim, start, least, power), least, power), v)
    return v


def ratio_at_approach(transition: Any, approach_in_units: Any) -> Any:
    """Return v of the state that fixed grips hold at an approach: 0 without contact; there is none beyond the fold."""
    least = fold_ratio(transition)
    at = shape(least)
    lowest = approach(transition, at, span(transition, at))
    excess = within(approach_in_units >= lowest_approach(transition), approach_in_units - lowest)
    excess = at_least(excess, 0.0)
    aim = sqrt(excess)
    start = least + (sqrt(aim * transition * (aim + transition)) + cbrt(transition * excess)) / 2
    start = where(excess > 1e4, _no_wider(start, transition, sqrt(at_least(approach_in_units, 0.0))), start)

    def curve(at: Shape) -> tuple[Any, Any]:
        wide = span(transition, at)
        q = 4 / 3 * transition / wide
        return approach(transition, at, wide) - lowest, (at.g3 - q * at.h) * _stretch(transition, at, wide, q)

    return _root(curve, aim, _root(curve, aim, start, least), least)


def _no_wider(start: Any, transition: Any, radius: Any) -> Any:
    """Return a start for v that is not above v of a narrow ring around a wide contact, v³ = ⅔λa² + ⅔λ²av, by much."""
    bound = cbrt(2 / 3 * transition * radius * radius) + transition * sqrt(2 / 3 * radius)
    return at_most(bound, start)


def _stretch(transition: Any, at: Shape, span: Any, q: Any) -> Any:
    """Return the factor that dP/dv and dδ/dv have in common, T²v(2 + q)/(n²(G1 + qG2)), with G1 = 2/(λT²) − 2qG2."""
    square = span * span
    return square * at.v * (2 + q) / (at.n * at.n * (2 / (transition * square) - q * at.g2))


def _root(curve: Callable[[Shape], tuple[Any, Any]], aim: Any, start: Any, least: Any, power: Any = 1.0) -> Any:
    """Return the v where the root of a curve is `aim`, by Newton's method in v^(1/power).

    The curve is the load or the approach above its least. Its root has a slope at the least as well, and under a load is
    almost a straight line over v^(1/power). The bounds matter where rounding has the last word.
    """
    v, most = start, start + (start - least)
    for _ in range(_STEPS):
        value, slope = curve(shape(v))
        root = sqrt(at_least(value, 0.0))
        growth = 1 - 2 * root * (root - aim) / at_least(power * v * slope, _TINY)
        v = at_most(at_least(v * at_least(growth, 0.0) ** power, least), most)
    return v
