"""The contact between JKR and DMT: Maugis' theory, in SI units.

A constant stress σ0 pulls in a ring around the contact circle, a < r < c, up to a gap w/σ0. Two numbers describe a state:
the edge ratio v = a/√(c² − a²), found at a load or at an approach, and the span T = √(c² − a²) of the ring. Where the
spheres attract without contact, v is 0 and T is c. `dugdale` has the same curve in dimensionless form.
"""

from typing import Any

from . import dugdale
from .dimensions import Energy, Force, Length, Moment, Number, Stiffness, Stress, SurfaceEnergy
from .elementary import cbrt, pi, sqrt, where

TRANSITION_OVER_TABOR = 1.1570116348507993  # (32/(9√3))·(9/(16π))^(1/3)


# --- The law of attraction ------------------------------------------------------------------------------------------


def transition_parameter(*, tabor_parameter: Number) -> Number:
    """Maugis' parameter of the transition between JKR (large) and DMT (small).

        λ = 2σ0/(πwK²/R)^(1/3) = (32/(9√3))(9/16π)^(1/3) μ, with K = 4E*/3

    Source:   Maugis 1992, for the peak stress of the 3-9 law.
    Valid:    Always.
    Accuracy: 1 ulp above μ.

    >>> round(transition_parameter(tabor_parameter=1.0), 7)
    1.1570116
    """
    return TRANSITION_OVER_TABOR * tabor_parameter


def cohesive_stress(*, work_of_adhesion: SurfaceEnergy, atomic_spacing: Length) -> Stress:
    """Largest stress with which two surfaces attract.

        σ0 = 16w/(9√3 z0)

    Source:   The peak of the 3-9 law that the Lennard-Jones potential gives for two half-spaces.
    Valid:    Its range, w/σ0 = 0.974 z0, follows from it.
    Accuracy: 2 ulp.

    >>> round(cohesive_stress(work_of_adhesion=9.0, atomic_spacing=16.0), 7)
    0.5773503
    """
    return 1.0264004785593346 * (work_of_adhesion / atomic_spacing)


# --- States ---------------------------------------------------------------------------------------------------------


def edge_ratio_at_load(
    *, load: Force, work_of_adhesion: SurfaceEnergy, reduced_radius: Length, transition_parameter: Number
) -> Number:
    """Edge ratio of the stable contact at a load.

        v = a/√(c² − a²)

    Source:   Maugis 1992, by Newton's method.
    Valid:    Loads from pull-off to 10⁶ times as much. Below, a float raises ValueError and an array holds NaN.
    Accuracy: 10 ulp, times 1 plus its condition in the load and λ.

    >>> unit = {"work_of_adhesion": 1 / pi, "reduced_radius": 1.0}
    >>> round(edge_ratio_at_load(load=0.0, transition_parameter=1.0, **unit), 7)
    1.4102117
    """
    return dugdale.ratio_at_load(transition_parameter, load / (pi * work_of_adhesion * reduced_radius))


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
    unit = _length(work_of_adhesion, reduced_radius, contact_modulus)
    return dugdale.ratio_at_approach(transition_parameter, approach_at_load / unit / unit * reduced_radius)


def edge_ratio_at_pull_off(*, transition_parameter: Number) -> Number:
    """Edge ratio where the tension is largest, and a contact under a constant load breaks.

        q = vG3/D, q = 4λ/(3T)

    Source:   Maugis 1992; in closed form at a given v.
    Valid:    Always.
    Accuracy: 4 ulp.

    >>> round(edge_ratio_at_pull_off(transition_parameter=1.0), 7)
    0.9262053
    """
    return dugdale.pull_off_ratio(transition_parameter)


def edge_ratio_at_fold(*, transition_parameter: Number) -> Number:
    """Edge ratio where fixed grips let go; 0 where they hold on to spheres that attract without contact.

        q = G3/h, q = 4λ/(3T), if λ > (9π/(16(π − 1)))^(1/3) = 0.938

    Source:   Maugis 1992; Johnson & Greenwood 1997; in closed form at a given v.
    Valid:    Always.
    Accuracy: 4 ulp, times 1 plus its condition in λ.

    >>> edge_ratio_at_fold(transition_parameter=0.9)
    0.0
    """
    return dugdale.fold_ratio(transition_parameter)


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
    return span * _length(work_of_adhesion, reduced_radius, contact_modulus)


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
    unit = _length(work_of_adhesion, reduced_radius, contact_modulus)
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
    return hertz - _pull(edge_ratio, zone_span, cohesive_stress)


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


def state_energy_maugis(
    *,
    edge_ratio: Number,
    zone_span: Length,
    approach_at_load: Length,
    work_of_adhesion: SurfaceEnergy,
    reduced_radius: Length,
    contact_modulus: Stress,
    transition_parameter: Number,
) -> Energy:
    """Elastic and surface energy of a state, in contact or apart; 0 for spheres that do not attract.

        Φ = ∫ P dδ, in closed form in `dugdale.energy`

    Source:   Integral of Maugis' solution along its curve.
    Valid:    Quasi-static.
    Accuracy: 30 ulp of its largest term.

    >>> unit = {"work_of_adhesion": 1 / pi, "reduced_radius": 1.0, "contact_modulus": 0.75, "transition_parameter": 0.1}
    >>> phi = state_energy_maugis(edge_ratio=0.0, zone_span=0.0, approach_at_load=-7.0, **unit)
    >>> phi == 0.0
    True
    """
    unit = _length(work_of_adhesion, reduced_radius, contact_modulus)
    reduced = approach_at_load / unit / unit * reduced_radius
    phi = dugdale.energy(transition_parameter, dugdale.shape(edge_ratio), zone_span / unit, reduced)
    return phi * (pi * work_of_adhesion) * unit * unit


# --- Pull-off -------------------------------------------------------------------------------------------------------


def pull_off_force_maugis(
    *, work_of_adhesion: SurfaceEnergy, reduced_radius: Length, transition_parameter: Number
) -> Force:
    """Force that separates two spheres, between (3/2)πwR for soft, large ones and 2πwR for hard, small ones.

        P_c = 2σ0(aT + c²θ) − 4E*a³/(3R) at the edge ratio of pull-off

    Source:   Maugis 1992.
    Valid:    Always; a Lennard-Jones pair lets go up to 6 % later.
    Accuracy: 6 ulp.

    >>> round(pull_off_force_maugis(work_of_adhesion=1 / pi, reduced_radius=1.0, transition_parameter=1.0), 7)
    1.6007349
    """
    at = dugdale.shape(dugdale.pull_off_ratio(transition_parameter))
    least = dugdale.load(transition_parameter, at, dugdale.span(transition_parameter, at))
    return -pi * work_of_adhesion * reduced_radius * least


def pull_off_force_lennard_jones(
    *, work_of_adhesion: SurfaceEnergy, reduced_radius: Length, tabor_parameter: Number
) -> Force:
    """Force that separates two spheres that attract by the 3-9 law of the Lennard-Jones potential.

        P_c = πwR(3/2 + ½/(1 + 1.95 μ^1.4))

    Source:   Fit to numerical solutions of the elastic half-space; tests/tools/lennard_jones.py makes them.
    Valid:    Within 0.3 % for 0.01 ≤ μ ≤ 2.
    Accuracy: As the fit.

    >>> round(pull_off_force_lennard_jones(work_of_adhesion=1 / pi, reduced_radius=1.0, tabor_parameter=1.0), 4)
    1.6695
    """
    return pi * work_of_adhesion * reduced_radius * (1.5 + 0.5 / (1 + 1.95 * tabor_parameter**1.4))


# --- Rolling --------------------------------------------------------------------------------------------------------


def yield_moment_maugis(
    *, edge_ratio: Number, zone_span: Length, cohesive_stress: Stress, yield_displacement: Length
) -> Moment:
    """Moment with which a contact resists when its ring of attraction lags behind by ξ.

        M = (4E*a³/(3R) − P)ξ = 2σ0ξ(aT + c²θ), θ = arctan(1/v)

    Source:   First order in ξ, for any law of attraction; Eq (25) in JKR, 2πwRξ in DMT.
    Valid:    ξ ≪ a.
    Accuracy: 4 ulp above v and T.

    >>> yield_moment_maugis(edge_ratio=0.0, zone_span=1.0, cohesive_stress=1 / pi, yield_displacement=1.0)
    1.0
    """
    return _pull(edge_ratio, zone_span, cohesive_stress) * yield_displacement


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


def hysteresis_moment(*, zone_radius: Length, reduced_radius: Length, adhesion_hysteresis: SurfaceEnergy) -> Moment:
    """Moment of steady rolling that the hysteresis of adhesion supplies.

        M = 2cRΔw, c = a in JKR

    Source:   The ring sweeps an area 2c per unit of path; exact for any law and any ξ.
    Valid:    Δw = w_open − w_close ≤ w.
    Accuracy: 1 ulp above c.

    >>> hysteresis_moment(zone_radius=2.0, reduced_radius=3.0, adhesion_hysteresis=0.5)
    6.0
    """
    return 2 * zone_radius * reduced_radius * adhesion_hysteresis


# --- Energies -------------------------------------------------------------------------------------------------------


def well_energy_maugis(
    *,
    work_of_adhesion: SurfaceEnergy,
    reduced_radius: Length,
    contact_modulus: Stress,
    transition_parameter: Number,
) -> Energy:
    """Energy that binds the two spheres: released from first attraction to equilibrium.

        U = −Φ(P = 0)

    Source:   Integral of Maugis' solution along its curve.
    Valid:    Quasi-static; towards DMT it grows as 2/(πλ) πwR(π²w²R/K²)^(1/3).
    Accuracy: 20 ulp.

    >>> unit = {"work_of_adhesion": 1 / pi, "reduced_radius": 1.0, "contact_modulus": 0.75}
    >>> round(well_energy_maugis(transition_parameter=1.0, **unit), 7)
    2.3098211
    """
    return -_unloaded(transition_parameter) * _energy(work_of_adhesion, reduced_radius, contact_modulus)


def pull_off_work_maugis(
    *,
    work_of_adhesion: SurfaceEnergy,
    reduced_radius: Length,
    contact_modulus: Stress,
    transition_parameter: Number,
) -> Energy:
    """Work to separate the spheres from P = 0 with fixed grips, which hold on to the fold.

        U = Φ(fold) − Φ(P = 0)

    Source:   Integral of Maugis' solution along its curve.
    Valid:    Quasi-static.
    Accuracy: 20 ulp.

    >>> unit = {"work_of_adhesion": 1 / pi, "reduced_radius": 1.0, "contact_modulus": 0.75}
    >>> round(pull_off_work_maugis(transition_parameter=1e6, **unit) / 1.65096362, 5)
    1.27338
    """
    work = _held_to(transition_parameter, dugdale.lowest_approach(transition_parameter)) - _unloaded(
        transition_parameter
    )
    return work * _energy(work_of_adhesion, reduced_radius, contact_modulus)


def pull_off_work_at_dead_load_maugis(
    *,
    work_of_adhesion: SurfaceEnergy,
    reduced_radius: Length,
    contact_modulus: Stress,
    transition_parameter: Number,
) -> Energy:
    """Work to separate the spheres from P = 0 with a load that grows to the pull-off force.

        U = Φ(pull-off) − Φ(P = 0)

    Source:   Integral of Maugis' solution along its curve.
    Valid:    Quasi-static up to the jump.
    Accuracy: 30 ulp of the energy of the well.

    >>> unit = {"work_of_adhesion": 1 / pi, "reduced_radius": 1.0, "contact_modulus": 0.75}
    >>> round(pull_off_work_at_dead_load_maugis(transition_parameter=1e6, **unit) / 1.65096362, 5)
    0.88252
    """
    work = _touching(transition_parameter, dugdale.pull_off_ratio(transition_parameter)) - _unloaded(
        transition_parameter
    )
    return work * _energy(work_of_adhesion, reduced_radius, contact_modulus)


def sticking_energy_maugis(
    *,
    work_of_adhesion: SurfaceEnergy,
    reduced_radius: Length,
    contact_modulus: Stress,
    transition_parameter: Number,
) -> Energy:
    """Largest energy of a head-on collision after which the spheres stick: what jump-in and the fold dissipate.

        U = Φ(fold) − Φ(δ = −w/σ0); (17/24)πλb⁴ πwR(π²w²R/K²)^(1/3), b = 8λ/3π, if λ < (9/32)^(1/3) = 0.655

    Source:   Integral of Maugis' solution along its curve.
    Valid:    Quasi-static; no other loss.
    Accuracy: 10 ulp below λ = 0.655; above, 30 ulp of the energy of the well.

    >>> unit = {"work_of_adhesion": 1 / pi, "reduced_radius": 1.0, "contact_modulus": 0.75}
    >>> round(sticking_energy_maugis(transition_parameter=1e9, **unit) / 1.65096362, 5)
    0.77224
    """
    b = 8 / (3 * pi) * transition_parameter
    apart = 17 / 24 * pi * transition_parameter * b * b * b * b
    met = _held_to(transition_parameter, -2 / (pi * transition_parameter))
    lost = _held_to(transition_parameter, dugdale.lowest_approach(transition_parameter)) - met
    loss = where(transition_parameter < dugdale.JUMP_WITHOUT_CONTACT, apart, lost)
    return loss * _energy(work_of_adhesion, reduced_radius, contact_modulus)


def _length(work_of_adhesion: Any, reduced_radius: Any, contact_modulus: Any) -> Any:
    """Return the unit of lengths along the surface, (πwR²/K)^(1/3)."""
    return cbrt(3 / 4 * pi * (work_of_adhesion / contact_modulus) * reduced_radius * reduced_radius)


def _energy(work_of_adhesion: Any, reduced_radius: Any, contact_modulus: Any) -> Any:
    """Return the unit of energies, πwR(π²w²R/K²)^(1/3)."""
    unit = _length(work_of_adhesion, reduced_radius, contact_modulus)
    return pi * work_of_adhesion * unit * unit


def _pull(edge_ratio: Any, zone_span: Any, cohesive_stress: Any) -> Any:
    """Return the load that the attraction replaces, 2σ0(aT + c²θ)."""
    at = dugdale.shape(edge_ratio)
    return 2 * cohesive_stress * zone_span * zone_span * at.g3


def _unloaded(transition: Any) -> Any:
    """Return Φ without load, dimensionless."""
    return _touching(transition, dugdale.ratio_at_load(transition, 0.0))


def _touching(transition: Any, edge_ratio: Any) -> Any:
    """Return Φ of a contact, dimensionless."""
    at = dugdale.shape(edge_ratio)
    span = dugdale.span(transition, at)
    return dugdale.energy(transition, at, span, dugdale.approach(transition, at, span))


def _held_to(transition: Any, approach: Any) -> Any:
    """Return Φ at an approach, dimensionless, in contact or apart."""
    at = dugdale.shape(dugdale.ratio_at_approach(transition, approach))
    span = where(at.v > 0, dugdale.span(transition, at), dugdale.span_apart(transition, approach))
    return dugdale.energy(transition, at, span, approach)
