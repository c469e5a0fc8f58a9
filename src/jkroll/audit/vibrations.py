"""Sect. 5.2.1, Eqs 31-42: vibrations. What pushes back is the slope of an energy, with a minus sign."""

from math import pi, sqrt
from typing import Final

from .check import Check
from .pair import Pair, pair, reference, twins
from .quadrature import nearest, slope

VIBRATIONS: Final = (
    Check(
        "31-33",
        "dv/dt = P/m1, −P/m2; δ: P/m",
        "sign",
        "−dU/dδ of its energy",
        printed=lambda: (pair.p / pair.m1, -pair.p / pair.m2, pair.p / pair.m),
        follows=lambda: (-_slope(pair) / pair.m1, _slope(pair) / pair.m2, -_slope(pair) / pair.m),
    ),
    Check(
        "34",
        "d²δ/dt² ≈ (6/5)(E*a0/m)(δ − δ0)",
        "sign",
        "−dP/dδ by (5), (6)",
        printed=lambda: 6 / 5 * pair.e * pair.a0 / pair.m,
        follows=lambda: -_stiffness(pair) / pair.m,
    ),
    Check(
        "35",
        "Ω_z = (1/2π)√(6E*a0/(5m))",
        "holds",
        "dP/dδ by (5), (6); in Hz",
        printed=lambda: sqrt(6 / 5 * pair.e * pair.a0 / pair.m) / (2 * pi),
        follows=lambda: sqrt(_stiffness(pair) / pair.m) / (2 * pi),
    ),
    Check(
        "36",
        "Ω_z ≈ 6.38e8 Hz, and its powers",
        "holds",
        "(35), to the digits printed",
        printed=lambda: (
            6.38e8
            * (2 * twins.e / 1e10) ** (1 / 3)
            * (twins.gamma / 0.1) ** (1 / 6)
            * (1e-7 / twins.r1) ** (7 / 6)
            * (2000 / twins.rho) ** 0.5
        ),
        follows=lambda: sqrt(_stiffness(twins) / twins.m) / (2 * pi),
        within=0.005 / 6.38,
    ),
    Check(
        "37-39",
        "I dω/dt = M, −M; δ_α: 4P_cR δ_α",
        "sign",
        "−dU/dδ_α of its energy",
        printed=lambda: (
            _couple(pair) / pair.i1,
            -_couple(pair) / pair.i2,
            4 * pair.p_c * pair.r * _angle(pair) / pair.i,
        ),
        follows=lambda: (_restoring(pair) / pair.i1, -_restoring(pair) / pair.i2, _restoring(pair) / pair.i),
    ),
    Check(
        "40",
        "Ω_roll = (1/2π)√(4P_cR/I)",
        "holds",
        "free spheres, no slip",
        printed=lambda: sqrt(4 * twins.p_c * twins.r / twins.i) / (2 * pi),
        follows=lambda: _free_rolling(twins),
    ),
    Check(
        "40",
        "the same for unequal spheres",
        "approximate",
        "their centres move as well",
        printed=lambda: sqrt(4 * pair.p_c * pair.r / pair.i) / (2 * pi),
        follows=lambda: _free_rolling(pair),
        hedge=2,
    ),
    Check(
        "41",
        "Ω_roll = (3/2π)√(γ/(5R1³ρ))",
        "wrong",
        "(40) gives 2.5 times that",
        printed=lambda: 3 / (2 * pi) * sqrt(twins.gamma / (5 * twins.r1**3 * twins.rho)),
        follows=lambda: sqrt(4 * twins.p_c * twins.r / twins.i) / (2 * pi),
    ),
    Check(
        "42",
        "Ω_roll ≈ 4.77e7 Hz, its powers",
        "wrong",
        "as (41)",
        printed=lambda: 4.77e7 * (twins.gamma / 0.1 * (1e-7 / twins.r1) ** 3 * 2000 / twins.rho) ** 0.5,
        follows=lambda: sqrt(4 * twins.p_c * twins.r / twins.i) / (2 * pi),
        within=0.005 / 4.77,
    ),
    Check(
        "42 text",
        "Ω_z/Ω_roll of 10 to 100",
        "wrong",
        "by (40); 13.4 by (41)",
        printed=lambda: nearest(_frequency_ratio(reference), 10, 100),
        follows=lambda: _frequency_ratio(reference),
    ),
)


def _slope(of: Pair) -> float:
    """dU/dδ, from the area U under (5) over (6), in y = √â."""

    def energy(y: complex) -> complex:
        return of.p_c * of.delta0 * (24 / 5 * y**10 - 8 * y**7 + 2 * y**4)

    return slope(energy, of.stretch**0.5) / slope(lambda y: of.delta0 * (3 * y**4 - 2 * y), of.stretch**0.5)


def _stiffness(of: Pair) -> float:
    """dP/dδ at P = 0, from (5) and (6), in y = √â."""
    return of.p_c / of.delta0 * slope(lambda y: 4 * (y**6 - y**3), 1) / slope(lambda y: 3 * y**4 - 2 * y, 1)


def _angle(of: Pair) -> float:
    return of.xi / of.r


def _couple(of: Pair) -> float:
    return 4 * of.p_c * of.xi


def _restoring(of: Pair) -> float:
    """−dU/dδ_α of the elastic energy 2P_cξ² R/R, with ξ = Rδ_α."""
    return -slope(lambda angle: 2 * of.p_c * of.r * angle**2, _angle(of))


def _free_rolling(of: Pair) -> float:
    """Frequency of ½ m v² + ½ (4P_c/R)ξ², v the rate of ξ."""
    return sqrt(4 * of.p_c / of.r / of.rolling_mass) / (2 * pi)


def _frequency_ratio(of: Pair) -> float:
    return sqrt(_stiffness(of) / of.m) / (2 * pi) / _free_rolling(of)
