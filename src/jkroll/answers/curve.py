"""The force curve of a contact as rows: both branches, and the named states on them."""

from collections.abc import Iterable, Iterator, Mapping, Sequence
from functools import cached_property
from math import isfinite, nan
from typing import Any, NamedTuple

from ..errors import BadRequest, NoResult
from ..physics.elementary import cbrt
from ..quantities.values import parse_quantity
from ..rows.columns import Row, Wanted
from ..rows.sweep import entering
from ..scene.failures import Failure, MissingInput, without_value
from ..scene.limits import Doubt, bits_of, doubts
from ..scene.scene import Scene
from ..scene.wiring import in_order
from ..text import quoted
from .answer import Answer
from .questions import Question
from .results import Result

FORCE_CURVE = Question(
    ("approach_at_load", "load"),
    ("approach_at_load", "load", "contact_radius_at_load", "stiffness"),
)
OF_CURVE = Question(("pull_off_force",), ("pull_off_force",))
FOLD, PULL_OFF, JUMP_IN, EQUILIBRIUM = 1 / 6, 1 / 2, 2 / 3, 1.0
NAMED = {FOLD: "fold", PULL_OFF: "pull-off", JUMP_IN: "jump-in", EQUILIBRIUM: "equilibrium"}
STEPS = 40  # of √â/√â_fold in JKR
APART = 4  # states in contact for each without it
MAX_LOAD = 16 / 9  # over the pull-off force of the law, where no loads are given


class State(NamedTuple):
    """A state of the curve: the input that sets it, its value, and what the state is called."""

    given: str
    value: float
    name: str


class Loads(NamedTuple):
    """The loads from which and to which a force curve is wanted."""

    low: float
    high: float


def loads_of(text: str) -> Loads:
    """Return the loads of a text `FROM:TO`.

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


def states(scene: Scene, loads: Loads | None = None, steps: int = STEPS) -> list[State]:
    """Return the states of the force curve of a scene under its law, by rising approach or load as that has them.

    Without `loads` the curve ends at (16/9)P_c. `steps` is the number of states in contact, without those that have a
    name.
    """
    try:
        found = STATES_OF_LAW.get(scene.law.name, _of_loads)(scene, loads, steps)
    except (MissingInput, NoResult):  # the answer says what is missing, or that the spheres let go
        return [State("load", loads.high, "stable") if loads else State("load", 0.0, NAMED[EQUILIBRIUM])]
    if loads is None:
        return found
    slack = 1e-12 * max(abs(end) for end in loads if isfinite(end))  # the load of a state comes back but for rounding
    return [
        state
        for state in found
        if loads.low - slack <= scene.replace(**{state.given: state.value})["load"] <= loads.high + slack
    ]


def states_between(scene: Scene, loads: Loads) -> list[State]:
    """Return the states of a force curve between two loads, the stable ones from the first load to the last."""
    found = states(scene, loads)
    try:
        stable = _stable(scene, loads)
    except (MissingInput, NoResult):
        return found
    others = [state for state in found if state.name != "stable"]
    given = stable[0].given
    by_value = {float(f"{state.value:.12g}"): state for state in (*stable, *others) if state.given == given}
    apart = (state for state in others if state.given != given)
    return [*apart, *(by_value[value] for value in sorted(by_value))]


def _stable(scene: Scene, loads: Loads) -> list[State]:
    """Return the states of the stable branch at loads that are closer to each other near pull-off."""
    given, name = _OF_LOAD.get(scene.law.name, ("load", "load"))
    pull_off = -scene["pull_off_force"]
    least = max(loads.low, pull_off)
    steps = range(1 if least == pull_off else 0, STEPS + 1)  # pull-off has a state with a name
    held = (least + (loads.high - least) * (step / STEPS) ** 2 for step in steps)
    return [State(given, scene.replace(load=load)[name], "stable") for load in held]


def _largest(scene: Scene, loads: Loads | None) -> float:
    """Return the load at which a curve ends."""
    return loads.high if loads else MAX_LOAD * scene["pull_off_force"]


def _of_jkr(scene: Scene, loads: Loads | None, steps: int) -> list[State]:
    """Return states by x = â^(3/2), from the end of the unstable branch on."""
    last = float(cbrt(6 * scene.replace(load=loads.high)["load_factor"])) if loads else 2.0
    roots = [last * step / steps for step in range(1, steps + 1)]
    factors = {root**3 / 6: "" for root in roots} | NAMED
    return [
        State("load_factor", factor, factors[factor] or _branch(factor, FOLD, PULL_OFF)) for factor in sorted(factors)
    ]


def _branch(value: float, fold: float, pull_off: float) -> str:
    """Return the name of the branch of a state, given the values of its input at the fold and at pull-off."""
    if value < fold:
        return "unstable"
    return "fixed grips" if value < pull_off else "stable"


def _of_maugis(scene: Scene, loads: Loads | None, steps: int) -> list[State]:
    """Return states by approach where the spheres attract without contact, and by the edge ratio where they touch."""
    fold, pull_off, equilibrium = (
        scene[name] for name in ("edge_ratio_at_fold", "edge_ratio_at_pull_off", "edge_ratio_at_load")
    )
    most = scene.replace(load=_largest(scene, loads))["edge_ratio_at_load"]
    named = {pull_off: "pull-off", equilibrium: "equilibrium"} | ({fold: "fold"} if fold > 0 else {})
    ratios = {most * (step / steps) ** 2: "" for step in range(1, steps + 1)} | named
    touching = [State("edge_ratio", ratio, ratios[ratio] or _branch(ratio, fold, pull_off)) for ratio in sorted(ratios)]
    if fold > 0:
        return touching
    least = scene["fold_approach_maugis"]
    touch = scene.replace(edge_ratio=touching[0].value)["approach_at_load"]
    count = steps // APART
    apart = [State("approach_at_load", least, "fold")]
    apart += [
        State("approach_at_load", least + (touch - least) * step / count, "without contact") for step in range(1, count)
    ]
    return [*apart, *touching]


def _of_dmt(scene: Scene, loads: Loads | None, steps: int) -> list[State]:
    """Return states by approach, from where the spheres touch on."""
    equilibrium = scene["approach"]
    most = scene.replace(load=_largest(scene, loads))["approach_at_load"]
    approaches = {most * step / steps: "stable" for step in range(1, steps + 1)}
    approaches |= {0.0: "pull-off", equilibrium: "equilibrium"}
    return [State("approach_at_load", approach, approaches[approach]) for approach in sorted(approaches)]


def _of_loads(scene: Scene, loads: Loads | None, steps: int) -> list[State]:
    """Return states by load, from pull-off on: of a law that has one state for each load."""
    least, most = -scene["pull_off_force"], _largest(scene, loads)
    held = {least + (most - least) * step / steps: "stable" for step in range(1, steps + 1)}
    held |= {least: "pull-off", 0.0: "equilibrium"}
    return [State("load", load, held[load]) for load in sorted(held)]


STATES_OF_LAW = {"jkr": _of_jkr, "maugis": _of_maugis, "dmt": _of_dmt}
# The input that sets a state in contact, and the quantity that has its value at a load.
_OF_LOAD = {
    "jkr": ("load_factor", "load_factor"),
    "maugis": ("edge_ratio", "edge_ratio_at_load"),
    "dmt": ("approach_at_load", "approach_at_load"),
}


class WholeCurve(Answer):
    """The answer that stands for a whole force curve: its limits are those of the pull-off force."""

    def __init__(self, scene: Scene) -> None:
        super().__init__(OF_CURVE, scene)

    @cached_property
    def bits(self) -> int:
        """The doubts as bits."""
        return int(bits_of(doubts(self.scene, self.scene.possible(self.shown))))


class At(NamedTuple):
    """A state of a force curve, and the scene at it."""

    state: State
    scene: Scene
    curve: WholeCurve


def at_states(scenes: Iterable[Scene], loads: Loads | None = None) -> Iterator[At]:
    """Iterate over the states of each scene, under its own law."""
    for scene in scenes:
        curve = WholeCurve(scene)
        for state in states_between(scene, loads) if loads is not None else states(scene):
            yield At(state, scene.replace(**{state.given: state.value}), curve)


def _known(state: State) -> dict[str, float | Failure]:
    """Return results that are known exactly at a state, where a computed value would be rounding error."""
    if state.name == NAMED[FOLD]:
        return {"stiffness": without_value("stiffness", "infinite where fixed grips let go")}
    return {"approach_at_load": 0.0} if state.name == NAMED[JUMP_IN] else {}


class AtState(Answer):
    """The answer at a state of the force curve."""

    def __init__(self, at: At, question: Question = FORCE_CURVE) -> None:
        self.state, scene, self.curve = at
        super().__init__(question, scene)

    @cached_property
    def inputs(self) -> Mapping[str, float | str]:
        """The inputs as understood, with the one that sets the state, and the name of the state."""
        given, value, name = self.state
        return {**super().inputs, given: value, "state": name}

    @cached_property
    def results(self) -> tuple[Result, ...]:
        """The results, with those that are known exactly in place of rounding errors."""
        known = _known(self.state)
        return tuple(one if one.name not in known else _as_known(one, known[one.name]) for one in super().results)

    @cached_property
    def laws(self) -> Mapping[str, Mapping[str, Any]]:
        """The differences of Maugis' law from that of the curve."""
        return self.curve.laws

    @property
    def alternatives(self) -> Mapping[str, Mapping[str, Any]]:
        """None: a state of the curve has no place on that of another law."""
        return {}

    @cached_property
    def validity(self) -> tuple[Doubt, ...]:
        """The limits of the model for the whole curve."""
        return self.curve.validity

    def about(self, doubt: Doubt) -> str:
        """Return what follows from a limit for the whole curve."""
        return self.curve.about(doubt)


def _as_known(result: Result, value: float | Failure) -> Result:
    if isinstance(value, Failure):
        return result._replace(value=None, reason=value.reason(), propagated=None)
    return result._replace(value=value, propagated=None)


class OfCurve(Wanted):
    """The columns of force curves: the inputs, with those that set the states, the names of these, and the results."""

    @classmethod
    def of(cls, samples: Sequence[At], names: Sequence[str]) -> "OfCurve":
        """Return the columns of quantities at states."""
        inputs, sides = entering((one.scene for one in samples), lambda _: names, names)
        shown = in_order({*inputs, *(one.state.given for one in samples), "state"}.difference(names))
        return cls(names, named=names, inputs=shown, sides=sides)

    @cached_property
    def _of_state(self) -> Wanted:
        """The same columns without doubts, which are those of the whole curve."""
        return Wanted(self.names, named=self.named, inputs=self.inputs, sides=self.sides, doubts=False)

    def row(self, at: Any) -> Row:
        """Return the row of a state."""
        state, scene, curve = at
        found = self._of_state.row(scene)
        numbers, reasons = dict(zip(self.keys, found.numbers, strict=True)), {**found.reasons}
        for name, value in _known(state).items():
            if name not in self.names:
                continue
            for key in self.keys_of(name):
                numbers[key] = nan
                reasons.pop(key, None)
            if isinstance(value, Failure):
                reasons[name] = value
            else:
                numbers[name] = value
        inputs = {**found.inputs, state.given: state.value, "state": state.name}
        return Row(inputs, [numbers[key] for key in self.keys], curve.bits if self.doubts else 0, reasons)
