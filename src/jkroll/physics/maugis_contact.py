"""A Maugis contact between JKR and DMT: its radii, load, approach and stiffness in a state, in SI units.

The edge ratio v and the span T of the ring of attraction, which describe the state, come from `maugis`.
"""

from __future__ import annotations

from . import dugdale
from .dimensions import Force, Length, Number, Stiffness, Stress
from .elementary import arctan, at_least, sqrt, where


def contact_radius_maugis(*, edge_ratio: Number, zone_span: Length) -> Length:
    """Return the radius of the contact circle; 0 where the spheres attract without contact.

        a = vT

    edge_ratio  [1]  ≥ 0; 0 without contact
    zone_span   [m]  > 0

    Returns:  [m]; a float for floats, an array for arrays, which broadcast.
    Source:   Maugis 1992.
    Valid:    a ≪ R.
    Accuracy: 0.5 ulp above v and T.

    >>> contact_radius_maugis(edge_ratio=2.0, zone_span=3.0)
    6.0
    """
    return edge_ratio * zone_span


def zone_radius(*, edge_ratio: Number, zone_span: Length) -> Length:
    """Return the radius of the edge of the ring of attraction, where bonds break.

        c = T√(1 + v²)

    edge_ratio  [1]  ≥ 0; 0 without contact
    zone_span   [m]  > 0

    Returns:  [m]; a float for floats, an array for arrays, which broadcast.
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
    """Return the approach of the centres at which a contact is in a state.

        δ = a²/R − 2σ0T/E*

    edge_ratio       [1]   ≥ 0; 0 without contact
    zone_span        [m]   > 0
    reduced_radius   [m]   > 0
    contact_modulus  [Pa]  > 0
    cohesive_stress  [Pa]  > 0

    Returns:  [m]; a float for floats, an array for arrays, which broadcast.
    Source:   Maugis 1992.
    Valid:    Contact.
    Accuracy: 3 ulp of the larger term, above v and T.

    >>> approach_maugis(edge_ratio=2.0, zone_span=1.0, reduced_radius=1.0, contact_modulus=1.0, cohesive_stress=0.5)
    3.0
    """
    a = edge_ratio * zone_span
    return a * a / reduced_radius - 2 * cohesive_stress / contact_modulus * zone_span


def approach_maugis_at_load(
    *,
    load: Force,
    edge_ratio: Number,
    zone_span: Length,
    reduced_radius: Length,
    contact_modulus: Stress,
    cohesive_stress: Stress,
) -> Length:
    """Return the approach of the centres of a contact whose load is known.

        δ = 3P/(4E*a) + (σ0T/(2E*))(3(v + 1/v)θ − 1), θ = arctan(1/v), in which less cancels where v > 1
        δ of `approach_maugis` elsewhere

    load             [N]   tension negative; the one at which the contact has this edge ratio
    edge_ratio       [1]   > 0
    zone_span        [m]   > 0
    reduced_radius   [m]   > 0
    contact_modulus  [Pa]  > 0
    cohesive_stress  [Pa]  > 0

    Returns:  [m]; a float for floats, an array for arrays, which broadcast.
    Source:   Maugis 1992.
    Valid:    Contact.
    Accuracy: 10 ulp, times 1 plus its condition in the load and λ.

    >>> approach_maugis_at_load(
    ...     load=4.0, edge_ratio=3.0, zone_span=1.0, reduced_radius=9.0, contact_modulus=1.0, cohesive_stress=0.0
    ... )
    1.0
    """
    depth = cohesive_stress / contact_modulus * zone_span
    narrow = at_least(edge_ratio, 1.0)
    of_load = 3 / 4 * load / (contact_modulus * zone_span * narrow)
    of_narrow = of_load + depth * (3 / 2 * (narrow + 1 / narrow) * arctan(1 / narrow) - 1 / 2)
    of_wide = approach_maugis(
        edge_ratio=edge_ratio,
        zone_span=zone_span,
        reduced_radius=reduced_radius,
        contact_modulus=contact_modulus,
        cohesive_stress=cohesive_stress,
    )
    return where(edge_ratio > 1, of_narrow, of_wide)


def load_maugis(
    *,
    edge_ratio: Number,
    zone_span: Length,
    reduced_radius: Length,
    contact_modulus: Stress,
    cohesive_stress: Stress,
) -> Force:
    """Return the load that holds a state, in contact or apart.

        P = 4E*a³/(3R) − 2σ0(aT + c²θ), θ = arctan(1/v)

    edge_ratio       [1]   ≥ 0; 0 without contact
    zone_span        [m]   > 0
    reduced_radius   [m]   > 0
    contact_modulus  [Pa]  > 0
    cohesive_stress  [Pa]  > 0

    Returns:  [N]; a float for floats, an array for arrays, which broadcast.
    Source:   Maugis 1992.
    Valid:    Always.
    Accuracy: 4 ulp of the larger term, above v and T.

    >>> from math import pi
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
    """Return the normal stiffness of a state, in contact or apart; negative where only fixed grips hold the spheres.

        dP/dδ = 2E*T (vG3 − qD)/(G3 − qh), q = 2σ0R/(E*T); the functions of v are those of `dugdale`

    edge_ratio       [1]   ≥ 0; 0 without contact
    zone_span        [m]   > 0
    reduced_radius   [m]   > 0
    contact_modulus  [Pa]  > 0
    cohesive_stress  [Pa]  > 0

    Returns:  [N/m]; a float for floats, an array for arrays, which broadcast.
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
    """Return Hertz' load at the contact radius less the load: the rolling moment per displacement of the ring of attraction.

        F_a = 4E*a³/(3R) − P = 2σ0(aT + c²θ), θ = arctan(1/v)

    edge_ratio       [1]   ≥ 0; 0 without contact
    zone_span        [m]   > 0
    cohesive_stress  [Pa]  > 0

    Returns:  [N]; a float for floats, an array for arrays, which broadcast.
    Source:   Maugis 1992.
    Valid:    In contact or apart.
    Accuracy: 4 ulp above v and T.

    >>> from math import pi
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
    """Return the displacement of the contact circle when its ring of attraction lags behind by ξ: ξ in JKR, 0 in DMT.

        ξ_contact = ξ/(1 + E*T/(σ0R))

    zone_span           [m]   > 0
    reduced_radius      [m]   > 0
    contact_modulus     [Pa]  > 0
    cohesive_stress     [Pa]  > 0
    yield_displacement  [m]   > 0

    Returns:  [m]; a float for floats, an array for arrays, which broadcast.
    Source:   First order in ξ.
    Valid:    ξ ≪ a.
    Accuracy: 3 ulp above T.

    >>> contact_displacement(zone_span=1.0, reduced_radius=1.0, contact_modulus=1.0, cohesive_stress=1.0,
    ...                      yield_displacement=2.0)
    1.0
    """
    return yield_displacement / (1 + contact_modulus / cohesive_stress * (zone_span / reduced_radius))
