"""Rows: scenes that belong together, some thousand at a time, and their columns.

Rows that have the same inputs differ by numbers alone: they are one scene of arrays. A row that is odd is a scene by
itself.
"""

from abc import ABC, abstractmethod
from collections.abc import Iterator, Mapping, Sequence
from functools import partial
from math import nan
from typing import TYPE_CHECKING, Any

import numpy

from ..errors import JkrollError
from ..quantities.values import Measured
from ..scene.scene import FOLLOWS, takes
from .cells import Indices, Numbers
from .columns import Columns, Row, Wanted, alike
from .reasons import ROW

if TYPE_CHECKING:
    from .sweep import Sweep

BAD = -1  # the kind of a row, or of a cell, of which arrays make no scene
_EMPTY, _PLAIN, _SPECIAL, _MEASURED, _INTERVAL = range(5)  # kinds of cells


class Block(ABC):
    """Rows that are computed together, as they stand in a list or in a table."""

    def __init__(self, size: int, numbers: Mapping[str, Numbers], kinds: Sequence[Indices]) -> None:
        """`numbers`: by input; `kinds`: rows with other whole numbers have other scenes, BAD have none."""
        self.size, self.numbers, self.kinds = size, numbers, kinds

    @abstractmethod
    def scene(self, given: Mapping[str, Any], rows: Indices) -> Any:
        """Return the scene of rows that are alike. Raises a JkrollError where each is a scene by itself."""

    @abstractmethod
    def scene_of(self, row: int) -> Any:
        """Return the scene of a row by itself. Raises the error of what is wrong with it."""


class Lists(Block):
    """Some rows of lists and ranges. Those of a pair of materials and of a law are alike."""

    def __init__(self, sweep: "Sweep", start: int, stop: int) -> None:
        """`start`, `stop`: the places of the rows in the sweep."""
        pairs, *places, laws = numpy.unravel_index(numpy.arange(start, stop), sweep.sizes)
        self.sweep, self.start, self.pairs, self.laws = sweep, start, pairs, laws
        self.fixed = {name: sweep.value(name, 0) for name, starts in sweep.starts.items() if starts[-1] == 1}
        of_inputs = zip(sweep.spreads, places, strict=True)
        numbers = {name: self._numbers(name, of_input) for name, of_input in of_inputs if name not in self.fixed}
        super().__init__(stop - start, numbers, [pairs, laws])

    def scene(self, given: Mapping[str, Any], rows: Indices) -> Any:
        """Return the scene of the inputs of rows that are alike."""
        pair, model = self.sweep.pairs[self.pairs[rows[0]]], self.sweep.models[self.laws[rows[0]]]
        return self.sweep.scene({**self.fixed, **given}, *pair, model=model)

    def scene_of(self, row: int) -> Any:
        """Return the scene of a row by itself."""
        return self.sweep.row(self.start + row)

    def _numbers(self, name: str, places: Indices) -> Numbers:
        """Return the values of an input. `places`: those of the values in its lists and ranges."""
        distinct, back = numpy.unique(places, return_inverse=True)
        values = [*map(partial(self.sweep.value, name), distinct.tolist())]
        numbers = numpy.array([value if isinstance(value, float) else value.value for value in values])
        uncertain = {row: values[place] for row, place in enumerate(back) if not isinstance(values[place], float)}
        return Numbers(numbers[back], (), uncertain)


# --- Their columns ----------------------------------------------------------------------------------------------------


def evaluated(wanted: Wanted, block: Block) -> Columns:
    """Return the columns of a block. A row that cannot be computed has the reason for all of its cells."""
    columns = Columns.empty(wanted, block.size)
    by_floats = numpy.ones(block.size, dtype=bool)
    with numpy.errstate(all="ignore"):
        for rows, given in groups(block):
            places = rows.tolist()
            try:
                of_group, by_floats[rows] = wanted.columns(block.scene(given, rows), places, block.scene_of)
            except JkrollError:
                continue  # each row then has the reason by itself
            if len(rows) == block.size:
                columns = of_group
            else:
                columns.put(places, of_group)
        for row in numpy.flatnonzero(by_floats).tolist():
            try:
                of_row = wanted.row(block.scene_of(row))
            except JkrollError as error:  # its scene cannot be made
                of_row = Row({}, [nan] * len(wanted.keys), 0, {ROW: error})
            columns.put([row], Columns.of_rows(wanted, [of_row]))
    return columns


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
    return type(uncertain[0]).of(values, **sides)
