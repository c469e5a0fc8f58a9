"""Runner of `export`: the contact of a pair as input of another program."""

import sys

from ..errors import BadRequest
from ..output.lammps import MODELS, lammps_input
from ..quantities.laws import DEFAULT_LAW
from ..text import quoted, say
from .options import Call
from .request import request_of

PROGRAMS = ("lammps",)


def run_export(call: Call) -> int:
    """Write the contact of one pair as the input of a program; return the exit code."""
    if not call.words:
        raise BadRequest("export: which program? write jkroll export lammps quartz 100nm")
    program, *words = call.words
    if program.casefold() not in PROGRAMS:
        raise BadRequest(f"export: {quoted(program)} is not among the programs: {', '.join(PROGRAMS)}")
    inputs = dict(call.inputs)
    model = inputs.pop("model", DEFAULT_LAW)
    if model not in MODELS:
        raise BadRequest(f"--model: LAMMPS has {' and '.join(MODELS)}, not {quoted(model)}")
    request = request_of(call._replace(words=tuple(words), inputs=inputs))
    if request.count != 1:
        raise BadRequest(f"export takes one pair of spheres, not {request.count}")
    say("\n".join(lammps_input(next(request.scenes()).under(model))), sys.stdout)
    return 0
