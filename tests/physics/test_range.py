"""Inputs at the ends of their range: a result is accurate or has no value, but is never wrong."""

import math
import sys
from collections.abc import Iterator, Mapping
from random import Random
from typing import Any

import numpy as np
import pytest

from frames import outcomes
from jkroll import NOMENCLATURE, solve
from jkroll.model.accepted import LEAST, MOST, SMALLEST, check_range, is_answer, takes
from jkroll.model.frame import Frame
from jkroll.model.plan import Plan, formula_of
from jkroll.model.reasons import MissingInput
from jkroll.quantities.nomenclature import OF_MAUGIS
from jkroll.quantities.values import QuantityError
from maugis_reference import Exact, digits, mpf
from reference import BOUND, exact, ulp_error
from scenes import OTHER, QUARTZ

GIVEN = QUARTZ | {"yield_displacement": 2e-10, "gravity": 9.8}
ENERGIES = ("energy", "energy_ratio", "speed")
STATES = ("load", "approach_at_load")
NAMES = [name for name in (*GIVEN, *OTHER) if not name.startswith("poisson")]


@pytest.mark.parametrize("value", [1e-31, 1e31, 1e-300, 1e300, 5e-324])
@pytest.mark.parametrize("name", [*NAMES, *ENERGIES, *STATES, "mass", "pull_off_force"])
def test_a_number_beyond_the_range_is_refused(name: str, value: float) -> None:
    """A load or an approach may be 0, or as close to 0 as doubles allow."""
    for given in (value, np.array([1.0, value]), np.full(40_000, value)):
        scene = {**GIVEN, name: given}
        if name in STATES and value < 1:
            assert np.all(solve("pull_off_force", **scene) > 0)
            continue
        with pytest.raises(QuantityError, match=r"1e30 in SI units"):
            solve("yield_moment", **scene)


@pytest.mark.parametrize("name", ["radius", "radius2", "load", "load_margin", "poisson_ratio", "youngs_modulus"])
def test_an_array_accepts_the_same_values_as_a_number(name: str) -> None:
    edges = [0.0, 0.5, -0.5, 0.7, LEAST, LEAST / 2, -LEAST / 2, MOST, 2 * MOST, math.inf, -math.inf, math.nan]
    refused = []
    for edge in edges:
        try:
            check_range(name, edge)
            refused.append(False)
        except QuantityError:
            refused.append(True)
    assert (~takes(name, np.array(edges))).tolist() == refused


def test_zero_and_infinity_are_accepted_where_they_have_a_meaning() -> None:
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


def test_an_element_beyond_the_range_of_doubles_does_not_affect_the_others() -> None:
    radius = np.full(40_000, 1e-7)
    radius[[5, 20_000, 39_999]] = 1e-30
    given: dict[str, Any] = {**GIVEN, "youngs_modulus": 1e30, "atomic_spacing": 1e29, "radius": radius}
    energy = solve("sticking_energy", model="maugis", **given)
    assert np.flatnonzero(np.isnan(energy)).tolist() == [5, 20_000, 39_999]
    assert (energy[~np.isnan(energy)] == solve("sticking_energy", model="maugis", **{**given, "radius": 1e-7})).all()


# --- Corners ----------------------------------------------------------------------------------------------------------

LARGEST = sys.float_info.max
SIZES = [name for name in (*GIVEN, *OTHER, "atomic_spacing") if not name.startswith("poisson")]
RESULTS = [name for name, one in NOMENCLATURE.items() if formula_of(name) is not None and not one.variant_of]
BOUND_OF_LAW = {"jkr": BOUND, "maugis": 25.0}  # in ulp, times 1 plus the condition with respect to the state and to z0


def corner_scenes(low: float, high: float, count: int) -> Iterator[dict[str, float]]:
    """Iterate over scenes in which some or all inputs have the smallest or the largest magnitude, or one in between."""
    random = Random(count)
    usual = {**GIVEN, **OTHER, "atomic_spacing": 4e-10}

    def corner() -> float:
        return random.choice([low, high, low, high, 10 ** random.uniform(math.log10(low), math.log10(high))])

    for _ in range(count):
        share = random.choice([0.1, 0.5, 1.0, 1.0])  # share of the inputs that are at a corner
        scene = {name: corner() if random.random() < share else usual[name] for name in SIZES}
        scene |= {"poisson_ratio": random.choice([0.0, 0.3, 0.5, -0.999]), "poisson_ratio2": 0.2, "rolling_angle": 1.5}
        if random.random() < 0.4:
            scene[random.choice(["radius2", "youngs_modulus2"])] = math.inf
        if random.random() < 0.3:
            del scene["yield_displacement"]
            scene["adhesion_hysteresis"] = min(scene["surface_energy"], scene["surface_energy2"])
        if state := random.choice(["", "load", "load", "approach_at_load"]):
            scene[state] = random.choice([-1, 1]) * corner()
        if energy := random.choice(["", *ENERGIES]):
            scene[energy] = corner()
        yield scene


class ExactScene:
    """The exact values of all steps that lead to the results of a scene; None for a step without a value."""

    def __init__(self, given: Mapping[str, Any], plans: Mapping[str, Plan]) -> None:
        """Evaluate plans from their starting values."""
        self.plans, steps = plans, _formulas_of(plans)
        self.given = {name: mpf(given[name]) for name in _inputs_of(plans)}
        self.values: dict[str, Exact | None] = dict(self.given)
        self.in_doubles = set(self.given)  # names of values that doubles hold, with all intermediate values
        for name, step in steps.items():
            known = {parameter: self.values[argument] for parameter, argument in step.arguments.items()}
            value = None if None in known.values() else _exact_or_none(step.formula.__name__, known)
            self.values[name] = value
            is_zero = value == 0 and NOMENCLATURE[name].may_be_zero
            is_double = value is not None and (is_zero or SMALLEST < abs(value) < LARGEST)
            if is_double and self.in_doubles.issuperset(step.arguments.values()):
                self.in_doubles.add(name)

    def is_right(self, name: str, value: Any, bound: float) -> bool:
        """Return whether a number is accurate, or is missing because doubles cannot hold it."""
        source = self.plans[name].name
        exact_value = self.values[source]
        if not isinstance(value, float) or math.isnan(value):
            return source not in self.in_doubles
        if exact_value is None:
            return False
        error = ulp_error(value, exact_value)
        return error <= bound or error <= bound * (1 + self.condition(source))

    def condition(self, name: str) -> float:
        """Return the factor by which relative errors of the state and of the atomic spacing appear in a result."""
        value, step = self.values[name], mpf(10) ** -60
        states = [state for state in (*STATES, "atomic_spacing") if self.given.get(state)]
        moved = [ExactScene(self.given | {state: self.given[state] * (1 + step)}, self.plans) for state in states]
        return float(sum(abs(each.values[name] / value - 1) for each in moved) / step) if value else 0.0


def _exact_or_none(formula: str, given: dict[str, Exact]) -> Exact | None:
    """Return the exact value of a formula; None if its equation has no real value."""
    try:
        value = exact(formula, given)
    except (ValueError, ZeroDivisionError):
        return None
    return value if isinstance(value, digits.mpf) else None  # not a complex number


@pytest.mark.parametrize(
    ("model", "count"),
    [
        ("jkr", 30),
        ("maugis", 5),
        pytest.param("jkr", 1000, marks=pytest.mark.slow),
        pytest.param("maugis", 1000, marks=pytest.mark.slow),
    ],
)
def test_scenes_at_the_corners_have_accurate_numbers(model: str, count: int) -> None:
    """Every number is accurate, and none is missing if doubles can hold it and all intermediate values."""
    answered = 0
    for given in corner_scenes(LEAST, MOST, count):
        scene = Frame(given, model=model)
        asked = [name for name in RESULTS if name not in scene.known and (model == "maugis" or name not in OF_MAUGIS)]
        numbers = outcomes(scene, asked)
        wanted = [name for name in asked if not isinstance(numbers[name], MissingInput)]
        with digits.workdps(_digits_for(numbers)):
            plans = {name: scene.plan(name) for name in wanted}
            exact_scene, elements = ExactScene(scene.values, plans), _elements(scene.values, plans)
            for name in wanted:
                for value in (numbers[name], elements[plans[name].name]):
                    assert exact_scene.is_right(name, value, BOUND_OF_LAW[model]), (name, value, given)
                answered += isinstance(numbers[name], float)
    assert answered > 60 * count


def _inputs_of(plans: Mapping[str, Plan]) -> set[str]:
    """Return the names of the values that plans start from."""
    return {name for plan in plans.values() for name, step in plan.steps.items() if step.formula is None}


def _formulas_of(plans: Mapping[str, Plan]) -> dict[str, Plan]:
    """Return the steps of plans that have a formula, by name, in an order in which they can be evaluated."""
    return {name: step for plan in plans.values() for name, step in plan.steps.items() if step.formula is not None}


def _elements(given: Mapping[str, Any], plans: Mapping[str, Plan]) -> dict[str, float]:
    """Return the results of the formulas of plans, computed with arrays."""
    values = {name: np.array([given[name]]) for name in _inputs_of(plans)}
    with np.errstate(all="ignore"):
        for name, step in _formulas_of(plans).items():
            known = {parameter: values[argument] for parameter, argument in step.arguments.items()}
            elements = step.formula(**known)
            values[name] = np.where(is_answer(name, elements), elements, math.nan)
    return {name: value.item() for name, value in values.items()}


def _digits_for(numbers: dict[str, Any]) -> int:
    """Return enough digits for the cancellation in Maugis' equations: powers of λ and of the edge ratio."""
    sizes = [value for name, value in numbers.items() if name in OF_MAUGIS and OF_MAUGIS[name].unit == "1"]
    return 120 + 6 * max([0, *(abs(int(math.log10(size))) for size in sizes if isinstance(size, float) and size > 0)])
