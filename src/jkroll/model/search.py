"""The search for one or two unknown inputs at which quantities have their measured values, in one row or many.

One unknown is found by a scan and bisection, two by a grid and Newton's method.
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
from .accepted import LEAST, MOST
from .column import broadcast
from .frame import Frame
from .reasons import reason, reason_of
from .unknowns import (
    SIZES,
    NoDependence,
    NoSolution,
    SeveralSolutions,
    Undetermined,
    Unseparated,
    equations,
)

Values = Mapping[str, Any]  # by name: numbers, or arrays with a value for each row
Failures = Mapping[int, JkrollError]  # by row

PER_DECADE = 8  # values in a scan
_AS_SHOWN = 1e-3  # largest relative error of a measured quantity at a solution, also at one rounded for display
_STEP = 1e-6  # step of a logarithm, for numerical derivatives
_ROUNDS = 150  # rounds of bisection or of Newton's method: enough to reach neighbouring doubles
_ROUNDING = 1e-13  # relative change of a quantity that may come from rounding

# For scans.
_TOGETHER = 1000  # rows in one scan
_WIDEST = (1.01 * LEAST, MOST / 1.01)  # sizes to scan if no usual size is a solution
_AHEAD = 1e-8  # relative step that shows whether a function rises or falls
_MANY = 64  # if more intervals of a row have ends that differ, rounding causes the differences

# For two unknowns, in the coordinates of `Pairs`.
MAX_CONDITION = 1e8  # above it, rounding leaves the numerical derivatives too few digits
_LOADS = numpy.linspace(-14.0, 46.0, 209)  # from 1e-6 P_c above the load at pull-off, −P_c, to 1e20 P_c
_LAST_STEP = 1e-14  # the search ends at this step
_NEAR = 1e-9  # largest residual of a solution, in logarithms of the measured values
_SAME = 1e-5  # pairs that differ by less are the same
_LINEAR = 1e-6  # below this fraction of its measured value a quantity enters linearly, above it by logarithm
_AT_ZERO = 1e-12  # the same limit for a measured value of 0, in SI units: 1 pm for an approach
_SAMPLED = 7  # every seventh value on each axis of the grid is tested: do the quantities separate the unknowns?
_TO_GAP = 20  # bisections towards the edge of a gap, a region in which a quantity has no value
_LEFT_OPEN = 1e-4  # smaller exponents of an unknown count as 0


# --- Problems ---------------------------------------------------------------------------------------------------------


class Solution(NamedTuple):
    """The values of the unknowns of a problem: numbers, or arrays with nan in rows that have a reason."""

    values: Values  # by unknown
    # By unknown: the largest ratio of its relative error to that of the measured values.
    growths: Values = MappingProxyType({})
    condition: Any = nan  # condition number of measured values as functions of the unknowns, both in logarithms
    reasons: Any = 0  # as in columns
    failures: Failures = MappingProxyType({})  # errors of single rows
    failure: JkrollError | None = None  # the common error of all rows
    positions: Any = None  # of two unknowns, in the coordinates of the search


class Problem:
    """Measured values of as many quantities as there are unknowns, and a frame of the known inputs.

    The measured values and the known inputs may be arrays. A material's value of an unknown is replaced.
    """

    def __init__(self, unknowns: Sequence[str], levels: Values, frame: Frame) -> None:
        """`levels`: the measured values, by quantity."""
        self.unknowns, self.levels, self.frame = tuple(unknowns), levels, frame
        of_levels = {name: level for name, level in levels.items() if not isinstance(level, NUMBER)}
        self.arrays = {**frame.arrays, **of_levels}
        self.shape = broadcast(self.arrays)

    def rows(self, rows: Any) -> "Problem":
        """Return the problem of some rows; a problem of numbers is the same in all rows."""
        if not self.shape:
            return self
        flat = {name: numpy.broadcast_to(array, self.shape).ravel() for name, array in self.arrays.items()}
        arrays = {name: array[rows] for name, array in flat.items()}
        levels = {name: arrays.pop(name, level) for name, level in self.levels.items()}
        return Problem(self.unknowns, levels, self.frame.replace(**arrays))

    @cached_property
    def sought(self) -> dict[str, str]:
        """The unknown that gives each sought input. If both spheres are of one material, they share the unknown."""
        sought = {name: name for name in self.unknowns}
        keys = [solid.key for solid, _ in self.frame.materials]
        if len(keys) == 2 and keys[0] == keys[1]:
            for name in self.unknowns:
                twin = of_sphere(2, name)
                if name in PROPERTIES and twin not in self.frame.stated:
                    sought[twin] = name
        return sought

    def with_values(self, values: Values) -> Frame:
        """Return the frame with these values of the unknowns, which may be arrays."""
        return self.frame.replace(**{name: values[unknown] for name, unknown in self.sought.items()})

    @cached_property
    def filled(self) -> Frame:
        """The frame with placeholders for the unknowns: the largest sizes."""
        return self.with_values({name: SIZES[name][1] for name in self.unknowns})

    def is_met(self, values: Mapping[str, float], digits: int) -> bool:
        """Return whether the unknowns, rounded to some digits, reproduce the measured values within 0.1 %."""
        typed = {name: float(f"{value:.{digits}g}") for name, value in values.items()}
        forward = self.with_values(typed).numbers(*self.levels)
        for name, level in self.levels.items():
            error = abs(forward.get(name, inf) - level)
            if not error <= _AS_SHOWN * abs(level):  # an error may be nan
                return False
        return True

    def quantities(self, values: Values) -> Any:
        """Return an array with a row for each measured quantity, at arrays of the unknowns; nan for no result."""
        size = len(next(iter(values.values())))
        numbers = self.with_values(values).numbers(*self.levels)
        return numpy.array([numpy.broadcast_to(numbers.get(name, nan), size) for name in self.levels])

    def check(self) -> None:
        """Raise MissingInput or NoDependence if no measured value can have a solution."""
        for quantity in self.levels:
            if {*self.unknowns}.isdisjoint(self.filled.inputs_of(quantity)):
                unknowns = "the unknown" if len(self.unknowns) == 1 else "either unknown"
                raise NoDependence(self, f"{quantity} does not depend on {unknowns} here")

    def failure(self) -> JkrollError:
        """Return the error of the first measured quantity without a value at the placeholders of the unknowns."""
        columns = self.filled.columns(self.levels)
        return next(iter(self.filled.errors(columns).values()))


class _Table(NamedTuple):
    """The solutions of all rows of a problem as arrays, with nan in rows without one, and the errors of these rows."""

    values: Any  # with a row for each unknown, as the growths
    growths: Any
    condition: Any
    failures: Failures
    positions: Any = None  # of two unknowns


def solved(problem: Problem, start: Any = None) -> Solution:
    """Return the solution of each row of a problem.

    `start`: the positions of a similar problem, where Newton's method starts for two unknowns in arrays. Raises an
    error if no row can have a solution, or if the only row has not exactly one.
    """
    problem.check()
    table = _roots(problem) if len(problem.unknowns) == 1 else _pairs(problem, start)
    if table.failures and not problem.shape:
        raise table.failures[0]

    def shaped(column: Any) -> Any:
        return column.reshape(problem.shape) if problem.shape else column.item()

    values = dict(zip(problem.unknowns, map(shaped, table.values), strict=True))
    growths = dict(zip(problem.unknowns, map(shaped, _rounded(table.growths)), strict=True))
    reasons: Any = 0
    if problem.shape:
        is_unsolved = numpy.isnan([*values.values()]).any(axis=0)
        if is_unsolved.any():
            reasons = numpy.where(is_unsolved, reason(NoSolution.cause), 0)
            for index, failure in table.failures.items():
                reasons.flat[index] = reason_of(failure)
    condition = shaped(_rounded(table.condition))
    return Solution(values, growths, condition, reasons, table.failures, positions=table.positions)


def _rounded(array: Any) -> Any:
    """Return an array of numbers with 6 digits; further digits come from rounding errors."""
    return numpy.array([float(f"{number:.6g}") for number in array.ravel()]).reshape(array.shape)


# --- One unknown ------------------------------------------------------------------------------------------------------


def grid(name: str, sizes: tuple[float, float]) -> Any:
    """Return the values of an input to scan, in rising order."""
    least, most = sizes
    values = numpy.geomspace(least, most, round(numpy.log10(most / least) * PER_DECADE) + 1)
    return numpy.concatenate([-values[::-1], [0.0], values]) if name == "load" else values


def slopes(y: Any) -> Any:
    """Return slopes from three points a step apart; if y is nan at one end, from the other two."""
    low, high = numpy.diff(y, axis=0) / _STEP
    return numpy.where(numpy.isnan(low), high, numpy.where(numpy.isnan(high), low, (low + high) / 2))


def _roots(problem: Problem) -> _Table:
    """Return the solutions for one unknown.

    If no usual size is a solution, all sizes that a frame accepts are scanned.
    """
    (unknown,) = problem.unknowns
    outcomes: dict[int, Any] = {}
    rows = [*range(prod(problem.shape))]
    for sizes in (SIZES[unknown], _WIDEST):
        for start in range(0, len(rows), _TOGETHER):
            block = rows[start : start + _TOGETHER]
            for row, outcome in zip(block, Scan(problem.rows(block)).outcomes(sizes), strict=True):
                if not (row in outcomes and isinstance(outcome, NoSolution)):  # keep the error for the usual sizes
                    outcomes[row] = outcome
        rows = [row for row, outcome in outcomes.items() if isinstance(outcome, NoSolution)]
    failures = {row: outcome for row, outcome in outcomes.items() if isinstance(outcome, JkrollError)}
    roots = numpy.array([nan if row in failures else root for row, root in outcomes.items()])
    x = numpy.exp(_STEP * numpy.array([[-1], [0], [1]])) * numpy.nan_to_num(roots, nan=SIZES[unknown][1])
    y = problem.rows(numpy.tile(numpy.arange(len(roots)), 3)).quantities({unknown: x.ravel()}).reshape(3, -1)
    with numpy.errstate(divide="ignore", invalid="ignore"):
        condition = numpy.where(numpy.isnan(roots), nan, abs(y[1] / slopes(y)))
    return _Table(roots[None], condition[None], condition, failures)


class Scan:
    """A search for the values of one unknown in each row of a problem.

    It starts with a grid, and bisects each interval whose ends differ: the quantity exists at one end only, crosses its
    level, rises at one end and falls at the other, or stays at its level at one end only. The bisection finds the edges
    of gaps and the extremes, and then the roots between them and the grid.

    `span` holds the least and the largest value of the quantity in each row, over all points computed. `stretch` holds
    the least and the largest value of the unknown at which the quantity stays at its level, nan if there is none.
    """

    def __init__(self, problem: Problem) -> None:
        (self.unknown,), (level,) = problem.unknowns, problem.levels.values()
        size = prod(problem.shape)
        self.problem, self.levels = problem, numpy.full(size, level, dtype=float)
        self.span, self.stretch = numpy.full((2, 2, size), nan)

    def outcomes(self, sizes: tuple[float, float]) -> list[Any]:
        """Return for each row the root between two sizes, or the error if there is not exactly one."""
        rows, roots = self.roots(sizes)
        return [self._outcome(row, roots[rows == row].tolist()) for row in range(len(self.levels))]

    def _outcome(self, row: int, roots: list[float]) -> float | JkrollError:
        """Return the root of a row, or the error if it does not have exactly one."""
        (least, most), (first, last) = self.span[:, row].tolist(), self.stretch[:, row].tolist()
        varies = most - least > _ROUNDING * max(abs(least), abs(most))
        stays = first > 0 and last >= 10 * first  # at the level over a decade at least
        if len(roots) == 1 and varies and not stays:
            return roots[0]
        problem = self.problem.rows(row)
        if isnan(least):
            return problem.failure()
        if not varies:
            return NoDependence(problem, f"{next(iter(problem.levels))} does not depend on the unknown here")
        if stays:
            ends = f"{amount(self.unknown, first)} to {amount(self.unknown, last)}"
            return Undetermined(problem, f"every value from {ends} gives {equations(problem.levels)}", (first, last))
        values = [{self.unknown: root} for root in roots]
        return SeveralSolutions(problem, values) if values else NoSolution(problem, [(least, most)])

    def roots(self, sizes: tuple[float, float]) -> tuple[Any, Any]:
        """Return the rows and the values of all roots between two sizes, in rising order."""
        size, x = len(self.levels), grid(self.unknown, sizes)
        points = self._points(numpy.repeat(numpy.arange(size), len(x)), numpy.tile(x, size))
        is_exact = points.y == self.levels[points.row]  # such as an unloaded contact
        points.side[is_exact] = 0
        exact = numpy.array([points.row, points.x])[:, is_exact]
        left, right = points.each(lambda column: column.reshape(size, -1)).ends()
        for _ in range(_ROUNDS):
            differs = self._differs(left, right)
            left, right = left.at(differs), right.at(differs)
            middle = (left.x + right.x) / 2
            if ((middle == left.x) | (middle == right.x)).all():
                break
            points = self._points(left.row, middle)
            left, right = left.with_more(points), points.with_more(right)
        rows, roots = numpy.unique(numpy.concatenate([exact, self._crossings(left, right)], axis=1), axis=1)
        return rows.astype(int), roots

    def _differs(self, left: "Points", right: "Points") -> Any:
        """Return the intervals to bisect: those whose ends differ.

        In a row with too many of them, only crossings of the level and edges of gaps count.
        """
        crosses = (numpy.isnan(left.y) != numpy.isnan(right.y)) | (left.side * right.side < 0)
        differs = crosses | (left.stays != right.stays) | (left.slope * right.slope < 0)
        counts = numpy.bincount(left.row[differs], minlength=len(self.levels))
        return differs & (crosses | (counts[left.row] <= _MANY))

    def _crossings(self, left: "Points", right: "Points") -> Any:
        """Return the rows and the roots of intervals in which the quantity crosses its level.

        A jump across the level is no root, since neither end has a value close to the level.
        """
        level = self.levels[left.row]
        off = abs(numpy.array([left.y, right.y]) - level)
        is_near = off.min(axis=0) <= _AS_SHOWN * numpy.where(level == 0, off.max(axis=0), abs(level))
        ends = numpy.array([left.row, numpy.where(off[0] < off[1], left.x, right.x)])
        return ends[:, (left.side * right.side < 0) & is_near]

    def _points(self, rows: Any, x: Any) -> "Points":
        """Return the points at values of the unknown in rows; `span` and `stretch` are extended to include them."""
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
    """Points of a scan, as arrays of one shape."""

    row: Any
    x: Any  # the value of the unknown
    y: Any  # the measured quantity at x, nan where it has no value
    side: Any  # -1 below the level, 0 at a point of the grid exactly at it, otherwise 1, also where y is nan
    stays: Any  # True if the quantity stays at its level
    slope: Any  # the sign of the derivative by the unknown

    def each(self, change: Callable[[Any], Any]) -> "Points":
        """Return the points with a function applied to all columns."""
        return Points(*map(change, self))

    def at(self, chosen: Any) -> "Points":
        """Return some of the points."""
        return self.each(lambda column: column[chosen])

    def ends(self) -> tuple["Points", "Points"]:
        """Return the first and the last points of the intervals along the last axis."""
        return self.at((..., slice(None, -1))), self.at((..., slice(1, None)))

    def with_more(self, others: "Points") -> "Points":
        """Return the points followed by others."""
        return Points(*map(numpy.concatenate, zip(self, others, strict=True)))


# --- Two unknowns -----------------------------------------------------------------------------------------------------


def _pairs(problem: Problem, start: Any = None) -> _Table:
    """Return the solutions for two unknowns.

    For arrays, Newton's method starts from the positions of a similar problem, whose rows repeat here. A row in which
    the method fails is solved on its own. Once one repeat of a row has no solution, its other repeats are skipped.
    """
    count = size = prod(problem.shape)
    table, failures, unsolved = numpy.full((7, size), nan), dict[int, JkrollError](), set[int]()
    if problem.shape and start is not None:
        pairs = Pairs(problem)
        count, unsolved = start.shape[1], {*numpy.flatnonzero(numpy.isnan(start[0])).tolist()}
        positions, distance = pairs.improved(numpy.tile(numpy.nan_to_num(start), size // count))
        table = pairs.table(positions)
        table[:, (distance == inf) | (table[_CONDITION] > MAX_CONDITION)] = nan
    for row in numpy.flatnonzero(numpy.isnan(table[_CONDITION])).tolist():
        if row % count in unsolved:
            continue
        try:
            table[:, [row]] = Pairs(problem.rows(row)).pair()
        except NoResult as error:
            failures[row] = error.with_traceback(None)  # a traceback would keep all arrays alive
            if count < size:
                unsolved.add(row % count)
    return _Table(table[_VALUES], table[_GROWTHS], table[_CONDITION], failures, table[_POSITIONS])


# The rows of an array with a column for each pair.
_VALUES, _GROWTHS, _CONDITION, _POSITIONS = slice(0, 2), slice(2, 4), 4, slice(5, 7)


class Linear(NamedTuple):
    """The unknowns and the residuals at positions, and their derivatives by coordinate: a matrix for each position."""

    values: Any
    residuals: Any
    of_values: Any  # derivatives
    of_residuals: Any


class Pairs:
    """A problem of two unknowns, in one row or many, in the coordinates of the search.

    The coordinates are logarithms of the unknowns, and ln(1 + P/P_c) for a load, which spreads the loads near pull-off.
    Quantities also enter by logarithms, but linearly near zero. Positions are the columns of an array; those of all
    rows of a problem are concatenated, once or repeatedly.
    """

    def __init__(self, problem: Problem) -> None:
        self.problem = problem
        self.load = problem.unknowns.index("load") if "load" in problem.unknowns else None
        self.axes = [_LOADS if name == "load" else numpy.log(grid(name, SIZES[name])) for name in problem.unknowns]
        self.ends = [numpy.array([[axis[end]] for axis in self.axes]) for end in (0, -1)]
        levels = (numpy.broadcast_to(level, problem.shape).ravel() for level in problem.levels.values())
        self.levels = numpy.array([*levels], dtype=float)

    def points(self, positions: Any) -> tuple[Any, Any, Any]:
        """Return the unknowns, the quantities and their residuals at positions."""
        rows = numpy.arange(positions.shape[1]) % self.levels.shape[1]
        problem, levels = self.problem.rows(rows), self.levels[:, rows]
        values = dict(zip(problem.unknowns, numpy.exp(positions), strict=True))
        if self.load is not None:
            unloaded = problem.with_values({**values, "load": 0.0}).numbers("pull_off_force")
            force = unloaded.get("pull_off_force", SIZES["load"][0])  # without a value, the least load scanned
            is_unloaded = abs(positions[self.load]) <= _NEAR
            load = numpy.clip(force * numpy.expm1(positions[self.load]), -MOST, MOST)
            values["load"] = numpy.where(is_unloaded, 0.0, load)
        quantities, linear = problem.quantities(values), numpy.where(levels == 0, _AT_ZERO, _LINEAR * abs(levels))
        residuals = numpy.arcsinh(quantities / linear) - numpy.arcsinh(levels / linear)
        return numpy.array([*values.values()]), quantities, residuals

    def linear(self, positions: Any) -> Linear:
        """Return the unknowns, the residuals and their derivatives at positions."""
        count = positions.shape[1]
        steps = _STEP * numpy.array([[0, -1, 1, 0, 0], [0, 0, 0, -1, 1]])
        values, _, residuals = self.points(numpy.tile(positions, 5) + steps.repeat(count, axis=1))
        # A block of four rows, two values and two residuals, for each of the five steps.
        here, *stepped = numpy.concatenate([values, residuals]).reshape(4, 5, count).swapaxes(0, 1)
        matrices = []
        for below, above in (stepped[:2], stepped[2:]):
            matrices.append(slopes(numpy.array([below, here, above])))
        derivatives = numpy.array(matrices).T
        return Linear(here[:2], here[2:], derivatives[:, :2], derivatives[:, 2:])

    def table(self, positions: Any) -> Any:
        """Return an array with a column for each position: unknowns, growths of errors, condition and position."""
        values, _, of_values, of_residuals = self.linear(positions)
        matrices = numpy.nan_to_num(of_residuals)
        inverse = numpy.linalg.pinv(matrices, rcond=0.1 / MAX_CONDITION)
        with numpy.errstate(divide="ignore", invalid="ignore"):
            growths = numpy.linalg.norm(of_values @ inverse, axis=2).T / abs(values)
        return numpy.array([*values, *growths, numpy.linalg.cond(matrices), *positions])

    def improved(self, start: Any) -> tuple[Any, Any]:
        """Return the positions that Newton's method reaches from a start, and the distances of the residuals from 0.

        A distance is infinite if the method reaches no solution within the sizes of the search.
        """
        best, steps, distance = start, numpy.zeros_like(start), numpy.full(start.shape[1], inf)
        for _ in range(_ROUNDS):
            positions = numpy.clip(best + steps, *self.ends)
            _, residuals, _, of_residuals = self.linear(positions)
            size = numpy.hypot(*residuals)
            is_nearer = size < distance
            best, distance = numpy.where(is_nearer, positions, best), numpy.where(is_nearer, size, distance)
            # If both quantities change in the same direction, the pseudo-inverse gives the shortest step.
            inverse = numpy.linalg.pinv(numpy.nan_to_num(of_residuals), rcond=0.01 / MAX_CONDITION)
            newton = -numpy.einsum("kij,jk->ik", inverse, numpy.nan_to_num(residuals))
            limited = newton / numpy.maximum(1.0, numpy.hypot(*newton))
            steps = numpy.where(is_nearer, limited, steps / 2)
            if (abs(steps) <= _LAST_STEP).all():
                break
        return best, numpy.where(distance <= _NEAR, distance, inf)

    def pair(self) -> Any:
        """Return the only pair as a column of `table`.

        Raises an error if there is no pair, or more than one, or if the quantities do not separate the unknowns.
        """
        problem, mesh = self.problem, numpy.array(numpy.meshgrid(*self.axes, indexing="ij"))
        matrices = self.linear(mesh[:, ::_SAMPLED, ::_SAMPLED].reshape(2, -1)).of_residuals
        known = matrices[numpy.isfinite(matrices).all(axis=(1, 2))]
        if len(known) and numpy.linalg.cond(known).min() > MAX_CONDITION / 10:
            raise self._unseparated(known[len(known) // 2])
        _, quantities, residuals = self.points(mesh.reshape(2, -1))
        positions, distance = self.improved(self._starts(mesh, residuals.reshape(mesh.shape)))
        nearest_first, count = numpy.argsort(distance), numpy.isfinite(distance).sum()
        positions = positions[:, nearest_first[:count]]
        if not positions.size:
            if not numpy.isfinite(quantities.sum(axis=0)).any():
                raise problem.failure()
            spans = numpy.transpose([numpy.nanmin(quantities, axis=1), numpy.nanmax(quantities, axis=1)])
            raise NoSolution(problem, spans.tolist())
        table = self.table(positions)
        is_open = table[_CONDITION] > MAX_CONDITION
        if is_open.any():
            raise self._unseparated(self.linear(positions[:, is_open]).of_residuals[0])
        is_same = (abs(positions[:, :, None] - positions[:, None]) <= _SAME).all(axis=0)
        distinct = numpy.unique(is_same.argmax(axis=0))  # the first of equal pairs is the nearest
        if len(distinct) > 1:
            several = sorted(table[_VALUES, distinct].T.tolist())
            raise SeveralSolutions(problem, [dict(zip(problem.unknowns, values, strict=True)) for values in several])
        return table[:, :1]

    def _starts(self, mesh: Any, residuals: Any) -> Any:
        """Return starts in the cells of a grid in which each residual changes its sign or has a gap.

        A start is the mean of the corners where both quantities have values. In a cell with a gap, a position close to
        the edge of the gap is another start.
        """
        corners, ends = (sliding_window_view(grids, (2, 2), axis=(1, 2)) for grids in (residuals, mesh))
        low, high = (extreme.reduce(corners, axis=(3, 4)) for extreme in (numpy.fmin, numpy.fmax))
        has_values = numpy.isfinite(corners).all(axis=0)
        is_gap = ~has_values.all(axis=(2, 3))
        cells = ((low <= 0) & (high >= 0) | is_gap).all(axis=0) & has_values.any(axis=(2, 3))
        middles = numpy.nanmean(numpy.where(has_values, ends, nan)[:, cells], axis=(2, 3))
        near = middles[:, is_gap[cells]]
        far = numpy.nanmean(numpy.where(has_values, nan, ends)[:, cells & is_gap], axis=(2, 3))
        for _ in range(_TO_GAP):
            half = (near + far) / 2
            is_near = numpy.isfinite(self.points(half)[1]).all(axis=0)
            near, far = numpy.where(is_near, half, near), numpy.where(is_near, far, half)
        return numpy.concatenate([middles, near], axis=1)

    def _unseparated(self, matrix: Any) -> Unseparated:
        """Return the error that names the unknowns left open, or the direction along which no quantity changes.

        `matrix`: the derivatives of both quantities by both unknowns.
        """
        symbols = [NOMENCLATURE[name].symbol for name in self.problem.unknowns]
        exponents = abs(matrix).max(axis=0).tolist()
        left_open = [symbol for symbol, exponent in zip(symbols, exponents, strict=True) if exponent <= _LEFT_OPEN]
        if left_open:
            remark = f"they do not determine {listed(left_open)}"
        else:
            if self.load is not None:
                symbols[self.load] = "(1 + P/P_c)"  # the coordinate of a load
            _, _, directions = numpy.linalg.svd(matrix)
            first, second = directions[-1]  # the direction of the least change
            remark = f"both are constant along {symbols[0]} ∝ {symbols[1]}^{first / second:.3g}"
        remedy = "measure another quantity, or give one of the two"
        remark += " (the condition number is above 1e8)"
        text = f"{listed(self.problem.levels)} do not determine both unknowns: {remark}; {remedy}"
        return Unseparated(self.problem, text)
