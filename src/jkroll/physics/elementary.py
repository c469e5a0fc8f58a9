"""Elementary functions for numbers and arrays: `math` for a number, numpy for anything else.

The type of the value decides: a float needs no import of numpy, and an array (or a pint Quantity, which follows
numpy's protocol) needs no loop. Numbers and arrays go through the same operations in the same order, and agree to the
last digit or the one before.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

if TYPE_CHECKING:  # the formulas run without numpy
    from numpy import bool_, float64
    from numpy.typing import NDArray

    FloatOrArray = float | NDArray[float64]
    Truth = bool | NDArray[bool_]
else:
    FloatOrArray = float
    Truth = bool

pi = math.pi
NUMBER = float, int  # a constant, since each call would build `float | int` anew


def sqrt(value: FloatOrArray) -> FloatOrArray:
    """Return the square root. A negative number raises ValueError; a negative element of an array gives nan."""
    if isinstance(value, NUMBER):
        return math.sqrt(value)
    import numpy

    return numpy.sqrt(value)


def cbrt(value: FloatOrArray) -> FloatOrArray:
    """Return the cube root, improved by one step of Newton's method: some C libraries are off by 3 ulp."""
    if isinstance(value, NUMBER):
        root = math.cbrt(value)
        return root - (cube(root) - value) / (3 * root * root) if root else root
    import numpy

    roots: FloatOrArray = numpy.cbrt(value)
    slopes = 3 * roots * roots
    return roots - (cube(roots) - value) / (slopes + (slopes == 0))  # the root of 0 is exact


def ln(value: FloatOrArray) -> FloatOrArray:
    """Return the natural logarithm; −∞ for 0 and for negative numbers."""
    if isinstance(value, NUMBER):
        return -math.inf if value <= 0 else math.log(value)
    import numpy

    with numpy.errstate(divide="ignore"):
        return numpy.log(numpy.maximum(value, 0.0))


def exp(value: FloatOrArray) -> FloatOrArray:
    """Return the exponential."""
    if isinstance(value, NUMBER):
        return math.exp(value)
    import numpy

    return numpy.exp(value)


def sin(value: FloatOrArray) -> FloatOrArray:
    """Return the sine."""
    if isinstance(value, NUMBER):
        return math.sin(value)
    import numpy

    return numpy.sin(value)


def log1p(value: FloatOrArray) -> FloatOrArray:
    """Return ln(1 + x), with all digits for small x."""
    if isinstance(value, NUMBER):
        return math.log1p(value)
    import numpy

    return numpy.log1p(value)


def tanh(value: FloatOrArray) -> FloatOrArray:
    """Return the hyperbolic tangent."""
    if isinstance(value, NUMBER):
        return math.tanh(value)
    import numpy

    return numpy.tanh(value)


def sinh(value: FloatOrArray) -> FloatOrArray:
    """Return the hyperbolic sine."""
    if isinstance(value, NUMBER):
        return math.sinh(value)
    import numpy

    return numpy.sinh(value)


def arsinh(value: FloatOrArray) -> FloatOrArray:
    """Return the inverse of the hyperbolic sine."""
    if isinstance(value, NUMBER):
        return math.asinh(value)
    import numpy

    return numpy.arcsinh(value)


def cube(value: FloatOrArray) -> FloatOrArray:
    """Return the third power by products, which round alike for numbers and arrays; numpy's power is 5 times slower."""
    return value * value * value


def arctan(value: FloatOrArray) -> FloatOrArray:
    """Return the inverse of the tangent."""
    if isinstance(value, NUMBER):
        return math.atan(value)
    import numpy

    return numpy.arctan(value)


def hypot(*values: FloatOrArray) -> FloatOrArray:
    """Return the root of the sum of squares."""
    if all(isinstance(value, NUMBER) for value in values):
        return math.hypot(*values)
    import numpy

    root: FloatOrArray = 0.0
    for value in values:
        root = numpy.hypot(root, value)
    return root


def absolute(value: FloatOrArray) -> FloatOrArray:
    """Return the absolute value; type checkers do not accept `abs` of a number or an array as a number."""
    return value.__abs__()


def at_least(value: FloatOrArray, bound: FloatOrArray) -> FloatOrArray:
    """Return the larger of a value and a bound, element by element for arrays."""
    if isinstance(value, NUMBER) and isinstance(bound, NUMBER):
        return max(value, bound)
    import numpy

    return numpy.maximum(value, bound)


def at_most(value: FloatOrArray, bound: FloatOrArray) -> FloatOrArray:
    """Return the smaller of a value and a bound, element by element for arrays."""
    if isinstance(value, NUMBER) and isinstance(bound, NUMBER):
        return min(value, bound)
    import numpy

    return numpy.minimum(value, bound)


def smaller_and_larger(value: FloatOrArray, value2: FloatOrArray) -> tuple[FloatOrArray, FloatOrArray]:
    """Return two values in ascending order, element by element for arrays."""
    return at_most(value, value2), at_least(value, value2)


def in_series(value: FloatOrArray, value2: FloatOrArray) -> FloatOrArray:
    """Return 1/(1/x + 1/y) of two positive values, one of which may be infinite."""
    smaller, larger = smaller_and_larger(value, value2)
    return smaller / (1 + smaller / larger)


def quotient(value: FloatOrArray, divisor: FloatOrArray, otherwise: float) -> FloatOrArray:
    """Return a quotient, and another number where the divisor is 0 or nan, element by element for arrays.

    >>> quotient(3.0, 2.0, 1.0), quotient(3.0, 0.0, 1.0)
    (1.5, 1.0)
    """
    is_known = absolute(divisor) > 0
    if is_everywhere(is_known):  # as nearly always
        return value / divisor
    return where(is_known, value / where(is_known, divisor, 1.0), otherwise)


def where(condition: Truth, value: FloatOrArray, otherwise: FloatOrArray) -> FloatOrArray:
    """Return `value` where a condition holds and `otherwise` elsewhere, element by element for arrays."""
    if isinstance(condition, bool):
        return value if condition else otherwise
    import numpy

    return numpy.where(condition, value, otherwise)


def is_everywhere(condition: Truth) -> bool:
    """Return whether a condition holds; for an array, whether it holds in every element."""
    return condition if isinstance(condition, bool) else bool(condition.all())


def is_anywhere(condition: Truth) -> bool:
    """Return whether a condition holds; for an array, whether it holds in any element."""
    return condition if isinstance(condition, bool) else bool(condition.any())


def within(condition: Truth, value: FloatOrArray) -> FloatOrArray:
    """Return a value where a condition holds. Elsewhere a number raises ValueError, and an array holds nan.

    The condition is that under which the value is defined.
    """
    if isinstance(condition, bool) and not condition:
        raise ValueError("outside the domain of the formula")
    return where(condition, value, math.nan)
