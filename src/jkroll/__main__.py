"""The `jkroll` script, and `python -m jkroll`. It imports as late as it can, so that an interrupt is always met."""

import os
import sys

INTERRUPTED = 130


def run() -> None:
    """Run the command line and exit with its code; an interrupt ends it silently, whatever it meets."""
    try:
        from signal import SIGINT, signal

        def unwind(*_: object) -> None:
            """Let what runs put away what it has begun; a second interrupt ends it at once."""
            signal(SIGINT, _end)
            raise KeyboardInterrupt

        signal(SIGINT, unwind)
        sys.unraisablehook = _end_if_interrupted
        from .shell import main

        code = main()
        signal(SIGINT, _end)
    except KeyboardInterrupt:
        code = INTERRUPTED
    sys.exit(code)


def _end(*_: object) -> None:
    os._exit(INTERRUPTED)


def _end_if_interrupted(unraisable: "sys.UnraisableHookArgs") -> None:
    """An interrupt that came in a callback, out of which nothing can be raised, would be lost."""
    if unraisable.exc_type is KeyboardInterrupt:
        _end()
    sys.__unraisablehook__(unraisable)


if __name__ == "__main__":
    run()
