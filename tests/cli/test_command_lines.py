"""Thousands of command lines: random lines have a documented exit code, and lines of the corpus have the one listed."""

import resource
from collections import Counter
from collections.abc import Collection, Iterable, Iterator
from pathlib import Path
from random import Random

import pytest

from command_lines import WEIGHTS, command_line
from corpus_lines import Line, among_input_files, commands, faults, lines, output, outputs, run
from invariants import check_call, isolate
from jkroll.cli.commands import COMMANDS, flags_of
from jkroll.quantities.laws import MODELS
from jkroll.quantities.nomenclature import NOMENCLATURE

WRITES_TO_THE_HOME = {"install_completion"}


def run_many(count: int, seed: int) -> Counter[int]:
    """Check generated command lines; return the number of lines for each exit code."""
    source = Random(seed)
    return Counter(check_call(command_line(source)) for _ in range(count))


@pytest.fixture
def _isolated(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[None]:
    """Isolate a test; restore the variables, the directory and the limit of file sizes afterwards."""
    limits = resource.getrlimit(resource.RLIMIT_FSIZE)
    for name in ("XDG_CONFIG_HOME", "COLUMNS", "TERM", "JKROLL_MATERIALS", "_JKROLL_COMPLETE", "FORCE_COLOR"):
        monkeypatch.setenv(name, "")  # `isolate` changes the variable, and monkeypatch restores it
    monkeypatch.chdir(tmp_path)
    isolate(str(tmp_path))
    yield
    resource.setrlimit(resource.RLIMIT_FSIZE, limits)


@pytest.mark.usefixtures("_isolated")
def test_generated_command_lines_have_documented_exit_codes() -> None:
    codes = run_many(60, seed=1)
    assert min(codes[code] for code in (0, 1, 2)) > 3


@pytest.mark.slow
@pytest.mark.usefixtures("_isolated")
@pytest.mark.parametrize("seed", range(5))
def test_very_many_generated_command_lines_have_documented_exit_codes(seed: int) -> None:
    run_many(10_000, seed=100 + seed)


def wrong(tried: Iterable[Line]) -> dict[str, list[str]]:
    """Run lines among input files; return the faults of lines that have some, by line."""
    found = {line.typed: faults(line, run(line)) for line in tried}
    return {typed: what for typed, what in found.items() if what}


@pytest.mark.slow
def test_no_line_of_the_corpus_has_a_fault() -> None:
    with among_input_files():
        assert wrong(line for line in lines() if line.can_run) == {}


def test_lines_of_the_corpus_print_the_outputs_that_were_checked_by_reading() -> None:
    kept = outputs()
    assert kept.keys() <= {line.typed for line in lines()}
    with among_input_files():
        outcomes = {line: run(line) for line in lines() if line.typed in kept and line.can_run}
    found = {line.typed: (output(line, outcome), faults(line, outcome)) for line, outcome in outcomes.items()}
    assert found == {typed: (kept[typed], []) for typed in found}


def wrong_with_inputs(command: str | None, inputs: Collection[str]) -> dict[str, list[str]]:
    """Return faults by line; each line is the example of a command with one more input.

    Each line must have the exit code of the example.
    """
    if not inputs:
        return {}
    example = f"jkroll {command} {COMMANDS[command].example}" if command else "jkroll pull-off quartz 100nm"
    with among_input_files():
        code = run(Line(0, example)).code
        options = [NOMENCLATURE[name] for name in inputs]
        return wrong(Line(code, f"{example} {option.option} {option.example}") for option in options)


def test_the_corpus_has_every_command_option_and_law() -> None:
    typed = [command.words for line in lines() for command in commands(line.typed)]
    assert len({line.typed for line in lines()}) == len(lines())
    for name in (None, *COMMANDS):
        flags = flags_of(name)
        found = {word.partition("=")[0] for words in typed if name in (None, *words[:1]) for word in words}
        names = {option.name for option in flags.values()} - WRITES_TO_THE_HOME
        lacking = names - {flags[word].name for word in found & flags.keys()} - WRITES_TO_THE_HOME
        assert not lacking - NOMENCLATURE.keys(), f"tests/corpus/command_lines.txt has no line of {name} with {lacking}"
        assert wrong_with_inputs(name, lacking) == {}
    models = [words[words.index("--model") + 1] for words in typed if "--model" in words[:-1]]
    assert {*MODELS} <= {*models}


def test_every_command_is_among_the_generated_lines() -> None:
    assert {*WEIGHTS} == {*COMMANDS}
