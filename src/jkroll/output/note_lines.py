"""The notes of answers as the lines below them: one line for each kind below an answer, for each matter below a sweep."""

from typing import get_args

from ..answers.answer import Answer
from ..answers.result import Kind, Note

MAX_LINES = 3  # below a single answer
MAX_DOUBTS = 2  # that are worded there; further ones are a number and its limit
MAX_RANGES = 4  # of rows that are named
_KINDS = get_args(Kind)
_OF_ONE_SCENE = ("model", "data")


class NoteLines:
    """The notes of the answers of one call, each with the rows that it is about, to be printed below them."""

    def __init__(self) -> None:
        """Begin with no answer."""
        self._notes: dict[tuple[str, str], Note] = {}
        self._texts: dict[tuple[str, str], set[str]] = {}
        self._rows: dict[tuple[str, str], list[list[int]]] = {}  # first and last row of each run of rows
        self._count = 0

    def add(self, answer: Answer) -> None:
        """Add the notes of the next row."""
        self._count += 1
        for note in (*answer.notes, *answer.doubts()):
            place = (note.kind, note.matter or note.text)
            self._notes.setdefault(place, note)
            self._texts.setdefault(place, set()).add(note.text)
            runs = self._rows.setdefault(place, [])
            if runs and runs[-1][1] >= self._count - 1:
                runs[-1][1] = self._count
            else:
                runs.append([self._count, self._count])

    def lines(self, *, with_rows: bool = True) -> list[str]:
        """Return the lines to print, by falling importance."""
        if self._count == 1:
            return self._of_one_answer()[:MAX_LINES]
        places = sorted(self._notes, key=lambda place: _KINDS.index(place[0]))
        return [
            _line(self._notes[place], [self._text(place) + (self._where(place) if with_rows else "")])
            for place in places
            if place[0] not in _OF_ONE_SCENE
        ]

    def _text(self, place: tuple[str, str]) -> str:
        """Return a doubt without the numbers of a scene; of other notes on one matter the first."""
        note = self._notes[place]
        return note.matter if note.kind == "doubt" else note.text

    def _of_one_answer(self) -> list[str]:
        """Return a line for each kind of note."""
        lines = []
        for kind in _KINDS:
            notes = [note for note in self._notes.values() if note.kind == kind]
            if notes:
                worded = len(notes) if kind != "doubt" else MAX_DOUBTS
                texts = [note.text for note in notes[:worded]]
                more = [note.brief for note in notes[worded:]]
                lines.append(
                    _line(notes[0], [*texts, f"also {', '.join(more)}: jkroll guide models"] if more else texts)
                )
        return lines

    def _where(self, place: tuple[str, str]) -> str:
        """Return the rows that a note is about, those to which its numbers do not belong apart; nothing if it is about all."""
        runs = self._rows[place]
        has_numbers = place[0] != "doubt" and len(self._texts[place]) > 1
        if not has_numbers:
            return "" if runs == [[1, self._count]] else f": {_rows(runs)}"
        (start, end), *others = runs
        rest = [[start + 1, end], *others] if start < end else others
        return f": row {start}, likewise {_rows(rest)}"


def _rows(runs: list[list[int]]) -> str:
    """Return runs of rows as text: "rows 2, 5-7"."""
    named = [str(first) if first == last else f"{first}-{last}" for first, last in runs[:MAX_RANGES]]
    more = " and more" if len(runs) > MAX_RANGES else ""
    return f"row{'s' if len(runs) > 1 or runs[0][0] < runs[0][1] else ''} {', '.join(named)}{more}"


def _line(note: Note, texts: list[str]) -> str:
    return f"note: {'doubtful: ' if note.kind == 'doubt' else ''}{'; '.join(texts)}"
