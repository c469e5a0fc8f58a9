"""The inverse problem: values of one input or two, the unknowns, at which quantities have their measured values.

One unknown is found by a scan and by halving, two by a grid and Newton's method, in one row or in many.
"""

from collections.abc import Collection, Mapping, Sequence
from functools import cached_property
from math import hypot, inf, nan, prod
from typing import Any, NamedTuple

import numpy
from numpy.lib.stride_tricks import sliding_window_view

from ..errors import BadRequest, JkrollError, NoResult
from ..physics.elementary import NUMBER
from ..quantities.nomenclature import NOMENCLATURE, PROPERTIES, of_sphere
from ..quantities.values import is_uncertain, middle
from .failures import MissingInput
from .inverse import (
    SIZES,
    NoDependence,
    NoSolution,
    SeveralSolutions,
    Undetermined,
    Unseparated,
    already_given,
    inputs_named,
)
from .scene import LEAST, MOST, Scene, broadcast, check_exclusive
from .uncertainty import Source, Sources, sources_of
from .wiring import formula_of

Values = Mapping[str, Any]  # by name; numbers, or an array with a value for each row
Failures = dict[int, JkrollError]  # by row

PER_DECADE = 8  # values of a scan
_AS_SHOWN = 1e-3  # relative difference of a quantity at a solution, or at the digits of one, from its measured value
_STEP = 1e-6  # of a logarithm, in the differences that give a derivative
_ROUNDING = 1e-12  # of a quantity: a change as small as this comes from rounding

# Of scans.
_TOGETHER = 1000  # rows that are scanned at once
_WIDEST = (1e-30, 1e30)  # the sizes that are scanned where no value is found among the usual ones
_HALVINGS = 120  # more than lead from a value of a scan to neighbouring doubles, or to 0
_AHEAD = 1e-8  # relative, the step that tells whether a function rises or falls
_STILL = 1e-13  # of a function, a change over this step that is none
_MANY = 64  # intervals of a row: more of them come from rounding

# Of pairs, in the coordinates in which they are sought.
MAX_CONDITION = 1e8  # beyond which rounding leaves the differences that the condition number is made of too few digits
_LOADS = numpy.linspace(-14.0, 46.0, 209)  # that are scanned: from 1e-6 P_c beyond pull-off to 1e20 P_c
_ROUNDS = 150  # of Newton's method
_LAST_STEP = 1e-14  # a step as small as this ends the search
_NEAR = 1e-9  # in logarithms of the measured values: a pair that is as near as this is a solution
_SAME = 1e-5  # pairs that differ by less are one
_LINEAR = 1e-6  # part of a measured value below which a quantity counts as it is, above by its logarithm
_AT_ZERO = 1e-12  # the same where 0 was measured, in SI units: an approach, of 1 pm
_SAMPLED = 7  # cells of the grid from one to the next at which it is asked whether the quantities separate the unknowns
_TO_GAP = 20  # halvings of the way to where there are no quantities
_LEFT_OPEN = 1e-4  # an exponent as small as this is none


class Solution(NamedTuple):
    """The values of the unknowns of a problem: numbers, or arrays with nan in the rows that have none for a reason."""

    values: Values  # by unknown
    growths: Values  # by unknown, the largest factor by which relative errors of measured values enter it
    condition: Any  # of the logarithms of the measured values as functions of those of the unknowns
    failures: Failures
    places: Any  # of two unknowns, in the coordinates in which they were sought


class Problem:
    """A scene that lacks the unknowns, and the measured values of as many of its quantities.

    Both may have uncertainties, and may be arrays. A value that a material has of an unknown is replaced. Rows and
    error bars take a problem for a scene whose quantities are the unknowns.
    """

    def __init__(
        self, unknowns: Sequence[str], measured: Values, scene: Scene, origin: "Problem | None" = None
    ) -> None:
        """`origin`: a problem from whose solution Newton's method leads to two unknowns in arrays."""
        self.unknowns, self.measured, self.scene, self._origin = tuple(unknowns), measured, scene, origin
        self.levels = {name: middle(value) for name, value in measured.items()}
        levels = {name: level for name, level in self.levels.items() if not isinstance(level, NUMBER)}
        self.shape = broadcast({**scene.arrays, **levels})

    # --- Scenes with values of the unknowns ---

    def names_of(self, unknown: str) -> tuple[str, ...]:
        """Return the names of an unknown in the scene: those of both spheres if one material was named for both."""
        first, second = self.scene.material, self.scene.material2
        is_shared = first is not None and second is not None and first.key == second.key and unknown in PROPERTIES
        twin = of_sphere(2, unknown)
        return (unknown, twin) if is_shared and twin not in self.scene.stated else (unknown,)

    def with_values(self, values: Values) -> Scene:
        """Return the scene with values of unknowns, or arrays of them."""
        return self.scene.replace(**{each: value for name, value in values.items() for each in self.names_of(name)})

    @cached_property
    def filled(self) -> Scene:
        """The scene with placeholders for the unknowns, the largest values."""
        return self.with_values({name: SIZES[name][1] for name in self.unknowns})

    @cached_property
    def solved(self) -> Scene:
        """The scene with the unknowns in it, or placeholders in rows of arrays. Of numbers, raises the failure."""
        solution = self.solution
        if self.shape:
            filled = {name: numpy.nan_to_num(x, nan=SIZES[name][1]) for name, x in solution.values.items()}
            return self.with_values(filled)
        for failure in solution.failures.values():
            raise failure
        return self.with_values(solution.values)

    def is_met(self, values: Mapping[str, float], digits: int) -> bool:
        """Return whether values of the unknowns, of which some digits are typed, give the measured ones as shown."""
        typed = {name: float(f"{value:.{digits}g}") for name, value in values.items()}
        forward = self.with_values(typed).numbers(*self.levels)
        return all(abs(forward.get(name, inf) - level) <= _AS_SHOWN * abs(level) for name, level in self.levels.items())

    def outcomes(self, values: Values) -> Any:
        """Return the measured quantities, a row for each, at arrays of the unknowns; nan where there is no result."""
        scene = self.with_values({name: taken(name, x) for name, x in values.items()})
        quantities = numpy.full((len(self.measured), len(next(iter(values.values())))), nan)
        for quantity, outcome in zip(quantities, scene.evaluate([*self.measured]).values(), strict=True):
            if not isinstance(outcome, JkrollError):
                quantity[:] = outcome
            elif not isinstance(outcome, NoResult):
                raise outcome
        return quantities

    # --- Other problems ---

    def replace(self, **values: Any) -> "Problem":
        """Return the problem with other values of some inputs and measured quantities."""
        measured = {name: values.pop(name, value) for name, value in self.measured.items()}
        return Problem(self.unknowns, measured, self.scene.replace(**values), self)

    def rows(self, rows: Any) -> "Problem":
        """Return the problem of some elements of the arrays, without uncertainties."""
        middles = {name: value.value for name, value in self.scene.uncertain.items()}
        values = {
            name: value if isinstance(value, NUMBER) else numpy.broadcast_to(value, self.shape).ravel()[rows]
            for name, value in {**middles, **self.scene.arrays, **self.levels}.items()
        }
        levels = {name: values.pop(name) for name in self.levels}
        return Problem(self.unknowns, levels, self.scene.replace(**values) if values else self.scene)

    # --- What it rests on ---

    @property
    def is_uncertain(self) -> bool:
        """True if a measured value, or something in the scene, has an uncertainty."""
        return any(map(is_uncertain, self.measured.values())) or self.scene.is_uncertain

    def sources(self) -> Sources:
        """Return the sources of uncertainty that enter the unknowns."""
        measured = [Source((name,), given) for name, given in self.measured.items() if is_uncertain(given)]
        return sources_of(self.scene, self.inputs_used(()), measured)

    def missing(self, _: Sequence[str]) -> list[str]:
        """Return the measured quantities to which the inputs do not lead."""
        return self.filled.missing([*self.measured])

    def inputs_used(self, _: Sequence[str]) -> list[str]:
        """Return the other inputs on which the measured quantities depend."""
        unknowns = {each for name in self.unknowns for each in self.names_of(name)}
        return [name for name in self.filled.inputs_used([*self.measured]) if name not in unknowns]

    def echo(self, used: Collection[str]) -> dict[str, Any]:
        """Return inputs as they were understood, and the measured values."""
        return {**self.filled.echo(used), **self.levels}

    # --- Its solution ---

    def check(self) -> None:
        """Raise the error of a problem that has no solution whatever the measured values are."""
        inputs_named(self.unknowns)
        for name in (*self.unknowns, *self.measured):
            if name in self.scene.stated or (name in self.unknowns and name in self.measured):
                raise already_given(name)
        check_exclusive({*self.unknowns, *self.scene.stated})
        for quantity in self.measured:
            if formula_of(quantity) is None and self.filled.missing([quantity]):
                option = NOMENCLATURE[quantity].option or quantity
                remedy = f"give it as {option}, and ask for {self.unknowns[0]} without infer"
                raise BadRequest(f"{quantity} is an input, and no formula gives it; {remedy}")
            if {*self.unknowns}.isdisjoint(self.filled.inputs_of(quantity)):
                raise NoDependence(self, quantity)

    def failure(self) -> JkrollError:
        """Return the reason why a measured quantity has no value for any values of the unknowns."""
        outcomes = self.filled.evaluate([*self.measured]).values()
        return next(outcome for outcome in outcomes if isinstance(outcome, JkrollError))

    @cached_property
    def solution(self) -> Solution:
        """The solution of each row. Raises the error of a problem that has none in any row."""
        self.check()
        count, rows = len(self.unknowns), prod(self.shape)
        table, places = numpy.full((2 * count + 1, rows), nan), numpy.full((count, rows), nan)
        if count == 1:
            failures = _find_roots(self, table)
        else:
            failures = _find_pairs(self, table, places, self._origin if self.shape else None)
        table[count:] = [[float(f"{number:.6g}") for number in row] for row in table[count:]]  # the rest is rounding
        *columns, condition = table.reshape(2 * count + 1, *self.shape) if self.shape else table[:, 0].tolist()
        values, growths = (dict(zip(self.unknowns, part, strict=True)) for part in (columns[:count], columns[count:]))
        return Solution(values, growths, condition, failures, places)

    def evaluate(self, _: Sequence[str]) -> Values:
        """Return the unknowns; of numbers, the error that says why there are none. Raises an error of the request."""
        try:
            if self.shape or not self.solution.failures:
                return self.solution.values
            error: JkrollError = self.solution.failures[0]
        except (MissingInput, NoResult) as reason:
            error = reason
        return dict.fromkeys(self.unknowns, error)

    def numbers(self, *names: str) -> Values:
        """Return the unknowns if they have values."""
        return {name: value for name, value in self.evaluate(names).items() if not isinstance(value, JkrollError)}


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
    lacking = numpy.arange(table.shape[1])
    for sizes in (SIZES[unknown], _WIDEST):
        for start in range(0, len(lacking), _TOGETHER):
            rows = lacking[start : start + _TOGETHER]
            scan = Scan(problem.rows(rows), sizes)
            table[0, rows] = scan.root
            for row in numpy.flatnonzero(numpy.isnan(scan.root)).tolist():
                error = scan.failure(row)
                if sizes is not _WIDEST or not isinstance(error, NoSolution):
                    failures[int(rows[row])] = error
        lacking = numpy.array([row for row, error in failures.items() if isinstance(error, NoSolution)], dtype=int)
    solved = numpy.flatnonzero(~numpy.isnan(table[0]))
    roots = taken(unknown, table[0, solved])
    steps = numpy.exp(_STEP * numpy.array([[-1], [0], [1]]))
    y = problem.rows(numpy.tile(solved, 3)).outcomes({unknown: (steps * roots).ravel()}).reshape(3, -1)
    with numpy.errstate(divide="ignore", invalid="ignore"):
        condition = abs(y[1] / slopes(y))
    table[:, solved] = roots, condition, condition
    return {row: error for row, error in failures.items() if numpy.isnan(table[0, row])}


class Scan:
    """A search for the values of one unknown between two sizes, in each row of a problem.

    It begins with a grid, and halves each interval at whose ends the measured quantity differs: it has a value at one
    alone, is on other sides of its level, rises at one and falls at the other, or stays at its level at one alone. So
    the ends of gaps and the extremes are found on the way, and what lies between these and the grid.

    `rows` and `roots` are arrays of what was found, in order. Of each row, `root` is the value if it is the only one,
    `varies` says whether the quantity does on the grid, `span` has its least and largest value, and `stretch` the first
    and the last value of the unknown at which it stays at its level, nan if there is none.
    """

    def __init__(self, problem: Problem, sizes: tuple[float, float]) -> None:
        (self.unknown,), (level,) = problem.unknowns, problem.levels.values()
        size = prod(problem.shape)
        self.problem, self.levels = problem, numpy.full(size, level, dtype=float)
        self.span: Any = numpy.full((2, size), nan)
        self.stretch: Any = numpy.full((2, size), nan)
        x = grid(self.unknown, sizes)
        rows = numpy.repeat(numpy.arange(size), len(x))
        points = self._points(rows, numpy.tile(x, size))
        points[2, points[1] == self.levels[rows]] = 0  # of a stretch, too
        hits = [numpy.array([rows, points[0]])[:, points[2] == 0]]
        self.varies = self.span[1] - self.span[0] > _ROUNDING * abs(self.span).max(axis=0)
        rows, points = rows.reshape(size, -1)[:, :-1], points.reshape(len(points), size, -1)
        left, right = points[..., :-1], points[..., 1:]
        for _ in range(_HALVINGS):
            crosses = (numpy.isnan(left[1]) != numpy.isnan(right[1])) | (left[2] * right[2] < 0)
            differs = crosses | (left[3] != right[3]) | (left[4] * right[4] < 0)
            differs &= crosses | (numpy.bincount(rows[differs], minlength=size)[rows] <= _MANY)
            rows, left, right = rows[differs], left[:, differs], right[:, differs]
            middle = (left[0] + right[0]) / 2
            if ((middle == left[0]) | (middle == right[0])).all():
                break
            points = self._points(rows, middle)
            hits.append(numpy.array([rows, middle])[:, points[2] == 0])
            rows = numpy.tile(rows, 2)
            left, right = numpy.concatenate([left, points], axis=1), numpy.concatenate([points, right], axis=1)
        # A crossing is a root but for a jump, beside which no value is the level as it is shown. Doubles may have none.
        level = self.levels[rows]
        off = abs(numpy.array([left[1], right[1]]) - level)
        is_near = off.min(axis=0) <= _AS_SHOWN * numpy.where(level == 0, off.max(axis=0), abs(level))
        crossings = numpy.array([rows, numpy.where(off[0] < off[1], left[0], right[0])])
        every = [*hits, crossings[:, (left[2] * right[2] < 0) & is_near]]
        numbers, self.roots = numpy.unique(numpy.concatenate(every, axis=1), axis=1)
        self.rows = numbers.astype(int)
        self.is_still = (self.stretch[0] > 0) & (self.stretch[1] >= 10 * self.stretch[0])
        is_one = (numpy.bincount(self.rows, minlength=size) == 1) & self.varies & ~self.is_still
        self.root = numpy.full(size, nan)
        self.root[self.rows] = self.roots
        self.root[~is_one] = nan

    def _points(self, rows: Any, x: Any) -> Any:
        """Return points: x, y, its side of the level, whether it stays there, and its slope."""
        every = {self.unknown: numpy.concatenate([x, x + _AHEAD * abs(x)])}
        y, ahead = self.problem.rows(numpy.tile(rows, 2)).outcomes(every).reshape(2, -1)
        level, change = self.levels[rows], numpy.nan_to_num(ahead - y)
        slope = numpy.where(abs(change) > _STILL * abs(y), numpy.sign(change), 0.0)
        stays = (slope == 0) & (abs(y - level) <= _ROUNDING * abs(level))
        for extent, values in ((self.span, y), (self.stretch, numpy.where(stays, x, nan))):
            numpy.fmin.at(extent[0], rows, values)
            numpy.fmax.at(extent[1], rows, values)
        side = numpy.sign(y - level)
        side[stays & (side == 0)] = 1  # on a stretch it is on one side of its end
        return numpy.array([x, y, side, stays, slope])

    def failure(self, row: int) -> JkrollError:
        """Return why a row has no one root."""
        problem, span, stretch = self.problem.rows(row), self.span[:, row].tolist(), self.stretch[:, row].tolist()
        if numpy.isnan(span[0]):
            return problem.failure()
        if not self.varies[row]:
            return NoDependence(problem, *problem.measured)
        if self.is_still[row]:
            return Undetermined(problem, stretch)
        roots = [{self.unknown: root} for root in self.roots[self.rows == row].tolist()]
        return SeveralSolutions(problem, roots) if roots else NoSolution(problem, [span])


# --- Two unknowns -----------------------------------------------------------------------------------------------------


def _find_pairs(problem: Problem, table: Any, places: Any, origin: Problem | None) -> Failures:
    """Put the values of two unknowns into a table, with their growths of errors and conditions; return the failures.

    `origin`: a problem from whose solution Newton's method leads to these; there are no failures then.
    """
    failures, rows = Failures(), numpy.arange(table.shape[1])
    if origin is not None:
        pairs, start = Pairs(problem.rows(rows)), numpy.nan_to_num(origin.solution.places)
        places[:], distance = pairs.improved(numpy.broadcast_to(start, places.shape))
        table[:] = pairs.measures(places)
        table[:, (distance == inf) | (table[-1] > MAX_CONDITION)] = nan
        return failures
    for row in rows.tolist():
        try:
            places[:, [row]], table[:, [row]] = Pairs(problem.rows(row)).pair()
        except NoResult as error:
            failures[row] = error
    return failures


class Pairs:
    """A problem of two unknowns, in one row or many, in the coordinates in which they are sought.

    An unknown counts by its logarithm, and a load by ln(1 + P/P_c), which has no end at pull-off. A quantity counts by
    its logarithm, too, and as it is where it is next to zero. Places are arrays with a row for each unknown: one place
    for each row of the problem, or any number of them for a single one.
    """

    def __init__(self, problem: Problem) -> None:
        self.problem, self.size = problem, prod(problem.shape)
        self.load = problem.unknowns.index("load") if "load" in problem.unknowns else None
        self.axes = [_LOADS if name == "load" else numpy.log(grid(name, SIZES[name])) for name in problem.unknowns]
        levels = numpy.array([numpy.broadcast_to(level, self.size) for level in problem.levels.values()], dtype=float)
        self.levels, self.linear = levels, numpy.where(levels == 0, _AT_ZERO, _LINEAR * abs(levels))

    def rows(self, rows: Any) -> "Pairs":
        """Return the same in some rows."""
        return Pairs(self.problem.rows(rows)) if self.problem.shape else self

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

    def slopes(self, places: Any) -> tuple[Any, Any]:
        """Return values and residuals at places, in four rows, and their derivatives in matrices of a place each."""
        count = places.shape[1]
        steps = _STEP * numpy.array([[0, -1, 1, 0, 0], [0, 0, 0, -1, 1]])
        every = self.rows(numpy.tile(numpy.arange(count), 5))
        values = every.values(numpy.tile(places, 5) + steps.repeat(count, axis=1))
        residuals = every.residuals(every.problem.outcomes(values))
        points = numpy.array([*values.values(), *residuals]).reshape(4, 5, count).swapaxes(0, 1)
        return points[0], numpy.array([slopes(points[[low, 0, low + 1]]) for low in (1, 3)]).T

    def measures(self, places: Any) -> Any:
        """Return the values of the unknowns at places, the growths of errors there, and the condition numbers."""
        here, matrices = self.slopes(places)
        values, changes, matrices = here[:2], matrices[:, :2], numpy.nan_to_num(matrices[:, 2:])
        inverse = numpy.linalg.pinv(matrices, rcond=0.1 / MAX_CONDITION)
        with numpy.errstate(divide="ignore", invalid="ignore"):
            growths = numpy.linalg.norm(changes @ inverse, axis=2).T / abs(values)
        return numpy.array([*values, *growths, numpy.linalg.cond(matrices)])

    def improved(self, start: Any) -> tuple[Any, Any]:
        """Return the places to which Newton's method leads from others, and how far they are from solutions.

        The distance is infinite where there is none, or not among the sizes that are looked for, but for rounding.
        """
        best, steps = numpy.array(start), numpy.zeros_like(start)
        distance, active = numpy.full(start.shape[1], inf), numpy.arange(start.shape[1])
        for _ in range(_ROUNDS):
            places = best[:, active] + steps[:, active]
            here, matrices = self.rows(active).slopes(places)
            size = numpy.hypot(*here[2:])
            is_nearer = size < distance[active]
            nearer = active[is_nearer]
            best[:, nearer], distance[nearer] = places[:, is_nearer], size[is_nearer]
            # Where both quantities change alike, the pseudo-inverse gives the shortest step.
            inverse = numpy.linalg.pinv(numpy.nan_to_num(matrices[:, 2:]), rcond=0.01 / MAX_CONDITION)
            newton = -numpy.einsum("kij,jk->ik", inverse, numpy.nan_to_num(here[2:]))
            limited = newton / numpy.maximum(1.0, numpy.hypot(*newton))
            steps[:, active] = numpy.where(is_nearer, limited, steps[:, active] / 2)
            active = active[abs(steps[:, active]).max(axis=0) > _LAST_STEP]
            if not active.size:
                break
        if self.load is not None:
            best[self.load, abs(best[self.load]) <= _NEAR] = 0.0  # no load
        is_inside = [(x >= axis[0] - _NEAR) & (x <= axis[-1] + _NEAR) for x, axis in zip(best, self.axes, strict=True)]
        return best, numpy.where((distance <= _NEAR) & numpy.all(is_inside, axis=0), distance, inf)

    def pair(self) -> tuple[Any, Any]:
        """Return the place of the one pair, and its measures. Raises the reason why there is none."""
        problem, mesh = self.problem, numpy.array(numpy.meshgrid(*self.axes, indexing="ij"))
        matrices = self.slopes(mesh[:, ::_SAMPLED, ::_SAMPLED].reshape(2, -1))[1][:, 2:]
        known = matrices[numpy.isfinite(matrices).all(axis=(1, 2))]
        if len(known) and numpy.linalg.cond(known).min() > MAX_CONDITION / 10:
            raise Unseparated(problem, self._left_open(known[len(known) // 2]))
        quantities = problem.outcomes(self.values(mesh.reshape(2, -1)))
        places, distance = self.improved(self._starts(mesh, self.residuals(quantities).reshape(mesh.shape)))
        places = places[:, numpy.argsort(distance)[: numpy.isfinite(distance).sum()]]
        if not places.size:
            if not numpy.isfinite(quantities.sum(axis=0)).any():
                raise problem.failure()
            spans = numpy.transpose([numpy.nanmin(quantities, axis=1), numpy.nanmax(quantities, axis=1)])
            raise NoSolution(problem, spans.tolist())
        table = self.measures(places)
        worst = int(table[-1].argmax())
        if table[-1, worst] > MAX_CONDITION:
            matrices = self.slopes(places[:, [worst]])[1][:, 2:]
            raise Unseparated(problem, self._left_open(matrices[0]), float(table[-1, worst]))
        distinct: list[int] = []
        for number, place in enumerate(places.T):
            if all(abs(place - places[:, other]).max() > _SAME for other in distinct):
                distinct.append(number)
        if len(distinct) > 1:
            rows = sorted(table[:2, distinct].T.tolist())
            raise SeveralSolutions(problem, [dict(zip(problem.unknowns, row, strict=True)) for row in rows])
        return places[:, :1], table[:, :1]

    def _starts(self, mesh: Any, residuals: Any) -> Any:
        """Return places in the cells of a grid in which both measured values lie between corners, or beside a gap.

        They are the middles of the corners that have quantities and, beside a gap, also places next to it.
        """
        corners, ends = (sliding_window_view(each, (2, 2), axis=(1, 2)) for each in (residuals, mesh))
        low, high = (each.reduce(corners, axis=(3, 4)) for each in (numpy.fmin, numpy.fmax))
        has = numpy.isfinite(corners).all(axis=0)
        is_gap = ~has.all(axis=(2, 3))
        cells = ((low <= 0) & (high >= 0) | is_gap).all(axis=0) & has.any(axis=(2, 3))
        middles = numpy.nanmean(numpy.where(has, ends, nan)[:, cells], axis=(2, 3))
        near, far = (
            middles[:, is_gap[cells]],
            numpy.nanmean(numpy.where(has, nan, ends)[:, cells & is_gap], axis=(2, 3)),
        )
        for _ in range(_TO_GAP):
            half = (near + far) / 2
            is_near = numpy.isfinite(self.problem.outcomes(self.values(half))).all(axis=0)
            near, far = numpy.where(is_near, half, near), numpy.where(is_near, far, half)
        return numpy.concatenate([middles, near], axis=1)

    def _left_open(self, matrix: Any) -> str:
        """Return the direction in which both quantities stay as they are, given the matrix of their derivatives."""
        slope = max(matrix.tolist(), key=lambda slope: hypot(*slope))  # the steepest
        symbols = [NOMENCLATURE[name].symbol for name in self.problem.unknowns]
        for symbol, own, other in zip(symbols, slope, slope[::-1], strict=True):
            if abs(own) <= _LEFT_OPEN * abs(other):
                return f"they leave {symbol} open"
        if self.load is not None:
            symbols[self.load] = "(1 + P/P_c)"  # by whose logarithm a load counts
        return f"both stay as they are along {symbols[0]} ∝ {symbols[1]}^{-slope[1] / slope[0]:.3g}"
