"""The meaning of a name, and the range of its values."""

from collections.abc import Collection
from typing import NamedTuple


class Quantity(NamedTuple):
    """The meaning of a name, and the range of its values."""

    symbol: str
    unit: str  # SI; "1" for a number, "" for a text
    sentence: str
    equation: str = ""  # as the paper numbers it
    range: str = ""  # a name in RANGES, of the values that a user may give
    infinity: str = ""  # the word for an infinite value
    option: str = ""  # of the command line
    example: str = ""  # a value as a user types it
    note: str = ""  # the reason why it is shown beside another quantity
    definition: str = ""  # of one among several conventions: the factor, in units that are common to them
    reference: str = ""  # of a convention: the paper or code where it stands
    may_be_zero: bool = False  # a result of exactly 0 is its value, and no underflow
    shown_with: Collection[str] = ()  # inputs; it is shown only where one of them was stated
    hidden_with: Collection[str] = ()  # inputs; it is not shown where one of them was stated
    of_identical: bool = False  # shown for identical spheres only


class Range(NamedTuple):
    """An interval of values that a user may give, with the words for an error."""

    low: float
    high: float
    low_allowed: bool
    high_allowed: bool
    words: str

    def admits(self, value: float) -> bool:
        """Return whether a number lies in the range; nan lies in none."""
        above = value >= self.low if self.low_allowed else value > self.low
        below = value <= self.high if self.high_allowed else value < self.high
        return above and below
