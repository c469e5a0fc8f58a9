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
from typing import Any, NamedTuple

from .elementary import arctan, at_least, cbrt, pi, sqrt, where

FOLD_WITHOUT_CONTACT = 0.9379474572107123  # (9π/(16(π − 1)))^(1/3): below, a vanishes before fixed grips let go
JUMP_WITHOUT_CONTACT = 0.6551853485522241  # (9/32)^(1/3): below, approaching spheres attract before they touch

_NARROW = 0.2
_LAG_COEFFICIENTS = tuple(4 * k / (4 * k * k - 1) for k in range(11, 0, -1))


def length_unit(work_of_adhesion: Any, reduced_radius: Any, contact_modulus: Any) -> Any:
    """Return the unit of lengths along the surface, (πwR²/K)^(1/3)."""
    return cbrt(3 / 4 * pi * (work_of_adhesion / contact_modulus) * reduced_radius * reduced_radius)


class Shape(NamedTuple):
    """The functions of the edge ratio that the module names."""

    v: Any
    n: Any
    theta: Any
    h: Any
    g2: Any
    g3: Any
    d: Any


def shape(edge_ratio: Any) -> Shape:
    """Return the functions of an edge ratio v ≥ 0."""
    v = edge_ratio
    square = 1 + v * v
    n = sqrt(square)
    h = 1 / (n + v)
    theta = 2 * arctan(h)
    bent = square * theta
    return Shape(v, n, theta, h, theta - h, v + bent, v * h + bent * theta)


def _lag(at: Shape) -> Any:
    """Return 1 − vθ; where its terms are almost equal, as Σ (−1)^(k+1) 4k/(4k² − 1) h^(2k), to 3e-17."""
    square = at.h * at.h
    narrow = 0.0
    for coefficient in _LAG_COEFFICIENTS:
        narrow = (coefficient - narrow) * square
    wide = 1 - at.v * at.theta
    return wide + (at.h < _NARROW) * (narrow - wide)  # of an array in no order, numpy.where takes ten times as long


def g1(at: Shape) -> Any:
    """Return G1, as v(1 − vθ) + θ."""
    return at.v * _lag(at) + at.theta


def span(transition: Any, at: Shape) -> Any:
    """Return T of a contact, from λ and its shape."""
    half = 2 / 3 * (transition * transition) * at.g2
    return 1 / (half + sqrt(half * half + transition / 2 * g1(at)))


def span_apart(transition: Any, approach: Any) -> Any:
    """Return T of spheres that attract without contact, where it is c.

    c²/2 − bc = δ + 2/(πλ), b = 8λ/3π; fixed grips hold the larger root.
    """
    b = 8 / (3 * pi) * transition
    square = b * b + 2 * (approach + 2 / (pi * transition))
    return b + sqrt(at_least(square, 0.0))


def load(transition: Any, at: Shape, span: Any) -> Any:
    """Return P, in contact or apart."""
    square = span * span
    return square * (at.v * at.v * at.v * span - transition * at.g3)


def approach(transition: Any, at: Shape, span: Any) -> Any:
    """Return δ of a contact."""
    touching = at.v * span
    return touching * touching - 4 / 3 * transition * span


def unloaded_radius(transition: Any, at: Shape, span: Any) -> Any:
    """Return a of a contact without load: a³ = λT²G3, as P is 0; v would bring its error in as its power 3/2."""
    return cbrt(transition * span * span * at.g3)


def unloaded_approach(transition: Any, at: Shape, span: Any) -> Any:
    """Return δ of a contact without load: λT(G3/v − 4/3), in which almost nothing cancels."""
    return transition * span * (at.g3 / at.v - 4 / 3)


def approach_apart(transition: Any, span: Any) -> Any:
    """Return δ of spheres that attract without contact."""
    b = 8 / (3 * pi) * transition
    return span * (span / 2 - b) - 2 / (pi * transition)


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
    v, n, theta, lag = at.v, at.n, at.theta, _lag(at)
    touching, outside, square = v * span, n * span, span * span
    spread = touching * touching
    punch = touching * (approach * (approach - 2 / 3 * spread) + spread * spread / 5)
    ring = theta - v + v * lag * (2 + 3 * v * v)
    pull = (theta - v * lag) * (spread - approach)
    inner = 4 / 9 * transition * span * (v + 2 * n) * at.h * at.h
    return 3 / 4 * punch - outside * outside + transition * square * (square * ring / 4 + pull - inner)
