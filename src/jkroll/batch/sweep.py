"""Sweeps of any length: the rows of lists and ranges, computed in blocks and written as CSV, TSV or Parquet.

The columns are those of a short sweep. A block is a number of rows from a place on, so any process can compute any of them.
"""

from collections.abc import Iterator, Sequence
from contextlib import closing
from functools import partial
from itertools import islice
from math import prod
from typing import Any, NamedTuple

import numpy
import orjson

from .. import __version__
from ..answers.answer import answer
from ..errors import BadRequest
from ..materials.library import Material, Materials
from ..output.layout import Layout
from ..quantities.nomenclature import INFINITY, NOMENCLATURE, header, word_for_infinity
from ..quantities.ranges import Spread
from ..scene.scene import DEFAULTS, Scene
from . import loop
from .blocks import Block
from .cells import Floats, Numbers
from .columns import Column
from .delimited import DIALECTS, quoted_cell
from .dialect import Places
from .errors import missing_extra
from .formats import compressor, format_of
from .lines import Converted
from .output import OutputFile, is_done, output_to
from .rows import Evaluator
from .settings import Settings, Tally, fingerprint
from .single import Task

ROWS = 1 << 12  # of a block


class Axis(NamedTuple):
    """The values of an input: lists and ranges behind each other."""

    name: str
    spreads: Sequence[Spread]

    @property
    def size(self) -> int:
        """The number of values."""
        return sum(map(len, self.spreads))

    def values(self, places: Places) -> Floats:
        """Return the values at some places."""
        wanted, back = numpy.unique(places, return_inverse=True)
        return numpy.array([self._value(place) for place in wanted.tolist()])[back]

    def _value(self, place: int) -> float:
        for spread in self.spreads:
            if place < len(spread):
                return spread.value(place)
            place -= len(spread)
        raise IndexError(place)


class Sweep(NamedTuple):
    """All rows of a call: the pairs of materials, the axes that each pair is combined with, and the columns to write."""

    pairs: Sequence[tuple[Material | None, Material | None]]
    axes: Sequence[Axis]
    shape: Layout
    known: Materials

    @property
    def size(self) -> int:
        """The number of rows."""
        return len(self.pairs) * self.rows_of_pair

    @property
    def rows_of_pair(self) -> int:
        """The number of rows of a pair of materials."""
        return prod(axis.size for axis in self.axes)

    def blocks(self) -> Iterator[bytes]:
        """Iterate over blocks, each as where it begins and how many rows it has. No block has rows of two pairs."""
        for first in range(0, self.size, self.rows_of_pair):
            for start in range(first, first + self.rows_of_pair, ROWS):
                yield b"%d %d" % (start, min(ROWS, first + self.rows_of_pair - start))

    @property
    def inputs(self) -> list[str]:
        """The columns of inputs that are numbers."""
        return [name for name in self.shape.inputs if NOMENCLATURE[name].unit]

    @property
    def results(self) -> list[str]:
        """The columns of results."""
        return [name for name in self.shape.columns if name not in self.shape.inputs]

    def identity(self) -> dict[str, str]:
        """Return a hash of each part that the rows depend on."""
        axes = [(axis.name, [list(vars(spread).values()) for spread in axis.spreads]) for axis in self.axes]
        options = [self.shape.columns, axes, [*map(str, self.pairs)]]
        return fingerprint({"version": [__version__, ROWS], "options": options})


class Rows(NamedTuple):
    """Some rows of one pair of materials."""

    materials: list[str]
    inputs: list[Floats | float | None]  # None: the results do not depend on it
    results: Floats
    failed: int
    size: int


class Evaluators:
    """Compute the rows of each pair."""

    def __init__(self, sweep: Sweep) -> None:
        self.sweep = sweep
        names = tuple(name for name in (*sweep.results, *(("energy",) if "energy" in sweep.inputs else ())))
        columns = tuple(Column(place, axis.name, "", None) for place, axis in enumerate(sweep.axes))
        self.evaluators = [
            Evaluator(Task(columns, (), names, {}, *pair, sweep.known, keeps=True)) for pair in sweep.pairs
        ]
        first = {axis.name: axis.spreads[0].low for axis in sweep.axes}
        self.used = [answer(sweep.shape.question, Scene(first, *pair)).inputs.keys() for pair in sweep.pairs]

    def rows(self, block: bytes) -> Rows:
        """Return the rows of a block."""
        start, count = map(int, block.split())
        sweep = self.sweep
        pair, first = divmod(start, sweep.rows_of_pair)
        places = numpy.arange(first, first + count)
        values: dict[str, Floats] = {}
        stride = sweep.rows_of_pair
        for axis in sweep.axes:
            stride //= axis.size
            values[axis.name] = axis.values(places // stride % axis.size)
        numbers = {name: Numbers(column, None, []) for name, column in values.items()}
        results = self.evaluators[pair].results(
            Block(count, numbers, {}, {}, lambda row, name: _typed(name, values[name][row]))
        )
        wanted = results.numbers[: len(sweep.results)]
        failed = len(
            results.lost.union(numpy.flatnonzero(numpy.isnan(wanted).all(axis=0)).tolist()) if results.status else ()
        )
        materials = [one.name for one in sweep.pairs[pair] if one is not None]
        inputs = [self._input(name, values, pair, results.numbers) for name in sweep.inputs]
        return Rows(materials, inputs, wanted, failed, count)

    def _input(self, name: str, values: dict[str, Floats], pair: int, numbers: Floats) -> Floats | float | None:
        """Return a column of an input; None where the results do not depend on it."""
        if name not in self.used[pair]:
            return None
        if name in values:
            return values[name]
        if name == "energy":
            energies: Floats = numbers[-1]
            return energies
        for material, suffix in zip(self.sweep.pairs[pair], ("", "2"), strict=True):
            own = name.removesuffix("2") if suffix else name
            if material is not None and name == own + suffix and own in material.properties:
                return material.properties[own]
        if name == "radius2":
            return values.get("radius")
        return DEFAULTS.get(name)


def _typed(name: str, value: float) -> str:
    """Return a value as it could have been typed."""
    if value == INFINITY:
        return word_for_infinity(name) or "inf"
    unit = NOMENCLATURE[name].unit
    return f"{float(value)!r} {unit}" if unit != "1" else repr(float(value))


def _make_convert(sweep: Sweep, kind: str, compression: str) -> loop.Convert:
    evaluators, compress = Evaluators(sweep), compressor(compression)
    separator = DIALECTS[kind].separator

    def convert(block: bytes) -> Converted:
        """Return a block as lines."""
        rows = evaluators.rows(block)
        lead = b"".join(quoted_cell(name.encode(), separator) + separator for name in rows.materials)
        table = numpy.empty((rows.size, len(rows.inputs) + len(rows.results)))
        for place, column in enumerate([*rows.inputs, *rows.results]):
            table[:, place] = numpy.nan if column is None else column
        text = orjson.dumps(table + 0.0, option=orjson.OPT_SERIALIZE_NUMPY).replace(b"null", b"")
        # [[1,2],[3,4]] becomes the lines 1,2 and 3,4.
        lines = text[2:-2].replace(b",", separator).split(b"]" + separator + b"[")
        for place, name in enumerate(sweep.inputs):
            for row in numpy.flatnonzero(numpy.isinf(table[:, place])).tolist():
                cells = lines[row].split(separator)
                cells[place] = (word_for_infinity(name) or "").encode()
                lines[row] = separator.join(cells)
        output = b"".join([lead + line + b"\n" for line in lines])
        return Converted(compress(output), rows.size, rows.failed, rows.size, None)

    return convert


def stream(sweep: Sweep, settings: Settings) -> Tally:
    """Write all rows of a sweep."""
    form = format_of(settings.target)
    if is_done(settings):
        return Tally(0, 0)
    if form is not None and form.kind == "parquet":
        return _write_parquet(sweep, settings)
    kind, compression = form or ("csv", "")
    if kind not in DIALECTS:
        raise BadRequest(f"-o: a sweep is written as csv, tsv or parquet, not as {kind}")
    head = DIALECTS[kind].separator.join(header(name).encode() for name in sweep.shape.columns) + b"\n"
    work = loop.Work(
        sweep.identity(),
        b"",
        Converted(compressor(compression)(head), 0, 0, 1, None),
        sweep.blocks(),
        partial(_make_convert, sweep, kind, compression),
        sweep.size,
    )
    is_piped = settings.target == "-"
    settings = settings._replace(quiet=settings.quiet or is_piped)
    with closing(output_to(settings) if is_piped else OutputFile(settings.target)) as output:
        loop.run(work, output, settings)
        output.finish()
    return output.tally


def _write_parquet(sweep: Sweep, settings: Settings) -> Tally:
    with missing_extra("parquet"):
        import pyarrow

        from . import parquet
    materials = [pyarrow.field(name, pyarrow.string()) for name in sweep.shape.inputs if not NOMENCLATURE[name].unit]
    numbers = [pyarrow.field(header(name), pyarrow.float64()) for name in (*sweep.inputs, *sweep.results)]
    schema = pyarrow.schema([*materials, *numbers])
    evaluators = Evaluators(sweep)

    def batch(rows: Rows) -> Any:
        columns = [numpy.broadcast_to(numpy.nan if one is None else one, rows.size) for one in rows.inputs]
        arrays = [parquet.as_column(numpy.ascontiguousarray(values)) for values in (*columns, *rows.results)]
        names = [pyarrow.repeat(name, rows.size) for name in rows.materials]
        return pyarrow.RecordBatch.from_arrays([*names, *arrays], schema=schema)

    def tables() -> Iterator[parquet.Rows]:
        blocks = sweep.blocks()
        while some := [evaluators.rows(block) for block in islice(blocks, together)]:
            table = pyarrow.Table.from_batches(map(batch, some), schema).combine_chunks()
            yield parquet.Rows(table, sum(rows.failed for rows in some))

    together = max(parquet.rows_together(8 * len(schema)) // ROWS, 1)
    return parquet.write(settings, schema, tables(), sweep.size, sweep.identity())
