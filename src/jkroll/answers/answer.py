"""The answer of a command for one scene: its results, the inputs as understood, limits and notes."""

from collections.abc import Mapping
from functools import cached_property
from types import MappingProxyType
from typing import TYPE_CHECKING, Any

from ..errors import JkrollError
from ..quantities.formatting import amount, in_words
from ..quantities.laws import BETWEEN, DEFAULT_LAW, LAWS, other_law
from ..quantities.nomenclature import INFINITY, NOMENCLATURE, XI
from ..quantities.values import middle
from ..scene.alternatives import factor_of_law, in_place_of, uses_law
from ..scene.failures import (
    BEYOND_PULL_OFF,
    HELD_BY_MAUGIS,
    OF_IDENTICAL_SPHERES,
    Failure,
    MissingInput,
    reason_of,
)
from ..scene.limits import ASSUMED_DISPLACEMENT, LIMITS, Doubt, Evaluation
from ..scene.scene import Scene
from .advice import about_doubt, displacement_in_full, over_this_law
from .notes import (
    Note,
    about_assumed,
    about_given,
    about_idle,
    about_limits,
    about_lost_contacts,
    about_missing,
    about_uncertainties,
    about_values,
    assumed,
    entering,
    idle_of,
)
from .questions import Question

if TYPE_CHECKING:
    from ..quantities.values import Uncertain
    from ..scene.uncertainty import Propagated
else:
    Propagated = object  # a quoted type would start Python's compiler, which costs a call a millisecond


# --- Results ----------------------------------------------------------------------------------------------------------


class Result:
    """A quantity in SI units, or the reason why it has no value; a text of it is rounded, as on a terminal.

    `error` is the relative error of a model of the moment, `condition` the factor by which an inferred value multiplies
    the relative error of a measured one, `growth` the largest factor by which those of two measured values enter it.
    """

    def __init__(
        self,
        name: str,
        value: float | None,
        reason: str = "",
        error: float | None = None,
        condition: float | None = None,
        growth: float | None = None,
        by_law: Mapping[str, float] = MappingProxyType({}),  # of an inferred value: what it is under the other laws
        propagated: Propagated | None = None,  # its uncertainty, if an input has one
        law: str = "",  # of attraction, if it is not JKR and gives the quantity in its own way or not at all
        of_law: str = "",  # the equation of the paper by which it does, or its source
    ) -> None:
        self.name, self.value, self.reason, self.error, self.condition = name, value, reason, error, condition
        self.growth, self.by_law, self.propagated, self.law, self.of_law = growth, by_law, propagated, law, of_law

    def __repr__(self) -> str:
        return f"<{self.name}: {self}>"

    def __str__(self) -> str:
        return f"no value: {self.reason}" if self.measure is None else amount(self.name, self.measure)

    @property
    def unit(self) -> str:
        """The SI unit."""
        return NOMENCLATURE[self.name].unit

    @property
    def equation(self) -> str:
        """The equation that gives the quantity, or the source of its law."""
        return self.of_law if self.law else NOMENCLATURE[self.name].equation

    @property
    def source(self) -> str:
        """The equation as a text: "Eq 6", or the source of the law."""
        return f"Eq {self.equation}" if self.equation.isdigit() else self.equation

    @property
    def uncertain(self) -> "Uncertain | None":
        """The value with its error bar, if an input has one."""
        return self.propagated.uncertainty if self.propagated is not None else None

    @property
    def measure(self) -> "float | Uncertain | None":
        """The value, with its error bar if it has one."""
        return self.value if self.uncertain is None else self.uncertain


def equation_of(scene: Scene, name: str) -> str:
    """Return the equation by which a law has a quantity: that of the paper, or the source of the law."""
    return NOMENCLATURE[scene.plan(name).name].equation or scene.law.source


_MOMENTS = ("yield_moment", "unloaded_moment", "half_circles_moment", "fixed_approach_moment")


def model_error(name: str, scene: Scene) -> float | None:
    """Return the relative error of a model; None for the exact one, for other quantities, and where one has no value.

    At a fixed load Eq (25) is exact; at a fixed approach, there is a term in ξ³ more.
    """
    exact_model = "fixed_approach_moment" if "approach_at_load" in scene.stated else "yield_moment"
    if name not in _MOMENTS or name == exact_model:
        return None
    values = scene.numbers(name, exact_model)
    if len(values) < 2:
        return None
    return float(abs(values[name] - values[exact_model]) / values[exact_model])


def with_force_by_maugis(error: Failure, scene: Scene) -> Failure:
    """Return the error of a load beyond pull-off, with the pull-off force of Maugis' law if that holds the load."""
    if not scene.law.is_default:
        return error
    force = scene.replace(model=BETWEEN).numbers("pull_off_force").get("pull_off_force", 0.0)
    return Failure(HELD_BY_MAUGIS, numbers=(*error.numbers, -force)) if force >= -error.numbers[0] else error


# --- Answers ----------------------------------------------------------------------------------------------------------


class Answer(Evaluation):
    """The results of a command for one scene, with all that is to be said of them."""

    limits = (*LIMITS, ASSUMED_DISPLACEMENT)
    condition: float | None = None  # of two inferred inputs together

    def __init__(self, question: Question, scene: Scene) -> None:
        """Compute the quantities of a question as far as the scene allows."""
        super().__init__(scene, scene.outcomes(question.quantities, question.named))
        self.question = question

    def value(self, name: str) -> float | None:
        """Return the value of a result, or None."""
        return next((result.value for result in self.results if result.name == name), None)

    @property
    def explained(self) -> "Answer":
        """The answer with all that `--explain` derives."""
        return self

    @property
    def has_no_headline(self) -> bool:
        """True if no quantity that the command is named after has a value."""
        return all(self.value(name) is None for name in self.question.headline)

    @cached_property
    def inputs(self) -> Mapping[str, float | str]:
        """The inputs on which the results depend, as they were understood."""
        given = self.inputs_of([*self.outcomes])
        return {name: in_words(name, middle(value)) for name, value in given.items()}

    @cached_property
    def uncertain(self) -> "Mapping[str, Uncertain]":
        """The inputs that are uncertain."""
        given = self.sources.given if self.sources is not None else {}
        return {name: value for name, value in given.items() if name in self.inputs}

    @property
    def measures(self) -> "Mapping[str, float | str | Uncertain]":
        """The inputs with their error bars."""
        return {**self.inputs, **self.uncertain}

    @cached_property
    def results(self) -> tuple[Result, ...]:
        """The quantities that are shown, with the reasons of those that have no value."""
        return tuple(map(self._result, self.outcomes))

    def _result(self, name: str) -> Result:
        """Return a result. One without a value has no source: the definition of JKR is not what it lacks."""
        law = "" if self.scene.law.is_default else self.scene.law.name
        if name in self.errors:
            return Result(name, None, reason_of(name, self.errors[name]), law=law)
        result = Result(name, self.values[name], error=model_error(name, self.scene), propagated=self.propagated(name))
        if law and uses_law(self.scene, name):
            result.law, result.of_law = law, equation_of(self.scene, name)
        return result

    def propagated(self, name: str) -> "Propagated | None":
        """Return the uncertainty of a result; None if it has none, or an error says why it has none."""
        bar = self.bars.get(name)
        return None if isinstance(bar, JkrollError) else bar

    @cached_property
    def laws(self) -> Mapping[str, Mapping[str, Any]]:
        """The results under the other law, and their distance from these."""
        if self.scene.missing(["tabor_parameter"]):
            return {}
        return over_this_law(self.scene, self.others.get(other_law(self.scene.law.name), {}))

    @cached_property
    def of_jkr(self) -> Mapping[str, float]:
        """The values of JKR, to stand beside those of another law."""
        numbers = self.scene.replace(model=DEFAULT_LAW).numbers(*self.outcomes)
        return {name: number for name, number in numbers.items() if number < INFINITY}

    @cached_property
    def displacement(self) -> Mapping[str, Any] | None:
        """The worth of the assumed displacement for the results, as far as forces were measured."""
        return displacement_in_full(self.scene, [*self.values]) if XI in self.inputs else None

    @cached_property
    def others(self) -> Mapping[str, Mapping[str, Any]]:
        """Values that may stand in place of the results, by kind: the name of the other law, or DATA."""
        return in_place_of(self.scene, [*self.outcomes]) if self.values else {}

    @cached_property
    def alternatives(self) -> Mapping[str, Mapping[str, Any]]:
        """Those of these values that matter: by the other law where it moves a result, and by measured forces."""
        law_matters = any(doubt.is_exceeded for doubt in self.validity if doubt.limit.factor is factor_of_law)
        is_shown = law_matters or self.scene.law.name == BETWEEN
        return {kind: values for kind, values in self.others.items() if is_shown or kind not in LAWS}

    def doubts(self) -> list[Note]:
        """Return a note for each limit of the model that does not hold, the one that is exceeded most first."""
        return [Note("warning" if doubt.limit.ends_meaning else "caveat", self.about(doubt)) for doubt in self.exceeded]

    @property
    def exceeded(self) -> list[Doubt]:
        """The limits of the model that do not hold, the one that is exceeded most first."""
        return sorted((doubt for doubt in self.validity if doubt.is_exceeded), key=lambda doubt: -doubt.excess)

    def about(self, doubt: Doubt) -> str:
        """Return what follows from a limit for these results, with the values that may stand in their place."""
        headline = [name for name in self.values if name in self.question.headline]
        return about_doubt(doubt, self.scene, headline, [*self.values])

    @cached_property
    def _entering(self) -> tuple[set[str], set[str]]:
        return entering(self.scene, [*self.outcomes])

    @cached_property
    def assumed(self) -> Mapping[str, str]:
        """The assumptions, each with the option that sets it, by name; the atomic spacing if it enters a limit."""
        return assumed(self.scene, self._entering[0], self._possible)

    @property
    def _possible(self) -> list[str]:
        return [name for name in self.outcomes if not isinstance(self.errors.get(name), MissingInput)]

    @cached_property
    def notes(self) -> tuple[Note, ...]:
        """The sentences about the answer, but for doubts."""
        scene, known = self.scene, [*self.values]
        inputs, needed = self._entering
        notes = (
            *about_assumed(self.assumed),
            *about_given(scene, self._possible, inputs),
            *about_idle(idle_of(scene, needed)),
            *about_values(scene, known),
            *about_missing(self.errors),
            *about_limits(self.validity),
        )
        if self.sources is None:
            return notes
        lost = about_lost_contacts(scene, self.bars, self.sources) if "load" in self.inputs else ()
        return (*notes, *about_uncertainties(self.bars, self.sources), *lost)

    @cached_property
    def failure(self) -> JkrollError | None:
        """The reason why there is no result, or no contact."""
        for error in self.errors.values():
            if isinstance(error, Failure) and not error.kind.has_contact:
                return with_force_by_maugis(error, self.scene) if error.kind == BEYOND_PULL_OFF else error
        return None if self.values else next(iter(self.errors.values()), Failure(OF_IDENTICAL_SPHERES))
