"""A contact between JKR and DMT: Maugis' theory, in SI units.

A constant stress σ0 pulls in a ring around the contact circle, a < r < c, up to a gap w/σ0. Two numbers describe a
state: the edge ratio v = a/√(c² − a²), found at a load or at an approach, and the span T = √(c² − a²) of the ring.
Where the spheres attract without contact, v is 0 and T is c. `dugdale` has the same curve in dimensionless form.
"""

from __future__ import annotations

from . import dugdale
from .dimensions import Energy, Force, Length, Number, Stiffness, Stress, SurfaceEnergy
from .elementary import FloatOrArray, arctan, at_least, at_most, cbrt, cube, pi, sqrt, where, within


def length_unit_maugis(*, work_of_adhesion: SurfaceEnergy, reduced_radius: Length, contact_modulus: Stress) -> Length:
    """Return the unit of lengths along the surface.

        (πwR²/K)^(1/3), K = 4E*/3

    Source:   Maugis 1992.
    """
    return cbrt(3 / 4 * pi * work_of_adhesion * reduced_radius**2 / contact_modulus)


def approach_unit_maugis(*, work_of_adhesion: SurfaceEnergy, reduced_radius: Length, contact_modulus: Stress) -> Length:
    """Return the unit of approaches.

        (π²w²R/K²)^(1/3), K = 4E*/3

    Source:   Maugis 1992.
    """
    return cbrt(9 / 16 * pi**2 * work_of_adhesion**2 * reduced_radius / contact_modulus**2)


def energy_unit_maugis(
    *, work_of_adhesion: SurfaceEnergy, reduced_radius: Length, approach_unit_maugis: Length
) -> Energy:
    """Return the unit of energies: that of loads, πwR, times that of approaches.

        πwR(π²w²R/K²)^(1/3), K = 4E*/3

    Source:   Maugis 1992.
    """
    return pi * work_of_adhesion * reduced_radius * approach_unit_maugis


def edge_ratio_at_load(
    *,
    load: Force,
    edge_ratio_at_pull_off: Number,
    pull_off_force_maugis: Force,
    work_of_adhesion: SurfaceEnergy,
    reduced_radius: Length,
    transition_parameter: Number,
) -> Number:
    """Return the edge ratio of the stable contact at a load.

        v = a/√(c² − a²)

    Source:   Maugis 1992, by Newton's method.
    Valid:    Loads above pull-off. Below, a float raises ValueError and an array holds NaN.
    """
    unit = pi * work_of_adhesion * reduced_radius
    tension = pull_off_force_maugis / unit
    return dugdale.ratio_at_load(transition_parameter, load / unit, edge_ratio_at_pull_off, tension)


def edge_ratio_at_approach(
    *,
    edge_ratio_at_fold: Number,
    fold_approach_maugis: Length,
    approach_at_load: Length,
    approach_unit_maugis: Length,
    transition_parameter: Number,
) -> Number:
    """Return the edge ratio of the contact that fixed grips hold at an approach; 0 without contact.

        v = a/√(c² − a²)

    Source:   Maugis 1992, by Newton's method.
    Valid:    Approaches above the fold. Beyond, a float raises ValueError and an array holds NaN.
    """
    approach, fold = approach_at_load / approach_unit_maugis, fold_approach_maugis / approach_unit_maugis
    return dugdale.ratio_at_approach(transition_parameter, approach, edge_ratio_at_fold, fold)


def zone_span(*, edge_ratio: Number, length_unit_maugis: Length, transition_parameter: Number) -> Length:
    """Return the span √(c² − a²) of the ring of attraction around a contact.

        T = (πwR²/K)^(1/3)/(⅔λ²G2 + √((⅔λ²G2)² + λG1/2))

    Source:   Maugis 1992, solved for T; λ, G1 and G2 are those of `dugdale`.
    Valid:    In contact.
    """
    return dugdale.span(transition_parameter, dugdale.Shape(edge_ratio)) * length_unit_maugis


def zone_span_at_approach(
    *,
    edge_ratio: Number,
    approach_at_load: Length,
    length_unit_maugis: Length,
    approach_unit_maugis: Length,
    transition_parameter: Number,
) -> Length:
    """Return the span √(c² − a²) of the ring of attraction; without contact, the radius c of the zone of attraction.

        T of `zone_span` in contact
        T = c apart, with c²/2 − bc = δ + 2/(πλ), b = 8λ/3π, in the units of `dugdale`

    Source:   Maugis 1992; Johnson & Greenwood 1997.
    Valid:    Approaches above the fold.
    """
    touching = dugdale.span(transition_parameter, dugdale.Shape(edge_ratio))
    apart = dugdale.span_apart(transition_parameter, approach_at_load / approach_unit_maugis)
    return where(edge_ratio == 0, apart, touching) * length_unit_maugis


# --- Radii, load, approach and stiffness in a state -------------------------------------------------------------------


def contact_radius_maugis(*, edge_ratio: Number, zone_span: Length) -> Length:
    """Return the radius of the contact circle; 0 where the spheres attract without contact.

        a = vT

    Source:   Maugis 1992.
    Valid:    a ≪ R.
    """
    return edge_ratio * zone_span


def zone_radius(*, edge_ratio: Number, zone_span: Length) -> Length:
    """Return the radius of the outer edge of the ring of attraction, where bonds break.

        c = T√(1 + v²)

    Source:   Maugis 1992.
    Valid:    c ≪ R.
    """
    return zone_span * sqrt(1 + edge_ratio * edge_ratio)


def approach_maugis(
    *, edge_ratio: Number, zone_span: Length, reduced_radius: Length, contact_modulus: Stress, cohesive_stress: Stress
) -> Length:
    """Return the approach of the centres in a state of the contact.

        δ = a²/R − 2σ0T/E*

    Source:   Maugis 1992.
    Valid:    In contact.
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

        δ = 3P/(4E*a) + (σ0T/(2E*))(3(v + 1/v)θ − 1), θ = arctan(1/v), for v > 1, where less cancels in this form
        δ of `approach_maugis` for v ≤ 1

    Source:   Maugis 1992.
    Valid:    In contact.
    """
    depth = cohesive_stress / contact_modulus * zone_span
    v = at_least(edge_ratio, 1.0)
    by_load = 3 / 4 * load / (contact_modulus * zone_span * v) + depth * (3 / 2 * (v + 1 / v) * arctan(1 / v) - 1 / 2)
    a = edge_ratio * zone_span
    return where(edge_ratio > 1, by_load, a * a / reduced_radius - 2 * depth)


def load_maugis(
    *, edge_ratio: Number, zone_span: Length, reduced_radius: Length, contact_modulus: Stress, cohesive_stress: Stress
) -> Force:
    """Return the load that holds a state, in contact or apart.

        P = 4E*a³/(3R) − 2σ0(aT + c²θ), θ = arctan(1/v)

    Source:   Maugis 1992.
    """
    hertz = 4 / 3 * contact_modulus * cube(edge_ratio * zone_span) / reduced_radius
    return hertz - 2 * cohesive_stress * zone_span * zone_span * dugdale.Shape(edge_ratio).g3


def stiffness_maugis(
    *, edge_ratio: Number, zone_span: Length, reduced_radius: Length, contact_modulus: Stress, cohesive_stress: Stress
) -> Stiffness:
    """Return the normal stiffness of a state, in contact or apart; negative where only fixed grips hold the spheres.

        dP/dδ = 2E*T (vG3 − qD)/(G3 − qh), q = 2σ0R/(E*T); the functions of v are those of `dugdale`

    Source:   Derivative of Maugis' solution along its curve.
    Valid:    Above the fold.
    """
    ring = dugdale.Shape(edge_ratio)
    q = 2 * cohesive_stress * reduced_radius / (contact_modulus * zone_span)
    return 2 * contact_modulus * zone_span * dugdale.stiffness_ratio(ring, q)


def adhesive_force_maugis(*, edge_ratio: Number, zone_span: Length, cohesive_stress: Stress) -> Force:
    """Return Hertz' load at the contact radius minus the load: the rolling moment per displacement of the ring.

        F_a = 4E*a³/(3R) − P = 2σ0(aT + c²θ), θ = arctan(1/v)

    Source:   Maugis 1992.
    Valid:    In contact or apart.
    """
    return 2 * cohesive_stress * zone_span * zone_span * dugdale.Shape(edge_ratio).g3


def contact_displacement_maugis(
    *,
    edge_ratio: Number,
    zone_span: Length,
    reduced_radius: Length,
    contact_modulus: Stress,
    cohesive_stress: Stress,
    yield_displacement: Length,
) -> Length:
    """Return the displacement of the contact circle when its ring of attraction lags behind by ξ: ξ in JKR, 0 in DMT.

        ξ_contact = ξ/(1 + E*T/(σ0R))

    Source:   Maugis' contact with a ring that is displaced by ξ, to first order in ξ.
    Valid:    ξ ≪ a. Without contact, a float raises ValueError and an array holds NaN.
    """
    lag = within(edge_ratio > 0, yield_displacement)
    return lag / (1 + contact_modulus * zone_span / (cohesive_stress * reduced_radius))


# --- Named states: without load, at pull-off, and where fixed grips let go --------------------------------------------


def unloaded_edge_ratio(*, transition_parameter: Number) -> Number:
    """Return the edge ratio of the stable contact without load.

        v where P = 0: q = 4v³/(3G3), q = 4λ/(3T)

    Source:   Maugis 1992, by Halley's method; G3 and T are those of `dugdale`.
    """
    return dugdale.unloaded_ratio(transition_parameter)


def unloaded_radius_maugis(
    *, unloaded_edge_ratio: Number, length_unit_maugis: Length, transition_parameter: Number
) -> Length:
    """Return the radius of the contact circle without load.

        a0 = (3R·2σ0T²G3/(4E*))^(1/3), where P = 0

    Source:   Maugis 1992.
    Valid:    a0 ≪ R.
    """
    ring = dugdale.Shape(unloaded_edge_ratio)
    span = dugdale.span(transition_parameter, ring)
    return dugdale.unloaded_radius(transition_parameter, ring, span) * length_unit_maugis


def unloaded_approach_maugis(
    *, unloaded_edge_ratio: Number, unloaded_radius_maugis: Length, contact_modulus: Stress, cohesive_stress: Stress
) -> Length:
    """Return the approach of the centres without load.

        δ0 = (σ0T/E*)(3G3/(2v) − 2), T = a0/v

    Source:   Maugis 1992.
    Valid:    a0 ≪ R.
    """
    v = unloaded_edge_ratio
    depth = cohesive_stress * unloaded_radius_maugis / (contact_modulus * v)
    return depth * (3 / 2 * dugdale.Shape(v).g3 / v - 2)  # in which almost nothing cancels


def edge_ratio_at_pull_off(*, transition_parameter: Number) -> Number:
    """Return the edge ratio where the tension is largest, and a contact under a constant load breaks.

        q = vG3/D, q = 4λ/(3T)

    Source:   Maugis 1992, by Halley's method; G3, D and T are those of `dugdale`.
    """
    return dugdale.pull_off_ratio(transition_parameter)


def pull_off_force_maugis(
    *,
    edge_ratio_at_pull_off: Number,
    work_of_adhesion: SurfaceEnergy,
    reduced_radius: Length,
    transition_parameter: Number,
) -> Force:
    """Return the force that separates two spheres, between (3/2)πwR for soft, large ones and 2πwR for hard, small ones.

        P_c = 2σ0(aT + c²θ) − 4E*a³/(3R)

    Source:   Maugis 1992; P is stationary in v.
    Valid:    Always; the pull-off force of a Lennard-Jones pair is up to 6 % larger.
    """
    ring = dugdale.Shape(edge_ratio_at_pull_off)
    load = dugdale.load(transition_parameter, ring, dugdale.span(transition_parameter, ring))
    return -pi * work_of_adhesion * reduced_radius * load


def edge_ratio_at_fold(*, transition_parameter: Number) -> Number:
    """Return the edge ratio where fixed grips let go; 0 where they hold on to spheres that attract without contact.

        q = G3/h, q = 4λ/(3T), if λ > (9π/(16(π − 1)))^(1/3) = 0.938

    Source:   Maugis 1992; Johnson & Greenwood 1997; by Halley's method, with G3, h and T of `dugdale`.
    """
    return dugdale.fold_ratio(transition_parameter)


def fold_approach_maugis(
    *, edge_ratio_at_fold: Number, approach_unit_maugis: Length, transition_parameter: Number
) -> Length:
    """Return the least approach at which fixed grips hold the spheres, in contact or apart.

        δ at q = G3/h, q = 4λ/(3T); −b²/2 − 2/(πλ), b = 8λ/3π, in the units of `dugdale`, if λ < 0.938

    Source:   Maugis 1992; Johnson & Greenwood 1997.
    """
    return dugdale.lowest_approach(transition_parameter, edge_ratio_at_fold) * approach_unit_maugis


def contact_radius_at_pull_off_maugis(
    *, edge_ratio_at_pull_off: Number, length_unit_maugis: Length, transition_parameter: Number
) -> Length:
    """Return the radius of the contact circle at which a constant tension breaks the contact.

        a_pull = v_pull T

    Source:   Maugis 1992.
    Valid:    Always; it tends to 0 in DMT.
    """
    span = dugdale.span(transition_parameter, dugdale.Shape(edge_ratio_at_pull_off))
    return edge_ratio_at_pull_off * span * length_unit_maugis


def contact_radius_at_fold_maugis(
    *, edge_ratio_at_fold: Number, length_unit_maugis: Length, transition_parameter: Number
) -> Length:
    """Return the radius of the contact circle at which fixed grips let go.

        a_fold = v_fold T; 0 if λ < 0.938, where they hold on to spheres that attract without contact

    Source:   Maugis 1992; Johnson & Greenwood 1997.
    """
    span = dugdale.span(transition_parameter, dugdale.Shape(edge_ratio_at_fold))
    return edge_ratio_at_fold * span * length_unit_maugis


def approach_at_pull_off_maugis(
    *, edge_ratio_at_pull_off: Number, approach_unit_maugis: Length, transition_parameter: Number
) -> Length:
    """Return the approach of the centres at which a constant tension breaks the contact.

        δ_pull = a_pull² − (4/3)λT, in the units of `dugdale`

    Source:   Maugis 1992.
    Valid:    Always. It is negative, and tends to 0 in DMT.
    """
    ring = dugdale.Shape(edge_ratio_at_pull_off)
    return dugdale.approach(transition_parameter, ring, dugdale.span(transition_parameter, ring)) * approach_unit_maugis


# --- Energies: of a state, and between the states where a contact forms and breaks ------------------------------------

# Gauss-Legendre quadrature: positions on each side of the middle of an interval, and their weights.
_EIGHT_POINTS = (
    (0.1834346424956498, 0.362683783378362),
    (0.525532409916329, 0.31370664587788727),
    (0.7966664774136267, 0.22238103445337448),
    (0.9602898564975363, 0.10122853629037626),
)


def state_energy_maugis(
    *,
    edge_ratio: Number,
    zone_span: Length,
    length_unit_maugis: Length,
    energy_unit_maugis: Energy,
    transition_parameter: Number,
) -> Energy:
    """Return the elastic and surface energy of a state, in contact or apart; 0 for spheres that do not attract.

        Φ = ∫ P dδ, in closed form in `dugdale.energy`

    Source:   Integral of Maugis' solution along its curve.
    Valid:    Quasi-static.
    """
    ring = dugdale.Shape(edge_ratio)
    return _state_energy(transition_parameter, ring, zone_span / length_unit_maugis) * energy_unit_maugis


def well_energy_maugis(
    *, unloaded_edge_ratio: Number, energy_unit_maugis: Energy, transition_parameter: Number
) -> Energy:
    """Return the energy that binds the two spheres: released from first attraction to equilibrium.

        U = −Φ(P = 0)

    Source:   Integral of Maugis' solution along its curve.
    Valid:    Quasi-static; towards DMT it grows as 2/(πλ) πwR(π²w²R/K²)^(1/3).
    """
    energy = _contact_energy(transition_parameter, unloaded_edge_ratio)  # stationary in v, as dΦ = P dδ
    return -energy * energy_unit_maugis


def pull_off_work_maugis(
    *, unloaded_edge_ratio: Number, edge_ratio_at_fold: Number, energy_unit_maugis: Energy, transition_parameter: Number
) -> Energy:
    """Return the work to separate the spheres from P = 0 with fixed grips, which hold them as far as the fold.

        U = Φ(fold) − Φ(P = 0)

    Source:   Integral of Maugis' solution along its curve.
    Valid:    Quasi-static.
    """
    fold = _contact_energy(transition_parameter, edge_ratio_at_fold)
    unloaded = _contact_energy(transition_parameter, unloaded_edge_ratio)
    return (fold - unloaded) * energy_unit_maugis


def pull_off_work_at_dead_load_maugis(
    *,
    unloaded_edge_ratio: Number,
    edge_ratio_at_pull_off: Number,
    energy_unit_maugis: Energy,
    transition_parameter: Number,
) -> Energy:
    """Return the work to separate the spheres from P = 0 with a load that grows to the pull-off force.

        U = ∫ P dδ from P = 0 to pull-off, which is 1.2πwRδ0 in DMT

    Source:   Maugis' solution along its curve, by Gauss-Legendre quadrature; Φ would cancel where λ is small.
    Valid:    Quasi-static up to the jump.
    """
    middle = (edge_ratio_at_pull_off + unloaded_edge_ratio) / 2
    half = (edge_ratio_at_pull_off - unloaded_edge_ratio) / 2
    work: FloatOrArray = 0.0
    for position, weight in _EIGHT_POINTS:
        for edge_ratio in (middle - position * half, middle + position * half):
            ring = dugdale.Shape(edge_ratio)
            span = dugdale.span(transition_parameter, ring)
            slope = dugdale.approach_slope(transition_parameter, ring, span)
            work = work + weight * half * slope * dugdale.load(transition_parameter, ring, span)
    return work * energy_unit_maugis


def sticking_energy_maugis(
    *, edge_ratio_at_fold: Number, energy_unit_maugis: Energy, transition_parameter: Number
) -> Energy:
    """Return the largest energy of a head-on collision after which spheres stick: jump-in and the fold dissipate it.

        U = Φ(fold) − Φ(δ = −w/σ0); (17/24)πλb⁴ πwR(π²w²R/K²)^(1/3), b = 8λ/3π, if λ < (9/32)^(1/3) = 0.655

    Source:   Integral of Maugis' solution along its curve.
    Valid:    Quasi-static; no other loss.
    """
    small = at_most(transition_parameter, dugdale.JUMP_WITHOUT_CONTACT)
    b = dugdale.span_at_fold_apart(small)
    # In this order, no product underflows before the result.
    apart = 17 / 24 * pi * energy_unit_maugis * small * b * b * b * b
    jumped = _energy_at_approach(transition_parameter, -2 / (pi * transition_parameter), edge_ratio_at_fold)
    fold = _contact_energy(transition_parameter, edge_ratio_at_fold)
    return where(transition_parameter < dugdale.JUMP_WITHOUT_CONTACT, apart, (fold - jumped) * energy_unit_maugis)


def fold_energy_maugis(*, pull_off_force: Force, fold_approach_maugis: Length) -> Energy:
    """Return the pull-off force times the stretch −δ at which fixed grips let go, a unit of energies.

        F_cδ_c = −P_c δ_fold

    Source:   As in JKR, from the force and the approach of this law.
    """
    return -pull_off_force * fold_approach_maugis


def _contact_energy(transition: FloatOrArray, edge_ratio: FloatOrArray) -> FloatOrArray:
    """Return Φ of a contact, or at the fold of spheres that do not touch, dimensionless."""
    ring = dugdale.Shape(edge_ratio)
    span = where(ring.v > 0, dugdale.span(transition, ring), dugdale.span_at_fold_apart(transition))
    return _state_energy(transition, ring, span)


def _state_energy(transition: FloatOrArray, ring: dugdale.Shape, span: FloatOrArray) -> FloatOrArray:
    """Return Φ of a state, in contact or apart, dimensionless."""
    touching = dugdale.approach(transition, ring, span)
    approach = where(ring.v > 0, touching, dugdale.approach_apart(transition, span))
    return dugdale.energy(transition, ring, span, approach)


def _energy_at_approach(transition: FloatOrArray, approach: FloatOrArray, least: FloatOrArray) -> FloatOrArray:
    """Return Φ at an approach, dimensionless, in contact or apart; `least` is v at the fold."""
    fold = dugdale.lowest_approach(transition, least)
    ring = dugdale.Shape(dugdale.ratio_at_approach(transition, approach, least, fold))
    span = where(ring.v > 0, dugdale.span(transition, ring), dugdale.span_apart(transition, approach))
    return dugdale.energy(transition, ring, span, approach)
