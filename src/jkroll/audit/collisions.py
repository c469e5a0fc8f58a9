"""Sects. 5.2.2 and 6, Eqs 43-49: how far a sphere rolls; the conclusions; Table 1."""

from math import cos, pi, sin, sqrt
from typing import Final

from .check import Check
from .pair import Pair, pair
from .quadrature import integral, root

QUARTZ: Final = (25.0, 5.4e10, 0.17, 2.6)  # its row of Table 1; the heading "ν" stands over the second
stiffer: Final = Pair(e=2 * pair.e)

COLLISIONS: Final = (
    Check(
        "43",
        "⟨M⟩ ≈ 2P_c ξ",
        "holds",
        "mean of (25), steps reset",
        printed=lambda: 2 * pair.p_c * pair.xi,
        follows=lambda: integral(lambda xi: 4 * pair.p_c * xi, 0, pair.xi) / pair.xi,
    ),
    Check(
        "44",
        "⟨Q⟩ ≈ 2P_c ξ/R",
        "wrong",
        "R should be R1, as in (26)",
        printed=lambda: 2 * pair.p_c * pair.xi / pair.r,
        follows=lambda: 2 * pair.p_c * pair.xi / pair.lever,
    ),
    Check(
        "45",
        "W0 = ½m1v1² + ½I1ω1²",
        "holds",
        "integrated over the sphere",
        printed=lambda: 0.5 * pair.m1 * 0.7**2 + 0.5 * pair.i1 * 1.1**2,
        follows=lambda: _kinetic_energy(pair, 0.7, 1.1),
    ),
    Check(
        "46",
        "ω(0) = √((4/7)W0/I1)",
        "holds",
        "(45) with v1 = ω1R1",
        printed=lambda: sqrt(4 / 7 * pair.energy / pair.i1),
        follows=lambda: sqrt(pair.energy / _kinetic_energy(pair, pair.r1, 1.0)),
    ),
    Check(
        "47",
        "dω1/dt = −M/I1",
        "wrong",
        "friction too: I1 + m1R1²",
        printed=lambda: -_mean_moment(pair) / pair.i1,
        follows=lambda: -_mean_moment(pair) / (2 * _kinetic_energy(pair, pair.r1, 1.0)),
    ),
    Check(
        "48",
        "n = W0/(14πP_c ξ)",
        "holds",
        "by (46) and (47)",
        printed=lambda: pair.energy / (14 * pi * pair.p_c * pair.xi),
        follows=lambda: 4 / 7 * pair.energy / (2 * _mean_moment(pair)) / (2 * pi),
    ),
    Check(
        "48",
        "the same, by the energy balance",
        "wrong",
        "2πn⟨M⟩ = W0 gives 7/2 of it",
        printed=lambda: pair.energy / (14 * pi * pair.p_c * pair.xi),
        follows=lambda: pair.energy / (2 * pi * _mean_moment(pair)),
    ),
    Check(
        "48 text",
        "P_c δ0 is about what sticks",
        "approximate",
        "loss, jump-in to fold",
        printed=lambda: 1.0,
        follows=lambda: -integral(lambda y: 4 * (y**6 - y**3) * (12 * y**3 - 2), 6 ** (-1 / 3), (2 / 3) ** (1 / 3)),
        hedge=3,
    ),
    Check(
        "49",
        "n = 3(γ/E*)^(2/3)∛R/(14∛(9π)ξ)",
        "holds",
        "(48) at W0 = P_c δ0",
        printed=lambda: 3 / (14 * (9 * pi) ** (1 / 3)) * (pair.gamma / pair.e) ** (2 / 3) * pair.r ** (1 / 3) / pair.xi,
        follows=lambda: pair.p_c * pair.delta0 / (14 * pi * pair.p_c * pair.xi),
    ),
    Check(
        "49",
        "the same, by the energy balance",
        "wrong",
        "7/2 of it",
        printed=lambda: 3 / (14 * (9 * pi) ** (1 / 3)) * (pair.gamma / pair.e) ** (2 / 3) * pair.r ** (1 / 3) / pair.xi,
        follows=lambda: pair.p_c * pair.delta0 / (2 * pi * _mean_moment(pair)),
    ),
    Check(
        "Fig. 7",
        "until all energy is dissipated",
        "wrong",
        "n of (48) dissipates 2/7",
        printed=lambda: 1.0,
        follows=lambda: 2 * pi * _mean_moment(pair) / (14 * pi * pair.p_c * pair.xi),
    ),
    Check(
        "Sect. 6",
        "loaded, M varies weakly with E",
        "wrong",
        "at fixed δ only; E doubled",
        printed=lambda: _factor_at_approach(pair.delta / stiffer.delta0) / pair.x,
        follows=lambda: _factor_at(pair.p / stiffer.p_c) / pair.x,
    ),
    Check(
        "Table 1",
        "quartz: ν = 5.4(10) by its head",
        "misprint",
        "the units are right",
        printed=lambda: QUARTZ[1],
        follows=lambda: sum(value for value in QUARTZ if -1 <= value <= 0.5),  # the one that can be a Poisson's ratio
        restated=lambda: QUARTZ[2],
    ),
)


def _mean_moment(of: Pair) -> float:
    return 2 * of.p_c * of.xi


def _kinetic_energy(of: Pair, speed: float, spin: float) -> float:
    """½|v + ω × r|² over a homogeneous sphere, shell by shell about the axis of spin."""

    def shell(angle: float) -> float:
        distance, height = of.r1 * sin(angle), of.r1 * cos(angle)
        return 2 * pi * of.rho * distance * (speed**2 + (spin * distance) ** 2) * height * height

    return integral(shell, 0, pi / 2)


def _factor_at(load_ratio: float) -> float:
    """The stable â^(3/2) at a load, by (5)."""
    return root(lambda x: 4 * (x**2 - x) - load_ratio, 0.5, 10)


def _factor_at_approach(approach_ratio: float) -> float:
    """The stable â^(3/2) at an approach, by (6)."""
    return root(lambda y: 3 * y**4 - 2 * y - approach_ratio, 6 ** (-1 / 3), 10) ** 3
