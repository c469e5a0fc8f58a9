"""Divide a measured force curve into branches: signs, baseline, free parts, contact, and the range to fit.

Loading moves into the contact, unloading out of it. A branch is free where it is out of contact; its force there is the
baseline. Loads are forces minus the baseline, and a tension is negative. Travel and approach increase into the
contact.
"""

from collections.abc import Mapping
from typing import Any, NamedTuple, Self

import numpy
from numpy import inf, sqrt

from ..errors import JkrollError
from .baseline import Baseline, baseline_of, remark_on_baselines
from .force_curves import Array
from .minimum import Points, robust_deviation

LOADING, UNLOADING, PAUSE = "loading", "unloading", "pause"
LEAST_POINTS = 5
_NOISE = 5.0  # standard deviations of the noise above which a force is a signal
_SMOOTH = 9  # points of a running median
_END = 0.1  # fraction of a branch that counts as its end
# A share of the range of forces with two uses: the largest change over a free end (a straight branch changes by 0.1
# there), and the least bend of a concave branch.
_FLATTER = 0.05
_LOST = 0.5  # the contact is lost where less than this share of the largest tension is left
_RISE = 0.05  # rise of the force where a lever lets go, as a share of the depth of the minimum
_SHORT = 0.03  # least share of the points in a branch
_STEEPER = 5.0  # ratio of the rises of force at both ends above which the flatter end is free
_NEAR_ONCE = 1.5  # largest ratio of the path of z to that of one approach and one retraction
_GAP = 10.0  # least length of a gap in time, in median steps
_LEAST_NOISE = 1e-9  # least noise of computed curves, as a share of the range of forces
_FLAT = 5  # least number of equal extreme readings that shows a saturated sensor; nearly all follow each other
_LONG = 0.2  # least length of the free end of a curve without a minimum, as a share of the travel
_SETTLES = 0.1  # fraction of the free part in which the lever still swings after the jump


class BadCurve(JkrollError):
    """Error raised for a curve that cannot be fitted."""

    exit_code = 1

    def __init__(self, problem: str, phrase: str) -> None:
        """`phrase`: the reason as a table states it."""
        super().__init__(problem)
        self.phrase = phrase


class ForceCurve(NamedTuple):
    """The columns of a curve in order of time, in SI units: z, the force, and optional columns.

    `z` is a contact radius, an approach or a travel, as `kind` states. Errors are standard deviations, None if unknown.
    `branch` names the branch of each point, or is PAUSE for points between branches; None if no column states it.
    `time` has any unit. `is_deflection`: the force is a measured deflection times the stiffness of the lever.
    `force_over_deflection`: the slope of the force over a column of deflections; None without such a column.
    """

    kind: str
    z: Array
    force: Array
    z_error: Array | None = None
    force_error: Array | None = None
    branch: Array | None = None
    time: Array | None = None
    is_deflection: bool = False
    force_over_deflection: float | None = None

    def chosen(self, which: Array) -> Self:
        """Return the points at some indices, or where a mask is True."""
        columns: dict[str, Any] = {}
        for name, value in self._asdict().items():
            if isinstance(value, numpy.ndarray):
                columns[name] = value[which]
        return self._replace(**columns)


RADIUS, APPROACH, TRAVEL = "contact radius", "approach", "travel"  # kinds of z
# The quantity of each kind of z. A table with several of these columns is read by the first of them.
QUANTITIES = {RADIUS: "contact_radius_at_load", APPROACH: "approach_at_load", TRAVEL: "lever_travel"}


class Branch(NamedTuple):
    """A branch: its points in order of time, with loads instead of forces, and the slice in contact.

    `reach` is the slice that may be in contact: it goes on after the least load, until half of the tension is lost. A
    curve of contact radii has no baseline. A branch without a free part takes the baseline of the other branch, or 0.
    """

    name: str
    points: Points
    contact: slice
    reach: slice
    baseline: Baseline | None = None
    has_free_part: bool = False

    def extended(self, first_z: float) -> Self:
        """Return the branch with its contact extended, within reach, to all positions z ≥ `first_z`."""
        held = numpy.nonzero(self.points.z[self.reach] >= first_z)[0]
        if self.name == UNLOADING:
            last = int(held[-1]) + 1 if len(held) else 0
            return self._replace(contact=slice(0, max(last, self.contact.stop)))
        first = self.reach.start + int(held[0]) if len(held) else len(self.points.z)
        return self._replace(contact=slice(min(first, self.contact.start), self.contact.stop))

    @property
    def in_contact(self) -> Points:
        """The points in contact."""
        return self.points.chosen(self.contact)


class Branches(NamedTuple):
    """The branches of a curve by name, the noise of the force, and remarks by code."""

    by_name: Mapping[str, Branch]
    noise: float  # around the line through the points out of contact
    scatter: float  # around the baseline
    remarks: Mapping[str, str]
    sign: float  # the factor of z that makes z rise into the contact


def branches_of(curve: ForceCurve, stiffness: float, *, tilt: bool = False, only: str = "") -> Branches:
    """Return the branches of a curve. `stiffness`: of the lever, infinite without a lever. Raises BadCurve.

    `only`: the name of the only branch to fit; a curve with a single branch is taken for this branch.
    """
    remarks: dict[str, str] = {}
    curve = _finite(_without_pause(curve, remarks), remarks)
    if curve.kind == RADIUS:
        return _of_radii(curve, remarks)
    curve = _unsaturated(curve, remarks)
    sign = _sign(curve)
    curve = _with_pull_negative(curve._replace(z=sign * curve.z), remarks)
    parts = _split(curve, only, remarks)
    _check_time(parts, remarks)
    floor = _LEAST_NOISE * float(numpy.ptp(curve.force))
    noise = max(_white_noise(curve.force), floor)
    baselines: dict[str, Baseline | None] = {}
    for name, part in parts.items():
        free = part.chosen(_free(part, name, noise))
        baselines[name] = baseline_of(free.z, free.force, floor, tilt=tilt) if len(free.z) >= LEAST_POINTS else None
    known = []
    for name in (UNLOADING, LOADING):
        baseline = baselines.get(name)
        if baseline is not None:
            known.append(baseline)
    if not known:
        known = [Baseline(0.0, 0.0, 0.0, noise, noise)]
        remarks["no-baseline"] = "no part is out of contact: forces are taken as measured, without a baseline"
    remark_on_baselines(baselines, remarks, tilt=tilt)
    branches = {}
    for name, part in parts.items():
        own = baselines[name]
        baseline = known[0] if own is None else own
        load = part.force - baseline.at(part.z)
        give = 1 / stiffness if stiffness < inf else float(numpy.ptp(part.z)) / float(numpy.ptp(load))
        points = Points(part.z, load, *_errors(part, max(baseline.noise, noise), give))
        contact, reach = _in_contact(load, name, max(baseline.scatter, noise))
        branches[name] = Branch(name, points, contact, reach, baseline, has_free_part=own is not None)
    _check(branches, max(noise, *(baseline.scatter for baseline in known)), remarks)
    return Branches(branches, known[0].noise, known[0].scatter, remarks, sign)


def _without_pause(curve: ForceCurve, remarks: dict[str, str]) -> ForceCurve:
    """Return a curve without the points that a column marks as a pause, and add a remark if there are any."""
    if curve.branch is None:
        return curve
    is_pause = curve.branch == PAUSE
    if not is_pause.any():
        return curve
    remarks["pause"] = f"{int(is_pause.sum())} points of a pause are left out"
    return curve.chosen(~is_pause)


def _check_time(parts: Mapping[str, ForceCurve], remarks: dict[str, str]) -> None:
    """Add a remark on gaps in time within the branches, where points may be missing."""
    found = []
    for name, part in parts.items():
        if part.time is None:
            continue
        steps = abs(numpy.diff(part.time))
        usual = float(numpy.median(steps))
        count = int((steps > _GAP * usual).sum()) if usual > 0 else 0
        if count:
            longest = float(steps.max()) / usual
            many = "1 gap" if count == 1 else f"{count} gaps, the longest"
            found.append(f"{name}: the time has {many} of {longest:.0f} usual steps")
    if found:
        remarks["time-gaps"] = f"{'; '.join(found)}: points may be missing"


def _finite(curve: ForceCurve, remarks: dict[str, str]) -> ForceCurve:
    """Return the points with finite numbers, and with positive contact radii.

    Raises BadCurve if there are too few points, or if z or the force is constant.
    """
    is_known = numpy.isfinite(curve.z) & numpy.isfinite(curve.force)
    if curve.kind == RADIUS:
        is_known &= curve.z > 0
    count = int(is_known.sum())
    left_out = len(is_known) - count
    if left_out:
        lacking = "no positive radius or no load" if curve.kind == RADIUS else "no number"
        remarks["gaps"] = f"{left_out} of {len(is_known)} points have {lacking} and are left out"
    if count < LEAST_POINTS:
        raise BadCurve(f"a fit needs {LEAST_POINTS} points, and the curve has {count}", "too few points")
    curve = curve.chosen(is_known)
    if not (numpy.ptp(curve.z) > 0 and numpy.ptp(curve.force) > 0):
        which = curve.kind if numpy.ptp(curve.z) == 0 else "force"
        raise BadCurve(f"the {which} is the same at all points", "no curve")
    return curve


def _unsaturated(curve: ForceCurve, remarks: dict[str, str]) -> ForceCurve:
    """Return a curve without the points at which the sensor is saturated and repeats its largest or least reading.

    Readings of exactly 0 are kept: they are the forces of a computed curve out of contact.
    """
    is_kept = numpy.ones(len(curve.force), bool)
    for end in (curve.force.max(), curve.force.min()):
        at_end = curve.force == end
        are_many = _FLAT <= at_end.sum() < 0.5 * len(at_end) and (at_end[1:] & at_end[:-1]).sum() >= _FLAT - 1
        if end != 0 and are_many:
            is_kept &= ~at_end
    count = int((~is_kept).sum())
    if count and is_kept.sum() >= LEAST_POINTS:
        remarks["saturated"] = f"{count} points at the end of the sensor's range are left out"
        return curve.chosen(is_kept)
    return curve


def _sign(curve: ForceCurve) -> float:
    """Return the sign that makes z rise into the contact.

    If the force is much flatter at one end of z, that end is free. Otherwise, if the force is flat over the first or
    the last points and z turns far from where it begins and ends, the turning point is in the contact. Otherwise the
    end with the larger force is in contact, unless the force is concave there: a pressed contact gets stiffer. Raises
    BadCurve if the forces at both ends of z are the same.
    """
    order = numpy.argsort(curve.z, kind="stable")
    count = max(3, len(order) // 10)
    ends = [curve.force[which] for which in (order[:count], order[-count:])]
    low, high = (float(numpy.median(end)) for end in ends)
    rise_low, rise_high = (abs(_rise(end)) for end in ends)
    spread = float(numpy.ptp(curve.force))
    if max(rise_low, rise_high) > max(_STEEPER * min(rise_low, rise_high), 0.02 * spread):
        return 1.0 if rise_high > rise_low else -1.0
    if _is_flat(curve.force[:count], spread) or _is_flat(curve.force[-count:], spread):
        first, last = sorted((float(curve.z[0]), float(curve.z[-1])))
        above, below = float(curve.z.max()) - last, first - float(curve.z.min())
        if max(above, below) > 0.5 * float(numpy.ptp(curve.z)):
            return 1.0 if above > below else -1.0
    if abs(high - low) < 0.02 * spread:
        raise BadCurve(
            f"the force is the same at both ends of the {curve.kind}, so the end in contact is not known. Leave out "
            "all points that do not belong to one approach and retraction",
            "unknown direction",
        )
    rising = 1.0 if high > low else -1.0
    return -rising if _is_concave(rising * curve.z, curve.force) else rising


def _is_concave(z: Array, force: Array) -> bool:
    """Return whether the force over the upper half of z is clearly concave."""
    which = z >= numpy.median(z)
    if which.sum() <= LEAST_POINTS:
        return False
    x = (z[which] - z[which].mean()) / numpy.ptp(z[which])
    coefficients, covariance = numpy.polyfit(x, force[which], 2, cov=True)
    least = max(_NOISE * sqrt(covariance[0, 0]), _FLATTER * float(numpy.ptp(force[which])))
    return bool(coefficients[0] < -least)


def _is_flat(end: Array, spread: float) -> bool:
    """Return whether the force hardly changes over some points, relative to the range of all forces."""
    return abs(_rise(end)) < _FLATTER * spread


def _rise(force: Array) -> float:
    """Return the rise of the best line over the forces of consecutive points."""
    return float(numpy.polyfit(numpy.arange(len(force)), force, 1)[0]) * len(force)


def _with_pull_negative(curve: ForceCurve, remarks: dict[str, str]) -> ForceCurve:
    """Return the curve; the sign of the force is reversed if the force falls with rising z near the largest z."""
    which = slice(int(numpy.argmax(curve.z)), None) if curve.branch is None else curve.branch == UNLOADING
    part = curve.chosen(which) if len(curve.z[which]) >= LEAST_POINTS else curve
    order = numpy.argsort(part.z, kind="stable")[-max(LEAST_POINTS, len(part.z) // 20) :]
    z, force = part.z[order], part.force[order]
    slope = float(numpy.polyfit(z - z.mean(), force, 1)[0]) if numpy.ptp(z) > 0 else 0.0
    if -slope * float(numpy.ptp(z)) < max(0.02 * float(numpy.ptp(curve.force)), _NOISE * _white_noise(curve.force)):
        return curve
    remarks["force-reversed"] = (
        "the force falls on the way into the contact: its sign is reversed, so a pull is negative"
    )
    return curve._replace(force=-curve.force)


def _split(curve: ForceCurve, only: str, remarks: dict[str, str]) -> dict[str, ForceCurve]:
    """Return the points of each branch in order of time, divided by a column or where z or the force turns.

    Branches named in a column may be sorted by z in the file. Raises BadCurve if no branch has enough points.
    """
    if curve.branch is not None:
        parts = {name: _in_time(curve.chosen(curve.branch == name), name) for name in (LOADING, UNLOADING)}
    else:
        top = int(numpy.nonzero(curve.z == curve.z.max())[0][-1])
        if not _turns_once(curve.z, top):
            top = int(numpy.argmax(running_median(curve.force)))
        parts = _divided(curve, top)
    least = max(LEAST_POINTS, round(_SHORT * len(curve.z)))
    kept = {name: part for name, part in _long(parts, least, remarks).items() if _varies(part)}
    if not kept:
        raise BadCurve("neither branch has enough points", "too few points")
    if curve.branch is None and len(kept) == 1:
        ((name, part),) = kept.items()
        if only not in ("", name):
            return {only: _in_time(part, only)}
        other = "unload" if name == LOADING else "load"
        remarks["one-branch"] = f"the curve has one branch, taken as {name}; if it is not, give --branch {other}"
    return kept


def _divided(curve: ForceCurve, top: int) -> dict[str, ForceCurve]:
    """Return the branches before and after an index; its point belongs to loading if unloading has too few points."""
    cut = top + 1 if len(curve.z) - top < LEAST_POINTS else top
    return {LOADING: curve.chosen(slice(0, cut)), UNLOADING: curve.chosen(slice(cut, None))}


def _long(parts: dict[str, ForceCurve], least: int, remarks: dict[str, str]) -> dict[str, ForceCurve]:
    """Return the branches with enough points, and add a remark on a short branch next to a long one."""
    kept = {name: part for name, part in parts.items() if len(part.z) >= least}
    for part in parts.values():
        if kept and 0 < len(part.z) < least:
            many = "1 point is" if len(part.z) == 1 else f"{len(part.z)} points are"
            remarks["branch-left-out"] = f"{many} left out at one end of the curve, since a branch needs {least}"
    return kept


def _in_time(part: ForceCurve, name: str) -> ForceCurve:
    """Return the points of a branch in order of time: z rises during loading, and falls during unloading."""
    if len(part.z) and (part.z[-1] < part.z[0]) == (name == LOADING):
        return part.chosen(slice(None, None, -1))
    return part


def _turns_once(z: Array, top: int) -> bool:
    """Return whether z rises up to an index and falls after it, except for noise."""
    ways = float(abs(numpy.diff(running_median(z))).sum())
    return ways < _NEAR_ONCE * float(2 * z[top] - z[0] - z[-1])


def _varies(part: ForceCurve) -> bool:
    return bool(numpy.ptp(part.z) > 0 and numpy.ptp(part.force) > 0)


def running_median(values: Array, size: int = _SMOOTH) -> Array:
    """Return the running median over an odd number of points; the values are mirrored at both ends."""
    size = min(size, len(values) - (len(values) + 1) % 2)
    if size < 3:
        return values
    half = size // 2
    padded = numpy.concatenate([values[:half][::-1], values, values[-half:][::-1]])
    return numpy.median(numpy.lib.stride_tricks.sliding_window_view(padded, size), axis=-1)


def largest_tension(points: Points) -> float:
    """Return the largest tension of points, as a median over three of them; negative if all are pressed."""
    return -float(running_median(points.force, 3).min())


def _white_noise(force: Array) -> float:
    """Return the standard deviation of white noise: the least of the estimates from differences of three orders.

    If a curve has few points, its curvature enters the differences of low order.
    """
    sizes = []
    for order, square in ((2, 6), (3, 20), (4, 70)):
        if len(force) > order:
            sizes.append(robust_deviation(numpy.diff(force, order)) / square**0.5)
    return float(min(sizes))


def _free(part: ForceCurve, name: str, noise: float) -> slice:
    """Return the slice of a branch that is out of contact; empty if it has too few points."""
    count = len(part.force)
    outward = part if name == UNLOADING else part.chosen(slice(None, None, -1))
    first = _first_free(outward.z, outward.force, noise)
    if count - first < LEAST_POINTS:
        return slice(0, 0)
    return slice(first, count) if name == UNLOADING else slice(0, count - first)


def _first_free(z: Array, force: Array, noise: float) -> int:
    """Return the index of the first free point of a branch that begins in contact; the number of points without one.

    With tension, the branch is free from where the force is back at the level of the end, otherwise from the last
    pressed point. The first tenth of the free part is left out, since the lever still swings there.
    """
    count = max(LEAST_POINTS, int(_END * len(force)))
    if len(force) < 2 * count:
        return len(force)
    end = force[-count:]
    if abs(_rise(end)) > max(_FLATTER * float(numpy.ptp(force)), 3 * noise):
        return len(force)  # the branch ends in contact
    level = float(numpy.median(end))
    spread = max(noise, robust_deviation(end - level))
    smooth = running_median(force, 5)
    least = int(numpy.argmin(smooth))
    depth = level - float(smooth[least])
    if depth > _NOISE * spread:
        above = numpy.nonzero(smooth[least:] > level - max(_NOISE * spread, 0.1 * depth))[0]
        first = least + int(above[0]) if len(above) else len(force)
    else:
        pressed = numpy.nonzero(smooth > level + _NOISE * spread)[0]
        first = int(pressed[-1]) + 1 if len(pressed) else len(force)
        if not len(z[first:]) or numpy.ptp(z[first:]) < _LONG * numpy.ptp(z):
            return len(force)  # a curve that ends at its least force looks the same
    return first + int(_SETTLES * (len(force) - first))


def _errors(part: ForceCurve, noise: float, give: float) -> tuple[Array, Array]:
    """Return standard deviations of the force and of z; only their ratio matters.

    Without a column of errors of z, the deviation of z is that of the force times `give`, a compliance.
    """
    force_error = part.force_error if part.force_error is not None else numpy.full(len(part.z), noise)
    if part.z_error is not None:
        return force_error, part.z_error
    return force_error, force_error * give


def _in_contact(load: Array, name: str, noise: float) -> tuple[slice, slice]:
    """Return the slice of a branch in contact, and the slice that may be in contact.

    On the way out of a contact with tension, the first slice ends just past the least load, and the second where half
    of the tension is lost: there a stiff lever still holds the contact, while a soft lever is already snapping off.
    Without tension, both slices end at the last pressed point, and are empty if there is none. In loading, the slices
    begin where they end on the way out.
    """
    outward = load if name == UNLOADING else load[::-1]
    smooth = running_median(outward, 5)
    least = int(numpy.argmin(smooth))
    depth = -float(smooth[least])
    count = len(load)
    if depth > _NOISE * noise:
        lost = numpy.nonzero(outward[least:] > -_LOST * depth)[0]
        risen = numpy.nonzero(outward[least:] > -(1 - _RISE) * depth)[0]
        ends = tuple(least + int(beyond[0]) if len(beyond) else count for beyond in (risen, lost))
    else:
        pressed = numpy.nonzero(smooth > _NOISE * noise)[0]
        ends = (int(pressed[-1]) + 1 if len(pressed) else 0,) * 2
    near, far = (slice(0, end) if name == UNLOADING else slice(count - end, count) for end in ends)
    return near, far


def _check(branches: dict[str, Branch], noise: float, remarks: dict[str, str]) -> None:
    """Drop branches with too few points in contact, and add remarks. Raises BadCurve if no branch is left."""
    for name in [*branches]:
        if len(branches[name].in_contact.z) < LEAST_POINTS:
            problem = f"{name}: fewer than {LEAST_POINTS} points are in contact"
            del branches[name]
            if not branches:
                raise BadCurve(problem, "too few points")
            remarks["branch-left-out"] = f"{problem}; the branch is left out"
    branch = branches.get(UNLOADING)
    if branch is None:
        return
    load = branch.points.force
    if not branch.has_free_part and float(load.min()) < -_NOISE * noise:
        remarks["no-jump-off"] = "no points after the jump-off: the curve may end before its least force"
    after = load[branch.reach.stop :]
    if len(after) > 2 * _SMOOTH:
        smooth = running_median(after)[_SMOOTH:]
        if float(smooth.min()) < min(-4 * _NOISE * noise, 0.2 * float(load.min())):
            remarks["several-minima"] = "several minima after the jump-off (strands, or asperities that let go late)"


def _of_radii(curve: ForceCurve, remarks: dict[str, str]) -> Branches:
    """Return the branches of a curve of contact radii: all points are in contact, and there is no baseline."""
    top = int(numpy.argmax(curve.force))
    if curve.branch is not None:
        parts = {name: curve.chosen(curve.branch == name) for name in (LOADING, UNLOADING)}
    else:
        parts = _divided(curve, top)
    parts = _long(parts, LEAST_POINTS, remarks) or {UNLOADING: curve}
    if curve.z_error is None or curve.force_error is None:
        remarks["equal-errors"] = (
            "radii and loads are assumed to have equal errors, relative to their ranges, unless columns give errors"
        )
    z_error, force_error = (float(numpy.ptp(column)) / 200 for column in (curve.z, curve.force))
    branches = {}
    for name, part in parts.items():
        z_errors = numpy.full(len(part.z), z_error) if part.z_error is None else part.z_error
        force_errors = numpy.full(len(part.z), force_error) if part.force_error is None else part.force_error
        points = Points(part.z, part.force, force_errors, z_errors)
        branches[name] = Branch(name, points, slice(0, len(part.z)), slice(0, len(part.z)))
    return Branches(branches, force_error, force_error, remarks, 1.0)


# --- The fitted range -------------------------------------------------------------------------------------------------


class LoadRange(NamedTuple):
    """The range of loads to fit, in newtons or as fractions of the largest load and (below 0) the largest tension."""

    low: float
    high: float
    is_share: bool

    def _load(self, end: float, load: Array) -> float:
        """Return the load at an end of the range."""
        if not self.is_share:
            return end
        return end * (float(load.max()) if end > 0 else -float(load.min()))

    def within(self, branch: Branch) -> slice:
        """Return the slice of a branch that is in contact and has loads in the range, as one run of points.

        The running median of the load decides where the slice ends, so a single noisy point cannot end it. Raises
        BadCurve if it has too few points.
        """
        load = branch.in_contact.force
        low, high = self._load(self.low, load), self._load(self.high, load)
        smooth = running_median(load)
        order = smooth if branch.name == UNLOADING else smooth[::-1]
        below = numpy.nonzero(order <= high)[0]
        first = int(below[0]) if len(below) else len(load)
        is_whole = self.is_share and self.low <= -1  # then the slice ends at the last point in contact
        beyond = numpy.nonzero(order[first:] < (-inf if is_whole else low))[0]
        last = first + int(beyond[0]) if len(beyond) else len(load)
        if last - first < LEAST_POINTS:
            raise BadCurve(f"{branch.name}: the range has fewer than {LEAST_POINTS} points", "too few points")
        if branch.name == UNLOADING:
            return slice(branch.contact.start + first, branch.contact.start + last)
        return slice(branch.contact.stop - last, branch.contact.stop - first)
