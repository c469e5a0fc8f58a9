"""Two unknowns from two quantities: a grid, and Newton's method from each cell that both measured values may cross."""

from functools import cached_property
from math import inf, log
from typing import Any

import numpy

from ..errors import JkrollError
from ..quantities.formatting import amount
from ..quantities.nomenclature import NOMENCLATURE
from ..text import listed
from .inverse import (
    MAX_CONDITION,
    PER_DECADE,
    SIZES,
    NoSolution,
    Problem,
    SeveralSolutions,
    Solution,
    Values,
    equal,
    sizes_in_words,
    unseparated,
    unsolved,
)
from .scans import STEP, Rows, Scan, grid, outcomes, slopes, taken

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


class Pairs:
    """A problem of two unknowns, in one row or many, in the coordinates in which they are sought.

    An unknown counts by its logarithm, and a load by ln(1 + P/P_c), which has no end at pull-off. A quantity counts by
    its logarithm, too, and as it is where it is next to zero. Places are arrays with a row for each unknown.
    """

    def __init__(self, problem: Problem, size: int = 1) -> None:
        self.problem = problem
        self.load = problem.unknowns.index("load") if "load" in problem.unknowns else None
        self.levels = numpy.array([numpy.broadcast_to(level, size) for level in problem.levels.values()], dtype=float)
        self.scales = _LINEAR * abs(self.levels)
        if not self.scales.all():
            usual = numpy.nanmedian(abs(self._on_mesh), axis=(1, 2))
            self.scales = numpy.where(self.scales == 0, _LINEAR * usual[:, None], self.scales)

    # --- Coordinates ---

    def values(self, rows: Rows, places: Any) -> dict[str, Any]:
        """Return the values of the unknowns at places."""
        values = dict(zip(self.problem.unknowns, numpy.exp(places), strict=True))
        if self.load is not None:
            values["load"] = self._force(rows, values) * numpy.expm1(places[self.load])
        return values

    def places(self, rows: Rows, values: Values) -> Any:
        """Return the places at which the unknowns have some values in all rows."""
        columns = {name: numpy.full(len(rows), value) for name, value in values.items()}
        with numpy.errstate(divide="ignore", invalid="ignore"):
            return numpy.array([
                numpy.log1p(column / self._force(rows, columns)) if name == "load" else numpy.log(column)
                for name, column in columns.items()
            ])  # fmt: skip

    def _force(self, rows: Rows, values: dict[str, Any]) -> Any:
        """Return the pull-off force; the smallest load that is scanned where there is none."""
        problem = self.problem.rows(rows) if self.problem.of_arrays else self.problem
        others = {name: taken(name, x) for name, x in values.items() if name != "load"}
        force = problem.with_values({**others, "load": 0.0}).numbers("pull_off_force")
        return force.get("pull_off_force", SIZES["load"][0])

    def quantities(self, rows: Rows, places: Any) -> Any:
        """Return the measured quantities, a row for each, nan where there is no result."""
        return numpy.array([*outcomes(self.problem, rows, self.values(rows, places)).values()])

    def residuals(self, rows: Rows, quantities: Any) -> Any:
        """Return by how much quantities are above their measured values."""
        scales, levels = self.scales[:, rows], self.levels[:, rows]
        return numpy.arcsinh(quantities / scales) - numpy.arcsinh(levels / scales)

    def slopes(self, rows: Rows, places: Any) -> tuple[Any, Any]:
        """Return the residuals at places, and their derivatives by quantity, unknown and place."""
        five = numpy.tile(rows, 5)
        steps = STEP * numpy.repeat([[0, -1, 1, 0, 0], [0, 0, 0, -1, 1]], len(rows), axis=1)
        residuals = self.residuals(five, self.quantities(five, numpy.tile(places, 5) + steps)).reshape(2, 5, -1)
        middle = residuals[:, 0]
        by_unknown = [slopes((-STEP, 0.0, STEP), (residuals[:, low], middle, residuals[:, low + 1])) for low in (1, 3)]
        return middle, numpy.stack(by_unknown, axis=1)

    def separation(self, rows: Rows, places: Any) -> tuple[Any, Any, Any]:
        """Return the condition number, the growth of errors by unknown, and the derivatives."""
        _, slopes = self.slopes(rows, places)
        is_zero = self.levels[:, rows] == 0
        slopes = slopes / numpy.where(is_zero, abs(slopes).max(axis=1), 1.0)[:, None]
        ((a, b), (c, d)) = slopes
        determinant, squares = a * d - b * c, (slopes**2).sum(axis=(0, 1))
        with numpy.errstate(divide="ignore", invalid="ignore"):
            largest = (squares + numpy.sqrt(numpy.maximum(squares**2 - 4 * determinant**2, 0.0))) / 2
            condition = numpy.where(determinant != 0, largest / abs(determinant), inf)
            inverse = numpy.array([[d, -b], [-c, a]]) / determinant
            growths = numpy.hypot(*numpy.swapaxes(inverse, 0, 1))
            if self.load is not None:
                growths[self.load] = self._growth_of_load(rows, places, inverse)
        return condition, growths, slopes

    def _growth_of_load(self, rows: Rows, places: Any, inverse: Any) -> Any:
        """Return the growth of errors of the load, which depends on the other unknown by the pull-off force, too."""
        steps = STEP * numpy.eye(2)[:, :, None]
        changes = [
            self.values(rows, places + step)["load"] - self.values(rows, places - step)["load"] for step in steps
        ]
        by_quantity = (numpy.array(changes)[:, None] * inverse).sum(axis=0) / (2 * STEP)
        return numpy.hypot(*by_quantity) / abs(self.values(rows, places)["load"])

    # --- Newton's method ---

    def improved(self, rows: Rows, start: Any) -> tuple[Any, Any]:
        """Return the places to which Newton's method leads from others, and how far the quantities are off there."""
        best, steps = numpy.array(start), numpy.zeros_like(start)
        distance, back = numpy.full(len(rows), inf), numpy.zeros(len(rows), dtype=int)
        active = numpy.arange(len(rows))
        for _ in range(_ROUNDS):
            places = best[:, active] + steps[:, active]
            residuals, derivatives = self.slopes(rows[active], places)
            size = numpy.hypot(*residuals)
            is_nearer = size < distance[active]
            nearer = active[is_nearer]
            best[:, nearer], distance[nearer] = places[:, is_nearer], size[is_nearer]
            steps[:, active] = numpy.where(is_nearer, _newton_step(residuals, derivatives), steps[:, active] / 2)
            back[active] = numpy.where(is_nearer, 0, back[active] + 1)
            most = numpy.where(distance[active] < _NEAR / 1e3, 1, _STEPS_BACK)
            active = active[(back[active] < most) & steps[:, active].any(axis=0)]
            if not active.size:
                break
        if self.load is not None:
            best[self.load, abs(best[self.load]) <= _SAME] = 0.0  # no load
        return best, distance

    def is_scanned(self, rows: Rows, places: Any) -> Any:
        """Return whether the unknowns lie among the sizes that are looked for, but for rounding."""
        inside = numpy.ones(len(rows), dtype=bool)
        for name, values in self.values(rows, places).items():
            least, most = SIZES[name]
            inside &= (values >= least * (1 - _SAME)) | (name == "load")
            inside &= values <= most * (1 + _SAME)
        return inside

    def followed(self, near: Values, size: int) -> tuple[Solution, Any]:
        """Return the solutions to which Newton's method leads from values, and the rows in which it leads to none."""
        rows = numpy.arange(size)
        start = self.places(rows, near)
        places, distance = self.improved(rows, start)
        condition, growths, _ = self.separation(rows, places)
        is_pair = (distance <= _NEAR) & self.is_scanned(rows, places) & (condition <= MAX_CONDITION)
        places[:, ~is_pair] = numpy.nan
        is_lost = ~is_pair & numpy.isfinite(start).all(axis=0)
        return self._solution(rows, places, condition, growths), numpy.flatnonzero(is_lost)

    def _solution(self, rows: Rows, places: Any, condition: Any, growths: Any) -> Solution:
        by_unknown = dict(zip(self.problem.unknowns, growths, strict=True))
        return Solution(self.problem, self.values(rows, places), condition, by_unknown)

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
        """Return the one pair. Raises the reason why there is none."""
        self._check_separated()
        starts = self._in_cells()
        places, distance = self.improved(_zeros(starts), starts)
        is_pair = (distance <= _NEAR) & self.is_scanned(_zeros(places), places)
        order = numpy.flatnonzero(is_pair)[numpy.argsort(distance[is_pair])]
        if not order.size:
            raise self._failure()
        places, rows = places[:, order], _zeros(order)
        condition, growths, _ = self.separation(rows, places)
        worst = condition.argmax()  # nan counts as the largest
        if not condition[worst] <= MAX_CONDITION:
            raise unseparated(self.problem, self._left_open(places[:, worst]), float(condition[worst]))
        distinct = _distinct(places, condition * (_ERROR + 2 * distance[order]))
        if len(distinct) > 1:
            raise self._several(places[:, distinct])
        return self._solution(rows[:1], places[:, :1], condition[:1], growths[:, :1])

    def _check_separated(self) -> None:
        """Raise Unseparated if both quantities change alike wherever they have values."""
        sample = self._mesh[:, ::_SAMPLED, ::_SAMPLED].reshape(2, -1)
        condition, _, slopes = self.separation(_zeros(sample), sample)
        known = numpy.flatnonzero(numpy.isfinite(slopes).all(axis=(0, 1)))
        if known.size and not (condition[known] <= MAX_CONDITION / 10).any():
            raise unseparated(self.problem, self._left_open(sample[:, known[known.size // 2]]))

    def _in_cells(self) -> Any:
        """Return places in the cells that both measured values may cross: the centre, and one towards each corner."""
        quantities = self._on_mesh.reshape(2, -1)
        corners = _corners(self.residuals(_zeros(quantities), quantities).reshape(self._mesh.shape))
        low, high = numpy.fmin.reduce(corners), numpy.fmax.reduce(corners)
        margin = _MARGIN * (high - low)
        may_cross = (low - margin <= 0) & (high + margin >= 0) | numpy.isnan(corners).any(axis=0) & numpy.isfinite(low)
        cells = may_cross.all(axis=0)
        first, last = self._mesh[:, :-1, :-1][:, cells], self._mesh[:, 1:, 1:][:, cells]
        parts = [(0.5, 0.5), *((i, j) for i in (0.2, 0.8) for j in (0.2, 0.8))]
        return numpy.concatenate([first + numpy.reshape(part, (2, 1)) * (last - first) for part in parts], axis=1)

    def _several(self, places: Any) -> SeveralSolutions:
        """Return the error of several pairs."""
        columns = self.values(_zeros(places), places)
        rows = sorted(numpy.transpose([*columns.values()]).tolist())
        pairs = [dict(zip(columns, row, strict=True)) for row in rows]
        texts = [f"({', '.join(amount(*item) for item in pair.items())})" for pair in pairs]
        text = f"the pairs {listed(texts)} {'all' if len(pairs) > 2 else 'both'} give {equal(self._levels)}"
        return SeveralSolutions(self.problem.unknowns, text, pairs)

    @property
    def _levels(self) -> dict[str, float]:
        return {name: float(level) for name, level in self.problem.levels.items()}

    # --- Why there is none ---

    def _failure(self) -> JkrollError:
        """Return the reason why no pair gives both measured values."""
        problem, levels = self.problem, self._levels
        if not numpy.isfinite(self._on_mesh.sum(axis=0)).any():
            return problem.failure()
        for (name, level), values in zip(levels.items(), self._on_mesh, strict=True):
            low, high = float(numpy.nanmin(values)), float(numpy.nanmax(values))
            if not low <= level <= high:
                return unsolved(problem, name, (low, high))
        scene = problem.filled()
        first, second = sorted(levels, key=lambda name: len({*problem.unknowns}.intersection(scene.inputs_of(name))))
        heights = self._along(first, second)
        if heights.size and not heights.min() <= levels[second] <= heights.max():
            return unsolved(problem, second, (float(heights.min()), float(heights.max())), {first: levels[first]})
        sizes = sizes_in_words(problem.unknowns)
        return NoSolution(problem.unknowns, f"no pair of values gives {equal(levels)} for {sizes}")

    def _along(self, first: str, second: str) -> Any:
        """Return a quantity at values of the unknowns at which the other one has its measured value."""
        depends = self.problem.filled().inputs_of(first)
        sought, other = sorted(self.problem.unknowns, key=lambda name: name not in depends)
        places = grid(other)
        scene = self.problem.with_values({other: places})
        solution = Scan(Problem((sought,), {first: self._levels[first]}, scene), len(places)).solution()
        roots = [*enumerate(solution.values[sought].tolist())]
        roots += [
            (row, each[sought]) for row, error in solution.failures.items() for each in getattr(error, "values", ())
        ]
        rows, values = numpy.array(roots).T
        values = {sought: values, other: places[rows.astype(int)]}
        heights = outcomes(self.problem, _zeros(rows), values)[second]
        return heights[numpy.isfinite(heights)]

    def _left_open(self, place: Any) -> str:
        """Return the direction in which both quantities stay as they are, to the first order."""
        slopes = self.separation(numpy.zeros(1, dtype=int), place[:, None])[2][:, :, 0]
        steepest = max(slopes, key=lambda slope: float(numpy.hypot(*slope)))
        (one, other), (second, first) = self.problem.unknowns, steepest.tolist()
        for name, small, large in ((other, second, first), (one, first, second)):
            if abs(small) <= _LEFT_OPEN * abs(large):
                return f"they leave {NOMENCLATURE[name].symbol} open"
        power = f"{NOMENCLATURE[other].symbol}^{-first / second:.3g}"
        return f"both stay as they are along {NOMENCLATURE[one].symbol} ∝ {power}"


def _zeros(places: Any) -> Rows:
    """Return the row of a problem that has one, for each place."""
    return numpy.zeros(places.shape[-1], dtype=int)


def _corners(values: Any) -> Any:
    """Return arrays over a grid at the four corners of each cell."""
    before, after = slice(None, -1), slice(1, None)
    return numpy.array([values[:, one, other] for one in (before, after) for other in (before, after)])


def _newton_step(residuals: Any, slopes: Any) -> Any:
    """Return the step to where both residuals are 0, of a limited length; the shortest one where they change alike."""
    ((a, b), (c, d)), (first, second) = slopes, residuals
    determinant, squares = a * d - b * c, (slopes**2).sum(axis=(0, 1))
    full = numpy.array([b * second - d * first, c * first - a * second])
    shortest = -numpy.array([a * first + c * second, b * first + d * second])
    is_singular = abs(determinant) <= squares / MAX_CONDITION**1.25
    with numpy.errstate(divide="ignore", invalid="ignore"):
        steps = numpy.where(is_singular, shortest / squares, full / determinant)
        steps = steps * numpy.minimum(1.0, 1 / numpy.hypot(*steps))
    return numpy.where(numpy.isfinite(steps), steps, 0.0)


def _distinct(places: Any, errors: Any) -> list[int]:
    """Return the numbers of places that differ by more than their errors."""
    distinct: list[int] = []
    for number in range(places.shape[1]):
        off = abs(places[:, distinct] - places[:, [number]])
        if (off > _SAME + errors[number] + errors[distinct]).any(axis=0).all():
            distinct.append(number)
    return distinct
