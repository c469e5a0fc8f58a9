"""NDJSON: an object a line, with the results as further members of it. The bytes of its own members pass through."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy
import orjson

from .blocks import Block, Results
from .cells import Reader
from .columns import is_input
from .errors import BadTable
from .lines import BOM, Converted, Head, added
from .rows import Evaluator
from .single import Task

Row = dict[str, Any]


class Ndjson:
    """Lines that are JSON objects; the names in the first of them are the columns."""

    def cut(self, text: bytes) -> int:
        """Return the number of bytes of whole lines."""
        return text.rfind(b"\n") + 1

    def head(self, text: bytes) -> tuple[Head, list[list[str]]]:
        """Return the names in the first object, and the values of the first objects. No line is a header."""
        lines = [line for line in text.removeprefix(BOM).splitlines()[:200] if line.strip()]
        if not lines:
            raise BadTable("the table is empty")
        first = _object(lines[0])
        if not first:
            raise BadTable("the first line is not a JSON object with members")
        names = tuple(first)
        sample = [[_text(row.get(name)) for name in names] for row in map(_object, lines) if row is not None]
        return Head(BOM if text.startswith(BOM) else b"", names), sample

    def converter(self, head: Head, task: Task, *, excel_safe: bool) -> NdjsonConverter:
        """Return the converter of the lines. No spreadsheet reads them: `excel_safe` changes nothing."""
        del excel_safe
        return NdjsonConverter(head, task)


class NdjsonConverter:
    """Converts blocks of lines."""

    def __init__(self, head: Head, task: Task) -> None:
        self.head = head.text
        self.evaluator = Evaluator(task)
        self.readers = [Reader(column) for column in task.inputs]
        self.materials_at = task.materials_at
        places = {column.name: column.place for column in task.inputs} | dict(task.materials_at)
        self.keys = {name: head.names[place] for name, place in places.items()}
        self.known = {*head.names}
        names = added(task)
        self.added = {*names}
        self._said = b"".join(orjson.dumps({name: text})[1:-1] + b"," for name, text in task.said.items())
        self._names = [orjson.dumps(name) + b":" for name in names[len(task.said) :]]

    def convert(self, text: bytes) -> Converted:
        """Return whole lines with the results in each."""
        raw = text.removesuffix(b"\n").split(b"\n") if text else []
        lines = [line for line in raw if line.strip()]
        if not lines:
            return Converted(text, 0, 0, text.count(b"\n"), None)
        objects = _objects(lines)
        odd = {row: "is not a JSON object" for row, one in enumerate(objects) if one is None}
        for row, one in enumerate(objects):
            if one is not None and one.keys() != self.known and (word := self._surprise(one)):
                odd[row] = f"has {word!r}, which the first line has not"
        results = self.evaluator.results(self._block(objects, odd))
        output = self._output(raw, objects, results)
        first = min(results.lost, default=None)
        failure = None
        if first is not None:
            places = [place for place, line in enumerate(raw) if line.strip()]
            failure = (places[first], results.status[first])
        return Converted(output, len(lines), len(results.lost), text.count(b"\n"), failure, results.doubtful)

    def _surprise(self, one: Row) -> str | None:
        """Return a name that would be an input or a result if the first line had it."""
        return next((key for key in one if key not in self.known and (is_input(key) or key in self.added)), None)

    def _block(self, objects: Sequence[Row | None], odd: Mapping[int, str]) -> Block:
        rows = [{} if one is None or row in odd else one for row, one in enumerate(objects)] if odd else objects
        columns = {name: _cells([row.get(key) for row in rows if row is not None]) for name, key in self.keys.items()}
        return Block(
            len(rows),
            {reader.column.name: reader.numbers(columns[reader.column.name]) for reader in self.readers},
            {name: columns[name] for name, _ in self.materials_at},
            odd,
            lambda row, name: columns[name][row].decode("utf-8", "replace"),
        )

    def _output(self, raw: Sequence[bytes], objects: Sequence[Row | None], results: Results) -> bytes:
        numbers = orjson.dumps(numpy.ascontiguousarray(results.numbers.T), option=orjson.OPT_SERIALIZE_NUMPY)
        rows = enumerate(numbers[2:-2].split(b"],["))
        output: list[bytes] = []
        for line in raw:
            if not line.strip():
                output.append(line)
                continue
            row, values = next(rows)
            cells = values.split(b",") + [orjson.dumps(texts.get(row)) for texts in results.remarks.values()]
            members = self._said + b",".join(map(bytes.__add__, self._names, cells)) + b"}"
            if objects[row] is None:
                body = b'{"line":' + orjson.dumps(line.decode("utf-8", "replace")) + b","
            else:
                body = line.rstrip().removesuffix(b"}").rstrip() + b"," * bool(objects[row])
            output.append(body + members)
        return b"\n".join(output) + b"\n"


def _objects(lines: Sequence[bytes]) -> Sequence[Row | None]:
    """Return the object of each line; None for a line that is none. A line is read by itself, whatever the others are."""
    try:
        found: list[Any] = [orjson.loads(line) for line in lines]
    except orjson.JSONDecodeError:
        return [_object(line) for line in lines]
    return [one if type(one) is dict else None for one in found]


def _object(line: bytes) -> Row | None:
    """Return the object of a line, or None."""
    try:
        found = orjson.loads(line)
    except orjson.JSONDecodeError:
        return None
    return found if isinstance(found, dict) else None


def _text(value: object) -> str:
    """Return a value as a cell of a table; an empty one for null."""
    if value is None:
        return ""
    return value if isinstance(value, str) else orjson.dumps(value).decode()


def _cells(values: Sequence[Any]) -> list[bytes]:
    """Return values as cells."""
    text = orjson.dumps(values)
    if b'"' in text or b"{" in text or text.count(b"[") > 1:
        return [_text(value).encode() for value in values]
    cells = text[1:-1].split(b",")
    return [b"" if cell == b"null" else cell for cell in cells] if b"null" in text else cells
