"""CSV and TSV: records taken apart, and put together again with the results behind each.

The bytes of a record pass through. A quoted cell may hold separators and line ends. A quote that is not closed, or a
cell too many or too few, spoils its own line only.
"""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from itertools import chain, compress, islice
from typing import NamedTuple

from ..output.records import numbers_in_lines
from ..rows.cells import Kept
from ..rows.columns import Columns
from ..rows.header import BadTable, is_input
from ..rows.readings import MATERIALS
from ..rows.table import Table
from ..scene.limits import codes
from ..text import quoted
from .lines import BOM, SAMPLE, Converted, Head, check_encoding, computed

_MISTAKEN = (
    (";", "semicolons", "--delimiter semicolon"),
    ("\t", "tabs", "--format tsv"),
    (",", "commas", "--format csv"),
    ("|", "bars", "--delimiter bar"),
    (" ", "blanks", "--delimiter blank"),
)
_DECIMAL_POINT = re.compile(rb"\.\d")
_MARKED = re.compile(rb"\d*[.,][\d.,]*\d(?:[eE][+-]?\d+)?")  # a number with a point or a comma
_OTHER_MARK = {b",": b".", b".": b","}
_OF_THOUSANDS = re.compile(rb"[1-9]\d{0,2}(?:[.,]\d{3})*")
_NUMERIC = re.compile(rb"\s*[-+(]?[\d.,]")  # the beginning of numbers, with an error bar or not
STRIP = 128  # rows written at once: their text stays in the cache
_NUMBER = rb"[+-]?(?:\d+%b?\d*|%b\d+)(?:[eE][+-]?\d+)?"  # with a point, or a comma
_PLAIN = rb'[^"\r\n]*+'
_QUOTED = rb'(?:"[^"]*+")++'  # a quote that is doubled ends one piece and begins the next
_OPEN = rb'(?:"[^"]*+")*+"[^"]*+\Z'


class Dialect:
    """The rules by which cells are separated and records end."""

    comment = b""  # which may stand before the header

    def __init__(self, name: str, separator: bytes) -> None:
        """`separator`: one byte."""
        self.name, self.separator = name, separator
        mark = re.escape(separator)
        # A quote opens a cell where the cell begins. If the cell does not end with it, the record is none, and ends with that line.
        quotes = rb'(?:(?<=[^%b\n])"|%b(?![^%b\r\n]))' % (mark, _QUOTED, mark)
        cells = rb"%b(?:%b%b)*+" % (_PLAIN, quotes, _PLAIN)
        self._whole = rb"(?:%b(?:\r*+\n|(?!%b)[^\n]++\n))*+" % (cells, _OPEN)
        blanks = b"[ \t]*+".replace(separator, b"")  # a line of blanks is blank
        blank = rb"(?:%b\r*+\n|%b\r++\Z|%b(?<=[ \t])\Z)" % (blanks, blanks, blanks)
        self._record = rb"(%b*+)(%b)(?:\r*+(?:\n|\Z)|([^\n]++)\n?)" % (blank, cells)
        self._cell = rb"%b(%b|[^%b]*+)" % (mark, _QUOTED, mark)
        self._simple = rb'(?:[^"]*+"(?<![^%b\n]")[^"\r\n%b]*+"(?![^\r\n%b]))*+[^"]*+' % (mark, mark, mark)
        point = rb"\." if separator == b"," else rb"[.,]"
        number = rb'%b"?(?:%b|\r?$)' % (_NUMBER % (point, point), mark)
        self._formula = rb'(?m)(^|%b)("?)(?=[=+\-@\t\r])(?!%b|%b|\r?$)' % (mark, mark, number)

    def prepared(self, text: bytes) -> bytes:
        """Return whole records as they are read."""
        return text

    def cut(self, text: bytes) -> int:
        """Return the number of bytes of whole records at the beginning of a text."""
        if b'"' not in text:
            return text.rfind(b"\n") + 1
        return next(re.finditer(self._whole, text)).end()

    def records(self, text: bytes) -> Iterator[tuple[bytes, bytes, list[bytes], str]]:
        """Iterate over records: the blank lines before, the line without its end, the cells as they are, and why there are none.

        Each line of a record that cannot be taken apart is a record by itself. Behind the last one, blank lines have an
        empty line.
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

    def quoted(self, cell: bytes) -> bytes:
        """Return a cell, in quotes if it needs them."""
        if self.separator in cell or b'"' in cell or b"\n" in cell or b"\r" in cell:
            return b'"' + cell.replace(b'"', b'""') + b'"'
        return cell

    def safe(self, lines: bytes) -> bytes:
        """Return lines in which a spreadsheet takes no cell of text for a formula."""
        return re.sub(self._formula, rb"\1\2'", lines)

    def head(self, text: bytes, is_read: Callable[[str], bool] = is_input) -> tuple[Head, list[list[str]]]:
        """Return the header of a table, and the cells of the first rows after it. Raises BadTable.

        `is_read`: tells of a header whether its column is one of those that are read.
        """
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
        rows = [cells for _, line, cells, _ in islice(self.records(body[size:]), SAMPLE) if line]
        whole = [unquoted(cells) for cells in rows if len(cells) == len(names)]
        has_commas = self.separator != b"," and self._have_commas([*map(is_read, names)], [*zip(*whole, strict=True)])
        first_rows = with_points(whole) if has_commas else whole
        sample = [[cell.decode("utf-8", "replace") for cell in row] for row in first_rows]
        return Head(text[: len(text) - len(body) + size], tuple(names), has_commas), sample

    def _have_commas(self, are_read: Sequence[bool], columns: Sequence[Sequence[bytes]]) -> bool:
        """Return whether the numbers of a table have decimal commas. Raises BadTable for those that may be of thousands.

        The columns that are read decide; all columns where their marks may be either, or where they have none between
        semicolons, which are written in place of commas. Where nothing decides, points are decimal.
        """
        read, every = (
            Counter(map(_decimal_mark, chain.from_iterable(map(_marked_numbers, some))))
            for some in (compress(columns, are_read), columns)
        )
        unclear = [mark.decode() for mark in read if len(mark) > 1]
        for marks in (read, every) if unclear or (not read and self.separator == b";") else (read,):
            if marks[b","] != marks[b"."]:
                return marks[b","] > marks[b"."]
        if number := next((number for number in unclear if "," in number), ""):
            either = f"{number.replace(',', '.')} or {number.replace(',', '')}"
            raise BadTable(f"{quoted(number)} may be {either}: write decimal points, and no marks of thousands")
        return False

    def _check_separator(self, names: Sequence[str], line: str) -> None:
        """Refuse a header that only another separator makes a header of, and the line that tells a spreadsheet its separator."""
        if line.casefold().startswith("sep="):
            raise BadTable(
                f"header: {quoted(line.strip())} is for a spreadsheet; delete this line, and write --delimiter semicolon if the columns have semicolons between them"
            )
        is_bare = len(names) == 1 and '"' not in line
        for mark, kind, advice in _MISTAKEN:
            others = line.replace('"', "").split(None if mark == " " else mark)
            is_other = mark != self.separator.decode() and len(others) > 1 and (is_bare or any(map(is_input, others)))
            if mark == " ":  # which a single header may have
                is_other = is_bare and sum(map(is_input, others)) > 1
            if is_other and not any(map(is_input, names)):
                raise BadTable(f"header: {quoted(line.strip())} has {kind} between its columns; write {advice}")

    def converter(self, head: Head, table: Table, *, strict: bool, excel_safe: bool) -> Delimited:
        """Return the converter of the blocks after the head."""
        return Delimited(self, head, table, strict=strict, excel_safe=excel_safe)


class Blanks(Dialect):
    """The rules of a table whose columns are divided by any number of blanks: it is read, and written, with a tab in place of them."""

    comment = b"#"

    def prepared(self, text: bytes) -> bytes:
        """Return lines with tabs. Raises BadTable for quotes, whose blanks would divide a cell."""
        if b'"' in text:
            raise BadTable("a table with blanks between its columns has no quotes; write tabs, and --format tsv")
        text = re.sub(rb"(?m)^[ \t]+|[ \t]+(?=\r?$)", b"", text)
        return re.sub(rb"[ \t]+", b"\t", text)


DIALECTS = {"csv": Dialect("csv", b","), "tsv": Dialect("tsv", b"\t")}
DELIMITED = {
    "comma": DIALECTS["csv"],
    "semicolon": Dialect("csv", b";"),
    "bar": Dialect("csv", b"|"),
    "tab": DIALECTS["tsv"],
    "blank": Blanks("tsv", b"\t"),
}
DELIMITED |= dict(zip(",;|\t ", DELIMITED.values(), strict=True))  # by the mark itself


class Records(NamedTuple):
    """A block taken apart."""

    lines: list[bytes]  # without line ends, but with the blank lines before them
    columns: Mapping[str, list[bytes]]  # the cells, by the name of the input
    odd: Mapping[int, str]  # records that are no rows, and why
    starts: Sequence[int]  # the line in the block at which each begins
    size: int  # lines in the block
    rest: bytes = b""  # blank lines behind the last


class Delimited:
    """Converts blocks of records."""

    def __init__(self, dialect: Dialect, head: Head, table: Table, *, strict: bool, excel_safe: bool) -> None:
        """Lines of the output end as the header does. `strict`: whether the first row that fails is an error."""
        self.dialect, self.table, self.strict, self.excel_safe = dialect, table, strict, excel_safe
        self.width = len(head.names)
        self.line_end = b"\r\n" if head.text.endswith(b"\r\n") else b"\n"
        cells = [head.text.removeprefix(BOM).rstrip(b"\r\n"), *map(str.encode, table.added)]
        line = dialect.separator.join(cells) + self.line_end
        bom = BOM if head.text.startswith(BOM) else b""
        self.header_line = bom + (dialect.safe(line) if excel_safe else line)
        self.said = b"".join(dialect.separator + text.encode() for text in table.said.values())
        self.places = table.places
        self.has_commas = head.has_decimal_commas
        self.has_doubts = len(table.remarks) > 1
        self._doubts = Kept(self._doubts_of)  # by their bits: many rows have the same
        self._ends_without_status = Kept(self._end_without_status)

    def convert(self, text: bytes) -> Converted:
        """Return whole records with the results behind each."""
        text = self.dialect.prepared(text)
        lines, cells, odd, starts, size, rest = self._quickly(text) or self._carefully(text)
        if self.has_commas:
            names = [name for name in cells if name not in MATERIALS]
            odd = {**dict(_with_decimal_points(cells[name] for name in names)), **odd}
            cells = {**cells, **dict(zip(names, with_points([cells[name] for name in names]), strict=True))}
        block = self.table.block(len(lines), cells, odd)
        columns, tally = computed(self.table.wanted, block, starts, strict=self.strict)
        if self.said:
            lines = [line + self.said for line in lines]
        output = b"".join([*self._strips(lines, columns), rest])
        return Converted(self.dialect.safe(output) if self.excel_safe else output, size, tally)

    def _quickly(self, text: bytes) -> Records | None:
        """Take apart lines that need no quotes and have the right width; None if there are others."""
        width, separator = self.width, self.dialect.separator
        if b"\r" in text:  # to search for two bytes takes 100 times as long
            text = text.replace(b"\r\n", b"\n")
        bare = self.dialect.bare(text)
        if b'"' in bare or b"\r" in bare or not bare.endswith(b"\n"):
            return None
        lines = text.split(b"\n")
        lines.pop()
        cells = bare.replace(b"\n", separator + b"\n" + separator).split(separator)
        # Behind each line's last cell, and there only, stands a line feed.
        if cells[width :: width + 1] != [b"\n"] * len(lines) or (width == 1 and not all(map(bytes.strip, lines))):
            return None
        columns = {name: cells[place : -1 : width + 1] for name, place in self.places.items()}
        return Records(lines, columns, {}, range(len(lines)), len(lines))

    def _carefully(self, text: bytes) -> Records:
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
        return Records(lines, columns, odd, starts, place + rest.count(b"\n"), rest)

    def _squared(self, line: bytes, cells: Sequence[bytes]) -> bytes:
        """Return a line with as many cells as the header: what is too much stays in the last, and a line without cells in the first."""
        separator, width = self.dialect.separator, self.width
        if not cells:
            return self.dialect.quoted(line) + separator * (width - 1)
        if len(cells) > width:
            end = sum(len(cell) + 1 for cell in cells[: width - 1])
            return line[:end] + self.dialect.quoted(line[end:])
        return line + separator * (width - len(cells))

    def _strips(self, lines: Sequence[bytes], columns: Columns) -> Iterator[bytes]:
        """Iterate over some lines at a time, with what stands behind each: its numbers and its end."""
        ends = self._ends(columns)
        for start in range(0, len(lines), STRIP):
            part = slice(start, start + STRIP)
            rows = numbers_in_lines(columns.numbers[:, part], self.dialect.separator, b"")
            if self.has_commas:
                rows = [row.replace(b".", b",") for row in rows]
            pieces = [b""] * (3 * len(rows))
            pieces[0::3], pieces[1::3], pieces[2::3] = lines[part], rows, ends[part]
            yield b"".join(pieces)

    def _ends(self, columns: Columns) -> list[bytes]:
        """Return the doubts and the status of each row with the end of the line."""
        bits = columns.doubts.tolist()
        ends = [*map(self._ends_without_status.__getitem__, bits)]
        for row in columns.reasons:
            status = self.dialect.quoted(columns.status(row).encode())
            ends[row] = self._doubts[bits[row]] + status + self.line_end
        return ends

    def _doubts_of(self, bits: int) -> bytes:
        separator = self.dialect.separator
        return separator + codes(bits).encode() + separator if self.has_doubts else separator

    def _end_without_status(self, bits: int) -> bytes:
        doubts: bytes = self._doubts[bits]
        return doubts + self.line_end


def _marked_numbers(cells: Sequence[bytes]) -> list[bytes]:
    """Return the numbers with a point or a comma of a column of which most cells are numbers."""
    numbers = [*filter(_NUMERIC.match, cells)]
    is_of_numbers = 2 * len(numbers) > sum(1 for cell in cells if cell.strip())
    return [number for cell in numbers for number in _MARKED.findall(cell)] if is_of_numbers else []


def _decimal_mark(number: bytes) -> bytes:
    """Return the decimal mark of a number: itself where its mark may be of thousands, and none of a list.

    >>> [*map(_decimal_mark, (b"0,125", b"1,200e3", b"1.234,5", b"1,234,567", b"1,200", b"1,2,3"))]
    [b',', b',', b',', b'.', b'1,200', b'']
    """
    mantissa, has_exponent, _ = number.lower().partition(b"e")
    mark = mantissa.rstrip(b"0123456789")[-1:]
    whole, _, fraction = mantissa.rpartition(mark)
    if has_exponent or not _OF_THOUSANDS.fullmatch(whole):
        return mark if whole.isdigit() or not whole else b""
    is_repeated = mark in whole
    if len(fraction) != 3:
        return b"" if is_repeated else mark
    if whole.isdigit():
        return number
    return _OTHER_MARK[mark] if is_repeated else mark


def _with_decimal_points(columns: Iterable[Sequence[bytes]]) -> Iterator[tuple[int, str]]:
    """Iterate over the rows in which a number has a point, decimal or of thousands, and what is wrong with that."""
    for column in columns:
        for row, cell in enumerate(column if b"." in b"".join(column) else ()):
            if _DECIMAL_POINT.search(cell):
                text = quoted(cell.decode("utf-8", "replace"))
                yield (
                    row,
                    f"{text} has a point, and this table has decimal commas: write numbers without marks of thousands",
                )


def with_points(rows: Iterable[Sequence[bytes]]) -> list[list[bytes]]:
    """Return cells with decimal points in place of commas."""
    return [[cell.replace(b",", b".") for cell in row] for row in rows]


def unquoted(cells: list[bytes]) -> list[bytes]:
    """Return cells without the quotes around them."""
    if b'"' not in b"".join(cells):
        return cells
    return [cell[1:-1].replace(b'""', b'"') if cell.startswith(b'"') else cell for cell in cells]
