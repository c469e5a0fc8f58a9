"""Two readers of one command line, made from one declaration: where the quick one answers, typer says the same."""

import io
import json
import random
from collections.abc import Callable
from contextlib import redirect_stdout
from functools import partial
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from harness import Run
from jkroll.answers.questions import QUESTIONS
from jkroll.cli.commands import COMMANDS, Action
from jkroll.cli.options import OUTPUT, Call
from jkroll.cli.reader import plain_action
from jkroll.cli.typer_app import typer_action
from jkroll.errors import JkrollError
from jkroll.quantities.nomenclature import NOMENCLATURE

PLAIN = [
    "pull-off quartz 100nm",
    "pull-off quartz 100nm --bare",
    "yield-force quartz,iron 1nm:1um:5 --load -5nN --csv --quiet",
    "frequencies --radius2 plane quartz 100nm --material2=iron --digits 3",
    "n-roll --energy-ratio 2 quartz 1um --to= --json",
    "contact quartz 100nm --curve --csv",
    "contact quartz 100nm --load=-3nN",
    "contact quartz 100nm --load -.3nN --quiet --quiet",
    "moment quartz 100nm --xi 1angstrom",
    "materials",
    "materials quartz --json",
    "batch - -o -1out.csv",
    "verify --csv",
    "bench --quick --json",
    "--help",
    "-h",
    "--version",
    "pull-off --help",
    "pull-off quartz -h --bare",
    "materials --help iron",
]
NOT_PLAIN = [
    "--help pull-off",
    "--laod",
    "pull-off --to --laod 5nN",
    "pull-off quartz 100nm --bare=x",
    "pull-off quartz 100nm --laod=5nN",
    "pull-off -- --laod",
    "pull-off --=x",
    "pull-off -laod 5nN",
    "pull-off quartz -5nm",
    "contact quartz 100nm --load 1nN --load 2nN",
    "pull-off quartz 100nm --to",
    "pull-off quartz 100nm --to --json",
    "pull-off quartz 100nm --json=yes",
    "pull-off -- quartz 100nm",
    "materials quartz iron",
    "pul-off quartz 100nm",
]


def answer_of(read: Callable[[list[str]], Action | None], words: list[str]) -> object:
    """Return what words are read as, in a form that can be compared: a call, a printed text, or an error."""
    out = io.StringIO()
    try:
        with redirect_stdout(out):
            action = read(words)
            if isinstance(action, partial) and any(isinstance(part, Call) for part in action.args):
                return action.func, action.args
            return None if action is None else (action(), out.getvalue())
    except JkrollError as error:
        return type(error), str(error)


def agree(words: list[str]) -> bool:
    """Return whether both readers understand the words alike, or only typer does."""
    plain = answer_of(plain_action, words)
    return plain is None or plain == answer_of(typer_action, words)


@pytest.mark.parametrize("line", PLAIN)
def test_plain_words_are_read_quickly(line: str) -> None:
    assert plain_action(line.split()) is not None
    assert agree(line.split())


@pytest.mark.parametrize("line", NOT_PLAIN)
def test_other_words_are_left_to_typer(line: str) -> None:
    assert plain_action(line.split()) is None


FLAGS = sorted({*(flag for name in QUESTIONS for flag in COMMANDS[name].flags())})
VALUES = ["", *"100nm quartz iron 5nN -5nN 3 0 17 18 1e-3 2 plane - -- x=y é all -.5nm".split()]


def random_words(source: random.Random) -> list[str]:
    """Return a command line of plausible and implausible pieces."""
    words = [source.choice([name for name in COMMANDS if name != "batch"])]
    for _ in range(source.randrange(7)):
        flag, value = source.choice(FLAGS), source.choice(VALUES)
        words += source.choice([[flag], [flag, value], [f"{flag}={value}"], [value], [value], [flag[:-1]]])
    return words


def is_quick(words: list[str]) -> bool:
    """Return whether words are answered without typer."""
    return answer_of(plain_action, words) is not None


def test_readers_agree_on_random_command_lines() -> None:
    source = random.Random(5)
    lines = [random_words(source) for _ in range(200)]
    assert [words for words in lines if not agree(words)] == []
    assert sum(map(is_quick, lines)) > 40


@pytest.mark.slow
def test_readers_agree_on_very_many_random_command_lines() -> None:
    source = random.Random(6)
    assert [words for words in (random_words(source) for _ in range(20_000)) if not agree(words)] == []


@given(st.sampled_from([*QUESTIONS]), st.lists(st.text(max_size=8) | st.sampled_from([*FLAGS, *VALUES]), max_size=6))
def test_readers_agree_on_any_text(command: str, words: list[str]) -> None:
    assert agree([command, *words])


# --- The registry -------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("name", COMMANDS)
def test_every_option_has_a_place_for_its_value(name: str) -> None:
    for option in COMMANDS[name].options():
        assert option.name in Call._fields or option.name in NOMENCLATURE, option.flag


def test_every_question_has_a_command_that_takes_the_ways_to_write() -> None:
    for name in QUESTIONS:
        assert {*OUTPUT} <= {*COMMANDS[name].options()}


# --- Values and words ---------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("flag", ["--load -3nN", "--load=-3nN"])
def test_a_negative_value_is_one_where_an_option_takes_it(run: Run, flag: str) -> None:
    assert json.loads(run(f"contact quartz 100nm {flag} --json").out)["inputs"]["load"] == -3e-9


def test_file_names_may_begin_with_a_hyphen_and_a_digit(run: Run) -> None:
    Path("-1.csv").write_text("material,radius\nquartz,100nm\n", encoding="utf-8")
    for words in (["-1.csv", "-o", "-2.csv"], ["-o-3.csv", "--", "-1.csv"]):
        assert run("batch", "--jobs", "1", "--quiet", *words).code == 0
    assert sorted(path.name for path in Path().iterdir()) == ["-1.csv", "-2.csv", "-3.csv"]


@pytest.mark.parametrize(
    ("word", "problem"), [("a\0.csv", "contains a NUL character"), ("a\ud83d.csv", "contains half a character")]
)
def test_what_is_in_no_word_is_refused(run: Run, word: str, problem: str) -> None:
    ran = run("pull-off", "quartz", "1um", "-o", word)
    assert (ran.code, ran.out) == (2, "")
    assert ran.err.startswith(f"jkroll: 'a?.csv' {problem}")
