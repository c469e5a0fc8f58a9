"""The contact between JKR and DMT at a load or an approach: Maugis' theory, in SI units.

A constant stress σ0 pulls in a ring around the contact circle, a < r < c, up to a gap w/σ0. Two numbers describe a state:
the edge ratio v = a/√(c² − a²), found at a load or at an approach, and the span T = √(c² − a²) of the ring. Where the
spheres attract without contact, v is 0 and T is c. `dugdale` has the same curve in dimensionless form.
"""

from . import dugdale, dugdale_roots
from .dimensions import Force, Length, Number, Stiffness, Stress, SurfaceEnergy
from .elementary import pi, sqrt, where


def edge_ratio_at_load(
    *, load: Force, work_of_adhesion: SurfaceEnergy, reduced_radius: Length, transition_parameter: Number
) -> Number:
    """Edge ratio of the stable contact at a load.

        v = a/√(c² − a²)

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
    """Edge ratio of the contact that fixed grips hold at an approach; 0 where the spheres attract without contact.

        v = a/√(c² − a²)

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
    """Span √(c² − a²) of the ring of attraction around a contact.

        T = (πwR²/K)^(1/3)/(⅔λ²G2 + √((⅔λ²G2)² + λG1/2))

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
    """Span √(c² − a²) of the ring of attraction; without contact, the radius c of the zone of attraction.

        c²/2 − bc = δ + 2/(πλ), b = 8λ/3π without contact, in the units of `dugdale`

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


def contact_radius_maugis(*, edge_ratio: Number, zone_span: Length) -> Length:
    """Radius of the contact circle; 0 where the spheres attract without contact.

        a = vT

    Source:   Maugis 1992.
    Valid:    a ≪ R.
    Accuracy: 0.5 ulp above v and T.

    >>> contact_radius_maugis(edge_ratio=2.0, zone_span=3.0)
    6.0
    """
    return edge_ratio * zone_span


def zone_radius(*, edge_ratio: Number, zone_span: Length) -> Length:
    """Radius of the edge of the ring of attraction, where bonds break.

        c = T√(1 + v²)

    Source:   Maugis 1992.
    Valid:    c ≪ R.
    Accuracy: 2 ulp above v and T.

    >>> zone_radius(edge_ratio=0.75, zone_span=4.0)
    5.0
    """
    return zone_span * sqrt(1 + edge_ratio * edge_ratio)


def approach_maugis(
    *,
    edge_ratio: Number,
    zone_span: Length,
    reduced_radius: Length,
    contact_modulus: Stress,
    cohesive_stress: Stress,
) -> Length:
    """Approach of the centres at which a contact is in a state.

        δ = a²/R − 2σ0T/E*

    Source:   Maugis 1992.
    Valid:    Contact.
    Accuracy: 3 ulp of the larger term, above v and T.

    >>> approach_maugis(edge_ratio=2.0, zone_span=1.0, reduced_radius=1.0, contact_modulus=1.0, cohesive_stress=0.5)
    3.0
    """
    a = edge_ratio * zone_span
    return a * a / reduced_radius - 2 * cohesive_stress / contact_modulus * zone_span


def load_maugis(
    *,
    edge_ratio: Number,
    zone_span: Length,
    reduced_radius: Length,
    contact_modulus: Stress,
    cohesive_stress: Stress,
) -> Force:
    """Load that holds a state, in contact or apart.

        P = 4E*a³/(3R) − 2σ0(aT + c²θ), θ = arctan(1/v)

    Source:   Maugis 1992.
    Valid:    Always.
    Accuracy: 4 ulp of the larger term, above v and T.

    >>> load_maugis(edge_ratio=0.0, zone_span=1.0, reduced_radius=1.0, contact_modulus=1.0, cohesive_stress=1 / pi)
    -1.0
    """
    a = edge_ratio * zone_span
    hertz = 4 / 3 * contact_modulus / reduced_radius * a * a * a
    return hertz - 2 * cohesive_stress * zone_span * zone_span * dugdale.shape(edge_ratio).g3


def stiffness_maugis(
    *,
    edge_ratio: Number,
    zone_span: Length,
    reduced_radius: Length,
    contact_modulus: Stress,
    cohesive_stress: Stress,
) -> Stiffness:
    """Normal stiffness of a state, in contact or apart; negative where only fixed grips hold the spheres.

        dP/dδ = 2E*T (vG3 − qD)/(G3 − qh), q = 2σ0R/(E*T); the functions of v are those of `dugdale`

    Source:   Derivative of Maugis' solution along its curve.
    Valid:    Above the fold.
    Accuracy: 8 ulp, times 1 plus its condition.

    >>> stiffness_maugis(edge_ratio=1.0, zone_span=1.0, reduced_radius=1.0, contact_modulus=1.0, cohesive_stress=0.0)
    2.0
    """
    at = dugdale.shape(edge_ratio)
    q = 2 * cohesive_stress / contact_modulus * (reduced_radius / zone_span)
    return 2 * contact_modulus * zone_span * dugdale.stiffness_ratio(at, q)


def adhesive_force_maugis(*, edge_ratio: Number, zone_span: Length, cohesive_stress: Stress) -> Force:
    """Hertz' load at the contact radius less the load: the rolling moment per displacement of the ring of attraction.

        F_a = 4E*a³/(3R) − P = 2σ0(aT + c²θ), θ = arctan(1/v)

    Source:   Maugis 1992.
    Valid:    In contact or apart.
    Accuracy: 4 ulp above v and T.

    >>> adhesive_force_maugis(edge_ratio=0.0, zone_span=1.0, cohesive_stress=1 / pi)
    1.0
    """
    return 2 * cohesive_stress * zone_span * zone_span * dugdale.shape(edge_ratio).g3


def contact_displacement(
    *,
    zone_span: Length,
    reduced_radius: Length,
    contact_modulus: Stress,
    cohesive_stress: Stress,
    yield_displacement: Length,
) -> Length:
    """Displacement of the contact circle when its ring of attraction lags behind by ξ: ξ in JKR, 0 in DMT.

        ξ_contact = ξ/(1 + E*T/(σ0R))

    Source:   First order in ξ.
    Valid:    ξ ≪ a.
    Accuracy: 3 ulp above T.

    >>> contact_displacement(zone_span=1.0, reduced_radius=1.0, contact_modulus=1.0, cohesive_stress=1.0,
    ...                      yield_displacement=2.0)
    1.0
    """
    return yield_displacement / (1 + contact_modulus / cohesive_stress * (zone_span / reduced_radius))
