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
from ..scene.inverse import SIZES, Solution, solution, used_beside, with_input
from ..scene.limits import Verdict
from ..scene.scene import Scene
from ..scene.unknowns import Pair, Problem, largest, scan_in_words, used_beside_two, with_inputs
from .answer import Answer, Difference, about_uncertainties
from .questions import Question
from .results import Note, Result

if TYPE_CHECKING:
    from ..quantities.values import Uncertain
    from ..scene.uncertainty import Propagated, Sources

# The properties of a material that an inferred input takes the place of.
_REPLACED = {"work_of_adhesion": ("surface_energy",)}


class Inferred(Answer):
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
        self.scene = self.solution.scene if self.solution is not None else with_input(scene, name, SIZES[name][1])
        self.forward = Answer(Question((quantity,), (quantity,), named=(quantity,)), self.scene)

    @cached_property
    def inputs(self) -> Mapping[str, float | str]:
        """The inputs without the one that is asked for, and with the measured value."""
        known = self.scene.echo(used_beside(self.name, self.quantity, self.given))
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
        return _by_other_laws(self.name, self.quantity, self.measured_value, self.given)

    @cached_property
    def laws(self) -> tuple[Difference, ...]:
        """None: the value under each law stands beside the result."""
        return ()

    @cached_property
    def validity(self) -> tuple[Verdict, ...]:
        """The limits of the model for the measured quantity."""
        return self.forward.validity if self.solution is not None else ()

    @cached_property
    def notes(self) -> tuple[Note, ...]:
        """The proof of the value, and what the measured quantity rests on."""
        if self.solution is None:
            return ()
        found, sources = self._uncertainties
        return (
            *_notes(self.name, self.quantity, self.solution, self._by_law),
            *(note for note in self.forward.notes if note.kind != "roughness"),
            *(about_uncertainties(found, sources) if sources is not None else ()),
        )

    @cached_property
    def failure(self) -> JkrollError | None:
        """The reason why there is no value."""
        return self.no_solution

    @cached_property
    def explained(self) -> Answer:
        """The measured quantity computed with the inferred value, beside that value: what `--explain` derives."""
        if self.solution is None:
            return self
        explained = copy(self)
        explained.results = (*self.results, *self.forward.results)
        return explained


def _by_other_laws(name: str, quantity: str, value: float, scene: Scene) -> dict[str, float]:
    """Return the value of an input under each other law of attraction that has the quantity by other formulas."""
    own = with_input(scene, name, SIZES[name][1]).plan(quantity).steps
    values = {}
    for law in LAWS:
        other = scene.under(law)
        try:
            if with_input(other, name, SIZES[name][1]).plan(quantity).steps != own:
                values[law] = solution(name, quantity, value, other).value
        except (MissingInput, NoResult):
            continue
    return values


def _notes(name: str, quantity: str, found: Solution, by_law: Mapping[str, float]) -> list[Note]:
    """Return what of the materials is not used, how errors grow, and the proof of the value."""
    symbol, of_measured = NOMENCLATURE[name].symbol, NOMENCLATURE[quantity].symbol
    proof = (
        f"{symbol} = {amount(name, found.value)} gives {of_measured} = {amount(quantity, found.forward)}; "
        f"κ = |d ln {symbol}/d ln {of_measured}| = {found.condition:.3g}"
    )
    if by_law:
        others = ", ".join(f"{amount(name, value)} under {LAWS[law].title}" for law, value in by_law.items())
        proof += f"; {others}"
    return [*_unused(name, [quantity], found.scene), Note("model", proof)]


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


class InferredPair(Answer):
    """The answer that two inputs have the values at which two quantities of a scene have their measured values."""

    def __init__(self, names: Sequence[str], measured: "Mapping[str, float | Uncertain]", scene: Scene) -> None:
        """Look for the values. Raises the errors of `Problem` other than NoResult."""
        self.names, self.measured_values = tuple(names), measured
        self.middles = {name: one if isinstance(one, float) else one.value for name, one in measured.items()}
        self.given = scene
        self.question = Question(self.names, self.names)
        self.pair: Pair | None = None
        self.no_solution: NoResult | None = None
        try:
            self.pair = Problem(self.names, self.middles, scene).solution()
            self.condition = self.pair.condition
        except NoResult as error:
            self.no_solution = error
        self.scene = self.pair.scene if self.pair is not None else with_inputs(scene, largest(self.names))
        self.forward = Answer(Question((*measured,), (*measured,), named=(*measured,)), self.scene)

    @cached_property
    def inputs(self) -> Mapping[str, float | str]:
        """The inputs without those that are asked for, and with the measured values."""
        known = self.scene.echo(used_beside_two(self.names, [*self.middles], self.given))
        return {name: in_words(name, value) for name, value in known.items()} | self.middles

    @cached_property
    def results(self) -> tuple[Result, ...]:
        """The inferred values, with their uncertainties."""
        if self.pair is None:
            assert self.no_solution is not None
            reason = reason_of(",".join(self.names), self.no_solution)
            return tuple(Result(name, None, reason) for name in self.names)
        found, _ = self._uncertainties
        return tuple(
            Result(
                name,
                value,
                growth=growth if isfinite(growth := self.pair.growths[name]) else None,
                by_law={law: values[name] for law, values in self._pairs_by_law.items()},
                propagated=one if isinstance(one := found.get(name), tuple) else None,
            )
            for name, value in self.pair.values.items()
        )

    @cached_property
    def _uncertainties(self) -> "tuple[Mapping[str, Propagated | JkrollError], Sources | None]":
        is_certain = (
            all(isinstance(one, float) for one in self.measured_values.values()) and not self.given.is_uncertain
        )
        if self.pair is None or is_certain:
            return {}, None
        from ..scene.uncertainty import uncertainties_of_two

        return uncertainties_of_two(self.measured_values, self.pair, self.given)

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

    @cached_property
    def laws(self) -> tuple[Difference, ...]:
        """None: the values under each law stand beside the results."""
        return ()

    @cached_property
    def validity(self) -> tuple[Verdict, ...]:
        """The limits of the model for the measured quantities."""
        return self.forward.validity if self.pair is not None else ()

    @cached_property
    def notes(self) -> tuple[Note, ...]:
        """The proof of the values, and what the measured quantities rest on."""
        if self.pair is None:
            return ()
        found, sources = self._uncertainties
        unused = [note for name in self.names for note in _unused(name, [*self.middles], self.scene)]
        return (
            *unused,
            *self._proofs(self.pair),
            *(note for note in self.forward.notes if note.kind != "roughness"),
            *(about_uncertainties(found, sources) if sources is not None else ()),
        )

    def _proofs(self, pair: Pair) -> list[Note]:
        """Return the proof of the values, what they are under other laws, and where they were looked for."""
        texts = [f"{_equal(pair.values)} give {_equal(pair.forward)}; κ = {pair.condition:.3g}"]
        texts += [f"{_equal(values)} under {LAWS[law].title}" for law, values in self._pairs_by_law.items()]
        return [Note("model", text) for text in (*texts, f"scanned: {scan_in_words(self.names)}")]

    @cached_property
    def failure(self) -> JkrollError | None:
        """The reason why there are no values."""
        return self.no_solution

    @cached_property
    def explained(self) -> Answer:
        """The measured quantities computed with the inferred values, beside these: what `--explain` derives."""
        if self.pair is None:
            return self
        explained = copy(self)
        explained.results = (*self.results, *self.forward.results)
        return explained


def _equal(values: Mapping[str, float]) -> str:
    return " and ".join(f"{NOMENCLATURE[name].symbol} = {amount(name, value)}" for name, value in values.items())
