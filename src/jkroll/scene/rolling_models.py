"""The models of the rolling moment, and their error against the one that is exact for a scene."""

from .scene import Scene

MODELS = ("unloaded_moment", "yield_moment", "half_circles_moment", "fixed_approach_moment")


def model_error(name: str, scene: Scene) -> float | None:
    """Return the relative error of a model; None for the exact one, for other quantities, and where one has no value.

    At a fixed load Eq (25) is exact; at a fixed approach, there is a term in ξ³ more.
    """
    exact_model = "fixed_approach_moment" if "approach_at_load" in scene.stated else "yield_moment"
    if name not in MODELS or name == exact_model:
        return None
    values = scene.numbers(name, exact_model)
    if len(values) < 2:
        return None
    return float(abs(values[name] - values[exact_model]) / values[exact_model])
