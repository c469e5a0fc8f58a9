"""A journal: lines of JSON beside a file, added while the file is made. A run that was ended goes on from them.

The first line says that jkroll wrote it. It is locked, so that two runs never make the same file. A line that is not whole, and
what stands after it, does not count: the run was ended while it was written.
"""

import errno
import json
import os
import stat
import sys
from collections.abc import Mapping
from contextlib import suppress
from functools import lru_cache
from itertools import islice
from typing import Any

from ..errors import BadRequest
from ..table.errors import BadTable
from ..text import quoted, say

MARK = "jkroll journal"  # key in the first line


class Journal:
    """The journal of a file."""

    def __init__(self, target: str, *beside: str) -> None:
        """Open and lock it. Raises BadTable if another run has it, BadRequest if it or a file beside it is not jkroll's."""
        self.path = f"{target}.journal"
        self.has_begun = self._is_own(beside)  # whether a run that was ended left something
        self._descriptor = opened(self.path)
        try:
            _lock(self._descriptor, self.path)
        except BadTable:
            os.close(self._descriptor)
            raise

    def _is_own(self, beside: tuple[str, ...]) -> bool:
        """Return whether it is jkroll's, or False if there is none. Raises BadRequest."""
        first = b""
        if os.path.isfile(self.path):  # a pipe would wait for a writer
            with suppress(OSError), open(self.path, "rb") as file:
                first = file.readline(1000)
        if first.startswith(b'{"%b"' % MARK.encode()):
            return True
        for path in (self.path, *beside):
            if os.path.isfile(path) and os.path.getsize(path):
                raise BadRequest(f"-o: {quoted(path)} would be overwritten, and jkroll did not write it; move it away")
        return False

    def begin(self, about: Mapping[str, str]) -> None:
        """Begin anew, with a line about the run."""
        os.ftruncate(self._descriptor, 0)
        self.add({MARK: 1, **about})

    def add(self, *entries: Any) -> None:
        """Add lines."""
        os.write(self._descriptor, b"".join(json.dumps(entry).encode() + b"\n" for entry in entries))

    def lines(self) -> list[Any]:
        """Return what the whole lines say, the first of them about the run."""
        found: list[Any] = []
        with open(self.path, "rb") as file, suppress(ValueError):
            for line in file:
                if not line.endswith(b"\n"):
                    break
                found.append(json.loads(line))
        return found

    def keep(self, count: int) -> None:
        """Take away what stands after the first lines: all at once, so that a run can be ended at any moment."""
        with open(self.path, "rb") as file:
            os.ftruncate(self._descriptor, sum(map(len, islice(file, count))))

    def remove(self) -> None:
        """Remove it: the file is whole."""
        os.unlink(self.path)

    def close(self) -> None:
        """Close it, and give up the lock with it."""
        os.close(self._descriptor)


def opened(path: str) -> int:
    """Open a file to append to. Raises BadTable for a link, or for anything but a regular file."""
    flags = os.O_RDWR | os.O_CREAT | os.O_APPEND | getattr(os, "O_NOFOLLOW", 0) | getattr(os, "O_BINARY", 0)
    try:
        descriptor = os.open(path, flags, 0o666)
    except OSError as error:
        if error.errno == errno.ELOOP:
            raise BadTable(f"{quoted(path)} is a link; nothing is written through it") from None
        raise
    if not stat.S_ISREG(os.fstat(descriptor).st_mode):
        os.close(descriptor)
        raise BadTable(f"{quoted(path)} is no file")
    return descriptor


def _lock(descriptor: int, path: str) -> None:
    """Lock a file; where the system has no locks, say so. Raises BadTable if another run has it."""
    try:
        from fcntl import LOCK_EX, LOCK_NB, flock

        flock(descriptor, LOCK_EX | LOCK_NB)
        if os.path.samestat(os.fstat(descriptor), os.stat(path)):
            return
    except (BlockingIOError, FileNotFoundError):
        pass  # the other run has it, or has just removed it
    except (ImportError, OSError):
        _say_unlocked(os.path.dirname(path))
        return
    raise BadTable(f"{quoted(path)} is being written by another run")


@lru_cache(maxsize=1)  # once for all files of a directory
def _say_unlocked(directory: str) -> None:
    say(f"note: files in {quoted(directory or '.')} cannot be locked; let no other run write them", sys.stderr)
