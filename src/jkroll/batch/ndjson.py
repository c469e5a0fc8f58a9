"""NDJSON: an object a line, with the results as further members of it. The bytes of its own members pass through."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy
import orjson

from .cells import Reader
from .columns import INPUTS, MATERIALS, STATUS, Header, split
from .errors import BadTable
from .lines import BOM, Converted, Head
from .rows import Block, Evaluator, Results
from .single import Task


class Ndjson:
    """Lines that are JSON objects; the names in the first of them are the columns."""

    def cut(self, text: bytes, *, is_end: bool) -> int:
        """How many bytes of a text are whole lines."""
        return len(text) if is_end else text.rfind(b"\n") + 1

    def head(self, text: bytes) -> Head:
        """No line of a table is its header: the first object says what there is."""
        lines = [line for line in text.removeprefix(BOM).splitlines()[:200] if line.strip()]
        if not lines:
            raise BadTable("the table is empty")
        first = _object(lines[0])
        if not first:
            raise BadTable("the first line is not a JSON object with members")
        rows = [row for row in map(_object, lines) if row is not None]
        names = tuple(first)
        return Head(
            BOM if text.startswith(BOM) else b"", names, [[_text(row.get(name)) for name in names] for row in rows]
        )

    def converter(
        self, head: Head, header: Header, task: Task, names: Sequence[str], *, excel_safe: bool
    ) -> NdjsonConverter:
        """What converts the lines; `names` head the results. No spreadsheet reads them: `excel_safe` changes nothing."""
        del excel_safe
        return NdjsonConverter(head, header, task, names)


class NdjsonConverter:
    """Turns blocks of lines into blocks of lines with results."""

    def __init__(self, head: Head, header: Header, task: Task, names: Sequence[str]) -> None:
        """`names`: of the results."""
        self.head = head.text
        self.task, self.texts = task, header.texts
        self.evaluator = Evaluator(task)
        self.readers = [Reader(column) for column in task.inputs]
        self.names = names
        self.keys = dict.fromkeys(header.texts).keys()
        members = b",".join(orjson.dumps(name).replace(b"%", b"%%") + b":%b" for name in (*names, STATUS))
        self._members = members + b"}"

    def convert(self, text: bytes) -> Converted:
        """Whole lines with the results in each."""
        raw = text.removesuffix(b"\n").split(b"\n") if text else []
        lines = [line for line in raw if line.strip()]
        odd: dict[int, str] = {}
        try:
            objects: list[Any] = orjson.loads(b"[" + b",".join(lines) + b"]")
        except orjson.JSONDecodeError:
            objects = []
        if len(objects) != len(lines) or not all(type(one) is dict for one in objects):
            objects = [_object(line) for line in lines]
            odd = {row: "is not a JSON object" for row, one in enumerate(objects) if one is None}
        for row, one in enumerate(objects):
            if one is not None and one.keys() != self.keys and (word := self._surprise(one)):
                odd[row] = f"has {word!r}, which the first line has not"
        if not lines:
            return Converted(text, 0, 0, text.count(b"\n"), None)
        results = self.evaluator.results(self._block(objects, odd))
        output = self._output(raw, objects, results)
        failure = None
        if results.status:
            first = min(results.status)
            places = [place for place, line in enumerate(raw) if line.strip()]
            failure = (places[first], results.status[first])
        return Converted(output, len(lines), len(results.status), text.count(b"\n"), failure)

    def _surprise(self, one: Mapping[str, Any]) -> str | None:
        """A name that would be an input or a result, had the first line had it."""
        known = {*INPUTS, *MATERIALS}
        return next(
            (key for key in one if key not in self.keys and (split(key)[0] in known or key in (*self.names, STATUS))),
            None,
        )

    def _block(self, objects: Sequence[Any], odd: Mapping[int, str]) -> Block:
        rows = [one if row not in odd else {} for row, one in enumerate(objects)] if odd else objects
        columns = {
            name: _cells([row.get(self.texts[place]) for row in rows])
            for name, place in (*((column.name, column.place) for column in self.task.inputs), *self.task.materials_at)
        }
        return Block(
            len(rows),
            {reader.column.name: reader.numbers(columns[reader.column.name]) for reader in self.readers},
            {name: columns[name] for name, _ in self.task.materials_at},
            odd,
            lambda row, name: columns[name][row].decode("utf-8", "replace"),
        )

    def _output(self, raw: Sequence[bytes], objects: Sequence[Any], results: Results) -> bytes:
        numbers = orjson.dumps(numpy.ascontiguousarray(results.numbers.T), option=orjson.OPT_SERIALIZE_NUMPY)
        cells = [row.split(b",") for row in numbers.replace(b"[", b"").replace(b"],", b"]")[:-1].split(b"]")]
        output: list[bytes] = []
        row = 0
        for line in raw:
            if not line.strip():
                output.append(line)
                continue
            status = results.status.get(row)
            members = self._members % (*cells[row], orjson.dumps(status))
            if objects[row] is None:
                body = b'{"line":' + orjson.dumps(line.decode("utf-8", "replace"))
            else:
                body = line.rstrip().removesuffix(b"}").rstrip()
            output.append(body + (b"," if objects[row] or objects[row] is None else b"") + members)
            row += 1
        return b"\n".join(output) + b"\n"


def _object(line: bytes) -> dict[str, Any] | None:
    """The object of a line; None if it is none."""
    try:
        found = orjson.loads(line)
    except orjson.JSONDecodeError:
        return None
    return found if isinstance(found, dict) else None


def _text(value: object) -> str:
    """A value as a cell of a table; nothing for null."""
    if value is None:
        return ""
    return value if isinstance(value, str) else orjson.dumps(value).decode()


def _cells(values: Sequence[Any]) -> list[bytes]:
    """Values as cells."""
    text = orjson.dumps(values)
    if b'"' in text or b"{" in text or text.count(b"[") > 1:
        return [_text(value).encode() for value in values]
    cells = text[1:-1].split(b",")
    return [b"" if cell == b"null" else cell for cell in cells] if b"null" in text else cells
