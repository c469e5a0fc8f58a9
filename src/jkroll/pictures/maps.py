"""Maps as data: a quantity over two inputs, its contours, where the model has no meaning, and what is marked.

Nothing is drawn here. Everything is computed by `solve`, on whole arrays.
"""

from collections.abc import Callable, Iterable, Mapping, Sequence
from math import log10
from typing import Any, NamedTuple

from ..errors import NoResult
from ..materials.library import Material, Materials
from ..quantities.nomenclature import NOMENCLATURE
from ..scene.errors import MissingInput
from ..scene.limits import DMT_UP_TO, JKR_FROM, LIMITS
from ..scene.scene import Scene
from ..scene.solver import solve
from .axes import Axis, in_one_unit, round_values, with_units

CHUNK = 500_000  # points between two reports of progress
COARSE = 200  # points a side that are enough for the smooth border of a region
MOST_BANDS = 12
_WIDE = 30.0  # ratio of the ends from which contours are logarithmic

Progress = Callable[[float], None]


class Setting(NamedTuple):
    """What is the same all over a map: values, materials, and where materials are looked up."""

    given: Mapping[str, float]
    material: Material | None = None
    material2: Material | None = None
    materials: Materials | None = None

    def solve(self, names: Sequence[str], values: Mapping[str, Any]) -> dict[str, Any]:
        """Quantities for further values, which are arrays that broadcast."""
        names1, names2 = ((one.name if one else None) for one in (self.material, self.material2))
        given = {**self.given, **values}
        return dict(solve(names, material=names1, material2=names2, materials=self.materials, **given))

    def scene(self, values: Mapping[str, float], material: Material | None = None) -> Scene:
        """The scene of one point, of another material if one is given."""
        return Scene({**self.given, **values}, material or self.material, self.material2)


class Bound(NamedTuple):
    """A number that limits the model: how it is computed, and on which side of which value there is no meaning."""

    names: tuple[str, ...]
    value: Callable[..., Any]
    limit: float
    is_least: bool
    text: str
    kind: str = "hatched"

    @property
    def broken(self) -> str:
        """What is said of values beyond it."""
        return (
            f"{NOMENCLATURE[self.names[0]].symbol} < {self.limit:g}, JKR is not exact"
            if self.kind == "border"
            else self.text
        )

    def margin(self, setting: Setting, values: Mapping[str, Any]) -> Any:
        """How far values are from it, in powers of ten; negative beyond it."""
        import numpy

        ratio = numpy.log10(self.value(**setting.solve(self.names, values)) / self.limit)
        return ratio if self.is_least else -ratio


class Region(NamedTuple):
    """Part of a map: where a margin, on axes of its own, is negative; hatched, shaded, or only its border drawn.

    One that is everywhere is only told.
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
    """A contour: its value, and how it is labelled."""

    value: float
    text: str


class Map(NamedTuple):
    """A quantity over two inputs."""

    quantity: str
    x: Axis
    y: Axis
    values: Any  # a row for each value of y
    is_log: bool  # whether the contours are those of the logarithm
    has_log_labels: bool
    regions: tuple[Region, ...]
    marks: tuple[Mark, ...]
    title: str
    caption: tuple[str, ...]
    printed: Any = None  # the same quantity as the paper prints it
    guides: tuple[Mark, ...] = ()  # straight lines across

    @property
    def has_gaps(self) -> bool:
        """Whether there is no value somewhere."""
        import numpy

        return bool(numpy.isnan(self.values).any())

    def levels(self, most: int = MOST_BANDS) -> list[Level]:
        """The contours, at round values."""
        low, high = extent(self.values)
        values = [value for value in round_values(low, high, most, is_log=self.is_log) if low <= value <= high]
        if self.has_log_labels:
            texts = [f"{log10(value):.3g}".replace("-", "−") for value in values]
        elif self.is_log:
            texts = with_units(self.quantity, values)
        else:
            numbers, unit = in_one_unit(self.quantity, values)
            texts = [f"{number} {unit}".strip() for number in numbers]
        return [Level(value, text) for value, text in zip(values, texts, strict=True)]


def extent(values: Any) -> tuple[float, float]:
    """The least and the largest of the values that are numbers."""
    import numpy

    known = values[numpy.isfinite(values)]
    return (float(known.min()), float(known.max())) if known.size else (0.0, 0.0)


def has_values(values: Any) -> bool:
    """Whether any of the values is a number."""
    import numpy

    return bool(numpy.isfinite(values).any())


def is_wide(values: Any) -> bool:
    """Whether values are positive and of different orders of magnitude."""
    low, high = extent(values)
    return low > 0 and high > _WIDE * low


def inputs_at(name: str, values: Any) -> dict[str, Any]:
    """The inputs that a value on an axis stands for."""
    return {"contact_modulus": values, "surface_energy": 1.0} if name == "modulus_over_energy" else {name: values}


def coordinate(axis: Axis, scene: Scene) -> float | None:
    """Where a scene is on an axis; None if it does not say, or is beyond the ends."""
    try:
        if axis.name == "modulus_over_energy":
            value = 2 * scene["contact_modulus"] / scene["work_of_adhesion"]
        else:
            value = scene[axis.name]
    except (MissingInput, NoResult):
        return None
    return value if axis.low <= value <= axis.high else None


def evaluate(setting: Setting, quantity: str, x: Axis, y: Axis, progress: Progress | None = None) -> Any:
    """A quantity over two axes, a row for each value of y; nan where it has no value."""
    import numpy

    across, up = x.values()[None, :], y.values()[:, None]
    values = numpy.empty((y.size, x.size))
    rows = max(1, CHUNK // x.size)
    progress = progress if y.size > 4 * rows else None
    for start in range(0, y.size, rows):
        if progress is not None:
            progress(start / y.size)
        here = {**inputs_at(x.name, across), **inputs_at(y.name, up[start : start + rows])}
        values[start : start + rows] = setting.solve([quantity], here)[quantity]
    if progress is not None:
        progress(1.0)
    return values


def along(setting: Setting, quantity: str, x: Axis) -> Any:
    """A quantity along one axis."""
    import numpy

    values = x.values()
    return numpy.broadcast_to(setting.solve([quantity], inputs_at(x.name, values))[quantity], values.shape)


def regions(setting: Setting, bounds: Iterable[Bound], x: Axis, y: Axis) -> list[Region]:
    """Where bounds are broken, as far as the setting allows to say."""
    import numpy

    x, y = (axis._replace(size=min(axis.size, COARSE)) for axis in (x, y))
    here = {**inputs_at(x.name, x.values()[None, :]), **inputs_at(y.name, y.values()[:, None])}
    found = []
    for bound in bounds:
        try:
            margin = numpy.broadcast_to(bound.margin(setting, here), (y.size, x.size))
        except (MissingInput, NoResult):
            continue
        if bound.kind == "border" and (margin < 0).all():
            found.append(Region(f"everywhere {bound.broken}", x, y, margin, "everywhere"))
        elif (margin < 0).any():
            found.append(Region(bound.text, x, y, margin, bound.kind))
    return found


def margin_along(setting: Setting, bound: Bound, x: Axis) -> Any:
    """How far a bound is along an axis; negative beyond it."""
    import numpy

    values = x.values()
    return numpy.broadcast_to(bound.margin(setting, inputs_at(x.name, values)), values.shape)


def _itself(**values: Any) -> Any:
    (value,) = values.values()
    return value


def _bound(name: str, limit: float, *, is_least: bool) -> Bound:
    """The bound of a limit of the model, in the words with which `judgement` judges what is beyond it."""
    judge = next(one.judge for one in LIMITS if one.name == name)
    words = judge(limit * (0.5 if is_least else 2))[1].partition(": ")[2]
    text = f"{NOMENCLATURE[name].symbol} {'<' if is_least else '>'} {limit:g}: {words}"
    return Bound((name,), _itself, limit, is_least, text)


def bounds() -> tuple[Bound, ...]:
    """Where the model has no meaning, the smallest region first, and from where on it is exact."""
    symbol = NOMENCLATURE["tabor_parameter"].symbol
    text = f"{symbol} = {JKR_FROM:g}: JKR holds where it is larger"
    return (
        _bound("contact_radius_in_spacings", 1.0, is_least=True),
        _bound("displacement_ratio", 1.0, is_least=False),
        _bound("tabor_parameter", DMT_UP_TO, is_least=True),
        Bound(("tabor_parameter",), _itself, JKR_FROM, True, text, "border"),
    )


def bounds_of(scene: Scene, quantity: str) -> list[Bound]:
    """The bounds that touch a quantity of a scene."""
    try:
        plan = scene.plan(quantity)
    except MissingInput:
        return []
    used = {quantity, *scene.inputs_of(quantity), *(step.name for step in plan.steps)}
    touched = {limit.name for limit in LIMITS if limit.touches & used}
    return [bound for bound in bounds() if bound.names[0] in touched]


def material_marks(materials: Materials, x: Axis, y: Axis) -> list[Mark]:
    """Where the materials are on an axis that their properties determine, each by its name."""
    marks = []
    for material in materials.materials.values():
        scene = Scene({}, material)
        mark = Mark(material.name, coordinate(x, scene), coordinate(y, scene))
        if mark.x is not None or mark.y is not None:
            marks.append(mark)
    return marks


def equation_of(quantity: str, scene: Scene) -> str:
    """The number of the equation by which a scene has a quantity."""
    return NOMENCLATURE[scene.plan(quantity).found[quantity]].equation


def rows_of(drawn: Map) -> Iterable[list[float]]:
    """The numbers of a map: x, y and the quantity, nan where it has no value."""
    across = drawn.x.values().tolist()
    for up, row in zip(drawn.y.values().tolist(), drawn.values, strict=True):
        for place, value in zip(across, row.tolist(), strict=True):
            yield [place, up, value]


def label_of(quantity: str, *, has_log_labels: bool) -> str:
    """What the labels of the contours say: "log P_c [N]"."""
    unit = NOMENCLATURE[quantity].unit
    symbol = NOMENCLATURE[quantity].symbol
    return f"log {symbol}" + (f" [{unit}]" if unit != "1" else "") if has_log_labels else symbol
