"""The file that is written: whole or not at all, or standard output."""

import os
import re
import sys
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from io import TextIOWrapper
from typing import BinaryIO, TextIO

from ..errors import BadRequest
from ..text import quoted

MAX_KEPT = 50  # characters of a name that its temporary name has, too
_STREAMS = ("stdin", "stdout", "stderr")
_OPEN = rf"/dev/(?P<stream>{'|'.join(_STREAMS)})|/(?:dev|proc/self)/fd/(?P<number>\d+)"


@contextmanager
def naming(path: str) -> Iterator[None]:
    """Set the file's name in an OSError: a full disk names no file, other errors a temporary one."""
    try:
        yield
    except OSError as error:
        error.filename = path
        raise


@contextmanager
def whole_file(path: str) -> Iterator[BinaryIO]:
    """Open a temporary file that replaces `path` when it is complete; or stdout, a device, a pipe or an open file."""
    if path == "-":
        sys.stdout.flush()
        with open(os.dup(sys.stdout.fileno()), "wb") as stream:
            yield stream
        return
    if os.path.isdir(path):
        file = quoted(os.path.join(path, "x.csv"))
        raise BadRequest(f"-o: {quoted(path)} is a directory; name a file in it, such as {file}")
    with naming(path):
        descriptor = _descriptor(path)
        if descriptor is not None or (os.path.exists(path) and not os.path.isfile(path)):
            sys.stdout.flush()  # it may be the same
            with open(path if descriptor is None else os.dup(descriptor), "wb") as stream:
                yield stream
            return
        place = os.path.realpath(path)
        folder, name = os.path.split(place)
        beside = os.path.join(folder, f".{name[:MAX_KEPT]}.{os.urandom(4).hex()}")
        begun = open(beside, "xb")
        try:
            with begun:
                yield begun
            if os.path.exists(place):
                os.chmod(beside, os.stat(place).st_mode & 0o7777)
            os.replace(beside, place)
        finally:
            with suppress(FileNotFoundError):
                os.unlink(beside)


def _descriptor(path: str) -> int | None:
    """Return the number of the open file that a path such as /dev/stdout or /dev/fd/63 stands for, or None."""
    if found := re.fullmatch(_OPEN, path):
        return int(found["number"] or _STREAMS.index(found["stream"]))
    return None


@contextmanager
def text_output(path: str) -> Iterator[TextIO]:
    """Open a file as `whole_file` does, for text in UTF-8; "-" is stdout."""
    if path == "-":
        yield sys.stdout
        sys.stdout.flush()
        return
    with whole_file(path) as stream, TextIOWrapper(stream, encoding="utf-8", newline="") as text:
        yield text
