"""A group of rows as it was evaluated: the values, their uncertainties, and why some have none."""

from typing import Any

import numpy

from ..answers.other_laws import rests_on_spacing
from ..errors import NoResult
from ..quantities.uncertain import Measured
from ..scene.elements import Failures, Reasons, ranges, standard_uncertainties
from ..scene.errors import MissingInput, NoContact
from ..scene.results import are_answers
from ..scene.scene import Scene
from ..scene.uncertainty import MixedKinds, sources_of
from .cells import Floats, Mask
from .single import SIDES, BadCells, RestsOnSpacing, Task, left_out

MOST_RANGES = 4  # that are moved together: their corners double with each


class Evaluated:
    """The quantities of a scene of arrays: a row of numbers for each, with nan where there is no value."""

    def __init__(self, task: Task, scene: Scene, size: int) -> None:
        """`size`: of the arrays."""
        self.task, self.scene = task, scene
        self.values: Floats = numpy.full((len(task.quantities), size), numpy.nan)
        self.sides: dict[str, Floats] = {}  # of the uncertainties
        self.fails: Mask = numpy.zeros(self.values.shape, dtype=bool)  # where the scene has a quantity, but no value
        self.missing: list[str] = []  # quantities that lack inputs
        self.known: list[str] = []  # the others
        self.remark = ""  # on all elements
        self._reasons: dict[str, NoResult] = {}  # why a quantity fails, where it does so for one reason
        shown = {name: task.shows(name, scene) for name in task.quantities}
        outcomes = scene.evaluate([name for name, is_shown in shown.items() if is_shown is not False])
        for place, name in enumerate(task.quantities):
            if isinstance(outcomes.get(name), MissingInput):
                self.missing.append(name)
            elif name in outcomes:
                self.known.append(name)
                self._judge(place, name, outcomes[name], shown[name])
        self._failures = Failures(scene, self.known, size) if self.fails.any() else None

    def _judge(self, place: int, name: str, outcome: Any, is_shown: Any) -> None:
        """Take the values of a quantity where it is shown, and note where it should have one and has none."""
        values, fails = self.values[place], self.fails[place]
        if isinstance(outcome, NoResult):
            self._reasons[name] = outcome
            fails[...] = is_shown
            return
        values[...] = outcome
        fails[...] = ~are_answers(name, values)
        if numpy.any(rests_on_spacing(name, self.scene)):
            self._reasons[name] = RestsOnSpacing()
            fails |= rests_on_spacing(name, self.scene)
        if is_shown is not True:
            fails &= is_shown
            values[~is_shown] = numpy.nan
        values[fails] = numpy.nan

    def reasons(self, place: int) -> NoContact | Reasons:
        """Return why quantities have no value at a place. Where there is no contact, that alone is the reason."""
        of_place = self._failures.at(place) if self._failures is not None else {}
        if isinstance(of_place, NoContact):
            return of_place
        found: Reasons = {**self._reasons, **of_place}
        if no_contact := next((one for one in found.values() if isinstance(one, NoContact)), None):
            return no_contact
        return {
            name: found.get(name)
            for name, fails in zip(self.task.quantities, self.fails[:, place], strict=True)
            if fails
        }

    def propagate(self) -> Mask:
        """Add the uncertainties; return the elements whose uncertainties are to be computed one by one."""
        places = {name: self.task.quantities.index(name) for name in self.known}
        values = {name: self.values[place] for name, place in places.items() if not self.fails[place].all()}
        is_odd = numpy.zeros(self.values.shape[1], dtype=bool)
        try:
            sources = sources_of(self.scene, self.scene.inputs_of(*values) if values else ())
            if not self.task.has_columns_for(sources):
                self.remark = left_out(self.scene, sources)
                return is_odd
        except (MixedKinds, BadCells):
            return ~is_odd
        if not sources.entering:
            return is_odd
        is_standard = isinstance(sources.entering[0].given, Measured)
        if not is_standard and len(sources.entering) > MOST_RANGES:
            return ~is_odd
        kind, compute = ("standard", standard_uncertainties) if is_standard else ("range", ranges)
        self.sides = {side: numpy.full(self.values.shape, numpy.nan) for side in SIDES[kind]}
        for name, (low, high) in compute(self.scene, values, sources.entering).items():
            is_moved = (low > 0) | (high > 0) if is_standard else low < high
            for side, numbers in zip(self.sides, (low, high), strict=True):
                self.sides[side][places[name]] = numpy.where(is_moved, numbers, numpy.nan)
            is_odd |= numpy.isnan(low) & ~numpy.isnan(values[name])
        return is_odd
