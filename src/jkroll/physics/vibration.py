"""Vibrations of the contact: Eqs 31-42. Frequencies are in cycles per second."""

from __future__ import annotations

from .dimensions import (
    Density,
    FloatOrArray,
    Frequency,
    Inertia,
    Length,
    Mass,
    Moment,
    Number,
    RollingStiffness,
    Stiffness,
    Stress,
    SurfaceEnergy,
    Time,
)
from .elementary import cube, pi, sqrt


def _frequency(stiffness: FloatOrArray, inertia: FloatOrArray) -> FloatOrArray:
    """Return the frequency of a spring with a mass, or of a torsion spring with a moment of inertia; 0 ≤ stiffness."""
    return sqrt(stiffness / inertia) / (2 * pi)


def vertical_frequency(*, stiffness: Stiffness, reduced_mass: Mass) -> Frequency:
    """Return the frequency at which the distance of the two centres vibrates.

        f_z = (1/2π)√((dP/dδ)/m) = (1/2π)√((6/5)E*a0/m) without load

    stiffness  [N/m]  ≥ 0

    Source:   Eqs (31)-(35), where a frequency is Ω and Eq (34) lost its sign; under a load with the stiffness there.
    Valid:    Free spheres, amplitudes well below δ0.
    """
    return _frequency(stiffness, reduced_mass)


def rolling_frequency(*, rolling_stiffness: RollingStiffness, reduced_moment_of_inertia: Inertia) -> Frequency:
    """Return the frequency at which the two spheres roll back and forth over each other, each about its own centre.

        f_roll = (1/2π)√(4P_c â^(3/2) R/I)

    Source:   Eqs (37)-(40), of which the first three lost their sign in print.
    Valid:    Exact for identical spheres; unequal free spheres also move their centres (`rolling_frequency_no_slip`).
    """
    return _frequency(rolling_stiffness, reduced_moment_of_inertia)


def rolling_frequency_as_printed(*, work_of_adhesion: SurfaceEnergy, radius: Length, density: Density) -> Frequency:
    """Return the rolling frequency of identical spheres as the paper prints it: 2.5 times too low.

        f_roll(41) = (3/2π)√(γ/(5R1³ρ)), γ = w/2

    Source:   Eqs (41) and (42). They are Eq (40) with k² = (5/2)R1² in place of (2/5)R1².
    Valid:    For comparison only.

    >>> f"{rolling_frequency_as_printed(work_of_adhesion=0.2, radius=1e-7, density=2000.0):.3e}"
    '4.775e+07'
    """
    return 3 / (2 * pi) * sqrt(work_of_adhesion / (10 * cube(radius) * density))


def rolling_frequency_no_slip(*, work_of_adhesion: SurfaceEnergy, load_factor: Number, rolling_mass: Mass) -> Frequency:
    """Return the frequency at which two free spheres that do not slip roll back and forth over each other.

        f_free = (1/2π)√(4P_c â^(3/2)/(R m_eff)) = √(3w â^(3/2)/(2π m_eff))

    Source:   Eqs (25) and (37)-(39), with the motion of the centres that no slip demands.
    Valid:    Homogeneous spheres; body 2 may be a plane, which is held. Equal to Eq (40) for identical spheres.
    """
    return sqrt(3 / (2 * pi) * work_of_adhesion * load_factor / rolling_mass)


def sliding_frequency(*, tangential_stiffness: Stiffness, reduced_mass: Mass) -> Frequency:
    """Return the frequency at which two spheres slide to and fro and turn with it: the fastest mode of a pair.

        f_slide = (1/2π)√(7k_s/(2m)), m the reduced mass

    Source:   A force k_s u at the contact moves the centres, 1/m, and turns the spheres, (5/2)/m.
    Valid:    Homogeneous spheres; small amplitudes.
    """
    return _frequency(3.5 * tangential_stiffness, reduced_mass)


def twisting_frequency(*, twisting_stiffness: Moment, reduced_moment_of_inertia: Inertia) -> Frequency:
    """Return the frequency at which two spheres twist to and fro about the line of centres.

        f_twist = (1/2π)√(k_t/I)

    Source:   A moment k_t φ at the contact turns the spheres, 1/I = 1/I1 + 1/I2; on a plane 1/I1.
    Valid:    Homogeneous spheres; small amplitudes.
    """
    return _frequency(twisting_stiffness, reduced_moment_of_inertia)


def time_step(*, sliding_frequency: Frequency) -> Time:
    """Return a time step for simulations of many spheres.

        Δt = 1/(20 f_slide)

    Source:   Verlet's method is stable up to 2/ω; the fastest mode of spheres with n contacts has ω ≤ √n 2πf_slide.
    Valid:    Stable up to 40 contacts a sphere, at the load: a contact that is pushed harder is stiffer.
    """
    return 0.05 / sliding_frequency


def rayleigh_time(*, radius: Length, density: Density, youngs_modulus: Stress, poisson_ratio: Number) -> Time:
    """Return the time of a Rayleigh wave over half the circumference of sphere 1.

        t_R = πR1√(ρ1/G)/(0.8766 + 0.1631ν1), G = E1/(2(1 + ν1))

    poisson_ratio  [1]  -1 < ν ≤ 1/2

    Source:   LIGGGHTS, fix check/timestep/gran. Its linear form is Rayleigh's root within 0.3 % for 0 ≤ ν ≤ 1/2.
    Valid:    A free sphere: neither the contact nor its adhesion enters. Codes take a tenth to a fifth of it for a
              step.
    """
    slowness = sqrt(2 * (1 + poisson_ratio) * (density / youngs_modulus))
    return pi * radius * slowness / (0.8766 + 0.1631 * poisson_ratio)
