"""Ways to each headline quantity: the package's, the paper's equations, textbook inversions, tables and quadratures."""

# ruff: noqa: N803, N806  (the paper's symbols)

from collections.abc import Callable, Mapping
from functools import cache
from typing import Any

from numpy import cbrt, exp, interp, linspace, pi, sin, sqrt, where
from numpy.polynomial.legendre import leggauss

from ..physics.any_law import TRANSITION_OVER_TABOR
from ..physics.jkr import FOLD_APPROACH
from ..scene.wiring import plan_for
from .equations import AS_PRINTED, DECIMALS, DOUBLES, Way, inputs_of


def our_way(quantity: str) -> Callable[[Mapping[str, Any]], Any]:
    """Return the formulas that `jkroll.solve` runs, as a function of the inputs of a quantity."""
    names = inputs_of(getattr(DECIMALS, quantity))
    plan = plan_for((quantity,), frozenset((*names, "energy_ratio")), own_material2=False)

    def run(point: Mapping[str, Any]) -> Any:
        values = {"energy_ratio": 1.0, **point}
        for step in plan.steps:
            values[step.name] = step.formula(**{parameter: values[name] for parameter, name in step.arguments})
        return values[plan.sources[quantity]]

    return run


def _printed(quantity: str) -> dict[str, Way]:
    """Return the equation of the paper, and what becomes of it by a square root that keeps the digits near pull-off."""
    return {
        "s = √(1+P/P_c)": getattr(AS_PRINTED, quantity),
        "s = √((P+P_c)/P_c)": getattr(DOUBLES, quantity),
    }


def _by_radicals(delta: Any, delta0: Any) -> Any:
    """Solve 3y⁴ − 2y = δ/δ0 by Ferrari's resolvent in the textbook's form."""
    ratio = delta / delta0
    root = sqrt(4 / 81 + (4 * ratio / 9) ** 3)
    zeta = cbrt(2 / 9 + root) + cbrt(2 / 9 - root)
    return ((sqrt(zeta) + sqrt(4 / (3 * sqrt(zeta)) - zeta)) / 2) ** 3


def _by_quartic(delta: Any, delta0: Any) -> Any:
    """Solve the quartic of the contact radius as codes of many particles do (Parteli et al., Sci. Rep. 4, 6227, 2014).

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


@cache
def _table() -> tuple[Any, Any]:
    """Return 10⁴ equidistant approaches from the fold to 3 δ0, and x at each."""
    y = linspace(6 ** (-1 / 3), 1.26, 200_000)
    nodes = linspace(FOLD_APPROACH, 3, 10_000)
    return nodes, interp(nodes, 3 * y**4 - 2 * y, y**3)


def _half_circles(R1: Any, R2: Any, w: Any, E: Any, xi: Any, P: Any, P_c: Any) -> Any:
    """Return Eq 19 with Eq 23, not linearised: its terms in ξ³ count as errors of Eq 25, which is exact."""
    a = DOUBLES.contact_radius_at_load(R1, R2, w, E, P, P_c)
    delta = DOUBLES.approach_at_load(R1, R2, w, E, P, P_c)
    less, more = (E * A**2 * delta / 2 - E / (4 * DOUBLES.reduced(R1, R2)) * A**4 for A in (a - xi, a + xi))
    return less - more


def _quadrature(points: int, *, in_angle: bool) -> Way:
    """Return Eq 17 over the tilted pressure of the shifted circle, by Gauss-Legendre in r/a or in its arc sine."""
    nodes = list(zip(*(values.tolist() for values in leggauss(points)), strict=True))

    def way(R1: Any, R2: Any, w: Any, E: Any, xi: Any, P: Any, P_c: Any) -> Any:
        a = DOUBLES.contact_radius_at_load(R1, R2, w, E, P, P_c)
        total = 0.0
        for node, weight in nodes:  # of X²/√(1 − r²/a²), which the pressure leaves
            r = (1 + node) / 2
            total = total + weight / 2 * (pi / 2 * sin(pi / 2 * r) ** 3 if in_angle else r**3 / sqrt(1 - r**2))
        return 2 * E * xi / DOUBLES.reduced(R1, R2) * total * a**3 - xi * P

    return way


def _radius_by_jkr(R1: Any, R2: Any, w: Any, E: Any, P: Any) -> Any:
    return DOUBLES.contact_radius_at_load(R1, R2, w, E, P, DOUBLES.pull_off_force(R1, R2, w))


def _radius_by_dmt(R1: Any, R2: Any, w: Any, E: Any, P: Any) -> Any:
    R = DOUBLES.reduced(R1, R2)
    return cbrt(3 / 4 * R / E * (P + 2 * pi * w * R))


def _radius_by_cos(R1: Any, R2: Any, w: Any, E: Any, z0: Any, P: Any) -> Any:
    """Return the fit of Carpick, Ogletree & Salmeron (J. Colloid Interface Sci. 211, 395, 1999).

    The coefficients are those of the code woodem/woo, pkg/dem/Hertz.cpp, which cites Eqs (7), (10), (12a) and (12b) of
    the article.
    """
    R = DOUBLES.reduced(R1, R2)
    transition = TRANSITION_OVER_TABOR * cbrt(R * (w / E) ** 2) / z0
    alpha = (1 - exp(-transition / 0.924)) / 1.02
    power, power_of_radius = 4.04 * transition**1.4, 2.28 * transition**1.3
    pull_off = pi * w * R * (7 / 4 - (power - 1) / (power + 1) / 4)
    unloaded = 1.54 + 0.279 * (power_of_radius - 1) / (power_of_radius + 1)
    spread = (alpha + sqrt(1 + P / pull_off)) / (1 + alpha)
    return unloaded * cbrt(3 / 4 * pi * w * R**2 / E * spread**2)


OTHER_WAYS: Mapping[str, Mapping[str, Way]] = {
    "pull_off_force": {"Eq 1": DOUBLES.pull_off_force},
    "contact_radius_at_load": _printed("contact_radius_at_load"),
    "approach_at_load": _printed("approach_at_load"),
    "stiffness": _printed("stiffness"),
    "load_factor_at_approach": {
        "Newton on the quartic": DOUBLES.load_factor_at_approach,
        "closed form, radicals": _by_radicals,
        "Parteli et al. 2014": _by_quartic,
        "table of 10⁴ nodes": lambda delta, delta0: interp(delta / delta0, *_table()),
    },
    "contact_radius_maugis": {"JKR": _radius_by_jkr, "DMT": _radius_by_dmt, "COS 1999": _radius_by_cos},
    "yield_moment": {
        **_printed("yield_moment"),
        "half-circles, Eq 19": _half_circles,
        "Gauss 8 in r": _quadrature(8, in_angle=False),
        "Gauss 16 in angle": _quadrature(16, in_angle=True),
    },
    "r_min": {"R1R2/ξ": DOUBLES.r_min},
    "n_grav": _printed("n_grav"),
    "vertical_frequency": _printed("vertical_frequency"),
    "rolling_frequency": _printed("rolling_frequency"),
    "n_roll": _printed("n_roll"),
}
QUANTITIES = tuple(OTHER_WAYS)
