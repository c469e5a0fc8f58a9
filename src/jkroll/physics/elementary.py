"""The elementary functions the formulas need: `math` for a number, numpy for anything else.

The value itself decides, so that a float costs no import of numpy and an array (or a pint Quantity, which answers
numpy's protocol) costs no loop.
"""

import math
from collections.abc import Callable
from typing import Any


def _for_numbers_and_arrays(name: str) -> Callable[[Any], Any]:
    of_number = getattr(math, name)

    def function(value: Any) -> Any:
        if isinstance(value, (float, int)):
            return of_number(value)
        import numpy

        return getattr(numpy, name)(value)

    function.__name__ = function.__qualname__ = name
    return function


pi = math.pi
sqrt = _for_numbers_and_arrays("sqrt")
_library_cbrt = _for_numbers_and_arrays("cbrt")


def cbrt(value: Any) -> Any:
    """Cube root to 0.5 ulp, the same for a number and an array.

    The C library's is off by as much as 3 ulp, and another one's by something else. One step of Newton's method from the
    leading 17 bits of its root, whose cube is exact, mends that.
    """
    root = _library_cbrt(value)
    if isinstance(value, (float, int)):
        return _polished(root, value) if root and not math.isinf(root) else root
    import numpy

    if not isinstance(value, numpy.ndarray):
        return root  # a pint Quantity: its units do not survive the step
    with numpy.errstate(divide="ignore", invalid="ignore"):
        polished = _polished(root, value)
    return numpy.where(numpy.isnan(polished), root, polished)  # 0 and infinity have no polish


def _polished(root: Any, value: Any) -> Any:
    wide = (2**36 + 1) * root
    head = wide - (wide - root)
    return head + (value - head * head * head) / (root * root + root * head + head * head)


def one_minus_square(value: Any) -> Any:
    """1 − value², with all its digits for any value between −1 and 1."""
    if isinstance(value, (float, int)):
        return 1 - value * value if abs(value) < 0.5 else (1 - value) * (1 + value)
    import numpy

    return numpy.where(abs(value) < 0.5, 1 - value * value, (1 - value) * (1 + value))


def parallel(value: Any, value2: Any) -> Any:
    """1/(1/value + 1/value2), exact where one of them is infinite or both are equal, and the same under exchange."""
    if isinstance(value, (float, int)) and isinstance(value2, (float, int)):
        small, large = min(value, value2), max(value, value2)
    else:
        import numpy

        small, large = numpy.minimum(value, value2), numpy.maximum(value, value2)
    return small / (1 + small / large)


def where(condition: Any, value: Any, otherwise: Any) -> Any:
    """One value or the other, element by element for arrays."""
    if isinstance(condition, bool):
        return value if condition else otherwise
    import numpy

    return numpy.where(condition, value, otherwise)


def within(condition: Any, value: Any) -> Any:
    """A value where the condition holds; elsewhere an array holds nan, and a number raises ValueError."""
    if isinstance(condition, bool) and not condition:
        raise ValueError("outside the domain of the formula")
    return where(condition, value, float("nan"))
