"""A user's request for a plot as a map or curves with caption and notes."""

from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from math import isclose, nan
from operator import itemgetter
from typing import Any, NamedTuple

import numpy

from ..answers.alternatives import advised
from ..answers.notes import about_given, about_idle, about_middles, symbol_of
from ..answers.results import equation_of
from ..errors import BadRequest, NoResult
from ..materials.library import Materials
from ..quantities.formatting import Format, amount, in_words
from ..quantities.markup import symbol
from ..quantities.nomenclature import NOMENCLATURE
from ..quantities.values import parse_quantity
from ..scene.failures import RESTS_ON_SPACING, MissingInput, NotInLaw, reason_of
from ..scene.limits import OF_LAW, Limit, judged
from ..scene.scene import Scene
from ..text import capitalized, quoted
from .axes import Axis
from .maps import (
    SAME,
    Curve,
    Map,
    Mark,
    Panel,
    Picture,
    axis_around,
    beyond,
    evaluate,
    extent,
    has_values,
    is_drawn,
    is_flat,
    lacking,
    limits_of,
    limits_on_map,
    material_marks,
    over,
)

MAX_POINTS = 4_000_000  # of a map
MAX_ALONG = 1_000_000  # points of all curves together
_EVERYWHERE = "everywhere"  # the part of a curve that is all of it


class PlotRequest(NamedTuple):
    """A quantity to draw over one axis as curves, or over two as a map."""

    quantity: str
    x: Axis
    y: Axis | None
    scenes: tuple[tuple[str, Scene], ...]  # a curve each, with its label
    marks: tuple[str, ...]
    materials: Materials
    is_plain: bool = False  # without the limits of the model
    limits: Sequence[Limit] | None = None  # to be drawn on a map; None: those that concern the quantity


class NothingToDraw(NoResult):
    """Error raised when a map or curves have no value at all."""

    def __init__(self, quantity: str, scene: Scene) -> None:
        """`scene`: one on these axes, which may say why."""
        super().__init__(quantity, scene)
        outcome = scene.evaluate([quantity])[quantity]
        has_reason = isinstance(outcome, NoResult | MissingInput)
        self.quantity, self.because = quantity, f": {reason_of(quantity, outcome)}" if has_reason else ""

    def __str__(self) -> str:
        return f"{self.quantity} has no value anywhere on these axes{self.because}"


def mark_at(text: str, materials: Materials, scene: Scene, x: Axis, y: Axis) -> Mark:
    """Return the mark of `MATERIAL@RADIUS`, `MATERIAL` or `@RADIUS` on a map."""
    numbers = _scene_at(text, materials, scene).numbers(x.name, y.name)
    mark = Mark(text, numbers.get(x.name), numbers.get(y.name))
    if mark.x is None and mark.y is None:
        raise BadRequest(f"--mark {quoted(text)} is nowhere on {x.name} and {y.name} as they are drawn")
    for axis, value in ((x, mark.x), (y, mark.y)):
        if value is not None and not axis.has(value):
            low, high = (amount(axis.name, float(f"{end:.3g}")) for end in (axis.low, axis.high))
            raise BadRequest(f"--mark {quoted(text)} is nowhere on {axis.name}, which is drawn from {low} to {high}")
    return mark


def _scene_at(text: str, materials: Materials, scene: Scene) -> Scene:
    """Return the scene of a grain that is marked."""
    name, _, radius = text.partition("@")
    material = materials[name] if name else None
    values = {"radius": parse_quantity(radius, "radius")} if radius else {}
    return Scene({**scene.stated, **values}, material or scene.material, scene.material2, model=scene.stated_model)


def _own_values(request: PlotRequest, marks: Iterable[Mark]) -> Iterator[str]:
    """Iterate over sentences on marked grains of which a map shows another value, as it has an input of others."""
    assert request.y is not None
    quantity, scene = request.quantity, request.scenes[0][1]
    for mark in marks:
        if mark.x is None or mark.y is None:
            continue
        drawn = scene.replace(**request.x.inputs(mark.x), **request.y.inputs(mark.y)).numbers(quantity)
        at_mark = _scene_at(mark.text, request.materials, scene).numbers(quantity)
        if quantity in at_mark and not isclose(at_mark[quantity], drawn.get(quantity, nan), rel_tol=SAME):
            value = f"{symbol(quantity)} is {amount(quantity, at_mark[quantity])}"
            yield f"{mark.text} has other inputs than are fixed here: its {value}."


def map_of(request: PlotRequest, size: tuple[int, int]) -> tuple[Map, tuple[str, ...]]:
    """Return the map of a request, by default with `size` points across and up, and notes on it."""
    assert request.y is not None
    quantity, scene = request.quantity, request.scenes[0][1]
    x, y = (axis._replace(size=axis.size or most) for axis, most in zip((request.x, request.y), size, strict=True))
    if x.size * y.size > MAX_POINTS:
        raise BadRequest(f"{x.size} x {y.size} points are more than {MAX_POINTS}")
    at_an_end = {**x.inputs(x.high), **y.inputs(y.high)}  # what a quantity needs is the same all along an axis
    context = Context(request, scene, at_an_end)
    values = evaluate(scene, quantity, x, y)
    if not has_values(values):
        raise NothingToDraw(quantity, context.scene)
    chosen = tuple(mark_at(text, request.materials, scene, x, y) for text in request.marks)
    of_materials, others = material_marks(request.materials, x, y) if scene.material is None else ((), ())
    regions, exceeded = limits_on_map(scene, quantity, x, y, context.limits)
    caption = (
        _first_sentence(quantity, [context.scene]),
        *fixed_inputs(context.inputs),
        *_flat(quantity, "", values),
        *_own_values(request, chosen),
        *others,
        *_gaps(quantity, [context], [values]),
        *exceeded,
    )
    return Map(quantity, scene, x, y, values, tuple(regions), (*of_materials, *chosen), caption), context.notes


def curves_of(request: PlotRequest, size: int) -> tuple[Picture, tuple[str, ...]]:
    """Return the curves of a request, by default of `size` points, and notes on them."""
    x = request.x._replace(size=request.x.size or size)
    if x.size * len(request.scenes) > MAX_ALONG:
        raise BadRequest(f"{len(request.scenes)} x {x.size} points are more than {MAX_ALONG}")
    contexts: list[Context] = []
    curves: list[Curve] = []
    missing: dict[str, MissingInput | NothingToDraw] = {}
    for text, scene in request.scenes:
        try:
            context = Context(request, scene, x.inputs(x.high))
        except MissingInput as error:
            missing[text] = error
            continue
        values = evaluate(scene, request.quantity, x)
        if not has_values(values):
            missing[text] = NothingToDraw(request.quantity, context.scene)
            continue
        curves.append(Curve(text, x.values(), values, len(contexts)))
        contexts.append(context)
    if not curves:
        raise next(iter(missing.values()))
    y = axis_around(request.quantity, [curve.y for curve in curves], may_be_log=True)
    points = [mark_at(text, request.materials, request.scenes[0][1], x, y) for text in request.marks]
    shared = [text for text in contexts[0].inputs if all(text in context.inputs for context in contexts)]
    lost = [
        text + (lacking(error) if isinstance(error, MissingInput) else error.because) for text, error in missing.items()
    ]
    caption = (
        _first_sentence(request.quantity, [context.scene for context in contexts]),
        *fixed_inputs(shared),
        *(text for curve in curves for text in _flat(request.quantity, curve.text, curve.y)),
        *((f"No curve: {'; '.join(lost)}.",) if lost else ()),
        *_gaps(request.quantity, contexts, [curve.y for curve in curves]),
        *_doubts_along(x, curves, contexts),
        *_farthest_off(request.quantity, x, curves, contexts),
    )
    notes = [f"no curve: {error}" for error in missing.values()]
    notes += dict.fromkeys(note for context in contexts for note in context.notes)
    return Picture("", (Panel(x, y, tuple(curves), tuple(points)),), caption), tuple(notes)


def _flat(quantity: str, text: str, values: Any) -> Iterator[str]:
    """Iterate over the sentence on a map or a curve that has the same value everywhere; `text`: of the curve."""
    if is_flat(values):
        sentence = f"the same everywhere: {symbol(quantity)} = {amount(quantity, extent(values)[1])}."
        yield f"{text}, {sentence}" if text else capitalized(sentence)


def _gaps(quantity: str, contexts: "Iterable[Context]", values: Iterable[Any]) -> Iterator[str]:
    """Iterate over the sentence on values that are missing because the atomic spacing decides on them."""
    may_rest = any(context.scene.may_rest_on_spacing(quantity) for context in contexts)
    if may_rest and any(not numpy.isfinite(numbers).all() for numbers in values):
        yield f"No value where it {RESTS_ON_SPACING.words}."


def _doubts_along(x: Axis, curves: Sequence[Curve], contexts: "Sequence[Context]") -> Iterator[str]:
    """Iterate over sentences on the parts of curves where the model has no meaning or is not exact."""
    doubts: dict[str, list[tuple[str, str]]] = {}  # the curves and their parts, by the doubt
    for curve, context in zip(curves, contexts, strict=True):
        for doubt, where in context.doubts(x, curve.y):
            doubts.setdefault(doubt, []).append((curve.text, where))
    for doubt, places in doubts.items():
        if places == [(curve.text, _EVERYWHERE) for curve in curves]:
            yield f"Everywhere {doubt}."
        else:
            where = "; ".join(filter(None, (", ".join(filter(None, place)) for place in places)))
            yield f"{where}: {doubt}." if where else f"{capitalized(doubt)}."


def _farthest_off(quantity: str, x: Axis, curves: Sequence[Curve], contexts: "Sequence[Context]") -> Iterator[str]:
    """Iterate over the sentence on the place at which the law of curves is farthest off, with the value by Maugis'."""
    places = []
    for curve, context in zip(curves, contexts, strict=True):
        of_law = [limit for limit in context.limits if limit.bits & OF_LAW]
        for doubt in judged(of_law, over(context.given, x), [quantity]):
            is_off = numpy.isfinite(curve.y) & (doubt.excess > 0)
            excess = numpy.where(is_off, doubt.excess, 0.0)
            most = int(excess.argmax())
            places += [(float(excess[most]), float(curve.x[most]), curve, context)] if is_off.any() else []
    if not places or len({context.given.law.name for context in contexts}) > 1:  # several laws can be compared
        return
    _, value, curve, context = max(places, key=itemgetter(0))
    here = context.given.replace(**x.inputs(value))
    if told := advised(here, quantity):
        place = f"{symbol(x.name)} = {amount(x.name, float(f'{value:.2g}'))}"
        place += f" ({curve.text})" if curve.text and curves[1:] else ""
        own = amount(quantity, here[quantity], Format(digits=3))
        yield f"{here.law.title} is farthest off at {place}: {symbol(quantity)} {told} by Maugis' law, {own} here."


class Context:
    """The inputs that are fixed all over a picture, the limits of the model, and notes on the data.

    Raises MissingInput if the quantity cannot be computed.
    """

    def __init__(self, request: PlotRequest, scene: Scene, values: Mapping[str, float]) -> None:
        """Describe the quantity of a request in a scene; `values` holds one value of each axis."""
        self.given, self.quantity = scene, (quantity := request.quantity)
        self.scene = scene.replace(**values)
        self.limits: list[Limit] = []
        notes = []
        limits = request.limits
        if limits is None and not self.scene.missing([quantity]):
            limits = limits_of(self.scene, quantity)
        for limit in () if request.is_plain else limits or ():
            try:
                self.scene.plan(limit.name)
                self.limits.append(limit)
            except NotInLaw:
                continue
            except MissingInput as error:
                notes.append(f"limits are not judged: {NOMENCLATURE[error.wanted].symbol} {error.reason()}")
        self.is_judged = not notes
        names = [quantity, *(limit.name for limit in self.limits if is_drawn(limit))]
        inputs = self.scene.inputs_of(*names)
        used = {*self.scene.inputs_of(quantity)}
        # The limits are judged at an assumed load, which is no assumption about a quantity that does not depend on it.
        shown = [name for name in inputs if name in used or name != "load" or name in self.scene.given]
        self.inputs = inputs_as_texts(self.scene, [name for name in shown if name not in values])
        remark = NOMENCLATURE[quantity].note
        remarks = [f"{symbol_of(quantity)}: {remark}"] if remark else []
        idle = [note.text for note in about_idle(self.scene, inputs)]
        data = notes_on(scene, self.scene, shown, names)
        self.notes = tuple(dict.fromkeys([*notes[:1], *idle, *data, *remarks]))

    def doubts(self, x: Axis, y: Any) -> Iterable[tuple[str, str]]:
        """Iterate over clauses on limits that are exceeded, each with the part of a curve where that is so."""
        if not self.is_judged:
            yield "limits are not judged", ""
        has_value = numpy.isfinite(y)
        here = self.given.replace(**x.inputs(x.values()))
        for doubt in judged(self.limits, here, [self.quantity]):
            for _, text, is_beyond in beyond(doubt, here.law, has_value):
                yield text, _part(x, is_beyond, has_value)


def _part(x: Axis, is_beyond: Any, has_value: Any) -> str:
    """Return the part of a curve on which something holds."""
    if (is_beyond == has_value).all():
        return _EVERYWHERE
    where = x.values()[is_beyond]
    ends = (amount(x.name, float(f"{end:.2g}")) for end in (where[0], where[-1]))
    return f"{symbol(x.name)} = {' to '.join(ends)}"


def inputs_as_texts(scene: Scene, names: Iterable[str]) -> tuple[str, ...]:
    """Return the materials of a scene, and inputs with their values."""
    materials = [scene.material.name] if scene.material is not None else []
    if scene.material2 is not None:
        materials.append(f"material2 = {scene.material2.name}")
    values = ((name, in_words(name, scene.values[name])) for name in names)
    return (*materials, *(f"{symbol(name)} = {amount(name, value)}" for name, value in values))


def notes_on(given: Scene, scene: Scene, inputs: Collection[str], names: Sequence[str]) -> list[str]:
    """Return notes on uncertain inputs, of which a picture has the middle, and on the data behind quantities.

    `given`: the scene as a user gave it, of which `scene` is one point.
    """
    uncertain = {name: measured for name in inputs if (measured := given.uncertainty_of(name)) is not None}
    return [note.text for note in (*about_middles(uncertain), *about_given(scene, [*names], inputs, scene.stated))]


def _first_sentence(quantity: str, scenes: Sequence[Scene]) -> str:
    """Return the first sentence of a caption: the quantity, its equation, and the law that was named."""
    entry = NOMENCLATURE[quantity]
    parts = [capitalized(entry.sentence), symbol(quantity)]
    equations = {equation_of(scene, quantity) for scene in scenes}
    laws = {scene.law.title for scene in scenes if scene.stated_model is not None}
    if len(equations) == 1 and (equation := equations.pop()):
        parts.append(f"Eq ({equation})" if equation.isdigit() else equation)
    if len(laws) == 1:
        parts.append(f"under {laws.pop()}")
    return ", ".join(parts) + "."


def fixed_inputs(inputs: Sequence[str]) -> tuple[str, ...]:
    """Return the sentence of a caption about fixed inputs, if there are any."""
    return (f"Fixed: {', '.join(inputs)}.",) if inputs else ()
