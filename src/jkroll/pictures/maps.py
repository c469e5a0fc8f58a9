"""`jkroll map`: a quantity over one input as curves, or over two as a field, with a caption, notes and limits."""

import re
from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from functools import partial
from itertools import compress
from math import isclose, log, nan
from typing import Any, NamedTuple

import numpy

from ..errors import BadRequest, JkrollError, NoResult
from ..materials.library import Materials
from ..model.estimate import BETTER_LAW, WORDS, estimates
from ..model.frame import Frame
from ..model.limits import LAW, LIMITS, Doubt, Limit, doubts
from ..model.other_law import has_other_formulas
from ..model.plan import depends_on
from ..model.reasons import RESTS_ON_SPACING, Cause, Failure, MissingInput, cause_and_step, explanation_of
from ..model.results import Results
from ..model.solver import values_of
from ..quantities.formatting import AS_USUAL, Format, amount, in_words, symbol_of
from ..quantities.laws import BETWEEN
from ..quantities.markup import marked, symbol
from ..quantities.nomenclature import CONVERTED, NOMENCLATURE, as_input, computed_as
from ..quantities.spreads import between
from ..quantities.values import QuantityError, parse_quantity
from ..report.answer import equation_of
from ..report.best_ranges import range_in_words
from ..report.notes import about_assumed, about_data, about_given, about_idle, about_middles, assumed, entering
from ..report.questions import quantity_named
from ..text import capital, quoted
from .bands import band_of
from .picture import (
    SAME,
    Axis,
    Curve,
    Field,
    Mark,
    Panel,
    Picture,
    Region,
    Rows,
    axis_around,
    described,
    evaluate,
    extent,
    is_flat,
    over,
)
from .picture_as_text import CURVE_ROWS, shown_values

MAX_CURVES = 24  # more cannot be distinguished
SIDE = 201  # points along each side of the grid for captions and limits, and along an axis without a count
MOST_BANDS = 4  # largest number of curves with bands of best ranges; more bands cannot be distinguished
ALONG = 1001  # points of a curve, unless its axis has another number
# By quantity: the sign in a terminal and the hatch on a page for regions beyond its limits. Regions beyond the limits
# of other quantities are only outlined. A hatch means the same quantity on every map. No two hatches together look like
# a third.
SIGNS = {
    "contact_radius_in_spacings": ("x", "...."),
    "displacement_ratio": ("/", "////"),
    "energy_over_yield": ("^", "----"),
    "tabor_parameter": ("|", "||||||"),
}
SLIGHT = ("'", "||")  # where a law is slightly off; this hatch is part of the hatch for a law that is far off
UNHATCHED = ("", "")
# The limit below which contacts open without a jump is on Tabor's parameter, too, but is not hatched.
HATCHED_LIMITS = tuple(limit for limit in LIMITS if limit.name in SIGNS and not limit.conclusion)
_MOST_EXCESS = log(1e3)  # the excess over a threshold is clipped at plus or minus this
_TWO, _THREE, _FOUR = (Format(digits=digits) for digits in (2, 3, 4))


class MapRequest(NamedTuple):
    """A quantity to draw, over one axis as curves or over two as a field."""

    quantity: str
    x: Axis
    y: Axis | None
    frames: tuple[tuple[str, Frame], ...]  # one for each curve, with its label
    marks: Sequence[str]
    materials: Materials
    limits: Sequence[Limit] = LIMITS  # drawn, or named in sentences, if they concern the quantity
    printed: str = ""  # the quantity by the formula as printed in the paper, if that formula differs
    has_best: bool = True  # True to draw the best ranges


def picture_of(request: MapRequest) -> tuple[Picture, tuple[str, ...]]:
    """Return the picture of a request, and its notes."""
    return _curves_of(request) if request.y is None else _map_of(request, request.y)


def _map_of(request: MapRequest, y: Axis) -> tuple[Picture, tuple[str, ...]]:
    """Return the picture of a field, with its limits as regions, and its notes."""
    quantity = request.quantity
    ((_, frame),) = request.frames
    x, y = (axis._replace(size=axis.size or SIDE) for axis in (request.x, y))
    layer = Layer(request, "", frame, [x._replace(size=SIDE), y._replace(size=SIDE)])
    drawn: list[Region] = []
    everywhere: list[Region] = []
    for region in layer.regions():
        if region.where:
            drawn.append(region)
        else:
            everywhere.append(region)
    field = Field(quantity, frame, layer.values, tuple(drawn), request.printed, layer.gaps, request.has_best)
    marks = [mark_at(text, request.materials, frame, x, y) for text in request.marks]
    of_materials, left_out = _material_marks(request.materials, x, y) if frame.material is None else ([], ())
    panel = Panel(x, y, marks=(*of_materials, *marks), field=field)
    unit = field.in_words([])[1]
    caption = tuple(_opening(quantity, [layer], unit))
    below = (*left_out, *_sentences({"": everywhere}))
    remarks = (f"{'; '.join(_about_marks(request, panel))}.",) if panel.marks else ()
    return Picture(described(quantity, unit), (panel,), caption, below, remarks), tuple(layer.notes)


def _curves_of(request: MapRequest) -> tuple[Picture, tuple[str, ...]]:
    """Return the picture of curves, and its notes."""
    quantity, x = request.quantity, request.x._replace(size=request.x.size or ALONG)
    layers: list[Layer] = []
    errors: dict[str, MissingInput | NoResult] = {}
    for text, frame in request.frames:
        try:
            layers.append(Layer(request, text, frame, [x]))
        except (MissingInput, NoResult) as error:
            errors[text] = error
    if not layers:
        raise next(iter(errors.values()))
    has_best = request.has_best and len(layers) <= MOST_BANDS
    curves = tuple(layer.curve(colour, has_best=has_best) for colour, layer in enumerate(layers))
    y = axis_around(quantity, _values_of(curves), may_be_log=True)
    curves = tuple(_without_narrow_band(curve, y) for curve in curves)
    marks = tuple(mark_at(text, request.materials, request.frames[0][1], x, y) for text in request.marks)
    farthest = _farthest_off(x, layers[0]) if len(layers) == 1 else ()
    regions_of = {layer.text: [*layer.regions()] for layer in layers}
    caption = tuple(_opening(quantity, layers))
    below = (*_sentences(regions_of), *farthest)
    notes = [f"no curve: {text}: {error}" for text, error in errors.items()]
    for layer in layers:
        notes += layer.notes
    return Picture("", (Panel(x, y, curves, marks),), caption, below), tuple(dict.fromkeys(notes))


def _values_of(curves: Sequence[Curve]) -> list[Any]:
    """Return the values of curves and of their bands' ends; only positive ends if all curves are positive."""
    values = [curve.y for curve in curves]
    is_positive = min(extent(of_curve)[0] for of_curve in values) > 0
    for curve in curves:
        if curve.band is not None:
            for end in (curve.band.low, curve.band.high):
                known = end[numpy.isfinite(end)]
                values.append(known[known > 0] if is_positive else known)
    return values


def _without_narrow_band(curve: Curve, y: Axis) -> Curve:
    """Return a curve without its band if the band is too narrow to be seen."""
    if curve.band is None or curve.band.is_seen(y.low, y.high, is_log=y.is_log):
        return curve
    return curve._replace(band=None, key="")


def distinction(frame: Frame, several: Iterable[str], models: Sequence[object]) -> str:
    """Return the label of a frame: its materials, its law if there are several, and inputs with several values."""
    parts = [material.name for material, _ in frame.materials]
    if len(models) > 1 and frame.stated_model is not None:
        parts.append(frame.law.title)
    for name in several:
        given = name if name in frame.given else computed_as(name)
        parts.append(f"{symbol(given)} = {amount(given, frame.given[given])}")
    return ", ".join(parts)


# --- Axes -------------------------------------------------------------------------------------------------------------

MAX_POINTS = 2000  # on an axis
_AXIS = re.compile(r"([^=]*)=(([^:,]*):([^:,]*)(?::([0-9]+))?(?::(lin|log))?)")  # NAME=FROM:TO:COUNT:SCALE


def axis_of(text: str, option: str) -> Axis:
    """Return the axis of a text `NAME=FROM:TO`, which may be followed by `:COUNT` and `:lin` or `:log`.

    >>> axis = axis_of("radius=1nm:1mm", "--x")
    >>> axis.name, axis.low, axis.high, axis.is_log
    ('radius', 1e-09, 0.001, True)
    """
    match = _AXIS.fullmatch(text)
    if match is None:
        raise BadRequest(f"{option}: write a quantity and its range, such as radius=1nm:1mm, with :lin for equal steps")
    word, values, first, last, count, scale = match.groups(default="")
    name = quantity_named(as_input(word))
    spread = between(first, last, count or "2", scale, name=name, text=values)
    if not spread.low < spread.high:
        raise QuantityError(name, values, "does not rise", "write FROM:TO with FROM below TO")
    if spread.size > MAX_POINTS:
        raise QuantityError(name, values, "has too many values", f"an axis has at most {MAX_POINTS}")
    return Axis(name, spread.low, spread.high, spread.is_log, spread.size if count else 0)


def check_axes(quantity: str, axes: Sequence[Axis], given: Iterable[str], models: tuple[str, ...]) -> None:
    """Raise BadRequest if an axis cannot be drawn over.

    The quantity has to depend on each axis, and no axis is the quantity, a given input, or the other axis.
    """
    within, fixed = depends_on((quantity,), models), {*map(computed_as, given)}
    for axis in axes:
        if computed_as(axis.name) in fixed:
            raise BadRequest(f"{axis.name} is on an axis; leave out its single value")
        if axis.name == quantity:
            raise BadRequest(f"{quantity} is the quantity that is drawn, so it cannot be an axis")
        if axis.name not in within:
            raise BadRequest(f"{quantity} does not depend on {axis.name}")
    if len({computed_as(axis.name) for axis in axes}) < len(axes):
        raise BadRequest(f"both axes are {axes[0].name}")


# --- Marks ------------------------------------------------------------------------------------------------------------


def mark_at(text: str, materials: Materials, frame: Frame, x: Axis, y: Axis) -> Mark:
    """Return the mark for `MATERIAL@RADIUS`, `MATERIAL` or `@RADIUS`. Raises BadRequest if it is outside the axes."""
    numbers = _frame_at(text, materials, frame).numbers(x.name, y.name)
    if not numbers or not all(axis.has(numbers.get(axis.name, axis.low)) for axis in (x, y)):
        raise BadRequest(f"--mark {quoted(text)} is outside the axes of {x.name} and {y.name}")
    return Mark(_name_of(text), numbers.get(x.name), numbers.get(y.name))


def _name_of(text: str) -> str:
    """Return the name of a mark.

    >>> _name_of("quartz@100nm"), _name_of("quartz"), _name_of("@1um")
    ('quartz, 100 nm', 'quartz', '1 µm')
    """
    name, _, radius = text.partition("@")
    size = amount("radius", parse_quantity(radius, "radius")) if radius else ""
    return ", ".join(filter(None, (name, size)))


def _frame_at(text: str, materials: Materials, frame: Frame) -> Frame:
    """Return the frame of a marked grain; what the mark does not give is as in `frame`."""
    name, _, radius = text.partition("@")
    material = materials[name] if name else None
    values = {"radius": parse_quantity(radius, "radius")} if radius else {}
    return Frame({**frame.stated, **values}, material or frame.material, frame.material2, model=frame.stated_model)


def _material_marks(materials: Materials, x: Axis, y: Axis) -> tuple[list[Mark], tuple[str, ...]]:
    """Return marks for the materials with a position on an axis, and a sentence of the caption about all others.

    Materials in one of several states, such as "below 175 K", are left out: the marks of one substance would crowd the
    edge of the picture.
    """
    placed, others = [], []
    for material in materials.materials.values():
        if material.state:
            continue
        numbers = Frame({}, material).numbers(x.name, y.name)
        positions = [numbers[axis.name] if axis.has(numbers.get(axis.name, nan)) else None for axis in (x, y)]
        if positions == [None, None]:
            others.append(material.name)
        else:
            placed.append(Mark(material.name, *positions))
    return placed, (f"Not shown: {', '.join(others)}.",) if placed and others else ()


def _about_marks(request: MapRequest, panel: Panel) -> Iterator[str]:
    """Iterate over texts about marks.

    A mark on one axis only gets its position there. A mark on both axes gets the value of the quantity, computed with
    its own inputs, and a remark if that differs from the value on the map.
    """
    quantity = request.quantity
    ((_, frame),) = request.frames
    typed = {_name_of(text): text for text in request.marks}
    for mark in panel.marks:
        positions = ((panel.x.name, mark.x), (panel.y.name, mark.y))
        numbers = {name: position for name, position in positions if position is not None}
        if len(numbers) == 2:
            on_map = frame.replace(**panel.x.inputs(mark.x), **panel.y.inputs(mark.y)).numbers(quantity)
            numbers = _frame_at(typed.get(mark.text, mark.text), request.materials, frame).numbers(quantity) or on_map
            if on_map and not isclose(numbers[quantity], on_map[quantity], rel_tol=SAME):
                yield f"{mark.text} has other inputs than those fixed here"
        for name, value in numbers.items():
            yield f"{mark.text}: {symbol(name)} = {amount(name, value, _FOUR)}"


# --- The quantity of one frame --------------------------------------------------------------------------------------


class Layer:
    """A quantity of one frame over one axis or two: values, fixed inputs, judged limits, and notes.

    Raises MissingInput if the quantity cannot be computed, and NoResult if it has no value.
    """

    def __init__(self, request: MapRequest, text: str, frame: Frame, axes: Sequence[Axis]) -> None:
        """Evaluate the quantity of a request in a frame. `text`: the label of the curve."""
        quantity = request.quantity
        self.text, self.given, self.quantity, self.axes = text, frame, quantity, axes
        drawn: dict[str, Any] = {}
        for axis in axes:
            drawn |= axis.inputs(axis.high)
        self.frame = frame.replace(**drawn)  # at the upper ends; a quantity needs the same inputs all along an axis
        points = over(frame, *axes)
        self.doubts: list[Doubt] = []
        missing: list[JkrollError] = []
        names = [quantity]
        for doubt in _doubts(points, quantity, request.limits):
            if doubt.error is not None:
                missing.append(doubt.error)
                continue
            self.doubts.append(doubt)
            if doubt.limit in HATCHED_LIMITS:
                names.append(doubt.limit.name)
        inputs, used = self.frame.inputs_of(*names), self.frame.inputs_of(quantity)
        # A load that only limits need is shown if it was given, but not if it was assumed.
        shown = [name for name in inputs if name in used or name != "load" or name in self.frame.given]
        self.inputs = inputs_as_texts(self.frame, self._fixed(shown, drawn.keys()))
        self.unjudged = [*self._about_unjudged(missing[0])] if missing else []
        self.notes = [note.text for note in about_idle(entering(self.frame, names, judges=False)[1])]
        self.notes += notes_on(points, self.frame, shown, names)
        remark = NOMENCLATURE[quantity].note
        if remark:
            self.notes.append(f"{symbol_of(quantity)}: {remark}")
        self.values = evaluate(frame, quantity, *axes)
        self.known = numpy.isfinite(self.values)
        if not self.known.any():
            raise self._failure()
        self.gaps = _phrases(points.column(quantity).reasons)

    def _about_unjudged(self, error: JkrollError) -> Iterator[str]:
        """Iterate over the sentences of a caption with limits that are not judged; `error` is the reason."""
        if self.quantity == "pull_off_force" and self.given.law.is_default and len(self.axes) > 1:
            yield "DMT's law, for small, hard spheres, gives 4/3 of this force."
        yield f"Which law holds, and other limits, are not judged: {_why_not_judged(error)}."

    def _failure(self) -> Failure:
        """Return the error about a quantity without any value, with the reason at the upper ends of the axes."""
        problem = "no value anywhere on these axes"
        for error in self.frame.errors(self.frame.columns([self.quantity])).values():
            problem += f": {explanation_of(self.quantity, error)}"
        return Failure(Cause("", problem), self.quantity)

    def _fixed(self, inputs: Iterable[str], drawn: Collection[str]) -> list[str]:
        """Return the inputs that are not drawn on an axis.

        If Poisson's ratio is on an axis, a given shear modulus replaces Young's modulus, which varies with the ratio.
        """
        moduli = {}
        if "poisson_ratio" in drawn or "poisson_ratio2" in drawn:
            for name in ("shear_modulus", "shear_modulus2"):
                if name in self.given.described:
                    moduli[CONVERTED[name]] = name
        on_axes = {*map(computed_as, drawn)}
        return [moduli.get(name, name) for name in inputs if name not in on_axes]

    def curve(self, colour: int, *, has_best: bool) -> Curve:
        """Return the curve of the quantity along its axis, with the band of its best ranges and the rows to show."""
        (x,) = self.axes
        shown = shown_values(x, CURVE_ROWS)
        at_shown = self.given.replace(**x.inputs(shown))
        values = numpy.broadcast_to(values_of(at_shown, [self.quantity])[self.quantity], shown.shape)
        known = numpy.isfinite(values)
        rows = Rows(shown[known], values[known]) if known.any() else None
        band = band_of(over(self.given, x), self.quantity, self.values.shape) if has_best else None
        if band is None:
            return Curve(self.text, x.values(), self.values, colour, rows=rows)
        best = band_of(at_shown, self.quantity, shown.shape) if rows is not None else None
        if rows is not None and best is not None:
            ranges, rules = [], []
            for estimate in compress(best.estimates(), known):
                ranges.append(range_in_words(self.quantity, estimate))
                rules.append(WORDS[estimate.by])
            rows = rows._replace(best=tuple(ranges), by=tuple(rules))
        line = self.frame.law.short if self.frame.stated_model is None else "line"  # a stated law is in the text
        key = f"{line}; band: best range {band.rules(self._where)}"
        return Curve(self.text, x.values(), self.values, colour, band=band, key=key, rows=rows)

    def regions(self) -> Iterator[Region]:
        """Iterate over the regions of each limit: beyond its last threshold, then beyond its first one, if they differ.

        An empty region is left out. So is the wider region if the narrower one covers all points with a value.
        """
        for doubt in self.doubts:
            limit = doubt.limit
            first, *_, last = (limit.threshold, *limit.codes)
            for threshold in dict.fromkeys((last, first)):
                excess_there = limit.excess(threshold)
                is_beyond = self.known & (doubt.excess > excess_there)
                if not is_beyond.any():
                    continue
                text, where = self._text_beyond(limit, threshold), self._where(is_beyond)
                look = UNHATCHED
                if limit in HATCHED_LIMITS:
                    look = SLIGHT if limit.number is not None and threshold == first else SIGNS[limit.name]
                name, colon, _ = text.partition(":")  # a condition, or the first words of a consequence
                if not colon:
                    name = limit.codes[threshold].replace("-", " ")
                yield Region(text, where, *look, name, partial(_excess_over, limit, excess_there, self.quantity))
                if not where:
                    break

    def _text_beyond(self, limit: Limit, threshold: float) -> str:
        """Return the text of the region beyond a threshold.

        For the limit of the law, it says how far the law is off. For other limits it is the condition and the
        consequence, as in "a/z0 < 3: …", or only the consequence if the limit computes the number that it judges.
        """
        if limit is LAW:
            size = f"{100 * (threshold - 1):.0f} %" if threshold < 2 else f"a factor of {threshold:g}"
            return f"{self.given.law.title} is off by more than {size}"
        meaning = marked(limit.consequence.partition(";")[0])
        if limit.number is not None:
            return meaning
        number, unit = AS_USUAL.rounded(limit.name, threshold)
        condition = f"⟦{NOMENCLATURE[limit.name].symbol} {limit.sign[0]} {number}⟧ {unit}".rstrip()
        return f"{condition}: {meaning}"

    def _where(self, is_beyond: Any) -> str:
        """Return in words where a condition holds; an empty text if it holds at all points with a value."""
        if (is_beyond == self.known).all():
            return ""
        if len(self.axes) == 1:
            return _stretches(self.axes[0], is_beyond, self.known)
        for axis, across in zip(self.axes, (0, 1), strict=True):  # the rows of a map run along x
            beyond, known = is_beyond.any(axis=across), self.known.any(axis=across)
            if (is_beyond == (self.known & numpy.expand_dims(beyond, across))).all():
                return _stretches(axis, beyond, known)
        return "in part of the map"


def _stretches(axis: Axis, is_beyond: Any, known: Any) -> str:
    """Return the stretches of an axis on which a condition holds, in words; points without a value are skipped."""
    values, beyond = axis.values()[known], is_beyond[known]
    edges = numpy.flatnonzero(numpy.diff(beyond, prepend=False, append=False)).reshape(-1, 2)
    stretches = []
    for first, last in edges:
        ends = [amount(axis.name, values[end], _TWO) for end in (first, last - 1)]
        stretches.append(" to ".join(dict.fromkeys(ends)))
    return f"{symbol(axis.name)} = {', '.join(stretches)}"


def _phrases(reasons: Any) -> tuple[str, ...]:
    """Return the phrases of the reasons why points have no value."""
    phrases: dict[str, None] = {}
    for number in numpy.unique(reasons).tolist():
        cause, _ = cause_and_step(number)
        if cause is not None and cause.phrase:
            phrases[cause.phrase] = None
    return tuple(phrases)


def _why_not_judged(error: JkrollError) -> str:
    """Return the reason why a limit is not judged, as a clause."""
    return f"that {error.explanation()}" if isinstance(error, MissingInput) else str(error)


def _doubts(points: Frame, quantity: str, limits: Iterable[Limit]) -> list[Doubt]:
    """Return the doubts about a quantity, one for each limit."""
    return doubts(points, points.columns([quantity]), limits)


def _excess_over(limit: Limit, excess_there: float, quantity: str, points: Frame) -> Any:
    """Return the excess of a limit minus its excess at a threshold, clipped at ±_MOST_EXCESS."""
    (doubt,) = _doubts(points, quantity, [limit])
    return numpy.clip(doubt.excess - excess_there, -_MOST_EXCESS, _MOST_EXCESS)


# --- Sentences of a caption -------------------------------------------------------------------------------------------


def inputs_as_texts(frame: Frame, names: Iterable[str]) -> tuple[str, ...]:
    """Return texts with the materials of a frame, and with the values of these inputs."""
    materials = [frame.material.name] if frame.material is not None else []
    if frame.material2 is not None:
        materials.append(f"material2 = {frame.material2.name}")
    texts = [f"{symbol(name)} = {amount(name, in_words(name, frame[name]))}" for name in names]
    return (*materials, *texts)


def notes_on(given: Frame, frame: Frame, inputs: Collection[str], names: Sequence[str]) -> list[str]:
    """Return notes on uncertain inputs (a picture uses their middle values), assumptions, given inputs and their data.

    `given`: the frame as the user gave it, or the frame of all points of a picture; `frame`: the frame of one point.
    """
    uncertain = {name: value for name, value in given.uncertainties.items() if name in inputs}
    assumptions = assumed(frame, inputs, names, has_values=False)
    notes = [*about_middles(uncertain), *about_assumed(assumptions)]
    notes += [*about_given(frame, names, inputs), *about_data(given, inputs)]
    return [note.text for note in dict.fromkeys(notes)]


def fixed_inputs(inputs: Sequence[str]) -> tuple[str, ...]:
    """Return the sentence of a caption about fixed inputs, if there are any."""
    return (f"Fixed: {', '.join(inputs)}.",) if inputs else ()


def _opening(quantity: str, layers: Sequence[Layer], unit: str = "") -> Iterator[str]:
    """Iterate over the first sentences of a caption: quantity, fixed inputs, values, and limits that are not judged.

    `unit`: the unit of all numbers of the picture; empty if each number has its own.
    """
    clauses = [capital(described(quantity, unit))]  # `capital` does not change a formula that begins the sentence
    equations = {equation_of(layer.frame, quantity) for layer in layers}
    laws = {layer.frame.law.title for layer in layers if layer.frame.stated_model is not None}
    equation = equations.pop() if len(equations) == 1 else ""
    if equation:
        clauses.append(f"Eq ({equation})" if equation.isdigit() else equation)
    if len(laws) == 1:
        clauses.append(f"under {laws.pop()}")
    elif not laws and any(has_other_formulas(layer.frame, quantity, BETWEEN) for layer in layers):
        clauses.append(f"by {layers[0].frame.law.short}")
    yield ", ".join(clauses) + "."
    shared = set(layers[0].inputs).intersection(*(layer.inputs for layer in layers))
    yield from fixed_inputs([text for text in layers[0].inputs if text in shared])
    flat = [layer for layer in layers if is_flat(layer.values)]
    if flat:
        values = []
        for layer in flat:
            of_layer = f" ({layer.text})" if layer.text else ""
            values.append(amount(quantity, extent(layer.values)[0], _FOUR) + of_layer)
        yield f"{symbol(quantity)} is the same everywhere: {', '.join(values)}."
    if any(layer.frame.may_rest_on_spacing(quantity) and not layer.known.all() for layer in layers):
        yield f"No value where {symbol(quantity)} {RESTS_ON_SPACING.words}."
    unjudged: list[str] = []
    for layer in layers:
        unjudged += layer.unjudged
    yield from dict.fromkeys(unjudged)


def _sentences(regions_of: Mapping[str, Iterable[Region]]) -> Iterator[str]:
    """Iterate over sentences that state where the model has no meaning or is not exact.

    `regions_of`: the regions of each layer, by its label.
    """
    places: dict[str, dict[str, str]] = {}  # by the text of a region and the label of a layer
    for label, regions in regions_of.items():
        for region in regions:
            places.setdefault(region.text, {})[label] = region.where
    for text, place_of in places.items():
        if len(place_of) == len(regions_of) and not any(place_of.values()):
            yield f"Everywhere {text}."
        else:
            places_of_text = []
            for label, place in place_of.items():
                places_of_text.append(", ".join(filter(None, (label, place or "everywhere"))))
            yield f"{capital(text)} ({'; '.join(places_of_text)})."


def _farthest_off(x: Axis, layer: Layer) -> Iterator[str]:
    """Iterate over at most one sentence: where the law of a curve is farthest off, and the value by Maugis' law."""
    for doubt in layer.doubts:
        if doubt.limit is not LAW:
            continue
        excess = numpy.where(layer.known, doubt.excess, -numpy.inf)
        value = float(x.values()[excess.argmax()])
        quantity, farthest = layer.quantity, layer.given.replace(**x.inputs(value))
        best = estimates(Results(farthest, farthest.columns([quantity])), [quantity]).get(quantity)
        if excess.max() > 0 and best is not None and best.by == BETTER_LAW:
            place, shown = amount(x.name, value, _TWO), amount(quantity, farthest[quantity], _THREE)
            law = farthest.law.title
            yield (
                f"{law} is farthest off at {symbol(x.name)} = {place}: {symbol(quantity)} = "
                f"{range_in_words(quantity, best)} by Maugis' law, {shown} by {law}."
            )
