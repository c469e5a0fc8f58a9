"""Error bars in the cells of tables, and error bars of the materials that rows name."""

import csv
import math
from functools import partial
from pathlib import Path
from typing import Any

import pytest

from harness import Run
from jkroll import solve
from random_tables import read_rows, write_rows
from relative import approx

CELLS = ["25±5", "25+-5", "25(5)", "25±20%", "25+/-5 mJ/m2", "0.025 J/m2 ± 5 mJ/m2", "25 mJ/m2±20 %"]
SIDES = ["pull_off_force [N]", "pull_off_force_minus [N]", "pull_off_force_plus [N]"]
FORCE = 3 * math.pi * 0.025 * 50e-9  # Eq (1) for two spheres of 100 nm and 25 mJ/m²
close = partial(approx, rel=1e-12)
LEFT_OUT = "surface_energy: error bars are left out, as the table has no columns for them; --uncertainty adds these"


def written(rows: list[dict[str, Any]], end: str = "csv") -> str:
    """Write a table as grains.END, and return its name."""
    return write_rows(rows, f"grains.{end}")


def found(end: str = "csv") -> list[dict[str, Any]]:
    """Return the rows of out.END, with numbers as floats and None for empty cells."""
    return [{name: _read(cell) for name, cell in row.items()} for row in read_rows(f"out.{end}")]


def _read(cell: Any) -> Any:
    try:
        return float(cell)
    except (TypeError, ValueError):
        return cell or None


@pytest.mark.parametrize("end", ["csv", "tsv", "ndjson", "parquet"])
def test_error_bars_are_read_in_every_form_and_file_format(run: Run, end: str) -> None:
    rows = [{"radius [nm]": 100.0, "gamma [mJ/m2]": cell} for cell in [*CELLS, "25", "20 to 30", "25±20"]]
    ran = run(f"batch {written(rows, end)} -o out.{end} --quantities pull_off_force,r_min --quiet")
    assert (ran.code, ran.err) == (1, "jkroll: 1 of 10 rows failed; column status has the reasons\n")
    *standard, plain, of_range, refused = found(end)
    assert [*plain][2:7] == [*SIDES, "pull_off_force_low [N]", "pull_off_force_high [N]"]
    for row in standard:
        assert [row[name] for name in SIDES] == close([FORCE, FORCE / 5, FORCE / 5])
        assert row["pull_off_force_low [N]"] is row["r_min_minus [m]"] is row["status"] is None
    assert [plain[name] for name in SIDES] == [close(FORCE), None, None]
    ends = of_range["pull_off_force_low [N]"], of_range["pull_off_force_high [N]"]
    assert ends == close((0.8 * FORCE, 1.2 * FORCE))
    assert refused["status"] == "bad surface_energy"


def test_a_table_without_error_bars_in_its_first_rows_has_no_columns_for_error_bars(run: Run) -> None:
    """A later error bar is left out with a note; --uncertainty adds the columns."""
    rows = [{"radius [nm]": "100", "gamma [mJ/m2]": "25"}] * 200 + [{"radius [nm]": "100", "gamma [mJ/m2]": "25±5"}]
    words = f"batch {written(rows)} -o out.csv --quantities pull_off_force"
    ran = run(words)
    assert (ran.code, f"note: {LEFT_OUT}: row 201" in ran.err.splitlines()) == (0, True)
    assert [*found()[0]][2:] == ["pull_off_force [N]", "doubt", "status"]
    assert found()[-1]["pull_off_force [N]"] == close(FORCE)
    assert found()[-1]["status"] == "error bars left out"
    assert run(f"{words} --uncertainty").code == 0
    assert found()[-1]["pull_off_force_minus [N]"] == close(FORCE / 5)
    assert LEFT_OUT not in run("batch grains.csv -o out.csv --quantities r_min").err  # r_min does not depend on γ


def test_the_error_bar_of_an_option_applies_to_rows_with_an_empty_cell(run: Run) -> None:
    rows = [{"radius [nm]": "100", "gamma [mJ/m2]": cell} for cell in ("25", "")]
    assert (
        run("batch", written(rows), "-o", "out.csv", "--gamma", "25±5mJ/m2", "--quantities", "pull_off_force").code == 0
    )
    assert [row["pull_off_force_plus [N]"] for row in found()] == [None, close(FORCE / 5)]


def test_error_bars_of_materials_have_columns_only_if_a_material_in_the_first_rows_has_one(run: Run) -> None:
    rows = [{"radius [nm]": 100.0 + row, "material": "quartz"} for row in range(200)]
    rows += [{"radius [nm]": 100.0, "material": "ice-warm"}]
    words = "batch grains.csv -o out.csv --quantities pull_off_force"
    written(rows)
    ran = run(words)
    assert (ran.code, f"note: {LEFT_OUT}: row 201" in ran.err.splitlines()) == (0, True)
    assert found()[-1]["pull_off_force [N]"] == close(FORCE * 190 / 25)
    assert found()[-1]["status"] == "error bars left out"
    written(rows[::-1])
    assert run(words).code == 0
    assert found()[0]["pull_off_force_minus [N]"] == close(FORCE * 69 / 25)
    assert found()[1]["pull_off_force_minus [N]"] is None
    assert run("batch grains.csv -o out.csv --quantities contact_modulus").code == 0  # E and ν have ranges, not ±
    assert [*found()[0]][2:5] == ["contact_modulus [Pa]", "contact_modulus_low [Pa]", "contact_modulus_high [Pa]"]


def test_a_result_has_no_error_bar_if_an_end_of_an_input_gives_no_value(run: Run) -> None:
    rows = [{"radius [nm]": "100", "load [nN]": "-11±1"}, {"radius [nm]": "100", "load [nN]": "-5±1"}]
    ran = run("batch", written(rows), "-o", "out.csv", "--material", "quartz", "--quantities", "stiffness")
    assert ran.code == 0
    first, second = found()
    assert first["stiffness [N/m]"] is not None
    assert first["stiffness_minus [N/m]"] is None
    assert first["status"] == "no error bar"
    words = "stiffness: no uncertainty, as there is no value at some point within an input's uncertainty: load: -12 nN"
    assert words in ran.err.replace("\n  ", " ")
    assert second["stiffness_minus [N/m]"] is not None
    assert second["status"] is None


# --- Units of cells ---------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("head", "cells"),
    [
        ("gamma [mJ/m2],gamma_err", "25,0.005 J/m2"),
        ("gamma [mJ/m2],gamma_err", "25 mJ/m2,5"),
        ("gamma [mJ/m2],gamma_err [J/m2]", "25 mJ/m2,0.005"),
        ("gamma [mJ/m2],gamma_err [%]", "25,20 %"),
        ("gamma [mJ/m2],gamma_err [%]", "0.025 J/m2,20"),
        ("gamma [mJ/m2],gamma_minus,gamma_plus", "25,5,5"),
    ],
)
def test_a_unit_in_a_cell_does_not_apply_to_the_next_cell(run: Run, head: str, cells: str) -> None:
    Path("x.csv").write_text(f"radius [nm],{head}\n100,{cells}\n", encoding="utf-8")
    assert run("batch x.csv --quantities pull_off_force -o out.csv").code == 0
    (row,) = found()
    assert [row[side] for side in SIDES] == [close(FORCE), close(FORCE / 5), close(FORCE / 5)]


def test_the_ends_of_a_range_may_have_units_of_their_own_or_be_equal(run: Run) -> None:
    rows = ["20,0.03 J/m2", "25,25.0", "0.02 J/m2,30"]
    Path("x.csv").write_text(
        "\n".join(["radius [nm],gamma_min [mJ/m2],gamma_max [mJ/m2]", *("100," + row for row in rows), ""])
    )
    assert run("batch x.csv --quantities pull_off_force -o out.csv").code == 0
    assert [row["pull_off_force [N]"] for row in found()] == [close(FORCE)] * 3


def test_a_unit_on_only_one_of_two_sides_is_refused(run: Run) -> None:
    Path("x.csv").write_text(
        "radius [nm],gamma [mJ/m2],gamma_minus,gamma_plus\n100,25,0.005 J/m2,6\n", encoding="utf-8"
    )
    assert run("batch x.csv --quantities pull_off_force -o out.csv").code == 1
    assert found()[0]["status"] == "bad surface_energy"


@pytest.mark.parametrize("end", ["csv", "ndjson", "parquet"])
@pytest.mark.parametrize("others", [{}, {"radius_err [nm]": "10"}])
def test_a_result_has_no_error_bar_if_an_input_lacks_one_side_of_its_error_bar(
    run: Run, others: dict[str, str], end: str
) -> None:
    """A missing side does not count as 0, and an error bar from the other inputs alone would be too small."""
    bars = [("4", "6"), ("", "6"), ("4", " "), ("", ""), ("0", "6")]
    rows = [
        {"radius [nm]": "100", **others, "gamma [mJ/m2]": "25", "gamma_minus": minus, "gamma_plus": plus}
        for minus, plus in bars
    ]
    ran = run(f"batch {written(rows, end)} -o out.{end} --quantities pull_off_force --no-doubt")
    assert (ran.code, "one side of its error bar is missing" in ran.err.replace("\n  ", " ")) == (
        0,
        True,
    )
    of_radius = FORCE / 10 if others else 0.0
    both, no_minus, no_plus, neither, zero = found(end)
    assert [row["pull_off_force [N]"] for row in found(end)] == close([FORCE] * 5)
    sides = [math.hypot(of_radius, part / 25 * FORCE) for part in (4, 6)]
    assert [both[name] for name in SIDES[1:]] == close(sides)
    for row in (no_minus, no_plus):
        assert [row[name] for name in SIDES[1:]] == [None, None]
        assert row["status"] == "half an error bar"
    assert [neither[name] for name in SIDES[1:]] == (close([of_radius] * 2) if others else [None, None])
    assert zero["pull_off_force_plus [N]"] == close(sides[1])
    assert both["status"] is neither["status"] is zero["status"] is None


@pytest.mark.parametrize("cells", ["25,nan", "25,N/A", "nan,5", "NaN,nan"])
def test_a_value_or_an_error_bar_that_is_not_a_number_is_reported(run: Run, cells: str) -> None:
    Path("x.csv").write_text(f"radius [nm],gamma [mJ/m2],gamma_err\n100,25,5\n100,{cells}\n", encoding="utf-8")
    ran = run("batch x.csv --quantities pull_off_force -o out.csv")
    text = next(cell for cell in cells.split(",") if not cell.isdigit())
    said = f"surface_energy: '{text}' "
    assert (ran.code, said in ran.err, found()[1]["status"]) == (1, True, "bad surface_energy")


@pytest.mark.parametrize(
    ("head", "cells", "force"),
    [
        ("gamma [mJ/m2],gamma_err", "25, ", FORCE),
        ("gamma [mJ/m2],gamma_err", " ,5", None),
        ("gamma_low [mJ/m2],gamma_high [mJ/m2]", "25, ", None),
    ],
)
def test_a_cell_of_blanks_is_empty(run: Run, head: str, cells: str, force: float | None) -> None:
    """A value with a blank error bar is kept. An error bar without a value, or a range without an end, fails.

    The material does not replace the value.
    """
    Path("x.csv").write_text(f"radius [nm],{head}\n100,25,25\n100,{cells}\n", encoding="utf-8")
    run("batch x.csv --material iron --quantities pull_off_force -o out.csv")
    assert found()[1]["pull_off_force [N]"] == (force and close(force))
    assert found()[1]["status"] == (None if force else "bad surface_energy")


@pytest.mark.parametrize(
    "text",
    [
        "radius [nm],gamma [mJ/m2],SD (nm),SD (mJ/m2)\n100,25,10,5",
        "radius [nm],n,SD (nm),gamma [mJ/m2],SD\n100,3,10,25,5",
        "radius [nm],s.d.,gamma [mJ/m2],S.D.\n100,10,25,5",
        "radius [nm],Stabw.,gamma [mJ/m2],STABW.S\n100,10,25,5",
        "radius [nm],Desv. est.,gamma [mJ/m2],dev. st.\n100,10,25,5",
        "radius [nm],Desviación estándar (nm),gamma [mJ/m2],Deviazione standard\n100,10,25,5",
        "radius [nm],,gamma [mJ/m2],\n100,±10,25,+/- 5",
        "radius,,gamma,\nnm,± nm,mJ/m2,±\n100,10,25,5",
        "radius,Unnamed: 1,gamma,Unnamed: 3\nnm,± nm,mJ/m2,±\n100,10,25,5",
        "radius,Unnamed: 1,SD,gamma,±\nnm,nm,nm,mJ/m2,\n100,7,10,25,5",
    ],
)
def test_an_uncertainty_without_a_name_belongs_to_the_adjacent_column_or_to_that_with_its_unit(
    run: Run, text: str
) -> None:
    Path("x.csv").write_text(f"{text}\n", encoding="utf-8")
    run("batch x.csv --quantities pull_off_force -o out.csv")
    *_, row = found()
    assert [row[side] for side in SIDES] == [close(FORCE), *[close(FORCE * math.hypot(0.1, 0.2))] * 2]


@pytest.mark.parametrize(
    ("text", "way"),
    [
        ("radius [nm],gamma [mJ/m2],n,SD\n100,25,5,10", "SD=surface_energy_err [mJ/m2]"),
        ("radius [nm],N,SD,gamma [mJ/m2]\n100,5,10,25", "SD=radius_err [nm]"),
        ("n,SD,radius [nm],gamma [mJ/m2]\n5,10,100,25", "SD=radius_err [nm]"),
        ("radius [nm],gamma [mJ/m2],note,SD\n100,25,a,10", "SD=surface_energy_err [mJ/m2]"),
        ("height (nm),radius [nm],gamma [mJ/m2],SD (nm)\n5,100,25,10", "SD (nm)=radius_err [nm]"),
        ("radius [nm],radius2 [nm],gamma [mJ/m2],SD (um)\n9,9,25,1", "SD (um)=radius2_err [um]"),
        ("radius [nm],gamma [mJ/m2],2*SD gamma\n9,25,1", "2*SD gamma="),
    ],
)
def test_an_uncertainty_that_may_belong_to_several_columns_is_refused(run: Run, text: str, way: str) -> None:
    Path("x.csv").write_text(f"{text}\n", encoding="utf-8")
    ran = run("batch x.csv --quantities pull_off_force -o out.csv")
    said = " ".join(ran.err.split())
    assert (ran.code, f"--column '{way}'" in said, "it may be an uncertainty of " in said) == (2, True, True)


@pytest.mark.parametrize("head", ["hardness (GPa),SD", "height (nm),SD (nm)", "n,note", "E [GPa],rho [g/cm3],σ [MPa]"])
def test_an_uncertainty_of_a_column_that_is_not_read_passes_through(run: Run, head: str) -> None:
    cells = ",".join("1" * len(head.split(",")))
    Path("x.csv").write_text(f"radius [nm],gamma [mJ/m2],{head}\n100,25,{cells}\n", encoding="utf-8")
    assert run("batch x.csv --quantities pull_off_force -o out.csv").code == 0
    assert [*found()[0]][-3:] == ["pull_off_force [N]", "doubt", "status"]


def test_per_cent_in_a_header_applies_to_all_forms_of_cells(run: Run) -> None:
    """Padded cells, cells with an error bar and columns of error bars are each read by separate code."""
    cells = ["40", "40 ", "40±5", "40+-5", "(40±5)", "40(5)", "35 to 45", "40 %", "0.4 "]
    head = "material,radius [nm],filling_factor [%]"
    Path("x.csv").write_text("\n".join([head, *(f"quartz,100,{cell}" for cell in cells), ""]), encoding="utf-8")
    assert run("batch x.csv --quantities tensile_strength --uncertainty -o out.csv").code == 0
    strengths = [row["tensile_strength [Pa]"] for row in found()]
    expected = solve("tensile_strength", material="quartz", radius=1e-7, filling_factor=0.4)
    assert strengths[:8] == [close(expected)] * 8
    assert strengths[8] < expected / 1e3
    Path("y.csv").write_text(f"{head},filling_factor_err\nquartz,100,40,5\n", encoding="utf-8")
    assert run("batch y.csv --quantities tensile_strength -o out.csv").code == 0
    assert found()[0]["tensile_strength [Pa]"] == close(expected)


def test_a_hamaker_constant_replaces_the_surface_energy_and_its_error_bar(run: Run) -> None:
    """Only results that depend on the surface energy itself have its error bar."""
    ran = run("pull-off ice-warm 1um --hamaker 6.5e-20J --quantities surface_energy2,pull_off_force --quiet")
    assert [line.split()[0] for line in ran.out.splitlines()] == [
        "surface_energy2",
        "surface_energy2_minus",
        "surface_energy2_plus",
        "pull_off_force",
    ]


def test_a_row_with_ranges_and_standard_uncertainties_has_ranges(run: Run) -> None:
    """The γ of the material has ± 20 %, and its ξ a range from 1.8 to 2.6 nm: the force is proportional to γξ."""
    Path("own.toml").write_text(
        '[materials.own]\nsurface_energy = { value = "25±5 mJ/m2" }\n'
        'yield_displacement = { value = "1.8 to 2.6 nm", radius = "0.95 um" }\n',
        encoding="utf-8",
    )
    Path("x.csv").write_text("material,radius [nm]\nown,950\nquartz,100\n", encoding="utf-8")
    run("batch x.csv -o out.csv --materials own.toml --quantities yield_force,pull_off_force")
    first, second = csv.DictReader(Path("out.csv").read_text(encoding="utf-8").splitlines())
    ends = [float(first[f"yield_force_{side} [N]"]) / float(first["yield_force [N]"]) for side in ("low", "high")]
    assert ends == approx([1.8 / 2.2 * 0.8, 2.6 / 2.2 * 1.2])
    assert not any(
        second[f"{name}_{side} [N]"] for name in ("yield_force", "pull_off_force") for side in ("low", "high")
    )


def test_the_displacement_of_a_material_is_not_assumed(run: Run) -> None:
    """The rows name the material, and no option does."""
    Path("own.toml").write_text(
        '[materials.own]\nsurface_energy = { value = "25 mJ/m2" }\n'
        'yield_displacement = { value = "2 nm", radius = "0.95 um" }\n',
        encoding="utf-8",
    )
    words = "batch x.csv -o out.csv --materials own.toml --quantities yield_force --no-doubt"
    for name, is_assumed in {"own": False, "quartz": True}.items():
        Path("x.csv").write_text(f"material,radius [nm]\n{name},950\n", encoding="utf-8")
        assert ("ξ = 200 pm" in run(words).err) == is_assumed


def test_a_list_has_only_the_error_bar_columns_that_its_rows_need(run: Run) -> None:
    """Warm ice has a γ with ±, and an E and ν with ranges. In the second list, only one row has a range, of E."""
    asked = ["--quantities", "contact_modulus,pull_off_force", "--csv"]
    head = run("report", "ice-warm", "100nm,1um", *asked).out.partition("\n")[0]
    assert "pull_off_force_low [N],pull_off_force_high [N]" in head
    assert "_minus" not in head
    mixed = run("report", "quartz", "100nm,1um", "--gamma", "25±5mJ/m2,25mJ/m2", "--young", "50 to 60 GPa", *asked)
    assert mixed.code == 0
    assert "contact_modulus_low [Pa],contact_modulus_high [Pa]" in mixed.out
