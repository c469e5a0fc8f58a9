"""From a command, its words and its option values to the call that answers it."""

import sys
from collections.abc import Callable, Sequence
from functools import partial
from typing import Any

from ..answers.questions import COMMANDS
from ..text import say

Call = Callable[[], int]


def _show_help(name: str | None) -> int:
    """Print the help of a command, or of the program."""
    from .help import help_of

    say(help_of(name), sys.stdout)
    return 0


def _show_version() -> int:
    """Print the version."""
    from .. import __version__

    say(f"jkroll {__version__}", sys.stdout)
    return 0


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
    if (
        name in ("map", "figure")
        or {"width", "style", "uncaptioned", "panel"} & given.keys()
        or (output.curve and output.target)
    ):
        from .draw import RUNNERS, Target

        target = Target(output.target, **{key: given.pop(key) for key in Target._fields if key in given})
        return partial(RUNNERS[name], arguments, given, output, target)
    return partial(run_command, COMMANDS[name], arguments, given, output)
