"""The entry point of `jkroll` and `python -m jkroll`. An interrupt ends the process silently, even during imports."""

import gc
import os
import sys
from collections.abc import Callable

SELDOM = 50_000  # new objects between garbage collections; imports leave hardly any garbage


def run() -> None:
    """Run the command line and exit with its code.

    An interrupt ends the process by the signal's default action; `whole_file` first removes an unfinished file.
    """
    gc.set_threshold(SELDOM)
    import signal

    signal.signal(signal.SIGINT, signal.SIG_DFL)
    os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")  # matrices are small, so threads are useless
    code = _main()()
    from .errors import FAILED

    for stream in filter(None, (sys.stdout, sys.stderr)):
        try:
            stream.flush()
        except OSError:
            code = code or FAILED
    os._exit(code)  # all output is written, and an orderly shutdown would take a tenth of the time of a call


def _main() -> Callable[[], int]:
    """Return the function for this call: to complete a word, install or show completion, or run a command."""
    if asked := os.environ.get("_JKROLL_COMPLETE"):
        from .cli import completion

        if completion.is_asked_by(asked):
            return completion.main
    if asked or sys.argv[1:] in (["--install-completion"], ["--show-completion"]):
        from .cli.shells import main
    else:
        from .cli.process import main
    return main


if __name__ == "__main__":
    run()
