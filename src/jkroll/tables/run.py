"""The `batch` command: from the options to the exit code, for one table or for many tables into a directory.

This process reads the blocks of a table and writes them in order. If there are many blocks, other processes convert
them, except for Parquet; the output does not depend on the number of processes. With many tables, each table is a task
for a process on this machine or a worker of a Dask cluster. A file gets its name when it is complete, so `--resume` can
continue an interrupted run: this option keeps files that are not older than their tables.
"""

import glob
import os
import sys
from collections import Counter
from collections.abc import Callable, Generator, Iterable, Iterator
from contextlib import closing
from functools import partial
from itertools import chain, islice
from time import monotonic, sleep
from typing import Any, BinaryIO, NamedTuple

from ..errors import ROWS_FAILED, BadRequest, BadRow, BadTable, JkrollError, MissingExtra, missing_extra
from ..model.limits import EVERY_DOUBT
from ..model.rows import DOUBT, STATUS, Columns, Wanted, evaluated, worded
from ..model.tally import Tally
from ..quantities.formatting import Format
from ..quantities.laws import DEFAULT_LAW, LAWS, law_given
from ..quantities.nomenclature import INFINITY, NOMENCLATURE, computed_as
from ..text import quoted, say, say_wrapped, shown
from ..write.output_file import remove_begun, whole_file
from ..write.writers import WRITERS, result_columns, written
from .files import (
    SEPARATORS,
    WRITTEN,
    Delimited,
    Input,
    compressed,
    format_of_name,
    input_format,
    output_format,
)
from .ndjson import Ndjson
from .opened import opened
from .progress import with_progress
from .table import Asked, Table, TableBlock, header_of

MAX_PROCESSES = 16  # unless --jobs asks for more, since one process reads for all others
ALONE = 4  # blocks that this process converts before it starts other processes
MAX_NOTES = 6  # maximum number of notes at the end, on rows or on many tables
LITTLE = 1 << 19  # bytes that a process converts while another starts
FOLDER_ENDS = ("/", os.sep)  # a directory ends in one of them; Windows has both
DASK_WAIT = 20.0  # seconds to wait for a Dask scheduler, and as many to wait for a worker
DASK_CHECK = 2.0  # seconds between checks that the scheduler still has a worker
DASK_STEP = 0.02  # seconds between checks for a converted table


class Job(NamedTuple):
    """A run of `batch`: the request for rows, and the options for files."""

    asked: Asked
    target: str = "-"
    format: str = ""
    delimiter: str = ""
    strict: bool = False
    resume: bool = False  # with many tables, keep the files that are done
    jobs: int = 0
    excel_safe: bool = False
    dask: str = ""
    quiet: bool = False
    mark: str = ""  # in the names of the temporary files of this run

    @property
    def processes(self) -> int:
        """The number of processes: the value of `--jobs`, or one for each available core, up to MAX_PROCESSES."""
        cores = len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1
        return self.jobs or min(cores, MAX_PROCESSES)

    def say(self, lines: Iterable[str]) -> None:
        """Print lines on stderr, unless the run is quiet."""
        if not self.quiet:
            for line in lines:
                say_wrapped(line, sys.stderr)


def run(path: str, job: Job) -> int:
    """Convert a table, or several tables; return the exit code."""
    if (glob.has_magic(path) and not os.path.exists(path)) or job.target.endswith(FOLDER_ENDS):
        tally, code = _convert_many(path, job)
    else:
        if job.resume or job.dask:
            raise BadRequest("--resume and --dask are for many files: write 'grains/*.csv' -o DIRECTORY/")
        tally, code = convert_one(path, job), 0
    job.say(notes_on(tally, job.asked))
    if tally.failed:
        say(f"jkroll: {tally.failed} of {tally.rows} rows failed; column {STATUS} has the reasons", sys.stderr)
    return code or (ROWS_FAILED if tally.failed else 0)


def notes_on(tally: Tally, asked: Asked) -> Iterator[str]:
    """Iterate over lines on inferred values, on rows in doubt, and on empty cells."""
    from ..report.notes import about_rows

    if tally.inferred:
        yield _summary(asked, tally)
    notes = [*about_rows(tally, EVERY_DOUBT, f"column {DOUBT if asked.doubt else STATUS}")]
    for note in notes[:MAX_NOTES]:
        yield note.line
    more = len(notes) - MAX_NOTES
    if more > 0:
        yield f"note: column {STATUS} has {more} more {'reasons' if more > 1 else 'reason'} for empty cells"


def _summary(asked: Asked, tally: Tally) -> str:
    """Return the sentence on an inferred input: the number of its values and, from two on, how they are distributed.

    The values are those of the law in use, with and without columns of best ranges.
    """
    import numpy

    from ..report.scatter import scatter_in_words

    name, law = asked.infer, law_given(asked.inputs.get("model"), asked.inputs.get("profile")) or DEFAULT_LAW
    values = numpy.concatenate(tally.inferred)
    known = values[~numpy.isnan(values)]
    sentence = f"note: {name} by {LAWS[law].short}: {len(known)} of {len(values)} rows"
    return sentence if len(known) < 2 else f"{sentence}; {scatter_in_words(name, known)}"


def about(table: Table) -> Iterator[str]:
    """Iterate over lines about a table as a whole.

    The lines name assumed inputs, unclear names and aliases of materials, a missing radius or surface energy, and
    options that fill empty cells or have no effect.
    """
    from ..report.notes import about_idle, assumed_in, idle_in

    texts = assumed_in(table.groups, judges=table.wanted.doubts)
    assumed = [text for name, text in texts.items() if name not in table.given]
    if assumed:
        yield f"assumed: {', '.join(assumed)}"
    remarks = chain.from_iterable(lookup.remarks for lookup in table.lookups.values())
    notes = [*dict.fromkeys(remarks)]
    notes += _about_lacking(table)
    read = {*map(computed_as, table.columns.names)}
    filled = sorted(NOMENCLATURE[name].option or f"--{name}" for name in table.fixed if computed_as(name) in read)
    notes += [f"{option} fills empty cells: other cells keep theirs" for option in filled]
    # An infinite value is not idle: it may make a body rigid in some rows.
    every_idle = idle_in(table.groups, judges=table.wanted.doubts)
    idle = [name for name in every_idle if table.fixed.get(name, INFINITY) != INFINITY]
    notes += [note.text for note in about_idle(idle)]
    yield from (f"note: {text}" for text in notes)


def _about_lacking(table: Table) -> Iterator[str]:
    """Iterate over notes on a radius or a surface energy that the table lacks, and on columns that may give it."""
    if table.asked.explicit:
        return
    if table.given.isdisjoint(("radius", "diameter")):
        problem = "no column and no option gives a radius; quantities that need a radius are left out"
        columns = table.columns_for("radius")
        yield f"{problem}; {columns}" if columns else problem
    lacks_energy = all(frame.missing(["work_of_adhesion"]) for frame, _ in table.groups)
    columns = table.columns_for("surface_energy") if lacks_energy else ""
    if columns:
        yield f"no column and no option gives a surface energy; {columns}"


# --- A table ----------------------------------------------------------------------------------------------------------


class Converted(NamedTuple):
    """A converted block, its number of lines, and the counts of its rows."""

    output: Any
    lines: int
    tally: Tally


class Converter(NamedTuple):
    """The table and the options with which `converted` adds results to blocks. They can be sent to other processes."""

    source: Any  # reads blocks, and its writer writes them
    table: Table
    compression: str
    strict: bool  # raise an error for the first failed row

    def converted(self, block: Any) -> Converted:
        """Return a block with the results of each row. Raises BadRow."""
        table = self.table
        records = self.source.read(block, table)
        rows = TableBlock(table, records)
        columns = evaluated(table.wanted, rows)
        columns.leave_out_bars(rows.half_bars)
        del rows
        records = records._replace(cells={})  # frees half of the memory, for writing
        failed = columns.first_failed if self.strict else None
        if failed is not None:
            raise BadRow(records.starts[failed.first], worded(failed.reasons))
        form = Format(digits=self.source.writer.digits)
        added = [*table.law_words.values(), *result_columns(columns, form, table.wanted.last_keys())]
        output = compressed(self.source.writer.rows(table.added, added, records.before), self.compression)
        tally = Tally.of(columns)
        # `about` explains unclear names, so the gaps that they leave are not counted.
        tally = tally._replace(gaps={fault: rows for fault, rows in tally.gaps.items() if fault not in table.unclear})
        unknown = table.asked.infer
        if unknown:
            tally = tally._replace(inferred=(columns.column(unknown).copy(),))
        return Converted(output, records.size, tally)


def convert_one(path: str, job: Job) -> Tally:
    """Convert a table; return the counts of its rows."""
    asked = job.asked
    source_format = input_format(path, job.target, job.format, job.delimiter)
    target_format = output_format(job.target, source_format.name, quiet=job.quiet)
    as_markdown = target_format.name == "md" and source_format.name in SEPARATORS
    if target_format.name != source_format.name and not as_markdown:
        name = quoted(f"{os.path.basename(job.target).partition('.')[0]}.{source_format.name}")
        raise BadTable(f"-o: the output has the format of the input; write {name}, and convert it with another program")
    file = Input(path)
    with file.file:
        file.check_output(job.target)
        source, blocks = opened(
            file, source_format, asked, target=job.target, excel_safe=job.excel_safe, as_markdown=as_markdown
        )
        header = header_of(source, asked)
        reading = header.reading(*source.remarks)
        job.say([reading])  # printed first: an unread column may be why an input is missing
        table = Table(header, source.sample, asked)
        remarks = [*about(table)]
        job.say(remarks)
        with whole_file(job.target, job.mark) as output:
            convert = Converter(source, table, target_format.compression, strict=job.strict)
            tally = _convert(file, blocks, convert, output, job)
    if not tally.rows:
        remarks.append("note: the table has no rows")
        job.say(remarks[-1:])
    return tally._replace(remarks=(reading, *remarks))


def _convert(file: Input, blocks: Iterator[Any], convert: Converter, output: BinaryIO, job: Job) -> Tally:
    """Write a table with its results; return the counts of its rows."""
    source, tally = convert.source, Tally()
    header = compressed(source.head(convert.table.added), convert.compression)
    line = source.lines
    converted = _converted(blocks, convert, job.processes)
    if sys.stderr.isatty() and not job.quiet:
        converted = with_progress(converted, lambda block: block.tally.rows, partial(progress_of, file))
    try:
        with source.writer.sink(output, header) as write, closing(converted):
            for block in converted:
                write(block.output)
                line += block.lines
                tally = tally.plus(block.tally)
                del block  # frees memory before the next block
    except BadRow as error:
        row, status = error.args
        raise BadRow(line + 1 + row, status) from None
    return tally


def _converted(blocks: Iterator[Any], convert: Converter, processes: int) -> Generator[Converted]:
    """Iterate over converted blocks in their order.

    Parquet is converted in this process only, since its library uses threads of its own.
    """
    is_alone = processes < 2 or not isinstance(convert.source, Delimited | Ndjson)
    yield from map(convert.converted, blocks if is_alone else islice(blocks, ALONE))
    block = next(blocks, None)
    if block is None:
        return
    from .workers import answers  # only a large table loads multiprocessing

    yield from answers(processes, convert.converted, chain([block], blocks))


def progress_of(file: Input, rows: int, taken: float) -> str:
    """Return the line of progress of a file: the fraction read and the time left, if known, and the number of rows."""
    share = file.share_read(rows)
    left = f"{share:4.0%}, {taken * (1 / share - 1):.0f} s left, " if share else ""
    return f"{left}{rows:,} rows"


# --- Many tables ------------------------------------------------------------------------------------------------------

Pair = tuple[str, str]  # a table and its output file
Outcome = tuple[Tally, JkrollError | None]  # the counts of a table's rows, and the error if the whole table failed
Task = Callable[[Pair], Outcome]


def _convert_many(path: str, job: Job) -> tuple[Tally, int]:
    """Convert the tables that match a pattern; return the counts of their rows, and the highest exit code."""
    pairs = _pairs(job.target, path)
    left = [pair for pair in pairs if not (job.resume and _is_newer(pair))]
    mark = os.urandom(4).hex()
    task = partial(_outcome, job._replace(jobs=1, quiet=True, mark=mark))
    try:
        outcomes = [*(_on_cluster(job.dask, task, left) if job.dask else _by_processes(job.processes, task, left))]
    finally:
        remove_begun((target for _, target in left), mark)  # left by killed processes
    tally = Tally()
    for (table, _), (of_table, _) in zip(left, outcomes, strict=True):
        tally = tally.plus(of_table, f"{quoted(table)}: ")
    if not job.quiet:
        kept = len(pairs) - len(left)
        if kept:
            say(f"note: {kept} of {len(pairs)} output files are up to date and were kept", sys.stderr)
        for line, count in Counter(tally.remarks).most_common(MAX_NOTES):
            say_wrapped(line if count == len(left) else f"{line}: {count} of {len(left)} files", sys.stderr)
    code = 0
    for (path_of_table, _), (_, error) in zip(left, outcomes, strict=True):
        if error is not None:
            table = quoted(path_of_table)
            say(f"jkroll: {table}: {str(error).removeprefix(f'{table}: ')}", sys.stderr)
            code = max(code, error.exit_code)
    return tally, code


def _pairs(directory: str, path: str) -> list[Pair]:
    """Return the tables that match a pattern, with their outputs, and make the directory.

    Raises BadTable for missing or equally named tables, and BadRequest for an unsuitable directory.
    """
    folder = directory.rstrip("".join(FOLDER_ENDS))
    is_file = os.path.exists(folder) or format_of_name(directory, WRITTEN) is not None
    if directory == "-" or (is_file and not os.path.isdir(folder)):
        raise BadRequest("several tables need a directory for the results: -o DIRECTORY/")
    paths = [path] if os.path.exists(path) else sorted(glob.glob(path))
    if not paths:
        raise BadTable(f"{quoted(path)}: no such file")
    targets = [os.path.join(directory, os.path.basename(table)) for table in paths]
    if len({*targets}) < len(paths):
        raise BadTable(f"{quoted(path)}: two tables have the same name")
    pairs = [*zip(paths, targets, strict=True)]
    if any(all(map(os.path.exists, pair)) and os.path.samefile(*pair) for pair in pairs):
        problem = f"-o: {quoted(directory)} contains the input, which would be overwritten"
        raise BadRequest(f"{problem}; name another directory")
    os.makedirs(directory, exist_ok=True)
    return pairs


def _is_newer(pair: Pair) -> bool:
    """Return whether a table has an output that is not older than the table."""
    table, output = pair
    return all(map(os.path.exists, pair)) and os.stat(output).st_mtime_ns >= os.stat(table).st_mtime_ns


def _outcome(job: Job, pair: Pair) -> Outcome:
    """Convert a table in this process; return the outcome. Raises MissingExtra."""
    path, target = pair
    try:
        return convert_one(path, job._replace(target=target)), None
    except MissingExtra:
        raise  # every table lacks the same library
    except JkrollError as error:
        return Tally(), error


def _by_processes(count: int, task: Task, pairs: list[Pair]) -> Iterator[Outcome]:
    """Iterate over the outcomes of tables converted by up to `count` processes."""
    size = sum(os.path.getsize(table) for table, _ in pairs if os.path.exists(table))
    count = min(count, len(pairs), 1 + size // LITTLE)
    if count < 2:
        return map(task, pairs)
    from .workers import answers

    return answers(count, task, pairs)


def _on_cluster(address: str, task: Task, pairs: list[Pair]) -> Iterator[Outcome]:
    """Iterate over the outcomes of tables converted by the workers of a Dask cluster.

    The tables of a lost worker go to other workers. Raises BadTable if there is no cluster, and LostWorker if the
    scheduler or all of its workers are lost.
    """
    import logging

    from .workers import LostWorker

    with missing_extra("dask"):
        from concurrent.futures import CancelledError

        from distributed import Client, KilledWorker
    logging.disable()  # errors of `distributed` are reported below
    scheduler = f"--dask: the scheduler at {quoted(address)}"
    try:
        client = Client(address, timeout=DASK_WAIT)
        client.wait_for_workers(1, timeout=DASK_WAIT)
    except (OSError, ValueError):
        raise BadTable(f"--dask: no scheduler with a worker answers at {quoted(address)}") from None
    except Exception as error:  # the library of a protocol may raise any error
        raise BadTable(f"{scheduler} cannot be reached: {shown(str(error))}") from None
    with closing(client):
        # A worker resolves a relative path in its own directory.
        futures = [client.submit(task, tuple(map(os.path.abspath, pair)), pure=False) for pair in pairs]
        for future in futures:
            try:
                _await(future, client)
            except OSError:
                if client.status == "running":
                    raise LostWorker(f"{scheduler} has no worker left; all need this version of jkroll") from None
            try:
                yield future.result()
            except KilledWorker as error:
                yield Tally(), LostWorker(f"its worker ended {error.allowed_failures + 1} times")
            except CancelledError:
                raise LostWorker(f"{scheduler} was lost; --resume converts the remaining tables") from None


def _await(future: Any, client: Any) -> None:
    """Wait until a table is converted or given up. Raises OSError if no worker is left."""
    checked = monotonic()
    while not future.done():
        sleep(DASK_STEP)
        if monotonic() - checked > DASK_CHECK:
            if client.status == "running":  # without a connection, the client cancels the future
                client.wait_for_workers(1, timeout=DASK_WAIT)
            checked = monotonic()


# --- Results of other commands ----------------------------------------------------------------------------------------


def write_file(
    wanted: Wanted, blocks: Iterable[Columns], units: Format, target: str, *, doubt: bool, quiet: bool
) -> None:
    """Write columns to a file in the format of its extension, by default CSV. Raises BadRequest for .xlsx or .svg."""
    form = output_format(target, "csv", quiet=quiet)
    if form.name == "parquet":
        with missing_extra("parquet"):
            from .parquet import Batches
        writer: Any = Batches()
    else:
        writer = WRITERS[form.name]
    texts = (compressed(text, form.compression) for text in written(writer, wanted, blocks, units, doubt=doubt))
    with whole_file(target) as stream, writer.sink(stream, next(texts)) as write:
        for text in texts:
            write(text)
