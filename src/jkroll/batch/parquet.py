"""Parquet to Parquet: the columns of a file with the results beside them, a number of rows at a time.

A thread reads and computes while another one writes, so `--jobs` changes nothing.
"""

from collections.abc import Iterable, Iterator, Mapping
from concurrent.futures import ThreadPoolExecutor
from contextlib import closing, contextmanager
from typing import Any

import numpy
import pyarrow
import pyarrow.parquet

from ..errors import BadRequest, BadTable
from ..output.records import middles, names_of_columns, shown_results
from ..quantities.formatting import Format
from ..quantities.nomenclature import INFINITY, NOMENCLATURE
from ..rows.block import Block
from ..rows.cells import Floats, Numbers, Reader
from ..rows.columns import BLOCK, DOUBT, STATUS, Columns, Wanted, remarks_of
from ..rows.header import is_input
from ..rows.readings import Reading
from ..rows.table import TableBlock
from ..scene.limits import codes
from ..text import quoted, shown
from .files import Input, output_to
from .job import Job, said_of
from .lines import SAMPLE, Tally, computed
from .progress import Bar

BUFFER = 1 << 18  # bytes read at a time of each column
BYTES = 1 << 24  # of the rows written together, and at most of those computed together, about

Batch = tuple[Any, Tally]  # a batch of Arrow with results, and its counts


def convert_parquet(path: str, job: Job) -> Tally:
    """Convert a Parquet file."""
    target = job.settings.target
    if "-" in (path, target):
        raise BadRequest("Parquet is read from a file and written to a file: -o FILE")
    with closing(Input(path)) as given:
        given.check_output(target)
        with _readable(path):
            table = _File(given, job)
        with Bar(table.size, quiet=job.settings.quiet) as bar:
            tally = _write(target, table.schema, table.batches(), bar)
    return tally._replace(said=said_of(table.table))


@contextmanager
def _readable(path: str) -> Iterator[None]:
    """Raise BadTable for what cannot be read."""
    try:
        yield
    except (OSError, UnicodeDecodeError, pyarrow.ArrowException) as error:
        reason = shown(str(error).strip().partition("\n")[0])
        raise BadTable(f"{quoted(path)} cannot be read as Parquet: {reason}") from None


class _File:
    """A Parquet file whose rows are computed."""

    def __init__(self, given: Input, job: Job) -> None:
        self.given, self.strict = given, job.settings.strict
        self.file = file = pyarrow.parquet.ParquetFile(given.file, buffer_size=BUFFER, pre_buffer=False)
        names = tuple(file.schema_arrow.names)
        if not names:
            raise BadTable("the table has no columns")
        self.table = table = job.table(names, _first_rows(file, job.meanings(names)))
        texts = {*table.said, *table.remarks}
        fields = [pyarrow.field(name, pyarrow.string() if name in texts else pyarrow.float64()) for name in table.added]
        self.schema = pyarrow.schema([*file.schema_arrow, *fields], metadata=file.schema_arrow.metadata)
        groups = [file.metadata.row_group(place) for place in range(file.metadata.num_row_groups)]
        self.size, self.line = file.metadata.num_rows, 0
        width = max((group.total_byte_size / max(group.num_rows, 1) for group in groups), default=0) + 8 * len(fields)
        self.together = max(min(BLOCK, int(BYTES / width)), 1)

    def batches(self) -> Iterator[Batch]:
        """Iterate over the rows with their results. Raises BadTable if the file was changed meanwhile."""
        with _readable(self.given.path):
            for batch in self.file.iter_batches(self.together):
                yield self._with_results(batch)
                self.line += batch.num_rows
        self.given.check_unchanged()

    def _with_results(self, batch: Any) -> Batch:
        size = batch.num_rows
        places = range(self.line + 1, self.line + size + 1)
        columns, tally = computed(self.table.wanted, self._block(batch), places, strict=self.strict)
        arrays = [
            *batch.columns,
            *(pyarrow.repeat(text, size) for text in self.table.said.values()),
            *_results(columns, Format(), self.table.remarks),
        ]
        return pyarrow.RecordBatch.from_arrays(arrays, schema=self.schema), tally

    def _block(self, batch: Any) -> Block:
        """Return the inputs of some rows."""
        table, places = self.table, self.table.places
        materials = {}
        for name, place in table.materials_at:  # a text is looked up once, not in every row
            encoded = batch.column(place).dictionary_encode()
            texts = [*map(_text, encoded.dictionary.to_pylist()), ""]
            rows = encoded.indices.cast(pyarrow.int64()).fill_null(len(texts) - 1)
            materials[name] = table.lookups[name].indices(texts)[rows.to_numpy()]
        numbers = {reader.column.name: _numbers(batch, reader) for reader in table.readers}
        return TableBlock(
            table,
            batch.num_rows,
            numbers,
            materials,
            {},
            lambda row, name: _text(batch.column(places[name])[row].as_py(), name),
        )


def write_columns(wanted: Wanted, blocks: Iterable[Columns], units: Format, target: str, *, doubt: bool) -> None:
    """Write columns, in a file that gets its name when it is whole."""
    remarks = remarks_of(wanted, doubt=doubt)
    texts = {name for name in wanted.inputs if NOMENCLATURE[name].is_word} | {*remarks}
    kinds = {name: pyarrow.string() if name in texts else pyarrow.float64() for name in (*wanted.inputs, *wanted.keys)}
    heads = [*names_of_columns(wanted, units), *remarks]
    schema = pyarrow.schema([*map(pyarrow.field, heads, [*kinds.values(), *[pyarrow.string()] * len(remarks)])])

    def batch(columns: Columns) -> Batch:
        arrays = [
            *(pyarrow.array(middles(columns.inputs[name]), kinds[name], from_pandas=True) for name in wanted.inputs),
            *_results(columns, units, remarks),
        ]
        return pyarrow.RecordBatch.from_arrays(arrays, schema=schema), Tally(len(columns))

    with Bar(0, quiet=True) as bar:
        _write(target, schema, map(batch, blocks), bar)


def _results(columns: Columns, units: Format, remarks: Iterable[str]) -> Iterator[Any]:
    """Iterate over the columns of results and of remarks."""
    for column in shown_results(columns, units):
        yield as_column(numpy.asarray(column, dtype=float))
    of_rows: Mapping[str, Any] = {
        DOUBT: lambda row: codes(int(columns.doubts[row])) or None,
        STATUS: columns.status.get,
    }
    for name in remarks:
        yield pyarrow.array(map(of_rows[name], range(len(columns))), "string")


def _write(target: str, schema: Any, batches: Iterator[Batch], bar: Bar) -> Tally:
    """Write a file that gets its name when it is whole, in groups of rows of about the same size."""
    texts = [field.name for field in schema if not pyarrow.types.is_floating(field.type)]  # numbers seldom repeat
    tally = Tally()
    with output_to(target) as stream, pyarrow.parquet.ParquetWriter(stream, schema, use_dictionary=texts) as writer:
        for group in _ahead(_groups(batches)):
            table = pyarrow.Table.from_batches([batch for batch, _ in group])
            writer.write_table(table, table.num_rows)
            for _, own in group:
                tally = tally.plus(own)
            bar.show(tally.rows, tally.rows)
    return tally


def _groups(batches: Iterator[Batch]) -> Iterator[list[Batch]]:
    """Iterate over rows that are written together."""
    group: list[Batch] = []
    size = 0
    for batch in batches:
        group.append(batch)
        size += batch[0].nbytes
        if size >= BYTES:
            yield group
            group, size = [], 0
    if group:
        yield group


def _ahead(groups: Iterator[list[Batch]]) -> Iterator[list[Batch]]:
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


def _first_rows(file: Any, meanings: Mapping[str, Reading]) -> list[list[str]]:
    """Return the cells of inputs in the first rows as texts. Raises BadTable for an input of another type."""
    schema = file.schema_arrow
    inputs = [field for field in schema if is_input(field.name, meanings)]
    for field in inputs:
        if not _is_cell(field.type):
            raise BadTable(f"header: column {field.name} holds {field.type}: neither numbers nor texts")
    first = next(file.iter_batches(SAMPLE, columns=[field.name for field in inputs], use_threads=False), None)
    rows = first.to_pylist() if first is not None else []
    return [[_text(row.get(name)) for name in schema.names] for row in rows]


def _is_cell(kind: Any) -> bool:
    """Return whether a column of a type can be an input: numbers, or texts."""
    types = pyarrow.types
    if types.is_dictionary(kind):
        return _is_cell(kind.value_type)
    return not (types.is_nested(kind) or types.is_temporal(kind) or isinstance(kind, pyarrow.BaseExtensionType))


def _text(value: object, name: str = "") -> str:
    """Return a value as a cell of text: an infinite input is a word, null an empty cell."""
    if isinstance(value, bytes):
        return value.decode(errors="replace")
    if value == INFINITY and name in NOMENCLATURE:
        return NOMENCLATURE[name].infinity or str(value)
    return "" if value is None else str(value)


def _numbers(batch: Any, reader: Reader) -> Numbers:
    """Return the SI values of an input: numbers in its unit, or texts as in CSV."""
    column = reader.column
    array, unit = batch.column(column.place), column.unit
    is_text = not (pyarrow.types.is_floating(array.type) or pyarrow.types.is_integer(array.type))
    if is_text or column.sides or (unit is None and column.exponent is None):
        places = column.places.items()
        return reader.numbers(
            {name: [_text(cell).encode() for cell in batch.column(at).to_pylist()] for name, at in places}
        )
    given = values = array.to_numpy(zero_copy_only=False).astype(float, copy=False)
    if unit is not None:
        with numpy.errstate(over="ignore"):
            values = given * float(unit.numerator) / float(unit.denominator)
    is_bad = numpy.isinf(values) & ~numpy.isinf(given)
    if array.null_count < (count := numpy.count_nonzero(numpy.isnan(given))) and count:
        is_bad |= numpy.isnan(given) & array.is_valid().to_numpy(
            zero_copy_only=False
        )  # a number that is none is no empty cell
    return Numbers(values, numpy.flatnonzero(is_bad).tolist())
