"""Two readers of one command line, made from one declaration: where the quick one answers, typer's says the same."""

import io
import random
from contextlib import redirect_stdout
from functools import partial

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from harness import Run
from jkroll.answers.questions import COMMANDS
from jkroll.cli.mistakes import UnknownOption
from jkroll.cli.options import EXTRAS, OUTPUT, options_of
from jkroll.cli.reader import quick_call, with_minus_signs
from jkroll.cli.typer_app import build

PLAIN = [
    "pull-off quartz 100nm",
    "pull-off quartz 100nm --bare",
    "yield-force quartz,iron 1nm:1um:5 --load -5nN --csv --quiet",
    "frequencies --radius2 plane quartz 100nm --material2=iron --digits 3",
    "n-roll --energy-ratio 2 quartz 1um --to= --json",
    "contact quartz 100nm --curve --csv",
    "moment quartz 100nm --xi 1angstrom",
    "materials",
    "materials quartz --json",
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
    "pull-off quartz 100nm --bare=x --laod",
    "pull-off -- --laod",
    "pull-off --=x",
    "pull-off -laod 5nN",
    "pull-off quartz 100nm --digits 99",
    "pull-off quartz 100nm --digits x",
    "pull-off quartz 100nm --to",
    "pull-off quartz 100nm --to --json",
    "pull-off quartz 100nm --json=yes",
    "pull-off -- quartz 100nm",
    "materials quartz iron",
    "pul-off quartz 100nm",
]


def typers(words: list[str]) -> object:
    """What typer makes of the words: a call, what it printed itself, or its complaint."""
    out = io.StringIO()
    try:
        with redirect_stdout(out):
            made = build(words[0])(words, prog_name="jkroll", standalone_mode=False)
    except Exception as error:  # any complaint is an answer
        return error
    return made if callable(made) else out.getvalue()


def plain(call: object) -> object:
    """A call in a form that can be compared; of help and the version, what they print."""
    if not isinstance(call, partial) or not call.func.__name__.startswith("run_"):
        out = io.StringIO()
        with redirect_stdout(out):
            assert callable(call)
            assert call() == 0
        return out.getvalue()
    arguments = [list(item) if isinstance(item, tuple) and not hasattr(item, "_fields") else item for item in call.args]
    return call.func, arguments, call.keywords


def agree(words: list[str]) -> bool:
    """Whether both readers understand the words alike, or only typer does."""
    try:
        quick = quick_call(words)
    except UnknownOption as error:
        other = typers(words)
        return isinstance(other, UnknownOption) and str(other) == str(error)
    if quick is None:
        return True
    other = typers(words)
    return not isinstance(other, Exception) and plain(quick) == (plain(other) if callable(other) else other)


@pytest.mark.parametrize("line", PLAIN)
def test_plain_words_are_read_quickly(line: str) -> None:
    words = with_minus_signs(line.split())
    assert quick_call(words) is not None
    assert agree(words)


@pytest.mark.parametrize("line", NOT_PLAIN)
def test_other_words_are_left_to_typer(line: str) -> None:
    assert quick_call(with_minus_signs(line.split())) is None


MISTYPED = [
    "pull-off quartz 100nm --laod 5nN",
    "pull-off --laod=5nN quartz",
    "pull-off --help --laod",
    "pull-off --digits 99 --laod",
    "pull-off --quartz --laod",
    "materials quartz iron --laod",
    "batch -o out.csv --laod",
    "contact --lo=3",
    "r-min ---",
    "report --young 1GPa --youn",
]


@pytest.mark.parametrize("line", MISTYPED)
def test_an_option_that_is_none_is_refused_without_typer(line: str) -> None:
    words = with_minus_signs(line.split())
    with pytest.raises(UnknownOption):
        quick_call(words)
    assert agree(words)


FLAGS = sorted({*(option.flag for command in COMMANDS.values() for option in options_of(command)), "-h", "--help"})
VALUES = [
    "100nm",
    "quartz",
    "iron",
    "5nN",
    "-5nN",
    "3",
    "0",
    "17",
    "18",
    "1e-3",
    "2",
    "plane",
    "",
    "-",
    "--",
    "x=y",
    "é",
    "all",
]


def random_words(source: random.Random) -> list[str]:
    """A command line of plausible and implausible pieces."""
    words = [source.choice([*COMMANDS, *EXTRAS])]
    for _ in range(source.randrange(7)):
        flag, value = source.choice(FLAGS), source.choice(VALUES)
        words += source.choice([[flag], [flag, value], [f"{flag}={value}"], [value], [value], [flag[:-1]]])
    return with_minus_signs(words)


def is_quick(words: list[str]) -> bool:
    """Whether words are answered without typer."""
    try:
        return quick_call(words) is not None
    except UnknownOption:
        return True


def test_readers_agree_on_random_command_lines() -> None:
    source = random.Random(5)
    lines = [random_words(source) for _ in range(500)]
    assert [words for words in lines if not agree(words)] == []
    assert sum(is_quick(words) for words in lines) > 100


@pytest.mark.slow
def test_readers_agree_on_very_many_random_command_lines() -> None:
    source = random.Random(6)
    assert [words for words in (random_words(source) for _ in range(20_000)) if not agree(words)] == []


@settings(max_examples=100, deadline=None)
@given(st.sampled_from([*COMMANDS]), st.lists(st.text(max_size=8) | st.sampled_from([*FLAGS, *VALUES]), max_size=6))
def test_readers_agree_on_any_text(command: str, words: list[str]) -> None:
    assert agree(with_minus_signs([command, *words]))


def test_every_command_takes_the_ways_to_write() -> None:
    for command in COMMANDS.values():
        assert set(OUTPUT) <= set(options_of(command))


@pytest.mark.parametrize("word", ["a\0.csv", "a\ud83d.csv"])
def test_what_is_in_no_word_is_refused(run: Run, word: str) -> None:
    ran = run("pull-off", "quartz", "1um", "-o", word)
    assert ran == (2, "", "jkroll: 'a?.csv' has a character in it that no word has\n")
