"""The errors that jkroll raises. The command line prints an error as a line and exits with the error's code."""

from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from typing import Any

ROWS_FAILED = 1  # exit code of a call that has no answer for some rows
FAILED = 1  # exit code of a call that could not write, or met an unexpected error


class JkrollError(Exception):
    """Base class of all errors that jkroll raises."""

    exit_code = 2
    phrase = ""  # the status of a failed row, without details; if empty, the message is the status
    mistake = ""  # what is wrong with a bad value: the words after the value in the message

    @property
    def code(self) -> str:
        """The phrase as a code for programs; see `code_of`."""
        return code_of(self.phrase)

    @property
    def fault(self) -> str:
        """The key by which a note counts failed rows: the phrase and the first words of the mistake, or the message."""
        return " ".join([self.phrase, *self.mistake.split()[:3]]) if self.phrase else str(self)

    def __reduce__(self) -> tuple[Any, ...]:
        """Return the parts to pickle. `args` alone do not suffice, since `__init__` may take other arguments."""
        return _unpickled, (type(self), self.args, vars(self))


def _unpickled(cls: type[JkrollError], arguments: tuple[Any, ...], attributes: Mapping[str, Any]) -> JkrollError:
    """Return an error of a class with these arguments and attributes, without calling `__init__`."""
    error = cls.__new__(cls, *arguments)
    vars(error).update(attributes)
    return error


def code_of(phrase: str) -> str:
    """Return a phrase as a code.

    >>> code_of("beyond pull-off")
    'beyond-pull-off'
    """
    return phrase.casefold().replace(" ", "-").replace("_", "-")


class MissingExtra(JkrollError):
    """Error raised if an optional library is missing."""


@contextmanager
def missing_extra(extra: str) -> Iterator[None]:
    """Replace the error of an import in the block by an error that names the extra to install."""
    try:
        yield
    except ModuleNotFoundError as error:
        library = (error.name or "").partition(".")[0]
        raise MissingExtra(f"this needs {library}: pip install 'jkroll[{extra}]'") from None


class NoResult(JkrollError):
    """Error raised if a quantity has no value for the given inputs."""

    exit_code = 1
    name = ""  # the quantity that has no value, or whose value rules out a contact; empty for several quantities
    cause: Any  # the cause as stored in a column of reasons

    def explanation(self) -> str:
        """Return the reason, without the name of the quantity."""
        return ""

    def __str__(self) -> str:
        return f"{self.name}: {self.explanation()}" if self.name else self.explanation()


class BadRequest(JkrollError):
    """Error raised for arguments, options or cells that cannot be understood or computed."""

    def __init__(self, problem: str, phrase: str = "") -> None:
        """`phrase`: the status of a row; if empty, the problem is the status."""
        super().__init__(problem)
        self.phrase = phrase


def repeated_input(name: str) -> BadRequest:
    """Return the error for an input that `--quantities` names."""
    return BadRequest(f"--quantities: {name} is an input here and is shown with the inputs; leave it out")


class BadTable(JkrollError):
    """Error raised for a header, a format or a file that cannot be read as a table."""


class BadRow(JkrollError):
    """Error raised for the first row that fails, with `--strict` or in a measured curve.

    Its arguments are the line and the reason. Lines count from 0 within a block of rows, and from 1 in a table.
    """

    exit_code = 1

    def __str__(self) -> str:
        return "line {}: {}".format(*self.args)
