"""Run a program on a pseudo-terminal."""

import os
import pty
import re
import shlex
import sys

TERMINAL = {"COLUMNS": "80", "LINES": "40", "TERM": "xterm-256color", "FORCE_COLOR": "1"}


def on_terminal(words: list[str], **environment: str) -> tuple[int, str]:
    """Run a program on its own terminal; return its exit code and its output."""
    settings = {name: value for name, value in os.environ.items() if name not in ("COLUMNS", "NO_COLOR", "FORCE_COLOR")}
    process, terminal = pty.fork()
    if process == 0:
        os.execvpe(words[0], words, settings | environment)
    shown = b""
    while piece := _read(terminal):
        shown += piece
    os.close(terminal)
    return os.waitstatus_to_exitcode(os.waitpid(process, 0)[1]), shown.decode("utf-8", "replace")


def _read(terminal: int) -> bytes:
    """Return the next output of a terminal; nothing after the program's end."""
    try:
        return os.read(terminal, 65536)
    except OSError:
        return b""


def script(line: str, columns: int = 80) -> tuple[str, int]:
    """Return the output of jkroll on a terminal, and its exit code."""
    settings = {**TERMINAL, "COLUMNS": str(columns)}
    code, shown = on_terminal([sys.executable, "-m", "jkroll", *shlex.split(line)], **settings)
    return shown.replace("\r\n", "\n"), code


def without_colours(text: str) -> str:
    """Return a text without the codes of colours."""
    return re.sub(r"\x1b\[[\d;]*m", "", text)
