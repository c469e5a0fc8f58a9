"""The sizes at which the program works in another way, changed for a test: no other file of tests knows them.

Few rows are computed as numbers, many as arrays in blocks; a large table is read in chunks by several processes.
"""

from collections.abc import Iterator
from contextlib import ExitStack, contextmanager
from unittest.mock import patch

from jkroll.model import rows, sweep
from jkroll.quantities.nomenclature import INFINITY
from jkroll.tables import files, run


@contextmanager
def computed(*, by_arrays: bool, block: int = 5) -> Iterator[None]:
    """Compute rows of lists as arrays, `block` at a time, or as numbers, however many they are."""
    with ExitStack() as stack:
        for kind in ("COMPUTED", "SEARCHED"):
            sizes = getattr(sweep, kind)._replace(few=-1 if by_arrays else INFINITY)
            stack.enter_context(patch.object(sweep, kind, sizes))
        stack.enter_context(patch.object(rows, "BLOCK", block))
        yield


@contextmanager
def tables_on_a_terminal(most: int) -> Iterator[None]:
    """Show at most some rows as a table, and more of them as lines."""
    with patch.object(sweep, "COMPUTED", sweep.COMPUTED._replace(most_in_table=most)):
        yield


@contextmanager
def read_in_chunks(size: int) -> Iterator[None]:
    """Read tables in chunks of some bytes, and leave all but the first to other processes."""
    with patch.object(files, "CHUNK", size), patch.object(run, "ALONE", 1):
        yield
