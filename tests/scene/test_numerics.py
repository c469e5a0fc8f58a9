"""The numerical methods of the way back and of uncertainties, on functions whose answer is known."""

from math import exp, inf, isnan

import pytest

from jkroll.errors import NoResult
from jkroll.scene.numerics import highest_between, logarithmic_slope


@pytest.mark.parametrize("peak", [-1.0, -0.3, 0.0, 0.7, 2.0])
def test_the_highest_point_is_known_to_half_of_the_digits(peak: float) -> None:
    assert highest_between(-1.0, 2.0, lambda x: exp(-((x - peak) ** 2))) == pytest.approx(peak, abs=3e-8)


@pytest.mark.parametrize("exponent", [-2.0, 1 / 3, 0.0, 5.0])
@pytest.mark.parametrize("value", [1e-9, -3.0])
def test_the_slope_of_a_power_is_its_exponent(exponent: float, value: float) -> None:
    assert logarithmic_slope(lambda x: -7 * abs(x) ** exponent, value) == pytest.approx(exponent, abs=1e-9)


def test_a_slope_at_the_end_of_the_outcomes_is_one_sided() -> None:
    def outcome(value: float) -> float:
        if value < 2:
            raise NoResult
        return value**3

    assert logarithmic_slope(outcome, 2.0) == pytest.approx(3, abs=1e-5)


def test_slopes_that_are_no_numbers() -> None:
    def outcome(value: float) -> float:
        if value != 2:
            raise NoResult
        return value

    assert isnan(logarithmic_slope(outcome, 2.0))
    assert logarithmic_slope(lambda x: x - 2, 2.0) == inf
