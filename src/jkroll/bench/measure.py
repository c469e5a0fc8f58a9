"""The cost and the errors of every way to every headline quantity, and the cost of `jkroll.solve` beside plain programs."""

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from functools import partial
from time import perf_counter_ns
from typing import Any, NamedTuple

import numpy

from ..quantities.nomenclature import NOMENCLATURE
from ..scene.solver import BLOCK, solve
from .points import Arrays, each, exact, hard, inputs_of, ordinary, references, scenes
from .ways import OTHER_WAYS, QUANTITIES, by_hand, own_way

DEFAULT = "jkroll, arrays"
USUAL = (
    "pull_off_force", "contact_radius", "approach", "yield_force", "yield_force_ratio", "yield_moment", "yield_angle",
    "r_min", "n_grav", "vertical_frequency", "rolling_frequency", "n_roll",
)  # fmt: skip
STATE = ("contact_radius_at_load", "approach_at_load", "stiffness")
_NUMPY = numpy.sqrt, numpy.cbrt, numpy.minimum, numpy.maximum
_MATH = math.sqrt, math.cbrt, min, max
_SAME_COST = 1.25  # ratio of times that clocks do not tell apart


class Size(NamedTuple):
    """The extent of a measurement."""

    points: int  # of each kind whose errors are measured
    elements: int  # of the arrays that are timed
    numbers: int  # calls for one number that are timed
    repeats: int
    scenes: int  # of the comparison with bare numpy


FULL = Size(points=2000, elements=100_000, numbers=300, repeats=5, scenes=1_000_000)
QUICK = Size(points=200, elements=20_000, numbers=30, repeats=2, scenes=50_000)


class Row(NamedTuple):
    """One way to one quantity."""

    quantity: str
    way: str
    cost: float  # ns a point
    median: float  # ulp, ordinary points
    worst: float  # ulp, ordinary points
    worst_hard: float  # ulp, hard points
    on_front: bool = False

    @property
    def error(self) -> float:
        """The worst error anywhere."""
        return max(self.worst, self.worst_hard)


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


def measure(size: Size, quantities: Sequence[str] = QUANTITIES) -> list[Row]:
    """Measure every way to the quantities."""
    kinds = ordinary(size.points), hard(size.points)
    rows: list[Row] = []
    with numpy.errstate(all="ignore"):
        for quantity in quantities:
            rows += with_front(_measure_quantity(quantity, kinds, size))
    return rows


def _measure_quantity(quantity: str, kinds: Sequence[Arrays], size: Size) -> list[Row]:
    ways = OTHER_WAYS[quantity].values()
    names = dict.fromkeys(name for way in (references()[quantity], *ways) for name in inputs_of(way))
    kinds = [{name: kind[name] for name in names} for kind in kinds]
    many = {name: numpy.resize(values, size.elements) for name, values in kinds[0].items()}
    few = {name: values[: size.numbers] for name, values in kinds[0].items()}
    wanted = [numpy.array([exact(quantity, point) for point in each(kind)]).T for kind in kinds]
    candidates = list(_candidates(quantity))
    timed = {one.name: partial(one.run, one.prepare(many if one.is_of_arrays else few)) for one in candidates}
    times = _best(timed, size.repeats)
    rows = []
    for one in candidates:
        usual, difficult = (
            _errors(one.run(one.prepare(kind)), *want) for kind, want in zip(kinds, wanted, strict=True)
        )
        cost = times[one.name] / (size.elements if one.is_of_arrays else len(each(few)))
        rows.append(
            Row(quantity, one.name, cost, float(numpy.median(usual)), float(usual.max()), float(difficult.max()))
        )
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
    yield _Candidate("mpmath", each, lambda points: [exact(quantity, point)[0] for point in points], is_of_arrays=False)


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


def _errors(values: Any, nearest: Any, rest: Any) -> Any:
    """Return distances from the exact values, in units of the last place of the nearest doubles; inf for no number."""
    error = abs((numpy.asarray(values, dtype=float) - nearest) - rest) / numpy.spacing(abs(nearest))
    return numpy.where(numpy.isfinite(error), error, numpy.inf)


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
        {"solve": lambda: solve(STATE, model="maugis", **many), "by hand": lambda: solve(STATE, **many)},
        size.repeats,
    )
    return [
        _ratio("arrays, numpy", size.scenes, arrays, size.scenes),
        _ratio("one scene, math", 1, numbers, len(few)),
        _ratio("state by maugis, beside jkr", size.scenes, states, size.scenes),
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
