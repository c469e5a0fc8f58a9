"""What can go wrong with a table as a whole. A row that goes wrong is no error: it says so in its status."""

from collections.abc import Iterator
from contextlib import contextmanager

from ..errors import JkrollError, MissingExtra


class BadTable(JkrollError):
    """A header, a format or a file that makes no table of scenes."""

    def __init__(self, problem: str) -> None:
        super().__init__(problem)
        self.problem = problem

    def __str__(self) -> str:
        return self.problem


class BadRow(JkrollError):
    """The first row that failed, where none may."""

    exit_code = 1

    def __init__(self, line: int, status: str) -> None:
        super().__init__(line, status)
        self.line, self.status = line, status

    def __str__(self) -> str:
        return f"line {self.line}: {self.status}"


class LostWorker(JkrollError):
    """A process that was ended from outside."""

    exit_code = 1

    def __init__(self, signal: int) -> None:
        super().__init__(signal)
        self.signal = signal

    def __str__(self) -> str:
        return f"a working process was ended by signal {self.signal}; nothing is lost: --resume goes on"


class NotTheSame(JkrollError):
    """An interrupted run that was another one."""

    def __init__(self, partial: str, what: str) -> None:
        super().__init__(partial, what)
        self.partial, self.what = partial, what

    def __str__(self) -> str:
        return f"--resume: {self.partial} is of a run with another {self.what}; without --resume it is begun anew"


@contextmanager
def missing_extra(extra: str) -> Iterator[None]:
    """Say which extra installs a library that is missing."""
    try:
        yield
    except ModuleNotFoundError as error:
        raise MissingExtra(error.name or "", extra) from None
