"""Memory of long runs: all processes together, as the kernel counts them (a shared page is divided among them)."""

import contextlib
import os
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import numpy
import pytest

pytestmark = [
    pytest.mark.slow,
    pytest.mark.skipif(not Path("/proc/self/smaps_rollup").exists(), reason="this kernel does not count shared pages"),
]
LIMITS = {"csv": 150, "parquet": 250}  # MB, of all quantities
FEW, MANY = 200_000, 1_000_000
NAMES = ["radius [nm]", "radius2 [nm]", "surface_energy [mJ/m2]", "youngs_modulus [GPa]", "poisson_ratio"]
NAMES += ["density [g/cm3]", "yield_displacement [nm]", "load [nN]"]


def pieces(rows: int) -> Iterator[tuple[str, "numpy.ndarray[tuple[int, ...], numpy.dtype[numpy.float64]]"]]:
    """The columns of a table of random pairs, each with its header."""
    draw = numpy.random.default_rng(1)
    ranges = [(10, 1000), (10, 1000), (5, 3000), (1, 300), (0.01, 0.5), (0.5, 9), (0.1, 0.5), (-0.05, 5)]
    for name, ends in zip(NAMES, ranges, strict=True):
        yield name, numpy.round(draw.uniform(*ends, rows), 3)


def write_csv(rows: int) -> None:
    names, columns = zip(*pieces(rows), strict=True)
    with Path("grains.csv").open("w", encoding="utf-8") as file:
        file.write(",".join(names) + "\n")
        file.writelines(
            f"{','.join(map(repr, row))}\n" for row in zip(*map(numpy.ndarray.tolist, columns), strict=True)
        )


def write_parquet(rows: int) -> None:
    pyarrow, parquet = pytest.importorskip("pyarrow"), pytest.importorskip("pyarrow.parquet")
    parquet.write_table(pyarrow.table(dict(pieces(rows))), "grains.parquet")


def family(process: int) -> Iterator[int]:
    """A process and all that it started."""
    yield process
    for thread in Path(f"/proc/{process}/task").glob("*/children"):
        for child in thread.read_text().split():
            yield from family(int(child))


def megabytes(process: int) -> float:
    """The memory of a process and of all that it started."""
    kilobytes = 0
    for member in family(process):
        lines = Path(f"/proc/{member}/smaps_rollup").read_text().splitlines()
        kilobytes += next(int(line.split()[1]) for line in lines if line.startswith("Pss:"))
    return kilobytes / 1024


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
    write, sizes = (write_parquet, (MANY, 3 * MANY)) if "parquet" in command else (write_csv, (FEW, MANY))
    found: list[float] = []
    for rows in sizes:
        write(rows)
        most, processes = peak(command)
        assert processes >= (1 if "parquet" in command else 3)  # one that reads and writes, and two that work
        found.append(most)
    print(f"{command}: {found[0]:.0f} and {found[1]:.0f} MB")
    assert max(found) < LIMITS["parquet" if "parquet" in command else "csv"]
    assert (
        found[1] < found[0] + 40
    )  # runs of one table differ by 25; the further rows are 50 MB of text, or 130 of numbers
