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
from tables import random_table

BATCH = [sys.executable, "-m", "jkroll", "batch"]
# Small blocks, and processes after the first of them: a kill finds every state of a short run.
IN_SMALL_BLOCKS = """
import sys
from jkroll.batch import loop, source, sweep
from jkroll.cli.process import main
loop.ALONE, source.CHUNK, sweep.ROWS = 2, 1 << 14, 1 << 9
if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
"""


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


@pytest.mark.parametrize("whole_group", [True, False])
@pytest.mark.parametrize(
    ("words", "end", "kills"),
    [
        ("batch grains.csv --material quartz", "csv", 2),
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


def refused(command: list[str], *options: str, what: str) -> None:
    """Going on is refused."""
    ran = subprocess.run([*command, "--resume", *options], capture_output=True, text=True)
    said = f"'out.csv.partial' is of a run with another {what}; without --resume it is begun anew"
    assert (ran.returncode, ran.stderr) == (2, f"jkroll: --resume: {said}\n")


def test_an_interrupt_leaves_what_resume_goes_on_from() -> None:
    Path("grains.csv").write_text(grains(40_000), encoding="utf-8")
    command = [*BATCH, "grains.csv", "--material", "quartz", "-o", "out.csv"]
    while (code := interrupted(command, signal.SIGINT)) != 130:
        assert code == 1  # it was done before the signal came
        Path("out.csv").unlink()
    assert not Path("out.csv").exists()
    refused(command, "--xi", "1nm", what="options")
    refused(command, "--quantities", "r_min", what="options")
    about = Path("grains.csv").stat()
    os.utime("grains.csv")
    refused(command, what="input")
    os.utime("grains.csv", ns=(about.st_atime_ns, about.st_mtime_ns))
    assert subprocess.run([*command, "--resume"], capture_output=True).returncode == 1
    assert subprocess.run([*command[:-1], "whole.csv"], capture_output=True).returncode == 1
    assert Path("out.csv").read_bytes() == Path("whole.csv").read_bytes()


def test_a_pipe_is_read_again_up_to_where_it_was() -> None:
    Path("grains.csv").write_text(grains(60_000), encoding="utf-8")
    command = ["sh", "-c", f'cat grains.csv | exec {" ".join(BATCH)} - --material quartz -o out.csv "$@"', "sh"]
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


def in_two_processes(rows: int) -> "subprocess.Popen[str]":
    """A run over random rows that has started its processes."""
    Path("small.py").write_text(IN_SMALL_BLOCKS)
    Path("grains.csv").write_text(random_table(rows, 7), encoding="utf-8")
    command = [sys.executable, "small.py", "batch", "grains.csv", "-o", "out.csv", "--jobs", "2"]
    return subprocess.Popen(command, stderr=subprocess.PIPE, text=True)


@pytest.mark.skipif(sys.platform != "linux", reason="processes are found in /proc")
def test_a_lost_process_is_noticed() -> None:
    process = in_two_processes(3000)
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
    process = in_two_processes(3000)
    workers = started_by(process)
    process.kill()
    process.communicate()
    give_up = time.monotonic() + 20
    while any("Z" not in _state_of(worker) for worker in workers):  # each ends within a block
        assert time.monotonic() < give_up


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


def test_a_damaged_output_is_made_again_from_where_it_is_damaged() -> None:
    """As after a loss of power: the journal is there, and the end of the output is zeros."""
    Path("grains.csv").write_text(grains(40_000), encoding="utf-8")
    command = [*BATCH, "grains.csv", "--material", "quartz", "-o", "out.csv"]
    while interrupted(command, signal.SIGINT) != 130:
        Path("out.csv").unlink()
    with Path("out.csv.partial").open("r+b") as file:
        file.seek(100)
        file.write(b"\0" * 100)
    assert subprocess.run([*command, "--resume"], capture_output=True).returncode == 1
    assert subprocess.run([*command[:-1], "whole.csv"], capture_output=True).returncode == 1
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


def test_resume_after_success_says_that_all_is_done(run: Run) -> None:
    Path("grains.csv").write_text("radius [nm],material\n100,quartz\n", encoding="utf-8")
    assert run("batch grains.csv -o out.csv").code == 0
    before = Path("out.csv").stat().st_mtime_ns
    note = "note: 'out.csv' is whole; without --resume it is made anew\n"
    assert run("batch grains.csv -o out.csv --resume") == (0, "", note)
    assert Path("out.csv").stat().st_mtime_ns == before
