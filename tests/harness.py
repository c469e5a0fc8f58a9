"""Tools to run the command line in this process: streams in memory, and the outcome of a call."""

import io
import os
import tempfile
from collections.abc import Callable, Sequence
from contextlib import redirect_stderr, redirect_stdout, suppress
from typing import BinaryIO, NamedTuple

from jkroll.cli.process import main


class Ran(NamedTuple):
    """The exit code and the streams of a call."""

    code: int
    out: str
    err: str


class Stream(io.TextIOWrapper):
    """A text stream, in memory or into a file, that can pass for a terminal."""

    def __init__(self, file: BinaryIO | None = None, *, terminal: bool = False, encoding: str = "utf-8") -> None:
        super().__init__(file or io.BytesIO(), encoding=encoding, newline="")
        self.terminal = terminal

    def isatty(self) -> bool:
        """Return whether the stream passes for a terminal."""
        return self.terminal

    def text(self) -> str:
        """Return all text that was written into memory."""
        self.flush()
        buffer = self.buffer
        assert isinstance(buffer, io.BytesIO)
        return buffer.getvalue().decode(self.encoding)


Run = Callable[..., Ran]


def captured(words: Sequence[str], *, terminal: bool = False) -> Ran:
    """Run a command line; its output goes to a file, since tables are written to the descriptor, not to the stream."""
    with tempfile.TemporaryFile() as file:
        err = Stream()
        out = Stream(os.fdopen(os.dup(file.fileno()), "wb"), terminal=terminal)
        with redirect_stdout(out), redirect_stderr(err):
            code = main([*words])
        with suppress(OSError):  # if the file system is full
            out.close()
        file.seek(0)
        return Ran(code, file.read().decode("utf-8", "surrogateescape"), err.text())
