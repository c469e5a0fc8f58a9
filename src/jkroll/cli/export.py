"""Runner of `export`: the contact of a pair as input of another program."""

import sys

from ..answers.answer import Answer
from ..answers.notes import about_middles
from ..answers.questions import Question
from ..errors import BadRequest
from ..output.exports import PROGRAMS
from ..output.notes import every_line
from ..quantities.laws import BETWEEN
from ..text import ascii_text, listed, quoted, say, say_wrapped, wrapped
from .call import Call

WIDTH = 120  # of a comment


def run_export(call: Call) -> int:
    """Write the contact of one pair as the input of a program; return the exit code."""
    if not call.subject:
        raise BadRequest("export: which program? write jkroll export lammps quartz 100nm")
    known = {name.replace("-", ""): program for name, program in PROGRAMS.items()}
    program = known.get(call.subject.casefold().replace("-", ""))
    if program is None:
        raise BadRequest(f"export: {quoted(call.subject)} is not among the programs: {', '.join(PROGRAMS)}")
    if (count := len(call.sweep)) != 1:
        raise BadRequest(f"export takes one pair of spheres, not {count}")
    scene = next(call.sweep.scenes())
    if (model := scene.law.name) not in program.models:
        raise BadRequest(f"--model: {program.title} has {listed(program.models)}, not {quoted(model)}")
    say("\n".join(program.lines(scene)), sys.stdout)
    if call.quiet:
        return 0
    lacking = scene.missing(program.quantities)
    names = tuple(name for name in program.quantities if name not in lacking)
    answer = Answer(Question(names, names), scene)
    notes = [*(f"note: {note.text}" for note in about_middles(answer.uncertain)), *every_line(answer)]
    notes = [line.replace(f": --model {BETWEEN}", "") for line in notes]  # a law that no program has
    if program.about:
        for line in (*(f"note: {text}" for text in program.about(scene)), *notes):
            say_wrapped(line, sys.stderr)
    else:
        for line in notes:
            say("\n".join(f"# {part}" for part in wrapped(ascii_text(line), WIDTH, 2)), sys.stdout)
    return 0
