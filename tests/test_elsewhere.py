"""Other systems, as far as Linux can tell: no import and no answer needs what Windows and macOS lack."""

import re
import subprocess
import sys
from pathlib import Path

from conftest import ON_LINUX

ROOT = Path(__file__).parents[1]

# Modules, functions and signals that Windows lacks, and some that macOS lacks. The standard library works without them.
WITHOUT = """
import os, signal, sys
for name in "fcntl grp pty pwd readline resource syslog termios tty".split():
    sys.modules[name] = None
for name in "chown fork forkpty geteuid getpgid getuid killpg mkfifo sched_getaffinity setsid".split():
    delattr(os, name)
for name in "SIGHUP SIGKILL SIGPIPE SIGSTOP SIGTSTP SIGUSR1 SIGWINCH alarm pthread_sigmask sigwait".split():
    delattr(signal, name)
"""
IMPORT = """
import importlib, pkgutil, jkroll
for module in pkgutil.walk_packages(jkroll.__path__, "jkroll."):
    if module.name != "jkroll.__main__":
        importlib.import_module(module.name)
"""
ANSWER = """
from jkroll.cli.process import main
open("grains.csv", "w").write("material,radius [nm]\\nquartz,100\\n")
for line in sys.argv[1:]:
    assert main(line.split()) == 0, line
"""
LINES = (
    "pull-off quartz 100nm --quiet",
    "guide units",
    "pull-off quartz 1nm:1um:20 -o out.csv --quiet",
    "batch grains.csv -o out.csv --quiet",  # replaces the output of the line above
    "batch grains.csv -o a.csv --jobs 2 --quiet",
)


def without_posix(program: str, *words: str) -> None:
    """Run a program in a process without the modules, functions and signals in WITHOUT; it must print no error."""
    ran = subprocess.run([sys.executable, "-c", WITHOUT + program, *words], capture_output=True, text=True)
    assert (ran.returncode, ran.stderr) == (0, ""), ran.stderr


def test_every_module_can_be_imported_without_posix() -> None:
    without_posix(IMPORT)


def test_answers_need_no_posix() -> None:
    without_posix(ANSWER, *LINES)


def test_the_page_for_contributors_lists_the_tests_that_need_linux() -> None:
    text = (ROOT / ".github" / "CONTRIBUTING.md").read_text(encoding="utf-8")
    assert dict(re.findall(r"^\| `tests/(\S+)` \| (.*) \|$", text, re.MULTILINE)) == ON_LINUX
    assert all((ROOT / "tests" / name).exists() for name in ON_LINUX)
