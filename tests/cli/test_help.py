"""The help is our own: it lists exactly what the reader takes and what typer is told of it."""

import re
from collections.abc import Iterator
from typing import Any

import pytest
import typer
from typer.core import TyperOption
from typer.testing import CliRunner

from harness import Run
from jkroll.cli.commands import COMMANDS, flags_of, help_of
from jkroll.cli.shells import app

NAMES = [None, *COMMANDS]


def taken(name: str | None) -> dict[str, bool]:
    """Return every flag that typer knows of a command, or before any, and whether it is hidden."""
    group: Any = typer.main.get_command(app)
    command = group if name is None else group.commands[name]
    return {
        flag: parameter.hidden
        for parameter in command.get_params(typer.Context(command))
        if isinstance(parameter, TyperOption)
        for flag in (*parameter.opts, *parameter.secondary_opts)
    }


def listed(name: str | None) -> Iterator[str]:
    """Iterate over every flag that the help lists."""
    sections = re.findall(r"ptions:\n(.*?)\n\n", help_of(name), re.DOTALL)
    for line in "\n".join(sections).splitlines():
        yield from re.findall(r"(?:^|, )(--?[a-z][a-z0-9-]*)", line[2:].split("  ")[0])


@pytest.mark.parametrize("name", NAMES)
def test_the_help_lists_what_is_taken(name: str | None) -> None:
    flags = list(listed(name))
    assert sorted(flags) == sorted(taken(name)) == sorted(flags_of(name))
    shown = [flag for flag in flags if not taken(name)[flag]]
    assert shown == flags[: len(shown)]
    assert shown[-2:] == ["-h", "--help"]


def test_the_help_lists_every_command() -> None:
    commands = help_of(None).split("Commands:\n")[1].split("\n\n  Example")[0]
    assert re.findall(r"^  (\S+)", commands, re.MULTILINE) == [*COMMANDS]


@pytest.mark.parametrize("name", NAMES)
def test_every_way_to_ask_for_help(run: Run, name: str | None) -> None:
    words = [name] if name else []
    text = run(*words, "--help").out
    assert text == run(*words, "-h").out == run("help", *words).out == help_of(name) + "\n"
    assert CliRunner().invoke(app, [*words, "--help"]).stdout == text


@pytest.mark.parametrize("width", [1, 30, 60, 80, 200])
@pytest.mark.parametrize("name", NAMES)
def test_lines_fit_and_nothing_is_lost(monkeypatch: pytest.MonkeyPatch, name: str | None, width: int) -> None:
    words = help_of(name).split()
    monkeypatch.setenv("COLUMNS", str(width))
    text = help_of(name)
    assert text.split() == words
    assert max(map(len, text.splitlines())) <= max(54, min(98, width - 2))


@pytest.mark.parametrize("name", COMMANDS)
def test_a_shell_finds_nothing_to_run_in_a_help_text(name: str) -> None:
    for text in (COMMANDS[name].sentence, *(option.sentence() for option in COMMANDS[name].options())):
        assert not {*text} & {*'\\`$"'}, text
