"""Energies, speeds and strengths of contacts and of aggregates, as papers and public codes define them.

The energies to break a contact and to roll it are those of a contact that carries no load at first. An aggregate has N
identical grains. Two equal aggregates collide, and the impact energy is that of their relative motion, ½(N m1/2)v².
"""

from __future__ import annotations

from .dimensions import Angle, Energy, Length, Mass, Moment, Number, Speed, Stress, SurfaceEnergy
from .elementary import cube, pi, sqrt

# In units of P_cδ0, which is (81π⁵)^(1/3) γ^(5/3)R^(4/3)/E*^(2/3).
STICKING_PASZUN_DOMINIK = 0.32895869205467987  # (8π/3) 1.07²/(81π⁵)^(1/3)
STICKING_PENCIL_CODE = 0.6585009935846583  # 19.2/(81π⁵)^(1/3)
CLOSEST_PACKING = 0.74  # the largest filling factor of equal spheres, as codes round it
_BELOW = 8.881784197001253e-18  # 0.74 minus the double nearest to it


def break_energy_dust_simulation(*, fold_energy: Energy) -> Energy:
    """Return the energy to break a contact by a rule of thumb.

        E_break = 1.8 F_cδ_c

    Source:   As coded in Lumajord/DustSimulation, MaterialInfoWidget.
    Valid:    More than by JKR, where parting the spheres from P = 0 takes at most 1.5426 F_cδ_c, with fixed grips.
    """
    return 1.8 * fold_energy


def roll_energy(*, unloaded_moment: Moment, rolling_angle: Angle) -> Energy:
    """Return the energy to roll one sphere over the other by an angle.

        E_roll = Mθ, M = 4P_cξ

    Source:   Work of a moment; M is Eq (26).
    Valid:    A turn of sphere 1 while body 2 is held, with the full lag ξ all the way; Eq (43) has half this moment.
    """
    return unloaded_moment * rolling_angle


def roll_energy_quarter_turn(*, unloaded_moment: Moment) -> Energy:
    """Return the energy to roll by 90 degrees.

        E_roll = Mπ/2 = 6π²γRξ

    Source:   As coded in Lumajord/DustSimulation, MaterialInfoWidget.
    Valid:    A contact that rolls with the full lag ξ all the way; Eq (43) has a mean moment of half as much.
    """
    return pi / 2 * unloaded_moment


def roll_energy_half_turn(*, unloaded_moment: Moment) -> Energy:
    """Return the energy to roll by 180 degrees.

        E_roll = Mπ = 12π²γRξ, which is 6π²γr0ξ for identical spheres of radius r0

    Source:   6π²γr0ξ as it stands in StephaneMichoulier/Pamdeas, dust.cpp.
    Valid:    A contact that rolls with the full lag ξ all the way; Eq (43) has a mean moment of half as much.
    """
    return pi * unloaded_moment


def sticking_energy_paszun_dominik(*, adhesion_energy: Energy) -> Energy:
    """Return the largest energy of relative motion at which spheres stick, as in Paszun & Dominik.

        E_stick = ½mv² = (8π/3) 1.07² γ^(5/3) R^(4/3)/E*^(2/3) = 0.3290 P_cδ0, v = 1.07 (γ/R)^(5/6)/(E*^(1/3)ρ^(1/2))

    Source:   Paszun & Dominik 2008, Eq 3, as Lumajord/DustSimulation cites it; ½mv² with m = (16/3)πR³ρ.
    Valid:    Equal spheres; the speed of unequal ones follows from the energy.
    """
    return STICKING_PASZUN_DOMINIK * adhesion_energy


def sticking_energy_pencil_code(*, adhesion_energy: Energy) -> Energy:
    """Return the largest energy of relative motion at which spheres stick, as in the Pencil Code.

        E_stick = 2·9.6 γ^(5/3) R^(4/3)/E*^(2/3) = 0.6585 P_cδ0

    Source:   As coded in pencil-code/pencil-code, dustvelocity.f90, which takes the factor 2 from Dominik & Tielens
              1997, Sect. 3.2.
    Valid:    Equal spheres.
    """
    return STICKING_PENCIL_CODE * adhesion_energy


def sticking_speed(*, sticking_energy: Energy, reduced_mass: Mass) -> Speed:
    """Return the largest relative speed at which spheres stick if only jump-in and the fold dissipate energy.

        v = √(2U_stick/m), which is √(14.18/m) (w⁵R⁴/E*²)^(1/6) in JKR

    Source:   Thornton & Ning 1998, Eq 54.
    Valid:    A head-on collision without other loss.
    """
    return sqrt(2 * sticking_energy) / sqrt(reduced_mass)  # near DMT, 2U_stick/m may be below the range of doubles


def sticking_speed_paszun_dominik(*, sticking_energy_paszun_dominik: Energy, reduced_mass: Mass) -> Speed:
    """Return the largest relative speed at which spheres stick, as in Paszun & Dominik.

        v = √(2E_stick/m), which for equal spheres is 1.07 (γ/R)^(5/6)/(E*^(1/3)ρ^(1/2))

    Source:   Paszun & Dominik 2008, Eq 3, as Lumajord/DustSimulation cites it.
    Valid:    Equal spheres; for unequal ones, the speed of the same energy.
    """
    return sqrt(2 * sticking_energy_paszun_dominik / reduced_mass)


def sticking_speed_pencil_code(*, sticking_energy_pencil_code: Energy, reduced_mass: Mass) -> Speed:
    """Return the largest relative speed at which spheres stick, as in the Pencil Code.

        v = √(2E_stick/m)

    Source:   As coded in pencil-code/pencil-code, dustvelocity.f90.
    Valid:    Equal spheres.
    """
    return sqrt(2 * sticking_energy_pencil_code / reduced_mass)


# --- Aggregates -------------------------------------------------------------------------------------------------------


def contacts(*, monomers: Number) -> Number:
    """Return the number of contacts of an aggregate if it is not known: one for each grain.

        n_c = N

    Source:   Rounded from N − 1, the number in a chain or a fractal aggregate without closed loops.
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


def restructuring_speed(*, restructuring_energy: Energy, monomers: Number, mass: Mass) -> Speed:
    """Return the relative speed at which two equal aggregates begin to restructure.

        v = √(4E_restr/(N m1))

    Source:   E = ½(N m1/2)v², N grains in each.
    Valid:    A head-on collision.
    """
    return 2 * sqrt(restructuring_energy / (monomers * mass))


def restructuring_speed_ormel(*, restructuring_energy_ormel: Energy, monomers: Number, mass: Mass) -> Speed:
    """Return the relative speed at which two equal aggregates begin to restructure, as in Ormel et al.

        v = √(4E_restr/(N m1))

    Source:   E = ½(N m1/2)v², N grains in each.
    Valid:    A head-on collision.
    """
    return 2 * sqrt(restructuring_energy_ormel / (monomers * mass))


def disruption_energy(*, pull_off_work: Energy, contacts: Number) -> Energy:
    """Return the impact energy of catastrophic disruption, with the work that breaks a contact in JKR.

        E_disr = 10·2n_c E_break, E_break = U_grips = 1.5426 F_cδ_c

    Source:   Wada et al. 2007: "approximately 10 times the energy necessary to break all contacts", here 2n_c
              contacts.
    Valid:    Two-dimensional aggregates of equal masses, head-on. The abstract does not say which E_break it takes.
    """
    return 20 * contacts * pull_off_work


def disruption_energy_dust_simulation(*, break_energy_dust_simulation: Energy, contacts: Number) -> Energy:
    """Return the impact energy of catastrophic disruption, with the rule of thumb for the energy to break a contact.

        E_disr = 10·2n_c E_break, E_break = 1.8 F_cδ_c

    Source:   Wada et al. 2007, as cited for `disruption_energy`; E_break as coded in Lumajord/DustSimulation.
    Valid:    Two-dimensional aggregates of equal masses, head-on. The abstract does not say which E_break it takes.
    """
    return 20 * contacts * break_energy_dust_simulation


def disruption_speed(*, disruption_energy: Energy, monomers: Number, mass: Mass) -> Speed:
    """Return the relative speed at which two equal aggregates are disrupted.

        v = √(4E_disr/(N m1)), which is √(80E_break/m1) for n_c = N

    Source:   E = ½(N m1/2)v², N grains in each.
    Valid:    A head-on collision.
    """
    return 2 * sqrt(disruption_energy / (monomers * mass))


def disruption_speed_dust_simulation(
    *, disruption_energy_dust_simulation: Energy, monomers: Number, mass: Mass
) -> Speed:
    """Return the relative speed at which two equal aggregates are disrupted, with the rule of thumb for E_break.

        v = √(4E_disr/(N m1)), which is √(80E_break/m1) for n_c = N

    Source:   E = ½(N m1/2)v², N grains in each.
    Valid:    A head-on collision.
    """
    return 2 * sqrt(disruption_energy_dust_simulation / (monomers * mass))


def compressive_strength(*, roll_energy_half_turn: Energy, radius: Length, filling_factor: Number) -> Stress:
    """Return the pressure that compresses an aggregate quasi-statically.

        P = (E_roll/R1³)(1/φ − 1/φ_max)⁻³, E_roll = 6π²γR1ξ (180 degrees), φ_max = 0.74

    Source:   Tatsuuma et al. 2023, of which the abstract was read. The form is that of codes which cite it: φ_max is
              0.74 in danieljprice/phantom, porosity.f90, and 0.78 in another. For φ ≪ φ_max, P tends to E_roll φ³/R1³.
    Valid:    Rolling decides below φ = 0.1; above, sliding and twisting do. φ < 0.74. Static: an impact needs more.
    """
    loose = filling_factor / (CLOSEST_PACKING - filling_factor + _BELOW) / radius
    return CLOSEST_PACKING**3 * roll_energy_half_turn * cube(loose)


def tensile_strength(*, work_of_adhesion: SurfaceEnergy, radius: Length, filling_factor: Number) -> Stress:
    """Return the tension that tears an aggregate.

        P = 0.6 φ^1.8 γ/R1, γ = w/2

    Source:   Tatsuuma et al. 2019, as coded in StephaneMichoulier/Pamdeas, disruption.cpp, and danieljprice/phantom.
    Valid:    Filling factors of 0.01 to 0.5. The strength depends on the aggregate's volume, too (Kimura et al. 2020).
    """
    return 0.3 * (filling_factor**2 / filling_factor**0.2) * (work_of_adhesion / radius)
