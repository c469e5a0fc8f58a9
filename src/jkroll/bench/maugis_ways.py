"""Ways to the state of a contact between JKR and DMT: either limit, and a published fit."""

# ruff: noqa: N803, N806  (the paper's symbols)

from collections.abc import Callable, Mapping
from typing import Any

from numpy import cbrt, exp, pi, sqrt

from ..physics.jkr_to_dmt import TRANSITION_OVER_TABOR


def _reduced(R1: Any, R2: Any) -> Any:
    return R1 * R2 / (R1 + R2)


def _margin(R1: Any, R2: Any, w: Any, P: Any) -> Any:
    """Return √((P + P_c)/P_c) of JKR."""
    pull_off = 3 * pi * w / 2 * _reduced(R1, R2)
    return sqrt((P + pull_off) / pull_off)


def _unloaded_radius(R1: Any, R2: Any, w: Any, E: Any) -> Any:
    """Return JKR's radius without load."""
    return cbrt(9 * pi * w / 2 * _reduced(R1, R2) ** 2 / E)


def _radius_by_jkr(R1: Any, R2: Any, w: Any, E: Any, P: Any) -> Any:
    return _unloaded_radius(R1, R2, w, E) * cbrt(((1 + _margin(R1, R2, w, P)) / 2) ** 2)


def _approach_by_jkr(R1: Any, R2: Any, w: Any, E: Any, P: Any) -> Any:
    x = (1 + _margin(R1, R2, w, P)) / 2
    return _unloaded_radius(R1, R2, w, E) ** 2 / (3 * _reduced(R1, R2)) * cbrt(x) * (3 * x - 2)


def _stiffness_by_jkr(R1: Any, R2: Any, w: Any, E: Any, P: Any) -> Any:
    s = _margin(R1, R2, w, P)
    return 6 * E * _radius_by_jkr(R1, R2, w, E, P) * s / (2 + 3 * s)


def _radius_by_dmt(R1: Any, R2: Any, w: Any, E: Any, P: Any) -> Any:
    R = _reduced(R1, R2)
    return cbrt(3 / 4 * R / E * (P + 2 * pi * w * R))


def _radius_by_cos(R1: Any, R2: Any, w: Any, E: Any, z0: Any, P: Any) -> Any:
    """Return the fit of Carpick, Ogletree & Salmeron (J. Colloid Interface Sci. 211, 395, 1999).

    The coefficients are those of the code woodem/woo, pkg/dem/Hertz.cpp, which cites Eqs (7), (10), (12a) and (12b) of the article.
    """
    R = _reduced(R1, R2)
    transition = TRANSITION_OVER_TABOR * cbrt(R * (w / E) ** 2) / z0
    alpha = (1 - exp(-transition / 0.924)) / 1.02
    power, power_of_radius = 4.04 * transition**1.4, 2.28 * transition**1.3
    pull_off = pi * w * R * (7 / 4 - (power - 1) / (power + 1) / 4)
    unloaded = 1.54 + 0.279 * (power_of_radius - 1) / (power_of_radius + 1)
    spread = (alpha + sqrt(1 + P / pull_off)) / (1 + alpha)
    return unloaded * cbrt(3 / 4 * pi * w * R**2 / E * spread**2)


WAYS_OF_MAUGIS: Mapping[str, Mapping[str, Callable[..., Any]]] = {
    "contact_radius_maugis": {
        "JKR": _radius_by_jkr,
        "DMT": _radius_by_dmt,
        "COS 1999": _radius_by_cos,
    },
    "approach_maugis": {
        "JKR": _approach_by_jkr,
        "DMT": lambda R1, R2, w, E, P: _radius_by_dmt(R1, R2, w, E, P) ** 2 / _reduced(R1, R2),
    },
    "stiffness_maugis": {
        "JKR": _stiffness_by_jkr,
        "DMT": lambda R1, R2, w, E, P: 2 * E * _radius_by_dmt(R1, R2, w, E, P),
    },
}
