"""Runner of `contact`: its question, or the force curve, as rows or drawn."""

import sys

from ..answers.answer import in_units
from ..answers.curve import CURVE, curve, states
from ..errors import BadRequest
from ..output.layout import layout
from ..output.writers import WRITERS
from .options import Call
from .question import Tally, checked, run_question
from .request import curve_request


def run_contact(call: Call) -> int:
    """Answer the question of the command, or write or draw the force curve; return the exit code."""
    is_drawn = call.curve and call.target is not None
    if is_drawn or call.width is not None or call.style is not None or call.uncaptioned or call.panel:
        from .draw import draw_contact

        return draw_contact(call)
    return _write_curve(call) if call.curve else run_question(call)


def _write_curve(call: Call) -> int:
    """Write the force curve of every scene; return the exit code."""
    _, kind, form = checked(call)
    if kind in ("explain", "cite"):
        raise BadRequest(f"--curve and --{kind} exclude each other")
    request, loads = curve_request(call)
    samples = [row for _, row in curve(request.samples(), loads)]
    if samples[0].failure is not None and all(row.failure is not None for row in samples):
        raise samples[0].failure
    count = sum(len(states(scene, loads)) for scene in request.scenes())
    tally = Tally()
    rows = tally.watch(in_units(row, form) for _, row in curve(request.scenes(), loads))
    WRITERS[kind](rows, sys.stdout, form, layout(CURVE, samples, count))
    sys.stdout.flush()
    return tally.exit_code(count)
