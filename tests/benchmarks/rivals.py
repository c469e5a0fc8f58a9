"""Compare the speed of `jkroll batch` with that of C++, polars, duckdb, pyarrow, pandas and Python's csv module.

    python tests/benchmarks/rivals.py [ROWS] [NAME...]

Every rival reads the same table and writes the same results; all but jkroll use the formulas in formulas.txt. The
rivals run in turn, three times, and the shortest time by the clock counts for each. polars, duckdb and
pyarrow use a thread for each core, `jkroll` a process for each core, and the other rivals one thread. Memory is the
largest sum of the proportional set sizes of all processes of a run. The comparison needs g++ and the libraries:
`pip install 'jkroll[rivals]'`. The environment variable QUANTITIES=12 limits the results to the first twelve
quantities, and ROUNDS=5 runs each rival five times.
"""

import contextlib
import importlib.util
import math
import os
import resource
import subprocess
import sys
import tempfile
import time
from collections.abc import Sequence
from pathlib import Path
from typing import NamedTuple

HERE = Path(__file__).parent
HEADER = (
    "id,radius [nm],radius2 [nm],surface_energy [mJ/m2],youngs_modulus [GPa],poisson_ratio,density "
    "[g/cm3],yield_displacement [nm],load [nN]"
)
NAMES = [text.split(" ")[0] for text in HEADER.split(",")][1:]
SCALES = dict(zip(NAMES, ("1e-9", "1e-9", "1e-3", "1e9", "1", "1e3", "1e-9", "1e-9"), strict=True))


def formulas() -> list[tuple[str, str]]:
    """Return the name and the expression of each line of formulas.txt."""
    pairs = []
    for line in (HERE / "formulas.txt").read_text(encoding="utf-8").splitlines():
        name, _, expression = line.partition("=")
        pairs.append((name.strip(), expression.strip()))
    return pairs


def results() -> list[str]:
    """Return the default quantities of `jkroll batch` that are in formulas.txt; QUANTITIES=n keeps the first n."""
    from jkroll.report.questions import BY_DEFAULT

    known = {name for name, _ in formulas()}
    names = [name for name in BY_DEFAULT if name in known]
    return names[: int(os.environ.get("QUANTITIES", len(names)))]


def write_table(path: Path, rows: int) -> None:
    """Write a table of random grains: unequal pairs, some of them under tension."""
    import numpy

    draw = numpy.random.default_rng(1)
    ranges = [(10, 1000), (10, 1000), (5, 3000), (1, 300), (0.01, 0.5), (0.5, 9), (0.1, 0.5), (-0.05, 5)]
    with path.open("w", encoding="utf-8") as file:
        file.write(HEADER + "\n")
        for start in range(0, rows, 100_000):
            size = min(100_000, rows - start)
            columns = [numpy.round(draw.uniform(*ends, size), 3).tolist() for ends in ranges]
            file.writelines(
                f"{number},{','.join(map(repr, row))}\n" for number, row in enumerate(zip(*columns, strict=True), start)
            )


def write_parquet(path: Path, table: Path) -> None:
    """Write a table as Parquet, with the default settings of pyarrow."""
    import pyarrow.csv
    import pyarrow.parquet

    pyarrow.parquet.write_table(pyarrow.csv.read_csv(table), path)


def write_cpp(folder: Path) -> Path:
    """Write and build the C++ program, and return its path."""
    lines = [f"const double {name} = {expression};" for name, expression in formulas()]
    lines.append(f"#define RESULTS {', '.join(results())}")
    (folder / "formulas.h").write_text("\n".join(lines) + "\n", encoding="utf-8")
    names = ", ".join(f'",{name}"' for name in results())
    program = folder / "rival"
    options = ["-std=c++17", "-O2", "-I", str(folder), f"-DNAMES={names}"]
    subprocess.run(["g++", *options, str(HERE / "rival.cpp"), "-o", str(program)], check=True)
    return program


def python_source() -> str:
    """Return the source of a Python function that computes the formulas from floats or arrays."""
    steps = "".join(f"    {name} = {expression}\n" for name, expression in formulas())
    return f"def function({', '.join(NAMES)}):\n{steps}    return {', '.join(results())}\n"


CSV_MODULE = """
import csv, sys
from math import cbrt, pi, sqrt
fmin, fmax = min, max
scales = {scales}
{source}
reader, writer = csv.reader(sys.stdin), csv.writer(sys.stdout, lineterminator="\\n")
writer.writerow([*next(reader), *{names}, "status"])
for row in reader:
    writer.writerow([*row, *function(*(float(cell) * scale for cell, scale in zip(row[1:], scales))), ""])
"""
PANDAS = """
import sys
import pandas
from numpy import cbrt, fmax, fmin, pi, sqrt
{source}
table = pandas.read_csv(sys.stdin)
scales = {scales}
columns = [table.iloc[:, index] * scale for index, scale in enumerate(scales, 1)]
for name, values in zip({names}, function(*columns)):
    table[name] = values
table["status"] = ""
table.to_csv(sys.stdout, index=False)
"""
ARRAYS = """
import sys
import numpy
from numpy import cbrt, fmax, fmin, pi, sqrt
{source}
NAMES = {names}
scales = {scales}
def results(columns):
    return function(*(column * scale for column, scale in zip(columns, scales)))
"""
POLARS = (
    ARRAYS
    + """
import polars
def converted(table):
    values = results([column.to_numpy() for column in table.get_columns()[1:]])
    added = [polars.Series(name, column) for name, column in zip(NAMES, values)]
    return table.with_columns(added).with_columns(polars.lit("").alias("status"))
table = polars.scan_csv(sys.argv[1])
schema = {{**table.collect_schema(), **dict.fromkeys(NAMES, polars.Float64), "status": polars.String}}
table.map_batches(converted, streamable=True, schema=schema).sink_csv(sys.argv[2])
"""
)
PYARROW = (
    ARRAYS
    + """
import pyarrow
import pyarrow.csv
writer = None
for batch in pyarrow.csv.open_csv(sys.argv[1]):
    values = results([column.to_numpy() for column in batch.columns[1:]])
    columns = [*batch.columns, *map(pyarrow.array, values), pyarrow.array([""] * len(batch))]
    table = pyarrow.RecordBatch.from_arrays(columns, [*batch.schema.names, *NAMES, "status"])
    writer = writer or pyarrow.csv.CSVWriter(sys.argv[2], table.schema)
    writer.write_batch(table)
writer.close()
"""
)
DUCKDB = """
import sys
import duckdb
duckdb.sql(f"COPY ({query}) TO '{{sys.argv[2]}}' (HEADER)".replace("FROM input", f"FROM read_csv('{{sys.argv[1]}}')"))
"""


def duckdb_query() -> str:
    """Return the formulas as SQL: nested queries, each with one more column."""
    given = ", ".join(
        f'"{text}" * {SCALES[name]} AS {name}' for text, name in zip(HEADER.split(",")[1:], NAMES, strict=True)
    )
    query = f"SELECT *, {given} FROM input"
    for name, expression in formulas():
        words = (
            expression.replace("fmin(", "least(")
            .replace("fmax(", "greatest(")
            .replace("pi ", "pi() ")
            .replace("pi)", "pi())")
        )
        query = f"SELECT *, {words} AS {name} FROM ({query})"
    columns = ", ".join([*(f'"{text}"' for text in HEADER.split(",")), *results()])
    return f"SELECT {columns}, '' AS status FROM ({query})".replace('"', '\\"')


class Rival(NamedTuple):
    """A program to compare; its command reads the table and writes the results to stdout or to a file."""

    name: str
    command: Sequence[str]


def rivals(folder: Path, table: Path) -> list[Rival]:
    """Return the rivals that this machine has."""
    scripts = {"csv module": CSV_MODULE, "pandas": PANDAS, "polars": POLARS, "pyarrow": PYARROW, "duckdb": DUCKDB}
    batch = [sys.executable, "-m", "jkroll", "batch", "--quantities", ",".join(results())]
    found = [
        Rival("jkroll", [*batch, str(table), "-o", str(folder / "jkroll.csv")]),
        Rival("jkroll, 1 process", [*batch, str(table), "-o", str(folder / "one.csv"), "--jobs", "1"]),
        Rival("the same, --no-doubt", [*batch, str(table), "-o", str(folder / "one.csv"), "--jobs", "1", "--no-doubt"]),
    ]
    if importlib.util.find_spec("pyarrow"):
        write_parquet(folder / "grains.parquet", table)
        words = [str(folder / "grains.parquet"), "-o", str(folder / "jkroll.parquet")]
        found.append(Rival("jkroll, Parquet", [*batch, *words]))
    found.append(Rival("C++", [str(write_cpp(folder))]))
    for name, text in scripts.items():
        if name != "csv module" and not importlib.util.find_spec(name):
            continue
        path = folder / f"rival_{name.split()[0]}.py"
        query = duckdb_query() if name == "duckdb" else ""
        scales = f"[{', '.join(SCALES.values())}]"
        source = text.format(source=python_source(), names=results(), query=query, scales=scales)
        path.write_text(source, encoding="utf-8")
        words = [str(table), str(folder / f"{name}.csv")] if name in ("polars", "pyarrow", "duckdb") else []
        found.append(Rival(name, [sys.executable, str(path), *words]))
    return found


class Cost(NamedTuple):
    """The cost of a run: elapsed seconds, CPU seconds, and the largest memory of all processes in MB."""

    clock: float
    processor: float
    memory: float


def run(rival: Rival, folder: Path, table: Path) -> Cost:
    """Run a rival once, and return the cost."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    began = time.monotonic()
    memory = 0.0
    output = folder / f"{rival.name}.csv"
    with table.open("rb") as given, output.with_suffix(".out").open("wb") as out:
        process = subprocess.Popen(rival.command, stdin=given, stdout=out)
        while process.poll() is None:
            memory = max(memory, megabytes(process.pid))
            with contextlib.suppress(subprocess.TimeoutExpired):
                process.wait(0.05)
        if process.returncode:
            raise subprocess.CalledProcessError(process.returncode, rival.command)
    if output.with_suffix(".out").stat().st_size:
        output.with_suffix(".out").replace(output)
    seconds = time.monotonic() - began
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return Cost(seconds, after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime, memory)


def megabytes(process: int) -> float:
    """Return the proportional set size of a process and its descendants in MB; 0 if the kernel does not report one."""
    total = 0.0
    with contextlib.suppress(OSError, StopIteration):
        lines = Path(f"/proc/{process}/smaps_rollup").read_text().splitlines()
        total += next(int(line.split()[1]) for line in lines if line.startswith("Pss:")) / 1024
        for thread in Path(f"/proc/{process}/task").glob("*/children"):
            total += sum(map(megabytes, map(int, thread.read_text().split())))
    return total


def main(words: Sequence[str]) -> None:
    """Measure the rivals, and print a table."""
    rows = int(float(words[0])) if words else 1_000_000
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        table = folder / "grains.csv"
        write_table(table, rows)
        chosen = [rival for rival in rivals(folder, table) if not words[1:] or rival.name in words[1:]]
        best: dict[str, Cost] = {rival.name: Cost(math.inf, math.inf, 0) for rival in chosen}
        for _ in range(int(os.environ.get("ROUNDS", "3"))):
            for rival in chosen:
                taken, before = run(rival, folder, table), best[rival.name]
                best[rival.name] = Cost(
                    min(taken.clock, before.clock),
                    min(taken.processor, before.processor),
                    max(taken.memory, before.memory),
                )
        own = best["jkroll"].clock if "jkroll" in best else math.nan
        print(f"{'rows/s':>12}  {'jkroll is':>16}  {'us of CPU a row':>15}  {'MB':>6}")
        for rival in chosen:
            taken = best[rival.name]
            us = taken.processor / rows * 1e6
            ratio = f"{taken.clock / own:.2f}x as fast"
            print(f"{rows / taken.clock:12,.0f}  {ratio:>16}  {us:15.2f}  {taken.memory:6.0f}  {rival.name}")


if __name__ == "__main__":
    main(sys.argv[1:])
