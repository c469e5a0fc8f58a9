"""The numbers of a picture in a terminal: a field as a table, curves as rows."""

import os
from collections.abc import Iterable, Sequence
from itertools import product
from math import ceil, floor, isfinite, log10
from typing import Any, TextIO

import numpy

from ..model.frame import Frame
from ..model.solver import values_of
from ..quantities.markup import plain
from ..quantities.nomenclature import bracketed
from ..text import TextColumn, capital, padded, say, say_wrapped, terminal_width, width_of, write_table
from .picture import SAME, Axis, Curve, Field, Panel, Picture, Rows, described, extent, quantity_of

ROWS, COLUMNS = 13, 9  # largest size of the table of a field
CURVE_ROWS = 11  # largest number of rows for a curve
DIGITS = 3
_DIGITS = ("1 2 5", "1 3", "1")  # round values of a decade; the first set that fits is used
# Sets with more values, for axes on which no set of _DIGITS gives _FEW values.
_MORE = (" ".join(f"{tenths / 10:g}" for tenths in range(10, 100)), "1 1.2 1.5 2 2.5 3 4 5 6 8", "1 1.5 2 3 5 7")
_FEW = 4  # number of values below which an axis takes a set with more values
_NARROW = 1.5  # ratio of the ends below which the steps of a logarithmic axis are equal
NO_VALUE = "—"
_GAP = "  "  # between columns
_PAPERS = (230, 194, 152, 116, 74)  # backgrounds of low to high numbers: the terminal colours nearest to the page's


def write_picture(drawn: Picture, out: TextIO) -> None:
    """Write the caption, then the panels: a table of a field, or some rows of each curve and the marked points."""
    say_texts(opening(drawn), out)
    for panel in drawn.panels:
        if not panel.has_axes:  # a sketch has no numbers
            continue
        say_texts([panel.title], out)
        if panel.field is not None:
            _write_field(panel, panel.field, out)
        else:
            names, *columns = _columns(panel)
            write_table([names], columns, out)
    say_texts([*drawn.doubts, *drawn.remarks], out)


def opening(drawn: Picture) -> tuple[str, ...]:
    """Return the caption of a picture, after its title if the caption does not begin with the title."""
    first, *_ = (*drawn.caption, "")
    has_title = first.startswith(capital(drawn.title))
    return drawn.caption if has_title else (drawn.title, *drawn.caption)


def shown_values(axis: Axis, most: int) -> Any:
    """Return at most `most` values of an axis: its own if they are few enough, else round or equally spaced values."""
    if 0 < axis.size <= most:
        return axis.values()
    if not axis.is_log or axis.high < _NARROW * axis.low:
        decade = 10.0 ** floor(log10((axis.high - axis.low) / most))
        steps = (decade * digit for digit in (1, 2, 5, 10))
        for step in steps:
            low, high = ceil(axis.low / step - SAME), floor(axis.high / step + SAME)
            if high - low < most:
                break
        # Rounding may have put values beyond the ends.
        return numpy.clip(numpy.arange(low, high + 1) * step, axis.low, axis.high)
    decades = range(floor(log10(axis.low)), floor(log10(axis.high)) + 1)

    def round_values(digits: str) -> Any:
        every = numpy.array([float(f"{digit}e{decade}") for decade, digit in product(decades, digits.split())])
        return every[axis.has(every)]

    for choices, least in ((_DIGITS, min(_FEW, most)), (_MORE, 2), (_DIGITS, 2)):
        for values in map(round_values, choices):
            if least <= len(values) <= most:
                return values
    return axis._replace(size=most).values()


def _write_field(panel: Panel, field: Field, out: TextIO) -> None:
    """Write a table with some values of x across and of y down, and the key of its signs.

    Each number is followed by the signs of its regions. The table has as many columns as fit the terminal.
    """
    y = shown_values(panel.y, ROWS)[::-1]
    heads_of_y, unit_of_y = panel.y.in_words(y.tolist(), DIGITS + 1)
    for count in range(COLUMNS, 0, -1):
        x = shown_values(panel.x, count)
        heads, unit_of_x = panel.x.in_words(x.tolist(), DIGITS + 1)
        frame = field.frame.replace(**panel.x.inputs(x[None, :]), **panel.y.inputs(y[:, None]))
        values = numpy.broadcast_to(values_of(frame, [field.quantity])[field.quantity], (y.size, x.size))
        cells, signs = _cells(field, frame, values)
        columns = [
            TextColumn(quantity_of(panel.y.name).symbol, heads_of_y, is_right=False),
            *map(TextColumn, heads, cells),
        ]
        head, *rows = zip(*map(padded, columns), strict=True)
        if width_of(_GAP.join(head)) <= terminal_width():
            break
    axes = f"Down: {described(panel.y.name, unit_of_y)}. Across: {described(panel.x.name, unit_of_x)}."
    equal_spheres = " R2 = R1." if {"radius", "radius2"} & frame.given.keys() == {"radius"} else ""
    say_texts([axes + equal_spheres], out)
    say(_GAP.join(head).rstrip(), out)
    has_colours = out.isatty() and "NO_COLOR" not in os.environ and os.environ.get("TERM", "dumb") != "dumb"
    for (head_of_row, *texts), numbers in zip(rows, values, strict=True):
        shown = _painted(field, texts, numbers) if has_colours else texts
        say(_GAP.join([head_of_row, *shown]).rstrip(), out)
    say_texts(_keys(field, values, signs), out)
    say_texts([f"{capital(region.text)} ({region.where})." for region in field.regions if not region.sign], out)


def _keys(field: Field, values: Any, signs: str) -> list[str]:
    """Return the meanings of the signs in a table, and the reasons for its missing values, if it has any."""
    keys = [f"{region.sign} {region.text}" for region in field.regions if region.sign and region.sign in signs]
    if not numpy.isfinite(values).all():
        keys.append(": ".join(filter(None, (f"{NO_VALUE} no value", "; ".join(field.gaps)))))
    return keys


def _cells(field: Field, frame: Frame, values: Any) -> tuple[list[list[str]], str]:
    """Return the values of a field as columns of texts with the signs of their regions, and a text of all signs."""
    known = numpy.isfinite(values)
    texts, signs = numpy.full((2, *values.shape), "", dtype=object)
    texts[~known] = NO_VALUE
    texts[known], _ = field.in_words(values[known].tolist(), DIGITS)
    for region in field.regions:
        signs[known & numpy.broadcast_to(region.excess(frame) > 0, values.shape)] += region.sign
    for signs_of_column, texts_of_column in zip(signs.T, texts.T, strict=True):
        width = max(map(len, signs_of_column))
        if width:  # pad, so that numbers are aligned whichever signs they have
            texts_of_column += [f" {sign:{width}}" for sign in signs_of_column]
    return texts.T.tolist(), "".join(signs.ravel().tolist())


def _painted(field: Field, texts: Sequence[str], numbers: Any) -> list[str]:
    """Return texts with backgrounds in the colours of their numbers."""
    scale = numpy.log10 if field.is_log else numpy.asarray
    low, high = extent(field.values)
    edges = numpy.linspace(scale(low), scale(high), len(_PAPERS) + 1)[1:-1]
    steps = [*numpy.digitize(scale(numbers), edges)]
    painted = []
    for text, number, step in zip(texts, numbers, steps, strict=True):
        painted.append(f"\x1b[30;48;5;{_PAPERS[step]}m{text}\x1b[0m" if isfinite(number) else text)
    return painted


def _columns(panel: Panel) -> list[TextColumn]:
    """Return the columns of a panel of curves: the name of the curve or point, x, y and, if known, best ranges."""
    rows: list[tuple[str, float, float, str, str]] = []
    for curve in panel.curves:
        x, y, best, by = curve.rows or _some_of(curve, panel)
        empty = ("",) * len(x)
        rows += zip([plain(curve.text)] * len(x), x.tolist(), y.tolist(), best or empty, by or empty, strict=True)
    for mark in panel.marks:
        if mark.x is not None and mark.y is not None:
            rows.append((plain(mark.text), mark.x, mark.y, "", ""))
    names, *numbers, best, by = zip(*rows, strict=True)
    columns = [TextColumn("", names, is_right=False)]
    for axis, values in zip((panel.x, panel.y), numbers, strict=True):
        texts, unit = axis.in_words(values, DIGITS + 1)
        columns.append(TextColumn(quantity_of(axis.name).symbol + bracketed(unit), texts))
    if any(best):
        columns += [TextColumn("best range", best), TextColumn("by", by, is_right=False)]
    return columns


def _some_of(curve: Curve, panel: Panel) -> Rows:
    """Return some points of a curve within the axes, at equal steps along its arrays."""
    x, y = (values[panel.x.has(curve.x) & panel.y.has(curve.y)] for values in (curve.x, curve.y))
    some = numpy.linspace(0, len(x) - 1, min(CURVE_ROWS, len(x))).round().astype(int)
    return Rows(x[some], y[some])


def say_texts(texts: Iterable[str], out: TextIO) -> None:
    """Print texts; on a terminal, wrap them."""
    for text in filter(None, texts):
        say_wrapped(plain(text), out, indent=0)
