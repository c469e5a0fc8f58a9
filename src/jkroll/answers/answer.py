"""The answer of a command for one scene: its results, the inputs as understood, limits and notes.

Where the law of attraction is in doubt, its results stand beside those of Maugis' law, which holds there.
"""

from collections.abc import Mapping, Sequence
from functools import cached_property
from math import log
from typing import TYPE_CHECKING, NamedTuple

from ..errors import JkrollError, NoResult
from ..quantities.formatting import Format, amount, in_words
from ..quantities.laws import BETWEEN, LAWS
from ..quantities.nomenclature import INFINITY, NOMENCLATURE, XI
from ..rows.columns import outcomes
from ..scene.effects import Effect, between_of
from ..scene.failures import (
    BeyondPullOff,
    MissingInput,
    NoContact,
    OfIdenticalSpheres,
    RestsOnSpacing,
    reason_of,
)
from ..scene.limits import JUMP, LEAST_EFFECT, Judgement, Verdict, against_limit, judged, not_judged, sentence
from ..scene.scene import Scene
from ..scene.wiring import depends_on
from .notes import (
    about_given,
    about_limits,
    about_lost_contacts,
    about_missing,
    about_results,
    about_uncertainties,
    assumed,
    model_error,
    with_limits,
    with_spacing,
)
from .questions import Question
from .results import Note, NoValue, Result, at_half_spacing, over_spacing, propagated_of, with_law

if TYPE_CHECKING:
    from ..quantities.values import Uncertain
    from ..scene.uncertainty import Propagated, Sources
    from .displacement import Worth

_DECIMALS = 9  # decimals of a logarithm, beyond which equal differences may differ by rounding
_LARGE = log(1.25)  # difference that is told beside both readings of a larger one
_NO_CHANGE = 0.005  # relative change that is no per cent
# Below the Tabor parameter of a jump, a well of Lennard-Jones is deeper still than Maugis', and to the energies of jumps his law is no
# correction as it is to forces.
_OF_WELL = ("well_energy", "pull_off_work", "disruption_energy", "disruption_speed")
_OF_JUMPS = ("pull_off_work_at_dead_load", "sticking_energy", "sticking_speed")
_MATTERS = 0.05  # relative change with the atomic spacing that is shown
_BESIDE = 0.02  # relative difference of Lennard-Jones' law from Maugis' that is shown


class Difference(NamedTuple):
    """A quantity under Maugis' law, over that of the law in use, with the assumed atomic spacing and with half of it."""

    name: str
    value: float
    ratio_at_half_spacing: float
    effect: Effect

    @property
    def size(self) -> float:
        """The size of the difference, by the larger reading, as the logarithm of a factor."""
        return log(self.effect.factor)


def differences(scene: Scene, found: Mapping[str, Effect]) -> tuple[Difference, ...]:
    """Return how quantities of a scene differ under Maugis' law, the largest difference first; of equal ones that which was asked first."""
    if not found:
        return ()
    between = between_of(scene)
    at_spacing, at_half = between.numbers(*found), at_half_spacing(between).numbers(*found)
    differ = [
        Difference(name, at_spacing[name], at_half[name] / scene[name], effect)
        for name, effect in found.items()
        if effect.ratio > 0 and scene[name] and at_half.get(name)
    ]
    return tuple(sorted(differ, key=lambda each: -round(each.size, _DECIMALS)))


def with_differences(verdict: Verdict, found: Sequence[Difference], scene: Scene) -> Verdict:
    """Return a verdict with what Maugis' law says in place of a doubt about the law in use."""
    if verdict.holds:
        return verdict
    if verdict.name == "tabor_parameter" and not verdict.conclusion:
        lead = f"{scene.law.title} is inexact here (Tabor parameter μ = {verdict.value:.3g})"
        has_jump = verdict.value >= JUMP
        corrected = [each for each in found if has_jump or each.name not in _OF_JUMPS]
        if corrected:
            text = _sentence(corrected, scene, has_jump=has_jump)
            return verdict._replace(text=text, sentence=f"{lead}: {text}", size=corrected[0].size)
        if found:
            text = f"{LAWS[BETWEEN].title} is no better for energies of jumps"
            return verdict._replace(text=text, sentence=f"{lead}; {text}")
    if verdict.name == "hysteresis_ratio" and scene.law.is_default:
        between = scene.replace(model=BETWEEN).numbers("zone_radius").get("zone_radius")
        if between is not None:
            ratio = verdict.value * (scene["zone_radius"] / between)
            return verdict._replace(text=f"{verdict.text}; {ratio:.3g} for this moment by Maugis' law")
    return verdict


def _sentence(found: Sequence[Difference], scene: Scene, *, has_jump: bool) -> str:
    """Return the largest differences: "by Maugis–Dugdale P_c is 27 % larger"; of rolling quantities both readings.

    `has_jump`: whether a contact of Lennard-Jones' law jumps; if not, its well is deeper still.
    """
    spacing = amount("atomic_spacing", scene["atomic_spacing"] / 2)
    parts = []
    least = _LARGE if found[0].effect.readings else _NO_CHANGE
    rest = [one for one in found[1:] if one.size >= least and not one.effect.readings]
    for name, _, at_half, effect in [found[0], *rest[:1]]:
        symbol = NOMENCLATURE[name].symbol
        if effect.readings:
            at_displacement, at_hysteresis = map(_change, effect.readings)
            parts.append(f"{symbol} is {at_displacement} at equal ξ and {at_hysteresis} at equal hysteresis")
            continue
        matters = abs(at_half / effect.ratio - 1) > _MATTERS
        beside = [f"{_change(at_half, effect.ratio)} at z0 = {spacing}"] if matters else []
        if effect.lennard_jones is not None and abs(effect.lennard_jones / effect.ratio - 1) > _BESIDE:
            beside.append(f"{_change(effect.lennard_jones, effect.ratio)} by Lennard-Jones")
        in_brackets = f" ({', '.join(beside)})" if beside and not found[0].effect.readings else ""
        at_least = "" if has_jump or name not in _OF_WELL else "at least "
        parts.append(f"{symbol} is {at_least}{_change(effect.ratio)}{in_brackets}")
    return f"by {LAWS[BETWEEN].title} {', '.join(parts)}; --model {BETWEEN}"


def _change(ratio: float, beside: float = 0.0) -> str:
    """Return a ratio in words: "27 % larger", "3.2 times as large"; without the words beside a ratio that has the same."""
    if abs(ratio - 1) < _NO_CHANGE:
        return "within 0.5 %"
    if not _is_share(ratio):
        return f"{ratio:.2g} times as large"
    text = f"{100 * abs(ratio - 1):.0f} %"
    has_same = _is_share(beside) and (ratio > 1) == (beside > 1)
    return text if has_same else f"{text} {'larger' if ratio > 1 else 'smaller'}"


def _is_share(ratio: float) -> bool:
    """Return whether a ratio is told in per cent."""
    return 0.1 < ratio < 2


def with_force_by_maugis(error: BeyondPullOff, scene: Scene) -> BeyondPullOff:
    """Return the error of a load beyond pull-off, with the pull-off force of Maugis' law if that holds the load."""
    if not scene.law.is_default:
        return error
    force = scene.replace(model=BETWEEN).numbers("pull_off_force").get("pull_off_force", 0.0)
    return BeyondPullOff(error.load, error.least, -force) if force >= -error.load else error


# --- Answers ----------------------------------------------------------------------------------------------------------


class Answer:
    """The results of a command for one scene. Each part is computed when something shows it."""

    condition: float | None = None  # of two inferred inputs together

    def __init__(self, question: Question, scene: Scene) -> None:
        """Compute the quantities of a question as far as the scene allows."""
        self.question, self.scene = question, scene
        self.outcomes = outcomes(scene, question.quantities, question.named)
        self.shown = [*self.outcomes]
        self.errors: dict[str, MissingInput | NoResult] = {
            name: one for name, one in self.outcomes.items() if isinstance(one, MissingInput | NoResult)
        }

    def value(self, name: str) -> float | None:
        """Return the value of a result, or None."""
        return next((result.value for result in self.results if result.name == name), None)

    @property
    def explained(self) -> "Answer":
        """The answer with all that `--explain` derives."""
        return self

    def writable(self, form: Format) -> "Answer":
        """Take the values that no double holds in their unit from the results, and return the answer."""
        self.results = tuple(result.in_unit(form) for result in self.results)
        return self

    @property
    def has_no_headline(self) -> bool:
        """True if no quantity that the command is named after has a value."""
        return all(self.value(name) is None for name in self.question.headline)

    @cached_property
    def inputs(self) -> Mapping[str, float | str]:
        """The inputs on which the results depend, as they were understood."""
        used = self.scene.inputs_used(self.question.quantities, self.shown)
        return {name: in_words(name, value) for name, value in self.scene.echo(used).items()}

    @cached_property
    def results(self) -> tuple[Result, ...]:
        """The quantities that are shown, with the reasons of those that have no value."""
        scene = self.scene
        plain = [
            Result(name, None, self._reason(name, self.errors[name]))
            if name in self.errors
            else Result(name, self.outcomes[name], error=model_error(name, scene))
            for name in self.shown
        ]
        results = plain if scene.law.is_default else with_law(plain, scene)
        found, _ = self._uncertainties
        return tuple(result._replace(propagated=propagated_of(found, result.name)) for result in results)

    def _reason(self, name: str, error: MissingInput | NoResult) -> str:
        return over_spacing(name, self.scene) if isinstance(error, RestsOnSpacing) else reason_of(name, error)

    @cached_property
    def _known(self) -> list[str]:
        return [name for name in self.shown if name not in self.errors]

    @cached_property
    def _uncertainties(self) -> "tuple[Mapping[str, Propagated | JkrollError], Sources | None]":
        if not self.scene.is_uncertain:
            return {}, None
        from ..scene.uncertainty import uncertainties

        return uncertainties(self.scene, self.shown)

    @cached_property
    def uncertain(self) -> "Mapping[str, Uncertain]":
        """The inputs that are uncertain."""
        _, sources = self._uncertainties
        given = sources.given if sources is not None else {}
        return {name: one for name, one in given.items() if name in self.inputs}

    @cached_property
    def laws(self) -> tuple[Difference, ...]:
        """The differences of Maugis' law from the law in use, of what the command is named after."""
        compared = (*self.question.headline, *self.question.also_by_maugis)
        found = self._judgement.effects
        return differences(self.scene, {name: effect for name, effect in found.items() if name in compared})

    @cached_property
    def worth(self) -> "Worth | None":
        """The worth of the assumed displacement for these results."""
        if XI not in self.inputs:
            return None
        from .displacement import worth  # most answers rest on no ξ, or on one that was given

        return worth(self.scene, self._known)

    @cached_property
    def _judgement(self) -> Judgement:
        return judged(self.scene, self._known)

    @cached_property
    def validity(self) -> tuple[Verdict, ...]:
        """The limits of the model, with what follows from them for these results."""
        verdicts = self._judgement.verdicts
        if all(verdict.holds for verdict in verdicts):
            return verdicts
        found = self.laws
        if not any(each.effect.factor > LEAST_EFFECT for each in found):
            found = differences(self.scene, self._judgement.effects)
        return tuple(with_differences(each, found, self.scene) for each in verdicts)

    def doubts(self) -> list[Note]:
        """Return a note for each limit of the model that does not hold."""
        return [
            Note("doubt", sentence(one), against_limit(one), bool(one.sentence), one.size)
            for one in sorted(self.validity, key=lambda one: -one.size)
            if not one.holds
        ]

    @property
    def width(self) -> float:
        """The size of the smallest error bar of the results, as the logarithm of a factor: no smaller doubt matters to any of them."""
        return min(map(_width, self.results), default=0.0)

    @cached_property
    def _of_limits(self) -> Sequence[str]:
        return self.scene.inputs_of(*(verdict.name for verdict in self.validity))

    @cached_property
    def _entering(self) -> set[str]:
        """The inputs of the results, with the atomic spacing if it enters a limit."""
        return with_spacing(self.inputs, self._of_limits)

    @cached_property
    def assumed(self) -> list[str]:
        """The names of inputs that were assumed, with the atomic spacing if it enters a limit."""
        return assumed(self.scene, self._entering)

    @cached_property
    def notes(self) -> tuple[Note, ...]:
        """The sentences about the answer, but for doubts."""
        scene = self.scene
        possible = [name for name in self.shown if not isinstance(self.errors.get(name), MissingInput)]
        found, sources = self._uncertainties
        lacking = [name for name, error in self.errors.items() if isinstance(error, MissingInput)]
        unjudged = not_judged(scene, self._known)
        lacking += [name for names in unjudged.values() for name in names]
        displaced = [] if self.worth is None else [self.worth.note(self.question.headline)]
        entering = with_limits(self.inputs, self._of_limits) | depends_on(lacking, [scene.law.name])
        return (
            *about_given(scene, possible, self._entering, entering, displaced),
            *about_results([*self.results], scene, self.question.noted),
            *about_missing([*self.results], self.errors),
            *about_limits(unjudged),
            *(about_uncertainties(found, sources) if sources is not None else ()),
            *(about_lost_contacts(scene, sources) if sources is not None and self._has_bars_at_load else ()),
        )

    @property
    def _has_bars_at_load(self) -> bool:
        """True if results that depend on the load have error bars, all of them."""
        found, _ = self._uncertainties
        return "load" in self.inputs and bool(found) and not any(isinstance(one, JkrollError) for one in found.values())

    @cached_property
    def failure(self) -> JkrollError | None:
        """The reason why there is no result, or no contact."""
        fatal = next((error for error in self.errors.values() if isinstance(error, NoContact)), None)
        if fatal is not None:
            return with_force_by_maugis(fatal, self.scene) if isinstance(fatal, BeyondPullOff) else fatal
        if self._known:
            return None
        name, error = next(iter(self.errors.items()), ("", OfIdenticalSpheres()))
        return NoValue(name, self._reason(name, error)) if isinstance(error, RestsOnSpacing) else error


def _width(result: Result) -> float:
    """Return the larger side of a result's error bar as the logarithm of a factor; 0 without one."""
    found = result.propagated.uncertainty if result.propagated is not None else None
    if found is None or not (found.low > 0 and found.high < INFINITY):
        return 0.0
    return max(log(found.value / found.low), log(found.high / found.value))
