"""NDJSON: lines of JSON objects as records of a table."""

import json
from collections import Counter
from collections.abc import Mapping, Sequence
from contextlib import suppress
from types import MappingProxyType
from typing import Any

import orjson

from ..errors import BadRequest, BadTable
from ..text import quoted
from ..write.writers import Objects
from .cells import cell_of, cells_of
from .header import meaning_of
from .layouts import SAMPLE
from .table import Records, Table

Object = dict[str, Any]


class Ndjson:
    """A table with a JSON object in each line; the names in the first one are its columns."""

    lines = 0  # there is no header
    header, remarks = b"", ()
    writer = Objects()

    def cut(self, text: bytes) -> int:
        """Return the number of bytes of whole lines."""
        return text.rfind(b"\n") + 1

    def read_header(self, block: bytes, stated: Mapping[str, str] = MappingProxyType({}), measured: str = "") -> int:  # noqa: ARG002
        """Read the names in the first object, and the values of the first objects; return 0. Raises BadTable.

        `stated`: see `meaning_of`.
        """
        self.stated = stated
        lines = [line for line in block.split(b"\n")[:SAMPLE] if line.strip()]
        if not lines:
            raise BadTable("the table is empty")
        first = _object(lines[0])
        if not first:
            raise BadTable("the first line is not a JSON object with members")
        name = _twice(lines[0], first)
        if name:
            raise BadTable(f"header: two columns are called {quoted(name)}; rename one")
        self.names = tuple(first)
        objects = [*filter(None, map(_object, lines))]
        self.sample = [[cell_of(row.get(name)) for name in first] for row in objects]
        return 0

    def head(self, added: Sequence[str]) -> bytes:
        """Return the text above the rows: there is none."""
        return self.writer.header(added, [self.header])

    def read(self, text: bytes, table: Table) -> Records:
        """Return lines as records."""
        every = text.split(b"\n")
        starts = [position for position, line in enumerate(every) if line.strip()]
        lines = [every[position] for position in starts]
        objects = [*map(_object, lines)]
        problems = [self._problem(line, members, table) for line, members in zip(lines, objects, strict=True)]
        odd = {row: BadRequest(problem) for row, problem in enumerate(problems) if problem}
        rows = [members or {} for members in objects]
        cells = {}
        for name, position in table.positions.items():
            cells[name] = cells_of([row.get(self.names[position]) for row in rows])
        return Records([*map(_beginning, lines, objects)], cells, odd, starts, len(every) - 1)

    def _problem(self, line: bytes, members: Object | None, table: Table) -> str:
        """Return why a line is not a row; an empty text if it is.

        It is not without an object, with a duplicate member, or with an input or result that the first line lacks.
        """
        if members is None:
            return "is not a JSON object"
        name = _twice(line, members)
        if name:
            return f"has {quoted(name)} twice"
        asked = table.asked
        for name in members.keys() - self.names:
            cells = [cell_of(members[name])]
            if name in table.added or meaning_of(name, cells, asked.stated, asked.measured).name:
                return f"has {quoted(name)}, which the first line does not have"
        return ""


def _beginning(line: bytes, members: Object | None) -> bytes:
    """Return the object of a line without its end; if it is not an object, one with the line as a text."""
    if members is None:
        return b'{"line":' + orjson.dumps(line.decode("utf-8", "replace")) + b","
    return line.rstrip().removesuffix(b"}").rstrip() + b"," * bool(members)


def _object(line: bytes) -> Object | None:
    """Return the object in a line, or None if it contains anything else."""
    with suppress(orjson.JSONDecodeError):
        value = orjson.loads(line)
        return value if isinstance(value, dict) else None
    return None


def _twice(line: bytes, members: Object) -> str:
    """Return the name of a duplicate member in the object of a line, or ""; orjson keeps the last one silently."""
    if line.count(b":") == len(members):  # each member has a colon
        return ""
    with suppress(RecursionError):
        counts = Counter[str](name for name, _ in json.loads(line, object_pairs_hook=list))
        for name, count in counts.items():
            if count > 1:
                return name
    return ""
