"""`jkroll bench`: the cost and the errors of every way to a quantity, as tables, plain lines, CSV, JSON or a plot."""

import math
import platform
import sys
from collections.abc import Iterable, Iterator, Sequence
from datetime import date
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple, TextIO

import numpy

from .. import __version__
from ..output.records import Cell, whole_file, write_records
from ..text import json_text, say
from .measure import DEFAULT, FULL, QUICK, Ratio, Row, beats, compare, measure
from .points import REGIONS
from .ways import QUANTITIES

if TYPE_CHECKING:
    from ..pictures.maps import Panel, Picture

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
PROMISE, PROMISE_OF_MAUGIS = 15, 25  # ulp/(1 + κ), of the guide
_NEAREST, _ALL_DIGITS = 0.1, 2.0**53  # ulp: least error that is drawn, and an error as large as the value


class Plot(NamedTuple):
    """A file to be drawn, its width in inches, None for the usual one, and a key of `styles.STYLES`."""

    path: str | Path
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
        say(
            ", ".join(
                (machine[0], *(f"{name} {fact}" for name, fact in zip(MACHINE_HEADS[1:], machine[1:], strict=True)))
            ),
            out,
        )
        say(LEGEND.format(PROMISE, PROMISE_OF_MAUGIS), out)
    for of_quantity in _with_progress(measure(size)):
        rows += of_quantity
        if is_table:
            write_records((of_quantity[0].quantity, *TABLE_HEADS), map(_table_row, of_quantity), kind, out)
            say("", out)
    ratios = compare(size)
    if plot is not None:
        plot_bench(rows, plot)
    if is_table:
        for line in off_front(rows):
            say(line, out)
        say("", out)
        write_records(RATIO_TABLE_HEADS, map(_ratio_table_row, ratios), kind, out)
        return 0
    parts = {
        "machine": (MACHINE_HEADS, [machine]),
        "ways": (HEADS, list(map(_row, rows))),
        "solve": (RATIO_HEADS, [[_finite(getattr(one, name)) for name in _RATIO_FIELDS] for one in ratios]),
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


def _with_progress(measured: Iterable[list[Row]]) -> Iterator[list[Row]]:
    """Iterate over what is measured; a terminal shows which quantity it is."""
    is_shown = sys.stderr.isatty()

    def show(text: str) -> None:
        if is_shown:
            sys.stderr.write(f"\r{text:<60}\r")
            sys.stderr.flush()

    results = iter(measured)
    for number, quantity in enumerate(QUANTITIES, 1):
        show(f"{number} of {len(QUANTITIES)}: {quantity}")
        rows = next(results, None)
        show("")
        if rows is None:
            return
        yield rows
    show("jkroll.solve beside plain programs")


_RATIO_FIELDS = ("case", "scenes", "solved", "by_hand", "ratio")


def _row(row: Row) -> list[Any]:
    errors = [row.errors.get(region) for region in REGIONS]
    pairs = [cell for error in errors for cell in (error[:2] if error else (None, None))]
    return [row.quantity, row.way, *map(_finite, (row.cost, row.yardsticks, *pairs, row.error)), row.on_front]


def _finite(cell: Any) -> Any:
    return None if isinstance(cell, float) and not math.isfinite(cell) else cell


def _table_row(row: Row) -> list[Cell]:
    errors = [row.errors.get(region) for region in REGIONS]
    cells = [f"{_short(error.median)} {_short(error.worst)}" if error else None for error in errors]
    return [row.way, _short(row.cost), _short(row.yardsticks), *cells, _short(row.error), "*" if row.on_front else ""]


def _ratio_table_row(one: Ratio) -> list[Cell]:
    numbers = map(_short, (one.solved, one.by_hand, one.ratio))
    return [one.case, one.scenes, *numbers]


def _short(value: float) -> str:
    """Return two digits of a number: for errors and times, more say nothing."""
    if not math.isfinite(value):
        return "nan"
    return (
        f"{value:.2g}"
        if value < 100
        else f"{value:.0f}"
        if value < 10_000
        else f"{value:.0e}".replace("e+0", "e").replace("e+", "e")
    )


def off_front(rows: Sequence[Row]) -> list[str]:
    """Return a line for each quantity whose default is beaten, with the way that beats it: a tie if within 1 ulp."""
    lines = []
    for row in rows:
        if row.way == DEFAULT and not row.on_front:
            better = [other for other in rows if other.quantity == row.quantity and beats(other, row)]
            found = min(better, key=lambda other: (other.error, other.cost))
            words = "within 1 ulp of" if row.error - found.error <= 1 else "better than"
            lines.append(
                f"{row.quantity}: {words} the default: {found.way}, {_short(found.cost)} ns and "
                f"{_short(found.error)} ulp for {_short(row.cost)} ns and {_short(row.error)} ulp"
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

    kind = Path(plot.path).suffix[1:].lower()
    content = draw(picture_of(rows), kind, plot.inches, plot.style, has_caption=plot.has_caption)
    with whole_file(str(plot.path)) as stream:
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
        Mark(str(n), row.cost * 1e-9, min(max(row.worst, _NEAREST), _ALL_DIGITS)) for n, row in enumerate(ways, 1)
    )
    keys = (f"{n}  {row.way}" for n, row in enumerate(ways, 1))
    return Panel(x, y, (line,), tuple(points), title, keys=tuple(keys))
