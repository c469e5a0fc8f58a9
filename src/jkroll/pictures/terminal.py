"""Pictures in a terminal: a field as a table of numbers, curves as rows."""

import os
from collections.abc import Iterable, Sequence
from math import ceil, floor, isfinite, log10
from typing import Any, TextIO

import numpy

from ..output.table import Column, padded, write_table
from ..quantities.markup import plain
from ..scene.scene import Scene
from ..scene.solver import values_of
from ..text import say, say_wrapped, terminal_width, width_of
from .picture import Axis, Field, Panel, Picture, bracketed, described, extent, over_values, quantity_of

ROWS, COLUMNS = 13, 9  # of a field
CURVE_ROWS = 11  # of each curve
DIGITS = 3
_DIGITS = ((1, 2, 5), (1, 3), (1,))  # of each decade, the most that have room
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


def shown(axis: Axis, most: int) -> Any:
    """Return at most so many values of an axis: its own if they are so few, else round ones, or equally spaced ones."""
    if 0 < axis.size <= most:
        return axis.values()
    values = axis._replace(size=most).values()
    if axis.is_log:
        decades = range(floor(log10(axis.low)), floor(log10(axis.high)) + 1)
        choices = [[float(f"{digit}e{decade}") for decade in decades for digit in digits] for digits in _DIGITS]
    else:
        decade = 10.0 ** floor(log10((axis.high - axis.low) / most))
        steps = [decade * digit for digit in (1, 2, 5, 10)]
        choices = [(numpy.arange(ceil(axis.low / step), floor(axis.high / step) + 1) * step).tolist() for step in steps]
    insides = (numpy.array([*filter(axis.has, choice)]) for choice in choices)
    return next((inside for inside in insides if 1 < len(inside) <= most), values)


def _write_field(panel: Panel, field: Field, out: TextIO) -> None:
    """Write a row for each value of y, a sign at a number for each region, and their key below.

    The table has as many columns as fit the terminal.
    """
    of_y = shown(panel.y, ROWS)[::-1]
    heads_of_y, unit_of_y = panel.y.in_words(of_y.tolist(), DIGITS + 1)
    for count in range(COLUMNS, 0, -1):
        of_x = shown(panel.x, count)
        heads, unit_of_x = panel.x.in_words(of_x.tolist(), DIGITS + 1)
        here = over_values(field.scene, panel.x, of_x, panel.y, of_y)
        values = numpy.broadcast_to(values_of(here, [field.quantity])[field.quantity], (of_y.size, of_x.size))
        cells, seen = _cells(field, here, values)
        columns = [Column(quantity_of(panel.y.name).symbol, heads_of_y, is_right=False), *map(Column, heads, cells)]
        head, *rows = zip(*map(padded, columns), strict=True)
        if width_of(_GAP.join(head)) <= terminal_width():
            break
    _say([f"Down: {described(panel.y.name, unit_of_y)}. Across: {described(panel.x.name, unit_of_x)}."], out)
    say(_GAP.join(head).rstrip(), out)
    has_colours = out.isatty() and "NO_COLOR" not in os.environ and os.environ.get("TERM", "dumb") != "dumb"
    for (of_row, *texts), numbers in zip(rows, values, strict=True):
        say(_GAP.join([of_row, *(_painted(field, texts, numbers) if has_colours else texts)]).rstrip(), out)
    gaps = [f"{NO_VALUE} no value"] if not numpy.isfinite(values).all() else []
    _say([*(f"{region.sign} {region.text}" for region in field.regions if region.sign in seen), *gaps], out)


def _cells(field: Field, here: Scene, values: Any) -> tuple[list[list[str]], str]:
    """Return the columns of the values of a field, with signs where they are in a region, and all these signs."""
    known = numpy.isfinite(values)
    texts, signs = numpy.full((2, *values.shape), "", dtype=object)
    texts[~known] = NO_VALUE
    texts[known], _ = field.in_words(values[known].tolist(), DIGITS)
    for region in field.regions:
        signs[known & numpy.broadcast_to(region.excess(here) > 0, values.shape)] += region.sign
    for of_column, texts_of_column in zip(signs.T, texts.T, strict=True):
        if width := max(map(len, of_column)):  # numbers stand below each other, whichever signs they have
            texts_of_column += [f" {sign:{width}}" for sign in of_column]
    return texts.T.tolist(), "".join(signs.ravel().tolist())


def _painted(field: Field, texts: Sequence[str], numbers: Any) -> list[str]:
    """Return texts on paper of the colours of their numbers."""
    scale = numpy.log10 if field.is_log else numpy.asarray
    low, high = extent(field.values)
    edges = numpy.linspace(scale(low), scale(high), len(_PAPERS) + 1)[1:-1]
    bands = [*numpy.digitize(scale(numbers), edges)]
    return [
        f"\x1b[30;48;5;{_PAPERS[band]}m{text}\x1b[0m" if isfinite(number) else text
        for text, number, band in zip(texts, numbers, bands, strict=True)
    ]


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
        texts, unit = axis.in_words(values, DIGITS + 1)
        columns.append(Column(quantity_of(axis.name).symbol + bracketed(unit), texts))
    return columns


def _say(texts: Iterable[str], out: TextIO) -> None:
    """Print texts, on a terminal in lines that fit."""
    for text in filter(None, texts):
        say_wrapped(plain(text), out, indent=0)
