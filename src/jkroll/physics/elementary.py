"""The elementary functions the formulas need, each to 0.5 ulp: `math` for a number, numpy for anything else.

The value itself decides, so that a float costs no import of numpy and an array (or a pint Quantity, which answers
numpy's protocol) costs no loop. Both run the same operations, so that they give the same digits.
"""

import math
from collections.abc import Callable
from typing import Any, NamedTuple

pi = math.pi
_PI = 4175892906503776358826876457663557747, 2**120  # the same to 36 digits


class Constant(float):
    """The double next to a number, and what the number has besides.

    >>> two_fifths = Constant(2, 5)
    >>> two_fifths, two_fifths.rest
    (0.4, -2.2204460492503132e-17)
    """

    rest: float

    def __new__(cls, numerator: int, denominator: int = 1, power: int = 0) -> "Constant":
        """Of a fraction, times a power of π."""
        above, below = numerator * _PI[0] ** power, denominator * _PI[1] ** power
        constant = super().__new__(cls, above / below)
        rounded, scale = constant.as_integer_ratio()
        constant.rest = (above * scale - rounded * below) / (below * scale)
        return constant


class Sum(NamedTuple):
    """A sum that is not rounded: a factor of a product."""

    term: Any
    term2: Any


def product(*factors: Any, over: tuple[Any, ...] = ()) -> Any:
    """The product of up to five factors, over that of up to four others; it costs less if equal ones are adjacent."""
    count = len(factors)
    return _mended(
        (*factors, *over),
        lambda *values: _product(values[:count], values[count:]),
        lambda *values: _plain_product(values[:count], values[count:]),
    )


def parallel(value: Any, value2: Any) -> Any:
    """1/(1/value + 1/value2); the other where one of them is infinite."""
    return _mended((value, value2), lambda *values: _product(values, (Sum(*values),)), _plain_parallel)


def geometric_mean(value: Any, value2: Any) -> Any:
    """√(value·value2)."""
    return value if value is value2 else _mended((value, value2), _mean, lambda *values: sqrt(math.prod(values)))


def cbrt(value: Any) -> Any:
    """Cube root, the same for a number and an array: one C library's is off by as much as 3 ulp, another's by else."""
    return _mended((value,), _cube_root, _library_cbrt)


# --- The last digit -------------------------------------------------------------------------------------------------
# A product of numbers of at most 53 bits together is exact. So the leading bits of a rounded result say exactly by how
# much they miss the equation, and what is missing is so small that its own rounding does not count. Operations in
# place spare arrays memory, whose first touch costs more than the arithmetic.

_FLOATS = frozenset({float, int, Constant})


def leading_bits(value: Any, bits: int) -> Any:
    """A value rounded to fewer bits; nan where it is infinite, and of a number close to overflow."""
    dropped = 53 - bits
    if _is_number(value):
        wide = (2.0**dropped + 1) * value
        return wide - (wide - value)
    import numpy

    if value.dtype != numpy.float64:
        value = value.astype(numpy.float64)
    whole = value.view(numpy.int64) + (1 << (dropped - 1))
    whole &= -(1 << dropped)
    return whole.view(numpy.float64)


def _product(factors: tuple[Any, ...], over: tuple[Any, ...]) -> Any:
    bits = 53 // max(len(factors), len(over) + 1)
    result, rest = _parts(factors, bits)
    if over:
        divisor, divisor_rest = _parts(over, bits)
        whole = divisor + divisor_rest
        head = leading_bits((result + rest) / whole, bits)
        result = result - head * divisor
        result += rest - head * divisor_rest
        result /= whole
        rest = head
    result += rest
    return result


def _parts(factors: tuple[Any, ...], bits: int) -> tuple[Any, Any]:
    """The product of the leading bits of factors, which is exact, and what the whole product has besides."""
    first, *others = factors
    _, exact, rest = _halves(first, bits)
    scale = 2.0 ** (53 - bits) + 1
    before = None
    for factor in others:
        if type(factor) is float:  # as `_halves` has it, without the calls
            value, wide = factor, scale * factor
            head = wide - (wide - factor)
            less = factor - head
        elif factor is not before:
            value, head, less = _halves(factor, bits)
        before = factor
        rest *= value
        rest += exact * less
        exact *= head
    return exact, rest


def _halves(factor: Any, bits: int) -> tuple[Any, Any, Any]:
    """A factor, its leading bits, and the rest."""
    if isinstance(factor, Sum):
        value = factor.term + factor.term2
        own = value - factor.term
        head = leading_bits(value, bits)
        return value, head, (value - head) + ((factor.term - (value - own)) + (factor.term2 - own))
    head = leading_bits(factor, bits)
    return factor, head, factor - head + factor.rest if isinstance(factor, Constant) else factor - head


def _mean(value: Any, value2: Any) -> Any:
    root = sqrt(value * value2)
    head = leading_bits(root, 26)
    exact, rest = _parts((value, value2), 26)
    return head + (exact - head * head + rest) / (root + head)


def _cube_root(value: Any) -> Any:
    root = _library_cbrt(value)
    head = leading_bits(root, 17)
    square = head * head
    slope = root + head
    slope *= root
    slope += square
    return head + (value - square * head) / slope


def _plain_product(factors: tuple[Any, ...], over: tuple[Any, ...]) -> Any:
    above, below = (
        math.prod(sum(each) if isinstance(each, Sum) else each for each in side) for side in (factors, over)
    )
    return above / below


def _plain_parallel(value: Any, value2: Any) -> Any:
    if _is_number(value) and _is_number(value2):
        small, large = min(value, value2), max(value, value2)
    else:
        import numpy

        small, large = numpy.minimum(value, value2), numpy.maximum(value, value2)
    return small / (1 + small / large)


def _mended(values: tuple[Any, ...], mended: Callable[..., Any], plain: Callable[..., Any]) -> Any:
    """A result with its last digit mended; the plain one where it is 0 or infinite, of units, or of fewer digits."""
    terms = values
    if not _FLOATS.issuperset(map(type, values)):
        terms = tuple(term for value in values for term in (value if isinstance(value, Sum) else (value,)))
    if all(map(_is_number, terms)):
        result = mended(*values) if all(values) else plain(*values)
        return result if result == result else plain(*values)  # noqa: PLR0124  (it is not where it is nan)
    import numpy

    if not all(_is_number(term) or (type(term) is numpy.ndarray and term.dtype == numpy.float64) for term in terms):
        return plain(*values)  # the units of a pint Quantity do not survive
    shapes = {term.shape for term in terms if not _is_number(term)}
    if len(shapes) > 1:
        values = _spread(values, numpy.broadcast_shapes(*shapes))
    with numpy.errstate(all="ignore"):
        result = mended(*values)
        return numpy.where(numpy.isnan(result), plain(*values), result) if math.isnan(result.sum()) else result


def _spread(values: tuple[Any, ...], shape: tuple[int, ...]) -> tuple[Any, ...]:
    """Values with arrays of one shape."""
    import numpy

    return tuple(
        Sum(*_spread(value, shape))
        if isinstance(value, Sum)
        else value
        if _is_number(value)
        else numpy.broadcast_to(value, shape)
        for value in values
    )


def _is_number(value: Any) -> bool:
    """Whether a value is a single number: a double, or one of any magnitude (`wide.Wide`)."""
    return isinstance(value, (float, int)) or hasattr(value, "root")


def _for_numbers_and_arrays(name: str, degree: int) -> Callable[[Any], Any]:
    of_number = getattr(math, name)

    def function(value: Any) -> Any:
        if isinstance(value, (float, int)):
            return of_number(value)
        if _is_number(value):
            return value.root(degree)
        import numpy

        return getattr(numpy, name)(value)

    function.__name__ = function.__qualname__ = name
    return function


sqrt = _for_numbers_and_arrays("sqrt", 2)
_library_cbrt = _for_numbers_and_arrays("cbrt", 3)


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
