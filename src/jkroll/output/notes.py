"""The notes of a call as lines below its results: a matter each, the most important first, and where there are more."""

from collections.abc import Iterable, Iterator, Sequence
from functools import cached_property
from typing import TYPE_CHECKING, get_args

from ..answers.answer import Answer
from ..answers.notes import assumed_of_rows, first_symbols, notes_on_rows
from ..answers.results import Kind, Note
from ..errors import JkrollError
from ..scene.limits import ENDING_MEANING, MEANINGS, OF_LAW, codes_of
from ..scene.scene import Scene

if TYPE_CHECKING:
    from ..rows.columns import Columns

MAX_NOTES = 2  # below an answer
MAX_LENGTH = 154  # of a note, two lines of a terminal
_MORE = "more: --explain"
_BEHIND = ("model", "data")  # kinds that change nothing that a reader does: in explanations
_ELSEWHERE = ("material", "assumed")  # said when a file of materials was read, and above the results
_KINDS = get_args(Kind)
_FIRST_DOUBT, _AFTER_ERROR_BARS = "doubt", "assumed"  # the kinds in whose place doubts stand


def of_answer(answer: Answer, *, has_head: bool = False, quiet: bool = False) -> list[str]:
    """Return the lines below an answer: what was assumed unless a head has it, the first notes, and if there are more.

    `quiet`: whether warnings alone are wanted.
    """
    head = [note.text for note in answer.notes if note.kind == "assumed" and not (has_head or quiet)]
    return [*head, *_lines([*answer.notes, *answer.doubts()], answer.width, quiet=quiet)]


def every_line(answer: Answer) -> list[str]:
    """Return a line for each note on an answer, by falling importance, for a file that is read without the answer."""
    every = by_importance([*answer.notes, *answer.doubts()], answer.width)
    return [_line(note.kind, note.text) for note in every if note.kind != "material"]


def _lines(notes: Iterable[Note], width: float = 0.0, *, quiet: bool = False) -> list[str]:
    """Return the lines of the first of some notes, all warnings in one; the last says whether there are more."""
    every = [note for note in by_importance(notes, width) if note.kind not in _ELSEWHERE]
    warnings = "; ".join(note.text for note in every if note.kind == "warning")
    others = [] if quiet else [note for note in every if note.kind != "warning"]
    lines = [_line("warning", warnings)] if warnings else []
    front = [*lines, *(_line(note.kind, note.text) for note in others if note.kind not in _BEHIND)]
    shown = [*map(_first_clauses, front[:MAX_NOTES])]
    is_whole = shown == front and len(shown) == len(lines) + len(others)
    return [*shown, *([] if is_whole else [_MORE])]


def _line(kind: Kind, text: str) -> str:
    return f"{'warning' if kind == 'warning' else 'note'}: {text}"


def _first_clauses(text: str) -> str:
    """Return as many clauses of a text as fit into two lines, one at least."""
    while len(text) > MAX_LENGTH and "; " in text:
        text = text.rpartition("; ")[0]
    return text


def by_importance(every: Iterable[Note], width: float = 0.0) -> list[Note]:
    """Return notes, the most important first: doubts by their size, unless the error bars are wider."""

    def key(note: Note) -> tuple[int, float]:
        if note.size is None or note.kind == "warning":
            return _KINDS.index(note.kind), 0.0
        return _KINDS.index(_FIRST_DOUBT if note.size > width else _AFTER_ERROR_BARS), -note.size

    return sorted(every, key=key)


class OfRows:
    """The notes of rows: empty cells, and doubts with their numbers of rows, counted while columns are written."""

    def __init__(self, kinds: Iterable[tuple[Scene, Sequence[str]]]) -> None:
        """`kinds`: a scene of each kind of rows, with the quantities that it shows."""
        from ..rows.reasons import Tally

        self._kinds = [*kinds]
        self.tally = Tally()
        self.failure: JkrollError | None = None  # the first

    def watch(self, blocks: "Iterable[Columns]") -> "Iterator[Columns]":
        """Iterate over columns, and count what is to be said of them."""
        for columns in blocks:
            self.tally = self.tally.plus(self.tally.of(columns, first_symbols))
            if columns.failed and self.failure is None:
                self.failure = columns.failure(min(columns.failed))
            yield columns

    @cached_property
    def assumed(self) -> dict[str, str]:
        """The assumptions about rows, each with the option that sets it, by name."""
        return {name: text for kind in self._kinds for name, text in assumed_of_rows(*kind).items()}

    def lines(self, *, has_table: bool = False, quiet: bool = False) -> list[str]:
        """Return the lines to print; `has_table`: whether they are below a table, whose head has what was assumed.

        It has columns beside the values of a law that is not exact, too.
        """
        of_law = codes_of(OF_LAW)[::-1]  # the worst first
        others = [code for code in self.tally.codes if code not in of_law]
        ending = [code for code in others if code in ENDING_MEANING]
        doubts = [code for code in others if code not in ending]
        doubts += [code for code in of_law if code in self.tally.codes and not has_table]
        notes = [Note("warning", self._counted("numbers have no meaning", ending))] if ending else []
        notes += [Note("doubt", self._counted("doubts", doubts), size=0.0)] if doubts else []
        if quiet:
            return _lines(notes, quiet=True)
        of_gaps = (gaps.sentence() if self.tally.rows > 1 else gaps.words for gaps in self.tally.gaps.values())
        notes += [Note("missing", text) for text in of_gaps]
        notes += dict.fromkeys(note for kind in self._kinds for note in notes_on_rows(*kind))
        head = [f"assumed: {', '.join(self.assumed.values())}"] if self.assumed and not has_table else []
        return [*head, *_lines(notes)]

    def _counted(self, lead: str, codes: Sequence[str]) -> str:
        """Return in how many rows codes stand, each with its meaning."""
        counts, rows = self.tally.codes, self.tally.rows
        first, *others = (f"{code} in {counts[code]} of {rows} rows ({MEANINGS[code]})" for code in codes)
        return "; ".join([f"{lead}: {first}", *(text.replace(f" of {rows} rows", "") for text in others)])
