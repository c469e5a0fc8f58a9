"""The sizes at which the program changes its way of working, set for a test.

Few rows are computed as floats, and many rows as arrays in blocks; several processes read a large table in chunks.
"""

from collections.abc import Iterator
from contextlib import ExitStack, contextmanager
from unittest.mock import patch

from jkroll.model import rows, sweep
from jkroll.quantities.nomenclature import INFINITY
from jkroll.tables import files, run


@contextmanager
def computed(*, by_arrays: bool, block: int = 5) -> Iterator[None]:
    """Compute the rows of lists as arrays of `block` rows, or as floats, whatever the number of rows."""
    with ExitStack() as stack:
        for kind in ("COMPUTED", "SEARCHED"):
            sizes = getattr(sweep, kind)._replace(few=-1 if by_arrays else INFINITY)
            stack.enter_context(patch.object(sweep, kind, sizes))
        stack.enter_context(patch.object(rows, "BLOCK", block))
        yield


@contextmanager
def tables_on_a_terminal(most: int) -> Iterator[None]:
    """Show at most some rows as a table, and more rows as lines."""
    with patch.object(sweep, "COMPUTED", sweep.COMPUTED._replace(most_in_table=most)):
        yield


@contextmanager
def read_in_chunks(size: int) -> Iterator[None]:
    """Read tables in chunks of some bytes, all but the first in other processes."""
    with patch.object(files, "CHUNK", size), patch.object(run, "ALONE", 1):
        yield
