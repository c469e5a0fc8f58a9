"""`jkroll bench`: the cost and the errors of every way to a quantity, as a table, plain lines, CSV, JSON or a plot."""

import math
from collections.abc import Sequence
from pathlib import Path
from typing import Any, TextIO

from ..output.records import Cell, whole_file, write_records
from ..text import json_text, say
from .measure import DEFAULT, FULL, QUICK, Ratio, Row, beats, compare, measure

HEADS = ("quantity", "way", "ns_per_point", "median_ulp", "worst_ulp", "worst_ulp_hard", "on_front")
RATIO_HEADS = ("case", "scenes", "solve_ns_per_scene", "by_hand_ns_per_scene", "ratio")
TABLE_HEADS = ("quantity", "way", "ns/point", "median ulp", "worst ulp", "hard", "front")
RATIO_TABLE_HEADS = ("solve", "scenes", "ns/scene", "by hand", "ratio")


def write_bench(out: TextIO, kind: str, quick: bool, plot: str | Path | None = None) -> int:
    """Measure everything, write it in a format, draw it into a file if one is named, and return the exit code."""
    if plot is not None:
        from ..pictures import page  # noqa: F401  a missing library is reported before anything is measured
    size = QUICK if quick else FULL
    rows, ratios = measure(size), compare(size)
    if plot is not None:
        plot_bench(rows, plot)
    if kind == "table":
        write_records(TABLE_HEADS, map(_table_row, rows), kind, out)
        say("* no other way is both as accurate and, to 25 %, as cheap", out)
        for line in off_front(rows):
            say(line, out)
        say("", out)
        write_records(RATIO_TABLE_HEADS, map(_ratio_table_row, ratios), kind, out)
        return 0
    ways = [[*map(_finite, row)] for row in rows]
    solved = [[_finite(getattr(one, name)) for name in _RATIO_FIELDS] for one in ratios]
    if kind == "json":
        parts = {"ways": (HEADS, ways), "solve": (RATIO_HEADS, solved)}
        objects = {
            name: [dict(zip(heads, line, strict=True)) for line in lines] for name, (heads, lines) in parts.items()
        }
        say(json_text(objects, out), out)
    else:
        write_records(HEADS, ways, kind, out)
        say("", out)
        write_records(RATIO_HEADS, solved, kind, out)
    return 0


_RATIO_FIELDS = ("case", "scenes", "solved", "by_hand", "ratio")


def _finite(cell: Any) -> Any:
    return None if isinstance(cell, float) and not math.isfinite(cell) else cell


def _table_row(row: Row) -> list[Cell]:
    errors = map(_short, (row.median, row.worst, row.worst_hard))
    return [row.quantity, row.way, _short(row.cost), *errors, "*" if row.on_front else ""]


def _ratio_table_row(one: Ratio) -> list[Cell]:
    numbers = map(_short, (one.solved, one.by_hand, one.ratio))
    return [one.case, one.scenes, *numbers]


def _short(value: float) -> str:
    return f"{value:.3g}" if math.isfinite(value) else "no number"


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


def plot_bench(rows: Sequence[Row], path: str | Path) -> None:
    """Draw error against cost, a panel for each quantity, with the front; needs matplotlib."""
    from ..pictures.page import sheet

    names = list(dict.fromkeys(row.quantity for row in rows))
    columns = math.ceil(math.sqrt(len(names)))
    lines = math.ceil(len(names) / columns)
    figure = sheet(4 * columns, 3.2 * lines)
    for place, name in enumerate(names, 1):
        axes = figure.add_subplot(lines, columns, place)
        ways = sorted((row for row in rows if row.quantity == name), key=lambda row: row.cost)
        front = [row for row in ways if row.on_front]
        axes.step([row.cost for row in front], [_drawn(row.error) for row in front], where="post", color="0.7")
        for row in ways:
            axes.plot(row.cost, _drawn(row.error), "o" if row.on_front else "x", color=f"C{int(row.way != DEFAULT)}")
            axes.annotate(row.way, (row.cost, _drawn(row.error)), fontsize=5, xytext=(3, 3), textcoords="offset points")
        axes.set(title=name, xscale="log", yscale="log", xlabel="ns a point", ylabel="worst error [ulp]")
    with whole_file(str(path)) as stream:
        figure.savefig(stream, format=Path(path).suffix[1:].lower())


def _drawn(error: float) -> float:
    """Return an error on a logarithmic axis; where there is no number, all digits are lost."""
    return min(max(error, 0.1), 2.0**53)
