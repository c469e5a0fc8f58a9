"""Sweeps of any length: the rows of a short sweep, whoever writes them."""

import csv
import math
import re
import shlex
import subprocess
import sys
from pathlib import Path

import pytest

import jkroll.batch.sweep
import jkroll.cli.question
from harness import Run

SWEEPS = [
    "pull-off quartz,iron 1nm:1um:7",
    "report quartz 1nm,10nm:1um:9,5um",
    "report gold,quartz 10nm:1um:3 --radius2 plane --material2 iron",
    "yield-force quartz 100nm --load -20nN:20nN:11:lin",
    "frequencies quartz,gold,polystyrene 100nm,1um --radius2 50nm,plane,1um",
    "n-roll quartz 1um --speed 1cm/s:1m/s:4 --xi 1angstrom,2angstrom",
    "contact quartz 100nm --approach -0.1nm:0.1nm:9:lin",
    "n-roll 10nm:1um:5 --gamma 25mJ/m2 --young 54GPa --poisson 0.17 --young2 rigid",
    "r-min 10nm,100nm --radius2 plane,1um",
    "pull-off quartz,ice-warm 1nm:1um:7 --model jkr,maugis,dmt",
    "report quartz 1nm:1um:5 --material2 gold,iron --model maugis,dmt",
    "contact quartz 100nm --load -20nN:20nN:7:lin --model maugis",
    "energies quartz 1nm:10um:9 --model jkr,maugis",
    "pull-off quartz,ice-warm,silica-dry 10nm,100nm --gamma 25±5mJ/m2,30mJ/m2",
    "report ice-warm 10nm:1um:3 --radius2 plane,1um",
    "r-min 10±1nm,100nm --radius2 1um --gamma 25±5mJ/m2",
    "contact quartz 100±10nm --load -10nN:10nN:5:lin --model jkr,dmt",
    "moment quartz 100nm --radius2 90nm,1um --xi '1 to 2angstrom,2angstrom'",
    "contact ice-warm 100nm --load -100nN:0nN:5:lin",
    "report 10nm:1um:5 --gamma 25mJ/m2 --young rigid,54GPa --poisson 0.17",
]


def table(text: str) -> list[list[str]]:
    """The cells of a CSV table."""
    return list(csv.reader(text.splitlines()))


@pytest.mark.parametrize("sweep", SWEEPS)
def test_a_streamed_sweep_has_the_rows_of_a_short_one(run: Run, sweep: str) -> None:
    short = run(*shlex.split(sweep), "--csv")
    written = run(*shlex.split(sweep), "-o", "out.csv")
    assert (written.code, written.out) == (short.code, "")
    assert [line for line in short.err.splitlines() if "rows failed" in line] == [
        line for line in written.err.splitlines() if "rows failed" in line
    ]
    rows, streamed = table(short.out), table(Path("out.csv").read_text(encoding="utf-8"))
    assert streamed[0] == rows[0]
    assert len(streamed) == len(rows)
    close = 8e-15 if "maugis" in sweep else 4e-16  # numbers and arrays
    for row, other in zip(rows[1:], streamed[1:], strict=True):
        values = dict(zip(rows[0], row, strict=True))
        for name, cell, streamed_cell in zip(rows[0], row, other, strict=True):
            beside = re.sub("_(minus|plus)", "", name)  # a side is the difference of two values
            rounding = 0.0 if beside == name else 16 * math.ulp(float(values[beside] or 0))
            try:
                assert float(cell) == pytest.approx(float(streamed_cell), rel=close, abs=rounding), name
            except ValueError:
                assert cell == streamed_cell, name


@pytest.mark.parametrize("end", ["csv", "parquet"])
def test_rows_do_not_depend_on_the_blocks(run: Run, monkeypatch: pytest.MonkeyPatch, end: str) -> None:
    """Neither do they on where a block ends among the laws, and Parquet has the cells of CSV."""
    if end == "parquet":
        pytest.importorskip("pyarrow")
    sweep = [
        "yield-force",
        "quartz,ice-warm",
        "10nm:1um:9",
        "--model",
        "jkr,maugis",
        "--xi",
        "2±0.2angstrom",
        "--quiet",
    ]
    assert run(*sweep, "-o", "whole.csv") == (0, "", "")
    monkeypatch.setattr(jkroll.batch.sweep, "ROWS", 7)
    assert run(*sweep, "-o", f"out.{end}") == (0, "", "")
    if end == "csv":
        assert Path("out.csv").read_bytes() == Path("whole.csv").read_bytes()
        return
    found = pytest.importorskip("pyarrow.parquet").read_table("out.parquet")
    header, *rows = table(Path("whole.csv").read_text(encoding="utf-8"))
    assert found.column_names == header
    assert header[:2] == ["material", "model"]
    for place, name in enumerate(header):
        cells = [row[place] or None for row in rows]
        assert found[name].to_pylist() == (cells if place < 2 else [cell and float(cell) for cell in cells]), name


@pytest.mark.slow
def test_a_long_sweep_is_streamed_to_a_pipe_and_to_parquet(run: Run, monkeypatch: pytest.MonkeyPatch) -> None:
    parquet = pytest.importorskip("pyarrow.parquet")
    command = "pull-off quartz,iron 1nm:1um:15000"
    assert jkroll.cli.question.MANY < 30_000
    piped = subprocess.run(
        [sys.executable, "-m", "jkroll", *command.split(), "--csv", "--quiet"], capture_output=True, text=True
    )
    assert piped.returncode == 0
    assert run(f"{command} -o out.parquet --quiet") == (0, "", "")
    found = parquet.read_table("out.parquet")
    header, *rows = table(piped.stdout)
    assert found.column_names == header
    assert found.num_rows == len(rows) == 30_000
    for place, name in enumerate(header):
        cells = [row[place] for row in rows]
        assert found[name].to_pylist() == ([float(cell) for cell in cells] if name != "material" else cells)
    with monkeypatch.context() as patch:
        patch.setattr(jkroll.cli.question, "MANY", 10**9)
        short = table(run(f"{command} --csv").out)[1:]
    values, others = ([float(cell) for row in some for cell in row[1:]] for some in (short, rows))
    assert values == pytest.approx(others, rel=4e-16)


def test_what_cannot_be_streamed(run: Run) -> None:
    only = "jkroll: -o and long ranges write CSV in SI units with all digits, and take --csv alone"
    assert run("pull-off quartz 1nm:1um:30000 --csv --to nN") == (2, "", f"{only}\n")
    assert run("pull-off quartz 1nm:1um:3 -o x.csv --to nN") == (2, "", f"{only}; for other output write > FILE\n")
    assert run("pull-off quartz 1nm:1um:3 -o x.csv --json") == (2, "", f"{only}; for other output write > FILE\n")
    assert (
        run("pull-off quartz 1nm:1um:2000000").err
        == "jkroll: 2000000 scenes are more than 1000000; --csv and -o FILE write any number\n"
    )
    assert (
        run("pull-off quartz 1nm:1um:3 -o x.ndjson").err
        == "jkroll: -o: a sweep is written as csv, tsv or parquet, not as ndjson\n"
    )
