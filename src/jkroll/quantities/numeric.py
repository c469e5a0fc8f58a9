"""Results that act as numbers: in arithmetic, comparisons and formats, in other units, and in numpy's functions."""

import operator
from collections.abc import Callable
from typing import Any

from ..errors import NoResult
from .nomenclature import NOMENCLATURE
from .units import convert, dimension_of
from .values import QuantityError, Uncertain, middle, unit_of


class NoValue(NoResult):
    """Error raised when a result without a value is used as a number."""

    def __init__(self, name: str, reason: str) -> None:
        super().__init__(name, reason)
        self.name = name

    def explanation(self) -> str:
        """Return the reason."""
        return str(self.args[1])


def _forward(operation: Callable[[Any, Any], Any]) -> Callable[[Any, Any], Any]:
    """Return the method for an operation with the result as the first operand."""

    def apply(self: Any, other: Any) -> Any:
        return operation(self.number, number_in(other))

    return apply


def _backward(operation: Callable[[Any, Any], Any]) -> Callable[[Any, Any], Any]:
    """Return the method for an operation with the result as the second operand."""

    def apply(self: Any, other: Any) -> Any:
        return operation(number_in(other), self.number)

    return apply


class Numeric:
    """A quantity that acts as its number in SI units, with its uncertainty in sums, products, quotients and `==`.

    `float`, `abs`, `round`, format specifications, `<` and `>`, and numpy's functions leave the uncertainty out.
    """

    name: str
    reason: str  # the reason for a missing value
    best: Any = None  # the best range, which even a result without a value may have

    @property
    def measure(self) -> float | Uncertain | None:
        """The value, with its uncertainty if it has one; None without a value."""
        raise NotImplementedError

    @property
    def number(self) -> Any:
        """The value, as in `measure`; raises NoValue without a value."""
        if self.measure is None:
            raise NoValue(self.name, f"{self.reason}; .best has its range" if self.best else self.reason)
        return self.measure

    def to(self, unit: str) -> Any:
        """Return the number in another unit, with its uncertainty; raise QuantityError for an unsuitable unit.

        A result of 11.78 nN gives 11.78 for "nN" and 0.01178 for "uN".
        """
        wanted, si = unit_of(unit, self.name), NOMENCLATURE[self.name].unit
        _, _, dimension = wanted
        if dimension != dimension_of(si):
            raise QuantityError(self.name, unit, "is a unit of the wrong dimension", f"it is in {si}")
        number = self.number
        if isinstance(number, Uncertain):
            return number.changed(lambda value: convert(float(value), wanted))
        return convert(float(number), wanted)

    def __float__(self) -> float:
        return float(middle(self.number))

    def __array__(self, dtype: Any = None, copy: bool | None = None) -> Any:
        import numpy

        return numpy.array(float(self), dtype=dtype)

    def __format__(self, spec: str) -> str:
        return format(float(self), spec) if spec else str(self)

    def __round__(self, digits: int | None = None) -> float:
        return round(float(self), digits)

    def __bool__(self) -> bool:
        return self.measure is not None and bool(float(self))

    def __eq__(self, other: object) -> Any:
        if isinstance(other, Numeric):
            return self.name == other.name and self.measure == other.measure
        return self.measure == other if self.measure is not None else NotImplemented

    def __hash__(self) -> int:
        return hash(self.measure)

    def __neg__(self) -> Any:
        return -self.number

    def __abs__(self) -> float:
        return abs(float(self))

    def __lt__(self, other: Any) -> Any:
        return float(self) < middle(number_in(other))

    def __le__(self, other: Any) -> Any:
        return float(self) <= middle(number_in(other))

    def __gt__(self, other: Any) -> Any:
        return float(self) > middle(number_in(other))

    def __ge__(self, other: Any) -> Any:
        return float(self) >= middle(number_in(other))

    __add__, __radd__ = _forward(operator.add), _backward(operator.add)
    __sub__, __rsub__ = _forward(operator.sub), _backward(operator.sub)
    __mul__, __rmul__ = _forward(operator.mul), _backward(operator.mul)
    __truediv__, __rtruediv__ = _forward(operator.truediv), _backward(operator.truediv)
    __pow__, __rpow__ = _forward(operator.pow), _backward(operator.pow)


def number_in(value: Any) -> Any:
    """Return the number of a result, or any other value unchanged."""
    return value.number if isinstance(value, Numeric) else value
