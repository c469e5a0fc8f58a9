"""The evaluation of a block of rows: rows that differ by numbers alone at once, and an odd row as a scene of its own.

The two ways run the same formulas. Where the physics explains a failure, the first finds its words too; the second serves
rows with any other failure, and those whose error bars need a search.
"""

from collections.abc import Mapping, Sequence
from functools import partial
from typing import Any

import numpy

from ..errors import JkrollError
from ..scene.elements import element
from ..scene.errors import NoContact
from ..scene.scene import Scene
from .blocks import Block, Results
from .cells import Floats, Reader
from .columns import DOUBT, STATUS
from .errors import BadRow
from .evaluated import Evaluated
from .groups import Group, Groups
from .materials import Codes, Lookup
from .single import Single, Task, alone, doubts_of, worded


class Evaluator:
    """Computes one block after another."""

    def __init__(self, task: Task) -> None:
        """`task`: the quantities to compute."""
        self.task = task
        self.readers = [Reader(column) for column in task.inputs]
        self.lookups = {
            "material": Lookup(task.known, task.material),
            "material2": Lookup(task.known, task.material2),
        }

    def results_of_texts(
        self, size: int, cells: Mapping[str, Sequence[bytes]], odd: Mapping[int, str], lines: Sequence[int]
    ) -> Results:
        """Return the results of rows of texts, by the name of the input. `odd`: records that are no rows, and why; `lines`: at which the rows begin."""
        block = Block(
            size,
            {reader.column.name: reader.numbers(cells[reader.column.name]) for reader in self.readers},
            {name: cells[name] for name, _ in self.task.materials_at},
            odd,
            lines,
            lambda row, name: cells[name][row].decode("utf-8", "replace"),
        )
        return self.results(block)

    def results(self, block: Block) -> Results:
        """Return the results of a block. Raises BadRow for one that fails where none may."""
        sheet = _Sheet(self.task, numpy.empty((len(self.task.headers), block.size)))
        codes = {
            name: cells if isinstance(cells, numpy.ndarray) else self.lookups[name].codes(cells)
            for name, cells in block.materials.items()
        }
        together = Groups(block, codes, self.lookups)
        with numpy.errstate(all="ignore"):
            for group in together:
                found = self._evaluated(group)
                # Without an input that is missing, more may follow from a special value of another than from a number.
                parts = together.parts(group) if found is not None and found.missing else []
                for part, found_of_part in [(part, self._evaluated(part)) for part in parts] or [(group, found)]:
                    if found_of_part is not None:
                        self._take(part.rows, found_of_part, codes, sheet)
        for row in numpy.flatnonzero(sheet.is_single).tolist():
            if row in block.odd:
                sheet.lose(row, block.odd[row])
            else:
                sheet.take(row, alone(self.task, partial(block.text, row)))
        results = sheet.results()
        if self.task.strict and results.lost:
            first = min(results.lost)
            raise BadRow(block.lines[first], sheet.status[first])
        return results

    def _evaluated(self, group: Group) -> Evaluated | None:
        """Evaluate a group; return None if its inputs make no scene."""
        given = {**{name: one for name, one in self.task.fixed.items() if name not in group.given}, **group.given}
        try:
            scene = Scene(given, group.material, group.material2, model=self.task.model)
        except JkrollError:
            return None
        return Evaluated(self.task, scene, len(group.rows))

    def _take(self, rows: Codes, found: Evaluated, codes: Mapping[str, Codes], sheet: "_Sheet") -> None:
        """Take the results of a group, and say why values are missing. Rows of which the physics does not say it stay single."""
        is_single = found.propagate() if found.scene.is_uncertain else numpy.zeros(len(rows), dtype=bool)
        sheet.put(rows, found)
        if self.task.doubt:
            sheet.doubts |= _doubts(found.scene, found.known, rows)
        fails = numpy.any(found.fails, axis=0)
        texts: dict[object, str] = {}
        for place in numpy.flatnonzero((fails | bool(found.missing or found.remark)) & ~is_single).tolist():
            row = int(rows[place])
            reasons = found.reasons(place) if fails[place] else {}
            if isinstance(reasons, NoContact):
                sheet.lose(row, str(reasons))
                continue
            if None in reasons.values():
                is_single[place] = True
                continue
            materials = tuple(int(codes[name][row]) if name in codes else 0 for name in self.lookups)
            key = materials, tuple((name, str(reason)) for name, reason in reasons.items())
            if key not in texts:
                errors = {**self._missing(found, place, materials), **reasons}
                in_order = {name: errors[name] for name in self.task.quantities if name in errors}
                texts[key] = "; ".join(filter(None, [worded(in_order), found.remark]))
            sheet.status[row] = texts[key]
        sheet.is_single[rows] = is_single

    def _missing(self, found: Evaluated, place: int, materials: Sequence[int]) -> dict[str, Any]:
        """Return what quantities lack in a row, in the words of a scene that has its materials by name."""
        given = {name: element(value, place) for name, value in found.scene.stated.items()}
        spheres = [lookup.known[code] for lookup, code in zip(self.lookups.values(), materials, strict=True)]
        return Scene(given, *spheres, model=self.task.model).evaluate(found.missing)


class _Sheet:
    """The results of a block while they are computed."""

    def __init__(self, task: Task, numbers: Floats) -> None:
        """`numbers`: an array to fill: for each quantity its values, and those of the sides of its uncertainty."""
        numbers.fill(numpy.nan)
        self.task, self.numbers = task, numbers
        table = numbers.reshape(len(task.quantities), 1 + len(task.sides), numbers.shape[1])
        self.values = table[:, 0]
        self.sides = {side: table[:, place] for place, side in enumerate(task.sides, 1)}
        self.status: dict[int, str] = {}
        self.doubts: dict[int, str] = {}
        self.lost: set[int] = set()
        self.is_single = numpy.ones(numbers.shape[1], dtype=bool)  # rows that are to be evaluated by themselves

    def put(self, rows: Codes, found: Evaluated) -> None:
        """Take the results of a group."""
        self.values[:, rows] = found.values
        for side, numbers in found.sides.items():
            self.sides[side][:, rows] = numbers

    def take(self, row: int, single: Single) -> None:
        """Take the results of a row that was evaluated by itself."""
        self.numbers[:, row] = numpy.nan
        self.values[:, row] = single.values
        for name, sides in single.sides.items():
            for side, number in sides.items():
                self.sides[side][self.task.quantities.index(name), row] = number
        if single.is_lost:
            self.lost.add(row)
        for texts, text in ((self.status, single.status), (self.doubts, single.doubt)):
            texts.pop(row, None)
            if text:
                texts[row] = text

    def lose(self, row: int, status: str) -> None:
        """Note that no result of a row is to be trusted."""
        if not self.task.keeps:
            self.numbers[:, row] = numpy.nan
        self.lost.add(row)
        self.status[row] = status

    def results(self) -> Results:
        """Return the results. A row that has a status and no value at all is lost, too."""
        unclear = numpy.fromiter(self.status, dtype=int, count=len(self.status))
        lost = self.lost.union(unclear[numpy.isnan(self.values[:, unclear]).all(axis=0)].tolist())
        remarks = {DOUBT: {row: self.doubts[row] for row in self.doubts.keys() - lost}, STATUS: self.status}
        return Results(self.numbers, {name: remarks[name] for name in self.task.remarks}, lost)


def _doubts(scene: Scene, names: Sequence[str], rows: Codes) -> dict[int, str]:
    """Return the codes of the doubts of each row that has some."""
    found = doubts_of(scene, names)
    bits = numpy.zeros(len(rows), dtype=numpy.int64)
    for place, is_so in enumerate(found.values()):
        bits |= numpy.asarray(is_so, dtype=numpy.int64) << place
    doubtful = numpy.flatnonzero(bits)
    if not len(doubtful):
        return {}
    words = {
        key: " ".join(code for place, code in enumerate(found) if key >> place & 1)
        for key in numpy.unique(bits[doubtful]).tolist()
    }
    return dict(zip(rows[doubtful].tolist(), map(words.__getitem__, bits[doubtful].tolist()), strict=True))
