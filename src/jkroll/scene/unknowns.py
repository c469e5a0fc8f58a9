"""The solver of the inverse problem, of numbers and arrays: one unknown by scans, two by a grid and Newton's method."""

from functools import cached_property
from math import inf, nan
from typing import Any

import numpy

from ..errors import JkrollError, NoResult
from ..quantities.formatting import amount
from ..quantities.nomenclature import NOMENCLATURE
from .inverse import (
    PER_DECADE,
    SIZES,
    NoDependence,
    NoSolution,
    Problem,
    SeveralSolutions,
    Solution,
    Undetermined,
    Unseparated,
    Values,
    equal,
    sizes_in_words,
)
from .scans import ROUNDING, Rows, Scan, bisected, slopes
from .scene import LEAST, MOST

STEP = 1e-6  # relative, of the differences that give a slope

_TOGETHER = 1 << 17  # values of a scan that are computed at once
_WIDEST = (1e-30, 1e30)  # the sizes that are scanned where no value is found among the usual ones

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


def solution(problem: Problem) -> Solution:
    """Return the one solution of a problem of numbers. Raises why there is none, or the error of the inputs."""
    arrays = solutions(problem, 1)
    for error in arrays.failures.values():
        raise error
    values = {name: float(column[0]) for name, column in arrays.values.items()}
    growths = {name: float(column[0]) for name, column in arrays.growths.items()}
    return Solution(problem, values, float(arrays.condition[0]), growths, {})


def solutions(problem: Problem, size: int, near: Values | None = None) -> Solution:
    """Return the solutions of some rows. `near`: values of two unknowns from which Newton's method starts first.

    Raises the error of a problem that has none whatever the measured values are.
    """
    problem.check()
    values, growths = ({name: numpy.full(size, numpy.nan) for name in problem.unknowns} for _ in range(2))
    whole = Solution(problem, values, numpy.full(size, numpy.nan), growths, {})
    if len(problem.unknowns) == 1:
        step = _TOGETHER // len(grid(problem.unknowns[0], SIZES[problem.unknowns[0]]))
        for start in range(0, size, step):
            rows = range(start, min(start + step, size))
            whole.put(rows, _of_one(problem.rows(slice(start, rows.stop)), len(rows)))
    else:
        rest = range(size)
        if near is not None:
            known = numpy.flatnonzero(~numpy.isnan([*near.values()]).any(axis=0))
            pairs = Pairs(problem.rows(known), len(known))
            followed, is_lost = pairs.followed({name: values[known] for name, values in near.items()})
            whole.put(known.tolist(), followed)
            rest = known[is_lost].tolist()
        for row in rest:
            try:
                whole.put([row], Pairs(problem.rows(row)).pair())
            except NoResult as error:
                whole.failures[row] = error
    for column in (whole.condition, *growths.values()):
        column[:] = [float(f"{number:.6g}") for number in column]  # the rest comes from rounding
    return whole


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


# --- One unknown ------------------------------------------------------------------------------------------------------


def _of_one(problem: Problem, size: int) -> Solution:
    """Return the solutions for one unknown, among all sizes that a scene takes where none is among the usual ones."""
    (unknown,) = problem.unknowns
    usual = Roots(problem, size, SIZES[unknown]).solution()
    lacking = [row for row, error in usual.failures.items() if isinstance(error, NoSolution)]
    if lacking:
        wider = Roots(problem.rows(lacking), len(lacking), _WIDEST).solution()
        for place, error in wider.failures.items():
            if not isinstance(error, SeveralSolutions | Undetermined):
                wider.failures[place] = usual.failures[lacking[place]]
        usual.put(lacking, wider)
    return usual


class Roots:
    """A scan of the unknown in some rows between two sizes, and what comes of it."""

    def __init__(self, problem: Problem, size: int, sizes: tuple[float, float]) -> None:
        self.problem, self.size, self.sizes = problem, size, sizes
        ((self.unknown,), ((self.quantity, levels),)) = problem.unknowns, problem.measured.items()
        self.levels = numpy.full(size, levels, dtype=float)
        self.scan = Scan(self.function, grid(self.unknown, sizes), size)

    def function(self, rows: Rows, x: Any) -> Any:
        """Return the measured quantity."""
        return outcomes(self.problem.rows(rows), {self.unknown: x})[0]

    def solution(self) -> Solution:
        """Return the one solution in each row, and the reasons why others have none."""
        every = numpy.arange(self.size)
        points, y = self.scan.rows, self.scan.y
        is_level = self._is_level(points, y)
        low, high, first, last = (
            end.reduceat(values, numpy.searchsorted(points, every))
            for values in (y, numpy.where(is_level, self.scan.x, numpy.nan))
            for end in (numpy.fmin, numpy.fmax)
        )
        depends = high - low > ROUNDING * numpy.fmax(abs(low), abs(high))
        counts = numpy.bincount(points[is_level], minlength=self.size)
        is_stretch = depends & (counts > PER_DECADE) & (first > 0) & (last >= 10 * first)
        rows, roots = self.scan.crossings(self.levels)
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
        text = f"no value gives {equal(problem.measured)}; {lies} for {sizes_in_words([self.unknown])}"
        return NoSolution(problem, text, (low, high))

    def _undetermined(self, row: int, inside: Any) -> Undetermined:
        """Return the error of a measured value that a stretch has, given points of the scan at both ends of this."""
        rows, problem = numpy.full(2, row), self.problem.rows(row)
        outside = numpy.clip(inside * [0.5, 2.0], *self.sizes)
        ends, _ = bisected(inside, outside, lambda x: self._is_level(rows, self.function(rows, x)))
        low, high = ends.tolist()
        span = f"{amount(self.unknown, low)} to {amount(self.unknown, high)}"
        return Undetermined(problem, f"every value from {span} gives {equal(problem.measured)}", (low, high))

    def _is_level(self, rows: Rows, y: Any) -> Any:
        return abs(y - self.levels[rows]) <= ROUNDING * abs(self.levels[rows])

    def _condition(self, values: Any) -> Any:
        """Return |d ln unknown / d ln quantity| by central differences, or one-sided ones where the quantity ends."""
        rows = numpy.flatnonzero(~numpy.isnan(values))
        factors = numpy.array([1 / (1 + STEP), 1.0, 1 + STEP])
        y = self.function(numpy.tile(rows, 3), numpy.outer(factors, values[rows]).ravel()).reshape(3, -1)
        condition = numpy.full(self.size, numpy.nan)
        with numpy.errstate(divide="ignore", invalid="ignore"):
            condition[rows] = abs(y[1] / slopes(numpy.log(factors), y))
        return condition


# --- Two unknowns -----------------------------------------------------------------------------------------------------


class Pairs:
    """A problem of two unknowns, in one row or many, in the coordinates in which they are sought.

    An unknown counts by its logarithm, and a load by ln(1 + P/P_c), which has no end at pull-off. A quantity counts by
    its logarithm, too, and as it is where it is next to zero. Places are arrays with a row for each unknown: one place
    for each row of the problem, or any number of them for a single one.
    """

    def __init__(self, problem: Problem, size: int = 1) -> None:
        self.problem, self.size = problem, size
        self.load = problem.unknowns.index("load") if "load" in problem.unknowns else None
        self.levels = numpy.array([numpy.broadcast_to(level, size) for level in problem.measured.values()], dtype=float)

    def rows(self, rows: Any) -> "Pairs":
        """Return the same in some rows."""
        return self if self.size == 1 else Pairs(self.problem.rows(rows), len(rows))

    def values(self, places: Any) -> dict[str, Any]:
        """Return the values of the unknowns at places."""
        values = dict(zip(self.problem.unknowns, numpy.exp(places), strict=True))
        if self.load is not None:
            values["load"] = self._force(values) * numpy.expm1(places[self.load])
        return values

    def places(self, values: Values) -> Any:
        """Return the places at which the unknowns have some values; a load beyond pull-off counts as one next to it."""
        places = {name: numpy.log(column) for name, column in values.items() if name != "load"}
        if self.load is not None:
            places["load"] = numpy.log1p(numpy.maximum(values["load"] / self._force(values), numpy.expm1(_LOADS[0])))
        return numpy.array([places[name] for name in self.problem.unknowns])

    def _force(self, values: Values) -> Any:
        """Return the pull-off force; the smallest load that is scanned where there is none."""
        others = {name: taken(name, x) for name, x in values.items() if name != "load"}
        force = self.problem.with_values({**others, "load": 0.0}).numbers("pull_off_force")
        return force.get("pull_off_force", SIZES["load"][0])

    def residuals(self, places: Any) -> Any:
        """Return by how much quantities are above their measured values."""
        return self._above(outcomes(self.problem, self.values(places)))

    def _above(self, quantities: Any) -> Any:
        return numpy.arcsinh(quantities / self._scales) - numpy.arcsinh(self.levels / self._scales)

    @cached_property
    def _scales(self) -> Any:
        """The sizes below which quantities count as they are."""
        scales = _LINEAR * abs(self.levels)
        if scales.all():
            return scales
        usual = numpy.nanmedian(abs(self.rows([0]).on_mesh), axis=1)
        return numpy.where(scales == 0, usual[:, None], scales)

    def slopes(self, places: Any) -> tuple[Any, Any]:
        """Return the residuals at places, and a matrix of their derivatives for each: by quantity and unknown."""
        count = places.shape[1]
        steps = STEP * numpy.repeat([[0, -1, 1, 0, 0], [0, 0, 0, -1, 1]], count, axis=1)
        every = self.rows(numpy.tile(numpy.arange(count), 5))
        residuals = every.residuals(numpy.tile(places, 5) + steps).reshape(2, 5, count)
        middle = residuals[:, 0]
        by_unknown = [slopes((-STEP, 0.0, STEP), (residuals[:, low], middle, residuals[:, low + 1])) for low in (1, 3)]
        return middle, numpy.array(by_unknown).T

    def solution(self, places: Any) -> Solution:
        """Return the values of the unknowns at places, with their condition number and the growth of errors."""
        _, matrices = self.slopes(places)
        values = self.values(places)
        ends = [[self.values(places + shift) for shift in (-step, step)] for step in STEP * numpy.eye(2)[:, :, None]]
        changes = numpy.array([[high[name] - low[name] for low, high in ends] for name in values]) / (2 * STEP)
        inverse = numpy.linalg.pinv(numpy.nan_to_num(matrices), rcond=0.1 / MAX_CONDITION)
        spreads = numpy.linalg.norm(numpy.moveaxis(changes, -1, 0) @ inverse, axis=2)
        with numpy.errstate(divide="ignore", invalid="ignore"):
            growths = {name: spread / abs(values[name]) for name, spread in zip(values, spreads.T, strict=True)}
        return Solution(self.problem, values, _conditions(matrices), growths, {})

    # --- Newton's method ---

    def improved(self, start: Any) -> tuple[Any, Any]:
        """Return the places to which Newton's method leads from others, and which of them are solutions.

        The unknowns are among the sizes that are looked for, but for rounding.
        """
        best, steps = numpy.array(start), numpy.zeros_like(start)
        distance = numpy.full(start.shape[1], inf)
        active = numpy.arange(start.shape[1])
        for _ in range(_ROUNDS):
            places = best[:, active] + steps[:, active]
            residuals, matrices = self.rows(active).slopes(places)
            size = numpy.hypot(*residuals)
            is_nearer = size < distance[active]
            nearer = active[is_nearer]
            best[:, nearer], distance[nearer] = places[:, is_nearer], size[is_nearer]
            steps[:, active] = numpy.where(is_nearer, _newton_step(residuals, matrices), steps[:, active] / 2)
            active = active[abs(steps[:, active]).max(axis=0) > _LAST_STEP]
            if not active.size:
                break
        if self.load is not None:
            best[self.load, abs(best[self.load]) <= _SAME] = 0.0  # no load
        is_pair = distance <= _NEAR
        for name, values in self.values(best).items():
            least, most = SIZES[name]
            is_pair &= ((values >= least * (1 - _SAME)) | (name == "load")) & (values <= most * (1 + _SAME))
        return best, numpy.where(is_pair, distance, nan)

    def followed(self, near: Values) -> tuple[Solution, Any]:
        """Return the solutions to which Newton's method leads from values, and the rows in which it leads to none."""
        places, distance = self.improved(self.places(near))
        pairs = self.solution(places)
        is_lost = ~((distance <= _NEAR) & (pairs.condition <= MAX_CONDITION))
        for column in pairs.values.values():
            column[is_lost] = nan
        return pairs, is_lost

    # --- The search, in one row ---

    @cached_property
    def _mesh(self) -> Any:
        """The places of the grid."""
        axes = [_LOADS if name == "load" else numpy.log(grid(name, SIZES[name])) for name in self.problem.unknowns]
        return numpy.array(numpy.meshgrid(*axes, indexing="ij"))

    @cached_property
    def on_mesh(self) -> Any:
        """The quantities at the places of the grid."""
        return outcomes(self.problem, self.values(self._mesh.reshape(2, -1)))

    def pair(self) -> Solution:
        """Return the one pair. Raises the reason why there is none."""
        sample = self._mesh[:, ::_SAMPLED, ::_SAMPLED].reshape(2, -1)
        _, matrices = self.slopes(sample)
        known = numpy.flatnonzero(numpy.isfinite(matrices).all(axis=(1, 2)))
        if known.size and not (_conditions(matrices[known]) <= MAX_CONDITION / 10).any():
            raise Unseparated(self.problem, self._left_open(matrices[known[known.size // 2]]))
        places, distance = self.improved(self._in_cells())
        order = numpy.argsort(distance)[: numpy.isfinite(distance).sum()]
        if not order.size:
            raise self._failure()
        places, distance = places[:, order], distance[order]
        pairs = self.solution(places)
        worst = int(pairs.condition.argmax())
        if pairs.condition[worst] > MAX_CONDITION:
            remark = self._left_open(self.slopes(places[:, [worst]])[1][0])
            raise Unseparated(self.problem, remark, float(pairs.condition[worst]))
        distinct = _distinct(places, pairs.condition * (_ERROR + 2 * distance))
        if len(distinct) > 1:
            rows = sorted(numpy.transpose([*pairs.values.values()])[distinct].tolist())
            several = [dict(zip(pairs.values, row, strict=True)) for row in rows]
            raise SeveralSolutions(self.problem, several)
        return self.solution(places[:, :1])

    def _in_cells(self) -> Any:
        """Return places in the cells that both measured values may cross: the centre, and one towards each corner."""
        residuals = self._above(self.on_mesh).reshape(self._mesh.shape)
        corners = numpy.lib.stride_tricks.sliding_window_view(residuals, (2, 2), axis=(1, 2))
        low, high = (each.reduce(corners, axis=(3, 4)) for each in (numpy.fmin, numpy.fmax))
        margin = _MARGIN * (high - low)
        is_at_gap = numpy.isnan(corners).any(axis=(3, 4)) & numpy.isfinite(low)
        cells = ((low - margin <= 0) & (high + margin >= 0) | is_at_gap).all(axis=0)
        first, last = self._mesh[:, :-1, :-1][:, cells], self._mesh[:, 1:, 1:][:, cells]
        shares = [(0.5, 0.5), *((i, j) for i in (0.2, 0.8) for j in (0.2, 0.8))]
        return numpy.concatenate([first + numpy.reshape(share, (2, 1)) * (last - first) for share in shares], axis=1)

    # --- Why there is none ---

    def _failure(self) -> JkrollError:
        """Return the reason why no pair gives both measured values."""
        problem, levels = self.problem, self.problem.measured
        if not numpy.isfinite(self.on_mesh.sum(axis=0)).any():
            return problem.failure()
        scene = problem.filled()
        first, second = sorted(levels, key=lambda name: len({*problem.unknowns}.intersection(scene.inputs_of(name))))
        ranges = [(name, "it", heights) for name, heights in zip(levels, self.on_mesh, strict=True)]
        ranges.append((second, f"where {equal({first: levels[first]})}, {second}", self._along(first, second)))
        sizes = f"for {sizes_in_words(problem.unknowns)}"
        for name, subject, heights in ranges:
            low, high = float(numpy.nanmin(heights, initial=inf)), float(numpy.nanmax(heights, initial=-inf))
            if low <= high and not low <= levels[name] <= high:
                given = equal({name: levels[name]} if subject == "it" else levels)
                lies = f"{subject} lies between {amount(name, low)} and {amount(name, high)}"
                return NoSolution(problem, f"no pair of values gives {given}; {lies} {sizes}", (low, high))
        return NoSolution(problem, f"no pair of values gives {equal(levels)} {sizes}")

    def _along(self, first: str, second: str) -> Any:
        """Return a quantity at values of the unknowns at which the other one has its measured value."""
        depends = self.problem.filled().inputs_of(first)
        sought, other = sorted(self.problem.unknowns, key=lambda name: name not in depends)
        places = grid(other, SIZES[other])
        problem = Problem((sought,), {first: self.problem.measured[first]}, self.problem.with_values({other: places}))
        at_places = Roots(problem, len(places), SIZES[sought])
        rows, roots = at_places.scan.crossings(at_places.levels)
        heights = outcomes(self.problem, {sought: roots, other: places[rows]})
        return heights[[*self.problem.measured].index(second)]

    def _left_open(self, matrix: Any) -> str:
        """Return the direction in which both quantities stay as they are, given the matrix of their derivatives."""
        steepest = max(matrix, key=lambda slope: float(numpy.hypot(*slope)))
        by_left, by_right = steepest.tolist()
        left, right = (NOMENCLATURE[name].symbol for name in self.problem.unknowns)
        if min(abs(by_left), abs(by_right)) <= _LEFT_OPEN * max(abs(by_left), abs(by_right)):
            return f"they leave {left if abs(by_left) < abs(by_right) else right} open"
        return f"both stay as they are along {left} ∝ {right}^{-by_right / by_left:.3g}"


def _conditions(matrices: Any) -> Any:
    """Return the condition numbers of matrices of derivatives, infinite where a derivative has no value."""
    return numpy.linalg.cond(numpy.nan_to_num(matrices))


def _newton_step(residuals: Any, matrices: Any) -> Any:
    """Return the step to where both residuals are 0, of a limited length; the shortest one where they change alike."""
    inverse = numpy.linalg.pinv(numpy.nan_to_num(matrices), rcond=0.01 / MAX_CONDITION)
    steps = -(inverse @ numpy.nan_to_num(residuals).T[:, :, None])[:, :, 0].T
    return steps / numpy.maximum(1.0, numpy.hypot(*steps))


def _distinct(places: Any, errors: Any) -> list[int]:
    """Return the numbers of places that differ by more than their errors."""
    distinct: list[int] = []
    for number in range(places.shape[1]):
        off = abs(places[:, distinct] - places[:, [number]])
        if (off > _SAME + errors[number] + errors[distinct]).any(axis=0).all():
            distinct.append(number)
    return distinct
