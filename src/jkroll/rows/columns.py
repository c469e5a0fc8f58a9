"""The columns of rows: values, uncertainties, doubts as bits, and the reasons of cells that are empty.

`Wanted.row` is the definition of a row. `Wanted.columns` gives the same for many rows at once: where an array leaves
a gap that floats do not leave, or an uncertainty needs a search, the row is computed again by floats.
"""

from collections import Counter
from collections.abc import Callable, Collection, Iterable, Iterator, Mapping, Sequence
from contextlib import suppress
from functools import cached_property
from math import isnan, nan
from typing import TYPE_CHECKING, Any

from ..errors import BadRequest, JkrollError
from ..physics.elementary import where
from ..quantities.values import is_uncertain, middle
from ..scene.alternatives import DATA, beside, by_law, names_beside
from ..scene.failures import OF_IDENTICAL_SPHERES, Failure
from ..scene.limits import EVERY_DOUBT, NOT_JUDGED, OF_LAW, bits_of, doubts, touched
from ..scene.scene import Scene
from ..text import listed
from .reasons import ROW, UNCERTAINTY, Reasons, lack, status_of

if TYPE_CHECKING:
    from ..scene.uncertainty import Sources

BLOCK = 6 << 10  # rows computed together as arrays: many for the calls of numpy, few for the cache and the memory
SIDES = ("minus", "plus", "low", "high")  # of uncertainties: the two of a standard one, and the ends of a range
_BESIDE = 15  # cost of the rest of a row, in formulas
_JUDGED = 8  # a row whose limits are judged takes 8 times as long: Maugis' law is evaluated, too
DOUBT = "doubt"  # the column of the limits of the model that a row exceeds, as codes
STATUS = "status"  # the column of reasons
_NO_ALTERNATIVES: Mapping[str, Sequence[str]] = {}  # which can be pickled
_BY = "_by_"  # between a quantity and the kind of what may stand in its place, in a key


class Wanted:
    """The columns of rows, known from the plan and the names before anything is computed."""

    def __init__(
        self,
        names: Sequence[str],
        named: Collection[str] = (),  # those that were asked for by name, and concern any row
        inputs: Sequence[str] = (),  # that stand before them
        # By the key of a value, those of SIDES that have columns; None where uncertainties are not wanted.
        sides: Mapping[str, Collection[str]] | None = None,
        doubts: bool = True,  # whether limits are judged
        # By kind, the name of a law or DATA, the quantities that have columns of what may stand in their place.
        alternatives: Mapping[str, Sequence[str]] = _NO_ALTERNATIVES,
    ) -> None:
        self.names, self.named, self.inputs, self.sides = names, named, inputs, sides
        self.doubts, self.alternatives = doubts, alternatives

    def with_sides(self, sides: Mapping[str, Collection[str]] | None) -> "Wanted":
        """Return the same columns with those of other uncertainties."""
        return type(self)(self.names, self.named, self.inputs, sides, self.doubts, self.alternatives)

    @cached_property
    def keys(self) -> tuple[str, ...]:
        """The keys of all columns of numbers."""
        return tuple(key for name in self.names for key in self.keys_of(name))

    @cached_property
    def places(self) -> dict[str, int]:
        """The places of the columns of numbers, by key."""
        return {key: place for place, key in enumerate(self.keys)}

    def keys_of(self, name: str) -> list[str]:
        """Return the keys of the columns of a quantity and of what may stand in its place, with their uncertainties."""
        values = (name, *self.beside(name).values())
        return [each for key in values for each in (key, *self.sides_of(key).values())]

    def sides_of(self, key: str) -> dict[str, str]:
        """Return the keys of the columns of the uncertainty of a column, by the side: "radius_minus"."""
        sides = ("low", "high") if key.endswith(f"{_BY}{DATA}") else (self.sides or {}).get(key, ())
        return {side: f"{key}_{side}" for side in SIDES if side in sides}

    def beside(self, name: str) -> dict[str, str]:
        """Return the keys of the columns of what may stand in place of a quantity: "pull_off_force_by_maugis"."""
        return {kind: f"{name}{_BY}{kind}" for kind, names in self.alternatives.items() if name in names}

    def heads(self, header: Callable[[str], str]) -> list[str]:
        """Return the headers of all columns, such as "radius_minus [nm]"; `header` gives that of a quantity."""
        return [header(name).replace(name, key, 1) for name in self.names for key in self.keys_of(name)]

    def with_alternatives(self, scenes: Sequence[Scene], names: Collection[str]) -> "Wanted":
        """Return the same quantities, some of them with columns of what may stand in their place.

        `scenes`: of each kind of rows.
        """
        names_of = names_beside(scenes, [name for name in self.names if name in names])
        sides = None if self.sides is None else {**self.sides}
        for scene in scenes:
            if sides is not None and scene.is_uncertain:
                from ..scene.uncertainty import sides_of_results

                other = by_law(scene)
                with suppress(JkrollError):  # sources of two kinds give no error bars
                    for name, of_name in sides_of_results(other, names_of.get(other.law.name, [])).items():
                        key = f"{name}{_BY}{other.law.name}"
                        sides[key] = {*sides.get(key, ()), *of_name}
        return type(self)(self.names, self.named, self.inputs, sides, self.doubts, names_of)

    def numbers_beside(self, scene: Scene, shown: Collection[str]) -> dict[str, Any]:
        """Return what may stand in place of the quantities shown, with their uncertainties, by their keys."""
        names_of = {kind: [name for name in names if name in shown] for kind, names in self.alternatives.items()}
        return {
            f"{name}{_BY}{kind}": value
            for kind, values in beside(scene, names_of).items()
            for name, value in values.items()
            if value is not None
        }

    def sources_in(self, scene: Any, names: Collection[str] | None = None) -> "Sources | None":
        """Return the sources of uncertainty of quantities of a scene; None if it has none, or none is wanted.

        `names`: of the quantities, by default of all. Raises a JkrollError for sources that do not go together.
        """
        if self.sides is None or not scene.is_uncertain:
            return None
        from ..scene.uncertainty import sources_of_results

        return sources_of_results(scene, [*(self.names if names is None else names)])

    def bars(
        self, scene: Any, names: Collection[str], sources: "Sources | None"
    ) -> tuple[dict[str, Any], BadRequest | None]:
        """Return the uncertainties of values by their keys, or the remark that the table has no columns for them."""
        if sources is None:
            return {}, None
        from ..scene.uncertainty import measures_of, uncertainties

        if sources.sides <= {side for name in self.names for side in self.sides_of(name)}:
            return measures_of(uncertainties(scene, [*names], sources=sources)[0]), None
        problem = "error bars are left out, for which the table has no columns; --uncertainty adds them"
        return {}, BadRequest(f"{listed(sources.given)}: {problem}", "error bars left out")

    def work(self, scene: Any) -> int:
        """Return the cost of a row that is computed by itself, counted in formulas."""
        return (_BESIDE + len(scene.formulas_to(*scene.possible(self.names)))) * (_JUDGED if self.doubts else 1)

    # --- Rows ---------------------------------------------------------------------------------------------------------

    def row(self, scene: Any) -> "Row":
        """Return the row of a scene of numbers. Raises a JkrollError for uncertainties that do not go together."""
        outcomes = scene.outcomes(self.names, self.named)
        values = [name for name, value in outcomes.items() if not isinstance(value, JkrollError)]
        inputs = scene.echo(scene.inputs_used(self.names, self.names)) if self.inputs else {}
        bits = bits_of(doubts(scene, values)) if self.doubts and values else 0
        sources, others = self.sources_in(scene, outcomes), self.numbers_beside(scene, outcomes)
        return self.row_of(scene, outcomes | others, inputs, sources, bits)

    def row_of(
        self, scene: Any, outcomes: Mapping[str, Any], inputs: dict[str, Any], sources: "Sources | None", bits: int
    ) -> "Row":
        """Return the row of outcomes, by key."""
        reasons = reasons_of(outcomes)
        values = {key: value for key, value in outcomes.items() if key not in reasons}
        numbers = {key: middle(value) for key, value in values.items()}
        bars, remark = self.bars(scene, [name for name in self.names if name in outcomes], sources)
        if remark is not None:
            reasons[UNCERTAINTY] = remark
        for key, value in (values | bars).items():
            for side, of_side in self.sides_of(key).items():
                if isinstance(value, JkrollError):
                    reasons[of_side] = value
                elif is_uncertain(value) and side in value.sides:
                    numbers[of_side] = value.sides[side]
        if sources is not None:
            inputs |= {name: given for name, given in sources.given.items() if name in inputs}
        return Row(inputs, [numbers.get(key, nan) for key in self.keys], bits, reasons)

    def columns(self, scene: Any, rows: Sequence[int], scene_of: Callable[[int], Any]) -> tuple["Columns", Any]:
        """Return the columns of a scene of arrays, and the rows that floats are to compute, as an array of booleans.

        `scene_of` returns one of the rows as a scene of numbers. Raises a JkrollError where floats are to compute all.
        """
        outcomes = scene.outcomes(self.names, self.named)
        is_shown = {name: name in self.named or scene.shows(name) for name in outcomes}
        measures = self.numbers_beside(scene, outcomes)
        columns = Columns.empty(self, len(rows))
        values = {name: value for name, value in outcomes.items() if not isinstance(value, JkrollError)}
        for key, value in (values | measures).items():
            columns.column(key)[...] = where(is_shown[key.partition(_BY)[0]], middle(value), nan)
        if self.inputs:
            columns.repeat(scene.echo(scene.inputs_used(self.names, self.names)))
        if self.doubts and values:
            columns.doubts[...] = _doubts(scene, columns, [*values])
        again = _explain(columns, scene, is_shown, lambda row: scene_of(rows[row]))
        bars, remark = self.bars(scene, values, self.sources_in(scene, outcomes))
        if remark is not None:
            columns.add_remark(remark)
        return columns, again | columns.put_sides(measures | bars)


class Row:
    """A row of columns: its inputs, its numbers as `Wanted.keys` has them, its doubts as bits, why cells are empty.

    The inputs are SI values, with their uncertainties, names of materials and the law; a number that is nan is a gap.
    """

    def __init__(self, inputs: Mapping[str, Any], numbers: Sequence[float], doubts: int, reasons: Reasons) -> None:
        self.inputs, self.numbers, self.doubts, self.reasons = inputs, numbers, doubts, reasons


def remarks_of(wanted: Wanted, *, doubt: bool = True) -> tuple[str, ...]:
    """Return the columns of remarks, which stand last. `doubt`: whether doubts have one, if they are judged."""
    return (DOUBT, STATUS) if doubt and wanted.doubts else (STATUS,)


def reasons_of(outcomes: Mapping[str, Any]) -> dict[str, JkrollError]:
    """Return why cells of a row are empty, of which some outcomes are known."""
    if not outcomes:
        return {ROW: Failure(OF_IDENTICAL_SPHERES)}
    return {name: outcome for name, outcome in outcomes.items() if isinstance(outcome, JkrollError)}


class Columns:
    """The columns of some rows: arrays where there are many rows, else lists. Writers index them and iterate."""

    def __init__(self, wanted: Wanted, inputs: Mapping[str, Any], numbers: Any, doubts: Any) -> None:
        """`inputs`: columns by name; `numbers`: a column for each of Wanted.keys."""
        self.wanted, self.inputs, self.numbers, self.doubts = wanted, dict(inputs), numbers, doubts
        self.reasons: dict[int, Reasons] = {}  # why rows have empty cells, by their places

    @classmethod
    def of_rows(cls, wanted: Wanted, rows: Sequence[Row]) -> "Columns":
        """Return the columns of rows that were computed one by one."""
        columns = cls(
            wanted,
            {name: [row.inputs.get(name) for row in rows] for name in wanted.inputs},
            [[row.numbers[place] for row in rows] for place in range(len(wanted.keys))],
            [row.doubts for row in rows],
        )
        columns.reasons = {place: row.reasons for place, row in enumerate(rows) if row.reasons}
        return columns

    @classmethod
    def empty(cls, wanted: Wanted, size: int) -> "Columns":
        """Return columns of arrays without a value."""
        import numpy

        inputs: dict[str, Any] = {name: [None] * size for name in wanted.inputs}
        numbers = numpy.full((len(wanted.keys), size), nan)
        return cls(wanted, inputs, numbers, numpy.zeros(size, dtype=numpy.int64))

    def __len__(self) -> int:
        """Return the number of rows."""
        return len(self.doubts)

    @property
    def told(self) -> int:
        """The doubts that are told of rows: not those of a law where columns of the other one say how far it is off."""
        return EVERY_DOUBT ^ NOT_JUDGED ^ (OF_LAW if self.wanted.alternatives else 0)

    def column(self, key: str) -> Any:
        """Return the numbers of a column."""
        return self.numbers[self.wanted.places[key]]

    def repeat(self, inputs: Mapping[str, Any]) -> None:
        """Take inputs that are the same in all rows, or arrays, without their uncertainties."""
        import numpy

        for name in self.inputs.keys() & inputs.keys():
            if not isinstance(inputs[name], str):
                self.inputs[name] = numpy.full(len(self), middle(inputs[name]), dtype=float)
            else:
                self.inputs[name] = [inputs[name]] * len(self)

    def put(self, rows: Sequence[int], columns: "Columns") -> None:
        """Take the columns of some rows in place of what was known of them."""
        self.numbers[:, rows] = columns.numbers
        self.doubts[rows] = columns.doubts
        for name, column in self.inputs.items():
            for place, value in zip(rows, as_list(columns.inputs[name]), strict=True):
                column[place] = middle(value)
        for place in rows:
            self.reasons.pop(place, None)
        self.reasons.update((rows[row], reasons) for row, reasons in columns.reasons.items())

    def put_sides(self, measures: Mapping[str, Any]) -> Any:
        """Take the sides of values of arrays that have some, by the keys of columns; return the rows with open ones."""
        import numpy

        again = numpy.zeros(len(self), dtype=bool)
        for key, value in measures.items():
            is_known = ~numpy.isnan(self.column(key))
            if isinstance(value, JkrollError):
                again |= is_known
            elif is_uncertain(value):
                width = value.high - value.low
                for side, of_side in self.wanted.sides_of(key).items():
                    if side in value.sides:
                        self.column(of_side)[...] = where(is_known & (width > 0), value.sides[side], nan)
                again |= is_known & numpy.isnan(width)
        return again

    def add_remark(self, remark: JkrollError) -> None:
        """Note a remark on all rows."""
        self.reasons = {row: {**self.reasons.get(row, {}), UNCERTAINTY: remark} for row in range(len(self))}

    @property
    def status(self) -> dict[int, str]:
        """The phrases of rows that have empty cells, by their places."""
        distinct = {id(reasons): reasons for reasons in self.reasons.values()}
        phrases = {number: status_of(reasons) for number, reasons in distinct.items()}
        return {row: phrases[id(reasons)] for row, reasons in self.reasons.items()}

    @property
    def counted_doubts(self) -> Counter[int]:
        """The numbers of rows, by the bits of their doubts."""
        if isinstance(self.doubts, list):
            return Counter(self.doubts)
        distinct, _, counts = self.distinct_doubts
        return Counter(dict(zip(distinct.tolist(), counts.tolist(), strict=True)))

    @cached_property
    def distinct_doubts(self) -> tuple[Any, Any, Any]:
        """The bits of doubts that differ, the place of each row's among them, and the number of rows of each."""
        import numpy

        return numpy.unique(self.doubts, return_inverse=True, return_counts=True)

    @cached_property
    def failed(self) -> list[int]:
        """The rows without a contact, or without any value but alternatives."""
        lacks = {id(reasons): lack(reasons) is not None for reasons in self.reasons.values()}
        return [
            row
            for row, reasons in self.reasons.items()
            if lacks[id(reasons)] or all(isnan(self.column(name)[row]) for name in self.wanted.names)
        ]

    def failure(self, row: int) -> JkrollError:
        """Return why a row fails: the lack of a contact, or else its first reason."""
        return lack(self.reasons[row]) or next(iter(self.reasons[row].values()))


def as_list(column: Any) -> list[Any]:
    """Return the values of a column, an array or a list, as a list."""
    return column if isinstance(column, list) else column.tolist()


# --- By arrays --------------------------------------------------------------------------------------------------------


def _doubts(scene: Scene, columns: Columns, names: Sequence[str]) -> Any:
    """Return the doubts of each row, of those of some quantities that have a value there."""
    import numpy

    every = doubts(scene, names)
    is_empty = {name: numpy.isnan(columns.column(name)) for name in names}
    if not any(map(numpy.any, is_empty.values())):
        return bits_of(every)
    bits = numpy.zeros_like(columns.doubts)
    for name in names:
        limits = touched(scene, [name])
        bits |= numpy.where(is_empty[name], 0, bits_of(doubt for doubt in every if doubt.limit in limits))
    return bits


def _explain(columns: Columns, scene: Scene, is_shown: Mapping[str, Any], scene_of: Callable[[int], Scene]) -> Any:
    """Note why cells are empty. Return the rows that floats are to compute, as they do not confirm an empty cell.

    Rows that lack the same results, from the same step on, have the reasons of the first of them. `is_shown`: the
    quantities, and in which rows they are.
    """
    import numpy

    again = numpy.zeros(len(columns), dtype=bool)
    gaps = {name: numpy.isnan(columns.column(name)) & shown for name, shown in is_shown.items()}
    is_lacking = numpy.any([again, *gaps.values()], axis=0)
    if not any(shown is True for shown in is_shown.values()):  # some rows may show nothing
        is_lacking |= ~numpy.any([again, *is_shown.values()], axis=0)
    rows = numpy.flatnonzero(is_lacking)
    if not len(rows):
        return again
    steps = [value for value in scene.values.values() if isinstance(value, numpy.ndarray)]
    is_nan = [numpy.broadcast_to(numpy.isnan(value), len(columns)) for value in steps]
    for places in alike(rows, [*gaps.values(), *is_nan]):
        first = int(places[0])
        lacking = {name for name, is_gap in gaps.items() if is_gap[first]}
        reasons = reasons_of(scene_of(first).outcomes(columns.wanted.names, columns.wanted.named))
        if reasons.keys() - {ROW} == lacking and reasons:
            columns.reasons.update(dict.fromkeys(places.tolist(), reasons))
        else:
            again[places] = True
    return again


def alike(rows: Any, columns: Iterable[Any]) -> Iterator[Any]:
    """Divide rows into groups that have the same whole number in each column, and iterate over these.

    `rows`: the places of the rows.
    """
    import numpy

    keys = numpy.zeros(len(rows), dtype=numpy.int64)
    for column in columns:
        numbers = column[rows]
        if len(numbers) and (numbers != numbers[0]).any():
            keys = numpy.unique(keys * (numbers.max() + 1) + numbers, return_inverse=True)[1]
    for key in range(int(keys.max(initial=-1)) + 1):
        yield rows[keys == key]
