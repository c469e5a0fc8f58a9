"""Inputs at the ends of the range: a result is right to its last digits, or there is none; never a wrong number."""

import math
from collections.abc import Iterator
from itertools import combinations, product
from random import Random
from typing import Any

import numpy as np
import pytest

import reference
from jkroll import solve
from jkroll.errors import JkrollError
from jkroll.quantities.errors import OutOfRange
from jkroll.scene.inputs import LEAST, MOST
from jkroll.scene.scene import Scene
from reference import BOUND, Exact, conditions, digits, exact_results, ulp_error
from scenes import OTHER, QUARTZ

GIVEN = QUARTZ | {"yield_displacement": 2e-10, "gravity": 9.8}
ENERGIES = ("energy", "energy_ratio", "speed")
STATES = ("load", "approach_at_load")
NAMES = [name for name in (*GIVEN, *OTHER) if not name.startswith("poisson")]


def scenes() -> Iterator[dict[str, Any]]:
    """Iterate over scenes with one, two or all inputs at the ends, some with a load, an approach, an energy or a speed."""
    ends = (LEAST, MOST)
    for name, end in product((*NAMES, *ENERGIES, *STATES), ends):
        yield {**GIVEN, name: end}
    random = Random(300)
    for pair in combinations((*NAMES, *ENERGIES), 2):
        if not set(pair) <= set(ENERGIES):
            yield {**GIVEN, **{name: random.choice(ends) for name in pair}}
    for place in range(60):
        names = [
            *NAMES[: 6 if place % 2 else None],
            random.choice(ENERGIES),
            *random.choice([(), (), ("load",), STATES[1:]]),
        ]
        depth = random.choice([1.0, 1.0, 0.9, 0.75, 0.5])  # not all at the very end
        yield {**GIVEN, **{name: random.choice(ends) ** depth for name in names}}


@pytest.fixture
def _many_digits(monkeypatch: pytest.MonkeyPatch) -> Iterator[None]:
    """Give the plain form of the rolling mass more digits than it cancels where the radii differ by 120 orders."""
    before, digits.dps = digits.dps, 1500
    monkeypatch.setattr(reference, "pi", +digits.pi)
    yield
    digits.dps = before


def is_right(value: Any, exact: Exact, condition: float) -> bool:
    """Return whether a value is the exact one, or is none."""
    if isinstance(value, JkrollError) or math.isnan(value):
        return True
    return ulp_error(float(value), exact) <= BOUND * (1 + condition)


@pytest.mark.usefixtures("_many_digits")
def test_a_number_at_the_ends_is_right_or_refused() -> None:
    answered = 0
    for scene in scenes():
        exact = {name: value for name, value in exact_results(scene).items() if abs(value) < math.inf}
        condition = conditions(scene, exact)
        arrays = {name: np.array([value, GIVEN.get(name, value)]) for name, value in scene.items()}
        numbers, elements = Scene(scene).evaluate(list(exact)), Scene(arrays).evaluate(list(exact))
        for name, value in exact.items():
            assert is_right(numbers[name], value, condition[name]), (name, numbers[name], float(value), scene)
            element = elements[name][0] if isinstance(elements[name], np.ndarray) else elements[name]
            assert is_right(element, value, condition[name]), (name, element, float(value), scene)
            answered += isinstance(numbers[name], float)
    assert answered > 5_000


@pytest.mark.parametrize("value", [1e-61, 1e61, 1e-300, 1e300, 5e-324])
@pytest.mark.parametrize("name", [*NAMES, *ENERGIES, *STATES, "mass", "pull_off_force"])
def test_a_number_beyond_the_range_is_refused(name: str, value: float) -> None:
    for given in (value, np.array([1.0, value]), np.full(40_000, value)):
        with pytest.raises(OutOfRange, match=r"must lie between 1e-60 and 1e60 in SI units"):
            solve("yield_moment", **{**GIVEN, name: given})


def test_zero_and_infinity_stay_where_they_mean_something() -> None:
    given: dict[str, Any] = {
        **GIVEN,
        "load": 0.0,
        "radius2": math.inf,
        "youngs_modulus2": math.inf,
        "poisson_ratio": 1e-100,
    }
    numbers = solve(["stiffness", "rolling_mass", "load_margin"], **given)
    arrays: dict[str, Any] = {name: np.full(3, value) for name, value in given.items()}
    for name, values in solve(list(numbers), **arrays).items():
        np.testing.assert_allclose(values, numbers[name], rtol=1e-15)


def test_an_element_that_leaves_the_doubles_leaves_the_others_alone() -> None:
    radius = np.full(40_000, 1e-7)
    radius[[5, 20_000, 39_999]] = 1e-60
    given: dict[str, Any] = {**GIVEN, "radius": radius, "density": 1e-40}
    inertia = solve("moment_of_inertia", **given)
    assert np.flatnonzero(np.isnan(inertia)).tolist() == [5, 20_000, 39_999]
    assert (inertia[~np.isnan(inertia)] == solve("moment_of_inertia", **{**given, "radius": 1e-7})).all()
