"""The results of a frame, of one row or many: columns, and what they rest on, computed when something shows it."""

from collections.abc import Iterable, Mapping, Sequence
from functools import cached_property, reduce
from math import nan
from typing import Any

from ..errors import JkrollError
from ..physics.elementary import is_anywhere, where
from ..quantities.nomenclature import NOMENCLATURE
from .column import Column, at_row, first_of
from .frame import Frame
from .limits import (
    ENDING,
    ENDING_MEANING,
    INEXACT,
    NOT_JUDGED,
    NUMBERS_OF_LIMITS,
    Doubt,
    bits_of,
    concerns,
    doubts,
)
from .reasons import OF_ANOTHER_PAIR, OF_IDENTICAL_SPHERES, RESTS_ON_SPACING, EndOfMeaning, Failure, reason
from .uncertainty import ErrorBar, Sources, error_bars, no_error_bar, sources_of_results

ROW = ""  # stands for the row as a whole, in place of the name of a quantity


class Results:
    """The columns of quantities of a frame with their inputs, error bars and limits.

    A result has no value where a limit ends its meaning, unless bare numbers are wanted.
    """

    def __init__(self, described: Frame, computed: Mapping[str, Column], *, keeps_all: bool = False) -> None:
        """`computed`: the columns; `keeps_all`: whether values without a meaning stay, as bare numbers do.

        Error bars are those of the frame that was `described`, limits are judged on the one in which all inputs have
        values: for the results, or for the measured quantities from which these were found.
        """
        self.described, self.computed, self.keeps_all = described, computed, keeps_all
        self.frame = described.found
        self._ends: dict[tuple[int, ...], Any] = {}  # reasons, by the limits that end a meaning

    # --- Columns ------------------------------------------------------------------------------------------------------

    @property
    def columns(self) -> Mapping[str, Column]:
        """The columns, in which a reason takes the place of a value without a meaning."""
        return self.computed if self.keeps_all else self.meant

    @cached_property
    def meant(self) -> Mapping[str, Column]:
        """The columns without values that have no meaning."""
        judged = self.described.judged
        return {name: self.without_meaning(column, judged([name])) for name, column in self.computed.items()}

    @cached_property
    def judged(self) -> Mapping[str, Column]:
        """The columns by whose limits those of the results are judged."""
        names = self.described.judged(self.computed)
        return {name: self.computed[name] if name in self.computed else self.frame.column(name) for name in names}

    @cached_property
    def judged_meant(self) -> Mapping[str, Column]:
        """The same without values that have no meaning."""
        return {
            name: self.meant[name] if name in self.meant else self.without_meaning(column, [name])
            for name, column in self.judged.items()
        }

    def without_meaning(self, column: Column, touching: Iterable[str]) -> Column:
        """Return a column with a reason in rows where a limit ends the meaning of some quantities."""
        reasons: Any = 0
        for touched in () if column.is_empty else touching:
            reasons = first_of(reasons, self._ends_of(touched))
            if NOMENCLATURE[touched].of_identical:
                is_of_another = where(self.frame.is_identical, 0, reason(OF_ANOTHER_PAIR))
                reasons = first_of(reasons, is_of_another)
        if isinstance(reasons, int) and not reasons:
            return column
        return Column(where(reasons == 0, column.values, nan), first_of(column.reasons, reasons))

    def _ends_of(self, name: str) -> Any:
        """Return the reasons of rows in which a limit ends the meaning of a quantity, once for the same limits."""
        ending = () if name in NUMBERS_OF_LIMITS else self.ending
        concerned = tuple(index for index, doubt in enumerate(ending) if concerns(doubt.limit, self.frame, [name]))
        if concerned not in self._ends:
            self._ends[concerned] = reduce(first_of, (ending[index].ends for index in concerned), 0)
        return self._ends[concerned]

    @cached_property
    def values(self) -> dict[str, Any]:
        """The values of the columns that have some."""
        return {name: column.values for name, column in self.columns.items() if not column.is_empty}

    @cached_property
    def ended(self) -> dict[str, Any]:
        """The rows in which a limit ends the meaning of a result, by quantity: those that have such rows."""
        both = ((name, column, self.meant[name]) for name, column in self.computed.items())
        rows = {name: (old.reasons == 0) & (new.reasons != 0) for name, old, new in both if old is not new}
        return {name: of_name for name, of_name in rows.items() if is_anywhere(of_name)}

    # --- Inputs and error bars ----------------------------------------------------------------------------------------

    def inputs_shown(self, names: Sequence[str]) -> dict[str, Any]:
        """Return the inputs that were stated or enter quantities, as they were understood, with their error bars."""
        inputs = self.described.echo(self.described.inputs_used(names))
        if self.sources is not None:
            inputs |= {name: given for name, given in self.sources.given.items() if name in inputs}
        return inputs

    @cached_property
    def sources(self) -> Sources | None:
        """The sources of uncertainty that enter; None if there are none.

        Raises a JkrollError for sources that do not go together.
        """
        return sources_of_results(self.described, [*self.computed]) if self.described.uncertainties else None

    @cached_property
    def bars(self) -> Mapping[str, ErrorBar]:
        """The error bars of values that have some, in some row."""
        if self.sources is None:
            return {}
        bars = error_bars(self.described, self.values, sources=self.sources)
        return {name: bar.without(self.columns[name].reasons != 0) for name, bar in bars.items()}

    # --- Limits of the model ------------------------------------------------------------------------------------------

    @cached_property
    def ending(self) -> Sequence[Doubt]:
        """The limits that end the meaning of results, judged for all values."""
        return doubts(self.frame, {n: column for n, column in self.judged.items() if not column.is_empty}, ENDING)

    @cached_property
    def validity(self) -> Sequence[Doubt]:
        """The limits of the model, judged for the values with a meaning, or with the reason why not."""
        known = {name: column for name, column in self.judged_meant.items() if not column.is_empty}
        unjudged = [doubt for doubt in self._of_resting if doubt.error is not None]
        return [*self.ending, *self.inexact(known), *unjudged]

    def inexact(self, columns: Mapping[str, Column]) -> list[Doubt]:
        """Return the limits that end no meaning, judged for columns."""
        return doubts(self.frame, columns, INEXACT)

    @cached_property
    def _of_resting(self) -> Sequence[Doubt]:
        """The limits that end no meaning, judged for columns that rest on the atomic spacing."""
        return self.inexact(self._resting)

    @cached_property
    def _resting(self) -> dict[str, Column]:
        """The columns that have no value in some rows, as they rest on the atomic spacing, which was not given."""
        return {
            name: column
            for name, column in self.judged.items()
            if self.frame.may_rest_on_spacing(name) and is_anywhere(column.reasons == reason(RESTS_ON_SPACING, name))
        }

    @property
    def bits(self) -> Any:
        """The codes of the limits that do not hold as bits, by row; UNCHECKED is one of them."""
        inexact = [doubt for doubt in self.validity if not doubt.limit.ends_meaning]
        bits = bits_of(self.frame, _rows_with_values(self.judged_meant), inexact)
        every = self._resting.items()
        rests = [(column.reasons == reason(RESTS_ON_SPACING, name), [name]) for name, column in every]
        return self._bits_of_ending | bits | bits_of(self.frame, rests, self._of_resting) & NOT_JUDGED

    @property
    def ending_bits(self) -> Any:
        """The codes of the limits that end the meaning of results as bits, by row."""
        return self._bits_of_ending & ENDING_MEANING

    @property
    def _bits_of_ending(self) -> Any:
        return bits_of(self.frame, _rows_with_values(self.judged), self.ending)

    # --- Reasons ------------------------------------------------------------------------------------------------------

    def errors(self, row: int = 0) -> dict[str, JkrollError]:
        """Return why quantities have no value in a row, by name, with the numbers of this row.

        ROW stands for all of them, where none concerns the row.
        """
        errors = self.described.errors(self.columns, row)
        if not errors and all(at_row(column.reasons, row) for column in self.columns.values()):  # all are hidden
            return {ROW: Failure(OF_IDENTICAL_SPHERES)}
        return errors

    def open_bars(self, row: int = 0) -> dict[str, JkrollError]:
        """Return why values have no error bar in a row, as there is no value at an end of an input."""
        return {
            name: no_error_bar(self.described, name, bar, row, sources=self.sources)
            for name, bar in self.bars.items()
            if at_row(bar.place, row)
        }


def _rows_with_values(columns: Mapping[str, Column]) -> list[tuple[Any, list[str]]]:
    """Return the rows in which quantities have values, once for those that have the same reasons."""
    names_of: dict[int, list[str]] = {}
    for name, column in columns.items():
        if not column.is_empty:
            names_of.setdefault(id(column.reasons), []).append(name)
    return [(columns[names[0]].reasons == 0, names) for names in names_of.values()]


def is_end_of_meaning(error: JkrollError) -> bool:
    """Return whether an error is the reason of a result that has a number without a meaning."""
    return isinstance(error, Failure) and isinstance(error.cause, EndOfMeaning)


def has_code(error: JkrollError) -> bool:
    """Return whether a code among the doubts says the same as an error."""
    return is_end_of_meaning(error) and error.args[0] != OF_ANOTHER_PAIR
