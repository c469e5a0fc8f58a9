"""Numbers, warnings and signs, each compared with a value computed by hand."""

import csv
import json
import os
from pathlib import Path
from typing import Any

import pytest

from harness import Run
from jkroll import solve
from jkroll.errors import BadRequest
from relative import approx
from tuning import read_in_chunks

QUARTZ = "--gamma 25mJ/m2 --young 54GPa --poisson 0.17 --density 2.6g/cm3"


def rows(text: str) -> list[dict[str, str]]:
    """Return the rows of a CSV table."""
    return [*csv.DictReader(text.splitlines())]


def results(text: str) -> dict[str, dict[str, Any]]:
    """Return the results of an answer in JSON, by name."""
    return {result["name"]: result for result in json.loads(text)["results"]}


def batch(run: Run, text: str, words: str) -> list[dict[str, str]]:
    """Return the rows that `batch` writes for a table."""
    Path("in.csv").write_text(text, encoding="utf-8")
    run(f"batch in.csv -o out.csv --jobs 1 {words}")
    return rows(Path("out.csv").read_text(encoding="utf-8"))


# --- Pairs of spheres -------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(("program", "word"), [("lammps", "\ntimestep "), ("liggghts", "\n# timestep ")])
def test_the_exported_time_step_is_the_shortest_over_all_pairs(run: Run, program: str, word: str) -> None:
    """Steps: 50.05 ps for two spheres of iron (300 nm), 27.62 ps for two of quartz (100 nm), 19.57 ps for one of each.

    The step is 1/20 of 2π/√(8G*a(7/2)(1/m1 + 1/m2)) with w = 2√(γ1γ2) and a = (9πwR²/2E*)^(1/3); a fifth of Rayleigh's
    time is 23.3 ps.
    """
    iron = "--gamma 3J/m2 --young 210GPa --poisson 0.27 --density 7.7g/cm3"
    quartz = "--gamma2 25mJ/m2 --young2 54GPa --poisson2 0.17 --density2 2.6g/cm3"
    text = run(f"export {program} 300nm {iron} --radius2 100nm {quartz}").out
    assert float(text.partition(word)[2].split()[0].rstrip(":")) == approx(1.9574068730020e-11, rel=1e-9)


OF_IDENTICAL_QUARTZ = approx(2.0938217872665e7, rel=1e-12)


@pytest.mark.parametrize(
    ("words", "cells"),
    [
        ("100nm --radius2 200nm,100nm", ["", OF_IDENTICAL_QUARTZ]),
        ("100nm --radius2 50nm:200nm:3", ["", OF_IDENTICAL_QUARTZ, ""]),
        ("100nm --radius2 200nm:50nm:3", ["", OF_IDENTICAL_QUARTZ, ""]),
        ("200nm,100nm --radius2 100nm", ["", OF_IDENTICAL_QUARTZ]),
        ("100nm --radius2 200nm,300nm", [None, None]),
    ],
)
def test_only_rows_of_identical_spheres_have_eq_41(run: Run, words: str, cells: list[Any]) -> None:
    """Eq (41): f = √(6πwR²/((5/4)m R1²))/2π = 20.938218 MHz for two quartz spheres of 100 nm."""
    found = rows(run(f"frequencies {words} {QUARTZ} --csv").out)
    texts = [row.get("rolling_frequency_as_printed [Hz]") for row in found]
    assert [text and float(text) for text in texts] == cells
    assert all(row["rolling_frequency [Hz]"] and not row["status"] for row in found)


@pytest.mark.parametrize(("loads", "energies"), [("0nN:1nN:2", ["", "0.025"]), ("1nN:0nN:2", ["0.025", ""])])
def test_a_range_of_loads_has_a_column_for_an_input_of_some_rows(run: Run, loads: str, energies: list[str]) -> None:
    """√(1 + P/P_c) is 1 without a load, whatever γ is."""
    found = rows(run(f"contact quartz 10nm --load {loads} --quantities load_margin --csv").out)
    assert [row["surface_energy [J/m^2]"] for row in found] == energies


def test_a_reduced_radius_excludes_the_radius_of_sphere_2() -> None:
    with pytest.raises(BadRequest, match="radius2 and reduced_radius exclude each other"):
        solve("pull_off_force", surface_energy=0.025, reduced_radius=5e-8, radius2=1e-7)


def test_the_mean_of_two_surface_energies_is_in_doubt_above_a_ratio_of_3(run: Run) -> None:
    said = "w = 2√(γ1γ2) is an upper estimate for solids so unlike"
    for gamma2, is_unlike in {"74mJ/m2": False, "76mJ/m2": True, "8.4mJ/m2": False, "8.3mJ/m2": True}.items():
        assert (said in run(f"pull-off 100nm --gamma 25mJ/m2 --gamma2 {gamma2}").err) is is_unlike


# --- Warnings, doubts and error bars ----------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("words", "is_warning"), [("r-min 0.1nm", True), ("r-min 0.3nm", False), ("pull-off quartz 1nm", False)]
)
def test_a_limit_that_leaves_a_number_without_a_meaning_is_a_warning(run: Run, words: str, *, is_warning: bool) -> None:
    """At R1 = 0.1 nm, R_min = R1R2/ξ = 50 pm is below R1. At 0.3 nm, R_min is above R1, and only ξ/R = 1.3 is large."""
    err = run(f"{words} --quiet").err
    assert err.startswith("warning: ") is is_warning
    assert ("no chain bends more sharply than" in err) is is_warning


CODES = {
    # Lennard-Jones' over JKR's, 1 + (1/3)/(1 + 1.95 μ^1.4), is 1.25 at 899 nm and 1.05 at 389 µm; Maugis' is smaller.
    "pull-off 890nm,910nm,380um,400um": ["law-off-25%", "law-off-5%", "law-off-5%", ""],
    # Maugis' over JKR's is c/a0 = 1.160 at equal hysteresis, and 0.660 at equal ξ (maugis_reference).
    "yield-force 10um --adhesion-hysteresis 10mJ/m2 --quantities yield_force": ["law-off-5%"],
    "yield-force 10um --quantities yield_force": ["law-off-25%"],
    # T = 4P_c√(G*/E*) over πa_T²τ, τ = G/4π², a_T = a0/2^(1/3), is 1.218 (100 nm/R1)^(1/3): 1 at 180.7 nm.
    "resistances 180nm,182nm --quantities sliding_force": ["", "peels-before-sliding"],
}


@pytest.mark.parametrize("words", CODES)
def test_a_doubt_begins_where_its_number_passes_the_threshold(run: Run, words: str) -> None:
    found = [row["doubt"].split() for row in rows(run(f"{words} {QUARTZ} --csv").out)]
    assert [" ".join(code for code in codes if code[:3] in ("law", "pee")) for codes in found] == CODES[words]


def test_a_note_has_the_forces_on_real_surfaces(run: Run) -> None:
    """P_c = (3/2)πγR1 = 117.8 nN; smooth glass in dry air holds 1/4 to 1/2 of it, rough grains hold 1/100 to 1/10."""
    said = run("pull-off quartz 1um").err
    assert ("29–59 nN" in said, "1.2–12 nN" in said) == (True, True)


def test_a_sticking_speed_gives_an_upper_limit_of_the_surface_energy(run: Run) -> None:
    """Losses other than adhesion raise the γ inferred from a sticking speed, but not the γ inferred from P_c."""
    for measured, is_limit in {"sticking_speed=10cm/s": True, "pull_off_force=100nN": False}.items():
        assert ("an upper limit" in run(f"infer gamma quartz 1um --measured {measured}").err) is is_limit


def test_an_empty_cell_has_no_doubts(run: Run) -> None:
    """At 1 ns, T* = (T_vis/ν²)√(E*a0/m) with the reduced mass m is 156. Above 0.68 there is no v_stick to judge."""
    words = f"{QUARTZ} --quantities pull_off_force,sticking_speed"
    found = batch(run, "R1 (nm),viscous_time [ps]\n100,1000\n100,1\n", words)
    assert [row["doubt"] for row in found] == ["law-off-25%", "law-off-25% sticking-unsure fitted-elsewhere"]


@pytest.mark.parametrize("loads", ["-15.5nN,-15.6nN", "-15.5nN:-15.6nN:400:lin"])
def test_a_load_beyond_pull_off_by_the_better_law_is_off_by_more_than_any_factor(run: Run, loads: str) -> None:
    """For quartz of 100 nm, P_c is 15.004 nN by Maugis' law (maugis_reference), and 2πwR = 15.71 nN in DMT."""
    found = rows(run(f"contact 100nm {QUARTZ} --model dmt --load={loads} --csv").out)
    assert {row["doubt"].split()[0] for row in found} == {"law-off-2x"}
    assert all(row["contact_radius_at_load [m]"] for row in found)


@pytest.mark.parametrize(
    ("words", "by"),
    [
        ("--material2 quartz", "scaled"),
        ("--material2 gold --work-of-adhesion 50mJ/m2", "ξ unknown"),
        ("--model maugis", "Maugis"),
        ("--xi 2nm", "any law"),
    ],
)
def test_measured_rolling_forces_give_a_range_of_xi_for_their_solid_only(run: Run, words: str, by: str) -> None:
    """R_min = R1²/ξ, with ξ from measured forces of 0.69 to 1.57 nN at R1 = 0.95 µm.

    By JKR, Q = 6πγξ gives ξ = 1.4642 to 3.3317 nm. By Maugis' law at z0 = 2 Å, F = 4E*a³ξ/(3RR1) gives ξ = 2.8180 nm
    for 0.85 nN (maugis_reference), and so 2.2875 to 5.2050 nm; at 1 Å, ξ is smaller.
    """
    (result,) = json.loads(run(f"r-min quartz 0.95um --z0 2angstrom {words} --json").out)["results"]
    best = result["best"]
    assert best["by"] == by
    if by == "scaled":
        ends = [0.95e-6**2 / displacement for displacement in (5.2050e-9, 1.46423e-9)]
        assert [best["low"], best["high"]] == approx(ends, rel=1e-4)


def test_the_displacement_of_a_solid_is_scaled_to_the_reduced_radius(run: Run) -> None:
    """On a plane, 2R is 2R1 instead of R1: ξ = 2 nm at 1 µm becomes 2 nm·2^(2/3) to 2 nm·2, and Q = 6πwξ."""
    text = '[materials.bead]\nsurface_energy = "25 mJ/m2"\nyield_displacement = { value = "2 nm", radius = "1 um" }\n'
    Path("own.toml").write_text(text, encoding="utf-8")
    (row,) = rows(run("yield-force bead 1um --radius2 plane --materials own.toml --csv").out)
    ends = [float(row[f"yield_force_{side} [N]"]) for side in ("low", "high")]
    assert ends == approx([2.9921805e-9, 3.7699112e-9], rel=1e-7)


def test_shares_of_ranges_are_proportional_to_their_widths(run: Run) -> None:
    """F = (3/2)πγR1 at γ = 20 to 30, R1 = 90 to 110: the widths are 10·100 and 20·25, so the shares are 2/3 and 1/3."""
    found = results(run("pull-off", "90 to 110 nm", "--gamma", "20 to 30 mJ/m2", "--json").out)["pull_off_force"]
    assert found["shares"] == approx({"surface_energy": 2 / 3, "radius": 1 / 3}, rel=1e-9)


def test_the_error_of_a_moment_is_that_at_the_given_load_or_approach(run: Run) -> None:
    """At a fixed load, M = 6πwRξ is exact; at a fixed approach (δ0 = a0²/3R), the moment is M(1 + x).

    Here x = E*a0ξ²/(6πwR²), and two half-circles give M(1 + 2x). For quartz of 100 nm, x = 0.0018837, and
    x/(1 + x) = 0.0018801.
    """
    errors = []
    for state in ("--approach 1.0617537427261e-10m", "--load 0nN"):
        found = results(run(f"moment 100nm {QUARTZ} {state} --json").out)
        names = ("yield_moment", "half_circles_moment", "fixed_approach_moment")
        errors += [found[name].get("relative_error", 0.0) for name in names]
    assert errors == approx([0.001880134, 0.001880134, 0.0, 0.0, 0.003767352, 0.001883676], rel=1e-6)


def test_a_column_may_mix_cells_with_and_without_uncertainties(run: Run) -> None:
    """F = (3/2)πγR1 = 11.781 nN, within 1 % for 100 ± 1 nm, 5 % for 100 ± 5 nm, and exactly for 100 nm."""
    cells = ["100±1", "100", "100±5", "100(5)"] * 100
    found = batch(run, "\n".join(["R1 (nm)", *cells, ""]), f"{QUARTZ} --quantities pull_off_force --no-doubt")
    bars = [float(row["pull_off_force_plus [N]"] or 0) for row in found]
    assert bars == approx([1.178097e-10, 0.0, 5.890486e-10, 5.890486e-10] * 100)


# --- Tables and pictures ----------------------------------------------------------------------------------------------


def test_rows_computed_by_several_processes_keep_their_order(run: Run) -> None:
    """F = (3/2)πγR1. The first block in another process takes longest, as its cells have uncertainties."""
    cells = [f"{radius}±1" if 12 <= radius < 30 else f"{radius}" for radius in range(1, 120)]
    Path("in.csv").write_text("\n".join(["R1 (nm)", *cells, ""]), encoding="utf-8")
    with read_in_chunks(64):
        ran = run("batch in.csv -o out.csv --gamma 25mJ/m2 --quantities pull_off_force --uncertainty --jobs 2")
    assert ran.code == 0
    found = rows(Path("out.csv").read_text(encoding="utf-8"))
    assert [row["R1 (nm)"] for row in found] == cells
    assert [float(row["pull_off_force [N]"]) / 1.1780972450961724e-10 for row in found] == approx([*range(1, 120)])


@pytest.mark.parametrize(("later", "is_kept"), [(1, True), (0, True), (-1, False)])
def test_resume_keeps_a_result_that_is_not_older_than_its_table(run: Run, later: int, *, is_kept: bool) -> None:
    for name, text, time in (("in", "radius [nm]\n100\n", 10**18), ("out", "kept", 10**18 + later)):
        Path(name).mkdir()
        Path(f"{name}/a.csv").write_text(text, encoding="utf-8")
        os.utime(f"{name}/a.csv", ns=(time, time))
    assert run("batch in/*.csv -o out/ --quantities r_min --resume").code == 0
    assert (Path("out/a.csv").read_text(encoding="utf-8") == "kept") is is_kept


@pytest.mark.parametrize("words", ["quartz 100nm --model dmt", "iron 1um --model dmt", "pdms 10um --model maugis"])
def test_a_force_curve_has_a_load_of_exactly_0_at_equilibrium(run: Run, words: str) -> None:
    loads = {row["state"]: row["load [N]"] for row in rows(run(f"contact {words} --curve --csv").out)}
    assert loads["equilibrium"] == "0.0"


def test_quartiles_and_scatter_of_inferred_values_are_those_of_a_sample(run: Run) -> None:
    """γ = F/3πR, with 3πR = 18.85 µm for 2 µm on a plane.

    Forces of 200, 300, 400, 600 and 1000 nN have the mean 500 nN and the scatter √(Σ(F − F̄)²/4) = 316.23 nN.
    """
    Path("in.csv").write_text("R1 (um),P_c (nN)\n2,200\n2,300\n2,400\n2,600\n2,1000\n", encoding="utf-8")
    said = run("batch in.csv -o out.csv --infer gamma --measured pull_off_force --radius2 plane").err
    quartiles = "median 21.2207 mJ/m², quartiles 15.9155 mJ/m² and 31.831 mJ/m²"
    assert f"{quartiles}; mean 26.5258 mJ/m², scatter 16.7764 mJ/m²" in said.replace("\n  ", " ")


def test_a_strict_run_names_the_first_bad_row_and_ends_with_the_worst_code(run: Run) -> None:
    Path("in").mkdir()
    Path("in/a.csv").write_text("radius [nm]\n1\n0\n-1\n", encoding="utf-8")
    Path("in/b.csv").write_text("radius [nm],radius [nm]\n1,2\n", encoding="utf-8")
    ran = run("batch in/*.csv -o out/ --strict --quantities r_min --quiet")
    assert (ran.code, "'in/a.csv': line 3: radius: '0' must be positive" in ran.err) == (2, True)


def test_signs_of_a_map_stand_where_a_limit_is_exceeded(run: Run) -> None:
    """An x marks a0 = (9πγR²/E*)^(1/3) below 3 z0 = 1.2 nm: γ below 2.7 mJ/m² at 50 nm, and below 17 mJ/m² at 20 nm.

    A ' marks a law that is off by more than 5 %: at 1 J/m², a0 by JKR over a0 by Maugis' law is 1.036 at 200 nm and
    1.052 at 100 nm (maugis_reference).
    """
    out = run("map contact-radius --young 54GPa --poisson 0.17 --x gamma=1mJ/m2:1J/m2 --y radius=20nm:200nm").out
    assert out.splitlines()[3:8] == [
        "R1         1 mJ/m²    10 mJ/m²  100 mJ/m²     1 J/m²",
        "200 nm  2.17 nm '   4.67 nm '   10.1 nm '  21.7 nm",
        "100 nm  1.36 nm '   2.94 nm '   6.33 nm '  13.6 nm '",
        "50 nm    860 pm 'x  1.85 nm '   3.99 nm '   8.6 nm '",
        "20 nm    467 pm 'x  1.01 nm 'x  2.17 nm '  4.67 nm '",
    ]


def test_the_axis_of_pressures_ends_at_2_5_times_the_hertz_pressure(run: Run) -> None:
    """Fig. 9, a = (32wR²/πE′)^(1/3) = 1.5416 nm: E′a/2R = 2.143 GPa, so the axis ends at 5.358 GPa.

    Of the points of the curve, at −a cos(πk/400), the outermost one within the axis has −5.317 GPa (k = 24); the next
    has −5.579 GPa.
    """
    assert run("figure 9").out.splitlines()[6] == "exact, Eq (56)   -1.514   -5.317"
