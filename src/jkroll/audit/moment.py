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


def _rigid_pull_off() -> float:
    """Attraction 4γ(1 − h) up to a gap of 1, which is 2γ in all, summed over the gap h = r²/(2R)."""
    return integral(lambda r: 2 * pi * r * 4 * pair.gamma * (1 - r**2 / (2 * pair.r)), 0, sqrt(2 * pair.r))


MOMENT: Final = (
    Check(
        "1",
        "P_c = 3πγR",
        "holds",
        "largest tension by Griffith",
        printed=lambda: pair.p_c,
        follows=lambda: pair.pull_off,
    ),
    Check(
        "1 text",
        "very hard spheres: 4πγR",
        "holds",
        "attraction over a rigid gap",
        printed=lambda: 4 * pi * pair.gamma * pair.r,
        follows=_rigid_pull_off,
    ),
    Check(
        "2",
        "a0 = (9πγR²/E*)^(1/3)",
        "holds",
        "circle that bears no load",
        printed=lambda: pair.a0,
        follows=lambda: pair.free_radius,
    ),
    Check(
        "2 text",
        "γ = γ1 + γ2 − 2γ12",
        "wrong",
        "that is w; (1) has γ = w/2",
        printed=lambda: pair.gamma + pair.gamma - 2 * 0,
        follows=lambda: (pair.gamma + pair.gamma - 0) / 2,
    ),
    Check(
        "3",
        "δ0 = P_c/(E*a0)",
        "holds",
        "depth of the unloaded dent",
        printed=lambda: pair.delta0,
        follows=lambda: pair.approach_of(pair.free_radius),
    ),
    Check(
        "4, 5",
        "P/P_c = 4(â³ − â^(3/2))",
        "holds",
        "pressure, integrated",
        printed=lambda: 4 * (pair.stretch**3 - pair.stretch**1.5),
        follows=lambda: pair.load_of(pair.a) / pair.pull_off,
    ),
    Check(
        "6",
        "δ/δ0 = 3â² − 2â^(1/2)",
        "holds",
        "depth of the dent",
        printed=lambda: 3 * pair.stretch**2 - 2 * pair.stretch**0.5,
        follows=lambda: pair.approach_of(pair.a) / pair.approach_of(pair.free_radius),
    ),
    Check(
        "7",
        "p_H(1 − r²/a²) + p_B/(1 − r²/a²)",
        "misprint",
        "roots lost; (12) has them",
        printed=lambda: P_H * (1 - (R_INSIDE / pair.a) ** 2) + P_B / (1 - (R_INSIDE / pair.a) ** 2),
        follows=lambda: pair.pressure(R_INSIDE, pair.a),
        restated=lambda: P_H * sqrt(1 - (R_INSIDE / pair.a) ** 2) + P_B / sqrt(1 - (R_INSIDE / pair.a) ** 2),
    ),
    Check(
        "8",
        "p_H = 6P_c â/(πa0²)",
        "holds",
        "2aE*/(πR)",
        printed=lambda: 6 * pair.p_c / (pi * pair.a0**2) * pair.stretch,
        follows=lambda: pair.hertz(pair.a),
    ),
    Check(
        "9",
        "p_B = −2P_c â^(−1/2)/(πa0²)",
        "holds",
        "Griffith, K²/(2E*) = 2γ",
        printed=lambda: -2 * pair.p_c / (pi * pair.a0**2) / sqrt(pair.stretch),
        follows=lambda: pair.griffith(pair.a),
    ),
    Check(
        "10",
        "M = Q R, sphere on a plane",
        "holds",
        "virtual work",
        printed=lambda: plane.r,
        follows=lambda: plane.lever,
    ),
    Check(
        "10 text",
        "two spheres: M = Q R, R reduced",
        "wrong",
        "the lever arm is R1",
        printed=lambda: pair.r,
        follows=lambda: pair.lever,
    ),
    Check(
        "11",
        "M = 0 if p(x) = p(−x)",
        "holds",
        "halves cancel: their ratio",
        printed=lambda: -1.0,
        follows=lambda: _sector_moment(pi / 2) / _sector_moment(-pi / 2),
    ),
    Check(
        "12-15",
        "p(r, a, δ) dents to δ − r²/(2R)",
        "holds",
        "half-space, chord by chord",
        printed=lambda: pair.delta - R_INSIDE**2 / (2 * pair.r),
        follows=lambda: pair.depth(
            lambda x, y: P_H * sqrt(1 - (x * x + y * y) / pair.a**2) + P_B / sqrt(1 - (x * x + y * y) / pair.a**2),
            0.6 * R_INSIDE,
            0.8 * R_INSIDE,
        ),
    ),
    Check(
        "13",
        "δ = (πa/2E*)(p_H + 2p_B)",
        "holds",
        "depth of the dent",
        printed=lambda: pi * pair.a / (2 * pair.e) * (pair.hertz(pair.a) + 2 * pair.griffith(pair.a)),
        follows=lambda: pair.approach_of(pair.a),
    ),
    Check(
        "16-20",
        "M = M½(a − ξ) − M½(a + ξ)",
        "holds",
        "(17), over r and angle",
        printed=lambda: pair.halves_moment(pair.xi),
        follows=lambda: _half_disc(pair.a + pair.xi, pi / 2) + _half_disc(pair.a - pair.xi, -pi / 2),
    ),
    Check(
        "21",
        "M½ = 2{p_H π𝒜³/16 + [...]𝒜³/4}",
        "misprint",
        "¼ for π/4; (22) has it",
        printed=lambda: 2 * (_p_h() * pi / 16 * A_HALF**3 + (_punch() - _p_h() / 2) * A_HALF**3 / 4),
        follows=lambda: pair.half_moment(A_HALF),
        restated=lambda: pair.e * A_HALF**2 * pair.delta / 2 - pi / 8 * _p_h() * A_HALF**3,
    ),
    Check(
        "22",
        "M½ = ½E*𝒜²δ − (π/8)p_H𝒜³",
        "holds",
        "(20), integrated",
        printed=lambda: pair.e * A_HALF**2 * pair.delta / 2 - pi / 8 * _p_h() * A_HALF**3,
        follows=lambda: pair.half_moment(A_HALF),
    ),
    Check(
        "23",
        "M½ = ½E*δ𝒜² − (3/4)P_c𝒜⁴/a0³",
        "holds",
        "(20), integrated",
        printed=lambda: pair.e / 2 * pair.delta * A_HALF**2 - 3 / 4 * pair.p_c * A_HALF**4 / pair.a0**3,
        follows=lambda: pair.half_moment(A_HALF),
    ),
    Check(
        "24",
        "M ≈ 2ξ(−E*aδ + 3P_c â³)",
        "holds",
        "(19) to first order in ξ",
        printed=lambda: 2 * (-pair.e * pair.a * pair.delta + 3 * pair.p_c * pair.stretch**3),
        follows=lambda: first_order(pair.halves_moment, pair.xi),
    ),
    Check(
        "24",
        "the same for a finite shift",
        "approximate",
        "exact circle at fixed δ",
        printed=lambda: 2 * pair.xi * (-pair.e * pair.a * pair.delta + 3 * pair.p_c * pair.stretch**3),
        follows=lambda: pair.moment_at_approach(pair.delta),
        hedge=1.1,
    ),
    Check(
        "25",
        "M = 4P_c â^(3/2) ξ, half-circles",
        "holds",
        "(19) to first order, (6)",
        printed=lambda: 4 * pair.p_c * pair.stretch**1.5,
        follows=lambda: first_order(pair.halves_moment, pair.xi),
    ),
    Check(
        "25",
        "the same, one shifted circle",
        "holds",
        "exact in 3-D at fixed P",
        printed=lambda: 4 * pair.p_c * pair.stretch**1.5 * pair.xi,
        follows=lambda: pair.moment_at_load,
    ),
    Check(
        "25",
        "the dent of that circle",
        "holds",
        "half-space, chord by chord",
        printed=lambda: pair.delta - ((R_INSIDE - pair.xi) ** 2 + (R_INSIDE / 2) ** 2) / (2 * pair.r),
        follows=lambda: pair.depth(lambda x, y: pair.shifted_pressure(x, y, pair.delta), R_INSIDE, R_INSIDE / 2),
    ),
)


def _sector_moment(start: float) -> float:
    """Moment of the symmetric pressure over half of the circle, from an angle on."""
    around = integral(cos, start, start + pi)
    return around * to_rim(lambda r: r * r * pair.pressure(r, pair.a), pair.a)


def _half_disc(a: float, start: float) -> float:
    return integral(
        lambda angle: to_rim(lambda r: r * cos(angle) * pair.pressure_at_approach(r, a) * r, a), start, start + pi
    )


def _p_h() -> float:
    return pair.hertz(A_HALF)


def _punch() -> float:
    return pair.e * pair.delta / (pi * A_HALF)
