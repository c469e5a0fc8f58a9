"""The JKR contact at any state that fixed grips hold, and the energies between its states.

One variable describes a state: x = â^(3/2) (`load_factor`). It is 1 without load, 1/2 at pull-off, 1/6 at the fold
where fixed grips let go, and runs down to 0 on the unstable branch. A load has two states for −P_c < P < 0, an
approach has two between the fold and 0. A hat marks a quantity relative to its value without load, â = a/a0 and
δ̂ = δ/δ0, and a load relative to the pull-off force, P̂ = P/P_c.
"""

from __future__ import annotations

from .dimensions import Area, Energy, Force, Length, Number, Stress, SurfaceEnergy
from .elementary import FloatOrArray, cbrt, pi, sqrt, where, within

FOLD_APPROACH = -0.8254818122236567  # the double nearest to −(3/4)^(2/3), the least δ̂
FOLD_APPROACH_REST = 1.4776601947357812e-17  # −(3/4)^(2/3) minus this double
CBRT_6 = cbrt(6.0)
NEWTON_STEPS = 6  # from the start below; a seventh changes nothing

# Energies between states of the curve, in P_cδ0: from ∫P̂ dδ̂ = 24/5 y^10 − 8y^7 + 2y^4 with y = √â.
WELL = 6 / 5
PULL_OFF_AT_FIXED_GRIPS = 6 / 5 + 2 / 15 / CBRT_6
PULL_OFF_AT_DEAD_LOAD = (6 - cbrt(4.0)) / 5
STICKING: float = 2 / 15 / CBRT_6 + 4 / 5 * (2 / 3) ** (1 / 3)


def load_margin_of_factor(*, load_factor: Number) -> Number:
    """Return √(1 + P/P_c), or its negative for x < 1/2, beyond pull-off.

        s = 2x − 1

    Source:   Eq (5), as x = (1 + s)/2.
    Valid:    0 < x.
    """
    return 2 * load_factor - 1


def load_at_factor(*, pull_off_force: Force, load_factor: Number) -> Force:
    """Return the load that holds a contact in a state.

        P = 4P_c(x² − x)

    Source:   Eq (5).
    Valid:    0 < x, both branches.
    """
    return 4 * pull_off_force * load_factor * (load_factor - 1)


def load_factor_at_approach(*, approach_at_load: Length, approach: Length) -> Number:
    """Return the state that fixed grips hold at an approach of the centres, as x = â^(3/2).

        3x^(4/3) − 2x^(1/3) = δ/δ0

    Source:   Eq (6), solved by Newton's method in η = x^(1/3)/x_fold^(1/3) − 1: η²(3 + 2η + η²/2) = 6^(1/3)(δ̂ −
              δ̂_fold).
    Valid:    δ̂ ≥ −(3/4)^(2/3). Beyond, a float raises ValueError and an array holds NaN.
    """
    return (2 + _approach_over_root(approach_at_load / approach)) / 3


def load_margin_at_approach(*, approach_at_load: Length, approach: Length) -> Number:
    """Return √(1 + P/P_c) at an approach of the centres, or its negative between pull-off and the fold.

        s = 2x − 1 = (1 + 2(δ/δ0)/x^(1/3))/3

    Source:   Eqs (5) and (6), as `load_factor_at_approach`; the last form has smaller rounding errors than 2x − 1.
    Valid:    δ̂ ≥ −(3/4)^(2/3). Beyond, a float raises ValueError and an array holds NaN.
    """
    return (1 + 2 * _approach_over_root(approach_at_load / approach)) / 3


def _approach_over_root(approach_ratio: FloatOrArray) -> FloatOrArray:
    """Return δ̂/y = 3x − 2, y = x^(1/3), of the state that fixed grips hold at δ̂; it has the relative error of y."""
    excess = _excess(approach_ratio)
    start = where(excess < 3, sqrt(excess / 3), sqrt(sqrt(2 * excess)))
    y = (1 + _root_of_excess(start, excess)) / CBRT_6
    return approach_ratio / y


def _excess(approach_ratio: FloatOrArray) -> FloatOrArray:
    """Return 6^(1/3)(δ̂ − δ̂_fold), δ̂_fold with more digits than a double; below the fold it is not defined."""
    above_fold = approach_ratio - FOLD_APPROACH
    return within(above_fold >= 0, where(above_fold > 0, above_fold - FOLD_APPROACH_REST, 0.0) * CBRT_6)


def _root_of_excess(eta: FloatOrArray, excess: FloatOrArray) -> FloatOrArray:
    """Return the root of the convex η²(3 + 2η + η²/2) − excess, by Newton's method from a start beyond the root."""
    for _ in range(NEWTON_STEPS):
        slope = eta * (6 + eta * (6 + 2 * eta))
        eta = eta - (eta * eta * (3 + eta * (2 + eta / 2)) - excess) / where(slope == 0, 1.0, slope)
    return eta


# --- The states where the contact breaks ------------------------------------------------------------------------------


def contact_radius_at_pull_off(*, contact_radius: Length) -> Length:
    """Return the radius of the contact circle at which a constant tension breaks the contact.

        a_pull = a0/4^(1/3) = 0.6299605 a0

    Source:   Eq (5) at P = −P_c.
    Valid:    JKR.
    """
    return contact_radius / cbrt(4.0)


def contact_radius_at_fold(*, contact_radius: Length) -> Length:
    """Return the radius of the contact circle at which fixed grips let go.

        a_fold = a0/36^(1/3) = 0.3028534 a0

    Source:   Eq (6), where dδ/da = 0.
    Valid:    JKR.
    """
    return contact_radius / cbrt(36.0)


def approach_at_pull_off(*, approach: Length) -> Length:
    """Return the approach of the centres, here negative, at which a constant tension breaks the contact.

        δ_pull = −δ0/16^(1/3) = −0.3968503 δ0

    Source:   Eqs (5) and (6) at P = −P_c.
    Valid:    JKR.
    """
    return -approach / cbrt(16.0)


def approach_at_fold(*, approach: Length) -> Length:
    """Return the least approach of the centres, at which fixed grips let go.

        δ_fold = −(9/16)^(1/3) δ0 = −0.8254818 δ0

    Source:   Eq (6), where dδ/da = 0.
    Valid:    JKR.
    """
    return FOLD_APPROACH * approach


def contact_area_at_pull_off(*, contact_radius_at_pull_off: Length) -> Area:
    """Return the area of the contact circle at which a constant tension breaks the contact.

        A_pull = πa_pull²

    Source:   Geometry.
    Valid:    Any law of attraction with a contact there.
    """
    return pi * contact_radius_at_pull_off**2


def contact_area_at_fold(*, contact_radius_at_fold: Length) -> Area:
    """Return the area of the contact circle at which fixed grips let go.

        A_fold = πa_fold²

    Source:   Geometry.
    Valid:    Any law of attraction; 0 where the grips hold on to spheres that attract without touching.
    """
    return pi * contact_radius_at_fold**2


# --- Energies ---------------------------------------------------------------------------------------------------------


def adhesion_energy(*, work_of_adhesion: SurfaceEnergy, reduced_radius: Length, contact_modulus: Stress) -> Energy:
    """Return the typical energy of adhesion, about as much as a slow head-on collision dissipates.

        W = P_c δ0 = (3/2)πwR (3π²w²R/(4E*²))^(1/3) = wR (81π⁵w²R/(32E*²))^(1/3)

    Source:   Text below Eq (48), with JKR's P_c and δ0, Eqs (1) and (3).
    Valid:    An order of magnitude; by JKR, spheres stick up to 0.7722 P_cδ0.
    """
    length = cbrt(81 / 32 * pi**5 * work_of_adhesion**2 * reduced_radius / contact_modulus**2)
    return work_of_adhesion * reduced_radius * length


def well_energy(*, adhesion_energy: Energy) -> Energy:
    """Return the energy that binds the spheres: released from first touch to equilibrium along the whole curve.

        (6/5) P_cδ0

    Source:   Eqs (5) and (6).
    Valid:    JKR; quasi-static.
    """
    return WELL * adhesion_energy


def pull_off_work(*, adhesion_energy: Energy) -> Energy:
    """Return the work to separate the spheres from P = 0 with fixed grips, which hold them as far as the fold.

        (6/5 + (2/15)6^(−1/3)) P_cδ0 = 1.2733762 P_cδ0

    Source:   Eqs (5) and (6).
    Valid:    JKR; quasi-static; the jump at the fold dissipates what is left.
    """
    return PULL_OFF_AT_FIXED_GRIPS * adhesion_energy


def pull_off_work_at_dead_load(*, adhesion_energy: Energy) -> Energy:
    """Return the work to separate the spheres from P = 0 with a load that grows to P_c.

        (6 − 4^(1/3))/5 P_cδ0 = 0.8825198 P_cδ0

    Source:   Eqs (5) and (6).
    Valid:    JKR; quasi-static up to the jump at P = −P_c.
    """
    return PULL_OFF_AT_DEAD_LOAD * adhesion_energy


def sticking_energy(*, adhesion_energy: Energy) -> Energy:
    """Return the largest relative energy ½mv² of a head-on collision after which the spheres stick.

    Here m is the reduced mass. Jump-in and the fold dissipate this energy.

        ((2/15)6^(−1/3) + (4/5)(2/3)^(1/3)) P_cδ0 = 0.7722405 P_cδ0

    Source:   Eqs (5) and (6); text below Eq (48) has P_cδ0 as its order of magnitude.
    Valid:    JKR; no other loss.
    """
    return STICKING * adhesion_energy


def fold_energy(*, adhesion_energy: Energy) -> Energy:
    """Return the pull-off force times the stretch −δ at which fixed grips let go, a unit of energies.

        F_cδ_c = (9/16)^(1/3) P_cδ0, F_c = P_c, δ_c = a0²/(2·6^(1/3)R) = |δ_min|

    Source:   F_c and δ_c of the code Lumajord/DustSimulation, after Wada et al. 2007.
    Valid:    JKR.
    """
    return -FOLD_APPROACH * adhesion_energy
