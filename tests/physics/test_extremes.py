"""Inputs of any magnitude that a double has: what a user sees must be a double, what lies between need not."""

import math
from collections.abc import Iterator
from fractions import Fraction
from random import Random
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from test_accuracy import log_uniform

import reference
from jkroll import solve
from jkroll.physics.wide import Wide
from jkroll.scene.errors import NoFiniteValue
from reference import BOUND, Exact, digits, exact_results, ulp_error

ORDINARY = {
    "radius": 1e-7, "surface_energy": 0.025, "youngs_modulus": 5.4e10, "poisson_ratio": 0.17, "density": 2600.0,
    "yield_displacement": 2e-10, "gravity": 9.8,
}  # fmt: skip
ANY = [name for name in ORDINARY if name != "poisson_ratio"]
SECOND = ["radius2", "surface_energy2", "youngs_modulus2", "density2"]
SMALLEST, LARGEST = 2.3e-308, 1.7e308


def scenes(count: int) -> Iterator[dict[str, Any]]:
    """Scenes of which one input, some or all are of any magnitude."""
    random = Random(300)
    for place in range(count):
        names = [*ANY, *(SECOND if place % 2 else ())]
        chosen = names if place % 3 == 0 else random.sample(names, 1 + place % 2)
        yield ORDINARY | {name: log_uniform(random, 1e-300, 1e300) for name in chosen}


def is_double(value: Exact) -> bool:
    return bool(SMALLEST < abs(value) < LARGEST)


@pytest.fixture
def _thousands_of_digits(monkeypatch: pytest.MonkeyPatch) -> Iterator[None]:
    """The plain form of the rolling mass cancels as many digits as the radii differ by orders of magnitude, and more."""
    before, digits.dps = digits.dps, 6000
    monkeypatch.setattr(reference, "pi", +digits.pi)
    yield
    digits.dps = before


@pytest.mark.usefixtures("_thousands_of_digits")
@pytest.mark.parametrize("count", [12, pytest.param(200, marks=pytest.mark.slow)])
def test_what_is_a_double_is_found(count: int) -> None:
    for scene in scenes(count):
        for name, exact in exact_results(scene).items():
            if is_double(exact):
                error = ulp_error(solve(name, **scene), exact)
                assert error <= BOUND, (name, error, scene)
            elif exact:
                with pytest.raises(NoFiniteValue):
                    solve(name, **scene)


def test_elements_of_an_array_are_as_numbers() -> None:
    radius = np.array([1e-7, 1e-150, 1e150, 1e-300])
    names = ["n_grav", "adhesion_energy", "vertical_frequency", "r_min"]
    given: dict[str, Any] = {**ORDINARY, "radius": radius}
    for name, values in solve(names, **given).items():
        for place, value in enumerate(values):
            one: dict[str, Any] = {**given, "radius": float(radius[place])}
            try:
                assert value == solve(name, **one)
            except NoFiniteValue:
                assert math.isnan(value), name


NUMBERS = st.floats(min_value=1e-300, max_value=1e300).flatmap(lambda value: st.sampled_from([value, -value, 0.0]))


@given(NUMBERS, NUMBERS)
def test_wide_numbers_are_rounded_as_doubles(one: float, two: float) -> None:
    wide, other = Wide(one), Wide(two)
    assert float(wide + other) == one + two
    assert float(wide - other) == one - two
    assert (wide < other, wide <= other, wide > two, wide >= two, wide == two) == (
        one < two, one <= two, one > two, one >= two, one == two,
    )  # fmt: skip
    product = wide * other
    scale = Fraction(2) ** product.exponent
    assert not product or abs(Fraction(product.mantissa) * scale / (Fraction(one) * Fraction(two)) - 1) <= 2.0**-53
    if two:
        quotient = wide / other
        scale = Fraction(2) ** quotient.exponent
        assert (
            not quotient or abs(Fraction(quotient.mantissa) * scale / (Fraction(one) / Fraction(two)) - 1) <= 2.0**-53
        )
