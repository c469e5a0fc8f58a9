"""The program as a typer application: for shells that complete, `typer ... utils docs` and CliRunner.

Typer reads a line only to complete it, as it then forgives mistakes. What is to be run goes, untouched, to our own
reader.
"""

import os
from collections.abc import Callable, Iterable, Mapping, Sequence
from importlib import import_module
from typing import Any

import typer
from typer.core import TyperArgument, TyperCommand, TyperGroup, TyperOption

from ..errors import JkrollError
from ..output.manual import topics
from ..quantities.laws import LAWS
from ..quantities.nomenclature import ANY, NOMENCLATURE, OPTION_WORDS
from . import process
from .commands import COMMANDS, DEBUG, HELP, VERSION, Command, Option
from .help import TITLE


def main() -> int:
    """Answer a shell that completes, or teach it to, by the application, which ends the program; return the code."""
    try:
        app(prog_name="jkroll")
    except SystemExit as end:
        return JkrollError.exit_code if end.code else 0
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
            words = [_argument(command)] if command.words else []
            self.params = [*words, *map(_option, (*command.options(), HELP))]
        return self.params


class _Option(TyperOption):
    """An option whose values are also completed in the form --option=value."""

    def shell_complete(self, ctx: Any, incomplete: str) -> list[Any]:
        """Return the candidates; with the option before them for zsh and fish, which replace the whole word."""
        items = super().shell_complete(ctx, incomplete)
        flag, has_value, _ = os.environ.get("_TYPER_COMPLETE_ARGS", "").rpartition(" ")[2].partition("=")
        if has_value and flag in self.opts:
            for item in items:
                item.value = f"{flag}={item.value}"
        return items


def _option(option: Option) -> TyperOption:
    """Return an option as typer has it."""
    is_flag = not option.metavar
    return _Option(
        param_decls=[option.name, *option.flags],
        is_flag=is_flag,
        default=False if is_flag else None,
        metavar=option.metavar or None,
        help=option.sentence(),
        hidden=option.hidden,
        autocompletion=_completed([option.name]),
    )


def _argument(command: Command) -> TyperArgument:
    """Return the words of a command as typer has them."""
    return TyperArgument(
        param_decls=["words"],
        nargs=1 if command.most_words == 1 else -1,
        metavar=command.words,
        autocompletion=_completed(command.kinds),
    )


def _nothing() -> None:
    """Do nothing: our reader has run the command before typer would."""


app = typer.Typer(cls=_Program, help=TITLE, add_help_option=False, rich_markup_mode=None)
for _command in COMMANDS.values():
    app.command(
        _command.name, cls=_Command, help=_command.sentence, short_help=_command.sentence, add_help_option=False
    )(_nothing)


# --- Candidates -------------------------------------------------------------------------------------------------------

_UNITS = {
    "m": ("nm", "um", "mm", "m", "angstrom"),
    "N": ("nN", "uN", "mN", "N", "dyn"),
    "J": ("J", "eV", "erg"),
    "Pa": ("GPa", "MPa", "Pa"),
    "J/m^2": ("mJ/m2", "J/m2", "erg/cm2", "mN/m"),
    "kg/m^3": ("g/cm3", "kg/m3"),
    "m/s": ("cm/s", "m/s", "km/s"),
    "m/s^2": ("m/s2", "standard_gravity"),
}


def _completed(kinds: Sequence[str]) -> Callable[[object, object, str], list[str]]:
    """Return what completes a begun word of the first of some kinds, or, once a word may stand before it, of any.

    Typer drops what begins otherwise. Nothing is offered that a shell could run: typer quotes too little for zsh.
    """

    def complete(_context: object, _words: object, begun: str) -> list[str]:
        candidates = [text for kind in (kinds if begun else kinds[:1]) for text in _candidates(kind, begun)]
        return [text for text in candidates if all(letter.isalnum() or letter in "_-−.+,@=:/" for letter in text)]

    return complete


def _candidates(kind: str, begun: str) -> Iterable[str]:
    """Return words of a kind, or values of an option: names, which may stand in a list, or a number with each unit."""
    head, comma, word = begun.rpartition(",")
    if kind in _OF_MATERIALS:
        return [head + comma + name for name in _materials(word)]
    if kind in _NAMES:
        return [head + comma + name for name in _NAMES[kind]()]
    name = "radius" if kind == "RADIUS" else kind
    if name not in NOMENCLATURE:
        return []
    if not begun:
        return [] if kind == "RADIUS" else [NOMENCLATURE[name].example]
    number = begun[: len(begun) - len(begun.lstrip("0123456789.-+−"))]
    return [number + unit for unit in _UNITS.get(NOMENCLATURE[name].unit, ()) if number]


def _materials(begun: str) -> list[str]:
    """Return materials, and aliases where no name fits; only the shipped ones while a user's file is broken."""
    from ..materials.library import known_materials, materials_of_user

    try:
        materials = materials_of_user(None)
    except JkrollError:  # which the call itself will report
        materials = known_materials()
    names = [name for name in (*materials.names, "all") if name.startswith(begun)]
    return names or [name for name in materials.aliases if name.startswith(begun)]


def _results() -> list[str]:
    """Return the quantities that a formula gives, without variants and without what is only an input."""
    return [
        name
        for name, quantity in NOMENCLATURE.items()
        if not quantity.is_word and not quantity.variant_of and (quantity.equation or quantity.range is ANY)
    ]


def _inputs() -> list[str]:
    """Return the inputs that can be inferred, by their names and the words of their options."""
    from ..scene.inverse import SIZES

    return [*SIZES, *(word for word, name in OPTION_WORDS.items() if name in SIZES)]


def _axes() -> list[str]:
    """Return the quantities that an axis can have, each with the sign before its range."""
    return [f"{name}=" for name, quantity in NOMENCLATURE.items() if quantity.range is not ANY]


# By the kind of a word, or the name of an option.
_OF_MATERIALS = ("MATERIAL", "material", "material2", "mark")
_NAMES: Mapping[str, Callable[[], Iterable[str]]] = {
    "FIGURE": lambda: import_module("..pictures.figures", __package__).FIGURE_NAMES,
    "INPUT": _inputs,
    "NAME": lambda: NOMENCLATURE,
    "PROGRAM": lambda: import_module("..output.exports", __package__).PROGRAMS,
    "QUANTITY": _results,
    "TOPIC": topics,
    "measured": lambda: [f"{name}=" for name in _results()],
    "model": lambda: LAWS,
    "quantities": _results,
    "x": _axes,
    "y": _axes,
}
