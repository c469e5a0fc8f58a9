"""Two spheres: what of their radii, materials and masses the contact sees.

Sphere 2 may be a plane (`radius2` infinite), may be rigid (`youngs_modulus2` infinite), and may be held fixed (`mass2`
infinite).
"""

from __future__ import annotations

from .dimensions import Density, Inertia, Length, Mass, Number, PerLength, Stress, SurfaceEnergy
from .elementary import cube, in_series, pi, sqrt


def work_of_adhesion(*, surface_energy: SurfaceEnergy, surface_energy2: SurfaceEnergy) -> SurfaceEnergy:
    """Return the work to separate unit area of the contact: twice the geometric mean of the two surface energies.

        w = 2√(γ1 γ2), which is 2γ for identical solids

    Source:   Text below Eq (1), where 2γ is the energy of adhesion; the text below Eq (2) does not fit it.
    Valid:    Identical solids: exact. Different solids: an estimate, best where dispersion forces dominate; a measured
              work of adhesion is better.
    """
    return 2 * sqrt(surface_energy * surface_energy2)


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
    """Return the contact modulus over the surface energy, the one material constant in the turns at W0 = P_cδ0.

        E*/γ = 2E*/w

    Source:   Eq (49).
    """
    return 2 * contact_modulus / work_of_adhesion


def contact_modulus_of_ratio(*, modulus_over_energy: PerLength, work_of_adhesion: SurfaceEnergy) -> Stress:
    """Return the contact modulus from its ratio to the surface energy.

        E* = (E*/γ) w/2

    Source:   Eq (49).
    """
    return modulus_over_energy * work_of_adhesion / 2


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

    It is I1/R1² + I2/R2² − (I1/R1 − I2/R2)²/(m(R1+R2)² + I1 + I2) for homogeneous spheres, without the cancellation:
    (4/5)m1 for identical spheres, (7/5)m1(1 + q)² where body 2 is held.

    Source:   Eqs (37)-(40) without their assumption that each sphere turns about its own centre.
    Valid:    Homogeneous spheres, no slip; body 2 may be held (its mass infinite).
    """
    turning = (1 / mass + radius_ratio**2 / mass2) / (1 + radius_ratio) ** 2
    return 14 / 5 / (5 / (mass + mass2) + 2 * turning)
