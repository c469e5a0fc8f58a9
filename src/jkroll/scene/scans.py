"""Functions of one variable in many rows side by side: scanned, so that every root is found, nothing extrapolated.

The last values beside gaps and the extremes divide a scan into pieces on which a function rises or falls. A piece that
crosses a level is bisected down to neighbouring doubles.
"""

from collections.abc import Callable
from typing import Any

import numpy

from .inverse import AS_SHOWN

_HALVINGS = 120  # more than lead from a value of a scan to neighbouring doubles, or to 0
_SLOPE = 1e-7  # of an interval, the step whose change tells the side of a maximum or minimum in it
# Of the way from an end to the next value: places between which a function may turn.
_NEAR_END = (0.0, 1e-6, 1e-4, 1e-2, 0.1, 0.3)
ROUNDING = 1e-12  # of a function: a change as small as this comes from rounding, and not from the variable

Rows = Any  # an array of the numbers of rows


class Scan:
    """Points of a function in each row, in rising order, of which it rises or falls from one to the next.

    `rows`, `x` and `y` are arrays with an element for each point; y is nan in gaps.
    """

    def __init__(self, function: Callable[[Rows, Any], Any], x: Any, size: int) -> None:
        """`function`: of rows and a value in each; `x`: values that are scanned in each of `size` rows, in order."""
        self.function = function
        self.rows, self.x = numpy.repeat(numpy.arange(size), len(x)), numpy.tile(x, size)
        self.y = function(self.rows, self.x)
        self._add_ends()
        self._add_extremes()

    def _add(self, rows: Rows, x: Any) -> None:
        """Add points, if there are any."""
        if not len(rows):
            return
        columns = ((self.rows, rows), (self.x, x), (self.y, self.function(rows, x)))
        joined = [numpy.concatenate(column) for column in columns]
        order = numpy.lexsort(joined[1::-1])
        self.rows, self.x, self.y = (column[order] for column in joined)

    def _add_ends(self) -> None:
        """Add the last values beside each gap, and some near them."""
        known = numpy.isfinite(self.y)
        left = numpy.flatnonzero((self.rows[:-1] == self.rows[1:]) & (known[:-1] != known[1:]))
        rows, is_left = self.rows[left], known[left]
        inside, outside = (numpy.where(choice, self.x[left], self.x[left + 1]) for choice in (is_left, ~is_left))
        end, _ = bisected(inside, outside, lambda x: numpy.isfinite(self.function(rows, x)))
        places = [end + share * (inside - end) for share in _NEAR_END]
        self._add(numpy.tile(rows, len(places)), numpy.concatenate(places))

    def _add_extremes(self) -> None:
        """Add the maxima and minima: there the slope changes its sign, and not by rounding."""
        rows, x, y = self.rows, self.x, self.y
        before, after = y[1:-1] - y[:-2], y[2:] - y[1:-1]
        change = numpy.fmax(abs(before), abs(after))
        turns = (rows[:-2] == rows[2:]) & (before * numpy.sign(after) < 0) & (change > ROUNDING * abs(y[1:-1]))
        start = numpy.flatnonzero(turns)
        row, left, right, sign = rows[start], x[start], x[start + 2], numpy.sign(before[start])
        step = _SLOPE * (right - left)
        turn, _ = bisected(
            left, right, lambda x: sign * (self.function(row, x + step) - self.function(row, x - step)) > 0
        )
        self._add(row, turn)

    def crossings(self, levels: Any) -> tuple[Rows, Any]:
        """Return the rows and values at which functions have the level of their row, but for jumps over it.

        The function at such a value is the level as it is shown. Next to pull-off doubles may have none.
        """
        rows, x, y = self.rows, self.x, self.y
        side = numpy.sign(y - levels[rows])
        left = numpy.flatnonzero((rows[:-1] == rows[1:]) & (side[:-1] * side[1:] < 0))
        row, level, first, second = rows[left], levels[rows[left]], y[left], y[left + 1]
        ends = bisected(x[left], x[left + 1], lambda x: (self.function(row, x) < level) == (first < level))
        off = numpy.array([abs(self.function(row, end) - level) for end in ends])
        root = numpy.where(off[0] < off[1], *ends)
        scale = numpy.where(level == 0, numpy.maximum(abs(first), abs(second)), abs(level))
        is_root = off.min(axis=0) <= AS_SHOWN * scale
        exact = side == 0
        every = numpy.array([numpy.append(rows[exact], row[is_root]), numpy.append(x[exact], root[is_root])])
        row, root = numpy.unique(every, axis=1)
        return row.astype(int), root


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
