"""The solver of the inverse problem, for one row or many: all that is searched for is searched for side by side.

One unknown is scanned, so that every solution is found, and nothing is extrapolated. `pairs` finds two.
"""

from collections.abc import Mapping
from typing import Any, NamedTuple

import numpy

from ..errors import JkrollError, NoResult
from ..quantities.formatting import DIGITS, Format, amount
from ..text import listed
from .failures import MAX_DIGITS
from .inverse import (
    MAX_CONDITION,
    PER_DECADE,
    WIDEST,
    NoSolution,
    Problem,
    SeveralSolutions,
    Solution,
    Undetermined,
    Values,
    equal,
    independent,
    unsolved,
)
from .pairs import NEAR, Newton, Pairs
from .scans import ROUNDING, STEP, Points, Rows, bisected, crossings, grid, outcomes, slopes, taken

_TOGETHER = 1 << 17  # values of a scan that are computed at once
_AS_SHOWN = 1e-3  # relative difference of a quantity at a value as it is shown


class Solutions(NamedTuple):
    """The solutions of rows: nan where there is none, for a reason."""

    values: Mapping[str, Any]  # by unknown
    condition: Any
    growths: Mapping[str, Any]  # by unknown, as Solution has them
    failures: Mapping[int, JkrollError]  # by row


def solution(problem: Problem) -> Solution:
    """Return the one solution of a problem of numbers. Raises the reason why there is none, or the error of the inputs."""
    found = solutions(problem, 1)
    for error in found.failures.values():
        raise error
    values = {name: float(column[0]) for name, column in found.values.items()}
    growths = {name: _rounded(column[0]) for name, column in found.growths.items()}
    scene = problem.with_values(values)
    return Solution(values, _rounded(found.condition[0]), growths, scene, scene.numbers(*problem.measured))


def solutions(problem: Problem, size: int, near: Values | None = None) -> Solutions:
    """Return the solutions of some rows. `near`: of two unknowns, values from which Newton's method starts, if it succeeds."""
    problem.check()
    if len(problem.unknowns) > 1:
        return _pairs(problem, size, near)
    (name,) = problem.unknowns
    values, condition = numpy.full(size, numpy.nan), numpy.full(size, numpy.nan)
    failures: dict[int, JkrollError] = {}
    step = _TOGETHER // len(grid(name))
    for start in range(0, size, step):
        rows = numpy.arange(start, min(start + step, size))
        part = _Scan(problem.rows(rows), len(rows))
        values[rows], condition[rows] = part.solve()
        failures |= {start + row: error for row, error in part.failures.items()}
    return Solutions({name: values}, condition, {name: condition}, failures)


def _pairs(problem: Problem, size: int, near: Values | None) -> Solutions:
    """Return the pairs in some rows."""
    solved = [numpy.full((2, size), numpy.nan), numpy.full(size, numpy.nan), numpy.full((2, size), numpy.nan)]
    failures: dict[int, JkrollError] = {}
    rest = numpy.arange(size)
    if near is not None:
        newton = Newton(problem, size)
        start = numpy.array([numpy.full(size, near[name]) for name in problem.unknowns])
        values, distance = newton.improved(rest, start)
        is_found = (distance <= NEAR) & newton.is_scanned(values)
        condition, growths, _ = newton.separation(rest, values)
        is_found &= condition <= MAX_CONDITION
        for column, own in zip(solved, (values, condition, growths), strict=True):
            column[..., is_found] = own[..., is_found]
        rest = rest[~is_found & numpy.isfinite(start).all(axis=0)]
    for row in rest.tolist():
        try:
            pair = Pairs(problem.rows(row)).solve()
        except NoResult as error:
            failures[row] = error
        else:
            for column, own in zip(solved, pair, strict=True):
                column[..., row] = own
        solved[1][row] = _rounded(solved[1][row])
    values, condition, growths = solved
    by_name = (dict(zip(problem.unknowns, each, strict=True)) for each in (values, growths))
    return Solutions(next(by_name), condition, next(by_name), failures)


def _rounded(number: float) -> float:
    return float(f"{number:.6g}")


class _Scan:
    """A scan of the unknown in some rows, and what comes of it."""

    def __init__(self, problem: Problem, size: int, sizes: tuple[float, float] | None = None) -> None:
        self.problem, self.size, self.sizes = problem, size, sizes
        ((self.unknown,), ((self.quantity, levels),)) = problem.unknowns, problem.levels.items()
        self.levels = numpy.broadcast_to(numpy.asarray(levels, dtype=float), size)
        self.failures: dict[int, JkrollError] = {}

    def function(self, rows: Rows, x: Any) -> Any:
        """Return the measured quantity."""
        return outcomes(self.problem, rows, {self.unknown: x})[self.quantity]

    def solve(self) -> tuple[Any, Any]:
        """Return the one solution in each row with its condition, and note why others have none."""
        places = grid(self.unknown, self.sizes)
        count = self.size if self.problem.of_arrays else 1
        rows, x = numpy.repeat(numpy.arange(count), len(places)), numpy.tile(places, count)
        scan = Points(rows, x, self.function(rows, x))
        points = scan.with_ends(self.function).with_extremes(self.function)
        if not self.problem.of_arrays:
            scan, points = scan.repeated(self.size), points.repeated(self.size)
        starts = numpy.searchsorted(points.rows, numpy.arange(self.size))
        low, high = (each.reduceat(points.y, starts) for each in (numpy.fmin, numpy.fmax))
        spans = numpy.transpose([low, high]).tolist()
        depends = high - low > ROUNDING * numpy.fmax(abs(low), abs(high))
        for row in numpy.flatnonzero(~depends).tolist():
            is_known = not numpy.isnan(low[row])
            self.failures[row] = (
                independent(self.unknown, self.quantity) if is_known else self.problem.rows(row).failure()
            )
        self._find_stretches(scan)
        own, roots = crossings(points, self.levels, self.function)
        counts = numpy.bincount(own, minlength=self.size)
        counts[[*self.failures]] = -1
        values = numpy.full(self.size, numpy.nan)
        values[own] = taken(self.unknown, roots)
        values[counts != 1] = numpy.nan
        self._name_several(own, roots, counts)
        for row in numpy.flatnonzero(counts == 0).tolist():
            level = {self.quantity: float(self.levels[row])}
            self.failures[row] = unsolved([self.unknown], level, self.quantity, (spans[row][0], spans[row][1]))
        condition = self._condition(values)
        if self.sizes is None:
            self._look_wider(values, condition)
        return values, condition

    def _find_stretches(self, scan: Points) -> None:
        """Note the rows in which a stretch of the scan has the measured value, with its ends."""
        x, y = (column.reshape(self.size, -1) for column in scan[1:])
        is_alike = abs(y - self.levels[:, None]) <= ROUNDING * abs(self.levels[:, None])
        last = x.shape[1] - 1
        ends = numpy.array([is_alike.argmax(axis=1), last - is_alike[:, ::-1].argmax(axis=1)])
        low, high = numpy.take_along_axis(x, ends.T, axis=1).T
        rows = numpy.flatnonzero((is_alike.sum(axis=1) > PER_DECADE) & (low > 0) & (high >= 10 * low))
        rows = rows[[row not in self.failures for row in rows.tolist()]]
        beside = numpy.clip(ends + numpy.array([[-1], [1]]), 0, last)

        def is_on_it(pairs: Any, values: Any) -> Any:
            level = self.levels[rows[pairs]]
            return abs(self.function(rows[pairs], values) - level) <= ROUNDING * abs(level)

        spans = [
            bisected(x[rows, end[rows]], x[rows, out[rows]], is_on_it)[0] for end, out in zip(ends, beside, strict=True)
        ]
        for row, *span in zip(rows.tolist(), *(side.tolist() for side in spans), strict=True):
            low, high = (amount(self.unknown, value) for value in span)
            text = f"every value from {low} to {high} gives {equal({self.quantity: float(self.levels[row])})}"
            self.failures[row] = Undetermined([self.unknown], text, span=(span[0], span[1]))

    def _name_several(self, own: Rows, roots: Any, counts: Any) -> None:
        """Note the rows with several solutions, which have as many digits as typing them takes: next to pull-off that is more."""
        is_one_of_several = counts[own] > 1
        rows, roots = own[is_one_of_several], roots[is_one_of_several]
        digits = range(DIGITS, MAX_DIGITS + 1)
        typed = numpy.array([[float(f"{root:.{count}g}") for count in digits] for root in roots.tolist()])
        if not rows.size:
            return
        levels = self.levels[rows][:, None]
        shown = self.function(numpy.repeat(rows, len(digits)), typed.ravel()).reshape(typed.shape)
        is_near = abs(shown - levels) <= _AS_SHOWN * abs(levels)
        is_near[:, -1] = True
        needed = is_near.argmax(axis=1) + DIGITS
        for row in numpy.unique(rows).tolist():
            form = Format(digits=int(needed[rows == row].max()))
            values = roots[rows == row].tolist()
            texts = listed([amount(self.unknown, value, form) for value in values])
            text = (
                f"{texts} {'all' if len(values) > 2 else 'both'} give {equal({self.quantity: float(self.levels[row])})}"
            )
            self.failures[row] = SeveralSolutions([self.unknown], text, [{self.unknown: value} for value in values])

    def _condition(self, values: Any) -> Any:
        """Return |d ln unknown / d ln quantity| by central differences, or one-sided ones where the quantity ends."""
        rows = numpy.flatnonzero(~numpy.isnan(values))
        factors = numpy.array([1 / (1 + STEP), 1.0, 1 + STEP])
        logs = numpy.broadcast_to(numpy.log(factors)[:, None], (3, rows.size))
        y = self.function(numpy.tile(rows, 3), numpy.outer(factors, values[rows]).ravel()).reshape(3, -1)
        slope = slopes(logs, y)
        condition = numpy.full(self.size, numpy.nan)
        with numpy.errstate(divide="ignore", invalid="ignore"):
            condition[rows] = abs(y[1] / slope)
        return condition

    def _look_wider(self, values: Any, condition: Any) -> None:
        """Look for values where there is none among the usual sizes, among all that a scene takes."""
        rows = numpy.array([row for row, error in self.failures.items() if isinstance(error, NoSolution)], dtype=int)
        if not rows.size:
            return
        wider = _Scan(self.problem._replace(measured={self.quantity: self.levels}).rows(rows), rows.size, WIDEST)
        values[rows], condition[rows] = wider.solve()
        for place, row in enumerate(rows.tolist()):
            error = wider.failures.get(place)
            if error is None:
                del self.failures[row]
            elif isinstance(error, SeveralSolutions | Undetermined):
                self.failures[row] = error
