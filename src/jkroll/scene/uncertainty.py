"""The uncertainty of results, from those of the inputs: standard uncertainties in quadrature, ranges by their extremes.

Every source is moved over the whole of its uncertainty, and the quantities are computed anew there. No derivatives are
taken, so that a result may respond differently to either side. Over ranges a result has its least and its largest
value among the places along the edges of their box: within 1 % of the distance of these where it turns smoothly.
"""

from collections.abc import Callable, Collection, Iterator, Mapping, Sequence
from functools import reduce
from itertools import chain, product
from math import fsum, isfinite
from typing import Any, NamedTuple

from ..errors import BadRequest, JkrollError
from ..physics.elementary import absolute, at_least, at_most, hypot, where
from ..quantities.nomenclature import NOMENCLATURE, XI
from ..quantities.values import Interval, Measured, Uncertain
from .failures import Failure, Kind, reason_of
from .scene import Scene
from .wiring import in_order

MAX_RANGES = 8  # whose corners are computed, all together
ASYMMETRIC = 0.1  # relative difference of the two sides from which on they are given one by one
STEPS = 64  # along each edge of the box of ranges
ROUNDING = 4e-15  # of a value: a change as small as this comes from rounding, and not from a source
FEW = 800  # places that floats compute in the time of importing numpy: those of up to three ranges


# --- Sources ----------------------------------------------------------------------------------------------------------


class Source(NamedTuple):
    """A value with an uncertainty, and the inputs that have this value and move with it."""

    names: tuple[str, ...]
    given: Uncertain


class Sources(NamedTuple):
    """The sources of uncertainty that enter a result, and those of materials that are left out: of the other kind."""

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
    Raises BadRequest for what cannot be combined.
    """
    of_solids = {name: (solid.key, of_solid) for name, (solid, of_solid) in scene.data.items()}
    names_of: dict[Any, list[str]] = {}  # of each value
    for name in in_order(scene.uncertainties):
        names_of.setdefault(of_solids.get(name, name), []).append(name)
    if "radius" in names_of and "radius2" not in scene.given:
        names_of["radius"].append("radius2")
    given = [*measured, *(Source(tuple(names), scene.uncertainties[names[0]]) for names in names_of.values())]
    given = [source for source in given if not set(used).isdisjoint(source.names)]
    stated = [source for source in given if source.names[0] not in of_solids]
    of_materials = [source for source in given if source.names[0] in of_solids]
    symbols = {type(source.given): NOMENCLATURE[source.names[0]].symbol for source in stated}
    if len(symbols) > 1:
        mixed = f"{symbols[Measured]} has a standard uncertainty (±) and {symbols[Interval]} a range"
        raise BadRequest(f"{mixed}; give both as ± or both as ranges", "± and range together")
    kind = Measured if any(isinstance(source.given, Measured) for source in stated or of_materials) else Interval
    entering = [source for source in (*stated, *of_materials) if isinstance(source.given, kind)]
    if kind is Interval and len(entering) > MAX_RANGES:
        problem = f"{len(entering)} ranges are more than {MAX_RANGES}; give some of these inputs one value"
        raise BadRequest(problem, "too many ranges")
    names = {name for source in entering for name in source.names}
    if kind is Interval and XI in names - scene.stated.keys() and not names.isdisjoint(("radius", "radius2")):
        remedy = "give --xi, or single radii"
        raise BadRequest(f"ξ of the material is scaled with the radius, which has a range here; {remedy}")
    return Sources(entering, [source for source in of_materials if not isinstance(source.given, kind)])


def sources_of_results(scene: Any, names: Sequence[str]) -> Sources:
    """Return the sources that enter quantities of a scene, as far as it allows them, or the unknowns of a problem."""
    if not isinstance(scene, Scene):
        sources: Sources = scene.sources()
        return sources
    return sources_of(scene, scene.inputs_of(*scene.possible(names)))


# --- Error bars -------------------------------------------------------------------------------------------------------


class Propagated(NamedTuple):
    """The uncertainty of a result, and the part that each source has in it.

    Of arrays it has arrays: nan where a place of the sources has no value, no width where no source has an influence.
    """

    uncertainty: Uncertain
    shares: Mapping[str, float]  # of numbers, by the first input of a source: in the variance, or width of a range


Bars = dict[str, Propagated | JkrollError]  # by the quantity; an error is the reason why there is none


def uncertainties(
    scene: Any,
    names: Sequence[str],
    made_of: Callable[[Any], Any] = lambda scene: scene,
    sources: Sources | None = None,
) -> Bars:
    """Return the uncertainties of quantities of a scene, or of one that is made of it.

    The scene may be a problem, whose quantities are the unknowns. A quantity without a finite value, or one on which
    no source has an influence, is left out. An error is the reason why a quantity has no value at one place of the
    sources. `sources`: by default all that enter the quantities.
    """
    middle, bars = made_of(scene), Bars()
    numbers = middle.numbers(*names)
    values = {name: value for name, value in numbers.items() if not isinstance(value, float) or isfinite(value)}
    entering = (sources or sources_of_results(middle, names)).entering
    if not (entering and values):
        return bars

    def outcomes(place: Mapping[str, Any]) -> Any:
        """Return the quantities at a place, which are values of some inputs; the others have their middles."""
        return made_of(scene.replace(**place)).evaluate([*values])

    kind, edges = type(entering[0].given), [*_edges(entering)]
    places = [*chain.from_iterable(edges)]
    if scene.shape or (len(places) <= FEW and isinstance(scene, Scene)):  # to solve a problem takes arrays
        rows = [*map(outcomes, places)]
        columns = {name: [row[name] for row in rows] for name in values}
    else:
        columns = _as_arrays(outcomes, places)
    for name, value in values.items():
        if errors := [outcome for outcome in columns[name] if isinstance(outcome, JkrollError)]:
            reason = f"no uncertainty, as there is no value at an end of an input: {reason_of(name, errors[0])}"
            bars[name] = Failure(Kind("no error bar", reason), name)
            continue
        on_edges = _divided(columns[name], len(edges[0]))
        extents = [(reduce(at_most, on_edge), reduce(at_least, on_edge)) for on_edge in on_edges]
        of_sources = _divided(extents, len(edges) // len(entering))
        sides, parts = (_range if kind is Interval else _quadrature)(value, of_sources)
        is_still = reduce(at_least, parts) <= ROUNDING * abs(value)
        if is_still is not True:
            still = value if kind is Interval else 0.0
            sides = {side: where(is_still, still, end) for side, end in sides.items()}
            shares = {} if is_still is not False else _shares(entering, parts)
            bars[name] = Propagated(kind.of(value, **sides), shares)
    return bars


def measures_of(bars: Mapping[str, Propagated | JkrollError]) -> dict[str, Uncertain | JkrollError]:
    """Return the values that have error bars, with these, or the errors that say why there is none."""
    return {name: bar.uncertainty if isinstance(bar, Propagated) else bar for name, bar in bars.items()}


def _as_arrays(outcomes: Callable[[Any], Any], places: Sequence[Any]) -> dict[str, list[Any]]:
    """Return quantities at places that are computed together; the first one without a value has the reason."""
    import numpy

    columns: dict[str, list[Any]] = {}
    for name, outcome in outcomes({name: numpy.array([place[name] for place in places]) for name in places[0]}).items():
        columns[name] = numpy.broadcast_to(outcome, len(places)).tolist()
        for number in numpy.flatnonzero(numpy.isnan(outcome)).tolist():
            columns[name][number] = outcomes(places[number])[name]
            if isinstance(columns[name][number], JkrollError):
                break
    return columns


def _edges(sources: Sequence[Source]) -> Iterator[list[dict[str, Any]]]:
    """Iterate over the edges along which each source in turn is moved: equally many for each, as lists of places.

    A standard uncertainty is moved to both of its ends, with the others at their middles; a range by steps, with the
    others at each corner of their box. The largest value of a quantity that has no turning point is that of a corner.
    One that is that of the weaker body, and falls off where the other becomes the weaker, has it at a corner or where
    such a ridge meets an edge.
    """
    for source in sources:
        given, others = source.given, [other for other in sources if other is not source]
        is_range = isinstance(given, Interval)
        moved = _steps(given.low, given.high) if is_range else [given.low, given.high]
        fixed = [(other.given.low, other.given.high) if is_range else (other.given.value,) for other in others]
        for corner in product(*fixed):
            place = {name: end for other, end in zip(others, corner, strict=True) for name in other.names}
            yield [{**place, **dict.fromkeys(source.names, end)} for end in moved]


def _steps(low: Any, high: Any) -> list[Any]:
    """Return values from one end of a range to the other: by ratio, or by difference where it has 0 in it."""
    is_by_ratio = low * high > 0
    ratio = where(is_by_ratio, high, 1.0) / where(is_by_ratio, low, 1.0)
    shares = [step / STEPS for step in range(1, STEPS)]
    between = [where(is_by_ratio, low * ratio**share, low + share * (high - low)) for share in shares]
    return [low, *between, high]


def _divided(values: list[Any], size: int) -> list[list[Any]]:
    """Return values in groups of a size."""
    return [values[start : start + size] for start in range(0, len(values), size)]


def _quadrature(value: Any, of_sources: Sequence[Sequence[Any]]) -> tuple[Mapping[str, Any], Sequence[Any]]:
    """Return a standard uncertainty, whose changes to either side add in quadrature, and their sizes by source."""
    changes = [(at_least(value - low, 0.0), at_least(high - value, 0.0)) for ((low, high),) in of_sources]
    minus, plus = (hypot(*sizes) for sizes in zip(*changes, strict=True))
    alike = absolute(plus - minus) <= ASYMMETRIC * at_least(plus, minus)
    middle = (minus + plus) / 2
    sides = {"minus": where(alike, middle, minus), "plus": where(alike, middle, plus)}
    return sides, [hypot(*change) for change in changes]


def _range(value: Any, of_sources: Sequence[Sequence[Any]]) -> tuple[Mapping[str, Any], Sequence[Any]]:
    """Return the least and the largest value on all edges, and the mean widths along those of each source."""
    lows, highs = zip(*(extent for extents in of_sources for extent in extents), strict=True)
    parts = [sum(high - low for low, high in extents) / len(extents) for extents in of_sources]
    return {"low": reduce(at_most, lows, value), "high": reduce(at_least, highs, value)}, parts


def _shares(sources: Sequence[Source], parts: Sequence[float]) -> dict[str, float]:
    """Return the share of each source that has one in the variance or the width of a number, the largest first."""
    power = 1 if isinstance(sources[0].given, Interval) else 2
    sizes = [(part / max(parts)) ** power for part in parts]  # squares of the parts may leave the doubles
    shares = {source.names[0]: size / fsum(sizes) for source, size in zip(sources, sizes, strict=True) if size}
    return dict(sorted(shares.items(), key=lambda share: -share[1]))
