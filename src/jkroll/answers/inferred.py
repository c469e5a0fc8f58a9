"""Sentences on inferred values: their proof, what of the materials is not used, and values by other laws."""

from collections.abc import Iterator
from contextlib import suppress
from typing import TYPE_CHECKING, Any

from ..model.frame import Frame
from ..model.limits import LAW, Doubt
from ..model.reasons import MissingInput
from ..model.uncertainty import error_bars
from ..model.unsolved import SIZES, equal, sizes_in_words
from ..quantities.formatting import amount, span, symbol_among, symbol_of
from ..quantities.laws import BETWEEN, LAWS
from ..quantities.nomenclature import NOMENCLATURE
from ..quantities.values import middle
from ..text import listed
from .notes import Note

if TYPE_CHECKING:
    from .answer import Answer

# Measured quantities that every loss moves one way, and the inputs that move them the same way as they grow.
_LOSING = frozenset({"restitution", "sticking_speed"})
_RAISING = frozenset({"surface_energy", "work_of_adhesion", "hamaker", "viscous_time"})


def by_each_law(frame: Frame) -> dict[str, dict[str, Any]]:
    """Return the unknowns, with error bars, under each other law that has the measured quantities by other formulas."""
    formulas = frame.formulas_to(*frame.unknowns)
    by_law = {}
    for law in LAWS:
        other = frame.replace(model=law)
        with suppress(MissingInput):
            if other.formulas_to(*other.unknowns) != formulas and (values := other.numbers(*other.unknowns)):
                bars = error_bars(other, values) if other.uncertainties else {}
                of_bars = {name: bar.of(values[name]) for name, bar in bars.items() if bar.sides}
                by_law[law] = {**values, **of_bars}
    return by_law


def about_limit(doubt: Doubt, answer: "Answer") -> str:
    """Return what follows from a limit: where the law is not exact, the values of the unknowns by Maugis' law."""
    symbols = {name: symbol_among(name, {*answer.inputs, *answer.assumed}) for name in answer.described.unknowns}
    unknowns = listed(symbols.values())
    if doubt.code == "rough-matters":
        return f"{unknowns}: for smooth spheres; rough ones give an effective value, of this size alone"
    if not (doubt.is_exceeded and doubt.limit is LAW):
        return doubt.text
    values = answer.by_law.get(BETWEEN, {})
    told = [f"{symbols[name]} = {span(name, middle(value), middle(value))}" for name, value in values.items()]
    if told:
        better = f"by Maugis' law, better here than {answer.frame.law.title}"
        return f"{listed(told)} {better} (Tabor parameter {doubt.value:.2g}): --model {BETWEEN}"
    if answer.described.replace(model=BETWEEN).missing(symbols):
        return doubt.text
    return f"no {unknowns} gives this by Maugis' law (Tabor parameter {doubt.value:.2g})"


def proofs(answer: "Answer") -> Iterator[Note]:
    """Iterate over what is unusual in inferred values, what of the materials is not used, and their proof."""
    if not answer.described.unknowns or not answer.values:
        return
    frame, values = answer.frame, answer.values
    forward = frame.numbers(*answer.judged)
    used = frame.data_used(frame.inputs_of(*forward))
    for name, value in values.items():
        if value and not SIZES[name][0] <= abs(value) <= SIZES[name][1]:  # a unit may be wrong
            yield Note("warning", f"{equal({name: value}, symbol_of)} is beyond usual values, {sizes_in_words([name])}")
        if name in _RAISING and not _LOSING.isdisjoint(forward):
            symbol = symbol_among(name, frame.given)
            yield Note("caveat", f"{symbol} is an upper limit: other losses of the collision are taken for it")
        replaced = "surface_energy" if name == "work_of_adhesion" else name
        for material, _ in frame.materials:
            if replaced in material.properties and (material, replaced) not in used:
                symbol = NOMENCLATURE[replaced].symbol.rstrip("1")
                yield Note("more", f"{symbol} of {material.name} is not used")
    proof = f"{equal(values, symbol_of)} {'give' if answer.condition else 'gives'} {equal(forward, symbol_of)}"
    if "surface_energy" in values and "radius2" in frame.stated and "surface_energy2" not in frame.given:
        proof += f" if γ2 = γ1, so w = {amount('work_of_adhesion', frame['work_of_adhesion'])}"
    yield Note("more", proof + (f"; κ = {answer.condition:.3g}" if answer.condition else ""))
