"""Cost of one call: CPU time (user and system) of whole processes, as ratios to a typer program that does nothing.

python tests/benchmarks/startup.py [ROUNDS]

The typer program has eight empty commands. This program and jkroll run with the same interpreter in the same
environment, each by a short script such as an installer writes. Every program runs once, which fills the caches of disk
and bytecode, and then ROUNDS times (30 by default), in turn, so that a slow spell of the machine affects all programs.
Medians are compared. The milliseconds depend on the machine; the ratios hardly do. qalc is left out if it is not
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

RIVAL = "typer hello-world"
NO_VARIABLES: Mapping[str, str] = MappingProxyType({})
COLOURS = {"TERM": "xterm-256color"}


class Program(NamedTuple):
    """A process to be timed: its name, words and variables, and whether it writes to a terminal."""

    name: str
    words: Sequence[str]
    variables: Mapping[str, str] = NO_VARIABLES
    terminal: bool = False


def programs(folder: Path) -> list[Program]:
    """Return the programs to compare, and write their files to a folder."""
    (folder / "hello_app.py").write_text(HELLO, encoding="utf-8")
    (folder / "hello").write_text(SCRIPT.format(module="hello_app", function="app"), encoding="utf-8")
    (folder / "jkroll").write_text(SCRIPT.format(module="jkroll.__main__", function="run"), encoding="utf-8")
    (folder / "pint_app.py").write_text(PINT, encoding="utf-8")

    def python(words: str) -> list[str]:
        return [sys.executable, *words.split()]

    def tab(name: str, line: str) -> dict[str, str]:
        variables = {"COMP_WORDS": line.replace(" ", "\n"), "COMP_CWORD": str(line.count(" "))}
        return {f"_{name.upper()}_COMPLETE": "complete_bash", **variables}

    found = [
        Program("python -c pass", python("-c pass")),
        Program(RIVAL, python("hello one")),
        Program("its TAB", python("hello"), tab("hello", "hello o")),
        Program("jkroll pull-off quartz 100nm --bare", python("jkroll pull-off quartz 100nm --bare")),
        Program("... --json", python("jkroll pull-off quartz 100nm --json")),
        Program("... on a terminal: a table", python("jkroll pull-off quartz 100nm"), COLOURS, terminal=True),
        Program("... in a unit that only pint knows", python("jkroll pull-off quartz 1e-14nautical_mile --bare")),
        Program("jkroll pull-off --help", python("jkroll pull-off --help")),
        Program("TAB after a material", python("jkroll"), tab("jkroll", "jkroll pull-off qu")),
        Program("a pint script of five lines", [sys.executable, "-c", "import pint_app"]),
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
