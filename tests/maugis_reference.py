"""Maugis' own two equations for the contact radius and m = c/a, in 120 digits; the unknowns are Ā and t = √(m² − 1).

Maugis (J. Colloid Interface Sci. 150, 243, 1992), with K = 4E*/3 and his transition parameter λ. The units are
(πwR²/K)^(1/3) for radii, πwR for loads and (π²w²R/K²)^(1/3) for approaches:

    (λĀ²/2)[√(m²−1) + (m²−2)arcsec m] + (4λ²Ā/3)[√(m²−1) arcsec m − m + 1] = 1
    P̄ = Ā³ − λĀ²[√(m²−1) + m² arcsec m]          δ̄ = Ā² − (4/3)λĀ√(m²−1)

A position on the curve is ln t. Load and approach fall along it, to pull-off and to the fold. Bisection therefore finds
a position close enough to a state for the secant method. This module shares nothing with `jkroll`.
"""

from collections.abc import Callable
from functools import cache
from typing import Any

from mpmath import MPContext  # type: ignore[import-untyped]

Exact = Any  # an mpf of the context below; mpmath declares no types
OfState = Callable[[Exact, Exact, Exact], Exact]  # a function of Ā, t and λ

digits = MPContext()  # our own context, since other tests change the precision of mpmath's
digits.dps = 120
mpf, sqrt, cbrt = digits.mpf, digits.sqrt, digits.cbrt
pi = digits.pi  # to as many digits as needed


def arcsec(t: Exact) -> Exact:
    """Return arcsec m, which is arctan t."""
    return digits.atan(t)


def radius_of(t: Exact, transition: Exact) -> Exact:
    """Return Ā from the first equation, which is quadratic in Ā."""
    first = transition / 2 * (t + (t**2 - 1) * arcsec(t))
    second = 4 * transition**2 / 3 * (t * arcsec(t) - sqrt(1 + t**2) + 1)
    return 2 / (second + sqrt(second**2 + 4 * first))


def load(a: Exact, t: Exact, transition: Exact) -> Exact:
    return a**3 - transition * a**2 * (t + (1 + t**2) * arcsec(t))


def approach(a: Exact, t: Exact, transition: Exact) -> Exact:
    return a**2 - 4 * transition * a * t / 3


# --- States -----------------------------------------------------------------------------------------------------------


@cache
def at_load(transition: Exact, wanted: Exact) -> tuple[Exact, Exact]:
    """Return the Ā and t of the stable contact at a load."""
    if wanted < load(*pull_off(transition), transition):
        raise ValueError("beyond pull-off")
    return _solve(load, wanted, transition)


@cache
def at_approach(transition: Exact, wanted: Exact) -> tuple[Exact, Exact]:
    """Return the Ā and t of the contact that fixed grips hold at an approach."""
    return _solve(approach, wanted, transition)


def held_at(transition: Exact, delta: Exact) -> tuple[Exact, Exact]:
    """Return the Ā and t of the state that fixed grips hold at an approach: 0 and infinity without contact."""
    if delta < lowest_approach(transition):
        raise ValueError("beyond the fold")
    is_apart = not folds_in_contact(transition) and delta <= touch_approach(transition)
    return (mpf(0), digits.inf) if is_apart else at_approach(transition, delta)


def folds_in_contact(transition: Exact) -> bool:
    """Return whether spheres are in contact when fixed grips let them go."""
    return bool(transition > cbrt(9 * pi / (16 * (pi - 1))))


def zone_at_touch(transition: Exact) -> Exact:
    """Return c̄ of spheres that first touch: Ā is 0, and the first equation gives c̄, the limit of Ām."""
    second = 4 * transition**2 / 3 * (pi / 2 - 1)
    return 2 / (second + sqrt(second**2 + pi * transition))


def touch_approach(transition: Exact) -> Exact:
    """Return the approach at which the spheres first touch."""
    return -4 * transition / 3 * zone_at_touch(transition)


def zone_apart(transition: Exact, delta: Exact) -> Exact:
    """Return c̄ of spheres that attract each other without contact: c̄²/2 − bc̄ = δ̄ + 2/(πλ), with b = 8λ/(3π)."""
    b = 8 * transition / (3 * pi)
    return b + sqrt(b**2 + 2 * (delta + 2 / (pi * transition)))


def lowest_approach(transition: Exact) -> Exact:
    """Return the lowest approach at which fixed grips hold the spheres, in contact or apart."""
    if folds_in_contact(transition):
        return approach(*fold(transition), transition)
    return -((8 * transition / (3 * pi)) ** 2) / 2 - 2 / (pi * transition)


@cache
def pull_off(transition: Exact) -> tuple[Exact, Exact]:
    """Return the Ā and t of the largest tension."""
    return _least(load, transition)


@cache
def fold(transition: Exact) -> tuple[Exact, Exact]:
    """Return the Ā and t of the lowest approach in contact."""
    return _least(approach, transition)


def _state(position: Exact, transition: Exact) -> tuple[Exact, Exact]:
    t = digits.exp(position)
    return radius_of(t, transition), t


def _slope(of_state: OfState, position: Exact, transition: Exact) -> Exact:
    """Return the slope of a function along the curve, to two thirds of the digits that cancellation leaves."""
    step = mpf(10) ** (-digits.dps // 3)
    before, after = (of_state(*_state(position + side, transition), transition) for side in (-step, step))
    return (after - before) / (2 * step)


@cache
def _end_of_fall(of_state: OfState, transition: Exact) -> Exact:
    """Return a position just before the end of a function's fall along the curve."""
    return _bisect(lambda position: _slope(of_state, position, transition) < 0, mpf(digits.dps))


def _bisect(is_before: Callable[[Exact], bool], high: Exact) -> Exact:
    """Return a position just before the one where a condition ceases to hold.

    The search starts where cancellation in the equations, proportional to t², leaves half of the digits.
    """
    low = -mpf(digits.dps) / 2
    while high - low > 0.1:
        middle = (low + high) / 2
        low, high = (middle, high) if is_before(middle) else (low, middle)
    return low


def _solve(of_state: OfState, wanted: Exact, transition: Exact) -> tuple[Exact, Exact]:
    def excess(position: Exact) -> Exact:
        return of_state(*_state(position, transition), transition) - wanted

    position = _root(excess, _bisect(lambda position: excess(position) > 0, _end_of_fall(of_state, transition)))
    assert abs(excess(position)) <= mpf(10) ** -50 * (1 + abs(wanted))
    return _state(position, transition)


def _least(of_state: OfState, transition: Exact) -> tuple[Exact, Exact]:
    position = _root(lambda position: _slope(of_state, position, transition), _end_of_fall(of_state, transition))
    return _state(position, transition)


def _root(function: Callable[[Exact], Exact], start: Exact) -> Exact:
    ends = start, start + mpf(10) ** -12
    return digits.findroot(function, ends, tol=mpf(10) ** (-digits.dps // 2), maxsteps=90, verify=False)


# --- Energies ---------------------------------------------------------------------------------------------------------


def energy_by_quadrature(t: Exact, transition: Exact) -> Exact:
    """Return the energy Φ̄ of a state, over πwR and the unit of approaches, by quadrature of the force along the curve.

    The path begins where attraction begins, without contact, and leads through the first touch to the state.
    """
    b = 8 * transition / (3 * pi)
    apart = digits.quad(lambda c: -pi * transition / 2 * c * c * (c - b), [0, zone_at_touch(transition)])

    def power(angle: Exact) -> Exact:
        """Return the load times dδ̄/d(angle), with t = tan(angle)."""
        at = digits.tan(angle)
        return load(radius_of(at, transition), at, transition) * slope_of_approach(angle)

    def slope_of_approach(angle: Exact) -> Exact:
        step = mpf(10) ** (-digits.dps // 3)
        here, there = (digits.tan(angle + side) for side in (step, -step))
        first, last = (approach(radius_of(each, transition), each, transition) for each in (here, there))
        return (first - last) / (2 * step)

    return apart + digits.quad(power, [pi / 2, arcsec(t)], method="gauss-legendre")


def energy_terms(a: Exact, span: Exact, delta: Exact, transition: Exact) -> tuple[Exact, ...]:
    """Return the terms of Φ̄ in closed form, whose sum quadrature confirms; `span` is Āt, or c̄ without contact."""
    angle, c = digits.atan2(span, a), sqrt(a**2 + span**2)
    ring = span**4 * angle - a * span**3 + (2 * a * span**2 + 3 * a**3) * (span - a * angle)
    return (
        3 * a * delta**2 / 4,
        -(a**3) * delta / 2,
        3 * a**5 / 20,
        -(c**2),
        transition * ring / 4,
        transition * (c**2 * angle - a * span) * (a**2 - delta),
        -4 * transition**2 * span**4 * (a + 2 * c) / (a + c) ** 2 / 9,
    )


def energy(a: Exact, span: Exact, delta: Exact, transition: Exact) -> Exact:
    return sum(energy_terms(a, span, delta, transition))


def contact_energy(a: Exact, t: Exact, transition: Exact) -> Exact:
    """Return Φ̄ of a contact."""
    return energy(a, a * t, approach(a, t, transition), transition)


def energy_held_at(transition: Exact, delta: Exact) -> Exact:
    """Return Φ̄ of the state that fixed grips hold at an approach, in contact or apart."""
    a, t = held_at(transition, delta)
    return energy(a, a * t if a else zone_apart(transition, delta), delta, transition)


def fold_energy(transition: Exact) -> Exact:
    """Return Φ̄ where fixed grips let go, in contact or apart."""
    if folds_in_contact(transition):
        return contact_energy(*fold(transition), transition)
    return energy(mpf(0), 8 * transition / (3 * pi), lowest_approach(transition), transition)
