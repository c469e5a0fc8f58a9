"""Texts of users: one value, which may have an uncertainty, and lists and ranges of values: "1nm,1um" and "1nm:1um:50"."""

from collections.abc import Iterator
from typing import TYPE_CHECKING

from .errors import BareNumber, QuantityError
from .nomenclature import INFINITY
from .parsing import has_uncertainty, parse_quantity

if TYPE_CHECKING:
    from .uncertain import Uncertain

MAX_VALUES = 1_000_000_000


class Spread:
    """A range of values, or a single value, which may be uncertain."""

    uncertainty: "Uncertain | None" = None

    def __init__(self, low: float, high: float, size: int = 1, *, is_log: bool = False) -> None:
        """Take `size` values from `low` to `high`, in equal steps or in equal ratios."""
        self.low, self.high, self.size, self.is_log = low, high, size, is_log

    def __len__(self) -> int:
        return self.size

    def __iter__(self) -> "Iterator[float | Uncertain]":
        return iter([self.uncertainty]) if self.uncertainty is not None else map(self.value, range(self.size))

    def value(self, place: int) -> float:
        """Return the value at a place, rounded to 15 digits: the values between 1e-9 and 1e-6 are then 1e-8 and 1e-7 themselves."""
        if place in (0, self.size - 1):
            return self.high if place else self.low
        part = place / (self.size - 1)
        if not self.is_log:
            value = self.low * (1 - part) + self.high * part
        elif 0 < (ratio := self.high / self.low) < INFINITY:
            value = self.low * ratio**part
        else:
            value = self.low ** (1 - part) * self.high**part
        is_nothing = abs(value) < 1e-15 * max(abs(self.low), abs(self.high)) and not self.is_log
        return 0.0 if is_nothing else float(f"{value:.15g}")


def value_of(text: str, name: str) -> "float | Uncertain":
    """Read one value of a quantity of the nomenclature, with its uncertainty if the text states one, in SI units."""
    if not has_uncertainty(text):
        return parse_quantity(text, name)
    from .uncertain import parse_uncertain

    return parse_uncertain(text, name)


def spreads_of(text: str, name: str) -> list[Spread]:
    """Read values separated by commas, and ranges `FROM:TO:COUNT`, with `:lin` or `:log` at the end or not.

    >>> [*spreads_of("1nm:1um:4", "radius")[0]]
    [1e-09, 1e-08, 1e-07, 1e-06]
    """
    spreads: list[Spread] = []
    items = text.split(",")
    for item in items:
        try:
            if ":" in item:
                spreads.append(_range(item, name))
            else:
                spreads.append(_single(item, name))
        except BareNumber:
            if len(items) > 1:
                reason = "has a comma where a number has a point, or a number without a unit"
                raise QuantityError(name, text, reason) from None
            raise
    return spreads


def _single(text: str, name: str) -> Spread:
    """Read a value, with its uncertainty if it states one."""
    found = value_of(text, name)
    if isinstance(found, float):
        return Spread(found, found)
    spread = Spread(found.value, found.value)
    spread.uncertainty = found
    return spread


def _range(text: str, name: str) -> Spread:
    """Read a range."""
    first, last, *rest = text.split(":")
    if not 1 <= len(rest) <= 2:
        raise QuantityError(name, text, "is not a range", "write FROM:TO:COUNT, with :lin for equal steps")
    return between(first, last, *rest, name=name, text=text)


def between(first: str, last: str, count: str, scale: str = "", *, name: str, text: str) -> Spread:
    """Return the range between two values; an error quotes its text.

    Without a scale, "lin" or "log", the steps are of equal ratios, or equal if an end is not positive.
    """
    if not (count.isascii() and count.isdigit()) or scale not in ("", "log", "lin"):
        raise QuantityError(name, text, "is not a range", "write FROM:TO:COUNT, with :lin for equal steps")
    if len(count) > 10 or not 2 <= (size := int(count)) <= MAX_VALUES:
        raise QuantityError(name, text, f"needs a count from 2 to {MAX_VALUES}")
    low, high = parse_quantity(first, name), parse_quantity(last, name)
    is_positive = low > 0 and high > 0
    if scale == "log" and not is_positive:
        raise QuantityError(name, text, "has an end that is not positive", "leave :log out: the steps are equal then")
    if max(abs(low), abs(high)) == INFINITY:
        raise QuantityError(name, text, "has no end")
    return Spread(low, high, size, is_log=is_positive and scale != "lin")
