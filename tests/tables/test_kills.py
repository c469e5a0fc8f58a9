"""Interrupted runs: however a run ends, its file is complete, unchanged or absent."""

import contextlib
import json
import os
import random
import re
import signal
import subprocess
import sys
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any
from unittest.mock import patch

import pytest

from harness import Run
from jkroll.write.output_file import whole_file
from random_tables import IN_SMALL_BLOCKS, random_table

BATCH = [sys.executable, "-m", "jkroll", "batch"]


def grains(rows: int) -> str:
    """Return a table of rows that are quick to compute, with some bad rows."""
    lines = ["radius [nm],load [nN],text"]
    lines += [f"{100 + row % 977},{row % 13 / 10},row {row}" if row % 997 else "0,0,bad" for row in range(rows)]
    return "\n".join(lines) + "\n"


def wait_until(condition: Callable[[], Any], process: "subprocess.Popen[Any]") -> None:
    """Wait until a condition is met or a process has ended."""
    while process.poll() is None and not condition():
        with contextlib.suppress(subprocess.TimeoutExpired):
            process.wait(0.002)


SWEEP = "yield-force quartz 100nm --load -20nN:20nN:20000:lin"


def tables() -> None:
    """Write tables, and a script that runs jkroll with small blocks."""
    Path("small.py").write_text(IN_SMALL_BLOCKS)
    Path("grains.csv").write_text(grains(4_000), encoding="utf-8")
    lines = [{"radius [nm]": 100 + row % 977 if row % 997 else 0, "text": f"row {row}"} for row in range(4_000)]
    Path("grains.ndjson").write_text("".join(json.dumps(line) + "\n" for line in lines))


def begun(target: str) -> list[Path]:
    """Return the temporary files that runs have begun for a target."""
    return [*Path().glob(f".{target}.*")]


@pytest.mark.parametrize("whole_group", [True, pytest.param(False, marks=pytest.mark.slow)])
@pytest.mark.parametrize(
    ("words", "end", "kills"),
    [
        ("batch grains.csv --material quartz", "csv", 1),
        pytest.param("batch grains.csv --material quartz", "csv", 30, marks=pytest.mark.slow),
        pytest.param("batch grains.ndjson --material quartz", "ndjson", 30, marks=pytest.mark.slow),
        pytest.param(SWEEP, "csv", 30, marks=pytest.mark.slow),
        pytest.param(SWEEP, "ndjson", 30, marks=pytest.mark.slow),
    ],
)
def test_a_kill_leaves_no_partial_file(words: str, end: str, kills: int, *, whole_group: bool) -> None:
    """The target is complete, unchanged or absent, and a later run leaves the temporary file alone."""
    tables()
    command = [sys.executable, "small.py", *words.split(), "-o"]
    whole, out = Path(f"whole.{end}"), Path(f"out.{end}")
    began = time.monotonic()
    assert subprocess.run([*command, whole], capture_output=True).returncode == 1
    taken = time.monotonic() - began
    before = {*os.listdir(), "__pycache__"}
    draw = random.Random(1)
    killed = 0
    for number in range(kills):
        if number % 2:
            out.write_text("of before", encoding="utf-8")
        process = subprocess.Popen([*command, out], stderr=subprocess.DEVNULL, start_new_session=True)
        try:
            process.wait(draw.uniform(0.1, taken))
        except subprocess.TimeoutExpired:
            (os.killpg if whole_group else os.kill)(process.pid, signal.SIGKILL)
            process.wait()
            killed += 1
            texts = [whole.read_bytes(), *([b"of before"] if number % 2 else [])]
            assert out.read_bytes() in texts if out.exists() else not number % 2
        else:
            assert out.read_bytes() == whole.read_bytes()
        assert len(begun(out.name)) <= killed
        out.unlink(missing_ok=True)
    left = {path: path.read_bytes() for path in begun(out.name)}
    assert {*os.listdir()} <= before | {path.name for path in left}
    assert subprocess.run([*command, out], capture_output=True).returncode == 1
    assert out.read_bytes() == whole.read_bytes()
    assert {path: path.read_bytes() for path in begun(out.name)} == left


@pytest.mark.parametrize(
    ("words", "number"),
    [
        ("batch grains.csv --material quartz --jobs 1", signal.SIGINT),
        ("batch grains.csv --material quartz --jobs 1", signal.SIGTERM),
        (SWEEP, signal.SIGINT),
        (SWEEP, signal.SIGHUP),
    ],
)
def test_an_interrupted_run_leaves_no_file(words: str, number: int) -> None:
    tables()
    before = {*os.listdir(), "__pycache__"}
    while True:
        command = [sys.executable, "small.py", *words.split(), "-o", "out.csv"]
        process = subprocess.Popen(command, stderr=subprocess.PIPE, text=True)
        wait_until(lambda: any(path.stat().st_size for path in begun("out.csv")), process)
        process.send_signal(number)
        _, message = process.communicate()
        if process.returncode == -number:
            break
        assert process.returncode == 1  # the run was done before the signal came
        Path("out.csv").unlink()
    assert re.fullmatch(r"read: .*\n(?:assumed: .*\n)?" if "batch" in words else "", message)
    assert {*os.listdir()} <= before


def started_by(process: "subprocess.Popen[Any]") -> list[str]:
    """Return the ids of the processes that a run has started to convert blocks."""
    children = Path(f"/proc/{process.pid}/task/{process.pid}/children")
    found: list[str] = []

    def is_at_work() -> bool:
        commands = {child: Path(f"/proc/{child}/cmdline").read_bytes() for child in children.read_text().split()}
        found[:] = [child for child, command in commands.items() if b"spawn_main" in command]
        return len(found) == 2

    with contextlib.suppress(OSError):
        wait_until(is_at_work, process)
    return found


# A process with this code gets a signal right after it has started another process. OpenBLAS has one thread, as under
# `jkroll.__main__.run`: a second thread would receive a signal that the first thread blocks.
STRUCK = """
import os
from multiprocessing import util
os.environ["OPENBLAS_NUM_THREADS"], spawn = "1", util.spawnv_passfds
def struck(program, words, files):
    child = spawn(program, words, files)
    if "spawn_main" in str(words): os.kill(os.getpid(), {:d})
    return child
util.spawnv_passfds = struck
"""


def in_two_processes(path: str, target: str, begin: str = "") -> "subprocess.Popen[str]":
    """Start a run in two processes; `begin` is Python code to execute first."""
    Path("small.py").write_text(begin + IN_SMALL_BLOCKS)
    command = [sys.executable, "small.py", "batch", path, "-o", target, "--material", "quartz", "--jobs", "2"]
    return subprocess.Popen(command, stderr=subprocess.PIPE, text=True)


@pytest.mark.skipif(sys.platform != "linux", reason="processes are found in /proc")
def test_the_loss_of_a_worker_process_is_reported() -> None:
    Path("grains.csv").write_text(grains(100_000), encoding="utf-8")
    process = in_two_processes("grains.csv", "out.csv")
    workers = started_by(process)
    os.kill(int(workers[0]), signal.SIGKILL)
    _, message = process.communicate()
    assert (process.returncode, message.splitlines(keepends=True)[-1]) == (
        1,
        "jkroll: a worker process was ended from outside; its table was not written\n",
    )
    assert not Path("out.csv").exists()
    assert not begun("out.csv")


@pytest.mark.skipif(sys.platform != "linux", reason="processes are found in /proc")
def test_the_temporary_file_of_a_lost_process_is_removed() -> None:
    """A temporary file of another run stays."""
    Path("grains").mkdir()
    Path("forces").mkdir()
    Path("forces/.0.csv.0123456789abcdef").write_text("another's", encoding="utf-8")
    for number in range(4):
        Path(f"grains/{number}.csv").write_text(random_table(5_000, number), encoding="utf-8")
    with in_two_processes("grains/*.csv", "forces/") as process:
        workers = started_by(process)
        wait_until(lambda: len([*Path("forces").glob(".*.csv.*")]) == 3, process)
        os.kill(int(workers[0]), signal.SIGKILL)
        _, message = process.communicate()
    assert (process.returncode, message) == (
        1,
        "jkroll: a worker process was ended from outside; its table was not written\n",
    )
    assert [path.name for path in Path("forces").glob(".*")] == [".0.csv.0123456789abcdef"]


def test_an_interrupt_of_many_tables_leaves_only_complete_files() -> None:
    Path("grains").mkdir()
    for number in range(30):
        Path(f"grains/{number:02}.csv").write_text(grains(2_000), encoding="utf-8")
    with in_two_processes("grains/*.csv", "forces/") as process:
        wait_until(lambda: len([*Path("forces").glob("[0-9]*.csv")]) > 2, process)
        process.send_signal(signal.SIGINT)
        _, message = process.communicate()
    assert (process.returncode, message) == (-signal.SIGINT, "")
    left = {path.name: path.read_text(encoding="utf-8") for path in Path("forces").iterdir()}
    assert {name: len(text.splitlines()) for name, text in left.items()} == dict.fromkeys(left, 2_001)
    assert 2 < len(left) < 30


@pytest.mark.parametrize(
    "number", [signal.SIGINT, *(pytest.param(each, marks=pytest.mark.slow) for each in (signal.SIGTERM, signal.SIGHUP))]
)
def test_a_signal_while_processes_start_ends_the_run_silently(number: int) -> None:
    Path("grains.csv").write_text(grains(20_000), encoding="utf-8")
    with in_two_processes("grains.csv", "out.csv", STRUCK.format(number)) as process:
        _, message = process.communicate()
    assert process.returncode == -number, message
    assert re.fullmatch(r"read: .*\nassumed: .*\n", message)
    assert {*os.listdir()} == {"grains.csv", "small.py"}


@pytest.mark.skipif(sys.platform != "linux", reason="processes are found in /proc")
def test_no_process_outlives_its_parent() -> None:
    """The processes are in the middle of large files when their parent is killed. A resumed run is not affected."""
    Path("grains").mkdir()
    small, large = grains(3), random_table(5_000, 7)
    for number in range(12):
        Path(f"grains/{number:02}.csv").write_text(small if number < 9 else large, encoding="utf-8")
    with in_two_processes("grains/*.csv", "forces/") as process:
        workers = started_by(process)
        wait_until(lambda: len([*Path("forces").glob(".09.csv.*"), *Path("forces").glob(".10.csv.*")]) == 2, process)
        process.kill()
    for number in range(9, 12):
        Path(f"grains/{number:02}.csv").write_text(small, encoding="utf-8")
    command = [*BATCH, "grains/*.csv", "-o", "forces/", "--material", "quartz", "--jobs", "1", "--resume"]
    assert subprocess.run(command, capture_output=True).returncode == 1
    assert [len(path.read_text().splitlines()) for path in Path("forces").glob("*.csv")] == [4] * 12
    assert [_state_of(worker) for worker in workers] == ["Z", "Z"]


def _state_of(process: str) -> str:
    """Return the state of a process as `ps` shows it: Z for a process that has ended."""
    try:
        return Path(f"/proc/{process}/stat").read_text().rpartition(")")[2].split()[0]
    except OSError:
        return "Z"


@pytest.mark.slow
def test_two_runs_replace_a_file_one_after_the_other(run: Run) -> None:
    """Each run writes its own temporary file until the run is done."""
    Path("grains.csv").write_text("radius [nm],material\n100,quartz\n", encoding="utf-8")
    command = [*BATCH, "-", "-o", "out.csv"]
    process = subprocess.Popen(command, stdin=subprocess.PIPE, stderr=subprocess.PIPE)
    assert process.stdin is not None
    process.stdin.write(b"radius [nm],material\n" + b"50,iron\n" * 100_000)
    process.stdin.flush()
    wait_until(lambda: begun("out.csv"), process)
    assert run("batch", "grains.csv", "-o", "out.csv").code == 0
    assert len(Path("out.csv").read_bytes().splitlines()) == 2
    process.stdin.close()
    assert process.wait() == 0
    assert process.stderr is not None
    process.stderr.close()
    assert len(Path("out.csv").read_bytes().splitlines()) == 100_001
    assert not begun("out.csv")


def test_a_failed_run_leaves_the_old_file(run: Run) -> None:
    Path("grains.csv").write_text("radius [nm],material\n100,quartz\n0,quartz\n", encoding="utf-8")
    Path("out.csv").write_text("mine", encoding="utf-8")
    assert run("batch", "grains.csv", "-o", "out.csv", "--strict").code == 1
    assert Path("out.csv").read_text(encoding="utf-8") == "mine"
    assert {*os.listdir()} == {"grains.csv", "out.csv"}


def test_a_replaced_file_keeps_its_link_and_permissions(run: Run) -> None:
    Path("grains.csv").write_text("radius [nm],material\n100,quartz\n", encoding="utf-8")
    Path("real.csv").write_text("", encoding="utf-8")
    Path("real.csv").chmod(0o640)
    Path("link.csv").symlink_to("real.csv")
    assert run("batch", "grains.csv", "-o", "link.csv").code == 0
    assert Path("link.csv").is_symlink()
    assert Path("real.csv").stat().st_mode & 0o777 == 0o640
    assert Path("real.csv").read_text(encoding="utf-8").startswith("radius [nm],material,")


def test_a_temporary_file_never_replaces_an_existing_file() -> None:
    """Two runs may draw the same name, and an existing file of this name may be a link to any other file."""
    with whole_file("out.csv") as first, whole_file("out.csv") as second:
        first.write(b"first\n")
        second.write(b"second\n")
        assert len(begun("out.csv")) == 2
    assert Path("out.csv").read_bytes() == b"first\n"  # the file that was closed last
    Path("kept").write_bytes(b"kept")
    Path(".out.csv.00000000").symlink_to("kept")
    with patch("os.urandom", return_value=bytes(4)), pytest.raises(FileExistsError), whole_file("out.csv"):
        pass
    assert Path(".out.csv.00000000").read_bytes() == b"kept"
