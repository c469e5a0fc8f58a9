"""The file that is written: whole or not at all, or standard output."""

import os
import sys
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from io import TextIOWrapper
from typing import BinaryIO, TextIO


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
    """Open a temporary file that replaces `path` when it is complete; write to a device or a pipe directly."""
    with naming(path):
        place = os.path.realpath(path)
        if os.path.exists(place) and not os.path.isfile(place):
            with open(place, "wb") as stream:
                yield stream
            return
        folder, name = os.path.split(place)
        beside = os.path.join(folder, f".{name}.{os.urandom(4).hex()}")
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


@contextmanager
def text_output(path: str) -> Iterator[TextIO]:
    """Open a file as `whole_file` does, for text in UTF-8; "-" is stdout."""
    if path == "-":
        yield sys.stdout
        sys.stdout.flush()
        return
    with whole_file(path) as stream, TextIOWrapper(stream, encoding="utf-8", newline="") as text:
        yield text
