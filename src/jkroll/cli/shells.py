"""The program as a typer application: for shells that complete, `typer ... utils docs` and CliRunner.

Typer reads a line only to complete it, as it then forgives mistakes. What is to be run goes, untouched, to our own
reader.
"""

from collections.abc import Callable, Iterable, Mapping, Sequence
from typing import Any

import typer
from typer.core import TyperArgument, TyperCommand, TyperGroup, TyperOption

from ..errors import JkrollError
from ..quantities.laws import LAWS
from ..quantities.nomenclature import ANY, NOMENCLATURE
from . import process
from .commands import COMMANDS, TITLE
from .options import DEBUG, HELP, VERSION, Option


def main() -> int:
    """Answer a shell that completes, or teach it to, by the application, which ends the program; return the code."""
    try:
        app(prog_name="jkroll")
    except SystemExit as end:
        return JkrollError.exit_code if end.code else 0
    except BrokenPipeError:
        return process.BROKEN_PIPE
    except Exception as error:
        return process.report(error, ())
    return 0


# --- The application --------------------------------------------------------------------------------------------------


class _Program(TyperGroup):
    """The program: it hands the words of a call to our reader."""

    def get_params(self, ctx: Any) -> list[Any]:
        """Return the options before a command: ours, and those of typer for completion."""
        return [*map(_option, (VERSION, DEBUG, HELP)), *super().get_params(ctx)]

    def parse_args(self, ctx: Any, args: list[str]) -> list[str]:
        """Run the words, unless a shell completes them or is taught to."""
        if ctx.resilient_parsing or args in (["--install-completion"], ["--show-completion"]):
            return super().parse_args(ctx, args)
        raise typer.Exit(process.main(args))


class _Command(TyperCommand):
    """A command. Its options are made when they are looked at: those of all commands would take as long as the rest."""

    def get_params(self, ctx: Any) -> list[Any]:  # noqa: ARG002
        """Return the words and options."""
        if not self.params:
            command = COMMANDS[str(self.name)]
            count, completed = 1 if command.most_words == 1 else -1, _completed(command.placeholders)
            words = TyperArgument(param_decls=["words"], nargs=count, metavar=command.words, autocompletion=completed)
            self.params = [*([words] if command.words else []), *map(_option, (*command.options(), HELP))]
        return self.params


def _option(option: Option[Any]) -> TyperOption:
    """Return an option as typer has it."""
    is_flag = not option.metavar
    return TyperOption(
        param_decls=[option.name, *option.flags],
        is_flag=is_flag,
        default=False if is_flag else None,
        metavar=option.metavar or None,
        help=option.sentence(),
        hidden=option.hidden,
        autocompletion=_completed([option.name]),
    )


app = typer.Typer(cls=_Program, help=TITLE, add_help_option=False, rich_markup_mode=None)
for _command in COMMANDS.values():
    app.command(
        _command.name, cls=_Command, help=_command.sentence, short_help=_command.sentence, add_help_option=False
    )(lambda: None)  # our reader has run the command before typer would


# --- Candidates -------------------------------------------------------------------------------------------------------

_UNITS: dict[str, dict[str, None]] = {}  # of the examples of inputs, in order, by their SI unit
for _quantity in NOMENCLATURE.values():
    if _quantity.example and not _quantity.is_word:
        _UNITS.setdefault(_quantity.unit, {})[_quantity.example.lstrip("0123456789.e-")] = None


def _completed(placeholders: Sequence[str]) -> Callable[[object, object, str], list[str]]:
    """Return what completes a begun word: the first placeholder or, once a word may stand before it, any of them.

    Typer drops what begins otherwise. Nothing is offered that a shell could run: typer quotes too little for zsh.
    """

    def complete(_context: object, _words: object, begun: str) -> list[str]:
        open_ones = placeholders if begun else placeholders[:1]
        candidates = [text for placeholder in open_ones for text in _candidates(placeholder, begun)]
        return [text for text in candidates if all(letter.isalnum() or letter in "_-−.+,@=:/" for letter in text)]

    return complete


def _candidates(placeholder: str, begun: str) -> Iterable[str]:
    """Return words for a placeholder or values of an option: names, which may form a list, or numbers with units."""
    head, comma, word = begun.rpartition(",")
    if placeholder in _NAMES:
        return [head + comma + name for name in _NAMES[placeholder](word)]
    name = "radius" if placeholder == "RADIUS" else placeholder
    if name not in NOMENCLATURE:
        return []
    if not begun:
        return [] if placeholder == "RADIUS" else [NOMENCLATURE[name].example]
    number = begun[: len(begun) - len(begun.lstrip("0123456789.-+−"))]
    return [number + unit for unit in _UNITS.get(NOMENCLATURE[name].unit, ()) if number]


def _materials(begun: str) -> list[str]:
    """Return materials, and aliases where no name fits; only the shipped ones while a user's file is broken."""
    from ..materials.library import known_materials, materials_of_user

    try:
        materials = materials_of_user(None)
    except JkrollError:  # which the call itself will report
        materials = known_materials()
    names = [name for name in (*materials.materials, "all") if name.startswith(begun)]
    return names or [name for name in materials.aliases if name.startswith(begun)]


_RESULTS = [  # the quantities that a formula gives, without variants and without what is only an input
    name
    for name, quantity in NOMENCLATURE.items()
    if not (quantity.is_word or quantity.variant_of) and (quantity.equation or quantity.range is ANY)
]
# The names that a begun word may become, by its placeholder, or by the name of the option whose value it is.
_NAMES: Mapping[str, Callable[[str], Iterable[str]]] = {
    **dict.fromkeys(("MATERIAL", "material", "material2", "mark"), _materials),
    **dict.fromkeys(("QUANTITY", "NAME", "quantities"), lambda _: _RESULTS),
    "model": lambda _: LAWS,
}
