"""The pressure in the JKR contact: Eqs 8, 9 and 12-15."""

from __future__ import annotations

from .dimensions import Length, Number, Stress
from .elementary import pi, sqrt


def hertz_pressure(*, contact_radius_at_load: Length, contact_modulus: Stress, reduced_radius: Length) -> Stress:
    """Return the constant of the Hertz part of the pressure, which flattens the spheres.

        p_H = 2aE*/(πR), which is 6P_câ/(πa0²) = E*(36wx²/(π²RE*))^(1/3) in JKR

    Source:   Eq (8), and the text below Eq (13).
    Valid:    Any law of attraction.
    Accuracy: 2.5 ulp above a, E* and R.

    >>> round(hertz_pressure(contact_radius_at_load=pi, contact_modulus=1.0, reduced_radius=2.0), 12)
    1.0
    """
    return 2 / pi * contact_modulus * (contact_radius_at_load / reduced_radius)


def boussinesq_pressure(*, hertz_pressure: Stress, load_factor: Number) -> Stress:
    """Return the constant of the flat-punch part of the pressure, which pulls at the rim.

        p_B = −2P_c/(πa0²√â) = −p_H/(3x)

    Source:   Eqs (8) and (9).
    Valid:    JKR equilibrium at the load; the stable branch.
    Accuracy: 2 ulp above p_H and x.

    >>> boussinesq_pressure(hertz_pressure=6.0, load_factor=1.0)
    -2.0
    """
    return -hertz_pressure / (3 * load_factor)


def pressure(
    *, distance: Length, contact_radius_at_load: Length, hertz_pressure: Stress, boussinesq_pressure: Stress
) -> Stress:
    """Return the pressure at a distance from the centre of the contact; tension is negative and infinite at the rim.

        p(r) = p_H √(1 − r²/a²) + p_B/√(1 − r²/a²)

    distance             [m]   ≥ 0, below a
    boussinesq_pressure  [Pa]  any; negative in equilibrium

    Source:   Eq (12); Eq (7) lost both square roots in print.
    Valid:    0 ≤ r < a.
    Accuracy: 4 ulp of the larger term.

    >>> pressure(distance=0.0, contact_radius_at_load=1.0, hertz_pressure=3.0, boussinesq_pressure=-1.0)
    2.0
    """
    a = contact_radius_at_load
    depth = sqrt((a - distance) / a * ((a + distance) / a))
    return hertz_pressure * depth + boussinesq_pressure / depth


def boussinesq_pressure_at_approach(
    *, approach_at_load: Length, contact_radius_at_load: Length, contact_modulus: Stress, hertz_pressure: Stress
) -> Stress:
    """Return the flat-punch part of the pressure in a contact of given radius and approach, in equilibrium or not.

        p_B = E*δ/(πa) − p_H/2

    approach_at_load  [m]  any

    Source:   Eq (14); put into Eq (12) it is Eq (15).
    Valid:    Any circular contact.
    Accuracy: 2.5 ulp of the larger term.

    >>> boussinesq_pressure_at_approach(
    ...     approach_at_load=0.0, contact_radius_at_load=1.0, contact_modulus=1.0, hertz_pressure=2.0)
    -1.0
    """
    return contact_modulus * approach_at_load / (pi * contact_radius_at_load) - hertz_pressure / 2
