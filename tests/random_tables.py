"""Tables for the tests: read and write table files, and make random rows."""

import csv
import json
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

ENDS = ("csv", "tsv", "ndjson", "parquet")
_MARKS = {"csv": ",", "tsv": "\t"}


def write_rows(rows: Sequence[Mapping[str, Any]], name: str) -> str:
    """Write rows as a table in the format that the file name ends with; return the name."""
    end = name.rpartition(".")[2]
    if end == "parquet":
        import pyarrow.parquet

        pyarrow.parquet.write_table(pyarrow.Table.from_pylist([*rows]), name)
    elif end == "ndjson":
        Path(name).write_text("".join(json.dumps(row) + "\n" for row in rows), encoding="utf-8")
    else:
        with Path(name).open("w", newline="", encoding="utf-8") as file:
            writer = csv.DictWriter(file, [*rows[0]], delimiter=_MARKS[end], lineterminator="\n")
            writer.writeheader()
            writer.writerows(rows)
    return name


def read_rows(name: str) -> list[dict[str, Any]]:
    """Return the rows of a table; CSV and TSV give texts."""
    end = name.rpartition(".")[2]
    if end == "parquet":
        import pyarrow.parquet

        rows: list[dict[str, Any]] = pyarrow.parquet.read_table(name).to_pylist()
        return rows
    lines = Path(name).read_text(encoding="utf-8").splitlines(keepends=True)
    if end == "ndjson":
        return [json.loads(line) for line in lines]
    return [*csv.DictReader(lines, delimiter=_MARKS[end])]


def random_table(size: int, seed: int) -> str:
    """Return a CSV table of random grains, with empty cells, planes and loads far beyond pull-off."""
    import random

    draw = random.Random(seed)
    lines = [
        "material,radius [nm],material2,radius2 [um],load [nN],yield_displacement,surface_energy [mJ/m2],speed [m/s]"
    ]
    for _ in range(size):
        cells = [
            draw.choice(["quartz", "iron", "gold", "PS", ""]),
            draw.choice(
                [f"{10 ** draw.uniform(-1, 5):.{draw.randint(1, 17)}g}", "100", "1e2", f"{draw.uniform(1, 9):.3f} um"]
            ),
            draw.choice(["", "", "quartz", "graphite"]),
            draw.choice(["", "plane", repr(10 ** draw.uniform(-3, 2))]),
            draw.choice(["", "0", repr(draw.uniform(-5, 20)), "-1e6"]),
            draw.choice(["2 angstrom", "0.1 nm"]),
            draw.choice(["", repr(10 ** draw.uniform(0, 3))]),
            draw.choice(["", repr(draw.uniform(0.1, 9))]),
        ]
        lines.append(",".join(cells))
    return "\n".join(lines) + "\n"


# A program that runs jkroll with small blocks, so that tests can kill a short run at every stage. With --jobs, all
# blocks of a table except the first two go to other processes, but those of Parquet stay in one.
IN_SMALL_BLOCKS = """
import signal
import jkroll.__main__
from jkroll.tables import files, run
from jkroll.model import rows as columns
run.ALONE, files.CHUNK, columns.BLOCK = 2, 1 << 14, 1 << 9
if __name__ == "__main__":
    signal.signal(signal.SIGHUP, signal.SIG_DFL)  # a closed terminal ends the run even under nohup
    jkroll.__main__.run()
"""
