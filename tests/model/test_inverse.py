"""The inverse problem: inputs are recovered, every solution is found, and a problem without a solution is refused."""

import csv
import json
import math
import pickle
from itertools import product
from pathlib import Path
from random import Random
from typing import Any

import numpy
import pytest

import jkroll
from frames import solved
from harness import Run
from jkroll import Interval, Measured, infer, known_materials, solve
from jkroll.errors import BadRequest, NoResult
from jkroll.model.frame import Frame
from jkroll.model.inverse import Inverse
from jkroll.model.reasons import cause_and_step
from jkroll.model.search import Solution
from jkroll.model.uncertainty import sources_of_results
from jkroll.model.unknowns import NoDependence, NoSolution, SeveralSolutions, Undetermined
from jkroll.quantities.values import parse_quantity
from relative import approx
from scenes import OTHER, QUARTZ, log_uniform

# Inputs, each with a quantity that determines it uniquely.
PAIRS = [
    *product(
        ["surface_energy"],
        ["pull_off_force", "contact_radius", "approach", "well_energy", "yield_force", "stiffness"],
    ),
    *product(["work_of_adhesion"], ["pull_off_force", "contact_radius", "sticking_energy"]),
    *product(["yield_displacement"], ["yield_force", "yield_moment", "r_min"]),
    *product(["youngs_modulus"], ["contact_radius", "approach", "stiffness", "vertical_frequency"]),
    *product(["radius"], ["pull_off_force", "contact_radius"]),
    *product(["load"], ["contact_radius_at_load", "yield_moment"]),
]
PLANE: dict[str, Any] = {"radius": 2e-6, "radius2": math.inf}


def solution(name: str, quantity: str, measured: float, scene: Frame) -> Solution:
    """Return the solution for one unknown."""
    return solved((name,), {quantity: measured}, scene)


@pytest.mark.parametrize(("name", "quantity"), PAIRS)
def test_an_input_is_recovered_from_each_quantity(name: str, quantity: str) -> None:
    random = Random(f"{name} {quantity}")
    for other in ({}, OTHER):
        for _ in range(2):
            scene: dict[str, Any] = {**QUARTZ, **other}
            if name == "load":
                scene["load"] = random.uniform(-0.9, 3) * solve("pull_off_force", **scene)
            elif name == "work_of_adhesion":
                scene.pop("surface_energy")
                scene.pop("surface_energy2", None)
                scene[name] = log_uniform(random, 1e-3, 10)
            else:
                scene[name] = scene.get(name, 2e-10) * log_uniform(random, 0.1, 10)
            value = scene.pop(name)
            measured = solve(quantity, **scene, **{name: value})
            found = solution(name, quantity, measured, Frame(scene))
            assert found.values == approx({name: value}, rel=1e-15 * (2 + 4 * found.condition))
            forward = Frame({**scene, **found.values})[quantity]
            assert forward == approx(measured, rel=1e-15 * (2 + 4 / found.condition))


def test_the_condition_of_a_power_law_is_its_inverse_exponent() -> None:
    assert solution("surface_energy", "pull_off_force", 3e-7, Frame(PLANE)).condition == 1
    scene = Frame(PLANE, known_materials()["quartz"])
    assert solution("youngs_modulus", "contact_radius", 3e-8, scene).condition == approx(3, rel=1e-5)


def test_the_surface_energy_from_a_pull_off_force_is_that_by_hand() -> None:
    found = infer("surface_energy", measured={"pull_off_force": 3e-7}, **PLANE)
    assert found == approx(3e-7 / (3 * math.pi * 2e-6), rel=1e-15)


@pytest.mark.parametrize("word", ["approach", "delta0", "δ0"])
def test_a_measured_approach_means_the_approach_without_load_as_in_solve(word: str) -> None:
    """At any load, `approach` is δ0 = (3π²w²R/4E*²)^(1/3), here with E* = E/2(1 − ν²) of equal spheres."""
    scene = {name: value for name, value in QUARTZ.items() if name != "youngs_modulus"}
    radius, work, ratio = scene["radius"], 2 * scene["surface_energy"], scene["poisson_ratio"]
    modulus = math.sqrt(3 * math.pi**2 * work**2 * radius / 2 / (4 * 1e-9**3)) * 2 * (1 - ratio**2)
    for load in (0.0, 1e-7):
        assert infer("young", measured={word: 1e-9}, **scene, load=load) == approx(modulus, rel=1e-12)
        assert infer("young", measured={word: [1e-9]}, **scene, load=load) == approx([modulus], rel=1e-12)


@pytest.mark.parametrize(("quantity", "given"), [("approach_at_load", 1e-9), ("pull_off_force", 5e-8)])
@pytest.mark.parametrize("values", [2e-9, [2e-9, 3e-9]])
def test_a_measured_quantity_cannot_also_be_an_input(quantity: str, given: float, values: Any) -> None:
    scene = {name: value for name, value in QUARTZ.items() if name != "surface_energy"}
    with pytest.raises(BadRequest, match=f"{quantity} is given, and also measured or to be inferred"):
        infer("gamma", measured={quantity: values}, **{**scene, quantity: given})


def test_the_error_names_all_solutions() -> None:
    scene = Frame({"load": 5e-8}, known_materials()["quartz"])
    with pytest.raises(SeveralSolutions) as caught:
        solution("radius", "approach_at_load", 3e-10, scene)
    for values in caught.value.values:
        assert scene.replace(**values)["approach_at_load"] == approx(3e-10, rel=1e-14)
    assert str(caught.value) == "radius: 352.067 nm and 846.302 nm both give approach_at_load = 300 pm"


@pytest.mark.parametrize("model", ["jkr", "maugis"])
@pytest.mark.parametrize("quantity", ["rolling_frequency", "n_grav", "sliding_frequency"])
def test_two_solutions_between_pull_off_and_the_next_value_of_the_scan_are_found(quantity: str, model: str) -> None:
    """Under tension, as R grows from pull-off, the quantity has a maximum before the next radius of the scan."""
    scene = Frame({"load": -5e-9}, known_materials()["quartz"], model=model)
    least = 4e-8 if model == "jkr" else 3e-8
    radii = numpy.geomspace(least, 1.3 * least, 4000)
    curve = scene.replace(radius=radii)[quantity]
    start = numpy.flatnonzero(~numpy.isnan(curve))[0]
    level = float(numpy.nanmax(curve) * 0.999 + curve[start] * 0.001)
    with pytest.raises(SeveralSolutions) as caught:
        solution("radius", quantity, level, scene)
    assert len(caught.value.values) == 2
    for values in caught.value.values:
        assert scene.replace(**values)[quantity] == approx(level, rel=1e-12)


def test_two_loads_near_pull_off_give_one_rolling_force_under_a_load_of_fixed_direction() -> None:
    scene = Frame({**QUARTZ, "radius": 1e-6, "radius2": 1e-7})
    with pytest.raises(SeveralSolutions) as caught:
        solution("load", "yield_force_fixed_load", 51.6e-12, scene)
    assert [values["load"] for values in caught.value.values] == approx([-21.4058e-9, -20.7695e-9], rel=1e-5)


def test_a_load_that_changes_only_the_last_digits_is_found() -> None:
    """Near such a load the quantity changes by single roundings, which are not jumps."""
    scene = Frame({**QUARTZ, **PLANE})
    radius = scene.replace(load=2e-15)["contact_radius_at_load"]
    for ulps in range(-20, 21, 4):
        found = solution("load", "contact_radius_at_load", radius + ulps * math.ulp(radius), scene)
        assert scene.replace(**found.values)["contact_radius_at_load"] == approx(radius, rel=1e-14)


def test_a_solution_at_a_value_of_the_scan_hides_no_other_solution() -> None:
    """δ is least at a radius that grows with the load, here at 1.03 µm; 1 µm is a value of the scan."""
    quartz = known_materials()["quartz"]
    radii = numpy.geomspace(4e-7, 7e-7, 10001)
    least = radii[Frame({"load": 5e-8, "radius": radii}, quartz)["approach_at_load"].argmin()]
    scene = Frame({"load": 5e-8 * 1.03e-6 / least}, quartz)
    with pytest.raises(SeveralSolutions) as caught:
        solution("radius", "approach_at_load", scene.replace(radius=1e-6)["approach_at_load"], scene)
    low, high = (values["radius"] for values in caught.value.values)
    assert low == approx(1e-6, rel=1e-9)
    assert 1.05 < high / low < 1.08


@pytest.mark.parametrize("measured", ["31.4159pN", f"{2 * math.pi * 0.025 * 2e-10!r}N", "1e50N"])
def test_a_change_by_rounding_is_not_taken_for_dependence(run: Run, measured: str) -> None:
    """In DMT, 2πγξ is computed from a pull-off force and a radius, so its last digits vary with the radius."""
    forces = {solve("yield_force", material="quartz", radius=1e-9 * 1.1**step, model="dmt") for step in range(100)}
    assert len(forces) > 1
    ran = run(f"infer radius quartz --measured yield_force={measured} --model dmt")
    assert (ran.code, ran.err) == (1, "jkroll: radius: yield_force does not depend on the unknown here\n")


@pytest.mark.parametrize("quantity", ["load_maugis", "load_at_factor"])
def test_the_search_ends_if_only_rounding_changes_the_quantity(quantity: str) -> None:
    """The load is given and computed back from its state, so γ changes only its last digits, up and down."""
    given = {**QUARTZ, "radius": 1e-4, "youngs_modulus": 8e7, "load": 1e-12}
    del given["surface_energy"]
    with pytest.raises(SeveralSolutions) as caught:
        solution("surface_energy", quantity, 1e-12 * (1 + 1e-13), Frame(given))
    assert 1 < len(caught.value.values) < 200


@pytest.mark.parametrize("ulp", [-4, 0, 4])
def test_a_range_of_radii_with_the_same_sticking_speed_is_reported(ulp: int) -> None:
    """By Maugis' law v_stick of quartz does not depend on the radius below some 7 µm."""
    given: dict[str, Any] = {"material": "quartz", "model": "maugis", "atomic_spacing": 4e-10}
    speed = solve("sticking_speed", radius=1e-6, **given) * (1 + ulp * 2.0**-52)
    with pytest.raises(Undetermined, match=r"every value from 1 pm to 7\.187\d* µm gives sticking_speed") as caught:
        infer("radius", measured={"sticking_speed": speed}, **given)
    parameter = solve("transition_parameter", radius=caught.value.span[1], **given)
    assert parameter == approx((9 / 32) ** (1 / 3), rel=1e-3)  # for smaller ones, spheres jump in before they touch
    assert math.isnan(infer("radius", measured={"sticking_speed": [speed, speed]}, **given)[0])


@pytest.mark.parametrize(
    ("name", "quantity", "given", "error", "words"),
    [
        ("youngs_modulus", "pull_off_force", {}, NoDependence, "pull_off_force does not depend on the unknown here"),
        ("load", "load", {}, BadRequest, "load is given, and also measured or to be inferred"),
        ("gravity", "n_grav", {}, BadRequest, "'gravity' cannot be inferred; surface_energy,"),
        ("surface_energy", "pull_off_force", {"surface_energy": 1.0}, BadRequest, "is given, and also measured or"),
        ("surface_energy", "pull_off_force", {"work_of_adhesion": 1.0}, BadRequest, "one follows from the other"),
        ("load", "contact_radius_at_load", {"approach_at_load": 1e-9}, BadRequest, "one follows from the other"),
        ("load", "stiffness", {"youngs_modulus2": math.inf, "youngs_modulus": math.inf}, jkroll.JkrollError, "rigid"),
    ],
)
def test_an_inverse_problem_is_refused_with_its_reason(
    name: str, quantity: str, given: dict[str, float], error: type[Exception], words: str
) -> None:
    with pytest.raises(error, match=words):
        solution(name, quantity, 1e-9, Frame({"radius": 1e-6, **given}, known_materials()["quartz"]))


@pytest.mark.parametrize(
    ("name", "quantity", "measured", "given"),
    [
        ("youngs_modulus", "pull_off_force", 1e-8, {"radius": 1e-6}),
        ("surface_energy", "pull_off_force", 1e26, {"radius": 1e-6}),
        ("radius", "approach_at_load", 3e-10, {"load": 5e-8}),
    ],
)
def test_an_error_can_be_pickled(name: str, quantity: str, measured: float, given: dict[str, float]) -> None:
    with pytest.raises(NoResult) as caught:
        solution(name, quantity, measured, Frame(given, known_materials()["quartz"]))
    assert str(pickle.loads(pickle.dumps(caught.value))) == str(caught.value)


def test_no_solution_is_extrapolated() -> None:
    with pytest.raises(NoSolution, match=r"it lies between 18.8496 pN and 18.8496 mN for γ1 = 1 µJ/m² to 1 kJ/m²"):
        infer("gamma", measured={"pull_off_force": "1e26 N"}, **PLANE)


def test_without_a_usual_solution_all_allowed_values_are_scanned() -> None:
    """P_c = 3πγR for a sphere on a plane, and w = 2γ. Two of the four forces need γ beyond the usual sizes."""
    given: dict[str, Any] = {"radius": 2.5e-6, "radius2": math.inf}
    gamma = 21e-12 / (3 * math.pi * 2.5e-6)
    assert infer("gamma", measured={"pull_off_force": 21e-12}, **given) == approx(gamma, rel=1e-14)
    assert infer("work_of_adhesion", measured={"pull_off_force": 21e-12}, **given) == approx(2 * gamma, rel=1e-14)
    forces = [21e-12, 3e-7, 3e20, 1e-9]
    found = infer("gamma", measured={"pull_off_force": forces}, **given)
    assert found.tolist() == approx([force / (3 * math.pi * 2.5e-6) for force in forces], rel=1e-14)


def test_a_solution_beyond_the_usual_values_has_a_warning(run: Run) -> None:
    words = ("infer", "gamma", "2.5um", "--radius2", "plane", "--measured")
    warning = "warning: γ1 = 891.268 nJ/m² is beyond usual values, γ1 = 1 µJ/m² to 1 kJ/m²\n"
    assert warning in run(*words, "P_c=21pN").err
    assert "beyond usual values" not in run(*words, "P_c=24pN").err


@pytest.mark.parametrize("measured", [1.0, 1e-30])
def test_the_range_that_an_error_states_has_exact_ends(measured: float) -> None:
    """The softer body sets the shear strength, so the sliding energy has a maximum at E1 = E2, inside the scan."""
    given: dict[str, Any] = {"radius": 1e-6, "surface_energy": 0.03, "poisson_ratio": 0.3, "youngs_modulus2": 2e9}
    ends = [solve("sliding_energy", **given, youngs_modulus=modulus) for modulus in (1.0, 2e9)]
    with pytest.raises(NoSolution) as error:
        infer("youngs_modulus", measured={"sliding_energy": measured}, **given)
    assert error.value.span == approx(ends, rel=1e-8)


@pytest.mark.parametrize(
    ("name", "measured", "words"),
    [
        (None, {"pull_off_force": 3e-9}, "'None' cannot be inferred"),
        (["gravity"], {"pull_off_force": 3e-9}, "'gravity' cannot be inferred"),
        ("gamma", None, "'None' does not give a quantity and its value"),
        ("gamma", "pull_off_force=3nN", "does not give a quantity and its value"),
        ("gamma", {3: 3e-9}, "'3' is not a quantity"),
        ("gamma", {"pull_off_force": math.nan}, "pull_off_force: nan must be a number"),
        ("gamma", {"pull_off_force": [3e-9, -3e-9]}, "pull_off_force: -3e-09 at index 1 must be positive"),
        ("gamma", {"pull_off_force": 1e300}, "must lie between 1e-30 and 1e30"),
    ],
)
def test_wrong_arguments_are_refused_with_a_reason(name: Any, measured: Any, words: str) -> None:
    with pytest.raises(jkroll.JkrollError, match=words):
        infer(name, measured=measured, **PLANE)


def test_an_uncertain_measurement_gives_an_uncertain_result() -> None:
    found = infer("gamma", measured={"pull_off_force": "300±20 nN"}, radius="2 um", radius2="plane")
    assert isinstance(found, Measured)
    assert found.plus == found.minus == approx(found.value / 15, rel=1e-12)
    both = infer("gamma", measured={"pull_off_force": "300±20 nN"}, radius="2.0±0.1 um", radius2="plane")
    assert both.plus / both.value == approx(math.hypot(1 / 15, 1 / 20), rel=0.01)
    span = infer("gamma", measured={"pull_off_force": "280 to 320 nN"}, radius="1.9 to 2.1 um", radius2="plane")
    assert (span.low, span.high) == approx((found.value * 14 / 15 / 1.05, found.value * 16 / 15 / 0.95))


@pytest.mark.parametrize("stiffness", [1e3, [1e3, 2e3]])
def test_uncertainties_of_a_material_alone_give_no_error_bars(stiffness: Any) -> None:
    """The γ of warm ice has ± and its E a range, which enter only together with an error bar of a measured value."""
    values = infer("radius", measured={"stiffness": stiffness}, material="ice-warm")
    assert isinstance(values, float if isinstance(stiffness, float) else numpy.ndarray)
    assert isinstance(infer("radius", measured={"stiffness": "1000±10 N/m"}, material="ice-warm"), Interval)


def test_each_source_enters_an_inferred_value_once() -> None:
    """The radius of sphere 2 is that of sphere 1, so its error enters once; the error of the density does not enter."""
    given = {
        name: Interval(value, 0.9 * value, 1.1 * value) for name, value in {"radius": 1e-6, "density": 2e3}.items()
    }
    inverse = Inverse(("surface_energy",), {"pull_off_force": Interval(1e-7, 9e-8, 1.1e-7)}, Frame(given))
    sources = sources_of_results(inverse, ["surface_energy"]).entering
    assert [source.names for source in sources] == [("radius", "radius2"), ("pull_off_force",)]


def test_an_inferred_value_is_also_given_by_the_other_laws(run: Run) -> None:
    ran = run("infer", "gamma", "quartz", "100nm", "--measured", "pull_off_force=15.00375nN", "--json")
    (result,) = json.loads(ran.out)["results"]
    assert result["value"] == approx(31.84e-3, abs=5e-6)
    assert result["by_law"] == approx({"maugis": 25.00e-3, "dmt": 23.88e-3}, abs=5e-6)
    for law, gamma in result["by_law"].items():
        measured = solve("pull_off_force", material="quartz", radius=1e-7, surface_energy=gamma, model=law)
        assert measured == approx(15.00375e-9, rel=1e-13)
        assert infer("gamma", measured={"pull_off_force": measured}, material="quartz", radius=1e-7, model=law) == (
            approx(gamma, rel=1e-13)
        )
    hysteresis = infer("adhesion-hysteresis", measured={"yield_force": "0.85 nN"}, material="quartz", radius=1e-6)
    assert solve("yield_force", material="quartz", radius=1e-6, adhesion_hysteresis=hysteresis) == approx(8.5e-10)


OF_A_PLANE = ["infer", "gamma", "quartz", "2um", "--radius2", "plane", "--measured"]


def test_an_inferred_value_and_both_sides_of_its_uncertainty_have_a_line_each(run: Run) -> None:
    ran = run(*OF_A_PLANE, "pull-off-force=300±20 nN", "--to", "mJ/m2", "--digits", "4")
    assert (ran.code, ran.out) == (
        0,
        "surface_energy 15.92 mJ/m2\nsurface_energy_minus 1.061 mJ/m2\nsurface_energy_plus 1.061 mJ/m2\n",
    )


def test_the_explanation_says_what_is_not_used_and_what_the_value_gives(run: Run) -> None:
    explained = run(*OF_A_PLANE, "pull-off-force=300±20 nN", "--explain").out
    assert "note: γ of quartz is not used\n" in explained
    assert "gives P_c = 300 nN if γ2 = γ1, so w = 31.831 mJ/m²\n" in explained.partition(" is multiplied by κ = 1\n")[2]


def test_a_list_of_measured_values_gives_rows_with_doubts_or_failures(run: Run) -> None:
    table = run(*OF_A_PLANE, "pull_off_force=300nN,1e26N", "--csv")
    assert table.out.splitlines() == [
        "material,radius [m],radius2 [m],pull_off_force [N],surface_energy [J/m^2],doubt,status",
        "quartz,2e-6,plane,3e-7,0.015915494309189534,law-off-5% rough-matters,",
        "quartz,2e-6,plane,1e26,,,no value gives it",
    ]
    assert "no value gives pull_off_force = 1e26 N" in table.err
    doubted = run(*OF_A_PLANE, "pull_off_force=300nN,310nN", "--csv").err
    assert "(jkroll guide doubts; best ranges: --best): law-off-5% 2, rough-matters 2" in doubted
    assert (table.code, table.err.splitlines()[-1]) == (1, "jkroll: 1 of 2 rows failed")


def column(table: str, name: str) -> list[str]:
    """Return the cells of a column of CSV."""
    return [row[name] for row in csv.DictReader(table.splitlines())]


@pytest.mark.parametrize(
    ("words", "inferred"),
    [
        ("radius quartz --measured pull_off_force=3nN,4nN", {"radius [m]", "radius2 [m]"}),
        (
            "gamma quartz 1um --material2 quartz --measured pull_off_force=3nN,4nN",
            {"surface_energy [J/m^2]", "surface_energy2 [J/m^2]"},
        ),
    ],
)
def test_inferred_values_are_not_listed_as_inputs(run: Run, words: str, inferred: set[str]) -> None:
    header, *rows = csv.reader(run(f"infer {words} --csv").out.splitlines())
    assert inferred & {*header} == {header[-3]}
    assert all(row[-3] for row in rows)
    inputs = json.loads(run(f"infer {words.replace(',4nN', '')} --json").out)["inputs"]
    assert inferred.isdisjoint(inputs)


def test_the_uncertainty_of_sphere_2_enters_the_inferred_value_of_sphere_1() -> None:
    """P_c is proportional to √(γ1γ2), so γ1 is proportional to 1/γ2 at a measured force."""
    given: dict[str, Any] = {"radius": 1e-6, "surface_energy2": Measured(0.025, 0.001)}
    found = infer("gamma", measured={"pull_off_force": 2e-7}, **given)
    assert isinstance(found, Measured)
    assert found.plus / found.value == approx(0.04, rel=0.05)


def test_rows_have_the_doubts_of_the_inferred_value(run: Run) -> None:
    """The doubts are those of `pull-off` at the inferred radii."""
    ran = run("infer radius quartz --measured pull_off_force=0.1nN,10nN,10mN --csv")
    radii = ",".join(column(ran.out, "radius [m]"))
    assert column(ran.out, "doubt") == column(
        run("pull-off", "quartz", radii.replace(",", "m,") + "m", "--csv").out, "doubt"
    )
    assert column(ran.out, "doubt") == ["law-off-25% few-atoms may-yield", "law-off-25%", "rough-matters"]
    assert "best ranges: --best): law-off-25% 2, rough-matters 1, few-atoms 1, may-yield 1" in ran.err
    assert not any(column(run("infer gamma quartz 1um --measured pull_off_force=1e26N,2e26N --csv").out, "doubt"))


def test_10001_rows_are_written_bare_but_refused_as_json(run: Run) -> None:
    words = "infer gamma quartz 2um --radius2 plane --measured pull_off_force=1nN:1uN:10001 --quiet"
    ran = run(f"{words} --bare")
    assert (ran.code, ran.err) == (0, "")
    found = [*map(float, ran.out.split())]
    forces = numpy.geomspace(1e-9, 1e-6, 10001)
    assert found == approx(forces / (3 * math.pi * 2e-6), rel=1e-12)
    refused = run(f"{words} --json")
    assert (refused.code, refused.out) == (2, "")
    assert refused.err == "jkroll: --json writes at most 10000 pairs, not 10001; --csv writes any number\n"


def test_each_row_states_the_missing_input_even_if_all_rows_lack_it(run: Run) -> None:
    """Tables of other commands do the same."""
    ran = run("infer gamma 1um,2um --measured contact_radius=30nm --csv")
    assert ran.code == 1
    assert column(ran.out, "status") == ["needs youngs_modulus and poisson_ratio"] * 2
    assert "give --young 10GPa --poisson 0.3" in ran.err


def test_an_inferred_value_is_explained_by_the_formula_of_the_measured_quantity(run: Run) -> None:
    words = "infer gamma quartz 2um --radius2 plane --measured pull_off_force=300±20nN,1e26N"
    found, forward, failed = (part for part in run(f"{words} --explain").out.split("\n\n") if "—" in part)
    assert found.splitlines()[1:3] == ["  result    γ1 = 15.9 ± 1.1 mJ/m²", "  shares    P_c 100%"]
    assert "multiplied by κ = 1\n" in found
    assert "  by law    13.3793 mJ/m² (maugis), 11.9366 mJ/m² (dmt)" in found
    assert forward.startswith("pull_off_force — pull-off force, Eq 1\n  P_c = 3πγR")
    assert "    γ1 = 15.9155 mJ/m²     surface energy per surface\n" in forward
    assert "  result    P_c = 300 nN\n" in forward
    assert "no value gives pull_off_force = 1e26 N" in failed
    ran = run(f"{words} --cite")
    assert (ran.code, ran.err) == (1, "jkroll: 1 of 2 rows failed\n")
    assert "{Eq. (1)}" in ran.out


def test_the_explanation_includes_steps_that_do_not_depend_on_the_unknown(run: Run) -> None:
    ran = run("infer gamma quartz 100nm --measured vertical_frequency=1GHz --explain")
    assert "    m1 = 1.08909e-17 kg    m1 = (4/3)πR1³ρ\n" in ran.out  # (4/3)π(100 nm)³ times 2600 kg/m³


@pytest.mark.parametrize(
    ("words", "code", "message"),
    [
        ("infer", 2, "infer needs an input: one of surface_energy, "),
        ("infer gamma quartz 1um", 2, "infer needs a measured quantity for each input, 1 in all: --measured pull"),
        ("infer gamma quartz 1um --measured 3nN", 2, "--measured: write a quantity and its value"),
        ("infer gamma quartz 1um --measured pull_off_force=3nm", 2, "pull_off_force: '3nm' is a length; "),
        (
            "infer gama quartz 1um --measured pull_off_force=3nN",
            2,
            "'gama' cannot be inferred; surface_energy, work_of_adhesion, hamaker,",
        ),
        ("infer load quartz 2um --measured load=3nN", 2, "load is given, and also measured or to be inferred"),
        (
            "infer gamma quartz 2um --measured gamma=3mJ/m2",
            2,
            "surface_energy is given, and also measured or to be inferred",
        ),
        ("infer young quartz 1um --measured pull_off_force=3nN", 1, "youngs_modulus: pull_off_force does not depend"),
        ("infer gamma quartz --measured pull_off_force=3nN", 2, "pull-off force needs radius of sphere 1; give"),
    ],
)
def test_a_mistake_is_reported_in_one_line(run: Run, words: str, code: int, message: str) -> None:
    ran = run(words)
    assert (ran.code, ran.out) == (code, "")
    assert ran.err.startswith(f"jkroll: {message}")
    assert ran.err.count("\n") == 1


@pytest.mark.parametrize(
    ("words", "message"),
    [
        ("gamma quartz 2um --measured energy_ratio=3", "surface_energy: energy_ratio does not depend on the"),
        ("gamma quartz 2um --measured yield_force=1e50N", "surface_energy: no value gives yield_force = 1e50 N"),
    ],
)
def test_assumed_inputs_and_absurd_values_are_refused_with_a_reason(run: Run, words: str, message: str) -> None:
    ran = run(f"infer {words}")
    assert (ran.code, ran.out) == (1, "")
    assert ran.err.startswith(f"jkroll: {message}")


@pytest.mark.parametrize("part", [1.0, 0.3, 0.1, 0.03])
def test_the_solutions_that_an_error_names_have_enough_digits_to_be_inputs(part: float) -> None:
    """Near pull-off six digits are too few: the frequency falls to 0 there."""
    given: dict[str, Any] = {"material": "quartz", "model": "dmt", "load": -2.8e-8}
    frequency = part * solve("vertical_frequency", radius=2e-7, **given)
    with pytest.raises(SeveralSolutions) as caught:
        infer("radius", measured={"vertical_frequency": frequency}, **given)
    for text in caught.value.explanation().partition(" both give")[0].split(" and "):
        radius = parse_quantity(text, "radius")
        assert solve("vertical_frequency", radius=radius, **given) == approx(frequency, rel=2e-3)


@pytest.mark.parametrize("measured", ["hysteresis_fraction=1", "adhesion_hysteresis=20mJ/m2"])
def test_an_input_without_a_formula_cannot_be_measured(run: Run, measured: str) -> None:
    """The error names the option by which to give the value."""
    ran = run(f"infer xi quartz 100nm --measured {measured}")
    name = measured.partition("=")[0]
    option = f"--{name.replace('_', '-')}"
    assert ran.err == (
        f"jkroll: {name} is an input, and no formula gives it; give it as {option}, and ask for yield_displacement "
        "without infer\n"
    )
    assert ran.code == 2
    assert run(f"report quartz 100nm --quantities xi {option} {measured.partition('=')[2]}").code == 0


def test_a_measured_displacement_replaces_the_assumed_one(run: Run) -> None:
    said = run("infer adhesion_hysteresis quartz 100nm --measured xi=300pm", terminal=True).out
    assert "ξ = 300 pm\nassumed: no load" in said
    assert "200 pm" not in said


def test_results_of_a_failed_inference_have_its_reason() -> None:
    """The reason appears only in the row with a force that no surface energy can produce."""
    measured = {"pull_off_force": numpy.array([1e-7, -1.0, 2e-7])}
    inverse = Inverse(["surface_energy"], measured, Frame({**PLANE, "youngs_modulus": 5e10, "poisson_ratio": 0.2}))
    columns = inverse.columns(["surface_energy", "pull_off_force", "contact_radius"])
    for name, column in columns.items():
        assert [cause.phrase if cause else "" for cause, _ in map(cause_and_step, column.reasons.tolist())] == [
            "", "no value gives it", ""
        ], name  # fmt: skip
        assert "no value gives pull_off_force = -1 N" in str(inverse.error(name, int(column.reasons[1]), 1))
    assert columns["surface_energy"].values[::2] == approx([1e-7 / (3 * math.pi * 2e-6), 2e-7 / (3 * math.pi * 2e-6)])
    assert columns["pull_off_force"].values[::2] == approx(measured["pull_off_force"][::2])


def test_the_best_range_is_by_jkr_only_if_maugis_law_gives_no_value(run: Run) -> None:
    words = "infer young quartz 1um --measured yield_force=100pN --hysteresis-fraction 40%"
    said = " ".join(run(words).err.split())
    assert "best range of E: 2.7e12 Pa (JKR only); by Maugis' law no value gives yield_force = 100 pN" in said
    assert "no value gives yield_force = 100 pN" in run(f"{words} --model maugis").err


def test_rows_of_two_solids_are_inferred(run: Run) -> None:
    """Two spheres of one solid share the surface energy; with two solids, infer gives the energy of sphere 1."""
    Path("in.csv").write_text("material,material2,radius,P_c\niron,iron,1um,300nN\niron,quartz,1um,300nN\n")
    assert run("batch in.csv -o out.csv --infer gamma --measured P_c").code == 0
    with open("out.csv", encoding="utf-8", newline="") as file:
        rows = [float(row["surface_energy [J/m^2]"]) for row in csv.DictReader(file)]
    work = 300e-9 / (1.5 * math.pi * 0.5e-6)
    quartz = solve("surface_energy", material="quartz", radius=1e-6)
    assert rows == approx([work / 2, (work / 2) ** 2 / quartz])


def test_rows_that_fail_show_their_inputs(run: Run) -> None:
    words = "infer adhesion_hysteresis quartz 1um --measured yield_force=3nN --model jkr,dmt --csv"
    _, dmt = csv.DictReader(run(words).out.splitlines())
    assert (dmt["status"], float(dmt["youngs_modulus [Pa]"])) == ("not in DMT", 54e9)


def test_without_a_load_no_uncertain_contact_is_beyond_pull_off(run: Run) -> None:
    assert "beyond pull-off" not in run("infer gamma quartz 1um --measured a=10±5nm").err


def test_two_unknowns_of_uncertain_solids_are_the_same_in_rows_and_single_calls(run: Run) -> None:
    """The error bars of several solids are arrays with two axes."""
    words = "radius,gamma {} --measured pull_off_force={} --measured contact_radius=5nm --csv --quiet"
    rows = run("infer", *words.format("silica-humid,silica-dry,mica", "1nN:1uN:5").split()).out.splitlines()
    heads, rows = rows[0].split(","), rows[1:]
    silica = dict(zip(heads, next(row for row in rows if row.startswith("silica-humid,")).split(","), strict=True))
    head, single = run("infer", *words.format("silica-humid", "1nN").split()).out.splitlines()
    for name, cell in zip(head.split(","), single.split(","), strict=True):
        is_text = name in ("material", "doubt", "status") or not cell
        assert silica[name] == cell if is_text else float(silica[name]) == approx(float(cell), rel=1e-9), name
