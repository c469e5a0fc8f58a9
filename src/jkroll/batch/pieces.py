"""A Parquet file that can be gone on with: whole pieces behind each other, and at the end an index of them all.

The places in a Parquet file count from its beginning, and pyarrow begins every file at 0. So each piece begins in the null
device and goes on in the file, which pyarrow asks where it is. What a piece says of itself stays in the file, where no reader
looks; the index at the end is put together from it. An empty piece comes first, so that there is always one.

Columns are made of their buffers: what pyarrow has for it imports pandas where it is installed, which takes 0.4 s.
"""

import os
from collections.abc import Callable, Mapping, Sequence
from contextlib import closing
from io import BytesIO
from typing import Any

import numpy
import pyarrow
import pyarrow.parquet

from . import ring
from .cells import Floats
from .files import check_file
from .lines import Converted
from .output import Blocks, FileSink
from .progress import watched
from .settings import Settings
from .source import Shared

ROWS = 1 << 14  # of a piece, about: what an interrupt may cost each process
# Of a piece, as they are in a file: memory depends neither on the rows nor, unless they repeat, on their length.
BYTES = 1 << 25
# Bytes of memory that a process gives back: most programs write, and so pyarrow reads, pages of that size.
LARGE = 1 << 20
MAGIC = b"PAR1"


def rows_of_piece(width: float) -> int:
    """How many rows of so many bytes are written together.

    >>> rows_of_piece(8 * 40), rows_of_piece(1e5)
    (16384, 335)
    """
    return max(min(ROWS, int(BYTES / width)), 1)


def as_column(values: Floats) -> Any:
    """Numbers as a column, nan as null."""
    is_given = ~numpy.isnan(values) if numpy.isnan(values.min()) else None
    return pyarrow.Array.from_buffers(pyarrow.float64(), len(values), [_bits(is_given), pyarrow.py_buffer(values)])


def as_texts(texts: Sequence[str | None]) -> Any:
    """Texts as a column, None as null."""
    encoded = [(text or "").encode() for text in texts]
    places = numpy.zeros(len(texts) + 1, dtype=numpy.int32)
    numpy.cumsum([*map(len, encoded)], out=places[1:])
    buffers = (pyarrow.py_buffer(places), pyarrow.py_buffer(b"".join(encoded)))
    return pyarrow.StringArray.from_buffers(len(texts), *buffers, _bits([text is not None for text in texts]))


def as_numpy(column: Any, null: float) -> Any:
    """The numbers of a column, and one in place of nulls."""
    bits, numbers = column.buffers()
    whole = pyarrow.Array.from_buffers(column.type, len(column), [None, numbers], offset=column.offset)
    values = numpy.from_dlpack(whole)
    if not column.null_count:
        return values
    end = column.offset + len(column)
    is_given = numpy.unpackbits(numpy.frombuffer(bits, dtype=numpy.uint8), count=end, bitorder="little")
    return numpy.where(is_given[column.offset :], values, null)


def _bits(is_given: Any) -> Any:
    """Which values are not null, as Arrow has it."""
    return None if is_given is None else pyarrow.py_buffer(numpy.packbits(is_given, bitorder="little"))


def write(
    settings: Settings,
    shared: Shared,
    schema: Any,
    identity: Mapping[str, str],
    source: Blocks,
    convert: Callable[[bytes], Converted],
    total: int,
) -> None:
    """Write what blocks become, tables, as one file that gets its name when it is whole. `total`: what is read at the end."""
    check_file(settings.target)
    with closing(_PieceSink(settings, shared, schema)) as sink:
        if not (settings.resume and sink.resume(identity, b"", source)):
            sink.begin(identity)
            sink.head(b"", pyarrow.Table.from_batches([], schema), 0)
        with watched(shared, total, is_quiet=settings.quiet, goes_on=True) as show:
            ring.run(source, convert, sink, settings.processes, show, LARGE)
        sink.finish()


class _PieceSink(FileSink):
    """A file whose blocks are tables."""

    def __init__(self, settings: Settings, shared: Shared, schema: Any) -> None:
        super().__init__(settings.target, shared, strict=settings.strict)
        self.schema = schema
        self.floats = [field.name for field in schema if pyarrow.types.is_floating(field.type)]

    def begin(self, identity: Mapping[str, str]) -> None:
        """Begin anew, as every Parquet file does."""
        super().begin(identity)
        super().append(MAGIC)

    def append(self, output: Any) -> None:
        """Write a table as a piece."""
        with (
            pyarrow.OSFile(os.devnull, "wb") as file,
            pyarrow.parquet.ParquetWriter(
                file,
                self.schema,
                compression="snappy",
                use_dictionary=[name for name in self.schema.names if name not in self.floats],
                column_encoding=dict.fromkeys(self.floats, "BYTE_STREAM_SPLIT"),
                write_statistics=False,
            ) as writer,
        ):
            os.lseek(self.descriptor, 0, os.SEEK_END)
            os.dup2(self.descriptor, file.fileno())
            if output.num_rows:
                writer.write_table(output, output.num_rows)
        self.shared["written"] = os.lseek(self.descriptor, 0, os.SEEK_CUR)

    def finish(self) -> None:
        """Write the index, and give the whole its name."""
        super().append(self._index())
        super().finish()

    def _index(self) -> bytes:
        """What stands at the end of a Parquet file, of what stands at the ends of its pieces."""
        whole: Any = None
        with open(self.partial, "rb") as file:
            for step in self.noted():
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
