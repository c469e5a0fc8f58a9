"""The results of a scene, of arrays or of numbers: values, uncertainties, doubts, and the words for what has no value."""

from collections.abc import Callable, Mapping, Sequence
from typing import Any

import numpy

from ..answers.answer import concerns
from ..answers.other_laws import rests_on_spacing
from ..errors import JkrollError, NoResult
from ..materials.library import Material
from ..quantities.nomenclature import NOMENCLATURE
from ..quantities.uncertain import Uncertain
from ..scene import elements, uncertainty
from ..scene.errors import MissingInput, NoContact
from ..scene.limits import LIMITS, doubts
from ..scene.results import are_answers
from ..scene.scene import Scene
from ..text import first_of
from .blocks import Results
from .cells import Mask
from .task import BadCells, Task

CODES = tuple(limit.code(doubt) for limit in LIMITS if limit.name != "tabor_parameter" for doubt in limit.doubts)
MOST_NAMES = 3  # of quantities in a clause of a status
_NO_COLUMNS = "for which the table has no columns; --uncertainty adds them"


class RestsOnSpacing(NoResult):
    """Error raised for a quantity that the atomic spacing decides on, where it was not given."""

    def reason(self) -> str:
        """Return what decides."""
        spacing = NOMENCLATURE["atomic_spacing"]
        return f"rests on {spacing.symbol}; give {spacing.option} {spacing.example}"


class Evaluated(Results):
    """The results of rows that have one scene.

    A scene of arrays leaves rows open: those that fail for no reason that the physics has, and those whose uncertainties
    need a search. A scene of numbers leaves none. Raises a JkrollError for uncertainties that do not go together, or for which
    the table has no columns.
    """

    def __init__(
        self, task: Task, scene: Scene, size: int, materials: Callable[[int], tuple[Material | None, ...]]
    ) -> None:
        """`size`: the number of rows; `materials`: of both spheres of a row, by its place."""
        super().__init__(task, size)
        self.scene, self.materials = scene, materials
        self.is_open: Mask = numpy.zeros(size, dtype=bool)
        self._fails: Mask = numpy.zeros(self.values.shape, dtype=bool)  # where the scene has a quantity, but no value
        self._missing: list[str] = []  # quantities that lack inputs
        self._reasons: dict[str, NoResult] = {}  # why a quantity fails, where it does so for one reason
        shown = {name: name in task.always or concerns(name, scene) for name in task.quantities}
        outcomes = scene.evaluate([name for name, is_shown in shown.items() if is_shown is not False])
        for place, name in enumerate(task.quantities):
            if isinstance(outcomes.get(name), MissingInput):
                self._missing.append(name)
            elif name in outcomes:
                self._judge(place, name, outcomes[name], shown[name])
        names = [name for name in outcomes if name not in self._missing]
        self._explain(names)
        if scene.is_uncertain:
            self._propagate()
        for place in numpy.flatnonzero(self.is_open).tolist():
            self.status.pop(place, None)
        unclear = numpy.array([*self.status], dtype=int)
        self.lost |= {*unclear[numpy.isnan(self.values[:, unclear]).all(axis=0)].tolist()}
        if task.doubt:
            self._doubt(names)

    def _judge(self, place: int, name: str, outcome: Any, is_shown: Any) -> None:
        """Take the values of a quantity where it is shown, and note where it should have one and has none."""
        values, fails = self.values[place], self._fails[place]
        if isinstance(outcome, NoResult):
            self._reasons[name] = outcome
            fails[...] = is_shown
            return
        values[...] = outcome
        if isinstance(outcome, numpy.ndarray):
            fails[...] = ~are_answers(name, values)
        if numpy.any(rests_on_spacing(name, self.scene)):
            self._reasons[name] = RestsOnSpacing()
            fails |= rests_on_spacing(name, self.scene)
        if is_shown is not True:
            fails &= is_shown
            values[~is_shown] = numpy.nan
        values[fails] = numpy.nan

    def _explain(self, names: Sequence[str]) -> None:
        """Say why values of these quantities are missing. Where there is no contact, that alone is the reason."""
        fails: Mask = numpy.any(self._fails, axis=0)
        failures = elements.Failures(self.scene, names, len(fails)) if fails.any() else None
        texts: dict[object, str] = {}
        for place in numpy.flatnonzero(fails | bool(self._missing)).tolist():
            found = {**self._reasons, **(failures.at(place) if failures is not None else {})}
            no_contact = next((reason for reason in found.values() if isinstance(reason, NoContact)), None)
            if no_contact is not None:
                self.lose(place, str(no_contact), keeps=self.task.keeps)
                continue
            places = numpy.flatnonzero(self._fails[:, place]).tolist()
            reasons = {name: found.get(name) for name in map(self.task.quantities.__getitem__, places)}
            if None in reasons.values():
                self.is_open[place] = True
                continue
            key = (*map(id, self.materials(place)), *reasons, *map(str, reasons.values()))
            if key not in texts:
                errors: dict[str, Any] = {**self._needs(place), **reasons}
                texts[key] = worded({name: errors[name] for name in self.task.quantities if name in errors})
            self.status[place] = texts[key]

    def _needs(self, place: int) -> dict[str, Any]:
        """Return what quantities lack in a row, in the words of a scene that has its materials by name."""
        given = {name: elements.element(value, place) for name, value in self.scene.stated.items()}
        return self.task.scene(given, *self.materials(place)).evaluate(self._missing)

    def _propagate(self) -> None:
        """Add the uncertainties, and the remark on those that should be there and are not."""
        has_value: Mask = numpy.any(~numpy.isnan(self.values), axis=1)
        values = {name: self.values[place] for place, name in enumerate(self.task.quantities) if has_value[place]}
        sources = uncertainty.sources_of(self.scene, self.scene.inputs_of(*values) if values else ())
        remark = ""
        if any(side not in self.task.sides for source in sources.entering for side in source.given.sides):
            remark = left_out(self.scene, sources)
        elif not any(isinstance(value, numpy.ndarray) for value in self.scene.given.values()):
            remark = self._search([*values])
        elif sources.entering:
            for name, found in elements.uncertainties(self.scene, values, sources.entering).items():
                self._add(name, found)
                self.is_open |= numpy.isnan(found.low) & ~numpy.isnan(values[name])
        for place in range(len(self.is_open)) if remark else ():
            if place not in self.lost:
                self.status[place] = "; ".join(filter(None, [self.status.get(place), remark]))

    def _search(self, names: Sequence[str]) -> str:
        """Add the uncertainties of quantities of numbers, and return why some have none."""
        found, _ = uncertainty.uncertainties(self.scene, names)
        for name, one in found.items():
            if not isinstance(one, JkrollError):
                self._add(name, one.uncertainty)
        failures = {name: one for name, one in found.items() if isinstance(one, JkrollError)}
        return worded(failures, "no uncertainty, as there is no value at an end of an input: ")

    def _add(self, name: str, found: Uncertain) -> None:
        """Take the uncertainty of a quantity where it has one."""
        sides = self.task.sides
        first = (1 + len(sides)) * self.task.quantities.index(name) + 1
        for row, side in enumerate(sides, first):
            if side in found.sides:
                self.numbers[row] = numpy.where(found.low < found.high, found.sides[side], numpy.nan)

    def _doubt(self, names: Sequence[str]) -> None:
        """Take the codes of the doubts. The law of adhesion is not doubted here."""
        found = [(code, is_so) for code, is_so in doubts(self.scene, names).items() if code in CODES]
        bits = numpy.zeros(len(self.is_open), dtype=numpy.int64)
        for place, (_, is_so) in enumerate(found):
            bits |= numpy.asarray(is_so, dtype=numpy.int64) << place
        bits[self.is_open] = 0
        bits[[*self.lost]] = 0
        words = {
            key: " ".join(code for place, (code, _) in enumerate(found) if key >> place & 1)
            for key in numpy.unique(bits).tolist()
        }
        places = numpy.flatnonzero(bits)
        self.doubts.update(zip(places.tolist(), map(words.__getitem__, bits[places].tolist()), strict=True))


def left_out(scene: Scene, sources: uncertainty.Sources) -> str:
    """Return the remark on a row whose materials have uncertainties for which the table has no columns.

    Raises BadCells if a cell has one.
    """
    names = [name for source in sources.entering for name in source.names]
    if stated := [name for name in names if name in scene.uncertain]:
        raise BadCells(f"{stated[0]}: the cell has an uncertainty, {_NO_COLUMNS}")
    materials = dict.fromkeys(material.name for material, _ in scene.data_used(names))
    return f"{' and '.join(materials)}: uncertainties are left out, {_NO_COLUMNS}"


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
