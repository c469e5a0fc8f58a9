"""Energies, speeds and strengths of aggregates of identical grains, as others conclude them from those of one contact.

Two equal aggregates of N grains each collide: the impact energy is that of their relative motion, ½(N m1/2)v².
"""

from __future__ import annotations

from .dimensions import Energy, Length, Mass, Number, Speed, Stress, SurfaceEnergy
from .elementary import cube, sqrt

CLOSEST_PACKING = 0.74  # the largest filling factor of equal spheres
_BELOW = 8.881784197001253e-18  # by which 0.74 exceeds its double


def contacts(*, monomers: Number) -> Number:
    """Return the number of contacts of an aggregate for which none is given.

        n_c = N

    Source:   A chain or a fractal aggregate without closed loops has N − 1.
    Valid:    Loose aggregates; compact ones have up to 6N.
    """
    return monomers


def restructuring_energy(*, roll_energy_quarter_turn: Energy) -> Energy:
    """Return the impact energy at which aggregates begin to restructure.

        E_restr = 5E_roll, E_roll = 6π²γRξ (90 degrees)

    Source:   Dominik & Tielens 1997, as Ormel et al. 2007 cite it.
    Valid:    Measured thresholds agree if the rolling force is the measured one (Blum & Wurm 2000).
    """
    return 5 * roll_energy_quarter_turn


def restructuring_energy_ormel(*, roll_energy_quarter_turn: Energy) -> Energy:
    """Return the impact energy at which aggregates begin to restructure, as Ormel et al. take it.

        E_restr = E_roll, E_roll = 6π²γRξ (90 degrees)

    Source:   Ormel et al. 2007.
    Valid:    As 5E_roll.
    """
    return roll_energy_quarter_turn


def restructuring_speed(*, restructuring_energy: Energy, monomers: Number, mass: Mass) -> Speed:
    """Return the relative speed at which two equal aggregates begin to restructure.

        v = √(4E_restr/(N m1))

    Source:   E = ½(N m1/2)v², N grains in each.
    Valid:    As the energy; a head-on collision.
    """
    return _speed(restructuring_energy, monomers, mass)


def restructuring_speed_ormel(*, restructuring_energy_ormel: Energy, monomers: Number, mass: Mass) -> Speed:
    """Return the relative speed at which two equal aggregates begin to restructure, as Ormel et al. take it.

        v = √(4E_restr/(N m1))

    Source:   E = ½(N m1/2)v², N grains in each.
    Valid:    As the energy; a head-on collision.
    """
    return _speed(restructuring_energy_ormel, monomers, mass)


def disruption_energy(*, pull_off_work: Energy, contacts: Number) -> Energy:
    """Return the impact energy of catastrophic disruption, with the work that breaks a contact in JKR.

        E_disr = 10·2n_c E_break, E_break = U_grips = 1.5426 F_cδ_c

    Source:   Wada et al. 2007: "approximately 10 times the energy necessary to break all contacts", here those of both.
    Valid:    Two-dimensional aggregates, head-on. The abstract does not say which E_break it takes.
    """
    return 20 * contacts * pull_off_work


def disruption_energy_dust_simulation(*, break_energy_dust_simulation: Energy, contacts: Number) -> Energy:
    """Return the impact energy of catastrophic disruption, with the rule of thumb for the energy to break a contact.

        E_disr = 10·2n_c E_break, E_break = 1.8 F_cδ_c

    Source:   Wada et al. 2007, as above; E_break as coded in Lumajord/DustSimulation.
    Valid:    Two-dimensional aggregates, head-on. The abstract does not say which E_break it takes.
    """
    return 20 * contacts * break_energy_dust_simulation


def disruption_speed(*, disruption_energy: Energy, monomers: Number, mass: Mass) -> Speed:
    """Return the relative speed at which two equal aggregates are disrupted.

        v = √(4E_disr/(N m1)), which is √(80E_break/m1) for n_c = N

    Source:   E = ½(N m1/2)v², N grains in each.
    Valid:    As the energy; a head-on collision.
    """
    return _speed(disruption_energy, monomers, mass)


def disruption_speed_dust_simulation(
    *, disruption_energy_dust_simulation: Energy, monomers: Number, mass: Mass
) -> Speed:
    """Return the relative speed at which two equal aggregates are disrupted, with the rule of thumb for E_break.

        v = √(4E_disr/(N m1)), which is √(80E_break/m1) for n_c = N

    Source:   E = ½(N m1/2)v², N grains in each.
    Valid:    As the energy; a head-on collision.
    """
    return _speed(disruption_energy_dust_simulation, monomers, mass)


def compressive_strength(*, roll_energy_half_turn: Energy, radius: Length, filling_factor: Number) -> Stress:
    """Return the pressure that compresses an aggregate quasi-statically.

        P = (E_roll/R1³)(1/φ − 1/φ_max)⁻³, E_roll = 6π²γR1ξ (180 degrees), φ_max = 0.74

    filling_factor  [1]  0 to 0.74

    Source:   As coded in danieljprice/phantom, porosity.f90, which has another E_roll; it tends to Kataoka et al. 2013,
              E_roll φ³/R1³, with E_roll as StephaneMichoulier/Pamdeas has it.
    Valid:    φ < 0.74. Static: an impact needs more.
    """
    loose = filling_factor / (CLOSEST_PACKING - filling_factor + _BELOW) / radius
    return CLOSEST_PACKING**3 * roll_energy_half_turn * cube(loose)


def tensile_strength(*, work_of_adhesion: SurfaceEnergy, radius: Length, filling_factor: Number) -> Stress:
    """Return the tension that tears an aggregate.

        P = 0.6 φ^1.8 γ/R1, γ = w/2

    filling_factor  [1]  0 to 0.74

    Source:   Tatsuuma et al. 2019, as coded in StephaneMichoulier/Pamdeas, disruption.cpp, and danieljprice/phantom.
    Valid:    Filling factors of 0.01 to 0.5.
    """
    return 0.3 * (filling_factor**2 / filling_factor**0.2) * (work_of_adhesion / radius)


def _speed(energy: Energy, monomers: Number, mass: Mass) -> Speed:
    """Return the relative speed of two aggregates of N grains each with an impact energy."""
    return 2 * sqrt(energy / (monomers * mass))
