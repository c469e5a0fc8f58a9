"""How far a sphere rolls over a fixed one after a collision: Eqs 45-49."""

from __future__ import annotations

from .dimensions import (
    AngularAcceleration,
    AngularSpeed,
    Energy,
    Inertia,
    Length,
    Mass,
    Moment,
    Number,
    Speed,
    Stress,
    SurfaceEnergy,
)
from .elementary import cbrt, pi, sqrt


def energy_at_energy_ratio(*, energy_ratio: Number, adhesion_energy: Energy) -> Energy:
    """Return the energy of sphere 1 that is given in units of P_cδ0.

        W0 = (W0/P_cδ0) P_cδ0

    energy_ratio     [1]  > 0
    adhesion_energy  [J]  > 0

    Returns:  [J]; a float for floats, an array for arrays, which broadcast.
    Source:   Text below Eq (48).
    Valid:    Always.
    Accuracy: 0.5 ulp above P_cδ0.

    >>> energy_at_energy_ratio(energy_ratio=2.0, adhesion_energy=3.0)
    6.0
    """
    return energy_ratio * adhesion_energy


def kinetic_energy(*, mass: Mass, speed: Speed) -> Energy:
    """Return the energy of sphere 1 as it arrives.

        W0 = m1v²/2

    mass   [kg]   > 0
    speed  [m/s]  any

    Returns:  [J]; a float for floats, an array for arrays, which broadcast.
    Source:   Caption of Fig. 7.
    Valid:    A sphere that does not spin, moving along the surface of the fixed one.
    Accuracy: 1.5 ulp above its mass.

    >>> kinetic_energy(mass=4.0, speed=3.0)
    18.0
    """
    return mass * speed**2 / 2


def rolling_energy(*, mass: Mass, speed: Speed, moment_of_inertia: Inertia, angular_speed: AngularSpeed) -> Energy:
    """Return the energy of a sphere that moves and spins.

        W0 = ½m1v1² + ½I1ω1²

    mass               [kg]     > 0
    speed              [m/s]    any
    moment_of_inertia  [kg m²]  > 0
    angular_speed      [rad/s]  any

    Returns:  [J]; a float for floats, an array for arrays, which broadcast.
    Source:   Eq (45).
    Valid:    Always.
    Accuracy: 2 ulp.

    >>> rolling_energy(mass=2.0, speed=1.0, moment_of_inertia=2.0, angular_speed=2.0)
    5.0
    """
    return (mass * speed**2 + moment_of_inertia * angular_speed**2) / 2


def initial_angular_speed(*, energy: Energy, moment_of_inertia: Inertia) -> AngularSpeed:
    """Return the angular speed of sphere 1 once it rolls without slip with all of its energy.

        ω(0) = √((4/7)W0/I1)

    energy             [J]      > 0
    moment_of_inertia  [kg m²]  > 0

    Returns:  [rad/s]; a float for floats, an array for arrays, which broadcast.
    Source:   Eq (46).
    Valid:    A homogeneous sphere; no energy lost to sliding.
    Accuracy: 1.5 ulp.

    >>> round(initial_angular_speed(energy=7.0, moment_of_inertia=1.0), 12)
    2.0
    """
    return sqrt(4 / 7 * energy / moment_of_inertia)


def angular_deceleration(*, mean_rolling_moment: Moment, moment_of_inertia: Inertia) -> AngularAcceleration:
    """Return the rate at which the rolling moment alone changes the spin of a sphere.

        dω1/dt = −⟨M⟩/I1

    mean_rolling_moment  [N m]    > 0
    moment_of_inertia    [kg m²]  > 0

    Returns:  [rad/s²]; a float for floats, an array for arrays, which broadcast.
    Source:   Eq (47). It leaves out the friction force that also brakes the rotation: no slip demands
              −⟨M⟩/(I1 + m1R1²), which is 2/7 of it.
    Valid:    A sphere that spins in place.
    Accuracy: 0.5 ulp.

    >>> angular_deceleration(mean_rolling_moment=1.0, moment_of_inertia=2.0)
    -0.5
    """
    return -mean_rolling_moment / moment_of_inertia


def n_roll(
    *,
    energy: Energy,
    work_of_adhesion: SurfaceEnergy,
    reduced_radius: Length,
    load_factor: Number,
    yield_displacement: Length,
) -> Number:
    """Return the number of full turns that sphere 1 rolls over a fixed body 2.

        n = W0/(7π⟨M⟩) = W0/(14π P_c â^(3/2) ξ) = W0/(21π²wR â^(3/2) ξ)

    energy              [J]     > 0
    work_of_adhesion    [J/m²]  > 0
    reduced_radius      [m]     > 0
    load_factor         [1]     > 0
    yield_displacement  [m]     > 0

    Returns:  [1]; a float for floats, an array for arrays, which broadcast.
    Source:   Eq (48).
    Valid:    As Eq (47): it dissipates 2/7 of the energy and lets the rest slide away.
    Accuracy: 3.5 ulp above W0, w, R and x.

    >>> n = n_roll(energy=42 * pi**2, work_of_adhesion=1.0, reduced_radius=1.0, load_factor=1.0, yield_displacement=1.0)
    >>> round(n, 12)
    2.0
    """
    return energy / (21 * pi**2 * work_of_adhesion * reduced_radius * load_factor * yield_displacement)


def n_roll_energy_balance(
    *,
    energy: Energy,
    work_of_adhesion: SurfaceEnergy,
    reduced_radius: Length,
    load_factor: Number,
    yield_displacement: Length,
) -> Number:
    """Return the number of full turns that sphere 1 rolls over a fixed body 2 until rolling has dissipated its energy.

        n = W0/(2π⟨M⟩) = W0/(4π P_c â^(3/2) ξ) = W0/(6π²wR â^(3/2) ξ), which is 7/2 of Eq (48)

    energy              [J]     > 0
    work_of_adhesion    [J/m²]  > 0
    reduced_radius      [m]     > 0
    load_factor         [1]     > 0
    yield_displacement  [m]     > 0

    Returns:  [1]; a float for floats, an array for arrays, which broadcast.
    Source:   Caption of Fig. 7: "until all energy is dissipated".
    Valid:    No slip at any time.
    Accuracy: 4 ulp above W0, w, R and x.

    >>> n = n_roll_energy_balance(energy=42 * pi**2, work_of_adhesion=1.0, reduced_radius=1.0, load_factor=1.0,
    ...                           yield_displacement=1.0)
    >>> round(n, 12)
    7.0
    """
    return energy / (6 * pi**2 * work_of_adhesion * reduced_radius * load_factor * yield_displacement)


def n_roll_at_energy_ratio(
    *,
    energy_ratio: Number,
    work_of_adhesion: SurfaceEnergy,
    contact_modulus: Stress,
    reduced_radius: Length,
    load_factor: Number,
    yield_displacement: Length,
) -> Number:
    """Return the number of full turns that sphere 1 rolls over a fixed body 2, for an energy given in units of P_cδ0.

        n = (3/(14 ∛(9π))) (γ/E*)^(2/3) (∛R/ξ) W0/(P_cδ0) / â^(3/2) = ∛(3w²R/(10976πE*²)) W0/(P_cδ0) / (ξ â^(3/2))

    energy_ratio        [1]     > 0
    work_of_adhesion    [J/m²]  > 0
    contact_modulus     [Pa]    > 0
    reduced_radius      [m]     > 0
    load_factor         [1]     > 0
    yield_displacement  [m]     > 0

    Returns:  [1]; a float for floats, an array for arrays, which broadcast.
    Source:   Eq (49), which is Eq (48) in other words.
    Valid:    As Eq (48).
    Accuracy: 3.5 ulp above w, R, E* and x.

    >>> n = n_roll_at_energy_ratio(energy_ratio=1.0, work_of_adhesion=0.05, contact_modulus=27.804e9,
    ...                            reduced_radius=50e-9, load_factor=1.0, yield_displacement=2e-10)
    >>> round(n, 4)
    0.0121
    """
    strain_length = work_of_adhesion / contact_modulus
    length = cbrt(3 / (10976 * pi) * strain_length**2 * reduced_radius)
    return energy_ratio * length / (yield_displacement * load_factor)


def n_roll_energy_balance_at_energy_ratio(
    *,
    energy_ratio: Number,
    work_of_adhesion: SurfaceEnergy,
    contact_modulus: Stress,
    reduced_radius: Length,
    load_factor: Number,
    yield_displacement: Length,
) -> Number:
    """Return the number of full turns by the energy balance, for an energy given in units of P_cδ0.

        n = ∛(3w²R/(256πE*²)) W0/(P_cδ0) / (ξ â^(3/2)), which is 7/2 of Eq (49)

    energy_ratio        [1]     > 0
    work_of_adhesion    [J/m²]  > 0
    contact_modulus     [Pa]    > 0
    reduced_radius      [m]     > 0
    load_factor         [1]     > 0
    yield_displacement  [m]     > 0

    Returns:  [1]; a float for floats, an array for arrays, which broadcast.
    Source:   Caption of Fig. 7, in the terms of Eq (49).
    Valid:    No slip at any time.
    Accuracy: 3 ulp above w, R, E* and x.

    >>> n = n_roll_energy_balance_at_energy_ratio(energy_ratio=1.0, work_of_adhesion=0.05, contact_modulus=27.804e9,
    ...                                           reduced_radius=50e-9, load_factor=1.0, yield_displacement=2e-10)
    >>> round(n, 4)
    0.0422
    """
    strain_length = work_of_adhesion / contact_modulus
    length = cbrt(3 / (256 * pi) * strain_length**2 * reduced_radius)
    return energy_ratio * length / (yield_displacement * load_factor)
