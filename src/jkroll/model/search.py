"""The search for values of one input or two, the unknowns, at which quantities have their measured values.

One unknown is found by a scan and by halving, two by a grid and Newton's method, in one row or in many.
"""

from collections.abc import Callable, Mapping, Sequence
from functools import cached_property
from math import inf, isnan, nan, prod
from types import MappingProxyType
from typing import Any, NamedTuple

import numpy
from numpy.lib.stride_tricks import sliding_window_view

from ..errors import JkrollError, NoResult
from ..physics.elementary import NUMBER
from ..quantities.formatting import amount
from ..quantities.nomenclature import NOMENCLATURE, PROPERTIES, of_sphere
from ..text import listed
from .column import broadcast
from .frame import Frame
from .ranges import LEAST, MOST
from .reasons import reason, reason_of
from .unsolved import (
    SIZES,
    NoDependence,
    NoSolution,
    SeveralSolutions,
    Undetermined,
    Unseparated,
    equal,
)

Values = Mapping[str, Any]  # by name; numbers, or an array with a value for each row
Failures = Mapping[int, JkrollError]  # by row

PER_DECADE = 8  # values of a scan
_AS_SHOWN = 1e-3  # relative difference of a quantity at a solution, or at the digits of one, from its measured value
_STEP = 1e-6  # of a logarithm, in the differences that give a derivative
_ROUNDS = 150  # of halving, or of Newton's method: more than lead from a grid to neighbouring doubles
_ROUNDING = 1e-13  # of a quantity: a change as small as this comes from rounding

# Of scans.
_TOGETHER = 1000  # rows that are scanned at once
_WIDEST = (1.01 * LEAST, MOST / 1.01)  # the sizes that are scanned where no value is found among the usual ones
_AHEAD = 1e-8  # relative, the step that tells whether a function rises or falls
_MANY = 64  # intervals of a row: more of them come from rounding

# Of pairs, in the coordinates in which they are sought.
MAX_CONDITION = 1e8  # beyond which rounding leaves the differences that the condition number is made of too few digits
_LOADS = numpy.linspace(-14.0, 46.0, 209)  # that are scanned: from 1e-6 P_c beyond pull-off to 1e20 P_c
_LAST_STEP = 1e-14  # a step as small as this ends the search
_NEAR = 1e-9  # in logarithms of the measured values: a pair that is as near as this is a solution
_SAME = 1e-5  # pairs that differ by less are one
_LINEAR = 1e-6  # part of a measured value below which a quantity counts as it is, above by its logarithm
_AT_ZERO = 1e-12  # the same where 0 was measured, in SI units: an approach, of 1 pm
_SAMPLED = 7  # cells of the grid from one to the next at which it is asked whether the quantities separate the unknowns
_TO_GAP = 20  # halvings of the way to where there are no quantities
_LEFT_OPEN = 1e-4  # an exponent as small as this is none


# --- Problems ---------------------------------------------------------------------------------------------------------


class Solution(NamedTuple):
    """The values of the unknowns of a problem: numbers, or arrays with nan in the rows that have none for a reason."""

    values: Values  # by unknown
    growths: Values = MappingProxyType({})  # by unknown, the largest factor by which relative errors of levels enter it
    condition: Any = nan  # of the logarithms of the measured values as functions of those of the unknowns
    reasons: Any = 0  # as columns have them
    failures: Failures = MappingProxyType({})  # the errors of rows whose search began from their own values
    failure: JkrollError | None = None  # the error of all rows
    places: Any = None  # of two unknowns, in the coordinates in which they were sought


class Problem:
    """The values of as many quantities as there are unknowns, and a frame of what else is known.

    The values may be arrays, and those of the frame. A value that a material has of an unknown is replaced.
    """

    def __init__(self, unknowns: Sequence[str], levels: Values, frame: Frame) -> None:
        """`levels`: the values of the quantities, by name."""
        self.unknowns, self.levels, self.frame = tuple(unknowns), levels, frame
        of_levels = {name: level for name, level in levels.items() if not isinstance(level, NUMBER)}
        self.arrays = {**frame.arrays, **of_levels}
        self.shape = broadcast(self.arrays)

    def rows(self, rows: Any) -> "Problem":
        """Return the problem of some elements of the arrays; one of numbers is the same in all rows."""
        if not self.shape:
            return self
        flat = {name: numpy.broadcast_to(array, self.shape).ravel() for name, array in self.arrays.items()}
        arrays = {name: array[rows] for name, array in flat.items()}
        levels = {name: arrays.pop(name, level) for name, level in self.levels.items()}
        return Problem(self.unknowns, levels, self.frame.replace(**arrays))

    @cached_property
    def sought(self) -> dict[str, str]:
        """The unknown of each input that is sought: of those of both spheres if one material was named for both."""
        keys, sought = [solid.key for solid, _ in self.frame.materials], {name: name for name in self.unknowns}
        if len(keys) == 2 and keys[0] == keys[1]:
            twins = {of_sphere(2, name): name for name in self.unknowns if name in PROPERTIES}
            sought |= {twin: name for twin, name in twins.items() if twin not in self.frame.stated}
        return sought

    def with_values(self, values: Values) -> Frame:
        """Return the frame with values of the unknowns, or arrays of them."""
        return self.frame.replace(**{name: values[unknown] for name, unknown in self.sought.items()})

    @cached_property
    def filled(self) -> Frame:
        """The frame with placeholders for the unknowns, the largest values."""
        return self.with_values({name: SIZES[name][1] for name in self.unknowns})

    def is_met(self, values: Mapping[str, float], digits: int) -> bool:
        """Return whether values of the unknowns, of which some digits are typed, give the measured ones as shown."""
        typed = {name: float(f"{value:.{digits}g}") for name, value in values.items()}
        forward = self.with_values(typed).numbers(*self.levels)
        return all(abs(forward.get(name, inf) - level) <= _AS_SHOWN * abs(level) for name, level in self.levels.items())

    def quantities(self, values: Values) -> Any:
        """Return the measured quantities, a row for each, at arrays of the unknowns; nan where there is no result."""
        size, known = len(next(iter(values.values()))), self.with_values(values).numbers(*self.levels)
        return numpy.array([numpy.broadcast_to(known.get(name, nan), size) for name in self.levels])

    def check(self) -> None:
        """Raise a MissingInput or NoDependence if there is no solution, whatever the measured values are."""
        for quantity in self.levels:
            if {*self.unknowns}.isdisjoint(self.filled.inputs_of(quantity)):
                unknowns = "it" if len(self.unknowns) == 1 else "either"
                raise NoDependence(self, f"{quantity} does not depend on {unknowns} here")

    def failure(self) -> JkrollError:
        """Return the reason why a measured quantity has no value for any values of the unknowns."""
        columns = self.filled.columns(self.levels)
        return next(iter(self.filled.errors(columns).values()))


def solved(problem: Problem, start: Any = None) -> Solution:
    """Return the solution of each row of a problem.

    `start`: of two unknowns in arrays, the places of a near problem, from which Newton's method leads to their own.
    Raises the reason why no row has one, whatever the measured values are.
    """
    problem.check()
    count = len(problem.unknowns)
    table, failures = _roots(problem) if count == 1 else _pairs(problem, start)
    if failures and not problem.shape:
        raise failures[0]
    measures, places = table[: 2 * count + 1], table[2 * count + 1 :]
    measures[count:] = [[float(f"{number:.6g}") for number in row] for row in measures[count:]]  # no rounding error
    *columns, condition = measures.reshape(2 * count + 1, *problem.shape) if problem.shape else measures[:, 0].tolist()
    values, growths = (dict(zip(problem.unknowns, part, strict=True)) for part in (columns[:count], columns[count:]))
    reasons: Any = 0
    if problem.shape and (lacks := numpy.isnan([*values.values()]).any(axis=0)).any():
        reasons = numpy.where(lacks, reason(NoSolution.cause), 0)
        for row, failure in failures.items():
            reasons.flat[row] = reason_of(failure)
    return Solution(values, growths, condition, reasons, failures, places=places)


# --- One unknown ------------------------------------------------------------------------------------------------------


def grid(name: str, sizes: tuple[float, float]) -> Any:
    """Return the values of an input that are scanned, in rising order."""
    least, most = sizes
    values = numpy.geomspace(least, most, round(numpy.log10(most / least) * PER_DECADE) + 1)
    return numpy.concatenate([-values[::-1], [0.0], values]) if name == "load" else values


def slopes(y: Any) -> Any:
    """Return slopes from three points a step apart; from two where y is nan at one end, and nan where it is at both."""
    low, high = numpy.diff(y, axis=0) / _STEP
    return numpy.where(numpy.isnan(low), high, numpy.where(numpy.isnan(high), low, (low + high) / 2))


def _roots(problem: Problem) -> tuple[Any, Failures]:
    """Return a table of the value of one unknown in each row, its growth and the condition; and the failures.

    Where there is no value among the usual sizes, all that a frame takes are scanned.
    """
    (unknown,) = problem.unknowns
    outcomes: dict[int, Any] = {}
    rows = [*range(prod(problem.shape))]
    for sizes in (SIZES[unknown], _WIDEST):
        for start in range(0, len(rows), _TOGETHER):
            block = rows[start : start + _TOGETHER]
            for row, outcome in zip(block, Scan(problem.rows(block)).outcomes(sizes), strict=True):
                if not (row in outcomes and isinstance(outcome, NoSolution)):  # which tells of the usual sizes
                    outcomes[row] = outcome
        rows = [row for row, outcome in outcomes.items() if isinstance(outcome, NoSolution)]
    failures = {row: outcome for row, outcome in outcomes.items() if isinstance(outcome, JkrollError)}
    roots = numpy.array([nan if row in failures else root for row, root in outcomes.items()])
    x = numpy.exp(_STEP * numpy.array([[-1], [0], [1]])) * numpy.nan_to_num(roots, nan=SIZES[unknown][1])
    y = problem.rows(numpy.tile(numpy.arange(len(roots)), 3)).quantities({unknown: x.ravel()}).reshape(3, -1)
    with numpy.errstate(divide="ignore", invalid="ignore"):
        condition = numpy.where(numpy.isnan(roots), nan, abs(y[1] / slopes(y)))
    return numpy.array([roots, condition, condition]), failures


class Scan:
    """A search for the values of one unknown in each row of a problem.

    It begins with a grid, and halves each interval at whose ends the measured quantity differs: it has a value at one
    alone, is on other sides of its level, rises at one and falls at the other, or stays at its level at one alone. So
    the ends of gaps and the extremes are found on the way, and what lies between these and the grid.

    Of all that was computed, `span` has the least and largest value of the quantity in each row, and `stretch` the
    first and the last value of the unknown at which it stays at its level, nan if there is none.
    """

    def __init__(self, problem: Problem) -> None:
        (self.unknown,), (level,) = problem.unknowns, problem.levels.values()
        size = prod(problem.shape)
        self.problem, self.levels = problem, numpy.full(size, level, dtype=float)
        self.span, self.stretch = numpy.full((2, 2, size), nan)

    def outcomes(self, sizes: tuple[float, float]) -> list[Any]:
        """Return the one value of the unknown between two sizes in each row, or why there is none."""
        rows, roots = self.roots(sizes)
        return [self._outcome(row, roots[rows == row].tolist()) for row in range(len(self.levels))]

    def _outcome(self, row: int, roots: list[float]) -> float | JkrollError:
        """Return the root of a row, or why it has no one root."""
        span, stretch = self.span[:, row].tolist(), self.stretch[:, row].tolist()
        varies = span[1] - span[0] > _ROUNDING * max(map(abs, span))
        stays = stretch[0] > 0 and stretch[1] >= 10 * stretch[0]
        if len(roots) == 1 and varies and not stays:
            return roots[0]
        problem = self.problem.rows(row)
        if isnan(span[0]):
            return problem.failure()
        if not varies:
            return NoDependence(problem, f"{next(iter(problem.levels))} does not depend on it here")
        if stays:
            first, last = (amount(self.unknown, end) for end in stretch)
            return Undetermined(problem, f"every value from {first} to {last} gives {equal(problem.levels)}", stretch)
        values = [{self.unknown: root} for root in roots]
        return SeveralSolutions(problem, values) if values else NoSolution(problem, [span])

    def roots(self, sizes: tuple[float, float]) -> tuple[Any, Any]:
        """Return the rows and values of all places between two sizes at which the quantity has its level, in order."""
        size, x = len(self.levels), grid(self.unknown, sizes)
        points = self._points(numpy.repeat(numpy.arange(size), len(x)), numpy.tile(x, size))
        is_exact = points.y == self.levels[points.row]  # as without load
        points.side[is_exact] = 0
        exact = numpy.array([points.row, points.x])[:, is_exact]
        left, right = points.each(lambda column: column.reshape(size, -1)).ends()
        for _ in range(_ROUNDS):
            crosses = (numpy.isnan(left.y) != numpy.isnan(right.y)) | (left.side * right.side < 0)
            differs = crosses | (left.stays != right.stays) | (left.slope * right.slope < 0)
            differs &= crosses | (numpy.bincount(left.row[differs], minlength=size)[left.row] <= _MANY)
            left, right = left.at(differs), right.at(differs)
            middle = (left.x + right.x) / 2
            if ((middle == left.x) | (middle == right.x)).all():
                break
            points = self._points(left.row, middle)
            left, right = left.with_more(points), points.with_more(right)
        # A crossing is a root but for a jump, beside which no value is the level as it is shown. Doubles may have none.
        level = self.levels[left.row]
        off = abs(numpy.array([left.y, right.y]) - level)
        is_near = off.min(axis=0) <= _AS_SHOWN * numpy.where(level == 0, off.max(axis=0), abs(level))
        crossings = numpy.array([left.row, numpy.where(off[0] < off[1], left.x, right.x)])
        every = [exact, crossings[:, (left.side * right.side < 0) & is_near]]
        rows, roots = numpy.unique(numpy.concatenate(every, axis=1), axis=1)
        return rows.astype(int), roots

    def _points(self, rows: Any, x: Any) -> "Points":
        """Return points of rows."""
        every = {self.unknown: numpy.concatenate([x, x + _AHEAD * abs(x)])}
        y, ahead = self.problem.rows(numpy.tile(rows, 2)).quantities(every).reshape(2, -1)
        level, change = self.levels[rows], numpy.nan_to_num(ahead - y)
        slope = numpy.where(abs(change) > _ROUNDING * abs(y), numpy.sign(change), 0.0)
        stays = (slope == 0) & (abs(y - level) <= _ROUNDING * abs(level))
        for extent, values in ((self.span, y), (self.stretch, numpy.where(stays, x, nan))):
            numpy.fmin.at(extent[0], rows, values)
            numpy.fmax.at(extent[1], rows, values)
        return Points(rows, x, y, numpy.where(y < level, -1.0, 1.0), stays, slope)


class Points(NamedTuple):
    """Points of a scan: arrays of one shape."""

    row: Any
    x: Any  # the unknown
    y: Any  # the measured quantity, nan where it has no value
    side: Any  # of the level: -1 below it, 1 above it, 0 at it
    stays: Any  # whether the quantity stays at its level
    slope: Any  # the sign of the change of the quantity with the unknown

    def each(self, change: Callable[[Any], Any]) -> "Points":
        """Return the points with all columns changed alike."""
        return Points(*map(change, self))

    def at(self, chosen: Any) -> "Points":
        """Return some of the points."""
        return self.each(lambda column: column[chosen])

    def ends(self) -> tuple["Points", "Points"]:
        """Return the points at which intervals along the last axis begin, and at which they end."""
        return self.at((..., slice(None, -1))), self.at((..., slice(1, None)))

    def with_more(self, others: "Points") -> "Points":
        """Return the points, and others behind them."""
        return Points(*map(numpy.concatenate, zip(self, others, strict=True)))


# --- Two unknowns -----------------------------------------------------------------------------------------------------


def _pairs(problem: Problem, start: Any = None) -> tuple[Any, Failures]:
    """Return a table of two unknowns in each row, their growths, the condition and the places; and the failures.

    From the places of a near problem, whose rows are repeated, Newton's method leads to those of arrays. Where it leads
    to none, a row is solved by itself: each row of the other problem until one of its repeats has none.
    """
    count = size = prod(problem.shape)
    table, failures, lost = numpy.full((7, size), nan), dict[int, JkrollError](), set[int]()
    if problem.shape and start is not None:
        pairs = Pairs(problem)
        count, lost = start.shape[1], {*numpy.flatnonzero(numpy.isnan(start[0])).tolist()}
        places, distance = pairs.improved(numpy.tile(numpy.nan_to_num(start), size // count))
        table = pairs.table(places)
        table[:, (distance == inf) | (table[4] > MAX_CONDITION)] = nan
    for row in numpy.flatnonzero(numpy.isnan(table[0])).tolist():
        if row % count in lost:
            continue
        try:
            table[:, [row]] = Pairs(problem.rows(row)).pair()
        except NoResult as error:
            failures[row] = error.with_traceback(None)  # which holds all that was computed
            if count < size:
                lost.add(row % count)
    return table, failures


class Pairs:
    """A problem of two unknowns, in one row or many, in the coordinates in which they are sought.

    An unknown counts by its logarithm, and a load by ln(1 + P/P_c), which has no end at pull-off. A quantity counts by
    its logarithm, too, and as it is where it is next to zero. Places are arrays with a row for each unknown: those of
    an array of rows stand behind each other, one or several times.
    """

    def __init__(self, problem: Problem) -> None:
        self.problem = problem
        self.load = problem.unknowns.index("load") if "load" in problem.unknowns else None
        self.axes = [_LOADS if name == "load" else numpy.log(grid(name, SIZES[name])) for name in problem.unknowns]
        self.ends = [numpy.array([[axis[end]] for axis in self.axes]) for end in (0, -1)]
        levels = (numpy.broadcast_to(level, problem.shape).ravel() for level in problem.levels.values())
        self.levels = numpy.array([*levels], dtype=float)

    def points(self, places: Any) -> tuple[Any, Any, Any]:
        """Return at places the values of the unknowns, the quantities, and by how much these are above their levels."""
        rows = numpy.arange(places.shape[1]) % self.levels.shape[1]
        problem, levels = self.problem.rows(rows), self.levels[:, rows]
        values = dict(zip(problem.unknowns, numpy.exp(places), strict=True))
        if self.load is not None:
            unloaded = problem.with_values({**values, "load": 0.0}).numbers("pull_off_force")
            force = unloaded.get("pull_off_force", SIZES["load"][0])  # the smallest that is scanned where there is none
            is_unloaded = abs(places[self.load]) <= _NEAR
            load = numpy.clip(force * numpy.expm1(places[self.load]), -MOST, MOST)
            values["load"] = numpy.where(is_unloaded, 0.0, load)
        quantities, linear = problem.quantities(values), numpy.where(levels == 0, _AT_ZERO, _LINEAR * abs(levels))
        residuals = numpy.arcsinh(quantities / linear) - numpy.arcsinh(levels / linear)
        return numpy.array([*values.values()]), quantities, residuals

    def slopes(self, places: Any) -> tuple[Any, Any]:
        """Return values and residuals at places, in four rows, and their derivatives in matrices of a place each."""
        count = places.shape[1]
        steps = _STEP * numpy.array([[0, -1, 1, 0, 0], [0, 0, 0, -1, 1]])
        values, _, residuals = self.points(numpy.tile(places, 5) + steps.repeat(count, axis=1))
        points = numpy.concatenate([values, residuals]).reshape(4, 5, count).swapaxes(0, 1)
        return points[0], numpy.array([slopes(points[[low, 0, low + 1]]) for low in (1, 3)]).T

    def table(self, places: Any) -> Any:
        """Return the values of the unknowns at places, the growths of errors there, the condition, and the places."""
        here, matrices = self.slopes(places)
        values, changes, matrices = here[:2], matrices[:, :2], numpy.nan_to_num(matrices[:, 2:])
        inverse = numpy.linalg.pinv(matrices, rcond=0.1 / MAX_CONDITION)
        with numpy.errstate(divide="ignore", invalid="ignore"):
            growths = numpy.linalg.norm(changes @ inverse, axis=2).T / abs(values)
        return numpy.array([*values, *growths, numpy.linalg.cond(matrices), *places])

    def improved(self, start: Any) -> tuple[Any, Any]:
        """Return the places to which Newton's method leads from others, and how far they are from solutions.

        The distance is infinite where there is none, or not among the sizes that are looked for, but for rounding.
        """
        best, steps, distance = start, numpy.zeros_like(start), numpy.full(start.shape[1], inf)
        for _ in range(_ROUNDS):
            places = numpy.clip(best + steps, *self.ends)
            here, matrices = self.slopes(places)
            size = numpy.hypot(*here[2:])
            is_nearer = size < distance
            best, distance = numpy.where(is_nearer, places, best), numpy.where(is_nearer, size, distance)
            # Where both quantities change alike, the pseudo-inverse gives the shortest step.
            inverse = numpy.linalg.pinv(numpy.nan_to_num(matrices[:, 2:]), rcond=0.01 / MAX_CONDITION)
            newton = -numpy.einsum("kij,jk->ik", inverse, numpy.nan_to_num(here[2:]))
            limited = newton / numpy.maximum(1.0, numpy.hypot(*newton))
            steps = numpy.where(is_nearer, limited, steps / 2)
            if (abs(steps) <= _LAST_STEP).all():
                break
        return best, numpy.where(distance <= _NEAR, distance, inf)

    def pair(self) -> Any:
        """Return the table of the one pair. Raises the reason why there is none."""
        problem, mesh = self.problem, numpy.array(numpy.meshgrid(*self.axes, indexing="ij"))
        matrices = self.slopes(mesh[:, ::_SAMPLED, ::_SAMPLED].reshape(2, -1))[1][:, 2:]
        known = matrices[numpy.isfinite(matrices).all(axis=(1, 2))]
        if len(known) and numpy.linalg.cond(known).min() > MAX_CONDITION / 10:
            raise self._unseparated(known[len(known) // 2])
        _, quantities, residuals = self.points(mesh.reshape(2, -1))
        places, distance = self.improved(self._starts(mesh, residuals.reshape(mesh.shape)))
        places = places[:, numpy.argsort(distance)[: numpy.isfinite(distance).sum()]]
        if not places.size:
            if not numpy.isfinite(quantities.sum(axis=0)).any():
                raise problem.failure()
            spans = numpy.transpose([numpy.nanmin(quantities, axis=1), numpy.nanmax(quantities, axis=1)])
            raise NoSolution(problem, spans.tolist())
        table = self.table(places)
        if (is_open := table[4] > MAX_CONDITION).any():
            raise self._unseparated(self.slopes(places[:, is_open])[1][0, 2:])
        is_same = (abs(places[:, :, None] - places[:, None]) <= _SAME).all(axis=0)
        distinct = numpy.unique(is_same.argmax(axis=0))  # of pairs that are the same, the nearest
        if len(distinct) > 1:
            rows = sorted(table[:2, distinct].T.tolist())
            raise SeveralSolutions(problem, [dict(zip(problem.unknowns, row, strict=True)) for row in rows])
        return table[:, :1]

    def _starts(self, mesh: Any, residuals: Any) -> Any:
        """Return places in the cells of a grid in which both measured values lie between corners, or beside a gap.

        They are the middles of the corners that have quantities and, beside a gap, also places next to it.
        """
        corners, ends = (sliding_window_view(each, (2, 2), axis=(1, 2)) for each in (residuals, mesh))
        low, high = (each.reduce(corners, axis=(3, 4)) for each in (numpy.fmin, numpy.fmax))
        has = numpy.isfinite(corners).all(axis=0)  # both quantities
        is_gap = ~has.all(axis=(2, 3))
        cells = ((low <= 0) & (high >= 0) | is_gap).all(axis=0) & has.any(axis=(2, 3))
        middles = numpy.nanmean(numpy.where(has, ends, nan)[:, cells], axis=(2, 3))
        near = middles[:, is_gap[cells]]
        far = numpy.nanmean(numpy.where(has, nan, ends)[:, cells & is_gap], axis=(2, 3))
        for _ in range(_TO_GAP):
            half = (near + far) / 2
            is_near = numpy.isfinite(self.points(half)[1]).all(axis=0)
            near, far = numpy.where(is_near, half, near), numpy.where(is_near, far, half)
        return numpy.concatenate([middles, near], axis=1)

    def _unseparated(self, matrix: Any) -> Unseparated:
        """Return the error that names the direction in which both quantities stay as they are, by their derivatives."""
        symbols = [NOMENCLATURE[name].symbol for name in self.problem.unknowns]
        exponents = abs(matrix).max(axis=0).tolist()
        if left_open := [symbols[position] for position, exponent in enumerate(exponents) if exponent <= _LEFT_OPEN]:
            remark = f"they leave {listed(left_open)} open"
        else:
            if self.load is not None:
                symbols[self.load] = "(1 + P/P_c)"  # by whose logarithm a load counts
            direction = numpy.linalg.svd(matrix)[2][-1]  # in which the quantities change least
            remark = f"both stay as they are along {symbols[0]} ∝ {symbols[1]}^{direction[0] / direction[1]:.3g}"
        remedy = "measure another quantity, or give one of the two"
        text = f"{listed(self.problem.levels)} cannot give both: {remark} (κ is above 1e8); {remedy}"
        return Unseparated(self.problem, text)
