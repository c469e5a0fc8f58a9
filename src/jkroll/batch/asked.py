"""The task of a table: what its header, its first rows and the options ask for."""

import sys
from collections.abc import Sequence
from contextlib import suppress
from functools import lru_cache

from ..quantities.parsing import is_uncertain
from ..scene.uncertainty import MixedKinds, sources_of
from ..table.columns import Header, check_first, understood
from ..table.errors import BadTable
from ..table.evaluator import Evaluator
from ..table.groups import groups
from ..table.task import SIDES, Task, task_of
from ..text import quoted, say
from .settings import Order


@lru_cache(maxsize=8)  # the tables of a run often have the same header
def _task_of(names: tuple[str, ...], order: Order) -> tuple[Header, Task]:
    """Return the columns of a header and the task, without columns for uncertainties."""
    table = understood(names)
    task = task_of(table, order.inputs, order.settings.quantities, order.known)
    return table, task._replace(doubt=order.settings.doubt, strict=order.settings.strict)


def task_of_table(names: tuple[str, ...], rows: Sequence[Sequence[str]], order: Order) -> Task:
    """Return the task of a table with this header, and say which columns it does not use.

    `rows`: the cells of the first rows, which decide on the columns for uncertainties. Raises BadTable, or an error of the options.
    """
    table, task = _task_of(names, order)
    sides = {*SIDES} if order.settings.uncertainty else _sides_of(task, rows)
    task = task._replace(sides=tuple(side for side in SIDES if side in sides))
    taken = set(task.added)
    for text in names:
        if text.strip() in taken:
            raise BadTable(f"header: there is a column {quoted(text)} already; rename it, or choose --quantities")
    if table.passing and not order.settings.quiet:
        names_passing = ", ".join(quoted(text) for text in table.passing)
        say(f"note: {names_passing}: no input; passed through, not used", sys.stderr)
    if "radius" not in {*table.names, *order.inputs} and not (order.settings.quantities or order.settings.quiet):
        say("note: no column and no option gives a radius; what needs one is left out", sys.stderr)
    for column in task.inputs:
        check_first(column, [row[column.place] for row in rows])
    return task


def _sides_of(task: Task, rows: Sequence[Sequence[str]]) -> set[str]:
    """Return the sides of the uncertainties that options have, or that enter results of some rows."""
    found = {side for value in task.fixed.values() if is_uncertain(value) for side in value.sides}
    cells = {name: [row[place].encode() for row in rows] for name, place in task.places.items()}
    evaluator = Evaluator(task)
    for group in groups(task, evaluator.block(len(rows), cells, {}, ()), evaluator.lookups):
        scene = group.scene
        if scene.is_uncertain:
            with suppress(MixedKinds):  # bad rows, which their status will explain
                sources = sources_of(scene, scene.inputs_of(*scene.numbers(*task.quantities)))
                found |= {side for source in sources.entering for side in source.given.sides}
    return found
