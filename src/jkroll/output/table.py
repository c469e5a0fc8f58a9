"""Tables on a terminal, set by rich."""

from collections.abc import Collection, Iterable, Mapping, Sequence
from functools import cached_property
from itertools import zip_longest
from math import isnan
from typing import TYPE_CHECKING, Any, NamedTuple, TextIO

from rich import box
from rich.console import Console
from rich.table import Table
from rich.text import Text

from ..answers.notes import symbol_beside
from ..quantities.formatting import Format, amount, from_to, in_words, pretty, significant, with_known_prefix
from ..quantities.laws import DEFAULT_LAW, LAWS
from ..quantities.nomenclature import NOMENCLATURE, PROPERTIES, of_sphere
from ..quantities.units import Unit, convert
from ..quantities.values import of_sides
from ..rows.columns import DOUBT, as_list
from ..scene.alternatives import DATA, SIO2, rolled_solid
from ..scene.limits import OF_LAW, codes_of
from ..text import fitting, say, say_wrapped, terminal_width

if TYPE_CHECKING:
    from ..answers.answer import Answer
    from ..answers.questions import Grid
    from ..answers.results import Result
    from ..quantities.values import Uncertain
    from ..rows.columns import Columns

MAX_ACROSS = 20  # pairs that are tried as columns
LIST_WIDTH = 80  # of a list with texts in several lines, on a narrower terminal
_UNLIMITED = 10_000  # width of a terminal on which every table fits
_DIGITS = 4  # of a value on a terminal
_OF_A_RANGE = 2  # of its ends
_NONE = "–"
_LEADERS = dict.fromkeys(PROPERTIES, "material") | {of_sphere(2, name): "material2" for name in PROPERTIES}


class Column(NamedTuple):
    """A column of texts. Numbers are set to the right; `meaning` says what a result is.

    `below`: of what may stand in place of a result, the head where it is not beside the result, with its unit.
    """

    head: str
    cells: Sequence[str]
    is_right: bool = True
    meaning: str = ""
    below: str = ""


# --- One scene --------------------------------------------------------------------------------------------------------


def scene_table(answer: "Answer", out: TextIO, form: Format) -> None:
    """Write the inputs of one scene, and its results below each other, or in a grid if it fits.

    What may stand in their place has columns beside them; those that do not fit are a second table.
    """
    _write_inputs([], answer.measures, answer.assumed, out, form)
    results, others = _results(answer), _others(answer)
    grid, printed = answer.question.grid, []
    if not grid or any(result.law for result in results) or not print_table(_grid(grid, answer, form), out):
        quantity, symbol, own, *columns, unit = _scene_columns(results, others, answer, form)
        # Dimmed is what stands beside a headline, or has no value.
        styles = ["dim" if NOMENCLATURE[result.name].note or result.value is None else "" for result in results]
        tables = ([quantity, symbol, own, *columns[:count], unit] for count in range(len(columns), -1, -1))
        printed = next((table for table in tables if print_table(table, out, styles=styles)), [])
        if not printed:
            print_table([symbol, own, unit], out, styles=styles, anyway=True)
    left = {head: values for head, values in others.items() if head not in {column.head for column in printed}}
    rest = [result for result in results if any(values.get(result.name) is not None for values in left.values())]
    if rest:
        say("", out)
        quantity, symbol, _, *columns, unit = _scene_columns(rest, left, answer, form)
        if not print_table([quantity, symbol, *columns, unit], out):
            print_table([symbol, *columns, unit], out, anyway=True)


def _results(answer: "Answer") -> "list[Result]":
    """Return the results that have a row: those without a note of their own, or another result of the same value."""
    values = {result.value for result in answer.results if not NOMENCLATURE[result.name].note}
    return [
        result
        for result in answer.results
        if result.name not in answer.question.beside
        and not (result.value is not None and NOMENCLATURE[result.name].note and result.value in values)
    ]


def _others(answer: "Answer") -> dict[str, Mapping[str, Any]]:
    """Return what has columns beside the results, by head: what may stand in their place, and limits of theirs."""
    data = "by 1 µm data" if rolled_solid(answer.scene) == SIO2 else "by 5 µm data"
    others = {data if kind == DATA else head_of(kind): values for kind, values in answer.alternatives.items()}
    values = {result.name: result.value for result in answer.results}
    for limit, column in answer.question.beside.items():
        if column and values.get(limit) is not None and column[1] != head_of(answer.scene.law.name):
            others[column[1]] = {column[0]: values[limit]}
    return others


def head_of(law: str) -> str:
    """Return the head of the column of a law."""
    return LAWS[law].title.partition("–")[0]


def _scene_columns(
    results: "Iterable[Result]", others: Mapping[str, Mapping[str, Any]], answer: "Answer", form: Format
) -> list[Column]:
    """Return the columns of results: words, symbols, values, what may stand in their place, and the unit of a row."""
    own = head_of(answer.scene.law.name)
    rows = []
    for result in results:
        name, value = result.name, result.measure
        same = None if value is None else f"as {own}"
        values = [value, *(of_other.get(name, same) for of_other in others.values())]
        numbers = [each for each in values if each is not None and not isinstance(each, str)]
        unit = _unit(name, numbers[:1], form)
        words = [NOMENCLATURE[name].sentence, symbol_beside(name, answer.inputs)]
        rows.append([*words, *(_cell(each, unit, form) for each in values), pretty(unit[0]) if numbers else ""])
    columns = zip(["quantity", "symbol", own, *others, "unit"], zip(*rows, strict=True), strict=True)
    return [Column(head, cells, head not in ("quantity", "symbol", "unit")) for head, cells in columns]


def _grid(grid: "Grid", answer: "Answer", form: Format) -> list[Column]:
    """Return the columns of a grid. Quantities of a cell stand below each other."""
    measures: dict[str, Any] = {**answer.measures, **{result.name: result.measure for result in answer.results}}

    def with_unit(name: str) -> str:
        value = measures.get(name)
        unit = _unit(name, [] if value is None else [value], form)
        if unit[0].startswith("1e"):
            unit = form.unit(name), Unit(1, 1, ())
        return f"{_cell(value, unit, form)} {pretty(unit[0])}".strip()

    cells = zip(*(["\n".join(map(with_unit, names)) for names in row] for row in grid.rows.values()), strict=True)
    labels, *heads = grid.heads
    return [Column(labels, [*grid.rows], False), *map(Column, heads, cells)]


def _unit(name: str, values: "Sequence[float | Uncertain]", form: Format) -> tuple[str, Unit]:
    """Return the unit that suits values, or else that of the quantity."""
    text, unit = form.common_unit(name, values) or (form.unit(name).removeprefix("1"), Unit(1, 1, ()))
    return with_known_prefix(name, text), unit


def _cell(value: "float | str | Uncertain | None", unit: tuple[str, Unit], form: Format, none: str = _NONE) -> str:
    """Return a value in a unit: with four digits and their zeros, a range with two, or with its error bar."""
    if value is None:
        return none
    if isinstance(value, str) or (isinstance(value, tuple) and value.kind != "range"):
        return form.in_unit(value, unit)
    if isinstance(value, tuple):
        return from_to(convert(value.low, unit[1]), convert(value.high, unit[1]), form.digits or _OF_A_RANGE)
    number = convert(value, unit[1])
    keeps_zeros = form.digits is None and number and not 10**_DIGITS <= abs(number) < 10**6
    text = f"{number:#.{_DIGITS}g}" if keeps_zeros else significant(number, form.digits or _DIGITS)
    return text.removesuffix(".")


# --- Lists ------------------------------------------------------------------------------------------------------------


def sweep_table(columns: "Columns", out: TextIO, form: Format, assumed: Mapping[str, str]) -> None:
    """Write a table of several pairs; inputs that all of them share stand above, and what was assumed, by name.

    A pair is a row. Where that is wider than the terminal, a pair is a column, and where this is too wide as well, a
    row again, of as many tables as it takes: those of results, then of what may stand in their place.
    """
    pairs = _Pairs(columns, form)
    common = {name: values[0] for name, values in pairs.inputs.items() if len({*values}) == 1}
    _write_inputs([pairs.counted(common)], common, assumed, out, form)
    several = [name for name, values in pairs.inputs.items() if len({*values} - {None}) != 1]
    leading = [pairs.of_input(name) for name in several if not pairs.is_implied(name)]
    results = [column for name in columns.wanted.names if name not in pairs.inputs for column in pairs.of_result(name)]
    results += [Column(DOUBT, pairs.doubts, False)] if any(pairs.doubts) else []
    tables = [[*leading, *results], *(_across(leading, results) if len(columns) <= MAX_ACROSS else [])]
    if any(print_table(table, out) for table in tables):
        return
    alternatives = [column._replace(head=column.below) for column in results if column.below]
    for rest in ([column for column in results if not column.below], alternatives):
        _print_in_parts(leading, rest, out)


def _print_in_parts(leading: Sequence[Column], columns: Sequence[Column], out: TextIO) -> None:
    """Print columns as as many tables as it takes, with the leading columns in each."""
    while columns:
        counts = range(len(columns), 0, -1)
        is_printed = (print_table([*leading, *columns[:count]], out, anyway=count == 1) for count in counts)
        columns = columns[next(count for count, done in zip(counts, is_printed, strict=True) if done) :]


def _across(leading: Sequence[Column], results: Sequence[Column]) -> list[list[Column]]:
    """Return two tables with a column for each pair and a row for each result: with its meaning, and without."""
    numbers = Column("pair", [str(number) for number, _ in enumerate(results[0].cells, 1)])
    lines = ([column.head, *column.cells] for column in leading or [numbers])
    head, *heads = map("\n".join, zip(*lines, strict=True))
    symbols = Column(head, [column.head for column in results], False)
    table = [symbols, *map(Column, heads, zip(*(column.cells for column in results), strict=True))]
    return [[Column("quantity", [column.meaning for column in results], False), *table], table]


class _Pairs:
    """The values of columns as they are printed, with their uncertainties."""

    def __init__(self, columns: "Columns", form: Format) -> None:
        self.columns, self.form = columns, form
        self.inputs: dict[str, list[Any]] = {
            name: [in_words(name, value) for value in column] for name, column in columns.inputs.items()
        }

    @cached_property
    def doubts(self) -> list[str]:
        """The worst doubt of each pair, with the number of others, but those that have columns of values."""
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

    def is_implied(self, name: str) -> bool:
        """Return whether an input repeats another: spheres of one radius, or a property of the material."""
        if name == "energy":
            return "energy_ratio" in self.inputs
        if name == "radius2":
            return self.inputs[name] == self.inputs.get("radius")
        leader = self.inputs.get(_LEADERS.get(name, ""))
        if name == "surface_energy" or leader is None or None in leader:
            return False
        return len({*zip(leader, self.inputs[name], strict=True)}) == len({*leader})

    def of_input(self, name: str) -> Column:
        """Return the column of an input."""
        return input_column(name, self.inputs[name], self.form, symbol_beside(name, self.inputs))

    def of_result(self, name: str) -> list[Column]:
        """Return the columns of a result: by the other law where that moves a result of the pairs, and by data."""
        values, symbol = self._measures(name), symbol_beside(name, self.inputs)
        unit = _unit(name, [value for value in values if value is not None], self.form)
        in_unit = f" [{pretty(unit[0])}]" if unit[0] else ""

        def cells(values: Iterable[Any], none: str = _NONE) -> list[str]:
            return [_cell(value, unit, self.form, none) for value in values]

        columns = [Column(f"{symbol}{in_unit}", cells(values), meaning=NOMENCLATURE[name].sentence)]
        law_matters = any(bits & OF_LAW for bits in as_list(self.columns.doubts))
        for kind, key in self.columns.wanted.beside(name).items():
            others = self._measures(key)
            if kind == DATA and any(value is not None for value in others):
                columns.append(Column("by data", cells(others, "no data"), below=f"{symbol} by data{in_unit}"))
            elif kind == DEFAULT_LAW or (kind in LAWS and law_matters):
                head = f"{symbol} by {head_of(kind)}"
                columns.append(Column(head, cells(others), below=f"{head}{in_unit}"))
        return columns

    def _measures(self, key: str) -> list[Any]:
        """Return the values of a column of results, with their uncertainties if they have some; None is a gap."""
        keys = self.columns.wanted.sides_of(key)
        sides = (self.columns.column(each) for each in keys.values())
        return [
            None if isnan(value) else of_sides(float(value), dict(zip(keys, of_row, strict=True)))
            for value, *of_row in zip(self.columns.column(key), *sides, strict=True)
        ]


def input_column(name: str, values: Sequence[Any], form: Format, symbol: str) -> Column:
    """Return the column of an input, with all digits; the head has a unit that suits all values."""
    unit = form.common_unit(name, [value for value in values if value is not None and not isinstance(value, str)])

    def text(value: Any) -> str:
        if value is None:
            return _NONE
        return amount(name, value, form) if unit is None else form.in_unit(value, unit)

    head = symbol if unit is None else f"{symbol} [{pretty(unit[0])}]"
    return Column(head, [*map(text, values)], not NOMENCLATURE[name].is_word)


# --- Inputs -----------------------------------------------------------------------------------------------------------


def _write_inputs(
    lead: Sequence[str],
    inputs: "Mapping[str, float | str | Uncertain]",
    assumed: Mapping[str, str],
    out: TextIO,
    form: Format,
) -> None:
    """Write a line with the inputs that were given, behind a lead, and one with what was assumed."""
    follows = ["energy"] if "energy_ratio" in inputs else []
    given = {name: value for name, value in inputs.items() if name not in (*assumed, *follows)}
    if texts := [*lead, *_described(given, form)]:
        say_wrapped(", ".join(texts), out)
    if assumed:
        say_wrapped(f"assumed: {', '.join(assumed.values())}", out)


def _described(inputs: "Mapping[str, float | str | Uncertain]", form: Format) -> Iterable[str]:
    """Return inputs in words: materials with the values that are theirs in brackets, and what was typed."""
    texts = {name: f"{symbol_beside(name, inputs)} = {amount(name, value, form)}" for name, value in inputs.items()}
    if "surface_energy" in texts and "surface_energy2" not in texts:
        texts["surface_energy"] += " per surface"
    if "radius2" in texts and inputs["radius2"] in (inputs.get("radius"), "plane"):
        radius = amount("radius", inputs["radius"], form)
        texts["radius"] = f"R1 = {radius} on a plane" if inputs["radius2"] == "plane" else f"R1 = R2 = {radius}"
        del texts["radius2"]
    for leader in ("material", "material2"):
        if leader in texts:
            data = [texts.pop(name) for name in inputs if _LEADERS.get(name) == leader and name not in form.typed]
            solid = inputs[leader] if "material" in inputs else f"sphere 2: {inputs[leader]}"
            texts[leader] = f"{solid} ({', '.join(data)})" if data else str(solid)
    return texts.values()


# --- Texts ------------------------------------------------------------------------------------------------------------


def texts_as_columns(heads: Sequence[str], rows: Iterable[Sequence[str]]) -> list[Column]:
    """Return rows of texts as columns, which are set to the left."""
    return [Column(head, cells, False) for head, *cells in zip(heads, *rows, strict=True)]


def write_table(columns: Sequence[Column], out: TextIO) -> None:
    """Write a table of texts, or, on a terminal too narrow for it, a line for each cell."""
    if not print_table(columns, out):
        for cells in zip(*(column.cells for column in columns), strict=True):
            for column, cell in zip(columns, cells, strict=True):
                say(f"{column.head}: {cell}", out)


def print_table(
    columns: Sequence[Column],
    out: TextIO,
    *,
    styles: Sequence[str] = (),
    is_last_wrapped: bool = False,
    anyway: bool = False,
) -> bool:
    """Print a table of texts if the terminal is wide enough for it, or anyway, and return whether it was printed.

    `styles`: of each row. The last column may be broken into lines, and then the table is printed anyway.
    """
    table = Table(box=box.SIMPLE_HEAD, padding=(0, 1, 0, 0), pad_edge=False, show_edge=False)
    for column in columns:
        table.add_column(fitting(column.head, out), justify="right" if column.is_right else "left", no_wrap=True)
    rows = zip(*(column.cells for column in columns), strict=True)
    for row, style in zip_longest(rows, styles, fillvalue=""):
        table.add_row(*(Text(fitting(cell, out)) for cell in row), style=style)
    console = Console(file=out, width=terminal_width(), highlight=False, markup=False, emoji=False)
    width = console.measure(table, options=console.options.update(width=_UNLIMITED)).maximum
    if is_last_wrapped:
        table.columns[-1].no_wrap, table.columns[-1].overflow = False, "fold"
        width = LIST_WIDTH
    elif width > console.width and not anyway:
        return False
    console.width = max(console.width, width)
    console.print(table)
    return True
