"""Sects. 5.2.2 and 6, Eqs 43-49: rolling after a collision; the conclusions; Table 1."""

from math import cos, pi, sin, sqrt

from .check import Check
from .pair import Pair, pair
from .quadrature import integral, root
from .statics import factor_at

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
