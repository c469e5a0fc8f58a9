"""A user's request for a plot as a map or curves: with caption, notes, and limits of the model that are exceeded."""

from collections.abc import Collection, Iterable, Iterator, Sequence
from functools import cached_property, partial
from math import isclose, log, nan
from operator import itemgetter
from typing import Any, NamedTuple

import numpy

from ..answers.advice import advised
from ..answers.notes import about_assumed, about_given, about_idle, about_middles, assumed, idle_of
from ..answers.results import equation_of
from ..errors import BadRequest, JkrollError, NoResult
from ..materials.library import Materials
from ..quantities.formatting import AS_USUAL, Format, amount, in_words, symbol_of
from ..quantities.laws import Law
from ..quantities.markup import symbol
from ..quantities.nomenclature import NOMENCLATURE
from ..quantities.values import parse_quantity
from ..scene.failures import RESTS_ON_SPACING, MissingInput, NotInLaw, reason_of, without_value
from ..scene.limits import LIMITS, OF_LAW, Doubt, Limit, judged, percent, touched
from ..scene.scene import Scene
from ..text import capitalized, quoted
from .picture import (
    BORDER,
    SAME,
    Axis,
    Curve,
    Map,
    Mark,
    Panel,
    Picture,
    Region,
    axis_around,
    evaluate,
    extent,
    has_values,
    is_flat,
    over,
)

SIDE = 201  # points a side of a map, unless its axes say another number
ALONG = 1001  # points of a curve
MAX_POINTS = 4_000_000  # of a map, and of all curves together
_EVERYWHERE = "everywhere"  # the stretch of a curve that is all of it


class PlotRequest(NamedTuple):
    """A quantity to draw over one axis as curves, or over two as a map."""

    quantity: str
    x: Axis
    y: Axis | None
    scenes: tuple[tuple[str, Scene], ...]  # a curve each, with its label
    marks: Sequence[str]
    materials: Materials
    limits: Sequence[Limit] = LIMITS  # of which those that concern the quantity are drawn or told


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


def map_of(request: PlotRequest) -> tuple[Map, tuple[str, ...]]:
    """Return the map of a request, and notes on it."""
    assert request.y is not None
    quantity, scene = request.quantity, request.scenes[0][1]
    x, y = (axis._replace(size=axis.size or SIDE) for axis in (request.x, request.y))
    _check_size(x.size, y.size)
    field = Field(request, "", scene, x, y)
    chosen = tuple(mark_at(text, request.materials, scene, x, y) for text in request.marks)
    of_materials, others = material_marks(request.materials, x, y) if scene.material is None else ((), ())
    regions, exceeded = limits_on_map(scene, quantity, x, y, field.limits)
    caption = (
        _first_sentence(quantity, [field.scene]),
        *fixed_inputs(field.inputs),
        *field.flat(),
        *_own_values(request, chosen),
        *others,
        *_gaps(quantity, [field]),
        *exceeded,
    )
    return Map(quantity, scene, x, y, field.values, tuple(regions), (*of_materials, *chosen), caption), field.notes


def _check_size(first: int, second: int) -> None:
    """Raise BadRequest for more points than a picture may have."""
    if first * second > MAX_POINTS:
        raise BadRequest(f"{first} x {second} points are more than {MAX_POINTS}")


def material_marks(materials: Materials, x: Axis, y: Axis) -> tuple[tuple[Mark, ...], tuple[str, ...]]:
    """Return a mark for each material that has a place on an axis, and the sentence of a caption on the others.

    Materials with a state are not asked: several of one substance would crowd the edge.
    """
    marks = []
    for material in materials.materials.values():
        if not material.state:
            numbers = Scene({}, material).numbers(x.name, y.name)
            places = [numbers[axis.name] if axis.has(numbers.get(axis.name, nan)) else None for axis in (x, y)]
            marks.append(Mark(material.name, *places))
    placed = tuple(mark for mark in marks if mark.x is not None or mark.y is not None)
    others = [mark.text for mark in marks if mark not in placed]
    return placed, (f"Not shown: {', '.join(others)}.",) if placed and others else ()


def curves_of(request: PlotRequest) -> tuple[Picture, tuple[str, ...]]:
    """Return the curves of a request, and notes on them."""
    quantity, x = request.quantity, request.x._replace(size=request.x.size or ALONG)
    _check_size(len(request.scenes), x.size)
    fields: list[Field] = []
    errors: list[MissingInput | NoResult] = []
    notes: list[str] = []
    for text, scene in request.scenes:
        try:
            fields.append(Field(request, text, scene, x))
        except (MissingInput, NoResult) as error:
            errors.append(error)
            notes.append(f"no curve: {text}: {error}")
    if not fields:
        raise errors[0]
    curves = [Curve(field.text, x.values(), field.values, colour) for colour, field in enumerate(fields)]
    y = axis_around(quantity, [curve.y for curve in curves], may_be_log=True)
    marks = [mark_at(text, request.materials, request.scenes[0][1], x, y) for text in request.marks]
    first, *others = fields
    caption = (
        _first_sentence(quantity, [field.scene for field in fields]),
        *fixed_inputs([text for text in first.inputs if all(text in other.inputs for other in others)]),
        *(sentence for field in fields for sentence in field.flat()),
        *_gaps(quantity, fields),
        *_doubts_along(x, fields),
        *_farthest_off(x, fields),
    )
    notes += dict.fromkeys(note for field in fields for note in field.notes)
    return Picture("", (Panel(x, y, tuple(curves), tuple(marks)),), caption), tuple(notes)


def _gaps(quantity: str, fields: "Iterable[Field]") -> Iterator[str]:
    """Iterate over the sentence on values that are missing because the atomic spacing decides on them."""
    if any(field.scene.may_rest_on_spacing(quantity) and not numpy.isfinite(field.values).all() for field in fields):
        yield f"No value where it {RESTS_ON_SPACING.words}."


def _doubts_along(x: Axis, fields: "Sequence[Field]") -> Iterator[str]:
    """Iterate over sentences on the parts of curves where the model has no meaning or is not exact."""
    unjudged = [field.text for field in fields if not field.is_judged]
    if unjudged:
        which = f" for {', '.join(unjudged)}" if len(unjudged) < len(fields) else ""
        yield f"Limits are not judged{which}."
    places: dict[str, list[tuple[str, str]]] = {}  # the curves and their stretches, by what holds there
    for field in fields:
        has_value = numpy.isfinite(field.values)
        for doubt in field.doubts:
            for _, text, is_beyond in beyond(doubt, field.given.law, has_value):
                places.setdefault(text, []).append((field.text, _stretch(x, is_beyond, has_value)))
    for text, stretches in places.items():
        if stretches == [(field.text, _EVERYWHERE) for field in fields]:
            yield f"Everywhere {text}."
        else:
            yield f"{'; '.join(', '.join(filter(None, stretch)) for stretch in stretches)}: {text}."


def _stretch(x: Axis, is_beyond: Any, has_value: Any) -> str:
    """Return the stretch of a curve on which something holds."""
    if (is_beyond == has_value).all():
        return _EVERYWHERE
    where = x.values()[is_beyond]
    ends = (amount(x.name, float(f"{end:.2g}")) for end in (where[0], where[-1]))
    return f"{symbol(x.name)} = {' to '.join(ends)}"


def _farthest_off(x: Axis, fields: "Sequence[Field]") -> Iterator[str]:
    """Iterate over the sentence on the place at which the law of curves is farthest off, with the value by Maugis'."""
    places = []
    for field in fields:
        for doubt in (doubt for doubt in field.doubts if doubt.limit.bits & OF_LAW):
            excess = numpy.where(numpy.isfinite(field.values) & (doubt.excess > 0), doubt.excess, 0.0)
            most = int(excess.argmax())
            if excess[most] > 0:
                places.append((float(excess[most]), float(x.values()[most]), field))
    if not places or len({field.given.law.name for field in fields}) > 1:  # several laws can be compared
        return
    _, value, field = max(places, key=itemgetter(0))
    quantity, here = field.quantity, field.given.replace(**x.inputs(value))
    if told := advised(here, quantity):
        place = f"{symbol(x.name)} = {amount(x.name, float(f'{value:.2g}'))}"
        place += f" ({field.text})" if field.text and len(fields) > 1 else ""
        shown = amount(quantity, here[quantity], Format(digits=3))
        yield f"{here.law.title} is farthest off at {place}: {symbol(quantity)} {told} by Maugis' law, {shown} here."


class Field:
    """A quantity over the axes of one curve or a map: values, fixed inputs, the limits of the model, and notes.

    Raises MissingInput if the quantity cannot be computed, and NoResult if it has no value.
    """

    def __init__(self, request: PlotRequest, text: str, scene: Scene, x: Axis, y: Axis | None = None) -> None:
        """Evaluate the quantity of a request in a scene; `text`: the label of a curve."""
        self.text, self.given, self.quantity = text, scene, (quantity := request.quantity)
        self.axes = [axis for axis in (x, y) if axis is not None]
        at_an_end = {name: value for axis in self.axes for name, value in axis.inputs(axis.high).items()}
        self.scene = scene.replace(**at_an_end)  # what a quantity needs is the same all along an axis
        self.limits: list[Limit] = []
        notes = []
        for limit in touched(self.scene, [quantity], request.limits):
            try:
                self.scene.plans(limit.name)
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
        self.inputs = inputs_as_texts(self.scene, [name for name in shown if name not in at_an_end])
        remark = NOMENCLATURE[quantity].note
        remarks = [f"{symbol_of(quantity)}: {remark}"] if remark else []
        idle = [note.text for note in about_idle(idle_of(self.scene, inputs))]
        data = notes_on(scene, self.scene, shown, names)
        self.notes = tuple(dict.fromkeys([*notes[:1], *idle, *data, *remarks]))
        self.values = evaluate(scene, quantity, x, y)
        if not has_values(self.values):
            outcome = self.scene.evaluate([quantity])[quantity]
            reason = f": {reason_of(quantity, outcome)}" if isinstance(outcome, JkrollError) else ""
            raise without_value(quantity, f"no value anywhere on these axes{reason}")

    @cached_property
    def doubts(self) -> list[Doubt]:
        """The limits, judged at each point."""
        return judged(self.limits, over(self.given, *self.axes), [self.quantity])

    def flat(self) -> Iterator[str]:
        """Iterate over the sentence on values that are the same everywhere."""
        if is_flat(self.values):
            value = amount(self.quantity, extent(self.values)[1])
            sentence = f"the same everywhere: {symbol(self.quantity)} = {value}."
            yield f"{self.text}, {sentence}" if self.text else capitalized(sentence)


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
    uncertain = {name: measured for name, measured in given.uncertainties.items() if name in inputs}
    notes = *about_middles(uncertain), *about_assumed(assumed(scene, inputs, names)), *about_given(scene, names, inputs)
    return [note.text for note in notes]


def _first_sentence(quantity: str, scenes: Sequence[Scene]) -> str:
    """Return the first sentence of a caption: the quantity, its equation, and the law that was named."""
    entry = NOMENCLATURE[quantity]
    clauses = [capitalized(entry.sentence), symbol(quantity)]
    equations = {equation_of(scene, quantity) for scene in scenes}
    laws = {scene.law.title for scene in scenes if scene.stated_model is not None}
    if len(equations) == 1 and (equation := equations.pop()):
        clauses.append(f"Eq ({equation})" if equation.isdigit() else equation)
    if len(laws) == 1:
        clauses.append(f"under {laws.pop()}")
    return ", ".join(clauses) + "."


def fixed_inputs(inputs: Sequence[str]) -> tuple[str, ...]:
    """Return the sentence of a caption about fixed inputs, if there are any."""
    return (f"Fixed: {', '.join(inputs)}.",) if inputs else ()


# --- Limits of the model ----------------------------------------------------------------------------------------------

_DRAWN = ("contact_radius_in_spacings", "displacement_ratio", "tabor_parameter")  # limits that have a place on a map
_COARSE = 200  # points a side at which limits are judged, to say where they are exceeded
_FARTHEST = log(1e3)  # excess of a limit that has a place on a map


def is_drawn(limit: Limit) -> bool:
    """Return whether a limit has a place on a map."""
    return limit.name in _DRAWN and not limit.conclusion


DRAWN_LIMITS = tuple(filter(is_drawn, LIMITS))


def beyond(doubt: Doubt, law: Law, known: Any) -> Iterator[tuple[float, str, Any]]:
    """Iterate over the thresholds that known elements pass: the excess there, the text, and the elements beyond.

    Of a law it is the last threshold, then the first, unless all elements are beyond the last.
    """
    excess = numpy.broadcast_to(doubt.excess, known.shape)
    first, *_, last = (doubt.limit.threshold, *doubt.limit.codes)
    for threshold in dict.fromkeys((last, first)):
        step = doubt.limit.excess(threshold)
        is_beyond = known & (excess > step)
        if not is_beyond.any():
            continue
        yield step, _beyond(doubt.limit, threshold, law), is_beyond
        if (is_beyond == known).all():
            return


def _beyond(limit: Limit, threshold: float, law: Law) -> str:
    """Return what holds beyond a threshold."""
    if limit.bits & OF_LAW:
        return f"{law.title} is off by more than {percent(threshold)}"
    number, unit = AS_USUAL.rounded(limit.name, threshold)
    meaning = limit.consequence.partition(";")[0]
    return f"⟦{NOMENCLATURE[limit.name].symbol} {limit.sign[0]} {number}⟧{unit and f' {unit}'}: {meaning}"


def limits_on_map(
    scene: Scene, quantity: str, x: Axis, y: Axis, limits: Sequence[Limit]
) -> tuple[list[Region], list[str]]:
    """Return the regions of a map in which limits are exceeded, and sentences on limits that are not drawn.

    What counts is where the map has values; a region that would hold all of them is a sentence.
    """
    x, y = (axis._replace(size=min(axis.size, _COARSE)) for axis in (x, y))
    known = numpy.isfinite(evaluate(scene, quantity, x, y))
    regions, sentences = [], []
    for doubt in judged(limits, over(scene, x, y), [quantity]):
        for step, text, is_beyond in beyond(doubt, scene.law, known):
            if (is_beyond == known).all():
                sentences.append(f"Everywhere {text}.")
            elif not is_drawn(doubt.limit):
                sentences.append(f"In part of the map {text}.")
            else:
                is_border = doubt.limit.factor is not None and step == 0
                excess = partial(_excess_over, doubt.limit, step, quantity)
                regions.append(Region(text, BORDER if is_border else doubt.limit.name, excess))
    return regions, sentences


def _excess_over(limit: Limit, step: float, quantity: str, here: Scene) -> Any:
    """Return how far a limit is exceeded over a step, as the logarithm of a factor that has a place on a map."""
    (doubt,) = judged([limit], here, [quantity])
    return numpy.clip(doubt.excess - step, -_FARTHEST, _FARTHEST)
