"""Ways to six headline quantities: the package's, the paper's equations, inversions by other codes and a table.

The paper's equations stand in their plainest form, for doubles and for decimals of 60 digits, which give exact values.
The state is that of a load and a pull-off force, or of an approach in units of the unloaded one.
"""

# ruff: noqa: D102, N803, N806  (names of quantities and the paper's symbols)

from collections.abc import Callable, Mapping
from decimal import Decimal, localcontext
from functools import cache
from typing import Any

import numpy
from numpy import cbrt, exp, interp, linspace, pi, sqrt, where

from ..physics.any_law import TRANSITION_OVER_TABOR
from ..physics.jkr import FOLD_APPROACH
from ..scene.scene import Scene

SYMBOLS = {
    "R1": "radius", "R2": "radius2", "w": "work_of_adhesion", "E": "contact_modulus",
    "xi": "yield_displacement", "P": "load", "P_c": "pull_off_force",
    "delta": "approach_at_load", "delta0": "approach", "z0": "atomic_spacing",
}  # fmt: skip
DIGITS = 60
_STEP = Decimal("1e-20")  # of an input, relative, for a slope: its square is beyond the digits that are compared

Way = Callable[..., Any]  # a function whose parameters are the paper's symbols


def inputs_of(way: Way) -> tuple[str, ...]:
    """Return the names of the inputs of a function whose parameters are the paper's symbols."""
    code = way.__code__
    return tuple(SYMBOLS[symbol] for symbol in code.co_varnames[: code.co_argcount] if symbol in SYMBOLS)


class Equations:
    """The equations, for numbers with these roots and this π.

    `tolerance`: of the last step but one of an iteration, which squares it.
    """

    def __init__(self, sqrt: Way, cbrt: Way, pi: Any, tolerance: Any) -> None:
        self.sqrt, self.cbrt, self.pi, self.tolerance = sqrt, cbrt, pi, tolerance

    def reduced(self, first: Any, second: Any) -> Any:
        return 1 / (1 / first + 1 / second)

    def factor(self, P: Any, P_c: Any) -> Any:
        """Return the larger root x = â^(3/2) of P/P_c = 4(x² − x), Eq 5."""
        return (1 + self.sqrt(1 + P / P_c)) / 2

    def stretch(self, P: Any, P_c: Any) -> Any:
        return self.cbrt(self.factor(P, P_c) ** 2)

    def radius(self, R1: Any, R2: Any, w: Any, E: Any) -> Any:
        return self.cbrt(9 * self.pi * (w / 2) * self.reduced(R1, R2) ** 2 / E)

    def approach(self, R1: Any, R2: Any, w: Any, E: Any) -> Any:
        return self.radius(R1, R2, w, E) ** 2 / (3 * self.reduced(R1, R2))

    def pull_off_force(self, R1: Any, R2: Any, w: Any) -> Any:
        return 3 * self.pi * (w / 2) * self.reduced(R1, R2)

    def contact_radius_at_load(self, R1: Any, R2: Any, w: Any, E: Any, P: Any, P_c: Any) -> Any:
        return self.radius(R1, R2, w, E) * self.stretch(P, P_c)

    def stiffness(self, R1: Any, R2: Any, w: Any, E: Any, P: Any, P_c: Any) -> Any:
        """Return the slope of P(δ) through those of P(â), Eq 5, and of δ(â), Eq 6."""
        a_ = self.stretch(P, P_c)
        slope = (12 * a_**2 - 6 * self.sqrt(a_)) / (6 * a_ - 1 / self.sqrt(a_))
        return self.pull_off_force(R1, R2, w) / self.approach(R1, R2, w, E) * slope

    def load_factor_at_approach(self, delta: Any, delta0: Any) -> Any:
        """Solve Eq 6, 3y⁴ − 2y = δ/δ0, by Newton's method, which is monotone from above the root."""
        ratio = delta / delta0
        y = 1 + self.sqrt(self.sqrt(abs(ratio)))
        for _ in range(200):
            step = (3 * y**4 - 2 * y - ratio) / (12 * y**3 - 2)
            y = y - step
            if not numpy.any(abs(step) > self.tolerance * abs(y)):
                break
        return y**3

    def yield_moment(self, R1: Any, R2: Any, w: Any, xi: Any, P: Any, P_c: Any) -> Any:
        return 4 * self.pull_off_force(R1, R2, w) * self.factor(P, P_c) * xi

    def contact_radius_maugis(self, R1: Any, R2: Any, w: Any, E: Any, z0: Any, P: Any) -> Any:
        """Return a by Maugis' two equations for a and m = c/a at a load, solved in v = 1/√(m² − 1).

        Takes decimals alone.
        """
        R, K = self.reduced(R1, R2), 4 * E / 3
        unit_force = self.pi * w * R
        lambda_ = 2 * 16 * w / (9 * self.sqrt(Decimal(3)) * z0) / self.cbrt(self.pi * w * K**2 / R)

        def state(v: Any) -> tuple[Any, Any]:
            """Return the radius and the force at a width of the ring, in Maugis' units."""
            m = self.sqrt(1 + 1 / v**2)
            t, angle = 1 / v, _arc_tangent(1 / v)
            ring = lambda_ / 2 * (t + (m**2 - 2) * angle)
            both = 4 * lambda_**2 / 3 * (t * angle - m + 1)
            a = 2 / (both + self.sqrt(both**2 + 4 * ring))
            return a, a**3 - lambda_ * a**2 * (t + m**2 * angle)

        given = {"work_of_adhesion": w, "reduced_radius": R, "transition_parameter": lambda_, "load": P}
        near = Scene({name: float(value) for name, value in given.items()})["edge_ratio_at_load"]
        v = _root(lambda v: state(v)[1] - P / unit_force, Decimal(near))
        return state(v)[0] * self.cbrt(unit_force * R / K)


def _arc_tangent(value: Decimal) -> Decimal:
    """Return the arc tangent by its series, after eight halvings of the angle."""
    for _ in range(8):
        value = value / (1 + (1 + value * value).sqrt())
    total, power, number = value, value, 1
    while abs(power) > abs(total).scaleb(-DIGITS):
        power, number = -power * value * value, number + 2
        total += power / number
    return 2**8 * total


def _root(function: Callable[[Decimal], Decimal], near: Decimal) -> Decimal:
    """Return the root of a function near a value, by the secant method."""
    last, root = near, near * (1 + Decimal("1e-9"))
    value_at_last = function(last)
    while abs(root - last) > abs(root).scaleb(-25):  # the last step leaves far less
        value = function(root)
        last, root, value_at_last = root, root - value * (root - last) / (value - value_at_last), value
    return root


PI = Decimal("3.14159265358979323846264338327950288419716939937510582097494459")
DECIMALS = Equations(Decimal.sqrt, lambda value: value ** (1 / Decimal(3)), PI, Decimal("1e-30"))
DOUBLES = Equations(numpy.sqrt, numpy.cbrt, numpy.pi, 1e-15)


def exact(quantity: str, point: Mapping[str, float]) -> tuple[Decimal, float]:
    """Return a quantity at a point of doubles in 60 digits, and its condition κ.

    κ says how many times a relative error of the state and, by Maugis, of λ appears in the value.
    """
    equation = getattr(DECIMALS, quantity)
    names = inputs_of(equation)

    def value_of(moved: str = "") -> Decimal:
        value: Decimal = equation(*(Decimal(point[name]) * (1 - _STEP * (name == moved)) for name in names))
        return value

    with localcontext(prec=DIGITS):
        value = value_of()
        states = {"load", "approach_at_load", "atomic_spacing"}.intersection(names)
        slopes = [abs(value_of(name) / value - 1) / _STEP for name in states] if value else []
    return value, float(sum(slopes))


# --- Ways of doubles --------------------------------------------------------------------------------------------------


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


PRINTED = "as printed"
OTHER_WAYS: Mapping[str, Mapping[str, Way]] = {
    "pull_off_force": {PRINTED: DOUBLES.pull_off_force},
    "contact_radius_at_load": {PRINTED: DOUBLES.contact_radius_at_load},
    "stiffness": {PRINTED: DOUBLES.stiffness},
    "load_factor_at_approach": {
        "Newton on the quartic": DOUBLES.load_factor_at_approach,
        "Parteli et al. 2014": _by_quartic,
        "table of 10⁴ nodes": lambda delta, delta0: interp(delta / delta0, *_table()),
    },
    "contact_radius_maugis": {"COS 1999": _radius_by_cos},
    "yield_moment": {PRINTED: DOUBLES.yield_moment},
}
QUANTITIES = tuple(OTHER_WAYS)
