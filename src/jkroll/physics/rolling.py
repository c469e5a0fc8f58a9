"""Resistance to rolling: Eqs 10, 25-27, 43 and 44, and the models of its moment, Eqs 16-24.

At a fixed load Eq (25) is exact. At a fixed approach the exact moment is larger by E*aξ³/R, and the two half-circles
exceed it by as much again.
"""

from __future__ import annotations

from .dimensions import Angle, Force, Length, Moment, Number, RollingStiffness, Stress, SurfaceEnergy
from .elementary import cube, pi


def yield_moment(*, pull_off_force: Force, load_factor: Number, yield_displacement: Length) -> Moment:
    """Return the moment with which a contact resists when its circle lags behind by ξ; at the yield displacement, the largest.

        M = 4 P_c â^(3/2) ξ = 2 P_c ξ (1 + s)

    pull_off_force      [N]  > 0
    load_factor         [1]  > 0
    yield_displacement  [m]  > 0

    Returns:  [N m]; a float for floats, an array for arrays, which broadcast.
    Source:   Eq (25); exact in three dimensions at a fixed load.
    Valid:    ξ < a0/(3√â); beyond, the leading edge would interpenetrate.
    Accuracy: 2 ulp above P_c and x.

    >>> f"{yield_moment(pull_off_force=1.1781e-8, load_factor=1.0, yield_displacement=2e-10):.4e}"
    '9.4248e-18'
    """
    return 4 * pull_off_force * load_factor * yield_displacement


def rolling_stiffness(
    *, work_of_adhesion: SurfaceEnergy, load_factor: Number, reduced_radius: Length
) -> RollingStiffness:
    """Return the moment per angle between the spheres while they roll back and forth without yielding.

        k = M/δ_α = 4 P_c â^(3/2) R = 6πw â^(3/2) R², with ξ = R δ_α

    work_of_adhesion  [J/m²]  > 0
    load_factor       [1]     > 0
    reduced_radius    [m]     > 0

    Returns:  [N m/rad]; a float for floats, an array for arrays, which broadcast.
    Source:   Eqs (25) and (39).
    Valid:    Angles below the yield angle.
    Accuracy: 3 ulp above w, x and R.

    >>> round(rolling_stiffness(work_of_adhesion=0.3183098861837907, load_factor=1.0, reduced_radius=0.5), 12)
    1.5
    """
    return 6 * pi * work_of_adhesion * load_factor * reduced_radius**2


def yield_force(
    *, work_of_adhesion: SurfaceEnergy, load_factor: Number, yield_displacement: Length, radius_ratio: Number
) -> Force:
    """Return the force at the centre of sphere 1 that starts it rolling.

        Q = M/R1 = 4 P_c â^(3/2) ξ/R1 = 6πw â^(3/2) ξ/(1 + R1/R2), which is 6πγξ for identical spheres without load

    work_of_adhesion    [J/m²]  > 0
    load_factor         [1]     > 0
    yield_displacement  [m]     > 0
    radius_ratio        [1]     ≥ 0; 0 on a plane

    Returns:  [N]; a float for floats, an array for arrays, which broadcast.
    Source:   Eqs (10), (25) and (26); identical spheres need no radius.
    Valid:    As Eq (25).
    Accuracy: 3.5 ulp above w and x.

    >>> f"{yield_force(work_of_adhesion=0.05, load_factor=1.0, yield_displacement=2e-10, radius_ratio=1.0):.4e}"
    '9.4248e-11'
    """
    return 6 * pi * work_of_adhesion * load_factor * yield_displacement / (1 + radius_ratio)


def yield_force_fixed_load(
    *, yield_moment: Moment, radius: Length, load: Force, yield_displacement: Length, radius2: Length
) -> Force:
    """Return the force at the centre of sphere 1 that starts it rolling under a load that keeps its direction.

        Q = M/R1 − Pξ/R2

    yield_moment        [N m]  > 0
    radius              [m]    > 0
    load                [N]    any; tension is negative
    yield_displacement  [m]    > 0
    radius2             [m]    > 0; infinite for a plane

    Returns:  [N]; a float for floats, an array for arrays, which broadcast. Negative where the load alone overturns sphere 1.
    Source:   The moments about the contact; Eq (26) has a load that turns with the line of centres.
    Valid:    As Eq (25), with body 2 held. On a plane it is M/R1.
    Accuracy: 2 ulp of the larger term above M.

    >>> yield_force_fixed_load(yield_moment=6.0, radius=2.0, load=4.0, yield_displacement=1.0, radius2=2.0)
    1.0
    """
    return yield_moment / radius - load * (yield_displacement / radius2)


def yield_force_ratio(*, load_factor: Number, yield_displacement: Length, radius: Length) -> Number:
    """Return the yield force over the pull-off force.

        Q/P_c = 4 â^(3/2) ξ/R1

    load_factor         [1]  > 0
    yield_displacement  [m]  > 0
    radius              [m]  > 0

    Returns:  [1]; a float for floats, an array for arrays, which broadcast.
    Source:   Eq (27).
    Valid:    As Eq (25). Above 1, the contact breaks before it rolls.
    Accuracy: 1.5 ulp above x.

    >>> yield_force_ratio(load_factor=1.0, yield_displacement=2.5, radius=10.0)
    1.0
    """
    return 4 * load_factor * (yield_displacement / radius)


def yield_angle(*, yield_displacement: Length, reduced_radius: Length) -> Angle:
    """Return the angle through which the spheres roll over each other before they yield.

        δ_α = ξ/R, which is 2ξ/R1 for identical spheres

    yield_displacement  [m]  > 0
    reduced_radius      [m]  > 0

    Returns:  [rad]; a float for floats, an array for arrays, which broadcast.
    Source:   Text above Eqs (26), (28) and (43).
    Valid:    ξ ≪ R.
    Accuracy: 0.5 ulp above R.

    >>> yield_angle(yield_displacement=2e-10, reduced_radius=50e-9)
    0.004
    """
    return yield_displacement / reduced_radius


def mean_rolling_moment(*, yield_moment: Moment) -> Moment:
    """Return the moment that brakes a rolling sphere, averaged over its steps of ξ.

        ⟨M⟩ = M/2 = 2 P_c â^(3/2) ξ

    yield_moment  [N m]  > 0

    Returns:  [N m]; a float for floats, an array for arrays, which broadcast.
    Source:   Eq (43).
    Valid:    If the contact springs back to a symmetric one after each step; one that trails at yield gives twice this.
    Accuracy: Exact.

    >>> mean_rolling_moment(yield_moment=2.0)
    1.0
    """
    return yield_moment / 2


def mean_rolling_force(*, mean_rolling_moment: Moment, radius: Length) -> Force:
    """Return the force at the centre of sphere 1 that brakes it, averaged over its steps of ξ.

        ⟨Q⟩ = ⟨M⟩/R1 = 2 P_c â^(3/2) ξ/R1

    mean_rolling_moment  [N m]  > 0
    radius               [m]    > 0

    Returns:  [N]; a float for floats, an array for arrays, which broadcast.
    Source:   Eq (44), whose R must be R1 to agree with Eq (26).
    Valid:    As Eq (43).
    Accuracy: 0.5 ulp above M.

    >>> mean_rolling_force(mean_rolling_moment=1.0, radius=2.0)
    0.5
    """
    return mean_rolling_moment / radius


# --- The models of the moment --------------------------------------------------------------------------------------------


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
