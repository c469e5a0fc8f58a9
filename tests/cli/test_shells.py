"""The typer application, which serves CliRunner, shells and typer's tools, runs the same program as the script."""

import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest
from typer.testing import CliRunner

from harness import Run
from jkroll.cli.commands import COMMANDS, flags_of
from jkroll.cli.options import HELP
from jkroll.cli.shells import app

# Lines with each type of option and each exit code; typer must accept all of them.
LINES = """\
--version
--debug --version
pull-off
pull-off é 100nm
pull-off quartz 100nm -o x.png
pull-off quartz 100nm --digits 3 --json --quiet
infer gamma quartz 2um --measured P_c=300nN
batch missing.csv --column a=radius --column b=load
r-min 100nm --xi -3nm
yield-force quartz 100nm --load -20nN
guide units
""".splitlines()


def by_runner(line: str) -> tuple[int, bytes, bytes]:
    """Return the exit code, the output and the errors of a line that the application runs."""
    ran = CliRunner().invoke(app, line.split(), catch_exceptions=False)
    return ran.exit_code, ran.stdout_bytes, ran.stderr_bytes


@pytest.mark.parametrize("line", LINES)
def test_the_application_runs_the_same_program(run: Run, line: str) -> None:
    ran = run(line)
    assert by_runner(line) == (ran.code, ran.out.encode(), ran.err.encode())


def test_typer_writes_the_documentation() -> None:
    words = [sys.executable, "-m", "typer", "jkroll.cli.shells", "utils", "docs", "--name", "jkroll"]
    text = subprocess.run(words, capture_output=True, check=True, encoding="utf-8").stdout
    introduction, *sections = text.split("\n## ")
    assert all(f"`{flag}" in introduction or f" {flag}`" in introduction for flag in {*flags_of(None)} - {HELP.short})
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


@pytest.mark.skipif(shutil.which("bash") is None, reason="there is no bash")
def test_completion_that_cannot_be_written_is_reported_in_a_line(tmp_path: Path) -> None:
    home = tmp_path / "file"
    home.touch()
    words = ["bash", "--norc", "-c", f'"{sys.executable}" -m jkroll --install-completion; exit $?']
    ran = subprocess.run(words, capture_output=True, env=os.environ | {"HOME": str(home)}, encoding="utf-8")
    assert (ran.returncode, ran.stdout, ran.stderr) == (1, "", f"jkroll: cannot write '{home}': File exists\n")


def test_completion_has_the_exit_code_141_if_the_shell_reads_no_candidates() -> None:
    reader, writer = os.pipe()
    os.close(reader)
    words = {"_JKROLL_COMPLETE": "complete_bash", "COMP_WORDS": "jkroll pull-off ", "COMP_CWORD": "2"}
    with open(writer, "wb") as closed:
        ran = subprocess.run(
            [sys.executable, "-m", "jkroll"], stdout=closed, stderr=subprocess.PIPE, env=os.environ | words
        )
    assert (ran.returncode, ran.stderr) == (141, b"")
