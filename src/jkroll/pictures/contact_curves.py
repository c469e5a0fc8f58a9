"""The curves of a contact, by one law or several: force, pressure and moment."""

from collections.abc import Callable, Iterator, Mapping, Sequence
from itertools import groupby
from math import inf
from typing import Any, NamedTuple

import numpy

from ..model.frame import Frame
from ..model.reasons import BEYOND_PULL_OFF, Failure, NotInLaw
from ..model.solver import values_of
from ..physics.contact import pressure
from ..quantities.formatting import Format, amount
from ..quantities.laws import DEFAULT_LAW, EQUILIBRIUM, FIXED_GRIPS, PULL_OFF, STABLE, UNSTABLE, WITHOUT_CONTACT
from ..quantities.markup import symbol
from ..report.curve import MAX_LOAD, NAMED, WHOLE_CURVE, Loads, states
from ..report.questions import Question
from ..report.report import Report
from .maps import fixed_inputs, inputs_as_texts, notes_on
from .picture import Axis, Curve, Mark, Panel, Picture, axis_around, clipped

POINTS = 401  # of a curve
RADIUS_AND_PRESSURES = ("contact_radius_at_load", "hertz_pressure", "boussinesq_pressure")
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
    if loads is not None:
        y = Axis("load", *loads, is_log=False)
    title = "force, Eqs (5) and (6)" if is_one and frames[0].law.is_default else f"force{_of_law(frames)}"
    return Panel(x, y, tuple(curves), tuple(points), title)


def _branches(frame: Frame, most: float) -> Iterator[tuple[str, Any, Any]]:
    """Iterate over the named states of a force curve up to a load, then over its branches, the stable one first.

    Each has a name, an approach and a load, or arrays of them. A branch begins at the last state of the previous one.
    """
    path = states(frame, Loads(-inf, most), POINTS)
    groups = []
    for given, group in groupby(path, key=lambda state: state.set_by):
        at_states = numpy.array([state.value for state in group])
        groups.append(values_of(frame.replace(**{given: at_states}), _FORCE))
    x, y = (numpy.concatenate([group[name] for group in groups]) for name in _FORCE)
    starts: dict[str, int] = {}
    for position, state in enumerate(path):
        if state.name in NAMED:
            yield state.name, float(x[position]), float(y[position])
        else:
            starts.setdefault(state.name, max(position - 1, 0))
    _, *next_starts = starts.values()
    ends = [*next_starts, len(path) - 1]
    for (name, start), end in reversed([*zip(starts.items(), ends, strict=True)]):
        yield name, x[start : end + 1], y[start : end + 1]


def _pressure(frames: Sequence[Frame], _: Loads | None) -> Panel:
    """Return the panel of the pressure across the contact, without load and at pull-off. Only JKR has pressures."""
    (frame,) = frames
    curves = []
    for text, name, branch in ((_NO_LOAD, EQUILIBRIUM, STABLE), (PULL_OFF, PULL_OFF, FIXED_GRIPS)):
        state = values_of(frame.replace(load_factor=NAMED[name]), RADIUS_AND_PRESSURES)
        x = across(-state["contact_radius_at_load"], state["contact_radius_at_load"])
        curves.append(Curve(text, x, pressure(distance=abs(x), **state), _BRANCHES.index(branch)))
    at_pull_off = state["hertz_pressure"]
    return pressure_panel(curves, at_pull_off, f"pressure, Eq (12){_of_law(frames)}")


def _moment(frames: Sequence[Frame], _: Loads | None) -> Panel:
    """Return the panel of the moment without load against displacement.

    The displacements end where, by JKR, the bodies begin to interpenetrate at the leading edge of the contact.
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
    further: tuple[str, ...] = ()  # also used for a single law, if it has them

    def missing(self, frames: Sequence[Frame]) -> list[NotInLaw]:
        """Return the errors for frames whose laws lack a quantity of the panel."""
        errors = (_lacking(frame, *self.needed) for frame in frames)
        return [error for error in errors if error is not None]


PANELS: Mapping[str, ContactPanel] = {
    "force": ContactPanel(_force, (*_FORCE, "pull_off_force")),
    "pressure": ContactPanel(_pressure, RADIUS_AND_PRESSURES),
    "moment": ContactPanel(_moment, ("yield_moment",), (*_OF_MOMENTS, "displacement_limit")),
}


def curves_of_contact(
    frames: Sequence[Frame], loads: Loads | None, panel: str | None
) -> tuple[Picture, tuple[str, ...]]:
    """Return a picture with one panel, or with all panels that the laws of the frames have, and its notes.

    `frames`: one contact by each law. The notes give the assumptions and the sources of data, and name the laws that
    lack a panel. For one law, they also give best ranges and doubts.
    """
    is_one = len(frames) == 1
    asked = [PANELS[panel]] if panel is not None else [*PANELS.values()]
    missing: list[NotInLaw] = []
    drawn: list[ContactPanel] = []
    names: list[str] = []
    for contact_panel in asked:
        errors = contact_panel.missing(frames)
        missing += errors
        if not errors:
            drawn.append(contact_panel)
            names += [*contact_panel.needed, *contact_panel.further] if is_one else contact_panel.needed
    if not drawn:
        raise missing[0]
    panels = tuple(contact_panel.draw(frames, loads) for contact_panel in drawn)
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


def pressure_panel(curves: Sequence[Curve], central: float, title: str) -> Panel:
    """Return a panel of pressures, which diverge at the rim, from −2.5 to 1.5 times a central Hertz pressure."""
    x = axis_around("position_across", [curve.x for curve in curves])
    return Panel(x, Axis("pressure_across", -2.5 * central, 1.5 * central, is_log=False), tuple(curves), (), title)
