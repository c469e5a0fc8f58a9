"""Tables on a terminal, set by rich."""

from collections.abc import Collection, Iterator, Mapping, Sequence
from typing import TYPE_CHECKING, Any, TextIO

from rich import box
from rich.console import Console
from rich.table import Table
from rich.text import Text

from ..answers.answer import Answer
from ..answers.result import Result
from ..quantities.formatting import Format, amount, pretty
from ..quantities.nomenclature import NOMENCLATURE, PROPERTIES
from ..text import columns, fitting, say
from .layout import Layout

if TYPE_CHECKING:
    from ..quantities.uncertain import Uncertain

_HEADS = ("quantity", "symbol", "value", "unit", "Eq", "definition", "reference", "JKR")
_JKR = 7  # the place of JKR's value, shown beside that of another law
# The columns of a scene's table, for narrower and narrower terminals: of results, and of results by convention.
_COLUMNS: Sequence[tuple[int, ...]] = ((0, 1, 2, 3, 4), (1, 2, 3, 4), (1, 2, 3))
_COLUMNS_BY_CONVENTION: Sequence[tuple[int, ...]] = ((0, 1, 2, 3, 5, 6), (1, 2, 3, 5, 6), (1, 2, 3, 5), (1, 2, 3))
MAX_ACROSS = 20  # scenes that are tried as columns
MIN_WRAPPED = 20  # characters of a column of texts on a narrow terminal


def scene_table(answer: Answer, out: TextIO, form: Format) -> None:
    """Write the inputs of one scene, and its results below each other."""
    rows = [_result_row(result, form) for result in answer.results]
    styles = ["dim" if _is_aside(result) else "" for result in answer.results]
    by_convention = all(NOMENCLATURE[result.name].definition for result in answer.results)
    say(_inputs({**answer.inputs, **answer.uncertain}, form), out)
    columns_of = _COLUMNS_BY_CONVENTION if by_convention else _COLUMNS
    if any(result.law and result.law.jkr is not None for result in answer.results):
        columns_of = [(*chosen, _JKR) for chosen in columns_of]
    right = {"value", "Eq", "JKR"}
    tables = (
        _table([_HEADS[i] for i in chosen], [[row[i] for i in chosen] for row in rows], out, right, styles)
        for chosen in columns_of
    )
    if not any(_print(table, out) for table in tables):
        for row in rows:
            say(" ".join(cell for cell in row[1:4] if cell), out)


def _result_row(result: Result, form: Format) -> list[str]:
    quantity = NOMENCLATURE[result.name]
    if result.value is None:
        value, unit = "—", ""
    else:
        value, unit = form.rounded(result.name, result.propagated.uncertainty if result.propagated else result.value)
    definition = "" if result.law else quantity.definition
    source = quantity.reference or f"Eq {result.equation}"
    beside = result.law.jkr if result.law else None
    jkr = "" if beside is None else amount(result.name, beside, form)
    return [quantity.sentence, quantity.symbol, value, pretty(unit), result.equation, definition, source, jkr]


def _is_aside(result: Result) -> bool:
    """Return whether a result is shown dimmed: it stands beside a headline, or has no value."""
    return bool(NOMENCLATURE[result.name].note) or result.value is None


def sweep_table(answers: Sequence[Answer], out: TextIO, form: Format, shape: Layout) -> None:
    """Write a table of several scenes; inputs that all of them share stand above.

    A scene is a row. Where that is wider than the terminal, a scene is a column, and where this is too wide as well, a row
    again, of as many tables as it takes.
    """
    of_rows = [{**answer.inputs, **answer.uncertain} for answer in answers]
    values = {name: {inputs.get(name) for inputs in of_rows} for name in shape.columns}
    inputs = of_rows[0]
    common = {name: inputs[name] for name in shape.columns if name in inputs and len(values[name]) == 1}
    say(_inputs(common, form, f"{len(answers)} scenes"), out)
    leading = [name for name in shape.inputs if len(values[name] - {None}) != 1 and not _is_implied(name, answers)]
    results = [name for name in shape.columns if name not in shape.inputs and not _is_implied(name, answers)]
    if _print(_columns_table([*leading, *results], answers, out, form), out):
        return
    if len(answers) <= MAX_ACROSS and any(
        _print(table, out) for table in _across(leading, results, answers, out, form)
    ):
        return
    while results:
        count = len(results)
        while not _print(_columns_table([*leading, *results[:count]], answers, out, form), out, anyway=count == 1):
            count -= 1
        results = results[count:]


def _columns_table(names: Sequence[str], answers: Sequence[Answer], out: TextIO, form: Format) -> Table:
    columns = [_column(name, answers, form) for name in names]
    heads = [column[0] for column in columns]
    return _table(heads, [*zip(*(column[1:] for column in columns), strict=True)], out, set(heads))


def _across(
    leading: Sequence[str], results: Sequence[str], answers: Sequence[Answer], out: TextIO, form: Format
) -> Iterator[Table]:
    """Iterate over tables with a column for each scene and a row for each result: with the words for it, and without."""
    numbers = ["scene", *(str(number) for number in range(1, len(answers) + 1))]
    distinct = [_column(name, answers, form) for name in leading] or [numbers]
    heads = ["\n".join(parts) for parts in zip(*distinct, strict=True)]
    rows = [_column(name, answers, form) for name in results]
    words = [NOMENCLATURE[name].sentence for name in results]
    yield _table(
        ["quantity", *heads], [[word, *row] for word, row in zip(words, rows, strict=True)], out, set(heads[1:])
    )
    yield _table(heads, rows, out, set(heads[1:]))


def _column(name: str, answers: Sequence[Answer], form: Format) -> list[str]:
    """Return the head and the cells of a column; the head has the unit, if one suits all of its values."""
    head = NOMENCLATURE[name].symbol or name
    values = [_value(answer, name) for answer in answers]
    common = form.common_unit(name, [value for value in values if not isinstance(value, str | None)])
    if common:
        cells = ["—" if value is None else form.in_unit(value, common) for value in values]
        return [f"{head} [{pretty(common[0])}]", *cells]
    return [head, *("—" if value is None else amount(name, value, form) for value in values)]


def _value(answer: Answer, name: str) -> Any:
    """Return an input or a result, with its uncertainty if it has one."""
    if name in answer.inputs:
        return answer.uncertain.get(name, answer.inputs[name])
    result = next((result for result in answer.results if result.name == name), None)
    return result and (result.propagated.uncertainty if result.propagated else result.value)


_LEADERS = dict.fromkeys(PROPERTIES, "material") | {name + "2": "material2" for name in PROPERTIES}


def _is_implied(name: str, answers: Sequence[Answer]) -> bool:
    """Return whether a column repeats another: sphere 2 is as large as sphere 1, or the material sets a property."""
    if name == "energy":
        return any("energy_ratio" in answer.inputs for answer in answers)
    if name == "radius2":
        return all(answer.inputs.get(name) == answer.inputs.get("radius") for answer in answers)
    leader = _LEADERS.get(name)
    if leader is None or all(name not in answer.inputs for answer in answers):
        return False
    if any(leader not in answer.inputs for answer in answers):
        return False
    pairs = {(answer.inputs[leader], answer.inputs.get(name)) for answer in answers}
    return len(pairs) == len({material for material, _ in pairs})


def _inputs(inputs: "Mapping[str, float | str | Uncertain]", form: Format, start: str = "") -> str:
    """Return the inputs as understood, broken into lines between two of them."""
    width = columns()
    lines = [start]
    for name, value in inputs.items():
        text = amount(name, value, form)
        part = text if name == "material" else f"{NOMENCLATURE[name].symbol or name} = {text}"
        if lines[-1] and len(lines[-1]) + len(part) + 2 >= width:
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
    table = _table(heads, rows, out)
    last = table.columns[-1]
    last.no_wrap, last.overflow = False, "fold"
    console = _console(out)
    others = _table(heads[:-1], [row[:-1] for row in rows], out)
    least = console.measure(others, options=console.options.update(width=10_000)).minimum + MIN_WRAPPED
    console.width = max(console.width, least)
    console.print(table)


def _console(out: TextIO) -> Console:
    return Console(file=out, width=columns(), highlight=False, markup=False, emoji=False)


def _table(
    heads: Sequence[str],
    rows: Sequence[Sequence[str]],
    out: TextIO,
    right: Collection[str] = (),
    styles: Sequence[str] = (),
) -> Table:
    """Return a table of texts, with a style for each row if any, and the columns named in `right` set to the right."""
    table = Table(box=box.SIMPLE_HEAD, pad_edge=False, show_edge=False)
    for head in heads:
        table.add_column(Text(fitting(head, out)), justify="right" if head in right else "left", no_wrap=True)
    for row, style in zip(rows, styles or [""] * len(rows), strict=True):
        table.add_row(*(Text(fitting(cell, out), style) for cell in row))
    return table


def _print(table: Table, out: TextIO, *, anyway: bool = False) -> bool:
    """Print a table if the terminal is wide enough for it, or anyway, and return whether it was printed."""
    console = _console(out)
    width = console.measure(table, options=console.options.update(width=10_000)).maximum
    if width > console.width and not anyway:
        return False
    console.width = max(width, console.width)
    console.print(table)
    return True
