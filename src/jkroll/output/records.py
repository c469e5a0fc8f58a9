"""Records in columns and answers as text: a table on a terminal, plain lines in a pipe, bare numbers, CSV, JSON.

Text of a user or a file is never read as markup, and nothing is cut where it does not fit.
"""

from collections.abc import Iterable, Iterator, Mapping, Sequence
from itertools import chain, groupby
from math import isnan
from typing import TYPE_CHECKING, Any, NamedTuple, TextIO

from ..quantities.formatting import Format, in_words
from ..quantities.laws import other_law
from ..quantities.nomenclature import INFINITY, NOMENCLATURE, header
from ..quantities.values import is_uncertain
from ..rows.columns import DOUBT, STATUS, Columns, Wanted, as_list, remarks_of
from ..scene.limits import codes
from ..text import json_text, say, spelled

if TYPE_CHECKING:
    from ..answers.answer import Answer
    from ..answers.results import Result
    from ..scene.limits import Doubt

Cell = str | float | None


def write_records(heads: Sequence[str], records: Iterable[Sequence[Cell]], kind: str, out: TextIO) -> None:
    """Write records in a format: "table", "plain", "csv" or "json".

    A cell without a value is None. It is written as "—", "-", an empty cell or null.
    """
    if kind == "json":
        say(json_text([dict(zip(heads, record, strict=True)) for record in records], out), out)
    elif kind == "table":
        from .table import write_rows

        write_rows(heads, [["—" if cell is None else _text(cell) for cell in record] for record in records], out)
    else:
        line_format = LINE_FORMATS[kind]
        for record in chain([heads], records):
            say(
                line_format.separator.join(
                    line_format.gap if cell is None else _quoted(_text(cell), line_format) for cell in record
                ),
                out,
            )


def _text(cell: str | float) -> str:
    return spelled(cell) if isinstance(cell, float) else str(cell)


# --- Columns ----------------------------------------------------------------------------------------------------------


class LineFormat(NamedTuple):
    """The rules of a format whose rows are lines."""

    separator: str
    gap: str = ""
    has_header: bool = True
    has_remarks: bool = True  # doubts and status of a row, behind its numbers
    is_json: bool = False


LINE_FORMATS = {
    "csv": LineFormat(","),
    "tsv": LineFormat("\t"),
    "plain": LineFormat("\t", "-", has_remarks=False),
    "bare": LineFormat("\t", "-", has_header=False, has_remarks=False),
    "ndjson": LineFormat(",", "null", has_header=False, is_json=True),
}


def names_of_columns(wanted: Wanted, form: Format) -> list[str]:
    """Return the headers of inputs, in SI units, and of results with their uncertainties, as the format has them."""
    return [*map(header, wanted.inputs), *wanted.heads(form.header)]


def lines(kind: str, wanted: Wanted, blocks: Iterable[Columns], form: Format, *, doubt: bool = True) -> Iterator[bytes]:
    """Iterate over the text of columns, block by block: first the header, if the format has one.

    `doubt`: whether doubts have a column, if they are judged.
    """
    line_format = LINE_FORMATS[kind]
    remarks = remarks_of(wanted, doubt=doubt) if line_format.has_remarks else ()
    names = [*names_of_columns(wanted, form), *remarks]
    if line_format.has_header:
        yield line_format.separator.join(_quoted(name, line_format) for name in names).encode() + b"\n"
    separator = line_format.separator.encode()
    for columns in blocks:
        cells = [*_inputs(columns, line_format), *_results(columns, form, line_format)]
        if DOUBT in remarks:
            cells.append([_cell(codes(bits), line_format) for bits in as_list(columns.doubts)])
        if STATUS in remarks:
            cells.append([_cell(columns.status.get(row), line_format) for row in range(len(columns))])
        if line_format.is_json:
            keys = [b"%b:" % _json_text(name) for name in names]
            rows = zip(*(_cells(column, line_format.gap) for column in cells), strict=True)
            text = [b"{" + b",".join(map(bytes.__add__, keys, row)) + b"}\n" for row in rows]
        else:
            text = [line + b"\n" for line in joined(cells, separator, line_format.gap.encode())]
        yield b"".join(text)


def joined(columns: Sequence[Any], separator: bytes, gap: bytes) -> list[bytes]:
    """Return the lines of columns: lists of cells, or arrays of numbers, in which nan is a gap."""
    parts: list[Sequence[bytes]] = []
    for is_list, some in groupby(columns, lambda column: isinstance(column, list)):
        if is_list:
            parts.append([*map(separator.join, zip(*some, strict=True))])
        else:
            parts.append([line[1:] for line in numbers_in_lines([*some], separator, gap)])
    return [*map(separator.join, zip(*parts, strict=True))]


def numbers_in_lines(columns: Any, separator: bytes, gap: bytes) -> list[bytes]:
    """Return the numbers of each row as a line without its end, each behind a separator. nan is a gap."""
    import numpy
    import orjson

    rows = columns.T if isinstance(columns, numpy.ndarray) else numpy.column_stack(columns)
    text = orjson.dumps(numpy.ascontiguousarray(rows) + 0.0, option=orjson.OPT_SERIALIZE_NUMPY)
    if gap != b"null" and b"n" in text:
        text = text.replace(b"null", gap)
    text = b"," + text.replace(b"[", b"")  # ,1,2],3,4]] of [[1,2],[3,4]]: one byte is found fast
    if separator != b",":
        text = text.replace(b",", separator)
    return text.split(b"]")[: len(rows)]


def _inputs(columns: Columns, line_format: LineFormat) -> Iterator[Any]:
    for name, column in columns.inputs.items():
        if isinstance(column, list) or (abs(column) == INFINITY).any():
            yield [_cell(in_words(name, value), line_format) for value in as_list(middles(column))]
        else:
            yield column


def middles(column: Any) -> Any:
    """Return the column of an input without uncertainties."""
    return [one.value if is_uncertain(one) else one for one in column] if isinstance(column, list) else column


def _results(columns: Columns, form: Format, line_format: LineFormat) -> Iterator[Any]:
    for name in columns.wanted.names:
        for key in columns.wanted.keys_of(name):
            column = columns.column(key)
            if isinstance(column, list) or form.changes(name):
                yield [
                    _cell(None if isnan(value) else form.number(name, value), line_format) for value in as_list(column)
                ]
            else:
                yield column


def _cells(column: Any, gap: str) -> list[bytes]:
    """Return the cells of a column."""
    if isinstance(column, list):
        return column
    return [line[1:] for line in numbers_in_lines([column], b",", gap.encode())]


def _cell(value: str | float | None, line_format: LineFormat) -> bytes:
    if value is None or value == "" or (not isinstance(value, str) and isnan(value)):
        return line_format.gap.encode()
    if isinstance(value, str):
        return _json_text(value) if line_format.is_json else _quoted(value, line_format).encode()
    return spelled(value + 0.0).encode()


def _quoted(text: str, line_format: LineFormat) -> str:
    """Return a text, in quotes where CSV needs them."""
    if line_format.separator == "," and any(mark in text for mark in '",\r\n'):
        return '"' + text.replace('"', '""') + '"'
    return text


def _json_text(text: str) -> bytes:
    from json.encoder import encode_basestring

    return encode_basestring(text).encode()


# --- Objects ----------------------------------------------------------------------------------------------------------


def write_plain(answer: "Answer", out: TextIO, form: Format, *, alternatives: bool = False) -> None:
    """Write a line `name value unit` for each result of a scene, and for each side of its uncertainty.

    `alternatives`: whether what may stand in its place under the other law has a line, too.
    """
    by_law = answer.laws if alternatives else {}
    if "model" in answer.inputs:
        say(f"model {answer.inputs['model']}", out)
    for result in answer.results:
        if result.value is not None:
            numbers = {result.name: result.value} | {
                f"{result.name}_{side}": number for side, number in result.sides().items()
            }
            if (value := by_law.get(result.name, {}).get("value")) is not None:
                numbers[f"{result.name}_by_{other_law(answer.scene.law.name)}"] = value
            for name, number in numbers.items():
                say(
                    f"{name} {spelled(form.number(result.name, number))} {form.unit(result.name)}".removesuffix(" 1"),
                    out,
                )


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
        sides = {side: form.number(result.name, number) for side, number in result.sides().items()}
        entry["uncertainty"] = {"kind": result.propagated.uncertainty.kind, **sides}
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


def _law_object(name: str, numbers: Mapping[str, float | None], form: Format) -> dict[str, float | None]:
    """Return what stands in place of a quantity under another law, in its unit."""
    value = numbers["value"]
    shown = None if value is None else form.number(name, value)
    return {**numbers, "value": shown}


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
