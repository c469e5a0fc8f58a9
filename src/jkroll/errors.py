"""Errors that jkroll declares. The command line prints one as a line and ends with its exit code."""

from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from typing import Any

ROWS_FAILED = 1  # exit code of a call that answered, though not for every row
FAILED = 1  # exit code of a call that could not write, or met what nobody foresaw


class JkrollError(Exception):
    """Base class of all errors that jkroll declares."""

    exit_code = 2
    phrase = ""  # of a row's status, the same for all errors of a kind; the message where it is empty

    @property
    def code(self) -> str:
        """The phrase as a code for programs."""
        return code_of(self.phrase)

    def __reduce__(self) -> tuple[Any, ...]:
        """Pickle the attributes: `args` may be others than those of `__init__`, by which exceptions are pickled."""
        return _unpickled, (type(self), self.args, vars(self))


def _unpickled(cls: type[JkrollError], arguments: tuple[Any, ...], attributes: Mapping[str, Any]) -> JkrollError:
    """Return an error of a kind with its attributes."""
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
    """Error raised when a library is needed that only an extra installs."""


@contextmanager
def missing_extra(extra: str) -> Iterator[None]:
    """Name the extra that installs a missing library."""
    try:
        yield
    except ModuleNotFoundError as error:
        library = (error.name or "").partition(".")[0]
        raise MissingExtra(f"this needs {library}: pip install 'jkroll[{extra}]'") from None


class NoResult(JkrollError):
    """Error raised when a quantity has no value for the given inputs."""

    exit_code = 1
    name = ""  # the quantity that has no value, or whose value rules a contact out, if it is a single one
    cause: Any  # of its reason in a column

    def explanation(self) -> str:
        """Return why there is no answer, without the name of the quantity."""
        return ""

    def __str__(self) -> str:
        return f"{self.name}: {self.explanation()}" if self.name else self.explanation()


class BadRequest(JkrollError):
    """Error raised for arguments, options or cells that do not make a request, or make one that cannot be met."""

    def __init__(self, problem: str, phrase: str = "") -> None:
        """`phrase`: of a row's status, where it is not the problem."""
        super().__init__(problem)
        self.phrase = phrase


class BadTable(JkrollError):
    """Error raised for a header, a format or a file that makes no table of scenes."""


class BadRow(JkrollError):
    """Error raised for the first row that fails, with `--strict`.

    Its arguments are the line, counted from the beginning of the block or of the table, and the reason.
    """

    exit_code = 1

    def __str__(self) -> str:
        return "line {}: {}".format(*self.args)
