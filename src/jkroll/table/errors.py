"""Errors of a table as a whole. A row that fails is no error: its status says why."""

from ..errors import JkrollError


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
