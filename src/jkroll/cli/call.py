"""A call of a command: its words and options, and the frames and the output format that follow from them."""

import os
import shlex
import sys
from collections.abc import Collection, Mapping, Sequence
from functools import cached_property
from itertools import product
from typing import TYPE_CHECKING, Any, NamedTuple

from ..errors import BadRequest, JkrollError
from ..materials.library import Material, Materials, UnknownMaterial, materials_of_user
from ..model.accepted import check_range
from ..model.frame import check_exclusive
from ..model.reasons import MissingInput
from ..model.sweep import Pair, Sweep
from ..quantities.formatting import Format, ShownUnit, amount, as_typed
from ..quantities.laws import law_given
from ..quantities.nomenclature import CONVERTED, NOMENCLATURE
from ..quantities.spreads import Spread, spreads_of
from ..quantities.units import BadUnit, dimension_of, parse_unit
from ..quantities.values import QuantityError
from ..report.questions import QUESTIONS, quantity_named
from ..text import ending, quoted, say_wrapped, shown
from .options import Options

if TYPE_CHECKING:
    from ..report.curve import Loads
    from .commands import Command


class Output(NamedTuple):
    """A form of output."""

    name: str
    has_rows: bool = False  # can hold columns with a row for each frame
    has_answers: bool = False  # can hold single answers with their notes
    keeps_all: bool = False  # includes meaningless numbers, since an empty cell could not show its reason
    for_readers: bool = False  # shows inputs as typed, and lines around a table


TABLE = Output("table", has_rows=True, has_answers=True, for_readers=True)
PLAIN = Output("plain", has_rows=True, has_answers=True, keeps_all=True)
FILE = Output("file", has_rows=True)
CHOSEN = (  # the forms chosen by options of the same names
    BARE := Output("bare", has_rows=True, keeps_all=True),
    JSON := Output("json", has_answers=True),
    CSV := Output("csv", has_rows=True),
    MARKDOWN := Output("md", has_rows=True, has_answers=True, for_readers=True),
    EXPLAIN := Output("explain", has_answers=True),
    CITE := Output("cite", has_answers=True),
)


class Call(Options):
    """One call of a command."""

    def __init__(self, command: "Command", words: Sequence[str] = (), options: Mapping[str, Any] | None = None) -> None:
        """`options`: values by the names of options; options of inputs have the names of the nomenclature."""
        self.command = command.name
        self.subject, self.words = "", tuple(words)
        if command.has_subject and words:
            self.subject = words[0]  # the program, input, quantity, table or figure
            self.words = tuple(words[1:])
        self.inputs: dict[str, str] = {}
        others = {}
        for name, value in (options or {}).items():
            if name in NOMENCLATURE:
                self.inputs[name] = value
            else:
                others[name] = value
        super().__init__(others)

    @property
    def line(self) -> str:
        """The command line as written on pictures, without output files and `--quiet`."""
        return self.line_with()

    def line_with(self, **inputs: str | None) -> str:
        """Return the command line as `line`, with these inputs in place of those given; None leaves an input out."""
        from .commands import COMMANDS

        flags = {option.name: flag for flag, option in COMMANDS[self.command].flags().items()}
        words = ["jkroll", self.command, *filter(None, (self.subject,)), *self.words]
        for name, value in {**self.inputs, **self.given, **inputs}.items():
            if name not in flags or name in ("target", "data", "quiet") or value is None:
                continue
            texts = value if isinstance(value, tuple) else [value]
            words += [flags[name] if text is True else f"{flags[name]}={text}" for text in texts]
        return shlex.join(words)

    # --- Frames -------------------------------------------------------------------------------------------------------

    @cached_property
    def materials(self) -> Materials:
        """The known materials; a note on stderr names each material that a user's file replaces."""
        known = materials_of_user(self.file)
        for text in known.overrides:
            say_wrapped(f"note: {text}", sys.stderr)
        return known

    @cached_property
    def models(self) -> Sequence[str | None]:
        """The names of the given laws, adapted to the profile; a single None for the default."""
        text, profile = self.inputs.get("model"), self.inputs.get("profile")
        if text is None:
            return [law_given(None, profile)]
        names = [law_given(word, profile) for word in text.split(",")]
        if len(set(names)) < len(names):
            raise BadRequest(f"--model: {quoted(text)} names a law more than once")
        return names

    @cached_property
    def values(self) -> dict[str, str]:
        """The texts of numeric inputs by name, including the radii among the words."""
        texts = {name: text for name, text in self.inputs.items() if name not in ("material2", "model", "profile")}
        radii = [word for word in self.words if not _is_material(word)]
        for word in radii:
            if not word[:1].isdigit():
                self._refuse_file(word)
        if radii:
            texts["radius"] = ",".join(radii)
        check_exclusive(texts, _option_or_radius)
        return texts

    @cached_property
    def spreads(self) -> dict[str, list[Spread]]:
        """The values of each input, in the order of the nomenclature, without the loads of a force curve.

        Raises QuantityError for a value outside the range of the input.
        """
        every = {}
        for name, text in self.values.items():
            if not (self.curve and name == "load"):
                every[name] = spreads_of(text, name)
        for name, spreads in every.items():
            for spread in spreads:
                check_range(name, spread.low)
                check_range(name, spread.high)
        return {name: every[name] for name in NOMENCLATURE if name in every}

    @property
    def typed(self) -> dict[str, str]:
        """The given inputs and measured quantities, as typed.

        The text is empty for several values, and for an input that was converted from another.
        """
        texts = {**self.values}
        for text in self.measured:
            word, _, value = text.partition("=")
            texts[quantity_named(word)] = value
        typed = {}
        for name, text in texts.items():
            typed[name] = "" if "," in text or ":" in text else as_typed(text)
        for name in self.values.keys() & CONVERTED.keys():
            typed[CONVERTED[name]] = ""
        return typed

    @cached_property
    def loads(self) -> "Loads | None":
        """The ends of the loads of a force curve; None if they were not given."""
        from ..report.curve import loads_of

        if "approach_at_load" in self.values:
            raise BadRequest("--curve goes through all approaches; leave --approach out")
        text = self.values.get("load")
        if text is not None and (text.startswith(":") or text.endswith(":")):
            lacking = "lower" if text.startswith(":") else "upper"
            pull_off = amount("load", -self.sweep.groups[0]["pull_off_force"])
            remedy = f"write both, as in -5nN:20nN (an example); pull-off is at {pull_off}"
            raise QuantityError("load", text, f"has no {lacking} end", remedy)
        return None if text is None else loads_of(text)

    @cached_property
    def pairs(self) -> list[Pair]:
        """The materials of the two spheres, in all combinations. A given file of materials is always checked."""
        if self.file is not None:
            _ = self.materials
        for word in map(str.casefold, (*self.words, self.inputs.get("material2", ""))):
            option = {"plane": "--radius2", "rigid": "--young2"}.get(word)
            if option:
                raise BadRequest(f"{word} is for sphere 2: write {option} {word}")
        named = [word for word in self.words if _is_material(word)]
        if len(named) > 1:
            both = f"two materials, {quoted(named[0])} and {quoted(named[1])}"
            raise BadRequest(f"{both}; for a list write quartz,iron; for sphere 2, --material2 iron")
        return [*product(self._named(named[0] if named else None), self._named(self.inputs.get("material2")))]

    @cached_property
    def sweep(self) -> Sweep:
        """The rows: a frame for each combination of materials, values and laws."""
        return Sweep(self.pairs, self.spreads, self.models)

    def _named(self, text: str | None) -> list[Material | None]:
        """Return the materials in a list, or a single None for no list; "all" leaves out materials with a mistake."""
        if text is None:
            return [None]
        if text.casefold() == "all":
            for mistake in self.materials.mistakes:
                say_wrapped(f"note: left out: {mistake}", sys.stderr)
            return [*self.materials.materials.values()]
        return [*map(self._material, text.split(","))]

    def _material(self, word: str) -> Material:
        """Return a material by name; raise BadRequest if there is a file of this name instead."""
        try:
            return self.materials[word]
        except UnknownMaterial:
            self._refuse_file(word)
            raise

    def _refuse_file(self, word: str) -> None:
        """Raise BadRequest if a word is the name of a file; the message names the command that reads tables."""
        if os.path.isfile(word):
            options = " --infer INPUT --measured QUANTITY" if self.command == "infer" else ""
            raise BadRequest(f"{quoted(word)} is a file; jkroll batch {shown(word)}{options} reads tables")

    # --- Format of the output -----------------------------------------------------------------------------------------

    @cached_property
    def output(self) -> Output:
        """The form of the output file; without a file, the form that an option chooses.

        By default the form is a table on a terminal, and unformatted lines in a pipe.
        """
        chosen = next((output for output in CHOSEN if output.name in self.given), None)
        if self.target is None:
            return chosen or (TABLE if sys.stdout.isatty() else PLAIN)
        of_file = {"json": JSON, "md": MARKDOWN}.get(ending(self.target), FILE)
        is_csv = chosen is CSV and of_file is FILE and _is_written_as_csv(self.target)
        if chosen not in (None, of_file) and not is_csv:
            remedy = "redirect the output: > FILE"
            raise BadRequest(f"-o {quoted(self.target)} and --{chosen.name} exclude each other; {remedy}")
        return of_file

    @property
    def names_picture(self) -> bool:
        """True if the output file has the name of a picture."""
        return self.target is not None and ending(self.target) in PICTURES

    def form(self, quantities: Sequence[str]) -> Format:
        """Return the format of results; tables for readers show inputs as typed."""
        units = {} if self.to is None else _units_of(quantities, self.to)
        return Format(units, self.digits, self.typed if self.output.for_readers else {})


PICTURES = ("svg", "pdf", "png")


def _is_written_as_csv(path: str) -> bool:
    """Return whether a file of this name is written as CSV, as are files without a known extension."""
    from ..tables.files import format_of_name

    named = format_of_name(path)
    return named is None or named.name == "csv"


def _units_of(quantities: Sequence[str], text: str) -> dict[str, ShownUnit]:
    """Return the units for quantities, from a list with at most one unit for each dimension."""
    units: dict[str, ShownUnit] = {}
    si = {name: NOMENCLATURE[name].unit for name in quantities}
    for word in text.split(","):
        try:
            unit = parse_unit(word)
        except BadUnit as error:
            remedy = error.remedy([*map(dimension_of, si.values())])
            remedy = remedy or f"expected a unit such as {si[quantities[0]]}"
            raise QuantityError("--to", word, str(error), remedy) from None
        _, _, dimension = unit
        fitting = [name for name in si if dimension_of(si[name]) == dimension]
        if not (fitting and word.strip()):
            si_units = ", ".join(dict.fromkeys(si.values()))
            raise BadRequest(f"--to: {quoted(word)} fits none of the results, which are in: {si_units}")
        if fitting[0] in units:
            both = f"{quoted(units[fitting[0]].text)} and {quoted(word)}"
            raise BadRequest(f"--to: {both} are units of one dimension; give one of them")
        units |= dict.fromkeys(fitting, ShownUnit(" ".join(word.split()), unit))
    return units


def message_of(error: JkrollError, command: str, options: Collection[str]) -> str:
    """Return the message of an error. It names the command that lacks an input, or the option with a bad value."""
    if type(error) is MissingInput and command in QUESTIONS:
        return f"{command} {error.explanation()}"
    name, _, problem = str(error).partition(": ")
    if name in NOMENCLATURE:
        option = NOMENCLATURE[name].option
        if option and option in options:
            return f"{option}: {problem}"
    return str(error)


def _option_or_radius(name: str) -> str:
    """Return how an input is typed: as an option, or as a radius among the words."""
    return NOMENCLATURE[name].option or "a radius"


def _is_material(word: str) -> bool:
    """Return whether a word names a material, rather than a radius."""
    return word.casefold() == "all" or (word[:1].isalpha() and word.casefold() not in ("plane", "nan", "inf"))
