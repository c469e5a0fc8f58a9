"""The words for best ranges: by which rule each stands, in a line, and what it holds and leaves out."""

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from math import isnan

from ..model.estimate import (
    ADHESION_ONLY,
    AT_LEAST,
    BETTER_LAW,
    LAW_IN_USE,
    LAW_ONLY,
    MEASURED,
    SCALED,
    WORDS,
    XI_UNKNOWN,
    Estimate,
    Ranges,
)
from ..model.limits import JUMP, LAW_MATTERS, ROUGH_MATTERS, may_be_rough
from ..model.measured import ROLLED, STUCK, solid_of_pair, solid_that_rolled
from ..model.other_law import farthest
from ..model.results import Results
from ..quantities.formatting import amount, from_to, significant, span, symbol_among
from ..quantities.laws import BETWEEN
from ..quantities.nomenclature import XI
from ..text import first_of
from .answer import Answer
from .impacts import elastic_or_not
from .inferred import lack_by_better_law
from .notes import Note

_MOST = 3  # results in a note
_ALIKE = 0.01  # relative difference of radii that needs no scaling


def lines_on_ranges(answer: Answer, names: Iterable[str]) -> Iterator[str]:
    """Iterate over a line for each rule by which some results have a range, in the order of the results."""
    for by in dict.fromkeys(answer.estimates[name].by for name in names if name in answer.estimates):
        if text := why(by, answer):
            yield f"{WORDS[by]}: {text}"


def lines_on_rules(rules: Iterable[int]) -> Iterator[str]:
    """Iterate over a line for each rule, for many rows."""
    for by in dict.fromkeys(rules):
        if by in _WORDS:
            yield f"{WORDS[by]}: {_WORDS[by]}"


def notes_on_ranges(answer: Answer) -> Iterator[Note]:
    """Iterate over a note for each rule by which results of the headline have a range, where no table shows it."""
    texts: dict[int, list[str]] = {}
    for name, estimate in answer.estimates.items():
        if name in answer.question.headline:
            text = f"{symbol_among(name, answer.inputs)}: {range_in_words(name, estimate)}"
            texts.setdefault(estimate.by, []).append(text)
    for by, of_rule in texts.items():
        if text := why(by, answer):
            yield Note("lead", f"best range of {first_of(of_rule, _MOST)} ({WORDS[by]}); {text}")


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
    """Return why results have a range by a rule, what it holds and leaves out; empty for the law in use."""
    if by == LAW_ONLY and (lack := lack_by_better_law(answer)):
        return lack
    return _OF_ANSWER[by](answer) if by in _OF_ANSWER else _WORDS.get(by, "")


def made_of(name: str, answer: Answer) -> str:
    """Return what the best range of a result is made of: its ends by each law, at both atomic spacings."""
    estimate, half = answer.estimates[name], answer.frame.numbers("atomic_spacing").get("atomic_spacing", 0.0) / 2
    if estimate.by not in (SCALED, XI_UNKNOWN, BETTER_LAW, LAW_IN_USE):
        return ""
    laws = (answer.frame.law.short, f"Maugis at {_angstroms(2 * half, 2 * half)}", f"at {_angstroms(half, half)}")
    parts = zip(laws, answer.ranges.of_laws(name, estimate.by), strict=True)
    texts = [f"{law} {range_in_words(name, Estimate(*ends, estimate.by))}" for law, ends in parts]
    if name == "pull_off_force":
        forces = answer.frame.numbers("pull_off_force_lennard_jones").values()
        texts += [f"Lennard-Jones {span(name, force, force)}" for force in forces]
    return "; ".join(texts)


# --- Rules in words, for many rows ------------------------------------------------------------------------------------

_SMOOTH_AND_DRY = (
    "for smooth, dry spheres: smooth glass had 1/4–1/2 of it, rough grains 1/100–1/10, humid air up to twice"
)
_WORDS: Mapping[int, str] = {
    MEASURED: "solids were seen to stick at 1–10 times JKR's speed, SiO2 to a plane as in jkroll guide validation",
    SCALED: "forces that rolled spheres of this solid, taken as R^(2/3) to R",
    XI_UNKNOWN: "nothing was measured: low is ξ = 2 Å (one atom), high all of the work of adhesion lost; give --xi",
    ADHESION_ONLY: "so small and stiff they touch and part without a jump; other losses come on top",
    LAW_ONLY: "no other law here has it; where JKR does not hold, Maugis' contact is smaller",
    AT_LEAST: f"Lennard-Jones' law binds more than JKR's at a Tabor parameter below {JUMP}",
    BETTER_LAW: f"JKR is more than 5 % off; z0 = 2–4 Å (--z0); {_SMOOTH_AND_DRY}",
    LAW_IN_USE: "Maugis' law is within 5 %; the range is of both",
}


# --- Rules in words, for an answer ------------------------------------------------------------------------------------


def _better_law(answer: Answer) -> str:
    frame = answer.frame
    is_pulled = not {"pull_off_force", "bond_number"}.isdisjoint(answer.estimates)
    if frame.missing(["tabor_parameter"]):
        limits = "from JKR (soft spheres) to DMT (hard); which holds needs Young's modulus and Poisson's ratio"
        return f"{limits}{_with_bars(answer)}. It is {_SMOOTH_AND_DRY}"
    parameter, spacing = frame["tabor_parameter"], frame["atomic_spacing"]
    tabor = f"Tabor parameter {from_to(parameter, 2 * parameter)}"
    law = f"{frame.law.short} is more than 5 % off at this size and stiffness ({tabor})"
    text = f"{law}; z0 = {_angstroms(spacing / 2, spacing)} (--z0){_with_bars(answer)}"
    is_told = answer.is_in_doubt(ROUGH_MATTERS)  # with numbers
    return f"{text}. It is {_SMOOTH_AND_DRY}" if is_pulled and may_be_rough(frame) and not is_told else text


def _with_bars(answer: Answer) -> str:
    return "; your error bars are in the range" if answer.described.uncertainties else ""


def _angstroms(low: float, high: float) -> str:
    return f"{from_to(low / 1e-10, high / 1e-10)} Å"


def _measured(answer: Answer) -> str:
    solid = solid_of_pair(answer.frame)
    stuck = STUCK.get(solid)
    if stuck is None or not stuck.is_near(answer.frame):
        return "solids were seen to stick at 1–10 times JKR's speed; adhesion alone loses less than JKR's here"
    pairs = (f"{significant(stuck.at(radius), 2)} m/s ({amount('radius', radius)})" for radius in stuck.radii)
    bar = f"±{stuck.error:.0%}".replace("%", " %")
    return f"{solid} stuck to a plane up to {' and '.join(pairs)}, between them as R^{stuck.exponent}, {bar}"


def _scaled(answer: Answer) -> str:
    frame = answer.frame
    solid = solid_that_rolled(frame)
    rolled, radius = ROLLED[solid], 2 * frame["reduced_radius"]
    at = f"R = {amount('radius', rolled.radius)}"
    what = f"ξ of {solid} was {span(rolled.name, rolled.low, rolled.high)}"
    if rolled.name != XI:
        what = f"{span(rolled.name, rolled.low, rolled.high)} rolled {solid}"
    if abs(radius / rolled.radius - 1) < _ALIKE:
        return f"{what} of {at}"
    low, high = ("R", "R^(2/3)") if radius < rolled.radius else ("R^(2/3)", "R")
    text = f"{what} of {at}, taken as {low} (low) or {high} (high) to {amount('radius', radius)}"
    return text + _of_both_laws(answer) + _ceiling(answer)


def _of_both_laws(answer: Answer) -> str:
    """Return the results whose ends are by different laws, as forces mean another ξ by each."""
    of_two = [
        symbol_among(name, answer.inputs)
        for name, estimate in answer.estimates.items()
        if estimate.by == SCALED and _differ(answer.ranges.of_laws(name, SCALED))
    ]
    return f"; {first_of(of_two, _MOST)} by both laws" if of_two else ""


def _differ(every: Sequence[tuple[float, float]]) -> bool:
    """Return whether the ends of a result by laws differ by as much as matters."""
    (low, high), *others = every
    return bool(farthest(pair for least, most in others for pair in ((least, low), (most, high))) > LAW_MATTERS)


def _ceiling(answer: Answer) -> str:
    """Return what adhesion supplies at most, if forces that were measured mean more."""
    ceiling = answer.ranges.at_full_hysteresis("yield_force")
    found = answer.estimates.get("yield_force")
    if found is None or not found.high > ceiling[1]:
        return ""
    return f". Adhesion alone explains up to {span('yield_force', ceiling[1], ceiling[1])}"


def _xi_unknown(answer: Answer) -> str:
    if answer.frame.missing(["hysteresis_ratio"]):
        return "this end is at ξ = 2 Å, one atom; how large ξ can be needs γ, Young's modulus and Poisson's ratio"
    by_law = "" if answer.frame.law.name == BETWEEN else ", by Maugis' law"
    most = answer.ranges.at_full_hysteresis(XI)[1]
    at_most = "" if isnan(most) else f" at ξ = {span(XI, most, most)},"
    ends = f"one end is at ξ = 2 Å (one atom{by_law}), the other{at_most} where all of the work of adhesion is lost"
    text = f"how far the contact lags before it rolls was not measured for this pair: {ends}"
    return f"{text}. Limits, no error bar; give --xi{_of_measured_solid(answer)}"


def _of_measured_solid(answer: Answer) -> str:
    """Return the forces that were measured on spheres of the same solid and size with another surface energy."""
    solid, radius = solid_that_rolled(answer.frame), 2 * answer.frame["reduced_radius"]
    rolled = ROLLED.get(solid)
    if rolled is None or not rolled.has_size(radius) or "yield_force" not in answer.estimates:
        return ""
    energies = span("surface_energy", *rolled.energies)
    forces = span(rolled.name, rolled.least(radius), rolled.most(radius))
    return f". {solid} of another γ ({energies}) rolled at {forces} (scaled)"


def _adhesion_only(answer: Answer) -> str:
    text = "so small and stiff they touch and part without a jump, which loses at most JKR's energy"
    if "restitution" not in answer.values:
        return text
    least = significant(answer.values["restitution"], 2)
    return f"{text}: e is {least}–1, and any other loss lowers it"


def _law_only(answer: Answer) -> str:
    if answer.frame.missing(["tabor_parameter"]):
        return "which law holds needs Young's modulus and Poisson's ratio"
    radii = (frame.numbers("contact_radius_at_load") for frame in (answer.frame.by_law_at_spacing, answer.frame))
    other, ours = (values.get("contact_radius_at_load", 1.0) for values in radii)
    ratio = (other / ours) ** 2
    less = f", and expect less: the area of Maugis' contact is {significant(ratio, 2)} of it"
    return f"no other law here has it: take plain JKR's{less if ratio * LAW_MATTERS < 1 else ''}"


_OF_ANSWER: Mapping[int, Callable[[Answer], str]] = {
    BETTER_LAW: _better_law,
    MEASURED: _measured,
    SCALED: _scaled,
    XI_UNKNOWN: _xi_unknown,
    ADHESION_ONLY: _adhesion_only,
    LAW_ONLY: _law_only,
}


# --- Sentences that an answer begins with -----------------------------------------------------------------------------


def leads(answer: Answer) -> Iterator[Note]:
    """Iterate over sentences that answer a question: what gives way first, and whether spheres stick or bounce."""
    if "sliding_or_peeling_force" in answer.values and "yield_force" in answer.estimates:
        yield Note("lead", _first_to_give_way(answer))
    if answer.is_of_impact:
        yield Note("lead", _stick_or_bounce(answer))
    if "impact_pressure" in answer.values:
        yield Note("lead", elastic_or_not(answer.frame))
    if "tabor_parameter" in answer.question.named and "tabor_parameter" in answer.values:
        yield Note("lead", _law_that_holds(answer))


def _first_to_give_way(answer: Answer) -> str:
    frame, rolling = answer.frame, answer.estimates["yield_force"]
    force = frame["sliding_or_peeling_force"]
    first, last = ("peels off", "slides") if frame["peeling_over_sliding"] < 1 else ("slides", "peels off")
    gives = f"it {first} at {span('yield_force', force, force)}, as the push shrinks the contact, before it {last}"
    rolls = range_in_words("yield_force", rolling)
    if rolling.high < force:
        return f"pushed, it rolls first ({rolls}); held from rolling, {gives}"
    if rolling.low > force:
        return f"pushed, {gives}; to roll it takes {rolls}"
    return f"pushed, it rolls first if ξ is small ({rolls}); else {gives}"


def _stick_or_bounce(answer: Answer) -> str:
    speed = answer.frame["speed"]
    low, high, by = answer.estimates["sticking_speed"]
    sides = span("sticking_speed", low, high)
    verdict = "they stick" if speed < low else "they bounce" if speed > high else "they may stick or bounce"
    return f"at {amount('speed', speed)} {verdict}: the largest speed to stick is {sides} ({WORDS[by]})"


def _law_that_holds(answer: Answer) -> str:
    force = Ranges(Results(answer.frame, answer.frame.columns(["pull_off_force"]))).estimate("pull_off_force")
    if force.by == BETTER_LAW:
        return "Maugis' law holds here: the pull-off force of JKR is more than 5 % off"
    return "JKR holds here: Maugis' law is within 5 % of its pull-off force"
