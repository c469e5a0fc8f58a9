"""The answer of a command for one scene: its results, the inputs as understood, limits and notes."""

from collections.abc import Collection, Mapping
from types import MappingProxyType
from typing import TYPE_CHECKING, Any, NamedTuple

from ..errors import JkrollError, NoResult
from ..quantities.formatting import Format, amount, in_words
from ..quantities.nomenclature import INFINITY, NOMENCLATURE
from ..scene.errors import BeyondPullOff, MissingInput, NoContact, reason_of
from ..scene.limits import LIMIT_NAMES, Verdict, against_limit, judged, of_any_scene, sentence
from ..scene.scene import Scene
from ..scene.wiring import depends_on
from .comparison import Difference, differences, with_differences, with_force_by_maugis
from .notes import about_data, about_limits, about_missing, about_results, assumptions, few, model_error, symbol_of
from .other_laws import over_spacing, rests_on_spacing, with_law
from .questions import Question
from .result import Note, Result

if TYPE_CHECKING:
    from ..quantities.uncertain import Uncertain
    from ..scene.uncertainty import Propagated, Sources


class Answer(NamedTuple):
    """The results of a command for one scene."""

    inputs: Mapping[str, float | str]
    results: tuple[Result, ...]
    notes: tuple[Note, ...]
    validity: tuple[Verdict, ...]
    failure: JkrollError | None  # why there is no result, or no contact
    laws: tuple[Difference, ...] = ()  # how Maugis' law differs from JKR
    uncertain: Mapping[str, "Uncertain"] = MappingProxyType({})  # the inputs that are uncertain

    def value(self, name: str) -> float | None:
        """Return the value of a result, or None."""
        return next((result.value for result in self.results if result.name == name), None)

    def doubts(self) -> list[Note]:
        """Return a note for each limit of the model that does not hold."""
        return [
            Note("doubt", sentence(one), of_any_scene(one), against_limit(one))
            for one in self.validity
            if not one.holds
        ]


def answer(question: Question, scene: Scene) -> Answer:
    """Compute the quantities of a command as far as the scene allows."""
    results, errors = _results(question, scene)
    known = [result.name for result in results if result.value is not None]
    planned = [result.name for result in results if not isinstance(errors.get(result.name), MissingInput)]
    used = scene.inputs_of(*planned) if planned else depends_on(question.quantities) & scene.given.keys()
    inputs = _echo(scene, used)
    laws = differences(scene, [name for name in known if name in (*question.headline, *question.compared)])
    limits = judged(scene, known)
    validity = tuple(with_differences(each, laws, scene) for each in limits.verdicts)
    of_limits = scene.inputs_of(*(verdict.name for verdict in validity))
    entering = {*inputs, "atomic_spacing"} if "atomic_spacing" in of_limits else {*inputs}
    notes = (
        *assumptions(scene, entering, planned),
        *about_data(scene, inputs),
        *about_results(results, scene),
        *about_missing(results, errors),
        *about_limits(limits),
    )
    failure = _fatal(errors, scene) or (None if known else next(iter(errors.values()), None))
    plain = Answer(inputs, tuple(results), notes, validity, failure, laws)
    return with_uncertainties(plain, scene) if scene.is_uncertain else plain


def _results(question: Question, scene: Scene) -> tuple[list[Result], dict[str, MissingInput | NoResult]]:
    """Return the quantities that are shown for a scene, and the errors of those that have no value.

    The limits that will be judged are evaluated along with them, so that one plan leads to all.
    """
    shown = [name for name in question.quantities if name in question.named or concerns(name, scene)]
    values = scene.evaluate((*shown, *LIMIT_NAMES))
    errors = {name: values[name] for name in shown if isinstance(values[name], MissingInput | NoResult)}
    results: list[Result] = []
    for name in shown:
        if name in errors:
            results.append(Result(name, None, reason_of(name, errors[name])))
        elif rests_on_spacing(name, scene):
            results.append(Result(name, None, over_spacing(name, scene)))
        else:
            results.append(Result(name, values[name], error=model_error(name, scene)))
    return (results if scene.law.is_default else with_law(results, scene)), errors


def _fatal(errors: Mapping[str, JkrollError], scene: Scene) -> JkrollError | None:
    """Return the error that invalidates the whole scene, even where some values could be computed; None if there is none."""
    fatal = next((error for error in errors.values() if isinstance(error, NoContact)), None)
    return with_force_by_maugis(fatal, scene) if isinstance(fatal, BeyondPullOff) else fatal


def with_uncertainties(answer: Answer, scene: Scene) -> Answer:
    """Return an answer with the uncertainties of its results, and of the inputs that they come from."""
    from ..scene.uncertainty import uncertainties

    names = [result.name for result in answer.results if result.value is not None]
    return add_uncertainties(answer, *uncertainties(scene, names))


def add_uncertainties(answer: Answer, found: Mapping[str, "Propagated | JkrollError"], sources: "Sources") -> Answer:
    """Return an answer with these uncertainties, and with a note for those that do not exist, and for sources that are left out."""
    results = [
        result._replace(propagated=one) if not isinstance(one := found.get(result.name), JkrollError) else result
        for result in answer.results
    ]
    failures: dict[str, list[str]] = {}
    for name, one in found.items():
        if isinstance(one, MissingInput | NoResult):
            failures.setdefault(reason_of(name, one), []).append(name)
    notes = [
        Note("missing", f"{few(names)}: no uncertainty, as there is no value at an end of an input: {reason}")
        for reason, names in failures.items()
    ]
    left_out: dict[str, list[str]] = {}
    for source in sources.left_out:
        reason = "ranges are left out beside ±" if source.given.kind == "range" else "± is left out beside ranges"
        name = source.names[0]
        left_out.setdefault(reason, []).append(f"{symbol_of(name)} = {amount(name, source.given)}")
    notes += [Note("result", f"{reason}: {', '.join(texts)}") for reason, texts in left_out.items()]
    entering = sources.entering
    stated = {name: source.given for source in entering for name in source.names if name in answer.inputs}
    return answer._replace(results=tuple(results), notes=(*answer.notes, *notes), uncertain=stated)


def in_units(answer: Answer, form: Format) -> Answer:
    """Return an answer without the values that are out of the range of doubles in their unit."""
    results = tuple(_in_unit(result, form) for result in answer.results)
    return answer._replace(results=results)


def _in_unit(result: Result, form: Format) -> Result:
    if not result.value or 0 < abs(form.number(result.name, result.value)) < INFINITY:
        return result
    return result._replace(value=None, reason=f"no value in {form.unit(result.name)} that a double can hold")


def concerns(name: str, scene: Scene) -> Any:
    """Return whether a quantity is shown for this scene, or for which elements of its arrays."""
    quantity, stated = NOMENCLATURE[name], scene.stated.keys()
    is_shown = (
        name not in stated
        and name not in scene.law.omits
        and not (quantity.shown_with and stated.isdisjoint(quantity.shown_with))
        and stated.isdisjoint(quantity.hidden_with)
    )
    return scene.is_identical if is_shown and quantity.of_identical else is_shown


def _echo(scene: Scene, used: Collection[str]) -> dict[str, float | str]:
    """Return the inputs on which the results depend, as they were understood."""
    echoed: dict[str, Any] = {}
    if scene.material is not None:
        echoed["material"] = scene.material.name
    if scene.material2 is not None:
        echoed["material2"] = scene.material2.name
    if scene.stated_model is not None:
        echoed["model"] = scene.stated_model
    for name in NOMENCLATURE:
        if name in used:
            echoed[name] = scene.values[name]
        elif name == "radius2" and "radius" in used:
            echoed[name] = scene.values["radius"]
        elif name == "energy" and "energy_ratio" in used:
            try:
                echoed[name] = scene["energy"]
            except NoResult:
                continue
    return {name: in_words(name, value) for name, value in echoed.items()}
