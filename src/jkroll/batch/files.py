"""The input as a file, and what must not be written over."""

import errno
import os
import stat
import sys
from collections.abc import Callable, Iterator
from contextlib import suppress
from typing import BinaryIO

from ..errors import BadRequest
from ..text import quoted
from .errors import BadTable

BESIDE = (".partial", ".journal")  # what may stand beside the output until it is whole


def opened(path: str) -> int:
    """A descriptor of the input."""
    try:
        descriptor = os.dup(0) if path == "-" else os.open(path, os.O_RDONLY | os.O_CLOEXEC)
        if stat.S_ISDIR(os.fstat(descriptor).st_mode):
            raise IsADirectoryError(errno.EISDIR, os.strerror(errno.EISDIR))
    except OSError as error:
        raise BadTable(f"{quoted(path)}: {error.strerror}") from None
    return descriptor


def size_of(descriptor: int) -> int:
    """The bytes of a file; 0 for a pipe."""
    about = os.fstat(descriptor)
    return about.st_size if stat.S_ISREG(about.st_mode) else 0


def identity_of(descriptor: int) -> list[int]:
    """What tells one input from another before it is read; of a pipe, nothing."""
    about = os.fstat(descriptor)
    return [about.st_size, about.st_mtime_ns] if stat.S_ISREG(about.st_mode) else []


def check_file(target: str) -> None:
    """Refuse to put a file in the place of what is none."""
    if os.path.exists(target) and not os.path.isfile(target):
        raise BadRequest(f"-o: {quoted(target)} is no file")


def check_output(descriptor: int, target: str) -> None:
    """Refuse to write over the input."""
    if target == "-":
        return
    read = os.fstat(descriptor)
    for path in (target, *(target + end for end in BESIDE)):
        with suppress(OSError):
            if os.path.samestat(read, os.stat(path)) and stat.S_ISREG(read.st_mode):
                raise BadRequest(f"-o: {quoted(path)} is the input; it is not overwritten")


def feed(descriptor: int, pieces: Callable[[BinaryIO], Iterator[bytes]]) -> tuple[int, int]:
    """A pipe from a process that makes of a file what is to be read: its end, and the process."""
    if not hasattr(os, "fork"):
        raise BadTable("this system has no fork, which it takes to read a compressed table; decompress it first")
    end, start = os.pipe()
    sys.stdout.flush()
    process = os.fork()
    if process:
        os.close(start)
        os.close(descriptor)
        return end, process
    code = 1
    try:
        os.close(end)
        with os.fdopen(descriptor, "rb") as file:
            for piece in pieces(file):
                rest = memoryview(piece)
                while rest:
                    rest = rest[os.write(start, rest) :]
        code = 0
    finally:
        os._exit(code)
