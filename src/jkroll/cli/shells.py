"""The program as a typer application, which installs completion, documents the commands and serves typer's CliRunner.

The words and options that typer has read are joined into a command line again, which `process` runs.
"""

from collections.abc import Callable, Iterable
from inspect import Parameter, Signature
from typing import Any

import typer

from ..errors import JkrollError
from . import process
from .commands import COMMANDS, TITLE, Command
from .options import DEBUG, HELP, VERSION, Option

_WORDS = "words"
_SETTINGS = {"help_option_names": HELP.flags}


def main() -> int:
    """Install or show completion; return the exit code."""
    try:
        app(prog_name="jkroll")
    except SystemExit as end:
        return JkrollError.exit_code if end.code else 0
    except Exception as error:
        return process.report(error, ())
    return 0


def _parameter(option: Option[Any]) -> Parameter:
    """Return the parameter of a function that typer reads as an option."""
    kind: Any = bool
    empty: Any = False
    if option.repeats:
        kind, empty = list[str], []
    elif option.metavar:
        kind, empty = str | None, None
    default: Any = typer.Option(
        empty, *option.flags, metavar=option.metavar or None, help=option.sentence(), hidden=option.hidden,
        show_default=False,
    )  # fmt: skip
    return Parameter(option.name, Parameter.KEYWORD_ONLY, default=default, annotation=kind)


def _typed(options: Iterable[Option[Any]], values: dict[str, Any]) -> list[str]:
    """Return options with their values as words of a command line."""
    typed = []
    for option in options:
        value = values[option.name]
        if isinstance(value, list):
            typed += [f"{option.flag}={text}" for text in value]
        elif value:
            typed.append(f"{option.flag}={value}" if option.metavar else option.flag)
    return typed


def _function(command: Command) -> Callable[..., None]:
    """Return a function that runs a command; typer reads the parameters from its signature."""
    options = command.options()

    def run(**values: Any) -> None:
        words = values.get(_WORDS) or []
        raise typer.Exit(process.main([command.name, *words, *_typed(options, values)]))

    argument = typer.Argument([], metavar=command.words, show_default=False)
    words = [Parameter(_WORDS, Parameter.KEYWORD_ONLY, default=argument, annotation=list[str])]
    run.__signature__ = Signature([*(words if command.words else []), *map(_parameter, options)])  # type: ignore[attr-defined]
    return run


def _before_a_command(**values: Any) -> None:
    """Run the options of the program itself."""
    typed = _typed((VERSION, DEBUG), values)
    if typed:
        raise typer.Exit(process.main(typed))


_before_a_command.__signature__ = Signature([*map(_parameter, (VERSION, DEBUG))])  # type: ignore[attr-defined]

app = typer.Typer(help=TITLE, rich_markup_mode=None, no_args_is_help=True)
app.callback(invoke_without_command=True, context_settings=_SETTINGS)(_before_a_command)
for _command in COMMANDS.values():
    app.command(_command.name, help=_command.sentence, context_settings=_SETTINGS)(_function(_command))
