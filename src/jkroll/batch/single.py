"""A row as a scene of its own: slow, but a failure has the words of a one-liner."""

from collections.abc import Callable, Mapping, Sequence
from math import isnan, nan
from typing import Any, NamedTuple

from ..errors import JkrollError, NoResult
from ..materials.library import Material, Materials
from ..quantities.nomenclature import STATE
from ..scene.errors import BeyondFold, BeyondPullOff, MissingInput
from ..scene.limits import LIMITS, doubts
from ..scene.scene import Scene
from .columns import DOUBT, STATUS, Column

FATAL = (BeyondPullOff, BeyondFold)  # no other result of the row is trusted either
CODES = tuple(limit.code(doubt) for limit in LIMITS if limit.name != "tabor_parameter" for doubt in limit.doubts)


class Task(NamedTuple):
    """The quantities to compute of every row, and the inputs and materials that the command line gives for all of them."""

    inputs: tuple[Column, ...]
    materials_at: tuple[tuple[str, int], ...]
    quantities: tuple[str, ...]
    fixed: Mapping[str, float]  # inputs that fill what a row does not give
    material: Material | None
    material2: Material | None
    known: Materials
    keeps: bool = False  # whether a row beyond pull-off keeps the results that need no contact
    model: str | None = None  # law of attraction, which is then a column before the results
    doubt: bool = False  # whether there is a column of doubts

    @property
    def said(self) -> dict[str, str]:
        """The columns of text that are the same for all rows."""
        return {"model": self.model} if self.model is not None else {}

    @property
    def remarks(self) -> tuple[str, ...]:
        """The columns of text after the results, which are empty in most rows."""
        return (DOUBT, STATUS) if self.doubt else (STATUS,)


class Single(NamedTuple):
    """The results of a row, its status, whether it has no trusted result, and the codes of its doubts."""

    values: list[float]
    status: str
    is_lost: bool
    doubt: str = ""


def alone(task: Task, text_of: Callable[[str], str]) -> Single:
    """Return the results of a row. `text_of` gives the cell of an input."""
    nothing = [nan] * len(task.quantities)
    given: dict[str, float] = {}
    problems: list[str] = []
    for column in task.inputs:
        text = text_of(column.name)
        try:
            if text.strip():
                given[column.name] = column.read(text)
        except JkrollError as error:
            problems.append(str(error))
    spheres: dict[str, Material | None] = {"material": task.material, "material2": task.material2}
    for name, _ in task.materials_at:
        text = text_of(name)
        try:
            if text.strip():
                spheres[name] = task.known[text]
        except JkrollError as error:
            problems.append(str(error))
    if problems:
        return Single(nothing, "; ".join(problems), True)
    try:
        scene = Scene({**task.fixed, **given}, *spheres.values(), model=task.model)
    except JkrollError as error:
        return Single(nothing, str(error), True)
    values: list[float] = []
    errors: dict[str, JkrollError] = {}
    for name in task.quantities:
        try:
            values.append(float(scene[name]) if concerns(name, scene) and _is_said(name, scene) else nan)
        except (MissingInput, NoResult) as error:
            errors[name] = error
            values.append(nan)
    fatal = next((error for error in errors.values() if isinstance(error, FATAL)), None)
    if fatal is not None:
        return Single(values if task.keeps else nothing, str(fatal), True)
    answered = [name for name, value in zip(task.quantities, values, strict=True) if not isnan(value)]
    doubt = " ".join(code for code, is_so in doubts_of(scene, answered).items() if is_so) if task.doubt else ""
    return Single(values, worded(errors), len(errors) == len(values), doubt)


def doubts_of(scene: Scene, names: Sequence[str]) -> dict[str, Any]:
    """Return by its code whether a doubt concerns a scene, or which elements. The law of adhesion is not doubted here."""
    return {code: is_so for code, is_so in doubts(scene, names).items() if code in CODES}


def concerns(name: str, scene: Scene) -> bool:
    """Return whether a quantity is a result of a scene, and not one of its inputs."""
    if name == "load":
        return bool(STATE & scene.stated.keys())
    return name not in scene.stated


def _is_said(name: str, scene: Scene) -> bool:
    return name != "rolling_frequency_as_printed" or scene.is_identical


def worded(errors: Mapping[str, JkrollError]) -> str:
    """Return why quantities have no value, with one clause for all that have the same reason."""
    reasons: dict[str, list[str]] = {}
    for name, error in errors.items():
        reason = error.reason() if isinstance(error, MissingInput) else str(error).removeprefix(f"{name}: ")
        reasons.setdefault(reason, []).append(name)
    return "; ".join(f"{', '.join(names)}: {reason}" for reason, names in reasons.items())


def lacking(name: str, scene: Scene) -> MissingInput | None:
    """Return the error that names what a quantity needs and a scene does not have, or None."""
    try:
        scene.plan(name)
    except MissingInput as error:
        return error
    return None
