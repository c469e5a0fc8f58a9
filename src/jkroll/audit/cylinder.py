"""Appendices A and B, Eqs 50-88: the cylinder on a plane, where E means E/(1 − ν²), and the integrals."""

from math import cos, pi, sqrt
from typing import Final

from .check import Check
from .quadrature import across, first_order, integral, principal_value, slope, to_rim

# A strip in which no number is special: its half-width, its lag, the load as an area, the cylinder, a place inside.
A: Final = 0.83
XI: Final = 0.067
C: Final = 0.211
R: Final = 5.9
E: Final = 3.7
X: Final = 0.31
A_HALF: Final = A + XI


def cylinder() -> tuple[Check, ...]:
    """Evaluate the claims of the appendices."""
    return (*_symmetric(), *_shifted(), *_halves(), *_integrals())


def _symmetric() -> tuple[Check, ...]:
    return (
        Check("50, 60", "u = δ − x²/(2R)", "holds", "circle, to first order",
              printed=-(X**2) / (2 * R), follows=sqrt(R**2 - X**2) - R, within=(X / R) ** 2 / 2),
        Check("51, 52", "P.V. p/(x − s) = −(πE/2)du/dx", "holds", "point loads along each line",
              printed=-pi * E / 2 * _dent_slope(XI, X), follows=_transform(XI, X)),
        Check("53", "that, solved for the pressure", "holds", "(56) and (64), put in",
              printed=(-pi * E / 2 * slope(lambda x: -x * x / (2 * R), X),
                       -pi * E / 2 * slope(lambda x: -((x - XI) ** 2) / (2 * R), X)),
              follows=(_transform(0, X), _transform(XI, X))),
        Check("54-56", "p_s of Hertz and (C − a²/2)", "holds", "(53), its C2 being −C",
              printed=symmetric(X, A), follows=-E / (2 * R * sqrt(A**2 - X**2)) * (-C + _hertz_tilt(X) / pi)),
        Check("57-59", "P = πEC/(2R)", "holds", "(56), integrated",
              printed=pi * E / (2 * R) * C, follows=across(lambda x: symmetric(x, A), A)),
    )  # fmt: skip


def _shifted() -> tuple[Check, ...]:
    load, at_centre = across(shifted, A), across(lambda x: x * shifted(x), A)
    return (
        Check("61, 62", "u = δ − (X − ξ)²/(2R)", "holds", "circle, to first order",
              printed=-((X - XI) ** 2) / (2 * R), follows=sqrt(R**2 - (X - XI) ** 2) - R, within=(X / R) ** 2 / 2),
        Check("63, 64", "p_a has ξX/√(a² − X²) besides", "holds", "(53), its C being −C",
              printed=shifted(X),
              follows=-E / (2 * R * sqrt(A**2 - X**2)) * (-C + (_hertz_tilt(X) - XI * _punch_tilt(X)) / pi)),
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
              printed=E / (2 * R) * (-(A_HALF**3) / 6 + C * A_HALF), follows=half_moment(A_HALF)),
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
              printed=pi * (X**2 - A**2 / 2), follows=_hertz_tilt(X)),
        Check("82", "P.V. W1/(x − s): πx", "holds", "quadrature off the pole",
              printed=pi * X, follows=_punch_tilt(X)),
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
    """Return the pressure of a strip that lags, x from its centre, Eq (64)."""
    return symmetric(x, A) + E / (2 * R) * XI * x / sqrt(A**2 - x**2)


def half_moment(a: float) -> float:
    """Return the moment of half a strip, Eq (74)."""
    return to_rim(lambda x: x * symmetric(x, a), a)


def halves_moment(xi: float) -> float:
    """Return the moment of two halves, Eq (73)."""
    return half_moment(A - xi) - half_moment(A + xi)


def _transform(xi: float, x: float) -> float:
    """Return the left side of Eq (51) for the pressure of a strip that lags by ξ, all of it over the root."""
    return principal_value(lambda s: E / (2 * R) * (A**2 - s**2 + C - A**2 / 2 + xi * s), x, A)


def _dent_slope(xi: float, x: float) -> float:
    """Return du/dx under that pressure: Boussinesq's 1/(πEr), x − s away, summed along y = (x − s) tan(angle)."""
    return -integral(cos, -pi / 2, pi / 2) / (pi * E) * _transform(xi, x)


def _hertz_tilt(x: float) -> float:
    return principal_value(lambda s: s * (A**2 - s**2), x, A)


def _punch_tilt(x: float) -> float:
    return principal_value(lambda s: A**2 - s**2, x, A)


def _w1(x: float) -> float:
    return sqrt(A**2 - x**2)


def _w2(r: float) -> float:
    return sqrt(1 - r**2 / A**2)
