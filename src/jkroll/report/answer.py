"""The answer of a command for one frame: its results, the inputs as understood, best ranges and limits."""

from collections.abc import Mapping, Sequence
from contextlib import suppress
from functools import cached_property
from math import isfinite
from typing import Any

from ..errors import JkrollError
from ..model.estimate import ANY_LAW, DEFINITION, NONE, WORDS, Ends, Estimate, Ranges
from ..model.frame import Frame, itself
from ..model.limits import (
    CONTACT_EXCEEDS_SPHERE,
    LAW,
    LAW_MATTERS,
    Doubt,
    Limit,
    concerning,
    may_be_rough,
)
from ..model.measured import on_surfaces
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
from ..quantities.formatting import AS_USUAL, Format, amount, in_words
from ..quantities.laws import BETWEEN, DEFAULT_LAW, MODELS
from ..quantities.nomenclature import INFINITY, NOMENCLATURE
from ..quantities.numeric import Numeric
from ..quantities.values import Uncertain, is_uncertain, middle
from .notes import assumed, entering
from .questions import Question

_NO_RANGE_NEEDED = (NONE, DEFINITION, ANY_LAW)  # rules for which the value of the law in use suffices

# --- Results ----------------------------------------------------------------------------------------------------------


class Result(Numeric):
    """A quantity in SI units, or the reason why it has no value; `str` rounds it as on a terminal.

    A result acts as its number: `float(result)`, `result * 2`, `f"{result:.3g}"`, `result.to("nN")`.

    `error` is the relative error of an approximate moment. `growth` is the largest factor by which the relative error
    of a measured value grows in an inferred one.
    """

    def __init__(
        self,
        name: str,
        value: float | None,
        reason: str = "",
        code: str = "",  # the code of the reason
        error: float | None = None,
        bar: ErrorBar | None = None,  # the uncertainty, if an input has one
        law: str = "",  # the law of attraction; empty for JKR, for a formula that JKR shares, and for inferred values
        equation: str = "",  # with a `law`: the number of the equation in the paper, or the source of the law
    ) -> None:
        self.name, self.value, self.reason, self.code, self.error = name, value, reason, code, error
        self.bar, self.law = bar, law
        self.equation = equation if law else NOMENCLATURE[name].equation
        self.growth: float | None = None  # of an inferred value only, as is `by_law`
        self.by_law: Mapping[str, float] = {}  # the value by each other law

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
        """The equation as a text, "Eq 6", or the source of the law; empty if JKR's formula is not in the paper."""
        return f"Eq {self.equation}" if self.equation.isdigit() else self.equation

    @property
    def uncertain(self) -> Uncertain | None:
        """The value with its uncertainty, if an input has one."""
        return self.bar.of(self.value) if self.bar is not None else None

    @property
    def measure(self) -> float | Uncertain | None:
        """The value, with its uncertainty if it has one."""
        uncertain = self.uncertain
        return self.value if uncertain is None else uncertain


def without_value(name: str, error: JkrollError, law: str = "") -> Result:
    """Return a result without a value; the error gives the reason."""
    return Result(name, None, explanation_of(name, error), error.code, law=law)


def equation_of(frame: Frame, name: str) -> str:
    """Return the number of a quantity's equation in the paper; without one, the source of the law."""
    return NOMENCLATURE[frame.plan(name).name].equation or frame.law.source


_MOMENTS = ("yield_moment", "unloaded_moment", "half_circles_moment", "fixed_approach_moment")


def model_error(name: str, frame: Frame) -> float | None:
    """Return the relative error of an approximate moment; None for the exact moment and for other quantities.

    At a fixed load the exact moment is that of Eq (25). At a fixed approach it has a further term in ξ³.
    """
    exact_model = "fixed_approach_moment" if "approach_at_load" in frame.stated else "yield_moment"
    if name not in _MOMENTS or name == exact_model:
        return None
    values = frame.numbers(name, exact_model)
    if len(values) < 2:
        return None
    return float(abs(values[name] - values[exact_model]) / values[exact_model])


def with_force_by_maugis(error: Failure, frame: Frame) -> Failure:
    """Return the error for a load beyond pull-off; under JKR, with Maugis' pull-off force if that is known."""
    if not frame.law.is_default:
        return error
    by_maugis = frame.replace(model=BETWEEN)
    variants = [by_maugis]
    if frame.assumes_spacing:
        variants.append(at_half_spacing(by_maugis))
    forces: list[float] = []
    for variant in variants:
        forces += variant.numbers("pull_off_force").values()
    if len(forces) < len(variants):
        return error
    load, *_ = error.numbers
    cause = HELD_BY_MAUGIS if forces[0] >= -load else BEYOND_JKR
    return Failure(cause, numbers=(*error.numbers, -max(forces)))


def _measures(frame: Frame, names: Sequence[str]) -> dict[str, Any]:
    """Return the values of quantities, with their uncertainties."""
    values = frame.numbers(*names)
    if not values or not frame.uncertainties:
        return values
    bars = error_bars(frame, values)
    return values | {name: bar.of(values[name]) for name, bar in bars.items() if bar.sides}


# --- Answers ----------------------------------------------------------------------------------------------------------


class Answer(Results):
    """The results of a command for one frame, with their best ranges and the limits of the model."""

    def __init__(self, question: Question, frame: Frame, *, keeps_all: bool = False, form: Format = AS_USUAL) -> None:
        """Compute the quantities of a question, as far as the frame allows.

        `form`: the units and digits of sentences.
        """
        super().__init__(frame, frame.shown(question.quantities, question.named), keeps_all=keeps_all)
        self.question, self.form = question, form

    @property
    def condition(self) -> float | None:
        """The condition number of a pair of inferred inputs; None without a pair."""
        is_pair = len(self.described.unknowns) > 1
        return self.described.solution.condition if is_pair and self.failure is None else None

    @cached_property
    def reasons(self) -> Mapping[str, JkrollError]:
        """The errors of quantities without a value, by name."""
        return {name: error for name, error in self.errors().items() if name != ROW}

    @property
    def lacking(self) -> Mapping[str, JkrollError]:
        """The errors of quantities without a value, except results that a warning reports as meaningless."""
        return {name: error for name, error in self.reasons.items() if not has_code(error)}

    @property
    def has_no_headline(self) -> bool:
        """True if no quantity of the headline has a value."""
        return all(result.value is None for result in self.results if result.name in self.question.headline)

    @cached_property
    def input_measures(self) -> Mapping[str, float | str | Uncertain]:
        """The inputs that were stated or enter the results, as understood, with their uncertainties."""
        return {name: in_words(name, value) for name, value in self.inputs_shown([*self.columns]).items()}

    @cached_property
    def inputs(self) -> Mapping[str, float | str]:
        """`input_measures` without uncertainties."""
        return {name: middle(value) for name, value in self.input_measures.items()}

    @property
    def uncertain_inputs(self) -> Mapping[str, Uncertain]:
        """The inputs that are uncertain."""
        return {name: value for name, value in self.input_measures.items() if is_uncertain(value)}

    @cached_property
    def results(self) -> tuple[Result, ...]:
        """The results of the quantities shown."""
        return tuple(map(self.result, self.columns))

    @property
    def results_to_explain(self) -> tuple[Result, ...]:
        """The results; after inferred values also the measured quantities, whose formulas were solved for them."""
        measured = tuple(name for name in self.judged if name not in self.computed)
        if not measured or self.failure is not None:
            return self.results
        forward = Answer(Question(measured, measured, named=measured), self.frame)
        forward.bars = {}  # the uncertainties belong to the unknowns
        return (*self.results, *forward.results)

    def result(self, name: str) -> Result:
        """Return a result; without a value, it has the reason."""
        is_inferred = name in self.described.unknowns
        law = "" if self.frame.law.is_default or is_inferred else self.frame.law.name
        if name in self.reasons:
            return without_value(name, self.reasons[name], law)
        if law and not has_other_formulas(self.frame, name):
            law = ""
        equation = equation_of(self.frame, name) if law else ""
        error, bar = model_error(name, self.frame), self.bar(name)
        result = Result(name, self.values[name], error=error, bar=bar, law=law, equation=equation)
        if is_inferred:
            growth = self.described.solution.growths[name]
            result.growth = growth if isfinite(growth) else None
            result.by_law = {law: middle(values[name]) for law, values in self.by_law.items()}
        return result

    def bar(self, name: str) -> ErrorBar | None:
        """Return the uncertainty of a result, or None."""
        bar = self.bars.get(name)
        return bar if bar is not None and bar.sides else None

    @cached_property
    def ranges(self) -> Ranges:
        """The ranges from laws and measurements."""
        return Ranges(self)

    @cached_property
    def estimates(self) -> Mapping[str, Estimate]:
        """The best ranges of results that have a value, even one without a meaning."""
        return {name: self.ranges.estimate(name) for name in self.ranges.names}

    @property
    def rules(self) -> list[int]:
        """The rules that give the best ranges, in the order of the results."""
        return [*dict.fromkeys(estimate.by for estimate in self.estimates.values())]

    @cached_property
    def of_jkr(self) -> Mapping[str, float]:
        """The values by JKR, to compare with those of another law."""
        numbers = self.frame.under(DEFAULT_LAW).numbers(*(self.columns.keys() - self.ended.keys()))
        return {name: number for name, number in numbers.items() if number < INFINITY}

    @cached_property
    def by_law(self) -> Mapping[str, Mapping[str, Any]]:
        """Inferred values with uncertainties, by each law whose formulas differ from those of the law in use."""
        by_law: dict[str, Mapping[str, Any]] = {}
        unknowns = self.described.unknowns
        if not unknowns or not self.values or self.ended:
            return by_law
        formulas = self.described.formulas_to(*unknowns)
        for law in MODELS:
            other = self.described.replace(model=law)
            with suppress(MissingInput):
                if other.formulas_to(*unknowns) != formulas:
                    values = _measures(other, unknowns)
                    if values:
                        by_law[law] = values
        return by_law

    @property
    def exceeded(self) -> list[Doubt]:
        """The limits of the model that are exceeded, the most important first.

        Limits that make results meaningless come first, led by a contact wider than its sphere, then the other limits.
        Each of these two groups begins with the limits on the headline. Among them, and among the rest, limits on a
        state (with threshold 0) precede limits with a remedy, then come the others. Ties go to the larger excess.
        """
        return sorted((doubt for doubt in self.validity if doubt.is_exceeded), key=self._rank)

    def is_in_doubt(self, code: str) -> bool:
        """Return whether the limit with this code is exceeded."""
        return any(doubt.code == code for doubt in self.exceeded)

    def _rank(self, doubt: Doubt) -> tuple[bool, bool, bool, bool, bool, float]:
        """Return the sorting key of an exceeded limit; the least is the most important."""
        limit = doubt.limit
        is_of_state = not limit.threshold
        has_remedy = limit.has_remedy is not None and limit.has_remedy(self.frame)
        return (
            limit is not CONTACT_EXCEEDS_SPHERE,
            not limit.ends_meaning,
            not self._is_of_headline(limit),
            not is_of_state,
            not has_remedy,
            -doubt.excess,
        )

    def _is_of_headline(self, limit: Limit) -> bool:
        """Return whether a limit concerns the headline.

        The limit of the law concerns the headline if a better law gives it a different value. A limit on the value of
        a result itself, such as a negative force, always counts as one on the headline.
        """
        if limit.name in limit.touches and limit.name in self.values:
            return True
        names = [name for name in self.values if name in self.question.headline]
        if limit is LAW:
            return bool(factor_of_law(self.frame, {name: self.columns[name] for name in names}) > LAW_MATTERS)
        return bool(concerning(self.frame, names, [limit]))

    @cached_property
    def _entering(self) -> tuple[set[str], list[str]]:
        return entering(self.frame, [*self.judged])

    @cached_property
    def assumed(self) -> Mapping[str, str]:
        """The assumptions by name, each with the option that replaces it."""
        inputs, _ = self._entering
        texts = assumed(self.frame, inputs, self._possible, has_values=True)
        return {name: text for name, text in texts.items() if name not in self.judged}

    @property
    def _possible(self) -> list[str]:
        return self.frame.possible(self.judged)

    @property
    def names_in_table(self) -> list[str]:
        """The quantities with a row in a table; in a report, turns have one only if an energy or a speed is stated."""
        question, stated = self.question, self.frame.stated.keys()
        hidden = {name for name, inputs in question.if_stated.items() if stated.isdisjoint(inputs)}
        return [name for name in question.with_row if name in question.named or name not in hidden]

    @property
    def is_of_impact(self) -> bool:
        """True if the answer tells whether colliding spheres stick."""
        return {"restitution", "sticking_speed"} <= self.values.keys()

    @property
    def shows_surfaces(self) -> bool:
        """True if the table has rows for real surfaces.

        The headline then has the pull-off force, no law is stated, and real surfaces may hold less than smooth ones.
        """
        is_asked = "pull_off_force" in self.question.headline and "pull_off_force" in self.values
        return is_asked and not self.frame.stated_model and bool(may_be_rough(self.frame))

    @property
    def shows_ranges(self) -> bool:
        """True if the table has best ranges: it has rows for real surfaces, or another rule than the law in use.

        Definitions and formulas that hold under any law do not count. Without best ranges, the column of the law has
        the uncertainties.
        """
        words = {WORDS[self.estimates[name].by] for name in self.names_in_table if name in self.estimates}
        return self.shows_surfaces or not words <= {self.frame.law.short, *(WORDS[by] for by in _NO_RANGE_NEEDED)}

    @cached_property
    def held(self) -> Mapping[str, Ends]:
        """The least and the largest pull-off force on each kind of real surface."""
        name = "pull_off_force"
        low, high = Ranges.of(self.frame.under(DEFAULT_LAW), name).hull(name, itself)
        return on_surfaces(self.frame, (low, high) if low <= high else None)  # both are nan for rigid bodies

    def surfaces_of(self, name: str) -> Mapping[str, Ends]:
        """Return `held` for the pull-off force if the table has rows for real surfaces; otherwise an empty mapping."""
        return self.held if name == "pull_off_force" and self.shows_surfaces else {}

    @property
    def is_on_pull_off(self) -> bool:
        """True if the pull-off force alone is the headline, and the table has rows for real surfaces."""
        return self.shows_surfaces and self.question.headline == ("pull_off_force",)

    @cached_property
    def failure(self) -> JkrollError | None:
        """The reason why there is no result, or no contact; otherwise None."""
        for error in self.reasons.values():
            if isinstance(error, Failure) and not error.cause.has_contact:
                return with_force_by_maugis(error, self.frame) if error.cause == BEYOND_PULL_OFF else error
        if self.values or self.ended:  # a value without a meaning counts as an answer
            return None
        return next(iter(self.reasons.values()), Failure(OF_IDENTICAL_SPHERES))
