"""The typer application runs the same program as the script: for CliRunner, shells and typer's own tools."""

import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest
from typer.testing import CliRunner

from harness import Run
from jkroll.cli.commands import COMMANDS, flags_of
from jkroll.cli.shells import app

SLOW = {"figure", "bench", "map"}
FORMS = """\
pull-off quartz 100nm
pull-off quartz 100nm --bare
pull-off quartz 100nm --json
pull-off quartz 100nm --csv --quiet
pull-off quartz 100nm --to=nN --digits 3
pull-off quartz,iron 1nm:1um:3 --quiet
pull-off 100nm --gamma 25mJ/m2
pull-off gamma=25mJ/m2 R1=100nm
pull-off --R1 100nm quartz --units nN
pull-off 100 nm --gamma 0.025 J/m2 --format json
pull-off -- quartz 100nm
pull-off quartz 100nm --explain
pull-off quartz 100nm --cite
pull-off quartz 100nm --density 3g/cm3
pull-off quartz 100nm --model maugis
contact quartz 100nm --load -5nN
contact quartz 100nm --load=-5nN --radius2 plane
contact quartz 100nm --curve --csv
yield-force quartz 10nm 1um --load -5nN --bare
yield-force quartz 100nm --load -20nN
r-min 100nm --xi 2angstrom
report quartz 100nm --json
report quartz 100nm --quantities r_min,n_grav
infer gamma quartz 2um --measured pull_off_force=300nN
infer gamma quartz 2um
export lammps quartz 100nm
batch
batch none.csv
batch -1.csv
materials
materials quartz
materials quarz
materials quartz iron
quantities
quantities friction
quantities tabor_parameter --json
guide
guide units
guide nothing
map pull-off quartz --x radius=1nm:1um:3 --data -
map pull-off
figure 99
verify quickly
bench slowly
--version
version
help
--help pull-off
--help=x
--laod
--bare pull-off quartz 100nm
--debug
-
--
plot quartz
pul-off quartz 100nm
sticking-speed quartz
pull-off
pull-off quartz
pull-off gold 100nm --radius2 1kg
pull-off quarz 100nm
pull-off quartz 100nn
pull-off quartz -5nm
pull-off quartz 100nm --laod 5nN
pull-off quartz 100nm --load 5nN
pull-off quartz 100nm --to
pull-off quartz 100nm --to --json
pull-off quartz 100nm -o --quiet
pull-off quartz 100nm --bare=x
pull-off quartz 100nm --json --csv
pull-off quartz 100nm --digits 0
pull-off quartz 100nm --gamma 1J/m2 --gamma 2J/m2
pull-off quartz 100nm -gamma 1J/m2
pull-off é 100nm
pull-off quartz 100nm -o none/x.csv
"""
LINES = [
    "",
    *(f"{name} {command.example}" for name, command in COMMANDS.items() if name not in SLOW),
    *(f"{name} --help" for name in COMMANDS),
    *FORMS.splitlines(),
]


def by_runner(line: str) -> tuple[int, bytes, bytes]:
    """Return exit code, output and errors of a line, run by the application."""
    ran = CliRunner().invoke(app, line.split(), catch_exceptions=False)
    return ran.exit_code, ran.stdout_bytes, ran.stderr_bytes


def by_script(line: str) -> tuple[int, bytes, bytes]:
    """Return exit code, output and errors of a line, run by the script."""
    words = [sys.executable, "-m", "jkroll", *line.split()]
    ran = subprocess.run(words, stdin=subprocess.DEVNULL, capture_output=True, env=os.environ | {"PYTHONUTF8": "1"})
    return ran.returncode, ran.stdout, ran.stderr


def test_there_are_a_hundred_lines() -> None:
    assert len({*LINES}) >= 100


@pytest.mark.parametrize("line", LINES)
def test_the_application_runs_the_same_program(run: Run, line: str) -> None:
    ran = run(line)
    assert by_runner(line) == (ran.code, ran.out.encode(), ran.err.encode())


@pytest.mark.slow
@pytest.mark.parametrize("line", LINES)
def test_the_script_runs_the_same_program(line: str) -> None:
    assert by_script(line) == by_runner(line)


@pytest.mark.parametrize("line", ["pull-off quartz 100nm", "r-min 100nm --laod 3", (
    "yield-force quartz 100nm --load "
    "-20nN"
)])  # fmt: skip
def test_the_script_runs_these_lines_alike(line: str) -> None:
    assert by_script(line) == by_runner(line)


def test_typer_writes_the_documentation() -> None:
    words = [sys.executable, "-m", "typer", "jkroll.cli.shells", "utils", "docs", "--name", "jkroll"]
    text = subprocess.run(words, capture_output=True, check=True, encoding="utf-8").stdout
    introduction, *sections = text.split("\n## ")
    assert all(f"`{flag}" in introduction or f" {flag}`" in introduction for flag in flags_of(None))
    assert [section.split("`")[1] for section in sections] == [f"jkroll {name}" for name in COMMANDS]
    for section, command in zip(sections, COMMANDS.values(), strict=True):
        assert command.sentence in section
        assert f"$ jkroll {command.name} [OPTIONS]" in section
        assert command.words in section
        for option in command.options():
            assert option.hidden or f"{option.flags[0]}{' ' * bool(option.metavar)}{option.metavar}`: " in section, (
                option
            )


@pytest.mark.skipif(shutil.which("bash") is None, reason="there is no bash")
@pytest.mark.parametrize("option", ["--install-completion", "--show-completion"])
def test_completion_is_installed_and_shown(tmp_path: Path, option: str) -> None:
    words = ["bash", "--norc", "-c", f'"{sys.executable}" -m jkroll {option}; exit $?']
    ran = subprocess.run(words, capture_output=True, env=os.environ | {"HOME": str(tmp_path)}, encoding="utf-8")
    assert (ran.returncode, ran.stderr) == (0, "")
    script = tmp_path / ".bash_completions" / "jkroll.sh"
    written = script.read_text(encoding="utf-8") if option.startswith("--install") else ran.stdout
    assert "_JKROLL_COMPLETE=complete_bash" in written
    assert script.exists() == option.startswith("--install")
