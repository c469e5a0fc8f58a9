"""The values of an input in a sweep. A range of more than a million values is computed where it is needed."""

from collections.abc import Sequence
from itertools import chain
from typing import Any

import numpy
import orjson

from ..quantities.ranges import Spread
from .cells import Floats, plain_numbers

KEPT = 1_000_000  # values of a range that are computed once


class Axis:
    """The values of an input: lists and ranges behind each other."""

    def __init__(self, name: str, spreads: Sequence[Spread]) -> None:
        """`name`: the input."""
        self.name = name
        self.spreads = spreads
        self.size = sum(map(len, spreads))
        self._values = numpy.array([*chain.from_iterable(spreads)]) if self.size <= KEPT else None

    def values(self, places: Any) -> Floats:
        """Return the values at some places."""
        if self._values is not None:
            found: Floats = self._values[places]
            return found
        values = numpy.empty(len(places))
        start = 0
        for spread in self.spreads:
            mine = (places >= start) & (places < start + len(spread))
            values[mine] = of_spread(spread, places[mine] - start)
            start += len(spread)
        return values


def of_spread(spread: Spread, places: Any) -> Floats:
    """Return values of a range, to 15 digits; its ends as they were given."""
    part = places / max(spread.size - 1, 1)
    if spread.is_log:
        values = spread.low ** (1 - part) * spread.high**part
    else:
        values = spread.low * (1 - part) + spread.high * part
    values = to_15_digits(values)
    values[places == 0] = spread.low
    values[places == spread.size - 1] = spread.high
    return values


def to_15_digits(values: Floats) -> Floats:
    """Return numbers rounded to 15 digits.

    >>> to_15_digits(numpy.array([0.1 + 0.2, 1e-7 / 3])).tolist()
    [0.3, 3.33333333333333e-08]
    """
    size = numpy.abs(values)
    with numpy.errstate(divide="ignore"):
        exponents = numpy.where(size > 0, numpy.floor(numpy.log10(size)), 0).astype(int)
    rounded = numpy.zeros_like(values)
    for exponent in numpy.unique(exponents).tolist():
        mine = exponents == exponent
        shift = 14 - exponent
        digits = numpy.rint(values[mine] * 10.0 ** min(shift, 300) * 10.0 ** max(shift - 300, 0)).astype(numpy.int64)
        suffix = b"e%d" % -shift
        text = orjson.dumps(digits, option=orjson.OPT_SERIALIZE_NUMPY)[1:-1].replace(b",", suffix + b",") + suffix
        found = plain_numbers(text, len(digits))
        rounded[mine] = values[mine] if found is None else found
    return rounded
