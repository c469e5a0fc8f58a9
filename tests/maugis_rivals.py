"""Approximations of Maugis' theory that others use: a contact radius and an approach at a load, in his units.

Carpick, Ogletree & Salmeron (J. Colloid Interface Sci. 211, 395, 1999); Piétrement & Troyon (ibid. 226, 166, 2000),
whose form for the approach reuses their α. The coefficients of the first are those of the code woodem/woo,
pkg/dem/Hertz.cpp, which cites Eqs (7), (10), (12a) and (12b) of the article; those of the second were recalled, not
copied from print. They come within 3 % of Maugis' radius and 9 % of JKR's unloaded approach, and the second give 2/3
and 1/3 at α = 1, as JKR has it.
"""

from math import exp
from typing import Any


def fitted_pull_off(transition: float) -> float:
    """Return P̄ at pull-off after Carpick, Ogletree & Salmeron."""
    power = 4.04 * transition**1.4
    return -float(7 / 4 - (power - 1) / (power + 1) / 4)


def fitted_alpha(transition: float) -> float:
    """Return their α, from λ = −0.924 ln(1 − 1.02α)."""
    return (1 - exp(-transition / 0.924)) / 1.02


def fitted_unloaded_radius(transition: float) -> float:
    """Return their Ā without load."""
    power = 2.28 * transition**1.3
    return float(1.54 + 0.279 * (power - 1) / (power + 1))


def carpick_radius(load: Any, transition: float) -> Any:
    """Return their Ā at a load P̄."""
    alpha = fitted_alpha(transition)
    spread = (alpha + (1 - load / fitted_pull_off(transition)) ** 0.5) / (1 + alpha)
    return fitted_unloaded_radius(transition) * spread ** (2 / 3)


def pietrement_approach(load: Any, transition: float) -> Any:
    """Return δ̄ at a load P̄ after Piétrement & Troyon."""
    alpha = fitted_alpha(transition)
    spread = (alpha + (1 - load / fitted_pull_off(transition)) ** 0.5) / (1 + alpha)
    share = -2.160 * alpha**0.019 + 2.753 * alpha**0.064 + 0.073 * alpha**1.919
    beta = 0.516 * alpha**4 - 0.683 * alpha**3 + 0.235 * alpha**2 + 0.429 * alpha
    return fitted_unloaded_radius(transition) ** 2 * (spread ** (4 / 3) - share * spread ** (2 * beta / 3))
