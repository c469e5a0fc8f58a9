"""Pictures with fixed content: the curves of a contact, and the figures of the paper.

Of the paper's figures, the maps and Figs. 2 and 9 (the shifted contact) show computed values; the others are sketches.
Two figures are not in the paper: the pull-off force by each law, and a sketch of the symbols.
"""

from collections.abc import Callable, Iterator, Mapping, Sequence
from itertools import groupby
from math import inf, pi
from typing import Any, NamedTuple

import numpy

from ..errors import BadRequest
from ..materials.library import Materials
from ..model.frame import Frame
from ..model.reasons import BEYOND_PULL_OFF, Failure, NotInLaw
from ..model.solver import values_of
from ..physics.any_law import pull_off_force_lennard_jones, transition_parameter
from ..physics.contact import pressure
from ..physics.cylinder import asymmetric_pressure, contact_point_moment, half_strips_moment
from ..physics.maugis import edge_ratio_at_pull_off, pull_off_force_maugis
from ..physics.shifted import exact_pressure, half_circle_pressure, unloaded_half_width
from ..quantities.formatting import Format, amount
from ..quantities.laws import DEFAULT_LAW, EQUILIBRIUM, FIXED_GRIPS, PULL_OFF, STABLE, UNSTABLE, WITHOUT_CONTACT
from ..quantities.markup import symbol
from ..quantities.nomenclature import DEFAULTS, NOMENCLATURE, bracketed
from ..report.curve import MAX_LOAD, NAMED, WHOLE_CURVE, Loads, states
from ..report.questions import Question
from ..report.report import Report
from ..text import quoted
from .geometry import sketch
from .picture import Axis, Curve, Mark, Panel, Picture, axis_around, clipped
from .request import DRAWN_LIMITS, PlotRequest, fixed_inputs, inputs_as_texts, mark_at, notes_on, picture_of

# --- The curves of a contact: force, pressure and moment, by one law or several --------------------------------------

POINTS = 401
AREA_AND_PRESSURES = ("contact_radius_at_load", "hertz_pressure", "boussinesq_pressure")
_FORCE = ("approach_at_load", "load")
# The names of the models of the moment without load, short enough for a legend below a panel.
_OF_MOMENTS = {
    "yield_moment": "exact",
    "half_circles_moment": "two half-circles",
    "fixed_approach_moment": "exact, at a fixed approach",
}
_NO_LOAD = "⟦P = 0⟧"
_BRANCHES = (STABLE, FIXED_GRIPS, UNSTABLE, WITHOUT_CONTACT)  # of force curves, each with its own colour


def _force(frames: Sequence[Frame], loads: Loads | None) -> Panel:
    """Return the panel of force against approach; if loads are given, they are the ends of the force axis.

    With one law, each branch has its own colour; with several laws, each law has one.
    """
    most = max(0.0, loads.high) if loads else MAX_LOAD * max(frame["pull_off_force"] for frame in frames)
    is_one = len(frames) == 1
    curves: list[Curve] = []
    points: list[Mark] = []
    for number, frame in enumerate(frames):
        for name, x, y in _branches(frame, most):
            if name not in NAMED and is_one:
                curves.append(Curve(name, x, y, _BRANCHES.index(name)))
            elif name not in NAMED:
                curves.append(Curve(frame.law.title, x, y, number))
            elif is_one:
                points.append(Mark(_NO_LOAD if name == EQUILIBRIUM else name, x, y))
    if loads is not None:
        least = min(float(curve.y.min()) for curve in curves)
        inside = [clipped(curve, *loads) for curve in curves]
        curves = [curve for curve in inside if curve.y.size > 1]
        points = [point for point in points if point.y is not None and loads.low <= point.y <= loads.high]
        if not curves:
            raise Failure(BEYOND_PULL_OFF, numbers=(loads.high, least))
    x = axis_around("approach_at_load", [curve.x for curve in curves])
    y = axis_around("load", [curve.y for curve in curves], margin=0.15)
    ends = Axis("load", *loads, is_log=False) if loads is not None else y
    title = "force, Eqs (5) and (6)" if is_one and frames[0].law.is_default else f"force{_of_law(frames)}"
    return Panel(x, ends, tuple(curves), tuple(points), title)


def _branches(frame: Frame, most: float) -> Iterator[tuple[str, Any, Any]]:
    """Iterate over the branches and named states of a force curve up to a load, as name, approaches and loads.

    A branch begins at the last state of the previous branch.
    """
    path = states(frame, Loads(-inf, most), POINTS)
    groups = []
    for given, group in groupby(path, key=lambda state: state.given):
        at_states = numpy.array([state.value for state in group])
        groups.append(values_of(frame.replace(**{given: at_states}), _FORCE))
    x, y = (numpy.concatenate([group[name] for group in groups]) for name in _FORCE)
    starts: dict[str, int] = {}
    for position, state in enumerate(path):
        if state.name in NAMED:
            yield state.name, float(x[position]), float(y[position])
        else:
            starts.setdefault(state.name, max(position - 1, 0))
    ends = [*[*starts.values()][1:], len(path) - 1]
    for (name, start), end in reversed([*zip(starts.items(), ends, strict=True)]):
        yield name, x[start : end + 1], y[start : end + 1]


def _pressure(frames: Sequence[Frame], _: Loads | None) -> Panel:
    """Return the panel of pressure across the contact, without load and at pull-off. Only JKR gives it."""
    (frame,) = frames
    curves = []
    for text, name, branch in ((_NO_LOAD, EQUILIBRIUM, STABLE), (PULL_OFF, PULL_OFF, FIXED_GRIPS)):
        state = values_of(frame.replace(load_factor=NAMED[name]), AREA_AND_PRESSURES)
        x = across(-state["contact_radius_at_load"], state["contact_radius_at_load"])
        curves.append(Curve(text, x, pressure(distance=abs(x), **state), _BRANCHES.index(branch)))
    return pressure_panel(curves, state["hertz_pressure"], f"pressure, Eq (12){_of_law(frames)}")


def _moment(frames: Sequence[Frame], _: Loads | None) -> Panel:
    """Return the panel of the moment without load against displacement.

    By JKR, the bodies would interpenetrate at the leading edge of the contact beyond its end.
    """
    limit = frames[0].replace(model=DEFAULT_LAW)["displacement_limit"]
    points: list[Mark] = []
    if len(frames) == 1:
        (frame,) = frames
        models = {name: text for name, text in _OF_MOMENTS.items() if not _lacking(frame, name)}
        lines = [(f"{symbol(name)}: {text}", frame, name) for name, text in models.items()]
        shift = float(frame["yield_displacement"])
        if shift <= limit:
            points = [Mark(f"⟦ξ⟧ = {amount('yield_displacement', shift)}", shift, frame["yield_moment"])]
    else:
        lines = [(frame.law.title, frame, "yield_moment") for frame in frames]
    shifts = numpy.linspace(0, limit, POINTS)
    first = 3 if len(frames) == 1 else 0  # a colour that no branch of JKR has in the force panel
    curves = []
    for number, (text, frame, name) in enumerate(lines, first):
        moments = values_of(frame.replace(yield_displacement=shifts[1:]), [name])[name]
        curves.append(Curve(text, shifts[1:], moments, number))
    x = Axis("yield_displacement", 0.0, limit, is_log=False)
    y = axis_around("yield_moment", [shifts[:1], *(curve.y for curve in curves)], margin=0.0)
    title = f"moment up to ⟦ξ_max⟧ = {amount('yield_displacement', limit, Format(digits=3))}"
    return Panel(x, y, tuple(curves), tuple(points), title + _of_law(frames))


def _of_law(frames: Sequence[Frame]) -> str:
    """Return the suffix of a panel's title that names the law; empty unless a single law was chosen."""
    return f", {frames[0].law.title}" if len(frames) == 1 and frames[0].stated_model is not None else ""


def _lacking(frame: Frame, *names: str) -> NotInLaw | None:
    """Return the error about quantities that the frame's law lacks; None if it has them all."""
    try:
        frame.plans(*names)
    except NotInLaw as error:
        return error
    return None


class ContactPanel(NamedTuple):
    """A panel of a contact: the function that draws it, and the quantities in it."""

    draw: Callable[[Sequence[Frame], Loads | None], Panel]
    needed: tuple[str, ...]  # each law must have them
    further: tuple[str, ...] = ()  # also drawn for a single law, if it has them

    def missing(self, frames: Sequence[Frame]) -> list[NotInLaw]:
        """Return the errors for frames whose laws lack a quantity of the panel."""
        errors = (_lacking(frame, *self.needed) for frame in frames)
        return [error for error in errors if error is not None]


PANELS: Mapping[str, ContactPanel] = {
    "force": ContactPanel(_force, (*_FORCE, "pull_off_force")),
    "pressure": ContactPanel(_pressure, AREA_AND_PRESSURES),
    "moment": ContactPanel(_moment, ("yield_moment",), (*_OF_MOMENTS, "displacement_limit")),
}


def curves_of_contact(
    frames: Sequence[Frame], loads: Loads | None, panel: str | None
) -> tuple[Picture, tuple[str, ...]]:
    """Return a picture with one panel, or with all panels that the laws of the frames have, and its notes.

    The notes give the assumptions and the sources of data, and name the laws that lack a panel. For one law, they also
    give best ranges and doubts.
    """
    is_one = len(frames) == 1
    asked = [PANELS[panel]] if panel is not None else [*PANELS.values()]
    missing: list[NotInLaw] = []
    drawn: list[ContactPanel] = []
    names: list[str] = []
    for each in asked:
        errors = each.missing(frames)
        missing += errors
        if not errors:
            drawn.append(each)
            names += [*each.needed, *each.further] if is_one else each.needed
    if not drawn:
        raise missing[0]
    panels = tuple(each.draw(frames, loads) for each in drawn)
    varied = ("load",) if is_one else ("load", "yield_displacement")
    fixed: dict[str, None] = {}
    notes = dict.fromkeys(f"no curve: {error}" for error in missing)
    if is_one:
        about = Question(("yield_moment",), ("yield_moment",)) if panel == "moment" else WHOLE_CURVE
        answer = Report(about, frames[0])
        notes |= dict.fromkeys(note.text for note in (*answer.notes_on_ranges(), *answer.doubts()))
    for frame in frames:
        held = [name for name in names if not _lacking(frame, name)]
        unloaded = frame.replace(load=0.0)
        inputs = [name for name in unloaded.inputs_of(*held) if name not in varied]
        fixed |= dict.fromkeys(inputs_as_texts(unloaded, inputs))
        notes |= dict.fromkeys(notes_on(frame, unloaded, inputs, held))
    return Picture("", panels, fixed_inputs([*fixed])), tuple(notes)


def across(first: float, last: float) -> Any:
    """Return positions between two ends, denser near the ends, where the pressure is steep."""
    shares = (1 - numpy.cos(numpy.linspace(0, numpy.pi, POINTS)[1:-1])) / 2
    return first + (last - first) * shares


def pressure_panel(curves: Sequence[Curve], highest: float, title: str) -> Panel:
    """Return a panel of pressures, which diverge at the rim, from −2.5 to 1.5 times the highest Hertz pressure."""
    x = axis_around("position_across", [curve.x for curve in curves])
    return Panel(x, Axis("pressure_across", -2.5 * highest, 1.5 * highest, is_log=False), tuple(curves), (), title)


# --- Maps: Figs. 3, 6 and 8 -------------------------------------------------------------------------------------------

RADII = Axis("radius", 5e-10, 1e-3)
_ENERGIES = Axis("surface_energy", 1e-3, 1e1)
# E1* = E1/(1 - ν1²) is 10 GPa in Fig. 6a; in the other maps it affects only the limits of the model.
_SOFT = {"youngs_modulus": 1e10, "poisson_ratio": 0.0}
_LIGHT = {**_SOFT, "density": 2000.0}


class PaperMap(NamedTuple):
    """A map of the paper over R1: its quantity, the remark below it, its other axis, and its fixed inputs."""

    quantity: str
    remark: str
    x: Axis = _ENERGIES
    given: Mapping[str, float] = _SOFT
    printed: str = ""  # the quantity as the paper prints it, if that differs


PAPER_MAPS: Mapping[str, PaperMap] = {
    "3a": PaperMap(
        "pull_off_force",
        "JKR gives ⟦P_c = 3πγR⟧ with ⟦R = R1/2⟧; for small, hard spheres the force tends to ⟦4πγR⟧.",
    ),
    "3b": PaperMap(
        "yield_force_ratio",
        "The ratio does not depend on ⟦γ⟧. The forces are equal (contour 1) at ⟦R1 = 4ξ⟧ = 0.8 nm; the paper has 1 nm. "
        "As the paper warns, elasticity no longer holds there.",
    ),
    "3c": PaperMap(
        "r_min",
        "The radius ⟦r_min = R1²/ξ⟧ does not depend on ⟦γ⟧. At ⟦R1⟧ = 100 nm it is 50 µm, 500 times as large.",
    ),
    "3d": PaperMap(
        "n_grav",
        "At ⟦γ⟧ = 25 mJ/m², a level chain of about a thousand spheres of 100 nm holds. A single sphere (contour 1) "
        "rolls down if it is larger than 8 µm (polystyrene) to 52 µm (iron); the paper has about 100 µm.",
        given=_LIGHT,
    ),
    "6a": PaperMap(
        "vertical_frequency",
        "The frequency is 1 GHz at ⟦R1⟧ = 35 nm (⟦γ⟧ = 1 mJ/m²) to 130 nm (10 J/m²): it hardly depends on ⟦γ⟧, "
        "which enters with the power 1/6.",
        given=_LIGHT,
    ),
    "6b": PaperMap(
        "rolling_frequency",
        "The contours are Eq (40); the paper's curves are Eq (41), 2.5 times lower. At ⟦R1⟧ = 100 nm and ⟦γ⟧ = 100 "
        "mJ/m², rolling is 5.3 times slower than the normal vibration; the paper has one to two orders of magnitude.",
        given=_LIGHT,
        printed="rolling_frequency_as_printed",
    ),
    "8": PaperMap(
        "n_roll",
        "The energy is ⟦W0 = P_cδ0⟧; for another, multiply n_roll by ⟦W0/P_cδ0⟧. An energy balance gives 7/2 "
        "of Eq (49). Spheres below 10 nm do not roll if ⟦E*/γ⟧ is above 9·10¹¹ m⁻¹; spheres below 100 nm roll a full "
        "turn only if it is below 1.5·10⁹ m⁻¹.",
        x=Axis("modulus_over_energy", 1e9, 1e13, needs={"surface_energy": 1.0}),  # only E*/γ affects the result
        given={},
    ),
}


def paper_map(
    name: str, materials: Materials, marks: Sequence[str] = (), *, as_printed: bool = False, is_plain: bool = False
) -> Picture:
    """Return a map of the paper with marked grains. `is_plain`: True to leave out the limits of the model."""
    declared = PAPER_MAPS[name]
    frames, printed = (("", Frame(declared.given)),), declared.printed if as_printed else ""
    limits = () if is_plain else DRAWN_LIMITS
    drawn, _ = picture_of(
        PlotRequest(declared.quantity, declared.x, RADII, frames, marks, materials, limits, printed, has_best=False)
    )
    field = drawn.panels[0].field
    unit = field.in_words([])[1] if field is not None else ""
    title, remarks = f"Fig. {name}: {symbol(declared.quantity)}{bracketed(unit)}", (*drawn.remarks, declared.remark)
    caption = [*drawn.caption]
    if printed:
        caption.append(f"Dashed in files: Eq ({NOMENCLATURE[printed].equation}), each below its contour.")
    return Picture(title, drawn.panels, tuple(caption), drawn.doubts, remarks)


# --- Figs. 2 and 9: the shifted contact in three and two dimensions ---------------------------------------------------

SPHERES = {"radius": 2e-8}  # in Figs. 2 and 9; small enough that ξ is visible


def figure_2(materials: Materials) -> Picture:
    """Return Fig. 2: the shifted contact from above with its half-circles, and its exact and simplified pressure."""
    frame = Frame(SPHERES, materials["quartz"])
    moduli = ("contact_modulus", "reduced_radius")
    state = values_of(frame, (*AREA_AND_PRESSURES, *moduli, "approach_at_load", "yield_moment", "half_circles_moment"))
    pair = {name: state[name] for name in moduli}
    circle = {name: state[name] for name in AREA_AND_PRESSURES}
    a, shift = state["contact_radius_at_load"], float(frame["yield_displacement"])
    angle = numpy.linspace(-numpy.pi, numpy.pi, POINTS)
    half = angle / 2 + numpy.pi
    outlines = (
        Curve("contact, shifted by ⟦ξ⟧", a * numpy.cos(angle) - shift, a * numpy.sin(angle), 0),
        Curve("half-circle ⟦a + ξ⟧", (a + shift) * numpy.cos(half), (a + shift) * numpy.sin(half), 1),
        Curve("half-circle ⟦a − ξ⟧", -(a - shift) * numpy.cos(half), (a - shift) * numpy.sin(half), 2),
    )
    reach = 1.5 * (a + shift)
    x, y = (Axis(name, -reach, reach, is_log=False) for name in ("position_across", "position_beside"))
    point = Mark("contact point", 0.0, 0.0)
    view = Panel(x, y, outlines, (point,), "from above, rolling to the right", is_true_to_scale=True)

    def half_circle(position: Any, radius: float) -> Any:
        given = {"distance": abs(position), "approach_at_load": state["approach_at_load"]}
        return half_circle_pressure(half_circle_radius=radius, **given, **pair)

    centred, shifted = across(-a, a), across(-a - shift, a - shift)
    exact = exact_pressure(position_in_circle=shifted + shift, yield_displacement=shift, **circle, **pair)
    curves = [
        Curve("exact", shifted, exact),
        *_halves("half-circle", a, shift, half_circle),
        Curve("not shifted", centred, pressure(distance=abs(centred), **circle), 3),
    ]
    along = pressure_panel(curves, state["hertz_pressure"], "pressure along the rolling direction")
    moments = [amount(name, state[name]) for name in ("yield_moment", "half_circles_moment")]
    caption = (
        f"Two quartz spheres of 20 nm that have rolled by ⟦ξ⟧ = {amount('yield_displacement', shift)}, without load.",
        f"Moment: exact {moments[0]}, Eq (25); half-circles {moments[1]}, Eq (19).",
    )
    remarks = (
        "The circle lags behind the contact point. The pull at its rim is weaker ahead and stronger behind.",
        "Exact: Hertz, flat punch and tilted flat punch on one circle at a fixed load.",
        "Half-circles: Eq (16) at a fixed approach, not continuous at ⟦x = 0⟧.",
    )
    return Picture("Fig. 2: the shifted contact", (view, along), caption, remarks=remarks)


def _halves(word: str, a: float, shift: float, pressure_of: Callable[[Any, float], Any]) -> Iterator[Curve]:
    """Iterate over the pressures behind and ahead of the contact point, each from half of a symmetric contact.

    `pressure_of` returns the pressure at positions, given the size of the symmetric contact.
    """
    for sign, size, x in (("+", a + shift, across(-a - shift, 0.0)), ("−", a - shift, across(0.0, a - shift))):
        yield Curve(f"{word} ⟦a {sign} ξ⟧", x, pressure_of(x, size), 1 if sign == "+" else 2)


def figure_9(materials: Materials) -> Picture:
    """Return Fig. 9: the pressure of a cylinder on a rigid plane, symmetric and shifted, exact and simplified."""
    quartz = materials["quartz"].properties
    modulus = quartz["youngs_modulus"] / (1 - quartz["poisson_ratio"] ** 2)
    radius, shift = SPHERES["radius"], float(Frame(SPHERES).values["yield_displacement"])
    size = {"cylinder_radius": radius, "plane_strain_modulus": modulus}
    a = float(unloaded_half_width(work_of_adhesion=2 * quartz["surface_energy"], **size))
    size["load_constant"] = 0.0

    def strip(position: Any, width: float, shift: float = 0.0) -> Any:
        given = {"position_in_strip": position, "contact_half_width": width, "yield_displacement": shift}
        return asymmetric_pressure(**given, **size)

    centred, shifted = across(-a, a), across(-a - shift, a - shift)
    symmetric = Curve("exact, Eq (56)", centred, strip(centred, a))
    exact = Curve("exact, Eq (64)", shifted, strip(shifted + shift, a, shift))
    curves = [exact, *_halves("half-strip", a, shift, strip)]
    shifted_strip = {"contact_half_width": a, "yield_displacement": shift, **size}
    moments = contact_point_moment(**shifted_strip), half_strips_moment(**shifted_strip)
    shifted_by = amount("yield_displacement", shift)
    ratio = f"{moments[0] / moments[1]:.3f}"
    caption = (
        f"Quartz cylinder of 20 nm on a rigid plane without load (⟦C = 0⟧), shifted by ⟦ξ⟧ = {shifted_by}.",
        "Exact: Eq (64). Half-strips: two halves of symmetric strips, Eq (71).",
    )
    remarks = (
        f"Griffith's criterion gives ⟦a⟧ = {amount('contact_radius', a)}.",
        "The half-strips are not continuous at ⟦x = 0⟧.",
        f"Moment per length about the contact point: exact {moments[0]:.3g} N, Eq (70) with its sign corrected.",
        f"Half-strips {moments[1]:.3g} N, Eq (77): lower by a factor of {ratio}, which tends to ⟦π/2⟧ for ⟦ξ⟧ ≪ ⟦a⟧.",
    )
    highest = modulus * a / (2 * radius)
    panels = (pressure_panel([symmetric], highest, "symmetric"), pressure_panel(curves, highest, "shifted by ⟦ξ⟧"))
    return Picture("Fig. 9: the line contact", panels, caption, remarks=remarks)


# --- The pull-off force by each law -----------------------------------------------------------------------------------

_TABOR = Axis("tabor_parameter", 1e-2, 1e2, size=POINTS)
_RATIO = Axis("pull_off_force_ratio", 1.45, 2.05, is_log=False)
_LENNARD_JONES = Axis("tabor_parameter", 0.01, 2.0, size=POINTS)  # range of the fit
_UNIT = {"work_of_adhesion": 1 / pi, "reduced_radius": 1.0}  # forces are then relative to πwR


def figure_laws(materials: Materials, marks: Sequence[str]) -> Picture:
    """Return the figure of the pull-off force over πwR against Tabor's μ, by four laws, with marked grains."""
    tabor, near = _TABOR.values(), _LENNARD_JONES.values()
    transition = {"transition_parameter": transition_parameter(tabor_parameter=tabor)}
    ratio = edge_ratio_at_pull_off(**transition)
    maugis = pull_off_force_maugis(edge_ratio_at_pull_off=ratio, **transition, **_UNIT)
    ends = numpy.array([_TABOR.low, _TABOR.high])
    curves = (
        Curve("Maugis–Dugdale", tabor, maugis, 0),
        Curve("Lennard-Jones", near, pull_off_force_lennard_jones(tabor_parameter=near, **_UNIT), 1),
        Curve("DMT", ends, numpy.array([2.0, 2.0]), 2),
        Curve("JKR", ends, numpy.array([1.5, 1.5]), 3),
    )
    points = tuple(mark_at(text, materials, Frame({}, model="maugis"), _TABOR, _RATIO) for text in marks)
    fit = "the Lennard-Jones curve is a fit to numerical solutions, within 0.3 % for ⟦0.01 ≤ μ ≤ 2⟧"
    caption = [f"Pull-off force over ⟦πwR⟧ by each law; {fit}."]
    if points:
        spacing = amount("atomic_spacing", DEFAULTS["atomic_spacing"])
        caption.append(f"Grains are on the Maugis–Dugdale curve for ⟦z0⟧ = {spacing}; ⟦μ⟧ falls as ⟦1/z0⟧.")
    return Picture("", (Panel(_TABOR, _RATIO, curves, points),), tuple(caption))


# --- The names of all figures -----------------------------------------------------------------------------------------

PROFILES: Mapping[str, Callable[[Materials], Picture]] = {"2": figure_2, "9": figure_9}  # take no marks
FIGURE_NAMES = (*sorted({*PAPER_MAPS, *PROFILES}), "laws", "geometry")


def check_figure(name: str, given: Mapping[str, object]) -> None:
    """Raise BadRequest for a name that no figure has, or an argument that does not apply to the figure.

    `given`: arguments by name, as in `jkroll.figure`, or by option; those that are false were not given.
    """
    if name not in FIGURE_NAMES:
        mistake = f"{quoted(name)} is not a figure" if name else "figure needs a name"
        raise BadRequest(f"{mistake}; choose one of {', '.join(FIGURE_NAMES)}")
    idle = set[str]()
    if name in PROFILES or name == "geometry":
        idle |= {"--mark", "marks"}
    if name == "geometry":
        idle.add("--data")
    if name not in PAPER_MAPS:
        idle.add("--plain")
    if name not in PAPER_MAPS or not PAPER_MAPS[name].printed:
        idle |= {"--as-printed", "as_printed"}
    for argument, value in given.items():
        if value and argument in idle:
            raise BadRequest(f"figure {name} takes no {argument}")


def figure_named(
    name: str, materials: Materials, marks: Sequence[str] = (), *, as_printed: bool = False, is_plain: bool = False
) -> Picture:
    """Return a figure by its name, with marked grains; `is_plain`: see `paper_map`."""
    if name in PAPER_MAPS:
        return paper_map(name, materials, marks, as_printed=as_printed, is_plain=is_plain)
    if name in PROFILES:
        return PROFILES[name](materials)
    return sketch() if name == "geometry" else figure_laws(materials, marks)
