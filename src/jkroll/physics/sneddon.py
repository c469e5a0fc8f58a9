"""The contact of a rigid sphere of true shape with an elastic half-space, dimensionless: JKR with Sneddon's sphere.

Lengths are in units of the sphere's radius R and loads in E*R². Two numbers give a state: the elasto-adhesive ratio
κ = w/(E*R), and L = artanh(a/R), in which all formulas are explicit and keep their digits up to a = R. With x = a/R:

    indentation    δ_H = xL              δ_H′ = dδ_H/dx = L + ½ sinh 2L        δ_H″ = 2 cosh⁴L
    load           P_H = (1 + x²)L − x = Σ 4n x^(2n+1)/((2n − 1)(2n + 1))      dP_H/dx = 2xδ_H′
    adhesion       u = √(2πκx)           δ = δ_H − u                           P = P_H − 2xu
    slopes         dδ/dx = δ_H′ − u/(2x)                                       dP/dx = 2xδ_H′ − 3u

δ_H and P_H, without adhesion, are Sneddon's, as in the code AFM-analysis/nanite. An energy release rate G = w at the
edge gives u; for a ≪ R this is JKR.

A machine keeps gδ + cP constant: fixed grips keep δ (c = 0), a dead load keeps P (g = 0), and a lever of stiffness k
keeps δ + P/k (in these units, g = 1 and c = E*R/k). It loses the contact where g dδ/dx + c dP/dx = 0. For every κ > 0
there is one such state, and one stable state for each larger gδ + cP.

All functions take numbers or arrays, which broadcast. They are meant for a nearly incompressible half-space
(ν ≥ 0.45); in others, neglected terms of order a/R exceed the effect of the sphere's shape, which is of order (a/R)².
"""

from .elementary import (
    FloatOrArray,
    absolute,
    arsinh,
    at_least,
    cbrt,
    cube,
    is_anywhere,
    ln,
    log1p,
    pi,
    sinh,
    sqrt,
    tanh,
    where,
    within,
)

_SMALL = 0.3  # a/R below which the load without adhesion is a series
_TERMS = 16  # of the series; the terms left out are below 1e-17 of it
_STEPS = 40  # of Newton's method at most; 2 to 10 are usual
_NEAR = 1e-9  # relative step after which the next one is rounding, as each step squares the error

# --- A state without adhesion -----------------------------------------------------------------------------------------


def artanh_of_contact(contact_radius: FloatOrArray, radius: FloatOrArray) -> FloatOrArray:
    """Return L = artanh(a/R) = ½ ln(1 + 2a/(R − a)), for 0 ≤ a < R in any unit."""
    return log1p(2 * contact_radius / (radius - contact_radius)) / 2


def indentation(artanh: FloatOrArray) -> FloatOrArray:
    """Return δ_H/R."""
    return artanh * tanh(artanh)


def indentation_slope(artanh: FloatOrArray) -> FloatOrArray:
    """Return dδ_H/da."""
    return artanh + sinh(2 * artanh) / 2


def indentation_curvature(artanh: FloatOrArray) -> FloatOrArray:
    """Return R d²δ_H/da²."""
    return 2 * _cosh_squared(artanh) * _cosh_squared(artanh)


def _cosh_squared(artanh: FloatOrArray) -> FloatOrArray:
    """Return cosh²L = 1/(1 − x²)."""
    return 1 + sinh(artanh) * sinh(artanh)


def load_without_adhesion(artanh: FloatOrArray) -> FloatOrArray:
    """Return Sneddon's load P_H/(E*R²), by a series where its two terms would cancel."""
    x = tanh(artanh)
    square = where(x < _SMALL, x, 0.0) * x
    series: FloatOrArray = 0.0
    for n in range(_TERMS, 0, -1):
        series = series * square + 4 * n / ((2 * n - 1) * (2 * n + 1))
    return where(x < _SMALL, series * cube(x), (1 + x * x) * artanh - x)


# --- A state with adhesion --------------------------------------------------------------------------------------------


def approach_lost(ratio: FloatOrArray, artanh: FloatOrArray) -> FloatOrArray:
    """Return u/R, the part of the approach that adhesion takes away. `ratio` is κ, here and below."""
    return sqrt(2 * pi * ratio * tanh(artanh))


def approach(ratio: FloatOrArray, artanh: FloatOrArray) -> FloatOrArray:
    """Return δ/R."""
    return indentation(artanh) - approach_lost(ratio, artanh)


def load(ratio: FloatOrArray, artanh: FloatOrArray) -> FloatOrArray:
    """Return P/(E*R²)."""
    return load_without_adhesion(artanh) - 2 * tanh(artanh) * approach_lost(ratio, artanh)


def approach_slope(ratio: FloatOrArray, artanh: FloatOrArray) -> FloatOrArray:
    """Return dδ/da."""
    return indentation_slope(artanh) - approach_lost(ratio, artanh) / (2 * tanh(artanh))


def load_slope(ratio: FloatOrArray, artanh: FloatOrArray) -> FloatOrArray:
    """Return (dP/da)/(E*R)."""
    return 2 * tanh(artanh) * indentation_slope(artanh) - 3 * approach_lost(ratio, artanh)


# --- States that a machine holds --------------------------------------------------------------------------------------


def last_state(ratio: FloatOrArray, grips: FloatOrArray, dead_load: FloatOrArray) -> FloatOrArray:
    """Return L of the state in which a machine that holds gδ + cP loses the contact; `grips` is g, `dead_load` c.

        (g + 2cx) δ_H′ = (g + 6cx) u/(2x)

    Newton's method finds the L at which the logarithm of the squared ratio of the two sides is 0. The slope of this
    logarithm is smooth: 3/L for a ≪ R, where the sphere is nearly a paraboloid, and 4 near a = R.
    """
    artanh = arsinh(cbrt(9 / 8 * pi * ratio))
    for _ in range(_STEPS):
        x, slope, square = tanh(artanh), indentation_slope(artanh), _cosh_squared(artanh)
        more, less = grips + 6 * dead_load * x, grips + 2 * dead_load * x
        excess = ln(2 * slope * slope * x * less * less / (pi * ratio * more * more))
        steepness = 4 * square / slope + (1 / x - 8 * grips * dead_load / (more * less)) / square
        step = excess / steepness
        artanh = artanh - step
        if not is_anywhere(absolute(step) > _NEAR * artanh):
            break
    return artanh


def state_at(
    held: FloatOrArray, ratio: FloatOrArray, last: FloatOrArray, grips: FloatOrArray, dead_load: FloatOrArray
) -> FloatOrArray:
    """Return L of the stable state at a value of gδ/R + cP/(E*R²); `last`: L from `last_state`.

    Newton's method starts beyond the root, where gδ + cP is convex or nearly linear in L. Below the last state a float
    raises ValueError, and an array holds nan.
    """
    excess = held - grips * approach(ratio, last) - dead_load * load(ratio, last)
    x, lost, curvature = tanh(last), approach_lost(ratio, last), indentation_curvature(last)
    of_approach = curvature + lost / (4 * x * x)
    of_load = 2 * (indentation_slope(last) + x * curvature) - 3 / 2 * lost / x
    bend = (grips * of_approach + dead_load * of_load) / (_cosh_squared(last) * _cosh_squared(last))
    artanh = last + sqrt(2 * at_least(excess, 0.0) / bend)
    for _ in range(_STEPS):
        x, lost = tanh(artanh), approach_lost(ratio, artanh)
        x_slope = (1 - x) * (1 + x)  # dx/dL
        rise, fall = x + artanh * x_slope, lost * x_slope / (2 * x)
        slope = grips * (rise - fall) + 2 * dead_load * x * (rise - 3 * fall)
        beyond = grips * approach(ratio, artanh) + dead_load * load(ratio, artanh) - held
        step = where(slope > 0, beyond / where(slope > 0, slope, 1.0), 0.0)
        artanh = at_least(artanh - step, last)
        if not is_anywhere(absolute(step) > _NEAR * artanh):
            break
    return within(excess >= 0, artanh)
