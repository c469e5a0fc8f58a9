"""Maugis' own two equations for the contact radius and c/a, in 80-digit arithmetic; the unknowns are Ā and m = c/a.

Maugis (J. Colloid Interface Sci. 150, 243, 1992), in units of (πwR²/K)^(1/3), πwR and (π²w²R/K²)^(1/3):

    (λĀ²/2)[√(m²−1) + (m²−2)arcsec m] + (4λ²Ā/3)[√(m²−1) arcsec m − m + 1] = 1
    P̄ = Ā³ − λĀ²[√(m²−1) + m² arcsec m]          δ̄ = Ā² − (4/3)λĀ√(m²−1)

Nothing is shared with `jkroll`.
"""

from collections.abc import Callable
from typing import Any

from mpmath import MPContext  # type: ignore[import-untyped]

Exact = Any

digits = MPContext()
digits.dps = 80
mpf, pi, sqrt, cbrt = digits.mpf, +digits.pi, digits.sqrt, digits.cbrt


def arcsec(m: Exact) -> Exact:
    return digits.acos(1 / m)


def zone(a: Exact, m: Exact, transition: Exact) -> Exact:
    """Return the first equation's left side, less 1."""
    t = sqrt(m * m - 1)
    first = transition * a**2 / 2 * (t + (m * m - 2) * arcsec(m))
    return first + 4 * transition**2 * a / 3 * (t * arcsec(m) - m + 1) - 1


def load(a: Exact, m: Exact, transition: Exact) -> Exact:
    return a**3 - transition * a**2 * (sqrt(m * m - 1) + m * m * arcsec(m))


def approach(a: Exact, m: Exact, transition: Exact) -> Exact:
    return a**2 - 4 * transition * a * sqrt(m * m - 1) / 3


def solve(
    equation: Callable[[Exact, Exact], Exact], transition: Exact, start: tuple[float, float]
) -> tuple[Exact, Exact]:
    """Return the Ā and m that satisfy the first equation and another one; the start is an Ā and a √(m² − 1)."""

    def system(log_a: Exact, log_t: Exact) -> tuple[Exact, Exact]:
        a, m = digits.exp(log_a), sqrt(1 + digits.exp(2 * log_t))
        return zone(a, m, transition), equation(a, m)

    first = digits.log(start[0]), digits.log(start[1])
    log_a, log_t = digits.findroot(system, first, tol=mpf(10) ** -90, maxsteps=50, verify=False)
    a, m = digits.exp(log_a), sqrt(1 + digits.exp(2 * log_t))
    assert max(abs(zone(a, m, transition)), abs(equation(a, m))) < mpf(10) ** -40
    return a, m


def at_load(transition: Exact, wanted: Exact, start: tuple[float, float]) -> tuple[Exact, Exact]:
    return solve(lambda a, m: load(a, m, transition) - wanted, transition, start)


def at_approach(transition: Exact, wanted: Exact, start: tuple[float, float]) -> tuple[Exact, Exact]:
    return solve(lambda a, m: approach(a, m, transition) - wanted, transition, start)


def slopes(a: Exact, m: Exact, transition: Exact) -> tuple[Exact, Exact]:
    """Return dP̄/dm and dδ̄/dm along the curve."""
    h = mpf(10) ** -30

    def partial(f: Callable[..., Exact], *, of_m: bool) -> Exact:
        step_a, step_m = (0, h * (m - 1)) if of_m else (h * a, 0)
        return (f(a + step_a, m + step_m, transition) - f(a - step_a, m - step_m, transition)) / (2 * (step_a + step_m))

    turn = -partial(zone, of_m=True) / partial(zone, of_m=False)
    return tuple(partial(f, of_m=True) + turn * partial(f, of_m=False) for f in (load, approach))


def stiffness(a: Exact, m: Exact, transition: Exact) -> Exact:
    of_load, of_approach = slopes(a, m, transition)
    return of_load / of_approach


def radius_of(m: Exact, transition: Exact) -> Exact:
    """Return Ā at a given m, from the first equation, a quadratic."""
    t = sqrt(m * m - 1)
    first = transition / 2 * (t + (m * m - 2) * arcsec(m))
    second = 4 * transition**2 / 3 * (t * arcsec(m) - m + 1)
    return 2 / (second + sqrt(second**2 + 4 * first))


def pull_off(transition: Exact, start: float) -> tuple[Exact, Exact]:
    """Return the Ā and m of the largest tension; the start is a √(m² − 1)."""
    return _extreme(0, transition, start)


def fold(transition: Exact, start: float) -> tuple[Exact, Exact]:
    """Return the Ā and m of the least approach in contact; the start is a √(m² − 1)."""
    return _extreme(1, transition, start)


def _extreme(which: int, transition: Exact, start: float) -> tuple[Exact, Exact]:
    def slope(log_t: Exact) -> Exact:
        m = sqrt(1 + digits.exp(2 * log_t))
        return slopes(radius_of(m, transition), m, transition)[which] * (m - 1)

    first = digits.log(start)
    log_t = digits.findroot(slope, (first, first + mpf(10) ** -8), tol=mpf(10) ** -40, maxsteps=50, verify=False)
    assert abs(slope(log_t)) < mpf(10) ** -30
    m = sqrt(1 + digits.exp(2 * log_t))
    return radius_of(m, transition), m


def energy(m: Exact, transition: Exact) -> Exact:
    """Return Φ̄ at a state by quadrature of the force along the curve.

    It leads from where attraction begins, without contact at first, to where the spheres touch, and on to the state.
    """
    b = 8 * transition / (3 * pi)
    quarter = pi * transition / 4
    slope = 4 * transition**2 / 3 * (pi / 2 - 1)
    touch = 2 / (slope + sqrt(slope**2 + 4 * quarter))
    apart = digits.quad(lambda c: -2 * quarter * c * c * (c - b), [0, touch])

    def power(angle: Exact) -> Exact:
        at = 1 / digits.cos(angle)
        return load(radius_of(at, transition), at, transition) * slope_of(angle)

    def slope_of(angle: Exact) -> Exact:
        step = mpf(10) ** (-digits.dps // 3)
        here, there = (1 / digits.cos(angle + side) for side in (step, -step))
        first, last = (approach(radius_of(m, transition), m, transition) for m in (here, there))
        return (first - last) / (2 * step)

    return apart + digits.quad(power, [pi / 2, arcsec(m)], method="gauss-legendre")
