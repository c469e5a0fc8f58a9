"""Parquet to Parquet: the columns of a file, piece by piece, with the results beside them."""

import os
from collections.abc import Iterator
from contextlib import contextmanager
from math import isnan
from typing import Any, NamedTuple
from zlib import crc32

import numpy
import orjson
import pyarrow
import pyarrow.parquet

from .. import __version__
from ..errors import BadRequest
from ..quantities.nomenclature import header
from ..text import quoted, shown
from .cells import Floats, Numbers, Reader, plain_numbers
from .columns import STATUS, check_first
from .errors import BadTable
from .files import check_output, identity_of, opened
from .lines import Converted
from .output import fingerprint
from .pieces import BYTES, ROWS, as_column, as_numpy, as_texts, rows_of_piece, write
from .rows import Block, Evaluator, Results
from .settings import Order, Tally, input_format, output_format
from .source import Shared
from .spans import Span, groups_together
from .task import understood_task

BUFFER = 1 << 18  # bytes read at a time of each column
BLOCK = 1 << 13  # rows computed together: what lies between two formulas stays in the cache
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
        with _readable(path):
            table = _File(path, file, order, span or Span(0, file.metadata.num_row_groups))
        return table.run([*identity, _checksum(path, file.metadata.serialized_size)])


def opened_parquet(path: str) -> Any:
    """A Parquet file; BadTable if it is none."""
    try:
        return pyarrow.parquet.ParquetFile(path, buffer_size=BUFFER, pre_buffer=False)
    except (OSError, pyarrow.ArrowException):
        raise BadTable(f"{quoted(path)} is not Parquet, or its end is missing, or it is encrypted") from None


@contextmanager
def _readable(path: str) -> Iterator[None]:
    """What cannot be read is no table."""
    try:
        yield
    except (OSError, UnicodeDecodeError, pyarrow.ArrowException) as error:
        reason = shown(str(error).strip().partition("\n")[0])
        raise BadTable(f"{quoted(path)} cannot be read as Parquet: {reason}") from None


def _checksum(path: str, size: int) -> int:
    """Of the index of a file, which says of everything where it stands and how large it is."""
    with open(path, "rb") as file:
        file.seek(-size - 8, os.SEEK_END)
        return crc32(file.read())


class _Piece(NamedTuple):
    """Rows that are converted together: of some groups of rows so many, after the first ones."""

    groups: Span
    skip: int
    rows: int


def _pieces(metadata: Any, rows: int, span: Span) -> Iterator[_Piece]:
    """Pieces of about so many rows: several small groups, or parts of a large one."""
    for groups in groups_together(metadata, rows, span):
        total: int = sum(metadata.row_group(place).num_rows for place in range(groups.start, groups.end))
        block = min(rows, BLOCK)
        size = -(-total // max(total // rows, 1) // block) * block
        for skip in range(0, total, max(size, 1)):
            yield _Piece(groups, skip, min(size, total - skip))


class _Rows:
    """The rows of a file, from front to back: each process leaves out those that others convert."""

    def __init__(self, file: Any, size: int) -> None:
        """`size`: how many at most come together."""
        self.file, self.size = file, size
        self.groups, self.place = Span(0, 0), 0
        self.batches: Iterator[Any] = iter(())
        self.batch: Any = None  # that begins at this place

    def of(self, piece: _Piece) -> Iterator[Any]:
        """The rows of a piece."""
        if self.groups != piece.groups:
            groups = range(piece.groups.start, piece.groups.end)
            self.groups, self.place, self.batch = piece.groups, 0, None
            self.batches = self.file.iter_batches(self.size, row_groups=groups, use_threads=False)
        end = piece.skip + piece.rows
        while self.place < end:
            batch = self.batch = self.batch or next(self.batches)
            wanted = batch.slice(max(piece.skip - self.place, 0), end - max(self.place, piece.skip))
            if wanted.num_rows:
                yield wanted
            if self.place + batch.num_rows > end:
                return
            self.place, self.batch = self.place + batch.num_rows, None


class _File:
    """One run over one file."""

    def __init__(self, path: str, file: Any, order: Order, span: Span) -> None:
        self.path, self.file, self.order, self.settings = path, file, order, order.settings
        self.table, self.task = understood_task(tuple(file.schema_arrow.names), order)
        for name, place in [*((column.name, column.place) for column in self.task.inputs), *self.task.materials_at]:
            if not _is_cell(file.schema_arrow.types[place]):
                raise BadTable(
                    f"header: column {name} holds {file.schema_arrow.types[place]}: neither numbers nor texts"
                )
        for column in self.task.inputs:
            if pyarrow.types.is_string(file.schema_arrow.types[column.place]) or column.unit is None:
                texts = [self.table.texts[column.place]]
                first = next(file.iter_batches(200, columns=texts, use_threads=False), None)
                values = [] if first is None else first.column(0).to_pylist()
                check_first(column, [_text(value) for value in values])
        self.evaluator = Evaluator(self.task)
        self.readers = [Reader(column) for column in self.task.inputs]
        fields = [pyarrow.field(header(name), pyarrow.float64()) for name in self.task.quantities]
        fields_out = [*file.schema_arrow, *fields, pyarrow.field(STATUS, pyarrow.string())]
        self.schema = pyarrow.schema(fields_out, metadata=file.schema_arrow.metadata)
        self.shared = Shared()
        self.shared["lines"] = sum(file.metadata.row_group(place).num_rows for place in range(span.start))
        rows = rows_of_piece(_width(file.metadata) + 8 * len(fields))
        self.pieces = [*_pieces(file.metadata, rows, span)]
        self.rows = _Rows(file, min(rows, BLOCK))
        # One array for every piece: the one before is written when the next is begun.
        self.numbers = numpy.empty((len(fields), max((piece.rows for piece in self.pieces), default=0)))

    def run(self, identity: list[int]) -> Tally:
        """Convert it."""
        parts = self.order.parts([__version__, pyarrow.__version__, ROWS, BYTES], identity)
        write(self.settings, self.shared, self.schema, fingerprint(parts), self, self.convert, len(self.pieces))
        return Tally(self.shared["rows"], self.shared["failed"])

    def next(self) -> bytes | None:
        """The number of the next piece."""
        place = self.shared["read"]
        if place == len(self.pieces):
            return None
        self.shared["read"] = place + 1
        return b"%d" % place

    def convert(self, text: bytes) -> Converted:
        """A piece with its results."""
        with _readable(self.path):
            return self._converted(self.pieces[int(text)])

    def _converted(self, piece: _Piece) -> Converted:
        numbers = self.numbers[:, : piece.rows]
        status: dict[int, str] = {}
        batches: list[Any] = []
        row = 0
        for batch in self.rows.of(piece):
            results = self._results(batch, numbers[:, row : row + batch.num_rows])
            status |= {row + place: words for place, words in results.status.items()}
            batches.append(batch)
            row += batch.num_rows
        words = (
            as_texts([*map(status.get, range(piece.rows))]) if status else pyarrow.nulls(piece.rows, pyarrow.string())
        )
        given = pyarrow.Table.from_batches(batches, self.file.schema_arrow).columns
        table = pyarrow.Table.from_arrays([*given, *map(as_column, numbers), words], schema=self.schema)
        first_failure = min(status.items()) if status else None
        return Converted(table, piece.rows, len(status), piece.rows, first_failure)

    def _results(self, part: Any, into: Floats) -> Results:
        numbers = {reader.column.name: _numbers(part.column(reader.column.place), reader) for reader in self.readers}
        materials: dict[str, Any] = {}
        for name, place in self.task.materials_at:
            array = part.column(place)
            encoded = array if pyarrow.types.is_dictionary(array.type) else array.dictionary_encode()
            kinds = [_text(value) for value in encoded.dictionary.to_pylist()]
            codes = self.evaluator.lookups[name].codes([*kinds, ""])
            materials[name] = codes[as_numpy(encoded.indices, len(kinds))]
        places = {column.name: column.place for column in self.task.inputs} | dict(self.task.materials_at)
        return self.evaluator.results(
            Block(
                part.num_rows,
                numbers,
                materials,
                {},
                lambda row, name: _text(part.column(places[name])[row].as_py()),
            ),
            into,
        )


def _width(metadata: Any) -> float:
    """How many bytes a row takes, in the group where it takes most."""
    groups = [metadata.row_group(place) for place in range(metadata.num_row_groups)]
    return max((group.total_byte_size / max(group.num_rows, 1) for group in groups), default=0.0)


def _is_cell(kind: Any) -> bool:
    """Whether a column of a type can be an input: numbers, or what is a cell of text."""
    types = pyarrow.types
    if types.is_dictionary(kind):
        return _is_cell(kind.value_type)
    return not (types.is_nested(kind) or types.is_temporal(kind) or isinstance(kind, pyarrow.BaseExtensionType))


def _text(value: object) -> str:
    """A value as a cell of text, a float as its shortest; nothing for null or nan."""
    if isinstance(value, bytes):
        return value.decode(errors="replace")
    return "" if value is None or (isinstance(value, float) and isnan(value)) else str(value)


def _numbers(array: Any, reader: Reader) -> Numbers:
    """The SI values of a column: numbers in its unit, or texts as in CSV."""
    kind = array.type
    exponent = reader.column.exponent
    if exponent is None or not (pyarrow.types.is_floating(kind) or pyarrow.types.is_integer(kind)):
        return reader.numbers([_text(value).encode() for value in array.to_pylist()])
    values = as_numpy(array, numpy.nan).astype(float, copy=False)
    missing = numpy.isnan(values)
    given = ~missing if missing.any() else None
    scaled = values if exponent == 0 else times_power_of_ten(values, exponent, given)
    return Numbers(scaled, given, numpy.flatnonzero(numpy.isinf(values)).tolist())


def times_power_of_ten(values: Floats, exponent: int, given: Any = None) -> Floats:
    """Numbers times a power of ten as if their shortest decimal texts had been read with it: rounded once.

    >>> times_power_of_ten(numpy.array([0.1, 123.456]), -9).tolist()
    [1e-10, 1.23456e-07]
    """
    known = values if given is None else values[given]
    is_usual = bool(known.size) and bool(numpy.abs(known).max() < 1e15)
    for decimals in _DECIMALS if is_usual else ():
        down = decimals - exponent
        if abs(down) > 22:
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
            float(f"{mantissa}e{int(power or 0) + exponent}")
            if mantissa.strip("-") not in ("nan", "inf")
            else float(mantissa)
            for mantissa, _, power in (repr(value).partition("e") for value in values.tolist())
        ]
    )
