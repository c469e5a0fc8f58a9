"""Sentences that explain best ranges: the rule that gives a range, and the effects it includes or leaves out."""

from collections.abc import Callable, Collection, Iterable, Iterator, Mapping
from math import isnan, nan

from ..materials.library import known_materials
from ..model.estimate import (
    ADHESION_ONLY,
    BETTER_LAW,
    BOUNDS,
    FRICTION_ASSUMED,
    GAP,
    KELVIN,
    LAW_IN_USE,
    LAW_ONLY,
    MEASURED,
    SCALED,
    SPACING_ASSUMED,
    WORDS,
    XI_UNKNOWN,
    Estimate,
    Ranges,
)
from ..model.frame import Frame
from ..model.limits import JUMP, ROUGH_MATTERS, may_be_rough
from ..model.measured import (
    ENERGY_ON_SURFACES,
    MOST_SEEN,
    SIO2,
    SURFACES,
    SURFACES_FROM,
    on_surfaces,
    solid_of_pair,
    solid_that_rolled,
    what_rolled,
    what_stuck,
)
from ..model.other_law import least_spacing
from ..quantities.formatting import amount, from_to, significant, span, symbol_among
from ..quantities.laws import BETWEEN
from ..quantities.nomenclature import INFINITY, XI
from ..quantities.values import middle
from ..text import first_of
from .answer import Answer
from .inferred import lack_by_better_law

_MOST = 3  # results in a note
_ALIKE = 0.01  # relative difference of radii below which nothing is scaled


def lines_on_rules(rules: Iterable[int], names: Collection[str]) -> Iterator[str]:
    """Iterate over a line for each rule that gives ranges in a table of these quantities."""
    for by in dict.fromkeys(rules):
        if by in _WORDS:
            surfaces = f"; {_OF_SMOOTH}" if by in (BETTER_LAW, BOUNDS) and "pull_off_force" in names else ""
            yield f"{WORDS[by]}: {_WORDS[by]}{surfaces}"


def range_in_words(name: str, estimate: Estimate) -> str:
    """Return a best range with its unit: "14–15 nN", "≥ 1.5e-18 J", or "none"."""
    low, high = estimate.low, estimate.high
    if isnan(low) and isnan(high):
        return "none"
    if isnan(low) or isnan(high):
        end = low if isnan(high) else high
        return f"{'≥' if isnan(high) else '≤'} {span(name, end, end)}"
    return span(name, low, high)


def why(by: int, answer: Answer) -> str:
    """Return the reason for the ranges by one rule, and the effects they include; empty for the law in use."""
    if by == LAW_ONLY and (lack := lack_by_better_law(answer)):
        return lack
    return _OF_ANSWER[by](answer) if by in _OF_ANSWER else _WORDS.get(by, "")


def made_of(name: str, answer: Answer) -> str:
    """Return the parts of a best range: its ends by each law, at both atomic spacings."""
    estimate = answer.estimates[name]
    if estimate.by not in (SCALED, XI_UNKNOWN, BETTER_LAW, LAW_IN_USE):
        return ""
    laws, spacing = [answer.frame.law.short], answer.frame.numbers("atomic_spacing").get("atomic_spacing", 0.0)
    laws.append(f"Maugis at {_angstroms(spacing, spacing)}")
    if answer.frame.assumes_spacing:
        laws.append(f"at {_angstroms(spacing / 2, spacing / 2)}")
    parts = zip(laws, answer.ranges.of_laws(name, estimate.by), strict=False)
    texts = [f"{law} {range_in_words(name, Estimate(*ends, estimate.by))}" for law, ends in parts]
    if name == "pull_off_force":
        forces = answer.frame.numbers("pull_off_force_lennard_jones").values()
        texts += [f"Lennard-Jones {span(name, force, force)}" for force in forces]
    return "; ".join(texts)


# --- Rules, for many rows ---------------------------------------------------------------------------------------------


def held_on_surfaces(frame: Frame) -> str:
    """Return the pull-off force of real surfaces: for SiO2 as measured, for other solids as a fraction of JKR's."""
    radii = frame.numbers("radius", "radius2").values()
    if min(radii, default=2 * frame["reduced_radius"]) < SURFACES_FROM:
        return "rough ones hold less: 1/2 to 1/100 of P_c if R is 1 µm or more, smaller ones were not measured"
    if solid_of_pair(frame) != SIO2:
        return f"real surfaces hold less (of JKR's force, measured for SiO2 only: {_ON_SURFACES})"
    forces = (f"{span('pull_off_force', *ends)} {surface}" for surface, ends in on_surfaces(frame).items())
    return f"real surfaces hold less: {', '.join(forces)}"


def about_surfaces(frame: Frame) -> str:
    """Return the fractions of JKR's pull-off force that were measured, and the surfaces they belong to."""
    parts = ", ".join(f"{surface.fraction} {name} ({surface.spheres})" for name, surface in SURFACES.items())
    energy, radius = amount("surface_energy", ENERGY_ON_SURFACES), amount("radius", frame["radius"])
    choice = "take glass for microspheres, rough grains for broken or natural ones; smooth is an upper limit"
    return f"{choice}. Scaled to {radius} as parts of JKR's force at γ = {energy}: {parts}; not measured in vacuum"


_ON_SURFACES = ", ".join(f"{surface.fraction} {name}" for name, surface in SURFACES.items())
_OF_SMOOTH = "P_c is that of smooth, dry spheres: rough ones hold less"
_SEEN = f"hard spheres were seen to stick at 1–{MOST_SEEN} times JKR's speed"
_WORDS: Mapping[int, str] = {
    MEASURED: f"{_SEEN}; for SiO2 of 0.1–3 µm the speeds measured on a plane, scaled like JKR's",
    SCALED: "rolling forces measured on this solid, scaled with R^(2/3) to R",
    XI_UNKNOWN: "not measured: from ξ = 2 Å (one atom) to where all of the work of adhesion is lost; give --xi",
    ADHESION_ONLY: "adhesion alone loses at most this; any other loss comes on top and lowers e",
    FRICTION_ASSUMED: (
        "sliding and twisting rest on τ = G/4π², known to an order of magnitude, and on JKR's area: the range covers "
        "τ/3 to 3τ (--shear-strength)"
    ),
    SPACING_ASSUMED: "the range is of z0 = 2–4 Å, as far as it is known; give --z0",
    BOUNDS: "JKR's holds for soft spheres, DMT's for hard ones; E and ν decide",
    LAW_ONLY: "no better law gives it",
    KELVIN: "condensed water at 25 °C (--contact-angle) between smooth bodies that touch: compare with P_c, do not add",
    GAP: "a gap lowers the force of a meniscus, to none where it just fills; no closed form says how far",
    BETTER_LAW: "JKR may be more than 5 % off; the attraction reaches z0 = 2–4 Å (--z0)",
    LAW_IN_USE: "Maugis' law is within 5 % here; the range covers both",
}


# --- Rules, for one answer --------------------------------------------------------------------------------------------


def _kelvin(answer: Answer) -> str:
    text = "condensed water, 25 °C"
    if "roughness_gap" in answer.frame.given:
        return f"{text}; adsorbed water may bridge a gap before: forces of menisci were measured from 2 % humidity on"
    if "meniscus_force" not in answer.values:
        return text
    compare = "compare F_men with P_c, do not add it, as water changes γ, too"
    rough = "roughness lowers both: SiO2 of 10 µm on smooth glass had 1/8–1/5 of F_men at 67 %"
    return f"{text}, smooth bodies that touch; {compare}; {rough}; --roughness 2nm says when a gap fills"


def _better_law(answer: Answer) -> str:
    frame = answer.frame
    low, high = least_spacing(frame), frame["atomic_spacing"]
    known = frame.numbers("tabor_parameter").values()  # rigid bodies have none
    at = "".join(f" (Tabor parameter {from_to(parameter, high / low * parameter)})" for parameter in known)
    narrowed = " (--z0)" if frame.assumes_spacing else ""
    text = f"{frame.law.short} {_how_far_off(answer)} at this size and stiffness{at}"
    text += f"; the attraction reaches z0 = {_angstroms(low, high)}{narrowed}{_with_bars(answer)}"
    is_told = answer.is_in_doubt(ROUGH_MATTERS) or answer.is_on_pull_off
    if "pull_off_force" in answer.estimates and may_be_rough(frame) and not is_told:
        text += f". P_c is that of smooth, dry spheres; {held_on_surfaces(frame)}"
    return text


def _how_far_off(answer: Answer) -> str:
    """Return how far the law in use is from the better law's ranges: "is 25–33 % too high (a), 5–8 % too low (δ)"."""
    vague = "may be more than 5 % off"
    if answer.described.uncertainties:
        return vague
    errors: dict[str, list[float]] = {"high": [], "low": []}  # in %, of both ends of each range
    symbols: dict[str, list[str]] = {"high": [], "low": []}
    seen = set[float]()  # a result that repeats another one has no row
    for name, estimate in answer.estimates.items():
        value = answer.values.get(name, nan)
        if estimate.by != BETTER_LAW or name in answer.question.without_row or value in seen:
            continue
        seen.add(value)
        ratios = [value / end if end else nan for end in estimate[:2]]
        if not (min(ratios) >= 1 or 0 < max(ratios) <= 1) or any(map(isnan, ratios)):
            return vague
        side = "high" if max(ratios) > 1 else "low"
        errors[side] += [100 * abs(ratio - 1) for ratio in ratios]
        symbols[side].append(symbol_among(name, answer.inputs))
    texts = []
    for side, of_side in errors.items():
        if of_side:
            which = f" ({first_of(symbols[side], _MOST)})" if all(errors.values()) else ""
            texts.append(f"{from_to(min(of_side), max(of_side))} % too {side}{which}")
    return f"is {', '.join(texts)}" if texts else vague


def _with_bars(answer: Answer) -> str:
    if answer.described.unknowns and not answer.described.uncertainties:
        return "; the error of what you measured is not in the range: write it as 300±20nN"
    return "; your error bars are in the range" if answer.described.uncertainties else ""


def _angstroms(low: float, high: float) -> str:
    return f"{from_to(low / 1e-10, high / 1e-10)} Å"


def _bounds(answer: Answer) -> str:
    ends, *_ = answer.ranges.of_laws("pull_off_force", BOUNDS)
    ratio = answer.frame["pull_off_force_dmt"] / answer.frame["pull_off_force"]
    jkr, dmt = (span("pull_off_force", *(factor * end for end in ends)) for factor in (1.0, ratio))
    limits = f"JKR's ({jkr}) holds for soft spheres, DMT's ({dmt}) for hard ones"
    text = f"{limits}; give --young and --poisson to narrow it{_with_bars(answer)}"
    return text if answer.is_on_pull_off else f"{text}. {_OF_SMOOTH}"


def _measured(answer: Answer) -> str:
    stuck = what_stuck(answer.frame)
    if stuck is None or not stuck.has_size(answer.frame):
        return f"{_SEEN} (silica, ices, silver), as adhesion is not their only loss"
    pairs = (f"{significant(stuck.at(radius), 2)} m/s (R = {amount('radius', radius)})" for radius in stuck.radii)
    bar = f"±{stuck.error:.0%}".replace("%", " %") + _above_law(answer)
    seen = f"{solid_of_pair(answer.frame)} stuck to a plane up to {' and '.join(pairs)}"
    if stuck.is_near(answer.frame):
        return f"{seen}, between them as R^{stuck.exponent}, {bar}"
    scaled = f"scaled to this size like {answer.frame.law.short}'s speed, {bar}"
    return f"{seen}; {scaled}. It is the same for every γ, whose effect was not measured"


def _above_law(answer: Answer) -> str:
    """Return the ratio of the measured speeds to the law's, as a text; empty unless all of them are larger."""
    estimate, speed = answer.estimates.get("sticking_speed"), answer.values.get("sticking_speed", INFINITY)
    if estimate is None or not estimate.low > speed:
        return ""
    times = from_to(estimate.low / speed, estimate.high / speed)
    return f"; {times} times {answer.frame.law.short}'s, as adhesion is not the only loss"


def _scaled(answer: Answer) -> str:
    frame, rolled = answer.frame, what_rolled(answer.frame)
    if rolled is None:
        return ""
    radius, solid = 2 * frame["reduced_radius"], solid_that_rolled(frame)
    at = f"R = {amount('radius', rolled.radius)} ({rolled.source})"
    what = f"ξ of {solid} was {span(rolled.name, rolled.low, rolled.high)}"
    if rolled.name != XI:
        what = f"{span(rolled.name, rolled.low, rolled.high)} rolled {solid}"
    if rolled.name != XI and answer.described.uncertainties:
        what = f"your error bars do not change measured forces: {what}"
    if abs(radius / rolled.radius - 1) < _ALIKE:
        return f"{what} of {at}"
    low, high = ("R", "R^(2/3)") if radius < rolled.radius else ("R^(2/3)", "R")
    ratio = significant(max(radius / rolled.radius, rolled.radius / radius), 3)
    to = f"{amount('radius', radius)}, {ratio} times {'smaller' if radius < rolled.radius else 'larger'}"
    return (
        f"{what} of {at}; to {to}, low end with {low}, high end with {high}{_as_displacement(answer)}{_ceiling(answer)}"
    )


def _as_displacement(answer: Answer) -> str:
    """Return the displacement that measured forces imply by the law in use."""
    low, high = answer.ranges.of_laws(XI, SCALED)[0]
    least = ", at least one atom" if low == answer.frame.values.get(XI) else ""
    return f". In {answer.frame.law.short} that is ξ = {span(XI, low, high)}{least}" if low < high else ""


def _ceiling(answer: Answer) -> str:
    """Return the largest force that adhesion explains, if the measured forces exceed it."""
    ceiling = answer.ranges.at_full_hysteresis("yield_force")
    found = answer.estimates.get("yield_force")
    if found is None or not found.high > ceiling[1]:
        return ""
    most = span("yield_force", ceiling[1], ceiling[1])
    return f". The most that adhesion alone can cause is {most}"


def _xi_unknown(answer: Answer) -> str:
    if answer.frame.missing(["hysteresis_ratio"]):
        return f"the known end is at ξ = 2 Å, about one atom; {_of_silica(answer)}name your material"
    by_law = "" if answer.frame.law.name == BETWEEN else ", by Maugis' law"
    most = answer.ranges.at_full_hysteresis(XI)[1]
    at_most = "" if isnan(most) else f" (ξ = {span(XI, most, most)})"
    ends = f"from one atom (ξ = 2 Å{by_law}) to where rolling loses all of the work of adhesion{at_most}"
    text = f"how far the contact lags before it rolls was not measured for this pair: {ends}"
    return f"{text}; --xi narrows it{_of_measured_solid(answer)}"


def _of_silica(answer: Answer) -> str:
    """Return the headline by rolling forces measured on SiO2, for comparison; empty if they give none."""
    silica = Frame(answer.frame.stated, known_materials()["quartz"])
    if not isinstance(answer.frame.given.get("radius"), float):
        return ""
    ranges = Ranges.of(silica, *silica.possible(answer.question.headline))
    found = {name: ranges.estimate(name) for name in ranges.names}
    scaled = [
        f"{symbol_among(name, answer.inputs)} is {range_in_words(name, estimate)}"
        for name, estimate in found.items()
        if estimate.by == SCALED
    ]
    if not scaled:
        return ""
    return f"for SiO2 (quartz), which was measured, {first_of(scaled, _MOST)}; "


def _of_measured_solid(answer: Answer) -> str:
    """Return the sentence on forces measured on spheres of the same solid, but another size or surface energy."""
    rolled, solid = what_rolled(answer.frame), solid_that_rolled(answer.frame)
    if rolled is None:
        return ""
    radius = 2 * answer.frame["reduced_radius"]
    if rolled.has_energy(answer.frame):
        at, here = (amount("radius", each) for each in (rolled.radius, radius))
        return f". The forces that rolled {solid} at {at} are in it, too, scaled as far as to {here}"
    if not rolled.has_size(radius) or "yield_force" not in answer.estimates:
        return ""
    energies = span("surface_energy", *rolled.energies)
    forces = span(rolled.name, rolled.least(radius), rolled.most(radius))
    return f". {solid} of {energies} rolled at {forces} (scaled)"


def _adhesion_only(answer: Answer) -> str:
    if answer.described.unknowns:
        return "it is an upper limit: other losses of the collision are taken for it"
    most = 2 if answer.frame.assumes_spacing else 1
    if answer.frame.numbers("tabor_parameter").get("tabor_parameter", INFINITY) * most >= JUMP:
        return "adhesion alone leaves the higher end; any other loss lowers it"
    text = "at most JKR's loss, as so small and stiff they touch and part without a jump"
    if "restitution" not in answer.values or answer.estimates["restitution"].by != ADHESION_ONLY:
        return f"{text}; the solids dissipate the rest"
    return f"{text}; any other loss lowers e, which is 0 if they stick"


def _by_dmt(answer: Answer) -> str:
    """Return the inferred values by DMT's law, which needs no modulus."""
    found = answer.by_law.get("dmt", {})
    texts = [
        f"{symbol_among(name, answer.inputs)} = {span(name, *2 * (middle(value),))}" for name, value in found.items()
    ]
    return f"; by DMT's, for hard spheres, {', '.join(texts)}" if texts else ""


def _law_only(answer: Answer) -> str:
    if answer.frame.missing(["tabor_parameter"]):
        return f"which law holds needs Young's modulus and Poisson's ratio{_by_dmt(answer)}"
    return _WORDS[LAW_ONLY]


_OF_ANSWER: Mapping[int, Callable[[Answer], str]] = {
    BETTER_LAW: _better_law,
    KELVIN: _kelvin,
    BOUNDS: _bounds,
    MEASURED: _measured,
    SCALED: _scaled,
    XI_UNKNOWN: _xi_unknown,
    ADHESION_ONLY: _adhesion_only,
    LAW_ONLY: _law_only,
}
