"""Sects. 2 to 4, Eqs 1-25: the contact, and the moment of a shifted one."""

from math import cos, pi, sqrt
from typing import Final

from .check import Check
from .pair import pair, plane
from .quadrature import first_order, integral, to_rim

R_INSIDE: Final = 0.37 * pair.a  # a distance from the centre
A_HALF: Final = 1.09 * pair.a  # radius of one half-circle
P_H: Final = 2 * pair.a * pair.e / (pi * pair.r)
P_B: Final = pair.e * pair.delta / (pi * pair.a) - P_H / 2


def moment() -> tuple[Check, ...]:
    """Evaluate the claims on the contact and its moment."""
    return (*_contact(), *_pressure(), *_half_circles())


def _contact() -> tuple[Check, ...]:
    return (
        Check("1", "P_c = 3πγR", "holds", "largest tension by Griffith",
              printed=pair.p_c, follows=pair.pull_off),
        Check("1 text", "very hard spheres: 4πγR", "holds", "attraction over a rigid gap",
              printed=4 * pi * pair.gamma * pair.r, follows=_rigid_pull_off()),
        Check("2", "a0 = (9πγR²/E*)^(1/3)", "holds", "circle that bears no load",
              printed=pair.a0, follows=pair.free_radius),
        Check("2 text", "γ = γ1 + γ2 − 2γ12", "wrong", "w where γ12 = 0; γ = w/2",
              printed=pair.gamma + pair.gamma - 2 * 0, follows=(pair.gamma + pair.gamma - 0) / 2),
        Check("3", "δ0 = P_c/(E*a0)", "holds", "depth of the unloaded dent",
              printed=pair.delta0, follows=pair.approach_of(pair.free_radius)),
        Check("4, 5", "P/P_c = 4(â³ − â^(3/2))", "holds", "pressure, integrated",
              printed=4 * (pair.stretch**3 - pair.stretch**1.5), follows=pair.load_of(pair.a) / pair.pull_off),
        Check("6", "δ/δ0 = 3â² − 2â^(1/2)", "holds", "depth of the dent",
              printed=3 * pair.stretch**2 - 2 * pair.stretch**0.5,
              follows=pair.approach_of(pair.a) / pair.approach_of(pair.free_radius)),
    )  # fmt: skip


def _pressure() -> tuple[Check, ...]:
    rim = 1 - (R_INSIDE / pair.a) ** 2
    return (
        Check("7", "p_H(1 − r²/a²) + p_B/(1 − r²/a²)", "misprint", "lost in the copy; see (12)",
              printed=P_H * rim + P_B / rim, follows=pair.pressure(R_INSIDE, pair.a),
              restated=P_H * sqrt(rim) + P_B / sqrt(rim)),
        Check("8", "p_H = 6P_c â/(πa0²)", "holds", "2aE*/(πR)",
              printed=6 * pair.p_c / (pi * pair.a0**2) * pair.stretch, follows=pair.hertz(pair.a)),
        Check("9", "p_B = −2P_c â^(−1/2)/(πa0²)", "holds", "Griffith, K²/(2E*) = 2γ",
              printed=-2 * pair.p_c / (pi * pair.a0**2) / sqrt(pair.stretch), follows=pair.griffith(pair.a)),
        Check("10", "M = Q R, sphere on a plane", "holds", "virtual work",
              printed=plane.r, follows=plane.lever),
        Check("10 text", "two spheres: M = Q R, R reduced", "wrong", "the lever arm is R1",
              printed=pair.r, follows=pair.lever),
        Check("11", "M = 0 if p(x) = p(−x)", "holds", "halves cancel: their ratio",
              printed=-1.0, follows=_sector_moment(pi / 2) / _sector_moment(-pi / 2)),
        Check("12-15", "p(r, a, δ) dents to δ − r²/(2R)", "holds", "half-space, chord by chord",
              printed=pair.delta - R_INSIDE**2 / (2 * pair.r),
              follows=pair.depth(_pressure_at, 0.6 * R_INSIDE, 0.8 * R_INSIDE)),
        Check("13", "δ = (πa/2E*)(p_H + 2p_B)", "holds", "depth of the dent",
              printed=pi * pair.a / (2 * pair.e) * (pair.hertz(pair.a) + 2 * pair.griffith(pair.a)),
              follows=pair.approach_of(pair.a)),
    )  # fmt: skip


def _half_circles() -> tuple[Check, ...]:
    p_h, punch, half = pair.hertz(A_HALF), pair.e * pair.delta / (pi * A_HALF), pair.half_moment(A_HALF)
    eq_22 = pair.e * A_HALF**2 * pair.delta / 2 - pi / 8 * p_h * A_HALF**3
    eq_24 = 2 * (-pair.e * pair.a * pair.delta + 3 * pair.p_c * pair.stretch**3)  # over ξ
    eq_25 = 4 * pair.p_c * pair.stretch**1.5
    return (
        Check("16-20", "M = M½(a − ξ) − M½(a + ξ)", "holds", "(17), over r and angle",
              printed=pair.halves_moment(pair.xi),
              follows=_half_disc(pair.a + pair.xi, pi / 2) + _half_disc(pair.a - pair.xi, -pi / 2)),
        Check("21", "M½ = 2{p_H π𝒜³/16 + [...]𝒜³/4}", "misprint", "lost in the copy; see (22)",
              printed=2 * (p_h * pi / 16 * A_HALF**3 + (punch - p_h / 2) * A_HALF**3 / 4), follows=half,
              restated=eq_22),
        Check("22", "M½ = ½E*𝒜²δ − (π/8)p_H𝒜³", "holds", "(20), integrated",
              printed=eq_22, follows=half),
        Check("23", "M½ = ½E*δ𝒜² − (3/4)P_c𝒜⁴/a0³", "holds", "(20), integrated",
              printed=pair.e / 2 * pair.delta * A_HALF**2 - 3 / 4 * pair.p_c * A_HALF**4 / pair.a0**3, follows=half),
        Check("24", "M ≈ 2ξ(−E*aδ + 3P_c â³)", "holds", "(19) to first order in ξ",
              printed=eq_24, follows=first_order(pair.halves_moment, pair.xi)),
        Check("24", "the same for a finite shift", "approximate", "exact circle at fixed δ",
              printed=eq_24 * pair.xi, follows=pair.moment_at_approach(pair.delta), hedge=1.1),
        Check("25", "M = 4P_c â^(3/2) ξ, half-circles", "holds", "(19) to first order, (6)",
              printed=eq_25, follows=first_order(pair.halves_moment, pair.xi)),
        Check("25", "the same, one shifted circle", "holds", "exact in 3-D at fixed P",
              printed=eq_25 * pair.xi, follows=pair.moment_at_load),
        Check("25", "the dent of that circle", "holds", "half-space, chord by chord",
              printed=pair.delta - ((R_INSIDE - pair.xi) ** 2 + (R_INSIDE / 2) ** 2) / (2 * pair.r),
              follows=pair.depth(_shifted_pressure_at, R_INSIDE, R_INSIDE / 2)),
    )  # fmt: skip


def _rigid_pull_off() -> float:
    """Return the attraction 4γ(1 − h) up to a gap of 1, which is 2γ in all, summed over the gap h = r²/(2R)."""
    return integral(lambda r: 2 * pi * r * 4 * pair.gamma * (1 - r**2 / (2 * pair.r)), 0, sqrt(2 * pair.r))


def _pressure_at(x: float, y: float) -> float:
    """Return the pressure of Eq (12)."""
    depth = sqrt(1 - (x * x + y * y) / pair.a**2)
    return P_H * depth + P_B / depth


def _shifted_pressure_at(x: float, y: float) -> float:
    return pair.shifted_pressure(x, y, pair.delta)


def _sector_moment(start: float) -> float:
    """Return the moment of the symmetric pressure over half of the circle, from an angle on."""
    around = integral(cos, start, start + pi)
    return around * to_rim(lambda r: r * r * pair.pressure(r, pair.a), pair.a)


def _half_disc(a: float, start: float) -> float:
    """Return the moment of the pressure (15) over half of a circle, by Eq (17)."""
    return integral(
        lambda angle: to_rim(lambda r: r * cos(angle) * pair.pressure_at_approach(r, a) * r, a), start, start + pi
    )
