"""Water that condenses between two bodies that touch in humid air: the force of its meniscus, to first order.

Water at 25 °C has a surface tension of 0.0720 N/m (IAPWS R1-76) and a molar volume of 18.07 cm³ (18.015 g/mol over
0.99705 g/cm³), so that γ_L V_m/(R_g T) is 0.5248 nm. The shape of the meniscus is a nodoid, whose force is
4πRγ_L cosθ (1 − q + …), q = κ√(r_K/R) with κ of `meniscus_size`. The tests compare this force with that of the
integrated shape.
"""

from __future__ import annotations

from .dimensions import Angle, Force, Length, Number
from .elementary import FloatOrArray, exp, ln, pi, sin, sqrt, within

WATER_TENSION = 0.072  # N/m
KELVIN_LENGTH = 5.248e-10  # m
WIDEST = 0.5  # q up to which the exact force lies between 0.999 and (1 + 2q²) times the first-order force
_PI_BELOW = 6.123233995736766e-17  # π/2 minus the double nearest to it


def _elevation(contact_angle: FloatOrArray) -> FloatOrArray:
    """Return π/2 − θ."""
    return pi / 2 - contact_angle + _PI_BELOW


def kelvin_radius(*, humidity: Number) -> Length:
    """Return the inverse of the total curvature of a water surface in equilibrium with air of a relative humidity.

        r_K = γ_L V_m/(R_g T ln(1/h)) = 0.5248 nm/ln(1/h)

    Source:   Kelvin's equation, water at 25 °C; measured for water from 9 nm on (Fisher, Gamble & Middlehurst 1981).
    Valid:    0 < h < 1. r_K well above 0.31 nm, the size of a molecule of water.
    """
    return -KELVIN_LENGTH / ln(within((humidity > 0) & (humidity < 1), humidity))


def meniscus_size(*, kelvin_radius: Length, reduced_radius: Length, contact_angle: Angle) -> Number:
    """Return the fraction by which the force of a meniscus is below that of a meniscus much smaller than the bodies.

        q = κ√(r_K/R), κ = (π/2 − θ + sinθ cosθ)/(4 cos^(3/2) θ), which is π/8 for θ = 0

    Source:   First order of the nodoid between two bodies that touch.
    Valid:    θ < 90°, both bodies with the same θ.
    """
    elevation = _elevation(within(contact_angle < pi / 2, contact_angle))
    slope = sin(elevation)  # cosθ
    kappa = (elevation + slope * sin(contact_angle)) / (4 * slope * sqrt(slope))
    return kappa * sqrt(kelvin_radius / reduced_radius)


def meniscus_force(*, reduced_radius: Length, contact_angle: Angle, meniscus_size: Number) -> Force:
    """Return the force of a meniscus of condensed water between smooth bodies that touch.

        F = 4πRγ_L cosθ (1 − q)

    Source:   First order of the nodoid; F tends to 4πRγ_L cosθ as q → 0, at any humidity.
    Valid:    q ≤ 1/2, where the exact force lies between 0.999F and (1 + 2q²)F. No gap between the bodies.
    """
    part = 1 - within(meniscus_size <= WIDEST, meniscus_size)
    return 4 * pi * reduced_radius * WATER_TENSION * sin(_elevation(contact_angle)) * part


def threshold_humidity(*, roughness_gap: Length, contact_angle: Angle) -> Number:
    """Return the relative humidity above which water fills a gap between the bodies.

        h = exp(−2 cosθ·0.5248 nm/D), at which 2r_K cosθ = D

    Source:   Kelvin's equation, water at 25 °C, for a meniscus across parallel walls.
    Valid:    θ < 90°. Adsorbed water may bridge a gap at a lower humidity: menisci were measured at 2 %
              (arXiv:0809.1502).
    """
    angle = within(contact_angle < pi / 2, contact_angle)
    return exp(-2 * KELVIN_LENGTH * sin(_elevation(angle)) / roughness_gap)
