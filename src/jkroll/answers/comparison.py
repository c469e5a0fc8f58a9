"""Results of JKR beside those of Maugis' law, which holds where JKR is in doubt."""

from collections.abc import Sequence
from math import log
from typing import NamedTuple

from ..quantities.formatting import amount
from ..quantities.laws import BETWEEN, LAWS
from ..quantities.nomenclature import NOMENCLATURE
from ..scene.errors import BeyondPullOff
from ..scene.limits import Verdict
from ..scene.scene import Scene
from ..scene.wiring import depends_on
from .other_laws import at_half_spacing, uses_law

_SHOWN = 2  # differences in the sentence
_NO_CHANGE = 0.005  # relative change that is no per cent
_MATTERS = 0.05  # relative change with the atomic spacing that is shown


class Difference(NamedTuple):
    """A quantity under Maugis' law, over that of JKR, with the assumed atomic spacing and with half of it."""

    name: str
    value: float
    ratio: float
    ratio_at_half_spacing: float


def differences(scene: Scene, names: Sequence[str]) -> tuple[Difference, ...]:
    """Return how quantities of a JKR scene differ under Maugis' law, the largest difference first."""
    if not scene.law.is_default:
        return ()
    between = scene.under(BETWEEN)
    wanted = [name for name in between.numbers(*names) if uses_law(between, name)]
    values = scene.numbers(*wanted)
    at_spacing = between.numbers(*wanted)
    at_half = at_half_spacing(between).numbers(*wanted)
    found = [
        Difference(name, at_spacing[name], at_spacing[name] / value, at_half[name] / value)
        for name, value in values.items()
        if value and at_spacing.get(name) and at_half.get(name) and at_spacing[name] / value > 0
    ]
    return tuple(sorted(found, key=lambda each: -abs(log(each.ratio))))


def with_differences(verdict: Verdict, found: Sequence[Difference], scene: Scene) -> Verdict:
    """Return a verdict with what Maugis' law says in place of a doubt about JKR; under another law, with where that holds."""
    if verdict.name == "tabor_parameter" and not scene.law.is_default:
        bound = scene.law.tabor_below
        if verdict.value < bound:
            return verdict._replace(holds=True, text=scene.law.fine)
        text = f"above {bound}: {LAWS[BETWEEN].title} is exact; --model {BETWEEN}"
        return verdict._replace(holds=False, text=text, code=f"{NOMENCLATURE[verdict.name].symbol}>{bound}")
    if verdict.holds or not scene.law.is_default:
        return verdict
    if verdict.name == "tabor_parameter" and found:
        return verdict._replace(text=_sentence(found, scene))
    if verdict.name == "hysteresis_ratio":
        between = scene.under(BETWEEN).numbers(verdict.name).get(verdict.name)
        return verdict if between is None else verdict._replace(text=f"{verdict.text}; {between:.3g} by Maugis' law")
    return verdict


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


def with_force_by_maugis(error: BeyondPullOff, scene: Scene) -> BeyondPullOff:
    """Return the error of a load beyond pull-off, with the pull-off force of Maugis' law if that holds the load."""
    if not scene.law.is_default:
        return error
    force = scene.under(BETWEEN).numbers("pull_off_force").get("pull_off_force", 0.0)
    return BeyondPullOff(error.load, error.pull_off_force, force) if force >= -error.load else error
