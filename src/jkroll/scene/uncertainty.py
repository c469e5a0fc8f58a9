"""The uncertainty of results, from those of the inputs: standard uncertainties in quadrature, ranges by their extremes.

Every source is moved over the whole of its uncertainty, and the quantities are computed anew there. No derivatives are
taken, so that a result may respond differently to either side, or have a turning point inside a range.

Floats define an error bar. Arrays give the same where the values at the ends of the sources decide; elsewhere an
element is open, and is to be computed by itself.
"""

from collections.abc import Callable, Collection, Iterable, Iterator, Mapping, Sequence
from functools import cache, reduce
from itertools import pairwise, product
from math import fsum, inf, isfinite, nan
from typing import Any, NamedTuple

from ..errors import JkrollError, NoResult
from ..physics.elementary import at_least, at_most, hypot, where
from ..quantities.nomenclature import NOMENCLATURE, XI
from ..quantities.values import Interval, Measured, Uncertain, is_uncertain
from .inverse import Observed, found_by, highest_between, solutions
from .scene import Scene
from .unknowns import solved_near
from .wiring import in_order

MAX_RANGES = 8  # whose corners are computed, all together
ASYMMETRIC = 0.1  # relative difference of the two sides from which on they are given one by one
SAMPLES = 12  # parts of a range in which turning points are looked for
NEAR = 1e-4  # of such a part, the distance from an end at which the quantity shows whether it grows inwards
ROUNDING = 4e-15  # of a value: a change as small as this comes from rounding, and not from a source
_ROUNDS = 10  # of a search along one range after the other

# From changed inputs and the names of quantities to the outcome of each.
Evaluate = Callable[[Mapping[str, Any], tuple[str, ...]], Mapping[str, Any]]


class MixedKinds(JkrollError):
    """Error raised for a range and a standard uncertainty in one scene."""

    def __init__(self, measured: str, interval: str) -> None:
        super().__init__(measured, interval)
        self.measured, self.interval = measured, interval

    def __str__(self) -> str:
        return f"{self.measured} has a standard uncertainty (±) and {self.interval} a range; give both as ± or both as ranges"


class TooManyRanges(JkrollError):
    """Error raised for more ranges than can be combined."""

    def __init__(self, count: int) -> None:
        super().__init__(count)
        self.count = count

    def __str__(self) -> str:
        return f"{self.count} ranges are more than {MAX_RANGES}; give some of these inputs one value"


class Inseparable(JkrollError):
    """Error raised for a range of a radius with which the displacement of a material moves, of which it has a range at each."""

    def __str__(self) -> str:
        return "ξ of the material is scaled with the radius, which has a range here; give --xi, or single radii"


class Source(NamedTuple):
    """A value with an uncertainty, and the inputs that have this value and move with it."""

    names: tuple[str, ...]
    given: Uncertain

    @property
    def ends(self) -> tuple[float, float]:
        """The ends of the uncertainty."""
        return self.given.low, self.given.high


class Sources(NamedTuple):
    """The sources of uncertainty that enter a result, and those of materials that do not, as they are of the other kind."""

    entering: Sequence[Source]
    left_out: Sequence[Source] = ()

    @property
    def given(self) -> dict[str, Uncertain]:
        """The values of those that enter, by all of their names."""
        return {name: source.given for source in self.entering for name in source.names}

    @property
    def sides(self) -> set[str]:
        """The sides of those that enter: minus and plus, or low and high."""
        return {side for source in self.entering for side in source.given.sides}


class Propagated(NamedTuple):
    """The uncertainty of a result, and the part that each source has in it."""

    uncertainty: Uncertain
    shares: Mapping[str, float]  # by the first input of a source; of the variance, or of the width of a range


class Elements(NamedTuple):
    """The uncertainty of a quantity of a scene of arrays, element by element."""

    sides: Mapping[str, Any]  # minus and plus, or low and high; nan where there is none
    is_open: Any  # where an end of a source has no value, or the extremes of a range need a search


Found = dict[str, Propagated | JkrollError]  # by the quantity; an error is the reason why there is none


def sources_of(scene: Scene, used: Collection[str], measured: Sequence[Source] = ()) -> Sources:
    """Return the sources that enter quantities, given the inputs that these depend on, and measured values if any.

    A value that sphere 2 takes over from sphere 1 moves with it; so do both values of a material that is named twice.
    All must be of one kind. It is that of the values that were stated; where none was, ± if some material has one.
    Raises MixedKinds, TooManyRanges or Inseparable.
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
    found = Sources(entering, left_out)
    if kind is Interval:
        if len(entering) > MAX_RANGES:
            raise TooManyRanges(len(entering))
        if XI in found.given and XI not in scene.stated and not found.given.keys().isdisjoint(("radius", "radius2")):
            raise Inseparable
    return found


def _stated(scene: Scene) -> Iterator[Source]:
    for name in in_order(scene.uncertain):  # the order is the same for an option, a column and a list
        takes_over = name == "radius" and "radius2" not in scene.given
        yield Source(("radius", "radius2") if takes_over else (name,), scene.uncertain[name])


def _of_materials(scene: Scene) -> Iterable[Source]:
    found: dict[tuple[tuple[str, str], str], Source] = {}
    for name, (material, of_material) in scene.data.items():
        if (given := scene.uncertainty_of(name)) is not None:
            key = (material.key, of_material)
            names = (*found[key].names, name) if key in found else (name,)
            found[key] = Source(names, given)
    return found.values()


def sources_of_results(scene: Scene, names: Sequence[str]) -> Sources:
    """Return the sources that enter quantities of a scene, as far as it allows them."""
    return sources_of(scene, scene.inputs_of(*scene.possible(names)))


def uncertainties(scene: Scene, names: Sequence[str]) -> tuple[Found, Sources]:
    """Return the uncertainties of quantities of a scene, and their sources.

    A quantity without a finite value, or one on which no source has an influence, is left out. An error is the reason
    why a quantity has no value at one end of a source.
    """
    values = {name: value for name, value in scene.numbers(*names).items() if isfinite(value)}
    sources = sources_of_results(scene, names)
    return _propagated(_evaluation(scene), values, sources.entering), sources


def uncertainties_of_elements(
    scene: Scene, values: Mapping[str, Any], sources: Sequence[Source]
) -> dict[str, Elements]:
    """Return the uncertainties of quantities of a scene of arrays."""
    return _elements(_evaluation(scene), values, sources)


def _evaluation(scene: Scene) -> Evaluate:
    """Return the function from changed inputs to quantities of a scene; the other inputs have the middle of their uncertainty."""
    middles = {name: given.value for name, given in scene.uncertain.items()}
    return lambda changed, names: scene.replace(**{**middles, **changed}).evaluate(names)


def inferred_sources(names: Sequence[str], observed: Observed) -> Sources:
    """Return the sources of the uncertainty of inferred inputs: the measured values, and the inputs of the scene."""
    of_measured = [Source((quantity,), one) for quantity, one in observed.measured.items() if is_uncertain(one)]
    return sources_of(observed.scene, observed.used(names), of_measured)


def inferred_uncertainties(values: Mapping[str, float], observed: Observed) -> tuple[Found, Sources]:
    """Return the uncertainties of inferred inputs, and their sources."""
    sources = inferred_sources([*values], observed)

    def evaluate(changed: Mapping[str, float], _: tuple[str, ...]) -> Mapping[str, Any]:
        try:
            return solved_near(values, observed.changed(changed))
        except NoResult as error:
            return dict.fromkeys(values, error)

    return _propagated(evaluate, values, sources.entering), sources


def inferred_uncertainty_of_elements(name: str, values: Any, observed: Observed) -> dict[str, Elements]:
    """Return the uncertainty of the values of an inferred input."""
    import numpy

    def evaluate(changed: Mapping[str, Any], _: tuple[str, ...]) -> Mapping[str, Any]:
        other = observed.changed(changed)
        ((quantity, at),) = other.measured.items()
        found = solutions(name, quantity, numpy.broadcast_to(at, values.shape), other.scene)
        return {name: numpy.array([one if isinstance(one, float) else nan for one in found])}

    return _elements(evaluate, {name: values}, inferred_sources([name], observed).entering)


# --- From the values at the ends of the sources, of numbers and of arrays ---------------------------------------------

Place = tuple[Any, ...]  # a value of each source
Outcomes = Callable[[Place], Mapping[str, Any]]  # of quantities by name


class _Bar(NamedTuple):
    """An error bar of a number, or of each element of an array."""

    sides: Mapping[str, Any]
    has_influence: Any  # of a source
    parts: Iterable[float] = ()  # of each source, from which its share follows
    is_open: Any = False  # whether there is a turning point inside the ranges


def _propagated(evaluate: Evaluate, values: Mapping[str, float], sources: Sequence[Source]) -> Found:
    """Return the uncertainties of numbers, from sources of one kind and a function that computes them from changed inputs."""
    if not sources:
        return {}
    found: Found = {}
    kind = type(sources[0].given)
    for name, bar in (_in_quadrature if kind is Measured else _over_ranges)(evaluate, values, sources):
        if isinstance(bar, JkrollError):
            found[name] = bar
        elif bar.has_influence:
            found[name] = Propagated(kind(values[name], **bar.sides), _shares(sources, [*bar.parts]))
    return found


def _elements(evaluate: Evaluate, values: Mapping[str, Any], sources: Sequence[Source]) -> dict[str, Elements]:
    """Return the uncertainties of arrays, as `_propagated` does for numbers."""
    if not sources:
        return {}
    import numpy

    found: dict[str, Elements] = {}
    combine = _in_quadrature if isinstance(sources[0].given, Measured) else _on_edges
    for name, bar in combine(evaluate, values, sources):
        if isinstance(bar, JkrollError):
            found[name] = Elements({}, is_open=True)
            continue
        is_open = bar.is_open | numpy.isnan(sum(bar.sides.values()))
        is_known = bar.has_influence & ~is_open
        found[name] = Elements({side: where(is_known, numbers, nan) for side, numbers in bar.sides.items()}, is_open)
    return found


def _shares(sources: Sequence[Source], parts: Sequence[float]) -> dict[str, float]:
    """Return the share of each source, the largest first; a source without influence has none."""
    whole = fsum(parts)
    shares = {source.names[0]: part / whole for source, part in zip(sources, parts, strict=True) if part}
    return dict(sorted(shares.items(), key=lambda share: -share[1]))


def _in_quadrature(
    evaluate: Evaluate, values: Mapping[str, Any], sources: Sequence[Source]
) -> Iterator[tuple[str, _Bar | JkrollError]]:
    """Iterate over standard uncertainties: the changes at both ends of each source, each side added in quadrature."""
    ends = [[evaluate(_at([source], (end,)), (*values,)) for end in source.ends] for source in sources]
    for name, value in values.items():
        outcomes = [[end[name] for end in pair] for pair in ends]
        if failures := [end for pair in outcomes for end in pair if isinstance(end, JkrollError)]:
            yield name, failures[0]
            continue
        changes = [(low - value, high - value) for low, high in outcomes]
        minus = hypot(*(at_most(at_most(low, high), 0.0) for low, high in changes))
        plus = hypot(*(at_least(at_least(low, high), 0.0) for low, high in changes))
        alike = abs(plus - minus) <= ASYMMETRIC * at_least(plus, minus)
        middle = (minus + plus) / 2
        minus, plus = where(alike, middle, minus), where(alike, middle, plus)
        has_influence = at_least(plus, minus) > ROUNDING * abs(value)
        yield name, _Bar({"minus": minus, "plus": plus}, has_influence, _squares(changes))


def _squares(changes: Iterable[tuple[float, float]]) -> Iterator[float]:
    """Iterate over the squares of the changes of a number by each source, over the largest of them: they may leave the doubles."""
    sizes = [hypot(low, high) for low, high in changes]
    largest = max(sizes)
    yield from ((size / largest) ** 2 if size else 0.0 for size in sizes)


def _range(value: Any, low: Any, high: Any) -> _Bar:
    """Return the error bar of a value, from the least and the largest value over all ranges together."""
    low, high = at_most(value, low), at_least(value, high)
    return _Bar({"low": low, "high": high}, high - low > ROUNDING * abs(value))


def _at(sources: Sequence[Source], place: Place) -> dict[str, Any]:
    """Return the inputs of sources at a place."""
    return {name: value for source, value in zip(sources, place, strict=True) for name in source.names}


def _moved(place: Place, axis: int, value: Any) -> Place:
    """Return a place with another value of one source."""
    return (*place[:axis], value, *place[axis + 1 :])


def _edges(limits: Sequence[tuple[Any, Any]]) -> Iterator[tuple[int, Place]]:
    """Iterate over the edges of the box of all ranges: the source that varies along each, and a place on it.

    The largest value of a quantity that has no turning point is that of a corner. One that is that of the weaker body,
    and falls off where the other becomes the weaker, has it at a corner or where such a ridge meets an edge.
    """
    for axis in range(len(limits)):
        others = [ends if place != axis else ends[:1] for place, ends in enumerate(limits)]
        yield from ((axis, place) for place in product(*others))


def _steps(low: Any, high: Any) -> list[Any]:
    """Return values from one end of a range to the other: by ratio, or by difference where the range has 0 in it."""
    parts = [number / SAMPLES for number in range(1, SAMPLES)]
    is_by_ratio = low * high > 0
    ratio = where(is_by_ratio, high, 1.0) / where(is_by_ratio, low, 1.0)
    return [low, *(where(is_by_ratio, low * ratio**part, low + part * (high - low)) for part in parts), high]


def _inwards(end: Any, beside: Any) -> Any:
    """Return the value near an end of a range at which a quantity shows whether it grows inwards. `beside`: the next step."""
    return end + NEAR * (beside - end)


# --- Ranges of arrays -------------------------------------------------------------------------------------------------


def _on_edges(evaluate: Evaluate, values: Mapping[str, Any], sources: Sequence[Source]) -> Iterator[tuple[str, _Bar]]:
    """Iterate over ranges, from the values at steps along the edges. They are open where a quantity both rises and falls on one."""
    limits = [source.ends for source in sources]
    found = {name: (value, value, False) for name, value in values.items()}
    for axis, place in _edges(limits):
        low, *inner, high = _steps(*limits[axis])
        along = (low, _inwards(low, inner[0]), *inner, _inwards(high, inner[-1]), high)
        outcomes = [evaluate(_at(sources, _moved(place, axis, value)), (*values,)) for value in along]
        for name, (least, largest, turns) in found.items():
            numbers = [nan if isinstance(one[name], JkrollError) else one[name] for one in outcomes]
            rises = falls = False
            for before, after in pairwise(numbers):
                rises, falls = rises | (after > before), falls | (after < before)
            found[name] = reduce(at_most, numbers, least), reduce(at_least, numbers, largest), turns | rises & falls
    for name, (least, largest, turns) in found.items():
        bar = _range(values[name], least, largest)
        yield name, bar._replace(is_open=bar.has_influence & turns)


# --- Ranges of numbers ------------------------------------------------------------------------------------------------


def _over_ranges(
    evaluate: Evaluate, values: Mapping[str, float], sources: Sequence[Source]
) -> Iterator[tuple[str, _Bar | JkrollError]]:
    """Iterate over ranges, from the edges of their box and turning points."""
    limits = [source.ends for source in sources]
    edges = [_line(place, axis, limits) for axis, place in _edges(limits)]
    together = cache(lambda place: evaluate(_at(sources, place), (*values,)))
    for name, value in values.items():
        alone = cache(_alone(name, evaluate, sources)) if len(values) > 1 else together
        low, high = (_Surface(name, limits, edges, together, alone, sign) for sign in (-1.0, 1.0))
        try:
            bar = _range(value, -low.highest(), high.highest())
            yield name, bar._replace(parts=_widths(name, sources, together)) if bar.has_influence else bar
        except JkrollError as error:
            yield name, error


def _alone(name: str, evaluate: Evaluate, sources: Sequence[Source]) -> Outcomes:
    return lambda place: evaluate(_at(sources, place), (name,))


def _widths(name: str, sources: Sequence[Source], together: Outcomes) -> list[float]:
    """Return how far a quantity moves along each range, in the middle of the others."""
    middle, limits = tuple(source.given.value for source in sources), [source.ends for source in sources]
    widths = []
    for axis in range(len(limits)):
        heights = [_number_of(name, together, place) for place in _line(middle, axis, limits).places]
        widths.append(max(heights) - min(heights))
    return widths


class _Line(NamedTuple):
    """Places from one end of a range to the other."""

    axis: int  # the source that varies
    places: list[Place]


def _line(place: Place, axis: int, limits: Sequence[tuple[float, float]]) -> _Line:
    """Return the line through a place along one range."""
    return _Line(axis, [_moved(place, axis, value) for value in _steps(*limits[axis])])


def _number_of(name: str, outcomes: Outcomes, place: Place) -> float:
    """Return the value of a quantity at a place. Raises the reason why it has none."""
    outcome = outcomes(place)[name]
    if isinstance(outcome, JkrollError):
        raise outcome
    return float(outcome)


class _Surface:
    """A quantity over all ranges, or with sign −1 its negative."""

    def __init__(
        self,
        name: str,
        limits: Sequence[tuple[float, float]],
        edges: Sequence[_Line],
        together: Outcomes,
        alone: Outcomes,
        sign: float,
    ) -> None:
        """`together`: the outcomes of all quantities at a place, for places that they share; `alone`: of this one."""
        self.limits, self.edges = limits, edges
        self.height: Callable[[Place], float] = lambda place: sign * _number_of(name, together, place)
        self.beside: Callable[[Place], float] = lambda place: sign * _number_of(name, alone, place)

    def highest(self) -> float:
        """Return the largest value: that on an edge, or of a turning point beside it. Raises the reason why it has none at a place."""
        best = max(map(self._peak, self.edges), key=_height)
        for _ in range(_ROUNDS):
            before = best
            for axis in range(len(self.limits)):
                best = max(best, self._peak(_line(best.place, axis, self.limits)), key=_height)
            if best == before:
                break
        return best.height

    def _peak(self, line: _Line) -> "_Peak":
        """Return the largest value on a line: at one of its places, or found by a golden-section search around one.

        Searched is around each that is higher than those beside it, as a hump between two of them may be the highest.
        """
        heights = [*map(self.height, line.places)]
        found = [_Peak(height, place) for height, place in zip(heights, line.places, strict=True)]
        for at, (before, here, after) in enumerate(zip([-inf, *heights], heights, [*heights[1:], -inf], strict=False)):
            if before < here >= after and (0 < at < SAMPLES or self._grows_inwards(line, at, here)):
                found.append(self._top(line, at))
        return max(found, key=_height)

    def _grows_inwards(self, line: _Line, end: int, height: float) -> bool:
        """Return whether the quantity grows from an end of a line, where it has some height."""
        axis, places = line
        beside = places[1 if end == 0 else SAMPLES - 1]
        inwards = _inwards(places[end][axis], beside[axis])
        return self.height(_moved(places[end], axis, inwards)) > height

    def _top(self, line: _Line, at: int) -> "_Peak":
        """Return the top of the hump around a place of a line."""
        axis, places = line
        left, right = (places[max(0, min(beside, SAMPLES))][axis] for beside in (at - 1, at + 1))
        value = found_by(highest_between(left, right), lambda value: self.beside(_moved(places[at], axis, value)))
        found = _moved(places[at], axis, value)
        return _Peak(self.beside(found), found)


class _Peak(NamedTuple):
    """The largest value on a line, and where it is."""

    height: float
    place: Place


def _height(peak: _Peak) -> float:
    return peak.height
