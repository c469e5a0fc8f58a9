"""A sweep of any length as Parquet."""

from collections.abc import Iterator
from typing import Any

import numpy
import pyarrow

from ..nomenclature import NOMENCLATURE, header
from .pieces import NUMBERS, PIECE, Group, as_column, rows_of_group, write
from .settings import Settings, Tally
from .source import Shared
from .sweep import Evaluators, Rows, Sweep


def write_sweep(sweep: Sweep, settings: Settings, shared: Shared) -> Tally:
    """Write all rows."""
    pieces = _Pieces(sweep, shared)
    write(settings, shared, pieces.schema, sweep.identity(pyarrow.__version__, PIECE, NUMBERS), pieces)
    return Tally(shared["rows"], shared["failed"])


class _Pieces:
    """Pieces that are nothing but where they begin and end."""

    def __init__(self, sweep: Sweep, shared: Shared) -> None:
        self.sweep, self.shared, self.total = sweep, shared, sweep.size
        self.evaluators = Evaluators(sweep)
        materials = [name for name in sweep.shape.inputs if not NOMENCLATURE[name].unit]
        self.schema = pyarrow.schema(
            [
                *(pyarrow.field(name, pyarrow.string()) for name in materials),
                *(pyarrow.field(header(name), pyarrow.float64()) for name in (*sweep.inputs, *sweep.results)),
            ]
        )

    def next(self) -> bytes | None:
        """The next piece."""
        start = self.shared["read"]
        if start >= self.total:
            return None
        end = self.shared["read"] = min(start + PIECE, self.total)
        return b"%d %d" % (start, end)

    def groups(self, text: bytes) -> Iterator[Group]:
        """The rows of a piece."""
        start, end = map(int, text.split())
        wanted = rows_of_group(len(self.schema))
        parts: list[Group] = []
        while start < end:
            count = min(self.sweep.block(start), end - start)
            rows = self.evaluators.rows(start, count)
            parts.append(Group(self._batch(rows), rows.failed))
            start += count
            if start == end or sum(part.batch.num_rows for part in parts) >= wanted:
                table = pyarrow.Table.from_batches([part.batch for part in parts])
                yield Group(table.combine_chunks().to_batches()[0], sum(part.failed for part in parts))
                parts = []

    def _batch(self, rows: Rows) -> Any:
        """Rows as columns."""
        columns = [
            numpy.full(rows.size, numpy.nan if one is None else one) if not isinstance(one, numpy.ndarray) else one
            for one in rows.inputs
        ]
        arrays = [as_column(values) for values in [*columns, *rows.results]]
        names = [pyarrow.array([name] * rows.size) for name in rows.materials]
        return pyarrow.RecordBatch.from_arrays([*names, *arrays], schema=self.schema)
