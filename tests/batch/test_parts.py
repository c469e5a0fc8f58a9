"""Many tables: one after the other, or by workers that may be killed."""

import gzip
import json
import os
import re
import signal
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest

import jkroll
from harness import Run
from jkroll.batch.lines import Tally
from jkroll.batch.one import convert_one
from jkroll.batch.settings import Job, Part
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
    """What a directory holds, without the time in its manifest."""
    found = {path.name: path.read_bytes() for path in Path(directory).iterdir()}
    manifest = {name: value for name, value in json.loads(found["manifest.json"]).items() if name != "begun"}
    return found | {"manifest.json": json.dumps(manifest).encode()}


def test_a_file_for_each_table_and_a_manifest(run: Run, grains: list[str]) -> None:
    assert run("batch", "grains/*.csv", "-o", "forces/", "--jobs", "1").code == 1
    found = whole("forces")
    manifest = json.loads(found.pop("manifest.json"))
    assert manifest["rows"] == sum(20 + place for place in range(PARTS))
    assert [one["input"] for one in manifest["files"]] == grains
    assert [one["output"] for one in manifest["files"]] == [Path(name).name for name in grains]
    assert manifest["version"] == jkroll.__version__
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
        run("batch", *call, "--jobs", "1", "--quantities", "r_min")
        before = count()
        run("batch", *call, "--jobs", "1", "--quantities", "r_min")
        assert count() == before, call


def test_resume_leaves_out_what_is_done(run: Run, grains: list[str]) -> None:
    assert run("batch", "grains/*.csv", "-o", "whole/", "--jobs", "1").code == 1
    Path(grains[3]).rename("away.csv")
    Path(grains[3]).mkdir()
    ran = run("batch", "grains/*.csv", "-o", "forces/", "--jobs", "1")
    reading, _, said = ran.err.partition("\n")
    assert reading.startswith("read: material, ")
    assert reading.endswith(": 4 of 5 files")
    assumed, directory, doubtful, not_judged, failed = said.splitlines()
    assert assumed == "note: assumed g = 9.80665 m/s² (--gravity): 4 of 5 files"
    assert (ran.code, directory) == (2, f"jkroll: '{grains[3]}': Is a directory")
    assert doubtful.startswith("note: 58 of 87 rows are doubtful (law>×2 in 34, ")
    assert not_judged.startswith("note: ? in ")
    assert failed == "jkroll: 18 of 87 rows failed; column status says why"
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


def times(directory: str) -> dict[str, int]:
    """When the tables of a directory were written."""
    return {path.name: path.stat().st_mtime_ns for path in Path(directory).glob("*.csv")}


def test_resume_makes_anew_what_is_older_than_its_input(run: Run, grains: list[str]) -> None:
    words = ("batch", "grains/*.csv", "-o", "forces/", "--quantities", "r_min", "--jobs", "1")
    assert run(*words).code == 1
    before = times("forces")
    Path(grains[1]).write_text("radius [nm]\n100\n", encoding="utf-8")
    os.utime(grains[1], ns=(0, before["part-1.csv"] + 1))
    assert run(*words, "--resume").code == 1
    after = times("forces")
    assert {name for name in before if after[name] != before[name]} == {"part-1.csv"}
    assert (Path("forces") / "part-1.csv").read_text(encoding="utf-8").startswith("radius [nm],r_min [m],")
    manifest = json.loads(Path("forces/manifest.json").read_text())
    assert manifest["rows"] == sum(20 + place for place in range(PARTS)) - 20
    assert run(*words).code == 1
    assert all(after[name] != time for name, time in times("forces").items())


@pytest.mark.usefixtures("grains")
def test_resume_refuses_other_options_and_another_version(run: Run, monkeypatch: pytest.MonkeyPatch) -> None:
    words = ("batch", "grains/*.csv", "-o", "forces/", "--quantities", "r_min", "--jobs", "1", "--quiet")
    assert run(*words).code == 1
    before = whole("forces")
    for options in (["--xi", "1nm"], ["--model", "dmt"], ["--no-doubt"], ["--strict"]):
        ran = run(*words, *options, "--resume")
        said = "jkroll: --resume: 'forces/' was made with other options; without --resume it is made anew\n"
        assert (ran.code, ran.err) == (2, said), options
    with monkeypatch.context() as patch:
        patch.setattr("jkroll.batch.many.__version__", "0.0.0")
        said = "jkroll: --resume: 'forces/' was made with another version; without --resume it is made anew\n"
        assert run(*words, "--resume") == (2, "", said)
    assert whole("forces") == before
    assert run(*words[:-3], "--jobs", "2", "--resume").code == 1  # which changes no result
    assert whole("forces") == before


@pytest.mark.slow
def test_the_manifest_is_there_before_the_first_table(
    run: Run, monkeypatch: pytest.MonkeyPatch, grains: list[str]
) -> None:
    """So a run that is ended in the middle can be continued: what has its name is whole."""
    words = ("batch", "grains/*.csv", "-o", "forces/", "--jobs", "1")
    with monkeypatch.context() as patch:
        interrupted_at(2, patch)
        assert run(*words).code == 130
    assert {"version", "options", "files"} <= json.loads(Path("forces/manifest.json").read_text()).keys()
    before = times("forces")
    assert sorted(before) == [Path(name).name for name in grains[:2]]
    assert run(*words, "--resume").code == 1
    assert before.items() <= times("forces").items()
    assert run(*words[:3], "whole/", *words[4:]).code == 1
    assert whole("forces") == whole("whole")  # with the counts of the tables of before


def interrupted_at(place: int, patch: pytest.MonkeyPatch) -> None:
    """Have runs end before the table at a place."""
    done: list[Part] = []

    def until(part: Part, job: Job) -> Tally:
        if len(done) == place:
            raise KeyboardInterrupt
        done.append(part)
        return convert_one(part, job)

    patch.setattr("jkroll.batch.many.convert_one", until)


def test_resume_keeps_nothing_that_an_earlier_run_left(
    run: Run, monkeypatch: pytest.MonkeyPatch, grains: list[str]
) -> None:
    """The files of before are newer than their inputs too, but were made with other options."""
    words = ("batch", "grains/*.csv", "--jobs", "1")
    assert run(*words, "-o", "forces/", "--quantities", "mass").code == 1
    for place in (1, 2):
        with monkeypatch.context() as patch:
            interrupted_at(place, patch)
            resume = ["--resume"] if place > 1 else []
            assert run(*words, "-o", "forces/", "--quantities", "r_min", *resume).code == 130
    before = times("forces")
    assert run(*words, "-o", "forces/", "--quantities", "r_min", "--resume").code == 1
    after = times("forces")
    assert [Path(name).name for name in grains if before[Path(name).name] == after[Path(name).name]] == [
        Path(name).name for name in grains[:3]
    ]
    assert run(*words, "-o", "whole/", "--quantities", "r_min").code == 1
    assert all((Path("whole") / name).read_bytes() == (Path("forces") / name).read_bytes() for name in after)


@pytest.mark.parametrize("option", [["--resume"], ["--dask", "local"]])
def test_a_single_table_is_not_resumed_and_needs_no_cluster(run: Run, grains: list[str], option: list[str]) -> None:
    said = f"jkroll: {option[0]} is for many files: name them as in 'grains/*.csv', with -o DIRECTORY/\n"
    for path in (grains[0], "-"):
        assert run("batch", path, "-o", "out.csv", *option) == (2, "", said)
    assert not Path("out.csv").exists()


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


def test_a_file_whose_name_has_brackets_is_a_file(run: Run) -> None:
    Path("a[1].csv").write_text("radius [nm]\n100\n", encoding="utf-8")
    assert run("batch", "a[1].csv", "-o", "forces/", "--material", "quartz").code == 0
    assert Path("forces/a[1].csv").exists()


@pytest.mark.slow
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
        assert (ran.code, ran.out, ran.err.splitlines()[0]) == (0, "", "read: radius [nm]")
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
            while not [*Path("forces").glob(".part-*")]:
                assert batch.poll() is None
            os.kill(workers[0].pid, signal.SIGKILL)
        _, message = batch.communicate()
        assert re.search(r"^jkroll: \d+ of 20000 rows failed; column status says why\n", message, re.MULTILINE)
    finally:
        for process in workers:
            process.kill()
            process.wait()
    found = whole("forces")
    begun = [name for name in found if name.startswith(".")]  # by the one that was killed
    assert len(begun) <= kill
    assert {name: text for name, text in found.items() if name not in begun} == whole("whole")
