"""Sects. 5.2.1, 5.2.2 and 6, Eqs 31-49: vibrations, rolling after a collision, the conclusions, and Table 1.

The restoring force of a vibration is minus the slope of an energy.
"""

from math import cos, pi, sin, sqrt

from .checks import Check, integral, nearest, root, slope
from .pair import Pair, factor_at, pair, reference, twins


def vibrations() -> tuple[Check, ...]:
    """Evaluate the claims on vibrations."""
    force, stiffness, restoring = _slope(pair), _stiffness(pair), _restoring(pair)
    couple = 4 * pair.p_c * pair.xi
    z_ratio = _vertical(reference()) / _free_rolling(reference())
    eq_36 = (
        (2 * twins.e / 1e10) ** (1 / 3)
        * (twins.gamma / 0.1) ** (1 / 6)
        * (1e-7 / twins.r1) ** (7 / 6)
        * (2000 / twins.rho) ** 0.5
    )
    eq_40 = sqrt(4 * twins.p_c * twins.r / twins.i) / (2 * pi)
    return (
        Check("31-33", "dv/dt = P/m1, −P/m2; δ: P/m", "sign", "−dU/dδ of its energy",
              printed=(pair.p / pair.m1, -pair.p / pair.m2, pair.p / pair.m),
              follows=(-force / pair.m1, force / pair.m2, -force / pair.m)),
        Check("34", "d²δ/dt² ≈ (6/5)(E*a0/m)(δ − δ0)", "sign", "−dP/dδ by (5), (6)",
              printed=6 / 5 * pair.e * pair.a0 / pair.m, follows=-stiffness / pair.m),
        Check("35", "Ω_z = (1/2π)√(6E*a0/(5m))", "holds", "dP/dδ by (5), (6); in Hz",
              printed=sqrt(6 / 5 * pair.e * pair.a0 / pair.m) / (2 * pi), follows=_vertical(pair)),
        Check("36", "Ω_z ≈ 6.38e8 Hz, and its powers", "holds", "(35), to the digits printed",
              printed=6.38e8 * eq_36, follows=_vertical(twins), within=0.005 / 6.38),
        Check("37-39", "I dω/dt = M, −M; δ_α: 4P_cR δ_α", "sign", "−dU/dδ_α of its energy",
              printed=(couple / pair.i1, -couple / pair.i2, 4 * pair.p_c * pair.r * (pair.xi / pair.r) / pair.i),
              follows=(restoring / pair.i1, -restoring / pair.i2, restoring / pair.i)),
        Check("40", "Ω_roll = (1/2π)√(4P_cR/I)", "holds", "free spheres, no slip",
              printed=eq_40, follows=_free_rolling(twins)),
        Check("40", "the same for unequal spheres", "approximate", "their centres move as well",
              printed=sqrt(4 * pair.p_c * pair.r / pair.i) / (2 * pi), follows=_free_rolling(pair), hedge=2),
        Check("41", "Ω_roll = (3/2π)√(γ/(5R1³ρ))", "wrong", "(40) gives 2.5 times that",
              printed=3 / (2 * pi) * sqrt(twins.gamma / (5 * twins.r1**3 * twins.rho)), follows=eq_40),
        Check("42", "Ω_roll ≈ 4.77e7 Hz, its powers", "wrong", "as (41)",
              printed=4.77e7 * (twins.gamma / 0.1 * (1e-7 / twins.r1) ** 3 * 2000 / twins.rho) ** 0.5,
              follows=eq_40, within=0.005 / 4.77),
        Check("42 text", "Ω_z/Ω_roll of 10 to 100", "approximate", "5 by (40); 13.4 by (41)",
              printed=nearest(z_ratio, 10, 100), follows=z_ratio, hedge=2),
    )  # fmt: skip


def _slope(of: Pair) -> float:
    """Return dU/dδ, from the area U under (5) over (6), in y = √â."""

    def energy(y: complex) -> complex:
        return of.p_c * of.delta0 * (24 / 5 * y**10 - 8 * y**7 + 2 * y**4)

    return slope(energy, of.stretch**0.5) / slope(lambda y: of.delta0 * (3 * y**4 - 2 * y), of.stretch**0.5)


def _stiffness(of: Pair) -> float:
    """Return dP/dδ at P = 0, from (5) and (6), in y = √â."""
    return of.p_c / of.delta0 * slope(lambda y: 4 * (y**6 - y**3), 1) / slope(lambda y: 3 * y**4 - 2 * y, 1)


def _vertical(of: Pair) -> float:
    """Return the frequency of vibration along the line of centres."""
    return sqrt(_stiffness(of) / of.m) / (2 * pi)


def _restoring(of: Pair) -> float:
    """Return −dU/dδ_α of the elastic energy 2P_cξ² R/R, with ξ = Rδ_α."""
    return -slope(lambda angle: 2 * of.p_c * of.r * angle**2, of.xi / of.r)


def _free_rolling(of: Pair) -> float:
    """Return the frequency of ½ m v² + ½ (4P_c/R)ξ², where v is the rate of ξ."""
    return sqrt(4 * of.p_c / of.r / of.rolling_mass) / (2 * pi)


# --- Collisions -------------------------------------------------------------------------------------------------------

QUARTZ = (25.0, 5.4e10, 0.17, 2.6)  # its row of Table 1; the heading "ν" stands over the second


def collisions() -> tuple[Check, ...]:
    """Evaluate the claims on collisions, the conclusions and Table 1."""
    mean, stiffer = 2 * pair.p_c * pair.xi, Pair(e=2 * pair.e)
    rolling = _kinetic_energy(pair, pair.r1, 1.0)  # over ω1²
    eq_48 = pair.energy / (14 * pi * pair.p_c * pair.xi)
    eq_49 = 3 / (14 * (9 * pi) ** (1 / 3)) * (pair.gamma / pair.e) ** (2 / 3) * pair.r ** (1 / 3) / pair.xi
    lost = -integral(lambda y: 4 * (y**6 - y**3) * (12 * y**3 - 2), 6 ** (-1 / 3), (2 / 3) ** (1 / 3))
    return (
        Check("43", "⟨M⟩ ≈ 2P_c ξ", "holds", "mean of (25), steps reset",
              printed=mean, follows=integral(lambda xi: 4 * pair.p_c * xi, 0, pair.xi) / pair.xi),
        Check("44", "⟨Q⟩ ≈ 2P_c ξ/R", "wrong", "R should be R1, as in (26)",
              printed=mean / pair.r, follows=mean / pair.lever),
        Check("45", "W0 = ½m1v1² + ½I1ω1²", "holds", "integrated over the sphere",
              printed=0.5 * pair.m1 * 0.7**2 + 0.5 * pair.i1 * 1.1**2, follows=_kinetic_energy(pair, 0.7, 1.1)),
        Check("46", "ω(0) = √((4/7)W0/I1)", "holds", "(45) with v1 = ω1R1",
              printed=sqrt(4 / 7 * pair.energy / pair.i1), follows=sqrt(pair.energy / rolling)),
        Check("47", "dω1/dt = −M/I1", "wrong", "friction too: I1 + m1R1²",
              printed=-mean / pair.i1, follows=-mean / (2 * rolling)),
        Check("48", "n = W0/(14πP_c ξ)", "holds", "by (46) and (47)",
              printed=eq_48, follows=4 / 7 * pair.energy / (2 * mean) / (2 * pi)),
        Check("48", "the same, by the energy balance", "wrong", "2πn⟨M⟩ = W0 gives 7/2 of it",
              printed=eq_48, follows=pair.energy / (2 * pi * mean)),
        Check("48 text", "P_c δ0 is about what sticks", "approximate", "loss, jump-in to fold",
              printed=1.0, follows=lost, hedge=3),
        Check("49", "n = 3(γ/E*)^(2/3)∛R/(14∛(9π)ξ)", "holds", "(48) at W0 = P_c δ0",
              printed=eq_49, follows=pair.p_c * pair.delta0 / (14 * pi * pair.p_c * pair.xi)),
        Check("49", "the same, by the energy balance", "wrong", "7/2 of it",
              printed=eq_49, follows=pair.p_c * pair.delta0 / (2 * pi * mean)),
        Check("Fig. 7", "until all energy is dissipated", "wrong", "n of (48) dissipates 2/7",
              printed=1.0, follows=2 * pi * mean / (14 * pi * pair.p_c * pair.xi)),
        Check("Sect. 6", "loaded, M varies weakly with E", "wrong", "at fixed δ only; E doubled",
              printed=_factor_at_approach(pair.delta / stiffer.delta0) / pair.x,
              follows=factor_at(pair.p / stiffer.p_c) / pair.x),
        Check("Table 1", "quartz: ν = 5.4(10) by its head", "misprint", "scrambled in the copy",
              printed=QUARTZ[1], restated=QUARTZ[2],
              follows=sum(value for value in QUARTZ if -1 <= value <= 0.5)),  # the one that can be a Poisson's ratio
    )  # fmt: skip


def _kinetic_energy(of: Pair, speed: float, spin: float) -> float:
    """Return ½|v + ω × r|² integrated over a homogeneous sphere, shell by shell about the axis of spin."""

    def shell(angle: float) -> float:
        distance, height = of.r1 * sin(angle), of.r1 * cos(angle)
        return 2 * pi * of.rho * distance * (speed**2 + (spin * distance) ** 2) * height * height

    return integral(shell, 0, pi / 2)


def _factor_at_approach(approach_ratio: float) -> float:
    """Return the stable â^(3/2) at an approach, by (6)."""
    return root(lambda y: 3 * y**4 - 2 * y - approach_ratio, 6 ** (-1 / 3), 10) ** 3
