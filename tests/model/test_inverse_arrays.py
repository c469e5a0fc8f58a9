"""The inverse problem for arrays gives the same values and reasons as for single elements."""

import math
from collections.abc import Sequence
from itertools import product
from random import Random
from typing import Any

import numpy
import pytest

from frames import solved
from jkroll import infer, known_materials
from jkroll.errors import NoResult
from jkroll.model.frame import Frame
from jkroll.model.reasons import MissingInput, NotInLaw
from jkroll.model.search import Solution
from jkroll.model.unknowns import SIZES, NoSolution, SeveralSolutions
from jkroll.quantities.laws import MODELS
from relative import approx
from scenes import OTHER, QUARTZ, log_uniform

# A value of every input, and quantities from which the input is inferred, except under the laws in LACKING.
TYPICAL = {
    "surface_energy": 0.03, "work_of_adhesion": 0.05, "yield_displacement": 2e-10, "adhesion_hysteresis": 5e-3,
    "youngs_modulus": 5e10, "radius": 1e-7, "load": 1e-7, "hamaker": 1e-19, "shear_strength": 1e8,
    "viscous_time": 1e-12,
}  # fmt: skip
MEASURED = {
    "surface_energy": ("pull_off_force", "contact_radius_at_load"),
    "work_of_adhesion": ("contact_radius", "stiffness"),
    "yield_displacement": ("yield_force", "r_min"),
    "adhesion_hysteresis": ("yield_moment",),
    "youngs_modulus": ("contact_radius_at_load", "vertical_frequency"),
    "radius": ("pull_off_force", "n_roll"),
    "load": ("contact_radius_at_load", "stiffness"),
    "hamaker": ("pull_off_force", "contact_radius_at_load"),
    "shear_strength": ("sliding_force",),
    "viscous_time": ("sticking_speed",),
}
LACKING = [
    ("adhesion_hysteresis", "dmt"),
    *((name, law) for name in ("shear_strength", "viscous_time") for law in ("maugis", "dmt")),
]
COUNT = 6  # elements of an array


def solution(name: str, quantity: str, measured: float, scene: Frame) -> Solution:
    """Return the solution for one unknown."""
    return solved((name,), {quantity: measured}, scene)


def single(name: str, quantity: str, measured: float, scene: Frame) -> Solution | NoResult:
    """Return the solution for one measured value, or the error if there is none."""
    try:
        return solution(name, quantity, measured, scene)
    except NoResult as error:
        return error


def assert_as_single_elements(
    name: str, quantity: str, measured: Sequence[float], arrays: dict[str, Any], scene: Frame
) -> list[Solution | NoResult]:
    """Check that arrays have the values and reasons of single elements; return the outcomes of these elements.

    Values may differ by rounding errors times the condition number.
    """
    ulps = 40 if "maugis" in (scene.law.name, *quantity.split("_")) else 9  # as stated by the formulas
    of_arrays = solved((name,), {quantity: numpy.array(measured)}, scene.replace(**arrays))
    outcomes = []
    for row, level in enumerate(measured):
        of_row = scene.replace(**{given: float(array[row]) for given, array in arrays.items()})
        expected = single(name, quantity, level, of_row)
        if isinstance(expected, Solution):
            value = float(of_arrays.values[name][row])
            assert value == approx(expected.values[name], rel=ulps * 2**-52 * (1 + expected.condition)), quantity
        elif isinstance(expected, NoSolution):  # next to pull-off, the least value is a rounding error
            failure = of_arrays.failures[row]
            assert isinstance(failure, NoSolution)
            assert failure.span == approx(expected.span, rel=1e-9, abs=1e-14 * max(map(abs, expected.span)))
        else:
            assert str(of_arrays.failures[row]) == str(expected)
        outcomes.append(expected)
    return outcomes


def test_the_tables_of_this_file_have_every_input() -> None:
    assert TYPICAL.keys() == MEASURED.keys() == SIZES.keys()


def test_a_quantity_that_the_law_lacks_is_refused_for_arrays() -> None:
    scene = Frame({**QUARTZ, "radius": 1e-7}, model="dmt")
    with pytest.raises(NotInLaw, match="which DMT does not have"):
        solved(("adhesion_hysteresis",), {"yield_moment": numpy.array([1e-17])}, scene)


FAST = [("surface_energy", "jkr"), ("load", "jkr"), ("shear_strength", "jkr")]
SLOW = [case for case in product(MEASURED, MODELS) if case not in (*FAST, *LACKING)]


@pytest.mark.parametrize(("name", "model"), [*FAST, *(pytest.param(*case, marks=pytest.mark.slow) for case in SLOW)])
def test_arrays_give_what_floats_give(name: str, model: str) -> None:
    """Only the measured value varies, or some inputs as well, or all inputs except Poisson's ratios."""
    random = Random(f"{name} {model}")
    energies = {"surface_energy", "surface_energy2"} if name in ("work_of_adhesion", "hamaker") else set()
    given = {**QUARTZ, **OTHER, "load": -1e-9}
    for excluded in {name, *energies}.intersection(given):
        del given[excluded]
    spread = {}
    for varied, value in given.items():
        spread[varied] = value * numpy.array([random.uniform(0.5, 2) for _ in range(COUNT)])
    scene = Frame(given, model=model)
    outcomes: list[Solution | NoResult] = []
    for quantity in MEASURED[name]:
        for inputs in ([], ["density", "radius2"], [*given]):
            arrays = {varied: spread[varied] for varied in inputs if not varied.startswith("poisson_ratio")}
            values = [TYPICAL[name] * log_uniform(random, 0.3, 3) for _ in range(COUNT)]
            levels = [float(scene.replace(**{name: value})[quantity]) for value in values]
            too_large, too_small = 1e20 * levels[0], 1e-20 * levels[1]
            measured = [*levels[2:], too_large, too_small]
            outcomes += assert_as_single_elements(name, quantity, measured, arrays, scene)
    assert 2 * sum(isinstance(outcome, Solution) for outcome in outcomes) > len(outcomes)


def test_the_errors_of_arrays_name_all_solutions() -> None:
    """One measured value has two solutions between two points of the scan, next to a turning point."""
    scene = Frame({"load": 5e-8}, known_materials()["quartz"])
    least = min(scene.replace(radius=1e-9 * radius)["approach_at_load"] for radius in range(400, 700))
    measured = [3e-10, 1.00001 * least, 0.9 * least, 1e-9]
    expected = assert_as_single_elements("radius", "approach_at_load", measured, {}, scene)
    assert [type(outcome) for outcome in expected] == [SeveralSolutions, SeveralSolutions, NoSolution, SeveralSolutions]
    loads = {"load": numpy.array([5e-8, 5e-8, 5e-8, 6e-8])}
    assert_as_single_elements("radius", "approach_at_load", measured, loads, scene)


def test_loads_are_found_up_to_pull_off() -> None:
    radii = numpy.array([1e-6, 2e-6, 3e-6])
    scene = Frame({"radius2": math.inf}, known_materials()["quartz"])
    force = scene.replace(radius=radii)["pull_off_force"]
    least = scene.replace(radius=radii, load=-force)["contact_radius_at_load"] * (1 + 1e-13)
    solutions = assert_as_single_elements("load", "contact_radius_at_load", [*least], {"radius": radii}, scene)
    loads = [solution.values["load"] for solution in solutions if isinstance(solution, Solution)]
    assert loads == approx([*-force], rel=1e-9)


def test_only_the_element_whose_contact_breaks_has_a_reason() -> None:
    loads = {"load": numpy.array([-1.0, 1e-9])}
    scene = Frame({"radius": 1e-7}, known_materials()["quartz"])
    beyond, found = assert_as_single_elements("youngs_modulus", "contact_radius_at_load", [4e-9, 4e-9], loads, scene)
    assert "breaks this contact" in str(beyond)
    assert isinstance(found, Solution)


# --- jkroll.infer -----------------------------------------------------------------------------------------------------


def test_infer_takes_arrays_with_planes_rigid_bodies_and_no_load_in_some_elements() -> None:
    """A radius or a modulus may be infinite in some elements only, and a load may be 0."""
    given: dict[str, Any] = {
        "radius2": [math.inf, 1e-6, 2e-6],
        "youngs_modulus2": [[math.inf], [1e9]],
        "load": [0.0, 1e-9, 0.0],
    }
    numbers: dict[str, Any] = {"radius": 1e-6, "youngs_modulus": 5e10, "poisson_ratio": 0.2, "poisson_ratio2": 0.3}
    arrays = numpy.broadcast_arrays(*given.values())
    measured = {"contact_radius_at_load": 3e-8}
    found = infer("gamma", measured=measured, surface_energy2=0.03, **numbers, **given)
    assert found.shape == (2, 3)
    for place in numpy.ndindex(2, 3):
        row: dict[str, Any] = dict(zip(given, (float(one[place]) for one in arrays), strict=True))
        expected = infer("gamma", measured=measured, surface_energy2=0.03, **numbers, **row)
        assert found[place] == approx(expected, rel=1e-14)


def test_an_empty_array_gives_an_empty_array() -> None:
    found = infer("gamma", measured={"pull_off_force": numpy.zeros((0, 3))}, radius=2e-6)
    assert found.shape == (0, 3)


def test_a_missing_input_is_named_for_arrays() -> None:
    with pytest.raises(MissingInput, match="unloaded contact radius needs Young's modulus"):
        infer("gamma", measured={"contact_radius": [1e-8, 2e-8]}, radius=2e-6)
