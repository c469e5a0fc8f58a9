"""The command line as a process: arguments to an exit code, with the streams, and an error as one line."""

import errno
import io
import os
import sys
from collections.abc import Callable, Iterable, Sequence
from typing import TextIO

from ..errors import BadRequest, JkrollError
from ..text import quoted, say_wrapped, shown
from .commands import DEBUG, Action
from .reader import read

CANNOT_WRITE = 1
UNFORESEEN = 1
BROKEN_PIPE = 141


def main(arguments: Sequence[str] | None = None, read: Callable[[Sequence[str]], Action] = read) -> int:
    """Run what a command line is read as and return the exit code; print an error as one line."""
    words = list(sys.argv[1:] if arguments is None else arguments)
    is_debugged = DEBUG.flag in words
    words = [word for word in words if word != DEBUG.flag]
    if sys.stderr is None:
        sys.stderr = open(os.devnull, "w", encoding="utf-8")  # it was closed: nobody listens
    try:
        if sys.stdout is None:
            raise OSError(errno.EBADF, os.strerror(errno.EBADF))
        for stream in (sys.stdout, sys.stderr):
            if isinstance(stream, io.TextIOWrapper):
                stream.reconfigure(errors="jkroll-ascii")
        _check(words)
        code = read(words)()
        sys.stdout.flush()
        return code
    except BrokenPipeError:
        _discard(sys.stdout)
        return BROKEN_PIPE
    except Exception as error:
        if is_debugged:
            import traceback

            traceback.print_exc()
        return _report(error, words)


def _check(words: Iterable[str]) -> None:
    """Refuse words that no shell can pass on, since no file can have them as its name."""
    for word in words:
        if "\0" in word:
            raise BadRequest(f"{quoted(word)} contains a NUL character")
        try:
            word.encode("utf-8", "surrogateescape")
        except UnicodeEncodeError:
            raise BadRequest(f"{quoted(word)} contains half a character (a lone surrogate)") from None


def _report(error: Exception, words: Sequence[str]) -> int:
    """Print an error on stderr, in one line unless a terminal is narrower; return the exit code. `words`: as typed."""
    if isinstance(error, JkrollError):
        from .call import worded

        typed = [word.partition("=")[0] for word in words]
        message, code = worded(error, typed[0] if typed else "", typed), error.exit_code
    elif isinstance(error, MemoryError):
        message, code = "there is not enough memory; ask for fewer rows or points", CANNOT_WRITE
    elif isinstance(error, OSError):
        file = f" {quoted(str(error.filename))}" if error.filename else ""
        message, code = f"cannot write{file}: {error.strerror or error}", CANNOT_WRITE
        _discard(sys.stdout)
    else:
        message = (
            f"{type(error).__name__}: {shown(str(error))}; this is a bug in jkroll: run it with {DEBUG.flag} to see "
            "where"
        )
        code = UNFORESEEN
    try:
        say_wrapped(f"jkroll: {message}", sys.stderr)
    except OSError:
        _discard(sys.stderr)
    return code


def _discard(stream: TextIO) -> None:
    """Send what a stream still holds nowhere, so that the interpreter does not fail to write it once more."""
    try:
        with open(os.devnull, "wb") as nothing:
            os.dup2(nothing.fileno(), stream.fileno())
    except (OSError, ValueError, AttributeError):  # it was closed from the start, or it is no file
        pass
