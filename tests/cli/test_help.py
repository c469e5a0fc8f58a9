"""The help lists exactly the options that the reader of command lines accepts and typer declares."""

import re
from functools import cache
from typing import Any

import pytest
import typer
from typer.core import TyperOption

from harness import Run
from jkroll.cli.commands import COMMANDS, GUTTER, flags_of, help_of
from jkroll.cli.shells import app
from jkroll.report.questions import QUESTIONS

NAMES = [None, *COMMANDS]


@cache
def group_of_commands() -> Any:
    """Return typer's application as a group of commands, which takes long to build."""
    return typer.main.get_command(app)


def taken(name: str | None) -> dict[str, bool]:
    """Return the flags of a command, or of the program, in typer's application; True for a hidden flag."""
    group = group_of_commands()
    command = group if name is None else group.commands[name]
    return {
        flag: parameter.hidden
        for parameter in command.get_params(typer.Context(command, **command.context_settings))
        if isinstance(parameter, TyperOption)
        for flag in (*parameter.opts, *parameter.secondary_opts)
    }


def listed(name: str | None) -> list[str]:
    """Return the flags that the help names, except those in its example."""
    text, _, _ = help_of(name).partition("Example: ")
    return re.findall(r"(?<![\w-])--?[a-z][a-z0-9-]*(?<!-)", text)


@pytest.mark.parametrize("name", [*COMMANDS])
def test_the_help_of_a_command_names_exactly_the_options_of_the_command(name: str) -> None:
    assert sorted({*listed(name)}) == sorted(taken(name)) == sorted(flags_of(name))


def test_the_help_of_the_program_names_every_command_once_and_every_option() -> None:
    text = help_of(None)
    assert {*listed(None)} - {"--radius2", "--gamma"} == {*taken(None)} - {"-h"} == {*flags_of(None)} - {"-h"}
    lines = text[text.index("Contact ") : text.index("Options ")].splitlines()
    names = [name for line in lines for name in line[GUTTER:].partition("  ")[0].split(", ")]
    assert sorted(names) == sorted(COMMANDS)


def test_the_help_of_a_question_has_three_groups_of_options() -> None:
    for name in QUESTIONS:
        groups = re.findall(r"^([A-Z][a-z]+)  ", help_of(name), re.MULTILINE)
        assert groups == ["Pair", "Assumed", "Output"], name


@pytest.mark.parametrize("name", NAMES)
def test_every_way_to_ask_for_help_gives_the_same_text(run: Run, name: str | None) -> None:
    words = [name] if name else []
    text = run(*words, "--help").out
    assert text == run(*words, "-h").out == run("help", *words).out == help_of(name) + "\n"


@pytest.mark.parametrize("width", [1, 60, 200])
def test_help_fits_the_width_of_the_terminal_and_keeps_all_words(monkeypatch: pytest.MonkeyPatch, width: int) -> None:
    words = {name: help_of(name).split() for name in NAMES}
    monkeypatch.setenv("COLUMNS", str(width))
    for name in NAMES:
        text = help_of(name)
        assert text.split() == words[name]
        assert max(map(len, text.splitlines())) <= max(58 if name else 75, min(98, width - 2)), name


@pytest.mark.parametrize("name", COMMANDS)
def test_a_shell_finds_nothing_to_run_in_a_help_text(name: str) -> None:
    for text in (COMMANDS[name].sentence, *(option.sentence() for option in COMMANDS[name].options())):
        assert not {*text} & {*'\\`$"'}, text
