"""The notes of answers as the lines below them: one line for each kind below an answer, for each matter below a sweep."""

from ..answers.answer import Answer
from ..answers.result import Note

MOST_LINES = 3  # below a single answer
MOST_RANGES = 4  # of rows that are named
_KINDS = (
    "material",
    "missing",
    "doubt",
    "result",
    "model",
    "assumption",
    "unchecked",
    "data",
)  # the most important first
_OF_ONE_SCENE = ("model", "data")


class NoteLines:
    """The notes of the answers of one call, each with the rows that it is about, to be printed below them."""

    def __init__(self) -> None:
        """Begin with no answer."""
        self._notes: dict[tuple[str, str], Note] = {}
        self._rows: dict[tuple[str, str], list[list[int]]] = {}  # first and last row of each run of rows
        self._count = 0

    def add(self, answer: Answer) -> None:
        """Add the notes of the next row."""
        self._count += 1
        for note in (*answer.notes, *answer.doubts()):
            place = (note.kind, note.matter or note.text)
            self._notes.setdefault(place, note)
            runs = self._rows.setdefault(place, [])
            if runs and runs[-1][1] >= self._count - 1:
                runs[-1][1] = self._count
            else:
                runs.append([self._count, self._count])

    def lines(self, *, with_rows: bool = True) -> list[str]:
        """Return the lines to print, by falling importance."""
        if self._count == 1:
            return self._of_one_answer()[:MOST_LINES]
        places = sorted(self._notes, key=lambda place: _KINDS.index(place[0]))
        return [
            _line(self._notes[place], [_brief(self._notes[place]) + (self._where(place) if with_rows else "")])
            for place in places
            if place[0] not in _OF_ONE_SCENE
        ]

    def _of_one_answer(self) -> list[str]:
        """Return a line for each kind of note."""
        lines = []
        for kind in _KINDS:
            notes = [note for note in self._notes.values() if note.kind == kind]
            if notes:
                lines.append(_line(notes[0], [note.text for note in notes]))
        return lines

    def _where(self, place: tuple[str, str]) -> str:
        """Return the rows that a note is about; nothing if it is about all."""
        runs = self._rows[place]
        if runs == [[1, self._count]]:
            return ""
        named = [str(first) if first == last else f"{first}-{last}" for first, last in runs[:MOST_RANGES]]
        more = " and more" if len(runs) > MOST_RANGES else ""
        return f": row{'s' if len(runs) > 1 or runs[0][0] < runs[0][1] else ''} {', '.join(named)}{more}"


def _line(note: Note, texts: list[str]) -> str:
    return f"note: {'doubtful: ' if note.kind == 'doubt' else ''}{'; '.join(texts)}"


def _brief(note: Note) -> str:
    """Return the text of a note without the numbers of one scene."""
    return note.matter if note.kind == "doubt" else note.text
