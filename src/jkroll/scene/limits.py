"""The numbers that limit the model, and the sentences that say how far an answer can be trusted."""

from collections.abc import Callable, Collection
from typing import NamedTuple

from ..errors import JkrollError
from ..quantities.nomenclature import NOMENCLATURE
from .scene import Scene
from .wiring import STATE

JKR_FROM = 5.0  # Tabor parameter above which JKR holds, and below which DMT does
DMT_UP_TO = 0.1
APPROACH_OF_TABOR = 1.9488  # δ0/z0 = (3π²/4)^(1/3) μ: another form of the Tabor parameter


class Verdict(NamedTuple):
    """A number that limits the model, and what follows from it for an answer."""

    name: str
    value: float
    holds: bool
    text: str


class Limit(NamedTuple):
    """A limit of the model: the number, the names whose use it touches, and how it is judged."""

    name: str
    touches: frozenset[str]
    judge: Callable[[float], tuple[bool, str]]
    doubt: str = ""  # about values far beyond it


def _tabor(mu: float) -> tuple[bool, str]:
    if mu >= JKR_FROM:
        return True, "large: JKR holds"
    if mu > DMT_UP_TO:
        return False, f"between DMT (below {DMT_UP_TO}) and JKR (above {JKR_FROM:g}): neither is exact"
    return False, "small: DMT is closer than JKR"


def _displacement(ratio: float) -> tuple[bool, str]:
    if ratio < 1:
        return True, "below 1: the shifted contact is possible"
    return False, "above 1: the leading edge would interpenetrate, and rolling has no meaning"


def _spacings(ratio: float) -> tuple[bool, str]:
    return (
        (True, "many atoms in the contact")
        if ratio >= 3
        else (False, "few atoms in the contact: elasticity is in doubt")
    )


def _approach(ratio: float) -> tuple[bool, str]:
    if ratio >= APPROACH_OF_TABOR * JKR_FROM:
        return True, "the neck is much longer than the range of the surface forces"
    return False, "the neck is not much longer than the range of the surface forces"


def _margin(s: float) -> tuple[bool, str]:
    return (True, "stable at its load") if s >= 0 else (False, "beyond pull-off: only fixed grips hold this state")


def _load(ratio: float) -> tuple[bool, str]:
    return (True, "within the paper's range -1 to 1") if ratio <= 1 else (False, "above the paper's range -1 to 1")


def _energy(ratio: float) -> tuple[bool, str]:
    return (True, "above 1: it rolls") if ratio > 1 else (False, "below 1: the contact springs back and does not roll")


def _force(ratio: float) -> tuple[bool, str]:
    return (
        (True, "below 1: it rolls before it breaks")
        if ratio < 1
        else (False, "above 1: the contact breaks before it rolls")
    )


LIMITS = (
    Limit("tabor_parameter", frozenset({"work_of_adhesion"}), _tabor, "DMT is closer than JKR"),
    Limit("contact_radius_in_spacings", frozenset({"work_of_adhesion"}), _spacings, "elasticity is in doubt"),
    Limit("approach_in_spacings", frozenset({"approach", "approach_at_load"}), _approach),
    Limit("load_over_pull_off", frozenset({"load", "load_factor", "load_factor_at_approach"}), _load),
    Limit("load_margin", frozenset({"load_factor", "load_factor_at_approach"}), _margin),
    Limit(
        "displacement_ratio", frozenset({"yield_displacement"}), _displacement,
        "the leading edge would interpenetrate, and rolling has no meaning",
    ),
    Limit("yield_force_ratio", frozenset({"yield_force"}), _force),
    Limit("energy_over_yield", frozenset({"n_roll", "n_roll_energy_balance"}), _energy),
)  # fmt: skip

LIMIT_NAMES = tuple(limit.name for limit in LIMITS)

# Limits of the state, which are judged only where a state was asked for.
_OF_STATE = ("load_over_pull_off", "load_margin")
_STATED = STATE | {"load"}


def uses_spacing(found: tuple[Verdict, ...]) -> bool:
    """Return whether a verdict rests on the atomic spacing."""
    return any(
        verdict.name in ("tabor_parameter", "contact_radius_in_spacings", "approach_in_spacings") for verdict in found
    )


def verdicts(scene: Scene, names: Collection[str]) -> tuple[Verdict, ...]:
    """Return what limits the answers to these names, as far as the scene allows to judge it."""
    if not names:
        return ()
    values = scene.evaluate((*names, *LIMIT_NAMES))
    plan = scene.plan(*names)
    used = {*names, *plan.stated, *(step.name for step in plan.steps)}
    found = []
    for limit in LIMITS:
        value = values[limit.name]
        if isinstance(value, JkrollError) or not limit.touches & used:
            continue
        if limit.name not in _OF_STATE or _STATED & scene.stated.keys():
            found.append(Verdict(limit.name, value, *limit.judge(value)))
    return tuple(found)


def sentence(verdict: Verdict) -> str:
    """Return a verdict as a line: "Tabor parameter μ = 0.14, between DMT and JKR"."""
    quantity = NOMENCLATURE[verdict.name]
    return f"{quantity.symbol} = {verdict.value:.3g}, {quantity.sentence}; {verdict.text}"
