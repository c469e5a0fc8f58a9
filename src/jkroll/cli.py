"""The command line as typer sees it: help, completion, and words that are not plain. The only module that knows typer."""

import sys
from inspect import Parameter, Signature
from typing import Annotated, Any

import typer
from typer.core import TyperCommand, TyperGroup

from . import __version__
from .commands import COMMANDS
from .completion import complete_input, complete_words
from .nomenclature import NOMENCLATURE
from .options import EXTRAS, Option, options_of
from .shell import Call, call
from .streams import fitting


class Program(TyperGroup):
    """The program: its help is written as the stream allows."""

    def get_help(self, ctx: Any) -> str:
        """The help, in ASCII where it must be."""
        return fitting(super().get_help(ctx), sys.stdout)


class CompactCommand(TyperCommand):
    """A command whose help shows, on one line, the options that share a help text."""

    def get_help(self, ctx: Any) -> str:
        """The help, in ASCII where it must be."""
        return fitting(super().get_help(ctx), sys.stdout)

    def format_options(self, ctx: Any, formatter: Any) -> None:
        """Write the options; arguments stand in the usage line."""
        lines: dict[str, list[str]] = {}
        for parameter in self.get_params(ctx):
            record = parameter.get_help_record(ctx) if parameter.param_type_name == "option" else None
            if record is not None:
                lines.setdefault(record[1], []).append(record[0])
        with formatter.section("Options"):
            formatter.write_dl([(", ".join(names), text) for text, names in lines.items()])


_EPILOG = """Lists (1nm,1um) and ranges (1nm:1um:50, or :50:lin) give a row each.

Example: jkroll {name} {example}"""


def build(only: str | None = None) -> typer.Typer:
    """The application. Only the command that is called gets its options; the others are there to be listed."""
    app = typer.Typer(
        cls=Program,
        add_completion=True,
        no_args_is_help=True,
        rich_markup_mode=None,
        pretty_exceptions_enable=False,
        context_settings={"help_option_names": ["-h", "--help"], "max_content_width": 100},
        help="Adhesive contact of two elastic spheres: pull-off, rolling, chains, vibrations.",
        epilog="Example: jkroll report quartz 100nm",
    )
    app.callback()(_root)
    for name, command in COMMANDS.items():
        parameters = []
        if name == only:
            parameters = [_words("[MATERIAL] [RADIUS]...", list[str] | None), *map(_parameter, options_of(command))]
        _add(app, name, command.sentence, _EPILOG.format(name=name, example=command.example), parameters)
    for name, extra in EXTRAS.items():
        words = [_words(extra.argument, str | None)] if extra.argument else []
        parameters = [*words, *map(_parameter, extra.options)] if name == only else []
        _add(app, name, extra.sentence, f"Example: jkroll {name} {extra.example}", parameters)
    return app


def _add(app: typer.Typer, name: str, sentence: str, epilog: str, parameters: list[Parameter]) -> None:
    """Add a command with a signature of its own."""

    def function(words: Any = None, **values: Any) -> Call:
        return call(name, [words] if isinstance(words, str) else words or [], values)

    function.__signature__ = Signature(parameters)  # type: ignore[attr-defined]
    function.__annotations__ = {parameter.name: parameter.annotation for parameter in parameters}
    function.__name__ = name.replace("-", "_")
    app.command(name, cls=CompactCommand, help=sentence, epilog=epilog)(function)


def _words(metavar: str, kind: Any) -> Parameter:
    argument = typer.Argument(metavar=metavar, autocompletion=complete_words, show_default=False)
    return _annotated("words", kind, None, argument)


def _parameter(option: Option) -> Parameter:
    """An option as typer wants it."""
    declaration = typer.Option(
        *option.flags,
        metavar=option.metavar or None,
        help=option.help,
        min=option.low,
        max=option.high,
        hidden=option.hidden,
        show_default=False,
        autocompletion=complete_input(option.name) if option.name in NOMENCLATURE else None,
    )
    kind: Any = option.kind
    return _annotated(option.name, kind if kind is bool else kind | None, False if kind is bool else None, declaration)


def _annotated(name: str, kind: Any, default: Any, declaration: Any) -> Parameter:
    return Parameter(name, Parameter.KEYWORD_ONLY, default=default, annotation=Annotated[kind, declaration])


def _show_version(wanted: bool) -> None:
    if wanted:
        typer.echo(f"jkroll {__version__}")
        raise typer.Exit


def _root(
    version: Annotated[
        bool, typer.Option("--version", help="Show the version and exit.", is_eager=True, callback=_show_version)
    ] = False,
) -> None:
    """Options of the program itself."""
