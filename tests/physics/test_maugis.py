"""Maugis' contact against his own equations in 120 digits, quadrature, limits, other theories and a 3-D solver."""

import math
from typing import Any

import numpy
import pytest

import jkroll
import maugis_reference as reference
import maugis_rivals as rivals
from jkroll.physics import any_law, dugdale, maugis
from jkroll.scene.wiring import parameters_of
from maugis_boundary_elements import rolling_moment
from maugis_reference import Exact, mpf

BOUND = 10.0  # ulp, times 1 plus the condition in the load or approach and in λ
UNIT = {"work_of_adhesion": 1 / math.pi, "reduced_radius": 1.0, "contact_modulus": 0.75}  # in which all units are 1

# λ: −P̄ at pull-off; then Ā, δ̄, k̄ and −Φ̄ without load. Computed at 90 digits from Maugis' equations and the closed
# energy.
PRINTED = {
    0.01: (
        "1.9982877843215089083 1.2693666336872056853 1.4600454795258214652 1.8768996237088486450 65.427945895368515576"
    ),
    0.1: (
        "1.9505948921234289055 1.3361798084375040120 1.2924253454824103000 1.8073069117643995518 7.9887144690404900973"
    ),
    0.3: (
        "1.8155558270448521470 1.4418125525780610752 1.2007720436870045549 1.7368405246813545145 3.7161934249729344407"
    ),
    1.0: (
        "1.6007349112540914600 1.6360904896091255212 1.1298938914698703659 1.6665618613535844055 2.3098211117246998207"
    ),
    3.0: (
        "1.5167639000369277835 1.7749050688096475979 1.1057124031314381929 1.6407335729789905072 2.0288434778409739128"
    ),
    10.0: (
        "1.5016248604263581614 1.8126249543255590490 1.1011420871107963599 1.6359288470975518272 1.9856737533477376737"
    ),
}


def state(transition: Any, edge_ratio: Any) -> dict[str, Any]:
    """Return all of a contact, dimensionless."""
    at = dugdale.Shape(edge_ratio)
    span = dugdale.span(transition, at)
    approach = dugdale.approach(transition, at, span)
    return {
        "radius": edge_ratio * span,
        "zone": at.n * span,
        "approach": approach,
        "load": dugdale.load(transition, at, span),
        "moment": transition * span * span * at.g3,
        "stiffness": stiffness(transition, at, span),
        "energy": dugdale.energy(transition, at, span, approach),
    }


def stiffness(transition: float, at: dugdale.Shape, span: Any) -> Any:
    """Return dP/dδ, in contact or apart."""
    return 1.5 * span * dugdale.stiffness_ratio(at, 4 / 3 * transition / span)


def ratio_at_load(transition: Any, load: Any) -> Any:
    """Return v at a load."""
    least = dugdale.pull_off_ratio(transition)
    return dugdale.ratio_at_load(transition, load, least, -state(transition, least)["load"])


def ratio_at_approach(transition: Any, approach: Any) -> Any:
    """Return v at an approach."""
    least = dugdale.fold_ratio(transition)
    return dugdale.ratio_at_approach(transition, approach, least, dugdale.lowest_approach(transition, least))


_UNITS = ("length_unit_maugis", "approach_unit_maugis", "energy_unit_maugis")
_OF_TRANSITION = ("unloaded_edge_ratio", "edge_ratio_at_pull_off", "edge_ratio_at_fold")


def alone(formula: Any, transition: Any, unit: Any = 1.0) -> Any:
    """Return the result of a formula that the transition parameter decides on, but for the unit."""
    ratios = {name: getattr(maugis, name) for name in _OF_TRANSITION if name in parameters_of(formula)}
    found = {name: ratio(transition_parameter=transition) for name, ratio in ratios.items()}
    units = {name: unit for name in _UNITS if name in parameters_of(formula)}
    return formula(**units, transition_parameter=transition, **found)


def exact_state(transition: Exact, a: Exact, t: Exact) -> dict[str, Exact]:
    load = reference.load(a, t, transition)
    return {
        "radius": a,
        "zone": a * reference.sqrt(1 + t**2),
        "approach": reference.approach(a, t, transition),
        "load": load,
        "moment": a**3 - load,
    }


def ulps(value: Any, exact: Exact) -> float:
    return float(abs(mpf(float(value)) - exact)) / math.ulp(float(exact))


@pytest.mark.parametrize("transition", PRINTED)
def test_reference_values(transition: float) -> None:
    pull_off, *unloaded = map(mpf, PRINTED[transition].split())
    at_pull_off = maugis.edge_ratio_at_pull_off(transition_parameter=transition)
    given = {**_without_modulus(), "transition_parameter": transition}
    assert ulps(maugis.pull_off_force_maugis(edge_ratio_at_pull_off=at_pull_off, **given), pull_off) <= BOUND
    values = state(transition, ratio_at_load(transition, 0.0))
    for name, exact in zip(("radius", "approach", "stiffness", "energy"), unloaded, strict=True):
        assert ulps(abs(values[name]), exact) <= BOUND, name


def _without_modulus() -> dict[str, float]:
    return {name: value for name, value in UNIT.items() if name != "contact_modulus"}


@pytest.mark.parametrize("transition", [0.94, 0.95, 1.0, 3.0, 30.0, 1e3])
def test_fold_in_contact(transition: float) -> None:
    edge_ratio = dugdale.fold_ratio(transition)
    a, t = reference.fold(mpf(transition))
    exact = exact_state(mpf(transition), a, t)
    values = state(transition, edge_ratio)
    condition = 1 + transition / (transition - dugdale.FOLD_WITHOUT_CONTACT)
    assert ulps(values["radius"], exact["radius"]) <= BOUND * condition
    for name in ("approach", "load", "zone"):
        assert ulps(values[name], exact[name]) <= 2 * BOUND, name


@pytest.mark.parametrize("transition", [0.03, 0.5, 0.9379, 2.0])
def test_energy_is_the_integral_of_the_force(transition: float) -> None:
    edge_ratio = ratio_at_load(transition, 0.0)
    a, t = reference.at_load(mpf(transition), mpf(0))
    with reference.digits.workdps(30):
        exact = reference.energy_by_quadrature(t, mpf(transition))
    assert abs(reference.contact_energy(a, t, mpf(transition)) / exact - 1) < mpf(10) ** -20
    assert math.isclose(state(transition, edge_ratio)["energy"], exact, rel_tol=1e-14)


def gap_energy(transition: float, zone: float) -> float:
    approach = zone**2 / 2 - 8 * transition * zone / (3 * math.pi) - 2 / (math.pi * transition)
    return float(dugdale.energy(transition, dugdale.Shape(0.0), zone, approach))


@pytest.mark.parametrize("transition", [0.01, 0.3, 0.6])
def test_sticking_energy_where_neither_jump_touches(transition: float) -> None:
    b = 8 * transition / (3 * math.pi)
    value = alone(maugis.sticking_energy_maugis, transition)
    assert math.isclose(value, 17 / 24 * math.pi * transition * b**4, rel_tol=1e-14)
    difference = gap_energy(transition, b) - gap_energy(transition, 2 * b)
    assert math.isclose(value, difference, rel_tol=1e-9, abs_tol=1e-14)


@pytest.mark.parametrize("edge", [dugdale.FOLD_WITHOUT_CONTACT, dugdale.JUMP_WITHOUT_CONTACT])
@pytest.mark.parametrize(
    "energy",
    [maugis.sticking_energy_maugis, maugis.pull_off_work_maugis, maugis.well_energy_maugis],
)
def test_energies_are_continuous(energy: Any, edge: float) -> None:
    below, above = (alone(energy, edge * (1 + side)) for side in (-1e-9, 1e-9))
    assert math.isclose(below, above, rel_tol=1e-7)
    at = alone(energy, edge)
    assert math.isclose(at, below, rel_tol=1e-7)


def test_constants() -> None:
    pi = reference.pi
    assert ulps(dugdale.FOLD_WITHOUT_CONTACT, reference.cbrt(9 * pi / (16 * (pi - 1)))) <= 0.5
    assert ulps(dugdale.JUMP_WITHOUT_CONTACT, reference.cbrt(mpf(9) / 32)) <= 0.5
    root = reference.sqrt(mpf(3))
    assert ulps(any_law.TRANSITION_OVER_TABOR, 32 / (9 * root) * reference.cbrt(9 / (16 * pi))) <= 0.5
    assert ulps(any_law.cohesive_stress(work_of_adhesion=1.0, atomic_spacing=1.0), 16 / (9 * root)) <= 0.5


@pytest.mark.parametrize("transition", [0.2, 0.5, 0.7, 0.9, 0.937])
def test_spheres_that_attract_without_contact(transition: float) -> None:
    lowest = dugdale.lowest_approach(transition, dugdale.fold_ratio(transition))
    assert dugdale.fold_ratio(transition) == 0.0
    at = dugdale.Shape(0.0)
    touch = dugdale.span(transition, at)
    touching = dugdale.approach(transition, at, touch)
    assert math.isclose(dugdale.span_apart(transition, touching), touch, rel_tol=1e-12)
    for approach in numpy.linspace(lowest, touching, 7)[1:-1].tolist():
        zone = dugdale.span_apart(transition, approach)
        assert ratio_at_approach(transition, approach) == 0.0
        assert math.isclose(dugdale.load(transition, at, zone), -math.pi * transition / 2 * zone**2, rel_tol=1e-14)
        assert stiffness(transition, at, zone) < 0
    b = 8 * transition / (3 * math.pi)
    assert math.isclose(dugdale.span_apart(transition, lowest), b, rel_tol=1e-6)


@pytest.mark.parametrize("transition", [0.05, 0.5, 0.9, 0.95, 5.0])
def test_load_and_stiffness_are_derivatives(transition: float) -> None:
    step = 1e-5
    lowest = dugdale.lowest_approach(transition, dugdale.fold_ratio(transition))
    for approach in (lowest + 0.05, lowest + 0.4, 0.3, 2.0):
        energies, loads = [], []
        for each in (approach - step, approach, approach + step):
            at = dugdale.Shape(ratio_at_approach(transition, each))
            span = dugdale.span(transition, at) if at.v > 0 else dugdale.span_apart(transition, each)
            energies.append(dugdale.energy(transition, at, span, each))
            loads.append(dugdale.load(transition, at, span))
            if each == approach:
                slope = stiffness(transition, at, span)
        assert math.isclose((energies[2] - energies[0]) / (2 * step), loads[1], rel_tol=1e-5, abs_tol=1e-6)
        assert math.isclose((loads[2] - loads[0]) / (2 * step), slope, rel_tol=1e-4)


@pytest.mark.parametrize("radius", [1.0559497443981639e-06, 2e-7, 1e-6, 1e-5])
def test_no_stiffness_at_the_fold_is_that_of_a_stable_contact(radius: float) -> None:
    """Within rounding of the fold the slope has no limit, and no sign that doubles can tell."""
    iron: dict[str, Any] = {"radius": radius, "atomic_spacing": 4e-10}
    fold = jkroll.solve("fold_approach_maugis", model="maugis", material="iron", **iron)
    near = fold + numpy.arange(-4, 40) * abs(math.ulp(fold))
    stiffness = jkroll.solve("stiffness", model="maugis", material="iron", approach_at_load=near, **iron)
    assert not (stiffness > 0).any()
    assert (stiffness[10:] < 0).any()


def test_the_stiffness_falls_without_limit_towards_the_fold() -> None:
    """Which is at q = G3/h, and h is 1 where the circle shrinks to a point."""
    at = dugdale.Shape(0.0)
    ratios = [dugdale.stiffness_ratio(at, at.g3 * (1 - part)) for part in (1e-1, 1e-5, 1e-10, 0.0)]
    assert ratios == sorted(ratios, reverse=True)
    assert ratios[-1] == -math.inf


def test_limit_of_jkr() -> None:
    transition = 1e4
    values = state(transition, ratio_at_load(transition, 0.0))
    assert math.isclose(values["radius"], 6 ** (1 / 3), rel_tol=1e-8)
    assert math.isclose(values["approach"], 6 ** (2 / 3) / 3, rel_tol=1e-8)
    assert math.isclose(values["moment"], 6.0, rel_tol=1e-7)  # 4P_c
    unit = 1.5 * 6 ** (2 / 3) / 3  # P_cδ0
    for energy, factor in (
        (maugis.well_energy_maugis, 6 / 5),
        (maugis.pull_off_work_maugis, 6 / 5 + 2 / 15 * 6 ** (-1 / 3)),
        (maugis.pull_off_work_at_dead_load_maugis, 6 / 5 - 2 / 5 * 2 ** (-1 / 3)),
    ):
        assert math.isclose(alone(energy, transition), factor * unit, rel_tol=1e-7)
    stick = (2 / 15 * 6 ** (-1 / 3) + 4 / 5 * (2 / 3) ** (1 / 3)) * unit
    value = alone(maugis.sticking_energy_maugis, transition)
    assert math.isclose(value, stick * (1 - 0.666 / transition), rel_tol=1e-6)


def test_limit_of_dmt() -> None:
    work = alone(maugis.pull_off_work_at_dead_load_maugis, 1e-20)
    assert math.isclose(work, 1.2 * 2 ** (2 / 3), rel_tol=1e-14)
    transition = 1e-4
    assert math.isclose(-state(transition, dugdale.pull_off_ratio(transition))["load"], 2.0, rel_tol=1e-6)
    for load in (-1.0, 0.0, 10.0):
        values = state(transition, ratio_at_load(transition, load))
        assert math.isclose(values["radius"] ** 3, load + 2, rel_tol=1e-3)
        assert math.isclose(values["moment"], 2.0, rel_tol=1e-3)


def test_states_outside_the_domain() -> None:
    with pytest.raises(ValueError, match="domain"):
        ratio_at_load(1.0, -1.61)
    with pytest.raises(ValueError, match="domain"):
        ratio_at_approach(0.5, dugdale.lowest_approach(0.5, dugdale.fold_ratio(0.5)) - 1e-9)
    ratios = ratio_at_load(1.0, numpy.array([-1.61, 0.0]))
    assert numpy.isnan(ratios).tolist() == [True, False]
    spans = maugis.zone_span_at_approach(
        edge_ratio=numpy.array([math.nan, 0.0]),
        approach_at_load=-1.3,
        length_unit_maugis=1.0,
        approach_unit_maugis=1.0,
        transition_parameter=0.5,
    )
    assert numpy.isnan(spans).tolist() == [True, False]


def test_states_at_huge_loads_carry_them() -> None:
    transitions = 10 ** numpy.random.default_rng(14).uniform(-4, 4, 2000)
    for size in (1e2, 1e4, 1e6, 1e8, 1e11, 1e14, 1e35, 1e60):
        at = dugdale.Shape(ratio_at_load(transitions, numpy.full(2000, size)))
        loads = dugdale.load(transitions, at, dugdale.span(transitions, at))
        numpy.testing.assert_allclose(loads, size, rtol=2e-14)


def test_the_span_keeps_its_digits_in_narrow_and_wide_rings() -> None:
    for ratio in [*numpy.geomspace(1e-3, 1e4, 300).tolist(), 1e-80, 1e8, 1e12, 1e30]:
        v = mpf(ratio)
        theta = reference.arcsec(1 / v)
        assert ulps(dugdale.g1(dugdale.Shape(ratio)), v + (1 - v * v) * theta) <= BOUND


def test_states_a_few_ulp_from_pull_off_are_next_to_it() -> None:
    """There the curve is level, and its slope as rounded may have either sign."""
    transitions = numpy.geomspace(1e-4, 1e4, 2000)
    least = dugdale.pull_off_ratio(transitions)
    tension = -state(transitions, least)["load"]
    for steps in range(20):
        loads = -tension + steps * numpy.spacing(tension)
        ratios = dugdale.ratio_at_load(transitions, loads, least, tension)
        assert numpy.all((ratios >= least) & (ratios <= least * (1 + 0.05)))


def test_contact_radius_of_carpick_ogletree_and_salmeron() -> None:
    for transition in numpy.geomspace(0.003, 100, 12).tolist():
        for load in (-1.2, 0.0, 3.0):
            radius = state(transition, ratio_at_load(transition, load))["radius"]
            assert math.isclose(rivals.carpick_radius(load, transition), radius, rel_tol=0.03)


def test_approach_of_pietrement_and_troyon() -> None:
    unloaded = 6 ** (2 / 3) / 3
    for transition in numpy.geomspace(0.01, 100, 9).tolist():
        approach = state(transition, ratio_at_load(transition, 0.0))["approach"]
        assert abs(rivals.pietrement_approach(0.0, transition) - approach) < 0.09 * unloaded


@pytest.mark.parametrize("transition", [0.1, 0.3, 1.0, 3.0])
@pytest.mark.parametrize(("points", "bound"), [(96, 3e-3), pytest.param(256, 1e-3, marks=pytest.mark.slow)])
def test_rolling_moment_of_a_three_dimensional_contact(transition: float, points: int, bound: float) -> None:
    values = state(transition, ratio_at_load(transition, 0.0))
    lag = 0.05 * values["radius"]
    found = rolling_moment(transition=transition, load=0.0, zone_radius=values["zone"], lag=lag, points=points)
    assert math.isclose(found, values["moment"] * lag, rel_tol=bound)


@pytest.mark.parametrize(
    ("tabor", "ratio"), [(0.03, 1.99468), (0.1, 1.96896), (0.5, 1.78748), (1.0, 1.67068), (2.0, 1.58349)]
)
def test_pull_off_of_lennard_jones(tabor: float, ratio: float) -> None:
    """Numbers of tests/tools/lennard_jones.py."""
    assert math.isclose(
        any_law.pull_off_force_lennard_jones(**_without_modulus(), tabor_parameter=tabor), ratio, rel_tol=3e-3
    )
