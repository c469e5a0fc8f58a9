"""Runners of `verify` and `bench`."""

import sys
from typing import TYPE_CHECKING

from ..errors import BadRequest, missing_extra
from .options import Call
from .question import PICTURES, ending, format_name, no_picture

if TYPE_CHECKING:
    from ..bench.report import Plot


def run_verify(call: Call) -> int:
    """Compute the audit of the paper; return 1 if a verdict is not the expected one."""
    from ..audit.verify import write_verification

    return write_verification(sys.stdout, format_name(call))


def run_bench(call: Call) -> int:
    """Measure speed against error; return the exit code."""
    plot = _plot(call)
    from ..bench.report import write_bench

    return write_bench(sys.stdout, format_name(call), quick=call.quick, plot=plot)


def _plot(call: Call) -> "Plot | None":
    """Return what is to be drawn, after whatever prevents it was reported: before anything is measured."""
    if call.plot is None:
        looks = {"--width": call.width, "--style": call.style, "--no-caption": call.uncaptioned}
        if given := [flag for flag, value in looks.items() if value]:
            raise BadRequest(f"{', '.join(given)}: for a file only; name one with --plot")
        return None
    if ending(call.plot) not in PICTURES:
        raise no_picture("--plot", call.plot)
    from .map import check_look, inches_of

    check_look(call)
    with missing_extra("plot"):
        from ..pictures import page  # noqa: F401
    from ..bench.report import Plot

    return Plot(call.plot, inches_of(call.width), call.style or "paper", has_caption=not call.uncaptioned)
