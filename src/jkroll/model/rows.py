"""The columns of rows: values, uncertainties, doubts as bits, and the reasons for empty cells.

Rows with the same given inputs form one frame of arrays. In a short list, each row is a frame of numbers.
"""

from collections import Counter
from collections.abc import Callable, Collection, Iterable, Iterator, Mapping, Sequence
from contextlib import suppress
from functools import cached_property, reduce
from itertools import chain
from math import nan
from operator import or_
from types import MappingProxyType
from typing import TYPE_CHECKING, Any, NamedTuple, Protocol

from ..errors import BadRequest, JkrollError
from ..quantities.nomenclature import NOMENCLATURE
from ..quantities.values import Measured, Uncertain, is_uncertain
from ..text import first_of, listed
from .accepted import takes
from .column import Column, at_row
from .estimate import BEST_BY, BEST_KEYS, estimates
from .frame import FOLLOWS, Frame
from .limits import EVERY_DOUBT, LAW, NOT_JUDGED
from .reasons import HIDDEN, Failure, MissingInput, grouped, needs_in_words, reason
from .results import ROW, Results, is_end_of_meaning
from .uncertainty import ErrorBar, number_of_points, sources_of_results

if TYPE_CHECKING:
    import numpy

    Indices = numpy.ndarray[tuple[int, ...], numpy.dtype[numpy.int64]]
else:
    Indices = Any  # numpy is imported only for arrays

BLOCK = 5 << 10  # rows computed together: enough to outweigh numpy's overhead, few enough for the cache
AT_ONCE = 1 << 15  # most elements in one frame: rows times points of uncertain inputs
SIDES = ("minus", "plus", "low", "high")  # minus and plus of a standard uncertainty, low and high of a range
_MOST = 1 << 62  # largest integer for keys in an array
BAD = -1  # the mark of a row or cell that no frame of arrays accepts
# Marks of cells; other values follow from that of a special cell, such as an infinite radius2.
_EMPTY, _PLAIN, _SPECIAL, _MEASURED, _INTERVAL = range(5)
DOUBT = "doubt"  # the column with the codes of exceeded limits
STATUS = "status"  # the column with reasons
UNCERTAINTY = "±"  # the key of a reason about uncertainties
_WITH_TEXTS = {DOUBT, STATUS, *(name for name, quantity in NOMENCLATURE.items() if quantity.is_word)}
Reasons = Mapping[str, JkrollError]  # for the empty cells of a row, by column


class Wanted:
    """The columns to compute for rows, chosen before any value is computed."""

    def __init__(
        self,
        names: Sequence[str],
        named: Collection[str] = (),  # quantities asked for by name, shown in every row
        inputs: Sequence[str] = (),  # columns of inputs, before the quantities
        sides: Collection[str] | None = None,  # the sides of uncertainties that have columns; None: no uncertainties
        doubts: bool = True,  # judge the limits
        best: Sequence[str] = (),  # quantities with columns of their best range
        keeps_all: bool = False,  # keep numbers without a meaning
    ) -> None:
        self.names, self.named, self.inputs, self.sides = names, named, inputs, sides
        self.doubts, self.best, self.keeps_all = doubts, best, keeps_all

    def with_best(self, names: Collection[str]) -> "Wanted":
        """Return these columns with the best ranges of some quantities."""
        best = [name for name in self.names if name in names]
        return Wanted(self.names, self.named, self.inputs, self.sides, self.doubts, best, self.keeps_all)

    @cached_property
    def keys(self) -> tuple[str, ...]:
        """The keys of all columns of numbers."""
        return tuple(chain.from_iterable(map(self.keys_of, self.names)))

    def keys_of(self, name: str) -> list[str]:
        """Return the keys of the columns of a quantity: value, uncertainties and best range."""
        return [name, *self.sides_of(name).values(), *self.best_of(name)]

    def sides_of(self, name: str) -> dict[str, str]:
        """Return the keys of the columns of an uncertainty, by side: "radius_minus"."""
        return {side: f"{name}_{side}" for side in SIDES if side in (self.sides or ())}

    def best_of(self, name: str) -> list[str]:
        """Return the keys of the columns of a best range: its two ends, and the rule that gives it."""
        return [name + suffix for suffix in BEST_KEYS] if name in self.best else []

    def heads(self, header: Callable[[str], str]) -> list[str]:
        """Return the headers of all columns, such as "radius_minus [nm]"; `header` returns the header of a quantity."""
        heads = []
        for name in self.names:
            for key in self.keys_of(name):
                heads.append(key if key.endswith(BEST_BY) else header(name).replace(name, key, 1))
        return heads

    def last_keys(self, *, doubt: bool = True) -> tuple[str, ...]:
        """Return the keys of the last columns: codes and reasons. `doubt`: include codes, if limits are judged."""
        return (DOUBT, STATUS) if doubt and self.doubts else (STATUS,)

    @property
    def reported_doubts(self) -> int:
        """The bits of doubts to report, without UNCHECKED.

        A table with best ranges reports codes of the law only if the law was given.
        """
        left_out = NOT_JUDGED
        if self.best and "model" not in self.inputs:
            left_out |= LAW.bits
        return EVERY_DOUBT & ~left_out

    # --- Results ------------------------------------------------------------------------------------------------------

    def results(self, frame: Frame) -> Results:
        """Return the results of a frame."""
        return Results(frame, frame.shown(self.names, self.named), keeps_all=self.keeps_all)

    def points(self, frame: Frame) -> int:
        """Return the number of points of uncertain inputs at which rows are computed."""
        return number_of_points(frame, self.names) if self.sides is not None and frame.uncertainties else 1

    def has_bars(self, results: Results) -> bool:
        """Return whether the uncertainties of results have columns."""
        return self.sides is not None and results.sources is not None and results.sources.sides <= {*self.sides}

    def bars_left_out(self, results: Results) -> BadRequest | None:
        """Return the error for results whose uncertainties have no columns; None for other results."""
        if self.sides is None or results.sources is None or self.has_bars(results):
            return None
        problem = "error bars are left out, as the table has no columns for them; --uncertainty adds these"
        return BadRequest(f"{listed(results.sources.given)}: {problem}", "error bars left out")


def has_texts(head: str) -> bool:
    """Return whether a column has texts instead of numbers, by its header.

    >>> has_texts("material"), has_texts("radius [m]"), has_texts("n_grav_best_by")
    (True, False, True)
    """
    return head in _WITH_TEXTS or head.endswith(BEST_BY)


def sides_in(groups: Iterable[tuple[Frame, Sequence[str]]]) -> set[str]:
    """Return the sides of the uncertainties of quantities; `groups`: frames, each with its quantities.

    Raises a JkrollError for too many ranges.
    """
    sides: set[str] = set()
    for frame, names in groups:
        if frame.uncertainties:
            sides |= sources_of_results(frame, names).sides
    return sides


class Gap(NamedTuple):
    """Rows whose empty cells have the same reasons."""

    phrase: str  # in the status column
    faults: str  # the keys by which a note counts rows, see `JkrollError.fault`; a phrase may have several
    is_failed: bool  # True for rows without a contact, or without any value
    first: int  # the index of the first row
    reasons: Reasons  # the reasons of the first row


class Columns:
    """The columns of rows: arrays, or lists for few rows. Writers index columns and iterate over them."""

    def __init__(self, wanted: Wanted, size: int, *, few: bool) -> None:
        """`few`: True for columns as lists, which do not need numpy."""
        self.wanted, self.few = wanted, few
        self.inputs: dict[str, Any] = {name: [None] * size for name in wanted.inputs}
        if few:
            self.numbers: Any = [[nan] * size for _ in wanted.keys]  # one column for each key
            self.doubts: Any = [0] * size  # as bits
            self._gap_of: Any = [0] * size  # the number of each row's gap, from 1; 0 for no gap
        else:
            import numpy

            self.numbers = numpy.full((len(wanted.keys), size), nan)
            self.doubts, self._gap_of = numpy.zeros((2, size), dtype=numpy.int64)
        self.gaps: list[Gap] = []
        self._gap_numbers: dict[tuple[str, str, bool], int] = {}

    def __len__(self) -> int:
        """Return the number of rows."""
        return len(self.doubts)

    def column(self, key: str) -> Any:
        """Return the numbers of a column."""
        return self.numbers[self.wanted.keys.index(key)]

    # --- Storing results ----------------------------------------------------------------------------------------------

    def put(self, rows: Any, results: Results) -> None:
        """Store the results of a frame. `rows`: an array with the indices of its rows, or the index of a single row."""
        wanted = self.wanted
        span = slice(None) if not isinstance(rows, int) and len(rows) == len(self) else rows  # a slice is faster
        bars = results.bars if wanted.has_bars(results) else {}
        for name, column in results.columns.items():
            self.column(name)[span] = column.values
        for name, estimate in estimates(results, wanted.best).items():
            for key, part in zip(wanted.best_of(name), estimate, strict=True):
                self.column(key)[span] = part
        for name, bar in bars.items():
            for side, of_side in wanted.sides_of(name).items():
                if side in bar.sides:
                    self.column(of_side)[span] = bar.sides[side]
        if wanted.inputs:
            self._put_inputs(rows, results.inputs_shown(wanted.names))
        if wanted.doubts:
            self.doubts[span] = results.bits
        elif not wanted.keeps_all:
            self.doubts[span] = results.ending_bits
        self._put_gaps(rows, results, bars)

    def refuse(self, row: int, error: JkrollError) -> None:
        """Store the error of a row without a frame."""
        self._put_gap(row, {ROW: error}, is_failed=True)

    def _put_inputs(self, rows: Any, inputs: Mapping[str, Any]) -> None:
        """Store the inputs of a frame, with their uncertainties."""
        for name in self.inputs.keys() & inputs.keys():
            if isinstance(rows, int):
                self.inputs[name][rows] = inputs[name]
            elif len(rows) == len(self):
                self.inputs[name] = _in_each_row(inputs[name], len(rows))
            else:
                for row, cell in zip(rows.tolist(), as_list(_in_each_row(inputs[name], len(rows))), strict=True):
                    self.inputs[name][row] = cell

    def _put_gaps(self, rows: Any, results: Results, bars: Mapping[str, ErrorBar]) -> None:
        """Store the reasons for empty cells of a frame, once for all rows with the same reasons."""
        columns = [results.columns.get(name, _HIDDEN) for name in self.wanted.names]
        numbers = [column.reasons for column in columns] + [bar.open_at for bar in bars.values()]
        distinct = {id(number): number for number in numbers}.values()  # many columns share their reasons
        arrays = [number for number in distinct if not isinstance(number, int)]
        left_out = self.wanted.bars_left_out(results)
        is_in_all_rows = left_out is not None or any(number for number in distinct if isinstance(number, int))
        if not arrays and not is_in_all_rows:
            return
        parts = {0: rows}  # the indices of rows with the same reasons, by the position of the first one in the frame
        if not isinstance(rows, int):
            import numpy

            with_gaps = numpy.arange(len(rows)) if is_in_all_rows else reduce(or_, arrays).nonzero()[0]
            parts = {int(part[0]): rows[part] for part in alike(with_gaps, arrays)}
        for row, indices in parts.items():
            reasons = results.errors(row)
            if bars:
                reasons |= results.open_bars(row)
            if left_out is not None:
                reasons[UNCERTAINTY] = left_out
            if reasons:
                self._put_gap(indices, reasons, is_failed=all(at_row(column.reasons, row) for column in columns))

    def _put_gap(self, rows: Any, reasons: Reasons, *, is_failed: bool) -> None:
        """Store the reasons of rows. `is_failed`: True if these rows have no value."""
        first = rows if isinstance(rows, int) else int(rows[0])
        has_number = any(map(is_end_of_meaning, reasons.values()))  # a row of numbers without a meaning has not failed
        is_failed = error_of_row(reasons) is not None or (is_failed and not has_number)
        gap = Gap(status_of(reasons), faults_of(reasons), is_failed, first, reasons)
        number = self._gap_numbers.setdefault((gap.phrase, gap.faults, gap.is_failed), len(self.gaps) + 1)
        if number > len(self.gaps):
            self.gaps.append(gap)
        elif first < self.gaps[number - 1].first:
            self.gaps[number - 1] = gap
        self._gap_of[rows] = number

    def leave_out_bars(self, rows: Mapping[int, JkrollError]) -> None:
        """Empty the uncertainties of some rows, except rows without a contact or a frame. `rows`: the reason by row."""
        keys: list[str] = []
        for name in self.wanted.names:
            keys += self.wanted.sides_of(name).values()
        for row, error in rows.items():
            gap = self.gap_of(row)
            reasons: Reasons = {} if gap is None else gap.reasons
            if error_of_row(reasons) is None:
                is_failed = gap is not None and gap.is_failed
                self._put_gap(row, {**reasons, UNCERTAINTY: error}, is_failed=is_failed)
                for key in keys:
                    self.column(key)[row] = nan

    # --- Gaps and doubts ----------------------------------------------------------------------------------------------

    def gap_of(self, row: int) -> Gap | None:
        """Return the gap of a row, or None."""
        number = int(self._gap_of[row])
        return self.gaps[number - 1] if number else None

    @property
    def status(self) -> list[str | None] | None:
        """The phrase of each row with empty cells, None for other rows; None if there are no such rows."""
        phrases = [None, *(gap.phrase for gap in self.gaps)]
        return [phrases[number] for number in as_list(self._gap_of)] if self.gaps else None

    @property
    def counted_gaps(self) -> list[tuple[Gap, int]]:
        """The gaps with their numbers of rows, in order of the first row."""
        if not self.gaps:
            return []
        counts = Counter(as_list(self._gap_of))
        counted = [(gap, counts[number]) for number, gap in enumerate(self.gaps, 1) if counts[number]]
        return sorted(counted, key=lambda gap_and_number: gap_and_number[0].first)

    @property
    def first_failed(self) -> Gap | None:
        """The gap of the first row without a contact, or without any value; None if there is none."""
        return next((gap for gap, _ in self.counted_gaps if gap.is_failed), None)

    @cached_property
    def distinct_doubts(self) -> tuple[Any, Any, Any]:
        """The distinct values of the doubts as bits, the index of each row among them, and their numbers of rows."""
        import numpy

        return numpy.unique(self.doubts, return_inverse=True, return_counts=True)

    @property
    def counted_doubts(self) -> Counter[int]:
        """The numbers of rows, by the bits of their doubts."""
        if self.few:
            return Counter(self.doubts)
        distinct, _, counts = self.distinct_doubts
        return Counter(dict(zip(distinct.tolist(), counts.tolist(), strict=True)))


_HIDDEN = Column(nan, reason(HIDDEN))


def _in_each_row(value: Any, size: int) -> Any:
    """Return a column with the value of an input in each row, with its uncertainty."""
    if isinstance(value, str):
        return [value] * size
    import numpy

    if not is_uncertain(value):
        return numpy.broadcast_to(numpy.asarray(value, dtype=float), size)
    numbers = numpy.broadcast_to(value.value, size).tolist()
    sides = {side: numpy.broadcast_to(end, size).tolist() for side, end in value.sides.items()}
    return [
        type(value).of(number, **{side: ends[row] for side, ends in sides.items()})
        for row, number in enumerate(numbers)
    ]


def of_single_row(wanted: Wanted, results: Results) -> Columns:
    """Return the columns of a single row."""
    columns = Columns(wanted, 1, few=True)
    columns.put(0, results)
    return columns


def as_list(column: Any) -> list[Any]:
    """Return the values of a column, an array or a list, as a list."""
    return column if isinstance(column, list) else column.tolist()


# --- Blocks -----------------------------------------------------------------------------------------------------------


class Numbers(NamedTuple):
    """A column of SI values, nan for empty cells.

    `odd`: the rows of cells that are not numbers; `uncertain`: the uncertain values, by row.
    """

    values: Any
    odd: Sequence[int] = ()
    uncertain: Mapping[int, Uncertain] = MappingProxyType({})


class Block(Protocol):
    """Rows to compute together, from a list or from a table."""

    size: int
    numbers: Mapping[str, Numbers]  # by input
    marks: Sequence[Any]  # arrays of integers, equal in rows with the same law or solid; BAD for refused rows

    def frame(self, given: Mapping[str, Any], rows: Indices) -> Any:
        """Return the frame of some rows of a group. Raises a JkrollError if a row does not fit into a frame."""

    def frame_of(self, row: int) -> Any:
        """Return the frame of a single row. Raises the error of the row."""


def evaluated(wanted: Wanted, block: Block) -> Columns:
    """Return the columns of a block. A row without a frame has its error as the reason for all cells."""
    import numpy

    columns = Columns(wanted, block.size, few=False)
    is_left = numpy.ones(block.size, dtype=bool)  # rows to compute one at a time, so that each has its own error
    for group in groups(block):
        with suppress(JkrollError):
            frame, size = block.frame(group.given(group.rows), group.rows), len(group.rows)
            at_once = max(1, min(size, AT_ONCE // wanted.points(frame)))
            for start in range(0, size, at_once):
                rows = group.rows[start : start + at_once]
                with suppress(JkrollError):
                    part = frame if at_once == size else block.frame(group.given(rows), rows)
                    columns.put(rows, wanted.results(part))
                    is_left[rows] = False
    put_single_rows(columns, block.frame_of, numpy.flatnonzero(is_left).tolist())
    return columns


def put_single_rows(columns: Columns, frame_of: Callable[[int], Any], rows: Iterable[int]) -> None:
    """Store rows one at a time; each has a frame or an error."""
    for row in rows:
        try:
            columns.put(row, columns.wanted.results(frame_of(row)))
        except JkrollError as error:
            columns.refuse(row, error)


class Group(NamedTuple):
    """Rows of a block with the same inputs."""

    rows: Indices
    columns: Mapping[str, tuple[Numbers, int]]  # the columns of inputs, each with the mark of its cells

    def given(self, rows: Indices) -> dict[str, Any]:
        """Return the inputs of some of the rows."""
        return {name: _values(column, rows, mark) for name, (column, mark) in self.columns.items()}


def groups(block: Block) -> Iterator[Group]:
    """Iterate over groups of rows with the same law and solid, and the same inputs, whose values are of one kind.

    BAD rows are left out.
    """
    import numpy

    marks = {name: _marks(name, column) for name, column in block.numbers.items()}
    columns = [*marks.values(), *block.marks]
    is_bad = reduce(or_, (of_column == BAD for of_column in columns), numpy.zeros(block.size, dtype=bool))
    for rows in alike(numpy.flatnonzero(~is_bad), columns):
        marks_of_group = {name: int(of_column[rows[0]]) for name, of_column in marks.items()}
        filled = {name: mark for name, mark in marks_of_group.items() if mark != _EMPTY}
        yield Group(rows, {name: (block.numbers[name], mark) for name, mark in filled.items()})


def alike(rows: Indices, columns: Iterable[Any]) -> Iterator[Indices]:
    """Iterate over groups of row indices; the rows of a group have the same integers in all columns."""
    import numpy

    if not len(rows):
        return
    keys, size = numpy.zeros(len(rows), dtype=numpy.int64), 1  # a key for each row; the number of possible keys
    for column in columns:
        numbers = column[rows]
        least, most = int(numbers.min()), int(numbers.max())
        if least < most:
            span = most - least + 1
            if size * span >= _MOST:  # the keys would overflow, which is rare
                distinct, keys = numpy.unique(keys, return_inverse=True)
                size = len(distinct)
            keys, size = keys * span + (numbers - least), size * span
    if size == 1:
        yield rows
        return
    for key in numpy.unique(keys):
        yield rows[keys == key]


def _marks(name: str, column: Numbers) -> Indices:
    """Return the mark of each cell of a column."""
    import numpy

    marks = numpy.full(len(column.values), _PLAIN)
    marks[~takes(name, column.values)] = BAD
    marks[numpy.isnan(column.values)] = _EMPTY
    if name in FOLLOWS:
        marks[column.values == FOLLOWS[name][0]] = _SPECIAL
    marks[[*column.odd]] = BAD
    for row, value in column.uncertain.items():
        if marks[row] != BAD:
            marks[row] = _MEASURED if isinstance(value, Measured) else _INTERVAL
    return marks


def _values(column: Numbers, rows: Indices, mark: int) -> Any:
    """Return the values of cells with one mark: a number for a special value, else an array or an uncertain array."""
    import numpy

    values = column.values if len(rows) == len(column.values) else column.values[rows]
    if mark == _SPECIAL:
        return float(values[0])
    if mark == _PLAIN:
        return values
    uncertain: list[Any] = [column.uncertain[row] for row in rows.tolist()]
    sides = {side: numpy.array([value.sides[side] for value in uncertain]) for side in uncertain[0].sides}
    return type(uncertain[0]).of(values, **sides)


# --- Reasons ----------------------------------------------------------------------------------------------------------


def error_of_row(reasons: Reasons) -> JkrollError | None:
    """Return the error of a row that has no contact or no frame; None for other rows."""
    for name, error in reasons.items():
        has_contact = not isinstance(error, Failure) or error.cause.has_contact
        if name == ROW or (not has_contact and name in NOMENCLATURE):
            return error
    return None


def status_of(reasons: Reasons) -> str:
    """Return the phrases of reasons, each once. All missing inputs share one phrase."""
    missing = [error.missing for error in reasons.values() if isinstance(error, MissingInput)]
    needs = needs_in_words(dict.fromkeys(chain.from_iterable(missing)))
    phrases: dict[str, None] = {}
    for error in reasons.values():
        if isinstance(error, MissingInput) and error.missing:
            phrases[needs] = None
        else:
            phrases[error.phrase or str(error)] = None
    return "; ".join(phrases)


def faults_of(reasons: Reasons) -> str:
    """Return the faults of reasons, each once."""
    return "; ".join(dict.fromkeys(error.fault for error in reasons.values()))


def worded(reasons: Reasons, word_of: Callable[[str], str] = str) -> str:
    """Return reasons in full; `word_of` returns the word for a quantity, by default its name."""
    error = error_of_row(reasons)
    if error is not None:
        return str(error)
    errors = {name: error for name, error in reasons.items() if name != UNCERTAINTY}
    clauses = [f"{first_of([*map(word_of, names)])}: {explanation}" for names, explanation in grouped(errors)]
    if UNCERTAINTY in reasons:
        clauses.append(str(reasons[UNCERTAINTY]))
    return "; ".join(clauses)
