"""The output of a command: a file that is written completely or not at all, or stdout."""

import os
import re
import signal
import sys
from collections.abc import Iterable, Iterator
from contextlib import contextmanager, suppress
from io import BufferedWriter, TextIOWrapper
from typing import Any, BinaryIO, TextIO

from ..errors import BadRequest
from ..text import for_terminal, quoted

MAX_KEPT = 50  # characters of a file name in its temporary name
SIGNALS = [signal.SIGINT, signal.SIGTERM, getattr(signal, "SIGHUP", signal.SIGTERM)]  # Windows has no SIGHUP
_STREAMS = ("/dev/stdin", "/dev/stdout", "/dev/stderr")


@contextmanager
def whole_file(path: str, mark: str = "") -> Iterator[BinaryIO]:
    """Open an output file that replaces the one at `path` only when it is complete.

    Stdout, a device, a pipe or an open file is written directly. `mark`: part of the name of the temporary file, by
    which `remove_begun` recognizes it.
    """
    if path == "-":
        sys.stdout.flush()
        with _opened(os.dup(sys.stdout.fileno()), is_terminal=sys.stdout.isatty()) as stream:
            yield stream
        return
    if os.path.isdir(path):
        file = quoted(os.path.join(path, "x.csv"))
        raise BadRequest(f"-o: {quoted(path)} is a directory; name a file in it, such as {file}")
    try:
        descriptor = _descriptor(path)
        if descriptor is not None or (os.path.exists(path) and not os.path.isfile(path)):
            sys.stdout.flush()  # stdout may be the same file
            with _opened(path if descriptor is None else os.dup(descriptor)) as stream:
                yield stream
            return
        real = os.path.realpath(path)
        folder, name = os.path.split(real)
        temporary = os.path.join(folder, f".{name[:MAX_KEPT]}.{mark}{os.urandom(4).hex()}")
        with _temporary_file(temporary) as begun:
            with begun:
                yield begun
            if os.path.exists(real):
                os.chmod(temporary, os.stat(real).st_mode & 0o7777)
            os.replace(temporary, real)
    except OSError as error:
        error.filename = path  # the error of a full disk has no file name, other errors have the temporary name
        raise


@contextmanager
def _temporary_file(path: str) -> Iterator[BinaryIO]:
    """Open a new file; unless the block renames it, remove it after the block, or if a signal ends the process."""
    ours = [path]  # set before `open`, since a signal may arrive between the creation of the file and the return

    def remove() -> None:
        for each in ours:
            with suppress(FileNotFoundError):
                os.unlink(each)

    def end(number: int, _: object) -> None:
        remove()
        signal.signal(number, signal.SIG_DFL)
        signal.raise_signal(number)

    ending = [number for number in SIGNALS if signal.getsignal(number) == signal.SIG_DFL]
    with suppress(ValueError):  # only the main thread may set handlers
        for number in ending:
            signal.signal(number, end)
    try:
        try:
            stream = open(path, "xb")
        except FileExistsError:
            ours.clear()
            raise
        yield stream
    finally:
        remove()
        with suppress(ValueError):
            for number in ending:
                signal.signal(number, signal.SIG_DFL)


class _Terminal(BufferedWriter):
    """A stream to a terminal that replaces unprintable characters, such as those in the cells of a table."""

    def write(self, lines: Any) -> int:
        """Write whole lines; return their number of bytes."""
        super().write(for_terminal(bytes(lines).decode(errors="replace")).encode())
        return len(lines)


def _opened(file: str | int, *, is_terminal: bool = False) -> BufferedWriter:
    """Return a stream of bytes to a file or a descriptor: a `_Terminal` if it is a terminal."""
    stream = open(file, "wb")
    return _Terminal(stream.detach()) if is_terminal or stream.isatty() else stream


def remove_begun(paths: Iterable[str], mark: str) -> None:
    """Remove the temporary files with this mark that killed processes left in the folders of some output paths."""
    for folder in {os.path.dirname(os.path.realpath(path)) for path in paths}:
        with suppress(OSError):
            for name in os.listdir(folder):
                if re.fullmatch(rf"\..+\.{mark}[0-9a-f]{{8}}", name, re.DOTALL):
                    os.unlink(os.path.join(folder, name))


def _descriptor(path: str) -> int | None:
    """Return the descriptor that a path names, such as /dev/stdout or /dev/fd/63; None for other paths."""
    if path in _STREAMS:
        return _STREAMS.index(path)
    number = re.fullmatch(r"/(?:dev|proc/self)/fd/(\d+)", path)
    return int(number[1]) if number else None


@contextmanager
def text_output(path: str) -> Iterator[TextIO]:
    """Open an output file for UTF-8 text, see `whole_file`; "-" is stdout."""
    if path == "-":
        yield sys.stdout
        sys.stdout.flush()
        return
    with whole_file(path) as stream, TextIOWrapper(stream, encoding="utf-8", newline="") as text:
        yield text
