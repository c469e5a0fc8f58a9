"""Tables on a terminal, in the width there is: of one scene, of a list of pairs, and of texts."""

from collections.abc import Iterable, Mapping, Sequence
from itertools import accumulate, compress
from math import isnan
from textwrap import wrap
from typing import TYPE_CHECKING, Any, NamedTuple, TextIO

from ..quantities.formatting import Format, amount, from_to, in_words, significant, symbol_among, with_unit
from ..quantities.laws import DEFAULT_LAW, LAWS
from ..quantities.nomenclature import NOMENCLATURE, PROPERTIES, of_sphere
from ..quantities.units import Unit, convert
from ..quantities.values import Interval, middle, of_sides
from ..rows.columns import DOUBT, as_list
from ..scene.doubts import DATA, OF_LAW, SIO2, codes_of, rolled_solid
from ..text import say, say_wrapped, terminal_width, width_of

if TYPE_CHECKING:
    from ..answers.answer import Answer, Result
    from ..quantities.values import Uncertain
    from ..rows.columns import Columns

    Value = float | str | Uncertain | None  # of a cell: a word as it is, and None where there is no value


def head_of(law: str) -> str:
    """Return the head of the column of a law."""
    return LAWS[law].title.partition("–")[0]


_DIGITS = 4  # of a result on a terminal
_OF_A_RANGE = 2  # of its ends
_NONE = "–"
_WITH_SPACING = f"with {NOMENCLATURE['atomic_spacing'].option}"  # in place of a number that needs it
_SILENT = {"", _NONE, *(f"as {head_of(law)}" for law in LAWS)}  # cells that say no more than others
_GAP = 2  # blanks between columns
_LEAST_TEXT = 24  # of a text in several lines
_CODES = 24  # characters of the codes of doubts in a cell
_OF_MATERIALS = {"material": [*PROPERTIES], "material2": [of_sphere(2, name) for name in PROPERTIES]}
# Inputs without a column unless they were typed, as they follow from others; of a material, γ has one.
_FOLLOWING = {"radius2", "energy"}.union(*_OF_MATERIALS.values()) - {"surface_energy"}


class Column(NamedTuple):
    """A column of texts. Numbers are set to the right."""

    head: str
    cells: Sequence[str]
    is_right: bool = True


def columns_of(rows: Iterable[Sequence[str]], *, texts: int) -> list[Column]:
    """Return the columns of rows, the first of which has the heads; `texts`: the number of those with words."""
    return [Column(head, cells, place >= texts) for place, (head, *cells) in enumerate(zip(*rows, strict=True))]


# --- Values -----------------------------------------------------------------------------------------------------------


def _written(value: "float | Uncertain", unit: tuple[str, Unit], form: Format) -> str:
    """Return a result in a unit: with four digits and their zeros, a range with two, or with its error bar."""
    if isinstance(value, Interval):
        return from_to(convert(value.low, unit[1]), convert(value.high, unit[1]), form.digits or _OF_A_RANGE)
    if isinstance(value, float):
        number = convert(value, unit[1])
        return significant(number, form.digits or _DIGITS, zeros=form.digits is None and number != 0)
    return form.in_unit(value, unit)


def _cells(
    name: str, values: "Sequence[Value]", form: Format, models: "Sequence[Value]" = (), *, is_input: bool = False
) -> tuple[str, list[str]]:
    """Return the unit of values of a quantity, and their cells; no unit where these are far apart and have their own.

    `models`: the values to which the unit is suited, if not to these; `is_input`: whether all digits are shown.
    """
    known = [value for value in models or values if value is not None and not isinstance(value, str)]
    common, own_units, cells = form.common_unit(name, known), form.are_far(name, known), []
    for value in values:
        if value is None or isinstance(value, str):
            cells.append(_NONE if value is None else value)
            continue
        unit = form.common_unit(name, [value]) if own_units else common
        number = form.in_unit(value, unit) if is_input else _written(value, unit, form)
        cells.append(with_unit(number, unit[0]) if own_units else number)
    return "" if own_units else common[0], cells


def _column(head: str, unit: str, cells: Sequence[str], *, is_right: bool = True) -> Column:
    return Column(f"{head} [{unit}]" if unit else head, cells, is_right)


def input_column(name: str, values: "Sequence[Value]", form: Format, symbol: str) -> Column:
    """Return the column of an input, with all digits, in units that suit the values."""
    return _column(symbol, *_cells(name, values, form, is_input=True), is_right=not NOMENCLATURE[name].is_word)


# --- One scene --------------------------------------------------------------------------------------------------------


def scene_table(answer: "Answer", out: TextIO, form: Format) -> None:
    """Write the inputs of one scene, and its results below each other, beside what may stand in their place."""
    _write_inputs("", answer.measures, answer.assumed, out, form)
    others, law = _others(answer), head_of(answer.scene.law.name)
    rows = [["quantity", "symbol", "unit", law, *others]]
    models: dict[str, float | Uncertain] = {}  # by SI unit: the last value to which a unit was suited
    for result in _results(answer):
        name, same = result.name, None if result.value is None else f"as {law}"
        values = [result.measure, *(of_other.get(name, same) for of_other in others.values())]
        if same and answer.scene.by_law.may_rest_on_spacing(name):
            values = [_WITH_SPACING if value is None else value for value in values]
        first = next((value for value in values if value is not None and not isinstance(value, str)), None)
        si = NOMENCLATURE[name].unit
        if first is not None and not (si in models and _is_near(name, first, models[si], form)):
            models[si] = first
        unit, cells = _cells(name, values, form, () if first is None else [models[si]])
        texts = [NOMENCLATURE[name].sentence, symbol_among(name, answer.inputs), "" if first is None else unit]
        rows.append([*texts, *cells])
    words, symbols, units, *columns = columns_of(rows, texts=3)
    write_table([words, symbols], columns, out, trailing=[units], repeated=columns[:1])


def _is_near(name: str, value: "float | Uncertain", model: "float | Uncertain", form: Format) -> bool:
    """Return whether a value of a quantity is little below 1 in the unit of a model, beside which it can be read."""
    return 0.25 <= abs(convert(middle(value), form.common_unit(name, [model])[1])) < 1


def _results(answer: "Answer") -> "list[Result]":
    """Return the results that have a row: not those with a note of their own and the value of a result without one."""
    results = [result for result in answer.results if result.name not in answer.question.without_row]
    values = {result.value for result in results if not NOMENCLATURE[result.name].note} - {None}
    return [result for result in results if not NOMENCLATURE[result.name].note or result.value not in values]


def _others(answer: "Answer") -> dict[str, Mapping[str, Any]]:
    """Return what has columns beside the results, by head: what may stand in their place, and limits of theirs."""
    data = "by 1 µm data" if rolled_solid(answer.scene) == SIO2 else "by 5 µm data"
    others = {data if kind == DATA else head_of(kind): values for kind, values in answer.alternatives.items()}
    for result in answer.results:
        head = answer.question.without_row.get(result.name)
        if head and result.value is not None and head != head_of(answer.scene.law.name):
            others[head] = {answer.question.headline[0]: result.measure}
    return others


# --- Lists ------------------------------------------------------------------------------------------------------------


def sweep_table(columns: "Columns", out: TextIO, form: Format, assumed: Mapping[str, str]) -> None:
    """Write a table with a row for each pair; inputs that all of them share stand above, and what was assumed.

    A pair is a column where only that fits the terminal.
    """
    inputs = {name: [in_words(name, value) for value in values] for name, values in columns.inputs.items()}
    kinds = {name: {*values} - {None} for name, values in inputs.items()}  # None: does not enter a row
    common = {name: next(iter(values)) for name, values in kinds.items() if len(values) == 1}
    several = [name for name in inputs if name not in common]
    laws = max(len(kinds.get("model", ())), 1)
    number, noun = (len(columns), "states") if "state" in inputs else (len(columns) // laws, "pairs")
    count = f"{number} {noun}" if number > 1 else ""
    if "radius2" in several and "radius2" not in form.typed:
        count += " of equal spheres (R2 = R1)"
    _write_inputs(count, common, assumed, out, form)
    leading = [
        input_column(name, inputs[name], form, symbol_among(name, inputs))
        for name in several
        if name in form.typed or name not in _FOLLOWING
    ]
    names = (name for name in columns.wanted.names if name not in inputs)
    results = [column for name in names for column in _result_columns(name, columns, form)]
    doubts = [_doubts(bits & columns.told) for bits in as_list(columns.doubts)]
    is_told = len({*doubts}) > 1 or (any(doubts) and noun == "pairs")  # those of all states of a pair are in its notes
    results += [Column(DOUBT, doubts, is_right=False)] if is_told else []
    across = columns_of([(column.head, *column.cells) for column in (*leading, *results)], texts=1)
    if _size(across) <= terminal_width() + _GAP < _size([*leading, *results]):
        leading, results = across[:1], across[1:]
    write_table(leading, results, out)


def _doubts(bits: int) -> str:
    """Return the codes of doubts, of many the first and the number of others."""
    codes = codes_of(bits)
    text = " ".join(codes)
    return text if len(codes) < 2 or len(text) <= _CODES else f"{codes[0]} ({len(codes) - 1} more)"


def _result_columns(name: str, columns: "Columns", form: Format) -> list[Column]:
    """Return the columns of a result: by the other law where that moves a result of the pairs, and by data."""
    law_matters = any(bits & OF_LAW for bits in as_list(columns.doubts))
    values = {"": _measures(columns, name)}
    for kind, key in columns.wanted.alternatives_of(name).items():
        others = _measures(columns, key)
        if kind == DATA and any(value is not None for value in others):
            values[" by data"] = ["no data" if value is None else value for value in others]
        elif kind == DEFAULT_LAW or (kind in LAWS and law_matters):
            values[f" by {head_of(kind)}"] = others
    symbol = symbol_among(name, columns.inputs)
    models = next((of_kind for of_kind in values.values() if any(value is not None for value in of_kind)), ())
    every = values.items()
    return [_column(f"{symbol}{words}", *_cells(name, of_kind, form, models)) for words, of_kind in every]


def _measures(columns: "Columns", key: str) -> list[Any]:
    """Return the values of a column of results, with their uncertainties if they have some; None is a gap."""
    keys = columns.wanted.sides_of(key)
    sides = (columns.column(each) for each in keys.values())
    return [
        None if isnan(value) else of_sides(float(value), dict(zip(keys, of_row, strict=True)))
        for value, *of_row in zip(columns.column(key), *sides, strict=True)
    ]


# --- Inputs -----------------------------------------------------------------------------------------------------------


def _write_inputs(
    lead: str, inputs: "Mapping[str, float | str | Uncertain]", assumed: Mapping[str, str], out: TextIO, form: Format
) -> None:
    """Write a line with the inputs that were given, behind a lead, and one with what was assumed."""
    given = {name: value for name, value in inputs.items() if name not in assumed}
    if "energy" not in form.typed:  # else it follows from another input
        given.pop("energy", None)
    if texts := [*filter(None, [lead]), *_described(given, form)]:
        say_wrapped(", ".join(texts), out)
    if assumed:
        say_wrapped(f"assumed: {', '.join(assumed.values())}", out)


def _described(inputs: "Mapping[str, float | str | Uncertain]", form: Format) -> Iterable[str]:
    """Return inputs in words: materials with the values that are theirs in brackets, and what was typed."""
    texts = {name: f"{symbol_among(name, inputs)} = {amount(name, value, form)}" for name, value in inputs.items()}
    if "surface_energy" in texts and "surface_energy2" not in texts:
        texts["surface_energy"] += " per surface"
    if {"radius", "radius2"} <= texts.keys() and inputs["radius2"] in (inputs["radius"], "plane"):
        radius = amount("radius", inputs["radius"], form)
        texts["radius"] = f"R1 = {radius} on a plane" if inputs["radius2"] == "plane" else f"R1 = R2 = {radius}"
        del texts["radius2"]
    for material, properties in _OF_MATERIALS.items():
        if material in texts:
            data = [texts.pop(name) for name in properties if name in texts and name not in form.typed]
            solid = inputs[material] if "material" in inputs else f"sphere 2: {inputs[material]}"
            texts[material] = f"{solid} ({', '.join(data)})" if data else str(solid)
    return texts.values()


# --- Texts ------------------------------------------------------------------------------------------------------------


def write_table(
    leading: Sequence[Column],
    columns: Sequence[Column],
    out: TextIO,
    *,
    trailing: Sequence[Column] = (),
    repeated: Sequence[Column] = (),
) -> None:
    """Write columns between leading and trailing ones, in as many tables as the width of the terminal takes.

    Those below the first leave out rows in which they say nothing. `repeated`: columns to stand in them again, if they
    have room.
    """
    while columns:
        room = terminal_width() + _GAP - _size([*leading, *trailing])
        count = max(sum(end <= room for end in accumulate(_size([column]) for column in columns)), 1)
        say("\n".join(_lines([*leading, *columns[:count], *trailing])), out)
        columns = columns[count:]
        is_said = [not _SILENT.issuperset(cells) for cells in zip(*(column.cells for column in columns), strict=True)]
        leading, columns, trailing, repeated = (
            [column._replace(cells=[*compress(column.cells, is_said)]) for column in each]
            for each in (leading, columns, trailing, repeated)
        )
        if columns:
            say("", out)
            is_wide = _size([*leading, *repeated, columns[0], *trailing]) > terminal_width() + _GAP
            columns = columns if is_wide else [*repeated, *columns]


def write_texts(heads: Sequence[str], rows: Iterable[Sequence[str]], out: TextIO) -> None:
    """Write rows of texts; what is wider than the terminal goes on below the last column."""
    columns = columns_of([heads, *rows], texts=len(heads))
    left = _size(columns[:-1])
    width = max(terminal_width(), left + _LEAST_TEXT)
    for line in _lines(columns):
        say("\n".join(wrap(line, width, subsequent_indent=" " * left)), out)


def _lines(columns: Iterable[Column]) -> list[str]:
    """Return the heads of columns, a line below them, and the rows."""
    lines = [(" " * _GAP).join(cells) for cells in zip(*(padded(column) for column in columns), strict=True)]
    rule = "─" * min(width_of(lines[0]), terminal_width())
    head, *rows = (line.rstrip() for line in lines)
    return [head, rule, *rows]


def padded(column: Column) -> list[str]:
    """Return the head and the cells of a column, all as wide as the widest of them."""
    texts = [column.head, *column.cells]
    width = max(map(width_of, texts))
    blanks = [" " * (width - width_of(text)) for text in texts]
    return [blank + text if column.is_right else text + blank for blank, text in zip(blanks, texts, strict=True)]


def _size(columns: Iterable[Column]) -> int:
    """Return the width of columns on a terminal, with the blanks behind each."""
    return sum(width_of(padded(column)[0]) + _GAP for column in columns)
