"""A call imports only the modules that it uses. tests/benchmarks/startup.py measures the time of a call."""

import os
import subprocess
import sys
from functools import partial
from pathlib import Path
from runpy import run_path

import pytest

from jkroll.cli.commands import COMMANDS
from jkroll.cli.process import action_of

LIBRARIES = {"numpy", "pint", "rich", "typer", "pydantic", "mpmath", "matplotlib", "tomllib"}
HEAVY = {"dataclasses", "inspect", "pathlib", "difflib", "shutil", "subprocess"}  # modules of the standard library
PINT = {"numpy", "pint"}  # pint imports numpy by itself

PROGRAM = """
import sys
import jkroll.materials
from jkroll.materials import library
jkroll.materials.__path__.append(sys.argv[1])
library.SHIPPED = library.os.path.join(library._HERE, "materials.toml")
sys.stdout.isatty = lambda: sys.argv[2] == "terminal"
from jkroll.cli.process import main
codes = {main([word.replace("_to_", " to ") for word in words.split()]) for words in sys.argv[3:]}
print(codes, *sys.modules, file=sys.stderr)
"""


def imported(*calls: str, folder: Path, terminal: bool = False, variables: dict[str, str] | None = None) -> set[str]:
    """Return the libraries that some calls import, with the shipped materials as a module, as in a wheel."""
    module = run_path(str(Path(__file__).parents[2] / ".hatch" / "module.py"))["text"]()
    (folder / "shipped.py").write_text(module, encoding="utf-8")
    ran = subprocess.run(
        [sys.executable, "-c", PROGRAM, str(folder), "terminal" if terminal else "pipe", *calls],
        capture_output=True,
        text=True,
        check=True,
        encoding="utf-8",
        cwd=folder,
        env={**os.environ, **(variables or {})},
    )
    codes, *names = ran.stderr.splitlines()[-1].split()
    assert codes == "{0}", ran.stderr
    assert ran.stdout
    return (LIBRARIES | HEAVY) & set(names)


PLAIN = [
    "pull-off quartz 100nm --bare --quiet",
    "pull-off quartz 100nm --quiet",
    "pull-off quartz 100nm --json --quiet",
    "pull-off quartz 100nm --csv --quiet",
    "report quartz 100nm --radius2 plane --material2=iron --load -1nN --digits 3 --to nN,nm --quiet",
    "pull-off R1=100nm --surface-energy 0.025 J/m2 --units nN --format json",
    "yield-force quartz 1nm:1um:9 --bare --quiet",
    "moment quartz 100nm --quiet",
    "materials quartz",
    "--version",
    "--help",
    "report --help",
]
ERROR_BARS = [
    "pull-off quartz 100nm --gamma 25±5mJ/m2 --quiet",
    "report silica-dry 100nm --quiet",
    "contact ice-cold 100nm --gamma=100mJ/m2 --quiet",
    "pull-off R1=80_to_120nm --gamma=20_to_30mJ/m2 --quiet",
]
OWN = ["pull-off ice 100nm --bare --quiet --materials own.toml", "materials --materials own.toml"]


@pytest.mark.parametrize(
    ("calls", "kinds", "expected"),
    [
        (PLAIN, LIBRARIES | HEAVY, set()),
        (ERROR_BARS, LIBRARIES, set()),
        (["infer gamma 2um --measured P_c=300±20nN --quiet"], LIBRARIES, {"numpy"}),
        (OWN, LIBRARIES | HEAVY, {"tomllib"}),
        (["pull-off quartz 1e-14nautical_mile --bare --quiet"], LIBRARIES, PINT),
    ],
    ids=["plain", "error bars", "infer", "own materials", "a unit of pint"],
)
def test_calls_import_no_more_than_they_use(
    tmp_path: Path, calls: list[str], kinds: set[str], expected: set[str]
) -> None:
    (tmp_path / "own.toml").write_text('[materials.ice]\nsurface_energy = "0.37 J/m2"\n', encoding="utf-8")
    assert imported(*calls, folder=tmp_path) & kinds == expected


def test_a_table_on_a_terminal_imports_no_library(tmp_path: Path) -> None:
    calls = ["pull-off quartz 100nm --quiet", "yield-force quartz,iron 1nm:1um:3 --quiet", "materials"]
    assert not imported(*calls, folder=tmp_path, terminal=True) & LIBRARIES


def test_a_mistake_imports_no_library(tmp_path: Path) -> None:
    program = "import sys; from jkroll.cli.process import main; main(sys.argv[1:]); print(*sys.modules)"
    words = [sys.executable, "-c", program, "r-min", "100nm", "--laod", "5nN"]
    ran = subprocess.run(words, capture_output=True, text=True, check=True, cwd=tmp_path)
    assert LIBRARIES & set(ran.stdout.split()) == set()


@pytest.mark.parametrize("line", ["jkroll pul", "jkroll pull-off iron,qu", "jkroll pull-off --"])
def test_completion_imports_no_library(line: str, tmp_path: Path) -> None:
    program = "import sys; from jkroll.cli.completion import main; main(); print(*sys.modules, file=sys.stderr)"
    variables = {
        "_JKROLL_COMPLETE": "complete_bash",
        "COMP_WORDS": line.replace(" ", "\n"),
        "COMP_CWORD": str(line.count(" ")),
    }
    words = [sys.executable, "-c", program]
    ran = subprocess.run(
        words, capture_output=True, text=True, check=True, cwd=tmp_path, env={**os.environ, **variables}
    )
    assert ran.stdout
    assert LIBRARIES & set(ran.stderr.split()) <= {"tomllib"}


def test_a_call_imports_only_the_runner_of_its_command() -> None:
    runners = {f"jkroll.cli.{command.runner.partition(':')[0]}" for command in COMMANDS.values()}
    program = """
import sys
from jkroll.cli.process import main
main(["r-min", "--help"])
main(["r-min", "100nm", "--xl", "1nm"])
print(*sys.modules, file=sys.stderr)
main(["r-min", "100nm", "--quiet"])
print(*sys.modules, file=sys.stderr)
"""
    ran = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=True)
    _, before, after = ran.stderr.splitlines()
    assert runners & {*before.split()} == set()
    assert runners & {*after.split()} == {"jkroll.cli.runners"}


@pytest.mark.parametrize("name", COMMANDS)
def test_every_command_has_a_runner(name: str) -> None:
    assert isinstance(action_of([name]), partial)


def test_the_package_imports_no_other_module_before_use() -> None:
    program = "import sys; before = set(sys.modules); import jkroll; print(*sorted(set(sys.modules) - before))"
    source = {"PYTHONPATH": str(Path(__file__).parents[2] / "src")}
    words = [sys.executable, "-S", "-c", program]
    ran = subprocess.run(words, capture_output=True, text=True, check=True, env={**os.environ, **source})
    assert ran.stdout.split() == ["jkroll"]


def test_numbers_from_python_import_no_library() -> None:
    program = """
import sys
import jkroll
jkroll.solve(["pull_off_force", "n_roll"], radius="100 nm", gamma=0.025, young="54 GPa", poisson_ratio=0.17)
jkroll.solve("r_min", radius="80 to 120 nm")
jkroll.solve("r_min", radius=1)
print(*sys.modules)
"""
    ran = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=True)
    assert LIBRARIES & set(ran.stdout.split()) == set()
