"""Curves of one contact: force, pressure and moment; and Figs. 2 and 9, the shifted contact in three and two dimensions."""

from collections.abc import Callable, Mapping, Sequence
from itertools import groupby
from math import inf
from typing import Any

from ..answers.curve import EQUILIBRIUM, FOLD, JUMP_IN, MAX_LOAD, PULL_OFF, Loads, states
from ..answers.notes import MOMENTS
from ..materials.library import Materials
from ..physics.cylinder import asymmetric_pressure, contact_point_moment, half_strips_moment, symmetric_pressure
from ..physics.pressure import pressure
from ..physics.shifted import exact_pressure, half_circle_pressure, unloaded_half_width
from ..quantities.formatting import amount
from ..quantities.laws import DEFAULT_LAW
from ..quantities.nomenclature import NOMENCLATURE
from ..scene.errors import NotInLaw
from ..scene.scene import Scene
from .axes import Axis
from .maps import Mark, solved
from .panels import Curve, Panel, Picture, axis_around, clipped

POINTS = 401
SIZE = {"radius": 2e-8}  # of the spheres of Fig. 2, small enough that ξ is visible
_STATE = ("contact_radius_at_load", "hertz_pressure", "boussinesq_pressure")


def _force(scene: Scene, loads: Loads | None) -> Panel:
    """Return force against approach on both branches, with the states at which the contact changes."""
    import numpy

    largest = solved(scene, ("load_factor",), {"load": loads.high})["load_factor"] if loads else 1.35
    parts = (("unstable", 1e-7, FOLD), ("fixed grips", FOLD, PULL_OFF), ("stable", PULL_OFF, largest))
    curves = []
    for number, (text, first, last) in enumerate(parts):
        factors = numpy.geomspace(first, last, POINTS)
        state = solved(scene, ("approach_at_load", "load"), {"load_factor": factors})
        curves.append(Curve(text, state["approach_at_load"], state["load"], number))
    named = {"fold": FOLD, "pull-off": PULL_OFF, "jump-in": JUMP_IN, "P = 0": EQUILIBRIUM}
    points = []
    for text, factor in named.items():
        state = solved(scene, ("approach_at_load", "load"), {"load_factor": factor})
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
            found = solved(scene, ("approach_at_load", "load"), {given: values})
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
        state = solved(scene, _STATE, {})
        x = _across(-state["contact_radius_at_load"], state["contact_radius_at_load"])
        curves.append(Curve(scene.law.title, x, pressure(distance=abs(x), **state), number))
        highest = max(highest, state["hertz_pressure"])
    return _pressure_panel(curves, highest, _titled("pressure without load", curves))


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
        state = solved(scene, _STATE, {"load_factor": factor})
        x = _across(-state["contact_radius_at_load"], state["contact_radius_at_load"])
        curves.append(Curve(text, x, pressure(distance=abs(x), **state), number))
    return _pressure_panel(curves, state["hertz_pressure"], "pressure, Eq (12)")


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


PANELS = {"force": _force, "pressure": _pressure, "moment": _moment}  # of a contact under JKR
_PanelOfLaws = Callable[[Sequence[Scene], Loads | None], Panel]
_OF_LAWS: Mapping[str, tuple[_PanelOfLaws, tuple[str, ...]]] = {  # with the quantities that a law must have for it
    "force": (_force_of_laws, ("approach_at_load", "load")),
    "pressure": (_pressure_of_laws, _STATE),
    "moment": (_moment_of_laws, ("yield_moment",)),
}


def curves_of_contact(scene: Scene, loads: Loads | None, caption: tuple[str, ...], panel: str | None) -> Picture:
    """Return force against approach, pressure, and moment against ξ of one contact; or one of these panels."""
    names = (panel,) if panel is not None else tuple(PANELS)
    return Picture("", tuple(PANELS[name](scene, loads) for name in names), caption)


def curves_of_laws(
    scenes: Sequence[Scene], loads: Loads | None, caption: tuple[str, ...], panel: str | None
) -> tuple[Picture, tuple[str, ...]]:
    """Return the panels of a contact with a curve for each law, and notes on the laws that lack one of them."""
    panels: list[Panel] = []
    missing: list[NotInLaw] = []
    for name in (panel,) if panel is not None else _OF_LAWS:
        draw, quantities = _OF_LAWS[name]
        having = []
        for scene in scenes:
            try:
                scene.plan(*quantities)
                having.append(scene)
            except NotInLaw as error:
                missing.append(error)
        if having:
            panels.append(draw(having, loads))
    if not panels:
        raise missing[0]
    return Picture("", tuple(panels), caption), tuple(f"no curve: {error}" for error in missing)


def figure_2(materials: Materials) -> Picture:
    """Return Fig. 2: the shifted contact from above with its half-circles, and its pressure, exact and simplified."""
    import numpy

    scene = Scene(SIZE, materials["quartz"])
    names = (*_STATE, "contact_modulus", "reduced_radius", "approach_at_load", "yield_moment", "half_circles_moment")
    state = solved(scene, names, {})
    shift = float(scene.values["yield_displacement"])
    a = state["contact_radius_at_load"]
    angle = numpy.linspace(-numpy.pi, numpy.pi, POINTS)
    outlines = [Curve("contact, shifted by ξ", a * numpy.cos(angle) - shift, a * numpy.sin(angle), 0)]
    half = numpy.linspace(numpy.pi / 2, 3 * numpy.pi / 2, POINTS)
    outlines += [
        Curve("half-circle a + ξ", (a + shift) * numpy.cos(half), (a + shift) * numpy.sin(half), 1, is_dashed=True),
        Curve("half-circle a − ξ", -(a - shift) * numpy.cos(half), (a - shift) * numpy.sin(half), 2, is_dashed=True),
    ]
    reach = 1.5 * (a + shift)
    view = Panel(
        Axis("position_across", -reach, reach, is_log=False), Axis("position_beside", -reach, reach, is_log=False),
        tuple(outlines), (Mark("contact point", 0.0, 0.0),), "from above, rolling to the right", is_true_to_scale=True,
    )  # fmt: skip
    given = {"contact_modulus": state["contact_modulus"], "reduced_radius": state["reduced_radius"]}
    parts = {name: state[name] for name in _STATE}
    centred, shifted = _across(-a, a), _across(-a - shift, a - shift)
    left, right = _across(-a - shift, 0.0), _across(0.0, a - shift)
    at = {"approach_at_load": state["approach_at_load"], **given}
    curves = [
        Curve("exact", shifted, exact_pressure(position_in_circle=shifted + shift, yield_displacement=shift, **parts, **given), 0),
        Curve("half-circle a + ξ", left, half_circle_pressure(distance=-left, half_circle_radius=a + shift, **at), 1, is_dashed=True),
        Curve("half-circle a − ξ", right, half_circle_pressure(distance=right, half_circle_radius=a - shift, **at), 2, is_dashed=True),
        Curve("not shifted", centred, pressure(distance=abs(centred), **parts), 3),
    ]  # fmt: skip
    along = _pressure_panel(curves, state["hertz_pressure"], "pressure along the way")
    exact, simple = (amount(name, state[name]) for name in ("yield_moment", "half_circles_moment"))
    caption = (
        "The contact of two quartz spheres of 20 nm that have rolled by ξ: the circle stays behind the contact point.",
        (
            "Exact: Hertz, flat punch and tilted flat punch on one circle at a fixed load. Half-circles: Eq (16) at a fixed approach, "
            "not continuous at x = 0. Ahead the pull at the rim is weaker, behind it is stronger."
        ),
        f"Moment: exact {exact}, Eq (25); half-circles {simple}, Eq (19).",
        f"Assumed: P = 0, ξ = {amount('yield_displacement', shift)}.",
    )
    return Picture("Fig. 2: the shifted contact", (view, along), caption)


def figure_9(materials: Materials) -> Picture:
    """Return Fig. 9: the pressure of a cylinder on a rigid plane, symmetric and shifted, exact and simplified."""
    quartz = materials["quartz"].properties
    modulus = quartz["youngs_modulus"] / (1 - quartz["poisson_ratio"] ** 2)
    radius = SIZE["radius"]
    size = {"cylinder_radius": radius, "plane_strain_modulus": modulus}
    a = unloaded_half_width(work_of_adhesion=2 * quartz["surface_energy"], **size)
    shift = float(Scene(SIZE).values["yield_displacement"])
    size["load_constant"] = 0.0
    centred, shifted = _across(-a, a), _across(-a - shift, a - shift)
    left, right = _across(-a - shift, 0.0), _across(0.0, a - shift)
    exact = asymmetric_pressure(
        position_in_strip=shifted + shift, contact_half_width=a, yield_displacement=shift, **size
    )
    behind = symmetric_pressure(position=left, contact_half_width=a + shift, **size)
    ahead = symmetric_pressure(position=right, contact_half_width=a - shift, **size)
    highest = modulus * a / (2 * radius)
    symmetric = Curve("exact, Eq (56)", centred, symmetric_pressure(position=centred, contact_half_width=a, **size))
    curves = [
        Curve("exact, Eq (64)", shifted, exact),
        Curve("half-strip a + ξ", left, behind, 1, is_dashed=True),
        Curve("half-strip a − ξ", right, ahead, 2, is_dashed=True),
    ]
    moments = [
        moment(contact_half_width=a, yield_displacement=shift, **size)
        for moment in (contact_point_moment, half_strips_moment)
    ]
    caption = (
        (
            "The line contact of a quartz cylinder of 20 nm on a rigid plane, without load (C = 0), where Griffith's criterion gives "
            f"a = {amount('contact_radius', a)}."
        ),
        "Shifted by ξ, exact by Eq (64); simplified by two halves of symmetric strips, Eq (71), not continuous at x = 0.",
        (
            f"Moment per length about the contact point: exact {moments[0]:.3g} N, Eq (70) with its sign corrected; "
            f"half-strips {moments[1]:.3g} N, Eq (77): lower by {moments[0] / moments[1]:.3f}, π/2 where ξ ≪ a."
        ),
        f"Assumed: ξ = {amount('yield_displacement', shift)}.",
    )
    panels = (_pressure_panel([symmetric], highest, "symmetric"), _pressure_panel(curves, highest, "shifted by ξ"))
    return Picture("Fig. 9: the line contact", panels, caption)


def _across(first: float, last: float) -> Any:
    """Return positions between two ends, closer to each other near the ends, where the pressure is steep."""
    import numpy

    parts = (1 - numpy.cos(numpy.linspace(0, numpy.pi, POINTS)[1:-1])) / 2
    return first + (last - first) * parts


def _pressure_panel(curves: list[Curve], highest: float, title: str) -> Panel:
    """Return a panel of pressures, cut where they diverge at a rim."""
    cut = tuple(curve._replace(y=clipped(curve.y, -2.5 * highest, 1.5 * highest)) for curve in curves)
    x = axis_around("position_across", [curve.x for curve in curves], is_log=False)
    return Panel(x, Axis("pressure_across", -2.5 * highest, 1.5 * highest, is_log=False), cut, (), title)


PROFILES = {"2": figure_2, "9": figure_9}  # figures of the paper
