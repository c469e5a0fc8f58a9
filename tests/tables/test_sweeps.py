"""Sweeps: the few rows computed as floats and the many computed as arrays are the same, in each format."""

import csv
import gzip
import json
import math
import re
import shlex
from pathlib import Path
from unittest.mock import patch

import pytest

from harness import Ran, Run
from jkroll.model import sweep as sweeps
from jkroll.model.plan import formula_of
from jkroll.quantities.formatting import Format
from jkroll.quantities.nomenclature import NOMENCLATURE
from jkroll.report.questions import QUESTIONS
from jkroll.text import spelled
from random_tables import read_rows
from relative import approx

INFERENCES = [
    "infer gamma quartz,gold 2um --radius2 plane,1um --measured pull_off_force=300nN,3N,1nN:1uN:4",
    "infer gamma quartz 2um±50nm --radius2 plane --measured pull_off_force=300±20nN,310nN,3N --model jkr,maugis",
    "infer work-of-adhesion 1um --young 54GPa --poisson 0.17 --measured contact_radius=10nm:30nm:3 --model jkr,dmt",
    "infer radius quartz --load 50nN --measured approach_at_load=200pm,300pm,3nm",
    "infer radius quartz,ice-warm --measured 'pull_off_force=280 to 320nN,300nN'",
    "infer load quartz 1um --measured contact_radius_at_load=1nm,10nm,20nm --model jkr,maugis,dmt",
    "infer young ice-warm,quartz 100nm --load -1nN,1N --measured contact_radius_at_load=2nm",
    "infer young quartz 100nm --measured pull_off_force=10nN,20nN",
    "infer xi quartz,ice-warm 0.95um --measured yield_force=1.21±0.36nN --model jkr,maugis",
    "infer adhesion-hysteresis quartz 1um --measured yield_force=0.1nN:1nN:3 --material2 quartz,iron",
    "infer gamma 1um,2um --gamma2 25±5mJ/m2,30mJ/m2 --measured pull_off_force=200nN",
    "infer gamma quartz 1um --measured n_roll=3.0,4.0 --energy 1aJ:1fJ:2",
    "infer gamma 1um --young rigid,54GPa --poisson 0.17 --measured contact_radius=30nm,40nm",
]


def table(text: str) -> list[list[str]]:
    """Return the cells of a CSV table."""
    return list(csv.reader(text.splitlines()))


def by(way: str, patch: pytest.MonkeyPatch) -> None:
    """Have rows computed as floats or as arrays, whatever their number."""
    for kind in ("COMPUTED", "SEARCHED"):
        few = {"floats": 10**9, "arrays": -1}[way]
        patch.setattr(sweeps, kind, getattr(sweeps, kind)._replace(few=few))


def in_both_ways(run: Run, monkeypatch: pytest.MonkeyPatch, *words: str) -> list[Ran]:
    """Run a command whose rows are computed as floats, and again with rows computed as arrays."""
    found = []
    for way in ("floats", "arrays"):
        with monkeypatch.context() as patch:
            by(way, patch)
            found.append(run(*words))
    return found


@pytest.mark.parametrize("sweep", INFERENCES)
def test_inferred_rows_computed_as_floats_and_as_arrays_are_the_same(
    run: Run, monkeypatch: pytest.MonkeyPatch, sweep: str
) -> None:
    """Numbers agree to within rounding; gaps, doubts, reasons and notes are equal."""
    floats, arrays = in_both_ways(run, monkeypatch, *shlex.split(sweep), "--csv")
    assert (arrays.code, arrays.err) == (floats.code, floats.err)
    header, *rows = table(floats.out)
    assert header[-2:] == ["doubt", "status"]
    other_header, *others = table(arrays.out)
    assert other_header == header
    close = 8e-15 if "maugis" in sweep else 4e-16
    for row, other in zip(rows, others, strict=True):
        values = dict(zip(header, row, strict=True))
        for name, cell, other_cell in zip(header, row, other, strict=True):
            value_name = re.sub("_(minus|plus)", "", name)  # a side is the difference of two values
            rounding = 0.0 if value_name == name else 16 * math.ulp(float(values[value_name] or 0))
            try:
                assert float(cell) == approx(float(other_cell), rel=close, abs=rounding), name
            except ValueError:
                assert cell == other_cell, name


@pytest.mark.parametrize(("form", "way"), [("", "floats"), ("", "arrays"), ("--to nN --digits 4 --no-doubt", "arrays")])
def test_a_written_file_has_the_same_bytes_as_the_printed_rows(
    run: Run, monkeypatch: pytest.MonkeyPatch, form: str, way: str
) -> None:
    by(way, monkeypatch)
    words = f"yield-force quartz,ice-warm 1nm:1um:7 --load -2nN:2nN:3:lin {form}".split()
    shown = run(*words, "--csv")
    written = run(*words, "-o", "out.csv")
    assert (written.code, written.out, written.err) == (shown.code, "", shown.err)
    assert Path("out.csv").read_text(encoding="utf-8") == shown.out
    assert run(*words, "-o", "out.csv.gz").code == shown.code
    assert gzip.decompress(Path("out.csv.gz").read_bytes()).decode() == shown.out


@pytest.mark.parametrize("options", [[], ["--bare"], ["--digits", "5", "--to", "pN"]])
def test_a_number_has_one_spelling(run: Run, monkeypatch: pytest.MonkeyPatch, options: list[str]) -> None:
    """Floats and arrays give the same text, which is read back as the same double."""
    words = ["pull-off", "quartz", "1e-15m,1e-9m,20nm,50nm,1e5m,3e15m", "--quiet", *options]
    out = {ran.out for ran in in_both_ways(run, monkeypatch, *words)}
    cells = {cell for text in out for line in text.splitlines()[1:] for cell in re.split("[\t,]", line)}
    numbers = [cell for cell in cells if re.fullmatch("[-+.0-9e]+", cell)]
    assert len(numbers) >= 5
    assert [number for number in numbers if spelled(float(number)) != number] == []
    assert len(out) == 1


@pytest.mark.parametrize("options", ["", "--angle 10deg", "--model maugis,dmt", "--load 1nN --radius2 200nm,plane"])
def test_each_quantity_requested_by_name_has_a_column(run: Run, monkeypatch: pytest.MonkeyPatch, options: str) -> None:
    named = [name for name, quantity in NOMENCLATURE.items() if quantity.unit and formula_of(name) is not None]
    given = ["load", "rolling_angle"]
    words = [*f"report quartz 100nm,200nm {options} --quantities".split(), ",".join({*named}.difference(given))]
    for ran in in_both_ways(run, monkeypatch, *words, "--csv"):
        assert ran.code == 0
        header, *rows = table(ran.out)
        assert "yield_force_fixed_load [N]" in header
        for row in rows:
            empty = {name for name, cell in zip(header, row, strict=True) if not cell}
            shown = {"n_roll_after_impact", "yield_force_fixed_load [N]", "roll_energy_quarter_turn [J]"}
            assert not empty & (shown | {"pull_off_force_lennard_jones [N]"})
            assert ("rolling_frequency_as_printed [Hz]" in empty) is ("sphere 2 differs" in row[-1])


def test_each_value_of_many_rows_is_rounded_once(run: Run, monkeypatch: pytest.MonkeyPatch) -> None:
    """Otherwise the time would grow as the square of the number of rows that are written together."""
    by("arrays", monkeypatch)
    with patch.object(Format, "number", autospec=True, side_effect=Format.number) as number:
        _, *rows = table(run("pull-off quartz 1nm:1um:1000 --csv --digits 3 --quantities pull_off_force").out)
    assert (len(rows), number.call_count) == (1000, 1000)
    assert {len(row[4].partition("e")[0].replace(".", "")) for row in rows} <= {1, 2, 3}


@pytest.mark.parametrize("line", ["pull-off quartz 100nm", "frequencies quartz,gold 100nm 1um --to MHz --digits 3"])
def test_a_file_of_json_equals_the_printed_json(run: Run, line: str) -> None:
    printed = run(f"{line} --json")
    for words in (f"{line} -o x.json", f"{line} --json -o X.JSON"):
        assert run(words) == (printed.code, "", printed.err)
    assert Path("x.json").read_bytes().decode() == Path("X.JSON").read_bytes().decode() == printed.out


def test_options_of_other_outputs_are_refused_with_a_file_of_json(run: Run) -> None:
    for option in ("--csv", "--bare", "--cite"):
        assert (
            run(f"pull-off quartz 100nm -o x.json {option}").err
            == f"jkroll: -o 'x.json' and {option} exclude each other; redirect the output: > FILE\n"
        )
    assert run("pull-off quartz 100nm -o x.json --resume").code == 2
    assert run("pull-off quartz 1nm:1um:2000000 -o x.json").code == 2
    assert run("contact quartz 100nm --load=-1N -o x.json").code == 1
    assert not Path("x.json").exists()


@pytest.mark.parametrize("end", ["svg", "pdf", "png", "jpg", "svgz", "ps", "bmp"])
def test_rows_are_not_written_under_the_name_of_a_picture(run: Run, end: str) -> None:
    Path("grains.csv").write_text("radius [nm]\n100\n", encoding="utf-8")
    for line in ("pull-off quartz 100nm,200nm", "batch grains.csv --material quartz"):
        assert run(f"{line} -o rows.{end}").code == 2
        assert not Path(f"rows.{end}").exists()


def test_options_of_other_outputs_are_refused_with_a_file_of_rows(run: Run) -> None:
    for form in ("json", "bare", "explain", "cite"):
        message = f"jkroll: -o 'x.csv' and --{form} exclude each other; redirect the output: > FILE\n"
        assert run(f"pull-off quartz 1nm:1um:3 -o x.csv --{form}") == (2, "", message)
    too_many = "jkroll: --json writes at most 1000000 pairs, not 2000000; --csv writes any number\n"
    assert run("pull-off quartz 1nm:1um:2000000 --json") == (2, "", too_many)
    assert run("pull-off quartz 1nm:1um:3 -o x.csv --resume").code == 2
    assert [*Path().iterdir()] == []


@pytest.mark.parametrize(
    ("line", "head"),
    [
        ("pull-off quartz,iron", "2 pairs"),
        ("pull-off quartz --model jkr,dmt", "quartz"),  # two laws make no second pair
        ("pull-off quartz,iron --model jkr,dmt", "2 pairs"),
        ("pull-off 100nm,1um", "2 pairs"),
    ],
)
def test_rows_without_a_result_are_still_a_table(run: Run, line: str, head: str) -> None:
    """The rows have dashes for results, and a message names the missing input."""
    ran = run(line, terminal=True)
    assert ran.code == 1
    assert ran.out.startswith(head)
    assert "need" in ran.err
    assert "None" not in ran.out + run(f"{line} --csv").out


COMMANDS = [name for name in QUESTIONS if name != "impact"]  # impact also needs a speed
RADII = [1e-8, 1e-7, 1e-6] * 2


def listed(run: Run, way: str, line: str) -> list[dict[str, str]]:
    """Return the rows of a list: as text in a pipe, by --csv or in a file; for JSON, only the inputs of each row."""
    if way == "json":
        return [{**each["inputs"]} for each in json.loads(run(f"{line} --json").out)]
    if way in ("ndjson", "parquet", "tsv"):
        assert run(f"{line} -o rows.{way}").code == 0
        return read_rows(f"rows.{way}")
    return [*csv.DictReader(run(f"{line} {way}").out.splitlines(), delimiter="," if way else "\t")]


@pytest.mark.parametrize(
    ("command", "way"),
    [
        *((command, "--csv") for command in COMMANDS),
        *(("yield-force", way) for way in ("", "tsv", "ndjson", "parquet", "json")),
    ],
)
def test_each_row_of_a_list_shows_its_radius(run: Run, command: str, way: str) -> None:
    """Q by JKR, 6πγξ, depends on no radius, but Q by Maugis and the doubts do."""
    if way == "parquet":
        pytest.importorskip("pyarrow")
    rows = listed(run, way, f"{command} quartz,iron 10nm,100nm,1um --quantities Q")
    name = "radius" if way == "json" else "radius [m]"
    assert [float(row[name]) for row in rows] == RADII
    if way != "json":
        assert [float(row["yield_force [N]"]) for row in rows] == approx(
            [6 * math.pi * 0.025 * 2e-10] * 3 + [6 * math.pi * 3 * 2e-10] * 3
        )


@pytest.mark.parametrize(
    ("line", "head", "values"),
    [
        ("pull-off quartz 1um --young 5GPa,50GPa", "youngs_modulus [Pa]", [5e9, 5e10]),  # doubts depend on E
        ("pull-off quartz 1um --young 5GPa,rigid", "youngs_modulus [Pa]", [5e9, "rigid"]),
        ("pull-off quartz 1um --z0 0.2nm:0.4nm:2", "atomic_spacing [m]", [2e-10, 4e-10]),
        ("yield-force quartz --quantities Q --radius 100nm±5nm,1um", "radius [m]", [1e-7, 1e-6]),
        ("yield-force quartz 1um --quantities Q --radius2 1um,plane", "radius2 [m]", [1e-6, "plane"]),
        ("infer xi quartz 10nm,1um --measured yield_force=30pN", "radius [m]", [1e-8, 1e-6]),
    ],
)
def test_each_row_has_the_inputs_that_only_doubts_depend_on(
    run: Run, monkeypatch: pytest.MonkeyPatch, line: str, head: str, values: list[float | str]
) -> None:
    for ran in in_both_ways(run, monkeypatch, *line.split(), "--csv"):
        cells = [row[head] for row in csv.DictReader(ran.out.splitlines())]
        assert [cell if cell.isalpha() else approx(float(cell)) for cell in cells] == values


def test_a_list_on_a_terminal_shows_its_radii(run: Run) -> None:
    for command in COMMANDS:
        lines = run(f"{command} quartz,iron 10nm,100nm,1um --quantities Q --quiet", terminal=True).out.splitlines()
        first = next(index for index, line in enumerate(lines) if line.startswith("quartz "))
        assert lines[first - 2].split()[1:3] == ["R1", "[nm]"]
        assert [line.split()[1] for line in lines[first : first + 6]] == ["10", "100", "1000"] * 2


@pytest.mark.parametrize("energies", ["25mJ/m2,30mJ/m2", "30mJ/m2,25mJ/m2"])
def test_columns_of_identical_spheres_do_not_depend_on_the_order_of_a_list(run: Run, energies: str) -> None:
    """With 25 mJ/m², sphere 2 equals sphere 1 of quartz, so the row has the frequency of Eq (31) as printed."""
    of_csv = run(f"frequencies quartz 100nm --gamma2 {energies} --csv").out.splitlines()
    by_energy = {row["surface_energy2 [J/m^2]"]: row for row in csv.DictReader(of_csv)}
    assert by_energy["0.025"]["rolling_frequency_as_printed [Hz]"]
    assert not by_energy["0.03"]["rolling_frequency_as_printed [Hz]"]
