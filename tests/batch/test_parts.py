"""Many tables: one after the other, or by workers that may be killed."""

import csv
import gzip
import json
import os
import re
import signal
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

from harness import Run
from tables import random_table

PARTS = 5


@pytest.fixture
def grains() -> list[str]:
    """Some tables."""
    Path("grains").mkdir()
    names = [f"grains/part-{place}.csv" for place in range(PARTS)]
    for place, name in enumerate(names):
        Path(name).write_text(random_table(20 + place, place), encoding="utf-8")
    return names


def whole(directory: str) -> dict[str, bytes]:
    """What a directory holds."""
    return {path.name: path.read_bytes() for path in Path(directory).iterdir()}


def test_a_file_for_each_table_and_a_manifest(run: Run, grains: list[str]) -> None:
    assert run("batch", "grains/*.csv", "-o", "forces/", "--jobs", "1").code == 1
    found = whole("forces")
    manifest = json.loads(found.pop("manifest.json"))
    assert manifest["rows"] == sum(20 + place for place in range(PARTS))
    assert [one["input"] for one in manifest["files"]] == grains
    for name in grains:
        assert run("batch", name, "-o", "one.csv", "--jobs", "1").code == 1
        assert found.pop(Path(name).name) == Path("one.csv").read_bytes()
    assert not found


def test_no_table_keeps_descriptors(run: Run, grains: list[str]) -> None:
    """Else the tables of one run would be limited by how many files a process may have open: often 1024."""
    Path("bad.csv").write_text("radius [nm],radus\n1,2\n", encoding="utf-8")
    Path("grains.csv.gz").write_bytes(gzip.compress(Path(grains[0]).read_bytes()))
    calls = [[grains[0], "-o", "out.csv"], [grains[0], "-o", "out.csv", "--strict"], ["bad.csv", "-o", "out.csv"]]
    calls += [["grains.csv.gz", "-o", "out.csv"], ["grains/*.csv", "-o", "out/"], [grains[0], "-o", "/dev/full"]]

    def count() -> int:
        return len(os.listdir("/proc/self/fd"))

    for call in calls:
        run("batch", *call, "--jobs", "1")
        before = count()
        run("batch", *call, "--jobs", "1")
        assert count() == before, call


def test_resume_leaves_out_what_is_done(run: Run, grains: list[str]) -> None:
    assert run("batch", "grains/*.csv", "-o", "whole/", "--jobs", "1").code == 1
    Path(grains[3]).rename("away.csv")
    Path(grains[3]).mkdir()
    ran = run("batch", "grains/*.csv", "-o", "forces/", "--jobs", "1")
    doubtful = "note: 24 of 87 rows are doubtful; column doubt says why\n"
    rows_failed = f"{doubtful}jkroll: 18 of 87 rows failed; column status says why\n"
    assert (ran.code, ran.err) == (2, f"jkroll: '{grains[3]}': Is a directory\n{rows_failed}")
    assert sorted(whole_names("forces")) == ["manifest.json", *(f"part-{place}.csv" for place in (0, 1, 2, 4))]
    failed = json.loads(Path("forces/manifest.json").read_text())["files"][3]
    assert failed["problem"] == "Is a directory"
    times = {path.name: path.stat().st_mtime_ns for path in Path("forces").glob("*.csv")}
    Path(grains[3]).rmdir()
    Path("away.csv").rename(grains[3])
    assert run("batch", "grains/*.csv", "-o", "forces/", "--jobs", "1", "--resume").code == 1
    assert {name: (Path("forces") / name).stat().st_mtime_ns for name in times} == times
    found, wanted = whole("forces"), whole("whole")
    assert found.keys() == wanted.keys()
    assert all(found[name] == wanted[name] for name in times)
    ran = run("batch", "grains/*.csv", "-o", "forces/", "--resume")
    assert ran.err.startswith("note: all 5 files are done; without --resume they are made anew\n")
    assert ran.code == 1


@pytest.mark.usefixtures("grains")
def test_nothing_of_the_users_is_touched(run: Run) -> None:
    Path("forces").mkdir()
    Path("forces/.mine.part-0.csv").write_text("mine")
    Path("forces/manifest.json").write_text('{"name": "mine"}')
    ran = run("batch", "grains/*.csv", "-o", "forces/", "--jobs", "1")
    message = "'forces/manifest.json' is not a manifest of jkroll; it is not replaced: move it away"
    assert (ran.code, ran.err) == (2, f"jkroll: -o: {message}\n")
    Path("forces/manifest.json").unlink()
    assert run("batch", "grains/*.csv", "-o", "forces/", "--jobs", "1").code == 1
    assert Path("forces/.mine.part-0.csv").read_text() == "mine"


def test_a_pool_writes_what_one_process_writes(run: Run, monkeypatch: pytest.MonkeyPatch, grains: list[str]) -> None:
    from jkroll.batch import many

    assert run("batch", "grains/*.csv", "-o", "whole/", "--jobs", "1").code == 1
    monkeypatch.setattr(many, "FEW", 1)
    assert run("batch", "grains/*.csv", "-o", "forces/", "--jobs", "2").code == 1
    assert len(grains) == PARTS
    assert whole("forces") == whole("whole")


def test_no_file_stays_open(run: Run) -> None:
    import gzip

    Path("grains").mkdir()
    for place in range(5):
        Path(f"grains/{place}.csv").write_text("radius [nm]\n100\n")
        Path(f"grains/{place}.csv.gz").write_bytes(gzip.compress(b"radius [nm]\n100\n"))
    run("batch", "grains/*", "-o", "first/", "--material", "quartz")  # multiprocessing keeps one for itself
    before = os.listdir("/proc/self/fd")
    for jobs in ("1", "2"):
        ran = run("batch", "grains/*", "-o", "forces/", "--material", "quartz", "--jobs", jobs)
        assert ran == (0, "", "")
    assert len(os.listdir("/proc/self/fd")) <= len(before)


def whole_names(directory: str) -> list[str]:
    """The names of what a directory holds."""
    return [path.name for path in Path(directory).iterdir()]


def test_what_makes_no_directory(run: Run, grains: list[str]) -> None:
    message = "jkroll: several tables need a directory for the results: -o DIRECTORY/\n"
    for output in ([], ["-o", grains[0]], ["-o", f"{grains[0]}/"]):
        assert run("batch", "grains/*.csv", *output) == (2, "", message)
    assert run("batch", "grains/*.csv").code == 2
    assert run("batch", "none/*.csv", "-o", "forces/").err == "jkroll: 'none/*.csv': no such file\n"
    assert "not overwritten" in run("batch", "grains/*.csv", "-o", "grains").err
    assert all(Path(name).read_text().startswith("material,") for name in grains)


@pytest.mark.parametrize("end", ["csv", "ndjson", "parquet"])
def test_a_large_table_is_split(run: Run, monkeypatch: pytest.MonkeyPatch, end: str) -> None:
    from jkroll.batch import many, source
    from jkroll.batch.settings import Order, Settings
    from jkroll.materials.library import known_materials

    name = f"grains.{end}"
    rows: list[dict[str, Any]] = [
        {"radius [nm]": 100.0 + row, "text": 'a\n"b"' if row % 3 else ""}
        | ({} if row % 5 else {"radius2 [nm]": 50.0})  # which the first line of a part may lack
        for row in range(300)
    ]
    if end == "csv":
        with Path(name).open("w", newline="") as file:
            writer = csv.DictWriter(file, rows[0])
            writer.writeheader()
            writer.writerows(rows)
    elif end == "ndjson":
        Path(name).write_text("".join(json.dumps(row) + "\n" for row in rows))
    else:
        pyarrow, parquet = pytest.importorskip("pyarrow"), pytest.importorskip("pyarrow.parquet")
        parquet.write_table(pyarrow.Table.from_pylist(rows), name, row_group_size=7)
    monkeypatch.setattr(source, "SPAN", 500)
    monkeypatch.setattr(source, "CHUNK", 100)
    if end == "parquet":
        monkeypatch.setattr("jkroll.batch.parquet.SPAN", 50)
    assert run("batch", name, "-o", f"whole.{end}", "--quantities", "r_min").code == 0
    settings = Settings("out/", quantities="r_min", dask="local", jobs=1)
    assert many.convert(name, Order(settings, {}, known_materials()), many.by_processes) == ((300, 0, 0), 0)
    manifest = json.loads(Path("out/manifest.json").read_text())["files"]
    found = [Path("out") / one["output"] for one in manifest]
    assert len(found) >= 5
    assert [path.name for path in found] == [f"grains-{place:05}.{end}" for place in range(len(found))]
    if end == "parquet":
        whole, *others = (parquet.read_table(path) for path in ("whole.parquet", *found))
        assert pyarrow.concat_tables(others).equals(whole)
        return
    texts = [path.read_bytes() for path in found]
    if end == "csv":
        head = texts[0].partition(b"\n")[0] + b"\n"
        texts = [head, *(text.removeprefix(head) for text in texts)]
    assert b"".join(texts) == Path(f"whole.{end}").read_bytes()


@pytest.fixture
def scheduler() -> Iterator[str]:
    """A Dask scheduler."""
    pytest.importorskip("distributed")
    command = [
        sys.executable,
        "-m",
        "distributed.cli.dask_scheduler",
        "--port",
        "0",
        "--host",
        "127.0.0.1",
        "--no-dashboard",
    ]
    process = subprocess.Popen(command, stderr=subprocess.PIPE, text=True)
    assert process.stderr is not None
    address = next(match[0] for line in process.stderr if (match := re.search(r"tcp://[\d.]+:\d+", line)))
    yield address
    process.terminate()
    process.communicate()


def worker(address: str) -> "subprocess.Popen[bytes]":
    """A Dask worker."""
    command = [
        sys.executable,
        "-m",
        "distributed.cli.dask_worker",
        address,
        "--nthreads",
        "1",
        "--no-nanny",
        "--no-dashboard",
    ]
    return subprocess.Popen(command, stderr=subprocess.DEVNULL)


@pytest.mark.slow
@pytest.mark.parametrize("kill", [False, True])
def test_two_dask_workers_write_what_one_process_writes(
    run: Run, grains: list[str], scheduler: str, *, kill: bool
) -> None:
    for place, name in enumerate(grains):
        Path(name).write_text(random_table(4000, place), encoding="utf-8")
    assert run("batch", "grains/*.csv", "-o", "whole/", "--jobs", "1").code == 1
    workers = [worker(scheduler), worker(scheduler)]
    try:
        command = [sys.executable, "-m", "jkroll", "batch", "grains/*.csv", "-o", "forces/", "--dask", scheduler]
        batch = subprocess.Popen(command, stderr=subprocess.PIPE, text=True)
        if kill:
            while not (Path("forces").exists() and "manifest.json.journal" in whole_names("forces")):
                assert batch.poll() is None
            os.kill(workers[0].pid, signal.SIGKILL)
        _, message = batch.communicate()
        assert re.search(r"^jkroll: \d+ of 20000 rows failed; column status says why\n", message, re.MULTILINE)
    finally:
        for process in workers:
            process.kill()
            process.wait()
    assert whole("forces") == whole("whole")
