"""Rows of tables against one-liners of the same words: numbers, error bars, what is missing, and what is refused."""

import csv
import json
import math
import random
from pathlib import Path

import pytest

from harness import Run
from jkroll.quantities.nomenclature import header
from relative import approx

COLUMNS = {
    "material": ["quartz", "iron", "gold", "ice-warm", "silica-dry", "", "quarz"],
    "radius": ["100nm", "1um", "12.5 nm", "100±10nm", "90 to 110nm", "1 N", "-5nm", ""],
    "material2": ["", "", "", "ice-warm", "graphite"],
    "radius2": ["", "", "plane", "0.5um", "1±0.1um"],
    "surface_energy": ["", "", "25mJ/m2", "25±5mJ/m2", "25(5)mJ/m2", "25 +6/-4 mJ/m2", "20 to 30mJ/m2", "25±20mJ/m2"],
    "load": ["", "", "0N", "3nN", "-2nN", "-1e-3N", "3±1nN"],
    "yield_displacement": ["", "2angstrom", "2angstrom±20%"],
    "speed": ["", "", "10cm/s"],
}
OPTIONS = {"surface_energy": "--gamma", "yield_displacement": "--xi"}
ROUNDING = {"jkr": 16, "maugis": 64, "dmt": 16}  # ulp between numbers and arrays


def random_rows(size: int, seed: int) -> list[dict[str, str]]:
    """Return rows, of which about half have some cell that is uncertain or wrong."""
    draw = random.Random(seed)
    return [{name: draw.choice(cells) for name, cells in COLUMNS.items()} for _ in range(size)]


def one_liner(run: Run, row: dict[str, str], model: str) -> tuple[int, dict[str, dict[str, object]]]:
    """Return what the command says of a row: exit code, results by name."""
    words = [row["material"], row["radius"]]
    for name, text in row.items():
        if name not in ("material", "radius"):
            words += [OPTIONS.get(name, f"--{name}"), text] if text else []
    ran = run("report", *filter(None, words), "--model", model, "--json")
    results = json.loads(ran.out)["results"] if ran.out else []
    return ran.code, {result["name"]: result for result in results}


def check(run: Run, rows: list[dict[str, str]], model: str) -> int:
    """Compare the rows of a table with one-liners; return how many numbers were compared."""
    with Path("grains.csv").open("w", newline="", encoding="utf-8") as file:
        writer = csv.DictWriter(file, COLUMNS)
        writer.writeheader()
        writer.writerows(rows)
    run("batch", "grains.csv", "-o", "out.csv", "--model", model, "--quantities", "report", "--uncertainty", "--quiet")
    compared = 0
    with Path("out.csv").open(encoding="utf-8") as file:
        for row, found in zip(rows, csv.DictReader(file), strict=True):
            code, results = one_liner(run, row, model)
            no_contact = "beyond pull-off" in found["status"]
            if code == 2:
                assert found["status"], row
            assert not no_contact or code, row
            for name, result in results.items() if not no_contact else ():
                if header(name) not in found:
                    continue
                cell, value = found[header(name)], result["value"]
                assert bool(cell) == (value is not None), (name, row, found["status"])
                if not isinstance(value, float):
                    continue
                off = ROUNDING[model] * math.ulp(value)
                assert float(cell) == approx(value, rel=0, abs=off), (name, row)
                sides = result.get("uncertainty", {})
                assert isinstance(sides, dict)
                for side in ("minus", "plus", "low", "high"):
                    beside = found[header(name).replace(name, f"{name}_{side}")]
                    assert bool(beside) == (side in sides), (name, side, row, found["status"])
                    assert not beside or float(beside) == approx(sides[side], rel=1e-8, abs=off), (name, row)
                    compared += bool(beside)
                compared += 1
    return compared


@pytest.mark.parametrize("model", ROUNDING)
def test_random_rows_are_one_liners(run: Run, model: str) -> None:
    assert check(run, random_rows(20, 1), model) > 70


@pytest.mark.slow
@pytest.mark.parametrize("model", ROUNDING)
def test_more_random_rows_are_one_liners(run: Run, model: str) -> None:
    assert check(run, random_rows(1500, 2), model) > 6000
