"""The uncertainty of results from those of the inputs: standard uncertainties in quadrature, ranges by their extremes.

Every source moves over the whole of its uncertainty, and the quantities are computed again at these points. There are
no derivatives, so a result may respond differently to either side. Over ranges, a result has its least and largest
value at the points along the edges of their box: exact within 1 % of the range if it turns smoothly.
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

MAX_RANGES = 8  # of one problem; all corners of their box are computed
ASYMMETRIC = 0.1  # relative difference of the two sides above which both are given
STEPS = 64  # along each edge of the box of ranges
ROUNDING = 4e-15  # relative change of a value that may come from rounding


# --- Sources ----------------------------------------------------------------------------------------------------------


class Source(NamedTuple):
    """A value with an uncertainty, and the inputs that share it and move together."""

    names: tuple[str, ...]
    given: Uncertain


class Sources(NamedTuple):
    """The sources of uncertainty of a result, and the sources of materials left out for being of the other kind."""

    entering: Sequence[Source]
    left_out: Sequence[Source] = ()

    @property
    def given(self) -> dict[str, Uncertain]:
        """The values of the entering sources, by all of their names."""
        given: dict[str, Uncertain] = {}
        for source in self.entering:
            given |= dict.fromkeys(source.names, source.given)
        return given

    @property
    def sides(self) -> set[str]:
        """The sides of the entering sources: minus and plus, or low and high."""
        return {*chain.from_iterable(source.given.sides for source in self.entering)}


def sources_of(frame: Frame, used: Collection[str]) -> Sources:
    """Return the sources of quantities that depend on the inputs `used`.

    A value that sphere 2 takes from sphere 1 moves with it, and so do both values of a material given twice. All
    sources must be of one kind, that of the stated values; without any, ± if some material has one. Raises BadRequest
    for sources that cannot be combined.
    """
    of_solids = {name: (solid.key, of_solid) for name, (solid, of_solid) in frame.data.items()}
    names_of: dict[Any, list[str]] = {}  # by value
    for name in in_order(frame.uncertainties):
        names_of.setdefault(of_solids.get(name, name), []).append(name)
    if "radius" in names_of and "radius2" not in frame.given:
        names_of["radius"].append("radius2")
    given = [Source(tuple(names), frame.uncertainties[names[0]]) for names in names_of.values()]
    given = [source for source in given if not set(used).isdisjoint(source.names)]
    stated = [source for source in given if source.names[0] not in of_solids]
    of_materials = [source for source in given if source.names[0] in of_solids]
    kinds = {type(source.given): source for source in stated}
    if len(kinds) > 1:
        symbols = [NOMENCLATURE[kinds[kind].names[0]].symbol for kind in (Measured, Interval)]
        mixed = f"{symbols[0]} has a standard uncertainty (±) and {symbols[1]} a range"
        raise BadRequest(f"{mixed}; give both as ± or both as ranges", "± and range together")
    is_standard = any(isinstance(source.given, Measured) for source in stated or of_materials)
    of_type = Measured if is_standard else Interval
    entering = [source for source in (*stated, *of_materials) if isinstance(source.given, of_type)]
    if of_type is Interval and len(entering) > MAX_RANGES:
        problem = f"{len(entering)} ranges are more than {MAX_RANGES}; give some of these inputs one value"
        raise BadRequest(problem, "too many ranges")
    names = {*Sources(entering).given}
    if of_type is Interval and XI in names - frame.stated.keys() and not names.isdisjoint(("radius", "radius2")):
        remedy = "give --xi, or single radii"
        raise BadRequest(f"ξ of the material is scaled with the radius, which has a range here; {remedy}")
    return Sources(entering, [source for source in of_materials if not isinstance(source.given, of_type)])


def sources_of_results(frame: Frame, names: Sequence[str]) -> Sources:
    """Return the sources of quantities of a frame, as far as it determines them."""
    return sources_of(frame, frame.inputs_of(*frame.possible(names)))


# --- Uncertainties of results -----------------------------------------------------------------------------------------


class ErrorBar(NamedTuple):
    """The uncertainty of a column: its sides by name, as numbers or arrays, nan where there is none."""

    type: type[Uncertain]
    sides: Mapping[str, Any]
    parts: Mapping[str, Any] = MappingProxyType(
        {}
    )  # by the first input of a source: the change, or the mean width of a range
    open_at: Any = 0  # the number, from 1, of the first point of the sources without a value; 0 for none

    def of(self, value: Any) -> Uncertain:
        """Return a value with its uncertainty."""
        return self.type.of(value, **self.sides)

    def without(self, is_out: Any) -> "ErrorBar":
        """Return the uncertainty with some rows emptied."""
        if not is_anywhere(is_out):
            return self
        sides = {side: where(is_out, nan, end) for side, end in self.sides.items()}
        return self._replace(sides=sides, open_at=where(is_out, 0, self.open_at))

    @property
    def shares(self) -> dict[str, float]:
        """The share of each source in the variance, or in the width of a range, for a single row; the largest first."""
        power, largest = 1 if self.type is Interval else 2, max(self.parts.values())
        sizes = {
            name: (part / largest) ** power for name, part in self.parts.items()
        }  # squares of the parts might overflow
        shares = {name: size / fsum(sizes.values()) for name, size in sizes.items() if size}
        return dict(sorted(shares.items(), key=lambda share: -share[1]))


def number_of_points(frame: Frame, names: Sequence[str]) -> int:
    """Return the number of points to which the sources of quantities move.

    Raises a JkrollError for sources that cannot be combined.
    """
    sources = sources_of_results(frame, names).entering
    if not sources:
        return 1
    if isinstance(sources[0].given, Measured):
        return 2 * len(sources)
    return len(sources) * ((STEPS + 1) << (len(sources) - 1))


MadeOf = Callable[[Frame], Frame]  # a variant of a frame


def itself(frame: Frame) -> Frame:
    """Return the frame unchanged."""
    return frame


def error_bars(
    frame: Frame, names: Iterable[str], made_of: MadeOf = itself, sources: Sources | None = None
) -> dict[str, ErrorBar]:
    """Return the uncertainties of quantities of a frame, or of a variant of it.

    Quantities without a finite value, or without influence of any source, are left out. `sources`: by default all that
    enter the quantities.
    """
    middle, names = made_of(frame), [*names]
    columns = {name: column for name, column in middle.columns(names).items() if not column.is_empty}
    entering = (sources or sources_of_results(middle, names)).entering
    if not (entering and columns):
        return {}
    edges = edges_of(entering)
    moved = _at_points(frame, [*chain.from_iterable(edges)], made_of, [*columns])
    bars = {}
    for name, column in columns.items():
        bar = _error_bar(column, moved[name], entering, len(edges))
        if bar is not None:
            bars[name] = bar
    return bars


def no_error_bar(
    frame: Frame, name: str, bar: ErrorBar, row: int = 0, made_of: MadeOf = itself, sources: Sources | None = None
) -> NoErrorBar:
    """Return the error of a row without an uncertainty: the reason why its quantity has no value at a point."""
    entering = (sources or sources_of_results(made_of(frame), [name])).entering
    points = [*chain.from_iterable(edges_of(entering))]
    moved = made_of(frame.replace(**points[at_row(bar.open_at, row) - 1]))
    error = moved.error(name, at_row(moved.columns((name,))[name].reasons, row), row)
    return NoErrorBar(name, explanation_of(name, error))


def _at_points(
    frame: Frame, points: Sequence[Mapping[str, Any]], made_of: MadeOf, names: Sequence[str]
) -> dict[str, Column]:
    """Return quantities at points of the sources, the first axis of the columns; lists for a single row."""
    if not frame.shape and len(points) <= frame.few:
        rows = [made_of(frame.replace(**point)).columns(names) for point in points]
        return {name: Column([row[name].values for row in rows], [row[name].reasons for row in rows]) for name in names}
    import numpy

    arrays: dict[str, Any] = {}
    for name in points[0]:
        array = numpy.array([point[name] for point in points])
        arrays[name] = array.reshape(-1, *(1 for _ in frame.shape)) if array.ndim == 1 else array
    shape, moved = (len(points), *frame.shape), {}
    for name, column in made_of(frame.replace(**arrays)).columns(names).items():
        values, reasons = (numpy.broadcast_to(cells, shape) for cells in column)
        moved[name] = Column(values, reasons) if frame.shape else Column(values.tolist(), reasons.tolist())
    return moved


def _error_bar(column: Column, moved: Column, sources: Sequence[Source], edges: int) -> ErrorBar | None:
    """Return the uncertainty of a column, from its values at all points on edges; None if there is none."""
    of_type, value, steps = type(sources[0].given), column.values, len(moved.values) // edges
    on_edges = _divided(moved.values, steps)
    extents = _divided([(_least(values), _most(values)) for values in on_edges], edges // len(sources))
    sides, parts = (_range if of_type is Interval else _quadrature)(value, extents)
    is_still = reduce(at_least, parts) <= ROUNDING * absolute(value)
    lacks_value = (column.reasons != 0) | (absolute(value) == INFINITY)
    open_at = where(lacks_value, 0, _first(moved.reasons))
    is_open = is_still | lacks_value | (open_at != 0)
    if is_open is True:
        return ErrorBar(of_type, {}, open_at=open_at) if open_at else None
    of_sources = dict(zip((source.names[0] for source in sources), parts, strict=True))
    return ErrorBar(of_type, {side: where(is_open, nan, end) for side, end in sides.items()}, of_sources, open_at)


def _least(values: Any) -> Any:
    return min(values) if isinstance(values, list) else values.min(axis=0)


def _most(values: Any) -> Any:
    return max(values) if isinstance(values, list) else values.max(axis=0)


def _first(reasons: Any) -> Any:
    """Return the number, from 1, of the first point with a reason; 0 if there is none."""
    if isinstance(reasons, list):
        for number, each in enumerate(reasons, 1):
            if each:
                return number
        return 0
    return where(reasons.any(axis=0), reasons.astype(bool).argmax(axis=0) + 1, 0)


def edges_of(sources: Sequence[Source]) -> list[list[dict[str, Any]]]:
    """Return the edges along which the sources move, the same number for each, as lists of points.

    A standard uncertainty moves to both of its ends, with the others at their middles; a range moves in steps, with the
    others at each corner of their box. A quantity without a turning point is largest at a corner. A quantity of the
    weaker body, which drops where the other body becomes weaker, is largest at a corner or where this ridge meets an
    edge.
    """
    edges = []
    for source in sources:
        given, others = source.given, [other for other in sources if other is not source]
        is_range = isinstance(given, Interval)
        moved = _steps(given.low, given.high) if is_range else [given.low, given.high]
        fixed = [(other.given.low, other.given.high) if is_range else (other.given.value,) for other in others]
        for corner in product(*fixed):
            point: dict[str, Any] = {}
            for other, end in zip(others, corner, strict=True):
                point |= dict.fromkeys(other.names, end)
            edges.append([{**point, **dict.fromkeys(source.names, end)} for end in moved])
    return edges


def _steps(low: Any, high: Any) -> list[Any]:
    """Return values from one end of a range to the other: by ratio, or by difference if 0 lies between."""
    is_by_ratio = low * high > 0
    ratio = where(is_by_ratio, high, 1.0) / where(is_by_ratio, low, 1.0)
    shares = [step / STEPS for step in range(1, STEPS)]
    between = [where(is_by_ratio, low * ratio**share, low + share * (high - low)) for share in shares]
    return [low, *between, high]


def _divided(values: Any, size: int) -> list[Any]:
    """Return a list or an array in parts of equal size."""
    return [values[start : start + size] for start in range(0, len(values), size)]


def _quadrature(value: Any, of_sources: Sequence[Sequence[Any]]) -> tuple[Mapping[str, Any], Sequence[Any]]:
    """Return a standard uncertainty, with changes to either side added in quadrature, and their sizes by source."""
    changes = [(at_least(value - low, 0.0), at_least(high - value, 0.0)) for ((low, high),) in of_sources]
    minus, plus = (hypot(*sizes) for sizes in zip(*changes, strict=True))
    alike = absolute(plus - minus) <= ASYMMETRIC * at_least(plus, minus)
    middle = (minus + plus) / 2
    sides = {"minus": where(alike, middle, minus), "plus": where(alike, middle, plus)}
    return sides, [hypot(*change) for change in changes]


def _range(value: Any, of_sources: Sequence[Sequence[Any]]) -> tuple[Mapping[str, Any], Sequence[Any]]:
    """Return the least and the largest value on all edges, and the mean width along the edges of each source."""
    lows, highs = zip(*chain.from_iterable(of_sources), strict=True)
    parts = [sum(high - low for low, high in extents) / len(extents) for extents in of_sources]
    return {"low": reduce(at_most, lows, value), "high": reduce(at_least, highs, value)}, parts
