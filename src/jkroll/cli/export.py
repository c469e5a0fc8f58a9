"""Runner of `export`: the contact of a pair as input of another program."""

import sys
from collections.abc import Callable, Iterator, Mapping
from typing import NamedTuple

from ..answers.answer import Answer
from ..answers.questions import Question
from ..errors import BadRequest
from ..output.exports import (
    ABOUT_DUST_SIMULATION,
    MODELS,
    QUANTITIES,
    THRESHOLDS,
    dust_simulation_material,
    lammps_input,
    liggghts_input,
)
from ..output.notes import every_line
from ..quantities.laws import DEFAULT_LAW
from ..scene.scene import Scene
from ..text import ascii_text, quoted, say, say_wrapped, wrapped
from .commands import Call
from .request import request_of

WIDTH = 120  # of a comment


class Program(NamedTuple):
    """A program that takes contacts: its title, how its input is written, the quantities in it, and the laws it has."""

    title: str
    lines: Callable[[Scene], Iterator[str]]
    quantities: tuple[str, ...]
    models: tuple[str, ...] = (DEFAULT_LAW,)
    note: str = ""  # on the input, which has no comments: all that is to be said goes to stderr


PROGRAMS: Mapping[str, Program] = {
    "lammps": Program("LAMMPS", lammps_input, (*QUANTITIES, *THRESHOLDS), MODELS),
    "liggghts": Program("LIGGGHTS", liggghts_input, ("pull_off_force", "time_step")),
    "dust-simulation": Program(
        "DustSimulation", dust_simulation_material, (*QUANTITIES, *THRESHOLDS), note=ABOUT_DUST_SIMULATION
    ),
}


def run_export(call: Call) -> int:
    """Write the contact of one pair as the input of a program; return the exit code."""
    if not call.words:
        raise BadRequest("export: which program? write jkroll export lammps quartz 100nm")
    word, *words = call.words
    program = PROGRAMS.get(word.casefold())
    if program is None:
        raise BadRequest(f"export: {quoted(word)} is not among the programs: {', '.join(PROGRAMS)}")
    inputs = dict(call.inputs)
    model = inputs.pop("model", DEFAULT_LAW).casefold()
    if model not in program.models:
        raise BadRequest(f"--model: {program.title} has {' and '.join(program.models)}, not {quoted(model)}")
    request = request_of(call._replace(words=tuple(words), inputs=inputs))
    if (count := len(request.sweep)) != 1:
        raise BadRequest(f"export takes one pair of spheres, not {count}")
    scene = next(request.sweep.scenes()).under(model)
    say("\n".join(program.lines(scene)), sys.stdout)
    if call.quiet:
        return 0
    lacking = scene.missing(program.quantities)
    names = tuple(name for name in program.quantities if name not in lacking)
    notes = every_line(Answer(Question(names, names), scene))
    if program.note:
        for line in (f"note: {program.note}", *notes):
            say_wrapped(line, sys.stderr)
    else:
        for line in notes:
            say("\n".join(f"# {part}" for part in wrapped(ascii_text(line), WIDTH, 2)), sys.stdout)
    return 0
