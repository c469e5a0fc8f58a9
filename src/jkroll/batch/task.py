"""The task that a header and the options make: the quantities to compute, and the inputs that fill gaps."""

import sys
from collections.abc import Mapping, Sequence
from contextlib import suppress
from functools import lru_cache
from typing import TYPE_CHECKING, Any

from ..answers.answer import concerns
from ..answers.questions import quantities_named
from ..errors import BadRequest, JkrollError
from ..materials.library import Material, Materials
from ..quantities.nomenclature import PROPERTIES
from ..quantities.parsing import has_uncertainty, is_uncertain
from ..quantities.ranges import value_of
from ..scene.errors import MissingInput
from ..scene.scene import EXCLUSIVE, Scene
from ..text import quoted, say
from .columns import MATERIALS, Header, check_first, understood
from .errors import BadTable
from .settings import Order
from .single import SIDES, Task, scene_of

if TYPE_CHECKING:
    from ..quantities.uncertain import Uncertain


def task_of(table: Header, inputs: Mapping[str, str], wanted: str, known: Materials) -> Task:
    """Return the task that the columns and options allow, without columns for uncertainties."""
    spheres = {name: known[inputs[name]] if name in inputs else None for name in MATERIALS}
    texts = {*MATERIALS, "model"}
    fixed = {name: value_of(text, name) for name, text in inputs.items() if name not in texts}
    model = inputs.get("model")
    scene = _as_known(table, fixed, spheres, model)
    explicit, offered = quantities_named(wanted)
    for name in explicit:
        if name in table.names or name in fixed:
            raise BadRequest(f"--quantities: {name} is an input here")
        scene.plan(name)
    unequal = _as_known(table, fixed, spheres, model, of_sphere_2=_OTHER)
    outcomes = unequal.evaluate(offered)
    possible = [
        name
        for name in offered
        if name not in table.names and concerns(name, unequal) and not isinstance(outcomes[name], MissingInput)
    ]
    quantities = tuple(dict.fromkeys((*explicit, *possible)))
    if not quantities:
        scene.plan(offered[0])
    return Task(
        table.inputs,
        table.materials,
        quantities,
        fixed,
        spheres["material"],
        spheres["material2"],
        known,
        model=model,
        always=frozenset(name for name in explicit if not concerns(name, scene)),
    )


_SOME, _OTHER = 0.25, 0.26  # values that any input can have


def _as_known(
    table: Header,
    fixed: "Mapping[str, float | Uncertain]",
    spheres: Mapping[str, Any],
    model: str | None,
    of_sphere_2: float = _SOME,
) -> Scene:
    """Return a scene in which every column has a value; of columns that exclude each other, the first."""
    given: dict[str, float] = {}
    for column in table.inputs:
        if not any(column.name in names and given.keys() & names for names in EXCLUSIVE):
            given[column.name] = of_sphere_2 if column.name.endswith("2") else _SOME
    places = dict(table.materials)
    materials = [
        _any_material(value) if name in places else spheres[name]
        for name, value in zip(MATERIALS, (_SOME, of_sphere_2), strict=True)
    ]
    return Scene({**fixed, **given}, *materials, model=model)


def _any_material(value: float) -> Material:
    return Material("", dict.fromkeys(PROPERTIES, value), (), {}, (), (), "", "")


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
    task = task._replace(kinds=tuple(SIDES) if order.settings.uncertainty else _kinds_of(task, rows))
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


def _kinds_of(task: Task, rows: Sequence[Sequence[str]]) -> tuple[str, ...]:
    """Return the kinds of the uncertainties that options have, or that enter results of some rows."""
    kinds: set[str] = {value.kind for value in task.fixed.values() if is_uncertain(value)}
    places = task.places
    for row in rows:
        with suppress(JkrollError):  # a bad row, which its status will explain
            kinds |= _kinds_of_row(task, {name: row[place] for name, place in places.items()})
    return tuple(kind for kind in SIDES if kind in kinds)


def _kinds_of_row(task: Task, cells: Mapping[str, str]) -> set[str]:
    """Return the kinds of the uncertainties that enter results of a row. Raises a JkrollError for a bad row."""
    materials = [task.known[cells[name]] for name, _ in task.materials_at if cells[name].strip()]
    is_uncertain_row = any(map(has_uncertainty, cells.values())) or any(
        one.uncertainties for one in (*materials, task.material, task.material2) if one is not None
    )
    if not is_uncertain_row:
        return set()
    from ..scene.uncertainty import sources_of

    scene = scene_of(task, cells.__getitem__)
    inputs = scene.inputs_of(*scene.numbers(*task.quantities))
    return {source.given.kind for source in sources_of(scene, inputs).entering}
