"""Resistance to rolling: Eqs 10, 25-27, 43 and 44."""

from .dimensions import Angle, Force, Length, Moment, Number, RollingStiffness, SurfaceEnergy
from .elementary import Constant, product

_SIX_PI = Constant(6, 1, 1)


def yield_moment(*, pull_off_force: Force, load_factor: Number, yield_displacement: Length) -> Moment:
    """Moment with which a contact resists when its circle lags behind by ξ; at the yield displacement, the largest.

        M = 4 P_c â^(3/2) ξ = 2 P_c ξ (1 + s)

    Source:   Eq (25); exact in three dimensions at a fixed load.
    Valid:    ξ < a0/(3√â); beyond, the leading edge would interpenetrate.
    Accuracy: 1.5 ulp above P_c and x.

    >>> f"{yield_moment(pull_off_force=1.1781e-8, load_factor=1.0, yield_displacement=2e-10):.4e}"
    '9.4248e-18'
    """
    return 4 * pull_off_force * load_factor * yield_displacement


def rolling_stiffness(
    *, work_of_adhesion: SurfaceEnergy, load_factor: Number, reduced_radius: Length
) -> RollingStiffness:
    """Moment per angle between the spheres while they roll back and forth without yielding.

        k = M/δ_α = 4 P_c â^(3/2) R = 6πw â^(3/2) R², with ξ = R δ_α

    Source:   Eqs (25) and (39).
    Valid:    Angles below the yield angle.
    Accuracy: 1 ulp above w, x and R.

    >>> round(rolling_stiffness(work_of_adhesion=0.3183098861837907, load_factor=1.0, reduced_radius=0.5), 12)
    1.5
    """
    return product(_SIX_PI, work_of_adhesion, load_factor, reduced_radius, reduced_radius)


def yield_force(
    *, work_of_adhesion: SurfaceEnergy, load_factor: Number, yield_displacement: Length, radius_ratio: Number
) -> Force:
    """Force at the centre of sphere 1 that starts it rolling.

        Q = M/R1 = 4 P_c â^(3/2) ξ/R1 = 6πw â^(3/2) ξ/(1 + R1/R2), which is 6πγξ for identical spheres without load

    Source:   Eqs (10), (25) and (26); identical spheres need no radius.
    Valid:    As Eq (25).
    Accuracy: 2.5 ulp above w and x.

    >>> f"{yield_force(work_of_adhesion=0.05, load_factor=1.0, yield_displacement=2e-10, radius_ratio=1.0):.4e}"
    '9.4248e-11'
    """
    return product(_SIX_PI, work_of_adhesion, load_factor, yield_displacement) / (1 + radius_ratio)


def yield_force_ratio(*, load_factor: Number, yield_displacement: Length, radius: Length) -> Number:
    """Yield force over the pull-off force.

        Q/P_c = 4 â^(3/2) ξ/R1

    Source:   Eq (27).
    Valid:    As Eq (25). Above 1, the contact breaks before it rolls.
    Accuracy: 1.5 ulp above x.

    >>> yield_force_ratio(load_factor=1.0, yield_displacement=2.5, radius=10.0)
    1.0
    """
    return 4 * load_factor * (yield_displacement / radius)


def yield_angle(*, yield_displacement: Length, reduced_radius: Length) -> Angle:
    """Angle through which the spheres roll over each other before they yield.

        δ_α = ξ/R, which is 2ξ/R1 for identical spheres

    Source:   Text above Eqs (26), (28) and (43).
    Valid:    ξ ≪ R.
    Accuracy: 0.5 ulp above R.

    >>> yield_angle(yield_displacement=2e-10, reduced_radius=50e-9)
    0.004
    """
    return yield_displacement / reduced_radius


def mean_rolling_moment(*, yield_moment: Moment) -> Moment:
    """Moment that brakes a rolling sphere, averaged over its steps of ξ.

        ⟨M⟩ = M/2 = 2 P_c â^(3/2) ξ

    Source:   Eq (43).
    Valid:    If the contact springs back to a symmetric one after each step; one that trails at yield gives twice this.
    Accuracy: Exact.

    >>> mean_rolling_moment(yield_moment=2.0)
    1.0
    """
    return yield_moment / 2


def mean_rolling_force(*, mean_rolling_moment: Moment, radius: Length) -> Force:
    """Force at the centre of sphere 1 that brakes it, averaged over its steps of ξ.

        ⟨Q⟩ = ⟨M⟩/R1 = 2 P_c â^(3/2) ξ/R1

    Source:   Eq (44), whose R must be R1 to agree with Eq (26).
    Valid:    As Eq (43).
    Accuracy: 0.5 ulp above M.

    >>> mean_rolling_force(mean_rolling_moment=1.0, radius=2.0)
    0.5
    """
    return mean_rolling_moment / radius
