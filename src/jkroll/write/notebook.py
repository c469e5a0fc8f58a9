"""The lines and tables of answers for a notebook: those of a terminal, with arguments instead of options."""

from collections.abc import Iterable, Iterator, Sequence
from itertools import chain
from typing import TYPE_CHECKING

from ..quantities.formatting import AS_USUAL, Format
from ..quantities.shown import Part
from ..report.notes import Group, assumed_in, lines_of, notes_below
from ..text import as_arguments
from .table import parts_of_frame, parts_of_rows

if TYPE_CHECKING:
    from ..model.rows import Columns, Tally, Wanted
    from ..report.report import Report

_MORE = "more: --explain"  # the last line on a terminal


def parts_of_answer(answer: "Report") -> Iterator[Part]:
    """Iterate over the lines and tables of an answer."""
    parts = (*parts_of_frame(answer, AS_USUAL), *lines_of(answer.sentences_below))
    return _in_python((part if isinstance(part, str) else (part, []) for part in parts), ".notes and .doubts")


def parts_of_answers(
    groups: Sequence[Group], blocks: "Iterable[Columns]", wanted: "Wanted", tally: "Tally", form: Format
) -> Iterator[Part]:
    """Iterate over the lines and tables of a list of answers, block by block."""
    assumed = assumed_in(groups)
    tables = chain.from_iterable(parts_of_rows(columns, form, assumed) for columns in blocks)
    notes = notes_below(groups, tally, wanted.reported_doubts, is_table=True)
    return _in_python((*tables, *lines_of(notes, has_head=True)), ".notes and .doubts of each answer")


def _in_python(parts: Iterable[Part], more: str) -> Iterator[Part]:
    """Iterate over parts with arguments instead of options. `more`: where the rest can be read."""
    for part in parts:
        if isinstance(part, str):
            yield f"more: {more}" if part == _MORE else as_arguments(part)
        else:
            yield part
