"""Tools to run the command line in this process: streams in memory, and the result of a call."""

import io
from collections.abc import Callable
from typing import BinaryIO, NamedTuple


class Ran(NamedTuple):
    """Exit code and streams of a call."""

    code: int
    out: str
    err: str


class Stream(io.TextIOWrapper):
    """A text stream, in memory or into a file, that says of itself whether it is a terminal."""

    def __init__(self, file: BinaryIO | None = None, *, terminal: bool = False, encoding: str = "utf-8") -> None:
        super().__init__(file or io.BytesIO(), encoding=encoding, newline="")
        self.terminal = terminal

    def isatty(self) -> bool:
        """Return whether the stream is to be taken for a terminal."""
        return self.terminal

    def text(self) -> str:
        """Return all that was written into memory."""
        self.flush()
        buffer = self.buffer
        assert isinstance(buffer, io.BytesIO)
        return buffer.getvalue().decode(self.encoding)


Run = Callable[..., Ran]
