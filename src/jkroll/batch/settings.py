"""The options of a run."""

import os
from collections.abc import Mapping
from dataclasses import dataclass
from typing import NamedTuple

from ..materials.library import Materials

MAX_PROCESSES = 16  # unless --jobs asks for more: one process reads for all of them


class Settings(NamedTuple):
    """The options, without those that describe a scene."""

    target: str = "-"
    format: str = ""
    delimiter: str = ""
    quantities: str = ""
    strict: bool = False
    resume: bool = False  # of many files: whether those that are done stay
    jobs: int = 0
    excel_safe: bool = False
    dask: str = ""
    quiet: bool = False
    columns: tuple[str, ...] = ()  # what headers mean, as `--column` has it
    doubt: bool = True  # whether there is a column of doubts
    alternatives: bool = False  # whether there are columns of the results under the other law
    infer: str = ""  # the input that is sought
    measured: str = ""  # the quantity from which it follows, whose measured values a column has
    uncertainty: bool = False  # whether there are columns of uncertainties, though the first rows have none

    @property
    def processes(self) -> int:
        """Number of processes: `--jobs`, else one for each core that this process may use."""
        return self.jobs or min(_cores(), MAX_PROCESSES)


def _cores() -> int:
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1


class Part(NamedTuple):
    """A table and the file that it becomes."""

    path: str
    target: str


@dataclass(frozen=True, eq=False)  # compared by identity, so that `_fill` can cache for each job
class Job:
    """A run: the options, the inputs that fill the gaps of rows, and the known materials."""

    settings: Settings
    inputs: Mapping[str, str]
    known: Materials
