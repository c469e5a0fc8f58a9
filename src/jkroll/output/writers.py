"""Answers to text: a table on a terminal, plain lines in a pipe, bare numbers, CSV, JSON.

Nothing a user or a file wrote is ever taken for markup, and nothing is cut where it does not fit.
"""

from collections.abc import Iterable
from typing import Any, TextIO

from ..answers.answer import Answer
from ..quantities.formatting import AS_USUAL, Format
from ..quantities.nomenclature import NOMENCLATURE
from ..text import fitting, json_text, say
from .layout import Layout, layout

MAX_TABLE = 10_000  # rows that are set as a table


def write_plain(answers: Iterable[Answer], out: TextIO, form: Format, shape: Layout) -> None:
    """One scene: a line `name value unit` a result. Several: a table with tabs, its header first."""
    if shape.size > 1:
        say("\t".join(shape.headers(form)), out)
        for answer in answers:
            say("\t".join(cell or "-" for cell in row(answer, shape.columns, form)), out)
        return
    for result in next(iter(answers)).results:
        if result.value is not None:
            say(
                f"{result.name} {form.text(result.name, result.value)} {form.unit(result.name)}".removesuffix(" 1"), out
            )


def write_bare(answers: Iterable[Answer], out: TextIO, form: Format, shape: Layout) -> None:
    """A line a scene: the numbers of the quantities that the command is named after, with tabs between them."""
    for answer in answers:
        say("\t".join(cell or "-" for cell in row(answer, shape.command.headline, form)), out)


def write_csv(answers: Iterable[Answer], out: TextIO, form: Format, shape: Layout) -> None:
    """A header with units and a row a scene: inputs, then results; a cell without a value is empty."""
    import csv

    rows = list(answers) if shape.size == 1 else answers
    shape = layout(shape.command, rows, 1) if shape.size == 1 else shape
    writer = csv.writer(out, lineterminator="\n")
    writer.writerow([fitting(text, out) for text in shape.headers(form)])
    for answer in rows:
        writer.writerow([fitting(cell, out) for cell in row(answer, shape.columns, form)])


def write_json(answers: Iterable[Answer], out: TextIO, form: Format, shape: Layout) -> None:
    """An object a scene; an array of them if there are several."""
    for place, answer in enumerate(answers):
        text = json_text(as_object(answer, form), out)
        if shape.size > 1:
            text = ("[\n" if place == 0 else "") + text + ("\n]" if place == shape.size - 1 else ",")
        say(text, out)


def as_object(answer: Answer, form: Format) -> dict[str, Any]:
    """The JSON object of one scene."""
    from .. import __version__

    results = []
    for result in answer.results:
        quantity = NOMENCLATURE[result.name]
        entry = {
            "name": result.name,
            "symbol": quantity.symbol,
            "value": None if result.value is None else float(form.text(result.name, result.value)),
            "unit": form.unit(result.name),
            "equation": quantity.equation,
            "description": quantity.sentence,
        }
        if quantity.note:
            entry["note"] = quantity.note
        if result.value is None:
            entry["reason"] = result.reason
        if result.error is not None:
            entry["relative_error"] = result.error
        results.append(entry)
    validity = [
        {
            "name": one.name,
            "symbol": NOMENCLATURE[one.name].symbol,
            "value": one.value,
            "holds": one.holds,
            "text": one.text,
        }
        for one in answer.validity
    ]
    return {
        "inputs": dict(answer.inputs),
        "results": results,
        "validity": validity,
        "notes": [note.text for note in answer.notes],
        "version": __version__,
    }


def row(answer: Answer, names: Iterable[str], form: Format) -> list[str]:
    """The cells of one scene; empty where it has no value."""
    cells = []
    for name in names:
        if name in answer.inputs:
            cells.append(AS_USUAL.text(name, answer.inputs[name]))
        else:
            value = answer.value(name)
            cells.append("" if value is None else form.text(name, value))
    return cells


def write_table(answers: Iterable[Answer], out: TextIO, form: Format, shape: Layout) -> None:
    """A table for a terminal: the results of one scene below each other, or a row a scene."""
    from .table import scene_table, sweep_table

    if shape.size == 1:
        scene_table(next(iter(answers)), out, form)
    elif shape.size <= MAX_TABLE:
        sweep_table(list(answers), out, form, shape)
    else:
        write_plain(answers, out, form, shape)


WRITERS = {"plain": write_plain, "bare": write_bare, "csv": write_csv, "json": write_json, "table": write_table}
