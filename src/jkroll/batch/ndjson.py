"""NDJSON: an object a line, with the results as further members of it. The bytes of its own members pass through."""

from __future__ import annotations

import json
from collections import Counter
from collections.abc import Callable, Sequence
from contextlib import suppress
from typing import Any

import orjson

from ..errors import BadTable
from ..output.records import LINE_FORMATS, Members
from ..quantities.formatting import Format
from ..rows.header import holds_input
from ..rows.table import Table
from ..text import quoted
from .lines import BOM, SAMPLE, Converted, Head, check_encoding, computed

Object = dict[str, Any]
_UNWRITTEN = "[...]"  # stands for a value that is nested too deeply


class Ndjson:
    """Lines that are JSON objects; the names in the first of them are the columns."""

    def cut(self, text: bytes) -> int:
        """Return the number of bytes of whole lines."""
        return text.rfind(b"\n") + 1

    def without_preamble(self, text: bytes, is_read: Callable[[str], bool]) -> tuple[bytes, int]:
        """Return lines as they are read, of which none is a comment."""
        del is_read
        return text, 0

    def prepared(self, text: bytes) -> bytes:
        """Return whole lines as they are read."""
        return text

    def head(self, text: bytes, is_read: Callable[[str], bool] = bool) -> tuple[Head, list[list[str]]]:
        """Return the names in the first object, and the values of the first objects. No line is a header."""
        del is_read  # JSON has no decimal commas
        check_encoding(text, "ndjson")
        lines = [line for line in text.removeprefix(BOM).split(b"\n")[:SAMPLE] if line.strip()]
        if not lines:
            raise BadTable("the table is empty")
        first = _object(lines[0])
        if not first:
            raise BadTable("the first line is not a JSON object with members")
        if (name := _twice(lines[0], first)) is not None:
            raise BadTable(f"header: two columns {quoted(name)}, of which one must go")
        names = tuple(first)
        sample = [[_text(row.get(name)) for name in names] for row in map(_object, lines) if row is not None]
        return Head(BOM if text.startswith(BOM) else b"", names), sample

    def converter(self, head: Head, table: Table, *, strict: bool, excel_safe: bool) -> NdjsonConverter:
        """Return the converter of the lines. No spreadsheet reads them: `excel_safe` changes nothing."""
        del excel_safe
        return NdjsonConverter(head, table, strict=strict)


class NdjsonConverter:
    """Converts blocks of lines."""

    def __init__(self, head: Head, table: Table, *, strict: bool) -> None:
        """`strict`: whether the first row that fails is an error."""
        self.header_line, self.table, self.strict = head.text, table, strict
        self.keys = {name: head.names[place] for name, place in table.places.items()}
        self.known = {*head.names}
        self.added = {*table.added}
        self.said = b"".join(orjson.dumps({name: text})[1:-1] + b"," for name, text in table.said.items())
        self.writer = Members(LINE_FORMATS["ndjson"], table.wanted, Format({}), table.remarks)

    def convert(self, text: bytes) -> Converted:
        """Return whole lines with the results in each. Blank lines stay."""
        lines = text.removesuffix(b"\n").split(b"\n")
        places = [place for place, line in enumerate(lines) if line.strip()]
        if not places:
            return Converted(text, len(lines))
        objects = [_object(lines[place]) for place in places]
        odd = {row: problem for row, one in enumerate(objects) if (problem := self._problem(lines[places[row]], one))}
        rows = [one or {} for one in objects]
        cells = {name: _cells([row.get(key) for row in rows]) for name, key in self.keys.items()}
        block = self.table.block(len(rows), cells, odd)
        columns, tally = computed(self.table.wanted, block, places, strict=self.strict)
        beginnings = [_beginning(lines[place], row) + self.said for place, row in zip(places, objects, strict=True)]
        written = self.writer.text(beginnings, columns).split(b"\n")
        for place, line in zip(places, written, strict=False):
            lines[place] = line
        return Converted(b"\n".join([*lines, b""]), len(lines), tally)

    def _problem(self, line: bytes, one: Object | None) -> str:
        """Return why a line is no row; an empty text if it is one.

        It is none without an object, with a member twice, or with an input or result that the first line lacks.
        """
        if one is None:
            return "is not a JSON object"
        if (name := _twice(line, one)) is not None:
            return f"has {quoted(name)} twice"
        if one.keys() == self.known:
            return ""
        meanings, others = self.table.meanings, one.keys() - self.known
        surprises = (
            name
            for name in one
            if name in others and (name in self.added or holds_input(name, _text(one[name]), meanings))
        )
        return next((f"has {quoted(name)}, which the first line does not have" for name in surprises), "")


def _beginning(line: bytes, one: Object | None) -> bytes:
    """Return the object of a line without its end; one that holds the line as a text where it is no object."""
    if one is None:
        return b'{"line":' + orjson.dumps(line.decode("utf-8", "replace")) + b","
    return line.rstrip().removesuffix(b"}").rstrip() + b"," * bool(one)


def _object(line: bytes) -> Object | None:
    """Return the object that a line holds by itself, or None."""
    try:
        found = orjson.loads(line)
    except orjson.JSONDecodeError:
        return None
    return found if isinstance(found, dict) else None


def _twice(line: bytes, read: Object) -> str | None:
    """Return the name of a member that stands twice in the object of a line, or None. orjson keeps the last one."""
    if line.count(b":") == len(read):  # each member has a colon
        return None
    members: list[tuple[str, Any]] = []
    with suppress(RecursionError):
        members = json.loads(line, object_pairs_hook=list)
    return next((name for name, count in Counter(name for name, _ in members).items() if count > 1), None)


def _text(value: object) -> str:
    """Return a value as a cell of a table; an empty one for null."""
    if value is None:
        return ""
    try:
        return value if isinstance(value, str) else orjson.dumps(value).decode()
    except orjson.JSONEncodeError:  # it does not write all that it reads: a nesting of 300
        return _UNWRITTEN


def _cells(values: Sequence[Any]) -> list[bytes]:
    """Return values as cells."""
    try:
        text = orjson.dumps(values)
    except orjson.JSONEncodeError:
        return [_text(value).encode() for value in values]
    if b'"' in text or b"{" in text or text.count(b"[") > 1:
        return [_text(value).encode() for value in values]
    cells = text[1:-1].split(b",")
    return [b"" if cell == b"null" else cell for cell in cells] if b"null" in text else cells
