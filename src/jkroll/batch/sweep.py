"""Sweeps of any length: the rows of lists and ranges, computed in blocks and written as CSV, TSV or Parquet.

The columns are those of a short sweep. A block is a number of rows from a place on, so any process can compute any of them.
"""

from bisect import bisect_right
from collections.abc import Iterator, Mapping, Sequence
from functools import partial
from itertools import accumulate
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
from ..scene.scene import Scene
from . import loop
from .blocks import Block, Tally
from .cells import Floats, Numbers
from .columns import Column
from .delimited import DIALECTS, quoted_cell, written
from .errors import missing_extra
from .formats import Format, compressor, format_of
from .lines import Converted
from .materials import Codes
from .output import is_done
from .rows import Evaluator
from .settings import Settings, fingerprint
from .single import SIDES, Task

if TYPE_CHECKING:
    from ..quantities.uncertain import Uncertain

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
        return (b"%d" % start for start in range(0, prod(self.sizes), ROWS))

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
        follows = "energy" in self.inputs and "energy" not in sweep.spreads  # from its ratio
        names = (*self.results, *["energy"] * follows)
        sides = {side for of_result in sweep.shape.sides.values() for side in of_result}
        kinds = tuple(kind for kind, own in SIDES.items() if not sides.isdisjoint(own))
        self.evaluator = Evaluator(
            Task(columns, (), names, {}, *pair, sweep.known, keeps=True, model=model, kinds=kinds)
        )

    def columns(self, size: int, given: Mapping[str, Numbers]) -> tuple[dict[str, Floats | float], int]:
        """Return the columns of numbers that some rows have, by header, and how many of the rows fail."""
        block = Block(size, given, {}, {}, (), lambda row, name: _typed(name, given[name], row))
        results = self.evaluator.results(block)
        found = dict(zip(self.evaluator.task.headers, results.numbers, strict=True))
        shown = numpy.array([found[header(name)] for name in self.results])
        failed = results.lost.union(row for row in results.status if numpy.isnan(shown[:, row]).all())
        values = {**self.scene.values, **{name: column.values for name, column in given.items()}}
        if "radius" in values:
            values.setdefault("radius2", values["radius"])
        inputs = {header(name): values[name] for name in self.inputs if name in self.used and name in values}
        return {**inputs, **found}, len(failed)


class Rows(NamedTuple):
    """Some rows."""

    cases: Codes  # the place of each row's case
    numbers: Floats  # an array for each column of numbers, nan where there is none
    failed: int

    @property
    def tally(self) -> Tally:
        """The counts of the rows."""
        return Tally(len(self.cases), self.failed)


class Evaluators:
    """Compute the rows of any block."""

    def __init__(self, sweep: Sweep) -> None:
        self.sweep = sweep
        self.cases = [_Case(sweep, pair, model) for pair in sweep.pairs for model in sweep.models]

    def rows(self, block: bytes) -> Rows:
        """Return the rows of a block."""
        sweep, start = self.sweep, int(block)
        rows = numpy.arange(start, min(start + ROWS, prod(sweep.sizes)))
        pairs, *places, laws = numpy.unravel_index(rows, sweep.sizes)
        cases = pairs * len(sweep.models) + laws
        heads = sweep.heads[len(sweep.texts) :]
        numbers = numpy.empty((len(heads), len(rows)))
        failed = 0
        for case in numpy.unique(cases).tolist():
            own = numpy.flatnonzero(cases == case)
            of_inputs = zip(sweep.spreads.items(), places, strict=True)
            given = {name: _values(spreads, at[own]) for (name, spreads), at in of_inputs}
            columns, failures = self.cases[case].columns(len(own), given)
            for column, head in zip(numbers, heads, strict=True):
                column[own] = columns.get(head, numpy.nan)
            failed += failures
        return Rows(cases, numbers, failed)


def _values(spreads: Sequence[Spread], places: Codes) -> Numbers:
    """Return the values at some places of lists and ranges."""
    ends = [*accumulate(map(len, spreads))]
    wanted, back = numpy.unique(places, return_inverse=True)
    found: list[float] = []
    uncertainties: list[Uncertain | None] = []
    for place in wanted.tolist():
        at = bisect_right(ends, place)
        found.append(spreads[at].value(place - ends[at] + len(spreads[at])))
        uncertainties.append(spreads[at].uncertainty)
    uncertain = {row: one for row, place in enumerate(back.tolist()) if (one := uncertainties[place]) is not None}
    return Numbers(numpy.array(found)[back], None, (), uncertain)


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
    form = format_of(settings.target) or Format("csv")
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
        Converted(compressor(form.compression)(head), 1),
        sweep.blocks(),
        partial(_make_convert, sweep, form),
        prod(sweep.sizes),
    )
    settings = settings._replace(quiet=settings.quiet or settings.target == "-")
    return loop.run(work, settings)


def _make_convert(sweep: Sweep, form: Format) -> loop.Convert:
    evaluators, compress = Evaluators(sweep), compressor(form.compression)
    separator = DIALECTS[form.kind].separator
    leads = [
        b"".join(quoted_cell(text.encode(), separator) + separator for text in case.texts) for case in evaluators.cases
    ]

    def convert(block: bytes) -> Converted:
        """Return a block as lines."""
        rows = evaluators.rows(block)
        lines = written(rows.numbers + 0.0, separator, b"\n")
        for place, name in enumerate(sweep.inputs, 1):
            for row in numpy.flatnonzero(numpy.isinf(rows.numbers[place - 1])).tolist():
                cells = lines[row].split(separator)
                cells[place] = (word_for_infinity(name) or "").encode()
                lines[row] = separator.join(cells)
        output = b"".join([leads[case] + line[1:] for case, line in zip(rows.cases.tolist(), lines, strict=True)])
        return Converted(compress(output), len(lines), rows.tally)

    return convert


def _write_parquet(sweep: Sweep, settings: Settings) -> Tally:
    with missing_extra("parquet"):
        import pyarrow

        from . import parquet
    evaluators = Evaluators(sweep)
    texts = [pyarrow.array(column) for column in zip(*(case.texts for case in evaluators.cases), strict=True)]
    kinds = [pyarrow.string()] * len(texts) + [pyarrow.float64()] * (len(sweep.heads) - len(texts))
    schema = pyarrow.schema([*map(pyarrow.field, sweep.heads, kinds)])

    def batch(rows: Rows) -> tuple[Any, Tally]:
        columns = [*(text.take(rows.cases) for text in texts), *map(parquet.as_column, rows.numbers)]
        return pyarrow.RecordBatch.from_arrays(columns, schema=schema), rows.tally

    rows = map(batch, map(evaluators.rows, sweep.blocks()))
    return parquet.write(settings, schema, rows, prod(sweep.sizes), sweep.identity())
