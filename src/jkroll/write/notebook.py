"""The lines and tables of answers for a notebook: those of a terminal, with arguments in place of options."""

from collections.abc import Iterable, Iterator
from typing import TYPE_CHECKING

from ..quantities.formatting import AS_USUAL
from ..quantities.shown import Part
from ..report.notes import assumed_in, lines_of, notes_below
from ..text import as_arguments
from .table import parts_of_frame, parts_of_rows

if TYPE_CHECKING:
    from ..report.report import Report
    from .answers import Answers

_MORE = "more: --explain"  # of a terminal


def parts_of_answer(answer: "Report") -> Iterator[Part]:
    """Iterate over lines and tables of an answer."""
    parts = (*parts_of_frame(answer, AS_USUAL), *lines_of(answer.sentences_below))
    return _in_python((part if isinstance(part, str) else (part, []) for part in parts), ".notes and .doubts")


def parts_of_answers(answers: "Answers") -> Iterator[Part]:
    """Iterate over lines and tables of a list of answers."""
    assumed, reported = assumed_in(answers.groups), answers.in_table.reported_doubts
    tables = (part for columns in answers.blocks for part in parts_of_rows(columns, answers.form, assumed))
    notes = notes_below(answers.groups, answers.tally, reported, is_table=True)
    return _in_python((*tables, *lines_of(notes, has_head=True)), ".notes and .doubts of each answer")


def _in_python(parts: Iterable[Part], more: str) -> Iterator[Part]:
    """Iterate over parts with arguments in place of options. `more`: where to read more."""
    for part in parts:
        if isinstance(part, str):
            yield f"more: {more}" if part == _MORE else as_arguments(part)
        else:
            yield part
