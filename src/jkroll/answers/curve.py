"""The force curve of a contact as rows: both branches, and the named states on them."""

from collections.abc import Iterator

from ..scene.scene import Scene
from .answer import Answer, Result, answer
from .questions import Question

CURVE = Question(
    ("approach_at_load", "load"),
    ("approach_at_load", "load", "contact_radius_at_load", "stiffness"),
)
FOLD, PULL_OFF, JUMP_IN, EQUILIBRIUM = 1 / 6, 1 / 2, 2 / 3, 1.0
_NAMED = {FOLD: "fold", PULL_OFF: "pull-off", JUMP_IN: "jump-in", EQUILIBRIUM: "equilibrium"}
_STEPS = 40  # of √â/√â_fold, from 0 to 2: up to P = (16/9)P_c


def states() -> list[tuple[float, str]]:
    """Return the states of the curve as x = â^(3/2), from the end of the unstable branch on, each with its name."""
    roots = [2 * step / _STEPS for step in range(1, _STEPS + 1)]
    factors = {root**3 / 6: "" for root in roots if root != 1.0} | _NAMED
    return [(factor, factors[factor] or _branch(factor)) for factor in sorted(factors)]


def _branch(factor: float) -> str:
    if factor < FOLD:
        return "unstable"
    return "fixed grips" if factor < PULL_OFF else "stable"


def curve(scenes: Iterator[Scene]) -> Iterator[tuple[Scene, Answer]]:
    """Iterate over the states of each scene."""
    for scene in scenes:
        for factor, state in states():
            at_state = Scene({**scene.stated, "load_factor": factor}, scene.material, scene.material2)
            row = answer(CURVE, at_state)
            if state == "fold":
                row = row._replace(results=tuple(map(_at_fold, row.results)))
            yield at_state, row._replace(inputs={**row.inputs, "state": state}, validity=())


def _at_fold(result: Result) -> Result:
    """Return a result at the fold, where the stiffness is infinite."""
    return result._replace(value=None, reason="infinite at the fold") if result.name == "stiffness" else result
