"""Scans of functions side by side: the points of a scan, what divides it into pieces, and the values on these.

A function is that of a measured quantity of the unknown, in one row or many. The last values beside gaps and the extremes
divide a scan into pieces on which the function rises or falls; a piece that crosses a level is bisected down to
neighbouring doubles.
"""

from collections.abc import Callable, Mapping
from typing import Any, NamedTuple

import numpy

from ..errors import JkrollError, NoResult
from .inverse import PER_DECADE, SIZES, Problem
from .scene import LEAST, MOST

_HALVINGS = 1100  # more than lead from any interval to neighbouring doubles
_GOLDEN = 0.6180339887498949  # of an interval, the part that a step of the golden-section search keeps
_SEARCHES = 45  # steps of it: they leave 4e-10 of an interval, and all digits of a value that is flat there
# Parts of the way from an end to the next value of a scan, between which a quantity may turn.
NEAR_END = (0.0, 1e-6, 1e-4, 1e-2, 0.1, 0.3)
ROUNDING = 1e-12  # of a quantity: a spread as small as this comes from rounding, and not from the unknown
_JUMP = 1e-6  # part of the values around it that a change of sign may leave, if it is a crossing and no jump
_DIGITS = 1e-14  # of a value: a difference as small as this comes from rounding, and is no jump
STEP = 1e-6  # relative, of the differences that give a slope

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
    own = problem.rows(rows) if problem.of_arrays else problem
    found = own.with_values({name: taken(name, x) for name, x in values.items()}).evaluate((*problem.measured,))
    for outcome in found.values():
        if isinstance(outcome, JkrollError) and not isinstance(outcome, NoResult):
            raise outcome
    return {
        name: numpy.broadcast_to(numpy.nan if isinstance(outcome, NoResult) else outcome, numpy.shape(rows))
        for name, outcome in found.items()
    }


def bisected(inside: Any, outside: Any, is_inside: Callable[[Any, Any], Any]) -> tuple[Any, Any]:
    """Return the last values inside and the first outside, neighbouring doubles. `is_inside` takes numbers of pairs, and values."""
    inside, outside = numpy.array(inside), numpy.array(outside)
    for _ in range(_HALVINGS):
        middle = inside / 2 + outside / 2
        pairs = numpy.flatnonzero((middle != inside) & (middle != outside))
        if not pairs.size:
            break
        is_in = is_inside(pairs, middle[pairs])
        inside[pairs[is_in]], outside[pairs[~is_in]] = middle[pairs[is_in]], middle[pairs[~is_in]]
    return inside, outside


def highest(left: Any, right: Any, sign: Any, function: Callable[[Any], Any]) -> Any:
    """Return where functions with one maximum between two values are highest, by golden-section search; with sign −1, lowest."""
    low, high = right - _GOLDEN * (right - left), left + _GOLDEN * (right - left)
    at_low, at_high = sign * function(low), sign * function(high)
    for _ in range(_SEARCHES):
        falls = at_low > at_high
        left, right = numpy.where(falls, left, low), numpy.where(falls, high, right)
        inner = numpy.where(falls, right - _GOLDEN * (right - left), left + _GOLDEN * (right - left))
        at_inner = sign * function(inner)
        low, high = numpy.where(falls, inner, high), numpy.where(falls, low, inner)
        at_low, at_high = numpy.where(falls, at_inner, at_high), numpy.where(falls, at_low, at_inner)
    return (left + right) / 2


class Points(NamedTuple):
    """Points of functions, in rising order of the values in each row; y is nan in gaps."""

    rows: Rows
    x: Any
    y: Any

    def with_more(self, rows: Rows, x: Any, function: Function) -> "Points":
        """Return these and others, computed now."""
        if not rows.size:
            return self
        joined = [numpy.concatenate(both) for both in ((self.rows, rows), (self.x, x), (self.y, function(rows, x)))]
        order = numpy.lexsort(joined[1::-1])
        rows, x, y = (column[order] for column in joined)
        is_new = numpy.append(True, (numpy.diff(rows) != 0) | (numpy.diff(x) != 0))
        return Points(rows[is_new], x[is_new], y[is_new])

    def with_ends(self, function: Function) -> "Points":
        """Return these with the last values beside each gap, and some near them."""
        known = numpy.isfinite(self.y)
        left = numpy.flatnonzero((self.rows[:-1] == self.rows[1:]) & (known[:-1] != known[1:]))
        rows, first = self.rows[left], known[left]
        inside, outside = (numpy.where(choice, self.x[left], self.x[left + 1]) for choice in (first, ~first))
        end, _ = bisected(inside, outside, lambda pairs, x: numpy.isfinite(function(rows[pairs], x)))
        places = [end + part * (inside - end) for part in NEAR_END]
        return self.with_more(numpy.tile(rows, len(places)), numpy.concatenate(places), function)

    def with_extremes(self, function: Function) -> "Points":
        """Return these with the maxima and minima between them, but for those of rounding."""
        rows, x, y = self
        before, after = y[1:-1] - y[:-2], y[2:] - y[1:-1]
        change = numpy.fmax(abs(before), abs(after))
        turns = (rows[:-2] == rows[2:]) & (before * numpy.sign(after) < 0) & (change > ROUNDING * abs(y[1:-1]))
        left = numpy.flatnonzero(turns)
        sign = numpy.where(before[left] > 0, 1.0, -1.0)
        turn = highest(x[left], x[left + 2], sign, lambda x: function(rows[left], x))
        return self.with_more(rows[left], turn, function)

    def repeated(self, count: int) -> "Points":
        """Return the points of a single row for so many rows."""
        rows = numpy.repeat(numpy.arange(count), len(self.x))
        return Points(rows, numpy.tile(self.x, count), numpy.tile(self.y, count))


def crossings(points: Points, levels: Any, function: Function) -> tuple[Rows, Any]:
    """Return the rows and values at which functions have the level of their row, on points that divide them into monotone pieces."""
    rows, x, y = points
    level = levels[rows]
    exact = y == level
    left = numpy.flatnonzero((rows[:-1] == rows[1:]) & (numpy.sign(y - level)[:-1] * numpy.sign(y - level)[1:] < 0))
    of_left, level, first, second = rows[left], level[left], y[left], y[left + 1]
    rises = first < level
    both = bisected(x[left], x[left + 1], lambda k, x: (function(of_left[k], x) < level[k]) == rises[k])
    off = [abs(function(of_left, root) - level) for root in both]
    root = numpy.where(off[0] < off[1], *both)
    leaves = numpy.maximum(_JUMP * numpy.maximum(abs(first - level), abs(second - level)), _DIGITS * abs(level))
    is_root = numpy.minimum(*off) <= leaves
    every = numpy.array([numpy.append(rows[exact], of_left[is_root]), numpy.append(x[exact], root[is_root])])
    own, root = numpy.unique(every, axis=1)
    return own.astype(int), root


def slopes(x: Any, y: Any) -> Any:
    """Return slopes from three points each; from two where y is nan at an end, and nan where it is at both."""
    has_low, has_high = numpy.isfinite(y[0]), numpy.isfinite(y[2])
    run = numpy.where(has_high, x[2], x[1]) - numpy.where(has_low, x[0], x[1])
    with numpy.errstate(divide="ignore", invalid="ignore"):
        return (numpy.where(has_high, y[2], y[1]) - numpy.where(has_low, y[0], y[1])) / run
