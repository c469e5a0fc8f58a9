"""What the formats whose records are lines have in common."""

from collections.abc import Sequence
from typing import Any, NamedTuple, Protocol

from .columns import Header
from .single import Task

BOM = b"\xef\xbb\xbf"


class Converted(NamedTuple):
    """A block as it is written, and what is to be known of it."""

    output: Any  # bytes, or a table of Parquet
    rows: int
    failed: int
    lines: int
    first_failure: tuple[int, str] | None  # line in the block, status


class Head(NamedTuple):
    """What stands at the beginning of a table."""

    text: bytes  # that is no row
    names: tuple[str, ...]
    sample: list[list[str]]  # cells of the first rows


class Converter(Protocol):
    """Turns blocks of records into blocks of records with results."""

    head: bytes  # what the output begins with

    def convert(self, text: bytes) -> Converted:
        """Whole records with their results."""


class LineFormat(Protocol):
    """A format whose records are lines."""

    def cut(self, text: bytes, *, is_end: bool) -> int:
        """How many bytes of a text are whole records."""

    def head(self, text: bytes) -> Head:
        """The beginning of a table; BadTable if it has none."""

    def converter(self, head: Head, header: Header, task: Task, names: Sequence[str], *, excel_safe: bool) -> Converter:
        """What converts the blocks after it; `names` head the results."""
