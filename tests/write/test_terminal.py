"""Output on a terminal: tables and notes that fit its width."""

import json
import re

import pytest

from harness import Run, Stream
from jkroll.cli.commands import commands_taking
from jkroll.model.limits import LIMITS
from jkroll.quantities.formatting import Format
from jkroll.quantities.nomenclature import NOMENCLATURE
from jkroll.text import say_wrapped
from jkroll.write.catalogue import write_quantities
from relative import approx
from tuning import computed, tables_on_a_terminal


@pytest.mark.parametrize(
    ("columns", "rows"),
    [("400", 2), ("100", 14), ("72", 14), ("30", 2)],
)
def test_pairs_are_rows_columns_or_several_tables_depending_on_the_width_of_the_terminal(
    run: Run, monkeypatch: pytest.MonkeyPatch, columns: str, rows: int
) -> None:
    """The table has thirteen results and the doubts; it has no best ranges, because the law is given."""
    monkeypatch.setenv("COLUMNS", columns)
    words = "report graphite,iron 1mm --gamma 75mJ/m2 --model jkr --quiet"
    lines = run(words, terminal=True).out.splitlines()
    heads = [line for line in lines if line.startswith("material")]
    assert (len(heads) > 1) == (columns == "30")
    assert all(({"graphite", "iron"} <= set(head.split())) == (rows == 14) for head in heads)
    if len(heads) == 1:
        table = [
            line for line in lines if not line.startswith(("rough-matters: ", "law-off", "  "))
        ]  # without the lines that explain codes
        assert len(table) - table.index(heads[0]) - 2 == rows
        assert all(len(line) <= int(columns) for line in lines)


def test_pairs_as_columns_have_a_line_for_each_input_that_differs(run: Run, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("COLUMNS", "120")
    table = run("report quartz,iron 50nm 100nm --gamma 75mJ/m2 --quiet", terminal=True).out.splitlines()
    table = table[next(index for index, line in enumerate(table) if line.startswith("material ")) :]
    assert table[0].split() == ["material", "quartz", "quartz", "iron", "iron"]
    assert table[2].split()[-6:] == ["R1", "[nm]", "50", "100", "50", "100"]


@pytest.mark.parametrize("by_arrays", [False, True])
def test_too_many_rows_for_a_table_are_printed_as_lines(run: Run, *, by_arrays: bool) -> None:
    with tables_on_a_terminal(99), computed(by_arrays=by_arrays, block=40):
        assert "─" in run("pull-off quartz 1nm:1um:99 --quiet", terminal=True).out
        lines = run("pull-off quartz 1nm:1um:100 --quiet", terminal=True).out.splitlines()
        assert [len(line.split("\t")) for line in lines] == [6] * 101


@pytest.mark.parametrize(
    ("values", "unit"),
    [
        ((11.781e-9, 1413.72e-9), "nN"),
        ((1e-12, 1e-9, 2e-9), "nN"),
        ((1e-12, 1e-9, 1e-6, 5e-4), "nN"),
        ((1e-9, 1e-8, 5e-4), "nN"),
        ((0.0, 5e-9), "nN"),
    ],
)
def test_the_unit_of_a_column_suits_the_middle_of_its_values(values: tuple[float, ...], unit: str) -> None:
    text, _ = Format().common_unit("pull_off_force", values)
    assert text == unit


def test_notes_are_wrapped_only_on_a_terminal(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("COLUMNS", "30")
    text = "note: assumed ξ = 200 pm (--xi), g = 9.80665 m/s² (--gravity)"
    terminal, pipe = Stream(terminal=True), Stream()
    say_wrapped(text, terminal)
    say_wrapped(text, pipe)
    assert pipe.text() == text + "\n"
    lines = terminal.text().splitlines()
    assert len(lines) == 3
    assert all(len(line) <= 30 for line in lines)
    assert all(line.startswith("  ") for line in lines[1:])
    assert " ".join(line.strip() for line in lines) == text


@pytest.mark.parametrize("law", ["maugis", "dmt"])
def test_only_values_by_jkr_have_its_definition(run: Run, monkeypatch: pytest.MonkeyPatch, law: str) -> None:
    monkeypatch.setenv("COLUMNS", "250")
    words = "energies quartz 100nm --quiet"
    of_law = run(f"{words} --model {law}", terminal=True).out
    explained = run(f"{words} --explain").out
    energies = json.loads(run(f"{words} --json").out)["results"]
    others = json.loads(run(f"{words} --model {law} --json").out)["results"]
    # Without `--model`, `energies` shows no energies by Lennard-Jones.
    others = [one for one in others if not one["name"].endswith("lennard_jones")]
    assert None in [one["value"] for one in others if "jkr" in one]
    for one, other in zip(energies, others, strict=True):
        assert one["definition"] in re.sub(r"\s+", " ", explained)
        is_of_jkr = one["value"] == other["value"]
        assert ("definition" in other) == is_of_jkr, one["name"]
        assert is_of_jkr or other["jkr"] == one["value"]
    assert " U_stick " not in of_law


def test_one_warning_has_all_reasons_why_numbers_have_no_meaning_even_with_quiet(run: Run) -> None:
    found = {one["code"] for one in json.loads(run("report quartz 0.3nm --json").out)["validity"]}
    ending = [limit for limit in LIMITS if limit.ends_meaning and not found.isdisjoint(limit.codes.values())]
    assert len(ending) > 3
    for options in ("", "--quiet"):
        [warning] = [line for line in run(f"report quartz 0.3nm {options}").err.splitlines() if "warning: " in line]
        assert all(limit.consequence in warning for limit in ending)
    explained = run("report quartz 0.3nm --explain").out
    limits = json.loads(run("report quartz 0.3nm --json").out)["validity"]
    exceeded = [limit for limit in limits if not limit["holds"]]
    assert len(exceeded) > 7
    for limit in exceeded:
        is_explained = f"({limit['symbol']} = " in explained
        assert is_explained or limit["code"].startswith(("law", "does-not-roll")), limit["symbol"]


def test_doubts_are_sorted_by_the_factor_beyond_their_limit(run: Run) -> None:
    """The factors decrease: M/2cRw = 3.1 is above 1, a/z0 = 1.5 below 3, and p_H/E* = 0.13 above 0.1."""
    said = run("yield-force quartz 6nm --explain").out
    places = [said.index(f"({symbol} = ") for symbol in ("M/2cRw", "a/z0", "p_H/E*")]
    assert places == sorted(places)


@pytest.mark.parametrize(
    "command", ["yield-force", *(pytest.param(each, marks=pytest.mark.slow) for each in ("n-grav", "report"))]
)
def test_the_best_range_calls_xi_unknown_for_a_surface_energy_that_was_never_rolled(run: Run, command: str) -> None:
    name = "n_grav" if command == "n-grav" else "yield_force"
    for solid, by in (("silica-dry", "ξ unknown"), ("silica-humid", "scaled")):
        results = json.loads(run(f"{command} {solid} 100nm --json").out)["results"]
        assert [result["best"]["by"] for result in results if result["name"] == name] == [by]
        assert "assumed: ξ = 200 pm (--xi)" in run(f"{command} {solid} 100nm").err


def test_a_row_has_two_codes_of_doubt_and_the_number_of_others(run: Run) -> None:
    lines = run("pull-off quartz 1nm,10nm --quiet", terminal=True).out.splitlines()
    rows = [line for line in lines if re.match(r" *10? ", line)]
    assert [line.split()[-2:] for line in rows] == [["few-atoms", "may-yield"]] * 2
    assert " and 2 more" in run("yield-force quartz 0.5nm 2nm", terminal=True).out


def test_powers_of_ten_have_one_form(run: Run) -> None:
    """Tables and sentences write powers alike. A column has one unit, however much its values differ."""
    assert re.search(r" U_grips .* 1\.593  1e-18 J$", run("energies quartz 100nm", terminal=True).out, re.MULTILINE)
    assert "U_grips = 1.5928e-18 J\n" in run("energies quartz 100nm --explain").out
    lines = run("energies quartz 100nm 1mm", terminal=True).out.splitlines()
    (row,) = [line.split() for line in lines if line.startswith("U_load ")]
    assert row == ["U_load", "[1e-18", "J]", "1.104", "237800"]
    curve = run("contact quartz 100nm --curve --quiet", terminal=True).out
    assert "δ [pm]   P [nN]" in re.sub(" {2,}", "   ", curve)


def test_a_list_of_laws_has_doubts_in_the_rows_of_laws_that_do_not_hold(run: Run) -> None:
    """A list under one law has no such doubts: its best ranges show how far off the law is."""
    ran = run("pull-off quartz 100nm --model jkr,maugis,dmt --quantities P_c", terminal=True)
    rows = [line.split() for line in ran.out.splitlines() if line.startswith(("jkr", "maugis", "dmt"))]
    assert rows == [["jkr", "11.78", "law-off-25%"], ["maugis", "14–15"], ["dmt", "15.71"]]
    assert "law-off" not in run("pull-off quartz 100nm,1um --quantities P_c", terminal=True).out


@pytest.mark.parametrize(
    ("line", "taken", "cells"),
    [
        ("report quartz 100nm,1um --quantities P_c,a0", "take best P_c and best a0;", "14–15"),
        ("n-roll polystyrene-glassy 2um --speed 1m/s,5m/s --xi 5nm", "take best n_imp;", "0.49–0.58"),
        ("n-roll polystyrene-glassy 2um,3um --energy 1e-15J --xi 5nm", "take best n_roll;", "best n_"),
        ("n-roll quartz 1um,2um --speed 1m/s --quantities n_roll,n_imp", "take best n_roll and best n_imp;", "0.69"),
        ("impact ice-warm 0.5um --speed 1m/s,20m/s", "take best e and best v_stick;", "1.7–33"),
    ],
)
def test_lists_have_the_best_ranges_of_the_values_to_take(run: Run, line: str, taken: str, cells: str) -> None:
    out = run(line, terminal=True).out
    assert f"\n{taken}" in out
    assert cells in out


def test_curves_name_the_values_to_take(run: Run) -> None:
    curve = run("contact quartz 100nm --curve", terminal=True)
    ranges = "best ranges: P_c 14–15 nN (Maugis), a0 3.0–3.2 nm (Maugis), δ0 115–121 pm (Maugis)"
    assert f"{ranges}; take the curve by Maugis' law: --model maugis" in " ".join(curve.out.split())


def test_a_list_counts_the_doubts_and_warns_of_numbers_without_a_meaning(run: Run) -> None:
    notes = run("pull-off quartz 100nm,900nm --model jkr,dmt").err.splitlines()
    assert notes[0].startswith("note: doubts in 3 of 4 rows (jkroll guide doubts): law-off-5% 2, law-off-25% 1")
    said = run("yield-force quartz 0.5nm 2nm 1um").err
    worst = "xi-over-limit 2 (ξ is too large for the formula)"
    assert f"warning: numbers have no meaning in 2 of 3 rows (jkroll guide doubts): {worst}, " in said


@pytest.mark.parametrize("topic", ["dem", "energies", "tables"])
def test_code_blocks_of_the_manual_keep_their_lines(run: Run, topic: str) -> None:
    shown = [line.rstrip() for line in run(f"guide {topic}", terminal=True).out.splitlines()]
    blocks = re.findall(r"^```\S*\n(.*?)^```$", run(f"guide {topic}").out, re.DOTALL | re.MULTILINE)
    assert blocks
    for line in "".join(blocks).splitlines():
        assert line.rstrip() in shown


def test_units_on_a_terminal_have_superscripts(run: Run) -> None:
    for command in (
        "n-grav quartz 100nm",
        "infer gamma quartz 2um --radius2 plane --measured pull_off_force=300nN",
        "pull-off quartz 100nm --explain",
        "materials ice-warm",
    ):
        ran = run(command, terminal=True, together=True)
        assert "²" in ran.out
        assert "m^2" not in ran.out
        assert "s^2" not in ran.out


@pytest.mark.parametrize(
    "words",
    [
        "pull-off quartz 100nm,1um",
        "infer radius quartz --measured P_c=300nN",
        "infer radius quartz --measured P_c=300nN,400nN",
    ],
)
def test_the_head_names_the_plane_above_a_list_of_radii_or_inferred_radii(run: Run, words: str) -> None:
    ran = run(f"{words} --radius2 plane", terminal=True)
    assert ran.code == 0
    assert "quartz (γ = 25 mJ/m² per surface), R2 = plane" in ran.out


def test_uncertain_columns_have_one_unit_and_two_digits_of_the_uncertainty(run: Run) -> None:
    table = run("pull-off silica-humid,silica-dry 100nm --quiet", terminal=True).out
    assert "best P_c [nN]" in table
    assert re.search(r"silica-humid .* 9\.4–12$", table, re.MULTILINE)
    assert re.search(r"silica-dry +200 +100–110 +Maugis +94\.25$", table, re.MULTILINE)
    assert (
        "9.42 to 11.8 nN"
        in run("pull-off", "quartz", "100nm", "--gamma", "20 to 25mJ/m2", "--digits", "3", "--explain").out
    )


def test_the_list_of_quantities_fits_the_terminal_and_leaves_out_variants(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("COLUMNS", "80")
    terminal = Stream(terminal=True)
    write_quantities([*NOMENCLATURE], terminal, "table", commands_taking)
    groups = [group.splitlines() for group in terminal.text().split("\n\n")[:-1]]
    assert max(len(line) for group in groups for line in group) <= 80
    listed = [line.split()[0] for group in groups for line in group[2:] if not line.startswith(" ")]
    assert sorted(listed) == sorted(name for name, quantity in NOMENCLATURE.items() if not quantity.variant_of)
    assert min(group[0].index("meaning") for group in groups) < max(group[0].index("meaning") for group in groups) <= 56


def test_a_list_with_long_names_fits_the_terminal_and_is_complete(run: Run, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("COLUMNS", "80")
    lines = run("quantities stif", terminal=True).out.splitlines()
    assert max(map(len, lines)) <= 80
    left = lines[0].index("meaning")
    assert "variantofrolling_frequency_no_slip" in "".join(line[left:].replace(" ", "") for line in lines)


@pytest.mark.parametrize(
    ("words", "is_in_head"),
    [("--quantities P_LJ", True), ("--quantities P_LJ --z0 4angstrom", False), ("--model maugis", False)],
)
def test_the_head_has_the_assumed_atomic_spacing_unless_ranges_vary_it(
    run: Run, words: str, *, is_in_head: bool
) -> None:
    out = run(f"pull-off quartz 100nm {words}", terminal=True).out
    assert ("assumed: z0 = 400 pm (--z0)" in out) is is_in_head


@pytest.mark.parametrize("is_table", [True, False])
@pytest.mark.parametrize(
    ("line", "note"),
    [
        ("energies ice-warm 100nm --quantities U_grips,E_roll", "energy to roll by the angle: needs turn of sphere 1"),
        ("energies ice-warm 100nm,200nm --quantities U_grips,E_roll", "E_roll: needs turn of sphere 1"),
        ("pull-off ice-warm 5um --quantities P_c,F_men", "force of a water meniscus: needs relative humidity"),
    ],
)
def test_the_first_note_has_the_reason_for_a_missing_quantity_that_was_named(
    run: Run, line: str, note: str, *, is_table: bool
) -> None:
    lines = run(line, terminal=is_table).err.replace("\n  ", " ").splitlines()
    first = next(text for text in lines if text.startswith("note: ") and "best range" not in text)
    assert first.startswith(f"note: {note}")


def test_a_conflict_with_data_is_the_first_note_and_roughness_is_noted_for_1_um_or_more(run: Run) -> None:
    of_ice = run("pull-off ice-cold 1um").err.splitlines()
    assert of_ice[1].startswith("note: γ of ice-cold (R = 0.5 to 5 µm): in conflict with µm grains")
    assert of_ice[-1] == "more: --explain"
    of_table_1 = run("pull-off quartz 100nm --explain").out.splitlines()
    assert "note: γ of quartz: in air; in vacuum or baked take silica-dry (8 times the adhesion)" in of_table_1
    smooth = " (smooth glass, dry air), "
    shown = [smooth in run(f"pull-off quartz {radius}").err for radius in ("0.99um", "1um", "20um")]
    assert shown == [False, True, True]
    assert smooth not in run("r-min 20um").err


def test_eq_41_has_a_note_instead_of_a_row_unless_it_is_named(run: Run) -> None:
    call = "frequencies quartz 1um"
    assert "f_roll(41)" not in run(call, terminal=True, together=True).out
    found = re.search(r"^  note +([\d.]+) times too low", run(f"{call} --explain").out, re.MULTILINE)
    assert found
    values = {one["name"]: one["value"] for one in json.loads(run(f"{call} --json").out)["results"]}
    assert values["rolling_frequency"] == approx(float(found[1]) * values["rolling_frequency_as_printed"], rel=1e-5)
    by_name = "report quartz 1um --quantities rolling_frequency_as_printed"
    assert re.search(
        r"^rolling frequency as printed +f_roll\(41\) +\S+ +kHz", run(by_name, terminal=True).out, re.MULTILINE
    )


def test_sentences_have_the_units_of_the_table(run: Run) -> None:
    ran = run("energies ice-warm 100nm --to eV", terminal=True)
    assert "parting the spheres takes 420–1600 eV (say 810 eV) with fixed grips" in ran.out
    assert "best range of P_c: 14000–15000 pN (Maugis)" in run("pull-off quartz 100nm --to pN").err
