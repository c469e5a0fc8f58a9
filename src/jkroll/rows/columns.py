"""The columns of rows: values, uncertainties, doubts as bits, and the reasons of cells that are empty.

`Wanted.row` is the definition of a row. `Wanted.columns` gives the same for many rows at once: where an array leaves
a gap that no frequent reason explains, or an uncertainty needs a search, the row is computed again by floats.
"""

from collections.abc import Callable, Collection, Hashable, Iterable, Iterator, Mapping, Sequence
from functools import cached_property, partial
from math import isnan, nan
from types import MappingProxyType
from typing import TYPE_CHECKING, Any, NamedTuple

from ..errors import JkrollError
from ..physics.elementary import where
from ..quantities.formatting import OutOfUnit
from ..quantities.values import is_uncertain
from ..scene.alternatives import beside, kinds_beside
from ..scene.failures import (
    MissingInput,
    OfIdenticalSpheres,
    RestsOnSpacing,
    hold_of,
    written_outcome,
)
from ..scene.limits import bits_of, doubts, possible_bits
from ..scene.scene import Scene
from ..scene.wiring import Step
from ..text import listed
from .reasons import ROW, UNCERTAINTY, Reasons, lack, worded

if TYPE_CHECKING:
    from ..scene.uncertainty import Elements, Propagated, Sources

BLOCK = 1 << 12  # rows computed together as arrays: many for the calls of numpy, few for the cache
SIDES = ("minus", "plus", "low", "high")  # of uncertainties: the two of a standard one, and the ends of a range
_BESIDE = 15  # cost of the rest of a row, in formulas
_JUDGED = 8  # a row whose limits are judged takes 8 times as long: Maugis' law is evaluated, too
DOUBT = "doubt"  # the column of the limits of the model that a row exceeds, as codes
STATUS = "status"  # the column of reasons
_NO_COLUMNS = "for which the table has no columns; --uncertainty adds them"


class BadCells(JkrollError):
    """Error raised for cells that are no values of inputs, or no names of materials."""


class NotShown(BadCells):
    """Error raised for a cell that has an uncertainty for which the table has no columns."""


class LeftOut(JkrollError):
    """The remark on a row whose materials have uncertainties for which the table has no columns. It is never raised."""


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

        `sides`: of the uncertainties of quantities, those of SIDES that have columns; None where uncertainties are not
        wanted. `doubts`: whether limits are judged. `alternatives`: by the quantity, what may stand in its place and has
        columns: the name of a law, or the ends of what measured forces mean, `DATA`.
        """
        self.names, self.named, self.inputs, self.doubts = tuple(names), frozenset(named), tuple(inputs), doubts
        self.uncertainties = sides is not None
        self.sides = {name: tuple(side for side in SIDES if side in own) for name, own in (sides or {}).items()}
        self.alternatives = {name: own for name, own in alternatives.items() if name in self.names}
        self.keys = tuple(key for name in self.names for key in self.keys_of(name))
        self.places = {key: place for place, key in enumerate(self.keys)}
        self.known_sides = frozenset(side for own in self.sides.values() for side in own)

    def sides_of(self, name: str) -> dict[str, str]:
        """Return the keys of the columns of a quantity's uncertainty, by the side: "radius_minus"."""
        return {side: f"{name}_{side}" for side in self.sides.get(name, ())}

    def keys_of(self, name: str) -> tuple[str, ...]:
        """Return the keys of the columns of a quantity: its own, those of its uncertainty, and of what may stand in its place."""
        return (name, *self.sides_of(name).values(), *self.beside(name).values())

    def beside(self, name: str) -> dict[str, str]:
        """Return the keys of the columns of what may stand in place of a quantity, by its kind: "pull_off_force_by_maugis"."""
        return {kind: f"{name}_by_{kind}" for kind in self.alternatives.get(name, ())}

    def heads(self, header: Callable[[str], str]) -> list[str]:
        """Return the headers of all columns, such as "radius_minus [nm]"; `header` gives that of a quantity."""
        return [header(name).replace(name, key, 1) for name in self.names for key in self.keys_of(name)]

    def with_sides(self, sides: Collection[str]) -> "Wanted":
        """Return the same quantities with columns for some sides of their uncertainties."""
        of_each = dict.fromkeys(self.names, sides)
        return Wanted(
            self.names,
            named=self.named,
            inputs=self.inputs,
            sides=of_each,
            doubts=self.doubts,
            alternatives=self.alternatives,
        )

    def with_alternatives(self, scenes: Sequence[Scene], names: Collection[str], *, data: bool = False) -> "Wanted":
        """Return the same quantities, some of them with columns of what may stand in their place.

        `scenes`: of each kind of rows; `data`: whether measured forces have columns, too.
        """
        return Wanted(
            self.names,
            named=self.named,
            inputs=self.inputs,
            sides=self.sides if self.uncertainties else None,
            doubts=self.doubts,
            alternatives=kinds_beside(scenes, [name for name in self.names if name in names], data=data),
        )

    def values_beside(self, scene: Scene, shown: Collection[str]) -> dict[str, Any]:
        """Return the values that may stand in place of the quantities shown, by their keys."""
        wanted = {name: kinds for name, kinds in self.alternatives.items() if name in shown}
        outcomes = {
            f"{name}_by_{kind}": written_outcome(name, one) for (name, kind), one in beside(scene, wanted).items()
        }
        return {key: outcome for key, outcome in outcomes.items() if not isinstance(outcome, JkrollError)}

    def sources_in(self, scene: Any) -> "Sources | None":
        """Return the sources of uncertainty of the quantities of a scene; None if it has no uncertainty."""
        if not scene.is_uncertain:
            return None
        from ..scene.uncertainty import sources_of_results

        return sources_of_results(scene, self.names)

    def lacks(self, scene: Any) -> bool:
        """Return whether a scene lacks inputs of some quantity."""
        return bool(scene.missing(self.names))

    def work(self, scene: Any) -> int:
        """Return the cost of a row that is computed by itself, counted in formulas."""
        return (_BESIDE + len(scene.plan(*scene.possible(self.names)).steps)) * (_JUDGED if self.doubts else 1)

    def row(self, scene: Any) -> "Row":
        """Return the row of a scene of numbers. Raises a JkrollError for uncertainties that do not go together."""
        found = outcomes(scene, self.names, self.named)
        reasons: dict[str, JkrollError] = {
            name: outcome for name, outcome in found.items() if isinstance(outcome, JkrollError)
        }
        if not found:
            reasons[ROW] = OfIdenticalSpheres()
        values = {name: outcome for name, outcome in found.items() if name not in reasons}
        numbers: dict[str, float] = {**values, **self.values_beside(scene, [*found])}
        inputs = scene.echo(scene.inputs_used(self.names, [*found])) if self.inputs else {}
        if self.uncertainties and scene.is_uncertain:
            from ..scene.uncertainty import uncertainties

            bars, sources = uncertainties(scene, [*found])
            if (remark := left_out(self, scene, sources)) is not None:
                reasons[UNCERTAINTY] = remark
            else:
                inputs |= {name: one for name, one in sources.given.items() if name in inputs}
                fill_sides(self, bars, numbers, reasons)
        return Row(
            inputs,
            [numbers.get(key, nan) for key in self.keys],
            bits_of(doubts(scene, [*values])) if self.doubts and values else 0,
            reasons,
        )

    def columns(
        self, scene: Any, size: int, one: Callable[[int], Any], wording: Callable[[int], Hashable]
    ) -> "Columns":
        """Return the columns of a scene of arrays; `one` returns a row as a scene of numbers.

        `wording` is the same for rows that lack inputs in the same words. Raises a JkrollError where each row is to be
        computed by itself.
        """
        import numpy

        found = _Arrays(self, scene, size)
        columns = found.columns
        if found.lacking:
            found.say_lacking(one, wording)
        again = found.explain()
        if self.uncertainties and scene.is_uncertain:
            again |= found.add_sides()
        for row in numpy.flatnonzero(again).tolist():
            put_one(columns, row, partial(one, row))
        return columns


class Row(NamedTuple):
    """A row of columns."""

    inputs: Mapping[str, Any]  # SI values, with their uncertainties, names of materials, the law
    numbers: Sequence[float]  # as Wanted.keys has them; nan is a gap
    doubts: int  # bits
    reasons: Reasons


def remarks_of(wanted: Wanted, *, doubt: bool) -> tuple[str, ...]:
    """Return the columns of remarks, which stand last. `doubt`: whether doubts have one, if they are judged."""
    return (DOUBT, STATUS) if doubt and wanted.doubts else (STATUS,)


class Columns:
    """The columns of some rows: arrays where there are many rows, else lists. Writers index them and iterate."""

    def __init__(self, wanted: Wanted, inputs: Mapping[str, Any], numbers: Any, doubts: Any, reasons: Any) -> None:
        """`inputs`: columns by name; `numbers`: a column for each of Wanted.keys; `reasons`: by the place of a row."""
        self.wanted, self.inputs, self.numbers, self.doubts = wanted, inputs, numbers, doubts
        self.reasons: dict[int, Reasons] = reasons
        self._texts: dict[int, str] = {}  # by the identity of reasons; many rows share some, and all are known by then

    @classmethod
    def of_rows(cls, wanted: Wanted, rows: Sequence[Row]) -> "Columns":
        """Return the columns of rows that were computed one by one."""
        return cls(
            wanted,
            {name: [row.inputs.get(name) for row in rows] for name in wanted.inputs},
            [[row.numbers[place] for row in rows] for place in range(len(wanted.keys))],
            [row.doubts for row in rows],
            {place: row.reasons for place, row in enumerate(rows) if row.reasons},
        )

    def __len__(self) -> int:
        """Return the number of rows."""
        return len(self.doubts)

    def column(self, key: str) -> Any:
        """Return the numbers of a column."""
        return self.numbers[self.wanted.places[key]]

    def put(self, row: int, one: Row) -> None:
        """Take a row that was computed by itself, in place of what arrays gave."""
        self.numbers[:, row] = one.numbers
        self.doubts[row] = one.doubts
        self.reasons.pop(row, None)
        if one.reasons:
            self.reasons[row] = one.reasons
        for name, column in self.inputs.items():
            value = one.inputs.get(name)
            column[row] = value.value if is_uncertain(value) and not isinstance(column, list) else value

    def put_sides(self, found: "Mapping[str, Elements]") -> Any:
        """Take the columns of uncertainties of arrays, and return the rows in which they are open."""
        import numpy

        again = numpy.zeros(len(self), dtype=bool)
        for name, one in found.items():
            for side, key in self.wanted.sides_of(name).items():
                if side in one.sides:
                    self.column(key)[...] = one.sides[side]
            again |= one.is_open & ~numpy.isnan(self.column(name))
        return again

    @cached_property
    def lost(self) -> dict[int, JkrollError]:
        """The reasons why nothing of some rows is to be trusted; to be asked when all rows are known."""
        return {row: error for row, own in self.reasons.items() if (error := lack(own)) is not None}

    def failed(self) -> list[int]:
        """Return the rows that fail: those without a contact or without any value. One that no double holds in its unit is a value."""
        of_names = [self.column(name) for name in self.wanted.names]
        others = self.reasons.keys() - self.lost.keys()
        empty = [row for row in others if all(isnan(column[row]) for column in of_names)]
        unwritten = {row for row in empty if any(isinstance(error, OutOfUnit) for error in self.reasons[row].values())}
        return [*self.lost, *(row for row in empty if row not in unwritten)]

    def without_sides(self) -> int:
        """Return the number of rows that have uncertainties for which there are no columns."""
        of_rows = (reasons.get(UNCERTAINTY) or reasons.get(ROW) for reasons in self.reasons.values())
        return sum(isinstance(error, NotShown | LeftOut) for error in of_rows if error is not None)

    def failure(self, row: int) -> JkrollError:
        """Return why a row fails: the lack of a contact, or else its first reason."""
        return self.lost.get(row) or next(iter(self.reasons[row].values()))

    def status(self, row: int) -> str:
        """Return why cells of a row are empty, in words."""
        if row in self.lost:
            return str(self.lost[row])
        if (reasons := self.reasons.get(row)) is None:
            return ""
        if id(reasons) not in self._texts:
            self._texts[id(reasons)] = worded(reasons)
        return self._texts[id(reasons)]


def as_list(column: Any) -> list[Any]:
    """Return the values of a column, an array or a list, as a list."""
    return column if isinstance(column, list) else column.tolist()


# --- By floats --------------------------------------------------------------------------------------------------------


def outcomes(scene: Scene, names: Sequence[str], named: Collection[str]) -> dict[str, Any]:
    """Return the value of each quantity that concerns a scene of numbers, or the error that says why there is none.

    `named`: quantities that were asked for by name, and concern any scene.
    """
    found = scene.evaluate([name for name in names if name in named or scene.shows(name)])
    return {name: written_outcome(name, outcome) for name, outcome in found.items()}


def fill_sides(
    wanted: Wanted,
    found: "Mapping[str, Propagated | JkrollError]",
    numbers: dict[str, float],
    reasons: dict[str, JkrollError],
) -> None:
    """Add the columns of uncertainties to the numbers of a row, or the reasons why they have none."""
    for name, one in found.items():
        for side, key in wanted.sides_of(name).items():
            if isinstance(one, JkrollError):
                reasons[key] = one
            elif side in one.uncertainty.sides:
                numbers[key] = one.uncertainty.sides[side]


def left_out(wanted: Wanted, scene: Scene, sources: "Sources", stated: Sequence[str] = ()) -> LeftOut | None:
    """Return the remark on uncertainties for which there are no columns, if there are some. Raises NotShown if a cell has one.

    `stated`: what has an uncertainty in a cell, beside the inputs of the scene.
    """
    if sources.sides <= wanted.known_sides:
        return None
    names = [*sources.given]
    if in_cells := [name for name in names if name in scene.uncertain or name in stated]:
        raise NotShown(f"{in_cells[0]}: the cell has an uncertainty, {_NO_COLUMNS}")
    materials = dict.fromkeys(material.name for material, _ in scene.data_used(names))
    return LeftOut(f"{listed(materials)}: uncertainties are left out, {_NO_COLUMNS}")


# --- By arrays --------------------------------------------------------------------------------------------------------


def put_one(columns: Columns, row: int, scene: Callable[[], Any]) -> None:
    """Compute a row by floats; if its scene cannot be made, that is why the row is empty."""
    try:
        found = columns.wanted.row(scene())
    except JkrollError as error:
        lose(columns, row, error)
    else:
        columns.put(row, found)


def lose(columns: Columns, row: int, error: JkrollError) -> None:
    """Empty a row, for one reason."""
    columns.put(row, Row({}, [nan] * len(columns.wanted.keys), 0, {ROW: error}))


class _Arrays:
    """The quantities of a scene of arrays, and what is empty in them."""

    def __init__(self, wanted: Wanted, scene: Scene, size: int) -> None:
        import numpy

        self.wanted, self.scene, self.size = wanted, scene, size
        self.shown = {name: name in wanted.named or scene.shows(name) for name in wanted.names}
        found = scene.evaluate([name for name, is_shown in self.shown.items() if is_shown is not False])
        outcomes = {name: written_outcome(name, outcome) for name, outcome in found.items()}
        self.lacking = [name for name, outcome in outcomes.items() if isinstance(outcome, MissingInput)]
        self.numbers = numpy.full((len(wanted.keys), size), numpy.nan)
        self.gaps: dict[str, Any] = {}  # by the quantity: the rows that should have a value and have none
        self.whole: dict[str, JkrollError] = {}  # quantities that have no value in any row, for one reason
        for name, outcome in outcomes.items():
            if name not in self.lacking:
                self._take(name, outcome)
        for key, value in wanted.values_beside(scene, [*outcomes]).items():
            is_shown = self.shown[key.rpartition("_by_")[0]]
            self.numbers[wanted.places[key]][...] = where(is_shown, value, numpy.nan)
        self.known = [name for name in outcomes if name not in self.whole and name not in self.lacking]
        inputs, reasons = self._of_unequal([*outcomes])
        self.columns = Columns(wanted, inputs, self.numbers, self._doubts(), reasons)

    def _take(self, name: str, outcome: Any) -> None:
        """Take the values of a quantity, or note in which rows it has none."""
        import numpy

        is_shown = self.shown[name]
        if isinstance(outcome, JkrollError):
            self.whole[name], self.gaps[name] = outcome, numpy.broadcast_to(is_shown, self.size)
            return
        values = self.numbers[self.wanted.places[name]]
        values[...] = where(is_shown, outcome, numpy.nan)
        if isinstance(outcome, numpy.ndarray) and (fails := numpy.isnan(values) & is_shown).any():
            self.gaps[name] = fails

    def _of_unequal(self, names: Sequence[str]) -> tuple[dict[str, Any], dict[int, Reasons]]:
        """Return the columns of inputs, which are fewer for unequal spheres if some quantities are those of identical ones.

        A row of unequal spheres that shows nothing has a reason.
        """
        import numpy

        inputs = self._inputs(names)
        always = [name for name in names if self.shown[name] is True]
        if always and len(always) == len(names):
            return inputs, {}
        unequal = numpy.broadcast_to(numpy.logical_not(self.scene.is_identical), self.size)
        of_unequal = self._inputs(always)
        inputs = {name: _either(unequal, of_unequal[name], column) for name, column in inputs.items()}
        rows = [] if always else numpy.flatnonzero(unequal).tolist()
        return inputs, {row: {ROW: OfIdenticalSpheres()} for row in rows}

    def _inputs(self, shown: Sequence[str]) -> dict[str, Any]:
        """Return the columns of inputs for the quantities that are shown."""
        names = self.wanted.inputs
        inputs = self.scene.echo(self.scene.inputs_used(self.wanted.names, shown)) if names else {}
        return {name: repeated(inputs.get(name), self.size) for name in names}

    def _doubts(self) -> Any:
        """Return the doubts of each row, of the quantities that have a value there."""
        import numpy

        bits = numpy.zeros(self.size, dtype=numpy.int64)
        if self.wanted.doubts and self.known:
            bits[...] = bits_of(doubts(self.scene, self.known))
            has_value = {name: ~numpy.isnan(self.numbers[self.wanted.places[name]]) for name in self.known}
            if not all(rows.all() for rows in has_value.values()):
                concerned = numpy.zeros_like(bits)
                for name, rows in has_value.items():
                    concerned |= numpy.where(rows, possible_bits(self.scene, [name]), 0)
                bits &= concerned
        return bits

    def say_lacking(self, one: Callable[[int], Any], wording: Callable[[int], Hashable]) -> None:
        """Say which inputs quantities lack; `one` and `wording` as `Wanted.columns` has them."""
        import numpy

        of_kinds: dict[Hashable, Reasons] = {}  # many rows lack the same inputs, in the same words
        concerned = numpy.array([numpy.broadcast_to(self.shown[name], self.size) for name in self.lacking])
        for row, is_shown in enumerate(concerned.T.tolist()):
            if (own := (wording(row), *is_shown)) not in of_kinds:
                names = [name for name, is_one in zip(self.lacking, is_shown, strict=True) if is_one]
                of_kinds[own] = one(row).evaluate(names)
            if of_kinds[own]:
                self.columns.reasons[row] = of_kinds[own]

    def explain(self) -> Any:
        """Say why cells are empty where a frequent reason explains them, and return the other rows that have such cells."""
        import numpy

        again = numpy.zeros(self.size, dtype=bool)
        if not self.gaps:
            return again
        causes = _Causes(self.scene, [*self.gaps], self.size)
        of_names = numpy.array(
            [numpy.where(fails, causes.of(name, self.whole.get(name)), NO_GAP) for name, fails in self.gaps.items()]
        )
        for rows in alike(numpy.flatnonzero(of_names.any(axis=0)), of_names):
            own = zip(self.gaps, of_names[:, rows[0]].tolist(), strict=True)
            explain = causes.explain({name: cause for name, cause in own if cause != NO_GAP})
            if explain is None:
                again[rows] = True
                continue
            for row in rows.tolist():
                reasons = explain(row)
                if lacking := self.columns.reasons.get(row):
                    mixed = {**reasons, **lacking}
                    reasons = {name: mixed[name] for name in self.wanted.names if name in mixed}
                self.columns.reasons[row] = reasons
        return again

    def add_sides(self) -> Any:
        """Add the columns of uncertainties, and return the rows in which they need a search."""
        import numpy

        from ..scene import uncertainty

        values = {name: self.columns.column(name) for name in self.known}
        sources = uncertainty.sources_of_results(self.scene, [*self.known, *self.whole])
        if (remark := left_out(self.wanted, self.scene, sources)) is not None:
            for row in range(self.size):
                self.columns.reasons[row] = {**self.columns.reasons.get(row, {}), UNCERTAINTY: remark}
            return numpy.zeros(self.size, dtype=bool)
        found = uncertainty.uncertainties_of_elements(self.scene, values, sources.entering)
        return self.columns.put_sides(found)


def alike(rows: Any, columns: Iterable[Any]) -> Iterator[Any]:
    """Iterate over the rows that have the same whole number in each column; `rows`: the places of those that are meant."""
    import numpy

    keys = numpy.zeros(len(rows), dtype=numpy.int64)
    for column in columns:
        own = column[rows]
        if len(own) and (own != own[0]).any():
            keys = numpy.unique(keys * (own.max() + 1) + own, return_inverse=True)[1]
    for key in range(int(keys.max(initial=-1)) + 1):
        yield rows[keys == key]


def _either(rows: Any, column: Any, otherwise: Any) -> Any:
    """Return a column of an input in some rows, and another one elsewhere."""
    import numpy

    if isinstance(column, list) and isinstance(otherwise, list):
        return [own if is_own else other for is_own, own, other in zip(rows.tolist(), column, otherwise, strict=True)]
    return numpy.where(rows, numpy.asarray(column, dtype=float), numpy.asarray(otherwise, dtype=float))


_Explain = Callable[[int], dict[str, JkrollError]]  # returns why quantities have no value in a row
NO_GAP, UNKNOWN, RESTS, FIRST = range(4)  # why a value is missing; further numbers stand for errors


class _Causes:
    """Why quantities of a scene of arrays have no value: as in a scene of numbers, a formula hands on the first of its arguments' causes."""

    def __init__(self, scene: Scene, names: Sequence[str], size: int) -> None:
        """`names`: quantities that the scene has evaluated."""
        import numpy

        self.scene, self.size = scene, size
        self.errors: list[Callable[[int], JkrollError]] = []  # of a row, by the number of the cause less FIRST
        plan = scene.plan(*names)
        self.sources, self.causes = plan.found, dict[str, Any]()  # by step, for each row
        for step in plan.steps:
            cause = numpy.zeros(size, dtype=numpy.int16)
            for _, source in step.arguments:
                if source in self.causes:
                    cause = numpy.where(cause == NO_GAP, self.causes[source], cause)
            fails = numpy.isnan(scene.values.get(step.name, numpy.nan)) & (cause == NO_GAP)
            if fails.any():
                cause[fails] = UNKNOWN
                self._find(step, cause, fails)
            if cause.any():
                self.causes[step.name] = cause

    def _find(self, step: Step, cause: Any, fails: Any) -> None:
        """Note the cause of a formula that fails by itself in some rows."""
        values = self.scene.values
        if step.name not in values:
            error = self.scene.evaluate([step.name])[step.name]
            self._note(cause, fails, lambda _: error)
            return
        given = {parameter: values[source] for parameter, source in step.arguments}
        if (hold := hold_of(step.name, given)) is not None:
            stated, least = (repeated(value, self.size).tolist() for value in (given[hold.name], hold.least))
            lets_go = hold.lets_go(given[hold.name]) & fails
            self._note(cause, lets_go, lambda row: hold.error(stated[row], least[row]))

    def _note(self, cause: Any, rows: Any, error: Callable[[int], JkrollError]) -> None:
        cause[rows] = FIRST + len(self.errors)
        self.errors.append(error)

    def of(self, name: str, error: JkrollError | None) -> Any:
        """Return the cause of a quantity in each row, if it has no value there. `error`: of one that has none in any row."""
        import numpy

        cause = self.causes.get(self.sources[name], numpy.zeros(self.size, dtype=numpy.int16))
        if error is None:
            otherwise = numpy.where(self.scene.rests_on_spacing(name), RESTS, UNKNOWN)
            return numpy.where(cause == NO_GAP, otherwise, cause)
        self._note(cause, cause == NO_GAP, lambda _: error)
        return cause

    def explain(self, causes: Mapping[str, int]) -> "_Explain | None":
        """Return what says why quantities have no value in a row, by their causes; None if one is unknown."""
        numbers = {*causes.values()}
        if UNKNOWN in numbers:
            return None
        errors = {number: self.errors[number - FIRST] for number in numbers if number != RESTS}
        if len(numbers) == len(errors) == 1:
            (error,) = errors.values()
            return lambda row: dict.fromkeys(causes, error(row))

        def reasons(row: int) -> dict[str, JkrollError]:
            own = {number: error(row) for number, error in errors.items()}
            return {name: own.get(number) or RestsOnSpacing(name) for name, number in causes.items()}

        return reasons


def repeated(value: Any, size: int) -> Any:
    """Return a column of a value that is the same in all rows; a column as it is, of which each value may be uncertain."""
    import numpy

    if is_uncertain(value):
        parts = {"value": value.value, **value.sides}
        rows = zip(*(numpy.broadcast_to(part, size).tolist() for part in parts.values()), strict=True)
        return [value._replace(**dict(zip(parts, row, strict=True))) for row in rows]
    if isinstance(value, numpy.ndarray):
        return numpy.broadcast_to(value, size).copy()
    if isinstance(value, float | int):
        return numpy.full(size, float(value))
    return [value] * size
