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
    text: Callable[[int, str], str]  # the text of a row's cell for an input


class Results(NamedTuple):
    """An array of numbers for each quantity, nan where there is none, and the texts of each column of remarks, by row."""

    numbers: Floats
    remarks: dict[str, dict[int, str]]
    lost: set[int]  # rows without any trusted result

    @property
    def status(self) -> dict[int, str]:
        """The status of the rows that have one."""
        return self.remarks[STATUS]

    def first_failure(self, lines: Sequence[int]) -> tuple[int, str] | None:
        """Return the line and the status of the first row that fails. `lines`: those at which the rows begin."""
        first = min(self.lost, default=None)
        return None if first is None else (lines[first], self.status[first])

    @property
    def doubtful(self) -> int:
        """The number of rows that exceed a limit of the model."""
        return len(self.remarks.get(DOUBT, ()))
