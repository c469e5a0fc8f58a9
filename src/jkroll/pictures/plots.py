"""What was asked for, as a map or as curves with all that is to be said of them."""

from collections.abc import Iterable, Mapping, Sequence
from typing import NamedTuple

from ..answers.answer import about_data, assumptions
from ..errors import BadRequest, NoResult
from ..materials.library import Materials
from ..quantities.formatting import amount, in_words, pretty
from ..quantities.nomenclature import NOMENCLATURE, PROPERTIES
from ..quantities.parsing import parse_quantity
from ..scene.errors import MissingInput
from ..scene.scene import Scene
from ..text import quoted
from .axes import Axis, described
from .maps import (
    Bound,
    Map,
    Mark,
    Progress,
    Setting,
    along,
    bounds_of,
    coordinate,
    equation_of,
    evaluate,
    has_values,
    inputs_at,
    is_wide,
    margin_along,
    material_marks,
    regions,
)
from .panels import Curve, Panel, Picture, axis_around

MOST_POINTS = 25_000_000  # of a map
MOST_ALONG = 1_000_000  # points of all curves together


class Asked(NamedTuple):
    """A map, or curves, as they were asked for."""

    quantity: str
    x: Axis
    y: Axis | None
    settings: tuple[tuple[str, Setting], ...]  # with what tells them apart
    marks: tuple[str, ...]
    materials: Materials


class NothingToDraw(NoResult):
    """A map or curves without a single value."""

    def __init__(self, quantity: str) -> None:
        super().__init__(quantity)
        self.quantity = quantity

    def __str__(self) -> str:
        return f"{self.quantity} has no value anywhere on these axes"


def mark_at(text: str, materials: Materials, setting: Setting, x: Axis, y: Axis) -> Mark:
    """The place of `MATERIAL@RADIUS`, `MATERIAL` or `@RADIUS` on a map."""
    name, _, radius = text.partition("@")
    material = materials[name] if name else None
    values = {"radius": parse_quantity(radius, "radius")} if radius else {}
    scene = setting.scene(values, material)
    mark = Mark(text, coordinate(x, scene), coordinate(y, scene))
    if mark.x is None and mark.y is None:
        raise BadRequest(f"--mark {quoted(text)} is nowhere on {x.name} and {y.name} as they are drawn")
    return mark


def sized(axis: Axis, size: int) -> Axis:
    """An axis with a number of values, unless it was given one."""
    return axis if axis.size else axis._replace(size=size)


def map_of(wish: Asked, size: tuple[int, int], progress: Progress | None = None) -> tuple[Map, tuple[str, ...]]:
    """The map that was asked for, of so many points unless told, and notes on it."""
    assert wish.y is not None
    quantity, setting = wish.quantity, wish.settings[0][1]
    x, y = sized(wish.x, size[0]), sized(wish.y, size[1])
    if x.size * y.size > MOST_POINTS:
        raise BadRequest(f"{x.size} x {y.size} points are more than {MOST_POINTS}")
    held = Held(quantity, setting, {**_one_of(x), **_one_of(y)})
    values = evaluate(setting, quantity, x, y, progress)
    if not has_values(values):
        raise NothingToDraw(quantity)
    marks = [mark_at(text, wish.materials, setting, x, y) for text in wish.marks]
    if setting.material is None and {x.name, y.name} & {*PROPERTIES}:
        marks = [*material_marks(wish.materials, x, y), *marks]
    found = tuple(regions(setting, held.bounds, x, y))
    caption = (shown(quantity, held.scene), *as_held(held.inputs))
    drawn = Map(quantity, x, y, values, is_wide(values), False, found, tuple(marks), described(quantity, ""), caption)
    return drawn, held.notes


def curves_of(wish: Asked, size: int) -> tuple[Picture, tuple[str, ...]]:
    """The curves that were asked for, and notes on them."""
    x = sized(wish.x, size)
    if x.size * len(wish.settings) > MOST_ALONG:
        raise BadRequest(f"{len(wish.settings)} x {x.size} points are more than {MOST_ALONG}")
    every: list[Held] = []
    curves: list[Curve] = []
    missing: dict[str, MissingInput] = {}
    for text, setting in wish.settings:
        try:
            held = Held(wish.quantity, setting, _one_of(x))
        except MissingInput as error:
            missing[text] = error
            continue
        curves.append(Curve(text, x.values(), along(setting, wish.quantity, x), len(every)))
        every.append(held)
    if not curves:
        raise next(iter(missing.values()))
    if not any(has_values(curve.y) for curve in curves):
        raise NothingToDraw(wish.quantity)
    y = axis_around(wish.quantity, [curve.y for curve in curves])
    points = [mark_at(text, wish.materials, wish.settings[0][1], x, y) for text in wish.marks]
    shared = [part for part in every[0].inputs if all(part in held.inputs for held in every)]
    doubts = [text for held, curve in zip(every, curves, strict=True) for text in held.doubts(x, curve.text)]
    caption = (shown(wish.quantity, every[0].scene), *as_held(shared), *doubts)
    notes = [f"no curve: {error}" for error in missing.values()]
    notes += dict.fromkeys(note for held in every for note in held.notes)
    return Picture("", (Panel(x, y, tuple(curves), tuple(points)),), caption), tuple(notes)


class Held:
    """What is the same all over a picture, what limits it, and what is to be known of it; MissingInput if something is missing."""

    def __init__(self, quantity: str, setting: Setting, values: Mapping[str, float]) -> None:
        """`values`: one of each axis."""
        self.setting = setting
        self.scene = setting.scene(values)
        self.bounds: list[Bound] = []
        notes = []
        for bound in bounds_of(self.scene, quantity):
            try:
                self.scene.plan(*bound.names)
                self.bounds.append(bound)
            except MissingInput as error:
                notes.append(f"its limits are not shown: {error}")
        names = [quantity, *(name for bound in self.bounds for name in bound.names)]
        inputs = self.scene.inputs_of(*names)
        self.inputs = tuple(self._texts(name for name in inputs if name not in values))
        note = NOMENCLATURE[quantity].note
        data = [note.text for note in (*assumptions(self.scene, inputs, names), *about_data(self.scene, inputs))]
        self.notes = tuple(dict.fromkeys([*notes[:1], *data, *([f"{quantity}: {note}"] if note else [])]))

    def _texts(self, names: Iterable[str]) -> Iterable[str]:
        """Materials, and inputs with their values."""
        if self.setting.material is not None:
            yield self.setting.material.name
        if self.setting.material2 is not None:
            yield f"material2 = {self.setting.material2.name}"
        for name in names:
            value = self.scene.values[name]
            text = amount(name, in_words(name, value))
            yield f"{NOMENCLATURE[name].symbol} = {pretty(text)}"

    def doubts(self, x: Axis, curve: str) -> Iterable[str]:
        """Where along an axis the model has no meaning, or is not exact."""
        for bound in self.bounds:
            where = x.values()[margin_along(self.setting, bound, x) < 0]
            if where.size:
                ends = (pretty(f"{amount(x.name, float(f'{end:.2g}'))}") for end in (where[0], where[-1]))
                of_curve = f"{curve}, " if curve else ""
                yield f"{of_curve}{NOMENCLATURE[x.name].symbol} = {' to '.join(ends)}: {bound.broken}."


def shown(quantity: str, scene: Scene) -> str:
    """What a picture shows, by which equation."""
    entry, number = NOMENCLATURE[quantity], equation_of(quantity, scene)
    equation = f", Eq ({number})" if number else ""
    return f"{entry.sentence[0].upper()}{entry.sentence[1:]} {entry.symbol}{equation}."


def as_held(inputs: Sequence[str]) -> tuple[str, ...]:
    """What is the same all over a picture, as a sentence."""
    return (f"Held: {', '.join(inputs)}.",) if inputs else ()


def _one_of(axis: Axis) -> dict[str, float]:
    """One value of an axis, to ask what it takes and what it assumes."""
    return inputs_at(axis.name, axis.high)
