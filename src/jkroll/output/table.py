"""Tables on a terminal, set by rich."""

from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from functools import cached_property
from math import isnan
from typing import TYPE_CHECKING, Any, TextIO

from rich import box
from rich.console import Console
from rich.table import Table
from rich.text import Text

from ..answers.alternatives import Alternative, between, head_of
from ..answers.notes import symbol_beside
from ..quantities.formatting import Format, amount, in_words, pretty, significant, with_known_prefix
from ..quantities.laws import DEFAULT_LAW, LAWS
from ..quantities.nomenclature import NOMENCLATURE, PROPERTIES, of_sphere
from ..quantities.units import Unit, convert
from ..quantities.values import of_sides
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

MAX_ACROSS = 20  # pairs that are tried as columns
MIN_WRAPPED = 16  # characters of a column of texts on a narrow terminal
GAP = 2  # between two columns
_DIGITS = 4  # of a value on a terminal
_OF_A_RANGE = 2  # of its ends
_NONE = "–"
_LEADERS = dict.fromkeys(PROPERTIES, "material") | {of_sphere(2, name): "material2" for name in PROPERTIES}


# --- One scene --------------------------------------------------------------------------------------------------------


def scene_table(answer: "Answer", out: TextIO, form: Format) -> None:
    """Write the inputs of one scene, and its results below each other, or in a grid if it fits.

    What may stand in their place has columns beside them; those that do not fit are a second table.
    """
    for line in _head(answer, form):
        say(line, out)
    beside = _beside(answer)
    results = _rows(answer)
    rows = [_result_cells(result, answer, beside, form) for result in results]
    # Dimmed is what stands beside a headline, or has no value.
    styles = ["dim" if NOMENCLATURE[one.name].note or one.value is None else "" for one in results]
    own, *others = head_of(answer.scene.law.name), *(one.head for one in beside)

    def is_printed(*heads: str, anyway: bool = False) -> bool:
        texts = [[row[head] for head in heads] for row in rows]
        return print_table(heads, texts, out, right={own, *others}, styles=styles, anyway=anyway)

    grid, count = answer.question.grid, 0
    if not grid or any(result.law for result in results) or not _print_grid(grid, answer, out, form):
        fitting_counts = range(len(others), -1, -1)
        count = next(
            (one for one in fitting_counts if is_printed("quantity", "symbol", own, *others[:one], "unit")), -1
        )
        if count < 0:
            is_printed("symbol", own, "unit", anyway=True)
    left = beside[max(count, 0) :]
    differing = {name for one in left for name, value in one.values.items() if value is not None}
    rows = [row for row, result in zip(rows, results, strict=True) if result.name in differing]
    styles = [""] * len(rows)
    if rows:
        say("", out)
        heads = ("symbol", *(one.head for one in left), "unit")
        if not is_printed("quantity", *heads):
            is_printed(*heads, anyway=True)


def _rows(answer: "Answer") -> "list[Result]":
    """Return the results that have a row: those without a note of their own, or another result of the same value."""
    values = {result.value for result in answer.results if not NOMENCLATURE[result.name].note}
    return [
        result
        for result in answer.results
        if result.name not in answer.question.beside
        and not (result.value is not None and NOMENCLATURE[result.name].note and result.value in values)
    ]


def _beside(answer: "Answer") -> "list[Alternative]":
    """Return what has columns beside the results: what may stand in their place, and limits of theirs."""
    values = {result.name: result.value for result in answer.results}
    limits = [
        Alternative(column[1], column[1], {column[0]: values[limit]})
        for limit, column in answer.question.beside.items()
        if column and values.get(limit) is not None and column[1] != head_of(answer.scene.law.name)
    ]
    return [*answer.alternatives, *limits]


def _result_cells(result: "Result", answer: "Answer", beside: Sequence[Alternative], form: Format) -> dict[str, str]:
    """Return the cells of a result and of what may stand in its place, by the heads of columns, all in one unit."""
    name, own, value = result.name, head_of(answer.scene.law.name), result.measure
    others = {one.head: one.values.get(name, None if value is None else f"as {own}") for one in beside}
    numbers = [each for each in (value, *others.values()) if each is not None and not isinstance(each, str)]
    unit = _unit(name, numbers[:1], form)
    cells = {"quantity": NOMENCLATURE[name].sentence, "symbol": symbol_beside(name, answer.inputs)}
    cells[own] = _cell(value, unit, form)
    cells |= {one.head: _cell(others[one.head], unit, form, one.none) for one in beside}
    return {**cells, "unit": pretty(unit[0]) if numbers else ""}


def _print_grid(grid: "Grid", answer: "Answer", out: TextIO, form: Format) -> bool:
    """Print the table of a grid if it fits; return whether it did. Quantities of a cell stand below each other."""
    measures: dict[str, Any] = {**answer.inputs, **answer.uncertain}
    measures |= {result.name: result.measure for result in answer.results}

    def with_unit(name: str) -> str:
        value = measures.get(name)
        unit = _unit(name, [] if value is None else [value], form)
        if unit[0].startswith("1e"):
            unit = form.unit(name), Unit(1, 1, ())
        return f"{_cell(value, unit, form)} {pretty(unit[0])}".strip()

    rows = [[label, *("\n".join(map(with_unit, names)) for names in cells)] for label, cells in grid.rows.items()]
    return print_table(grid.heads, rows, out, right=grid.heads[1:])


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
        ends = (convert(end, unit[1]) for end in (value.low, value.high))
        return "–".join(dict.fromkeys(significant(end, form.digits or _OF_A_RANGE) for end in ends))
    number = convert(value, unit[1])
    keeps_zeros = form.digits is None and number and not 10**_DIGITS <= abs(number) < 10**6
    text = f"{number:#.{_DIGITS}g}" if keeps_zeros else significant(number, form.digits or _DIGITS)
    return text.removesuffix(".")


# --- Lists ------------------------------------------------------------------------------------------------------------


def sweep_table(columns: "Columns", out: TextIO, form: Format, assumed: Mapping[str, str]) -> None:
    """Write a table of several pairs; inputs that all of them share stand above, and what was assumed, by name.

    A pair is a row. Where that is wider than the terminal, a pair is a column, and where this is too wide as well, a
    row again, of as many tables as it takes.
    """
    pairs = _Pairs(columns, form)
    common = {name: values[0] for name, values in pairs.inputs.items() if len({*values}) == 1}
    given = {name: value for name, value in common.items() if name not in assumed}
    say(_broken([pairs.counted(common), *_described(given, form)]), out)
    if assumed:
        say(_broken([f"assumed: {', '.join(assumed.values())}"]), out)
    several = [name for name, values in pairs.inputs.items() if len({*values} - {None}) != 1]
    leading = [name for name in several if not pairs.is_implied(name)]
    results = [key for name in columns.wanted.names if name not in pairs.inputs for key in (name, *pairs.beside(name))]
    results += [DOUBT] if any(pairs.doubts) else []
    if pairs.is_printed([*leading, *results], out):
        return
    if len(columns) <= MAX_ACROSS and pairs.is_printed_across(leading, results, out):
        return
    while results:
        count = len(results)
        while not pairs.is_printed([*leading, *results[:count]], out, anyway=count == 1):
            count -= 1
        results = results[count:]


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
        pairs = {*zip(leader, self.inputs[name], strict=True)}
        return len(pairs) == len({material for material, _ in pairs})

    def values(self, name: str) -> list[Any]:
        """Return the values of a result, with their uncertainties if they have some; None is a gap."""
        keys = self.columns.wanted.sides_of(name)
        sides = [self.columns.column(key) for key in keys.values()]
        return [
            None if isnan(value) else of_sides(float(value), dict(zip(keys, of_row, strict=True)))
            for value, *of_row in zip(self.columns.column(name), *sides, strict=True)
        ]

    def beside(self, name: str) -> list[str]:
        """Return the keys of the columns beside a quantity: by the other law where that moves a result, and by data."""
        keys = self.columns.wanted.beside(name)
        law_matters = any(bits & OF_LAW for bits in as_list(self.columns.doubts)) or DEFAULT_LAW in keys
        has_data = DATA[0] in keys and not all(map(isnan, self.columns.column(keys[DATA[0]])))
        wanted = {*(LAWS if law_matters else ()), *(DATA[:1] if has_data else ())}
        return [key for kind, key in keys.items() if kind in wanted]

    def column(self, key: str) -> list[str]:
        """Return the head and the cells of a column: of an input, of a result, or of what may stand in its place."""
        name, _, kind = key.partition("_by_")
        if key == DOUBT:
            return [DOUBT, *self.doubts]
        symbol = symbol_beside(name, self.inputs)
        if name in self.inputs:
            return column(name, self.inputs[name], self.form, symbol)
        values = self.values(name)
        unit = _unit(name, [value for value in values if value is not None], self.form)
        head, none = f"{symbol} [{pretty(unit[0])}]" if unit[0] else symbol, _NONE
        if kind in DATA:
            ends = [self.columns.column(f"{name}_by_{end}") for end in DATA]
            values = [None if isnan(low) else between(low, high) for low, high in zip(*ends, strict=True)]
            head, none = "by data", "no data"
        elif kind:
            values = [None if isnan(value) else float(value) for value in self.columns.column(key)]
            head = f"{symbol} by {head_of(kind)}"
        return [head, *(_cell(value, unit, self.form, none) for value in values)]

    def is_printed(self, names: Sequence[str], out: TextIO, *, anyway: bool = False) -> bool:
        """Print a table with a row for each pair, if it fits or anyway, and return whether it was printed."""
        heads, *rows = zip(*map(self.column, names), strict=True)
        words = {name for name in (*self.inputs, DOUBT) if name == DOUBT or NOMENCLATURE[name].is_word}
        right = [head for head, name in zip(heads, names, strict=True) if name not in words]
        return print_table(heads, rows, out, right=right, anyway=anyway)

    def is_printed_across(self, leading: Sequence[str], results: Sequence[str], out: TextIO) -> bool:
        """Print a table with a column for each pair and a row for each result, with words or without, if it fits."""
        numbers = ["pair", *(str(number) for number in range(1, len(self.columns) + 1))]
        heads = ["\n".join(texts) for texts in zip(*([*map(self.column, leading)] or [numbers]), strict=True)]
        rows = [self.column(key) for key in results]
        words = [NOMENCLATURE[key].sentence if key in NOMENCLATURE else "" for key in results]
        worded = [[word, *row] for word, row in zip(words, rows, strict=True)]
        return print_table(["quantity", *heads], worded, out, right=heads[1:]) or print_table(
            heads, rows, out, right=heads[1:]
        )


def column(name: str, values: Sequence[Any], form: Format, symbol: str) -> list[str]:
    """Return the head and the cells of a column of inputs, with all digits; the head has a unit that suits all."""
    numbers = [value for value in values if value is not None and not isinstance(value, str)]
    if not (unit := form.common_unit(name, numbers)):
        return [symbol, *(_NONE if value is None else amount(name, value, form) for value in values)]
    return [
        f"{symbol} [{pretty(unit[0])}]",
        *(_NONE if value is None else form.in_unit(value, unit) for value in values),
    ]


# --- Inputs -----------------------------------------------------------------------------------------------------------


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
            solid = inputs[leader] if "material" in inputs else f"sphere 2: {inputs[leader]}"
            texts[leader] = f"{solid} ({data})" if data else str(solid)
    return [*texts.values()]


def _broken(parts: Iterable[str]) -> str:
    """Return parts of a sentence as one, in lines that fit; what belongs together stays so."""
    joined = ", ".join(parts).replace(" (--", f"{NO_BREAK_SPACE}(--").replace("no load", f"no{NO_BREAK_SPACE}load")
    return "\n".join(wrapped(joined, terminal_width(), 2))


# --- Texts ------------------------------------------------------------------------------------------------------------


def write_rows(heads: Sequence[str], rows: Sequence[Sequence[str]], out: TextIO) -> None:
    """Write a table of texts, or, on a terminal too narrow for it, a line for each cell."""
    if not print_table(heads, [list(map(pretty, row)) for row in rows], out):
        for row in rows:
            for head, cell in zip(heads, row, strict=True):
                say(f"{head}: {cell}", out)


def print_table(
    heads: Sequence[str],
    rows: Sequence[Sequence[str]],
    out: TextIO,
    *,
    right: Collection[str] = (),
    styles: Sequence[str] = (),
    is_last_wrapped: bool = False,
    anyway: bool = False,
) -> bool:
    """Print a table of texts if the terminal is wide enough for it, or anyway, and return whether it was printed.

    The columns named in `right` are set to the right; the last may be broken into lines, within a word that is too
    long. `styles`: of each row.
    """
    table = Table(box=box.SIMPLE_HEAD, padding=(0, 1, 0, 0), pad_edge=False, show_edge=False)
    console = Console(file=out, width=terminal_width(), highlight=False, markup=False, emoji=False)
    unlimited = console.options.update(width=10_000)
    of_rows = zip(rows, styles or [""] * len(rows), strict=True)
    texts = [[Text(fitting(cell, out), style) for cell in row] for row, style in of_rows]
    least = GAP * (len(heads) - 1)
    for place, head in enumerate(heads):
        is_wrapped = is_last_wrapped and head == heads[-1]
        title = Text(fitting(head, out))
        width = max(
            console.measure(text, options=unlimited).maximum for text in (title, *(row[place] for row in texts))
        )
        least += min(width, MIN_WRAPPED) if is_wrapped else width
        table.add_column(
            title,
            justify="right" if head in right else "left",
            no_wrap=not is_wrapped,
            overflow="fold" if is_wrapped else "ellipsis",
        )
    if least > console.width and not anyway:
        return False
    for row in texts:
        table.add_row(*row)
    console.width = max(least, console.width)
    console.print(table)
    return True
