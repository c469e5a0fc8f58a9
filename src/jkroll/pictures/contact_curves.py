"""Curves of one contact: force, pressure and moment, in JKR or by several laws of attraction."""

from collections.abc import Callable, Iterable, Mapping, Sequence
from itertools import groupby
from math import inf
from typing import Any

from ..answers.curve import EQUILIBRIUM, FOLD, JUMP_IN, MAX_LOAD, PULL_OFF, Loads, states
from ..answers.notes import MOMENTS
from ..physics.pressure import pressure
from ..quantities.formatting import amount
from ..quantities.laws import DEFAULT_LAW
from ..quantities.nomenclature import NOMENCLATURE
from ..scene.errors import NotInLaw
from ..scene.scene import Scene
from .axes import Axis
from .maps import Mark, solved
from .panels import Curve, Panel, Picture, axis_around, clipped
from .plot_request import fixed_inputs, inputs_as_texts, notes_on

POINTS = 401
STATE = ("contact_radius_at_load", "hertz_pressure", "boussinesq_pressure")
_FORCE = ("approach_at_load", "load")


def _force(scene: Scene, loads: Loads | None) -> Panel:
    """Return force against approach on both branches, with the states at which the contact changes."""
    import numpy

    largest = solved(scene, ("load_factor",), {"load": loads.high})["load_factor"] if loads else 1.35
    parts = (("unstable", 1e-7, FOLD), ("fixed grips", FOLD, PULL_OFF), ("stable", PULL_OFF, largest))
    curves = []
    for number, (text, first, last) in enumerate(parts):
        factors = numpy.geomspace(first, last, POINTS)
        state = solved(scene, _FORCE, {"load_factor": factors})
        curves.append(Curve(text, state["approach_at_load"], state["load"], number))
    named = {"fold": FOLD, "pull-off": PULL_OFF, "jump-in": JUMP_IN, "P = 0": EQUILIBRIUM}
    points = []
    for text, factor in named.items():
        state = solved(scene, _FORCE, {"load_factor": factor})
        points.append(Mark(text, state["approach_at_load"], state["load"]))
    return _force_panel(tuple(reversed(curves)), points, loads, "force, Eqs (5) and (6)")


def _force_panel(curves: Sequence[Curve], points: Sequence[Mark], loads: Loads | None, title: str) -> Panel:
    """Return a panel of force curves, with the loads that were given as the ends of its axis."""
    if loads is None:
        x = axis_around("approach_at_load", [curve.x for curve in curves], is_log=False)
        y = axis_around("load", [curve.y for curve in curves], is_log=False, margin=0.08)
        return Panel(x, y, tuple(curves), tuple(points), title)
    parts = [curve._replace(y=clipped(curve.y, *loads)) for curve in curves]
    x = axis_around("approach_at_load", [curve.x[curve.y == curve.y] for curve in parts], is_log=False)
    inside = tuple(point for point in points if point.y is not None and loads.low <= point.y <= loads.high)
    return Panel(x, Axis("load", *loads, is_log=False), tuple(parts), inside, title)


def _force_of_laws(scenes: Sequence[Scene], loads: Loads | None) -> Panel:
    """Return force against approach under each law, on all branches, up to the same load."""
    import numpy

    ends = loads or Loads(-inf, MAX_LOAD * max(scene["pull_off_force"] for scene in scenes))
    curves = []
    for number, scene in enumerate(scenes):
        x, y = [], []
        for given, group in groupby(states(scene, ends, POINTS), key=lambda state: state.given):
            values = numpy.array([state.value for state in group])
            found = solved(scene, _FORCE, {given: values})
            x.append(found["approach_at_load"])
            y.append(found["load"])
        curves.append(Curve(scene.law.title, numpy.concatenate(x), numpy.concatenate(y), number))
    return _force_panel(curves, (), loads, _titled("force", curves))


def _titled(text: str, curves: Sequence[Curve]) -> str:
    """Return the title of a panel with a curve for each law; that of a single one has no legend."""
    return f"{text}, {curves[0].text}" if len(curves) == 1 else text


def _pressure_of_laws(scenes: Sequence[Scene], _: Loads | None) -> Panel:
    """Return the pressure across the contact under each law, without load."""
    curves, highest = [], 0.0
    for number, scene in enumerate(scenes):
        state = solved(scene, STATE, {})
        x = across(-state["contact_radius_at_load"], state["contact_radius_at_load"])
        curves.append(Curve(scene.law.title, x, pressure(distance=abs(x), **state), number))
        highest = max(highest, state["hertz_pressure"])
    return pressure_panel(curves, highest, _titled("pressure without load", curves))


def _moment_of_laws(scenes: Sequence[Scene], _: Loads | None) -> Panel:
    """Return the moment against ξ under each law, up to the ξ at which JKR's leading edge would interpenetrate."""
    import numpy

    limit = scenes[0].under(DEFAULT_LAW)["displacement_limit"]
    shifts = numpy.linspace(0, limit, POINTS)
    curves = [
        Curve(
            scene.law.title,
            shifts[1:],
            solved(scene, ("yield_moment",), {"yield_displacement": shifts[1:]})["yield_moment"],
            number,
        )
        for number, scene in enumerate(scenes)
    ]
    y = axis_around("yield_moment", [shifts[:1], *(curve.y for curve in curves)], is_log=False, margin=0.0)
    return Panel(
        Axis("yield_displacement", 0.0, limit, is_log=False),
        y,
        tuple(curves),
        (),
        _titled("moment without load", curves),
    )


def _pressure(scene: Scene, _: Loads | None) -> Panel:
    """Return the pressure across the contact without load and at pull-off."""
    curves = []
    for number, (text, factor) in enumerate((("P = 0", EQUILIBRIUM), ("pull-off", PULL_OFF))):
        state = solved(scene, STATE, {"load_factor": factor})
        x = across(-state["contact_radius_at_load"], state["contact_radius_at_load"])
        curves.append(Curve(text, x, pressure(distance=abs(x), **state), number))
    return pressure_panel(curves, state["hertz_pressure"], "pressure, Eq (12)")


def _moment(scene: Scene, _: Loads | None) -> Panel:
    """Return the moment against ξ by every model, up to the ξ at which the leading edge would interpenetrate."""
    import numpy

    limit = scene["displacement_limit"]
    shifts = numpy.linspace(0, limit, POINTS)[1:]
    found = solved(scene, MOMENTS, {"yield_displacement": shifts})
    curves = [
        Curve(f"{NOMENCLATURE[name].symbol}: {NOMENCLATURE[name].sentence}", shifts, found[name], number)
        for number, name in enumerate(MOMENTS)
    ]
    ends = [numpy.array([0.0]), *(curve.y for curve in curves)]
    at = scene["yield_moment"]
    shift = float(scene.values["yield_displacement"])
    point = (Mark(f"ξ = {amount('yield_displacement', shift)}", shift, at),) if shift <= limit else ()
    return Panel(
        Axis("yield_displacement", 0.0, limit, is_log=False), axis_around("yield_moment", ends, is_log=False, margin=0.0),
        tuple(curves), point, "moment, up to ξ_max",
    )  # fmt: skip


_PanelOfJkr = Callable[[Scene, Loads | None], Panel]
_PanelOfLaws = Callable[[Sequence[Scene], Loads | None], Panel]
# The panels of a contact, each with the quantities that it shows.
PANELS: Mapping[str, tuple[_PanelOfJkr, tuple[str, ...]]] = {
    "force": (_force, _FORCE),
    "pressure": (_pressure, STATE),
    "moment": (_moment, (*MOMENTS, "displacement_limit")),
}
_OF_LAWS: Mapping[str, tuple[_PanelOfLaws, tuple[str, ...]]] = {
    "force": (_force_of_laws, _FORCE),
    "pressure": (_pressure_of_laws, STATE),
    "moment": (_moment_of_laws, ("yield_moment",)),
}


def curves_of_contact(scene: Scene, loads: Loads | None, panel: str | None) -> tuple[Picture, tuple[str, ...]]:
    """Return force against approach, pressure, and moment against ξ of one contact, or one of these panels; and notes."""
    chosen = [PANELS[panel]] if panel is not None else PANELS.values()
    held, notes = _fixed(((scene, quantities) for _, quantities in chosen), ("load",))
    shown = () if panel is not None else ("Both branches of the force curve; pressure; moment without load.",)
    return Picture("", tuple(draw(scene, loads) for draw, _ in chosen), (*shown, *held)), notes


def curves_of_laws(scenes: Sequence[Scene], loads: Loads | None, panel: str | None) -> tuple[Picture, tuple[str, ...]]:
    """Return the panels of a contact with a curve for each law, and notes, first on the laws that lack one of them."""
    panels: list[Panel] = []
    missing: list[NotInLaw] = []
    drawn: list[tuple[Scene, tuple[str, ...]]] = []
    for draw, quantities in [_OF_LAWS[panel]] if panel is not None else _OF_LAWS.values():
        having = []
        for scene in scenes:
            try:
                scene.plan(*quantities)
                having.append(scene)
            except NotInLaw as error:
                missing.append(error)
        if having:
            panels.append(draw(having, loads))
            drawn += [(scene, quantities) for scene in having]
    if not panels:
        raise missing[0]
    held, notes = _fixed(drawn, ("load", "yield_displacement"))
    return Picture("", tuple(panels), held), (*(f"no curve: {error}" for error in missing), *notes)


def _fixed(
    drawn: Iterable[tuple[Scene, tuple[str, ...]]], varied: Sequence[str]
) -> tuple[tuple[str, ...], tuple[str, ...]]:
    """Return the sentence on the inputs that drawn quantities have in common, without those that vary, and notes on them."""
    texts: dict[str, None] = {}
    notes: dict[str, None] = {}
    for scene, quantities in drawn:
        unloaded = scene.replace(load=0.0)
        inputs = [name for name in unloaded.inputs_of(*quantities) if name not in varied]
        texts |= dict.fromkeys(inputs_as_texts(unloaded, inputs))
        notes |= dict.fromkeys(notes_on(unloaded, inputs, quantities))
    return fixed_inputs([*texts]), tuple(notes)


def across(first: float, last: float) -> Any:
    """Return positions between two ends, closer to each other near the ends, where the pressure is steep."""
    import numpy

    parts = (1 - numpy.cos(numpy.linspace(0, numpy.pi, POINTS)[1:-1])) / 2
    return first + (last - first) * parts


def pressure_panel(curves: list[Curve], highest: float, title: str) -> Panel:
    """Return a panel of pressures, cut where they diverge at a rim."""
    cut = tuple(curve._replace(y=clipped(curve.y, -2.5 * highest, 1.5 * highest)) for curve in curves)
    x = axis_around("position_across", [curve.x for curve in curves], is_log=False)
    return Panel(x, Axis("pressure_across", -2.5 * highest, 1.5 * highest, is_log=False), cut, (), title)
