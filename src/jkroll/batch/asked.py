"""What a table is asked for: the task that its header, its first rows and the options make."""

import sys
from collections.abc import Mapping, Sequence
from contextlib import suppress
from functools import lru_cache

from ..answers.answer import concerns
from ..answers.questions import quantities_named
from ..errors import BadRequest
from ..materials.library import Material, Materials
from ..quantities.nomenclature import NOMENCLATURE, PROPERTIES
from ..quantities.parsing import is_uncertain
from ..quantities.ranges import value_of
from ..scene.errors import MissingInput
from ..scene.scene import EXCLUSIVE, Scene
from ..scene.uncertainty import MixedKinds, sources_of
from ..text import quoted, say
from .columns import MATERIALS, Header, check_first, understood
from .errors import BadTable
from .groups import groups
from .rows import Evaluator
from .settings import Order
from .task import SIDES, Task

_SOME = 0.25  # a value that any input can have


def task_of(table: Header, inputs: Mapping[str, str], wanted: str, known: Materials) -> Task:
    """Return the task that the columns and options allow, without columns for uncertainties."""
    material, material2 = (known[inputs[name]] if name in inputs else None for name in MATERIALS)
    fixed = {name: value_of(text, name) for name, text in inputs.items() if name not in (*MATERIALS, "model")}
    task = Task(table.inputs, table.materials, (), fixed, (material, material2), known, model=inputs.get("model"))
    scene = _as_known(task)
    has_own_2 = any(name.endswith("2") for name in table.names)
    explicit, offered = quantities_named(wanted)
    for name in explicit:
        if name in table.names or name in fixed:
            raise BadRequest(f"--quantities: {name} is an input here")
        scene.plan(name)
    outcomes = scene.evaluate(offered)
    possible = [
        name
        for name in offered
        if name not in table.names
        and concerns(name, scene)
        and not (NOMENCLATURE[name].of_identical and has_own_2)
        and not isinstance(outcomes[name], MissingInput)
    ]
    quantities = tuple(dict.fromkeys((*explicit, *possible)))
    if not quantities:
        scene.plan(offered[0])
    return task._replace(
        quantities=quantities, always=frozenset(name for name in explicit if not concerns(name, scene))
    )


def _as_known(task: Task) -> Scene:
    """Return a scene in which every column has a value; of columns that exclude each other, the first."""
    given: dict[str, float] = {}
    for column in task.inputs:
        if not any(column.name in names and given.keys() & names for names in EXCLUSIVE):
            given[column.name] = _SOME
    some = Material("", dict.fromkeys(PROPERTIES, _SOME), (), {}, (), (), "", "")
    places = task.places
    return task.scene(
        given, *(some if name in places else one for name, one in zip(MATERIALS, task.spheres, strict=True))
    )


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
