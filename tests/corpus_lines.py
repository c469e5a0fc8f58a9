"""The command lines of tests/corpus/command_lines.txt: read, run and judge them.

A line holds an exit code and a typed command, such as `0 jkroll pull-off quartz 100nm`. The outputs of some lines
are in tests/corpus/outputs.txt; a person has read them. The output stands below `$` and the line, the text on standard
error after `!`, and each file that the line writes after `>`. A line runs next to the files of tests/input_files.py,
on a terminal of 80 columns without colour. As in a shell, `| cat` makes standard output a pipe, `< FILE` sets standard
input, `NAME=VALUE` before the program sets an environment variable, and `;` precedes another command, which then
decides the exit code. Standard error is no terminal, because progress bars depend on time. Lines below `# needs
MODULE`, up to the next line that begins with #, need this library, which some installations lack.

This module imports only `main` from jkroll, so that it can also run the lines in another checkout.
"""

import json
import os
import re
import shlex
import shutil
import tempfile
from collections.abc import Iterator, Mapping, Sequence
from contextlib import chdir, contextmanager
from importlib.util import find_spec
from itertools import groupby
from pathlib import Path
from typing import NamedTuple, NoReturn
from unittest import mock

from harness import Ran, captured
from input_files import CONTENTS
from transcripts import rounded

PATH = Path(__file__).parent / "corpus" / "command_lines.txt"
OUTPUTS = PATH.with_name("outputs.txt")
LONGEST = 40  # the largest number of lines of a kept output
_ENVIRONMENT = {"XDG_CONFIG_HOME": "/nonexistent", "COLUMNS": "80", "LINES": "24", "TERM": "dumb"}
_FOREIGN = ("JKROLL_MATERIALS", "_JKROLL_COMPLETE", "FORCE_COLOR", "NO_COLOR", "COLORTERM")
_directories: set[Path] = set()  # directories in which lines may be run
_UNFORESEEN = ("Traceback", "this is a bug in jkroll")


class Line(NamedTuple):
    """A line of the corpus."""

    code: int
    typed: str
    library: str = ""  # the library that it needs, if any

    @property
    def can_run(self) -> bool:
        """True if the line needs no library, or the library is installed."""
        return not self.library or find_spec(self.library) is not None


class Outcome(NamedTuple):
    """The outcome of a line: its exit code, its streams, and new or changed files."""

    code: int
    out: str
    err: str
    files: dict[str, bytes]


class Command(NamedTuple):
    """One command of a line."""

    words: list[str]
    variables: dict[str, str]
    standard_input: str
    is_piped: bool


def lines() -> list[Line]:
    """Return the corpus."""
    found, library = [], ""
    for text in PATH.read_text(encoding="utf-8").splitlines():
        if text.startswith("#"):
            library = text.removeprefix("# needs ") if text.startswith("# needs ") else ""
        elif text:
            code, _, typed = text.partition(" ")
            found.append(Line(int(code), typed, library))
    return found


def spread(corpus: Sequence[Line], count: int) -> list[Line]:
    """Return at most `count` lines spread over the corpus, the same at every call."""
    count = min(count, len(corpus))
    return [corpus[index * len(corpus) // count] for index in range(count)]


def commands(typed: str) -> Iterator[Command]:
    """Iterate over the commands of a line."""
    for is_separator, group in groupby(shlex.split(typed), lambda word: word == ";"):
        if is_separator:
            continue
        words = [*group]
        program = words.index("jkroll")
        variables = dict(word.split("=", 1) for word in words[:program])
        words = words[program + 1 :]
        is_piped = words[-2:] == ["|", "cat"]
        if is_piped:
            words = words[:-2]
        standard_input = os.devnull
        if words[-2:-1] == ["<"]:
            *words, _, standard_input = words
        yield Command(words, variables, standard_input, is_piped)


@contextmanager
def among_input_files() -> Iterator[None]:
    """Go into a new directory that holds the input files, so that lines can be run there."""
    with tempfile.TemporaryDirectory() as directory, chdir(directory):
        _directories.add(Path.cwd())
        for name in CONTENTS:
            _restore(name)
        try:
            yield
        finally:
            _directories.clear()


def _restore(name: str) -> None:
    """Write an input file, always with the same modification time."""
    Path(name).write_bytes(CONTENTS[name])
    os.utime(name, (0, 0))


def run(line: Line) -> Outcome:
    """Run a line in this process, then restore the directory.

    Raises RuntimeError outside of `among_input_files`.
    """
    if Path.cwd() not in _directories:
        raise RuntimeError(f"{Path.cwd()} is not a directory of among_input_files, which deletes all other files")
    code, out, err = 0, "", ""
    with mock.patch.dict(os.environ, _ENVIRONMENT):
        for name in _FOREIGN:
            os.environ.pop(name, None)
        for command in commands(line.typed):
            code, new_out, new_err = _run(command)
            out, err = out + new_out, err + new_err
    found = {str(path): path.read_bytes() for path in sorted(Path().rglob("*")) if path.is_file()}
    written = {name: content for name, content in found.items() if CONTENTS.get(name) != content}
    for path in Path().iterdir():
        if path.is_dir():
            shutil.rmtree(path)
        elif path.name not in CONTENTS:
            path.unlink()
        elif path.name in written:
            _restore(path.name)
    return Outcome(code, out, err, written)


def _run(command: Command) -> Ran:
    """Run one command."""
    with open(command.standard_input, "rb") as standard_input, mock.patch.dict(os.environ, command.variables):
        os.dup2(standard_input.fileno(), 0)
        return captured(command.words, terminal=not command.is_piped)


def faults(line: Line, outcome: Outcome) -> list[str]:
    """Return the faults of an outcome: a wrong exit code, a traceback, or invalid JSON after `--json`."""
    found = [f"exit code {outcome.code}: {outcome.err}"] if outcome.code != line.code else []
    found += [outcome.err for text in _UNFORESEEN if text in outcome.err]
    if "--json" in shlex.split(line.typed) and outcome.out:
        try:
            json.loads(outcome.out, parse_constant=_refuse)
        except ValueError as error:
            found.append(f"no JSON: {error}")
    return found


def _refuse(constant: str) -> NoReturn:
    raise ValueError(f"{constant} is not a JSON number")


# --- Outputs that a person has read -----------------------------------------------------------------------------------


def output(line: Line, outcome: Outcome) -> str:
    """Return a line with its output, in the form of tests/corpus/outputs.txt."""
    files = [("> ", f"{name}\n{content.decode(errors='replace')}") for name, content in outcome.files.items()]
    printed = [f"$ {line.typed}"]
    for mark, text in [("  ", outcome.out), ("! ", outcome.err), *files]:
        printed += [f"{mark}{piece}".rstrip() for piece in text.splitlines()]
    return rounded("\n".join(printed) + "\n")


def outputs() -> Mapping[str, str]:
    """Return the outputs that a person has read, by typed line."""
    blocks = re.split(r"^(?=\$ )", OUTPUTS.read_text(encoding="utf-8"), flags=re.MULTILINE)
    return {block.partition("\n")[0].removeprefix("$ "): block for block in blocks if block}


def write_outputs(count: int | None) -> int:
    """Renew the kept outputs, or replace them by those of about `count` lines; return their number.

    Outputs that are long, differ between runs or are not text are left out.
    """
    runnable = [line for line in lines() if line.can_run]
    chosen = [line for line in runnable if line.typed in outputs()] if count is None else spread(runnable, count)
    kept = []
    with among_input_files():
        for line in chosen:
            first, second = output(line, run(line)), output(line, run(line))
            is_text = "\N{REPLACEMENT CHARACTER}" not in first
            if first == second and is_text and first.count("\n") <= LONGEST:
                kept.append(first)
    OUTPUTS.write_text("".join(kept), encoding="utf-8")
    return len(kept)
