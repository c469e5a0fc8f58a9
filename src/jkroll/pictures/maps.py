"""Maps as data: a quantity over two inputs, its contours, the regions and marks on it.

Nothing is drawn here. Everything is computed by `solve`, on whole arrays.
"""

from collections.abc import Callable, Iterable, Mapping, Sequence
from math import log10
from typing import Any, NamedTuple

from ..errors import NoResult
from ..materials.library import Materials
from ..quantities.nomenclature import NOMENCLATURE
from ..scene.errors import MissingInput
from ..scene.scene import Scene
from ..scene.solver import solve
from .axes import Axis, contour_values, in_one_unit, round_values, with_units

CHUNK = 500_000  # points between two reports of progress
MAX_CONTOURS = 12
NEIGHBOURS = ((0, 1), (0, -1), (1, 0), (-1, 0))  # steps of rows and columns
_WIDE = 30.0  # ratio of the ends from which contours are logarithmic
_HALVINGS = 40  # of an interval that holds an edge: its place is known to 1e-12 of a cell

Progress = Callable[[float], None]


class Region(NamedTuple):
    """Part of a map: the points with a negative margin.

    `kind` says how it is shown: "hatched", "shaded", "border" (a line around it) or "everywhere" (only mentioned).
    """

    text: str
    x: Axis
    y: Axis
    margin: Any
    kind: str = "hatched"


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
    guides: tuple[Mark, ...] = ()  # straight lines across

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
        elif self.is_log:
            texts = with_units(self.quantity, values)
        else:
            numbers, unit = in_one_unit(self.quantity, values)
            texts = [f"{number} {unit}".strip() for number in numbers]
        return [Level(value, text) for value, text in zip(values, texts, strict=True)]

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
    described = {**scene.stated, **values}
    model = scene.stated_model
    return dict(solve(names, material=scene.material, material2=scene.material2, model=model, **described))


def coordinate(axis: Axis, scene: Scene) -> float | None:
    """Return the place of a scene on an axis; None if the scene does not determine it or it is beyond the ends."""
    try:
        value = scene[axis.name]
    except (MissingInput, NoResult):
        return None
    return value if axis.low <= value <= axis.high else None


def evaluate(scene: Scene, quantity: str, x: Axis, y: Axis, progress: Progress | None = None) -> Any:
    """Return a quantity over two axes, a row for each value of y; nan where it has no value."""
    import numpy

    across, up = x.values()[None, :], y.values()[:, None]
    values = numpy.empty((y.size, x.size))
    rows = max(1, CHUNK // x.size)
    progress = progress if y.size > 4 * rows else None
    for start in range(0, y.size, rows):
        if progress is not None:
            progress(start / y.size)
        here = {**x.inputs(across), **y.inputs(up[start : start + rows])}
        values[start : start + rows] = solved(scene, [quantity], here)[quantity]
    if progress is not None:
        progress(1.0)
    return values


def along(scene: Scene, quantity: str, x: Axis) -> Any:
    """Return a quantity along one axis."""
    import numpy

    values = x.values()
    return numpy.broadcast_to(solved(scene, [quantity], x.inputs(values))[quantity], values.shape)


def material_marks(materials: Materials, x: Axis, y: Axis) -> list[Mark]:
    """Return a mark for each material that determines a place on an axis.

    Materials with a state are left out: several of one substance would crowd the edge.
    """
    marks = []
    for material in materials.materials.values():
        if material.state:
            continue
        scene = Scene({}, material)
        mark = Mark(material.name, coordinate(x, scene), coordinate(y, scene))
        if mark.x is not None or mark.y is not None:
            marks.append(mark)
    return marks


def rows_of(drawn: Map) -> Iterable[list[float]]:
    """Iterate over the numbers of a map: x, y and the quantity, nan where it has no value."""
    across = drawn.x.values().tolist()
    for up, row in zip(drawn.y.values().tolist(), drawn.values, strict=True):
        for place, value in zip(across, row.tolist(), strict=True):
            yield [place, up, value]


def label_of(quantity: str, *, has_log_labels: bool) -> str:
    """Return the heading of contour labels: "log P_c [N]"."""
    unit = NOMENCLATURE[quantity].unit
    symbol = NOMENCLATURE[quantity].symbol
    return f"log {symbol}" + (f" [{unit}]" if unit != "1" else "") if has_log_labels else symbol
