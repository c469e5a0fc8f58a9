"""Runner of the commands that ask a question of scenes: from a call to printed answers and an exit code."""

import sys
from collections.abc import Iterable, Iterator

from ..answers.answer import Answer, answer, in_units
from ..answers.questions import QUESTIONS, Question, quantities_named
from ..errors import ROWS_FAILED, BadRequest, JkrollError
from ..materials.library import known_materials
from ..materials.places import materials_files
from ..output.layout import Layout, layout
from ..output.note_lines import NoteLines
from ..output.writers import WRITERS
from ..quantities.formatting import Format
from ..scene.wiring import formula_of
from ..text import say, say_wrapped
from .options import Call
from .request import Request, request_of
from .written import format_name, format_of

MANY = 20_000  # rows from which on a sweep is streamed by blocks


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

    def exit_code(self, count: int) -> int:
        """Print how many of `count` rows failed, if any did; return the exit code."""
        if not self.failed:
            return 0
        say(f"jkroll: {self.failure if count == 1 else f'{self.failed} of {count} rows failed'}", sys.stderr)
        return ROWS_FAILED


def run_question(call: Call) -> int:
    """Answer the question of a command for every scene that was described; return the exit code."""
    question, kind, form = checked(call)
    request = request_of(call)
    if call.quantities:
        _refuse_inputs(question, request)
    is_streamed = call.target is not None or (kind == "csv" and request.count > MANY)
    if is_streamed:
        from .long_sweep import write_sweep

        return write_sweep(question, request, kind, call)
    request.check_count()
    if kind in ("explain", "cite"):
        return _write_sources(question, request, kind, form)
    answers: Iterable[Answer] = (in_units(answer(question, scene), form) for scene in request.scenes())
    if request.count == 1:
        answers = samples = [*answers]
    else:
        samples = [in_units(answer(question, scene), form) for scene in request.samples()]
    return write_answers(answers, layout(question, samples, request.count), kind, form, quiet=call.quiet)


def checked(call: Call) -> tuple[Question, str, Format]:
    """Return the question of a call, and the name and the units of the output format; raise BadRequest for a mistake."""
    kind = format_name(call)
    if call.resume and call.target is None:
        raise BadRequest("--resume needs a file to continue: -o FILE")
    question = question_of(call)
    form = format_of(call, question.quantities)
    if call.materials is not None:
        known_materials(*materials_files(call.materials))  # a file that was named is checked, needed or not
    return question, kind, form


def question_of(call: Call) -> Question:
    """Return the question of the command, or of the quantities that `--quantities` lists: all of them are its headline."""
    if not call.quantities:
        return QUESTIONS[call.command]
    named, offered = quantities_named(call.quantities)
    names = tuple(dict.fromkeys((*named, *offered)))
    return Question(names, names, named=tuple(named))


def _refuse_inputs(question: Question, request: Request) -> None:
    """Raise BadRequest for a quantity that is not a result of the scenes, but one of their inputs."""
    scene = request.samples()[0]
    for name in question.quantities:
        if name in scene.stated or (name in scene.values and formula_of(name) is None):
            raise BadRequest(f"--quantities: {name} is an input here")


def write_answers(answers: Iterable[Answer], shape: Layout, kind: str, form: Format, *, quiet: bool) -> int:
    """Write answers, and their notes unless these are in them; return the exit code."""
    tally = Tally()
    watched = tally.watch(answers)
    if shape.size == 1:
        watched = iter([_unless_failed(next(watched), shape.question)])
    WRITERS[kind](watched, sys.stdout, form, shape)
    sys.stdout.flush()
    if not quiet and kind != "json":
        for line in tally.notes.lines():
            say_wrapped(line, sys.stderr)
    return tally.exit_code(shape.size)


def _unless_failed(one: Answer, question: Question) -> Answer:
    """Return the answer of a single scene, or raise its failure if it lacks the headline of the question."""
    if one.failure is not None and all(one.value(name) is None for name in question.headline):
        raise one.failure
    return one


def _write_sources(question: Question, request: Request, kind: str, form: Format) -> int:
    """Write the derivations of results or their BibTeX entries; return the exit code."""
    from ..output.citations import write_citations
    from ..output.explain import write_explanation

    tally = Tally()
    write = write_citations if kind == "cite" else write_explanation
    pairs = ((scene, one) for scene in request.scenes() for one in tally.watch([answer(question, scene)]))
    write(pairs, sys.stdout, form)
    sys.stdout.flush()
    return tally.exit_code(request.count)
