"""The rows of a block that are evaluated together: their scenes have the same inputs, and differ by numbers alone."""

from collections.abc import Iterator, Mapping, Sequence
from typing import Any, NamedTuple

import numpy

from ..errors import JkrollError
from ..materials.library import Material
from ..quantities.uncertain import Interval, Measured
from ..scene.inputs import outside
from ..scene.scene import FOLLOWS, Scene
from .blocks import Block
from .cells import Numbers
from .materials import Codes, Lookup
from .task import Task

_BAD, _EMPTY, _PLAIN, _SPECIAL, _MEASURED, _INTERVAL = range(-1, 5)  # kinds of cells


class Group(NamedTuple):
    """Rows of a block, and their scene."""

    rows: Codes
    scene: Scene
    lookups: Sequence[Lookup]  # of the materials of both spheres
    codes: Sequence[Codes]  # of the materials of the rows

    def materials(self, place: int) -> tuple[Material | None, ...]:
        """Return the materials of both spheres of the row at a place among these."""
        return tuple(lookup.known[codes[place]] for lookup, codes in zip(self.lookups, self.codes, strict=True))


def groups(task: Task, block: Block, lookups: Mapping[str, Lookup]) -> Iterator[Group]:
    """Iterate over the groups of a block. Rows with a cell that is no value, or whose inputs make no scene, are in none.

    `lookups`: of the materials of both spheres.
    """
    kinds = {name: _kinds(name, column) for name, column in block.numbers.items()}
    codes = [block.materials.get(name, numpy.zeros(block.size, dtype=numpy.int64)) for name in lookups]
    of_rows = numpy.full(block.size, _PLAIN)
    of_rows[[*block.odd]] = _BAD
    columns = [of_rows, *kinds.values(), *map(Lookup.kinds, lookups.values(), codes)]
    for rows in _alike(numpy.flatnonzero(numpy.min(columns, axis=0) != _BAD), columns):
        given = {
            name: _values(block.numbers[name], rows, int(of_cells[rows[0]]))
            for name, of_cells in kinds.items()
            if of_cells[rows[0]] != _EMPTY
        }
        own = [of_sphere[rows] for of_sphere in codes]
        try:
            scene = task.scene(given, *map(Lookup.together, lookups.values(), own))
        except JkrollError:
            continue
        yield Group(rows, scene, [*lookups.values()], own)


def _kinds(name: str, column: Numbers) -> Codes:
    """Return the kind of each cell of a column."""
    kinds = numpy.where(outside(name, column.values), _BAD, _PLAIN)
    kinds[numpy.isnan(column.values)] = _EMPTY
    if name in FOLLOWS:
        kinds[column.values == FOLLOWS[name][0]] = _SPECIAL
    kinds[[*column.odd]] = _BAD
    for row, found in column.uncertain.items():
        if kinds[row] != _BAD:
            kinds[row] = _MEASURED if isinstance(found, Measured) else _INTERVAL
    return kinds


def _alike(rows: Codes, columns: list[Codes]) -> Iterator[Codes]:
    """Iterate over the rows that have the same number in each column."""
    keys = numpy.zeros(len(rows), dtype=numpy.int64)
    for column in columns:
        own = column[rows]
        if len(own) and (own != own[0]).any():
            keys = numpy.unique(keys * (own.max() + 1) + own, return_inverse=True)[1]
    for key in range(int(keys.max(initial=-1)) + 1):
        yield rows[keys == key]


def _values(column: Numbers, rows: Codes, kind: int) -> Any:
    """Return the values of cells of one kind: a number where it is special, else an array, with uncertainties if they have some."""
    values = column.values[rows]
    if kind == _SPECIAL:
        return float(values[0])
    if kind == _PLAIN:
        return values
    of_kind: Any = Measured if kind == _MEASURED else Interval
    sides = zip(*(column.uncertain[row][1:3] for row in rows.tolist()), strict=True)
    return of_kind(values, *map(numpy.array, sides))
