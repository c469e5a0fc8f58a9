"""Maps and curves in a terminal: a map as a table of numbers, curves as rows."""

from collections.abc import Iterable, Iterator, Sequence
from math import isfinite, log10, nan
from typing import TextIO

import numpy
from rich.color import Color
from rich.console import Console
from rich.style import Style
from rich.table import Table
from rich.text import Text

from ..quantities.formatting import amount, in_units
from ..quantities.markup import plain, symbol
from ..text import fitting, say, terminal_width, wrapped
from .picture import Axis, Map, Panel, Picture, bracketed, described, evaluate, extent, over, quantity_of
from .styles import LOOKS, PAPER

ROWS, COLUMNS = 13, 9  # of a map
CURVE_ROWS = 11  # of each curve
DIGITS = 3
NO_VALUE = "—"


def write_map(drawn: Map, out: TextIO) -> None:
    """Write a map as a table: a row for each round value of y, a mark on a number for each doubt, and their key below.

    It has as many columns as fit the terminal.
    """
    y = drawn.y.at_round_values(ROWS)
    for columns in range(COLUMNS, 0, -1):
        x = drawn.x.at_round_values(columns)
        table, unit, seen = _map_table(drawn, x, y, out)
        console = _console(out)
        if console.measure(table, options=console.options.update(width=10_000)).maximum <= console.width:
            break
    (_, of_x), (_, of_y) = _texts(x), _texts(y)
    _say([drawn.titled(unit), f"Down: {described(y.name, of_y)}. Across: {described(x.name, of_x)}."], out)
    console.print(table)
    signs = ((LOOKS[region.look].sign, region.text) for region in drawn.regions)
    key = [f"{sign} {text}" for sign, text in signs if sign in seen]
    gaps = [f"{NO_VALUE} no value"] if NO_VALUE in seen else []
    _say([*key, *gaps, "; ".join(_marks(drawn)), *drawn.caption, *drawn.remarks], out)


def _map_table(drawn: Map, x: Axis, y: Axis, out: TextIO) -> tuple[Table, str, set[str]]:
    """Return the table of a map at values of x and y, the unit of its numbers, and the signs in it."""
    drawn = drawn._replace(values=numpy.array(extent(drawn.values)))  # which every cell asks for
    here, values = over(drawn.scene, x, y), evaluate(drawn.scene, drawn.quantity, x, y)
    known = numpy.isfinite(values)
    texts, signs = numpy.full((2, *values.shape), "", dtype=object)
    texts[~known] = NO_VALUE
    texts[known], unit = drawn.in_words(values[known].tolist(), DIGITS)
    if drawn.printed:
        printed, _ = drawn.in_words(evaluate(drawn.scene, drawn.printed, x, y)[known].tolist(), DIGITS)
        texts[known] += [f" ({text})" for text in printed]
    for region in drawn.regions:
        signs[known & numpy.broadcast_to(region.excess(here) > 0, values.shape)] += LOOKS[region.look].sign
    for column in range(x.size):  # numbers stand below each other, whichever signs they have
        if width := max(map(len, signs[:, column])):
            texts[:, column] += [f" {sign:{width}}" for sign in signs[:, column]]
    rows: list[list[str | Text]] = [
        [head, *(Text(cell, _style(drawn, value)) for cell, value in zip(cells, row, strict=True))]
        for head, cells, row in zip(_texts(y)[0], texts.tolist(), values.tolist(), strict=True)
    ]
    table = _table([quantity_of(y.name).symbol, *_texts(x)[0]], rows[::-1], out)
    return table, unit, {*"".join(signs.ravel().tolist()), *([] if known.all() else [NO_VALUE])}


def _texts(axis: Axis) -> tuple[list[str], str]:
    """Return the values of an axis as texts, and their unit, which is empty where each has its own."""
    return in_units(quantity_of(axis.name).unit, axis.values().tolist(), DIGITS + 1, is_log=axis.is_log)


def _style(drawn: Map, value: float) -> Style:
    """Return the colours of a number: the larger, the lighter; none for a gap or where all are the same."""
    low, high = extent(drawn.values)
    if not isfinite(value) or low == high:
        return Style()
    low, value, high = (log10(number) if drawn.is_log else number for number in (low, value, high))
    paper = PAPER.band(min(max((value - low) / (high - low), 0.0), 1.0))
    return Style(color="black", bgcolor=Color.from_rgb(*(255 * channel for channel in paper)))


def _marks(drawn: Map) -> Iterator[str]:
    """Iterate over the marks of a map: each with its place on an axis, or, at a point, with the value there."""
    for mark in drawn.marks:
        given = {axis.name: value for axis, value in ((drawn.x, mark.x), (drawn.y, mark.y)) if value is not None}
        if len(given) == 2:
            point = drawn.scene.replace(**drawn.x.inputs(mark.x), **drawn.y.inputs(mark.y))
            given = point.numbers(drawn.quantity) or {drawn.quantity: nan}
        for name, value in given.items():
            shown = amount(name, float(f"{value:.{DIGITS + 1}g}")) if isfinite(value) else NO_VALUE
            yield f"{mark.text}: {symbol(name)} = {shown}"


def write_picture(drawn: Picture, out: TextIO) -> None:
    """Write panels below each other: some rows of each curve, and the points."""
    _say([drawn.title], out)
    for panel in drawn.panels:
        _say([panel.title], out)
        _console(out).print(_panel_table(panel, out))
    _say([*drawn.caption, *drawn.remarks], out)


def _panel_table(panel: Panel, out: TextIO) -> Table:
    """Return the rows of a panel as a table: the curve or the point, x and y."""
    rows: list[tuple[str, float, float]] = []
    for curve in panel.curves:
        points = [(x, y) for x, y in zip(curve.x.tolist(), curve.y.tolist(), strict=True) if panel.shows(x, y)]
        last, steps = len(points) - 1, min(CURVE_ROWS, len(points)) - 1
        rows += [(plain(curve.text), *points[round(last * step / max(steps, 1))]) for step in range(steps + 1)]
    rows += [(plain(mark.text), mark.x, mark.y) for mark in panel.marks if mark.x is not None and mark.y is not None]
    names, *numbers = zip(*rows, strict=True)
    heads, cells = [""], [[*names]]
    for axis, values in zip((panel.x, panel.y), numbers, strict=True):
        texts, unit = in_units(quantity_of(axis.name).unit, values, DIGITS + 1, is_log=axis.is_log)
        heads.append(quantity_of(axis.name).symbol + bracketed(unit))
        cells.append(texts)
    return _table(heads, [*zip(*cells, strict=True)], out)


def _table(heads: Sequence[str], rows: Iterable[Sequence[str | Text]], out: TextIO) -> Table:
    """Return a table of texts: names in the first column, numbers in the others."""
    table = Table(box=None, pad_edge=False, header_style="")
    for number, head in enumerate(heads):
        table.add_column(Text(fitting(head, out)), justify="right" if number else "left", no_wrap=bool(number))
    for row in rows:
        texts = (cell if isinstance(cell, Text) else Text(cell) for cell in row)
        table.add_row(*(Text(fitting(text.plain, out), text.style) for text in texts))
    return table


def _console(out: TextIO) -> Console:
    return Console(file=out, width=terminal_width(), highlight=False, markup=False, emoji=False)


def _say(texts: Iterable[str], out: TextIO) -> None:
    """Print texts in lines that fit the terminal."""
    for text in filter(None, texts):
        for line in wrapped(plain(text), terminal_width()):
            say(line, out)
