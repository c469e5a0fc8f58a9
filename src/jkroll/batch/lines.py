"""The parts that formats whose records are lines have in common."""

from collections.abc import Callable, Iterator
from typing import Any, NamedTuple

from ..errors import BadTable
from ..rows.reasons import Tally

BOM = b"\xef\xbb\xbf"
MAX_RECORD = 1 << 24  # bytes
SAMPLE = 200  # rows that decide how a table is read
_COMPRESSED = {b"\x1f\x8b": "gz", b"\x28\xb5\x2f\xfd": "zst"}  # by the first bytes
_UTF_16 = (b"\xff\xfe", b"\xfe\xff")


class Head(NamedTuple):
    """The beginning of a table: the names of its columns, and what decides how they are read."""

    names: tuple[str, ...]
    sample: list[list[str]]  # the cells of the first rows
    writer: Any  # of the table with its results
    size: int = 0  # bytes, up to the end of the header
    lines: int = 0  # up to the end of the header
    preamble: int = 0  # lines above the header
    header: Any = b""  # as it is written, without its end
    has_decimal_commas: bool = False
    excel_safe: bool = False  # whether cells are written so that a spreadsheet takes no text for a formula


class Source(NamedTuple):
    """A table that is read in blocks."""

    form: Any  # which takes blocks apart, and writes them
    head: Head
    blocks: Iterator[Any]
    size: int  # of the input, 0 if it is unknown
    position: Callable[[int], int]  # how much of it was read, when so many rows are written


class Converted(NamedTuple):
    """A converted block, the number of lines that it was, and its counts."""

    output: Any
    lines: int
    tally: Tally = Tally()
    size: int = 0  # bytes of the output, where another process holds it


def check_encoding(text: bytes, name: str) -> None:
    """Refuse a table that is compressed or in UTF-16. `name`: of the format."""
    for mark, end in _COMPRESSED.items():
        if text.startswith(mark):
            ends = f"{name}.{end}"
            raise BadTable(f"the table is compressed; give it a name that ends in .{ends}, or write --format {ends}")
    if text.startswith(_UTF_16) or b"\0" in text.partition(b"\n")[0]:
        raise BadTable("the table is not UTF-8; save it as UTF-8")
