"""Errors of a run over tables."""

from collections.abc import Iterator
from contextlib import contextmanager

from ..errors import JkrollError, MissingExtra


class LostWorker(JkrollError):
    """Error raised when a process is ended from outside."""

    exit_code = 1

    def __init__(self, exit_code: int) -> None:
        super().__init__(exit_code)
        self.how = f"was ended by signal {-exit_code}" if exit_code < 0 else f"ended with exit code {exit_code}"

    def __str__(self) -> str:
        return f"a working process {self.how}; no file was written"


@contextmanager
def missing_extra(extra: str) -> Iterator[None]:
    """Name the extra that installs a missing library."""
    try:
        yield
    except ModuleNotFoundError as error:
        raise MissingExtra(error.name or "", extra) from None
