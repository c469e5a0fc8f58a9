"""Memory of long runs: all processes together, as the kernel counts them (a shared page is divided among them)."""

import contextlib
import os
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest

from benchmarks.rivals import megabytes, write_parquet, write_table

pytestmark = [
    pytest.mark.slow,
    pytest.mark.skipif(not Path("/proc/self/smaps_rollup").exists(), reason="this kernel does not count shared pages"),
]
LIMITS = {"csv": 150, "parquet": 250}  # MB, of all quantities
FEW, MANY = 200_000, 1_000_000


def family(process: int) -> Iterator[int]:
    """A process and all that it started."""
    yield process
    for thread in Path(f"/proc/{process}/task").glob("*/children"):
        for child in thread.read_text().split():
            yield from family(int(child))


def peak(command: str) -> tuple[float, int]:
    """The most memory that a run took, in MB, and the most processes that were seen."""
    process = subprocess.Popen(["sh", "-c", command], env={**os.environ, "PYTHON": sys.executable})
    most, processes = 0.0, 0
    while process.poll() is None:
        try:
            most, processes = max(most, megabytes(process.pid)), max(processes, len([*family(process.pid)]))
        except (OSError, StopIteration):
            pass  # one of them has just ended
        with contextlib.suppress(subprocess.TimeoutExpired):
            process.wait(0.02)
    assert process.returncode == 0
    return most, processes


BATCH = 'exec "$PYTHON" -m jkroll batch --quiet --jobs 2'


@pytest.mark.parametrize(
    "command",
    [
        f"{BATCH} grains.csv -o out.csv",
        f"cat grains.csv | ({BATCH} - -o out.csv)",
        f"cat grains.csv | ({BATCH} -) | cat > out.csv",
        f"{BATCH} grains.parquet -o out.parquet",
    ],
)
def test_memory_does_not_grow_with_rows(command: str) -> None:
    # Parquet is read by its groups of rows: of a million, if nothing else is asked.
    found: list[float] = []
    for rows in (MANY, 3 * MANY) if "parquet" in command else (FEW, MANY):
        write_table(Path("grains.csv"), rows)
        if "parquet" in command:
            pytest.importorskip("pyarrow")
            write_parquet(Path("grains.parquet"), Path("grains.csv"))
        most, processes = peak(command)
        assert processes >= (1 if "parquet" in command else 3)  # one that reads and writes, and two that work
        found.append(most)
    print(f"{command}: {found[0]:.0f} and {found[1]:.0f} MB")
    assert max(found) < LIMITS["parquet" if "parquet" in command else "csv"]
    assert (
        found[1] < found[0] + 40
    )  # runs of one table differ by 25; the further rows are 50 MB of text, or 130 of numbers
