"""The uncertainty of results, from those of the inputs: standard uncertainties in quadrature, ranges by their extremes.

Every source is moved over the whole of its uncertainty, and the quantities are computed anew there. No derivatives are
taken, so that a result may respond differently to either side. Over ranges a result has its least and its largest
value among the places along the edges of their box: within 1 % of the distance of these where it turns inside.
"""

from collections.abc import Callable, Collection, Iterable, Iterator, Mapping, Sequence
from itertools import product
from math import erfc, fsum, isfinite, isnan, nan, sqrt
from typing import Any, NamedTuple

from ..errors import JkrollError
from ..physics.elementary import at_least, at_most, hypot, where
from ..quantities.nomenclature import NOMENCLATURE, XI
from ..quantities.values import Interval, Measured, Uncertain, is_uncertain
from .inverse import Problem
from .scene import Scene
from .wiring import in_order

MAX_RANGES = 8  # whose corners are computed, all together
ASYMMETRIC = 0.1  # relative difference of the two sides from which on they are given one by one
STEPS = 64  # along each edge of the box of ranges
STEPS_OF_SHARES = 12  # along each range in the middle of the others
ROUNDING = 4e-15  # of a value: a change as small as this comes from rounding, and not from a source
FEW = 800  # places that floats compute in the time of importing numpy: those of up to three ranges


class MixedKinds(JkrollError):
    """Error raised for a range and a standard uncertainty in one scene."""

    phrase = "± and range together"


class TooManyRanges(JkrollError):
    """Error raised for more ranges than can be combined."""

    phrase = "too many ranges"


class Inseparable(JkrollError):
    """Error raised for a range of a radius with which the displacement of a material moves, of which it has a range at each."""


# --- Sources ----------------------------------------------------------------------------------------------------------


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
        mixed = f"{symbols[Measured]} has a standard uncertainty (±) and {symbols[Interval]} a range"
        raise MixedKinds(f"{mixed}; give both as ± or both as ranges")
    kind = Measured if Measured in kinds else Interval
    left_out = [source for source in of_materials if not isinstance(source.given, kind)]
    sources = Sources([source for source in (*stated, *of_materials) if isinstance(source.given, kind)], left_out)
    if kind is Interval:
        if len(sources.entering) > MAX_RANGES:
            count = len(sources.entering)
            raise TooManyRanges(f"{count} ranges are more than {MAX_RANGES}; give some of these inputs one value")
        moves_radius = not sources.given.keys().isdisjoint(("radius", "radius2"))
        if XI in sources.given and XI not in scene.stated and moves_radius:
            remedy = "give --xi, or single radii"
            raise Inseparable(f"ξ of the material is scaled with the radius, which has a range here; {remedy}")
    return sources


def _stated(scene: Scene) -> Iterator[Source]:
    for name in in_order(scene.uncertain):  # the order is the same for an option, a column and a list
        takes_over = name == "radius" and "radius2" not in scene.given
        yield Source(("radius", "radius2") if takes_over else (name,), scene.uncertain[name])


def _of_materials(scene: Scene) -> Iterable[Source]:
    sources: dict[tuple[tuple[str, str], str], Source] = {}
    for name, (material, of_material) in scene.data.items():
        if (given := scene.uncertainty_of(name)) is not None:
            key = (material.key, of_material)
            names = (*sources[key].names, name) if key in sources else (name,)
            sources[key] = Source(names, given)
    return sources.values()


def sources_of_results(scene: Scene, names: Sequence[str]) -> Sources:
    """Return the sources that enter quantities of a scene, as far as it allows them."""
    return sources_of(scene, scene.inputs_of(*scene.possible(names)))


# --- Error bars -------------------------------------------------------------------------------------------------------

Place = Sequence[Any]  # a value of each source
Outcomes = Iterable[Mapping[str, Any]]  # quantities at places: numbers, arrays, or errors that say why there are none
Evaluate = Callable[[Sequence[Place]], Outcomes]


class Propagated(NamedTuple):
    """The uncertainty of a result, and the part that each source has in it."""

    uncertainty: Uncertain
    shares: Mapping[str, float]  # by the first input of a source; of the variance, or of the width of a range


class Elements(NamedTuple):
    """The uncertainty of a quantity of a scene of arrays, element by element."""

    sides: Mapping[str, Any]  # minus and plus, or low and high; nan where there is none
    is_open: Any  # where a place of the sources has no value; floats say why


class _Bar(NamedTuple):
    """An error bar of a number, or of each element of an array."""

    sides: Mapping[str, Any]
    has_influence: Any  # of a source
    changes: Sequence[Any] = ()  # by a source


Bars = dict[str, Propagated | JkrollError]  # by the quantity; an error is the reason why there is none


def uncertainties(
    scene: Scene, names: Sequence[str], alternative: Callable[[Scene], Scene] | None = None
) -> tuple[Bars, Sources]:
    """Return the uncertainties of quantities of a scene, or of one that is made of it, and their sources.

    A quantity without a finite value, or one on which no source has an influence, is left out. An error is the reason
    why a quantity has no value at one place of the sources.
    """
    middle = scene if alternative is None else alternative(scene)
    values = {name: value for name, value in middle.numbers(*names).items() if isfinite(value)}
    sources = sources_of_results(middle, names)
    return propagated(_evaluation(scene, [*values], sources.entering, alternative), values, sources.entering), sources


def part_beyond_pull_off(scene: Scene, sources: Sequence[Source]) -> float:
    """Return the part of all values that standard uncertainties stand for, normally distributed, at which a load is beyond pull-off.

    The distance P + P_c is taken as normally distributed, too. Ranges have none: their ends hold.
    """
    force = scene.numbers("pull_off_force")
    if not (force and sources and isinstance(sources[0].given, Measured)):
        return 0.0
    bar = propagated(_evaluation(scene, ["pull_off_force"], sources), force, sources).get("pull_off_force")
    of_force = bar.uncertainty.sides["minus"] if isinstance(bar, Propagated) else 0.0
    of_load = sum(source.given.sides["minus"] for source in sources if "load" in source.names)
    spread = hypot(of_force, of_load)
    distance = scene["load"] + force["pull_off_force"]
    return erfc(distance / (sqrt(2) * spread)) / 2 if spread else 0.0


def uncertainties_of_elements(
    scene: Scene, values: Mapping[str, Any], sources: Sequence[Source]
) -> dict[str, Elements]:
    """Return the uncertainties of quantities of a scene of arrays."""
    return elements(_evaluation(scene, [*values], sources), values, sources)


def moved(sources: Sequence[Source], place: Place) -> dict[str, Any]:
    """Return the inputs of sources at a place."""
    return {name: value for source, value in zip(sources, place, strict=True) for name in source.names}


def _evaluation(
    scene: Scene,
    names: Sequence[str],
    sources: Sequence[Source],
    alternative: Callable[[Scene], Scene] | None = None,
) -> Evaluate:
    """Return what computes quantities of a scene at places, one after the other, or many places of numbers as arrays."""
    middles = {name: given.value for name, given in scene.uncertain.items()}

    def at(place: Place) -> Mapping[str, Any]:
        changed = scene.replace(**{**middles, **moved(sources, place)})
        return (changed if alternative is None else alternative(changed)).evaluate(names)

    def evaluate(places: Sequence[Place]) -> Outcomes:
        if len(places) <= FEW or scene.shape:
            return map(at, places)
        return _as_arrays(at, places)

    return evaluate


def as_columns(places: Sequence[Place]) -> list[Any]:
    """Return the values of each source at all places, as an array."""
    import numpy

    return [*numpy.transpose(places)]


def _as_arrays(at: Callable[[Place], Mapping[str, Any]], places: Sequence[Place]) -> Outcomes:
    """Iterate over quantities at many places. A place without a value has the reason that it has by itself."""
    import numpy

    columns = {
        name: [outcome] * len(places)
        if isinstance(outcome, JkrollError)
        else numpy.broadcast_to(outcome, len(places)).tolist()
        for name, outcome in at(as_columns(places)).items()
    }
    for place, row in zip(places, zip(*columns.values(), strict=True), strict=True):
        outcomes = dict(zip(columns, row, strict=True))
        has_gap = any(isinstance(outcome, float) and isnan(outcome) for outcome in row)
        yield at(place) if has_gap else outcomes


def propagated(evaluate: Evaluate, values: Mapping[str, float], sources: Sequence[Source]) -> Bars:
    """Return the uncertainties of numbers, from sources of one kind."""
    if not (sources and values):
        return {}
    bars: Bars = {}
    is_range = isinstance(sources[0].given, Interval)
    found = (_over_ranges if is_range else _in_quadrature)(evaluate, values, sources)
    widths = _widths(evaluate, values, sources) if is_range else {}
    for name, bar in found.items():
        if isinstance(bar, JkrollError):
            bars[name] = bar
        elif bar.has_influence:
            shares = _shares(sources, widths[name] if is_range else _squares(bar.changes))
            bars[name] = Propagated(type(sources[0].given)(values[name], **bar.sides), shares)
    return bars


def elements(evaluate: Evaluate, values: Mapping[str, Any], sources: Sequence[Source]) -> dict[str, Elements]:
    """Return the uncertainties of arrays, as `propagated` does for numbers."""
    if not (sources and values):
        return {}
    import numpy

    bars: dict[str, Elements] = {}
    is_range = isinstance(sources[0].given, Interval)
    for name, bar in (_over_ranges if is_range else _in_quadrature)(evaluate, values, sources).items():
        if isinstance(bar, JkrollError):
            bars[name] = Elements({}, is_open=True)
            continue
        is_open = numpy.isnan(sum(bar.sides.values()))
        is_known = bar.has_influence & ~is_open
        bars[name] = Elements({side: where(is_known, numbers, nan) for side, numbers in bar.sides.items()}, is_open)
    return bars


def _in_quadrature(
    evaluate: Evaluate, values: Mapping[str, Any], sources: Sequence[Source]
) -> dict[str, _Bar | JkrollError]:
    """Return standard uncertainties: the changes at both ends of each source, each side added in quadrature."""
    middle = [source.given.value for source in sources]
    places = [[*middle[:axis], end, *middle[axis + 1 :]] for axis, source in enumerate(sources) for end in source.ends]
    outcomes = [*evaluate(places)]
    return {name: _quadrature(value, [outcome[name] for outcome in outcomes]) for name, value in values.items()}


def _quadrature(value: Any, outcomes: Sequence[Any]) -> _Bar | JkrollError:
    """Return the error bar of a value, from the outcomes at the lower and the upper end of each source in turn."""
    for outcome in outcomes:
        if isinstance(outcome, JkrollError):
            return outcome
    changes = [(low - value, high - value) for low, high in zip(outcomes[::2], outcomes[1::2], strict=True)]
    minus = hypot(*(at_most(at_most(low, high), 0.0) for low, high in changes))
    plus = hypot(*(at_least(at_least(low, high), 0.0) for low, high in changes))
    alike = abs(plus - minus) <= ASYMMETRIC * at_least(plus, minus)
    middle = (minus + plus) / 2
    minus, plus = where(alike, middle, minus), where(alike, middle, plus)
    return _Bar({"minus": minus, "plus": plus}, at_least(plus, minus) > ROUNDING * abs(value), changes)


def _over_ranges(
    evaluate: Evaluate, values: Mapping[str, Any], sources: Sequence[Source]
) -> dict[str, _Bar | JkrollError]:
    """Return the least and the largest values on the edges of the box of all ranges.

    The largest value of a quantity that has no turning point is that of a corner. One that is that of the weaker body,
    and falls off where the other becomes the weaker, has it at a corner or where such a ridge meets an edge.
    """
    low, high, errors = dict(values), dict(values), dict[str, JkrollError]()
    for outcomes in evaluate([*_edges([source.ends for source in sources])]):
        for name, outcome in outcomes.items():
            if isinstance(outcome, JkrollError):
                errors.setdefault(name, outcome)
            else:
                low[name], high[name] = at_most(low[name], outcome), at_least(high[name], outcome)
    return {
        name: errors.get(name)
        or _Bar({"low": low[name], "high": high[name]}, high[name] - low[name] > ROUNDING * abs(value))
        for name, value in values.items()
    }


def _edges(ends: Sequence[tuple[Any, Any]]) -> Iterator[Place]:
    """Iterate over places along the edges of the box of ranges."""
    for axis, (low, high) in enumerate(ends):
        for corner in product(*(pair if other != axis else (low,) for other, pair in enumerate(ends))):
            for value in _steps(low, high, STEPS):
                yield [*corner[:axis], value, *corner[axis + 1 :]]


def _steps(low: Any, high: Any, count: int) -> list[Any]:
    """Return values from one end of a range to the other: by ratio, or by difference where the range has 0 in it."""
    parts = [number / count for number in range(1, count)]
    is_by_ratio = low * high > 0
    ratio = where(is_by_ratio, high, 1.0) / where(is_by_ratio, low, 1.0)
    return [low, *(where(is_by_ratio, low * ratio**part, low + part * (high - low)) for part in parts), high]


def _widths(
    evaluate: Evaluate, values: Mapping[str, float], sources: Sequence[Source]
) -> Mapping[str, Sequence[float]]:
    """Return by quantity how far it moves along each range, in the middle of the others."""
    middle = [source.given.value for source in sources]
    widths: dict[str, list[float]] = {name: [] for name in values}
    for axis, source in enumerate(sources):
        line = [[*middle[:axis], value, *middle[axis + 1 :]] for value in _steps(*source.ends, STEPS_OF_SHARES)]
        outcomes = [*evaluate(line)]
        for name, own in widths.items():
            numbers = [outcome[name] for outcome in outcomes if not isinstance(outcome[name], JkrollError)]
            own.append(max(numbers) - min(numbers) if numbers else 0.0)
    return widths


def _squares(changes: Iterable[tuple[float, float]]) -> list[float]:
    """Return the squares of the changes of a number by each source, over the largest of them: they may leave the doubles."""
    sizes = [hypot(low, high) for low, high in changes]
    return [(size / max(sizes)) ** 2 if size else 0.0 for size in sizes]


def _shares(sources: Sequence[Source], parts: Sequence[float]) -> dict[str, float]:
    """Return the share of each source, the largest first; a source without influence has none."""
    whole = fsum(parts)
    shares = {source.names[0]: part / whole for source, part in zip(sources, parts, strict=True) if part}
    return dict(sorted(shares.items(), key=lambda share: -share[1]))


# --- Unknowns ---------------------------------------------------------------------------------------------------------


def sources_of_problem(problem: Problem) -> Sources:
    """Return the sources of the uncertainty of unknowns: the measured values, and the inputs of the scene."""
    of_measured = [Source((quantity,), given) for quantity, given in problem.measured.items() if is_uncertain(given)]
    return sources_of(problem.scene, problem.used(), of_measured)


def uncertainties_of_unknowns(values: Mapping[str, float], problem: Problem) -> tuple[Bars, Sources]:
    """Return the uncertainties of the unknowns that solve a problem, and their sources."""
    from .unknowns import solutions

    sources = sources_of_problem(problem)

    def evaluate(places: Sequence[Place]) -> Outcomes:
        changed = moved(sources.entering, as_columns(places))
        found = solutions(problem.replace(changed), len(places), near=values)
        for row in range(len(places)):
            error = found.failures.get(row)
            yield {name: error or float(column[row]) for name, column in found.values.items()}

    return propagated(evaluate, values, sources.entering), sources


def uncertainties_of_elements_of_unknowns(
    values: Mapping[str, Any], size: int, problem: Problem
) -> dict[str, Elements]:
    """Return the uncertainties of the unknowns that solve a problem of arrays."""
    from .unknowns import solutions

    sources = sources_of_problem(problem).entering

    def evaluate(places: Sequence[Place]) -> Outcomes:
        changed = (problem.replace(moved(sources, place)) for place in places)
        return (solutions(other, size, near=values).values for other in changed)

    return elements(evaluate, values, sources)
