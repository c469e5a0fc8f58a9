"""An answer as text, as HTML and as LaTeX: the tables of a terminal, and the lines around them."""

from collections.abc import Iterator, Sequence
from html import escape
from io import StringIO
from typing import TYPE_CHECKING

from ..quantities.formatting import AS_USUAL
from ..quantities.markup import as_latex
from ..report.notes import lines_of
from ..text import TextColumn, as_arguments, html_table, say, write_table
from .table import parts_of_frame

if TYPE_CHECKING:
    from ..report.report import Report

_MORE = {"more: --explain": "more: .notes and .doubts"}


def _parts(answer: "Report") -> Iterator[str | list[TextColumn]]:
    """Iterate over lines and tables, as on a terminal, with arguments in place of options."""
    for part in (*parts_of_frame(answer, AS_USUAL), *lines_of(answer.sentences_below)):
        yield as_arguments(_MORE.get(part, part)) if isinstance(part, str) else part


def as_text(answer: "Report") -> str:
    """Return an answer as a terminal shows it."""
    out = StringIO()
    for part in _parts(answer):
        if isinstance(part, str):
            say(part, out)
        else:
            write_table(part, [], out)
    return out.getvalue().rstrip("\n")


def as_html(answer: "Report") -> str:
    """Return an answer as HTML."""
    parts = (f"<p>{escape(part)}</p>" if isinstance(part, str) else html_table(part) for part in _parts(answer))
    return "\n".join(["<div>", *parts, "</div>"])


def as_tabular(answer: "Report") -> str:
    """Return an answer as LaTeX: paragraphs, and tables with symbols as mathematics."""
    parts = (as_latex(part) if isinstance(part, str) else _tabular(part) for part in _parts(answer))
    return "\n\n".join(parts)


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
