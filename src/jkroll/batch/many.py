"""Many tables into a directory: a task a file, by processes of this machine or on a Dask cluster.

A file gets its name when it is whole. So a run that was ended goes on with `--resume`, which keeps what is newer than
its table.
"""

import glob
import os
import sys
from collections import Counter
from collections.abc import Callable, Iterator
from contextlib import closing
from functools import partial, reduce
from typing import NamedTuple

from ..errors import BadRequest, BadTable, JkrollError, MissingExtra, missing_extra
from ..rows.reasons import Tally
from ..text import quoted, say, say_wrapped
from .files import format_of_name
from .job import Job, Settings
from .run import convert_one

MAX_LINES = 6  # about tables, that are said on stderr
FEW, LITTLE = 8, 1 << 20  # number and bytes of files up to which this process converts them all itself
WAIT = 20.0  # seconds for a scheduler of Dask to answer, and then for it to have a worker


Part = tuple[str, str]  # a table, and the file that it becomes


class Outcome(NamedTuple):
    """The counts of a table, or why it failed as a whole."""

    tally: Tally
    problem: str = ""
    exit_code: int = 0


def is_many(path: str, settings: Settings) -> bool:
    """Return whether a path stands for several tables, or the output is a directory."""
    is_pattern = glob.has_magic(path) and not os.path.exists(path)
    return is_pattern or settings.target.endswith(os.sep)


def convert_many(path: str, job: Job) -> tuple[Tally, int]:
    """Convert the tables that a pattern names; return the counts, and the highest exit code of a table."""
    settings = job.settings
    parts = _parts_into(settings.target, path)
    left = [part for part in parts if not (settings.resume and _is_newer(part))]
    task = partial(_converted, job._replace(settings=settings._replace(jobs=1, quiet=True)))
    run = _on_cluster(settings.dask, task, left) if settings.dask else _by_processes(settings.processes, task, left)
    outcomes = dict(run)
    tally = reduce(Tally.plus, (outcomes[part].tally for part in left), Tally())
    if not settings.quiet:
        if kept := len(parts) - len(left):
            say(f"note: {kept} of {len(parts)} files are newer than their tables and were kept", sys.stderr)
        for line, count in Counter(tally.said).most_common(MAX_LINES):
            say_wrapped(line if count == len(left) else f"{line}: {count} of {len(left)} files", sys.stderr)
    for part in left:
        if problem := outcomes[part].problem:
            say(f"jkroll: {quoted(part[0])}: {problem}", sys.stderr)
    return tally, max((outcome.exit_code for outcome in outcomes.values()), default=0)


def _parts_into(directory: str, path: str) -> list[Part]:
    """Return the tables that a pattern names, and make the directory of their results; BadRequest if it can be none."""
    place = directory.rstrip(os.sep)
    is_table = directory == place and not os.path.exists(place) and format_of_name(place) is not None
    if directory == "-" or is_table or (os.path.exists(place) and not os.path.isdir(place)):
        raise BadRequest("several tables need a directory for the results: -o DIRECTORY/")
    paths = [path] if os.path.exists(path) else sorted(glob.glob(path))
    if not paths:
        raise BadTable(f"{quoted(path)}: no such file")
    targets = [os.path.join(directory, os.path.basename(table)) for table in paths]
    if len({*targets}) < len(paths):
        raise BadTable(f"{quoted(path)}: two tables have the same name")
    folders = {os.path.dirname(table) or "." for table in paths}
    if os.path.exists(directory) and any(os.path.samefile(folder, directory) for folder in folders):
        raise BadRequest(f"-o: {quoted(directory)} is where the input is; it is not overwritten")
    os.makedirs(directory, exist_ok=True)
    return [*zip(paths, targets, strict=True)]


def _is_newer(part: Part) -> bool:
    """Return whether the output of a table is newer than the table."""
    path, target = part
    return all(map(os.path.exists, part)) and os.stat(target).st_mtime_ns >= os.stat(path).st_mtime_ns


def _converted(job: Job, part: Part) -> Outcome:
    """Convert a table in this process; a failure is an outcome."""
    path, target = part
    try:
        return Outcome(convert_one(path, job._replace(settings=job.settings._replace(target=target))))
    except MissingExtra:
        raise  # as it would for every table
    except JkrollError as error:
        return Outcome(Tally(), str(error).removeprefix(f"{quoted(path)}: "), error.exit_code)


Task = Callable[[Part], Outcome]


def _by_processes(count: int, task: Task, parts: list[Part]) -> Iterator[tuple[Part, Outcome]]:
    """Convert tables by some processes; yield each as soon as it is done."""
    sizes = [os.path.getsize(path) for path, _ in parts if os.path.exists(path)]
    is_little = len(parts) <= FEW and sum(sizes) <= LITTLE  # less work than to start a process
    if min(count, len(parts)) < 2 or is_little:
        yield from ((part, task(part)) for part in parts)
        return
    from .workers import as_ready, started

    with started(min(count, len(parts)), task) as workers:
        yield from as_ready(workers, parts)


def _on_cluster(address: str, task: Task, parts: list[Part]) -> Iterator[tuple[Part, Outcome]]:
    """Convert tables by the workers of a Dask cluster, which give those of a lost one to others. Raises BadTable."""
    import logging

    with missing_extra("dask"):
        from distributed import Client, KilledWorker, as_completed
    for name in ("distributed", "distributed.worker", "distributed.scheduler", "tornado"):
        logging.getLogger(name).setLevel(logging.CRITICAL)
    try:
        client = Client(address, timeout=WAIT)
    except (OSError, ValueError):
        raise BadTable(f"--dask: no scheduler answers at {quoted(address)}") from None
    with closing(client):
        try:
            client.wait_for_workers(1, timeout=WAIT)
        except TimeoutError:
            raise BadTable(f"--dask: the scheduler at {quoted(address)} has no worker") from None
        # A worker opens a relative path in a directory of its own.
        tasks = {client.submit(task, tuple(map(os.path.abspath, part)), pure=False): part for part in parts}
        for future in as_completed([*tasks]):
            try:
                yield tasks[future], future.result()
            except KilledWorker as error:
                yield tasks[future], Outcome(Tally(), f"its worker ended {error.allowed_failures + 1} times", 1)
