"""Options of the command line: how each is typed, what its value may be, and what the help says of it."""

from collections.abc import Mapping
from functools import cache
from types import MappingProxyType
from typing import Any, NamedTuple

from ..errors import BadRequest
from ..quantities.nomenclature import NOMENCLATURE
from ..text import capitalized, quoted

MAX_DIGITS = 9  # of a number


class Option(NamedTuple):
    """An option, by the name of its value in `Call`, in the settings of `batch`, or in the nomenclature.

    The help of an input is its sentence in the nomenclature, unless the option has a text of its own.
    """

    name: str
    flag: str
    kind: type[str] | type[int] | type[bool]
    metavar: str = ""
    help: str = ""
    low: int = 0  # of a number
    high: int = 0
    hidden: bool = False
    short: str = ""
    repeats: bool = False  # the values are a tuple

    @property
    def flags(self) -> tuple[str, ...]:
        """The spellings of the option."""
        return (self.flag, self.short) if self.short else (self.flag,)

    def read(self, text: str) -> str | int:
        """Return the value that a text stands for, or raise BadRequest."""
        if self.kind is str:
            return text
        is_number = text.isascii() and text.isdigit() and len(text) <= MAX_DIGITS
        if not is_number or not self.low <= (number := int(text)) <= self.high:
            raise BadRequest(f"{self.flag}: {quoted(text, 40)} is not a whole number from {self.low} to {self.high}")
        return number

    def sentence(self) -> str:
        """Return the help text: meaning, range and default."""
        if self.help:
            span = f", {self.low} to {self.high}" if self.kind is int else ""
            return f"{self.help}{span}."
        from ..quantities.formatting import amount
        from ..scene.scene import DEFAULTS

        meaning = NOMENCLATURE[self.name].sentence
        default = f", default {amount(self.name, DEFAULTS[self.name])}" if self.name in DEFAULTS else ""
        others = ", or --gamma2 and so on" if self.name == "material2" else ""
        return f"{capitalized(meaning)}{default}{others}."


class Call(NamedTuple):
    """One call of a command: its words, and its options by name. A command reads those that it declares."""

    command: str = ""
    words: tuple[str, ...] = ()
    inputs: Mapping[str, str] = MappingProxyType({})  # of the scene: texts, by the names of the nomenclature
    materials: str | None = None
    quiet: bool = False
    # how results are written
    to: str | None = None
    digits: int | None = None
    bare: bool = False
    json: bool = False
    csv: bool = False
    explain: bool = False
    cite: bool = False
    measured: tuple[str, ...] = ()
    target: str | None = None
    curve: bool = False
    # of pictures
    x: str | None = None
    y: str | None = None
    mark: str = ""
    data: str | None = None
    width: str | None = None
    style: str | None = None
    uncaptioned: bool = False
    panel: str | None = None
    as_printed: bool = False
    plain: bool = False
    # of tables
    quantities: str = ""
    infer: str = ""
    no_doubt: bool = False
    settings: Mapping[str, Any] = MappingProxyType({})  # of `batch` alone: fields of its Settings
    # of the measurements of speed
    quick: bool = False
    plot: str | None = None


_FORMAT = "Numbers only, JSON or CSV; output file"
_INSTEAD = "Show the derivation or the BibTeX entry instead of results"
MATERIALS = Option("materials", "--materials", str, "FILE", "Read materials from your own file as well")
NO_DOUBT = Option("no_doubt", "--no-doubt", bool, "", "Omit the column of doubts")
QUIET = Option("quiet", "--quiet", bool, "", "Suppress notes")
EXPLAIN = Option("explain", "--explain", bool, "", _INSTEAD)
CITE_ANSWER = Option("cite", "--cite", bool, "", _INSTEAD)
RESULTS = (
    Option("to", "--to", str, "UNIT", "Unit of the results; several with commas"),
    Option("digits", "--digits", int, "N", "Significant digits", 1, 17),
    Option("bare", "--bare", bool, "", _FORMAT),
    Option("json", "--json", bool, "", _FORMAT),
    Option("csv", "--csv", bool, "", _FORMAT),
)
OUTPUT = (
    Option("quantities", "--quantities", str, "NAMES", "Show these quantities instead, separated by commas"),
    *RESULTS,
    Option("target", "-o", str, "OUT", _FORMAT),
    NO_DOUBT._replace(hidden=True),
    EXPLAIN,
    CITE_ANSWER,
    MATERIALS,
    QUIET,
)
MEASURED = Option(
    "measured",
    "--measured",
    str,
    "QUANTITY=VALUE",
    "Measured quantity, twice for two inputs; an error bar as in 300±20nN",
    repeats=True,
)
CURVE = Option("curve", "--curve", bool, "", "Whole force curve; with -o as a picture")
MARKED = Option(
    "yield_displacement", "--xi", str, "2angstrom", "Displacement that the panel of moments marks", hidden=True
)
_AS_TEXT = "Output as JSON or CSV"
JSON = Option("json", "--json", bool, "", _AS_TEXT)
CSV = Option("csv", "--csv", bool, "", _AS_TEXT)
CITE = Option("cite", "--cite", bool, "", "Show the BibTeX entries of the data")

MODEL_OF_EXPORT = Option("model", "--model", str, "dmt", "Law of attraction, jkr (the default) or dmt")

_AXIS = "NAME=FROM:TO, with :lin for a linear axis"
AXES = (Option("x", "--x", str, "AXIS", _AXIS), Option("y", "--y", str, "AXIS", _AXIS))
AS_PRINTED = Option("as_printed", "--as-printed", bool, "", "Add Eq (41) as printed to 6b, dashed")
_OMITTED = "Omit title and caption; the limits of the model"
STYLE = (
    Option("width", "--width", str, "85mm", "Width of the drawing"),
    Option("style", "--style", str, "dark", "Colours, paper or dark"),
    Option("uncaptioned", "--no-caption", bool, "", _OMITTED),
)
PANEL = Option("panel", "--panel", str, "force", "One panel only: force, pressure or moment")
PICTURE = (
    Option("mark", "--mark", str, "quartz@100nm", "Mark grains as points, separated by commas"),
    Option("data", "--data", str, "FILE", "Write the numbers as CSV; - is standard output"),
    Option("target", "-o", str, "FILE", "Draw a .svg, .pdf or .png file (plot extra)"),
    *STYLE,
    Option("plain", "--plain", bool, "", _OMITTED),
    MATERIALS,
    QUIET,
)

_DEFAULT = "Material of rows whose cell is empty; the inputs below work likewise"
TABLE = (
    Option("target", "--output", str, "OUT", "Output file (written atomically)", short="-o"),
    Option("format", "--format", str, "FORMAT", "csv, tsv, ndjson or parquet, if no name says so; with .gz, .zst"),
    Option("delimiter", "--delimiter", str, "WORD", "What divides columns: comma, semicolon, bar, tab or blank"),
    Option("quantities", "--quantities", str, "NAMES", "Quantities to compute, separated by commas; default all"),
    Option(
        "columns",
        "--column",
        str,
        "HEADER=INPUT",
        "Read a column as an input, or, with nothing behind =, as none",
        repeats=True,
    ),
    Option("infer", "--infer", str, "INPUT", "Find this input of each row from the measured quantity of --measured"),
    Option(
        "measured",
        "--measured",
        str,
        "QUANTITY",
        "The quantity whose measured values a column has, for --infer",
        repeats=True,
    ),
    Option("strict", "--strict", bool, "", "Stop at the first row that fails"),
    Option("resume", "--resume", bool, "", "Convert what is left of many tables"),
    NO_DOUBT,
    Option("uncertainty", "--uncertainty", bool, "", "Add columns of error bars, though the first rows have none"),
    Option("jobs", "--jobs", int, "N", "Number of processes (default: one per core)", 1, 64),
    Option("dask", "--dask", str, "ADDRESS", "Convert many tables on a Dask cluster; local starts one"),
    Option("excel_safe", "--excel-safe", bool, "", "Escape text that a spreadsheet would run"),
    Option("material", "--material", str, "NAME", _DEFAULT),
    *(
        Option(name, quantity.option or "--radius", str, quantity.example, hidden=True)
        for name, quantity in NOMENCLATURE.items()
        if quantity.example
    ),
    MATERIALS,
    QUIET,
)
BENCH = (
    Option("quick", "--quick", bool, "", "Measure fewer points"),
    Option("plot", "--plot", str, "FILE", "Draw error against cost (needs the plot extra)"),
    *STYLE,
    JSON,
    CSV,
)

# The options that every command takes, and those of the program before any command.
HELP = Option("help", "--help", bool, "", "Show this message and exit", short="-h")
VERSION = Option("version", "--version", bool, "", "Show the version and exit")
DEBUG = Option("debug", "--debug", bool, "", "Show where an error comes from")
PROGRAM = (
    VERSION,
    DEBUG,
    Option("install_completion", "--install-completion", bool, "", "Install completion for the current shell"),
    Option("show_completion", "--show-completion", bool, "", "Print the completion script of the current shell"),
    HELP,
)

# Inputs that every question takes: shown where they are used, and among the further options.
_ALWAYS = ("radius2", "material2", "surface_energy", "work_of_adhesion", "youngs_modulus", "poisson_ratio", "density")
_HIDDEN = ("surface_energy2", "youngs_modulus2", "poisson_ratio2", "density2", "atomic_spacing")
_HIDDEN_WHERE_USED = ("energy_ratio", "adhesion_hysteresis", "hysteresis_fraction", "hamaker", "hamaker2", "cutoff")


@cache
def inputs_of(quantities: tuple[str, ...], *, any_input: bool = False) -> tuple[Option, ...]:
    """Return the options for the inputs that quantities depend on, and with `any_input` for all others, too.

    The properties of a material are taken by every command, but shown only where they are used.
    """
    from ..quantities.laws import LAWS
    from ..scene.wiring import depends_on, has_law

    depends = depends_on(quantities, LAWS)
    if any(map(has_law, quantities)):
        depends |= {"model"}
    names = dict.fromkeys((*_ALWAYS, *_HIDDEN, *(name for name in NOMENCLATURE if any_input or name in depends)))
    shown = {*depends, "material2", "radius2"} - {*_HIDDEN, *_HIDDEN_WHERE_USED}
    return tuple(
        Option(name, quantity.option, str, quantity.example, hidden=name not in shown)
        for name, quantity in ((name, NOMENCLATURE[name]) for name in names)
        if quantity.option
    )
