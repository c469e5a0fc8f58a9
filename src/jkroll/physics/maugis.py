"""The state of a contact between JKR and DMT at a load or an approach: Maugis' theory, in SI units.

A constant stress σ0 pulls in a ring around the contact circle, a < r < c, up to a gap w/σ0. Two numbers describe a state:
the edge ratio v = a/√(c² − a²), found at a load or at an approach, and the span T = √(c² − a²) of the ring. Where the
spheres attract without contact, v is 0 and T is c. `dugdale` has the same curve in dimensionless form.
"""

from __future__ import annotations

from . import dugdale, dugdale_roots
from .dimensions import Force, Length, Number, Stress, SurfaceEnergy
from .elementary import pi, where


def edge_ratio_at_load(
    *, load: Force, work_of_adhesion: SurfaceEnergy, reduced_radius: Length, transition_parameter: Number
) -> Number:
    """Return the edge ratio of the stable contact at a load.

        v = a/√(c² − a²)

    load                  [N]     any; tension is negative
    work_of_adhesion      [J/m²]  > 0
    reduced_radius        [m]     > 0
    transition_parameter  [1]     > 0

    Returns:  [1]; a float for floats, an array for arrays, which broadcast.
    Source:   Maugis 1992, by Newton's method.
    Valid:    Loads above pull-off. Below, a float raises ValueError and an array holds NaN.
    Accuracy: 10 ulp, times 1 plus its condition in the load and λ.

    >>> unit = {"work_of_adhesion": 1 / pi, "reduced_radius": 1.0}
    >>> round(edge_ratio_at_load(load=0.0, transition_parameter=1.0, **unit), 7)
    1.4102117
    """
    return dugdale_roots.ratio_at_load(transition_parameter, load / (pi * work_of_adhesion * reduced_radius))


def edge_ratio_at_approach(
    *,
    approach_at_load: Length,
    work_of_adhesion: SurfaceEnergy,
    reduced_radius: Length,
    contact_modulus: Stress,
    transition_parameter: Number,
) -> Number:
    """Return the edge ratio of the contact that fixed grips hold at an approach; 0 where the spheres attract without contact.

        v = a/√(c² − a²)

    approach_at_load      [m]     any
    work_of_adhesion      [J/m²]  > 0
    reduced_radius        [m]     > 0
    contact_modulus       [Pa]    > 0
    transition_parameter  [1]     > 0

    Returns:  [1]; a float for floats, an array for arrays, which broadcast.
    Source:   Maugis 1992, by Newton's method.
    Valid:    Approaches above the fold. Beyond, a float raises ValueError and an array holds NaN.
    Accuracy: 10 ulp, times 1 plus its condition in the approach and λ.

    >>> unit = {"work_of_adhesion": 1 / pi, "reduced_radius": 1.0, "contact_modulus": 0.75}
    >>> edge_ratio_at_approach(approach_at_load=-3.0, transition_parameter=0.2, **unit)
    0.0
    """
    unit = dugdale.length_unit(work_of_adhesion, reduced_radius, contact_modulus)
    return dugdale_roots.ratio_at_approach(transition_parameter, approach_at_load / unit / unit * reduced_radius)


def zone_span(
    *,
    edge_ratio: Number,
    work_of_adhesion: SurfaceEnergy,
    reduced_radius: Length,
    contact_modulus: Stress,
    transition_parameter: Number,
) -> Length:
    """Return the span √(c² − a²) of the ring of attraction around a contact.

        T = (πwR²/K)^(1/3)/(⅔λ²G2 + √((⅔λ²G2)² + λG1/2))

    edge_ratio            [1]     ≥ 0; 0 without contact
    work_of_adhesion      [J/m²]  > 0
    reduced_radius        [m]     > 0
    contact_modulus       [Pa]    > 0
    transition_parameter  [1]     > 0

    Returns:  [m]; a float for floats, an array for arrays, which broadcast.
    Source:   Maugis 1992, solved for T.
    Valid:    Contact.
    Accuracy: 6 ulp, times 1 plus its condition in v.

    >>> unit = {"work_of_adhesion": 1 / pi, "reduced_radius": 1.0, "contact_modulus": 0.75}
    >>> round(zone_span(edge_ratio=1.0, transition_parameter=1.0, **unit), 7)
    1.0033991
    """
    span = dugdale.span(transition_parameter, dugdale.shape(edge_ratio))
    return span * dugdale.length_unit(work_of_adhesion, reduced_radius, contact_modulus)


def zone_span_at_approach(
    *,
    edge_ratio: Number,
    approach_at_load: Length,
    work_of_adhesion: SurfaceEnergy,
    reduced_radius: Length,
    contact_modulus: Stress,
    transition_parameter: Number,
) -> Length:
    """Return the span √(c² − a²) of the ring of attraction; without contact, the radius c of the zone of attraction.

        c²/2 − bc = δ + 2/(πλ), b = 8λ/3π without contact, in the units of `dugdale`

    edge_ratio            [1]     ≥ 0; 0 without contact
    approach_at_load      [m]     any
    work_of_adhesion      [J/m²]  > 0
    reduced_radius        [m]     > 0
    contact_modulus       [Pa]    > 0
    transition_parameter  [1]     > 0

    Returns:  [m]; a float for floats, an array for arrays, which broadcast.
    Source:   Maugis 1992; Johnson & Greenwood 1997.
    Valid:    Approaches above the fold.
    Accuracy: 6 ulp, times 1 plus its condition.

    >>> unit = {"work_of_adhesion": 1 / pi, "reduced_radius": 1.0, "contact_modulus": 0.75}
    >>> c = zone_span_at_approach(edge_ratio=0.0, approach_at_load=-20 / pi, transition_parameter=0.1, **unit)
    >>> round(c * 3 * pi / 1.6, 12)
    1.0
    """
    unit = dugdale.length_unit(work_of_adhesion, reduced_radius, contact_modulus)
    touching = dugdale.span(transition_parameter, dugdale.shape(edge_ratio))
    apart = dugdale.span_apart(transition_parameter, approach_at_load / unit / unit * reduced_radius)
    return unit * where(edge_ratio > 0, touching, apart)
