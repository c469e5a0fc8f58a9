"""Many tables into a directory: a file for each, and a manifest when the run has ended.

A file is the work of one process, and gets its name when it is whole. The manifest has a journal as a table has: every file that
is done or fails is added to it, so that `--resume` leaves out what is done.
"""

import glob
import hashlib
import json
import os
import sys
from collections.abc import Callable, Iterable, Iterator
from contextlib import closing, suppress
from dataclasses import replace
from functools import partial
from typing import Any, NamedTuple

from .. import __version__
from ..errors import BadRequest, JkrollError, MissingExtra
from ..table.blocks import Tally
from ..table.errors import BadTable
from ..text import quoted, say
from .errors import missing_extra
from .journal import Journal
from .settings import Order, Settings, input_format
from .source import Part, Span

MANIFEST = "manifest.json"
MOST_SAID = 20  # files whose failure is said on stderr; the manifest has them all
FEW, LITTLE = 8, 1 << 20  # number and bytes of files up to which this process converts them all itself

Entry = dict[str, Any]  # of a part, in the journal and the manifest


class Done(NamedTuple):
    """The outcome of a part: its counts, or why it failed as a whole."""

    tally: Tally
    problem: str = ""
    exit_code: int = 0


Runner = Callable[[Order, list[Part], int], Iterable[tuple[Part, Done]]]  # the number: of processes


def is_many(path: str, settings: Settings) -> bool:
    """Return whether a path stands for several tables, or the output is a directory."""
    is_pattern = glob.has_magic(path) and not os.path.exists(path)
    return is_pattern or settings.target.endswith(os.sep) or bool(settings.dask)


def convert_one(part: Part, order: Order) -> Tally:
    """Convert a table of any format, or a part of one."""
    if input_format(part.path, order.settings).kind == "parquet":
        with missing_extra("parquet"):
            from .parquet import convert
    else:
        from .stream import convert
    return convert(part, order)


def convert_part(order: Order, part: Part) -> Done:
    """Convert a part in this process; a failure is an outcome."""
    try:
        return Done(convert_one(part, order))
    except MissingExtra:
        raise  # as it would for every part
    except JkrollError as error:
        problem = str(error).removeprefix(f"{quoted(part.path)}: ")
        return Done(Tally(), problem, error.exit_code)


def by_processes(order: Order, parts: list[Part], jobs: int) -> Iterator[tuple[Part, Done]]:
    """Convert parts by a number of processes; yield each part as soon as it is done."""
    jobs = min(jobs, len(parts))
    if jobs < 2 or _is_little(parts):
        for part in parts:
            yield part, convert_part(order, part)
        return
    from .workers import as_ready, started

    with started(jobs, partial(_answering, order)) as workers:
        yield from as_ready(workers, parts)


def _is_little(parts: list[Part]) -> bool:
    """Return whether to convert some files takes less time than to start a process."""
    sizes = [os.path.getsize(part.path) for part in parts if os.path.exists(part.path)]
    return len(parts) <= FEW and sum(sizes) <= LITTLE


def _answering(order: Order) -> Callable[[Part], Done]:
    return partial(convert_part, order)


def convert(path: str, order: Order, run: Runner) -> tuple[Tally, int]:
    """Convert all tables that a pattern names; return the counts, and the highest exit code of a table."""
    settings = order.settings
    directory = settings.target
    if directory == "-" or os.path.isfile(directory.rstrip(os.sep)):
        raise BadRequest("several tables need a directory for the results: -o DIRECTORY/")
    parts = _parts(path, settings)
    folders = {os.path.dirname(part.path) or "." for part in parts}
    if os.path.exists(directory) and any(os.path.samefile(folder, directory) for folder in folders):
        raise BadRequest(f"-o: {quoted(directory)} is where the input is; it is not overwritten")
    os.makedirs(directory, exist_ok=True)
    manifest = os.path.join(directory, MANIFEST)
    options = json.dumps(order.identity([]), sort_keys=True)
    identities = {part: _identity(options, part) for part in parts}
    before = _listed(manifest)  # also without --resume: a file that is not ours is refused
    code = 0
    with closing(Journal(manifest, f"{manifest}.partial")) as journal:
        before |= {entry["identity"]: entry for entry in journal.lines()[1:]}
        entries: dict[Part, Entry] = {}
        if settings.resume:
            entries = {part: before[name] for part, name in identities.items() if _is_done(before.get(name), part)}
            if len(entries) == len(parts):
                say(f"note: all {len(parts)} files are done; without --resume they are made anew", sys.stderr)
        journal.begin({})
        journal.add(*entries.values())
        with suppress(FileNotFoundError):
            os.unlink(manifest)
        each = replace(order, settings=settings._replace(resume=False, jobs=1, quiet=True))
        left = [part for part in parts if part not in entries]
        for part, done in run(each, left, settings.processes):
            entries[part] = _entry(part, done, identities[part])
            journal.add(entries[part])
            code = max(code, done.exit_code)
        tally = _write(manifest, [entries[part] for part in parts])
        journal.remove()
    return tally, code


def _parts(path: str, settings: Settings) -> list[Part]:
    """Return the tables that a pattern names; with `--dask`, parts of those that are large."""
    paths = sorted(glob.glob(path)) if glob.has_magic(path) else [path]
    if not paths:
        raise BadTable(f"{quoted(path)}: no such file")
    parts = [part for one in paths for part in _parts_of(one, settings)]
    if len({part.target for part in parts}) < len(parts):
        raise BadTable(f"{quoted(path)}: two tables have the same name")
    return parts


def _parts_of(path: str, settings: Settings) -> Iterator[Part]:
    """Iterate over the parts of a table. They are named as the table, with a number if there are several."""
    name = os.path.basename(path)
    start, dot, end = name.partition(".")
    spans = _spans_of(path, settings) if settings.dask else []
    if len(spans) < 2:
        yield Part(path, os.path.join(settings.target, name))
        return
    for place, span in enumerate(spans):
        yield Part(path, os.path.join(settings.target, f"{start}-{place:05}{dot}{end}"), span)


def _spans_of(path: str, settings: Settings) -> list[Span]:
    form = input_format(path, settings)
    if form.compression or not os.path.isfile(path):
        return []
    if form.kind == "parquet":
        with missing_extra("parquet"):
            from .parquet import spans_of
        return spans_of(path)
    from .stream import spans_of as spans_of_lines

    return spans_of_lines(path, form.kind)


def _identity(options: str, part: Part) -> str:
    """Return a hash of all that the result of a part depends on."""
    try:
        about = os.stat(part.path)
    except OSError:
        return ""
    read = [about.st_size, about.st_mtime_ns, part.path, part.span]
    return hashlib.sha256((options + json.dumps(read)).encode()).hexdigest()[:32]


def _listed(manifest: str) -> dict[str, Entry]:
    """Return the entries of a manifest by their identity. Raises BadRequest for a file that is not ours."""
    try:
        with open(manifest, encoding="utf-8") as file:
            found = json.load(file)
        if found.keys() == {"version", *Tally._fields, "files"}:
            return {entry["identity"]: entry for entry in found["files"]}
    except FileNotFoundError:
        return {}
    except (ValueError, AttributeError, TypeError, KeyError):
        pass
    raise BadRequest(f"-o: {quoted(manifest)} is not a manifest of jkroll; it is not replaced: move it away")


def _is_done(entry: Entry | None, part: Part) -> bool:
    """Return whether a part is done already."""
    if entry is None or "problem" in entry or not os.path.exists(part.target):
        return False
    return bool(os.path.getsize(part.target) == entry["bytes"])


def _entry(part: Part, done: Done, identity: str) -> Entry:
    entry = {
        "input": part.path,
        "output": os.path.basename(part.target),
        "bytes": 0 if done.problem else os.path.getsize(part.target),
        **done.tally._asdict(),
        "identity": identity,
    }
    return entry | ({"problem": done.problem} if done.problem else {})


def _write(manifest: str, entries: list[Entry]) -> Tally:
    """Write the manifest, last of all, and say which files failed."""
    total = Tally(*(sum(entry[name] for entry in entries) for name in Tally._fields))
    with open(f"{manifest}.partial", "w", encoding="utf-8") as file:
        json.dump({"version": __version__, **total._asdict(), "files": entries}, file, indent=2)
        file.write("\n")
        file.flush()
        os.fsync(file.fileno())
    os.replace(f"{manifest}.partial", manifest)
    failures = [entry for entry in entries if "problem" in entry]
    for entry in failures[:MOST_SAID]:
        say(f"jkroll: {quoted(entry['input'])}: {entry['problem']}", sys.stderr)
    if len(failures) > MOST_SAID:
        say(f"jkroll: and {len(failures) - MOST_SAID} more files failed; {quoted(manifest)} says why", sys.stderr)
    return total
