"""Many tables into a directory: a file for each, and a manifest of the run.

A file is the work of one process, and gets its name when it is whole. The manifest says with which options and which
version the files were made, and what became of each that is done: `--resume` goes on from there. It is written before
the first of them, and completed after the last.
"""

import glob
import hashlib
import json
import os
import sys
from collections import Counter
from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import replace
from functools import partial, reduce
from time import perf_counter
from types import MappingProxyType
from typing import Any, NamedTuple

from .. import __version__
from ..errors import BadRequest, JkrollError, MissingExtra
from ..output.files import whole_file
from ..rows.header import BadTable
from ..text import quoted, say, say_wrapped
from .formats import format_of_name
from .lines import Tally
from .one import convert_one
from .settings import Job, Part, Settings

MANIFEST = "manifest.json"
MAX_LINES = 6  # about tables, that are said on stderr
MAX_SAID = 20  # files whose failure is said on stderr; the manifest has them all
_REST = 20  # between two writes of the manifest, in the time that one takes
FEW, LITTLE = 8, 1 << 20  # number and bytes of files up to which this process converts them all itself

Entry = dict[str, Any]  # of a file, in the manifest


class Done(NamedTuple):
    """The outcome of a part: its counts, or why it failed as a whole."""

    tally: Tally
    problem: str = ""
    exit_code: int = 0


Runner = Callable[[Job, list[Part], int], Iterable[tuple[Part, Done]]]  # the number: of processes


def is_many(path: str, settings: Settings) -> bool:
    """Return whether a path stands for several tables, or the output is a directory."""
    is_pattern = glob.has_magic(path) and not os.path.exists(path)
    return is_pattern or settings.target.endswith(os.sep)


def convert_part(job: Job, part: Part) -> Done:
    """Convert a part in this process; a failure is an outcome."""
    try:
        return Done(convert_one(part, job))
    except MissingExtra:
        raise  # as it would for every part
    except JkrollError as error:
        problem = str(error).removeprefix(f"{quoted(part.path)}: ")
        return Done(Tally(), problem, error.exit_code)


def by_processes(job: Job, parts: list[Part], processes: int) -> Iterator[tuple[Part, Done]]:
    """Convert parts by a number of processes; yield each part as soon as it is done."""
    processes = min(processes, len(parts))
    if processes < 2 or _is_little(parts):
        for part in parts:
            yield part, convert_part(job, part)
        return
    from .workers import as_ready, started

    with started(processes, partial(_answering, job)) as workers:
        yield from as_ready(workers, parts)


def _is_little(parts: list[Part]) -> bool:
    """Return whether to convert some files takes less time than to start a process."""
    sizes = [os.path.getsize(part.path) for part in parts if os.path.exists(part.path)]
    return len(parts) <= FEW and sum(sizes) <= LITTLE


def _answering(job: Job) -> Callable[[Part], Done]:
    return partial(convert_part, job)


def convert_many(path: str, job: Job, run: Runner) -> tuple[Tally, int]:
    """Convert all tables that a pattern names; return the counts, and the highest exit code of a table."""
    settings = job.settings
    parts = _parts_into(settings.target, path)
    manifest = Manifest(job, parts)
    left = [part for part in parts if part.path not in manifest.entries]
    if not left and not settings.quiet:
        say(f"note: all {len(parts)} files are done; without --resume they are made anew", sys.stderr)
    each = replace(job, settings=settings._replace(resume=False, jobs=1, quiet=True))
    code = 0
    tally = reduce(Tally.plus, map(_tally, manifest.entries.values()), Tally())
    try:
        for part, outcome in run(each, left, settings.processes):
            manifest.add(part, outcome)
            tally = tally.plus(outcome.tally)
            code = max(code, outcome.exit_code)
    except BaseException:
        manifest.write()
        raise
    manifest.write(tally.counts())
    if not settings.quiet:
        for line, count in Counter(tally.said).most_common(MAX_LINES):
            say_wrapped(line if count == len(parts) else f"{line}: {count} of {len(parts)} files", sys.stderr)
    _say_failures(manifest)
    return tally, code


def _parts_into(directory: str, path: str) -> list[Part]:
    """Return the tables that a pattern names, and make the directory of their results; BadRequest if it can be none."""
    place = directory.rstrip(os.sep)
    is_table = directory == place and not os.path.exists(place) and format_of_name(place) is not None
    if directory == "-" or is_table or (os.path.exists(place) and not os.path.isdir(place)):
        raise BadRequest("several tables need a directory for the results: -o DIRECTORY/")
    parts = _parts(path, directory)
    folders = {os.path.dirname(part.path) or "." for part in parts}
    if os.path.exists(directory) and any(os.path.samefile(folder, directory) for folder in folders):
        raise BadRequest(f"-o: {quoted(directory)} is where the input is; it is not overwritten")
    os.makedirs(directory, exist_ok=True)
    return parts


class Manifest:
    """The record of how a directory of results was made: version, options, and the outcome of each table that is done."""

    def __init__(self, job: Job, parts: list[Part]) -> None:
        """Write it, with the outcomes of before that `--resume` keeps. Raises BadRequest for the manifest of another run."""
        directory = job.settings.target
        self.path, self.parts = os.path.join(directory, MANIFEST), parts
        self.about: dict[str, Any] = {"version": __version__, "options": _options(job)}
        self.entries: dict[str, Entry] = {}  # by the path of the table
        before = _read(self.path)
        begun = 0  # when the first of the files that are kept can have been made, by the clock that dates files
        if job.settings.resume and before:
            if changed := [name for name, value in self.about.items() if before.get(name) != value]:
                other = "another version" if "version" in changed else "other options"
                raise BadRequest(
                    f"--resume: {quoted(directory)} was made with {other}; without --resume it is made anew"
                )
            begun = before.get("begun") or os.stat(self.path).st_mtime_ns
            done = {entry["input"]: entry for entry in before["files"]}
            self.entries = {
                part.path: done[part.path] for part in parts if part.path in done and _is_newer(part, begun)
            }
        self.write({"begun": begun} if begun else {})
        self.about["begun"] = begun or os.stat(self.path).st_mtime_ns

    def add(self, part: Part, outcome: Done) -> None:
        """Add the outcome of a table, and write it unless that takes more than a little of the time."""
        entry: Entry = {"input": part.path, "output": os.path.basename(part.target), **outcome.tally.counts()}
        self.entries[part.path] = entry | ({"problem": outcome.problem} if outcome.problem else {})
        if perf_counter() > self.due:
            self.write()

    @property
    def files(self) -> list[Entry]:
        """The outcomes in the order of the tables."""
        return [self.entries[part.path] for part in self.parts if part.path in self.entries]

    def write(self, more: Mapping[str, Any] = MappingProxyType({})) -> None:
        """Write what is known; `more`: of all files together."""
        begun = perf_counter()
        with whole_file(self.path) as file:
            file.write(json.dumps({**self.about, **more, "files": self.files}, indent=2).encode() + b"\n")
        self.due = perf_counter() + _REST * (perf_counter() - begun)


def _tally(entry: Entry) -> Tally:
    """Return the counts of an entry."""
    return Tally(**{name: type(none)(entry.get(name, none)) for name, none in Tally().counts().items()})


def _options(job: Job) -> dict[str, Any]:
    """Return the options that decide on the results, and the materials files with their contents."""
    plain = job.settings._replace(resume=False, jobs=0, quiet=False, target=Settings().target, dask="")
    chosen = {name: value for name, value in plain._asdict().items() if value != getattr(Settings(), name)}
    if job.settings.columns:
        chosen["columns"] = [*job.settings.columns]  # as JSON has them
    return {**chosen, "inputs": dict(job.inputs), "materials": {path: _digest(path) for path in job.known.paths}}


def _digest(path: str) -> str:
    """Return what tells the content of a file from that of another."""
    with open(path, "rb") as file:
        return hashlib.sha256(file.read()).hexdigest()


def _parts(path: str, directory: str) -> list[Part]:
    """Return the tables that a pattern names."""
    paths = [path] if os.path.exists(path) else sorted(glob.glob(path))
    if not paths:
        raise BadTable(f"{quoted(path)}: no such file")
    parts = [Part(one, os.path.join(directory, os.path.basename(one))) for one in paths]
    if len({part.target for part in parts}) < len(parts):
        raise BadTable(f"{quoted(path)}: two tables have the same name")
    return parts


def _is_newer(part: Part, begun: int) -> bool:
    """Return whether the output of a table is newer than its input and than the beginning of the run: an older one has other options."""
    try:
        return os.stat(part.target).st_mtime_ns >= max(begun, os.stat(part.path).st_mtime_ns)
    except OSError:
        return False


def _read(manifest: str) -> dict[str, Any]:
    """Return a manifest; an empty one if there is none. Raises BadRequest for a file that is not ours."""
    try:
        with open(manifest, encoding="utf-8") as file:
            found = json.load(file)
        if found.keys() >= {"version", "options", "files"} and all("input" in entry for entry in found["files"]):
            for entry in found["files"]:
                _tally(entry)  # raises ValueError or TypeError for a count that is none
            return dict(found)
    except FileNotFoundError:
        return {}
    except (ValueError, AttributeError, LookupError, TypeError, RecursionError):
        pass
    raise BadRequest(f"-o: {quoted(manifest)} is not a manifest of jkroll; it is not replaced: move it away")


def _say_failures(manifest: Manifest) -> None:
    failures = [entry for entry in manifest.files if "problem" in entry]
    for entry in failures[:MAX_SAID]:
        say(f"jkroll: {quoted(entry['input'])}: {entry['problem']}", sys.stderr)
    if len(failures) > MAX_SAID:
        said = f"jkroll: and {len(failures) - MAX_SAID} more files failed; {quoted(manifest.path)} says why"
        say(said, sys.stderr)
