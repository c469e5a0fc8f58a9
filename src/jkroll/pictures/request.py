"""A user's request for a plot, or a map of the paper, as a map or curves with caption and notes.

The paper's Figs. 2 and 9 are in `curves`; its others carry no data.
"""

from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from types import MappingProxyType
from typing import Any, NamedTuple

from ..answers.notes import about_given, about_idle, symbol_of
from ..answers.results import equation_of
from ..errors import BadRequest, NoResult
from ..materials.library import Materials
from ..physics.shifted import rolled_over_displacement
from ..quantities.formatting import amount, in_words
from ..quantities.nomenclature import NOMENCLATURE, PROPERTIES
from ..quantities.values import parse_quantity
from ..scene.failures import MissingInput, NotInLaw, reason_of
from ..scene.scene import DEFAULTS, Scene
from ..scene.wiring import depends_on
from ..text import capitalized, quoted
from .axes import Axis, described
from .maps import (
    Bound,
    Curve,
    Map,
    Mark,
    Panel,
    Picture,
    Region,
    along,
    axis_around,
    bounds,
    bounds_of,
    coordinate,
    evaluate,
    has_values,
    label_of,
    lacking,
    margin_along,
    material_marks,
    regions,
    unit_of_labels,
)
from .styles import EVERYWHERE

MAX_POINTS = 4_000_000  # of a map
MAX_ALONG = 1_000_000  # points of all curves together


class PlotRequest(NamedTuple):
    """A quantity to draw over one axis as curves, or over two as a map."""

    quantity: str
    x: Axis
    y: Axis | None
    scenes: tuple[tuple[str, Scene], ...]  # a curve each, with its label
    marks: tuple[str, ...]
    materials: Materials
    is_plain: bool = False  # without the limits of the model


class NothingToDraw(NoResult):
    """Error raised when a map or curves have no value at all."""

    def __init__(self, quantity: str, outcome: Any = None) -> None:
        """`outcome`: that of a scene on these axes, perhaps the reason."""
        super().__init__(quantity, outcome)
        self.quantity, self.outcome = quantity, outcome

    def __str__(self) -> str:
        has_reason = isinstance(self.outcome, NoResult | MissingInput)
        reason = f": {reason_of(self.quantity, self.outcome)}" if has_reason else ""
        return f"{self.quantity} has no value anywhere on these axes{reason}"


def mark_at(text: str, materials: Materials, scene: Scene, x: Axis, y: Axis) -> Mark:
    """Return the mark of `MATERIAL@RADIUS`, `MATERIAL` or `@RADIUS` on a map."""
    name, _, radius = text.partition("@")
    material = materials[name] if name else None
    values = {"radius": parse_quantity(radius, "radius")} if radius else {}
    there = Scene({**scene.stated, **values}, material or scene.material, scene.material2, model=scene.stated_model)
    mark = Mark(text, coordinate(x, there), coordinate(y, there))
    if mark.x is None and mark.y is None:
        raise BadRequest(f"--mark {quoted(text)} is nowhere on {x.name} and {y.name} as they are drawn")
    return mark


def sized(axis: Axis, size: int) -> Axis:
    """Return the axis with `size` values if it has no size of its own."""
    return axis if axis.size else axis._replace(size=size)


def map_of(request: PlotRequest, size: tuple[int, int]) -> tuple[Map, tuple[str, ...]]:
    """Return the map of a request, by default with `size` points across and up, and notes on it."""
    assert request.y is not None
    quantity, scene = request.quantity, request.scenes[0][1]
    x, y = sized(request.x, size[0]), sized(request.y, size[1])
    if x.size * y.size > MAX_POINTS:
        raise BadRequest(f"{x.size} x {y.size} points are more than {MAX_POINTS}")
    at_an_end = {**x.inputs(x.high), **y.inputs(y.high)}  # what a quantity needs is the same all along an axis
    context = Context(quantity, scene, at_an_end, is_plain=request.is_plain)
    values = evaluate(scene, quantity, x, y)
    if not has_values(values):
        raise NothingToDraw(quantity, context.scene.evaluate([quantity])[quantity])
    marks = tuple(mark_at(text, request.materials, scene, x, y) for text in request.marks)
    others: tuple[str, ...] = ()
    if scene.material is None and {x.name, y.name} & {*PROPERTIES}:
        of_materials, others = material_marks(request.materials, x, y)
        marks = (*of_materials, *marks)
    found = tuple(regions(scene, context.bounds, x, y, values))
    caption = (_first_sentence(quantity, [context.scene]), *fixed_inputs(context.inputs), *others)
    return Map(
        quantity, scene, x, y, values, found, marks, described(quantity, unit_of_labels(quantity, values)), caption
    ), context.notes


def curves_of(request: PlotRequest, size: int) -> tuple[Picture, tuple[str, ...]]:
    """Return the curves of a request, by default of `size` points, and notes on them."""
    x = sized(request.x, size)
    if x.size * len(request.scenes) > MAX_ALONG:
        raise BadRequest(f"{len(request.scenes)} x {x.size} points are more than {MAX_ALONG}")
    contexts: list[Context] = []
    curves: list[Curve] = []
    missing: dict[str, MissingInput] = {}
    for text, scene in request.scenes:
        try:
            context = Context(request.quantity, scene, x.inputs(x.high), is_plain=request.is_plain)
        except MissingInput as error:
            missing[text] = error
            continue
        curves.append(Curve(text, x.values(), along(scene, request.quantity, x), len(contexts)))
        contexts.append(context)
    if not curves:
        raise next(iter(missing.values()))
    if not any(has_values(curve.y) for curve in curves):
        raise NothingToDraw(request.quantity, contexts[0].scene.evaluate([request.quantity])[request.quantity])
    y = axis_around(request.quantity, [curve.y for curve in curves])
    points = [mark_at(text, request.materials, request.scenes[0][1], x, y) for text in request.marks]
    shared = [text for text in contexts[0].inputs if all(text in context.inputs for context in contexts)]
    caption = (
        _first_sentence(request.quantity, [context.scene for context in contexts]),
        *fixed_inputs(shared),
        *((f"No curve: {'; '.join(text + lacking(error) for text, error in missing.items())}.",) if missing else ()),
        *_doubts_along(x, curves, contexts),
    )
    notes = [f"no curve: {error}" for error in missing.values()]
    notes += dict.fromkeys(note for context in contexts for note in context.notes)
    return Picture("", (Panel(x, y, tuple(curves), tuple(points)),), caption), tuple(notes)


def _doubts_along(x: Axis, curves: Sequence[Curve], contexts: "Sequence[Context]") -> Iterator[str]:
    """Iterate over sentences on the parts of curves where the model has no meaning or is not exact."""
    doubts: dict[str, list[tuple[str, str]]] = {}  # the curves and their parts, by the doubt
    for curve, context in zip(curves, contexts, strict=True):
        for doubt, where in context.doubts(x, curve.y):
            doubts.setdefault(doubt, []).append((curve.text, where))
    for doubt, places in doubts.items():
        if places == [(curve.text, EVERYWHERE) for curve in curves]:
            yield f"Everywhere {doubt}."
        else:
            yield f"{'; '.join(', '.join(filter(None, place)) for place in places)}: {doubt}."


class Context:
    """The inputs that are fixed all over a picture, the bounds of the model, and notes on the data.

    Raises MissingInput if the quantity cannot be computed.
    """

    def __init__(self, quantity: str, scene: Scene, values: Mapping[str, float], *, is_plain: bool = False) -> None:
        """Describe a quantity of a scene; `values` holds one value of each axis. `is_plain`: without bounds."""
        self.given = scene
        self.scene = scene.replace(**values)
        self.bounds: list[Bound] = []
        notes = []
        for bound in () if is_plain else bounds_of(self.scene, quantity):
            try:
                self.scene.plan(bound.name)
                self.bounds.append(bound)
            except NotInLaw:
                continue
            except MissingInput as error:
                notes.append(f"the limits are not shown: {NOMENCLATURE[error.wanted].symbol} {error.reason()}")
        names = [quantity, *(bound.name for bound in self.bounds)]
        inputs = self.scene.inputs_of(*names)
        self.inputs = inputs_as_texts(self.scene, [name for name in inputs if name not in values])
        note = NOMENCLATURE[quantity].note
        idle = [note.text for note in about_idle(self.scene, inputs)]
        data = notes_on(self.scene, inputs, names)
        self.notes = tuple(
            dict.fromkeys([*notes[:1], *idle, *data, *([f"{symbol_of(quantity)}: {note}"] if note else [])])
        )

    def doubts(self, x: Axis, y: Any) -> Iterable[tuple[str, str]]:
        """Iterate over clauses on the model, which has no meaning or is not exact, each with the part of a curve where that is so."""
        import numpy

        has_value = numpy.isfinite(y)
        settled = set()  # numbers that are beyond their farthest bound all over
        for bound in self.bounds:
            if bound.name in settled:
                continue
            is_beyond = has_value & (margin_along(self.given, bound, x) < 0)
            where = x.values()[is_beyond]
            if (is_beyond == has_value).all():
                settled.add(bound.name)
                yield bound.beyond, EVERYWHERE
            elif where.size:
                ends = (amount(x.name, float(f"{end:.2g}")) for end in (where[0], where[-1]))
                yield bound.beyond, f"{NOMENCLATURE[x.name].symbol} = {' to '.join(ends)}"


def inputs_as_texts(scene: Scene, names: Iterable[str]) -> tuple[str, ...]:
    """Return the materials of a scene, and inputs with their values."""
    materials = [scene.material.name] if scene.material is not None else []
    if scene.material2 is not None:
        materials.append(f"material2 = {scene.material2.name}")
    values = ((name, in_words(name, scene.values[name])) for name in names)
    return (*materials, *(f"{NOMENCLATURE[name].symbol} = {amount(name, value)}" for name, value in values))


def notes_on(scene: Scene, inputs: Collection[str], names: Sequence[str]) -> list[str]:
    """Return notes on the assumptions and the data from which quantities follow."""
    return [note.text for note in about_given(scene, [*names], inputs, scene.stated)]


def _first_sentence(quantity: str, scenes: Sequence[Scene]) -> str:
    """Return the first sentence of a caption: the quantity, and its equation and the law that was named, if there is one."""
    entry = NOMENCLATURE[quantity]
    parts = [f"{capitalized(entry.sentence)} {entry.symbol}"]
    equations = {equation_of(scene, quantity) for scene in scenes}
    laws = {scene.law.title for scene in scenes if scene.stated_model is not None}
    if len(equations) == 1 and (equation := equations.pop()):
        parts.append(f"Eq ({equation})" if equation.isdigit() else equation)
    if len(laws) == 1:
        parts.append(f"under {laws.pop()}")
    return ", ".join(parts) + "."


def fixed_inputs(inputs: Sequence[str]) -> tuple[str, ...]:
    """Return the sentence of a caption about fixed inputs, if there are any."""
    return (f"Held: {', '.join(inputs)}.",) if inputs else ()


# --- Maps of the paper: Figs. 3, 6 and 8 ------------------------------------------------------------------------------


class Figure(NamedTuple):
    """A map of the paper: its quantity, its axes, what it assumes, and what the paper's text reads off it."""

    quantity: str
    x: Axis
    given: Mapping[str, float]
    remark: str
    has_log_labels: bool = True
    guide: tuple[float, str] | None = None  # a radius that the text speaks of
    point: tuple[float, float, str] | None = None  # (x, R1) that the text speaks of
    printed: str = ""
    shades_no_rolling: bool = False  # where spheres roll by less than ξ


RADII = Axis("radius", 5e-10, 1e-3)
_ENERGIES = Axis("surface_energy", 1e-3, 1e1)
# E1* = E1/(1 - ν1²) is 10 GPa in Fig. 6a; elsewhere it enters only where the model has no meaning.
_SOFT = {"youngs_modulus": 1e10, "poisson_ratio": 0.0}
_LIGHT = {**_SOFT, "density": 2000.0}

FIGURES: Mapping[str, Figure] = MappingProxyType(
    {
        "3a": Figure("pull_off_force", _ENERGIES, _SOFT, "P_c = 3πγR with R = R1/2: JKR; small, hard spheres tend to 4πγR."),
        "3b": Figure(
            "yield_force_ratio",
            _ENERGIES,
            _SOFT,
            "It does not depend on γ. The forces are equal (contour 0) at R1 = 4ξ = 0.8 nm; the text has 1 nm. There, "
            "as the text warns, elasticity holds no longer.",
            guide=(1e-9, "1 nm"),
        ),
        "3c": Figure(
            "r_min",
            _ENERGIES,
            _SOFT,
            "It does not depend on γ: R1²/ξ. At R1 = 100 nm it is 50 µm (log: −4.3), 500 times the radius.",
            guide=(1e-7, "100 nm"),
        ),
        "3d": Figure(
            "n_grav",
            _ENERGIES,
            _LIGHT,
            "About a thousand (contour 3) spheres of 100 nm stand at γ = 25 mJ/m². A single sphere (contour 0) rolls from "
            "8 µm (polystyrene) to 52 µm (iron) on; the text has about 100 µm.",
            guide=(1e-4, "100 µm"),
            point=(0.025, 1e-7, "1071"),
        ),
        "6a": Figure(
            "vertical_frequency",
            _ENERGIES,
            _LIGHT,
            "GHz (contour 9) at R1 = 35 nm (γ = 1 mJ/m²) to 130 nm (10 J/m²): almost independent of γ, which enters by its power 1/6.",
        ),
        "6b": Figure(
            "rolling_frequency",
            _ENERGIES,
            _LIGHT,
            "Eq (40) as it follows. The paper's curves are Eq (41), 2.5 times lower (0.4 in the logarithm). At R1 = 100 nm and "
            "γ = 100 mJ/m² it is 5.3 times slower than the vertical vibration; the text has one to two orders.",
            printed="rolling_frequency_as_printed",
        ),
        "8": Figure(
            "n_roll",
            Axis("modulus_over_energy", 1e9, 1e13, beside={"surface_energy": 1.0}),  # γ may be any
            {},
            "For W0 = P_cδ0; in general these are n_roll/(W0/P_cδ0). An energy balance gives 7/2 of Eq (49). Below 10 nm, spheres "
            "with E*/γ above 3·10¹² m⁻¹ do not roll; below 100 nm a full turn takes E*/γ below 1.5·10⁹ m⁻¹.",
            has_log_labels=False,
            guide=(1e-8, "10 nm"),
            shades_no_rolling=True,
        ),
    }
)  # fmt: skip


def figure(
    name: str, materials: Materials, size: tuple[int, int], *, as_printed: bool = False, is_plain: bool = False
) -> Map:
    """Return a map of the paper with `size` points across and up. `is_plain`: without the limits of the model."""
    declared = FIGURES[name]
    scene = Scene(declared.given)
    x, y = declared.x._replace(size=size[0]), RADII._replace(size=size[1])
    values = evaluate(scene, declared.quantity, x, y)
    printed = evaluate(scene, declared.printed, x, y) if as_printed and declared.printed else None
    limits = () if is_plain else bounds(declared.quantity)
    shaded = (_no_rolling(scene, values, x, y),) if declared.shades_no_rolling and limits else ()
    marks, others = material_marks(materials, x, y)
    points = (Mark(declared.point[2], *declared.point[:2]),) if declared.point else ()
    return Map(
        declared.quantity,
        scene,
        x,
        y,
        values,
        (*shaded, *regions(scene, limits, x, y, values)),
        (*marks, *points),
        f"Fig. {name}: {label_of(declared.quantity, has_log_labels=declared.has_log_labels)}",
        (*_caption(declared, limits, as_printed=printed is not None), *others),
        declared.has_log_labels,
        printed,
        (Mark(declared.guide[1], None, declared.guide[0]),) if declared.guide else (),
        (declared.remark,),
    )


def _no_rolling(scene: Scene, turns: Any, x: Axis, y: Axis) -> Region:
    """Return the region in which spheres roll by less than ξ, given their turns."""
    import numpy

    shift = scene.values["yield_displacement"]
    rolled = rolled_over_displacement(n_roll=turns, radius=y.values()[:, None], yield_displacement=shift)
    return Region("2πR1 n_roll < ξ: it does not roll", x, y, numpy.log10(rolled), "rolled_over_displacement")


def _caption(declared: Figure, limits: Collection[Bound], *, as_printed: bool) -> tuple[str, ...]:
    """Return the caption: the quantity and its equation, and the assumptions."""
    quantity = NOMENCLATURE[declared.quantity]
    at_a_corner = {RADII.name: RADII.high, **declared.x.inputs(declared.x.low)}
    scene = Scene({**declared.given, **at_a_corner})
    shown = f"{capitalized(quantity.sentence)} {quantity.symbol}, Eq ({equation_of(scene, declared.quantity)})."
    if as_printed:
        shown += f" Dashed: Eq ({NOMENCLATURE[declared.printed].equation}) as printed."
    used = _assumed(scene, declared, {declared.quantity})
    of_limits = _assumed(scene, declared, {bound.name for bound in limits}) if limits else []
    elsewhere = [text for text in of_limits if text not in used]
    parts = [", ".join(["identical spheres", *used]), f"hatches: {', '.join(elsewhere)}" if elsewhere else ""]
    return shown, f"Assumed: {'; '.join(filter(None, parts))}."


def _assumed(scene: Scene, declared: Figure, names: Collection[str]) -> list[str]:
    """Return the assumed inputs of these quantities, as texts."""
    used = {*scene.inputs_of(*names), *(name for name in ("load", "energy_ratio") if name in depends_on(names))}
    texts = []
    for name, value in {**DEFAULTS, **declared.given}.items():
        if name in used and name != "poisson_ratio":
            symbol = "E1/(1 − ν1²)" if name == "youngs_modulus" else NOMENCLATURE[name].symbol
            texts.append(f"{symbol} = {amount(name, value)}")
    return texts
