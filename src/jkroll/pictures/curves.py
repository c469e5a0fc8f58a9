"""Curves of one contact: force, pressure and moment, in JKR or by several laws of attraction."""

from collections.abc import Callable, Iterator, Mapping, Sequence
from itertools import groupby
from math import inf
from typing import Any

import numpy

from ..answers.answer import Answer
from ..answers.curve import EQUILIBRIUM, MAX_LOAD, NAMED, OF_CURVE, PULL_OFF, Loads, states
from ..answers.questions import Question
from ..physics.contact import pressure
from ..quantities.formatting import Format, amount
from ..quantities.laws import DEFAULT_LAW
from ..quantities.markup import symbol
from ..scene.failures import BEYOND_PULL_OFF, Failure, NotInLaw
from ..scene.scene import Scene
from ..scene.solver import values_of
from .picture import Axis, Curve, Mark, Panel, Picture, axis_around, clipped
from .request import fixed_inputs, inputs_as_texts, notes_on

POINTS = 401
AREA_AND_PRESSURES = ("contact_radius_at_load", "hertz_pressure", "boussinesq_pressure")
_FORCE = ("approach_at_load", "load")
_OF_MOMENT = Question(("yield_moment",), ("yield_moment",))
# The models of the moment without load, in as few words as a legend below a panel has room for.
_OF_MOMENTS = {
    "yield_moment": "exact",
    "half_circles_moment": "two half-circles",
    "fixed_approach_moment": "exact, at a fixed approach",
}
_NO_LOAD = "⟦P = 0⟧"
_BRANCHES = ("stable", "fixed grips", "unstable", "without contact")  # of force curves, each with its own colour


def _force(scenes: Sequence[Scene], loads: Loads | None) -> Panel:
    """Return force against approach up to one load, with the loads that were given as the ends of its axis.

    The branches of one law have a colour each, as have several laws.
    """
    most = max(0.0, loads.high) if loads else MAX_LOAD * max(scene["pull_off_force"] for scene in scenes)
    is_one = len(scenes) == 1
    curves: list[Curve] = []
    points: list[Mark] = []
    for number, scene in enumerate(scenes):
        for name, x, y in _branches(scene, most):
            if name not in NAMED:
                look = (name, x, y, _BRANCHES.index(name)) if is_one else (scene.law.title, x, y, number)
                curves.append(Curve(*look))
            elif is_one:
                points.append(Mark(_NO_LOAD if name == EQUILIBRIUM else name, x, y))
    if loads is not None:
        least = min(float(curve.y.min()) for curve in curves)
        curves = [part for part in (clipped(curve, *loads) for curve in curves) if part.y.size > 1]
        points = [point for point in points if point.y is not None and loads.low <= point.y <= loads.high]
        if not curves:
            raise Failure(BEYOND_PULL_OFF, numbers=(loads.high, least))
    x = axis_around("approach_at_load", [curve.x for curve in curves])
    y = axis_around("load", [curve.y for curve in curves], margin=0.08)
    ends = Axis("load", *loads, is_log=False) if loads is not None else y
    title = "force, Eqs (5) and (6)" if is_one and scenes[0].law.is_default else f"force{_of_law(scenes)}"
    return Panel(x, ends, tuple(curves), tuple(points), title)


def _branches(scene: Scene, most: float) -> Iterator[tuple[str, Any, Any]]:
    """Iterate over the branches of a force curve up to a load and its named states: name, approaches, loads.

    A branch begins at the state before it.
    """
    path = states(scene, Loads(-inf, most), POINTS)
    groups = [
        values_of(scene.replace(**{given: numpy.array([state.value for state in group])}), _FORCE)
        for given, group in groupby(path, key=lambda state: state.given)
    ]
    x, y = (numpy.concatenate([group[name] for group in groups]) for name in _FORCE)
    starts: dict[str, int] = {}
    for place, name in enumerate(state.name for state in path):
        if name in NAMED:
            yield name, float(x[place]), float(y[place])
        else:
            starts.setdefault(name, max(place - 1, 0))
    ends = [*[*starts.values()][1:], len(path) - 1]
    for (name, start), end in reversed([*zip(starts.items(), ends, strict=True)]):
        yield name, x[start : end + 1], y[start : end + 1]


def _pressure(scenes: Sequence[Scene], _: Loads | None) -> Panel:
    """Return the pressure across the contact, which JKR alone has, without load and at pull-off."""
    (scene,) = scenes
    curves = []
    for text, name, branch in ((_NO_LOAD, EQUILIBRIUM, "stable"), (PULL_OFF, PULL_OFF, "fixed grips")):
        state = values_of(scene.replace(load_factor=NAMED[name]), AREA_AND_PRESSURES)
        x = across(-state["contact_radius_at_load"], state["contact_radius_at_load"])
        curves.append(Curve(text, x, pressure(distance=abs(x), **state), _BRANCHES.index(branch)))
    return pressure_panel(curves, state["hertz_pressure"], f"pressure, Eq (12){_of_law(scenes)}")


def _moment(scenes: Sequence[Scene], _: Loads | None) -> Panel:
    """Return the moment without load against ξ, up to the ξ at which JKR's leading edge would interpenetrate."""
    limit = scenes[0].replace(model=DEFAULT_LAW)["displacement_limit"]
    points: list[Mark] = []
    if len(scenes) == 1:
        (scene,) = scenes
        models = {name: text for name, text in _OF_MOMENTS.items() if not _lacking(scene, name)}
        lines = [(f"{symbol(name)}: {text}", scene, name) for name, text in models.items()]
        shift = float(scene["yield_displacement"])
        if shift <= limit:
            points = [Mark(f"⟦ξ⟧ = {amount('yield_displacement', shift)}", shift, scene["yield_moment"])]
    else:
        lines = [(scene.law.title, scene, "yield_moment") for scene in scenes]
    shifts = numpy.linspace(0, limit, POINTS)
    first = 3 if len(scenes) == 1 else 0  # a colour that no branch of the force curve beside it has
    curves = [
        Curve(text, shifts[1:], values_of(scene.replace(yield_displacement=shifts[1:]), [name])[name], number)
        for number, (text, scene, name) in enumerate(lines, first)
    ]
    x = Axis("yield_displacement", 0.0, limit, is_log=False)
    y = axis_around("yield_moment", [shifts[:1], *(curve.y for curve in curves)], margin=0.0)
    title = f"moment up to ⟦ξ_max⟧ = {amount('yield_displacement', limit, Format(digits=3))}"
    return Panel(x, y, tuple(curves), tuple(points), title + _of_law(scenes))


def _of_law(scenes: Sequence[Scene]) -> str:
    """Return the end of the title of a panel of one law that was chosen."""
    return f", {scenes[0].law.title}" if len(scenes) == 1 and scenes[0].stated_model is not None else ""


def _lacking(scene: Scene, *names: str) -> NotInLaw | None:
    """Return the error about quantities that the law of a scene does not have; None if it has them."""
    try:
        scene.plans(*names)
    except NotInLaw as error:
        return error
    return None


# The panels of a contact, each with the quantities that a law must have, and those that one law shows, too.
_Panel = tuple[Callable[[Sequence[Scene], Loads | None], Panel], tuple[str, ...], tuple[str, ...]]
PANELS: Mapping[str, _Panel] = {
    "force": (_force, (*_FORCE, "pull_off_force"), ()),
    "pressure": (_pressure, AREA_AND_PRESSURES, ()),
    "moment": (_moment, ("yield_moment",), (*_OF_MOMENTS, "displacement_limit")),
}


def curves_of_contact(
    scenes: Sequence[Scene], loads: Loads | None, panel: str | None
) -> tuple[Picture, tuple[str, ...]]:
    """Return the panels of a contact that all its laws have, or one of them, and notes.

    First on laws that lack a panel; then what is in doubt, unless several laws can be compared.
    """
    is_one = len(scenes) == 1
    asked = [PANELS[panel]] if panel is not None else [*PANELS.values()]
    missing = [error for _, needed, _ in asked for scene in scenes if (error := _lacking(scene, *needed))]
    drawn = [each for each in asked if not any(_lacking(scene, *each[1]) for scene in scenes)]
    if not drawn:
        raise missing[0]
    panels = tuple(draw(scenes, loads) for draw, _, _ in drawn)
    names = [name for _, needed, further in drawn for name in (*needed, *(further if is_one else ()))]
    varied = ("load",) if is_one else ("load", "yield_displacement")
    fixed: dict[str, None] = {}
    notes = dict.fromkeys(f"no curve: {error}" for error in missing)
    if is_one:
        about = _OF_MOMENT if panel == "moment" else OF_CURVE
        notes |= dict.fromkeys(note.text for note in Answer(about, scenes[0]).doubts())
    for scene in scenes:
        of_law = [name for name in names if not _lacking(scene, name)]
        unloaded = scene.replace(load=0.0)
        inputs = [name for name in unloaded.inputs_of(*of_law) if name not in varied]
        fixed |= dict.fromkeys(inputs_as_texts(unloaded, inputs))
        notes |= dict.fromkeys(notes_on(scene, unloaded, inputs, of_law))
    return Picture("", panels, fixed_inputs([*fixed])), tuple(notes)


def across(first: float, last: float) -> Any:
    """Return positions between two ends, closer to each other near the ends, where the pressure is steep."""
    shares = (1 - numpy.cos(numpy.linspace(0, numpy.pi, POINTS)[1:-1])) / 2
    return first + (last - first) * shares


def pressure_panel(curves: Sequence[Curve], highest: float, title: str) -> Panel:
    """Return a panel of pressures, which diverge at a rim: its axis ends at 2.5 times the highest one of Hertz."""
    x = axis_around("position_across", [curve.x for curve in curves])
    return Panel(x, Axis("pressure_across", -2.5 * highest, 1.5 * highest, is_log=False), tuple(curves), (), title)
