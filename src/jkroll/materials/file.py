"""A materials file as the tables that it says, in 10 ms and 10 MB whatever it holds: what could take more is refused by its size."""

import os
from collections.abc import Mapping
from stat import S_ISREG
from typing import Any

from ..errors import JkrollError
from ..text import quoted, shown

MAX_BYTES = 64_000  # some 180 materials with all their references
MAX_LINES = 3000
MAX_BRACKETS = 1200  # those that make tables and arrays
MAX_COMMAS = 3000
MAX_ODD_BYTES = 5000  # of a file that is not plain: tomllib takes a second a megabyte of the worst
_LIMITS = ((b"\n", MAX_LINES, "lines"), (b"[", MAX_BRACKETS, "opening brackets"), (b",", MAX_COMMAS, "commas"))
MAX_LINE = 2000
MAX_DOTS = 100  # in a line: a dotted key takes time and memory as the square of its parts


def data_of(path: str) -> Mapping[str, Any]:
    """What a TOML file says; MaterialsFileError if it says nothing that can be read, or is larger than any such file."""
    text = _text(path)
    from .plain_toml import NotPlain, read_plainly

    try:
        return read_plainly(text)
    except NotPlain as error:
        if len(text) > MAX_ODD_BYTES:
            line = f"line {error.line} is more than a key with a text, a number, or a list or table of texts"
            raise MaterialsFileError(path, f"is larger than {MAX_ODD_BYTES // 1000} kB, and {line}") from None
    if any(len(line) > MAX_LINE or line.count(".") > MAX_DOTS for line in text.split("\n")):
        raise MaterialsFileError(path, f"has a line of more than {MAX_LINE} characters or {MAX_DOTS} dots")
    import tomllib

    try:
        return tomllib.loads(text)
    except (ValueError, RecursionError) as error:
        reason = "nested too deeply" if isinstance(error, RecursionError) else shown(str(error))
        raise MaterialsFileError(path, f"is not TOML: {reason}") from None


def _text(path: str) -> str:
    """The text of a regular file of at most MAX_BYTES."""
    try:
        if not S_ISREG(os.stat(path).st_mode):
            raise MaterialsFileError(path, "is not a regular file")
        with open(path, "rb") as file:
            content = file.read(MAX_BYTES + 1)
    except (OSError, ValueError) as error:
        raise MaterialsFileError(path, getattr(error, "strerror", None) or "is not a path") from None
    if len(content) > MAX_BYTES:
        raise MaterialsFileError(path, f"is larger than {MAX_BYTES // 1000} kB")
    for sign, most, what in _LIMITS:
        if content.count(sign) > most:
            raise MaterialsFileError(path, f"has more than {most} {what}")
    try:
        return content.decode("utf-8-sig")
    except UnicodeDecodeError:
        raise MaterialsFileError(path, "is not UTF-8") from None


class MaterialsFileError(JkrollError):
    """A materials file that cannot be read or that says something that is no material."""

    def __init__(self, path: str, problem: str) -> None:
        super().__init__(path, problem)
        self.path, self.problem = path, problem

    def __str__(self) -> str:
        return f"materials file {quoted(self.path)}: {self.problem}"
