"""The README is a transcript: every command in it is run and must print the output that it shows."""

import re
from pathlib import Path

import pytest

from transcripts import commands, copied_once, exit_code, failures, printed, rounded, transcripts

README = (Path(__file__).parents[1] / "README.md").read_text(encoding="utf-8")
MOST = 7_000  # bytes


@pytest.mark.parametrize("block", transcripts(README), ids=lambda block: commands(block)[0])
def test_transcript(block: str) -> None:
    assert rounded(block) == rounded(printed(block))


@pytest.mark.parametrize("command", copied_once(README))
def test_a_command_in_the_text_works(command: str) -> None:
    assert exit_code(command) == 0


def test_python_examples() -> None:
    assert failures(README) == ""


def test_two_commands_are_all_the_set_up_there_is() -> None:
    shell = re.findall(r"```sh\n(.*?)```", README, re.DOTALL)
    assert len(shell) == 2
    assert all(len(block.splitlines()) == 1 for block in shell)


def test_it_is_a_page() -> None:
    assert len(README.encode()) <= MOST
