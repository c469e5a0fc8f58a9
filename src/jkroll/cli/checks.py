"""Runners of `verify` and `bench`."""

import sys
from typing import TYPE_CHECKING

from .commands import Call
from .question import format_name

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
    from .map import check_picture, inches_of

    check_picture(call, call.plot, "--plot", numbers="--csv > FILE")
    if call.plot is None:
        return None
    from ..bench.report import Plot

    return Plot(call.plot, inches_of(call.width), call.style or "paper", has_caption=not call.uncaptioned)
