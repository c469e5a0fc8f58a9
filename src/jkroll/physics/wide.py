"""Numbers as exact as doubles, but of any magnitude: for what lies between inputs and results that are doubles."""

import math
from typing import Any

_FAR = 1100  # powers of two by which one number does not touch another


class Wide:
    """A double times a power of two. It meets doubles in all that the formulas do.

    >>> float(Wide(2.0**-700) * 2.0**-700 / 2.0**-1000 * 2.0**500)
    1.2676506002282294e+30
    """

    __slots__ = ("exponent", "mantissa")

    def __init__(self, value: float, exponent: int = 0) -> None:
        """Of a value times two to the exponent."""
        self.mantissa, shift = math.frexp(value)
        self.exponent = exponent + shift if self.mantissa and math.isfinite(self.mantissa) else 0

    @classmethod
    def of(cls, value: Any) -> "Wide":
        """A number as a wide one."""
        return value if isinstance(value, Wide) else cls(value)

    def __float__(self) -> float:
        """The double next to it; 0 or infinite beyond the doubles."""
        try:
            return math.ldexp(self.mantissa, self.exponent)
        except OverflowError:
            return math.copysign(math.inf, self.mantissa)

    def __bool__(self) -> bool:
        return self.mantissa != 0

    def __repr__(self) -> str:
        return f"Wide({self.mantissa!r}, {self.exponent})"

    def __neg__(self) -> "Wide":
        return Wide(-self.mantissa, self.exponent)

    def __abs__(self) -> "Wide":
        return Wide(abs(self.mantissa), self.exponent)

    def __add__(self, other: Any) -> "Wide":
        wide = Wide.of(other)
        if not self or not wide:
            return self if self else wide
        exponent = max(self.exponent, wide.exponent)
        near, far = (max(value.exponent - exponent, -_FAR) for value in (self, wide))
        return Wide(math.ldexp(self.mantissa, near) + math.ldexp(wide.mantissa, far), exponent)

    def __sub__(self, other: Any) -> "Wide":
        return self.__add__(-Wide.of(other))

    def __rsub__(self, other: Any) -> "Wide":
        return self.__neg__().__add__(other)

    def __mul__(self, other: Any) -> "Wide":
        other = Wide.of(other)
        return Wide(self.mantissa * other.mantissa, self.exponent + other.exponent)

    def __truediv__(self, other: Any) -> "Wide":
        other = Wide.of(other)
        return Wide(self.mantissa / other.mantissa, self.exponent - other.exponent)

    def __rtruediv__(self, other: Any) -> "Wide":
        return Wide.of(other) / self

    __radd__, __rmul__ = __add__, __mul__

    def _excess(self, other: Any) -> float:
        """A number with the sign of the difference."""
        return self.__sub__(other).mantissa

    def __eq__(self, other: object) -> bool:
        return self._excess(other) == 0

    def __lt__(self, other: Any) -> bool:
        return self._excess(other) < 0

    def __le__(self, other: Any) -> bool:
        return self._excess(other) <= 0

    def __gt__(self, other: Any) -> bool:
        return self._excess(other) > 0

    def __ge__(self, other: Any) -> bool:
        return self._excess(other) >= 0

    __hash__ = None  # type: ignore[assignment]

    def root(self, degree: int) -> "Wide":
        """The square root or the cube root."""
        rest = self.exponent % degree
        power = math.sqrt if degree == 2 else math.cbrt
        return Wide(power(math.ldexp(self.mantissa, rest)), (self.exponent - rest) // degree)
