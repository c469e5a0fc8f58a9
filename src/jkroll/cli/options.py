"""The options of the commands, each with its spelling, its help and the type of its value in a call."""

from collections.abc import Mapping
from copy import copy
from typing import Any, Generic, Self, TypeVar, overload

from ..errors import BadRequest
from ..quantities.nomenclature import DEFAULTS, NOMENCLATURE
from ..text import capital, quoted

Value = TypeVar("Value")

# Alternatives and defaults that the help adds to the sentence of an input.
_ADDED_TO_SENTENCE = {
    "material2": ", or --gamma2, --young2, --shear-modulus2, --poisson2, --density2",
    "surface_energy": ", or --work-of-adhesion",
    "diameter": ", --diameter2 of sphere 2",
    "youngs_modulus": ", or rigid, with --poisson 0.3",
    "yield_displacement": (
        ", decides the answer: jkroll guide measurements; or --adhesion-hysteresis, --hysteresis-fraction"
    ),
    "load": ", or --approach",
    "energy": ", or --energy-ratio, --speed",
}


class Option(Generic[Value]):
    """An option of a command: `Options.quiet` is the option, `call.quiet` its value in a call.

    An option without a `metavar` is a switch. Otherwise its value is an integer from 1 to `most`, a text if `most` is
    0, or a tuple of texts if the option `repeats`. The help lists options by `group`, and `hidden` options by their
    flags alone. Without `help`, the option of an input has the sentence of the nomenclature.
    """

    def __init__(
        self, default: Value, flag: str, help: str = "", metavar: str = "", most: int = 0, *, name: str = "",
        short: str = "", hidden: bool = False, repeats: bool = False, group: str = "Output",
        needs: str = "", excludes: str = "",
    ) -> None:  # fmt: skip
        """`needs`: names of options, one of which must be given; `excludes`: options that must not be given."""
        self.default, self.flag, self.help, self.metavar, self.most = default, flag, help, metavar, most
        self.name, self.short, self.hidden, self.repeats, self.group = name, short, hidden, repeats, group
        self.needs, self.excludes = needs.split(), excludes.split()

    def __set_name__(self, owner: type, name: str) -> None:
        self.name = name

    @overload
    def __get__(self, call: None, owner: type) -> Self: ...
    @overload
    def __get__(self, call: "Options", owner: type) -> Value: ...
    def __get__(self, call: "Options | None", owner: type) -> "Self | Value":
        return self if call is None else call.given.get(self.name, self.default)

    @property
    def flags(self) -> tuple[str, ...]:
        """The spellings of the option."""
        return (self.flag, self.short) if self.short else (self.flag,)

    def but(self, **changes: Any) -> Self:
        """Return the option with some attributes changed, such as its help, for one command."""
        other = copy(self)
        vars(other).update(changes)
        return other

    def parsed(self, text: str) -> str | int:
        """Return the value that a text means; raise BadRequest if it is invalid."""
        if not text and self.name == "target":
            raise BadRequest(f"{self.flags[-1]}: the name of the output file is empty")
        if not self.most:
            return text
        if text not in map(str, range(1, self.most + 1)):
            raise BadRequest(f"{self.flag}: {quoted(text, 40)} is not a whole number from 1 to {self.most}")
        return int(text)

    def sentence(self) -> str:
        """Return the help text: the meaning, the accepted range or the default, and alternatives."""
        if self.help:
            span = f", 1 to {self.most}" if self.most else ""
            return f"{self.help}{span}."
        from ..quantities.formatting import amount

        meaning = NOMENCLATURE[self.name].sentence
        default = f", default {amount(self.name, DEFAULTS[self.name])}" if self.name in DEFAULTS else ""
        return f"{capital(meaning)}{default}{_ADDED_TO_SENTENCE.get(self.name, '')}."


def _switch(flag: str, help: str, **others: Any) -> Option[bool]:
    return Option(False, flag, help, **others)


def _text(flag: str, help: str, metavar: str, **others: Any) -> Option[str | None]:
    return Option(None, flag, help, metavar, **others)


def _texts(flag: str, help: str, metavar: str, **others: Any) -> Option[tuple[str, ...]]:
    return Option((), flag, help, metavar, repeats=True, **others)


def _number(flag: str, help: str, metavar: str, most: int) -> Option[int | None]:
    return Option(None, flag, help, metavar, most)


# Options with the same text share a line of the help.
_FORMAT = "JSON, CSV, Markdown; --bare numbers; -o a file"
_INSTEAD = "Derivation; BibTeX, with --tex for Methods"
_OMITTED = "Omit title and caption, or the limits"
_AXIS = "NAME=FROM:TO, with :lin for a linear axis"


class Options:
    """The values of the options of a call, except for inputs. `commands.py` lists the options of each command."""

    def __init__(self, given: Mapping[str, Any]) -> None:
        """`given`: values by the names of options. Raises BadRequest for options that exclude or need others."""
        self.given = given
        for option in ALL_OPTIONS:
            if option.name in given:
                _check(option, given)

    # For most commands
    file = _text("--materials", "Read your own materials as well", "FILE")
    quiet = _switch("--quiet", "Suppress notes")

    # For results
    quantities = _text("--quantities", "Show these quantities instead, comma-separated", "NAMES", excludes="infer")
    to = _text("--to", "Units of results, comma-separated; --digits N", "UNIT")
    digits = _number("--digits", "Significant digits", "N", 17)
    json = _switch("--json", _FORMAT, excludes="bare")
    csv = _switch("--csv", _FORMAT, excludes="bare json")
    md = _switch("--md", _FORMAT, excludes="bare json csv")
    bare = _switch("--bare", "Only the numbers")
    target = _text("-o", "Write a file", "OUT")
    no_doubt = _switch("--no-doubt", "Omit the column of doubts")
    best = _switch("--best", "Add columns of the best range of each result", excludes="bare")
    explain = _switch("--explain", _INSTEAD, excludes="bare json csv md best curve")
    cite = _switch("--cite", _INSTEAD, excludes="bare json csv md explain best curve")
    tex = _switch("--tex", "Instead of BibTeX, a paragraph for a Methods section", needs="cite")
    measured = _texts("--measured", "Measured quantity, twice for two inputs; an error bar as in 300±20nN",
        "QUANTITY=VALUE", group="Measured")  # fmt: skip
    curve = _switch("--curve", "Whole force curve; with -o x.svg a picture", excludes="best")

    # For pictures
    x = _text("--x", _AXIS, "AXIS", group="Axes")
    y = _text("--y", _AXIS, "AXIS", group="Axes")
    mark = Option("", "--mark", "Mark grains as points, separated by commas", "quartz@100nm")
    data = _text("--data", "Write the numbers as CSV; - is stdout", "FILE")
    width = _text("--width", "Width of the drawing, 70mm to 1m", "85mm")
    style = _text("--style", "Colours, paper or dark", "dark")
    uncaptioned = _switch("--no-caption", "Omit title and caption")
    plain = _switch("--plain", _OMITTED)
    panel = _text("--panel", "One panel only: force, pressure or moment", "force")
    as_printed = _switch("--as-printed", "Add Eq (41) as printed to 6b, dashed")

    # For tables
    format = Option(
        "", "--format", "csv, tsv, ndjson or parquet, if the file name has no such ending; .gz, .zst", "FORMAT"
    )
    delimiter = Option("", "--delimiter", "Column separator: comma, semicolon, bar, tab or blank", "WORD",
        excludes="format")  # fmt: skip
    columns = _texts("--column", "Read a column as an input; pass it through if nothing follows =", "HEADER=INPUT")
    infer = _text("--infer", "Infer this input of each row from a measured quantity", "INPUT", group="Measured")
    pass_rest = _switch("--pass-rest", "Pass through all columns that are not read")
    strict = _switch("--strict", "Stop at the first row that fails")
    resume = _switch("--resume", "Of many tables, skip those whose output is not older")
    uncertainty = _switch("--uncertainty", "Add columns of uncertainties even if the first rows have none")
    jobs = Option(0, "--jobs", "Number of processes (default: one per core, at most 16)", "N", 64)
    dask = Option("", "--dask", "Convert many tables on a Dask cluster", "ADDRESS")
    excel_safe = _switch("--excel-safe", "Escape text that a spreadsheet would run")

    # For measured force curves
    spring = _text("--spring", "Stiffness of the lever, for a travel or a deflection", "3.01±0.1N/m", group="Curve")
    branch = Option("both", "--branch", "both, load or unload", "BRANCH", group="Curve")
    range = _text(
        "--range", "Loads to fit: parts of the largest tension and load, or forces", "-100%:30%", group="Curve"
    )
    baseline = Option("median", "--baseline", "median, or tilt: lines through the parts out of contact", "KIND",
        group="Curve")  # fmt: skip

    # For the benchmark
    quick = _switch("--quick", "Measure fewer points")
    plot = _text("--plot", "Draw error against cost (needs the plot extra)", "FILE")


ALL_OPTIONS: list[Option[Any]] = [option for option in vars(Options).values() if isinstance(option, Option)]


def _check(option: Option[Any], given: Mapping[str, Any]) -> None:
    """Raise BadRequest if a given option conflicts with others, or lacks one that it needs."""
    for name in option.excludes:
        if name in given:
            raise BadRequest(f"{vars(Options)[name].flag} and {option.flag} exclude each other")
    if option.needs and not any(name in given for name in option.needs):
        needed = " or ".join(vars(Options)[name].flag for name in option.needs)
        raise BadRequest(f"{option.flag} goes with {needed}")


# --help is an option of every command and of the program, the others only of the program.
HELP = _switch("--help", "Show this message and exit", name="help", short="-h")
VERSION = _switch("--version", "Show the version and exit", name="version")
DEBUG = _switch("--debug", "Show where an error comes from", name="debug")
PROGRAM = (
    VERSION,
    DEBUG,
    _switch("--install-completion", "Install completion for the current shell", name="install_completion"),
    _switch("--show-completion", "Print the completion script of the current shell", name="show_completion"),
    HELP,
)
