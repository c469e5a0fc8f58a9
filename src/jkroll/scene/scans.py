"""One unknown in many rows side by side: scanned, so that every solution is found, and nothing is extrapolated.

The last values beside gaps and the extremes divide a scan into pieces on which the measured quantity rises or falls. A
piece that crosses the measured value is bisected down to neighbouring doubles.
"""

from collections.abc import Callable
from typing import Any, NamedTuple

import numpy

from ..errors import JkrollError, NoResult
from ..quantities.formatting import amount
from .inverse import (
    AS_SHOWN,
    PER_DECADE,
    NoDependence,
    NoSolution,
    Problem,
    SeveralSolutions,
    Solution,
    Undetermined,
    Values,
    equal,
    sizes_in_words,
)
from .scene import LEAST, MOST

_HALVINGS = 120  # more than lead from a value of a scan to neighbouring doubles, or to 0
_SLOPE = 1e-7  # of an interval, the step whose change tells the side of a maximum or minimum in it
# Of the way from an end to the next value: places between which a quantity may turn.
_NEAR_END = (0.0, 1e-6, 1e-4, 1e-2, 0.1, 0.3)
_ROUNDING = 1e-12  # of a quantity: a spread as small as this comes from rounding, and not from the unknown
STEP = 1e-6  # relative, of the differences that give a slope

Rows = Any  # an array of the numbers of rows
Function = Callable[[Rows, Any], Any]  # of a value of the unknown in each row


def grid(name: str, sizes: tuple[float, float]) -> Any:
    """Return the values of an input that are scanned, in rising order."""
    least, most = sizes
    values = numpy.geomspace(least, most, round(numpy.log10(most / least) * PER_DECADE) + 1)
    return numpy.concatenate([-values[::-1], [0.0], values]) if name == "load" else values


def taken(name: str, values: Any) -> Any:
    """Return the values of an unknown that a scene takes in place of those that are too small or too large for it."""
    if name == "load":
        return numpy.where(abs(values) < LEAST, 0.0, numpy.clip(values, -MOST, MOST))
    return numpy.clip(values, LEAST, MOST)


def outcomes(problem: Problem, values: Values) -> Any:
    """Return the measured quantities, a row for each, at values of the unknowns; nan where there is no result."""
    scene = problem.with_values({name: taken(name, x) for name, x in values.items()})
    quantities = numpy.full((len(problem.measured), len(next(iter(values.values())))), numpy.nan)
    for quantity, outcome in zip(quantities, scene.evaluate([*problem.measured]).values(), strict=True):
        if not isinstance(outcome, JkrollError):
            quantity[:] = outcome
        elif not isinstance(outcome, NoResult):
            raise outcome
    return quantities


def bisected(inside: Any, outside: Any, is_inside: Callable[[Any], Any]) -> tuple[Any, Any]:
    """Return the last values inside and the first outside, neighbouring doubles, of pairs side by side."""
    for _ in range(_HALVINGS):
        middle = (inside + outside) / 2
        if not ((middle != inside) & (middle != outside)).any():
            break
        is_in = is_inside(middle)
        inside, outside = numpy.where(is_in, middle, inside), numpy.where(is_in, outside, middle)
    return inside, outside


def slopes(x: Any, y: Any) -> Any:
    """Return slopes from three points each; from two where y is nan at an end, and nan where it is at both."""
    has_low, has_high = numpy.isfinite(y[0]), numpy.isfinite(y[2])
    run = numpy.where(has_high, x[2], x[1]) - numpy.where(has_low, x[0], x[1])
    with numpy.errstate(divide="ignore", invalid="ignore"):
        return (numpy.where(has_high, y[2], y[1]) - numpy.where(has_low, y[0], y[1])) / run


class Points(NamedTuple):
    """Points of functions, in rising order of the values in each row; y is nan in gaps."""

    rows: Rows
    x: Any
    y: Any

    @classmethod
    def of(cls, x: Any, count: int, function: Function) -> "Points":
        """Return the points of so many rows that divide each into pieces on which the function rises or falls."""
        rows, x = numpy.repeat(numpy.arange(count), len(x)), numpy.tile(x, count)
        return cls(rows, x, function(rows, x))._with_ends(function)._with_extremes(function)

    def _with(self, rows: Rows, x: Any, function: Function) -> "Points":
        """Return these and others, computed now."""
        if not len(rows):
            return self
        joined = [numpy.concatenate(both) for both in ((self.rows, rows), (self.x, x), (self.y, function(rows, x)))]
        order = numpy.lexsort(joined[1::-1])
        return Points(*(column[order] for column in joined))

    def _with_ends(self, function: Function) -> "Points":
        """Return these with the last values beside each gap, and some near them."""
        known = numpy.isfinite(self.y)
        left = numpy.flatnonzero((self.rows[:-1] == self.rows[1:]) & (known[:-1] != known[1:]))
        rows, is_left = self.rows[left], known[left]
        inside, outside = (numpy.where(choice, self.x[left], self.x[left + 1]) for choice in (is_left, ~is_left))
        end, _ = bisected(inside, outside, lambda x: numpy.isfinite(function(rows, x)))
        places = [end + share * (inside - end) for share in _NEAR_END]
        return self._with(numpy.tile(rows, len(places)), numpy.concatenate(places), function)

    def _with_extremes(self, function: Function) -> "Points":
        """Return these with the maxima and minima between them: the slope changes its sign, and not by rounding."""
        rows, x, y = self
        before, after = y[1:-1] - y[:-2], y[2:] - y[1:-1]
        change = numpy.fmax(abs(before), abs(after))
        turns = (rows[:-2] == rows[2:]) & (before * numpy.sign(after) < 0) & (change > _ROUNDING * abs(y[1:-1]))
        start = numpy.flatnonzero(turns)
        row, left, right, sign = rows[start], x[start], x[start + 2], numpy.sign(before[start])
        step = _SLOPE * (right - left)
        turn, _ = bisected(left, right, lambda x: sign * (function(row, x + step) - function(row, x - step)) > 0)
        return self._with(row, turn, function)

    def repeated(self, count: int) -> "Points":
        """Return the points of a single row for so many rows."""
        rows = numpy.repeat(numpy.arange(count), len(self.x))
        return Points(rows, numpy.tile(self.x, count), numpy.tile(self.y, count))

    def crossings(self, levels: Any, function: Function) -> tuple[Rows, Any]:
        """Return the rows and values at which functions have the level of their row, but for jumps over it.

        The quantity at such a value is the level as it is shown. Next to pull-off doubles may have none.
        """
        rows, x, y = self
        side = numpy.sign(y - levels[rows])
        left = numpy.flatnonzero((rows[:-1] == rows[1:]) & (side[:-1] * side[1:] < 0))
        row, level, first, second = rows[left], levels[rows[left]], y[left], y[left + 1]
        ends = bisected(x[left], x[left + 1], lambda x: (function(row, x) < level) == (first < level))
        off = numpy.array([abs(function(row, end) - level) for end in ends])
        root = numpy.where(off[0] < off[1], *ends)
        scale = numpy.where(level == 0, numpy.maximum(abs(first), abs(second)), abs(level))
        is_root = off.min(axis=0) <= AS_SHOWN * scale
        exact = side == 0
        every = numpy.array([numpy.append(rows[exact], row[is_root]), numpy.append(x[exact], root[is_root])])
        row, root = numpy.unique(every, axis=1)
        return row.astype(int), root


class Scan:
    """A scan of the unknown in some rows between two sizes, and what comes of it."""

    def __init__(self, problem: Problem, size: int, sizes: tuple[float, float]) -> None:
        self.problem, self.size, self.sizes = problem, size, sizes
        ((self.unknown,), ((self.quantity, levels),)) = problem.unknowns, problem.levels.items()
        self.levels = numpy.broadcast_to(numpy.asarray(levels, dtype=float), size)
        count = size if problem.scene.arrays else 1
        points = Points.of(grid(self.unknown, sizes), count, self.function)
        self.points = points if problem.scene.arrays else points.repeated(size)

    def function(self, rows: Rows, x: Any) -> Any:
        """Return the measured quantity."""
        return outcomes(self.problem.rows(rows), {self.unknown: x})[0]

    def solution(self) -> Solution:
        """Return the one solution in each row, and the reasons why others have none."""
        every = numpy.arange(self.size)
        rows, x, y = self.points
        is_level = self._is_level(rows, y)
        low, high, first, last = (
            end.reduceat(values, numpy.searchsorted(rows, every))
            for values in (y, numpy.where(is_level, x, numpy.nan))
            for end in (numpy.fmin, numpy.fmax)
        )
        depends = high - low > _ROUNDING * numpy.fmax(abs(low), abs(high))
        counts = numpy.bincount(rows[is_level], minlength=self.size)
        is_stretch = depends & (counts > PER_DECADE) & (first > 0) & (last >= 10 * first)
        rows, roots = self.points.crossings(self.levels, self.function)
        start, stop = numpy.searchsorted(rows, [every, every + 1])
        is_one = depends & ~is_stretch & (stop - start == 1)
        values = numpy.full(self.size, numpy.nan)
        values[is_one] = taken(self.unknown, roots[start[is_one]])
        failures: dict[int, JkrollError] = {}
        for row in numpy.flatnonzero(~is_one).tolist():
            problem = self.problem.rows(row)
            if numpy.isnan(low[row]):
                failures[row] = problem.failure()
            elif not depends[row]:
                failures[row] = NoDependence(problem)
            elif is_stretch[row]:
                failures[row] = self._undetermined(row, numpy.array([first[row], last[row]]))
            elif start[row] < stop[row]:
                of_row = roots[start[row] : stop[row]].tolist()
                failures[row] = SeveralSolutions(problem, [{self.unknown: root} for root in of_row])
            else:
                failures[row] = self._outside(problem, float(low[row]), float(high[row]))
        condition = self._condition(values)
        return Solution(self.problem, {self.unknown: values}, condition, {self.unknown: condition}, failures)

    def _outside(self, problem: Problem, low: float, high: float) -> NoSolution:
        """Return the error of a measured value outside the range of the quantity."""
        lies = f"it lies between {amount(self.quantity, low)} and {amount(self.quantity, high)}"
        text = f"no value gives {equal(problem.levels)}; {lies} for {sizes_in_words([self.unknown])}"
        return NoSolution(problem, text, (low, high))

    def _undetermined(self, row: int, inside: Any) -> Undetermined:
        """Return the error of a measured value that a stretch has, given points of the scan at both ends of this."""
        rows, problem = numpy.full(2, row), self.problem.rows(row)
        outside = numpy.clip(inside * [0.5, 2.0], *self.sizes)
        ends, _ = bisected(inside, outside, lambda x: self._is_level(rows, self.function(rows, x)))
        low, high = ends.tolist()
        span = f"{amount(self.unknown, low)} to {amount(self.unknown, high)}"
        return Undetermined(problem, f"every value from {span} gives {equal(problem.levels)}", (low, high))

    def _is_level(self, rows: Rows, y: Any) -> Any:
        return abs(y - self.levels[rows]) <= _ROUNDING * abs(self.levels[rows])

    def _condition(self, values: Any) -> Any:
        """Return |d ln unknown / d ln quantity| by central differences, or one-sided ones where the quantity ends."""
        rows = numpy.flatnonzero(~numpy.isnan(values))
        factors = numpy.array([1 / (1 + STEP), 1.0, 1 + STEP])
        y = self.function(numpy.tile(rows, 3), numpy.outer(factors, values[rows]).ravel()).reshape(3, -1)
        condition = numpy.full(self.size, numpy.nan)
        with numpy.errstate(divide="ignore", invalid="ignore"):
            condition[rows] = abs(y[1] / slopes(numpy.log(factors), y))
        return condition
