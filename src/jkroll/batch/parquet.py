"""Parquet to Parquet: the columns of a file, block by block, with the results beside them.

A piece of it is some of the groups of rows that it was written in.
"""

import os
from collections.abc import Iterator
from math import isnan
from typing import Any

import numpy
import orjson
import pyarrow
import pyarrow.parquet

from .. import __version__
from ..errors import quoted
from ..nomenclature import header
from ..request import BadRequest
from .cells import Floats, Numbers, Reader, plain_numbers
from .columns import STATUS, check_first
from .errors import BadRow, BadTable
from .files import check_output, identity_of, opened
from .output import fingerprint
from .pieces import NUMBERS, PIECE, Group, as_column, rows_of_group, write
from .rows import Block, Evaluator, Results
from .settings import Order, Tally, input_format, output_format
from .source import Shared
from .spans import Span, groups_together
from .task import understood_task

BUFFER = 1 << 16  # bytes read at a time of each column
ROWS = 1 << 13  # rows computed together: what lies between two formulas stays in the cache
_DECIMALS = (0, 3, 6, 9)


def convert(path: str, order: Order, span: Span | None = None) -> Tally:
    """Convert a Parquet file, or a part of it."""
    settings = order.settings
    output_format(settings, input_format(path, settings))
    if "-" in (path, settings.target):
        raise BadRequest("Parquet is read from a file and written to a file: -o FILE")
    descriptor = opened(path)
    check_output(descriptor, settings.target)
    identity = identity_of(descriptor)
    os.close(descriptor)
    with opened_parquet(path) as file:
        return _File(file, order, span or Span(0, file.metadata.num_row_groups)).run(identity)


def opened_parquet(path: str) -> Any:
    """A Parquet file; BadTable if it is none."""
    try:
        return pyarrow.parquet.ParquetFile(path, buffer_size=BUFFER)
    except pyarrow.ArrowException:
        raise BadTable(f"{quoted(path)} is not Parquet, or its end is missing") from None


class _File:
    """One run over one file, whose groups of rows are put together to pieces."""

    def __init__(self, file: Any, order: Order, span: Span) -> None:
        self.file, self.order, self.settings = file, order, order.settings
        self.table, self.task = understood_task(tuple(file.schema_arrow.names), order)
        for column in self.task.inputs:
            if pyarrow.types.is_string(file.schema_arrow.types[column.place]) or column.unit is None:
                first = next(file.iter_batches(200, columns=[self.table.texts[column.place]]), None)
                values = [] if first is None else first.column(0).to_pylist()
                check_first(column, [_text(value) for value in values])
        self.evaluator = Evaluator(self.task)
        self.readers = [Reader(column) for column in self.task.inputs]
        self.names = [header(name) for name in self.task.quantities]
        self.shared = Shared()
        self.pieces = [*groups_together(file.metadata, PIECE, span)]
        self.total = len(self.pieces)

    def run(self, identity: list[int]) -> Tally:
        """Convert it."""
        fields = [
            *self.file.schema_arrow,
            *(pyarrow.field(name, pyarrow.float64()) for name in self.names),
            pyarrow.field(STATUS, pyarrow.string()),
        ]
        self.schema = pyarrow.schema(fields)
        parts = self.order.parts([__version__, pyarrow.__version__, PIECE, NUMBERS], identity)
        write(self.settings, self.shared, self.schema, fingerprint(parts), self)
        return Tally(self.shared["rows"], self.shared["failed"])

    def next(self) -> bytes | None:
        """The next groups of rows in the file that make up a piece."""
        place = self.shared["read"]
        if place == self.total:
            return None
        self.shared["read"] = place + 1
        return b"%d %d" % (self.pieces[place].start, self.pieces[place].end)

    def groups(self, text: bytes) -> Iterator[Group]:
        """The rows of a piece with their results, as many together as are written together."""
        first, last = map(int, text.split())
        done = sum(self.file.metadata.row_group(place).num_rows for place in range(first))
        for batch in self.file.iter_batches(rows_of_group(len(self.schema)), row_groups=range(first, last)):
            size = batch.num_rows
            columns = numpy.empty((len(self.names), size))
            status: dict[int, str] = {}
            for start in range(0, size, ROWS):
                part = batch.slice(start, ROWS)
                results = self._results(part)
                columns[:, start : start + part.num_rows] = results.numbers
                status |= {start + row: words for row, words in results.status.items()}
            if status and self.settings.strict:
                row = min(status)
                raise BadRow(done + row + 1, status[row])
            done += size
            words = pyarrow.nulls(size, pyarrow.string())
            if status:
                words = pyarrow.array([status.get(row) for row in range(size)], pyarrow.string())
            arrays = [as_column(values) for values in columns]
            yield Group(
                pyarrow.RecordBatch.from_arrays([*batch.columns, *arrays, words], schema=self.schema), len(status)
            )

    def _results(self, part: Any) -> Results:
        numbers = {reader.column.name: _numbers(part.column(reader.column.place), reader) for reader in self.readers}
        materials: dict[str, Any] = {}
        for name, place in self.task.materials_at:
            array = part.column(place)
            encoded = array if pyarrow.types.is_dictionary(array.type) else array.dictionary_encode()
            kinds = [_text(value) for value in encoded.dictionary.to_pylist()]
            codes = self.evaluator.lookups[name].codes([*kinds, ""])
            materials[name] = codes[encoded.indices.fill_null(len(kinds)).to_numpy(zero_copy_only=False)]
        places = {column.name: column.place for column in self.task.inputs} | dict(self.task.materials_at)
        return self.evaluator.results(
            Block(
                part.num_rows,
                numbers,
                materials,
                {},
                lambda row, name: _text(part.column(places[name])[row].as_py()),
            )
        )


def _text(value: object) -> str:
    """A value as a cell of text, a float as its shortest; nothing for null or nan."""
    return "" if value is None or (isinstance(value, float) and isnan(value)) else str(value)


def _numbers(array: Any, reader: Reader) -> Numbers:
    """The SI values of a column: numbers in its unit, or texts as in CSV."""
    kind = array.type
    exponent = reader.column.exponent
    if exponent is None or not (pyarrow.types.is_floating(kind) or pyarrow.types.is_integer(kind)):
        return reader.numbers([_text(value).encode() for value in array.to_pylist()])
    if array.null_count:
        array = array.cast(pyarrow.float64()).fill_null(numpy.nan)
    values = array.to_numpy(zero_copy_only=False).astype(float, copy=False)
    missing = numpy.isnan(values)
    given = ~missing if missing.any() else None
    scaled = values if exponent == 0 else times_power_of_ten(values, exponent, given)
    return Numbers(scaled, given, [])


def times_power_of_ten(values: Floats, exponent: int, given: Any = None) -> Floats:
    """Numbers times a power of ten as if their shortest decimal texts had been read with it: rounded once.

    >>> times_power_of_ten(numpy.array([0.1, 123.456]), -9).tolist()
    [1e-10, 1.23456e-07]
    """
    known = values if given is None else values[given]
    for decimals in _DECIMALS:
        down = decimals - exponent
        if not known.size or abs(down) > 22:
            continue
        # Whole numbers of at most 15 digits over powers of ten that doubles hold: one division, rounded once.
        whole = numpy.rint(known[:64] * 10.0**decimals)
        if (whole / 10.0**decimals == known[:64]).all():
            whole = numpy.rint(values * 10.0**decimals)
            size = numpy.abs(whole[given] if given is not None else whole).max()
            if size < 1e15 and (numpy.isnan(values) | (whole / 10.0**decimals == values)).all():
                return whole / 10.0**down if down >= 0 else whole * 10.0**-down
    text = orjson.dumps(values, option=orjson.OPT_SERIALIZE_NUMPY)[1:-1]
    if b"e" not in text and b"n" not in text:
        suffix = b"e%d" % exponent
        found = plain_numbers(text.replace(b",", suffix + b",") + suffix, len(values))
        if found is not None:
            return found
    return numpy.array(
        [
            float(f"{mantissa}e{int(power or 0) + exponent}") if mantissa != "nan" else numpy.nan
            for mantissa, _, power in (repr(value).partition("e") for value in values.tolist())
        ]
    )
