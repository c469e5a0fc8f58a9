"""Diameters and shear moduli at every door, compared with R = D/2 and, for equal spheres, E* = G/(1 − ν)."""

import csv
import io
import json
import math
import pickle
import re
from pathlib import Path
from typing import Any

import numpy
import pint
import pytest

from harness import Run
from jkroll import Interval, Measured, answer, infer, known_materials, solve
from jkroll.errors import BadRequest, JkrollError
from jkroll.model.conversions import converted
from jkroll.model.frame import Frame
from jkroll.model.reasons import MissingInput
from jkroll.quantities.values import QuantityError
from relative import approx

GAMMA, RATIO = 0.025, 0.17  # of quartz
FORCE = 3 * math.pi * GAMMA * 50e-9  # Eq (1), two spheres of 200 nm in diameter
SHEAR = {"shear_modulus": 30e9, "poisson_ratio": RATIO, "surface_energy": GAMMA, "radius": 1e-7}


def contact_radius(modulus: float, reduced: float = 50e-9) -> float:
    """Return the contact radius without load by Eq (2), for a contact modulus."""
    return math.cbrt(9 * math.pi * GAMMA * reduced**2 / modulus)


A0 = contact_radius(30e9 / (1 - RATIO))  # of two equal spheres with G = 30 GPa


# --- Python -----------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("diameter", [200e-9, "200 nm", pint.UnitRegistry().Quantity(200, "nm")])
def test_a_diameter_is_twice_the_radius(diameter: Any) -> None:
    force = solve("pull_off_force", material="quartz", diameter=diameter)
    assert getattr(force, "magnitude", force) == approx(FORCE, rel=1e-14)
    on_plane = solve("pull_off_force", surface_energy=GAMMA, diameter="200 nm", diameter2="plane")
    assert on_plane == approx(2 * FORCE, rel=1e-14)


def test_a_given_shear_modulus_replaces_youngs_modulus_of_the_material() -> None:
    given: dict[str, Any] = {"material": "quartz", "diameter": "200 nm", "shear_modulus": "30 GPa"}
    assert solve("contact_radius", **given) == approx(A0, rel=1e-14)
    assert dict(answer("contact", **given).inputs) == {
        "material": "quartz", "radius": 1e-7, "radius2": 1e-7, "surface_energy": GAMMA,
        "youngs_modulus": approx(70.2e9), "poisson_ratio": RATIO, "load": 0.0,
    }  # fmt: skip
    found = solve(["diameter", "shear_modulus"], material="quartz", radius=1e-7)
    assert found == {"diameter": 2e-7, "shear_modulus": approx(54e9 / 2.34, rel=1e-15)}


def test_the_shear_modulus_of_sphere_2_is_converted_with_its_poissons_ratio() -> None:
    """Poisson's ratio of sphere 2 is the given one, that of its material, or that of sphere 1."""
    quartz = {"material": "quartz", "diameter": 2e-7}
    of_1 = (1 - RATIO**2) / 54e9
    for given, ratio in (
        ({}, RATIO),
        ({"poisson_ratio2": 0.3}, 0.3),
        ({"material2": "iron", "surface_energy2": GAMMA}, 0.27),
        ({"material2": "iron", "surface_energy2": GAMMA, "poisson_ratio2": 0.4}, 0.4),
    ):
        found = solve("contact_radius", **quartz, **given, shear_modulus2=80e9)
        assert found == approx(contact_radius(1 / (of_1 + (1 - ratio) / 160e9)), rel=1e-14)


def test_sphere_2_has_the_shear_modulus_of_sphere_1_and_its_own_poissons_ratio() -> None:
    frame = Frame({**SHEAR, "poisson_ratio2": 0.3})
    assert frame["contact_radius"] == approx(contact_radius(1 / ((1 - RATIO) / 60e9 + (1 - 0.3) / 60e9)), rel=1e-14)
    assert frame["youngs_modulus2"] == approx(78e9)
    assert frame.replace(poisson_ratio2=RATIO).is_identical
    with pytest.raises(BadRequest, match="give --shear-modulus2, or --shear-modulus without an error bar"):
        frame.replace(shear_modulus=Measured(30e9, 1e9))


def test_arrays_of_diameters_and_shear_moduli_broadcast() -> None:
    diameters, moduli = numpy.array([[1e-7], [2e-7]]), numpy.array([10e9, 30e9, 50e9])
    found = solve("contact_radius", material="quartz", diameter=diameters, shear_modulus=moduli.tolist())
    for row, (diameter,) in zip(found, diameters, strict=True):
        assert row == approx([contact_radius(modulus / (1 - RATIO), diameter / 4) for modulus in moduli], rel=1e-14)
    with pytest.raises(BadRequest, match=r"these arrays do not broadcast: shear_modulus \(3,\), poisson_ratio \(2,\)"):
        solve("contact_radius", material="quartz", radius=1e-7, shear_modulus=moduli, poisson_ratio=[0.1, 0.2])


def test_a_frame_with_replaced_inputs_is_converted_again() -> None:
    frame = Frame(SHEAR)
    assert frame.replace(poisson_ratio=0.3)["contact_modulus"] == approx(30e9 / 0.7)
    quartz = Frame({"shear_modulus": 30e9, "diameter": 2e-7}, known_materials()["quartz"])
    assert quartz.replace(poisson_ratio=0.3)["contact_modulus"] == approx(30e9 / 0.7)
    assert quartz.replace(youngs_modulus=70e9).stated == {"radius": 1e-7, "youngs_modulus": 70e9}
    assert quartz.replace(radius=1e-6).stated["radius"] == 1e-6
    assert quartz.replace(diameter=4e-7).stated["radius"] == 2e-7
    assert pickle.loads(pickle.dumps(quartz)).replace(poisson_ratio=0.3)["contact_modulus"] == approx(30e9 / 0.7)


# --- Refusals ---------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("first", "second"),
    [
        ("radius", "diameter"),
        ("radius2", "diameter2"),
        ("diameter", "reduced_radius"),
        ("diameter2", "reduced_radius"),
        ("youngs_modulus", "shear_modulus"),
        ("youngs_modulus2", "shear_modulus2"),
    ],
)
def test_two_inputs_that_follow_from_each_other_exclude_each_other(first: str, second: str) -> None:
    with pytest.raises(BadRequest, match=f"{first} and {second} exclude each other: one follows from the other"):
        solve("pull_off_force", material="quartz", **{first: 1e-7, second: 2e-7})


def test_a_shear_modulus_needs_poissons_ratio() -> None:
    known: list[dict[str, Any]] = [{"material": "gold"}, {"surface_energy": GAMMA}]
    for given in known:
        with pytest.raises(MissingInput, match=r"unloaded contact radius needs Poisson's ratio; .*--poisson 0.3"):
            solve("contact_radius", radius=1e-7, shear_modulus="30 GPa", **given)
    with pytest.raises(MissingInput, match=r"needs Poisson's ratio of sphere 2; gold has none .*--poisson2 0.3"):
        solve("contact_radius", radius=1e-7, material="quartz", material2="gold", shear_modulus2="30 GPa")
    assert solve("pull_off_force", radius=1e-7, surface_energy=GAMMA, shear_modulus=30e9) == approx(FORCE)


def test_youngs_modulus_of_a_material_does_not_replace_a_given_shear_modulus() -> None:
    quartz = known_materials()["quartz"]
    bare = quartz._replace(properties={"surface_energy": GAMMA, "youngs_modulus": 54e9})
    frame = Frame({"radius": 1e-7, "shear_modulus": 30e9}, bare)
    assert "youngs_modulus" not in frame.known
    assert frame.replace(poisson_ratio=RATIO)["contact_radius"] == approx(A0)
    made = quartz._replace(properties={**quartz.properties, "shear_modulus": 1e9})
    with pytest.raises(QuantityError, match="is not a property of a material"):
        solve("contact_radius", material=made, radius=1e-7)


def test_invalid_diameters_and_shear_moduli_are_refused() -> None:
    for given, said in (
        ({"diameter": -1e-7}, "diameter: -1e-07 must be positive"),
        ({"diameter": "1 N"}, "diameter: '1 N' is a force; expected a length such as 200nm"),
        ({"diameter": 1e-7, "shear_modulus": math.inf}, "shear_modulus: inf must be finite"),
        ({"diameter": 1e-7, "shear_modulus": 1e9, "poisson_ratio": -2.0}, "poisson_ratio: -2.0 must lie above -1"),
        ({"d": 1e-7}, "'d' is the symbol of diameter"),
    ):
        with pytest.raises(JkrollError, match=re.escape(said)):
            solve("contact_radius", material="quartz", **given)


# --- Uncertain values -------------------------------------------------------------------------------------------------


def test_uncertainties_of_diameters_and_shear_moduli_propagate() -> None:
    """P_c is proportional to D, and a0 to G^(-1/3)."""
    force = solve("pull_off_force", material="quartz", diameter="200±10 nm")
    assert (force.value, force.minus, force.plus) == approx((FORCE, FORCE / 20, FORCE / 20), rel=1e-12)
    force = solve("pull_off_force", material="quartz", diameter="180 to 220 nm")
    assert (force.low, force.high) == approx((0.9 * FORCE, 1.1 * FORCE), rel=1e-12)
    found = solve("contact_radius", material="quartz", radius=1e-7, shear_modulus=Interval(30e9, 20e9, 40e9))
    assert (found.low, found.high) == approx((A0 * 0.75 ** (1 / 3), A0 * 1.5 ** (1 / 3)), rel=1e-12)
    one_side = solve("pull_off_force", surface_energy=GAMMA, diameter="200 +20/-10 nm", diameter2="plane")
    assert (one_side.minus, one_side.plus) == approx((FORCE / 10, FORCE / 5), rel=1e-12)


def test_a_range_of_poissons_ratio_also_enters_the_converted_modulus() -> None:
    """For soda-lime glass ν is 0.20 to 0.23, and E* = G/(1 − ν)."""
    glass = "glass-soda-lime-air"
    found = answer("contact", material=glass, radius=1e-6, surface_energy=GAMMA, shear_modulus=30e9)["contact_radius"]
    assert found.uncertain is not None
    ends = contact_radius(30e9 / 0.77, 5e-7), contact_radius(30e9 / 0.8, 5e-7)
    assert (found.uncertain.low, found.uncertain.high) == approx(ends, rel=1e-12)


def test_correlated_uncertainties_are_refused_with_a_remedy() -> None:
    remedy = "E = 2G(1 + ν) is correlated with ν, which is uncertain; give --young with its error bar, or --poisson"
    glass = known_materials()["glass-soda-lime-air"]
    for given, material in (
        ({**SHEAR, "poisson_ratio": Measured(0.2, 0.01)}, None),
        ({"radius": 1e-7, "shear_modulus": Interval(30e9, 28e9, 32e9)}, glass),
    ):
        with pytest.raises(BadRequest, match=re.escape(remedy)) as caught:
            Frame(given, material)
        assert caught.value.phrase == "correlated error bars"
    with pytest.raises(BadRequest, match="give --young2 with its error bar, or --poisson2 without one"):
        converted({"shear_modulus2": 1e9, "poisson_ratio2": Measured(0.2, 0.01)}, {}, own_material2=False)


# --- Command line -----------------------------------------------------------------------------------------------------


def rows(text: str) -> list[dict[str, str]]:
    return [*csv.DictReader(io.StringIO(text))]


@pytest.mark.parametrize("words", ["--diameter 200nm", "--D 200nm", "diameter=200nm", "--diameter=0.2um"])
def test_a_diameter_may_be_given_in_several_forms(run: Run, words: str) -> None:
    assert float(run(f"pull-off quartz {words} --bare --quiet").out) == approx(FORCE, rel=1e-14)


def test_lists_and_sweeps_of_diameters_have_a_column_of_radii(run: Run) -> None:
    found = rows(run("pull-off quartz --diameter 100nm:10um:3 --diameter2 200nm,plane,2um --csv --quiet").out)
    radii = [(float(row["radius [m]"]), row["radius2 [m]"]) for row in found]
    assert [first for first, _ in radii] == approx([each for each in (5e-8, 5e-7, 5e-6) for _ in range(3)], rel=1e-14)
    assert [second for _, second in radii] == ["1e-7", "plane", "1e-6"] * 3
    for row, (first, second) in zip(found, radii, strict=True):
        reduced = first if second == "plane" else 1 / (1 / first + 1 / float(second))
        assert float(row["pull_off_force [N]"]) == approx(3 * math.pi * GAMMA * reduced, rel=1e-14)
    found = rows(run("contact quartz 100nm --shear-modulus 30GPa,60GPa --csv --quiet").out)
    assert [float(row["youngs_modulus [Pa]"]) for row in found] == approx([70.2e9, 140.4e9])
    assert [float(row["contact_radius [m]"]) for row in found] == approx([A0, A0 / 2 ** (1 / 3)], rel=1e-14)


def test_long_lists_of_diameters_are_computed_as_arrays(run: Run) -> None:
    ran = run(
        "pull-off quartz --diameter 100nm:10um:400 --diameter2 plane,1um --csv --quiet --quantities pull_off_force"
    )
    for row in rows(ran.out):
        first, second = float(row["radius [m]"]), row["radius2 [m]"]
        reduced = first if second == "plane" else 1 / (1 / first + 2e6)
        assert float(row["pull_off_force [N]"]) == approx(3 * math.pi * GAMMA * reduced, rel=1e-14)


@pytest.mark.parametrize("others", ["--diameter2 300nm,200nm", "--radius2 150nm,100nm"])
def test_only_the_row_of_identical_spheres_in_a_list_has_eq_41(run: Run, others: str) -> None:
    """Eq (41) as printed is for identical spheres only."""
    for first in ("100nm", "--diameter 200nm"):
        found = rows(run(f"frequencies quartz {first} {others} --csv --quiet").out)
        assert [bool(row["rolling_frequency_as_printed [Hz]"]) for row in found] == [False, True]
    (row,) = rows(run("frequencies quartz 100nm --diameter2 300nm --csv --quiet").out)
    assert "rolling_frequency_as_printed [Hz]" not in row


def test_a_table_on_a_terminal_has_the_radii(run: Run) -> None:
    out = run("pull-off quartz 100nm --diameter2 1um,2um --quiet", terminal=True).out
    assert "R1 = 100 nm" in out
    assert re.findall(r"^ +(500|1000) ", out, re.MULTILINE) == ["500", "1000"]
    out = run("contact quartz --diameter 200±10nm --shear-modulus 30GPa --quiet", terminal=True).out
    assert "R1 = R2 = 100.0 ± 5.0 nm, E = 70.2 GPa" in " ".join(out.split())


def test_an_answer_has_the_converted_inputs(run: Run) -> None:
    found = json.loads(run("contact quartz --diameter 200±10nm --shear-modulus 30GPa --json --quiet").out)
    assert found["inputs"] | {"radius": 1e-7, "youngs_modulus": approx(70.2e9)} == found["inputs"]
    assert {"diameter", "shear_modulus"}.isdisjoint(found["inputs"])
    assert found["uncertainties"]["radius"]["plus"] == approx(5e-9)
    said = run("contact quartz 100nm --shear-modulus 30GPa --explain --quantities contact_radius --quiet").out
    assert "power law R1^0.667 γ1^0.333 E1^-0.333 ν1^-0.0198" in said  # −(2/3)ν²/(1 − ν²), at a fixed E


def test_an_input_that_changes_nothing_is_named_as_it_was_typed(run: Run) -> None:
    given = "--density 1g/cm3 --quantities mass --diameter2 2um --shear-modulus 30GPa"
    for ratio in ("", " --poisson 0.2"):
        assert "--shear-modulus" in run(f"report 100nm {given}{ratio}").err.partition(" change")[0]


@pytest.mark.parametrize("line", ["pull-off", "impact", "export lammps", "infer gamma", "map pull-off", "batch -"])
def test_every_command_with_a_radius_takes_diameters_and_shear_moduli(run: Run, line: str) -> None:
    said = run(f"{line} --help").out
    for option in ("--diameter", "--diameter2", "--shear-modulus", "--shear-modulus2"):
        assert re.search(rf"{option}(?![\w-])", said), option


def test_a_surface_energy_is_inferred_for_spheres_of_a_diameter(run: Run) -> None:
    """γ = P_c/3πR on a plane, for smooth spheres."""
    gamma = 300e-9 / (3 * math.pi * 2e-6)
    ran = run("infer gamma quartz --diameter 4um --diameter2 plane --measured pull_off_force=300nN --bare --quiet")
    assert float(ran.out) == approx(gamma, rel=1e-12)
    measured = {"pull_off_force": ["300 nN", "150 nN"]}
    assert infer("gamma", measured=measured, diameter=[4e-6, 2e-6], diameter2="plane") == approx([gamma] * 2, rel=1e-12)
    bar = infer("gamma", measured={"pull_off_force": "300 nN"}, diameter="4.0±0.4 um", diameter2="plane")
    assert (bar.plus, bar.minus) == approx((gamma / 9, gamma / 11), rel=1e-12)
    for given, name in (("--diameter 4um", "radius"), ("2um --shear-modulus 3GPa", "youngs_modulus")):
        ran = run(f"infer {name} quartz {given} --measured stiffness=1kN/m")
        assert ran == (2, "", f"jkroll: {name} is given, and also measured or to be inferred; leave out one\n")


# --- Pictures ---------------------------------------------------------------------------------------------------------


def test_maps_take_diameters_as_axes_and_a_fixed_shear_modulus(run: Run) -> None:
    words = "--x diameter=100nm:10um:3 --data - --quiet"
    found = rows(run(f"map pull-off --gamma 25mJ/m2 --diameter2 plane {words}").out)
    assert forces(found) == approx([3 * math.pi * GAMMA * d / 2 for d in (1e-7, 1e-6, 1e-5)], rel=1e-12)
    assert [float(row["diameter [m]"]) for row in found] == approx([1e-7, 1e-6, 1e-5], rel=1e-12)
    words = "--shear-modulus 30GPa --x poisson_ratio=0.1:0.3:3:lin"
    for solid in ("--gamma 25mJ/m2", "quartz"):
        found = rows(run(f"map contact_radius {solid} --diameter 200nm {words} --data - --quiet").out)
        radii = [float(row["contact_radius [m]"]) for row in found]
        assert radii == approx([contact_radius(30e9 / (1 - nu)) for nu in (0.1, 0.2, 0.3)], rel=1e-12)
        assert "G1 = 30 GPa" in run(f"map contact_radius {solid} --diameter 200nm {words}").out
    said = run("map pull-off --x diameter=10nm:1um --y gamma=1mJ/m2:100mJ/m2 --mark quartz@100nm").out
    assert "quartz, 100 nm: P_c = 11.78 nN" in said
    assert "R1 =" not in run("map pull-off quartz --x diameter=10nm:1um").out
    curves = run("map pull-off --diameter 100nm,200nm --x gamma=1mJ/m2:1J/m2:2 --data - --quiet").out
    assert re.findall(r"R1 = \d+ nm", curves) == ["R1 = 50 nm"] * 2 + ["R1 = 100 nm"] * 2


@pytest.mark.parametrize(
    ("words", "said"),
    [
        ("quartz 100nm --x diameter=1nm:1um", "diameter is on an axis; leave out its single value"),
        ("quartz --diameter 1um --x radius=1nm:1um", "radius is on an axis; leave out its single value"),
        ("--x radius=1nm:1um --y diameter=1nm:1um", "both axes are radius"),
    ],
)
def test_an_axis_excludes_the_input_that_follows_from_it(run: Run, words: str, said: str) -> None:
    assert run(f"map pull-off {words}") == (2, "", f"jkroll: {said}\n")


# --- Tables -----------------------------------------------------------------------------------------------------------


def results(run: Run, table: str, *words: str) -> tuple[str, list[dict[str, str]]]:
    """Return the messages of `batch` on a table, and the rows that it writes."""
    Path("grains.csv").write_text(table, encoding="utf-8")
    ran = run("batch", "grains.csv", *words, "--no-doubt", "-o", "out.csv")
    return ran.err, rows(Path("out.csv").read_text(encoding="utf-8"))


def forces(found: list[dict[str, str]]) -> list[float | None]:
    return [float(row["pull_off_force [N]"]) if row["pull_off_force [N]"] else None for row in found]


ONLY_FORCE = ("--gamma", "25mJ/m2", "--quantities", "pull_off_force")


def test_a_column_of_diameters_is_read(run: Run) -> None:
    err, found = results(run, "diameter [nm],diameter2 [um]\n200,\n200,plane\n200,inf\n200,0.2\n,1\n-1,\n", *ONLY_FORCE)
    assert err.splitlines()[0] == "read: diameter [nm], diameter2 [um]"
    assert forces(found)[:4] == approx([FORCE, 2 * FORCE, 2 * FORCE, FORCE], rel=1e-14)
    assert [row["status"] for row in found[4:]] == ["needs radius", "bad diameter"]
    assert "no column and no option gives a radius" not in err


def test_the_option_column_reads_a_column_as_a_diameter(run: Run) -> None:
    _, found = results(run, "d50 (um)\n0.2\n0.4\n", *ONLY_FORCE, "--column", "d50 (um)=diameter [um]")
    assert forces(found) == approx([FORCE, 2 * FORCE], rel=1e-14)


def test_a_table_may_mix_rows_with_radii_and_rows_with_diameters(run: Run) -> None:
    table = "radius [nm],diameter [nm]\n100,\n,200\n,400\n100,200\n,\n"
    err, found = results(run, table, *ONLY_FORCE)
    assert forces(found)[:3] == approx([FORCE, FORCE, 2 * FORCE], rel=1e-14)
    exclude = "radius and diameter exclude each other: one follows from the other"
    assert [row["status"] for row in found[3:]] == [exclude, "needs radius"]
    assert err.splitlines()[0] == "read: radius [nm], diameter [nm]"


def test_a_column_of_diameters_is_passed_through_if_every_diameter_has_a_radius(run: Run) -> None:
    err, found = results(run, "radius [nm],diameter [nm],diameter_err [nm]\n100,200,5\n200,400,5\n,,\n", *ONLY_FORCE)
    assert err.splitlines()[0] == "read: radius [nm]; passed through: diameter [nm], diameter_err [nm]"
    assert forces(found)[:2] == approx([FORCE, 2 * FORCE], rel=1e-14)


def test_an_option_fills_empty_cells_of_diameters_and_radii(run: Run) -> None:
    err, found = results(run, "name,diameter [nm]\na,200\nb,\n", *ONLY_FORCE, "--radius", "200nm")
    assert "note: --radius fills empty cells: other cells keep theirs" in err.splitlines()
    assert forces(found) == approx([FORCE, 2 * FORCE], rel=1e-14)
    _, found = results(run, "name,radius [nm]\na,100\nb,\n", *ONLY_FORCE, "--diameter", "400nm")
    assert forces(found) == approx([FORCE, 2 * FORCE], rel=1e-14)


def test_uncertainties_of_diameters_in_tables_propagate(run: Run) -> None:
    table = "diameter [nm],diameter_err [nm]\n200,10\n400,40\n200,\n"
    _, found = results(run, table, *ONLY_FORCE)
    bars = [row["pull_off_force_plus [N]"] for row in found]
    assert [float(bar) for bar in bars[:2]] == approx([FORCE / 20, FORCE / 5], rel=1e-12)
    assert bars[2] == ""
    _, found = results(run, "diameter [nm]\n180 to 220\n", *ONLY_FORCE)
    ends = [float(found[0][f"pull_off_force_{end} [N]"]) for end in ("low", "high")]
    assert ends == approx([0.9 * FORCE, 1.1 * FORCE], rel=1e-12)


def test_a_column_of_shear_moduli_is_read(run: Run) -> None:
    words = ("--gamma", "25mJ/m2", "--radius", "100nm", "--quantities", "contact_radius")
    table = "material,G [GPa],nu\nquartz,30,\n,30,0.17\n,30,\ngold,30,\n,30±3,0.17±0.01\n"
    _, found = results(run, table, *words)
    assert [float(row["contact_radius [m]"]) for row in found[:2]] == approx([A0, A0], rel=1e-14)
    assert [row["status"] for row in found[2:]] == ["needs poisson_ratio"] * 2 + ["correlated error bars"]
    err, found = results(run, "E [GPa],G [GPa],nu\n54,23,0.17\n70.2,30,0.17\n", *words)
    assert err.splitlines()[0].endswith("passed through: G [GPa]")
    assert float(found[1]["contact_radius [m]"]) == approx(A0, rel=1e-12)
    _, found = results(run, "G [GPa],nu,nu2\n30,0.17,\n30,0.17,0.3\n", *words)
    unlike = contact_radius(1 / ((1 - RATIO) / 60e9 + 0.7 / 60e9))
    assert [float(row["contact_radius [m]"]) for row in found] == approx([A0, unlike], rel=1e-14)


def test_a_surface_energy_is_inferred_in_a_table_of_diameters(run: Run) -> None:
    table = "diameter [um],pull_off_force [nN]\n4,300\n2,150\n"
    words = ("--diameter2", "plane", "--infer", "gamma", "--measured", "pull_off_force")
    _, found = results(run, table, *words)
    gamma = 300e-9 / (3 * math.pi * 2e-6)
    assert [float(row["surface_energy [J/m^2]"]) for row in found] == approx([gamma, gamma], rel=1e-12)
