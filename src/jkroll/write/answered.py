"""An answer as unformatted lines for a pipe, and as a JSON object."""

from collections.abc import Iterable, Mapping
from math import isnan
from typing import TYPE_CHECKING, Any, TextIO

from ..model.estimate import NONE, WORDS, Estimate
from ..quantities.formatting import AS_USUAL, Format, in_words
from ..quantities.laws import DEFAULT_LAW, LAWS
from ..quantities.nomenclature import NOMENCLATURE
from ..quantities.values import Uncertain, is_uncertain, middle
from ..report.answer import Result
from ..report.report import Report
from ..text import json_text, say, spelled

if TYPE_CHECKING:
    from ..model.limits import Doubt


def write_plain(answer: Report, out: TextIO, form: Format, *, best: bool = False) -> None:
    """Write a line `name value unit` for each result, for each side of its uncertainty, and for its best range."""
    for word in ("model", "profile"):
        if word in answer.inputs:
            say(f"{word} {answer.inputs[word]}", out)
    for result in answer.results:
        write_measure(result.name, {result.name: result.measure}, out, form)
        if best and result.name in answer.estimates:
            _write_best(result.name, answer.estimates[result.name], out, form)


def _write_best(name: str, best: Estimate, out: TextIO, form: Format) -> None:
    """Write a line for each known end of a best range, and for its rule."""
    ends = zip(("low", "high"), best[:2], strict=True)
    write_measure(name, {f"{name}_best_{which}": end for which, end in ends if not isnan(end)}, out, form)
    if best.by != NONE:
        say(f"{name}_best_by {WORDS[best.by]}", out)


def write_measure(quantity: str, measures: Mapping[str, float | Uncertain | None], out: TextIO, form: Format) -> None:
    """Write a line `name value unit` for each number of some measures of a quantity, by name."""
    for name, number in numbers_of(measures).items():
        word = in_words(quantity, number)
        value = word if isinstance(word, str) else f"{spelled(form.number(quantity, number))} {form.unit(quantity)}"
        say(f"{name} {value}".removesuffix(" 1"), out)


def numbers_of(measures: Mapping[str, float | Uncertain | None]) -> dict[str, float]:
    """Return the numbers of measures by name, with the sides of their uncertainties; None has no number."""
    numbers = {}
    for name, value in measures.items():
        if value is not None:
            numbers[name] = middle(value)
        if is_uncertain(value):
            for side, number in value.sides.items():
                numbers[f"{name}_{side}"] = number
    return numbers


def write_json(answers: Iterable[Report], count: int, out: TextIO, form: Format) -> None:
    """Write an object for each frame; several objects form an array, and are written as they are computed."""
    for number, answer in enumerate(answers, 1):
        text = json_text(as_object(answer, form), out)
        if count > 1:
            text = ("[\n" if number == 1 else "") + text + ("\n]" if number == count else ",")
        say(text, out)


def as_object(answer: Report, form: Format) -> dict[str, Any]:
    """Return the JSON object of an answer."""
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
    best = answer.estimates.get(result.name)
    if best is not None and best.by != NONE:
        low, high = (None if isnan(end) else form.number(result.name, end) for end in best[:2])
        entry["best"] = {"low": low, "high": high, "by": WORDS[best.by], "why": answer.whys[best.by]}
    bar = result.uncertain
    further: dict[str, Any] = {"note": quantity.note}
    if not result.law:
        further |= {"definition": quantity.definition, "reference": quantity.reference}
    further |= {
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
    """Return an uncertainty as an object: its kind and its sides, in the unit of a quantity."""
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
