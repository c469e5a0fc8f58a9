"""Lists and ranges of values, as users type them: 1nm,1um and 1nm:1um:50."""

import re
from collections.abc import Iterator
from typing import Self

from .nomenclature import INFINITY, NOMENCLATURE
from .values import NO_UNIT, QuantityError, Uncertain, is_uncertain, middle, parse_quantity, to_15_digits, value_of

MAX_VALUES = 1_000_000_000


class Spread:
    """The values of a range, or a single value, which may be uncertain."""

    def __init__(
        self, low: float, high: float, size: int = 1, *, is_log: bool = False, uncertain: Uncertain | None = None
    ) -> None:
        """`size` values from `low` to `high`, in equal ratios if `is_log` and otherwise in equal steps.

        `uncertain`: a single value with its uncertainty.
        """
        self.low, self.high, self.size, self.is_log, self.uncertain = low, high, size, is_log, uncertain

    @classmethod
    def of(cls, value: float | Uncertain) -> Self:
        """Return a single value as a spread."""
        number = middle(value)
        return cls(number, number, uncertain=value if is_uncertain(value) else None)

    def __len__(self) -> int:
        return self.size

    def __iter__(self) -> Iterator[float | Uncertain]:
        return map(self.at, range(self.size))

    def at(self, index: int) -> float | Uncertain:
        """Return the value at an index, with its uncertainty if it has one."""
        return self.value(index) if self.uncertain is None else self.uncertain

    def value(self, index: int) -> float:
        """Return the number at an index, rounded to 15 digits: four values from 1e-9 to 1e-6 include 1e-8 and 1e-7."""
        if index == 0:
            return self.low
        if index == self.size - 1:
            return self.high
        share = index / (self.size - 1)
        if self.is_log:
            return to_15_digits(self.low * (self.high / self.low) ** share)
        value = self.low * (1 - share) + self.high * share
        is_rounding_error = abs(value) < 1e-15 * max(abs(self.low), abs(self.high))
        return 0.0 if is_rounding_error else to_15_digits(value)


_LIST_OR_NUMBER = r"[+-]?[0-9]+,[0-9]+|[+-]?[0-9]{1,3}(?:,[0-9]{3})+"  # 1,5 and 2,500,000 may be either


def spreads_of(text: str, name: str) -> list[Spread]:
    """Return the comma-separated items of a text: values, and ranges `FROM:TO:COUNT`, perhaps with `:lin` or `:log`.

    >>> [*spreads_of("1nm:1um:4", "radius")[0]]
    [1e-09, 1e-08, 1e-07, 1e-06]
    """
    if NOMENCLATURE[name].unit == "1" and "," in text and re.fullmatch(_LIST_OR_NUMBER, text.strip()):
        remedy = "for a list, write decimal points, as in 1.0,5.0; for a single number, write 1.5 or 2500"
        raise QuantityError(name, text, "may be a list or a number with a comma", remedy)
    items = text.split(",")
    try:
        return [_spread(item, name) for item in items]
    except QuantityError as error:
        if error.mistake == NO_UNIT and len(items) > 1:
            mistake = f"has a number without a unit, {error.value}"
            raise QuantityError(name, text, mistake, "a list has units, and a decimal mark is a point") from None
        if error.mistake == NO_UNIT and ":" in text:
            raise QuantityError(name, text, "needs a unit at both ends") from None
        raise


def _spread(text: str, name: str) -> Spread:
    """Return the value of a text, with its uncertainty if it states one, or the range of a text with colons."""
    if ":" in text:
        return between(*text.split(":"), name=name, text=text)
    return Spread.of(value_of(text, name))


def between(first: str, last: str, count: str = "", scale: str = "", *more: str, name: str, text: str) -> Spread:
    """Return the range between two values. `text`: the whole text, for errors.

    The values have equal ratios with the scale "log" and equal differences with "lin". Without a scale they have equal
    ratios if both ends are positive, and otherwise equal differences.
    """
    if more or not (count.isascii() and count.isdigit()) or scale not in ("", "log", "lin"):
        raise QuantityError(name, text, "is not a range", "write FROM:TO:COUNT, as 1nm:1um:7, and :lin for equal steps")
    if len(count) > 10 or not 2 <= int(count) <= MAX_VALUES:
        raise QuantityError(name, text, f"needs a count from 2 to {MAX_VALUES}")
    low, high = parse_quantity(first, name), parse_quantity(last, name)
    is_positive = low > 0 and high > 0
    if scale == "log" and not is_positive:
        raise QuantityError(name, text, "has an end that is not positive", "leave :log out: the steps are equal then")
    if max(abs(low), abs(high)) == INFINITY:
        raise QuantityError(name, text, "has an infinite end; a range needs two finite ends")
    return Spread(low, high, int(count), is_log=is_positive and scale != "lin")
