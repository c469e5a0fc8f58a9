"""Tables on a terminal, set by rich."""

from collections.abc import Collection, Mapping, Sequence
from typing import TextIO

from rich import box
from rich.console import Console
from rich.table import Table
from rich.text import Text

from ..answers.answer import Answer, Result
from ..quantities.formatting import Format, amount, pretty
from ..quantities.nomenclature import NOMENCLATURE, PROPERTIES
from ..scene.limits import sentence
from ..text import columns, fitting, say
from .layout import Layout

_HEADS = ("quantity", "symbol", "value", "unit", "Eq", "JKR")
_JKR = 5  # the place of JKR's value, shown beside that of another law
_WIDTHS: Sequence[tuple[int, ...]] = (
    (0, 1, 2, 3, 4),
    (1, 2, 3, 4),
    (1, 2, 3),
)  # columns of a scene's table, for narrower and narrower terminals


def scene_table(answer: Answer, out: TextIO, form: Format) -> None:
    """Write the inputs of one scene, its results below each other, and the limits of the model."""
    rows = [_result_row(result, form) for result in answer.results]
    styles = ["dim" if _is_aside(result) else "" for result in answer.results]
    say(_inputs(answer.inputs, form), out)
    has_jkr = any(result.jkr is not None for result in answer.results)
    widths = [(*part, _JKR) for part in _WIDTHS] if has_jkr else _WIDTHS
    tables = (
        _table(
            [_HEADS[place] for place in part],
            [[row[place] for place in part] for row in rows],
            out,
            {"value", "Eq", "JKR"},
            styles,
        )
        for part in widths
    )
    if not any(_print(table, out) for table in tables):
        for row in rows:
            say(" ".join(cell for cell in row[1:4] if cell), out)
    for verdict in answer.validity:
        say(f"{'valid' if verdict.holds else 'DOUBT'}: {sentence(verdict)}", out)


def _result_row(result: Result, form: Format) -> list[str]:
    quantity = NOMENCLATURE[result.name]
    value, unit = ("—", "") if result.value is None else form.rounded(result.name, result.value)
    equation = result.equation or quantity.equation
    jkr = "" if result.jkr is None else amount(result.name, result.jkr, form)
    return [quantity.sentence, quantity.symbol, value, pretty(unit), equation, pretty(jkr)]


def _is_aside(result: Result) -> bool:
    """Return whether a result is shown dimmed: it stands beside a headline, or has no value."""
    return bool(NOMENCLATURE[result.name].note) or result.value is None


def sweep_table(answers: Sequence[Answer], out: TextIO, form: Format, shape: Layout) -> None:
    """Write a row for each scene, in as many tables as the width takes; inputs that all scenes share stand above."""
    values = {name: {answer.inputs.get(name) for answer in answers} for name in shape.columns}
    inputs = answers[0].inputs
    say(_inputs({name: inputs[name] for name in shape.columns if name in inputs and len(values[name]) == 1}, form), out)
    leading = [name for name in shape.inputs if len(values[name] - {None}) != 1 and not _is_implied(name, answers)]
    results = [name for name in shape.columns if name not in shape.inputs and not _is_implied(name, answers)]
    while results:
        count = len(results)
        while not _print(_columns_table([*leading, *results[:count]], answers, out, form), out, anyway=count == 1):
            count -= 1
        results = results[count:]


def _columns_table(names: Sequence[str], answers: Sequence[Answer], out: TextIO, form: Format) -> Table:
    rows = [[_cell(answer, name, form) for name in names] for answer in answers]
    heads = [NOMENCLATURE[name].symbol or name for name in names]
    return _table(heads, rows, out, set(heads))


def _cell(answer: Answer, name: str, form: Format) -> str:
    value = answer.inputs[name] if name in answer.inputs else answer.value(name)
    return "—" if value is None else pretty(amount(name, value, form))


_LEADERS = dict.fromkeys(PROPERTIES, "material") | {name + "2": "material2" for name in PROPERTIES}


def _is_implied(name: str, answers: Sequence[Answer]) -> bool:
    """Return whether a column repeats another: sphere 2 is as large as sphere 1, or the material sets a property."""
    if name == "energy":
        return any("energy_ratio" in answer.inputs for answer in answers)
    if name == "radius2":
        return all(answer.inputs.get(name) == answer.inputs.get("radius") for answer in answers)
    leader = _LEADERS.get(name)
    if leader is None or any(leader not in answer.inputs for answer in answers):
        return False
    pairs = {(answer.inputs[leader], answer.inputs.get(name)) for answer in answers}
    return len(pairs) == len({material for material, _ in pairs})


def _inputs(inputs: Mapping[str, float | str], form: Format) -> str:
    """Return the inputs as understood, broken into lines between two of them."""
    width = columns()
    lines = [""]
    for name, value in inputs.items():
        text = pretty(amount(name, value, form))
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
    console = Console(file=out, width=columns(), highlight=False, markup=False, emoji=False)
    width = console.measure(table, options=console.options.update(width=10_000)).maximum
    if width > console.width and not anyway:
        return False
    console.width = max(width, console.width)
    console.print(table)
    return True
