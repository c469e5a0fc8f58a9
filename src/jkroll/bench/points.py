"""The points at which the benchmark measures, in regions of which some are hard, and exact values there.

The equations are the paper's in their plainest form, in decimal arithmetic of 60 digits. Inputs are doubles and taken
as exact. The state is that of a load and a pull-off force, or of an approach in units of the unloaded one.
"""

# ruff: noqa: N803, N806  (the paper's symbols)

from collections.abc import Callable, Mapping
from decimal import Context, Decimal, localcontext
from functools import cache
from typing import Any, NamedTuple

import numpy

from ..physics.contact import pull_off_force
from ..physics.jkr import FOLD_APPROACH
from ..physics.pair import reduced_radius
from ..scene.scene import Scene

Arrays = Mapping[str, Any]
REGIONS = ("ordinary", "pull-off", "fold", "δ = 0", "extreme")
_SEED = 1997
_PULL_OFF_APPROACH = -(2 ** (-4 / 3))  # δ/δ0 at the pull-off force


def regions(count: int) -> Mapping[str, Arrays]:
    """Return points of each region: ordinary ones, those near pull-off, the fold and δ = 0, and tiny and huge states.

    Ordinary ones are grains of 10 nm to 100 µm under loads from −0.8 to 2 P_c, or at approaches from −0.8 to 3 δ0. The
    others have sizes and properties of any magnitude. A load reaches no fold.
    """
    random = numpy.random.default_rng(_SEED)

    def powers(low: float, high: float) -> Any:
        return 10 ** random.uniform(low, high, count)

    sizes = {
        "radius": powers(-8, -4),
        "work_of_adhesion": powers(-2, 0.3),
        "contact_modulus": powers(9, 11.5),
        "density": powers(3, 4),
        "yield_displacement": powers(-10, -9.3),
        "gravity": powers(-3, 1),
        "atomic_spacing": powers(-10, -9),
    }
    sizes["radius2"] = sizes["radius"] * powers(-1, 1)
    any_sizes = {
        "radius": powers(-12, 3),
        "radius2": powers(-12, 3),
        "work_of_adhesion": powers(-6, 2),
        "contact_modulus": powers(4, 13),
        "density": powers(1, 5),
        "yield_displacement": powers(-12, -6),
        "gravity": powers(-3, 3),
    }
    strain = any_sizes["work_of_adhesion"] / any_sizes["contact_modulus"]
    reduced = reduced_radius(radius=any_sizes["radius"], radius2=any_sizes["radius2"])
    any_sizes["atomic_spacing"] = numpy.cbrt(reduced * strain * strain) / powers(-4, 4)  # μ from 1e-4 to 1e4

    sign = numpy.sign(random.uniform(-1, 1, count))
    small, tiny = sign * powers(-15, -2), sign * powers(-18, -2)
    is_tiny = numpy.arange(count) % 2 == 0
    huge, huge_load = numpy.where(is_tiny, powers(0, 6), powers(6, 60)), numpy.where(is_tiny, tiny, powers(0, 9))
    return {
        "ordinary": _at(sizes, random.uniform(-0.8, 3, count), random.uniform(-0.8, 2, count)),
        "pull-off": _at(any_sizes, _PULL_OFF_APPROACH * (1 + small), powers(-15, -2) - 1),
        "fold": _at(any_sizes, FOLD_APPROACH + powers(-14, -1)),
        "δ = 0": _at(any_sizes, tiny, -8 / 9 * (1 + small)),
        "extreme": _at(any_sizes, huge, huge_load),
    }


def _at(sizes: Arrays, approach_ratio: Any, load_ratio: Any = None) -> Arrays:
    """Return points at approaches and, if there are any, at loads that are multiples of the pull-off force, as it is rounded."""
    points = {**sizes, "approach_at_load": approach_ratio, "approach": numpy.ones_like(approach_ratio)}
    if load_ratio is None:
        return points
    reduced = reduced_radius(radius=sizes["radius"], radius2=sizes["radius2"])
    force = pull_off_force(work_of_adhesion=sizes["work_of_adhesion"], reduced_radius=reduced)
    return {**points, "pull_off_force": force, "load": numpy.maximum(load_ratio * force, -force)}


def each(points: Arrays) -> list[dict[str, float]]:
    """Return the points as dictionaries of floats."""
    return [dict(zip(points, row, strict=True)) for row in zip(*(v.tolist() for v in points.values()), strict=True)]


# --- Exact values -----------------------------------------------------------------------------------------------------

SYMBOLS = {
    "R1": "radius", "R2": "radius2", "w": "work_of_adhesion", "E": "contact_modulus", "rho": "density",
    "xi": "yield_displacement", "g": "gravity", "P": "load", "P_c": "pull_off_force",
    "delta": "approach_at_load", "delta0": "approach", "z0": "atomic_spacing",
}  # fmt: skip
DIGITS = 60
_CONTEXT = Context(prec=DIGITS)
_ROUGH = Context(prec=18)
_STEP = Decimal("1e-20")  # of an input, relative, for a slope: its square is beyond the digits that are compared


def inputs_of(way: Callable[..., Any]) -> tuple[str, ...]:
    """Return the names of the inputs of a function whose parameters are the paper's symbols."""
    code = way.__code__
    return tuple(SYMBOLS[symbol] for symbol in code.co_varnames[: code.co_argcount])


@cache
def references() -> Mapping[str, Callable[..., Any]]:
    """Return the equation of each quantity, for arguments of 60 digits in the paper's symbols."""
    with localcontext(_CONTEXT):
        pi = 16 * _arc_tangent(1 / Decimal(5)) - 4 * _arc_tangent(1 / Decimal(239))

    def sqrt(value: Any) -> Any:
        return value.sqrt()

    def cbrt(value: Any) -> Any:
        """Refine a root of 18 digits by Newton's method."""
        root = _ROUGH.power(value, _ROUGH.divide(Decimal(1), Decimal(3)))
        for _ in range(2):
            root = (2 * root + value / (root * root)) / 3
        return root

    def reduced(one: Any, two: Any) -> Any:
        return 1 / (1 / one + 1 / two)

    def factor(P: Any, P_c: Any) -> Any:
        """Eq 5: x = â^(3/2), the larger root of P/P_c = 4(x² − x)."""
        return (1 + sqrt(1 + P / P_c)) / 2

    def stretch(P: Any, P_c: Any) -> Any:
        return cbrt(factor(P, P_c) ** 2)

    def force(R1: Any, R2: Any, w: Any) -> Any:
        return 3 * pi * (w / 2) * reduced(R1, R2)

    def radius(R1: Any, R2: Any, w: Any, E: Any) -> Any:
        return cbrt(9 * pi * (w / 2) * reduced(R1, R2) ** 2 / E)

    def approach(R1: Any, R2: Any, w: Any, E: Any) -> Any:
        return force(R1, R2, w) / (E * radius(R1, R2, w, E))

    def moment(R1: Any, R2: Any, w: Any, xi: Any, P: Any, P_c: Any) -> Any:
        return 4 * force(R1, R2, w) * factor(P, P_c) * xi

    def stiffness(R1: Any, R2: Any, w: Any, E: Any, P: Any, P_c: Any) -> Any:
        """Slope of P(δ) through those of P(â), Eq 5, and of δ(â), Eq 6."""
        a_ = stretch(P, P_c)
        slope = (12 * a_**2 - 6 * sqrt(a_)) / (6 * a_ - 1 / sqrt(a_))
        return force(R1, R2, w) / approach(R1, R2, w, E) * slope

    def mass(R: Any, rho: Any) -> Any:
        return 4 * pi / 3 * R**3 * rho

    def inertia(R: Any, rho: Any) -> Any:
        return 2 * mass(R, rho) * R**2 / 5

    def factor_at_approach(delta: Any, delta0: Any) -> Any:
        """Eq 6 by Newton's method, which is monotone from above the root."""
        ratio, step = delta / delta0, Decimal(1)
        y = 1 + sqrt(sqrt(abs(ratio)))
        while abs(step) > abs(y) * Decimal(10) ** -(DIGITS // 2):  # the last step squares that
            step = (3 * y**4 - 2 * y - ratio) / (12 * y**3 - 2)
            y -= step
        return y**3

    def radius_maugis(R1: Any, R2: Any, w: Any, E: Any, z0: Any, P: Any) -> Any:
        """Maugis' two equations for a and m = c/a at a load, by the secant method in v = 1/√(m² − 1)."""
        R, K = reduced(R1, R2), 4 * E / 3
        unit_force = pi * w * R
        lambda_ = 2 * 16 * w / (9 * sqrt(Decimal(3)) * z0) / cbrt(pi * w * K**2 / R)

        def state(v: Any) -> tuple[Any, Any]:
            """Return the radius and the force at a width of the ring, in Maugis' units."""
            m = sqrt(1 + 1 / v**2)
            t, angle = 1 / v, _arc_tangent(1 / v)
            ring = lambda_ / 2 * (t + (m**2 - 2) * angle)
            both = 4 * lambda_**2 / 3 * (t * angle - m + 1)
            a = 2 / (both + sqrt(both**2 + 4 * ring))
            return a, a**3 - lambda_ * a**2 * (t + m**2 * angle)

        given = {"work_of_adhesion": w, "reduced_radius": R, "transition_parameter": lambda_, "load": P}
        near = Scene({name: float(value) for name, value in given.items()})["edge_ratio_at_load"]
        v = _root(lambda v: state(v)[1] - P / unit_force, Decimal(near))
        return state(v)[0] * cbrt(unit_force * R / K)

    return {
        "pull_off_force": force,
        "contact_radius_at_load": lambda R1, R2, w, E, P, P_c: radius(R1, R2, w, E) * stretch(P, P_c),
        "approach_at_load": lambda R1, R2, w, E, P, P_c: (
            approach(R1, R2, w, E) * (3 * stretch(P, P_c) ** 2 - 2 * sqrt(stretch(P, P_c)))),
        "stiffness": stiffness,
        "load_factor_at_approach": factor_at_approach,
        "contact_radius_maugis": radius_maugis,
        "yield_moment": moment,
        "r_min": lambda R1, R2, xi: R1 * R2 / xi,
        "n_grav": lambda R1, R2, w, rho, xi, g, P, P_c: sqrt(moment(R1, R2, w, xi, P, P_c) / (mass(R1, rho) * g * R1)),
        "vertical_frequency": lambda R1, R2, w, E, rho, P, P_c: (
            sqrt(stiffness(R1, R2, w, E, P, P_c) / reduced(mass(R1, rho), mass(R2, rho))) / (2 * pi)),
        "rolling_frequency": lambda R1, R2, w, rho, P, P_c: (
            sqrt(4 * force(R1, R2, w) * factor(P, P_c) * reduced(R1, R2) / reduced(inertia(R1, rho), inertia(R2, rho)))
            / (2 * pi)),
        "n_roll": lambda R1, R2, w, E, xi, P, P_c: approach(R1, R2, w, E) / (14 * pi * factor(P, P_c) * xi),
    }  # fmt: skip


class Exact(NamedTuple):
    """The double nearest to an exact value, the rest, and the condition of the value."""

    nearest: float
    rest: float
    condition: float  # κ: how many times a relative error of the state that is given appears in the value


def digits(quantity: str, point: Mapping[str, float]) -> Decimal:
    """Return the value of a quantity at a point, in 60 digits."""
    with localcontext(_CONTEXT):
        value: Decimal = references()[quantity](*_arguments(quantity, point).values())
        return value


def exact(quantity: str, point: Mapping[str, float]) -> Exact:
    """Return the exact value of a quantity at a point, and its condition in the state and, by Maugis, in λ, a multiple of 1/z0.

    An input is moved towards zero, where there is a contact, too.
    """
    value, reference, given = digits(quantity, point), references()[quantity], _arguments(quantity, point)
    condition = 0.0
    with localcontext(_CONTEXT):
        for name in given.keys() & {"load", "approach_at_load", "atomic_spacing"} if value else ():
            moved = reference(*{**given, name: given[name] * (1 - _STEP)}.values())
            condition += float(abs((moved - value) / (value * _STEP)))
        return Exact(float(value), float(value - Decimal(float(value))), condition)


def _arguments(quantity: str, point: Mapping[str, float]) -> dict[str, Decimal]:
    return {name: Decimal(point[name]) for name in inputs_of(references()[quantity])}


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
    at_last = function(last)
    while abs(root - last) > abs(root).scaleb(-25):  # the last step leaves far less
        at_root = function(root)
        last, root, at_last = root, root - at_root * (root - last) / (at_root - at_last), at_root
    return root
