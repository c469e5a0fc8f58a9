"""The numerical methods of the way back and of uncertainties, on functions whose answer is known."""

from collections.abc import Callable
from math import asin, floor, inf, isnan, nan, pi, sin, sqrt, ulp
from typing import Any

import numpy
import pytest

from jkroll.errors import NoResult
from jkroll.output.sources import logarithmic_slope
from jkroll.scene.unknowns import Scan
from relative import approx

PLACES = [0.5 * step for step in range(-20, 21)]


def all_places(function: Callable[[float], float], levels: list[float]) -> list[list[float]]:
    """Return all places at which a function has each level: one row a level, or one for all of them."""

    def values(_: Any, x: Any) -> Any:
        return numpy.array([function(place) for place in x.tolist()], dtype=float)

    rows, roots = Scan(values, numpy.array(PLACES), numpy.array(levels)).crossings()
    return [roots[rows == row].tolist() for row in range(len(levels))]


def root(x: float) -> float:
    """Return a function that has values from 2 to 4 alone."""
    return sqrt(x - 2) if 2 <= x <= 4 else nan


@pytest.mark.parametrize(
    ("function", "level", "expected"),
    [
        (sin, 0.3, sorted(sign * asin(0.3) + turn * pi for turn, sign in zip(range(-3, 4), [-1, 1] * 4, strict=False))),
        (lambda x: x**3, 1.0, [1.0]),
        (lambda x: x**2, 4.0, [-2.0, 2.0]),
        (root, 1e-5, [2 + 1e-10]),
        (root, sqrt(2) * (1 - 1e-10), [4 - 4e-10]),
        (root, 2.0, []),
        (lambda x: (x - 0.2) ** 2, 1e-6, [0.199, 0.201]),
        (lambda x: -((x - 0.2) ** 2), -1e-6, [0.199, 0.201]),
        (floor, 0.5, []),
    ],
)
def test_all_places_with_a_value_are_found(
    function: Callable[[float], float], level: float, expected: list[float]
) -> None:
    (found,) = all_places(function, [level])
    assert found == approx(expected, rel=1e-12)


def test_a_place_is_found_to_the_last_digit() -> None:
    ((found,),) = all_places(lambda x: x**3, [2.0])
    assert abs(found - 2 ** (1 / 3)) <= ulp(found)


def test_rows_side_by_side_have_what_each_has_by_itself() -> None:
    levels = [-0.9, -0.5, 0.0, 0.3, 0.999, 1.0, 7.0]
    found = all_places(sin, levels)
    assert found == [all_places(sin, [level])[0] for level in levels]
    assert found[6] == []


@pytest.mark.parametrize("exponent", [-2.0, 1 / 3, 0.0, 5.0])
@pytest.mark.parametrize("value", [1e-9, -3.0])
def test_the_slope_of_a_power_is_its_exponent(exponent: float, value: float) -> None:
    assert logarithmic_slope(lambda x: -7 * abs(x) ** exponent, value) == approx(exponent, abs=1e-9)


def test_a_slope_at_the_end_of_the_outcomes_is_one_sided() -> None:
    def outcome(value: float) -> float:
        if value < 2:
            raise NoResult
        return value**3

    assert logarithmic_slope(outcome, 2.0) == approx(3, abs=1e-5)


def test_slopes_that_are_no_numbers() -> None:
    def outcome(value: float) -> float:
        if value != 2:
            raise NoResult
        return value

    assert isnan(logarithmic_slope(outcome, 2.0))
    assert logarithmic_slope(lambda x: x - 2, 2.0) == inf
