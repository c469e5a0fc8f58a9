"""The program as a typer application, which installs completion, documents itself and runs under CliRunner.

The words of a call that typer has read are written anew and go to our own reader, by which every line is run.
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
    """Return an option as the parameter of a function from which typer makes an option."""
    kind: Any = list[str] if option.repeats else str | None if option.metavar else bool
    default: Any = typer.Option(
        [] if option.repeats else None if option.metavar else False, *option.flags, metavar=option.metavar or None,
        help=option.sentence(), hidden=option.hidden, show_default=False,
    )  # fmt: skip
    return Parameter(option.name, Parameter.KEYWORD_ONLY, default=default, annotation=kind)


def _typed(options: Iterable[Option[Any]], values: dict[str, Any]) -> list[str]:
    """Return options with their values as they are typed."""
    typed = []
    for option in options:
        value = values[option.name]
        texts = value if isinstance(value, list) else [value] if value else []
        typed += [f"{option.flag}={text}" if option.metavar else option.flag for text in texts]
    return typed


def _function(command: Command) -> Callable[..., None]:
    """Return a function that runs a command, with the parameters that typer has from its signature."""
    options = command.options()

    def run(**values: Any) -> None:
        words = values.get(_WORDS) or []
        raise typer.Exit(process.main([command.name, *words, *_typed(options, values)]))

    argument = typer.Argument([], metavar=command.words, show_default=False)
    words = [Parameter(_WORDS, Parameter.KEYWORD_ONLY, default=argument, annotation=list[str])]
    run.__signature__ = Signature([*(words if command.words else []), *map(_parameter, options)])  # type: ignore[attr-defined]
    return run


def _before_a_command(**values: Any) -> None:
    """Run what stands before any command."""
    if typed := _typed((VERSION, DEBUG), values):
        raise typer.Exit(process.main(typed))


_before_a_command.__signature__ = Signature([*map(_parameter, (VERSION, DEBUG))])  # type: ignore[attr-defined]

app = typer.Typer(help=TITLE, rich_markup_mode=None, no_args_is_help=True)
app.callback(invoke_without_command=True, context_settings=_SETTINGS)(_before_a_command)
for _command in COMMANDS.values():
    app.command(_command.name, help=_command.sentence, context_settings=_SETTINGS)(_function(_command))
