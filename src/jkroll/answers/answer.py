"""What a command answers: its quantities for one scene, with the inputs as understood, reasons and notes."""

from collections.abc import Collection, Mapping
from typing import Any, NamedTuple

from ..errors import JkrollError, NoResult
from ..quantities.formatting import Format, amount
from ..quantities.nomenclature import INFINITY, NOMENCLATURE, word_for_infinity
from ..scene.errors import BeyondFold, BeyondPullOff, MissingInput
from ..scene.limits import Verdict, uses_spacing, verdicts
from ..scene.rolling_models import NotGoodEnough, model_error, within
from ..scene.scene import DEFAULTS, Scene
from ..scene.wiring import STATE, depends_on
from .questions import Question


class Result(NamedTuple):
    """A quantity in SI units, or the reason why there is none; of a model, its relative error."""

    name: str
    value: float | None
    reason: str = ""
    error: float | None = None


class Answer(NamedTuple):
    """What one scene gave."""

    inputs: Mapping[str, float | str]
    results: tuple[Result, ...]
    notes: tuple[str, ...]
    validity: tuple[Verdict, ...]
    failure: JkrollError | None  # why there is no result, or no contact

    def value(self, name: str) -> float | None:
        """The value of a result that this answer has, or None."""
        return next((result.value for result in self.results if result.name == name), None)


def answer(command: Question, scene: Scene, rtol: float | None = None) -> Answer:
    """Compute what a command shows of a scene, as far as the scene allows; rolling by the cheapest model within `rtol`."""
    results: list[Result] = []
    errors: dict[str, JkrollError] = {}
    for name in command.quantities:
        if not _concerns(name, scene):
            continue
        try:
            results.append(Result(name, scene[name], error=model_error(name, scene)))
        except MissingInput as error:
            errors[name] = error
            results.append(Result(name, None, f"needs {error.needs()}"))
        except NoResult as error:
            errors[name] = error
            results.append(Result(name, None, str(error).removeprefix(f"{name}: ")))
    known = [result.name for result in results if result.value is not None]
    chosen: list[str] = []
    if rtol is not None and known:
        values = {one.name: one.value for one in results if one.value is not None}
        changed, chosen = within(values, scene, rtol)
        errors |= {name: value for name, value in changed.items() if isinstance(value, NotGoodEnough)}
        results = [_changed(one, changed[one.name]) if one.name in changed else one for one in results]
        known = [result.name for result in results if result.value is not None]
    planned = [result.name for result in results if not isinstance(errors.get(result.name), MissingInput)]
    used = scene.inputs_of(*planned) if planned else depends_on(command.quantities) & scene.given.keys()
    inputs = _echo(scene, used)
    validity = verdicts(scene, known)
    assumed = assumptions(scene, {*inputs, *(("atomic_spacing",) if uses_spacing(validity) else ())}, planned)
    notes = (*chosen, *assumed, *about_data(scene, inputs), *_about(results, scene))
    fatal = next((error for error in errors.values() if isinstance(error, _FATAL)), None)
    failure = fatal or (None if known else next(iter(errors.values())))
    return Answer(inputs, tuple(results), notes, validity, failure)


# What leaves nothing to be trusted of a scene, even where something could be computed.
_FATAL = (BeyondPullOff, BeyondFold, NotGoodEnough)


def _changed(result: Result, value: float | NotGoodEnough) -> Result:
    """A result by the model that was chosen, or the reason why none was."""
    if isinstance(value, NotGoodEnough):
        return Result(result.name, None, str(value))
    return Result(result.name, value)


def in_units(answer: Answer, form: Format) -> Answer:
    """An answer without the results that their unit takes out of the range of doubles."""
    results = tuple(
        result._replace(value=None, reason=f"no value in {form.unit(result.name)} that a double can hold")
        if result.value and not 0 < abs(form.number(result.name, result.value)) < INFINITY
        else result
        for result in answer.results
    )
    return answer._replace(results=results)


def _concerns(name: str, scene: Scene) -> bool:
    """Whether a quantity that stands beside another has something to say of this scene."""
    if name == "rolling_frequency_as_printed":
        return scene.is_identical
    if name == "load":
        return bool(STATE & scene.stated.keys())
    return name not in scene.stated


def _echo(scene: Scene, used: Collection[str]) -> dict[str, float | str]:
    """The inputs on which the results depend, as they were understood."""
    echoed: dict[str, Any] = {}
    if scene.material is not None:
        echoed["material"] = scene.material.name
    if scene.material2 is not None:
        echoed["material2"] = scene.material2.name
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
    return {name: word_for_infinity(name) or value if value == INFINITY else value for name, value in echoed.items()}


def assumptions(scene: Scene, inputs: Collection[str], names: list[str]) -> list[str]:
    """What was taken for granted, and the options that say otherwise."""
    assumed = [
        f"{NOMENCLATURE[name].symbol} = {amount(name, DEFAULTS[name])} ({NOMENCLATURE[name].option})"
        for name in DEFAULTS
        if name in inputs and name not in scene.given
    ]
    steps = {step.name for name in names for step in scene.plan(name).steps}
    notes = [f"assumed {', '.join(assumed)}"] if assumed else []
    if (
        "work_of_adhesion" in steps
        and scene.given.get("surface_energy2", 0) != scene.given.get("surface_energy")
        and "surface_energy2" in inputs
    ):
        notes.append("w = 2√(γ1γ2) by the geometric mixing rule; a measured one is better (--work-of-adhesion)")
    return notes


def about_data(scene: Scene, inputs: Collection[str]) -> list[str]:
    """What is to be known of the material data that were used."""
    used = scene.data_used(inputs)
    shadows = [f"{material.name}: {text}" for material, _ in used for text in material.shadows]
    notes = [
        f"{material.name}: {NOMENCLATURE[name].sentence}: {material.notes[name]}"
        for material, name in used
        if name in material.notes
    ]
    return list(dict.fromkeys(shadows + notes))


def _about(results: list[Result], scene: Scene) -> list[str]:
    """Why something stands beside a headline, and why something is missing; one line for all that miss the same."""
    notes = [
        f"{result.name}: {NOMENCLATURE[result.name].note}"
        for result in results
        if result.value is not None
        and NOMENCLATURE[result.name].note
        and not (scene.is_identical and result.name == "rolling_frequency_no_slip")
    ]
    if not scene.is_identical and any(result.name == "n_grav" and result.value is not None for result in results):
        notes.append(
            "n_grav: is what the first contact, on body 2, carries; those between spheres 1 may roll before it"
        )
    notes += [
        f"{result.name}: relative error {result.error:.3g} against the exact moment of this contact"
        for result in results
        if result.error is not None
    ]
    reasons: dict[str, list[str]] = {}
    for result in results:
        if result.value is None:
            reasons.setdefault(result.reason, []).append(result.name)
    return notes + [f"{', '.join(names)}: {reason}" for reason, names in reasons.items()]
