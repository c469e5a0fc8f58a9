"""The columns of rows: values, uncertainties, doubts as bits, and the reasons of cells that are empty.

`Wanted.row` is the definition of a row. `Wanted.columns` gives the same for many rows at once: where an array leaves
a gap that floats do not leave, or an uncertainty needs a search, the row is computed again by floats.
"""

from collections import Counter
from collections.abc import Callable, Collection, Iterable, Iterator, Mapping, Sequence
from contextlib import suppress
from functools import cached_property
from math import isnan, nan
from types import MappingProxyType
from typing import TYPE_CHECKING, Any, NamedTuple

from ..errors import BadRequest, JkrollError
from ..physics.elementary import where
from ..quantities.values import is_uncertain, middle
from ..scene.alternatives import DATA, beside, by_law, names_beside
from ..scene.failures import (
    OF_IDENTICAL_SPHERES,
    Failure,
)
from ..scene.limits import bits_of, doubts, possible_bits
from ..scene.scene import Scene
from ..text import listed
from .reasons import ROW, UNCERTAINTY, Reasons, lack, status_of

if TYPE_CHECKING:
    from ..scene.uncertainty import Sources

BLOCK = 5 << 10  # rows computed together as arrays: many for the calls of numpy, few for the cache and the memory
SIDES = ("minus", "plus", "low", "high")  # of uncertainties: the two of a standard one, and the ends of a range
_BESIDE = 15  # cost of the rest of a row, in formulas
_JUDGED = 8  # a row whose limits are judged takes 8 times as long: Maugis' law is evaluated, too
DOUBT = "doubt"  # the column of the limits of the model that a row exceeds, as codes
STATUS = "status"  # the column of reasons
_NO_COLUMNS = "for which the table has no columns; --uncertainty adds them"


class Wanted:
    """The quantities of rows, known from the plan and the names before anything is computed."""

    def __init__(
        self,
        names: Iterable[str],
        *,
        named: Iterable[str] = (),
        inputs: Iterable[str] = (),
        sides: Mapping[str, Collection[str]] | None = None,
        doubts: bool = True,
        alternatives: Mapping[str, Sequence[str]] = MappingProxyType({}),
    ) -> None:
        """`named`: quantities that were asked for by name, and concern any row; `inputs`: that stand before them.

        `sides`: of the uncertainties of quantities, and of what may stand in their place, those of SIDES that have
        columns, by key; None where uncertainties are not wanted. `doubts`: whether limits are judged. `alternatives`:
        by kind, the name of a law or DATA, the quantities that have columns of what may stand in their place.
        """
        self.names, self.named, self.inputs, self.doubts = tuple(names), frozenset(named), tuple(inputs), doubts
        self.alternatives = {**alternatives}
        ranges = {f"{name}_by_{DATA}": ("low", "high") for name in alternatives.get(DATA, ())}
        self.uncertainties = sides is not None
        self.sides = {
            key: tuple(side for side in SIDES if side in some) for key, some in {**(sides or {}), **ranges}.items()
        }
        self.keys = tuple(key for name in self.names for key in self.keys_of(name))
        self.places = {key: place for place, key in enumerate(self.keys)}
        self.known_sides = frozenset(side for name in self.names for side in self.sides.get(name, ()))

    def sides_of(self, key: str) -> dict[str, str]:
        """Return the keys of the columns of the uncertainty of a column, by the side: "radius_minus"."""
        return {side: f"{key}_{side}" for side in self.sides.get(key, ())}

    def keys_of(self, name: str) -> tuple[str, ...]:
        """Return the keys of the columns of a quantity and of what may stand in its place, with their uncertainties."""
        return tuple(
            each for key in (name, *self.beside(name).values()) for each in (key, *self.sides_of(key).values())
        )

    def beside(self, name: str) -> dict[str, str]:
        """Return the keys of the columns of what may stand in place of a quantity: "pull_off_force_by_maugis"."""
        return {kind: f"{name}_by_{kind}" for kind, names in self.alternatives.items() if name in names}

    def heads(self, header: Callable[[str], str]) -> list[str]:
        """Return the headers of all columns, such as "radius_minus [nm]"; `header` gives that of a quantity."""
        return [header(name).replace(name, key, 1) for name in self.names for key in self.keys_of(name)]

    def with_columns(self, **changed: Any) -> "Wanted":
        """Return the same quantities with other columns beside them: `sides` or `alternatives` as above."""
        sides = self.sides if self.uncertainties else None
        same = {"inputs": self.inputs, "sides": sides, "doubts": self.doubts, "alternatives": self.alternatives}
        return type(self)(self.names, named=self.named, **{**same, **changed})

    def with_alternatives(self, scenes: Sequence[Scene], names: Collection[str]) -> "Wanted":
        """Return the same quantities, some of them with columns of what may stand in their place.

        `scenes`: of each kind of rows.
        """
        names_of = names_beside(scenes, [name for name in self.names if name in names])
        sides = {name: {*some} for name, some in self.sides.items()}
        for scene in scenes:
            if scene.is_uncertain:
                from ..scene.uncertainty import sides_of_results

                other = by_law(scene)
                with suppress(JkrollError):  # sources of two kinds give no error bars
                    for name, some in sides_of_results(other, names_of.get(other.law.name, [])).items():
                        sides.setdefault(f"{name}_by_{other.law.name}", set()).update(some)
        return self.with_columns(alternatives=names_of, sides=sides if self.uncertainties else None)

    def numbers_beside(self, scene: Scene, shown: Collection[str]) -> dict[str, Any]:
        """Return what may stand in place of the quantities shown, with their uncertainties, by their keys."""
        names_of = {kind: [name for name in names if name in shown] for kind, names in self.alternatives.items()}
        return {
            f"{name}_by_{kind}": value
            for kind, values in beside(scene, names_of).items()
            for name, value in values.items()
            if not isinstance(value, JkrollError)
        }

    def sources_in(self, scene: Any) -> "Sources | None":
        """Return the sources of uncertainty of the quantities of a scene; None if it has none, or none is wanted."""
        if not (self.uncertainties and scene.is_uncertain):
            return None
        from ..scene.uncertainty import sources_of_results

        return sources_of_results(scene, self.names)

    def work(self, scene: Any) -> int:
        """Return the cost of a row that is computed by itself, counted in formulas."""
        return (_BESIDE + len(scene.plan(*scene.possible(self.names)).steps)) * (_JUDGED if self.doubts else 1)

    def row(self, scene: Any) -> "Row":
        """Return the row of a scene of numbers. Raises a JkrollError for uncertainties that do not go together."""
        results = scene.outcomes(self.names, self.named)
        reasons = reasons_of(results)
        values = {name: outcome for name, outcome in results.items() if name not in reasons}
        beside = self.numbers_beside(scene, [*results])
        numbers: dict[str, float] = {**values, **{key: middle(value) for key, value in beside.items()}}
        fill_sides(self, beside, numbers, reasons)
        inputs = scene.echo(scene.inputs_used(self.names, self.names)) if self.inputs else {}
        if self.uncertainties and scene.is_uncertain:
            from ..scene.uncertainty import measures_of, uncertainties

            bars, sources = uncertainties(scene, [*results])
            if (remark := left_out(self, scene, sources)) is not None:
                reasons[UNCERTAINTY] = remark
            else:
                inputs |= {name: given for name, given in sources.given.items() if name in inputs}
                fill_sides(self, measures_of(bars), numbers, reasons)
        return Row(
            inputs,
            [numbers.get(key, nan) for key in self.keys],
            bits_of(doubts(scene, [*values])) if self.doubts and values else 0,
            reasons,
        )

    def columns(self, scene: Any, rows: Sequence[int], scene_of: Callable[[int], Any]) -> tuple["Columns", Any]:
        """Return the columns of a scene of arrays, and the rows that floats are to compute, as an array of booleans.

        `scene_of` returns one of the rows as a scene of numbers. Raises a JkrollError where floats are to compute all.
        """
        arrays = _Arrays(self, scene, rows)
        again = arrays.explain(scene_of) | arrays.columns.put_sides(arrays.beside)
        if self.uncertainties and scene.is_uncertain:
            again |= arrays.add_sides()
        return arrays.columns, again


class Row(NamedTuple):
    """A row of columns."""

    inputs: Mapping[str, Any]  # SI values, with their uncertainties, names of materials, the law
    numbers: Sequence[float]  # as Wanted.keys has them; nan is a gap
    doubts: int  # bits
    reasons: Reasons


def remarks_of(wanted: Wanted, *, doubt: bool = True) -> tuple[str, ...]:
    """Return the columns of remarks, which stand last. `doubt`: whether doubts have one, if they are judged."""
    return (DOUBT, STATUS) if doubt and wanted.doubts else (STATUS,)


class Columns:
    """The columns of some rows: arrays where there are many rows, else lists. Writers index them and iterate."""

    def __init__(self, wanted: Wanted, inputs: Mapping[str, Any], numbers: Any, doubts: Any) -> None:
        """`inputs`: columns by name; `numbers`: a column for each of Wanted.keys."""
        self.wanted, self.inputs, self.numbers, self.doubts = wanted, inputs, numbers, doubts
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

    def __len__(self) -> int:
        """Return the number of rows."""
        return len(self.doubts)

    def column(self, key: str) -> Any:
        """Return the numbers of a column."""
        return self.numbers[self.wanted.places[key]]

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

    def put_sides(self, values: Mapping[str, Any]) -> Any:
        """Take the sides of values of arrays that have some, by the keys of columns; return the rows with open ones."""
        import numpy

        again = numpy.zeros(len(self), dtype=bool)
        for key, value in values.items():
            is_known = ~numpy.isnan(self.column(key))
            if isinstance(value, JkrollError):
                again |= is_known
            elif is_uncertain(value):
                width = value.high - value.low
                for side, of_side in self.wanted.sides_of(key).items():
                    if side in value.sides:
                        self.column(of_side)[...] = where(is_known & (width > 0), value.sides[side], numpy.nan)
                again |= is_known & numpy.isnan(width)
        return again

    def add_remark(self, remark: JkrollError) -> None:
        """Note a remark on all rows."""
        alone: Reasons = {UNCERTAINTY: remark}
        others = {id(reasons): {**reasons, **alone} for reasons in self.reasons.values()}
        self.reasons = {
            row: others[id(self.reasons[row])] if row in self.reasons else alone for row in range(len(self))
        }

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
        import numpy

        distinct, counts = numpy.unique(self.doubts, return_counts=True)
        return Counter(dict(zip(distinct.tolist(), counts.tolist(), strict=True)))

    @cached_property
    def failed(self) -> list[int]:
        """The rows without a contact, or without any value."""
        lacks = {id(reasons): lack(reasons) is not None for reasons in self.reasons.values()}
        is_empty = self._are_empty() if lacks else ()
        return [row for row, reasons in self.reasons.items() if lacks[id(reasons)] or is_empty[row]]

    def _are_empty(self) -> Any:
        """Return for each row whether it has no value."""
        if isinstance(self.numbers, list):
            return [all(map(isnan, row)) for row in zip(*self.numbers, strict=True)]
        import numpy

        return numpy.isnan(self.numbers).all(axis=0)

    def failure(self, row: int) -> JkrollError:
        """Return why a row fails: the lack of a contact, or else its first reason."""
        return lack(self.reasons[row]) or next(iter(self.reasons[row].values()))


def as_list(column: Any) -> list[Any]:
    """Return the values of a column, an array or a list, as a list."""
    return column if isinstance(column, list) else column.tolist()


# --- By floats --------------------------------------------------------------------------------------------------------


def reasons_of(results: Mapping[str, Any]) -> dict[str, JkrollError]:
    """Return why cells of a row are empty, of which some outcomes are known."""
    if not results:
        return {ROW: Failure(OF_IDENTICAL_SPHERES)}
    return {name: outcome for name, outcome in results.items() if isinstance(outcome, JkrollError)}


def fill_sides(
    wanted: Wanted, values: Mapping[str, Any], numbers: dict[str, float], reasons: dict[str, JkrollError]
) -> None:
    """Add the columns of uncertainties of values to the numbers of a row, or the reasons why they have none."""
    for key, value in values.items():
        for side, of_side in wanted.sides_of(key).items():
            if isinstance(value, JkrollError):
                reasons[of_side] = value
            elif is_uncertain(value) and side in value.sides:
                numbers[of_side] = value.sides[side]


def left_out(wanted: Wanted, scene: Any, sources: "Sources") -> BadRequest | None:
    """Return the remark on uncertainties without columns, if there are some. Raises BadRequest if a cell has one.

    `scene`: a scene, or a problem of infer.
    """
    if sources.sides <= wanted.known_sides:
        return None
    names = [*sources.given]
    if in_cells := [name for name in names if name in scene.uncertain]:
        problem = f"{in_cells[0]}: the cell has an uncertainty, {_NO_COLUMNS}"
        raise BadRequest(problem, "error bar without a column")
    materials = dict.fromkeys(material.name for material, _ in scene.data_used(names))
    return BadRequest(f"{listed(materials)}: uncertainties are left out, {_NO_COLUMNS}", "error bars left out")


# --- By arrays --------------------------------------------------------------------------------------------------------


class _Arrays:
    """The quantities of a scene of arrays, and what is empty in them."""

    def __init__(self, wanted: Wanted, scene: Scene, rows: Sequence[int]) -> None:
        import numpy

        self.wanted, self.scene, self.rows, self.size = wanted, scene, rows, len(rows)
        self.outcomes = scene.outcomes(wanted.names, wanted.named)
        self.shown = {name: name in wanted.named or scene.shows(name) for name in self.outcomes}
        self.known = [name for name, outcome in self.outcomes.items() if not isinstance(outcome, JkrollError)]
        numbers = numpy.full((len(wanted.keys), self.size), numpy.nan)
        for name in self.known:
            numbers[wanted.places[name]] = where(self.shown[name], self.outcomes[name], numpy.nan)
        self.beside = wanted.numbers_beside(scene, [*self.outcomes])
        for key, value in self.beside.items():
            numbers[wanted.places[key]] = where(self.shown[key.partition("_by_")[0]], middle(value), numpy.nan)
        inputs = scene.echo(scene.inputs_used(wanted.names, wanted.names)) if wanted.inputs else {}
        of_rows = {name: repeated(inputs.get(name), self.size) for name in wanted.inputs}
        self.empty = {name: numpy.isnan(numbers[wanted.places[name]]) for name in self.outcomes}
        self.columns = Columns(wanted, of_rows, numbers, self._doubts())

    def _doubts(self) -> Any:
        """Return the doubts of each row, of the quantities that have a value there."""
        import numpy

        bits = numpy.zeros(self.size, dtype=numpy.int64)
        if self.wanted.doubts and self.known:
            bits[...] = bits_of(doubts(self.scene, self.known))
            if any(self.empty[name].any() for name in self.known):
                concerned = numpy.zeros_like(bits)
                for name in self.known:
                    concerned |= numpy.where(self.empty[name], 0, possible_bits(self.scene, [name]))
                bits &= concerned
        return bits

    def explain(self, scene_of: Callable[[int], Any]) -> Any:
        """Note why cells are empty. Return the rows that floats are to compute, as they do not confirm an empty cell.

        Rows that lack the same results, from the same step on, have the reasons of the first of them. `scene_of`: as
        `Wanted.columns` has it.
        """
        import numpy

        again = numpy.zeros(self.size, dtype=bool)
        gaps = {name: self.empty[name] & is_shown for name, is_shown in self.shown.items()}
        is_lacking = numpy.zeros(self.size, dtype=bool)
        for of_name in gaps.values():
            is_lacking |= of_name
        if not any(is_shown is True for is_shown in self.shown.values()):  # some rows may show nothing
            is_lacking |= ~numpy.any([*self.shown.values()], axis=0)
        rows = numpy.flatnonzero(is_lacking)
        if not len(rows):
            return again
        steps = [value for name, value in self.scene.values.items() if isinstance(value, numpy.ndarray)]
        is_nan = [numpy.broadcast_to(numpy.isnan(value), self.size) for value in steps]
        for places in alike(rows, [*gaps.values(), *is_nan]):
            first = int(places[0])
            lacking = {name for name, of_name in gaps.items() if of_name[first]}
            reasons = reasons_of(scene_of(self.rows[first]).outcomes(self.wanted.names, self.wanted.named))
            if reasons.keys() - {ROW} == lacking and reasons:
                self.columns.reasons.update(dict.fromkeys(places.tolist(), reasons))
            else:
                again[places] = True
        return again

    def add_sides(self) -> Any:
        """Add the columns of uncertainties, and return the rows in which they need a search."""
        import numpy

        from ..scene import uncertainty

        sources = uncertainty.sources_of_results(self.scene, [*self.outcomes])
        if (remark := left_out(self.wanted, self.scene, sources)) is not None:
            self.columns.add_remark(remark)
            return numpy.zeros(self.size, dtype=bool)
        bars, _ = uncertainty.uncertainties(self.scene, self.known, sources=sources)
        return self.columns.put_sides(uncertainty.measures_of(bars))


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


def repeated(value: Any, size: int) -> Any:
    """Return the column of an input: a text in each row, or numbers, without their uncertainties."""
    import numpy

    if value is None or isinstance(value, str):
        return [value] * size
    return numpy.full(size, middle(value), dtype=float)
