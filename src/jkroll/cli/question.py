"""Runners that ask a question of scenes, or for their force curves: from a call to printed answers and an exit code."""

import sys
from collections.abc import Callable, Iterable, Iterator
from contextlib import AbstractContextManager, nullcontext
from itertools import islice
from math import isnan
from typing import TYPE_CHECKING, Any, TextIO

from ..answers.notes import OfRows, lines_of
from ..answers.questions import QUESTIONS, Question, question_about
from ..errors import ROWS_FAILED, BadRequest, JkrollError
from ..quantities.formatting import Format
from ..quantities.nomenclature import NOMENCLATURE
from ..rows.sweep import Sweep
from ..scene.scene import Scene
from ..scene.wiring import formula_of
from ..text import quoted, say_wrapped
from .call import Call, worded

if TYPE_CHECKING:
    from ..answers.answer import Answer
    from ..rows.columns import Columns, Wanted

CURVE_BLOCK = 500  # rows of force curves that are computed before they are written


def run_question(call: Call) -> int:
    """Answer the question of a command for every scene that was described; return the exit code."""
    check_format(call)
    question = question_of(call, QUESTIONS[call.command])
    form = call.form(question.quantities)
    for name in question.named:
        scene = call.sweep.kinds[0]
        if name in scene.stated or (name in scene.values and formula_of(name) is None):
            raise BadRequest(f"--quantities: {name} is an input here")

    def answer(row: Scene) -> "Answer":
        from ..answers.answer import Answer  # of which rows that are written with fewer words need nothing

        return Answer(question, row)

    return write(call, call.sweep, question, form, answer)


def write(call: Call, sweep: Sweep, question: Question, form: Format, answer: "Callable[[Any], Answer]") -> int:
    """Write what is asked, as rows or as answers; return the exit code. `answer`: returns that of a row."""
    count = len(sweep)
    is_one = count == 1 and call.kind in ("plain", "table") and call.target is None
    if not is_one and call.kind not in ("json", "explain", "cite"):
        return _write_rows(call, sweep, question, form, answer)
    if count > sweep.most_answers:
        raise BadRequest(f"--{call.kind}: {count} pairs are more than {sweep.most_answers}; --csv writes any number")
    if count > 1:
        sweep.wanted(question.quantities, question.named)  # what is wrong with rows is raised before one is written
    return _write_answers(call, map(answer, sweep.scenes()), count, form)


def check_format(call: Call) -> None:
    """Raise BadRequest for an output format that does not go with other options."""
    if call.alternatives and (call.kind in ("bare", "explain", "cite") or call.curve):
        raise BadRequest(f"--alternatives and --{'curve' if call.curve else call.kind} exclude each other")
    if call.tex and not call.cite:
        raise BadRequest("--tex goes with --cite")
    if call.names_picture:
        remedy = "add --curve to contact, or see jkroll map --help"
        raise BadRequest(f"-o: {quoted(call.target or '')} is a picture; {remedy}")


def question_of(call: Call, usual: Question) -> Question:
    """Return the question about the quantities that `--quantities` lists, or the usual one; bare, its headline."""
    question = usual if call.quantities is None else question_about(call.quantities)
    return Question(question.headline, question.headline, question.named) if call.kind == "bare" else question


# --- Rows -------------------------------------------------------------------------------------------------------------


def _write_rows(call: Call, sweep: Sweep, question: Question, form: Format, answer: "Callable[[Any], Answer]") -> int:
    """Write a row for each scene; return the exit code."""
    is_shown = call.kind == "table" and call.target is None and len(sweep) <= sweep.most_in_table
    if call.kind == "bare":
        wanted = sweep.headline(question.headline, question.named, doubts=not call.quiet)
    else:
        wanted = sweep.wanted(question.quantities, question.named)
        if call.alternatives:
            wanted = wanted.with_alternatives(sweep.kinds, wanted.names)
        elif is_shown and len(sweep.models) == 1:
            wanted = wanted.with_alternatives(sweep.kinds, question.headline)
    blocks = sweep.columns(wanted, one_by_one=is_shown)
    if len(sweep) == 1:
        row = next(blocks)
        headline = [name for name in question.headline if name in wanted.places and name not in sweep.spreads]
        if row.failed and all(isnan(row.column(name)[0]) for name in headline):
            raise row.failure(0)
        blocks = iter([row])
    single = answer(next(sweep.scenes())) if len(sweep) == 1 and not call.quiet else None
    return _write_columns(call, wanted, OfRows(sweep.noted(wanted)), blocks, form, is_table=is_shown, single=single)


def _write_columns(
    call: Call, wanted: "Wanted", notes: OfRows, blocks: "Iterable[Columns]", form: Format, *, is_table: bool,
    single: "Answer | None",
) -> int:  # fmt: skip
    """Write columns to a file, to stdout as lines, or as a table, and their notes; return the exit code.

    `single`: the answer of which the notes are those of the columns.
    """
    every = notes.watch(blocks)
    if call.target is not None:
        from ..batch.run import write_file

        write_file(wanted, every, form, call.target, doubt=not call.no_doubt, quiet=call.quiet)
    elif is_table:
        from ..output.table import sweep_table

        for columns in every:
            sweep_table(columns, sys.stdout, Format(form.units, form.digits, call.typed), notes.assumed)
    else:
        from ..output.writers import WRITERS, written

        writer = WRITERS["plain" if call.kind == "table" else call.kind]
        for text in written(writer, wanted, every, form, doubt=not call.no_doubt):
            sys.stdout.write(text.decode())
        sys.stdout.flush()
    lines = notes.lines(has_table=is_table, quiet=call.quiet) if single is None else lines_of(single, has_head=is_table)
    for line in lines:
        say_wrapped(line, sys.stderr)
    return _failed(call, notes.tally.failed, notes.tally.rows)


def _failed(call: Call, failed: int, count: int, first: JkrollError | None = None) -> int:
    if not failed:
        return 0
    options = [NOMENCLATURE[name].option for name in call.inputs]
    message = worded(first, call.command, options) if first and count == 1 else f"{failed} of {count} rows failed"
    say_wrapped(f"jkroll: {message}", sys.stderr)
    return ROWS_FAILED


# --- Answers ----------------------------------------------------------------------------------------------------------


def _write_answers(call: Call, answers: "Iterable[Answer]", count: int, form: Format) -> int:
    """Write answers one by one, and the notes of a single one unless these are in it; return the exit code."""
    failures: list[JkrollError] = []

    def watched() -> "Iterator[Answer]":
        for answer in answers:
            if answer.failure is not None:
                if count == 1 and call.kind != "explain" and answer.has_no_headline:
                    raise answer.failure
                failures.append(answer.failure)
            yield answer

    with _output(call.target) as out:
        if call.kind == "json":
            from ..output.answered import write_json

            write_json(watched(), count, out, form)
        elif call.kind == "explain":
            from ..output.sources import write_explanation

            write_explanation((answer.explained for answer in watched()), out, form)
        elif call.kind == "cite":
            from ..output.sources import write_citations, write_methods

            write = write_methods if call.tex else write_citations
            write((answer.explained for answer in watched()), out)
        else:
            _write_answer(call, next(watched()), out, form)
        out.flush()
    return _failed(call, len(failures), count, failures[0] if failures else None)


def _output(target: str | None) -> AbstractContextManager[TextIO]:
    """Return the file of a name, which is written whole, or stdout."""
    if target is None:
        return nullcontext(sys.stdout)
    from ..output.writers import text_output

    return text_output(target)


def _write_answer(call: Call, answer: "Answer", out: TextIO, form: Format) -> None:
    """Write a single answer as text, and its notes."""
    is_table = call.kind == "table"
    if is_table:
        from ..output.table import scene_table

        scene_table(answer, out, Format(form.units, form.digits, call.typed))
    else:
        from ..output.answered import write_plain

        write_plain(answer, out, form, alternatives=call.alternatives)
    out.flush()
    if not (call.quiet and call.kind == "bare"):
        for line in lines_of(answer, has_head=is_table, quiet=call.quiet):
            say_wrapped(line, sys.stderr)


# --- Force curves -----------------------------------------------------------------------------------------------------


def run_contact(call: Call) -> int:
    """Answer the question of the command, or write or draw the force curve; return the exit code."""
    is_drawn = call.curve and call.names_picture
    if is_drawn or call.width is not None or call.style is not None or call.uncaptioned or call.panel:
        from .map import draw_contact

        return draw_contact(call)
    return _write_curve(call) if call.curve else run_question(call)


def _write_curve(call: Call) -> int:
    """Write the force curve of every scene; return the exit code.

    Raises the failure of the first state if each has one.
    """
    from ..answers.curve import FORCE_CURVE, at_states, of_curves
    from ..rows.columns import Columns, Wanted

    check_format(call)
    if call.kind in ("explain", "cite"):
        raise BadRequest(f"--curve and --{call.kind} exclude each other")
    question = question_of(call, FORCE_CURVE)
    form = call.form(question.quantities)
    loads, sweep = call.loads, call.sweep
    samples = [*at_states(sweep.kinds, question, loads)]
    failures = (sample.failure for sample in samples)
    if (first := next(failures)) is not None and None not in failures:
        raise first
    states = at_states(sweep.scenes(), question, loads)
    if call.kind == "json":
        every = [*states]
        return _write_answers(call, every, len(every), form)
    names = question.quantities
    wanted = Wanted(names, named=names, doubts=False) if call.kind == "bare" else of_curves(samples, names)
    is_table = call.kind == "table" and call.target is None
    size = None if is_table else CURVE_BLOCK

    def columns() -> Iterator[Columns]:
        while block := [*islice(states, size)]:
            yield Columns.of_rows(wanted, [*map(wanted.row_of, block)])

    curves = [*dict.fromkeys(sample.curve for sample in samples)]
    notes = OfRows((curve.scene, [*curve.outcomes]) for curve in curves)
    single = curves[0] if len(sweep) == 1 and not call.quiet else None
    return _write_columns(call, wanted, notes, columns(), form, is_table=is_table, single=single)
