"""Runner of `contact`: its question, or the force curve, as rows or drawn."""

import sys
from itertools import islice

from ..answers.curve import curve, states, wanted_of_curve
from ..errors import BadRequest
from ..output import notes as note_lines
from ..output.records import in_units
from ..rows.columns import Columns
from .commands import Call
from .question import MAX_TABLE, check_count, checked, exit_code, run_question, write_answers, write_columns
from .request import curve_request

BLOCK = 500  # rows of a curve that are computed before they are written


def run_contact(call: Call) -> int:
    """Answer the question of the command, or write or draw the force curve; return the exit code."""
    is_drawn = call.curve and call.target is not None
    if is_drawn or call.width is not None or call.style is not None or call.uncaptioned or call.panel:
        from .map import draw_contact

        return draw_contact(call)
    return _write_curve(call) if call.curve else run_question(call)


def _write_curve(call: Call) -> int:
    """Write the force curve of every scene; return the exit code."""
    _, kind, form = checked(call)
    if kind in ("explain", "cite"):
        raise BadRequest(f"--curve and --{kind} exclude each other")
    request, loads = curve_request(call)
    check_count(request.count, "curve")
    samples = [*curve(request.sweep.kinds, loads)]
    if (failure := samples[0].failure) is not None and all(one.failure is not None for one in samples):
        raise failure
    answers = curve(request.scenes(), loads)
    if kind == "json":
        count = sum(len(states(scene, loads)) for scene in request.scenes())
        return write_answers(answers, count, kind, form, sys.stdout, quiet=call.quiet)
    wanted = wanted_of_curve(samples, is_bare=kind == "bare")
    size = MAX_TABLE if kind == "table" else BLOCK
    blocks = iter(lambda: [one.row(wanted) for one in islice(answers, size)], [])
    notes = note_lines.OfRows()
    columns = (in_units(Columns.of_rows(wanted, rows), form) for rows in blocks)
    write_columns(wanted, notes.watch(columns), kind, form, call)
    return exit_code(notes, notes.count)
