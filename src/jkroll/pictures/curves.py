"""Curves of one contact: force, pressure and moment, in JKR or by several laws of attraction.

Figs. 2 and 9 show the shifted contact; another figure, the pull-off force by each law against the parameter of the
transition.
"""

from collections.abc import Callable, Iterable, Mapping, Sequence
from itertools import groupby, pairwise
from math import inf, pi
from typing import Any

from ..answers.answer import Answer
from ..answers.curve import EQUILIBRIUM, MAX_LOAD, NAMED, OF_CURVE, PULL_OFF, Loads, states
from ..answers.notes import MOMENTS
from ..answers.questions import Question
from ..materials.library import Materials
from ..physics.any_law import pull_off_force_lennard_jones, transition_parameter
from ..physics.contact import pressure
from ..physics.cylinder import asymmetric_pressure, contact_point_moment, half_strips_moment, symmetric_pressure
from ..physics.maugis import pull_off_force_maugis
from ..physics.shifted import exact_pressure, half_circle_pressure, unloaded_half_width
from ..quantities.formatting import amount
from ..quantities.laws import DEFAULT_LAW
from ..quantities.nomenclature import NOMENCLATURE
from ..scene.failures import BeyondPullOff, NotInLaw
from ..scene.scene import DEFAULTS, Scene
from .axes import Axis
from .maps import Curve, Mark, Panel, Picture, axis_around, clipped, has_values, solved
from .request import fixed_inputs, inputs_as_texts, mark_at, notes_on

POINTS = 401
_SAME = 1e-9  # relative difference of curves that coincide
AREA_AND_PRESSURES = ("contact_radius_at_load", "hertz_pressure", "boussinesq_pressure")
_FORCE = ("approach_at_load", "load")
_OF_MOMENT = Question(("yield_moment",), ("yield_moment",))
_NO_LOAD = "P = 0"
_BRANCHES = ("stable", "fixed grips", "unstable", "without contact")  # of force curves, each with its own colour


def _force(scenes: Sequence[Scene], loads: Loads | None) -> Panel:
    """Return force against approach up to one load, with the loads that were given as the ends of its axis."""
    most = max(0.0, loads.high) if loads else MAX_LOAD * max(scene["pull_off_force"] for scene in scenes)
    paths = [_path(scene, most) for scene in scenes]
    points: list[Mark] = []
    if len(scenes) == 1:
        curves, points = _branches(*paths[0])
    else:
        curves = [
            Curve(scene.law.title, x, y, number)
            for number, (scene, (_, x, y)) in enumerate(zip(scenes, paths, strict=True))
        ]
    if loads is not None:
        least = min(float(curve.y.min()) for curve in curves)
        curves = [part for part in (clipped(curve, *loads) for curve in curves) if has_values(part.y)]
        points = [point for point in points if point.y is not None and loads.low <= point.y <= loads.high]
        if not curves:
            raise BeyondPullOff(loads.high, least)
    x = axis_around("approach_at_load", [curve.x for curve in curves], is_log=False)
    y = axis_around("load", [curve.y for curve in curves], is_log=False, margin=0.08)
    ends = Axis("load", *loads, is_log=False) if loads is not None else y
    return Panel(x, ends, tuple(curves), tuple(points), _titled("force, Eqs (5) and (6)", "force", scenes))


def _path(scene: Scene, most: float) -> tuple[list[str], Any, Any]:
    """Return the names of the states of a force curve up to a load, their approaches, and their loads."""
    import numpy

    found = states(scene, Loads(-inf, most), POINTS)
    parts = [
        solved(scene, _FORCE, {given: numpy.array([state.value for state in group])})
        for given, group in groupby(found, key=lambda state: state.given)
    ]
    approaches, forces = (numpy.concatenate([part[name] for part in parts]) for name in _FORCE)
    return [state.name for state in found], approaches, forces


def _branches(names: Sequence[str], x: Any, y: Any) -> tuple[list[Curve], list[Mark]]:
    """Return the branches of a force curve, the stable one first, and its named states."""
    named = [place for place, name in enumerate(names) if name in NAMED.values()]
    between = [place for place, name in enumerate(names) if name not in NAMED.values()]
    firsts = [(name, next(places)) for name, places in groupby(between, key=names.__getitem__)]
    ends = pairwise([0, *(first - 1 for _, first in firsts[1:]), len(names) - 1])
    curves = [
        Curve(name, x[start : end + 1], y[start : end + 1], _BRANCHES.index(name))
        for (name, _), (start, end) in zip(firsts, ends, strict=True)
    ]
    points = [
        Mark(_NO_LOAD if names[place] == NAMED[EQUILIBRIUM] else names[place], float(x[place]), float(y[place]))
        for place in named
    ]
    return curves[::-1], points


def _pressure(scenes: Sequence[Scene], _: Loads | None) -> Panel:
    """Return the pressure across the contact, which JKR alone has, without load and at pull-off."""
    (scene,) = scenes
    curves = []
    for text, factor, branch in ((_NO_LOAD, EQUILIBRIUM, "stable"), ("pull-off", PULL_OFF, "fixed grips")):
        state = solved(scene, AREA_AND_PRESSURES, {"load_factor": factor})
        x = across(-state["contact_radius_at_load"], state["contact_radius_at_load"])
        curves.append(Curve(text, x, pressure(distance=abs(x), **state), _BRANCHES.index(branch)))
    law = f", {scene.law.title}" if scene.stated_model is not None else ""
    return pressure_panel(curves, state["hertz_pressure"], f"pressure, Eq (12){law}")


def _moment(scenes: Sequence[Scene], _: Loads | None) -> Panel:
    """Return the moment without load against ξ, up to the ξ at which JKR's leading edge would interpenetrate."""
    import numpy

    limit = scenes[0].under(DEFAULT_LAW)["displacement_limit"]
    points: list[Mark] = []
    if len(scenes) == 1:
        (scene,) = scenes
        models = [name for name in MOMENTS if not _lacking(scene, name)]
        lines = [(f"{NOMENCLATURE[name].symbol}: {NOMENCLATURE[name].sentence}", scene, name) for name in models]
        shift = float(scene["yield_displacement"])
        if shift <= limit:
            points = [Mark(f"ξ = {amount('yield_displacement', shift)}", shift, scene["yield_moment"])]
    else:
        lines = [(scene.law.title, scene, "yield_moment") for scene in scenes]
    shifts = numpy.linspace(0, limit, POINTS)
    first = 3 if len(scenes) == 1 else 0  # a colour that no branch of the force curve beside it has
    found = once(
        Curve(text, shifts[1:], solved(scene, (name,), {"yield_displacement": shifts[1:]})[name])
        for text, scene, name in lines
    )
    curves = [curve._replace(colour=number) for number, curve in enumerate(found, first)]
    x = Axis("yield_displacement", 0.0, limit, is_log=False)
    y = axis_around("yield_moment", [shifts[:1], *(curve.y for curve in curves)], is_log=False, margin=0.0)
    return Panel(x, y, tuple(curves), tuple(points), _titled("moment, up to ξ_max", "moment without load", scenes))


def _titled(of_jkr: str, text: str, scenes: Sequence[Scene]) -> str:
    """Return the title of a panel: that of JKR alone, or another, with the law if there is one."""
    if len(scenes) > 1:
        return text
    law = scenes[0].law
    return of_jkr if law.is_default else f"{text}, {law.title}"


def _lacking(scene: Scene, *names: str) -> NotInLaw | None:
    """Return the error about quantities that the law of a scene does not have; None if it has them."""
    try:
        scene.plan(*names)
    except NotInLaw as error:
        return error
    return None


# The panels of a contact, each with the quantities that a law must have, and with those that are shown, too, if there is one law.
_Panel = tuple[Callable[[Sequence[Scene], Loads | None], Panel], tuple[str, ...], tuple[str, ...]]
PANELS: Mapping[str, _Panel] = {
    "force": (_force, _FORCE, ()),
    "pressure": (_pressure, AREA_AND_PRESSURES, ()),
    "moment": (_moment, ("yield_moment",), (*MOMENTS, "displacement_limit")),
}


def curves_of_contact(
    scenes: Sequence[Scene], loads: Loads | None, panel: str | None
) -> tuple[Picture, tuple[str, ...]]:
    """Return the panels of a contact under one law or several, or one of them, and notes.

    First on laws that lack a panel; then what is in doubt, unless several laws can be compared.
    """
    is_one = len(scenes) == 1
    varied = ("load",) if is_one else ("load", "yield_displacement")
    panels: list[Panel] = []
    missing: list[NotInLaw] = []
    held: dict[str, None] = {}
    notes: dict[str, None] = {}
    for draw, needed, further in [PANELS[panel]] if panel is not None else PANELS.values():
        errors = [_lacking(scene, *needed) for scene in scenes]
        having = [scene for scene, error in zip(scenes, errors, strict=True) if error is None]
        missing += filter(None, errors)
        if having:
            drawn = draw(having, loads)
            is_of_one_law = len(having) == 1 < len(scenes)
            panels.append(_in_colour(drawn, scenes.index(having[0])) if is_of_one_law else drawn)
        for scene in having:
            names = [*needed, *(name for name in further if is_one and not _lacking(scene, name))]
            unloaded = scene.replace(load=0.0)
            inputs = [name for name in unloaded.inputs_of(*names) if name not in varied]
            held |= dict.fromkeys(inputs_as_texts(unloaded, inputs))
            notes |= dict.fromkeys(notes_on(unloaded, inputs, names))
    if not panels:
        raise missing[0]
    is_whole = is_one and len(panels) == len(PANELS)
    shown = ("Both branches of the force curve; pressure; moment without load.",) if is_whole else ()
    caption = (*shown, *fixed_inputs([*held]))
    about = _OF_MOMENT if panel == "moment" else OF_CURVE
    doubtful = [note.worded for note in Answer(about, scenes[0]).doubts()] if is_one else []
    return Picture("", tuple(panels), caption), (*(f"no curve: {error}" for error in missing), *doubtful, *notes)


def _in_colour(panel: Panel, colour: int) -> Panel:
    """Return a panel with all curves in one colour; their dashes differ."""
    return panel._replace(curves=tuple(curve._replace(colour=colour) for curve in panel.curves))


def once(curves: Iterable[Curve]) -> list[Curve]:
    """Return curves, of those that coincide the first with the texts of all."""
    import numpy

    found: list[Curve] = []
    for curve in curves:
        for place, other in enumerate(found):
            if numpy.allclose(curve.y, other.y, rtol=_SAME, atol=0):
                found[place] = other._replace(text=f"{other.text}; {curve.text}")
                break
        else:
            found.append(curve)
    return found


def across(first: float, last: float) -> Any:
    """Return positions between two ends, closer to each other near the ends, where the pressure is steep."""
    import numpy

    parts = (1 - numpy.cos(numpy.linspace(0, numpy.pi, POINTS)[1:-1])) / 2
    return first + (last - first) * parts


def pressure_panel(curves: Sequence[Curve], highest: float, title: str) -> Panel:
    """Return a panel of pressures, which diverge at a rim: its axis ends at 2.5 times the highest one of Hertz."""
    x = axis_around("position_across", [curve.x for curve in curves], is_log=False)
    return Panel(x, Axis("pressure_across", -2.5 * highest, 1.5 * highest, is_log=False), tuple(curves), (), title)


# --- Figs. 2 and 9: the shifted contact in three and two dimensions ---------------------------------------------------

SIZE = {"radius": 2e-8}  # of the spheres of Fig. 2, small enough that ξ is visible


def figure_2(materials: Materials) -> Picture:
    """Return Fig. 2: the shifted contact from above with its half-circles, and its pressure, exact and simplified."""
    import numpy

    scene = Scene(SIZE, materials["quartz"])
    names = (
        *AREA_AND_PRESSURES,
        "contact_modulus",
        "reduced_radius",
        "approach_at_load",
        "yield_moment",
        "half_circles_moment",
    )
    state = solved(scene, names, {})
    shift = float(scene["yield_displacement"])
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
    parts = {name: state[name] for name in AREA_AND_PRESSURES}
    centred, shifted = across(-a, a), across(-a - shift, a - shift)
    left, right = across(-a - shift, 0.0), across(0.0, a - shift)
    at = {"approach_at_load": state["approach_at_load"], **given}
    curves = [
        Curve("exact", shifted, exact_pressure(position_in_circle=shifted + shift, yield_displacement=shift, **parts, **given), 0),
        Curve("half-circle a + ξ", left, half_circle_pressure(distance=-left, half_circle_radius=a + shift, **at), 1, is_dashed=True),
        Curve("half-circle a − ξ", right, half_circle_pressure(distance=right, half_circle_radius=a - shift, **at), 2, is_dashed=True),
        Curve("not shifted", centred, pressure(distance=abs(centred), **parts), 3),
    ]  # fmt: skip
    along = pressure_panel(curves, state["hertz_pressure"], "pressure along the way")
    exact, simple = (amount(name, state[name]) for name in ("yield_moment", "half_circles_moment"))
    caption = (
        f"Two quartz spheres of 20 nm that have rolled by ξ = {amount('yield_displacement', shift)}, without load.",
        f"Moment: exact {exact}, Eq (25); half-circles {simple}, Eq (19).",
    )
    remarks = (
        "The circle stays behind the contact point.",
        (
            "Exact: Hertz, flat punch and tilted flat punch on one circle at a fixed load. Half-circles: Eq (16) at a fixed approach, "
            "not continuous at x = 0. Ahead the pull at the rim is weaker, behind it is stronger."
        ),
    )
    return Picture("Fig. 2: the shifted contact", (view, along), caption, remarks)


def figure_9(materials: Materials) -> Picture:
    """Return Fig. 9: the pressure of a cylinder on a rigid plane, symmetric and shifted, exact and simplified."""
    quartz = materials["quartz"].properties
    modulus = quartz["youngs_modulus"] / (1 - quartz["poisson_ratio"] ** 2)
    radius = SIZE["radius"]
    size = {"cylinder_radius": radius, "plane_strain_modulus": modulus}
    a = unloaded_half_width(work_of_adhesion=2 * quartz["surface_energy"], **size)
    shift = float(Scene(SIZE).values["yield_displacement"])
    size["load_constant"] = 0.0
    centred, shifted = across(-a, a), across(-a - shift, a - shift)
    left, right = across(-a - shift, 0.0), across(0.0, a - shift)
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
            f"Quartz cylinder of 20 nm on a rigid plane without load (C = 0), shifted by ξ = {amount('yield_displacement', shift)}: "
            "exact, Eq (64), and two halves of symmetric strips, Eq (71)."
        ),
    )
    remarks = (
        f"Griffith's criterion gives a = {amount('contact_radius', a)}. The half-strips are not continuous at x = 0.",
        (
            f"Moment per length about the contact point: exact {moments[0]:.3g} N, Eq (70) with its sign corrected; "
            f"half-strips {moments[1]:.3g} N, Eq (77): lower by {moments[0] / moments[1]:.3f}, π/2 where ξ ≪ a."
        ),
    )
    panels = (pressure_panel([symmetric], highest, "symmetric"), pressure_panel(curves, highest, "shifted by ξ"))
    return Picture("Fig. 9: the line contact", panels, caption, remarks)


PROFILES = {"2": figure_2, "9": figure_9}  # figures of the paper


# --- The pull-off force by each law -----------------------------------------------------------------------------------

_TABOR = Axis("tabor_parameter", 1e-2, 1e2, size=POINTS)
_RATIO = Axis("pull_off_force_ratio", 1.45, 2.05, is_log=False)
_LENNARD_JONES = Axis("tabor_parameter", 0.01, 2.0, size=POINTS)  # the range of its fit
_UNIT = {"work_of_adhesion": 1 / pi, "reduced_radius": 1.0}  # in which forces are those over πwR


def figure_laws(materials: Materials, marks: Sequence[str]) -> Picture:
    """Return the pull-off force over πwR against μ by JKR, DMT, Maugis' law and that of Lennard-Jones, with grains as marks."""
    import numpy

    tabor, near = _TABOR.values(), _LENNARD_JONES.values()
    maugis = pull_off_force_maugis(transition_parameter=transition_parameter(tabor_parameter=tabor), **_UNIT)
    ends = numpy.array([_TABOR.low, _TABOR.high])
    curves = (
        Curve("Maugis–Dugdale", tabor, maugis, 0),
        Curve("Lennard-Jones", near, pull_off_force_lennard_jones(tabor_parameter=near, **_UNIT), 1),
        Curve("DMT", ends, numpy.array([2.0, 2.0]), 2),
        Curve("JKR", ends, numpy.array([1.5, 1.5]), 3),
    )
    points = tuple(mark_at(text, materials, Scene({}, model="maugis"), _TABOR, _RATIO) for text in marks)
    spacing = amount("atomic_spacing", DEFAULTS["atomic_spacing"])
    caption = (
        "Pull-off force over πwR by each law; Lennard-Jones' by a fit to numerical solutions, within 0.3 % for 0.01 ≤ μ ≤ 2.",
        *((f"Grains at Maugis–Dugdale with z0 = {spacing}: μ falls as 1/z0.",) if points else ()),
    )
    return Picture("", (Panel(_TABOR, _RATIO, curves, points),), caption)
