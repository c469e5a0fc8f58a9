"""Many tables into a directory: a file for each, whole or not there, and a manifest when all are there.

Each file is the work of one call that depends on nothing but its arguments, so it does not matter who does it, or how often:
it takes its name only when it is whole. Where a run was interrupted, `--resume` leaves out what is done.
"""

import glob
import hashlib
import json
import os
import uuid
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from contextlib import suppress
from pathlib import Path
from typing import NamedTuple

from .. import __version__
from ..errors import BadRequest, JkrollError
from ..materials.library import known_materials
from ..text import quoted
from .errors import BadTable, missing_extra
from .files import BESIDE
from .settings import Order, Settings, Tally, input_format
from .spans import Span, spans_of

MANIFEST = "manifest.json"
DONE = ".done"  # a directory of what is done, until the manifest says it


class PartFailed(JkrollError):
    """A table among several that went wrong."""

    def __init__(self, path: str, problem: str, exit_code: int) -> None:
        super().__init__(path, problem, exit_code)
        self.path, self.problem, self.exit_code = path, problem, exit_code

    def __str__(self) -> str:
        return f"{quoted(self.path)}: {self.problem}"


class Part(NamedTuple):
    """One of the tables, or a part of one, and all that says what becomes of it."""

    path: str
    span: Span | None  # None: all of it
    target: str
    settings: Settings
    inputs: tuple[tuple[str, str], ...]
    materials: tuple[str, ...]

    @property
    def identity(self) -> str:
        """A hash of what the result depends on."""
        about = os.stat(self.path)
        settings = self.settings._replace(resume=False, jobs=0, dask="", quiet=False)
        materials = [Path(path).read_bytes().hex() for path in self.materials]
        told = [__version__, about.st_size, about.st_mtime_ns, self.span, settings, self.inputs, materials]
        return hashlib.sha256(json.dumps(told, sort_keys=True).encode()).hexdigest()


Runner = Callable[[list[Part]], Iterable[tuple[Part, Tally]]]


def is_many(path: str, settings: Settings) -> bool:
    """Whether a path stands for several tables, or the results are to be a directory."""
    return (
        (glob.has_magic(path) and not os.path.exists(path)) or settings.target.endswith(os.sep) or bool(settings.dask)
    )


def convert_part(part: Part) -> Tally:
    """Convert one table; its result gets its name when it is whole, however many try at once."""
    directory, name = os.path.split(part.target)
    beside = os.path.join(directory, f".{uuid.uuid4().hex}.{name}")
    settings = part.settings._replace(target=beside, resume=False)
    order = Order(settings, dict(part.inputs), known_materials(*part.materials))
    if input_format(part.path, settings).kind == "parquet":
        with missing_extra("parquet"):
            from .parquet import convert
    else:
        from .stream import convert
    try:
        tally = convert(part.path, order, part.span)
        os.replace(beside, part.target)
    except JkrollError as error:
        raise PartFailed(part.path, str(error), error.exit_code) from None
    finally:
        for left in (beside, *(beside + end for end in BESIDE)):
            with suppress(OSError):
                os.unlink(left)
    return tally


def one_by_one(parts: list[Part]) -> Iterator[tuple[Part, Tally]]:
    """The tables one after the other, each with all processes."""
    for part in parts:
        yield part, convert_part(part)


def convert(path: str, settings: Settings, inputs: Mapping[str, str], materials: tuple[str, ...], run: Runner) -> Tally:
    """Convert all tables that a pattern names."""
    directory = settings.target
    if directory == "-" or os.path.isfile(directory.rstrip(os.sep)):
        raise BadRequest("several tables need a directory for the results: -o DIRECTORY/")
    paths = sorted(glob.glob(path)) if glob.has_magic(path) else [path]
    if not paths:
        raise BadTable(f"{quoted(path)}: no such file")
    tables = [
        (one, name, span)
        for one in paths
        for name, span in _named(one, spans_of(one, settings) if settings.dask else [])
    ]
    names = [name for _, name, _ in tables]
    if len({*names}) < len(names):
        raise BadTable(f"{quoted(path)}: two tables have the same name")
    if os.path.exists(directory) and any(os.path.samefile(os.path.dirname(one) or ".", directory) for one in paths):
        raise BadRequest(f"-o: {quoted(directory)} is where the input is; it is not overwritten")
    os.makedirs(os.path.join(directory, DONE), exist_ok=True)
    with suppress(FileNotFoundError):
        os.unlink(os.path.join(directory, MANIFEST))
    parts = [
        Part(one, span, os.path.join(directory, name), settings, tuple(sorted(inputs.items())), materials)
        for one, name, span in tables
    ]
    tallies = {part: tally for part in parts if settings.resume and (tally := _done(part)) is not None}
    for part, tally in run([part for part in parts if part not in tallies] if tallies else parts):
        tallies[part] = tally
        _note(part, tally)
    return _finish(directory, [(part, tallies[part]) for part in parts])


def _named(path: str, spans: Sequence[Span]) -> list[tuple[str, Span | None]]:
    """What the results of a table are called: as the table, with a number if there are several."""
    name = os.path.basename(path)
    start, dot, end = name.partition(".")
    return [(f"{start}-{place:05}{dot}{end}", span) for place, span in enumerate(spans)] or [(name, None)]


def _note(part: Part, tally: Tally) -> None:
    """Remember that a part is done."""
    path = _note_of(part)
    with open(f"{path}.new", "w", encoding="utf-8") as file:
        json.dump([part.identity, *tally], file)
    os.replace(f"{path}.new", path)


def _note_of(part: Part) -> str:
    directory, name = os.path.split(part.target)
    return os.path.join(directory, DONE, name)


def _done(part: Part) -> Tally | None:
    """What became of a part that is done already."""
    try:
        with open(_note_of(part), encoding="utf-8") as file:
            identity, *tally = json.load(file)
    except (OSError, ValueError):
        return None
    return Tally(*tally) if identity == part.identity and os.path.exists(part.target) else None


def _finish(directory: str, done: list[tuple[Part, Tally]]) -> Tally:
    """Write the manifest, last of all, and take away what only an interrupted run needs."""
    total = Tally(sum(tally.rows for _, tally in done), sum(tally.failed for _, tally in done))
    files = [
        {"input": part.path, "output": os.path.basename(part.target), "rows": tally.rows, "failed": tally.failed}
        for part, tally in done
    ]
    manifest = {"version": __version__, "rows": total.rows, "failed": total.failed, "files": files}
    path = os.path.join(directory, MANIFEST)
    with open(f"{path}.partial", "w", encoding="utf-8") as file:
        json.dump(manifest, file, indent=2)
        file.write("\n")
        file.flush()
        os.fsync(file.fileno())
    os.replace(f"{path}.partial", path)
    for part, _ in done:
        with suppress(FileNotFoundError):
            os.unlink(_note_of(part))
    for name in os.listdir(directory):
        if name.startswith(".") and any(
            name.endswith(f".{os.path.basename(part.target)}{end}") for part, _ in done for end in ("", *BESIDE)
        ):
            os.unlink(os.path.join(directory, name))
    with suppress(OSError):
        os.rmdir(os.path.join(directory, DONE))
    return total
