"""Sect. 5.1, Eqs 26-30: forces, angles and chains, and the sizes that the text gives."""

from math import pi, sin, sqrt

from .check import Check
from .pair import Pair, pair, reference, twins
from .quadrature import root

SILICATE, POLYSTYRENE, IRON = 0.025, 0.012, 3.0  # γ in J/m²


def statics() -> tuple[Check, ...]:
    """Evaluate the claims on forces, angles and chains."""
    silicate = reference(gamma=SILICATE)
    return (
        Check("25 text", "|P| < P_c: â^(3/2) 0.5 ... 1.2", "holds", "(5), solved",
              printed=(0.5, 1.2), follows=(factor_at(-1.0), factor_at(1.0)), within=0.05 / 1.2),
        Check("26", "Q = 6πγξ", "holds", "virtual work and (25)",
              printed=6 * pi * twins.gamma * twins.xi,
              follows=4 * twins.pull_off * twins.xi / twins.lever),
        Check("27", "Q/P_c = 4ξ/R1", "holds", "virtual work and (25)",
              printed=4 * pair.xi / pair.r1, follows=4 * pair.xi / pair.lever),
        Check("27 text", "Q = P_c for radii of 1 nm", "approximate", "at 4ξ = 0.8 nm",
              printed=1e-9, follows=root(lambda radius: radius - 4 * silicate.xi, 1e-10, 1e-8), hedge=2),
        Check("Fig. 3", "ordinate: reduced R, for Q/P_c", "misprint", "the captions have R1",
              printed=4 * twins.xi / twins.r, follows=4 * twins.xi / twins.lever, restated=4 * twins.xi / twins.r1),
        Check("28", "R_min = R1²/ξ", "holds", "polygon, to first order",
              printed=twins.r1**2 / twins.xi, follows=_ring(twins), within=1e-3),
        Check("28 text", "R1 = 100 nm: 50 µm, a factor 500", "holds", "polygon",
              printed=(50e-6, 500.0), follows=(_ring(silicate), _ring(silicate) / silicate.r1), within=1e-5),
        Check("28 text", "a few thousand grains, a circle", "approximate", "πR1/ξ at 100 nm",
              printed=3000.0, follows=2 * pi / (2 * silicate.xi / silicate.r1), hedge=3),
        Check("29", "M = m g R1 N²", "holds", "weights times arms, N = 17",
              printed=twins.m1 * twins.gravity * twins.r1 * 17**2,
              follows=sum(twins.m1 * twins.gravity * (2 * place + 1) * twins.r1 for place in range(17))),
        Check("30", "N = √(9γξ/(2R1³ρg))", "holds", "(29) = (25)",
              printed=sqrt(9 * twins.gamma * twins.xi / (2 * twins.r1**3 * twins.rho * twins.gravity)),
              follows=_level_chain(twins)),
        Check("30 text", "about a thousand 100 nm spheres", "approximate", "quartz γ, ρ = 2 g/cm³",
              printed=1000.0, follows=_level_chain(silicate), hedge=2),
        Check("30 text", "above about 100 µm not even one", "approximate", "8 µm (PS) to 52 µm (iron)",
              printed=100e-6, follows=max(_single_grain(POLYSTYRENE), _single_grain(IRON)), hedge=2),
    )  # fmt: skip


def factor_at(load_ratio: float) -> float:
    """Return the stable â^(3/2) at a load, by (5)."""
    return root(lambda x: 4 * (x**2 - x) - load_ratio, 0.5, 10)


def _ring(of: Pair) -> float:
    """Return the radius of the polygon of centres in which every contact, on both of its spheres, is off by ξ."""
    return of.r1 / sin(of.xi / of.r1)


def _level_chain(of: Pair) -> float:
    """Return the number of spheres at which the moment of their weight is the largest that the contact bears."""
    return sqrt(4 * of.p_c * of.xi / (of.m1 * of.gravity * of.r1))


def _single_grain(gamma: float) -> float:
    """Return the radius at which that number is 1."""
    return root(lambda radius: _level_chain(reference(radius, gamma)) - 1, 1e-7, 1e-3)
