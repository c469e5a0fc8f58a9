"""Why cells of a row are empty: in a few words, for its status, and in full; and the counts of such rows."""

from collections import Counter
from collections.abc import Callable, Mapping
from typing import TYPE_CHECKING, Any, NamedTuple

from ..errors import JkrollError
from ..quantities.nomenclature import NOMENCLATURE
from ..scene.failures import NO_END, Failure, MissingInput, grouped, needs_in_words
from ..scene.limits import BITS
from ..text import first_of

if TYPE_CHECKING:
    from .columns import Columns

ROW = ""  # stands for the row as a whole, in place of the name of a column
UNCERTAINTY = "±"  # stands for the columns of uncertainties that a table does not have
_MAX_NAMES = 3  # of quantities in a clause

_NO_DOUBTS: Counter[int] = Counter()
Gaps = tuple[int, int, str]  # rows with one status: their number, the first, counted from 1, and its reasons in full
_NO_GAPS: Mapping[str, Gaps] = {}  # which can be pickled
Reasons = Mapping[str, JkrollError]  # why cells of a row are empty, by the names of their columns


def lack(reasons: Reasons) -> JkrollError | None:
    """Return why a row has no contact, or is no scene; None if it has one at the middles of its inputs."""
    for name, error in reasons.items():
        has_contact = not isinstance(error, Failure) or error.kind.has_contact
        if name == ROW or (not has_contact and name in NOMENCLATURE):
            return error
    return None


def status_of(reasons: Reasons) -> str:
    """Return a phrase for each kind of reason. All inputs that quantities lack are in one."""
    lacked = dict.fromkeys(
        name for error in reasons.values() if isinstance(error, MissingInput) for name in error.missing
    )
    needs = needs_in_words(lacked)
    phrases = []
    for name, error in reasons.items():
        if _is_side(name):
            phrases.append("no error bar")
        elif isinstance(error, MissingInput) and error.missing:
            phrases.append(needs)
        else:
            phrases.append(error.phrase or str(error))
    return "; ".join(dict.fromkeys(phrases))


def _first_names(names: list[str]) -> str:
    return first_of(names, _MAX_NAMES)


def _is_side(name: str) -> bool:
    """Return whether a column is that of an uncertainty."""
    return name not in NOMENCLATURE and name not in (ROW, UNCERTAINTY)


def worded(reasons: Reasons, named: Callable[[list[str]], str] = _first_names) -> str:
    """Return reasons in full; `named` returns quantities in words, by default their names."""
    if (error := lack(reasons)) is not None:
        return str(error)
    of_values = {name: error for name, error in reasons.items() if name in NOMENCLATURE}
    of_sides = {name.rpartition("_")[0]: error for name, error in reasons.items() if _is_side(name)}
    clauses = [f"{named(names)}: {reason}" for names, reason in grouped(of_values)]
    clauses += [f"{named(names)}: {NO_END}{reason}" for names, reason in grouped(of_sides)]
    clauses += [str(reasons[UNCERTAINTY])] if UNCERTAINTY in reasons else []
    return "; ".join(clauses)


class Tally(NamedTuple):
    """The rows of a run, and those of them that failed, have empty cells, or exceed limits."""

    rows: int = 0
    failed: int = 0
    gaps: Mapping[str, Gaps] = _NO_GAPS  # rows with empty cells, by their status
    doubts: Counter[int] = _NO_DOUBTS  # rows, by the bits of their doubts
    inferred: tuple[Any, ...] = ()  # the values of the unknown of a table, in parts
    said: tuple[str, ...] = ()  # of each table as a whole

    @classmethod
    def of(cls, columns: "Columns", named: Callable[[list[str]], str] = _first_names) -> "Tally":
        """Return the counts of some rows; `named` as `reasons.worded` has it."""
        rows: dict[str, list[int]] = {}
        for row, status in sorted(columns.status.items()):
            rows.setdefault(status, []).append(row)
        gaps = {
            status: (len(places), places[0] + 1, worded(columns.reasons[places[0]], named))
            for status, places in rows.items()
        }
        return cls(len(columns), len(columns.failed), gaps, columns.counted_doubts)

    def plus(self, other: "Tally") -> "Tally":
        """Return the counts with those of some more rows."""
        gaps = dict(self.gaps)
        for status, (more, place, text) in other.gaps.items():
            rows, first, words = gaps.get(status, (0, self.rows + place, text))
            gaps[status] = (rows + more, first, words)
        return Tally(
            self.rows + other.rows,
            self.failed + other.failed,
            gaps,
            self.doubts + other.doubts,
            self.inferred + other.inferred,
            self.said + other.said,
        )

    def with_doubts(self, bits: int) -> int:
        """Return the number of rows with any of the doubts that bits stand for."""
        return sum(rows for doubts, rows in self.doubts.items() if doubts & bits)

    def counted(self, bits: int) -> list[tuple[str, int]]:
        """Return the codes that bits stand for with their numbers of rows, the most frequent first."""
        counts = {code: self.with_doubts(bit) for code, bit in BITS.items() if bit & bits}
        return [(code, rows) for code, rows in sorted(counts.items(), key=lambda item: -item[1]) if rows]
