"""Lines and tables in the forms that notebooks show or convert: text, HTML, LaTeX."""

from collections.abc import Iterable, Mapping, Sequence
from html import escape
from io import StringIO
from itertools import chain
from typing import Any

from ..text import TextColumn, html_table, say, write_table
from .formatting import RESULT_DIGITS, Format, ShownUnit, from_to, in_words, significant
from .markup import as_latex
from .nomenclature import NOMENCLATURE
from .values import Interval, Uncertain

Value = float | str | Uncertain | None  # the value of a cell: a number, a word, or None
Table = tuple[list[TextColumn], list[TextColumn]]  # columns repeated in each part of a wide table, and the others
Part = str | Table  # a line, or a table


class Shown:
    """An object that a notebook shows as lines and tables; `print` shows them as on a terminal."""

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
    texts = []
    for part in parts:
        texts.append(f"<p>{escape(part)}</p>" if isinstance(part, str) else html_table(_joined(part)))
    return "\n".join(["<div>", *texts, "</div>"])


def as_tabular(parts: Iterable[Part]) -> str:
    """Return lines and tables as LaTeX: paragraphs, and tables with their symbols as formulas."""
    texts = []
    for part in parts:
        texts.append(as_latex(part) if isinstance(part, str) else _tabular(_joined(part)))
    return "\n\n".join(texts)


def _joined(table: Table) -> list[TextColumn]:
    """Return all columns of a table."""
    leading, others = table
    return [*leading, *others]


def _tabular(columns: Sequence[TextColumn]) -> str:
    """Return columns as a table of LaTeX."""
    cells = []
    for column in columns:
        texts = [column.head, *column.cells]
        if column.head == "symbol":
            texts[1:] = [f"⟦{text}⟧" for text in column.cells]
        cells.append([*map(as_latex, texts)])
    head, *rows = [" & ".join(row) + r" \\" for row in zip(*cells, strict=True)]
    alignment = "".join("r" if column.is_right else "l" for column in columns)
    return "\n".join([rf"\begin{{tabular}}{{{alignment}}}", head, r"\hline", *rows, r"\end{tabular}"])


# --- Cells ------------------------------------------------------------------------------------------------------------


def cell(value: Value, unit: ShownUnit, form: Format) -> str:
    """Return a value as text in a unit; by default, a number without uncertainty has exactly four digits."""
    if value is None or isinstance(value, str):
        return value or "–"
    if isinstance(value, Interval):
        return from_to(unit.convert(value.low), unit.convert(value.high), form.digits)
    if isinstance(value, float):
        zeros = form.digits is None and value != 0
        return significant(unit.convert(value), form.digits or RESULT_DIGITS, zeros=zeros)
    return form.in_unit(value, unit)


def columns_of(name: str, values: Mapping[str, Sequence[Value]], form: Format) -> list[TextColumn]:
    """Return columns of values of a quantity in a common unit. `values`: the values of each column, by its head."""
    unit = form.common_unit(name, [*chain.from_iterable(values.values())])
    in_unit = f" [{unit.text}]" if unit.text else ""
    columns = []
    for head, of_column in values.items():
        shown = [in_words(name, value) if isinstance(value, float) else value for value in of_column]
        cells = [cell(value, unit, form) for value in shown]
        columns.append(TextColumn(f"{head}{in_unit}", cells, is_right=not NOMENCLATURE[name].is_word))
    return columns
