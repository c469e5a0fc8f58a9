"""The command line as a process: arguments to a call, streams, signals and errors to an exit code and one line.

Words that are plainly a command, arguments and known options are read here, and so is a plain line to be completed; everything
else (mistakes, quotes on TAB, the installation of completion) is left to typer, which is imported only then. Both readers are
made from `options`.
"""

import errno
import io
import os
import sys
from collections.abc import Iterable, Sequence
from typing import Any

from ..errors import JkrollError
from ..text import quoted, say, shown
from .calls import Call
from .reader import COMPLETE, quick_call, with_minus_signs

USAGE_ERROR = 2
CANNOT_WRITE = 1
UNFORESEEN = 1
INTERRUPTED = 130
BROKEN_PIPE = 141


class Impossible(JkrollError):
    """A word that no shell can hand over."""

    def __init__(self, word: str) -> None:
        super().__init__(word)
        self.word = word

    def __str__(self) -> str:
        return f"{quoted(self.word)} has a character in it that no word has"


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the command line and return its exit code; print an error as one line."""
    words = list(sys.argv[1:] if arguments is None else arguments)
    debug = "--debug" in words[:1] + words[-1:]
    words = [word for place, word in enumerate(words) if not (word == "--debug" and place in (0, len(words) - 1))]
    words = with_minus_signs(words) or ["--help"]
    if sys.stderr is None:
        sys.stderr = open(os.devnull, "w", encoding="utf-8")  # it was closed: nobody listens
    try:
        if sys.stdout is None:
            raise OSError(errno.EBADF, os.strerror(errno.EBADF))
        for stream in (sys.stdout, sys.stderr):
            if isinstance(stream, io.TextIOWrapper):
                stream.reconfigure(errors="jkroll-ascii")
        _check(words)
        code = (quick_call(words) or _typers_call(words))()
        sys.stdout.flush()
        return code
    except SystemExit as stop:  # typer's: of completions with 0, of a closed pipe or an unknown shell with 1
        _forget(sys.stdout)
        return _code_of(stop)
    except BrokenPipeError:
        _forget(sys.stdout)
        return BROKEN_PIPE
    except KeyboardInterrupt:
        return INTERRUPTED
    except Exception as error:
        if isinstance(error.__cause__, KeyboardInterrupt):  # as typer passes it on
            return INTERRUPTED
        if debug:
            import traceback

            traceback.print_exc()
        return _report(error)


def _check(words: Iterable[str]) -> None:
    """Refuse what is neither text nor bytes of the system's: as the name of a file it would break the system's calls."""
    for word in words:
        try:
            is_possible = b"\0" not in word.encode("utf-8", "surrogateescape")
        except UnicodeEncodeError:
            is_possible = False
        if not is_possible:
            raise Impossible(word)


def _typers_call(words: list[str]) -> Call:
    """What typer makes of the words: a call, or help or completions printed already."""
    from .typer_app import build

    made = build(_command_of(words))(words, prog_name="jkroll", standalone_mode=False)
    return made if callable(made) else lambda: int(made or 0)


def _report(error: Exception) -> int:
    """Print an error as one line on stderr, and return the exit code."""
    if isinstance(error, JkrollError):
        message, code = str(error), error.exit_code
    elif isinstance(error, OSError):
        message, code = f"cannot write: {error.strerror or error}", CANNOT_WRITE
        _forget(sys.stdout)
    elif hasattr(error, "format_message"):  # typer's
        message, code = shown(" ".join(error.format_message().split()), limit=1000), USAGE_ERROR
    else:
        message = f"{type(error).__name__}: {shown(str(error))}; jkroll should have foreseen this: --debug shows where"
        code = UNFORESEEN
    try:
        say(f"jkroll: {message}", sys.stderr)
    except OSError:
        _forget(sys.stderr)
    return code


def _code_of(stop: SystemExit) -> int:
    """The exit code where typer ends the program."""
    if isinstance(stop.__context__, OSError):
        return BROKEN_PIPE
    if os.environ.get(COMPLETE) == "complete_fish" and isinstance(stop.code, int):
        return stop.code  # whether fish is to offer what it asked for
    return USAGE_ERROR if stop.code else 0


def _forget(stream: Any) -> None:
    """Keep the interpreter from writing once more what could not be written."""
    try:
        with open(os.devnull, "wb") as nothing:
            os.dup2(nothing.fileno(), stream.fileno())
    except (OSError, ValueError, AttributeError):  # it was closed from the start, or it is no file
        pass


def _command_of(words: Sequence[str]) -> str | None:
    """The command that an argument list, or a completion request in the environment, is about."""
    if os.environ.get(COMPLETE):
        words = os.environ.get("COMP_WORDS", os.environ.get("_TYPER_COMPLETE_ARGS", "")).split()[1:]
    return next((word for word in words if not word.startswith("-")), None)
