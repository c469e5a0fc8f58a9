"""The answer of a command for one frame: its results, the inputs as understood, best ranges and limits."""

from collections.abc import Mapping
from contextlib import suppress
from copy import copy
from functools import cached_property
from math import isfinite
from types import MappingProxyType
from typing import Any, Self

from ..errors import JkrollError
from ..model.estimate import Estimate, Ranges
from ..model.frame import Frame
from ..model.limits import (
    CONTACT_EXCEEDS_SPHERE,
    LAW,
    LAW_MATTERS,
    ROUGH_MATTERS,
    Doubt,
    Limit,
    may_be_rough,
    touched,
)
from ..model.measured import SIO2, solid_of_pair
from ..model.other_law import at_half_spacing, factor_of_law, has_other_formulas
from ..model.reasons import (
    BEYOND_JKR,
    BEYOND_PULL_OFF,
    HELD_BY_MAUGIS,
    OF_IDENTICAL_SPHERES,
    Failure,
    MissingInput,
    explanation_of,
)
from ..model.results import ROW, Results, has_code
from ..model.uncertainty import ErrorBar, error_bars
from ..quantities.formatting import amount, in_words
from ..quantities.laws import BETWEEN, DEFAULT_LAW, MODELS
from ..quantities.nomenclature import INFINITY, NOMENCLATURE
from ..quantities.numeric import Numeric
from ..quantities.values import Uncertain, is_uncertain, middle
from .notes import assumed, entering
from .questions import Question

# --- Results ----------------------------------------------------------------------------------------------------------


class Result(Numeric):
    """A quantity in SI units, or the reason why it has no value; a text of it is rounded, as on a terminal.

    It counts as its number: `float(result)`, `result * 2`, `f"{result:.3g}"`, `result.to("nN")`.

    `code` is that of the reason, `error` the relative error of a model of the moment, `growth` the largest factor by
    which relative errors of measured values enter an inferred one.
    """

    def __init__(
        self,
        name: str,
        value: float | None,
        reason: str = "",
        code: str = "",  # of the reason
        error: float | None = None,
        growth: float | None = None,
        by_law: Mapping[str, float] = MappingProxyType({}),  # of an inferred value: what it is under the other laws
        bar: ErrorBar | None = None,  # if an input has one
        law: str = "",  # of attraction, if it is not JKR and gives the quantity in its own way or not at all
        of_law: str = "",  # the equation of the paper by which it does, or its source
    ) -> None:
        self.name, self.value, self.reason, self.code, self.error = name, value, reason, code, error
        self.growth, self.by_law, self.bar, self.law = growth, by_law, bar, law
        self.equation = of_law if law else NOMENCLATURE[name].equation

    def __repr__(self) -> str:
        return f"<{self.name}: {self}>"

    def __str__(self) -> str:
        return f"no value: {self.reason}" if self.measure is None else amount(self.name, self.measure)

    @property
    def unit(self) -> str:
        """The SI unit."""
        return NOMENCLATURE[self.name].unit

    @property
    def source(self) -> str:
        """The equation as a text: "Eq 6", or the source of the law."""
        return f"Eq {self.equation}" if self.equation.isdigit() else self.equation

    @property
    def uncertain(self) -> Uncertain | None:
        """The value with its error bar, if an input has one."""
        return self.bar.of(self.value) if self.bar is not None else None

    @property
    def measure(self) -> float | Uncertain | None:
        """The value, with its error bar if it has one."""
        return self.value if self.uncertain is None else self.uncertain


def without_value(name: str, error: JkrollError, law: str = "") -> Result:
    """Return a result without a value, for the reason that an error gives."""
    return Result(name, None, explanation_of(name, error), error.code, law=law)


def equation_of(frame: Frame, name: str) -> str:
    """Return the equation by which a law has a quantity: that of the paper, or the source of the law."""
    return NOMENCLATURE[frame.plan(name).name].equation or frame.law.source


_MOMENTS = ("yield_moment", "unloaded_moment", "half_circles_moment", "fixed_approach_moment")


def model_error(name: str, frame: Frame) -> float | None:
    """Return the relative error of a model; None for the exact one, for other quantities, and where one has no value.

    At a fixed load Eq (25) is exact; at a fixed approach, there is a term in ξ³ more.
    """
    exact_model = "fixed_approach_moment" if "approach_at_load" in frame.stated else "yield_moment"
    if name not in _MOMENTS or name == exact_model:
        return None
    values = frame.numbers(name, exact_model)
    if len(values) < 2:
        return None
    return float(abs(values[name] - values[exact_model]) / values[exact_model])


def with_force_by_maugis(error: Failure, frame: Frame) -> Failure:
    """Return the error of a load beyond pull-off by JKR, with the pull-off force of Maugis' law if that has one."""
    if not frame.law.is_default:
        return error
    other = frame.replace(model=BETWEEN)
    scenes = (other, at_half_spacing(other)) if frame.assumes_spacing else (other,)
    forces = [force for each in scenes for force in each.numbers("pull_off_force").values()]
    if len(forces) < len(scenes):
        return error
    cause = HELD_BY_MAUGIS if forces[0] >= -error.numbers[0] else BEYOND_JKR
    return Failure(cause, numbers=(*error.numbers, -max(forces)))


# --- Answers ----------------------------------------------------------------------------------------------------------


class Answer(Results):
    """The results of a command for one frame, with their best ranges and the limits of the model."""

    def __init__(self, question: Question, frame: Frame, *, keeps_all: bool = False) -> None:
        """Compute the quantities of a question as far as the frame allows."""
        super().__init__(frame, frame.shown(question.quantities, question.named), keeps_all=keeps_all)
        self.question = question

    @property
    def condition(self) -> float | None:
        """The condition number of two inferred inputs together."""
        return self.described.solution.condition if self.described.unknowns[1:] and self.failure is None else None

    @cached_property
    def reasons(self) -> Mapping[str, JkrollError]:
        """The errors that say why quantities have no value, by name."""
        return {name: error for name, error in self.errors().items() if name != ROW}

    @property
    def lacking(self) -> Mapping[str, JkrollError]:
        """The errors but for those of limits that end meaning, of which a warning tells."""
        return {name: error for name, error in self.reasons.items() if not has_code(error)}

    @property
    def explained(self) -> Self:
        """The answer with all that `--explain` derives: of inferred values the measured quantities, too."""
        measured = tuple(name for name in self.judged if name not in self.computed)
        if not measured or self.failure is not None:
            return self
        explained, forward = copy(self), type(self)(Question(measured, measured, measured), self.frame)
        forward.bars = {}  # they are those of the unknowns
        explained.results = (*self.results, *forward.results)
        return explained

    @property
    def has_no_headline(self) -> bool:
        """True if no quantity that the command is named after has a value."""
        return all(result.value is None for result in self.results if result.name in self.question.headline)

    @cached_property
    def measures(self) -> Mapping[str, float | str | Uncertain]:
        """The inputs that were stated or enter the results, as they were understood, with their error bars."""
        return {name: in_words(name, value) for name, value in self.inputs_shown([*self.columns]).items()}

    @cached_property
    def inputs(self) -> Mapping[str, float | str]:
        """The same without error bars."""
        return {name: middle(value) for name, value in self.measures.items()}

    @property
    def uncertain(self) -> Mapping[str, Uncertain]:
        """The inputs that are uncertain."""
        return {name: value for name, value in self.measures.items() if is_uncertain(value)}

    @cached_property
    def results(self) -> tuple[Result, ...]:
        """The quantities that are shown, with the reasons of those that have no value."""
        return tuple(map(self.result, self.columns))

    def result(self, name: str) -> Result:
        """Return a result. One without a value has no source: the definition of JKR is not what it lacks."""
        unknowns = self.described.unknowns
        law = "" if self.frame.law.is_default or name in unknowns else self.frame.law.name
        if name in self.reasons:
            return without_value(name, self.reasons[name], law)
        of_law = equation_of(self.frame, name) if law and has_other_formulas(self.frame, name) else ""
        error, bar = model_error(name, self.frame), self.bar(name)
        result = Result(name, self.values[name], error=error, bar=bar, law=law if of_law else "", of_law=of_law)
        if name in unknowns:
            growth = self.described.solution.growths[name]
            result.growth = growth if isfinite(growth) else None
            result.by_law = {law: middle(values[name]) for law, values in self.by_law.items()}
        return result

    def bar(self, name: str) -> ErrorBar | None:
        """Return the error bar of a result; None without one."""
        bar = self.bars.get(name)
        return bar if bar is not None and bar.sides else None

    @cached_property
    def ranges(self) -> Ranges:
        """The ranges that laws and measurements give."""
        return Ranges(self)

    @cached_property
    def estimates(self) -> Mapping[str, Estimate]:
        """The best ranges of results that have a value."""
        return {name: self.ranges.estimate(name) for name in self.ranges.names}

    @cached_property
    def of_jkr(self) -> Mapping[str, float]:
        """The values of JKR, to stand beside those of another law."""
        numbers = self.frame.under(DEFAULT_LAW).numbers(*(self.columns.keys() - self.ended.keys()))
        return {name: number for name, number in numbers.items() if number < INFINITY}

    @cached_property
    def by_law(self) -> Mapping[str, Mapping[str, Any]]:
        """Inferred values, with error bars, by each law that has the measured quantities by other formulas."""
        unknowns, found = self.described.unknowns, dict[str, Mapping[str, Any]]()
        if not unknowns or not self.values or self.ended:
            return found
        formulas = self.described.formulas_to(*unknowns)
        for law in MODELS:
            other = self.described.replace(model=law)
            with suppress(MissingInput):
                if other.formulas_to(*unknowns) != formulas and (values := other.numbers(*unknowns)):
                    bars = error_bars(other, values) if other.uncertainties else {}
                    found[law] = values | {name: bar.of(values[name]) for name, bar in bars.items() if bar.sides}
        return found

    @property
    def exceeded(self) -> list[Doubt]:
        """The limits of the model that do not hold.

        First those that end a meaning, that of a contact wider than its sphere before all; then those of the headline;
        then the others. Of each, those about a state, which is beyond a limit or not, are first, then those with a
        remedy, and then the one that is exceeded most.
        """
        return sorted((doubt for doubt in self.validity if doubt.is_exceeded), key=self._rank)

    def is_in_doubt(self, code: str) -> bool:
        """Return whether a code is that of a limit that does not hold."""
        return any(doubt.code == code for doubt in self.exceeded)

    def _rank(self, doubt: Doubt) -> tuple[bool, bool, bool, bool, bool, float]:
        limit = doubt.limit
        is_late = limit is not CONTACT_EXCEEDS_SPHERE, not limit.ends_meaning, not self._is_of_headline(limit)
        has_remedy = limit.has_remedy is not None and limit.has_remedy(self.frame)
        return *is_late, bool(limit.threshold), not has_remedy, -doubt.excess

    def _is_of_headline(self, limit: Limit) -> bool:
        """Return whether a limit concerns a quantity that the command is named after: a law, if it moves one.

        So does one that is of a result itself, such as of a force below 0.
        """
        if limit.name in limit.touches and limit.name in self.values:
            return True
        names = [name for name in self.values if name in self.question.headline]
        if limit is LAW:
            return bool(factor_of_law(self.frame, {name: self.columns[name] for name in names}) > LAW_MATTERS)
        return bool(touched(self.frame, names, [limit]))

    @cached_property
    def _entering(self) -> tuple[set[str], list[str]]:
        return entering(self.frame, [*self.judged])

    @cached_property
    def assumed(self) -> Mapping[str, str]:
        """The assumptions, each with the option that sets it, by name; the atomic spacing if it enters a limit."""
        texts = assumed(self.frame, self._entering[0], self._possible, has_values=True)
        return {name: text for name, text in texts.items() if name not in self.judged}

    @property
    def _possible(self) -> list[str]:
        return self.frame.possible(self.judged)

    @property
    def is_of_impact(self) -> bool:
        """True if the answer says whether spheres that collide stick."""
        return {"restitution", "sticking_speed"} <= self.values.keys()

    @property
    def shows_surfaces(self) -> bool:
        """True if a table has rows of what was measured on real surfaces: of SiO2, if its pull-off force is asked."""
        is_asked = "pull_off_force" in self.question.headline and not self.frame.stated_model
        return is_asked and self.is_in_doubt(ROUGH_MATTERS) and solid_of_pair(self.frame) == SIO2

    @property
    def is_on_pull_off(self) -> bool:
        """True if the question is the pull-off force alone, of which real surfaces may hold less."""
        is_alone = self.question.headline == ("pull_off_force",) and "pull_off_force" in self.values
        return is_alone and not self.frame.stated_model and bool(may_be_rough(self.frame))

    @cached_property
    def failure(self) -> JkrollError | None:
        """The reason why there is no result, or no contact."""
        for error in self.reasons.values():
            if isinstance(error, Failure) and not error.cause.has_contact:
                return with_force_by_maugis(error, self.frame) if error.cause == BEYOND_PULL_OFF else error
        if self.values or self.ended:  # what has no meaning is an answer
            return None
        return next(iter(self.reasons.values()), Failure(OF_IDENTICAL_SPHERES))
