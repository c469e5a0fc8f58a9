"""Chains of spheres: Eqs 28-30."""

from __future__ import annotations

from .dimensions import Acceleration, Length, Mass, Moment, Number
from .elementary import sqrt


def r_min(*, radius: Length, radius2: Length, yield_displacement: Length) -> Length:
    """Return the smallest radius of curvature to which a straight chain bends without rolling.

        R_min = R1R2/ξ, which is R1²/ξ for identical spheres

    radius              [m]  > 0
    radius2             [m]  > 0; infinite for a plane
    yield_displacement  [m]  > 0

    Returns:  [m]; a float for floats, an array for arrays, which broadcast.
    Source:   Eq (28); spheres 1 and 2 alternate.
    Valid:    A long chain, every contact bent to its yield angle.
    Accuracy: 1.5 ulp.

    >>> f"{r_min(radius=1e-7, radius2=1e-7, yield_displacement=2e-10):.4e}"
    '5.0000e-05'
    """
    return radius * (radius2 / yield_displacement)


def gravity_moment(*, mass: Mass, gravity: Acceleration, radius: Length, number: Number) -> Moment:
    """Return the moment on the first contact of a straight, level chain of N spheres.

        M = m1 g R1 N²

    mass     [kg]    > 0
    gravity  [m/s²]  > 0
    radius   [m]     > 0
    number   [1]     ≥ 0

    Returns:  [N m]; a float for floats, an array for arrays, which broadcast.
    Source:   Eq (29).
    Valid:    Body 2, to which the chain is fixed, does not move.
    Accuracy: 2.5 ulp above its mass.

    >>> gravity_moment(mass=1.0, gravity=9.0, radius=0.5, number=2.0)
    18.0
    """
    return mass * gravity * radius * number**2


def n_grav(*, yield_moment: Moment, mass: Mass, gravity: Acceleration, radius: Length) -> Number:
    """Return the number of spheres 1 that hang level from a fixed body 2 before the first contact rolls.

        N = √(M/(m1 g R1)) = √(9γRξ/(R1⁴ρg)), which is √(9γξ/(2R1³ρg)) for identical spheres

    yield_moment  [N m]   > 0
    mass          [kg]    > 0
    gravity       [m/s²]  > 0
    radius        [m]     > 0

    Returns:  [1]; a float for floats, an array for arrays, which broadcast.
    Source:   Eqs (29) and (30).
    Valid:    A straight chain, all of one mass. Below 1, not even one sphere holds.
    Accuracy: 2 ulp above M and m1.

    >>> round(n_grav(yield_moment=9.42478e-18, mass=1.0891e-17, gravity=9.80665, radius=1e-7), 1)
    939.4
    """
    return sqrt(yield_moment / (mass * gravity * radius))
