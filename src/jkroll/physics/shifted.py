"""Pressures of a shifted contact for pictures, exact and by two half-circles, and half the width of an unloaded strip.

The centre of the circle, X = 0, lags by ξ behind the contact point, x = X − ξ = 0, as in Fig. 2; x points ahead.
"""

from __future__ import annotations

from .contact import boussinesq_pressure_at_approach, hertz_pressure, pressure
from .dimensions import Length, Stress, SurfaceEnergy
from .elementary import cbrt, pi, sqrt


def exact_pressure(
    *,
    position_in_circle: Length,
    contact_radius_at_load: Length,
    contact_modulus: Stress,
    reduced_radius: Length,
    yield_displacement: Length,
    hertz_pressure: Stress,
    boussinesq_pressure: Stress,
) -> Stress:
    """Return the exact pressure of a shifted circle at a fixed load, along its diameter in the direction of rolling.

        p = p_H √(1 − X²/a²) + (p_B + (2E*ξ/πR)(X/a))/√(1 − X²/a²)

    Source:   Hertz, flat punch and tilted flat punch on one circle: in three dimensions what Eq (64) is in two.
    Valid:    |X| < a, ξ < a0/(3√â).
    """
    a, x = contact_radius_at_load, position_in_circle
    depth = sqrt((a - x) / a * ((a + x) / a))
    tilt = 2 / pi * contact_modulus * yield_displacement / reduced_radius * (x / a)
    return hertz_pressure * depth + (boussinesq_pressure + tilt) / depth


def half_circle_pressure(
    *,
    distance: Length,
    half_circle_radius: Length,
    approach_at_load: Length,
    contact_modulus: Stress,
    reduced_radius: Length,
) -> Stress:
    """Return the pressure in one half of a symmetric contact of a given radius and approach: one side of Eq (16).

        p = p_H √(1 − r²/𝒜²) + (E*δ/(π𝒜) − p_H/2)/√(1 − r²/𝒜²), p_H = 2𝒜E*/(πR)

    Source:   Eqs (15) and (16).
    Valid:    0 ≤ r < 𝒜, which is a + ξ behind the contact point and a − ξ ahead of it.
    """
    state = {"contact_radius_at_load": half_circle_radius, "contact_modulus": contact_modulus}
    hertz = hertz_pressure(**state, reduced_radius=reduced_radius)
    punch = boussinesq_pressure_at_approach(**state, approach_at_load=approach_at_load, hertz_pressure=hertz)
    a = half_circle_radius
    return pressure(distance=distance, contact_radius_at_load=a, hertz_pressure=hertz, boussinesq_pressure=punch)


def unloaded_half_width(
    *, work_of_adhesion: SurfaceEnergy, cylinder_radius: Length, plane_strain_modulus: Stress
) -> Length:
    """Return half the width of the strip in which a cylinder sticks to a rigid plane without load.

        a = (32wR²/(πE′))^(1/3)

    Source:   Griffith's criterion K²/(2E′) = w with the edge of Eq (56), C = 0; the paper leaves a free.
    Valid:    a ≪ R.
    """
    return cbrt(32 / pi * work_of_adhesion * cylinder_radius**2 / plane_strain_modulus)
