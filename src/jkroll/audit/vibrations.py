"""Sect. 5.2.1, Eqs 31-42: vibrations. The restoring force is minus the slope of an energy."""

from math import pi, sqrt

from .check import Check
from .pair import Pair, pair, reference, twins
from .quadrature import nearest, slope


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
