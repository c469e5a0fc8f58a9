"""Runs that are ended in the middle: whatever ends them, going on gives the same bytes as a run that nobody disturbed."""

import contextlib
import fcntl
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

import pytest

from harness import Run
from tables import IN_SMALL_BLOCKS, random_table

BATCH = [sys.executable, "-m", "jkroll", "batch"]


def grains(rows: int) -> str:
    """A table whose rows are quick to compute, but for some."""
    lines = ["radius [nm],load [nN],text"]
    lines += [f"{100 + row % 977},{row % 13 / 10},row {row}" if row % 997 else "0,0,bad" for row in range(rows)]
    return "\n".join(lines) + "\n"


def wait_until(condition: Callable[[], Any], process: "subprocess.Popen[Any]") -> None:
    """Look until a condition holds or a process has ended."""
    while process.poll() is None and not condition():
        with contextlib.suppress(subprocess.TimeoutExpired):
            process.wait(0.002)


def kill_until_done(command: list[str], draw: random.Random, longest: float, *, whole_group: bool) -> int:
    """Run a command, kill it at a random moment, go on, until it ends by itself; say how often it was killed.

    Each run may take longer than the one before: on a machine that has become slow, too, one gets to its end.
    """
    kills = 0
    while True:
        process = subprocess.Popen([*command, "--resume"], stderr=subprocess.DEVNULL, start_new_session=True)
        try:
            process.wait(draw.uniform(0.1, longest))
        except subprocess.TimeoutExpired:
            (os.killpg if whole_group else os.kill)(process.pid, signal.SIGKILL)
            process.wait()
            kills += 1
            longest *= 1.1
        else:
            assert process.returncode in (0, 1)  # 0 if it was killed when all was done
            return kills


SWEEP = "yield-force quartz 100nm --load -20nN:20nN:20000:lin"


@pytest.mark.parametrize("whole_group", [True, pytest.param(False, marks=pytest.mark.slow)])
@pytest.mark.parametrize(
    ("words", "end", "kills"),
    [
        ("batch grains.csv --material quartz", "csv", 1),
        pytest.param("batch grains.csv --material quartz", "csv", 34, marks=pytest.mark.slow),
        pytest.param("batch grains.ndjson --material quartz", "ndjson", 34, marks=pytest.mark.slow),
        pytest.param(SWEEP, "csv", 34, marks=pytest.mark.slow),
    ],
)
def test_kills_lose_nothing(words: str, end: str, kills: int, *, whole_group: bool) -> None:
    Path("small.py").write_text(IN_SMALL_BLOCKS)
    Path("grains.csv").write_text(grains(8_000), encoding="utf-8")
    lines = [{"radius [nm]": 100 + row % 977 if row % 997 else 0, "text": f"row {row}"} for row in range(4_000)]
    Path("grains.ndjson").write_text("".join(json.dumps(line) + "\n" for line in lines))
    whole, out = Path(f"whole.{end}"), Path(f"out.{end}")
    before = {path.name for path in Path().iterdir()}
    command = [sys.executable, "small.py", *words.split(), "-o"]
    began = time.monotonic()
    assert subprocess.run([*command, whole], capture_output=True).returncode == 1
    taken = time.monotonic() - began
    draw = random.Random(1)
    killed = 0
    while killed < kills:
        killed += kill_until_done([*command, out.name], draw, taken * 0.9, whole_group=whole_group)
        assert out.read_bytes() == whole.read_bytes()
        assert {path.name for path in Path().iterdir()} - {"__pycache__"} == {*before, out.name, whole.name}
        out.unlink()


def interrupted(command: list[str], how: int) -> int:
    """The exit code of a command that got a signal once something was written."""
    process = subprocess.Popen(command, stderr=subprocess.PIPE, text=True)
    wait_until(lambda: Path("out.csv.partial").exists() and Path("out.csv.partial").stat().st_size, process)
    process.send_signal(how)
    _, message = process.communicate()
    assert re.fullmatch(r"jkroll: interrupted after \d+ rows; --resume goes on\n", message) or process.returncode == 1
    return process.returncode


def an_interrupted_run(run: Run) -> str:
    """Interrupt a run; return the words that go on with it."""
    Path("small.py").write_text(IN_SMALL_BLOCKS)
    Path("grains.csv").write_text(grains(15_000), encoding="utf-8")
    words = "batch grains.csv --material quartz -o out.csv --jobs 1"
    while (code := interrupted([sys.executable, "small.py", *words.split()], signal.SIGINT)) != 130:
        assert code == 1  # it was done before the signal came
        Path("out.csv").unlink()
    assert not Path("out.csv").exists()
    assert run(words.replace("out.csv", "whole.csv")).code == 1
    return f"{words} --resume"


@pytest.fixture
def small_blocks(monkeypatch: pytest.MonkeyPatch) -> None:
    """Blocks as those of the script."""
    monkeypatch.setattr("jkroll.batch.source.CHUNK", 1 << 14)


@pytest.mark.usefixtures("small_blocks")
def test_an_interrupt_leaves_what_resume_goes_on_from(run: Run) -> None:
    resume = an_interrupted_run(run)

    def refused(*options: str, what: str) -> bool:
        said = f"'out.csv.partial' is of a run with another {what}; without --resume it is begun anew"
        return run(*resume.split(), *options) == (2, "", f"jkroll: --resume: {said}\n")

    assert refused("--xi", "1nm", what="options")
    assert refused("--quantities", "r_min", what="options")
    about = Path("grains.csv").stat()
    os.utime("grains.csv")
    assert refused(what="input")
    os.utime("grains.csv", ns=(about.st_atime_ns, about.st_mtime_ns))
    assert run(resume).code == 1
    assert Path("out.csv").read_bytes() == Path("whole.csv").read_bytes()


def test_a_pipe_is_read_again_up_to_where_it_was() -> None:
    Path("small.py").write_text(IN_SMALL_BLOCKS)
    Path("grains.csv").write_text(grains(10_000), encoding="utf-8")
    command = [
        "sh",
        "-c",
        f'cat grains.csv | exec {sys.executable} small.py batch - --material quartz -o out.csv "$@"',
        "sh",
    ]
    process = subprocess.Popen(command, stderr=subprocess.DEVNULL, start_new_session=True)
    journal = Path("out.csv.journal")
    wait_until(lambda: journal.exists() and journal.read_bytes().count(b"\n") > 2, process)
    os.killpg(process.pid, signal.SIGKILL)
    process.wait()
    text = Path("grains.csv").read_text()
    Path("grains.csv").write_text(text.replace("\n101,", "\n102,", 1))
    ran = subprocess.run([*command, "--resume"], capture_output=True, text=True)
    assert (ran.returncode, "another input" in ran.stderr) == (2, True)
    Path("grains.csv").write_text(text)
    assert subprocess.run([*command, "--resume"], capture_output=True).returncode == 1
    Path("out.csv").rename("resumed.csv")
    assert subprocess.run(command, capture_output=True).returncode == 1
    assert Path("out.csv").read_bytes() == Path("resumed.csv").read_bytes()


def started_by(process: "subprocess.Popen[Any]") -> list[str]:
    """The processes that a run started to convert blocks."""
    children = Path(f"/proc/{process.pid}/task/{process.pid}/children")
    found: list[str] = []

    def is_at_work() -> bool:
        commands = {child: Path(f"/proc/{child}/cmdline").read_bytes() for child in children.read_text().split()}
        found[:] = [child for child, command in commands.items() if b"spawn_main" in command]
        return len(found) == 2

    with contextlib.suppress(OSError):
        wait_until(is_at_work, process)
    return found


def in_two_processes(path: str, target: str) -> "subprocess.Popen[str]":
    """A run that has more to do than a test waits for."""
    Path("small.py").write_text(IN_SMALL_BLOCKS)
    command = [sys.executable, "small.py", "batch", path, "-o", target, "--material", "quartz", "--jobs", "2"]
    return subprocess.Popen(command, stderr=subprocess.PIPE, text=True)


@pytest.mark.skipif(sys.platform != "linux", reason="processes are found in /proc")
def test_a_lost_process_is_noticed() -> None:
    Path("grains.csv").write_text(grains(100_000), encoding="utf-8")
    process = in_two_processes("grains.csv", "out.csv")
    workers = started_by(process)
    os.kill(int(workers[0]), signal.SIGKILL)
    _, message = process.communicate()
    assert (process.returncode, message) == (
        1,
        "jkroll: a working process was ended by signal 9; nothing is lost: --resume goes on\n",
    )
    assert not Path("out.csv").exists()


@pytest.mark.skipif(sys.platform != "linux", reason="processes are found in /proc")
def test_no_process_outlives_the_one_that_started_it() -> None:
    """Each is in the midst of a large file then; going on meets none of them."""
    Path("grains").mkdir()
    small, large = grains(3), random_table(5_000, 7)
    for place in range(12):
        Path(f"grains/{place:02}.csv").write_text(small if place < 9 else large, encoding="utf-8")
    with in_two_processes("grains/*.csv", "forces/") as process:
        workers = started_by(process)
        journals = [Path(f"forces/{place:02}.csv.journal") for place in (9, 10)]
        wait_until(lambda: all(journal.exists() for journal in journals), process)
        process.kill()
    for place in range(9, 12):
        Path(f"grains/{place:02}.csv").write_text(small, encoding="utf-8")
    command = [*BATCH, "grains/*.csv", "-o", "forces/", "--material", "quartz", "--jobs", "1", "--resume"]
    assert subprocess.run(command, capture_output=True).returncode == 1
    assert [len(path.read_text().splitlines()) for path in Path("forces").glob("*.csv")] == [4] * 12
    assert [_state_of(worker) for worker in workers] == ["Z", "Z"]


def _state_of(process: str) -> str:
    """As in `ps`: Z of one that has ended."""
    try:
        return Path(f"/proc/{process}/stat").read_text().rpartition(")")[2].split()[0]
    except OSError:
        return "Z"


def test_two_runs_never_write_the_same_file(run: Run) -> None:
    Path("grains.csv").write_text("radius [nm],material\n100,quartz\n", encoding="utf-8")
    with Path("out.csv.journal").open("w") as other:
        fcntl.flock(other, fcntl.LOCK_EX)
        message = "jkroll: 'out.csv.journal' is being written by another run\n"
        assert run("batch", "grains.csv", "-o", "out.csv") == (2, "", message)
    assert run("batch", "grains.csv", "-o", "out.csv").code == 0


@pytest.mark.usefixtures("small_blocks")
def test_a_damaged_output_is_made_again_from_where_it_is_damaged(run: Run) -> None:
    """As after a loss of power: the journal is there, and the end of the output is zeros."""
    resume = an_interrupted_run(run)
    with Path("out.csv.partial").open("r+b") as file:
        file.seek(100)
        file.write(b"\0" * 100)
    assert run(resume).code == 1
    assert Path("out.csv").read_bytes() == Path("whole.csv").read_bytes()


def test_files_of_the_users_are_left_alone(run: Run) -> None:
    Path("grains.csv").write_text("radius [nm],material\n100,quartz\n", encoding="utf-8")
    for name in ("forces.journal", "forces.partial"):
        Path(name).write_text("mine", encoding="utf-8")
        message = f"'{name}' would be overwritten, and jkroll did not write it; move it away"
        assert run("batch", "grains.csv", "-o", "forces") == (2, "", f"jkroll: -o: {message}\n")
        assert Path(name).read_text(encoding="utf-8") == "mine"
        Path(name).unlink()
    Path("forces.journal").write_text('{"jkroll journal": broken\n1 2 3\n', encoding="utf-8")
    Path("forces.partial").write_text("half", encoding="utf-8")
    assert run("batch", "grains.csv", "-o", "forces", "--resume").code == 0
    Path("real.csv").write_text("", encoding="utf-8")
    Path("real.csv").chmod(0o640)
    Path("link.csv").symlink_to("real.csv")
    assert run("batch", "grains.csv", "-o", "link.csv").code == 0
    assert Path("link.csv").is_symlink()
    assert Path("real.csv").stat().st_mode & 0o777 == 0o640
    assert Path("real.csv").read_text(encoding="utf-8").startswith("radius [nm],material,")


@pytest.mark.parametrize("name", ["out.csv.journal", "out.csv.partial"])
@pytest.mark.parametrize("make", [os.mkfifo, os.mkdir, lambda name: Path(name).symlink_to("grains.csv")])
def test_a_refusal_leaves_nothing_behind(run: Run, name: str, make: Callable[[str], None]) -> None:
    Path("grains.csv").write_text("radius [nm],material\n100,quartz\n", encoding="utf-8")
    make(name)
    assert run("batch", "grains.csv", "-o", "out.csv").code
    assert {*os.listdir()} == {"grains.csv", name}


def test_resume_after_success_says_that_all_is_done(run: Run) -> None:
    Path("grains.csv").write_text("radius [nm],material\n100,quartz\n", encoding="utf-8")
    assert run("batch grains.csv -o out.csv").code == 0
    before = Path("out.csv").stat().st_mtime_ns
    note = "note: 'out.csv' is whole already, made with these options or others; without --resume it is made anew\n"
    assert run("batch grains.csv -o out.csv --resume") == (0, "", note)
    assert Path("out.csv").stat().st_mtime_ns == before
