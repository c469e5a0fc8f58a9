"""Cost of one call: CPU time (user and system) of whole processes, as ratios to a typer program that does nothing.

python tests/benchmarks/startup.py [ROUNDS]

The rival is a typer program with eight empty commands, run by the same interpreter in the same environment and by the
same three-line script as the installer makes. Every program is run once, which fills the caches of disk and bytecode,
then ROUNDS times (30) in turn, so that a slow spell of the machine meets all of them; medians are compared. The
milliseconds are of the machine; the ratios are what lasts. GNU units and qalc are left out where they are not
installed.
"""

import os
import pty
import shutil
import statistics
import sys
import tempfile
from collections.abc import Mapping, Sequence
from pathlib import Path
from types import MappingProxyType
from typing import NamedTuple

SCRIPT = "import sys\nfrom {module} import {function}\nif __name__ == '__main__':\n    sys.exit({function}())\n"

HELLO = "import typer\n\napp = typer.Typer()\n" + "".join(
    f"\n\n@app.command()\ndef {name}() -> None:\n    pass\n"
    for name in "one two three four five six seven eight".split()
)

PINT = """import math, pint
units = pint.UnitRegistry()
gamma, radius = units.Quantity(25, "mJ/m^2"), units.Quantity(100, "nm")
force = 3 * math.pi * gamma * radius / 2
print(force.to("nN").magnitude)
"""

MATERIAL = """[materials.grain{number}]
aliases        = ["G{number}"]
surface_energy = "{number}5 mJ/m2"
youngs_modulus = "5.4e10 Pa"
poisson_ratio  = 0.17
density        = "2.6 g/cm3"
"""

RIVAL = "typer hello-world"
NO_VARIABLES: Mapping[str, str] = MappingProxyType({})


class Program(NamedTuple):
    """A process to be timed: its name, words and variables, and whether it writes to a terminal."""

    name: str
    words: Sequence[str]
    variables: Mapping[str, str] = NO_VARIABLES
    terminal: bool = False


def programs(folder: Path) -> list[Program]:
    """Return the programs that are compared; their files are written to a folder."""
    own = folder / "own.toml"
    own.write_text("".join(MATERIAL.format(number=number) for number in range(1, 51)), encoding="utf-8")
    (folder / "hello_app.py").write_text(HELLO, encoding="utf-8")
    (folder / "hello").write_text(SCRIPT.format(module="hello_app", function="app"), encoding="utf-8")
    (folder / "jkroll").write_text(SCRIPT.format(module="jkroll.__main__", function="run"), encoding="utf-8")
    (folder / "pint_app.py").write_text(PINT, encoding="utf-8")

    def hello(*words: str) -> tuple[str, ...]:
        return (sys.executable, "hello", *words)

    def jkroll(*words: str) -> tuple[str, ...]:
        return (sys.executable, "jkroll", *words)

    def tab(name: str, line: str) -> dict[str, str]:
        variables = {"COMP_WORDS": line.replace(" ", "\n"), "COMP_CWORD": str(line.count(" "))}
        return {f"_{name.upper()}_COMPLETE": "complete_bash", **variables}

    one = ("pull-off", "quartz", "100nm")
    found = [
        Program("python -c pass", (sys.executable, "-c", "pass")),
        Program(RIVAL, hello("one")),
        Program("its --help", hello("--help")),
        Program("its TAB", hello(), tab("hello", "hello o")),
        Program("jkroll pull-off quartz 100nm --bare", jkroll(*one, "--bare")),
        Program("... piped", jkroll(*one)),
        Program("... --json", jkroll(*one, "--json")),
        Program("... --csv", jkroll(*one, "--csv")),
        Program("... on a terminal: a table", jkroll(*one), {"TERM": "xterm-256color"}, terminal=True),
        Program("... of a file of 50 materials", jkroll("pull-off", "G30", "100nm", "--bare", "--materials", str(own))),
        Program("... in a unit that only pint knows", jkroll("pull-off", "quartz", "1e-14furlong", "--bare")),
        Program("jkroll --help", jkroll("--help")),
        Program("jkroll pull-off --help", jkroll("pull-off", "--help")),
        Program("a mistyped option", jkroll(*one, "--laod", "5nN")),
        Program("TAB after a material", jkroll(), tab("jkroll", "jkroll pull-off qu")),
        Program("TAB after a command", jkroll(), tab("jkroll", "jkroll pul")),
        Program("TAB after an option", jkroll(), tab("jkroll", "jkroll pull-off --ga")),
        Program("a pint script of five lines", (sys.executable, "-c", "import pint_app")),
        Program("GNU units", ("units", "-t", "3*pi*25 mJ/m^2*50 nm", "nN")),
        Program("qalc", ("qalc", "-t", "3*pi*25mJ/m^2*50nm to nN")),
    ]
    return [program for program in found if shutil.which(program.words[0])]


def cpu_seconds(program: Program, folder: Path) -> float:
    """Return user and system time of one run; its output is discarded."""
    unwanted = ("PYTHONDONTWRITEBYTECODE", "JKROLL_MATERIALS", "NO_COLOR", "FORCE_COLOR")
    kept = {name: value for name, value in os.environ.items() if name not in unwanted}
    own = {"PYTHONPATH": str(folder), "XDG_CONFIG_HOME": str(folder), "LANG": "C.UTF-8", "COLUMNS": "80"}
    inputs, outputs = pty.openpty() if program.terminal else (-1, os.open(os.devnull, os.O_WRONLY))
    nowhere = os.open(os.devnull, os.O_RDWR)
    pid = os.fork()
    if pid == 0:
        os.chdir(folder)
        for descriptor, source in enumerate((nowhere, outputs, nowhere)):
            os.dup2(source, descriptor)
        os.execvpe(program.words[0], list(program.words), {**kept, **own, **program.variables})
    _, _, usage = os.wait4(pid, 0)
    for descriptor in {inputs, outputs, nowhere} - {-1}:
        os.close(descriptor)
    return usage.ru_utime + usage.ru_stime


def main(rounds: int) -> None:
    """Time all programs in turn and print their medians and ratios."""
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        timed = [(program, list[float]()) for program in programs(folder)]
        for program, _ in timed:
            cpu_seconds(program, folder)
        for _ in range(rounds):
            for program, times in timed:
                times.append(cpu_seconds(program, folder))
    medians = {program.name: statistics.median(times) for program, times in timed}
    print(f"{'':38}{'CPU ms':>8}{'ratio':>8}")
    for name, median in medians.items():
        print(f"{name:38}{median * 1000:8.1f}{median / medians[RIVAL]:8.2f}")


if __name__ == "__main__":
    main(int(sys.argv[1]) if len(sys.argv) > 1 else 30)
