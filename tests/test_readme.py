"""The README is a transcript: every command in it is run and must print what stands there.

python tests/test_readme.py        writes the transcript anew, to be read before it is committed
"""

import doctest
import io
import os
import re
import sys
import tempfile
from contextlib import chdir, redirect_stderr, redirect_stdout
from pathlib import Path
from unittest import mock

import pytest

from jkroll.cli.commands import COMMANDS
from jkroll.cli.process import main

if __package__ in (None, ""):
    sys.path.insert(0, str(Path(__file__).parent))
from harness import Stream

README = Path(__file__).parents[1] / "README.md"
_CONSOLE = re.compile(r"```console\n(.*?)```", re.DOTALL)


def commands(block: str) -> list[str]:
    """The commands of a console block."""
    return [line.removeprefix("$ ") for line in block.splitlines() if line.startswith("$ ")]


def with_file(block: str) -> str:
    """A block, after the file with whose text it begins was written."""
    if match := re.match(r"\$ cat (\S+)\n((?:(?!\$ ).*\n)*)", block):
        Path(match[1]).write_text(match[2], encoding="utf-8")
    return block


def transcript(command: str) -> str:
    """A command and what it prints on a terminal, results and notes."""
    program, *words = command.split()
    if program == "cat":
        return f"$ {command}\n{Path(words[0]).read_text(encoding='utf-8')}"
    assert program == "jkroll"
    stream = Stream(terminal=True)
    with redirect_stdout(stream), redirect_stderr(stream):
        main(words)
    lines = [line.rstrip() for line in stream.text().splitlines()]
    return "\n".join([f"$ {command}", *lines]) + "\n"


BLOCKS = _CONSOLE.findall(README.read_text(encoding="utf-8"))


@pytest.mark.parametrize("block", BLOCKS, ids=lambda block: commands(block)[0])
def test_transcript(block: str) -> None:
    assert block == "".join(transcript(command) for command in commands(with_file(block)))


def test_every_command_is_shown() -> None:
    shown = {command.split()[1] for block in BLOCKS for command in commands(block) if not command.startswith("cat ")}
    assert shown == {*COMMANDS} - {"bench", "verify", "energies", "export"}


def test_python_examples() -> None:
    examples = "\n".join(re.findall(r"```python\n(.*?)```", README.read_text(encoding="utf-8"), re.DOTALL))
    test = doctest.DocTestParser().get_doctest(examples, {}, "README", str(README), 0)
    output = io.StringIO()
    results = doctest.DocTestRunner().run(test, out=output.write)
    assert results.attempted > 5
    assert results.failed == 0, output.getvalue()


def test_two_commands_are_all_the_set_up_there_is() -> None:
    shell = re.findall(r"```sh\n(.*?)```", README.read_text(encoding="utf-8"), re.DOTALL)
    assert len(shell) == 2
    assert all(len(block.splitlines()) == 1 for block in shell)


if __name__ == "__main__":
    text = README.read_text(encoding="utf-8")
    environment = {"COLUMNS": "80", "LINES": "24", "TERM": "dumb", "XDG_CONFIG_HOME": "/nonexistent"}
    with tempfile.TemporaryDirectory() as folder, chdir(folder), mock.patch.dict(os.environ, environment):
        text = _CONSOLE.sub(
            lambda match: "```console\n" + "".join(map(transcript, commands(with_file(match[1])))) + "```", text
        )
    README.write_text(text, encoding="utf-8")
