"""Materials files: TOML of a size that cannot keep a call waiting."""

import os
from stat import S_ISREG
from typing import Any

from ..errors import JkrollError
from ..text import quoted, shown

MAX_BYTES = 64_000  # some 180 materials with all their references
MAX_DOTS = 100  # in a line: a dotted key costs time and memory with the square of its parts


class MaterialsFileError(JkrollError):
    """Error raised when a materials file cannot be read, or when something in it is not a material."""

    def __init__(self, path: str, problem: str) -> None:
        super().__init__(path, problem)
        self.path, self.problem = path, problem

    def __str__(self) -> str:
        return f"materials file {quoted(self.path)}: {self.problem}"


def data_of(path: str) -> dict[str, Any]:
    """Read a TOML file; MaterialsFileError if it cannot be read or exceeds the limits above."""
    text = _text(path)
    if any(line.count(".") > MAX_DOTS for line in text.split("\n")):
        raise MaterialsFileError(path, f"has a line of more than {MAX_DOTS} dots")
    import tomllib

    try:
        return tomllib.loads(text)
    except ValueError as error:
        raise MaterialsFileError(path, f"is not TOML: {shown(str(error))}") from None
    except RecursionError:
        raise MaterialsFileError(path, "is not TOML: nested too deeply") from None


def _text(path: str) -> str:
    """Return the text of a regular file of at most MAX_BYTES."""
    try:
        if not S_ISREG(os.stat(path).st_mode):
            raise MaterialsFileError(path, "is not a regular file")
        with open(path, "rb") as file:
            content = file.read(MAX_BYTES + 1)
    except OSError as error:
        raise MaterialsFileError(path, error.strerror or "cannot be read") from None
    except ValueError:
        raise MaterialsFileError(path, "is not a path") from None
    if len(content) > MAX_BYTES:
        raise MaterialsFileError(path, f"is larger than {MAX_BYTES // 1000} kB")
    try:
        return content.decode("utf-8-sig")
    except UnicodeDecodeError:
        raise MaterialsFileError(path, "is not UTF-8") from None
