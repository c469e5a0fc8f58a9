"""Ways to each headline quantity: the package's own, and what a reader of the paper would write down.

A way is a function of arrays whose parameters are the paper's symbols: printed forms, textbook inversions, tables and
quadratures. `by_hand` has the usual quantities as a plain program would compute them: the least that `jkroll.solve`
could cost.
"""

# ruff: noqa: N803, N806  (the paper's symbols)

from collections.abc import Callable, Mapping
from functools import cache
from typing import Any

from numpy import abs, any, cbrt, exp, interp, linspace, log, pi, sin, sqrt, where
from numpy.polynomial.legendre import leggauss

from ..physics.any_law import TRANSITION_OVER_TABOR
from ..physics.jkr import FOLD_APPROACH
from ..scene.wiring import plan_for
from .points import inputs_of, references

# --- The package's own ------------------------------------------------------------------------------------------------

Way = Callable[..., Any]
_NODES = 10_000  # of the tables


def own_way(quantity: str) -> Callable[[Mapping[str, Any]], Any]:
    """Return the formulas that `jkroll.solve` runs, as a function of the inputs of a quantity."""
    names = inputs_of(references()[quantity])
    found = plan_for((quantity,), frozenset((*names, "energy_ratio")), own_material2=False)

    def run(point: Mapping[str, Any]) -> Any:
        values = {"energy_ratio": 1.0, **point}
        for step in found.steps:
            values[step.name] = step.formula(**{parameter: values[name] for parameter, name in step.arguments})
        return values[found.found[quantity]]

    return run


# --- Common parts -----------------------------------------------------------------------------------------------------


def _reduced(R1: Any, R2: Any) -> Any:
    return R1 * R2 / (R1 + R2)


def _margin(P: Any, P_c: Any) -> Any:
    """Return s = √(1 + P/P_c), which loses its digits at pull-off."""
    return sqrt(1 + P / P_c)


def _stable_margin(P: Any, P_c: Any) -> Any:
    """Return the same as √((P + P_c)/P_c), which does not."""
    return sqrt((P + P_c) / P_c)


def _factor(P: Any, P_c: Any) -> Any:
    return (1 + _margin(P, P_c)) / 2


def _stable_factor(P: Any, P_c: Any) -> Any:
    return (1 + _stable_margin(P, P_c)) / 2


def _force(R1: Any, R2: Any, w: Any) -> Any:
    return 3 * pi * w / 2 * _reduced(R1, R2)


def _radius(R1: Any, R2: Any, w: Any, E: Any) -> Any:
    return (9 * pi * w / 2 * _reduced(R1, R2) ** 2 / E) ** (1 / 3)


def _radius_by_cbrt(R1: Any, R2: Any, w: Any, E: Any) -> Any:
    return cbrt(9 * pi * w / 2 * _reduced(R1, R2) ** 2 / E)


def _approach(R1: Any, R2: Any, w: Any, E: Any) -> Any:
    return _radius(R1, R2, w, E) ** 2 / (3 * _reduced(R1, R2))


def _approach_by_cbrt(R1: Any, R2: Any, w: Any, E: Any) -> Any:
    return _radius_by_cbrt(R1, R2, w, E) ** 2 / (3 * _reduced(R1, R2))


def _mass(R: Any, rho: Any) -> Any:
    return 4 / 3 * pi * R**3 * rho


def _inertia(R: Any, rho: Any) -> Any:
    return 2 / 5 * _mass(R, rho) * R**2


def _stiffness(x: Any, s: Any, E: Any, a0: Any) -> Any:
    return 6 * E * a0 * x ** (2 / 3) * s / (2 + 3 * s)


def _slope(a_: Any) -> Any:
    """Return the slope of P(δ) through those of P(â) and δ(â)."""
    return (12 * a_**2 - 6 * sqrt(a_)) / (6 * a_ - 1 / sqrt(a_))


# --- The approach inverted --------------------------------------------------------------------------------------------


def _by_newton(delta: Any, delta0: Any) -> Any:
    """Solve 3y⁴ − 2y = δ/δ0 by Newton's method."""
    ratio = delta / delta0
    y = 1 + sqrt(sqrt(abs(ratio)))
    for _ in range(60):
        step = (3 * y**4 - 2 * y - ratio) / (12 * y**3 - 2)
        y = y - step
        if not any(abs(step) > 1e-15 * abs(y)):
            break
    return y**3


def _by_radicals(delta: Any, delta0: Any) -> Any:
    """Solve it by Ferrari's resolvent in the textbook's form."""
    ratio = delta / delta0
    root = sqrt(4 / 81 + (4 * ratio / 9) ** 3)
    zeta = cbrt(2 / 9 + root) + cbrt(2 / 9 - root)
    return ((sqrt(zeta) + sqrt(4 / (3 * sqrt(zeta)) - zeta)) / 2) ** 3


def _by_quartic(delta: Any, delta0: Any) -> Any:
    """Solve the quartic of the contact radius as programs for many particles do (Parteli et al., Sci. Rep. 4, 6227, 2014).

    Their a⁴ − 2Rδa² − 4πw(1−ν²)R²/E a + R²δ² = 0, here with a in units of a0: a0² = 3Rδ0 and 2πwR²/E* = 4a0³/9.
    """
    ratio = delta / delta0
    c0, c1, c2 = ratio**2 / 9, -4 / 9, -2 * ratio / 3
    p = -(c2**2) / 12 - c0
    q = -(c2**3) / 108 + c0 * c2 / 3 - c1**2 / 8
    u = cbrt(-q / 2 + sqrt(q**2 / 4 + p**3 / 27))
    s = -5 * c2 / 6 + where(p == 0, -cbrt(q), u - p / (3 * u))
    w = sqrt(c2 + 2 * s)
    a_ = (w + sqrt(w**2 - 4 * (c2 + s + c1 / (2 * w)))) / 2
    return a_ * sqrt(a_)


def _by_vieta(delta: Any, delta0: Any) -> Any:
    """Solve it by the resolvent without its cancellation, the second cube root from the product of the two."""
    ratio = delta / delta0
    A = cbrt(2 / 9 + sqrt(4 / 81 + (4 * ratio / 9) ** 3))
    B = -4 * ratio / (9 * A)
    zeta = where(ratio <= 0, A + B, 4 / 9 / (A * A - A * B + B * B))
    sigma = sqrt(zeta)
    return ((sigma + sqrt(4 / (3 * sigma) - zeta)) / 2) ** 3


@cache
def _table() -> tuple[Any, Any]:
    """Return equidistant approaches from the fold to 3 δ0, and x at each."""
    y = linspace(6 ** (-1 / 3), 1.26, 20 * _NODES)
    nodes = linspace(FOLD_APPROACH, 3, _NODES)
    return nodes, interp(nodes, 3 * y**4 - 2 * y, y**3)


@cache
def _root_table() -> tuple[Any, Any]:
    """Return nodes in √(δ̂ − δ̂_fold), in which the state is smooth, and x at each."""
    eta = linspace(0, 1.3, _NODES)
    return eta * sqrt((3 + eta * (2 + eta / 2)) / 6 ** (1 / 3)), (1 + eta) ** 3 / 6


# --- The moment integrated --------------------------------------------------------------------------------------------


def _contact(R1: Any, R2: Any, w: Any, E: Any, P: Any, P_c: Any) -> tuple[Any, Any, Any]:
    """Return the radius, approach and reduced radius of a loaded contact."""
    a_ = _stable_factor(P, P_c) ** (2 / 3)
    delta = _approach(R1, R2, w, E) * (3 * a_**2 - 2 * sqrt(a_))
    return _radius(R1, R2, w, E) * a_, delta, _reduced(R1, R2)


def _half_circles(R1: Any, R2: Any, w: Any, E: Any, xi: Any, P: Any, P_c: Any) -> Any:
    """Return Eq 19 with Eq 23, not linearised: its terms in ξ³ count as errors of Eq 25, which is exact."""
    a, delta, R = _contact(R1, R2, w, E, P, P_c)
    less, more = ((E * A**2 * delta / 2 - E / (4 * R) * A**4) for A in (a - xi, a + xi))
    return less - more


def _linearised(R1: Any, R2: Any, w: Any, E: Any, xi: Any, P: Any, P_c: Any) -> Any:
    """Return Eq 24."""
    a, delta, R = _contact(R1, R2, w, E, P, P_c)
    return 2 * xi * E * a * (a**2 / R - delta)


def _quadrature(points: int, *, in_angle: bool) -> Way:
    """Return Eq 17 over the tilted pressure of the shifted circle, by Gauss-Legendre in r/a or in its arc sine."""
    nodes = list(zip(*(values.tolist() for values in leggauss(points)), strict=True))

    def way(R1: Any, R2: Any, w: Any, E: Any, xi: Any, P: Any, P_c: Any) -> Any:
        a = _radius_by_cbrt(R1, R2, w, E) * cbrt(_stable_factor(P, P_c) ** 2)
        tilt = 2 * E * xi / _reduced(R1, R2)  # of the pressure, over π; X²/√(1 − r²/a²) is left of the integrand
        total = 0.0
        for node, weight in nodes:
            if in_angle:
                total = total + weight * pi / 4 * sin(pi / 4 * (1 + node)) ** 3 * a**3
            else:
                r = a * ((1 + node) / 2)
                total = total + weight / 2 * r**3 / sqrt(1 - (r / a) ** 2)
        return tilt * total - xi * P

    return way


# --- Between JKR and DMT: either limit, and a published fit -----------------------------------------------------------


def _radius_by_jkr(R1: Any, R2: Any, w: Any, E: Any, P: Any) -> Any:
    return _radius_by_cbrt(R1, R2, w, E) * cbrt(_stable_factor(P, _force(R1, R2, w)) ** 2)


def _approach_by_jkr(R1: Any, R2: Any, w: Any, E: Any, P: Any) -> Any:
    x = _stable_factor(P, _force(R1, R2, w))
    return _approach_by_cbrt(R1, R2, w, E) * cbrt(x) * (3 * x - 2)


def _stiffness_by_jkr(R1: Any, R2: Any, w: Any, E: Any, P: Any) -> Any:
    s = _stable_margin(P, _force(R1, R2, w))
    return 6 * E * _radius_by_jkr(R1, R2, w, E, P) * s / (2 + 3 * s)


def _radius_by_dmt(R1: Any, R2: Any, w: Any, E: Any, P: Any) -> Any:
    R = _reduced(R1, R2)
    return cbrt(3 / 4 * R / E * (P + 2 * pi * w * R))


def _radius_by_cos(R1: Any, R2: Any, w: Any, E: Any, z0: Any, P: Any) -> Any:
    """Return the fit of Carpick, Ogletree & Salmeron (J. Colloid Interface Sci. 211, 395, 1999).

    The coefficients are those of the code woodem/woo, pkg/dem/Hertz.cpp, which cites Eqs (7), (10), (12a) and (12b) of
    the article.
    """
    R = _reduced(R1, R2)
    transition = TRANSITION_OVER_TABOR * cbrt(R * (w / E) ** 2) / z0
    alpha = (1 - exp(-transition / 0.924)) / 1.02
    power, power_of_radius = 4.04 * transition**1.4, 2.28 * transition**1.3
    pull_off = pi * w * R * (7 / 4 - (power - 1) / (power + 1) / 4)
    unloaded = 1.54 + 0.279 * (power_of_radius - 1) / (power_of_radius + 1)
    spread = (alpha + sqrt(1 + P / pull_off)) / (1 + alpha)
    return unloaded * cbrt(3 / 4 * pi * w * R**2 / E * spread**2)


# --- All of them ------------------------------------------------------------------------------------------------------

OTHER_WAYS: Mapping[str, Mapping[str, Way]] = {
    "pull_off_force": {
        "R = R1R2/(R1+R2)": _force,
        "R = 1/(1/R1+1/R2)": lambda R1, R2, w: 3 / 2 * pi * w / (1 / R1 + 1 / R2),
    },
    "contact_radius": {
        "** (1/3)": _radius,
        "numpy.cbrt": _radius_by_cbrt,
        "exp(log/3)": lambda R1, R2, w, E: exp(log(9 * pi * w / 2 * _reduced(R1, R2) ** 2 / E) / 3),
    },
    "approach": {
        "a0²/(3R), ** (1/3)": _approach,
        "a0²/(3R), numpy.cbrt": _approach_by_cbrt,
        "P_c/(E* a0)": lambda R1, R2, w, E: _force(R1, R2, w) / (E * _radius(R1, R2, w, E)),
    },
    "contact_radius_at_load": {
        "a0 x**(2/3), s = √(1+P/P_c)": lambda R1, R2, w, E, P, P_c: _radius(R1, R2, w, E) * _factor(P, P_c) ** (2 / 3),
        "a0 x**(2/3), stable s": lambda R1, R2, w, E, P, P_c: _radius(R1, R2, w, E) * _stable_factor(P, P_c) ** (2 / 3),
        "numpy.cbrt, stable s": lambda R1, R2, w, E, P, P_c: (
            _radius_by_cbrt(R1, R2, w, E) * cbrt(_stable_factor(P, P_c) ** 2)),
    },
    "approach_at_load": {
        "Eq 6 through â, s = √(1+P/P_c)": lambda R1, R2, w, E, P, P_c: (
            _approach(R1, R2, w, E) * (3 * _factor(P, P_c) ** (4 / 3) - 2 * _factor(P, P_c) ** (1 / 3))),
        "Eq 6 through â, stable s": lambda R1, R2, w, E, P, P_c: (
            _approach(R1, R2, w, E) * (3 * _stable_factor(P, P_c) ** (4 / 3) - 2 * _stable_factor(P, P_c) ** (1 / 3))),
        "8+9P/P_c": lambda R1, R2, w, E, P, P_c: (
            _approach_by_cbrt(R1, R2, w, E) * cbrt(_factor(P, P_c)) * (8 + 9 * P / P_c) / (2 * (1 + 3 * _margin(P, P_c)))),
        "8(P+P_c)+P": lambda R1, R2, w, E, P, P_c: (
            cbrt(3 / 4 * (pi * pi) * (w / E) * (w / E) * _reduced(R1, R2) * _stable_factor(P, P_c))
            * ((8 * (P + P_c) + P) / P_c) / (2 * (1 + 3 * _stable_margin(P, P_c)))),
    },
    "stiffness": {
        "s = √(1+P/P_c)": lambda R1, R2, w, E, P, P_c: (
            _stiffness(_factor(P, P_c), _margin(P, P_c), E, _radius_by_cbrt(R1, R2, w, E))),
        "slopes of P(â) and δ(â)": lambda R1, R2, w, E, P, P_c: (
            _force(R1, R2, w) / _approach(R1, R2, w, E) * _slope(_factor(P, P_c) ** (2 / 3))),
    },
    "load_factor_at_approach": {
        "Newton on the quartic": _by_newton,
        "closed form, radicals": _by_radicals,
        "closed form, Vieta": _by_vieta,
        "Parteli et al. 2014": _by_quartic,
        "table in δ": lambda delta, delta0: interp(delta / delta0, *_table()),
        "table in √(δ−δ_fold)": lambda delta, delta0: interp(sqrt(delta / delta0 - FOLD_APPROACH), *_root_table()),
    },
    "contact_radius_maugis": {
        "JKR": _radius_by_jkr,
        "DMT": _radius_by_dmt,
        "COS 1999": _radius_by_cos,
    },
    "approach_maugis": {
        "JKR": _approach_by_jkr,
        "DMT": lambda R1, R2, w, E, P: _radius_by_dmt(R1, R2, w, E, P) ** 2 / _reduced(R1, R2),
    },
    "stiffness_maugis": {
        "JKR": _stiffness_by_jkr,
        "DMT": lambda R1, R2, w, E, P: 2 * E * _radius_by_dmt(R1, R2, w, E, P),
    },
    "yield_moment": {
        "s = √(1+P/P_c)": lambda R1, R2, w, xi, P, P_c: 2 * _force(R1, R2, w) * xi * (1 + _margin(P, P_c)),
        "half-circles, Eq 19": _half_circles,
        "linearised, Eq 24": _linearised,
        "Gauss 8 in r": _quadrature(8, in_angle=False),
        "Gauss 64 in r": _quadrature(64, in_angle=False),
        "Gauss 8 in angle": _quadrature(8, in_angle=True),
        "Gauss 16 in angle": _quadrature(16, in_angle=True),
    },
    "yield_force": {
        "M/R1": lambda R1, R2, w, xi, P, P_c: 4 * _force(R1, R2, w) * _stable_factor(P, P_c) * xi / R1,
    },
    "r_min": {
        "R1R2/ξ": lambda R1, R2, xi: R1 * R2 / xi,
    },
    "n_grav": {
        "Eq 30": lambda R1, R2, w, rho, xi, g, P, P_c: (
            sqrt(9 * (w / 2) * _reduced(R1, R2) * xi * _stable_factor(P, P_c) / (R1**4 * rho * g))),
    },
    "vertical_frequency": {
        "√(k/m)/2π": lambda R1, R2, w, E, rho, P, P_c: (
            sqrt(_stiffness(_stable_factor(P, P_c), _stable_margin(P, P_c), E, _radius(R1, R2, w, E))
                 / _reduced(_mass(R1, rho), _mass(R2, rho))) / (2 * pi)),
    },
    "rolling_frequency": {
        "I = I1I2/(I1+I2)": lambda R1, R2, w, rho, P, P_c: (
            sqrt(4 * _force(R1, R2, w) * _factor(P, P_c) * _reduced(R1, R2)
                 / _reduced(_inertia(R1, rho), _inertia(R2, rho))) / (2 * pi)),
    },
    "n_roll": {
        "P_cδ0/(14πP_cxξ)": lambda R1, R2, w, E, xi, P, P_c: (
            _force(R1, R2, w) * _approach(R1, R2, w, E) / (14 * pi * _force(R1, R2, w) * _factor(P, P_c) * xi)),
        "Eq 49 as printed": lambda R1, R2, w, E, xi, P, P_c: (
            3 / (14 * (9 * pi) ** (1 / 3)) * (w / 2 / E) ** (2 / 3) * _reduced(R1, R2) ** (1 / 3) / xi / _factor(P, P_c)),
    },
}  # fmt: skip
QUANTITIES = tuple(OTHER_WAYS)


# --- By hand ----------------------------------------------------------------------------------------------------------


def by_hand(
    sqrt: Callable[[Any], Any],
    cbrt: Callable[[Any], Any],
    fmin: Callable[[Any, Any], Any],
    fmax: Callable[[Any, Any], Any],
    *,
    radius: Any,
    radius2: Any,
    surface_energy: Any,
    youngs_modulus: Any,
    poisson_ratio: Any,
    density: Any,
    load: Any,
) -> dict[str, Any]:
    """Return the usual quantities of two spheres of one material: of floats by `math`, or of arrays by numpy."""
    yield_displacement = 2e-10
    work = 2 * sqrt(surface_energy * surface_energy)
    larger = fmax(radius, radius2)
    smaller = fmin(radius, radius2)
    reduced = smaller / (1 + smaller / larger)
    pull_off_force = 3.0 / 2 * pi * work * reduced
    margin = sqrt((load + pull_off_force) / pull_off_force)
    factor = (1 + margin) / 2
    ratio = radius / radius2
    yield_moment = 4 * pull_off_force * factor * yield_displacement
    mass = 4 * pi * (radius * radius * radius) * density / 3
    mass2 = 4 * pi * (radius2 * radius2 * radius2) * density / 3
    compliance = (1 - poisson_ratio * poisson_ratio) / youngs_modulus
    modulus = 1 / (compliance + compliance)
    strain = work / modulus
    stretched = reduced * factor
    contact_radius_at_load = cbrt(9.0 / 2 * pi * strain * stretched * stretched)
    stiffness = 6 * margin / (2 + 3 * margin) * modulus * contact_radius_at_load
    lighter = fmin(mass, mass2)
    heavier = fmax(mass, mass2)
    reduced_mass = lighter / (1 + lighter / heavier)
    rolling_stiffness = 4 * pull_off_force * factor * reduced
    square = radius * radius
    square2 = radius2 * radius2
    inertia = 8 * pi * (square * square * radius) * density / 15
    inertia2 = 8 * pi * (square2 * square2 * radius2) * density / 15
    least = fmin(inertia, inertia2)
    most = fmax(inertia, inertia2)
    reduced_inertia = least / (1 + least / most)
    shrunk = strain * strain * reduced
    return {
        "pull_off_force": pull_off_force,
        "contact_radius": cbrt(9.0 / 2 * pi * strain * reduced * reduced),
        "approach": cbrt(3.0 / 4 * (pi * pi) * shrunk),
        "yield_force": 6 * pi * work * factor * yield_displacement / (1 + ratio),
        "yield_force_ratio": 4 * factor * (yield_displacement / radius),
        "yield_moment": yield_moment,
        "yield_angle": yield_displacement / reduced,
        "r_min": radius * (radius2 / yield_displacement),
        "n_grav": sqrt(yield_moment / (mass * 9.80665 * radius)),
        "vertical_frequency": sqrt(stiffness / (4 * (pi * pi) * reduced_mass)),
        "rolling_frequency": sqrt(rolling_stiffness / (4 * (pi * pi) * reduced_inertia)),
        "n_roll": cbrt(3 / (10976 * pi) * shrunk) / (yield_displacement * factor),
    }
