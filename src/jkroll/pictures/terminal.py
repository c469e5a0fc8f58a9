"""Maps and curves in a terminal: a map as a table of numbers, curves as rows."""

import os
from collections.abc import Iterable, Iterator
from math import isfinite, nan
from typing import Any, TextIO

import numpy

from ..output.table import Column, columns_of, padded, write_table
from ..quantities.formatting import amount, in_units
from ..quantities.markup import plain, symbol
from ..text import say, terminal_width, width_of, wrapped
from .picture import LOOKS, PAPER, Axis, Map, Panel, Picture, bracketed, described, evaluate, extent, over, quantity_of

ROWS, COLUMNS = 13, 9  # of a map
CURVE_ROWS = 11  # of each curve
DIGITS = 3
NO_VALUE = "—"
_GAP = "  "  # between columns


def write_map(drawn: Map, out: TextIO) -> None:
    """Write a map as a table: a row for each round value of y, a mark on a number for each doubt, and their key below.

    It has as many columns as fit the terminal.
    """
    y = drawn.y.at_round_values(ROWS)
    of_y, unit_of_y = _texts(y)
    for count in range(COLUMNS, 0, -1):
        x = drawn.x.at_round_values(count)
        of_x, unit_of_x = _texts(x)
        values = evaluate(drawn.scene, drawn.quantity, x, y)
        cells, unit, seen = _cells(drawn, x, y, values)
        rows = [(head, *of_row) for head, of_row in zip(of_y, cells, strict=True)]
        columns = columns_of([(quantity_of(y.name).symbol, *of_x), *rows[::-1]], texts=1)
        heads, *aligned = zip(*map(padded, columns), strict=True)
        if width_of(_GAP.join(heads)) <= terminal_width():
            break
    _say([drawn.titled(unit), f"Down: {described(y.name, unit_of_y)}. Across: {described(x.name, unit_of_x)}."], out)
    say(_GAP.join(heads).rstrip(), out)
    has_colours = out.isatty() and "NO_COLOR" not in os.environ and os.environ.get("TERM", "dumb") != "dumb"
    for (head, *texts), shares in zip(aligned, _shares(drawn, values[::-1]), strict=True):
        painted = map(_painted, texts, shares) if has_colours else texts
        say(_GAP.join([head, *painted]).rstrip(), out)
    signs = ((LOOKS[region.look].sign, region.text) for region in drawn.regions)
    key = [f"{sign} {text}" for sign, text in signs if sign in seen]
    gaps = [f"{NO_VALUE} no value"] if not numpy.isfinite(values).all() else []
    _say([*key, *gaps, "; ".join(_marks(drawn)), *drawn.caption, *drawn.remarks], out)


def _cells(drawn: Map, x: Axis, y: Axis, values: Any) -> tuple[list[list[str]], str, str]:
    """Return the cells of a map at values of x and y, the unit of their numbers, and the signs in them."""
    known = numpy.isfinite(values)
    texts, signs = numpy.full((2, *values.shape), "", dtype=object)
    texts[~known] = NO_VALUE
    texts[known], unit = drawn.in_words(values[known].tolist(), DIGITS)
    if drawn.printed:
        printed, _ = drawn.in_words(evaluate(drawn.scene, drawn.printed, x, y)[known].tolist(), DIGITS)
        texts[known] += [f" ({text})" for text in printed]
    here = over(drawn.scene, x, y)
    for region in drawn.regions:
        signs[known & numpy.broadcast_to(region.excess(here) > 0, values.shape)] += LOOKS[region.look].sign
    for column in range(x.size):  # numbers stand below each other, whichever signs they have
        if width := max(map(len, signs[:, column])):
            texts[:, column] += [f" {sign:{width}}" for sign in signs[:, column]]
    return texts.tolist(), unit, "".join(signs.ravel().tolist())


def _texts(axis: Axis) -> tuple[list[str], str]:
    """Return the values of an axis as texts, and their unit, which is empty where each has its own."""
    return in_units(quantity_of(axis.name).unit, axis.values().tolist(), DIGITS + 1, is_log=axis.is_log)


def _shares(drawn: Map, values: Any) -> list[list[float]]:
    """Return the places of values between the least, 0, and the largest, 1, of a map; nan where there is none."""
    scale = numpy.log10 if drawn.is_log else numpy.asarray
    low, high = (scale(end) for end in extent(drawn.values))
    with numpy.errstate(all="ignore"):
        shares: list[list[float]] = numpy.clip((scale(values) - low) / (high - low), 0, 1).tolist()
    return shares


def _painted(text: str, share: float) -> str:
    """Return a text on paper of the colour of its number, in the 216 colours that terminals have."""
    if not isfinite(share):
        return text
    red, green, blue = (round(5 * channel) for channel in PAPER.band(share))
    return f"\x1b[30;48;5;{16 + 36 * red + 6 * green + blue}m{text}\x1b[0m"


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
        names, x, y = _columns(panel)
        write_table([names], [x, y], out)
    _say([*drawn.caption, *drawn.remarks], out)


def _columns(panel: Panel) -> list[Column]:
    """Return the columns of a panel: the curve or the point, x and y."""
    rows: list[tuple[str, float, float]] = []
    for curve in panel.curves:
        points = [(x, y) for x, y in zip(curve.x.tolist(), curve.y.tolist(), strict=True) if panel.shows(x, y)]
        last, steps = len(points) - 1, min(CURVE_ROWS, len(points)) - 1
        rows += [(plain(curve.text), *points[round(last * step / max(steps, 1))]) for step in range(steps + 1)]
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
