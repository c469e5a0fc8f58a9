"""The `jkroll` script, and `python -m jkroll`. It imports as late as it can, so that an interrupt is always met."""

import os
import sys


def run() -> None:
    """Run the command line and exit with its code."""
    os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")  # what needs numpy multiplies no matrices: no thread a core
    try:
        from .shell import main

        code = main()
        for stream in filter(None, (sys.stdout, sys.stderr)):
            stream.flush()
    except KeyboardInterrupt:
        code = 130
    except OSError:
        code = 1
    # All is written. To take the interpreter down piece by piece would cost a tenth of a call, and could be interrupted.
    os._exit(code)


if __name__ == "__main__":
    run()
