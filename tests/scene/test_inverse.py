"""The inverse problem: a value put in comes back, every solution is found, and what has none is refused."""

import json
import math
from random import Random
from typing import Any

import numpy
import pytest

import jkroll
from harness import Run
from jkroll import Measured, infer, known_materials, solve
from jkroll.scene.inverse import AlreadyGiven, CannotInfer, NoDependence, NoSolution, SeveralSolutions, solution
from jkroll.scene.scene import Scene
from scenes import OTHER, QUARTZ, log_uniform

# Inputs, and quantities that depend on each of them in one way only.
PAIRS = {
    "surface_energy": ("pull_off_force", "contact_radius", "approach", "well_energy", "yield_force", "stiffness"),
    "work_of_adhesion": ("pull_off_force", "contact_radius", "sticking_energy"),
    "yield_displacement": ("yield_force", "yield_moment", "r_min"),
    "youngs_modulus": ("contact_radius", "approach", "stiffness", "vertical_frequency"),
    "radius": ("pull_off_force", "contact_radius"),
    "load": ("contact_radius_at_load", "yield_moment"),
}
PLANE: dict[str, Any] = {"radius": 2e-6, "radius2": math.inf}


@pytest.mark.parametrize(("name", "quantity"), [(name, each) for name, every in PAIRS.items() for each in every])
def test_a_value_comes_back(name: str, quantity: str) -> None:
    random = Random(f"{name} {quantity}")
    for other in ({}, OTHER):
        for _ in range(3):
            scene: dict[str, Any] = {**QUARTZ, **other}
            if name == "load":
                scene["load"] = random.uniform(-0.9, 3) * solve("pull_off_force", **scene)
            elif name == "work_of_adhesion":
                scene = {each: value for each, value in scene.items() if not each.startswith("surface_energy")}
                scene[name] = log_uniform(random, 1e-3, 10)
            else:
                scene[name] = scene.get(name, 2e-10) * log_uniform(random, 0.1, 10)
            value = scene.pop(name)
            measured = solve(quantity, **scene, **{name: value})
            found = solution(name, quantity, measured, Scene(scene))
            assert found.value == pytest.approx(value, rel=1e-15 * (2 + 4 * found.condition))
            assert found.forward == pytest.approx(measured, rel=1e-15 * (2 + 4 / found.condition))


def test_the_condition_of_a_power_law_is_its_inverse_exponent() -> None:
    assert solution("surface_energy", "pull_off_force", 3e-7, Scene(PLANE)).condition == 1
    scene = Scene(PLANE, known_materials()["quartz"])
    assert solution("youngs_modulus", "contact_radius", 3e-8, scene).condition == pytest.approx(3, rel=1e-5)


def test_an_example_by_hand() -> None:
    found = infer("surface_energy", measured={"pull_off_force": 3e-7}, **PLANE)
    assert found == pytest.approx(3e-7 / (3 * math.pi * 2e-6), rel=1e-15)


def test_all_solutions_are_named() -> None:
    scene = Scene({"load": 5e-8}, known_materials()["quartz"])
    with pytest.raises(SeveralSolutions) as caught:
        solution("radius", "approach_at_load", 3e-10, scene)
    for radius in caught.value.values:
        assert scene.replace(radius=radius)["approach_at_load"] == pytest.approx(3e-10, rel=1e-14)
    assert str(caught.value) == "radius: 352.067 nm and 846.302 nm all give approach_at_load = 300 pm"


def test_two_solutions_between_two_points_of_the_scan_are_found() -> None:
    scene = Scene({"load": 5e-8}, known_materials()["quartz"])
    least = min(scene.replace(radius=1e-9 * radius)["approach_at_load"] for radius in range(400, 700))
    with pytest.raises(SeveralSolutions) as caught:
        solution("radius", "approach_at_load", 1.00001 * least, scene)
    low, high = caught.value.values
    assert 1 < high / low < 1.1


def test_a_load_is_found_up_to_pull_off() -> None:
    scene = Scene(PLANE, known_materials()["quartz"])
    force = scene["pull_off_force"]
    at_pull_off = scene.replace(load=-force)["contact_radius_at_load"]
    assert solution("load", "contact_radius_at_load", at_pull_off, scene).value == pytest.approx(-force, rel=1e-12)
    unloaded = solution("load", "contact_radius_at_load", scene["contact_radius"], scene)
    assert abs(unloaded.value) < 1e-15 * force
    with pytest.raises(NoSolution):
        solution("load", "contact_radius_at_load", 0.9 * at_pull_off, scene)


def test_both_spheres_of_one_material_are_inferred_together() -> None:
    quartz = known_materials()["quartz"]
    alone, twice = Scene({"radius": 1e-6}, quartz), Scene({"radius": 1e-6}, quartz, quartz)
    values = [solution("surface_energy", "pull_off_force", 1e-7, scene).value for scene in (alone, twice)]
    assert values[0] == values[1]


@pytest.mark.parametrize(
    ("name", "quantity", "given", "error", "words"),
    [
        ("youngs_modulus", "pull_off_force", {}, NoDependence, "pull_off_force does not depend on it here"),
        ("load", "load", {}, NoDependence, "load does not depend on it here"),
        ("gravity", "n_grav", {}, CannotInfer, "'gravity' cannot be inferred; surface_energy,"),
        ("surface_energy", "pull_off_force", {"surface_energy": 1.0}, AlreadyGiven, "is given and asked for"),
        ("surface_energy", "pull_off_force", {"work_of_adhesion": 1.0}, AlreadyGiven, "one follows from the other"),
        ("load", "contact_radius_at_load", {"approach_at_load": 1e-9}, AlreadyGiven, "one follows from the other"),
        ("load", "stiffness", {"youngs_modulus2": math.inf, "youngs_modulus": math.inf}, jkroll.JkrollError, "rigid"),
    ],
)
def test_refusals(name: str, quantity: str, given: dict[str, float], error: type[Exception], words: str) -> None:
    with pytest.raises(error, match=words):
        solution(name, quantity, 1e-9, Scene({"radius": 1e-6, **given}, known_materials()["quartz"]))


def test_nothing_is_extrapolated() -> None:
    with pytest.raises(NoSolution, match=r"it lies between 18.8496 pN and 18.8496 mN for 1 µJ/m² to 1 kJ/m²"):
        infer("gamma", measured={"pull_off_force": "3 N"}, **PLANE)


@pytest.mark.parametrize(
    ("name", "measured", "words"),
    [
        (None, {"pull_off_force": 3e-9}, "'None' cannot be inferred"),
        (["gamma"], {"pull_off_force": 3e-9}, "cannot be inferred"),
        ("gamma", None, "'None' is not one quantity and its value"),
        ("gamma", "pull_off_force=3nN", "is not one quantity and its value"),
        ("gamma", {3: 3e-9}, "'3' is not a quantity"),
        ("gamma", {"pull_off_force": math.nan}, "pull_off_force: nan must be positive"),
        ("gamma", {"pull_off_force": [3e-9, -3e-9]}, "pull_off_force: -3e-09 must be positive"),
        ("gamma", {"pull_off_force": 1e300}, "must lie between 1e-60 and 1e60"),
    ],
)
def test_wrong_arguments_are_refused_in_words(name: Any, measured: Any, words: str) -> None:
    with pytest.raises(jkroll.JkrollError, match=words):
        infer(name, measured=measured, **PLANE)


def test_arrays_hold_nan_where_there_is_no_solution() -> None:
    found = infer("gamma", measured={"pull_off_force": [1e-7, 2e-7, 3.0]}, radius=[[1e-6], [2e-6]], radius2="plane")
    assert found.shape == (2, 3)
    assert numpy.isnan(found[:, 2]).all()
    assert found[0, 0] == pytest.approx(2 * found[1, 0], rel=1e-15)


def test_an_uncertain_measurement_gives_an_uncertain_answer() -> None:
    found = infer("gamma", measured={"pull_off_force": "300±20 nN"}, radius="2 um", radius2="plane")
    assert isinstance(found, Measured)
    assert found.plus == found.minus == pytest.approx(found.value / 15, rel=1e-12)
    both = infer("gamma", measured={"pull_off_force": "300±20 nN"}, radius="2.0±0.1 um", radius2="plane")
    assert both.plus / both.value == pytest.approx(math.hypot(1 / 15, 1 / 20), rel=0.01)
    span = infer("gamma", measured={"pull_off_force": "280 to 320 nN"}, radius="1.9 to 2.1 um", radius2="plane")
    assert (span.low, span.high) == pytest.approx((found.value * 14 / 15 / 1.05, found.value * 16 / 15 / 0.95))


def test_the_laws_of_attraction_stand_beside_each_other(run: Run) -> None:
    ran = run("infer", "gamma", "quartz", "100nm", "--measured", "pull_off_force=15.00375nN", "--json")
    (result,) = json.loads(ran.out)["results"]
    assert result["value"] == pytest.approx(31.84e-3, abs=5e-6)
    assert result["by_law"] == pytest.approx({"maugis": 25.00e-3, "dmt": 23.88e-3}, abs=5e-6)
    for law, gamma in result["by_law"].items():
        measured = solve("pull_off_force", material="quartz", radius=1e-7, surface_energy=gamma, model=law)
        assert measured == pytest.approx(15.00375e-9, rel=1e-13)
        assert infer("gamma", measured={"pull_off_force": measured}, material="quartz", radius=1e-7, model=law) == (
            pytest.approx(gamma, rel=1e-13)
        )
    hysteresis = infer("adhesion-hysteresis", measured={"yield_force": "0.85 nN"}, material="quartz", radius=1e-6)
    assert solve("yield_force", material="quartz", radius=1e-6, adhesion_hysteresis=hysteresis) == pytest.approx(
        8.5e-10
    )


def test_the_command(run: Run) -> None:
    words = ["infer", "gamma", "quartz", "2um", "--radius2", "plane", "--measured"]
    ran = run(*words, "pull-off-force=300±20 nN", "--to", "mJ/m2", "--digits", "4")
    assert (ran.code, ran.out) == (
        0,
        "surface_energy 15.92 mJ/m2\nsurface_energy_minus 1.061 mJ/m2\nsurface_energy_plus 1.061 mJ/m2\n",
    )
    assert "note: γ of quartz is not used\n" in ran.err
    assert "gives P_c = 300 nN; κ = |d ln γ1/d ln P_c| = 1; 13.3793 mJ/m² under Maugis–Dugdale" in ran.err
    table = run(*words, "pull_off_force=300nN,3N", "--csv")
    assert table.out.splitlines() == [
        "material,radius [m],radius2 [m],pull_off_force [N],surface_energy [J/m^2]",
        "quartz,2e-06,plane,3e-07,0.015915494309189534",
        "quartz,2e-06,plane,3.0,",
    ]
    assert (table.code, table.err.splitlines()[-1]) == (1, "jkroll: 1 of 2 rows failed")


def test_an_inferred_value_is_explained_by_the_formula_of_what_was_measured(run: Run) -> None:
    words = "infer gamma quartz 2um --radius2 plane --measured pull_off_force=300±20nN,3N"
    found, forward, failed = run(f"{words} --explain").out.split("\n\n")
    assert found.splitlines()[1:3] == ["  result    γ1 = 15.9 ± 1.1 mJ/m²", "  shares    P_c 100%"]
    assert "times κ = 1\n" in found
    assert "  by law    13.3793 mJ/m² (maugis), 11.9366 mJ/m² (dmt)" in found
    assert forward.startswith("pull_off_force — pull-off force, Eq 1\n  P_c = 3πγR")
    assert "    γ1 = 15.9155 mJ/m²     surface energy per surface\n" in forward
    assert "  result    P_c = 300 nN\n" in forward
    assert "no value gives pull_off_force = 3 N" in failed
    ran = run(f"{words} --cite")
    assert (ran.code, ran.err) == (1, "jkroll: 1 of 2 rows failed\n")
    assert "{Eq. (1)}" in ran.out


@pytest.mark.parametrize(
    ("words", "code", "message"),
    [
        ("infer", 2, "infer needs an input: one of surface_energy, "),
        ("infer gamma quartz 1um", 2, "infer needs what was measured: --measured pull_off_force=300nN"),
        ("infer gamma quartz 1um --measured 3nN", 2, "--measured: write a quantity and its value"),
        ("infer gamma quartz 1um --measured pull_off_force=3nm", 2, "pull_off_force: '3nm' is a length; "),
        (
            "infer gama quartz 1um --measured pull_off_force=3nN",
            2,
            "'gama' cannot be inferred; did you mean surface_energy?",
        ),
        ("infer young quartz 1um --measured pull_off_force=3nN", 1, "youngs_modulus: pull_off_force does not depend"),
        ("infer gamma quartz --measured pull_off_force=3nN", 2, "pull_off_force needs radius of sphere 1; give"),
    ],
)
def test_one_line_says_what_is_wrong(run: Run, words: str, code: int, message: str) -> None:
    ran = run(words)
    assert (ran.code, ran.out) == (code, "")
    assert ran.err.startswith(f"jkroll: {message}")
    assert ran.err.count("\n") == 1


@pytest.mark.parametrize(
    ("words", "message"),
    [
        ("load quartz 2um --measured load=3nN", "load: load does not depend on it here"),
        ("gamma quartz 2um --measured gamma=3mJ/m2", "surface_energy: surface_energy does not depend on it here"),
        ("gamma quartz 2um --measured energy_ratio=3", "surface_energy: energy_ratio does not depend on it here"),
        ("gamma quartz 2um --measured yield_force=1e50N", "surface_energy: no value gives yield_force = 1e+50 N"),
    ],
)
def test_the_reason_is_said_of_inputs_and_of_absurd_values_too(run: Run, words: str, message: str) -> None:
    ran = run(f"infer {words}")
    assert (ran.code, ran.out) == (1, "")
    assert ran.err.startswith(f"jkroll: {message}")
