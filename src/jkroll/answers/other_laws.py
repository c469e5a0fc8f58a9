"""Results under a law of attraction other than JKR, and where the atomic spacing leaves them open."""

from collections.abc import Collection, Iterator, Sequence
from typing import Any

from ..quantities.formatting import amount
from ..quantities.laws import BETWEEN, DEFAULT_LAW, differs
from ..quantities.nomenclature import NOMENCLATURE
from ..scene.scene import Scene
from .result import Note, OtherLaw, Result


def with_law(results: Sequence[Result], scene: Scene) -> list[Result]:
    """Return the results of a law with its name and its source, and with the values of JKR beside them."""
    of_jkr = scene.under(DEFAULT_LAW).numbers(*(result.name for result in results))
    return [
        result._replace(law=OtherLaw(scene.law.name, equation_of(scene, result.name), of_jkr.get(result.name)))
        if result.value is not None and uses_law(scene, result.name)
        else result
        for result in results
    ]


def uses_law(scene: Scene, name: str) -> bool:
    """Return whether a quantity of a scene rests on a formula that JKR does not have."""
    plan = scene.plan(name)
    routes = {route for key, route in scene.law.routes.items() if differs(key)}
    return plan.found[name] in routes or any(source in routes for step in plan.steps for _, source in step.arguments)


def equation_of(scene: Scene, name: str) -> str:
    """Return the equation by which a law has a quantity: that of the paper, or the source of the law."""
    return NOMENCLATURE[scene.plan(name).found[name]].equation or scene.law.source


def rests_on_spacing(name: str, scene: Scene) -> Any:
    """Return whether the atomic spacing decides on a quantity and was not given, or in which elements of arrays."""
    if name not in scene.law.by_spacing or "atomic_spacing" in scene.given:
        return False
    return scene["transition_parameter"] < 1


def over_spacing(name: str, scene: Scene) -> str:
    """Return why a quantity that rests on the atomic spacing has no one value."""
    ends = [scene, at_half_spacing(scene)]
    texts = [
        f"{amount(name, end[name])} at z0 = {amount('atomic_spacing', end.values['atomic_spacing'])}" for end in ends
    ]
    return f"from {' to '.join(texts)}; give --z0"


def at_half_spacing(scene: Scene) -> Scene:
    """Return a scene whose atomic spacing is half as large."""
    return scene.replace(atomic_spacing=scene.values["atomic_spacing"] / 2)


def remarks(scene: Scene, names: Collection[str]) -> Iterator[Note]:
    """Iterate over the notes on results under a law other than JKR, most of them on Maugis'."""
    if "fold_energy" in names and not scene.law.is_default:
        yield Note("result", "F_cδ_c and its multiples are those of JKR")
    if scene.law.name != BETWEEN:
        return
    if "yield_moment" in names and "adhesion_hysteresis" not in scene.given:
        jkr = scene.under(DEFAULT_LAW).numbers("yield_moment", "zone_radius")
        own = scene.numbers("zone_radius", "yield_moment")
        if len(jkr) == len(own) == 2:
            moment = jkr["yield_moment"] * (own["zone_radius"] / jkr["zone_radius"])
            text = (
                f"M: {amount('yield_moment', moment)}, {moment / jkr['yield_moment']:.3g} times JKR's, at the adhesion "
                "hysteresis that JKR has at this ξ; ξ is not the same number in every law"
            )
            yield Note("result", text, "M at equal hysteresis")
    if "contact_radius_at_load" in names and scene["contact_radius_at_load"] == 0:
        yield Note("result", "a: the spheres are bound without touching")
