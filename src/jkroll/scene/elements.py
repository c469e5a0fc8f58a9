"""The elements of a scene of arrays, one by one: why an element has no value, and what its uncertainty is."""

from collections.abc import Collection, Mapping, Sequence
from itertools import product
from typing import Any

import numpy

from ..errors import NoResult
from ..quantities.uncertain import Interval, Measured, Uncertain
from .errors import NoContact
from .failures import failure_of
from .results import with_nan
from .scene import Scene
from .uncertainty import ASYMMETRIC, NEAR, ROUNDING, SAMPLES, Source, TooManyRanges

MOST_RANGES = 4  # that are moved together: their corners double with each
Reasons = dict[str, NoResult | None]  # why quantities have no value: None where nothing in the physics explains it


class Failures:
    """The formulas of a scene of arrays that have no value in some element."""

    def __init__(self, scene: Scene, names: Sequence[str], size: int) -> None:
        """`names`: quantities that the scene has evaluated. `size`: of the arrays."""
        plan = scene.plan(*names)
        self.sources = plan.found
        steps = [(step, _fails(step.name, scene.values.get(step.name))) for step in plan.steps]
        self.steps = [(step, fails.tolist()) for step, fails in steps if fails.any()]
        used = {source for step, _ in self.steps for _, source in step.arguments}
        self.values = {
            name: numpy.broadcast_to(scene.values[name], size).tolist() for name in used if name in scene.values
        }

    def at(self, place: int) -> Reasons:
        """Return why quantities have no value at a place. Where there is no contact, that alone is the reason."""
        failed: Reasons = {}
        for (name, _, arguments), fails in self.steps:
            if not fails[place]:
                continue
            first = next((source for _, source in arguments if source in failed), None)
            if first is not None:
                failed[name] = failed[first]
                continue
            found = failure_of(name, {parameter: self.values[source][place] for parameter, source in arguments})
            if isinstance(found, NoContact):
                return {name: found}
            failed[name] = found
        return {name: failed[source] for name, source in self.sources.items() if source in failed}


def element(value: Any, place: int) -> float:
    """Return an element of an array; a number stands for all elements."""
    return float(value[place]) if isinstance(value, numpy.ndarray) else float(value)


def _fails(name: str, value: Any) -> Any:
    """Return which elements of an array are no result."""
    return numpy.isnan(with_nan(name, value)) if isinstance(value, numpy.ndarray) else numpy.zeros(0, dtype=bool)


def uncertainties(scene: Scene, values: Mapping[str, Any], sources: Sequence[Source]) -> dict[str, Uncertain]:
    """Return the uncertainty of each quantity, element by element, from sources of one kind, as `uncertainty` does for numbers.

    Both sides are nan where an end of a source has no value, and where the extremes of a range need a search. Raises
    TooManyRanges.
    """
    if isinstance(sources[0].given, Measured):
        return _in_quadrature(scene, values, sources)
    if len(sources) > MOST_RANGES:
        raise TooManyRanges(len(sources))
    return _over_ranges(scene, values, sources)


def _in_quadrature(scene: Scene, values: Mapping[str, Any], sources: Sequence[Source]) -> dict[str, Uncertain]:
    """Return standard uncertainties. Both sides are 0 where no source has an influence."""
    ends = [
        [_outcome(scene, values, [source], [end]) for end in (source.given.low, source.given.high)]
        for source in sources
    ]
    found: dict[str, Uncertain] = {}
    for name, value in values.items():
        minus: Any = 0.0
        plus: Any = 0.0
        for pair in ends:
            changes = numpy.broadcast_arrays(0.0, *(end[name] - value for end in pair))
            minus = numpy.hypot(minus, numpy.min(changes, axis=0))
            plus = numpy.hypot(plus, numpy.max(changes, axis=0))
        alike = numpy.abs(plus - minus) <= ASYMMETRIC * numpy.maximum(plus, minus)
        felt = numpy.maximum(minus, plus) > ROUNDING * numpy.abs(value)
        minus, plus, middle = felt * minus, felt * plus, felt * (minus + plus) / 2
        found[name] = Measured(value, numpy.where(alike, middle, minus), numpy.where(alike, middle, plus))
    return found


def _over_ranges(scene: Scene, values: Mapping[str, Any], sources: Sequence[Source]) -> dict[str, Uncertain]:
    """Return the least and the largest value of each quantity over all ranges together: values at corners of the ranges.

    Both are nan where a step from a corner into the ranges leads further, as there is a turning point inside then.
    """
    limits = [(source.given.low, source.given.high) for source in sources]
    corners = [_outcome(scene, values, sources, corner) for corner in product(*limits)]
    parts = [NEAR * (high - low) / SAMPLES for low, high in limits]
    steps = [
        _outcome(scene, values, sources, [*corner[:axis], corner[axis] + (1 - 2 * side) * width, *corner[axis + 1 :]])
        for corner, sides in zip(product(*limits), product((0, 1), repeat=len(limits)), strict=True)
        for axis, (side, width) in enumerate(zip(sides, parts, strict=True))
    ]
    found: dict[str, Uncertain] = {}
    for name, value in values.items():
        at_corners = numpy.stack(numpy.broadcast_arrays(value, *(one[name] for one in corners)))[1:]
        beside = numpy.stack(numpy.broadcast_arrays(value, *(one[name] for one in steps)))[1:]
        from_corner = numpy.repeat(at_corners, len(limits), axis=0)
        low: Any = at_corners.min(axis=0)
        high: Any = at_corners.max(axis=0)
        is_felt = high - low > ROUNDING * numpy.abs(value)
        low, high = numpy.where(is_felt, low, value), numpy.where(is_felt, high, value)
        turns = ((beside > high) & (from_corner == high)) | ((beside < low) & (from_corner == low))
        is_odd = turns.any(axis=0) | numpy.isnan(beside).any(axis=0)
        low, high = numpy.minimum(low, value), numpy.maximum(high, value)
        low[is_odd] = high[is_odd] = numpy.nan
        found[name] = Interval(value, low, high)
    return found


def _outcome(scene: Scene, names: Collection[str], sources: Sequence[Source], place: Sequence[Any]) -> dict[str, Any]:
    """Return quantities where each source has a value, nan for those that have none."""
    changed: dict[str, Any] = {}
    for source, value in zip(sources, place, strict=True):
        changed |= source.at(value)
    return {**dict.fromkeys(names, numpy.nan), **scene.replace(**changed).numbers(*names)}
