"""An answer as text and as objects: plain lines in a pipe, JSON, and what `jkroll.answer` returns."""

from collections.abc import ItemsView, Iterable, Iterator, KeysView, Mapping
from functools import cached_property
from importlib import import_module
from math import isnan, nan
from typing import TYPE_CHECKING, Any, TextIO

from ..errors import BadRequest
from ..materials.library import Material, Materials
from ..model.estimate import NONE, WORDS, Estimate
from ..model.frame import Frame
from ..quantities.formatting import AS_USUAL, Format, amount, in_words
from ..quantities.laws import DEFAULT_LAW, LAWS, law_given
from ..quantities.nomenclature import NOMENCLATURE, named
from ..quantities.values import Uncertain, is_uncertain, middle
from ..report.answer import Result
from ..report.questions import QUESTIONS, Question, question_about
from ..report.report import Report
from ..text import json_text, listed, quoted, say, spelled

if TYPE_CHECKING:
    from ..model.limits import Doubt
    from .table import Row


def write_plain(answer: Report, out: TextIO, form: Format, *, best: bool = False) -> None:
    """Write a line `name value unit` for each result of a frame, each side of its uncertainty, and its best range."""
    for word in ("model", "profile"):
        if word in answer.inputs:
            say(f"{word} {answer.inputs[word]}", out)
    for result in answer.results:
        write_measure(result.name, {result.name: result.measure}, out, form)
        if best and result.name in answer.estimates:
            _write_best(result.name, answer.estimates[result.name], out, form)


def _write_best(name: str, best: Estimate, out: TextIO, form: Format) -> None:
    """Write a line for each end of a best range that is not open, and for its rule."""
    ends = zip(("low", "high"), best[:2], strict=True)
    write_measure(name, {f"{name}_best_{which}": end for which, end in ends if not isnan(end)}, out, form)
    if best.by != NONE:
        say(f"{name}_best_by {WORDS[best.by]}", out)


def write_measure(quantity: str, measures: Mapping[str, float | Uncertain | None], out: TextIO, form: Format) -> None:
    """Write a line `name value unit` for each number of some measures of a quantity, by their names."""
    for name, number in numbers_of(measures).items():
        word = in_words(quantity, number)
        value = word if isinstance(word, str) else f"{spelled(form.number(quantity, number))} {form.unit(quantity)}"
        say(f"{name} {value}".removesuffix(" 1"), out)


def numbers_of(measures: Mapping[str, float | Uncertain | None]) -> dict[str, float]:
    """Return the numbers of measures by their names, with the sides of their uncertainties; None has none."""
    numbers = {}
    for name, value in measures.items():
        if value is not None:
            numbers[name] = middle(value)
        if is_uncertain(value):
            numbers |= {f"{name}_{side}": number for side, number in value.sides.items()}
    return numbers


def write_json(answers: Iterable[Report], count: int, out: TextIO, form: Format) -> None:
    """Write an object for each frame; several frames are an array, written as they are computed."""
    for position, answer in enumerate(answers, 1):
        start, end = ("[\n" if position == 1 else "", "\n]" if position == count else ",") if count > 1 else ("", "")
        say(start + json_text(as_object(answer, form), out) + end, out)


def as_object(answer: Report, form: Format) -> dict[str, Any]:
    """Return the JSON object of one frame."""
    from .. import __version__

    entry: dict[str, Any] = {"inputs": dict(answer.inputs)}
    if answer.uncertain:
        entry["uncertainties"] = {name: bar_object(name, bar) for name, bar in answer.uncertain.items()}
    entry["results"] = [_result_object(result, answer, form) for result in answer.results]
    if answer.condition is not None:
        entry["condition"] = answer.condition
    entry["validity"] = [_doubt_object(doubt, answer.about(doubt)) for doubt in answer.validity if doubt.error is None]
    entry["notes"] = [note.text for note in answer.notes]
    entry["version"] = __version__
    return entry


def _result_object(result: Result, answer: Report, form: Format) -> dict[str, Any]:
    quantity = NOMENCLATURE[result.name]
    entry: dict[str, Any] = {
        "name": result.name,
        "symbol": quantity.symbol,
        "value": None if result.value is None else form.number(result.name, result.value),
        "unit": form.unit(result.name),
        "equation": result.equation,
        "description": quantity.sentence,
    }
    if result.law:
        entry |= {"model": DEFAULT_LAW, **LAWS[result.law].words}
        jkr = answer.of_jkr.get(result.name)
        entry["jkr"] = None if jkr is None else form.number(result.name, jkr)
    if (best := answer.estimates.get(result.name)) is not None and best.by != NONE:
        low, high = (None if isnan(end) else form.number(result.name, end) for end in best[:2])
        entry["best"] = {"low": low, "high": high, "by": WORDS[best.by], "why": answer.whys[best.by]}
    bar = result.uncertain
    further = {
        **{key: getattr(quantity, key) for key in (("note",) if result.law else ("note", "definition", "reference"))},
        "uncertainty": bar and bar_object(result.name, bar, form),
        "shares": result.bar and result.bar.shares,
        "condition" if answer.condition is None else "growth": result.growth,
        "by_law": {law: form.number(result.name, value) for law, value in result.by_law.items()},
        "reason": result.reason,
        "reason_code": result.code,
        "relative_error": result.error,
    }
    return entry | {key: value for key, value in further.items() if value not in (None, "", {})}


def bar_object(name: str, bar: Uncertain, form: Format = AS_USUAL) -> dict[str, Any]:
    """Return the kind of an error bar and its sides, in the unit of a quantity."""
    return {"kind": bar.kind, **{side: form.number(name, number) for side, number in bar.sides.items()}}


def _doubt_object(doubt: "Doubt", text: str) -> dict[str, Any]:
    return {
        "name": doubt.limit.name,
        "symbol": NOMENCLATURE[doubt.limit.name].symbol,
        "value": doubt.value,
        "limit": doubt.limit.threshold,
        "factor": doubt.factor,
        "holds": not doubt.is_exceeded,
        "text": text,
        "code": doubt.code or None,
        **({"verdict": doubt.limit.conclusion} if doubt.limit.conclusion else {}),
    }


# --- Python -----------------------------------------------------------------------------------------------------------


class Exceeded:
    """A limit of the model that does not hold; a text of it is the sentence.

    `name` and `value` are of the number that limits the model, `limit` is the first threshold of what is judged (of a
    law the factor between answers, of radii the smaller), and `factor` how many times that is beyond it; None if it is
    infinite, or over 0. `ends` has the names of results that have no meaning for it.
    """

    def __init__(self, text: str, doubt: "Doubt", ends: tuple[str, ...]) -> None:
        self.text, self.code, self.name, self.value = text, doubt.code, doubt.limit.name, doubt.value
        self.limit, self.factor, self.ends = doubt.limit.threshold, doubt.factor, ends

    def __repr__(self) -> str:
        return f"<{self.code}: {self.text}>"

    def __str__(self) -> str:
        return self.text


class Answered:
    """The answer to a question about one scene.

    `values` are the results by name, `inputs` what was understood and assumed, `doubts` the limits of the model that do
    not hold, `best` the best ranges of the values, `notes` the other sentences. `as_dict()` is the
    object of `--json`. It iterates over the names of the results, as a dict does.
    """

    def __init__(self, answer: Report) -> None:
        self._answer = answer

    def __reduce__(self) -> tuple[Any, ...]:
        """Pickle the question and the frame; the rest is computed anew."""
        return _answered, (self._answer.question, self._answer.described)

    @cached_property
    def values(self) -> Mapping[str, Result]:
        """The results by name, in SI units."""
        for result in self._answer.results:
            result.best = self.best.get(result.name)
        return {result.name: result for result in self._answer.results}

    @cached_property
    def inputs(self) -> Mapping[str, float | str | Uncertain]:
        """The inputs that were stated or enter the results, in SI units, with their error bars."""
        return self._answer.measures

    @cached_property
    def inputs_in_words(self) -> Mapping[str, str]:
        """The same as texts with units, rounded as on a terminal."""
        return {name: amount(name, value) for name, value in self.inputs.items()}

    @cached_property
    def doubts(self) -> tuple[Exceeded, ...]:
        """The limits of the model that do not hold, the one that is exceeded most first."""
        answer = self._answer
        return tuple(Exceeded(answer.about(doubt), doubt, answer.ended_by(doubt)) for doubt in answer.exceeded)

    @cached_property
    def best(self) -> Mapping[str, Estimate]:
        """The best ranges of the results, by name: `low`, `high`, of which nan is open, and `by`."""
        return {name: estimate._replace(by=WORDS[estimate.by]) for name, estimate in self._answer.estimates.items()}

    @cached_property
    def why(self) -> Mapping[str, str]:
        """Why results have their best ranges, by the word for the rule: what such a range holds and leaves out."""
        return {WORDS[by]: text for by, text in self._answer.whys.items() if text}

    @cached_property
    def rows(self) -> "Mapping[str, Row]":
        """The rows of the table on a terminal, by name: each with its best range as text, and what says so."""
        from .table import rows_in_words

        return rows_in_words(self._answer, AS_USUAL)

    @cached_property
    def notes(self) -> tuple[str, ...]:
        """The other sentences: what was assumed, what the material's source says, what contradicts a result."""
        return tuple(note.text for note in self._answer.notes)

    def as_dict(self) -> dict[str, Any]:
        """Return the object that the command prints with `--json`."""
        return as_object(self._answer, AS_USUAL)

    def to_dict(self) -> dict[str, float | None]:
        """Return the numbers in SI units by name; None for a result without a value."""
        return {name: result.value for name, result in self.values.items()}

    def to_pandas(self) -> Any:
        """Return a DataFrame with a row for each result: its number in SI units, and its best range."""
        rows = []
        for name, result in self.values.items():
            low, high, by = self.best.get(name, (nan, nan, None))
            row = {"symbol": NOMENCLATURE[name].symbol, "value": result.value, "unit": result.unit}
            rows.append({**row, "best_low": low, "best_high": high, "best_by": by, "reason": result.reason or None})
        return import_module("pandas").DataFrame(rows, index=[*self])

    def keys(self) -> KeysView[str]:
        """Return the names of the results."""
        return self.values.keys()

    def items(self) -> ItemsView[str, Result]:
        """Return the names with the results."""
        return self.values.items()

    def __iter__(self) -> Iterator[str]:
        return iter(self.values)

    def __len__(self) -> int:
        return len(self.values)

    def __contains__(self, name: object) -> bool:
        return named(str(name), self.values) in self.values

    def __getitem__(self, name: str) -> Result:
        """Return the result of a name, or of a symbol."""
        known = named(str(name), self.values)
        if known not in self.values:
            raise BadRequest(f"{quoted(str(name))} is not in this answer, which has {listed(self.values)}")
        return self.values[known]

    def __repr__(self) -> str:
        shown = {name: "no value" if result.value is None else result for name, result in self.values.items()}
        texts = (f"{NOMENCLATURE[name].symbol} = {result}" for name, result in shown.items())
        return f"<Answered: {', '.join(texts)}>"

    def __str__(self) -> str:
        from .notebook import as_text  # with the tables, for which lines in a pipe do not pay

        return as_text(self._answer)

    def _repr_html_(self) -> str:
        """Return what a notebook shows."""
        from .notebook import as_html

        return as_html(self._answer)

    def _repr_mimebundle_(self, **_: Any) -> dict[str, str]:
        """Return what notebooks show, and what they convert: LaTeX for a PDF, text for a console."""
        from .notebook import as_tabular

        return {"text/plain": str(self), "text/html": self._repr_html_(), "text/latex": as_tabular(self._answer)}


def _answered(question: Question, frame: Frame) -> Answered:
    """Return the answer to a question about a frame."""
    return Answered(Report(question, frame))


def answer(
    wanted: str | Iterable[str],
    /,
    *,
    material: str | Material | None = None,
    material2: str | Material | None = None,
    materials: Materials | None = None,
    model: str | None = None,
    profile: str | None = None,
    **given: Any,
) -> Answered:
    """Answer a question about one scene, with all that is to be said of the numbers.

    Parameters
    ----------
    wanted
        A command, such as "pull-off" or "report", or names of quantities, as for `solve`.
    material, material2, materials, model, profile, **given
        The scene, as `solve` takes it, but for arrays and lists.

    A radius of a metre or more that is a number without a unit is warned of: 100 stands for 100 m.

    Returns
    -------
    An object with `values` by name, `inputs`, `doubts`, `notes` and `as_dict()`. All numbers are in SI units.

    Raises
    ------
    MissingInput, UnknownMaterial, UnknownQuantity, QuantityError
        An input is wrong, or one is missing without which there is no result.
    NoResult
        There is no contact, or no result at all. A single result without a value has a reason instead.

    >>> answered = answer("pull-off", material="quartz", radius="100 nm")
    >>> str(answered["pull_off_force"]), answered["P_c"].unit
    ('11.781 nN', 'N')
    >>> low, high, by = answered.best["pull_off_force"]
    >>> round(low, 10), round(high, 10), by
    (1.42e-08, 1.53e-08, 'Maugis')
    """
    from ..model.containers import Reader, warn_of_metres
    from ..model.solver import materials_of, refuse_arrays, words_in

    described = Reader().in_si(given)
    refuse_arrays(described)
    warn_of_metres(described, given)
    is_command = isinstance(wanted, str) and wanted in QUESTIONS
    text = ",".join(words_in(wanted))
    question = QUESTIONS[text] if is_command else question_about(text)
    answered = Report(
        question, Frame(described, *materials_of(material, material2, materials), model=law_given(model, profile))
    )
    if answered.failure is not None and answered.has_no_headline:
        raise answered.failure
    return Answered(answered)
