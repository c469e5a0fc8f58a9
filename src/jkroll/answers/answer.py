"""The answer of a command for one scene: its results, the inputs as understood, limits and notes."""

from collections.abc import Callable, Collection, Mapping
from types import MappingProxyType
from typing import TYPE_CHECKING, Any, Literal, NamedTuple

from ..errors import JkrollError, NoResult
from ..physics.jkr import STICKING
from ..quantities.formatting import Format, amount, in_words, uncertain_amount
from ..quantities.nomenclature import INFINITY, NOMENCLATURE
from ..scene.errors import BeyondFold, BeyondPullOff, MissingInput
from ..scene.laws import DEFAULT_LAW
from ..scene.limits import IMPACT, LIMIT_NAMES, Judgement, Verdict, judged, of_any_scene, sentence, uses_spacing
from ..scene.rolling_models import model_error
from ..scene.scene import DEFAULTS, NO_UNCERTAINTY, Scene
from ..scene.wiring import STATE, depends_on
from .comparison import (
    BETWEEN,
    Difference,
    at_equal_hysteresis,
    differences,
    equation_of,
    held_otherwise,
    of_jkr,
    uncertain_sticking,
    uses_law,
    with_differences,
    without_contact,
)
from .questions import Question

MOST_NAMES = 3  # of quantities in a note
if TYPE_CHECKING:
    from ..quantities.uncertain import Uncertain
    from ..scene.uncertainty import Propagated, Sources


class Result(NamedTuple):
    """A quantity in SI units, or the reason why it has no value.

    `error` is the relative error of a model of the moment, `condition` the factor by which an inferred value multiplies the
    relative error of a measured one. A quantity of another law of attraction than JKR says which, and has JKR's value beside
    it.
    """

    name: str
    value: float | None
    reason: str = ""
    error: float | None = None
    model: str = ""  # the law of attraction, if it is another than JKR
    equation: str = ""  # of that law
    jkr: float | None = None  # the value of JKR, beside that of another law
    condition: float | None = None
    by_law: Mapping[str, float] = MappingProxyType({})  # of an inferred value: what it would be under the other laws
    propagated: "Propagated | None" = None  # its uncertainty, if an input has one

    def sides(self) -> dict[str, float]:
        """Return the numbers of the uncertainty by name: minus and plus, or low and high; none if there is no uncertainty."""
        if self.propagated is None:
            return {}
        return {
            side: number
            for side, number in self.propagated.uncertainty.as_object().items()
            if isinstance(number, float)
        }


class Note(NamedTuple):
    """A sentence about an answer."""

    kind: Literal["material", "missing", "doubt", "result", "model", "assumption", "unchecked", "data"]
    text: str
    matter: str = ""  # the same for all scenes that have such a note; by default the text


class Answer(NamedTuple):
    """The results of a command for one scene."""

    inputs: Mapping[str, float | str]
    results: tuple[Result, ...]
    notes: tuple[Note, ...]
    validity: tuple[Verdict, ...]
    failure: JkrollError | None  # why there is no result, or no contact
    laws: tuple[Difference, ...] = ()  # how Maugis' law differs from JKR
    uncertain: Mapping[str, "Uncertain"] = NO_UNCERTAINTY  # the inputs that are uncertain

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
            results.append(Result(name, None, _reason(name, value)))
        elif name == "sticking_energy" and (reason := uncertain_sticking(scene)):
            results.append(Result(name, None, reason))
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
        *_about_results(results, scene),
        *_about_missing(results, errors),
        *_about_limits(limits),
    )
    fatal = next((error for error in errors.values() if isinstance(error, _FATAL)), None)
    if isinstance(fatal, BeyondPullOff):
        fatal = held_otherwise(fatal, scene)
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
            failures.setdefault(_reason(name, one), []).append(name)
    notes = [
        Note("missing", f"{_few(names)}: no uncertainty, as there is no value at an end of an input: {reason}")
        for reason, names in failures.items()
    ]
    for source in sources.left_out:
        reason = (
            "is a range, which is left out beside ±" if source.given.kind == "range" else "is left out beside a range"
        )
        notes.append(
            Note("result", f"{uncertain_amount(source.names[0], source.given)} of {_symbol(source.names[0])} {reason}")
        )
    entering = sources.entering
    stated = {name: source.given for source in entering for name in source.names if name in answer.inputs}
    return answer._replace(results=tuple(results), notes=(*answer.notes, *notes), uncertain=stated)


def _with_law(results: list[Result], scene: Scene) -> list[Result]:
    """Return results that say of which law they are, with the values of JKR beside them."""
    beside = of_jkr(scene, [result.name for result in results])
    return [
        result._replace(model=scene.law.name, equation=equation_of(scene, result.name), jkr=beside.get(result.name))
        if result.value is not None and uses_law(scene, result.name)
        else result
        for result in results
    ]


# Errors that leave nothing of a scene to be trusted, even where something could be computed.
_FATAL = (BeyondPullOff, BeyondFold)


def _reason(name: str, error: MissingInput | NoResult) -> str:
    """Return why a quantity has no value, without its name."""
    if isinstance(error, MissingInput):
        return f"needs {error.needs()}"
    return error.reason() if error.name == name else str(error)


def in_units(answer: Answer, form: Format) -> Answer:
    """Return an answer without the values that are out of the range of doubles in their unit."""
    results = tuple(_in_unit(result, form) for result in answer.results)
    return answer._replace(results=results)


def _in_unit(result: Result, form: Format) -> Result:
    if not result.value or 0 < abs(form.number(result.name, result.value)) < INFINITY:
        return result
    return result._replace(value=None, reason=f"no value in {form.unit(result.name)} that a double can hold")


# The quantities that are shown for some scenes only.
_SHOWN_IF: Mapping[str, Callable[[Scene], bool]] = {
    "rolling_frequency_as_printed": lambda scene: scene.is_identical and scene.law.name == DEFAULT_LAW,
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


def concerns(name: str, scene: Scene) -> bool:
    """Return whether a quantity is shown for this scene."""
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


def assumptions(scene: Scene, inputs: Collection[str], names: list[str]) -> list[Note]:
    """Return notes on the inputs that were assumed, with the options that set them."""
    assumed = [
        f"{NOMENCLATURE[name].symbol} = {amount(name, DEFAULTS[name])} ({NOMENCLATURE[name].option})"
        for name in DEFAULTS
        if name in inputs and name not in scene.given
    ]
    steps = {step.name for name in names for step in scene.plan(name).steps}
    notes = [Note("assumption", f"assumed {', '.join(assumed)}")] if assumed else []
    if (
        "work_of_adhesion" in steps
        and scene.given.get("surface_energy2", 0) != scene.given.get("surface_energy")
        and "surface_energy2" in inputs
    ):
        text = "w = 2√(γ1γ2) by the geometric mixing rule; a measured one is better (--work-of-adhesion)"
        notes.append(Note("assumption", text))
    return notes


def about_data(scene: Scene, inputs: Collection[str]) -> list[Note]:
    """Return notes on the material data that were used, those on shadowed materials first."""
    used = scene.data_used(inputs)
    shadows = [Note("material", f"{material.name}: {text}") for material, _ in used for text in material.remarks]
    remarks = [
        Note("data", f"{material.name}: {NOMENCLATURE[name].sentence}: {material.notes[name]}")
        for material, name in used
        if name in material.notes
    ]
    return [*dict.fromkeys(shadows + remarks)]


def _about_results(results: list[Result], scene: Scene) -> list[Note]:
    """Return notes on the values: why one stands beside a headline, what it counts, how exact its model is."""
    known = [result for result in results if result.value is not None]
    remarks: dict[str, list[str]] = {}
    for result in known:
        is_implied = scene.is_identical and result.name == "rolling_frequency_no_slip"
        if NOMENCLATURE[result.name].note and not is_implied:
            remarks.setdefault(NOMENCLATURE[result.name].note, []).append(_symbol(result.name))
    texts = [f"{', '.join(symbols)}: {remark}" for remark, symbols in remarks.items()]
    names = {result.name for result in known}
    if "n_grav" in names and not scene.is_identical:
        texts.append(f"N_grav is what the first contact, on body 2, carries; {_between_spheres_1(scene)}")
    if "n_roll" in names and IMPACT.isdisjoint(scene.stated):
        texts.append(f"W0 = P_cδ0 is {1 / STICKING:.3g} U_stick, the largest energy that sticks")
    texts += [at_equal_hysteresis(scene)] if "yield_moment" in names else []
    texts += [without_contact(scene)] if "contact_radius_at_load" in names else []
    notes = [Note("result", text) for text in filter(None, texts)]
    errors = ", ".join(f"{_symbol(result.name)} by {100 * result.error:.2g} %" for result in known if result.error)
    return [*notes, Note("model", f"off the exact moment of this contact: {errors}")] if errors else notes


def _between_spheres_1(scene: Scene) -> str:
    """Return a clause on the contacts between the spheres of a chain that hangs from another body."""
    stated = {name: value for name, value in scene.stated.items() if not name.endswith("2")}
    try:
        carried = (
            Scene(stated, scene.material, model=scene.stated_model)["n_grav"] + 1
        )  # the chain that it carries is a sphere shorter
    except (MissingInput, NoResult):
        return "those between spheres 1 may roll before it"
    if carried < scene["n_grav"]:
        return f"the one between spheres 1 next to it yields before it, at {carried:.4g}"
    return "those between spheres 1 carry more"


def _about_limits(limits: Judgement) -> list[Note]:
    """Return a note for the limits of the model that could not be judged."""
    return [
        Note("unchecked", f"not checked: {', '.join(map(_symbol, names))}: needs {needs}")
        for needs, names in limits.missing.items()
    ]


def _about_missing(results: list[Result], errors: Mapping[str, JkrollError]) -> list[Note]:
    """Return a note for each reason why values are missing, with the names of all that it concerns.

    Values that lack the same inputs have one note, though some of them may be had in another way too.
    """
    groups: dict[object, list[Result]] = {}
    for result in results:
        if result.value is None:
            error = errors.get(result.name)
            groups.setdefault(error.missing if isinstance(error, MissingInput) else result.reason, []).append(result)
    notes = []
    for group in groups.values():
        names = [result.name for result in group]
        reason = min((result.reason for result in group), key=len)
        notes.append(Note("missing", f"{_few(names)}: {reason}", " ".join(names)))
    return notes


def _few(names: list[str]) -> str:
    """Return the symbols of the first names of a list, and how many more there are."""
    rest = len(names) - MOST_NAMES
    return ", ".join(map(_symbol, names[:MOST_NAMES])) + (f" and {rest} more" if rest > 0 else "")


def _symbol(name: str) -> str:
    return NOMENCLATURE[name].symbol or name
