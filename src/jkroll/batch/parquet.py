"""Parquet to Parquet: the columns of a file with the results beside them, a number of rows at a time.

This thread reads and computes, another writes, and pyarrow has threads of its own; so `--jobs` changes nothing. A Parquet file
ends with an index of all of it: one that was interrupted is begun anew.
"""

import sys
from collections.abc import Iterator
from concurrent.futures import Future, ThreadPoolExecutor
from contextlib import closing, contextmanager, suppress
from math import isnan
from typing import Any

import numpy
import pyarrow
import pyarrow.parquet

from ..errors import BadRequest
from ..text import quoted, say, shown
from .asked import task_of_table
from .blocks import Block, Tally
from .cells import Floats, Numbers, Reader
from .columns import is_input
from .errors import BadTable
from .lines import Converted
from .output import OutputFile, Step, is_done
from .progress import Bar
from .rows import Evaluator
from .settings import Order, Settings, input_format, output_format
from .source import Input, Part, Span

BUFFER = 1 << 18  # bytes read at a time of each column
SPAN = 1 << 20  # least number of rows of a part of a table, but for the last
BYTES = 1 << 24  # of the rows written together, about: three of these are at work
BLOCK = 1 << 13  # rows computed together: what lies between two formulas stays in the cache


def rows_together(width: float) -> int:
    """Return how many rows of so many bytes are written together.

    >>> rows_together(8 * 40), rows_together(1e6)
    (52428, 16)
    """
    return max(int(BYTES / max(width, 1)), 1)


def convert(part: Part, order: Order) -> Tally:
    """Convert a Parquet file, or some of its groups of rows."""
    settings = order.settings._replace(target=part.target)
    output_format(settings, input_format(part.path, settings))
    if "-" in (part.path, part.target):
        raise BadRequest("Parquet is read from a file and written to a file: -o FILE")
    with closing(Input(part.path)) as given:
        given.check_output(part.target)
        if is_done(settings, given.time):
            return Tally(0, 0)
        with _readable(part.path):
            table = _Table(given, order, part.span)
        identity = order.identity([given.size, given.time])
        return write(settings, table.schema, table.converted(), table.size, identity)


def spans_of(path: str) -> list[Span]:
    """Return the parts of a Parquet file: as many groups of rows together as have enough rows."""
    spans: list[Span] = []
    start, rows = 0, 0
    with _readable(path):
        metadata = pyarrow.parquet.read_metadata(path)
    for place in range(metadata.num_row_groups):
        rows += metadata.row_group(place).num_rows
        if rows >= SPAN or place == metadata.num_row_groups - 1:
            spans.append(Span(start, place + 1))
            start, rows = place + 1, 0
    return spans


@contextmanager
def _readable(path: str) -> Iterator[None]:
    """Raise BadTable for what cannot be read."""
    try:
        yield
    except (OSError, UnicodeDecodeError, pyarrow.ArrowException) as error:
        reason = shown(str(error).strip().partition("\n")[0])
        raise BadTable(f"{quoted(path)} cannot be read as Parquet: {reason}") from None


Rows = tuple[Any, Tally]  # a table of Arrow with results, and its counts


class _Table:
    """A Parquet file whose rows are computed."""

    def __init__(self, given: Input, order: Order, span: Span | None) -> None:
        """`span`: of groups of rows; None for all."""
        self.given, self.path = given, given.path
        self.file = file = pyarrow.parquet.ParquetFile(given.file, buffer_size=BUFFER, pre_buffer=False)
        schema = file.schema_arrow
        task = task_of_table(tuple(schema.names), _sample(file), order)
        self.places = task.places
        for name, place in self.places.items():
            if not _is_cell(schema.types[place]):
                raise BadTable(f"header: column {name} holds {schema.types[place]}: neither numbers nor texts")
        self.task, self.evaluator = task, Evaluator(task)
        texts = {*task.said, *task.remarks}
        fields = [pyarrow.field(name, pyarrow.string() if name in texts else pyarrow.float64()) for name in task.added]
        self.schema = pyarrow.schema([*schema, *fields], metadata=schema.metadata)
        groups = [file.metadata.row_group(place) for place in range(file.metadata.num_row_groups)]
        start, end = (span.start, span.end) if span is not None else (0, len(groups))
        self.groups = range(start, end)
        self.size = sum(group.num_rows for group in groups[start:end])
        self.line = sum(group.num_rows for group in groups[:start])
        widths = [group.total_byte_size / max(group.num_rows, 1) for group in groups]
        self.together = min(BLOCK, rows_together(max(widths, default=0) + 8 * len(fields)))

    def converted(self) -> Iterator[Rows]:
        """Iterate over the rows with their results."""
        batches = self.file.iter_batches(self.together, row_groups=self.groups)
        while True:
            with _readable(self.path):
                batch = next(batches, None)
                if batch is None:
                    self.given.check_unchanged()
                    return
                rows = self._rows(batch)
                self.line += batch.num_rows
            yield rows

    def _rows(self, batch: Any) -> Rows:
        size = batch.num_rows
        results = self.evaluator.results(self._block(batch))
        said = [pyarrow.repeat(text, size) for text in self.task.said.values()]
        numbers = [as_column(values) for values in results.numbers]
        remarks = [pyarrow.array(map(texts.get, range(size)), "string") for texts in results.remarks.values()]
        table = pyarrow.Table.from_arrays([*batch.columns, *said, *numbers, *remarks], schema=self.schema)
        return table, results.tally

    def _block(self, batch: Any) -> Block:
        """Return the inputs of some rows."""
        materials: dict[str, Any] = {}
        for name, place in self.task.materials_at:
            array = batch.column(place)
            encoded = array if pyarrow.types.is_dictionary(array.type) else array.dictionary_encode()
            kinds = [_text(value) for value in encoded.dictionary.to_pylist()]
            codes = self.evaluator.lookups[name].codes([*kinds, ""])
            materials[name] = codes[encoded.indices.fill_null(len(kinds)).to_numpy()]
        return Block(
            batch.num_rows,
            {
                reader.column.name: _numbers(batch.column(reader.column.place), reader)
                for reader in self.evaluator.readers
            },
            materials,
            {},
            range(self.line + 1, self.line + batch.num_rows + 1),
            lambda row, name: _text(batch.column(self.places[name])[row].as_py()),
        )


def write(settings: Settings, schema: Any, tables: Iterator[Rows], total: int, identity: dict[str, str]) -> Tally:
    """Write tables as one file that gets its name when it is whole, in groups of rows of about the same size.

    `total`: the number of all rows. A thread writes.
    """
    with OutputFile(settings.target, goes_on=False) as output:
        if settings.resume and output.journal.has_begun:
            say("note: --resume: a Parquet file cannot be continued; it is begun anew", sys.stderr)
        output.begin(identity, b"", Converted(b"", 0))
        with (
            Bar(total, quiet=settings.quiet) as bar,
            open(output.descriptor, "wb", closefd=False) as file,
            _writer(file, schema) as writer,
            ThreadPoolExecutor(1) as thread,
        ):
            written: Future[None] = thread.submit(lambda: None)
            for group in _groups(tables):
                for _, tally in group:
                    output.count(Step(0, 0, *tally))
                table = pyarrow.concat_tables([table for table, _ in group])
                written.result()
                written = thread.submit(writer.write_table, table, table.num_rows)
                bar.show(output.done.rows, output.done.rows)
            written.result()
    return output.tally


def _groups(tables: Iterator[Rows]) -> Iterator[list[Rows]]:
    """Iterate over rows that are written together."""
    group: list[Rows] = []
    size = 0
    for rows in tables:
        group.append(rows)
        size += rows[0].nbytes
        if size >= BYTES:
            yield group
            group, size = [], 0
    if group:
        yield group


@contextmanager
def _writer(file: Any, schema: Any) -> Iterator[Any]:
    """Yield a writer of Parquet. After an error nothing is read of what it wrote: a second error while it ends is no news."""
    floats = [field.name for field in schema if pyarrow.types.is_floating(field.type)]
    writer = pyarrow.parquet.ParquetWriter(
        file,
        schema,
        compression="snappy",
        use_dictionary=[name for name in schema.names if name not in floats],
        column_encoding=dict.fromkeys(floats, "BYTE_STREAM_SPLIT"),
        write_statistics=False,
    )
    try:
        yield writer
    except BaseException:
        with suppress(OSError, pyarrow.ArrowException):
            writer.close()
        raise
    writer.close()


def as_column(values: Floats) -> Any:
    """Return numbers as a column, nan as null."""
    missing = numpy.isnan(values)
    return pyarrow.array(values, mask=missing if missing.any() else None)


def _sample(file: Any) -> list[list[str]]:
    """Return the first rows as cells of text, those of the inputs alone."""
    schema = file.schema_arrow
    names = [name for name, kind in zip(schema.names, schema.types, strict=True) if is_input(name) and _is_cell(kind)]
    first = next(file.iter_batches(200, columns=names, use_threads=False), None)
    rows = [] if first is None else first.to_pylist()
    return [[_text(row.get(name)) for name in schema.names] for row in rows]


def _is_cell(kind: Any) -> bool:
    """Return whether a column of a type can be an input: numbers, or texts."""
    types = pyarrow.types
    if types.is_dictionary(kind):
        return _is_cell(kind.value_type)
    return not (types.is_nested(kind) or types.is_temporal(kind) or isinstance(kind, pyarrow.BaseExtensionType))


def _text(value: object) -> str:
    """Return a value as a cell of text, a float as its shortest; an empty one for null or nan."""
    if isinstance(value, bytes):
        return value.decode(errors="replace")
    return "" if value is None or (isinstance(value, float) and isnan(value)) else str(value)


def _numbers(array: Any, reader: Reader) -> Numbers:
    """Return the SI values of a column: numbers in its unit, or texts as in CSV."""
    kind, unit = array.type, reader.column.unit
    is_text = not (pyarrow.types.is_floating(kind) or pyarrow.types.is_integer(kind))
    if is_text or (unit is None and reader.column.exponent is None):
        return reader.numbers([_text(value).encode() for value in array.to_pylist()])
    values = array.to_numpy(zero_copy_only=False).astype(float, copy=False)
    if unit is not None:
        with numpy.errstate(over="ignore"):  # an infinite number is read by itself, and refused
            values = values * float(unit.numerator) / float(unit.denominator)
    return Numbers(values, numpy.flatnonzero(numpy.isinf(values)).tolist())
