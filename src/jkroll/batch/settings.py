"""The options of a run, and the formats that follow from them."""

import hashlib
import json
import os
import sys
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import Any, NamedTuple

from .. import __version__
from ..materials.library import Materials
from ..table.errors import BadTable
from ..text import quoted, say
from .formats import CHUNK, Format, format_of, stated

MOST_PROCESSES = 16  # unless --jobs asks for more: one process reads for all of them


class Settings(NamedTuple):
    """The options, without those that describe a scene."""

    target: str = "-"
    format: str = ""
    quantities: str = ""
    strict: bool = False
    resume: bool = False
    jobs: int = 0
    excel_safe: bool = False
    dask: str = ""
    materials: str | None = None
    quiet: bool = False
    doubt: bool = True  # whether there is a column of doubts
    uncertainty: bool = False  # whether there are columns of uncertainties, though the first rows have none

    @property
    def processes(self) -> int:
        """Number of processes: `--jobs`, else one for each core that this process may use."""
        return self.jobs or min(_cores(), MOST_PROCESSES)


def _cores() -> int:
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1


@dataclass(frozen=True, eq=False)  # so that what is understood of a header can be kept by the order
class Order:
    """A run: the options, the inputs that fill the gaps of rows, and the known materials."""

    settings: Settings
    inputs: Mapping[str, str]
    known: Materials

    def identity(self, read: object) -> dict[str, str]:
        """Return a hash of each part that the result depends on; `read` identifies the input."""
        return self._given | fingerprint({"input": read})

    @cached_property
    def _given(self) -> dict[str, str]:
        options = self.settings._replace(resume=False, jobs=0, quiet=False, target="", dask="")
        return fingerprint(
            {
                "version": [__version__, CHUNK],
                "options": [options._asdict(), dict(self.inputs)],
                "materials file": [*map(str, self.known.materials.items())],
            }
        )


def fingerprint(parts: Mapping[str, Any]) -> dict[str, str]:
    """Return a hash of each part."""
    return {
        name: hashlib.sha256(json.dumps(value, sort_keys=True, default=str).encode()).hexdigest()[:32]
        for name, value in parts.items()
    }


def input_format(path: str, settings: Settings) -> Format:
    """Return the format of the input."""
    if settings.format:
        return stated(settings.format)
    found = format_of(path if path != "-" else settings.target)
    if found is not None:
        return found
    if path == "-":
        return Format("csv")
    if os.path.isdir(path):
        raise BadTable(f"{quoted(path)} is a directory; name its tables, as in {quoted(os.path.join(path, '*.csv'))}")
    raise BadTable(f"{quoted(path)}: its name says no format; give --format csv, tsv, ndjson or parquet")


def output_format(settings: Settings, of_input: Format) -> Format:
    """Return the format of the output: that of its name, else that of the input without compression."""
    found = format_of(settings.target)
    if found is None:
        return unnamed(settings, of_input.kind)
    if found.kind != of_input.kind:
        name = os.path.basename(settings.target).partition(".")[0]
        raise BadTable(
            f"-o: a table of {of_input.kind} stays one; write {quoted(f'{name}.{of_input.kind}')}, and convert it with another program"
        )
    return found


def unnamed(settings: Settings, kind: str) -> Format:
    """Return the format of an output whose name says none, and say which one it is where the name ends as if it said one."""
    if os.path.splitext(settings.target)[1] and not settings.quiet:
        say(f"note: {quoted(settings.target)} is written as {kind}: its name says no format", sys.stderr)
    return Format(kind)
