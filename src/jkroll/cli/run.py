"""Runners of the commands: from words and option values to printed text and an exit code."""

import sys
from collections.abc import Iterable, Iterator, Sequence
from typing import TYPE_CHECKING, TextIO

from ..answers.answer import Answer, answer, in_units
from ..answers.questions import Question, quantities_named
from ..errors import BadRequest, JkrollError, MissingExtra
from ..materials.library import known_materials
from ..materials.places import materials_files
from ..output.layout import Layout, layout
from ..output.note_lines import NoteLines
from ..output.writers import WRITERS
from ..quantities.formatting import Format
from ..scene.wiring import formula_of
from ..text import quoted, say
from .options import Values
from .request import Request, format_of, request_of

if TYPE_CHECKING:
    from ..answers.curve import Loads

ROWS_FAILED = 1
PICTURES = ("svg", "pdf", "png")
MANY = 20_000  # rows from which on a sweep is streamed by blocks


def format_name(values: Values, out: TextIO) -> str:
    """Return the name of the output format: the one that was chosen, else a table on a terminal and plain lines in a pipe."""
    formats = {
        "bare": values.bare,
        "json": values.json,
        "csv": values.csv,
        "explain": values.explain,
        "cite": values.cite,
    }
    chosen = [name for name, is_chosen in formats.items() if is_chosen]
    if len(chosen) > 1:
        raise BadRequest(f"--{chosen[0]} and --{chosen[1]} exclude each other")
    if chosen:
        return chosen[0]
    return "table" if out.isatty() else "plain"


class Tally:
    """Notes and failures of answers, collected while they are written."""

    def __init__(self) -> None:
        """Begin with no answer."""
        self.notes = NoteLines()
        self.failure: JkrollError | None = None  # the first
        self.failed = 0

    def watch(self, answers: Iterable[Answer]) -> Iterator[Answer]:
        """Iterate over answers, and collect their notes and failures."""
        for one in answers:
            self.notes.add(one)
            if one.failure is not None:
                self.failed += 1
                self.failure = self.failure or one.failure
            yield one


def run_question(question: Question, words: Sequence[str], values: Values) -> int:
    """Answer a question for every scene that was described; return the exit code."""
    out = sys.stdout
    kind = format_name(values, out)
    if values.resume and values.target is None:
        raise BadRequest("--resume needs a file to continue: -o FILE")
    if values.quantities:
        question = question_of(values.quantities)
    form = format_of(values.to, values.digits, question.quantities)
    if values.materials is not None:
        known_materials(*materials_files(values.materials))  # a file that was named is checked, needed or not
    if values.curve:
        return _run_curve(words, values, kind, form)
    request = request_of(words, values)
    if values.quantities:
        _refuse_inputs(question.quantities, request)
    is_streamed = values.target is not None or (kind == "csv" and request.count > MANY)
    samples = [in_units(answer(question, scene), form) for scene in request.samples()] if request.count > 1 else []
    if is_streamed:
        return _run_stream(question, request, samples, kind, values)
    request.check_count()
    if kind not in ("explain", "cite"):
        answers = (in_units(answer(question, scene), form) for scene in request.scenes())
        return write_answers(answers, layout(question, samples, request.count), kind, form, quiet=values.quiet)
    from ..output.citations import write_citations
    from ..output.explain import write_explanation

    tally = Tally()
    write = write_citations if kind == "cite" else write_explanation
    write(
        ((scene, one) for scene in request.scenes() for one in tally.watch([answer(question, scene)])),
        out,
        form,
    )
    out.flush()
    return _say_failures(tally, request.count)


def write_answers(answers: Iterable[Answer], shape: Layout, kind: str, form: Format, *, quiet: bool) -> int:
    """Write answers, and their notes unless these are in them; return the exit code."""
    out = sys.stdout
    tally = Tally()
    watched = tally.watch(answers)
    if shape.size == 1:
        watched = iter([_unless_failed(next(watched), shape.question)])
    WRITERS[kind](watched, out, form, shape)
    out.flush()
    if not quiet and kind != "json":
        _say_all(tally.notes.lines())
    return _say_failures(tally, shape.size)


def question_of(text: str) -> Question:
    """Return the question for the quantities of a list: all of them are its headline."""
    named, offered = quantities_named(text)
    names = tuple(dict.fromkeys((*named, *offered)))
    return Question(names, names)


def _refuse_inputs(names: Iterable[str], request: Request) -> None:
    """Raise BadRequest for a quantity that is not a result of the scenes, but one of their inputs."""
    scene = request.samples()[0]
    for name in names:
        if name in scene.stated or (name in scene.values and formula_of(name) is None):
            raise BadRequest(f"--quantities: {name} is an input here")


def no_picture(flag: str, path: str) -> BadRequest:
    """Return the error for a file name whose ending is not that of a picture."""
    return BadRequest(f"{flag}: {quoted(path)} does not end in .{', .'.join(PICTURES[:-1])} or .{PICTURES[-1]}")


def ending(path: str) -> str:
    """Return the ending of a file name, in lower case."""
    return path.rpartition(".")[2].casefold()


def _run_stream(question: Question, request: Request, samples: list[Answer], kind: str, values: Values) -> int:
    """Write a sweep of any length to a file, or as CSV to a pipe; return the exit code."""
    from ..batch.settings import Settings
    from ..batch.sweep import Axis, Sweep, stream

    if values.target and ending(values.target) in PICTURES:
        raise BadRequest(f"-o: {quoted(values.target)} is a picture; add --curve to contact, or see jkroll map --help")
    if values.to or values.digits or kind not in ("csv", "plain", "table"):
        raise BadRequest("a long sweep is written in SI units with all digits: -o and long ranges take --csv alone")
    samples = samples or [answer(question, scene) for scene in request.samples()]
    axes = [Axis(name, spreads) for name, spreads in request.spreads.items()]
    sweep = Sweep(request.pairs, axes, request.models, layout(question, samples, request.count), request.materials)
    tally = stream(sweep, Settings(target=values.target or "-", resume=values.resume, quiet=values.quiet))
    if not values.quiet:
        notes = NoteLines()
        for one in samples:
            notes.add(one)
        _say_all(notes.lines(with_rows=False))
    if tally.failed:
        say(f"jkroll: {tally.failed} of {tally.rows} rows failed", sys.stderr)
        return ROWS_FAILED
    return 0


def curve_request(words: Sequence[str], values: Values) -> "tuple[Request, Loads | None]":
    """Return the scenes of which a force curve is wanted, and its loads if they are given."""
    from ..answers.curve import loads_of

    inputs = dict(values.inputs)
    loads = inputs.pop("load", None)
    if "approach_at_load" in inputs:
        raise BadRequest("--curve goes through all approaches; it takes none")
    return request_of(words, values._replace(inputs=inputs)), loads_of(loads) if loads is not None else None


def _run_curve(words: Sequence[str], values: Values, kind: str, form: Format) -> int:
    """Write the force curve of every scene; return the exit code."""
    from ..answers.curve import CURVE, curve, states

    if kind in ("explain", "cite"):
        raise BadRequest(f"--curve and --{kind} exclude each other")
    request, loads = curve_request(words, values)
    tally = Tally()
    samples = [row for _, row in curve(request.samples(), loads)]
    if samples[0].failure is not None and all(row.failure is not None for row in samples):
        raise samples[0].failure
    count = sum(len(states(scene, loads)) for scene in request.scenes())
    shape = layout(CURVE, samples, count)
    WRITERS[kind](
        tally.watch(in_units(row, form) for _, row in curve(request.scenes(), loads)), sys.stdout, form, shape
    )
    sys.stdout.flush()
    return _say_failures(tally, count)


def _say_failures(tally: Tally, count: int) -> int:
    """Print how many rows failed, if any did; return the exit code."""
    if not tally.failed:
        return 0
    say(f"jkroll: {tally.failure if count == 1 else f'{tally.failed} of {count} rows failed'}", sys.stderr)
    return ROWS_FAILED


def _unless_failed(one: Answer, question: Question) -> Answer:
    """Return the answer of a single scene, or raise its failure if it lacks the headline of the question."""
    if one.failure is not None and all(one.value(name) is None for name in question.headline):
        raise one.failure
    return one


def _say_all(lines: Iterable[str]) -> None:
    """Print lines on stderr."""
    for line in lines:
        say(line, sys.stderr)


def run_materials(words: Sequence[str], values: Values) -> int:
    """List the materials, or show one in full; return the exit code."""
    from ..output.catalogue import write_materials

    out = sys.stdout
    kind = format_name(values, out)
    materials = known_materials(*materials_files(values.materials))
    shows_one = bool(words) and words[0] != "all"
    chosen = [materials[words[0]]] if shows_one else list(materials.materials.values())
    write_materials(chosen, out, kind, whole=shows_one)
    if not values.quiet:
        _say_all(f"note: {material.name}: {text}" for material in chosen for text in material.remarks)
    return 0


def run_quantities(words: Sequence[str], values: Values) -> int:
    """List quantities, those that have some words, or one in full; return the exit code."""
    from ..output.glossary import quantities_found, write_quantities

    write_quantities(quantities_found(words), sys.stdout, format_name(values, sys.stdout))
    return 0


def run_guide(words: Sequence[str], _values: Values) -> int:
    """Show a page of the manual, or list its topics; return the exit code."""
    from ..output.manual import write_page, write_topics

    if words:
        write_page(words[0], sys.stdout)
    else:
        write_topics(sys.stdout)
    return 0


def run_verify(_words: Sequence[str], values: Values) -> int:
    """Compute the audit of the paper; return 1 if a verdict is not the expected one."""
    from ..audit.verify import write_verification

    code = write_verification(sys.stdout, format_name(values, sys.stdout))
    sys.stdout.flush()
    return code


def run_bench(_words: Sequence[str], values: Values) -> int:
    """Measure speed against error; return the exit code."""
    from ..bench.report import write_bench

    if values.plot is not None and ending(values.plot) not in PICTURES:
        raise no_picture("--plot", values.plot)
    try:
        code = write_bench(sys.stdout, format_name(values, sys.stdout), quick=values.quick, plot=values.plot)
    except ModuleNotFoundError as error:
        raise MissingExtra(error.name or "", "plot" if values.plot else "bench") from None
    sys.stdout.flush()
    return code


def run_batch(words: Sequence[str], values: Values) -> int:
    """Convert a table of scenes; return the exit code."""
    from ..batch.command import run
    from ..batch.settings import Settings

    if not words:
        raise BadRequest("batch needs a table, such as grains.csv, or - for standard input")
    settings = Settings(
        target=values.target or "-",
        format=values.format,
        quantities=values.quantities,
        strict=values.strict,
        doubt=not values.no_doubt,
        uncertainty=values.uncertainty,
        resume=values.resume,
        jobs=values.jobs,
        excel_safe=values.excel_safe,
        dask=values.dask,
        materials=values.materials,
        quiet=values.quiet,
    )
    return run(words[0], settings, values.inputs)
