"""The JKR contact at any state: at a load or at an approach, on both branches, and the energies between its states.

One variable describes a state: x = â^(3/2) (`load_factor`). It is 1 without load, 1/2 at pull-off, 1/6 at the fold where
fixed grips let go, and runs down to 0 on the unstable branch. Loads have two states for −P_c < P < 0, approaches have
two between the fold and 0.
"""

from typing import Any

from .dimensions import Energy, Force, Length, Number, Stress, SurfaceEnergy
from .elementary import cbrt, leading_bits, product, sqrt, where, within

FOLD_APPROACH = -0.8254818122236567  # −(3/4)^(2/3), the least δ̂; rounded, and what rounding took:
_FOLD_REST = 1.4776601947357812e-17
_CBRT_6 = 1.8171205928321397
_NEWTON_STEPS = 8  # from the starts below, one less reaches the last digit


def load_margin_of_factor(*, load_factor: Number) -> Number:
    """√(1 + P/P_c) on the stable branch, and its negative beyond pull-off, where only fixed grips hold the contact.

        s = 2x − 1

    Source:   Eq (5), as x = (1 + s)/2.
    Valid:    0 < x.
    Accuracy: 0.5 ulp of 2x.

    >>> load_margin_of_factor(load_factor=0.5)
    0.0
    """
    return 2 * load_factor - 1


def load_at_factor(*, pull_off_force: Force, load_factor: Number) -> Force:
    """Load that holds a contact in a state.

        P = 4P_c(x² − x)

    Source:   Eq (5).
    Valid:    0 < x, both branches.
    Accuracy: 2 ulp above P_c and x − 1.

    >>> load_at_factor(pull_off_force=1.0, load_factor=0.5)
    -1.0
    """
    return 4 * pull_off_force * load_factor * (load_factor - 1)


def load_factor_at_approach(*, approach_at_load: Length, approach: Length) -> Number:
    """State on the stable branch, x = â^(3/2), at an approach of the centres.

        3x^(4/3) − 2x^(1/3) = δ/δ0

    Source:   Eq (6), solved by Newton's method in η = x^(1/3)/x_fold^(1/3) − 1: η²(3 + 2η + η²/2) = 6^(1/3)(δ̂ − δ̂_fold).
    Valid:    δ̂ ≥ −(3/4)^(2/3). Beyond, a float raises ValueError and an array holds NaN.
    Accuracy: 2 ulp for the ratio δ̂ as it is rounded, also at the fold, where the state itself is ill-conditioned.

    >>> load_factor_at_approach(approach_at_load=1.0, approach=1.0)
    1.0
    """
    return _factor(approach_at_load / approach)


def load_factor_at_load_unstable(*, load: Force, pull_off_force: Force, load_margin: Number) -> Number:
    """State on the unstable branch, x = â^(3/2), at a tension.

        x = (1 − s)/2 = −P/(2P_c(1 + s))

    Source:   Eq (5).
    Valid:    −P_c ≤ P ≤ 0.
    Accuracy: 2 ulp above s.

    >>> load_factor_at_load_unstable(load=-1.0, pull_off_force=1.0, load_margin=0.0)
    0.5
    """
    return -load / pull_off_force / (2 * (1 + load_margin))


def load_factor_at_approach_unstable(*, approach_at_load: Length, approach: Length) -> Number:
    """State on the unstable branch, x = â^(3/2), at an approach of the centres between the fold and 0.

        3x^(4/3) − 2x^(1/3) = δ/δ0

    Source:   Eq (6), solved by Newton's method.
    Valid:    −(3/4)^(2/3) ≤ δ̂ ≤ 0. Elsewhere, a float raises ValueError and an array holds NaN.
    Accuracy: 3 ulp for the ratio δ̂ as it is rounded, also at the fold.

    >>> load_factor_at_approach_unstable(approach_at_load=0.0, approach=1.0)
    0.0
    """
    return _unstable_factor(approach_at_load / approach)


def _factor(approach_ratio: Any) -> Any:
    """State x of the stable branch at an approach ratio δ̂."""
    excess = _excess(approach_ratio)
    start = where(excess < 3, sqrt(excess / 3), sqrt(sqrt(2 * excess)))
    return _factor_of_eta(_newton_eta(start, excess), excess)


def _unstable_factor(approach_ratio: Any) -> Any:
    """State x of the unstable branch at an approach ratio δ̂: near the fold by η, elsewhere by y = (3y⁴ − δ̂)/2."""
    excess = _excess(within(approach_ratio <= 0, approach_ratio))
    near = excess < 0.5
    bounded = where(near, excess, 0.5)
    near_fold = _factor_of_eta(_newton_eta(-sqrt(bounded / 3), bounded), bounded)
    depth = -where(near, -0.5, approach_ratio)
    root = depth / 2
    for _ in range(_NEWTON_STEPS):
        root = root + (3 * (root * root) * (root * root) + depth - 2 * root) / (2 - 12 * (root * root * root))
    head = leading_bits(root, 12)
    cube = head * head * head
    rest = root - head
    slope = 2 - 3 * (4 * cube + rest * (6 * head * head + rest * (4 * head + rest)))
    rest = ((depth - 2 * head) + 3 * cube * head) / slope
    far = cube + rest * (3 * head * (head + rest) + rest * rest)
    return where(excess >= 0, where(near, near_fold, far), float("nan"))


def _factor_of_eta(eta: Any, excess: Any) -> Any:
    """X = (1 + η)³/6 to 2 ulp, from the 13 leading bits of η, whose quartic is exact, and what the equation leaves."""
    h = leading_bits(eta, 13)
    d = eta - h
    slope = h * (6 + h * (6 + 2 * h)) + d * (3 + h * (6 + 3 * h) + d * (2 + 2 * h + d / 2))
    d = where(slope == 0, 0.0, (excess - h * h * (3 + h * (2 + h / 2))) / where(slope == 0, 1.0, slope))
    return (1 + (h * (3 + h * (3 + h)) + d * (3 * (1 + h) * (1 + h + d) + d * d))) / 6


def _excess(approach_ratio: Any) -> Any:
    """6^(1/3)(δ̂ − δ̂_fold), with the digits of δ̂_fold beyond a double; its domain ends at the fold."""
    beyond_fold = approach_ratio - FOLD_APPROACH
    return within(beyond_fold >= 0, where(beyond_fold > 0, (beyond_fold - _FOLD_REST) * _CBRT_6, 0.0))


def _newton_eta(eta: Any, excess: Any) -> Any:
    """The root of η²(3 + 2η + η²/2) = excess; the start is no further from the fold than a convex function allows."""
    for _ in range(_NEWTON_STEPS):
        slope = eta * (6 + eta * (6 + 2 * eta))
        step = (eta * eta * (3 + eta * (2 + eta / 2)) - excess) / where(slope == 0, 1.0, slope)
        eta = eta - step
    return eta


# --- Energies, from Eqs (5) and (6): ∫P dδ = P_cδ0 (24/5 y^10 − 8y^7 + 2y^4), y = √â -----------------------------------


def adhesion_energy(*, work_of_adhesion: SurfaceEnergy, reduced_radius: Length, contact_modulus: Stress) -> Energy:
    """Energy typical of adhesion: what a slow head-on collision dissipates, to order of magnitude.

        W = P_c δ0 = (81π⁵w⁵R⁴/(32E*²))^(1/3)

    Source:   Text below Eq (48).
    Valid:    The largest energy that sticks is 0.7722 P_cδ0.
    Accuracy: 1.5 ulp above w, R and E*.

    >>> f"{adhesion_energy(work_of_adhesion=0.05, reduced_radius=50e-9, contact_modulus=27.804e9):.4e}"
    '1.2508e-18'
    """
    return _in_adhesion_energies(774.6123271127436, work_of_adhesion, reduced_radius, contact_modulus)


def well_energy(*, work_of_adhesion: SurfaceEnergy, reduced_radius: Length, contact_modulus: Stress) -> Energy:
    """Energy that binds the two spheres: released from first touch to equilibrium along the whole of the curve.

        (6/5) P_cδ0

    Source:   Eqs (5) and (6).
    Valid:    JKR; quasi-static.
    Accuracy: 1.5 ulp above w, R and E*.

    >>> scene = {"work_of_adhesion": 0.05, "reduced_radius": 50e-9, "contact_modulus": 27.804e9}
    >>> round(well_energy(**scene) / adhesion_energy(**scene), 7)
    1.2
    """
    return _in_adhesion_energies(1338.5301012508212, work_of_adhesion, reduced_radius, contact_modulus)


def pull_off_work(*, work_of_adhesion: SurfaceEnergy, reduced_radius: Length, contact_modulus: Stress) -> Energy:
    """Work to separate the spheres from P = 0 with fixed grips, which hold on to the fold.

        (6/5 + (2/15)6^(−1/3)) P_cδ0 = 1.2733762 P_cδ0

    Source:   Eqs (5) and (6).
    Valid:    JKR; quasi-static; the jump at the fold dissipates what is left.
    Accuracy: 1.5 ulp above w, R and E*.

    >>> scene = {"work_of_adhesion": 0.05, "reduced_radius": 50e-9, "contact_modulus": 27.804e9}
    >>> round(pull_off_work(**scene) / adhesion_energy(**scene), 7)
    1.2733762
    """
    return _in_adhesion_energies(1599.390637874992, work_of_adhesion, reduced_radius, contact_modulus)


def pull_off_work_at_dead_load(
    *, work_of_adhesion: SurfaceEnergy, reduced_radius: Length, contact_modulus: Stress
) -> Energy:
    """Work to separate the spheres from P = 0 with a load that grows to P_c.

        (6/5 − (2/5)2^(−1/3)) P_cδ0 = 0.8825198 P_cδ0

    Source:   Eqs (5) and (6).
    Valid:    JKR; quasi-static up to the jump at P = −P_c.
    Accuracy: 1.5 ulp above w, R and E*.

    >>> scene = {"work_of_adhesion": 0.05, "reduced_radius": 50e-9, "contact_modulus": 27.804e9}
    >>> round(pull_off_work_at_dead_load(**scene) / adhesion_energy(**scene), 7)
    0.8825198
    """
    return _in_adhesion_energies(532.4241697888572, work_of_adhesion, reduced_radius, contact_modulus)


def sticking_energy(*, work_of_adhesion: SurfaceEnergy, reduced_radius: Length, contact_modulus: Stress) -> Energy:
    """Largest energy of a head-on collision after which the spheres stick: what jump-in and the fold dissipate.

        ((2/15)6^(−1/3) + (4/5)(2/3)^(1/3)) P_cδ0 = 0.7722405 P_cδ0

    Source:   Eqs (5) and (6); text below Eq (48) has P_cδ0 as its order of magnitude.
    Valid:    JKR; no other loss.
    Accuracy: 1.5 ulp above w, R and E*.

    >>> scene = {"work_of_adhesion": 0.05, "reduced_radius": 50e-9, "contact_modulus": 27.804e9}
    >>> round(sticking_energy(**scene) / adhesion_energy(**scene), 7)
    0.7722405
    """
    return _in_adhesion_energies(356.73209358051355, work_of_adhesion, reduced_radius, contact_modulus)


def _in_adhesion_energies(cube: float, work_of_adhesion: Any, reduced_radius: Any, contact_modulus: Any) -> Any:
    """A multiple of P_cδ0, with 81π⁵/32 times its cube given: under the root, what rounding takes counts a third."""
    w, R, E = work_of_adhesion, reduced_radius, contact_modulus  # noqa: N806
    return cbrt(cube * product(w, w, w, w, w, over=(E, E)) * product(R, R, R, R))
