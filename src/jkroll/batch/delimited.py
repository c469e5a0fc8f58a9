"""CSV and TSV: records taken apart, and put together again with the results behind each.

The bytes of a record pass through. A block without a quote is cut at its separators. One with a quote is read by the
csv module, which knows the lines of each record. A quote that is not closed, or a cell too many or too few, spoils its
own line only.
"""

from __future__ import annotations

import csv
import io
import re
from collections.abc import Callable, Iterator, Mapping, Sequence
from itertools import islice, takewhile
from typing import NamedTuple

from ..errors import BadTable
from ..output.writers import Lines, in_quotes
from ..rows.header import is_input
from ..rows.table import Records, Table
from ..rows.words import MATERIALS
from ..text import quoted
from .decimals import has_decimal_commas, points_among_commas, with_points
from .lines import BOM, MAX_RECORD, SAMPLE, Head, check_encoding

_MISTAKEN = (
    (";", "semicolons", "--delimiter semicolon"),
    ("\t", "tabs", "--format tsv"),
    (",", "commas", "--format csv"),
    ("|", "bars", "--delimiter bar"),
    (" ", "blanks", "--delimiter blank"),
)
_COMMENT = re.compile(rb"\A[ \t]*#+ *")
BYTES = "latin-1"  # a character for each byte, as the csv module reads characters
_OPEN = "a quote is not closed"
_MISQUOTED = "a quote is not closed, or text stands behind it"
_CARRIAGE_RETURN = "a carriage return stands outside quotes"
_NUMBER = re.compile(r"[+-]?(\d+[.,]?\d*|[.,]\d+)([eE][+-]?\d+)?")

csv.field_size_limit(MAX_RECORD)  # 128 KiB unless it is raised


class Record(NamedTuple):
    """A record: the places of its first line and of the line behind it, and its cells, or why it has none."""

    start: int
    stop: int
    cells: list[str]
    problem: str = ""


class Dialect:
    """The rules by which cells are separated and records end."""

    def __init__(self, name: str, separator: bytes) -> None:
        """`separator`: one byte."""
        self.name, self.separator, self.mark = name, separator, separator.decode()
        self.blanks = " \t\r\n".replace(self.mark, "")  # a line of these is blank

    def prepared(self, text: bytes) -> bytes:
        """Return whole records as they are read."""
        return text

    def cut(self, text: bytes) -> int:
        """Return the number of bytes of whole records at the beginning of a text."""
        end = text.rfind(b"\n") + 1
        if b'"' not in text:
            return end
        lines = as_lines(text[:end])
        last = next((record.start for record in self.records(lines) if record.problem == _OPEN), len(lines))
        return sum(map(len, lines[:last]))

    def records(self, lines: Sequence[str]) -> Iterator[Record]:
        """Iterate over records. Their cells have a character for each byte. A line that is no record has none."""
        start = 0
        while start < len(lines):
            reader = csv.reader(lines[start:], delimiter=self.mark, strict=True)
            begin = start
            try:
                for cells in reader:
                    yield Record(start, begin + reader.line_num, cells)
                    start = begin + reader.line_num
            except csv.Error as error:
                yield Record(start, start + 1, [], _problem(str(error)))
                start += 1

    def is_blank(self, line: str) -> bool:
        """Return whether a line is no record."""
        return not line.strip(self.blanks)

    def line(self, cells: Sequence[str]) -> str:
        """Return the line of some cells, in quotes where they need them."""
        return self.mark.join(in_quotes(cell, self.mark) for cell in cells)

    # --- The header ---------------------------------------------------------------------------------------------------

    def head(self, block: bytes, is_read: Callable[[str], bool] = is_input, *, excel_safe: bool = False) -> Head:
        """Return the beginning of a table, given its first block. Raises BadTable.

        `is_read`: tells of a header whether its column is one of those that are read. `excel_safe`: as Head has it.
        """
        check_encoding(block, self.name)
        mark = BOM if block.startswith(BOM) else b""
        raw = block.removeprefix(mark).split(b"\n")
        preamble = self._preamble(raw, is_read)
        body = b"\n".join([_COMMENT.sub(b"", raw[preamble]), *raw[preamble + 1 :]])
        if not body.strip():
            raise BadTable("the table is empty: it has no header")
        lines = as_lines(self.prepared(body))
        records = self.records(lines)
        first = next(records)
        if first.problem == _CARRIAGE_RETURN:
            raise BadTable("the lines end in carriage returns alone; save the table with line feeds")
        header = "".join(lines[: first.stop])
        if self.is_blank(header):
            raise BadTable("header: is empty")
        try:
            names = [cell.encode(BYTES).decode() for cell in first.cells or [header]]
            self._check_separator(names, header.encode(BYTES).decode())
        except UnicodeDecodeError:
            raise BadTable("header: is not UTF-8; save the table as UTF-8") from None
        if first.problem:
            raise BadTable("header: has a quote that is not closed")
        rows = islice((record.cells for record in records if not self._is_none(record, lines)), SAMPLE)
        whole = [[cell.encode(BYTES) for cell in cells] for cells in rows if len(cells) == len(names)]
        columns = [*zip(*whole, strict=True)]
        has_commas = self.separator != b"," and has_decimal_commas(
            [*map(is_read, names)], columns, by_all=self.separator == b";"
        )
        first_rows = with_points(whole) if has_commas else whole
        count = preamble + first.stop
        written = self.line(_safe(first.cells)) if excel_safe and any(map(_is_formula, first.cells)) else header
        return Head(
            names=tuple(names),
            sample=[[cell.decode("utf-8", "replace") for cell in row] for row in first_rows],
            writer=Lines(self.mark, end="\r\n" if header.endswith("\r\n") else "\n", has_commas=has_commas),
            size=min(len(mark) + sum(len(line) + 1 for line in raw[:count]), len(block)),
            lines=count,
            preamble=preamble,
            header=mark + written.rstrip("\r\n").encode(BYTES),
            has_decimal_commas=has_commas,
            excel_safe=excel_safe,
        )

    def _preamble(self, lines: Sequence[bytes], is_read: Callable[[str], bool]) -> int:
        """Return the number of lines above the header, which begin with #.

        The last of them that names columns that are read is the header itself, unless the line below all of them names
        some.
        """
        comments = [*takewhile(_COMMENT.match, lines[:SAMPLE])]

        def names_inputs(line: bytes) -> bool:
            cells = self.prepared(_COMMENT.sub(b"", line).strip()).split(self.separator)
            return any(is_read(cell.decode("utf-8", "replace").strip('"')) for cell in cells)

        headers = [place for place, line in enumerate(comments) if names_inputs(line)]
        is_below = not headers or any(map(names_inputs, lines[len(comments) : len(comments) + 1]))
        return min(len(comments), len(lines) - 1) if is_below else headers[-1]

    def _is_none(self, record: Record, lines: Sequence[str]) -> bool:
        """Return whether a record is a blank line."""
        return record.stop == record.start + 1 and self.is_blank(lines[record.start])

    def _check_separator(self, names: Sequence[str], line: str) -> None:
        """Refuse a header that another separator divides, and the line that tells a spreadsheet its separator."""
        if line.casefold().startswith("sep="):
            raise BadTable(
                f"header: {quoted(line.strip())} is for a spreadsheet; delete this line, and write --delimiter "
                "semicolon "
                "if the columns have semicolons between them"
            )
        is_bare = len(names) == 1 and '"' not in line
        for mark, kind, advice in _MISTAKEN:
            others = line.replace('"', "").split(None if mark == " " else mark)
            is_other = mark != self.mark and len(others) > 1 and (is_bare or any(map(is_input, others)))
            if mark == " ":  # which a single header may have
                is_other = is_bare and sum(map(is_input, others)) > 1
            if is_other and not any(map(is_input, names)):
                raise BadTable(f"header: {quoted(line.strip())} has {kind} between its columns; write {advice}")

    # --- Rows ---------------------------------------------------------------------------------------------------------

    def read(self, text: bytes, head: Head, table: Table) -> Records:
        """Return whole records, taken apart."""
        text = self.prepared(text)
        records = self._cut(text, head, table.places) or self._read(text, head, table.places)
        if not head.has_decimal_commas:
            return records
        cells = {name: column for name, column in records.cells.items() if name not in MATERIALS}
        odd = {**dict(points_among_commas(cells.values())), **records.odd}
        points = dict(zip(cells, with_points(cells.values()), strict=True))
        return records._replace(cells={**records.cells, **points}, odd=odd)

    def _cut(self, text: bytes, head: Head, places: Mapping[str, int]) -> Records | None:
        """Cut lines without quotes that have the right width at their separators; None if there are others."""
        width, separator = len(head.names), self.separator
        if b'"' in text or head.excel_safe:
            return None
        if b"\r" in text:  # to search for two bytes takes 100 times as long
            text = text.replace(b"\r\n", b"\n")
        if b"\r" in text or not text.endswith(b"\n"):
            return None
        lines = text.split(b"\n")
        lines.pop()
        cells = text.replace(b"\n", separator + b"\n" + separator).split(separator)
        # Behind each line's last cell, and there only, stands a line feed.
        if cells[width :: width + 1] != [b"\n"] * len(lines) or (width == 1 and not all(map(bytes.strip, lines))):
            return None
        columns = {name: cells[place : -1 : width + 1] for name, place in places.items()}
        return Records(lines, columns, {}, range(len(lines)), len(lines))

    def _read(self, text: bytes, head: Head, places: Mapping[str, int]) -> Records:
        """Read records of any kind."""
        width = len(head.names)
        texts: list[str] = []
        rows: list[list[str]] = []
        odd: dict[int, str] = {}
        starts: list[int] = []
        blank = ""
        lines = as_lines(text)
        for record in self.records(lines):
            line = "".join(lines[record.start : record.stop])
            if self.is_blank(line):
                blank += line
                continue
            cells, line = record.cells, line.rstrip("\r\n")
            if len(cells) != width:
                odd[len(rows)] = record.problem or _of_other_width(len(cells), width)
                cells = self._squared(cells or [line], width)
                line = self.line(cells)
            if head.excel_safe and any(map(_is_formula, cells)):
                line = self.line(_safe(cells))
            starts.append(record.start)
            texts.append(blank + line)
            rows.append(cells)
            blank = ""
        columns = {name: [row[place].encode(BYTES) for row in rows] for name, place in places.items()}
        return Records([text.encode(BYTES) for text in texts], columns, odd, starts, len(lines), blank.encode(BYTES))

    def _squared(self, cells: list[str], width: int) -> list[str]:
        """Return as many cells as the header has: what is too much stays in the last."""
        last = width - 1
        rest = [self.line(cells[last:])] if len(cells) > width else cells[last:]
        return [*cells[:last], *rest, *[""] * (width - len(cells))]


class Blanks(Dialect):
    """The rules of a table with any number of blanks between its columns, which become tabs."""

    def prepared(self, text: bytes) -> bytes:
        """Return lines with tabs. Raises BadTable for quotes, whose blanks would divide a cell."""
        if b'"' in text:
            raise BadTable("a table with blanks between its columns has no quotes; write tabs, and --format tsv")
        return b"\n".join(b"\t".join(line.split()) for line in text.split(b"\n"))


DIALECTS = {"csv": Dialect("csv", b","), "tsv": Dialect("tsv", b"\t")}
DELIMITED = {
    "comma": DIALECTS["csv"],
    "semicolon": Dialect("csv", b";"),
    "bar": Dialect("csv", b"|"),
    "tab": DIALECTS["tsv"],
    "blank": Blanks("tsv", b"\t"),
}
DELIMITED |= dict(zip(",;|\t ", DELIMITED.values(), strict=True))  # by the mark itself


def as_lines(text: bytes) -> list[str]:
    """Return the lines of a text with their ends, a character for each byte."""
    return io.StringIO(text.decode(BYTES), newline="\n").readlines()


def _problem(error: str) -> str:
    """Return the words for an error of the csv module."""
    if error.startswith(("unexpected end", "field larger")):
        return _OPEN
    return _CARRIAGE_RETURN if error.startswith("new-line") else _MISQUOTED


def _is_formula(cell: str) -> bool:
    """Return whether a spreadsheet may take a cell of text for a formula."""
    return cell.startswith(("=", "+", "-", "@", "\t", "\r")) and not _NUMBER.fullmatch(cell)


def _of_other_width(count: int, width: int) -> str:
    size, cells = "short" if count < width else "long", "cell" if count == 1 else "cells"
    return f"row is {size}: {count} {cells} for {width}"


def _safe(cells: Sequence[str]) -> list[str]:
    """Return cells of which a spreadsheet takes none for a formula."""
    return [f"'{cell}" if _is_formula(cell) else cell for cell in cells]
