"""The rolling moment as Eq (17) says it: by integrating the pressure. No way to a number, but a check on the others."""

from math import cos, sin

from .dimensions import Length, Moment, Stress
from .elementary import pi


def quadrature_moment(
    *,
    contact_radius_at_load: Length,
    yield_displacement: Length,
    approach_at_load: Length,
    contact_modulus: Stress,
    reduced_radius: Length,
    points: int,
) -> Moment:
    """Moment of the two half-circles by integrating their pressure, as Eq (17) says it.

        M = 2∫r²p(r, a − ξ)dr − 2∫r²p(r, a + ξ)dr, with r = 𝒜 sin θ and the midpoint rule in θ

    Source:   Eqs (15), (17) and (18).
    Valid:    ξ < a. The rule is exact from 2 points on, because the integrand is a polynomial in cos 2θ.
    Accuracy: Loses the digits by which ξ is smaller than a: for comparison.

    >>> round(quadrature_moment(contact_radius_at_load=1.0, yield_displacement=0.5, approach_at_load=1.0,
    ...                         contact_modulus=1.0, reduced_radius=1.0, points=4), 12)
    0.25
    """
    moment = 0.0
    for side, radius in (
        (-1, contact_radius_at_load + yield_displacement),
        (1, contact_radius_at_load - yield_displacement),
    ):
        hertz = 2 * radius * contact_modulus / (pi * reduced_radius)
        punch = contact_modulus * approach_at_load / (pi * radius) - hertz / 2
        for place in range(points):
            angle = (place + 0.5) * pi / (2 * points)
            weight = sin(angle) ** 2 * (hertz * cos(angle) ** 2 + punch) * pi / (2 * points)
            moment = moment + side * 2 * radius * radius * radius * weight
    return moment
