"""Blocks of rows: the cells that go into an evaluation, and the results that come out of it."""

from collections.abc import Callable, Mapping, Sequence
from typing import NamedTuple

import numpy

from .cells import Floats, Numbers
from .columns import DOUBT, STATUS
from .materials import Codes
from .task import Task


class Block(NamedTuple):
    """The cells of a block of rows, by the name of the input."""

    size: int
    numbers: Mapping[str, Numbers]
    materials: Mapping[str, Codes]  # numbers of the lookup
    odd: Mapping[int, str]  # records that are no rows, and why
    lines: Sequence[int]  # at which the rows begin
    text: Callable[[int, str], str]  # the text of a row's cell for an input


class Tally(NamedTuple):
    """The rows of a run, and those of them that failed or exceed a limit of the model."""

    rows: int = 0
    failed: int = 0
    doubtful: int = 0


class Results:
    """The results of rows: numbers, nan where there is none, and by row the texts of the columns after them."""

    def __init__(self, task: Task, size: int) -> None:
        """Begin without any results."""
        self.task = task
        self.numbers: Floats = numpy.full((len(task.headers), size), numpy.nan)  # an array for each column
        self.status: dict[int, str] = {}
        self.doubts: dict[int, str] = {}
        texts = {DOUBT: self.doubts, STATUS: self.status}
        self.remarks = {name: texts[name] for name in task.remarks}  # the columns of texts
        self.lost: set[int] = set()  # rows without any trusted result

    @property
    def values(self) -> Floats:
        """The numbers without those of uncertainties: an array for each quantity."""
        return self.numbers[:: 1 + len(self.task.sides)]

    @property
    def tally(self) -> Tally:
        """The counts of the rows."""
        return Tally(self.numbers.shape[1], len(self.lost), len(self.doubts))

    def put(self, rows: Codes, found: "Results") -> None:
        """Take the results of some rows."""
        self.numbers[:, rows] = found.numbers
        row_at = rows.tolist().__getitem__
        for texts, own in ((self.status, found.status), (self.doubts, found.doubts)):
            texts.update(zip(map(row_at, own), own.values(), strict=True))
        self.lost.update(map(row_at, found.lost))

    def lose(self, row: int, status: str, *, keeps: bool = False) -> None:
        """Note that no result of a row is to be trusted. They go, unless it keeps them."""
        if not keeps:
            self.numbers[:, row] = numpy.nan
        self.lost.add(row)
        self.status[row] = status
