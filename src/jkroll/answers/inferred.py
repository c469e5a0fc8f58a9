"""The answers of `infer`: the values of inputs that measured quantities imply, with what they rest on."""

from collections.abc import Iterator, Mapping
from contextlib import suppress
from copy import copy
from functools import cached_property
from math import isfinite
from typing import Any

from ..model.infer import Found
from ..model.inverse import Problem
from ..model.limits import LAW, Doubt
from ..model.reasons import MissingInput
from ..model.results import Results
from ..model.uncertainty import error_bars
from ..model.unsolved import SIZES, equal, sizes_in_words
from ..quantities.formatting import amount, in_words, span, symbol_among, symbol_of
from ..quantities.laws import BETWEEN, LAWS
from ..quantities.nomenclature import NOMENCLATURE
from ..quantities.values import middle
from ..text import listed
from .answer import Answer, Result, without_value
from .notes import Note
from .questions import Question

# Measured quantities that every loss moves one way, and the inputs that move them the same way as they grow.
_LOSING = frozenset({"restitution", "sticking_speed"})
_RAISING = frozenset({"surface_energy", "work_of_adhesion", "hamaker", "viscous_time"})


class Inferred(Answer):
    """The answer about what was measured, with the values of the unknowns as its results."""

    laws: Mapping[str, Any] = {}  # what is found under each law stands beside the results

    def __init__(self, problem: Problem, *, keeps_all: bool = False) -> None:
        """Solve a problem. Raises the errors that hold for every frame, and others are the answer."""
        unknowns = Found(problem, problem.columns(problem.unknowns), keeps_all=keeps_all)
        self.failure = next(iter(problem.errors(unknowns.computed).values()), None)
        measured = () if self.failure else (*problem.measured,)
        frame = problem.filled if self.failure else problem.solved
        super().__init__(Question(problem.unknowns, measured, named=measured), frame, keeps_all=keeps_all)
        self.unknowns = unknowns
        self.problem, self.bars, self.sources = problem, unknowns.bars, unknowns.sources
        self.measures = {name: in_words(name, value) for name, value in unknowns.inputs_of(()).items()}
        self.condition = problem.solution.condition if measured[1:] else None
        self.assumed = {name: text for name, text in self.assumed.items() if name not in problem.measured}

    @property
    def row(self) -> Results:
        """The unknowns as a row of columns."""
        return self.unknowns

    @cached_property
    def results(self) -> tuple[Result, ...]:
        """The values of the unknowns, with their uncertainties."""
        if self.failure is not None:
            return tuple(without_value(name, self.failure) for name in self.problem.unknowns)
        if errors := self.unknowns.errors():  # without a meaning
            return tuple(without_value(name, error) for name, error in errors.items())
        solution, results = self.problem.solution, []
        for name, value in solution.values.items():
            by_law = {law: middle(values[name]) for law, values in self.alternatives.items()}
            growth = solution.growths[name] if isfinite(solution.growths[name]) else None
            results.append(Result(name, value, growth=growth, by_law=by_law, bar=self.bar(name)))
        return tuple(results)

    @cached_property
    def alternatives(self) -> Mapping[str, Mapping[str, Any]]:
        """The values, with error bars, under each other law that has the measured quantities by other formulas."""
        if self.ended:
            return {}
        formulas = self.frame.formulas_to(*self.problem.measured)
        by_law = {}
        for law in LAWS:
            other = self.problem.replace(model=law)
            with suppress(MissingInput):
                if other.filled.formulas_to(*other.measured) != formulas and (values := other.numbers(*other.unknowns)):
                    bars = error_bars(other, values) if other.uncertainties else {}
                    of_bars = {name: bar.of(values[name]) for name, bar in bars.items() if bar.sides}
                    by_law[law] = {**values, **of_bars}
        return by_law

    def about(self, doubt: Doubt) -> str:
        """Return what follows from a limit; where the law is not exact, the values by Maugis' law."""
        symbols = {name: symbol_among(name, {*self.inputs, *self.assumed}) for name in self.problem.unknowns}
        if doubt.is_exceeded and doubt.limit is LAW and BETWEEN in self.alternatives:
            values = {name: middle(value) for name, value in self.alternatives[BETWEEN].items()}
            told = listed(f"{symbols[name]} = {span(name, value, value)}" for name, value in values.items())
            better = f"by Maugis' law, better here than {self.frame.law.title}"
            return f"{told} {better} (Tabor parameter {doubt.value:.2g}): --model {BETWEEN}"
        if doubt.code == "rough-matters":
            unknowns = listed(symbols.values())
            return f"{unknowns}: for smooth spheres; rough ones give an effective value, of this size alone"
        return super().about(doubt)

    @cached_property
    def notes(self) -> tuple[Note, ...]:
        """The proof of what is found, and what the measured quantities rest on."""
        if self.failure is not None:
            return ()
        return (*(() if self.unknowns.errors() else self._proofs()), *super().notes)

    def _proofs(self) -> Iterator[Note]:
        """Iterate over what is unusual, what of the materials is not used, and the proof of the values."""
        frame, values, forward = self.frame, self.problem.solution.values, self.values
        used = frame.data_used(frame.inputs_of(*forward))
        for name, value in values.items():
            if value and not SIZES[name][0] <= abs(value) <= SIZES[name][1]:  # a unit may be wrong
                yield Note(
                    "warning", f"{equal({name: value}, symbol_of)} is beyond usual values, {sizes_in_words([name])}"
                )
            if name in _RAISING and not _LOSING.isdisjoint(forward):
                symbol = symbol_among(name, frame.given)
                yield Note("caveat", f"{symbol} is an upper limit: other losses of the collision are taken for it")
            replaced = "surface_energy" if name == "work_of_adhesion" else name
            for material, _ in frame.materials:
                if replaced in material.properties and (material, replaced) not in used:
                    symbol = NOMENCLATURE[replaced].symbol.rstrip("1")
                    yield Note("more", f"{symbol} of {material.name} is not used")
        proof = f"{equal(values, symbol_of)} {'give' if self.condition else 'gives'} {equal(forward, symbol_of)}"
        if "surface_energy" in values and "radius2" in frame.stated and "surface_energy2" not in frame.given:
            proof += f" if γ2 = γ1, so w = {amount('work_of_adhesion', frame['work_of_adhesion'])}"
        yield Note("more", proof + (f"; κ = {self.condition:.3g}" if self.condition else ""))

    @cached_property
    def explained(self) -> Answer:
        """The answer with the measured quantities beside the unknowns, as `--explain` derives both."""
        explained = copy(self)
        explained.results = (*self.results, *map(self.result, self.columns))
        return explained
