"""Errors about the value of a quantity, worded from the nomenclature."""

from collections.abc import Sequence

from ..errors import JkrollError
from ..text import closest, quoted, shown
from .nomenclature import NOMENCLATURE, word_for_infinity


class QuantityError(JkrollError):
    """A text that is not a value of the quantity it was given for."""

    def __init__(self, name: str, text: str, *details: object) -> None:
        super().__init__(name, text, *details)
        self.name = name
        self.text = text

    def problem(self) -> str:
        """What is wrong, to stand behind the name and the text."""
        raise NotImplementedError

    def __str__(self) -> str:
        return f"{self.name}: {quoted(self.text)} {self.problem()}"


class MalformedQuantity(QuantityError):
    """A text outside the grammar, or a value outside the range."""

    def __init__(self, name: str, text: str, reason: str) -> None:
        super().__init__(name, text, reason)
        self.reason = reason

    def problem(self) -> str:
        """The reason, and what was expected."""
        return f"{self.reason}; expected {expectation(self.name)}"


class BareNumber(QuantityError):
    """A number where a unit is needed."""

    def problem(self) -> str:
        """What was expected."""
        return f"has no unit; expected {expectation(self.name)}"


class AmbiguousUnit(QuantityError):
    """A product after a division, which people read in two ways."""

    def __init__(self, name: str, text: str, before: str, after: str) -> None:
        super().__init__(name, text, before, after)
        self.before, self.after = before, after

    def problem(self) -> str:
        """Both readings."""
        before, after = shown(self.before), shown(self.after)
        return f"can be read as {before}*{after} or as {before}/{after}; write the one that is meant"


class UnknownUnit(QuantityError):
    """A unit name that neither the shipped table nor pint knows."""

    def __init__(self, name: str, text: str, unit: str) -> None:
        super().__init__(name, text, unit)
        self.unit = unit

    def problem(self) -> str:
        """What the unit probably is, or what was expected."""
        guess = unit_like(self.unit, self.name)
        return f"has an unknown unit {quoted(self.unit)}; " + (
            f"did you mean {guess}?" if guess else f"expected {expectation(self.name)}"
        )


class WrongDimension(QuantityError):
    """A quantity of another kind."""

    def __init__(self, name: str, text: str, dimension: Sequence[int]) -> None:
        super().__init__(name, text, tuple(dimension))
        self.dimension = tuple(dimension)

    def problem(self) -> str:
        """What it is, and what was expected."""
        from .units import kind_of

        return f"is {kind_of(self.dimension)}; expected {expectation(self.name)}"


class UnknownQuantity(JkrollError):
    """A name that is not in the nomenclature."""

    def __init__(self, name: str) -> None:
        super().__init__(name)
        self.name = name

    def __str__(self) -> str:
        from ..text import closest

        by_option = (name for name, quantity in NOMENCLATURE.items() if quantity.option == f"--{self.name}")
        guess = next(by_option, None) or closest(self.name, NOMENCLATURE)
        return f"{quoted(self.name)} is not a quantity" + (f"; did you mean {guess}?" if guess else "")


class OutOfRange(JkrollError):
    """A value given to the core, as a number, that its quantity cannot have."""

    def __init__(self, name: str, value: object, words: str) -> None:
        super().__init__(name, value, words)
        self.name, self.value, self.words = name, value, words

    def __str__(self) -> str:
        return f"{self.name}: {self.value!r} {self.words}"


def expectation(name: str) -> str:
    """What should have stood there: "a length such as 100nm"."""
    from .units import dimension_of, kind_of

    quantity = NOMENCLATURE[name]
    word = word_for_infinity(name)
    example = f" such as {quantity.example}" if quantity.example else ""
    return kind_of(dimension_of(quantity.unit)) + example + (f", or {word}" if word else "")


def unit_like(word: str, name: str) -> str | None:
    """The unit that a mistyped one for this quantity probably is, one of the quantity's own dimension if possible.

    >>> unit_like("Gpa", "youngs_modulus")
    'GPa'
    """
    from .nomenclature import NOMENCLATURE
    from .unit_table import PLAIN, PREFIXABLE, PREFIXES
    from .units import dimension_of

    wanted = dimension_of(NOMENCLATURE[name].unit) if name in NOMENCLATURE else None
    everything = {unit: dimension for unit, (_, _, dimension) in {**PREFIXABLE, **PLAIN}.items()}
    everything |= {
        prefix + unit: dimension
        for unit, (_, _, dimension) in PREFIXABLE.items()
        for prefix in PREFIXES
        if (len(prefix) > 2) == (len(unit) > 3)
    }
    fitting = [unit for unit, dimension in everything.items() if dimension == wanted]
    return closest(word, fitting, 0.5) or closest(word, everything, 0.5)
