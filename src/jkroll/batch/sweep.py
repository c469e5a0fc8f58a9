"""Sweeps of any length: the rows of lists and ranges, computed in blocks and streamed to CSV or Parquet.

The columns are those of a short sweep. A block is a number of rows from a place on, so any process can make any of them.
"""

import os
import sys
from collections.abc import Sequence
from contextlib import closing
from math import prod
from typing import NamedTuple

import numpy
import orjson

from .. import __version__
from ..answers.answer import answer
from ..errors import BadRequest
from ..materials.library import Material, Materials
from ..output.layout import Layout
from ..quantities.nomenclature import INFINITY, NOMENCLATURE, header, word_for_infinity
from ..scene.scene import DEFAULTS, Scene
from . import ring
from .axes import Axis
from .cells import Floats, Numbers
from .columns import Column
from .delimited import DIALECTS, quoted_cell
from .errors import missing_extra
from .files import check_file
from .formats import compressor, format_of
from .lines import Converted
from .output import FileSink, Sink, fingerprint
from .progress import watched
from .rows import Block, Evaluator
from .settings import Settings, Tally
from .single import Task
from .source import Shared

ROWS = 1 << 12  # of a block


class Sweep(NamedTuple):
    """All rows of a call: what every pair of materials is combined with, and the columns to write."""

    pairs: Sequence[tuple[Material | None, Material | None]]
    axes: Sequence[Axis]
    shape: Layout
    known: Materials

    @property
    def size(self) -> int:
        """All rows."""
        return len(self.pairs) * self.rows_of_pair

    @property
    def rows_of_pair(self) -> int:
        """Rows of one pair of materials."""
        return prod(axis.size for axis in self.axes)

    def block(self, start: int) -> int:
        """How many rows the block has that begins at a place; none has rows of two pairs."""
        return min(ROWS, self.rows_of_pair - start % self.rows_of_pair)

    @property
    def inputs(self) -> list[str]:
        """The columns of inputs that are numbers."""
        return [name for name in self.shape.inputs if NOMENCLATURE[name].unit]

    @property
    def results(self) -> list[str]:
        """The columns of results."""
        return [name for name in self.shape.columns if name not in self.shape.inputs]

    def identity(self, *version: object) -> dict[str, str]:
        """What tells this sweep from any other, and how it is written."""
        axes = [(axis.name, [list(vars(spread).values()) for spread in axis.spreads]) for axis in self.axes]
        options = [self.shape.columns, axes, [*map(str, self.pairs)]]
        return fingerprint({"version": [__version__, ROWS, *version], "options": options})


class Rows(NamedTuple):
    """Some rows of one pair of materials."""

    materials: list[str]
    inputs: list[Floats | float | None]  # None: not said of these
    results: Floats
    failed: int
    size: int


class Evaluators:
    """What computes the rows of each pair."""

    def __init__(self, sweep: Sweep) -> None:
        self.sweep = sweep
        self.names = tuple(name for name in (*sweep.results, *(("energy",) if "energy" in sweep.inputs else ())))
        columns = tuple(Column(place, axis.name, "", None) for place, axis in enumerate(sweep.axes))
        self.evaluators = [
            Evaluator(Task(columns, (), self.names, {}, *pair, sweep.known, keeps=True)) for pair in sweep.pairs
        ]

        first = {axis.name: axis.spreads[0].low for axis in sweep.axes}
        self.said = [answer(sweep.shape.question, Scene(first, *pair)).inputs.keys() for pair in sweep.pairs]

    def rows(self, start: int, count: int) -> Rows:
        """The rows from a place on, which are of one pair."""
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
        """A column of an input as it was understood; None where the results do not depend on it."""
        if name not in self.said[pair]:
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
    """A value as it could have been typed."""
    if value == INFINITY:
        return word_for_infinity(name) or "inf"
    unit = NOMENCLATURE[name].unit
    return f"{float(value)!r} {unit}" if unit != "1" else repr(float(value))


class Places:
    """A source of blocks that are nothing but where they begin, and how many rows they have."""

    def __init__(self, sweep: Sweep, shared: Shared) -> None:
        self.sweep, self.shared = sweep, shared

    def next(self) -> bytes | None:
        """The next block."""
        start = self.shared["read"]
        if start >= self.sweep.size:
            return None
        count = self.sweep.block(start)
        self.shared["read"] = start + count
        return b"%d %d" % (start, count)


class _Lines:
    """Blocks of a sweep as CSV or TSV."""

    def __init__(self, sweep: Sweep, kind: str) -> None:
        self.sweep = sweep
        self.separator = DIALECTS[kind].separator
        self.evaluators = Evaluators(sweep)
        self.head = self.separator.join(header(name).encode() for name in sweep.shape.columns) + b"\n"

    def convert(self, text: bytes) -> Converted:
        """The lines of a block."""
        rows = self.evaluators.rows(*map(int, text.split()))
        table = numpy.empty((rows.size, len(rows.inputs) + len(rows.results)))
        words: dict[int, bytes] = {}
        for place, column in enumerate([*rows.inputs, *rows.results]):
            table[:, place] = numpy.nan if column is None else column
            if column is not None and place < len(rows.inputs) and numpy.isinf(column).any():
                words[place] = (word_for_infinity(self.sweep.inputs[place]) or "").encode()
        numbers = orjson.dumps(table + 0.0, option=orjson.OPT_SERIALIZE_NUMPY).replace(b"null", b"")
        lead = b"".join(quoted_cell(name.encode(), self.separator) + self.separator for name in rows.materials)
        lines = (
            numbers[1:]
            .replace(b"[", b"")
            .replace(b"]", b"\n")
            .replace(b"\n,", b"\n")
            .removesuffix(b"\n\n")
            .split(b"\n")
        )
        if words:
            lines = [self._worded(line, row, table, words) for row, line in enumerate(lines)]
        if self.separator != b",":
            lines = [line.replace(b",", self.separator) for line in lines]
        output = lead + (b"\n" + lead).join(lines) + b"\n"
        return Converted(output, rows.size, rows.failed, rows.size, None)

    def _worded(self, line: bytes, row: int, table: Floats, words: dict[int, bytes]) -> bytes:
        cells = line.split(b",")
        for place, word in words.items():
            if table[row, place] == INFINITY:
                cells[place] = word
        return b",".join(cells)


def stream(sweep: Sweep, settings: Settings) -> Tally:
    """Write all rows of a sweep."""
    shared = Shared()
    form = format_of(settings.target)
    if form is not None and form.kind == "parquet":
        with missing_extra("parquet"):
            from .sweep_parquet import write_sweep
        return write_sweep(sweep, settings, shared)
    if form is not None and form.kind not in DIALECTS:
        raise BadRequest(f"-o: a sweep is written as csv, tsv or parquet, not as {form.kind}")
    compress = compressor(form.compression if form else "")
    source = Places(sweep, shared)
    lines = _Lines(sweep, form.kind if form else "csv")

    def converted(text: bytes) -> Converted:
        block = lines.convert(text)
        return block._replace(output=compress(block.output))

    goes_on = settings.target != "-"
    with closing(_sink(sweep, settings, shared, source)) as sink:
        if not shared["lines"]:
            sink.head(b"", compress(lines.head), 1)
        with watched(shared, sweep.size, is_quiet=settings.quiet or not goes_on, goes_on=goes_on) as show:
            ring.run(source, converted, sink, settings.processes, show)
        sink.finish()
    return Tally(shared["rows"], shared["failed"])


def _sink(sweep: Sweep, settings: Settings, shared: Shared, source: Places) -> Sink:
    """Where the lines go: stdout, or a file, at its beginning or where an interrupted run came to."""
    if settings.target == "-":
        sys.stdout.flush()
        return Sink(os.dup(sys.stdout.fileno()), shared, strict=False)
    check_file(settings.target)
    sink = FileSink(settings.target, shared, strict=False)
    identity = sweep.identity()
    if not (settings.resume and sink.resume(identity, b"", source)):
        sink.begin(identity)
    return sink
