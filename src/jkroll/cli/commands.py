"""The commands: their arguments and options, their runners, and their help on a terminal."""

import re
from collections.abc import Callable, Iterable, Mapping, Sequence
from functools import cache
from typing import Any

from ..quantities.nomenclature import INFINITY, NOMENCLATURE
from ..report.questions import QUESTIONS
from ..text import terminal_width, wrapped
from .options import HELP, PROGRAM, Option, Options

# --- Options that are not inputs --------------------------------------------------------------------------------------

OUTPUT = (
    Options.to,
    Options.digits,
    Options.json,
    Options.csv,
    Options.md,
    Options.bare,
    Options.target,
    Options.no_doubt.but(hidden=True),
    Options.best.but(hidden=True),
    Options.explain,
    Options.cite,
    Options.tex,
    Options.file,
    Options.quiet,
)
FORCE_CURVE = (
    Options.curve,
    Option(None, "--xi", "Displacement that the panel of moments marks", "2angstrom", name="yield_displacement",
        hidden=True),
    *(option.but(hidden=True) for option in (Options.width, Options.style, Options.uncaptioned, Options.panel)),
)  # fmt: skip
_AS_TEXT = "Output as JSON, CSV or Markdown"
TEXT_FORMATS = (Options.json.but(help=_AS_TEXT), Options.csv.but(help=_AS_TEXT), Options.md.but(help=_AS_TEXT))
MATERIALS = (
    *TEXT_FORMATS,
    Options.cite.but(help="Show the BibTeX entries of the data"),
    Options.file,
    Options.quiet,
)
_IN_CAPTION = "End the caption with sources; suppress notes"
PICTURE = (
    Options.mark,
    Options.data,
    Options.target.but(help="Draw a .svg, .pdf or .png file (plot extra)", metavar="FILE"),
    Options.width,
    Options.style,
    Options.uncaptioned.but(help=Options.plain.help),
    Options.plain,
    Options.file,
    Options.cite.but(help=_IN_CAPTION),
    Options.quiet.but(help=_IN_CAPTION),
)
BATCH = (
    Options.target.but(flag="--output", short="-o", help="Output file (written atomically)"),
    Options.format,
    Options.delimiter,
    Options.quantities.but(help="Quantities to compute, separated by commas; default those of most commands"),
    Options.columns,
    Options.infer,
    Options.pass_rest,
    Options.measured.but(help="The quantity with measured values in a column", metavar="QUANTITY"),
    Options.strict,
    Options.resume,
    Options.no_doubt,
    Options.best,
    Options.uncertainty,
    Options.jobs,
    Options.dask,
    Options.excel_safe,
    Option(None, "--material", "Material of rows with an empty cell; the inputs below fill such cells, too", "NAME",
        name="material"),
)  # fmt: skip
FIT = (
    Options.spring,
    Options.branch,
    Options.range,
    Options.baseline,
    Options.columns,
    Options.format,
    Options.delimiter,
    Options.curve.but(help="Write the points: residuals and energy release rate"),
    *TEXT_FORMATS,
    Options.target.but(help="Write a file; a picture as x.svg, .pdf or .png"),
    Options.cite.but(help="BibTeX of the law; with --tex a paragraph for Methods"),
    Options.tex.but(hidden=True),
    *(option.but(hidden=True) for option in (Options.width, Options.style, Options.uncaptioned)),
    Options.jobs.but(help="Number of processes for many files"),
    Options.file,
    Options.quiet,
)
BENCH = (Options.quick, Options.plot, Options.width, Options.style, Options.uncaptioned, *TEXT_FORMATS)


# --- Options of inputs ------------------------------------------------------------------------------------------------

# Inputs that every question takes, in the order of the help. Other inputs follow, in the order of the nomenclature.
IN_EVERY_QUESTION = (
    "radius2 diameter diameter2 material2 surface_energy work_of_adhesion youngs_modulus shear_modulus poisson_ratio "
    "density surface_energy2 youngs_modulus2 shear_modulus2 poisson_ratio2 density2 atomic_spacing"
).split()
IN_FIT = (
    "radius radius2 diameter diameter2 reduced_radius youngs_modulus youngs_modulus2 poisson_ratio poisson_ratio2 "
    "model profile atomic_spacing"
).split()
# Inputs whose options the help lists without a text, to fit on a screen. The help of fit has all texts.
WITHOUT_TEXT = (
    "diameter2 shear_modulus surface_energy2 youngs_modulus2 shear_modulus2 poisson_ratio2 density2 atomic_spacing "
    "reduced_radius contact_modulus energy_ratio adhesion_hysteresis hysteresis_fraction hamaker hamaker2 cutoff "
    "viscous_time asperity_radius profile yield_strength contact_angle roughness_gap"
).split()
# Inputs in the group "Pair" of the help, in addition to those of one sphere. The other inputs are in "Assumed".
IN_GROUP_PAIR = (
    "work_of_adhesion reduced_radius contact_modulus monomers contacts filling_factor asperity_radius yield_strength "
    "humidity contact_angle roughness_gap"
).split()


@cache
def input_options(quantities: tuple[str, ...] = ()) -> tuple[Option[Any], ...]:
    """Return the options of the inputs on which quantities depend, and of those that every question takes.

    Without quantities, return the options of all inputs. The help then has texts for the inputs of the report, except
    the diameter and the density.
    """
    used = _depends_on(quantities or QUESTIONS["report"].quantities)
    with_text = {*used, "material2"}.difference(WITHOUT_TEXT)
    others = [name for name in NOMENCLATURE if name in used]
    if not quantities:
        others = [*NOMENCLATURE]
        with_text -= {"diameter", "density"}
    names = dict.fromkeys((*IN_EVERY_QUESTION, *others))
    return tuple([_input(name, hidden=name not in with_text) for name in names if NOMENCLATURE[name].option])


def _depends_on(quantities: tuple[str, ...]) -> set[str]:
    """Return quantities and all names on which they depend under any law; `model` and `profile` if these matter."""
    from ..model.plan import depends_on
    from ..quantities.laws import LAWS, has_formula_for_sphere, varies_by_law

    used = {*depends_on(quantities, tuple(LAWS))}
    if any(map(varies_by_law, depends_on(quantities))):
        used.add("model")
    if has_formula_for_sphere(quantities[0]):  # the question is about the contact itself
        used.add("profile")
    return used


def _input(name: str, *, hidden: bool = False) -> Option[Any]:
    """Return the option of an input; the radius, usually an argument, has the option --radius."""
    quantity = NOMENCLATURE[name]
    return Option(None, quantity.option or "--radius", metavar=quantity.example, name=name, hidden=hidden)


# --- Commands ---------------------------------------------------------------------------------------------------------

Action = Callable[[], int]  # runs a command line and returns the exit code

CONTACT, ROLLING, DUST, DEM, ALL, OTHERS = "Contact", "Rolling", "Dust", "DEM", "All", "Look up"
TASKS = (CONTACT, ROLLING, DUST, DEM, ALL, OTHERS)


class Command:
    """A command. `words`: its arguments other than options, as the help shows them.

    `runner`: the function that answers a call and returns the exit code, as `module:function`. The module is imported
    for the call, so that a command loads only what it uses.
    """

    def __init__(
        self, name: str, sentence: str, words: str, options: Callable[[], tuple[Option[Any], ...]], runner: str,
        example: str, task: str = OTHERS,
    ) -> None:  # fmt: skip
        self.name, self.sentence, self.words, self.options = name, sentence, words, options
        self.runner, self.example, self.task = runner, example, task
        self.placeholders = tuple(word.strip("[].") for word in words.split())  # MATERIAL, RADIUS and so on
        can_vary = "[" in words or "..." in words
        self.most_words = INFINITY if can_vary else len(self.placeholders)
        self.has_subject = words != "" and not words.startswith("[")  # the first word is the subject of the command

    def flags(self) -> dict[str, Option[Any]]:
        """Return the options by their spellings."""
        return _by_flag((*self.options(), HELP))


def _by_flag(options: Iterable[Option[Any]]) -> dict[str, Option[Any]]:
    """Return options by all of their spellings."""
    flags: dict[str, Option[Any]] = {}
    for option in options:
        flags |= dict.fromkeys(option.flags, option)
    return flags


def _options_of_export() -> tuple[Option[Any], ...]:
    from ..write.exports import OF_ANY_LAW, OF_JKR

    law = Option(None, "--model", "Law of attraction, jkr (the default) or dmt", "dmt", name="model")
    inputs = [option for option in input_options(OF_ANY_LAW + OF_JKR) if option.name != law.name]
    return (*inputs, law, Options.file, Options.quiet)


def _options_of_batch() -> tuple[Option[Any], ...]:
    inputs = [_input(name, hidden=True) for name, quantity in NOMENCLATURE.items() if quantity.example]
    return (*BATCH, *inputs, Options.file, Options.quiet)


def _options_of_fit() -> tuple[Option[Any], ...]:
    return (*map(_input, IN_FIT), *FIT)


_PAIR = "[MATERIAL] [RADIUS]..."


def _question(
    name: str, task: str, sentence: str, example: str, *others: Option[Any], runner: str = "runners:run_question"
) -> Command:
    """Return the command of a question. `others`: its own options, between those of inputs and of the output."""
    quantities = () if name == "report" else QUESTIONS[name].quantities

    def options() -> tuple[Option[Any], ...]:
        return (*input_options(quantities), *others, Options.quantities, *OUTPUT)

    return Command(name, sentence, _PAIR, options, runner, example, task)


_COMMANDS = (
    _question("pull-off", CONTACT, "Force that pulls two spheres apart.", "quartz 100nm --to nN"),
    _question("yield-force", ROLLING, "Force that starts a sphere rolling.", "quartz 100nm --load -5nN"),
    _question("r-min", DUST, "Tightest bend of a chain that does not roll.", "100nm --xi 2angstrom"),
    _question("n-grav", DUST, "Longest level chain that holds its weight.", "quartz 100nm --gravity 1.62m/s2"),
    _question("frequencies", CONTACT, "Vibration frequencies of the contact.", "quartz 100nm --radius2 plane"),
    _question("n-roll", DUST, "Turns of a sphere over a fixed one after a collision.", "quartz 1um --speed 10cm/s"),
    _question("contact", CONTACT, "Contact radius, indentation, stiffness and pressure.", "quartz 100nm --load -5nN",
        *FORCE_CURVE,
        runner="runners:run_contact"),
    _question("moment", ROLLING, "Moment that starts rolling, by model.", "quartz 100nm --xi 1angstrom"),
    _question("energies", DUST, "Energies and speeds to break, stick and roll, by author.",
        "quartz 100nm --angle 90deg"),
    _question("impact", DUST, "Restitution and sticking of a head-on collision.", "quartz 1um --speed 1m/s"),
    _question("resistances", ROLLING, "Rolling, sliding, twisting: which gives way first.",
        "quartz 100nm --shear-strength 12MPa"),
    _question("aggregates", DUST, "Speeds at which aggregates restructure and break up.",
        "quartz 100nm --monomers 1000"),
    _question("report", ALL, "The main number of each question that your inputs allow.", "quartz 100nm"),
    Command("export", "Input of LAMMPS, LIGGGHTS, DustSimulation or DustCollider.", "PROGRAM [MATERIAL] [RADIUS]",
        _options_of_export, "runners:run_export", "lammps quartz 100nm --model dmt", DEM),
    Command("infer", "Inputs from measured values.", "INPUT [MATERIAL] [RADIUS]...",
        lambda: (Options.measured, *input_options(), *OUTPUT), "runners:run_infer",
        "gamma quartz 2um --radius2 plane --measured pull_off_force=300±20nN", CONTACT),
    Command("fit", "Work of adhesion and modulus of a force curve.", "FILE...",
        _options_of_fit, "fit:run_fit", "curve.csv --radius 7.5um --radius2 plane --spring 3.01N/m", CONTACT),
    Command("batch", "Results for each row of a table.", "IN",
        _options_of_batch, "runners:run_batch", "grains.csv -o forces.csv", ALL),
    Command("map", "Draw a quantity over two inputs as a map, or over one as curves.",
        "QUANTITY [MATERIAL] [RADIUS]...", lambda: (Options.x, Options.y, *input_options(), *PICTURE), "draw:run_map",
        "pull-off --x radius=1nm:1mm --y gamma=1mJ/m2:10J/m2"),
    Command("figure", "Draw a figure of the paper from its equations.", "FIGURE",
        lambda: (Options.as_printed, *PICTURE), "draw:run_figure", "3a --mark quartz@100nm"),
    Command("materials", "List the known materials, find them by words, or show one in full.", "[MATERIAL]...",
        lambda: MATERIALS, "runners:run_materials", "quartz"),
    Command("quantities", "List quantities, find them by words, or show one in full.", "[NAME]...",
        lambda: TEXT_FORMATS, "runners:run_quantities", "tabor"),
    Command("guide", "List the pages of the manual, show one, or search it by words.", "[TOPIC]...",
        tuple, "runners:run_guide", "models"),
    Command("bench", "Measure speed and error of each method.", "",
        lambda: BENCH, "runners:run_bench", "--quick --csv"),
)  # fmt: skip
COMMANDS: Mapping[str, Command] = {command.name: command for command in _COMMANDS}


def commands_taking(name: str) -> list[str]:
    """Return the names of the commands that take an input."""
    names = []
    for command in _COMMANDS:
        if any(option.name == name for option in command.options()):
            names.append(command.name)
    return names


def flags_of(name: str | None) -> dict[str, Option[Any]]:
    """Return the options of a command by their spellings; without a command, those of the program."""
    return COMMANDS[name].flags() if name else _by_flag(PROGRAM)


# --- The help: of the program by task, of a command by groups of options ----------------------------------------------

TITLE = "Two elastic spheres touch and stick: forces, rolling, vibrations, limits."
EXAMPLES = (
    ("jkroll pull-off quartz 100nm", "two equal spheres"),
    ("jkroll pull-off quartz 2um --radius2 plane", "a sphere on a plane"),
    ("jkroll pull-off quartz,iron 10nm,1um", "a row for each pair"),
    ("jkroll pull-off 100nm --gamma 30mJ/m2", "your own solid"),
)
LISTS = "Each value of a list 1nm,1um or range 1nm:1um:50 (:lin: equal steps) is a row."
MAX_WIDTH = 98
MIN_WIDTH = 48
MIN_TEXT = 20
GUTTER = 10  # width of the names of groups

Row = tuple[str, str]  # what to type, and its meaning


def help_of(name: str | None) -> str:
    """Return the help of a command, or of the program."""
    width = max(MIN_WIDTH, min(MAX_WIDTH, terminal_width() - 2))
    return "\n".join(_of_command(name, width) if name else _of_program(width))


def _of_program(width: int) -> list[str]:
    """Return the lines of the help of the program: examples, then the commands by task."""
    lines = [
        *wrapped("Usage: jkroll COMMAND [MATERIAL] [RADIUS]... [OPTIONS]", width),
        *_indented(TITLE, width, 2),
        *_listed("", EXAMPLES, width),
        "",
    ]
    for task in TASKS:
        rows = [(command.name, command.sentence) for command in COMMANDS.values() if command.task == task]
        if task == OTHERS:
            rows = [(", ".join([name for name, _ in rows]), "")]
        lines += _listed(task, rows, width)
    return [*lines, *_listed("Options", [(", ".join([option.flag for option in PROGRAM]), "")], width)]


def _of_command(name: str, width: int) -> list[str]:
    """Return the lines of the help of a command: usage, meaning, groups of options, an example."""
    command = COMMANDS[name]
    groups: dict[str, list[Option[Any]]] = {}
    for option in (*command.options(), HELP):
        groups.setdefault(_group(option), []).append(option)
    lines = [*wrapped(f"Usage: jkroll {name} {command.words} [OPTIONS]".replace("  ", " "), width)]
    lines += [*_indented(command.sentence, width, 2), ""]
    for group, options in groups.items():
        lines += _listed(group, _rows(options), width)
    lines.append("")
    if name in QUESTIONS:
        lines += _indented(LISTS, width, 2)
    return [*lines, *_indented(f"Example: jkroll {name} {command.example}".rstrip(), width, 2)]


def _group(option: Option[Any]) -> str:
    """Return the group of an option in the help."""
    quantity = NOMENCLATURE.get(option.name)
    if quantity is None:
        return option.group
    if quantity.sphere or option.name in IN_GROUP_PAIR:
        return "Pair"
    return "Assumed"


def _rows(options: Sequence[Option[Any]]) -> list[Row]:
    """Return the rows of options with their meanings; options with the same meaning share a row.

    An option that another option's meaning mentions has no row. The last row lists hidden options without meanings.
    """
    rows: dict[str, list[str]] = {}
    for option in options:
        if not option.hidden:
            typed = f"{', '.join(reversed(option.flags))} {option.metavar}".rstrip()
            rows.setdefault(option.sentence(), []).append(typed)
    mentioned = {*re.findall(r"--?[a-z][a-z0-9-]*", " ".join(rows))}
    shown = []
    for text, flags in rows.items():
        unmentioned = [flag for flag in flags if flag.split()[0] not in mentioned]
        if unmentioned:
            shown.append((", ".join(unmentioned), text))
    further = [option.flag for option in options if option.hidden and option.flag not in mentioned]
    if further:
        shown.append((", ".join(further), ""))
    return shown


def _listed(title: str, rows: Sequence[Row], width: int) -> list[str]:
    """Return rows as lines with two columns after a title; a row without a meaning spans both columns."""
    left = GUTTER + max((len(typed) for typed, meaning in rows if meaning), default=0) + 2
    lines = []
    for typed, meaning in rows:
        if meaning:
            first, *rest = _indented(meaning, max(width, left + MIN_TEXT), left)
            lines += [" " * GUTTER + typed.ljust(left - GUTTER) + first[left:], *rest]
        else:
            lines += _indented(typed, width, GUTTER)
    return [title.ljust(GUTTER) + lines[0][GUTTER:], *lines[1:]]


def _indented(text: str, width: int, indent: int) -> list[str]:
    """Return the lines of a text, each with an indent."""
    return [" " * indent + line for line in wrapped(text, width - indent)]
