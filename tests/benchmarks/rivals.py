"""`jkroll batch` against the same work done otherwise: C++, awk, Miller, the csv module, pandas; and with Parquet for CSV.

    python tests/benchmarks/rivals.py [ROWS] [NAME...]

Every rival reads the same table and writes the same columns, by the formulas of formulas.txt. They run in turns, ROUNDS (3)
times; of each the best rate counts, by the clock (a rival has one thread, `jkroll` a process for each core). Needs g++, and
whichever of gawk, mlr, pandas and pyarrow is to be compared.
"""

import importlib.util
import math
import os
import resource
import shutil
import subprocess
import sys
import tempfile
import time
from collections.abc import Sequence
from pathlib import Path
from typing import NamedTuple

HERE = Path(__file__).parent
HEADER = "id,radius [nm],radius2 [nm],surface_energy [mJ/m2],youngs_modulus [GPa],poisson_ratio,density [g/cm3],yield_displacement [nm],load [nN]"
NAMES = [text.split(" ")[0] for text in HEADER.split(",")][1:]
SCALES = {
    "radius": "/ 1e9",
    "radius2": "/ 1e9",
    "surface_energy": "/ 1e3",
    "youngs_modulus": "* 1e9",
    "poisson_ratio": "* 1",
}
SCALES |= {"density": "* 1e3", "yield_displacement": "/ 1e9", "load": "/ 1e9"}


def formulas() -> list[tuple[str, str]]:
    """Name and expression of every line of formulas.txt."""
    lines = (HERE / "formulas.txt").read_text(encoding="utf-8").splitlines()
    return [(name.strip(), expression.strip()) for name, _, expression in (line.partition("=") for line in lines)]


def results() -> list[str]:
    """The quantities that `jkroll batch` writes of this table."""
    from jkroll.answers.questions import QUESTIONS

    known = {name for name, _ in formulas()}
    return [name for name in QUESTIONS["report"].quantities if name in known]


def write_table(path: Path, rows: int) -> None:
    """A table of random grains: unequal pairs, some of them under tension."""
    import numpy

    draw = numpy.random.default_rng(1)
    ranges = [(10, 1000), (10, 1000), (5, 3000), (1, 300), (0.01, 0.5), (0.5, 9), (0.1, 0.5), (-0.05, 5)]
    with path.open("w", encoding="utf-8") as file:
        file.write(HEADER + "\n")
        for start in range(0, rows, 100_000):
            size = min(100_000, rows - start)
            columns = [numpy.round(draw.uniform(*ends, size), 3).tolist() for ends in ranges]
            file.writelines(
                f"{start + place},{','.join(map(repr, row))}\n" for place, row in enumerate(zip(*columns, strict=True))
            )


def write_parquet(path: Path, table: Path) -> None:
    """The same table as Parquet, as pyarrow writes it if nothing else is said."""
    import pyarrow.csv
    import pyarrow.parquet

    pyarrow.parquet.write_table(pyarrow.csv.read_csv(table), path)


def write_cpp(folder: Path) -> Path:
    """Build the C++ program."""
    lines = [f"const double {name} = {expression};" for name, expression in formulas()]
    lines.append(f"#define RESULTS {', '.join(results())}")
    (folder / "formulas.h").write_text("\n".join(lines) + "\n", encoding="utf-8")
    names = ", ".join(f'",{name}"' for name in results())
    program = folder / "rival"
    command = [
        "g++",
        "-std=c++17",
        "-O2",
        "-I",
        str(folder),
        f"-DNAMES={names}",
        str(HERE / "rival.cpp"),
        "-o",
        str(program),
    ]
    subprocess.run(command, check=True)
    return program


def awk_program() -> str:
    """The same in awk."""
    given = "".join(f"{name}=${place}{SCALES[name]};" for place, name in enumerate(NAMES, 2))
    steps = "".join(f"{name}={expression};" for name, expression in formulas())
    functions = "function fmin(a,b){return a<b?a:b} function fmax(a,b){return a>b?a:b} function cbrt(a){return a<0?-((-a)^(1/3)):a^(1/3)}"
    header = "".join(f",{name}" for name in results()) + ",status"
    return (
        f'{functions} BEGIN{{FS=OFS=",";OFMT=CONVFMT="%.17g";pi=atan2(0,-1)}} NR==1{{print $0 "{header}";next}}'
        f'{{{given}{steps}print $0,{",".join(results())},""}}'
    )


def miller_program() -> str:
    """The same in Miller's language."""
    given = "".join(f"num {name}=$[[[{place}]]]{SCALES[name]};" for place, name in enumerate(NAMES, 2))
    steps = "".join(f"num {name}={expression};" for name, expression in formulas() if name not in NAMES)
    steps = steps.replace("fmin(", "min(").replace("fmax(", "max(").replace("pi ", "M_PI ").replace("pi)", "M_PI)")
    return given + steps + "".join(f"${name}={name};" for name in results()) + '$status=""'


def python_source() -> str:
    """The formulas as a Python function of floats or arrays."""
    steps = "".join(f"    {name} = {expression}\n" for name, expression in formulas())
    return f"def function({', '.join(NAMES)}):\n{steps}    return {', '.join(results())}\n"


CSV_MODULE = """
import csv, sys
from math import cbrt, pi, sqrt
fmin, fmax = min, max
{source}
reader, writer = csv.reader(sys.stdin), csv.writer(sys.stdout, lineterminator="\\n")
writer.writerow([*next(reader), *{names}, "status"])
for row in reader:
    radius, radius2, gamma, young, poisson, density, xi, load = map(float, row[1:])
    writer.writerow([*row, *function(radius / 1e9, radius2 / 1e9, gamma / 1e3, young * 1e9, poisson, density * 1e3, xi / 1e9, load / 1e9), ""])
"""
PANDAS = """
import sys
import pandas
from numpy import cbrt, fmax, fmin, pi, sqrt
{source}
table = pandas.read_csv(sys.stdin)
scales = [1e-9, 1e-9, 1e-3, 1e9, 1, 1e3, 1e-9, 1e-9]
columns = [table.iloc[:, place + 1] * scale for place, scale in enumerate(scales)]
for name, values in zip({names}, function(*columns)):
    table[name] = values
table["status"] = ""
table.to_csv(sys.stdout, index=False)
"""


class Rival(NamedTuple):
    """A way to do the work: its command, which reads the table and writes it to stdout or to a file of its own."""

    name: str
    command: Sequence[str]


def rivals(folder: Path, table: Path) -> list[Rival]:
    """Those that this machine has."""
    scripts = {"csv module": CSV_MODULE, "pandas": PANDAS}
    batch = [sys.executable, "-m", "jkroll", "batch"]
    found = [
        Rival("jkroll", [*batch, str(table), "-o", str(folder / "jkroll.csv")]),
        Rival("jkroll, 1 process", [*batch, str(table), "-o", str(folder / "one.csv"), "--jobs", "1"]),
    ]
    if importlib.util.find_spec("pyarrow"):
        write_parquet(folder / "grains.parquet", table)
        words = [str(folder / "grains.parquet"), "-o", str(folder / "jkroll.parquet")]
        found.append(Rival("jkroll, Parquet", [*batch, *words]))
    found.append(Rival("C++", [str(write_cpp(folder))]))
    for program, words in (
        ("gawk", ["gawk", awk_program()]),
        ("mlr", ["mlr", "--icsv", "--ocsv", "put", miller_program()]),
    ):
        if shutil.which(program):
            found.append(Rival(program, words))
    for name, text in scripts.items():
        if name == "pandas" and not importlib.util.find_spec("pandas"):
            continue
        path = folder / f"rival_{name.split()[0]}.py"
        path.write_text(text.format(source=python_source(), names=results()), encoding="utf-8")
        found.append(Rival(name, [sys.executable, str(path)]))
    return found


def run(rival: Rival, folder: Path, table: Path) -> tuple[float, float]:
    """Seconds by the clock and of all processors that one run takes."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    began = time.monotonic()
    with table.open("rb") as given, (folder / f"{rival.name}.csv").open("wb") as out:
        subprocess.run(rival.command, stdin=given, stdout=out, check=True)
    seconds = time.monotonic() - began
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return seconds, after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def main(words: Sequence[str]) -> None:
    """Measure, and print a table."""
    rows = int(float(words[0])) if words else 1_000_000
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        table = folder / "grains.csv"
        write_table(table, rows)
        chosen = [rival for rival in rivals(folder, table) if not words[1:] or rival.name in words[1:]]
        clock: dict[str, float] = {rival.name: math.inf for rival in chosen}
        cpu = dict(clock)
        for _ in range(int(os.environ.get("ROUNDS", "3"))):
            for rival in chosen:
                seconds, used = run(rival, folder, table)
                clock[rival.name] = min(clock[rival.name], seconds)
                cpu[rival.name] = min(cpu[rival.name], used)
        own = clock.get("jkroll", math.nan)
        print(f"{'rows/s':>12}  {'jkroll is':>10}  {'us of CPU a row':>15}")
        for rival in chosen:
            taken = clock[rival.name]
            print(f"{rows / taken:12,.0f}  {taken / own:9.2f}x  {cpu[rival.name] / rows * 1e6:15.2f}  {rival.name}")


if __name__ == "__main__":
    main(sys.argv[1:])
