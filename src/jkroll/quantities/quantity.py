"""The record of a quantity in the nomenclature: symbol, unit, sentence, range of values, option."""

from collections.abc import Collection
from typing import Any


class Range:
    """An interval of accepted values, with the words for an error."""

    def __init__(self, low: float, high: float, low_allowed: bool, high_allowed: bool, words: str) -> None:
        self.low, self.high, self.low_allowed, self.high_allowed = low, high, low_allowed, high_allowed
        self.words = words

    def admits(self, value: Any) -> Any:
        """Return whether a number lies in the range, element by element for arrays; nan never does."""
        above = value >= self.low if self.low_allowed else value > self.low
        below = value <= self.high if self.high_allowed else value < self.high
        return above & below


ANY = Range(-float("inf"), float("inf"), True, True, "")


class Quantity:
    """The meaning of a name, and the range of its values."""

    def __init__(
        self,
        symbol: str,
        unit: str,  # SI; "1" for a number without a unit, "" for a word
        sentence: str,
        equation: str = "",  # the number of its equation in the paper
        range: Range = ANY,  # of accepted values
        infinity: str = "",  # the word for an infinite value
        option: str = "",  # the flag on the command line
        example: str = "",  # a value as typed
        note: str = "",  # a remark, such as the difference from a similar quantity
        definition: str = "",  # for one of several conventions: its formula, in the symbols of this project
        reference: str = "",  # the paper or code of a convention
        may_be_zero: bool = False,  # True if a result of exactly 0 is a value, not an underflow
        shown_with: Collection[str] = (),  # inputs; the quantity is shown only if one of them was given
        of_identical: bool = False,  # True to show the quantity for identical spheres only
        variant_of: str = "",  # the quantity for which this is an alternative formula
        sphere: int = 0,  # 1 or 2 for a quantity of one sphere
        twin: str = "",  # the same quantity of the other sphere
        default: float | None = None,  # the value of an input that is not given
    ) -> None:
        self.symbol, self.unit, self.sentence, self.equation = symbol, unit, sentence, equation
        self.range, self.infinity, self.option, self.example = range, infinity, option, example
        self.note, self.definition, self.reference, self.may_be_zero = note, definition, reference, may_be_zero
        self.shown_with, self.of_identical = shown_with, of_identical
        self.variant_of, self.sphere, self.twin, self.default = variant_of, sphere, twin, default
        self.is_word = not unit  # True for a material, for example, which is given by name

    def __repr__(self) -> str:
        return f"Quantity({self.symbol!r}, {self.unit!r}, {self.sentence!r})"
