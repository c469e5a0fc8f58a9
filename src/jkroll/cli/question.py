"""Runners that ask a question of scenes, or for their force curves: from a call to printed answers and an exit code."""

import sys
from collections.abc import Iterable, Iterator, Sequence
from itertools import chain, islice
from math import isnan
from typing import Any, Protocol, TextIO

from ..answers.answer import Answer
from ..answers.questions import QUESTIONS, Question, question_about
from ..errors import ROWS_FAILED, BadRequest, JkrollError
from ..output import notes as note_lines
from ..output.files import text_output
from ..output.records import lines, write_json, write_plain
from ..quantities.formatting import Format
from ..quantities.nomenclature import NOMENCLATURE
from ..rows.columns import Columns, Wanted
from ..rows.sweep import Sweep
from ..scene.scene import Scene
from ..scene.wiring import formula_of
from ..text import ending, fitting, quoted, say_wrapped
from .commands import Call
from .request import OTHER_PICTURES, PICTURES, curve_request, form_of, format_name, is_json, request_of

MAX_OBJECTS = 1_000_000  # answers that are written one by one
MAX_TABLE = 10_000  # rows of a table on a terminal
CURVE_BLOCK = 500  # rows of force curves that are computed before they are written


class Asked(Protocol):
    """The question that the rows of a sweep answer: quantities of each, or inputs that are sought."""

    headline: Sequence[str]  # quantities without which a single row fails
    most: int  # rows that are answered one by one
    most_in_table: int  # rows that are computed one by one for a table on a terminal

    def answer(self, scene: Any) -> Answer:
        """Return the answer for a row."""

    def wanted(self, sweep: Sweep) -> Wanted:
        """Return the columns of the rows. Raises what is wrong with all of them."""

    def with_alternatives(self, wanted: Wanted, sweep: Sweep, *, is_table: bool) -> Wanted:
        """Return the same columns with what may stand in place of results; in a table on a terminal, of the headline."""

    def bare(self, *, doubts: bool) -> Wanted:
        """Return the columns of the headline alone."""

    def kinds(self, sweep: Sweep, wanted: Wanted) -> Iterable[tuple[Scene, Sequence[str]]]:
        """Return a scene of each kind of rows, with the quantities that it shows."""


class _OfQuestion:
    """The question of a command, or about quantities that were named."""

    most = MAX_OBJECTS
    most_in_table = MAX_TABLE

    def __init__(self, question: Question) -> None:
        self.question = question
        self.headline: Sequence[str] = question.headline

    def answer(self, scene: Scene) -> Answer:
        return Answer(self.question, scene)

    def wanted(self, sweep: Sweep) -> Wanted:
        return sweep.wanted(self.question.quantities, self.question.named)

    def with_alternatives(self, wanted: Wanted, sweep: Sweep, *, is_table: bool) -> Wanted:
        if is_table and len(sweep.models) > 1:
            return wanted
        return wanted.with_alternatives(sweep.kinds, self.headline if is_table else wanted.names, data=is_table)

    def bare(self, *, doubts: bool) -> Wanted:
        shown = [name for name in self.headline if name in self.question.named or not NOMENCLATURE[name].of_identical]
        return Wanted(self.headline, named=shown, doubts=doubts)

    def kinds(self, sweep: Sweep, wanted: Wanted) -> Iterable[tuple[Scene, Sequence[str]]]:
        return [(scene, sweep.shown(scene, wanted.names, wanted.named)) for scene in sweep.kinds]


def run_question(call: Call) -> int:
    """Answer the question of a command for every scene that was described; return the exit code."""
    question, kind, form = checked(call)
    sweep = request_of(call).sweep
    if call.quantities:
        _refuse_inputs(question, sweep)
    return write_asked(_OfQuestion(question), sweep, kind, form, call)


def write_asked(asked: Asked, sweep: Sweep, kind: str, form: Format, call: Call) -> int:
    """Write what is asked, as answers or as rows; return the exit code."""
    count = len(sweep)
    is_one = count == 1 and kind in ("plain", "table") and call.target is None
    if not is_one and kind not in ("json", "explain", "cite"):
        return _write_rows(asked, sweep, kind, form, call)
    check_count(count, kind, asked.most)
    if count > 1:
        asked.wanted(sweep)  # what is wrong with rows is raised before one is written
    answers = map(asked.answer, sweep.scenes())
    with text_output(call.target or "-") as out:
        return write_answers(answers, count, kind, form, out, quiet=call.quiet, alternatives=call.alternatives)


def checked(call: Call) -> tuple[Question, str, Format]:
    """Return the question of a call, and the name and the units of the output format; raise BadRequest for a mistake."""
    kind = checked_format(call)
    question = question_of(call, QUESTIONS[call.command])
    if kind == "bare":
        question = question._replace(quantities=question.headline)
    form = form_of(call, question.quantities)
    return question, kind, form


def checked_format(call: Call) -> str:
    """Return the name of the output format; raise BadRequest for one that does not go with `-o`."""
    kind = format_name(call)
    if call.alternatives and (kind in ("bare", "explain", "cite") or call.curve):
        raise BadRequest(f"--alternatives and --{'curve' if call.curve else kind} exclude each other")
    if call.target is not None and not is_json(call.target):
        if _is_picture(call.target):
            remedy = "add --curve to contact, or see jkroll map --help"
            raise BadRequest(f"-o: {quoted(call.target)} is a picture; {remedy}")
        if kind in ("bare", "json", "explain", "cite"):
            remedy = "name the file x.json" if kind == "json" else "redirect the output: > FILE"
            raise BadRequest(f"-o and --{kind} exclude each other; {remedy}")
    return kind


def _is_picture(path: str) -> bool:
    """Return whether the name of a file is that of a picture, be it one that is drawn or not."""
    return ending(path) in (*PICTURES, *OTHER_PICTURES)


def question_of(call: Call, usual: Question) -> Question:
    """Return the question about the quantities that `--quantities` lists, or the usual one without it."""
    if call.quantities is None:
        return usual
    if not call.quantities.strip():
        raise BadRequest("--quantities is empty; name some, such as --quantities pull_off_force,r_min")
    return question_about(call.quantities)


def _refuse_inputs(question: Question, sweep: Sweep) -> None:
    """Raise BadRequest for a quantity that was named and is not a result of the scenes, but one of their inputs."""
    scene = sweep.kinds[0]
    for name in question.named:
        if name in scene.stated or (name in scene.values and formula_of(name) is None):
            raise BadRequest(f"--quantities: {name} is an input here")


def check_count(count: int, kind: str, most: int) -> None:
    """Raise BadRequest if there are more scenes than are answered one by one."""
    if count > most:
        raise BadRequest(f"--{kind}: {count} scenes are more than {most}; --csv writes any number")


# --- Rows -------------------------------------------------------------------------------------------------------------


def _write_rows(asked: Asked, sweep: Sweep, kind: str, form: Format, call: Call) -> int:
    """Write a row for each scene; return the exit code."""
    wanted = asked.bare(doubts=not call.quiet) if kind == "bare" else asked.wanted(sweep)
    is_shown = kind == "table" and call.target is None and len(sweep) <= asked.most_in_table
    if is_shown or (call.alternatives and kind != "bare"):
        wanted = asked.with_alternatives(wanted, sweep, is_table=is_shown and not call.alternatives)
    blocks = sweep.columns(wanted, one_by_one=is_shown)
    if len(sweep) == 1:
        headline = [name for name in asked.headline if name in wanted.names and name not in sweep.spreads]
        blocks = iter([unless_failed(next(blocks), headline)])
    notes = note_lines.OfRows()
    deliver(wanted, notes.watch(blocks), kind, form, call)
    if len(sweep) == 1 and not call.quiet:
        return _ended(notes, note_lines.of_answer(asked.answer(next(sweep.scenes()))))
    return _ended(notes, notes.lines(asked.kinds(sweep, wanted), has_table=is_shown, quiet=call.quiet))


def unless_failed(columns: Columns, headline: Sequence[str]) -> Columns:
    """Return the columns of a single row, or raise its failure if it lacks the headline of the question."""
    numbers = [columns.column(name)[0] for name in headline if name in columns.wanted.places]
    if columns.failed and all(map(isnan, numbers)):
        raise columns.failure(0)
    return columns


def deliver(wanted: Wanted, blocks: Iterable[Columns], kind: str, form: Format, call: Call) -> None:
    """Write columns to stdout, as a table on a terminal or as lines of text, or to a file."""
    if call.target is not None:
        from ..batch.one import write_columns as write_file

        write_file(wanted, blocks, form, call.target, doubt=not call.no_doubt, quiet=call.quiet)
        return
    every = iter(blocks)
    if kind == "table":
        first = [*islice(every, 2)]
        if len(first) == 1 and len(first[0]) <= MAX_TABLE:
            from ..output.table import sweep_table

            sweep_table(first[0], sys.stdout, form)
            return
        every = chain(first, every)
    for text in lines("plain" if kind == "table" else kind, wanted, every, form, doubt=not call.no_doubt):
        sys.stdout.write(fitting(text.decode(), sys.stdout))
    sys.stdout.flush()


def _ended(notes: note_lines.OfRows, lines: Iterable[str]) -> int:
    """Print the notes on rows, and how many of them failed, if any did; return the exit code."""
    for line in lines:
        say_wrapped(line, sys.stderr)
    return _failed(notes.failed, notes.count, notes.failure)


def _failed(failed: int, count: int, first: JkrollError | None) -> int:
    if not failed:
        return 0
    say_wrapped(f"jkroll: {first if count == 1 else f'{failed} of {count} rows failed'}", sys.stderr)
    return ROWS_FAILED


# --- Answers ----------------------------------------------------------------------------------------------------------


def write_answers(
    answers: Iterable[Answer],
    count: int,
    kind: str,
    form: Format,
    out: TextIO,
    *,
    quiet: bool,
    alternatives: bool = False,
) -> int:
    """Write answers one by one, and the notes of a single one unless these are in it; return the exit code."""
    failures: list[JkrollError] = []

    def watched() -> Iterator[Answer]:
        for one in answers:
            if one.failure is not None:
                if count == 1 and kind not in ("explain", "cite") and one.has_no_headline:
                    raise one.failure
                failures.append(one.failure)
            yield one

    every = watched()
    if kind == "explain":
        from ..output.sources import write_explanation

        write_explanation((one.explained for one in every), out, form)
    elif kind == "cite":
        from ..output.sources import write_citations

        write_citations((one.explained for one in every), out)
    elif kind == "json":
        write_json(every, count, out, form)
    else:
        only = next(every)
        if kind == "table":
            from ..output.table import scene_table

            scene_table(only, out, form)
        else:
            write_plain(only, out, form, alternatives=alternatives)
        out.flush()
        is_bare = kind == "bare" and quiet
        for line in [] if is_bare else note_lines.of_answer(only, has_head=kind == "table", quiet=quiet):
            say_wrapped(line, sys.stderr)
    out.flush()
    return _failed(len(failures), count, failures[0] if failures else None)


# --- Force curves -----------------------------------------------------------------------------------------------------


def run_contact(call: Call) -> int:
    """Answer the question of the command, or write or draw the force curve; return the exit code."""
    is_drawn = call.curve and call.target is not None and _is_picture(call.target)
    if is_drawn or call.width is not None or call.style is not None or call.uncaptioned or call.panel:
        from .map import draw_contact

        return draw_contact(call)
    return _write_curve(call) if call.curve else run_question(call)


def _write_curve(call: Call) -> int:
    """Write the force curve of every scene; return the exit code. Raises the failure of the first state if each has one."""
    from ..answers.curve import FORCE_CURVE, AtState, OfCurve, at_states

    kind = checked_format(call)
    if kind in ("explain", "cite"):
        raise BadRequest(f"--curve and --{kind} exclude each other")
    question = question_of(call, FORCE_CURVE)
    shown = question.headline if kind == "bare" else question.quantities
    form = form_of(call, shown)
    request, loads = curve_request(call)
    sweep = request.sweep
    if (count := len(sweep)) > MAX_OBJECTS:
        raise BadRequest(f"--curve: {count} scenes are more than {MAX_OBJECTS}")
    samples = [*at_states(sweep.kinds, loads)]
    failures = (AtState(one, question).failure for one in samples)
    if (first := next(failures)) is not None and None not in failures:
        raise first
    at = at_states(sweep.scenes(), loads)
    if kind == "json":
        every = [*at]
        with text_output(call.target or "-") as out:
            answers = (AtState(one, question) for one in every)
            return write_answers(answers, len(every), kind, form, out, quiet=call.quiet)
    bare = OfCurve(shown, named=shown, doubts=False)
    wanted = bare if kind == "bare" else OfCurve.of(samples, shown)
    size = MAX_TABLE if kind == "table" else CURVE_BLOCK

    def columns() -> Iterator[Columns]:
        while some := [*islice(at, size)]:
            yield Columns.of_rows(wanted, [wanted.row(one) for one in some])

    notes = note_lines.OfRows()
    deliver(wanted, notes.watch(columns()), kind, form, call)
    curves = [*dict.fromkeys(one.curve for one in samples)]
    if len(sweep) == 1 and not call.quiet:
        return _ended(notes, note_lines.of_answer(curves[0]))
    return _ended(notes, notes.lines([(curve.scene, curve.shown) for curve in curves], quiet=call.quiet))
