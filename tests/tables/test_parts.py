"""Many tables, converted in this process, by other processes, or by Dask workers that may be killed."""

import errno
import gzip
import os
import re
import signal
import subprocess
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from unittest.mock import patch

import pytest

from harness import Run
from jkroll.tables import run as command
from random_tables import random_table

PARTS = 5


@pytest.fixture
def grains() -> list[str]:
    """Write some tables, and return their names."""
    Path("grains").mkdir()
    names = [f"grains/part-{part}.csv" for part in range(PARTS)]
    for part, name in enumerate(names):
        Path(name).write_text(random_table(20 + part, part), encoding="utf-8")
    return names


def whole(directory: str) -> dict[str, bytes]:
    """Return the contents of the files in a directory."""
    return {path.name: path.read_bytes() for path in Path(directory).iterdir()}


def test_each_table_gets_a_file_with_the_results_of_a_single_run(run: Run, grains: list[str]) -> None:
    words = ("--quantities", "pull_off_force,contact_radius_at_load", "--jobs", "1")
    assert run("batch", "grains/*.csv", "-o", "forces/", *words).code == 1
    written = whole("forces")
    for name in grains:
        assert run("batch", name, "-o", "one.csv", *words).code == 1
        assert written.pop(Path(name).name) == Path("one.csv").read_bytes()
    assert not written


def test_no_table_keeps_a_file_open(run: Run, grains: list[str]) -> None:
    """Otherwise the number of tables in a run would be limited: many systems let a process open only 1024 files."""
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


def times(directory: str) -> dict[str, int]:
    """Return the time at which each table in a directory was written."""
    return {path.name: path.stat().st_mtime_ns for path in Path(directory).glob("*.csv")}


def test_a_table_that_cannot_be_read_is_named_and_a_resumed_run_converts_it(run: Run, grains: list[str]) -> None:
    words = ("batch", "grains/*.csv", "--jobs", "1")
    assert run(*words, "-o", "whole/").code == 1
    Path(grains[3]).rename("away.csv")
    Path(grains[3]).mkdir()
    ran = run(*words, "-o", "forces/")
    reading, _, said = ran.err.partition("\n")
    assert reading.startswith("read: material, ")
    assert reading.endswith(": 4 of 5 files")
    assumed, directory, warning, doubtful, *gaps, failed = said.splitlines()
    in_words = "w = 2√(γ1γ2) (--work-of-adhesion), g = 9.80665 m/s² (--gravity)"
    assert assumed == f"assumed: {in_words}: 4 of 5 files"
    assert (ran.code, directory) == (2, f"jkroll: '{grains[3]}': Is a directory")
    assert warning.startswith("warning: numbers have no meaning in ")
    assert doubtful.startswith("note: doubts in 87 of 87 rows (column doubt): law-off-2x 34, ")
    assert len(gaps) == 5
    assert failed == "jkroll: 18 of 87 rows failed; column status has the reasons"
    before = times("forces")
    assert sorted(before) == [f"part-{part}.csv" for part in (0, 1, 2, 4)]
    Path(grains[3]).rmdir()
    Path("away.csv").rename(grains[3])
    ran = run(*words, "-o", "forces/", "--resume")
    note = "note: 4 of 5 output files are up to date and were kept"
    assert (ran.code, ran.err.splitlines()[0]) == (1, note)
    assert before.items() < times("forces").items()
    assert whole("forces") == whole("whole")


def test_a_note_on_a_row_names_the_table_of_the_row(run: Run) -> None:
    Path("in").mkdir()
    for name, cells in (("a", "1 2"), ("b", "1 x"), ("c", "y 2")):
        Path(f"in/{name}.csv").write_text("\n".join(["radius [nm]", *cells.split()]), encoding="utf-8")
    ran = run("batch in/*.csv -o out/ --gamma 25mJ/m2 --quantities pull_off_force")
    (note,) = (line for line in ran.err.splitlines() if "length such as" in line)
    assert note.startswith("note: 'in/b.csv': radius: 'x' ")
    assert note.endswith(": row 2 and 1 other")


def test_a_name_without_a_file_stops_no_other_table(run: Run, grains: list[str]) -> None:
    """Such a name may be a link to a missing file, or the name of a file removed during the run."""
    Path("grains/away.csv").symlink_to("nowhere.csv")
    words = ("batch", "grains/*.csv", "-o", "forces/", "--quantities", "r_min")
    for resume in ([], ["--resume"]):
        ran = run(*words, *resume)
        assert (ran.code, "jkroll: 'grains/away.csv': No such file or directory" in ran.err) == (2, True)
        assert len(times("forces")) == len(grains)
    Path("forces/away.csv").touch()
    assert run(*words, "--resume").err.count("No such file") == 1


def test_resume_converts_tables_newer_than_their_output(run: Run, grains: list[str]) -> None:
    words = ("batch", "grains/*.csv", "-o", "forces/", "--quantities", "r_min", "--jobs", "1")
    assert run(*words).code == 1
    before = times("forces")
    Path(grains[1]).write_text("radius [nm]\n100\n", encoding="utf-8")
    os.utime(grains[1], ns=(0, before["part-1.csv"] + 1))
    assert run(*words, "--resume").code == 0  # rows of kept files are not counted
    after = times("forces")
    assert {name for name in before if after[name] != before[name]} == {"part-1.csv"}
    assert (Path("forces") / "part-1.csv").read_text(encoding="utf-8").startswith("radius [nm],r_min [m],")
    assert run(*words).code == 1
    assert all(after[name] != time for name, time in times("forces").items())


@pytest.mark.parametrize("option", [["--resume"], ["--dask", "tcp://127.0.0.1:1"]])
def test_resume_and_dask_are_refused_for_a_single_table(run: Run, grains: list[str], option: list[str]) -> None:
    said = "jkroll: --resume and --dask are for many files: write 'grains/*.csv' -o DIRECTORY/\n"
    for path in (grains[0], "-"):
        assert run("batch", path, "-o", "out.csv", *option) == (2, "", said)
    assert not Path("out.csv").exists()


@pytest.mark.usefixtures("grains")
def test_hidden_files_that_are_not_from_batch_are_kept(run: Run) -> None:
    Path("forces").mkdir()
    Path("forces/.mine.part-0.csv").write_text("mine")
    assert run("batch", "grains/*.csv", "-o", "forces/", "--jobs", "1", "--quantities", "r_min").code == 1
    assert Path("forces/.mine.part-0.csv").read_text() == "mine"


def test_a_file_name_may_have_brackets(run: Run) -> None:
    Path("a[1].csv").write_text("radius [nm]\n100\n", encoding="utf-8")
    assert run("batch", "a[1].csv", "-o", "forces/", "--material", "quartz").code == 0
    assert Path("forces/a[1].csv").exists()


@pytest.mark.slow
def test_several_processes_write_the_same_files_as_one(
    run: Run, monkeypatch: pytest.MonkeyPatch, grains: list[str]
) -> None:
    assert run("batch", "grains/*.csv", "-o", "whole/", "--jobs", "1").code == 1
    monkeypatch.setattr(command, "LITTLE", 1)
    assert run("batch", "grains/*.csv", "-o", "forces/", "--jobs", "2").code == 1
    assert len(grains) == PARTS
    assert whole("forces") == whole("whole")


def test_a_target_that_is_not_a_directory_is_refused(run: Run, grains: list[str]) -> None:
    message = "jkroll: several tables need a directory for the results: -o DIRECTORY/\n"
    for output in ([], ["-o", grains[0]], ["-o", f"{grains[0]}/"]):
        assert run("batch", "grains/*.csv", *output) == (2, "", message)
    assert run("batch", "grains/*.csv").code == 2
    assert run("batch", "none/*.csv", "-o", "forces/").err == "jkroll: 'none/*.csv': no such file\n"
    assert "would be overwritten" in run("batch", "grains/*.csv", "-o", "grains").err
    assert all(Path(name).read_text().startswith("material,") for name in grains)


@pytest.fixture
def scheduler() -> Iterator[str]:
    """Start a Dask scheduler, and return its address."""
    pytest.importorskip("distributed")
    with cluster() as (_, address):
        yield address


@contextmanager
def cluster() -> "Iterator[tuple[subprocess.Popen[str], str]]":
    """Start a Dask scheduler, and return it with its address."""
    words = "-m distributed.cli.dask_scheduler --port 0 --host 127.0.0.1 --no-dashboard".split()
    process = subprocess.Popen([sys.executable, *words], stderr=subprocess.PIPE, text=True)
    assert process.stderr is not None
    address = next(match[0] for line in process.stderr if (match := re.search(r"tcp://[\d.]+:\d+", line)))
    yield process, address
    process.terminate()
    process.communicate()


def worker(address: str) -> "subprocess.Popen[bytes]":
    """Start a Dask worker."""
    words = f"-m distributed.cli.dask_worker {address} --nthreads 1 --no-nanny --no-dashboard".split()
    return subprocess.Popen([sys.executable, *words], stderr=subprocess.DEVNULL)


@pytest.mark.slow
@pytest.mark.parametrize("kill", [False, True])
def test_dask_workers_write_the_same_files_as_one_process(
    run: Run, grains: list[str], scheduler: str, *, kill: bool
) -> None:
    for part, name in enumerate(grains):
        Path(name).write_text(random_table(4000, part), encoding="utf-8")
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
        assert re.search(r"^jkroll: \d+ of 20000 rows failed; column status has the reasons\n", message, re.MULTILINE)
    finally:
        for process in workers:
            process.kill()
            process.wait()
    assert whole("forces") == whole("whole")  # without a temporary file of the killed worker


@pytest.mark.slow
@pytest.mark.parametrize("number", [signal.SIGKILL, signal.SIGTERM])
@pytest.mark.parametrize("lost", ["scheduler", "workers"])
def test_a_lost_cluster_is_reported_in_a_line(run: Run, grains: list[str], lost: str, number: int) -> None:
    """Temporary files are removed, and --resume makes the missing files."""
    pytest.importorskip("distributed")
    for part, name in enumerate(grains):
        Path(name).write_text(random_table(1000, part), encoding="utf-8")
    with cluster() as (process, address):
        workers = [worker(address)]
        try:
            batch = subprocess.Popen(
                [sys.executable, "-m", "jkroll", "batch", "grains/*.csv", "-o", "forces/", "--dask", address],
                stderr=subprocess.PIPE,
                text=True,
            )
            while not [*Path("forces").glob(".part-*")]:
                assert batch.poll() is None
            for each in [process] if lost == "scheduler" else workers:
                each.send_signal(number)
            _, message = batch.communicate()
        finally:
            for each in workers:
                each.kill()
                each.wait()
    said = {
        "scheduler": "was lost; --resume converts the remaining tables",
        "workers": "has no worker left; all need this version of jkroll",
    }
    assert message == f"jkroll: --dask: the scheduler at '{address}' {said[lost]}\n"
    assert batch.returncode == 1
    assert not [*Path("forces").glob(".*")]
    assert run("batch", "grains/*.csv", "-o", "forces/", "--resume", "--quiet").code == 1
    assert len([*Path("forces").glob("part-*.csv")]) == PARTS


def test_an_unreachable_scheduler_is_reported_in_a_line(run: Run, grains: list[str]) -> None:
    """The address asks for TLS, and there are no certificates."""
    pytest.importorskip("distributed")
    ran = run("batch", "grains/*.csv", "-o", "forces/", "--dask", "tls://127.0.0.1:1")
    said = "jkroll: --dask: the scheduler at 'tls://127.0.0.1:1' cannot be reached: TLS expects a `ssl_context` "
    assert (ran.code, ran.err.count("\n")) == (2, 1)
    assert ran.err.startswith(said)
    assert len(grains) == PARTS


def test_errors_of_other_processes_are_reported(run: Run, monkeypatch: pytest.MonkeyPatch, grains: list[str]) -> None:
    Path("own.toml").write_text('[materials.own]\nsurface_energy = "25 kg"\n', encoding="utf-8")
    monkeypatch.setattr(command, "LITTLE", 1)
    ran = run("batch", "grains/*.csv", "-o", "forces/", "--jobs", "2", *"--materials own.toml --material own".split())
    said = "own: surface_energy: '25 kg' is a mass; expected a surface energy such as 25mJ/m2"
    lines = [f"jkroll: {name!r}: materials file 'own.toml': {said}" for name in grains]
    assert (ran.code, ran.err.splitlines()) == (2, lines)


def test_processes_that_do_not_start_are_reported_in_a_line(
    run: Run, monkeypatch: pytest.MonkeyPatch, grains: list[str]
) -> None:
    monkeypatch.setattr(command, "LITTLE", 1)
    problem = OSError(errno.EAGAIN, os.strerror(errno.EAGAIN))
    with patch("multiprocessing.context.SpawnProcess.start", side_effect=problem):
        ran = run("batch", "grains/*.csv", "-o", "forces/", "--jobs", "2")
    said = "jkroll: processes cannot be started: Resource temporarily unavailable; --jobs 1 starts none\n"
    assert (ran.code, ran.err) == (1, said)
    assert len(grains) == PARTS
