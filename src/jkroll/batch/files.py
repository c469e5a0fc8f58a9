"""The file that is read, as blocks of whole records that are cut at the same places in every run, and the file that is written."""

import os
import stat
import sys
from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager, suppress
from io import BufferedReader, FileIO
from typing import BinaryIO

from ..errors import BadRequest, BadTable
from ..output.files import whole_file
from ..rows.columns import BLOCK
from ..text import ending, quoted, say
from .formats import CHUNK, FileFormat, decompressed
from .lines import MAX_RECORD, SAMPLE

SPREADSHEETS = ("xlsx", "xls", "ods")  # are neither read nor written

Cut = Callable[[bytes], int]  # number of bytes of whole records at the beginning of a text


class Input:
    """An open file or pipe."""

    def __init__(self, path: str) -> None:
        """Open it; `-` is stdin. Raises BadTable."""
        self.path = path
        try:
            descriptor = os.dup(0) if path == "-" else os.open(path, os.O_RDONLY | getattr(os, "O_BINARY", 0))
            self.file = BufferedReader(FileIO(descriptor), CHUNK)
        except OSError as error:
            raise BadTable(f"{quoted(path)}: {error.strerror}") from None
        about = os.fstat(descriptor)
        self.is_file = stat.S_ISREG(about.st_mode)
        self.size, self.time = (about.st_size, about.st_mtime_ns) if self.is_file else (0, 0)

    def pieces(self, compression: str) -> Iterator[bytes]:
        """Iterate over the bytes to convert, decompressed: CHUNK bytes at a time at most, of a pipe what there is.

        Raises BadTable at the end if the file was changed in the meantime.
        """
        if compression:
            yield from decompressed(self.file, compression, self.path)
        else:
            yield from iter(self._piece, b"")
        self.check_unchanged()

    def _piece(self) -> bytes:
        try:
            return self.file.read1(CHUNK)
        except OSError as error:
            raise BadTable(f"{quoted(self.path)}: {error.strerror}") from None

    def position(self) -> int:
        """Return the number of bytes read of a file; 0 of a pipe."""
        return self.file.tell() if self.is_file else 0

    def check_unchanged(self) -> None:
        """Raise BadTable if a file was changed after it was opened."""
        about = os.fstat(self.file.fileno())
        if self.is_file and (about.st_size, about.st_mtime_ns) != (self.size, self.time):
            raise BadTable(f"{quoted(self.path)} was changed while it was read; begin anew")

    def check_output(self, target: str) -> None:
        """Refuse to write over the input."""
        with suppress(OSError):
            if self.is_file and os.path.samestat(os.fstat(self.file.fileno()), os.stat(target)):
                raise BadRequest(f"-o: {quoted(target)} is the input; it is not overwritten")

    def close(self) -> None:
        """Close it."""
        self.file.close()


def blocks(pieces: Iterable[bytes], cut: Cut) -> Iterator[bytes]:
    """Iterate over blocks of whole records: about BLOCK of them, and CHUNK bytes at most unless a record is longer.

    The first has the rows that decide how a table is read, in whichever pieces they come. A record that does not end
    within MAX_RECORD, or at all, is given up: its first lines are a block, and the format says what is wrong with them.
    """
    left = iter(pieces)
    text, is_end = b"", False
    while len(text) < CHUNK // 2 and text.count(b"\n") <= SAMPLE and (piece := next(left, b"")):
        text += piece
    usual = size = max(1, min(CHUNK, BLOCK * len(text) // max(1, text.count(b"\n"))))
    while text or not is_end:
        if len(text) < size and not is_end:
            piece = next(left, b"")
            text, is_end = text + piece, not piece
            continue
        end = cut(text[:size])
        is_all = is_end and size >= len(text)
        if not end and not is_all and size < MAX_RECORD:
            size *= 2
            continue
        if is_all and end < len(text) < cut(text + b"\n"):
            text += b"\n"  # which the last line lacks
            end = len(text)
        yield text[: (end := end or _end_of_lines(text))]
        text, size = text[end:], usual


def _end_of_lines(text: bytes) -> int:
    """Return where the last line ends that is within CHUNK bytes, or else the first line. Raises BadTable for one that is too long."""
    end = text.rfind(b"\n", 0, CHUNK) + 1 or text.find(b"\n") + 1
    if not end and len(text) >= MAX_RECORD:
        raise BadTable(f"a line is longer than {MAX_RECORD >> 20} MiB: this is not a table")
    return end or len(text)


@contextmanager
def output_to(target: str) -> Iterator[BinaryIO]:
    """Open the output of `-o`: stdout, a device or a pipe, or a file that appears when it is whole."""
    if target == "-":
        sys.stdout.flush()
        with open(os.dup(sys.stdout.fileno()), "wb") as stream:
            yield stream
        return
    if os.path.isdir(target):
        raise BadRequest(
            f"-o: {quoted(target)} is a directory; name a file in it, such as {quoted(os.path.join(target, 'x.csv'))}"
        )
    with whole_file(target) as stream:
        yield stream


def unnamed(target: str, kind: str, *, quiet: bool) -> FileFormat:
    """Return the format of an output whose name says none, and say which one it is where the name ends as if it said one.

    Raises BadRequest for a format that is another program's.
    """
    if ending(target) in SPREADSHEETS:
        raise BadRequest(f"-o: {quoted(target)} is a spreadsheet; write a table that it opens, such as .csv")
    if ending(target) == "json":
        table = quoted(f"{os.path.splitext(target)[0]}.{kind}")
        raise BadRequest(f"-o: a table is not written as JSON; name the file {table}")
    if os.path.splitext(target)[1] and not quiet:
        say(f"note: {quoted(target)} is written as {kind}: its name says no format", sys.stderr)
    return FileFormat(kind)
