"""Parquet to Parquet: the columns of a file, block by block, with the results beside them.

One thread reads and computes while another encodes and writes. A Parquet file has its index at the end and cannot be gone on with.
"""

import os
import sys
from collections.abc import Callable, Iterator
from concurrent.futures import Future, ThreadPoolExecutor
from contextlib import closing
from math import isnan
from typing import Any

import numpy
import orjson
import pyarrow
import pyarrow.parquet

from ..errors import quoted
from ..nomenclature import header
from ..request import BadRequest
from .cells import Floats, Numbers, Reader, plain_numbers
from .columns import STATUS, check_first
from .errors import BadRow, BadTable
from .files import check_output, opened
from .output import FileSink
from .progress import Bar
from .rows import Block, Evaluator, Results
from .settings import Order, Settings, Tally, input_format, output_format
from .source import Shared
from .task import understood_task

GROUP = 1 << 15  # rows written together
ROWS = 1 << 13  # rows computed together: what lies between two formulas stays in the cache
_DECIMALS = (0, 3, 6, 9)


def convert(path: str, order: Order) -> Tally:
    """Convert a Parquet file."""
    settings = order.settings
    output_format(settings, input_format(path, settings))
    if "-" in (path, settings.target):
        raise BadRequest("Parquet is read from a file and written to a file: -o FILE")
    descriptor = opened(path)
    check_output(descriptor, settings.target)
    os.close(descriptor)
    try:
        file = pyarrow.parquet.ParquetFile(path)
    except pyarrow.ArrowException:
        raise BadTable(f"{quoted(path)} is not Parquet, or its end is missing") from None
    with file:
        return _File(file, order).run()


def write(settings: Settings, shared: Shared, schema: Any, groups: Iterator[Any]) -> None:
    """Write groups of rows as one file, which gets its name when it is whole."""
    with closing(FileSink(settings.target, shared, strict=settings.strict)) as sink:
        sink.begin({})
        bar = Bar(sys.stderr, shared, 0)
        _write(sink, schema, groups, bar.show if sys.stderr.isatty() and not settings.quiet else None)
        bar.clear()
        sink.finish()


def _write(sink: FileSink, schema: Any, groups: Iterator[Any], watch: Callable[[], None] | None) -> None:
    """Write groups of rows, each while the next is computed."""
    floats = [field.name for field in schema if pyarrow.types.is_floating(field.type)]
    with (
        os.fdopen(os.dup(sink.descriptor), "wb") as out,
        ThreadPoolExecutor(1) as writing,
        pyarrow.parquet.ParquetWriter(
            out,
            schema,
            compression="snappy",
            use_dictionary=[name for name in schema.names if name not in floats],
            column_encoding=dict.fromkeys(floats, "BYTE_STREAM_SPLIT"),
            write_statistics=False,
        ) as writer,
    ):
        written: Future[None] | None = None
        for group in groups:
            if written is not None:
                written.result()
            written = writing.submit(writer.write_batch, group, GROUP)
            if watch is not None:
                watch()
        if written is not None:
            written.result()


class _File:
    """One run over one file."""

    def __init__(self, file: Any, order: Order) -> None:
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

    def run(self) -> Tally:
        """Convert it."""
        fields = [
            *self.file.schema_arrow,
            *(pyarrow.field(name, pyarrow.float64()) for name in self.names),
            pyarrow.field(STATUS, pyarrow.string()),
        ]
        schema = pyarrow.schema(fields)
        write(self.settings, self.shared, schema, self._groups(schema))
        return Tally(self.shared["rows"], self.shared["failed"])

    def _groups(self, schema: Any) -> Iterator[Any]:
        """The rows with their results, as many together as are written together."""
        for batch in self.file.iter_batches(GROUP):
            size = batch.num_rows
            columns = numpy.empty((len(self.names), size))
            status: dict[int, str] = {}
            for start in range(0, size, ROWS):
                part = batch.slice(start, ROWS)
                results = self._results(part)
                columns[:, start : start + part.num_rows] = results.numbers
                status |= {start + row: words for row, words in results.status.items()}
            if status and self.settings.strict:
                first = min(status)
                raise BadRow(self.shared["rows"] + first + 1, status[first])
            self.shared["rows"] += size
            self.shared["failed"] += len(status)
            words = pyarrow.nulls(size, pyarrow.string())
            if status:
                words = pyarrow.array([status.get(row) for row in range(size)], pyarrow.string())
            arrays = [pyarrow.array(column, from_pandas=bool(numpy.isnan(column.min()))) for column in columns]
            yield pyarrow.RecordBatch.from_arrays([*batch.columns, *arrays, words], schema=schema)

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
