"""The uncertainty of results, from those of the inputs: standard uncertainties in quadrature, ranges by their extremes.

Every source is moved over the whole of its uncertainty, and the quantities are computed anew there. No derivatives are taken, so
that a result may respond differently to either side, or have a turning point inside a range.
"""

from collections.abc import Callable, Collection, Iterable, Iterator, Mapping, Sequence
from functools import cache
from itertools import product
from math import fsum, hypot, isfinite
from typing import Any, NamedTuple

from ..errors import JkrollError, NoResult
from ..quantities.nomenclature import NOMENCLATURE
from ..quantities.values import Interval, Measured, Uncertain, is_uncertain
from .inverse import Solution, found_by, highest_between, solution, solutions, used_beside
from .scene import Scene
from .unknowns import Pair, Problem, used_beside_two
from .wiring import in_order

MAX_RANGES = 8  # whose corners are computed, all together
ASYMMETRIC = 0.1  # relative difference of the two sides from which on they are given one by one
SAMPLES = 24  # parts of a range in which turning points are looked for
NEAR = 1e-4  # of such a part, the distance from an end at which the quantity shows whether it grows inwards
ROUNDING = 4e-15  # of a value: a change as small as this comes from rounding, and not from a source
_ROUNDS = 10  # of a search along one range after the other

Evaluate = Callable[[Mapping[str, Any]], Mapping[str, Any]]  # from changed inputs to the outcome of each quantity


class MixedKinds(JkrollError):
    """Error raised for a range and a standard uncertainty in one scene."""

    def __init__(self, measured: str, interval: str) -> None:
        super().__init__(measured, interval)
        self.measured, self.interval = measured, interval

    def __str__(self) -> str:
        return f"{self.measured} has a standard uncertainty (±) and {self.interval} a range; give both of one kind"


class TooManyRanges(JkrollError):
    """Error raised for more ranges than can be combined."""

    def __init__(self, count: int) -> None:
        super().__init__(count)
        self.count = count

    def __str__(self) -> str:
        return f"{self.count} ranges are more than {MAX_RANGES}; give some of these inputs one value"


class Source(NamedTuple):
    """A value with an uncertainty, and the inputs that have this value and move with it."""

    names: tuple[str, ...]
    given: Uncertain

    def at(self, value: float) -> dict[str, float]:
        """Return the inputs of this source at a value."""
        return dict.fromkeys(self.names, value)


class Sources(NamedTuple):
    """The sources of uncertainty that enter a result, and those of materials that do not, as they are of the other kind."""

    entering: Sequence[Source]
    left_out: Sequence[Source] = ()


class Propagated(NamedTuple):
    """The uncertainty of a result, and the part that each source has in it."""

    uncertainty: Uncertain
    shares: Mapping[str, float]  # by the first input of a source; of the variance, or of the width of a range


def sources_of(scene: Scene, used: Collection[str], measured: Sequence[Source] = ()) -> Sources:
    """Return the sources that enter quantities, given the inputs that these depend on, and measured values if any.

    A value that sphere 2 takes over from sphere 1 moves with it; so do both values of a material that is named twice. All
    must be of one kind. It is that of the values that were stated; where none was, ± if some material has one. Raises MixedKinds or
    TooManyRanges.
    """
    stated = [*measured, *(source for source in _stated(scene) if not set(used).isdisjoint(source.names))]
    of_materials = [source for source in _of_materials(scene) if not set(used).isdisjoint(source.names)]
    kinds = {type(source.given) for source in stated or of_materials}
    if len(kinds) > 1 and stated:
        symbols = {type(source.given): NOMENCLATURE[source.names[0]].symbol for source in stated}
        raise MixedKinds(symbols[Measured], symbols[Interval])
    kind = Measured if Measured in kinds else Interval
    left_out = [source for source in of_materials if not isinstance(source.given, kind)]
    entering = [source for source in (*stated, *of_materials) if isinstance(source.given, kind)]
    if kind is Interval and len(entering) > MAX_RANGES:
        raise TooManyRanges(len(entering))
    return Sources(entering, left_out)


def _stated(scene: Scene) -> Iterator[Source]:
    for name in in_order(scene.uncertain):  # the order is the same for an option, a column and a list
        takes_over = name == "radius" and "radius2" not in scene.given
        yield Source(("radius", "radius2") if takes_over else (name,), scene.uncertain[name])


def _of_materials(scene: Scene) -> Iterable[Source]:
    found: dict[tuple[str, ...], Source] = {}
    for material, suffix in ((scene.material, ""), (scene.material2, "2")):
        for name, given in material.uncertainties.items() if material is not None else ():
            if material is not None and name + suffix not in scene.stated:
                key = (material.path, material.name, name)
                names = (*found[key].names, name + suffix) if key in found else (name + suffix,)
                found[key] = Source(names, given)
    return found.values()


def uncertainties(scene: Scene, names: Sequence[str]) -> tuple[dict[str, Propagated | JkrollError], Sources]:
    """Return the uncertainties of quantities of a scene, and their sources.

    A quantity without a finite value, or one on which no source has an influence, is left out. An error is the reason why a
    quantity has no value at one end of a source.
    """
    values = {name: value for name, value in scene.numbers(*names).items() if isfinite(value)}
    missing = scene.missing(names)
    sources = sources_of(scene, scene.inputs_of(*(name for name in names if name not in missing)))

    def evaluate(changed: Mapping[str, float]) -> Mapping[str, Any]:
        return scene.replace(**changed).evaluate([*values])

    return propagated(evaluate, values, sources.entering), sources


def inferred_sources(name: str, quantity: str, measured: Any, scene: Scene) -> Sources:
    """Return the sources of the uncertainty of an inferred input: the measured value, and the inputs of the scene."""
    of_measured = [Source((quantity,), measured)] if is_uncertain(measured) else []
    return sources_of(scene, used_beside(name, quantity, scene), of_measured)


def inferred_uncertainty(
    name: str, quantity: str, measured: float | Uncertain, found: Solution, scene: Scene
) -> tuple[Propagated | JkrollError | None, Sources]:
    """Return the uncertainty of an inferred input, and its sources."""
    sources = inferred_sources(name, quantity, measured, scene)

    def evaluate(changed: Mapping[str, float]) -> Mapping[str, Any]:
        at, beside = changed_inputs(quantity, measured, scene, changed)
        try:
            return {name: solution(name, quantity, at, beside).value}
        except NoResult as error:
            return {name: error}

    return propagated(evaluate, {name: found.value}, sources.entering).get(name), sources


def changed_inputs(quantity: str, measured: Any, scene: Scene, changed: Mapping[str, Any]) -> tuple[Any, Scene]:
    """Return a measured value and a scene, of which some have changed."""
    others = {each: value for each, value in changed.items() if each != quantity}
    return changed.get(quantity, measured.value if is_uncertain(measured) else measured), scene.replace(**others)


def sources_of_two(names: Sequence[str], measured: Mapping[str, Any], scene: Scene) -> Sources:
    """Return the sources of the uncertainty of two inferred inputs: the measured values, and the inputs of the scene."""
    of_measured = [Source((quantity,), one) for quantity, one in measured.items() if is_uncertain(one)]
    return sources_of(scene, used_beside_two(names, tuple(measured), scene), of_measured)


def uncertainties_of_two(
    measured: Mapping[str, float | Uncertain], found: Pair, scene: Scene
) -> tuple[dict[str, Propagated | JkrollError], Sources]:
    """Return the uncertainties of two inferred inputs, and their sources. Newton's method follows the pair to the ends of each."""
    sources = sources_of_two([*found.values], measured, scene)
    middles = {name: one if isinstance(one, float) else one.value for name, one in measured.items()}

    def evaluate(changed: Mapping[str, float]) -> Mapping[str, Any]:
        at = {name: changed.get(name, value) for name, value in middles.items()}
        beside = scene.replace(**{name: value for name, value in changed.items() if name not in at})
        try:
            return Problem([*found.values], at, beside).near(found.values).values
        except NoResult as error:
            return dict.fromkeys(found.values, error)

    return propagated(evaluate, found.values, sources.entering), sources


def propagated(
    evaluate: Evaluate, values: Mapping[str, float], effective: Sequence[Source]
) -> dict[str, Propagated | JkrollError]:
    """Return the uncertainties of values, from sources of one kind and a function that computes them from changed inputs."""
    if not effective:
        return {}
    combine = _in_quadrature if isinstance(effective[0].given, Measured) else _over_ranges
    return dict(combine(evaluate, values, effective))


# --- Standard uncertainties -------------------------------------------------------------------------------------------


def _in_quadrature(
    evaluate: Evaluate, values: Mapping[str, float], effective: Sequence[Source]
) -> Iterator[tuple[str, Propagated | JkrollError]]:
    """Iterate over standard uncertainties: the changes at both ends of each source, each side added in quadrature."""
    ends = [[evaluate(source.at(end)) for end in (source.given.low, source.given.high)] for source in effective]
    for name, value in values.items():
        outcomes = [[end[name] for end in pair] for pair in ends]
        failures = [end for pair in outcomes for end in pair if isinstance(end, JkrollError)]
        if failures:
            yield name, failures[0]
            continue
        changes = [[end - value for end in pair] for pair in outcomes]
        minus = hypot(*(min(0.0, *pair) for pair in changes))
        plus = hypot(*(max(0.0, *pair) for pair in changes))
        if abs(plus - minus) <= ASYMMETRIC * max(plus, minus):
            minus = plus = (minus + plus) / 2
        variances = [fsum(change**2 for change in pair) for pair in changes]
        if max(minus, plus) > ROUNDING * abs(value):
            yield name, Propagated(Measured(value, minus, plus), _shares(effective, variances))


def _shares(effective: Sequence[Source], parts: Sequence[float]) -> dict[str, float]:
    """Return the share of each source, the largest first; a source without influence has none."""
    whole = fsum(parts)
    shares = {source.names[0]: part / whole for source, part in zip(effective, parts, strict=True) if part}
    return dict(sorted(shares.items(), key=lambda share: -share[1]))


# --- Ranges -----------------------------------------------------------------------------------------------------------

Place = tuple[float, ...]  # a value of each range


def _over_ranges(
    evaluate: Evaluate, values: Mapping[str, float], effective: Sequence[Source]
) -> Iterator[tuple[str, Propagated | JkrollError]]:
    """Iterate over the least and the largest value of each quantity over all ranges together."""

    @cache
    def outcomes(place: Place) -> Mapping[str, Any]:
        changed: dict[str, float] = {}
        for source, value in zip(effective, place, strict=True):
            changed |= source.at(value)
        return evaluate(changed)

    for name, value in values.items():
        try:
            found = _range_of(_Surface(name, outcomes), value, effective)
        except JkrollError as error:
            yield name, error
            continue
        if found is not None:
            yield name, found


class _Surface:
    """A quantity as a function of a place in all ranges."""

    def __init__(self, name: str, outcomes: Callable[[Place], Mapping[str, Any]]) -> None:
        self.name, self.outcomes = name, outcomes

    def height(self, place: Place) -> float:
        """Return the value at a place, or raise the reason why there is none."""
        value = self.outcomes(place)[self.name]
        if isinstance(value, JkrollError):
            raise value
        return float(value)


def _range_of(surface: _Surface, value: float, effective: Sequence[Source]) -> Propagated | None:
    """Return the range of a quantity; None if it is the same everywhere."""
    limits = [(source.given.low, source.given.high) for source in effective]
    corners = [*product(*limits)]
    low = min(value, -_highest(lambda place: -surface.height(place), corners, limits))
    high = max(value, _highest(surface.height, corners, limits))
    if high - low <= ROUNDING * abs(value):
        return None
    middle = tuple(source.given.value for source in effective)
    widths = []
    for axis, ends in enumerate(limits):
        heights = [surface.height(_moved(middle, axis, sample)) for sample in _samples(*ends)]
        widths.append(max(heights) - min(heights))
    return Propagated(Interval(value, low, high), _shares(effective, widths))


def _highest(
    height: Callable[[Place], float], corners: Sequence[Place], limits: Sequence[tuple[float, float]]
) -> float:
    """Return the largest value over all ranges: that of a corner, or of a turning point beside it."""
    place = max(corners, key=height)
    for _ in range(_ROUNDS):
        before = place
        for axis, ends in enumerate(limits):
            place = max(place, _peak(height, place, axis, ends), key=height)
        if place == before:
            break
    return height(place)


def _peak(height: Callable[[Place], float], place: Place, axis: int, ends: tuple[float, float]) -> Place:
    """Return the place with the largest value along one range, by samples and a golden-section search beside the best one.

    An end that is the best of them is the place itself, unless the quantity still grows from there inwards.
    """

    def at(value: float) -> float:
        return height(_moved(place, axis, value))

    samples = _samples(*ends)
    best = max(range(len(samples)), key=lambda number: at(samples[number]))
    left, right = samples[max(best - 1, 0)], samples[min(best + 1, SAMPLES)]
    inwards = samples[best] + NEAR * (left + right - 2 * samples[best])
    if best in (0, SAMPLES) and at(inwards) <= at(samples[best]):
        return _moved(place, axis, samples[best])
    return _moved(place, axis, found_by(highest_between(left, right), at))


def _samples(low: float, high: float) -> list[float]:
    """Return equally spaced values from one end of a range to the other."""
    return [low, *(low + (high - low) * number / SAMPLES for number in range(1, SAMPLES)), high]


def _moved(place: Place, axis: int, value: float) -> Place:
    """Return a place with another value of one range."""
    return (*place[:axis], value, *place[axis + 1 :])


# --- Elements of a scene of arrays ------------------------------------------------------------------------------------

MOST_RANGES = 4  # that are moved together: their corners double with each


class Uncertainties(NamedTuple):
    """The uncertainty of a quantity, element by element."""

    sides: Mapping[str, Any]  # minus and plus, or low and high; nan where there is none
    is_open: Any  # where an end of a source has no value, or the extremes of a range need a search


def uncertainties_of_elements(
    scene: Scene, values: Mapping[str, Any], sources: Sequence[Source]
) -> dict[str, Uncertainties]:
    """Return the uncertainty of each quantity, from sources of one kind, as `uncertainty` does for numbers.

    Raises TooManyRanges.
    """
    return propagated_elements(lambda changed: scene.replace(**changed).numbers(*values), values, sources)


def inferred_uncertainty_elements(
    name: str, quantity: str, measured: Any, values: Any, scene: Scene
) -> Uncertainties | None:
    """Return the uncertainty of the values of an inferred input, if it has a source. Raises TooManyRanges."""
    import numpy

    sources = inferred_sources(name, quantity, measured, scene).entering

    def evaluate(changed: Mapping[str, Any]) -> Mapping[str, Any]:
        at, beside = changed_inputs(quantity, measured, scene, changed)
        found = solutions(name, quantity, numpy.broadcast_to(at, values.shape), beside)
        return {name: numpy.array([one if isinstance(one, float) else numpy.nan for one in found])}

    return propagated_elements(evaluate, {name: values}, sources)[name] if sources else None


def propagated_elements(
    evaluate: Evaluate, values: Mapping[str, Any], sources: Sequence[Source]
) -> dict[str, Uncertainties]:
    """Return the uncertainties of values, from sources of one kind and a function that computes them from changed inputs."""
    if isinstance(sources[0].given, Measured):
        return _elements_in_quadrature(evaluate, values, sources)
    if len(sources) > MOST_RANGES:
        raise TooManyRanges(len(sources))
    return _elements_over_ranges(evaluate, values, sources)


def _elements_in_quadrature(
    evaluate: Evaluate, values: Mapping[str, Any], sources: Sequence[Source]
) -> dict[str, Uncertainties]:
    """Return standard uncertainties."""
    import numpy

    ends = [
        [_outcome(evaluate, values, [source], [end]) for end in (source.given.low, source.given.high)]
        for source in sources
    ]
    found: dict[str, Uncertainties] = {}
    for name, value in values.items():
        minus: Any = 0.0
        plus: Any = 0.0
        for pair in ends:
            changes = numpy.broadcast_arrays(0.0, *(end[name] - value for end in pair))
            minus = numpy.hypot(minus, numpy.min(changes, axis=0))
            plus = numpy.hypot(plus, numpy.max(changes, axis=0))
        alike = numpy.abs(plus - minus) <= ASYMMETRIC * numpy.maximum(plus, minus)
        felt = numpy.maximum(minus, plus) > ROUNDING * numpy.abs(value)
        middle = (minus + plus) / 2
        sides = {"minus": numpy.where(alike, middle, minus), "plus": numpy.where(alike, middle, plus)}
        found[name] = _where(felt, sides, numpy.isnan(minus + plus))
    return found


def _elements_over_ranges(
    evaluate: Evaluate, values: Mapping[str, Any], sources: Sequence[Source]
) -> dict[str, Uncertainties]:
    """Return the least and the largest value of each quantity over all ranges together: values at corners of the ranges.

    An element is open where a step from a corner into the ranges leads further, as there is a turning point inside then.
    """
    import numpy

    limits = [(source.given.low, source.given.high) for source in sources]
    corners = [_outcome(evaluate, values, sources, corner) for corner in product(*limits)]
    parts = [NEAR * (high - low) / SAMPLES for low, high in limits]
    steps = [
        _outcome(
            evaluate, values, sources, [*corner[:axis], corner[axis] + (1 - 2 * side) * width, *corner[axis + 1 :]]
        )
        for corner, sides in zip(product(*limits), product((0, 1), repeat=len(limits)), strict=True)
        for axis, (side, width) in enumerate(zip(sides, parts, strict=True))
    ]
    found: dict[str, Uncertainties] = {}
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
        found[name] = _where(low < high, {"low": low, "high": high}, is_odd)
    return found


def _where(is_felt: Any, sides: Mapping[str, Any], is_open: Any) -> Uncertainties:
    """Return the uncertainty of a quantity, whose sides are nan where no source has an influence, and where it is open."""
    import numpy

    known = is_felt & ~is_open
    return Uncertainties({side: numpy.where(known, values, numpy.nan) for side, values in sides.items()}, is_open)


def _outcome(
    evaluate: Evaluate, names: Collection[str], sources: Sequence[Source], place: Sequence[Any]
) -> dict[str, Any]:
    """Return quantities where each source has a value, nan for those that have none."""
    import numpy

    changed: dict[str, Any] = {}
    for source, value in zip(sources, place, strict=True):
        changed |= source.at(value)
    return {**dict.fromkeys(names, numpy.nan), **evaluate(changed)}
