"""The laws of attraction in all results: Maugis' law compared with its limits and with his equations in 120 digits."""

import json
import math
import random
import re
from itertools import pairwise
from typing import Any

import numpy
import pytest
from hypothesis import given
from hypothesis import strategies as st

import maugis_reference as reference
from frames import factor_of_law, outcomes
from harness import Run
from jkroll import FORMULAS, NOMENCLATURE, JkrollError, solve
from jkroll.errors import BadRequest
from jkroll.materials.library import known_materials
from jkroll.model.estimate import estimates
from jkroll.model.frame import Frame
from jkroll.model.plan import plan_for
from jkroll.model.reasons import Failure, NotInLaw
from jkroll.model.results import Results
from jkroll.physics import jkr
from jkroll.quantities.laws import DEFAULT_LAW, LAWS, MODELS, Law, law_of, tables_of
from jkroll.report.curve import frames_of_curve
from jkroll.report.questions import QUESTIONS, question_about
from jkroll.report.report import Report
from jkroll.write.manual import page
from jkroll.write.sources import references
from maugis_reference import cbrt, mpf, pi
from relative import approx
from scenes import log_uniform

QUARTZ: dict[str, Any] = {"material": "quartz", "radius": 1e-7}


# --- Results of a state -----------------------------------------------------------------------------------------------


@given(
    load=st.floats(-0.9, 100).map(lambda load: round(load, 3)),
    radius=st.floats(-9, -4),
    model=st.sampled_from(["jkr", "maugis", "dmt"]),
    of_plane=st.booleans(),
)
def test_the_moment_is_xi_times_the_hertz_load_minus_the_load(
    load: float, radius: float, model: str, of_plane: bool
) -> None:
    """M = (4E*a³/3R − P)ξ in every law."""
    scene = {**QUARTZ, "radius": 10**radius, "radius2": math.inf if of_plane else 10**radius}
    force = solve("pull_off_force", model=model, **scene)
    names = ["contact_radius_at_load", "contact_modulus", "reduced_radius", "yield_moment", "approach_at_load"]
    found = solve(names, model=model, **scene, load=load * force)
    hertz = 4 * found["contact_modulus"] * found["contact_radius_at_load"] ** 3 / (3 * found["reduced_radius"])
    assert math.isclose(found["yield_moment"], (hertz - load * force) * 2e-10, rel_tol=1e-11)
    again = solve(["load", "stiffness"], model=model, **scene, approach_at_load=found["approach_at_load"])
    assert math.isclose(again["load"], load * force, rel_tol=1e-8, abs_tol=1e-8 * force)


@pytest.mark.parametrize(
    ("model", "radius", "spacing", "error"), [("jkr", 1e-3, 1e-11, 5e-4), ("dmt", 1e-9, 1e-6, 1e-2)]
)
def test_maugis_tends_to_jkr_and_to_dmt(model: str, radius: float, spacing: float, error: float) -> None:
    material = known_materials()["quartz"]
    given = {"radius": radius, "atomic_spacing": spacing, "speed": 1.0, "monomers": 100.0}
    solved = [Frame(given, material, model=law) for law in (model, "maugis")]
    names = [
        name
        for name, quantity in NOMENCLATURE.items()
        if not quantity.option and not quantity.is_word and not quantity.variant_of
    ]
    limits, between = (outcomes(scene, names) for scene in solved)
    shared = [name for name in names if isinstance(limits[name], float) and isinstance(between[name], float)]
    assert len(shared) > 80
    # The quantities of sticking approach their limits more slowly.
    slow = ("sticking_", "restitution", "lost_energy", "energy_over_sticking", "speed_over_sticking")
    for name in shared:
        tolerance = 20 * error if name.startswith(slow) else error
        # The displacement is compared relative to ξ, since it is 0 in DMT.
        smallest = error * 2e-10 if name == "contact_displacement" else 0.0
        assert math.isclose(between[name], limits[name], rel_tol=tolerance, abs_tol=smallest), name


@pytest.mark.parametrize(("model", "displacement"), [("jkr", 2e-10), ("maugis", 6.809966491779044e-12), ("dmt", 0.0)])
def test_the_contact_circle_lags_by_xi_in_jkr_and_not_at_all_in_dmt(model: str, displacement: float) -> None:
    """Under Maugis' law the circle lags by ξ/(1 + 3tĀ/2λ), where Ā and t solve his two equations without load."""
    assert solve("contact_displacement", **QUARTZ, model=model) == approx(displacement, rel=1e-14)
    loads = numpy.array([-1.0, 0.0, 1e-8])
    found = solve("contact_displacement", **QUARTZ, model=model, load=loads)
    assert math.isnan(found[0])  # the contact is broken
    assert found[1] == approx(displacement, rel=1e-14)
    assert (found[2] == found[1]) == (model != "maugis")


# --- Hysteresis of adhesion -------------------------------------------------------------------------------------------


def test_hysteresis_is_at_most_the_work_of_adhesion() -> None:
    """A hysteresis equal to the work of adhesion is allowed."""
    assert math.isclose(solve("hysteresis_ratio", **QUARTZ, adhesion_hysteresis=0.05), 1, rel_tol=1e-14)
    with pytest.raises(JkrollError, match=r"60 mJ/m² is more than the work of adhesion, 50 mJ"):
        solve("yield_moment", **QUARTZ, adhesion_hysteresis=0.06)


def test_dmt_has_no_edge_that_a_hysteresis_could_act_on() -> None:
    with pytest.raises(NotInLaw, match="radius of the zone of attraction, which DMT does not have"):
        solve("yield_moment", model="dmt", **QUARTZ, adhesion_hysteresis=0.01)


# --- Missing results --------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("model", ["jkr", "maugis", "dmt"])
def test_an_error_names_the_pull_off_force_of_the_law(model: str) -> None:
    force = solve("pull_off_force", model=model, **QUARTZ)
    names = ["contact_radius_at_load", "yield_moment", "stiffness"]
    for name in names:
        with pytest.raises(Failure, match="breaks this contact") as raised:
            solve(name, model=model, **QUARTZ, load=-1.01 * force)
        assert raised.value.numbers[1] == -force
    values = solve(names, model=model, **QUARTZ, load=numpy.array([-1.01 * force, 0.0]))
    assert all(math.isnan(value[0]) and value[1] > 0 for value in values.values())


def test_the_error_points_to_maugis_if_a_load_breaks_a_jkr_but_not_a_maugis_contact() -> None:
    found = Report(QUESTIONS["moment"], Frame({"radius": 1e-7, "load": -1.3e-8}, known_materials()["quartz"]))
    assert "--model maugis" in str(found.failure)
    assert solve("contact_radius_at_load", model="maugis", **QUARTZ, load=-1.3e-8) > 0


def test_spheres_can_be_bound_without_touching() -> None:
    found = solve(["contact_radius_at_load", "load", "zone_radius"], model="maugis", **QUARTZ, approach_at_load=-3e-10)
    assert found["contact_radius_at_load"] == 0
    assert found["load"] < 0 < found["zone_radius"]
    with pytest.raises(Failure, match="the spheres have parted"):
        solve("load", model="maugis", **QUARTZ, approach_at_load=-1e-9)
    shown = Report(
        QUESTIONS["contact"],
        Frame({"radius": 1e-7, "approach_at_load": -3e-10}, known_materials()["quartz"], model="maugis"),
    )
    assert any("bound without touching" in note.text for note in shown.notes)


@pytest.mark.parametrize("name", ["half_circles_moment", "boussinesq_pressure", "displacement_limit"])
def test_a_quantity_that_a_law_lacks_is_refused_with_the_law_to_give(name: str) -> None:
    with pytest.raises(NotInLaw, match="not in Maugis–Dugdale; give --model jkr"):
        solve(name, model="maugis", **QUARTZ)


# --- Tables and arrays ------------------------------------------------------------------------------------------------


# Formulas that apply to JKR only, in addition to those whose docstrings say so.
OF_JKR = (
    *(name for name in vars(jkr) if name in FORMULAS and not name.startswith("contact_area")),
    "pull_off_force",
    "contact_radius",
    "approach",
    "load_margin",
    "load_factor",
    "contact_radius_at_load",
    "approach_at_load",
    "stiffness",
    "boussinesq_pressure",
)
# Multiples of JKR's P_cδ0 in the literature: under any law, these are formulas of γ, R and E.
CONVENTIONS = ("paszun_dominik", "pencil_code")


@pytest.mark.parametrize("model", [name for name in LAWS if name != DEFAULT_LAW])
def test_no_result_of_another_law_uses_a_formula_of_jkr(model: str) -> None:
    """A law must have its own formula, or lack the quantity (None); otherwise JKR's formula would be used."""
    inputs = {"radius", "surface_energy", "youngs_modulus", "poisson_ratio", "density", "load", "yield_displacement"}
    known = frozenset({*inputs, "speed", "monomers", "filling_factor", "rolling_angle", "atomic_spacing", "gravity"})
    results = [name for name, quantity in NOMENCLATURE.items() if name not in known and not quantity.variant_of]
    results = [name for name in results if not NOMENCLATURE[name].is_word and not name.endswith(CONVENTIONS)]
    plans = [plan_for(name, known, own_material2=False, model=model) for name in results]
    possible = [plan for plan in plans if plan.is_possible]
    by_jkr = set()
    for plan in possible:
        for step in plan.steps.values():
            if step.formula and (step.name in OF_JKR or re.search(r"Valid: +JKR(?! is)", step.formula.__doc__)):
                by_jkr.add((plan.name, step.name))
    assert by_jkr == {("adhesion_energy", "adhesion_energy")}  # P_cδ0 of JKR itself, a unit of energy


# Quantities in their own right that are also the formula of another quantity under some law.
SHARED = ("kinetic_energy", "contact_radius_at_load", "pull_off_force_dmt", "roll_energy_quarter_turn")


def test_every_route_leads_to_a_formula_of_the_nomenclature() -> None:
    for law in LAWS.values():
        for _, table in tables_of(law):
            for name, route in table.items():
                assert name in NOMENCLATURE, f"{law.title} has a route for {name}, which is no quantity"
                assert route is None or NOMENCLATURE[route].variant_of or route in SHARED, (
                    f"{route} would be {law.title}'s alone: write a formula {name}_{law.name}"
                )
                if route is not None:
                    assert route in FORMULAS, f"write {route} in physics, and list its module in physics/__init__.py"
                    assert NOMENCLATURE[route].unit == NOMENCLATURE[name].unit


@pytest.mark.parametrize("law", LAWS.values(), ids=LAWS)
def test_every_law_has_a_source_and_a_reference(law: Law) -> None:
    if not law.is_default:
        assert law.source, f"name the source of {law.title} in its Law: results show it instead of an equation"
    assert references()[law.name].keys() >= {"key", "type", "author", "year"}, (
        f"--cite needs the reference of {law.title}"
    )


@pytest.mark.parametrize("size", [1, 7, 28, 29])
def test_arrays_in_blocks_of_any_size_give_the_same_results(size: int, monkeypatch: pytest.MonkeyPatch) -> None:
    """Some results depend on both arrays, some on one, and some on none."""
    radii, energies = numpy.geomspace(1e-8, 1e-5, 29), numpy.linspace(0.02, 0.5, 29)
    given: dict[str, Any] = {**QUARTZ, "radius": radii, "surface_energy": energies}
    names = ["pull_off_force", "r_min", "work_of_adhesion", "contact_modulus"]
    whole = solve(names, **given)
    monkeypatch.setattr("jkroll.model.solver.ELEMENTS_AT_ONCE", size)
    for name, values in solve(names, **given).items():
        assert numpy.shape(values) == numpy.shape(whole[name])
        assert numpy.array_equal(values, whole[name]), name


@pytest.mark.parametrize("radius", [1e-8, 1e-7, 1e-5, 1e-3])
@pytest.mark.parametrize("model", ["maugis", "dmt"])
def test_a_curve_rises_in_its_approach_and_has_its_largest_tension_at_pull_off(model: str, radius: float) -> None:
    quartz = known_materials()["quartz"]
    frames = [*frames_of_curve(Frame({"radius": radius}, quartz, model=model))]
    places = [frame["approach_at_load"] for frame in frames if frame.state != "unstable"]
    assert len(places) > 15
    assert all(later > earlier for earlier, later in pairwise(places))
    (pull_off,) = [frame["load"] for frame in frames if frame.state == "pull-off"]
    assert pull_off == min(frame["load"] for frame in frames)
    assert math.isclose(-pull_off, solve("pull_off_force", model=model, material="quartz", radius=radius))


def test_an_approach_that_sets_a_state_is_an_input_and_not_a_result(run: Run) -> None:
    states = json.loads(run("contact quartz 100nm --curve --model dmt --json").out)
    for state in states:
        assert [result["name"] for result in state["results"]] == ["load", "contact_radius_at_load", "stiffness"]
        assert "approach_at_load" in state["inputs"]


def test_a_curve_has_the_quantities_and_the_units_that_are_asked_for(run: Run) -> None:
    head, *_, last = run("contact quartz 100nm --curve --quantities hertz_pressure,load --to nN --csv").out.splitlines()
    load, pressure = (
        float(last.split(",")[head.split(",").index(name)]) for name in ("load [nN]", "hertz_pressure [Pa]")
    )
    single = run(f"contact quartz 100nm --load {load}nN --quantities hertz_pressure --bare --quiet").out
    assert pressure == approx(float(single), rel=1e-12)
    answers = json.loads(run("contact quartz 100nm --curve --quantities hertz_pressure --json").out)
    assert answers[-1]["results"][0]["value"] == pressure
    bare = run("contact quartz 100nm --curve --bare --to nN --quiet").out.splitlines()[-1]
    assert float(bare.split()[-1]) == load
    refused = run("contact quartz 100nm --curve --to J")
    assert (refused.code, "which are in: m, N, N/m" in refused.err) == (2, True)


# --- Texts of answers -------------------------------------------------------------------------------------------------


def test_an_answer_by_jkr_states_how_far_it_is_from_maugis_law(run: Run) -> None:
    found = Report(QUESTIONS["pull-off"], Frame({"radius": 1e-7}, known_materials()["quartz"]))
    (text,) = found.lines_on_ranges(found.values)
    assert text == "Maugis: the better law at Tabor's μ = 0.14–0.27, over z0 = 2–4 Å (--z0)"
    best = json.loads(run("pull-off quartz 100nm --json").out)["results"][0]["best"]
    assert best["by"] == "Maugis"
    assert best["why"].startswith(f"{text.partition(': ')[2]}; JKR is 17–23 % too low (P_c)")


@pytest.mark.parametrize(
    ("material", "radius", "at_displacement", "at_hysteresis"),
    [
        ("quartz", 1e-8, 0.38, 2.47),
        ("quartz", 1e-7, 0.43, 1.81),
        ("quartz", 1e-6, 0.52, 1.39),
        ("iron", 1e-7, 0.82, 1.06),
    ],
)
def test_maugis_law_lowers_the_rolling_moment_at_equal_displacement_and_raises_it_at_equal_hysteresis(
    material: str, radius: float, at_displacement: float, at_hysteresis: float
) -> None:
    given = {"material": material, "radius": radius, "energy": 1e-18}
    fraction = solve("hysteresis_ratio", **given)
    for name, power in (("yield_moment", 1), ("n_roll_energy_balance", -1)):
        ours, theirs = (solve(name, model=model, **given) for model in ("jkr", "maugis"))
        assert (theirs / ours) ** power == approx(at_displacement, abs=0.005)
        if fraction < 1:
            lost = solve(name, model="maugis", **given, hysteresis_fraction=fraction)
            assert (lost / ours) ** power == approx(at_hysteresis, abs=0.005)


def test_a_verdict_says_whether_a_contact_jumps(run: Run) -> None:
    of_json = json.loads(run("energies quartz 100nm --json").out)["validity"]
    assert [one["holds"] for one in of_json if one.get("verdict") == "has_jump"] == [False]
    of_ice = json.loads(run("energies ice-warm 1um --json").out)["validity"]
    assert [one["holds"] for one in of_ice if one.get("verdict") == "has_jump"] == [True]
    assert not any("verdict" in one for one in json.loads(run("pull-off quartz 100nm --json").out)["validity"])


def test_a_result_of_another_law_names_the_law() -> None:
    found = Report(QUESTIONS["yield-force"], Frame({"radius": 1e-7}, known_materials()["quartz"], model="maugis"))
    results = {result.name: result for result in found.results}
    assert (results["yield_force"].law, results["yield_force"].equation) == ("maugis", "Maugis 1992")
    assert results["yield_angle"].law == ""
    assert found.inputs["model"] == "maugis"


def test_a_sticking_energy_that_depends_on_an_unknown_spacing_has_no_value_in_a_report() -> None:
    quartz = known_materials()["quartz"]
    found = Report(QUESTIONS["energies"], Frame({"radius": 1e-7}, quartz, model="maugis"))
    results = {result.name: result for result in found.results}
    for name in ("sticking_energy", "sticking_speed"):
        assert (results[name].value, results[name].reason) == (None, "depends on z0; give --z0 4angstrom")
    alone = Report(question_about("v_stick"), Frame({"radius": 1e-7}, quartz, model="maugis"))
    assert str(alone.failure) == "sticking_speed: depends on z0; give --z0 4angstrom"
    said = Report(QUESTIONS["contact"], Frame({"radius": 1e-7, "atomic_spacing": 4e-10}, quartz, model="maugis"))
    assert said.values["sticking_energy"] == solve("sticking_energy", model="maugis", **QUARTZ, atomic_spacing=4e-10)


@pytest.mark.parametrize("radius", [20e-6, numpy.array([20e-6, 30e-6])])
def test_a_sticking_speed_that_depends_on_the_spacing_is_judged_at_the_assumed_spacing(radius: Any) -> None:
    """Without a given spacing the speed has no value; its doubts and range are those at the assumed spacing."""
    quartz = known_materials()["quartz"]
    assumed, stated = (Frame({"radius": radius, **more}, quartz) for more in ({}, {"atomic_spacing": 4e-10}))
    factors = [factor_of_law(scene, ["sticking_speed"]) for scene in (assumed, stated)]
    assert numpy.array_equal(*factors)
    assert numpy.all(numpy.isfinite(factors))
    shown = [Results(scene, scene.columns(["sticking_speed"])) for scene in (assumed, stated)]
    shown_range, expected = (estimates(results, ["sticking_speed"])["sticking_speed"] for results in shown)
    assert all(map(numpy.array_equal, shown_range, expected))
    assert numpy.all(shown_range.low < shown_range.high)


def test_a_quantity_that_depends_on_the_spacing_has_no_value_without_it() -> None:
    """In Python this is an error for numbers, and nan in arrays where the transition parameter is below 1."""
    with pytest.raises(Failure, match="depends on z0; give --z0 4angstrom"):
        solve("sticking_energy", model="maugis", **QUARTZ)
    radii = numpy.geomspace(1e-7, 1e-3, 30)
    found = solve(["sticking_energy", "transition_parameter"], model="maugis", **{**QUARTZ, "radius": radii})
    is_open = numpy.isnan(found["sticking_energy"])
    assert is_open.tolist() == (found["transition_parameter"] < 1).tolist()
    assert {*is_open.tolist()} == {True, False}
    given = solve("sticking_energy", model="maugis", **{**QUARTZ, "radius": radii}, atomic_spacing=4e-10)
    assert not numpy.isnan(given).any()
    assert given[-1] == found["sticking_energy"][-1]


@pytest.mark.parametrize("model", ["", "jkr ", 3, ["jkr", "kjr"], math.nan])
def test_an_unknown_law_is_refused(model: Any) -> None:
    with pytest.raises(BadRequest, match="is not one of jkr, maugis, dmt"):
        solve("pull_off_force", **QUARTZ, model=model)


def test_states_at_loads_far_above_pull_off_have_full_precision() -> None:
    """The zone of attraction is a narrow ring around a wide contact; a load and its approach give the same state."""
    for spacing in (4e-10, 1e-8, 1e-6):
        for load in (1e-2, 1.0, 1e2, 1e6, 1e14):
            at_load = solve(["approach_at_load", "adhesive_force"], model="maugis", **QUARTZ, z0=spacing, load=load)
            approach = at_load["approach_at_load"]
            again = solve("adhesive_force", model="maugis", **QUARTZ, z0=spacing, approach_at_load=approach)
            assert math.isclose(at_load["adhesive_force"], again, rel_tol=1e-13), (spacing, load)


@pytest.mark.parametrize("load", [-5e-9, 0.0, 2e-8])
@pytest.mark.parametrize("name", ["state_energy_maugis", "edge_ratio", "zone_span", "contact_displacement_maugis"])
def test_quantities_of_maugis_law_are_the_same_under_every_law(name: str, load: float) -> None:
    assert len({solve(name, **QUARTZ, load=load, model=model) for model in MODELS}) == 1


def test_the_load_is_the_derivative_of_the_energy_of_a_state() -> None:
    for approach in (-3.5e-10, -2e-10, 0.0, 2e-10):
        low, high = (
            solve("state_energy_maugis", **QUARTZ, approach_at_load=approach + side, model="maugis")
            for side in (-1e-14, 1e-14)
        )
        load = solve("load_maugis", **QUARTZ, approach_at_load=approach, model="maugis")
        assert (high - low) / 2e-14 == approx(load, rel=1e-5)


@pytest.mark.parametrize("law", ["jkr", "maugis", "dmt"])
def test_a_contact_bears_its_own_pull_off_force(law: str) -> None:
    """Rounding of the force does not break the contact, for numbers and for arrays."""
    source = random.Random(11)
    for _ in range(50):
        grain: dict[str, Any] = {
            "radius": log_uniform(source, 1e-9, 1e-5),
            "surface_energy": log_uniform(source, 1e-3, 1),
            "youngs_modulus": log_uniform(source, 1e6, 1e12),
            "poisson_ratio": 0.3,
        }
        load = -solve("pull_off_force", model=law, **grain)
        one = solve("contact_radius_at_load", model=law, load=load, **grain)
        assert solve("contact_radius_at_load", model=law, load=[load, 0.0], **grain)[0] == approx(one, rel=1e-6)


# Within 5 % of Maugis' law: JKR above this μ, DMT below it, as in `jkroll guide models` and the docstring of μ.
WITHIN = {
    "jkr": {"approach": 0.5, "pull_off_force": 1.1, "contact_radius": 1.7, "yield_moment": 3.3, "sticking_energy": 12},
    "dmt": {"approach": 0.002, "pull_off_force": 0.14, "contact_radius": 0.07, "yield_moment": 0.02},
}


@pytest.mark.parametrize(("model", "name"), [(model, name) for model, names in WITHIN.items() for name in names])
def test_where_a_law_is_within_5_per_cent_depends_on_the_quantity(model: str, name: str) -> None:
    border = WITHIN[model][name]
    pair: dict[str, Any] = {"radius": 1e-6, "work_of_adhesion": 0.05, "contact_modulus": 1e9}
    unit = (pair["radius"] / 2 * (pair["work_of_adhesion"] / pair["contact_modulus"]) ** 2) ** (1 / 3)
    for factor, is_within in ((1.0, True), (0.6 if model == "jkr" else 1.7, False)):
        spacing = unit / (border * factor)
        own, between = (solve(name, model=law, atomic_spacing=spacing, **pair) for law in (model, "maugis"))
        assert (abs(own / between - 1) < 0.05) is is_within
    row = next(line for line in page("models").splitlines() if line.startswith(f"| {model.upper()}, for μ"))
    assert [float(cell) for cell in row.split("|")[2:-1] if "none" not in cell] == [*WITHIN[model].values()]


@pytest.mark.parametrize("given", [{}, {"load": 1e-9}, {"approach_at_load": 1e-10}, {"adhesion_hysteresis": 0.01}])
@pytest.mark.parametrize("model", LAWS)
def test_a_formula_of_another_law_never_uses_the_contact_of_the_law_in_use(model: str, given: dict[str, float]) -> None:
    """A formula of one law gives the same value under another, or is refused. approach_dmt once used JKR's radius."""
    scene = Frame({"radius": 1e-7, **given}, known_materials()["quartz"], model=model)
    foreign = [name for name in NOMENCLATURE if NOMENCLATURE[name].variant_of and law_of(name) not in (None, model)]
    found = {name: value for name, value in outcomes(scene, foreign).items() if not isinstance(value, JkrollError)}
    for name, value in found.items():
        assert value == approx(scene.replace(model=law_of(name))[name], rel=1e-12), name
    assert not {"approach_dmt", "stiffness_dmt", "load_dmt"} & found.keys() or model == "dmt"
    assert model == "dmt" or scene["pull_off_force_dmt"] > 0


def test_a_quantity_of_another_law_is_refused_with_the_name_of_that_law(run: Run) -> None:
    ran = run("contact quartz 100nm --quantities stiffness_dmt")
    assert "not in JKR; give --model dmt" in ran.err
    assert float(run("contact quartz 100nm --quantities stiffness_dmt --model dmt --bare").out) == approx(
        153.8675, rel=1e-5
    )


def test_the_fold_energy_is_that_of_the_law_in_use() -> None:
    """The energy is P_c times the depth of the fold. For dry silica, it was once JKR's 27.03 aJ instead of 45.2 aJ."""
    grain: dict[str, Any] = {"material": "silica-dry", "radius": 1e-7}
    names = ["work_of_adhesion", "reduced_radius", "contact_modulus", "transition_parameter"]
    w, radius, modulus, transition = map(mpf, solve(names, model="maugis", **grain).values())
    depth = -reference.lowest_approach(transition) * cbrt(pi * w * radius**2 / (4 * modulus / 3)) ** 2 / radius
    force = -reference.load(*reference.pull_off(transition), transition) * pi * w * radius
    found = solve(["fold_energy", "break_energy_dust_simulation"], model="maugis", **grain)
    assert [*found.values()] == approx([float(force * depth), float(1.8 * force * depth)], rel=1e-13)
    assert found["fold_energy"] == approx(45.2e-18, rel=2e-3)
    for name in found:
        with pytest.raises(NotInLaw):
            solve(name, model="dmt", **grain)
