"""Name what is missing for a new quantity, input or format of tables: the file, and what to write there.

    python tests/tools/missing.py contact_circumference

Tests require each of these parts, too, but fail one after the other. Exits with 1 if something is missing.
"""

import os
import re
import sys
import tempfile
import tomllib
from collections.abc import Iterator
from contextlib import chdir
from functools import cache
from inspect import unwrap
from pathlib import Path
from random import Random
from typing import Any, NamedTuple
from unittest import mock

if __package__ in (None, ""):
    sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
import law_reference
import reference
from harness import captured
from jkroll import NOMENCLATURE
from jkroll.model.containers import units_of
from jkroll.model.plan import formula_of, parameters_of
from jkroll.physics import FORMULAS
from jkroll.physics.accuracy import accuracy_of
from jkroll.quantities.laws import routes_anywhere
from jkroll.quantities.nomenclature import CONVERTED, OF_CURVES
from jkroll.quantities.synonyms import CERTAIN_SYNONYMS
from jkroll.quantities.values import QuantityError, parse_quantity
from jkroll.report.questions import QUESTIONS
from jkroll.tables.files import FORMATS
from jkroll.write.sources import docstring_fields
from scenes import any_scene, near_example
from transcripts import TERMINAL, commands, transcript, transcripts

TESTS = Path(__file__).resolve().parents[1]
PAGES = [TESTS.parent / "README.md", *sorted((TESTS.parent / "src/jkroll/guide").glob("*.md"))]
CONTRIBUTING = TESTS.parent / ".github/CONTRIBUTING.md"
NOMENCLATURE_FILE, REFERENCE = "src/jkroll/quantities/nomenclature.py", "tests/reference.py"
HELP_LINES = 31  # most lines of a command's help, not counting lines that only list further options
OPTIONS_ALONE = re.compile(r" +(--[\w-]+(, |,|$))+")
SCENES = 8  # number of random scenes


class Lack(NamedTuple):
    """Something that is missing: the file, and what to write or run."""

    file: str
    line: str


def missing(name: str) -> list[Lack]:
    """Return the missing parts of a quantity, an input or a format of tables, in the order in which to write them."""
    if name in FORMATS:
        return [*_of_format(name)]
    formula = FORMULAS.get(name)
    if name not in NOMENCLATURE and formula is None:
        return [
            Lack(NOMENCLATURE_FILE, f'"{name}": Quantity("SYMBOL", "UNIT", "SENTENCE"),'),
            Lack("src/jkroll/physics", f"def {name}(*, …: …) -> …, or for an input: option and example in its row"),
        ]
    lacks = [*_of_row(name)]
    if name in NOMENCLATURE and NOMENCLATURE[name].option:
        lacks += _of_input(name)
    if formula is not None:
        lacks += _of_formula(name)
    return lacks


def _of_row(name: str) -> Iterator[Lack]:
    """Iterate over the parts that the row of the nomenclature lacks."""
    unit = _units(name)["return"] if name in FORMULAS else ""
    if name not in NOMENCLATURE:
        if not _is_of_derivation(name):
            yield Lack(NOMENCLATURE_FILE, f'"{name}": Quantity("SYMBOL", "{unit}", "SENTENCE"),')
        return
    quantity = NOMENCLATURE[name]
    if unit and quantity.unit != unit:
        yield Lack(NOMENCLATURE_FILE, f'the unit "{unit}" of {name}, which its formula has')
    if not quantity.symbol and not quantity.is_word:
        yield Lack(NOMENCLATURE_FILE, f"a symbol of {name}")
    has_values = (
        quantity.is_word or quantity.example or quantity.option or formula_of(name) or routes_anywhere().get(name)
    )
    if not has_values and name not in OF_CURVES and not _is_made_by_a_law(name):
        yield Lack("src/jkroll/physics", f"def {name}(*, …: …) -> …, or option and example in {NOMENCLATURE_FILE}")


def _is_of_derivation(name: str) -> bool:
    """Return whether the page on Python lists a formula as a step of a derivation, which needs no row."""
    return f"`{name}`" in (TESTS.parent / "src/jkroll/guide/python.md").read_text(encoding="utf-8")


def _is_made_by_a_law(name: str) -> bool:
    """Return whether a quantity has a variant, by which a law computes it."""
    return any(quantity.variant_of == name for quantity in NOMENCLATURE.values())


def _units(name: str) -> dict[str, str]:
    """Return the units of a formula's parameters, and of its value under `return`."""
    return dict(units_of(unwrap(FORMULAS[name])))


# --- An input ---------------------------------------------------------------------------------------------------------


def _of_input(name: str) -> Iterator[Lack]:
    """Iterate over the parts that an input with an option lacks."""
    quantity = NOMENCLATURE[name]
    if not quantity.example:
        yield Lack(NOMENCLATURE_FILE, f'example="…", in the row of {name}')
        return
    if not quantity.is_word:
        try:
            parse_quantity(quantity.example, name)
        except QuantityError as error:
            yield Lack(NOMENCLATURE_FILE, f"another example: {error}")
    shown = f"{quantity.option} {quantity.example}"
    too_long = [command for command in QUESTIONS if shown in help_of(command) and is_too_long(help_of(command))]
    if too_long:
        yield Lack("src/jkroll/cli/commands.py", f'WITHOUT_TEXT: "{name}", as the help of {too_long[0]} is too long')
    word = _word_of(name)
    for other, words in CERTAIN_SYNONYMS.items():
        if other != name and word in words:
            yield Lack("src/jkroll/quantities/synonyms.py", f"{other} without {word}, which is an option now")
    for repository in records_without(name):
        yield Lack("tests/tables/found_tables.toml", f"{name} in `reads` of [[{repository}]]")


def _word_of(name: str) -> str:
    """Return the word of an input's option, as a name."""
    return NOMENCLATURE[name].option.removeprefix("--").replace("-", "_")


@cache
def help_of(command: str) -> str:
    """Return the help of a command."""
    with mock.patch.dict(os.environ, TERMINAL):
        return captured([command, "--help"]).out


def is_too_long(text: str) -> bool:
    """Return whether a help has too many lines, not counting those that only list further options."""
    return len([line for line in text.splitlines() if not OPTIONS_ALONE.fullmatch(line)]) > HELP_LINES


def records_without(name: str) -> list[str]:
    """Return the repositories whose found tables have a column of an input, while their record does not name the input.

    Inputs that are converted to another input, such as a shear modulus, are left out: their column passes through in a
    table with this other input. Tables that are refused in any case (`ends`) are left out, too.
    """
    if name in CONVERTED:
        return []
    found, own = [], {name, _word_of(name)}
    for repository, record in found_tables():
        headers = re.split(r"[,;\t|]", record["table"].lstrip("\n").splitlines()[0])
        words = {re.sub(r"[(\[].*", "", header).strip(' "#').casefold().replace(" ", "_") for header in headers}
        said = str({key: value for key, value in record.items() if key != "table"})
        if words & own and name not in said and "ends" not in record:
            found.append(repository)
    return found


@cache
def found_tables() -> list[tuple[str, dict[str, Any]]]:
    """Return the tables of tests/tables/found_tables.toml, each with its repository."""
    every = tomllib.loads((TESTS / "tables/found_tables.toml").read_text(encoding="utf-8"))
    return [(repository, record) for repository, records in every.items() for record in records]


# --- A formula --------------------------------------------------------------------------------------------------------


def _of_formula(name: str) -> Iterator[Lack]:
    """Iterate over the parts that a formula and its result lack."""
    formula = FORMULAS[name]
    file = f"src/{formula.__module__.replace('.', '/')}.py"
    if not _is_documented(formula):
        yield Lack(file, f'"""Return the …""" of {name}, and its equation, indented, in the second paragraph')
    for parameter, unit in _units(name).items():
        if parameter not in NOMENCLATURE and parameter not in FORMULAS and parameter != "return":
            if not _is_of_derivation(name):
                yield Lack(NOMENCLATURE_FILE, f'"{parameter}": Quantity("SYMBOL", "{unit}", "SENTENCE", option=…),')
        elif parameter in NOMENCLATURE and NOMENCLATURE[parameter].unit != unit:
            yield Lack(file, f'the unit "{NOMENCLATURE[parameter].unit}" of the parameter {parameter} of {name}')
    if name not in reference.EQUATIONS:
        symbols = {quantity: symbol for symbol, quantity in reference.SYMBOLS.items()}
        letters = ", ".join(symbols.get(parameter, parameter) for parameter in parameters_of(formula))
        yield Lack(_reference_of(formula.__module__), f'EQUATIONS: "{name}": lambda {letters}: …,')
    else:
        yield from _of_values(name)
    pages = [page.relative_to(TESTS.parent) for page in pages_to_renew(name)]
    yield from (Lack(str(page), f"run python tests/transcripts.py {page}") for page in pages)
    if pages and any(_blocks(CONTRIBUTING, _questions_with(name))):
        yield Lack(".github/CONTRIBUTING.md", "run python tests/test_contributing.py")


def _is_documented(formula: Any) -> bool:
    """Return whether a docstring has a sentence and, indented, an equation."""
    try:
        fields = docstring_fields(formula)
    except StopIteration:  # nothing is indented
        return False
    return bool(fields["summary"] and fields["formula"])


def _reference_of(module: str) -> str:
    """Return the file with the reference equations for the formulas of a module."""
    laws = {FORMULAS[each].__module__ for each in law_reference.EQUATIONS if each in FORMULAS}
    return "tests/law_reference.py" if module in laws else REFERENCE


def _of_values(name: str) -> Iterator[Lack]:
    """Iterate over at most one part: an accuracy, if the errors in random scenes are larger than the stated one.

    Formulas in law_reference.py are left out: test_accuracy.py draws more inputs for them than the scenes here have.
    """
    if name in law_reference.EQUATIONS:
        return
    errors = [error for error in (_error_in(name, values) for values in _drawn_scenes()) if error is not None]
    if errors and max(errors) > float(accuracy_of(name).partition(" ulp")[0]):
        yield Lack(
            "src/jkroll/physics/accuracy.py", f'_OTHERS: "N ulp": "{name}", where N is {max(errors):.1f} or more'
        )


@cache
def _drawn_scenes() -> list[reference.Values]:
    """Return the values of random scenes."""
    random = Random(2026)
    return [reference.values_in(any_scene(random)) for _ in range(SCENES)]


def _error_in(name: str, values: reference.Values) -> float | None:
    """Return the error of a formula in a scene, in ulp; None if a parameter or the formula has no value there."""
    random, arguments = Random(2026), {}
    for parameter in parameters_of(FORMULAS[name]):
        value = values.get_exact(parameter)
        if value is not None:
            arguments[parameter] = float(value)
        elif parameter in NOMENCLATURE and NOMENCLATURE[parameter].example:
            arguments[parameter] = near_example(parameter, random)
        else:
            return None
    try:
        return reference.formula_error(name, arguments, float(FORMULAS[name](**arguments)))
    except (ValueError, ZeroDivisionError, OverflowError, TypeError):
        return None  # the formula has no value there


def pages_to_renew(name: str) -> list[Path]:
    """Return the pages with outdated transcripts of the questions that show a quantity."""
    questions = _questions_with(name)
    with tempfile.TemporaryDirectory() as folder, chdir(folder), mock.patch.dict(os.environ, TERMINAL):
        return [page for page in PAGES if any(map(_is_old, _blocks(page, questions)))]


def _questions_with(name: str) -> list[str]:
    return [command for command, question in QUESTIONS.items() if name in question.quantities]


def _blocks(page: Path, questions: list[str]) -> Iterator[str]:
    """Iterate over the transcripts of a page that show all rows of one of the questions, each with one command."""
    for block in transcripts(page.read_text(encoding="utf-8")):
        for part in block.split("$ ")[1:]:
            words = part.splitlines()[0].split()
            if words[1:2] and words[1] in questions and not {"--quantities", "--bare", "--explain"} & {*words}:
                yield f"$ {part}"


def _is_old(block: str) -> bool:
    return any(transcript(command) != block for command in commands(block))


# --- A format of tables -----------------------------------------------------------------------------------------------


def _of_format(name: str) -> Iterator[Lack]:
    """Iterate over the parts that a format of tables lacks. `name`: the suffix of its files."""
    form = FORMATS[name]
    if form not in help_of("batch"):
        yield Lack("src/jkroll/cli/options.py", f"{form} in the help of --format")
    if f".{form}" not in (TESTS / "corpus/command_lines.txt").read_text(encoding="utf-8"):
        yield Lack("tests/corpus/command_lines.txt", f"0 jkroll batch grains.csv -o out.{form}")
    if form not in (TESTS.parent / "src/jkroll/guide/tables.md").read_text(encoding="utf-8").casefold():
        yield Lack("src/jkroll/guide/tables.md", f"where {form} is read and written")


def main() -> int:
    """Print what is missing for the names on the command line; return 1 if anything is."""
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    lacks = [lack for name in sys.argv[1:] for lack in missing(name)]
    for file, line in lacks:
        print(f"{file}: {line}")
    return 1 if lacks else 0


if __name__ == "__main__":
    sys.exit(main())
