"""The task of a run: the quantities to compute for every row, and what the command line gives for all of them."""

from collections.abc import Callable, Mapping
from typing import TYPE_CHECKING, Any, NamedTuple

from ..answers.answer import concerns
from ..answers.questions import quantities_named
from ..errors import BadRequest, JkrollError
from ..materials.library import Material, Materials
from ..output.layout import heads
from ..quantities.nomenclature import NOMENCLATURE, PROPERTIES, header
from ..quantities.ranges import value_of
from ..scene.errors import MissingInput
from ..scene.scene import EXCLUSIVE, Scene
from .columns import DOUBT, MATERIALS, STATUS, Column, Header

if TYPE_CHECKING:
    from ..quantities.uncertain import Uncertain

_SOME = 0.25  # a value that any input can have
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


def task_of(table: Header, inputs: Mapping[str, str], wanted: str, known: Materials) -> Task:
    """Return the task that the columns and options allow, without columns for uncertainties."""
    material, material2 = (known[inputs[name]] if name in inputs else None for name in MATERIALS)
    fixed = {name: value_of(text, name) for name, text in inputs.items() if name not in (*MATERIALS, "model")}
    task = Task(table.inputs, table.materials, (), fixed, (material, material2), known, model=inputs.get("model"))
    scene = _as_known(task)
    has_own_2 = any(name.endswith("2") for name in table.names)
    explicit, offered = quantities_named(wanted)
    for name in explicit:
        if name in table.names or name in fixed:
            raise BadRequest(f"--quantities: {name} is an input here")
        scene.plan(name)
    outcomes = scene.evaluate(offered)
    possible = [
        name
        for name in offered
        if name not in table.names
        and concerns(name, scene)
        and not (NOMENCLATURE[name].of_identical and has_own_2)
        and not isinstance(outcomes[name], MissingInput)
    ]
    quantities = tuple(dict.fromkeys((*explicit, *possible)))
    if not quantities:
        scene.plan(offered[0])
    return task._replace(
        quantities=quantities, always=frozenset(name for name in explicit if not concerns(name, scene))
    )


def _as_known(task: Task) -> Scene:
    """Return a scene in which every column has a value; of columns that exclude each other, the first."""
    given: dict[str, float] = {}
    for column in task.inputs:
        if not any(column.name in names and given.keys() & names for names in EXCLUSIVE):
            given[column.name] = _SOME
    some = Material("", dict.fromkeys(PROPERTIES, _SOME), (), {}, (), (), "", "")
    places = task.places
    return task.scene(
        given, *(some if name in places else one for name, one in zip(MATERIALS, task.spheres, strict=True))
    )
