"""Resistance to rolling: Eqs 10, 25-27, 43 and 44."""

from __future__ import annotations

from .dimensions import Angle, Force, Length, Moment, Number, RollingStiffness, SurfaceEnergy
from .elementary import pi


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
