"""Run typed lines in a browser, in Pyodide, and return their output and exit codes."""

import importlib
import io
import os
import shlex
import sys
from importlib.abc import MetaPathFinder
from pathlib import Path
from typing import Any

WIDTH = "80"
LIBRARIES = {"numpy", "pint", "matplotlib", "pyarrow", "typer"}
WITH_PYODIDE = {"numpy"}  # on this site next to Pyodide; loaded when a line needs it
INSTALL = "the manual, linked below, says how to install jkroll"


class Terminal(io.StringIO):
    """The output of a command, as on a terminal."""

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
    """Run a line; return its text with ANSI colours, its exit code, the files written, and libraries to load for it."""
    try:
        words = shlex.split(line)
    except ValueError as error:
        return {"text": f"jkroll: {error}\n", "code": 2, "written": [], "missing": []}
    if words[:1] == ["jkroll"]:
        words = words[1:]
    from jkroll.cli.process import main

    _absent.names.clear()
    importlib.invalidate_caches()  # a library may have been loaded since the last line
    kept, terminal, before = (sys.stdout, sys.stderr), Terminal(), files()
    sys.stdout = sys.stderr = terminal
    try:
        code = main(words)
    finally:
        sys.stdout, sys.stderr = kept
    if missing := sorted(_absent.names):
        text = f"jkroll: this line needs {', '.join(missing)}, which this page lacks;\n{INSTALL}\n"
        loadable = [name for name in missing if name in WITH_PYODIDE]
        return {"text": text, "code": 1, "written": [], "missing": loadable}
    written = [name for name, state in files().items() if before.get(name) != state]
    return {"text": terminal.getvalue(), "code": code, "written": written, "missing": []}


def files() -> dict[str, tuple[int, int]]:
    """Return the files in the folder of the prompt by name, with times and sizes: the user's, and those written."""
    found = ((path.name, path.stat()) for path in Path().iterdir() if path.is_file())
    return {name: (state.st_mtime_ns, state.st_size) for name, state in sorted(found)}


def candidates(line: str) -> list[str]:
    """Return the completions of the last word of a line, as in a shell: words or, if there are none, files."""
    from jkroll.cli.completion import candidates as candidates_for

    *before, begun = line.split(" ")
    words = [word for word in before if word and word != "jkroll"]
    found = [word for word, _ in candidates_for(words, begun)] or [name for name in files() if name.startswith(begun)]
    return [word for word in found if word != begun][:30]
