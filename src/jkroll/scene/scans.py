"""One unknown in many rows side by side: scanned, so that every solution is found, and nothing is extrapolated.

The last values beside gaps and the extremes divide a scan into pieces on which the measured quantity rises or falls. A
piece that crosses the measured value is bisected down to neighbouring doubles.
"""

from collections.abc import Callable, Mapping
from functools import partial
from typing import Any, NamedTuple

import numpy

from ..errors import JkrollError, NoResult
from ..quantities.formatting import DIGITS, Format, amount
from ..text import listed
from .failures import MAX_DIGITS
from .inverse import (
    PER_DECADE,
    SIZES,
    WIDEST,
    NoSolution,
    Problem,
    SeveralSolutions,
    Solution,
    Undetermined,
    equal,
    independent,
    unsolved,
)
from .scene import LEAST, MOST

_HALVINGS = 120  # more than lead from a value of a scan to neighbouring doubles, or to 0
_GOLDEN = 0.6180339887498949  # of an interval, the part that a step of the golden-section search keeps
_SEARCHES = 45  # steps of it: they leave 4e-10 of an interval, and all digits of a value that is flat there
NEAR_END = (
    0.0,
    1e-6,
    1e-4,
    1e-2,
    0.1,
    0.3,
)  # of the way from an end to the next value, between which a quantity may turn
ROUNDING = 1e-12  # of a quantity: a spread as small as this comes from rounding, and not from the unknown
_JUMP = 1e-6  # part of the values around it that a change of sign may leave, if it is a crossing and no jump
_DIGITS = 1e-14  # of a value: a difference as small as this comes from rounding, and is no jump
STEP = 1e-6  # relative, of the differences that give a slope
_AS_SHOWN = 1e-3  # relative difference of a quantity at a value as it is shown

Rows = Any  # an array of the numbers of rows
Function = Callable[[Rows, Any], Any]  # of a value of the unknown in each row


def grid(name: str, sizes: tuple[float, float] | None = None) -> Any:
    """Return the values of an input that are scanned, in rising order; between the sizes of the first scan by default."""
    least, most = sizes or SIZES[name]
    values = numpy.geomspace(least, most, round(numpy.log10(most / least) * PER_DECADE) + 1)
    return numpy.concatenate([-values[::-1], [0.0], values]) if name == "load" else values


def taken(name: str, values: Any) -> Any:
    """Return the values of an unknown that a scene takes in place of those that are too small or too large for it."""
    if name == "load":
        return numpy.where(abs(values) < LEAST, 0.0, numpy.clip(values, -MOST, MOST))
    return numpy.clip(values, LEAST, MOST)


def outcomes(problem: Problem, rows: Rows, values: Mapping[str, Any]) -> dict[str, Any]:
    """Return the measured quantities at values of the unknowns in some rows, nan where the physics has no result."""
    of_rows = problem.rows(rows) if problem.of_arrays else problem
    scene = of_rows.with_values({name: taken(name, x) for name, x in values.items()})
    found = scene.evaluate((*problem.measured,))
    for outcome in found.values():
        if isinstance(outcome, JkrollError) and not isinstance(outcome, NoResult):
            raise outcome
    return {
        name: numpy.broadcast_to(numpy.nan if isinstance(outcome, NoResult) else outcome, numpy.shape(rows))
        for name, outcome in found.items()
    }


def bisected(inside: Any, outside: Any, is_inside: Callable[[Any], Any]) -> tuple[Any, Any]:
    """Return the last values inside and the first outside, neighbouring doubles, of pairs side by side."""
    for _ in range(_HALVINGS):
        middle = (inside + outside) / 2
        if not ((middle != inside) & (middle != outside)).any():
            break
        is_in = is_inside(middle)
        inside, outside = numpy.where(is_in, middle, inside), numpy.where(is_in, outside, middle)
    return inside, outside


def highest(left: Any, right: Any, sign: Any, function: Callable[[Any], Any]) -> Any:
    """Return where functions with one maximum between two values have it, by golden-section search; `sign` −1: a minimum."""
    for _ in range(_SEARCHES):
        low, high = right - _GOLDEN * (right - left), left + _GOLDEN * (right - left)
        falls = sign * function(low) > sign * function(high)
        left, right = numpy.where(falls, left, low), numpy.where(falls, high, right)
    return (left + right) / 2


def slopes(x: Any, y: Any) -> Any:
    """Return slopes from three points each; from two where y is nan at an end, and nan where it is at both."""
    has_low, has_high = numpy.isfinite(y[0]), numpy.isfinite(y[2])
    run = numpy.where(has_high, x[2], x[1]) - numpy.where(has_low, x[0], x[1])
    with numpy.errstate(divide="ignore", invalid="ignore"):
        return (numpy.where(has_high, y[2], y[1]) - numpy.where(has_low, y[0], y[1])) / run


# --- Scans ------------------------------------------------------------------------------------------------------------


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
        joined = [numpy.concatenate(both) for both in ((self.rows, rows), (self.x, x), (self.y, function(rows, x)))]
        order = numpy.lexsort(joined[1::-1])
        rows, x, y = (column[order] for column in joined)
        is_new = numpy.append(True, (numpy.diff(rows) != 0) | (numpy.diff(x) != 0))
        return Points(rows[is_new], x[is_new], y[is_new])

    def _with_ends(self, function: Function) -> "Points":
        """Return these with the last values beside each gap, and some near them."""
        known = numpy.isfinite(self.y)
        left = numpy.flatnonzero((self.rows[:-1] == self.rows[1:]) & (known[:-1] != known[1:]))
        if not left.size:
            return self
        rows, first = self.rows[left], known[left]
        inside, outside = (numpy.where(choice, self.x[left], self.x[left + 1]) for choice in (first, ~first))
        end, _ = bisected(inside, outside, lambda x: numpy.isfinite(function(rows, x)))
        places = [end + part * (inside - end) for part in NEAR_END]
        return self._with(numpy.tile(rows, len(places)), numpy.concatenate(places), function)

    def _with_extremes(self, function: Function) -> "Points":
        """Return these with the maxima and minima between them, but for those of rounding."""
        rows, x, y = self
        before, after = y[1:-1] - y[:-2], y[2:] - y[1:-1]
        change = numpy.fmax(abs(before), abs(after))
        turns = (rows[:-2] == rows[2:]) & (before * numpy.sign(after) < 0) & (change > ROUNDING * abs(y[1:-1]))
        left = numpy.flatnonzero(turns)
        if not left.size:
            return self
        sign = numpy.where(before[left] > 0, 1.0, -1.0)
        turn = highest(x[left], x[left + 2], sign, lambda x: function(rows[left], x))
        return self._with(rows[left], turn, function)

    def repeated(self, count: int) -> "Points":
        """Return the points of a single row for so many rows."""
        rows = numpy.repeat(numpy.arange(count), len(self.x))
        return Points(rows, numpy.tile(self.x, count), numpy.tile(self.y, count))

    def crossings(self, levels: Any, function: Function) -> tuple[Rows, Any]:
        """Return the rows and values at which functions have the level of their row."""
        rows, x, y = self
        side = numpy.sign(y - levels[rows])
        left = numpy.flatnonzero((rows[:-1] == rows[1:]) & (side[:-1] * side[1:] < 0))
        own, level, first, second = rows[left], levels[rows[left]], y[left], y[left + 1]
        both = bisected(x[left], x[left + 1], lambda x: (function(own, x) < level) == (first < level))
        off = [abs(function(own, root) - level) for root in both]
        root = numpy.where(off[0] < off[1], *both)
        leaves = numpy.maximum(_JUMP * numpy.maximum(abs(first - level), abs(second - level)), _DIGITS * abs(level))
        is_root = numpy.minimum(*off) <= leaves
        exact = side == 0
        every = numpy.array([numpy.append(rows[exact], own[is_root]), numpy.append(x[exact], root[is_root])])
        own, root = numpy.unique(every, axis=1)
        return own.astype(int), root


class Scan:
    """A scan of the unknown in some rows, and what comes of it."""

    def __init__(self, problem: Problem, size: int, sizes: tuple[float, float] | None = None) -> None:
        """`sizes`: between which the unknown is scanned; where there are none, it is scanned more widely if need be."""
        self.problem, self.size, self.sizes = problem, size, sizes
        ((self.unknown,), ((self.quantity, levels),)) = problem.unknowns, problem.levels.items()
        self.levels = numpy.broadcast_to(numpy.asarray(levels, dtype=float), size)
        self.failures: dict[int, JkrollError] = {}

    def function(self, rows: Rows, x: Any) -> Any:
        """Return the measured quantity."""
        return outcomes(self.problem, rows, {self.unknown: x})[self.quantity]

    def row(self, row: int) -> Problem:
        """Return the problem of a row."""
        return self.problem._replace(measured={self.quantity: self.levels}).rows(row)

    def solution(self) -> Solution:
        """Return the one solution in each row, and the reasons why others have none."""
        count = self.size if self.problem.of_arrays else 1
        points = Points.of(grid(self.unknown, self.sizes), count, self.function)
        if not self.problem.of_arrays:
            points = points.repeated(self.size)
        starts = numpy.searchsorted(points.rows, numpy.arange(self.size))
        low, high = (each.reduceat(points.y, starts) for each in (numpy.fmin, numpy.fmax))
        depends = high - low > ROUNDING * numpy.fmax(abs(low), abs(high))
        for row in numpy.flatnonzero(~depends).tolist():
            has_values = not numpy.isnan(low[row])
            self.failures[row] = independent(self.unknown, self.quantity) if has_values else self.row(row).failure()
        self._find_stretches(points)
        rows, roots = points.crossings(self.levels, self.function)
        counts = numpy.bincount(rows, minlength=self.size)
        counts[[*self.failures]] = -1
        self._name_several(rows[counts[rows] > 1], roots[counts[rows] > 1])
        for row in numpy.flatnonzero(counts == 0).tolist():
            self.failures[row] = unsolved(self.row(row), self.quantity, (float(low[row]), float(high[row])))
        values = numpy.full(self.size, numpy.nan)
        is_one = counts[rows] == 1
        values[rows[is_one]] = taken(self.unknown, roots[is_one])
        condition = self._condition(values)
        if self.sizes is None:
            self._look_wider(values, condition)
        return Solution(self.problem, {self.unknown: values}, condition, {self.unknown: condition}, self.failures)

    def _find_stretches(self, points: Points) -> None:
        """Note the rows in which a stretch of a decade or more has the measured value, with its ends."""
        alike = self._have_level(points.rows, points.y)
        counts = numpy.bincount(points.rows[alike], minlength=self.size)
        for row in numpy.flatnonzero(counts > PER_DECADE).tolist():
            x = points.x[points.rows == row]
            places = numpy.flatnonzero(alike[points.rows == row])
            if row in self.failures or x[places[0]] <= 0 or x[places[-1]] < 10 * x[places[0]]:
                continue
            beside = [max(places[0] - 1, 0), min(places[-1] + 1, len(x) - 1)]
            ends, _ = bisected(x[places[[0, -1]]], x[beside], partial(self._is_on_stretch, numpy.full(2, row)))
            low, high = ends.tolist()
            text = (
                f"every value from {amount(self.unknown, low)} to {amount(self.unknown, high)} gives {self._equal(row)}"
            )
            self.failures[row] = Undetermined([self.unknown], text, span=(low, high))

    def _have_level(self, rows: Rows, y: Any) -> Any:
        return abs(y - self.levels[rows]) <= ROUNDING * abs(self.levels[rows])

    def _is_on_stretch(self, rows: Rows, x: Any) -> Any:
        return self._have_level(rows, self.function(rows, x))

    def _name_several(self, rows: Rows, roots: Any) -> None:
        """Note the rows with several solutions, which have as many digits as typing them takes: next to pull-off that is more."""
        needed = numpy.full(len(rows), MAX_DIGITS)
        for digits in range(MAX_DIGITS - 1, DIGITS - 1, -1):
            typed = numpy.array([float(f"{root:.{digits}g}") for root in roots.tolist()])
            off = abs(self.function(rows, typed) - self.levels[rows])
            needed[off <= _AS_SHOWN * abs(self.levels[rows])] = digits
        for row in numpy.unique(rows).tolist():
            form = Format(digits=int(needed[rows == row].max()))
            values = roots[rows == row].tolist()
            texts = listed([amount(self.unknown, value, form) for value in values])
            text = f"{texts} {'all' if len(values) > 2 else 'both'} give {self._equal(row)}"
            self.failures[row] = SeveralSolutions([self.unknown], text, [{self.unknown: value} for value in values])

    def _equal(self, row: int) -> str:
        return equal({self.quantity: float(self.levels[row])})

    def _condition(self, values: Any) -> Any:
        """Return |d ln unknown / d ln quantity| by central differences, or one-sided ones where the quantity ends."""
        rows = numpy.flatnonzero(~numpy.isnan(values))
        factors = numpy.array([1 / (1 + STEP), 1.0, 1 + STEP])
        y = self.function(numpy.tile(rows, 3), numpy.outer(factors, values[rows]).ravel()).reshape(3, -1)
        condition = numpy.full(self.size, numpy.nan)
        with numpy.errstate(divide="ignore", invalid="ignore"):
            condition[rows] = abs(y[1] / slopes(numpy.log(factors), y))
        return condition

    def _look_wider(self, values: Any, condition: Any) -> None:
        """Look for values where there is none among the usual sizes, among all that a scene takes."""
        rows = numpy.array([row for row, error in self.failures.items() if isinstance(error, NoSolution)], dtype=int)
        if not rows.size:
            return
        problem = self.problem._replace(measured={self.quantity: self.levels}).rows(rows)
        wider = Scan(problem, rows.size, WIDEST).solution()
        values[rows], condition[rows] = wider.values[self.unknown], wider.condition
        for place, row in enumerate(rows.tolist()):
            error = wider.failures.get(place)
            if error is None:
                del self.failures[row]
            elif isinstance(error, SeveralSolutions | Undetermined):
                self.failures[row] = error
