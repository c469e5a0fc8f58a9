"""Frames: one plan for all quantities, failures that do not affect other quantities, and changed inputs."""

import gc
from itertools import combinations, islice
from typing import Any
from weakref import ref

import numpy
import pytest

from frames import outcomes
from jkroll import solve
from jkroll.errors import BadRequest
from jkroll.materials.library import known_materials
from jkroll.model.frame import Frame
from jkroll.model.limits import LIMITS
from jkroll.model.other_law import at_half_spacing
from jkroll.model.plan import KEPT, depends_on, formula_of, plan_for
from jkroll.model.reasons import BEYOND_PULL_OFF, NO_CHAIN, NO_DOUBLE, Failure, MissingInput
from jkroll.physics import FORMULAS
from jkroll.quantities.nomenclature import NOMENCLATURE
from relative import approx
from scenes import QUARTZ

LIMIT_NAMES = dict.fromkeys(limit.name for limit in LIMITS)


def test_quantities_computed_together_equal_those_computed_separately() -> None:
    scene = Frame({**QUARTZ, "viscous_time": 1e-12, "speed": 1.0, "filling_factor": 0.1, "yield_strength": 1e10,
        "humidity": 0.5, "roughness_gap": 1e-9, "monomers": 1000.0})  # fmt: skip
    values = outcomes(scene, ("pull_off_force", "n_roll", *LIMIT_NAMES))
    assert all(Frame(scene.stated)[name] == value for name, value in values.items())
    assert scene.inputs_of("pull_off_force") == ("radius", "surface_energy")


def test_a_quantity_that_fails_does_not_affect_the_others() -> None:
    scene = Frame({**QUARTZ, "radius2": float("inf"), "load": -1.0}).replace(density=1e-30)
    values = outcomes(scene, ("r_min", "pull_off_force", "yield_force", "n_grav", "mass", "speed"))
    outcome_of = {name: value.cause if isinstance(value, Failure) else type(value) for name, value in values.items()}
    assert outcome_of == {
        "r_min": NO_CHAIN, "pull_off_force": float, "yield_force": BEYOND_PULL_OFF, "n_grav": BEYOND_PULL_OFF,
        "mass": float,
        "speed": MissingInput,
    }  # fmt: skip
    for name, outcome in outcome_of.items():
        if outcome is not float:
            with pytest.raises((Failure, MissingInput)):
                scene[name]


def test_results_that_need_a_number_beyond_the_range_of_doubles_have_no_value() -> None:
    tiny = {**QUARTZ, "radius": 1e-30, "youngs_modulus": 1e30, "atomic_spacing": 1e29}
    values = outcomes(Frame(tiny, model="maugis"), ("pull_off_force", "sticking_energy", "sticking_speed"))
    assert isinstance(values["pull_off_force"], float)
    for name in ("sticking_energy", "sticking_speed"):
        assert values[name].cause == NO_DOUBLE
        assert "sticking_energy_maugis: no value that a double can hold" in str(values[name])


def test_only_quantities_of_a_plane_may_be_infinite() -> None:
    radii = numpy.array([1e30, 1e-7, float("inf")])
    found = outcomes(Frame({**QUARTZ, "density": 1e3, "radius2": radii}), ("r_min", "moment_of_inertia2"))
    assert numpy.isnan(found["r_min"]).tolist() == [False, False, True]
    assert numpy.isinf(found["moment_of_inertia2"]).tolist() == [False, False, True]


def test_replacing_inputs_leaves_the_original_frame_unchanged() -> None:
    scene = Frame(QUARTZ)
    assert scene["pull_off_force"] > 0
    doubled = scene.replace(radius=2e-7)
    assert doubled["pull_off_force"] == 2 * scene["pull_off_force"]
    assert scene.values["radius"] == 1e-7
    with pytest.raises(MissingInput):
        scene.replace(surface_energy=None)["pull_off_force"]
    other = Frame({**QUARTZ, "radius": 2e-7}, model="dmt")
    assert scene.replace(model="dmt", radius=2e-7)["pull_off_force"] == other["pull_off_force"]


def test_arrays_are_evaluated_anew_if_sphere_2_loses_its_own_surface_energy() -> None:
    radii = numpy.array([1e-7, 2e-7])
    unlike = Frame({**QUARTZ, "radius": radii, "surface_energy2": 0.08})
    alike = Frame({**QUARTZ, "radius": radii})
    assert (unlike["pull_off_force"] > alike["pull_off_force"]).all()
    assert (unlike.replace(surface_energy2=None)["pull_off_force"] == alike["pull_off_force"]).all()


@pytest.mark.parametrize("name", ["youngs_modulus2", "radius2"])
def test_arrays_that_do_not_broadcast_are_refused(name: str) -> None:
    """Moduli also decide which bodies are rigid, and radii a material's displacement; the shapes are checked first."""
    arrays = {name.removesuffix("2"): numpy.ones(2), name: numpy.ones(3)}
    with pytest.raises(BadRequest, match=rf"do not broadcast: {name.removesuffix('2')} \(2,\), {name} \(3,\)"):
        Frame(arrays, known_materials()["silica-dry"])


def test_every_parameter_leads_back_to_an_input() -> None:
    """The formulas of the nomenclature lead back to inputs that a user can give, or to names that have routes."""
    wanted = [name for name in NOMENCLATURE if name in FORMULAS]
    ends = {name for name in depends_on(tuple(wanted)) if formula_of(name) is None}
    without_option = {name for name in ends if name not in NOMENCLATURE or not NOMENCLATURE[name].option}
    have_routes = {"edge_ratio", "contact_artanh", "restructuring_energy_ormel"}
    assert without_option == {"radius", *have_routes}


def test_a_load_margin_sets_the_same_state_as_its_load() -> None:
    pull_off = solve("pull_off_force", **QUARTZ)
    names = ("load", "approach_at_load", "contact_radius_at_load", "yield_moment", "yield_force_fixed_load")
    for margin in (0.0, 0.5, 2.0):
        by_margin = [solve(name, load_margin=margin, **QUARTZ) for name in names]
        by_load = [solve(name, load=(margin**2 - 1) * pull_off, **QUARTZ) for name in names]
        assert by_margin == approx(by_load, rel=1e-14)
    with pytest.raises(BadRequest, match="exclude each other"):
        solve("approach_at_load", load_margin=0.5, load=1e-9, **QUARTZ)


@pytest.mark.parametrize("name", ["tangential_stiffness", "twisting_stiffness", "hertz_pressure", "sliding_frequency"])
def test_stiffnesses_of_spheres_bound_without_touching_are_zero(name: str) -> None:
    apart: dict[str, Any] = {"model": "maugis", "atomic_spacing": 4e-10, "approach_at_load": -3.89e-10}
    assert solve("contact_radius_at_load", **QUARTZ, **apart) == 0
    assert solve(name, **QUARTZ, **apart) == 0


def test_a_frame_is_freed_with_its_last_reference_although_other_laws_were_computed() -> None:
    """The program seeks cycles only after 50 000 new objects, and a block of a long table makes only a few."""
    gc.disable()
    try:
        scene = Frame({**QUARTZ, "radius": numpy.geomspace(1e-8, 1e-6, 5)})
        outcomes(scene.by_law, LIMIT_NAMES)
        outcomes(at_half_spacing(scene.by_law), LIMIT_NAMES)
        last_seen = ref(scene)
        del scene
        assert last_seen() is None
    finally:
        gc.enable()


def test_the_cache_of_plans_is_bounded() -> None:
    results = [*filter(formula_of, NOMENCLATURE)]
    for known in islice(combinations(results, 3), 30):
        for name in results:
            plan_for(name, frozenset(known), False)
    assert plan_for.cache_info().currsize <= KEPT < plan_for.cache_info().misses
