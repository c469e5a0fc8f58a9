"""The numerical methods of the way back and of uncertainties, on functions whose answer is known."""

from collections.abc import Callable
from math import asin, exp, floor, inf, isnan, nan, pi, sin, sqrt, ulp

import pytest

from jkroll.errors import NoResult
from jkroll.scene.inverse import (
    Search,
    crossings,
    found_by,
    found_by_all,
    highest_between,
    logarithmic_slope,
    pieces_of,
    with_turning_points,
)
from relative import approx

PLACES = [0.5 * step for step in range(-20, 21)]


def search(function: Callable[[float], float], level: float) -> Search[list[float]]:
    """Search for all places at which a function has a value."""
    found: list[float] = []
    for piece in (yield from pieces_of(PLACES, [*map(function, PLACES)])):
        found += yield from crossings((yield from with_turning_points(piece, level)), level)
    return found


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
    assert found_by(search(function, level), function) == approx(expected, rel=1e-12)


def test_a_place_is_found_to_the_last_digit() -> None:
    (found,) = found_by(search(lambda x: x**3, 2.0), lambda x: x**3)
    assert abs(found - 2 ** (1 / 3)) <= ulp(found)


def test_on_a_slope_no_turning_point_is_looked_for() -> None:
    """What is computed are the scan, and the one bisection down to neighbouring doubles."""
    asked: list[float] = []

    def cubed(x: float) -> float:
        asked.append(x)
        return x**3

    assert found_by(search(cubed, 2.0), cubed) == approx([2 ** (1 / 3)])
    assert len(asked) <= len(PLACES) + 60


def test_searches_side_by_side_find_what_each_finds_by_itself() -> None:
    levels = [-0.9, -0.5, 0.0, 0.3, 0.999, 1.0, 7.0]
    asked: list[int] = []

    def sines(numbers: list[int], places: list[float]) -> list[float]:
        asked.append(len(numbers))
        return [*map(sin, places)]

    found = found_by_all({number: search(sin, level) for number, level in enumerate(levels)}, sines)
    assert found == {number: found_by(search(sin, level), sin) for number, level in enumerate(levels)}
    assert max(asked) > 4
    assert found[6] == []


def test_a_search_that_fails_does_not_end_the_others() -> None:
    def fails() -> Search[float]:
        yield 1.0
        raise NoResult

    found = found_by_all({3: fails(), 5: highest_between(-1.0, 2.0)}, lambda _, places: [-(x**2) for x in places])
    assert isinstance(found[3], NoResult)
    assert found[5] == approx(0, abs=3e-8)


@pytest.mark.parametrize("peak", [-1.0, -0.3, 0.0, 0.7, 2.0])
@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_the_highest_or_lowest_point_is_known_to_half_of_the_digits(peak: float, sign: float) -> None:
    found = found_by(highest_between(-1.0, 2.0, sign=sign), lambda x: sign * exp(-((x - peak) ** 2)))
    assert found == approx(peak, abs=3e-8)


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
