"""The output: a stream, or a file that gets its name when it is whole.

A file is written beside its name as .partial. A journal notes after every block how far input and output came, with a
checksum of each; `--resume` goes on from there if input, options and version are the same.
"""

import errno
import os
import stat
import sys
from collections.abc import Callable, Iterator, Mapping
from contextlib import suppress
from operator import add
from typing import Any, NamedTuple, Self
from zlib import crc32

from ..errors import BadRequest
from ..table.blocks import Tally
from ..table.errors import BadRow, BadTable
from ..text import quoted, say
from .errors import NotTheSame
from .journal import Journal, opened
from .lines import Converted
from .settings import Settings

LARGE = 1 << 20  # bytes from which a file is flushed to the disk: 10 000 small ones would take minutes


class Step(NamedTuple):
    """A line of a journal: counts up to the end of a block, and checksums of the block as read and as written."""

    written: int = 0
    lines: int = 0
    rows: int = 0
    failed: int = 0
    doubtful: int = 0
    read_checksum: int = 0
    written_checksum: int = 0


Fetch = Callable[[int], bytes]  # returns a block, or nothing if it has written it at this place of the file


def step_of(read: bytes, converted: Converted) -> Step:
    """Return what a block adds, with its checksums."""
    return Step(len(converted.output), read.count(b"\n"), *converted.tally, crc32(read), crc32(converted.output))


class Output:
    """A stream that takes blocks in their order. It is finished where a `with` of it ends without an error."""

    goes_on = False  # whether --resume can go on after an interrupt
    path = ""  # of the file that is written, if it is one

    def __init__(self, descriptor: int) -> None:
        self.descriptor = descriptor
        self.done = Step()

    def __enter__(self) -> Self:
        return self

    def __exit__(self, _kind: object, error: BaseException | None, _trace: object) -> None:
        try:
            if error is None:
                self.finish()
            elif isinstance(error, (BadTable, BadRow)):
                self.discard()
            elif isinstance(error, KeyboardInterrupt):
                rest = "; --resume goes on" if self.goes_on else ""
                say(f"jkroll: interrupted after {self.done.rows} rows{rest}", sys.stderr)
        finally:
            self.close()

    @property
    def tally(self) -> Tally:
        """The counts so far."""
        return Tally(self.done.rows, self.done.failed, self.done.doubtful)

    def begin(self, _identity: Mapping[str, str], read: bytes, head: Converted) -> None:
        """Begin anew with a header: as read, and what it becomes."""
        self.take(step_of(read, head), lambda _: head.output)

    def resume(self, _identity: Mapping[str, str], _read: bytes, _blocks: Iterator[bytes]) -> bool:
        """Go on with an interrupted run; False if there is none."""
        return False

    def count(self, step: Step) -> None:
        """Count a block."""
        total = Step(*map(add, self.done, step))
        self.done = total._replace(read_checksum=step.read_checksum, written_checksum=step.written_checksum)

    def take(self, step: Step, fetch: Fetch) -> None:
        """Write a block."""
        rest = memoryview(fetch(self.done.written))
        self.count(step)
        while rest:
            rest = rest[os.write(self.descriptor, rest) :]

    def finish(self) -> None:
        """End the output after the last block."""

    def discard(self) -> None:
        """Leave nothing behind: the table is bad, and to go on would make it no better."""

    def close(self) -> None:
        """Close what is open."""
        os.close(self.descriptor)


class OutputFile(Output):
    """A file that gets its name when it is whole."""

    def __init__(self, target: str, *, goes_on: bool = True) -> None:
        """Open the file beside, and its journal. A link is written through. Raises BadRequest for a directory or device."""
        self.goes_on = goes_on
        if os.path.isdir(target):
            raise BadRequest(
                f"-o: {quoted(target)} is a directory; {quoted(target + os.sep)} is where a file for each table goes"
            )
        if os.path.exists(target) and not os.path.isfile(target):
            raise BadRequest(f"-o: {quoted(target)} is no file")
        if not os.path.isdir(os.path.dirname(target) or "."):
            raise FileNotFoundError(errno.ENOENT, os.strerror(errno.ENOENT), target)
        self.target = _real_path(target)
        self.path = f"{self.target}.partial"
        self.journal = Journal(self.target, self.path)
        try:
            super().__init__(opened(self.path))
        except (OSError, BadTable):
            if not self.journal.has_begun:
                self.journal.remove()
            self.journal.close()
            raise

    def begin(self, identity: Mapping[str, str], read: bytes, head: Converted) -> None:
        """Begin anew with a header."""
        os.ftruncate(self.descriptor, 0)
        self.journal.begin(identity)
        super().begin(identity, read, head)

    def take(self, step: Step, fetch: Fetch) -> None:
        """Write a block, and note it in the journal."""
        super().take(step, fetch)
        self.journal.add(self.done)

    def resume(self, identity: Mapping[str, str], read: bytes, blocks: Iterator[bytes]) -> bool:
        """Go to the last block that is whole in the journal, the output and the input; False if there is none."""
        about, *lines = self.journal.lines() or [{}]
        steps = self._steps(lines)
        if not steps:
            return False
        changed = [name for name, value in identity.items() if about.get(name) != value]
        for place, step in enumerate(steps):
            if not changed and crc32(next(blocks, b"") if place else read) != step.read_checksum:
                changed = ["input"]
        if changed:
            raise NotTheSame(quoted(self.path), changed[0])
        self.done = steps[-1]
        os.ftruncate(self.descriptor, self.done.written)
        self.journal.keep(1 + len(steps))
        return True

    def _steps(self, lines: list[Any]) -> list[Step]:
        """Return the steps that the output confirms, up to the first that it does not."""
        steps: list[Step] = []
        start = 0
        with open(self.path, "rb") as file, suppress(TypeError):
            for line in lines:
                step = Step(*line)
                if step.written < start or crc32(file.read(step.written - start)) != step.written_checksum:
                    break
                steps.append(step)
                start = step.written
        return steps

    def finish(self) -> None:
        """Give the whole file its name, and the mode of the file that had it."""
        with suppress(FileNotFoundError):
            os.chmod(self.path, stat.S_IMODE(os.stat(self.target).st_mode))
        if os.fstat(self.descriptor).st_size >= LARGE:
            os.fsync(self.descriptor)
        os.replace(self.path, self.target)
        self.journal.remove()

    def discard(self) -> None:
        """Remove what was written."""
        os.unlink(self.path)
        self.journal.remove()

    def close(self) -> None:
        """Close the files, and give up the lock with them."""
        super().close()
        self.journal.close()


def output_to(settings: Settings) -> Output:
    """Return the output of `-o`: stdout, a device or pipe, or a file."""
    target = settings.target
    if target == "-":
        sys.stdout.flush()
        return Output(os.dup(sys.stdout.fileno()))
    if os.path.exists(target) and not (os.path.isfile(target) or os.path.isdir(target)):  # a device or a pipe
        return Output(os.open(target, os.O_WRONLY))
    return OutputFile(target)


def is_done(settings: Settings, input_time: int = 0) -> bool:
    """Return whether `--resume` has nothing to do, and say so: the output is newer than the input, and has no journal.

    A whole file does not say with which options it was made.
    """
    real = _real_path(settings.target)
    if not settings.resume or os.path.exists(real + ".journal") or not os.path.isfile(real):
        return False
    if os.stat(real).st_mtime_ns < input_time:
        return False
    say(
        f"note: {quoted(settings.target)} is whole already, made with these options or others; without --resume it is made anew",
        sys.stderr,
    )
    return True


def _real_path(target: str) -> str:
    """Return the file that a link leads to, else the name as it is."""
    return os.path.realpath(target) if os.path.islink(target) else target
