"""Answers to text: a table on a terminal, plain lines in a pipe, bare numbers, CSV, JSON.

Nothing a user or a file wrote is ever taken for markup, and nothing is cut where it does not fit.
"""

import json
from collections.abc import Iterable, Sequence
from typing import Any, TextIO

from .answer import Answer, Command
from .formatting import Format
from .nomenclature import NOMENCLATURE, header

_ASCII = {
    "γ": "gamma", "δ": "delta", "ν": "nu", "ρ": "rho", "ξ": "xi", "π": "pi", "ω": "omega", "Ω": "Omega", "α": "alpha",
    "µ": "u", "√": "sqrt", "∛": "cbrt", "⟨": "<", "⟩": ">", "²": "^2", "³": "^3", "⁴": "^4", "⁵": "^5", "½": "1/2 ", "¼": "1/4 ", "â": "ahat",
    "𝒜": "A", "Å": "angstrom", "\u0302": "hat", "−": "-", "–": "-", "—": "-", "·": "*", "×": "x", "≪": "<<", "≥": ">=",
    "≤": "<=", "≈": "~", "→": "->", "∞": "inf",
}  # fmt: skip


def ascii_text(text: str) -> str:
    """A text in ASCII, Greek letters by their names and apart from what stands beside them.

    >>> ascii_text("P_c = 3πγR, 50 µm")
    'P_c = 3 pi gamma R, 50 um'
    """
    pieces = [""]
    for character in text:
        piece = _ASCII.get(character, character)
        is_spelt = len(piece) > 1 and piece.isalpha()
        was_spelt = len(pieces[-1]) > 1 and pieces[-1].isalpha()
        if pieces[-1][-1:].isalnum() and (is_spelt or (was_spelt and character.isalpha())):
            pieces.append(" ")
        pieces.append(piece)
    return "".join(pieces).encode("ascii", "replace").decode()


def fitting(text: str, out: TextIO) -> str:
    """A text as the stream can write it: unchanged, or in ASCII."""
    try:
        text.encode(out.encoding or "utf-8")
    except (UnicodeEncodeError, LookupError):
        return ascii_text(text)
    return text


def say(text: str, out: TextIO) -> None:
    """Print a line."""
    print(fitting(text, out), file=out)


def write_plain(answers: Sequence[Answer], out: TextIO, form: Format, command: Command) -> None:
    """One scene: a line `name value unit` a result. Several: a table with tabs, its header first."""
    if len(answers) > 1:
        names = columns(answers, command)
        say("\t".join(headers(answers, names, form)), out)
        for answer in answers:
            say("\t".join(cell or "-" for cell in row(answer, names, form)), out)
        return
    for result in answers[0].results:
        if result.value is not None:
            say(
                f"{result.name} {form.text(result.name, result.value)} {form.unit(result.name)}".removesuffix(" 1"), out
            )


def write_bare(answers: Sequence[Answer], out: TextIO, form: Format, command: Command) -> None:
    """A line a scene: the numbers of the quantities that the command is named after, with tabs between them."""
    for answer in answers:
        say("\t".join(cell or "-" for cell in row(answer, command.headline, form)), out)


def write_csv(answers: Sequence[Answer], out: TextIO, form: Format, command: Command) -> None:
    """A header with units and a row a scene: inputs, then results; a cell without a value is empty."""
    import csv

    names = columns(answers, command)
    writer = csv.writer(out, lineterminator="\n")
    writer.writerow(headers(answers, names, form))
    writer.writerows(row(answer, names, form) for answer in answers)


def write_json(answers: Sequence[Answer], out: TextIO, form: Format, _: Command) -> None:
    """An object a scene; an array of them if there are several."""
    objects = [as_object(answer, form) for answer in answers]
    say(
        json.dumps(
            objects[0] if len(objects) == 1 else objects, ensure_ascii=out.encoding.lower() != "utf-8", indent=2
        ),
        out,
    )


def as_object(answer: Answer, form: Format) -> dict[str, Any]:
    """The JSON object of one scene."""
    from . import __version__

    results = []
    for result in answer.results:
        quantity = NOMENCLATURE[result.name]
        number = None if result.value is None else json.loads(form.text(result.name, result.value))
        entry = {
            "name": result.name,
            "symbol": quantity.symbol,
            "value": number,
            "unit": form.unit(result.name),
            "equation": quantity.equation,
            "description": quantity.sentence,
        }
        if quantity.note:
            entry["note"] = quantity.note
        if result.value is None:
            entry["reason"] = result.reason
        results.append(entry)
    return {"inputs": dict(answer.inputs), "results": results, "notes": list(answer.notes), "version": __version__}


def columns(answers: Sequence[Answer], command: Command) -> list[str]:
    """The names of a table's columns: all inputs of its rows, then all results."""
    inputs = {name for answer in answers for name in answer.inputs}
    results = {result.name for answer in answers for result in answer.results}
    return [name for name in NOMENCLATURE if name in inputs] + [name for name in command.quantities if name in results]


def headers(answers: Sequence[Answer], names: Iterable[str], form: Format) -> list[str]:
    """The column headers: inputs in SI units, results as they are to be written."""
    results = {result.name for answer in answers for result in answer.results}
    return [form.header(name) if name in results else header(name) for name in names]


def row(answer: Answer, names: Iterable[str], form: Format) -> list[str]:
    """The cells of one scene; empty where it has no value."""
    inputs_form = form._replace(units={})
    cells = []
    for name in names:
        if name in answer.inputs:
            cells.append(inputs_form.text(name, answer.inputs[name]))
        else:
            value = answer.value(name)
            cells.append("" if value is None else form.text(name, value))
    return cells


def write_table(answers: Sequence[Answer], out: TextIO, form: Format, command: Command) -> None:
    """A table for a terminal: the results of one scene below each other, or a row a scene."""
    from .table import scene_table, sweep_table

    if len(answers) == 1:
        scene_table(answers[0], out, form)
    else:
        sweep_table(answers, out, form, command)


WRITERS = {"plain": write_plain, "bare": write_bare, "csv": write_csv, "json": write_json, "table": write_table}
