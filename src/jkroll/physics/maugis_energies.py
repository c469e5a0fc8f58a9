"""The energies of a Maugis contact: of a state, and between the states where it forms and breaks."""

from __future__ import annotations

from typing import Any

from . import dugdale, dugdale_roots
from .dimensions import Energy, Length, Number, Stress, SurfaceEnergy
from .elementary import pi, where


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

    edge_ratio            [1]     ≥ 0; 0 without contact
    zone_span             [m]     ≥ 0
    work_of_adhesion      [J/m²]  > 0
    reduced_radius        [m]     > 0
    contact_modulus       [Pa]    > 0
    transition_parameter  [1]     > 0

    Returns:  [J]; a float for floats, an array for arrays, which broadcast.
    Source:   Integral of Maugis' solution along its curve.
    Valid:    Quasi-static.
    Accuracy: 30 ulp of its largest term.

    >>> unit = {"work_of_adhesion": 1 / pi, "reduced_radius": 1.0, "contact_modulus": 0.75, "transition_parameter": 0.1}
    >>> phi = state_energy_maugis(edge_ratio=0.0, zone_span=0.0, **unit)
    >>> phi == 0.0
    True
    """
    unit = dugdale.length_unit(work_of_adhesion, reduced_radius, contact_modulus)
    at, span = dugdale.shape(edge_ratio), zone_span / unit
    touching = dugdale.approach(transition_parameter, at, span)
    approach = where(edge_ratio > 0, touching, dugdale.approach_apart(transition_parameter, span))
    phi = dugdale.energy(transition_parameter, at, span, approach)
    return phi * (pi * work_of_adhesion) * unit * unit


def well_energy_maugis(
    *,
    work_of_adhesion: SurfaceEnergy,
    reduced_radius: Length,
    contact_modulus: Stress,
    transition_parameter: Number,
) -> Energy:
    """Return the energy that binds the two spheres: released from first attraction to equilibrium.

        U = −Φ(P = 0)

    work_of_adhesion      [J/m²]  > 0
    reduced_radius        [m]     > 0
    contact_modulus       [Pa]    > 0
    transition_parameter  [1]     > 0

    Returns:  [J]; a float for floats, an array for arrays, which broadcast.
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
    """Return the work to separate the spheres from P = 0 with fixed grips, which hold on to the fold.

        U = Φ(fold) − Φ(P = 0)

    work_of_adhesion      [J/m²]  > 0
    reduced_radius        [m]     > 0
    contact_modulus       [Pa]    > 0
    transition_parameter  [1]     > 0

    Returns:  [J]; a float for floats, an array for arrays, which broadcast.
    Source:   Integral of Maugis' solution along its curve.
    Valid:    Quasi-static.
    Accuracy: 20 ulp.

    >>> unit = {"work_of_adhesion": 1 / pi, "reduced_radius": 1.0, "contact_modulus": 0.75}
    >>> round(pull_off_work_maugis(transition_parameter=1e6, **unit) / 1.65096362, 5)
    1.27338
    """
    work = _held_to(transition_parameter, dugdale_roots.lowest_approach(transition_parameter)) - _unloaded(
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
    """Return the work to separate the spheres from P = 0 with a load that grows to the pull-off force.

        U = Φ(pull-off) − Φ(P = 0)

    work_of_adhesion      [J/m²]  > 0
    reduced_radius        [m]     > 0
    contact_modulus       [Pa]    > 0
    transition_parameter  [1]     > 0

    Returns:  [J]; a float for floats, an array for arrays, which broadcast.
    Source:   Integral of Maugis' solution along its curve.
    Valid:    Quasi-static up to the jump.
    Accuracy: 30 ulp of the energy of the well.

    >>> unit = {"work_of_adhesion": 1 / pi, "reduced_radius": 1.0, "contact_modulus": 0.75}
    >>> round(pull_off_work_at_dead_load_maugis(transition_parameter=1e6, **unit) / 1.65096362, 5)
    0.88252
    """
    work = _touching(transition_parameter, dugdale_roots.pull_off_ratio(transition_parameter)) - _unloaded(
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
    """Return the largest energy of a head-on collision after which the spheres stick: what jump-in and the fold dissipate.

        U = Φ(fold) − Φ(δ = −w/σ0); (17/24)πλb⁴ πwR(π²w²R/K²)^(1/3), b = 8λ/3π, if λ < (9/32)^(1/3) = 0.655

    work_of_adhesion      [J/m²]  > 0
    reduced_radius        [m]     > 0
    contact_modulus       [Pa]    > 0
    transition_parameter  [1]     > 0

    Returns:  [J]; a float for floats, an array for arrays, which broadcast.
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
    lost = _held_to(transition_parameter, dugdale_roots.lowest_approach(transition_parameter)) - met
    loss = where(transition_parameter < dugdale.JUMP_WITHOUT_CONTACT, apart, lost)
    return loss * _energy(work_of_adhesion, reduced_radius, contact_modulus)


def _energy(work_of_adhesion: Any, reduced_radius: Any, contact_modulus: Any) -> Any:
    """Return the unit of energies, πwR(π²w²R/K²)^(1/3)."""
    unit = dugdale.length_unit(work_of_adhesion, reduced_radius, contact_modulus)
    return pi * work_of_adhesion * unit * unit


def _unloaded(transition: Any) -> Any:
    """Return Φ without load, dimensionless."""
    return _touching(transition, dugdale_roots.ratio_at_load(transition, 0.0))


def _touching(transition: Any, edge_ratio: Any) -> Any:
    """Return Φ of a contact, dimensionless."""
    at = dugdale.shape(edge_ratio)
    span = dugdale.span(transition, at)
    return dugdale.energy(transition, at, span, dugdale.approach(transition, at, span))


def _held_to(transition: Any, approach: Any) -> Any:
    """Return Φ at an approach, dimensionless, in contact or apart."""
    at = dugdale.shape(dugdale_roots.ratio_at_approach(transition, approach))
    span = where(at.v > 0, dugdale.span(transition, at), dugdale.span_apart(transition, approach))
    return dugdale.energy(transition, at, span, approach)
