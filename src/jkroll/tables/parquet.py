"""Parquet: read the batches of a file as records, and write rows as batches."""

from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from typing import Any, BinaryIO

import pyarrow
import pyarrow.parquet

from ..errors import BadRequest, BadTable
from ..model.rows import BLOCK, has_texts
from ..text import quoted, shown
from ..write.writers import divided, length
from .cells import cell_of, cells_of
from .files import Input
from .layouts import SAMPLE
from .table import Asked, Records, Table

BUFFER = 1 << 18  # bytes read at a time from each column
BYTES = 1 << 24  # approximate number of bytes in a group of rows

# --- Rows as batches --------------------------------------------------------------------------------------------------


class Batches:
    """The writer of rows as batches of Arrow. The header is an empty batch."""

    is_plain, has_words, digits = False, False, None

    def header(self, heads: Sequence[str], before: Sequence[Any] = ()) -> Any:
        """Return the empty batch with the types of all columns.

        `before`: the schema of the columns before these, as the only element; empty if there are none.
        """
        (schema,) = before or (pyarrow.schema([]),)
        new = [pyarrow.field(head, pyarrow.string() if has_texts(head) else pyarrow.float64()) for head in heads]
        full_schema = pyarrow.schema([*schema, *new], metadata=schema.metadata)
        return pyarrow.RecordBatch.from_pylist([], schema=full_schema)

    def rows(self, heads: Sequence[str], columns: Sequence[Any], before: Any = None) -> Any:
        """Return rows as a batch. `before`: the batch with the columns before these."""
        schema = self.header(heads, [before.schema] if before is not None else ()).schema
        arrays = before.columns if before is not None else []
        size = max(map(length, columns))
        for column, field in zip(divided(columns), [*schema][len(arrays) :], strict=True):
            cells = column if length(column) else [column] * size
            arrays.append(pyarrow.array(cells, field.type, from_pandas=True))
        return pyarrow.RecordBatch.from_arrays(arrays, schema=schema)

    @contextmanager
    def sink(self, stream: BinaryIO, header: Any) -> Iterator[Callable[[Any], None]]:
        """Yield a function that writes batches in groups of similar size. `header`: a batch with the schema."""
        others = [field.name for field in header.schema if not pyarrow.types.is_floating(field.type)]
        group: list[Any] = []
        size = 0  # bytes in the group; memory that several batches share counts for each of them
        with pyarrow.parquet.ParquetWriter(stream, header.schema, use_dictionary=others) as file:

            def flush() -> None:
                file.write_table(pyarrow.Table.from_batches(group, header.schema))
                group.clear()

            def write(batch: Any) -> None:
                nonlocal size
                group.append(batch)
                size += batch.nbytes
                if size >= BYTES:
                    flush()
                    size = 0

            yield write
            if group:
                flush()


# --- A file as blocks -------------------------------------------------------------------------------------------------


def batches_of(source: Input, target: str, asked: Asked) -> tuple["Arrow", Iterator[Any]]:
    """Return the table of a Parquet file, and its batches."""
    if "-" in (source.path, target):
        raise BadRequest("Parquet is read from a file and written to a file: -o FILE")
    with _readable(source.path):
        file = pyarrow.parquet.ParquetFile(source.file, buffer_size=BUFFER, pre_buffer=False)
        table = Arrow(file, asked)
    source.rows = file.metadata.num_rows

    def batches() -> Iterator[Any]:
        with _readable(source.path):
            yield from file.iter_batches(BLOCK)

    return table, batches()


@contextmanager
def _readable(path: str) -> Iterator[None]:
    """Raise BadTable if the file cannot be read inside this context."""
    try:
        yield
    except (OSError, UnicodeDecodeError, pyarrow.ArrowException) as error:
        reason = shown(str(error).strip().partition("\n")[0])
        raise BadTable(f"{quoted(path)} cannot be read as Parquet: {reason}") from None


class Arrow:
    """A table in a Parquet file, whose columns have types."""

    lines, remarks = 0, ()  # the header is not a line

    def __init__(self, file: Any, asked: Asked) -> None:
        """Read the header, and the cells of the first rows in the columns that may be read."""
        self.header, self.writer = file.schema_arrow, Batches()
        self.names = tuple(self.header.names)
        self.stated = asked.stated
        columns = [*filter(asked.is_read, self.names)]
        first = next(file.iter_batches(SAMPLE, columns=columns, use_threads=False), None)
        rows = first.to_pylist() if first is not None else []
        self.sample = [[cell_of(row.get(name)) for name in self.names] for row in rows]

    def head(self, added: Sequence[str]) -> Any:
        """Return the empty batch with the columns of the table and the added ones."""
        return self.writer.header(added, [self.header])

    def read(self, batch: Any, table: Table) -> Records:
        """Return the records of a batch."""
        cells = {}
        for name, position in table.columns.positions.items():
            cells[name] = cells_of(values_of(batch.column(position)))
        for name, position in table.labels.items():
            column = batch.column(position)
            cells[name] = cells_of(column.to_pylist()) if _has_texts(column.type) else [b""] * batch.num_rows
        return Records(batch, cells, {}, range(batch.num_rows), batch.num_rows)


def _has_texts(type_: Any) -> bool:
    """Return whether a type of Arrow holds texts."""
    types = pyarrow.types
    type_ = type_.value_type if types.is_dictionary(type_) else type_
    return bool(types.is_string(type_) or types.is_large_string(type_) or types.is_string_view(type_))


def values_of(column: Any) -> Any:
    """Return the values of a column: an array if all are integers or all are doubles, which is faster; else a list."""
    has_numbers = pyarrow.types.is_integer(column.type) or pyarrow.types.is_float64(column.type)
    return column.to_numpy() if has_numbers and not column.null_count else column.to_pylist()
