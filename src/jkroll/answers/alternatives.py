"""What may stand in place of the results of one scene: those under the law of attraction that holds between JKR and DMT."""

from collections.abc import Collection, Iterator, Mapping, Sequence
from typing import TYPE_CHECKING, NamedTuple

from ..errors import JkrollError
from ..quantities.formatting import span
from ..quantities.laws import BETWEEN
from ..quantities.nomenclature import NOMENCLATURE, XI
from ..scene.alternatives import (
    at_half_spacing,
    at_other_reading,
    by_law,
    farthest,
    is_at_displacement,
    ratio,
    uses_law,
)
from ..scene.limits import JUMP, LAW_MATTERS, Doubt
from ..scene.scene import Scene
from ..scene.wiring import depends_on

if TYPE_CHECKING:
    from ..quantities.values import Uncertain

# Below the Tabor parameter of a jump, Maugis' law is no correction to energies: a well of Lennard-Jones' law is deeper still, and its
# contacts form and open without a jump.
_OF_ENERGY = (
    "well_energy",
    "pull_off_work",
    "pull_off_work_at_dead_load",
    "sticking_energy",
    "sticking_speed",
    "disruption_energy",
    "disruption_speed",
)
MAX_ADVISED = 2  # quantities in a note


class Alternative(NamedTuple):
    """The answers of a scene that may stand in place of the one that was asked, by quantity.

    None stands for a quantity that has no value there. One that is not among them is the same.
    """

    key: str  # in names of columns and in JSON
    head: str  # of a column
    values: "Mapping[str, float | Uncertain | None]"


def under_other_law(scene: Scene, names: Sequence[str]) -> Alternative:
    """Return the answers under the law that holds between JKR and DMT; under that law, those of JKR."""
    other = by_law(scene)
    between = scene if scene.law.name == BETWEEN else other
    missing = {*other.missing(names), *scene.missing(names)}
    found = other.evaluate([name for name in names if name in missing or uses_law(between, name)])
    values = {name: None if isinstance(value, JkrollError) else value for name, value in found.items()}
    return Alternative(other.law.name, other.law.title.partition("–")[0], _with_error_bars(other, values))


def _with_error_bars(scene: Scene, values: "Mapping[str, float | None]") -> "Mapping[str, float | Uncertain | None]":
    """Return values of a scene with their error bars, if its inputs have some."""
    known = [name for name, value in values.items() if value is not None]
    if not scene.is_uncertain or not known:
        return values
    from ..scene.uncertainty import uncertainties

    found, _ = uncertainties(scene, known)
    bars = {name: bar.uncertainty for name, bar in found.items() if not isinstance(bar, JkrollError)}
    return {**values, **bars}


def over_this_law(scene: Scene, names: Collection[str]) -> dict[str, dict[str, float | None]]:
    """Return by quantity its value under the law that holds, over that under the law in use: with the atomic spacing and with half of it.

    A rolling quantity has both readings: at equal displacement, and at equal hysteresis of adhesion.
    """
    known = {name: value for name, value in scene.numbers(*names).items() if value}
    values = under_other_law(scene, [*known]).values
    law, other = scene.law.name, by_law(scene)
    half = at_half_spacing(other).numbers(*values)
    rolling = [name for name in values if XI in depends_on([name], [BETWEEN])]
    reading = at_other_reading(scene) if rolling else None
    readings = reading.numbers(*rolling) if reading is not None else {}
    keys = (f"over_{law}_at_equal_displacement", f"over_{law}_at_equal_hysteresis")
    found: dict[str, dict[str, float | None]] = {}
    for name, value in other.numbers(*values).items():
        found[name] = {"value": value, f"over_{law}": value / known[name]}
        found[name][f"over_{law}_at_half_spacing"] = half[name] / known[name] if name in half else None
        if name in readings:
            both = [value / known[name], readings[name] / known[name]]
            found[name] |= zip(keys, both if is_at_displacement(scene) else reversed(both), strict=True)
    return found


def about_law(doubt: Doubt, scene: Scene, names: Sequence[str]) -> str:
    """Return what stands in place of answers that a law does not give exactly: "P_c = 14–15 nN by Maugis' law"."""
    told = [text for name in names if doubt.value >= JUMP or name not in _OF_ENERGY for text in _advised(scene, name)]
    spacing = span("atomic_spacing", scene["atomic_spacing"] / 2, scene["atomic_spacing"])
    lead = (
        ", ".join(told[:MAX_ADVISED]) + " by Maugis' law"
        if told
        else f"{scene.law.title} is inexact here, and Maugis' law, too"
    )
    return f"{lead} (Tabor parameter {doubt.value:.2g}, z0 = {spacing}); --model {BETWEEN}"


def _advised(scene: Scene, name: str) -> Iterator[str]:
    """Iterate over the text on a quantity that the law which holds moves: its range, from half the atomic spacing to all of it.

    A pull-off force by Lennard-Jones' law is above Maugis' in every scene that was tried.
    """
    other = by_law(scene)
    own = scene.numbers(name).get(name)
    if own is None or name in other.missing([name]) or not uses_law(other, name):
        return
    fit = ["pull_off_force_lennard_jones"] if name == "pull_off_force" else []
    found = [*other.numbers(name, *fit).values(), *at_half_spacing(other).numbers(name).values()]
    symbol = NOMENCLATURE[name].symbol
    if not found:
        yield f"{symbol} has no value"
    elif not farthest(ratio(value, own) for value in found) <= LAW_MATTERS:
        yield f"{symbol} = {span(name, min(found), max(found))}"
