"""Uncertainties of results: standard uncertainties of the inputs add in quadrature, ranges give extremes.

Each source, an uncertain input, moves over its whole uncertainty, and the quantities are computed again at every point.
There are no derivatives, so a result may respond differently upwards and downwards. Ranges span a box, and a result
takes its least and its largest value from points along the edges. These extremes are accurate to 1 % of the width of
the result's range if the result varies smoothly.
"""

from collections.abc import Collection, Iterable, Mapping, Sequence
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
from .frame import Frame, Variant, itself
from .plan import in_order
from .reasons import NoErrorBar, explanation_of

MAX_RANGES = 8  # in one problem, since every corner of their box is computed
ASYMMETRIC = 0.1  # relative difference of minus and plus above which both are given
STEPS = 64  # along each edge of the box of ranges
ROUNDING = 4e-15  # relative change of a value that may come from rounding


# --- Sources ----------------------------------------------------------------------------------------------------------


class Source(NamedTuple):
    """An uncertain value, and the inputs that share it and so move together."""

    names: tuple[str, ...]
    given: Uncertain


class Sources(NamedTuple):
    """The sources that enter a result; sources of materials are left out if they are of the other kind (± or range)."""

    entering: Sequence[Source]
    left_out: Sequence[Source] = ()

    @property
    def given(self) -> dict[str, Uncertain]:
        """The uncertain values of the entering sources, by input."""
        given: dict[str, Uncertain] = {}
        for source in self.entering:
            given |= dict.fromkeys(source.names, source.given)
        return given

    @property
    def sides(self) -> set[str]:
        """The sides of the entering sources: minus and plus, or low and high."""
        sides: set[str] = set()
        for source in self.entering:
            sides |= source.given.sides.keys()
        return sides


def sources_of(frame: Frame, used: Collection[str]) -> Sources:
    """Return the sources of quantities that depend on the inputs `used`.

    The sources of stated values must be of one kind; those of materials enter only if they are of this kind. If only
    materials have uncertainties, ± takes precedence over ranges. Raises BadRequest for sources that cannot be combined.
    """
    sources = [source for source in _sources(frame) if not set(used).isdisjoint(source.names)]
    stated = [source for source in sources if source.names[0] not in frame.data]
    of_materials = [source for source in sources if source.names[0] in frame.data]
    of_kind = {type(source.given): source for source in stated}
    if len(of_kind) > 1:
        standard, ranged = (NOMENCLATURE[of_kind[kind].names[0]].symbol for kind in (Measured, Interval))
        mixed = f"{standard} has a standard uncertainty (±) and {ranged} a range"
        raise BadRequest(f"{mixed}; give both as ± or both as ranges", "± and range together")
    is_standard = any(isinstance(source.given, Measured) for source in stated or of_materials)
    kind = Measured if is_standard else Interval
    entering = [source for source in (*stated, *of_materials) if isinstance(source.given, kind)]
    if kind is Interval:
        _check_ranges(frame, entering)
    return Sources(entering, [source for source in of_materials if not isinstance(source.given, kind)])


def _sources(frame: Frame) -> list[Source]:
    """Return all sources of a frame.

    A value that sphere 2 takes from sphere 1 is the same source, and so is a property of a material that both share.
    """
    names_of: dict[Any, list[str]] = {}  # by input, or by material and property
    for name in in_order(frame.uncertainties):
        value: Any = name
        if name in frame.data:
            material, of_material = frame.data[name]
            value = material.key, of_material
        names_of.setdefault(value, []).append(name)
    if "radius" in names_of and "radius2" not in frame.given:
        names_of["radius"].append("radius2")
    return [Source(tuple(names), frame.uncertainties[names[0]]) for names in names_of.values()]


def _check_ranges(frame: Frame, sources: Sequence[Source]) -> None:
    """Raise BadRequest for ranges that cannot be combined."""
    if len(sources) > MAX_RANGES:
        problem = f"{len(sources)} inputs have ranges, but {MAX_RANGES} at most go together; give single values"
        raise BadRequest(problem, "too many ranges")
    names = Sources(sources).given.keys()
    if XI in names - frame.stated.keys() and not names.isdisjoint(("radius", "radius2")):
        remedy = "give --xi, or single radii"
        raise BadRequest(f"ξ of the material is scaled with the radius, which has a range here; {remedy}")


def sources_of_results(frame: Frame, names: Sequence[str]) -> Sources:
    """Return the sources of those quantities that a frame determines."""
    return sources_of(frame, frame.inputs_of(*frame.possible(names)))


# --- Uncertainties of results -----------------------------------------------------------------------------------------


class ErrorBar(NamedTuple):
    """The uncertainty of a column: its sides by name, as numbers or arrays, nan where there is none."""

    type: type[Uncertain]
    sides: Mapping[str, Any]
    # The change that each source causes, or the mean width of the range, by the first input of the source.
    parts: Mapping[str, Any] = MappingProxyType({})
    open_at: Any = 0  # the number, from 1, of the first point where the quantity has no value; 0 for none

    def of(self, value: Any) -> Uncertain:
        """Return a value with this uncertainty."""
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
        sizes = {}
        for name, part in self.parts.items():
            size = (part / largest) ** power  # the square of a part itself might overflow
            if size:
                sizes[name] = size
        total = fsum(sizes.values())
        return {name: sizes[name] / total for name in sorted(sizes, key=sizes.__getitem__, reverse=True)}


def number_of_points(frame: Frame, names: Sequence[str]) -> int:
    """Return the number of points at which quantities are computed, as their sources move.

    Raises a JkrollError for sources that cannot be combined.
    """
    sources = sources_of_results(frame, names).entering
    if not sources:
        return 1
    if isinstance(sources[0].given, Measured):
        return 2 * len(sources)
    return len(sources) * ((STEPS + 1) << (len(sources) - 1))


def error_bars(
    frame: Frame, names: Iterable[str], made_of: Variant = itself, sources: Sources | None = None
) -> dict[str, ErrorBar]:
    """Return the uncertainties of quantities of a frame, or of a variant of it.

    Quantities without a finite value are left out, and so are quantities that no source changes. `sources`: the sources
    to move, by default all that enter the quantities.
    """
    middle, names = made_of(frame), [*names]
    columns = {name: column for name, column in middle.columns(names).items() if not column.is_empty}
    entering = (sources or sources_of_results(middle, names)).entering
    if not (entering and columns):
        return {}
    edges = edges_of(entering)
    points = [*chain.from_iterable(edges)]
    moved = _at_points(frame, points, made_of, [*columns])
    bars = {}
    for name, column in columns.items():
        bar = _error_bar(column, moved[name], entering, len(edges))
        if bar is not None:
            bars[name] = bar
    return bars


def no_error_bar(frame: Frame, name: str, bar: ErrorBar, row: int = 0, sources: Sources | None = None) -> NoErrorBar:
    """Return the error of a row without an uncertainty, which states why the quantity has no value at a point."""
    entering = (sources or sources_of_results(frame, [name])).entering
    points = [*chain.from_iterable(edges_of(entering))]
    index = at_row(bar.open_at, row) - 1
    # Computed on its own, the point may have a value because of rounding.
    reasons = _at_points(frame, points, itself, [name])[name].reasons
    moved = frame.replace(**points[index])
    moved.column(name)
    return NoErrorBar(name, explanation_of(name, moved.error(name, at_row(reasons[index], row), row)))


def _at_points(
    frame: Frame, points: Sequence[Mapping[str, Any]], made_of: Variant, names: Sequence[str]
) -> dict[str, Column]:
    """Return columns of quantities whose first axis runs over points of the sources; lists for a single row."""
    moved = {}
    if not frame.shape and len(points) <= frame.few:
        rows = [made_of(frame.replace(**point)).columns(names) for point in points]
        for name in names:
            cells = [row[name] for row in rows]
            moved[name] = Column([cell.values for cell in cells], [cell.reasons for cell in cells])
        return moved
    import numpy

    arrays: dict[str, Any] = {}
    for name in points[0]:
        array = numpy.array([point[name] for point in points])
        if array.ndim == 1:  # one number for all rows
            array = array.reshape(-1, *[1] * len(frame.shape))
        arrays[name] = array
    shape = len(points), *frame.shape
    for name, column in made_of(frame.replace(**arrays)).columns(names).items():
        values, reasons = (numpy.broadcast_to(array, shape) for array in column)
        moved[name] = Column(values, reasons) if frame.shape else Column(values.tolist(), reasons.tolist())
    return moved


def _error_bar(column: Column, moved: Column, sources: Sequence[Source], edges: int) -> ErrorBar | None:
    """Return the uncertainty of a column, from its values at all points on edges; None if no row has an uncertainty."""
    of_type, value = type(sources[0].given), column.values
    on_edges = _divided(moved.values, len(moved.values) // edges)
    extents = [(_least(values), _most(values)) for values in on_edges]
    of_sources = _divided(extents, edges // len(sources))
    sides, parts = _range(value, of_sources) if of_type is Interval else _quadrature(value, of_sources)
    is_still = reduce(at_least, parts) <= ROUNDING * absolute(value)
    lacks_value = (column.reasons != 0) | (absolute(value) == INFINITY)
    open_at = where(lacks_value, 0, _first(moved.reasons))
    is_open = is_still | lacks_value | (open_at != 0)
    if is_open is True:
        return ErrorBar(of_type, {}, open_at=open_at) if open_at else None
    sides = {side: where(is_open, nan, end) for side, end in sides.items()}
    by_source = {source.names[0]: part for source, part in zip(sources, parts, strict=True)}
    return ErrorBar(of_type, sides, by_source, open_at)


def _least(values: Any) -> Any:
    return min(values) if isinstance(values, list) else values.min(axis=0)


def _most(values: Any) -> Any:
    return max(values) if isinstance(values, list) else values.max(axis=0)


def _first(reasons: Any) -> Any:
    """Return the number, from 1, of the first point with a reason; 0 if there is none."""
    if isinstance(reasons, list):
        for number, reason in enumerate(reasons, 1):
            if reason:
                return number
        return 0
    return where(reasons.any(axis=0), reasons.astype(bool).argmax(axis=0) + 1, 0)


def edges_of(sources: Sequence[Source]) -> list[list[dict[str, Any]]]:
    """Return the edges along which the sources move, as lists of points; each source has the same number of edges.

    A standard uncertainty moves to both of its ends, with the others at their middles. A range moves in steps, with the
    others at each corner of their box. A quantity without a turning point is largest at a corner. A quantity set by
    the weaker body has a ridge where the two bodies are equally weak; it is largest at a corner, or where the ridge
    meets an edge.
    """
    edges = []
    for source in sources:
        low, high = source.given.low, source.given.high
        others = [other for other in sources if other is not source]
        if isinstance(source.given, Interval):
            steps = _steps(low, high)
            corners = [*product(*((other.given.low, other.given.high) for other in others))]
        else:
            steps = [low, high]
            corners = [tuple(other.given.value for other in others)]
        for corner in corners:
            fixed: dict[str, Any] = {}
            for other, value in zip(others, corner, strict=True):
                fixed |= dict.fromkeys(other.names, value)
            edges.append([{**fixed, **dict.fromkeys(source.names, value)} for value in steps])
    return edges


def _steps(low: Any, high: Any) -> list[Any]:
    """Return values across a range: in equal ratios if its ends have the same sign, otherwise in equal steps."""
    is_by_ratio = low * high > 0
    ratio = where(is_by_ratio, high, 1.0) / where(is_by_ratio, low, 1.0)
    values = [low]
    for step in range(1, STEPS):
        share = step / STEPS
        values.append(where(is_by_ratio, low * ratio**share, low + share * (high - low)))
    return [*values, high]


def _divided(values: Any, size: int) -> list[Any]:
    """Return a list or an array in parts of equal size."""
    return [values[start : start + size] for start in range(0, len(values), size)]


def _quadrature(value: Any, of_sources: Sequence[Sequence[Any]]) -> tuple[Mapping[str, Any], Sequence[Any]]:
    """Return the two sides of a standard uncertainty, and the size of the change that each source causes.

    Changes in the same direction add in quadrature. If the sides differ by at most 10 %, both are their mean.
    """
    changes = [(at_least(value - low, 0.0), at_least(high - value, 0.0)) for ((low, high),) in of_sources]
    minus, plus = (hypot(*sizes) for sizes in zip(*changes, strict=True))
    alike = absolute(plus - minus) <= ASYMMETRIC * at_least(plus, minus)
    middle = (minus + plus) / 2
    sides = {"minus": where(alike, middle, minus), "plus": where(alike, middle, plus)}
    return sides, [hypot(*change) for change in changes]


def _range(value: Any, of_sources: Sequence[Sequence[Any]]) -> tuple[Mapping[str, Any], Sequence[Any]]:
    """Return the least and the largest value on all edges, and the mean width along the edges of each source."""
    least, most, parts = value, value, []
    for extents in of_sources:
        width: Any = 0
        for low, high in extents:
            least, most, width = at_most(least, low), at_least(most, high), width + (high - low)
        parts.append(width / len(extents))
    return {"low": least, "high": most}, parts
