"""A pair of spheres from first premises: elastic half-spaces, Hertz's geometry and Griffith's criterion at the rim."""

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import cached_property
from math import cbrt, cos, hypot, inf, pi, sin, sqrt
from typing import Final

from .quadrature import across, integral, lowest, over_disc, root, to_rim


@dataclass(frozen=True)
class Pair:
    """Two spheres, in units in which no number is special; body 2 may be a plane (r2 infinite)."""

    r1: float = 1.3
    r2: float = 2.9
    e: float = 7.1  # E*
    gamma: float = 0.017
    rho: float = 1.9
    xi: float = 0.029
    stretch: float = 1.17  # a/a0
    gravity: float = 0.0021
    energy: float = 0.0037

    # --- As the paper has it: Eqs 1-3, and the text around them ------------------------------------------------------

    @cached_property
    def r(self) -> float:
        """Reduced radius."""
        return 1 / (1 / self.r1 + 1 / self.r2)

    @cached_property
    def p_c(self) -> float:
        """Pull-off force, Eq (1)."""
        return 3 * pi * self.gamma * self.r

    @cached_property
    def a0(self) -> float:
        """Contact radius without load, Eq (2)."""
        return cbrt(9 * pi * self.gamma * self.r**2 / self.e)

    @cached_property
    def delta0(self) -> float:
        """Approach without load, Eq (3)."""
        return self.p_c / (self.e * self.a0)

    @cached_property
    def a(self) -> float:
        """Contact radius under some load."""
        return self.stretch * self.a0

    @cached_property
    def x(self) -> float:
        """The factor â^(3/2) of Eq (25)."""
        return self.stretch * sqrt(self.stretch)

    @cached_property
    def p(self) -> float:
        """That load, Eq (5)."""
        return 4 * self.p_c * (self.x**2 - self.x)

    @cached_property
    def delta(self) -> float:
        """Its approach, Eq (6)."""
        return self.delta0 * (3 * self.stretch**2 - 2 * sqrt(self.stretch))

    @cached_property
    def m1(self) -> float:
        """Mass of sphere 1."""
        return 4 / 3 * pi * self.r1**3 * self.rho

    @cached_property
    def m2(self) -> float:
        """Mass of sphere 2."""
        return 4 / 3 * pi * self.r2**3 * self.rho

    @cached_property
    def m(self) -> float:
        """Reduced mass."""
        return 1 / (1 / self.m1 + 1 / self.m2)

    @cached_property
    def i1(self) -> float:
        """Moment of inertia of sphere 1."""
        return 0.4 * self.m1 * self.r1**2

    @cached_property
    def i2(self) -> float:
        """Moment of inertia of sphere 2."""
        return 0.4 * self.m2 * self.r2**2

    @cached_property
    def i(self) -> float:
        """Reduced moment of inertia."""
        return 1 / (1 / self.i1 + 1 / self.i2)

    # --- From first premises -----------------------------------------------------------------------------------------

    def hertz(self, a: float) -> float:
        """Hertz pressure that gives a circle of radius a the curvature of the spheres."""
        return 2 * a * self.e / (pi * self.r)

    def griffith(self, a: float) -> float:
        """Flat-punch pressure whose tension at the rim, K = −p_B√(πa), releases K²/(2E*) = w = 2γ per area."""
        return -sqrt(4 * self.gamma * self.e / (pi * a))

    def pressure(self, r: float, a: float) -> float:
        """Sum of both at a distance from the centre of the circle."""
        depth = sqrt((1 - r / a) * (1 + r / a))
        return self.hertz(a) * depth + self.griffith(a) / depth

    def pressure_at_approach(self, r: float, a: float) -> float:
        """Eq (15): the pressure in a circle of any radius at the approach of the pair."""
        depth = sqrt((1 - r / a) * (1 + r / a))
        return self.hertz(a) * depth + (self.e * self.delta / (pi * a) - self.hertz(a) / 2) / depth

    def shifted_pressure(self, x: float, y: float, delta: float) -> float:
        """Exact pressure in the circle where its centre, x = y = 0, lags ξ behind the apex: a tilted punch on top.

        The depth that it must make is δ − ((x − ξ)² + y²)/(2R).
        """
        depth = sqrt(1 - hypot(x, y) ** 2 / self.a**2)
        punch = self.e / (pi * self.a) * (delta - self.xi**2 / (2 * self.r)) - self.hertz(self.a) / 2
        tilt = 2 * self.e * self.xi / (pi * self.r)
        return self.hertz(self.a) * depth + (punch + tilt * x / self.a) / depth

    def load_of(self, a: float) -> float:
        """Pressure, integrated over the circle."""
        return 2 * pi * to_rim(lambda r: r * self.pressure(r, a), a)

    def approach_of(self, a: float) -> float:
        """Depth of the dent that the pressure makes at its centre, by Boussinesq's point loads 1/(πE*r)."""
        return 2 / self.e * to_rim(lambda r: self.pressure(r, a), a)

    @cached_property
    def pull_off(self) -> float:
        """The largest tension that any circle bears."""
        return -lowest(self.load_of, 0.01 * self.a0, 3 * self.a0)

    @cached_property
    def free_radius(self) -> float:
        """The circle that bears no load."""
        return root(self.load_of, 0.7 * self.a0, 3 * self.a0)

    def depth(self, pressure: Callable[[float, float], float], x: float, y: float) -> float:
        """Depth of the dent that a pressure makes at a point of the circle: along every chord through that point."""

        def along_chord(angle: float) -> float:
            along, aside = (cos(angle), sin(angle)), x * sin(angle) - y * cos(angle)
            foot = aside * along[1], -aside * along[0]
            half = sqrt(self.a**2 - aside**2)
            return across(lambda s: pressure(foot[0] + s * along[0], foot[1] + s * along[1]), half)

        return integral(along_chord, 0, pi) / (pi * self.e)

    def moment_at_approach(self, delta: float) -> float:
        """Moment of the exact pressure about the apex."""
        return over_disc(lambda x, y: (x - self.xi) * self.shifted_pressure(x, y, delta), self.a)

    @cached_property
    def moment_at_load(self) -> float:
        """The same where the approach is the one that keeps the load."""

        def excess(delta: float) -> float:
            return over_disc(lambda x, y: self.shifted_pressure(x, y, delta), self.a) - self.p

        low, high = excess(0), excess(self.delta)
        return self.moment_at_approach(-low * self.delta / (high - low))

    def half_moment(self, a: float) -> float:
        """Eq (20), the moment of half a circle at the approach of the pair."""
        return 2 * to_rim(lambda r: r * r * self.pressure_at_approach(r, a), a)

    def halves_moment(self, xi: float) -> float:
        """Eq (19), the moment of two half-circles."""
        return self.half_moment(self.a - xi) - self.half_moment(self.a + xi)

    @cached_property
    def lever(self) -> float:
        """Travel of the driven centre over the angle of rolling, with body 2 held: by virtual work, M = Q lever."""
        travel, angle = 1 + self.r1 / self.r2, 1 / self.r  # for each length that the contact point moves
        return travel / angle

    @cached_property
    def rolling_mass(self) -> float:
        """2T/v² of two free spheres that roll over each other at v, the angular momentum being none."""
        orbit = self.m * (self.r1 + self.r2) ** 2
        turn = (self.i1 / self.r1 - self.i2 / self.r2) / (self.i1 + self.i2 + orbit)  # of the line of centres
        return self.i1 * (turn - 1 / self.r1) ** 2 + self.i2 * (turn + 1 / self.r2) ** 2 + orbit * turn**2


# Two spheres, a sphere on a plane, and two that are alike.
pair: Final = Pair()
plane: Final = Pair(r2=inf)
twins: Final = Pair(r2=Pair().r1)

# Two of the sizes of which the text speaks, and at which (36) and (42) are written, in SI units.
reference: Final = Pair(r1=1e-7, r2=1e-7, e=1e10 / 2, gamma=0.1, rho=2000.0, xi=2e-10, stretch=1.0, gravity=9.80665)
silicate: Final = replace(reference, gamma=0.025)
