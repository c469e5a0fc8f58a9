"""The output: a stream, or a file that gets its name when it is whole.

A file is written beside its name as .partial. A journal notes after every block how far input and output came, with a
checksum of each; `--resume` goes on from there if input, options and version are the same. The partial file is locked, so that
two runs never write the same file. Files of these names that jkroll did not write are left alone.
"""

import errno
import json
import os
import stat
import sys
from collections.abc import Iterator, Mapping
from contextlib import suppress
from typing import NamedTuple
from zlib import crc32

from ..errors import BadRequest
from ..text import quoted, say
from .errors import BadRow, BadTable, NotTheSame
from .lines import Converted
from .settings import Settings, Tally

MARK = "jkroll journal"  # key in the first line of a journal: the file is ours
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


class Output:
    """A stream that takes blocks in their order."""

    goes_on = False  # whether --resume can go on after an interrupt

    def __init__(self, descriptor: int, *, strict: bool = False) -> None:
        """`strict`: no row may fail."""
        self.descriptor = descriptor
        self.strict = strict
        self.done = Step()

    @property
    def tally(self) -> Tally:
        """The counts so far."""
        return Tally(self.done.rows, self.done.failed, self.done.doubtful)

    def begin(self, _identity: Mapping[str, str], read: bytes, head: Converted) -> None:
        """Begin anew with a header."""
        self.take(read, head)

    def resume(self, _identity: Mapping[str, str], _read: bytes, _blocks: Iterator[bytes]) -> bool:
        """Go on with an interrupted run; False if there is none."""
        return False

    def count(self, converted: Converted, read: bytes = b"") -> None:
        """Count a block that is written. Raises BadRow if a row of it failed and none may."""
        done = self.done
        if self.strict and converted.first_failure is not None:
            line, status = converted.first_failure
            raise BadRow(done.lines + 1 + line, status)
        self.done = Step(
            done.written + len(converted.output),
            done.rows + converted.rows,
            done.failed + converted.failed,
            done.lines + converted.lines,
            crc32(read),
            crc32(converted.output),
            done.doubtful + converted.doubtful,
        )

    def take(self, read: bytes, converted: Converted) -> None:
        """Write a block."""
        self.count(converted, read)
        rest = memoryview(converted.output)
        while rest:
            rest = rest[os.write(self.descriptor, rest) :]

    def finish(self) -> None:
        """End the output after the last block."""

    def close(self) -> None:
        """Close what is open."""
        os.close(self.descriptor)


class OutputFile(Output):
    """A file that gets its name when it is whole."""

    goes_on = True

    def __init__(self, target: str, *, strict: bool = False) -> None:
        """Open and lock the file beside. A link is written through. Raises BadRequest for a directory or device."""
        if os.path.exists(target) and not os.path.isfile(target):
            raise BadRequest(f"-o: {quoted(target)} is no file")
        self.target = _real_path(target)
        self.partial, self.journal_path = self.target + ".partial", self.target + ".journal"
        self._refuse_foreign()
        super().__init__(_locked(self.partial), strict=strict)
        try:
            self.journal = _opened(self.journal_path)
        except (OSError, BadTable):
            super().close()
            raise

    def _refuse_foreign(self) -> None:
        """Raise BadRequest if a file that the run would write is not jkroll's."""
        first = b""
        with suppress(OSError), open(self.journal_path, "rb") as file:
            first = file.readline(1000)
        if first.startswith(b'{"%b"' % MARK.encode()):
            return
        for path, is_foreign in (
            (self.journal_path, bool(first)),
            (self.partial, os.path.isfile(self.partial) and os.path.getsize(self.partial)),
        ):
            if is_foreign:
                raise BadRequest(f"-o: {quoted(path)} would be overwritten, and jkroll did not write it; move it away")

    def begin(self, identity: Mapping[str, str], read: bytes, head: Converted) -> None:
        """Begin anew with a header."""
        os.ftruncate(self.descriptor, 0)
        os.ftruncate(self.journal, 0)
        os.write(self.journal, json.dumps({MARK: 1, **identity}).encode() + b"\n")
        self.take(read, head)

    def take(self, read: bytes, converted: Converted) -> None:
        """Write a block, and note it in the journal."""
        super().take(read, converted)
        os.write(self.journal, (" ".join(map(str, self.done)) + "\n").encode())

    def has_begun(self) -> bool:
        """Return whether an interrupted run left something."""
        return os.fstat(self.journal).st_size > 0

    def resume(self, identity: Mapping[str, str], read: bytes, blocks: Iterator[bytes]) -> bool:
        """Go to the last block that is whole in the journal, the output and the input; False if there is none."""
        with open(self.journal_path, "rb") as file:
            first, *lines = [line for line in file if line.endswith(b"\n")] or [b""]
        steps = self._steps(lines)
        if not steps:
            return False
        try:
            before = json.loads(first)
            changed = [name for name, value in identity.items() if before[name] != value]
        except (ValueError, TypeError, KeyError):
            raise BadTable(
                f"--resume: {quoted(self.journal_path)} is damaged; without --resume the run is begun anew"
            ) from None
        for place, step in enumerate(steps):
            if not changed and crc32(next(blocks, b"") if place else read) != step.read_checksum:
                changed = ["input"]
        if changed:
            raise NotTheSame(quoted(self.partial), changed[0])
        self.done = steps[-1]
        os.ftruncate(self.descriptor, self.done.written)
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
                if step.written < start or crc32(file.read(step.written - start)) != step.written_checksum:
                    break
                steps.append(step)
                start = step.written
        return steps

    def finish(self) -> None:
        """Give the whole file its name, and the mode of the file that had it."""
        with suppress(FileNotFoundError):
            os.chmod(self.partial, stat.S_IMODE(os.stat(self.target).st_mode))
        if os.fstat(self.descriptor).st_size >= LARGE:
            os.fsync(self.descriptor)
        os.replace(self.partial, self.target)
        os.unlink(self.journal_path)

    def close(self) -> None:
        """Close the files, and give up the lock with them."""
        super().close()
        os.close(self.journal)


def output_to(settings: Settings) -> Output:
    """Return the output of `-o`: stdout, a device or pipe, or a file."""
    target = settings.target
    if target == "-":
        sys.stdout.flush()
        return Output(os.dup(sys.stdout.fileno()), strict=settings.strict)
    if os.path.isdir(target):
        raise BadRequest(f"-o: {quoted(target)} is a directory")
    if os.path.exists(target) and not os.path.isfile(target):
        return Output(os.open(target, os.O_WRONLY), strict=settings.strict)
    return OutputFile(target, strict=settings.strict)


def is_done(settings: Settings, input_time: int = 0) -> bool:
    """Return whether `--resume` has nothing to do, and say so: the output is newer than the input, and nothing is beside it."""
    real = _real_path(settings.target)
    if not settings.resume or os.path.exists(real + ".journal") or not os.path.isfile(real):
        return False
    if os.stat(real).st_mtime_ns < input_time:
        return False
    say(f"note: {quoted(settings.target)} is whole; without --resume it is made anew", sys.stderr)
    return True


def _real_path(target: str) -> str:
    """Return the file that a link leads to, else the name as it is."""
    return os.path.realpath(target) if os.path.islink(target) else target


def _opened(path: str) -> int:
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


def _locked(path: str) -> int:
    """Open and lock a file to append to. Raises BadTable if another run has it."""
    descriptor = _opened(path)
    try:
        _lock(descriptor, path)
        if os.path.samestat(os.fstat(descriptor), os.stat(path)):  # else another run has just given it its name
            return descriptor
    except (BlockingIOError, FileNotFoundError):
        pass
    os.close(descriptor)
    raise BadTable(f"{quoted(path)} is being written by another run")


def _lock(descriptor: int, path: str) -> None:
    """Lock a file; where the system has no locks, say so. Raises BlockingIOError."""
    try:
        from fcntl import LOCK_EX, LOCK_NB, flock

        flock(descriptor, LOCK_EX | LOCK_NB)
    except BlockingIOError:
        raise
    except (ImportError, OSError):
        say(f"note: {quoted(path)} cannot be locked here; let no other run write it", sys.stderr)
