"""`jkroll bench`: cost against error of every way to a quantity, measured, as one table or one page of a plot."""

import math
import platform
import sys
from collections.abc import Callable, Iterator, Mapping, Sequence
from functools import partial
from pathlib import Path
from time import perf_counter_ns
from typing import TYPE_CHECKING, Any, NamedTuple, TextIO

import numpy

from .. import __version__
from ..output.files import whole_file
from ..output.records import write_records
from ..text import ending, say
from .points import REGIONS, Arrays, digits, each, exact, inputs_of, references, regions
from .ways import OTHER_WAYS, QUANTITIES, our_way

if TYPE_CHECKING:
    from ..pictures.maps import Panel, Picture

DEFAULT = "jkroll, arrays"
PROMISE, PROMISE_OF_MAUGIS = 15, 40  # ulp/(1 + κ), of the guide


class Size(NamedTuple):
    """The extent of a measurement."""

    points: int  # of each region, whose errors are measured
    elements: int  # of the arrays that are timed
    numbers: int  # calls for one number that are timed
    repeats: int


FULL = Size(points=500, elements=100_000, numbers=300, repeats=5)
QUICK = Size(points=50, elements=20_000, numbers=30, repeats=2)


class Error(NamedTuple):
    """The errors of a way at the points of a region, in ulp/(1 + κ)."""

    median: float
    worst: float


class Row(NamedTuple):
    """One way to one quantity."""

    quantity: str
    way: str
    cost: float  # ns a point
    root: float  # ns, of a cube root of numpy
    errors: Mapping[str, Error]  # by region; none where the quantity has no points

    @property
    def worst(self) -> float:
        """The largest error anywhere."""
        return max(error.worst for error in self.errors.values())


# --- Measurement ------------------------------------------------------------------------------------------------------


def measure(
    size: Size, quantities: Sequence[str] = QUANTITIES, show: Callable[[str], None] = lambda _: None
) -> Iterator[Row]:
    """Measure every way to the quantities; iterate over the rows. `show` is told which quantity is measured."""
    points = regions(size.points)
    elements = numpy.linspace(1, 2, size.elements)
    root = _best({"cbrt": lambda: numpy.cbrt(elements)}, size.repeats)["cbrt"] / size.elements
    for number, quantity in enumerate(quantities, 1):
        show(f"{number} of {len(quantities)}: {quantity}")
        with numpy.errstate(all="ignore"):
            yield from _measure_quantity(quantity, points, size, root)
        show("")


def _measure_quantity(quantity: str, points: Mapping[str, Arrays], size: Size, root: float) -> Iterator[Row]:
    by_arrays, by_points = _ways(quantity)
    names = dict.fromkeys(
        name for way in (references()[quantity], *OTHER_WAYS[quantity].values()) for name in inputs_of(way)
    )
    given = {
        region: {name: arrays[name] for name in names}
        for region, arrays in points.items()
        if names.keys() <= arrays.keys()
    }
    listed = {region: each(arrays) for region, arrays in given.items()}
    wanted = {region: numpy.array([exact(quantity, point) for point in few]).T for region, few in listed.items()}
    many = {name: numpy.resize(values, size.elements) for name, values in given["ordinary"].items()}
    few = listed["ordinary"][: size.numbers]
    times = _best({name: partial(way, many) for name, way in by_arrays.items()}, size.repeats)
    times_of_few = _best({name: partial(way, few) for name, way in by_points.items()}, size.repeats)
    for name, way in by_arrays.items():
        errors = {region: _error(way(arrays), *wanted[region]) for region, arrays in given.items()}
        yield Row(quantity, name, times[name] / size.elements, root, errors)
    for name, way in by_points.items():
        errors = {region: _error(way(few), *wanted[region]) for region, few in listed.items()}
        yield Row(quantity, name, times_of_few[name] / len(few), root, errors)


def _ways(quantity: str) -> tuple[dict[str, Callable[[Arrays], Any]], dict[str, Callable[[Any], Any]]]:
    """Return the ways to a quantity that take arrays, and those that take a list of points."""
    ours = our_way(quantity)

    def by_symbols(way: Callable[..., Any]) -> Callable[[Arrays], Any]:
        return lambda arrays: way(*(arrays[name] for name in inputs_of(way)))

    return (
        {DEFAULT: ours, **{name: by_symbols(way) for name, way in OTHER_WAYS[quantity].items()}},
        {
            "jkroll, floats": lambda few: [ours(point) for point in few],
            "60 digits": lambda few: [float(digits(quantity, point)) for point in few],
        },
    )


def _error(values: Any, nearest: Any, rest: Any, condition: Any) -> Error:
    """Return the errors of values, in units of the last place of the nearest doubles over 1 + κ; inf for no number."""
    ulp = abs((numpy.asarray(values, dtype=float) - nearest) - rest) / numpy.spacing(abs(nearest))
    stated = numpy.where(numpy.isfinite(ulp), ulp, numpy.inf) / (1 + condition)
    return Error(float(numpy.median(stated)), float(stated.max()))


def _best(runs: Mapping[str, Callable[[], Any]], repeats: int) -> dict[str, float]:
    """Return the shortest time of each, in ns; they take turns, so that a busy machine slows all of them."""
    best = dict.fromkeys(runs, math.inf)
    for _ in range(2 * repeats):  # the first of all warms up
        for name, run in runs.items():
            start = perf_counter_ns()
            run()
            best[name] = min(best[name], perf_counter_ns() - start)
    return best


# --- The table --------------------------------------------------------------------------------------------------------

_FIELDS = ("ordinary", "pull_off", "fold", "zero_approach", "extreme")  # the regions, in names of columns
HEADS = (
    "quantity", "way", "ns_per_point", "cube_roots",
    *(f"{which}_{region}" for region in _FIELDS for which in ("median", "worst")),
)  # fmt: skip
TABLE_HEADS = ("ns", "× cbrt", *REGIONS)
LEGEND = f"""ns      nanoseconds a point
× cbrt  the same in cube roots of an array by numpy, on this machine
others  median and largest error in ulp/(1 + κ) in a region of points, κ the condition in load, approach or λ;
        the guide promises {PROMISE}, and {PROMISE_OF_MAUGIS} by Maugis
"""


def write_bench(out: TextIO, kind: str, quick: bool, plot: "Plot | None" = None) -> int:
    """Measure everything, write it in a format, draw it into a file if one is named, and return the exit code."""
    rows = list(measure(QUICK if quick else FULL, show=_show))
    if kind == "table":
        say(f"{machine()}\n{LEGEND}", out)
        for quantity in QUANTITIES:
            if lines := [_in_short(row) for row in rows if row.quantity == quantity]:
                write_records((quantity, *TABLE_HEADS), lines, kind, out)
                say("", out)
    else:
        write_records(HEADS, map(_in_full, rows), kind, out)
    if plot is not None:
        plot_bench(rows, plot)
    return 0


def machine() -> str:
    """Return what the times depend on: processor and versions. Linux has the name of the processor in a file."""
    try:
        lines = Path("/proc/cpuinfo").read_text(encoding="utf-8").splitlines()
    except OSError:
        lines = []
    names = (line.partition(":")[2].strip() for line in lines if line.startswith("model name"))
    processor = next(names, platform.processor() or platform.machine())
    return f"{processor}, Python {platform.python_version()}, numpy {numpy.__version__}, jkroll {__version__}"


def _show(text: str) -> None:
    """Show on a terminal what is measured, in place of what it showed before."""
    if sys.stderr.isatty():
        sys.stderr.write(f"\r{text:<60}\r")
        sys.stderr.flush()


def _in_full(row: Row) -> list[Any]:
    errors = [cell for region in REGIONS for cell in row.errors.get(region, (None, None))]
    numbers = (row.cost, row.cost / row.root, *errors)
    return [row.quantity, row.way, *(None if cell is None or not math.isfinite(cell) else cell for cell in numbers)]


def _in_short(row: Row) -> list[str | None]:
    errors = [row.errors.get(region) for region in REGIONS]
    cells = [f"{_short(error.median)} {_short(error.worst)}" if error else None for error in errors]
    return [row.way, _short(row.cost), _short(row.cost / row.root), *cells]


def _short(value: float) -> str:
    """Return two digits of a number: for errors and times, more say nothing."""
    if not math.isfinite(value):
        return "nan"
    if value < 10_000:
        return f"{value:.2g}" if value < 100 else f"{value:.0f}"
    return f"{value:.0e}".replace("e+0", "e").replace("e+", "e")


# --- The page ---------------------------------------------------------------------------------------------------------

PLOTTED = {
    "pull_off_force": "pull-off force",
    "contact_radius_at_load": "radius at P",
    "stiffness": "stiffness at P",
    "load_factor_at_approach": "state at δ",
    "contact_radius_maugis": "radius, Maugis",
    "yield_moment": "rolling moment",
}  # what users ask for
_NEAREST, _ALL_DIGITS = 0.1, 2.0**53  # ulp: least error that is drawn, and an error as large as the value


class Plot(NamedTuple):
    """A file to be drawn, its width in inches, None for the usual one, and a key of `styles.STYLES`."""

    path: str
    inches: float | None = None
    style: str = "paper"
    has_caption: bool = True


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
    caption = (
        "Each point is a way, numbered by its cost; its error is the largest in all regions, in ulp/(1 + κ).",
        "Dashed: the promise of the guide. Points at 10¹⁶: no number, or no digit.",
        f"{machine()}. Arrays, but for floats and 60 digits.",
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
    errors = [min(max(row.worst, _NEAREST), _ALL_DIGITS) for row in ways]
    points = tuple(
        Mark(str(number), row.cost * 1e-9, error)
        for number, (row, error) in enumerate(zip(ways, errors, strict=True), 1)
    )
    keys = tuple(f"{number}  {row.way}" for number, row in enumerate(ways, 1))
    return Panel(x, y, (line,), points, title, keys=keys)
