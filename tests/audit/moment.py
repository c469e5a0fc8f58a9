"""The checks of Sects. 2 to 4 and of Appendices A and B.

Sects. 2 to 4, Eqs 1-25: the contact, and the moment of a shifted contact. Appendices, Eqs 50-88: the cylinder on a
plane, where E means E/(1 − ν²), and the integrals.
"""

from math import cos, pi, sqrt
from typing import Final

from audit.checks import Check, across, first_order, integral, principal_value, slope, to_rim
from audit.pair import pair, plane

R_INSIDE: Final = 0.37 * pair.a  # a distance from the centre
A_HALF: Final = 1.09 * pair.a  # radius of one half-circle
P_H: Final = 2 * pair.a * pair.e / (pi * pair.r)
P_B: Final = pair.e * pair.delta / (pi * pair.a) - P_H / 2


def moment() -> tuple[Check, ...]:
    """Return the checks of the claims on the contact and its moment."""
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
              printed=-1.0, follows=_half_circle(pi / 2) / _half_circle(-pi / 2)),
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
        Check("24", "(24) for a finite shift", "approximate", "exact circle at fixed δ",
              printed=eq_24 * pair.xi, follows=pair.moment_at_approach(pair.delta), hedge=1.1),
        Check("25", "M = 4P_c â^(3/2) ξ, half-circles", "holds", "(19) to first order, (6)",
              printed=eq_25, follows=first_order(pair.halves_moment, pair.xi)),
        Check("25", "the same, one shifted circle", "holds", "exact in 3-D at fixed P",
              printed=eq_25 * pair.xi, follows=pair.moment_at_load),
        Check("25", "the dent of that circle", "holds", "half-space, chord by chord",
              printed=pair.delta - ((R_INSIDE - pair.xi) ** 2 + (R_INSIDE / 2) ** 2) / (2 * pair.r),
              follows=pair.depth(lambda x, y: pair.shifted_pressure(x, y, pair.delta), R_INSIDE, R_INSIDE / 2)),
    )  # fmt: skip


def _rigid_pull_off() -> float:
    """Return the pull-off force of rigid spheres that attract by 4γ(1 − h) per area at a gap h < 1, so that w = 2γ."""
    return integral(lambda r: 2 * pi * r * 4 * pair.gamma * (1 - r**2 / (2 * pair.r)), 0, sqrt(2 * pair.r))


def _pressure_at(x: float, y: float) -> float:
    """Return the pressure of Eq (12)."""
    profile = sqrt(1 - (x * x + y * y) / pair.a**2)
    return P_H * profile + P_B / profile


def _half_circle(start: float) -> float:
    """Return the moment of the symmetric pressure over half of the circle, which begins at an angle."""
    around = integral(cos, start, start + pi)
    return around * to_rim(lambda r: r * r * pair.pressure(r, pair.a), pair.a)


def _half_disc(a: float, start: float) -> float:
    """Return the moment of the pressure (15) over half of a circle, which begins at an angle, by Eq (17)."""
    return integral(
        lambda angle: to_rim(lambda r: r * cos(angle) * pair.pressure_at_approach(r, a) * r, a), start, start + pi
    )


# --- A cylinder on a plane --------------------------------------------------------------------------------------------

# Arbitrary values of a strip: its half-width and lag, its load constant (an area), R and E, and a position inside.
A: Final = 0.83
XI: Final = 0.067
C: Final = 0.211
R: Final = 5.9
E: Final = 3.7
X: Final = 0.31
A_STRIP: Final = A + XI  # half-width of one half


def cylinder() -> tuple[Check, ...]:
    """Return the checks of the claims in the appendices."""
    return (*_symmetric(), *_shifted(), *_halves(), *_integrals())


def _symmetric() -> tuple[Check, ...]:
    return (
        Check("50, 60", "u = δ − x²/(2R)", "holds", "circle, to first order",
              printed=-(X**2) / (2 * R), follows=sqrt(R**2 - X**2) - R, within=(X / R) ** 2 / 2),
        Check("51, 52", "P.V. p/(x − s) = −(πE/2)du/dx", "holds", "point loads along each line",
              printed=-pi * E / 2 * _dent_slope(XI, X), follows=_transform(XI, X)),
        Check("53", "(52), solved for the pressure", "holds", "(56) and (64), inserted",
              printed=(-pi * E / 2 * slope(lambda x: -x * x / (2 * R), X),
                       -pi * E / 2 * slope(lambda x: -((x - XI) ** 2) / (2 * R), X)),
              follows=(_transform(0, X), _transform(XI, X))),
        Check("54-56", "p_s of Hertz and (C − a²/2)", "holds", "(53), its C2 being −C",
              printed=symmetric(X, A), follows=-E / (2 * R * sqrt(A**2 - X**2)) * (-C + _integral_81(X) / pi)),
        Check("57-59", "P = πEC/(2R)", "holds", "(56), integrated",
              printed=pi * E / (2 * R) * C, follows=across(lambda x: symmetric(x, A), A)),
    )  # fmt: skip


def _shifted() -> tuple[Check, ...]:
    load, at_centre = across(shifted, A), across(lambda x: x * shifted(x), A)
    return (
        Check("61, 62", "u = δ − (X − ξ)²/(2R)", "holds", "circle, to first order",
              printed=-((X - XI) ** 2) / (2 * R), follows=sqrt(R**2 - (X - XI) ** 2) - R, within=(X / R) ** 2 / 2),
        Check("63, 64", "p_a is p_s plus a term ξX/√(a² − X²)", "holds", "(53), its C being −C",
              printed=shifted(X),
              follows=-E / (2 * R * sqrt(A**2 - X**2)) * (-C + (_integral_81(X) - XI * _integral_82(X)) / pi)),
        Check("65", "P = πEC/(2R)", "holds", "(64), integrated",
              printed=pi * E / (2 * R) * C, follows=load),
        Check("66-68", "M(X = 0) = πa²Eξ/(4R)", "holds", "X p_a, integrated",
              printed=pi * A**2 * E / (4 * R) * XI, follows=at_centre),
        Check("69", "M(x = 0) = M(X = 0) − ξP", "holds", "(X − ξ)p_a, integrated",
              printed=pi * A**2 * E / (4 * R) * XI - XI * pi * E / (2 * R) * C,
              follows=across(lambda x: (x - XI) * shifted(x), A)),
        Check("70", "M(x = 0) ≈ (π/4)(E/R)ξ{a² + 2C}", "sign", "a² − 2C, by (68) and (69)",
              printed=(pi / 4 * E / R * XI * A**2, pi / 4 * E / R * XI * 2 * C), follows=(at_centre, -XI * load)),
    )  # fmt: skip


def _halves() -> tuple[Check, ...]:
    return (
        Check("71-76", "M½ = (E/2R){−𝒜³/6 + C𝒜}", "holds", "(74), integrated",
              printed=E / (2 * R) * (-(A_STRIP**3) / 6 + C * A_STRIP), follows=half_moment(A_STRIP)),
        Check("77", "M = M½(a − ξ) − M½(a + ξ)", "holds", "x p_s, integrated",
              printed=E / (2 * R) * XI * (A**2 - 2 * C + XI**2 / 3), follows=halves_moment(XI)),
        Check("78", "M ≈ ½(E/R)ξ{a² − 2C}", "holds", "first order of (77) in ξ",
              printed=1 / 2 * E / R * (A**2 - 2 * C), follows=first_order(halves_moment, XI)),
        Check("78 text", "(70) is π/2 times (78)", "holds", "with the sign put right",
              printed=pi / 2,
              follows=across(lambda x: (x - XI) * shifted(x), A) / XI / first_order(halves_moment, XI)),
    )  # fmt: skip


def _integrals() -> tuple[Check, ...]:
    return (
        Check("79, 84", "W1 integrates to ½πa²", "holds", "(79) should be W1(x, a)",
              printed=pi * A**2 / 2, follows=across(_w1, A)),
        Check("81", "P.V. s W1/(x − s): π(x² − ½a²)", "holds", "quadrature off the pole",
              printed=pi * (X**2 - A**2 / 2), follows=_integral_81(X)),
        Check("82", "P.V. W1/(x − s): πx", "holds", "quadrature off the pole",
              printed=pi * X, follows=_integral_82(X)),
        Check("83", "1/W1: π", "holds", "quadrature",
              printed=pi, follows=across(lambda x: 1 / _w1(x), A)),
        Check("85, 86", "x W1: a³/3; x/W1: a", "holds", "quadrature",
              printed=(A**3 / 3, A), follows=(to_rim(lambda x: x * _w1(x), A), to_rim(lambda x: x / _w1(x), A))),
        Check("80, 87", "r² W2: πa³/16", "holds", "quadrature",
              printed=pi / 16 * A**3, follows=to_rim(lambda r: r**2 * _w2(r), A)),
        Check("80, 88", "r²/W2: πa³/4", "holds", "quadrature",
              printed=pi / 4 * A**3, follows=to_rim(lambda r: r**2 / _w2(r), A)),
    )  # fmt: skip


def symmetric(x: float, a: float) -> float:
    """Return the pressure of a strip, Eq (56)."""
    return E / (2 * R) * (sqrt(a**2 - x**2) + (C - a**2 / 2) / sqrt(a**2 - x**2))


def shifted(x: float) -> float:
    """Return the pressure of a lagging strip at a distance x from its centre, Eq (64)."""
    return symmetric(x, A) + E / (2 * R) * XI * x / sqrt(A**2 - x**2)


def half_moment(a: float) -> float:
    """Return the moment of half a strip, Eq (74)."""
    return to_rim(lambda x: x * symmetric(x, a), a)


def halves_moment(xi: float) -> float:
    """Return the moment of two halves of a strip, Eq (73)."""
    return half_moment(A - xi) - half_moment(A + xi)


def _transform(xi: float, x: float) -> float:
    """Return the left side of Eq (51) for the pressure of a strip that lags by ξ."""
    return principal_value(lambda s: E / (2 * R) * (A**2 - s**2 + C - A**2 / 2 + xi * s), x, A)


def _dent_slope(xi: float, x: float) -> float:
    """Return du/dx under a lagging strip: Boussinesq's 1/(πEr), integrated along each line, y = (x − s) tan(angle)."""
    return -integral(cos, -pi / 2, pi / 2) / (pi * E) * _transform(xi, x)


def _integral_81(x: float) -> float:
    """Return the principal value of ∫ s W1/(x − s) ds."""
    return principal_value(lambda s: s * (A**2 - s**2), x, A)


def _integral_82(x: float) -> float:
    """Return the principal value of ∫ W1/(x − s) ds."""
    return principal_value(lambda s: A**2 - s**2, x, A)


def _w1(x: float) -> float:
    return sqrt(A**2 - x**2)


def _w2(r: float) -> float:
    return sqrt(1 - r**2 / A**2)
