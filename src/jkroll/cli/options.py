"""The options of every command, declared once: typer, the quick reader of `shell`, help and completion are made from them."""

from typing import NamedTuple

from ..answers.questions import COMMANDS, Command
from ..quantities.nomenclature import INFINITY, NOMENCLATURE
from ..scene.rolling_models import OF_MEAN, OF_PEAK, OF_SLOPE


class Option(NamedTuple):
    """An option of a command: the name of its value, how it is typed, its kind, and how the help shows it.

    Without a text of its own, the help of an input is its sentence in the nomenclature.
    """

    name: str
    flag: str
    kind: type
    metavar: str
    help: str = ""
    low: float | None = None
    high: float | None = None
    hidden: bool = False
    short: str = ""

    @property
    def flags(self) -> tuple[str, ...]:
        """All its spellings."""
        return (self.flag, self.short) if self.short else (self.flag,)


_FORMAT = "Numbers only, JSON, CSV; or to a file."
_INSTEAD = "Instead: how it comes about; what to cite."
OUTPUT = (
    Option("to", "--to", str, "UNIT", "Unit of the results; several with commas."),
    Option("digits", "--digits", int, "N", "Significant digits.", 1, 17),
    Option("bare", "--bare", bool, "", _FORMAT),
    Option("json", "--json", bool, "", _FORMAT),
    Option("csv", "--csv", bool, "", _FORMAT),
    Option("target", "-o", str, "OUT", _FORMAT),
    Option("resume", "--resume", bool, "", "Go on with that file after an interrupt.", hidden=True),
    Option("explain", "--explain", bool, "", _INSTEAD),
    Option("cite", "--cite", bool, "", _INSTEAD),
    Option("materials", "--materials", str, "FILE", "Materials of your own."),
    Option("quiet", "--quiet", bool, "", "No notes."),
)
_RTOL = Option("rtol", "--rtol", float, "1e-3", "Cheapest model of rolling that is this good.", 0.0, 1.0)
_CURVE = Option("curve", "--curve", bool, "", "The whole force curve: rows, or a picture (-o).")
_INTO_FILE = Option("target", "-o", str, "FILE", "Draw a .svg, .pdf or .png (plot extra).")
_PICTURE = (
    Option("width", "--width", str, "85mm", "Width of what is drawn."),
    Option("style", "--style", str, "dark", "Colours, paper or dark."),
    Option("uncaptioned", "--no-caption", bool, "", "No caption below it."),
)
_PANEL = Option("panel", "--panel", str, "force", "One panel only: force, pressure or moment.")
_AXIS = "NAME=FROM:TO, with :lin if it is not log."
_DATA = Option("data", "--data", str, "FILE", "The numbers as CSV; - is stdout.")
_MARK = Option("mark", "--mark", str, "quartz@100nm", "A grain as a point; several with commas.")


# What typer adds of its own: to every command, and to the program before any.
HELP = tuple(Option("help", flag, bool, "", "Show this message and exit.") for flag in ("-h", "--help"))
PROGRAM = (
    Option("version", "--version", bool, "", "Show the version and exit."),
    Option("install_completion", "--install-completion", bool, "", "Install completion for the current shell."),
    Option(
        "show_completion",
        "--show-completion",
        bool,
        "",
        "Show completion for the current shell, to copy it or customize the installation.",
    ),
    *HELP,
)


class Extra(NamedTuple):
    """A command that asks no scene."""

    sentence: str
    example: str
    options: tuple[Option, ...]
    argument: str = ""
    takes_scene: bool = False  # materials, radii and inputs besides


def _some(*names: str) -> tuple[Option, ...]:
    return tuple(option for option in OUTPUT if option.name in names)


_FILLS = "Fills what rows do not give; so do --radius, --gamma, --load ..."
_SCENE = (
    Option("material", "--material", str, "NAME", _FILLS),
    Option("radius", "--radius", str, "", _FILLS, hidden=True),
    *(
        Option(name, quantity.option, str, "", _FILLS, hidden=True)
        for name, quantity in NOMENCLATURE.items()
        if quantity.option
    ),
)

EXTRAS = {
    "batch": Extra(
        "Tables of scenes: the same rows with their results.",
        "grains.csv -o forces.csv",
        (
            Option("target", "--output", str, "OUT", "Where to; it appears when it is whole.", short="-o"),
            Option("format", "--format", str, "FORMAT", "csv, tsv, ndjson or parquet, if no name says so; .gz, .zst."),
            Option(
                "quantities", "--quantities", str, "NAMES", "What to compute, with commas; else all that is possible."
            ),
            Option("strict", "--strict", bool, "", "Stop at the first row that fails."),
            Option("resume", "--resume", bool, "", "Go on after an interrupt."),
            Option("jobs", "--jobs", int, "N", "Processes; one for each core.", 1, 64),
            Option("dask", "--dask", str, "ADDRESS", "Many tables on a Dask cluster, or on a local one."),
            Option("excel_safe", "--excel-safe", bool, "", "No cell of text that a spreadsheet takes for a formula."),
            *_SCENE,
            *_some("materials", "quiet"),
        ),
        "[IN]",
    ),
    "materials": Extra(
        "The materials that are known, or one of them whole.",
        "quartz",
        _some("json", "csv", "cite", "materials", "quiet"),
        "[NAME]",
    ),
    "verify": Extra("The audit of the paper, computed anew.", "--csv", _some("json", "csv")),
    "bench": Extra(
        "Speed against error of every way to every number.",
        "--quick --csv",
        (
            Option("quick", "--quick", bool, "", "Fewer points."),
            Option("plot", "--plot", str, "FILE", "Draw error against cost (needs the plot extra)."),
            *_some("json", "csv"),
        ),
    ),
    "map": Extra(
        "Any quantity over two inputs as a map, or over one as curves.",
        "pull-off --x radius=1nm:1mm --y gamma=1mJ/m2:10J/m2",
        (
            Option("x", "--x", str, "AXIS", _AXIS),
            Option("y", "--y", str, "AXIS", _AXIS),
            _MARK,
            _DATA,
            _INTO_FILE,
            *_PICTURE,
            *_some("materials", "quiet"),
        ),
        "QUANTITY [MATERIAL] [RADIUS]...",
        takes_scene=True,
    ),
    "figure": Extra(
        "A figure of the paper, from its equations.",
        "3a --mark quartz@100nm",
        (
            Option("as_printed", "--as-printed", bool, "", "In 6b, Eq (41) as it is printed, dashed."),
            _MARK,
            _DATA,
            _INTO_FILE,
            *_PICTURE,
            *_some("materials", "quiet"),
        ),
        "NAME",
    ),
}

_ALWAYS = ("radius2", "material2", "surface_energy", "work_of_adhesion", "youngs_modulus", "poisson_ratio", "density")
_HIDDEN = ("surface_energy2", "youngs_modulus2", "poisson_ratio2", "density2", "atomic_spacing", "energy_ratio")


def options_named(name: str) -> tuple[Option, ...]:
    """The options of a command by its name, whether it asks a scene or not."""
    if name in COMMANDS:
        return options_of(COMMANDS[name])
    extra = EXTRAS[name]
    return (*extra.options, *_inputs(COMMANDS["report"])) if extra.takes_scene else extra.options


def options_of(command: Command) -> tuple[Option, ...]:
    """The options of a command: the inputs its quantities depend on, and the ways to write the results.

    The properties of a material are taken by every command, but shown only where they are used.
    """
    has_models = {*OF_PEAK, *OF_MEAN, *OF_SLOPE} & {*command.quantities} and command is not COMMANDS["report"]
    models = (_RTOL,) if has_models else ()
    looks = tuple(option._replace(hidden=True) for option in (*_PICTURE, _PANEL))
    curve = (_CURVE, *looks) if command is COMMANDS["contact"] else ()
    return (*_inputs(command), *models, *curve, *OUTPUT)


def _inputs(command: Command) -> tuple[Option, ...]:
    """The inputs that the quantities of a command depend on."""
    from ..scene.wiring import depends_on

    depends = depends_on(command.quantities)
    names = dict.fromkeys((*_ALWAYS, *_HIDDEN, *(name for name in NOMENCLATURE if name in depends)))
    shown = {*depends, "material2", "radius2"} - {*_HIDDEN}
    return tuple(
        Option(name, quantity.option, str, quantity.example, hidden=name not in shown)
        for name, quantity in ((name, NOMENCLATURE[name]) for name in names)
        if quantity.option and (name != "energy_ratio" or name in depends)
    )


def sentences() -> dict[str, str]:
    """Every command and what it does."""
    sentences = {name: command.sentence for name, command in COMMANDS.items()}
    return sentences | {name: extra.sentence for name, extra in EXTRAS.items()}


def flags_of(name: str | None) -> dict[str, Option]:
    """All that a command takes, or the program before any, by what is typed for it."""
    if name is None:
        return {option.flag: option for option in PROGRAM}
    return {flag: option for option in (*options_named(name), *HELP) for flag in option.flags}


def room_for_words(name: str) -> float:
    """How many words a command takes besides its options."""
    takes_any = name in COMMANDS or EXTRAS[name].takes_scene
    return INFINITY if takes_any else len(EXTRAS[name].argument.split())


def sentence_of(option: Option) -> str:
    """What the help says of an option: of an input its sentence in the nomenclature, and its default."""
    if option.help:
        span = "" if option.low is None else f", {option.low:g} to {option.high:g}"
        return f"{option.help.removesuffix('.')}{span}."
    from ..quantities.formatting import amount
    from ..scene.scene import DEFAULTS

    name, sentence = option.name, NOMENCLATURE[option.name].sentence
    default = f", default {amount(name, DEFAULTS[name])}" if name in DEFAULTS else ""
    others = ", or --gamma2 and the like" if name == "material2" else ""
    return f"{sentence[0].upper()}{sentence[1:]}{default}{others}."
