"""The `batch` command: from the options to the exit code, for a table or for many into a directory.

Many tables are a task each, by processes of this machine or on a Dask cluster. A file gets its name when it is whole.
So a run that was ended goes on with `--resume`, which keeps what is newer than its table.
"""

import glob
import os
import sys
from collections import Counter
from collections.abc import Callable, Iterator
from contextlib import closing
from functools import partial, reduce
from typing import NamedTuple

from ..errors import ROWS_FAILED, BadRequest, BadTable, JkrollError, MissingExtra, missing_extra
from ..quantities.formatting import amount
from ..rows.columns import DOUBT, STATUS
from ..rows.reasons import Tally
from ..scene.limits import EVERY_DOUBT
from ..text import quoted, say, say_wrapped
from .files import format_of_name
from .run import Job, convert_one

MAX_NOTES = 6  # about rows, at the end
MAX_LINES = 6  # about many tables, that are said at the end
LITTLE = 1 << 19  # bytes of files that a process converts in the time in which another one starts
DASK_WAIT = 20.0  # seconds for a scheduler of Dask to answer, and then for it to have a worker


def run(path: str, job: Job) -> int:
    """Convert a table, or several; return the exit code."""
    if (glob.has_magic(path) and not os.path.exists(path)) or job.target.endswith(os.sep):
        tally, code = _convert_many(path, job)
    else:
        if job.resume or job.dask:
            flag = "--resume" if job.resume else "--dask"
            raise BadRequest(f"{flag} is for many files: name them as in 'grains/*.csv', with -o DIRECTORY/")
        tally, code = convert_one(path, job), 0
    if not job.quiet:
        _say_notes(tally, job)
    if tally.failed:
        say(f"jkroll: {tally.failed} of {tally.rows} rows failed; column {STATUS} says why", sys.stderr)
    return code or (ROWS_FAILED if tally.failed else 0)


def _say_notes(tally: Tally, job: Job) -> None:
    """Say on stderr what was inferred, and in how many rows numbers are in doubt, or cells empty."""
    from ..answers.notes import about_rows

    if tally.inferred:
        say_wrapped(_summary(job.asked.infer, tally), sys.stderr)
    notes = [*about_rows(tally, EVERY_DOUBT, f"column {DOUBT}")]
    for note in notes[:MAX_NOTES]:
        say_wrapped(note.line, sys.stderr)
    if (more := len(notes) - MAX_NOTES) > 0:
        say(f"note: column {STATUS} has {more} more kinds of gaps", sys.stderr)


def _summary(name: str, tally: Tally) -> str:
    """Return the sentence on the values of an input that was sought: count, median, quartiles, mean and scatter."""
    import numpy

    values = numpy.concatenate(tally.inferred)
    known = values[~numpy.isnan(values)]
    sentence = f"note: {name}: {len(known)} of {len(values)} rows"
    if len(known) < 2:
        return sentence
    low, median, high = numpy.quantile(known, [0.25, 0.5, 0.75]).tolist()
    middle = f"median {amount(name, median)}, quartiles {amount(name, low)} and {amount(name, high)}"
    mean, scatter = float(known.mean()), float(known.std(ddof=1))
    return f"{sentence}; {middle}; mean {amount(name, mean)}, scatter {amount(name, scatter)}"


# --- Many tables ------------------------------------------------------------------------------------------------------

Pair = tuple[str, str]  # a table, and the file that it becomes


class Outcome(NamedTuple):
    """The counts of a table, or why it failed as a whole."""

    tally: Tally
    problem: str = ""
    exit_code: int = 0


Task = Callable[[Pair], Outcome]


def _convert_many(path: str, job: Job) -> tuple[Tally, int]:
    """Convert the tables that a pattern names; return the counts, and the highest exit code of a table."""
    pairs = _pairs(job.target, path)
    left = [pair for pair in pairs if not (job.resume and _is_newer(pair))]
    task = partial(_converted, job._replace(jobs=1, quiet=True))
    outcomes = dict(_on_cluster(job.dask, task, left) if job.dask else _by_processes(job.processes, task, left))
    tally = reduce(Tally.plus, (outcomes[pair].tally for pair in left), Tally())
    if not job.quiet:
        if kept := len(pairs) - len(left):
            say(f"note: {kept} of {len(pairs)} files are newer than their tables and were kept", sys.stderr)
        for line, count in Counter(tally.said).most_common(MAX_LINES):
            say_wrapped(line if count == len(left) else f"{line}: {count} of {len(left)} files", sys.stderr)
    for pair in left:
        if problem := outcomes[pair].problem:
            say(f"jkroll: {quoted(pair[0])}: {problem}", sys.stderr)
    return tally, max((outcome.exit_code for outcome in outcomes.values()), default=0)


def _pairs(directory: str, path: str) -> list[Pair]:
    """Return the tables that a pattern names, and make the directory of their results; BadRequest if it can be none."""
    place = directory.rstrip(os.sep)
    is_file = os.path.exists(place) or format_of_name(directory) is not None
    if directory == "-" or (is_file and not os.path.isdir(place)):
        raise BadRequest("several tables need a directory for the results: -o DIRECTORY/")
    paths = [path] if os.path.exists(path) else sorted(glob.glob(path))
    if not paths:
        raise BadTable(f"{quoted(path)}: no such file")
    targets = [os.path.join(directory, os.path.basename(table)) for table in paths]
    if len({*targets}) < len(paths):
        raise BadTable(f"{quoted(path)}: two tables have the same name")
    pairs = [*zip(paths, targets, strict=True)]
    if any(all(map(os.path.exists, pair)) and os.path.samefile(*pair) for pair in pairs):
        raise BadRequest(f"-o: {quoted(directory)} is where the input is; it is not overwritten")
    os.makedirs(directory, exist_ok=True)
    return pairs


def _is_newer(pair: Pair) -> bool:
    """Return whether the output of a table is newer than the table."""
    table, output = pair
    return all(map(os.path.exists, pair)) and os.stat(output).st_mtime_ns >= os.stat(table).st_mtime_ns


def _converted(job: Job, pair: Pair) -> Outcome:
    """Convert a table in this process; a failure is an outcome."""
    path, target = pair
    try:
        return Outcome(convert_one(path, job._replace(target=target)))
    except MissingExtra:
        raise  # as it would for every table
    except JkrollError as error:
        return Outcome(Tally(), str(error).removeprefix(f"{quoted(path)}: "), error.exit_code)


def _by_processes(count: int, task: Task, pairs: list[Pair]) -> Iterator[tuple[Pair, Outcome]]:
    """Convert tables by some processes, the largest first, so that all end at about the same time."""
    sizes = {pair: os.path.getsize(pair[0]) if os.path.exists(pair[0]) else 0 for pair in pairs}
    count = min(count, len(pairs), 1 + sum(sizes.values()) // LITTLE)
    if count < 2:
        yield from ((pair, task(pair)) for pair in pairs)
        return
    from .workers import answers

    pairs = sorted(pairs, key=sizes.__getitem__, reverse=True)
    yield from zip(pairs, (outcome for outcome, _ in answers(count, task, pairs)), strict=True)


def _on_cluster(address: str, task: Task, pairs: list[Pair]) -> Iterator[tuple[Pair, Outcome]]:
    """Convert tables by the workers of a Dask cluster, which give those of a lost one to others. Raises BadTable."""
    import logging

    with missing_extra("dask"):
        from distributed import Client, KilledWorker, as_completed
    for name in ("distributed", "distributed.worker", "distributed.scheduler", "tornado"):
        logging.getLogger(name).setLevel(logging.CRITICAL)
    try:
        client = Client(address, timeout=DASK_WAIT)
    except (OSError, ValueError):
        raise BadTable(f"--dask: no scheduler answers at {quoted(address)}") from None
    with closing(client):
        try:
            client.wait_for_workers(1, timeout=DASK_WAIT)
        except TimeoutError:
            raise BadTable(f"--dask: the scheduler at {quoted(address)} has no worker") from None
        # A worker opens a relative path in a directory of its own.
        tasks = {client.submit(task, tuple(map(os.path.abspath, pair)), pure=False): pair for pair in pairs}
        for future in as_completed([*tasks]):
            try:
                yield tasks[future], future.result()
            except KilledWorker as error:
                yield tasks[future], Outcome(Tally(), f"its worker ended {error.allowed_failures + 1} times", 1)
