"""The results of a frame, for one row or many: columns, uncertainties and limits, computed on demand."""

from collections.abc import Iterable, Mapping, Sequence
from functools import cached_property, reduce
from math import nan
from typing import Any, TypeGuard

from ..errors import JkrollError
from ..physics.elementary import is_anywhere, where
from ..quantities.nomenclature import NOMENCLATURE
from .column import Column, at_row, first_reasons
from .frame import Frame
from .limits import (
    ENDING,
    ENDING_MEANING,
    INEXACT,
    MEANINGFUL_BEYOND_LIMITS,
    NOT_JUDGED,
    Doubt,
    bits_of,
    concerns,
    doubts,
)
from .reasons import OF_ANOTHER_PAIR, OF_IDENTICAL_SPHERES, RESTS_ON_SPACING, EndOfMeaning, Failure, reason
from .uncertainty import ErrorBar, Sources, error_bars, no_error_bar, sources_of_results

ROW = ""  # the key of a reason that concerns the whole row


class Results:
    """The columns of quantities of a frame, with inputs, uncertainties and limits.

    Where a limit makes a result meaningless, the result has no value, unless all values are kept (unformatted output).
    """

    def __init__(self, described: Frame, computed: Mapping[str, Column], *, keeps_all: bool = False) -> None:
        """`described`: the frame; `computed`: its columns; `keeps_all`: True to keep values without a meaning.

        Uncertainties come from `described`. Limits are judged on `frame`, where every input has a value. They are the
        limits of the results, with the measured quantities in place of inferred inputs.
        """
        self.described, self.computed, self.keeps_all = described, computed, keeps_all
        self.frame = described.found
        self._ends: dict[tuple[int, ...], Any] = {}  # reasons, by the indices of limits that make results meaningless

    # --- Columns ------------------------------------------------------------------------------------------------------

    @property
    def columns(self) -> Mapping[str, Column]:
        """The columns; unless all values are kept, each value without a meaning is replaced by its reason."""
        return self.computed if self.keeps_all else self.meant

    @cached_property
    def meant(self) -> Mapping[str, Column]:
        """The columns in which each value without a meaning is replaced by its reason."""
        judged = self.described.judged
        return {name: self.without_meaning(column, judged([name])) for name, column in self.computed.items()}

    @cached_property
    def judged(self) -> Mapping[str, Column]:
        """The columns of the quantities whose limits apply to the results."""
        names = self.described.judged(self.computed)
        return {name: self.computed[name] if name in self.computed else self.frame.column(name) for name in names}

    @cached_property
    def judged_meant(self) -> Mapping[str, Column]:
        """The judged columns in which each value without a meaning is replaced by its reason."""
        meant = {}
        for name, column in self.judged.items():
            meant[name] = self.meant[name] if name in self.meant else self.without_meaning(column, [name])
        return meant

    def without_meaning(self, column: Column, names: Iterable[str]) -> Column:
        """Return a column with reasons instead of values where a limit makes one of the quantities meaningless.

        A quantity of identical spheres is also meaningless where sphere 2 differs.
        """
        if column.is_empty:
            return column
        reasons: Any = 0
        for name in names:
            reasons = first_reasons(reasons, self._ends_of(name))
            if NOMENCLATURE[name].of_identical:
                of_another_pair = where(self.frame.is_identical, 0, reason(OF_ANOTHER_PAIR))
                reasons = first_reasons(reasons, of_another_pair)
        if isinstance(reasons, int) and not reasons:
            return column
        return Column(where(reasons == 0, column.values, nan), first_reasons(column.reasons, reasons))

    def _ends_of(self, name: str) -> Any:
        """Return the reasons of rows where limits make a quantity meaningless, computed once for each set of limits."""
        ending = () if name in MEANINGFUL_BEYOND_LIMITS else self.ending
        concerned = tuple(index for index, doubt in enumerate(ending) if concerns(doubt.limit, self.frame, [name]))
        if concerned not in self._ends:
            self._ends[concerned] = reduce(first_reasons, (ending[index].ends for index in concerned), 0)
        return self._ends[concerned]

    @cached_property
    def values(self) -> dict[str, Any]:
        """The values of columns, without columns that have no value."""
        return {name: column.values for name, column in self.columns.items() if not column.is_empty}

    @cached_property
    def ended(self) -> dict[str, Any]:
        """The rows in which a value has no meaning, for each quantity that has such rows."""
        ended = {}
        for name, column in self.computed.items():
            meant = self.meant[name]
            if meant is not column:
                rows = (column.reasons == 0) & (meant.reasons != 0)
                if is_anywhere(rows):
                    ended[name] = rows
        return ended

    # --- Inputs and uncertainties -------------------------------------------------------------------------------------

    def inputs_shown(self, names: Sequence[str]) -> dict[str, Any]:
        """Return the inputs that were stated or that quantities depend on, as understood, with their uncertainties."""
        inputs = self.described.echo(self.described.inputs_used(names))
        if self.sources is not None:
            inputs |= {name: given for name, given in self.sources.given.items() if name in inputs}
        return inputs

    @cached_property
    def sources(self) -> Sources | None:
        """The sources of uncertainty of the results; None if no input is uncertain.

        Raises a JkrollError for too many ranges.
        """
        return sources_of_results(self.described, [*self.computed]) if self.described.uncertainties else None

    @cached_property
    def bars(self) -> Mapping[str, ErrorBar]:
        """The uncertainties of results, by name; results without an uncertainty are left out."""
        if self.sources is None:
            return {}
        bars = error_bars(self.described, self.values, sources=self.sources)
        return {name: bar.without(self.columns[name].reasons != 0) for name, bar in bars.items()}

    # --- Limits of the model ------------------------------------------------------------------------------------------

    @cached_property
    def ending(self) -> Sequence[Doubt]:
        """The limits that make results meaningless, judged for all columns with values."""
        known = {name: column for name, column in self.judged.items() if not column.is_empty}
        return doubts(self.frame, known, ENDING)

    @cached_property
    def validity(self) -> Sequence[Doubt]:
        """The limits of the model, each judged, or with the reason why it was not judged."""
        known = {name: column for name, column in self.judged_meant.items() if not column.is_empty}
        unjudged = [doubt for doubt in self._doubts_without_spacing if doubt.error is not None]
        return [*self.ending, *self.inexact(known), *unjudged]

    def inexact(self, columns: Mapping[str, Column]) -> list[Doubt]:
        """Return the limits that leave results meaningful, judged for columns."""
        return doubts(self.frame, columns, INEXACT)

    @cached_property
    def _doubts_without_spacing(self) -> Sequence[Doubt]:
        """The limits that leave results meaningful, judged for columns whose empty cells need an atomic spacing."""
        return self.inexact(self._without_spacing)

    @cached_property
    def _without_spacing(self) -> dict[str, Column]:
        """The columns with empty cells that need an atomic spacing, which was not given."""
        lacking = {}
        for name, column in self.judged.items():
            if self.frame.may_rest_on_spacing(name) and is_anywhere(_lacks_spacing(name, column)):
                lacking[name] = column
        return lacking

    @property
    def bits(self) -> Any:
        """The codes of exceeded limits as bits, row by row, with UNCHECKED for limits that were not judged."""
        inexact = [doubt for doubt in self.validity if not doubt.limit.ends_meaning]
        bits = bits_of(self.frame, _rows_with_values(self.judged_meant), inexact)
        rests = [(_lacks_spacing(name, column), [name]) for name, column in self._without_spacing.items()]
        unjudged = bits_of(self.frame, rests, self._doubts_without_spacing) & NOT_JUDGED
        return self._bits_of_ending | bits | unjudged

    @property
    def ending_bits(self) -> Any:
        """The codes of the exceeded limits that make results meaningless, as bits, row by row."""
        return self._bits_of_ending & ENDING_MEANING

    @property
    def _bits_of_ending(self) -> Any:
        return bits_of(self.frame, _rows_with_values(self.judged), self.ending)

    # --- Reasons ------------------------------------------------------------------------------------------------------

    def errors(self, row: int = 0) -> dict[str, JkrollError]:
        """Return the errors of a row's quantities without a value, by name; they quote values of this row.

        If no quantity applies to the row, the only key is ROW.
        """
        errors = self.described.errors(self.columns, row)
        if not errors and all(at_row(column.reasons, row) for column in self.columns.values()):  # all are hidden
            return {ROW: Failure(OF_IDENTICAL_SPHERES)}
        return errors

    def open_bars(self, row: int = 0) -> dict[str, JkrollError]:
        """Return, by name, the errors of a row's results that have no value somewhere within the uncertainties."""
        errors: dict[str, JkrollError] = {}
        for name, bar in self.bars.items():
            if at_row(bar.open_at, row):
                errors[name] = no_error_bar(self.described, name, bar, row, sources=self.sources)
        return errors


def _lacks_spacing(name: str, column: Column) -> Any:
    """Return the rows in which a quantity has no value because it depends on an assumed atomic spacing."""
    return column.reasons == reason(RESTS_ON_SPACING, name)


def _rows_with_values(columns: Mapping[str, Column]) -> list[tuple[Any, list[str]]]:
    """Return the rows in which quantities have values; quantities that share their reasons are listed together."""
    names_of: dict[int, list[str]] = {}
    for name, column in columns.items():
        if not column.is_empty:
            names_of.setdefault(id(column.reasons), []).append(name)
    return [(columns[names[0]].reasons == 0, names) for names in names_of.values()]


def is_end_of_meaning(error: JkrollError) -> TypeGuard[Failure]:
    """Return whether an error states that a number has no meaning."""
    return isinstance(error, Failure) and isinstance(error.cause, EndOfMeaning)


def has_code(error: JkrollError) -> bool:
    """Return whether the code of a doubt already reports an error."""
    return is_end_of_meaning(error) and error.cause != OF_ANOTHER_PAIR
