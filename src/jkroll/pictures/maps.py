"""Maps and panels of curves as data: values, contours, regions, marks.

Nothing is drawn here. In the regions of a map, the model has no meaning or is not exact.
"""

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from functools import partial
from math import log, log10
from typing import Any, NamedTuple

import numpy

from ..materials.library import Materials
from ..quantities.formatting import AS_USUAL, in_units
from ..quantities.laws import Law
from ..quantities.markup import symbol
from ..quantities.nomenclature import NOMENCLATURE, PROPERTIES
from ..scene.failures import MissingInput
from ..scene.limits import LIMITS, OF_LAW, Doubt, Limit, judged, percent, touched
from ..scene.scene import Scene
from ..scene.solver import values_of
from ..scene.wiring import has_law
from .axes import Axis, bracketed, described, round_values
from .styles import BORDER

MAX_CONTOURS = 12
_WIDE = 30.0  # ratio of the ends from which contours are logarithmic
_FARTHEST = log(1e3)  # excess of a limit that has a place on a map
SAME = 1e-9  # relative difference of values that are the same but for rounding


class Region(NamedTuple):
    """Part of a map: the points with a value at which an excess is positive.

    `look` is a key of `styles.LOOKS`; None for a region that is the whole map, which is mentioned and not drawn.
    `side`: for a line that is drawn in place of the region, the words for the side of it on which the region is.
    """

    text: str
    look: str | None
    excess: Callable[[Scene], Any]  # of a scene of arrays
    side: str = ""


class Mark(NamedTuple):
    """A point of a map, or a place on one of its axes."""

    text: str
    x: float | None
    y: float | None


class Level(NamedTuple):
    """A contour: its value and its label."""

    value: float
    text: str


class Map(NamedTuple):
    """A quantity over two inputs."""

    quantity: str
    scene: Scene  # what is the same all over the map
    x: Axis
    y: Axis
    values: Any  # a row for each value of y; nan where there is no value
    regions: tuple[Region, ...]
    marks: tuple[Mark, ...]
    caption: tuple[str, ...]
    figure: str = ""  # the number of a figure of the paper
    has_log_labels: bool = False
    printed: str = ""  # the same quantity as the paper prints it
    guides: tuple[tuple[float, str], ...] = ()  # values of y, each with the text of a straight line across
    remarks: tuple[str, ...] = ()  # are said beside the picture, and do not stand on it

    @property
    def is_log(self) -> bool:
        """True if contours are those of the logarithm."""
        return is_wide(self.values)

    def levels(self) -> list[Level]:
        """Return the contours: round values within the extent of the map."""
        if is_flat(self.values):
            return []
        low, high = extent(self.values)
        rounded = round_values(low, high, MAX_CONTOURS, is_log=self.is_log)
        inside = [value for value in rounded if low <= value <= high]
        return [Level(value, text) for value, text in zip(inside, self.in_words(inside)[0], strict=True)]

    def in_words(self, values: Sequence[float], digits: int = 12) -> tuple[list[str], str]:
        """Return values of the quantity as texts, and their common unit, which is empty where each has its own."""
        if self.has_log_labels:
            return [f"{log10(value):.3g}".replace("-", "−") for value in values], ""
        return in_units(NOMENCLATURE[self.quantity].unit, values, digits, is_log=self.is_log)

    @property
    def title(self) -> str:
        """The title, with the unit of the contours if they have none."""
        return self.titled(self.in_words([level.value for level in self.levels()])[1])

    def titled(self, unit: str) -> str:
        """Return the title over numbers of a unit."""
        if not self.figure:
            return described(self.quantity, unit)
        label = label_of(self.quantity) if self.has_log_labels else symbol(self.quantity) + bracketed(unit)
        return f"Fig. {self.figure}: {label}"


def label_of(quantity: str) -> str:
    """Return the heading of logarithms of a quantity: "log₁₀ (P_c / N)"."""
    unit = NOMENCLATURE[quantity].unit
    return f"⟦log₁₀⟧ {symbol(quantity)}" if unit == "1" else f"⟦log₁₀⟧ ({symbol(quantity)} / {unit})"


def extent(values: Any) -> tuple[float, float]:
    """Return the least and the largest of the finite values."""
    known = values[numpy.isfinite(values)]
    return (float(known.min()), float(known.max())) if known.size else (0.0, 0.0)


def has_values(values: Any) -> bool:
    """Return True if any of the values is finite."""
    return bool(numpy.isfinite(values).any())


def is_flat(values: Any) -> bool:
    """Return True if all finite values are the same but for rounding."""
    low, high = extent(values)
    return high - low <= SAME * max(abs(low), abs(high))


def is_wide(values: Any) -> bool:
    """Return True if values are positive and of different orders of magnitude."""
    low, high = extent(values)
    return low > 0 and high > _WIDE * low


def solved(scene: Scene, names: Sequence[str], values: Mapping[str, Any]) -> dict[str, Any]:
    """Return quantities of a scene for further values, which are arrays that broadcast."""
    return values_of(scene.replace(**values), names)


def over(scene: Scene, x: Axis, y: Axis | None = None) -> Scene:
    """Return a scene of arrays along one axis, or over two, with a row for each value of y."""
    if y is None:
        return scene.replace(**x.inputs(x.values()))
    return scene.replace(**x.inputs(x.values()[None, :]), **y.inputs(y.values()[:, None]))


def evaluate(scene: Scene, quantity: str, x: Axis, y: Axis | None = None) -> Any:
    """Return a quantity along one axis, or over two; nan where it has no value."""
    shape = (x.size,) if y is None else (y.size, x.size)
    return numpy.broadcast_to(values_of(over(scene, x, y), [quantity])[quantity], shape)


def material_marks(materials: Materials, x: Axis, y: Axis) -> tuple[tuple[Mark, ...], tuple[str, ...]]:
    """Return a mark for each material that has a place on an axis, and the sentence of a caption on the others.

    Materials with a state are not asked: several of one substance would crowd the edge.
    """
    marks, others = [], []
    for material in materials.materials.values():
        if material.state:
            continue
        outcomes = [(axis, Scene({}, material).evaluate([axis.name])[axis.name]) for axis in (x, y)]
        places = [value if isinstance(value, float) and axis.has(value) else None for axis, value in outcomes]
        if places == [None, None]:
            reasons = (lacking(error) for _, error in outcomes if isinstance(error, MissingInput))
            others.append(material.name + next(filter(None, reasons), ""))
        else:
            marks.append(Mark(material.name, *places))
    return tuple(marks), (f"Not shown: {', '.join(others)}.",) if marks and others else ()


def lacking(error: MissingInput) -> str:
    """Return the missing properties of a material in brackets; empty if what is missing is none of them."""
    properties = [NOMENCLATURE[name].sentence for name in error.missing if name in PROPERTIES]
    return f" (no {' and no '.join(properties)})" if properties else ""


# --- Regions ----------------------------------------------------------------------------------------------------------

_DRAWN = ("contact_radius_in_spacings", "displacement_ratio", "tabor_parameter")  # limits that have a place on a map
COARSE = 200  # points a side at which limits are judged, to say where they are exceeded


def limits_of(scene: Scene, quantity: str) -> list[Limit]:
    """Return the limits that concern a quantity, those that are drawn on a map first. Raises MissingInput."""
    return sorted(touched(scene, [quantity]), key=_place)


def limits_of_paper(quantity: str) -> list[Limit]:
    """Return the limits of JKR that are drawn on a map of the paper."""
    drawn = (limit for limit in LIMITS if is_drawn(limit) and (limit.factor is None or has_law(quantity)))
    return sorted(drawn, key=_place)


def is_drawn(limit: Limit) -> bool:
    """Return whether a limit has a place on a map."""
    return limit.name in _DRAWN and bool(limit.codes) and not limit.conclusion


def _place(limit: Limit) -> int:
    return _DRAWN.index(limit.name) if is_drawn(limit) else len(_DRAWN)


def beyond(doubt: Doubt, law: Law, known: Any) -> Iterator[tuple[float, str, Any]]:
    """Iterate over the thresholds that known elements pass: the excess there, the text, and the elements beyond.

    Of a law it is the last threshold, then the first, unless all elements are beyond the last.
    """
    thresholds, steps = [*doubt.limit.codes], doubt.limit.steps
    excess = numpy.broadcast_to(doubt.excess, known.shape)
    for place in dict.fromkeys((len(thresholds) - 1, 0)) if thresholds else ():
        is_beyond = known & (excess > steps[place])
        if not is_beyond.any():
            continue
        yield steps[place], _beyond(doubt.limit, thresholds[place], law), is_beyond
        if (is_beyond == known).all():
            return


def _beyond(limit: Limit, threshold: float, law: Law) -> str:
    """Return what holds beyond a threshold."""
    if limit.bits & OF_LAW:
        return f"{law.title} is off by more than {percent(threshold)}"
    meaning = limit.consequence.partition(";")[0]
    if limit.factor is not None:
        return meaning
    number, unit = AS_USUAL.rounded(limit.name, threshold)
    return f"⟦{NOMENCLATURE[limit.name].symbol} {limit.sign[0]} {number}⟧{unit and f' {unit}'}: {meaning}"


def limits_on_map(
    scene: Scene, quantity: str, x: Axis, y: Axis, limits: Sequence[Limit]
) -> tuple[list[Region], list[str]]:
    """Return the regions of a map in which limits are exceeded, and sentences on limits that are not drawn.

    What counts is where the map has values; a region that holds all of them is everywhere.
    """
    x, y = (axis._replace(size=min(axis.size, COARSE)) for axis in (x, y))
    here = over(scene, x, y)
    known = numpy.isfinite(evaluate(scene, quantity, x, y))
    regions, sentences = [], []
    for doubt in judged(limits, here, [quantity]):
        if doubt.error is not None:
            continue
        for step, text, is_beyond in beyond(doubt, here.law, known):
            is_everywhere = bool((is_beyond == known).all())
            excess = partial(_excess_over, doubt.limit, step, quantity)
            if not is_drawn(doubt.limit):
                sentences.append(f"{'Everywhere' if is_everywhere else 'In part of the map'} {text}.")
            elif is_everywhere:
                regions.append(Region(f"everywhere {text}", None, excess))
            elif doubt.limit.factor is not None and step == doubt.limit.steps[0]:
                regions.append(Region(text, BORDER, excess, f"{_side(here, is_beyond, known)} this line"))
            else:
                regions.append(Region(text, doubt.limit.name, excess))
    return regions, sentences


def _excess_over(limit: Limit, step: float, quantity: str, here: Scene) -> Any:
    """Return how far a limit is exceeded over a step, as the logarithm of a factor that has a place on a map."""
    (doubt,) = judged([limit], here, [quantity])
    return numpy.clip(doubt.excess - step, -_FARTHEST, _FARTHEST)


def _side(here: Scene, is_beyond: Any, known: Any) -> str:
    """Return on which side of the line of a law a map is beyond it: by μ, if that decides, or by its axes."""
    others = known & ~is_beyond
    tabor = numpy.broadcast_to(here["tabor_parameter"], known.shape)
    if tabor[is_beyond].max() <= tabor[others].min():
        return "where ⟦μ⟧ is smaller than on"
    if tabor[is_beyond].min() >= tabor[others].max():
        return "where ⟦μ⟧ is larger than on"
    up, right = (
        numpy.mean(inside) - numpy.mean(outside)
        for inside, outside in zip(is_beyond.nonzero(), others.nonzero(), strict=True)
    )
    rows, columns = known.shape
    if abs(up) / rows > abs(right) / columns:
        return "above" if up > 0 else "below"
    return "to the right of" if right > 0 else "to the left of"


# --- Panels of curves -------------------------------------------------------------------------------------------------

_FIRST, _LAST = -323, 308  # decades of the doubles


class Curve(NamedTuple):
    """A line through points. Curves that belong together share a colour."""

    text: str
    x: Any
    y: Any
    colour: int = 0
    is_dashed: bool = False


class Panel(NamedTuple):
    """Curves over common axes."""

    x: Axis
    y: Axis
    curves: tuple[Curve, ...]
    points: tuple[Mark, ...] = ()
    title: str = ""
    is_true_to_scale: bool = False
    keys: tuple[str, ...] = ()  # lines below it, where its points have numbers

    def shows(self, x: float, y: float) -> bool:
        """Return True for a point between the ends of both axes."""
        return self.x.has(x) and self.y.has(y)


class Picture(NamedTuple):
    """Panels beside each other, with a title and a caption."""

    title: str
    panels: tuple[Panel, ...]
    caption: tuple[str, ...]
    remarks: tuple[str, ...] = ()  # are said beside the picture, and do not stand on it


def axis_around(name: str, values: Iterable[Any], *, may_be_log: bool = False, margin: float = 0.05) -> Axis:
    """Return an axis that holds all finite values; logarithmic if it may be and they are of different orders."""
    known = numpy.concatenate([numpy.ravel(array) for array in values])
    low, high = extent(known)
    if may_be_log and is_wide(known):
        room = log10(high / low) * margin
        return Axis(name, 10.0 ** max(log10(low) - room, _FIRST), 10.0 ** min(log10(high) + room, _LAST))
    if is_flat(known):  # no rounding errors as large as the picture
        return Axis(name, low - (abs(low) * margin or 1.0), high + (abs(high) * margin or 1.0), is_log=False)
    room = (high - low) * margin
    return Axis(name, low - room, high + room, is_log=False)


def clipped(curve: Curve, low: float, high: float) -> Curve:
    """Return the parts of a curve between two values of y, up to where it crosses them, each with a nan behind it."""
    x, y = curve.x, curve.y
    for end in (low, high):
        before = numpy.flatnonzero((y[:-1] < end) != (y[1:] < end))
        share = (end - y[before]) / (y[before + 1] - y[before])
        x = numpy.insert(x, before + 1, x[before] + share * (x[before + 1] - x[before]))
        y = numpy.insert(y, before + 1, end)
    is_inside = (y >= low) & (y <= high)
    kept = is_inside | numpy.concatenate([[False], is_inside[:-1]])
    return curve._replace(x=numpy.where(is_inside, x, numpy.nan)[kept], y=numpy.where(is_inside, y, numpy.nan)[kept])
