"""Runners of `verify` and `bench`."""

import sys

from ..errors import MissingExtra
from .options import Call
from .question import PICTURES, ending, format_name, no_picture


def run_verify(call: Call) -> int:
    """Compute the audit of the paper; return 1 if a verdict is not the expected one."""
    from ..audit.verify import write_verification

    return write_verification(sys.stdout, format_name(call))


def run_bench(call: Call) -> int:
    """Measure speed against error; return the exit code."""
    from ..bench.report import write_bench

    if call.plot is not None and ending(call.plot) not in PICTURES:
        raise no_picture("--plot", call.plot)
    try:
        return write_bench(sys.stdout, format_name(call), quick=call.quick, plot=call.plot)
    except ModuleNotFoundError as error:
        raise MissingExtra(error.name or "", "plot" if call.plot else "bench") from None
