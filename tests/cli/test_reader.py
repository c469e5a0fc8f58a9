"""The grammar of command lines: lines with the same meaning, refused lines, and the registry of commands."""

import json
from functools import partial
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from harness import Run
from jkroll.cli.call import Call
from jkroll.cli.commands import COMMANDS, OUTPUT, flags_of
from jkroll.cli.options import ALL_OPTIONS, Option
from jkroll.cli.process import HINTS, SYNONYMS, action_of
from jkroll.errors import BadRequest, JkrollError
from jkroll.quantities.nomenclature import NOMENCLATURE
from jkroll.report.questions import QUESTIONS

# Lines with the same meaning.
ALIKE = [
    ["pull-off quartz 100nm --to nN", "pull-off --to=nN quartz 100nm", "pull-off quartz --to nN -- 100nm"],
    ["pull-off quartz 100nm --units nN", "pull-off quartz 100nm --unit=nN", "pull-off quartz 100nm --to nN"],
    ["pull-off quartz 100nm -o x.csv", "pull-off quartz 100nm -ox.csv", "pull-off quartz 100nm -o=x.csv"],
    ["pull-off quartz 100nm -o x.csv", "pull-off quartz 100nm --output x.csv", "pull-off quartz 100nm --out=x.csv"],
    ["batch in.csv -o x.csv", "batch -ox.csv in.csv", "batch --output=x.csv -- in.csv"],
    ["batch -1.csv -o -2.csv", "batch -o-2.csv -- -1.csv", "batch -1.csv --output=-2.csv"],
    ["pull-off quartz 100nm --json", "pull-off quartz 100nm --format json",
    "pull-off quartz 100nm --format=json --json"],
    ["pull-off quartz 100nm", "pull-off --R1 100nm quartz", "pull-off --radius=100nm --material quartz",
    "pull-off R1=100nm quartz"],
    ["contact quartz 1um --radius2 2um", "contact quartz 1um --R2 2um", "contact quartz R1=1um R2=2um"],
    ["infer gamma 2um --measured pull_off_force=1uN", "infer --R1 2um gamma --measured pull_off_force=1uN"],
    ["pull-off 1um --gamma 25mJ/m2", "pull-off 1um --surface-energy 25mJ/m2", "pull-off 1um --GAMMA=25mJ/m2",
    "pull-off gamma=25mJ/m2 1um"],
    ["contact 1um --young 1GPa --poisson 0.3", "contact 1um --E 1GPa --nu 0.3", "contact 1um E=1GPa nu=0.3"],
    ["version", "--version"],
    ["help", "--help", "-h", ""],
    ["help pull-off", "--help pull-off", "pull-off --help", "pull-off -h", "pull-off quartz --to -h",
    "pull-off --laod 3 -h"],
    ["units", "guide units"],
]  # fmt: skip
# Lines without a meaning, and their messages.
REFUSED = {
    "pull-off quartz 1um -o": "-o needs a value, as in -o OUT",
    "pull-off quartz 1um -o --quiet": "-o needs a value, as in -o OUT",
    "pull-off quartz 1um --to --json": "--to needs a value, as in --to UNIT",
    "contact quartz 1um --load -inf": "--load needs a value, as in --load -5nN",
    "pull-off quartz 1um --to -- nN": "--to needs a value, as in --to UNIT",
    "pull-off quartz 1um --bare=x": "--bare takes no value: leave '=x' out",
    "pull-off quartz 1um --quiet=": "--quiet takes no value: leave '=' out",
    "pull-off quartz 1um --help=x": "--help takes no value: leave '=x' out",
    "pull-off 1um --gamma 1J/m2 --surface-energy 2J/m2": "--gamma is given more than once",
    "batch in.csv -o x.csv --output y.csv": "--output is given more than once",
    "materials quartz iron": "no material 'quartz iron'; did you mean quartz? jkroll materials lists all",
    "batch a.csv b.csv": "'b.csv' is one word too many: jkroll batch IN",
    "pull-off quartz 1um --=x": "no such option '--'; see jkroll pull-off --help",
    "pull-off quartz 1um -output x.csv": "no such option '-output'; did you mean -o?",
    "pull-off quartz 1um --velocity 1m/s": (
        "no such option '--velocity'; --speed is an option of n-roll, impact, report and 3 more"
    ),
    "pull-off quartz --diam 1um": "no such option '--diam'; did you mean --diameter?",
    "pull-off quartz 1um --format xml": (
        "pull-off takes no '--format'; write --json, --csv, --md or --bare, or name a file: -o x.tsv"
    ),
    "pull-off quartz 1um –to nN": "'–to' begins with a dash; options begin with hyphens: --to",
    "verify": "no such command 'verify'; jkroll guide paper has the audit of the paper",
    "plot quartz": f"no such command 'plot'; {HINTS['plot']}",
    "--install-completion bash": "--install-completion takes nothing else: jkroll --install-completion",
    "--version=x": "--version takes no value: leave '=x' out",
    "--": "no such command '--'; see jkroll --help, or write, for example, jkroll pull-off quartz 100nm",
    "-": "no such command '-'; see jkroll --help, or write, for example, jkroll pull-off quartz 100nm",
}


def meaning(words: list[str]) -> Any:
    """Return the meaning of words in a form that can be compared: a function with its arguments, or an error."""
    try:
        action = action_of(words)
    except JkrollError as error:
        return type(error), str(error)
    if not isinstance(action, partial):
        return action
    return action.func, tuple(SimpleNamespace(**vars(word)) if isinstance(word, Call) else word for word in action.args)


@pytest.mark.parametrize("lines", ALIKE, ids=lambda lines: lines[0])
def test_lines_of_a_group_have_the_same_meaning(lines: list[str]) -> None:
    first, *others = [meaning(line.split()) for line in lines]
    assert not isinstance(first, tuple) or not isinstance(first[0], type)
    assert others == [first] * len(others)


@pytest.mark.parametrize("line", REFUSED)
def test_a_line_without_a_meaning_is_refused(run: Run, line: str) -> None:
    assert run(line) == (2, "", f"jkroll: {REFUSED[line]}\n")
    assert [*Path().iterdir()] == []


@pytest.mark.parametrize(
    "line",
    ["pull-off quartz 100 nm", "pull-off 100 nm quartz --gamma 0.025 J/m2", "contact quartz 1um --load -5 nN"],
)
def test_a_unit_may_be_a_word_of_its_own(line: str) -> None:
    words = line.replace(" nm", "nm").replace(" J", "J").replace(" nN", "nN").split()
    function, (call,) = meaning(line.split())
    function2, (joined,) = meaning(words)
    assert function == function2
    assert [word.replace(" ", "") for word in call.words] == [*joined.words]
    assert {name: text.replace(" ", "") for name, text in call.inputs.items()} == joined.inputs


@pytest.mark.parametrize(
    "line",
    [
        "contact quartz 1um --poisson 0.3 iron",
        "report --digits 3 quartz 1um",
        "pull-off 1um --young 5 plane",
        "batch --jobs 2 in.csv",
    ],
)
def test_the_word_after_a_number_that_needs_no_unit_is_not_its_unit(line: str) -> None:
    _, (call,) = meaning(line.split())
    assert all(" " not in text for text in (*call.words, *call.inputs.values()))


def options_with_values() -> list[tuple[str, Option[Any]]]:
    """Return all options that take a text, each with the name of its command."""
    return [
        (name, option) for name in COMMANDS for option in COMMANDS[name].options() if option.metavar and not option.most
    ]


@given(st.sampled_from(options_with_values()), st.text(max_size=8))
def test_a_value_may_be_joined_to_its_option_or_be_the_next_word(taken: tuple[str, Option[Any]], text: str) -> None:
    command, option = taken
    joined = meaning([command, f"{option.flag}={text}"])
    if not text.startswith("-"):
        assert meaning([command, option.flag, text]) == joined
    if option.short:
        assert text == "" or meaning([command, f"{option.short}={text}"]) == joined


@given(st.lists(st.text(max_size=8) | st.sampled_from([*SYNONYMS, *flags_of("report"), *flags_of("batch"), *COMMANDS])))
def test_any_words_are_read_or_refused_in_one_line(words: list[str]) -> None:
    try:
        action_of(words)
    except JkrollError as error:
        assert str(error).isprintable()


# --- The registry -----------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("typed", SYNONYMS)
def test_a_synonym_stands_for_a_command_or_an_option(typed: str) -> None:
    known = {*COMMANDS, *flags_of(None), *(flag for command in COMMANDS.values() for flag in command.flags())}
    assert SYNONYMS[typed].split()[0] in known


@pytest.mark.parametrize("name", COMMANDS)
def test_every_option_is_a_quantity_or_one_of_the_listed_options(name: str) -> None:
    for option in COMMANDS[name].options():
        assert option.name in {*NOMENCLATURE, *(known.name for known in ALL_OPTIONS)}, option.flag


def test_the_command_of_every_question_takes_all_options_for_output() -> None:
    for name in QUESTIONS:
        assert {*OUTPUT} <= {*COMMANDS[name].options()}


# --- Values and words -------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("flag", ["--load -3nN", "--load=-3nN"])
def test_a_negative_value_after_an_option_is_read_as_its_value(run: Run, flag: str) -> None:
    assert json.loads(run(f"contact quartz 100nm {flag} --json").out)["inputs"]["load"] == -3e-9


@pytest.mark.parametrize(
    ("word", "problem"), [("a\0.csv", "contains a NUL character"), ("a\ud83d.csv", "contains half a character")]
)
def test_a_word_with_a_nul_or_half_a_character_is_refused(run: Run, word: str, problem: str) -> None:
    ran = run("pull-off", "quartz", "1um", "-o", word)
    assert (ran.code, ran.out) == (2, "")
    assert ran.err.startswith(f"jkroll: 'a?.csv' {problem}")


def test_a_law_is_known_in_any_case(run: Run) -> None:
    lower = run("pull-off quartz 100nm --model dmt,jkr --csv").out
    assert run("pull-off quartz 100nm --model DMT,Jkr --csv").out == lower


@pytest.mark.parametrize(("word", "name"), [("friction", "yield_force"), ("torque", "yield_moment")])
def test_a_quantity_is_found_by_a_common_word_for_it(run: Run, word: str, name: str) -> None:
    listed = run(f"quantities {word} --json").out
    assert listed.index(f'"{name}"') == listed.index('"name": ') + 8


# --- Options that change nothing --------------------------------------------------------------------------------------


_IDLE = ("--density", "3g/cm3", "--density2", "2g/cm3", "--load", "1nN")


@pytest.mark.parametrize(
    ("line", "idle"),
    [
        ("pull-off quartz 100nm --density 3g/cm3", "--density changes no result here"),
        ("r-min 100nm --density 3g/cm3 --z0 3angstrom", "--density changes no result here"),
        ("contact quartz 100nm --xi 1nm --density 3g/cm3", "--density and --xi change no result here"),
        ("frequencies quartz 100nm --radius2 plane --density2 2g/cm3", "--density2 changes no result here"),
        ("infer gamma quartz 2um --density 3g/cm3 --measured pull_off_force=300nN", "--density changes no result here"),
        ("infer gamma 1um --young 3GPa --poisson 0.3 --load 1nN --measured P_c=300nN", "--load changes no result here"),
        ("map pull-off quartz --x radius=1nm:1um:3 --density 3g/cm3 --data -", "--density changes no result here"),
    ],
)
def test_an_option_that_changes_nothing_is_named(run: Run, line: str, idle: str) -> None:
    ran = run(line)
    assert ran.code == 0
    assert idle in ran.err
    numbers = run(*(word for word in line.split() if word not in _IDLE))
    assert numbers.out == ran.out
    assert "--density" not in numbers.err


@pytest.mark.parametrize(
    "line",
    [
        (
            "report quartz 100nm --density 3g/cm3 --young 3GPa --poisson 0.3 --gamma 1J/m2 --load 1nN --xi 1nm --z0 "
            "3angstrom"
        ),
        "pull-off gold 100nm --young 3GPa --z0 3angstrom",
        "n-roll quartz 100nm --speed 1m/s --density 3g/cm3",
        "n-roll gold 100nm --young 3GPa --energy 1eV",
        "contact quartz 100nm --approach 0.05nm --radius2 plane --model maugis",
    ],
)
def test_an_input_of_a_result_or_a_limit_is_not_said_to_change_nothing(run: Run, line: str) -> None:
    assert "no result here" not in run(line).err


@pytest.mark.parametrize(("line", "message"), [
    ("pull-off 1um --best --bare", "--bare and --best exclude each other"),
    ("pull-off 1um --explain --best", "--best and --explain exclude each other"),
    ("contact 1um --curve --cite", "--curve and --cite exclude each other"),
    ("pull-off 1um --csv --json", "--json and --csv exclude each other"),
    ("pull-off 1um --tex", "--tex goes with --cite"),
    ("batch x.csv --delimiter bar --format csv", "--format and --delimiter exclude each other"),
    ("batch x.csv --infer gamma --quantities n_grav", "--infer and --quantities exclude each other"),
])  # fmt: skip
def test_options_that_do_not_go_together_are_refused(line: str, message: str) -> None:
    with pytest.raises(BadRequest, match=f"^{message}$"):
        action_of(line.split())
