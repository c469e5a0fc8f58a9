"""Runs that are ended in the middle: whatever ends them, going on gives the same bytes as a run that nobody disturbed.

JKROLL_KILLS=1000 python -m pytest -m slow tests/test_batch_kills.py        as many kills as are asked for
"""

import fcntl
import os
import random
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

from harness import Run
from tables import random_table

KILLS = int(os.environ.get("JKROLL_KILLS", "30"))
BATCH = [sys.executable, "-m", "jkroll", "batch"]


def grains(rows: int) -> str:
    """A table whose rows are quick to compute, but for some."""
    lines = ["radius [nm],load [nN],text"]
    lines += [f"{100 + row % 977},{row % 13 / 10},row {row}" if row % 997 else "0,0,bad" for row in range(rows)]
    return "\n".join(lines) + "\n"


def kill_until_done(command: list[str], draw: random.Random, longest: float, *, whole_group: bool) -> int:
    """Run a command, kill it at a random moment, go on, until it ends by itself; say how often it was killed.

    Each run may take longer than the one before: on a machine that has become slow, too, one gets to its end.
    """
    kills = 0
    while True:
        process = subprocess.Popen([*command, "--resume"], stderr=subprocess.DEVNULL, start_new_session=True)
        try:
            process.wait(draw.uniform(0, longest))
        except subprocess.TimeoutExpired:
            (os.killpg if whole_group else os.kill)(process.pid, signal.SIGKILL)
            process.wait()
            kills += 1
            longest *= 1.1
        else:
            assert process.returncode == 1
            return kills


SWEEP = "yield-force quartz 100nm --load -20nN:20nN:{}:lin"


@pytest.mark.slow
@pytest.mark.parametrize("whole_group", [True, False])
@pytest.mark.parametrize(
    ("words", "end"),
    [
        ("batch grains.csv --material quartz", "csv"),
        ("batch grains.parquet --material quartz", "parquet"),
        (SWEEP.format(200_000), "csv"),
        (SWEEP.format(1_000_000), "parquet"),
    ],
)
def test_kills_lose_nothing(words: str, end: str, *, whole_group: bool) -> None:
    if "grains" in words:  # some pieces of it, of which a kill costs one
        Path("grains.csv").write_text(grains(100_000 if end == "csv" else 600_000), encoding="utf-8")
    if "grains.parquet" in words:
        csv, parquet = pytest.importorskip("pyarrow.csv"), pytest.importorskip("pyarrow.parquet")
        parquet.write_table(csv.read_csv("grains.csv"), "grains.parquet", row_group_size=20_000)
    before = {path.name for path in Path().iterdir()}
    whole, out = Path(f"whole.{end}"), Path(f"out.{end}")
    command = [sys.executable, "-m", "jkroll", *words.split(), "-o"]
    began = time.monotonic()
    assert subprocess.run([*command, whole], capture_output=True).returncode == 1
    taken = time.monotonic() - began
    draw = random.Random(1)
    kills = 0
    while kills < KILLS / 8:
        kills += kill_until_done([*command, out.name], draw, taken * 0.9, whole_group=whole_group)
        assert out.read_bytes() == whole.read_bytes()
        assert {path.name for path in Path().iterdir()} == {*before, out.name, whole.name}
        out.unlink()


def interrupted(command: list[str], how: int) -> int:
    """The exit code of a command that got a signal once something was written."""
    process = subprocess.Popen(command, stderr=subprocess.DEVNULL)
    while not (Path("out.csv.partial").exists() and Path("out.csv.partial").stat().st_size):
        assert process.poll() is None
        time.sleep(0.005)
    process.send_signal(how)
    return process.wait()


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
    Path("grains.csv").write_text(grains(200_000), encoding="utf-8")
    command = ["sh", "-c", f'cat grains.csv | exec {" ".join(BATCH)} - --material quartz -o out.csv "$@"', "sh"]
    process = subprocess.Popen(command, stderr=subprocess.DEVNULL, start_new_session=True)
    while not (Path("out.csv.journal").exists() and Path("out.csv.journal").read_bytes().count(b"\n") > 2):
        assert process.poll() is None
        time.sleep(0.005)
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


def test_a_lost_process_is_noticed() -> None:
    Path("grains.csv").write_text(random_table(3000, 7), encoding="utf-8")
    process = subprocess.Popen(
        [*BATCH, "grains.csv", "-o", "out.csv", "--jobs", "2"], stderr=subprocess.PIPE, text=True
    )
    children = Path(f"/proc/{process.pid}/task/{process.pid}/children")
    while process.poll() is None and not (workers := children.read_text().split()):
        time.sleep(0.005)
    os.kill(int(workers[0]), signal.SIGKILL)
    _, message = process.communicate()
    assert (process.returncode, message) == (
        1,
        "jkroll: a working process was ended by signal 9; nothing is lost: --resume goes on\n",
    )
    assert not Path("out.csv").exists()


@pytest.mark.skipif(sys.platform != "linux", reason="only Linux tells a process that its parent was ended")
def test_no_process_outlives_the_one_that_started_it() -> None:
    """In the middle of a block that takes long, too."""
    Path("grains.csv").write_text(random_table(3000, 7), encoding="utf-8")
    process = subprocess.Popen([*BATCH, "grains.csv", "-o", "out.csv", "--jobs", "2"], stderr=subprocess.DEVNULL)
    children = Path(f"/proc/{process.pid}/task/{process.pid}/children")
    while process.poll() is None and len(workers := children.read_text().split()) < 2:
        time.sleep(0.005)
    os.kill(process.pid, signal.SIGKILL)
    process.wait()
    time.sleep(0.1)
    assert not [worker for worker in workers if "Z" not in _state_of(worker)]


def _state_of(process: str) -> str:
    """As in `ps`: Z of one that has ended."""
    try:
        return Path(f"/proc/{process}/stat").read_text().rpartition(")")[2].split()[0]
    except OSError:
        return "Z"


def test_a_run_that_waited_leaves_alone_what_was_finished_meanwhile(run: Run, monkeypatch: pytest.MonkeyPatch) -> None:
    """The lock stays with the file when it gets its name: whoever waited for it begins another."""
    Path("grains.csv").write_text("radius [nm],material\n100,quartz\n", encoding="utf-8")
    other = os.open("out.csv.partial", os.O_RDWR | os.O_CREAT)
    fcntl.flock(other, fcntl.LOCK_EX)
    os.write(other, b"of another run")

    def finish(_: float) -> None:
        os.rename("out.csv.partial", "finished.csv")
        os.close(other)

    monkeypatch.setattr("jkroll.batch.output.time.sleep", finish)
    assert run("batch", "grains.csv", "-o", "out.csv", "--jobs", "1").code == 0
    assert Path("finished.csv").read_bytes() == b"of another run"
    assert Path("out.csv").read_text(encoding="utf-8").startswith("radius [nm],material,pull_off_force [N]")
