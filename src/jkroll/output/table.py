"""Tables on a terminal, set by rich."""

from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from math import isnan
from typing import TYPE_CHECKING, Any, TextIO

from rich import box
from rich.console import Console
from rich.table import Column, Table
from rich.text import Text

from ..answers.alternatives import head_of
from ..answers.notes import parts_of_assumed, symbol_of
from ..quantities.formatting import Format, amount, in_words, pretty, significant
from ..quantities.laws import DEFAULT_LAW, LAWS
from ..quantities.nomenclature import NOMENCLATURE, PROPERTIES, of_sphere
from ..quantities.units import Unit, convert
from ..quantities.values import Interval
from ..rows.columns import as_list
from ..scene.alternatives import DATA
from ..scene.limits import OF_LAW
from ..text import fitting, say, terminal_width

if TYPE_CHECKING:
    from ..answers.answer import Answer
    from ..answers.questions import Grid
    from ..answers.results import Result
    from ..quantities.values import Uncertain
    from ..rows.columns import Columns

_AMOUNT = ("symbol", "value", "unit")
_NAMED = ("quantity", *_AMOUNT)
# The columns of a scene's table, for narrower and narrower terminals: of results, and of results by convention.
_COLUMNS: Sequence[tuple[str, ...]] = ((*_NAMED, "Eq"), _NAMED, _AMOUNT)
_COLUMNS_BY_CONVENTION: Sequence[tuple[str, ...]] = (
    (*_NAMED, "definition", "reference"),
    (*_NAMED, "definition"),
    _NAMED,
    _AMOUNT,
)
_TEXTS = ("quantity", "definition", "reference")  # which may be broken into lines, the last columns first
MAX_ACROSS = 20  # scenes that are tried as columns
MIN_WRAPPED = 16  # characters of a column of texts on a narrow terminal
GAP = 3  # between two columns
_DIGITS_BESIDE = 4  # of a value that may stand in place of another


def scene_table(answer: "Answer", out: TextIO, form: Format) -> None:
    """Write the inputs of one scene, and its results below each other, or in a grid if it fits.

    What may stand in their place has columns beside them, or a second table where these do not fit.
    """
    say(_inputs({**answer.inputs, **answer.uncertain}, form, assumed=answer.assumed), out)
    grid = answer.question.grid
    if grid and not any(result.law for result in answer.results) and _print(_grid_table(grid, answer, out, form), out):
        _second_table(answer, out, form)
        return
    results = [one for one in answer.results if one.value is None or one.name not in answer.question.noted]
    by_convention = all(NOMENCLATURE[result.name].definition for result in results)
    columns_of = _COLUMNS_BY_CONVENTION if by_convention else _COLUMNS
    rows = [_result_cells(result, answer, form) for result in results]
    if answer.alternatives:
        named = ("quantity", "symbol", _own_head(answer), *(one.head for one in answer.alternatives), "unit")
        of_conventions = (*named, "definition", "reference")
        if _print_first(results, rows, [of_conventions if by_convention else named], out):
            return
        if not by_convention and _print_first(results, rows, [named], out, ("quantity",)):
            return
    if _print_first(results, rows, columns_of, out, _TEXTS):
        _second_table(answer, out, form)
        return
    for row in rows:
        say(" ".join(row[head] for head in _AMOUNT if row[head]), out)


def _print_first(
    results: "Sequence[Result]",
    rows: Sequence[Mapping[str, str]],
    columns_of: Iterable[Sequence[str]],
    out: TextIO,
    wrapped: Collection[str] = (),
) -> bool:
    """Print the first of some choices of columns that fits, if one does; its texts are broken into lines where that helps."""
    # Dimmed is what stands beside a headline, or has no value.
    styles = ["dim" if NOMENCLATURE[result.name].note or result.value is None else "" for result in results]
    for heads in columns_of:
        cells = [[row[head] for head in heads] for row in rows]
        texts = [head for head in reversed(heads) if head in wrapped]
        right = {head for head in heads if head not in (*_TEXTS, "symbol", "unit")}
        for count in range(len(texts) + 1):
            if _print(_table(heads, cells, out, right, styles, texts[:count]), out):
                return True
    return False


def _second_table(answer: "Answer", out: TextIO, form: Format) -> None:
    """Write what may stand in place of results below their table, if there is something."""
    differing = {name for one in answer.alternatives for name, value in one.values.items() if value is not None}
    results = [result for result in answer.results if result.name in differing]
    if results:
        say("", out)
        rows = [_result_cells(result, answer, form) for result in results]
        _print_first(results, rows, [("symbol", *(one.head for one in answer.alternatives), "unit")], out)


def _own_head(answer: "Answer") -> str:
    """Return the head of the values of the law in use."""
    return head_of(answer.scene.law.name)


def _grid_table(grid: "Grid", answer: "Answer", out: TextIO, form: Format) -> Table:
    """Return the table of a grid; the quantities of a cell stand below each other."""
    found: dict[str, Any] = {**answer.inputs, **answer.uncertain}
    found |= {one.name: one.measure for one in answer.results}

    def cell(names: tuple[str, ...]) -> str:
        values = ((name, found.get(name)) for name in names)
        return "\n".join("—" if value is None else amount(name, value, form) for name, value in values)

    rows = [[label, *map(cell, cells)] for label, cells in grid.rows.items()]
    return _table(grid.heads, rows, out, grid.heads[1:])


def _result_cells(result: "Result", answer: "Answer", form: Format) -> dict[str, str]:
    """Return the cells of a result by the heads of their columns, and of what may stand in its place in the same unit."""
    quantity = NOMENCLATURE[result.name]
    value, unit = ("—", "") if (found := result.measure) is None else form.rounded(result.name, found)
    definition, reference = ("", "") if result.law else (quantity.definition, quantity.reference)
    others = {one.head: one.values[result.name] for one in answer.alternatives if result.name in one.values}
    known = [other for other in (found, *others.values()) if other is not None]
    scale = form.common_unit(result.name, known[:1]) if known else None
    scale = scale or (form.unit(result.name).removeprefix("1"), Unit(1, 1, ()))
    cells = {}
    for one in answer.alternatives:
        same = "" if result.value is None else f"as {_own_head(answer)}"
        other = others.get(one.head)
        cells[one.head] = one.none if other is None else _short(other, scale, form)
        if one.head not in others:
            cells[one.head] = same
    return {
        "quantity": quantity.sentence,
        "symbol": quantity.symbol,
        "value": value,
        _own_head(answer): value,
        "unit": pretty(unit or (scale[0] if known else "")),
        "Eq": result.equation,
        "definition": definition,
        "reference": reference or result.source,
        **cells,
    }


def _short(value: "float | Uncertain", unit: tuple[str, Unit], form: Format) -> str:
    """Return a value beside another in its unit: with four digits, a range with two, or with its error bar."""
    if isinstance(value, tuple) and value.kind != "range":
        return form.in_unit(value, unit)
    if isinstance(value, tuple):
        ends = (convert(end, unit[1]) for end in (value.low, value.high))
        return "–".join(dict.fromkeys(significant(end, form.digits or 2) for end in ends))
    number = convert(value, unit[1])
    text = significant(number, form.digits or _DIGITS_BESIDE)
    keeps_zeros = form.digits is None and 1e-4 <= abs(number) < 10**_DIGITS_BESIDE
    return f"{number:#.{_DIGITS_BESIDE}g}".removesuffix(".") if keeps_zeros else text


_LEADERS = dict.fromkeys(PROPERTIES, "material") | {of_sphere(2, name): "material2" for name in PROPERTIES}


def sweep_table(columns: "Columns", out: TextIO, form: Format) -> None:
    """Write a table of several scenes; inputs that all of them share stand above.

    A scene is a row. Where that is wider than the terminal, a scene is a column, and where this is too wide as well, a
    row again, of as many tables as it takes.
    """
    cells = _Cells(columns, form)
    common = {name: values[0] for name, values in cells.inputs.items() if len({*values}) == 1}
    say(_inputs(common, form, f"{len(columns)} scenes"), out)
    several = [name for name, values in cells.inputs.items() if len({*values} - {None}) != 1]
    leading = [name for name in several if not cells.is_implied(name)]
    results = [key for name in columns.wanted.names if name not in cells.inputs for key in (name, *cells.beside(name))]
    if _print(cells.table([*leading, *results], out), out):
        return
    if len(columns) <= MAX_ACROSS and any(_print(table, out) for table in cells.across(leading, results, out)):
        return
    while results:
        count = len(results)
        while not _print(cells.table([*leading, *results[:count]], out), out, anyway=count == 1):
            count -= 1
        results = results[count:]


class _Cells:
    """The values of columns as they are printed, with their uncertainties."""

    def __init__(self, columns: "Columns", form: Format) -> None:
        self.columns, self.form = columns, form
        self.inputs: dict[str, list[Any]] = {
            name: [in_words(name, value) for value in column] for name, column in columns.inputs.items()
        }

    def values(self, name: str) -> list[Any]:
        """Return inputs or results, with their uncertainties if they have some; None is a gap."""
        if name in self.inputs:
            return self.inputs[name]
        columns = self.columns
        found = [None if isnan(value) else float(value) for value in columns.column(name)]
        if not (keys := columns.wanted.sides_of(name)):
            return found
        from ..quantities.values import of_sides

        sides = [{side: columns.column(key)[row] for side, key in keys.items()} for row in range(len(columns))]
        return [None if value is None else of_sides(value, own) for value, own in zip(found, sides, strict=True)]

    def beside(self, name: str) -> list[str]:
        """Return the keys of the columns beside a quantity: by the other law where that moves a result, and by measured forces if there are some."""
        keys = self.columns.wanted.beside(name)
        law_matters = any(bits & OF_LAW for bits in as_list(self.columns.doubts)) or DEFAULT_LAW in keys
        found = [key for kind, key in keys.items() if kind in LAWS and law_matters]
        has_data = DATA[0] in keys and not all(map(isnan, self.columns.column(keys[DATA[0]])))
        return [*found, *([keys[DATA[0]]] if has_data else [])]

    def column(self, key: str) -> list[str]:
        """Return the head and the cells of a column: of an input, of a result, or of what may stand in its place."""
        name, _, kind = key.partition("_by_")
        if not kind:
            return column(name, self.values(name), self.form)
        ends = [self.columns.column(each) for each in self._ends(name, kind)]
        own = self.form.common_unit(name, [value for value in self.values(name) if value is not None])
        unit = own or (self.form.unit(name).removeprefix("1"), Unit(1, 1, ()))
        head = "by 1 µm data" if kind in DATA else f"{symbol_of(name)} by {head_of(kind)}"
        cells = []
        for row in zip(*map(as_list, ends), strict=True):
            if any(map(isnan, row)):
                cells.append("no data" if kind in DATA else "–")
            else:
                value = row[0] if len(row) == 1 else Interval(sum(row) / 2, min(row), max(row))
                cells.append(_short(value, unit, self.form))
        return [head if own or not unit[0] else f"{head} [{pretty(unit[0])}]", *cells]

    def _ends(self, name: str, kind: str) -> list[str]:
        keys = self.columns.wanted.beside(name)
        return [keys[end] for end in DATA] if kind in DATA else [keys[kind]]

    def table(self, names: Sequence[str], out: TextIO) -> Table:
        """Return a table with a row for each scene."""
        columns = [self.column(name) for name in names]
        heads = [column[0] for column in columns]
        return _table(heads, [*zip(*(column[1:] for column in columns), strict=True)], out, set(heads))

    def across(self, leading: Sequence[str], results: Sequence[str], out: TextIO) -> Iterator[Table]:
        """Iterate over tables with a column for each scene and a row for each result: with the words for it, and without."""
        numbers = ["scene", *(str(number) for number in range(1, len(self.columns) + 1))]
        distinct = [self.column(name) for name in leading] or [numbers]
        heads = ["\n".join(parts) for parts in zip(*distinct, strict=True)]
        rows = [self.column(name) for name in results]
        words = [
            NOMENCLATURE[key].sentence if key in NOMENCLATURE else row[0]
            for key, row in zip(results, rows, strict=True)
        ]
        yield _table(
            ["quantity", *heads], [[word, *row] for word, row in zip(words, rows, strict=True)], out, set(heads[1:])
        )
        yield _table(heads, rows, out, set(heads[1:]))

    def is_implied(self, name: str) -> bool:
        """Return whether an input repeats another: sphere 2 is as large as sphere 1, or the material sets a property."""
        if name == "energy":
            return "energy_ratio" in self.inputs
        if name == "radius2":
            return self.inputs[name] == self.inputs.get("radius")
        leader = self.inputs.get(_LEADERS.get(name, ""))
        if leader is None or None in leader:
            return False
        pairs = {*zip(leader, self.inputs[name], strict=True)}
        return len(pairs) == len({material for material, _ in pairs})


def column(name: str, values: "Sequence[float | str | Uncertain | None]", form: Format) -> list[str]:
    """Return the head and the cells of a column; the head has the unit, if one suits all of its values."""
    head = NOMENCLATURE[name].symbol or name
    common = form.common_unit(name, [value for value in values if not isinstance(value, str | None)])
    if common:
        cells = ["—" if value is None else form.in_unit(value, common) for value in values]
        return [f"{head} [{pretty(common[0])}]", *cells]
    return [head, *("—" if value is None else amount(name, value, form) for value in values)]


def _inputs(
    inputs: "Mapping[str, float | str | Uncertain]", form: Format, start: str = "", assumed: Sequence[str] = ()
) -> str:
    """Return the inputs as understood, those that were assumed last, broken into lines between two of them."""
    texts = {name: amount(name, value, form) for name, value in inputs.items() if name not in assumed}
    parts = [text if name == "material" else f"{symbol_of(name)} = {text}" for name, text in texts.items()]
    lines = [start]
    for part in [*parts, *parts_of_assumed(assumed)]:
        if lines[-1] and len(lines[-1]) + len(part) + 2 >= terminal_width():
            lines[-1] += ","
            lines.append("")
        lines[-1] += f", {part}" if lines[-1] else part
    return "\n".join(lines)


def write_rows(heads: Sequence[str], rows: Sequence[Sequence[str]], out: TextIO) -> None:
    """Write a table of texts, or, on a terminal too narrow for it, a line for each cell."""
    if not _print(_table(heads, [list(map(pretty, row)) for row in rows], out), out):
        for row in rows:
            for head, cell in zip(heads, row, strict=True):
                say(f"{head}: {cell}", out)


def write_wrapped(heads: Sequence[str], rows: Sequence[Sequence[str]], out: TextIO) -> None:
    """Write a table of texts whose last column is broken into lines, within a word that is longer than the column."""
    _print(_table(heads, rows, out, wrapped=heads[-1:]), out, anyway=True)


def _table(
    heads: Sequence[str],
    rows: Sequence[Sequence[str]],
    out: TextIO,
    right: Collection[str] = (),
    styles: Sequence[str] = (),
    wrapped: Collection[str] = (),
) -> Table:
    """Return a table of texts, with a style for each row if any.

    The columns named in `right` are set to the right, and those in `wrapped` broken into lines, within a word that is
    too long.
    """
    table = Table(box=box.SIMPLE_HEAD, pad_edge=False, show_edge=False)
    for head in heads:
        table.add_column(
            Text(fitting(head, out)),
            justify="right" if head in right else "left",
            no_wrap=head not in wrapped,
            overflow="fold" if head in wrapped else "ellipsis",
        )
    for row, style in zip(rows, styles or [""] * len(rows), strict=True):
        table.add_row(*(Text(fitting(cell, out), style) for cell in row))
    return table


def _print(table: Table, out: TextIO, *, anyway: bool = False) -> bool:
    """Print a table if the terminal is wide enough for it, or anyway, and return whether it was printed."""
    console = Console(file=out, width=terminal_width(), highlight=False, markup=False, emoji=False)
    width = sum(_least_width(column, console) for column in table.columns) + GAP * (len(table.columns) - 1)
    if width > console.width and not anyway:
        return False
    console.width = max(width, console.width)
    console.print(table)
    return True


def _least_width(column: Column, console: Console) -> int:
    """Return the width of the longest cell of a column, or as much of it as a column has at least that is broken into lines."""
    cells = (column.header, *column.cells)
    width = max(console.measure(cell, options=console.options.update(width=10_000)).maximum for cell in cells)
    return width if column.no_wrap else min(width, MIN_WRAPPED)
