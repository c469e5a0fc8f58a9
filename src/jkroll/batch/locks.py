"""The files beside an output: opened, locked, and told from files of the user's."""

import errno
import os
import stat
import sys
import time
from contextlib import suppress

from ..errors import BadRequest
from ..text import quoted, say
from .errors import BadTable

MARK = "jkroll journal"  # key in the first line of a journal: the file is ours
LOCK_SECONDS = 10.0  # the processes of a run that was killed end within a block


def refuse_foreign(partial: str, journal: str) -> None:
    """Raise BadRequest if a file that the run would write beside the output is not jkroll's."""
    is_ours = True
    with suppress(OSError), open(journal, "rb") as file:
        first = file.readline(1000)
        is_ours = first.startswith(b'{"%b"' % MARK.encode()) or not first
        if is_ours and first:
            return
    for path, is_foreign in ((journal, not is_ours), (partial, os.path.isfile(partial) and os.path.getsize(partial))):
        if is_foreign:
            raise BadRequest(f"-o: {quoted(path)} would be overwritten, and jkroll did not write it; move it away")


def opened(path: str) -> int:
    """Open a file to append to; BadTable for a link or what is no file."""
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


def locked(path: str) -> int:
    """Open and lock a file to append to. While it is waited for, another run may give it its name: then it is a new one."""
    give_up = time.monotonic() + LOCK_SECONDS
    while True:
        descriptor = opened(path)
        try:
            _lock(descriptor, path)
            with suppress(FileNotFoundError):
                if os.path.samestat(os.fstat(descriptor), os.stat(path)):
                    return descriptor
            os.close(descriptor)
        except BlockingIOError:
            os.close(descriptor)
            if time.monotonic() > give_up:
                raise BadTable(f"{quoted(path)} is being written by another run") from None
            time.sleep(0.02)


_UNSUPPORTED = (errno.ENOLCK, errno.ENOSYS, errno.ENOTSUP, errno.EOPNOTSUPP, errno.EINVAL)


def _lock(descriptor: int, path: str) -> None:
    """Lock a file; where the system has no locks, say so. Raises BlockingIOError."""
    try:
        from fcntl import LOCK_EX, LOCK_NB, flock

        flock(descriptor, LOCK_EX | LOCK_NB)
    except BlockingIOError:
        raise
    except (ImportError, OSError) as error:
        if isinstance(error, OSError) and error.errno not in _UNSUPPORTED:
            raise
        say(f"note: {quoted(path)} cannot be locked here; let no other run write it", sys.stderr)
