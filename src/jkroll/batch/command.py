"""The `batch` command: from what was typed to the exit code."""

import sys
from collections.abc import Mapping

from ..materials.library import known_materials
from ..materials.places import materials_files
from ..text import say
from .columns import STATUS
from .errors import missing_extra
from .parts import Runner, is_many, one_by_one
from .parts import convert as convert_parts
from .settings import Order, Settings, input_format

ROWS_FAILED = 1


def run(path: str, settings: Settings, inputs: Mapping[str, str]) -> int:
    """Convert a table; return the exit code."""
    files = materials_files(settings.materials)
    order = Order(settings, inputs, known_materials(*files))
    order.known.materials  # noqa: B018  a table may name any of them
    if is_many(path, settings):
        tally = convert_parts(path, settings, inputs, files, _runner(settings))
    elif input_format(path, settings).kind == "parquet":
        with missing_extra("parquet"):
            from .parquet import convert as convert_parquet
        tally = convert_parquet(path, order)
    else:
        from .stream import convert

        tally = convert(path, order)
    if tally.failed:
        say(f"jkroll: {tally.failed} of {tally.rows} rows failed; column {STATUS} says why", sys.stderr)
        return ROWS_FAILED
    return 0


def _runner(settings: Settings) -> Runner:
    """What converts several tables: this process, or a cluster."""
    if not settings.dask:
        return one_by_one
    with missing_extra("dask"):
        from .cluster import on_cluster
    return on_cluster(settings.dask, settings.processes)
