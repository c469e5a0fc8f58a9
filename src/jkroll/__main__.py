"""The `jkroll` script, and `python -m jkroll`. It imports as late as it can, so that an interrupt is always met."""

import os
import sys

INTERRUPTED = 130
CANNOT_WRITE = 1


def run() -> None:
    """Run the command line and exit with its code; an interrupt ends it silently, whatever it meets."""
    os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")  # what needs numpy multiplies no matrices: no thread a core
    try:
        from signal import SIGINT, signal

        def unwind(*_: object) -> None:
            """Let what runs put away what it has begun; a second interrupt ends it at once."""
            signal(SIGINT, _end)
            raise KeyboardInterrupt

        signal(SIGINT, unwind)
        sys.unraisablehook = _end_if_interrupted
        from .cli.process import main

        code = main()
        for stream in filter(None, (sys.stdout, sys.stderr)):
            try:
                stream.flush()
            except OSError:
                code = code or CANNOT_WRITE
        signal(SIGINT, _end)
    except KeyboardInterrupt:
        code = INTERRUPTED
    # All is written. To take the interpreter down piece by piece would cost a tenth of a call, and could be interrupted.
    os._exit(code)


def _end(*_: object) -> None:
    os._exit(INTERRUPTED)


def _end_if_interrupted(unraisable: "sys.UnraisableHookArgs") -> None:
    """An interrupt that came in a callback, out of which nothing can be raised, would be lost."""
    if unraisable.exc_type is KeyboardInterrupt:
        _end()
    sys.__unraisablehook__(unraisable)


if __name__ == "__main__":
    run()
