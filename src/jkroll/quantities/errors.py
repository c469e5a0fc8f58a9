"""Errors about the values of quantities."""

from ..errors import JkrollError
from ..text import closest, quoted
from .nomenclature import NOMENCLATURE, OPTION_WORDS, canonical, word_for_infinity
from .units import dimension_of, kind_of


class QuantityError(JkrollError):
    """Error raised when a text is not a value of the quantity that it was given for."""

    def __init__(self, name: str, text: str, reason: str, remedy: str = "") -> None:
        """`reason` follows the quoted text; `remedy` says what to type instead, by default an example of the quantity."""
        super().__init__(name, text, reason, remedy)
        self.name, self.text, self.reason, self.remedy = name, text, reason, remedy

    def problem(self) -> str:
        """Return what is wrong and what to type instead, without the name and the text."""
        return f"{self.reason}; {self.remedy or f'expected {expectation(self.name)}'}"

    def __str__(self) -> str:
        return f"{self.name}: {quoted(self.text)} {self.problem()}"


class BareNumber(QuantityError):
    """Error raised when a number has no unit where one is needed."""


class UnknownQuantity(JkrollError):
    """Error raised for a name that is not in the nomenclature."""

    def __init__(self, name: str) -> None:
        super().__init__(name)
        self.name = name

    def __str__(self) -> str:
        if self.name in NOMENCLATURE:
            return (
                f"{quoted(self.name)} is given in words and has no value to compute; jkroll quantities lists what has"
            )
        guess = _nearest(self.name)
        meant = f"did you mean {guess}? " if guess else ""
        return f"{quoted(self.name)} is not a quantity; {meant}jkroll quantities lists them"


def _nearest(word: str) -> str | None:
    """Return the quantity whose symbol is a word, whose name begins with it, or resembles it most."""
    by_symbol = (name for name, quantity in NOMENCLATURE.items() if quantity.symbol == word)
    letters = word.casefold().replace("-", "").replace("_", "")
    begun = (name for name in NOMENCLATURE if letters and name.replace("_", "").startswith(letters))
    return next(by_symbol, None) or next(begun, None) or closest(canonical(word), (*NOMENCLATURE, *OPTION_WORDS))


class OutOfRange(JkrollError):
    """Error raised when a number given to the core lies outside the range of its quantity."""

    def __init__(self, name: str, value: object, words: str) -> None:
        super().__init__(name, value, words)
        self.name, self.value, self.words = name, value, words

    def __str__(self) -> str:
        return f"{self.name}: {self.value!r} {self.words}"


def expectation(name: str) -> str:
    """Return the kind of value that a quantity takes, with an example.

    >>> expectation("radius2")
    'a length such as 1um, or plane'
    """
    quantity = NOMENCLATURE[name]
    word = word_for_infinity(name)
    example = f" such as {quantity.example}" if quantity.example else ""
    return kind_of(dimension_of(quantity.unit)) + example + (f", or {word}" if word else "")
