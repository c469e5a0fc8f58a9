"""CSV and TSV: blocks of whole records taken apart, and put together again with the results behind each line.

The bytes of a line pass through. A quoted cell may hold separators and line ends; a line that is quoted badly or has a cell too
many or too few spoils its own row only.
"""

from __future__ import annotations

import io
from collections.abc import Iterator, Mapping, Sequence
from typing import NamedTuple

import numpy
import orjson

from .blocks import Results
from .cells import Floats
from .dialect import Dialect, lines_of
from .lines import BOM, Converted, Head
from .rows import Evaluator
from .task import Task

STRIP = 128  # rows written at once: their text stays in the cache


class DelimitedFormat(Dialect):
    """CSV or TSV."""

    def converter(self, head: Head, task: Task, *, excel_safe: bool) -> Delimited:
        """Return the converter of the blocks after the head."""
        return Delimited(self, head, task, excel_safe=excel_safe)


DIALECTS = {"csv": DelimitedFormat(b","), "tsv": DelimitedFormat(b"\t")}


class Records(NamedTuple):
    """A block taken apart."""

    lines: list[bytes]  # without line ends
    columns: Mapping[str, list[bytes]]  # the cells, by the name of the input
    odd: Mapping[int, str]  # records that are no rows, and why
    blank: Mapping[int, bytes]  # lines without a cell, by the row before which they stand
    starts: Sequence[int]  # the line in the block at which each begins


class Delimited:
    """Converts blocks of lines."""

    def __init__(self, dialect: Dialect, head: Head, task: Task, *, excel_safe: bool) -> None:
        """Lines of the output end as the header does."""
        self.dialect = dialect
        self.width = len(head.names)
        self.line_end = b"\r\n" if head.text.endswith(b"\r\n") else b"\n"
        self.excel_safe = excel_safe
        line = head.text.removeprefix(BOM).rstrip(b"\r\n")
        cells = [self.safe(line) if excel_safe else line, *map(str.encode, task.added)]
        self.head = (BOM if head.text.startswith(BOM) else b"") + dialect.separator.join(cells) + self.line_end
        self.said = b"".join(dialect.separator + text.encode() for text in task.said.values())
        self.no_remark = dialect.separator * len(task.remarks) + self.line_end
        self.evaluator = Evaluator(task)
        self.places = task.places

    def convert(self, text: bytes) -> Converted:
        """Return whole records with the results behind each."""
        records = self._quickly(text) or self._carefully(text)
        lines, blank = records.lines, records.blank
        count = len(lines)
        if not count:
            return Converted(blank.get(0, b""), text.count(b"\n"))
        results = self.evaluator.results(self.evaluator.block(count, records.columns, records.odd, records.starts))
        if self.excel_safe:
            lines = [self.safe(line) for line in lines]
        if self.said:
            lines = [line + self.said for line in lines]
        if blank:
            lines = [blank.get(row, b"") + line for row, line in enumerate(lines)]
        output = b"".join([*self._strips(lines, results), blank.get(count, b"")])
        return Converted(output, text.count(b"\n"), results.tally)

    def _quickly(self, text: bytes) -> Records | None:
        """Take apart plain lines without quotes, all of the right width; None if there are others."""
        width, separator, end = self.width, self.dialect.separator, self.line_end
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
        columns = {name: cells[place : -1 : width + 1] for name, place in self.places.items()}
        return Records(lines, columns, {}, {}, range(count))

    def _carefully(self, text: bytes) -> Records:
        """Take apart lines of any kind."""
        all_lines = lines_of(text)
        lines: list[bytes] = []
        rows: list[list[str]] = []
        starts: list[int] = []
        odd: dict[int, str] = {}
        blank: dict[int, list[bytes]] = {}
        nothing = [""] * self.width
        end = 0
        for size, cells in self.dialect.records(all_lines):
            start, end = end, end + size
            record = all_lines[start] if size == 1 else b"".join(all_lines[start:end])
            if cells is not None and not cells:
                blank.setdefault(len(lines), []).append(record)
                continue
            line = record.rstrip(b"\r\n")
            if cells is None or len(cells) != self.width:
                odd[len(lines)] = self._problem(line, cells)
                lines.append(self._squared(line, cells))
                rows.append(nothing)
            else:
                lines.append(line)
                rows.append(cells)
            starts.append(start)
        columns = {name: _column([row[place] for row in rows]) for name, place in self.places.items()}
        return Records(lines, columns, odd, {row: b"".join(some) for row, some in blank.items()}, starts)

    def _problem(self, line: bytes, cells: list[str] | None) -> str:
        if cells is not None:
            return f"{len(cells)} cell{'s' * (len(cells) != 1)} where the header has {self.width}"
        return "a quote is not closed" if b'"' in line else "a carriage return stands outside quotes"

    def _squared(self, line: bytes, cells: list[str] | None) -> bytes:
        """Return a line with as many cells as the header: empty ones added, or what is too much kept in the last."""
        separator, width = self.dialect.separator, self.width
        if cells is None:
            return b'"' + line.replace(b'"', b'""') + b'"' + separator * (width - 1)
        if len(cells) < width:
            return line + separator * (width - len(cells))
        encoded = [*map(_encoded, cells)]
        kept = [quoted_cell(cell, separator) for cell in encoded[: width - 1]]
        return separator.join([*kept, b'"' + separator.join(encoded[width - 1 :]).replace(b'"', b'""') + b'"'])

    def _strips(self, lines: Sequence[bytes], results: Results) -> Iterator[bytes]:
        """Iterate over the pieces of the output, some rows at a time: each line, its results, its remarks and line end."""
        separator = self.dialect.separator
        columns = results.remarks.values()
        texts = {row: tuple(column.get(row, "") for column in columns) for row in set().union(*columns)}
        cells = {several: self._cells(several) for several in set(texts.values())}  # many rows have the same doubts
        for start in range(0, len(lines), STRIP):
            part = slice(start, start + STRIP)
            rows = written(results.numbers[:, part], separator, self.no_remark)
            for row in texts.keys() & range(start, start + STRIP) if texts else ():
                rows[row - start] = rows[row - start].removesuffix(self.no_remark) + cells[texts[row]]
            pieces = [b""] * (2 * len(rows))
            pieces[0::2], pieces[1::2] = lines[part], rows
            yield b"".join(pieces)

    def _cells(self, texts: tuple[str, ...]) -> bytes:
        """Return the cells behind the numbers of a row, and the line end."""
        separator = self.dialect.separator
        cells = [quoted_cell(text.encode(), separator) for text in texts]
        if self.excel_safe:
            cells = [*map(self.safe, cells)]
        return separator + separator.join(cells) + self.line_end

    def safe(self, line: bytes) -> bytes:
        """Return a line in which a spreadsheet takes no cell of text for a formula."""
        return self.dialect.formula.sub(rb"\1\2'", line)


def written(numbers: Floats, separator: bytes, end: bytes) -> list[bytes]:
    """Return the text of the numbers of each row, from an array for each column; nan is an empty cell.

    A separator stands before each number, and behind the last an `end`, which is that of a line.
    """
    text = orjson.dumps(numpy.ascontiguousarray(numbers.T), option=orjson.OPT_SERIALIZE_NUMPY)
    if b"n" in text:
        text = text.replace(b"null", b"")
    text = b"," + text.replace(b"[", b"")  # ,1,2],3,4]] of [[1,2],[3,4]]
    if separator != b",":
        text = text.replace(b",", separator)
    # To read lines takes a third of the time of a split, which looks at every byte.
    return io.BytesIO(text.replace(b"]", end)).readlines()[: numbers.shape[1]]


def _column(cells: Sequence[str]) -> list[bytes]:
    """Return cells as bytes: all at once, unless one holds what is put between them."""
    encoded = _encoded("\0".join(cells)).split(b"\0") if cells else []
    return encoded if len(encoded) == len(cells) else [*map(_encoded, cells)]


def _encoded(cell: str) -> bytes:
    return cell.encode("utf-8", "surrogateescape")


def quoted_cell(cell: bytes, separator: bytes) -> bytes:
    """Return a cell, in quotes if it needs them."""
    if separator in cell or b'"' in cell or b"\n" in cell or b"\r" in cell:
        return b'"' + cell.replace(b'"', b'""') + b'"'
    return cell
