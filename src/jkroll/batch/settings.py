"""What the options of a batch say, and the formats that follow from them."""

import os
from collections.abc import Mapping, Sequence
from typing import NamedTuple

from ..materials.library import Materials
from ..text import quoted
from .errors import BadTable
from .formats import Format, format_of, stated


class Settings(NamedTuple):
    """The options, but for those that describe a scene."""

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

    @property
    def processes(self) -> int:
        """How many are to work."""
        return self.jobs or os.cpu_count() or 1


class Order(NamedTuple):
    """All that was said of a run: the options, what fills the gaps of rows, and the materials that are known."""

    settings: Settings
    inputs: Mapping[str, str]
    known: Materials

    def parts(self, version: Sequence[object], read: Sequence[int]) -> dict[str, object]:
        """What the result depends on: the version of all that makes it, the identity of the input, and what was said."""
        options = self.settings._replace(resume=False, jobs=0, quiet=False, target="")
        return {
            "version": version,
            "input": read,
            "options": [options._asdict(), dict(self.inputs)],
            "materials file": [*map(str, self.known.materials.items())],
        }


class Tally(NamedTuple):
    """What became of the rows."""

    rows: int
    failed: int


def input_format(path: str, settings: Settings) -> Format:
    """The format of the input."""
    if settings.format:
        return stated(settings.format)
    found = format_of(path if path != "-" else settings.target)
    if found is not None:
        return found
    if path == "-":
        return Format("csv")
    raise BadTable(f"{quoted(path)}: its name says no format; give --format csv, tsv, ndjson or parquet")


def output_format(settings: Settings, of_input: Format) -> Format:
    """The format of the output: as its name says, else that of the input without compression."""
    found = format_of(settings.target)
    if found is None:
        return Format(of_input.kind)
    if found.kind != of_input.kind:
        raise BadTable(f"-o: a table of {of_input.kind} is written as {of_input.kind}, not as {found.kind}")
    return found
