"""The columns that the rows of one call share."""

from collections.abc import Iterable
from typing import NamedTuple

from ..answers.answer import Answer
from ..answers.questions import Question
from ..quantities.formatting import Format
from ..quantities.nomenclature import NOMENCLATURE, header


class Layout(NamedTuple):
    """The inputs and results that appear in any row of a call."""

    question: Question
    inputs: tuple[str, ...]
    results: tuple[str, ...]
    size: int  # number of rows

    @property
    def columns(self) -> tuple[str, ...]:
        """The columns of a table: inputs, then results."""
        return self.inputs + tuple(name for name in self.results if name not in self.inputs)

    def headers(self, form: Format) -> list[str]:
        """Return the column headers: inputs in SI units, results as the format has them."""
        return [header(name) if name in self.inputs else form.header(name) for name in self.columns]


def layout(question: Question, samples: Iterable[Answer], count: int) -> Layout:
    """Return the layout of `count` rows; the samples have every input and result that a row can have."""
    rows = list(samples)
    inputs = {name for answer in rows for name in answer.inputs}
    results = {result.name for answer in rows for result in answer.results}
    return Layout(
        question,
        tuple(name for name in NOMENCLATURE if name in inputs),
        tuple(name for name in question.quantities if name in results),
        count,
    )
