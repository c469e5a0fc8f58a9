"""Resistance to rolling, and chains of spheres: Eqs 10, 16-30, 43 and 44.

At a fixed load Eq (25) is exact. At a fixed approach the exact moment is larger by E*aξ³/R, and the two half-circles
exceed it by as much again.
"""

from __future__ import annotations

from .dimensions import (
    Acceleration,
    Angle,
    Force,
    Length,
    Mass,
    Moment,
    MomentPerAngle,
    Number,
    Stiffness,
    Stress,
    SurfaceEnergy,
)
from .elementary import cube, pi, sqrt, within


def yield_moment(*, adhesive_force: Force, yield_displacement: Length) -> Moment:
    """Return the moment of a contact whose attraction lags behind by ξ; it is largest at the yield displacement.

        M = F_aξ, which is 4 P_c â^(3/2) ξ = 2 P_c ξ (1 + s) in JKR

    Source:   Eq (25), exact in JKR at a fixed load, in three dimensions; first order in ξ for any law of attraction.
    Valid:    ξ < a0/(3√â) in JKR, beyond which the leading edge would interpenetrate; ξ ≪ a in other laws.
    """
    return adhesive_force * yield_displacement


def rolling_stiffness(*, adhesive_force: Force, reduced_radius: Length) -> MomentPerAngle:
    """Return the moment per angle between the spheres while they roll back and forth without yielding.

        k = M/δ_α = F_aR, which is 4 P_c â^(3/2) R = 6πw â^(3/2) R² in JKR, with ξ = R δ_α

    Source:   Eqs (25) and (39), exact in JKR at a fixed load; first order in ξ for any law of attraction.
    Valid:    Angles below the yield angle.
    """
    return adhesive_force * reduced_radius


def rolling_spring_constant(*, rolling_stiffness: MomentPerAngle, reduced_radius: Length) -> Stiffness:
    """Return the constant of the spring with which LAMMPS resists rolling: force per rolling displacement.

        k_roll = k/R²

    Source:   LAMMPS, pair_style granular, rolling sds.
    Valid:    Angles below the yield angle, at this load.
    """
    return rolling_stiffness / reduced_radius**2


def rolling_friction_coefficient(
    *, yield_moment: Moment, reduced_radius: Length, load: Force, pull_off_force: Force
) -> Number:
    """Return the coefficient of friction with which LAMMPS lets a contact roll at its yield moment.

        μ_roll = M/(R(P + 2P_c))

    Source:   LAMMPS, pair_style granular, rolling sds: the spring's force is at most μ_roll(P + 2P_c).
    Valid:    At this load.
    """
    return yield_moment / (reduced_radius * (load + 2 * pull_off_force))


def rolling_resistance_coefficient(*, yield_moment: Moment, reduced_radius: Length, load: Force) -> Number:
    """Return the coefficient for codes that multiply it by load and R, so that a contact rolls at its yield moment.

        μ_r = M/(RP)

    Source:   LIGGGHTS, rolling_friction cdt, and Lethe: the moment against rolling is μ_r R times the normal force.
    Valid:    This load, P > 0; else a float raises ValueError and an array holds NaN. In JKR it is 2ξ/(R(s − 1)): it
              falls as 1/P from small loads on, and as 1/√P at large ones.
    """
    return within(load > 0, yield_moment / reduced_radius / load)


def yield_force(
    *, work_of_adhesion: SurfaceEnergy, load_factor: Number, yield_displacement: Length, radius_ratio: Number
) -> Force:
    """Return the force at the centre of sphere 1 that starts it rolling.

        Q = M/R1 = 4 P_c â^(3/2) ξ/R1 = 6πw â^(3/2) ξ/(1 + R1/R2), which is 6πγξ for identical spheres without load

    Source:   Eqs (10), (25) and (26); identical spheres need no radius.
    Valid:    As Eq (25).
    """
    return 6 * pi * work_of_adhesion * load_factor * yield_displacement / (1 + radius_ratio)


def yield_force_fixed_load(
    *, yield_moment: Moment, radius: Length, load: Force, yield_displacement: Length, radius2: Length
) -> Force:
    """Return the force at the centre of sphere 1 that starts it rolling under a load that keeps its direction.

        Q = M/R1 − Pξ/R2

    Source:   The moments about the contact; Eq (26) has a load that turns with the line of centres.
    Valid:    As Eq (25), with body 2 held. Q is M/R1 on a plane, and negative where the load alone overturns sphere 1.
    """
    return yield_moment / radius - load * yield_displacement / radius2


def yield_force_ratio(*, load_factor: Number, yield_displacement: Length, radius: Length) -> Number:
    """Return the yield force over the pull-off force.

        Q/P_c = 4 â^(3/2) ξ/R1

    Source:   Eq (27).
    Valid:    As Eq (25).
    """
    return 4 * load_factor * yield_displacement / radius


def yield_angle(*, yield_displacement: Length, reduced_radius: Length) -> Angle:
    """Return the angle through which the spheres roll over each other before they yield.

        δ_α = ξ/R, which is 2ξ/R1 for identical spheres

    Source:   Text above Eqs (26), (28) and (43).
    Valid:    ξ ≪ R.
    """
    return yield_displacement / reduced_radius


def contact_displacement(*, load_factor: Number, yield_displacement: Length) -> Length:
    """Return the displacement of the contact circle when its attraction lags by ξ: in JKR, both have the same edge.

        ξ_contact = ξ

    Source:   Eq (25), of a circle that is displaced by ξ.
    Valid:    In contact, x > 0; as Eq (25).
    """
    return within(load_factor > 0, yield_displacement)


def mean_rolling_moment(*, yield_moment: Moment) -> Moment:
    """Return the moment that brakes a rolling sphere, averaged over its steps of ξ.

        ⟨M⟩ = M/2 = 2 P_c â^(3/2) ξ

    Source:   Eq (43).
    Valid:    If the contact springs back to a symmetric one after each step; one that rolls with the full lag gives
              twice this.
    """
    return yield_moment / 2


def mean_rolling_force(*, mean_rolling_moment: Moment, radius: Length) -> Force:
    """Return the force at the centre of sphere 1 that brakes it, averaged over its steps of ξ.

        ⟨Q⟩ = ⟨M⟩/R1 = 2 P_c â^(3/2) ξ/R1

    Source:   Eq (44), whose R must be R1 to agree with Eq (26).
    Valid:    As Eq (43).
    """
    return mean_rolling_moment / radius


# --- Models of the moment ---------------------------------------------------------------------------------------------


def unloaded_moment(*, pull_off_force: Force, yield_displacement: Length) -> Moment:
    """Return the moment of a contact without load, which the paper uses from Eq (26) on.

        M = 4 P_c ξ

    Source:   Eq (25) with â = 1.
    Valid:    |P| ≪ P_c.
    """
    return 4 * pull_off_force * yield_displacement


def half_circles_moment(
    *,
    yield_moment: Moment,
    contact_modulus: Stress,
    contact_radius_at_load: Length,
    yield_displacement: Length,
    reduced_radius: Length,
) -> Moment:
    """Return the moment of two half-circles of radius a + ξ and a − ξ at the same approach, not linearised.

        M_half = M½(a − ξ) − M½(a + ξ) = 2ξE*a((a² + ξ²)/R − δ) = M + 2E*aξ³/R, M½ of a half-circle of that radius

    Source:   Eqs (19) and (23); with Eqs (6) and (25), the last form, which does not cancel.
    Valid:    ξ < a. It exceeds the exact moment at a fixed approach by E*aξ³/R.
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

    Source:   Hertz, flat punch and tilted flat punch on one circle; Eq (25) is the exact moment at a fixed load.
    Valid:    ξ < a0/(3√â).
    """
    cubic = contact_modulus * contact_radius_at_load * cube(yield_displacement) / reduced_radius
    return yield_moment + cubic


# --- Chains of spheres ------------------------------------------------------------------------------------------------


def r_min(*, radius: Length, radius2: Length, yield_displacement: Length) -> Length:
    """Return the smallest radius of curvature to which a straight chain bends without rolling.

        R_min = R1R2/ξ, which is R1²/ξ for identical spheres

    Source:   Eq (28); spheres 1 and 2 alternate.
    Valid:    A long chain, every contact bent to its yield angle.
    """
    return radius * (radius2 / yield_displacement)


def gravity_moment(*, monomers: Number, mass: Mass, gravity: Acceleration, radius: Length) -> Moment:
    """Return the moment of gravity about the first contact of a level chain of N spheres, each like sphere 1.

        M_grav = m1 g R1 N²

    Source:   Eq (29).
    Valid:    A straight chain, all of one mass. It rolls where M_grav exceeds M, beyond N_grav of Eq (30).
    """
    return mass * gravity * radius * monomers**2


def n_grav(*, yield_moment: Moment, mass: Mass, gravity: Acceleration, radius: Length) -> Number:
    """Return the number of spheres, each like sphere 1, above which a level chain rolls at its first contact.

        N = √(M/(m1 g R1)); √(9γRξ/(R1⁴ρg)) in JKR without load, √(9γξ/(2R1³ρg)) for identical spheres

    Source:   Eqs (29) and (30).
    Valid:    A straight chain, all of one mass. Below 1, even one sphere rolls down; it falls off where Bo is below 1.
    """
    return sqrt(yield_moment / (mass * gravity * radius))


def bond_number(*, pull_off_force: Force, mass: Mass, gravity: Acceleration) -> Number:
    """Return the Bond number: the acceleration at which sphere 1 is torn off, over gravity.

        Bo = P_c/(m1 g)

    Source:   Definition of the number.
    Valid:    A sphere that hangs from body 2.
    """
    return pull_off_force / (mass * gravity)
