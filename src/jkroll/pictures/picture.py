"""Pictures as data: panels with curves, or with a field over two inputs; and the colours of a page."""

from collections.abc import Callable, Iterable, Mapping, Sequence
from types import MappingProxyType
from typing import Any, NamedTuple

import numpy

from ..model.frame import Frame
from ..model.solver import values_of
from ..quantities.formatting import texts_on_scale
from ..quantities.markup import marked
from ..quantities.nomenclature import NOMENCLATURE, bracketed, header
from ..quantities.quantity import Quantity
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
        texts, unit = texts_on_scale(quantity_of(self.name).unit, every, digits, is_log=self.is_log)
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
        texts, unit = texts_on_scale(NOMENCLATURE[self.quantity].unit, every, digits, is_log=self.is_log)
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
    doubts: tuple[str, ...] = ()  # exceeded limits and materials left out, each on a new line below the caption
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


def extended(values: Any) -> Any:
    """Return values on a mesh in which each missing value next to known ones is the mean of its known neighbours.

    Lines then extend beyond the part with values; the picture cuts them off at its edge.
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


# --- Styles of a page -------------------------------------------------------------------------------------------------


class Style(NamedTuple):
    """The colours of a page: paper, ink, hatches, the scale of a map from low to high values, and curves.

    The lightness changes steadily along the scale, so that the order of its colours shows in grey and to the
    colour-blind, and ink is legible on each of them.
    """

    paper: str
    ink: str
    hatch: str
    scale: tuple[str, ...]
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
