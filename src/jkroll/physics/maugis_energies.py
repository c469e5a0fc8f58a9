"""The energies of a Maugis contact: of a state, and between the states where it forms and breaks."""

from __future__ import annotations

from . import dugdale
from .dimensions import Energy, FloatOrArray, Force, Length, Number, Stress, SurfaceEnergy
from .elementary import at_most, pi, where

# Gauss-Legendre quadrature: places to either side of the middle of an interval, and their weights.
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
    work_of_adhesion: SurfaceEnergy,
    reduced_radius: Length,
    contact_modulus: Stress,
    transition_parameter: Number,
) -> Energy:
    """Return the elastic and surface energy of a state, in contact or apart; 0 for spheres that do not attract.

        Φ = ∫ P dδ, in closed form in `dugdale.energy`

    Source:   Integral of Maugis' solution along its curve.
    Valid:    Quasi-static.
    """
    unit = dugdale.length_unit(work_of_adhesion, reduced_radius, contact_modulus)
    phi = _of_state(transition_parameter, dugdale.shape(edge_ratio), zone_span / unit)
    return phi * _energy(work_of_adhesion, reduced_radius, contact_modulus)


def well_energy_maugis(
    *,
    unloaded_edge_ratio: Number,
    work_of_adhesion: SurfaceEnergy,
    reduced_radius: Length,
    contact_modulus: Stress,
    transition_parameter: Number,
) -> Energy:
    """Return the energy that binds the two spheres: released from first attraction to equilibrium.

        U = −Φ(P = 0)

    Source:   Integral of Maugis' solution along its curve.
    Valid:    Quasi-static; towards DMT it grows as 2/(πλ) πwR(π²w²R/K²)^(1/3).
    """
    unit = _energy(work_of_adhesion, reduced_radius, contact_modulus)
    return -_of(transition_parameter, unloaded_edge_ratio) * unit  # stationary in v, as dΦ = P dδ


def pull_off_work_maugis(
    *,
    unloaded_edge_ratio: Number,
    edge_ratio_at_fold: Number,
    work_of_adhesion: SurfaceEnergy,
    reduced_radius: Length,
    contact_modulus: Stress,
    transition_parameter: Number,
) -> Energy:
    """Return the work to separate the spheres from P = 0 with fixed grips, which hold on to the fold.

        U = Φ(fold) − Φ(P = 0)

    Source:   Integral of Maugis' solution along its curve.
    Valid:    Quasi-static.
    """
    fold = _of(transition_parameter, edge_ratio_at_fold)
    unit = _energy(work_of_adhesion, reduced_radius, contact_modulus)
    return (fold - _of(transition_parameter, unloaded_edge_ratio)) * unit


def pull_off_work_at_dead_load_maugis(
    *,
    unloaded_edge_ratio: Number,
    edge_ratio_at_pull_off: Number,
    work_of_adhesion: SurfaceEnergy,
    reduced_radius: Length,
    contact_modulus: Stress,
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
    for place, weight in _EIGHT_POINTS:
        for edge_ratio in (middle - place * half, middle + place * half):
            ring = dugdale.shape(edge_ratio)
            span = dugdale.span(transition_parameter, ring)
            slope = dugdale.approach_slope(transition_parameter, ring, span)
            work = work + weight * half * slope * dugdale.load(transition_parameter, ring, span)
    return work * _energy(work_of_adhesion, reduced_radius, contact_modulus)


def sticking_energy_maugis(
    *,
    edge_ratio_at_fold: Number,
    work_of_adhesion: SurfaceEnergy,
    reduced_radius: Length,
    contact_modulus: Stress,
    transition_parameter: Number,
) -> Energy:
    """Return the largest energy of a head-on collision after which spheres stick: what jump-in and the fold take.

        U = Φ(fold) − Φ(δ = −w/σ0); (17/24)πλb⁴ πwR(π²w²R/K²)^(1/3), b = 8λ/3π, if λ < (9/32)^(1/3) = 0.655

    Source:   Integral of Maugis' solution along its curve.
    Valid:    Quasi-static; no other loss.
    """
    unit = _energy(work_of_adhesion, reduced_radius, contact_modulus)
    small = at_most(transition_parameter, dugdale.JUMP_WITHOUT_CONTACT)
    b = dugdale.half_width(small)
    apart = 17 / 24 * pi * unit * small * b * b * b * b  # in this order, no product underflows before the result
    met = _held_to(transition_parameter, -2 / (pi * transition_parameter), edge_ratio_at_fold)
    fold = _of(transition_parameter, edge_ratio_at_fold)
    return where(transition_parameter < dugdale.JUMP_WITHOUT_CONTACT, apart, (fold - met) * unit)


def _energy(
    work_of_adhesion: FloatOrArray, reduced_radius: FloatOrArray, contact_modulus: FloatOrArray
) -> FloatOrArray:
    """Return the unit of energies, πwR(π²w²R/K²)^(1/3)."""
    unit = dugdale.approach_unit(work_of_adhesion, reduced_radius, contact_modulus)
    return pi * work_of_adhesion * reduced_radius * unit


def _of(transition: FloatOrArray, edge_ratio: FloatOrArray) -> FloatOrArray:
    """Return Φ of a contact, or at the fold of spheres that do not touch, dimensionless."""
    ring = dugdale.shape(edge_ratio)
    span = where(ring.v > 0, dugdale.span(transition, ring), dugdale.half_width(transition))
    return _of_state(transition, ring, span)


def _of_state(transition: FloatOrArray, ring: dugdale.Shape, span: FloatOrArray) -> FloatOrArray:
    """Return Φ of a state, in contact or apart, dimensionless."""
    touching = dugdale.approach(transition, ring, span)
    approach = where(ring.v > 0, touching, dugdale.approach_apart(transition, span))
    return dugdale.energy(transition, ring, span, approach)


def _held_to(transition: FloatOrArray, approach: FloatOrArray, least: FloatOrArray) -> FloatOrArray:
    """Return Φ at an approach, dimensionless, in contact or apart; `least` is v at the fold."""
    fold = dugdale.lowest_approach(transition, least)
    ring = dugdale.shape(dugdale.ratio_at_approach(transition, approach, least, fold))
    span = where(ring.v > 0, dugdale.span(transition, ring), dugdale.span_apart(transition, approach))
    return dugdale.energy(transition, ring, span, approach)


def fold_energy_maugis(*, pull_off_force: Force, fold_approach_maugis: Length) -> Energy:
    """Return the product of the pull-off force and the depth at which fixed grips let go.

        F_cδ_c = −P_c δ_fold

    Source:   As in JKR, from the force and the approach of this law.
    """
    return -pull_off_force * fold_approach_maugis
