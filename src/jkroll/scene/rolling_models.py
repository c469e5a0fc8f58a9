"""Which model of the rolling moment is good enough: the ladder of `physics.ladder`, with errors, for `--rtol`."""

from collections.abc import Mapping
from typing import NamedTuple

from ..errors import NoResult
from .errors import MissingInput
from .scene import Scene

# Quantities that follow from the rolling moment: from its peak, its mean, its slope.
OF_PEAK = ("yield_moment", "yield_force", "yield_force_ratio")
OF_MEAN = ("mean_rolling_moment", "mean_rolling_force")
OF_SLOPE = ("rolling_frequency", "rolling_frequency_no_slip")


class Group(NamedTuple):
    """Quantities that follow from the moment in one way: as a power of it, and with a share of its term in ξ³."""

    names: tuple[str, ...]
    power: float
    cubic_share: float


GROUPS = (Group(OF_PEAK, 1.0, 1.0), Group(OF_MEAN, 1.0, 0.5), Group(OF_SLOPE, 0.5, 0.0))


class Rung(NamedTuple):
    """A model of the rolling moment, the ratio of a quantity by it to that by Eq (25), and its relative error."""

    name: str
    equation: str
    ratio: float
    error: float


class NotGoodEnough(NoResult):
    """No model of the ladder reaches the tolerance."""

    def __init__(self, rtol: float, detail: str) -> None:
        super().__init__(rtol, detail)
        self.rtol, self.detail = rtol, detail

    def __str__(self) -> str:
        return f"--rtol {self.rtol:g}: no model of rolling is that good here; {self.detail}"


_MODELS = {  # from the cheapest on: the equation of each
    "unloaded_moment": "26",
    "yield_moment": "25",
    "half_circles_moment": "19",
    "fixed_approach_moment": "25",
    "integrated_moment": "17",
}
_CUBIC = {"half_circles_moment": 2, "fixed_approach_moment": 1, "integrated_moment": 2}  # times E*aξ³/R above Eq (25)


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


def rungs(scene: Scene, group: Group) -> list[Rung]:
    """The models that a scene allows, from the cheapest on."""
    ratios = {"unloaded_moment": 1 / scene["load_factor"], "yield_moment": 1.0}
    try:
        cubic = group.cubic_share * (scene["fixed_approach_moment"] / scene["yield_moment"] - 1)
        ratios |= {name: 1 + times * cubic for name, times in _CUBIC.items()}
    except (MissingInput, NoResult):
        pass
    exact = ratios[exact_model(scene)] ** group.power
    powers = {name: ratio**group.power for name, ratio in ratios.items()}
    return [Rung(name, _MODELS[name], ratio, abs(1 - ratio / exact)) for name, ratio in powers.items()]


def cheapest(scene: Scene, rtol: float, group: Group) -> Rung:
    """The cheapest model within a relative tolerance; NotGoodEnough where there is none."""
    try:
        ratio = scene["displacement_ratio"]
    except (MissingInput, NoResult):
        ratio = 0.0
    if ratio >= 1 and group.cubic_share:
        raise NotGoodEnough(rtol, f"ξ is {ratio:.3g} of the displacement up to which the shifted contact is possible")
    models = rungs(scene, group)
    good = next((rung for rung in models if rung.error <= rtol), None)
    if good is None:
        raise NotGoodEnough(rtol, f"the best is off by {min(rung.error for rung in models):.3g}")
    return good


def within(
    values: Mapping[str, float], scene: Scene, rtol: float
) -> tuple[dict[str, float | NotGoodEnough], list[str]]:
    """The values of what follows from the moment, by the cheapest model within a tolerance or none, and what it is."""
    changed: dict[str, float | NotGoodEnough] = {}
    notes: list[str] = []
    for group in GROUPS:
        affected = [name for name in group.names if name in values]
        if not affected:
            continue
        try:
            rung = cheapest(scene, rtol, group)
        except NotGoodEnough as error:
            changed |= dict.fromkeys(affected, error)
            continue
        changed |= {name: values[name] * rung.ratio for name in affected}
        error_text = f"{rung.error:.3g}" if rung.error else "0 (exact)"
        names = ", ".join(affected)
        notes.append(f"{names}: by {rung.name}, Eq {rung.equation}; relative error {error_text}, allowed {rtol:g}")
    return changed, notes


# Quantities in proportion to the largest moment, to the mean one, and those that go with the root of its slope.
