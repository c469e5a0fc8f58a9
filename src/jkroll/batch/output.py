"""Where the results go: beside the file they are to become, under its name only once they are whole.

A journal says after every block how far input and output came, with a checksum of the input; `--resume` goes on from there
if input, options and version are the same. Both are locked, so that two runs never write the same file.
"""

import errno
import fcntl
import hashlib
import json
import os
import stat
import time
from collections.abc import Mapping
from contextlib import suppress
from typing import Any, NamedTuple, Protocol
from zlib import crc32

from ..text import quoted
from .errors import BadRow, BadTable, NotTheSame
from .files import BESIDE
from .lines import Converted
from .source import Shared

LOCK_SECONDS = 10.0  # the processes of a run that was killed end on their own within a block


class Progress(NamedTuple):
    """How far a run came: bytes of the output, rows, failed rows, lines, and the checksum of the last block read."""

    written: int
    rows: int
    failed: int
    lines: int
    checksum: int


class Blocks(Protocol):
    """What comes in blocks, the same ones every time."""

    def next(self) -> bytes | None:
        """The next block; None at the end."""


def fingerprint(parts: Mapping[str, Any]) -> dict[str, str]:
    """What identifies a run: a hash of each of its parts."""
    return {
        name: hashlib.sha256(json.dumps(value, sort_keys=True, default=str).encode()).hexdigest()[:32]
        for name, value in parts.items()
    }


class Sink:
    """A stream that takes what blocks became, in their order."""

    def __init__(self, descriptor: int, shared: Shared, *, strict: bool) -> None:
        """`strict`: no row may fail."""
        self.descriptor = descriptor
        self.shared = shared
        self.strict = strict

    def head(self, text: bytes, output: Any, lines: int) -> None:
        """Write what stands before the first row. `text` is what it was."""
        self.append(output)
        self.done(text, lines=lines)

    def write(self, text: bytes, converted: Converted) -> None:
        """Write the next block. `text` is what it was."""
        if self.strict and converted.first_failure is not None:
            line, status = converted.first_failure
            raise BadRow(self.shared["lines"] + 1 + line, status)
        self.append(converted.output)
        self.done(text, rows=converted.rows, failed=converted.failed, lines=converted.lines)

    def append(self, output: bytes) -> None:
        """Write bytes that belong to the next block."""
        rest = memoryview(output)
        while rest:
            rest = rest[os.write(self.descriptor, rest) :]
        self.shared["written"] += len(output)

    def done(self, text: bytes, **counts: int) -> None:
        """Count a block that was written: its rows, those that failed, its lines. `text` is what it was."""
        for name, count in counts.items():
            self.shared[name] += count
        self._note(text)

    def _note(self, text: bytes) -> None:
        """A block was written."""

    def finish(self) -> None:
        """Nothing more comes."""

    def close(self) -> None:
        """Let go of what is open: another run may go on."""
        os.close(self.descriptor)


class FileSink(Sink):
    """A file that appears under its name when it is whole."""

    def __init__(self, path: str, shared: Shared, *, strict: bool) -> None:
        """Open and lock what is written beside."""
        self.path = path
        self.partial, self.journal_path = (path + end for end in BESIDE)
        super().__init__(_locked(self.partial), shared, strict=strict)
        try:
            self.journal = _opened(self.journal_path)
        except (OSError, BadTable):
            super().close()
            raise

    def begin(self, identity: Mapping[str, str]) -> None:
        """Begin anew."""
        os.ftruncate(self.journal, 0)
        os.ftruncate(self.descriptor, 0)
        os.write(self.journal, json.dumps(identity).encode() + b"\n")

    def _note(self, text: bytes) -> None:
        """Note that a block was written."""
        shared = self.shared
        progress = (shared["written"], shared["rows"], shared["failed"], shared["lines"], crc32(text))
        os.write(self.journal, (" ".join(map(str, progress)) + "\n").encode())

    def _lines(self) -> tuple[bytes, list[bytes]]:
        """The first line of the journal, and the others that are whole."""
        with open(self.journal_path, "rb") as file:
            return file.readline(), [line for line in file if line.endswith(b"\n")]

    def noted(self) -> list[Progress]:
        """How far the run came, block by block."""
        return [Progress(*map(int, line.split())) for line in self._lines()[1]]

    def resume(self, identity: Mapping[str, str], head: bytes, source: Blocks) -> bool:
        """Go to where the run that was interrupted came to; False if there is nothing to go on from."""
        first, noted = self._lines()
        size = os.fstat(self.descriptor).st_size
        if not first.endswith(b"\n") or not noted:
            return False
        before = json.loads(first)
        for name, value in identity.items():
            if before.get(name) != value:
                raise NotTheSame(quoted(self.partial), name)
        steps = [step for step in (Progress(*map(int, line.split())) for line in noted) if step.written <= size]
        if not steps:
            return False
        if crc32(head) != steps[0].checksum:
            raise NotTheSame(quoted(self.partial), "input")
        for step in steps[1:]:
            text = source.next()
            if text is None or crc32(text) != step.checksum:
                raise NotTheSame(quoted(self.partial), "input")
        last = steps[-1]
        os.ftruncate(self.descriptor, last.written)
        os.ftruncate(self.journal, len(first) + sum(map(len, noted[: len(steps)])))
        for name in ("written", "rows", "failed", "lines"):
            self.shared[name] = getattr(last, name)
        return True

    def finish(self) -> None:
        """Give the whole result its name."""
        os.fsync(self.descriptor)
        os.replace(self.partial, self.path)
        os.unlink(self.journal_path)

    def close(self) -> None:
        """Let go of the files, and of the lock with them."""
        super().close()
        os.close(self.journal)


def _opened(path: str) -> int:
    """A file to append to, which is no link and no other file of anyone's."""
    try:
        descriptor = os.open(path, os.O_RDWR | os.O_CREAT | os.O_APPEND | os.O_NOFOLLOW | os.O_CLOEXEC, 0o666)
    except OSError as error:
        if error.errno == errno.ELOOP:
            raise BadTable(f"{quoted(path)} is a link; nothing is written through it") from None
        raise
    if not stat.S_ISREG(os.fstat(descriptor).st_mode):
        raise BadTable(f"{quoted(path)} is no file")
    return descriptor


def _locked(path: str) -> int:
    """A file to append to that no other process writes any more; what took its name meanwhile is another one."""
    give_up = time.monotonic() + LOCK_SECONDS
    descriptor = _opened(path)
    while True:
        try:
            fcntl.flock(descriptor, fcntl.LOCK_EX | fcntl.LOCK_NB)
            with suppress(FileNotFoundError):
                if os.path.samestat(os.fstat(descriptor), os.stat(path)):
                    return descriptor
            os.close(descriptor)
            descriptor = _opened(path)
        except BlockingIOError:
            if time.monotonic() > give_up:
                os.close(descriptor)
                raise BadTable(f"{quoted(path)} is being written by another run") from None
            time.sleep(0.02)
