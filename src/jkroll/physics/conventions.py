"""Energies and speeds of a contact as others define them: to break it, to roll it, and to stick.

Each is the formula of a paper or of a public code, which the nomenclature names. All start from a contact without load.
"""

from __future__ import annotations

from .dimensions import Angle, Energy, Mass, Moment, Speed
from .elementary import pi, sqrt
from .jkr import FOLD_APPROACH

# In P_cδ0, which is (81π⁵)^(1/3) γ^(5/3)R^(4/3)/E*^(2/3).
STICKING_PASZUN_DOMINIK = 0.32895869205467987  # (8π/3) 1.07²/(81π⁵)^(1/3)
STICKING_PENCIL_CODE = 0.6585009935846583  # 19.2/(81π⁵)^(1/3)


def fold_energy(*, adhesion_energy: Energy) -> Energy:
    """Return the product of the pull-off force and the approach at the fold, a unit of energies.

        F_cδ_c = (9/16)^(1/3) P_cδ0, F_c = P_c, δ_c = a0²/(2·6^(1/3)R) = |δ_min|

    Source:   F_c and δ_c of the code Lumajord/DustSimulation, after Wada et al. 2007.
    Valid:    JKR.
    """
    return -FOLD_APPROACH * adhesion_energy


def break_energy_dust_simulation(*, fold_energy: Energy) -> Energy:
    """Return the energy to break a contact by a rule of thumb.

        E_break = 1.8 F_cδ_c

    Source:   As coded in Lumajord/DustSimulation, MaterialInfoWidget.
    Valid:    No path of JKR from P = 0 takes as much: fixed grips take 1.5426 F_cδ_c.
    """
    return 1.8 * fold_energy


def roll_energy(*, unloaded_moment: Moment, rolling_angle: Angle) -> Energy:
    """Return the energy to roll one sphere over the other by an angle.

        E_roll = Mθ, M = 4P_cξ

    rolling_angle  [rad]  > 0; the turn of sphere 1 while body 2 is held

    Source:   Work of a moment; M is Eq (26).
    Valid:    A contact that rolls with the full lag ξ all the way; Eq (43) has a mean moment of half as much.
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
    """Return the largest relative energy that sticks for a speed of 1.07 (γ/R)^(5/6)/(E*^(1/3)ρ^(1/2)).

        E_stick = (8π/3) 1.07² γ^(5/3) R^(4/3)/E*^(2/3) = 0.3290 P_cδ0

    Source:   Paszun & Dominik 2008, Eq 3, as Lumajord/DustSimulation cites it; ½mv² with m = (16/3)πR³ρ.
    Valid:    Equal spheres; the speed of unequal ones follows from the energy.
    """
    return STICKING_PASZUN_DOMINIK * adhesion_energy


def sticking_energy_pencil_code(*, adhesion_energy: Energy) -> Energy:
    """Return the largest relative energy that sticks as the Pencil Code has it.

        E_stick = 2·9.6 γ^(5/3) R^(4/3)/E*^(2/3) = 0.6585 P_cδ0

    Source:   As coded in pencil-code/pencil-code, dustvelocity.f90, which has the 2 from Dominik & Tielens 1997, Sect.
              3.2.
    Valid:    Equal spheres.
    """
    return STICKING_PENCIL_CODE * adhesion_energy


def sticking_speed(*, sticking_energy: Energy, reduced_mass: Mass) -> Speed:
    """Return the largest relative speed at which spheres stick that lose what jump-in and the fold dissipate.

        v = √(2U_stick/m) = √(14.18/m) (w⁵R⁴/E*²)^(1/6)

    Source:   Thornton & Ning 1998, Eq 54.
    Valid:    A head-on collision without other loss.
    """
    return sqrt(2 * sticking_energy) / sqrt(reduced_mass)  # near DMT, the quotient leaves the doubles


def sticking_speed_paszun_dominik(*, sticking_energy_paszun_dominik: Energy, reduced_mass: Mass) -> Speed:
    """Return the largest relative speed at which spheres stick after Paszun & Dominik.

        v = √(2E_stick/m), which for equal spheres is 1.07 (γ/R)^(5/6)/(E*^(1/3)ρ^(1/2))

    Source:   Paszun & Dominik 2008, Eq 3, as Lumajord/DustSimulation cites it.
    Valid:    Equal spheres; for unequal ones, the speed of the same energy.
    """
    return sqrt(2 * sticking_energy_paszun_dominik / reduced_mass)


def sticking_speed_pencil_code(*, sticking_energy_pencil_code: Energy, reduced_mass: Mass) -> Speed:
    """Return the largest relative speed at which spheres stick as the Pencil Code has it.

        v = √(2E_stick/m)

    Source:   As coded in pencil-code/pencil-code, dustvelocity.f90.
    Valid:    Equal spheres.
    """
    return sqrt(2 * sticking_energy_pencil_code / reduced_mass)
