"""Answers as text: a table on a terminal, plain lines in a pipe, bare numbers, CSV, JSON.

Text of a user or a file is never read as markup, and nothing is cut where it does not fit.
"""

from collections.abc import Iterable, Iterator, Sequence
from typing import Any, TextIO

from ..answers.answer import Answer
from ..answers.comparison import Difference
from ..answers.result import Result
from ..quantities.formatting import AS_USUAL, Format
from ..quantities.laws import BETWEEN
from ..quantities.nomenclature import NOMENCLATURE
from ..scene.limits import Verdict
from ..text import json_text, say
from .layout import Layout
from .records import write_records

MAX_TABLE = 10_000  # rows of a table on a terminal


def write_plain(answers: Iterable[Answer], out: TextIO, form: Format, shape: Layout) -> None:
    """Write a line `name value unit` for each result of one scene, or tab-separated rows of several scenes."""
    if shape.size > 1:
        write_records(shape.headers(form), _rows(answers, shape, form), "plain", out)
        return
    answer = next(iter(answers))
    if "model" in answer.inputs:
        say(f"model {answer.inputs['model']}", out)
    for result in answer.results:
        if result.value is not None:
            numbers = {result.name: result.value} | {
                f"{result.name}_{side}": number for side, number in result.sides().items()
            }
            for name, number in numbers.items():
                say(f"{name} {form.text(result.name, number)} {form.unit(result.name)}".removesuffix(" 1"), out)


def write_bare(answers: Iterable[Answer], out: TextIO, form: Format, shape: Layout) -> None:
    """Write a line for each scene: the numbers of the quantities that the command is named after, tab-separated."""
    for answer in answers:
        say("\t".join(_cell(answer, name, form) or "-" for name in shape.question.headline), out)


def write_csv(answers: Iterable[Answer], out: TextIO, form: Format, shape: Layout) -> None:
    """Write a header with units and a row for each scene: inputs, then results."""
    write_records(shape.headers(form), _rows(answers, shape, form), "csv", out)


def write_json(answers: Iterable[Answer], out: TextIO, form: Format, shape: Layout) -> None:
    """Write an object for each scene; several scenes are an array, written as they are computed."""
    if shape.size == 1:
        say(json_text(as_object(next(iter(answers)), form), out), out)
        return
    for place, answer in enumerate(answers, 1):
        start = "[\n" if place == 1 else ""
        end = "\n]" if place == shape.size else ","
        say(start + json_text(as_object(answer, form), out) + end, out)


def write_table(answers: Iterable[Answer], out: TextIO, form: Format, shape: Layout) -> None:
    """Write a table for a terminal: the results of one scene below each other, or a row for each scene."""
    from .table import scene_table, sweep_table

    if shape.size == 1:
        scene_table(next(iter(answers)), out, form)
    elif shape.size <= MAX_TABLE:
        sweep_table(list(answers), out, form, shape)
    else:
        write_plain(answers, out, form, shape)


WRITERS = {"plain": write_plain, "bare": write_bare, "csv": write_csv, "json": write_json, "table": write_table}


def _rows(answers: Iterable[Answer], shape: Layout, form: Format) -> Iterator[list[str | None]]:
    """Iterate over the cells of each scene: inputs in SI units, results with their uncertainties as the format has them."""
    columns = shape.columns
    for answer in answers:
        if not shape.sides:
            yield [_cell(answer, name, form) for name in columns]
            continue
        results = {result.name: result for result in answer.results}
        row: list[str | None] = []
        for name in columns:
            sides = results[name].sides() if name in results else {}
            row.append(_cell(answer, name, form))
            row += [form.text(name, sides[side]) if side in sides else None for side in shape.sides.get(name, ())]
        yield row


def _cell(answer: Answer, name: str, form: Format) -> str | None:
    if name in answer.inputs:
        return AS_USUAL.text(name, answer.inputs[name])
    value = answer.value(name)
    return None if value is None else form.text(name, value)


def as_object(answer: Answer, form: Format) -> dict[str, Any]:
    """Return the JSON object of one scene."""
    from .. import __version__

    return {
        "inputs": dict(answer.inputs),
        **({"uncertainties": _of_inputs(answer)} if answer.uncertain else {}),
        "results": [_result_object(result, form) for result in answer.results],
        **({"laws": {BETWEEN: _differences_object(answer.laws)}} if answer.laws else {}),
        "validity": [_verdict_object(verdict) for verdict in answer.validity],
        "notes": [note.text for note in answer.notes],
        "version": __version__,
    }


def _of_inputs(answer: Answer) -> dict[str, Any]:
    return {name: found.as_object() for name, found in answer.uncertain.items()}


def _result_object(result: Result, form: Format) -> dict[str, Any]:
    quantity = NOMENCLATURE[result.name]
    entry: dict[str, Any] = {
        "name": result.name,
        "symbol": quantity.symbol,
        "value": None if result.value is None else float(form.text(result.name, result.value)),
        "unit": form.unit(result.name),
        "equation": result.equation,
        "description": quantity.sentence,
    }
    if result.law:
        entry["model"] = result.law.name
        entry["jkr"] = None if result.law.jkr is None else float(form.text(result.name, result.law.jkr))
    for key in ("note",) if result.law else ("note", "definition", "reference"):
        if text := getattr(quantity, key):
            entry[key] = text
    if result.propagated is not None:
        sides = {side: float(form.text(result.name, number)) for side, number in result.sides().items()}
        entry["uncertainty"] = {"kind": result.propagated.uncertainty.kind, **sides}
        entry["shares"] = dict(result.propagated.shares)
    if result.condition is not None:
        entry["condition"] = result.condition
    if result.by_law:
        entry["by_law"] = {law: float(form.text(result.name, value)) for law, value in result.by_law.items()}
    if result.value is None:
        entry["reason"] = result.reason
    if result.error is not None:
        entry["relative_error"] = result.error
    return entry


def _differences_object(found: Sequence[Difference]) -> dict[str, dict[str, float]]:
    return {
        each.name: {
            "value": each.value,
            "over_jkr": each.ratio,
            "over_jkr_at_half_spacing": each.ratio_at_half_spacing,
        }
        for each in found
    }


def _verdict_object(verdict: Verdict) -> dict[str, Any]:
    return {
        "name": verdict.name,
        "symbol": NOMENCLATURE[verdict.name].symbol,
        "value": verdict.value,
        "holds": verdict.holds,
        "text": verdict.text,
        "code": verdict.code or None,
    }
