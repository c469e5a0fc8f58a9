"""The task that a header and the options make: the quantities to compute, and the inputs that fill gaps."""

import sys
from collections.abc import Mapping
from typing import Any

from ..answers.answer import concerns
from ..answers.questions import quantities_named
from ..errors import BadRequest
from ..materials.library import Material, Materials
from ..quantities.nomenclature import PROPERTIES, header
from ..quantities.parsing import parse_quantity
from ..scene.scene import EXCLUSIVE, Scene
from ..text import quoted, say
from .columns import MATERIALS, Header, understood
from .errors import BadTable
from .settings import Order
from .single import Task, lacking


def task_of(table: Header, inputs: Mapping[str, str], wanted: str, known: Materials) -> Task:
    """Return the task that the columns and options allow."""
    spheres = {name: known[inputs[name]] if name in inputs else None for name in MATERIALS}
    texts = {*MATERIALS, "model"}
    fixed = {name: parse_quantity(text, name) for name, text in inputs.items() if name not in texts}
    model = inputs.get("model")
    scene = _as_known(table, fixed, spheres, model)
    explicit, offered = quantities_named(wanted)
    for name in explicit:
        if name in table.names or name in fixed:
            raise BadRequest(f"--quantities: {name} is an input here")
        scene.plan(name)
    is_pair = any(name.endswith("2") for name in {*table.names, *inputs})
    besides = {*table.names, "rolling_frequency_as_printed"} if is_pair else table.names
    possible = [
        name for name in offered if name not in besides and concerns(name, scene) and lacking(name, scene) is None
    ]
    quantities = tuple(dict.fromkeys((*explicit, *possible)))
    if not quantities:
        scene.plan(offered[0])
    return Task(
        table.inputs, table.materials, quantities, fixed, spheres["material"], spheres["material2"], known, model=model
    )


def _as_known(table: Header, fixed: Mapping[str, float], spheres: Mapping[str, Any], model: str | None) -> Scene:
    """Return a scene in which every column has a value; of columns that exclude each other, the first."""
    some = Material("", dict.fromkeys(PROPERTIES, _SOME), (), {}, (), (), "", "")
    given: dict[str, float] = {}
    for column in table.inputs:
        if not any(column.name in names and given.keys() & names for names in EXCLUSIVE):
            given[column.name] = _SOME
    places = dict(table.materials)
    return Scene({**fixed, **given}, *(some if name in places else spheres[name] for name in MATERIALS), model=model)


_SOME = 0.25  # a value that any input can have


def understood_task(names: tuple[str, ...], order: Order) -> tuple[Header, Task]:
    """Return the columns of a header and the task. Raises BadTable, or an error of the options."""
    table = understood(names)
    task = task_of(table, order.inputs, order.settings.quantities, order.known)._replace(doubt=order.settings.doubt)
    taken = {header(name) for name in task.quantities} | {*task.said, *task.remarks}
    for text in table.texts:
        if text.strip() in taken:
            raise BadTable(f"header: there is a column {quoted(text)} already; rename it, or choose --quantities")
    if table.passing and not order.settings.quiet:
        names_passing = ", ".join(quoted(text) for text in table.passing)
        say(f"note: {names_passing}: no input; passed through, not used", sys.stderr)
    return table, task
