"""Sweeps of any length: the rows of lists and ranges, computed in blocks and written as CSV, TSV or Parquet.

The columns are those of a short sweep. A block is a number of rows from a place on, so any process can compute any of them.
"""

from collections.abc import Iterator, Mapping, Sequence
from functools import partial
from itertools import count
from math import prod
from typing import Any, NamedTuple

import numpy

from .. import __version__
from ..answers.answer import answer
from ..errors import BadRequest
from ..materials.library import Material, Materials
from ..output.layout import Layout
from ..quantities.formatting import AS_USUAL
from ..quantities.nomenclature import INFINITY, NOMENCLATURE, header, word_for_infinity
from ..quantities.ranges import Spread
from ..scene.scene import Scene
from ..table.blocks import Block, Tally
from ..table.cells import Floats, Numbers
from ..table.columns import Column
from ..table.evaluator import Evaluator
from ..table.materials import Codes
from ..table.task import SIDES, Task
from . import loop
from .delimited import DIALECTS, written
from .errors import missing_extra
from .formats import Format, compressor, format_of
from .lines import Converted
from .output import is_done
from .settings import Settings, fingerprint, unnamed

ROWS = 1 << 12  # of a block


class Sweep(NamedTuple):
    """All rows of a call: each pair of materials with all values of its inputs, and these with each law."""

    pairs: Sequence[tuple[Material | None, Material | None]]
    spreads: Mapping[str, Sequence[Spread]]  # the lists and ranges of each input
    models: Sequence[str | None]
    shape: Layout
    known: Materials

    @property
    def sizes(self) -> list[int]:
        """The numbers of pairs, of the values of each input, and of laws; the rows are their combinations."""
        return [len(self.pairs), *(sum(map(len, spreads)) for spreads in self.spreads.values()), len(self.models)]

    @property
    def size(self) -> int:
        """The number of rows."""
        return prod(self.sizes)

    @property
    def heads(self) -> list[str]:
        """The headers of the columns: texts, inputs that are numbers, results."""
        return self.shape.headers(AS_USUAL)

    @property
    def texts(self) -> list[str]:
        """The columns of inputs that are texts: materials and laws."""
        return [name for name in self.shape.inputs if not NOMENCLATURE[name].unit]

    @property
    def inputs(self) -> list[str]:
        """The columns of inputs that are numbers."""
        return [name for name in self.shape.inputs if NOMENCLATURE[name].unit]

    def blocks(self) -> Iterator[bytes]:
        """Iterate over blocks, each as the place of its first row."""
        return (b"%d" % start for start in range(0, self.size, ROWS))

    def cases(self) -> "list[_Case]":
        """Return each pair of materials under each law, in the order of the rows."""
        return [_Case(self, pair, model) for pair in self.pairs for model in self.models]

    def identity(self) -> dict[str, str]:
        """Return a hash of each part that the rows depend on."""
        spreads = [(name, [list(vars(spread).values()) for spread in some]) for name, some in self.spreads.items()]
        options = [self.heads, spreads, [*map(str, self.pairs)], self.models]
        return fingerprint({"version": [__version__, ROWS], "options": options})


class _Case:
    """A pair of materials under a law, whose rows differ by numbers alone."""

    def __init__(self, sweep: Sweep, pair: tuple[Material | None, Material | None], model: str | None) -> None:
        self.inputs = sweep.inputs
        self.results = [name for name in sweep.shape.columns if name not in sweep.shape.inputs]
        first = {name: spreads[0].low for name, spreads in sweep.spreads.items()}
        self.scene = Scene(first, *pair, model=model)
        self.used = answer(sweep.shape.question, self.scene).inputs
        self.texts = [str(self.used[name]) for name in sweep.texts]
        columns = tuple(Column(place, name, "", None) for place, name in enumerate(sweep.spreads))
        follows = [name for name in self.inputs if name == "energy" and name not in sweep.spreads]  # from its ratio
        used = {side for of_result in sweep.shape.sides.values() for side in of_result}
        sides = tuple(side for side in SIDES if side in used)
        self.evaluator = Evaluator(
            Task(columns, (), (*self.results, *follows), {}, pair, sweep.known, keeps=True, model=model, sides=sides)
        )

    def columns(self, size: int, given: Mapping[str, Numbers]) -> tuple[dict[str, Floats | float], int]:
        """Return the columns of numbers that some rows have, by header, and how many of the rows fail."""
        block = Block(size, given, {}, {}, (), lambda row, name: _typed(name, given[name], row))
        results = self.evaluator.results(block)
        found = dict(zip(self.evaluator.task.headers, results.numbers, strict=True))
        without: Any = numpy.isnan([found[header(name)] for name in self.results]).all(axis=0)
        failed = results.lost.union(row for row in results.status if without[row])
        values = {**self.scene.values, **{name: column.values for name, column in given.items()}}
        if "radius" in values:
            values.setdefault("radius2", values["radius"])  # as the scene assumes
        inputs = {header(name): values[name] for name in self.inputs if name in self.used and name in values}
        return {**inputs, **found}, len(failed)


def _rows(sweep: Sweep, cases: Sequence[_Case], block: bytes) -> tuple[Codes, Floats, Tally]:
    """Return the rows of a block: the places of their cases, an array for each column of numbers, and their counts."""
    rows = numpy.arange(int(block), min(int(block) + ROWS, sweep.size))
    pairs, *places, laws = numpy.unravel_index(rows, sweep.sizes)
    of_cases = pairs * len(sweep.models) + laws
    heads = sweep.heads[len(sweep.texts) :]
    numbers = numpy.empty((len(heads), len(rows)))
    failed = 0
    for place in numpy.unique(of_cases).tolist():
        own = numpy.flatnonzero(of_cases == place)
        of_inputs = zip(sweep.spreads.items(), places, strict=True)
        given = {name: _values(spreads, at[own]) for (name, spreads), at in of_inputs}
        columns, failures = cases[place].columns(len(own), given)
        for column, head in zip(numbers, heads, strict=True):
            column[own] = columns.get(head, numpy.nan)
        failed += failures
    return of_cases, numbers, Tally(len(rows), failed)


def _values(spreads: Sequence[Spread], places: Codes) -> Numbers:
    """Return the values at some places of lists and ranges behind each other."""
    starts = numpy.cumsum([0, *map(len, spreads)])
    wanted, back = numpy.unique(places, return_inverse=True)
    of_spreads = numpy.searchsorted(starts, wanted, side="right") - 1
    within = wanted - starts[of_spreads]
    values = [spreads[one].value(place) for one, place in zip(of_spreads.tolist(), within.tolist(), strict=True)]
    uncertain = {
        row: spread.uncertainty
        for place, spread in enumerate(spreads)
        if spread.uncertainty is not None
        for row in numpy.flatnonzero(of_spreads[back] == place).tolist()
    }
    return Numbers(numpy.array(values)[back], (), uncertain)


def _typed(name: str, column: Numbers, row: int) -> str:
    """Return a value as it could have been typed."""
    value, found = float(column.values[row]), column.uncertain.get(row)
    if value == INFINITY:
        return word_for_infinity(name) or "inf"
    if found is None:
        text = repr(value)
    elif found.kind == "standard":
        text = f"{value!r} +{found.plus!r}/-{found.minus!r}"
    else:
        text = f"{found.low!r} to {found.high!r}"
    return f"{text} {NOMENCLATURE[name].unit}".removesuffix(" 1")


def stream(sweep: Sweep, settings: Settings) -> Tally:
    """Write all rows of a sweep."""
    form = format_of(settings.target) or unnamed(settings, "csv")
    if is_done(settings):
        return Tally()
    if form.kind == "parquet":
        return _write_parquet(sweep, settings)
    if form.kind not in DIALECTS:
        raise BadRequest(f"-o: a sweep is written as csv, tsv or parquet, not as {form.kind}")
    head = DIALECTS[form.kind].separator.join(map(str.encode, sweep.heads)) + b"\n"
    work = loop.Work(
        sweep.identity(),
        b"",
        Converted(compressor(form.compression)(head)),
        sweep.blocks(),
        partial(_make_convert, sweep, form),
        sweep.size,
    )
    settings = settings._replace(quiet=settings.quiet or settings.target == "-")
    return loop.run(work, settings)


def _make_convert(sweep: Sweep, form: Format) -> loop.Convert:
    cases, compress = sweep.cases(), compressor(form.compression)
    dialect = DIALECTS[form.kind]
    separator = dialect.separator
    leads = [b"".join(dialect.joined([text.encode()]) + separator for text in case.texts) for case in cases]

    def convert(block: bytes) -> Converted:
        """Return a block as lines."""
        places, numbers, tally = _rows(sweep, cases, block)
        lines = written(numbers + 0.0, separator, b"\n")
        for name, column, cell in zip(sweep.inputs, numbers, count(1)):
            for row in numpy.flatnonzero(numpy.isinf(column)).tolist():
                cells = lines[row].split(separator)
                cells[cell] = (word_for_infinity(name) or "").encode()
                lines[row] = separator.join(cells)
        output = b"".join([leads[place] + line[1:] for place, line in zip(places.tolist(), lines, strict=True)])
        return Converted(compress(output), tally)

    return convert


def _write_parquet(sweep: Sweep, settings: Settings) -> Tally:
    with missing_extra("parquet"):
        import pyarrow

        from . import parquet
    cases = sweep.cases()
    texts = [pyarrow.array(column) for column in zip(*(case.texts for case in cases), strict=True)]
    kinds = [pyarrow.string()] * len(texts) + [pyarrow.float64()] * (len(sweep.heads) - len(texts))
    schema = pyarrow.schema([*map(pyarrow.field, sweep.heads, kinds)])

    def batch(block: bytes) -> tuple[Any, Tally]:
        places, numbers, tally = _rows(sweep, cases, block)
        columns = [*(text.take(places) for text in texts), *map(parquet.as_column, numbers)]
        return pyarrow.RecordBatch.from_arrays(columns, schema=schema), tally

    return parquet.write(settings, schema, map(batch, sweep.blocks()), sweep.size, sweep.identity())
