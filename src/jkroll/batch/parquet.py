"""Parquet to Parquet: the columns of a file with the results beside them, a number of rows at a time.

A thread reads and computes while another one writes, so `--jobs` changes nothing. A Parquet file ends with an index of all of it: one that was
interrupted is begun anew.
"""

import sys
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from contextlib import closing, contextmanager
from math import isnan
from typing import Any

import numpy
import pyarrow
import pyarrow.parquet

from ..errors import BadRequest
from ..table.blocks import Block, Tally
from ..table.cells import Floats, Numbers, Reader
from ..table.columns import is_input
from ..table.errors import BadTable
from ..table.evaluator import Evaluator
from ..text import quoted, say, shown
from .asked import task_of_table
from .lines import Converted
from .output import OutputFile, Step, is_done
from .progress import Bar
from .settings import Order, Settings, input_format, output_format
from .source import Input, Part, Span

BUFFER = 1 << 18  # bytes read at a time of each column
SPAN = 1 << 20  # least number of rows of a part of a table, but for the last
BLOCK = 1 << 13  # rows computed together: what lies between two formulas stays in the cache
BYTES = 1 << 24  # of the rows written together, and at most of those computed together, about

Rows = tuple[Any, Tally]  # a batch of Arrow with results, and its counts


def convert(part: Part, order: Order) -> Tally:
    """Convert a Parquet file, or some of its groups of rows."""
    settings = order.settings._replace(target=part.target)
    output_format(settings, input_format(part.path, settings))
    if "-" in (part.path, part.target):
        raise BadRequest("Parquet is read from a file and written to a file: -o FILE")
    with closing(Input(part.path)) as given:
        given.check_output(part.target)
        if is_done(settings, given.time):
            return Tally()
        with _readable(part.path):
            table = _Table(given, order, part.span)
        return write(settings, table.schema, table.rows(), table.size, order.identity([given.size, given.time]))


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


class _Table:
    """A Parquet file whose rows are computed."""

    def __init__(self, given: Input, order: Order, span: Span | None) -> None:
        """`span`: of groups of rows; None for all."""
        self.given = given
        self.file = file = pyarrow.parquet.ParquetFile(given.file, buffer_size=BUFFER, pre_buffer=False)
        self.task = task = task_of_table(tuple(file.schema_arrow.names), _first_rows(file), order)
        self.evaluator = Evaluator(task)
        texts = {*task.said, *task.remarks}
        fields = [pyarrow.field(name, pyarrow.string() if name in texts else pyarrow.float64()) for name in task.added]
        self.schema = pyarrow.schema([*file.schema_arrow, *fields], metadata=file.schema_arrow.metadata)
        groups = [file.metadata.row_group(place) for place in range(file.metadata.num_row_groups)]
        self.groups = range(*span[:2]) if span is not None else range(len(groups))
        self.size = sum(groups[place].num_rows for place in self.groups)
        self.line = sum(group.num_rows for group in groups[: self.groups.start])
        width = max((group.total_byte_size / max(group.num_rows, 1) for group in groups), default=0) + 8 * len(fields)
        self.together = max(min(BLOCK, int(BYTES / width)), 1)

    def rows(self) -> Iterator[Rows]:
        """Iterate over the rows with their results. Raises BadTable if the file was changed meanwhile."""
        with _readable(self.given.path):
            for batch in self.file.iter_batches(self.together, row_groups=self.groups):
                yield self._with_results(batch)
                self.line += batch.num_rows
        self.given.check_unchanged()

    def _with_results(self, batch: Any) -> Rows:
        size = batch.num_rows
        results = self.evaluator.results(self._block(batch))
        columns = [
            *batch.columns,
            *(pyarrow.repeat(text, size) for text in self.task.said.values()),
            *map(as_column, results.numbers),
            *(pyarrow.array(map(texts.get, range(size)), "string") for texts in results.remarks.values()),
        ]
        return pyarrow.RecordBatch.from_arrays(columns, schema=self.schema), results.tally

    def _block(self, batch: Any) -> Block:
        """Return the inputs of some rows."""
        places = self.task.places
        materials = {}
        for name, place in self.task.materials_at:  # a text is looked up once, not in every row
            encoded = batch.column(place).dictionary_encode()
            texts = [*map(_text, encoded.dictionary.to_pylist()), ""]
            rows = encoded.indices.cast(pyarrow.int64()).fill_null(len(texts) - 1)
            materials[name] = self.evaluator.lookups[name].codes(texts)[rows.to_numpy()]
        return Block(
            batch.num_rows,
            {
                reader.column.name: _numbers(batch.column(reader.column.place), reader)
                for reader in self.evaluator.readers
            },
            materials,
            {},
            range(self.line + 1, self.line + batch.num_rows + 1),
            lambda row, name: _text(batch.column(places[name])[row].as_py()),
        )


def write(settings: Settings, schema: Any, rows: Iterator[Rows], total: int, identity: dict[str, str]) -> Tally:
    """Write a file that gets its name when it is whole, in groups of rows of about the same size.

    `total`: the number of all rows.
    """
    texts = [field.name for field in schema if not pyarrow.types.is_floating(field.type)]  # numbers seldom repeat
    with OutputFile(settings.target, goes_on=False) as output:
        if settings.resume and output.journal.has_begun:
            say("note: --resume: a Parquet file cannot be continued; it is begun anew", sys.stderr)
        output.begin(identity, b"", Converted(b""))
        with (
            Bar(total, quiet=settings.quiet) as bar,
            open(output.descriptor, "wb", closefd=False) as file,
            pyarrow.parquet.ParquetWriter(file, schema, use_dictionary=texts) as writer,
        ):
            for group in _ahead(_groups(rows)):
                table = pyarrow.Table.from_batches([batch for batch, _ in group])
                writer.write_table(table, table.num_rows)
                for _, tally in group:
                    output.count(Step(0, 0, *tally))
                bar.show(output.done.rows, output.done.rows)
    return output.tally


def _groups(batches: Iterator[Rows]) -> Iterator[list[Rows]]:
    """Iterate over rows that are written together."""
    group: list[Rows] = []
    size = 0
    for rows in batches:
        group.append(rows)
        size += rows[0].nbytes
        if size >= BYTES:
            yield group
            group, size = [], 0
    if group:
        yield group


def _ahead(groups: Iterator[list[Rows]]) -> Iterator[list[Rows]]:
    """Iterate over groups, of which a thread prepares the next one while one is written."""
    with ThreadPoolExecutor(1) as thread:
        coming = thread.submit(next, groups, None)
        while (group := coming.result()) is not None:
            coming = thread.submit(next, groups, None)
            yield group


def as_column(values: Floats) -> Any:
    """Return numbers as a column, nan as null."""
    missing = numpy.isnan(values)
    return pyarrow.array(values, mask=missing if missing.any() else None)


def _first_rows(file: Any) -> list[list[str]]:
    """Return the first rows as cells of text, those of the inputs alone. Raises BadTable for an input of another type."""
    schema = file.schema_arrow
    inputs = [field for field in schema if is_input(field.name)]
    for field in inputs:
        if not _is_cell(field.type):
            raise BadTable(f"header: column {field.name} holds {field.type}: neither numbers nor texts")
    first = next(file.iter_batches(200, columns=[field.name for field in inputs], use_threads=False), None)
    rows = first.to_pylist() if first is not None else []
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
