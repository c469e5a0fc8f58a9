"""A table in a file, or from a pipe, into another: blocks of records through a converter into the output, in order.

This process reads the blocks and decides the order in which they are written. Where there are many blocks, others
convert and write them; the output is the same for any number of them.
"""

import os
import sys
from collections.abc import Iterable, Iterator
from contextlib import closing
from itertools import chain, islice
from typing import TYPE_CHECKING, Any, BinaryIO, NamedTuple

from ..errors import BadRow, missing_extra
from ..output.writers import WRITERS, columns_of, written
from ..quantities.formatting import Format
from ..rows.columns import Columns, Wanted, remarks_of
from ..rows.reasons import Tally, worded
from ..rows.rows import evaluated
from ..rows.table import Table, TableBlock
from ..text import say
from .files import Input, compressed, format_of_name, input_format, lines_of, output_format, output_to, unnamed
from .job import Job, said_of
from .lines import Converted, Head, Source
from .progress import Bar

if TYPE_CHECKING:
    from .workers import Worker

ALONE = 4  # blocks that this process converts before it starts others
MEANWHILE = 4  # blocks that it converts while they start


class Converter(NamedTuple):
    """A function of blocks of records, which processes share."""

    form: Any
    head: Head
    table: Table
    strict: bool  # whether the first row that fails is an error
    compression: str

    def __call__(self, block: Any) -> Converted:
        """Return the block with the results in each row."""
        table = self.table
        records = self.form.read(block, self.head, table)
        columns = evaluated(table.wanted, TableBlock(table, records))
        if self.strict and columns.failed:
            first = min(columns.failed)
            raise BadRow(records.starts[first], worded(columns.reasons[first]))
        added = [*table.said.values(), *columns_of(columns, Format({}), remarks_of(table.wanted))]
        output = self.head.writer.rows(table.added, added, records.before, records.rest)
        tally = Tally.of(columns)
        if table.fill.unknown:
            tally = tally._replace(inferred=(columns.column(table.fill.unknown).copy(),))
        return Converted(compressed(output, self.compression), records.size, tally)


def convert_one(path: str, job: Job) -> Tally:
    """Convert a table; return the counts of all of it."""
    settings = job.settings
    form = input_format(path, settings)
    compression = output_format(settings, form).compression
    for kind in (form.compression, compression):
        compressed(b"\n", kind)  # a missing library is named before anything is opened
    processes, source_of = settings.processes, lines_of
    if form.kind == "parquet":
        with missing_extra("parquet"):
            from .parquet import source_of
        processes = 1  # and threads
    with closing(Input(path)) as given:
        given.check_output(settings.target)
        source = source_of(given, form, job)
        table = job.table(source.head.names, source.head.sample, source.head.preamble)
        convert = Converter(source.form, source.head, table, settings.strict, compression)
        with output_to(settings.target) as output, Bar(source.size, quiet=settings.quiet) as bar:
            tally = _convert(source, convert, output, processes, bar)
    return tally._replace(said=said_of(table))


def _convert(source: Source, convert: Converter, output: BinaryIO, processes: int, bar: Bar) -> Tally:
    """Write a table; return the counts of all of it."""
    head, tally = source.head, Tally()
    header = compressed(head.writer.header(convert.table.added, [head.header]), convert.compression)
    line, size = head.lines, len(header)
    path = output.name if isinstance(output.name, str) and os.path.isfile(output.name) else ""
    try:
        with head.writer.sink(output, header) as write:
            for block, worker in _converted(convert, source.blocks, processes, path):
                write(worker.answer_to(size) if worker else block.output)
                size += block.size or len(block.output)
                line += block.lines
                tally = tally.plus(block.tally)
                bar.show(source.position(tally.rows), tally.rows)
    except BadRow as error:
        raise BadRow(line + 1 + error.line, error.status) from None
    except KeyboardInterrupt:
        say(f"jkroll: interrupted after {tally.rows} rows", sys.stderr)
        raise
    return tally


def _converted(
    convert: Converter, blocks: Iterator[Any], processes: int, path: str
) -> "Iterator[tuple[Converted, Worker | None]]":
    """Iterate over converted blocks in their order, each with the process that holds its output, if another one does.

    `path`: of the file into which they go, or an empty text.
    """
    for block in islice(blocks, ALONE) if processes > 1 else blocks:
        yield convert(block), None
    if (block := next(blocks, None)) is None:
        return
    # They come with multiprocessing, which a small table does not pay for.
    from .workers import answers_in_order, started

    with started(processes, Answering(convert, path)) as workers:
        for each in chain([block], islice(blocks, MEANWHILE)):
            yield convert(each), None
        yield from answers_in_order(workers, blocks)


class Answering:
    """A function of a block, and then of the place at which its output begins.

    It converts the block. When its turn comes, it writes the output there, or hands it over if there is no file: to
    send a block to another process takes a third as long as to make it.
    """

    def __init__(self, convert: Converter, path: str) -> None:
        self.convert, self.path, self.output = convert, path, b""

    def __call__(self, question: bytes | int) -> Converted | bytes:
        """Return the converted block without its output, and then the output, if it is not written."""
        if isinstance(question, bytes):
            converted = self.convert(question)
            self.output = converted.output
            return converted._replace(output=b"", size=len(self.output))
        if not self.path:
            return self.output
        with open(self.path, "r+b") as file:
            file.seek(question)
            file.write(self.output)
        return b""


# --- Lists and ranges -------------------------------------------------------------------------------------------------


def write_columns(
    wanted: Wanted, blocks: Iterable[Columns], units: Format, target: str, *, doubt: bool, quiet: bool
) -> None:
    """Write columns to a file in the format that its name says. Raises BadRequest for one that is not for columns."""
    form = format_of_name(target) or unnamed(target, "csv", quiet=quiet)
    if form.kind == "parquet":
        with missing_extra("parquet"):
            from .parquet import Batches
        writer: Any = Batches()
    else:
        writer = WRITERS[form.kind]
    texts = (compressed(text, form.compression) for text in written(writer, wanted, blocks, units, doubt=doubt))
    with output_to(target) as stream, writer.sink(stream, next(texts)) as write:
        for text in texts:
            write(text)
