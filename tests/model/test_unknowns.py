"""Two unknowns from two quantities: pairs are recovered, all pairs are named, and other problems are refused."""

import csv
import json
import math
from itertools import product
from pathlib import Path
from typing import Any

import numpy
import pytest

from frames import solved
from harness import Run
from jkroll import Interval, JkrollError, Measured, infer, known_materials
from jkroll.errors import BadRequest
from jkroll.model.frame import Frame
from jkroll.model.reasons import Failure, MissingInput
from jkroll.model.search import Solution
from jkroll.model.unknowns import NoDependence, NoSolution, SeveralSolutions, Unseparated
from jkroll.quantities.formatting import amount
from relative import approx

PLANE: dict[str, Any] = {"radius": 2e-6, "radius2": math.inf, "poisson_ratio": 0.17}
NAMES = ("surface_energy", "youngs_modulus")
MEASURED = {"pull_off_force": 3e-7, "stiffness": 1e3}


def solution(
    names: tuple[str, ...], measured: dict[str, float], given: dict[str, Any], model: str | None = None
) -> Solution:
    """Return the solution for two unknowns of a scene without materials."""
    return solved(names, measured, Frame(given, model=model))


# --- By hand ----------------------------------------------------------------------------------------------------------


def test_a_pair_agrees_with_values_by_hand() -> None:
    """P_c = 3πγR, dP/dδ = 6/5 E*a0 and a0³ = 9πγR²/E* on a plane."""
    pair = solution(NAMES, MEASURED, PLANE)
    gamma = 3e-7 / (3 * math.pi * 2e-6)
    modulus = (1e3 / 1.2) ** 1.5 / math.sqrt(9 * math.pi * gamma * 2e-6**2)
    assert pair.values["surface_energy"] == approx(gamma, rel=1e-14)
    assert pair.values["youngs_modulus"] == approx(2 * (1 - 0.17**2) * modulus, rel=1e-13)
    assert Frame({**PLANE, **pair.values}).numbers(*MEASURED) == approx(MEASURED, rel=1e-14)


def test_the_condition_of_power_laws_is_that_of_the_matrix_of_exponents() -> None:
    """P_c is proportional to γ, and dP/dδ to γ^(1/3)E^(2/3), so E is proportional to K^(3/2)P_c^(-1/2)."""
    pair = solution(NAMES, MEASURED, PLANE)
    assert pair.condition == approx(numpy.linalg.cond(numpy.array([[1, 0], [1 / 3, 2 / 3]])), rel=1e-5)
    assert pair.growths == approx({"surface_energy": 1.0, "youngs_modulus": math.hypot(1.5, 0.5)}, rel=1e-5)


def test_an_input_that_cancels_from_a_quantity_is_found_from_the_other() -> None:
    """By DMT, the moment without load, 4E*a0³ξ/(3R), is 2πwRξ, as a0³ = 3πwR²/(2E*).

    So the moment gives w, and a0 then gives E*.
    """
    given = {**PLANE, "yield_displacement": 2e-10}
    pair = solution(NAMES[::-1], {"unloaded_moment": 1e-16, "contact_radius": 3e-8}, given, "dmt")
    work = 1e-16 / (2 * math.pi * 2e-6 * 2e-10)
    modulus = 3 * math.pi * work * 2e-6**2 / (2 * 3e-8**3)
    assert pair.values["surface_energy"] == approx(work / 2, rel=1e-13)
    assert pair.values["youngs_modulus"] == approx(2 * (1 - 0.17**2) * modulus, rel=1e-13)


# --- Recovered pairs --------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("law", ["jkr", *(pytest.param(law, marks=pytest.mark.slow) for law in ("dmt", "maugis"))])
@pytest.mark.parametrize("load", [0.0, *(pytest.param(load, marks=pytest.mark.slow) for load in (1e-12, -2e-7))])
def test_a_load_is_recovered_even_if_it_is_zero(law: str, load: float) -> None:
    given = {**PLANE, "surface_energy": 0.02}
    names = ("load", "youngs_modulus")
    full = Frame({**given, "load": load, "youngs_modulus": 3e10}, model=law)
    pair = solution(names, full.numbers("contact_radius_at_load", "stiffness"), given, law)
    assert pair.values["load"] == approx(load, rel=1e-12, abs=1e-20)
    assert pair.values["youngs_modulus"] == approx(3e10, rel=1e-13)
    assert (pair.growths["load"] == math.inf) == (load == 0)
    assert pair.condition < 10


@pytest.mark.parametrize("radius", [1e-6, 7e-5])
def test_a_pair_is_found_from_a_measured_approach_of_0(radius: float) -> None:
    given = {"radius2": math.inf, "poisson_ratio": 0.2, "youngs_modulus": 1e9}
    sphere = {"surface_energy": 0.03, "radius": radius}
    load = infer("load", measured={"approach_at_load": 0.0}, **given, **sphere)
    measured = {"approach_at_load": 0.0, "stiffness": Frame({**given, **sphere, "load": load})["stiffness"]}
    pair = solution(("surface_energy", "radius"), measured, {**given, "load": load})
    assert pair.values == approx(sphere, rel=1e-9)


def test_both_spheres_of_one_material_are_inferred_together() -> None:
    quartz, iron = (known_materials()[name] for name in ("quartz", "iron"))
    by_default, twice, on_iron = (
        solved(NAMES, MEASURED, Frame({"radius": 2e-6}, quartz, second)) for second in (None, quartz, iron)
    )
    assert by_default.values == twice.values
    scene = Frame({"radius": 2e-6, **on_iron.values}, quartz, iron)
    assert scene.numbers(*MEASURED) == approx(MEASURED, rel=1e-13)
    assert on_iron.values != approx(by_default.values, rel=0.1)


# --- Refusals ---------------------------------------------------------------------------------------------------------


ENERGY_AND_RADIUS = ("surface_energy", "radius")
FORCES = {"pull_off_force": 3e-7, "pull_off_force_dmt": 4e-7}  # all pairs with the same γR give the same forces
STAY = (
    "and pull_off_force_dmt do not determine both unknowns: both are constant along γ1 ∝ R1^-1 "
    "(the condition number is above 1e8)"
)
# f = √(K/m)/2π, and under a large load K does not depend on γ
PRESSED = {"stiffness": 1e3, "vertical_frequency": 1e6}, {**PLANE, "density": 2e3, "load": 1e3}
PULLED = {"surface_energy": 0.05, "radius2": math.inf, "poisson_ratio": 0.2, "load": -1e-7}


@pytest.mark.parametrize(
    ("names", "measured", "given", "error", "words"),
    [
        (ENERGY_AND_RADIUS, FORCES, {"radius2": math.inf}, Unseparated, STAY),
        (ENERGY_AND_RADIUS, {**FORCES, "pull_off_force_dmt": 5e-7}, {"radius2": math.inf}, Unseparated, STAY),
        (NAMES, FORCES, PLANE, Unseparated, "they do not determine E1 (the condition number is above 1e8)"),
        (NAMES, {"pull_off_force": 3e-7, "r_min": 1e-5}, PLANE, NoDependence, "r_min does not depend on either"),
        (NAMES, *PRESSED, Unseparated, "they do not determine γ1 (the condition number is above 1e8)"),
        (NAMES[::-1], *PRESSED, Unseparated, "they do not determine γ1 (the condition number is above 1e8)"),
        (NAMES, {**MEASURED, "stiffness": 1e12}, PLANE, NoSolution,
         "stiffness = 1e12 N/m; they lie between 18.8496 pN and 18.8496 mN and between 3.72794 µN/m and 37.2794 MN/m"),
        (NAMES, {**MEASURED, "stiffness": 1e7}, PLANE, NoSolution,
         "no pair of values gives pull_off_force = 300 nN and stiffness = 10 MN/m"),
        (NAMES, {**MEASURED, "pull_off_force": 3.0}, PLANE, NoSolution,
         "no pair of values gives pull_off_force = 3 N and stiffness = 1 kN/m; they lie between 18.8496 pN and"),
        (("youngs_modulus", "radius"), {"contact_radius_at_load": 1.28e-6, "contact_radius": 3.25e-6}, PULLED,
         NoSolution, "no pair of values gives contact_radius_at_load = 1.28 µm and contact_radius = 3.25 µm"),
        (("load", "surface_energy"), {"approach_at_load": 1.0, "contact_radius_at_load": 10.0},
         {"radius": 1e12, "youngs_modulus": 1e9, "poisson_ratio": 0.3}, NoSolution, "no pair of values gives"),
        (("surface_energy", "load"), {"contact_radius_at_load": 1e-8, "stiffness": 1e3},
         {**PLANE, "youngs_modulus": math.inf}, Failure, "both bodies are rigid"),
        (NAMES, MEASURED, {"radius": 2e-6}, MissingInput, "normal stiffness needs Poisson's ratio"),
        (NAMES, MEASURED, {**PLANE, "surface_energy": 1.0}, BadRequest, "surface_energy is given, and also"),
        (NAMES, MEASURED, {**PLANE, "work_of_adhesion": 1.0}, BadRequest, "one follows from the other"),
        (NAMES, MEASURED, {**PLANE, "stiffness": 1.0}, BadRequest, "stiffness is given, and also measured or"),
        (("surface_energy", "work_of_adhesion"), MEASURED, PLANE, BadRequest, "one follows from the other"),
        (("surface_energy", "gravity"), MEASURED, PLANE, BadRequest, "'gravity' cannot be inferred"),
    ],
)  # fmt: skip
def test_two_unknowns_are_refused_with_a_reason(
    names: tuple[str, ...], measured: dict[str, float], given: dict[str, float], error: type[JkrollError], words: str
) -> None:
    with pytest.raises(error) as caught:
        solution(names, measured, given)
    assert words in str(caught.value)


def test_an_open_load_is_described_by_its_distance_from_pull_off() -> None:
    """F = τπa² and 8G*a give only a, and a³ ∝ R²(1 + √(1 + P/P_c))².

    So R is about a power of 1 + P/P_c, with an exponent between −1/2 and 0.
    """
    given = {"radius2": math.inf, "surface_energy": 0.05, "youngs_modulus": 1e9, "poisson_ratio": 0.2}
    measured = {"sliding_force": 1e-9, "tangential_stiffness": 10.0}
    with pytest.raises(Unseparated, match=r"along R1 ∝ \(1 \+ P/P_c\)\^-") as caught:
        solution(("radius", "load"), measured, {**given, "shear_strength": 1e7})
    assert -0.5 < float(caught.value.text.partition("P_c)^")[2].split()[0]) < 0


def test_two_unknowns_that_both_quantities_leave_open_are_named() -> None:
    """By DMT, the moment is 2πwRξ at any load and modulus, which change only its last digits, by rounding."""
    given = {**PLANE, "surface_energy": 0.05, "yield_displacement": 2e-10, "density": 2e3}
    measured = Frame({**given, "load": 1e-8, "youngs_modulus": 1e9}, model="dmt").numbers("yield_force", "n_grav")
    with pytest.raises(Unseparated, match=r"they do not determine E1 and P"):
        solution(("youngs_modulus", "load"), measured, given, "dmt")


def test_barely_separated_unknowns_are_refused() -> None:
    """By Maugis' law, the ratio of the two measured forces, P_c/(2πwR), tends to 3/4 for large soft spheres."""
    given = {"radius2": math.inf, "poisson_ratio": 0.2, "youngs_modulus": 1e6, "atomic_spacing": 4e-10}
    names, condition = ("surface_energy", "radius"), 1e6
    for radius in (1e-8, 1e-7, 1e-6):
        full = Frame({**given, "radius": radius, "surface_energy": 0.05}, model="maugis")
        pair = solution(names, full.numbers("pull_off_force", "pull_off_force_dmt"), given, "maugis")
        assert pair.condition > 2 * condition
        assert pair.values["radius"] == approx(radius, rel=1e-15 * pair.condition)
        condition = pair.condition
    full = Frame({**given, "radius": 1e-5, "surface_energy": 0.05}, model="maugis")
    with pytest.raises(Unseparated, match=r"both are constant along γ1 ∝ R1\^-1 \(the condition number is above 1e8\)"):
        solution(names, full.numbers("pull_off_force", "pull_off_force_dmt"), given, "maugis")


@pytest.mark.parametrize("radius", [1.1e-6, 1e-6], ids=["between two values of the scan", "at a value of the scan"])
def test_the_error_names_all_pairs(radius: float) -> None:
    given = {"radius2": math.inf, "poisson_ratio": 0.2, "youngs_modulus": 1e9, "density": 2e3, "load": 1e-7}
    names = ("surface_energy", "radius")
    full = Frame({**given, "surface_energy": 0.01, "radius": radius}, model="dmt")
    measured = full.numbers("rolling_frequency", "hertz_pressure")
    with pytest.raises(SeveralSolutions) as caught:
        solution(names, measured, given, "dmt")
    first, second = caught.value.values
    assert first["radius"] != approx(second["radius"], rel=0.01)
    for pair in (first, second):
        assert Frame({**given, **pair}, model="dmt").numbers(*measured) == approx(measured, rel=1e-13)
    words = (
        f"surface_energy,radius: the pairs ({amount('surface_energy', first['surface_energy'])}, "
        f"{amount('radius', first['radius'])}) and ("
    )
    assert str(caught.value).startswith(words)


@pytest.mark.parametrize("margin", [1e-1, 1e-2, 1e-4, 1e-6])
def test_pairs_are_found_next_to_pull_off(margin: float) -> None:
    """The stiffness falls to 0 there, as the root of the margin, and some corners of cells have no contact."""
    values = {"surface_energy": 0.03, "youngs_modulus": 54e9}
    full = Frame({**PLANE, **values})
    values["load"] = -(1 - margin) * full["pull_off_force"]
    measured = full.replace(load=values["load"]).numbers("stiffness", "contact_radius_at_load")
    for given, value in values.items():
        unknowns = {name: unknown for name, unknown in values.items() if name != given}
        pair = solution(tuple(unknowns), measured, {**PLANE, given: value})
        assert pair.values == approx(unknowns, rel=1e-6)


def test_a_pair_in_a_cell_without_contact_at_one_corner_hides_no_other_pair() -> None:
    values, given = {"surface_energy": 6e-3, "youngs_modulus": 3e11}, {**PLANE, "shear_strength": 1e7}
    given["load"] = -0.97 * Frame({**given, **values})["pull_off_force"]
    measured = Frame({**given, **values}).numbers("sliding_force", "well_energy")
    with pytest.raises(SeveralSolutions) as caught:
        solution(NAMES, measured, given)
    for pair in caught.value.values:
        assert Frame({**given, **pair}).numbers(*measured) == approx(measured, rel=1e-9)


def test_the_order_of_the_measured_quantities_hides_no_pair() -> None:
    """Below some radius, v_stick by Maugis' law does not depend on the radius, so two spheres fit both values."""
    measured = {"yield_force": 2.71151e-9, "sticking_speed": 4.24886}
    given = {"radius2": math.inf, "poisson_ratio": 0.17, "youngs_modulus": 54e9, "density": 2600.0}
    given |= {"load": 3.43e-7, "atomic_spacing": 4e-10, "yield_displacement": 2e-10}
    for in_order in (measured, dict(reversed(measured.items()))):
        with pytest.raises(SeveralSolutions) as caught:
            solution(("radius", "surface_energy"), in_order, given, "maugis")
        assert [pair["radius"] for pair in caught.value.values] == approx([3.21324e-9, 119e-9], rel=1e-5)
        for pair in caught.value.values:
            assert Frame({**given, **pair}, model="maugis").numbers(*measured) == approx(measured, rel=1e-9)


# --- Error bars -------------------------------------------------------------------------------------------------------


def test_error_bars_of_both_measurements_enter() -> None:
    """γ is proportional to P_c, and E to K^(3/2)P_c^(-1/2)."""
    measured = {"pull_off_force": Measured(3e-7, 3e-9), "stiffness": Measured(1e3, 20.0)}
    both = infer(["gamma", "young"], measured=measured, **PLANE)
    parts = [both[name].plus / both[name].value for name in NAMES]
    assert parts == approx([0.01, math.hypot(0.005, 0.03)], rel=1e-3)
    given = {**PLANE, "radius": Measured(2e-6, 2e-8)}  # γ is proportional to 1/R, and E to 1/√R
    both = infer(["gamma", "young"], measured=MEASURED, **given)
    parts = [both[name].plus / both[name].value for name in NAMES]
    assert parts == approx([0.01, 0.005], rel=1e-3)


def test_ranges_of_both_measurements_enter() -> None:
    measured = {"pull_off_force": Interval(3e-7, 2.8e-7, 3.2e-7), "stiffness": Interval(1e3, 900.0, 1100.0)}
    both = infer(["gamma", "young"], measured=measured, **PLANE)
    ends = [(both[name].low / both[name].value, both[name].high / both[name].value) for name in NAMES]
    assert ends[0] == approx((14 / 15, 16 / 15), rel=1e-12)
    assert ends[1] == approx((0.9**1.5 * (16 / 15) ** -0.5, 1.1**1.5 * (14 / 15) ** -0.5), rel=1e-12)


def test_ranges_are_those_of_their_corners_even_if_the_middle_load_breaks_one_contact() -> None:
    """The load inferred from the middles of the ranges breaks the contact of the smallest sphere."""
    measured = {"contact_radius_at_load": (1.9e-9, 2.6e-9), "pull_off_force": (2e-8, 2.8e-8)}
    spans = {**measured, "radius": (1.1e-7, 1.6e-7)}
    ranges = {name: Interval(sum(span) / 2, *span) for name, span in spans.items()}
    given: dict[str, Any] = {"material": "quartz", "radius2": "plane", "model": "maugis"}

    def inferred(values: dict[str, Any]) -> dict[str, Any]:
        known = {name: values[name] for name in measured}
        return infer(["load", "gamma"], measured=known, radius=values["radius"], **given)

    found = inferred(ranges)
    corners = [inferred(dict(zip(spans, corner, strict=True))) for corner in product(*spans.values())]
    for name in ("load", "surface_energy"):
        values = [corner[name] for corner in corners]
        assert [found[name].low, found[name].high] == approx([min(values), max(values)], rel=1e-6)


# --- Python and the command -------------------------------------------------------------------------------------------

WORDS = "infer gamma,young quartz 2um --radius2 plane"
COMMAND = f"{WORDS} --measured pull_off_force=300nN --measured stiffness=1kN/m"


def test_arrays_broadcast_and_hold_nan_where_there_is_no_pair() -> None:
    measured = {"pull_off_force": numpy.array([[3e-7], [4e-7]]), "stiffness": numpy.array([1e3, 1e12])}
    failures = solved(NAMES, measured, Frame(PLANE)).failures
    for row in (1, 3):
        assert failures[row].__traceback__ is None  # a traceback would keep all computed values in memory
    both = infer(["gamma", "young"], measured=measured, **PLANE)
    alone = infer(["gamma", "young"], measured={"pull_off_force": 4e-7, "stiffness": 1e3}, **PLANE)
    for name in NAMES:
        assert both[name].shape == (2, 2)
        assert both[name][1, 0] == alone[name]
        assert numpy.isnan(both[name][:, 1]).all()
    assert both.condition[1, 0] == alone.condition
    assert numpy.isnan(both.condition[:, 1]).all()


@pytest.mark.parametrize(
    ("wanted", "measured", "words"),
    [
        (["gamma", "young", "radius"], MEASURED, "'gamma,young,radius': one input can be inferred, or two that differ"),
        (["gamma", "surface_energy"], MEASURED, "one input can be inferred, or two that differ"),
        ([], {}, "one input can be inferred, or two that differ"),
        (["gamma", "gravity"], MEASURED, "'gravity' cannot be inferred"),
        (["gamma", "young"], {"stiffness": 1e3}, "does not give a quantity and its value"),
        ("gamma", MEASURED, "does not give a quantity and its value"),
        (["gamma", "young"], {"P_c": 3e-7, "pull_off_force": 3e-7}, "P_c and pull_off_force name one quantity"),
        (["gamma", "young"], {"P_c": "300±20 nN", "stiffness": [1e3]}, "cannot be combined with an uncertain input"),
    ],
)
def test_wrong_arguments_are_refused_with_a_reason(wanted: Any, measured: dict[str, Any], words: str) -> None:
    with pytest.raises(JkrollError, match=words):
        infer(wanted, measured=measured, **PLANE)


def test_a_list_of_one_input_gives_values_by_name() -> None:
    single = infer(["gamma"], measured={"pull_off_force": 3e-7}, **PLANE)
    assert single == {"surface_energy": infer("gamma", measured={"pull_off_force": 3e-7}, **PLANE)}
    assert single.condition == 1


def test_two_inputs_are_inferred_on_the_command_line(run: Run) -> None:
    pair = infer(["gamma", "young"], measured=MEASURED, material="quartz", radius=2e-6, radius2="plane")
    gamma, modulus = pair["surface_energy"], pair["youngs_modulus"]
    assert run(COMMAND).out == f"surface_energy {gamma!r} J/m^2\nyoungs_modulus {modulus!r} Pa\n"
    assert run(f"{COMMAND} --bare").out == f"{gamma!r}\t{modulus!r}\n"
    found = json.loads(run(f"{COMMAND} --json").out)
    assert found["condition"] == pair.condition
    assert [(result["name"], result["value"]) for result in found["results"]] == [*pair.items()]
    assert found["inputs"].items() >= MEASURED.items()
    assert "surface_energy" not in found["inputs"]
    for result in found["results"]:
        for law, value in result["by_law"].items():
            other = infer(
                ["gamma", "young"], measured=MEASURED, radius=2e-6, radius2="plane", model=law, material="quartz"
            )
            assert value == other[result["name"]]


def test_each_law_and_measured_value_has_a_row(run: Run) -> None:
    ran = run(f"{WORDS} --measured pull_off_force=300±20nN,3N --measured stiffness=1kN/m --model jkr,dmt --csv")
    rows = [*csv.DictReader(ran.out.splitlines())]
    assert [row["model"] for row in rows] == ["jkr", "dmt"] * 2
    for row in rows[:2]:
        measured = {"pull_off_force": "300±20 nN", "stiffness": 1e3}
        both = infer(
            ["gamma", "young"], measured=measured, material="quartz", radius=2e-6, radius2="plane", model=row["model"]
        )
        assert float(row["youngs_modulus [Pa]"]) == both["youngs_modulus"].value
        assert float(row["youngs_modulus_plus [Pa]"]) == both["youngs_modulus"].plus
    for row in rows[2:]:
        assert row["surface_energy [J/m^2]"] == row["youngs_modulus [Pa]"] == ""
        assert row["status"] == "no value gives it"
    assert (ran.code, ran.err.splitlines()[-1]) == (1, "jkroll: 2 of 4 rows failed")


def test_a_material_that_lacks_an_input_fails_only_in_its_own_rows(run: Run, tmp_path: Path) -> None:
    (tmp_path / "own.toml").write_text(
        '[materials.soft]\ndensity = "1 g/cm3"\n[materials.stiff]\npoisson_ratio = 0.3\n'
    )
    words = COMMAND.replace("quartz", "soft,stiff") + " --materials own.toml --csv"
    ran = run(words)
    rows = [*csv.DictReader(ran.out.splitlines())]
    assert [row["youngs_modulus [Pa]"] != "" for row in rows] == [False, True]
    assert [row["poisson_ratio"] for row in rows] == ["", "0.3"]
    assert rows[0]["status"] == "needs poisson_ratio"
    assert (ran.code, run(words.replace(",stiff", "")).code) == (1, 2)


def test_the_explanation_derives_both_measured_quantities(run: Run) -> None:
    *found, _ = run(f"{COMMAND} --explain").out.split("\n\n")
    assert [part.partition(" ")[0] for part in found] == [*NAMES, *MEASURED]
    assert "  result    P_c = 300 nN\n" in found[2]
    assert "  result    dP/dδ = 1 kN/m\n" in found[3]
    assert "relative errors of the measured values are multiplied by at most 1.58" in found[1]


@pytest.mark.parametrize(
    ("words", "code", "message"),
    [
        ("infer gamma,young,radius quartz --measured P_c=3nN", 2, "'gamma,young,radius': one input can be inferred, "),
        ("infer gamma,gamma quartz --measured P_c=3nN", 2, "'gamma,gamma': one input can be inferred, or two "),
        ("infer gamma,yung quartz --measured P_c=3nN", 2, "'yung' cannot be inferred; surface_energy, "),
        (f"{WORDS}", 2, "infer needs a measured quantity for each input, 2 in all: --measured pull_off_force=300nN "),
        (f"{WORDS} --measured P_c=3nN", 2, "infer needs a measured quantity for each input, 2 in all: "),
        (f"{WORDS} --measured P_c=3nN --measured P_c=4nN", 2, "infer needs a measured quantity for each input"),
        (f"{COMMAND} --young 1GPa", 2, "youngs_modulus is given, and also measured or"),
        (COMMAND.replace("young", "work_of_adhesion"), 2, "surface_energy and work_of_adhesion exclude each other"),
        (COMMAND.replace(",young", ""), 2, "infer needs a measured quantity for each input, 1 in all: "),
        (COMMAND.replace("quartz", "grains.csv"), 2, "'grains.csv' is a file; jkroll batch grains.csv --infer INPUT"),
        (COMMAND.replace("1kN", "1TN"), 1, "surface_energy,youngs_modulus: no pair of values gives "),
        ("batch grains.csv --infer gamma,young --measured P_c", 2, "batch infers one input"),
        ("batch grains.csv --infer gamma --measured P_c --measured stiffness", 2, "batch infers one input"),
    ],
)  # fmt: skip
def test_a_mistake_is_reported_in_one_line(run: Run, words: str, code: int, message: str) -> None:
    Path("grains.csv").touch()
    ran = run(words)
    assert (ran.code, ran.out) == (code, "")
    assert ran.err.startswith(f"jkroll: {message}")
    assert ran.err.count("\n") == 1
