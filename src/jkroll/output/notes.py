"""The notes of a call as lines below its results: a matter each, the most important first, and where there are more."""

from collections.abc import Iterable, Iterator, Sequence
from functools import cached_property
from typing import get_args

from ..answers.answer import Answer
from ..answers.notes import assumed_of_rows, first_symbols, notes_on_rows
from ..answers.results import Kind, Note
from ..errors import JkrollError
from ..rows.columns import Columns
from ..rows.reasons import Tally
from ..scene.limits import ENDING_MEANING, MEANINGS, OF_LAW, codes_of
from ..scene.scene import Scene
from ..text import first_of

MAX_NOTES = 2  # below an answer
MAX_LENGTH = 148  # of a note, two lines of a terminal
MAX_CODES = 3  # of doubts that are named together
_MORE = "more: --explain"
_OF_ROWS = "jkroll guide models"
_BEHIND = ("model", "data")  # kinds that change nothing that a reader does: in explanations
_KINDS = get_args(Kind)
_FIRST_DOUBT, _AFTER_ERROR_BARS = "doubt", "assumed"  # the kinds in whose place doubts stand


def of_answer(answer: Answer, *, has_head: bool = False, quiet: bool = False) -> list[str]:
    """Return the lines below an answer: what was assumed unless a head has it, the first notes, and if there are more.

    `quiet`: whether warnings alone are wanted.
    """
    every = by_importance([*answer.notes, *answer.doubts()], answer.width)
    head = [note.text for note in every if note.kind == "assumed" and not has_head]
    notes = [
        note for note in every if note.kind not in ("material", "assumed")
    ]  # material: said when its file was read
    warnings = _lines([note for note in notes if note.kind == "warning"])
    return warnings if quiet else [*head, *_lines(notes)]


def _lines(notes: Sequence[Note]) -> list[str]:
    """Return the lines of the first of some notes, all warnings in one; the last says whether there are more."""
    warnings = [note for note in notes if note.kind == "warning"]
    others = [note for note in notes if note.kind != "warning"]
    lines = []
    if warnings:
        also = dict.fromkeys(note.brief for note in warnings[1:])
        lines = [f"warning: {warnings[0].text}" + (f"; also {first_of([*also], MAX_CODES)}" if also else "")]
    shown = [note for note in others if note.kind not in _BEHIND][: MAX_NOTES - len(lines)]
    texts = [_first_clauses(note.text) for note in shown]
    lines += [f"note: {text}" for text in texts]
    is_whole = texts == [note.text for note in others] and not warnings[1:]
    return [*lines, *([] if is_whole else [_MORE])]


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


def every_line(answer: Answer) -> list[str]:
    """Return a line for each note on an answer, by falling importance, for a file that is read without the answer."""
    every = by_importance([*answer.notes, *answer.doubts()], answer.width)
    return [
        f"{'warning' if note.kind == 'warning' else 'note'}: {note.text}" for note in every if note.kind != "material"
    ]


class OfRows:
    """The notes of rows: empty cells, and doubts with their numbers of rows, counted while columns are written."""

    def __init__(self, kinds: Iterable[tuple[Scene, Sequence[str]]]) -> None:
        """`kinds`: a scene of each kind of rows, with the quantities that it shows."""
        self._kinds = [*kinds]
        self.tally = Tally()
        self.failure: JkrollError | None = None  # the first

    def watch(self, blocks: Iterable[Columns]) -> Iterator[Columns]:
        """Iterate over columns, and count what is to be said of them."""
        for columns in blocks:
            self.tally = self.tally.plus(Tally.of(columns, first_symbols))
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
        of_law, left_out = codes_of(OF_LAW), codes_of(OF_LAW) if has_table else ()
        codes = sorted(self.tally.codes, key=of_law.__contains__)  # those of the law last
        ending = [code for code in codes if code in ENDING_MEANING]
        doubts = [code for code in codes if code not in (*ending, *left_out)]
        found = [Note("warning", self._counted(ending, "numbers have no meaning"))] if ending else []
        if quiet:
            return _lines(found)
        found += [
            Note("missing", gaps.sentence() if self.tally.rows > 1 else gaps.words) for gaps in self.tally.gaps.values()
        ]
        found += [Note("doubt", self._counted(doubts, "doubts"), size=0.0)] if doubts else []
        found += dict.fromkeys(note for kind in self._kinds for note in notes_on_rows(*kind))
        head = [f"assumed: {', '.join(self.assumed.values())}"] if self.assumed and not has_table else []
        return [*head, *_lines(by_importance(found))]

    def _counted(self, codes: Sequence[str], lead: str) -> str:
        """Return in how many rows codes stand, and the meaning of the first."""
        counts, rows = self.tally.codes, self.tally.rows
        texts = [f"{code} in {counts[code]}" if rows > 1 else code for code in codes]
        some = f" of {rows} rows" if rows > 1 else ""
        return f"{lead}: {first_of(texts, MAX_CODES)}{some} ({codes[0]}: {MEANINGS[codes[0]]}): {_OF_ROWS}"
