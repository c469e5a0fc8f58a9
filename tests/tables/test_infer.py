"""`batch --infer`: each row of measured values gets the input that `infer` finds."""

import csv
import math
from pathlib import Path
from random import Random
from typing import Any

import pytest

from harness import Run
from jkroll import infer
from random_tables import ENDS, read_rows, write_rows
from relative import approx

HEAD = ["probe", "R1 (um)", "P_c (nN)", "P_c_err (nN)"]
WORDS = "--infer gamma --measured pull_off_force --radius2 plane --material quartz"


def table(rows: list[list[str]]) -> str:
    """Write a table, and return the name of its file."""
    return write_rows([dict(zip(HEAD, row, strict=True)) for row in rows], "forces.csv")


def results(name: str) -> list[dict[str, str]]:
    """Return the rows of a file as texts, with "" for null."""
    return [{key: "" if cell is None else str(cell) for key, cell in row.items()} for row in read_rows(name)]


def test_a_row_without_an_inferred_value_has_a_reason(run: Run) -> None:
    rows = [
        ["a", "2", "300", ""],
        ["b", "", "300", ""],
        ["c", "2", "", ""],
        ["d", "2", "-3", ""],
        ["e", "2", "250", ""],
    ]
    ran = run(f"batch {table(rows)} -o out.csv {WORDS}")
    assert ran.code == 1
    first, *bad, last = results("out.csv")
    assert [row["surface_energy [J/m^2]"] for row in bad] == ["", "", ""]
    assert [row["status"] for row in bad] == ["needs radius", "no measured value", "bad pull_off_force"]
    low, high = float(last["surface_energy [J/m^2]"]), float(first["surface_energy [J/m^2]"])
    assert "2 of 5 rows; median 14.5892 mJ/m²" in ran.err.replace("\n  ", " ")
    assert (low + high) / 2 == approx(14.5892e-3, rel=1e-5)


MATERIALS = ["quartz", "iron", "ice-warm", "polystyrene", "silica-dry", "gold"]
# The input to infer and the measured quantity: the unit, and the powers of ten between which the values lie.
PROBLEMS = {
    ("surface_energy", "pull_off_force"): ("nN", 0, 4), ("surface_energy", "contact_radius"): ("nm", 0, 2),
    ("surface_energy", "yield_force"): ("pN", 0, 4), ("youngs_modulus", "stiffness"): ("N/m", 1, 3),
    ("youngs_modulus", "contact_radius"): ("nm", 0, 2), ("radius", "pull_off_force"): ("nN", 0, 4),
    ("load", "contact_radius_at_load"): ("nm", 0.3, 2), ("load", "approach_at_load"): ("nm", -1.5, 0.5),
    ("yield_displacement", "yield_force"): ("pN", 0, 4), ("density", "vertical_frequency"): ("MHz", 1, 3.5),
    ("work_of_adhesion", "pull_off_force"): ("nN", 0, 4), ("radius2", "pull_off_force"): ("nN", 0, 4),
}  # fmt: skip
OPTIONS = {"material2": "--material2 {}", "radius2 [nm]": "--radius2 {}", "load [nN]": "--load={}nN"}


@pytest.mark.slow
def test_each_row_of_a_random_table_gets_the_results_of_infer(run: Run) -> None:
    """Values, uncertainties and doubts agree for materials of either sphere, planes, loads, laws and error bars."""
    count = 150
    random = Random(count)
    compared = 0
    for _ in range(count):
        (name, quantity), (unit, *decades) = random.choice([*PROBLEMS.items()])
        columns = {
            "material": lambda: random.choice(MATERIALS),
            "R1 [nm]": lambda: f"{10 ** random.uniform(1, 3.5):.4g}",
            "material2": lambda: random.choice([*MATERIALS, ""]),
            "radius2 [nm]": lambda: random.choice(["", "plane", "300"]),
            "load [nN]": lambda: f"{random.uniform(-5, 50):.4g}",
        }
        used = []
        for position, head in enumerate(columns):
            is_inferred = head.startswith(f"{name} ") or (name, head) == ("radius", "R1 [nm]")
            if not is_inferred and (position < 2 or random.random() < 0.4):
                used.append(head)
        rows = [{head: columns[head]() for head in used} for _ in range(4)]
        measured = [f"{10 ** random.uniform(*decades):.5g}" for _ in rows]
        bars = [f"{0.08 * float(value):.3g}" for value in measured] if random.random() < 0.3 else [""] * len(rows)
        law = random.choice(["", "", "--model maugis", "--model dmt"])
        heads = [*used, f"{quantity} [{unit}]", "±"]
        cells = [[*row.values(), *both] for row, *both in zip(rows, measured, bars, strict=True)]
        end = random.choice(ENDS)
        path = write_rows([dict(zip(heads, line, strict=True)) for line in cells], f"random.{end}")
        if run(f"batch {path} -o out.{end} --infer {name} --measured {quantity} {law}").code == 2:
            continue  # the whole table is refused
        for row, value, bar, found in zip(rows, measured, bars, results(f"out.{end}"), strict=True):
            words = ["infer", name, row["material"], *([f"{row['R1 [nm]']}nm"] if "R1 [nm]" in row else [])]
            for head, option in OPTIONS.items():
                if row.get(head):
                    words += option.format(f"{row[head]}nm" if row[head] == "300" else row[head]).split()
            words += ["--measured", f"{quantity}={value}{bar and '±'}{bar}{unit}", *law.split(), "--csv"]
            single = next(csv.DictReader(run(*words).out.splitlines()), {})
            value_head = next(head for head in found if head.startswith(f"{name} ["))
            for head in [head for head in found if head.startswith(name) and head not in row] + ["doubt"]:
                cell, single_cell = found[head], single.get(head, "")
                if head != "doubt" and cell and single_cell:
                    assert float(cell) == approx(float(single_cell), rel=1e-9), words
                    compared += 1
                elif head != "doubt" or found[value_head]:
                    assert cell == single_cell, words
    assert compared > 2 * count


def test_option_column_gives_the_measured_column_of_many_files(run: Run) -> None:
    Path("runs").mkdir()
    for name, force in (("a", 200), ("b", 300), ("c", 400)):
        Path(f"runs/{name}.csv").write_text(f"R1 (um),F [nN]\n2,{force}\n", encoding="utf-8")
    assert "no column has the measured pull_off_force" in run(f"batch runs/a.csv -o out.csv {WORDS}").err.replace(
        "\n  ", " "
    )
    ran = run("batch", "runs/*.csv", "-o", "out/", *WORDS.split(), "--column", "F [nN]=pull_off_force [nN]")
    assert (ran.code, "surface_energy by JKR: 3 of 3 rows; median 15.9155 mJ/m²" in ran.err) == (0, True), ran.err


def test_columns_with_units_of_the_measured_quantity_are_offered(run: Run) -> None:
    path = write_rows([{"R1 (um)": "2", "adhesion force (pN)": "200", "z [nm]": "3"}], "forces.csv")
    said = run(f"batch {path} -o out.csv {WORDS}").err.replace("\n  ", " ")
    offer = "write --column 'adhesion force (pN)=pull_off_force [pN]'"
    assert said == f"jkroll: header: no column has the measured pull_off_force; {offer}\n"
    ran = run("batch", path, "-o", "out.csv", *WORDS.split(), "--column", "adhesion force (pN)=pull_off_force [pN]")
    assert ran.code == 0
    path = write_rows([{"R1 (um)": "2", "z [nm]": "3"}], "forces.csv")
    assert "(the table has" in run(f"batch {path} -o out.csv {WORDS}").err.replace("\n  ", " ")


@pytest.mark.parametrize(
    ("words", "message"),
    [
        ("--infer gamma", "batch infers one input from one quantity"),
        ("--measured pull_off_force", "batch infers one input from one quantity"),
        ("--infer gamma --measured pull_off_force=3nN", "did you mean pull_off_force?"),
        ("--infer gamma --measured pull_off_force --quantities r_min", "exclude each other"),
        ("--infer sigma --measured pull_off_force", "sigma"),
        ("--infer gamma --measured pull_of_force", "pull_off_force"),
        ("--infer gamma --measured pull_off_force --gamma 25mJ/m2", "surface_energy"),
        ("--infer density --measured pull_off_force", "density"),
        ("--infer gamma --measured contact_radius", "no column has the measured contact_radius"),
    ],
)
def test_an_impossible_inference_is_refused(run: Run, words: str, message: str) -> None:
    name = table([["a", "2", "300", ""]])
    ran = run(f"batch {name} -o out.csv --radius2 plane {words}")
    assert (ran.code, message in ran.err.replace("\n  ", " ")) == (2, True), ran.err
    assert not Path("out.csv").exists()


@pytest.mark.parametrize("order", [("R1 (um)", "load (nN)", "delta (nm)"), ("delta (nm)", "R1 (um)", "load (nN)")])
def test_a_measured_approach_goes_with_a_load(run: Run, order: tuple[str, ...]) -> None:
    cells = {"R1 (um)": "1", "load (nN)": "100", "delta (nm)": "2"}
    Path("x.csv").write_text(f"{','.join(order)}\n{','.join(cells[head] for head in order)}\n", encoding="utf-8")
    sphere: dict[str, Any] = {"surface_energy": 0.02, "poisson_ratio": 0.3, "radius2": math.inf}
    words = "--infer young --measured approach_at_load --gamma 20mJ/m2 --poisson 0.3 --radius2 plane"
    assert run(f"batch x.csv {words} -o out.csv").code == 0
    expected = infer("youngs_modulus", measured={"approach_at_load": 2e-9}, radius=1e-6, load=1e-7, **sphere)
    assert float(results("out.csv")[0]["youngs_modulus [Pa]"]) == approx(expected, rel=1e-12)


@pytest.mark.parametrize("names", [["A", "B"], ["ice", "B"], ["quartz", "B"]])
def test_names_of_samples_are_labels_if_no_property_is_needed(run: Run, names: list[str]) -> None:
    """Some names are also materials. γ of two equal spheres depends on no other property."""
    rows = "".join(f"{name},1,200\n" for name in names)
    Path("named.csv").write_text(f"material,R1 (um),P_c (nN)\n{rows}", encoding="utf-8")
    ran = run("batch named.csv -o out.csv --infer gamma --measured pull_off_force")
    assert ran.code == 0, ran.err
    found = [float(row["surface_energy [J/m^2]"]) for row in results("out.csv")]
    assert found == approx([2e-7 / (1.5 * math.pi * 1e-6)] * 2)


# --- Rows of statistics -----------------------------------------------------------------------------------------------

DATA = [["a", "2", "300", ""], ["b", "2", "310", ""], ["c", "2", "320", ""]]
# γ = P_c/(3πR) of spheres of 2 µm on a plane, from three forces with a median of 310 nN and a scatter of 10 nN.
SUMMARY = "surface_energy by JKR: 3 of {} rows; median 16.446 mJ/m², "
SCATTER = "; mean 16.446 mJ/m², scatter 530.516 µJ/m²"


LABELS = [
    ["Mean", "SD", "N"],
    ["N", "Average:", "St. dev. (n-1)"],
    ["mean ± SD"],
    ["Median"],
    ["count", "mean", "std", "min", "25%", "50%", "75%", "max"],
    ["", "Total", "Mittelwert", "Standardabweichung"],
    ["Minimum", "25% Percentile", "Std. Deviation", "Std. Error of Mean", "Lower 95% CI of mean", "N total"],
    ["Mean", "Geo. factor", "Skewness"],
    *map(str.split, ["Std", "STABW.S", "SD=0.7", "Mean σ s CI95 CV%", "Среднее", "平均 标准差"]),
    *map(str.splitlines, ["Overall mean\nSD of 5", "Standard dev.\nMode", "Uncertainty\nRSD %", "Écart-type"]),
    *map(str.splitlines, ["Media\nDesviación estándar", "Deviazione standard", "Odchylenie standardowe\nSuma"]),
    "Mean,Standard Error,Median,Mode,Standard Deviation,Sample Variance,Kurtosis,Range,Sum,Count".split(","),
    "Mittelwert,Standardfehler,Modus,Stichprobenvarianz,Schiefe,Wertebereich,Summe,Anzahl".split(","),
]


@pytest.mark.parametrize(
    ("labels", "end"), [*((labels, "csv") for labels in LABELS), *((LABELS[0], end) for end in ENDS if end != "csv")]
)
def test_rows_of_statistics_are_not_data(run: Run, labels: list[str], end: str) -> None:
    """Such rows have the status "row of statistics", and the summary leaves them out."""
    rows = [*DATA, *([label, "2", "50", ""] for label in labels if label)]
    path = write_rows([dict(zip(HEAD, row, strict=True)) for row in rows], f"forces.{end}")
    ran = run(f"batch {path} -o out.{end} {WORDS}")
    said = ran.err.replace("\n  ", " ")
    assert (ran.code, SUMMARY.format(len(rows)) in said, SCATTER in said) == (1, True, True)
    cells = [(row["surface_energy [J/m^2]"], row["status"]) for row in results(f"out.{end}")]
    assert [float(value) for value, _ in cells[:3]] == approx(
        [force * 1e-9 / (3 * math.pi * 2e-6) for force in (300, 310, 320)]
    )
    assert cells[3:] == [("", "row of statistics")] * (len(rows) - 3)


def test_a_row_whose_label_need_not_be_a_statistic_is_data(run: Run) -> None:
    """N is a statistic only next to other statistics.

    Rows are data if all have labels of statistics, or if `--column probe=` passes the labels through.
    """
    force, other = 300e-9 / (3 * math.pi * 2e-6), 320e-9 / (3 * math.pi * 2e-6)
    cases = {
        ("Y", "N"): "",
        ("mean", "mean"): "",
        ("a", "mean"): "--column probe=",
        ("min", "max"): "",
        ("Se", "CV"): "",
        ("Sample 5", "σ"): "",
        ("mean grain", "standard 1"): "",
    }
    for labels, option in cases.items():
        path = table([[labels[0], "2", "300", ""], [labels[1], "2", "320", ""]])
        assert run(f"batch {path} -o out.csv {WORDS} {option}").code == 0
        assert [float(row["surface_energy [J/m^2]"]) for row in results("out.csv")] == approx([force, other])


def test_a_row_between_the_statistics_of_two_groups_is_data(run: Run) -> None:
    """A single row between two statistics is one of them, unless a statistic repeats below it."""
    labels = ["a", "Mean", "SD", "b", "Mean", "SD"]
    run(f"batch {table([[label, '2', '300', ''] for label in labels])} -o out.csv {WORDS}")
    statistics = ["row of statistics"] * 2
    assert [row["status"] for row in results("out.csv")] == ["", *statistics, "", *statistics]


def test_a_standard_deviation_is_not_a_contact_in_a_table_without_measured_values(run: Run) -> None:
    """A row labelled Mean is data if no SD follows: it may be the mean radius of a size class."""
    for labels, status in ((["Mean"], [""]), (["Mean", "SD", "N"], ["row of statistics"] * 3)):
        rows = [{"grain": name, "radius [nm]": "100"} for name in ["a", "b", *labels]]
        write_rows(rows, "grains.csv")
        run("batch grains.csv -o out.csv --material quartz --quantities pull_off_force --no-doubt")
        assert [row["status"] for row in results("out.csv")] == ["", "", *status]
        assert [bool(row["pull_off_force [N]"]) for row in results("out.csv")][2:] == [not text for text in status]


def test_a_column_of_materials_may_have_labels_of_statistics(run: Run) -> None:
    write_rows([{"material": name, "radius [nm]": "100"} for name in ("quartz", "Mean", "SD")], "grains.csv")
    assert run("batch grains.csv -o out.csv --gamma 25mJ/m2 --quantities pull_off_force --no-doubt").code == 1
    assert [row["status"] for row in results("out.csv")] == ["", *["row of statistics"] * 2]


@pytest.mark.parametrize(("mark", "radius"), [(",", "900,0"), (".", "900.0"), ("", "900")])
def test_marks_in_labels_do_not_decide_which_mark_is_decimal(run: Run, mark: str, radius: str) -> None:
    """A column that passes through is searched for statistics, not for decimal marks."""
    text = f"probe;R1 (um);note\n1.234;{radius};1,2.3\nb.2;{radius};\nSD;{radius};\n"
    Path("grains.csv").write_text(text, encoding="utf-8")
    run("batch grains.csv -o out.csv --delimiter semicolon --material quartz --quantities pull_off_force --no-doubt")
    lines = [line.split(";") for line in Path("out.csv").read_text(encoding="utf-8").splitlines()]
    assert [line[-1] for line in lines] == ["status", "", "", "row of statistics"]
    forces = [float(line[3].replace(",", ".")) for line in lines[1:3]]
    assert ("," in lines[1][3]) == (mark == ",")
    assert forces == approx([3 * math.pi * 0.025 * 450e-6] * 2)
