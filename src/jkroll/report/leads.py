"""The sentences that answer a question, with best ranges; they come before the results."""

from collections.abc import Collection, Iterator, Sequence
from math import isnan, sqrt

from ..model.estimate import (
    ADHESION_ONLY,
    BETTER_LAW,
    FRICTION_ASSUMED,
    LAW_IN_USE,
    MEASURED,
    NONE,
    SCALED,
    WORDS,
    XI_UNKNOWN,
    Estimate,
    Ranges,
)
from ..model.frame import ROLLING_ONSET, Frame
from ..model.limits import FLIES_OFF, GAP_STAYS_DRY, ROUGH_MATTERS, may_be_rough
from ..model.measured import FRACTION_HELD, SIZES_HELD, has_given_energy, what_rolled, what_stuck
from ..physics.elementary import is_anywhere
from ..quantities.formatting import Format, amount, from_to, significant, symbol_among, with_unit
from ..quantities.nomenclature import XI
from ..quantities.values import Interval, Measured, ends_of
from ..text import listed
from .answer import Answer
from .best_ranges import held_on_surfaces, if_silica, order, range_in_words
from .inferred import about_library
from .notes import Note, Noted

_THREE = Format(digits=3)
_FORCE_AND_MOMENT = ("pull_off_force", "yield_moment")
_PRESSURES = ("impact_pressure", "hertz_pressure", "touch_pressure", "first_yield_pressure", "plastic_pressure")
_ONE = Estimate(1.0, 1.0, NONE)
_LIMIT_OF_WATER = "is the upper limit with a meniscus; do not add it to P_c"
_WIDE = 2  # ranges whose ends differ by at least this factor are followed by a single number


def leads(answer: Answer) -> Iterator[Note]:
    """Iterate over the sentences that answer the question of a command."""
    if answer.described.unknowns and answer.values:
        yield from [*about_library(answer)] or [Note("lead", _what_it_means(answer))]
    yield from _pulled_apart(answer)
    if "sliding_or_peeling_force" in answer.values and "yield_force" in answer.estimates:
        yield Note("lead", _first_to_give_way(answer))
    if answer.is_of_impact and answer.estimates["sticking_speed"].by != NONE:
        yield Note("lead", _stick_or_bounce(answer))
    if answer.question.headline == ("n_roll",) and not answer.is_in_doubt(FLIES_OFF):
        yield from _enough_to_roll(answer.frame, answer.form)
    if "impact_pressure" in answer.values:
        is_known = not answer.frame.missing(["first_yield_pressure"])
        yield Note("lead" if is_known else "more", _elastic_or_not(answer))
    answers = [*filter(None, (_completed(sentence, answer) for sentence in answer.question.leads))]
    yield from (Note("lead", lead) for lead in answers)
    if answers and _is_from_forces(answer):
        yield Note("lead", "this range comes from measured rolling forces, not from your γ or the assumed ξ")
    if XI_UNKNOWN in answer.rules and answer.frame.missing(["work_of_adhesion"]):
        sentence = if_silica(answer)
        if sentence:
            yield Note("lead", sentence)
    is_asked = "tabor_parameter" in answer.question.named and answer.frame.stated_model is None
    if is_asked and "tabor_parameter" in answer.values:
        yield from _law_that_holds(answer)


def lead_of_rows(groups: Sequence[Noted], names: Collection[str]) -> str:
    """Return the sentence on roughness and water, which the pull-off force of rows leaves out; it may be empty."""
    if "pull_off_force" not in names:
        return ""
    sentences = []
    is_wet = "meniscus_force" in names
    if any(is_anywhere(may_be_rough(frame)) for frame, _ in groups):
        sentences.append(f"real spheres hold {FRACTION_HELD}: measured on SiO2 of {SIZES_HELD}, a guess for others")
        kind = "ideally smooth, dry spheres" if is_wet else "ideally smooth spheres"
        sentences.append(f"P_c below is the upper limit, for {kind}")
    if is_wet:
        sentences.append(f"F_men {_LIMIT_OF_WATER}")
    return "; ".join(sentences)


def advice_on_inputs(answer: Answer) -> Iterator[str]:
    """Iterate over lines on the γ and ξ for which the law gives the middle of the best ranges of P_c and M, if any."""
    options = _options_for_middle(answer)
    if not options:
        return
    texts = []
    for name in _FORCE_AND_MOMENT:
        best = answer.estimates[name]
        unit = _THREE.common_unit(name, [best.high])
        value = with_unit(_THREE.in_unit(answer.frame[name], unit), unit.text)
        texts.append(f"{symbol_among(name, answer.inputs)} = {value} (best {range_in_words(name, best)})")
    law = answer.frame.law.short
    yield f"Plain {law}: {listed(texts)}."
    yield "To simulate the middle of both ranges, run the command again with"
    yield f"  {options} for smooth spheres"
    if answer.is_in_doubt(ROUGH_MATTERS):
        yield f"  {_options_for_middle(answer, 0.1)} for rough ones (a tenth of P_c, the same M)"
    yield "These are fitted to P_c and M, and are no properties of the solid."


def _options_for_middle(answer: Answer, fraction: float = 1.0) -> str:
    """Return the options that make the law give the middle of the best ranges of P_c and M; empty if none do.

    `fraction`: the fraction of P_c that the spheres hold, with the same M. For identical spheres P_c is proportional to
    γ, and the moment M that starts rolling is proportional to γξ.
    """
    frame = answer.frame
    found = [answer.estimates[name] for name in _FORCE_AND_MOMENT if name in answer.estimates]
    middles = [sqrt(estimate.low * estimate.high) for estimate in found]  # nan where an end is open
    # If the user chose the law, w, ξ or an input that sets ξ, no other γ and ξ are proposed.
    is_chosen = frame.stated_model or not frame.given.keys().isdisjoint({"work_of_adhesion", *ROLLING_ONSET})
    is_known = len(middles) == len(_FORCE_AND_MOMENT) and not any(map(isnan, middles))
    if not is_known or is_chosen or not frame.is_identical or frame["load"]:
        return ""
    force, moment = middles
    energy = fraction * frame["work_of_adhesion"] / 2 * force / frame["pull_off_force"]
    displacement = frame[XI] * moment / frame.replace(surface_energy=energy)["yield_moment"]
    options = (("--gamma", "surface_energy", energy), ("--xi", XI, displacement))
    return " ".join(f"{option} {amount(name, value, _THREE).replace(' ', '')}" for option, name, value in options)


def _what_it_means(answer: Answer) -> str:
    """Return the sentence on inferred values: best ranges, or values with uncertainties by the law in use.

    A value within 5 % of that by Maugis' law is a range, too, if another value is and if no uncertainty is known.
    """
    texts = []
    for result in answer.results:
        if result.name not in answer.described.unknowns:
            continue
        estimate, symbol = answer.estimates[result.name], symbol_among(result.name, answer.inputs)
        is_range = estimate.by in (BETTER_LAW, ADHESION_ONLY) or isinstance(result.measure, Interval)
        is_hull = estimate.by == LAW_IN_USE and BETTER_LAW in answer.rules and not isinstance(result.measure, Measured)
        if is_range or is_hull:
            text = range_in_words(result.name, estimate, answer.form)
            texts.append(f"{symbol} {text}" if text.startswith("≤") else f"{symbol} = {text}")
        else:
            texts.append(f"{symbol} = {amount(result.name, result.measure or 0.0, answer.form.with_digits(4))}")
    frame = answer.described
    is_of_both = "surface_energy" in frame.unknowns and frame.material2 is None and "surface_energy2" not in frame.given
    of_both = "; w = 2γ" if is_of_both else ""
    has_error = not frame.uncertain.keys().isdisjoint(frame.judged(frame.unknowns))
    error = "" if has_error else "; give the measured value with its error, such as 3.0±0.2"
    return f"the measurement implies {listed(texts)}{of_both}{error}"


def _pulled_apart(answer: Answer) -> Iterator[Note]:
    """Iterate over at most one sentence: the pull-off force of real surfaces, and that of smooth ones as its limit.

    In humid air the sentence also has the force of a meniscus as a second limit, or the humidity that fills a gap.
    Without water, only an answer on the pull-off force alone has the sentence.
    """
    dry, wet = (answer.estimates.get(name) for name in ("pull_off_force", "meniscus_force"))
    stays_dry = answer.is_in_doubt(GAP_STAYS_DRY)
    if dry is None or dry.by == NONE or not (answer.is_on_pull_off or stays_dry or wet):
        return
    smooth = f"ideally smooth spheres hold {range_in_words('pull_off_force', dry, answer.form)}"
    fills = _filled_gap(answer.frame)
    held = held_on_surfaces(answer) if answer.shows_surfaces else ""
    if stays_dry:
        fills, limit = f"the dry contact alone pulls: {fills}", f"{smooth}, the upper limit"
    elif wet:
        most = range_in_words("meniscus_force", wet._replace(low=wet.high), answer.form)
        limit = f"{smooth} dry; F_men, {most}, {_LIMIT_OF_WATER}"
    else:
        limit = f"{smooth}, the upper limit"
    yield Note("lead", "; ".join(filter(None, [fills, held, limit])))


def _completed(sentence: str, answer: Answer) -> str:
    """Return a sentence of the question with the best ranges in place of names; empty if a range is missing."""
    found = {name: estimate for name, estimate in answer.estimates.items() if estimate.by != NONE}
    words = {name: _as_shown(name, answer) for name in found}
    if "{or_none}" in sentence:  # the sentence can say "none", but is left out if no result has a meaning
        if answer.ended.keys() >= answer.computed.keys():
            return ""
        words |= dict.fromkeys(answer.ended, "none")
    (first, *others) = answer.question.headline
    for name, estimate in found.items():
        if answer.shows_ranges:
            words[name] += _middle(name, estimate, answer.form, is_short=bool(others) or name != first)
    for name in {*answer.question.headline}.difference(answer.question.taken(words)):  # better ones replace these
        words.pop(name, None)
    is_open = any(isnan(found[name].low) for name in answer.question.headline if name in found)
    is_rough = answer.shows_surfaces and "pull_off_force" in found
    words["real"] = f"; {held_on_surfaces(answer)}" if is_rough else ""
    words["if_smooth"] = " if the grains are smooth, less if they are rough" if may_be_rough(answer.frame) else ""
    words["or_none"] = ", or not at all" if is_open else ""
    try:
        return sentence.format_map(words)
    except KeyError:
        return ""


def _is_from_forces(answer: Answer) -> bool:
    """Return whether the headline comes from measured rolling forces alone although a surface energy was given.

    R_min does not count: it follows from ξ, which is a measured force divided by the surface energy.
    """
    rolled = what_rolled(answer.frame)
    if rolled is None or rolled.name == XI or not has_given_energy(answer.frame) or "r_min" in answer.question.headline:
        return False
    return {answer.estimates[name].by for name in answer.question.headline if name in answer.estimates} == {SCALED}


def _as_shown(name: str, answer: Answer) -> str:
    """Return a result as the table shows it: its best range, or its value with the uncertainty if that suffices."""
    measure = answer.result(name).measure
    if answer.shows_ranges or measure is None:
        return _spoken(name, answer.estimates[name], answer.form)
    if isinstance(measure, Measured):
        return amount(name, measure, answer.form)
    return range_in_words(name, Estimate(*ends_of(measure), LAW_IN_USE), answer.form)


def _spoken(name: str, estimate: Estimate, form: Format) -> str:
    """Return a best range in words, an open one as "at most 50 µm"."""
    return range_in_words(name, estimate, form).replace("≥", "at least").replace("≤", "at most")


def _middle(name: str, estimate: Estimate, form: Format, *, is_short: bool) -> str:
    """Return a single number for a wide range, with its largest error unless `is_short`; empty for other ranges."""
    low, high = estimate.low, estimate.high
    if not low > 0 or not high >= _WIDE * low:
        return ""
    text = f"say {amount(name, sqrt(low * high), Format(form.units, 2))}"
    return f" ({text})" if is_short else f" ({text}, within a factor of {significant(sqrt(high / low), 2)})"


def _first_to_give_way(answer: Answer) -> str:
    rolling, sliding = (answer.estimates[name] for name in ("yield_force", "sliding_or_peeling_force"))
    force = range_in_words("yield_force", sliding, answer.form)
    gives = f"{_slides_or_peels(answer)} at {force}"
    if rolling.by == NONE:
        return f"if a pushed sphere cannot roll, {gives}"
    rolls = range_in_words("yield_force", rolling, answer.form)
    first = order(rolling, sliding)
    if first < 0:
        rolls += _middle("yield_force", rolling, answer.form, is_short=True)
        return f"a pushed sphere rolls first, at {rolls}; if it cannot roll, {gives}"
    if first > 0:
        return f"a pushed sphere does not roll, since {gives}; rolling would take {rolls}"
    assumed = {"ξ": rolling.by in (XI_UNKNOWN, SCALED), "τ": sliding.by == FRICTION_ASSUMED}
    decides = [symbol for symbol, is_assumed in assumed.items() if is_assumed]
    if not decides:
        return f"a pushed sphere may roll first, at {rolls}, or not: {gives}"
    return f"whether a pushed sphere rolls first ({rolls}) depends on {listed(decides)}; if it does not, {gives}"


def _filled_gap(frame: Frame) -> str:
    """Return the sentence on the humidity above which water fills the gap of rough surfaces; empty without a gap."""
    known = frame.numbers("roughness_gap", "threshold_humidity")
    if len(known) < 2:
        return ""
    threshold = significant(100 * known["threshold_humidity"], 2)
    return f"water fills the gap of {amount('roughness_gap', known['roughness_gap'])} only above {threshold} % humidity"


def _slides_or_peels(answer: Answer) -> str:
    """Return whether a pushed contact slides or peels off if it cannot roll, as far as its friction is known.

    Under a pressing load, the contact remains after its adhesion has peeled off.
    """
    ratio = _estimate(answer.frame, "peeling_over_sliding")
    peels = "its adhesion alone peels off" if answer.frame["load"] > 0 else "it peels off"
    either = "it slides, or its adhesion alone peels off," if answer.frame["load"] > 0 else "it slides or peels off"
    return {-1: peels, 0: either, 1: "it slides"}[order(ratio, _ONE)]


def _stick_or_bounce(answer: Answer) -> str:
    sticking = answer.estimates["sticking_speed"]
    limit = _as_shown("sticking_speed", answer)
    above = order(_estimate(answer.frame, "speed"), sticking)
    verdict = {-1: "stick", 0: "may stick or bounce", 1: "bounce"}[above]
    speed = amount("speed", answer.input_measures.get("speed", answer.frame["speed"]))
    stuck = what_stuck(answer.frame)
    is_scaled = stuck is not None and stuck.can_be_scaled(answer.frame) and not stuck.is_near(answer.frame)
    source = "scaled from measured speeds" if is_scaled and sticking.by == MEASURED else WORDS[sticking.by]
    text = f"at {speed} the spheres {verdict}: the sticking speed is {limit} ({source})"
    best, by_law = answer.estimates["restitution"], answer.values["restitution"]
    if above < 0 and by_law > 0:
        return f"{text}; without losses in the solids they would bounce (e = {significant(by_law, 2)})"
    if above < 0 or isnan(best.high) or best.by != ADHESION_ONLY:
        return text
    condition = "" if above > 0 else "if they bounce, "
    return f"{text}; {condition}adhesion alone leaves e = {from_to(by_law, best.high)}"


def _enough_to_roll(frame: Frame, form: Format) -> Iterator[Note]:
    """Iterate over at most one sentence: whether the energy of a sphere is enough to begin rolling."""
    if frame.missing(["energy"]) or not frame.possible(["yield_energy"]):
        return
    energy, least = _estimate(frame, "energy"), _estimate(frame, "yield_energy")
    if least.by == NONE or isnan(least.low):
        return
    verdict = {-1: "does not roll", 0: "may or may not roll", 1: "rolls"}[order(energy, least)]
    has, needs = range_in_words("energy", energy, form), _spoken("yield_energy", least, form)
    needs += _middle("yield_energy", least, form, is_short=True)
    yield Note("lead", f"the sphere {verdict}: it has {has}, and to begin rolling it needs {needs}")


def _law_that_holds(answer: Answer) -> Iterator[Note]:
    """Iterate over at most one sentence: the law that holds for the pull-off force, if this force has a meaning."""
    force = _estimate(answer.frame, "pull_off_force")
    if force.by == BETTER_LAW:
        yield Note("lead", "Maugis' law holds here: the pull-off force of JKR is more than 5 % off")
    if force.by == LAW_IN_USE:
        yield Note("lead", "JKR holds here: Maugis' law is within 5 % of its pull-off force")


def _estimate(frame: Frame, name: str) -> Estimate:
    """Return the best range of a quantity or of an input."""
    return Ranges.of(frame, name).estimate(name)


def _elastic_or_not(answer: Answer) -> str:
    """Return the sentence on whether an impact stays elastic; without a yield strength, on its pressures alone."""
    found = {name: _estimate(answer.frame, name) for name in answer.frame.possible(_PRESSURES)}
    found.update(answer.estimates)
    words = {name: range_in_words(name, found[name], answer.form) for name in _PRESSURES if name in found}
    peak = words["impact_pressure"]
    if "first_yield_pressure" not in found:
        at_rest = f"its peak pressure (at rest: {words['hertz_pressure']})"
        return f"the impact is elastic if the solids bear {peak}, {at_rest}; --yield-strength decides"
    first, full = found["first_yield_pressure"], found["plastic_pressure"]
    limits = (
        f"the peak pressure is {peak}; yielding starts below the surface at {words['first_yield_pressure']}, and is "
        f"complete at {words['plastic_pressure']}"
    )
    order_to_first = order(found["impact_pressure"], first)
    if order_to_first < 0:
        return f"the impact stays elastic: {limits}"
    if order_to_first == 0:
        return f"the spheres may or may not yield; if they do, e is an upper bound: {limits}"
    how = {-1: "below the surface", 0: "below the surface or fully", 1: "fully"}[order(found["impact_pressure"], full)]
    at_rest = ", even if they touch at zero speed" if order(found["touch_pressure"], first) > 0 else ""
    return f"the spheres yield {how}{at_rest}, so e is an upper bound: {limits}"
