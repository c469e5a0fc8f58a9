"""Runner of `export`: the contact of a pair as input of another program."""

import sys
from collections.abc import Sequence

from ..errors import BadRequest
from ..materials.places import materials_files
from ..output.lammps import MODELS, lammps_input
from ..text import quoted, say
from .options import Values
from .request import Request

PROGRAMS = ("lammps",)


def run_export(words: Sequence[str], values: Values) -> int:
    """Write the contact of one pair as the input of a program; return the exit code."""
    program, *described = words or ("",)
    if program.casefold() not in PROGRAMS:
        raise BadRequest(
            f"export: {quoted(program)} is no program that is known; write jkroll export lammps quartz 100nm"
        )
    model = values.model
    if model not in MODELS:
        raise BadRequest(f"--model: LAMMPS has {' and '.join(MODELS)}, not {quoted(model)}")
    request = Request(described, values.inputs, materials_files(values.materials))
    if request.count != 1:
        raise BadRequest(f"export takes one pair of spheres, not {request.count}")
    for line in lammps_input(next(request.scenes()), model):
        say(line, sys.stdout)
    return 0
