"""Rolling under any law of attraction, from one force: F_a = P_H − P, Hertz' load at the contact radius minus the load.

The moment of a contact whose attraction lags behind by ξ is F_aξ to first order in ξ, whatever the law: 4P_c â^(3/2) ξ
in JKR, which is Eq (25), and 2πwRξ in DMT at every load. This module also has the moment by hysteresis of
adhesion, the parameter of the transition from JKR to DMT, the cohesive stress, a force and energies for Lennard-Jones'
3-9 law, the pull-off force of rough spheres, and the work of adhesion and atomic spacing that follow from a Hamaker
constant and a cutoff distance.
"""

from __future__ import annotations

from .dimensions import Energy, Force, Frequency, Length, Mass, Moment, MomentPerAngle, Number, Stress, SurfaceEnergy
from .elementary import cbrt, cube, pi, sqrt, within

_WELL_OF_RIGID = 16 / 7 * cbrt(2.0)  # energy to part rigid spheres that attract by the 3-9 law, in πwRz0
_WORK_OF_RIGID = 0.3083909711882815195  # the part of this energy up to the largest pull, (16/7)∛2 - 18/7


def adhesive_force(*, pull_off_force: Force, load_factor: Number) -> Force:
    """Return Hertz' load at the contact radius minus the load, in JKR.

        F_a = 4E*a³/(3R) − P = 4P_c â^(3/2)

    Source:   Eq (5).
    Valid:    JKR, both branches.
    """
    return 4 * pull_off_force * load_factor


def unloaded_moment_of_radius(
    *, contact_radius: Length, contact_modulus: Stress, reduced_radius: Length, yield_displacement: Length
) -> Moment:
    """Return the moment of a contact without load, from its radius.

        M = 4E*a0³ξ/(3R)

    Source:   M = F_aξ; without load, F_a is Hertz' load.
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

    Source:   Eq (27), for any law.
    """
    return yield_force / pull_off_force


def rolling_frequency_no_slip_of_stiffness(
    *, rolling_stiffness: MomentPerAngle, reduced_radius: Length, rolling_mass: Mass
) -> Frequency:
    """Return the frequency at which two free spheres that do not slip roll to and fro, from the stiffness k.

        f_free = (1/2π)√(k/(R² m_eff))

    Source:   Eqs (37)-(39), with the motion of the centres that rolling without slip demands.
    Valid:    Homogeneous spheres; body 2 may be a plane, which is held.
    """
    return sqrt(rolling_stiffness / (rolling_mass * reduced_radius**2)) / (2 * pi)


def yield_energy_of_moment(*, yield_moment: Moment, yield_displacement: Length, reduced_radius: Length) -> Energy:
    """Return the energy to roll a contact to its yield displacement, from the moment.

        M²/(2k) = Mξ/(2R)

    Source:   M = F_aξ and k = F_aR.
    """
    return yield_moment * yield_displacement / (2 * reduced_radius)


# --- Hysteresis of adhesion -------------------------------------------------------------------------------------------


def hysteresis_moment(*, zone_radius: Length, reduced_radius: Length, adhesion_hysteresis: SurfaceEnergy) -> Moment:
    """Return the moment of steady rolling that the hysteresis of adhesion supplies.

        M = 2cRΔw, c = a in JKR

    adhesion_hysteresis  [J/m²]  ≥ 0

    Source:   The zone of attraction sweeps an area 2c per unit of path, whatever the law and ξ.
    Valid:    Δw = w_open − w_close ≤ w.
    """
    return 2 * zone_radius * reduced_radius * adhesion_hysteresis


def adhesion_hysteresis_of_fraction(*, hysteresis_fraction: Number, work_of_adhesion: SurfaceEnergy) -> SurfaceEnergy:
    """Return the hysteresis of adhesion from its fraction of the work of adhesion.

        Δw = (Δw/w) w

    hysteresis_fraction  [1]  > 0, ≤ 1

    Source:   Definition of the fraction.
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
    """Return the displacement at which the rolling moment is the one that the hysteresis of adhesion supplies.

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
    """Return the rolling moment over the largest moment that adhesion hysteresis can supply.

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
    Valid:    As the constant stress of Maugis' law, which then acts over gaps up to w/σ0 = 0.974 z0.
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


def well_energy_lennard_jones(
    *, work_of_adhesion: SurfaceEnergy, reduced_radius: Length, atomic_spacing: Length, tabor_parameter: Number
) -> Energy:
    """Return the depth of the energy well of two spheres that attract by the 3-9 law of the Lennard-Jones potential.

        U = πwRz0 (2.8798 + 3.508 μ/(1 + 0.3652 μ^-0.5175))

    Source:   Fit to numerical solutions of the elastic half-space; tests/tools/lennard_jones.py makes them. Rigid
              spheres have the first term, (16/7)∛2, exactly.
    Valid:    Within 0.2 % for μ ≤ 1. Below μ = 0.698 the contact opens without a jump, and this is the work to part the
              spheres between fixed grips, too.
    """
    by_elasticity = 3.508 * tabor_parameter / (1 + 0.3652 * tabor_parameter**-0.5175)
    return pi * work_of_adhesion * reduced_radius * atomic_spacing * (_WELL_OF_RIGID + by_elasticity)


def dead_load_work_lennard_jones(
    *, work_of_adhesion: SurfaceEnergy, reduced_radius: Length, atomic_spacing: Length, tabor_parameter: Number
) -> Energy:
    """Return the work to pull two spheres that attract by the 3-9 law from rest to where a dead load tears them apart.

        U_load = πwRz0 (0.30839 + 12.894 μ^1.613/(1 + 3.608 μ^0.924))

    Source:   As `well_energy_lennard_jones`. Rigid spheres have the first term, (16/7)∛2 - 18/7, exactly.
    Valid:    Within 0.5 % for μ ≤ 1.
    """
    by_elasticity = 12.894 * tabor_parameter**1.613 / (1 + 3.608 * tabor_parameter**0.924)
    return pi * work_of_adhesion * reduced_radius * atomic_spacing * (_WORK_OF_RIGID + by_elasticity)


def pull_off_force_rough(
    *, pull_off_force_dmt: Force, reduced_radius: Length, asperity_radius: Length, cutoff: Length
) -> Force:
    """Return the force that separates two hard spheres with one hemispherical asperity between them.

        F = P_DMT (s/(s + R) + 1/(1 + s/D0)²)

    Source:   Rumpf 1990, as MFiX (des) cites and codes it for a wall: van der Waals' force on the asperity and on the
              sphere behind it.
    Valid:    Nothing deforms; one asperity, on the line of centres, s well below R. On a plane, it exceeds the pairwise
              sum by up to 3.2 % for R = 1 µm and 8 % for 100 nm (D0 = 0.165 nm). It is P_DMT for s → 0.
    """
    gap = 1 + asperity_radius / cutoff
    return pull_off_force_dmt * (asperity_radius / (asperity_radius + reduced_radius) + 1 / (gap * gap))


def work_of_adhesion_of_hamaker(*, hamaker: Energy, hamaker2: Energy, cutoff: Length) -> SurfaceEnergy:
    """Return the work of adhesion of two half-spaces that attract by van der Waals' forces and touch at the cutoff.

        w = A/(12πD0²), A = √(A1A2)

    Source:   Hamaker's energy of two half-spaces at the distance D0, pairwise sum; D0 = 0.165 nm is in common use.
    Valid:    Dispersion forces alone: no water, no hydrogen bonds, no metals. As w ∝ D0⁻², it is 5.9 times less at
              0.4 nm than at 0.165 nm.
    """
    return sqrt(hamaker * hamaker2) / (12 * pi * cutoff**2)


def atomic_spacing_of_cutoff(*, cutoff: Length) -> Length:
    """Return the atomic spacing with which the 3-9 law has the same work of adhesion as with the cutoff.

        z0 = (√3/2)D0

    Source:   w = A/(16πz0²) by the 3-9 law, w = A/(12πD0²) with the cutoff.
    """
    return sqrt(0.75) * cutoff
