"""Script `jkroll` and `python -m jkroll`. Imports come late, so that an interrupt during them is handled."""

import gc
import os
import sys

TYPE_CHECKING = False  # the module typing is for those who read types
if TYPE_CHECKING:
    from types import FrameType

INTERRUPTED = 130
CANNOT_WRITE = 1
PAUSE = 0.01  # seconds until an interrupt that came in an import is tried again
SELDOM = 50_000  # new objects until the next search for cycles: what imports make is no garbage


def run() -> None:
    """Run the command line and exit with its code; an interrupt exits silently with 130 and puts away what was begun.

    The same is put away where the process is told to end, or its terminal is closed, which then end it as usual.
    """
    ended_by = 0
    gc.set_threshold(SELDOM)
    os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")  # no matrices are multiplied: no thread for each core
    try:
        import signal

        def stop(number: int, frame: "FrameType | None") -> None:
            """Raise KeyboardInterrupt, not amid an import, where a library may crash; the next signal ends all."""
            nonlocal ended_by
            if _is_importing(frame) and hasattr(signal, "setitimer"):  # not on Windows
                signal.signal(signal.SIGALRM, lambda _, later: stop(number, later))
                signal.setitimer(signal.ITIMER_REAL, PAUSE)
                return
            ended_by = number
            for each in signals:
                signal.signal(each, signal.SIG_DFL)
            raise KeyboardInterrupt

        signals = [signal.SIGINT, signal.SIGTERM]
        if hasattr(signal, "SIGHUP") and signal.getsignal(signal.SIGHUP) == signal.SIG_DFL:  # not under nohup
            signals.append(signal.SIGHUP)
        for each in signals:
            signal.signal(each, stop)
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
    except KeyboardInterrupt:
        code = INTERRUPTED
    if ended_by and ended_by != signal.SIGINT:  # now, as whoever sent the signal expects
        signal.raise_signal(ended_by)
    # Everything is written. An orderly shutdown of the interpreter would take a tenth of a call, and could be
    # interrupted.
    os._exit(code)


def _is_importing(frame: "FrameType | None") -> bool:
    while frame is not None and frame.f_code.co_filename != "<frozen importlib._bootstrap>":
        frame = frame.f_back
    return frame is not None


def _end_if_interrupted(unraisable: "sys.UnraisableHookArgs") -> None:
    """End the run where an interrupt came in a callback, as an import has them, from which Python cannot raise it."""
    if unraisable.exc_type is KeyboardInterrupt:
        os._exit(INTERRUPTED)
    sys.__unraisablehook__(unraisable)


if __name__ == "__main__":
    run()
