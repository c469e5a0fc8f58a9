"""CSV and TSV: records taken apart, and put together again with the results behind each.

The bytes of a record pass through. A quoted cell may hold separators and line ends. A quote that is not closed, or a cell too many
or too few, spoils its own line only.
"""

from __future__ import annotations

import io
import re
from collections.abc import Iterator, Mapping, Sequence
from functools import cache
from itertools import islice
from typing import NamedTuple

import numpy
import orjson

from ..table.blocks import Results
from ..table.cells import Floats
from ..table.columns import is_input
from ..table.errors import BadTable
from ..table.evaluator import Evaluator
from ..table.task import Task
from ..text import quoted
from .lines import BOM, Converted, Head, check_encoding

_MISTAKEN = (
    (";", "semicolons", "commas, with decimal points"),
    ("\t", "tabs", "--format tsv"),
    (",", "commas", "--format csv"),
)
STRIP = 128  # rows written at once: their text stays in the cache
_NUMBER = rb"[+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?"
_PLAIN = rb'[^"\r\n]*+'
_QUOTED = rb'(?:"[^"]*+")++'  # a quote that is doubled ends one piece and begins the next
_OPEN = rb'(?:"[^"]*+")*+"[^"]*+\Z'


class Dialect:
    """The rules by which cells are separated and records end."""

    def __init__(self, name: str, separator: bytes) -> None:
        """`separator`: one byte."""
        self.name, self.separator = name, separator
        mark = re.escape(separator)
        # A quote opens a cell where the cell begins. If the cell does not end with it, the record is none, and ends with that line.
        quotes = rb'(?:(?<=[^%b\n])"|%b(?![^%b\r\n]))' % (mark, _QUOTED, mark)
        cells = rb"%b(?:%b%b)*+" % (_PLAIN, quotes, _PLAIN)
        self._whole = rb"(?:%b(?:\r*+\n|(?!%b)[^\n]++\n))*+" % (cells, _OPEN)
        self._record = rb"((?:\r*+\n|\r++\Z)*+)(%b)(?:\r*+(?:\n|\Z)|([^\n]++)\n?)" % cells
        self._cell = rb"%b(%b|[^%b]*+)" % (mark, _QUOTED, mark)
        self._simple = rb'(?:[^"]*+"(?<![^%b\n]")[^"\r\n%b]*+"(?![^\r\n%b]))*+[^"]*+' % (mark, mark, mark)
        number = rb'%b"?(?:%b|\r?$)' % (_NUMBER, mark)
        self._formula = rb'(?m)(^|%b)("?)(?=[=+\-@\t\r])(?!%b|%b|\r?$)' % (mark, mark, number)

    def cut(self, text: bytes) -> int:
        """Return the number of bytes of whole records at the beginning of a text."""
        if b'"' not in text:
            return text.rfind(b"\n") + 1
        return next(re.finditer(self._whole, text)).end()

    def records(self, text: bytes) -> Iterator[tuple[bytes, bytes, list[bytes], str]]:
        """Iterate over records: the blank lines before, the line without its end, the cells as they are, and why there are none.

        Each line of a record that cannot be taken apart is a record by itself. Behind the last one, blank lines have an empty line.
        """
        find = re.compile(self._cell).findall
        for blank, line, rest in re.findall(self._record, text):
            if rest:
                is_quote = rest.startswith(b'"')
                problem = "a quote is not closed" if is_quote else "a carriage return stands outside quotes"
                first, *others = [part.rstrip(b"\r") for part in (line + rest).split(b"\n")]
                yield blank, first, [], problem
                yield from ((b"", other, [], problem) for other in others)
            elif b'"' in line:
                yield blank, line, find(self.separator + line), ""
            else:
                yield blank, line, line.split(self.separator), ""

    def bare(self, text: bytes) -> bytes:
        """Return a text without quotes; with all of them if a cell needs them, or if one is no cell's."""
        return text.replace(b'"', b"") if b'"' in text and re.fullmatch(self._simple, text) else text

    def joined(self, cells: Sequence[bytes]) -> bytes:
        """Return cells as a line, in quotes where they need them."""
        return self.separator.join([self._quoted(cell) for cell in cells])

    def _quoted(self, cell: bytes) -> bytes:
        if self.separator in cell or b'"' in cell or b"\n" in cell or b"\r" in cell:
            return b'"' + cell.replace(b'"', b'""') + b'"'
        return cell

    def safe(self, lines: bytes) -> bytes:
        """Return lines in which a spreadsheet takes no cell of text for a formula."""
        return re.sub(self._formula, rb"\1\2'", lines)

    def head(self, text: bytes) -> tuple[Head, list[list[str]]]:
        """Return the header of a table, and the cells of the first rows after it. Raises BadTable."""
        check_encoding(text, self.name)
        if not text.strip():
            raise BadTable("the table is empty: it has no header")
        body = text.removeprefix(BOM)
        size = next(re.finditer(self._record, body)).end()
        blank, line, cells, problem = next(self.records(body[:size]))
        try:
            names = [cell.decode() for cell in unquoted(cells)]
            self._check_separator(names, line.decode())
        except UnicodeDecodeError:
            raise BadTable("header: is not UTF-8; save the table as UTF-8") from None
        if problem and b'"' not in line:
            raise BadTable("the lines end in carriage returns alone; save the table with line feeds")
        if problem:
            raise BadTable("header: has a quote that is not closed")
        if blank or not line.strip():
            raise BadTable("header: is empty")
        rows = [cells for _, line, cells, _ in islice(self.records(body[size:]), 200) if line]
        sample = [
            [cell.decode("utf-8", "replace") for cell in unquoted(cells)] for cells in rows if len(cells) == len(names)
        ]
        return Head(text[: len(text) - len(body) + size], tuple(names)), sample

    def _check_separator(self, names: Sequence[str], line: str) -> None:
        """Refuse a header that only another separator makes a header of."""
        is_bare = len(names) == 1 and '"' not in line
        for mark, kind, advice in _MISTAKEN:
            others = line.replace('"', "").split(mark)
            is_other = mark != self.separator.decode() and len(others) > 1 and (is_bare or any(map(is_input, others)))
            if is_other and not any(map(is_input, names)):
                raise BadTable(f"header: {quoted(line.strip())} has {kind} between its columns; write {advice}")

    def converter(self, head: Head, task: Task, *, excel_safe: bool) -> Delimited:
        """Return the converter of the blocks after the head."""
        return Delimited(self, head, task, excel_safe=excel_safe)


DIALECTS = {"csv": Dialect("csv", b","), "tsv": Dialect("tsv", b"\t")}


class Rows(NamedTuple):
    """A block taken apart."""

    lines: list[bytes]  # without line ends, but with the blank lines before them
    columns: Mapping[str, list[bytes]]  # the cells, by the name of the input
    odd: Mapping[int, str]  # records that are no rows, and why
    starts: Sequence[int]  # the line in the block at which each begins
    rest: bytes = b""  # blank lines behind the last


class Delimited:
    """Converts blocks of records."""

    def __init__(self, dialect: Dialect, head: Head, task: Task, *, excel_safe: bool) -> None:
        """Lines of the output end as the header does."""
        self.dialect = dialect
        self.width = len(head.names)
        self.line_end = b"\r\n" if head.text.endswith(b"\r\n") else b"\n"
        self.excel_safe = excel_safe
        cells = [head.text.removeprefix(BOM).rstrip(b"\r\n"), *map(str.encode, task.added)]
        line = dialect.separator.join(cells) + self.line_end
        bom = BOM if head.text.startswith(BOM) else b""
        self.head = bom + (dialect.safe(line) if excel_safe else line)
        self.said = b"".join(dialect.separator + text.encode() for text in task.said.values())
        self.no_remark = dialect.separator * len(task.remarks) + self.line_end
        self.evaluator = Evaluator(task)
        self.places = task.places

    def convert(self, text: bytes) -> Converted:
        """Return whole records with the results behind each."""
        lines, columns, odd, starts, rest = self._quickly(text) or self._carefully(text)
        if not lines:
            return Converted(rest)
        results = self.evaluator.results(self.evaluator.block(len(lines), columns, odd, starts))
        if self.said:
            lines = [line + self.said for line in lines]
        output = b"".join([*self._strips(lines, results), rest])
        return Converted(self.dialect.safe(output) if self.excel_safe else output, results.tally)

    def _quickly(self, text: bytes) -> Rows | None:
        """Take apart lines that need no quotes and have the right width; None if there are others."""
        width, separator = self.width, self.dialect.separator
        text = text.replace(b"\r\n", b"\n")
        bare = self.dialect.bare(text)
        if b'"' in bare or b"\r" in bare or not bare.endswith(b"\n"):
            return None
        lines = text.split(b"\n")
        lines.pop()
        cells = bare.replace(b"\n", separator + b"\n" + separator).split(separator)
        # Behind each line's last cell, and there only, stands a line feed.
        if cells[width :: width + 1] != [b"\n"] * len(lines) or (width == 1 and b"" in lines):
            return None
        columns = {name: cells[place : -1 : width + 1] for name, place in self.places.items()}
        return Rows(lines, columns, {}, range(len(lines)))

    def _carefully(self, text: bytes) -> Rows:
        """Take apart records of any kind."""
        lines: list[bytes] = []
        rows: list[list[bytes]] = []
        odd: dict[int, str] = {}
        starts: list[int] = []
        rest = b""
        place = 0
        for blank, line, cells, problem in self.dialect.records(text):
            if not (line or problem):
                rest += blank
                continue
            place += blank.count(b"\n")
            starts.append(place)
            place += line.count(b"\n") + 1
            if len(cells) == self.width:
                lines.append(blank + line)
                rows.append(cells)
            else:
                cell = "cell" if len(cells) == 1 else "cells"
                odd[len(lines)] = problem or f"{len(cells)} {cell} where the header has {self.width}"
                lines.append(blank + self._squared(line, cells))
                rows.append(rows[-1] if rows else [b""] * self.width)  # read with the others, and not used
        columns = {name: unquoted([row[place] for row in rows]) for name, place in self.places.items()}
        return Rows(lines, columns, odd, starts, rest)

    def _squared(self, line: bytes, cells: Sequence[bytes]) -> bytes:
        """Return a line with as many cells as the header: what is too much stays in the last, and a line without cells in the first."""
        separator, width = self.dialect.separator, self.width
        if not cells:
            return self.dialect.joined([line]) + separator * (width - 1)
        if len(cells) > width:
            end = sum(len(cell) + 1 for cell in cells[: width - 1])
            return line[:end] + self.dialect.joined([line[end:]])
        return line + separator * (width - len(cells))

    def _strips(self, lines: Sequence[bytes], results: Results) -> Iterator[bytes]:
        """Iterate over some lines at a time, with what stands behind each: its numbers, its remarks, and the line end."""
        columns = results.remarks.values()
        remarked = set().union(*columns)

        @cache  # many rows have the same doubts
        def end(*remarks: str) -> bytes:
            cells = self.dialect.joined([text.encode() for text in remarks])
            return self.dialect.separator + cells + self.line_end

        for start in range(0, len(lines), STRIP):
            part = slice(start, start + STRIP)
            rows = written(results.numbers[:, part], self.dialect.separator, self.no_remark)
            for row in remarked.intersection(range(start, start + STRIP)) if remarked else ():
                texts = [column.get(row, "") for column in columns]
                rows[row - start] = rows[row - start].removesuffix(self.no_remark) + end(*texts)
            pieces = [b""] * (2 * len(rows))
            pieces[0::2], pieces[1::2] = lines[part], rows
            yield b"".join(pieces)


def unquoted(cells: list[bytes]) -> list[bytes]:
    """Return cells without the quotes around them."""
    if b'"' not in b"".join(cells):
        return cells
    return [cell[1:-1].replace(b'""', b'"') if cell.startswith(b'"') else cell for cell in cells]


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
