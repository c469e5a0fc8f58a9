"""The three errors of a fit: statistical (noise), calibration (the instrument) and model.

The statistical error comes from the noise of the points, and of the baselines that are subtracted from them. The
calibration error comes from the radius and the spring: each is changed by its error, down and up, and adds the larger
of the two changes of a result. The model error comes from changes of the fitted range, the shape of the sphere, the law
and the atomic spacing. A change of a result is called its move. To save time, all moves but the spring's are computed
from few points, see `Minima.thinned`.
"""

from collections.abc import Callable, Iterator, Mapping, Sequence
from functools import partial
from math import ceil
from typing import NamedTuple

import numpy
from numpy import exp, inf, sqrt

from ..physics.contact import tabor_parameter
from ..quantities.laws import DMT, JKR, MAUGIS, PARABOLOID, SPHERE
from .baseline import Baseline
from .branches import LEAST_POINTS
from .force_curves import Array
from .measurement import WORK_OF_ADHESION, FittedBranch, Measurement
from .minimum import ADHESION, MODULUS, POINT, Minimum, Points, Setting, minimum, with_point
from .result import HALF_SPACING, LEAST_TABOR, Errors, best_law, key_of

_FEW = 300  # largest number of points of a branch in a refit that computes moves
_ALIKE = 50.0  # Tabor parameter above which Maugis' law equals JKR's
_WIDE = 0.1  # a/R above which the shape of the sphere matters

ByResult = Mapping[str, float]  # values of results, or their moves, by name


def _unchanged(part: FittedBranch) -> Points:
    """Return the fitted points of a branch, unchanged."""
    return part.points


class Minima(NamedTuple):
    """The minima of a curve: of the main branch, and of the other branch with E* and z_c of the main branch.

    The main branch is the one that `--branch` names; by default unloading, if the curve has it.
    """

    measurement: Measurement
    setting: Setting
    main: FittedBranch
    other: FittedBranch | None = None

    @property
    def parts(self) -> list[FittedBranch]:
        """The fitted branches, the main one first."""
        return [self.main] if self.other is None else [self.main, self.other]

    @property
    def values(self) -> dict[str, float]:
        """The results at the minima, by name."""
        return self.results(self.main.minimum, None if self.other is None else self.other.minimum)

    def results(self, main: Minimum, other: Minimum | None) -> dict[str, float]:
        """Return the results at minima of the main and the other branch, by name."""
        values: dict[str, float] = {}
        w, modulus = exp(main.unknowns[:POINT]).tolist()
        if ADHESION in self.main.free:
            values[WORK_OF_ADHESION[self.main.branch.name]] = w
        values["contact_modulus"] = modulus
        if POINT in self.main.free:
            values["contact_point"] = self.measurement.branches.sign * float(main.unknowns[POINT])
        if self.other is not None and other is not None:
            closing = float(exp(other.unknowns[ADHESION]))
            values[WORK_OF_ADHESION[self.other.branch.name]] = closing
            values |= {"adhesion_hysteresis": w - closing, "hysteresis_fraction": 1 - closing / w}
        return values

    def refitted(self, setting: Setting, change: Callable[[FittedBranch], Points] = _unchanged) -> ByResult:
        """Return the results for another setting or changed points. Fits start from the minima and keep their noise."""
        main = minimum(change(self.main), setting, self.main.unknowns, self.main.free, self.main.minimum.noise)
        if self.other is None:
            return self.results(main, None)
        other = minimum(change(self.other), setting, main.unknowns, self.other.free, self.other.minimum.noise)
        return self.results(main, other)

    def moves(self, setting: Setting, change: Callable[[FittedBranch], Points] = _unchanged) -> ByResult:
        """Return the moves of the results with another setting or changed points."""
        return difference(self.refitted(setting, change), self.values)

    def thinned(self) -> "Minima":
        """Return the minima for at most 300 points of each branch; their moves are nearly those of all points."""
        main = self._thinned(self.main, self.main.unknowns)
        return self._replace(main=main, other=None if self.other is None else self._thinned(self.other, main.unknowns))

    def _thinned(self, part: FittedBranch, start: Array) -> FittedBranch:
        """Return a branch with at most 300 points, fitted from a start."""
        step = ceil(len(part.points.z) / _FEW)
        points, noise = part.points.thinned(step), part.minimum.noise.thinned(step)
        return part.at(points, minimum(points, self.setting, start, part.free, noise))


# --- Statistical ------------------------------------------------------------------------------------------------------


def covariance_of(minima: Minima) -> tuple[tuple[str, ...], Array]:
    """Return the names of the fitted results, and their covariance from noise.

    The covariance of w of the other branch includes the errors of E* and z_c, which it takes from the main branch.
    """
    main, other = minima.main, minima.other
    name_of = {ADHESION: WORK_OF_ADHESION[main.branch.name], MODULUS: "contact_modulus", POINT: "contact_point"}
    scales = {ADHESION: exp(main.unknowns[ADHESION]), MODULUS: exp(main.unknowns[MODULUS])}
    scale = numpy.array([scales.get(unknown, minima.measurement.branches.sign) for unknown in main.free])
    names, matrix = tuple(name_of[unknown] for unknown in main.free), main.minimum.covariance
    covariance = matrix * numpy.outer(scale, scale)
    if other is None:
        return names, covariance
    found = other.minimum
    rows = found.noise.whitened(found.residuals.derivatives)
    weighted = rows[:, ADHESION] * found.weights
    slopes = -(weighted @ rows[:, [*main.free]]) / (weighted @ rows[:, ADHESION])  # d(ln w)/d(main unknowns)
    slopes[main.free.index(ADHESION)] = 0.0
    w = float(exp(found.unknowns[ADHESION]))
    variance = (float(found.covariance[0, 0]) + float(slopes @ matrix @ slopes)) * w * w
    column = matrix @ slopes * scale * w
    covariance = numpy.block([[covariance, column[:, None]], [column[None], variance]])
    return (*names, WORK_OF_ADHESION[other.branch.name]), covariance


def with_baselines(few: Minima, names: tuple[str, ...], covariance: Array) -> Array:
    """Return the covariance with the errors of the baselines added, each through the moves that it causes."""
    for base, offset, slope in _baseline_changes(few):
        moves = few.moves(few.setting, partial(_shifted, base, offset, slope))
        column = numpy.array([moves[name] for name in names])
        covariance = covariance + numpy.outer(column, column)
    return covariance


def _baseline_changes(minima: Minima) -> Iterator[tuple[Baseline, float, float]]:
    """Iterate over changes by one standard error: a baseline, and the offset and the slope that are added to it."""
    for base in dict.fromkeys(part.branch.baseline for part in minima.parts):
        if base is not None and base.error:
            yield base, base.error, 0.0
        if base is not None and base.slope_error:
            yield base, 0.0, base.slope_error


def _shifted(base: Baseline, offset: float, slope: float, part: FittedBranch) -> Points:
    """Return the points of a branch; if the branch has this baseline, its forces are shifted."""
    points = part.points
    if part.branch.baseline != base:
        return points
    return points._replace(force=points.force + offset + slope * (points.z - base.z))


def statistical_errors(minima: Minima, names: tuple[str, ...], covariance: Array) -> dict[str, Errors]:
    """Return the statistical errors of the results, from their covariance."""
    errors = {}
    for name, variance in zip(names, numpy.diag(covariance), strict=True):
        errors[name] = Errors(statistical=float(sqrt(variance)))
    if minima.other is not None:
        opening, closing = (minima.values[name] for name in (names[0], names[-1]))
        first, last, both = covariance[0, 0], covariance[-1, -1], covariance[0, -1]
        relative = first / opening**2 + last / closing**2 - 2 * both / opening / closing
        errors["adhesion_hysteresis"] = Errors(statistical=float(sqrt(max(first + last - 2 * both, 0.0))))
        errors["hysteresis_fraction"] = Errors(statistical=float(sqrt(max(relative, 0.0)) * closing / opening))
    return errors


# --- Calibration ------------------------------------------------------------------------------------------------------


def by_radius(few: Minima) -> ByResult:
    """Return the larger move of each result if the radius is smaller or larger by its error; empty without an error."""
    known = few.measurement.known
    if known.radius is None or not known.radius_error:
        return {}
    radii = [known.radius * factor for factor in ends(known.radius_error)]
    return largest([few.moves(few.setting._replace(reduced_radius=radius)) for radius in radii])


def ends(error: float) -> tuple[float, float]:
    """Return the factors from a value to both ends of its uncertainty. `error`: the relative error of the value."""
    return 1 - error, 1 + error


def largest(moves: Sequence[ByResult]) -> ByResult:
    """Return the largest move of each result."""
    if not moves:
        return {}
    return {name: max((move[name] for move in moves), key=abs) for name in moves[0]}


# --- Model ------------------------------------------------------------------------------------------------------------


def by_range(few: Minima) -> ByResult:
    """Return half the spread of the results over ranges of the main branch; empty if there is only one range.

    Two shorter ranges reach up to half the largest load, and up to a tenth of the largest tension; without adhesion, up
    to half and to a quarter of the largest load. A range with too few points is left out.
    """
    points, here = few.main.points, few.values
    spread = {name: [0.0] for name in here}
    most, least = float(points.force.max()), float(points.force.min())
    has_adhesion = ADHESION in few.main.free
    for top in (0.5 * most, 0.1 * least if has_adhesion else 0.25 * most):
        which = points.force <= top
        if which.sum() < 4 * LEAST_POINTS or which.all() or (has_adhesion and not least < 0):
            continue
        chosen = few.main.at(points.chosen(which), few.main.minimum)
        for name, value in few._replace(main=chosen).refitted(few.setting).items():
            spread[name].append(value - here[name])
    return {name: (max(changes) - min(changes)) / 2 for name, changes in spread.items() if len(changes) > 1}


class Models(NamedTuple):
    """The results by other laws and profiles, and the moves that count as errors of the model."""

    by_law: dict[str, ByResult]
    moves: list[ByResult]
    tabor_parameter: float = inf


def by_models(minima: Minima, few: Minima, width: float) -> Models:
    """Return the results by each law and for a sphere, and the moves that count as errors of the model.

    Without a radius, other laws are left out; without adhesion, all but JKR. At a large Tabor parameter, the results by
    Maugis' law are those by JKR. If the contact is wide (`width` is a/R), JKR is also fitted for a sphere. The results
    by another law are those of the fit plus their moves in a refit of fewer points.
    """
    measurement, values, here = minima.measurement, minima.values, few.values
    known = measurement.known
    has_adhesion = ADHESION in few.main.free
    own = key_of(known.law if has_adhesion else JKR, known.profile)
    by_law: dict[str, ByResult] = {own: values}

    def moved(law: str, profile: str = PARABOLOID, spacing: float | None = None) -> ByResult:
        setting = measurement.by_law(law, profile, spacing)
        there = _refitted_anew(few, setting) if DMT in (law, known.law) else few.refitted(setting)
        return {name: values[name] + there[name] - here[name] for name in there}

    if known.radius is None:
        return Models(by_law, [])
    contact = minima.setting.contact(minima.main.unknowns)
    tabor = float(tabor_parameter(**contact._asdict())) if has_adhesion else inf
    moves: list[ByResult] = []
    for law in (JKR, MAUGIS, DMT) if has_adhesion else (JKR,):
        if law not in by_law and not (law == MAUGIS and tabor > _ALIKE):
            by_law[law] = moved(law)
    if has_adhesion:
        by_law.setdefault(MAUGIS, by_law[JKR])
    if has_adhesion and tabor < LEAST_TABOR:
        at_half = by_law[key_of(MAUGIS, HALF_SPACING)] = moved(MAUGIS, spacing=known.spacing / 2)
        moves.append(difference(at_half, by_law[MAUGIS]))
    best = best_law(tabor)
    if best != known.law and has_adhesion:
        moves.append(difference(by_law[best], by_law[known.law]))
    if width > _WIDE and known.profile == PARABOLOID:  # the shape matters to every law, but only JKR has spheres
        of_sphere = by_law[key_of(JKR, SPHERE)] = moved(JKR, SPHERE)
        moves.append(difference(of_sphere, by_law[JKR]))
    return Models(by_law, moves, tabor)


def _refitted_anew(few: Minima, setting: Setting) -> ByResult:
    """Return the results of a fit that starts from a new z_c, since z_c by DMT differs much from z_c by other laws."""
    main = few.main
    start = with_point(main.points, setting, *exp(main.unknowns[:POINT]).tolist())
    found = minimum(main.points, setting, start, main.free, main.minimum.noise)
    return few._replace(main=main.at(main.points, found)).refitted(setting)


def difference(one: ByResult, other: ByResult) -> ByResult:
    """Return the results of one set minus those of the other."""
    return {name: one[name] - other[name] for name in one}
