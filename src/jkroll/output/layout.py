"""The layout that the rows of one call share."""

from collections.abc import Iterable
from typing import NamedTuple

from ..answers.answer import Answer
from ..answers.questions import Question
from ..quantities.formatting import Format
from ..quantities.nomenclature import NOMENCLATURE, header


class Layout(NamedTuple):
    """What the rows of a call have in common."""

    command: Question
    inputs: tuple[str, ...]  # of any row
    results: tuple[str, ...]
    size: int  # number of rows

    @property
    def columns(self) -> tuple[str, ...]:
        """The columns of a table: inputs, then results."""
        return self.inputs + tuple(name for name in self.results if name not in self.inputs)

    def headers(self, form: Format) -> list[str]:
        """Their headers: inputs in SI units, results as they are to be written."""
        return [header(name) if name in self.inputs else form.header(name) for name in self.columns]


def layout(command: Question, samples: Iterable[Answer], count: int) -> Layout:
    """The layout of rows of which these are samples."""
    rows = list(samples)
    inputs = {name for answer in rows for name in answer.inputs}
    results = {result.name for answer in rows for result in answer.results}
    return Layout(
        command,
        tuple(name for name in NOMENCLATURE if name in inputs),
        tuple(name for name in command.quantities if name in results),
        count,
    )
