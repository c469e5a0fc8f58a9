"""The command line as typer sees it: words that are not plain. The only module that knows typer."""

from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from inspect import Parameter, Signature
from typing import Annotated, Any

import typer
from typer.core import TyperCommand, TyperGroup

from .. import __version__
from ..answers.questions import COMMANDS
from .calls import Call, call
from .completion import ARGUMENTS, complete_option, complete_words
from .help import help_of
from .mistakes import UnknownOption
from .options import EXTRAS, HELP, Option, options_named, sentence_of


class Program(TyperGroup):
    """The program, with our help and our words for an option it does not take."""

    def get_help(self, ctx: Any) -> str:  # noqa: ARG002
        """What `--help` prints."""
        return help_of(None)

    def parse_args(self, ctx: Any, args: list[str]) -> list[str]:
        """Read the options before the command."""
        with _our_words(None, args):
            return super().parse_args(ctx, args)


class OneCommand(TyperCommand):
    """A command, with our help and our words for an option it does not take."""

    def get_help(self, ctx: Any) -> str:  # noqa: ARG002
        """What `--help` prints."""
        return help_of(self.name)

    def parse_args(self, ctx: Any, args: list[str]) -> list[str]:
        """Read the words after the command."""
        with _our_words(self.name, args):
            return super().parse_args(ctx, args)


@contextmanager
def _our_words(command: str | None, words: Sequence[str]) -> Iterator[None]:
    """Say of an option that nothing takes what was probably meant, in place of what typer says."""
    words = tuple(words)
    try:
        yield
    except Exception as error:
        if not hasattr(error, "possibilities"):
            raise
        flag = str(getattr(error, "option_name", ""))
        begun = [word.partition("=")[0] for word in words if word.startswith(flag)]
        typed = flag if flag in begun else next(iter(begun), flag)
        raise UnknownOption(typed, command) from None


def build(only: str | None = None) -> typer.Typer:
    """The application. Only the command that is called gets its options; the others are there to be listed."""
    app = typer.Typer(
        cls=Program,
        add_completion=True,
        no_args_is_help=True,
        rich_markup_mode=None,
        pretty_exceptions_enable=False,
        context_settings={"help_option_names": [option.flag for option in HELP]},
    )
    app.callback()(_root)
    for name, command in COMMANDS.items():
        parameters = []
        if name == only:
            parameters = [_words("[MATERIAL] [RADIUS]...", list[str] | None), *map(_parameter, options_named(name))]
        _add(app, name, command.sentence, parameters)
    for name, extra in EXTRAS.items():
        kind = list[str] | None if extra.takes_scene else str | None
        words = [_words(extra.argument, kind, name)] if extra.argument else []
        parameters = [*words, *map(_parameter, options_named(name))] if name == only else []
        _add(app, name, extra.sentence, parameters)
    return app


def _add(app: typer.Typer, name: str, sentence: str, parameters: list[Parameter]) -> None:
    """Add a command with a signature of its own."""

    def function(words: Any = None, **values: Any) -> Call:
        return call(name, [words] if isinstance(words, str) else words or [], values)

    function.__signature__ = Signature(parameters)  # type: ignore[attr-defined]
    function.__annotations__ = {parameter.name: parameter.annotation for parameter in parameters}
    function.__name__ = name.replace("-", "_")
    app.command(name, cls=OneCommand, short_help=sentence)(function)


def _words(metavar: str, kind: Any, command: str = "") -> Parameter:
    completer = ARGUMENTS.get(command, complete_words)
    argument = typer.Argument(metavar=metavar, autocompletion=completer, show_default=False)
    return _annotated("words", kind, None, argument)


def _parameter(option: Option) -> Parameter:
    """An option as typer wants it."""
    declaration = typer.Option(
        *option.flags,
        metavar=option.metavar or None,
        help=sentence_of(option),
        min=option.low,
        max=option.high,
        hidden=option.hidden,
        show_default=False,
        autocompletion=complete_option(option.name),
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
