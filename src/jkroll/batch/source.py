"""The input as blocks of whole records, cut at the same places in every run."""

import errno
import os
import stat
from collections.abc import Callable, Iterator
from contextlib import suppress
from typing import BinaryIO

from ..errors import BadRequest
from ..text import quoted
from .errors import BadTable
from .formats import CHUNK, decompressed
from .spans import Span

MAX_RECORD = 1 << 24

Cut = Callable[[bytes, bool], int]  # number of bytes of whole records at the beginning of a text; all of it at the end


class Input:
    """An open file or pipe."""

    def __init__(self, path: str) -> None:
        """Open it; `-` is stdin. Raises BadTable."""
        self.path = path
        try:
            descriptor = os.dup(0) if path == "-" else os.open(path, os.O_RDONLY | getattr(os, "O_BINARY", 0))
            self.file: BinaryIO = open(descriptor, "rb", buffering=CHUNK)
        except OSError as error:
            raise BadTable(f"{quoted(path)}: {error.strerror}") from None
        self.about = os.fstat(descriptor)
        self.is_file = stat.S_ISREG(self.about.st_mode)
        if stat.S_ISDIR(self.about.st_mode):
            raise BadTable(f"{quoted(path)}: {os.strerror(errno.EISDIR)}")

    @property
    def identity(self) -> list[int]:
        """Size and time of a file; nothing of a pipe."""
        return _size_and_time(self.about) if self.is_file else []

    def pieces(self, compression: str, span: Span | None) -> Iterator[bytes]:
        """Iterate over the bytes to convert."""
        if span is not None:
            return span.read(self.file)
        return (
            decompressed(self.file, compression, self.path) if compression else iter(lambda: self.file.read(CHUNK), b"")
        )

    def position(self) -> int:
        """Return the number of bytes read of a file; 0 of a pipe."""
        return self.file.tell() if self.is_file else 0

    def check_unchanged(self) -> None:
        """Raise BadTable if a file was changed after it was opened."""
        if self.is_file and _size_and_time(os.fstat(self.file.fileno())) != self.identity:
            raise BadTable(f"{quoted(self.path)} was changed while it was read; begin anew")

    def check_output(self, target: str) -> None:
        """Refuse to write over the input."""
        with suppress(OSError):
            if self.is_file and os.path.samestat(self.about, os.stat(target)):
                raise BadRequest(f"-o: {quoted(target)} is the input; it is not overwritten")

    def close(self) -> None:
        """Close it."""
        self.file.close()


def _size_and_time(about: os.stat_result) -> list[int]:
    return [about.st_size, about.st_mtime_ns]


class Blocks:
    """Iterate over blocks of whole records."""

    def __init__(self, pieces: Iterator[bytes], cut: Cut) -> None:
        """`pieces`: the bytes of the table. `cut`: finds the end of the last whole record."""
        self.pieces, self.cut = pieces, cut
        self.text, self.start = b"", 0  # bytes at hand, and where the next block begins in them
        self.is_end = False

    def __iter__(self) -> Iterator[bytes]:
        return self

    def __next__(self) -> bytes:
        size = CHUNK
        while True:
            self._fill(size)
            window = self.text[self.start : self.start + size]
            is_last = self.is_end and self.start + size >= len(self.text)
            if not window:
                raise StopIteration
            # A record longer than any table's ends where a line does; the format says what is wrong with it.
            end = self.cut(window, is_last or size >= MAX_RECORD)
            if end:
                self.start += end
                return window[:end]
            if size >= MAX_RECORD:
                raise BadTable(f"a line is longer than {MAX_RECORD >> 20} MiB: this is no table")
            size *= 2

    def _fill(self, size: int) -> None:
        """Have that many bytes at hand, if there are."""
        if self.is_end or len(self.text) - self.start >= size:
            return
        pieces = [self.text[self.start :]]
        found = len(pieces[0])
        while found < size and not self.is_end:
            piece = next(self.pieces, None)
            self.is_end = piece is None
            pieces.append(piece or b"")
            found += len(pieces[-1])
        self.text, self.start = b"".join(pieces), 0

    def head(self) -> bytes:
        """Return the first block, which comes again."""
        text = next(self, b"")
        self.start -= len(text)
        return text

    def skip(self, size: int) -> None:
        """Leave out the first bytes."""
        self.start += size
