"""CPU time and memory that hostile input takes, above the idle process: materials files, texts with units.

    python tests/benchmarks/hostile.py

A table, a row an input: milliseconds of CPU (the least of three), the peak of allocated memory in MB, and what it came
to. The materials files are of 1 MB and, since those are refused by their size, of the largest size that is read.
"""

import re
import sys
import tempfile
import time
import tracemalloc
from collections.abc import Callable
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parents[1]))

from jkroll.errors import JkrollError
from jkroll.materials.library import MAX_BYTES, Materials
from jkroll.quantities.values import parse_quantity, unit_of
from shapes import SHAPES, ordinary

TEXTS = {
    "a number of 1 MB": "9" * 1_000_000 + "nm",
    "spaces of 1 MB": " " * 1_000_000,
    "minus signs of 1 MB": "−" * 1_000_000,
    "a name of 1 MB": "5" + "m" * 1_000_000,
    "brackets of 1 MB": "(" * 1_000_000,
    "powers": "5 " + "ym12 " * 8,
    "an exponent": "1e999 nm",
    "a small exponent": "1e-999 nm",
    "digits": "9" * 76 + "nm",
    "unknown names": "5 " + "abcdefgh " * 8,
    "a long unknown name": "5 " + "kilokilokilokilokilomete",
    "names that pint knows": "5 furlong chain rod hand mile league fathom ell",
    "two readings": "5 m/" + "m m" * 20,
}


def worst(work: Callable[[], object]) -> tuple[float, float, str]:
    """Milliseconds and megabytes that a piece of work takes, and what it came to."""
    outcome = "read"

    def call() -> None:
        nonlocal outcome
        try:
            work()
        except JkrollError as error:
            outcome = str(error)

    times = []
    for _ in range(3):
        start = time.process_time()
        call()
        times.append(time.process_time() - start)
    tracemalloc.start()
    call()
    peak = tracemalloc.get_traced_memory()[1]
    tracemalloc.stop()
    return min(times) * 1e3, peak / 1e6, outcome


def main() -> None:
    """Measure and print."""
    unit_of("furlong", "radius")  # pint's own start, which the first name outside the table pays
    print(f"{'input':40}{'kB':>7}{'ms':>9}{'MB':>8}  came to")
    for name, text in TEXTS.items():
        cpu, peak, outcome = worst(lambda text=text: parse_quantity(text, "radius"))  # type: ignore[misc]
        print(f"{name:40}{len(text.encode()) / 1e3:7.0f}{cpu:9.2f}{peak:8.2f}  {outcome[:60]}")
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "m.toml"
        for size in (1_000_000, MAX_BYTES, MAX_BYTES // 4):
            for name, shape in {"ordinary": ordinary, **SHAPES}.items():
                path.write_bytes(shape(size))
                cpu, peak, outcome = worst(lambda: Materials([path]))
                came_to = re.sub(r"^materials file '[^']*': ", "", outcome)
                print(f"{name:40}{path.stat().st_size / 1e3:7.0f}{cpu:9.2f}{peak:8.2f}  {came_to[:60]}")


if __name__ == "__main__":
    main()
