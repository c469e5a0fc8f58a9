"""Fixtures for all tests: they call the command line in this process, without the user's own files."""

import gc
import os
import secrets
import sys
import tempfile
from pathlib import Path

import pytest
from hypothesis import HealthCheck, settings

from harness import Ran, Run, Stream
from jkroll.cli.process import main

# The files that only Linux can run, and what each needs of it; CONTRIBUTING has the same table.
ON_LINUX = {
    "cli/test_command_lines.py": "limits of memory",
    "cli/test_completion.py": "shells on terminals of their own",
    "cli/test_faults.py": "limits of files, pipes and signals",
    "cli/test_hostile.py": "limits of memory",
    "cli/test_shells.py": "bash",
    "invariants.py": "limits of memory",
    "shells.py": "terminals of their own",
    "tables/test_batch.py": "pipes, links and devices such as /dev/full",
    "tables/test_kills.py": "signals, and what /proc says of processes",
    "tables/test_memory.py": "what /proc says of memory",
    "tables/test_parts.py": "signals and /dev/full",
    "tables/test_rivals.py": "what the kernel says of finished processes",
    "terminal.py": "terminals of their own",
    "test_install.py": "the folders of a virtual environment on POSIX",
    "test_explorer.py": "a browser, and terminals of their own",
    "test_prompt.py": "a browser, and terminals of their own",
    "test_site.py": "a browser, and terminals of their own",
}
collect_ignore = [] if sys.platform == "linux" else [*ON_LINUX]

# Hypothesis tries the same examples in every run. They have no time limit, so that no test fails because a machine is
# busy. tests/tools/fuzz.py looks for new examples.
settings.register_profile(
    "same", max_examples=50, deadline=None, derandomize=True, suppress_health_check=[HealthCheck.too_slow]
)
settings.load_profile("same")


def pytest_configure() -> None:
    """Choose one seed for the slow random tests in all processes, and let processes keep compiled modules.

    Garbage is collected far less often, since each collection goes through all objects of pytest.
    """
    gc.set_threshold(20_000)
    os.environ.pop("PYTHONDONTWRITEBYTECODE", None)
    os.environ.setdefault("ACCURACY_SEED", str(secrets.randbelow(10**9)))


def pytest_report_header() -> str:
    """Return the seed for the header of the run, so that a failure can be repeated."""
    return f"ACCURACY_SEED={os.environ['ACCURACY_SEED']}"


@pytest.fixture
def tmp_path(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Make a new folder. Pytest's own fixture first lists thousands of earlier folders, to number the new one."""
    return Path(tempfile.mkdtemp(dir=tmp_path_factory.getbasetemp()))


@pytest.fixture(autouse=True)
def _alone(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    """Isolate a test: no configuration or variables of the user for jkroll, a new directory, and 80 columns."""
    monkeypatch.setenv("XDG_CONFIG_HOME", str(tmp_path / "configuration"))
    for name in ("JKROLL_MATERIALS", "FORCE_COLOR", "NO_COLOR", "COLORTERM"):
        monkeypatch.delenv(name, raising=False)
    monkeypatch.setenv("COLUMNS", "80")
    monkeypatch.setenv("LINES", "24")
    monkeypatch.setenv("TERM", "dumb")
    monkeypatch.chdir(tmp_path)


@pytest.fixture
def run(monkeypatch: pytest.MonkeyPatch) -> Run:
    """Run a command line: `run("pull-off quartz 100nm")`, or `run("pull-off", "quartz", "100 nm")`."""

    def call(*words: str, terminal: bool = False, encoding: str = "utf-8", together: bool = False) -> Ran:
        out = Stream(terminal=terminal, encoding=encoding)
        err = out if together else Stream(encoding=encoding)
        with monkeypatch.context() as patch:
            patch.setattr("sys.stdout", out)
            patch.setattr("sys.stderr", err)
            code = main(words[0].split() if len(words) == 1 else list(words))
        return Ran(code, out.text(), "" if together else err.text())

    return call
