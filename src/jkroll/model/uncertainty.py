"""The uncertainty of results, from those of the inputs: standard uncertainties in quadrature, ranges by their extremes.

Every source is moved over the whole of its uncertainty, and the quantities are computed anew there. No derivatives are
taken, so that a result may respond differently to either side. Over ranges a result has its least and its largest
value among the places along the edges of their box: within 1 % of the distance of these where it turns smoothly.
"""

from collections.abc import Callable, Collection, Iterable, Mapping, Sequence
from functools import reduce
from itertools import chain, product
from math import fsum, nan
from types import MappingProxyType
from typing import Any, NamedTuple

from ..errors import BadRequest
from ..physics.elementary import absolute, at_least, at_most, hypot, is_anywhere, where
from ..quantities.nomenclature import INFINITY, NOMENCLATURE, XI
from ..quantities.values import Interval, Measured, Uncertain
from .column import Column, at_row
from .frame import Frame
from .plan import in_order
from .reasons import NoErrorBar, explanation_of

MAX_RANGES = 8  # whose corners are computed, all together
ASYMMETRIC = 0.1  # relative difference of the two sides from which on they are given one by one
STEPS = 64  # along each edge of the box of ranges
ROUNDING = 4e-15  # of a value: a change as small as this comes from rounding, and not from a source


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


def sources_of(frame: Frame, used: Collection[str]) -> Sources:
    """Return the sources that enter quantities, given the inputs that these depend on.

    A value that sphere 2 takes over from sphere 1 moves with it; so do both values of a material that is named twice.
    All must be of one kind. It is that of the values that were stated; where none was, ± if some material has one.
    Raises BadRequest for what cannot be combined.
    """
    of_solids = {name: (solid.key, of_solid) for name, (solid, of_solid) in frame.data.items()}
    names_of: dict[Any, list[str]] = {}  # of each value
    for name in in_order(frame.uncertainties):
        names_of.setdefault(of_solids.get(name, name), []).append(name)
    if "radius" in names_of and "radius2" not in frame.given:
        names_of["radius"].append("radius2")
    given = [Source(tuple(names), frame.uncertainties[names[0]]) for names in names_of.values()]
    given = [source for source in given if not set(used).isdisjoint(source.names)]
    stated = [source for source in given if source.names[0] not in of_solids]
    of_materials = [source for source in given if source.names[0] in of_solids]
    symbols = {type(source.given): NOMENCLATURE[source.names[0]].symbol for source in stated}
    if len(symbols) > 1:
        mixed = f"{symbols[Measured]} has a standard uncertainty (±) and {symbols[Interval]} a range"
        raise BadRequest(f"{mixed}; give both as ± or both as ranges", "± and range together")
    of_type = Measured if any(isinstance(source.given, Measured) for source in stated or of_materials) else Interval
    entering = [source for source in (*stated, *of_materials) if isinstance(source.given, of_type)]
    if of_type is Interval and len(entering) > MAX_RANGES:
        problem = f"{len(entering)} ranges are more than {MAX_RANGES}; give some of these inputs one value"
        raise BadRequest(problem, "too many ranges")
    names = {name for source in entering for name in source.names}
    if of_type is Interval and XI in names - frame.stated.keys() and not names.isdisjoint(("radius", "radius2")):
        remedy = "give --xi, or single radii"
        raise BadRequest(f"ξ of the material is scaled with the radius, which has a range here; {remedy}")
    return Sources(entering, [source for source in of_materials if not isinstance(source.given, of_type)])


def sources_of_results(frame: Frame, names: Sequence[str]) -> Sources:
    """Return the sources that enter quantities of a frame, as far as it allows them."""
    return sources_of(frame, frame.inputs_of(*frame.possible(names)))


# --- Error bars -------------------------------------------------------------------------------------------------------


class ErrorBar(NamedTuple):
    """The uncertainty of a column: its sides by name, numbers or arrays, nan where there is none."""

    type: type[Uncertain]
    sides: Mapping[str, Any]
    parts: Mapping[str, Any] = MappingProxyType({})  # by the first input of a source: the change, or the mean width
    place: Any = 0  # the number of the first place of the sources, from 1 on, where there is no value; 0 for none

    def of(self, value: Any) -> Uncertain:
        """Return a value with its uncertainty."""
        return self.type.of(value, **self.sides)

    def without(self, is_out: Any) -> "ErrorBar":
        """Return the error bar, where some rows have none."""
        if not is_anywhere(is_out):
            return self
        sides = {side: where(is_out, nan, end) for side, end in self.sides.items()}
        return self._replace(sides=sides, place=where(is_out, 0, self.place))

    @property
    def shares(self) -> dict[str, float]:
        """The share of each source in the variance, or in the width of a range, of a single row: the largest first."""
        power, largest = 1 if self.type is Interval else 2, max(self.parts.values())
        sizes = {name: (part / largest) ** power for name, part in self.parts.items()}  # squares may leave the doubles
        shares = {name: size / fsum(sizes.values()) for name, size in sizes.items() if size}
        return dict(sorted(shares.items(), key=lambda share: -share[1]))


def number_of_places(frame: Frame, names: Sequence[str]) -> int:
    """Return the number of places to which the sources of quantities are moved.

    Raises a JkrollError for sources that do not go together.
    """
    sources = sources_of_results(frame, names).entering
    if not sources:
        return 1
    is_range = isinstance(sources[0].given, Interval)
    return len(sources) * ((STEPS + 1) << (len(sources) - 1) if is_range else 2)


MadeOf = Callable[[Frame], Frame]  # makes a frame of another one


def itself(frame: Frame) -> Frame:
    """Return a frame as it is."""
    return frame


def error_bars(
    frame: Frame, names: Iterable[str], made_of: MadeOf = itself, sources: Sources | None = None
) -> dict[str, ErrorBar]:
    """Return the error bars of quantities of a frame, or of one that is made of it.

    A quantity that has no finite value in any row, or on which no source has an influence, is left out. `sources`: by
    default all that enter the quantities.
    """
    middle, names = made_of(frame), [*names]
    columns = {name: column for name, column in middle.columns(names).items() if not column.is_empty}
    entering = (sources or sources_of_results(middle, names)).entering
    if not (entering and columns):
        return {}
    edges = edges_of(entering)
    moved = _at_places(frame, [*chain.from_iterable(edges)], made_of, [*columns])
    bars = {name: _error_bar(columns[name], moved[name], entering, len(edges)) for name in columns}
    return {name: bar for name, bar in bars.items() if bar is not None}


def no_error_bar(
    frame: Frame, name: str, bar: ErrorBar, row: int = 0, made_of: MadeOf = itself, sources: Sources | None = None
) -> NoErrorBar:
    """Return why a row has no error bar: the reason why its quantity has no value at a place of the sources."""
    entering = (sources or sources_of_results(made_of(frame), [name])).entering
    places = [*chain.from_iterable(edges_of(entering))]
    moved = made_of(frame.replace(**places[at_row(bar.place, row) - 1]))
    error = moved.error(name, at_row(moved.columns((name,))[name].reasons, row), row)
    return NoErrorBar(name, explanation_of(name, error))


def _at_places(
    frame: Frame, places: Sequence[Mapping[str, Any]], made_of: MadeOf, names: Sequence[str]
) -> dict[str, Column]:
    """Return quantities at places of the sources, which are the first axis of their columns.

    The columns of a single row are lists.
    """
    if not frame.shape and len(places) <= frame.few:
        rows = [made_of(frame.replace(**place)).columns(names) for place in places]
        return {name: Column([row[name].values for row in rows], [row[name].reasons for row in rows]) for name in names}
    import numpy

    arrays = {}
    for name in places[0]:
        array = numpy.array([place[name] for place in places])
        arrays[name] = array.reshape(-1, *(1 for _ in frame.shape)) if array.ndim == 1 else array
    shape, columns = (len(places), *frame.shape), made_of(frame.replace(**arrays)).columns(names)
    moved = {name: [numpy.broadcast_to(cells, shape) for cells in column] for name, column in columns.items()}
    return {name: Column(*(cells if frame.shape else cells.tolist() for cells in each)) for name, each in moved.items()}


def _error_bar(column: Column, moved: Column, sources: Sequence[Source], edges: int) -> ErrorBar | None:
    """Return the error bar of a column, from the column at all places on edges; None if there is none."""
    of_type, value, steps = type(sources[0].given), column.values, len(moved.values) // edges
    on_edges = _divided(moved.values, steps)
    extents = _divided([(_least(values), _most(values)) for values in on_edges], edges // len(sources))
    sides, parts = (_range if of_type is Interval else _quadrature)(value, extents)
    is_still = reduce(at_least, parts) <= ROUNDING * absolute(value)
    lacks_value = (column.reasons != 0) | (absolute(value) == INFINITY)
    place = where(lacks_value, 0, _first(moved.reasons))
    is_open = is_still | lacks_value | (place != 0)
    if is_open is True:
        return ErrorBar(of_type, {}, place=place) if place else None
    of_sources = dict(zip((source.names[0] for source in sources), parts, strict=True))
    return ErrorBar(of_type, {side: where(is_open, nan, end) for side, end in sides.items()}, of_sources, place)


def _least(values: Any) -> Any:
    return min(values) if isinstance(values, list) else values.min(axis=0)


def _most(values: Any) -> Any:
    return max(values) if isinstance(values, list) else values.max(axis=0)


def _first(reasons: Any) -> Any:
    """Return the number of the first place that has a reason, from 1 on; 0 for none."""
    if isinstance(reasons, list):
        return next((number for number, each in enumerate(reasons, 1) if each), 0)
    return where(reasons.any(axis=0), reasons.astype(bool).argmax(axis=0) + 1, 0)


def edges_of(sources: Sequence[Source]) -> list[list[dict[str, Any]]]:
    """Return the edges along which each source in turn is moved: equally many for each, as lists of places.

    A standard uncertainty is moved to both of its ends, with the others at their middles; a range by steps, with the
    others at each corner of their box. The largest value of a quantity that has no turning point is that of a corner.
    One that is that of the weaker body, and falls off where the other becomes the weaker, has it at a corner or where
    such a ridge meets an edge.
    """
    edges = []
    for source in sources:
        given, others = source.given, [other for other in sources if other is not source]
        is_range = isinstance(given, Interval)
        moved = _steps(given.low, given.high) if is_range else [given.low, given.high]
        fixed = [(other.given.low, other.given.high) if is_range else (other.given.value,) for other in others]
        for corner in product(*fixed):
            place = {name: end for other, end in zip(others, corner, strict=True) for name in other.names}
            edges.append([{**place, **dict.fromkeys(source.names, end)} for end in moved])
    return edges


def _steps(low: Any, high: Any) -> list[Any]:
    """Return values from one end of a range to the other: by ratio, or by difference where it has 0 in it."""
    is_by_ratio = low * high > 0
    ratio = where(is_by_ratio, high, 1.0) / where(is_by_ratio, low, 1.0)
    shares = [step / STEPS for step in range(1, STEPS)]
    between = [where(is_by_ratio, low * ratio**share, low + share * (high - low)) for share in shares]
    return [low, *between, high]


def _divided(values: Any, size: int) -> list[Any]:
    """Return a list or an array in parts of a size."""
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
