"""Maugis' and Lennard-Jones' laws: energies, states near extremes and the moment in 3-D.

The errors of the formulas are in test_accuracy.py.
"""

import math
from typing import Any

import numpy
import pytest

import jkroll
import maugis_reference as reference
from jkroll.physics import any_law, dugdale
from maugis_boundary_elements import rolling_moment
from maugis_reference import Exact, mpf


def state(transition: Any, edge_ratio: Any) -> dict[str, Any]:
    """Return the dimensionless quantities of the contact at an edge ratio."""
    at = dugdale.Shape(edge_ratio)
    span = dugdale.span(transition, at)
    approach = dugdale.approach(transition, at, span)
    return {
        "radius": edge_ratio * span,
        "zone": at.n * span,
        "approach": approach,
        "load": dugdale.load(transition, at, span),
        "moment": transition * span * span * at.g3,
        "energy": dugdale.energy(transition, at, span, approach),
    }


def ratio_at_load(transition: Any, load: Any) -> Any:
    """Return the edge ratio at a load."""
    least = dugdale.pull_off_ratio(transition)
    return dugdale.ratio_at_load(transition, load, least, -state(transition, least)["load"])


def ulps(value: Any, exact: Exact) -> float:
    return float(abs(mpf(float(value)) - exact)) / math.ulp(float(exact))


@pytest.mark.parametrize("transition", [0.03, 0.5, 0.9379, 2.0])
def test_energy_is_the_integral_of_the_force(transition: float) -> None:
    edge_ratio = ratio_at_load(transition, 0.0)
    a, t = reference.at_load(mpf(transition), mpf(0))
    with reference.digits.workdps(30):
        exact = reference.energy_by_quadrature(t, mpf(transition))
    assert abs(reference.contact_energy(a, t, mpf(transition)) / exact - 1) < mpf(10) ** -20
    assert math.isclose(state(transition, edge_ratio)["energy"], exact, rel_tol=1e-14)


def test_constants_are_the_nearest_doubles() -> None:
    pi = reference.pi
    assert ulps(dugdale.FOLD_WITHOUT_CONTACT, reference.cbrt(9 * pi / (16 * (pi - 1)))) <= 0.5
    assert ulps(dugdale.JUMP_WITHOUT_CONTACT, reference.cbrt(mpf(9) / 32)) <= 0.5
    root = reference.sqrt(mpf(3))
    assert ulps(any_law.TRANSITION_OVER_TABOR, 32 / (9 * root) * reference.cbrt(9 / (16 * pi))) <= 0.5
    assert ulps(any_law.cohesive_stress(work_of_adhesion=1.0, atomic_spacing=1.0), 16 / (9 * root)) <= 0.5


@pytest.mark.parametrize("radius", [1.0559497443981639e-06, 2e-7, 1e-6, 1e-5])
def test_no_stiffness_near_the_fold_is_positive(radius: float) -> None:
    """The true slope is negative. Rounding may hide its size; the result is then negative or nan, never positive."""
    iron: dict[str, Any] = {"radius": radius, "atomic_spacing": 4e-10}
    fold = jkroll.solve("fold_approach_maugis", model="maugis", material="iron", **iron)
    near = fold + numpy.arange(-4, 40) * abs(math.ulp(fold))
    stiffness = jkroll.solve("stiffness", model="maugis", material="iron", approach_at_load=near, **iron)
    assert not (stiffness > 0).any()
    assert (stiffness[10:] < 0).any()


def test_states_a_few_ulp_from_pull_off_are_next_to_it() -> None:
    """The curve is level at pull-off, and its rounded slope may have either sign."""
    transitions = numpy.geomspace(1e-4, 1e4, 2000)
    least = dugdale.pull_off_ratio(transitions)
    tension = -state(transitions, least)["load"]
    for steps in range(20):
        loads = -tension + steps * numpy.spacing(tension)
        ratios = dugdale.ratio_at_load(transitions, loads, least, tension)
        assert numpy.all((ratios >= least) & (ratios <= least * (1 + 0.05)))


@pytest.mark.parametrize("transition", [0.1, 0.3, 1.0, 3.0])
@pytest.mark.parametrize(("points", "bound"), [(96, 3e-3), pytest.param(256, 1e-3, marks=pytest.mark.slow)])
def test_rolling_moment_agrees_with_a_three_dimensional_contact(transition: float, points: int, bound: float) -> None:
    values = state(transition, ratio_at_load(transition, 0.0))
    lag = 0.05 * values["radius"]
    found = rolling_moment(transition=transition, load=0.0, zone_radius=values["zone"], lag=lag, points=points)
    assert math.isclose(found, values["moment"] * lag, rel_tol=bound)


@pytest.mark.parametrize(
    ("tabor", "ratio"), [(0.03, 1.99468), (0.1, 1.96896), (0.5, 1.78748), (1.0, 1.67068), (2.0, 1.58349)]
)
def test_pull_off_force_by_lennard_jones(tabor: float, ratio: float) -> None:
    """The numbers are those of tests/tools/lennard_jones.py."""
    force = any_law.pull_off_force_lennard_jones(
        work_of_adhesion=1 / math.pi, reduced_radius=1.0, tabor_parameter=tabor
    )
    assert math.isclose(force, ratio, rel_tol=3e-3)


@pytest.mark.parametrize(
    ("tabor", "well", "at_dead_load"),
    [(0.03, 2.90929, 0.34858), (0.1, 3.03744, 0.52705), (0.3, 3.50893, 1.15878), (0.7, 4.58361, 2.31711)],
)
def test_energies_by_lennard_jones(tabor: float, well: float, at_dead_load: float) -> None:
    """The numbers are those of tests/tools/lennard_jones.py."""
    scene = {"work_of_adhesion": 1 / math.pi, "reduced_radius": 1.0, "atomic_spacing": 1.0, "tabor_parameter": tabor}
    assert math.isclose(any_law.well_energy_lennard_jones(**scene), well, rel_tol=2e-3)
    assert math.isclose(any_law.dead_load_work_lennard_jones(**scene), at_dead_load, rel_tol=5e-3)


def test_energies_of_rigid_spheres_by_lennard_jones() -> None:
    """Half-spaces at H = z/z0 part with a work of (8/3)(1/2H² - 1/8H⁸)w: 0 where a sphere rests, largest at H = 1."""

    def to_infinity(gap: float) -> float:  # of the force, 2πR times that work; 2πRw = 2 here
        return 16 / 3 * (1 / (2 * gap) - 1 / (56 * gap**7))

    scene = {"work_of_adhesion": 1 / math.pi, "reduced_radius": 1.0, "atomic_spacing": 1.0, "tabor_parameter": 1e-9}
    well, at_rest = any_law.well_energy_lennard_jones(**scene), 4 ** (-1 / 6)
    assert math.isclose(well, to_infinity(at_rest), rel_tol=1e-6)
    at_dead_load = any_law.dead_load_work_lennard_jones(**scene)
    assert math.isclose(at_dead_load, to_infinity(at_rest) - to_infinity(1.0), rel_tol=1e-6)
