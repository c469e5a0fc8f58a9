"""The interface of formats whose records are lines."""

from typing import NamedTuple, Protocol

from .blocks import Tally
from .task import Task

BOM = b"\xef\xbb\xbf"


class Converted(NamedTuple):
    """A converted block and its counts."""

    output: bytes
    lines: int
    tally: Tally = Tally()


class Head(NamedTuple):
    """The beginning of a table."""

    text: bytes  # the header line; empty where the format has none
    names: tuple[str, ...]


class Converter(Protocol):
    """Converts blocks of records."""

    head: bytes  # first bytes of the output

    def convert(self, text: bytes) -> Converted:
        """Return whole records with their results."""


class LineFormat(Protocol):
    """A format whose records are lines."""

    def cut(self, text: bytes) -> int:
        """Return the number of bytes of whole records at the beginning of a text."""

    def head(self, text: bytes) -> tuple[Head, list[list[str]]]:
        """Return the beginning of a table, and the cells of its first rows. Raises BadTable."""

    def converter(self, head: Head, task: Task, *, excel_safe: bool) -> Converter:
        """Return the converter of the blocks after the head."""
