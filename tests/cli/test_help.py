"""The help is our own: it lists exactly what typer takes, whoever is asked for it."""

import re
from collections.abc import Iterator

import pytest
import typer
from typer.core import TyperOption

from harness import Run
from jkroll.answers.questions import COMMANDS
from jkroll.cli.help import help_of
from jkroll.cli.options import EXTRAS
from jkroll.cli.typer_app import build

NAMES = [None, *COMMANDS, *EXTRAS]


def taken(name: str | None) -> dict[str, bool]:
    """Every flag that typer takes for a command, or before any, and whether it is hidden."""
    group = typer.main.get_command(build(name))
    command = group if name is None else group.commands[name]  # type: ignore[attr-defined]
    program = typer.Context(group, **group.context_settings)
    context = program if name is None else typer.Context(command, parent=program)
    return {
        flag: parameter.hidden
        for parameter in command.get_params(context)
        if isinstance(parameter, TyperOption)
        for flag in (*parameter.opts, *parameter.secondary_opts)
    }


def listed(name: str | None) -> Iterator[str]:
    """Every flag that the help lists."""
    options = help_of(name).split("Options:\n")[1].split("\n\n")[0]
    for line in options.splitlines():
        yield from re.findall(r"(?:^|, )(--?[a-z][a-z0-9-]*)", line[2:].split("  ")[0])


@pytest.mark.parametrize("name", NAMES)
def test_the_help_lists_what_typer_takes(name: str | None) -> None:
    flags = list(listed(name))
    assert sorted(flags) == sorted(flag for flag, hidden in taken(name).items() if not hidden)
    assert flags[-2:] == ["-h", "--help"]


def test_the_help_lists_every_command() -> None:
    commands = help_of(None).split("Commands:\n")[1].split("\n\n")[0]
    assert [line.split()[0] for line in commands.splitlines()] == list(
        typer.main.get_command(build()).commands  # type: ignore[attr-defined]
    )


@pytest.mark.parametrize("name", [*COMMANDS, *EXTRAS])
def test_typer_prints_the_same_help(run: Run, capsys: pytest.CaptureFixture[str], name: str) -> None:
    build(name)([name, "--help"], prog_name="jkroll", standalone_mode=False)
    assert capsys.readouterr().out == run(f"{name} --help").out == run(f"{name} -h").out


def test_typer_prints_the_same_help_of_the_program(run: Run, capsys: pytest.CaptureFixture[str]) -> None:
    build()(["--help"], prog_name="jkroll", standalone_mode=False)
    assert capsys.readouterr().out == run("--help").out == run("").out


@pytest.mark.parametrize("width", [1, 30, 60, 80, 200])
@pytest.mark.parametrize("name", NAMES)
def test_lines_fit_and_nothing_is_lost(monkeypatch: pytest.MonkeyPatch, name: str | None, width: int) -> None:
    words = help_of(name).split()
    monkeypatch.setenv("COLUMNS", str(width))
    text = help_of(name)
    assert text.split() == words
    assert max(map(len, text.splitlines())) <= max(54, min(98, width - 2))
