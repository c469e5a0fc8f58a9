"""A pair of spheres from first principles: elastic half-spaces, Hertz's geometry and Griffith's criterion at the rim.

The checks are those of Sect. 5.1, Eqs 26-30: forces, angles and chains, and the sizes that the text gives; and of
Sects. 5.2.1, 5.2.2 and 6, Eqs 31-49: vibrations, rolling after a collision, the conclusions, and Table 1. The restoring
force of a vibration is minus the slope of an energy.
"""

from collections.abc import Callable
from functools import cached_property
from math import cbrt, cos, hypot, inf, pi, sin, sqrt
from typing import Final

from audit.checks import Check, across, integral, lowest, nearest, over_disc, root, slope, to_rim


class Pair:
    """Two spheres with arbitrary values; body 2 may be a plane (r2 infinite)."""

    def __init__(
        self,
        *,
        r1: float = 1.3,
        r2: float = 2.9,
        e: float = 7.1,  # E*
        gamma: float = 0.017,
        rho: float = 1.9,
        xi: float = 0.029,
        stretch: float = 1.17,  # a/a0
        gravity: float = 0.0021,
        energy: float = 0.0037,
    ) -> None:
        """Evaluate Eqs 1-6 at a contact radius, and the masses and moments of inertia."""
        self.r1, self.r2, self.e, self.gamma, self.rho, self.xi = r1, r2, e, gamma, rho, xi
        self.stretch, self.gravity, self.energy = stretch, gravity, energy
        self.r = 1 / (1 / r1 + 1 / r2)  # reduced radius
        self.p_c = 3 * pi * gamma * self.r  # Eq (1)
        self.a0 = cbrt(9 * pi * gamma * self.r**2 / e)  # Eq (2)
        self.delta0 = self.p_c / (e * self.a0)  # Eq (3)
        self.a = stretch * self.a0  # contact radius under a load
        self.x = stretch * sqrt(stretch)  # the factor â^(3/2) of Eq (25)
        self.p = 4 * self.p_c * (self.x**2 - self.x)  # load at this contact radius, Eq (5)
        self.delta = self.delta0 * (3 * stretch**2 - 2 * sqrt(stretch))  # approach at this load, Eq (6)
        self.m1, self.m2 = (4 / 3 * pi * radius**3 * rho for radius in (r1, r2))
        self.i1, self.i2 = 0.4 * self.m1 * r1**2, 0.4 * self.m2 * r2**2  # moments of inertia
        self.m = 1 / (1 / self.m1 + 1 / self.m2)  # reduced mass
        self.i = 1 / (1 / self.i1 + 1 / self.i2)  # reduced moment of inertia

    # --- From first principles ---------------------------------------------------------------------------------------

    def hertz(self, a: float) -> float:
        """Return the Hertz pressure that gives a circle of radius a the curvature of the spheres."""
        return 2 * a * self.e / (pi * self.r)

    def griffith(self, a: float) -> float:
        """Return the flat-punch pressure p_B whose tension at the rim, K = −p_B√(πa), releases K²/(2E*) = 2γ."""
        return -sqrt(4 * self.gamma * self.e / (pi * a))

    def pressure(self, r: float, a: float) -> float:
        """Return the sum of the pressures of Hertz and of a flat punch at a distance r from the centre."""
        profile = sqrt((1 - r / a) * (1 + r / a))
        return self.hertz(a) * profile + self.griffith(a) / profile

    def pressure_at_approach(self, r: float, a: float) -> float:
        """Return the pressure in a circle of any radius at the approach of the pair, Eq (15)."""
        profile = sqrt((1 - r / a) * (1 + r / a))
        return self.hertz(a) * profile + (self.e * self.delta / (pi * a) - self.hertz(a) / 2) / profile

    def shifted_pressure(self, x: float, y: float, delta: float) -> float:
        """Return the exact pressure in a circle whose centre, x = y = 0, lags ξ behind the apex.

        With the pressure of a tilted punch, the dent has the depth δ − ((x − ξ)² + y²)/(2R).
        """
        profile = sqrt(1 - hypot(x, y) ** 2 / self.a**2)
        punch = self.e / (pi * self.a) * (delta - self.xi**2 / (2 * self.r)) - self.hertz(self.a) / 2
        tilt = 2 * self.e * self.xi / (pi * self.r)
        return self.hertz(self.a) * profile + (punch + tilt * x / self.a) / profile

    def load_of(self, a: float) -> float:
        """Return the load of a circle: the integral of its pressure."""
        return 2 * pi * to_rim(lambda r: r * self.pressure(r, a), a)

    def approach_of(self, a: float) -> float:
        """Return the depth of the dent at the centre of a circle, by Boussinesq's point loads 1/(πE*r)."""
        return 2 / self.e * to_rim(lambda r: self.pressure(r, a), a)

    @cached_property
    def pull_off(self) -> float:
        """The largest tension that any circle bears."""
        return -lowest(self.load_of, 0.01 * self.a0, 3 * self.a0)

    @cached_property
    def free_radius(self) -> float:
        """The radius of the circle that bears no load."""
        return root(self.load_of, 0.7 * self.a0, 3 * self.a0)

    def depth(self, pressure: Callable[[float, float], float], x: float, y: float) -> float:
        """Return the depth of the dent that a pressure makes at a point, by Boussinesq along chords through it."""

        def along_chord(angle: float) -> float:
            along, aside = (cos(angle), sin(angle)), x * sin(angle) - y * cos(angle)
            foot = aside * along[1], -aside * along[0]
            half = sqrt(self.a**2 - aside**2)
            return across(lambda s: pressure(foot[0] + s * along[0], foot[1] + s * along[1]), half)

        return integral(along_chord, 0, pi) / (pi * self.e)

    def moment_at_approach(self, delta: float) -> float:
        """Return the moment of the exact pressure about the apex at an approach."""
        return over_disc(lambda x, y: (x - self.xi) * self.shifted_pressure(x, y, delta), self.a)

    @cached_property
    def moment_at_load(self) -> float:
        """The moment of the exact pressure at the approach that keeps the load; the load is linear in the approach."""

        def excess(delta: float) -> float:
            return over_disc(lambda x, y: self.shifted_pressure(x, y, delta), self.a) - self.p

        low, high = excess(0), excess(self.delta)
        return self.moment_at_approach(-low * self.delta / (high - low))

    def half_moment(self, a: float) -> float:
        """Return the moment of half a circle at the approach of the pair, Eq (20)."""
        return 2 * to_rim(lambda r: r * r * self.pressure_at_approach(r, a), a)

    def halves_moment(self, xi: float) -> float:
        """Return the moment of two half-circles, Eq (19)."""
        return self.half_moment(self.a - xi) - self.half_moment(self.a + xi)

    @cached_property
    def lever(self) -> float:
        """The travel of the driven centre per angle of rolling, with body 2 at rest: by virtual work, the lever M/Q."""
        travel, angle = 1 + self.r1 / self.r2, 1 / self.r  # per length that the contact point moves
        return travel / angle

    @cached_property
    def rolling_mass(self) -> float:
        """2T/v², where T is the kinetic energy of two free spheres that roll at v without angular momentum."""
        orbit = self.m * (self.r1 + self.r2) ** 2
        turn = (self.i1 / self.r1 - self.i2 / self.r2) / (self.i1 + self.i2 + orbit)  # of the line of centres
        return self.i1 * (turn - 1 / self.r1) ** 2 + self.i2 * (turn + 1 / self.r2) ** 2 + orbit * turn**2


# Two spheres, a sphere on a plane, and two identical spheres.
pair: Final = Pair()
plane: Final = Pair(r2=inf)
twins: Final = Pair(r2=pair.r1)


def reference(radius: float = 1e-7, gamma: float = 0.1) -> Pair:
    """Return two identical spheres with the values, in SI units, for which (36) and (42) are written."""
    return Pair(r1=radius, r2=radius, e=1e10 / 2, gamma=gamma, rho=2000.0, xi=2e-10, stretch=1.0, gravity=9.80665)


# --- Checks -----------------------------------------------------------------------------------------------------------

SILICATE, POLYSTYRENE, IRON = 0.025, 0.012, 3.0  # γ in J/m²


def statics() -> tuple[Check, ...]:
    """Return the checks of the claims on forces, angles and chains."""
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
              follows=sum(twins.m1 * twins.gravity * (2 * index + 1) * twins.r1 for index in range(17))),
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


def _ring(spheres: Pair) -> float:
    """Return the radius of the polygon of centres in which every contact is shifted by ξ on both of its spheres."""
    return spheres.r1 / sin(spheres.xi / spheres.r1)


def _level_chain(spheres: Pair) -> float:
    """Return the number of spheres whose weight has the largest moment that the contact bears."""
    return sqrt(4 * spheres.p_c * spheres.xi / (spheres.m1 * spheres.gravity * spheres.r1))


def _single_grain(gamma: float) -> float:
    """Return the radius at which the longest level chain has one sphere."""
    return root(lambda radius: _level_chain(reference(radius, gamma)) - 1, 1e-7, 1e-3)


# --- Vibrations -------------------------------------------------------------------------------------------------------


def vibrations() -> tuple[Check, ...]:
    """Return the checks of the claims on vibrations."""
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


def _slope(spheres: Pair) -> float:
    """Return dU/dδ, from the energy U = ∫P dδ by (5) and (6), in y = √â."""

    def energy(y: complex) -> complex:
        return spheres.p_c * spheres.delta0 * (24 / 5 * y**10 - 8 * y**7 + 2 * y**4)

    def approach(y: complex) -> complex:
        return spheres.delta0 * (3 * y**4 - 2 * y)

    y = sqrt(spheres.stretch)
    return slope(energy, y) / slope(approach, y)


def _stiffness(spheres: Pair) -> float:
    """Return dP/dδ at P = 0, from (5) and (6), in y = √â."""
    return spheres.p_c / spheres.delta0 * slope(lambda y: 4 * (y**6 - y**3), 1) / slope(lambda y: 3 * y**4 - 2 * y, 1)


def _vertical(spheres: Pair) -> float:
    """Return the frequency of vibration along the line of centres."""
    return sqrt(_stiffness(spheres) / spheres.m) / (2 * pi)


def _restoring(spheres: Pair) -> float:
    """Return −dU/dδ_α of the elastic energy U = 2P_cξ²/R, with ξ = Rδ_α."""
    return -slope(lambda angle: 2 * spheres.p_c * spheres.r * angle**2, spheres.xi / spheres.r)


def _free_rolling(spheres: Pair) -> float:
    """Return the frequency of an oscillator of energy ½ m v² + ½ (4P_c/R)ξ², where v is the rate of ξ."""
    return sqrt(4 * spheres.p_c / spheres.r / spheres.rolling_mass) / (2 * pi)


# --- Collisions -------------------------------------------------------------------------------------------------------

QUARTZ = (25.0, 5.4e10, 0.17, 2.6)  # the row of quartz in Table 1; the heading "ν" stands over the second number


def collisions() -> tuple[Check, ...]:
    """Return the checks of the claims on collisions, of the conclusions and of Table 1."""
    mean, stiffer = 2 * pair.p_c * pair.xi, Pair(e=2 * pair.e)
    rolling = _kinetic_energy(pair, pair.r1, 1.0)  # over ω1²
    (poisson_ratio,) = [value for value in QUARTZ if -1 <= value <= 0.5]
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
        Check("48 text", "grains stick below about P_c δ0", "approximate", "loss, jump-in to fold",
              printed=1.0, follows=lost, hedge=3),
        Check("49", "n = 3(γ/E*)^(2/3)∛R/(14∛(9π)ξ)", "holds", "(48) at W0 = P_c δ0",
              printed=eq_49, follows=pair.p_c * pair.delta0 / (14 * pi * pair.p_c * pair.xi)),
        Check("49", "the same, by the energy balance", "wrong", "7/2 of it",
              printed=eq_49, follows=pair.p_c * pair.delta0 / (2 * pi * mean)),
        Check("Fig. 7", "until all energy is dissipated", "wrong", "n of (48) dissipates 2/7",
              printed=1.0, follows=2 * pi * mean / (14 * pi * pair.p_c * pair.xi)),
        Check("Sect. 6", "under a load, M depends weakly on E", "wrong", "at fixed δ only; E doubled",
              printed=_factor_at_approach(pair.delta / stiffer.delta0) / pair.x,
              follows=factor_at(pair.p / stiffer.p_c) / pair.x),
        Check("Table 1", "quartz: ν = 5.4(10) by the column heading", "misprint", "scrambled in the copy",
              printed=QUARTZ[1], restated=QUARTZ[2], follows=poisson_ratio),
    )  # fmt: skip


def _kinetic_energy(spheres: Pair, speed: float, spin: float) -> float:
    """Return the kinetic energy of sphere 1: ½ρ|v + ω × r|², integrated by cylindrical shells about its axis."""

    def shell(angle: float) -> float:
        distance, height = spheres.r1 * sin(angle), spheres.r1 * cos(angle)
        return 2 * pi * spheres.rho * distance * (speed**2 + (spin * distance) ** 2) * height * height

    return integral(shell, 0, pi / 2)


def _factor_at_approach(approach_ratio: float) -> float:
    """Return the stable â^(3/2) at an approach, by (6)."""
    return root(lambda y: 3 * y**4 - 2 * y - approach_ratio, 6 ** (-1 / 3), 10) ** 3
