"""Rolling under any law of attraction, from one force: F_a = P_H − P, Hertz' load at the contact radius less the load.

The moment of a contact whose attraction lags behind by ξ is F_aξ to first order in ξ, whatever the law: 4P_c â^(3/2) ξ
in JKR, which is Eq (25), and 2πwRξ in DMT at every load. Below: the parameter of the transition from JKR to DMT, the
strength of attraction, a fit of the pull-off force, and what follows from a Hamaker constant and a cutoff distance.
Behind them stand the numbers that limit the model.
"""

from __future__ import annotations

from .dimensions import Energy, Force, Frequency, Length, Mass, Moment, Number, RollingStiffness, Stress, SurfaceEnergy
from .elementary import cbrt, cube, pi, sqrt, within


def adhesive_force(*, pull_off_force: Force, load_factor: Number) -> Force:
    """Return Hertz' load at the contact radius less the load, in JKR.

        F_a = 4E*a³/(3R) − P = 4P_c â^(3/2)

    Source:   Eq (5).
    Valid:    As Eq (5).
    """
    return 4 * pull_off_force * load_factor


def unloaded_moment_of_radius(
    *, contact_radius: Length, contact_modulus: Stress, reduced_radius: Length, yield_displacement: Length
) -> Moment:
    """Return the moment of a contact without load, from its radius.

        M = 4E*a0³ξ/(3R)

    Source:   As the moment; without load, F_a is Hertz' load.
    Valid:    |P| ≪ P_c.
    """
    return 4 / 3 * contact_modulus * cube(contact_radius) * yield_displacement / reduced_radius


def yield_force_of_moment(*, yield_moment: Moment, radius: Length) -> Force:
    """Return the force at the centre of sphere 1 that starts it rolling, from the moment.

        Q = M/R1

    Source:   Eq (10).
    """
    return yield_moment / radius


def yield_force_ratio_of_forces(*, yield_force: Force, pull_off_force: Force) -> Number:
    """Return the yield force over the pull-off force of the same law.

        Q/P_c

    Source:   As Eq (27).
    """
    return yield_force / pull_off_force


def rolling_frequency_no_slip_of_stiffness(
    *, rolling_stiffness: RollingStiffness, reduced_radius: Length, rolling_mass: Mass
) -> Frequency:
    """Return the frequency at which two free spheres that do not slip roll back and forth over each other, from k.

        f_free = (1/2π)√(k/(R² m_eff))

    Source:   Eqs (37)-(39), with the motion of the centres that no slip demands.
    Valid:    Homogeneous spheres; body 2 may be a plane, which is held.
    """
    return sqrt(rolling_stiffness / (rolling_mass * reduced_radius**2)) / (2 * pi)


def yield_energy_of_moment(*, yield_moment: Moment, yield_displacement: Length, reduced_radius: Length) -> Energy:
    """Return the energy to roll a contact to its yield displacement, from the moment.

        M²/(2k) = Mξ/(2R)

    Source:   As the moment and its stiffness.
    """
    return yield_moment * yield_displacement / (2 * reduced_radius)


# --- Hysteresis of adhesion -------------------------------------------------------------------------------------------


def hysteresis_moment(*, zone_radius: Length, reduced_radius: Length, adhesion_hysteresis: SurfaceEnergy) -> Moment:
    """Return the moment of steady rolling that the hysteresis of adhesion supplies.

        M = 2cRΔw, c = a in JKR

    adhesion_hysteresis  [J/m²]  ≥ 0

    Source:   The zone of attraction sweeps an area 2c per unit of path; exact for any law and any ξ.
    Valid:    Δw = w_open − w_close ≤ w.
    """
    return 2 * zone_radius * reduced_radius * adhesion_hysteresis


def adhesion_hysteresis_of_fraction(*, hysteresis_fraction: Number, work_of_adhesion: SurfaceEnergy) -> SurfaceEnergy:
    """Return the hysteresis of adhesion that is a part of the work of adhesion.

        Δw = (Δw/w) w

    hysteresis_fraction  [1]  > 0, ≤ 1
    """
    return hysteresis_fraction * work_of_adhesion


def yield_displacement_at_hysteresis(
    *,
    adhesion_hysteresis: SurfaceEnergy,
    work_of_adhesion: SurfaceEnergy,
    zone_radius: Length,
    reduced_radius: Length,
    adhesive_force: Force,
) -> Length:
    """Return the displacement at which the rolling moment is what a hysteresis of adhesion supplies.

        ξ = 2cRΔw/F_a, which is aΔw/(3πwx) in JKR

    adhesion_hysteresis  [J/m²]  ≥ 0

    Source:   M = F_aξ and M = 2cRΔw.
    Valid:    Δw ≤ w. Above, a float raises ValueError and an array holds NaN.
    """
    supplied = within(adhesion_hysteresis <= work_of_adhesion, adhesion_hysteresis)
    return 2 * zone_radius * reduced_radius * supplied / adhesive_force


def hysteresis_ratio(
    *, yield_moment: Moment, zone_radius: Length, reduced_radius: Length, work_of_adhesion: SurfaceEnergy
) -> Number:
    """Return the rolling moment over the largest that adhesion hysteresis supplies.

        M/(2cRw)

    Source:   M = 2cRΔw with Δw = w.
    Valid:    Smooth surfaces; steady rolling.
    """
    return yield_moment / (2 * zone_radius * reduced_radius * work_of_adhesion)


# --- From JKR to DMT --------------------------------------------------------------------------------------------------

TRANSITION_OVER_TABOR = 1.1570116348507993  # (32/(9√3))·(9/(16π))^(1/3)


def transition_parameter(*, tabor_parameter: Number) -> Number:
    """Return Maugis' parameter of the transition between JKR (large) and DMT (small).

        λ = 2σ0/(πwK²/R)^(1/3) = (32/(9√3))(9/16π)^(1/3) μ, with K = 4E*/3

    Source:   Maugis 1992, for the peak stress of the 3-9 law.
    """
    return TRANSITION_OVER_TABOR * tabor_parameter


def cohesive_stress(*, work_of_adhesion: SurfaceEnergy, atomic_spacing: Length) -> Stress:
    """Return the largest stress with which two surfaces attract.

        σ0 = 16w/(9√3 z0)

    Source:   The peak of the 3-9 law that the Lennard-Jones potential gives for two half-spaces.
    Valid:    Its range, w/σ0 = 0.974 z0, follows from it.
    """
    return 1.0264004785593346 * work_of_adhesion / atomic_spacing


def pull_off_force_lennard_jones(
    *, work_of_adhesion: SurfaceEnergy, reduced_radius: Length, tabor_parameter: Number
) -> Force:
    """Return the force that separates two spheres that attract by the 3-9 law of the Lennard-Jones potential.

        P_c = πwR(3/2 + ½/(1 + 1.95 μ^1.4))

    Source:   Fit to numerical solutions of the elastic half-space; tests/tools/lennard_jones.py makes them.
    Valid:    Within 0.3 % for 0.01 ≤ μ ≤ 2.
    """
    return pi * work_of_adhesion * reduced_radius * (1.5 + 0.5 / (1 + 1.95 * tabor_parameter**1.4))


def pull_off_force_rough(
    *, pull_off_force_dmt: Force, reduced_radius: Length, asperity_radius: Length, cutoff: Length
) -> Force:
    """Return the force that separates two hard spheres with one hemispherical asperity between them.

        F = P_DMT (s/(s + R) + 1/(1 + s/D0)²)

    Source:   Rumpf 1990, as MFiX (des) cites and codes it for a wall: van der Waals' force on the asperity and on the
              sphere behind it.
    Valid:    Nothing deforms; one asperity, on the line of centres, s well below R. Within 3 % of the pairwise sum on a
              plane. It is P_DMT for s → 0.

    >>> sizes = {"reduced_radius": 1e-6, "asperity_radius": 3.63e-9, "cutoff": 1.65e-10}
    >>> round(pull_off_force_rough(pull_off_force_dmt=1.0, **sizes), 5)
    0.00551
    """
    gap = 1 + asperity_radius / cutoff
    return pull_off_force_dmt * (asperity_radius / (asperity_radius + reduced_radius) + 1 / (gap * gap))


def work_of_adhesion_of_hamaker(*, hamaker: Energy, hamaker2: Energy, cutoff: Length) -> SurfaceEnergy:
    """Return the work of adhesion of two half-spaces that attract by van der Waals' forces and touch at the cutoff.

        w = A/(12πD0²), A = √(A1A2)

    Source:   Hamaker's energy of two half-spaces at the distance D0, pairwise sum; D0 = 0.165 nm is in common use.
    Valid:    Dispersion forces alone: no water, no hydrogen bonds, no metals. It goes with D0⁻²: at 0.4 nm, w is 5.9
              times less.

    >>> f"{work_of_adhesion_of_hamaker(hamaker=6.5e-20, hamaker2=6.5e-20, cutoff=1.65e-10):.4f}"
    '0.0633'
    """
    return sqrt(hamaker * hamaker2) / (12 * pi * cutoff**2)


def atomic_spacing_of_cutoff(*, cutoff: Length) -> Length:
    """Return the atomic spacing of the 3–9 law that has this Hamaker constant and this work of adhesion.

        z0 = (√3/2)D0

    Source:   The 3–9 law has w = A/(16πz0²); with w = A/(12πD0²).
    """
    return sqrt(0.75) * cutoff


# --- Numbers that limit the model -------------------------------------------------------------------------------------


def tabor_parameter(
    *, work_of_adhesion: SurfaceEnergy, reduced_radius: Length, contact_modulus: Stress, atomic_spacing: Length
) -> Number:
    """Return the elastic stretch of the neck over the range of the surface forces: large for JKR, small for DMT.

        μ = (4Rγ²/(E*²z0³))^(1/3) = (Rw²/(E*²z0³))^(1/3)

    Source:   Tabor; text below Eq (1) on Muller, Yushenko and Derjaguin.
    Valid:    JKR is within 5 % of Maugis' law above 0.5 for δ0, 1.1 for P_c, 1.7 for a0, 3.3 for M and 12 for U_stick;
              DMT below 0.14 for P_c, 0.07 for a0, 0.02 for M and 0.002 for δ0.

    >>> mu = tabor_parameter(
    ...     work_of_adhesion=0.05, reduced_radius=50e-9, contact_modulus=27.804e9, atomic_spacing=0.4e-9)
    >>> round(mu, 2)
    0.14
    """
    return cbrt(reduced_radius * work_of_adhesion**2 / contact_modulus**2) / atomic_spacing


def displacement_limit(*, contact_radius: Length, load_factor: Number) -> Length:
    """Return the displacement of the contact circle beyond which its leading edge would interpenetrate.

        a0/(3√â)

    Source:   Stress intensity at the edge of the exact shifted circle, ∝ 1 − 3(ξ/a0)√â cos φ.
    Valid:    Circular contact.
    """
    return contact_radius / cbrt(27 * load_factor)


def displacement_ratio(*, yield_displacement: Length, displacement_limit: Length) -> Number:
    """Return the displacement over its limit: above 1 the rolling moment has no meaning.

        3ξ√â/a0

    Source:   As the limit.
    """
    return yield_displacement / displacement_limit


def contact_radius_in_spacings(*, contact_radius_at_load: Length, atomic_spacing: Length) -> Number:
    """Return the contact radius over the atomic spacing: elasticity needs many atoms in the contact.

        a/z0

    Source:   Text below Eq (27): "as these sizes the theory of elasticity is not longer applicable".
    Valid:    Elasticity holds well above 1.
    """
    return contact_radius_at_load / atomic_spacing


def hertz_pressure_over_modulus(*, hertz_pressure: Stress, contact_modulus: Stress) -> Number:
    """Return the Hertz part of the pressure over the contact modulus, which tells whether the solid would yield.

        p_H/E* = 2a/(πR)

    Source:   A crystal without flaws yields under a shear of about G/30 ("Yield (engineering)", Wikipedia), so that its
              yield stress Y, twice that, is about E/30. The largest shear below a Hertz contact is 0.31 p_H, 0.48a deep
              (ν = 0.3), so that the contact yields at p_H = 1.6Y (Tresca; Johnson, Contact Mechanics, 1985): for like
              solids, about 0.1 E*.
    Valid:    An upper bound: with flaws, solids yield at far less. The pull at the rim is left out.
    """
    return hertz_pressure / contact_modulus


def profile_error(*, contact_radius_at_load: Length, radius: Length, radius2: Length) -> Number:
    """Return how far the model's paraboloids are from the spheres at the edge of the contact, relative to their depth.

        a²(R1⁻³ + R2⁻³)/(4(R1⁻¹ + R2⁻¹)) = a²(R1⁻² − R1⁻¹R2⁻¹ + R2⁻²)/4

    Source:   The next term of the profile of a sphere, r⁴/(8R1³).
    Valid:    To first order. It is 1 % at a = 0.2 R1 for identical spheres and on a plane.
    """
    curvature, curvature2 = 1 / radius, 1 / radius2
    return contact_radius_at_load**2 * (curvature**2 - curvature * curvature2 + curvature2**2) / 4


def displacement_over_contact_radius(*, yield_displacement: Length, contact_radius_at_load: Length) -> Number:
    """Return the displacement over the contact radius: above 1 the circle no longer covers the apex.

        ξ/a

    Source:   Fig. 2: the circle lags behind by ξ.
    """
    return yield_displacement / contact_radius_at_load


def r_min_over_radius(*, r_min: Length, radius: Length) -> Number:
    """Return the smallest radius of curvature of a chain over the radius of its sphere 1.

        R_min/R1

    Source:   Eq (28).
    Valid:    A chain that bends takes R_min well above R1.
    """
    return r_min / radius


def yield_energy(*, work_of_adhesion: SurfaceEnergy, yield_displacement: Length, load_factor: Number) -> Energy:
    """Return the energy to roll a contact to its yield displacement: with less, it springs back.

        M²/(2k) = 2P_c â^(3/2) ξ²/R = 3πw â^(3/2) ξ², which is 6πγξ² without load

    Source:   Eqs (25) and (39).
    Valid:    As Eq (25).
    """
    return 3 * pi * work_of_adhesion * load_factor * yield_displacement**2


def energy_over_yield(*, energy: Energy, yield_energy: Energy) -> Number:
    """Return the energy of sphere 1 over that which makes the contact yield.

        W0/(3πw â^(3/2) ξ²)

    Source:   As the yield energy.
    Valid:    Without slip, it rolls where this is above 1. Of a sphere that arrives without spin 5/7 of W0 is left, so
              that this is to be above 7/5; of one that spins in place, which is the paper's Eq (47), 2/7 and 7/2.
    """
    return energy / yield_energy


def energy_over_sticking(*, energy: Energy, sticking_energy: Energy) -> Number:
    """Return the energy of sphere 1 over the largest that sticks: above 1 a head-on impact ends apart.

        W0/U_stick

    Source:   Text below Eq (48).
    Valid:    Body 2 is fixed, so that W0 is the relative energy ½mv².
    """
    return energy / sticking_energy
