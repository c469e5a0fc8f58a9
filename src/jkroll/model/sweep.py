"""The rows of lists and ranges: each pair of materials with all values of its inputs, and these with each law.

Few rows are frames of numbers, many are frames of arrays: where they would take longer one by one than numpy takes to
be imported.
"""

from bisect import bisect, bisect_left
from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from functools import cached_property, partial
from itertools import accumulate, chain, product
from math import prod
from typing import Any, NamedTuple

from ..materials.library import Material
from ..quantities.nomenclature import NOMENCLATURE, computed_as, of_sphere
from ..quantities.values import Interval, Spread, Uncertain
from .frame import FOLLOWS, Frame
from .plan import in_order
from .reasons import OF_IDENTICAL_SPHERES, Failure
from .rows import BLOCK, Columns, Indices, Numbers, Wanted, evaluated, sides_in
from .unsolved import already_given

Pair = tuple[Material | None, Material | None]
_RADII = {"radius": 1.0, "radius2": 1.0, "diameter": 0.5, "diameter2": 0.5}  # inputs in radii
_MODULI_OF_TWO_KINDS = ({"shear_modulus", "youngs_modulus2"}, {"youngs_modulus", "shear_modulus2"})


class Sizes(NamedTuple):
    """The numbers of rows from which on a call works in another way."""

    most_answers: int  # that are written one by one
    most_in_table: int  # rows of a table on a terminal
    few: int  # rows that take about as long one by one as to import numpy and orjson


COMPUTED = Sizes(1_000_000, 10_000, 300)
SEARCHED = Sizes(10_000, 500, 10)  # a search takes milliseconds, and numpy


class Sweep:
    """The rows of a call."""

    def __init__(
        self,
        pairs: Sequence[Pair],
        spreads: Mapping[str, Sequence[Spread]],
        models: Sequence[str | None],
        unknowns: Sequence[str] = (),
        measured: Sequence[str] = (),
    ) -> None:
        """`spreads`: the lists and ranges of each input, by name, and of each quantity that was `measured`."""
        self.pairs, self.spreads, self.models = pairs, spreads, models
        self.unknowns, self.measured = unknowns, measured

    def seeking(self, unknowns: Sequence[str], measured: Mapping[str, Sequence[Spread]]) -> "Sweep":
        """Return the rows with measured values, by which inputs are found. Raises a BadRequest."""
        for name in measured.keys() & self.spreads.keys():
            raise already_given(name)
        return Sweep(self.pairs, {**self.spreads, **measured}, self.models, unknowns, [*measured])

    @property
    def sizes(self) -> Sizes:
        """The numbers of rows from which on the call works in another way."""
        return SEARCHED if self.unknowns else COMPUTED

    def frame(self, given: Mapping[str, Any], *spheres: Material | None, model: str | None) -> Frame:
        """Return a row of inputs, of the materials of its spheres, and of a law."""
        if not self.unknowns:
            return Frame(given, *spheres, model=model)
        from .inverse import Inverse  # which imports numpy

        others = {name: value for name, value in given.items() if name not in self.measured}
        known = Frame(others, *spheres, model=model)
        return Inverse(self.unknowns, {name: given[name] for name in self.measured}, known)

    @cached_property
    def starts(self) -> dict[str, list[int]]:
        """By input, the position of the first value of each list or range, and behind them the number of all values."""
        return {name: [*accumulate(map(len, spreads), initial=0)] for name, spreads in self.spreads.items()}

    @property
    def counts(self) -> list[int]:
        """The numbers of pairs, of the values of each input, and of laws; the rows are their combinations."""
        return [len(self.pairs), *(starts[-1] for starts in self.starts.values()), len(self.models)]

    def value(self, name: str, position: int) -> Any:
        """Return the value of an input at a position of its lists and ranges, which stand behind each other."""
        starts = self.starts[name]
        number = bisect(starts, position) - 1
        spread = self.spreads[name][number]
        return spread.uncertainty or spread.value(position - starts[number])

    def __len__(self) -> int:
        """Return the number of rows."""
        return prod(self.counts)

    def row(self, position: int) -> Frame:
        """Return a row as a frame of numbers."""
        position, law = divmod(position, len(self.models))
        given = {}
        for name in reversed([*self.spreads]):  # the last one changes first
            position, of_input = divmod(position, self.starts[name][-1])
            given[name] = self.value(name, of_input)
        return self.frame({name: given[name] for name in self.spreads}, *self.pairs[position], model=self.models[law])

    def frames(self) -> Iterator[Frame]:
        """Iterate over the rows as frames of numbers."""
        return map(self.row, range(len(self)))

    # --- What is wanted -----------------------------------------------------------------------------------------------

    @cached_property
    def groups(self) -> list[Frame]:
        """A frame for each pair of materials, each law and each mark of values: all rows of a group have one plan."""
        materials = dict.fromkeys(material for pair in self.pairs for material in pair if material is not None)
        noted = [radii for material in materials for radii in material.note_radii.values()]
        of_inputs = [_examples(name, spreads, noted) for name, spreads in self.spreads.items()]
        rows = [dict(zip(self.spreads, row, strict=True)) for row in product(*of_inputs)]
        return [self.frame(row, *pair, model=model) for pair in self.pairs for row in rows for model in self.models]

    def wanted(self, quantities: Sequence[str], named: Sequence[str], *, keeps_all: bool = False) -> Wanted:
        """Return the columns of the rows: the inputs that were stated or enter a row, and the quantities for it.

        `keeps_all`: whether numbers without a meaning stay. Raises a Failure where no quantity concerns a row.
        """
        shown = {*named, *chain.from_iterable(self.shown(frame, quantities, named) for frame in self.groups)}
        if not shown:
            raise Failure(OF_IDENTICAL_SPHERES)
        names = [name for name in quantities if name in shown]
        groups = [(frame, self.shown(frame, names, named)) for frame in self.groups]
        inputs = {name for frame, of_group in groups for name in frame.echo(frame.inputs_used(of_group))}
        inputs_shown = in_order(inputs - shown)
        return Wanted(names, named=named, inputs=inputs_shown, sides=sides_in(groups), keeps_all=keeps_all)

    def headline(self, quantities: Sequence[str], named: Collection[str], *, doubts: bool) -> Wanted:
        """Return the columns of quantities alone, with all numbers.

        Those not asked for by name may concern identical spheres only.
        """
        shown = [name for name in quantities if name in named or not NOMENCLATURE[name].of_identical]
        return Wanted(quantities, named=shown, doubts=doubts, keeps_all=True)

    def noted(self, wanted: Wanted) -> Iterable[tuple[Frame, Sequence[str]]]:
        """Return a frame of each group of rows, with the quantities that it shows."""
        return [(frame.filled, frame.judged(self.shown(frame, wanted.names, wanted.named))) for frame in self.groups]

    def shown(self, frame: Frame, quantities: Sequence[str], named: Collection[str]) -> list[str]:
        """Return those of some quantities that were asked for by name, or that concern some row of a group."""
        shows = frame.shows_to_identical if any(map(self._may_be_alike, self.spreads)) else frame.shows
        return [name for name in quantities if name in named or shows(name)]

    def _may_be_alike(self, name: str) -> bool:
        """Return whether an input of sphere 2 may have a value of sphere 1, and one of them has several."""
        if NOMENCLATURE[name].sphere != 2:
            return False
        of_first = computed_as(of_sphere(1, name))
        first = next((other for other in self.spreads if computed_as(other) == of_first), "")
        ends, ends_of_1 = self._ends(name), self._ends(first) if first else []
        several = sum(map(len, (*self.spreads[name], *self.spreads.get(first, ())))) > 2
        is_by_ratio = {name, first} in _MODULI_OF_TWO_KINDS  # E = 2G(1 + ν)
        overlap = any(
            low <= other_high and other_low <= high for low, high in ends for other_low, other_high in ends_of_1
        )
        return several and (overlap or is_by_ratio)

    def _ends(self, name: str) -> list[tuple[float, float]]:
        """Return the ends of the lists and ranges of an input, those of a diameter as radii."""
        factor = _RADII.get(name, 1.0)
        return [(factor * spread.low, factor * spread.high) for spread in self.spreads[name]]

    # --- Columns ------------------------------------------------------------------------------------------------------

    def columns(self, wanted: Wanted) -> Iterator[Columns]:
        """Iterate over the columns of the rows, block by block."""
        size = len(self)
        if size <= self.sizes.few:
            columns = Columns(wanted, size, few=True)
            for row, frame in enumerate(self.frames()):
                columns.put(row, wanted.results(frame))
            yield columns
            return
        for start in range(0, size, BLOCK):
            yield evaluated(wanted, Lists(self, start, min(start + BLOCK, size)))


def _examples(name: str, spreads: Sequence[Spread], noted: Iterable[Interval] = ()) -> list[Any]:
    """Return an example of each sort of values that an input has.

    They are a plain one, an uncertain one, one from which more follows, and one in each of the `noted` ranges of radii.
    """
    special = FOLLOWS[name][0] if name in FOLLOWS else None
    values: dict[object, Any] = {}
    for spread in spreads:
        mark = spread.uncertainty.kind if spread.uncertainty is not None else spread.low == special
        values.setdefault(mark, spread.uncertainty or spread.low)
    for radii in noted if name in _RADII else ():
        if (example := _value_in(radii.low / _RADII[name], radii.high / _RADII[name], spreads)) is not None:
            values[radii] = example
    return [*dict.fromkeys(values.values())]


def _value_in(low: float, high: float, spreads: Iterable[Spread]) -> float | Uncertain | None:
    """Return a value of lists and ranges that lies between two numbers, or None."""
    for spread in spreads:
        rising = range(len(spread))[:: 1 if spread.low <= spread.high else -1]
        above = rising[bisect_left(rising, low, key=spread.value) :]
        if above and spread.value(above[0]) <= high:
            return spread.uncertainty or spread.value(above[0])
    return None


# --- Blocks -----------------------------------------------------------------------------------------------------------


class Lists:
    """Some rows of a call, as a block: those of a pair of materials and of a law are alike."""

    def __init__(self, sweep: Sweep, start: int, stop: int) -> None:
        """`start`, `stop`: the positions of the rows in the sweep."""
        import numpy

        pairs, *positions, laws = numpy.unravel_index(numpy.arange(start, stop), sweep.counts)
        self.sweep, self.start, self.pairs, self.laws = sweep, start, pairs, laws
        self.fixed = {name: sweep.value(name, 0) for name, starts in sweep.starts.items() if starts[-1] == 1}
        of_inputs = zip(sweep.spreads, positions, strict=True)
        self.size = stop - start
        self.numbers: Mapping[str, Numbers] = {
            name: self._numbers(name, of_input) for name, of_input in of_inputs if name not in self.fixed
        }
        self.marks: Sequence[Any] = [pairs, laws]

    def frame(self, given: Mapping[str, Any], rows: Indices) -> Any:
        """Return the frame of the inputs of rows that are alike."""
        pair, model = self.sweep.pairs[self.pairs[rows[0]]], self.sweep.models[self.laws[rows[0]]]
        return self.sweep.frame({**self.fixed, **given}, *pair, model=model)

    def frame_of(self, row: int) -> Any:
        """Return the frame of a row by itself."""
        return self.sweep.row(self.start + row)

    def _numbers(self, name: str, positions: Indices) -> Numbers:
        """Return the values of an input. `positions`: those of the values in its lists and ranges."""
        import numpy

        distinct, back = numpy.unique(positions, return_inverse=True)
        values = [*map(partial(self.sweep.value, name), distinct.tolist())]
        numbers = numpy.array([value if isinstance(value, float) else value.value for value in values])
        uncertain = {
            row: values[position] for row, position in enumerate(back) if not isinstance(values[position], float)
        }
        return Numbers(numbers[back], (), uncertain)
