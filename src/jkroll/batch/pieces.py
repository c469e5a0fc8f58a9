"""A Parquet file that can be gone on with: whole pieces behind each other, and at the end an index of them all.

The places in a Parquet file count from its beginning, and pyarrow begins every file at 0. So a piece is first written by
itself, behind a hole as long as all that stands before it. What a piece says of itself stays in the file, where no reader
looks; the index at the end is put together from it. An empty piece comes first, so that there is always one.
"""

import os
from collections.abc import Callable, Iterator, Mapping
from concurrent.futures import Future, ThreadPoolExecutor
from contextlib import closing, suppress
from io import BytesIO
from typing import Any, NamedTuple, Protocol

import numpy
import pyarrow
import pyarrow.parquet

from .output import FileSink
from .progress import watched
from .settings import Settings
from .source import Shared

PIECE = 1 << 18  # rows, at least, that an interrupt may cost
NUMBERS = 700_000  # written together, at most: memory depends neither on the rows nor on the columns
MAGIC = b"PAR1"
COPIED = 1 << 20


class Group(NamedTuple):
    """Rows that are written together."""

    batch: Any
    failed: int


class Pieces(Protocol):
    """What is written, piece by piece."""

    total: int  # what counter `read` is at the end

    def next(self) -> bytes | None:
        """What tells the next piece from the others; None at the end."""

    def groups(self, text: bytes) -> Iterator[Group]:
        """The rows of that piece, the same whenever they are asked for."""


def rows_of_group(columns: int) -> int:
    """How many rows are written together.

    >>> rows_of_group(41)
    16384
    """
    return 1 << max((NUMBERS // columns).bit_length() - 1, 10)


def as_column(values: Any) -> Any:
    """Numbers as a column, nan as null."""
    return pyarrow.array(values, from_pandas=bool(numpy.isnan(values.min())))


def write(settings: Settings, shared: Shared, schema: Any, identity: Mapping[str, str], pieces: Pieces) -> None:
    """Write pieces as one file, which gets its name when it is whole; one thread computes, another encodes and writes."""
    with closing(FileSink(settings.target, shared, strict=settings.strict)) as sink:
        if not (settings.resume and sink.resume(identity, b"", pieces)):
            sink.begin(identity)
            with BytesIO() as empty:
                _writer(empty, schema).close()
                sink.head(b"", empty.getvalue(), 0)
        try:
            with watched(shared, pieces.total, is_quiet=settings.quiet, goes_on=True) as show:
                _write(sink, schema, pieces, show)
        finally:
            with suppress(FileNotFoundError):
                os.unlink(sink.piece)
        sink.append(_index(sink))
        sink.finish()


def _write(sink: FileSink, schema: Any, pieces: Pieces, show: Callable[[], None]) -> None:
    """Write all pieces that are left."""
    with ThreadPoolExecutor(1) as writing:
        written: Future[Any] = writing.submit(int)
        while (text := pieces.next()) is not None:
            piece = _Piece(sink, schema)
            for group in pieces.groups(text):
                written.result()
                written = writing.submit(piece.write, group)
                show()
            written.result()
            written = writing.submit(piece.finish, text)
        written.result()


class _Piece:
    """The piece that is being written."""

    def __init__(self, sink: FileSink, schema: Any) -> None:
        self.sink, self.schema = sink, schema
        self.writer: Any = None
        self.rows = self.failed = 0

    def _begin(self) -> None:
        path = self.sink.piece
        with suppress(FileNotFoundError):
            os.unlink(path)
        self.start = self.sink.shared["written"]
        self.file = pyarrow.OSFile(path, "ab")
        self.writer = _writer(self.file, self.schema)
        os.truncate(path, self.start - 1)
        self.file.write(b"\0")

    def write(self, group: Group) -> None:
        """Write rows."""
        if self.writer is None:
            self._begin()
        self.writer.write_batch(group.batch, group.batch.num_rows)
        self.rows += group.batch.num_rows
        self.failed += group.failed

    def finish(self, text: bytes) -> None:
        """Put the piece behind those before."""
        if self.writer is None:
            self._begin()
        self.writer.close()
        self.file.close()
        with open(self.sink.piece, "rb") as file:
            file.seek(self.start)
            while copied := file.read(COPIED):
                self.sink.append(copied)
        self.sink.done(text, rows=self.rows, failed=self.failed)


def _writer(file: Any, schema: Any) -> Any:
    floats = [field.name for field in schema if pyarrow.types.is_floating(field.type)]
    return pyarrow.parquet.ParquetWriter(
        file,
        schema,
        compression="snappy",
        use_dictionary=[name for name in schema.names if name not in floats],
        column_encoding=dict.fromkeys(floats, "BYTE_STREAM_SPLIT"),
        write_statistics=False,
    )


def _index(sink: FileSink) -> bytes:
    """What stands at the end of a Parquet file, of what stands at the ends of its pieces."""
    whole: Any = None
    with open(sink.partial, "rb") as file:
        for step in sink.noted():
            end = step.written - len(MAGIC) - 4
            file.seek(end)
            start = end - int.from_bytes(file.read(4), "little")
            file.seek(start)
            text = MAGIC + file.read(step.written - start)
            piece = pyarrow.parquet.read_metadata(pyarrow.BufferReader(text))
            if whole is None:
                whole = piece
            else:
                whole.append_row_groups(piece)
    with BytesIO() as text_of_whole:
        whole.write_metadata_file(text_of_whole)
        return text_of_whole.getvalue()[len(MAGIC) :]
