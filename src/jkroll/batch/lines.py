"""The parts that formats whose records are lines have in common."""

from collections import Counter
from collections.abc import Callable, Iterator, Mapping, Sequence
from typing import Any, NamedTuple

import numpy

from ..errors import BadTable
from ..rows.cells import Floats, Numbers
from ..rows.columns import Columns
from ..rows.infer import Unknowns
from ..rows.reasons import Gaps, joined
from ..scene.limits import CODES, NOT_JUDGED, codes

BOM = b"\xef\xbb\xbf"
MAX_RECORD = 1 << 24  # bytes
SAMPLE = 200  # rows that decide how a table is read
_COMPRESSED = {b"\x1f\x8b": "gz", b"\x28\xb5\x2f\xfd": "zst"}  # by the first bytes
_UTF_16 = (b"\xff\xfe", b"\xfe\xff")

_NONE: Counter[str] = Counter()
_NO_GAPS: Mapping[str, Gaps] = {}  # which can be pickled
_NO_NUMBERS: Mapping[str, Numbers] = {}


class Tally(NamedTuple):
    """The rows of a run, and those of them that failed, have empty cells, exceed a limit, or cannot be judged."""

    rows: int = 0
    failed: int = 0
    gaps: Mapping[str, Gaps] = _NO_GAPS  # rows with empty cells, by their status
    doubtful: int = 0
    not_judged: int = 0  # for some limit
    codes: Counter[str] = _NONE  # of doubts, by their rows
    inferred: tuple[Floats, ...] = ()  # the values of the unknown, in parts
    said: tuple[str, ...] = ()  # of each table as a whole

    @classmethod
    def of(cls, columns: Columns) -> "Tally":
        """Return the counts of some rows."""
        bits = numpy.asarray(columns.doubts)
        doubts, not_judged = bits & ~NOT_JUDGED, int(numpy.count_nonzero(bits & NOT_JUDGED))
        doubtful, of_codes = int(numpy.count_nonzero(doubts)), _rows_of_codes(doubts)
        wanted = columns.wanted
        inferred = (numpy.asarray(columns.column(wanted.names[0])).copy(),) if isinstance(wanted, Unknowns) else ()
        failed = len(columns.failed)
        return cls(len(columns), failed, columns.gaps(), doubtful, not_judged, of_codes, inferred)

    def plus(self, other: "Tally") -> "Tally":
        """Return the counts with those of some more rows."""
        return Tally(
            self.rows + other.rows,
            self.failed + other.failed,
            joined(self.gaps, other.gaps, self.rows),
            self.doubtful + other.doubtful,
            self.not_judged + other.not_judged,
            self.codes + other.codes,
            self.inferred + other.inferred,
            self.said + other.said,
        )

    def most_frequent_codes(self) -> list[tuple[str, int]]:
        """Return the codes of doubts with their numbers of rows, the most frequent first, then those that matter most."""
        return sorted(self.codes.items(), key=lambda item: (-item[1], CODES.index(item[0])))


def _rows_of_codes(bits: Any) -> Counter[str]:
    """Return in how many rows each code of a doubt stands."""
    every = int(numpy.bitwise_or.reduce(bits))
    each = (1 << place for place in range(every.bit_length()) if every >> place & 1)
    return Counter({codes(bit): int(numpy.count_nonzero(bits & bit)) for bit in each})


class Head(NamedTuple):
    """The beginning of a table: the names of its columns, and what decides how they are read."""

    names: tuple[str, ...]
    sample: list[list[str]]  # the cells of the first rows
    size: int = 0  # bytes, up to the end of the header
    lines: int = 0  # up to the end of the header
    preamble: int = 0  # lines above the header
    header: Any = b""  # as it is written, without its end
    end: str = "\n"  # of lines
    has_decimal_commas: bool = False
    excel_safe: bool = False  # whether cells are written so that a spreadsheet takes no text for a formula


class Records(NamedTuple):
    """A block of a table, taken apart."""

    before: Any  # what stands before the results of each row; blank lines above a row belong to it
    cells: Mapping[str, Sequence[bytes]]  # by the name of the column
    odd: Mapping[int, str]  # records that are no rows, and why
    starts: Sequence[int]  # the line in the block at which each begins
    size: int  # lines in the block
    rest: bytes = b""  # blank lines behind the last row
    numbers: Mapping[str, Numbers] = _NO_NUMBERS  # columns that are numbers already


class Source(NamedTuple):
    """A table that is read in blocks."""

    form: Any  # which takes blocks apart, and writes them
    head: Head
    blocks: Iterator[Any]
    size: int  # of the input, 0 if it is unknown
    position: Callable[[], int]  # how much of it was read


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
