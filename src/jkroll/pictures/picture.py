"""Pictures as data: panels with curves, or with a field over two inputs; and how a terminal shows their numbers."""

import os
from collections.abc import Callable, Iterable, Mapping, Sequence
from itertools import product
from math import ceil, floor, isfinite, log10
from types import MappingProxyType
from typing import Any, NamedTuple, TextIO

import numpy

from ..model.frame import Frame
from ..model.solver import values_of
from ..quantities.formatting import in_units
from ..quantities.markup import marked, plain
from ..quantities.nomenclature import NOMENCLATURE, bracketed, header
from ..quantities.quantity import Quantity
from ..text import TextColumn, capital, padded, say, say_wrapped, terminal_width, width_of, write_table
from .bands import Band

_WIDE = 30.0  # ratio of the ends above which contours and axes of curves are logarithmic
SAME = 1e-9  # relative difference below which values differ only by rounding

# Quantities on the axes of figures that a frame does not have.
_OF_FIGURES: Mapping[str, Quantity] = {
    "position_across": Quantity("x", "m", "position from the contact point"),
    "position_beside": Quantity("y", "m", "position perpendicular to the rolling direction"),
    "position_upwards": Quantity("z", "m", "position along the line of centres"),
    "pressure_across": Quantity("p", "Pa", "pressure, tension negative"),
    "time_of_a_point": Quantity("t", "s", "time of a point"),
    "error": Quantity("", "1", "error in ulp/(1+κ)"),
    "residual_load": Quantity("F − P", "N", "measured load minus the fitted load"),
    "energy_release_rate": Quantity("G", "J/m^2", "energy release rate by JKR"),
}


class Axis(NamedTuple):
    """The range of a quantity that belongs to the nomenclature or only to figures."""

    name: str
    low: float
    high: float
    is_log: bool = True
    size: int = 0  # number of values; 0: the picture's default
    needs: Mapping[str, float] = MappingProxyType({})  # further inputs that a frame needs

    def inputs(self, values: Any) -> dict[str, Any]:
        """Return the inputs of a frame at some values on the axis."""
        return {**self.needs, self.name: values}

    def has(self, values: Any) -> Any:
        """Return whether a value, or each element of an array, lies between the ends."""
        return (self.low <= values) & (values <= self.high)

    def header(self) -> str:
        """Return the column header of the values: name and unit."""
        return header(self.name, quantity_of(self.name).unit)

    def values(self) -> Any:
        """Return the values as an array, equally spaced along the axis."""
        spaced = numpy.geomspace if self.is_log else numpy.linspace
        return spaced(self.low, self.high, self.size)

    def in_words(self, values: Sequence[float], digits: int) -> tuple[list[str], str]:
        """Return values on the axis as texts, and their unit, which is empty if each text has its own."""
        every = [*values, *((self.low, self.high) if self.is_log else ())]  # so that all numbers of the axis look alike
        texts, unit = in_units(quantity_of(self.name).unit, every, digits, is_log=self.is_log)
        return texts[: len(values)], unit


class Mark(NamedTuple):
    """A point of a picture, or a position on one of its axes."""

    text: str
    x: float | None
    y: float | None


class Rows(NamedTuple):
    """The points of a curve that a terminal shows, with their best ranges as texts, if they have any."""

    x: Any
    y: Any
    best: tuple[str, ...] = ()
    by: tuple[str, ...] = ()


class Curve(NamedTuple):
    """A line through points. Curves that belong together share a colour."""

    text: str
    x: Any
    y: Any
    colour: int = 0
    is_dashed: bool = False
    has_points: bool = False  # True to draw its points without a line
    band: Band | None = None
    key: str = ""  # explains line and band in a legend
    rows: Rows | None = None  # that a terminal shows; None: points at equal steps


class Arrow(NamedTuple):
    """An arrow of a sketch, or a line without a head, with a text next to it."""

    start: tuple[float, float]
    stop: tuple[float, float]
    text: str = ""
    text_at: tuple[float, float] = (0.0, 0.0)  # middle of the text
    ends: int = 1  # number of heads
    bend: float = 0.0  # height of the arc, to the left, over the length of its chord


class Region(NamedTuple):
    """The region beyond a limit of the model: the points with a positive excess.

    A terminal adds the sign to the numbers in the region. A page fills the region with the hatch or, without a hatch,
    bounds it by a line with the name.
    """

    text: str
    where: str  # in words; empty if everywhere
    sign: str
    hatch: str
    name: str
    excess: Callable[[Frame], Any]  # the excess for a frame of arrays


class Field(NamedTuple):
    """A quantity over both axes of a panel."""

    quantity: str
    frame: Frame  # the inputs that are the same everywhere
    values: Any  # on a coarse mesh, with a row for each y; nan where there is no value
    regions: tuple[Region, ...]
    printed: str = ""  # the quantity as the paper prints it, if that differs
    gaps: tuple[str, ...] = ()  # the reasons why a part has no value
    has_best: bool = False  # True to show the best ranges on a page

    @property
    def is_log(self) -> bool:
        """True if contours are at steps of the logarithm."""
        return is_wide(self.values)

    def in_words(self, values: Sequence[float], digits: int = 12) -> tuple[list[str], str]:
        """Return values as texts, and the unit of all numbers of the field, which is empty if each has its own."""
        every = [*values, *extent(self.values)]
        texts, unit = in_units(NOMENCLATURE[self.quantity].unit, every, digits, is_log=self.is_log)
        return texts[: len(values)], unit


class Panel(NamedTuple):
    """Axes with curves or a field, and marks."""

    x: Axis
    y: Axis
    curves: tuple[Curve, ...] = ()
    marks: tuple[Mark, ...] = ()
    title: str = ""
    field: Field | None = None
    is_true_to_scale: bool = False
    has_axes: bool = True
    arrows: tuple[Arrow, ...] = ()


class Picture(NamedTuple):
    """Panels next to each other, with a title and a caption."""

    title: str
    panels: tuple[Panel, ...]
    caption: tuple[str, ...]
    doubts: tuple[str, ...] = ()  # below the caption, each on a new line
    remarks: tuple[str, ...] = ()  # shown in a terminal and in Python, but not on a page


# --- Axes -------------------------------------------------------------------------------------------------------------


def quantity_of(name: str) -> Quantity:
    """Return the quantity that an axis shows."""
    return _OF_FIGURES.get(name) or NOMENCLATURE[name]


def described(name: str, unit: str = "") -> str:
    """Return a quantity as the title of an axis, with its symbol marked as mathematics.

    >>> described("load", "nN")
    'load (a pull is negative), ⟦P⟧ [nN]'
    """
    quantity = quantity_of(name)
    sentence, _, remark = marked(quantity.sentence).partition("; ")
    if remark:
        sentence += f" ({remark})"
    return sentence + (f", ⟦{quantity.symbol}⟧" if quantity.symbol else "") + bracketed(unit)


def axis_around(name: str, values: Iterable[Any], *, may_be_log: bool = False, margin: float = 0.05) -> Axis:
    """Return an axis that holds all finite values; logarithmic if that is allowed and they span orders of magnitude."""
    known = numpy.concatenate([numpy.ravel(array) for array in values])
    low, high = extent(known)
    if may_be_log and is_wide(known):
        return Axis(name, low / (1 + 4 * margin), high * (1 + 4 * margin))
    if is_flat(known):  # rounding must not look like a difference
        ends = (min(0.0, 2 * low), max(0.0, 2 * high)) if low else (-1.0, 1.0)
        return Axis(name, *ends, is_log=False)
    room = (high - low) * margin
    return Axis(name, low - room, high + room, is_log=False)


# --- Values -----------------------------------------------------------------------------------------------------------


def over(frame: Frame, x: Axis, y: Axis | None = None) -> Frame:
    """Return a frame of arrays along one axis or over two, with a row for each value of y."""
    if y is None:
        return frame.replace(**x.inputs(x.values()))
    return frame.replace(**x.inputs(x.values()[None, :]), **y.inputs(y.values()[:, None]))


def evaluate(frame: Frame, quantity: str, x: Axis, y: Axis | None = None) -> Any:
    """Return a quantity along one axis or over two; nan where it has no value."""
    shape = (x.size,) if y is None else (y.size, x.size)
    return numpy.broadcast_to(values_of(over(frame, x, y), [quantity])[quantity], shape)


def one_further(values: Any) -> Any:
    """Return values in which each missing value next to known ones is the mean of its known neighbours.

    Lines then extend beyond the edge of the part with values; the picture cuts them off at the edge.
    """
    known = numpy.isfinite(values)
    total, count = numpy.zeros(values.shape), numpy.zeros(values.shape)
    inner = numpy.pad(numpy.where(known, values, 0.0), 1), numpy.pad(known.astype(float), 1)
    height, width = values.shape
    for down in range(3):
        for right in range(3):
            total += inner[0][down : down + height, right : right + width]
            count += inner[1][down : down + height, right : right + width]
    return numpy.where(known, values, numpy.where(count > 0, total / numpy.maximum(count, 1), numpy.nan))


def extent(values: Any) -> tuple[float, float]:
    """Return the smallest and the largest finite value; zeros if there are none."""
    known = values[numpy.isfinite(values)]
    return (float(known.min()), float(known.max())) if known.size else (0.0, 0.0)


def is_flat(values: Any) -> bool:
    """Return True if all finite values are equal but for rounding."""
    low, high = extent(values)
    return high - low <= SAME * max(abs(low), abs(high))


def is_wide(values: Any) -> bool:
    """Return True if values are positive and span orders of magnitude."""
    low, high = extent(values)
    return low > 0 and high > _WIDE * low


def clipped(curve: Curve, low: float, high: float) -> Curve:
    """Return the part of a monotonic curve between two values of y, which ends where the curve crosses them."""
    x, y = (curve.x, curve.y) if curve.y[0] <= curve.y[-1] else (curve.x[::-1], curve.y[::-1])
    ends = [end for end in (low, high) if y[0] <= end <= y[-1]]
    inside = numpy.union1d(y[(low <= y) & (y <= high)], ends)
    return curve._replace(x=numpy.interp(inside, y, x), y=inside)


# --- The numbers of a picture in a terminal: a field as a table, curves as rows ---------------------------------------

ROWS, COLUMNS = 13, 9  # largest size of the table of a field
CURVE_ROWS = 11  # largest number of rows for a curve
DIGITS = 3
_DIGITS = ("1 2 5", "1 3", "1")  # in each decade; the first set that fits is used
# Sets with more digits, for axes on which no set of _DIGITS gives _FEW values.
_MORE = (" ".join(f"{digit / 10:g}" for digit in range(10, 100)), "1 1.2 1.5 2 2.5 3 4 5 6 8", "1 1.5 2 3 5 7")
_FEW = 4  # number of values below which an axis takes more digits
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
    """Write a row for each value of y, with a sign after each number in a region, and a key of the signs below.

    The table has as many columns as fit the terminal.
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
    of_like = " R2 = R1." if {"radius", "radius2"} & frame.given.keys() == {"radius"} else ""
    say_texts([axes + of_like], out)
    say(_GAP.join(head).rstrip(), out)
    has_colours = out.isatty() and "NO_COLOR" not in os.environ and os.environ.get("TERM", "dumb") != "dumb"
    for (head_of_row, *texts), numbers in zip(rows, values, strict=True):
        shown = _painted(field, texts, numbers) if has_colours else texts
        say(_GAP.join([head_of_row, *shown]).rstrip(), out)
    keys = [f"{region.sign} {region.text}" for region in field.regions if region.sign and region.sign in signs]
    if not numpy.isfinite(values).all():
        keys.append(": ".join(filter(None, (f"{NO_VALUE} no value", "; ".join(field.gaps)))))
    say_texts(keys, out)
    say_texts([f"{capital(region.text)} ({region.where})." for region in field.regions if not region.sign], out)


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
    bands = [*numpy.digitize(scale(numbers), edges)]
    painted = []
    for text, number, band in zip(texts, numbers, bands, strict=True):
        painted.append(f"\x1b[30;48;5;{_PAPERS[band]}m{text}\x1b[0m" if isfinite(number) else text)
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
    """Return points of a curve within the axes, at equal steps along its arrays."""
    x, y = (values[panel.x.has(curve.x) & panel.y.has(curve.y)] for values in (curve.x, curve.y))
    some = numpy.linspace(0, len(x) - 1, min(CURVE_ROWS, len(x))).round().astype(int)
    return Rows(x[some], y[some])


def say_texts(texts: Iterable[str], out: TextIO) -> None:
    """Print texts; on a terminal, wrap them."""
    for text in filter(None, texts):
        say_wrapped(plain(text), out, indent=0)


# --- Styles of a page -------------------------------------------------------------------------------------------------


class Style(NamedTuple):
    """The colours of a page: paper, ink, hatches, the bands of a map from low to high, and curves.

    The lightness of the bands changes steadily, so that their order shows in grey and to the colour-blind, and ink is
    legible on each of them.
    """

    paper: str
    ink: str
    hatch: str
    bands: tuple[str, ...]
    lines: tuple[str, ...]


# ColorBrewer's GnBu without its ends, and a dark counterpart. The curves have the colours of Okabe and Ito.
PAPER = Style(
    "#ffffff", "#000000", "#555555",
    ("#e8f6e2", "#ccebc5", "#a8ddb5", "#7bccc4", "#4eb3d3"),
    ("#0072b2", "#d55e00", "#009e73", "#cc79a7", "#56b4e9", "#000000"),
)  # fmt: skip
DARK = Style(
    "#12151c", "#f2f2f2", "#a0a4ad",
    ("#182442", "#183a5c", "#1a526e", "#266c78", "#42867e"),
    ("#56b4e9", "#e69f00", "#009e73", "#cc79a7", "#f0e442", "#f2f2f2"),
)  # fmt: skip
STYLES = {"paper": PAPER, "dark": DARK}
