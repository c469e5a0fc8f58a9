"""CSV and TSV: blocks of whole records taken apart, and put together again with the results behind each line.

The bytes of a line pass through. A quoted cell may hold separators and line ends; whatever is quoted badly or has a cell too
many or too few spoils its own row only.
"""

from __future__ import annotations

import csv
import io
import re
from collections.abc import Iterator, Mapping, Sequence
from typing import NamedTuple

import numpy
import orjson

from ..text import quoted
from .cells import Numbers, Reader
from .columns import STATUS, Header
from .errors import BadTable
from .lines import BOM, Converted, Head
from .rows import Block, Evaluator, Results
from .single import Task

UTF_16 = (b"\xff\xfe", b"\xfe\xff")
_MISTAKEN = (
    (";", "semicolons", "commas, with decimal points"),
    ("\t", "tabs", "--format tsv"),
    (",", "commas", "--format csv"),
)
MAX_LINES = 100  # of one record
STRIP = 128  # rows written at once: their text stays in the cache
_NUMBER = rb"[+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?"


class Dialect:
    """How cells are separated and records end."""

    def __init__(self, separator: bytes) -> None:
        """`separator`: one byte."""
        self.separator = separator
        mark = re.escape(separator)
        self._closed = re.compile(rb"(?:^|(?<=" + mark + rb'))"(?:[^"]|"")*"(?=' + mark + rb"|\r?\n?\Z)")
        self._open = re.compile(rb"(?:^|" + mark + rb')"')
        self.formula = re.compile(
            rb"(^|" + mark + rb')("?)(?!' + _NUMBER + rb'"?(?:' + mark + rb"|\r?$))(?=[=+\-@\t\r])", re.MULTILINE
        )

    def cut(self, text: bytes, *, is_end: bool) -> int:
        """How many bytes of a text are whole records."""
        if b'"' in text:
            return self.records(text, is_end=is_end)[1]
        return len(text) if is_end else text.rfind(b"\n") + 1

    def head(self, text: bytes) -> Head:
        """The header line of a table, and the rows after it."""
        if not text.strip():
            raise BadTable("the table is empty: it has no header")
        if text.startswith(UTF_16) or b"\0" in text[:200]:
            raise BadTable("the table is not UTF-8; save it as UTF-8")
        first, *others = self.records(text, is_end=True)[0]
        line = first.removeprefix(BOM)
        cells = self.cells(line)
        try:
            names = tuple(cell.decode() for cell in cells or ())
        except UnicodeDecodeError:
            raise BadTable("header: is not UTF-8; save the table as UTF-8") from None
        if cells is None or not line.strip():
            raise BadTable("header: " + ("is empty" if cells is not None else "has a quote that is not closed"))
        for mark, kind, advice in _MISTAKEN:
            if len(names) == 1 and mark in names[0] and b'"' not in line:
                raise BadTable(f"header: {quoted(names[0])} has {kind} between its columns; write {advice}")
        sample = [cells for cells in map(self.cells, others[:200]) if cells is not None and len(cells) == len(names)]
        return Head(first, names, [[cell.decode("utf-8", "replace") for cell in cells] for cells in sample])

    def converter(self, head: Head, header: Header, task: Task, names: Sequence[str], *, excel_safe: bool) -> Delimited:
        """What converts the blocks after it; `names` head the results."""
        return Delimited(self, head, header, task, names, excel_safe=excel_safe)

    def is_open(self, record: bytes) -> bool:
        """Whether a record ends inside quotes."""
        return b'"' in record and self._open.search(self._closed.sub(b"", record)) is not None

    def records(self, text: bytes, *, is_end: bool) -> tuple[list[bytes], int]:
        """The whole records of a text with their line ends, and how many bytes they are; at the end, all of it."""
        lines = text.splitlines(keepends=True) if b"\r" not in text.replace(b"\r\n", b"") else _lines(text)
        if lines and not is_end and not lines[-1].endswith(b"\n"):
            lines.pop()
        if b'"' not in text:
            return lines, sum(map(len, lines))
        records: list[bytes] = []
        place = 0
        while place < len(lines):
            record, size = lines[place], 1
            while self.is_open(record) and size < MAX_LINES and place + size < len(lines):
                record += lines[place + size]
                size += 1
            if self.is_open(record):
                if size < MAX_LINES and not is_end and size + place == len(lines):
                    break
                record, size = lines[place], 1  # never closed: it stands alone
            records.append(record)
            place += size
        return records, sum(map(len, records))

    def cells(self, record: bytes) -> list[bytes] | None:
        """The cells of a record, unquoted; None if a quote is not closed."""
        line = record.rstrip(b"\r\n") if b'"' not in record else record
        if b'"' not in line:
            return line.split(self.separator)
        if self.is_open(record):
            return None
        text = record.decode("utf-8", "surrogateescape")
        separator = self.separator.decode()
        reader = csv.reader(io.StringIO(text, newline=""), delimiter=separator)
        try:
            return [cell.encode("utf-8", "surrogateescape") for row in reader for cell in row]
        except csv.Error:
            return None


def _lines(text: bytes) -> list[bytes]:
    """Lines that end with a line feed: a carriage return alone ends none."""
    lines = [line + b"\n" for line in text.split(b"\n")]
    last = lines.pop()[:-1]
    return lines + ([last] if last else [])


DIALECTS = {"csv": Dialect(b","), "tsv": Dialect(b"\t")}


class Records(NamedTuple):
    """A block taken apart."""

    lines: list[bytes]  # without line ends
    columns: list[list[bytes]]
    odd: Mapping[int, str]  # those that are no rows, and why
    blank: Mapping[int, bytes]  # lines without a cell, by the row before which they stand


class Delimited:
    """Turns blocks of lines into blocks of lines with results."""

    def __init__(
        self, dialect: Dialect, head: Head, header: Header, task: Task, names: Sequence[str], *, excel_safe: bool
    ) -> None:
        """Lines end as the header does."""
        self.dialect = dialect
        self.header = header
        self.line_end = b"\r\n" if head.text.endswith(b"\r\n") else b"\n"
        self.excel_safe = excel_safe
        line = head.text.removeprefix(BOM).removesuffix(b"\n").removesuffix(b"\r")
        cells = [self.safe(line) if excel_safe else line, *(name.encode() for name in (*names, STATUS))]
        self.head = (BOM if head.text.startswith(BOM) else b"") + dialect.separator.join(cells) + self.line_end
        self.evaluator = Evaluator(task)
        self.readers = [Reader(column) for column in task.inputs]
        self.task = task

    def convert(self, text: bytes) -> Converted:
        """Whole records with the results behind each."""
        quick = self._quickly(text)
        lines, columns, odd, blank = quick or self._slowly(text)
        count = len(lines)
        if not count:
            return Converted(blank.get(0, b""), 0, 0, text.count(b"\n"), None)
        results = self.evaluator.results(self._block(count, columns, odd))
        if self.excel_safe:
            lines = [self.safe(line) for line in lines]
        if blank:
            lines = [blank.get(row, b"") + line for row, line in enumerate(lines)]
        output = b"".join([*self._strips(lines, results), blank.get(count, b"")])
        failure = None
        if results.status:
            first = min(results.status)
            failure = (first if quick else self._line_of(text, first), results.status[first])
        return Converted(output, count, len(results.status), text.count(b"\n"), failure)

    def _quickly(self, text: bytes) -> Records | None:
        """Plain lines without quotes, all of the right width; None if there is anything else."""
        width, separator, end = len(self.header.texts), self.dialect.separator, self.line_end
        if b'"' in text or not text.endswith(end):
            return None
        lines = text.split(end)
        lines.pop()
        count = len(lines)
        if text.count(b"\n") != count or text.count(b"\r") != count * (len(end) - 1) or (width == 1 and b"" in lines):
            return None
        cells = text.replace(end, separator + b"\n" + separator).split(separator)
        # As many cells as there should be, and a line feed behind each that should end a line.
        if len(cells) != count * (width + 1) + 1 or cells[width :: width + 1].count(b"\n") != count:
            return None
        return Records(lines, [cells[place : -1 : width + 1] for place in range(width)], {}, {})

    def _slowly(self, text: bytes) -> Records:
        """The same for any lines."""
        width = len(self.header.texts)
        lines: list[bytes] = []
        rows: list[list[bytes]] = []
        odd: dict[int, str] = {}
        blank: dict[int, bytes] = {}
        for record in self.dialect.records(text, is_end=True)[0]:
            line = record.removesuffix(b"\n").removesuffix(b"\r")
            if not line:
                blank[len(lines)] = blank.get(len(lines), b"") + record
                continue
            cells = self.dialect.cells(record)
            if cells is None or len(cells) != width:
                odd[len(lines)] = (
                    "a quote is not closed" if cells is None else f"{_cells(len(cells))} where the header has {width}"
                )
                line = self._squared(line, cells, width)
                cells = [b""] * width
            lines.append(line)
            rows.append(cells)
        return Records(lines, [list(column) for column in zip(*rows, strict=True)], odd, blank)

    def _squared(self, line: bytes, cells: list[bytes] | None, width: int) -> bytes:
        """A line with as many cells as the header: empty ones added, or what is too much kept in the last."""
        separator = self.dialect.separator
        if cells is None:
            return b'"' + line.replace(b'"', b'""') + b'"' + separator * (width - 1)
        if len(cells) < width:
            return line + separator * (width - len(cells))
        kept = [quoted_cell(cell, separator) for cell in cells[: width - 1]]
        return separator.join([*kept, b'"' + separator.join(cells[width - 1 :]).replace(b'"', b'""') + b'"'])

    def _block(self, count: int, columns: Sequence[Sequence[bytes]], odd: Mapping[int, str]) -> Block:
        numbers: dict[str, Numbers] = {}
        for reader in self.readers:
            numbers[reader.column.name] = reader.numbers(columns[reader.column.place])
        places = {column.name: column.place for column in self.task.inputs} | dict(self.task.materials_at)
        return Block(
            count,
            numbers,
            {name: columns[place] for name, place in self.task.materials_at},
            odd,
            lambda row, name: columns[places[name]][row].decode("utf-8", "replace"),
        )

    def _strips(self, lines: Sequence[bytes], results: Results) -> Iterator[bytes]:
        """The output, some rows at a time: each line, and behind it its results, status and line end."""
        separator, end = self.dialect.separator, self.line_end
        said = {row: quoted_cell(status.encode(), separator) for row, status in results.status.items()}
        for start in range(0, len(lines), STRIP):
            numbers = numpy.ascontiguousarray(results.numbers[:, start : start + STRIP].T)
            text = orjson.dumps(numbers, option=orjson.OPT_SERIALIZE_NUMPY)
            if b"n" in text:
                text = text.replace(b"null", b"")
            # [[1,2],[3,4]] becomes ,1,2,\n and ,3,4,\n: the searches for one byte are the quick ones.
            text = b"," + text.replace(b"[", b"").replace(b"]", b"," + end)
            if separator != b",":
                text = text.replace(b",", separator)
            pieces = [b""] * (2 * len(numbers))
            pieces[0::2] = lines[start : start + STRIP]
            pieces[1::2] = io.BytesIO(text).readlines()[: len(numbers)]
            for row in said.keys() & range(start, start + STRIP) if said else ():
                status = self.safe(said[row]) if self.excel_safe else said[row]
                place = 2 * (row - start) + 1
                pieces[place] = pieces[place].removesuffix(end) + status + end
            yield b"".join(pieces)

    def _line_of(self, text: bytes, row: int) -> int:
        """The line, from the start of the block, at which a row begins."""
        line = 0
        for record in self.dialect.records(text, is_end=True)[0]:
            if record.strip(b"\r\n"):
                if row == 0:
                    break
                row -= 1
            line += record.count(b"\n")
        return line

    def safe(self, line: bytes) -> bytes:
        """A line in which no cell of text can be taken for a formula by a spreadsheet."""
        return self.dialect.formula.sub(rb"\1\2'", line)


def _cells(count: int) -> str:
    return f"{count} cell{'s' * (count != 1)}"


def quoted_cell(cell: bytes, separator: bytes) -> bytes:
    """A cell in quotes if it needs them."""
    if separator in cell or b'"' in cell or b"\n" in cell or b"\r" in cell:
        return b'"' + cell.replace(b'"', b'""') + b'"'
    return cell
