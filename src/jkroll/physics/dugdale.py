"""The curve of a Maugis contact in dimensionless form: Dugdale's constant traction in a ring around the contact circle.

The traction σ0 acts for a < r < c, where the gap is below w/σ0. Lengths along the surface are in units of
(πwR²/K)^(1/3), approaches of (π²w²R/K²)^(1/3), loads of πwR, with K = 4E*/3; λ = 2σ0/(πwK²/R)^(1/3).

Maugis (J. Colloid Interface Sci. 150, 243, 1992) has two equations for a and c at a load. Here one variable describes a
state, the edge ratio v = a/√(c² − a²): it is large where the ring is narrow (JKR), small where the ring is wide (DMT),
and 0 where the spheres do not touch. All else about a contact is explicit in v and λ. At both extremes of the curve and
in the state without load, q is a function of v alone:

    T = √(c² − a²) = 1/(⅔λ²G2 + √((⅔λ²G2)² + λG1/2))    a = vT    c = nT    q = 4λ/(3T)
    P = a³ − λT²G3    δ = a² − (4/3)λT    dP/dδ = (3/2)T(vG3 − qD)/(G3 − qh)
    pull-off: q = vG3/D    fold, where fixed grips let go: q = G3/h    no load: q = 4v³/(3G3)

    n = √(1 + v²)    θ = arctan(1/v)    h = tan(θ/2) = 1/(n + v)
    G1 = v + (1 − v²)θ    G2 = θ − h    G3 = v + n²θ    D = vh + n²θ²

In each of these three states, and at a given load or approach, v is the root of a smooth function. It is found by
Newton's or Halley's method from a start that is near enough for a fixed number of steps.
"""

import math
from collections.abc import Callable

from .elementary import (
    FloatOrArray,
    absolute,
    arctan,
    at_least,
    at_most,
    cbrt,
    cube,
    is_anywhere,
    pi,
    sqrt,
    where,
    within,
)

FOLD_WITHOUT_CONTACT = 0.9379474572107123  # (9π/(16(π − 1)))^(1/3): for λ below, a vanishes before fixed grips let go
JUMP_WITHOUT_CONTACT = 0.6551853485522241  # (9/32)^(1/3): for λ below, spheres that approach jump in without contact

_ROUNDING = 8 * 2.0**-52  # relative error of a pull-off load or a fold approach that a caller passes
_STEPS = 3  # of Newton's method; each squares the error
_FAR = 32.0  # √(1 + P/P_c) beyond which another start is taken, and twice as many steps
_TINY = 1e-300  # instead of a slope of 0
_LAST_OF_FRACTION = 21  # last odd number of the continued fraction; the rest is below 1e-17 of it, up to θ = π/2


class Shape:
    """The shape of a ring: n, θ, h, G2, G3 and D at its edge ratio v ≥ 0; `g1` gives G1."""

    def __init__(self, v: FloatOrArray) -> None:
        square = 1 + v * v
        self.v, self.n = v, sqrt(square)
        self.h = 1 / (self.n + v)
        self.theta = 2 * arctan(self.h)
        bent = square * self.theta
        self.g2, self.g3, self.d = self.theta - self.h, v + bent, v * self.h + bent * self.theta


def _lag(ring: Shape) -> FloatOrArray:
    """Return 1 − vθ, where v = cot θ, by Lambert's continued fraction: θ²/(3 − θ²/(5 − θ²/(7 − …)))."""
    square = ring.theta * ring.theta
    rest: FloatOrArray = _LAST_OF_FRACTION
    for odd in range(_LAST_OF_FRACTION - 2, 1, -2):
        rest = odd - square / rest
    return square / rest


def g1(ring: Shape) -> FloatOrArray:
    """Return G1, as v(1 − vθ) + θ."""
    return ring.v * _lag(ring) + ring.theta


def span(transition: FloatOrArray, ring: Shape) -> FloatOrArray:
    """Return T of a contact, from λ and the shape of its ring."""
    half = 2 / 3 * (transition * transition) * ring.g2
    return 1 / (half + sqrt(half * half + transition / 2 * g1(ring)))


def span_at_fold_apart(transition: FloatOrArray) -> FloatOrArray:
    """Return b = 8λ/3π, which is T at the fold of spheres that do not touch."""
    return 8 / (3 * pi) * transition


def span_apart(transition: FloatOrArray, approach: FloatOrArray) -> FloatOrArray:
    """Return T of spheres that attract without contact, which equals c there.

    c²/2 − bc = δ + 2/(πλ), b = 8λ/3π; fixed grips hold the larger root.
    """
    b = span_at_fold_apart(transition)
    square = b * b + 2 * (approach + 2 / (pi * transition))
    return b + sqrt(at_least(square, 0.0))


def load(transition: FloatOrArray, ring: Shape, span: FloatOrArray) -> FloatOrArray:
    """Return P, in contact or apart."""
    square = span * span
    return square * (cube(ring.v) * span - transition * ring.g3)


def approach(transition: FloatOrArray, ring: Shape, span: FloatOrArray) -> FloatOrArray:
    """Return δ of a contact."""
    touching = ring.v * span
    return touching * touching - 4 / 3 * transition * span


def unloaded_radius(transition: FloatOrArray, ring: Shape, span: FloatOrArray) -> FloatOrArray:
    """Return a of a contact without load: a³ = λT²G3, as P is 0. In vT, an error of v would have a greater effect."""
    return cbrt(transition * span * span * ring.g3)


def approach_apart(transition: FloatOrArray, span: FloatOrArray) -> FloatOrArray:
    """Return δ of spheres that attract without contact."""
    b = span_at_fold_apart(transition)
    return span * (span / 2 - b) - 2 / (pi * transition)


def stiffness_ratio(ring: Shape, q: FloatOrArray) -> FloatOrArray:
    """Return dP/dδ over that of a flat punch of radius T: v without attraction, 0 at pull-off, −∞ at the fold."""
    give = ring.g3 - q * ring.h
    is_fold = absolute(give) <= _ROUNDING * ring.g3  # as near as doubles come, where the sign is chance
    return where(is_fold, -math.inf, (ring.v * ring.g3 - q * ring.d) / where(is_fold, 1.0, give))


def energy(transition: FloatOrArray, ring: Shape, span: FloatOrArray, approach: FloatOrArray) -> FloatOrArray:
    """Return the elastic and surface energy Φ, in contact or apart: dΦ = P dδ; Φ = 0 beyond the reach of attraction.

    Φ = ¾(aδ² − ⅔a³δ + a⁵/5) − c² + λT⁴(θ − v + (2v + 3v³)(1 − vθ))/4 + λT²(n²θ − v)(a² − δ) − (4/9)λ²T³(v + 2n)h²
    """
    v, n, theta, lag = ring.v, ring.n, ring.theta, _lag(ring)
    touching, outside, square = v * span, n * span, span * span
    spread = touching * touching
    punch = touching * (approach * (approach - 2 / 3 * spread) + spread * spread / 5)
    bent = theta - v + v * lag * (2 + 3 * v * v)
    pull = (theta - v * lag) * (spread - approach)
    inner = 4 / 9 * transition * span * (v + 2 * n) * ring.h * ring.h
    return 3 / 4 * punch - outside * outside + transition * square * (square * bent / 4 + pull - inner)


# --- Extremes, and no load --------------------------------------------------------------------------------------------


def pull_off_ratio(transition: FloatOrArray) -> FloatOrArray:
    """Return v where the tension is largest; the start is a fit within 5e-4."""
    square = 0.2900717 / transition - 0.7981143
    square = square / (1 + transition * (1.456039 + transition * (0.960759 + transition * 0.109797)))
    v = transition / sqrt(1.3103706971044482 + square)
    for _ in range(2):
        ring = Shape(v)
        d_slope = ring.h * (1 - v / ring.n) + 2 * ring.theta * (v * ring.theta - 1)
        growth = 1 / v + 2 * v * ring.theta / ring.g3 - d_slope / ring.d
        v = _step_to(transition, ring, v * ring.g3 / ring.d, growth)
    return v


def fold_ratio(transition: FloatOrArray) -> FloatOrArray:
    """Return v where fixed grips let go; 0 if they also hold spheres without contact. The start is within 5e-5."""
    beyond = at_least(transition - FOLD_WITHOUT_CONTACT, 0.0)
    rise = 2.180274 + beyond * (24.2586 + beyond * (53.43513 + beyond * 23.90279))
    v = beyond * (rise / (1 + beyond * (15.02757 + beyond * (51.30233 + beyond * 39.46094))))
    for _ in range(2):
        ring = Shape(v)
        v = at_least(_step_to(transition, ring, ring.g3 / ring.h, 2 * v * ring.theta / ring.g3 + 1 / ring.n), 0.0)
    return where(beyond == 0, 0.0, v)


def lowest_approach(transition: FloatOrArray, least: FloatOrArray) -> FloatOrArray:
    """Return δ at the fold, in contact or apart; `least` is v there."""
    ring = Shape(least)
    apart = approach_apart(transition, span_at_fold_apart(transition))
    return where(least == 0, apart, approach(transition, ring, span(transition, ring)))


def unloaded_ratio(transition: FloatOrArray) -> FloatOrArray:
    """Return v of the stable contact without load; the start is a fit within 8e-5."""
    curved = (0.5219 + transition * (1.0059 + 0.7003 * transition)) / (1 + transition * (1.9949 + 0.692 * transition))
    v = transition * sqrt(1.2114137 + 1.2467419 / (transition * (1 + transition * curved)))
    for _ in range(2):
        ring = Shape(v)
        v = _step_to(transition, ring, 4 / 3 * cube(v) / ring.g3, 3 / v - 2 * v * ring.theta / ring.g3)
    return v


def _step_to(transition: FloatOrArray, ring: Shape, q: FloatOrArray, growth: FloatOrArray) -> FloatOrArray:
    """Return v after a step of Halley's method towards the v of an extreme, or of the unloaded state, at λ.

    `q` is the function of v that gives q in the sought state, such as vG3/D at pull-off, at the present v; `growth` is
    d ln q/dv. The present v is the solution at another λ, with λ³ = 9q²/(8(G1 + 2qG2)), as λ = ¾qT and
    T³ = 8/(3q(G1 + 2qG2)).
    """
    v, n = ring.v, ring.n
    g = g1(ring) + 2 * q * ring.g2
    reached = 9 / 8 * (q / g) * q
    aim = cube(transition)
    g1_slope = 2 * v * (v / (n * n) - ring.theta)
    g2_slope = ring.h / n - 1 / (n * n)
    slope = 2 * growth - (g1_slope + 2 * q * (growth * ring.g2 + g2_slope)) / g
    return v + 3 * (aim - reached) / ((aim + 2 * reached) * slope)


# --- States ---------------------------------------------------------------------------------------------------------


def ratio_at_load(
    transition: FloatOrArray, load_in_units: FloatOrArray, least: FloatOrArray, tension: FloatOrArray
) -> FloatOrArray:
    """Return v of the stable contact at a load. Beyond pull-off, a float raises ValueError and an array holds nan.

    `least` and `tension` are v and −P at pull-off. A load beyond pull-off by no more than rounding counts as pull-off.
    The start is a fit within 25 % up to 10³ pull-off forces, and follows from Hertz' radius beyond; the steps reduce
    its error to 1e-16.
    """
    margin = load_in_units + tension
    aim = sqrt(within(margin >= -_ROUNDING * tension, at_least(margin, 0.0)))
    reach = aim / sqrt(tension)
    root = sqrt(transition)
    power_3_2 = root * transition
    scale = power_3_2 / (power_3_2 + 0.65 + 1.2 * root / (1 + 9 * transition))
    power = (1 + 1 / ((1 + 0.82 * root) * (1 + 0.82 * root))) / 3
    start = least * (1 + reach / scale) ** power

    def curve(ring: Shape) -> tuple[FloatOrArray, FloatOrArray]:
        wide = span(transition, ring)
        q = 4 / 3 * transition / wide
        slope = 3 / 2 * wide * (ring.v * ring.g3 - q * ring.d) * _stretch(transition, ring, wide, q)
        return load(transition, ring, wide) + tension, slope

    is_far = reach > _FAR
    if not is_anywhere(is_far):
        return _root(curve, aim, start, least, power)
    start = where(is_far, _in_wide_contact(transition, cbrt(at_least(load_in_units, 0.0))), start)
    v = _root(curve, aim, start, least, power)
    return where(is_far, _root(curve, aim, v, least, power), v)


def ratio_at_approach(
    transition: FloatOrArray, approach_in_units: FloatOrArray, least: FloatOrArray, fold: FloatOrArray
) -> FloatOrArray:
    """Return v of the state that fixed grips hold at an approach: 0 without contact.

    `least` and `fold` are v and δ at the fold. Beyond it, a float raises ValueError and an array holds nan.
    """
    ring = Shape(least)
    lowest = approach(transition, ring, span(transition, ring))
    is_held = approach_in_units >= fold - _ROUNDING * absolute(fold)
    excess = at_least(within(is_held, approach_in_units - lowest), 0.0)
    aim = sqrt(excess)
    start = least + (sqrt(aim * transition * (aim + transition)) + cbrt(transition * excess)) / 2
    start = where(aim > 100, _in_wide_contact(transition, sqrt(at_least(approach_in_units, 0.0))), start)

    def curve(ring: Shape) -> tuple[FloatOrArray, FloatOrArray]:
        wide = span(transition, ring)
        return approach(transition, ring, wide) - lowest, approach_slope(transition, ring, wide)

    return _root(curve, aim, _root(curve, aim, start, least), least)


def approach_slope(transition: FloatOrArray, ring: Shape, span: FloatOrArray) -> FloatOrArray:
    """Return dδ/dv of a contact."""
    q = 4 / 3 * transition / span
    return (ring.g3 - q * ring.h) * _stretch(transition, ring, span, q)


def _in_wide_contact(transition: FloatOrArray, radius: FloatOrArray) -> FloatOrArray:
    """Return an estimate of v for Hertz' radius a: a wide ring has v² = (π/4)λa², a narrow one v³ = ⅔λa² + ⅔λ²av."""
    area = transition * radius * radius
    return at_most(sqrt(pi / 4 * area), cbrt(2 / 3 * area)) + transition * sqrt(2 / 3 * radius)


def _stretch(transition: FloatOrArray, ring: Shape, span: FloatOrArray, q: FloatOrArray) -> FloatOrArray:
    """Return the factor that dP/dv and dδ/dv have in common, T²v(2 + q)/(n²(G1 + qG2)), with G1 = 2/(λT²) − 2qG2."""
    square = span * span
    return square * ring.v * (2 + q) / (ring.n * ring.n * (2 / (transition * square) - q * ring.g2))


def _root(
    curve: Callable[[Shape], tuple[FloatOrArray, FloatOrArray]],
    aim: FloatOrArray,
    start: FloatOrArray,
    least: FloatOrArray,
    power: FloatOrArray = 1.0,
) -> FloatOrArray:
    """Return the v where the square root of a curve is `aim`, by Newton's method in v^(1/power).

    The curve is the load or the approach above its least value, which it has at v = `least`. Its square root has a
    finite slope even there, and for a load is almost a straight line over v^(1/power). The bounds of v matter only
    where rounding decides.
    """
    v, most = start, start + (start - least)
    for _ in range(_STEPS):
        value, slope = curve(Shape(v))
        root = sqrt(at_least(value, 0.0))
        growth = 1 - 2 * root * (root - aim) / at_least(power * v * slope, _TINY)
        v = at_most(at_least(v * at_least(growth, 0.0) ** power, least), most)
    return v
