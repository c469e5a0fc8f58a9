"""The paper's equations in 60 digits, in their plainest form, against which the benchmark measures errors.

The only module that imports mpmath. Inputs are doubles and taken as exact. The state is that of a load and a pull-off
force, or of an approach in units of the unloaded one.
"""

# ruff: noqa: N803  (the paper's symbols)

from collections.abc import Callable, Mapping
from functools import cache
from typing import Any

DIGITS = 60

SYMBOLS = {
    "R1": "radius", "R2": "radius2", "w": "work_of_adhesion", "E": "contact_modulus", "rho": "density",
    "xi": "yield_displacement", "g": "gravity", "P": "load", "P_c": "pull_off_force",
    "delta": "approach_at_load", "delta0": "approach",
}  # fmt: skip


def inputs_of(way: Callable[..., Any]) -> tuple[str, ...]:
    """Return the names of the inputs of a function whose parameters are the paper's symbols."""
    code = way.__code__
    return tuple(SYMBOLS[symbol] for symbol in code.co_varnames[: code.co_argcount])


@cache
def _digits() -> Any:
    """Return mpmath's arithmetic of 60 digits, in a context of its own."""
    from mpmath import MPContext  # type: ignore[import-untyped]

    context = MPContext()
    context.dps = DIGITS
    return context


@cache
def references() -> Mapping[str, Callable[..., Any]]:
    """Return the equation of each quantity, for arguments of 60 digits in the paper's symbols."""
    mp = _digits()
    pi, sqrt, cbrt = +mp.pi, mp.sqrt, mp.cbrt

    def reduced(one: Any, two: Any) -> Any:
        return 1 / (1 / one + 1 / two)

    def state(P: Any, P_c: Any) -> Any:
        """Eq 5: x = â^(3/2), the larger root of P/P_c = 4(x² − x)."""
        return (1 + sqrt(1 + P / P_c)) / 2

    def force(R1: Any, R2: Any, w: Any) -> Any:
        return 3 * pi * (w / 2) * reduced(R1, R2)

    def radius(R1: Any, R2: Any, w: Any, E: Any) -> Any:
        return cbrt(9 * pi * (w / 2) * reduced(R1, R2) ** 2 / E)

    def approach(R1: Any, R2: Any, w: Any, E: Any) -> Any:
        return force(R1, R2, w) / (E * radius(R1, R2, w, E))

    def stretch(P: Any, P_c: Any) -> Any:
        return cbrt(state(P, P_c) ** 2)

    def moment(R1: Any, R2: Any, w: Any, xi: Any, P: Any, P_c: Any) -> Any:
        return 4 * force(R1, R2, w) * state(P, P_c) * xi

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
        ratio, step = delta / delta0, mp.mpf(1)
        y = 1 + sqrt(sqrt(abs(ratio)))
        while abs(step) > abs(y) * mp.mpf(10) ** -(DIGITS // 2):  # the last step squares that
            step = (3 * y**4 - 2 * y - ratio) / (12 * y**3 - 2)
            y -= step
        return y**3

    return {
        "pull_off_force": force,
        "contact_radius": radius,
        "approach": approach,
        "contact_radius_at_load": lambda R1, R2, w, E, P, P_c: radius(R1, R2, w, E) * stretch(P, P_c),
        "approach_at_load": lambda R1, R2, w, E, P, P_c: (
            approach(R1, R2, w, E) * (3 * stretch(P, P_c) ** 2 - 2 * sqrt(stretch(P, P_c)))),
        "stiffness": stiffness,
        "load_factor_at_approach": factor_at_approach,
        "yield_moment": moment,
        "yield_force": lambda R1, R2, w, xi, P, P_c: moment(R1, R2, w, xi, P, P_c) / R1,
        "r_min": lambda R1, R2, xi: R1 * R2 / xi,
        "n_grav": lambda R1, R2, w, rho, xi, g, P, P_c: sqrt(moment(R1, R2, w, xi, P, P_c) / (mass(R1, rho) * g * R1)),
        "vertical_frequency": lambda R1, R2, w, E, rho, P, P_c: (
            sqrt(stiffness(R1, R2, w, E, P, P_c) / reduced(mass(R1, rho), mass(R2, rho))) / (2 * pi)),
        "rolling_frequency": lambda R1, R2, w, rho, P, P_c: (
            sqrt(4 * force(R1, R2, w) * state(P, P_c) * reduced(R1, R2) / reduced(inertia(R1, rho), inertia(R2, rho)))
            / (2 * pi)),
        "n_roll": lambda R1, R2, w, E, xi, P, P_c: approach(R1, R2, w, E) / (14 * pi * state(P, P_c) * xi),
    }  # fmt: skip


def exact(quantity: str, point: Mapping[str, float]) -> tuple[float, float]:
    """Return the double nearest to the exact value at a point, and the rest."""
    reference = references()[quantity]
    value = reference(*(_digits().mpf(point[name]) for name in inputs_of(reference)))
    return float(value), float(value - float(value))
