"""The peak pressure of a head-on impact, and the speeds at which it reaches the pressures that a solid bears.

At first touch, δ = 0, the spheres jump into contact. From there to the state of largest load, the relative energy ½mv²
is spent along JKR's curve without loss:

    ½mv² = P_cδ0 (Û(â) − Û_s)    Û = 4(6â⁵/5 − 2â^(7/2) + â²/2)    Û_s is Û after the jump, at â = (2/3)^(2/3)

The pressure at the centre is p(0) = P_c/(πa0²) (6â − 2/√â). In units of P_c/(πa0²) it is 4 at rest without load, and
5.0823 at the peak of a touch at v → 0; at speeds well above the sticking speed it is Hertz'. The pull at the rim is
left out.
"""

from __future__ import annotations

from .dimensions import Density, Energy, Force, Length, Mass, Number, Speed, Stress
from .elementary import FloatOrArray, arctan, at_least, at_most, pi, sqrt, within

TOUCH = 5.0823043295739116  # p(0) of the peak of a touch at v → 0, in P_c/(πa0²)
_AT_TOUCH = -0.6988643717890391  # Û_s
_PEAK_OF_TOUCH = 1.0756163614276605  # √â at this peak
_STEPS = 12  # of Newton's method, enough from every start below


def _energy(root: FloatOrArray) -> FloatOrArray:
    """Return Û at y = √â."""
    fourth = root * root * root * root
    return fourth * (2 + root * root * root * (24 / 5 * root * root * root - 8))


def impact_pressure(
    *,
    speed: Speed,
    reduced_mass: Mass,
    adhesion_energy: Energy,
    pull_off_force: Force,
    contact_radius: Length,
) -> Stress:
    """Return the pressure at the centre of the contact at the peak of a head-on impact.

        p = P_c/(πa0²) (6â − 2/√â), ½mv² = P_cδ0 (Û(â) − Û_s), â > 1, m the reduced mass, v the relative speed

    Source:   Eqs (5), (6) and (12): the energy of JKR's curve, and its pressure at r = 0.
    Valid:    JKR. Speeds well below √(E/ρ); no yield, no other loss. Hertz' pressure at large speeds.
    """
    energy = reduced_mass * speed * speed / (2 * adhesion_energy)
    root = _PEAK_OF_TOUCH + at_most(energy / 15, (5 / 24 * energy) ** 0.1)
    for _ in range(_STEPS):
        root = root - _beyond(root, energy)
    rounding = (12 * root + 2 / (root * root)) * _beyond(root, energy)  # the pressure's slope × the root's error
    return _pressure_unit(pull_off_force, contact_radius) * (6 * root * root - 2 / root - rounding)


def _beyond(root: FloatOrArray, energy: FloatOrArray) -> FloatOrArray:
    """Return a step of Newton's method: by how much y = √â lies beyond the peak of an impact, by the slope of Û."""
    third = root * root * root
    return (_energy(root) - _AT_TOUCH - energy) / (8 * third * (6 * third - 1) * (third - 1))


def touch_pressure(*, pull_off_force: Force, contact_radius: Length) -> Stress:
    """Return the peak pressure of a touch at zero speed, as adhesion alone presses the contact while it forms.

        p = 5.0823 P_c/(πa0²), 1.27 times that at rest

    Source:   As the peak pressure, for v → 0.
    Valid:    JKR.
    """
    return TOUCH * _pressure_unit(pull_off_force, contact_radius)


def _pressure_unit(pull_off_force: FloatOrArray, contact_radius: FloatOrArray) -> FloatOrArray:
    """Return P_c/(πa0²)."""
    return pull_off_force / (pi * contact_radius * contact_radius)


def _speed_at(
    pressure: FloatOrArray, touch_pressure: FloatOrArray, adhesion_energy: FloatOrArray, reduced_mass: FloatOrArray
) -> FloatOrArray:
    """Return the relative speed at which the peak pressure has a value above that of a touch, by 6y³ − p̂y − 2 = 0."""
    ratio = within(pressure > touch_pressure, pressure) / touch_pressure * TOUCH
    root = sqrt(ratio / 6)
    for _ in range(_STEPS):
        root = root - (root * (6 * root * root - ratio) - 2) / (18 * root * root - ratio)
    return sqrt(at_least(_energy(root) - _AT_TOUCH, 0.0)) * sqrt(2 * adhesion_energy) / sqrt(reduced_mass)


# --- Yield ------------------------------------------------------------------------------------------------------------


def first_yield_pressure(*, yield_strength: Stress, poisson_ratio: Number, poisson_ratio2: Number) -> Stress:
    """Return the peak pressure at which the solid first yields, below the surface.

        p_y = S_y/max[3/(2(1 + ζ²)) − (1 + ν)(1 − ζ arccot ζ)], which is 1.47 S_y at ν = 0.17, 0.44a deep

    The smaller ν of the two solids is used, as it gives the lower pressure.

    Source:   Hertz' stresses on the axis, by the criterion of von Mises (or Tresca, which is the same there).
    Valid:    0 ≤ ν ≤ 1/2. A contact that is elastic but for a point inside.
    """
    ratio = 1 + at_most(poisson_ratio, poisson_ratio2)
    depth = 0.37 + 0.2 * (ratio - 1)
    for _ in range(_STEPS):
        square = 1 + depth * depth
        slope = ratio * (_arccot(depth) - depth / square) - 3 * depth / (square * square)
        bend = (12 * depth * depth / square - 3) / (square * square) - 2 * ratio / (square * square)
        depth = depth - slope / bend
    return yield_strength / (1.5 / (1 + depth * depth) - ratio * (1 - depth * _arccot(depth)))


def _arccot(value: FloatOrArray) -> FloatOrArray:
    return pi / 2 - arctan(value)


def plastic_pressure(*, yield_strength: Stress) -> Stress:
    """Return the pressure at which all of the solid below the contact is plastic, which is about its hardness.

        p_pl = (2 + π)S_y/√3 = 2.97 S_y

    Source:   Slip lines below a flat punch, plane strain, by the criterion of von Mises.
    Valid:    A solid that does not harden; by Tresca's criterion 2.57 S_y.
    """
    return (2 + pi) / sqrt(3.0) * yield_strength


def yield_speed(
    *, touch_pressure: Stress, first_yield_pressure: Stress, reduced_mass: Mass, adhesion_energy: Energy
) -> Speed:
    """Return the relative speed above which the solid yields in a head-on impact, first below its surface.

        v_y = √(2P_cδ0 (Û(â_y) − Û_s)/m), 6â_y − 2/√â_y = p_y πa0²/P_c

    Source:   As the peak pressure; without adhesion (πp_y/2E*)^(5/2) √(16E*R³/(15m)).
    Valid:    JKR; p_y above 5.0823 P_c/(πa0²). Below, a touch alone makes the solid yield (with 4 for 5.0823, even the
              contact at rest): a float raises ValueError and an array holds NaN.
    """
    return _speed_at(first_yield_pressure, touch_pressure, adhesion_energy, reduced_mass)


def plastic_speed(
    *, touch_pressure: Stress, plastic_pressure: Stress, reduced_mass: Mass, adhesion_energy: Energy
) -> Speed:
    """Return the relative speed at which the peak pressure of an elastic impact is that of a plastic contact.

        v_pl, as the speed of first yield with p_pl

    Source:   As the speed of first yield.
    Valid:    As the speed of first yield.
    """
    return _speed_at(plastic_pressure, touch_pressure, adhesion_energy, reduced_mass)


# --- Numbers that limit the model -------------------------------------------------------------------------------------


def impact_pressure_over_modulus(*, impact_pressure: Stress, contact_modulus: Stress) -> Number:
    """Return the peak pressure of an impact over the contact modulus, which tells whether any solid would yield.

        p/E*

    Source:   As for the Hertz part of the pressure at rest: a solid without flaws yields at about 0.1.
    """
    return impact_pressure / contact_modulus


def impact_over_yield(*, impact_pressure: Stress, first_yield_pressure: Stress) -> Number:
    """Return the peak pressure of an impact over that of first yield: above 1 the solid yields.

        p/p_y

    Source:   As the pressure of first yield.
    """
    return impact_pressure / first_yield_pressure


def speed_over_sound(
    *, speed: Speed, youngs_modulus: Stress, youngs_modulus2: Stress, density: Density, density2: Density
) -> Number:
    """Return the relative speed over the lower of the speeds of sound in the two solids.

        v/√(E/ρ)

    Source:   Assumptions of the laws of impact: a static contact, and no energy in waves in the spheres.
    Valid:    The coefficient of restitution holds for a ratio well below 1.
    """
    slowness = at_least(density / youngs_modulus, density2 / youngs_modulus2)
    return speed * sqrt(slowness)
