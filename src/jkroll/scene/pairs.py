"""Two unknowns from two quantities: a grid of both, and Newton's method from each cell that both measured values may cross."""

from math import inf
from typing import Any

import numpy

from ..errors import JkrollError
from ..quantities.formatting import amount
from ..quantities.nomenclature import NOMENCLATURE
from ..text import listed
from .inverse import (
    MAX_CONDITION,
    SIZES,
    NoSolution,
    Problem,
    SeveralSolutions,
    equal,
    sizes_in_words,
    unseparated,
    unsolved,
)
from .scans import NEAR_END, STEP, Rows, bisected, grid, outcomes, slopes, taken

_ROUNDS = 150  # of Newton's method
_STEPS_BACK = 30  # halvings of a step that leads further away, after which it has ended
_LONGEST = 1.0  # of a step, in logarithms
NEAR = 1e-9  # in logarithms of the measured values: a pair that is as near as this is a solution
_SAME = 1e-9  # relative difference of two pairs that were found twice
_ERROR = 1e-13  # of the quantities, where rounding ends
_LINEAR = 1e-6  # part of a measured value below which a quantity counts as it is, above by its logarithm
_MARGIN = 0.5  # of what a quantity changes in a cell, beyond its corners
_LEFT_OPEN = 1e-4  # an exponent as small as this is none


class Newton:
    """Newton's method for two unknowns from many places side by side.

    Unknowns and quantities count in logarithms. A load counts in parts of its size, or of the pull-off force where that
    is larger; a quantity counts as it is where it is next to zero. Arrays of values have a row for each unknown.
    """

    def __init__(self, problem: Problem, size: int, only: int | None = None) -> None:
        """`only`: the number of a quantity, if the other one may have any value."""
        self.problem = problem
        self.axis_of_load = problem.unknowns.index("load") if "load" in problem.unknowns else None
        self.counts = numpy.array([[only in (None, number)] for number in (0, 1)], dtype=float)
        self.levels = numpy.array([numpy.broadcast_to(level, size) for level in problem.levels.values()], dtype=float)
        self.scales = _LINEAR * abs(self.levels)
        if not self.scales.all():
            self.scales = numpy.where(self.scales == 0, _LINEAR * self._usual()[:, None], self.scales)

    def _usual(self) -> Any:
        """Return usual sizes of the quantities, of which one was measured to be 0."""
        problem = self.problem.rows(0) if self.problem.of_arrays else self.problem
        mesh = numpy.reshape(numpy.meshgrid(*map(grid, problem.unknowns)), (2, -1))
        found = outcomes(problem, *_at(problem, mesh))
        return numpy.array([numpy.nanmedian(abs(values)) for values in found.values()])

    def residuals(self, rows: Rows, values: Any) -> Any:
        """Return by how much the quantities are above their measured values, a row for each, nan where there is no result."""
        found = outcomes(self.problem, rows, dict(zip(self.problem.unknowns, values, strict=True)))
        scales, levels = self.scales[:, rows], self.levels[:, rows]
        residuals = numpy.arcsinh(numpy.array([*found.values()]) / scales) - numpy.arcsinh(levels / scales)
        return self.counts * residuals

    def _force(self, rows: Rows, values: Any) -> Any:
        """Return the pull-off force, nan where there is none."""
        problem = self.problem.rows(rows) if self.problem.of_arrays else self.problem
        scene = problem.with_values({name: taken(name, x) for name, x in zip(problem.unknowns, values, strict=True)})
        return numpy.broadcast_to(scene.numbers("pull_off_force").get("pull_off_force", numpy.nan), rows.shape)

    def units(self, rows: Rows, values: Any) -> Any:
        """Return what counts as a change of the unknowns by one: themselves, and of a load the pull-off force if that is larger."""
        units = numpy.array(values)
        if self.axis_of_load is not None:
            sizes = numpy.fmax(abs(units[self.axis_of_load]), self._force(rows, values))
            units[self.axis_of_load] = numpy.fmax(sizes, SIZES["load"][0])
        return units

    def moved(self, rows: Rows, values: Any, steps: Any) -> Any:
        """Return other values that are some steps away: of a load, in the logarithm of its distance from pull-off over P_c."""
        moved = values * numpy.exp(steps)
        if (axis := self.axis_of_load) is not None:
            before, after = self._force(rows, values), self._force(rows, moved)
            margin = 1 + values[axis] / before
            of_size = values[axis] + numpy.fmax(abs(values[axis]), SIZES["load"][0]) * steps[axis]
            with_force = after * (margin * numpy.exp(steps[axis]) - 1)
            moved[axis] = numpy.where(numpy.isfinite(with_force) & (margin > 0), with_force, of_size)
        return moved

    def at(self, rows: Rows, values: Any, units: Any = None) -> tuple[Any, Any]:
        """Return the residuals, and their derivatives by quantity, unknown and place: in steps of `moved`, or in units."""
        steps = STEP * numpy.repeat([[0, -1, 1, 0, 0], [0, 0, 0, -1, 1]], len(rows), axis=1)
        five, every = numpy.tile(rows, 5), numpy.tile(values, 5)
        every = self.moved(five, every, steps) if units is None else every + numpy.tile(units, 5) * steps
        residuals = self.residuals(five, every).reshape(2, 5, -1)
        sides = [
            slopes((-STEP, 0.0, STEP), (residuals[:, low], residuals[:, 0], residuals[:, low + 1])) for low in (1, 3)
        ]
        return residuals[:, 0], numpy.stack(sides, axis=1)

    def improved(self, rows: Rows, start: Any) -> tuple[Any, Any]:
        """Return the values to which Newton's method leads from others, and how far the quantities are off there."""
        best, steps = numpy.array(start), numpy.zeros_like(start)
        distance, back = numpy.full(len(rows), inf), numpy.zeros(len(rows), dtype=int)
        active = numpy.arange(len(rows))
        for _ in range(_ROUNDS):
            values = self.moved(rows[active], best[:, active], steps[:, active])
            residuals, derivatives = self.at(rows[active], values)
            size = numpy.hypot(*residuals)
            is_nearer = size < distance[active]
            nearer = active[is_nearer]
            best[:, nearer], distance[nearer] = values[:, is_nearer], size[is_nearer]
            steps[:, active] = numpy.where(is_nearer, _newton_step(residuals, derivatives), steps[:, active] / 2)
            back[active] = numpy.where(is_nearer, 0, back[active] + 1)
            most = numpy.where(distance[active] < NEAR / 1e3, 1, _STEPS_BACK)
            active = active[(back[active] < most) & steps[:, active].any(axis=0)]
            if not active.size:
                break
        return best, distance

    def is_scanned(self, values: Any) -> Any:
        """Return whether values lie among those that are looked for, but for rounding."""
        spans = [SIZES[name] if name != "load" else (-inf, inf) for name in self.problem.unknowns]
        inside = [
            (own >= low * (1 - _SAME)) & (own <= high * (1 + _SAME))
            for own, (low, high) in zip(values, spans, strict=True)
        ]
        return numpy.logical_and(*inside)

    def separation(self, rows: Rows, values: Any) -> tuple[Any, Any, Any]:
        """Return the condition number, the growth of errors by unknown, and the derivatives."""
        units = self.units(rows, values)
        _, slopes = self.at(rows, values, units)
        is_zero = self.levels[:, rows] == 0
        slopes = slopes / numpy.where(is_zero, abs(slopes).max(axis=1), 1.0)[:, None]
        ((a, b), (c, d)) = slopes
        determinant, squares = abs(a * d - b * c), (slopes**2).sum(axis=(0, 1))
        with numpy.errstate(divide="ignore", invalid="ignore"):
            largest = (squares + numpy.sqrt(numpy.maximum(squares**2 - 4 * determinant**2, 0.0))) / 2
            condition = numpy.where(determinant > 0, largest / determinant, inf)
            growths = numpy.array([numpy.hypot(b, d), numpy.hypot(a, c)]) / determinant * abs(units / values)
        return condition, growths, slopes


def _newton_step(residuals: Any, slopes: Any) -> Any:
    """Return the step to where both residuals are 0, of a limited length; the shortest one where they change alike."""
    ((a, b), (c, d)), (first, second) = slopes, residuals
    determinant, squares = a * d - b * c, (slopes**2).sum(axis=(0, 1))
    full = numpy.array([b * second - d * first, c * first - a * second])
    shortest = -numpy.array([a * first + c * second, b * first + d * second])
    is_singular = abs(determinant) <= squares / MAX_CONDITION**1.25
    with numpy.errstate(divide="ignore", invalid="ignore"):
        steps = numpy.where(is_singular, shortest / squares, full / determinant)
        steps = steps * numpy.minimum(1.0, _LONGEST / numpy.hypot(*steps))
    return numpy.where(numpy.isfinite(steps), steps, 0.0)


def _at(problem: Problem, values: Any) -> tuple[Rows, dict[str, Any]]:
    """Return the row of a problem that has one, for each place, and the values of the unknowns there by name."""
    return numpy.zeros(values.shape[1], dtype=int), dict(zip(problem.unknowns, values, strict=True))


def _corners(values: Any) -> list[Any]:
    """Return arrays over a grid at the four corners of each cell."""
    before, after = slice(None, -1), slice(1, None)
    return [values[:, one, other] for one in (before, after) for other in (before, after)]


class Pairs:
    """The search for the pairs of a row, on a grid of both unknowns."""

    def __init__(self, problem: Problem) -> None:
        self.problem, self.newton = problem, Newton(problem, 1)
        self.axes = [grid(name) for name in problem.unknowns]
        self.mesh = numpy.array(numpy.meshgrid(*self.axes, indexing="ij"))
        self.residuals = self.off(self.mesh.reshape(2, -1)).reshape(self.mesh.shape)

    def off(self, values: Any) -> Any:
        """Return the residuals at values of the unknowns."""
        return self.newton.residuals(_at(self.problem, values)[0], values)

    def solve(self) -> tuple[Any, float, Any]:
        """Return the one pair, its condition and its growths. Raises the reason why there is none."""
        starts = numpy.concatenate([self._in_cells(), *(self._at_ends(axis) for axis in (0, 1))], axis=1)
        rows = numpy.zeros(starts.shape[1], dtype=int)
        values, distance = self.newton.improved(rows, starts)
        values[abs(values) <= _SAME * self.newton.units(rows, values)] = 0.0  # a load, which is then none
        is_found = (distance <= NEAR) & self.newton.is_scanned(values)
        values, order = values[:, is_found], numpy.argsort(distance[is_found])
        values = values[:, order]
        if not values.size:
            raise self._failure()
        condition, growths, _ = self.newton.separation(rows[: len(order)], values)
        worst = condition.argmax()  # nan counts as the largest
        if not condition[worst] <= MAX_CONDITION:
            raise self._unseparated(values[:, worst], float(condition[worst]))
        distinct = self._distinct(values, condition * (_ERROR + 2 * distance[is_found][order]))
        if len(distinct) > 1:
            raise self._several(values[:, distinct])
        return values[:, 0], condition[0], growths[:, 0]

    def _in_cells(self) -> Any:
        """Return places in the cells of the grid that both measured values may cross: the centre, and one towards each corner."""
        corners = _corners(self.residuals)
        low, high = numpy.min(corners, axis=0), numpy.max(corners, axis=0)
        margin = _MARGIN * (high - low)
        cells = numpy.argwhere(((low - margin <= 0) & (high + margin >= 0)).all(axis=0))
        parts = [(0.5, 0.5), *((i, j) for i in (0.2, 0.8) for j in (0.2, 0.8))]
        ends = [(axis[own], axis[own + 1]) for axis, own in zip(self.axes, cells.T, strict=True)]
        places = [[low + part * (high - low) for (low, high), part in zip(ends, both, strict=True)] for both in parts]
        return numpy.concatenate(places, axis=1)

    def _at_ends(self, axis: int) -> Any:
        """Return places on the lines of the grid along one unknown from values beside gaps to the last ones."""
        known = numpy.isfinite(self.residuals.sum(axis=0))
        lines, mesh = numpy.moveaxis(known, axis, 0), numpy.moveaxis(self.mesh, axis + 1, 1)
        left = lines[:-1] != lines[1:]
        first = lines[:-1][left]
        before, after = mesh[:, :-1][:, left], mesh[:, 1:][:, left]
        inside, outside = numpy.where(first, before, after), numpy.where(first, after, before)

        def at(x: Any, pairs: Any) -> Any:
            values = inside[:, pairs].copy()
            values[axis] = x
            return values

        every = numpy.arange(inside.shape[1])
        end, _ = bisected(
            inside[axis], outside[axis], lambda pairs, x: numpy.isfinite(self.off(at(x, pairs)).sum(axis=0))
        )
        parts = [at(end + part * (inside[axis] - end), every) for part in (*NEAR_END, 1.0)]
        return numpy.concatenate(parts, axis=1)

    def _distinct(self, values: Any, errors: Any) -> list[int]:
        """Return the numbers of pairs that differ by more than their errors."""
        units = self.newton.units(numpy.zeros(values.shape[1], dtype=int), values)
        distinct: list[int] = []
        left = numpy.arange(values.shape[1])
        while left.size:
            number = left[0]
            distinct.append(int(number))
            off = abs(values[:, left] - values[:, [number]]) / abs(units[:, [number]])
            left = left[(off > _SAME + errors[number] + errors[left]).any(axis=0)]
        return sorted(distinct, key=lambda number: values[:, number].tolist())

    def _several(self, values: Any) -> SeveralSolutions:
        """Return the error of several pairs."""
        pairs = [dict(zip(self.problem.unknowns, pair, strict=True)) for pair in values.T.tolist()]
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
        if not numpy.isfinite(self.residuals.sum(axis=0)).any():
            return problem.failure()
        places = numpy.concatenate([self.mesh.reshape(2, -1), *(self._at_ends(axis) for axis in (0, 1))], axis=1)
        forward = outcomes(problem, *_at(problem, places))
        for (name, level), values in zip(levels.items(), forward.values(), strict=True):
            low, high = float(numpy.nanmin(values)), float(numpy.nanmax(values))
            if not low <= level <= high:
                return unsolved(problem.unknowns, {name: level}, name, (low, high))
        _, second, places, heights = self._curve()
        if not heights.size:
            sizes = sizes_in_words(problem.unknowns)
            return NoSolution(problem.unknowns, f"no pair of values gives {equal(levels)} for {sizes}")
        if self._is_flat(heights):
            return self._unseparated(places[:, len(heights) // 2], inf)
        return unsolved(problem.unknowns, levels, second, (float(heights.min()), float(heights.max())))

    def _is_flat(self, heights: Any) -> bool:
        """Return whether values differ so little that the condition number is too large."""
        return bool(numpy.ptp(heights) <= abs(heights).max() / MAX_CONDITION)

    def _curve(self) -> tuple[str, str, Any, Any]:
        """Return a quantity, the other, places at which the first has its measured value, and the other there.

        The first is that which depends on one unknown alone, if one does. From the grid beside these places Newton's method
        leads to them.
        """
        scene, names = self.problem.filled(), [*self.problem.measured]
        names.sort(key=lambda name: len({*self.problem.unknowns}.intersection(scene.inputs_of(name))))
        number = [*self.problem.measured].index(names[0])
        corners = numpy.array([corner[number] for corner in _corners(self.residuals)])
        cells = (corners.min(axis=0) < 0) & (corners.max(axis=0) > 0)
        starts = numpy.concatenate([corner[:, cells] for corner in _corners(self.mesh)], axis=1)
        newton = Newton(self.problem, 1, number)
        places, distance = newton.improved(_at(self.problem, starts)[0], starts)
        places = places[:, (distance <= NEAR) & newton.is_scanned(places)]
        return names[0], names[1], places, outcomes(self.problem, *_at(self.problem, places))[names[1]]

    def _unseparated(self, values: Any, condition: float) -> JkrollError:
        """Return the error of a place at which both quantities change alike, with the direction in which they stay as they are."""
        first, second, _, heights = self._curve()
        remark = self._left_open(values)
        if heights.size and self._is_flat(heights):
            held = equal({second: float(heights[0])})
            remark, condition = f"{held} wherever {equal({first: self._levels[first]})}; {remark}", inf
        return unseparated(self.problem.unknowns, self.problem.measured, condition, remark)

    def _left_open(self, values: Any) -> str:
        """Return the direction in which both quantities stay as they are, to the first order."""
        row = numpy.zeros(1, dtype=int)
        units = self.newton.units(row, values[:, None])
        slopes = self.newton.separation(row, values[:, None])[2][:, :, 0]
        steepest = max(slopes, key=lambda own: float(numpy.hypot(*own)))
        parts = numpy.where(values != 0, units[:, 0] / numpy.where(values != 0, abs(values), 1.0), 1.0)
        changes = dict(zip(self.problem.unknowns, (parts * (-steepest[1], steepest[0])).tolist(), strict=True))
        (one, change), (other, beside) = changes.items()
        for name, small, large in ((other, change, beside), (one, beside, change)):
            if abs(small) <= _LEFT_OPEN * abs(large):
                return f"they leave {NOMENCLATURE[name].symbol} open"
        return f"both stay as they are along {NOMENCLATURE[one].symbol} ∝ {NOMENCLATURE[other].symbol}^{change / beside:.3g}"
