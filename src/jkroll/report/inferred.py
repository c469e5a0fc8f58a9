"""Sentences about inferred values: by each law, and compared with the materials."""

from collections.abc import Iterator, Mapping
from math import log

from ..model.estimate import BETTER_LAW, LAW_ONLY
from ..model.frame import Frame
from ..model.limits import ROUGH_MATTERS, Doubt
from ..model.reasons import explanation_of
from ..model.unsolved import SIZES, equal, sizes_in_words
from ..quantities.formatting import Format, amount, from_to, symbol_among, symbol_of
from ..quantities.laws import BETWEEN
from ..quantities.nomenclature import INFINITY, NOMENCLATURE, PROPERTIES
from ..quantities.values import Uncertain, middle
from ..text import listed
from .answer import Answer
from .notes import Note

# The factor between an inferred value and the library's above which a note reports it, and the question it asks.
_FAR = {
    **dict.fromkeys(("surface_energy", "work_of_adhesion"), (5.0, "probably rough or wet surfaces;")),
    "youngs_modulus": (2.0, "probably not the contact of one smooth sphere;"),
}


# --- By each law ------------------------------------------------------------------------------------------------------


def laws_of(answer: Answer) -> list[str]:
    """Return the laws for which inferred values are shown: first the one that holds, then the one in use."""
    own = answer.frame.law.name
    is_moved = any(estimate.by == BETTER_LAW for estimate in answer.estimates.values())
    return [BETWEEN, own] if is_moved or lack_by_better_law(answer) else [own]


def lack_by_better_law(answer: Answer) -> str:
    """Return why Maugis' law gives no value where the law in use does; empty if it does, or if an input is missing."""
    if not answer.described.unknowns or all(estimate.by != LAW_ONLY for estimate in answer.estimates.values()):
        return ""
    other = answer.described.by_law_at_spacing
    if other.missing(other.unknowns) or other.solution.failure is None:
        return ""
    return f"by Maugis' law {explanation_of(','.join(other.unknowns), other.solution.failure)}"


# --- Comparison with the library --------------------------------------------------------------------------------------


def solids_of(frame: Frame, name: str) -> list[str]:
    """Return the names of the solids that an inferred property describes: sphere 1, or both for work of adhesion."""
    solids = [solid.name for solid, _ in frame.materials]
    return solids[:1] if name in PROPERTIES else [*dict.fromkeys(solids)]


def library_values(frame: Frame) -> Mapping[str, float | Uncertain]:
    """Return the library's values of the unknown properties, with their uncertainties."""
    alone = Frame({}, frame.material, frame.material2)
    numbers = alone.numbers(*(name for name in frame.unknowns if name in (*PROPERTIES, *_FAR)))
    return {name: alone.uncertainties.get(name, number) for name, number in numbers.items()}


def _about_library(answer: Answer) -> Iterator[Note]:
    """Iterate over notes on inferred properties that are far from those of the materials."""
    for name, usual in library_values(answer.described).items():
        better = answer.ranges.by_better_law(name) if BETWEEN in laws_of(answer) else ()
        ends = [end for end in better if end > 0] or [answer.values[name]]  # nan where that law has no value
        factors = sorted((end / middle(usual) for end in ends), key=lambda factor: abs(log(factor)))
        far, question = _FAR.get(name, (INFINITY, ""))
        if not 1 / far <= factors[0] <= far:
            sizes = from_to(*(max(factor, 1 / factor) for factor in (factors[0], factors[-1])))
            times = f"{sizes} times" if factors[0] > 1 else f"1/{sizes.replace('–', ' to 1/')} of"
            whose = f"{listed(solids_of(answer.described, name))}'s ({amount(name, usual, Format(digits=3))})"
            symbol = symbol_among(name, answer.inputs)
            yield Note("lead", f"{symbol} is {times} {whose}: {question} jkroll guide measurements")


# --- Sentences --------------------------------------------------------------------------------------------------------


def about_limit(doubt: Doubt, answer: Answer) -> str:
    """Return what a limit means for the unknowns."""
    if doubt.code == ROUGH_MATTERS:
        unknowns = listed(symbol_among(name, {*answer.inputs, *answer.assumed}) for name in answer.described.unknowns)
        return f"{unknowns}: for smooth spheres; rough ones give an effective value, of this size alone"
    return doubt.text


def proofs(answer: Answer) -> Iterator[Note]:
    """Iterate over notes on inferred values: unusual sizes, unused properties of materials, and the check forwards."""
    if not answer.described.unknowns or not answer.values:
        return
    frame, values = answer.frame, answer.values
    forward = frame.numbers(*answer.judged)
    used = frame.data_used(frame.inputs_of(*forward))
    for name, value in values.items():
        if value and not SIZES[name][0] <= abs(value) <= SIZES[name][1]:  # a unit may be wrong
            yield Note("warning", f"{equal({name: value}, symbol_of)} is beyond usual values, {sizes_in_words([name])}")
        replaced = "surface_energy" if name == "work_of_adhesion" else name
        for material, _ in frame.materials:
            if replaced in material.properties and (material, replaced) not in used:
                symbol = NOMENCLATURE[replaced].symbol.rstrip("1")
                yield Note("more", f"{symbol} of {material.name} is not used")
    yield from _about_library(answer)
    proof = f"{equal(values, symbol_of)} {'give' if answer.condition else 'gives'} {equal(forward, symbol_of)}"
    if "surface_energy" in values and "radius2" in frame.stated and "surface_energy2" not in frame.given:
        proof += f" if γ2 = γ1, so w = {amount('work_of_adhesion', frame['work_of_adhesion'])}"
    yield Note("more", proof + (f"; κ = {answer.condition:.3g}" if answer.condition else ""))
