"""Command lines by the thousand: each ends with a documented code and says so in one line."""

import resource
from collections import Counter
from collections.abc import Iterator
from pathlib import Path
from random import Random

import pytest

from command_lines import command_line
from invariants import check_call, isolate


def run_many(count: int, seed: int) -> Counter[int]:
    """Check generated command lines; how many ended with which code."""
    source = Random(seed)
    return Counter(check_call(command_line(source)) for _ in range(count))


@pytest.fixture
def _isolated(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[None]:
    limits = resource.getrlimit(resource.RLIMIT_FSIZE)
    for name in ("XDG_CONFIG_HOME", "COLUMNS", "TERM", "JKROLL_MATERIALS", "_JKROLL_COMPLETE", "FORCE_COLOR"):
        monkeypatch.setenv(name, "")  # to be put back
    monkeypatch.chdir(tmp_path)
    isolate(str(tmp_path))
    yield
    resource.setrlimit(resource.RLIMIT_FSIZE, limits)


@pytest.mark.usefixtures("_isolated")
def test_generated_command_lines() -> None:
    codes = run_many(400, seed=1)
    assert min(codes[code] for code in (0, 1, 2)) > 10


@pytest.mark.slow
@pytest.mark.usefixtures("_isolated")
@pytest.mark.parametrize("seed", range(5))
def test_very_many_generated_command_lines(seed: int) -> None:
    run_many(10_000, seed=100 + seed)
