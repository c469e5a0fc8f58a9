"""The program in a browser: a line that was typed in, what it prints and its exit code out. Runs in Pyodide."""

import importlib
import io
import os
import shlex
import sys
from collections.abc import Sequence
from importlib.abc import MetaPathFinder
from typing import Any

WIDTH = "80"
FILES = {"-o", "--output", "--plot", "--data", "--materials", "--resume"}
LIBRARIES = {"numpy", "pint", "matplotlib", "pyarrow", "typer"}
WITH_PYODIDE = {"numpy"}  # beside Pyodide on this site; it comes when a line needs it
INSTALL = "the manual, linked below, says how to install jkroll"


class Terminal(io.StringIO):
    """What a command prints, as on a terminal."""

    encoding = "utf-8"

    def isatty(self) -> bool:
        """Return True: answers are tables with colours."""
        return True


class Absent(MetaPathFinder):
    """The last finder of modules: it finds nothing, and remembers which libraries were looked for."""

    def __init__(self) -> None:
        self.names: set[str] = set()

    def find_spec(self, name: str, *_: Any) -> None:
        """Remember a library that no other finder has found."""
        if name in LIBRARIES:
            self.names.add(name)


_absent = Absent()


def begin() -> None:
    """Set up the streams' width and colours, and the finder."""
    os.environ.update(COLUMNS=WIDTH, LINES="40", TERM="xterm-256color", FORCE_COLOR="1")
    sys.meta_path.append(_absent)


def run(line: str) -> dict[str, Any]:
    """Run a line; return its text with ANSI colours, its exit code, and the missing libraries that can be loaded."""
    try:
        words = shlex.split(line)
    except ValueError as error:
        return {"text": f"jkroll: {error}\n", "code": 2, "missing": []}
    if words[:1] == ["jkroll"]:
        words = words[1:]
    if needed := needs_files(words):
        return lacking(f"{needed} needs files", [])
    from jkroll.cli.process import main

    _absent.names.clear()
    importlib.invalidate_caches()  # a library may have come since
    kept, terminal = (sys.stdout, sys.stderr), Terminal()
    sys.stdout = sys.stderr = terminal
    try:
        code = main(words)
    finally:
        sys.stdout, sys.stderr = kept
    if missing := sorted(_absent.names):
        return lacking(f"this line needs {', '.join(missing)}", [name for name in missing if name in WITH_PYODIDE])
    return {"text": terminal.getvalue(), "code": code, "missing": []}


def lacking(reason: str, missing: Sequence[str]) -> dict[str, Any]:
    """Return the answer to a line that needs what is not here, with the libraries that can be loaded for it."""
    return {"text": f"jkroll: {reason}, which this page lacks;\n{INSTALL}\n", "code": 1, "missing": [*missing]}


def needs_files(words: Sequence[str]) -> str:
    """Return the word that needs files, or an empty text."""
    if words[:1] == ["batch"]:
        return "batch"
    return next((word for word in words if word.partition("=")[0] in FILES), "")


def candidates(line: str) -> list[str]:
    """Return the words that may stand in place of the last one of a line, as the shell's completion has them."""
    from jkroll.cli.completion import candidates as candidates_for

    *before, begun = line.split(" ")
    words = [word for word in before if word and word != "jkroll"]
    return [word for word, _ in candidates_for(words, begun) if word != begun][:30]
