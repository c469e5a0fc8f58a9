"""Models of the rolling moment: Eqs 16-24, and the exact moment at a fixed approach.

At a fixed load Eq (25) is exact. At a fixed approach the exact moment is larger by E*aξ³/R, and the two half-circles
exceed it by as much again.
"""

from __future__ import annotations

from .dimensions import Force, Length, Moment, Stress
from .elementary import cube


def unloaded_moment(*, pull_off_force: Force, yield_displacement: Length) -> Moment:
    """Return the moment of a contact without load, which the paper uses from Eq (26) on.

        M = 4 P_c ξ

    pull_off_force      [N]  > 0
    yield_displacement  [m]  > 0

    Returns:  [N m]; a float for floats, an array for arrays, which broadcast.
    Source:   Eq (25) with â = 1.
    Valid:    |P| ≪ P_c.
    Accuracy: 0.5 ulp above P_c.

    >>> unloaded_moment(pull_off_force=1.0, yield_displacement=0.5)
    2.0
    """
    return 4 * pull_off_force * yield_displacement


def half_circle_moment(
    *, half_circle_radius: Length, approach_at_load: Length, contact_modulus: Stress, reduced_radius: Length
) -> Moment:
    """Return the moment of one half of a symmetric contact about its diameter.

        M½ = ½E*𝒜²δ − (π/8)p_H𝒜³ = ½E*𝒜²δ − (E*/4R)𝒜⁴

    half_circle_radius  [m]   > 0
    approach_at_load    [m]   any
    contact_modulus     [Pa]  > 0
    reduced_radius      [m]   > 0

    Returns:  [N m]; a float for floats, an array for arrays, which broadcast.
    Source:   Eqs (22) and (23), with p_H = 2𝒜E*/(πR); Eq (21) has ¼ for π/4.
    Valid:    𝒜 ≪ R.
    Accuracy: 4.5 ulp of the larger term.

    >>> half_circle_moment(half_circle_radius=2.0, approach_at_load=1.0, contact_modulus=1.0, reduced_radius=4.0)
    1.0
    """
    depth = approach_at_load / 2 - half_circle_radius**2 / (4 * reduced_radius)
    return contact_modulus * half_circle_radius**2 * depth


def linearised_moment(
    *,
    contact_radius_at_load: Length,
    yield_displacement: Length,
    approach_at_load: Length,
    contact_modulus: Stress,
    reduced_radius: Length,
) -> Moment:
    """Return the moment of the two half-circles to first order in ξ, in equilibrium or not.

        M = 2ξ(3P_câ³ − E*aδ) = 2ξE*a(a²/R − δ)

    contact_radius_at_load  [m]   > 0
    yield_displacement      [m]   > 0
    approach_at_load        [m]   any
    contact_modulus         [Pa]  > 0
    reduced_radius          [m]   > 0

    Returns:  [N m]; a float for floats, an array for arrays, which broadcast.
    Source:   Eq (24).
    Valid:    ξ ≪ a. With Eq (6) for δ it is Eq (25).
    Accuracy: 4.5 ulp of the larger term.

    >>> linearised_moment(contact_radius_at_load=1.0, yield_displacement=1.0, approach_at_load=0.0,
    ...                   contact_modulus=1.0, reduced_radius=1.0)
    2.0
    """
    depth = contact_radius_at_load**2 / reduced_radius - approach_at_load
    return 2 * yield_displacement * contact_modulus * contact_radius_at_load * depth


def half_circles_moment(
    *,
    yield_moment: Moment,
    contact_modulus: Stress,
    contact_radius_at_load: Length,
    yield_displacement: Length,
    reduced_radius: Length,
) -> Moment:
    """Return the moment of two half-circles of radius a + ξ and a − ξ at the same approach, not linearised.

        M_half = M½(a − ξ) − M½(a + ξ) = 2ξE*a((a² + ξ²)/R − δ) = M + 2E*aξ³/R

    yield_moment            [N m]  > 0
    contact_modulus         [Pa]   > 0
    contact_radius_at_load  [m]    > 0
    yield_displacement      [m]    > 0
    reduced_radius          [m]    > 0

    Returns:  [N m]; a float for floats, an array for arrays, which broadcast.
    Source:   Eqs (19) and (23); with Eqs (6) and (25), the last form, which does not cancel.
    Valid:    ξ < a. It exceeds the exact moment at a fixed approach by E*aξ³/R.
    Accuracy: 3 ulp above its parts.

    >>> half_circles_moment(yield_moment=1.0, contact_modulus=1.0, contact_radius_at_load=2.0, yield_displacement=1.0,
    ...                     reduced_radius=1.0)
    5.0
    """
    cubic = contact_modulus * contact_radius_at_load * cube(yield_displacement) / reduced_radius
    return yield_moment + 2 * cubic


def fixed_approach_moment(
    *,
    yield_moment: Moment,
    contact_modulus: Stress,
    contact_radius_at_load: Length,
    yield_displacement: Length,
    reduced_radius: Length,
) -> Moment:
    """Return the exact moment of the shifted circle whose approach is held while it shifts.

        M = 4P_c â^(3/2) ξ + E*aξ³/R = 4P_c â^(3/2) ξ [1 + (3/4)(ξ/a0)²/√â]

    yield_moment            [N m]  > 0
    contact_modulus         [Pa]   > 0
    contact_radius_at_load  [m]    > 0
    yield_displacement      [m]    > 0
    reduced_radius          [m]    > 0

    Returns:  [N m]; a float for floats, an array for arrays, which broadcast.
    Source:   Hertz, flat punch and tilted flat punch on one circle; Eq (25) is the exact moment at a fixed load.
    Valid:    ξ < a0/(3√â).
    Accuracy: 3 ulp above its parts.

    >>> fixed_approach_moment(yield_moment=1.0, contact_modulus=1.0, contact_radius_at_load=2.0, yield_displacement=1.0,
    ...                       reduced_radius=1.0)
    3.0
    """
    cubic = contact_modulus * contact_radius_at_load * cube(yield_displacement) / reduced_radius
    return yield_moment + cubic
