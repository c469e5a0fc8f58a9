"""Advice on the results of one scene: what may stand in their place, in full for programs and in words for people."""

from collections.abc import Mapping, Sequence
from typing import Any

from ..quantities.formatting import span
from ..quantities.laws import BETWEEN
from ..quantities.nomenclature import NOMENCLATURE, XI
from ..quantities.values import ends_of, is_uncertain, middle
from ..scene.alternatives import (
    DATA,
    FORCES,
    ROLLED,
    SIO2,
    alternatives_of,
    assumes_displacement,
    at_half_spacing,
    at_least_measured,
    at_most_measured,
    at_other_reading,
    by_law,
    displacements_where_measured,
    factor_of_data,
    factor_of_law,
    farthest,
    is_at_displacement,
    moved_by_law,
    rolled_solid,
    rolling,
    solid_of_kind,
)
from ..scene.limits import JUMP, LAW_MATTERS, Doubt
from ..scene.scene import Scene

MAX_TOLD = 2  # quantities in a note
_ALIKE = 0.2  # relative difference of radii that needs no scaling


# --- In full, for programs --------------------------------------------------------------------------------------------


def over_this_law(scene: Scene, values: Mapping[str, Any]) -> dict[str, dict[str, Any]]:
    """Return by quantity its value under the other law over that in use: with the atomic spacing and half of it.

    `values`: those under the other law. One has its error bar, and a rolling quantity both readings: at equal
    displacement, and at equal hysteresis.
    """
    law, other = scene.law.name, by_law(scene)
    ours = {name: number for name, number in scene.numbers(*values).items() if number}
    numbers = {name: None if values[name] is None else middle(values[name]) for name in ours}
    columns = {f"over_{law}": numbers}
    if law != BETWEEN:
        columns[f"over_{law}_at_half_spacing"] = {**dict.fromkeys(ours), **at_half_spacing(other).numbers(*ours)}
    rolled = rolling(ours, BETWEEN)
    if rolled and (reading := at_other_reading(scene)) is not None:
        readings = reading.numbers(*rolled)
        both = [{name: numbers[name] for name in readings}, readings]
        columns |= zip(readings_of(law), both if is_at_displacement(scene) else reversed(both), strict=True)
    entries: dict[str, dict[str, Any]] = {name: {"value": number} for name, number in numbers.items()}
    for key, column in columns.items():
        for name, number in column.items():
            entries[name][key] = None if number is None else number / ours[name]
    for name in filter(lambda name: is_uncertain(values[name]), entries):
        entries[name]["uncertainty"] = values[name]
    return entries


def readings_of(law: str) -> tuple[str, str]:
    """Return the keys of the two readings of a rolling quantity."""
    return f"over_{law}_at_equal_displacement", f"over_{law}_at_equal_hysteresis"


def displacement_in_full(scene: Scene, names: Sequence[str]) -> dict[str, Any] | None:
    """Return the measured displacement there and here, and the results with it, also over those of the assumed one.

    None where it is not assumed, or enters no result.
    """
    rolled = rolling(names, scene.law.name)
    if not rolled or not assumes_displacement(scene):
        return None
    worth: dict[str, Any] = {"at_pair": [*displacements_where_measured(scene)], "here": None, "over_assumed": {}}
    if rolled_solid(scene):
        ends = at_least_measured(scene), at_most_measured(scene)
        ours, low, high = (each.numbers(*rolled) for each in (scene, *ends))
        both = [name for name in rolled if ours.get(name) and name in low and name in high]
        worth["here"] = [end[XI] for end in ends]
        worth["over_assumed"] = {name: [low[name] / ours[name], high[name] / ours[name]] for name in both}
        worth["values"] = {
            name: [*ends_of(value)] for name, value in alternatives_of(scene, {DATA: both})[DATA].items()
        }
    return worth


# --- In words ---------------------------------------------------------------------------------------------------------


def about_doubt(doubt: Doubt, scene: Scene, headline: Sequence[str], known: Sequence[str]) -> str:
    """Return what follows from a limit for results: of an exceeded one, the values that may stand in their place.

    `headline`: the results that a command is named after; `known`: all of them.
    """
    if doubt.limit.factor is factor_of_law and doubt.is_exceeded:
        return _about_law(doubt, scene, headline or known)
    if doubt.limit.factor is factor_of_data and doubt.is_exceeded:
        return _about_displacement(scene, rolling(headline, scene.law.name) or rolling(known, scene.law.name))
    return _about_roughness(scene) if doubt.code == "rough-matters" else doubt.text


def _about_law(doubt: Doubt, scene: Scene, names: Sequence[str]) -> str:
    """Return what stands in place of answers that a law does not give exactly: "P_c = 14–15 nN by Maugis' law"."""
    texts = {name: advised(scene, name) for name in names}
    told = [f"{NOMENCLATURE[name].symbol} {text}" for name, text in texts.items() if text]
    spacing = span("atomic_spacing", scene["atomic_spacing"] / 2, scene["atomic_spacing"])
    scale = f"(Tabor parameter {doubt.value:.2g}, z0 = {spacing})"
    if not told:
        return f"neither {scene.law.title} nor Maugis' law is exact here {scale}"
    return f"{', '.join(told[:MAX_TOLD])} by Maugis' law, better here than {scene.law.title} {scale}: --model {BETWEEN}"


def advised(scene: Scene, name: str) -> str:
    """Return what a quantity is by Maugis' law, from half the atomic spacing on: "= 14–15 nN"; empty if it is the same.

    A pull-off force by Lennard-Jones' law is above Maugis' in every scene that was tried. Below the Tabor parameter of
    a jump, Maugis' law is no correction to the energies that separate spheres, and what follows from them: a well of
    Lennard-Jones' law is deeper still, and its contacts form and open without a jump.
    """
    other, ours = by_law(scene), scene.numbers(name).get(name)
    has_energy = NOMENCLATURE[name].unit in ("J", "m/s") or name == "restitution"
    is_no_correction = has_energy and not rolling([name], BETWEEN) and scene["tabor_parameter"] < JUMP
    if ours is None or is_no_correction or not moved_by_law(scene, [name]):
        return ""
    fit = ["pull_off_force_lennard_jones"] if name == "pull_off_force" else []
    others = [*other.numbers(name, *fit).values(), *at_half_spacing(other).numbers(name).values()]
    if not others:
        return "has no value"
    is_moved = not farthest((value, ours) for value in others) <= LAW_MATTERS
    return f"= {span(name, min(others), max(others))}" if is_moved else ""


def _about_displacement(scene: Scene, names: Sequence[str]) -> str:
    """Return what stands in place of answers with the assumed ξ: "Q = 89–270 pN by forces on SiO2 of 1 µm".

    The moment is proportional to what adhesion hysteresis supplies, which has an end.
    """
    values = alternatives_of(scene, {DATA: names[:MAX_TOLD]})[DATA]
    told = (f"{NOMENCLATURE[name].symbol} = {span(name, *ends_of(value))}" for name, value in values.items() if value)
    text = f"{', '.join(told)} by {_forces(scene)}; ξ is assumed (--xi)"
    most = at_most_measured(scene).numbers("hysteresis_ratio", "yield_force")
    if len(most) < 2 or most["hysteresis_ratio"] <= 1:
        return text
    force = most["yield_force"] / most["hysteresis_ratio"]
    return f"{text}; adhesion alone can supply up to Q = {span('yield_force', force, force)}"


def _about_roughness(scene: Scene) -> str:
    """Return what was measured where the pull-off force is that of smooth spheres."""
    force = scene.numbers("pull_off_force").get("pull_off_force", 0.0)
    smooth, rough = (span("pull_off_force", force / most, force / least) for most, least in ((4, 2), (100, 10)))
    return (
        f"on smooth glass 1/2 to 1/4 of P_c was measured ({smooth} here), of rough grains in air 1/10 to 1/100 "
        f"({rough})"
    )


def _forces(scene: Scene) -> str:
    """Return what was measured, and how it was brought to the size of a scene."""
    if rolled_solid(scene) != SIO2:
        return "displacements of polystyrene on glass at 5 µm, scaled to this size"
    text = f"forces on {SIO2} of 1 µm"
    if abs(2 * scene["reduced_radius"] / ROLLED["radius"] - 1) < _ALIKE:
        return text
    return f"{text} ({span('yield_force', *FORCES)}), scaled to this size"


def about_displacement(scene: Scene, solid: str) -> str:
    """Return what was measured where ξ is assumed for a scene, or for rows for which it stands.

    `solid`: that on which rolling was measured, if spheres may be like those; else empty.
    """
    if scene.material is not None and not solid:
        spheres = scene.material.name if scene.material2 is None else "this pair"
        like_these = " at this size and γ" if solid_of_kind(scene) else ""
        return f"ξ is assumed (--xi): no ξ of {spheres} was measured{like_these}"
    ends = span(XI, *displacements_where_measured(scene))
    of_silica = f"forces on {SIO2} of 1 µm mean {ends} under {scene.law.title}"
    measured = of_silica if solid in ("", SIO2) else "polystyrene has 42 nm at 5 µm"  # Sümer & Sitti
    return f"ξ is assumed (--xi): {measured}, and it grows with the sphere"
