"""Sentences about inferred values: by each law, and compared with the materials."""

from collections.abc import Iterator, Mapping
from math import log

from ..model.estimate import ADHESION_ONLY, BETTER_LAW, LAW_ONLY
from ..model.frame import Frame
from ..model.limits import ROUGH_MATTERS, Doubt
from ..model.reasons import explanation_of
from ..model.unknowns import SIZES, equations, sizes_in_words
from ..quantities.formatting import Format, amount, from_to, symbol_among, symbol_of
from ..quantities.laws import BETWEEN
from ..quantities.nomenclature import INFINITY, NOMENCLATURE, PROPERTIES
from ..quantities.values import Uncertain, middle
from ..text import listed
from .answer import Answer
from .notes import Note

# By property: the factor between the inferred value and the library's from which a note reports them, and the remark
# in this note.
_FAR = {
    **dict.fromkeys(
        ("surface_energy", "work_of_adhesion"),
        (5.0, "probably rough or wet surfaces, for which it is an effective value;"),
    ),
    "youngs_modulus": (2.0, "probably not the contact of one smooth sphere, so take none of these;"),
}


# --- By each law ------------------------------------------------------------------------------------------------------


def laws_of(answer: Answer) -> list[str]:
    """Return the laws with rows of inferred values: Maugis', if it is better or gives no value, and the law in use."""
    in_use = answer.frame.law.name
    if BETTER_LAW in answer.rules or lack_by_better_law(answer):
        return [BETWEEN, in_use]
    return [in_use]


def lack_by_better_law(answer: Answer) -> str:
    """Return the reason why Maugis' law gives no inferred value; empty if it gives one, or if an input is missing."""
    if not answer.described.unknowns or LAW_ONLY not in answer.rules:
        return ""
    other = answer.described.by_law_at_spacing
    if other.missing(other.unknowns) or other.solution.failure is None:
        return ""
    return f"by Maugis' law {explanation_of(','.join(other.unknowns), other.solution.failure)}"


# --- Comparison with the library --------------------------------------------------------------------------------------


def solids_of(frame: Frame, name: str) -> list[str]:
    """Return the names of the solids that an inferred value describes: that of sphere 1, or of both for w of a pair."""
    solids = [solid.name for solid, _ in frame.materials]
    if name in PROPERTIES:
        return solids[:1]
    return [*dict.fromkeys(solids)]


def library_values(frame: Frame) -> Mapping[str, float | Uncertain]:
    """Return the library's values of the unknown properties, with their uncertainties."""
    of_library = Frame({}, frame.material, frame.material2)
    properties = [name for name in frame.unknowns if name in PROPERTIES or name in _FAR]
    numbers = of_library.numbers(*properties)
    return {name: of_library.uncertainties.get(name, number) for name, number in numbers.items()}


def about_library(answer: Answer) -> Iterator[Note]:
    """Iterate over notes on inferred values that are far from the library's."""
    by_maugis = BETWEEN in laws_of(answer)
    for name, usual in library_values(answer.described).items():
        if name not in answer.values:
            continue
        ends = [answer.values[name]]
        if by_maugis:
            positive = [end for end in answer.ranges.by_better_law(name) if end > 0]  # nan if the law has no value
            if positive:
                ends = positive
        factors = sorted((end / middle(usual) for end in ends), key=_distance)
        nearest, farthest = factors[0], factors[-1]
        if answer.estimates[name].by == ADHESION_ONLY and nearest > 1:  # other losses probably make the value large
            continue
        limit, remark = _FAR.get(name, (INFINITY, ""))
        if 1 / limit <= nearest <= limit:
            continue
        sizes = from_to(max(nearest, 1 / nearest), max(farthest, 1 / farthest))
        times = f"{sizes} times" if nearest > 1 else f"1/{sizes.replace('–', ' to 1/')} of"
        whose = f"{listed(solids_of(answer.described, name))}'s ({amount(name, usual, Format(digits=3))})"
        symbol = symbol_among(name, answer.inputs)
        yield Note("lead", f"{symbol} is {times} {whose}: {remark} see jkroll guide measurements")


def _distance(factor: float) -> float:
    """Return the distance of a factor from 1, on a logarithmic scale."""
    return abs(log(factor))


# --- Sentences --------------------------------------------------------------------------------------------------------


def about_limit(doubt: Doubt, answer: Answer) -> str:
    """Return the sentence on a limit: its consequence for inferred values."""
    if doubt.code != ROUGH_MATTERS:
        return doubt.text
    shown = {*answer.inputs, *answer.assumed}
    symbols = [symbol_among(name, shown) for name in answer.described.unknowns]
    return f"{listed(symbols)}: for smooth spheres; rough ones give an effective value, for this size alone"


def about_inferred(answer: Answer) -> Iterator[Note]:
    """Iterate over notes: unusual inferred values, unused data of materials, and the results that the values give."""
    if not answer.described.unknowns or not answer.values:
        return
    frame, values = answer.frame, answer.values
    forward = frame.numbers(*answer.judged)
    used = frame.data_used(frame.inputs_of(*forward))
    for name, value in values.items():
        if value and not SIZES[name][0] <= abs(value) <= SIZES[name][1]:  # a unit may be wrong
            yield Note(
                "warning", f"{equations({name: value}, symbol_of)} is beyond usual values, {sizes_in_words([name])}"
            )
        replaced = "surface_energy" if name == "work_of_adhesion" else name
        for material, _ in frame.materials:
            if replaced in material.properties and (material, replaced) not in used:
                symbol = NOMENCLATURE[replaced].symbol.rstrip("1")
                yield Note("more", f"{symbol} of {material.name} is not used")
    verb = "give" if answer.condition else "gives"
    check = f"{equations(values, symbol_of)} {verb} {equations(forward, symbol_of)}"
    if "surface_energy" in values and "radius2" in frame.stated and "surface_energy2" not in frame.given:
        check += f" if γ2 = γ1, so w = {amount('work_of_adhesion', frame['work_of_adhesion'])}"
    if answer.condition:
        check += f"; κ = {answer.condition:.3g}"
    yield Note("more", check)
