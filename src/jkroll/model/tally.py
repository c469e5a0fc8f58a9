"""The counts of rows: how many a run has, how many failed or have empty cells, and how many exceed which limits."""

from collections import Counter
from collections.abc import Callable, Iterable, Iterator, Mapping
from typing import Any, NamedTuple

from .limits import BITS
from .results import has_code
from .rows import Columns, faults_of, worded

_NO_DOUBTS: Counter[int] = Counter()
_NO_FAULTS: Mapping[str, "Fault"] = {}  # can be pickled, unlike a MappingProxyType


class Fault(NamedTuple):
    """The rows whose empty cells have the same faults."""

    rows: int  # their number
    first: int  # the number of the first row, from 1
    words: str  # the reasons of the first row in full


class Tally(NamedTuple):
    """The number of rows of a run, and how many failed, have empty cells, or exceed limits."""

    rows: int = 0
    failed: int = 0
    gaps: Mapping[str, Fault] = _NO_FAULTS  # rows with empty cells, by their faults
    doubts: Counter[int] = _NO_DOUBTS  # numbers of rows, by the bits of their doubts
    inferred: tuple[Any, ...] = ()  # the inferred values of a table, in parts
    remarks: tuple[str, ...] = ()  # on whole tables

    @classmethod
    def of(cls, columns: Columns, word_of: Callable[[str], str] = str) -> "Tally":
        """Return the counts of some rows; `word_of`: see `worded`."""
        gaps: dict[str, Fault] = {}
        for gap, number in columns.counted_gaps:
            # Results without a meaning are reported by a code, with its own count.
            reported = {name: error for name, error in gap.reasons.items() if not has_code(error)}
            if reported:
                faults = faults_of(reported)
                if faults not in gaps:
                    gaps[faults] = Fault(0, gap.first + 1, worded(reported, word_of))
                gaps[faults] = gaps[faults]._replace(rows=gaps[faults].rows + number)
        failed = sum(number for gap, number in columns.counted_gaps if gap.is_failed)
        return cls(len(columns), failed, gaps, columns.counted_doubts)

    def plus(self, other: "Tally", table: str = "") -> "Tally":
        """Return the sum of the counts. `table`: a prefix that names the other table; its rows are numbered from 1."""
        gaps = dict(self.gaps)
        rows_before = 0 if table else self.rows
        for faults, more in other.gaps.items():
            known = gaps.get(faults, Fault(0, rows_before + more.first, f"{table}{more.words}"))
            gaps[faults] = known._replace(rows=known.rows + more.rows)
        others = [name for name in self._fields if name != "gaps"]
        sums: dict[str, Any] = {name: getattr(self, name) + getattr(other, name) for name in others}
        return Tally(gaps=gaps, **sums)

    def with_doubts(self, bits: int) -> int:
        """Return the number of rows with any of the doubts in `bits`."""
        return sum(rows for doubts, rows in self.doubts.items() if doubts & bits)

    def counted(self, bits: int) -> list[tuple[str, int]]:
        """Return the codes in `bits` with their numbers of rows, the most frequent first."""
        counts = {code: self.with_doubts(bit) for code, bit in BITS.items() if bit & bits}
        return [(code, rows) for code, rows in sorted(counts.items(), key=lambda item: -item[1]) if rows]


def tallied(blocks: Iterable[Columns], tallies: list[Tally], word_of: Callable[[str], str] = str) -> Iterator[Columns]:
    """Iterate over blocks, and append the counts of each to `tallies`; `word_of`: see `worded`."""
    for columns in blocks:
        tallies.append(Tally.of(columns, word_of))
        yield columns
