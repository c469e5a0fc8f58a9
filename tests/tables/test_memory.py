"""The memory of all processes of a long run, in which a page that several processes share counts once."""

import sys
from pathlib import Path

import pytest

from benchmarks.rivals import Rival, run, write_parquet, write_table

pytestmark = [
    pytest.mark.slow,
    pytest.mark.skipif(not Path("/proc/self/smaps_rollup").exists(), reason="this kernel does not count shared pages"),
]
LIMITS = {"csv": 150, "parquet": 250}  # MB for a table with all quantities
FEW, MANY = 200_000, 1_000_000
BATCH = f"exec '{sys.executable}' -m jkroll batch --quiet --jobs 2"


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
    # Parquet is read one group of rows at a time, and a group has a million rows: only larger files have several.
    found: list[float] = []
    for rows in (MANY, 3 * MANY) if "parquet" in command else (FEW, MANY):
        write_table(Path("grains.csv"), rows)
        if "parquet" in command:
            pytest.importorskip("pyarrow")
            write_parquet(Path("grains.parquet"), Path("grains.csv"))
        found.append(run(Rival("out", ["sh", "-c", command]), Path(), Path("grains.csv")).memory)
    print(f"{command}: {found[0]:.0f} and {found[1]:.0f} MB")
    assert max(found) < LIMITS["parquet" if "parquet" in command else "csv"]
    # Runs of the same table differ by 25 MB; the additional rows are 50 MB of text, or 130 MB of numbers.
    assert found[1] < found[0] + 40
