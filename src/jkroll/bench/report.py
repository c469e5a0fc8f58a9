"""`jkroll bench`: the cost and the errors of every way to every headline quantity, and the cost of `jkroll.solve` beside plain programs.

They are measured, and written as tables, plain lines, CSV, JSON or a plot.
"""

import math
import platform
import sys
from collections.abc import Callable, Iterator, Mapping, Sequence
from datetime import date
from functools import partial
from pathlib import Path
from time import perf_counter_ns
from typing import TYPE_CHECKING, Any, NamedTuple, TextIO

import numpy

from .. import __version__
from ..output.files import whole_file
from ..output.records import Cell, write_records
from ..quantities.nomenclature import NOMENCLATURE
from ..scene.solver import ELEMENTS_AT_ONCE, solve
from ..text import ending, json_text, say
from .points import REGIONS, Arrays, digits, each, exact, inputs_of, references, regions, scenes
from .ways import OTHER_WAYS, QUANTITIES, by_hand, own_way

if TYPE_CHECKING:
    from ..pictures.maps import Panel, Picture


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
    root: float  # ns, of a cube root of numpy
    errors: Mapping[str, Error]  # by region; none where the quantity has no points
    on_front: bool = False

    @property
    def yardsticks(self) -> float:
        """The cost in cube roots of numpy."""
        return self.cost / self.root

    @property
    def worst_stated(self) -> float:
        """The worst error anywhere, in ulp/(1 + κ)."""
        return max(error.worst for error in self.errors.values())

    @property
    def worst_ulp(self) -> float:
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


def measure(
    size: Size, quantities: Sequence[str] = QUANTITIES, show: Callable[[str], None] = lambda _: None
) -> Iterator[list[Row]]:
    """Measure every way to the quantities; iterate over the rows of each. `show` is told which is measured."""
    points = regions(size.points)
    roots = numpy.linspace(1, 2, size.elements)
    root = _best({"cbrt": lambda: numpy.cbrt(roots)}, size.repeats)["cbrt"] / size.elements
    for number, quantity in enumerate(quantities, 1):
        show(f"{number} of {len(quantities)}: {quantity}")
        with numpy.errstate(all="ignore"):
            rows = _measure_quantity(quantity, points, size, root)
        show("")
        yield with_front(rows)


def _measure_quantity(quantity: str, points: Mapping[str, Arrays], size: Size, root: float) -> list[Row]:
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
        rows.append(Row(quantity, one.name, cost, root, errors))
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
    return (cheaper and one.worst_ulp <= two.worst_ulp) or (one.worst_ulp < two.worst_ulp and not dearer)


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
    for start in range(0, size, ELEMENTS_AT_ONCE):
        place = slice(start, start + ELEMENTS_AT_ONCE)
        for name, values in by_hand(*_NUMPY, **{name: array[place] for name, array in many.items()}).items():
            results[name][place] = values
    return results


def _ratio(case: str, scenes: int, times: Mapping[str, float], count: int) -> Ratio:
    return Ratio(case, scenes, times["solve"] / count, times["by hand"] / count)


# --- Report -----------------------------------------------------------------------------------------------------------

MACHINE_HEADS = ("cpu", "python", "numpy", "jkroll", "date")
_ERROR_HEADS = [
    f"{part}_{region}"
    for region in ("ordinary", "pull_off", "fold", "zero_approach", "extreme")
    for part in ("median", "worst")
]
HEADS = ("quantity", "way", "ns_per_point", "cube_roots", *_ERROR_HEADS, "worst_ulp", "on_front")
RATIO_HEADS = ("case", "scenes", "solve_ns_per_scene", "beside_ns_per_scene", "ratio")
TABLE_HEADS = ("ns", "× cbrt", *REGIONS, "κ in", "")
RATIO_TABLE_HEADS = ("solve", "scenes", "ns/scene", "beside it", "ratio")
LEGEND = """ns      nanoseconds a point
× cbrt  the same in cube roots of an array by numpy, on this machine
ordinary, pull-off, fold, δ = 0, extreme
        median and largest error in ulp/(1 + κ) there, κ the condition in load, approach or λ;
        the guide promises {}, and {} by Maugis
κ in    largest error in ulp, of a state that is known to all of its digits
*       no other way is both as accurate (κ in) and, to 25 %, as cheap
"""
PROMISE, PROMISE_OF_MAUGIS = 15, 40  # ulp/(1 + κ), of the guide
_NEAREST, _ALL_DIGITS = 0.1, 2.0**53  # ulp: least error that is drawn, and an error as large as the value


class Plot(NamedTuple):
    """A file to be drawn, its width in inches, None for the usual one, and a key of `styles.STYLES`."""

    path: str
    inches: float | None = None
    style: str = "paper"
    has_caption: bool = True


def write_bench(out: TextIO, kind: str, quick: bool, plot: Plot | None = None) -> int:
    """Measure everything, write it in a format, draw it into a file if one is named, and return the exit code."""
    size = QUICK if quick else FULL
    rows: list[Row] = []
    machine = machine_facts()
    is_table = kind == "table"
    if is_table:
        facts = (f"{name} {fact}" for name, fact in zip(MACHINE_HEADS[1:], machine[1:], strict=True))
        say(", ".join((machine[0], *facts)), out)
        say(LEGEND.format(PROMISE, PROMISE_OF_MAUGIS), out)
    for of_quantity in measure(size, show=_show):
        rows += of_quantity
        if is_table:
            write_records((of_quantity[0].quantity, *TABLE_HEADS), map(_table_row, of_quantity), kind, out)
            say("", out)
    _show("jkroll.solve beside plain programs")
    ratios = compare(size)
    _show("")
    if plot is not None:
        plot_bench(rows, plot)
    if is_table:
        for line in off_front(rows):
            say(line, out)
        say("", out)
        write_records(
            RATIO_TABLE_HEADS,
            ([one.case, one.scenes, _short(one.solved), _short(one.by_hand), _short(one.ratio)] for one in ratios),
            kind,
            out,
        )
        return 0
    parts = {
        "machine": (MACHINE_HEADS, [machine]),
        "ways": (HEADS, list(map(_row, rows))),
        "solve": (RATIO_HEADS, [[*map(_finite, (*one, one.ratio))] for one in ratios]),
    }
    if kind == "json":
        objects = {
            name: [dict(zip(heads, line, strict=True)) for line in lines] for name, (heads, lines) in parts.items()
        }
        say(json_text(objects, out), out)
        return 0
    for number, (heads, lines) in enumerate(parts.values()):
        if number:
            say("", out)
        write_records(heads, lines, kind, out)
    return 0


def machine_facts() -> list[str]:
    """Return what the times depend on, and the day."""
    return [_processor(), platform.python_version(), numpy.__version__, __version__, date.today().isoformat()]


def _processor() -> str:
    """Return the name of the processor; Linux has it in a file, and elsewhere Python knows it."""
    try:
        lines = Path("/proc/cpuinfo").read_text(encoding="utf-8").splitlines()
    except OSError:
        lines = []
    names = (line.partition(":")[2].strip() for line in lines if line.startswith("model name"))
    return next(names, platform.processor() or platform.machine())


def _show(text: str) -> None:
    """Show on a terminal what is measured, in place of what it showed before."""
    if sys.stderr.isatty():
        sys.stderr.write(f"\r{text:<60}\r")
        sys.stderr.flush()


def _row(row: Row) -> list[Any]:
    errors = [row.errors.get(region) for region in REGIONS]
    pairs = [cell for error in errors for cell in (error[:2] if error else (None, None))]
    return [row.quantity, row.way, *map(_finite, (row.cost, row.yardsticks, *pairs, row.worst_ulp)), row.on_front]


def _finite(cell: Any) -> Any:
    return None if isinstance(cell, float) and not math.isfinite(cell) else cell


def _table_row(row: Row) -> list[Cell]:
    errors = [row.errors.get(region) for region in REGIONS]
    cells = [f"{_short(error.median)} {_short(error.worst)}" if error else None for error in errors]
    return [
        row.way,
        _short(row.cost),
        _short(row.yardsticks),
        *cells,
        _short(row.worst_ulp),
        "*" if row.on_front else "",
    ]


def _short(value: float) -> str:
    """Return two digits of a number: for errors and times, more say nothing."""
    if not math.isfinite(value):
        return "nan"
    if value < 10_000:
        return f"{value:.2g}" if value < 100 else f"{value:.0f}"
    return f"{value:.0e}".replace("e+0", "e").replace("e+", "e")


def off_front(rows: Sequence[Row]) -> list[str]:
    """Return a line for each quantity whose default is beaten, with the way that beats it: a tie if within 1 ulp."""
    lines = []
    for row in rows:
        if row.way == DEFAULT and not row.on_front:
            better = [other for other in rows if other.quantity == row.quantity and beats(other, row)]
            found = min(better, key=lambda other: (other.worst_ulp, other.cost))
            words = "within 1 ulp of" if row.worst_ulp - found.worst_ulp <= 1 else "better than"
            lines.append(
                f"{row.quantity}: {words} the default: {found.way}, {_short(found.cost)} ns and "
                f"{_short(found.worst_ulp)} ulp for {_short(row.cost)} ns and {_short(row.worst_ulp)} ulp"
            )
    return lines


PLOTTED = {
    "pull_off_force": "pull-off force",
    "contact_radius_at_load": "radius at P",
    "stiffness": "stiffness at P",
    "load_factor_at_approach": "state at δ",
    "contact_radius_maugis": "radius, Maugis",
    "yield_moment": "rolling moment",
}  # what users ask for


def plot_bench(rows: Sequence[Row], plot: Plot) -> None:
    """Draw error against cost into a file; needs matplotlib."""
    from ..pictures.page import draw

    content = draw(picture_of(rows), ending(plot.path), plot.inches, plot.style, has_caption=plot.has_caption)
    with whole_file(plot.path) as stream:
        stream.write(content)


def picture_of(rows: Sequence[Row]) -> "Picture":
    """Return error against cost, a panel for each of six quantities."""
    from ..pictures.maps import Picture

    panels = tuple(_panel(title, [row for row in rows if row.quantity == name]) for name, title in PLOTTED.items())
    processor, python, with_numpy, version, day = machine_facts()
    caption = (
        "Each point is a way, numbered by its cost; its error is the largest in all regions, κ the condition of the result in load, approach or λ.",
        "Dashed: the promise of the guide. Points at 10¹⁶: no number, or no digit.",
        f"{processor}; Python {python}, numpy {with_numpy}, jkroll {version}; {day}. Arrays, but for floats and 60 digits.",
    )
    return Picture("Error against cost of the ways to six quantities", panels, caption)


def _panel(title: str, rows: Sequence[Row]) -> "Panel":
    """Return the panel of one quantity, with the error that the guide promises."""
    from ..pictures.axes import Axis
    from ..pictures.maps import Curve, Mark, Panel

    promise = PROMISE_OF_MAUGIS if "maugis" in rows[0].quantity else PROMISE
    x, y = Axis("time_of_a_point", 1e-10, 1e-2), Axis("error", 0.01, 1e18)
    line = Curve("promise", numpy.array([x.low, x.high]), numpy.array([promise, promise]), is_dashed=True)
    ways = sorted(rows, key=lambda row: row.cost)
    points = (
        Mark(str(n), row.cost * 1e-9, min(max(row.worst_stated, _NEAREST), _ALL_DIGITS))
        for n, row in enumerate(ways, 1)
    )
    keys = (f"{n}  {row.way}" for n, row in enumerate(ways, 1))
    return Panel(x, y, (line,), tuple(points), title, keys=tuple(keys))
