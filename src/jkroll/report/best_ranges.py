"""Best ranges in words: their numbers, the rule that gives them, and the effects they include or leave out."""

from collections.abc import Callable, Iterable, Iterator, Mapping
from itertools import chain
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
    SEEN,
    SPACING_ASSUMED,
    WORDS,
    XI_UNKNOWN,
    Estimate,
    Ranges,
)
from ..model.frame import Frame
from ..model.limits import ROUGH_MATTERS, may_be_rough
from ..model.measured import (
    ENERGY_ON_SURFACES,
    FRACTION_HELD,
    LIKE_SIO2,
    MOST_SEEN,
    SIZES_HELD,
    SURFACES,
    has_given_energy,
    is_below_scaled,
    on_surfaces,
    solid_of_pair,
    solid_that_rolled,
    what_rolled,
    what_stuck,
)
from ..model.other_law import least_spacing
from ..quantities.formatting import (
    AS_USUAL,
    RESULT_DIGITS,
    Format,
    ShownUnit,
    amount,
    from_to,
    significant,
    span,
    symbol_among,
    with_unit,
)
from ..quantities.laws import DMT
from ..quantities.nomenclature import INFINITY, XI
from ..quantities.values import middle
from ..text import first_of
from .answer import Answer
from .inferred import lack_by_better_law

_MOST = 3  # results in a note
_SAME = 1e-12  # a range with a smaller relative width is shown as one number
_ALIKE = 0.01  # relative difference of radii below which a reason does not mention that a measurement was scaled


def lines_on_rules(rules: Iterable[int]) -> Iterator[str]:
    """Iterate over a line with the reason for each rule of a table; rules without a reason have no line."""
    for by in dict.fromkeys(rules):
        if by in _REASONS:
            yield f"{WORDS[by]}: {_REASONS[by]}"


def range_in_words(name: str, estimate: Estimate, form: Format = AS_USUAL) -> str:
    """Return a best range with its unit, for a sentence: "14–15 nN", "≥ 1.5e-18 J", or "none"."""
    low, high = estimate.low, estimate.high
    if isnan(low) and isnan(high):
        return "none"
    unit = form.common_unit(name, [high if high > 0 else low])
    sign, text = range_in_unit(estimate, unit, form)
    return sign.removeprefix("≈ ") + with_unit(text, unit.text)


def range_in_unit(estimate: Estimate, unit: ShownUnit, form: Format) -> tuple[str, str]:
    """Return the sign "≥ ", "≤ " or "≈ ", or an empty text, and the numbers of a range in a unit; "–" without ends.

    Unless the format sets the digits, a range by a rule that is only approximate has the sign "≈ ". Any other range
    with equal ends is a number with as many digits as a result.
    """
    low, high = (end if isnan(end) else unit.convert(end) for end in (estimate.low, estimate.high))
    digits = form.digits or 2
    if estimate.by in (LAW_ONLY, KELVIN) and form.digits is None:
        return "≈ ", from_to(low, high)
    if abs(high - low) <= _SAME * abs(high):
        return "", significant(low, form.digits or RESULT_DIGITS, zeros=form.digits is None and low != 0)
    if isnan(low) and isnan(high):
        return "", "–"
    if isnan(high):
        return "≥ ", significant(low, digits + 1)
    if isnan(low):
        return "≤ ", significant(high, digits)
    return "", from_to(low, high, form.digits)


def order(first: Estimate, second: Estimate) -> int:
    """Return -1 or 1 if the first range surely lies below or above the second; 0 if they may overlap."""
    if first.high < second.low:
        return -1
    return 1 if first.low > second.high else 0


def reasons_for(by: int, answer: Answer) -> Iterator[str]:
    """Iterate over the reasons for the ranges by one rule: first the line for a table, then the details."""
    if by in _REASONS_OF_ANSWER:
        yield from filter(None, _REASONS_OF_ANSWER[by](answer))
    elif by in _REASONS:
        yield _REASONS[by]


def made_of(name: str, answer: Answer) -> str:
    """Return the ranges that make up a best range, as a text: by the law in use, and by Maugis' law at each spacing.

    A pull-off force also has its value by Lennard-Jones. The text is empty for rules that compare no laws.
    """
    estimate = answer.estimates[name]
    if estimate.by not in (SCALED, XI_UNKNOWN, BETTER_LAW, LAW_IN_USE):
        return ""
    spacing = answer.frame.numbers("atomic_spacing").get("atomic_spacing", 0.0)
    laws = [answer.frame.law.short, f"Maugis at {_angstroms(spacing, spacing)}"]
    if answer.frame.assumes_spacing:
        laws.append(f"at {_angstroms(spacing / 2, spacing / 2)}")
    parts = zip(laws, answer.ranges.of_laws(name, estimate.by), strict=False)  # a given spacing repeats the last range
    texts = [f"{law} {range_in_words(name, Estimate(*ends, estimate.by), answer.form)}" for law, ends in parts]
    if name == "pull_off_force":
        for force in answer.frame.numbers("pull_off_force_lennard_jones").values():
            texts.append(f"Lennard-Jones {range_in_words(name, Estimate(force, force, estimate.by), answer.form)}")
    return "; ".join(texts)


# --- Real surfaces ----------------------------------------------------------------------------------------------------


def held_on_surfaces(answer: Answer, hold: str = "real spheres hold") -> str:
    """Return the clause on the pull-off force of real surfaces: as measured, or a guess that begins with `hold`."""
    forces = {surface: span("pull_off_force", *ends, answer.form) for surface, ends in answer.held.items()}
    if LIKE_SIO2 in forces:
        is_small = is_below_scaled(answer.frame)
        like = f"of {SIZES_HELD} (not measured at this size)" if is_small else f"({FRACTION_HELD})"
        return f"{hold} {forces[LIKE_SIO2]} if like SiO2 {like}"
    return f"real surfaces hold {', '.join(f'{force} ({surface})' for surface, force in forces.items())}"


def about_surfaces(frame: Frame) -> str:
    """Return the fractions of JKR's pull-off force that were measured, and the surfaces they belong to."""
    energy = amount("surface_energy", ENERGY_ON_SURFACES)
    if LIKE_SIO2 in on_surfaces(frame):
        return f"{FRACTION_HELD}, as SiO2 of {SIZES_HELD} held at {energy}"
    parts = "; ".join(f"{name} {surface.fraction} ({surface.spheres})" for name, surface in SURFACES.items())
    of_energy = "" if has_given_energy(frame) else f" at γ = {energy}"
    return f"fractions of JKR's force{of_energy}, scaled to {amount('radius', frame['radius'])}: {parts}"


# --- Reasons in general -----------------------------------------------------------------------------------------------

# By rule, for many rows; also for a single answer if _REASONS_OF_ANSWER has no function for the rule.
_REASONS: Mapping[int, str] = {
    MEASURED: "speeds at which SiO2 stuck, at other sizes scaled like JKR's speed",
    SEEN: f"hard spheres were seen to stick at 1 to {MOST_SEEN} times JKR's speed",
    SCALED: "from ξ or forces measured on this solid, scaled as R^(2/3) or as R",
    XI_UNKNOWN: "not measured; ξ of 2 Å (one atom) or more (--xi)",
    ADHESION_ONLY: "adhesion as the only loss; if there are others, this is a limit",
    FRICTION_ASSUMED: "from τ/3 to 3τ (--shear-strength); the contact area is JKR's",
    SPACING_ASSUMED: "from z0 = 2 Å to 4 Å; --z0 narrows it",
    BOUNDS: "JKR's force for soft spheres, DMT's for hard ones; E and ν decide",
    LAW_ONLY: "no better law gives it here",
    KELVIN: "water at 25 °C; F_men is the upper limit, between smooth bodies",
    GAP: "a gap lowers the force, to zero where water only just fills it",
    BETTER_LAW: "the better law here, over z0 = 2–4 Å unless given",
    LAW_IN_USE: "within 5 % of Maugis' law; the range covers both",
}


# --- Reasons of one answer --------------------------------------------------------------------------------------------


def _kelvin(answer: Answer) -> Iterator[str]:
    if "roughness_gap" in answer.frame.given:
        yield "water condensed at 25 °C; adsorbed water may bridge a gap earlier"
        yield "meniscus forces were measured at humidities as low as 2 %"
        return
    if "meniscus_force" not in answer.values:
        yield "water condensed at 25 °C"
        return
    yield _REASONS[KELVIN]
    yield "water changes γ, too"
    yield "roughness lowers P_c and F_men: SiO2 of 10 µm on smooth glass had 1/8–1/5 of F_men at 67 % humidity"
    yield "with --roughness 2nm, the answer has the humidity at which the gap fills"


def _friction(answer: Answer) -> Iterator[str]:
    if "sliding_or_peeling_force" in answer.estimates:
        yield "τ/3 to 3τ (--shear-strength); take T_first: the edge may peel early"
    else:
        yield _REASONS[FRICTION_ASSUMED]
    radius = answer.frame.numbers("contact_radius_at_load").get("contact_radius_at_load", 0.0)
    if radius and not answer.described.uncertainties:
        better = Ranges.of(answer.frame, "contact_radius_at_load").by_better_law("contact_radius_at_load")
        if all(end > 0 for end in better):  # nan if Maugis' law has no contact at this load
            areas = [(end / radius) ** 2 for end in better]
            yield f"Maugis' contact area is {from_to(*areas)} of JKR's"


def _better_law(answer: Answer) -> Iterator[str]:
    frame = answer.frame
    least, spacing = least_spacing(frame), frame["atomic_spacing"]
    parameter = frame.numbers("tabor_parameter").get("tabor_parameter", 0.0)  # rigid bodies have none
    where = f"at Tabor's μ = {from_to(parameter, spacing / least * parameter)}" if parameter else "for rigid bodies"
    over = f"z0 = {_angstroms(least, spacing)}{' (--z0)' if frame.assumes_spacing else ''}"
    if answer.described.uncertainties:
        over = "z0 (--z0) and the errors" if frame.assumes_spacing else "the errors"
    yield f"the better law {where}, over {over}"
    for side, of_side in _errors(answer).items():
        percent = [100 * error for error in chain.from_iterable(of_side.values())]
        symbols = ", ".join(symbol_among(name, answer.inputs) for name in of_side)
        if percent:
            yield f"{frame.law.short} is {from_to(min(percent), max(percent))} % too {side} ({symbols})"
    is_elsewhere = answer.is_in_doubt(ROUGH_MATTERS) or answer.is_on_pull_off  # in a doubt, or in rows of the table
    if "pull_off_force" in answer.estimates and may_be_rough(frame) and not is_elsewhere:
        yield f"P_c is that of smooth, dry spheres; {held_on_surfaces(answer)}"


_Errors = Mapping[str, dict[str, list[float]]]  # by side and name: relative errors at both ends of a range


def _errors(answer: Answer) -> _Errors:
    """Return the relative errors of the law in use, too high or too low, at both ends of the better law's ranges.

    The mapping is empty if a value lies inside its range, if a range has an open end, or if an input is uncertain.
    """
    if answer.described.uncertainties:
        return {}
    errors: _Errors = {"high": {}, "low": {}}
    seen = set[float]()  # equal values have one row in the table, so they count once
    for name, estimate in answer.estimates.items():
        value = answer.values.get(name, nan)
        if estimate.by != BETTER_LAW or name in answer.question.without_row or value in seen:
            continue
        seen.add(value)
        ratios = [value / end if end else nan for end in (estimate.low, estimate.high)]
        is_outside = min(ratios) >= 1 or 0 < max(ratios) <= 1
        if not is_outside or any(map(isnan, ratios)):
            return {}
        errors["high" if max(ratios) > 1 else "low"][name] = [abs(ratio - 1) for ratio in ratios]
    return errors


def _angstroms(low: float, high: float) -> str:
    return f"{from_to(low / 1e-10, high / 1e-10)} Å"


def _bounds(answer: Answer) -> Iterator[str]:
    (low, high), *_ = answer.ranges.of_laws("pull_off_force", BOUNDS)
    ratio = answer.frame["pull_off_force_dmt"] / answer.frame["pull_off_force"]
    jkr, dmt = (span("pull_off_force", factor * low, factor * high, answer.form) for factor in (1.0, ratio))
    yield f"{jkr} if soft, {dmt} if hard: give --young and --poisson"
    if answer.described.uncertainties:
        yield "the range includes the error bars"
    if not answer.is_on_pull_off:
        yield "P_c is that of smooth, dry spheres: rough ones hold less"


def _seen(_: Answer) -> Iterator[str]:
    yield _REASONS[SEEN]
    yield "silica, ices and silver were measured; adhesion is not their only loss"


def _measured(answer: Answer) -> Iterator[str]:
    stuck = what_stuck(answer.frame)
    assert stuck is not None  # the rule applies to a solid whose speeds were measured
    first, last = (significant(stuck.at(radius), 2) for radius in stuck.radii)
    small, large = (amount("radius", radius) for radius in stuck.radii)
    solid = solid_of_pair(answer.frame)
    seen = f"{first} m/s at R = {small}, {last} m/s at {large} on {solid}, ±{100 * stuck.error:.0f} %"
    if stuck.is_near(answer.frame):
        yield seen
        yield f"the spheres stuck to a plane; the speed is proportional to R^{stuck.exponent}"
        yield _above_law(answer)
        return
    yield f"from {first} m/s on {solid} of R = {small} in vacuum, by size alone: R^(-5/6)"
    yield f"{seen}; the spheres stuck to a plane; scaled to this pair like {answer.frame.law.short}'s speed"
    yield _above_law(answer)
    yield "the effect of γ was not measured"


def _above_law(answer: Answer) -> str:
    """Return the ratio of the measured speeds to the law's, as a text; empty unless all of them are larger."""
    estimate, speed = answer.estimates.get("sticking_speed"), answer.values.get("sticking_speed", INFINITY)
    if estimate is None or not estimate.low > speed:
        return ""
    times = from_to(estimate.low / speed, estimate.high / speed)
    return f"{times} times {answer.frame.law.short}'s speed, as adhesion is not the only loss"


def _scaled(answer: Answer) -> Iterator[str]:
    frame, rolled = answer.frame, what_rolled(answer.frame)
    if rolled is None:
        return
    radius, solid = 2 * frame["reduced_radius"], solid_that_rolled(frame)
    what = f"{'ξ = ' if rolled.name == XI else 'forces of '}{span(rolled.name, rolled.low, rolled.high)}"
    measured = f"{what} on {solid} of R = {amount('radius', rolled.radius)}"
    is_alike = abs(radius / rolled.radius - 1) < _ALIKE
    yield f"{measured}, as measured" if is_alike else f"from {measured}, as R^n, n = 2/3–1"
    yield f"source: {rolled.source}"
    if is_alike:
        return
    low, high = ("R", "R^(2/3)") if radius < rolled.radius else ("R^(2/3)", "R")
    ratio = significant(max(radius / rolled.radius, rolled.radius / radius), 3)
    to = f"{amount('radius', radius)}, which is {ratio} times {'smaller' if radius < rolled.radius else 'larger'}"
    yield f"scaled to {to}: the low end with {low}, the high end with {high}"
    yield _as_displacement(answer)
    yield _ceiling(answer)


def _as_displacement(answer: Answer) -> str:
    """Return the clause on the ξ that measured forces imply by the law in use; empty if that is not a range."""
    low, high = answer.ranges.of_laws(XI, SCALED)[0]
    least = ", with one atom as the least ξ" if low == answer.frame.values.get(XI) else ""
    return f"by {answer.frame.law.short} this corresponds to ξ = {span(XI, low, high)}{least}" if low < high else ""


def _ceiling(answer: Answer) -> str:
    """Return the clause on the largest force that adhesion alone can cause; empty unless the best range exceeds it."""
    _, most = answer.ranges.at_full_hysteresis("yield_force")
    best = answer.estimates.get("yield_force")
    if best is None or not best.high > most:
        return ""
    return f"the most that adhesion alone can cause is {span('yield_force', most, most, answer.form)}"


def _xi_unknown(answer: Answer) -> Iterator[str]:
    frame, rolled = answer.frame, what_rolled(answer.frame)
    if frame.missing(["hysteresis_ratio"]):
        yield "ξ of 2 Å (one atom) or more; --xi or a material narrows it"
        return
    _, most = answer.ranges.at_full_hysteresis(XI)
    limit = "the ξ" if isnan(most) else span(XI, most, most)
    limit += " (all adhesion lost), by Maugis' law"
    ends = f"ξ from 2 Å (one atom) to {limit}"
    if most < frame[XI]:
        ends = f"ξ of at most {limit}"
    lack = "not measured"
    if rolled is not None:
        lack += " at this size" if rolled.has_energy(frame) else " at this γ"
        if rolled.has_energy(frame) and any(high > most for _, high in answer.ranges.of_laws(XI, SCALED)):
            ends = f"ξ from 2 Å (one atom) to that of R = {amount('radius', rolled.radius)}, scaled"
    yield ends
    yield f"{lack}; ξ is how far the contact shifts before it rolls"
    yield _of_measured_solid(answer)


def if_silica(answer: Answer) -> str:
    """Return the sentence with the headline's ranges for SiO2, on which rolling was measured.

    The sentence is empty without a radius, or if no range is a scaled measurement.
    """
    silica = Frame(answer.frame.stated, known_materials()["quartz"])
    if not isinstance(answer.frame.given.get("radius"), float):
        return ""
    ranges = Ranges.of(silica, *silica.possible(answer.question.headline))
    scaled = []
    for name in ranges.names:
        estimate = ranges.estimate(name)
        if estimate.by == SCALED:
            scaled.append(f"{symbol_among(name, answer.inputs)} = {range_in_words(name, estimate, answer.form)}")
    return f"if it is SiO2, which was measured, {first_of(scaled, _MOST)}; else name your material" if scaled else ""


def _of_measured_solid(answer: Answer) -> str:
    """Return the sentence on forces or ξ measured on spheres of the same solid, but another size or surface energy."""
    rolled, solid = what_rolled(answer.frame), solid_that_rolled(answer.frame)
    if rolled is None:
        return ""
    radius = 2 * answer.frame["reduced_radius"]
    if rolled.has_energy(answer.frame):
        what = "ξ" if rolled.name == XI else "the forces"
        measured = f"{what} measured on {solid} at {amount('radius', rolled.radius)}"
        return f"the range also includes {measured}, scaled to {amount('radius', radius)}"
    if not rolled.has_size(radius) or "yield_force" not in answer.estimates:
        return ""
    energies = span("surface_energy", *rolled.energies)
    forces = span(rolled.name, rolled.least(radius), rolled.most(radius))
    return f"{solid} of {energies} rolled at {forces} (scaled)"


def _adhesion_only(answer: Answer) -> Iterator[str]:
    if answer.described.unknowns:
        yield "an upper limit: adhesion is assumed to cause all losses"
        return
    restitution = answer.estimates.get("restitution")
    if restitution is not None and restitution.by == ADHESION_ONLY:
        yield "other losses lower e, to 0 if the spheres stick"
    elif restitution is not None and restitution.high == 0:
        yield "at most JKR's loss to adhesion; the solids lose the rest"
    else:
        yield "at most JKR's loss to adhesion, without losses in the solids"
    if answer.ranges.has_no_jump:
        yield "spheres with so small a Tabor parameter separate without a jump, and adhesion alone may lose nothing"


def _by_dmt(answer: Answer) -> str:
    """Return the clause on inferred values by DMT's law, which needs no modulus; it may be empty."""
    texts = []
    for name, measure in answer.by_law.get(DMT, {}).items():
        value = middle(measure)
        texts.append(f"{symbol_among(name, answer.inputs)} = {span(name, value, value)}")
    return f"; by DMT's law, for hard spheres, {', '.join(texts)}" if texts else ""


def _law_only(answer: Answer) -> Iterator[str]:
    lack = lack_by_better_law(answer)
    if lack:
        yield lack
    elif answer.frame.missing(["tabor_parameter"]):
        yield f"Young's modulus and Poisson's ratio decide which law holds{_by_dmt(answer)}"
    else:
        yield _REASONS[LAW_ONLY]


_REASONS_OF_ANSWER: Mapping[int, Callable[[Answer], Iterable[str]]] = {
    BETTER_LAW: _better_law,
    KELVIN: _kelvin,
    BOUNDS: _bounds,
    MEASURED: _measured,
    SEEN: _seen,
    SCALED: _scaled,
    XI_UNKNOWN: _xi_unknown,
    FRICTION_ASSUMED: _friction,
    ADHESION_ONLY: _adhesion_only,
    LAW_ONLY: _law_only,
}
