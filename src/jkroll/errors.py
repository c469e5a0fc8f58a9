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
    """Error raised where the physics has no answer for these values."""

    exit_code = 1
    name = ""  # the quantity that has no value, or whose value rules a contact out

    def reason(self) -> str:
        """Return why there is no answer, without the name of the quantity."""
        return ""

    def __str__(self) -> str:
        return f"{self.name}: {self.reason()}"


class BadRequest(JkrollError):
    """Words or options that do not make a request."""
