"""`jkroll bench`: cost against error of every way to a quantity, measured, as one table or one page of a plot."""

import math
import platform
from collections.abc import Callable, Iterator, Mapping, Sequence
from decimal import Decimal
from functools import partial
from itertools import groupby
from statistics import median
from time import perf_counter_ns
from typing import Any, NamedTuple, TextIO

import numpy

from .. import __version__
from ..output.writers import Cell, write_records
from ..physics.contact import pull_off_force, reduced_radius
from ..physics.jkr import FOLD_APPROACH
from ..pictures.picture import Axis, Curve, Panel, Picture
from ..quantities.formatting import significant
from ..quantities.nomenclature import NOMENCLATURE
from ..scene.scene import Scene
from ..text import say
from .ways import DECIMALS, OTHER_WAYS, QUANTITIES, Way, exact, inputs_of

DEFAULT, FLOATS = "jkroll, arrays", "jkroll, floats"
PROMISE, PROMISE_OF_MAUGIS = 15, 40  # ulp/(1 + κ), of the guide


class Size(NamedTuple):
    """The extent of a measurement."""

    points: int  # of each region, whose errors are measured, and of the ordinary one, whose single numbers are timed
    elements: int  # of the arrays that are timed
    repeats: int


FULL = Size(points=500, elements=100_000, repeats=5)
QUICK = Size(points=50, elements=20_000, repeats=2)


class Error(NamedTuple):
    """The errors of a way at the points of a region, in ulp/(1 + κ)."""

    median: float
    worst: float


class Row(NamedTuple):
    """One way to one quantity."""

    quantity: str
    way: str
    cost: float  # ns a point
    cube_roots: float  # the same in cube roots of an array by numpy
    errors: Mapping[str, Error]  # by region; none where the quantity has no points

    @property
    def worst(self) -> float:
        """The largest error anywhere."""
        return max(error.worst for error in self.errors.values())


# --- Points -----------------------------------------------------------------------------------------------------------

Arrays = Mapping[str, Any]
REGIONS = ("ordinary", "pull-off", "fold", "δ = 0", "extreme")
_PULL_OFF_APPROACH = -(2 ** (-4 / 3))  # δ/δ0 at the pull-off force
# Decades of ordinary inputs, and of any.
_ORDINARY = {
    "radius": (-8, -4), "radius2": (-8, -4), "work_of_adhesion": (-2, 0.3), "contact_modulus": (9, 11.5),
    "yield_displacement": (-10, -9.3), "atomic_spacing": (-10, -9),
}  # fmt: skip
_ANY = {
    "radius": (-12, 3), "radius2": (-12, 3), "work_of_adhesion": (-6, 2), "contact_modulus": (4, 13),
    "yield_displacement": (-12, -6),
}  # fmt: skip


def regions(count: int) -> Mapping[str, Arrays]:
    """Return points of each region: ordinary ones, those near pull-off, the fold and δ = 0, and tiny and huge states.

    Ordinary ones are grains of 10 nm to 100 µm under loads from −0.8 to 2 P_c, or at approaches from −0.8 to 3 δ0. The
    others have sizes and properties of any magnitude. A load reaches no fold.
    """
    random = numpy.random.default_rng(1997)

    def powers(low: float, high: float) -> Any:
        return 10 ** random.uniform(low, high, count)

    ordinary = {name: powers(*ends) for name, ends in _ORDINARY.items()}
    any_size = {name: powers(*ends) for name, ends in _ANY.items()}
    strain = any_size["work_of_adhesion"] / any_size["contact_modulus"]
    any_size["atomic_spacing"] = numpy.cbrt(_reduced(any_size) * strain * strain) / powers(-4, 4)  # μ from 1e-4 to 1e4

    sign = numpy.sign(random.uniform(-1, 1, count))
    small, tiny = sign * powers(-15, -2), sign * powers(-18, -2)
    is_tiny = numpy.arange(count) % 2 == 0
    huge, huge_load = numpy.where(is_tiny, powers(0, 6), powers(6, 29)), numpy.where(is_tiny, tiny, powers(0, 9))
    return {
        "ordinary": _at(ordinary, random.uniform(-0.8, 3, count), random.uniform(-0.8, 2, count)),
        "pull-off": _at(any_size, _PULL_OFF_APPROACH * (1 + small), powers(-15, -2) - 1),
        "fold": _at(any_size, FOLD_APPROACH + powers(-14, -1)),
        "δ = 0": _at(any_size, tiny, -8 / 9 * (1 + small)),
        "extreme": _at(any_size, huge, huge_load),
    }


def _reduced(sizes: Arrays) -> Any:
    return reduced_radius(radius=sizes["radius"], radius2=sizes["radius2"])


def _at(sizes: Arrays, approach_ratio: Any, load_ratio: Any = None) -> Arrays:
    """Return points at approaches and, if there are any, at loads that are multiples of the rounded pull-off force."""
    points = {**sizes, "approach_at_load": approach_ratio, "approach": numpy.ones_like(approach_ratio)}
    if load_ratio is None:
        return points
    force = pull_off_force(work_of_adhesion=sizes["work_of_adhesion"], reduced_radius=_reduced(sizes))
    return {**points, "pull_off_force": force, "load": numpy.maximum(load_ratio * force, -force)}


def each(points: Arrays) -> list[dict[str, float]]:
    """Return the points as dictionaries of floats."""
    return [dict(zip(points, row, strict=True)) for row in zip(*(v.tolist() for v in points.values()), strict=True)]


# --- Measurement ------------------------------------------------------------------------------------------------------


def measure(size: Size, quantities: Sequence[str] = QUANTITIES) -> Iterator[Row]:
    """Measure every way to the quantities; iterate over the rows."""
    points = regions(size.points)
    elements = numpy.linspace(1, 2, size.elements)
    root = _best({"cbrt": lambda: numpy.cbrt(elements)}, size.repeats)["cbrt"] / size.elements
    for quantity in quantities:
        with numpy.errstate(all="ignore"):
            yield from _measure_quantity(quantity, points, size, root)


def _measure_quantity(quantity: str, points: Mapping[str, Arrays], size: Size, root: float) -> Iterator[Row]:
    """Measure every way to a quantity by arrays, and the package's by floats, too; `root`: ns of a cube root.

    The package's is what `jkroll.solve` does.
    """
    others = OTHER_WAYS[quantity]

    def ours(given: Arrays) -> Any:
        return Scene(given)[quantity]

    names = {name for way in (getattr(DECIMALS, quantity), *others.values()) for name in inputs_of(way)}
    given = {
        region: {name: arrays[name] for name in names} for region, arrays in points.items() if names <= arrays.keys()
    }
    exacts = {region: [exact(quantity, point) for point in each(arrays)] for region, arrays in given.items()}
    ways: dict[str, Way] = {DEFAULT: ours, **{name: partial(_by_symbols, way) for name, way in others.items()}}
    many = {name: numpy.resize(values, size.elements) for name, values in given["ordinary"].items()}
    few = each(given["ordinary"])
    runs = {name: partial(way, many) for name, way in ways.items()} | {FLOATS: lambda: [*map(ours, few)]}
    counts = dict.fromkeys(ways, size.elements) | {FLOATS: len(few)}
    ways[FLOATS] = lambda arrays: [*map(ours, each(arrays))]
    for name, time in _best(runs, size.repeats).items():
        errors = {region: _error(ways[name](arrays), exacts[region]) for region, arrays in given.items()}
        yield Row(quantity, name, time / counts[name], time / counts[name] / root, errors)


def _by_symbols(way: Way, arrays: Arrays) -> Any:
    return way(*(arrays[name] for name in inputs_of(way)))


def _error(values: Any, exacts: Sequence[tuple[Decimal, float]]) -> Error:
    """Return the errors of values, in units of the last place of the exact ones over 1 + κ; inf for no number."""
    ulps = [
        float(abs(Decimal(value) - exactly) / Decimal(math.ulp(exactly))) / (1 + condition)
        if math.isfinite(value)
        else math.inf
        for value, (exactly, condition) in zip(numpy.asarray(values).tolist(), exacts, strict=True)
    ]
    return Error(median(ulps), max(ulps))


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

HEADS = (
    "quantity", "way", "ns_per_point", "cube_roots",
    *(f"{which}_{region}" for region in ("ordinary", "pull_off", "fold", "zero_approach", "extreme")
      for which in ("median", "worst")),
)  # fmt: skip
LEGEND = f"""ns      nanoseconds a point
× cbrt  the same in cube roots of an array by numpy, on this machine
others  median and largest error in ulp/(1 + κ) in a region of points, κ the condition in load, approach or λ;
        the guide promises {PROMISE}, and {PROMISE_OF_MAUGIS} by Maugis
"""


def write_bench(out: TextIO, kind: str, size: Size) -> list[Row]:
    """Measure everything, write it in a format, and return it. A table for readers has a part for each quantity."""
    if kind != "table":
        rows = [*measure(size)]
        write_records(HEADS, map(_in_full, rows), kind, out)
        return rows
    say(f"{machine()}\n{LEGEND}", out)
    rows = []
    for quantity, ways in groupby(measure(size), lambda row: row.quantity):
        rows += (of_quantity := [*ways])
        write_records((quantity, "ns", "× cbrt", *REGIONS), map(_in_short, of_quantity), kind, out)
        say("", out)
    return rows


def machine() -> str:
    """Return what the times depend on: processor and versions."""
    versions = f"Python {platform.python_version()}, numpy {numpy.__version__}, jkroll {__version__}"
    return f"{platform.processor() or platform.machine()}, {versions}"


def _in_full(row: Row) -> list[Cell]:
    errors = [number for region in REGIONS for number in row.errors.get(region, (math.nan, math.nan))]
    return [row.quantity, row.way, row.cost, row.cube_roots, *(e if math.isfinite(e) else None for e in errors)]


def _in_short(row: Row) -> list[Cell]:
    """Return the cells of a row with two digits: for errors and times, more say nothing."""
    pairs = [row.errors.get(region) for region in REGIONS]
    errors = [pair and " ".join(significant(number, 2) for number in pair) for pair in pairs]
    return [row.way, significant(row.cost, 2), significant(row.cube_roots, 2), *errors]


# --- The page ---------------------------------------------------------------------------------------------------------

_NEAREST, _ALL_DIGITS = 0.1, 2.0**53  # ulp: least error that is drawn, and an error as large as the value


def picture_of(rows: Sequence[Row]) -> Picture:
    """Return error against cost, a panel for each quantity."""
    panels = tuple(_panel(name, [*ways]) for name, ways in groupby(rows, lambda row: row.quantity))
    caption = (
        "Each point is a way, with its largest error in all regions, in ulp/(1 + κ).",
        "Dashed: the promise of the guide. Points at 10¹⁶: no number, or no digit.",
        f"{machine()}. Arrays, but for floats.",
    )
    return Picture("Error against cost of the ways to six quantities", panels, caption)


def _panel(quantity: str, rows: Sequence[Row]) -> Panel:
    """Return the panel of one quantity, with the error that the guide promises."""
    promise, law = (PROMISE_OF_MAUGIS, ", Maugis") if "maugis" in quantity else (PROMISE, "")
    x, y = Axis("time_of_a_point", 1e-10, 1e-2), Axis("error", 0.01, 1e18)
    ways = [
        Curve(row.way, numpy.array([row.cost * 1e-9]), numpy.clip([row.worst], _NEAREST, _ALL_DIGITS), number)
        for number, row in enumerate(rows)
    ]
    line = Curve("promise", numpy.array([x.low, x.high]), numpy.full(2, promise), colour=-1, is_dashed=True)
    return Panel(x, y, (*ways, line), title=NOMENCLATURE[quantity].sentence + law)
