"""Completion: where a line is answered without typer, typer's own answer is the same, in each shell's protocol."""

import io
import os
import random
import re
from contextlib import redirect_stdout
from unittest import mock

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from harness import Run
from jkroll.answers.questions import COMMANDS
from jkroll.cli.options import EXTRAS, flags_of
from jkroll.cli.process import main
from jkroll.cli.tab import candidates, quick_answer
from jkroll.cli.typer_app import build

SHELLS = ("bash", "zsh", "fish", "is-args")
LINES = {
    "": "pull-off",
    "pul": "pull-off",
    "-": "--version",
    "--sh": "--show-completion",
    "pull-off ": "quartz",
    "pull-off qu": "quartz",
    "pull-off iron,qu": "iron,quartz",
    "pull-off 10": "10nm",
    "pull-off quartz 100": "100um",
    "pull-off --": "--gamma",
    "pull-off quartz 100nm --bare --q": "--quiet",
    "pull-off -": "-h",
    "contact quartz --load ": "-5nN",
    "contact quartz --load 5": "5nN",
    "contact --load=5": "5nN",
    "pull-off --material2 g": "graphite",
    "pull-off --material2=ir": "iron",
    "map pull-off --x=rad": "radius=",
    "materials ": "quartz",
    "materials --": "--json",
    "bench --": "--quick",
}
WITHOUT_CANDIDATES = [
    "pull-off zzz",
    "pull-off --zzz",
    "pull-off --bare --bar",
    "pull-off --to ",
    "pull-off --digits 3",
    "materials quartz ",
    "verify ",
    "contact -5",
]
LEFT_TO_TYPER = [
    "pul-off qu",
    "pull-off 'qu",
    'pull-off "qu',
    "pull-off \\",
    "pull-off --laod 3 qu",
    "pull-off --help qu",
    "pull-off --bare=q",
    "pull-off -- qu",
    "pull-off --digits 99 qu",
    "--version pul",
]


def asked(shell: str, line: str) -> dict[str, str]:
    """The environment in which a shell asks, as typer's scripts set it."""
    if shell == "bash":
        words = f"jkroll {line}"
        return {
            "_JKROLL_COMPLETE": "complete_bash",
            "COMP_WORDS": words.replace(" ", "\n"),  # typer's script joins them so
            "COMP_CWORD": str(len(words.split(" ")) - 1),
        }
    if shell == "zsh":
        return {"_JKROLL_COMPLETE": "complete_zsh", "_TYPER_COMPLETE_ARGS": f"jkroll {line}"}
    return {
        "_JKROLL_COMPLETE": "complete_fish",
        "_TYPER_COMPLETE_ARGS": f"jkroll {line}",
        "_TYPER_COMPLETE_FISH_ACTION": "is-args" if shell == "is-args" else "get-args",
    }


def pieces(text: str) -> list[str]:
    """The words of an answer: rich breaks typer's into lines, and typer takes -h and --help in any order."""
    return sorted(text.replace("((", " ").replace("))", " ").split())


def typers(environment: dict[str, str]) -> tuple[int, list[str]]:
    """Typer's answer: exit code and words."""
    out = io.StringIO()
    words = environment.get("COMP_WORDS", environment.get("_TYPER_COMPLETE_ARGS", "")).split()[1:]
    only = next((word for word in words if not word.startswith("-")), None)
    with mock.patch.dict(os.environ, environment), redirect_stdout(out):
        try:
            build(only)([], prog_name="jkroll", standalone_mode=False)
        except SystemExit as stop:
            return int(stop.code or 0), pieces(out.getvalue())
    raise AssertionError("typer did not complete")


def with_flag(answer: tuple[int, list[str]], shell: str, line: str) -> tuple[int, list[str]]:
    """Typer's answer for --load=5, with --load= before each word but in bash: the others complete the whole of it."""
    flag, has_value, _ = line.rsplit(" ", maxsplit=1)[-1].partition("=")
    if not has_value or shell == "bash":
        return answer
    code, words = answer
    return code, [re.sub(r'^("?)(?=\w|-\d)(?!_arg|_files)', rf"\g<1>{flag}=", word) for word in words]


def quick(environment: dict[str, str]) -> tuple[int, list[str]] | None:
    """Our answer, if the line is plain."""
    out = io.StringIO()
    with redirect_stdout(out):
        call = quick_answer(environment)
        return None if call is None else (call(), pieces(out.getvalue()))


@pytest.mark.parametrize("shell", SHELLS)
@pytest.mark.parametrize("line", [*LINES, *WITHOUT_CANDIDATES])
def test_plain_lines_are_answered_as_typer_does(shell: str, line: str) -> None:
    environment = asked(shell, line)
    answer = quick(environment)
    assert answer is not None
    assert answer == with_flag(typers(environment), shell, line)


@pytest.mark.parametrize("line", LINES)
def test_what_was_wanted_is_offered(line: str) -> None:
    *words, begun = line.split(" ")
    assert LINES[line] in [candidate.word for candidate in candidates(words, begun) or []]


@pytest.mark.parametrize("shell", SHELLS)
@pytest.mark.parametrize("line", LEFT_TO_TYPER)
def test_other_lines_are_left_to_typer(shell: str, line: str) -> None:
    assert quick(asked(shell, line)) is None


@pytest.mark.parametrize(
    "environment",
    [
        {"_JKROLL_COMPLETE": "complete_bash", "COMP_WORDS": "jkroll p", "COMP_CWORD": "9"},
        {"_JKROLL_COMPLETE": "complete_zsh"},
        {"_JKROLL_COMPLETE": "complete_powershell", "_TYPER_COMPLETE_ARGS": "jkroll p"},
        {"_JKROLL_COMPLETE": "source_bash"},
        {"_JKROLL_COMPLETE": "nonsense"},
    ],
)
def test_other_questions_are_left_to_typer(environment: dict[str, str]) -> None:
    assert quick_answer(environment) is None


WORDS = [
    *(flag for name in COMMANDS for flag in flags_of(name)),
    *("quartz", "iron,", "100nm", "10", "5", "-5nN", "", "=", "--", "--load=", "--gamma=2", "--bare=1", "x:y", "$HOME"),
]


def random_line(source: random.Random) -> str:
    """A line of plausible and implausible words, the last one cut anywhere."""
    words = [source.choice([*COMMANDS, *EXTRAS])] + [source.choice(WORDS) for _ in range(source.randrange(5))]
    line = " ".join(words)
    return line[: len(line) - source.randrange(len(words[-1]) + 1)]


def disagreements(seed: int, count: int) -> list[tuple[str, str]]:
    """The random lines on which both readers answer differently, of at least a third on which both do."""
    source = random.Random(seed)
    both, different = 0, []
    for number in range(count):
        shell, line = SHELLS[number % len(SHELLS)], random_line(source)
        answer = quick(asked(shell, line))
        both += answer is not None
        if answer is not None and answer != with_flag(typers(asked(shell, line)), shell, line):
            different.append((shell, line))
    assert both > count / 3
    return different


def test_both_answer_random_lines_alike() -> None:
    assert disagreements(7, 300) == []


@pytest.mark.slow
def test_both_answer_very_many_random_lines_alike() -> None:
    assert disagreements(8, 10_000) == []


@settings(max_examples=60, deadline=None)
@given(
    st.sampled_from(SHELLS), st.sampled_from([*COMMANDS]), st.text(st.characters(exclude_categories=["Cs"]), max_size=9)
)
def test_both_answer_any_text_alike(shell: str, command: str, text: str) -> None:
    environment = asked(shell, f"{command} {text}")
    if "\0" not in text and (answer := quick(environment)) is not None:
        assert answer == typers(environment)


def test_the_program_answers(monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> None:
    for name, value in asked("zsh", "pull-off quartz 10").items():
        monkeypatch.setenv(name, value)
    assert main([]) == 0
    assert capsys.readouterr().out.startswith('_arguments \'*: :(("10nm"\n')


@pytest.mark.parametrize(
    "said", [{}, {"COMP_WORDS": "jkroll pull"}, {"COMP_WORDS": "jkroll '", "COMP_CWORD": "x"}, {"COMP_CWORD": "1"}]
)
def test_what_no_bash_asks_is_refused_in_a_line(
    run: Run, monkeypatch: pytest.MonkeyPatch, said: dict[str, str]
) -> None:
    for name in ("COMP_WORDS", "COMP_CWORD"):
        monkeypatch.delenv(name, raising=False)
    for name, text in (said | {"_JKROLL_COMPLETE": "complete_bash"}).items():
        monkeypatch.setenv(name, text)
    problem = "_JKROLL_COMPLETE=complete_bash is for bash: it sets COMP_WORDS, and COMP_CWORD to a number"
    assert run("pull-off") == (2, "", f"jkroll: {problem}\n")
