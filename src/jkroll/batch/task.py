"""The task of a run: the quantities to compute for every row, and what the command line gives for all of them."""

from collections.abc import Callable, Mapping
from typing import TYPE_CHECKING, Any, NamedTuple

from ..errors import JkrollError
from ..materials.library import Material, Materials
from ..output.layout import heads
from ..quantities.nomenclature import header
from ..scene.scene import Scene
from .columns import DOUBT, MATERIALS, STATUS, Column

if TYPE_CHECKING:
    from ..quantities.uncertain import Uncertain

SIDES = ("minus", "plus", "low", "high")  # of uncertainties: the two of a standard one, and the ends of a range


class BadCells(JkrollError):
    """Error raised for cells that are no values of inputs, or no names of materials."""


class Task(NamedTuple):
    """The quantities to compute of every row, and the inputs and materials that the command line gives for all of them."""

    inputs: tuple[Column, ...]
    materials_at: tuple[tuple[str, int], ...]  # name and place of the columns that name materials
    quantities: tuple[str, ...]
    fixed: "Mapping[str, float | Uncertain]"  # inputs that fill what a row does not give
    spheres: tuple[Material | None, Material | None]  # materials that do so
    known: Materials
    keeps: bool = False  # whether a row beyond pull-off keeps the results that need no contact
    model: str | None = None  # law of attraction, which is then a column before the results
    doubt: bool = False  # whether there is a column of doubts
    sides: tuple[str, ...] = ()  # those of SIDES that have columns beside each result
    strict: bool = False  # whether a row that fails ends the run
    always: frozenset[str] = frozenset()  # quantities that were asked for by name, though no answer shows them

    @property
    def places(self) -> dict[str, int]:
        """The places of the columns of inputs and materials, by name."""
        return {column.name: column.place for column in self.inputs} | dict(self.materials_at)

    @property
    def headers(self) -> list[str]:
        """The headers of the numbers: of each quantity, and of the sides of its uncertainty."""
        return [head for name in self.quantities for head in heads(name, header(name), self.sides)]

    @property
    def said(self) -> dict[str, str]:
        """The columns of text that are the same for all rows."""
        return {"model": self.model} if self.model is not None else {}

    @property
    def remarks(self) -> tuple[str, ...]:
        """The columns of text after the results, which are empty in most rows."""
        return (DOUBT, STATUS) if self.doubt else (STATUS,)

    @property
    def added(self) -> list[str]:
        """The headers of all columns that a table gets."""
        return [*self.said, *self.headers, *self.remarks]

    def scene(self, given: Mapping[str, Any], *spheres: Material | None) -> Scene:
        """Return the scene of inputs and of the materials of both spheres. Raises an error of the scene."""
        return Scene({**self.fixed, **given}, *spheres, model=self.model)

    def scene_of(self, text_of: Callable[[str], str]) -> Scene:
        """Return the scene of a row. `text_of` gives the cell of an input. Raises BadCells, or an error of the scene."""
        found: dict[str, Any] = dict(zip(MATERIALS, self.spheres, strict=True))
        readers: dict[str, Callable[[str], Any]] = {column.name: column.read for column in self.inputs}
        readers |= {name: self.known.__getitem__ for name, _ in self.materials_at}
        problems: list[str] = []
        for name, read in readers.items():
            text = text_of(name)
            try:
                if text.strip():
                    found[name] = read(text)
            except JkrollError as error:
                problems.append(str(error))
        if problems:
            raise BadCells("; ".join(problems))
        spheres = [found.pop(name) for name in MATERIALS]
        return self.scene(found, *spheres)
