"""The evaluation of a block of rows: rows with the same known inputs at once, and an odd row as a scene of its own.

The two ways run the same formulas. Only the second one finds the words for a failure.
"""

from collections.abc import Iterable, Mapping, Sequence
from functools import partial
from typing import Any

import numpy

from ..errors import JkrollError
from ..materials.library import Material
from ..quantities.nomenclature import INFINITY
from ..scene.errors import BeyondPullOff, MissingInput, NoChain
from ..scene.inputs import outside
from ..scene.results import MAY_BE_ZERO, SMALLEST
from ..scene.scene import Scene
from .blocks import Block, Results
from .cells import Floats, Mask, Numbers
from .columns import DOUBT, STATUS
from .materials import UNKNOWN, Codes, Lookup
from .single import Task, alone, concerns, doubts_of, lacking, worded


class Evaluator:
    """Computes one block after another."""

    def __init__(self, task: Task) -> None:
        """`task`: the quantities to compute."""
        self.task = task
        self.lookups = {
            "material": Lookup(task.known, task.material),
            "material2": Lookup(task.known, task.material2),
        }
        self._reasons: dict[tuple[object, ...], str] = {}
        self._lost: set[int] = set()

    def results(self, block: Block, into: Floats | None = None) -> Results:
        """Return the results of a block; `into`: an array for the numbers."""
        numbers = numpy.empty((len(self.task.quantities), block.size)) if into is None else into
        status: dict[int, str] = dict(block.odd)
        doubts: dict[int, str] = {}
        self._lost = set()
        codes = {
            name: cells if isinstance(cells, numpy.ndarray) else self.lookups[name].codes(cells)
            for name, cells in block.materials.items()
        }
        with numpy.errstate(all="ignore"):
            singly = self._in_groups(block, codes, numbers, status, doubts)
        for row in sorted(singly.difference(block.odd)):
            single = alone(self.task, partial(block.text, row))
            numbers[:, row] = single.values
            if single.is_lost:
                self._lost.add(row)
            for texts, text in ((status, single.status), (doubts, single.doubt)):
                texts.pop(row, None)
                if text:
                    texts[row] = text
        unclear = numpy.fromiter(status, dtype=int, count=len(status))
        lost = unclear[numpy.isnan(numbers[:, unclear]).all(axis=0)]
        all_lost = self._lost.union(lost.tolist())
        remarks = {DOUBT: {row: doubts[row] for row in doubts.keys() - all_lost}, STATUS: status}
        return Results(numbers, {name: remarks[name] for name in self.task.remarks}, all_lost)

    def _in_groups(
        self,
        block: Block,
        codes: Mapping[str, Codes],
        numbers: Floats,
        status: dict[int, str],
        doubts: dict[int, str],
    ) -> set[int]:
        """Evaluate groups of rows with the same known inputs; return the rows that are to be evaluated singly."""
        singly = {*block.odd, *(row for column in block.numbers.values() for row in column.odd)}
        singly |= {int(row) for one in codes.values() for row in numpy.flatnonzero(one == UNKNOWN)}
        for name, column in block.numbers.items():
            singly |= set(_outside(name, column))
        everything = numpy.arange(block.size)
        rest = numpy.delete(everything, sorted(singly)) if singly else everything
        keys = numpy.zeros(block.size, dtype=numpy.int64)
        for place, column in enumerate(block.numbers.values()):
            if column.given is not None:
                keys |= (~column.given).astype(numpy.int64) << place
        for place, (name, one) in enumerate(codes.items()):
            keys |= self.lookups[name].kinds(one) << (40 + 8 * place)
        if len(rest) == block.size and (keys == keys[0]).all():
            groups: Iterable[Any] = [slice(None)]
        else:
            groups = [rest[keys[rest] == key] for key in numpy.unique(keys[rest])]
            numbers.fill(numpy.nan)
        for rows in groups:
            singly.update(everything[rows][self._group(block, codes, rows, numbers, status, doubts)].tolist())
        return singly

    def _group(
        self,
        block: Block,
        codes: Mapping[str, Codes],
        rows: Any,
        numbers: Floats,
        status: dict[int, str],
        doubts: dict[int, str],
    ) -> Mask:
        """Evaluate rows with the same known inputs; return which of them have no plausible result."""
        members = numpy.arange(block.size)[rows]
        first = int(members[0])
        given: dict[str, Any] = {
            name: column.values[rows]
            for name, column in block.numbers.items()
            if column.given is None or column.given[first]
        }
        given = {**{name: value for name, value in self.task.fixed.items() if name not in given}, **given}
        spheres = [self._sphere(name, codes, rows) for name in ("material", "material2")]
        try:
            scene = Scene(given, *spheres, model=self.task.model)
        except JkrollError:
            return numpy.ones(len(members), dtype=bool)
        wanted = [name for name in self.task.quantities if concerns(name, scene)]
        outcomes = scene.evaluate(wanted)
        missing = [name for name, outcome in outcomes.items() if isinstance(outcome, MissingInput)]
        values = {
            name: numpy.nan if isinstance(outcome, JkrollError) else outcome
            for name, outcome in outcomes.items()
            if not isinstance(outcome, MissingInput)
        }
        if self.task.doubt:
            doubts |= _doubts(scene, [*values], members)
        is_all = isinstance(rows, slice)
        results = numbers if is_all else numpy.empty((len(self.task.quantities), len(members)))
        for place, name in enumerate(self.task.quantities):
            results[place] = values.get(name, numpy.nan)
        is_odd = None if _is_plausible(results) else ~_plausible(results, self.task.quantities)
        if is_odd is not None:
            is_odd[[place for place, name in enumerate(self.task.quantities) if name not in values]] = False
        if "rolling_frequency_as_printed" in values:
            results[self.task.quantities.index("rolling_frequency_as_printed"), ~_identical(scene, len(members))] = (
                numpy.nan
            )
        self._explain(scene, results, is_odd, missing, members, codes, status)
        if not is_all:
            numbers[:, rows] = results
        odd_rows: Any = numpy.zeros(len(members), dtype=bool) if is_odd is None else is_odd.any(axis=0)
        if missing and "load" in given:
            odd_rows |= given["load"] == 0  # without a load less is needed
        is_single: Mask = odd_rows
        return is_single

    def _explain(
        self,
        scene: Scene,
        results: Floats,
        is_odd: Mask | None,
        missing: Sequence[str],
        members: Codes,
        codes: Mapping[str, Codes],
        status: dict[int, str],
    ) -> None:
        """Word the failures that can be told from the arrays; their rows are then not odd."""
        failing: dict[int, Sequence[str]] = dict.fromkeys(range(len(members)), missing) if missing else {}
        if is_odd is None:
            is_odd = numpy.zeros((1, 0), dtype=bool)
        elif "r_min" in self.task.quantities and isinstance(scene.values.get("radius2"), numpy.ndarray):
            place = self.task.quantities.index("r_min")
            for plane in numpy.flatnonzero((scene.values["radius2"] == INFINITY) & is_odd[place]).tolist():
                results[place, plane] = numpy.nan
                is_odd[place, plane] = False
                failing[plane] = [*missing, "r_min"]
        for row, names in failing.items():
            status[int(members[row])] = self._words(codes, int(members[row]), row, names, scene)
        for row in _beyond_pull_off(scene):
            if not self.task.keeps:
                results[:, row] = numpy.nan
            is_odd[:, row] = False
            self._lost.add(int(members[row]))
            load, pull_off = scene.values["load"], scene.values["pull_off_force"]
            status[int(members[row])] = str(BeyondPullOff(_at(load, row), _at(pull_off, row)))

    def _sphere(self, name: str, codes: Mapping[str, Codes], rows: Any) -> Material | None:
        """Return the materials of some rows as one, whose properties are arrays."""
        if name not in codes:
            return self.task.material if name == "material" else self.task.material2
        own = codes[name][rows]
        if self.lookups[name].known[int(own[0])] is None:
            return None
        properties: Any = self.lookups[name].properties(own)
        return Material("", properties, (), {}, (), (), "", "")

    def _words(self, codes: Mapping[str, Codes], row: int, place: int, names: Sequence[str], scene: Scene) -> str:
        """Return why a row has no value for some quantities: the same words for all rows of the same materials and kind."""
        spheres = [self._material(name, int(codes[name][row]) if name in codes else 0) for name in self.lookups]
        is_plane = _at(scene.values.get("radius2", 0.0), place) == INFINITY
        key = (*(one and one.name for one in spheres), is_plane, frozenset(scene.stated), *names)
        if key not in self._reasons:
            single = Scene(
                {name: _one(name, value, place) for name, value in scene.stated.items()},
                *spheres,
                model=self.task.model,
            )
            in_order = [name for name in self.task.quantities if name in names]
            self._reasons[key] = worded({name: lacking(name, single) or NoChain() for name in in_order})
        return self._reasons[key]

    def _material(self, name: str, code: int) -> Material | None:
        return self.lookups[name].known[code]


def _is_plausible(results: Floats) -> bool:
    """Return whether all results are numbers that doubles hold with all digits, and not 0: a quick test of the usual case."""
    for column in results:
        low, high = column.min(), column.max()
        if low < 0:
            size = numpy.abs(column)
            low, high = size.min(), size.max()
        if not (low >= SMALLEST and high < INFINITY):
            return False
    return True


def _plausible(results: Floats, names: Sequence[str]) -> Mask:
    """Return which results are numbers that doubles hold with all digits, or a zero that the quantity may be."""
    size = numpy.abs(results)
    fine: Mask = (size >= SMALLEST) & (size < INFINITY)
    places = [place for place, name in enumerate(names) if name in MAY_BE_ZERO]
    fine[places] |= size[places] == 0
    return fine


def _doubts(scene: Scene, names: Sequence[str], members: Codes) -> dict[int, str]:
    """Return the codes of the doubts of each row that has some."""
    found = doubts_of(scene, names)
    bits = numpy.zeros(len(members), dtype=numpy.int64)
    for place, is_so in enumerate(found.values()):
        bits |= numpy.asarray(is_so, dtype=numpy.int64) << place
    doubtful = numpy.flatnonzero(bits)
    if not len(doubtful):
        return {}
    words = {
        key: " ".join(code for place, code in enumerate(found) if key >> place & 1)
        for key in numpy.unique(bits[doubtful]).tolist()
    }
    return dict(zip(members[doubtful].tolist(), map(words.__getitem__, bits[doubtful].tolist()), strict=True))


def _identical(scene: Scene, size: int) -> Mask:
    """Return the rows in which no input makes sphere 2 differ from sphere 1."""
    same = numpy.ones(size, dtype=bool)
    for name, value in scene.given.items():
        if name.endswith("2"):
            same &= value == scene.given.get(name.removesuffix("2"), numpy.nan)
    if scene.material2 is not None and scene.material is not None:
        same &= scene.material2.properties.keys() >= scene.material.properties.keys()
    return same


def _outside(name: str, column: Numbers) -> list[int]:
    """Return the rows whose number is out of the range of the quantity."""
    refused = outside(name, column.values)
    if not refused.any():
        return []
    rows: list[int] = numpy.flatnonzero(refused if column.given is None else refused & column.given).tolist()
    return rows


def _beyond_pull_off(scene: Scene) -> list[int]:
    """Return the rows under a tension beyond pull-off."""
    if "load_margin" not in scene.values or not {"load", "pull_off_force"} <= scene.values.keys():
        return []
    beyond = numpy.atleast_1d(scene.values["load"] < -scene.values["pull_off_force"])
    rows: list[int] = numpy.flatnonzero(beyond).tolist()
    return rows


def _at(value: Any, place: int) -> float:
    return float(value[place]) if isinstance(value, numpy.ndarray) else float(value)


def _one(name: str, value: Any, place: int) -> Any:
    """Return the value of a row; for a load one that is not zero, because without a load less is needed."""
    if not isinstance(value, numpy.ndarray):
        return value
    return 1.0 if name == "load" else float(value[place])
