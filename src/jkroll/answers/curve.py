"""The force curve of a contact as rows: both branches, and the named states on them."""

from collections.abc import Iterable, Iterator
from typing import NamedTuple

from ..errors import NoResult
from ..scene.errors import MissingInput
from ..scene.scene import Scene
from .answer import Answer, answer
from .questions import Question
from .result import Result

CURVE = Question(
    ("approach_at_load", "load"),
    ("approach_at_load", "load", "contact_radius_at_load", "stiffness"),
)
FOLD, PULL_OFF, JUMP_IN, EQUILIBRIUM = 1 / 6, 1 / 2, 2 / 3, 1.0
_NAMED = {FOLD: "fold", PULL_OFF: "pull-off", JUMP_IN: "jump-in", EQUILIBRIUM: "equilibrium"}
_STEPS = 40  # of √â/√â_fold, from 0 to 2: up to P = (16/9)P_c
_APART = 10  # steps without contact
MOST = 16 / 9  # largest load, over the pull-off force of the law


class State(NamedTuple):
    """A state of the curve: the input that sets it, its value, and what the state is called."""

    given: str
    value: float
    name: str


def states(scene: Scene) -> list[State]:
    """Return the states of the force curve of a scene under its law, by rising approach or load as that has them."""
    try:
        return _STATES[scene.law.name](scene)
    except (MissingInput, NoResult):
        return [State("load", 0.0, _NAMED[EQUILIBRIUM])]  # whose answer says what is missing


def _of_jkr(_: Scene) -> list[State]:
    """Return states by x = â^(3/2), from the end of the unstable branch on."""
    roots = [2 * step / _STEPS for step in range(1, _STEPS + 1)]
    factors = {root**3 / 6: "" for root in roots if root != 1.0} | _NAMED
    return [
        State("load_factor", factor, factors[factor] or _branch(factor, FOLD, PULL_OFF)) for factor in sorted(factors)
    ]


def _branch(value: float, fold: float, pull_off: float) -> str:
    """Return the name of the branch on which a state lies, given the values of its input at the fold and at pull-off."""
    if value < fold:
        return "unstable"
    return "fixed grips" if value < pull_off else "stable"


def _of_maugis(scene: Scene) -> list[State]:
    """Return states by approach where the spheres attract without contact, and by the edge ratio where they touch."""
    fold, pull_off, equilibrium = (
        scene[name] for name in ("edge_ratio_at_fold", "edge_ratio_at_pull_off", "edge_ratio_at_load")
    )
    most = scene.replace(load=MOST * scene["pull_off_force"])["edge_ratio_at_load"]
    named = {pull_off: "pull-off", equilibrium: "equilibrium"} | ({fold: "fold"} if fold > 0 else {})
    ratios = {most * (step / _STEPS) ** 2: "" for step in range(1, _STEPS + 1)} | named
    touching = [State("edge_ratio", ratio, ratios[ratio] or _branch(ratio, fold, pull_off)) for ratio in sorted(ratios)]
    if fold > 0:
        return touching
    least = scene["fold_approach_maugis"]
    touch = scene.replace(edge_ratio=touching[0].value)["approach_at_load"]
    apart = [State("approach_at_load", least, "fold")]
    apart += [
        State("approach_at_load", least + (touch - least) * step / _APART, "without contact")
        for step in range(1, _APART)
    ]
    return [*apart, *touching]


def _of_dmt(scene: Scene) -> list[State]:
    """Return states by approach, from where the spheres touch on."""
    equilibrium = scene["approach"]
    most = scene.replace(load=MOST * scene["pull_off_force"])["approach_at_load"]
    approaches = {most * step / _STEPS: "stable" for step in range(1, _STEPS + 1)}
    approaches |= {0.0: "pull-off", equilibrium: "equilibrium"}
    return [State("approach_at_load", approach, approaches[approach]) for approach in sorted(approaches)]


_STATES = {"jkr": _of_jkr, "maugis": _of_maugis, "dmt": _of_dmt}


def curve(scenes: Iterable[Scene]) -> Iterator[tuple[Scene, Answer]]:
    """Iterate over the states of each scene, under its own law."""
    for scene in scenes:
        for state in states(scene):
            at_state = scene.replace(**{state.given: state.value})
            row = answer(CURVE, at_state)
            if state.name == "fold":
                row = row._replace(results=tuple(map(_at_fold, row.results)))
            yield at_state, row._replace(inputs={**row.inputs, "state": state.name}, validity=(), laws=())


def _at_fold(result: Result) -> Result:
    """Return a result at the fold, where the stiffness is infinite."""
    return result._replace(value=None, reason="infinite at the fold") if result.name == "stiffness" else result
