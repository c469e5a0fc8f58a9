"""Tables on a terminal, in the width there is: of one scene, of a list of pairs, and of texts."""

from collections.abc import Collection, Iterable, Mapping, Sequence
from functools import cached_property
from itertools import accumulate, compress
from math import isnan
from textwrap import wrap
from typing import TYPE_CHECKING, Any, NamedTuple, TextIO

from ..quantities.formatting import (
    Format,
    amount,
    from_to,
    in_words,
    pretty,
    significant,
    symbol_beside,
    with_known_prefix,
)
from ..quantities.laws import DEFAULT_LAW, LAWS
from ..quantities.nomenclature import NOMENCLATURE, PROPERTIES, of_sphere
from ..quantities.units import Unit, convert
from ..quantities.values import of_sides
from ..rows.columns import DOUBT, as_list
from ..scene.alternatives import DATA, SIO2, rolled_solid
from ..scene.limits import OF_LAW, codes_of
from ..text import fitting, say, say_wrapped, terminal_width, width_of

if TYPE_CHECKING:
    from ..answers.answer import Answer
    from ..answers.results import Result
    from ..quantities.values import Uncertain
    from ..rows.columns import Columns

_DIGITS = 4  # of a value on a terminal
_OF_A_RANGE = 2  # of its ends
_NONE = "–"
_GAP = 2  # blanks between columns
_LEAST_TEXT = 24  # of a text in several lines
_LEADERS = dict.fromkeys(PROPERTIES, "material") | {of_sphere(2, name): "material2" for name in PROPERTIES}


class Column(NamedTuple):
    """A column of texts. Numbers are set to the right; `meaning` is the head in words."""

    head: str
    cells: Sequence[str]
    is_right: bool = True
    meaning: str = ""


# --- One scene --------------------------------------------------------------------------------------------------------


def scene_table(answer: "Answer", out: TextIO, form: Format) -> None:
    """Write the inputs of one scene, and its results below each other, beside what may stand in their place."""
    _write_inputs([], answer.measures, answer.assumed, out, form)
    others, law = _others(answer), head_of(answer.scene.law.name)
    rows = [_scene_row(result, others, answer, form) for result in _results(answer)]
    quantity, symbol, unit, *values = zip(["quantity", "symbol", "unit", law, *others], *rows, strict=True)
    texts = [Column(head, cells, is_right=False) for head, *cells in (quantity, symbol, unit)]
    write_table(texts[:2], [Column(head, cells) for head, *cells in values], out, trailing=texts[2:])


def _results(answer: "Answer") -> "list[Result]":
    """Return the results that have a row: not those with a note of their own and the value of a result without one."""
    results = [result for result in answer.results if result.name not in answer.question.beside]
    values = {result.value for result in results if not NOMENCLATURE[result.name].note} - {None}
    return [result for result in results if not NOMENCLATURE[result.name].note or result.value not in values]


def _others(answer: "Answer") -> dict[str, Mapping[str, Any]]:
    """Return what has columns beside the results, by head: what may stand in their place, and limits of theirs."""
    data = "by 1 µm data" if rolled_solid(answer.scene) == SIO2 else "by 5 µm data"
    others = {data if kind == DATA else head_of(kind): values for kind, values in answer.alternatives.items()}
    for limit, head in answer.question.beside.items():
        if head and answer.value(limit) is not None and head != head_of(answer.scene.law.name):
            others[head] = {answer.question.headline[0]: answer.value(limit)}
    return others


def head_of(law: str) -> str:
    """Return the head of the column of a law."""
    return LAWS[law].title.partition("–")[0]


def _scene_row(
    result: "Result", others: Mapping[str, Mapping[str, Any]], answer: "Answer", form: Format
) -> Sequence[str]:
    """Return the cells of a result: words, symbol, unit, value, and what may stand in its place."""
    name, same = result.name, None if result.value is None else f"as {head_of(answer.scene.law.name)}"
    values = [result.measure, *(of_other.get(name, same) for of_other in others.values())]
    numbers = [value for value in values if value is not None and not isinstance(value, str)]
    unit = _unit(name, numbers[:1], form)
    cells = [_cell(value, unit, form) for value in values]
    return NOMENCLATURE[name].sentence, symbol_beside(name, answer.inputs), pretty(unit[0]) if numbers else "", *cells


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
    return significant(number, form.digits or _DIGITS, zeros=form.digits is None and number != 0)


# --- Lists ------------------------------------------------------------------------------------------------------------


def sweep_table(columns: "Columns", out: TextIO, form: Format, assumed: Mapping[str, str]) -> None:
    """Write a table of several pairs; inputs that all of them share stand above, and what was assumed, by name.

    A pair is a row, or a column where only that fits the terminal.
    """
    pairs = _Pairs(columns, form)
    common = {name: values[0] for name, values in pairs.inputs.items() if len({*values}) == 1}
    _write_inputs([pairs.counted(common)], common, assumed, out, form)
    several = [name for name, values in pairs.inputs.items() if len({*values} - {None}) != 1]
    leading = [pairs.of_input(name) for name in several if not pairs.is_implied(name)]
    results = [column for name in columns.wanted.names if name not in pairs.inputs for column in pairs.of_result(name)]
    results += [Column(DOUBT, pairs.doubts, is_right=False)] if any(pairs.doubts) else []
    words, heads, *others = _across(leading, results)
    tables = [(leading, results), ([words, heads], others), ([heads], others)]
    write_table(*next((table for table in tables if _fits([*table[0], *table[1]], out)), tables[0]), out)


def _across(leading: Sequence[Column], results: Sequence[Column]) -> list[Column]:
    """Return the rows of a table as columns, behind its heads in words and in symbols."""
    numbers = Column("pair", [str(number) for number, _ in enumerate(results[0].cells, 1)])
    columns = [*(leading or [numbers]), *results]
    heads, *pairs = zip(*((column.head, *column.cells) for column in columns), strict=True)
    words = ["quantity", *(column.meaning for column in columns[1:])]
    texts = [Column(head, cells, is_right=False) for head, *cells in (words, heads)]
    return [*texts, *(Column(head, cells) for head, *cells in pairs)]


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
        in_unit, words = f" [{pretty(unit[0])}]" if unit[0] else "", NOMENCLATURE[name].sentence

        def column(head: str, values: Iterable[Any], none: str = _NONE) -> Column:
            return Column(f"{head}{in_unit}", [_cell(value, unit, self.form, none) for value in values], meaning=words)

        columns = [column(symbol, values)]
        law_matters = any(bits & OF_LAW for bits in as_list(self.columns.doubts))
        for kind, key in self.columns.wanted.beside(name).items():
            others = self._measures(key)
            if kind == DATA and any(value is not None for value in others):
                columns.append(column(f"{symbol} by data", others, "no data"))
            elif kind == DEFAULT_LAW or (kind in LAWS and law_matters):
                columns.append(column(f"{symbol} by {head_of(kind)}", others))
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
    quantity = NOMENCLATURE[name]
    return Column(head, [*map(text, values)], not quantity.is_word, quantity.sentence)


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


def write_table(
    leading: Sequence[Column], columns: Sequence[Column], out: TextIO, *, trailing: Sequence[Column] = ()
) -> None:
    """Write columns between leading and trailing ones, in as many tables as the width of the terminal takes.

    Those below the first leave out rows in which they say nothing. On a terminal too narrow for one column, the last of
    the leading ones is left.
    """
    if leading[1:] and not _fits([*leading, *columns[:1], *trailing], out):
        leading = leading[-1:]
    while columns:
        ends = accumulate(_sizes(columns, out), initial=sum(_sizes([*leading, *trailing], out)))
        count = max(sum(end <= terminal_width() + _GAP for end in ends) - 1, 1)
        _print([*leading, *columns[:count], *trailing], out)
        columns = columns[count:]
        is_said = [any(map(_is_own, cells)) for cells in zip(*(column.cells for column in columns), strict=True)]
        leading, columns, trailing = (_of_rows(each, is_said) for each in (leading, columns, trailing))
        if columns:
            say("", out)


def _is_own(cell: str) -> bool:
    """Return whether a cell says more than another one."""
    return cell not in ("", _NONE) and not cell.startswith("as ")


def _of_rows(columns: Iterable[Column], are_shown: Sequence[bool]) -> list[Column]:
    return [column._replace(cells=[*compress(column.cells, are_shown)]) for column in columns]


def write_texts(heads: Sequence[str], rows: Iterable[Sequence[str]], out: TextIO) -> None:
    """Write rows of texts; the last column is broken into lines where it is wider than the terminal."""
    rows = [*rows]
    others = [Column(head, cells, is_right=False) for head, *cells in zip(heads, *rows, strict=True)][:-1]
    room = max(terminal_width() - sum(_sizes(others, out)), _LEAST_TEXT)
    lines = []
    for *cells, text in rows:
        first, *further = wrap(fitting(text, out), room) or [""]
        lines += [(*cells, first), *((*[""] * len(cells), line) for line in further)]
    _print([Column(head, cells, is_right=False) for head, *cells in zip(heads, *lines, strict=True)], out)


def _fits(columns: Iterable[Column], out: TextIO) -> bool:
    """Return whether columns fit the terminal beside each other."""
    return sum(_sizes(columns, out)) <= terminal_width() + _GAP


def _sizes(columns: Iterable[Column], out: TextIO) -> list[int]:
    """Return the widths of columns on a terminal, each with the blanks behind it."""
    return [_GAP + max(width_of(fitting(text, out)) for text in (column.head, *column.cells)) for column in columns]


def _print(columns: Sequence[Column], out: TextIO) -> None:
    """Write heads, a line below them, and rows."""
    sizes = _sizes(columns, out)
    heads, *rows = zip(*((column.head, *column.cells) for column in columns), strict=True)
    lines = []
    for row in (heads, *rows):
        line = ""
        for column, text, size in zip(columns, (fitting(cell, out) for cell in row), sizes, strict=True):
            blanks = " " * (size - _GAP - width_of(text))
            line += (blanks + text if column.is_right else text + blanks) + " " * _GAP
        lines.append(line.rstrip())
    say("\n".join([lines[0], "─" * (sum(sizes) - _GAP), *lines[1:]]), out)
