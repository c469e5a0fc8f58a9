"""Runner of the commands that ask a question of scenes: from a call to printed answers and an exit code."""

import sys
from collections.abc import Iterable, Iterator, Sequence
from itertools import chain, islice
from math import isnan
from typing import TextIO

from ..answers.answer import Answer
from ..answers.questions import QUESTIONS, Question, quantities_named
from ..errors import ROWS_FAILED, BadRequest, JkrollError
from ..output import notes as note_lines
from ..output.records import in_units, lines, text_output, write_json, write_plain
from ..quantities.formatting import Format
from ..quantities.nomenclature import NOMENCLATURE
from ..quantities.units import BadUnit, Unit, dimension_of, parse_unit
from ..quantities.values import error_about
from ..rows.columns import Columns, Wanted
from ..scene.wiring import formula_of
from ..text import fitting, quoted, say_wrapped
from .commands import Call
from .request import Request, request_of

MAX_OBJECTS = 1_000_000  # answers that are written one by one
MAX_TABLE = 10_000  # rows of a table on a terminal


def run_question(call: Call) -> int:
    """Answer the question of a command for every scene that was described; return the exit code."""
    question, kind, form = checked(call)
    request = request_of(call)
    if call.quantities:
        _refuse_inputs(question, request)
    is_one = request.count == 1 and kind in ("plain", "table") and call.target is None
    if is_one or kind in ("json", "explain", "cite"):
        check_count(request.count, kind)
        if request.count > 1:
            request.sweep.wanted(
                question.quantities, question.named
            )  # raises what is wrong with rows before one is written
        answers = (Answer(question, scene) for scene in request.scenes())
        with text_output(call.target or "-") as out:
            return write_answers(answers, request.count, kind, form, out, quiet=call.quiet)
    return _write_rows(question, request, kind, form, call)


def checked(call: Call) -> tuple[Question, str, Format]:
    """Return the question of a call, and the name and the units of the output format; raise BadRequest for a mistake."""
    kind = format_name(call)
    if call.target is not None and not is_json(call.target):
        if ending(call.target) in PICTURES:
            raise BadRequest(
                f"-o: {quoted(call.target)} is a picture; add --curve to contact, or see jkroll map --help"
            )
        if kind in ("bare", "json", "explain", "cite"):
            raise BadRequest(f"-o and --{kind} exclude each other; for that output write > FILE")
    question = question_of(call)
    if kind == "bare":
        question = question._replace(quantities=question.headline)
    form = form_of(call, question.quantities)
    return question, kind, form


def question_of(call: Call) -> Question:
    """Return the question of the command, or of the quantities that `--quantities` lists: all of them are its headline."""
    if not call.quantities:
        return QUESTIONS[call.command]
    named, offered = quantities_named(call.quantities)
    names = tuple(dict.fromkeys((*named, *offered)))
    return Question(names, names, named=tuple(named))


def _refuse_inputs(question: Question, request: Request) -> None:
    """Raise BadRequest for a quantity that was named and is not a result of the scenes, but one of their inputs."""
    scene = request.sweep.kinds[0]
    for name in question.named:
        if name in scene.stated or (name in scene.values and formula_of(name) is None):
            raise BadRequest(f"--quantities: {name} is an input here")


def check_count(count: int, kind: str, most: int = MAX_OBJECTS) -> None:
    """Raise BadRequest if there are more scenes than are answered one by one."""
    if count > most:
        raise BadRequest(f"--{kind}: {count} scenes are more than {most}; --csv writes any number")


# --- Rows -------------------------------------------------------------------------------------------------------------


def _write_rows(question: Question, request: Request, kind: str, form: Format, call: Call) -> int:
    """Write a row for each scene; return the exit code."""
    sweep = request.sweep
    if kind == "bare":
        named = [name for name in question.headline if name in question.named or not NOMENCLATURE[name].of_identical]
        wanted = Wanted(question.headline, named=named, doubts=not call.quiet)
    else:
        wanted = sweep.wanted(question.quantities, question.named)
    is_shown = kind == "table" and call.target is None and request.count <= MAX_TABLE
    blocks = sweep.columns(wanted, one_by_one=is_shown)
    if request.count == 1:
        headline = [name for name in question.headline if name in wanted.names and name not in sweep.spreads]
        blocks = iter([unless_failed(next(blocks), headline)])
    notes = note_lines.OfRows()
    write_columns(wanted, notes.watch(in_units(columns, form) for columns in blocks), kind, form, call)
    if call.quiet:
        found = []
    elif request.count == 1:
        found = note_lines.of_answer(Answer(question, next(request.scenes())))
    else:
        kinds = [(scene, sweep.shown(scene, wanted.names, wanted.named)) for scene in sweep.kinds]
        found = notes.lines(sweep.pairs, kinds)
    for line in found:
        say_wrapped(line, sys.stderr)
    return exit_code(notes, request.count)


def unless_failed(columns: Columns, headline: Sequence[str]) -> Columns:
    """Return the columns of a single row, or raise its failure if it lacks the headline of the question."""
    numbers = [columns.column(name)[0] for name in headline if name in columns.wanted.places]
    if columns.failed() and all(map(isnan, numbers)):
        raise columns.failure(0)
    return columns


def write_columns(wanted: Wanted, blocks: Iterable[Columns], kind: str, form: Format, call: Call) -> None:
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


def exit_code(notes: note_lines.OfRows, count: int) -> int:
    """Print how many of `count` rows failed, if any did; return the exit code."""
    return _failed(notes.failed, count, notes.failure)


def _failed(failed: int, count: int, first: JkrollError | None) -> int:
    if not failed:
        return 0
    say_wrapped(f"jkroll: {first if count == 1 else f'{failed} of {count} rows failed'}", sys.stderr)
    return ROWS_FAILED


# --- Answers ----------------------------------------------------------------------------------------------------------


def write_answers(answers: Iterable[Answer], count: int, kind: str, form: Format, out: TextIO, *, quiet: bool) -> int:
    """Write answers one by one, and the notes of a single one unless these are in it; return the exit code."""
    failures: list[JkrollError] = []
    is_shown = count == 1 and kind in ("plain", "table")

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

        write_explanation(every, out, form)
    elif kind == "cite":
        from ..output.sources import write_citations

        write_citations(every, out)
    elif kind == "json":
        write_json(every, count, out, form)
    elif is_shown:
        only = next(every)
        if kind == "table":
            from ..output.table import scene_table

            scene_table(only, out, form)
        else:
            write_plain(only, out, form)
        out.flush()
        for line in () if quiet else note_lines.of_answer(only, has_head=kind == "table"):
            say_wrapped(line, sys.stderr)
    out.flush()
    return _failed(len(failures), count, failures[0] if failures else None)


# --- Formats of the output --------------------------------------------------------------------------------------------


FORMATS = ("bare", "json", "csv", "explain", "cite")
PICTURES = ("svg", "pdf", "png")


def format_name(call: Call) -> str:
    """Return the name of the output format: the one that was chosen, else a table on a terminal and plain lines in a pipe.

    A name of the output file that ends in .json chooses JSON.
    """
    chosen = [name for name in FORMATS if getattr(call, name)]
    if len(chosen) > 1:
        raise BadRequest(f"--{chosen[0]} and --{chosen[1]} exclude each other")
    if is_json(call.target):
        if chosen and chosen != ["json"]:
            raise BadRequest(f"-o {quoted(call.target or '')} and --{chosen[0]} exclude each other")
        return "json"
    if chosen:
        return chosen[0]
    return "table" if sys.stdout.isatty() else "plain"


def form_of(call: Call, quantities: Sequence[str]) -> Format:
    """Return the format of results; each unit of `--to` applies to the quantities of its dimension."""
    units: dict[str, tuple[str, Unit]] = {}
    for text in call.to.split(",") if call.to is not None else []:
        try:
            unit = parse_unit(text)
        except BadUnit as error:
            wanted = [dimension_of(NOMENCLATURE[name].unit) for name in quantities]
            raise error_about(
                "--to", text, error, wanted, f"expected a unit such as {NOMENCLATURE[quantities[0]].unit}"
            ) from None
        fitting = [
            name for name in quantities if text.strip() and dimension_of(NOMENCLATURE[name].unit) == unit.dimension
        ]
        if not fitting:
            units_of_results = ", ".join(dict.fromkeys(NOMENCLATURE[name].unit for name in quantities))
            raise BadRequest(f"--to: {quoted(text)} fits none of the results, which are in: {units_of_results}")
        if fitting[0] in units:
            raise BadRequest(
                f"--to: {quoted(units[fitting[0]][0])} and {quoted(text)} are units of one dimension; give one of them"
            )
        units |= dict.fromkeys(fitting, (" ".join(text.split()), unit))
    return Format(units, call.digits)


def no_picture(flag: str, path: str, remedy: str = "") -> BadRequest:
    """Return the error for a file name whose ending is not that of a picture; `remedy` says how else the numbers are written."""
    endings = f".{', .'.join(PICTURES[:-1])} or .{PICTURES[-1]}"
    return BadRequest(f"{flag}: {quoted(path)} does not end in {endings}{remedy}")


def ending(path: str) -> str:
    """Return the ending of a file name, in lower case and without its point.

    >>> ending("a/Map.SVG"), ending("svg")
    ('svg', '')
    """
    _, point, end = path.rpartition(".")
    return end.casefold() if point else ""


def is_json(target: str | None) -> bool:
    """Return whether an output file was named whose name says that it is JSON."""
    return target is not None and ending(target) == "json"
