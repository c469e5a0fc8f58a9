"""The rows of lists and ranges: the combinations of pairs of materials, values of inputs and laws.

A few rows are computed one at a time, each as a frame of numbers. More rows become frames of arrays, since so many
single frames would take longer than importing numpy.
"""

from bisect import bisect, bisect_left
from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from functools import cached_property
from itertools import accumulate, chain, product
from math import prod
from typing import Any, NamedTuple

from ..materials.library import Material
from ..quantities.nomenclature import NOMENCLATURE, computed_as, of_sphere
from ..quantities.spreads import Spread
from ..quantities.values import Interval, Uncertain, is_uncertain, middle
from .frame import FOLLOWS, Frame
from .plan import in_order
from .reasons import OF_IDENTICAL_SPHERES, Failure
from .rows import BLOCK, Columns, Indices, Numbers, Wanted, evaluated, sides_in
from .unknowns import already_given

Pair = tuple[Material | None, Material | None]
_RADII = {"radius": 1.0, "radius2": 1.0, "diameter": 0.5, "diameter2": 0.5}  # the factors that convert them to radii
_MODULI_OF_TWO_KINDS = ({"shear_modulus", "youngs_modulus2"}, {"youngs_modulus", "shear_modulus2"})


class Sizes(NamedTuple):
    """The numbers of rows at which a call changes its way of working."""

    most_answers: int  # most rows that are written as separate answers
    most_in_table: int  # most rows of a table on a terminal
    few: int  # single rows that take about as long as importing numpy and orjson


COMPUTED = Sizes(1_000_000, 10_000, 300)
SEARCHED = Sizes(10_000, 500, 10)  # a search takes milliseconds, and needs numpy


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
        """`spreads`: the lists and ranges of each input, and of each `measured` quantity, by name."""
        self.pairs, self.spreads, self.models = pairs, spreads, models
        self.unknowns, self.measured = unknowns, measured

    def seeking(self, unknowns: Sequence[str], measured: Mapping[str, Sequence[Spread]]) -> "Sweep":
        """Return the rows of the inverse problem. Raises BadRequest if a measured quantity is also given."""
        for name in measured.keys() & self.spreads.keys():
            raise already_given(name)
        return Sweep(self.pairs, {**self.spreads, **measured}, self.models, unknowns, [*measured])

    @property
    def sizes(self) -> Sizes:
        """The numbers of rows at which the call changes its way of working."""
        return SEARCHED if self.unknowns else COMPUTED

    def frame(self, given: Mapping[str, Any], *spheres: Material | None, model: str | None) -> Frame:
        """Return the frame of inputs, the materials of the spheres, and a law; an `Inverse` if inputs are unknown."""
        if not self.unknowns:
            return Frame(given, *spheres, model=model)
        from .inverse import Inverse  # which imports numpy

        others = {name: value for name, value in given.items() if name not in self.measured}
        known = Frame(others, *spheres, model=model)
        return Inverse(self.unknowns, {name: given[name] for name in self.measured}, known)

    @cached_property
    def starts(self) -> dict[str, list[int]]:
        """By input: the index of the first value in each of its lists and ranges, and finally the number of values."""
        return {name: [*accumulate(map(len, spreads), initial=0)] for name, spreads in self.spreads.items()}

    @property
    def counts(self) -> list[int]:
        """The numbers of pairs, of values of each input, and of laws; rows are their combinations."""
        return [len(self.pairs), *(starts[-1] for starts in self.starts.values()), len(self.models)]

    def value(self, name: str, position: int) -> Any:
        """Return the value of an input by its index among the values of all its lists and ranges."""
        starts = self.starts[name]
        number = bisect(starts, position) - 1
        return self.spreads[name][number].at(position - starts[number])

    def __len__(self) -> int:
        """Return the number of rows."""
        return prod(self.counts)

    def row(self, position: int) -> Frame:
        """Return a row as a frame of numbers. The law changes fastest from row to row, then the last input."""
        rest, law = divmod(position, len(self.models))
        given = {}
        for name in reversed([*self.spreads]):
            rest, index = divmod(rest, self.starts[name][-1])
            given[name] = self.value(name, index)
        return self.frame({name: given[name] for name in self.spreads}, *self.pairs[rest], model=self.models[law])

    def frames(self) -> Iterator[Frame]:
        """Iterate over the rows as frames of numbers."""
        return map(self.row, range(len(self)))

    # --- Quantities to show -------------------------------------------------------------------------------------------

    @cached_property
    def groups(self) -> list[Frame]:
        """The frame of one row of each group.

        The rows of a group have the same materials and law, and each input has values of one kind (see `_examples`).
        """
        radii_of_notes: list[Interval] = []
        for material in dict.fromkeys(chain.from_iterable(self.pairs)):
            if material is not None:
                radii_of_notes += material.note_radii.values()
        examples = [_examples(name, spreads, radii_of_notes) for name, spreads in self.spreads.items()]
        rows = [dict(zip(self.spreads, row, strict=True)) for row in product(*examples)]
        return [self.frame(row, *pair, model=model) for pair, row, model in product(self.pairs, rows, self.models)]

    def wanted(self, quantities: Sequence[str], named: Sequence[str], *, keeps_all: bool = False) -> Wanted:
        """Return the columns of the rows: the inputs that were stated or are used in some row, and the quantities.

        `keeps_all`: True to keep numbers without a meaning. Raises a Failure if no quantity applies to any row.
        """
        groups = [(frame, self.shown(frame, quantities, named)) for frame in self.groups]
        shown = {*named, *chain.from_iterable(of_group for _, of_group in groups)}
        if not shown:
            raise Failure(OF_IDENTICAL_SPHERES)
        inputs = set()
        for frame, of_group in groups:
            inputs |= {*frame.echo(frame.inputs_used(of_group))}
        return Wanted(
            [name for name in quantities if name in shown],
            named=named,
            inputs=in_order(inputs - shown),
            sides=sides_in(groups),
            keeps_all=keeps_all,
        )

    @staticmethod
    def headline(quantities: Sequence[str], named: Collection[str], *, doubts: bool) -> Wanted:
        """Return the columns of a question's main results only, as for `--bare`; numbers without a meaning are kept.

        Where the spheres differ, quantities of identical spheres are shown only if they were asked for by name.
        """
        shown = [name for name in quantities if name in named or not NOMENCLATURE[name].of_identical]
        return Wanted(quantities, named=shown, doubts=doubts, keeps_all=True)

    def noted(self, wanted: Wanted) -> Iterable[tuple[Frame, Sequence[str]]]:
        """Return a frame of each group of rows, with the quantities that notes judge.

        These are the quantities to show; the measured quantities stand for an inferred input.
        """
        return [(frame.filled, frame.judged(self.shown(frame, wanted.names, wanted.named))) for frame in self.groups]

    def shown(self, frame: Frame, quantities: Sequence[str], named: Collection[str]) -> list[str]:
        """Return the quantities that were asked for by name, or apply to some row of the frame's group."""
        shows = frame.shows_to_identical if any(map(self._may_be_alike, self.spreads)) else frame.shows
        return [name for name in quantities if name in named or shows(name)]

    def _may_be_alike(self, name: str) -> bool:
        """Return whether an input of sphere 2 may equal that of sphere 1 in some rows, but not in others."""
        if NOMENCLATURE[name].sphere != 2:
            return False
        of_first = computed_as(of_sphere(1, name))
        first = next((other for other in self.spreads if computed_as(other) == of_first), "")
        if all(starts[-1] == 1 for other, starts in self.starts.items() if other in (name, first)):
            return False
        if {name, first} in _MODULI_OF_TWO_KINDS:  # ν decides whether they are equal
            return True
        if first:
            ends_of_1 = self._ends(first)
        else:
            values = (solid.properties.get(of_first) for solid, _ in self.pairs if solid is not None)
            ends_of_1 = [(value, value) for value in values if value is not None]
        for (least, most), (least_of_1, most_of_1) in product(self._ends(name), ends_of_1):
            if least <= most_of_1 and least_of_1 <= most:
                return True
        return False

    def _ends(self, name: str) -> list[tuple[float, float]]:
        """Return the least and the largest value of each list and range of an input; a diameter counts as a radius."""
        factor = _RADII.get(name, 1.0)
        ends = []
        for spread in self.spreads[name]:
            least, most = sorted((spread.low, spread.high))
            ends.append((factor * least, factor * most))
        return ends

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
            yield evaluated(wanted, BlockOfSweep(self, start, min(start + BLOCK, size)))


def _examples(name: str, spreads: Sequence[Spread], radii_of_notes: Iterable[Interval] = ()) -> list[Any]:
    """Return an example of each kind of value that an input has.

    The kinds are: a number, each kind of uncertainty, a special value (see `FOLLOWS`) at an end of a range, and a
    radius in each of the ranges to which notes of the materials apply.
    """
    special = FOLLOWS[name][0] if name in FOLLOWS else None
    examples: dict[object, Any] = {}  # by kind
    for spread in spreads:
        if spread.uncertain is not None:
            examples.setdefault(spread.uncertain.kind, spread.uncertain)
        else:
            for end in (spread.low, spread.high):
                examples.setdefault("special" if end == special else "number", end)
    if name in _RADII:
        for radii in radii_of_notes:
            example = _value_in(radii.low / _RADII[name], radii.high / _RADII[name], spreads)
            if example is not None:
                examples[radii] = example
    return [*dict.fromkeys(examples.values())]


def _value_in(low: float, high: float, spreads: Iterable[Spread]) -> float | Uncertain | None:
    """Return the least value from `low` up to `high` in the first list or range that has one; else None."""
    for spread in spreads:
        positions = range(len(spread))
        rising = positions if spread.low <= spread.high else positions[::-1]
        from_low = rising[bisect_left(rising, low, key=spread.value) :]
        if from_low and spread.value(from_low[0]) <= high:
            return spread.at(from_low[0])
    return None


# --- Blocks -----------------------------------------------------------------------------------------------------------


class BlockOfSweep:
    """A block of rows of a sweep; rows with the same materials and law have the same marks."""

    def __init__(self, sweep: Sweep, start: int, stop: int) -> None:
        """`start`, `stop`: the rows of the sweep, as in `range`."""
        import numpy

        pairs, *positions, laws = numpy.unravel_index(numpy.arange(start, stop), sweep.counts)
        self.sweep, self.start, self.size = sweep, start, stop - start
        self.pairs, self.laws = pairs, laws  # indices, for each row
        self.fixed: dict[str, Any] = {}  # inputs with a single value
        numbers = {}
        for name, of_rows in zip(sweep.spreads, positions, strict=True):
            if sweep.starts[name][-1] == 1:
                self.fixed[name] = sweep.value(name, 0)
            else:
                numbers[name] = self._numbers(name, of_rows)
        self.numbers: Mapping[str, Numbers] = numbers
        self.marks: Sequence[Any] = [pairs, laws]

    def frame(self, given: Mapping[str, Any], rows: Indices) -> Any:
        """Return the frame of some rows of a group. `given`: their inputs, without those in `fixed`."""
        pair, model = self.sweep.pairs[self.pairs[rows[0]]], self.sweep.models[self.laws[rows[0]]]
        return self.sweep.frame({**self.fixed, **given}, *pair, model=model)

    def frame_of(self, row: int) -> Any:
        """Return the frame of a single row."""
        return self.sweep.row(self.start + row)

    def _numbers(self, name: str, positions: Indices) -> Numbers:
        """Return the values of an input. `positions`: their indices in its lists and ranges."""
        import numpy

        distinct, index_of = numpy.unique(positions, return_inverse=True)
        values = [self.sweep.value(name, position) for position in distinct.tolist()]
        numbers = numpy.array([*map(middle, values)])
        uncertain = {row: values[index] for row, index in enumerate(index_of) if is_uncertain(values[index])}
        return Numbers(numbers[index_of], uncertain=uncertain)
