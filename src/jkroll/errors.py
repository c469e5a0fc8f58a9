"""What can go wrong. An error carries the values that are wrong; its words are made from the nomenclature when asked for."""


class JkrollError(Exception):
    """Any error that jkroll declares. `exit_code` is what the command line ends with."""

    exit_code = 2


class MissingExtra(JkrollError):
    """A library that only an extra installs."""

    def __init__(self, library: str, extra: str) -> None:
        super().__init__(library, extra)
        self.library, self.extra = library, extra

    def __str__(self) -> str:
        return f"this needs {self.library.partition('.')[0]}: pip install 'jkroll[{self.extra}]'"


class NoResult(JkrollError):
    """The physics has no answer: the computation fails for these values."""

    exit_code = 1


class BadRequest(JkrollError):
    """Words or options that do not make a request."""
