"""Formulas whose every operation is watched: a result is nan where one of them leaves the normal doubles.

The processor notes an overflow and an underflow, and numpy asks it for that after each operation. So a formula costs no
more for being watched, and what is wrong between its arguments and its result is noticed, too.
"""

import math
from collections.abc import Callable
from typing import Any

import numpy


def watched(formula: Callable[..., Any]) -> Callable[..., Any]:
    """Return a formula that gives nan where an operation overflows or underflows, for numbers and arrays.

    >>> inverse_square = watched(lambda *, value: 1 / value**2)
    >>> inverse_square(value=0.5), inverse_square(value=1e-160)
    (4.0, nan)
    """

    def evaluate(**arguments: Any) -> Any:
        numbers = {
            name: numpy.float64(each) if isinstance(each, float | int) else each for name, each in arguments.items()
        }
        with numpy.errstate(over="raise", under="raise", divide="ignore", invalid="ignore"):
            value = _evaluate(formula, numbers)
        return float(value) if numpy.ndim(value) == 0 else value

    return evaluate


def _evaluate(formula: Callable[..., Any], arguments: dict[str, Any]) -> Any:
    """Return the result of a formula, nan for the elements that fail; bisection finds them."""
    try:
        return formula(**arguments)
    except FloatingPointError:
        shape = numpy.broadcast_shapes(*(numpy.shape(value) for value in arguments.values()))
        size = math.prod(shape)
        if size == 1:
            return numpy.full(shape, numpy.nan)
        flat = {name: numpy.broadcast_to(value, shape).ravel() for name, value in arguments.items()}
        parts = (slice(0, size // 2), slice(size // 2, size))
        halves = [_evaluate(formula, {name: value[part] for name, value in flat.items()}) for part in parts]
        return numpy.concatenate(halves).reshape(shape)
