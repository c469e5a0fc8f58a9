"""The runners of commands, from a call to printed answers and an exit code; `fit` and pictures have their own modules.

Imports are local, so a command loads only the modules it uses.
"""

import sys
from collections.abc import Iterable, Iterator, Sequence
from contextlib import AbstractContextManager, nullcontext
from functools import reduce
from itertools import chain, islice
from typing import TYPE_CHECKING, TextIO

from ..errors import ROWS_FAILED, BadRequest, JkrollError, repeated_input
from ..materials.library import UnknownMaterial
from ..model.frame import Frame
from ..model.limits import ENDING_MEANING
from ..model.plan import formula_of
from ..model.sweep import Sweep
from ..quantities.formatting import Format, symbol_of
from ..quantities.laws import HELD_BY_LOAD
from ..quantities.nomenclature import NOMENCLATURE, UnknownQuantity
from ..quantities.spreads import Spread, spreads_of
from ..report.notes import Noted, assumed_in, lines_of, notes_below
from ..report.questions import (
    BY_DEFAULT,
    QUESTIONS,
    Question,
    columns_in_table,
    quantities_named,
    quantity_named,
    question_about,
)
from ..text import closest, listed, quoted, say, say_wrapped
from .call import BARE, CITE, EXPLAIN, JSON, MARKDOWN, PLAIN, TABLE, Call, message_of
from .options import Options

if TYPE_CHECKING:
    from ..model.rows import Columns, Wanted
    from ..report.notes import Note
    from ..report.report import Report

CURVE_BLOCK = 500  # states of force curves that are computed at a time
MOST_FOUND = 12  # quantities in the table of a search


# --- Questions --------------------------------------------------------------------------------------------------------


def run_question(call: Call) -> int:
    """Answer the question of a command for each frame; return the exit code."""
    check_format(call)
    question = question_of(call, QUESTIONS[call.command])
    sweep = call.sweep
    frame = sweep.groups[0]
    shown = [name for name in question.quantities if name in question.named or frame.shows_to_identical(name)]
    form = call.form(shown or question.quantities)  # after `sweep`, which reports bad inputs
    for name in question.named:
        if name in frame.stated or (name in frame.values and formula_of(name) is None):
            raise repeated_input(name)
    return answer_rows(call, sweep, question, form)


def answer_rows(call: Call, sweep: Sweep, question: Question, form: Format) -> int:
    """Write the answers to a question, as rows or one after another; return the exit code."""

    def answer(row: Frame) -> "Report":
        from ..report.report import Report  # imported here, since rows of numbers do not need this module

        return Report(question, row, keeps_all=call.output.keeps_all, form=Format(form.units, form.digits))

    output, count, sizes = call.output, len(sweep), sweep.sizes
    single = answer(next(sweep.frames())) if count == 1 else None
    if single is not None and output is not EXPLAIN and single.failure is not None and single.has_no_headline:
        raise single.failure
    is_answer = single is not None and output.has_answers
    if output.has_rows and not is_answer:
        return _write_rows(call, sweep, question, form, single)
    if count > sizes.most_answers:
        most = f"--{output.name} writes at most {sizes.most_answers} pairs, not {count}"
        raise BadRequest(f"{most}; --csv writes any number")
    if count > 1:
        sweep.wanted(question.quantities, question.named)  # raises errors before anything is written
    answers = map(answer, sweep.frames()) if single is None else [single]
    return _write_answers(call, answers, count, form, single)


def check_format(call: Call) -> None:
    """Raise BadRequest if the output file has the name of a picture, which these commands do not draw."""
    if call.names_picture:
        remedy = "add --curve to contact, or see jkroll map --help"
        raise BadRequest(f"-o: {quoted(call.target or '')} is a picture; {remedy}")


def question_of(call: Call, usual: Question) -> Question:
    """Return the question made of `--quantities`, or the usual question; for bare output, only its headline."""
    question = usual if call.quantities is None else question_about(call.quantities)
    if call.output is BARE:
        return Question(question.headline, question.headline, question.named)
    return question


# --- Rows -------------------------------------------------------------------------------------------------------------


def _write_rows(call: Call, sweep: Sweep, question: Question, form: Format, single: "Report | None") -> int:
    """Write a row for each frame; return the exit code. `single`: the answer if there is only one row."""
    from ..model.rows import of_single_row

    is_shown = call.output is TABLE and len(sweep) <= sweep.sizes.most_in_table
    if call.output is BARE:
        wanted = sweep.headline(question.headline, question.named, doubts=not call.quiet)
    else:
        if is_shown:
            wanted = columns_in_table(question, sweep)
        else:
            wanted = sweep.wanted(question.quantities, question.named, keeps_all=call.output.keeps_all)
        if call.best:
            wanted = wanted.with_best(wanted.names)
    blocks = sweep.columns(wanted) if single is None else [of_single_row(wanted, single)]
    single = None if call.quiet else single
    return _write_columns(call, wanted, [*sweep.noted(wanted)], blocks, form, is_table=is_shown, single=single)


def _write_columns(
    call: Call, wanted: "Wanted", groups: Sequence[Noted], blocks: "Iterable[Columns]", form: Format, *,
    is_table: bool, single: "Report | None",
) -> int:  # fmt: skip
    """Write columns to a file, to stdout as lines, or as a table, with notes; return the exit code.

    `groups`: the groups of the rows; `single`: the answer that provides the notes; None if the rows do.
    """
    from ..model.tally import Tally, tallied

    tallies: list[Tally] = []
    blocks = tallied(blocks, tallies, symbol_of)  # adds to `tallies` as the blocks are written
    if call.target is not None:
        from ..tables.run import write_file

        write_file(wanted, blocks, form, call.target, doubt=not call.no_doubt, quiet=call.quiet)
    elif is_table:
        from ..report.curve import lead_of_curve
        from ..report.leads import lead_of_rows
        from ..write.table import sweep_table

        for columns in blocks:
            lead = lead_of_rows(groups, wanted.names) if single is None else lead_of_curve(single)
            sweep_table(columns, sys.stdout, form, assumed_in(groups), lead)
    else:
        from ..write.writers import WRITERS, written

        writer = WRITERS[PLAIN.name if call.output is TABLE else call.output.name]
        for text in written(writer, wanted, blocks, form, doubt=not call.no_doubt):
            sys.stdout.write(text.decode())
        sys.stdout.flush()
    tally = reduce(Tally.plus, tallies, Tally())
    # Some states of a curve may have meaningless numbers even if the curve as a whole is meaningful.
    if single is None or (tally.with_doubts(ENDING_MEANING) and not single.ended):
        notes = notes_below(groups, tally, wanted.reported_doubts, is_table=is_table)
    elif is_table:
        notes = single.sentences
    else:
        notes = _notes_of(single, has_table=False)
    has_more = single is not None and single.has_more_reasons
    for line in lines_of(notes, has_head=is_table, quiet=call.quiet, has_more=has_more):
        say_wrapped(line, sys.stderr)
    return _exit_code(call, tally.failed, tally.rows)


def _notes_of(single: "Report", *, has_table: bool) -> "list[Note]":
    """Return the notes on a single answer; with a table, only the notes that follow it."""
    if has_table:
        return single.sentences_below
    return [*single.notes_on_ranges(), *single.notes, *single.doubts()]  # `lines_of` shows only the first lead


def _exit_code(call: Call, failed: int, count: int, first: JkrollError | None = None) -> int:
    """Return the exit code of rows, and print the number of failed rows, or the error of a single row."""
    if not failed:
        return 0
    message = f"{failed} of {count} rows failed"
    if first and count == 1:
        options = [NOMENCLATURE[name].option for name in call.inputs]
        message = message_of(first, call.command, options)
    say_wrapped(f"jkroll: {message}", sys.stderr)
    return ROWS_FAILED


# --- Answers ----------------------------------------------------------------------------------------------------------


def _write_answers(
    call: Call, answers: "Iterable[Report]", count: int, form: Format, single: "Report | None" = None
) -> int:
    """Write answers one after another; return the exit code.

    `single`: the answer if there is only one. Its notes follow on stderr, except with JSON, `--explain` and `--cite`.
    """
    failures: list[JkrollError] = []

    def watched() -> "Iterator[Report]":
        for answer in answers:
            if answer.failure is not None:
                failures.append(answer.failure)
            yield answer

    with _output(call.target) as out:
        if call.output is JSON:
            from ..write.answered import write_json

            write_json(watched(), count, out, form)
        elif call.output is EXPLAIN:
            from ..write.sources import write_explanation

            write_explanation(watched(), out, form)
        elif call.output is CITE:
            from ..write.sources import write_citations, write_methods

            write_sources = write_methods if call.tex else write_citations
            write_sources(watched(), out)
        elif call.output is TABLE:
            from ..write.table import frame_table

            frame_table(next(watched()), out, form)
        elif call.output is MARKDOWN:
            from ..write.markdown import frame_page

            frame_page(next(watched()), out, form)
        else:
            from ..write.answered import write_plain

            write_plain(next(watched()), out, form, best=call.best)
        out.flush()
    if single is not None and call.output.has_rows:
        notes = _notes_of(single, has_table=call.output.for_readers)
        for line in lines_of(notes, has_more=single.has_more_reasons, quiet=call.quiet):
            say_wrapped(line, sys.stderr)
    return _exit_code(call, len(failures), count, failures[0] if failures else None)


def _output(target: str | None) -> AbstractContextManager[TextIO]:
    """Return the output as a context: stdout, or a file that appears only when it is complete."""
    if target is None:
        return nullcontext(sys.stdout)
    from ..write.output_file import text_output

    return text_output(target)


# --- Force curves -----------------------------------------------------------------------------------------------------


def run_contact(call: Call) -> int:
    """Answer the question of `contact`, or write or draw the force curve; return the exit code."""
    is_drawn = call.curve and call.names_picture
    if is_drawn or call.width is not None or call.style is not None or call.uncaptioned or call.panel:
        from .draw import draw_contact

        return draw_contact(call)
    return _write_curve(call) if call.curve else run_question(call)


def _write_curve(call: Call) -> int:
    """Write the force curve of each frame; return the exit code.

    Raises the error of the first state if all states have errors, judged by an example of each group of frames.
    """
    from ..model.rows import Columns, Wanted
    from ..report.curve import (
        FEW_STEPS,
        FORCE_CURVE,
        STEPS,
        WHOLE_CURVE,
        answer_at_state,
        curve_columns,
        frames_of_curve,
    )
    from ..report.report import Report

    check_format(call)
    question = question_of(call, FORCE_CURVE)
    loads, sweep = call.loads, call.sweep
    form = call.form(question.quantities)
    steps = FEW_STEPS if call.output is TABLE else STEPS
    samples = [*chain.from_iterable(frames_of_curve(frame, loads, steps) for frame in sweep.groups)]
    failure = _failure_of_all(answer_at_state(question, frame) for frame in samples)
    if failure is not None:
        raise failure
    is_table = call.output is TABLE
    states: Iterator[Frame] = chain.from_iterable(frames_of_curve(frame, loads, steps) for frame in sweep.frames())
    if is_table and loads is not None:  # a table shows the states that a load holds
        states = (state for state in states if state.state in HELD_BY_LOAD)
    if call.output is JSON:
        all_states = [*states]
        answers = (answer_at_state(question, state) for state in all_states)
        return _write_answers(call, answers, len(all_states), form)
    names = question.quantities
    if call.output is BARE:
        wanted = Wanted(names, named=names, doubts=not call.quiet, keeps_all=True)
    else:
        has_notes = is_table and len(sweep) == 1  # the notes on one curve replace the codes of its states
        wanted = curve_columns(samples, names, doubts=not has_notes, keeps_all=call.output.keeps_all)
    size = None if is_table else CURVE_BLOCK

    def columns() -> Iterator[Columns]:
        while block := [*islice(states, size)]:
            columns = Columns(wanted, len(block), few=True)
            for row, state in enumerate(block):
                columns.put(row, wanted.results(state))
            yield columns

    curves = [Report(WHOLE_CURVE, frame) for frame in sweep.groups]
    groups = [(curve.frame, [*curve.columns]) for curve in curves]
    single = curves[0] if len(sweep) == 1 and not call.quiet else None
    return _write_columns(call, wanted, groups, columns(), form, is_table=is_table, single=single)


def _failure_of_all(answers: "Iterable[Report]") -> JkrollError | None:
    """Return the error of the first answer if all answers have errors; the first answer without one ends the search."""
    first = None
    for answer in answers:
        if answer.failure is None:
            return None
        first = first or answer.failure
    return first


# --- Other commands ---------------------------------------------------------------------------------------------------


def run_export(call: Call) -> int:
    """Write the contact of a pair as input for a program; return the exit code."""
    from ..report.leads import advice_on_inputs
    from ..report.notes import Note, about_middles, by_severity
    from ..report.report import Report
    from ..write.exports import PROGRAMS, comment_of, with_wrapped_comments

    word = call.subject.casefold()
    programs = [known for name, known in PROGRAMS.items() if word in (name, known.title.casefold())]
    if not programs:
        guess = closest(word, PROGRAMS) or next(iter(PROGRAMS))
        question = f"which program, {', '.join(PROGRAMS)}? Write jkroll export {guess} quartz 100nm"
        raise BadRequest(f"export: {question}; jkroll guide dem says what other codes call γ")
    (program,) = programs
    count = len(call.sweep)
    if count != 1:
        raise BadRequest(f"export takes one pair of spheres, not {count}; for an unequal pair: --radius2")
    frame = next(call.sweep.frames())
    if frame.law.name not in program.models:
        raise BadRequest(f"--model: {program.title} has {listed(program.models)}, not {quoted(frame.law.name)}")
    text = with_wrapped_comments(program.text(frame))
    if call.quiet:
        sys.stdout.write(text)
        return 0
    lacking = frame.missing(program.quantities)
    names = tuple(name for name in program.quantities if name not in lacking)
    answer = Report(Question(names, names), frame)
    ranges = Note("lead", f"best ranges: {answer.best_ranges}")
    lines = [note.line for note in (ranges, *about_middles(answer.uncertain_inputs))]
    lines += [note.line for note in by_severity(answer.every_sentence) if note.severity != "more"]
    if program.about:
        sys.stdout.write(text)
        for line in (*(f"note: {note}" for note in program.about(frame)), *lines):
            say_wrapped(line, sys.stderr)
        return 0
    advice = [*advice_on_inputs(answer)]
    if advice and program.to_write:
        advice.append(f"You must still write your {program.to_write}.")
    for line in advice:
        say(comment_of(line), sys.stdout)
    sys.stdout.write(text)
    for line in lines:
        say(comment_of(line), sys.stdout)
    return 0


def run_infer(call: Call) -> int:
    """Infer inputs for each frame and measured value; return the exit code."""
    from ..model.unknowns import SIZES, inputs_named

    if not call.subject:
        raise BadRequest(f"infer needs an input: one of {', '.join(SIZES)}")
    names = tuple(inputs_named(call.subject.split(",")))
    check_format(call)
    sweep = call.sweep.seeking(names, _measured(call, names))
    return answer_rows(call, sweep, Question(names, names, names), call.form(names))


def _measured(call: Call, names: Sequence[str]) -> dict[str, list[Spread]]:
    """Return the values of the measured quantities; raise BadRequest unless there is one for each unknown."""
    measured: dict[str, list[Spread]] = {}
    for text in call.measured:
        word, has_value, value = text.partition("=")
        if not has_value:
            raise BadRequest("--measured: write a quantity and its value, such as pull_off_force=300nN")
        quantity = quantity_named(word)
        measured[quantity] = spreads_of(value, quantity)
    if not len(call.measured) == len(measured) == len(names):
        example = "--measured pull_off_force=300nN" + " --measured stiffness=1kN/m" * (len(names) - 1)
        wanted = f"infer needs a measured quantity for each input, {len(names)} in all: {example}"
        raise BadRequest(f"{wanted}; separate several values of one quantity by commas")
    return measured


def run_batch(call: Call) -> int:
    """Compute the results of each row of a table; return the exit code."""
    from ..tables.run import Job, run
    from ..tables.table import Asked

    if not call.subject:
        raise BadRequest("batch needs a table, such as grains.csv, or - for standard input")
    for option in (Options.quantities, Options.format, Options.delimiter, Options.dask):
        if not call.given.get(option.name, option.name).strip():
            raise BadRequest(f"{option.flag} is empty")
    infer, measured = _unknown_and_measured(call)
    explicit, offered = quantities_named(call.quantities) if call.quantities else ([], BY_DEFAULT)
    asked = Asked(
        call.inputs,
        call.materials,
        explicit,
        offered,
        columns=call.columns,
        pass_rest=call.pass_rest,
        infer=infer,
        measured=measured,
        doubt=not call.no_doubt,
        best=call.best,
        uncertainty=call.uncertainty,
    )
    job = Job(
        asked,
        target=call.target or "-",
        format=call.format,
        delimiter=call.delimiter,
        strict=call.strict,
        resume=call.resume,
        jobs=call.jobs,
        excel_safe=call.excel_safe,
        dask=call.dask,
        quiet=call.quiet,
    )
    return run(call.subject, job)


def _unknown_and_measured(call: Call) -> tuple[str, str]:
    """Return the names of the unknown input and of the measured quantity; both are empty if nothing is inferred."""
    if not call.infer and not call.measured:
        return "", ""
    if not call.infer or "," in call.infer or len(call.measured) != 1:
        example = "--infer gamma --measured pull_off_force"
        raise BadRequest(f"batch infers one input from one quantity, as in {example}; jkroll infer finds two")
    from ..model.unknowns import inputs_named

    return inputs_named([call.infer])[0], quantity_named(call.measured[0])


def run_materials(call: Call) -> int:
    """List the materials, find them by words, or show some in full; return the exit code."""
    from ..write.catalogue import write_materials

    output, materials = call.output.name, call.materials
    text = " ".join(call.words)
    lists_all = text.casefold() in ("", "all")
    try:
        named = [] if lists_all else [materials[word] for word in text.split(",")]
        chosen = named or [*materials.materials.values()]
    except UnknownMaterial:
        from ..write.manual import materials_with

        named, chosen = [], materials_with(text, materials.materials.values())
        if not chosen:
            raise
    write_materials(chosen, sys.stdout, output, named=bool(named))
    sys.stdout.flush()
    mistakes = materials.mistakes if lists_all else []
    for mistake in mistakes:
        say_wrapped(f"jkroll: {mistake}", sys.stderr)
    return mistakes[0].exit_code if mistakes else 0


def run_quantities(call: Call) -> int:
    """List the quantities, find them by words, or show one in full; search the manual if none is found."""
    from ..write.catalogue import write_quantities
    from ..write.manual import hits_of, quantities_meant, write_hits
    from .commands import commands_taking

    output, text = call.output.name, " ".join(call.words)
    names = quantities_meant(call.words)
    if names:
        write_quantities(names, sys.stdout, output, commands_taking)
        return 0
    hits = hits_of(text, call.materials.materials.values())
    if hits.quantities:
        write_quantities(hits.quantities, sys.stdout, output, commands_taking, most=MOST_FOUND)
    elif output in ("table", "plain"):
        say_wrapped(f"no quantity is called {quoted(text)}; the manual has:", sys.stdout)
        write_hits(text, hits, sys.stdout)
    else:
        raise UnknownQuantity(text)
    if output == "table" and hits.quantities and hits.passages:
        say_wrapped(f"in the manual: jkroll guide {text}", sys.stdout)
    return 0


def run_guide(call: Call) -> int:
    """Show a page of the manual, list the pages, or search them by words; return the exit code."""
    from ..write.manual import hits_of, page, section_meant, topics, write_hits, write_text, write_topics

    text = " ".join(call.words)
    if not call.words:
        write_topics(sys.stdout)
        return 0
    if text in topics():
        write_text(page(text), sys.stdout)
        return 0
    section = section_meant(text)
    if section is not None:
        write_text(section.text, sys.stdout)
    else:
        write_hits(text, hits_of(text, call.materials.materials.values()), sys.stdout)
    return 0


def run_bench(call: Call) -> int:
    """Measure speed against error; return the exit code."""
    from .draw import check_picture, draw_into

    check_picture(call, call.plot, "--plot")  # before anything is measured
    from ..bench.report import FULL, QUICK, picture_of_bench, write_bench

    rows = write_bench(sys.stdout, call.output.name, QUICK if call.quick else FULL)
    if call.plot is not None:
        draw_into(call.plot, picture_of_bench(rows), call)
    return 0
