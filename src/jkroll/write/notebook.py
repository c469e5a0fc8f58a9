"""Answers as text, as HTML and as LaTeX: the tables of a terminal, and the lines around them."""

from collections.abc import Iterable, Iterator, Sequence
from html import escape
from io import StringIO
from typing import TYPE_CHECKING

from ..quantities.formatting import AS_USUAL
from ..quantities.markup import as_latex
from ..report.notes import assumed_in, lines_of, notes_below
from ..text import TextColumn, as_arguments, html_table, say, write_table
from .table import Rows, in_width, parts_of_frame, parts_of_rows

if TYPE_CHECKING:
    from ..report.report import Report
    from .answers import Answers

Part = str | Rows  # a line, or a table: columns that each part of a wide one has, and others
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


def bundle(parts: Iterable[Part]) -> dict[str, str]:
    """Return lines and tables in each form that a notebook shows or converts."""
    every = [*parts]
    return {"text/plain": as_text(every), "text/html": as_html(every), "text/latex": as_tabular(every)}


def as_text(parts: Iterable[Part]) -> str:
    """Return lines and tables as a terminal shows them."""
    out = StringIO()
    for part in parts:
        if isinstance(part, str):
            say(part, out)
        else:
            write_table(*in_width(*part), out)
    return out.getvalue().rstrip("\n")


def as_html(parts: Iterable[Part]) -> str:
    """Return lines and tables as HTML."""
    texts = (f"<p>{escape(part)}</p>" if isinstance(part, str) else html_table([*part[0], *part[1]]) for part in parts)
    return "\n".join(["<div>", *texts, "</div>"])


def as_tabular(parts: Iterable[Part]) -> str:
    """Return lines and tables as LaTeX: paragraphs, and tables with symbols as mathematics."""
    texts = (as_latex(part) if isinstance(part, str) else _tabular([*part[0], *part[1]]) for part in parts)
    return "\n\n".join(texts)


def _tabular(columns: Sequence[TextColumn]) -> str:
    marked = [
        column._replace(cells=[f"⟦{cell}⟧" for cell in column.cells]) if column.head == "symbol" else column
        for column in columns
    ]
    heads = " & ".join(as_latex(column.head) for column in columns)
    rows = (" & ".join(map(as_latex, cells)) for cells in zip(*(column.cells for column in marked), strict=True))
    form = "".join("r" if column.is_right else "l" for column in columns)
    lines = [rf"{line} \\" for line in (heads, *rows)]
    return "\n".join([rf"\begin{{tabular}}{{{form}}}", lines[0], r"\hline", *lines[1:], r"\end{tabular}"])
