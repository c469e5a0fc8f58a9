"""Tables on a terminal. The only module that imports rich."""

from collections.abc import Sequence
from typing import TextIO

from rich import box
from rich.console import Console
from rich.table import Table
from rich.text import Text

from .answer import Answer, Command
from .formatting import Format, amount
from .nomenclature import NOMENCLATURE
from .report import columns, say, write_plain


def scene_table(answer: Answer, out: TextIO, form: Format) -> None:
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
        table.add_row(*(Text(cell, style) for cell in cells))
    say(_inputs(answer, form), out)
    _print(table, out, [answer], form)


def sweep_table(answers: Sequence[Answer], out: TextIO, form: Format, command: Command) -> None:
    """A row a scene: what differs between the scenes, then the results. What they share stands above."""
    names = columns(answers, command)
    shared = [name for name in names if name in answers[0].inputs and len({answer.inputs.get(name) for answer in answers}) == 1]
    table = _table()
    shown = [name for name in names if name not in shared]
    for name in shown:
        table.add_column(Text(NOMENCLATURE[name].symbol or name), justify="right", no_wrap=True)
    for answer in answers:
        cells = []
        for name in shown:
            value = answer.inputs[name] if name in answer.inputs else answer.value(name)
            cells.append(Text("—" if value is None else pretty(amount(name, value, form))))
        table.add_row(*cells)
    first = answers[0]
    say(_inputs(first._replace(inputs={name: first.inputs[name] for name in shared}), form), out)
    _print(table, out, answers, form, command)


def pretty(unit: str) -> str:
    """A unit with superscripts.

    >>> pretty("mJ/m^2")
    'mJ/m²'
    """
    return unit.replace("^2", "²").replace("^3", "³")


def _inputs(answer: Answer, form: Format) -> str:
    """The inputs as understood, in one line."""
    parts = [
        str(value) if name == "material" else f"{NOMENCLATURE[name].symbol or name} = {pretty(amount(name, value, form))}"
        for name, value in answer.inputs.items()
    ]
    return ", ".join(parts)


def _table() -> Table:
    return Table(box=box.SIMPLE_HEAD, pad_edge=False, show_edge=False)


def _print(table: Table, out: TextIO, answers: Sequence[Answer], form: Format, command: Command | None = None) -> None:
    """Print the table, or plain lines where the terminal is too narrow for it."""
    console = Console(file=out, safe_box=True, highlight=False, markup=False, emoji=False)
    if table.__rich_measure__(console, console.options).minimum <= console.width:
        console.print(table)
    else:
        write_plain(answers, out, form, command or Command("", (), (), ""))
