"""Nanoseconds a point and errors in units of the last place, for every way to every headline quantity."""

from collections.abc import Callable, Mapping, Sequence
from functools import partial
from time import perf_counter_ns
from typing import Any, NamedTuple

from ..scene.solver import solve
from .bare import WANTED, BareArrays, bare_numbers
from .reference import arguments_of, at, exact, references
from .scenes import Arrays, hard, ordinary, point_maker
from .ways import OTHER_WAYS, QUANTITIES, default, with_units

DEFAULT = "jkroll, arrays"
_SAME_COST = 1.1  # clocks do not tell less apart


class Size(NamedTuple):
    """How much is measured."""

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
    """`jkroll.solve` against the same arithmetic written out by hand."""

    case: str
    scenes: int
    solved: float  # ns a scene
    bare: float  # ns a scene
    extra_memory: float  # bytes that `solve` takes at most beyond the arrays it returns

    @property
    def ratio(self) -> float:
        """How many times the bare time `solve` takes."""
        return self.solved / self.bare


def measure(size: Size, quantities: Sequence[str] = QUANTITIES) -> list[Row]:
    """Every way to the quantities."""
    import numpy

    kinds = ordinary(size.points), hard(size.points)
    rows: list[Row] = []
    with numpy.errstate(all="ignore"):
        for quantity in quantities:
            rows += with_front(_measure_quantity(quantity, kinds, size))
    return rows


def _measure_quantity(quantity: str, kinds: Sequence[Arrays], size: Size) -> list[Row]:
    import numpy

    ways = OTHER_WAYS[quantity]
    names = dict.fromkeys(name for way in (references()[quantity], *ways.values()) for name in arguments_of(way))
    kinds = [{name: kind[name] for name in names} for kind in kinds]
    many = {name: numpy.resize(values, size.elements) for name, values in kinds[0].items()}
    single = {name: values.astype(numpy.float32) for name, values in many.items()}
    points = [[point_maker(kind)(place) for place in range(size.points)] for kind in kinds]
    wanted = [_columns(exact(quantity, some)) for some in points]
    few, ours, digits = points[0][: size.numbers], default(quantity), at(quantity)
    runs: dict[str, tuple[Callable[[], Any], int]] = {}
    found: dict[str, list[Any]] = {}

    def add(way: str, timed: Callable[[], Any], count: int, values: Callable[[int], Any]) -> None:
        runs[way] = timed, count
        found[way] = [values(kind) for kind in range(len(kinds))]

    add(DEFAULT, partial(ours, many), size.elements, lambda kind: ours(kinds[kind]))
    add("jkroll, floats", partial(_each, ours, few), len(few), lambda kind: _each(ours, points[kind]))
    for way, function in ways.items():
        taken = arguments_of(function)
        add(
            way,
            partial(function, *(many[name] for name in taken)),
            size.elements,
            partial(_called, function, taken, kinds),
        )
    add(
        "jkroll, float32",
        partial(ours, single),
        size.elements,
        lambda kind: ours({name: values.astype(numpy.float32) for name, values in kinds[kind].items()}),
    )
    united = with_units(many)
    add(
        "jkroll, pint arrays",
        lambda: ours(united).to_base_units(),
        size.elements,
        lambda kind: ours(with_units(kinds[kind])).to_base_units().magnitude,
    )
    add("mpmath", partial(_each, digits, few), len(few), lambda kind: wanted[kind][0])
    costs = _best({way: timed for way, (timed, _) in runs.items()}, size.repeats)
    rows = []
    for way, values in found.items():
        usual, difficult = (_errors(value, *want) for value, want in zip(values, wanted, strict=True))
        cost = costs[way] / runs[way][1]
        rows.append(Row(quantity, way, cost, float(numpy.median(usual)), float(usual.max()), float(difficult.max())))
    return rows


def _called(function: Callable[..., Any], names: Sequence[str], kinds: Sequence[Arrays], kind: int) -> Any:
    return function(*(kinds[kind][name] for name in names))


def _each(function: Callable[[Mapping[str, float]], Any], points: Sequence[Mapping[str, float]]) -> list[Any]:
    """One call a point; a call that has no answer says nan."""
    results = []
    for point in points:
        try:
            results.append(function(point))
        except (ValueError, ZeroDivisionError, OverflowError):
            results.append(float("nan"))
    return results


def _columns(pairs: Sequence[tuple[float, float]]) -> tuple[Any, Any]:
    import numpy

    nearest, rest = numpy.array(pairs).T
    return nearest, rest


def _errors(values: Any, nearest: Any, rest: Any) -> Any:
    """Distances from the exact values, in units of the last place of the doubles next to them; inf for no number."""
    import numpy

    error = abs((numpy.asarray(values, dtype=float) - nearest) - rest) / numpy.spacing(abs(nearest))
    return numpy.where(numpy.isfinite(error), error, numpy.inf)


def _best(runs: Mapping[str, Callable[[], Any]], repeats: int) -> dict[str, float]:
    """The shortest time of each, ns; they take turns, so that a busy spell of the machine meets all of them."""
    best = dict.fromkeys(runs, float("inf"))
    for _ in range(repeats):
        for name, run in runs.items():
            for _warm in (False, True):
                start = perf_counter_ns()
                run()
                best[name] = min(best[name], perf_counter_ns() - start)
    return best


def with_front(rows: Sequence[Row]) -> list[Row]:
    """The rows of one quantity, with a mark on those that none of the others beats."""
    return [row._replace(on_front=not any(beats(other, row) for other in rows)) for row in rows]


def beats(one: Row, two: Row) -> bool:
    """Whether one way is cheaper and no less accurate than another, or more accurate and no dearer."""
    cheaper, dearer = one.cost * _SAME_COST < two.cost, one.cost > two.cost * _SAME_COST
    return (cheaper and one.error <= two.error) or (one.error < two.error and not dearer)


def compare(size: Size) -> list[Ratio]:
    """`jkroll.solve` against bare numpy into outputs allocated beforehand, and against bare `math`."""
    many = _scenes(size.scenes)
    bare = BareArrays(size.scenes)
    times = _best({"solve": lambda: solve(WANTED, **many), "bare": lambda: bare.run(many)}, size.repeats)
    rows = [
        Ratio("arrays", size.scenes, times["solve"] / size.scenes, times["bare"] / size.scenes, _extra_memory(many))
    ]
    few: list[dict[str, Any]] = [dict(point_maker(many)(place)) for place in range(size.numbers)]
    times = _best(
        {
            "solve": lambda: [solve(WANTED, **scene) for scene in few],
            "bare": lambda: [bare_numbers(scene) for scene in few],
        },
        size.repeats,
    )
    rows.append(Ratio("one scene", 1, times["solve"] / len(few), times["bare"] / len(few), _extra_memory(few[0])))
    return rows


def _scenes(count: int) -> Arrays:
    """Scenes in which everything differs, as `jkroll.solve` takes them."""
    points = ordinary(count)
    given: dict[str, Any] = {name: points[name] for name in ("radius", "radius2", "density")}
    given["surface_energy"] = points["work_of_adhesion"] / 2
    given["youngs_modulus"] = points["contact_modulus"]
    given["poisson_ratio"] = 0.1 + 0.3 * (points["approach"] * points["density"] % 1)
    given["load"] = points["load"]
    return given


def _extra_memory(given: Mapping[str, Any]) -> float:
    """Bytes that a call takes at its peak beyond what it returns."""
    import tracemalloc

    tracemalloc.start()
    try:
        results = solve(WANTED, **given)
        peak = tracemalloc.get_traced_memory()[1]
    finally:
        tracemalloc.stop()
    return peak - sum(getattr(value, "nbytes", 0) for value in results.values())
