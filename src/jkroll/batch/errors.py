"""Errors of a table as a whole. A row that fails is no error: its status says why."""

from collections.abc import Iterator
from contextlib import contextmanager

from ..errors import JkrollError, MissingExtra


class BadTable(JkrollError):
    """Error raised for a header, a format or a file that makes no table of scenes."""

    def __init__(self, problem: str) -> None:
        super().__init__(problem)
        self.problem = problem

    def __str__(self) -> str:
        return self.problem


class BadRow(JkrollError):
    """Error raised for the first row that fails, with `--strict`. Its line is counted from the beginning of the block, or of the table."""

    exit_code = 1

    def __init__(self, line: int, status: str) -> None:
        super().__init__(line, status)
        self.line, self.status = line, status

    def __str__(self) -> str:
        return f"line {self.line}: {self.status}"


class LostWorker(JkrollError):
    """Error raised when a process is ended from outside."""

    exit_code = 1

    def __init__(self, exit_code: int) -> None:
        super().__init__(exit_code)
        self.how = f"was ended by signal {-exit_code}" if exit_code < 0 else f"ended with exit code {exit_code}"

    def __str__(self) -> str:
        return f"a working process {self.how}; nothing is lost: --resume goes on"


class NotTheSame(JkrollError):
    """Error raised when an interrupted run had another input, other options or another version."""

    def __init__(self, partial: str, what: str) -> None:
        super().__init__(partial, what)
        self.partial, self.what = partial, what

    def __str__(self) -> str:
        return f"--resume: {self.partial} is of a run with another {self.what}; without --resume it is begun anew"


@contextmanager
def missing_extra(extra: str) -> Iterator[None]:
    """Name the extra that installs a missing library."""
    try:
        yield
    except ModuleNotFoundError as error:
        raise MissingExtra(error.name or "", extra) from None
