"""The evaluation of a block of rows: rows that differ by numbers alone at once, and an odd row as a scene of its own.

The two ways run the same formulas. The second has the words of a one-liner for cells that are no values, and finds what
the first leaves open.
"""

from collections.abc import Callable, Mapping, Sequence
from contextlib import suppress
from functools import partial

import numpy

from ..errors import JkrollError
from .blocks import Block, Results
from .cells import Reader
from .columns import MATERIALS
from .errors import BadRow
from .evaluated import Evaluated
from .groups import groups
from .materials import Lookup
from .task import Task


class Evaluator:
    """Computes one block after another."""

    def __init__(self, task: Task) -> None:
        """`task`: the quantities to compute."""
        self.task = task
        self.readers = [Reader(column) for column in task.inputs]
        self.lookups = {
            name: Lookup(task.known, material) for name, material in zip(MATERIALS, task.spheres, strict=True)
        }

    def block(
        self, size: int, cells: Mapping[str, Sequence[bytes]], odd: Mapping[int, str], lines: Sequence[int]
    ) -> Block:
        """Return a block of rows of texts, by the name of the input. `odd` and `lines` are as in `Block`."""
        return Block(
            size,
            {reader.column.name: reader.numbers(cells[reader.column.name]) for reader in self.readers},
            {name: self.lookups[name].codes(cells[name]) for name, _ in self.task.materials_at},
            odd,
            lines,
            lambda row, name: cells[name][row].decode("utf-8", "replace"),
        )

    def results(self, block: Block) -> Results:
        """Return the results of a block. Raises BadRow for one that fails where none may."""
        results = Results(self.task, block.size)
        is_open = numpy.ones(block.size, dtype=bool)
        with numpy.errstate(all="ignore"):
            for group in groups(self.task, block, self.lookups):
                with suppress(JkrollError):  # which each row then has by itself
                    found = Evaluated(self.task, group.scene, len(group.rows), group.materials)
                    results.put(group.rows, found)
                    is_open[group.rows] = found.is_open
            for row in numpy.flatnonzero(is_open).tolist():
                if row in block.odd:
                    results.lose(row, block.odd[row])
                else:
                    results.put(numpy.array([row]), self.alone(partial(block.text, row)))
        if self.task.strict and results.lost:
            first = min(results.lost)
            raise BadRow(block.lines[first], results.status[first])
        return results

    def alone(self, text_of: Callable[[str], str]) -> Results:
        """Return the results of a row by itself. `text_of` gives the cell of an input."""
        try:
            scene = self.task.scene_of(text_of)
            return Evaluated(self.task, scene, 1, lambda _: (scene.material, scene.material2))
        except JkrollError as error:
            results = Results(self.task, 1)
            results.lose(0, str(error))
            return results
