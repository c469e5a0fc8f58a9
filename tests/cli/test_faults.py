"""Faults outside the process: a call ends with the documented exit code, one line at most, and no partial file."""

import os
import pty
import random
import re
import resource
import select
import signal
import subprocess
import sys
import time
from collections.abc import Callable, Iterable
from pathlib import Path
from typing import Any

import pytest

from harness import Run
from terminal import on_terminal

JKROLL = (sys.executable, "-m", "jkroll")
# Calls that write one line, several lines, one block or several blocks.
WRITERS = {
    "bare": "pull-off quartz 100nm --bare --quiet",
    "plain": "report quartz 100nm --quiet",
    "json": "report quartz 100nm --json",
    "rows": "report quartz 1nm:1um:200 --csv --quiet",
    "explain": "report quartz 100nm --explain",
    "cite": "report quartz 100nm --cite",
    "curve": "contact quartz 100nm --curve --csv",
    "materials": "materials --json",
    "help": "contact --help",
    "version": "--version",
}
SWEEPS = {
    "bare": "pull-off quartz 1nm:1um:1000000 --bare --quiet",
    "csv": "report quartz 1nm:1um:1000000 --csv --quiet",
    "json": "r-min 1nm:1um:100000 --json",
    "explain": "r-min 1nm:1um:100000 --explain",
    "curve": "contact quartz 1nm:1um:10000 --curve --csv --quantities stiffness",
}
ONE_OF_EACH_KIND = ("bare", "rows", "help")
ALL_KINDS = [name if name in ONE_OF_EACH_KIND else pytest.param(name, marks=pytest.mark.slow) for name in WRITERS]
# A program that writes a dot when jkroll begins to handle interrupts; until then, Python itself handles them.
STARTING = """
import signal, sys
from jkroll.__main__ import run
action = signal.signal
def say_so(*arguments):
    before = action(*arguments)
    signal.signal = action
    sys.stderr.write(".")
    sys.stderr.flush()
    return before
signal.signal = say_so
run()
"""


def run(line: str | Iterable[str], **options: object) -> "subprocess.CompletedProcess[bytes]":
    """Run jkroll and return the process. Both streams are captured unless `options` redirect them."""
    words = line.split() if isinstance(line, str) else line
    streams: dict[str, Any] = {"stdout": subprocess.PIPE, "stderr": subprocess.PIPE}
    return subprocess.run([*JKROLL, *words], **(streams | options), check=False, timeout=60)


def in_shell(line: str) -> tuple[int, str]:
    """Return the exit code and the errors of jkroll at the beginning of a line of bash."""
    command = " ".join(JKROLL) + f" {line}; exit ${{PIPESTATUS[0]}}"
    ran = subprocess.run(["bash", "-c", command], capture_output=True, text=True, check=False, timeout=60)
    return ran.returncode, ran.stderr


# --- Where nothing can be written -------------------------------------------------------------------------------------


@pytest.mark.skipif(not os.path.exists("/dev/full"), reason="needs /dev/full")
@pytest.mark.parametrize("what", ALL_KINDS)
def test_a_full_disk_is_reported_in_a_line(what: str) -> None:
    with open("/dev/full", "wb") as full:
        ran = run(WRITERS[what], stdout=full)
        assert (ran.returncode, ran.stderr) == (1, b"jkroll: cannot write: No space left on device\n")


@pytest.mark.skipif(not os.path.exists("/dev/full"), reason="needs /dev/full")
@pytest.mark.parametrize(
    "line", ["pull-off quartz 100nm,200nm -o", "batch grains.csv -o", "figure 3a --data", "batch grains.ndjson -o"]
)
def test_a_full_disk_is_reported_with_the_name_of_the_file(line: str) -> None:
    Path("grains.csv").write_text("radius [nm],material\n100,quartz\n", encoding="utf-8")
    Path("grains.ndjson").write_text('{"radius [nm]": 100, "material": "quartz"}\n', encoding="utf-8")
    ran = run(f"{line} /dev/full")
    assert ran.returncode == 1
    assert ran.stderr.splitlines()[-1] == b"jkroll: cannot write '/dev/full': No space left on device"


@pytest.mark.skipif(not os.path.exists("/dev/full"), reason="needs /dev/full")
def test_a_call_whose_notes_cannot_be_written_fails_but_prints_its_result() -> None:
    with open("/dev/full", "wb") as full:
        ran = run("pull-off quartz 100nm --bare", stderr=full)
        assert (ran.returncode, ran.stdout) == (1, b"1.1780972450961723e-8\n")
        assert run("pull-off quarz", stderr=full).returncode == 2
        assert run("pull-off quartz 100nm", stdout=full, stderr=full).returncode == 1


@pytest.mark.parametrize("what", ONE_OF_EACH_KIND)
def test_a_closed_stdout_is_reported_in_a_line(what: str) -> None:
    assert in_shell(f"{WRITERS[what]} >&-") == (1, "jkroll: cannot write: Bad file descriptor\n")


@pytest.mark.parametrize(("line", "code"), [("pull-off quartz 100nm", 0), ("pull-off quarz 100nm", 2)])
def test_closed_streams_that_are_not_needed_do_not_matter(line: str, code: int) -> None:
    for redirection in ("2>&-", "<&- 2>&-"):
        assert in_shell(f"{line} {redirection}") == (code, "")


@pytest.mark.parametrize("what", SWEEPS)
def test_the_exit_code_is_141_if_the_reader_of_the_output_goes_away(what: str) -> None:
    assert in_shell(f"{SWEEPS[what]} | head -1 >/dev/null") == (141, "")


@pytest.mark.parametrize("what", ONE_OF_EACH_KIND)
def test_the_exit_code_is_141_if_the_reader_of_the_output_is_gone_from_the_start(what: str) -> None:
    reader, writer = os.pipe()
    os.close(reader)
    ran = run(WRITERS[what], stdout=writer)
    os.close(writer)
    assert (ran.returncode, ran.stderr) == (141, b"")


def test_the_exit_code_is_141_if_the_reader_of_the_notes_is_gone() -> None:
    reader, writer = os.pipe()
    os.close(reader)
    ran = run("pull-off quartz 100nm --bare", stderr=writer)
    os.close(writer)
    assert (ran.returncode, ran.stdout) == (141, b"1.1780972450961723e-8\n")


def run_limited(line: str, **options: object) -> "subprocess.CompletedProcess[bytes]":
    """Run jkroll with a limit of 20 kB for each file. Bytecode is not written: it could be cut short."""

    def limit() -> None:
        resource.setrlimit(resource.RLIMIT_FSIZE, (20_000, 20_000))

    return run(line, preexec_fn=limit, env={**os.environ, "PYTHONDONTWRITEBYTECODE": "1"}, **options)


@pytest.mark.parametrize(
    ("line", "name"),
    [
        ("r-min 1nm:1um:1000 -o out.csv", "out.csv"),
        ("report quartz 1nm:1um:1000 -o out.parquet", "out.parquet"),
        ("r-min 1nm:1um:200 -o out.json", "out.json"),
        ("batch gr*.csv -o out/", "out/grains.csv"),
    ],
)
def test_a_file_that_may_not_grow_is_named(line: str, name: str) -> None:
    rows = "".join(f"{radius},quartz\n" for radius in range(1, 1000))
    Path("grains.csv").write_text("radius [nm],material\n" + rows, encoding="utf-8")
    ran = run_limited(line)
    assert ran.returncode == 1
    assert ran.stderr.decode().splitlines()[-1] == f"jkroll: cannot write '{name}': File too large"


def test_output_redirected_to_a_file_that_may_not_grow_is_reported(tmp_path: Path) -> None:
    with (tmp_path / "rows.csv").open("wb") as file:
        ran = run_limited(SWEEPS["csv"], stdout=file)
    assert (ran.returncode, ran.stderr) == (1, b"jkroll: cannot write: File too large\n")


def test_a_call_works_in_a_directory_that_was_removed(tmp_path: Path) -> None:
    (tmp_path / "gone").mkdir()
    command = f"cd gone; rmdir ../gone; {' '.join(JKROLL)} pull-off quartz 100nm --bare --quiet"
    environment = {**os.environ, "PYTHONPATH": str(Path(__file__).parents[2] / "src")}
    ran = subprocess.run(["bash", "-c", command], capture_output=True, text=True, check=False, env=environment)
    assert (ran.returncode, ran.stdout, ran.stderr) == (0, "1.1780972450961723e-8\n", "")


# --- Signals ----------------------------------------------------------------------------------------------------------

BUSY = {
    "a sweep": SWEEPS["bare"],
    "objects": SWEEPS["json"],
    "a unit that pint knows": "pull-off quartz 1nautical_mile:2nautical_mile:1000000 --bare --quiet",
    "a wrong option": "contact quartz 100nm --laod 5nN",
}


def signalled(line: str, number: int, delay: float, stdout: int = subprocess.DEVNULL) -> tuple[int, bytes]:
    """Return the exit code and the errors of jkroll if a signal comes some time after the beginning."""
    words = [sys.executable, "-c", STARTING, *line.split()]
    with subprocess.Popen(words, stdout=stdout, stderr=subprocess.PIPE) as process:
        assert process.stderr is not None
        assert process.stderr.read(1) == b"."
        time.sleep(delay)
        process.send_signal(number)
        _, errors = process.communicate(timeout=30)
    return process.returncode, errors


def interrupt(what: str, times: int, longest: float) -> None:
    """Interrupt a call at random moments, and check its exit code and errors."""
    source = random.Random(what)
    for _ in range(times):
        code, errors = signalled(BUSY[what], signal.SIGINT, source.uniform(0.0, longest))
        if code == 2 or errors:  # the call was faster
            assert errors.startswith(b"jkroll: no such option '--laod'")
            assert errors.count(b"\n") == 1
        assert code == -signal.SIGINT or errors


@pytest.mark.parametrize("what", BUSY)
def test_an_interrupt_at_any_moment_is_silent(what: str) -> None:
    interrupt(what, times=1, longest=0.15)


@pytest.mark.slow
@pytest.mark.parametrize("what", BUSY)
def test_an_interrupt_at_very_many_moments_is_silent(what: str) -> None:
    interrupt(what, times=100, longest=0.4)


@pytest.mark.slow
@pytest.mark.parametrize("number", [signal.SIGTERM, signal.SIGKILL])
def test_other_signals_end_a_call_silently(number: int, tmp_path: Path) -> None:
    """All lines but the last are whole; the system may cut the write that a signal interrupts."""
    source = random.Random(number)
    for _ in range(2):
        with (tmp_path / "rows").open("wb") as file:
            code, errors = signalled(SWEEPS["csv"], number, source.uniform(0.1, 0.6), file.fileno())
        assert (code, errors) == (-number, b"")
        *whole, _ = (tmp_path / "rows").read_bytes().split(b"\n")
        assert len({line.count(b",") for line in whole}) <= 1


# --- A broken configuration -------------------------------------------------------------------------------------------


NO_UTF_8 = "is not text in UTF-8: save it with this encoding"
BROKEN: dict[str, tuple[Callable[[Path], object], str]] = {
    "a directory": (Path.mkdir, "Is a directory"),
    "not UTF-8": (lambda path: path.write_bytes(b"\xff\xfe"), NO_UTF_8),
    "2 MB": (lambda path: path.write_bytes(b"#" * 2_000_000), "is larger than 64 kB"),
    "a loop": (lambda path: path.symlink_to(path), "Too many levels of symbolic links"),
    "a link to nothing": (lambda path: path.symlink_to("nowhere"), "No such file or directory"),
    "/dev/zero": (lambda path: path.symlink_to("/dev/zero"), "is larger than 64 kB"),
    "unreadable": (lambda path: path.touch(mode=0), "Permission denied"),
}


@pytest.mark.parametrize("what", BROKEN)
def test_a_broken_configuration_is_reported_only_by_a_call_that_names_a_material(
    what: str, run: Run, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    make, problem = BROKEN[what]
    if problem == "Permission denied" and os.geteuid() == 0:
        pytest.skip("root may read everything")
    path = tmp_path / "jkroll/materials.toml"
    path.parent.mkdir()
    make(path)
    monkeypatch.setenv("XDG_CONFIG_HOME", str(tmp_path))
    assert run("pull-off quartz 100nm") == (2, "", f"jkroll: materials file '{path}': {problem}\n")
    assert run("r-min 100nm --bare --quiet").code == 0


# --- The environment and the terminal ---------------------------------------------------------------------------------

UTF8 = {"LC_ALL": "C.UTF-8"}
ENVIRONMENTS = {
    "nothing": {},
    "no home": {"HOME": "", **UTF8},
    "a home that is not there": {"HOME": "/nonexistent", **UTF8},
    "a configuration that is not text": {"XDG_CONFIG_HOME": os.fsdecode(b"\xff"), **UTF8},
    "LC_ALL=C, no UTF-8 mode": {"LC_ALL": "C", "PYTHONUTF8": "0", "PYTHONCOERCECLOCALE": "0"},
    "an unknown locale": {"LC_ALL": "zz_ZZ"},
    "cp1252": {"PYTHONIOENCODING": "cp1252"},
    "strict ASCII": {"PYTHONIOENCODING": "ascii:strict"},
    "a comma for a point, and threads": {"LC_NUMERIC": "de_DE.UTF-8", "OMP_NUM_THREADS": "many"},
    "warnings are errors": {"PYTHONWARNINGS": "error", "PYTHONDEVMODE": "1", **UTF8},
}


@pytest.mark.parametrize("what", ENVIRONMENTS)
def test_no_environment_changes_a_number(what: str) -> None:
    ran = run("pull-off quartz 100nm", env=ENVIRONMENTS[what])
    assert ran.returncode == 0
    assert ran.stdout.splitlines()[0] == b"pull_off_force 1.1780972450961723e-8 N"
    assert all(line.startswith((b"note: ", b"assumed: ", b"more: ")) for line in ran.stderr.splitlines())


@pytest.mark.parametrize("columns", ["x", "1", "20"])
def test_no_width_of_a_terminal_cuts_a_number(columns: str) -> None:
    code, screen = on_terminal([*JKROLL, "pull-off", "quartz", "100nm", "--quiet"], COLUMNS=columns, TERM="xterm")
    assert code == 0
    assert "11.78" in screen
    assert "…" not in screen


def test_a_long_list_on_a_terminal_begins_at_once() -> None:
    terminal, end = pty.openpty()
    with subprocess.Popen([*JKROLL, "pull-off", "quartz", "1nm:1um:10000000"], stdout=end, stderr=end) as process:
        begun, *_ = select.select([terminal], [], [], 20)
        head = os.read(terminal, 19) if begun else b""
        process.kill()
    os.close(terminal)
    os.close(end)
    assert head == b"material\tradius [m]"


@pytest.mark.parametrize(
    ("settings", "styled"),
    [
        ({"TERM": "dumb"}, False),
        ({"TERM": "dumb", "FORCE_COLOR": "1"}, False),
        ({"TERM": "nonsense", "PYTHONIOENCODING": "cp1252"}, True),
    ],
)
def test_a_dumb_terminal_gets_no_escape_sequences(settings: dict[str, str], styled: bool) -> None:
    code, screen = on_terminal([*JKROLL, "guide", "promises"], **settings)
    assert code == 0
    assert ("\x1b[" in screen) is styled


def test_the_variable_no_color_turns_off_colours() -> None:
    _, screen = on_terminal([*JKROLL, "guide", "promises"], TERM="xterm-256color", NO_COLOR="1")
    codes = {code for codes in re.findall(r"\x1b\[([\d;]*)m", screen) for code in codes.split(";")}
    assert "1" in codes  # bold
    assert codes <= {"0", "1", "2", "3", "4"}  # normal, bold, dim, italic and underlined


def test_an_unknown_request_for_completion_is_refused() -> None:
    ran = run("r-min 100nm", env={**os.environ, "_JKROLL_COMPLETE": "complete_tcsh"})
    assert ran.returncode == 2
    assert ran.stdout == b""
    assert len(ran.stderr.splitlines()) == 1


def test_an_error_is_broken_into_lines_only_on_a_terminal() -> None:
    """A message to a pipe is one line, since programs read it."""
    words = [*JKROLL, "pull-off", "quarz", "100nm"]
    code, screen = on_terminal(words, COLUMNS="60", TERM="xterm")
    message = subprocess.run(words, capture_output=True, text=True, check=False).stderr
    assert code == 2
    assert len(message.splitlines()) == 1
    assert len(screen.splitlines()) > 1
    assert all(len(line) <= 60 for line in screen.splitlines())
    assert screen.split() == message.split()
