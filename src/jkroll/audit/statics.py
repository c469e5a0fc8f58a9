"""Sect. 5.1, Eqs 26-30: forces, angles and chains, with what the text says of sizes."""

from dataclasses import replace
from math import pi, sin, sqrt
from typing import Final

from .check import Check
from .pair import Pair, pair, silicate, twins
from .quadrature import root

STATICS: Final = (
    Check(
        "25 text",
        "|P| < P_c: â^(3/2) 0.5 ... 1.2",
        "holds",
        "(5), solved",
        printed=lambda: (0.5, 1.2),
        follows=lambda: (_factor_at(-1.0), _factor_at(1.0)),
        within=0.05 / 1.2,
    ),
    Check(
        "26",
        "Q = 6πγξ",
        "holds",
        "virtual work and (25)",
        printed=lambda: 6 * pi * twins.gamma * twins.xi,
        follows=lambda: 4 * twins.pull_off * twins.xi / twins.lever,
    ),
    Check(
        "27",
        "Q/P_c = 4ξ/R1",
        "holds",
        "virtual work and (25)",
        printed=lambda: 4 * pair.xi / pair.r1,
        follows=lambda: 4 * pair.xi / pair.lever,
    ),
    Check(
        "27 text",
        "Q = P_c for radii of 1 nm",
        "approximate",
        "at 4ξ = 0.8 nm",
        printed=lambda: 1e-9,
        follows=lambda: root(lambda radius: radius - 4 * silicate.xi, 1e-10, 1e-8),
        hedge=2,
    ),
    Check(
        "Fig. 3",
        "ordinate: reduced R, for Q/P_c",
        "misprint",
        "the captions have R1",
        printed=lambda: 4 * twins.xi / twins.r,
        follows=lambda: 4 * twins.xi / twins.lever,
        restated=lambda: 4 * twins.xi / twins.r1,
    ),
    Check(
        "28",
        "R_min = R1²/ξ",
        "holds",
        "polygon, to first order",
        printed=lambda: twins.r1**2 / twins.xi,
        follows=lambda: _ring(twins),
        within=1e-3,
    ),
    Check(
        "28 text",
        "R1 = 100 nm: 50 µm, a factor 500",
        "holds",
        "polygon",
        printed=lambda: (50e-6, 500.0),
        follows=lambda: (_ring(silicate), _ring(silicate) / silicate.r1),
        within=1e-5,
    ),
    Check(
        "28 text",
        "a few thousand grains, a circle",
        "approximate",
        "πR1/ξ at 100 nm",
        printed=lambda: 3000.0,
        follows=lambda: 2 * pi / (2 * silicate.xi / silicate.r1),
        hedge=3,
    ),
    Check(
        "29",
        "M = m g R1 N²",
        "holds",
        "weights times arms, N = 17",
        printed=lambda: twins.m1 * twins.gravity * twins.r1 * 17**2,
        follows=lambda: sum(twins.m1 * twins.gravity * (2 * place + 1) * twins.r1 for place in range(17)),
    ),
    Check(
        "30",
        "N = √(9γξ/(2R1³ρg))",
        "holds",
        "(29) = (25)",
        printed=lambda: sqrt(9 * twins.gamma * twins.xi / (2 * twins.r1**3 * twins.rho * twins.gravity)),
        follows=lambda: _level_chain(twins),
    ),
    Check(
        "30 text",
        "about a thousand 100 nm spheres",
        "approximate",
        "quartz γ, ρ = 2 g/cm³",
        printed=lambda: 1000.0,
        follows=lambda: _level_chain(silicate),
        hedge=2,
    ),
    Check(
        "30 text",
        "above about 100 µm not even one",
        "wrong",
        "8 µm (PS) to 52 µm (iron)",
        printed=lambda: (100e-6, 100e-6),
        follows=lambda: (_single_grain(0.012), _single_grain(3.0)),
        hedge=2,
    ),
)


def _factor_at(load_ratio: float) -> float:
    """The stable â^(3/2) at a load, by (5)."""
    return root(lambda x: 4 * (x**2 - x) - load_ratio, 0.5, 10)


def _ring(of: Pair) -> float:
    """Radius of the polygon of centres in which every contact, on both of its spheres, is off by ξ."""
    return of.r1 / sin(of.xi / of.r1)


def _level_chain(of: Pair) -> float:
    """The number of spheres at which the moment of their weight is the largest that the contact bears."""
    return sqrt(4 * of.p_c * of.xi / (of.m1 * of.gravity * of.r1))


def _single_grain(gamma: float) -> float:
    """The radius at which that number is 1."""
    return root(lambda radius: _level_chain(replace(silicate, r1=radius, r2=radius, gamma=gamma)) - 1, 1e-7, 1e-3)
