"""Runner of `infer`: from a measured value back to an input."""

import sys
from functools import partial

from ..answers.inferred import Inferred
from ..answers.questions import quantity_named
from ..errors import BadRequest
from ..output import notes as note_lines
from ..output.records import in_units
from ..quantities.formatting import Format
from ..quantities.nomenclature import named
from ..quantities.values import Spread, spreads_of
from ..rows.inferred import Sought, observed
from ..rows.sweep import Sweep
from ..scene.inverse import SIZES, AlreadyGiven, CannotInfer, with_input
from ..text import say_wrapped
from .options import Call
from .question import check_count, exit_code, format_name, format_of, unless_failed, write_answers, write_columns
from .request import request_of

TABLES = (".csv", ".tsv", ".ndjson", ".parquet", ".gz", ".zst")
MAX_ANSWERS = 10_000  # that are explained one by one


def run_infer(call: Call) -> int:
    """Find an input for every scene and measured value; return the exit code."""
    if not call.words:
        raise BadRequest(f"infer needs an input: one of {', '.join(SIZES)}")
    name = named(call.words[0])
    if name not in SIZES:
        raise CannotInfer(call.words[0])
    if tables := [word for word in call.words[1:] if word.endswith(TABLES)]:
        line = f"jkroll batch {tables[0]} --infer {call.words[0]} --measured {(call.measured or 'QUANTITY').partition('=')[0]}"
        raise BadRequest(f"infer reads no tables; write {line}")
    quantity, measured = _measured(call.measured)
    kind = format_name(call)
    form = format_of(call, [name])
    request = request_of(call._replace(words=call.words[1:]))
    if quantity in request.spreads:
        raise AlreadyGiven(quantity, quantity)
    sweep = Sweep(request.pairs, {**request.spreads, quantity: measured}, request.models, partial(observed, quantity))
    is_one = len(sweep) == 1 and kind in ("plain", "table")
    if is_one or kind in ("json", "explain", "cite"):
        check_count(len(sweep), kind, MAX_ANSWERS)
        answers = (Inferred(name, quantity, row.measured, row.scene) for row in sweep.scenes())
        shown = (one.explained for one in answers) if kind in ("explain", "cite") else answers
        return write_answers(shown, len(sweep), kind, form, sys.stdout, quiet=call.quiet)
    return _write_rows(name, quantity, sweep, kind, form, call)


def _write_rows(name: str, quantity: str, sweep: Sweep, kind: str, form: Format, call: Call) -> int:
    """Write a row for each scene and measured value; return the exit code."""
    wanted = Sought.of(name, quantity, sweep.kinds)
    if kind == "bare":
        wanted = Sought(name, quantity, doubts=not call.quiet)
    blocks = sweep.columns(wanted)
    if len(sweep) == 1:
        blocks = iter([unless_failed(next(blocks), [name])])
    notes = note_lines.OfRows()
    write_columns(wanted, notes.watch(in_units(columns, form) for columns in blocks), kind, form, call)
    if call.quiet:
        found = []
    elif len(sweep) == 1:
        (row,) = sweep.scenes()
        found = note_lines.of_answer(Inferred(name, quantity, row.measured, row.scene))
    else:
        kinds = [(with_input(row.scene, name, SIZES[name][1]), [quantity]) for row in sweep.kinds]
        found = notes.lines(sweep.pairs, kinds)
    for line in found:
        say_wrapped(line, sys.stderr)
    return exit_code(notes, len(sweep))


def _measured(text: str | None) -> tuple[str, list[Spread]]:
    """Read the measured quantity and its values."""
    if text is None:
        raise BadRequest("infer needs what was measured: --measured pull_off_force=300nN")
    word, has_value, value = text.partition("=")
    if not has_value:
        raise BadRequest("--measured: write a quantity and its value, such as pull_off_force=300nN")
    quantity = quantity_named(word)
    return quantity, spreads_of(value, quantity)
