"""The README: every command in it works and prints the output that is shown, if any."""

import re
from pathlib import Path

import pytest

from transcripts import commands, copied_once, exit_code, failures, printed, rounded, transcripts

README = (Path(__file__).parents[1] / "README.md").read_text(encoding="utf-8")
MOST = 7_000  # bytes


@pytest.mark.parametrize("block", transcripts(README), ids=lambda block: commands(block)[0])
def test_a_transcript_has_the_output_of_its_commands(block: str) -> None:
    assert rounded(block) == rounded(printed(block))


@pytest.mark.parametrize("command", copied_once(README))
def test_a_command_in_the_text_works(command: str) -> None:
    assert exit_code(command) == 0


def test_python_examples_have_the_shown_output() -> None:
    assert failures(README) == ""


def test_the_readme_has_two_shell_blocks_of_one_line() -> None:
    shell = re.findall(r"```sh\n(.*?)```", README, re.DOTALL)
    assert len(shell) == 2
    assert all(len(block.splitlines()) == 1 for block in shell)


def test_the_readme_has_at_most_7000_bytes() -> None:
    assert len(README.encode()) <= MOST
