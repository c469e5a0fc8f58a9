"""Fit a measured curve: work of adhesion of each branch, contact modulus and contact point, with their errors.

`branches` divides the curve, `measurement` finds the minima of its branches, `error_budget` computes the errors, and
`goodness` measures how well the fit describes the points.
"""

import numpy
from numpy import exp, inf

from ..model.unknowns import SIZES
from ..physics.contact import contact_radius
from ..quantities.laws import JKR, PARABOLOID, SPHERE
from .branches import LOADING, RADIUS, TRAVEL, UNLOADING, BadCurve, ForceCurve, branches_of, largest_tension
from .error_budget import (
    ByResult,
    Minima,
    by_models,
    by_radius,
    by_range,
    covariance_of,
    ends,
    largest,
    statistical_errors,
    with_baselines,
)
from .force_curves import Array, Grip
from .goodness import USUAL_ERROR, goodness_of, on_deflection, on_profile, remarks_on
from .measurement import FittedBranch, Measurement, fitted_branch, fitted_with, fitted_without_adhesion, release_rate
from .minimum import ADHESION, MODULUS, residuals
from .result import Fit, Known, key_of

_STIFFEST = SIZES["youngs_modulus"][1]  # a larger E* counts as infinite


def fit_curve(curve: ForceCurve, known: Known) -> Fit:
    """Return the fit of a curve. Raises BadCurve if the curve cannot be fitted."""
    if curve.kind == RADIUS and known.radius is None:
        raise BadCurve("w from contact radii needs the radius of the sphere: give --radius", "no radius")
    try:
        with numpy.errstate(all="ignore"):
            minima, remarks = _minima(curve, known)
            by_spring = _by_spring(curve, minima, known.stiffness_error or USUAL_ERROR)
            return _result(minima, remarks, by_spring)
    except (ArithmeticError, ValueError):
        raise BadCurve("the fit does not converge; check the radius, the spring and the units", "no fit") from None


def _minima(curve: ForceCurve, known: Known) -> tuple[Minima, dict[str, str]]:
    """Return the minima of the branches of a curve, and remarks by code. Raises BadCurve."""
    only = {"load": LOADING, "unload": UNLOADING}.get(known.branch, "")
    stiffness = known.stiffness if curve.kind == TRAVEL else inf
    branches = branches_of(curve, stiffness, tilt=known.tilt, only=only)
    measurement = Measurement(curve.kind, known, branches)
    remarks = {**branches.remarks, **dict(on_deflection(curve.force_over_deflection, known.stiffness))}
    names = [only] if only else [UNLOADING, LOADING]
    to_fit = [branches.by_name[name] for name in names if name in branches.by_name]
    if not to_fit:
        raise BadCurve(f"the curve has no {names[0]} branch", "branch is missing")
    if not measurement.has_adhesion(to_fit[0]):
        remarks["no-adhesion"] = "no tension above the noise: Hertz' contact, and an upper limit of w"
        main = fitted_without_adhesion(measurement, to_fit[0])
        return Minima(measurement, measurement.without_adhesion, main), remarks
    main, other = fitted_branch(measurement, to_fit[0]), None
    if len(to_fit) > 1:
        try:
            other = fitted_with(measurement, to_fit[1], main)
        except BadCurve as error:  # this branch has too few points in the range
            remarks["branch-left-out"] = f"{error}; the branch is left out"
    return Minima(measurement, measurement.setting, main, other), remarks


def _by_spring(curve: ForceCurve, minima: Minima, error: float) -> list[ByResult]:
    """Return the moves of the results for a softer and a stiffer spring; none if no spring enters.

    The curve is fitted anew, since the results are not linear in the stiffness: a soft spring may make E* infinite. All
    moves are infinite if this fit fails. `error`: the relative error of the stiffness.
    """
    if curve.kind != TRAVEL and not curve.is_deflection:
        return []
    moves = list[ByResult]()
    for factor in ends(error):
        scale = factor if curve.is_deflection else 1.0  # of the forces, which are deflections times the stiffness
        force_error = None if curve.force_error is None else scale * curve.force_error
        known = minima.measurement.known._replace(stiffness=factor * minima.measurement.known.stiffness)
        try:
            there, _ = _minima(curve._replace(force=scale * curve.force, force_error=force_error), known)
            values = there.values
        except (ArithmeticError, BadCurve, ValueError):
            values = {}
        if values.get("contact_modulus", inf) >= _STIFFEST:
            values["contact_modulus"] = inf
        moves.append({name: values.get(name, inf) - value for name, value in minima.values.items()})
    return moves


def _result(minima: Minima, remarks: dict[str, str], by_spring: list[ByResult]) -> Fit:
    """Return the fit with its errors, its results by other laws and its remarks.

    `by_spring`: see `_by_spring`.
    """
    measurement, main = minima.measurement, minima.main
    names, covariance = covariance_of(minima)
    few = minima.thinned()
    covariance = with_baselines(few, names, covariance)
    errors = statistical_errors(minima, names, covariance)
    has_adhesion = ADHESION in main.free
    result = Fit(
        measurement.known, measurement.kind, values=minima.values, errors=errors, names=names, covariance=covariance,
        remarks=remarks, points=_points_of(minima), baselines=_baselines_of(minima),
        fitted_loads=_fitted_loads(minima),
        largest_adhesion=None if has_adhesion else measurement.largest_adhesion,
    )  # fmt: skip
    pull_off = _pull_off(minima) if has_adhesion else None
    tension = largest_tension(main.branch.in_contact)
    if pull_off is not None:
        result.values["pull_off_force_fitted"] = pull_off
        if tension > 0:
            result.values["pull_off_force_measured"] = tension
    result.goodness = goodness_of(minima, pull_off)
    width = float(main.minimum.residuals.radii.max()) / measurement.radius
    if measurement.known.radius is not None:
        result.goodness["contact_over_radius"] = width
        if has_adhesion:
            contact = minima.setting.contact(main.unknowns).without_spacing
            result.goodness["unloaded_contact_over_radius"] = float(contact_radius(**contact)) / measurement.radius
    _add(result, "calibration", [by_radius(few)])
    if measurement.known.stiffness_error:
        _add(result, "calibration", [largest(by_spring)])
    _add(result, "model", [by_range(few)])
    models = by_models(minima, few, width)
    result.by_law = {law: dict(each) for law, each in models.by_law.items()}
    if measurement.known.radius is None:
        scaled = f"w is wR and E* is E*√R, for a paraboloid by {result.theory}"
        result.remarks["radius-free"] = f"no radius is given: {scaled}"
    elif has_adhesion:
        result.goodness["tabor_parameter"] = models.tabor_parameter
    sphere = models.by_law.get(key_of(JKR, SPHERE))
    if sphere is not None and measurement.known.profile == PARABOLOID:
        for text in on_profile(models.by_law[JKR], sphere, result.errors, width, measurement.known):
            result.remarks["profile-matters"] = text
    _add(result, "model", models.moves)
    result.remarks |= dict(remarks_on(minima, result, by_spring))
    return result


def _add(result: Fit, part: str, moves: list[ByResult]) -> None:
    """Add moves of the results to one part of their errors, in quadrature."""
    for name, errors in [*result.errors.items()]:
        result.errors[name] = errors.plus(part, [move[name] for move in moves if name in move])


def _pull_off(minima: Minima) -> float:
    """Return the largest tension of the fitted curve: under a very soft grip, the contact is lost there."""
    setting, unknowns = minima.setting, minima.main.unknowns
    soft = Grip(1e-9 * float(exp(unknowns[MODULUS])) * minima.measurement.radius)
    contact = setting.contact(unknowns)
    return -float(setting.law.values(numpy.float64(setting.law.last(contact, soft)), contact)[0].load)


def _fitted_loads(minima: Minima) -> dict[str, tuple[float, float]]:
    """Return the least and the largest fitted load of each branch."""
    loads = {}
    for part in minima.parts:
        loads[part.branch.name] = float(part.points.force.min()), float(part.points.force.max())
    return loads


def _baselines_of(minima: Minima) -> dict[str, dict[str, float]]:
    """Return the baseline of each branch that has a part out of contact."""
    baselines = {}
    for name, branch in minima.measurement.branches.by_name.items():
        base = branch.baseline
        if base is not None and branch.has_free_part:
            baselines[name] = {
                "force": base.force, "error": base.error, "slope": base.slope, "z": base.z, "noise": base.noise,
            }  # fmt: skip
    return baselines


def _points_of(minima: Minima) -> dict[str, Array]:
    """Return the points in contact of the fitted branches as columns, see `_columns_of`."""
    columns = [_columns_of(minima, part) for part in minima.parts]
    return {name: numpy.concatenate([of_branch[name] for of_branch in columns]) for name in columns[0]}


def _columns_of(minima: Minima, part: FittedBranch) -> dict[str, Array]:
    """Return the points in contact of one branch as columns; z has the sign of the table.

    The energy release rate and the contact radius follow from E* and z_c of the main branch.
    """
    points, main = part.branch.in_contact, minima.main.unknowns
    loads = residuals(points, part.unknowns, minima.setting).loads
    rate, radius = release_rate(minima.measurement, points, main)
    if ADHESION not in minima.main.free:
        rate, radius = numpy.full((2, len(rate)), numpy.nan)
    return {
        "z": points.z * minima.measurement.branches.sign, "force": points.force, "model": loads,
        "residual": points.force - loads, "release_rate": rate, "contact_radius": radius,
        "branch": numpy.full(len(points.z), part.branch.name),
    }  # fmt: skip
