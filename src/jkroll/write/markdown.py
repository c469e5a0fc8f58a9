"""An answer as a page of Markdown: the tables of a terminal, with the lines around them as paragraphs."""

from collections.abc import Sequence
from typing import TYPE_CHECKING, TextIO

from ..quantities.formatting import Format
from ..text import TextColumn
from .table import parts_of_frame
from .writers import Markdown, in_markdown

if TYPE_CHECKING:
    from ..report.report import Report


def frame_page(answer: "Report", out: TextIO, form: Format) -> None:
    """Write an answer, with an empty line between paragraphs and tables."""
    texts = []
    for part in parts_of_frame(answer, form):
        texts.append(f"{in_markdown(part)}\n" if isinstance(part, str) else _table(part))
    out.write("\n".join(texts))


def _table(columns: Sequence[TextColumn]) -> str:
    """Return columns as a Markdown table."""
    heads = [column.head for column in columns]
    writer = Markdown([column.is_right for column in columns])
    return (writer.header(heads) + writer.rows(heads, [[*column.cells] for column in columns])).decode()
