"""The inverse problem of two unknowns: the values of two inputs at which two quantities have their measured values.

The second input is scanned. At each of its values all values of the first input are looked for that give the first
quantity, as for one unknown. So the pairs that give this quantity lie on branches, and the second quantity is a
function of the second input on each. Its crossings are found as for one unknown, too, and improved by Newton's method
in the logarithms of all four.
"""

from collections.abc import Iterable, Iterator, Mapping, Sequence
from functools import cached_property
from itertools import permutations, product
from math import exp, hypot, inf, isclose, isnan, nan, sqrt
from typing import Any

from ..errors import JkrollError, NoResult
from ..quantities.nomenclature import NOMENCLATURE
from ..text import listed
from .failures import Contradiction
from .inverse import (
    SIZES,
    STEP,
    CannotInfer,
    NoDependence,
    NoSolution,
    Observed,
    Search,
    SeveralSolutions,
    Solution,
    Values,
    check_given,
    check_one,
    crossings,
    equal,
    failure,
    found_by,
    found_by_all,
    grid,
    pieces_of,
    roots,
    solution,
    with_inputs,
    with_placeholders,
    with_turning_points,
)
from .scene import EXCLUSIVE, Scene

MAX_CONDITION = 1e8  # beyond which rounding leaves the differences that the condition number is made of too few digits
_ROUNDS = 40  # of Newton's method
_HALVINGS = 8  # of a step that leads further away
_LONGEST = 1.0  # of a step, in logarithms
_NEAR = 1e-10  # of the measured values: a pair that is as near as this is a solution
_SAME = 1e-9  # relative difference of two pairs that were found twice, on two branches or on one
_DIGITS = 1e-13  # of the quantities, where rounding ends
_LEFT_OPEN = 1e-4  # an exponent as small as this is none


# --- Errors -----------------------------------------------------------------------------------------------------------


class Unseparated(NoResult):
    """Error raised where two quantities do not separate two inputs."""

    def __init__(self, names: Sequence[str], quantities: Sequence[str], condition: float, remark: str) -> None:
        """`condition`: of both together; `remark`: what is left open."""
        super().__init__(tuple(names), tuple(quantities), condition, remark)
        self.name, self.names, self.quantities = ",".join(names), tuple(names), tuple(quantities)
        self.condition, self.remark = condition, remark

    def reason(self) -> str:
        """Return what does not separate what."""
        most = f"{MAX_CONDITION:.0e}".replace("+0", "")
        size = f"κ = {self.condition:.2g} is above {most}" if self.condition < inf else f"κ is above {most}"
        return f"{listed(self.quantities)} do not separate them: {self.remark} ({size})"


# --- Problems ---------------------------------------------------------------------------------------------------------


class Problem:
    """Two inputs of a scene that lacks them, and the measured values of two quantities."""

    def __init__(self, names: Sequence[str], measured: Values, scene: Scene) -> None:
        """Take what is sought and measured. Raises the errors that no values could mend."""
        self.names, self.measured, self.scene = tuple(names), measured, scene
        check(names, tuple(measured), scene)

    def outcomes(self, values: Mapping[str, Any], quantities: Iterable[str] | None = None) -> dict[str, float]:
        """Return quantities, by default all that were measured, where the inputs have some values; nan where there is no result."""
        wanted = tuple(self.measured if quantities is None else quantities)
        found = with_inputs(self.scene, values).evaluate(wanted)
        for value in found.values():
            if isinstance(value, JkrollError) and not isinstance(value, NoResult):
                raise value
        return {name: nan if isinstance(value, NoResult) else value for name, value in found.items()}

    def solution(self) -> Solution:
        """Return the one pair. Raises NoSolution, SeveralSolutions or Unseparated, or the reason why a quantity has no value anywhere."""
        branches = self._branches()
        found: list[Solution] = []
        for values in branches.crossings():
            place = _improved(_Place(self, values))
            pair = place.pair()
            if not any(place.is_at(other.values, pair.condition) for other in found):
                found.append(pair)
        if not found:
            raise branches.failure()
        if len(found) > 1:
            pairs = sorted((pair.values for pair in found), key=lambda values: [*values.values()])
            raise SeveralSolutions(self.names, self.measured, pairs)
        return found[0]

    def _branches(self) -> "_Branches":
        """Return the branches on which to look, along which the first quantity depends on the first input."""
        orders = _orders(self.names, tuple(self.measured), self.scene)
        for order in orders:
            branches = _Branches(self, order)
            if not branches.is_idle:
                return branches
        first, quantity = orders[0][:2]
        remark = f"{quantity} does not depend on {NOMENCLATURE[first].symbol} here"
        raise Unseparated(self.names, tuple(self.measured), inf, remark)

    def near(self, values: Values) -> Solution:
        """Return the pair to which Newton's method leads from some values, or else that of the whole scan."""
        place = _improved(_Place(self, values))
        is_scanned = all(
            SIZES[name][0] <= value <= SIZES[name][1] for name, value in place.values.items() if name != "load"
        )
        return place.pair() if place.distance <= _NEAR and is_scanned else self.solution()


def solved(names: Sequence[str], observed: Observed) -> Solution:
    """Return the one input, or the two, with which a scene has the measured values."""
    if len(names) > 1:
        return Problem(names, observed.values, observed.scene).solution()
    ((quantity, measured),) = observed.values.items()
    return solution(names[0], quantity, measured, observed.scene)


def solved_near(values: Values, observed: Observed) -> Values:
    """Return the inputs again for measured values, or a scene, that have changed a little."""
    if len(values) > 1:
        return Problem([*values], observed.values, observed.scene).near(values).values
    return solved([*values], observed).values


def check(names: Sequence[str], quantities: Sequence[str], scene: Scene) -> None:
    """Raise the error of one input, or of two, that cannot be inferred from as many quantities, whatever their values are."""
    if len(names) == 1:
        check_one(names[0], quantities[0], scene)
        return
    for name in names:
        if name not in SIZES:
            raise CannotInfer(name)
    if any({*names} <= {*exclusive} for exclusive in EXCLUSIVE):
        raise Contradiction(names)
    for name, quantity in product(names, quantities):
        check_given(name, quantity, scene)
    _orders(names, quantities, scene)


def _orders(names: Sequence[str], quantities: Sequence[str], scene: Scene) -> list[tuple[str, str, str, str]]:
    """Return in which order inputs can be found: one from a quantity, then the other from the other quantity.

    The best stand first: there the first quantity does not depend on the second input. Raises Unseparated if there is
    none.
    """
    filled = with_placeholders(scene, names)
    depends = {quantity: [name for name in names if name in filled.inputs_of(quantity)] for quantity in quantities}
    for quantity, own in depends.items():
        if not own:
            raise Unseparated(names, quantities, inf, f"{quantity} depends on neither")
    for name in names:
        if not any(name in own for own in depends.values()):
            raise Unseparated(names, quantities, inf, f"they leave {NOMENCLATURE[name].symbol} open")
    found = [
        (name, quantity, other, beside)
        for name, other in permutations(names)
        for quantity, beside in permutations(quantities)
        if name in depends[quantity] and other in depends[beside]
    ]
    return sorted(found, key=lambda order: order[2] in depends[order[1]])


# --- Branches ---------------------------------------------------------------------------------------------------------


class _Branches:
    """The pairs of values that give a first quantity. On them, a second quantity depends on the second input alone."""

    def __init__(self, problem: Problem, order: tuple[str, str, str, str]) -> None:
        """Look for the first input at all values of the second one that are scanned."""
        self.problem = problem
        self.first, self.quantity, self.second, self.beside = order
        filled = with_placeholders(problem.scene, problem.names)
        self.is_straight = self.second not in filled.inputs_of(self.quantity)  # the first input is the same everywhere
        self.places = grid(self.second)
        self.spans: list[float] = []  # ends of what the first quantity can be
        self.heights: list[float] = []  # what the second quantity is on the branches
        # A pair and the value, of branches on which it is the same.
        self.flat: list[tuple[dict[str, float], float]] = []
        self.roots: dict[float, list[float]] = {}  # of the first input, by the second one
        self.is_idle = False  # whether the first quantity has values, and is the same for all of the first input
        self._scan(self.places[:1] if self.is_straight else self.places)

    def _scan(self, places: Sequence[float]) -> None:
        """Look for the first input at values of the second one, side by side."""

        def outcomes(rows: list[int], values: list[float]) -> list[float]:
            found: list[float] = self._outcomes(values, [places[row] for row in rows]).tolist()
            return found

        scans = self._outcomes([[place] for place in grid(self.first)], places).T.tolist()
        searches = {row: self._roots(scan) for row, scan in enumerate(scans)}
        for row, found in found_by_all(searches, outcomes).items():
            self._put(places[row], found)
        self.is_idle = self.is_idle and not self.spans

    def _outcomes(self, firsts: Any, seconds: Sequence[float]) -> Any:
        """Return the first quantity at many values of both inputs, nan where there is no result; of the second along the last axis."""
        import numpy

        values = {self.first: numpy.array(firsts), self.second: numpy.array(seconds)}
        found = self.problem.outcomes(values, [self.quantity])[self.quantity]
        return numpy.broadcast_to(found, (*numpy.shape(firsts)[:-1], len(seconds)))

    def _roots(self, scan: Sequence[float]) -> Search[tuple[list[float], list[float]]]:
        """Return the search for the values of the first input, given the first quantity where it is scanned."""
        return roots(self.first, self.quantity, self.problem.measured[self.quantity], scan)

    def _put(self, second: float, found: tuple[list[float], list[float]] | NoResult) -> None:
        """Keep the values of the first input at a value of the second one; none where the first quantity does not depend on it."""
        if isinstance(found, NoResult):
            self.is_idle = True
            found = [], []
        self.roots[second], spans = found
        self.spans += [min(spans), max(spans)] if spans else []

    def at(self, second: float) -> list[float]:
        """Return the values of the first input at a value of the second one."""
        if self.is_straight:
            return self.roots[self.places[0]]
        if second not in self.roots:

            def outcome(first: float) -> float:
                values = {self.first: first, self.second: second}
                return self.problem.outcomes(values, [self.quantity])[self.quantity]

            (scan,) = self._outcomes([[place] for place in grid(self.first)], [second]).T.tolist()
            try:
                self._put(second, found_by(self._roots(scan), outcome))
            except NoDependence as error:
                self._put(second, error)
        return self.roots[second]

    def crossings(self) -> Iterator[dict[str, float]]:
        """Iterate over the pairs on all branches at which the second quantity has its measured value.

        A branch is the first, second and so on of so many roots; where their number changes, branches end and others
        begin.
        """
        for count in sorted({len(self.at(place)) for place in self.places}):
            for number in range(count):
                yield from self._crossings_on(count, number)

    def _crossings_on(self, count: int, number: int) -> Iterator[dict[str, float]]:
        """Iterate over the pairs on a branch."""

        def height(second: float) -> float:
            found = self.at(second)
            if len(found) != count:
                return nan
            values = {self.first: found[number], self.second: second}
            return float(self.problem.outcomes(values, [self.beside])[self.beside])

        level = self.problem.measured[self.beside]
        for piece in found_by(pieces_of(self.places, [*map(height, self.places)]), height):
            if _is_flat(piece.values):
                middle = piece.places[len(piece.places) // 2]
                self.flat.append(({self.first: self.at(middle)[number], self.second: middle}, piece.values[0]))
                continue
            for second in found_by(crossings(piece, level), height):  # what is badly separated has many turning points
                yield {self.first: self.at(second)[number], self.second: second}
            divided = found_by(with_turning_points(piece, level), height)
            self.heights += divided.values
            for second in found_by(crossings(divided, level), height):
                yield {self.first: self.at(second)[number], self.second: second}

    def failure(self) -> JkrollError:
        """Return the reason why there is no solution on the branches."""
        names, measured = self.problem.names, self.problem.measured
        if not self.spans:
            return failure(self.first, self.quantity, with_placeholders(self.problem.scene, [self.second]))
        reached = {self.quantity: measured[self.quantity]}
        if not (self.heights or self.flat):
            return NoSolution(names, reached, self.quantity, (min(self.spans), max(self.spans)))
        for pair, height in self.flat:
            if not self.heights or _is_flat([height, measured[self.beside]]):
                held = f"{equal({self.beside: height})} wherever {equal(reached)}"
                direction = _Place(self.problem, pair).left_open()
                return Unseparated(names, tuple(measured), inf, f"{held}; {direction}")
        return NoSolution(names, measured, self.beside, (min(self.heights), max(self.heights)))


def _is_flat(values: Sequence[float]) -> bool:
    """Return whether values differ so little that the condition number would be too large."""
    return max(values) - min(values) <= max(map(abs, values)) / MAX_CONDITION


# --- Newton's method --------------------------------------------------------------------------------------------------


class _Place:
    """Values of the two inputs, the quantities there, and how these change.

    Inputs and quantities count in logarithms. A load counts in parts of its size, or of the pull-off force where that
    is larger, and a quantity that was measured to be zero in parts of what the inputs change it.
    """

    def __init__(self, problem: Problem, values: Values) -> None:
        self.problem, self.values = problem, {name: values[name] for name in problem.names}
        self.forward = problem.outcomes(self.values)

    @cached_property
    def unit(self) -> float:
        """The load that counts as a change by one."""
        force = with_inputs(self.problem.scene, self.values).numbers("pull_off_force")
        return float(max(abs(self.values["load"]), *force.values()))

    def moved(self, steps: Values) -> "_Place":
        """Return the place that is some steps away."""
        moved = {
            name: value + self.unit * steps.get(name, 0.0) if name == "load" else value * exp(steps.get(name, 0.0))
            for name, value in self.values.items()
        }
        return _Place(self.problem, moved)

    @cached_property
    def slopes(self) -> list[list[float]]:
        """The derivatives of the quantities, a row for each, by central differences, or one-sided ones at an end."""
        columns = []
        for name in self.values:
            sides = [(step, self.moved({name: step}).forward) for step in (-STEP, STEP)]
            column = []
            for quantity, here in self.forward.items():
                known = [(step, one[quantity]) for step, one in sides if not isnan(one[quantity])]
                (first, low), (last, high) = (
                    known if len(known) == 2 else [*known, (0.0, here)] if known else [(0, nan), (1, nan)]
                )
                column.append((high - low) / (last - first))
            columns.append(column)
        return [[*row] for row in zip(*columns, strict=True)]

    @cached_property
    def sizes(self) -> list[float]:
        """The change of each quantity that counts as one."""
        return [
            abs(measured) or max(map(abs, row)) or 1.0
            for measured, row in zip(self.problem.measured.values(), self.slopes, strict=True)
        ]

    @cached_property
    def matrix(self) -> list[list[float]]:
        """The matrix of Jacobi, in logarithms."""
        return [[slope / size for slope in row] for row, size in zip(self.slopes, self.sizes, strict=True)]

    @cached_property
    def differences(self) -> list[float]:
        """The measured values less the quantities here."""
        forward = zip(self.problem.measured.items(), self.sizes, strict=True)
        return [(measured - self.forward[name]) / size for (name, measured), size in forward]

    @cached_property
    def distance(self) -> float:
        """The size of the differences, infinite where there is no result."""
        size = hypot(*self.differences)
        return inf if isnan(size) else size

    def is_at(self, values: Values, condition: float) -> bool:
        """Return whether this is the place of some values, as far as the condition number lets them be known."""
        part = max(_SAME, _DIGITS * condition)
        return all(
            isclose(value, values[name], rel_tol=part, abs_tol=part * self.unit if name == "load" else 0.0)
            for name, value in self.values.items()
        )

    def step(self) -> dict[str, float]:
        """Return the step of Newton's method, of a limited length; none where the matrix has no inverse."""
        ((a, b), (c, d)), (first, second) = self.matrix, self.differences
        determinant = a * d - b * c
        if not determinant or isnan(determinant):
            return dict.fromkeys(self.values, 0.0)
        steps = (d * first - b * second) / determinant, (a * second - c * first) / determinant
        part = min(1.0, _LONGEST / (hypot(*steps) or 1.0))
        return {name: part * step for name, step in zip(self.values, steps, strict=True)}

    def pair(self) -> Solution:
        """Return the pair with its condition number. Raises Unseparated if that is too large."""
        (a, b), (c, d) = self.matrix
        determinant, squares = abs(a * d - b * c), a * a + b * b + c * c + d * d
        square = (
            squares + sqrt(max(squares * squares - 4 * determinant * determinant, 0.0))
        ) / 2  # of the largest growth
        condition = square / determinant if determinant > 0 else inf
        if not condition <= MAX_CONDITION:
            raise Unseparated([*self.values], [*self.forward], condition, self.left_open())
        growths = (hypot(b, d) / determinant, hypot(a, c) / determinant)
        return Solution(
            self.values,
            _rounded(condition),
            {name: _rounded(growth * self._part(name)) for name, growth in zip(self.values, growths, strict=True)},
            with_inputs(self.problem.scene, self.values),
            self.forward,
        )

    def _part(self, name: str) -> float:
        """Return what a change by one is of an input itself."""
        return (self.unit / abs(self.values[name]) if self.values[name] else inf) if name == "load" else 1.0

    def left_open(self) -> str:
        """Return the direction in which both quantities stay as they are, to the first order."""
        row = max(self.matrix, key=lambda row: hypot(*row))
        parts = {name: self._part(name) if self.values[name] else 1.0 for name in self.values}
        changes = [part * change for part, change in zip(parts.values(), (-row[1], row[0]), strict=True)]
        (small, least), (large, most) = sorted(zip(parts, changes, strict=True), key=lambda one: abs(one[1]))
        symbols = {name: NOMENCLATURE[name].symbol for name in (small, large)}
        if abs(least) <= _LEFT_OPEN * abs(most) or not most:
            return f"they leave {symbols[large]} open"
        return f"both stay as they are along {symbols[small]} ∝ {symbols[large]}^{least / most:.3g}"


def _rounded(number: float) -> float:
    return float(f"{number:.6g}")


def _improved(place: _Place) -> _Place:
    """Return the place to which Newton's method leads, as near to the measured values as rounding allows."""
    for _ in range(_ROUNDS):
        step = place.step()
        for _ in range(_HALVINGS):
            nearer = place.moved(step)
            if nearer.distance < place.distance:
                break
            step = {name: part / 2 for name, part in step.items()}
        else:
            return place
        place = nearer
    return place
