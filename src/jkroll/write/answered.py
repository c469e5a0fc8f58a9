"""Answers as lines for a pipe, one for each number, and as JSON objects."""

from collections.abc import Iterable, Mapping
from math import isnan
from typing import TYPE_CHECKING, Any, TextIO

from ..model.estimate import BEST_KEYS, NONE, WORDS, Estimate
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
    """Write a line `name value unit` for each result and each side of its uncertainty, after lines on law and profile.

    `best`: True for lines on best ranges, too.
    """
    for word in ("model", "profile"):
        if word in answer.inputs:
            say(f"{word} {answer.inputs[word]}", out)
    for result in answer.results:
        write_measure(result.name, {result.name: result.measure}, out, form)
        if best and result.name in answer.estimates:
            _write_best(result.name, answer.estimates[result.name], out, form)


def _write_best(name: str, best: Estimate, out: TextIO, form: Format) -> None:
    """Write a line for each known end of a best range, and one for its rule."""
    low, high, by = (name + suffix for suffix in BEST_KEYS)
    for key, end in ((low, best.low), (high, best.high)):
        if not isnan(end):
            write_measure(name, {key: end}, out, form)
    if best.by != NONE:
        say(f"{by} {WORDS[best.by]}", out)


def write_measure(quantity: str, measures: Mapping[str, float | Uncertain | None], out: TextIO, form: Format) -> None:
    """Write a line `name value unit` for each value of a quantity and each side of its uncertainty.

    `measures`: the values, by the name to write.
    """
    for name, number in numbers_of(measures).items():
        value = in_words(quantity, number)
        if not isinstance(value, str):
            value = f"{spelled(form.number(quantity, number))} {form.unit(quantity)}"
        say(f"{name} {value}".removesuffix(" 1"), out)  # no unit for a pure number


def numbers_of(measures: Mapping[str, float | Uncertain | None]) -> dict[str, float]:
    """Return the values of measures and the sides of their uncertainties by name, such as "radius_minus"; skip None."""
    numbers = {}
    for name, value in measures.items():
        if value is not None:
            numbers[name] = middle(value)
        if is_uncertain(value):
            for side, number in value.sides.items():
                numbers[f"{name}_{side}"] = number
    return numbers


def write_json(answers: Iterable[Report], count: int, out: TextIO, form: Format) -> None:
    """Write the object of each answer once it is computed; several form an array. `count`: the number of answers."""
    for number, answer in enumerate(answers, 1):
        text = json_text(as_object(answer, form), out)
        if count > 1:
            text += "\n]" if number == count else ","
            if number == 1:
                text = f"[\n{text}"
        say(text, out)


def as_object(answer: Report, form: Format) -> dict[str, Any]:
    """Return the JSON object of an answer."""
    from .. import __version__

    entry: dict[str, Any] = {"inputs": dict(answer.inputs)}
    if answer.uncertain_inputs:
        uncertain = answer.uncertain_inputs
        entry["uncertainties"] = {name: uncertainty_object(name, value) for name, value in uncertain.items()}
    entry["results"] = [_result_object(result, answer, form) for result in answer.results]
    if answer.condition is not None:
        entry["condition"] = answer.condition
    entry["validity"] = [_doubt_object(doubt, answer.about(doubt)) for doubt in answer.validity if doubt.error is None]
    entry["notes"] = [note.text for note in answer.notes]
    entry["version"] = __version__
    return entry


def _result_object(result: Result, answer: Report, form: Format) -> dict[str, Any]:
    """Return the JSON object of a result, without keys for facts that the result lacks."""
    name, quantity = result.name, NOMENCLATURE[result.name]
    entry: dict[str, Any] = {
        "name": name,
        "symbol": quantity.symbol,
        "value": _number(name, result.value, form),
        "unit": form.unit(name),
        "equation": result.equation,
        "description": quantity.sentence,
    }
    if result.law:
        jkr = _number(name, answer.of_jkr.get(name), form)
        entry |= {"model": DEFAULT_LAW, **LAWS[result.law].words, "jkr": jkr}  # the words name another model or profile
    best = answer.estimates.get(name)
    if best is not None and best.by != NONE:
        low, high = _number(name, best.low, form), _number(name, best.high, form)
        entry["best"] = {"low": low, "high": high, "by": WORDS[best.by], "why": answer.why(best.by)}
    surfaces = {}
    for surface, (low, high) in answer.surfaces_of(name).items():
        surfaces[surface] = {"low": _number(name, low, form), "high": _number(name, high, form)}
    further: dict[str, Any] = {"surfaces": surfaces, "note": quantity.note}
    if not result.law:
        further |= {"definition": quantity.definition, "reference": quantity.reference}
    if result.uncertain:
        further["uncertainty"] = uncertainty_object(name, result.uncertain, form)
    if result.bar:
        further["shares"] = result.bar.shares
    further |= {
        "condition" if answer.condition is None else "growth": result.growth,  # for a single unknown, they are equal
        "by_law": {law: form.number(name, value) for law, value in result.by_law.items()},
        "reason": result.reason,
        "reason_code": result.code,
        "relative_error": result.error,
    }
    return entry | {key: value for key, value in further.items() if value not in (None, "", {})}


def _number(name: str, value: float | None, form: Format) -> float | None:
    """Return a value in the unit and with the digits of a format; None for nan and None."""
    return None if value is None or isnan(value) else form.number(name, value)


def uncertainty_object(name: str, uncertain: Uncertain, form: Format = AS_USUAL) -> dict[str, Any]:
    """Return an uncertainty as an object: its kind and its sides, in the unit of a quantity."""
    sides = {side: form.number(name, number) for side, number in uncertain.sides.items()}
    return {"kind": uncertain.kind, **sides}


def _doubt_object(doubt: "Doubt", text: str) -> dict[str, Any]:
    """Return the JSON object of a judged limit. `text`: its sentence."""
    entry = {
        "name": doubt.limit.name,
        "symbol": NOMENCLATURE[doubt.limit.name].symbol,
        "value": doubt.value,
        "limit": doubt.limit.threshold,
        "factor": doubt.factor,
        "holds": not doubt.is_exceeded,
        "text": text,
        "code": doubt.code or None,
    }
    if doubt.limit.conclusion:
        entry["verdict"] = doubt.limit.conclusion
    return entry
