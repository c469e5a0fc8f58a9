"""Sticking with the viscous damping of codes for dust: a force 2(T_vis/ν²)E*a dδ/dt beside that of JKR."""

from __future__ import annotations

from collections.abc import Sequence

from .dimensions import Energy, FloatOrArray, Length, Mass, Number, Speed, Stress, Time
from .elementary import cube, ln, sqrt, within

ALL_STICK = 0.681745209228707968  # T* from which on spheres stick at every speed
LARGEST = 0.6815  # T* up to which the approximation below was held against the equation of motion

# The cube root of the ratio of speeds is a quotient of polynomials of −ln(1 − T*/T_c); the coefficient of the highest
# power first.
_OVER = (
    0.00656377003078744, 0.13926479838105343, 1.2560552655575732, 13.353579642533976, 66.71381187636696,
    284.4669223705491,
    551.1471822473276, 424.0239945815925, 140.03302074351527, 19.915339089884874, 1.0,
)  # fmt: skip
_UNDER = (
    0.012643948318122239, 0.10560236313712765, 1.7809773703126632, 9.812847493179728, 56.20860934812392,
    239.30526460774885,
    266.4482631170719, 108.99628658854968, 17.904318541991803, 1.0,
)  # fmt: skip


def viscosity_number(
    *,
    viscous_time: Time,
    poisson_ratio: Number,
    poisson_ratio2: Number,
    contact_modulus: Stress,
    contact_radius: Length,
    reduced_mass: Mass,
) -> Number:
    """Return the viscous time over the time of a collision, which decides whether damped spheres stick.

        T* = (T_vis/(ν1ν2))√(E*a0/m)

    poisson_ratio   [1]  ν1ν2 > 0; else a float raises ValueError and an array holds NaN
    poisson_ratio2  [1]  as poisson_ratio

    Source:   The force 2(T_vis/ν²)E*a dδ/dt of Lumajord/DustSimulation and Paulemaule/DustCollider.
    Valid:    JKR. T_vis is no constant of a solid: it is fitted to the sticking of grains of one size.

    >>> number = viscosity_number(viscous_time=1.25e-11, poisson_ratio=0.17, poisson_ratio2=0.17,
    ...     contact_modulus=2.78e10, contact_radius=1.31e-8, reduced_mass=1.18e-15)
    >>> round(number, 3)
    0.24
    """
    product = within(poisson_ratio * poisson_ratio2 > 0, poisson_ratio * poisson_ratio2)
    return viscous_time / product * sqrt(contact_modulus * contact_radius / reduced_mass)


def sticking_speed_viscous(*, sticking_energy: Energy, reduced_mass: Mass, viscosity_number: Number) -> Speed:
    """Return the largest relative speed at which spheres stick that lose energy to viscous damping, too.

        v = r √(2U_stick/m), r = (p(L)/q(L))³, L = −ln(1 − T*/T_c), T_c = 0.6817; r = 1 + 8.849 T* + … for small T*

    Source:   Equation of motion on the JKR curve with F = 2(T_vis/ν²)E*a dδ/dt; r is fitted to its solutions within
              1e-10.
    Valid:    T* ≤ 0.6815; beyond, a float raises ValueError and an array holds NaN. Above T_c spheres stick at every
              speed. The damping is a quasi-static one, for T* well below 1.
    """
    distance = -ln(1 - viscosity_number / ALL_STICK)
    ratio = within(viscosity_number <= LARGEST, cube(_polynomial(_OVER, distance) / _polynomial(_UNDER, distance)))
    return ratio * sqrt(2 * sticking_energy) / sqrt(reduced_mass)


def _polynomial(coefficients: Sequence[float], value: FloatOrArray) -> FloatOrArray:
    """Return a polynomial by Horner's scheme, in which nothing cancels as all coefficients are positive."""
    total: FloatOrArray = 0.0
    for coefficient in coefficients:
        total = total * value + coefficient
    return total
