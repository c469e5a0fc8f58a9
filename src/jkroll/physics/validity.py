"""Numbers that limit the model."""

from __future__ import annotations

from .dimensions import Energy, Length, Number, Stress, SurfaceEnergy
from .elementary import cbrt, pi


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
