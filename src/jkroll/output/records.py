"""Records in columns and answers as text: a table on a terminal, plain lines in a pipe, bare numbers, CSV, JSON.

Text of a user or a file is never read as markup, and nothing is cut where it does not fit.
"""

from collections.abc import Iterable, Iterator, Mapping, Sequence
from itertools import chain
from math import isnan
from typing import TYPE_CHECKING, Any, NamedTuple, TextIO

from ..quantities.formatting import Format, in_words
from ..quantities.laws import other_law
from ..quantities.nomenclature import INFINITY, NOMENCLATURE, header
from ..rows.columns import DOUBT, STATUS, Columns, Wanted, as_list, middle, remarks_of
from ..scene.limits import codes
from ..text import json_text, say, spelled

if TYPE_CHECKING:
    from ..answers.answer import Answer
    from ..answers.results import Result
    from ..scene.limits import Doubt

Cell = str | float | None
STRIP = 128  # rows written at once: their text stays in the cache


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
    writer = (Members if line_format.is_json else Lines)(line_format, wanted, form, remarks)
    if line_format.has_header:
        heads = [_quoted(name, line_format).encode() for name in map(header, wanted.inputs)]
        yield writer.head(heads)
    for columns in blocks:
        cells = [_cells(column, line_format) for column in _inputs(columns)]
        yield writer.text(writer.beginnings(cells, len(columns)), columns)


class Lines:
    """Rows as lines: what stands before their results, the numbers, doubts and status."""

    def __init__(
        self,
        line_format: LineFormat,
        wanted: Wanted,
        form: Format,
        remarks: Sequence[str],
        *,
        end: bytes = b"\n",
        has_commas: bool = False,
    ) -> None:
        """`has_commas`: whether decimal marks are commas."""
        self.line_format, self.wanted, self.form, self.remarks = line_format, wanted, form, remarks
        self.separator, self.end, self.has_commas = line_format.separator.encode(), end, has_commas
        self.is_changed = any(map(form.changes, wanted.names))
        self._plain_ends: dict[int, bytes] = {}  # by the bits of doubts: many rows have the same

    def head(self, before: Sequence[bytes]) -> bytes:
        """Return the line of the headers; `before`: those before the results."""
        names = [_quoted(name, self.line_format) for name in (*self.wanted.heads(self.form.header), *self.remarks)]
        return self.separator.join([*before, *map(str.encode, names)]) + self.end

    def beginnings(self, cells: Sequence[Sequence[bytes]], size: int) -> list[bytes]:
        """Return what stands before the results of rows, given the cells of these columns."""
        return [*map(self.separator.join, zip(*cells, strict=True))] if cells else [b""] * size

    def text(self, before: Sequence[bytes], columns: Columns) -> bytes:
        """Return the lines of rows."""
        ends = self._ends(columns)
        parts = []
        for part, numbers in self._numbers(columns):
            is_first = not before[part.start]  # nothing stands before the results
            rows = [row[1:] for row in numbers] if is_first else numbers
            pieces = [b""] * (3 * len(rows))
            pieces[0::3], pieces[1::3], pieces[2::3] = before[part], rows, ends[part]
            parts.append(b"".join(pieces))
        return b"".join(parts)

    def _numbers(self, columns: Columns) -> Iterator[tuple[slice, list[bytes]]]:
        """Iterate over the numbers of some rows at a time, each behind a separator."""
        size, separator = len(columns), self.separator
        if self.is_changed or isinstance(columns.numbers, list):
            cells = [_cells(column, self.line_format) for column in shown_results(columns, self.form)]
            yield slice(0, size), [separator + row for row in map(separator.join, zip(*cells, strict=True))]
            return
        for start in range(0, size, STRIP):
            part = slice(start, start + STRIP)
            rows = numbers_in_lines(columns.numbers[:, part], separator, self.line_format.gap.encode())
            yield part, [row.replace(b".", b",") for row in rows] if self.has_commas else rows

    def _ends(self, columns: Columns) -> list[bytes]:
        """Return the remarks on each row with the end of the line."""
        bits = as_list(columns.doubts)
        for each in {*bits} - self._plain_ends.keys():
            self._plain_ends[each] = self._end(each, "")
        ends = [self._plain_ends[each] for each in bits]
        if STATUS in self.remarks:
            worded: dict[tuple[int, str], bytes] = {}
            for row, status in columns.status.items():
                key = (bits[row], status)
                if key not in worded:
                    worded[key] = self._end(*key)
                ends[row] = worded[key]
        return ends

    def _end(self, bits: int, status: str) -> bytes:
        texts = {DOUBT: codes(bits) if DOUBT in self.remarks else "", STATUS: status}
        cells = [_quoted(texts[name], self.line_format).encode() for name in self.remarks]
        return b"".join(self.separator + cell for cell in cells) + self.end


class Members(Lines):
    """Rows as objects, whose further members are the results."""

    def beginnings(self, cells: Sequence[Sequence[bytes]], size: int) -> list[bytes]:
        """Return the beginnings of objects with some members."""
        keys = [_json_text(header(name)) + b":" for name in self.wanted.inputs]
        rows = [b"".join(map(b"%b%b,".__mod__, zip(keys, row, strict=True))) for row in zip(*cells, strict=True)]
        return [b"{" + row for row in rows or [b""] * size]

    def text(self, before: Sequence[bytes], columns: Columns) -> bytes:
        """Return the lines of rows; `before`: their objects, as far as they go."""
        keys = [_json_text(name) + b":" for name in (*self.wanted.heads(self.form.header), *self.remarks)]
        cells = [_cells(column, self.line_format) for column in shown_results(columns, self.form)]
        if DOUBT in self.remarks:
            cells.append([_cell(codes(bits), self.line_format) for bits in as_list(columns.doubts)])
        cells.append([_cell(columns.status.get(row), self.line_format) for row in range(len(columns))])
        rows = [b",".join(map(bytes.__add__, keys, row)) for row in zip(*cells, strict=True)]
        return b"".join(map(b"%b%b}\n".__mod__, zip(before, rows, strict=True)))


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


def _inputs(columns: Columns) -> Iterator[Any]:
    """Iterate over the columns of inputs: arrays, or lists in which an infinite input is a word."""
    for name, column in columns.inputs.items():
        if isinstance(column, list) or (abs(column) == INFINITY).any():
            yield [in_words(name, value) for value in as_list(middles(column))]
        else:
            yield column


def middles(column: Any) -> Any:
    """Return the column of an input without uncertainties."""
    return [*map(middle, column)] if isinstance(column, list) else column


def shown_results(columns: Columns, form: Format) -> Iterator[Any]:
    """Iterate over the columns of results, in their units and with their digits; nan is a gap."""
    for name in columns.wanted.names:
        for key in columns.wanted.keys_of(name):
            column = columns.column(key)
            if form.changes(name):
                column = [value if isnan(value) else form.number(name, value) for value in as_list(column)]
            yield column


def _cells(column: Any, line_format: LineFormat) -> list[bytes]:
    """Return the cells of a column."""
    if isinstance(column, list):
        return [_cell(value, line_format) for value in column]
    return [line[1:] for line in numbers_in_lines([column], b",", line_format.gap.encode())]


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
