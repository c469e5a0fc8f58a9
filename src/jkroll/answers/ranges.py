"""The words for best ranges: by which rule each stands, in a line, and what it holds and leaves out."""

from collections.abc import Callable, Iterator, Mapping
from math import isnan
from typing import TYPE_CHECKING

from ..model.estimate import (
    ADHESION_ONLY,
    AT_LEAST,
    BETTER_LAW,
    LAW_ONLY,
    SCALED,
    WORDS,
    XI_UNKNOWN,
    Estimate,
)
from ..model.limits import JUMP
from ..model.measured import ROLLED, solid_that_rolled
from ..quantities.formatting import amount, significant, span, symbol_among
from ..quantities.nomenclature import XI
from ..text import first_of
from .inferred import lack_by_better_law
from .notes import Note

if TYPE_CHECKING:
    from .answer import Answer

_MOST = 3  # results in a note


def lines_on_ranges(answer: "Answer") -> Iterator[str]:
    """Iterate over a line for each rule by which results have a range, in the order of the results."""
    for by in dict.fromkeys(estimate.by for estimate in answer.estimates.values()):
        if text := why(by, answer):
            yield f"{WORDS[by]}: {text}"


def notes_on_ranges(answer: "Answer") -> Iterator[Note]:
    """Iterate over a note for each rule by which results of the headline have a range, where no table shows it."""
    texts: dict[int, list[str]] = {}
    for name, estimate in answer.estimates.items():
        if name in answer.question.headline and why(estimate.by, answer):
            symbol = symbol_among(name, answer.inputs)
            texts.setdefault(estimate.by, []).append(f"{symbol} {_equal(range_in_words(name, estimate))}")
    for by, of_rule in texts.items():
        yield Note("caveat", f"best range: {first_of(of_rule, _MOST)} ({WORDS[by]}: {why(by, answer)})")


def _equal(text: str) -> str:
    return text if text[0] in "≤≥" else "has none" if text == "–" else f"= {text}"


def range_in_words(name: str, estimate: Estimate) -> str:
    """Return a best range with its unit: "14–15 nN", "≥ 1.5e-18 J", or "–" for none."""
    low, high = estimate.low, estimate.high
    if isnan(low) and isnan(high):
        return "–"
    if isnan(low) or isnan(high):
        end = low if isnan(high) else high
        return f"{'≥' if isnan(high) else '≤'} {span(name, end, end)}"
    return span(name, low, high)


def why(by: int, answer: "Answer") -> str:
    """Return why results have a range by a rule, what it holds and leaves out; empty for the law in use."""
    if by == LAW_ONLY and (lack := lack_by_better_law(answer)):
        return lack
    return _WORDS[by](answer) if by in _WORDS else ""


def _better_law(answer: "Answer") -> str:
    frame = answer.frame
    parameter, spacing = frame["tabor_parameter"], frame["atomic_spacing"]
    tabor = f"Tabor parameter {significant(parameter, 2)}–{significant(2 * parameter, 2)}, JKR needs 5"
    spacings = f"atomic spacing {span('atomic_spacing', spacing / 2, spacing)} (--z0)"
    force = "; P_c up to Lennard-Jones' law, of smooth and dry spheres" if "pull_off_force" in answer.estimates else ""
    return f"the law for this size and stiffness ({tabor}), {spacings}{force}"


def _scaled(answer: "Answer") -> str:
    frame = answer.frame
    solid = solid_that_rolled(frame)
    rolled, radius = ROLLED[solid], 2 * frame["reduced_radius"]
    measured = span(rolled.name, rolled.low, rolled.high)
    at = amount("radius", rolled.radius)
    if abs(radius / rolled.radius - 1) < 0.2:
        return f"{measured} rolled {solid} of R = {at}"
    low, high = ("R", "R^(2/3)") if radius < rolled.radius else ("R^(2/3)", "R")
    what = f"ξ of {solid} was {measured}" if rolled.name == XI else f"{measured} rolled {solid}"
    text = f"{what} at R = {at}, taken as {low} (low) or {high} (high) to {amount('radius', radius)}"
    return text + _ceiling(answer)


def _ceiling(answer: "Answer") -> str:
    """Return what adhesion supplies at most, if forces that were measured mean more."""
    ceiling = answer.ranges.at_full_hysteresis("yield_force")
    found = answer.estimates.get("yield_force")
    if found is None or not found.high > ceiling[1]:
        return ""
    return f". Adhesion supplies {span('yield_force', *ceiling)} at most; above it another loss supplies the rest"


def _xi_unknown(_: "Answer") -> str:
    text = "limits, no error bar: from one atom (2 Å, by Maugis' law) to all of w lost in opening and closing"
    return f"{text}; measure it or give --xi"


def _adhesion_only(answer: "Answer") -> str:
    speed = answer.frame.numbers("sticking_speed").get("sticking_speed")
    seen = f", here {span('sticking_speed', speed, 10 * speed)}" if speed else ""
    return (
        "it does no more; so small and stiff they touch and part without a jump. Other losses lower e; solids were "
        f"seen to stick at 1–10 times JKR's v_stick{seen}"
    )


def _at_least(_: "Answer") -> str:
    return f"Lennard-Jones' law binds more than JKR's where contacts form without a jump (Tabor parameter below {JUMP})"


_WORDS: Mapping[int, Callable[["Answer"], str]] = {
    BETTER_LAW: _better_law,
    SCALED: _scaled,
    XI_UNKNOWN: _xi_unknown,
    ADHESION_ONLY: _adhesion_only,
    AT_LEAST: _at_least,
}
