"""The columns of rows: values, uncertainties, doubts as bits, and the reasons of cells that are empty.

`Wanted.row` is the definition of a row. `Wanted.columns` gives the same for many rows at once: where an array leaves
a gap that floats do not leave, or an uncertainty needs a search, the row is computed again by floats.
"""

from collections import Counter
from collections.abc import Callable, Collection, Iterable, Iterator, Mapping, Sequence
from contextlib import suppress
from functools import cached_property, reduce
from itertools import chain
from math import isnan, nan
from operator import or_
from typing import TYPE_CHECKING, Any, NamedTuple, Protocol

from ..errors import BadRequest, JkrollError
from ..physics.elementary import where
from ..quantities.nomenclature import NOMENCLATURE
from ..quantities.values import Measured, is_uncertain, middle
from ..scene.alternatives import DATA, alternatives_of, names_with_alternatives
from ..scene.doubts import (
    BITS,
    ENDING_MEANING,
    EVERY_DOUBT,
    INEXACT,
    LAW,
    NOT_JUDGED,
    Doubt,
    Evaluation,
    bits_of,
    concerns,
    doubts,
    has_code,
    is_end_of_meaning,
)
from ..scene.failures import OF_IDENTICAL_SPHERES, Failure, MissingInput, grouped, needs_in_words
from ..scene.scene import FOLLOWS, Scene, takes
from ..text import first_of, listed

if TYPE_CHECKING:
    from .cells import Indices, Numbers

BLOCK = 5 << 10  # rows computed together as arrays: many for the calls of numpy, few for the cache and the memory
SIDES = ("minus", "plus", "low", "high")  # of uncertainties: the two of a standard one, and the ends of a range
BAD = -1  # the kind of a row, or of a cell, of which arrays make no scene
_EMPTY, _PLAIN, _SPECIAL, _MEASURED, _INTERVAL = range(5)  # kinds of cells
DOUBT = "doubt"  # the column of the limits of the model that a row exceeds, as codes
STATUS = "status"  # the column of reasons
ROW = ""  # stands for the row as a whole, in place of the name of a column
UNCERTAINTY = "±"  # stands for the columns of uncertainties that a table does not have
_NO_DOUBTS: Counter[int] = Counter()
_BY = "_by_"  # between a quantity and the kind of what may stand in its place, in a key
Reasons = Mapping[str, JkrollError]  # why cells of a row are empty, by the names of their columns
Gaps = tuple[int, int, str]  # rows with one status: their number, the first, counted from 1, and its reasons in full
_NONE: Mapping[str, Any] = {}  # which can be pickled


class Wanted:
    """The columns of rows, known from the plan and the names before anything is computed."""

    def __init__(
        self,
        names: Sequence[str],
        named: Collection[str] = (),  # those that were asked for by name, and concern any row
        inputs: Sequence[str] = (),  # that stand before them
        sides: Collection[str] | None = None,  # those of uncertainties that have columns; None: they are not wanted
        doubts: bool = True,  # whether limits are judged
        # By kind, the name of a law or DATA, the quantities that have columns of what may stand in their place.
        alternatives: Mapping[str, Sequence[str]] = _NONE,
        keeps_all: bool = False,  # whether numbers without a meaning stay
    ) -> None:
        self.names, self.named, self.inputs, self.sides = names, named, inputs, sides
        self.doubts, self.alternatives, self.keeps_all = doubts, alternatives, keeps_all

    def with_alternatives(self, scenes: Sequence[Scene], names: Collection[str]) -> "Wanted":
        """Return the same quantities, some of them with columns of what may stand in their place.

        `scenes`: of each kind of rows.
        """
        names_of = names_with_alternatives(scenes, [name for name in self.names if name in names])
        of_law, sides = next(iter(names_of.values())), {*(self.sides or ())}
        with suppress(JkrollError):  # sources of two kinds give no error bars
            sides |= sides_in((scene.by_law, of_law) for scene in scenes)
        return Wanted(self.names, self.named, self.inputs, sides, self.doubts, names_of, self.keeps_all)

    @cached_property
    def keys(self) -> tuple[str, ...]:
        """The keys of all columns of numbers."""
        return tuple(key for name in self.names for key in self.keys_of(name))

    def keys_of(self, name: str) -> list[str]:
        """Return the keys of the columns of a quantity and of what may stand in its place, with their uncertainties."""
        values = (name, *self.alternatives_of(name).values())
        return [each for key in values for each in (key, *self.sides_of(key).values())]

    def sides_of(self, key: str) -> dict[str, str]:
        """Return the keys of the columns of the uncertainty of a column, by the side: "radius_minus"."""
        sides = ("low", "high") if key.endswith(f"{_BY}{DATA}") else self.sides or ()
        return {side: f"{key}_{side}" for side in SIDES if side in sides}

    def alternatives_of(self, name: str) -> dict[str, str]:
        """Return the keys of the columns of what may stand in place of a quantity: "pull_off_force_by_maugis"."""
        return {kind: f"{name}{_BY}{kind}" for kind, names in self.alternatives.items() if name in names}

    def heads(self, header: Callable[[str], str]) -> list[str]:
        """Return the headers of all columns, such as "radius_minus [nm]"; `header` gives that of a quantity."""
        return [header(name).replace(name, key, 1) for name in self.names for key in self.keys_of(name)]

    def remarks(self, *, doubt: bool = True) -> tuple[str, ...]:
        """Return the columns of remarks, which stand last. `doubt`: whether doubts have one, if they are judged."""
        return (DOUBT, STATUS) if doubt and self.doubts else (STATUS,)

    # --- Rows ---------------------------------------------------------------------------------------------------------

    def evaluation(self, scene: Any) -> Evaluation:
        """Return the evaluation of a scene, of numbers or of arrays."""
        return Evaluation(scene, scene.outcomes(self.names, self.named), keeps_all=self.keeps_all)

    def row(self, evaluation: Evaluation) -> "Row":
        """Return the row of a scene of numbers. Raises a JkrollError for uncertainties that do not go together."""
        outcomes = {**evaluation.outcomes, **self._alternatives(evaluation)}
        reasons = reasons_of(outcomes)
        values = {key: value for key, value in outcomes.items() if key not in reasons}
        numbers = {key: middle(value) for key, value in values.items()}
        bars, remark = self.bars(evaluation)
        if remark is not None:
            reasons[UNCERTAINTY] = remark
        for key, value in {**values, **bars}.items():
            for side, of_side in self.sides_of(key).items():
                if isinstance(value, JkrollError):
                    reasons[of_side] = value
                elif is_uncertain(value) and side in value.sides:
                    numbers[of_side] = value.sides[side]
        inputs = evaluation.inputs_of(self.names) if self.inputs else {}
        return Row(inputs, [numbers.get(key, nan) for key in self.keys], self._bits(evaluation), reasons)

    def _bits(self, evaluation: Evaluation) -> int:
        """Return the doubts about a row as bits: those that end meaning alone, where doubts have no column."""
        if self.doubts:
            return int(bits_of(evaluation.validity))
        return 0 if self.keeps_all else bits_of(evaluation.ending) & ENDING_MEANING

    def columns(self, scene: Any, rows: Sequence[int], scene_of: Callable[[int], Any]) -> tuple["Columns", Any]:
        """Return the columns of a scene of arrays, and the rows that floats are to compute, as an array of booleans.

        `scene_of` returns one of the rows as a scene of numbers. Raises a JkrollError where floats are to compute all.
        """
        evaluation, columns = self.evaluation(scene), Columns.empty(self, len(rows))
        is_shown = {name: name in self.named or scene.shows(name) for name in evaluation.outcomes}
        others = self._alternatives(evaluation)
        for key, value in {**evaluation.values, **others}.items():
            name, is_other, _ = key.partition(_BY)
            has_cell = is_shown[name] & (evaluation.ended.get(name, 0) == 0 if is_other else True)
            columns.column(key)[...] = where(has_cell, middle(value), nan)
        if self.inputs:
            columns.repeat(evaluation.inputs_of(self.names))
        if evaluation.judged and (self.doubts or not self.keeps_all):
            columns.doubts[...] = bits_of_rows(evaluation, is_shown, len(rows), has_all=self.doubts)
        again = _explain(columns, evaluation, is_shown, lambda row: scene_of(rows[row]))
        return columns, again | columns.put_bars(evaluation, others)

    def _alternatives(self, evaluation: Evaluation) -> dict[str, Any]:
        """Return what may stand in place of the outcomes, with its uncertainties, by the keys of columns."""
        if not self.alternatives:
            return {}
        ended = () if evaluation.scene.shape else evaluation.ended  # of arrays, some cells are left empty
        shown = {name for name in evaluation.computed if name not in ended}
        names_of = {kind: [name for name in names if name in shown] for kind, names in self.alternatives.items()}
        return {
            f"{name}{_BY}{kind}": value
            for kind, values in alternatives_of(evaluation.scene, names_of).items()
            for name, value in values.items()
            if value is not None
        }

    def bars(self, evaluation: Evaluation) -> tuple[Mapping[str, Any], BadRequest | None]:
        """Return the error bars of values by their keys, or the remark that the table has no columns for them.

        Raises a JkrollError for sources that do not go together.
        """
        if self.sides is None or evaluation.sources is None:
            return {}, None
        from ..scene.uncertainty import measures_of

        if evaluation.sources.sides <= {*self.sides}:
            return measures_of(evaluation.bars), None
        problem = "error bars are left out, for which the table has no columns; --uncertainty adds them"
        return {}, BadRequest(f"{listed(evaluation.sources.given)}: {problem}", "error bars left out")


def sides_in(kinds: Iterable[tuple[Any, Sequence[str]]]) -> set[str]:
    """Return the sides of the uncertainties that enter quantities; `kinds`: scenes with the quantities of each.

    Raises a JkrollError for sources that do not go together.
    """
    every = (Evaluation(scene, dict.fromkeys(names)).sources for scene, names in kinds)
    return {side for sources in every if sources is not None for side in sources.sides}


class Row(NamedTuple):
    """A row of columns."""

    inputs: Mapping[str, Any]  # SI values, with their uncertainties, names of materials and the law
    numbers: Sequence[float]  # as `Wanted.keys` has them; one that is nan is a gap
    doubts: int  # as bits
    reasons: Reasons  # why cells are empty


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
        return EVERY_DOUBT ^ NOT_JUDGED ^ (LAW.bits if self.wanted.alternatives else 0)

    def column(self, key: str) -> Any:
        """Return the numbers of a column."""
        return self.numbers[self.wanted.keys.index(key)]

    def repeat(self, inputs: Mapping[str, Any]) -> None:
        """Take inputs that are the same in all rows, or arrays, without their uncertainties."""
        import numpy

        for name in self.inputs.keys() & inputs.keys():
            value, size = inputs[name], len(self)
            self.inputs[name] = [value] * size if isinstance(value, str) else numpy.full(size, middle(value), float)

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

    def put_bars(self, evaluation: Evaluation, others: Mapping[str, Any]) -> Any:
        """Take the error bars of arrays, and of what may stand in their place; return the rows that have open ones."""
        import numpy

        bars, remark = self.wanted.bars(evaluation)
        if remark is not None:
            self.reasons = {row: {**self.reasons.get(row, {}), UNCERTAINTY: remark} for row in range(len(self))}
        again = numpy.zeros(len(self), dtype=bool)
        for key, value in {**others, **bars}.items():
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

    def leave_out_bars(self, rows: Mapping[int, JkrollError]) -> None:
        """Empty the error bars of rows that have values. `rows`: the reasons, by row."""
        others = (key for name in self.wanted.names for key in (name, *self.wanted.alternatives_of(name).values()))
        keys = [side for key in others if not key.endswith(DATA) for side in self.wanted.sides_of(key).values()]
        for row, reason in rows.items():
            reasons = self.reasons.get(row, _NONE)
            if lack(reasons) is None:
                self.reasons[row] = {**reasons, UNCERTAINTY: reason}
                for key in keys:
                    self.column(key)[row] = nan

    @cached_property
    def distinct_reasons(self) -> dict[int, Reasons]:
        """The reasons that differ, by their identities: many rows share theirs."""
        return {id(reasons): reasons for reasons in self.reasons.values()}

    @cached_property
    def status(self) -> dict[int, str]:
        """The phrases of rows that have empty cells, by their places."""
        phrases = {number: status_of(reasons) for number, reasons in self.distinct_reasons.items()}
        return {row: phrases[id(reasons)] for row, reasons in self.reasons.items()}

    @cached_property
    def distinct_doubts(self) -> tuple[Any, Any, Any]:
        """The bits of doubts that differ, the place of each row's among them, and the number of rows of each."""
        import numpy

        return numpy.unique(self.doubts, return_inverse=True, return_counts=True)

    @property
    def counted_doubts(self) -> Counter[int]:
        """The numbers of rows, by the bits of their doubts."""
        if isinstance(self.doubts, list):
            return Counter(self.doubts)
        distinct, _, counts = self.distinct_doubts
        return Counter(dict(zip(distinct.tolist(), counts.tolist(), strict=True)))

    @cached_property
    def failed(self) -> list[int]:
        """The rows without a contact, or without any value but alternatives; one without a meaning is an answer."""
        lacks = {number: lack(reasons) is not None for number, reasons in self.distinct_reasons.items()}
        ended = {
            number for number, reasons in self.distinct_reasons.items() if any(map(is_end_of_meaning, reasons.values()))
        }
        return [
            row
            for row, reasons in self.reasons.items()
            if lacks[id(reasons)]
            or (id(reasons) not in ended and all(isnan(self.column(name)[row]) for name in self.wanted.names))
        ]


def as_list(column: Any) -> list[Any]:
    """Return the values of a column, an array or a list, as a list."""
    return column if isinstance(column, list) else column.tolist()


# --- By arrays --------------------------------------------------------------------------------------------------------


def bits_of_rows(evaluation: Evaluation, is_shown: Mapping[str, Any], size: int, *, has_all: bool) -> Any:
    """Return the doubts of rows as bits: of those quantities that have a value there, or would have one with a meaning.

    `is_shown`: in which rows quantities are; `has_all`: whether limits that end no meaning are judged, too.
    """
    import numpy

    scene, bits = evaluation.scene, numpy.zeros(size, dtype=numpy.int64)
    is_here: dict[str, Any] = {}  # whether a value is there
    is_meant: dict[str, Any] = {}  # whether it has a meaning
    for name in evaluation.judged:
        value = evaluation.computed[name]
        is_here[name] = numpy.broadcast_to(is_shown[name] & (value == value), size)  # noqa: PLR0124
        is_meant[name] = is_here[name] & (evaluation.ended.get(name, 0) == 0)

    def add(every: Iterable[Doubt], judged: Mapping[str, Any], rows: Any = slice(None), codes: int = -1) -> None:
        """Add limits with some codes, each for the rows in which a quantity that it concerns is judged."""
        for doubt in every:
            masks = [mask for name, mask in judged.items() if concerns(doubt.limit, scene, [name])]
            is_judged = reduce(or_, masks, numpy.zeros(size, dtype=bool))
            bits[rows] |= numpy.where(is_judged, doubt.bits & codes, 0)[rows]

    add(evaluation.ending, is_here)
    if not has_all:
        return bits & ENDING_MEANING
    add(doubts(scene, [*is_here], [limit for limit in INEXACT if limit is not LAW]), is_meant)
    # A law is judged by its largest effect on a result that has a meaning: together for rows with the same ones.
    ended = {name: numpy.broadcast_to(of_name, size) for name, of_name in evaluation.ended.items()}
    for rows in alike(numpy.arange(size), [of_name != 0 for of_name in ended.values()]):
        meant = {name: mask for name, mask in is_meant.items() if name not in ended or not ended[name][rows[0]]}
        add(doubts(scene, [*meant], [LAW]), meant, rows)
    # What rests on z0 has no value, and limits by it are not judged.
    resting = {
        name: is_shown[name] & scene.rests_on_spacing(name) for name in filter(scene.may_rest_on_spacing, is_here)
    }
    add(doubts(scene, [*resting], INEXACT), resting, codes=NOT_JUDGED)
    return bits


def _explain(
    columns: Columns, evaluation: Evaluation, is_shown: Mapping[str, Any], scene_of: Callable[[int], Scene]
) -> Any:
    """Note why cells are empty. Return the rows that floats are to compute, as they do not confirm an empty cell.

    Rows that lack the same results, from the same step on or by the same limits, have the reasons of the first of
    them. `is_shown`: the quantities, and in which rows they are.
    """
    import numpy

    again = numpy.zeros(len(columns), dtype=bool)
    gaps = {name: numpy.isnan(columns.column(name)) & shown for name, shown in is_shown.items()}
    gaps[ROW] = ~reduce(or_, is_shown.values(), again)  # rows that show nothing
    rows = numpy.flatnonzero(numpy.any([*gaps.values()], axis=0))
    if not len(rows):
        return again
    steps = [value for value in evaluation.scene.values.values() if isinstance(value, numpy.ndarray)]
    is_nan = [numpy.broadcast_to(numpy.isnan(value), len(columns)) for value in steps]
    ended = [numpy.broadcast_to(bits, len(columns)) for bits in evaluation.ended.values()]
    for places in alike(rows, [*gaps.values(), *is_nan, *ended]):
        first = int(places[0])
        lacking = {name for name, is_gap in gaps.items() if is_gap[first]}
        reasons = reasons_of(columns.wanted.evaluation(scene_of(first)).outcomes)
        if reasons.keys() == lacking:
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


# --- Blocks -----------------------------------------------------------------------------------------------------------


class Block(Protocol):
    """Rows that are computed together, as they stand in a list or in a table."""

    size: int
    numbers: Mapping[str, "Numbers"]  # by input
    kinds: Sequence[Any]  # arrays: rows with other whole numbers have other scenes, BAD have none

    def scene(self, given: Mapping[str, Any], rows: "Indices") -> Any:
        """Return the scene of rows that are alike. Raises a JkrollError where each is a scene by itself."""

    def scene_of(self, row: int) -> Any:
        """Return the scene of a row by itself. Raises the error of what is wrong with it."""


def evaluated(wanted: Wanted, block: Block) -> Columns:
    """Return the columns of a block. A row that cannot be computed has the reason for all of its cells."""
    import numpy

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
                of_row = wanted.row(wanted.evaluation(block.scene_of(row)))
            except JkrollError as error:  # its scene cannot be made
                of_row = Row({}, [nan] * len(wanted.keys), 0, {ROW: error})
            columns.put([row], Columns.of_rows(wanted, [of_row]))
    return columns


def groups(block: Block) -> "Iterator[tuple[Indices, dict[str, Any]]]":
    """Iterate over rows that are alike, with their inputs. Rows that are BAD are in none."""
    import numpy

    kinds = {name: _kinds(name, column) for name, column in block.numbers.items()}
    columns = [*kinds.values(), *block.kinds]
    for rows in alike(numpy.flatnonzero(numpy.min(columns, axis=0) != BAD), columns):
        of_cells = {name: int(of_input[rows[0]]) for name, of_input in kinds.items()}
        given = {name: _values(block.numbers[name], rows, kind) for name, kind in of_cells.items() if kind != _EMPTY}
        yield rows, given


def _kinds(name: str, column: "Numbers") -> "Indices":
    """Return the kind of each cell of a column."""
    import numpy

    kinds = numpy.full(len(column.values), _PLAIN)
    kinds[~takes(name, column.values)] = BAD
    kinds[numpy.isnan(column.values)] = _EMPTY
    if name in FOLLOWS:
        kinds[column.values == FOLLOWS[name][0]] = _SPECIAL
    kinds[[*column.odd]] = BAD
    for row, value in column.uncertain.items():
        if kinds[row] != BAD:
            kinds[row] = _MEASURED if isinstance(value, Measured) else _INTERVAL
    return kinds


def _values(column: "Numbers", rows: "Indices", kind: int) -> Any:
    """Return the values of cells of one kind: a number where more follows from it, else an array."""
    import numpy

    values = column.values if len(rows) == len(column.values) else column.values[rows]
    if kind == _SPECIAL:
        return float(values[0])
    if kind == _PLAIN:
        return values
    uncertain: list[Any] = [column.uncertain[row] for row in rows.tolist()]
    sides = {side: numpy.array([value.sides[side] for value in uncertain]) for side in uncertain[0].sides}
    return type(uncertain[0]).of(values, **sides)


# --- Reasons ----------------------------------------------------------------------------------------------------------


def lack(reasons: Reasons) -> JkrollError | None:
    """Return why a row has no contact, or is no scene; None if it has one at the middles of its inputs."""
    for name, error in reasons.items():
        has_contact = not isinstance(error, Failure) or error.kind.has_contact
        if name == ROW or (not has_contact and name in NOMENCLATURE):
            return error
    return None


def status_of(reasons: Reasons) -> str:
    """Return a phrase for each kind of reason. All inputs that quantities lack are in one."""
    lacked = (error.missing for error in reasons.values() if isinstance(error, MissingInput))
    needs = needs_in_words(dict.fromkeys(chain.from_iterable(lacked)))
    phrases = (
        needs if isinstance(error, MissingInput) and error.missing else error.phrase or str(error)
        for error in reasons.values()
    )
    return "; ".join(dict.fromkeys(phrases))


def worded(reasons: Reasons, word_of: Callable[[str], str] = str) -> str:
    """Return reasons in full; `word_of` returns the word of a quantity, by default its name."""
    if (error := lack(reasons)) is not None:
        return str(error)
    # A side of an error bar has the reason of its quantity.
    errors = {
        key if key in NOMENCLATURE else key.rpartition("_")[0]: error
        for key, error in reasons.items()
        if key != UNCERTAINTY
    }
    clauses = [f"{first_of([*map(word_of, names)])}: {reason}" for names, reason in grouped(errors)]
    clauses += [str(reasons[UNCERTAINTY])] if UNCERTAINTY in reasons else []
    return "; ".join(clauses)


# --- Counts -----------------------------------------------------------------------------------------------------------


class Tally(NamedTuple):
    """The rows of a run, and those of them that failed, have empty cells, or exceed limits."""

    rows: int = 0
    failed: int = 0
    gaps: Mapping[str, Gaps] = _NONE  # rows with empty cells, by their status
    doubts: Counter[int] = _NO_DOUBTS  # rows, by the bits of their doubts
    inferred: tuple[Any, ...] = ()  # the values of the unknown of a table, in parts
    said: tuple[str, ...] = ()  # of each table as a whole

    @classmethod
    def of(cls, columns: Columns, word_of: Callable[[str], str] = str) -> "Tally":
        """Return the counts of some rows; `word_of` as `worded` has it."""
        gaps: dict[str, Gaps] = {}
        # A code says in how many rows it ends the meaning of results.
        told = {
            number: {key: error for key, error in reasons.items() if not has_code(error)}
            for number, reasons in columns.distinct_reasons.items()
        }
        statuses = {number: status_of(reasons) for number, reasons in told.items() if reasons}
        for row, reasons in sorted(columns.reasons.items()):
            if (status := statuses.get(id(reasons))) is not None:
                rows, first, words = gaps.get(status) or (0, row + 1, worded(told[id(reasons)], word_of))
                gaps[status] = (rows + 1, first, words)
        return cls(len(columns), len(columns.failed), gaps, columns.counted_doubts)

    def plus(self, other: "Tally", table: str = "") -> "Tally":
        """Return the counts with those of some more rows, or of a table, which has a row 1 of its own."""
        gaps = dict(self.gaps)
        for status, (more, place, text) in other.gaps.items():
            rows, first, words = gaps.get(status, (0, place + (0 if table else self.rows), f"{table}{text}"))
            gaps[status] = (rows + more, first, words)
        others = [name for name in self._fields if name != "gaps"]
        sums: dict[str, Any] = {name: getattr(self, name) + getattr(other, name) for name in others}
        return Tally(gaps=gaps, **sums)

    def with_doubts(self, bits: int) -> int:
        """Return the number of rows with any of the doubts that bits stand for."""
        return sum(rows for doubts, rows in self.doubts.items() if doubts & bits)

    def counted(self, bits: int) -> list[tuple[str, int]]:
        """Return the codes that bits stand for with their numbers of rows, the most frequent first."""
        counts = {code: self.with_doubts(bit) for code, bit in BITS.items() if bit & bits}
        return [(code, rows) for code, rows in sorted(counts.items(), key=lambda item: -item[1]) if rows]
