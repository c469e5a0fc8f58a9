"""The command line. The only module that knows typer: it turns an argument list into a call, and errors into one line."""

import errno
import io
import os
import re
import sys
from collections.abc import Callable, Mapping, Sequence
from functools import partial
from inspect import Parameter, Signature
from pathlib import Path
from typing import Annotated, Any

import typer
from typer.core import TyperCommand, TyperGroup

from . import __version__
from .answer import COMMANDS, Command
from .completion import complete_input, complete_words
from .errors import JkrollError, quoted
from .ladder import OF_MOMENT, OF_SLOPE
from .nomenclature import NOMENCLATURE
from .report import fitting, say
from .run import Output, run_command, run_materials
from .scene import DEFAULTS
from .wiring import depends_on

USAGE_ERROR = 2
CANNOT_WRITE = 1
INTERRUPTED = 130
BROKEN_PIPE = 141

Call = Callable[[], int]


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


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the command line and return its exit code; print an error as one line."""
    words = list(sys.argv[1:] if arguments is None else arguments)
    debug = "--debug" in words[:1] + words[-1:]
    words = [word for place, word in enumerate(words) if not (word == "--debug" and place in (0, len(words) - 1))]
    words = _with_minus_signs(words) or ["--help"]
    if sys.stderr is None:
        sys.stderr = open(os.devnull, "w", encoding="utf-8")  # it was closed: nobody listens
    try:
        if sys.stdout is None:
            raise OSError(errno.EBADF, os.strerror(errno.EBADF))
        for stream in (sys.stdout, sys.stderr):
            if isinstance(stream, io.TextIOWrapper):
                stream.reconfigure(errors="jkroll-ascii")
        call = build(_command_of(words))(words, prog_name="jkroll", standalone_mode=False)
        code = call() if callable(call) else int(call or 0)
        sys.stdout.flush()
        return code
    except (BrokenPipeError, SystemExit):  # typer turns a closed pipe into SystemExit
        _forget(sys.stdout)
        return BROKEN_PIPE
    except KeyboardInterrupt:
        return INTERRUPTED
    except (JkrollError, typer.TyperException, typer.Abort, OSError) as error:
        if debug:
            import traceback

            traceback.print_exc()
        return _report(error)


def _report(error: Exception) -> int:
    """Print an error as one line on stderr, and return the exit code."""
    if isinstance(error, JkrollError):
        message, code = str(error), error.exit_code
    elif isinstance(error, OSError):
        message, code = f"cannot write: {error.strerror or error}", CANNOT_WRITE
        _forget(sys.stdout)
    else:
        text = error.format_message() if hasattr(error, "format_message") else str(error)
        message, code = quoted(" ".join(text.split()), limit=1000)[1:-1], USAGE_ERROR
    try:
        say(f"jkroll: {message}", sys.stderr)
    except OSError:
        _forget(sys.stderr)
    return code


def _forget(stream: Any) -> None:
    """Keep the interpreter from writing once more what could not be written."""
    try:
        os.dup2(os.open(os.devnull, os.O_WRONLY), stream.fileno())
    except (OSError, ValueError):
        pass


def _with_minus_signs(words: Sequence[str]) -> list[str]:
    """Negative values with a minus sign in place of the hyphen, so that they are not taken for options."""
    before = [None, *words][: len(words)]
    return [
        "−" + word[1:] if _NEGATIVE.match(word) and option not in _TAKES_NO_QUANTITY else word
        for option, word in zip(before, words, strict=True)
    ]


_NEGATIVE = re.compile(r"-[0-9.]")
_TAKES_NO_QUANTITY = ("--to", "--digits", "--materials")


def _command_of(words: Sequence[str]) -> str | None:
    """The command that an argument list, or a completion request in the environment, is about."""
    if os.environ.get("_JKROLL_COMPLETE"):
        words = os.environ.get("COMP_WORDS", os.environ.get("_TYPER_COMPLETE_ARGS", "")).split()[1:]
    return next((word for word in words if not word.startswith("-")), None)


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
        function = _command_function(name, command, complete=name == only)
        app.command(
            name, cls=CompactCommand, help=command.sentence, epilog=_EPILOG.format(name=name, example=command.example)
        )(function)
    app.command(
        "materials",
        cls=CompactCommand,
        help="The materials that are known, or one of them whole.",
        epilog="Example: jkroll materials quartz",
    )(_materials_function)
    return app


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


def _materials_function(
    name: Annotated[
        str | None, typer.Argument(metavar="[NAME]", autocompletion=complete_words, show_default=False)
    ] = None,
    json: Annotated[bool, typer.Option("--json", help="Format of the output.")] = False,
    csv: Annotated[bool, typer.Option("--csv", help="Format of the output.")] = False,
    cite: Annotated[bool, typer.Option("--cite", help="BibTeX of the sources.")] = False,
    materials: Annotated[str | None, typer.Option("--materials", metavar="FILE", help="Materials of your own.")] = None,
    quiet: Annotated[bool, typer.Option("--quiet", help="No notes.")] = False,
) -> Call:
    output = Output(json=json, csv=csv, cite=cite, quiet=quiet, materials=materials, configuration=_configuration())
    return partial(run_materials, name, output)


def _command_function(name: str, command: Command, complete: bool) -> Callable[..., Call]:
    """The function that typer calls for a command, with a signature made from the nomenclature."""

    def function(**values: Any) -> Call:
        words = values.pop("words")
        output = Output(
            **{key: values.pop(key) for key in (*_OUTPUT, "rtol", "curve") if key in values},
            configuration=_configuration(),
        )
        return partial(
            run_command, command, words, {key: text for key, text in values.items() if text is not None}, output
        )

    parameters = _parameters(command) if complete else []
    function.__signature__ = Signature(parameters)  # type: ignore[attr-defined]
    function.__annotations__ = {parameter.name: parameter.annotation for parameter in parameters}
    function.__name__ = name.replace("-", "_")
    return function


def _configuration() -> Path:
    return Path(typer.get_app_dir("jkroll")) / "materials.toml"


_EPILOG = """Lists (1nm,1um) and ranges (1nm:1um:50, or :50:lin) give a row each.

Example: jkroll {name} {example}"""
_ALWAYS = ("radius2", "material2", "surface_energy", "work_of_adhesion", "youngs_modulus", "poisson_ratio", "density")
_HIDDEN = ("atomic_spacing", "energy_ratio")
_SPHERE_2 = ("surface_energy2", "youngs_modulus2", "poisson_ratio2", "density2")
_RTOL = typer.Option("--rtol", metavar="1e-3", min=0.0, max=1.0, help="Cheapest model of rolling that is this good.")
_CURVE = typer.Option("--curve", help="The whole force curve, both branches, as rows.")
_OUTPUT: Mapping[str, tuple[Any, Any]] = {
    "to": (str | None, typer.Option("--to", metavar="UNIT", help="Unit of the results; several with commas.")),
    "digits": (int | None, typer.Option("--digits", metavar="N", min=1, max=17, help="Significant digits.")),
    "bare": (bool, typer.Option("--bare", help="Format: numbers only, JSON, or a CSV table.")),
    "json": (bool, typer.Option("--json", help="Format: numbers only, JSON, or a CSV table.")),
    "csv": (bool, typer.Option("--csv", help="Format: numbers only, JSON, or a CSV table.")),
    "explain": (bool, typer.Option("--explain", help="Instead: how it comes about; what to cite.")),
    "cite": (bool, typer.Option("--cite", help="Instead: how it comes about; what to cite.")),
    "materials": (str | None, typer.Option("--materials", metavar="FILE", help="Materials of your own.")),
    "quiet": (bool, typer.Option("--quiet", help="No notes.")),
}


def _parameters(command: Command) -> list[Parameter]:
    """The parameters of a command: words, the inputs its quantities depend on, and the ways to write the results."""
    argument = typer.Argument(metavar="[MATERIAL] [RADIUS]...", autocompletion=complete_words, show_default=False)
    parameters = [_parameter("words", list[str] | None, argument)]
    depends = depends_on(command.quantities)
    for name in (*_ALWAYS, *_SPHERE_2, "atomic_spacing", *(name for name in NOMENCLATURE if name in depends)):
        quantity = NOMENCLATURE[name]
        if not quantity.option or any(parameter.name == name for parameter in parameters):
            continue
        option = typer.Option(
            quantity.option,
            metavar=quantity.example,
            help=f"{quantity.sentence[0].upper()}{quantity.sentence[1:]}{_default_text(name)}.",
            hidden=name in (*_SPHERE_2, *_HIDDEN) or name not in (*depends, "material2", "radius2"),
            autocompletion=complete_input(name),
            show_default=False,
        )
        parameters.append(_parameter(name, str | None, option))
    if set(command.quantities) & {*OF_MOMENT, *OF_SLOPE} and command is not COMMANDS["report"]:
        parameters.append(_parameter("rtol", float | None, _RTOL))
    if command is COMMANDS["contact"]:
        parameters.append(_parameter("curve", bool, _CURVE))
    return parameters + [_parameter(name, kind, option) for name, (kind, option) in _OUTPUT.items()]


def _parameter(name: str, kind: Any, declaration: Any) -> Parameter:
    default = False if kind is bool else None
    return Parameter(name, Parameter.KEYWORD_ONLY, default=default, annotation=Annotated[kind, declaration])


def _default_text(name: str) -> str:
    from .formatting import amount

    if name == "material2":
        return ", or --gamma2, --young2, ..."
    return f", default {amount(name, DEFAULTS[name])}" if name in DEFAULTS else ""
