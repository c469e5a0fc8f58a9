"""The output of tables and of sweeps: a stream, or a file that gets its name when it is whole."""

import os
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from typing import BinaryIO

from ..errors import BadRequest
from ..output.records import whole_file
from ..text import quoted, say
from .formats import Format


@contextmanager
def output_to(target: str) -> Iterator[BinaryIO]:
    """Open the output of `-o`: stdout, a device or a pipe, or a file that appears when it is whole."""
    if target == "-":
        sys.stdout.flush()
        with open(os.dup(sys.stdout.fileno()), "wb") as stream:
            yield stream
        return
    if os.path.isdir(target):
        raise BadRequest(
            f"-o: {quoted(target)} is a directory; {quoted(target + os.sep)} is where a file for each table goes"
        )
    with whole_file(target) as stream:
        yield stream


def unnamed(target: str, kind: str, *, quiet: bool) -> Format:
    """Return the format of an output whose name says none, and say which one it is where the name ends as if it said one."""
    if os.path.splitext(target)[1] and not quiet:
        say(f"note: {quoted(target)} is written as {kind}: its name says no format", sys.stderr)
    return Format(kind)
