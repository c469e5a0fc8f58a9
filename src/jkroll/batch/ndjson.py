"""NDJSON: an object a line, with the results as further members of it. The bytes of its own members pass through."""

from __future__ import annotations

import json
from collections import Counter
from collections.abc import Callable, Sequence
from contextlib import suppress
from typing import Any

import orjson

from ..errors import BadTable
from ..output.writers import Objects
from ..rows.header import meaning_of
from ..rows.table import Records, Table
from ..text import quoted
from .lines import BOM, SAMPLE, Head, check_encoding

Object = dict[str, Any]
_UNWRITTEN = "[...]"  # stands for a value that is nested too deeply


class Ndjson:
    """Lines that are JSON objects; the names in the first of them are the columns."""

    def cut(self, text: bytes) -> int:
        """Return the number of bytes of whole lines."""
        return text.rfind(b"\n") + 1

    def head(self, block: bytes, is_read: Callable[[str], bool] = bool, *, excel_safe: bool = False) -> Head:
        """Return the names in the first object, and the values of the first objects. No line is a header.

        JSON has no decimal commas, and no spreadsheet reads it: `is_read` and `excel_safe` change nothing.
        """
        del is_read, excel_safe
        check_encoding(block, "ndjson")
        mark = BOM if block.startswith(BOM) else b""
        lines = [line for line in block.removeprefix(mark).split(b"\n")[:SAMPLE] if line.strip()]
        if not lines:
            raise BadTable("the table is empty")
        first = _object(lines[0])
        if not first:
            raise BadTable("the first line is not a JSON object with members")
        if (name := _twice(lines[0], first)) is not None:
            raise BadTable(f"header: two columns {quoted(name)}, of which one must go")
        names = tuple(first)
        sample = [[_text(row.get(name)) for name in names] for row in map(_object, lines) if row is not None]
        return Head(names, sample, Objects(), size=len(mark), header=mark)

    def read(self, text: bytes, head: Head, table: Table) -> Records:
        """Return whole lines, taken apart."""
        every = text.removesuffix(b"\n").split(b"\n")
        starts = [place for place, line in enumerate(every) if line.strip()]
        lines = [every[place] for place in starts]
        objects = [*map(_object, lines)]
        known = {*head.names}
        problems = (_problem(line, members, known, table) for line, members in zip(lines, objects, strict=True))
        odd = {row: problem for row, problem in enumerate(problems) if problem}
        members = [each or {} for each in objects]
        cells = {name: _cells([row.get(head.names[place]) for row in members]) for name, place in table.places.items()}
        blank = [every[stop + 1 : start] for stop, start in zip([-1, *starts], [*starts, len(every)], strict=True)]
        *above, rest = (b"".join(line + b"\n" for line in lines) for lines in blank)
        before = [*map(bytes.__add__, above, map(_beginning, lines, objects))]
        return Records(before, cells, odd, starts, len(every), rest)


def _problem(line: bytes, members: Object | None, known: set[str], table: Table) -> str:
    """Return why a line is no row; an empty text if it is one.

    It is none without an object, with a member twice, or with an input or result that the first line lacks. `known`:
    the names in the first line.
    """
    if members is None:
        return "is not a JSON object"
    if (name := _twice(line, members)) is not None:
        return f"has {quoted(name)} twice"
    if members.keys() == known:
        return ""
    others = members.keys() - known
    surprises = (
        name
        for name in members
        if name in others
        and (name in table.added or meaning_of(name, [_text(members[name]).strip()], table.meanings).name)
    )
    return next((f"has {quoted(name)}, which the first line does not have" for name in surprises), "")


def _beginning(line: bytes, members: Object | None) -> bytes:
    """Return the object of a line without its end; one that holds the line as a text where it is no object."""
    if members is None:
        return b'{"line":' + orjson.dumps(line.decode("utf-8", "replace")) + b","
    return line.rstrip().removesuffix(b"}").rstrip() + b"," * bool(members)


def _object(line: bytes) -> Object | None:
    """Return the object that a line holds by itself, or None."""
    try:
        value = orjson.loads(line)
    except orjson.JSONDecodeError:
        return None
    return value if isinstance(value, dict) else None


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
