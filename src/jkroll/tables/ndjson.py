"""NDJSON: a table with a JSON object in each line."""

import json
from collections import Counter
from collections.abc import Mapping, Sequence
from contextlib import suppress
from types import MappingProxyType
from typing import Any

import orjson

from ..errors import BadRequest, BadTable, JkrollError
from ..text import quoted
from ..write.writers import Objects
from .cells import cell_of, cells_of
from .header import meaning_of
from .layouts import SAMPLE
from .table import Records, Table

Object = dict[str, Any]


class Ndjson:
    """A table with a JSON object in each line. The members of the first object name its columns."""

    lines = 0  # there is no header
    header, remarks = b"", ()
    writer = Objects()

    def cut(self, text: bytes) -> int:
        """Return the number of bytes of whole lines."""
        return text.rfind(b"\n") + 1

    def read_header(self, block: bytes, stated: Mapping[str, str] = MappingProxyType({}), measured: str = "") -> int:  # noqa: ARG002
        """Read the names in the first object, and the values in the first lines. Raises BadTable.

        Return the number of bytes above the rows, which is 0. `stated`: see `meaning_of`.
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
        """Return the text above the rows, which is empty."""
        return self.writer.header(added, [self.header])

    def read(self, text: bytes, table: Table) -> Records:
        """Return the records of a block of lines."""
        all_lines = text.split(b"\n")
        starts = [position for position, line in enumerate(all_lines) if line.strip()]
        lines = [all_lines[position] for position in starts]
        objects = [*map(_object, lines)]
        odd: dict[int, JkrollError] = {}
        for row, (line, members) in enumerate(zip(lines, objects, strict=True)):
            problem = self._problem(line, members, table)
            if problem:
                odd[row] = BadRequest(f"the line {problem}", problem)
        rows = [members or {} for members in objects]
        cells = {}
        for name, position in table.positions.items():
            cells[name] = cells_of([row.get(self.names[position]) for row in rows])
        return Records([*map(_beginning, lines, objects)], cells, odd, starts, len(all_lines) - 1)

    def _problem(self, line: bytes, members: Object | None, table: Table) -> str:
        """Return the reason why a line is not a row; "" if there is none.

        A row is an object without a repeated member, and without an input or a result that the first line lacks.
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
    """Return the beginning of an output line: the object of the input line, without its closing brace.

    A line without an object becomes the member "line" of one.
    """
    if members is None:
        return b'{"line":' + orjson.dumps(line.decode("utf-8", "replace")) + b","
    return line.rstrip().removesuffix(b"}").rstrip() + b"," * bool(members)


def _object(line: bytes) -> Object | None:
    """Return the object in a line; None for any other line."""
    with suppress(orjson.JSONDecodeError):
        value = orjson.loads(line)
        return value if isinstance(value, dict) else None
    return None


def _twice(line: bytes, members: Object) -> str:
    """Return the name of a member that an object has twice, or ""; orjson silently keeps the last one."""
    if line.count(b":") == len(members):  # each member has a colon
        return ""
    with suppress(RecursionError):
        counts = Counter[str](name for name, _ in json.loads(line, object_pairs_hook=list))
        for name, count in counts.items():
            if count > 1:
                return name
    return ""
