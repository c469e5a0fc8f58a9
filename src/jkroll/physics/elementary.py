"""The elementary functions the formulas need: `math` for a number, numpy for anything else.

The value itself decides, so that a float costs no import of numpy and an array (or a pint Quantity, which answers
numpy's protocol) costs no loop.
"""

import math
from collections.abc import Callable
from typing import Any


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


pi = math.pi
sqrt = _for_numbers_and_arrays("sqrt", 2)
_library_cbrt = _for_numbers_and_arrays("cbrt", 3)


def cbrt(value: Any) -> Any:
    """Cube root to 0.5 ulp, the same for a number and an array.

    The C library's is off by as much as 3 ulp, and another one's by something else.
    """
    return _mended(_library_cbrt(value), _mended_root, value)


def product(*factors: Any, over: tuple[Any, ...] = ()) -> Any:
    """The product of up to five factors, over that of up to four others, to 0.5 ulp."""
    plain = math.prod(factors)
    return _mended(plain / math.prod(over) if over else plain, _mended_product, factors, over)


def geometric_mean(value: Any, value2: Any) -> Any:
    """√(value·value2) to 0.5 ulp."""
    return _mended(sqrt(value * value2), _mended_mean, value, value2)


def one_minus_square(value: Any, over: Any) -> Any:
    """(1 − value²)/over to 0.5 ulp, for any value between −1 and 1."""
    return _mended((1 - value) * (1 + value) / over, _mended_one_minus_square, value, over)


def parallel(value: Any, value2: Any) -> Any:
    """1/(1/value + 1/value2) to 1 ulp, exact where one of them is infinite or both are equal, and the same under exchange."""
    small, large = in_order(value, value2)
    return _mended(small / (1 + small / large), _mended_parallel, small, large)


def in_order(value: Any, value2: Any) -> tuple[Any, Any]:
    """The smaller of two values and the larger."""
    if _is_number(value) and _is_number(value2):
        return min(value, value2), max(value, value2)
    import numpy

    return numpy.minimum(value, value2), numpy.maximum(value, value2)


def over_sum(value: Any, term: Any, term2: Any) -> Any:
    """value/(term + term2) to 0.5 ulp; the second term must not be larger than the first."""
    return _mended(value / (term + term2), _mended_quotient, value, term, term2)


# --- The last digit -------------------------------------------------------------------------------------------------
# A product of two numbers of at most 26 bits is exact. So the leading bits of a rounded result say exactly by how much
# they miss the equation, and what is missing is so small that its own rounding does not count.


def leading_bits(value: Any, bits: int) -> Any:
    """A value rounded to fewer bits; nan where it is infinite, and of a number close to overflow."""
    dropped = 53 - bits
    if _is_number(value):
        wide = (2.0**dropped + 1) * value
        return wide - (wide - value)
    import numpy

    if value.dtype != numpy.float64:
        value = value.astype(numpy.float64)
    return ((value.view(numpy.int64) + (1 << (dropped - 1))) & -(1 << dropped)).view(numpy.float64)


def _mended_root(root: Any, value: Any) -> Any:
    head = leading_bits(root, 17)
    return head + (value - head * head * head) / (root * root + root * head + head * head)


def _mended_mean(root: Any, value: Any, value2: Any) -> Any:
    head, one, two = leading_bits(root, 26), leading_bits(value, 26), leading_bits(value2, 26)
    return head + ((one * two - head * head) + one * (value2 - two) + (value - one) * value2) / (root + head)


def _mended_one_minus_square(result: Any, value: Any, over: Any) -> Any:
    less, more = 1 - value, 1 + value
    missing = less * ((1 - more) + value) + more * ((1 - less) - value)
    exact, rest = _parts((less, more), 26)
    head, over_head = leading_bits(result, 26), leading_bits(over, 26)
    return head + ((exact - head * over_head) + (rest + missing - head * (over - over_head))) / over


def _mended_parallel(result: Any, small: Any, large: Any) -> Any:
    ratio = small / large
    head, ratio_head, large_head = leading_bits(result, 26), leading_bits(ratio, 26), leading_bits(large, 26)
    rest = ratio - ratio_head
    missing = (small - ratio_head * large_head) - ratio_head * (large - large_head) - rest * large
    return head + ((small - head) - head * ratio_head - head * rest - head * (missing / large)) / (1 + ratio)


def _mended_product(result: Any, factors: tuple[Any, ...], over: tuple[Any, ...]) -> Any:
    bits = 53 // max(len(factors), len(over) + 1)
    exact, rest = _parts(factors, bits)
    if not over:
        return exact + rest
    divisor, divisor_rest = _parts(over, bits)
    head = leading_bits(result, bits)
    return head + ((exact - head * divisor) + (rest - head * divisor_rest)) / (divisor + divisor_rest)


def _parts(factors: tuple[Any, ...], bits: int) -> tuple[Any, Any]:
    """The product of the leading bits of factors, which is exact, and what the whole product has besides."""
    heads = {id(factor): leading_bits(factor, bits) for factor in factors}
    rests = {key: factor - heads[key] for key, factor in zip(map(id, factors), factors, strict=True)}
    exact, rest = heads[id(factors[0])], rests[id(factors[0])]
    for factor in factors[1:]:
        rest = rest * factor + exact * rests[id(factor)]
        exact = exact * heads[id(factor)]
    return exact, rest


def _mended_quotient(result: Any, value: Any, term: Any, term2: Any) -> Any:
    divisor = term + term2
    head, divisor_head = leading_bits(result, 26), leading_bits(divisor, 26)
    missing = (divisor - divisor_head) - ((divisor - term) - term2)
    return head + ((value - head * divisor_head) - head * missing) / divisor


def _mended(plain: Any, mend: Callable[..., Any], *arguments: Any) -> Any:
    """A result with its last digit mended; as it was where it is 0 or infinite, of units, or of fewer digits."""
    if _is_number(plain):
        mended = mend(plain, *arguments) if plain else plain
        return plain if math.isnan(mended) else mended
    import numpy

    if not isinstance(plain, numpy.ndarray) or plain.dtype != numpy.float64:
        return plain  # a pint Quantity, whose units do not survive, or single precision
    with numpy.errstate(over="ignore", divide="ignore", invalid="ignore"):
        mended = mend(plain, *arguments)
    return numpy.where(numpy.isnan(mended), plain, mended) if math.isnan(mended.sum()) else mended


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
