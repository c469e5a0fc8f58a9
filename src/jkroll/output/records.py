"""Records and answers as text: a table on a terminal, plain lines in a pipe, CSV, JSON.

Text of a user or a file is never read as markup, and nothing is cut where it does not fit.
"""

from collections.abc import Iterable, Mapping, Sequence
from typing import TYPE_CHECKING, Any, TextIO

from ..quantities.formatting import Format, in_words, pretty
from ..quantities.laws import other_law
from ..quantities.nomenclature import NOMENCLATURE
from ..quantities.values import is_uncertain, middle
from ..text import fitting, json_text, say, spelled

if TYPE_CHECKING:
    from ..answers.answer import Answer
    from ..answers.results import Result
    from ..quantities.values import Uncertain
    from ..scene.limits import Doubt

Cell = str | float | None


def write_records(heads: Sequence[str], records: Iterable[Sequence[Cell]], kind: str, out: TextIO) -> None:
    """Write records in a format: "table", "plain", "csv" or "json".

    A cell without a value is None. It is written as "—", "-", an empty cell or null.
    """
    if kind == "json":
        say(json_text([dict(zip(heads, record, strict=True)) for record in records], out), out)
    elif kind == "table":
        from .table import write_texts

        rows = (["—" if cell is None else pretty(_text(cell)) for cell in record] for record in records)
        write_texts(heads, rows, out)
    else:
        write_columns(heads, [list(column) for column in zip(*records, strict=True)], kind, out)


def write_columns(heads: Sequence[str], columns: Sequence[Any], kind: str, out: TextIO) -> None:
    """Write columns, as `writers` has them, in a format whose rows are lines."""
    from .writers import WRITERS

    writer = WRITERS[kind]
    text = writer.header(heads) + (writer.rows(heads, columns) if columns else b"")
    out.write(fitting(text.decode(), out))


def _text(cell: str | float) -> str:
    return spelled(cell) if isinstance(cell, float) else str(cell)


# --- Objects ----------------------------------------------------------------------------------------------------------


def write_plain(answer: "Answer", out: TextIO, form: Format, *, alternatives: bool = False) -> None:
    """Write a line `name value unit` for each result of a scene, and for each side of its uncertainty.

    `alternatives`: whether what may stand in its place has lines, too.
    """
    beside = answer.beside if alternatives else {}
    if "model" in answer.inputs:
        say(f"model {answer.inputs['model']}", out)
    for result in answer.results:
        measures = {result.name: result.measure}
        measures |= {f"{result.name}_by_{kind}": values.get(result.name) for kind, values in beside.items()}
        write_measure(result.name, measures, out, form)


def write_measure(quantity: str, measures: "Mapping[str, float | Uncertain | None]", out: TextIO, form: Format) -> None:
    """Write a line `name value unit` for each number of some measures of a quantity, by their names."""
    for name, number in _numbers(measures).items():
        word = in_words(quantity, number)
        value = word if isinstance(word, str) else f"{spelled(form.number(quantity, number))} {form.unit(quantity)}"
        say(f"{name} {value}".removesuffix(" 1"), out)


def _numbers(measures: "Mapping[str, float | Uncertain | None]") -> dict[str, float]:
    """Return the numbers of measures by their names, with the sides of their uncertainties; None has none."""
    numbers = {}
    for name, value in measures.items():
        if value is not None:
            numbers[name] = middle(value)
        if is_uncertain(value):
            numbers |= {f"{name}_{side}": number for side, number in value.sides.items()}
    return numbers


def write_json(answers: "Iterable[Answer]", count: int, out: TextIO, form: Format) -> None:
    """Write an object for each scene; several scenes are an array, written as they are computed."""
    for place, answer in enumerate(answers, 1):
        start, end = ("[\n" if place == 1 else "", "\n]" if place == count else ",") if count > 1 else ("", "")
        say(start + json_text(as_object(answer, form), out) + end, out)


def as_object(answer: "Answer", form: Format) -> dict[str, Any]:
    """Return the JSON object of one scene."""
    from .. import __version__

    found: dict[str, Any] = {"inputs": dict(answer.inputs)}
    if answer.uncertain:
        found["uncertainties"] = {name: one.as_object() for name, one in answer.uncertain.items()}
    found["results"] = [_result_object(result, answer, form) for result in answer.results]
    if answer.condition is not None:
        found["condition"] = answer.condition
    if answer.laws:
        found["laws"] = {
            other_law(answer.scene.law.name): {
                name: _law_object(name, numbers, form) for name, numbers in answer.laws.items()
            }
        }
    if answer.displacement is not None:
        found["displacement"] = _displacement_object(answer.displacement, form)
    found["validity"] = [_doubt_object(doubt, answer.about(doubt)) for doubt in answer.validity if doubt.error is None]
    found["notes"] = [note.text for note in answer.notes]
    found["version"] = __version__
    return found


def _result_object(result: "Result", answer: "Answer", form: Format) -> dict[str, Any]:
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
        entry["model"] = result.law
        jkr = answer.of_jkr.get(result.name)
        entry["jkr"] = None if jkr is None else form.number(result.name, jkr)
    for key in ("note",) if result.law else ("note", "definition", "reference"):
        if text := getattr(quantity, key):
            entry[key] = text
    if result.propagated is not None:
        entry["uncertainty"] = _bar_object(result.name, result.propagated.uncertainty, form)
        entry["shares"] = dict(result.propagated.shares)
    if result.condition is not None:
        entry["condition"] = result.condition
    if result.growth is not None:
        entry["growth"] = result.growth
    if result.by_law:
        entry["by_law"] = {law: form.number(result.name, value) for law, value in result.by_law.items()}
    if result.value is None:
        entry["reason"] = result.reason
    if result.error is not None:
        entry["relative_error"] = result.error
    return entry


def _bar_object(name: str, bar: "Uncertain", form: Format) -> dict[str, Any]:
    """Return the kind of an error bar and its sides, in the unit of a quantity."""
    return {"kind": bar.kind, **{side: form.number(name, number) for side, number in bar.sides.items()}}


def _law_object(name: str, numbers: Mapping[str, Any], form: Format) -> dict[str, Any]:
    """Return what stands in place of a quantity under another law, with its error bar, in its unit."""
    value, bar = numbers["value"], numbers.get("uncertainty")
    shown = {**numbers, "value": None if value is None else form.number(name, value)}
    return shown if bar is None else {**shown, "uncertainty": _bar_object(name, bar, form)}


def _displacement_object(found: Mapping[str, Any], form: Format) -> dict[str, Any]:
    """Return what the assumed displacement is worth, its values in their units."""
    if "values" not in found:
        return dict(found)
    return {
        **found,
        "values": {name: [form.number(name, end) for end in ends] for name, ends in found["values"].items()},
    }


def _doubt_object(doubt: "Doubt", text: str) -> dict[str, Any]:
    return {
        "name": doubt.limit.name,
        "symbol": NOMENCLATURE[doubt.limit.name].symbol,
        "value": doubt.value,
        "limit": doubt.threshold,
        "factor": doubt.factor,
        "holds": not doubt.is_exceeded,
        "text": text,
        "code": doubt.code or None,
        **({"verdict": doubt.limit.conclusion} if doubt.limit.conclusion else {}),
    }
