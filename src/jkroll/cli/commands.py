"""The commands: the words and options that each takes, and the function that runs it."""

from collections.abc import Callable, Mapping, Sequence
from functools import partial
from importlib import import_module
from types import MappingProxyType
from typing import Any, NamedTuple

from ..answers.questions import QUESTIONS
from ..errors import BadRequest
from ..quantities.nomenclature import INFINITY, NOMENCLATURE
from .options import (
    AS_PRINTED,
    AXES,
    BENCH,
    CITE,
    CITE_ANSWER,
    CSV,
    CURVE,
    EXPLAIN,
    HELP,
    JSON,
    MARKED,
    MATERIALS,
    MEASURED,
    MODEL_OF_EXPORT,
    OUTPUT,
    PANEL,
    PICTURE,
    PROGRAM,
    QUIET,
    RESULTS,
    STYLE,
    TABLE,
    Call,
    Option,
    inputs_of,
)

Action = Callable[[], int]  # what a command line asks for; it returns the exit code


class Words(NamedTuple):
    """The words that a command takes besides its options: how the help shows them, and how many there may be."""

    metavar: str = ""
    most: float = 0

    @property
    def kinds(self) -> tuple[str, ...]:
        """The kinds of words, by rising place: MATERIAL, RADIUS and so on."""
        return tuple(word.strip("[].") for word in self.metavar.split())


PHYSICS, LOOK_UP, CHECKS = "Commands", "Tables, pictures, look-up", "Checks of the paper and of this program"


class Command(NamedTuple):
    """A command. Its runner, `module:function`, answers a call and returns the exit code.

    The module is imported when the command is called, so that each call pays for its own command only.
    """

    name: str
    sentence: str
    words: Words
    options: Callable[[], tuple[Option, ...]]
    runner: str
    example: str
    section: str = PHYSICS  # of the help

    def flags(self) -> dict[str, Option]:
        """Return the options by their spellings."""
        return {flag: option for option in (*self.options(), HELP) for flag in option.flags}

    def run(self) -> Callable[[Call], int]:
        """Return the function that answers a call."""
        module, _, function = self.runner.partition(":")
        found: Callable[[Call], int] = getattr(import_module(f".{module}", __package__), function)
        return found

    def action(self, words: Sequence[str], given: Mapping[str, str | bool | tuple[str, ...]]) -> Action:
        """Return what words and the texts of options by name ask for; BadRequest for an invalid value."""
        options = {option.name: option for option in self.options()}
        if given.get("target") == "":
            raise BadRequest(f"{options['target'].flags[-1]}: the name of the output file is empty")
        values: dict[str, Any] = {
            name: options[name].read(value) if isinstance(value, str) else value for name, value in given.items()
        }
        inputs = {name: values.pop(name) for name in given if name in NOMENCLATURE}
        settings = {name: values.pop(name) for name in [*values] if name not in Call._fields}
        return partial(self.run(), Call(self.name, tuple(words), inputs, settings=settings, **values))


def _options_of_export() -> tuple[Option, ...]:
    from ..output.exports import QUANTITIES, THRESHOLDS

    return (*inputs_of(QUANTITIES + THRESHOLDS), MODEL_OF_EXPORT, MATERIALS, QUIET)


_SCENE = Words("[MATERIAL] [RADIUS]...", INFINITY)
_LOOKS = tuple(option._replace(hidden=True) for option in (*STYLE, PANEL))


def _options_of(name: str, *own: Option) -> tuple[Option, ...]:
    """Return the options of a question: inputs, its own, output."""
    inputs = _any_input() if name == "report" else inputs_of(QUESTIONS[name].quantities)
    return (*inputs, *own, *OUTPUT)


def _any_input() -> tuple[Option, ...]:
    """Return the options of commands of which any quantity may be asked: those of the report are shown."""
    return inputs_of(QUESTIONS["report"].quantities, any_input=True)


def _question(name: str, sentence: str, example: str, *own: Option, runner: str = "question:run_question") -> Command:
    return Command(name, sentence, _SCENE, partial(_options_of, name, *own), runner, example)


_COMMANDS = (
    _question("pull-off", "Force that pulls two spheres apart.", "quartz 100nm --to nN"),
    _question("yield-force", "Force that starts a sphere rolling.", "quartz 100nm --load -5nN"),
    _question("r-min", "How sharply a chain of spheres can bend without rolling.", "100nm --xi 2angstrom"),
    _question("n-grav", "How many grains a horizontal chain can carry.", "quartz 100nm --gravity 1.62m/s2"),
    _question("frequencies", "Vibration frequencies of the contact.", "quartz 100nm --radius2 plane"),
    _question("n-roll", "How far a sphere rolls over a fixed one after a collision.", "quartz 1um --speed 10cm/s"),
    _question(
        "contact",
        "Contact radius, approach, stiffness and pressure.",
        "quartz 100nm --load -5nN",
        CURVE,
        MARKED,
        *_LOOKS,
        runner="contact:run_contact",
    ),
    _question("moment", "Rolling resistance at a displacement ξ.", "quartz 100nm --xi 1angstrom"),
    _question("energies", "Energies to break, to roll and to stick, by convention.", "quartz 100nm --angle 90deg"),
    _question("resistances", "Rolling, sliding and twisting: when each yields.", "quartz 100nm --shear-strength 12MPa"),
    _question("aggregates", "When aggregates of many grains restructure and break.", "quartz 100nm --monomers 1000"),
    _question("report", "All quantities that your inputs allow.", "quartz 100nm"),
    Command(
        "export",
        "Write the contact of a pair as input of LAMMPS, LIGGGHTS or DustSimulation.",
        Words("PROGRAM [MATERIAL] [RADIUS]", INFINITY),
        _options_of_export,
        "export:run_export",
        "lammps quartz 100nm --model dmt",
    ),
    Command(
        "infer",
        "Find the input at which a quantity has its measured value.",
        Words("INPUT [MATERIAL] [RADIUS]...", INFINITY),
        lambda: (
            MEASURED,
            *_any_input(),
            *RESULTS,
            EXPLAIN,
            CITE_ANSWER,
            MATERIALS,
            QUIET,
        ),
        "infer:run_infer",
        "gamma quartz 2um --radius2 plane --measured pull_off_force=300±20nN",
    ),
    Command(
        "batch",
        "Add results to each row of a table.",
        Words("[IN]", 1),
        lambda: TABLE,
        "batch:run_batch",
        "grains.csv -o forces.csv",
        LOOK_UP,
    ),
    Command(
        "map",
        "Draw a quantity over two inputs as a map, or over one as curves.",
        Words("QUANTITY [MATERIAL] [RADIUS]...", INFINITY),
        lambda: (*AXES, *PICTURE, *_any_input()),
        "map:run_map",
        "pull-off --x radius=1nm:1mm --y gamma=1mJ/m2:10J/m2",
        LOOK_UP,
    ),
    Command(
        "figure",
        "Draw a figure of the paper from its equations.",
        Words("FIGURE", 1),
        lambda: (AS_PRINTED, *PICTURE),
        "map:run_figure",
        "3a --mark quartz@100nm",
        LOOK_UP,
    ),
    Command(
        "materials",
        "List the known materials, or show one in full.",
        Words("[MATERIAL]", 1),
        lambda: (JSON, CSV, CITE, MATERIALS, QUIET),
        "catalogue:run_materials",
        "quartz",
        LOOK_UP,
    ),
    Command(
        "quantities",
        "List the names of quantities, or show what is known of one.",
        Words("[NAME]...", INFINITY),
        lambda: (JSON, CSV),
        "catalogue:run_quantities",
        "tabor",
        LOOK_UP,
    ),
    Command(
        "guide",
        "Show a page of the manual, or list its topics.",
        Words("[TOPIC]", 1),
        tuple,
        "catalogue:run_guide",
        "models",
        LOOK_UP,
    ),
    Command(
        "verify",
        "Recompute the audit of the paper.",
        Words(),
        lambda: (JSON, CSV),
        "checks:run_verify",
        "--csv",
        CHECKS,
    ),
    Command(
        "bench",
        "Measure speed and error of each method.",
        Words(),
        lambda: BENCH,
        "checks:run_bench",
        "--quick --csv",
        CHECKS,
    ),
)
COMMANDS: Mapping[str, Command] = MappingProxyType({command.name: command for command in _COMMANDS})


def flags_of(name: str | None) -> dict[str, Option]:
    """Return the options of a command, or of the program before any command, by their spellings."""
    return COMMANDS[name].flags() if name else {flag: option for option in PROGRAM for flag in option.flags}
