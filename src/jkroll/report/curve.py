"""The force curve of a contact as rows: both branches and the named states."""

from collections.abc import Iterator, Sequence
from math import inf, isfinite
from typing import NamedTuple

from ..errors import BadRequest, NoResult
from ..model.estimate import BETTER_LAW
from ..model.frame import Frame
from ..model.plan import in_order
from ..model.reasons import NO_STIFFNESS, MissingInput
from ..model.rows import Wanted, sides_in
from ..quantities.laws import (
    DMT,
    EQUILIBRIUM,
    FIXED_GRIPS,
    FOLD,
    JKR,
    JUMP_IN,
    MAUGIS,
    PULL_OFF,
    STABLE,
    UNSTABLE,
    WITHOUT_CONTACT,
)
from ..quantities.nomenclature import STATE_OR_LOAD
from ..quantities.values import parse_quantity
from ..text import quoted
from .questions import Question
from .report import Report

# The question of each state, and that of the curve as a whole.
FORCE_CURVE = Question(
    ("approach_at_load", "load"),
    ("approach_at_load", "load", "contact_radius_at_load", "stiffness"),
)
_OF_WHOLE = ("pull_off_force", "contact_radius", "approach")
WHOLE_CURVE = Question(_OF_WHOLE, _OF_WHOLE)
NAMED = {FOLD: 1 / 6, PULL_OFF: 1 / 2, JUMP_IN: 2 / 3, EQUILIBRIUM: 1.0}  # the load factor of each named state of JKR
STEPS, FEW_STEPS = 40, 12  # along the stable branch, in a file and on a terminal
MAX_LOAD = 16 / 9  # largest load of a curve if no loads are given, over the pull-off force of the law


class State(NamedTuple):
    """A state of the curve: the input that sets it, the value of the input, and the name of the state."""

    set_by: str
    value: float
    name: str

    def in_frame(self, frame: Frame) -> Frame:
        """Return a frame at the state, without the rounding errors of an infinite stiffness and of a load of 0."""
        frame = frame.replace(**{self.set_by: self.value}, state=self.name)
        if self.name == FOLD:
            frame.drop("stiffness", NO_STIFFNESS)
        if self.name == EQUILIBRIUM:
            frame.values[frame.plan("load").name] = 0.0
        return frame


class Loads(NamedTuple):
    """The first and last load of a force curve."""

    low: float
    high: float


def loads_of(text: str) -> Loads:
    """Return the loads in a text `FROM:TO`.

    >>> loads_of("-5nN:20nN")
    Loads(low=-5e-09, high=2e-08)
    """
    first, colon, last = text.partition(":")
    if not colon or ":" in last:
        raise BadRequest("--curve goes through many loads; give --load as FROM:TO, such as -5nN:20nN")
    loads = Loads(parse_quantity(first, "load"), parse_quantity(last, "load"))
    if not loads.low < loads.high:
        raise BadRequest(f"--load: {quoted(text)} does not rise; write FROM:TO with FROM below TO")
    return loads


def states(frame: Frame, loads: Loads | None = None, steps: int = STEPS) -> list[State]:
    """Return the states of a frame's force curve, by rising value of the input that sets a state, see `Law.set_by`.

    The curve has `steps` steps along the stable branch, from pull-off to the load (16/9)P_c, and the named states. If
    the law has such states, it also has half as many between a vanishing contact and pull-off, and half as many without
    contact. With `loads`, the steps lie between them, and states outside them are left out. If the pull-off force is
    unknown, or if even the last load is beyond it, the curve has one state.
    """
    try:
        set_by = frame.law.set_by
        named, force = _named(frame), frame["pull_off_force"]
        low, high = loads or Loads(-inf, MAX_LOAD * force)
        first = frame.replace(load=low)[set_by] if low > -force else named[PULL_OFF]
        last = frame.replace(load=high)[set_by]
    except (MissingInput, NoResult):  # the answer says what is missing, or that the spheres let go
        if loads:
            return [State("load", loads.high, STABLE)]
        return [State("load", 0.0, EQUILIBRIUM)]
    half = steps // 2
    every = [State(set_by, first + (last - first) * step / steps, STABLE) for step in range(steps + 1)]
    if FOLD in named:
        for step in range(1, half):
            value = named[PULL_OFF] * (step / half) ** 3
            every.append(State(set_by, value, UNSTABLE if value < named[FOLD] else FIXED_GRIPS))
    for name, value in named.items():
        if value or name != FOLD:
            every.append(State(set_by, value, name))
    by_value = {float(f"{state.value:.12g}"): state for state in every}  # a named state replaces an unnamed one
    path = [by_value[value] for value in sorted(by_value)]
    if named.get(FOLD) == 0:
        path = [*_without_contact(frame, path[0].value, half), *path]
    if loads is None:
        return path
    slack = 1e-12 * max(abs(end) for end in loads if isfinite(end))  # the load computed for a state has rounding errors
    lowest, highest = low - slack, high + slack
    return [state for state in path if state.name == STABLE or lowest <= state.in_frame(frame)["load"] <= highest]


def _named(frame: Frame) -> dict[str, float]:
    """Return the value of the input that sets each named state; it is 0 for a fold without contact."""
    if frame.law.name == JKR:
        return {**NAMED}
    unloaded = frame.replace(load=0.0)[frame.law.set_by]
    if frame.law.name == DMT:
        return {PULL_OFF: 0.0, EQUILIBRIUM: unloaded}
    if frame.law.name == MAUGIS:
        ends = {FOLD: frame["edge_ratio_at_fold"], PULL_OFF: frame["edge_ratio_at_pull_off"]}
        return {**ends, EQUILIBRIUM: unloaded}
    return {PULL_OFF: -frame["pull_off_force"], EQUILIBRIUM: unloaded}


def _without_contact(frame: Frame, edge_ratio: float, steps: int) -> Iterator[State]:
    """Iterate over Maugis' states without contact, from the fold up to the contact with an edge ratio, excluded."""
    fold, touch = frame["fold_approach_maugis"], frame.replace(edge_ratio=edge_ratio)["approach_at_load"]
    for step in range(steps):
        yield State("approach_at_load", fold + (touch - fold) * step / steps, WITHOUT_CONTACT if step else FOLD)


def frames_of_curve(frame: Frame, loads: Loads | None = None, steps: int = STEPS) -> Iterator[Frame]:
    """Iterate over the frames at the states of the force curve."""
    return (state.in_frame(frame) for state in states(frame, loads, steps))


def lead_of_curve(report: Report) -> str:
    """Return the best ranges of a force curve, and whether Maugis' law gives a better curve."""
    text = f"best ranges: {report.best_ranges}"
    by_maugis = [name for name, estimate in report.estimates.items() if estimate.by == BETTER_LAW]
    if by_maugis == ["pull_off_force"]:
        return f"{text}; the curve is within about 5 % of Maugis' law, except near P_c"
    return f"{text}; take the curve by Maugis' law: --model maugis" if by_maugis else text


def answer_at_state(question: Question, frame: Frame) -> Report:
    """Return the answer at a state.

    The quantity that sets the state is an input, not a result, unless it is all that the question asks for.
    """
    sets_state = STATE_OR_LOAD & frame.stated.keys()
    names = tuple(name for name in question.quantities if name not in sets_state)
    if not names:
        names = question.quantities
    return Report(Question(question.headline, names, names), frame)


def curve_columns(frames: Sequence[Frame], names: Sequence[str], *, doubts: bool, keeps_all: bool) -> Wanted:
    """Return the columns of a force curve: inputs, names of states, then quantities.

    `doubts`: True to judge limits; `keeps_all`: True to keep numbers without a meaning.
    """
    inputs: set[str] = set()
    for frame in frames:
        inputs.update(frame.echo(frame.inputs_used(names)))
    sides = sides_in((frame, names) for frame in frames)
    shown = in_order(inputs.difference(names))
    return Wanted(names, named=names, inputs=shown, sides=sides, doubts=doubts, keeps_all=keeps_all)
