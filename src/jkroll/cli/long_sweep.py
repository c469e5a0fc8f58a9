"""Sweeps of any length, computed by blocks and written to a file, or as CSV to a pipe."""

import sys

from ..answers.answer import answer
from ..answers.questions import Question
from ..batch.settings import Settings
from ..batch.sweep import Sweep, stream
from ..errors import ROWS_FAILED, BadRequest
from ..output.layout import layout
from ..output.note_lines import NoteLines
from ..text import quoted, say, say_wrapped
from .options import Call
from .request import Request
from .written import PICTURES, ending


def write_sweep(question: Question, request: Request, kind: str, call: Call) -> int:
    """Write a row for each scene, without the limits of what is kept in memory; return the exit code."""
    if call.target and ending(call.target) in PICTURES:
        raise BadRequest(f"-o: {quoted(call.target)} is a picture; add --curve to contact, or see jkroll map --help")
    if call.to or call.digits or kind not in ("csv", "plain", "table"):
        remedy = "; for other output write > FILE" if call.target else ""
        raise BadRequest(f"-o and long ranges write CSV in SI units with all digits, and take --csv alone{remedy}")
    samples = [answer(question, scene) for scene in request.samples()]
    shape = layout(question, samples, request.count)
    sweep = Sweep(request.pairs, request.spreads, request.models, shape, request.materials)
    tally = stream(sweep, Settings(target=call.target or "-", resume=call.resume, quiet=call.quiet))
    if not call.quiet:
        notes = NoteLines()
        for one in samples:
            notes.add(one)
        for line in notes.lines(with_rows=False):
            say_wrapped(line, sys.stderr)
    if tally.failed:
        say(f"jkroll: {tally.failed} of {tally.rows} rows failed", sys.stderr)
        return ROWS_FAILED
    return 0
