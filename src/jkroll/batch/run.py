"""A table in a file, or from a pipe, into another: blocks of records, converted and written in their order.

This process reads the blocks and decides the order in which they are written. Where there are many blocks, others
convert and write them; the output is the same for any number of them.
"""

import os
import sys
from collections.abc import Iterable, Iterator
from contextlib import closing
from itertools import chain, islice
from time import monotonic
from typing import TYPE_CHECKING, Any, BinaryIO, NamedTuple

from ..errors import BadRow, BadTable, missing_extra
from ..output.writers import WRITERS, columns_of, whole_file, written
from ..quantities.formatting import Format
from ..quantities.nomenclature import INFINITY, NOMENCLATURE
from ..rows.columns import Columns, Wanted, remarks_of
from ..rows.header import check_inputs, understood
from ..rows.reasons import Tally, worded
from ..rows.rows import evaluated
from ..rows.table import Asked, Table, TableBlock
from ..scene.failures import MissingInput
from ..text import listed, quoted, say, say_wrapped
from .files import Input, compressed, input_format, lines_of, output_format
from .lines import Delimited, Ndjson

if TYPE_CHECKING:
    from .workers import Worker

MAX_PROCESSES = 16  # unless --jobs asks for more: one process reads for all of them
ALONE = 4  # blocks that this process converts before it starts others
WAIT, PAUSE = 0.5, 0.1  # seconds before progress is shown, and between two times
WIDTH = 60  # of the line of progress, in characters


class Job(NamedTuple):
    """The request of a run of `batch`: what is asked of rows, and the options of files."""

    asked: Asked
    target: str = "-"
    format: str = ""
    delimiter: str = ""
    strict: bool = False
    resume: bool = False  # of many files: whether those that are done stay
    jobs: int = 0
    excel_safe: bool = False
    dask: str = ""
    quiet: bool = False

    @property
    def processes(self) -> int:
        """Number of processes: `--jobs`, else one for each core that this process may use."""
        cores = len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1
        return self.jobs or min(cores, MAX_PROCESSES)

    def say(self, lines: Iterable[str]) -> None:
        """Print lines on stderr, unless the run is quiet."""
        for line in () if self.quiet else lines:
            say_wrapped(line, sys.stderr)


def _about(table: Table) -> Iterator[str]:
    """Iterate over the lines about a table as a whole.

    They say which inputs are assumed, which labels may be meant as materials, which options change nothing, and what
    enters no error bar.
    """
    from ..answers.notes import about_idle, about_left_out, given_of_kinds

    every, idle = given_of_kinds(table.kinds, judges=table.wanted.doubts)
    if assumed := [text for name, text in every.items() if name not in table.given]:
        yield f"assumed: {', '.join(assumed)}"
    notes = [message for message in table.labels.values() if message]
    if "radius" not in table.given and not table.asked.explicit:
        notes.append("no column and no option gives a radius; what needs one is left out")
    fills = sorted(NOMENCLATURE[name].option or f"--{name}" for name in table.columns.names & table.fixed.keys())
    if fills:
        notes.append(f"{listed(fills)} fill{'' if fills[1:] else 's'} empty cells: the others keep their values")
    # What is infinite may make a body rigid in some rows.
    idle = [name for name in idle if table.fixed.get(name, INFINITY) != INFINITY]
    notes += [note.text for note in (*about_idle(idle), *about_left_out(table.left_out))]
    yield from (f"note: {text}" for text in notes)


# --- A table ----------------------------------------------------------------------------------------------------------


class Converted(NamedTuple):
    """A converted block, the size of the output, the number of lines that it was, and its counts."""

    output: Any
    size: int
    lines: int
    tally: Tally


class Converter:
    """Adds the results to blocks of a table.

    Another process calls it with a block, and then with the place at which the output of that begins: to send a block
    from one process to another takes a third as long as to make it.
    """

    def __init__(self, form: Any, table: Table, compression: str, *, strict: bool, path: str = "") -> None:
        """`strict`: whether the first row that fails is an error; `path`: of the file that another process writes."""
        self.form, self.table, self.compression, self.strict, self.path = form, table, compression, strict, path
        self.output = b""  # of the last block, if it is kept

    def converted(self, block: Any) -> Converted:
        """Return a block with the results in each row. Raises BadRow."""
        table = self.table
        records = self.form.read(block, table)
        columns = evaluated(table.wanted, TableBlock(table, records))
        if self.strict and columns.failed:
            first = min(columns.failed)
            raise BadRow(records.starts[first], worded(columns.reasons[first]))
        added = [*table.said.values(), *columns_of(columns, Format(), remarks_of(table.wanted))]
        output = compressed(self.form.writer.rows(table.added, added, records.before), self.compression)
        tally = Tally.of(columns)
        if unknown := table.asked.infer:
            tally = tally._replace(inferred=(columns.column(unknown).copy(),))
        return Converted(output, len(output), records.size, tally)

    def __call__(self, question: bytes | int) -> Converted | bytes:
        """Return the converted block without its output; then write that at its place, or return it for a pipe."""
        if isinstance(question, bytes):
            converted = self.converted(question)
            self.output = converted.output
            return converted._replace(output=b"")
        output, self.output = self.output, b""
        if not self.path:
            return output
        with open(self.path, "r+b") as file:
            file.seek(question)
            file.write(output)
        return b""


def convert_one(path: str, job: Job) -> Tally:
    """Convert a table; return the counts of all of it."""
    asked = job.asked
    given = input_format(path, job.target, job.format, job.delimiter)
    wanted = output_format(job.target, given.kind, quiet=job.quiet)
    if wanted.kind != given.kind:
        name = quoted(f"{os.path.basename(job.target).partition('.')[0]}.{given.kind}")
        problem = f"the output has the format of the input, {given.kind}"
        raise BadTable(f"-o: {problem}; write {name}, and convert it with another program")
    for each in (given, wanted):
        compressed(b"\n", each.compression)  # a missing library is named before anything is opened
    if given.kind == "parquet":
        with missing_extra("parquet"):
            from .parquet import batches_of
    with closing(Input(path)) as file:
        file.check_output(job.target)
        form: Any
        if given.kind == "parquet":
            form, blocks = batches_of(file, job.target, asked.is_read)
        else:
            form, blocks = lines_of(file, given, asked.is_read, excel_safe=job.excel_safe)
        header = understood(form.names, form.sample, asked.meanings(form.names), asked.inputs)
        check_inputs(header, asked.measured)
        reading = header.reading(form.preamble)
        try:
            table = Table(header, form.sample, asked)
        except MissingInput:
            job.say([reading])  # a column may not be understood
            raise
        said = (reading, *_about(table))
        job.say(said)
        with whole_file(job.target) as output:
            is_file = isinstance(output.name, str) and os.path.isfile(output.name)
            place = output.name if is_file else ""
            convert = Converter(form, table, wanted.compression, strict=job.strict, path=place)
            return _convert(file, blocks, convert, output, job)._replace(said=said)


def _convert(file: Input, blocks: Iterator[Any], convert: Converter, output: BinaryIO, job: Job) -> Tally:
    """Write a table; return the counts of all of it."""
    form, tally = convert.form, Tally()
    header = compressed(form.writer.header(convert.table.added, [form.header]), convert.compression)
    size, line = len(header), form.lines
    progress = Progress(is_shown=sys.stderr.isatty() and not job.quiet)
    try:
        with form.writer.sink(output, header) as write:
            for block, worker in _converted(blocks, convert, job.processes):
                if worker:
                    worker.ask(size)
                write(worker.answer() if worker else block.output)
                size += block.size
                line += block.lines
                tally = tally.plus(block.tally)
                progress.show(file.share_read(tally.rows), tally.rows)
    except BadRow as error:
        raise BadRow(line + 1 + error.line, error.status) from None
    except KeyboardInterrupt:
        say(f"jkroll: interrupted after {tally.rows} rows", sys.stderr)
        raise
    finally:
        progress.clear()
    return tally


def _converted(
    blocks: Iterator[Any], convert: Converter, processes: int
) -> "Iterator[tuple[Converted, Worker | None]]":
    """Iterate over converted blocks in their order, each with the process that holds its output, if another one does.

    A library that reads a table by itself has threads for it.
    """
    is_alone = processes < 2 or not isinstance(convert.form, Delimited | Ndjson)
    for block in blocks if is_alone else islice(blocks, ALONE):
        yield convert.converted(block), None
    if (block := next(blocks, None)) is None:
        return
    # They come with multiprocessing, which a small table does not pay for.
    from .workers import answers

    yield from answers(processes, convert, chain([block], blocks))


class Progress:
    """A line on a terminal that says how much is done, and nothing elsewhere."""

    def __init__(self, *, is_shown: bool) -> None:
        self.began = monotonic()
        self.next = self.began + WAIT if is_shown else INFINITY

    def show(self, share: float, rows: int) -> None:
        """Show which part is done, if it is known, and the rows so far."""
        if (now := monotonic()) >= self.next:
            self.next = now + PAUSE
            left = f"{share:4.0%}, {(now - self.began) * (1 / share - 1):.0f} s left, " if share else ""
            self._write(f"{left}{rows:,} rows")

    def clear(self) -> None:
        """Take the line away."""
        if self.began + WAIT < self.next < INFINITY:
            self._write("")

    def _write(self, text: str) -> None:
        sys.stderr.write(f"\r{text:{WIDTH}}\r")
        sys.stderr.flush()


# --- Lists and ranges -------------------------------------------------------------------------------------------------


def write_file(
    wanted: Wanted, blocks: Iterable[Columns], units: Format, target: str, *, doubt: bool, quiet: bool
) -> None:
    """Write columns to a file in the format that its name says. Raises BadRequest for one that is not for columns."""
    form = output_format(target, "csv", quiet=quiet)
    if form.kind == "parquet":
        with missing_extra("parquet"):
            from .parquet import Batches
        writer: Any = Batches()
    else:
        writer = WRITERS[form.kind]
    texts = (compressed(text, form.compression) for text in written(writer, wanted, blocks, units, doubt=doubt))
    with whole_file(target) as stream, writer.sink(stream, next(texts)) as write:
        for text in texts:
            write(text)
