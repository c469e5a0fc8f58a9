"""The records of CSV and TSV: where they end, and their cells."""

import csv
import re
from collections.abc import Iterator, Sequence
from itertools import islice
from typing import NamedTuple

import numpy

from ..text import quoted
from .columns import is_input
from .errors import BadTable
from .lines import BOM, Head

UTF_16 = (b"\xff\xfe", b"\xfe\xff")
_MISTAKEN = (
    (";", "semicolons", "commas, with decimal points"),
    ("\t", "tabs", "--format tsv"),
    (",", "commas", "--format csv"),
)
MAX_CELL = 1 << 24
_NUMBER = rb"[+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?"
_QUOTE, _LINE_FEED, _RETURN = b'"\n\r'
Places = numpy.ndarray[tuple[int, ...], numpy.dtype[numpy.int64]]


class Record(NamedTuple):
    """A record: how many lines it has, and its cells, or None if it cannot be taken apart."""

    lines: int
    cells: list[str] | None


class Dialect:
    """The rules by which cells are separated and records end."""

    def __init__(self, separator: bytes) -> None:
        """`separator`: one byte."""
        self.separator = separator
        mark = re.escape(separator)
        self.formula = re.compile(
            rb"(^|" + mark + rb')("?)(?!' + _NUMBER + rb'"?(?:' + mark + rb"|\r?$))(?=[=+\-@\t\r])", re.MULTILINE
        )

    def cut(self, text: bytes) -> int:
        """Return the number of bytes of whole records."""
        if b'"' not in text:
            return text.rfind(b"\n") + 1
        ends = self._record_ends(text)
        if ends is not None:
            return int(ends[-1]) + 1 if len(ends) else 0
        lines = lines_of(text[: text.rfind(b"\n") + 1])
        place = sum(record.lines for record in self.records(lines, is_end=False))
        return sum(map(len, lines[:place]))

    def _record_ends(self, text: bytes) -> Places | None:
        """Return the places of the line feeds that end records; None if a quote stands where it should not.

        Where every cell is quoted well, an even number of quotes stands before the end of a record.
        """
        characters = numpy.frombuffer(b"\n" + text + b"\n", dtype=numpy.uint8)
        quotes = numpy.flatnonzero(characters == _QUOTE)
        openers, closers = quotes[0::2], quotes[1::2]
        before, after = characters[openers - 1], characters[closers + 1]
        mark = self.separator[0]
        opens_well = (before == mark) | (before == _LINE_FEED) | (before == _QUOTE)
        closes_well = (after == mark) | (after == _LINE_FEED) | (after == _RETURN) | (after == _QUOTE)
        if not (opens_well.all() and closes_well.all()):
            return None
        feeds = numpy.flatnonzero(characters[1:-1] == _LINE_FEED)
        ends: Places = feeds[numpy.searchsorted(quotes, feeds + 1) % 2 == 0]
        return ends

    def head(self, text: bytes) -> tuple[Head, list[list[str]]]:
        """Return the header line of a table, and the cells of the first rows after it."""
        if not text.strip():
            raise BadTable("the table is empty: it has no header")
        if text.startswith(UTF_16) or b"\0" in text[:200]:
            raise BadTable("the table is not UTF-8; save it as UTF-8")
        bom = BOM if text.startswith(BOM) else b""
        lines = lines_of(text.removeprefix(BOM))
        if b"\r" in lines[0].rstrip(b"\r\n") and b'"' not in lines[0]:
            raise BadTable("the lines end in carriage returns alone; save the table with line feeds")
        rows = [*islice(self.records(lines), 200)]
        try:
            lines[0].decode()
        except UnicodeDecodeError:
            raise BadTable("header: is not UTF-8; save the table as UTF-8") from None
        size, names = rows[0]
        self._check_separator(names or [], lines[0].decode().strip())
        if names is None or not lines[0].strip():
            raise BadTable("header: " + ("is empty" if names is not None else "has a quote that is not closed"))
        sample = [cells for _, cells in rows[1:] if cells is not None and len(cells) == len(names)]
        return Head(bom + b"".join(lines[:size]), tuple(names)), sample

    def _check_separator(self, names: list[str], line: str) -> None:
        """Refuse a header that only another separator makes a header of."""
        for mark, kind, advice in _MISTAKEN:
            if mark == self.separator.decode():
                continue
            others = line.replace('"', "").split(mark)
            is_other = len(names) == 1 and mark in names[0] and '"' not in line
            if is_other or (len(others) > 1 and any(map(is_input, others)) and not any(map(is_input, names))):
                raise BadTable(f"header: {quoted(line)} has {kind} between its columns; write {advice}")

    def records(self, lines: Sequence[bytes], *, is_end: bool = True) -> Iterator[Record]:
        """Iterate over the records of lines. Unless it is the end, a record that is not closed is left out.

        A line that cannot be taken apart is a record by itself, and the lines after it are read again. No line is read more
        than twice for that: the next quote that is not doubled ends the reading of a cell, well or badly.
        """
        csv.field_size_limit(MAX_CELL)
        texts = [line.decode("utf-8", "surrogateescape") for line in lines]
        separator = self.separator.decode()
        stack: list[str | None] = []  # lines to read, the next one last
        reader, read, place = csv.reader([]), 0, 0
        while place < len(texts):
            if not stack or read == 0:
                stack = stack or [None, *reversed(texts)]
                reader = csv.reader(iter(stack.pop, None), delimiter=separator, strict=True)
            try:
                cells: list[str] | None = next(reader)
                size, read = reader.line_num - read, reader.line_num
            except csv.Error:
                if not stack and not is_end:
                    return
                unread = texts[place + 1 : place + reader.line_num - read]
                stack = [*(stack or [None]), *reversed(unread)]
                cells, size, read = None, 1, 0
            yield Record(size, cells)
            place += size


def lines_of(text: bytes) -> list[bytes]:
    """Return the lines of a text with their line feeds."""
    lines = [line + b"\n" for line in text.split(b"\n")]
    last = lines.pop()[:-1]
    return lines + ([last] if last else [])
