"""Motion: vibrations (Eqs 31-42) and time steps, the roll after a collision (Eqs 45-49), and head-on losses.

Frequencies are in Hz, cycles per second; the paper calls them Ω.
"""

from __future__ import annotations

from collections.abc import Sequence

from .dimensions import (
    AngularSpeed,
    Density,
    Energy,
    Force,
    Frequency,
    Inertia,
    Length,
    Mass,
    Moment,
    MomentPerAngle,
    Number,
    Speed,
    Stiffness,
    Stress,
    SurfaceEnergy,
    Time,
)
from .elementary import FloatOrArray, at_least, at_most, cube, ln, pi, quotient, sqrt, within


def vertical_frequency(*, stiffness: Stiffness, reduced_mass: Mass) -> Frequency:
    """Return the frequency at which the distance of the two centres vibrates.

        f_z = (1/2π)√((dP/dδ)/m) = (1/2π)√((6/5)E*a0/m) without load

    Source:   Eqs (31)-(35), with the stiffness at the load; Eq (34) lost its sign in print.
    Valid:    Free spheres, amplitudes well below δ0, dP/dδ ≥ 0.
    """
    return sqrt(stiffness / reduced_mass) / (2 * pi)


def rolling_frequency(*, rolling_stiffness: MomentPerAngle, reduced_moment_of_inertia: Inertia) -> Frequency:
    """Return the frequency at which the two spheres roll back and forth over each other, each about its own centre.

        f_roll = (1/2π)√(4P_c â^(3/2) R/I)

    Source:   Eqs (37)-(40); the first three lost their sign in print.
    Valid:    Exact for identical spheres; unequal free spheres also move their centres (`rolling_frequency_no_slip`).
    """
    return sqrt(rolling_stiffness / reduced_moment_of_inertia) / (2 * pi)


def rolling_frequency_as_printed(*, work_of_adhesion: SurfaceEnergy, radius: Length, density: Density) -> Frequency:
    """Return the rolling frequency of identical spheres as the paper prints it: 2.5 times too low.

        f_roll(41) = (3/2π)√(γ/(5R1³ρ)), γ = w/2

    Source:   Eqs (41) and (42). They are Eq (40) with k² = (5/2)R1² instead of (2/5)R1².
    Valid:    For comparison only.
    """
    return 3 / (2 * pi) * sqrt(work_of_adhesion / (10 * cube(radius) * density))


def rolling_frequency_no_slip(*, work_of_adhesion: SurfaceEnergy, load_factor: Number, rolling_mass: Mass) -> Frequency:
    """Return the frequency at which two free spheres that do not slip roll to and fro over each other.

        f_free = (1/2π)√(4P_c â^(3/2)/(R m_eff)) = √(3w â^(3/2)/(2π m_eff))

    Source:   Eqs (25) and (37)-(39), with the motion of the centres that rolling without slip demands.
    Valid:    Homogeneous spheres; body 2 may be a plane, which is held. Equal to Eq (40) for identical spheres.
    """
    return sqrt(3 / (2 * pi) * work_of_adhesion * load_factor / rolling_mass)


def sliding_frequency(*, tangential_stiffness: Stiffness, reduced_mass: Mass) -> Frequency:
    """Return the frequency at which two spheres slide to and fro, and turn as they slide: the fastest mode of a pair.

        f_slide = (1/2π)√(7k_s/(2m)), m the reduced mass

    Source:   A force k_s u at the contact moves the centres, 1/m, and turns the spheres, (5/2)/m.
    Valid:    Homogeneous spheres; small amplitudes.
    """
    return sqrt(3.5 * tangential_stiffness / reduced_mass) / (2 * pi)


def twisting_frequency(*, twisting_stiffness: MomentPerAngle, reduced_moment_of_inertia: Inertia) -> Frequency:
    """Return the frequency at which two spheres twist to and fro about the line of centres.

        f_twist = (1/2π)√(k_t/I)

    Source:   A moment k_t φ at the contact turns the spheres, 1/I = 1/I1 + 1/I2; on a plane 1/I1.
    Valid:    Homogeneous spheres; small amplitudes.
    """
    return sqrt(twisting_stiffness / reduced_moment_of_inertia) / (2 * pi)


def rayleigh_time(*, radius: Length, density: Density, youngs_modulus: Stress, poisson_ratio: Number) -> Time:
    """Return the time of a Rayleigh wave over half the circumference of sphere 1.

        t_R = πR1√(ρ1/G)/(0.8766 + 0.1631ν1), G = E1/(2(1 + ν1))

    Source:   LIGGGHTS, fix check/timestep/gran. Its linear form is Rayleigh's root within 0.3 % for 0 ≤ ν ≤ 1/2.
    Valid:    A free sphere: neither the contact nor its adhesion enters. Codes take a tenth to a fifth of it for a
              step.
    """
    slowness = sqrt(2 * (1 + poisson_ratio) * (density / youngs_modulus))
    return pi * radius * slowness / (0.8766 + 0.1631 * poisson_ratio)


def rayleigh_frequency(*, radius: Length, density: Density, youngs_modulus: Stress, poisson_ratio: Number) -> Frequency:
    """Return the inverse of the time of a Rayleigh wave over half the circumference of a sphere.

        f_R = 1/t_R, which is 0 for a rigid sphere and for a plane, as neither has such a wave

    Source:   As `rayleigh_time`.
    """
    time = rayleigh_time(radius=radius, density=density, youngs_modulus=youngs_modulus, poisson_ratio=poisson_ratio)
    return quotient(1.0, time, 0.0)


def time_step(*, sliding_frequency: Frequency, rayleigh_frequency: Frequency, rayleigh_frequency2: Frequency) -> Time:
    """Return a time step for simulations of many spheres: the shorter of the steps by two rules.

        Δt = min(1/(20 f_slide), t_R/5), with the shorter t_R of the two spheres

    Source:   Verlet's method is stable up to 2/ω; the fastest mode of spheres with n contacts has ω ≤ √n 2πf_slide.
              A fifth of the Rayleigh time is the rule of codes for grains that collide.
    Valid:    Stable up to 40 contacts a sphere, at the load: a contact that is pushed harder is stiffer.
    """
    waves = at_least(rayleigh_frequency, rayleigh_frequency2)
    return 1 / at_least(20 * sliding_frequency, 5 * waves)


# --- Rolling after a collision ----------------------------------------------------------------------------------------


def energy(*, energy_ratio: Number, adhesion_energy: Energy) -> Energy:
    """Return the energy of sphere 1 from its ratio to P_cδ0, for use if neither an energy nor a speed is given.

        W0 = (W0/P_cδ0) P_cδ0

    Source:   Text below Eq (48).
    """
    return energy_ratio * adhesion_energy


def kinetic_energy(*, mass: Mass, speed: Speed) -> Energy:
    """Return the energy of sphere 1 as it arrives.

        W0 = m1v²/2

    Source:   Caption of Fig. 7.
    Valid:    A sphere that does not spin, moving along the surface of a fixed body 2.
    """
    return mass * speed**2 / 2


def initial_angular_speed(*, energy: Energy, moment_of_inertia: Inertia) -> AngularSpeed:
    """Return the angular speed of sphere 1 once it rolls without slip with all of its energy.

        ω(0) = √((4/7)W0/I1)

    Source:   Eq (46).
    Valid:    A homogeneous sphere; no energy lost to sliding.
    """
    return sqrt(4 / 7 * energy / moment_of_inertia)


def n_roll(*, energy: Energy, mean_rolling_moment: Moment) -> Number:
    """Return the number of full turns that sphere 1 rolls over a fixed body 2 if the contact slides freely.

        n = W0/(7π⟨M⟩) = W0/(14π P_c â^(3/2) ξ)

    Source:   Eq (48), and Eq (49), which is Eq (48) at W0 = P_cδ0.
    Valid:    A sphere that spins in place: Eq (47) leaves out the friction at the contact, which brakes the centre and
              sustains the spin, so that 2/7 of the energy is dissipated and the rest slides away.
    """
    return energy / (7 * pi * mean_rolling_moment)


def n_roll_energy_balance(*, energy: Energy, mean_rolling_moment: Moment) -> Number:
    """Return the number of full turns that sphere 1 rolls over a fixed body 2 without slip from the start.

        n = W0/(2π⟨M⟩), which is 7/2 of Eq (48)

    Source:   Caption of Fig. 7: "until all energy is dissipated".
    Valid:    No slip at any time; W0 is the energy of the translation and of the spin.
    """
    return energy / (2 * pi * mean_rolling_moment)


def n_roll_after_impact(*, energy: Energy, mean_rolling_moment: Moment) -> Number:
    """Return the number of full turns of a sphere that arrives along the surface without spin, then rolls without slip.

        n = (5/7)W0/(2π⟨M⟩), which is 5/2 of Eq (48)

    Source:   The angular momentum about the contact is kept while friction spins the sphere up: 5/7 of W0 remain.
    Valid:    A tangential impact on a fixed body 2, short compared with the rolling; no slip after it.
    """
    return energy / (14 / 5 * pi * mean_rolling_moment)


def flight_ratio(*, energy: Energy, radius: Length, radius2: Length, pull_off_force: Force) -> Number:
    """Return the force that keeps sphere 1 on its circle around a fixed body 2, over the pull-off force.

        m1v²/((R1 + R2)P_c) = 2W0/((R1 + R2)P_c)

    Source:   Newton: the centre moves on a circle of R1 + R2. Above 1 the sphere flies off; on a plane it stays.
    Valid:    A sphere that moves along the surface, W0 = m1v²/2, without load.
    """
    return 2 * energy / ((radius + radius2) * pull_off_force)


# --- Head-on collisions -----------------------------------------------------------------------------------------------


def restitution(*, speed: Speed, sticking_speed: Speed) -> Number:
    """Return the speed after a head-on collision over that before it: 0 for spheres that stick.

        e = √(1 − (v_stick/v)²), which is √(1 − U_stick/W) without viscous damping, W = ½mv²

    Source:   Energy: the spheres lose ½m v_stick² at any speed above v_stick. Thornton & Ning 1998 have this loss.
    Valid:    An upper bound where the law is right, as every other loss lowers e; viscous damping raises v_stick, and
              e remains an upper bound. Speeds well below √(E/ρ).

    >>> restitution(speed=5.0, sticking_speed=3.0)
    0.8
    """
    excess = at_least(speed - sticking_speed, 0.0)
    return sqrt(excess / speed * ((speed + sticking_speed) / speed))


def speed_over_sticking(*, speed: Speed, sticking_speed: Speed) -> Number:
    """Return the relative speed over the largest speed at which spheres stick: above 1, a free pair bounces apart.

        v/v_stick

    Source:   As `restitution`.
    Valid:    As `restitution`.
    """
    return speed / sticking_speed


def lost_energy(*, speed: Speed, sticking_speed: Speed, reduced_mass: Mass) -> Energy:
    """Return the relative energy that a head-on collision dissipates: all of ½mv² if the spheres stick.

        W_lost = ½m min(v, v_stick)²; without viscous damping, U_stick from v_stick on

    Source:   Energy, as `restitution`.
    Valid:    A lower bound where the law is right.
    """
    slower = at_most(speed, sticking_speed)
    return reduced_mass * slower * slower / 2


# --- Viscous damping of codes for dust: a force 2(T_vis/ν²)E*a dδ/dt in addition to JKR's -----------------------------

STICKS_FROM = 0.681745209228707968  # the least T* at which spheres stick at every speed
FITTED_UP_TO = 0.6815  # T* up to which the approximation below was compared with the equation of motion

# The cube root of the ratio of speeds is a quotient of polynomials of −ln(1 − T*/T_c); the coefficient of the highest
# power first.
_NUMERATOR = (
    0.00656377003078744, 0.13926479838105343, 1.2560552655575732, 13.353579642533976, 66.71381187636696,
    284.4669223705491, 551.1471822473276, 424.0239945815925, 140.03302074351527, 19.915339089884874, 1.0,
)  # fmt: skip
_DENOMINATOR = (
    0.012643948318122239, 0.10560236313712765, 1.7809773703126632, 9.812847493179728, 56.20860934812392,
    239.30526460774885, 266.4482631170719, 108.99628658854968, 17.904318541991803, 1.0,
)  # fmt: skip


def viscosity_number(
    *,
    viscous_time: Time,
    poisson_ratio: Number,
    poisson_ratio2: Number,
    contact_modulus: Stress,
    contact_radius: Length,
    reduced_mass: Mass,
) -> Number:
    """Return the viscous time over the time of a collision, which decides whether damped spheres stick.

        T* = (T_vis/(ν1ν2))√(E*a0/m)

    Source:   The force 2(T_vis/ν²)E*a dδ/dt of Lumajord/DustSimulation and Paulemaule/DustCollider.
    Valid:    JKR, ν1ν2 > 0; else a float raises ValueError and an array holds NaN. T_vis is no constant of a solid: it
              is fitted to the sticking of grains of one size.
    """
    product = within(poisson_ratio * poisson_ratio2 > 0, poisson_ratio * poisson_ratio2)
    return viscous_time / product * sqrt(contact_modulus * contact_radius / reduced_mass)


def sticking_speed_viscous(*, sticking_energy: Energy, reduced_mass: Mass, viscosity_number: Number) -> Speed:
    """Return the largest relative speed at which spheres stick if they also lose energy to viscous damping.

        v = r √(2U_stick/m), r = (p(L)/q(L))³, L = −ln(1 − T*/T_c), T_c = 0.6817; r = 1 + 8.849 T* + … for small T*

    Source:   Equation of motion on the JKR curve with F = 2(T_vis/ν²)E*a dδ/dt; r is fitted to its solutions within
              1e-10.
    Valid:    T* ≤ 0.6815; beyond, a float raises ValueError and an array holds NaN. Above T_c spheres stick at every
              speed. The law of damping is quasi-static: it holds for T* well below 1.
    """
    distance = -ln(1 - viscosity_number / STICKS_FROM)
    root = _polynomial(_NUMERATOR, distance) / _polynomial(_DENOMINATOR, distance)
    return within(viscosity_number <= FITTED_UP_TO, cube(root)) * sqrt(2 * sticking_energy) / sqrt(reduced_mass)


def _polynomial(coefficients: Sequence[float], value: FloatOrArray) -> FloatOrArray:
    """Return a polynomial by Horner's scheme, in which nothing cancels as all coefficients are positive."""
    total: FloatOrArray = 0.0
    for coefficient in coefficients:
        total = total * value + coefficient
    return total
