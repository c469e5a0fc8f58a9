"""The notes of a call as the lines below its results: of one answer a line for each kind, of many rows one for each matter."""

from collections.abc import Iterable, Iterator, Sequence
from itertools import chain
from typing import Any, NamedTuple, get_args

from ..answers.answer import Answer
from ..answers.notes import first_symbols, notes_on_rows
from ..answers.results import Kind, Note
from ..errors import JkrollError
from ..rows.columns import Columns, as_list
from ..rows.reasons import Gaps, joined
from ..rows.sweep import Pair
from ..scene.limits import MEANINGS, codes_of
from ..scene.scene import Scene

MAX_LINES = 3  # below a single answer
MAX_LENGTH = 140  # of a line with more than one note, two lines of a terminal
MAX_DOUBTS = 2  # that are worded there; further ones are a number and its limit
MAX_RANGES = 4  # of rows that are named
_KINDS = get_args(Kind)
_FIRST_DOUBT, _AFTER_ERROR_BARS = "displacement", "assumed"  # the kinds in whose place doubts stand


def of_answer(answer: Answer, *, has_head: bool = False) -> list[str]:
    """Return the lines below one answer, by falling importance; the last says how many notes are left out.

    `has_head`: whether its inputs stand above it, with those that were assumed.
    """
    said_elsewhere = ("material", "assumed") if has_head else ("material",)  # when its file was read, and above
    every = [note for note in (*answer.notes, *answer.doubts()) if note.kind not in said_elsewhere]
    return _lines(every, answer.width)


def _lines(every: Iterable[Note], width: float = 0.0) -> list[str]:
    """Return the first lines of notes, one for each kind, by falling importance; the last says how many notes are left out."""
    of_kinds = _by_importance(every, width)
    lines: list[str] = []
    left = sum(map(len, of_kinds.values()))
    for kind, notes in [*of_kinds.items()][:MAX_LINES]:
        every_text = [note.text for note in notes]
        if kind == "missing":
            worded = every_text
        elif kind == "doubt":
            worded = every_text[:MAX_DOUBTS]
        else:
            worded = _fitting(every_text)
        briefly = [note.brief for note in notes[len(worded) :] if note.brief]
        left -= len(worded) + len(briefly)
        texts = [*worded, f"also {', '.join(briefly)}: jkroll guide models"] if briefly else worded
        lead = "doubtful: " if kind == "doubt" and not notes[0].is_sentence else ""
        lines.append(f"note: {lead}{'; '.join(texts)}")
    if left:
        lines[-1] += f"; {left} more: --explain"
    return lines


def _by_importance(every: Iterable[Note], width: float) -> dict[Kind, list[Note]]:
    """Return notes by kind, the most important kind first."""
    of_kinds: dict[Kind, list[Note]] = {}
    for note in every:
        of_kinds.setdefault(note.kind, []).append(note)
    return dict(sorted(of_kinds.items(), key=lambda item: _importance(item[0], item[1], width)))


def _importance(kind: Kind, notes: Sequence[Note], width: float) -> tuple[int, float]:
    """Return the key by which the notes of a kind are sorted: doubts by their size, unless the error bars are wider."""
    size = max((note.size for note in notes if note.size is not None), default=None)
    if size is None:
        return _KINDS.index(kind), 0.0
    return _KINDS.index(_FIRST_DOUBT if size > width else _AFTER_ERROR_BARS), -size


def _fitting(texts: list[str]) -> list[str]:
    """Return the first of some texts, and those behind it that fit into the same line."""
    found = texts[:1]
    for text in texts[1:]:
        if len("; ".join([*found, text])) > MAX_LENGTH:
            break
        found.append(text)
    return found


def every_line(answer: Answer) -> list[str]:
    """Return a line for each note on an answer, by falling importance, for a file that is read without the answer."""
    every = (note for note in (*answer.notes, *answer.doubts()) if note.kind != "material")
    sorted_notes = chain.from_iterable(_by_importance(every, answer.width).values())
    return [f"note: {note.worded}" for note in sorted_notes]


class OfRows:
    """The notes of rows, each with the rows that it is about, collected while the columns are written."""

    def __init__(self) -> None:
        self._notes: dict[tuple[Kind, str], _Noted] = {}
        self._gaps: dict[str, Gaps] = {}  # of rows with empty cells
        self.count = 0
        self.failed = 0
        self.failure: JkrollError | None = None  # the first

    def watch(self, blocks: Iterable[Columns]) -> Iterator[Columns]:
        """Iterate over columns, and collect what is to be said of them."""
        for columns in blocks:
            self._gaps = joined(self._gaps, columns.gaps(first_symbols), self.count)
            bits = as_list(columns.doubts)
            of_bits = {each: codes_of(each) for each in {*bits}}
            for row, each in enumerate(bits):
                for code in of_bits[each]:
                    self._add("doubt", code, f"{code}, {MEANINGS[code]}", code, self.count + row + 1)
            if columns.failed and self.failure is None:
                self.failure = columns.failure(min(columns.failed))
            self.failed += len(columns.failed)
            self.count += len(columns)
            yield columns

    def _add(self, kind: Kind, matter: str, text: str, brief: str, row: int) -> None:
        noted = self._notes.setdefault((kind, matter), _Noted(text, brief, []))
        runs = noted.runs
        if runs and runs[-1][1] >= row - 1:
            runs[-1][1] = row
        elif len(runs) <= MAX_RANGES:
            runs.append([row, row])

    def lines(self, pairs: Sequence[Pair], kinds: Iterable[tuple[Scene, Sequence[str]]]) -> list[str]:
        """Return the lines to print, by falling importance.

        `pairs`: of materials, as the rows have them one after the other; `kinds`: a scene of each kind, with the
        quantities that it shows.
        """
        found = [Note("missing", gaps.sentence() if self.count > 1 else gaps.words) for gaps in self._gaps.values()]
        for (kind, _), noted in self._notes.items():
            where = self._where(noted)
            brief = noted.brief + (f" ({where})" if where else "") if noted.brief else ""
            found.append(Note(kind, _with_rows(noted.text, where), brief=brief))
        of_pairs: dict[tuple[Kind, str], list[Any]] = {}
        for scene, names in kinds:
            for note in notes_on_rows(scene, names):
                of_pairs.setdefault((note.kind, note.text), []).append(_keys((scene.material, scene.material2)))
        size = self.count // len(pairs)
        for (kind, text), own in of_pairs.items():
            places = [place for place, pair in enumerate(pairs) if _keys(pair) in own]
            runs = [[place * size + 1, (place + 1) * size] for place in places]
            found.append(Note(kind, _with_rows(text, self._where(_Noted(text, "", _joined(runs))))))
        return _lines(found)

    def _where(self, noted: "_Noted") -> str:
        """Return the rows that a note is about; nothing if it is about all."""
        return "" if noted.runs == [[1, self.count]] else _rows(noted.runs)


def _with_rows(text: str, where: str) -> str:
    return f"{text}: {where}" if where else text


class _Noted(NamedTuple):
    """A note and its rows: the first and the last of each run of rows."""

    text: str
    brief: str  # of a doubt: its code
    runs: list[list[int]]


def _keys(pair: Pair) -> list[tuple[str, str] | None]:
    return [material and material.key for material in pair]


def _joined(runs: list[list[int]]) -> list[list[int]]:
    """Return runs of rows, those that follow each other as one."""
    found: list[list[int]] = []
    for first, last in runs:
        if found and found[-1][1] == first - 1:
            found[-1][1] = last
        else:
            found.append([first, last])
    return found


def _rows(runs: list[list[int]]) -> str:
    """Return runs of rows as text: "rows 2, 5-7"."""
    named = [str(first) if first == last else f"{first}-{last}" for first, last in runs[:MAX_RANGES]]
    more = " and more" if len(runs) > MAX_RANGES else ""
    return f"row{'s' if len(runs) > 1 or runs[0][0] < runs[0][1] else ''} {', '.join(named)}{more}"
