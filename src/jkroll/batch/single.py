"""One row as a scene of its own: slow, but it finds the words of a one-liner for what went wrong."""

from collections.abc import Callable, Mapping
from math import nan
from typing import NamedTuple

from ..errors import JkrollError, NoResult
from ..materials.library import Material, Materials
from ..scene.errors import BeyondFold, BeyondPullOff, MissingInput
from ..scene.scene import Scene
from ..scene.wiring import STATE
from .columns import Column

FATAL = (BeyondPullOff, BeyondFold)  # they leave nothing of a row to be trusted


class Task(NamedTuple):
    """What is computed of every row, and what the command line says of all of them."""

    inputs: tuple[Column, ...]
    materials_at: tuple[tuple[str, int], ...]
    quantities: tuple[str, ...]
    fixed: Mapping[str, float]  # inputs that fill what a row does not give
    material: Material | None
    material2: Material | None
    known: Materials
    keeps: bool = False  # whether what needs no contact is kept where there is none


def alone(task: Task, text_of: Callable[[str], str]) -> tuple[list[float], str, bool]:
    """The results of one row, of which `text_of` gives the cell of an input, what is to be said of it, and whether it is lost."""
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
        return nothing, "; ".join(problems), True
    try:
        scene = Scene({**task.fixed, **given}, *spheres.values())
    except JkrollError as error:
        return nothing, str(error), True
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
        return values if task.keeps else nothing, str(fatal), True
    return values, worded(errors), len(errors) == len(values)


def concerns(name: str, scene: Scene) -> bool:
    """Whether a quantity has something to say of scenes of which this is known."""
    if name == "load":
        return bool(STATE & scene.stated.keys())
    return name not in scene.stated


def _is_said(name: str, scene: Scene) -> bool:
    return name != "rolling_frequency_as_printed" or scene.is_identical


def worded(errors: Mapping[str, JkrollError]) -> str:
    """Why quantities have no value; one clause for all that have the same reason."""
    reasons: dict[str, list[str]] = {}
    for name, error in errors.items():
        reason = f"needs {error.needs()}" if isinstance(error, MissingInput) else str(error).removeprefix(f"{name}: ")
        reasons.setdefault(reason, []).append(name)
    return "; ".join(f"{', '.join(names)}: {reason}" for reason, names in reasons.items())


def lacking(name: str, scene: Scene) -> MissingInput | None:
    """What a quantity needs that a scene does not have; None if it has all."""
    try:
        scene.plan(name)
    except MissingInput as error:
        return error
    return None
