"""Rows: scenes that belong together, some thousand at a time, and their columns.

Rows that have the same inputs differ by numbers alone: they are one scene of arrays. A row that is odd is a scene by
itself.
"""

from collections.abc import Callable, Hashable, Iterator, Mapping, Sequence
from functools import partial
from types import MappingProxyType
from typing import Any, NamedTuple

import numpy

from ..errors import JkrollError
from ..quantities.values import Measured
from ..scene.scene import FOLLOWS, outside
from .cells import Indices, Numbers
from .columns import Columns, Wanted, alike, as_list, lose, put_one

BAD = -1  # the kind of a row, or of a cell, of which arrays make no scene
_EMPTY, _PLAIN, _SPECIAL, _MEASURED, _INTERVAL = range(5)  # kinds of cells


class BadRecord(JkrollError):
    """Error raised for a record of a file that is no row."""


class Block(NamedTuple):
    """Rows that are computed together."""

    size: int
    numbers: Mapping[str, Numbers]  # by the name of the input
    kinds: Sequence[Indices]  # rows with other whole numbers have other scenes
    scene: Callable[[Mapping[str, Any], Indices], Any]  # of the inputs of rows that are alike, given their places
    one: Callable[[int], Any]  # of a row by itself; raises the error of what is wrong with it
    wording: Callable[[int], Hashable]  # the same for rows that lack inputs in the same words
    odd: Mapping[int, str] = MappingProxyType({})  # records that are no rows, and why


def evaluated(wanted: Wanted, block: Block) -> Columns:
    """Return the columns of a block. A row that cannot be computed has the reason for all of its cells."""
    found: Columns | None = None
    left = numpy.ones(block.size, dtype=bool)
    with numpy.errstate(all="ignore"):
        for rows, given in groups(block):
            try:
                part = _columns(wanted, block, rows, given)
            except JkrollError:
                continue  # each row then has the reason by itself
            if len(rows) == block.size:
                return part
            found = found or _empty(wanted, block.size)
            _put(found, rows, part)
            left[rows] = False
        found = found or _empty(wanted, block.size)
        for row in numpy.flatnonzero(left).tolist():
            if row in block.odd:
                lose(found, row, BadRecord(block.odd[row]))
            else:
                put_one(found, row, partial(block.one, row))
    return found


def _columns(wanted: Wanted, block: Block, rows: Indices, given: Mapping[str, Any]) -> Columns:
    """Return the columns of rows that are alike."""
    places = rows.tolist()
    return wanted.columns(
        block.scene(given, rows),
        len(rows),
        lambda row: block.one(places[row]),
        lambda row: block.wording(places[row]),
    )


def _empty(wanted: Wanted, size: int) -> Columns:
    inputs: dict[str, Any] = {name: [None] * size for name in wanted.inputs}
    numbers = numpy.full((len(wanted.keys), size), numpy.nan)
    return Columns(wanted, inputs, numbers, numpy.zeros(size, dtype=numpy.int64), {})


def _put(columns: Columns, rows: Indices, part: Columns) -> None:
    """Take the columns of some rows."""
    columns.numbers[:, rows] = part.numbers
    columns.doubts[rows] = part.doubts
    places = rows.tolist()
    for name, column in columns.inputs.items():
        for place, value in zip(places, as_list(part.inputs[name]), strict=True):
            column[place] = value
    columns.reasons.update((places[row], reasons) for row, reasons in part.reasons.items())


def groups(block: Block) -> Iterator[tuple[Indices, dict[str, Any]]]:
    """Iterate over rows that are alike, with their inputs. Rows that are BAD are in none."""
    kinds = {name: _kinds(name, column) for name, column in block.numbers.items()}
    of_rows = numpy.full(block.size, _PLAIN)
    of_rows[[*block.odd]] = BAD
    columns = [of_rows, *kinds.values()]
    for rows in alike(numpy.flatnonzero(numpy.min(columns, axis=0) != BAD), [*columns, *block.kinds]):
        of_cells = {name: int(own[rows[0]]) for name, own in kinds.items()}
        yield (
            rows,
            {name: _values(block.numbers[name], rows, kind) for name, kind in of_cells.items() if kind != _EMPTY},
        )


def _kinds(name: str, column: Numbers) -> Indices:
    """Return the kind of each cell of a column."""
    kinds = numpy.where(outside(name, column.values), BAD, _PLAIN)
    kinds[numpy.isnan(column.values)] = _EMPTY
    if name in FOLLOWS:
        kinds[column.values == FOLLOWS[name][0]] = _SPECIAL
    kinds[[*column.odd]] = BAD
    for row, found in column.uncertain.items():
        if kinds[row] != BAD:
            kinds[row] = _MEASURED if isinstance(found, Measured) else _INTERVAL
    return kinds


def _values(column: Numbers, rows: Indices, kind: int) -> Any:
    """Return the values of cells of one kind: a number where it is special, else an array, with uncertainties if they have some."""
    found = column.values if len(rows) == len(column.values) else column.values[rows]
    if kind == _SPECIAL:
        return float(found[0])
    if kind == _PLAIN:
        return found
    uncertain: list[Any] = [column.uncertain[row] for row in rows.tolist()]
    sides = {side: numpy.array([one.sides[side] for one in uncertain]) for side in uncertain[0].sides}
    return uncertain[0]._replace(value=found, **sides)
