"""Which model of the rolling moment is good enough: the ladder of `physics.ladder`, with errors, for `--rtol`."""

from collections.abc import Mapping
from typing import NamedTuple

from .commands import OF_MOMENT, OF_SLOPE
from .errors import MissingInput, NoResult
from .scene import Scene


class Rung(NamedTuple):
    """A model of the rolling moment, its ratio to Eq (25), and its relative error against the exact moment."""

    name: str
    equation: str
    ratio: float
    error: float


class NotGoodEnough(NoResult):
    """No model of the ladder reaches the tolerance."""

    def __init__(self, rtol: float, reason: str) -> None:
        super().__init__(rtol, reason)
        self.rtol, self.reason = rtol, reason

    def __str__(self) -> str:
        return f"--rtol {self.rtol:g}: no model of rolling is that good here; {self.reason}"


_MODELS = {"unloaded_moment": "26", "yield_moment": "25", "half_circles_moment": "19", "fixed_approach_moment": "25"}


def exact_model(scene: Scene) -> str:
    """The model that is exact: at a fixed load Eq (25), at a fixed approach that and a term in ξ³."""
    return "fixed_approach_moment" if "approach_at_load" in scene.stated else "yield_moment"


def model_error(name: str, scene: Scene) -> float | None:
    """Relative error of a model of the moment against the exact one; None for what is no model, or cannot be compared."""
    if name not in _MODELS or name == exact_model(scene):
        return None
    try:
        moment, exact = float(scene[name]), float(scene[exact_model(scene)])
        return abs(moment - exact) / exact
    except (MissingInput, NoResult):
        return None


def ladder(scene: Scene, *, small: bool = False) -> list[Rung]:
    """The models that a scene allows, from the cheapest on; `small`: for amplitudes that tend to 0."""
    rungs = []
    exact = scene["yield_moment"] if small else scene[exact_model(scene)]
    for name, equation in _MODELS.items():
        if small and name not in ("unloaded_moment", "yield_moment"):
            continue
        try:
            moment = scene[name]
        except MissingInput:
            continue
        rungs.append(Rung(name, equation, moment / scene["yield_moment"], abs(moment - exact) / exact))
    return rungs


def cheapest(scene: Scene, rtol: float, *, small: bool = False) -> Rung:
    """The cheapest model within a relative tolerance; NotGoodEnough where there is none."""
    try:
        ratio = scene["displacement_ratio"]
    except MissingInput:
        ratio = 0.0
    if ratio >= 1 and not small:
        raise NotGoodEnough(rtol, f"ξ is {ratio:.3g} of the displacement up to which the shifted contact is possible")
    rungs = ladder(scene, small=small)
    good = next((rung for rung in rungs if rung.error <= rtol), None)
    if good is None:
        raise NotGoodEnough(rtol, f"the best is off by {min(rung.error for rung in rungs):.3g}")
    return good


def within(values: Mapping[str, float], scene: Scene, rtol: float) -> tuple[dict[str, float], list[str]]:
    """The values of quantities that follow from the moment, by the cheapest model within a tolerance, and what it is."""
    changed: dict[str, float] = {}
    notes: list[str] = []
    for names, power, small in ((OF_MOMENT, 1.0, False), (OF_SLOPE, 0.5, True)):
        affected = [name for name in names if name in values]
        if affected:
            rung = cheapest(scene, rtol / power, small=small)
            changed |= {name: values[name] * rung.ratio**power for name in affected}
            error = f"{rung.error * power:.3g}" if rung.error else "0 (exact)"
            notes.append(
                f"{', '.join(affected)}: by {rung.name}, Eq {rung.equation}; relative error {error}, allowed {rtol:g}"
            )
    return changed, notes
