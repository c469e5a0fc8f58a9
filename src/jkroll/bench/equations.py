"""The paper's equations in their plainest form, for doubles and for decimals of 60 digits, and exact values by these.

The state is that of a load and a pull-off force, or of an approach in units of the unloaded one.
"""

# ruff: noqa: D102, N803, N806  (names of quantities and the paper's symbols)

from collections.abc import Callable, Mapping
from decimal import Decimal, localcontext
from typing import Any, NamedTuple

import numpy

from ..scene.scene import Scene

SYMBOLS = {
    "R1": "radius", "R2": "radius2", "w": "work_of_adhesion", "E": "contact_modulus", "rho": "density",
    "xi": "yield_displacement", "g": "gravity", "P": "load", "P_c": "pull_off_force",
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

    `tolerance`: of the last step but one of an iteration, which squares it. `is_stable`: whether the digits that a
    load near pull-off has are kept.
    """

    def __init__(self, sqrt: Way, cbrt: Way, pi: Any, tolerance: Any, *, is_stable: bool = True) -> None:
        self.sqrt, self.cbrt, self.pi, self.tolerance, self.is_stable = sqrt, cbrt, pi, tolerance, is_stable

    def reduced(self, first: Any, second: Any) -> Any:
        return 1 / (1 / first + 1 / second)

    def factor(self, P: Any, P_c: Any) -> Any:
        """Return the larger root x = â^(3/2) of P/P_c = 4(x² − x), Eq 5."""
        return (1 + self.sqrt((P + P_c) / P_c if self.is_stable else 1 + P / P_c)) / 2

    def stretch(self, P: Any, P_c: Any) -> Any:
        return self.cbrt(self.factor(P, P_c) ** 2)

    def radius(self, R1: Any, R2: Any, w: Any, E: Any) -> Any:
        return self.cbrt(9 * self.pi * (w / 2) * self.reduced(R1, R2) ** 2 / E)

    def approach(self, R1: Any, R2: Any, w: Any, E: Any) -> Any:
        return self.radius(R1, R2, w, E) ** 2 / (3 * self.reduced(R1, R2))

    def mass(self, R: Any, rho: Any) -> Any:
        return 4 * self.pi / 3 * R**3 * rho

    def pull_off_force(self, R1: Any, R2: Any, w: Any) -> Any:
        return 3 * self.pi * (w / 2) * self.reduced(R1, R2)

    def contact_radius_at_load(self, R1: Any, R2: Any, w: Any, E: Any, P: Any, P_c: Any) -> Any:
        return self.radius(R1, R2, w, E) * self.stretch(P, P_c)

    def approach_at_load(self, R1: Any, R2: Any, w: Any, E: Any, P: Any, P_c: Any) -> Any:
        a_ = self.stretch(P, P_c)
        return self.approach(R1, R2, w, E) * (3 * a_**2 - 2 * self.sqrt(a_))

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

    def r_min(self, R1: Any, R2: Any, xi: Any) -> Any:
        return R1 * R2 / xi

    def n_grav(self, R1: Any, R2: Any, w: Any, rho: Any, xi: Any, g: Any, P: Any, P_c: Any) -> Any:
        return self.sqrt(self.yield_moment(R1, R2, w, xi, P, P_c) / (self.mass(R1, rho) * g * R1))

    def vertical_frequency(self, R1: Any, R2: Any, w: Any, E: Any, rho: Any, P: Any, P_c: Any) -> Any:
        mass = self.reduced(self.mass(R1, rho), self.mass(R2, rho))
        return self.sqrt(self.stiffness(R1, R2, w, E, P, P_c) / mass) / (2 * self.pi)

    def rolling_frequency(self, R1: Any, R2: Any, w: Any, rho: Any, P: Any, P_c: Any) -> Any:
        inertia = self.reduced(*(2 * self.mass(R, rho) * R**2 / 5 for R in (R1, R2)))
        moment = 4 * self.pull_off_force(R1, R2, w) * self.factor(P, P_c) * self.reduced(R1, R2)
        return self.sqrt(moment / inertia) / (2 * self.pi)

    def n_roll(self, R1: Any, R2: Any, w: Any, E: Any, xi: Any, P: Any, P_c: Any) -> Any:
        return self.approach(R1, R2, w, E) / (14 * self.pi * self.factor(P, P_c) * xi)

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
AS_PRINTED = Equations(numpy.sqrt, numpy.cbrt, numpy.pi, 1e-15, is_stable=False)


class Exact(NamedTuple):
    """The double nearest to an exact value, the rest, and the condition of the value."""

    nearest: float
    rest: float
    condition: float  # κ: how many times a relative error of the state that is given appears in the value


def digits(quantity: str, point: Mapping[str, float], moved: str = "") -> Decimal:
    """Return the value of a quantity at a point of doubles, in 60 digits.

    An input is moved by a small step towards zero.
    """
    equation = getattr(DECIMALS, quantity)
    with localcontext(prec=DIGITS):
        given = {name: Decimal(point[name]) * (1 - _STEP * (name == moved)) for name in inputs_of(equation)}
        value: Decimal = equation(*given.values())
        return value


def exact(quantity: str, point: Mapping[str, float]) -> Exact:
    """Return the exact value of a quantity at a point, and its condition in the state and, by Maugis, in λ."""
    value = digits(quantity, point)
    states = {"load", "approach_at_load", "atomic_spacing"}.intersection(inputs_of(getattr(DECIMALS, quantity)))
    with localcontext(prec=DIGITS):
        slopes = [abs(digits(quantity, point, name) / value - 1) / _STEP for name in states] if value else []
        return Exact(float(value), float(value - Decimal(float(value))), float(sum(slopes)))
