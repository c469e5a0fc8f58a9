"""The columns that the rows of one call share."""

from collections.abc import Collection, Iterable, Mapping
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
    sides: Mapping[
        str, Collection[str]
    ]  # of the uncertainty of a result, where one has any: minus and plus, or low and high

    @property
    def columns(self) -> tuple[str, ...]:
        """The columns of a table: inputs, then results."""
        return self.inputs + tuple(name for name in self.results if name not in self.inputs)

    def headers(self, form: Format) -> list[str]:
        """Return the column headers: inputs in SI units, results as the format has them, and their uncertainties."""
        return [head for name in self.columns for head in self._heads(name, form)]

    def _heads(self, name: str, form: Format) -> list[str]:
        if name in self.inputs:
            return [header(name)]
        return heads(name, form.header(name), self.sides.get(name, ()))


def heads(name: str, head: str, sides: Iterable[str]) -> list[str]:
    """Return the headers of a quantity and of the sides of its uncertainty.

    >>> heads("radius", "radius [nm]", ["minus", "plus"])
    ['radius [nm]', 'radius_minus [nm]', 'radius_plus [nm]']
    """
    return [head, *(head.replace(name, f"{name}_{side}", 1) for side in sides)]


def layout(question: Question, samples: Iterable[Answer], count: int) -> Layout:
    """Return the layout of `count` rows; the samples have every input and result that a row can have."""
    rows = list(samples)
    inputs = {name for answer in rows for name in answer.inputs}
    results = {result.name for answer in rows for result in answer.results}
    sides: dict[str, dict[str, None]] = {}
    for answer in rows:
        for result in answer.results:
            if result.propagated is not None:
                sides.setdefault(result.name, {}).update(dict.fromkeys(result.sides()))
    return Layout(
        question,
        tuple(name for name in NOMENCLATURE if name in inputs),
        tuple(name for name in question.quantities if name in results),
        count,
        sides,
    )
