"""The rivals of the benchmark do the same work as `jkroll batch`."""

import csv
import shutil
from pathlib import Path

import pytest

from benchmarks import rivals
from relative import approx

ROWS = 300


@pytest.mark.slow
@pytest.mark.skipif(shutil.which("g++") is None, reason="needs g++")
def test_rivals_write_the_same_numbers(tmp_path: Path) -> None:
    table = tmp_path / "grains.csv"
    rivals.write_table(table, ROWS)
    found: dict[str, list[list[str]]] = {}
    own = {"jkroll": "jkroll.csv", "jkroll, 1 process": "one.csv", "jkroll, Parquet": "from_parquet.csv"}
    own["the same, --no-doubt"] = "one.csv"
    for rival in rivals.rivals(tmp_path, table):
        rivals.run(rival, tmp_path, table)
        if rival.name == "jkroll, Parquet":
            parquet, csv_of_arrow = pytest.importorskip("pyarrow.parquet"), pytest.importorskip("pyarrow.csv")
            csv_of_arrow.write_csv(parquet.read_table(tmp_path / "jkroll.parquet"), tmp_path / own[rival.name])
        with (tmp_path / own.get(rival.name, f"{rival.name}.csv")).open(encoding="utf-8") as file:
            found[rival.name] = list(csv.reader(file))
    jkroll = found.pop("jkroll")
    assert found.pop("jkroll, 1 process") == jkroll
    assert found.pop("the same, --no-doubt") == [[*row[:-2], row[-1]] for row in jkroll]
    for row, other in zip(found.pop("jkroll, Parquet", jkroll)[1:], jkroll[1:], strict=True):
        assert [*map(float, row[:-2])] == approx([*map(float, other[:-2])], rel=1e-11)
        assert row[-2:] == other[-2:]
    assert "C++" in found
    for name, rows in found.items():
        assert len(rows) == len(jkroll) == ROWS + 1, name
        for row, other in zip(rows[1:], jkroll[1:], strict=True):
            values = [float(cell) for cell in row[9:-1]]
            assert len(values) == len(rivals.results()) >= 10
            assert values == approx([float(cell) for cell in other[9:-2]], rel=1e-11), name
