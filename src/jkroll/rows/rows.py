"""Rows: scenes that belong together, some thousand at a time, and their columns.

Rows that have the same inputs differ by numbers alone: they are one scene of arrays. A row that is odd is a scene by
itself.
"""

from collections.abc import Iterator, Sequence
from functools import partial
from typing import Any

import numpy

from ..errors import JkrollError
from ..quantities.values import Measured
from ..scene.scene import FOLLOWS, takes, takes_all
from .block import BAD, Block
from .cells import Indices, Numbers
from .columns import Columns, Wanted, alike, put_row

_EMPTY, _PLAIN, _SPECIAL, _MEASURED, _INTERVAL = range(5)  # kinds of cells


def evaluated(wanted: Wanted, block: Block) -> Columns:
    """Return the columns of a block. A row that cannot be computed has the reason for all of its cells."""
    columns: Columns | None = None
    left = numpy.ones(block.size, dtype=bool)
    with numpy.errstate(all="ignore"):
        for rows, given in groups(block):
            places = rows.tolist()
            try:
                of_group = wanted.columns(block.scene(given, rows), len(rows), partial(_scene_of, block, places))
            except JkrollError:
                continue  # each row then has the reason by itself
            if len(rows) == block.size:
                return of_group
            columns = columns or _empty(wanted, block.size)
            columns.put(places, of_group)
            left[rows] = False
        columns = columns or _empty(wanted, block.size)
        for row in numpy.flatnonzero(left).tolist():
            put_row(columns, row, partial(block.scene_of, row))
    return columns


def _scene_of(block: Block, places: Sequence[int], row: int) -> Any:
    """Return the scene of a row among those at some places."""
    return block.scene_of(places[row])


def _empty(wanted: Wanted, size: int) -> Columns:
    inputs: dict[str, Any] = {name: [None] * size for name in wanted.inputs}
    numbers = numpy.full((len(wanted.keys), size), numpy.nan)
    return Columns(wanted, inputs, numbers, numpy.zeros(size, dtype=numpy.int64))


def groups(block: Block) -> Iterator[tuple[Indices, dict[str, Any]]]:
    """Iterate over rows that are alike, with their inputs. Rows that are BAD are in none."""
    kinds = {name: _kinds(name, column) for name, column in block.numbers.items()}
    columns = [*kinds.values(), *block.kinds]
    for rows in alike(numpy.flatnonzero(numpy.min(columns, axis=0) != BAD), columns):
        of_cells = {name: int(of_input[rows[0]]) for name, of_input in kinds.items()}
        filled = {name: kind for name, kind in of_cells.items() if kind != _EMPTY}
        yield rows, {name: _values(block.numbers[name], rows, kind) for name, kind in filled.items()}


def _kinds(name: str, column: Numbers) -> Indices:
    """Return the kind of each cell of a column."""
    if takes_all(name, column.values):
        kinds = numpy.full(len(column.values), _PLAIN)
    else:
        kinds = numpy.where(takes(name, column.values), _PLAIN, BAD)
        kinds[numpy.isnan(column.values)] = _EMPTY
    if name in FOLLOWS:
        kinds[column.values == FOLLOWS[name][0]] = _SPECIAL
    kinds[[*column.odd]] = BAD
    for row, value in column.uncertain.items():
        if kinds[row] != BAD:
            kinds[row] = _MEASURED if isinstance(value, Measured) else _INTERVAL
    return kinds


def _values(column: Numbers, rows: Indices, kind: int) -> Any:
    """Return the values of cells of one kind: a number where more follows from it, else an array."""
    values = column.values if len(rows) == len(column.values) else column.values[rows]
    if kind == _SPECIAL:
        return float(values[0])
    if kind == _PLAIN:
        return values
    uncertain: list[Any] = [column.uncertain[row] for row in rows.tolist()]
    sides = {side: numpy.array([value.sides[side] for value in uncertain]) for side in uncertain[0].sides}
    return uncertain[0]._replace(value=values, **sides)
