"""The lines and tables of answers for a notebook: as on a terminal, but arguments replace options."""

from collections.abc import Iterable, Iterator, Sequence
from typing import TYPE_CHECKING

from ..quantities.formatting import AS_USUAL, Format
from ..quantities.shown import Part
from ..report.leads import lead_of_rows
from ..report.notes import MORE, Noted, assumed_in, lines_of, notes_below
from ..text import as_arguments
from .table import parts_of_frame, parts_of_rows

if TYPE_CHECKING:
    from ..model.rows import Columns, Wanted
    from ..model.tally import Tally
    from ..report.report import Report


def parts_of_answer(answer: "Report") -> Iterator[Part]:
    """Iterate over the lines and tables of an answer."""
    parts: list[Part] = []
    for part in parts_of_frame(answer, AS_USUAL):
        parts.append(part if isinstance(part, str) else (part, []))
    return _in_python(
        (*parts, *lines_of(answer.sentences_below, has_more=answer.has_more_reasons)),
        ".why, .notes and .doubts",
    )


def parts_of_answers(
    groups: Sequence[Noted], blocks: "Iterable[Columns]", wanted: "Wanted", tally: "Tally", form: Format
) -> Iterator[Part]:
    """Iterate over the lines and tables of a list of answers: those of each block, then the notes."""
    assumed = assumed_in(groups)
    parts: list[Part] = []
    for columns in blocks:
        parts += parts_of_rows(columns, form, assumed, lead_of_rows(groups, wanted.names))
    notes = notes_below(groups, tally, wanted.reported_doubts, is_table=True)
    return _in_python((*parts, *lines_of(notes, has_head=True)), ".why, .notes and .doubts of each answer")


def _in_python(parts: Iterable[Part], more: str) -> Iterator[Part]:
    """Iterate over parts in which arguments replace options. `more`: the attributes with further notes."""
    for part in parts:
        if isinstance(part, str):
            yield f"more: {more}" if part == MORE else as_arguments(part)
        else:
            yield part
