"""The solver of the inverse problem, for numbers and for arrays: one unknown by scans, two by Newton's method on a grid."""

from functools import cached_property
from math import inf, log
from typing import Any

import numpy

from ..errors import JkrollError
from ..quantities.formatting import amount
from ..quantities.nomenclature import NOMENCLATURE
from .inverse import (
    PER_DECADE,
    SIZES,
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
from .scans import STEP, Rows, Scan, grid, outcomes, slopes, taken

_TOGETHER = 1 << 17  # values of a scan that are computed at once
_WIDEST = (1e-30, 1e30)  # the sizes that are scanned where no value is found among the usual ones
MAX_CONDITION = 1e8  # beyond which rounding leaves the differences that the condition number is made of too few digits
_OF_LOAD = (-14.0, 46.0)  # coordinates of a load that are scanned: from 1e-6 P_c beyond pull-off to 1e20 P_c
_ROUNDS = 150  # of Newton's method
_STEPS_BACK = 30  # halvings of a step that leads further away, after which it has ended
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
    values, growths = (
        {name: float(column[0]) for name, column in each.items()} for each in (arrays.values, arrays.growths)
    )
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
        rest = [*range(size)]
        if near is not None:
            pairs, rest = Pairs(problem, size).followed(near)
            whole.put(range(size), pairs)
        for row in rest:
            whole.put([row], Pairs(problem.rows(row)).solution())
    whole.condition[:] = [float(f"{number:.6g}") for number in whole.condition]
    return whole


def _of_one(problem: Problem, size: int) -> Solution:
    """Return the solutions for one unknown, among all sizes that a scene takes where none is among the usual ones."""
    (unknown,) = problem.unknowns
    usual = Scan(problem, size, SIZES[unknown]).solution()
    lacking = [row for row, error in usual.failures.items() if isinstance(error, NoSolution)]
    if lacking:
        wider = Scan(problem.rows(lacking), len(lacking), _WIDEST).solution()
        for place, error in wider.failures.items():
            if not isinstance(error, SeveralSolutions | Undetermined):
                wider.failures[place] = usual.failures[lacking[place]]
        usual.put(lacking, wider)
    return usual


class Pairs:
    """A problem of two unknowns, in one row or many, in the coordinates in which they are sought.

    An unknown counts by its logarithm, and a load by ln(1 + P/P_c), which has no end at pull-off. A quantity counts by
    its logarithm, too, and as it is where it is next to zero. Places are arrays with a row for each unknown.
    """

    def __init__(self, problem: Problem, size: int = 1) -> None:
        self.problem, self.size = problem, size
        self.load = problem.unknowns.index("load") if "load" in problem.unknowns else None
        self.levels = numpy.array([numpy.broadcast_to(level, size) for level in problem.levels.values()], dtype=float)
        self.scales = _LINEAR * abs(self.levels)
        if not self.scales.all():
            usual = numpy.nanmedian(abs(self._on_mesh), axis=(1, 2))
            self.scales = numpy.where(self.scales == 0, usual[:, None], self.scales)

    # --- Coordinates ---

    def values(self, rows: Rows, places: Any) -> dict[str, Any]:
        """Return the values of the unknowns at places."""
        values = dict(zip(self.problem.unknowns, numpy.exp(places), strict=True))
        if self.load is not None:
            values["load"] = self._force(rows, values) * numpy.expm1(places[self.load])
        return values

    def places(self, rows: Rows, values: Values) -> Any:
        """Return the places at which the unknowns have some values."""
        with numpy.errstate(divide="ignore", invalid="ignore"):
            return numpy.array([
                numpy.log1p(column / self._force(rows, {**values})) if name == "load" else numpy.log(column)
                for name, column in values.items()
            ])  # fmt: skip

    def _force(self, rows: Rows, values: dict[str, Any]) -> Any:
        """Return the pull-off force; the smallest load that is scanned where there is none."""
        problem = self.problem.rows(rows) if self.problem.scene.arrays else self.problem
        others = {name: taken(name, x) for name, x in values.items() if name != "load"}
        force = problem.with_values({**others, "load": 0.0}).numbers("pull_off_force")
        return force.get("pull_off_force", SIZES["load"][0])

    def quantities(self, rows: Rows, places: Any) -> Any:
        """Return the measured quantities, a row for each, nan where there is no result."""
        return outcomes(self.problem, rows, self.values(rows, places))

    def residuals(self, rows: Rows, quantities: Any) -> Any:
        """Return by how much quantities are above their measured values."""
        scales, levels = self.scales[:, rows], self.levels[:, rows]
        return numpy.arcsinh(quantities / scales) - numpy.arcsinh(levels / scales)

    def slopes(self, rows: Rows, places: Any) -> tuple[Any, Any]:
        """Return the residuals at places, and a matrix of their derivatives for each: by quantity and unknown."""
        five = numpy.tile(rows, 5)
        steps = STEP * numpy.repeat([[0, -1, 1, 0, 0], [0, 0, 0, -1, 1]], len(rows), axis=1)
        residuals = self.residuals(five, self.quantities(five, numpy.tile(places, 5) + steps)).reshape(2, 5, -1)
        middle = residuals[:, 0]
        by_unknown = [slopes((-STEP, 0.0, STEP), (residuals[:, low], middle, residuals[:, low + 1])) for low in (1, 3)]
        return middle, numpy.array(by_unknown).T

    def separation(self, rows: Rows, places: Any) -> tuple[Any, Any]:
        """Return the condition number, and the growth of errors by unknown."""
        _, matrices = self.slopes(rows, places)
        inverse = numpy.linalg.pinv(numpy.nan_to_num(matrices), rcond=0.1 / MAX_CONDITION)
        ends = [
            [self.values(rows, places + sign * shift) for sign in (-STEP, STEP)] for shift in numpy.eye(2)[:, :, None]
        ]
        values = self.values(rows, places)
        changes = numpy.array([[high[name] - low[name] for low, high in ends] for name in values]) / (2 * STEP)
        growths = numpy.linalg.norm(numpy.moveaxis(changes, -1, 0) @ inverse, axis=2).T
        with numpy.errstate(divide="ignore", invalid="ignore"):
            return _conditions(matrices), growths / abs(numpy.array([*values.values()]))

    # --- Newton's method ---

    def improved(self, rows: Rows, start: Any) -> tuple[Any, Any]:
        """Return the places to which Newton's method leads from others, and how far the quantities are off there."""
        best, steps = numpy.array(start), numpy.zeros_like(start)
        distance, back = numpy.full(len(rows), inf), numpy.zeros(len(rows), dtype=int)
        active = numpy.arange(len(rows))
        for _ in range(_ROUNDS):
            places = best[:, active] + steps[:, active]
            residuals, matrices = self.slopes(rows[active], places)
            size = numpy.hypot(*residuals)
            is_nearer = size < distance[active]
            nearer = active[is_nearer]
            best[:, nearer], distance[nearer] = places[:, is_nearer], size[is_nearer]
            steps[:, active] = numpy.where(is_nearer, _newton_step(residuals, matrices), steps[:, active] / 2)
            back[active] = numpy.where(is_nearer, 0, back[active] + 1)
            most = numpy.where(distance[active] < _NEAR / 1e3, 1, _STEPS_BACK)
            active = active[(back[active] < most) & steps[:, active].any(axis=0)]
            if not active.size:
                break
        if self.load is not None:
            best[self.load, abs(best[self.load]) <= _SAME] = 0.0  # no load
        return best, distance

    def is_pair(self, rows: Rows, places: Any, distance: Any) -> Any:
        """Return whether places are solutions, with unknowns among the sizes that are looked for, but for rounding."""
        inside = distance <= _NEAR
        for name, values in self.values(rows, places).items():
            least, most = SIZES[name]
            inside &= ((values >= least * (1 - _SAME)) | (name == "load")) & (values <= most * (1 + _SAME))
        return inside

    def followed(self, near: Values) -> tuple[Solution, list[int]]:
        """Return the solutions to which Newton's method leads from values, and the rows in which it leads to none."""
        rows = numpy.arange(self.size)
        start = self.places(rows, near)
        places, distance = self.improved(rows, start)
        solution = self._solution(rows, places)
        is_lost = ~(self.is_pair(rows, places, distance) & (solution.condition <= MAX_CONDITION))
        for column in solution.values.values():
            column[is_lost] = numpy.nan
        return solution, numpy.flatnonzero(is_lost & numpy.isfinite(start).all(axis=0)).tolist()

    def _solution(self, rows: Rows, places: Any) -> Solution:
        condition, growths = self.separation(rows, places)
        by_unknown = dict(zip(self.problem.unknowns, growths, strict=True))
        return Solution(self.problem, self.values(rows, places), condition, by_unknown, {})

    # --- The search, in one row ---

    @cached_property
    def _mesh(self) -> Any:
        """The places of the grid."""
        axes = []
        for name in self.problem.unknowns:
            low, high = _OF_LOAD if name == "load" else map(log, SIZES[name])
            axes.append(numpy.linspace(low, high, round((high - low) / log(10) * PER_DECADE) + 1))
        return numpy.array(numpy.meshgrid(*axes, indexing="ij"))

    @cached_property
    def _on_mesh(self) -> Any:
        """The quantities at the places of the grid."""
        places = self._mesh.reshape(2, -1)
        return self.quantities(_zeros(places), places).reshape(self._mesh.shape)

    def solution(self) -> Solution:
        """Return the one pair, or the reason why there is none."""
        if (error := self._unseparated()) is not None:
            return self._failed(error)
        starts = self._in_cells()
        places, distance = self.improved(_zeros(starts), starts)
        known = numpy.flatnonzero(self.is_pair(_zeros(places), places, distance))
        if not known.size:
            return self._failed(self._failure())
        places = places[:, known[numpy.argsort(distance[known])]]
        pairs = self._solution(_zeros(places), places)
        worst = pairs.condition.argmax()  # nan counts as the largest
        if not pairs.condition[worst] <= MAX_CONDITION:
            remark = self._left_open(places[:, worst])
            return self._failed(Unseparated(self.problem, remark, float(pairs.condition[worst])))
        distinct = _distinct(places, pairs.condition * (_ERROR + 2 * numpy.sort(distance[known])))
        if len(distinct) > 1:
            rows = sorted(numpy.transpose([*pairs.values.values()])[distinct].tolist())
            several = [dict(zip(pairs.values, row, strict=True)) for row in rows]
            return self._failed(SeveralSolutions(self.problem, several))
        return self._solution(_zeros(places[:, :1]), places[:, :1])

    def _failed(self, error: JkrollError) -> Solution:
        """Return the solution of a row without one."""
        nothing = dict.fromkeys(self.problem.unknowns, numpy.nan)
        return Solution(self.problem, nothing, numpy.nan, nothing, {0: error})

    def _unseparated(self) -> Unseparated | None:
        """Return the error of two quantities that change alike wherever they have values; None where they do not."""
        sample = self._mesh[:, ::_SAMPLED, ::_SAMPLED].reshape(2, -1)
        _, matrices = self.slopes(_zeros(sample), sample)
        known = numpy.flatnonzero(numpy.isfinite(matrices).all(axis=(1, 2)))
        if not known.size or (_conditions(matrices[known]) <= MAX_CONDITION / 10).any():
            return None
        return Unseparated(self.problem, self._left_open(sample[:, known[known.size // 2]]))

    def _in_cells(self) -> Any:
        """Return places in the cells that both measured values may cross: the centre, and one towards each corner."""
        quantities = self._on_mesh.reshape(2, -1)
        residuals = self.residuals(_zeros(quantities), quantities).reshape(self._mesh.shape)
        before, after = slice(None, -1), slice(1, None)
        corners = numpy.array([residuals[:, one, other] for one in (before, after) for other in (before, after)])
        low, high = numpy.fmin.reduce(corners), numpy.fmax.reduce(corners)
        margin = _MARGIN * (high - low)
        may_cross = (low - margin <= 0) & (high + margin >= 0) | numpy.isnan(corners).any(axis=0) & numpy.isfinite(low)
        cells = may_cross.all(axis=0)
        first, last = self._mesh[:, :-1, :-1][:, cells], self._mesh[:, 1:, 1:][:, cells]
        parts = [(0.5, 0.5), *((i, j) for i in (0.2, 0.8) for j in (0.2, 0.8))]
        return numpy.concatenate([first + numpy.reshape(part, (2, 1)) * (last - first) for part in parts], axis=1)

    # --- Why there is none ---

    def _failure(self) -> JkrollError:
        """Return the reason why no pair gives both measured values."""
        problem, levels = self.problem, self.problem.levels
        if not numpy.isfinite(self._on_mesh.sum(axis=0)).any():
            return problem.failure()
        scene = problem.filled()
        first, second = sorted(levels, key=lambda name: len({*problem.unknowns}.intersection(scene.inputs_of(name))))
        ranges = [(name, "it", heights) for name, heights in zip(levels, self._on_mesh, strict=True)]
        ranges.append((second, f"where {equal({first: levels[first]})}, {second}", self._along(first, second)))
        sizes = f"for {sizes_in_words(problem.unknowns)}"
        for name, subject, heights in ranges:
            low, high = float(numpy.nanmin(heights, initial=inf)), float(numpy.nanmax(heights, initial=-inf))
            if not low <= levels[name] <= high and low <= high:
                given = levels if subject != "it" else {name: levels[name]}
                lies = f"{subject} lies between {amount(name, low)} and {amount(name, high)}"
                return NoSolution(problem, f"no pair of values gives {equal(given)}; {lies} {sizes}", (low, high))
        return NoSolution(problem, f"no pair of values gives {equal(levels)} {sizes}")

    def _along(self, first: str, second: str) -> Any:
        """Return a quantity at values of the unknowns at which the other one has its measured value."""
        depends = self.problem.filled().inputs_of(first)
        sought, other = sorted(self.problem.unknowns, key=lambda name: name not in depends)
        places = grid(other, SIZES[other])
        problem = Problem((sought,), {first: self.problem.levels[first]}, self.problem.with_values({other: places}))
        scan = Scan(problem, len(places), SIZES[sought])
        rows, roots = scan.points.crossings(scan.levels, scan.function)
        heights = outcomes(self.problem, rows, {sought: roots, other: places[rows]})
        return heights[[*self.problem.measured].index(second)]

    def _left_open(self, place: Any) -> str:
        """Return the direction in which both quantities stay as they are, to the first order."""
        matrix = self.slopes(numpy.zeros(1, dtype=int), place[:, None])[1][0]
        steepest = max(matrix, key=lambda slope: float(numpy.hypot(*slope)))
        (one, other), (second, first) = self.problem.unknowns, steepest.tolist()
        for name, small, large in ((other, second, first), (one, first, second)):
            if abs(small) <= _LEFT_OPEN * abs(large):
                return f"they leave {NOMENCLATURE[name].symbol} open"
        power = f"{NOMENCLATURE[other].symbol}^{-first / second:.3g}"
        return f"both stay as they are along {NOMENCLATURE[one].symbol} ∝ {power}"


def _zeros(places: Any) -> Rows:
    """Return the row of a problem that has one, for each place."""
    return numpy.zeros(places.shape[-1], dtype=int)


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
