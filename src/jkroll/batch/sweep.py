"""Sweeps of any length: the rows of lists and ranges, computed in blocks and written as CSV, TSV or Parquet.

The columns are those of a short sweep. A block is a number of rows from a place on, so any process can compute any of them.
"""

from collections.abc import Iterator, Mapping, Sequence
from functools import partial
from itertools import cycle, islice
from math import prod
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy

from .. import __version__
from ..answers.answer import answer
from ..errors import BadRequest
from ..materials.library import Material, Materials
from ..output.layout import Layout
from ..quantities.formatting import AS_USUAL
from ..quantities.nomenclature import INFINITY, NOMENCLATURE, header, word_for_infinity
from ..quantities.ranges import Spread
from ..scene.scene import DEFAULTS, Scene
from . import loop
from .blocks import Block, Tally
from .cells import Floats, Numbers
from .columns import Column
from .delimited import DIALECTS, quoted_cell, written
from .dialect import Places
from .errors import missing_extra
from .formats import compressor, format_of
from .lines import Converted
from .output import is_done
from .rows import Evaluator
from .settings import Settings, fingerprint
from .task import SIDES, Task

if TYPE_CHECKING:
    from ..quantities.uncertain import Uncertain

ROWS = 1 << 12  # of a block


class Axis(NamedTuple):
    """The values of an input: lists and ranges behind each other."""

    name: str
    spreads: Sequence[Spread]

    @property
    def size(self) -> int:
        """The number of values."""
        return sum(map(len, self.spreads))

    def numbers(self, places: Places) -> Numbers:
        """Return the values at some places, as a column."""
        wanted, back = numpy.unique(places, return_inverse=True)
        found = [self._at(place) for place in wanted.tolist()]
        uncertain = {row: one for row, place in enumerate(back.tolist()) if (one := found[place][1]) is not None}
        return Numbers(numpy.array([value for value, _ in found])[back], (), uncertain)

    def _at(self, place: int) -> "tuple[float, Uncertain | None]":
        for spread in self.spreads:
            if place < len(spread):
                return spread.value(place), spread.uncertainty
            place -= len(spread)
        raise IndexError(place)


class Sweep(NamedTuple):
    """All rows of a call: the pairs of materials, the axes and the laws that each pair is combined with, and the columns."""

    pairs: Sequence[tuple[Material | None, Material | None]]
    axes: Sequence[Axis]
    models: Sequence[str | None]
    shape: Layout
    known: Materials

    @property
    def size(self) -> int:
        """The number of rows."""
        return len(self.pairs) * self.rows_of_pair

    @property
    def rows_of_pair(self) -> int:
        """The number of rows of a pair of materials."""
        return prod(axis.size for axis in self.axes) * len(self.models)

    def blocks(self) -> Iterator[bytes]:
        """Iterate over blocks, each as where it begins and how many rows it has. No block has rows of two pairs."""
        for first in range(0, self.size, self.rows_of_pair):
            for start in range(first, first + self.rows_of_pair, ROWS):
                yield b"%d %d" % (start, min(ROWS, first + self.rows_of_pair - start))

    @property
    def texts(self) -> list[str]:
        """The columns of inputs that are texts: materials and laws. They are the first ones."""
        return [name for name in self.shape.inputs if not NOMENCLATURE[name].unit]

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
        options = [self.shape.headers(AS_USUAL), axes, [*map(str, self.pairs)], self.models]
        return fingerprint({"version": [__version__, ROWS], "options": options})


class Rows(NamedTuple):
    """Some rows of one pair of materials."""

    texts: Sequence[Sequence[str]]  # of the first rows, one for each law; those of the others follow in turns
    numbers: Floats  # an array for each column of numbers, nan where there is none
    failed: int

    @property
    def size(self) -> int:
        """The number of rows."""
        return self.numbers.shape[1]


class Evaluators:
    """Compute the rows of each pair of materials and each law."""

    def __init__(self, sweep: Sweep) -> None:
        self.sweep = sweep
        names = (*sweep.results, *(name for name in sweep.inputs if name == "energy"))
        columns = tuple(Column(place, axis.name, "", None) for place, axis in enumerate(sweep.axes))
        used = {side for of_result in sweep.shape.sides.values() for side in of_result}
        sides = tuple(side for side in SIDES if side in used)
        self.evaluators = {
            (pair, law): Evaluator(
                Task(columns, (), names, {}, materials, sweep.known, keeps=True, model=model, sides=sides)
            )
            for pair, materials in enumerate(sweep.pairs)
            for law, model in enumerate(sweep.models)
        }
        first = {axis.name: axis.spreads[0].low for axis in sweep.axes}
        self.used = {
            (pair, law): answer(sweep.shape.question, Scene(first, *sweep.pairs[pair], model=sweep.models[law])).inputs
            for pair, law in self.evaluators
        }

    def rows(self, block: bytes) -> Rows:
        """Return the rows of a block."""
        start, count = map(int, block.split())
        sweep = self.sweep
        pair, first = divmod(start, sweep.rows_of_pair)
        places = numpy.arange(first, first + count)
        table = numpy.empty((len(sweep.shape.headers(AS_USUAL)) - len(sweep.texts), count))
        failed = 0
        laws = [(first + row) % len(sweep.models) for row in range(len(sweep.models))]
        for row, law in enumerate(laws):
            own = slice(row, None, len(laws))
            failed += self._fill(table[:, own], (pair, law), places[own] // len(laws))
        texts = [[str(self.used[pair, law][name]) for name in sweep.texts] for law in laws]
        return Rows(texts, table, failed)

    def _fill(self, table: Floats, place: tuple[int, int], places: Places) -> int:
        """Fill in the columns of the rows at some places of a pair of materials and a law; return how many rows fail."""
        sweep, evaluator = self.sweep, self.evaluators[place]
        given: dict[str, Numbers] = {}
        stride = sweep.rows_of_pair // len(sweep.models)
        for axis in sweep.axes:
            stride //= axis.size
            given[axis.name] = axis.numbers(places // stride % axis.size)
        results = evaluator.results(
            Block(len(places), given, {}, {}, (), lambda row, name: _typed(name, given[name], row))
        )
        found = dict(zip(evaluator.task.headers, results.numbers, strict=True))
        columns = [self._input(name, given, place, found) for name in sweep.inputs]
        columns += [found[head] for head in sweep.shape.headers(AS_USUAL)[len(sweep.shape.inputs) :]]
        for row, column in enumerate(columns):
            table[row] = column
        without = numpy.isnan([found[header(name)] for name in sweep.results]).all(axis=0)
        return len(results.lost.union(numpy.flatnonzero(without).tolist())) if results.status else 0

    def _input(
        self, name: str, given: Mapping[str, Numbers], place: tuple[int, int], found: Mapping[str, Floats]
    ) -> Floats | float:
        """Return a column of an input; nan where the results do not depend on it."""
        if name not in self.used[place]:
            return numpy.nan
        if name in given:
            return given[name].values
        if name == "energy":
            return found[header(name)]
        for material, suffix in zip(self.sweep.pairs[place[0]], ("", "2"), strict=True):
            own = name.removesuffix("2") if suffix else name
            if material is not None and name == own + suffix and own in material.properties:
                return material.properties[own]
        if name == "radius2" and "radius" in given:
            return given["radius"].values
        return DEFAULTS.get(name, numpy.nan)


def _typed(name: str, column: Numbers, row: int) -> str:
    """Return a value as it could have been typed."""
    value, found = float(column.values[row]), column.uncertain.get(row)
    if value == INFINITY:
        return word_for_infinity(name) or "inf"
    text = repr(value)
    if found is not None:
        text = (
            f"{value!r} +{found.plus!r}/-{found.minus!r}"
            if found.kind == "standard"
            else f"{found.low!r} to {found.high!r}"
        )
    return f"{text} {NOMENCLATURE[name].unit}".removesuffix(" 1")


def _make_convert(sweep: Sweep, kind: str, compression: str) -> loop.Convert:
    evaluators, compress = Evaluators(sweep), compressor(compression)
    separator = DIALECTS[kind].separator

    def convert(block: bytes) -> Converted:
        """Return a block as lines."""
        rows = evaluators.rows(block)
        leads = [separator.join(quoted_cell(text.encode(), separator) for text in texts) for texts in rows.texts]
        lines = written(rows.numbers + 0.0, separator, b"\n")
        for place, name in enumerate(sweep.inputs):
            for row in numpy.flatnonzero(numpy.isinf(rows.numbers[place])).tolist():
                cells = lines[row].split(separator)
                cells[1 + place] = (word_for_infinity(name) or "").encode()
                lines[row] = separator.join(cells)
        if not any(leads):
            lines = [line.removeprefix(separator) for line in lines]
        output = b"".join([lead + line for lead, line in zip(cycle(leads), lines)])
        return Converted(compress(output), rows.size, Tally(rows.size, rows.failed))

    return convert


def stream(sweep: Sweep, settings: Settings) -> Tally:
    """Write all rows of a sweep."""
    form = format_of(settings.target)
    if is_done(settings):
        return Tally()
    if form is not None and form.kind == "parquet":
        return _write_parquet(sweep, settings)
    kind, compression = form or ("csv", "")
    if kind not in DIALECTS:
        raise BadRequest(f"-o: a sweep is written as csv, tsv or parquet, not as {kind}")
    head = DIALECTS[kind].separator.join(name.encode() for name in sweep.shape.headers(AS_USUAL)) + b"\n"
    work = loop.Work(
        sweep.identity(),
        b"",
        Converted(compressor(compression)(head), 1),
        sweep.blocks(),
        partial(_make_convert, sweep, kind, compression),
        sweep.size,
    )
    settings = settings._replace(quiet=settings.quiet or settings.target == "-")
    return loop.run(work, settings)


def _write_parquet(sweep: Sweep, settings: Settings) -> Tally:
    with missing_extra("parquet"):
        import pyarrow

        from . import parquet
    heads = sweep.shape.headers(AS_USUAL)
    kinds = [pyarrow.string()] * len(sweep.texts) + [pyarrow.float64()] * (len(heads) - len(sweep.texts))
    schema = pyarrow.schema([*map(pyarrow.field, heads, kinds)])
    evaluators = Evaluators(sweep)

    def batch(rows: Rows) -> Any:
        texts = [pyarrow.array([*islice(cycle(column), rows.size)]) for column in zip(*rows.texts, strict=True)]
        return pyarrow.RecordBatch.from_arrays([*texts, *map(parquet.as_column, rows.numbers)], schema=schema)

    def tables() -> Iterator[tuple[Any, Tally]]:
        blocks = sweep.blocks()
        while some := [evaluators.rows(block) for block in islice(blocks, together)]:
            table = pyarrow.Table.from_batches(map(batch, some), schema).combine_chunks()
            yield table, Tally(table.num_rows, sum(rows.failed for rows in some))

    together = max(parquet.rows_together(8 * len(schema)) // ROWS, 1)
    return parquet.write(settings, schema, tables(), sweep.size, sweep.identity())
