"""The `jkroll` script, and `python -m jkroll`. It imports as late as it can, so that an interrupt is always met."""

import sys


def run() -> None:
    """Run the command line and exit with its code."""
    try:
        from .shell import main

        code = main()
    except KeyboardInterrupt:
        code = 130
    sys.exit(code)


if __name__ == "__main__":
    run()
