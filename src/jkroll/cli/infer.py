"""Runner of `infer`: from measured values back to one input or two."""

import sys
from collections.abc import Mapping, Sequence
from typing import Any

from ..answers.inferred import Inferred, InferredOne, InferredPair
from ..answers.questions import quantity_named
from ..errors import BadRequest
from ..materials.library import Material
from ..output import notes as note_lines
from ..output.records import in_units
from ..quantities.formatting import Format
from ..quantities.nomenclature import named
from ..quantities.values import Spread, spreads_of
from ..rows.columns import Wanted
from ..rows.inferred import Sought, SoughtOne
from ..rows.sweep import Sweep
from ..scene.inverse import SIZES, AlreadyGiven, CannotInfer, Observed, largest, observed, with_inputs
from ..text import quoted, say_wrapped
from .commands import Call
from .question import check_count, exit_code, unless_failed, write_answers, write_columns
from .request import form_of, format_name, is_table, request_of

MAX_ANSWERS = 10_000  # that are explained one by one
MAX_PAIRS = 1_000  # scenes in which two inputs are looked for, which takes up to seconds in each


class _Inverse:
    """Unknowns of the rows of a sweep: an input by a measured quantity, or two by two."""

    def __init__(self, names: Sequence[str], quantities: Sequence[str]) -> None:
        self.names, self.quantities = names, quantities
        self.is_pair = len(names) > 1
        self.sought = Sought if self.is_pair else SoughtOne

    def row(self, given: Mapping[str, Any], *spheres: Material | None, model: str | None) -> Observed:
        """Return a row of inputs among which are the measured values."""
        return observed(self.quantities, given, *spheres, model=model)

    def answer(self, row: Any) -> Inferred:
        """Return the answer for a row."""
        return (InferredPair if self.is_pair else InferredOne)(self.names, row)

    def wanted(self, sweep: Sweep) -> Wanted:
        """Return the columns of the rows."""
        return self.sought.of(self.names, self.quantities, sweep.kinds)

    def numbers(self, *, doubts: bool) -> Wanted:
        """Return the columns of the values alone."""
        return self.sought(self.names, self.quantities, doubts=doubts)


def run_infer(call: Call) -> int:
    """Find inputs for every scene and measured value; return the exit code."""
    if not call.words:
        raise BadRequest(f"infer needs an input: one of {', '.join(SIZES)}")
    names = _names(call.words[0])
    if tables := [word for word in call.words[1:] if is_table(word)]:
        if len(names) > 1:
            raise BadRequest(
                "infer reads no tables, and batch infers one input; lists and ranges have commas and colons"
            )
        quantity = (call.measured[0] if call.measured else "QUANTITY").partition("=")[0]
        line = f"jkroll batch {tables[0]} --infer {call.words[0]} --measured {quantity}"
        raise BadRequest(f"infer reads no tables; write {line}")
    measured = _measured(call.measured, names)
    kind = format_name(call)
    form = form_of(call, names)
    request = request_of(call._replace(words=call.words[1:]))
    for quantity in measured:
        if quantity in request.spreads:
            raise AlreadyGiven(quantity, quantity)
    inverse = _Inverse(names, [*measured])
    sweep = Sweep(request.pairs, {**request.spreads, **measured}, request.models, inverse.row)
    if inverse.is_pair and len(sweep) > MAX_PAIRS:
        raise BadRequest(f"{len(sweep)} scenes are more than {MAX_PAIRS}, in which two inputs are looked for")
    wanted = inverse.wanted(sweep)
    is_one = len(sweep) == 1 and kind in ("plain", "table")
    if is_one or kind in ("json", "explain", "cite"):
        check_count(len(sweep), kind, MAX_ANSWERS)
        answers = map(inverse.answer, sweep.scenes())
        shown = (one.explained for one in answers) if kind in ("explain", "cite") else answers
        return write_answers(shown, len(sweep), kind, form, sys.stdout, quiet=call.quiet)
    return _write_rows(inverse, wanted, sweep, kind, form, call)


def _write_rows(inverse: _Inverse, wanted: Wanted, sweep: Sweep, kind: str, form: Format, call: Call) -> int:
    """Write a row for each scene and measured value; return the exit code."""
    if kind == "bare":
        wanted = inverse.numbers(doubts=not call.quiet)
    blocks = sweep.columns(wanted, one_by_one=inverse.is_pair)
    if len(sweep) == 1:
        blocks = iter([unless_failed(next(blocks), inverse.names)])
    notes = note_lines.OfRows()
    write_columns(wanted, notes.watch(in_units(columns, form) for columns in blocks), kind, form, call)
    if call.quiet:
        found = []
    elif len(sweep) == 1:
        found = note_lines.of_answer(inverse.answer(next(sweep.scenes())))
    else:
        kinds = [(with_inputs(row.scene, largest(inverse.names)), inverse.quantities) for row in sweep.kinds]
        found = notes.lines(sweep.pairs, kinds)
    for line in found:
        say_wrapped(line, sys.stderr)
    return exit_code(notes, len(sweep))


def _names(text: str) -> list[str]:
    """Read the inputs that are sought."""
    words = text.split(",")
    names = [named(word) for word in words]
    for word, name in zip(words, names, strict=True):
        if name not in SIZES:
            raise CannotInfer(word)
    if len(names) > 2:
        raise BadRequest(f"infer finds one input or two, not {len(names)}")
    if len(set(names)) < len(names):
        raise BadRequest(f"{quoted(text)} names one input twice")
    return names


def _measured(texts: Sequence[str], names: Sequence[str]) -> dict[str, list[Spread]]:
    """Read the measured quantities and their values: as many as inputs are sought."""
    example = "--measured pull_off_force=300nN" + " --measured stiffness=1kN/m" * (len(names) - 1)
    if not texts:
        raise BadRequest(f"infer needs what was measured: {example}")
    measured: dict[str, list[Spread]] = {}
    for text in texts:
        word, has_value, value = text.partition("=")
        if not has_value:
            raise BadRequest("--measured: write a quantity and its value, such as pull_off_force=300nN")
        quantity = quantity_named(word)
        if quantity in measured:
            raise BadRequest(f"--measured: {quantity} is given twice; several values have commas")
        measured[quantity] = spreads_of(value, quantity)
    if len(measured) != len(names):
        wanted = (
            "an input needs one measured quantity" if len(names) == 1 else "two inputs need two measured quantities"
        )
        raise BadRequest(f"{wanted}, and {len(measured)} {'is' if len(measured) == 1 else 'are'} given: {example}")
    return measured
