"""Parquet: the same rows as in CSV to within rounding; columns with units or nulls; and files that cannot be read."""

import csv
import datetime
import io
import math
import sys
from pathlib import Path
from unittest.mock import Mock, PropertyMock, patch

import pytest

import jkroll
from harness import Run
from random_tables import random_table
from relative import approx

pyarrow = pytest.importorskip("pyarrow")
parquet = pytest.importorskip("pyarrow.parquet")

from jkroll.tables.parquet import Batches  # noqa: E402


def write(columns: dict[str, list[object]], name: str = "grains.parquet") -> str:
    """Write a Parquet file, and return its name."""
    parquet.write_table(pyarrow.table(columns), name, row_group_size=100)
    return name


def test_rows_are_the_same_as_in_csv(run: Run) -> None:
    text = random_table(60, 8)
    Path("grains.csv").write_text(text, encoding="utf-8")
    assert run("batch grains.csv -o out.csv --jobs 1").code == 1
    given = list(csv.DictReader(text.splitlines()))
    columns: dict[str, list[object]] = {name: [row[name] or None for row in given] for name in given[0]}
    for name in ("load [nN]", "surface_energy [mJ/m2]"):
        columns[name] = [float(row[name]) if row[name] else None for row in given]
    assert run("batch", write(columns), "-o", "out.parquet").code == 1
    found = parquet.read_table("out.parquet").to_pylist()
    for row, line in zip(found, csv.DictReader(Path("out.csv").read_text(encoding="utf-8").splitlines()), strict=True):
        for name in list(line)[len(columns) : -2]:
            assert row[name] == (approx(float(line[name]), rel=1e-12) if line[name] else None), name
        assert (row["doubt"] or "") == line["doubt"]
        assert bool(row["status"]) == bool(line["status"])
    assert [row["material"] for row in found] == columns["material"]


def test_best_ranges_have_columns_of_numbers_and_a_column_of_text(run: Run) -> None:
    assert run("pull-off quartz 100nm,1um --quantities P_c --best -o best.parquet").code == 0
    (row, _), columns = parquet.read_table("best.parquet").to_pylist(), parquet.read_table("best.parquet").schema
    assert row["pull_off_force_best_by"] == "Maugis"
    assert row["pull_off_force_best_low [N]"] < row["pull_off_force_best_high [N]"]
    words = [field.name for field in columns if pyarrow.types.is_string(field.type)]
    assert words == ["material", "pull_off_force_best_by", "doubt", "status"]


def test_a_plane_in_a_written_list_is_read_as_a_plane(run: Run) -> None:
    assert run("n-grav quartz 100nm,1um --radius2 plane,1um -o list.parquet").code == 0
    listed = parquet.read_table("list.parquet").select(["material", "radius [m]", "radius2 [m]"])
    assert math.inf in listed["radius2 [m]"].to_pylist()
    words = "--quantities yield_force,r_min"
    assert run("batch", write(listed.to_pydict()), "-o", "out.parquet", *words.split()).code == 0
    rows = parquet.read_table("out.parquet").to_pylist()
    expected = [
        jkroll.solve("yield_force", material="quartz", radius=row["radius [m]"], radius2=row["radius2 [m]"])
        for row in rows
    ]
    assert [row["yield_force [N]"] for row in rows] == approx(expected, rel=1e-15)
    assert ["plane" in (row["status"] or "") for row in rows] == [row["radius2 [m]"] == math.inf for row in rows]


@pytest.mark.parametrize("kind", ["float64", "float32", "float16", "int64", "int16", "uint8"])
def test_numbers_of_any_type_and_nulls_are_read_as_in_csv(run: Run, monkeypatch: pytest.MonkeyPatch, kind: str) -> None:
    """The file is read in several blocks, so each column comes in several parts."""
    from jkroll.tables import parquet as batch

    values = [None if row % 5 == 3 else row % 50 + 50 for row in range(100)]
    radius = [None if row % 7 == 0 else 100 + row for row in range(100)]
    columns = {"load [nN]": pyarrow.array(values, kind), "radius [nm]": pyarrow.array(radius, kind)}
    material = pyarrow.array([["quartz", None, "iron"][row % 3] for row in range(100)])
    monkeypatch.setattr(batch, "BLOCK", 30)
    parquet.write_table(pyarrow.table({**columns, "material": material}), "grains.parquet")
    words = "--gamma 25mJ/m2 --young 54GPa --poisson 0.17 --quantities pull_off_force,approach_at_load --jobs 1"
    assert run(f"batch grains.parquet -o out.parquet {words}").code == 1
    lines = [
        ",".join("" if one is None else str(one) for one in row)
        for row in zip(values, radius, material.to_pylist(), strict=True)
    ]
    Path("grains.csv").write_text("\n".join(["load [nN],radius [nm],material", *lines, ""]), encoding="utf-8")
    assert run(f"batch grains.csv -o out.csv {words}").code == 1
    found = parquet.read_table("out.parquet")
    assert found.column("load [nN]").type == pyarrow.type_for_alias(kind)
    with Path("out.csv").open(encoding="utf-8") as file:
        for row, line in zip(found.to_pylist(), csv.DictReader(file), strict=True):
            for name in list(line)[3:-2]:
                assert row[name] == (approx(float(line[name]), rel=1e-12) if line[name] else None), name
            assert (row["doubt"] or "") == line["doubt"]
            assert bool(row["status"]) == bool(line["status"])


def test_files_that_are_not_parquet_and_outputs_in_another_format_are_refused(run: Run) -> None:
    for text in (b"PAR1 no", b"radius [nm]\n100\n", b""):
        Path("x.parquet").write_bytes(text)
        ran = run("batch x.parquet -o y.parquet")
        assert (ran.code, ran.err.count("\n")) == (2, 1)
        assert ran.err.startswith("jkroll: 'x.parquet' cannot be read as Parquet: ")
    name = write({"radius [nm]": [100.0]})
    assert run("batch", name).err == "jkroll: Parquet is read from a file and written to a file: -o FILE\n"
    assert run("batch", name, "-o", "y.csv").err == (
        "jkroll: -o: the output has the format of the input; write 'y.parquet', and convert it with another program\n"
    )
    assert run("batch", name, "-o", name).err == f"jkroll: -o: '{name}' is the input; it is not overwritten\n"
    assert not Path("y.parquet").exists()


def test_parquet_is_not_compressed_again(run: Run) -> None:
    said = "Parquet is compressed in itself; leave out .gz"
    write({"radius [nm]": [100.0], "material": ["quartz"]})
    for words in (
        "batch grains.parquet -o out.parquet.gz",
        "batch grains.parquet.gz -o out.parquet",
        "batch grains.parquet --format parquet.gz -o out.parquet",
        "pull-off quartz 100nm,1um -o out.parquet.gz",
    ):
        ran = run(words)
        assert (ran.code, said in ran.err) == (2, True), ran.err
    assert [path.name for path in Path().iterdir()] == ["grains.parquet"]


def test_a_broken_file_gives_an_error_of_one_line(run: Run) -> None:
    name = write({"radius [nm]": [100.0 + row for row in range(1000)], "material": ["iron"] * 1000})
    text = bytearray(Path(name).read_bytes())
    for offset in range(4, len(text), 291):
        broken = text[:]
        broken[offset : offset + 3] = b"\xff\x00\xff"
        Path("broken.parquet").write_bytes(broken)
        ran = run("batch broken.parquet -o out.parquet --jobs 1 --quiet")
        assert ran.code in (0, 1, 2)
        assert ran.err.count("\n") == bool(ran.code), offset
        assert ran.code != 2 or "'broken.parquet'" in ran.err or "header" in ran.err, offset
        assert "this is a bug in jkroll" not in ran.err, offset
    odd: list[list[object]] = [[["iron"]], [{"a": 1}], [datetime.date(2026, 1, 1)]]
    for values in odd:
        ran = run("batch", write({"radius [nm]": [1.0], "material": values}), "-o", "out.parquet")
        assert (ran.code, "no material '" in ran.err) == (1, True)
    ran = run("batch", write({"radius [nm]": [1.0], "material": [b"iron"]}), "-o", "out.parquet", "--quiet")
    assert ran.code == 0
    Path("there.parquet").mkdir()
    message = "jkroll: -o: 'there.parquet' is a directory; name a file in it, such as 'there.parquet/x.csv'\n"
    assert run("batch", name, "-o", "there.parquet", "--quiet").err == message


@pytest.mark.parametrize("unit", ["nm", "m", "ft"])
def test_an_infinite_radius_is_a_bad_radius(run: Run, unit: str) -> None:
    values: list[object] = [1.0, math.inf, -math.inf, 1e308, 2.0]
    assert run("batch", write({f"radius [{unit}]": values}), "-o", "out.parquet", "--quantities", "r_min").code == 1
    rows = parquet.read_table("out.parquet").to_pylist()
    assert [row["status"] is None for row in rows] == [True, False, False, False, True]
    assert {row["status"] for row in rows[1:4]} == {"bad radius"}


def test_lines_are_counted_from_the_beginning_of_the_file(run: Run, monkeypatch: pytest.MonkeyPatch) -> None:
    from jkroll.tables import parquet as batch

    monkeypatch.setattr(batch, "BLOCK", 30)
    name = write({"radius [nm]": [*range(1, 235), 0.0, 1.0]})
    ran = run("batch", name, "-o", "out.parquet", "--strict", "--quiet")
    assert (ran.code, ran.err.partition(" must")[0]) == (1, "jkroll: line 235: radius: '0.0'")


def test_the_metadata_of_a_file_is_kept(run: Run) -> None:
    schema = pyarrow.schema([("radius [nm]", pyarrow.float64())], metadata={"source": "a cloud"})
    parquet.write_table(pyarrow.table({"radius [nm]": [1.0]}, schema=schema), "grains.parquet")
    assert run("batch grains.parquet -o out.parquet").code == 0
    assert parquet.read_schema("out.parquet").metadata[b"source"] == b"a cloud"


def test_a_dictionary_of_materials_may_use_all_of_its_codes(run: Run) -> None:
    """Codes of 8 bits, from 0 to 127, can number 128 materials."""
    words = ["quartz", *(f"stone{number}" for number in range(127))]
    codes = pyarrow.array([0, None, 127], pyarrow.int8())
    material = pyarrow.DictionaryArray.from_arrays(codes, words)
    parquet.write_table(pyarrow.table({"radius [nm]": [100.0] * 3, "material": material}), "grains.parquet")
    assert run("batch grains.parquet -o out.parquet --quantities pull_off_force").code == 1
    first, second, third = parquet.read_table("out.parquet").to_pylist()
    assert first["pull_off_force [N]"] == approx(1.1781e-8, rel=1e-4)
    assert second["status"] == "needs surface_energy"
    assert third["status"] == "unknown material"


def test_an_interrupted_run_leaves_no_file(run: Run, monkeypatch: pytest.MonkeyPatch) -> None:
    name = write({"radius [nm]": [100.0 + row for row in range(1000)]})
    with monkeypatch.context() as patch:
        patch.setattr("jkroll.tables.run.evaluated", Mock(side_effect=KeyboardInterrupt))
        with pytest.raises(KeyboardInterrupt):
            run("batch", name, "-o", "out.parquet", "--quiet")
    assert [path.name for path in Path().iterdir()] == [name]


def test_option_strict_writes_no_file_if_a_row_is_bad(run: Run) -> None:
    name = write({"radius [nm]": [100.0, 0.0]})
    ran = run("batch", name, "-o", "y.parquet", "--strict", "--quiet")
    assert (ran.code, ran.err) == (
        1,
        "jkroll: line 2: radius: '0.0' must be positive; expected a length such as 100nm\n",
    )
    assert not Path("y.parquet").exists()


@pytest.mark.parametrize(
    ("rows", "group", "jobs"), [(0, 7, 1), (1000, 7, 1), (1000, 100, 3), (1000, 450, 1), (1000, 1000, 1)]
)
def test_a_run_of_several_pieces_has_all_rows(
    run: Run, monkeypatch: pytest.MonkeyPatch, rows: int, group: int, jobs: int
) -> None:
    """About 300 rows are written together and 20 are computed together, however the rows in the file are grouped."""
    from jkroll.tables import parquet as batch

    table = pyarrow.table({"radius [nm]": [100.0 + row for row in range(rows)], "id": pyarrow.array(range(rows))})
    parquet.write_table(table, "grains.parquet", row_group_size=group)
    assert run("batch grains.parquet -o one.parquet --jobs 1 --quiet") == (0, "", "")
    monkeypatch.setattr(batch, "BYTES", 15_000)
    monkeypatch.setattr(batch, "BLOCK", 20)
    assert run(f"batch grains.parquet -o several.parquet --jobs {jobs} --quiet") == (0, "", "")
    found = parquet.ParquetFile("several.parquet")
    assert found.read().equals(parquet.read_table("one.parquet"))
    assert Path("several.parquet").read_bytes()[:4] == b"PAR1" == Path("several.parquet").read_bytes()[-4:]
    assert found.metadata.num_row_groups >= 3 * bool(rows)
    assert found.read(["id"]).column(0).to_pylist() == [*range(rows)]


def test_without_pyarrow_a_line_names_the_extra(run: Run, monkeypatch: pytest.MonkeyPatch) -> None:
    name = write({"radius [nm]": [100.0]})
    monkeypatch.setitem(sys.modules, "pyarrow", None)
    monkeypatch.delitem(sys.modules, "jkroll.tables.parquet", raising=False)
    for command in (f"batch {name} -o y.parquet", "r-min 1nm:1um:3 -o y.parquet", "batch *.parquet -o y/"):
        ran = run(command)
        assert (ran.code, ran.err) == (2, "jkroll: this needs pyarrow: pip install 'jkroll[parquet]'\n"), command


def test_a_table_without_columns_is_refused(run: Run) -> None:
    pyarrow.parquet.write_table(pyarrow.table({}), "none.parquet")
    ran = run("batch none.parquet -o out.parquet")
    assert (ran.code, "no column is an input" in ran.err) == (2, True)


def test_the_size_of_each_batch_is_taken_once() -> None:
    """Otherwise the time would grow as the square of the number of batches.

    In a column with a dictionary, each group of rows begins a new batch, so there may be many.
    """
    batches, sizes = [Mock() for _ in range(500)], [PropertyMock(return_value=1) for _ in range(500)]
    for batch, size in zip(batches, sizes, strict=True):
        type(batch).nbytes = size
    with (
        patch("pyarrow.parquet.ParquetWriter") as writer,
        patch("pyarrow.Table"),
        patch("jkroll.tables.parquet.BYTES", 10),
    ):
        with Batches().sink(io.BytesIO(), Mock(schema=[])) as write:
            for batch in batches:
                write(batch)
        written = writer().__enter__().write_table
    assert {size.call_count for size in sizes} == {1}
    assert written.call_count == 50


def test_a_column_with_a_dictionary_is_kept_in_small_groups_of_rows(run: Run) -> None:
    kinds = [f"kind {row % 500}" for row in range(2000)]
    columns = {"radius [nm]": [100.0 + row for row in range(2000)], "kind": pyarrow.array(kinds).dictionary_encode()}
    name = write(columns)
    assert run("batch", name, "-o", "out.parquet", *"--material quartz --quantities pull_off_force".split()).code == 0
    found = parquet.read_table("out.parquet").to_pydict()
    assert found["kind"] == kinds
    assert found["pull_off_force [N]"] == approx([3 * math.pi * 0.025 * (100 + row) * 0.5e-9 for row in range(2000)])


def test_a_column_of_laws_is_refused_as_in_csv(run: Run) -> None:
    refused = run(
        "batch", write({"radius [nm]": [100.0], "model": ["dmt"]}), "-o", "out.parquet", "--material", "quartz"
    )
    assert refused.code == 2
    assert "the law is an option: --model dmt" in refused.err
