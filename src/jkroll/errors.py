"""The errors that jkroll raises. The command line prints an error as a line and exits with its code."""

from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from typing import Any

ROWS_FAILED = 1  # exit code of a call that has no answer for some rows
FAILED = 1  # exit code of a call that could not write, or met an unexpected error


class JkrollError(Exception):
    """Base class of all errors that jkroll raises."""

    exit_code = 2
    phrase = ""  # a row's status, the same for all errors of a kind; if empty, the status is the message

    @property
    def code(self) -> str:
        """The phrase as a code for programs."""
        return code_of(self.phrase)

    def __reduce__(self) -> tuple[Any, ...]:
        """Pickle the attributes: `args`, which exceptions pickle, may differ from the arguments of `__init__`."""
        return _unpickled, (type(self), self.args, vars(self))


def _unpickled(cls: type[JkrollError], arguments: tuple[Any, ...], attributes: Mapping[str, Any]) -> JkrollError:
    """Return an error of a class with its attributes."""
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
    """Error raised if a library is missing that an extra installs."""


@contextmanager
def missing_extra(extra: str) -> Iterator[None]:
    """Convert the error about a missing library into one that names the extra with the library."""
    try:
        yield
    except ModuleNotFoundError as error:
        library = (error.name or "").partition(".")[0]
        raise MissingExtra(f"this needs {library}: pip install 'jkroll[{extra}]'") from None


class NoResult(JkrollError):
    """Error raised if a quantity has no value for the given inputs."""

    exit_code = 1
    name = ""  # the single quantity, if any, that has no value, or whose value rules a contact out
    cause: Any  # the cause in a column of reasons

    def explanation(self) -> str:
        """Return why there is no answer, without the name of the quantity."""
        return ""

    def __str__(self) -> str:
        return f"{self.name}: {self.explanation()}" if self.name else self.explanation()


class BadRequest(JkrollError):
    """Error raised for arguments, options or cells that are no request, or one that cannot be met."""

    def __init__(self, problem: str, phrase: str = "") -> None:
        """`phrase`: the row's status, unless the problem is."""
        super().__init__(problem)
        self.phrase = phrase


class BadTable(JkrollError):
    """Error raised for a header, a format or a file that is no table of scenes."""


class BadRow(JkrollError):
    """Error raised with `--strict` for the first row that fails.

    Its arguments are the line, counted from the beginning of the block or table, and the reason.
    """

    exit_code = 1

    def __str__(self) -> str:
        return "line {}: {}".format(*self.args)
