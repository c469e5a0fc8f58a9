"""A row as a scene of its own: slow, but a failure has the words of a one-liner."""

from collections.abc import Callable, Mapping, Sequence
from math import isnan, nan
from typing import TYPE_CHECKING, Any, NamedTuple

from ..answers.answer import concerns
from ..answers.other_laws import rests_on_spacing
from ..errors import JkrollError, NoResult
from ..materials.library import Material, Materials
from ..quantities.nomenclature import NOMENCLATURE, header
from ..scene.errors import MissingInput, NoContact
from ..scene.limits import LIMITS, doubts
from ..scene.scene import Scene
from ..text import first_of
from .columns import DOUBT, STATUS, Column

if TYPE_CHECKING:
    from ..quantities.uncertain import Uncertain
    from ..scene.uncertainty import Propagated, Sources

CODES = tuple(limit.code(doubt) for limit in LIMITS if limit.name != "tabor_parameter" for doubt in limit.doubts)
SIDES = {"standard": ("minus", "plus"), "range": ("low", "high")}  # of the kinds of uncertainty, as answers name them
MOST_NAMES = 3  # of quantities in a clause of a status
_NO_COLUMNS = "for which the table has no columns; --uncertainty adds them"


class Task(NamedTuple):
    """The quantities to compute of every row, and the inputs and materials that the command line gives for all of them."""

    inputs: tuple[Column, ...]
    materials_at: tuple[tuple[str, int], ...]
    quantities: tuple[str, ...]
    fixed: "Mapping[str, float | Uncertain]"  # inputs that fill what a row does not give
    material: Material | None
    material2: Material | None
    known: Materials
    keeps: bool = False  # whether a row beyond pull-off keeps the results that need no contact
    model: str | None = None  # law of attraction, which is then a column before the results
    doubt: bool = False  # whether there is a column of doubts
    kinds: tuple[str, ...] = ()  # of the uncertainties that have columns
    strict: bool = False  # whether a row that fails ends the run
    always: frozenset[str] = frozenset()  # quantities that were asked for by name, though no answer shows them

    @property
    def places(self) -> dict[str, int]:
        """The places of the columns of inputs and materials, by name."""
        return {column.name: column.place for column in self.inputs} | dict(self.materials_at)

    @property
    def sides(self) -> tuple[str, ...]:
        """The sides of an uncertainty that have columns beside each result."""
        return tuple(side for kind in self.kinds for side in SIDES[kind])

    @property
    def headers(self) -> list[str]:
        """The headers of the numbers: of each quantity, and of the sides of its uncertainty."""
        return [
            head
            for name in self.quantities
            for head in (header(name), *(header(name).replace(name, f"{name}_{side}") for side in self.sides))
        ]

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

    def has_columns_for(self, sources: "Sources") -> bool:
        """Return whether there are columns for the uncertainties that these sources cause."""
        return all(source.given.kind in self.kinds for source in sources.entering)

    def shows(self, name: str, scene: Scene) -> Any:
        """Return whether a quantity is a result of a scene, or for which elements of its arrays."""
        return name in self.always or concerns(name, scene)


class RestsOnSpacing(NoResult):
    """Error raised for a quantity that the atomic spacing decides on, where it was not given."""

    def reason(self) -> str:
        """Return what decides."""
        spacing = NOMENCLATURE["atomic_spacing"]
        return f"rests on {spacing.symbol}; give {spacing.option} {spacing.example}"


class Single(NamedTuple):
    """The results of a row, its status, whether it has no trusted result, and the codes of its doubts."""

    values: list[float]
    status: str
    is_lost: bool
    doubt: str = ""
    sides: Mapping[str, Mapping[str, float]] = {}  # of the uncertainties, by quantity


class BadCells(JkrollError):
    """Error raised for cells that are no values of inputs, or no names of materials."""


def scene_of(task: Task, text_of: Callable[[str], str]) -> Scene:
    """Return the scene of a row. `text_of` gives the cell of an input. Raises BadCells, or an error of the scene."""
    given: dict[str, Any] = {}
    spheres: dict[str, Material | None] = {"material": task.material, "material2": task.material2}
    problems: list[str] = []
    cells: list[tuple[str, dict[str, Any], Callable[[str], Any]]] = [
        *((column.name, given, column.read) for column in task.inputs),
        *((name, spheres, task.known.__getitem__) for name, _ in task.materials_at),
    ]
    for name, found, read in cells:
        text = text_of(name)
        try:
            if text.strip():
                found[name] = read(text)
        except JkrollError as error:
            problems.append(str(error))
    if problems:
        raise BadCells("; ".join(problems))
    return Scene({**task.fixed, **given}, *spheres.values(), model=task.model)


def alone(task: Task, text_of: Callable[[str], str]) -> Single:
    """Return the results of a row. `text_of` gives the cell of an input."""
    try:
        return _of_scene(task, scene_of(task, text_of))
    except JkrollError as error:
        return _lost(task, str(error))


def _of_scene(task: Task, scene: Scene) -> Single:
    """Return the results of a scene. Raises a JkrollError if it is none, or for uncertainties that do not go together."""
    values = dict.fromkeys(task.quantities, nan)
    errors: dict[str, JkrollError] = {}
    shown = [name for name in task.quantities if task.shows(name, scene)]
    for name, outcome in scene.evaluate(shown).items():
        if isinstance(outcome, JkrollError):
            errors[name] = outcome
        elif rests_on_spacing(name, scene):
            errors[name] = RestsOnSpacing()
        else:
            values[name] = float(outcome)
    no_contact = next((error for error in errors.values() if isinstance(error, NoContact)), None)
    if no_contact is not None and not task.keeps:
        return _lost(task, str(no_contact))
    answered = [name for name, value in values.items() if not isnan(value)]
    sides, remark = _uncertainties(task, scene, answered) if scene.is_uncertain else ({}, "")
    if no_contact is not None:
        return Single([*values.values()], str(no_contact), True, "", sides)
    status = "; ".join(filter(None, [worded(errors), remark]))
    doubt = " ".join(code for code, is_so in doubts_of(scene, answered).items() if is_so) if task.doubt else ""
    return Single([*values.values()], status, not answered and bool(errors), doubt, sides)


def _lost(task: Task, status: str) -> Single:
    return Single([nan] * len(task.quantities), status, True)


def _uncertainties(task: Task, scene: Scene, names: Sequence[str]) -> tuple[dict[str, Mapping[str, float]], str]:
    """Return the sides of the uncertainties of quantities, and why some that should have one have none."""
    from ..scene.uncertainty import uncertainties

    found, sources = uncertainties(scene, names)
    if not task.has_columns_for(sources):
        return {}, left_out(scene, sources)
    failures = {name: one for name, one in found.items() if isinstance(one, JkrollError)}
    remark = worded(failures, "no uncertainty, as there is no value at an end of an input: ")
    return {name: _sides(one) for name, one in found.items() if not isinstance(one, JkrollError)}, remark


def _sides(found: "Propagated") -> dict[str, float]:
    return {side: getattr(found.uncertainty, side) for side in SIDES[found.uncertainty.kind]}


def left_out(scene: Scene, sources: "Sources") -> str:
    """Return the remark on a row whose materials have uncertainties for which the table has no columns.

    Raises BadCells if a cell has one.
    """
    names = [name for source in sources.entering for name in source.names]
    if stated := [name for name in names if name in scene.uncertain]:
        raise BadCells(f"{stated[0]}: the cell has an uncertainty, {_NO_COLUMNS}")
    materials = dict.fromkeys(material.name for material, _ in scene.data_used(names))
    return f"{' and '.join(materials)}: uncertainties are left out, {_NO_COLUMNS}"


def doubts_of(scene: Scene, names: Sequence[str]) -> dict[str, Any]:
    """Return by its code whether a doubt concerns a scene, or which elements. The law of adhesion is not doubted here."""
    return {code: is_so for code, is_so in doubts(scene, names).items() if code in CODES}


def worded(errors: Mapping[str, JkrollError], lead: str = "") -> str:
    """Return why quantities have no value: a clause for all that lack an input, and one for each other reason."""
    lacking = {name: one for name, one in errors.items() if isinstance(one, MissingInput) and one.missing}
    joined = _joined([*lacking.values()])
    reasons: dict[str, list[str]] = {}
    for name, error in errors.items():
        reason = joined if name in lacking else str(error).removeprefix(f"{name}: ")
        reasons.setdefault(reason, []).append(name)
    return "; ".join(f"{first_of(names, MOST_NAMES)}: {lead}{reason}" for reason, names in reasons.items())


def _joined(errors: Sequence[MissingInput]) -> str:
    """Return the reason of quantities that lack inputs, with all that some of them need."""
    if len({error.missing for error in errors}) < 2:
        return min((error.reason() for error in errors), key=len, default="")
    missing = dict.fromkeys(name for error in errors for name in error.missing)
    instead = [name for name in errors[0].instead if all(name in error.instead for error in errors)]
    lacking = dict.fromkeys(filter(None, (text for error in errors for text in error.lacking.split(", "))))
    return f"need some of {MissingInput('', [*missing], instead, ', '.join(lacking)).needs()}"
