"""The solver of the inverse problem, in one row or many: one unknown by a scan, two by a grid and Newton's method."""

from collections.abc import Callable, Sequence
from math import hypot, inf, nan, prod, sqrt
from typing import Any, NamedTuple

import numpy

from ..errors import JkrollError, NoResult
from ..quantities.formatting import amount
from ..quantities.nomenclature import NOMENCLATURE
from .inverse import (
    AS_SHOWN,
    PER_DECADE,
    SIZES,
    NoDependence,
    NoSolution,
    Problem,
    SeveralSolutions,
    Undetermined,
    Unseparated,
    Values,
    equal,
    sizes_in_words,
)
from .scene import LEAST, MOST, Scene

Rows = Any  # an array of the numbers of rows
Failures = dict[int, JkrollError]  # by row

_STEP = 1e-6  # of a logarithm, in the differences that give a derivative
_ROUNDING = 1e-12  # of a quantity: a change as small as this comes from rounding

# Of scans.
_TOGETHER = 1 << 17  # values that are computed at once
_WIDEST = (1e-30, 1e30)  # the sizes that are scanned where no value is found among the usual ones
_HALVINGS = 120  # more than lead from a value of a scan to neighbouring doubles, or to 0
_SLOPE = 1e-7  # of an interval, the step whose change tells the side of a maximum or minimum in it
_NEAR_END = (0.0, 1e-6, 1e-4, 1e-2, 0.1, 0.3)  # of the way from an end to the next value: there a function may turn

# Of pairs.
MAX_CONDITION = 1e8  # beyond which rounding leaves the differences that the condition number is made of too few digits
_LOADS = numpy.linspace(-14.0, 46.0, 209)  # coordinates that are scanned: from 1e-6 P_c beyond pull-off to 1e20 P_c
_ROUNDS = 150  # of Newton's method
_LAST_STEP = 1e-14  # of the coordinates: a step as small as this ends the search
_NEAR = 1e-9  # in logarithms of the measured values: a pair that is as near as this is a solution
_SAME = 1e-9  # difference of the coordinates of a pair that was found twice
_ERROR = 1e-13  # of the quantities, where rounding ends
_LINEAR = 1e-6  # part of a measured value below which a quantity counts as it is, above by its logarithm
_MARGIN = 0.5  # of what a quantity changes in a cell, beyond its corners
_SAMPLED = 7  # cells of the grid from one to the next at which it is asked whether the quantities separate the unknowns
_LEFT_OPEN = 1e-4  # an exponent as small as this is none


class Solution(NamedTuple):
    """The values of the unknowns of a problem: numbers, or arrays with nan in the rows that have none for a reason.

    Error bars take it for a scene whose quantities are the unknowns.
    """

    problem: Problem
    values: Values  # by unknown
    growths: Values  # by unknown, the largest factor by which relative errors of measured values enter it
    condition: Any  # of the logarithms of the measured values as functions of those of the unknowns
    failures: Failures
    places: Any  # of two unknowns, in the coordinates in which they were sought

    @property
    def scene(self) -> Scene:
        """The scene with these values in it."""
        return self.problem.with_values(self.values)

    @property
    def forward(self) -> Values:
        """The measured quantities in this scene."""
        return self.scene.numbers(*self.problem.measured)

    @property
    def shape(self) -> tuple[int, ...]:
        """The shape of the values."""
        return numpy.shape(self.condition)

    def replace(self, **values: Any) -> "Solution":
        """Return the solution with other values of inputs and measured quantities.

        Two unknowns in arrays are those to which Newton's method leads from these.
        """
        problem = self.problem.replace(**values)
        size = len(self.condition) if self.shape else problem.size
        return solutions(problem, size, None if size is None else self.places)

    def numbers(self, *_: str) -> Values:
        """Return the unknowns."""
        return self.values

    def evaluate(self, _: Sequence[str]) -> Values:
        """Return the unknowns; of numbers, the error that says why there are none."""
        return self.values if self.shape or not self.failures else dict.fromkeys(self.values, self.failures[0])


def solution(problem: Problem) -> Solution:
    """Return the one solution of a problem of numbers. Raises why there is none, or the error of the inputs."""
    solved = solutions(problem)
    for error in solved.failures.values():
        raise error
    return solved


def solutions(problem: Problem, size: int | None = None, start: Any = None) -> Solution:
    """Return the solutions of some rows, by default of numbers. Raises the error of a problem that has none in any row.

    `start`: the places from which Newton's method leads to two unknowns, in place of a search.
    """
    problem.check()
    count, rows, failures = len(problem.unknowns), 1 if size is None else size, Failures()
    table, places = numpy.full((2 * count + 1, rows), nan), numpy.full((count, rows), nan)
    if count == 1:
        failures = _find_roots(problem, table)
    elif start is None:
        failures = _find_pairs(problem, table, places)
    else:
        _follow_pairs(problem, table, start)
    table[count:] = [[float(f"{number:.6g}") for number in row] for row in table[count:]]  # the rest is rounding
    *columns, condition = table[:, 0].tolist() if size is None else table
    values, growths = (dict(zip(problem.unknowns, part, strict=True)) for part in (columns[:count], columns[count:]))
    return Solution(problem, values, growths, condition, failures, places)


def outcomes(problem: Problem, values: Values) -> Any:
    """Return the measured quantities, a row for each, at values of the unknowns; nan where there is no result."""
    scene = problem.with_values({name: taken(name, x) for name, x in values.items()})
    quantities = numpy.full((len(problem.measured), len(next(iter(values.values())))), nan)
    for quantity, outcome in zip(quantities, scene.evaluate([*problem.measured]).values(), strict=True):
        if not isinstance(outcome, JkrollError):
            quantity[:] = outcome
        elif not isinstance(outcome, NoResult):
            raise outcome
    return quantities


def taken(name: str, values: Any) -> Any:
    """Return the values of an unknown that a scene takes in place of those that are too small or too large for it."""
    if name == "load":
        return numpy.where(abs(values) < LEAST, 0.0, numpy.clip(values, -MOST, MOST))
    return numpy.clip(values, LEAST, MOST)


def grid(name: str, sizes: tuple[float, float]) -> Any:
    """Return the values of an input that are scanned, in rising order."""
    least, most = sizes
    values = numpy.geomspace(least, most, round(numpy.log10(most / least) * PER_DECADE) + 1)
    return numpy.concatenate([-values[::-1], [0.0], values]) if name == "load" else values


def slopes(y: Any) -> Any:
    """Return slopes from three points a step apart; from two where y is nan at one end, and nan where it is at both."""
    low, high = numpy.diff(y, axis=0) / _STEP
    return numpy.where(numpy.isnan(low), high, numpy.where(numpy.isnan(high), low, (low + high) / 2))


# --- One unknown ------------------------------------------------------------------------------------------------------


def _find_roots(problem: Problem, table: Any) -> Failures:
    """Put the values of one unknown into a table, with their growths of errors and conditions; return the failures.

    Where there is none among the usual sizes, all that a scene takes are scanned.
    """
    (unknown,), failures = problem.unknowns, Failures()
    step = _TOGETHER // len(grid(unknown, SIZES[unknown]))
    for start in range(0, table.shape[1], step):
        rows = numpy.arange(start, min(start + step, table.shape[1]))
        table[0, rows], usual = _scanned(problem, rows, SIZES[unknown])
        lacking = [row for row, error in usual.items() if isinstance(error, NoSolution)]
        table[0, lacking], wider = _scanned(problem, lacking, _WIDEST)
        told = {row: error for row, error in wider.items() if isinstance(error, SeveralSolutions | Undetermined)}
        failures |= {row: error for row, error in {**usual, **told}.items() if numpy.isnan(table[0, row])}
    solved = numpy.flatnonzero(~numpy.isnan(table[0]))
    roots = taken(unknown, table[0, solved])
    steps = numpy.exp(_STEP * numpy.array([[-1], [0], [1]]))
    y = outcomes(problem.rows(numpy.tile(solved, 3)), {unknown: (steps * roots).ravel()}).reshape(3, -1)
    with numpy.errstate(divide="ignore", invalid="ignore"):
        condition = abs(y[1] / slopes(y))
    table[:, solved] = roots, condition, condition
    return failures


def _scan(problem: Problem, size: int, sizes: tuple[float, float]) -> "Scan":
    """Return the scan of the measured quantity against the unknown."""
    (unknown,), (level,) = problem.unknowns, problem.levels.values()

    def function(rows: Rows, x: Any) -> Any:
        return outcomes(problem.rows(rows), {unknown: x})[0]

    return Scan(function, grid(unknown, sizes), numpy.full(size, level, dtype=float))


def _scanned(problem: Problem, rows: Rows, sizes: tuple[float, float]) -> tuple[Any, Failures]:
    """Return the values of one unknown between two sizes in some rows, nan where there is none, and the reasons."""
    values, failures = numpy.full(len(rows), nan), Failures()
    if not len(rows):
        return values, failures
    problem = problem.rows(rows)
    scan = _scan(problem, len(rows), sizes)
    of_roots, roots = scan.crossings()
    has_one = (numpy.bincount(of_roots, minlength=len(rows)) == 1) & ~scan.are_still()
    values[of_roots] = numpy.where(has_one[of_roots], roots, nan)
    for row in numpy.flatnonzero(~has_one).tolist():
        failures[int(rows[row])] = _why_not_one(problem.rows(row), sizes, scan, row, roots[of_roots == row].tolist())
    return values, failures


def _why_not_one(
    problem: Problem, sizes: tuple[float, float], scan: "Scan", row: int, roots: Sequence[float]
) -> JkrollError:
    """Return why a row of a scan has no one root."""
    (unknown,), (quantity,) = problem.unknowns, problem.measured
    points = slice(*numpy.searchsorted(scan.rows, [row, row + 1]))
    x, y = scan.x[points], scan.y[points]
    low, high = float(numpy.fmin.reduce(y)), float(numpy.fmax.reduce(y))
    if numpy.isnan(low):
        return problem.failure()
    if high - low <= _ROUNDING * max(abs(low), abs(high)):
        return NoDependence(problem)
    if scan.are_still()[row]:
        inside, both = x[scan.are_level(row, y)][[0, -1]], numpy.full(2, row)
        outside = numpy.clip(inside * [0.5, 2.0], *sizes)
        ends, _ = bisected(inside, outside, lambda x: scan.are_level(both, scan.function(both, x)))
        first, last = ends.tolist()
        stretch = f"every value from {amount(unknown, first)} to {amount(unknown, last)}"
        return Undetermined(problem, f"{stretch} gives {equal(problem.levels)}", (first, last))
    if roots:
        return SeveralSolutions(problem, [{unknown: root} for root in roots])
    lies = f"it lies between {amount(quantity, low)} and {amount(quantity, high)}"
    text = f"no value gives {equal(problem.levels)}; {lies} for {sizes_in_words([unknown])}"
    return NoSolution(problem, text, (low, high))


class Scan:
    """Points of a function in each row, in rising order, of which it rises or falls from one to the next.

    The last values beside gaps and the extremes divide a scan into pieces on which the function rises or falls. A piece
    that crosses the level of its row is bisected down to neighbouring doubles. `rows`, `x` and `y` are arrays with an
    element for each point; y is nan in gaps.
    """

    def __init__(self, function: Callable[[Rows, Any], Any], x: Any, levels: Any) -> None:
        """`function`: of rows and a value in each; `x`: values that are scanned, in order; `levels`: one for a row."""
        self.function, self.levels = function, levels
        self.rows, self.x = numpy.repeat(numpy.arange(len(levels)), len(x)), numpy.tile(x, len(levels))
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
        turns = (rows[:-2] == rows[2:]) & (before * numpy.sign(after) < 0) & (change > _ROUNDING * abs(y[1:-1]))
        start = numpy.flatnonzero(turns)
        row, left, right, sign = rows[start], x[start], x[start + 2], numpy.sign(before[start])
        step = _SLOPE * (right - left)
        turn, _ = bisected(
            left, right, lambda x: sign * (self.function(row, x + step) - self.function(row, x - step)) > 0
        )
        self._add(row, turn)

    def are_level(self, rows: Rows, y: Any) -> Any:
        """Return which values in rows are the levels of these, but for rounding."""
        return abs(y - self.levels[rows]) <= _ROUNDING * abs(self.levels[rows])

    def are_still(self) -> Any:
        """Return which rows stay at their level over more than a decade of positive variables."""
        is_level, size = self.are_level(self.rows, self.y), len(self.levels)
        beyond = numpy.bincount(self.rows[is_level & (self.x <= 0)], minlength=size)
        return (numpy.bincount(self.rows[is_level], minlength=size) > PER_DECADE) & (beyond == 0)

    def crossings(self) -> tuple[Rows, Any]:
        """Return the rows and values at which functions have the level of their row, but for jumps over it.

        The function at such a value is the level as it is shown. Next to pull-off doubles may have none.
        """
        rows, x, y = self.rows, self.x, self.y
        side = numpy.sign(y - self.levels[rows])
        left = numpy.flatnonzero((rows[:-1] == rows[1:]) & (side[:-1] * side[1:] < 0))
        row, level, first, second = rows[left], self.levels[rows[left]], y[left], y[left + 1]
        ends = bisected(x[left], x[left + 1], lambda x: (self.function(row, x) < level) == (first < level))
        off = numpy.array([abs(self.function(row, end) - level) for end in ends])
        root = numpy.where(off[0] < off[1], *ends)
        scale = numpy.where(level == 0, numpy.maximum(abs(first), abs(second)), abs(level))
        is_root, exact = off.min(axis=0) <= AS_SHOWN * scale, side == 0
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


# --- Two unknowns -----------------------------------------------------------------------------------------------------


def _find_pairs(problem: Problem, table: Any, places: Any) -> Failures:
    """Put the values of two unknowns into a table, with their growths of errors and conditions; return the failures."""
    failures = Failures()
    for row in range(table.shape[1]):
        pairs = Pairs(problem.rows(row))
        try:
            places[:, [row]] = place = pairs.pair()
            table[:, [row]] = pairs.measures(place)
        except NoResult as error:
            failures[row] = error
    return failures


def _follow_pairs(problem: Problem, table: Any, start: Any) -> None:
    """Put the values of two unknowns to which Newton's method leads into a table, as far as they are separated."""
    pairs = Pairs(problem, table.shape[1])
    places, distance = pairs.improved(numpy.nan_to_num(numpy.broadcast_to(start, (2, pairs.size))))
    table[:] = pairs.measures(places)
    table[:, (distance == inf) | (table[-1] > MAX_CONDITION)] = nan


class Pairs:
    """A problem of two unknowns, in one row or many, in the coordinates in which they are sought.

    An unknown counts by its logarithm, and a load by ln(1 + P/P_c), which has no end at pull-off. A quantity counts by
    its logarithm, too, and as it is where it is next to zero. Places are arrays with a row for each unknown: one place
    for each row of the problem, or any number of them for a single one.
    """

    def __init__(self, problem: Problem, size: int = 1) -> None:
        self.problem, self.size = problem, size
        self.load = problem.unknowns.index("load") if "load" in problem.unknowns else None
        self.levels = numpy.array([numpy.broadcast_to(level, size) for level in problem.levels.values()], dtype=float)
        self.linear = _LINEAR * abs(self.levels)  # the sizes below which quantities count as they are
        if not self.linear.all():
            usual = {name: numpy.full(size, sqrt(prod(SIZES[name]))) for name in problem.unknowns}
            self.linear = numpy.where(self.levels == 0, abs(outcomes(problem, usual)), self.linear)

    def rows(self, rows: Any) -> "Pairs":
        """Return the same in some rows."""
        return self if self.size == 1 else Pairs(self.problem.rows(rows), len(rows))

    def values(self, places: Any) -> dict[str, Any]:
        """Return the values of the unknowns at places."""
        values = dict(zip(self.problem.unknowns, numpy.exp(places), strict=True))
        if self.load is not None:
            others = {name: taken(name, x) for name, x in values.items() if name != "load"}
            unloaded = self.problem.with_values({**others, "load": 0.0}).numbers("pull_off_force")
            force = unloaded.get("pull_off_force", SIZES["load"][0])  # the smallest that is scanned where there is none
            values["load"] = force * numpy.expm1(places[self.load])
        return values

    def residuals(self, quantities: Any) -> Any:
        """Return by how much quantities are above their measured values."""
        return numpy.arcsinh(quantities / self.linear) - numpy.arcsinh(self.levels / self.linear)

    def slopes(self, places: Any) -> tuple[Any, Any, Any, Any]:
        """Return values and residuals at places, and the derivatives of both, in matrices with a column by unknown."""
        count = places.shape[1]
        steps = _STEP * numpy.array([[0, -1, 1, 0, 0], [0, 0, 0, -1, 1]])
        every = self.rows(numpy.tile(numpy.arange(count), 5))
        values = every.values(numpy.tile(places, 5) + steps.repeat(count, axis=1))
        residuals = every.residuals(outcomes(every.problem, values))
        points = numpy.array([*values.values(), *residuals]).reshape(4, 5, count).swapaxes(0, 1)
        derivatives = numpy.array([slopes(points[[low, 0, low + 1]]) for low in (1, 3)]).T
        return points[0, :2], points[0, 2:], derivatives[:, :2], derivatives[:, 2:]

    def measures(self, places: Any) -> Any:
        """Return the values of the unknowns at places, the growths of errors there, and the condition numbers."""
        values, _, changes, matrices = self.slopes(places)
        inverse = numpy.linalg.pinv(numpy.nan_to_num(matrices), rcond=0.1 / MAX_CONDITION)
        with numpy.errstate(divide="ignore", invalid="ignore"):
            growths = numpy.linalg.norm(changes @ inverse, axis=2).T / abs(values)
        return numpy.array([*values, *growths, _conditions(matrices)])

    def improved(self, start: Any) -> tuple[Any, Any]:
        """Return the places to which Newton's method leads from others, and how far they are from solutions.

        The distance is infinite where there is none, or not among the sizes that are looked for, but for rounding.
        """
        best, steps = numpy.array(start), numpy.zeros_like(start)
        distance = numpy.full(start.shape[1], inf)
        active = numpy.arange(start.shape[1])
        for _ in range(_ROUNDS):
            places = best[:, active] + steps[:, active]
            _, residuals, _, matrices = self.rows(active).slopes(places)
            size = numpy.hypot(*residuals)
            is_nearer = size < distance[active]
            nearer = active[is_nearer]
            best[:, nearer], distance[nearer] = places[:, is_nearer], size[is_nearer]
            # Where both quantities change alike, the pseudo-inverse gives the shortest step.
            inverse = numpy.linalg.pinv(numpy.nan_to_num(matrices), rcond=0.01 / MAX_CONDITION)
            newton = -numpy.einsum("kij,jk->ik", inverse, numpy.nan_to_num(residuals))
            limited = newton / numpy.maximum(1.0, numpy.hypot(*newton))
            steps[:, active] = numpy.where(is_nearer, limited, steps[:, active] / 2)
            active = active[abs(steps[:, active]).max(axis=0) > _LAST_STEP]
            if not active.size:
                break
        if self.load is not None:
            best[self.load, abs(best[self.load]) <= _SAME] = 0.0  # no load
        is_pair = distance <= _NEAR
        for name, values in self.values(best).items():
            least, most = SIZES[name]
            is_pair &= ((values >= least * (1 - _SAME)) | (name == "load")) & (values <= most * (1 + _SAME))
        return best, numpy.where(is_pair, distance, inf)

    def pair(self) -> Any:
        """Return the place of the one pair. Raises the reason why there is none."""
        axes = [_LOADS if name == "load" else numpy.log(grid(name, SIZES[name])) for name in self.problem.unknowns]
        mesh = numpy.array(numpy.meshgrid(*axes, indexing="ij"))
        *_, matrices = self.slopes(mesh[:, ::_SAMPLED, ::_SAMPLED].reshape(2, -1))
        known = matrices[numpy.isfinite(matrices).all(axis=(1, 2))]
        if len(known) and not (_conditions(known) <= MAX_CONDITION / 10).any():
            raise Unseparated(self.problem, self._left_open(known[len(known) // 2]))
        quantities = outcomes(self.problem, self.values(mesh.reshape(2, -1)))
        places, distance = self.improved(_in_cells(mesh, self.residuals(quantities).reshape(mesh.shape)))
        order = numpy.argsort(distance)[: numpy.isfinite(distance).sum()]
        if not order.size:
            raise self._failure(quantities)
        places, distance = places[:, order], distance[order]
        *_, matrices = self.slopes(places)
        conditions = _conditions(matrices)
        worst = int(conditions.argmax())
        if conditions[worst] > MAX_CONDITION:
            raise Unseparated(self.problem, self._left_open(matrices[worst]), float(conditions[worst]))
        distinct = _distinct(places, conditions * (_ERROR + 2 * distance))
        if len(distinct) > 1:
            rows = sorted(numpy.transpose([*self.values(places[:, distinct]).values()]).tolist())
            raise SeveralSolutions(self.problem, [dict(zip(self.problem.unknowns, row, strict=True)) for row in rows])
        return places[:, :1]

    # --- Why there is none ---

    def _failure(self, quantities: Any) -> JkrollError:
        """Return the reason why no pair gives both measured values, of which `quantities` are those on the grid."""
        problem, levels = self.problem, self.problem.levels
        if not numpy.isfinite(quantities.sum(axis=0)).any():
            return problem.failure()
        scene = problem.filled()
        first, second = sorted(levels, key=lambda name: len({*problem.unknowns}.intersection(scene.inputs_of(name))))
        every = zip(levels, quantities, strict=True)
        ranges: list[Any] = [({name: levels[name]}, "it", name, values) for name, values in every]
        where = f"where {equal({first: levels[first]})}, {second}"
        ranges.append((levels, where, second, self._along(first, second)))
        sizes = f"for {sizes_in_words(problem.unknowns)}"
        for given, subject, name, values in ranges:
            low, high = float(numpy.nanmin(values, initial=inf)), float(numpy.nanmax(values, initial=-inf))
            if low <= high and not low <= levels[name] <= high:
                lies = f"{subject} lies between {amount(name, low)} and {amount(name, high)}"
                return NoSolution(problem, f"no pair of values gives {equal(given)}; {lies} {sizes}", (low, high))
        return NoSolution(problem, f"no pair of values gives {equal(levels)} {sizes}")

    def _along(self, first: str, second: str) -> Any:
        """Return a quantity at values of the unknowns at which the other one has its measured value."""
        depends = self.problem.filled().inputs_of(first)
        sought, other = sorted(self.problem.unknowns, key=lambda name: name not in depends)
        values = grid(other, SIZES[other])
        problem = Problem((sought,), {first: self.problem.levels[first]}, self.problem.with_values({other: values}))
        rows, roots = _scan(problem, len(values), SIZES[sought]).crossings()
        return outcomes(self.problem, {sought: roots, other: values[rows]})[[*self.problem.measured].index(second)]

    def _left_open(self, matrix: Any) -> str:
        """Return the direction in which both quantities stay as they are, given the matrix of their derivatives."""
        by_left, by_right = max(matrix.tolist(), key=lambda slope: hypot(*slope))  # the steepest
        symbols = [NOMENCLATURE[name].symbol for name in self.problem.unknowns]
        if min(abs(by_left), abs(by_right)) <= _LEFT_OPEN * max(abs(by_left), abs(by_right)):
            return f"they leave {symbols[0] if abs(by_left) < abs(by_right) else symbols[1]} open"
        if self.load is not None:
            symbols[self.load] = "(1 + P/P_c)"  # by whose logarithm a load counts
        left, right = symbols
        return f"both stay as they are along {left} ∝ {right}^{-by_right / by_left:.3g}"


def _in_cells(mesh: Any, residuals: Any) -> Any:
    """Return places in the cells of a grid that both measured values may cross: the centre, and one by each corner."""
    corners = numpy.lib.stride_tricks.sliding_window_view(residuals, (2, 2), axis=(1, 2))
    low, high = (each.reduce(corners, axis=(3, 4)) for each in (numpy.fmin, numpy.fmax))
    margin = _MARGIN * (high - low)
    is_at_gap = numpy.isnan(corners).any(axis=(3, 4)) & numpy.isfinite(low)
    cells = ((low - margin <= 0) & (high + margin >= 0) | is_at_gap).all(axis=0)
    first, last = mesh[:, :-1, :-1][:, cells], mesh[:, 1:, 1:][:, cells]
    shares = [(0.5, 0.5), *((i, j) for i in (0.2, 0.8) for j in (0.2, 0.8))]
    return numpy.concatenate([first + numpy.reshape(share, (2, 1)) * (last - first) for share in shares], axis=1)


def _conditions(matrices: Any) -> Any:
    """Return the condition numbers of matrices of derivatives, infinite where a derivative has no value."""
    return numpy.linalg.cond(numpy.nan_to_num(matrices))


def _distinct(places: Any, errors: Any) -> list[int]:
    """Return the numbers of places that differ by more than their errors."""
    distinct: list[int] = []
    for number in range(places.shape[1]):
        off = abs(places[:, distinct] - places[:, [number]])
        if (off > _SAME + errors[number] + errors[distinct]).any(axis=0).all():
            distinct.append(number)
    return distinct
