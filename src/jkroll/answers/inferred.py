"""The answers of `infer`: the values of inputs that measured quantities imply, with what they rest on."""

from collections.abc import Iterator, Mapping, Sequence
from contextlib import suppress
from copy import copy
from functools import cached_property
from math import isfinite
from typing import Any

from ..errors import JkrollError, NoResult
from ..quantities.formatting import amount, in_words, span, symbol_beside
from ..quantities.laws import BETWEEN, LAWS
from ..quantities.nomenclature import NOMENCLATURE
from ..quantities.values import middle
from ..scene.alternatives import factor_of_law
from ..scene.failures import MissingInput, reason_of
from ..scene.inverse import SIZES, sizes_in_words
from ..scene.limits import Doubt
from ..scene.scene import Scene
from ..scene.uncertainty import measures_of, uncertainties
from ..scene.unknowns import Problem
from ..text import listed
from .answer import Answer, Result
from .notes import Note, about_uncertainties
from .questions import Question

# Measured quantities that every loss moves one way, and the inputs that move them the same way as they grow.
_LOSING = frozenset({"restitution", "sticking_speed"})
_RAISING = frozenset({"surface_energy", "work_of_adhesion", "hamaker", "viscous_time"})

# The properties of a material that an inferred input takes the place of.
_REPLACED = {"work_of_adhesion": ("surface_energy",)}


class Inferred(Answer):
    """The answer that unknowns have the values at which quantities have their measured values.

    `forward` is the answer about what was measured.
    """

    def __init__(self, problem: Problem) -> None:
        """Solve a problem. Raises the errors that hold for every scene, and others are the answer."""
        self.problem, self.question = problem, Question(problem.unknowns, problem.unknowns)
        errors = (value for value in problem.evaluate(problem.unknowns).values() if isinstance(value, JkrollError))
        self.failure = next(errors, None)
        is_solved = self.failure is None
        self.scene, measured = (problem.solved, (*problem.measured,)) if is_solved else (problem.filled, ())
        self.condition = problem.solution.condition if is_solved and len(problem.unknowns) > 1 else None
        self.forward = Answer(Question(measured, measured, named=measured), self.scene)
        self.inputs = {name: in_words(name, value) for name, value in problem.echo(problem.inputs_used(())).items()}
        self.bars, self.sources = {}, None
        if is_solved:
            self.bars, self.sources = uncertainties(problem, problem.unknowns)
        self.laws = {}  # what is found under each law stands beside the results
        self.displacement, self.validity = self.forward.displacement, self.forward.validity
        self.assumed = {name: text for name, text in self.forward.assumed.items() if name not in problem.measured}

    @cached_property
    def results(self) -> tuple[Result, ...]:
        """The values of the unknowns, with their uncertainties."""
        if self.failure is not None:
            return tuple(Result(name, None, reason_of(name, self.failure)) for name in self.problem.unknowns)
        solution, which = self.problem.solution, "growth" if self.condition else "condition"
        growths = {name: {which: growth} if isfinite(growth) else {} for name, growth in solution.growths.items()}
        return tuple(
            Result(
                name,
                value,
                by_law={law: middle(values[name]) for law, values in self.alternatives.items()},
                propagated=self.propagated(name),
                **growths[name],
            )
            for name, value in solution.values.items()
        )

    @cached_property
    def alternatives(self) -> Mapping[str, Mapping[str, Any]]:
        """The values, with error bars, under each other law that has the measured quantities by other formulas."""
        formulas = self.scene.formulas_to(*self.problem.measured)
        by_law = {}
        for law in LAWS:
            other = self.problem.replace(model=law)
            with suppress(MissingInput, NoResult):
                if other.filled.formulas_to(*self.problem.measured) != formulas and (values := other.numbers()):
                    bars = measures_of(uncertainties(other, other.unknowns)[0])
                    known = {name: bar for name, bar in bars.items() if not isinstance(bar, JkrollError)}
                    by_law[law] = {**values, **known}
        return by_law

    def about(self, doubt: Doubt) -> str:
        """Return what follows from a limit; where the law is not exact, the values by Maugis' law."""
        symbols = {name: symbol_beside(name, {*self.inputs, *self.assumed}) for name in self.problem.unknowns}
        if doubt.is_exceeded and doubt.limit.factor is factor_of_law and BETWEEN in self.alternatives:
            values = {name: middle(value) for name, value in self.alternatives[BETWEEN].items()}
            told = listed(f"{symbols[name]} = {span(name, value, value)}" for name, value in values.items())
            better = f"by Maugis' law, better here than {self.scene.law.title}"
            return f"{told} {better} (Tabor parameter {doubt.value:.2g}): --model {BETWEEN}"
        if doubt.code == "rough-matters":
            unknowns = listed(symbols.values())
            return f"{unknowns}: for smooth spheres; rough ones give an effective value, of this size alone"
        return self.forward.about(doubt)

    @cached_property
    def notes(self) -> tuple[Note, ...]:
        """The proof of what is found, and what the measured quantities rest on."""
        if self.sources is None:
            return ()
        notes = (*self._proofs(), *self.forward.notes, *about_uncertainties(self.bars, self.sources))
        return tuple(dict.fromkeys(notes))  # both ways leave out the same

    def _proofs(self) -> Iterator[Note]:
        """Iterate over what is unusual, what of the materials is not used, and the proof of the values."""
        values, forward = self.problem.solution.values, self.scene.numbers(*self.problem.measured)
        for name, value in values.items():
            if value and not SIZES[name][0] <= abs(value) <= SIZES[name][1]:  # a unit may be wrong
                yield Note("warning", f"{_equal({name: value})} is beyond usual values, {sizes_in_words([name])}")
            if name in _RAISING and not _LOSING.isdisjoint(forward):
                symbol = symbol_beside(name, self.scene.given)
                yield Note("caveat", f"{symbol} is an upper limit: other losses of the collision are taken for it")
            yield from _unused(name, [*forward], self.scene)
        verb, kappa = "give", "κ"
        if len(values) == 1:
            slope = "/".join(f"d ln {NOMENCLATURE[name].symbol}" for name in (*values, *forward))
            verb, kappa = "gives", f"κ = |{slope}|"
        proof = f"{_equal(values)} {verb} {_equal(forward)}{_of_both(values, self.scene)}"
        yield Note("more", f"{proof}; {kappa} = {self.problem.solution.condition:.3g}")

    @cached_property
    def explained(self) -> Answer:
        """The answer with the measured quantities beside the unknowns, as `--explain` derives both."""
        explained = copy(self)
        explained.results = (*self.results, *self.forward.results)
        return explained


def _of_both(values: Mapping[str, float], scene: Scene) -> str:
    """Return that the surface energy is meant of both bodies, where these are not alike, and the work of adhesion."""
    if "surface_energy" not in values or "radius2" not in scene.stated or "surface_energy2" in scene.given:
        return ""
    return f" if γ2 = γ1, so w = {amount('work_of_adhesion', scene['work_of_adhesion'])}"


def _unused(name: str, quantities: Sequence[str], scene: Scene) -> list[Note]:
    """Return a note on each property of a material in whose place an inferred value stands in a scene."""
    used = scene.data_used(scene.inputs_of(*quantities))
    return [
        Note("more", f"{NOMENCLATURE[each].symbol.rstrip('1')} of {material.name} is not used")
        for material, _ in scene.materials
        for each in _REPLACED.get(name, (name,))
        if each in material.properties and (material, each) not in used
    ]


def _equal(values: Mapping[str, float]) -> str:
    return listed(f"{NOMENCLATURE[name].symbol} = {amount(name, value)}" for name, value in values.items())
