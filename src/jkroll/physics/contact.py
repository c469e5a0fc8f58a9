"""Two spheres, their JKR contact and its pressure (Eqs 1-15), and the numbers that limit the model.

Sphere 2 may be a plane (`radius2` infinite), may be rigid (`youngs_modulus2` infinite), and may be held fixed (`mass2`
infinite).

A load is positive in compression and negative in tension. The state on the stable branch depends on the load only
through s = √(1 + P/P_c) (`load_margin`). This margin is 1 without load and 0 at pull-off. No digits are lost near
pull-off, where P + P_c is exact.
"""

from __future__ import annotations

from .dimensions import (
    Area,
    Density,
    Energy,
    Force,
    Inertia,
    Length,
    Mass,
    Number,
    PerLength,
    Stiffness,
    Stress,
    SurfaceEnergy,
)
from .elementary import at_least, at_most, cbrt, cube, in_series, pi, sqrt

# --- The pair ---------------------------------------------------------------------------------------------------------


def work_of_adhesion(*, surface_energy: SurfaceEnergy, surface_energy2: SurfaceEnergy) -> SurfaceEnergy:
    """Return the work to separate a unit area of the contact: twice the geometric mean of the two surface energies.

        w = 2√(γ1 γ2), which is 2γ for identical solids

    Source:   Text below Eq (1), where 2γ is the energy of adhesion; the text below Eq (2) contradicts this.
    Valid:    Identical solids: exact. Different solids: an estimate, best where dispersion forces dominate; a measured
              work of adhesion is better.
    """
    return 2 * sqrt(surface_energy * surface_energy2)


def diameter(*, radius: Length) -> Length:
    """Return the diameter of a sphere.

        D1 = 2R1

    Valid:    Any radius; the diameter of a plane is infinite.
    """
    return 2 * radius


def radius_ratio(*, radius: Length, radius2: Length) -> Number:
    """Return the radius of sphere 1 over that of sphere 2: 1 for identical spheres, 0 on a plane.

        R1/R2

    Source:   Text below Eq (1).
    """
    return radius / radius2


def reduced_radius(*, radius: Length, radius2: Length) -> Length:
    """Return the radius of the sphere that makes the same contact with a plane.

        R = 1/(1/R1 + 1/R2)

    Source:   Text below Eq (1).
    Valid:    Positive radii, one of which may be infinite.
    """
    return in_series(radius, radius2)


def contact_modulus(
    *, youngs_modulus: Stress, poisson_ratio: Number, youngs_modulus2: Stress, poisson_ratio2: Number
) -> Stress:
    """Return the elastic modulus of the contact.

        1/E* = (1 − ν1²)/E1 + (1 − ν2²)/E2

    Source:   Text below Eq (2).
    Valid:    Isotropic, linear elastic solids; one may be rigid (E infinite).
    """
    compliance = (1 - poisson_ratio) * (1 + poisson_ratio) / youngs_modulus
    compliance2 = (1 - poisson_ratio2) * (1 + poisson_ratio2) / youngs_modulus2
    return 1 / (compliance + compliance2)


def modulus_over_energy(*, contact_modulus: Stress, work_of_adhesion: SurfaceEnergy) -> PerLength:
    """Return the contact modulus over the surface energy.

        E*/γ = 2E*/w

    Source:   Eq (49): without load, n_roll at W0 = P_cδ0 depends on the solids through this ratio alone.
    """
    return 2 * contact_modulus / work_of_adhesion


def contact_modulus_of_ratio(*, modulus_over_energy: PerLength, work_of_adhesion: SurfaceEnergy) -> Stress:
    """Return the contact modulus from its ratio to the surface energy.

        E* = (E*/γ) w/2

    Source:   Eq (49).
    """
    return modulus_over_energy * work_of_adhesion / 2


def shear_modulus(*, youngs_modulus: Stress, poisson_ratio: Number) -> Stress:
    """Return the shear modulus of a solid.

        G1 = E1/(2(1 + ν1))

    Source:   Hooke's law.
    Valid:    Isotropic, linear elastic solids.
    """
    return youngs_modulus / (2 * (1 + poisson_ratio))


def contact_shear_modulus(
    *, youngs_modulus: Stress, poisson_ratio: Number, youngs_modulus2: Stress, poisson_ratio2: Number
) -> Stress:
    """Return the shear modulus of the contact.

        1/G* = (2 − ν1)/G1 + (2 − ν2)/G2, G = E/(2(1 + ν))

    Source:   G* of the codes LAMMPS (pair granular, mindlin) and Lumajord/DustSimulation.
    Valid:    Isotropic, linear elastic solids; one may be rigid (E infinite).
    """
    compliance = 2 * (2 - poisson_ratio) * (1 + poisson_ratio) / youngs_modulus
    compliance2 = 2 * (2 - poisson_ratio2) * (1 + poisson_ratio2) / youngs_modulus2
    return 1 / (compliance + compliance2)


def mass(*, radius: Length, density: Density) -> Mass:
    """Return the mass of a homogeneous sphere.

        m1 = (4/3)πR1³ρ

    Source:   Text above Eq (41).
    Valid:    No coating, no pores.
    """
    return 4 * pi * cube(radius) * density / 3


def reduced_mass(*, mass: Mass, mass2: Mass) -> Mass:
    """Return the mass that vibrates against a wall as the two spheres vibrate against each other.

        m = 1/(1/m1 + 1/m2)

    Source:   Text below Eq (33).
    Valid:    Free spheres, or one held fixed (its mass infinite).
    """
    return in_series(mass, mass2)


def moment_of_inertia(*, mass: Mass, radius: Length) -> Inertia:
    """Return the moment of inertia of a homogeneous sphere about its centre.

        I1 = m1 k1² = (2/5) m1 R1²

    Source:   Text below Eq (38).
    Valid:    Homogeneous spheres.
    """
    return 2 / 5 * mass * radius**2


def reduced_moment_of_inertia(*, moment_of_inertia: Inertia, moment_of_inertia2: Inertia) -> Inertia:
    """Return the moment of inertia that turns against a wall as the two spheres turn against each other.

        I = 1/(1/I1 + 1/I2)

    Source:   Eq (39).
    Valid:    Spheres that turn about their own centres, or one held fixed (its moment infinite).
    """
    return in_series(moment_of_inertia, moment_of_inertia2)


def rolling_mass(*, mass: Mass, mass2: Mass, radius_ratio: Number) -> Mass:
    """Return the mass of the rolling mode of two free spheres that do not slip.

        m_eff = (14/5) / [5/(m1 + m2) + 2(1/m1 + q²/m2)/(1 + q)²], q = R1/R2

    It is I1/R1² + I2/R2² − (I1/R1 − I2/R2)²/(m(R1+R2)² + I1 + I2), m the reduced mass, without the cancellation:
    (4/5)m1 for identical spheres, (7/5)m1(1 + q)² where body 2 is held.

    Source:   Eqs (37)-(40) without their assumption that each sphere turns about its own centre.
    Valid:    Homogeneous spheres, no slip; body 2 may be held (its mass infinite).
    """
    turning = (1 / mass + radius_ratio**2 / mass2) / (1 + radius_ratio) ** 2
    return 14 / 5 / (5 / (mass + mass2) + 2 * turning)


# --- The contact ------------------------------------------------------------------------------------------------------


def pull_off_force(*, work_of_adhesion: SurfaceEnergy, reduced_radius: Length) -> Force:
    """Return the force that separates the two spheres.

        P_c = 3πγR = (3/2)πwR

    Source:   Eq (1).
    Valid:    Large, soft spheres (JKR); small, hard ones tend to 4πγR (DMT).
    """
    return 3 / 2 * pi * work_of_adhesion * reduced_radius


def pull_off_force_dmt(*, work_of_adhesion: SurfaceEnergy, reduced_radius: Length) -> Force:
    """Return the force that separates two small, hard spheres.

        P_DMT = 4πγR = 2πwR

    Source:   Text below Eq (1): "for very hard spheres, this factor should rather be 4".
    Valid:    Small, hard spheres: within 5 % of Maugis' law for a Tabor parameter below 0.14.
    """
    return 2 * pi * work_of_adhesion * reduced_radius


def pull_off_force_ratio(*, pull_off_force: Force, work_of_adhesion: SurfaceEnergy, reduced_radius: Length) -> Number:
    """Return the pull-off force over πwR, to compare laws of attraction: 3/2 in JKR, 2 in DMT.

        P_c/(πwR)

    Source:   Maugis 1992, whose unit of loads is πwR.
    Valid:    Any law of attraction.
    """
    return pull_off_force / (pi * work_of_adhesion * reduced_radius)


def contact_radius(*, work_of_adhesion: SurfaceEnergy, reduced_radius: Length, contact_modulus: Stress) -> Length:
    """Return the radius of the contact circle without load.

        a0 = (9πγR²/E*)^(1/3) = (9πwR²/2E*)^(1/3)

    Source:   Eq (2).
    Valid:    a0 ≪ R, and a0 well above the atomic spacing.

    >>> f"{contact_radius(work_of_adhesion=0.05, reduced_radius=50e-9, contact_modulus=27.804e9) * 1e9:.3f} nm"
    '3.991 nm'
    """
    return cbrt(9 / 2 * pi * work_of_adhesion * reduced_radius**2 / contact_modulus)


def approach(*, work_of_adhesion: SurfaceEnergy, reduced_radius: Length, contact_modulus: Stress) -> Length:
    """Return the displacement of the two centres towards each other without load.

        δ0 = P_c/(E*a0) = a0²/(3R) = (3π²γ²R/E*²)^(1/3) = (3π²w²R/4E*²)^(1/3)

    Source:   Eq (3).
    Valid:    As Eq (2).
    """
    return cbrt(3 / 4 * pi**2 * work_of_adhesion**2 * reduced_radius / contact_modulus**2)


def load_margin(*, load: Force, pull_off_force: Force) -> Number:
    """Return the distance of the contact from pull-off: 1 without load, 0 at pull-off.

        s = √(1 + P/P_c)

    Source:   Eq (5), solved for â^(3/2) = (1 + s)/2.
    Valid:    P ≥ −P_c. Beyond, a float raises ValueError and an array holds NaN.
    """
    return sqrt((load + pull_off_force) / pull_off_force)


def load_factor(*, load_margin: Number) -> Number:
    """Return the factor by which the load scales the rolling moment: 1 without load, 1/2 at pull-off.

        x = â^(3/2) = (1 + s)/2

    Source:   Eq (5).
    Valid:    s > −1; below 0 only fixed grips hold the contact.
    """
    return (1 + load_margin) / 2


def contact_radius_at_load(
    *, work_of_adhesion: SurfaceEnergy, reduced_radius: Length, contact_modulus: Stress, load_factor: Number
) -> Length:
    """Return the radius of the contact circle under a load.

        a = a0 x^(2/3) = (9πwR²x²/2E*)^(1/3)

    Source:   Eq (5).
    Valid:    As Eq (2).
    """
    return cbrt(9 / 2 * pi * work_of_adhesion * (reduced_radius * load_factor) ** 2 / contact_modulus)


def approach_at_load(*, approach: Length, load_factor: Number) -> Length:
    """Return the displacement of the two centres towards each other under a load; negative where the neck is stretched.

        δ = δ0(3â² − 2√â) = δ0 √â(3x − 2), x = â^(3/2)

    Source:   Eq (6).
    Valid:    x > 0. On the stable branch δ is 0 at P = −(8/9)P_c.
    """
    return approach * cbrt(load_factor) * (3 * load_factor - 2)


def contact_area(*, contact_radius_at_load: Length) -> Area:
    """Return the area of the contact circle at the load.

        A_c = πa²

    Source:   Geometry.
    Valid:    Any law of attraction.
    """
    return pi * contact_radius_at_load**2


def load_ratio(*, load: Force, pull_off_force: Force) -> Number:
    """Return the load over the pull-off force.

        P/P_c

    Source:   Eq (4).
    Valid:    Any law of attraction; −1 at pull-off.
    """
    return load / pull_off_force


def contact_radius_ratio(*, contact_radius_at_load: Length, contact_radius: Length) -> Number:
    """Return the radius of the contact circle over that without load.

        a/a0

    Source:   Eq (4).
    Valid:    Any law of attraction; in JKR 0.630 at pull-off and 0.303 where fixed grips let go.
    """
    return contact_radius_at_load / contact_radius


def approach_ratio(*, approach_at_load: Length, approach: Length) -> Number:
    """Return the approach of the centres over that without load.

        δ/δ0

    Source:   Eq (4).
    Valid:    Any law of attraction; in JKR −0.397 at pull-off and −0.825 where fixed grips let go.
    """
    return approach_at_load / approach


def stiffness(*, contact_modulus: Stress, contact_radius_at_load: Length, load_margin: Number) -> Stiffness:
    """Return the normal stiffness of the contact: (6/5)E*a0 without load, 0 at pull-off.

        dP/dδ = 6 E*a s/(2 + 3s)

    Source:   Eqs (5) and (6); Eq (34) without load.
    Valid:    Small vibrations about the load.
    """
    return 6 * contact_modulus * contact_radius_at_load * load_margin / (2 + 3 * load_margin)


def tangential_stiffness(*, contact_shear_modulus: Stress, contact_radius_at_load: Length) -> Stiffness:
    """Return the stiffness of the contact against a tangential displacement, without slip.

        k_s = 8G*a

    Source:   As coded in LAMMPS (pair granular, mindlin: 4G/(2 − ν) for identical solids) and Lumajord/DustSimulation.
    Valid:    Small displacements: the contact circle sticks.
    """
    return 8 * contact_shear_modulus * contact_radius_at_load


# --- Pressures --------------------------------------------------------------------------------------------------------


def hertz_pressure(*, contact_radius_at_load: Length, contact_modulus: Stress, reduced_radius: Length) -> Stress:
    """Return the constant of the Hertz part of the pressure, which flattens the spheres.

        p_H = 2aE*/(πR), which is 6P_câ/(πa0²) = E*(36wx²/(π²RE*))^(1/3) in JKR

    Source:   Eq (8), and the text below Eq (13).
    Valid:    Any law of attraction.
    """
    return 2 / pi * contact_radius_at_load * contact_modulus / reduced_radius


def boussinesq_pressure(*, hertz_pressure: Stress, load_factor: Number) -> Stress:
    """Return the constant of the flat-punch part of the pressure, which pulls at the rim.

        p_B = −2P_c/(πa0²√â) = −p_H/(3x)

    Source:   Eqs (8) and (9).
    Valid:    JKR, in equilibrium.
    """
    return -hertz_pressure / (3 * load_factor)


def pressure(
    *, distance: Length, contact_radius_at_load: Length, hertz_pressure: Stress, boussinesq_pressure: Stress
) -> Stress:
    """Return the pressure at a distance from the centre of the contact; tension is negative and infinite at the rim.

        p(r) = p_H √(1 − r²/a²) + p_B/√(1 − r²/a²)

    Source:   Eq (12); Eq (7) lost both square roots in print.
    Valid:    0 ≤ r < a.
    """
    a = contact_radius_at_load
    depth = sqrt((a - distance) / a * ((a + distance) / a))
    return hertz_pressure * depth + boussinesq_pressure / depth


def boussinesq_pressure_at_approach(
    *, approach_at_load: Length, contact_radius_at_load: Length, contact_modulus: Stress, hertz_pressure: Stress
) -> Stress:
    """Return the flat-punch part of the pressure in a contact of given radius and approach, in equilibrium or not.

        p_B = E*δ/(πa) − p_H/2

    Source:   Eq (14); Eq (12) with this p_B is Eq (15).
    Valid:    Any circular contact.
    """
    return contact_modulus * approach_at_load / (pi * contact_radius_at_load) - hertz_pressure / 2


# --- Numbers that limit the model -------------------------------------------------------------------------------------


def tabor_parameter(
    *, work_of_adhesion: SurfaceEnergy, reduced_radius: Length, contact_modulus: Stress, atomic_spacing: Length
) -> Number:
    """Return the elastic stretch of the neck over the range of the surface forces: large for JKR, small for DMT.

        μ = (4Rγ²/(E*²z0³))^(1/3) = (Rw²/(E*²z0³))^(1/3)

    Source:   Tabor; text below Eq (1) on Muller, Yushenko and Derjaguin.
    Valid:    JKR is within 5 % of Maugis' law above 0.5 for δ0, 1.1 for P_c, 1.7 for a0, 3.3 for M and 12 for U_stick;
              DMT below 0.14 for P_c, 0.07 for a0, 0.02 for M and 0.002 for δ0.
    """
    return cbrt(reduced_radius * work_of_adhesion**2 / contact_modulus**2) / atomic_spacing


def displacement_limit(*, contact_radius: Length, load_factor: Number) -> Length:
    """Return the displacement of the contact circle beyond which the bodies would interpenetrate at its leading edge.

        a0/(3√â)

    Source:   Stress intensity at the edge of the exact shifted circle, ∝ 1 − 3(ξ/a0)√â cos φ, φ from the leading edge.
    Valid:    Circular contact.
    """
    return contact_radius / cbrt(27 * load_factor)


def displacement_ratio(*, yield_displacement: Length, displacement_limit: Length) -> Number:
    """Return the yield displacement over its limit: above 1 the rolling moment has no meaning.

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
    """Return the gap between the model's paraboloids and the spheres at the contact's edge, over the paraboloid depth.

        a²(R1⁻³ + R2⁻³)/(4(R1⁻¹ + R2⁻¹)) = a²(R1⁻² − R1⁻¹R2⁻¹ + R2⁻²)/4

    Source:   The next term of the profile of a sphere, r⁴/(8R1³).
    Valid:    To first order. It is 1 % at a = 0.2 R1 for identical spheres and on a plane.
    """
    curvature, curvature2 = 1 / radius, 1 / radius2
    return contact_radius_at_load**2 * (curvature**2 - curvature * curvature2 + curvature2**2) / 4


def contact_over_sphere(
    *, contact_radius: Length, contact_radius_at_load: Length, radius: Length, radius2: Length
) -> Number:
    """Return the larger of the contact radii, without load and at the load, over the radius of the smaller sphere.

        max(a0, a)/min(R1, R2)

    Source:   The contact circle must fit on the sphere.
    Valid:    Above 1 the model has no meaning: the surface tension of the solid shapes so soft a sphere.
    """
    return at_least(contact_radius, contact_radius_at_load) / at_most(radius, radius2)


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
    Valid:    A chain can bend only if R_min is well above R1.
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
    """Return the energy of sphere 1 over the energy that makes the contact yield.

        W0/(3πw â^(3/2) ξ²)

    Source:   As the yield energy.
    Valid:    Without slip, the sphere rolls above 1. A sphere that arrives without spin keeps 5/7 of W0 and rolls above
              7/5; one that slides freely, as in Eq (47), rolls with 2/7 of W0, above 7/2.
    """
    return energy / yield_energy


def energy_over_sticking(*, energy: Energy, sticking_energy: Energy) -> Number:
    """Return the energy of sphere 1 over the largest at which it sticks: above 1, it bounces off in a head-on impact.

        W0/U_stick

    Source:   Text below Eq (48).
    Valid:    Body 2 is fixed, so that W0 is the relative energy ½mv².
    """
    return energy / sticking_energy
