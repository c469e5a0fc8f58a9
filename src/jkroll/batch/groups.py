"""The rows of a block that are evaluated together: their scenes have the same inputs, and differ by numbers alone."""

from collections.abc import Iterator, Mapping
from typing import Any, NamedTuple

import numpy

from ..materials.library import Material
from ..quantities.uncertain import Interval, Measured
from ..scene.elements import SPECIAL
from ..scene.inputs import outside
from .blocks import Block
from .cells import Mask, Numbers
from .materials import UNKNOWN, Codes, Lookup

_EMPTY, _PLAIN, _MEASURED, _INTERVAL, _SPECIAL = range(5)  # kinds of cells


class Group(NamedTuple):
    """Rows of a block, and their scene: its inputs, as arrays or as numbers that all rows have, and its materials."""

    rows: Codes
    given: Mapping[str, Any]
    material: Material | None
    material2: Material | None


class Groups:
    """The groups of a block. Rows with a cell that is no value are in none."""

    def __init__(self, block: Block, codes: Mapping[str, Codes], lookups: Mapping[str, Lookup]) -> None:
        """`codes`: of the materials, for the columns that name some; `lookups`: of the materials of both spheres."""
        self.block, self.codes, self.lookups = block, codes, lookups
        self._kinds = {name: _kinds(column) for name, column in block.numbers.items()}
        self._materials = [lookups[name].kinds(one) for name, one in codes.items()]

    def __iter__(self) -> Iterator[Group]:
        """Iterate over the groups."""
        return self._groups(numpy.flatnonzero(_fine(self.block, self.codes)), self._kinds)

    def parts(self, group: Group) -> list[Group]:
        """Return parts of a group whose special cells are numbers of the scene; none if there are no such cells."""
        kinds = {}
        for name, of_cells in self._kinds.items():
            is_special = (of_cells == _PLAIN) & (self.block.numbers[name].values == SPECIAL.get(name, numpy.nan))
            kinds[name] = numpy.where(is_special, _SPECIAL, of_cells)
        has_special = any((of_cells[group.rows] == _SPECIAL).any() for of_cells in kinds.values())
        return [*self._groups(group.rows, kinds)] if has_special else []

    def _groups(self, rows: Codes, kinds: Mapping[str, Codes]) -> Iterator[Group]:
        """Iterate over the groups among some rows, by the kinds of their cells."""
        for own in _alike(rows, [*kinds.values(), *self._materials]):
            given = {
                name: _values(self.block.numbers[name], own, int(of_cells[own[0]]))
                for name, of_cells in kinds.items()
                if of_cells[own[0]] != _EMPTY
            }
            materials = [
                lookup.together(self.codes[name][own]) if name in self.codes else lookup.known[0]
                for name, lookup in self.lookups.items()
            ]
            yield Group(own, given, *materials)


def _fine(block: Block, codes: Mapping[str, Codes]) -> Mask:
    """Return which rows have cells that are all values in the range of their inputs, or known materials."""
    is_fine = numpy.ones(block.size, dtype=bool)
    is_fine[[*block.odd]] = False
    for one in codes.values():
        is_fine &= one != UNKNOWN
    for name, column in block.numbers.items():
        is_fine[[*column.odd]] = False
        refused = outside(name, column.values)
        is_fine &= ~(refused if column.given is None else refused & column.given)
    return is_fine


def _kinds(column: Numbers) -> Codes:
    """Return the kind of each cell of a column."""
    kinds = numpy.full(len(column.values), _PLAIN, dtype=numpy.int64)
    if column.given is not None:
        kinds[~column.given] = _EMPTY
    for row, found in column.uncertain.items():
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
