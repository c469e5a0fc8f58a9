"""Runner of `batch`."""

from ..batch.command import run
from ..batch.settings import Settings
from ..errors import BadRequest
from .options import Call
from .request import materials_of


def run_batch(call: Call) -> int:
    """Convert a table of scenes; return the exit code."""
    if not call.words:
        raise BadRequest("batch needs a table, such as grains.csv, or - for standard input")
    settings = Settings(
        target=call.target or "-",
        format=call.format,
        quantities=call.quantities,
        strict=call.strict,
        doubt=not call.no_doubt,
        uncertainty=call.uncertainty,
        resume=call.resume,
        jobs=call.jobs,
        excel_safe=call.excel_safe,
        dask=call.dask,
        materials=call.materials,
        quiet=call.quiet,
        columns=call.columns,
    )
    return run(call.words[0], settings, call.inputs, materials_of(call.materials))
