"""Speed against error: what every way to a quantity costs, and how many digits it leaves."""

import csv
import math
from collections.abc import Sequence
from pathlib import Path
from typing import TextIO

from ..output.files import whole_file
from ..text import json_text, say
from .measure import DEFAULT, FULL, QUICK, Ratio, Row, beats, compare, measure

HEADS = ("quantity", "way", "ns_per_point", "median_ulp", "worst_ulp", "worst_ulp_hard", "on_front")
RATIO_HEADS = ("case", "scenes", "solve_ns_per_scene", "bare_ns_per_scene", "ratio", "extra_memory_bytes")


def write_bench(out: TextIO, kind: str, quick: bool, plot: str | Path | None = None) -> int:
    """Measure everything and write it as a table, plain lines, CSV or JSON, and draw it into a file if one is named.

    Return the exit code.
    """
    if plot is not None:
        from ..pictures import page as drawing  # noqa: F401  if it is missing, it is missed before anything is measured
    size = QUICK if quick else FULL
    rows, ratios = measure(size), compare(size)
    if plot is not None:
        plot_bench(rows, plot)
    if kind == "json":
        whole = {
            "ways": [dict(zip(HEADS, _bare(row), strict=True)) for row in rows],
            "solve": [dict(zip(RATIO_HEADS, _bare(ratio), strict=True)) for ratio in ratios],
        }
        say(json_text(whole, out), out)
    elif kind == "csv":
        writer = csv.writer(out, lineterminator="\n")
        writer.writerows([HEADS, *map(_bare, rows)])
        out.write("\n")
        writer.writerows([RATIO_HEADS, *map(_bare, ratios)])
    elif kind == "table":
        _write_tables(rows, ratios, out)
    else:
        for heads, lines in ((HEADS, rows), (RATIO_HEADS, ratios)):
            say("\t".join(heads), out)
            for line in lines:
                say("\t".join(map(str, _bare(line))), out)
    return 0


def _write_tables(rows: Sequence[Row], ratios: Sequence[Ratio], out: TextIO) -> None:
    from ..output.table import write_rows

    write_rows(
        ["quantity", "way", "ns/point", "median ulp", "worst ulp", "hard", "front"],
        [
            [
                row.quantity,
                row.way,
                _short(row.cost),
                *map(_short, (row.median, row.worst, row.worst_hard)),
                "*" if row.on_front else "",
            ]
            for row in rows
        ],
        out,
    )
    say("* no other way is both as accurate and, to 10 %, as cheap", out)
    for line in off_front(rows):
        say(line, out)
    say("", out)
    write_rows(
        ["solve", "scenes", "ns/scene", "by hand", "ratio", "extra memory"],
        [
            [
                ratio.case,
                str(ratio.scenes),
                _short(ratio.solved),
                _short(ratio.bare),
                _short(ratio.ratio),
                f"{ratio.extra_memory / 1e6:.2f} MB",
            ]
            for ratio in ratios
        ],
        out,
    )


def off_front(rows: Sequence[Row]) -> list[str]:
    """A line for each quantity whose default is beaten, and by what."""
    lines = []
    for row in rows:
        if row.way == DEFAULT and not row.on_front:
            better = [other for other in rows if other.quantity == row.quantity and beats(other, row)]
            found = min(better, key=lambda other: (other.error, other.cost))
            lines.append(
                f"{row.quantity}: the default is not on the front: {_short(row.cost)} ns and {_short(row.error)} ulp "
                f"against {_short(found.cost)} ns and {_short(found.error)} ulp by {found.way}"
            )
    return lines


def plot_bench(rows: Sequence[Row], path: str | Path) -> None:
    """Error against cost, a panel a quantity, with the front, as the ending of a file says; needs matplotlib."""
    from ..pictures.page import sheet

    names = list(dict.fromkeys(row.quantity for row in rows))
    columns = math.ceil(math.sqrt(len(names)))
    figure = sheet(4 * columns, 3.2 * math.ceil(len(names) / columns))
    for place, name in enumerate(names, 1):
        axes = figure.add_subplot(math.ceil(len(names) / columns), columns, place)
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
    """An error on a logarithmic axis: all digits lost where there is no number."""
    return min(max(error, 0.1), 2.0**53)


def _bare(line: Row | Ratio) -> list[str | float | None]:
    """The fields in the order of the heads; what is no number is none."""
    fields: list[str | float]
    if isinstance(line, Row):
        fields = [*line]
    else:
        fields = [line.case, line.scenes, line.solved, line.bare, line.ratio, line.extra_memory]
    return [None if isinstance(field, float) and not math.isfinite(field) else field for field in fields]


def _short(value: float) -> str:
    return f"{value:.3g}" if math.isfinite(value) else "no number"
