"""Laws of attraction side by side: what Maugis' law says beside results of JKR, and where its own are too uncertain."""

from collections.abc import Mapping, Sequence
from math import log
from typing import Any, NamedTuple

from ..quantities.formatting import amount
from ..quantities.nomenclature import NOMENCLATURE
from ..scene.errors import BeyondPullOff
from ..scene.laws import DEFAULT_LAW, LAWS, differs
from ..scene.limits import Verdict
from ..scene.scene import Scene
from ..scene.wiring import depends_on

BETWEEN = "maugis"  # the law that holds between JKR and DMT
_SHOWN = 2  # differences in the sentence
_NO_CHANGE = 0.005  # relative change that is no per cent
_DMT_BELOW = 0.01  # Tabor parameter, at which DMT's pull-off force is 0.1 % too large, and its approach 10 %
_OVER_SPACING = ("sticking_energy", "sticking_speed")  # they differ by orders of magnitude between plausible spacings
_MATTERS = 0.05  # relative change with the atomic spacing that is shown


class Difference(NamedTuple):
    """A quantity under Maugis' law, over that of JKR, with the assumed atomic spacing and with half of it."""

    name: str
    value: float
    ratio: float
    ratio_at_half_spacing: float


def differences(scene: Scene, names: Sequence[str]) -> tuple[Difference, ...]:
    """Return how quantities of a JKR scene differ under Maugis' law, the largest difference first."""
    if scene.law.name != DEFAULT_LAW:
        return ()
    between = scene.under(BETWEEN)
    wanted = [name for name in between.numbers(*names) if uses_law(between, name)]
    values = scene.numbers(*wanted)
    at_spacing = between.numbers(*wanted)
    at_half = _at_half_spacing(between).numbers(*wanted)
    found = [
        Difference(name, at_spacing[name], at_spacing[name] / value, at_half[name] / value)
        for name, value in values.items()
        if value and at_spacing.get(name) and at_half.get(name) and at_spacing[name] / value > 0
    ]
    return tuple(sorted(found, key=lambda each: -abs(log(each.ratio))))


def with_differences(verdict: Verdict, found: Sequence[Difference], scene: Scene) -> Verdict:
    """Return the verdict on the Tabor parameter with what Maugis' law says in place of a doubt, or under another law."""
    if verdict.name == "hysteresis_ratio" and scene.law.name == DEFAULT_LAW and not verdict.holds:
        between = scene.under(BETWEEN).numbers(verdict.name).get(verdict.name)
        return verdict if between is None else verdict._replace(text=f"{verdict.text}; {between:.3g} by Maugis' law")
    if verdict.name != "tabor_parameter":
        return verdict
    if scene.law.name == BETWEEN:
        return verdict._replace(holds=True, text="Maugis–Dugdale covers all from DMT to JKR")
    if scene.law.name != DEFAULT_LAW:
        is_small = verdict.value < _DMT_BELOW
        text = "small: DMT is close" if is_small else f"not small: {LAWS[BETWEEN].title} is exact; --model {BETWEEN}"
        return verdict._replace(holds=is_small, text=text)
    return verdict if verdict.holds or not found else verdict._replace(text=_sentence(found, scene))


def _sentence(found: Sequence[Difference], scene: Scene) -> str:
    """Return the largest differences: "Maugis–Dugdale has P_c +27 %, M −57 % at this ξ; --model maugis"."""
    half = amount("atomic_spacing", scene.values["atomic_spacing"] / 2)
    parts = []
    shown = [*found[:1], *(each for each in found[1:_SHOWN] if abs(each.ratio - 1) >= _NO_CHANGE)]
    for each in shown:
        matters = abs(each.ratio_at_half_spacing / each.ratio - 1) > _MATTERS
        at_half = f" ({_change(each.ratio_at_half_spacing)} at z0 = {half})" if matters else ""
        parts.append(f"{NOMENCLATURE[each.name].symbol} {_change(each.ratio)}{at_half}")
    at_displacement = any("yield_displacement" in depends_on([each.name]) for each in shown)
    suffix = " at this ξ" if at_displacement and "yield_displacement" in scene.values else ""
    return f"{LAWS[BETWEEN].title} has {', '.join(parts)}{suffix}; --model {BETWEEN}"


def _change(ratio: float) -> str:
    """Return a ratio as a change in per cent, or as a factor where it is large."""
    if abs(ratio - 1) < _NO_CHANGE:
        return "within 0.5 %"
    return f"{100 * (ratio - 1):+.0f} %".replace("-", "−") if 0.1 < ratio < 10 else f"×{ratio:.2g}"


def as_objects(found: Sequence[Difference]) -> dict[str, dict[str, dict[str, float]]]:
    """Return differences as JSON has them."""
    return {
        BETWEEN: {
            each.name: {
                "value": each.value,
                "over_jkr": each.ratio,
                "over_jkr_at_half_spacing": each.ratio_at_half_spacing,
            }
            for each in found
        }
    }


def of_jkr(scene: Scene, names: Sequence[str]) -> Mapping[str, float]:
    """Return the quantities of a scene under JKR, of those that the law of the scene has otherwise; none for JKR itself."""
    return {} if scene.law.name == DEFAULT_LAW else scene.under(DEFAULT_LAW).numbers(*names)


def uses_law(scene: Scene, name: str) -> bool:
    """Return whether a quantity of a scene rests on a formula of a law other than JKR."""
    if scene.law.name == DEFAULT_LAW:
        return False
    plan = scene.plan(name)
    routes = {route for key, route in scene.law.routes.items() if differs(key)}
    return plan.found[name] in routes or any(source in routes for step in plan.steps for _, source in step.arguments)


def equation_of(scene: Scene, name: str) -> str:
    """Return the equation by which a law has a quantity: that of the paper, or the source of the law."""
    return NOMENCLATURE[scene.plan(name).found[name]].equation or scene.law.source


def rests_on_spacing(name: str, scene: Scene) -> Any:
    """Return whether the atomic spacing decides on a quantity and was not given, or in which elements of arrays."""
    if name not in _OVER_SPACING or scene.law.name != BETWEEN or "atomic_spacing" in scene.given:
        return False
    return scene["transition_parameter"] < 1


def over_spacing(name: str, scene: Scene) -> str:
    """Return why a quantity that rests on the atomic spacing has no one value."""
    ends = [scene, _at_half_spacing(scene)]
    texts = [
        f"{amount(name, end[name])} at z0 = {amount('atomic_spacing', end.values['atomic_spacing'])}" for end in ends
    ]
    return f"from {' to '.join(texts)}; give --z0"


def at_equal_hysteresis(scene: Scene) -> str:
    """Return the moment at the adhesion hysteresis that JKR has at the same displacement, as a sentence."""
    if scene.law.name != BETWEEN or "adhesion_hysteresis" in scene.given:
        return ""
    of_jkr = scene.under(DEFAULT_LAW).numbers("yield_moment", "zone_radius")
    own = scene.numbers("zone_radius", "yield_moment")
    if len(of_jkr) + len(own) < 4:
        return ""
    moment = of_jkr["yield_moment"] * (own["zone_radius"] / of_jkr["zone_radius"])
    return (
        f"M: {amount('yield_moment', moment)}, {moment / of_jkr['yield_moment']:.3g} times JKR's, at the adhesion "
        "hysteresis that JKR has at this ξ; ξ is not the same number in every law"
    )


def without_contact(scene: Scene) -> str:
    """Return a sentence for spheres that attract across a gap."""
    if scene.law.name != BETWEEN or scene.numbers("contact_radius_at_load").get("contact_radius_at_load") != 0:
        return ""
    return "a: the spheres are bound without touching"


def with_force_by_maugis(error: BeyondPullOff, scene: Scene) -> BeyondPullOff:
    """Return the error of a load beyond pull-off, with the pull-off force of Maugis' law if that holds the load."""
    if scene.law.name != DEFAULT_LAW:
        return error
    force = scene.under(BETWEEN).numbers("pull_off_force").get("pull_off_force", 0.0)
    return BeyondPullOff(error.load, error.pull_off_force, force) if force >= -error.load else error


def _at_half_spacing(scene: Scene) -> Scene:
    return scene.replace(atomic_spacing=scene.values["atomic_spacing"] / 2)
