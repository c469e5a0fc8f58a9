"""What may stand in place of results, as columns of tables, lines and files."""

import csv
import json
import re
from typing import Any

import pytest

from harness import Run
from jkroll import answer, solve
from relative import approx

QUARTZ: dict[str, Any] = {"material": "quartz", "radius": 1e-7}


def cells(run: Run, words: str, symbol: str) -> list[str]:
    """Return the cells of the row of a symbol in a table on a terminal, from the symbol on."""
    table = re.sub(r"\x1b\[[0-9;]*m", "", run(words, terminal=True).out)
    (line,) = [line for line in table.splitlines() if f" {symbol} " in line or line.startswith(f"{symbol} ")]
    return re.split(r"\s{2,}", line[line.index(f"{symbol} ") :].strip())


def test_a_law_stands_beside_jkr_where_it_moves_a_result() -> None:
    force = solve("pull_off_force", model="maugis", **QUARTZ, atomic_spacing=4e-10)
    assert answer("pull-off", **QUARTZ).alternatives == {"maugis": {"pull_off_force": force}}
    assert answer("pull-off", material="iron", radius=1e-3).alternatives == {}  # JKR holds
    assert answer("r-min", **QUARTZ).alternatives.keys() == {"data"}  # which no law enters
    (of_jkr,) = answer("pull-off", model="maugis", **QUARTZ).alternatives.values()
    assert of_jkr["pull_off_force"] == solve("pull_off_force", **QUARTZ)
    assert answer("pull-off", model="dmt", material="quartz", radius=1e-4).alternatives.keys() == {"maugis"}


def test_columns_of_a_table(run: Run) -> None:
    by_maugis = solve("yield_force", model="maugis", **QUARTZ, atomic_spacing=4e-10)
    symbol, own, maugis, data, unit = cells(run, "yield-force quartz 100nm", "Q")
    assert (symbol, float(own), unit) == ("Q", approx(94.25), "pN")
    assert float(maugis) == approx(by_maugis * 1e12, rel=1e-3)
    assert data == "89–270"
    assert cells(run, "yield-force quartz 100nm", "δ_α")[1:] == ["4.000", "as JKR", "3.8–11", "mrad"]
    assert cells(run, "pull-off quartz 100nm", "P_c") == ["P_c", "11.78", "15.00", "15.71", "nN"]  # with their zeros


def test_every_quantity_that_is_shown_is_compared(run: Run) -> None:
    """Also one that the other law has not, or with a contact without a radius, and energies of the well."""
    bound = answer("contact", **QUARTZ, approach_at_load=-0.08e-9)
    of_maugis = solve(["stiffness", "load"], model="maugis", **QUARTZ, approach_at_load=-0.08e-9, atomic_spacing=4e-10)
    values = bound.alternatives["maugis"]
    assert values["contact_radius_at_load"] == 0
    assert values["boussinesq_pressure"] is None
    assert {name: values[name] for name in of_maugis} == of_maugis
    assert cells(run, "contact quartz 100nm --approach -0.08nm", "p_B")[2] == "–"
    well = answer("contact", **QUARTZ)
    assert well.alternatives["maugis"]["well_energy"] == approx(2.85 * solve("well_energy", **QUARTZ), rel=2e-3)


@pytest.mark.parametrize("name", ["sticking_energy", "sticking_speed"])
def test_what_the_atomic_spacing_decides_has_a_value_where_it_is_given(name: str) -> None:
    """Beside JKR as under Maugis' law itself."""
    assert answer("energies", **QUARTZ).alternatives["maugis"][name] is None
    assert answer("energies", model="maugis", **QUARTZ)[name].value is None
    given = {**QUARTZ, "atomic_spacing": 3e-10}
    value = answer("energies", model="maugis", **given)[name].value
    assert value
    assert answer("energies", **given).alternatives["maugis"][name] == value


def test_where_columns_do_not_fit_they_are_a_second_table(run: Run, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("COLUMNS", "70")
    lines = run("yield-force quartz 100nm", terminal=True).out.splitlines()
    heads = [line for line in lines if "symbol" in line]
    assert len(heads) == 2
    assert "JKR" in heads[0]
    assert "by 1 µm data" not in heads[0]
    assert "JKR" in heads[1]
    assert "by 1 µm data" in heads[1]
    assert sum("force that starts rolling" in line for line in lines) == 2  # what a row is stands in both


def test_what_is_inferred_by_another_law_has_its_own_error_bar(run: Run) -> None:
    words = "infer gamma quartz 2um --radius2 plane --measured P_c=300±20nN"
    of_maugis = dict(line.split()[:2] for line in run(f"{words} --model maugis").out.splitlines())
    value, minus = (float(of_maugis[name]) * 1e3 for name in ("surface_energy", "surface_energy_minus"))
    row, *_ = [line for line in run(words, terminal=True).out.splitlines() if line.startswith("surface energy")]
    assert f"{value:.2f} ± {minus:.2f}" in row


def test_the_limit_of_small_hard_spheres_has_its_error_bar(run: Run) -> None:
    """4πγR, of γ = 25 ± 5 or 20 to 30 mJ/m² and R1 = 100 nm: as a column of the table, and in --explain."""
    for gamma, cell in (("25±5mJ/m2", "15.7 ± 3.1"), ("20 to 30mJ/m2", "13–19")):
        words = ("pull-off", "100nm", "--gamma", gamma, "--young", "54GPa", "--poisson", "0.17")
        (row,) = [line for line in run(*words, terminal=True).out.splitlines() if "P_c" in line]
        assert row.split("  ")[-2:] == [cell, "nN"]


@pytest.mark.parametrize("option", ["", "--alternatives"])
def test_a_row_that_only_another_law_can_answer_fails_whatever_is_written(run: Run, option: str) -> None:
    """In DMT no hysteresis of adhesion has a lag; by Maugis' law it has one."""
    words = "yield-force quartz 100nm,200nm --hysteresis-fraction 0.9 --model dmt --csv"
    ran = run(f"{words} {option}")
    assert (ran.code, ran.out.count("not in DMT")) == (1, 2)
    assert "2 of 2 rows failed" in ran.err


def test_lists_have_it_beside_the_headline(run: Run) -> None:
    out = run("pull-off quartz,iron 100nm,1mm", terminal=True).out
    assert "P_c by Maugis" in out
    assert "by Maugis" not in run("pull-off iron 1mm,2mm", terminal=True).out
    assert "by Maugis" not in run("pull-off quartz 100nm --model jkr,maugis", terminal=True).out
    assert "P_c by JKR" in run("pull-off quartz 100nm,1um --model maugis", terminal=True).out
    assert re.search(r"no data +880–1300", run("yield-force quartz 50nm 1um", terminal=True).out)
    assert re.search(
        r"Q by data \[pN\] +– +880–1300", run("yield-force quartz 2nm 1um", terminal=True).out
    )  # no meaning


def test_lists_have_its_error_bars(run: Run) -> None:
    def cell(gamma: str, model: str) -> str:
        found: Any = solve(
            "yield_force", model=model, material="quartz", radius=1e-6, gamma=gamma, atomic_spacing=4e-10
        )
        return f"{found.value * 1e12:.1f} ± {found.minus * 1e12:.1f}"

    out = run("yield-force quartz 100nm,1um --gamma 22±1mJ/m2", terminal=True).out
    (row,) = [line for line in out.splitlines() if "Q by Maugis [pN]" in line]
    assert row.endswith(cell("22±1 mJ/m2", "maugis"))
    by_spacing: Any = solve("pull_off_force", model="maugis", **QUARTZ, atomic_spacing="0.4±0.1 nm")
    out = run("pull-off quartz 100nm,1um --z0 0.4±0.1nm", terminal=True).out
    assert f"{by_spacing.value * 1e9:.2f} +{by_spacing.plus * 1e9:.2f}/-{by_spacing.minus * 1e9:.2f}" in out


def test_a_list_is_several_tables_where_it_does_not_fit(run: Run) -> None:
    words = "yield-force quartz,silica-humid 100nm,1um --gamma 22±1.5mJ/m2 --load 1±0.1nN"
    lines = run(words, terminal=True).out.splitlines()
    first, *others = [line for line in lines if line.startswith("material")]
    assert others
    assert all(line.startswith("material") and "R1 [nm]" in line for line in others)
    assert "  Q [pN]  Q by Maugis [pN]" in first
    assert sum("Q by data [pN]" in line for line in (first, *others)) == 1
    assert max(map(len, lines)) <= 80


def test_files_and_lines_have_it_where_it_is_asked_for(run: Run) -> None:
    head = "pull_off_force_by_maugis [N]"
    assert head not in run("pull-off quartz 100nm --csv").out
    (row,) = csv.DictReader(run("pull-off quartz 100nm --csv --alternatives").out.splitlines())
    by_maugis = json.loads(run("pull-off quartz 100nm --json").out)["laws"]["maugis"]["pull_off_force"]["value"]
    assert float(row[head]) == by_maugis
    assert f"pull_off_force_by_maugis {row[head]} N" in run("pull-off quartz 100nm --alternatives").out.splitlines()
    assert "_by_" not in run("pull-off quartz 100nm").out
    for words in (
        "pull-off quartz 100nm --bare",
        "contact quartz 100nm --curve --csv",
        "infer gamma quartz 1um --measured P_c=1nN",
    ):
        assert run(f"{words} --alternatives").code == 2


def test_explanations_have_the_powers_of_inputs(run: Run) -> None:
    """Of f_z, γ^(1/6) E^(1/3) R^(-7/6) ρ^(-1/2); of δ under a load, at which no power is a simple one."""
    said = run("frequencies quartz 100nm --quantities f_z --explain").out
    assert "  power law R1^-1.17 γ1^0.167 E1^0.333 ν1^0.0198 ρ1^-0.5\n" in said
    assert " N^-0.5\n" in run("aggregates quartz 100nm --monomers 2 --filling-factor 0.2 --explain").out  # at least 2
    under_load = run("contact quartz 100nm --load -5nN --quantities δ --explain").out
    powers = dict(word.split("^") for word in re.findall(r"power law (.*)", under_load)[0].split())
    ends = [solve("approach_at_load", **QUARTZ, load=load) for load in (-5.001e-9, -4.999e-9)]
    assert float(powers["P"]) == approx(2500 * (ends[0] - ends[1]) / ends[0], rel=0.01)


def test_both_readings_of_a_rolling_quantity_are_in_explanations(run: Run) -> None:
    said = run("yield-force quartz 100nm --quantities yield_force --explain").out
    assert re.search(r"by law +40\.47\d* pN at equal ξ, 170\.\d* pN at equal hysteresis \(Maugis–Dugdale\)", said)
