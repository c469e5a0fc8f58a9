"""The command line as typer reads it: lines that are not plain, completion and its installation."""

import os
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from functools import partial
from itertools import pairwise
from typing import Any

import typer
from typer._click.exceptions import NoSuchOption  # the only one of typer's errors that is worded anew
from typer.core import TyperArgument, TyperCommand, TyperGroup, TyperOption

from ..errors import BadRequest
from ..text import shown
from .commands import COMMANDS, Action, Command, flags_of
from .completion import Completer, completer_of_option, completer_of_words, is_safe
from .help import help_of
from .mistakes import UnknownCommand, UnknownOption
from .options import DEBUG, HELP, VERSION, Option
from .reader import print_version

MAX_MESSAGE = 1000


def typer_action(words: Sequence[str]) -> Action:
    """Return what words ask for, or raise BadRequest; what typer answers by itself is printed already."""
    try:
        made = application().main(words, prog_name="jkroll", standalone_mode=False)
    except typer.TyperException as error:
        raise BadRequest(shown(" ".join(error.format_message().split()), MAX_MESSAGE)) from None
    return made if callable(made) else partial(int, made or 0)


def application() -> TyperGroup:
    """Return the program: typer's own group, which knows the shells, with our commands and options in it."""
    app = typer.Typer(
        cls=_Program,
        rich_markup_mode=None,
        context_settings={"help_option_names": [option.flag for option in HELP]},
    )
    app.callback()(_no_callback)
    group = typer.main.get_command(app)
    assert isinstance(group, TyperGroup)
    group.params += [
        TyperOption(
            param_decls=[option.flag],
            is_flag=True,
            is_eager=True,
            expose_value=False,
            callback=callback,
            help=option.sentence(),
        )
        for option, callback in ((VERSION, _show_version), (DEBUG, None))
    ]
    for command in COMMANDS.values():
        group.add_command(_TyperCommand(command))
    return group


def _no_callback() -> None:
    """Do nothing: typer makes a group of an application with a callback."""


def _show_version(_context: object, _parameter: object, is_wanted: bool) -> None:
    if is_wanted:
        print_version()
        raise typer.Exit


class _Program(TyperGroup):
    """The program, with our help and our messages for an unknown option or command."""

    def get_help(self, ctx: Any) -> str:  # noqa: ARG002
        """Return what `--help` prints."""
        return help_of(None)

    def resolve_command(self, ctx: Any, args: list[str]) -> Any:
        """Return the command of the first word; while completing, none for an unknown one."""
        if args[0] not in COMMANDS and not ctx.resilient_parsing:
            raise UnknownCommand(args[0])
        return super().resolve_command(ctx, args)

    def parse_args(self, ctx: Any, args: list[str]) -> list[str]:
        """Read the options before the command."""
        with _unknown_options_named(None, args):
            return super().parse_args(ctx, args)


class _TyperCommand(TyperCommand):
    """A command, with our help and our message for an unknown option."""

    def __init__(self, command: Command) -> None:
        super().__init__(command.name, callback=partial(_action, command), short_help=command.sentence)
        self.command = command

    def get_params(self, ctx: Any) -> list[Any]:
        """Return the parameters, made only for the command that is called.

        A repeated option is collected, to be refused. While completing, a given option is not offered again.
        """
        if not self.params:
            self.params = _parameters(self.command, collects=not ctx.resilient_parsing)
        return super().get_params(ctx)

    def get_help(self, ctx: Any) -> str:  # noqa: ARG002
        """Return what `--help` prints."""
        return help_of(self.name)

    def parse_args(self, ctx: Any, args: list[str]) -> list[str]:
        """Read the words after the command."""
        with _unknown_options_named(self.name, args):
            return super().parse_args(ctx, args)


def _action(command: Command, words: str | Sequence[str] | None = None, **values: Any) -> Action:
    """Return what a call asks for, from what typer has read: a list of values for an option, True for a flag that was given."""
    flags = {option.name: option.flag for option in command.options()}
    given: dict[str, str | bool] = {}
    for name, value in values.items():
        if value is True:
            given[name] = True
        elif value and len(value) > 1:
            raise BadRequest(f"{flags[name]} is given more than once")
        elif value:
            given[name] = value[0]
    return command.action([words] if isinstance(words, str) else words or (), given)


def _parameters(command: Command, *, collects: bool) -> list[Any]:
    """Return the words and options of a command as typer wants them."""
    options = [_option(option, collects=collects) for option in command.options()]
    if not command.words.most:
        return options
    words = TyperArgument(
        param_decls=["words"],
        nargs=1 if command.words.most == 1 else -1,
        metavar=command.words.metavar,
        autocompletion=_safe(completer_of_words(command.name)),
    )
    return [words, *options]


class _TyperOption(TyperOption):
    """An option whose values are also completed in the form --option=value."""

    def shell_complete(self, ctx: Any, incomplete: str) -> list[Any]:
        """Return the candidates; with the option before them for zsh and fish, which replace the whole word."""
        items = super().shell_complete(ctx, incomplete)
        flag, has_value, _ = os.environ.get("_TYPER_COMPLETE_ARGS", "").rpartition(" ")[2].partition("=")
        if has_value and flag in self.opts:
            for item in items:
                item.value = f"{flag}={item.value}"
        return items


def _option(option: Option, *, collects: bool) -> TyperOption:
    """Return an option as typer wants it; its text is read by us."""
    is_flag = option.kind is bool
    return _TyperOption(
        param_decls=[option.name, *option.flags],
        is_flag=is_flag,
        default=False if is_flag else None,
        type=None if is_flag else str,
        multiple=collects and not is_flag,
        help=option.sentence(),
        hidden=option.hidden,
        autocompletion=_safe(completer_of_option(option.name)),
    )


def _safe(complete: Completer | None) -> Callable[[object, object, str], list[str]] | None:
    """Return a completer in typer's form. It offers nothing that a shell could run: typer quotes too little for zsh."""
    if complete is None:
        return None
    return lambda _context, _words, incomplete: list(filter(is_safe, complete(incomplete)))


@contextmanager
def _unknown_options_named(command: str | None, words: Sequence[str]) -> Iterator[None]:
    """Replace typer's message for an unknown option by ours."""
    words = tuple(words)  # typer consumes them
    try:
        yield
    except NoSuchOption as error:
        raise UnknownOption(_typed(error.option_name, words, command), command) from None


def _typed(flag: str, words: Sequence[str], command: str | None) -> str:
    """Return the option as typed, of which typer names only a letter if there is one hyphen: -g of -gamma."""
    takes_value = {spelling for spelling, option in flags_of(command).items() if option.kind is not bool}
    typed = (word for before, word in pairwise(["", *words]) if word.startswith(flag) and before not in takes_value)
    return next(typed, flag).partition("=")[0]
