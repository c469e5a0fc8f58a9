"""Tables on a terminal. The only module that imports rich."""

from collections.abc import Sequence
from shutil import get_terminal_size
from typing import TextIO

from rich import box
from rich.console import Console
from rich.table import Table
from rich.text import Text

from .answer import Answer, Command
from .formatting import PEOPLE_DIGITS, Format, amount
from .materials import PROPERTIES
from .nomenclature import NOMENCLATURE
from .report import columns, fitting, say, write_plain


def scene_table(answer: Answer, out: TextIO, form: Format, command: Command) -> None:
    """The inputs of one scene in a line, and its results below each other."""
    table = _table()
    table.add_column("quantity")
    table.add_column("symbol", no_wrap=True)
    table.add_column("value", justify="right", no_wrap=True)
    table.add_column("unit", no_wrap=True)
    table.add_column("Eq", justify="right", no_wrap=True)
    for result in answer.results:
        quantity = NOMENCLATURE[result.name]
        value, unit = form.people(result.name, result.value) if result.value is not None else ("—", "")
        style = "dim" if quantity.note or result.value is None else ""
        cells = (quantity.sentence, quantity.symbol, value, pretty(unit), quantity.equation)
        table.add_row(*(Text(fitting(cell, out), style) for cell in cells))
    say(_inputs(answer, form), out)
    _print(table, out, [answer], form, command)


def sweep_table(answers: Sequence[Answer], out: TextIO, form: Format, command: Command) -> None:
    """A row a scene: what differs between the scenes, then the results. What they share stands above."""
    names = columns(answers, command)
    shared = [
        name
        for name in names
        if name in answers[0].inputs and len({answer.inputs.get(name) for answer in answers}) == 1
    ]
    shown = [name for name in names if name not in shared and not _follows(name, answers)]
    table = _table()
    for name in shown:
        table.add_column(Text(fitting(NOMENCLATURE[name].symbol or name, out)), justify="right", no_wrap=True)
    for answer in answers:
        cells = []
        for name in shown:
            value = answer.inputs[name] if name in answer.inputs else answer.value(name)
            cells.append(Text(fitting("—" if value is None else pretty(amount(name, value, form)), out)))
        table.add_row(*cells)
    first = answers[0]
    say(_inputs(first._replace(inputs={name: first.inputs[name] for name in shared}), form), out)
    _print(table, out, answers, form, command)


def _follows(name: str, answers: Sequence[Answer]) -> bool:
    """Whether an input says nothing new: sphere 2 is as large as sphere 1, or the material decides."""
    leaders = (
        {"radius2": "radius"} | dict.fromkeys(PROPERTIES, "material") | {prop + "2": "material2" for prop in PROPERTIES}
    )
    leader = leaders.get(name)
    if leader is None or any(leader not in answer.inputs for answer in answers):
        return False
    if name == "radius2":
        return all(answer.inputs.get(name) == answer.inputs[leader] for answer in answers)
    return len({(answer.inputs[leader], answer.inputs.get(name)) for answer in answers}) == len(
        {answer.inputs[leader] for answer in answers}
    )


def pretty(unit: str) -> str:
    """A unit with superscripts.

    >>> pretty("mJ/m^2")
    'mJ/m²'
    """
    return unit.replace("^2", "²").replace("^3", "³")


def _inputs(answer: Answer, form: Format) -> str:
    """The inputs as understood, in lines that end between two of them."""
    width = get_terminal_size().columns
    lines = [""]
    for name, value in answer.inputs.items():
        text = pretty(amount(name, value, form))
        part = text if name == "material" else f"{NOMENCLATURE[name].symbol or name} = {text}"
        if lines[-1] and len(lines[-1]) + len(part) + 2 >= width:
            lines[-1] += ","
            lines.append("")
        lines[-1] += f", {part}" if lines[-1] else part
    return "\n".join(lines)


def _table() -> Table:
    return Table(box=box.SIMPLE_HEAD, pad_edge=False, show_edge=False)


def write_rows(heads: Sequence[str], rows: Sequence[Sequence[str]], out: TextIO) -> None:
    """A table of texts."""
    table = _table()
    for head in heads:
        table.add_column(Text(fitting(head, out)), no_wrap=True)
    for cells in rows:
        table.add_row(*(Text(fitting(pretty(cell), out)) for cell in cells))
    if not _fits(table, out):
        for cells in (heads, *rows):
            say("\t".join(cells), out)


def _print(table: Table, out: TextIO, answers: Sequence[Answer], form: Format, command: Command) -> None:
    """Print the table, or plain lines where the terminal is too narrow for it."""
    if not _fits(table, out):
        write_plain(answers, out, form._replace(digits=form.digits or PEOPLE_DIGITS), command)


def _fits(table: Table, out: TextIO) -> bool:
    """Print a table if the terminal is wide enough to show it whole."""
    console = Console(file=out, highlight=False, markup=False, emoji=False)
    if console.measure(table, options=console.options.update(width=10_000)).maximum > console.width:
        return False
    console.print(table)
    return True
