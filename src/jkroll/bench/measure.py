"""The cost and the errors of every way to every headline quantity, and the cost of `jkroll.solve` beside plain programs."""

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from functools import partial
from time import perf_counter_ns
from typing import Any, NamedTuple

import numpy

from ..quantities.nomenclature import NOMENCLATURE
from ..scene.solver import BLOCK, solve
from .points import Arrays, digits, each, exact, inputs_of, references, regions, scenes
from .ways import OTHER_WAYS, QUANTITIES, by_hand, own_way

DEFAULT = "jkroll, arrays"
USUAL = (
    "pull_off_force", "contact_radius", "approach", "yield_force", "yield_force_ratio", "yield_moment", "yield_angle",
    "r_min", "n_grav", "vertical_frequency", "rolling_frequency", "n_roll",
)  # fmt: skip
OF_A_STATE = ("contact_radius_at_load", "approach_at_load", "stiffness")
_NUMPY = numpy.sqrt, numpy.cbrt, numpy.minimum, numpy.maximum
_MATH = math.sqrt, math.cbrt, min, max
_SAME_COST = 1.25  # ratio of times that clocks do not tell apart


class Size(NamedTuple):
    """The extent of a measurement."""

    points: int  # of each region, whose errors are measured
    elements: int  # of the arrays that are timed
    numbers: int  # calls for one number that are timed
    repeats: int
    scenes: int  # of the comparison with bare numpy


FULL = Size(points=500, elements=100_000, numbers=300, repeats=5, scenes=1_000_000)
QUICK = Size(points=50, elements=20_000, numbers=30, repeats=2, scenes=50_000)


class Error(NamedTuple):
    """The errors of a way at the points of a region."""

    median: float  # ulp/(1 + κ)
    worst: float  # ulp/(1 + κ)
    worst_ulp: float  # κ left in: of a result whose state is known to all of its digits


class Row(NamedTuple):
    """One way to one quantity."""

    quantity: str
    way: str
    cost: float  # ns a point
    yardsticks: float  # cost in cube roots of numpy
    errors: Mapping[str, Error]  # by region; none where the quantity has no points
    on_front: bool = False

    @property
    def worst(self) -> float:
        """The worst error anywhere, in ulp/(1 + κ)."""
        return max(error.worst for error in self.errors.values())

    @property
    def error(self) -> float:
        """The worst error anywhere, in ulp."""
        return max(error.worst_ulp for error in self.errors.values())


class Ratio(NamedTuple):
    """The cost of `jkroll.solve` beside a plain program of the same formulas, or that of one law beside another."""

    case: str
    scenes: int
    solved: float  # ns a scene
    by_hand: float  # ns a scene

    @property
    def ratio(self) -> float:
        """The time of `solve` in units of that of the plain program."""
        return self.solved / self.by_hand


class _Candidate(NamedTuple):
    """A way to be measured: `prepare` makes of arrays what `run`, which is timed, takes."""

    name: str
    prepare: Callable[[Arrays], Any]
    run: Callable[[Any], Any]
    is_of_arrays: bool = True


def measure(size: Size, quantities: Sequence[str] = QUANTITIES) -> Iterator[list[Row]]:
    """Measure every way to the quantities; iterate over the rows of each."""
    points = regions(size.points)
    roots = numpy.linspace(1, 2, size.elements)
    yardstick = _best({"cbrt": lambda: numpy.cbrt(roots)}, size.repeats)["cbrt"] / size.elements
    for quantity in quantities:
        with numpy.errstate(all="ignore"):
            rows = _measure_quantity(quantity, points, size, yardstick)
        yield with_front(rows)


def _measure_quantity(quantity: str, points: Mapping[str, Arrays], size: Size, yardstick: float) -> list[Row]:
    ways = OTHER_WAYS[quantity].values()
    names = dict.fromkeys(name for way in (references()[quantity], *ways) for name in inputs_of(way))
    given = {
        region: {name: values[name] for name in names}
        for region, values in points.items()
        if names.keys() <= values.keys()
    }
    wanted = {region: numpy.array([exact(quantity, point) for point in each(at)]).T for region, at in given.items()}
    many = {name: numpy.resize(values, size.elements) for name, values in given["ordinary"].items()}
    few = {name: values[: size.numbers] for name, values in given["ordinary"].items()}
    candidates = list(_candidates(quantity))
    timed = {one.name: partial(one.run, one.prepare(many if one.is_of_arrays else few)) for one in candidates}
    times = _best(timed, size.repeats)
    rows = []
    for one in candidates:
        errors = {region: _errors(one.run(one.prepare(at)), *wanted[region]) for region, at in given.items()}
        cost = times[one.name] / (size.elements if one.is_of_arrays else len(each(few)))
        rows.append(Row(quantity, one.name, cost, cost / yardstick, errors))
    return rows


def _candidates(quantity: str) -> Iterator[_Candidate]:
    """Iterate over all ways to a quantity."""
    own = own_way(quantity)
    yield _Candidate(DEFAULT, dict, own)
    yield _Candidate("jkroll, floats", each, partial(_numbers, own), is_of_arrays=False)
    for name, way in OTHER_WAYS[quantity].items():
        yield _Candidate(name, partial(_arguments, inputs_of(way)), partial(_called, way))
    yield _Candidate("jkroll, float32", _in_single_precision, own)
    yield _Candidate("jkroll, pint arrays", _with_units, lambda given: own(given).to_base_units().magnitude)
    yield _Candidate(
        "60 digits", each, lambda points: [float(digits(quantity, point)) for point in points], is_of_arrays=False
    )


def _arguments(names: Sequence[str], points: Arrays) -> list[Any]:
    return [points[name] for name in names]


def _called(way: Callable[..., Any], arguments: Sequence[Any]) -> Any:
    return way(*arguments)


def _in_single_precision(points: Arrays) -> Arrays:
    return {name: values.astype(numpy.float32) for name, values in points.items()}


def _with_units(points: Arrays) -> Arrays:
    """Return pint Quantities in base units: cube roots of J/m² and Pa have dimensions that round differently."""
    from ..quantities.units import registry

    return {name: registry().Quantity(value, NOMENCLATURE[name].unit).to_base_units() for name, value in points.items()}


def _numbers(function: Callable[[Mapping[str, float]], Any], points: Sequence[Mapping[str, float]]) -> list[Any]:
    """Call a function for each point; nan stands for no answer."""
    results = []
    for point in points:
        try:
            results.append(function(point))
        except (ValueError, ZeroDivisionError, OverflowError):
            results.append(math.nan)
    return results


def _errors(values: Any, nearest: Any, rest: Any, condition: Any) -> Error:
    """Return the errors of values, in units of the last place of the nearest doubles; inf for no number."""
    ulp = abs((numpy.asarray(values, dtype=float) - nearest) - rest) / numpy.spacing(abs(nearest))
    ulp = numpy.where(numpy.isfinite(ulp), ulp, numpy.inf)
    stated = ulp / (1 + condition)
    return Error(float(numpy.median(stated)), float(stated.max()), float(ulp.max()))


def _best(runs: Mapping[str, Callable[[], Any]], repeats: int) -> dict[str, float]:
    """Return the shortest time of each, in ns; they take turns, so that a busy machine slows all of them."""
    best = dict.fromkeys(runs, math.inf)
    for _ in range(repeats):
        for name, run in runs.items():
            for _warm in (False, True):
                start = perf_counter_ns()
                run()
                best[name] = min(best[name], perf_counter_ns() - start)
    return best


def with_front(rows: Sequence[Row]) -> list[Row]:
    """Return the rows of one quantity with a mark on those that no other beats."""
    return [row._replace(on_front=not any(beats(other, row) for other in rows)) for row in rows]


def beats(one: Row, two: Row) -> bool:
    """Return whether one way is cheaper and no less accurate than another, or more accurate and no dearer."""
    cheaper, dearer = one.cost * _SAME_COST < two.cost, one.cost > two.cost * _SAME_COST
    return (cheaper and one.error <= two.error) or (one.error < two.error and not dearer)


def compare(size: Size) -> list[Ratio]:
    """Compare `jkroll.solve` with plain expressions of numpy in blocks for many scenes, and of `math` for one; and Maugis' law with JKR."""
    many = scenes(size.scenes)
    few: list[dict[str, Any]] = list(each({name: values[: size.numbers] for name, values in many.items()}))
    arrays = _best(
        {"solve": lambda: solve(USUAL, **many), "by hand": lambda: by_hand_in_blocks(many)},
        size.repeats,
    )
    numbers = _best(
        {
            "solve": lambda: [solve(USUAL, **scene) for scene in few],
            "by hand": lambda: [by_hand(*_MATH, **scene) for scene in few],
        },
        size.repeats,
    )
    states = _best(
        {"solve": lambda: solve(OF_A_STATE, model="maugis", **many), "by hand": lambda: solve(OF_A_STATE, **many)},
        size.repeats,
    )
    return [
        _ratio("arrays, beside numpy in the same blocks", size.scenes, arrays, size.scenes),
        _ratio("one scene, beside math", 1, numbers, len(few)),
        _ratio("state by Maugis, beside JKR", size.scenes, states, size.scenes),
    ]


def by_hand_in_blocks(many: Arrays) -> dict[str, Any]:
    """Return the usual quantities by plain numpy, in blocks as large as those of `solve`."""
    size = len(many["radius"])
    results = {name: numpy.empty(size) for name in USUAL}
    for start in range(0, size, BLOCK):
        place = slice(start, start + BLOCK)
        for name, values in by_hand(*_NUMPY, **{name: array[place] for name, array in many.items()}).items():
            results[name][place] = values
    return results


def _ratio(case: str, scenes: int, times: Mapping[str, float], count: int) -> Ratio:
    return Ratio(case, scenes, times["solve"] / count, times["by hand"] / count)
