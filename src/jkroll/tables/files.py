"""Files of tables: their formats and compressions, and their content as blocks of whole records.

`--format`, `--delimiter`, the extension or the first lines of a file give its format. The blocks of a file end at the
same positions in every run.

The records of CSV, TSV and NDJSON are made of lines. Cells that pass through keep their bytes, unless `--excel-safe`,
Markdown or a bad row requires a change; blank lines are left out. A block without quotes, whose lines all have the
width of the header, is split at its separators. In other blocks of CSV and TSV, and in all for `--excel-safe` or
Markdown, the csv module reads the cells and finds the lines of each record. An unclosed quote, or a wrong number of
cells, affects only its own line.
"""

from __future__ import annotations

import csv
import gzip
import io
import os
import re
import stat
import sys
import zlib
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from contextlib import suppress
from functools import partial
from itertools import chain, compress, islice
from operator import not_
from types import MappingProxyType
from typing import Any, BinaryIO, NamedTuple

from ..errors import BadRequest, BadTable, JkrollError, missing_extra
from ..model.rows import BLOCK
from ..text import ending, quoted, say
from ..write.writers import Lines, Markdown, in_quotes, in_row
from .decimals import decimal_mark, have_decimal_commas, with_decimal_points, without_unclear
from .header import is_input, typed
from .layouts import (
    BYTES,
    FIRST,
    SAMPLE,
    Row,
    bare,
    header_position,
    in_cells,
    is_comment,
    is_dump,
    is_remark,
    remedy_of_size,
    text_of,
    unnamed_column,
    with_units,
)
from .table import Records, Table

# The extensions of files to which no table is written, such as workbooks and pictures.
NOT_WRITTEN = "xlsx xls ods json svg pdf png jpg jpeg gif tif tiff eps ps svgz bmp webp".split()
FORMATS = {"csv": "csv", "tsv": "tsv", "tab": "tsv", "ndjson": "ndjson", "jsonl": "ndjson", "parquet": "parquet"}
WRITTEN = {**FORMATS, "md": "md"}
SEPARATORS = {"csv": ",", "tsv": "\t"}  # the defaults of --delimiter
COMPRESSIONS = {"gz": "gzip", "gzip": "gzip", "zst": "zstd", "zstd": "zstd"}  # by extension
CHUNK = 1 << 21  # bytes read at a time; a process keeps up to two chunks between blocks
FEED = 1 << 9  # compressed bytes fed to a decompressor at a time: they become at most 0.6 MiB (gzip) or 16 MiB (zstd)
BOM = b"\xef\xbb\xbf"
MAX_RECORD = 1 << 24  # bytes
DELIMITERS = {"comma": ",", "semicolon": ";", "bar": "|", "tab": "\t", "blank": " "}  # by the value of --delimiter
_BLANKS = " \t\r\n"  # ASCII only: `str.strip` would also remove bytes of Å and à
ROW_OF_UNITS, ROW_OF_COMMENTS = "row of units", "row of comments"  # phrases of the status column
_OPEN = "a quote is not closed"
_MISQUOTED = "a quote is not closed, or text follows it"
_CARRIAGE_RETURN = "there is a carriage return outside quotes; lines end in line feeds"
# A spreadsheet may take a cell for a formula if the cell begins with one of these signs, which may have full width, or
# with a character that the spreadsheet drops.
_BEGIN_FORMULAS = (*"=+-@\t\r\n\0", *(letter.encode().decode(BYTES) for letter in "＝＋－＠"))
_NUMBER = re.compile(r"[+-]?(\d+[.,]?\d*|[.,]\d+)([eE][+-]?\d+)?")

# --- Formats ----------------------------------------------------------------------------------------------------------


class FileFormat(NamedTuple):
    """A format, with its compression and, for CSV and TSV, its separator."""

    name: str
    compression: str = ""
    separator: str = ""


def format_of_name(path: str, formats: Mapping[str, str] = FORMATS) -> FileFormat | None:
    """Return the format of a file name such as grains.csv.gz; None for an unknown extension.

    `formats`: the formats by extension; by default those that can be read. Raises BadTable for x.parquet.gz.

    >>> format_of_name("grains.csv.gz"), format_of_name("a/grains")
    (FileFormat(name='csv', compression='gzip', separator=','), None)
    """
    name, _, end = os.path.basename(path).casefold().rpartition(".")
    compression = COMPRESSIONS.get(end, "")
    known = formats.get(name.rpartition(".")[2] if compression else end, "")
    if known == "parquet" and compression:
        raise BadTable(f"{quoted(path)}: Parquet is compressed in itself; leave out .{end}")
    return FileFormat(known, compression, SEPARATORS.get(known, "")) if known else None


def input_format(path: str, target: str, stated: str = "", delimiter: str = "") -> FileFormat:
    """Return the format of the input from `--format` or `--delimiter`, or else from the file's name.

    The first lines reveal a dump of LAMMPS, or the separator of a text file such as grains.txt. A pipe has the format
    of the output's name, or else is CSV.

    `stated`, `delimiter`: the values of the two options, at most one of which is given. Raises BadTable.
    """
    named, of_txt = format_of_name(stated.lstrip(".") or path), format_of_name(path, {"txt": "csv"})
    if stated and named is None:
        raise BadTable(f"--format: {quoted(stated)} is not csv, tsv or ndjson, with .gz or .zst or without, or parquet")
    if path == "-" and not stated:  # a table from a pipe is not compressed, even if the output is
        named = (format_of_name(target) or FileFormat("csv", separator=","))._replace(compression="")
    if delimiter:
        mark = DELIMITERS.get(delimiter, delimiter)
        if mark not in DELIMITERS.values():
            raise BadTable(f"--delimiter: {quoted(delimiter)} is not one of: {', '.join(DELIMITERS)}")
        known = named or of_txt
        return _divided(mark, known.compression if known else "")
    if named is not None:
        return named
    if os.path.isdir(path):
        raise BadTable(f"{quoted(path)} is a directory; name its tables, as in {quoted(os.path.join(path, '*.csv'))}")
    if os.path.isfile(path):
        compression = COMPRESSIONS.get(ending(path), "")
        begin = _beginning(path, compression)
        if is_dump(begin):
            return FileFormat("tsv", compression, " ")
        if of_txt is not None:
            return _with_separator(of_txt, _separators_of(as_lines(begin)), path)
    if of_txt is not None:
        return of_txt
    remedy = "save it as CSV, or give --format csv, tsv, ndjson or parquet, or --delimiter blank"
    raise BadTable(f"{quoted(path)}: its name has no known extension; {remedy}")


def _beginning(path: str, compression: str) -> bytes:
    """Return the first whole lines of a file, without a byte order mark; an empty text if the file cannot be read."""
    with suppress(BadTable):
        source = Input(path)
        with source.file:
            text = _filled(b"", source.pieces(compression), CHUNK // 64)
        return text[: text.rfind(b"\n") + 1].removeprefix(BOM)
    return b""


def _separators_of(lines: Sequence[str]) -> list[str]:
    """Return the names of the separators that divide the first two lines into the same number of cells, at least two.

    Comments and blank lines do not count. Blanks are a separator only if no other mark is.
    """
    rows = [line.replace("\r", "").strip(" \n") for line in lines if line.strip() and not is_comment(line)][:2]
    found: list[str] = []
    for word, mark in DELIMITERS.items():
        sizes = {len(row) for row in csv.reader(rows, delimiter=mark, skipinitialspace=True)}
        if len(sizes) == 1 and sizes.pop() > 1 and not (found and mark == " "):
            found.append(word)
    return found


def _with_separator(form: FileFormat, words: Sequence[str], path: str) -> FileFormat:
    """Return a format with its separator, from the names of the possible ones. Raises BadTable if there are several."""
    if len(words) > 1:
        divided = " or by ".join(f"{word}s" for word in words)
        raise BadTable(f"{quoted(path)} may be divided by {divided}; write --delimiter {' or '.join(words)}")
    return _divided(DELIMITERS[words[0]] if words else form.separator, form.compression)


def _divided(mark: str, compression: str) -> FileFormat:
    """Return the format of a table whose cells this mark divides."""
    return FileFormat("tsv" if mark in "\t " else "csv", compression, mark)


def output_format(target: str, usual: str, *, quiet: bool) -> FileFormat:
    """Return the format of the output from the file's name, or else the `usual` format, uncompressed.

    Prints a note about an unknown extension, unless `quiet`. Raises BadRequest for an extension in NOT_WRITTEN.
    """
    form = format_of_name(target, WRITTEN | ({"txt": usual} if usual in SEPARATORS else {}))
    if form is not None:
        return form
    name, end = os.path.splitext(target)
    if ending(target) in NOT_WRITTEN:
        raise BadRequest(f"-o: a table is not written as {ending(target)}; name the file {quoted(f'{name}.{usual}')}")
    if end and not quiet:
        say(f"note: {quoted(target)} is written as {usual}: its name has no known extension", sys.stderr)
    return FileFormat(usual)


# --- Compression ------------------------------------------------------------------------------------------------------


def compressed(block: Any, compression: str) -> Any:
    """Return a block compressed by itself, or unchanged without a compression.

    Compressed blocks, one after another, are a valid compressed file.
    """
    if not compression or not block:
        return block
    if compression == "gzip":
        return gzip.compress(block, 1, mtime=0)
    with missing_extra("zstd"):
        from zstandard import ZstdCompressor
    return ZstdCompressor(level=3).compress(block)


def decompressed(file: BinaryIO, compression: str, path: str) -> Iterator[bytes]:
    """Iterate over the decompressed bytes of a file. Raises BadTable for a damaged file."""
    problem = BadTable(f"{quoted(path)} is not compressed as its name says, or its end is missing")
    new_frame: Callable[[], Any] = partial(zlib.decompressobj, zlib.MAX_WBITS | 16)
    damaged: type[Exception] = zlib.error
    if compression == "zstd":
        with missing_extra("zstd"):
            from zstandard import ZstdDecompressor, ZstdError
        new_frame, damaged = ZstdDecompressor().decompressobj, ZstdError
    frame = new_frame()
    try:
        for piece in iter(partial(file.read, FEED), b""):
            rest = piece.lstrip(b"\0") if frame.eof else piece  # a file may end in zeros
            while rest:
                if frame.eof:
                    frame = new_frame()
                text = frame.decompress(rest)
                if text:  # an empty piece would mean the end of the input
                    yield text
                rest = frame.unused_data.lstrip(b"\0")
    except damaged:
        raise problem from None
    if not frame.eof:
        raise problem


# --- The input --------------------------------------------------------------------------------------------------------


class Input:
    """An open file or pipe to read."""

    def __init__(self, path: str) -> None:
        """Open a file; `-` is stdin. Raises BadTable."""
        self.path = path
        self.rows = 0  # set if the format states the number of rows
        try:
            self.file = io.BufferedReader(io.FileIO(0 if path == "-" else path, closefd=path != "-"), CHUNK)
        except OSError as error:
            raise BadTable(f"{quoted(path)}: {error.strerror}") from None
        self.begun = os.fstat(self.file.fileno())
        self.is_file = stat.S_ISREG(self.begun.st_mode)

    def pieces(self, compression: str) -> Iterator[bytes]:
        """Iterate over the decompressed bytes in pieces; a pipe gives what is available."""
        raw = iter(partial(self.file.read1, CHUNK), b"")
        try:
            yield from decompressed(self.file, compression, self.path) if compression else raw
        except OSError as error:
            raise BadTable(f"{quoted(self.path)}: {error.strerror}") from None

    def share_read(self, rows: int) -> float:
        """Return the fraction of the input that has been read; 0 for a pipe. `rows`: the rows read so far."""
        if self.rows:
            return rows / self.rows
        return self.file.tell() / max(self.begun.st_size, 1) if self.is_file else 0.0

    def check_output(self, target: str) -> None:
        """Raise BadRequest if the output would overwrite the input."""
        with suppress(OSError):
            if self.is_file and os.path.samestat(self.begun, os.stat(target)):
                raise BadRequest(f"-o: {quoted(target)} is the input; it is not overwritten")


def blocks(pieces: Iterator[bytes], cut: Callable[[bytes], int]) -> Iterator[bytes]:
    """Iterate over blocks of whole records: about BLOCK records in at most CHUNK bytes, unless a record is longer.

    `cut`: a function that returns the number of bytes of whole records at the beginning of a text.

    If a record does not end in the input, or within MAX_RECORD bytes, its first lines become a block in which the
    format finds the error. Raises BadTable for a line of more than MAX_RECORD bytes.
    """
    text = _filled(b"", pieces, CHUNK // 4)
    usual = size = max(1, min(CHUNK, BLOCK * len(text) // max(1, text.count(b"\n"))))
    while text := _filled(text, pieces, size):
        end = cut(text[:size])
        if not end and size <= len(text) and size < MAX_RECORD:
            size *= 2
            continue
        if not end:  # the lines in the first CHUNK bytes, or the first line if it is longer
            end = max(text.rfind(b"\n", 0, CHUNK), text.find(b"\n")) + 1
        if not end:
            raise BadTable(f"a line is longer than {MAX_RECORD >> 20} MiB: this is not a table")
        yield text[:end]
        text, size = text[end:], usual


def _filled(text: bytes, pieces: Iterator[bytes], size: int) -> bytes:
    """Return a text extended by pieces to at least `size` bytes, or by all pieces with a line feed at the end."""
    while len(text) < size:
        piece = next(pieces, b"")
        if not piece:
            has_open_line = text and not text.endswith(b"\n")
            return text + b"\n" if has_open_line else text
        text += piece
    return text


# --- Lines of cells ---------------------------------------------------------------------------------------------------

csv.field_size_limit(MAX_RECORD)  # the default is 128 KiB

Record = tuple[int, int, list[str], str]  # the first line of a record, the line after its last, its cells, its error


class Delimited:
    """A table whose cells are divided by separators."""

    def __init__(self, separator: str, *, excel_safe: bool = False, as_markdown: bool = False) -> None:
        """`separator`: the mark between cells. If it is a blank, the blocks must come from `with_tabs`.

        `excel_safe`: True to write text so that a spreadsheet does not take it for a formula.
        `as_markdown`: True to write Markdown.
        """
        self.word = next(word for word, mark in DELIMITERS.items() if mark == separator)
        self.separator, self.excel_safe = separator.replace(" ", "\t"), excel_safe
        self.as_markdown = as_markdown
        self.blanks = _BLANKS.replace(self.separator, "")  # a line of blanks is not a record

    def cut(self, text: bytes) -> int:
        """Return the number of bytes of whole records at the beginning of a text."""
        end = text.rfind(b"\n") + 1
        if b'"' not in text or self.word == "blank":  # between blanks, a cell in quotes ends in its line
            return end
        lines = as_lines(text[:end])
        last = len(lines)
        for start, *_, problem in self.records(lines):
            if problem == _OPEN:
                last = start
                break
        return sum(map(len, lines[:last]))

    def records(self, lines: Sequence[str]) -> Iterator[Record]:
        """Iterate over the records in lines. Cells have a character for each byte; a line with an error has none."""
        start = 0
        while start < len(lines):
            reader, begin = csv.reader(lines[start:], delimiter=self.separator, strict=True), start
            try:
                for cells in reader:
                    stop = begin + reader.line_num
                    yield start, stop, cells, ""
                    start = stop
            except csv.Error as error:
                yield start, start + 1, [], _problem(str(error))
                start += 1

    def _line(self, cells: Iterable[str]) -> str:
        """Return cells as a line, with quotes where they are needed."""
        return self.separator.join(in_quotes(cell, self.separator) for cell in cells)

    def _written(self, cells: Sequence[str], line: str) -> bytes:
        """Return a line as the output has it, without its end. `cells`: the cells of the line."""
        if self.excel_safe and any(map(_is_formula, cells)):
            cells = [f"'{cell}" if _is_formula(cell) else cell for cell in cells]
            line = self._line(cells)
        text = in_row(cells) if self.as_markdown else line.rstrip("\r\n")
        return text.encode(BYTES)

    # --- The header ---------------------------------------------------------------------------------------------------

    def read_header(self, block: bytes, stated: Mapping[str, str] = MappingProxyType({}), measured: str = "") -> int:
        """Read the header in the first block; return the number of bytes above the rows. Raises BadTable.

        `stated`, `measured`: see `meaning_of`.
        """

        def is_read(text: str) -> bool:
            return is_input(stated.get(typed(text), text), measured)

        lines = as_lines(block)
        above = header_position(lines, self.separator, is_read)
        below = lines[above:] or [""]
        is_marked, below[0] = is_comment(below[0]), bare(below[0])
        _, stop, cells, problem = next(self.records(below))
        line = "".join(below[:stop])
        self.names, self.lines = self._names(cells, line, problem, is_read), above + stop
        self.remarks = [f"lines skipped before the header: {above}"] if above else []
        rows = self._rows(below[stop:])
        first = [*islice(rows, SAMPLE)]
        if not any(len(row.cells) == len(self.names) for row in first):
            column = unnamed_column(self.names, first, self.word, is_read)
            cells, line = self._with_unnamed(column, cells, line)
        self.header = self._written(cells, line)
        below_header = [*first]
        if is_marked and first:  # a row of units may have a #, as the header has
            below_header[0] = first[0].without_mark()
        count = self._take_units(below_header, stated, measured)
        whole = filter(lambda row: len(row.cells) == len(self.names), chain(first[count:], rows))
        self.sample = [[*map(text_of, row.cells)] for row in islice(whole, SAMPLE)]
        self._take_decimal_mark([*map(is_read, self.names)])
        self.writer = self._writer("\r\n" if line.endswith("\r\n") else "\n")
        return sum(map(len, lines[: self.lines]))

    def _writer(self, end: str) -> Lines:
        """Return the writer of lines with this line end, or of Markdown with columns of numbers aligned right."""
        if not self.as_markdown:
            return Lines(self.separator, end=end, has_commas=self.has_decimal_commas)
        are_right = []
        for position in range(len(self.names)):
            cells = [*filter(None, (row[position].strip() for row in self.sample))]
            are_right.append(bool(cells) and all(map(_NUMBER.fullmatch, cells)))
        return Markdown(are_right, has_commas=self.has_decimal_commas)

    def _rows(self, lines: Sequence[str]) -> Iterator[Row]:
        """Iterate over the rows below the header, without blank lines and lines with an error."""
        above = self.lines
        for start, stop, cells, problem in self.records(lines):
            line = "".join(lines[start:stop])
            if not problem and line.strip(self.blanks):
                yield Row(cells, line, above + start + 1)

    def _with_unnamed(self, column: str, cells: list[str], line: str) -> tuple[list[str], str]:
        """Return the cells and the line of the header, with an empty name for a column that has no name.

        `column`: see `unnamed_column`.
        """
        if not column:
            return cells, line
        if column == FIRST:
            cells = ["", *cells]
            line = f'""{self.separator}{line}'
        else:
            text = line.rstrip("\r\n")
            cells = [*cells, ""]
            line = f"{text}{self.separator}{line[len(text) :]}"
        self.names = tuple(map(text_of, cells))
        self.remarks.append(column)
        return cells, line

    def _take_units(self, rows: Sequence[Row], stated: Mapping[str, str], measured: str) -> int:
        """Move a row of units, and the rows of comments around it, into the header; return the number of these rows."""
        first = 0
        while first < len(rows) and is_remark(rows[first], self.names):
            first += 1
        if first == len(rows):
            first = 0
        headers = with_units(self.names, rows[first], stated, measured) if rows else None
        self.stated = headers.stated if headers else stated
        self.above: list[tuple[bytes, str]] = []  # lines between the header and the rows, with their status
        if headers is None:
            return 0
        self.names = headers.names
        end = first + 1
        while end < len(rows) and is_remark(rows[end], self.names):
            end += 1
        for row in rows[:end]:
            status = ROW_OF_UNITS if row is rows[first] else ROW_OF_COMMENTS
            self.above.append((self._written(row.cells, row.line), status))
        self.remarks.append(f"units: line {rows[first].number}")
        self.lines = rows[end - 1].last
        return end

    def _take_decimal_mark(self, are_read: Sequence[bool]) -> None:
        """Find the decimal mark of the sample, and replace decimal commas in it by points. Raises BadTable."""
        columns = [*zip(*self.sample, strict=True)]
        passed = compress(columns, map(not_, are_read))
        is_doubtful = self.separator == ";" or (self.separator != "," and any(map(have_decimal_commas, passed)))
        mark = decimal_mark(compress(columns, are_read), self.separator, points_may_group=is_doubtful)
        self.has_decimal_commas = mark == ","
        self.has_unclear_points = not mark and is_doubtful
        if self.has_decimal_commas:
            if self.separator == ",":
                raise BadTable("decimal commas between commas: write decimal points, or semicolons between columns")
            self.sample = [[cell.replace(",", ".") for cell in row] for row in self.sample]

    def head(self, added: Sequence[str]) -> bytes:
        """Return the lines above the rows: the header with the added columns, and any rows of units and comments."""
        lines = [self.writer.header(added, [self.header])]
        for line, status in self.above:
            lines.append(self.writer.rows(added, [*[None] * (len(added) - 1), status], [line]))
        return b"".join(lines)

    def _names(self, cells: Sequence[str], line: str, problem: str, is_read: Callable[[str], bool]) -> tuple[str, ...]:
        """Return the names of the columns. `cells`, `line`, `problem`: from the first record. Raises BadTable."""
        if not line.strip(self.blanks):
            raise BadTable("the table has no header; begin with a line of the columns' names")
        text = text_of(line.strip(_BLANKS))
        names = [text_of(cell) for cell in cells] if cells else [text_of(line)]
        if "\0" in text or "\ufffd" in text:  # the latter replaces bytes that are not UTF-8
            raise BadTable(_problem_of_encoding(line.encode(BYTES)))
        if not any(map(is_read, names)):
            self._check_separator(text, len(names), is_read)
        if problem:
            raise BadTable(f"header: {problem}")
        return tuple(names)

    def _check_separator(self, line: str, count: int, is_read: Callable[[str], bool]) -> None:
        """Raise BadTable if the header has an input between other separators.

        Blanks are tried only on a header of a single cell, and must give at least two inputs.
        """
        for word, mark in DELIMITERS.items():
            is_blank = mark == " "
            cells = line.replace('"', "").split(None if is_blank else mark)
            has_inputs = sum(map(is_read, cells)) >= (2 if is_blank else 1)
            if mark != self.separator and (count == 1 or not is_blank) and has_inputs:
                raise BadTable(f"header: {quoted(line)} has {word}s between its columns; write --delimiter {word}")

    # --- Rows ---------------------------------------------------------------------------------------------------------

    def read(self, text: bytes, table: Table) -> Records:
        """Return the records of a block."""
        records = self._split(text, table.positions) or self._parsed(text, table.positions)
        if self.has_decimal_commas:
            return with_decimal_points(records)
        return without_unclear(records) if self.has_unclear_points and b"." in text else records

    def _split(self, text: bytes, positions: Mapping[str, int]) -> Records | None:
        """Return the records of lines without quotes that all have the width of the header.

        Return None for other lines, and in all cases for `--excel-safe` or Markdown.
        """
        width, separator = len(self.names), self.separator.encode()
        if b'"' in text or self.excel_safe or self.as_markdown:
            return None
        if b"\r" in text:  # searching for two bytes takes 100 times as long as for one
            text = text.replace(b"\r\n", b"\n")
        if b"\r" in text or not text.endswith(b"\n"):
            return None
        lines = text.split(b"\n")
        lines.pop()
        cells = text.replace(b"\n", separator + b"\n" + separator).split(separator)
        # Each line feed is now a cell by itself, which must follow the last cell of a line.
        if cells[width :: width + 1] != [b"\n"] * len(lines) or (width == 1 and not all(map(bytes.strip, lines))):
            return None
        columns = {name: cells[position : -1 : width + 1] for name, position in positions.items()}
        return Records(lines, columns, {}, range(len(lines)), len(lines))

    def _parsed(self, text: bytes, positions: Mapping[str, int]) -> Records:
        """Return the records of any lines."""
        width = len(self.names)
        before: list[bytes] = []
        rows: list[list[str]] = []
        odd: dict[int, JkrollError] = {}
        starts: list[int] = []
        lines = as_lines(text)
        for start, stop, row, problem in self.records(lines):
            line, cells = "".join(lines[start:stop]).rstrip("\r\n"), row
            if not line.strip(self.blanks):
                continue
            if len(row) != width:
                odd[len(rows)] = BadRequest(problem) if problem else self._size_error(len(row), line)
                padded = (row or [line]) + [""] * (width - max(len(row), 1))
                rest = self.separator.join(padded[width - 1 :])  # including excess cells
                cells = [*padded[: width - 1], rest]
                line = self._line(cells)
            starts.append(start)
            before.append(self._written(cells, line))
            rows.append(cells)
        columns = {name: [row[position].encode(BYTES) for row in rows] for name, position in positions.items()}
        return Records(before, columns, odd, starts, len(lines))

    def _size_error(self, size: int, line: str) -> BadRequest:
        """Return the error for a line with fewer or more cells than the header."""
        width = len(self.names)
        text = quoted(text_of(line).replace("\t", " ").strip())
        remedy = remedy_of_size(size, width, self.word)
        phrase = f"row is {'short' if size < width else 'long'}: {in_cells(size)} for {width}"
        return BadRequest(f"{text} has {in_cells(size)}, and the header {width}: {remedy}", phrase)


def as_lines(text: bytes) -> list[str]:
    """Return the lines of a text with their line ends, and a character for each byte."""
    return io.StringIO(text.decode(BYTES), newline="\n").readlines()


def _problem_of_encoding(text: bytes) -> str:
    """Return the problem of a table whose first line is not UTF-8, with its remedy."""
    if text.startswith((b"\x1f\x8b", b"\x28\xb5\x2f\xfd")):  # gzip, Zstandard
        return "the table is compressed: give it a name such as x.csv.gz, or write --format csv.gz"
    encoding = "latin1"
    if text.startswith((b"\xff\xfe", b"\xfe\xff")):
        encoding = "utf-16"
    elif b"\0" in text:
        encoding = "utf-16be" if text.startswith(b"\0") else "utf-16le"
    return f"the table is not UTF-8; save it as UTF-8, as with iconv -f {encoding} -t utf-8 in.csv > out.csv"


def _problem(error: str) -> str:
    """Return the problem that an error of the csv module reports, in the words of this module."""
    if error.startswith(("unexpected end", "field larger")):
        return _OPEN
    return _CARRIAGE_RETURN if error.startswith("new-line") else _MISQUOTED


def _is_formula(cell: str) -> bool:
    """Return whether a spreadsheet might take a cell of text for a formula."""
    return cell.lstrip(" ").startswith(_BEGIN_FORMULAS) and not _NUMBER.fullmatch(cell.strip(" "))
