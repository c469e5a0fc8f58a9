"""Files of tables: their formats and compressions, and the input as blocks of whole records.

A format is named by the end of a file's name, or by `--format`. Blocks are cut at the same places in every run.
"""

import gzip
import os
import stat
import sys
import zlib
from collections.abc import Callable, Iterator
from contextlib import suppress
from functools import partial
from io import BufferedReader, FileIO
from itertools import chain
from typing import Any, BinaryIO, NamedTuple

from ..errors import BadRequest, BadTable, missing_extra
from ..rows.columns import BLOCK
from ..text import ending, quoted, say
from .lines import DELIMITERS, MAX_RECORD, Delimited, Ndjson, tabbed

NOT_WRITTEN = "xlsx xls ods json svg pdf png jpg jpeg gif tif tiff eps ps svgz bmp webp".split()  # ends of names
KINDS = {"csv": "csv", "tsv": "tsv", "tab": "tsv", "ndjson": "ndjson", "jsonl": "ndjson", "parquet": "parquet"}
SEPARATORS = {"csv": ",", "tsv": "\t"}  # unless --delimiter says others
COMPRESSIONS = {"gz": "gzip", "gzip": "gzip", "zst": "zstd", "zstd": "zstd"}
CHUNK = 1 << 20  # bytes read at a time
FEED = 1 << 9  # bytes decompressed at a time: gzip makes 512 KiB of them at most, zstd 16 MiB
BOM = b"\xef\xbb\xbf"

# --- Formats ----------------------------------------------------------------------------------------------------------


class FileFormat(NamedTuple):
    """A format with its separator, if it has one, and its compression."""

    kind: str
    compression: str = ""
    separator: str = ""


def format_of_name(path: str) -> FileFormat | None:
    """Return the format that a name such as grains.csv.gz states, or None. Raises BadTable for x.parquet.gz.

    >>> format_of_name("grains.csv.gz"), format_of_name("a/grains")
    (FileFormat(kind='csv', compression='gzip', separator=','), None)
    """
    name, _, end = os.path.basename(path).casefold().rpartition(".")
    compression = COMPRESSIONS.get(end, "")
    kind = KINDS.get(name.rpartition(".")[2] if compression else end, "")
    if kind == "parquet" and compression:
        raise BadTable(f"{quoted(path)}: Parquet is compressed in itself; leave out .{end}")
    return FileFormat(kind, compression, SEPARATORS.get(kind, "")) if kind else None


def input_format(path: str, target: str, stated: str = "", delimiter: str = "") -> FileFormat:
    """Return the format of the input. `stated`, `delimiter`: by options, of which a call has one. Raises BadTable."""
    named = format_of_name(stated.lstrip(".") or path)
    if stated and named is None:
        kinds = ", ".join(dict.fromkeys(KINDS.values()))
        raise BadTable(f"--format: {quoted(stated)} is none of {kinds}, or, but for the last, these with .gz or .zst")
    if path == "-" and not stated:  # a table in a pipe is not compressed, though its output may be
        named = (format_of_name(target) or FileFormat("csv", separator=","))._replace(compression="")
    if delimiter:
        mark = DELIMITERS.get(delimiter, delimiter)
        if mark not in DELIMITERS.values():
            raise BadTable(f"--delimiter: {quoted(delimiter)} is none of {', '.join(DELIMITERS)}")
        return FileFormat("tsv" if mark in "\t " else "csv", named.compression if named else "", mark)
    if named is not None:
        return named
    if os.path.isdir(path):
        raise BadTable(f"{quoted(path)} is a directory; name its tables, as in {quoted(os.path.join(path, '*.csv'))}")
    remedy = "save it as CSV, or give --format csv, tsv, ndjson or parquet, or --delimiter blank"
    raise BadTable(f"{quoted(path)}: its name says no format that is read; {remedy}")


def output_format(target: str, kind: str, *, quiet: bool) -> FileFormat:
    """Return the format of the output: that of its name, else `kind` without compression, with a note.

    Raises BadRequest for a format that is another program's.
    """
    if (form := format_of_name(target)) is not None:
        return form
    name, end = os.path.splitext(target)
    if ending(target) in NOT_WRITTEN:
        raise BadRequest(f"-o: a table is not written as {ending(target)}; name the file {quoted(f'{name}.{kind}')}")
    if end and not quiet:
        say(f"note: {quoted(target)} is written as {kind}: its name says no format", sys.stderr)
    return FileFormat(kind)


# --- Compression ------------------------------------------------------------------------------------------------------


def compressed(block: Any, compression: str) -> Any:
    """Return a block, compressed by itself: such blocks behind each other are one compressed file."""
    if not compression or not block:
        return block
    if compression == "gzip":
        return gzip.compress(block, 1, mtime=0)
    with missing_extra("zstd"):
        from zstandard import ZstdCompressor
    return ZstdCompressor(level=3).compress(block)


def decompressed(file: BinaryIO, compression: str, path: str) -> Iterator[bytes]:
    """Iterate over the decompressed bytes of a file, some at a time. Raises BadTable for a damaged file."""
    problem = BadTable(f"{quoted(path)} is not what its name says, or its end is missing")
    begin: Callable[[], Any] = partial(zlib.decompressobj, zlib.MAX_WBITS | 16)
    damaged: type[Exception] = zlib.error
    if compression == "zstd":
        with missing_extra("zstd"):
            from zstandard import ZstdDecompressor, ZstdError
        begin, damaged = ZstdDecompressor().decompressobj, ZstdError
    frame = begin()
    try:
        for piece in iter(partial(file.read, FEED), b""):
            rest = piece.lstrip(b"\0") if frame.eof else piece  # zeros may fill the end of a file
            while rest:
                frame = begin() if frame.eof else frame
                if text := frame.decompress(rest):  # an empty one would be the end
                    yield text
                rest = frame.unused_data.lstrip(b"\0")
    except damaged:
        raise problem from None
    if not frame.eof:
        raise problem


# --- The input --------------------------------------------------------------------------------------------------------


class Input:
    """An open file or pipe."""

    def __init__(self, path: str) -> None:
        """Open it; `-` is stdin. Raises BadTable."""
        self.path, self.rows = path, 0  # as many as a format says that there are
        try:
            self.file = BufferedReader(FileIO(0 if path == "-" else path, closefd=path != "-"), CHUNK)
        except OSError as error:
            raise BadTable(f"{quoted(path)}: {error.strerror}") from None
        self.begun = os.fstat(self.file.fileno())
        self.is_file = stat.S_ISREG(self.begun.st_mode)

    def pieces(self, compression: str) -> Iterator[bytes]:
        """Iterate over the bytes to convert, decompressed: CHUNK bytes at a time at most, of a pipe what there is."""
        raw = iter(partial(self.file.read1, CHUNK), b"")
        try:
            yield from decompressed(self.file, compression, self.path) if compression else raw
        except OSError as error:
            raise BadTable(f"{quoted(self.path)}: {error.strerror}") from None

    def share_read(self, rows: int) -> float:
        """Return which part is read when so many rows are converted; 0 if it is unknown, as of a pipe."""
        if self.rows:
            return rows / self.rows
        return self.file.tell() / max(self.begun.st_size, 1) if self.is_file else 0.0

    def check_output(self, target: str) -> None:
        """Refuse to write over the input."""
        with suppress(OSError):
            if self.is_file and os.path.samestat(self.begun, os.stat(target)):
                raise BadRequest(f"-o: {quoted(target)} is the input; it is not overwritten")


def lines_of(
    given: Input, form: FileFormat, is_read: Callable[[str], bool], *, excel_safe: bool
) -> tuple[Delimited | Ndjson, Iterator[bytes]]:
    """Return a table whose records are lines, with its header read, and its blocks of rows. Raises BadTable.

    `is_read`, `excel_safe`: as Delimited has them.
    """
    is_of_blanks = form.separator == " "
    separator = "\t" if is_of_blanks else form.separator
    lines = Ndjson() if form.kind == "ndjson" else Delimited(separator, excel_safe=excel_safe)
    every = blocks(given.pieces(form.compression), lines.cut)
    first = next(every, b"")
    mark = BOM if first.startswith(BOM) else b""
    every = chain([first.removeprefix(mark)], every)
    if is_of_blanks:
        every = map(tabbed, every)
    first = next(every)
    rows = first[lines.begin(first, is_read) :]
    lines.header = mark + lines.header
    return lines, filter(None, chain([rows], every))


def blocks(pieces: Iterator[bytes], cut: Callable[[bytes], int]) -> Iterator[bytes]:
    """Iterate over blocks of whole records: about BLOCK of them, and CHUNK bytes at most unless a record is longer.

    `cut`: returns the number of bytes of whole records at the beginning of a text.

    A record that does not end within MAX_RECORD, or at all, is given up: its first lines are a block, and the format
    says what is wrong with them. Raises BadTable for a line that is longer.
    """
    text = _filled(b"", pieces, CHUNK // 2)
    usual = size = max(1, min(CHUNK, BLOCK * len(text) // max(1, text.count(b"\n"))))
    while text := _filled(text, pieces, size):
        end = cut(text[:size])
        if not end and size <= len(text) and size < MAX_RECORD:
            size *= 2
            continue
        end = end or text.rfind(b"\n", 0, CHUNK) + 1 or text.find(b"\n") + 1
        if not end:
            raise BadTable(f"a line is longer than {MAX_RECORD >> 20} MiB: this is not a table")
        yield text[:end]
        text, size = text[end:], usual


def _filled(text: bytes, pieces: Iterator[bytes], size: int) -> bytes:
    """Return a text that pieces make as long as a size. At their end, the last line gets the end that it lacks."""
    while len(text) < size:
        if not (piece := next(pieces, b"")):
            return text + b"\n" if text and not text.endswith(b"\n") else text
        text += piece
    return text
