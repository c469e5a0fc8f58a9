"""A sweep of any length as Parquet."""

from typing import Any

import numpy
import pyarrow

from ..quantities.nomenclature import NOMENCLATURE, header
from .lines import Converted
from .pieces import BYTES, ROWS, as_column, as_texts, rows_of_piece, write
from .settings import Settings, Tally
from .source import Shared
from .sweep import Evaluators, Rows, Sweep


def write_sweep(sweep: Sweep, settings: Settings, shared: Shared) -> Tally:
    """Write all rows."""
    pieces = _Pieces(sweep, shared)
    identity = sweep.identity(pyarrow.__version__, ROWS, BYTES)
    write(settings, shared, pieces.schema, identity, pieces, pieces.convert, sweep.size)
    return Tally(shared["rows"], shared["failed"])


class _Pieces:
    """Pieces that are nothing but where they begin and end."""

    def __init__(self, sweep: Sweep, shared: Shared) -> None:
        self.sweep, self.shared = sweep, shared
        self.evaluators = Evaluators(sweep)
        materials = [name for name in sweep.shape.inputs if not NOMENCLATURE[name].unit]
        self.schema = pyarrow.schema(
            [
                *(pyarrow.field(name, pyarrow.string()) for name in materials),
                *(pyarrow.field(header(name), pyarrow.float64()) for name in (*sweep.inputs, *sweep.results)),
            ]
        )
        self.rows = rows_of_piece(8 * len(self.schema))

    def next(self) -> bytes | None:
        """The next piece."""
        start = self.shared["read"]
        if start >= self.sweep.size:
            return None
        end = self.shared["read"] = min(start + self.rows, self.sweep.size)
        return b"%d %d" % (start, end)

    def convert(self, text: bytes) -> Converted:
        """The rows of a piece."""
        start, end = map(int, text.split())
        place, failed = start, 0
        batches: list[Any] = []
        while place < end:
            rows = self.evaluators.rows(place, min(self.sweep.block(place), end - place))
            batches.append(self._batch(rows))
            place, failed = place + rows.size, failed + rows.failed
        return Converted(pyarrow.Table.from_batches(batches, self.schema), end - start, failed, end - start, None)

    def _batch(self, rows: Rows) -> Any:
        """Rows as columns."""
        columns = [
            numpy.full(rows.size, numpy.nan if one is None else one) if not isinstance(one, numpy.ndarray) else one
            for one in rows.inputs
        ]
        arrays = [as_column(values) for values in [*columns, *rows.results]]
        names = [as_texts([name] * rows.size) for name in rows.materials]
        return pyarrow.RecordBatch.from_arrays([*names, *arrays], schema=self.schema)
