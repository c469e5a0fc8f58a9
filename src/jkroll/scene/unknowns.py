"""The solver of the inverse problem, in one row or many: one unknown by a scan, two by a grid and Newton's method."""

from collections.abc import Sequence
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
_AHEAD = 1e-8  # relative, the step that tells whether a function rises or falls
_STILL = 1e-13  # of a function, a change over this step that is none
_MANY = 64  # intervals of a row: more of them come from rounding

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
    def is_uncertain(self) -> bool:
        """True if the problem has a value with an uncertainty."""
        return self.problem.is_uncertain

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


def _scanned(problem: Problem, rows: Rows, sizes: tuple[float, float]) -> tuple[Any, Failures]:
    """Return the values of one unknown between two sizes in some rows, nan where there is none, and the reasons."""
    values, failures = numpy.full(len(rows), nan), Failures()
    if len(rows):
        scan = Scan(problem.rows(rows), len(rows), sizes)
        has_one = (numpy.bincount(scan.rows, minlength=len(rows)) == 1) & scan.varies & ~scan.is_still
        values[scan.rows] = numpy.where(has_one[scan.rows], scan.roots, nan)
        failures = {int(rows[row]): scan.failure(row) for row in numpy.flatnonzero(~has_one).tolist()}
    return values, failures


class Scan:
    """A search for the values of one unknown between two sizes, in each row of a problem.

    It begins with a grid, and halves each interval at whose ends the measured quantity differs: it has a value at one
    alone, is on other sides of its level, rises at one and falls at the other, or stays at its level at one alone. So
    the ends of gaps and the extremes are found on the way, and what lies between these and the grid.

    `rows` and `roots` are arrays of what was found, in order. Of each row, `varies` says whether the quantity does on
    the grid, `span` has its least and largest value, and `stretch` the first and the last value of the unknown at which
    it stays at its level, nan if there is none.
    """

    def __init__(self, problem: Problem, size: int, sizes: tuple[float, float]) -> None:
        """`size`: the number of rows."""
        (self.unknown,), (level,) = problem.unknowns, problem.levels.values()
        self.problem, self.levels = problem, numpy.full(size, level, dtype=float)
        self.span: Any = numpy.full((2, size), nan)
        self.stretch: Any = numpy.full((2, size), nan)
        x = grid(self.unknown, sizes)
        rows = numpy.repeat(numpy.arange(size), len(x))
        points = self._points(rows, numpy.tile(x, size))
        is_hit = points[1] == self.levels[rows]
        points[3, is_hit] = 0
        hits = [numpy.array([rows, points[0]])[:, is_hit]]
        self.varies = self.span[1] - self.span[0] > _ROUNDING * abs(self.span).max(axis=0)
        rows, points = rows.reshape(size, -1)[:, :-1], points.reshape(len(points), size, -1)
        left, right = points[..., :-1], points[..., 1:]
        for _ in range(_HALVINGS):
            crosses = (left[2] != right[2]) | (left[3] * right[3] < 0)
            differs = crosses | (left[4] != right[4]) | (left[5] * right[5] < 0)
            differs &= crosses | (numpy.bincount(rows[differs], minlength=size)[rows] <= _MANY)
            rows, left, right = rows[differs], left[:, differs], right[:, differs]
            middle = (left[0] + right[0]) / 2
            if ((middle == left[0]) | (middle == right[0])).all():
                break
            points = self._points(rows, middle)
            hits.append(numpy.array([rows, middle])[:, points[3] == 0])
            rows = numpy.tile(rows, 2)
            left, right = numpy.concatenate([left, points], axis=1), numpy.concatenate([points, right], axis=1)
        every = numpy.concatenate([*hits, self._crossings(rows, left, right)], axis=1)
        rows, self.roots = numpy.unique(every, axis=1)
        self.rows = rows.astype(int)

    @property
    def is_still(self) -> Any:
        """True for the rows whose quantity stays at its level over a decade."""
        first, last = self.stretch
        return (first > 0) & (last >= 10 * first)

    def _points(self, rows: Rows, x: Any) -> Any:
        """Return points: x, y, whether y is a number, its side of the level, whether it stays there, and its slope."""
        every = {self.unknown: numpy.concatenate([x, x + _AHEAD * abs(x)])}
        y, ahead = outcomes(self.problem.rows(numpy.tile(rows, 2)), every).reshape(2, -1)
        level, change = self.levels[rows], numpy.nan_to_num(ahead - y)
        slope = numpy.where(abs(change) > _STILL * abs(y), numpy.sign(change), 0.0)
        stays = (slope == 0) & (abs(y - level) <= _ROUNDING * abs(level))
        for extent, values in ((self.span, y), (self.stretch, numpy.where(stays, x, nan))):
            numpy.fmin.at(extent[0], rows, values)
            numpy.fmax.at(extent[1], rows, values)
        side = numpy.sign(y - level)
        side[stays & (side == 0)] = 1  # on a stretch it is on one side of its end
        return numpy.array([x, y, numpy.isfinite(y), side, stays, slope])

    def _crossings(self, rows: Rows, left: Any, right: Any) -> Any:
        """Return the rows and ends of intervals at which quantities cross their level, but for jumps over it.

        The quantity at such an end is the level as it is shown. Next to pull-off doubles may have none.
        """
        level = self.levels[rows]
        off = abs(numpy.array([left[1], right[1]]) - level)
        scale = numpy.where(level == 0, numpy.maximum(abs(left[1]), abs(right[1])), abs(level))
        is_crossing = (left[3] * right[3] < 0) & (off.min(axis=0) <= AS_SHOWN * scale)
        return numpy.array([rows, numpy.where(off[0] < off[1], left[0], right[0])])[:, is_crossing]

    def failure(self, row: int) -> JkrollError:
        """Return why a row has no one root."""
        problem, (quantity,) = self.problem.rows(row), self.problem.measured
        (low, high), (first, last) = self.span[:, row].tolist(), self.stretch[:, row].tolist()
        if numpy.isnan(low):
            return problem.failure()
        if not self.varies[row]:
            return NoDependence(problem)
        if self.is_still[row]:
            stretch = f"every value from {amount(self.unknown, first)} to {amount(self.unknown, last)}"
            return Undetermined(problem, f"{stretch} gives {equal(problem.levels)}", (first, last))
        if len(roots := self.roots[self.rows == row].tolist()):
            return SeveralSolutions(problem, [{self.unknown: root} for root in roots])
        lies = f"it lies between {amount(quantity, low)} and {amount(quantity, high)}"
        text = f"no value gives {equal(problem.levels)}; {lies} for {sizes_in_words([self.unknown])}"
        return NoSolution(problem, text, (low, high))


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
        scan = Scan(problem, len(values), SIZES[sought])
        return outcomes(self.problem, {sought: scan.roots, other: values[scan.rows]})[
            [*self.problem.measured].index(second)
        ]

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
