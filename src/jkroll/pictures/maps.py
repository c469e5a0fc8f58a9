"""Maps and curves as data: a quantity over two inputs, its contours, the regions and marks on it; panels of curves and points.

Nothing is drawn here. Everything is computed on whole arrays. In the regions of a map, the model has no
meaning or is not exact.
"""

from collections.abc import Iterable, Iterator, Mapping, Sequence
from math import log, log10
from typing import Any, NamedTuple

from ..errors import NoResult
from ..materials.library import Materials
from ..quantities.laws import DEFAULT_LAW, LAWS, Law
from ..quantities.nomenclature import NOMENCLATURE, PROPERTIES
from ..scene.failures import MissingInput
from ..scene.limits import LIMITS, Doubt, Limit, judged, touched
from ..scene.scene import Scene
from ..scene.solver import values_of
from ..scene.wiring import has_law
from .axes import Axis, bracketed, contour_values, in_units, round_values
from .styles import BORDER

MAX_CONTOURS = 12
NEIGHBOURS = ((0, 1), (0, -1), (1, 0), (-1, 0))  # steps of rows and columns
_WIDE = 30.0  # ratio of the ends from which contours are logarithmic
_FARTHEST = log(1e3)  # excess of a limit that has a place on a map
_HALVINGS = 40  # of an interval that holds an edge: its place is known to 1e-12 of a cell


class Region(NamedTuple):
    """Part of a map: the points with a value and a negative margin.

    `look` is a key of `styles.LOOKS`; None for a region that is the whole map, which is mentioned and not drawn.
    """

    text: str
    x: Axis
    y: Axis
    margin: Any
    look: str | None


class Mark(NamedTuple):
    """A point of a map, or a place on one of its axes."""

    text: str
    x: float | None
    y: float | None


class Level(NamedTuple):
    """A contour: its value and its label."""

    value: float
    text: str


class Mesh(NamedTuple):
    """Values at points of a map; `x` and `y` are places on the axes. nan where there is no value."""

    x: Any
    y: Any
    values: Any


class Map(NamedTuple):
    """A quantity over two inputs."""

    quantity: str
    scene: Scene  # the part that is the same all over the map
    x: Axis
    y: Axis
    values: Any  # a row for each value of y; nan where there is no value
    regions: tuple[Region, ...]
    marks: tuple[Mark, ...]
    title: str
    caption: tuple[str, ...]
    has_log_labels: bool = False
    printed: Any = None  # the same quantity as the paper prints it
    guides: tuple[tuple[float, str], ...] = ()  # values of y, each with the text of a straight line across
    remarks: tuple[str, ...] = ()  # are said beside the picture, and do not stand on it

    @property
    def is_log(self) -> bool:
        """True if contours are those of the logarithm."""
        return is_wide(self.values)

    @property
    def has_gaps(self) -> bool:
        """True if some point has no value."""
        import numpy

        return bool(numpy.isnan(self.values).any())

    def bands(self, most: int) -> list[Level]:
        """Return at most `most` round values that divide the map into bands, for a terminal."""
        low, high = extent(self.values)
        return self._levels(round_values(low, high, most, is_log=self.is_log), low, high)

    def levels(self) -> list[Level]:
        """Return the contours of a page."""
        low, high = extent(self.values)
        if self.has_log_labels:
            return self.bands(MAX_CONTOURS)
        return self._levels(contour_values(low, high, MAX_CONTOURS, is_log=self.is_log), low, high)

    def _levels(self, values: Iterable[float], low: float, high: float) -> list[Level]:
        """Return the levels within the extent of the map, with labels."""
        values = [value for value in values if low <= value <= high]
        if self.has_log_labels:
            texts = [f"{log10(value):.3g}".replace("-", "−") for value in values]
        else:
            texts, _ = in_units(self.quantity, values, max(low, high, key=abs), is_log=self.is_log)
        return [Level(value, text) for value, text in zip(values, texts, strict=True)]

    @property
    def heading(self) -> str:
        """Meaning of the labels of the contours, with the unit if they have none."""
        return label_of(
            self.quantity, has_log_labels=self.has_log_labels, unit=unit_of_labels(self.quantity, self.values)
        )

    def mesh(self) -> Mesh:
        """Return the values with the points at the border of a gap moved onto the exact edge.

        A point without a value that has a neighbour with one is moved towards it, to where values begin (by bisection).
        """
        import numpy

        x, y = numpy.meshgrid(self.x.place(self.x.values()), self.y.place(self.y.values()))
        values = self.values.copy()
        known = numpy.isfinite(self.values)
        for step in NEIGHBOURS:
            neighbour = shifted(numpy.arange(values.size).reshape(values.shape), step)
            rows, columns = numpy.nonzero(numpy.isnan(values) & shifted(known, step))
            if not rows.size:
                continue
            inside = numpy.unravel_index(neighbour[rows, columns], values.shape)
            ends = [(places[inside], places[rows, columns]) for places in (x, y)]
            x[rows, columns], y[rows, columns], values[rows, columns] = self._edge(*ends)
        return Mesh(x, y, values)

    def _edge(self, across: tuple[Any, Any], up: tuple[Any, Any]) -> tuple[Any, Any, Any]:
        """Return the last places with a value between places with one and places without, and the values there."""
        import numpy

        def at(part: Any) -> tuple[Any, Any, Any]:
            x, y = (inside + part * (outside - inside) for inside, outside in (across, up))
            here = {**self.x.inputs(self.x.value(x)), **self.y.inputs(self.y.value(y))}
            return x, y, numpy.broadcast_to(solved(self.scene, [self.quantity], here)[self.quantity], x.shape)

        low, high = numpy.zeros(across[0].shape), numpy.ones(across[0].shape)
        for _ in range(_HALVINGS):
            middle = (low + high) / 2
            has_value = numpy.isfinite(at(middle)[2])
            low, high = numpy.where(has_value, middle, low), numpy.where(has_value, high, middle)
        return at(low)


def shifted(array: Any, step: tuple[int, int]) -> Any:
    """Return an array moved by a step of rows and columns, with zeros where nothing moved to."""
    import numpy

    moved = numpy.zeros_like(array)
    to = tuple(slice(max(0, by), array.shape[axis] + min(0, by)) for axis, by in enumerate(step))
    source = tuple(slice(max(0, -by), array.shape[axis] + min(0, -by)) for axis, by in enumerate(step))
    moved[to] = array[source]
    return moved


def sampled(values: Any, width: int, height: int) -> Any:
    """Return the values nearest to the middles of so many columns and rows."""
    import numpy

    rows, columns = (
        numpy.rint(numpy.linspace(0, size - 1, count)).astype(int)
        for size, count in zip(values.shape, (height, width), strict=True)
    )
    return values[rows[:, None], columns[None, :]]


def extent(values: Any) -> tuple[float, float]:
    """Return the least and the largest of the finite values."""
    import numpy

    known = values[numpy.isfinite(values)]
    return (float(known.min()), float(known.max())) if known.size else (0.0, 0.0)


def has_values(values: Any) -> bool:
    """Return True if any of the values is finite."""
    import numpy

    return bool(numpy.isfinite(values).any())


def is_wide(values: Any) -> bool:
    """Return True if values are positive and of different orders of magnitude."""
    low, high = extent(values)
    return low > 0 and high > _WIDE * low


def solved(scene: Scene, names: Sequence[str], values: Mapping[str, Any]) -> dict[str, Any]:
    """Return quantities of a scene for further values, which are arrays that broadcast."""
    return values_of(scene.replace(**values), names)


def value_on(axis: Axis, scene: Scene) -> float | None:
    """Return the value that a scene has on an axis, perhaps beyond its ends; None if the scene does not determine it."""
    try:
        return float(scene[axis.name])
    except (MissingInput, NoResult):
        return None


def _coordinate(axis: Axis, scene: Scene) -> float | None:
    """Return the value of a scene between the ends of an axis; None if there is none."""
    value = value_on(axis, scene)
    return value if value is not None and axis.has(value) else None


def evaluate(scene: Scene, quantity: str, x: Axis, y: Axis) -> Any:
    """Return a quantity over two axes, a row for each value of y; nan where it has no value."""
    import numpy

    here = {**x.inputs(x.values()[None, :]), **y.inputs(y.values()[:, None])}
    return numpy.broadcast_to(solved(scene, [quantity], here)[quantity], (y.size, x.size))


def along(scene: Scene, quantity: str, x: Axis) -> Any:
    """Return a quantity along one axis."""
    import numpy

    values = x.values()
    return numpy.broadcast_to(solved(scene, [quantity], x.inputs(values))[quantity], values.shape)


def material_marks(materials: Materials, x: Axis, y: Axis) -> tuple[tuple[Mark, ...], tuple[str, ...]]:
    """Return a mark for each material that determines a place on an axis, and the sentence of a caption that names the others.

    Materials with a state are not asked: several of one substance would crowd the edge.
    """
    marks, others = [], []
    for material in materials.materials.values():
        if material.state:
            continue
        scene = Scene({}, material)
        mark = Mark(material.name, _coordinate(x, scene), _coordinate(y, scene))
        if mark.x is None and mark.y is None:
            others.append(material.name + (_lacking(scene, x) or _lacking(scene, y)))
        else:
            marks.append(mark)
    return tuple(marks), (f"Not shown: {', '.join(others)}.",) if others else ()


def _lacking(scene: Scene, axis: Axis) -> str:
    """Return the properties that the material of a scene lacks for a place on an axis, in brackets; empty if it has them."""
    try:
        scene.plan(axis.name)
    except MissingInput as error:
        return lacking(error)
    return ""


def lacking(error: MissingInput) -> str:
    """Return the missing properties of a material in brackets; empty if what is missing is none of them."""
    properties = [NOMENCLATURE[name].sentence for name in error.missing if name in PROPERTIES]
    return f" (no {' and no '.join(properties)})" if properties else ""


def rows_of(drawn: Map) -> Iterable[list[float]]:
    """Iterate over the numbers of a map: x, y and the quantity, nan where it has no value."""
    across = drawn.x.values().tolist()
    for up, row in zip(drawn.y.values().tolist(), drawn.values, strict=True):
        for place, value in zip(across, row.tolist(), strict=True):
            yield [place, up, value]


def unit_of_labels(quantity: str, values: Any) -> str:
    """Return the unit that all labels of contours have; empty where each has its own."""
    (low, high), is_log = extent(values), is_wide(values)
    contours = contour_values(low, high, MAX_CONTOURS, is_log=is_log)
    return in_units(quantity, contours, max(low, high, key=abs), is_log=is_log)[1]


def label_of(quantity: str, *, has_log_labels: bool, unit: str = "") -> str:
    """Return the heading of contour labels: "log₁₀ (P_c / N)", or "a [nm]"."""
    symbol = NOMENCLATURE[quantity].symbol
    if not has_log_labels:
        return symbol + bracketed(unit)
    unit = NOMENCLATURE[quantity].unit
    return f"log₁₀ {symbol}" if unit == "1" else f"log₁₀ ({symbol} / {unit})"


# --- Regions ----------------------------------------------------------------------------------------------------------

_DRAWN = ("contact_radius_in_spacings", "displacement_ratio", "tabor_parameter")  # limits that have a place on a map
COARSE = 200  # points a side that are enough for the smooth border of a region


def limits_of(scene: Scene, quantity: str) -> list[Limit]:
    """Return the limits that concern a quantity of a scene, those that are drawn on a map first. Raises MissingInput."""
    return sorted(touched(scene, [quantity]), key=_place)


def limits_of_paper(quantity: str) -> list[Limit]:
    """Return the limits of JKR that are drawn on a map of the paper: those within which a point has a meaning, and that of the law."""
    drawn = [limit for limit in LIMITS if is_drawn(limit) and DEFAULT_LAW in (limit.laws or LAWS)]
    return sorted((limit for limit in drawn if limit.factor is None or has_law(quantity)), key=_place)


def is_drawn(limit: Limit) -> bool:
    """Return whether a limit has a place on a map."""
    return limit.name in _DRAWN and bool(limit.codes) and not limit.conclusion


def _place(limit: Limit) -> int:
    return _DRAWN.index(limit.name) if is_drawn(limit) else len(_DRAWN)


def beyond(doubt: Doubt, law: Law, known: Any) -> Iterator[tuple[float, str, Any]]:
    """Iterate over the thresholds that known elements of a doubt pass, each with the text on it and the distance from it, negative beyond it.

    Of a law it is the last threshold, then the first, unless all elements are beyond the last.
    """
    import numpy

    thresholds, steps = [*doubt.limit.codes], doubt.limit.steps
    excess = numpy.clip(numpy.broadcast_to(doubt.excess, known.shape), -_FARTHEST, _FARTHEST)
    for place in dict.fromkeys((len(thresholds) - 1, 0)) if thresholds else ():
        margin = steps[place] - excess
        if not (margin[known] < 0).any():
            continue
        yield thresholds[place], _beyond(doubt.limit, thresholds[place], law), margin
        if not (margin[known] >= 0).any():
            return


def _beyond(limit: Limit, threshold: float, law: Law) -> str:
    """Return what holds beyond a threshold."""
    condition, _, consequence = limit.text(threshold).partition(": ")
    if limit.factor is not None:
        return f"{law.title} is {condition}"
    return f"{NOMENCLATURE[limit.name].symbol} {limit.sign[0]} {threshold:g}: {consequence.partition(';')[0]}"


def limits_on_map(
    scene: Scene, quantity: str, x: Axis, y: Axis, values: Any, limits: Sequence[Limit]
) -> tuple[list[Region], list[str]]:
    """Return the regions of a map with these values in which limits are broken, and sentences on limits that are not drawn.

    What counts is where the map has values; a region that holds all of them is everywhere. They are judged at as many
    points as their borders need.
    """
    import numpy

    x, y = (axis._replace(size=min(axis.size, COARSE)) for axis in (x, y))
    here = scene.replace(**x.inputs(x.values()[None, :]), **y.inputs(y.values()[:, None]))
    known = numpy.isfinite(sampled(values, x.size, y.size))
    regions, sentences = [], []
    for doubt in judged(limits, here, [quantity]):
        if doubt.error is not None:
            continue
        for threshold, text, margin in beyond(doubt, here.law, known):
            is_everywhere = not (margin[known] >= 0).any()
            if not is_drawn(doubt.limit):
                sentences.append(f"{'Everywhere' if is_everywhere else 'In part of the map'} {text}.")
            elif is_everywhere:
                regions.append(Region(f"everywhere {text}", x, y, margin, None))
            elif doubt.limit.factor is not None and threshold == doubt.threshold:
                regions.append(Region(f"{text} {_side(here, margin, known)} this line", x, y, margin, BORDER))
            else:
                regions.append(Region(text, x, y, margin, doubt.limit.name))
    return regions, sentences


def _side(here: Scene, margin: Any, known: Any) -> str:
    """Return where a map is beyond a line of the law of attraction: on one side by μ, if that decides, or else by its axes."""
    import numpy

    inside, others = known & (margin < 0), known & (margin >= 0)
    tabor = numpy.broadcast_to(here["tabor_parameter"], margin.shape)
    if tabor[inside].max() <= tabor[others].min():
        return "where μ is smaller than on"
    if tabor[inside].min() >= tabor[others].max():
        return "where μ is larger than on"
    up, right = (
        numpy.mean(one) - numpy.mean(other) for one, other in zip(inside.nonzero(), others.nonzero(), strict=True)
    )
    rows, columns = margin.shape
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


class Picture(NamedTuple):
    """Panels beside each other, with a title and a caption."""

    title: str
    panels: tuple[Panel, ...]
    caption: tuple[str, ...]
    remarks: tuple[str, ...] = ()  # are said beside the picture, and do not stand on it


def axis_around(name: str, values: Iterable[Any], *, may_be_log: bool = False, margin: float = 0.05) -> Axis:
    """Return an axis that holds all finite values, with a margin; logarithmic if it may be and they are of different orders."""
    import numpy

    known = numpy.concatenate([numpy.ravel(one) for one in values])
    low, high = extent(known)
    if may_be_log and is_wide(known):
        room = log10(high / low) * margin
        return Axis(name, 10.0 ** max(log10(low) - room, _FIRST), 10.0 ** min(log10(high) + room, _LAST))
    room = (high - low) * margin if high > low else abs(high) * 0.05 or 1.0
    return Axis(name, low - room, high + room, is_log=False)


def clipped(curve: Curve, low: float, high: float) -> Curve:
    """Return the parts of a curve between two values of y, up to where it crosses them, each with a nan behind it."""
    import numpy

    x, y = curve.x, curve.y
    for end in (low, high):
        before = numpy.flatnonzero((y[:-1] < end) != (y[1:] < end))
        part = (end - y[before]) / (y[before + 1] - y[before])
        x = numpy.insert(x, before + 1, x[before] + part * (x[before + 1] - x[before]))
        y = numpy.insert(y, before + 1, end)
    is_inside = (y >= low) & (y <= high)
    kept = is_inside | numpy.concatenate([[False], is_inside[:-1]])
    return curve._replace(x=numpy.where(is_inside, x, numpy.nan)[kept], y=numpy.where(is_inside, y, numpy.nan)[kept])
