"""The contact in two dimensions, of a cylinder with a rigid plane: Eqs 50-78, all per length of the cylinder.

The strip in contact is 2a wide. Its centre, X = 0, lags by ξ behind the contact point, x = X − ξ = 0, below the axis.
The paper's appendix writes E for E′ = E/(1 − ν²). For two parallel cylinders, R and E′ are the reduced ones. An area C
stands for the load; a contact without adhesion has C = a²/2. The pressure p is negative in tension.
"""

from __future__ import annotations

from .dimensions import Area, ForcePerLength, Length, MomentPerLength, Stress
from .elementary import pi, sqrt


def asymmetric_pressure(
    *,
    position_in_strip: Length,
    contact_half_width: Length,
    yield_displacement: Length,
    cylinder_radius: Length,
    plane_strain_modulus: Stress,
    load_constant: Area,
) -> Stress:
    """Return the pressure in a strip that lags by ξ behind the contact point, at a position from the strip's centre.

        p_a = (E′/2R)[√(a² − X²) + (C − a²/2 + ξX)/√(a² − X²)]

    Source:   Eq (64), and Eq (56), which is Eq (64) at ξ = 0; both solve Eq (51). The C inside Eq (63) is minus this
              one.
    Valid:    |X| < a ≪ R, ξ ≤ a/2 − C/a; beyond, the leading edge, X = a, would interpenetrate.
    """
    depth = sqrt((contact_half_width - position_in_strip) * (contact_half_width + position_in_strip))
    neck = load_constant - contact_half_width * contact_half_width / 2 + yield_displacement * position_in_strip
    return plane_strain_modulus / (2 * cylinder_radius) * (depth + neck / depth)


def load_per_length(*, cylinder_radius: Length, plane_strain_modulus: Stress, load_constant: Area) -> ForcePerLength:
    """Return the load on the cylinder per length; tension is negative.

        P = πE′C/(2R), so that C = 2PR/(πE′)

    Source:   Eqs (59) and (65), in which ξ has no effect.
    Valid:    a ≪ R.
    """
    return pi / 2 * plane_strain_modulus * load_constant / cylinder_radius


def strip_moment(
    *, contact_half_width: Length, yield_displacement: Length, cylinder_radius: Length, plane_strain_modulus: Stress
) -> MomentPerLength:
    """Return the moment of the asymmetric pressure about the centre of the strip, per length.

        M(X = 0) = πE′a²ξ/(4R)

    Source:   Eq (68).
    Valid:    As Eq (64).
    """
    return pi / 4 * plane_strain_modulus * contact_half_width**2 * yield_displacement / cylinder_radius


def contact_point_moment(
    *,
    contact_half_width: Length,
    yield_displacement: Length,
    cylinder_radius: Length,
    plane_strain_modulus: Stress,
    load_constant: Area,
) -> MomentPerLength:
    """Return the moment with which the strip resists rolling: that of its pressure about the contact point, per length.

        M(x = 0) = M(X = 0) − ξP = (π/4)(E′/R)ξ(a² − 2C)

    Source:   Eqs (69) and (70); Eq (70) has +2C for −2C and ≈ for =.
    Valid:    As Eq (64). Without adhesion it vanishes.
    """
    area = contact_half_width**2 - 2 * load_constant
    return pi / 4 * plane_strain_modulus / cylinder_radius * yield_displacement * area


# --- The trick of Sect. 4.1 in two dimensions: the strip as two halves at the same load -----------------------------


def half_strips_moment(
    *,
    contact_half_width: Length,
    yield_displacement: Length,
    cylinder_radius: Length,
    plane_strain_modulus: Stress,
    load_constant: Area,
) -> MomentPerLength:
    """Return the moment of two half-strips of widths a + ξ and a − ξ at the same load, per length.

        M = M½(a − ξ) − M½(a + ξ) = (E′/2R)ξ(a² − 2C + ξ²/3)

    Source:   Eqs (76) and (77), multiplied out, so that the two moments do not cancel.
    Valid:    ξ < a. Without the term ξ²/3 this is Eq (78), 2/π of the exact Eq (70) at any load.
    """
    area = contact_half_width * contact_half_width - 2 * load_constant + yield_displacement * yield_displacement / 3
    return plane_strain_modulus / (2 * cylinder_radius) * yield_displacement * area
