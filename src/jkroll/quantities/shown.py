"""Lines and tables in the forms that notebooks show or convert: text, HTML, LaTeX."""

from collections.abc import Iterable, Mapping, Sequence
from html import escape
from io import StringIO
from itertools import chain
from typing import Any

from ..text import TextColumn, html_table, say, write_table
from .formatting import RESULT_DIGITS, Format, from_to, significant
from .markup import as_latex
from .nomenclature import NOMENCLATURE
from .units import Unit, convert
from .values import Interval, Uncertain

Value = float | str | Uncertain | None  # the value of a cell: a number, a word, or None
Rows = tuple[list[TextColumn], list[TextColumn]]  # columns repeated in each part of a wide table, and the others
Part = str | Rows  # a line, or a table


class Shown:
    """An object with lines and tables for notebooks; `print` shows them as on a terminal."""

    def _parts(self) -> Iterable[Part]:
        """Return the lines and tables."""
        raise NotImplementedError

    def __str__(self) -> str:
        return as_text(self._parts())

    def _repr_html_(self) -> str:
        """Return the HTML for notebooks."""
        return as_html(self._parts())

    def _repr_mimebundle_(self, **_: Any) -> dict[str, str]:
        """Return all forms that notebooks show and convert."""
        return {**bundle(self._parts()), "text/plain": str(self)}


def bundle(parts: Iterable[Part]) -> dict[str, str]:
    """Return lines and tables in each form that notebooks show or convert: LaTeX for PDF, text for a console."""
    every = [*parts]
    return {"text/plain": as_text(every), "text/html": as_html(every), "text/latex": as_tabular(every)}


def as_text(parts: Iterable[Part]) -> str:
    """Return lines and tables as on a terminal."""
    out = StringIO()
    for part in parts:
        if isinstance(part, str):
            say(part, out)
        else:
            write_table(*part, out)
    return out.getvalue().rstrip("\n")


def as_html(parts: Iterable[Part]) -> str:
    """Return lines and tables as HTML."""
    texts = (f"<p>{escape(part)}</p>" if isinstance(part, str) else html_table([*part[0], *part[1]]) for part in parts)
    return "\n".join(["<div>", *texts, "</div>"])


def as_tabular(parts: Iterable[Part]) -> str:
    """Return lines and tables as LaTeX: paragraphs, and tables with symbols in mathematics."""
    texts = (as_latex(part) if isinstance(part, str) else _tabular([*part[0], *part[1]]) for part in parts)
    return "\n\n".join(texts)


def _tabular(columns: Sequence[TextColumn]) -> str:
    cells = []
    for column in columns:
        cells.append([f"⟦{text}⟧" for text in column.cells] if column.head == "symbol" else column.cells)
    heads = " & ".join(as_latex(column.head) for column in columns)
    rows = (" & ".join(map(as_latex, row)) for row in zip(*cells, strict=True))
    form = "".join("r" if column.is_right else "l" for column in columns)
    lines = [rf"{line} \\" for line in (heads, *rows)]
    return "\n".join([rf"\begin{{tabular}}{{{form}}}", lines[0], r"\hline", *lines[1:], r"\end{tabular}"])


# --- Cells ------------------------------------------------------------------------------------------------------------


def cell(value: Value, unit: tuple[str, Unit], form: Format) -> str:
    """Return a value in a unit; without an uncertainty it has four digits including zeros."""
    if value is None or isinstance(value, str):
        return value or "–"
    if isinstance(value, Interval):
        return from_to(convert(value.low, unit[1]), convert(value.high, unit[1]), form.digits)
    if isinstance(value, float):
        zeros = form.digits is None and value != 0
        return significant(convert(value, unit[1]), form.digits or RESULT_DIGITS, zeros=zeros)
    return form.in_unit(value, unit)


def columns_of(name: str, values: Mapping[str, Sequence[Value]], form: Format) -> list[TextColumn]:
    """Return the columns of values of a quantity, given by headers, in a unit that suits them all."""
    unit = form.common_unit(name, [*chain.from_iterable(values.values())])
    in_unit, is_right = f" [{unit[0]}]" if unit[0] else "", not NOMENCLATURE[name].is_word
    return [
        TextColumn(f"{head}{in_unit}", [cell(value, unit, form) for value in each], is_right)
        for head, each in values.items()
    ]
