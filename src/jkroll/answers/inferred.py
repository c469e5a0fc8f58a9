"""The answers of `infer`: the value of an input that a measured quantity implies, or of two by two, with what they rest on."""

from collections.abc import Mapping, Sequence
from copy import copy
from functools import cached_property
from math import isfinite
from typing import TYPE_CHECKING

from ..errors import JkrollError, NoResult
from ..quantities.formatting import amount, in_words
from ..quantities.laws import LAWS
from ..quantities.nomenclature import NOMENCLATURE
from ..scene.failures import MissingInput, reason_of
from ..scene.inverse import Solution, largest, solution, used_beside, with_inputs
from ..scene.limits import Verdict
from ..scene.scene import Scene
from ..scene.unknowns import Pair, Problem, scan_in_words
from .answer import Answer, Difference, about_uncertainties
from .displacement import Worth
from .questions import Question
from .results import Note, Result

if TYPE_CHECKING:
    from ..quantities.values import Uncertain
    from ..scene.uncertainty import Propagated, Sources

# The properties of a material that an inferred input takes the place of.
_REPLACED = {"work_of_adhesion": ("surface_energy",)}


class _OfMeasured(Answer):
    """An answer that follows from measured values. `forward` is the answer about what was measured, with the values found."""

    solution: Solution | Pair | None  # None where `no_solution` says why
    no_solution: NoResult | None
    forward: Answer

    @cached_property
    def laws(self) -> tuple[Difference, ...]:
        """None: what is found under each law stands beside the results."""
        return ()

    @cached_property
    def worth(self) -> Worth | None:
        """The worth of the assumed displacement for what was measured."""
        return self.forward.worth if self.solution is not None else None

    @cached_property
    def validity(self) -> tuple[Verdict, ...]:
        """The limits of the model for what was measured."""
        return self.forward.validity if self.solution is not None else ()

    @cached_property
    def notes(self) -> tuple[Note, ...]:
        """The proof of what is found, and what the measured quantities rest on."""
        if self.solution is None:
            return ()
        found, sources = self._uncertainties
        return (
            *self._proofs(),
            *(note for note in self.forward.notes if note.kind != "roughness"),
            *(about_uncertainties(found, sources) if sources is not None else ()),
        )

    def _proofs(self) -> list[Note]:
        raise NotImplementedError

    @cached_property
    def failure(self) -> JkrollError | None:
        """The reason why nothing is found."""
        return self.no_solution

    @cached_property
    def explained(self) -> Answer:
        """What was measured, computed with what is found, beside that: what `--explain` derives."""
        if self.solution is None:
            return self
        explained = copy(self)
        explained.results = (*self.results, *self.forward.results)
        return explained


class Inferred(_OfMeasured):
    """The answer that an input has the value at which a quantity of a scene has its measured value."""

    def __init__(self, name: str, quantity: str, measured: "float | Uncertain", scene: Scene) -> None:
        """Look for the value. Raises the errors of `solution` other than NoResult."""
        self.name, self.quantity, self.measured = name, quantity, measured
        self.measured_value = measured if isinstance(measured, float) else measured.value
        self.given = scene
        self.question = Question((name,), (name,))
        self.solution: Solution | None = None
        self.no_solution: NoResult | None = None
        try:
            self.solution = solution(name, quantity, self.measured_value, scene)
        except NoResult as error:
            self.no_solution = error
        self.scene = self.solution.scene if self.solution is not None else with_inputs(scene, largest([name]))
        self.forward = Answer(Question((quantity,), (quantity,), named=(quantity,)), self.scene)

    @cached_property
    def inputs(self) -> Mapping[str, float | str]:
        """The inputs without the one that is asked for, and with the measured value."""
        known = self.scene.echo(used_beside([self.name], [self.quantity], self.given))
        return {name: in_words(name, value) for name, value in known.items()} | {self.quantity: self.measured_value}

    @cached_property
    def results(self) -> tuple[Result, ...]:
        """The inferred value, with its uncertainty."""
        if self.solution is None:
            assert self.no_solution is not None
            return (Result(self.name, None, reason_of(self.name, self.no_solution)),)
        condition = self.solution.condition if isfinite(self.solution.condition) else None
        one = self._uncertainties[0].get(self.name)
        propagated = one if isinstance(one, tuple) else None
        return (
            Result(self.name, self.solution.value, condition=condition, by_law=self._by_law, propagated=propagated),
        )

    @cached_property
    def _uncertainties(self) -> "tuple[Mapping[str, Propagated | JkrollError], Sources | None]":
        if self.solution is None or (isinstance(self.measured, float) and not self.given.is_uncertain):
            return {}, None
        from ..scene.uncertainty import inferred_uncertainty

        return inferred_uncertainty(self.name, self.quantity, self.measured, self.solution, self.given)

    @cached_property
    def _by_law(self) -> dict[str, float]:
        """The value under each other law of attraction that has the quantity by other formulas."""
        own = self.scene.plan(self.quantity).steps
        found: dict[str, float] = {}
        for law in LAWS:
            other = self.given.under(law)
            try:
                if with_inputs(other, largest([self.name])).plan(self.quantity).steps != own:
                    found[law] = solution(self.name, self.quantity, self.measured_value, other).value
            except (MissingInput, NoResult):
                continue
        return found

    def _proofs(self) -> list[Note]:
        """Return what of the materials is not used, how errors grow, and the proof of the value."""
        found = self.solution
        assert found is not None
        symbol, of_measured = NOMENCLATURE[self.name].symbol, NOMENCLATURE[self.quantity].symbol
        proof = (
            f"{symbol} = {amount(self.name, found.value)} gives {of_measured} = {amount(self.quantity, found.forward)}; "
            f"κ = |d ln {symbol}/d ln {of_measured}| = {found.condition:.3g}"
        )
        if self._by_law:
            others = (f"{amount(self.name, value)} under {LAWS[law].title}" for law, value in self._by_law.items())
            proof += f"; {', '.join(others)}"
        return [*_unused(self.name, [self.quantity], found.scene), Note("model", proof)]


def _unused(name: str, quantities: Sequence[str], found: Scene) -> list[Note]:
    """Return a note on each property of a material in whose place an inferred value stands. `found`: the scene with that value."""
    used = found.data_used(found.inputs_of(*quantities))
    materials = {one.name: one for one in (found.material, found.material2) if one is not None}
    return [
        Note("result", f"{NOMENCLATURE[each].symbol.rstrip('1')} of {material.name} is not used")
        for material in materials.values()
        for each in _REPLACED.get(name, (name,))
        if each in material.properties and all(one.name != material.name or other != each for one, other in used)
    ]


# --- Two inputs -------------------------------------------------------------------------------------------------------


class InferredPair(_OfMeasured):
    """The answer that two inputs have the values at which two quantities of a scene have their measured values."""

    def __init__(self, names: Sequence[str], measured: "Mapping[str, float | Uncertain]", scene: Scene) -> None:
        """Look for the values. Raises the errors of `Problem` other than NoResult."""
        self.names, self.measured_values = tuple(names), measured
        self.middles = {name: one if isinstance(one, float) else one.value for name, one in measured.items()}
        self.given = scene
        self.question = Question(self.names, self.names)
        self.solution: Pair | None = None
        self.no_solution: NoResult | None = None
        try:
            self.solution = Problem(self.names, self.middles, scene).solution()
            self.condition = self.solution.condition
        except NoResult as error:
            self.no_solution = error
        self.scene = self.solution.scene if self.solution is not None else with_inputs(scene, largest(self.names))
        self.forward = Answer(Question((*measured,), (*measured,), named=(*measured,)), self.scene)

    @cached_property
    def inputs(self) -> Mapping[str, float | str]:
        """The inputs without those that are asked for, and with the measured values."""
        known = self.scene.echo(used_beside(self.names, [*self.middles], self.given))
        return {name: in_words(name, value) for name, value in known.items()} | self.middles

    @cached_property
    def results(self) -> tuple[Result, ...]:
        """The inferred values, with their uncertainties."""
        if self.solution is None:
            assert self.no_solution is not None
            reason = reason_of(",".join(self.names), self.no_solution)
            return tuple(Result(name, None, reason) for name in self.names)
        found, _ = self._uncertainties
        return tuple(
            Result(
                name,
                value,
                growth=growth if isfinite(growth := self.solution.growths[name]) else None,
                by_law={law: values[name] for law, values in self._pairs_by_law.items()},
                propagated=one if isinstance(one := found.get(name), tuple) else None,
            )
            for name, value in self.solution.values.items()
        )

    @cached_property
    def _uncertainties(self) -> "tuple[Mapping[str, Propagated | JkrollError], Sources | None]":
        is_certain = (
            all(isinstance(one, float) for one in self.measured_values.values()) and not self.given.is_uncertain
        )
        if self.solution is None or is_certain:
            return {}, None
        from ..scene.uncertainty import uncertainties_of_two

        return uncertainties_of_two(self.measured_values, self.solution, self.given)

    @cached_property
    def _pairs_by_law(self) -> dict[str, Mapping[str, float]]:
        """The values under each other law of attraction that has the quantities by other formulas."""
        quantities = [*self.middles]
        own = self.scene.plan(*quantities).steps
        found: dict[str, Mapping[str, float]] = {}
        for law in LAWS:
            other = self.given.under(law)
            try:
                if with_inputs(other, largest(self.names)).plan(*quantities).steps != own:
                    found[law] = Problem(self.names, self.middles, other).solution().values
            except (MissingInput, NoResult):
                continue
        return found

    def _proofs(self) -> list[Note]:
        """Return what of the materials is not used, the proof of the values, what they are under other laws, and where they were looked for."""
        found = self.solution
        assert found is not None
        texts = [f"{_equal(found.values)} give {_equal(found.forward)}; κ = {found.condition:.3g}"]
        texts += [f"{_equal(values)} under {LAWS[law].title}" for law, values in self._pairs_by_law.items()]
        unused = [note for name in self.names for note in _unused(name, [*self.middles], self.scene)]
        return [*unused, *(Note("model", text) for text in (*texts, f"scanned: {scan_in_words(self.names)}"))]


def _equal(values: Mapping[str, float]) -> str:
    return " and ".join(f"{NOMENCLATURE[name].symbol} = {amount(name, value)}" for name, value in values.items())
