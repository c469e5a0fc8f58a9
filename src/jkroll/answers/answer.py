"""The answer of a command for one scene: its results, the inputs as understood, limits and notes."""

from collections.abc import Callable, Collection, Mapping
from types import MappingProxyType
from typing import TYPE_CHECKING, Any, NamedTuple

from ..errors import JkrollError, NoResult
from ..quantities.formatting import Format, amount, in_words
from ..quantities.nomenclature import INFINITY, NOMENCLATURE
from ..scene.errors import BeyondPullOff, MissingInput, NoContact, reason_of
from ..scene.laws import DEFAULT_LAW
from ..scene.limits import LIMIT_NAMES, Verdict, judged, of_any_scene, sentence, uses_spacing
from ..scene.rolling_models import model_error
from ..scene.scene import Scene
from ..scene.wiring import STATE, depends_on
from .comparison import (
    BETWEEN,
    Difference,
    differences,
    equation_of,
    of_jkr,
    over_spacing,
    rests_on_spacing,
    uses_law,
    with_differences,
    with_force_by_maugis,
)
from .notes import about_data, about_limits, about_missing, about_results, assumptions, few, symbol_of
from .questions import Question
from .result import Note, OtherLaw, Result

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
        return [Note("doubt", sentence(one), of_any_scene(one)) for one in self.validity if not one.holds]


def answer(question: Question, scene: Scene) -> Answer:
    """Compute the quantities of a command as far as the scene allows."""
    results: list[Result] = []
    errors: dict[str, JkrollError] = {}
    shown = [name for name in question.quantities if concerns(name, scene)]
    values = scene.evaluate((*shown, *LIMIT_NAMES))
    for name in shown:
        value = values[name]
        if isinstance(value, MissingInput | NoResult):
            errors[name] = value
            results.append(Result(name, None, reason_of(name, value)))
        elif rests_on_spacing(name, scene):
            results.append(Result(name, None, over_spacing(name, scene)))
        else:
            results.append(Result(name, value, error=model_error(name, scene)))
    results = _with_law(results, scene)
    known = [result.name for result in results if result.value is not None]
    planned = [result.name for result in results if not isinstance(errors.get(result.name), MissingInput)]
    used = scene.inputs_of(*planned) if planned else depends_on(question.quantities) & scene.given.keys()
    inputs = _echo(scene, used)
    headline = {*question.headline, "sticking_energy"}
    laws = differences(scene, [name for name in known if name in headline])
    limits = judged(scene, known)
    validity = tuple(with_differences(each, laws, scene) for each in limits.verdicts)
    entering = {*inputs, "atomic_spacing"} if uses_spacing(validity) else {*inputs}
    notes = (
        *assumptions(scene, entering, planned),
        *about_data(scene, inputs),
        *about_results(results, scene),
        *about_missing(results, errors),
        *about_limits(limits),
    )
    fatal = next((error for error in errors.values() if isinstance(error, NoContact)), None)
    if isinstance(fatal, BeyondPullOff):
        fatal = with_force_by_maugis(fatal, scene)
    failure = fatal or (None if known else next(iter(errors.values())))
    plain = Answer(inputs, tuple(results), notes, validity, failure, laws)
    return with_uncertainties(plain, scene) if scene.is_uncertain else plain


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


def _with_law(results: list[Result], scene: Scene) -> list[Result]:
    """Return results that say of which law they are, with the values of JKR beside them."""
    beside = of_jkr(scene, [result.name for result in results])
    return [
        result._replace(law=OtherLaw(scene.law.name, equation_of(scene, result.name), beside.get(result.name)))
        if result.value is not None and uses_law(scene, result.name)
        else result
        for result in results
    ]


def in_units(answer: Answer, form: Format) -> Answer:
    """Return an answer without the values that are out of the range of doubles in their unit."""
    results = tuple(_in_unit(result, form) for result in answer.results)
    return answer._replace(results=results)


def _in_unit(result: Result, form: Format) -> Result:
    if not result.value or 0 < abs(form.number(result.name, result.value)) < INFINITY:
        return result
    return result._replace(value=None, reason=f"no value in {form.unit(result.name)} that a double can hold")


# The quantities that are shown for some scenes only.
_SHOWN_IF: Mapping[str, Callable[[Scene], Any]] = {
    "rolling_frequency_as_printed": lambda scene: scene.is_identical & (scene.law.name == DEFAULT_LAW),
    "pull_off_force_lennard_jones": lambda scene: scene.law.name == BETWEEN,
    "pull_off_force_dmt": lambda scene: scene.law.name != "dmt",
    "yield_displacement": lambda scene: "adhesion_hysteresis" in scene.stated,
    "load": lambda scene: bool(STATE & scene.stated.keys()),
    "yield_force_fixed_load": lambda scene: bool((STATE | {"load"}) & scene.stated.keys()),
    "n_roll_after_impact": lambda scene: "speed" in scene.stated,
    "roll_energy": lambda scene: "rolling_angle" in scene.stated,
    "roll_energy_quarter_turn": lambda scene: "rolling_angle" not in scene.stated,
    "roll_energy_half_turn": lambda scene: "rolling_angle" not in scene.stated,
}


def concerns(name: str, scene: Scene) -> Any:
    """Return whether a quantity is shown for this scene, or for which elements of its arrays."""
    return _SHOWN_IF[name](scene) if name in _SHOWN_IF else name not in scene.stated


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
