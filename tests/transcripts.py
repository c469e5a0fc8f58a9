"""Commands in Markdown, which are run: blocks that show their output, blocks to copy, and commands in running text.

A `console` block is a transcript. A `sh-session` block has commands to copy, and running text has commands in
backquotes; all of these must end with the exit code 0. `python tests/transcripts.py FILE...` renews the transcripts in
files; read them before you commit them.
"""

import doctest
import io
import os
import re
import shlex
import shutil
import sys
import tempfile
from collections.abc import Iterator
from contextlib import chdir, nullcontext, redirect_stderr, redirect_stdout
from itertools import chain
from math import inf
from pathlib import Path
from typing import Any
from unittest import mock

if __package__ in (None, ""):
    sys.path.insert(0, str(Path(__file__).parent))
from harness import Stream
from jkroll.cli.process import main

CONSOLE = re.compile(r"```console\n(.*?)```", re.DOTALL)
_COPIED = re.compile(r"```sh-session\n(.*?)```", re.DOTALL)
_BLOCK = re.compile(r"```.*?```", re.DOTALL)
_IN_TEXT = re.compile(r"`(jkroll [^`]+)`")
_ALL_DIGITS = re.compile(r"(?=[\d.]{15,})\d+\.\d+")  # of a number in full precision
_NOT_RUN = ("jkroll bench", "jkroll --install-completion", "jkroll COMMAND", "jkroll --show-completion")
TABLE = "grain,material,radius [nm]\na,quartz,100\nb,iron,1000\n"  # for commands that read grains.csv
TERMINAL = {"COLUMNS": "80", "LINES": "24", "TERM": "dumb", "XDG_CONFIG_HOME": "/nonexistent"}  # for renewing a page
CURVE = Path(__file__).parent / "data" / "probe.csv"  # for commands that read curve.csv
MATERIALS = '[materials.mine]\nsurface_energy = "30 mJ/m2"\n'  # for commands that read mine.toml


def commands(block: str) -> list[str]:
    """Return the commands of a console block."""
    return [line.removeprefix("$ ") for line in block.splitlines() if line.startswith("$ ")]


def write_shown_file(block: str) -> None:
    """Write the file whose text a block shows first, with `cat`; other blocks write nothing."""
    shown = re.match(r"\$ cat (\S+)\n((?:(?!\$ ).*\n)*)", block)
    if shown:
        Path(shown[1]).write_text(shown[2], encoding="utf-8")


def transcript(command: str) -> str:
    """Return a command and its output on a terminal, results and notes."""
    program, *words = shlex.split(command)
    if program == "cat":
        return f"$ {command}\n{Path(words[0]).read_text(encoding='utf-8')}"
    assert program == "jkroll"
    stream, is_table = Stream(terminal=True), words[:1] == ["batch"]
    # A progress bar, which appears on a slow machine, is not part of the text.
    without_bar = mock.patch("jkroll.tables.progress.WAIT", inf) if is_table else nullcontext()
    with redirect_stdout(stream), redirect_stderr(stream), without_bar:
        main(words)
    lines = [line.rstrip() for line in stream.text().splitlines()]
    return "\n".join([f"$ {command}", *lines]) + "\n"


def rounded(text: str) -> str:
    """Return a text with numbers of full precision rounded to 13 digits; the last digits depend on numpy."""
    return _ALL_DIGITS.sub(lambda number: f"{float(number[0]):.13g}", text)


def printed(block: str) -> str:
    """Write the file that a console block shows first, and return the commands of the block with their output."""
    write_shown_file(block)
    return "".join(map(transcript, commands(block)))


def transcripts(text: str) -> list[str]:
    """Return the console blocks of a text."""
    return CONSOLE.findall(text)


def copied(text: str) -> Iterator[str]:
    """Iterate over the commands of a text outside of transcripts, each up to a pipe or a redirection.

    Commands in _NOT_RUN, and those with an ellipsis, are left out.
    """
    lines = "".join(_COPIED.findall(text)).splitlines()
    lines += _IN_TEXT.findall(_BLOCK.sub("", text))
    for line in lines:
        if not line.startswith(_NOT_RUN) and "…" not in line:
            yield re.split(r" [|>] ", line)[0]


def copied_once(*texts: str) -> list[Any]:
    """Return the commands of texts outside of transcripts, each once, as test parameters.

    Commands that draw a file are slow.
    """
    import pytest

    every = dict.fromkeys(chain.from_iterable(map(copied, texts)))
    draws = re.compile(r" -o \S+\.(svg|pdf|png)")
    return [pytest.param(command, marks=pytest.mark.slow if draws.search(command) else ()) for command in every]


def exit_code(command: str) -> int:
    """Run a command next to the files that texts mention, and return its exit code."""
    Path("grains.csv").write_text(TABLE, encoding="utf-8")
    Path("mine.toml").write_text(MATERIALS, encoding="utf-8")
    shutil.copy(CURVE, "curve.csv")
    Path("grains").mkdir(exist_ok=True)
    Path("grains/a.csv").write_text(TABLE, encoding="utf-8")
    stream = Stream()
    with redirect_stdout(stream), redirect_stderr(stream):
        return main(shlex.split(command)[1:])


def failures(text: str) -> str:
    """Return doctest's report on the Python examples of a text whose output differs."""
    examples = "\n".join(re.findall(r"```python\n(.*?)```", text, re.DOTALL))
    test = doctest.DocTestParser().get_doctest(examples, {}, "examples", "examples", 0)
    said = io.StringIO()
    results = doctest.DocTestRunner().run(test, out=said.write)
    assert results.attempted > 3
    return said.getvalue() if results.failed else ""


def renewed(text: str) -> str:
    """Return a text with its transcripts renewed."""
    return CONSOLE.sub(lambda match: f"```console\n{printed(match[1])}```", text)


if __name__ == "__main__":
    for path in [Path(word).resolve() for word in sys.argv[1:]]:
        with tempfile.TemporaryDirectory() as folder, chdir(folder), mock.patch.dict(os.environ, TERMINAL):
            path.write_text(renewed(path.read_text(encoding="utf-8")), encoding="utf-8")
