"""Elementary functions for numbers and arrays: `math` for a number, numpy for anything else.

The type of the value decides, so that a float needs no import of numpy, and an array (or a pint Quantity, which follows
numpy's protocol) no loop. Both take the same operations in the same order, and agree to the last digit or the one before.
"""

import math
from typing import Any

pi = math.pi
NUMBER = float, int  # named once: `float | int` would be made anew by each call


def sqrt(value: Any) -> Any:
    """Return the square root. Of a negative number it raises ValueError; such an element of an array becomes nan."""
    if isinstance(value, NUMBER):
        return math.sqrt(value)
    import numpy

    return numpy.sqrt(value)


def cbrt(value: Any) -> Any:
    """Return the cube root, improved by one step of Newton's method: some C libraries are off by 3 ulp."""
    if isinstance(value, NUMBER):
        root = math.cbrt(value)
        return root - (cube(root) - value) / (3 * root * root) if root else root
    import numpy

    root = numpy.cbrt(value)
    slope = 3 * root * root
    return root - (cube(root) - value) / (slope + (slope == 0))  # the root of 0 is exact


def ln(value: Any) -> Any:
    """Return the natural logarithm, −∞ of 0 and of what is below it.

    >>> ln(1.0), ln(0.0)
    (0.0, -inf)
    """
    if isinstance(value, NUMBER):
        return math.log(value) if value > 0 else value if math.isnan(value) else -math.inf
    import numpy

    with numpy.errstate(divide="ignore"):
        return numpy.log(numpy.maximum(value, 0.0))


def cube(value: Any) -> Any:
    """Return the third power by products, which round alike for numbers and arrays; numpy's power is 5 times slower."""
    return value * value * value


def arctan(value: Any) -> Any:
    """Return the angle of a tangent."""
    if isinstance(value, NUMBER):
        return math.atan(value)
    import numpy

    return numpy.arctan(value)


def hypot(*values: Any) -> Any:
    """Return the root of the sum of squares."""
    if all(isinstance(value, NUMBER) for value in values):
        return math.hypot(*values)
    import numpy

    root = 0.0
    for value in values:
        root = numpy.hypot(root, value)
    return root


def at_least(value: Any, bound: Any) -> Any:
    """Return the larger of a value and a bound, element by element for arrays."""
    if isinstance(value, NUMBER) and isinstance(bound, NUMBER):
        return max(value, bound)
    import numpy

    return numpy.maximum(value, bound)


def at_most(value: Any, bound: Any) -> Any:
    """Return the smaller of a value and a bound, element by element for arrays."""
    if isinstance(value, NUMBER) and isinstance(bound, NUMBER):
        return min(value, bound)
    import numpy

    return numpy.minimum(value, bound)


def smaller_and_larger(value: Any, value2: Any) -> tuple[Any, Any]:
    """Return two values in ascending order, element by element for arrays."""
    return at_most(value, value2), at_least(value, value2)


def in_series(value: Any, value2: Any) -> Any:
    """Return 1/(1/x + 1/y) of two positive values, of which one may be infinite."""
    smaller, larger = smaller_and_larger(value, value2)
    return smaller / (1 + smaller / larger)


def quotient(value: Any, divisor: Any, otherwise: float) -> Any:
    """Return a quotient, and another number where the divisor is 0 or nan, element by element for arrays.

    >>> quotient(3.0, 2.0, 1.0), quotient(3.0, 0.0, 1.0)
    (1.5, 1.0)
    """
    is_known = abs(divisor) > 0
    return where(is_known, value / where(is_known, divisor, 1.0), otherwise)


def where(condition: Any, value: Any, otherwise: Any) -> Any:
    """Return the one value or the other, element by element for arrays."""
    if isinstance(condition, bool):
        return value if condition else otherwise
    import numpy

    return numpy.where(condition, value, otherwise)


def within(condition: Any, value: Any) -> Any:
    """Return a value that is defined under a condition. Elsewhere a number raises ValueError, and an array holds nan."""
    if isinstance(condition, bool) and not condition:
        raise ValueError("outside the domain of the formula")
    return where(condition, value, math.nan)
