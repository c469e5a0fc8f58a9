"""Pictures in a terminal: a field as a table of numbers, curves as rows."""

import os
from collections.abc import Iterable, Iterator
from math import isfinite, nan
from typing import Any, TextIO

import numpy

from ..output.table import Column, columns_of, padded, write_table
from ..quantities.formatting import amount, in_units
from ..quantities.markup import plain, symbol
from ..text import say, terminal_width, width_of, wrapped
from .picture import Axis, Field, Panel, Picture, bracketed, described, evaluate, extent, over, quantity_of

ROWS, COLUMNS = 13, 9  # of a field
CURVE_ROWS = 11  # of each curve
DIGITS = 3
NO_VALUE = "—"
_GAP = "  "  # between columns
_PAPERS = (230, 194, 152, 116, 74)  # from low numbers to high ones: those of a page, among the 256 of terminals


def write_picture(drawn: Picture, out: TextIO) -> None:
    """Write panels below each other: a table of a field, or some rows of each curve, and the points."""
    _say([drawn.title], out)
    for panel in drawn.panels:
        _say([panel.title], out)
        if panel.field is not None:
            _write_field(panel, panel.field, out)
        else:
            names, x, y = _columns(panel)
            write_table([names], [x, y], out)
    _say([*drawn.caption, *drawn.remarks], out)


def _write_field(panel: Panel, field: Field, out: TextIO) -> None:
    """Write a row for each round value of y, a sign at a number for each region, and their key below.

    The table has as many columns as fit the terminal.
    """
    y = panel.y.at_round_values(ROWS)
    of_y, unit_of_y = _texts(y)
    for count in range(COLUMNS, 0, -1):
        x = panel.x.at_round_values(count)
        of_x, unit_of_x = _texts(x)
        values = evaluate(field.scene, field.quantity, x, y)
        cells, seen = _cells(field, x, y, values)
        rows = [(head, *of_row) for head, of_row in zip(of_y, cells, strict=True)]
        columns = columns_of([(quantity_of(y.name).symbol, *of_x), *rows[::-1]], texts=1)
        heads, *aligned = zip(*map(padded, columns), strict=True)
        if width_of(_GAP.join(heads)) <= terminal_width():
            break
    _say([f"Down: {described(y.name, unit_of_y)}. Across: {described(x.name, unit_of_x)}."], out)
    say(_GAP.join(heads).rstrip(), out)
    has_colours = out.isatty() and "NO_COLOR" not in os.environ and os.environ.get("TERM", "dumb") != "dumb"
    for (head, *texts), places in zip(aligned, _places(field, values[::-1]), strict=True):
        painted = map(_painted, texts, places) if has_colours else texts
        say(_GAP.join([head, *painted]).rstrip(), out)
    key = [f"{region.sign} {region.text}" for region in field.regions if region.sign in seen]
    gaps = [f"{NO_VALUE} no value"] if not numpy.isfinite(values).all() else []
    _say([*key, *gaps, "; ".join(_marks(panel, field))], out)


def _cells(field: Field, x: Axis, y: Axis, values: Any) -> tuple[list[list[str]], str]:
    """Return the cells of a field at values of x and y, and the signs in them."""
    known = numpy.isfinite(values)
    texts, signs = numpy.full((2, *values.shape), "", dtype=object)
    texts[~known] = NO_VALUE
    texts[known], _ = field.in_words(values[known].tolist(), DIGITS)
    if field.printed:
        printed, _ = field.in_words(evaluate(field.scene, field.printed, x, y)[known].tolist(), DIGITS)
        texts[known] += [f" ({text})" for text in printed]
    here = over(field.scene, x, y)
    for region in field.regions:
        signs[known & numpy.broadcast_to(region.excess(here) > 0, values.shape)] += region.sign
    for column in range(x.size):  # numbers stand below each other, whichever signs they have
        if width := max(map(len, signs[:, column])):
            texts[:, column] += [f" {sign:{width}}" for sign in signs[:, column]]
    return texts.tolist(), "".join(signs.ravel().tolist())


def _texts(axis: Axis) -> tuple[list[str], str]:
    """Return the values of an axis as texts, and their unit, which is empty where each has its own."""
    return in_units(quantity_of(axis.name).unit, axis.values().tolist(), DIGITS + 1, is_log=axis.is_log)


def _places(field: Field, values: Any) -> list[list[float]]:
    """Return the places of values between the least of a field, 0, and the largest, 1; nan where there is none."""
    scale = numpy.log10 if field.is_log else numpy.asarray
    low, high = (scale(end) for end in extent(field.values))
    with numpy.errstate(all="ignore"):
        places: list[list[float]] = numpy.clip((scale(values) - low) / (high - low), 0, 1).tolist()
    return places


def _painted(text: str, place: float) -> str:
    """Return a text on paper of the colour of its number."""
    if not isfinite(place):
        return text
    return f"\x1b[30;48;5;{_PAPERS[min(int(place * len(_PAPERS)), len(_PAPERS) - 1)]}m{text}\x1b[0m"


def _marks(panel: Panel, field: Field) -> Iterator[str]:
    """Iterate over the marks of a field: each with its place on an axis, or, at a point, with the value there."""
    for mark in panel.marks:
        given = {axis.name: value for axis, value in ((panel.x, mark.x), (panel.y, mark.y)) if value is not None}
        if len(given) == 2:
            point = field.scene.replace(**panel.x.inputs(mark.x), **panel.y.inputs(mark.y))
            given = point.numbers(field.quantity) or {field.quantity: nan}
        for name, value in given.items():
            shown = amount(name, float(f"{value:.{DIGITS + 1}g}")) if isfinite(value) else NO_VALUE
            yield f"{mark.text}: {symbol(name)} = {shown}"


def _columns(panel: Panel) -> list[Column]:
    """Return the columns of a panel of curves: the curve or the point, x and y."""
    rows: list[tuple[str, float, float]] = []
    for curve in panel.curves:
        x, y = (values[panel.x.has(curve.x) & panel.y.has(curve.y)] for values in (curve.x, curve.y))
        some = numpy.linspace(0, len(x) - 1, min(CURVE_ROWS, len(x))).round().astype(int)
        rows += [(plain(curve.text), *point) for point in zip(x[some].tolist(), y[some].tolist(), strict=True)]
    rows += [(plain(mark.text), mark.x, mark.y) for mark in panel.marks if mark.x is not None and mark.y is not None]
    names, *numbers = zip(*rows, strict=True)
    columns = [Column("", names, is_right=False)]
    for axis, values in zip((panel.x, panel.y), numbers, strict=True):
        texts, unit = in_units(quantity_of(axis.name).unit, values, DIGITS + 1, is_log=axis.is_log)
        columns.append(Column(quantity_of(axis.name).symbol + bracketed(unit), texts))
    return columns


def _say(texts: Iterable[str], out: TextIO) -> None:
    """Print texts in lines that fit the terminal."""
    for text in filter(None, texts):
        for line in wrapped(plain(text), terminal_width()):
            say(line, out)
