"""Columns of a frame: values, and reasons for missing values. Both are arrays, or numbers for all rows."""

from collections.abc import Mapping
from math import nan
from typing import Any, NamedTuple

from ..errors import BadRequest
from ..physics.elementary import NUMBER, is_anywhere, where
from .reasons import HIDDEN, reason


class Column(NamedTuple):
    """The values of a quantity, nan where missing, and the reasons for nan. A number stands for all rows."""

    values: Any
    reasons: Any = 0  # 0 where there is a value

    @property
    def is_empty(self) -> bool:
        """True if no row has a value, for one common reason."""
        return isinstance(self.reasons, int) and self.reasons != 0

    def or_zero(self) -> Any:
        """Return the values, with 0 in place of missing values, since every comparison with nan is False."""
        return where(self.reasons == 0, self.values, 0.0)

    def without(self, is_out: Any, number: int) -> "Column":
        """Return the column with the cells `is_out` emptied; a cell that has no reason yet gets the reason `number`."""
        if not is_anywhere(is_out):
            return self
        return Column(where(is_out, nan, self.values), first_reasons(self.reasons, where(is_out, number, 0)))

    def hidden(self, is_shown: Any) -> "Column":
        """Return the column with only the cells `is_shown`; all others get the reason HIDDEN, whatever their own."""
        if is_shown is True:
            return self
        return Column(where(is_shown, self.values, nan), where(is_shown, self.reasons, reason(HIDDEN)))


def first_reasons(reasons: Any, others: Any) -> Any:
    """Return `reasons`, with those of `others` in cells without a reason; both are arrays, or numbers for all rows."""
    if isinstance(reasons, int):
        return reasons or others
    if others is reasons or (isinstance(others, int) and not others):
        return reasons
    return where(reasons != 0, reasons, others)


def at_row(values: Any, row: int) -> Any:
    """Return the value of a column in a row as a Python number. `row`: its index."""
    return values if isinstance(values, NUMBER) else values.item(row)


def broadcast(arrays: Mapping[str, Any]) -> tuple[int, ...]:
    """Return the common shape of the arrays; raise BadRequest if they do not broadcast."""
    if not arrays:
        return ()
    import numpy

    try:
        return numpy.broadcast_shapes(*(value.shape for value in arrays.values()))
    except ValueError:
        shapes = ", ".join(f"{name} {value.shape}" for name, value in arrays.items())
        raise BadRequest(f"these arrays do not broadcast: {shapes}") from None
