"""Tables on a terminal. The only module that imports rich."""

from collections.abc import Collection, Mapping, Sequence
from typing import TextIO

from rich import box
from rich.console import Console
from rich.table import Table
from rich.text import Text

from ..answers.answer import Answer
from ..quantities.formatting import Format, amount, pretty
from ..quantities.nomenclature import NOMENCLATURE, PROPERTIES
from ..scene.limits import sentence
from ..text import columns, fitting, say
from .layout import Layout


def scene_table(answer: Answer, out: TextIO, form: Format) -> None:
    """The inputs of one scene, and its results below each other; on a narrow terminal without descriptions."""
    rows = []
    for result in answer.results:
        quantity = NOMENCLATURE[result.name]
        value, unit = form.rounded(result.name, result.value) if result.value is not None else ("—", "")
        style = "dim" if quantity.note or result.value is None else ""
        rows.append(([quantity.sentence, quantity.symbol, value, pretty(unit), quantity.equation], style))
    say(_inputs(answer.inputs, form), out)
    heads = ["quantity", "symbol", "value", "unit", "Eq"]
    for first, last in ((0, 5), (1, 5), (1, 4)):
        table = _table(heads[first:last], [(cells[first:last], style) for cells, style in rows], out, {"value", "Eq"})
        if _print(table, out):
            break
    else:
        for cells, _ in rows:
            say(" ".join(cell for cell in cells[1:4] if cell), out)
    for verdict in answer.validity:
        say(f"{'valid' if verdict.holds else 'DOUBT'}: {sentence(verdict)}", out)


def sweep_table(answers: Sequence[Answer], out: TextIO, form: Format, shape: Layout) -> None:
    """A row a scene: what differs between the scenes, then the results, in as many tables as the width takes.

    What the scenes share stands above.
    """
    names = shape.columns
    distinct = {name: {answer.inputs.get(name) for answer in answers} for name in names}
    shared = {name: answers[0].inputs[name] for name in names if name in answers[0].inputs and len(distinct[name]) == 1}
    silent = {name for name in names if name in shape.inputs and len(distinct[name] - {None}) == 1}
    shown = [name for name in names if name not in silent and not _follows(name, answers)]
    leading = [name for name in shown if name in shape.inputs]
    results = [name for name in shown if name not in shape.inputs]
    say(_inputs(shared, form), out)
    while results:
        count = len(results)
        while not _print(_columns_table([*leading, *results[:count]], answers, out, form), out, anyway=count == 1):
            count -= 1
        results = results[count:]


def _columns_table(names: Sequence[str], answers: Sequence[Answer], out: TextIO, form: Format) -> Table:
    rows = []
    for answer in answers:
        values = [answer.inputs[name] if name in answer.inputs else answer.value(name) for name in names]
        cells = [
            "—" if value is None else pretty(amount(name, value, form))
            for name, value in zip(names, values, strict=True)
        ]
        rows.append((cells, ""))
    heads = [NOMENCLATURE[name].symbol or name for name in names]
    return _table(heads, rows, out, set(heads))


def _follows(name: str, answers: Sequence[Answer]) -> bool:
    """Whether an input says nothing new: sphere 2 is as large as sphere 1, or the material decides."""
    leaders = (
        {"radius2": "radius"} | dict.fromkeys(PROPERTIES, "material") | {prop + "2": "material2" for prop in PROPERTIES}
    )
    if name == "energy":
        return any("energy_ratio" in answer.inputs for answer in answers)
    leader = leaders.get(name)
    if leader is None or any(leader not in answer.inputs for answer in answers):
        return False
    if name == "radius2":
        return all(answer.inputs.get(name) == answer.inputs[leader] for answer in answers)
    return len({(answer.inputs[leader], answer.inputs.get(name)) for answer in answers}) == len(
        {answer.inputs[leader] for answer in answers}
    )


def _inputs(inputs: Mapping[str, float | str], form: Format) -> str:
    """The inputs as understood, in lines that end between two of them."""
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
    """A table of texts, or, on a narrow terminal, a line a cell."""
    if not _print(_table(heads, [([pretty(cell) for cell in row], "") for row in rows], out, set()), out):
        for row in rows:
            for head, cell in zip(heads, row, strict=True):
                say(f"{head}: {cell}", out)


def _table(
    heads: Sequence[str], rows: Sequence[tuple[Sequence[str], str]], out: TextIO, right: Collection[str]
) -> Table:
    """A table of texts, each row in a style, the columns named in `right` set to the right."""
    table = Table(box=box.SIMPLE_HEAD, pad_edge=False, show_edge=False)
    for head in heads:
        table.add_column(Text(fitting(head, out)), justify="right" if head in right else "left", no_wrap=True)
    for cells, style in rows:
        table.add_row(*(Text(fitting(cell, out), style) for cell in cells))
    return table


def _print(table: Table, out: TextIO, *, anyway: bool = False) -> bool:
    """Print a table if the terminal is wide enough to show it whole, or anyway, uncut; whether it was printed."""
    console = Console(file=out, width=columns(), highlight=False, markup=False, emoji=False)
    width = console.measure(table, options=console.options.update(width=10_000)).maximum
    if width > console.width and not anyway:
        return False
    console.width = max(width, console.width)
    console.print(table)
    return True
