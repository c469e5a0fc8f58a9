"""The output: a stream, or a file that gets its name when it is whole.

A file is written beside its name as .partial. A journal notes after every block how far input and output came, with a
checksum of each; `--resume` goes on from there if input, options and version are the same. The partial file is locked, so that
two runs never write the same file. Files of these names that jkroll did not write are left alone.
"""

import json
import os
import stat
import sys
from collections.abc import Callable, Iterator, Mapping
from contextlib import suppress
from typing import Any, BinaryIO, NamedTuple
from zlib import crc32

from ..errors import BadRequest
from ..text import quoted, say
from .errors import BadRow, BadTable, NotTheSame
from .formats import CHUNK
from .lines import Converted
from .locks import MARK, locked, opened, refuse_foreign

LARGE = 1 << 20  # bytes from which a file is flushed to the disk: 10 000 small ones would take minutes


class Step(NamedTuple):
    """A line of a journal: counts up to a block, and checksums of the block as read and as written."""

    written: int = 0
    rows: int = 0
    failed: int = 0
    lines: int = 0
    read_checksum: int = 0
    written_checksum: int = 0
    doubtful: int = 0


class Written(NamedTuple):
    """The size and checksum of bytes that were written."""

    size: int
    checksum: int


class Writer:
    """An open descriptor, which can be handed to a process when that is started."""

    def __init__(self, descriptor: int) -> None:
        self.descriptor = descriptor

    def append(self, output: bytes) -> Written:
        """Write bytes behind what was written before."""
        rest = memoryview(output)
        while rest:
            rest = rest[os.write(self.descriptor, rest) :]
        return Written(len(output), crc32(output))

    def __reduce__(self) -> tuple[Callable[..., "Writer"], tuple[object]]:
        from multiprocessing.reduction import DupFd  # which Windows does not have

        return _received, (DupFd(self.descriptor),)


def _received(descriptor: Any) -> Writer:
    return Writer(descriptor.detach())


class Output:
    """A stream that takes blocks in their order."""

    goes_on = False  # whether --resume can go on after an interrupt

    def __init__(self, descriptor: int, *, strict: bool) -> None:
        """`strict`: no row may fail."""
        self.writer = Writer(descriptor)
        self.strict = strict
        self.done = Step()

    def check(self, converted: Converted) -> None:
        """Raise BadRow if a row of the next block failed and none may."""
        if self.strict and converted.first_failure is not None:
            line, status = converted.first_failure
            raise BadRow(self.done.lines + 1 + line, status)

    def note(self, read_checksum: int, converted: Converted, written: Written) -> None:
        """Count a block that was written."""
        done = self.done
        self.done = Step(
            done.written + written.size,
            done.rows + converted.rows,
            done.failed + converted.failed,
            done.lines + converted.lines,
            read_checksum,
            written.checksum,
            done.doubtful + converted.doubtful,
        )

    def finish(self) -> None:
        """End the output after the last block."""

    def close(self) -> None:
        """Close what is open."""
        os.close(self.writer.descriptor)


class OutputFile(Output):
    """A file that gets its name when it is whole."""

    goes_on = True

    def __init__(self, target: str, *, strict: bool = False) -> None:
        """Open and lock the file beside. A link is written through."""
        self.target = real_path(target)
        self.partial, self.journal_path = self.target + ".partial", self.target + ".journal"
        refuse_foreign(self.partial, self.journal_path)
        super().__init__(locked(self.partial), strict=strict)
        try:
            self.journal = opened(self.journal_path)
        except (OSError, BadTable):
            super().close()
            raise

    def begin(self, identity: Mapping[str, str]) -> None:
        """Begin anew."""
        os.ftruncate(self.writer.descriptor, 0)
        os.ftruncate(self.journal, 0)
        os.write(self.journal, json.dumps({MARK: 1, **identity}).encode() + b"\n")

    def note(self, read_checksum: int, converted: Converted, written: Written) -> None:
        """Count a block that was written, and note it in the journal."""
        super().note(read_checksum, converted, written)
        os.write(self.journal, (" ".join(map(str, self.done)) + "\n").encode())

    def has_begun(self) -> bool:
        """Return whether an interrupted run left something."""
        return os.fstat(self.journal).st_size > 0

    def resume(self, identity: Mapping[str, str], head: bytes, blocks: Iterator[bytes]) -> bool:
        """Go to the last block that is whole in the journal, the output and the input; False if there is none."""
        with open(self.journal_path, "rb") as file:
            first, *lines = [line for line in file if line.endswith(b"\n")] or [b""]
        steps = self._steps(lines)
        if not first or not steps:
            return False
        try:
            before = json.loads(first)
            for name, value in identity.items():
                if before[name] != value:
                    raise NotTheSame(quoted(self.partial), name)
        except (ValueError, TypeError, KeyError):
            raise BadTable(
                f"--resume: {quoted(self.journal_path)} is damaged; without --resume the run is begun anew"
            ) from None
        for place, step in enumerate(steps):
            if crc32(next(blocks, b"") if place else head) != step.read_checksum:
                raise NotTheSame(quoted(self.partial), "input")
        self.done = steps[-1]
        os.ftruncate(self.writer.descriptor, self.done.written)
        os.ftruncate(self.journal, len(first) + sum(map(len, lines[: len(steps)])))
        return True

    def _steps(self, lines: list[bytes]) -> list[Step]:
        """Return the steps that the output confirms, up to the first that it does not."""
        steps: list[Step] = []
        start = 0
        with open(self.partial, "rb") as file:
            for line in lines:
                try:
                    step = Step(*map(int, line.split()))
                except (ValueError, TypeError):
                    break
                if step.written < start or _checksum_of(file, step.written - start) != step.written_checksum:
                    break
                steps.append(step)
                start = step.written
        return steps

    def finish(self) -> None:
        """Give the whole file its name, and the mode of the file that had it."""
        with suppress(FileNotFoundError):
            os.chmod(self.partial, stat.S_IMODE(os.stat(self.target).st_mode))
        if self.done.written >= LARGE:
            os.fsync(self.writer.descriptor)
        os.replace(self.partial, self.target)
        os.unlink(self.journal_path)

    def close(self) -> None:
        """Close the files, and give up the lock with them."""
        super().close()
        os.close(self.journal)


def output_to(target: str, *, strict: bool) -> Output:
    """Return the output of `-o`: stdout, a device or pipe, or a file."""
    if target == "-":
        sys.stdout.flush()
        return Output(os.dup(sys.stdout.fileno()), strict=strict)
    if os.path.isdir(target):
        raise BadRequest(f"-o: {quoted(target)} is a directory")
    if os.path.exists(target) and not os.path.isfile(target):
        return Output(os.open(target, os.O_WRONLY), strict=strict)
    return OutputFile(target, strict=strict)


def check_file(target: str) -> None:
    """Refuse to put a file in the place of a directory or device."""
    if os.path.exists(target) and not os.path.isfile(target):
        raise BadRequest(f"-o: {quoted(target)} is no file")


def is_whole(target: str, input_time: int) -> bool:
    """Return whether nothing is left to resume: the output is newer than the input, and nothing stands beside it."""
    real = real_path(target)
    if os.path.exists(real + ".journal") or not os.path.isfile(real):
        return False
    return os.stat(real).st_mtime_ns >= input_time


def say_whole(target: str) -> None:
    """Note that `--resume` has nothing to do."""
    say(f"note: {quoted(target)} is whole; without --resume it is made anew", sys.stderr)


def real_path(target: str) -> str:
    """Return the file that a link leads to, else the name as it is."""
    return os.path.realpath(target) if os.path.islink(target) else target


def _checksum_of(file: BinaryIO, size: int) -> int:
    """Return the checksum of the next bytes of a file; -1 if there are not as many."""
    checksum = 0
    while size:
        piece = file.read(min(CHUNK, size))
        if not piece:
            return -1
        checksum = crc32(piece, checksum)
        size -= len(piece)
    return checksum
