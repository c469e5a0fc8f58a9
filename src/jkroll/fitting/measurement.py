"""Fit the branches of a measured curve: the range and the start of each fit, and the energy release rate G.

The unloading branch gives w of opening, E* and the contact point z_c. With these E* and z_c, the loading branch gives w
of closing; without them, a loading branch hardly separates w from E*.
"""

from typing import NamedTuple, Self

import numpy
from numpy import exp, inf, pi, sqrt

from ..quantities.laws import JKR, PARABOLOID
from .branches import (
    APPROACH,
    LEAST_POINTS,
    LOADING,
    RADIUS,
    TRAVEL,
    UNLOADING,
    BadCurve,
    Branch,
    Branches,
    LoadRange,
    largest_tension,
)
from .force_curves import PROFILES, Array, Grip, curve_law
from .minimum import ADHESION, MODULUS, POINT, Minimum, Points, Setting, best_of, minimum, robust_deviation, with_point
from .result import Known

FIRST_RANGE = LoadRange(-1.0, 0.3, True)
EVERYTHING = LoadRange(-inf, inf, False)
_PLATEAU = 0.03  # relative variation of the energy release rate on its plateau
_PLATEAUS = 4  # rounds of finding the plateau and fitting it, for contact radii
_BINS = 24  # bins along a branch, in which the plateau is sought
_LARGEST = 60.0  # |ln w| or |ln E*| above which a minimum is rejected
_NO_ADHESION = 5.0  # least tension that counts as adhesion, in units of the scatter out of contact
_NEXT_TO_NOTHING = 1e-12  # w of Hertz' contact, as a share of `largest_adhesion`; so little adhesion has no effect
_ROOT_STEPS = 60  # most steps of Newton's method for the contact radius of a point
_ROOT = 1e-6  # a contact radius is a root if its load has at most this relative error

# The name of the result that is w of a branch.
WORK_OF_ADHESION = {UNLOADING: "work_of_adhesion_opening", LOADING: "work_of_adhesion_closing"}


class Measurement(NamedTuple):
    """The branches of a curve, and the known data of the contact and the instrument."""

    kind: str
    known: Known
    branches: Branches

    @property
    def radius(self) -> float:
        """The reduced radius; 1 m if it is unknown, so that w stands for wR, and E* for E*√R."""
        return self.known.radius or 1.0

    @property
    def stiffness(self) -> float:
        """The stiffness of the lever; infinite unless x is a travel."""
        return self.known.stiffness if self.kind == TRAVEL else inf

    @property
    def setting(self) -> Setting:
        """The setting for the chosen law."""
        return self.by_law(self.known.law, self.known.profile)

    def by_law(self, law: str, profile: str = PARABOLOID, spacing: float | None = None) -> Setting:
        """Return the setting for a law and a profile. `spacing`: the atomic spacing, by default the known one."""
        grip = Grip(self.stiffness, self.kind == RADIUS)
        return Setting(curve_law(law, profile), self.radius, spacing or self.known.spacing, grip)

    @property
    def without_adhesion(self) -> Setting:
        """The setting for Hertz' contact: that of JKR, to be used with a w next to 0."""
        return self.by_law(JKR, self.known.profile)

    @property
    def largest_adhesion(self) -> float:
        """The largest w that can go unnoticed: its pull-off force is within the noise and the slope of the baseline."""
        return _NO_ADHESION * self.branches.scatter / (1.5 * pi * self.radius)

    def has_adhesion(self, branch: Branch) -> bool:
        """Return whether a branch has tension above the noise; contact radii show w even without tension."""
        return self.kind == RADIUS or largest_tension(branch.in_contact) >= _NO_ADHESION * self.branches.scatter

    def range_of(self, branch: Branch, default: LoadRange) -> slice:
        """Return the slice of the given or a default range; the whole contact if the default has too few points.

        Raises BadCurve if the given range has too few points.
        """
        if self.known.range is not None:
            return self.known.range.within(branch)
        try:
            return default.within(branch)
        except BadCurve:
            return branch.contact


class FittedBranch(NamedTuple):
    """A branch with its fitted points, their minimum, and the indices of the unknowns that were fitted (`free`)."""

    branch: Branch
    points: Points
    minimum: Minimum
    free: tuple[int, ...]

    @property
    def unknowns(self) -> Array:
        """The unknowns at the minimum."""
        return self.minimum.unknowns

    def at(self, points: Points, minimum: Minimum) -> Self:
        """Return the same branch with other points and their minimum."""
        return self._replace(points=points, minimum=minimum)


# --- Minima -----------------------------------------------------------------------------------------------------------


def fitted_branch(measurement: Measurement, branch: Branch) -> FittedBranch:
    """Return the minimum of a branch over all unknowns, in the given range or a default one. Raises BadCurve.

    The default is FIRST_RANGE for loading, and the plateau of G for unloading; for contact radii, see
    `_fitted_by_radii`. A first minimum gives the E* and z_c from which G is computed, and the end of contact in a curve
    of approaches.
    """
    asked, free = measurement.known.range, measurement.setting.free
    if measurement.kind == RADIUS and asked is None:
        return _fitted_by_radii(measurement, branch)
    points = branch.points.chosen(measurement.range_of(branch, FIRST_RANGE))
    first = FittedBranch(branch, points, _first_minimum(measurement, points), free)
    branch = extended(measurement, branch, first.unknowns)
    if asked is not None or branch.name == LOADING:
        within = measurement.range_of(branch, FIRST_RANGE)
    else:
        within = _plateau(measurement, branch, first.unknowns)
    points = branch.points.chosen(within)
    return FittedBranch(branch, points, minimum(points, measurement.setting, first.unknowns), free)


def _fitted_by_radii(measurement: Measurement, branch: Branch) -> FittedBranch:
    """Return the minimum for contact radii. For unloading, only the part in which the edge recedes is fitted.

    This part is the plateau of G; plateau and fit are found in turn.
    """
    points = branch.in_contact
    found = _first_minimum(measurement, points)
    for _ in range(_PLATEAUS if branch.name == UNLOADING else 0):
        points = branch.points.chosen(_plateau(measurement, branch, found.unknowns))
        found = minimum(points, measurement.setting, found.unknowns)
    return FittedBranch(branch, points, found, measurement.setting.free)


def fitted_with(measurement: Measurement, branch: Branch, main: FittedBranch) -> FittedBranch:
    """Return the minimum of a branch over w only, with E* and z_c of another branch. Raises BadCurve."""
    branch = extended(measurement, branch, main.unknowns)
    points = branch.points.chosen(measurement.range_of(branch, EVERYTHING))
    found = minimum(points, measurement.setting, main.unknowns, free=[ADHESION])
    return FittedBranch(branch, points, found, (ADHESION,))


def fitted_without_adhesion(measurement: Measurement, branch: Branch) -> FittedBranch:
    """Return the minimum for Hertz' contact. Raises BadCurve."""
    points = branch.points.chosen(measurement.range_of(branch, EVERYTHING))
    setting = measurement.without_adhesion
    w = _NEXT_TO_NOTHING * measurement.largest_adhesion
    depth = float(numpy.ptp(points.z)) or 1e-9
    modulus = 0.75 * float(points.force.max()) / (sqrt(measurement.radius) * depth**1.5)
    starts = [with_point(points, setting, w, modulus * factor) for factor in (1.0, 10.0)]
    try:
        found = best_of(starts, points, setting, (MODULUS, POINT))
    except ValueError:
        raise BadCurve(f"no contact resembles {_fitted_part(measurement)}", "no minimum") from None
    return FittedBranch(branch, points, found, (MODULUS, POINT))


def _first_minimum(measurement: Measurement, points: Points) -> Minimum:
    """Return the best minimum from some starts; laws other than JKR also start from JKR's minimum. Raises BadCurve."""
    starts, setting = _starts(measurement, points), measurement.setting
    try:
        if measurement.known.law != JKR:
            by_jkr = best_of(starts, points, measurement.by_law(JKR)).unknowns
            starts.append(with_point(points, setting, *exp(by_jkr[:POINT]).tolist()))
        found = best_of(starts, points, setting)
    except ValueError:
        found = None
    if found is None or not (abs(found.unknowns[:POINT]) < _LARGEST).all() or _hides_adhesion(measurement, found):
        raise BadCurve(f"no contact of this law resembles {_fitted_part(measurement)}", "no minimum")
    return found


def _hides_adhesion(measurement: Measurement, found: Minimum) -> bool:
    """Return whether w at a minimum has a pull-off force below the noise; contact radii show any w."""
    return measurement.kind != RADIUS and float(exp(found.unknowns[ADHESION])) < measurement.largest_adhesion


def _fitted_part(measurement: Measurement) -> str:
    """Return the name of the part of the curve that was fitted, and what to change if no contact resembles it."""
    if measurement.known.range is not None:
        return "the points in the range: w and E* need points in tension, as in --range -100%:30%"
    return "the curve: check the radius, the spring and the units, or give another --model"


def _starts(measurement: Measurement, points: Points) -> list[Array]:
    """Return two starts, the second with a larger modulus.

    w and E* come from the depth and the width of the tensile part, or for contact radii from a linear fit.
    """
    setting, radius = measurement.setting, measurement.radius
    tension = max(largest_tension(points), 0.1 * float(abs(points.force).max()))
    w = tension / (1.5 * pi * radius)
    if setting.grip.is_radius:
        shape = 4 / 3 / radius * points.z**1.5
        rows = numpy.stack([shape, -numpy.ones_like(shape)], 1)
        modulus, offset = numpy.linalg.lstsq(rows, points.force / points.z**1.5, rcond=None)[0]
        modulus = modulus if modulus > 0 else 0.75 * radius * float((points.force / points.z**3).max())
        w = offset**2 / (8 * pi * modulus) if offset > 0 else w
        return [with_point(points, setting, w, abs(modulus) * factor) for factor in (1.0, 3.0)]
    approach = points.z - points.force / setting.grip.stiffness
    least = int(numpy.argmin(points.force))
    zero = int(numpy.argmin(abs(points.force)))
    # In units of a0²/R, JKR's approach is 1/3 without load and −(1/3)/4^(2/3) at pull-off.
    width = abs(float(approach[zero] - approach[least])) / (1 / 3 + 1 / 3 / 4 ** (2 / 3))
    if width == 0 and points.force.max() > 0:
        width = float(numpy.ptp(approach))
    unloaded = sqrt(radius * max(width, 1e-6 * float(numpy.ptp(points.z))))
    modulus = 9 * pi * w * radius**2 / (2 * unloaded**3)
    return [with_point(points, setting, w, modulus * factor) for factor in (1.0, 5.0)]


def extended(measurement: Measurement, branch: Branch, unknowns: Array) -> Branch:
    """Return a branch; for an approach, its contact extends as far as fixed grips hold it. `unknowns`: at a minimum."""
    if measurement.kind != APPROACH:
        return branch  # a lever snaps off after the least load
    setting = measurement.setting
    contact, grip, law = setting.contact(unknowns), setting.grip, setting.law
    x_last = float(grip.x(law.values(numpy.float64(law.last(contact, grip)), contact)[0]))
    return branch.extended(unknowns[POINT] + x_last)


# --- The energy release rate ------------------------------------------------------------------------------------------


def _plateau(measurement: Measurement, branch: Branch, unknowns: Array) -> slice:
    """Return the slice from the start of the plateau of the energy release rate to the last point in contact.

    The level of the plateau is the median of G over the second half of the contact. The plateau starts after the last
    bin off this level; the last three bins do not count. The slice has at least 20 points of the contact.
    """
    rate, _ = release_rate(measurement, branch.in_contact, unknowns)
    size = max(LEAST_POINTS, len(rate) // _BINS)
    middles = [_median(rate[start : start + size]) for start in range(0, len(rate) - size + 1, size)]
    second_half = numpy.array(middles[len(middles) // 2 :])
    known = second_half[numpy.isfinite(second_half)]
    if len(second_half) < 2 or not len(known):
        return branch.contact
    level = float(numpy.median(known))
    tolerance = max(_PLATEAU * level, 3 * robust_deviation(known - level))
    off = [index for index, value in enumerate(middles[:-3]) if abs(value - level) > tolerance]
    first = (off[-1] + 1) * size if off else 0
    start = min(branch.contact.start + first, branch.contact.stop - 4 * LEAST_POINTS)
    return slice(max(start, branch.contact.start), branch.contact.stop)


def _median(values: Array) -> float:
    """Return the median of the finite values; nan if there are none."""
    numbers = values[numpy.isfinite(values)]
    return float(numpy.median(numbers)) if len(numbers) else numpy.nan


def release_rate(measurement: Measurement, points: Points, unknowns: Array) -> tuple[Array, Array]:
    """Return the energy release rate G and contact radius of measured points, from E* and z_c by JKR's formulas.

    Both are nan where no contact radius fits the approach and load of a point.
    """
    modulus, radius, grip = float(exp(unknowns[MODULUS])), measurement.radius, measurement.setting.grip
    profile = PROFILES[measurement.known.profile]
    if grip.is_radius:
        a = points.z
        hertz = modulus * profile.without_adhesion(a, radius)[3]
        return (hertz - points.force) ** 2 / (8 * pi * modulus * a**3), a
    approach = points.z - unknowns[POINT] - points.force / grip.stiffness
    root = sqrt(numpy.maximum(radius * approach, 0))
    a = numpy.maximum(1.5 * root, numpy.cbrt(abs(points.force) * radius * 3 / modulus)) + 2 * root
    a = numpy.clip(a, 1e-9 * radius, 0.999999 * profile.most * radius)
    for _ in range(_ROOT_STEPS):  # dP_H/da = 2E*a dδ_H/da, so the slope of `excess` is 2E*(δ_H − δ)
        depth, _, _, hertz = profile.without_adhesion(a, radius)
        excess = 2 * modulus * a * (depth - approach) - modulus * hertz + points.force
        new = numpy.maximum(a - excess / (2 * modulus * (depth - approach)), 1e-9 * radius)
        is_done = bool((abs(new - a) <= 1e-10 * a).all())
        a = new
        if is_done:
            break
    depth, _, _, hertz = profile.without_adhesion(a, radius)
    pull = 2 * modulus * a * (depth - approach)
    has_root = abs(pull - modulus * hertz + points.force) <= _ROOT * (abs(pull) + abs(points.force))
    rate = modulus * (depth - approach) ** 2 / (2 * pi * a)
    return numpy.where(has_root, rate, numpy.nan), numpy.where(has_root, a, numpy.nan)
