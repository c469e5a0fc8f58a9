"""Run a program on a pseudo-terminal."""

import os
import pty


def on_terminal(words: list[str], **environment: str) -> tuple[int, str]:
    """Run a program on a terminal of its own; return its exit code and its output."""
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
    """Return the next output of a terminal; nothing when the program has ended."""
    try:
        return os.read(terminal, 65536)
    except OSError:
        return b""
