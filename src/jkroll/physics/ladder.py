"""The rolling moment as a ladder of models, from Eq (26) without load to the exact shifted circle, and Eqs 16-24.

At a fixed load Eq (25) is exact. At a fixed approach the exact moment is larger by E*aξ³/R, and the two half-circles
overshoot it by as much again.
"""

from math import cos, sin

from .dimensions import Force, Length, Moment, Stress
from .elementary import pi, product

_POINTS = 4  # of the numerical integral


def unloaded_moment(*, pull_off_force: Force, yield_displacement: Length) -> Moment:
    """Moment of a contact without load, which the paper uses from Eq (26) on.

        M = 4 P_c ξ

    Source:   Eq (25) with â = 1.
    Valid:    |P| ≪ P_c.
    Accuracy: 0.5 ulp above P_c.

    >>> unloaded_moment(pull_off_force=1.0, yield_displacement=0.5)
    2.0
    """
    return 4 * pull_off_force * yield_displacement


def half_circle_moment(
    *, half_circle_radius: Length, approach_at_load: Length, contact_modulus: Stress, reduced_radius: Length
) -> Moment:
    """Moment of one half of a symmetric contact about its diameter.

        M½ = ½E*𝒜²δ − (π/8)p_H𝒜³ = ½E*𝒜²δ − (E*/4R)𝒜⁴

    Source:   Eqs (22) and (23), with p_H = 2𝒜E*/(πR); Eq (21) has ¼ for π/4.
    Valid:    𝒜 ≪ R.
    Accuracy: 5 ulp of the larger term.

    >>> half_circle_moment(half_circle_radius=2.0, approach_at_load=1.0, contact_modulus=1.0, reduced_radius=4.0)
    1.0
    """
    area = half_circle_radius * half_circle_radius
    return contact_modulus * area * (approach_at_load / 2 - area / (4 * reduced_radius))


def linearised_moment(
    *,
    contact_radius_at_load: Length,
    yield_displacement: Length,
    approach_at_load: Length,
    contact_modulus: Stress,
    reduced_radius: Length,
) -> Moment:
    """Moment of the two half-circles to first order in ξ, in equilibrium or not.

        M = 2ξ(3P_câ³ − E*aδ) = 2ξE*a(a²/R − δ)

    Source:   Eq (24).
    Valid:    ξ ≪ a. With Eq (6) for δ it is Eq (25).
    Accuracy: 4 ulp of the larger term.

    >>> linearised_moment(contact_radius_at_load=1.0, yield_displacement=1.0, approach_at_load=0.0,
    ...                   contact_modulus=1.0, reduced_radius=1.0)
    2.0
    """
    depth = contact_radius_at_load * contact_radius_at_load / reduced_radius
    return 2 * yield_displacement * contact_modulus * contact_radius_at_load * (depth - approach_at_load)


def half_circles_moment(
    *,
    contact_radius_at_load: Length,
    yield_displacement: Length,
    approach_at_load: Length,
    contact_modulus: Stress,
    reduced_radius: Length,
) -> Moment:
    """Moment of two half-circles of radius a + ξ and a − ξ at the same approach, not linearised.

        M = M½(a − ξ) − M½(a + ξ) = 2ξE*a((a² + ξ²)/R − δ)

    Source:   Eqs (19) and (23).
    Valid:    ξ < a. In equilibrium it exceeds the exact moment at a fixed approach by E*aξ³/R.
    Accuracy: 5 ulp of the larger term.

    >>> half_circles_moment(contact_radius_at_load=1.0, yield_displacement=1.0, approach_at_load=1.0,
    ...                     contact_modulus=1.0, reduced_radius=1.0)
    2.0
    """
    a, shift = contact_radius_at_load, yield_displacement
    return 2 * shift * contact_modulus * a * ((a * a + shift * shift) / reduced_radius - approach_at_load)


def integrated_moment(
    *,
    contact_radius_at_load: Length,
    yield_displacement: Length,
    approach_at_load: Length,
    contact_modulus: Stress,
    reduced_radius: Length,
) -> Moment:
    """Moment of the two half-circles by integrating their pressure numerically.

        M = twice the sum of r²p(r) over radii up to a − ξ, less that up to a + ξ: the midpoint rule in arcsin(r/𝒜)

    Source:   Eqs (15), (17) and (18).
    Valid:    ξ < a. The rule is exact from 2 points on, because p is a polynomial in r², over its square root.
    Accuracy: 5 ulp of the larger term.

    >>> round(integrated_moment(contact_radius_at_load=1.0, yield_displacement=0.5, approach_at_load=1.0,
    ...                         contact_modulus=1.0, reduced_radius=1.0), 12)
    0.25
    """
    a, shift = contact_radius_at_load, yield_displacement
    of_squares, of_quartics = 4 * a * shift, 8 * a * shift * (a * a + shift * shift)  # (a+ξ)² − (a−ξ)², (a+ξ)⁴ − (a−ξ)⁴
    moment = 0.0
    for place in range(_POINTS):
        angle = (place + 1 / 2) * pi / (2 * _POINTS)
        height = cos(2 * angle) * of_quartics / reduced_radius + of_squares * approach_at_load
        moment = moment - sin(angle) ** 2 / _POINTS * contact_modulus * height
    return moment


def fixed_approach_moment(
    *,
    yield_moment: Moment,
    contact_modulus: Stress,
    contact_radius_at_load: Length,
    yield_displacement: Length,
    reduced_radius: Length,
) -> Moment:
    """Exact moment of the shifted circle whose approach is held while it shifts.

        M = 4P_c â^(3/2) ξ + E*aξ³/R = 4P_c â^(3/2) ξ [1 + (3/4)(ξ/a0)²/√â]

    Source:   Hertz, flat punch and tilted flat punch on one circle; Eq (25) is the exact moment at a fixed load.
    Valid:    ξ < a0/(3√â).
    Accuracy: 2 ulp above its parts.

    >>> fixed_approach_moment(yield_moment=1.0, contact_modulus=1.0, contact_radius_at_load=2.0, yield_displacement=1.0,
    ...                       reduced_radius=1.0)
    3.0
    """
    xi = yield_displacement
    return yield_moment + product(contact_modulus, contact_radius_at_load, xi, xi, xi) / reduced_radius
