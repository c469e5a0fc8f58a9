"""Tables on a terminal, set by rich."""

from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from functools import cached_property
from math import isnan
from typing import TYPE_CHECKING, Any, TextIO

from rich import box
from rich.console import Console
from rich.table import Column, Table
from rich.text import Text

from ..answers.alternatives import Alternative, head_of
from ..answers.notes import symbol_of
from ..quantities.formatting import Format, amount, in_words, pretty, significant, with_known_prefix
from ..quantities.laws import DEFAULT_LAW, LAWS
from ..quantities.nomenclature import NOMENCLATURE, PROPERTIES, of_sphere
from ..quantities.units import Unit, convert
from ..quantities.values import Interval
from ..rows.columns import DOUBT, as_list
from ..scene.alternatives import DATA
from ..scene.limits import OF_LAW, codes_of
from ..text import NO_BREAK_SPACE, fitting, say, terminal_width, wrapped

if TYPE_CHECKING:
    from ..answers.answer import Answer
    from ..answers.questions import Grid
    from ..answers.results import Result
    from ..quantities.values import Uncertain
    from ..rows.columns import Columns

_NAMED = ("quantity", "symbol", "unit")
MAX_ACROSS = 20  # pairs that are tried as columns
MIN_WRAPPED = 16  # characters of a column of texts on a narrow terminal
GAP = 2  # between two columns
_DIGITS = 4  # of a value on a terminal
_OF_A_RANGE = 2  # of its ends


def scene_table(answer: "Answer", out: TextIO, form: Format) -> None:
    """Write the inputs of one scene, and its results below each other, or in a grid if it fits.

    What may stand in their place has columns beside them; those that do not fit are a second table.
    """
    for line in _head(answer, form):
        say(line, out)
    grid = answer.question.grid
    if grid and not any(result.law for result in answer.results) and _print(_grid_table(grid, answer, out, form), out):
        _second_table(answer, _beside(answer), out, form)
        return
    columns = _beside(answer)
    for count in range(len(columns), -1, -1):
        if _print_results(answer, columns[:count], out, form):
            _second_table(answer, columns[count:], out, form)
            return
    if _print_results(answer, [], out, form, heads=_NAMED[1:]):
        _second_table(answer, columns, out, form)
    else:
        for result in _rows(answer):
            row = _result_cells(result, answer, form)
            say(" ".join(row[head] for head in ("symbol", _own_head(answer), "unit") if row[head]), out)


def _rows(answer: "Answer") -> "list[Result]":
    """Return the results that have a row: those without a note of their own, or another result of the same value."""
    values = {result.value for result in answer.results if not NOMENCLATURE[result.name].note}
    return [
        one
        for one in answer.results
        if one.name not in answer.question.beside
        and not (one.value is not None and NOMENCLATURE[one.name].note and one.value in values)
    ]


def _beside(answer: "Answer") -> "list[Alternative]":
    """Return what has columns beside the results: what may stand in their place, and limits of theirs."""
    values = {result.name: result.value for result in answer.results}
    limits = [
        Alternative(column[1], column[1], {column[0]: values[limit]})
        for limit, column in answer.question.beside.items()
        if column and values.get(limit) is not None and column[1] != _own_head(answer)
    ]
    return [*answer.alternatives, *limits]


def _print_results(
    answer: "Answer", beside: "Sequence[Alternative]", out: TextIO, form: Format, heads: Sequence[str] = _NAMED
) -> bool:
    """Print the results with some alternatives beside them, if the terminal is wide enough, and return whether it was."""
    *named, unit = heads
    values = [_own_head(answer), *(one.head for one in beside)]
    rows = _rows(answer)
    cells = [_result_cells(result, answer, form) for result in rows]
    # Dimmed is what stands beside a headline, or has no value.
    styles = ["dim" if NOMENCLATURE[result.name].note or result.value is None else "" for result in rows]
    texts = [[row[head] for head in (*named, *values, unit)] for row in cells]
    return _print(_table([*named, *values, unit], texts, out, {*values}, styles), out)


def _second_table(answer: "Answer", beside: "Sequence[Alternative]", out: TextIO, form: Format) -> None:
    """Write alternatives below the table of the results that they differ from, if there are some."""
    differing = {name for one in beside for name, value in one.values.items() if value is not None}
    rows = [_result_cells(result, answer, form) for result in _rows(answer) if result.name in differing]
    if rows:
        heads = ["symbol", *(one.head for one in beside), "unit"]
        say("", out)
        _print(_table(heads, [[row[head] for head in heads] for row in rows], out, {*heads[1:-1]}), out, anyway=True)


def _own_head(answer: "Answer") -> str:
    """Return the head of the values of the law in use."""
    return head_of(answer.scene.law.name)


def _grid_table(grid: "Grid", answer: "Answer", out: TextIO, form: Format) -> Table:
    """Return the table of a grid; the quantities of a cell stand below each other."""
    found: dict[str, Any] = {**answer.inputs, **answer.uncertain}
    found |= {one.name: one.measure for one in answer.results}

    def cell(names: tuple[str, ...]) -> str:
        values = ((name, found.get(name)) for name in names)
        return "\n".join("–" if value is None else _with_unit(name, value, form) for name, value in values)

    rows = [[label, *map(cell, cells)] for label, cells in grid.rows.items()]
    return _table(grid.heads, rows, out, grid.heads[1:])


def _result_cells(result: "Result", answer: "Answer", form: Format) -> dict[str, str]:
    """Return the cells of a result by the heads of their columns, and of what may stand in its place, all in one unit."""
    quantity, own, value = NOMENCLATURE[result.name], _own_head(answer), result.measure
    cells = {"quantity": quantity.sentence, "symbol": symbol_beside(result.name, answer.inputs)}
    beside = _beside(answer)
    others = {one.head: one.values.get(result.name) for one in beside}
    known = [each for each in (value, *others.values()) if each is not None]
    unit = _unit(result.name, known[:1], form)
    cells[own] = "–" if value is None else _cell(value, unit, form)
    for one in beside:
        other = others[one.head]
        is_same = result.name not in one.values and value is not None
        cells[one.head] = f"as {own}" if is_same else one.none if other is None else _cell(other, unit, form)
    return {**cells, "unit": pretty(unit[0]) if known else ""}


def _unit(name: str, values: "Sequence[float | Uncertain]", form: Format) -> tuple[str, Unit]:
    """Return the unit that suits values, or else that of the quantity."""
    text, unit = form.common_unit(name, values) or (form.unit(name).removeprefix("1"), Unit(1, 1, ()))
    return with_known_prefix(name, text), unit


def _with_unit(name: str, value: "float | Uncertain", form: Format) -> str:
    """Return a value with its unit, which has a prefix that is known, or none."""
    unit = _unit(name, [value], form)
    if unit[0].startswith("1e"):
        unit = form.unit(name), Unit(1, 1, ())
    return f"{_cell(value, unit, form)} {pretty(unit[0])}".strip()


def _cell(value: "float | str | Uncertain", unit: tuple[str, Unit], form: Format) -> str:
    """Return a value in a unit: with four digits and their zeros, a range with two, or with its error bar."""
    if isinstance(value, str) or (isinstance(value, tuple) and value.kind != "range"):
        return form.in_unit(value, unit)
    if isinstance(value, tuple):
        ends = (convert(end, unit[1]) for end in (value.low, value.high))
        return "–".join(dict.fromkeys(significant(end, form.digits or _OF_A_RANGE) for end in ends))
    number = convert(value, unit[1])
    keeps_zeros = form.digits is None and number and not 10**_DIGITS <= abs(number) < 10**6
    text = f"{number:#.{_DIGITS}g}" if keeps_zeros else significant(number, form.digits or _DIGITS)
    return text.removesuffix(".")


_LEADERS = dict.fromkeys(PROPERTIES, "material") | {of_sphere(2, name): "material2" for name in PROPERTIES}


def sweep_table(columns: "Columns", out: TextIO, form: Format) -> None:
    """Write a table of several pairs; inputs that all of them share stand above.

    A pair is a row. Where that is wider than the terminal, a pair is a column, and where this is too wide as well, a
    row again, of as many tables as it takes.
    """
    cells = _Cells(columns, form)
    common = {name: values[0] for name, values in cells.inputs.items() if len({*values}) == 1}
    say(_broken([cells.counted(common), *_described(common, form)]), out)
    several = [name for name, values in cells.inputs.items() if len({*values} - {None}) != 1]
    leading = [name for name in several if not cells.is_implied(name)]
    results = [key for name in columns.wanted.names if name not in cells.inputs for key in (name, *cells.beside(name))]
    results += [DOUBT] if any(cells.doubts) else []
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

    @cached_property
    def doubts(self) -> list[str]:
        """The worst doubt of each pair, with the number of others; one about the law has a column of values."""
        texts = []
        for bits in as_list(self.columns.doubts):
            codes = codes_of(bits & ~OF_LAW)
            texts.append(codes[0] + (f" ({len(codes) - 1} more)" if codes[1:] else "") if codes else "")
        return texts

    def counted(self, common: Collection[str]) -> str:
        """Return how many pairs, or states of one, there are; `common`: the inputs that all of them share."""
        if "state" in self.inputs:
            return f"{len(self.columns)} states"
        is_equal = "radius2" in self.inputs and "radius2" not in common and self.is_implied("radius2")
        return f"{len(self.columns)} pairs" + (" of equal spheres (R2 = R1)" if is_equal else "")

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
        if key == DOUBT:
            return [DOUBT, *self.doubts]
        if not kind:
            return column(name, self.values(name), self.form, exactly=name in self.inputs)
        ends = [self.columns.column(each) for each in self._ends(name, kind)]
        own = self.form.common_unit(name, [value for value in self.values(name) if value is not None])
        unit = own or _unit(name, [], self.form)
        head = "by 1 µm data" if kind in DATA else f"{symbol_of(name)} by {head_of(kind)}"
        cells = []
        for row in zip(*map(as_list, ends), strict=True):
            if any(map(isnan, row)):
                cells.append("no data" if kind in DATA else "–")
            else:
                value = row[0] if len(row) == 1 else Interval(sum(row) / 2, min(row), max(row))
                cells.append(_cell(value, unit, self.form))
        return [head if own or not unit[0] else f"{head} [{pretty(unit[0])}]", *cells]

    def _ends(self, name: str, kind: str) -> list[str]:
        keys = self.columns.wanted.beside(name)
        return [keys[end] for end in DATA] if kind in DATA else [keys[kind]]

    def table(self, names: Sequence[str], out: TextIO) -> Table:
        """Return a table with a row for each pair."""
        columns = [self.column(name) for name in names]
        heads = [column[0] for column in columns]
        right = {*heads} - {DOUBT, *(NOMENCLATURE[name].symbol or name for name in names if self.is_word(name))}
        return _table(heads, [*zip(*(column[1:] for column in columns), strict=True)], out, right)

    @staticmethod
    def is_word(name: str) -> bool:
        """Return whether a column has words, and no numbers."""
        return name in NOMENCLATURE and NOMENCLATURE[name].is_word

    def across(self, leading: Sequence[str], results: Sequence[str], out: TextIO) -> Iterator[Table]:
        """Iterate over tables with a column for each pair and a row for each result: with the words for it, and without."""
        numbers = ["pair", *(str(number) for number in range(1, len(self.columns) + 1))]
        distinct = [self.column(name) for name in leading] or [numbers]
        heads = ["\n".join(parts) for parts in zip(*distinct, strict=True)]
        rows = [self.column(name) for name in results]
        words = [NOMENCLATURE[key].sentence if key in NOMENCLATURE else "" for key in results]
        yield _table(
            ["quantity", *heads], [[word, *row] for word, row in zip(words, rows, strict=True)], out, set(heads[1:])
        )
        yield _table(heads, rows, out, set(heads[1:]))

    def is_implied(self, name: str) -> bool:
        """Return whether an input repeats another: sphere 2 is as large as sphere 1, or the material sets a property."""
        if name == "energy":
            return "energy_ratio" in self.inputs
        if name == "surface_energy":
            return False
        if name == "radius2":
            return self.inputs[name] == self.inputs.get("radius")
        leader = self.inputs.get(_LEADERS.get(name, ""))
        if leader is None or None in leader:
            return False
        pairs = {*zip(leader, self.inputs[name], strict=True)}
        return len(pairs) == len({material for material, _ in pairs})


def column(
    name: str, values: "Sequence[float | str | Uncertain | None]", form: Format, *, exactly: bool = True
) -> list[str]:
    """Return the head and the cells of a column; the head has the unit, if one suits all of its values.

    `exactly`: whether values keep their digits, as inputs do; results have four.
    """
    head = NOMENCLATURE[name].symbol or name
    numbers = [value for value in values if value is not None and not isinstance(value, str)]
    common = form.common_unit(name, numbers)
    if exactly and not common:
        return [head, *("–" if value is None else amount(name, value, form) for value in values)]
    unit = common or _unit(name, [], form)
    cells = [
        "–" if value is None else form.in_unit(value, unit) if exactly else _cell(value, unit, form) for value in values
    ]
    return [f"{head} [{pretty(unit[0])}]" if unit[0] else head, *cells]


def symbol_beside(name: str, inputs: Collection[str]) -> str:
    """Return the symbol of a quantity, without the index of sphere 1 where no other value is that of sphere 2."""
    quantity = NOMENCLATURE[name]
    is_of_both = quantity.sphere == 1 and quantity.twin not in inputs and name != "radius"
    return symbol_of(name).removesuffix("1") if is_of_both else symbol_of(name)


def _head(answer: "Answer", form: Format) -> Iterator[str]:
    """Iterate over the lines above a table: the inputs that were given, and those that were assumed."""
    given = {name: one for name, one in {**answer.inputs, **answer.uncertain}.items() if name not in answer.assumed}
    if "energy_ratio" in answer.inputs:
        given.pop("energy", None)  # which follows from it
    if parts := _described(given, form, answer.scene.data):
        yield _broken(parts)
    for note in answer.notes:
        if note.kind == "assumed":
            yield _broken([note.text])


def _described(
    inputs: "Mapping[str, float | str | Uncertain]", form: Format, of_materials: Collection[str] = ()
) -> list[str]:
    """Return inputs in words: materials with the values that are theirs in brackets, and what was typed."""
    texts = {name: f"{symbol_beside(name, inputs)} = {amount(name, value, form)}" for name, value in inputs.items()}
    if "surface_energy" in texts and "surface_energy2" not in texts:
        texts["surface_energy"] += " per surface"
    if "radius2" in texts and inputs["radius2"] in (inputs.get("radius"), "plane"):
        is_plane = inputs["radius2"] == "plane"
        radius = amount("radius", inputs["radius"], form)
        texts["radius"] = f"R1 = {radius} on a plane" if is_plane else f"R1 = R2 = {radius}"
        del texts["radius2"]
    for leader in ("material", "material2"):
        if leader in texts:
            own = [name for name in texts if _LEADERS.get(name) == leader and name in of_materials]
            data = ", ".join(texts.pop(name) for name in own)
            texts[leader] = f"{inputs[leader]} ({data})" if data else str(inputs[leader])
    return [*texts.values()]


def _broken(parts: Iterable[str]) -> str:
    """Return parts of a sentence as one, in lines that fit; what belongs together stays so."""
    joined = ", ".join(parts).replace(" (--", f"{NO_BREAK_SPACE}(--").replace("no load", f"no{NO_BREAK_SPACE}load")
    return "\n".join(wrapped(joined, terminal_width(), 2))


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
    table = Table(box=box.SIMPLE_HEAD, padding=(0, 1, 0, 0), pad_edge=False, show_edge=False)
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
