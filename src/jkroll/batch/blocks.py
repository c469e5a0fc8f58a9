"""Blocks of rows: the cells that go into an evaluation, and the results that come out of it."""

from collections.abc import Callable, Mapping, Sequence
from typing import NamedTuple

from .cells import Floats, Numbers
from .columns import DOUBT, STATUS
from .materials import Codes


class Block(NamedTuple):
    """The cells of a block of rows, by the name of the input."""

    size: int
    numbers: Mapping[str, Numbers]
    materials: Mapping[str, Sequence[bytes | str] | Codes]  # texts, or numbers of the lookup
    odd: Mapping[int, str]  # records that are no rows, and why
    lines: Sequence[int]  # at which the rows begin
    text: Callable[[int, str], str]  # the text of a row's cell for an input


class Tally(NamedTuple):
    """The rows of a run, and those of them that failed or exceed a limit of the model."""

    rows: int = 0
    failed: int = 0
    doubtful: int = 0


class Results(NamedTuple):
    """An array of numbers for each quantity, nan where there is none, and the texts of each column of remarks, by row."""

    numbers: Floats
    remarks: dict[str, dict[int, str]]
    lost: set[int]  # rows without any trusted result

    @property
    def status(self) -> dict[int, str]:
        """The status of the rows that have one."""
        return self.remarks[STATUS]

    @property
    def tally(self) -> Tally:
        """The counts of the rows."""
        return Tally(self.numbers.shape[1], len(self.lost), len(self.remarks.get(DOUBT, ())))
