"""The command line as a process: arguments to a call, streams, signals and errors to an exit code and one line.

Words that are plainly a command, arguments and known options are read here; everything else (help, completion, mistakes)
is left to typer, which is imported only then. Both readers are made from `options`.
"""

import errno
import io
import os
import re
import sys
from collections.abc import Callable, Sequence
from functools import partial
from typing import Any

from .commands import COMMANDS
from .errors import JkrollError, quoted
from .options import EXTRAS, options_of, read_quickly
from .streams import say

USAGE_ERROR = 2
CANNOT_WRITE = 1
INTERRUPTED = 130
BROKEN_PIPE = 141

Call = Callable[[], int]


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
        code = (quick_call(words) or _typers_call(words))()
        sys.stdout.flush()
        return code
    except SystemExit as stop:  # typer's: of completions with 0, of a closed pipe with 1
        _forget(sys.stdout)
        return BROKEN_PIPE if stop.code else 0
    except BrokenPipeError:
        _forget(sys.stdout)
        return BROKEN_PIPE
    except KeyboardInterrupt:
        return INTERRUPTED
    except Exception as error:
        if debug:
            import traceback

            traceback.print_exc()
        return _report(error)


def quick_call(words: list[str]) -> Call | None:
    """The call that plain words ask for; None for whatever typer had better look at."""
    name, *rest = words
    if "_JKROLL_COMPLETE" in os.environ or (name not in COMMANDS and name not in EXTRAS):
        return None
    options = options_of(COMMANDS[name]) if name in COMMANDS else EXTRAS[name].options
    read = read_quickly(rest, {flag: option for option in options for flag in option.flags})
    if read is None or (name in EXTRAS and len(read[0]) > len(EXTRAS[name].argument.split())):
        return None
    arguments, values = read
    return call(name, arguments, values)


def call(name: str, arguments: Sequence[str], values: dict[str, Any]) -> Call:
    """The call of a command with arguments and the values of its options by name; those not given are None or False."""
    from .run import Output, run_batch, run_bench, run_command, run_materials, run_verify

    given = {key: value for key, value in values.items() if value is not None and value is not False}
    output = Output(**{key: given.pop(key) for key in Output._fields if key in given})
    if name == "materials":
        return partial(run_materials, arguments[0] if arguments else None, output)
    if name == "batch":
        return partial(run_batch, arguments[0] if arguments else None, output, given)
    if name == "verify":
        return partial(run_verify, output)
    if name == "bench":
        return partial(run_bench, output, **given)
    return partial(run_command, COMMANDS[name], arguments, given, output)


def _typers_call(words: list[str]) -> Call:
    """What typer makes of the words: a call, or help or completions printed already."""
    from .cli import build

    made = build(_command_of(words))(words, prog_name="jkroll", standalone_mode=False)
    return made if callable(made) else lambda: int(made or 0)


def _report(error: Exception) -> int:
    """Print an error as one line on stderr, and return the exit code; raise what is none of those that are declared."""
    if isinstance(error, JkrollError):
        message, code = str(error), error.exit_code
    elif isinstance(error, OSError):
        message, code = f"cannot write: {error.strerror or error}", CANNOT_WRITE
        _forget(sys.stdout)
    elif hasattr(error, "format_message"):  # typer's
        message, code = quoted(" ".join(error.format_message().split()), limit=1000)[1:-1], USAGE_ERROR
    else:
        raise error
    try:
        say(f"jkroll: {message}", sys.stderr)
    except OSError:
        _forget(sys.stderr)
    return code


def _forget(stream: Any) -> None:
    """Keep the interpreter from writing once more what could not be written."""
    try:
        os.dup2(os.open(os.devnull, os.O_WRONLY), stream.fileno())
    except (OSError, ValueError):
        pass


def with_minus_signs(words: Sequence[str]) -> list[str]:
    """Negative values with a minus sign in place of the hyphen, so that they are not taken for options."""
    before = [None, *words][: len(words)]
    return [
        "−" + word[1:] if _NEGATIVE.match(word) and option not in _TAKES_NO_QUANTITY else word
        for option, word in zip(before, words, strict=True)
    ]


_NEGATIVE = re.compile(r"-[0-9.]")
_TAKES_NO_QUANTITY = ("--to", "--digits", "--materials")


def _command_of(words: Sequence[str]) -> str | None:
    """The command that an argument list, or a completion request in the environment, is about."""
    if os.environ.get("_JKROLL_COMPLETE"):
        words = os.environ.get("COMP_WORDS", os.environ.get("_TYPER_COMPLETE_ARGS", "")).split()[1:]
    return next((word for word in words if not word.startswith("-")), None)
