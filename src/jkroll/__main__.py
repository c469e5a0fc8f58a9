"""Script `jkroll` and `python -m jkroll`. Imports come late, so that an interrupt during them is handled."""

import gc
import os
import sys

TYPE_CHECKING = False  # the module typing is for those who read types
if TYPE_CHECKING:
    from types import FrameType

INTERRUPTED = 130
CANNOT_WRITE = 1
PATIENCE = 5  # seconds until an interrupt ends all: now and then a library drops what is raised in the midst of it
PAUSE = 0.01  # seconds until an interrupt that came in an import is tried again
SELDOM = 50_000  # new objects until the next search for cycles: what imports make is no garbage


def run() -> None:
    """Run the command line and exit with its code; an interrupt exits silently with 130; what else ends it puts files away first."""
    ended_by = 0  # the signal, if it is no interrupt
    os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")  # no matrices are multiplied: no thread for each core
    try:
        import signal

        ending = [signal.SIGTERM]
        if hasattr(signal, "SIGHUP") and signal.getsignal(signal.SIGHUP) == signal.SIG_DFL:  # not under nohup
            ending.append(signal.SIGHUP)  # of a terminal that was closed

        def unwind(number: int, frame: "FrameType | None") -> None:
            """Raise KeyboardInterrupt once, so that files are put away; the next interrupt, or an alarm, exits at once.

            It waits for the end of an import: a library that is interrupted in the midst of its own may crash.
            """
            nonlocal ended_by
            ended_by = ended_by or (number if number in ending else 0)
            signal.signal(signal.SIGINT, _end)
            for one in ending:
                signal.signal(one, signal.SIG_DFL)
            if hasattr(signal, "alarm"):  # not on Windows
                if _is_importing(frame):
                    signal.signal(signal.SIGALRM, unwind)
                    signal.setitimer(signal.ITIMER_REAL, PAUSE)
                    return
                signal.signal(signal.SIGALRM, _end)
                signal.alarm(PATIENCE)
            raise KeyboardInterrupt

        signal.signal(signal.SIGINT, unwind)
        for one in ending:
            signal.signal(one, unwind)
        gc.set_threshold(SELDOM)
        sys.unraisablehook = _end_if_interrupted
        if os.environ.get("_JKROLL_COMPLETE") or sys.argv[1:] in (["--install-completion"], ["--show-completion"]):
            from .cli.shells import main
        else:
            from .cli.process import main

        code = main()
        for stream in filter(None, (sys.stdout, sys.stderr)):
            try:
                stream.flush()
            except OSError:
                code = code or CANNOT_WRITE
        signal.signal(signal.SIGINT, _end)
    except KeyboardInterrupt:
        code = INTERRUPTED
    if ended_by:  # now, as whoever sent the signal expects
        signal.raise_signal(ended_by)
    # Everything is written. An orderly shutdown of the interpreter would take a tenth of a call, and could be interrupted.
    os._exit(code)


def _is_importing(frame: "FrameType | None") -> bool:
    while frame is not None and frame.f_code.co_filename != "<frozen importlib._bootstrap>":
        frame = frame.f_back
    return frame is not None


def _end(*_: object) -> None:
    os._exit(INTERRUPTED)


def _end_if_interrupted(unraisable: "sys.UnraisableHookArgs") -> None:
    """Exit if an interrupt came in a callback, from which Python cannot raise it."""
    if unraisable.exc_type is KeyboardInterrupt:
        _end()
    sys.__unraisablehook__(unraisable)


if __name__ == "__main__":
    run()
