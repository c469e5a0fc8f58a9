"""Uncertainties of results: standard uncertainties of the inputs add in quadrature, ranges give extremes.

Each source, an uncertain input, moves over its whole uncertainty, and the quantities are computed again at every point.
There are no derivatives, so a result may respond differently upwards and downwards. Ranges span a box, and a result
takes its least and its largest value from points along the edges. These extremes are accurate to 1 % of the width of
the result's range if the result varies smoothly. With sources of both kinds, a result has a range: that of the box,
extended by the standard uncertainty at each corner.
"""

from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from functools import reduce
from itertools import product
from math import ceil, fsum, log10, nan
from types import MappingProxyType
from typing import Any, NamedTuple

from ..errors import BadRequest
from ..physics.elementary import NUMBER, absolute, at_least, at_most, hypot, is_anywhere, where
from ..quantities.nomenclature import INFINITY, XI
from ..quantities.values import Interval, Measured, Uncertain
from .column import Column, at_row
from .frame import Frame, Variant, itself
from .plan import in_order
from .reasons import NoErrorBar, explanation_of

MAX_RANGES = 8  # that enter the quantities computed together, since every corner of the box is computed
ASYMMETRIC = 0.1  # relative difference of minus and plus above which they are not replaced by their mean
STEPS = 64  # along each edge of the box of ranges; with sources of both kinds, fewer on an edge shorter than a decade
ROUNDING = 4e-15  # relative change of a value that may come from rounding


# --- Sources ----------------------------------------------------------------------------------------------------------


class Source(NamedTuple):
    """An uncertain value, and the inputs that share it and so move together."""

    names: tuple[str, ...]
    given: Uncertain

    @property
    def name(self) -> str:
        """The first of these inputs."""
        return self.names[0]


class Sources(NamedTuple):
    """The sources that enter some results."""

    entering: Sequence[Source]

    @property
    def ranges(self) -> list[Source]:
        """The sources that are ranges."""
        return [source for source in self.entering if isinstance(source.given, Interval)]

    @property
    def standard(self) -> list[Source]:
        """The sources that are standard uncertainties."""
        return [source for source in self.entering if isinstance(source.given, Measured)]

    @property
    def given(self) -> dict[str, Uncertain]:
        """The uncertain values of the sources, by input."""
        given: dict[str, Uncertain] = {}
        for source in self.entering:
            given |= dict.fromkeys(source.names, source.given)
        return given

    @property
    def sides(self) -> set[str]:
        """The sides of a result's uncertainty: low and high if any source is a range; empty without a source."""
        if not self.entering:
            return set()
        return {"low", "high"} if self.ranges else {"minus", "plus"}


def sources_of(frame: Frame, used: Collection[str]) -> Sources:
    """Return the sources of quantities that depend on the inputs `used`. Raises BadRequest for too many ranges."""
    sources = Sources([source for source in _sources(frame) if not set(used).isdisjoint(source.names)])
    if len(sources.ranges) > MAX_RANGES:
        problem = f"{len(sources.ranges)} inputs have ranges, but {MAX_RANGES} at most go together; give single values"
        raise BadRequest(problem, "too many ranges")
    return sources


def _sources(frame: Frame) -> list[Source]:
    """Return all sources of a frame.

    A value that sphere 2 takes from sphere 1 is the same source, and so is a property of a material that both share.
    """
    names_of: dict[Any, list[str]] = {}  # by input, or by material and property
    for name in in_order(frame.uncertainties):
        if name == XI and name in frame.data and not {"radius", "radius2"}.isdisjoint(frame.unknowns):
            continue  # the range of ξ depends on the unknown radius
        key: Any = name
        if name in frame.data:
            material, of_material = frame.data[name]
            key = material.key, of_material
        names_of.setdefault(key, []).append(name)
    if "radius" in names_of and "radius2" not in frame.given:
        names_of["radius"].append("radius2")
    return [Source(tuple(names), frame.uncertainties[names[0]]) for names in names_of.values()]


def sources_of_results(frame: Frame, names: Sequence[str]) -> Sources:
    """Return the sources of the quantities in `names` that the frame determines."""
    return sources_of(frame, frame.inputs_of(*frame.possible(names)))


# --- Uncertainties of results -----------------------------------------------------------------------------------------


class ErrorBar(NamedTuple):
    """The uncertainty of a column: its sides by name, as numbers or arrays, nan where there is none."""

    type: type[Uncertain]
    sides: Mapping[str, Any]
    # By the first input of each source: the size of the change that it causes or, if the result has a range, the mean
    # width.
    parts: Mapping[str, Any] = MappingProxyType({})
    open_at: Any = 0  # the number, from 1, of the first point where the quantity has no value; 0 if there is none

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
    """Return the number of points at which quantities are computed, as their sources move. Raises a JkrollError."""
    sources = sources_of_results(frame, names)
    corners = 1 << len(sources.ranges)
    at_each_corner = 2 * len(sources.standard) + (1 if sources.ranges else 0)
    inside_edges = corners // 2 * sum(steps - 1 for steps in _steps_of(sources))
    return max(corners * at_each_corner + inside_edges, 1)


def error_bars(
    frame: Frame, names: Iterable[str], variant: Variant = itself, sources: Sources | None = None
) -> dict[str, ErrorBar]:
    """Return the uncertainties of quantities of a frame, or of a variant of it.

    Quantities without a value are left out. So are infinite values and values that no source changes in a single row;
    in arrays, the sides are nan in such rows. `sources`: the sources to move, by default all that enter the quantities.
    """
    middle, names = variant(frame), [*names]
    columns = {name: column for name, column in middle.columns(names).items() if not column.is_empty}
    sources = sources or sources_of_results(middle, names)
    if not (sources.entering and columns):
        return {}
    moved = _at_points(frame, points_of(frame, sources), variant, [*columns])
    bars = {}
    for name, column in columns.items():
        bar = _error_bar(column, moved[name], sources)
        if bar is not None:
            bars[name] = bar
    return bars


def no_error_bar(frame: Frame, name: str, bar: ErrorBar, row: int = 0, sources: Sources | None = None) -> NoErrorBar:
    """Return the error of a row without an uncertainty, which states why the quantity has no value at a point."""
    points = points_of(frame, sources or sources_of_results(frame, [name]))
    index = at_row(bar.open_at, row) - 1
    # Take the reason from all points computed together; computed alone, the point may have a value, by rounding.
    reasons = _at_points(frame, points, itself, [name])[name].reasons
    moved = frame.replace(**points[index])
    moved.column(name)
    return NoErrorBar(name, explanation_of(name, moved.error(name, at_row(reasons[index], row), row)))


def _at_points(
    frame: Frame, points: Sequence[Mapping[str, Any]], variant: Variant, names: Sequence[str]
) -> dict[str, Column]:
    """Return a column for each quantity, whose first axis runs over points; for a single row, a list over points."""
    moved = {}
    if not frame.shape and len(points) <= frame.few:
        rows = [variant(_at_point(frame, point)).columns(names) for point in points]
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
    for name, column in variant(frame.replace(**arrays)).columns(names).items():
        values, reasons = (numpy.broadcast_to(array, shape) for array in column)
        moved[name] = Column(values, reasons) if frame.shape else Column(values.tolist(), reasons.tolist())
    return moved


def _at_point(frame: Frame, point: Mapping[str, Any]) -> Frame:
    """Return the frame at a point; the same one for each variant, so that variants share what they compute."""
    frames, key = frame.derived.setdefault(_at_point, {}), tuple(point.items())
    if key not in frames:
        frames[key] = frame.replace(**point)
    at_point: Frame = frames[key]
    return at_point


def _error_bar(column: Column, moved: Column, sources: Sources) -> ErrorBar | None:
    """Return the uncertainty of a column, from its values at all points.

    A single row without an uncertainty gives None, or `open_at` without sides if its value is missing at some point.
    """
    value, combined = column.values, _range if sources.ranges else _quadrature
    bar = combined(value, moved.values, sources)
    is_unchanged = reduce(at_least, bar.parts.values()) <= ROUNDING * absolute(value)
    lacks_value = (column.reasons != 0) | (absolute(value) == INFINITY)
    open_at = where(lacks_value, 0, _first(moved.reasons))
    has_none: Any = is_unchanged | lacks_value | (open_at != 0)
    if has_none is True:
        return ErrorBar(bar.type, {}, open_at=open_at) if open_at else None
    return bar.without(has_none)._replace(open_at=open_at)


def _largest(values: Any) -> float:
    """Return the largest element of an array; a number unchanged."""
    return values if isinstance(values, NUMBER) else float(values.max())


def _first(reasons: Any) -> Any:
    """Return the number, from 1, of the first point with a reason; 0 if there is none."""
    if isinstance(reasons, list):
        for number, reason in enumerate(reasons, 1):
            if reason:
                return number
        return 0
    return where(reasons.any(axis=0), reasons.astype(bool).argmax(axis=0) + 1, 0)


def points_of(frame: Frame, sources: Sources) -> list[dict[str, Any]]:
    """Return the points to which the sources move. The range of a material's ξ is that at the radii of each point."""
    if XI not in sources.given or XI not in frame.data:
        return _points_of(sources)
    entering = []
    for source in sources.entering:
        entering.append(source._replace(given=_POSITION) if XI in source.names else source)
    return [_at_position(frame, point) for point in _points_of(Sources(entering))]


_POSITION = Interval(0.5, 0.0, 1.0)  # within a range, on a logarithmic scale


def _at_position(frame: Frame, point: Mapping[str, Any]) -> dict[str, Any]:
    """Return a point with a value of ξ, in place of the position of ξ within the range of the material."""
    radii = {name: point[name] for name in ("radius", "radius2") if name in point}
    displacement: Any = (frame.replace(**radii) if radii else frame).displacement
    return {**point, XI: displacement.low * (displacement.high / displacement.low) ** point[XI]}


def _points_of(sources: Sources) -> list[dict[str, Any]]:
    """Return the points of sources: those of each corner of the box of ranges, then those inside its edges.

    At a corner, each standard uncertainty moves to both of its ends, with the others at their middles. With ranges, the
    corner itself comes first; without them, the only corner is the value, which needs no point.

    A range moves along an edge, with the others at a corner of their box. A quantity without a turning point is largest
    at a corner. A quantity set by the weaker body has a ridge where the two bodies are equally weak; it is largest at a
    corner, or where the ridge meets an edge.
    """
    middles = {name: source.given.value for source in sources.standard for name in source.names}
    points = []
    for corner in _corners(sources.ranges):
        if sources.ranges:
            points.append({**middles, **corner})
        for source in sources.standard:
            for value in (source.given.low, source.given.high):
                points.append({**middles, **corner, **dict.fromkeys(source.names, value)})
    for source, steps in zip(sources.ranges, _steps_of(sources), strict=True):
        for corner in _corners([other for other in sources.ranges if other is not source]):
            for value in _between(source.given.low, source.given.high, steps):
                points.append({**middles, **corner, **dict.fromkeys(source.names, value)})
    return points


def _steps_of(sources: Sources) -> list[int]:
    """Return the number of steps of each range along an edge.

    With sources of both kinds, narrow ranges have fewer steps, since each corner needs more points.
    """
    if not sources.standard:
        return [STEPS] * len(sources.ranges)
    steps = []
    for source in sources.ranges:
        ratio = _ratio(source.given.low, source.given.high, otherwise=10.0)  # a range across 0 counts as a decade
        decades = log10(_largest(at_least(ratio, 1 / ratio)))
        steps.append(max(1, min(ceil(STEPS * decades), STEPS)))
    return steps


def _corners(ranges: Sequence[Source]) -> Iterator[dict[str, Any]]:
    """Iterate over the corners of a box of ranges."""
    for ends in product(*((source.given.low, source.given.high) for source in ranges)):
        corner: dict[str, Any] = {}
        for source, value in zip(ranges, ends, strict=True):
            corner |= dict.fromkeys(source.names, value)
        yield corner


def _ratio(low: Any, high: Any, *, otherwise: float) -> Any:
    """Return the ratio of the ends of a range; `otherwise` if they do not have the same sign."""
    have_same_sign = low * high > 0
    return where(have_same_sign, high, otherwise) / where(have_same_sign, low, 1.0)


def _between(low: Any, high: Any, steps: int) -> list[Any]:
    """Return the values inside a range: in equal ratios if its ends have the same sign, else equally spaced."""
    is_by_ratio, ratio = low * high > 0, _ratio(low, high, otherwise=1.0)
    values = []
    for step in range(1, steps):
        share = step / steps
        values.append(where(is_by_ratio, low * ratio**share, low + share * (high - low)))
    return values


def _divided(values: Any, size: int) -> list[Any]:
    """Return a list or an array in parts of equal size."""
    return [values[start : start + size] for start in range(0, len(values), size)]


def _quadrature(value: Any, moved: Any, sources: Sources) -> ErrorBar:
    """Return a standard uncertainty, from the values at both ends of each source."""
    changes = _changes(value, moved)
    minus, plus = _sides(changes)
    parts = {source.name: hypot(*change) for source, change in zip(sources.standard, changes, strict=True)}
    return ErrorBar(Measured, {"minus": minus, "plus": plus}, parts)


def _changes(value: Any, moved: Any) -> list[tuple[Any, Any]]:
    """Return the changes of a value downwards and upwards for each source, from the values at both ends of each."""
    changes = []
    for one, other in _divided(moved, 2):
        low, high = at_most(one, other), at_least(one, other)
        changes.append((at_least(value - low, 0.0), at_least(high - value, 0.0)))
    return changes


def _sides(changes: Sequence[tuple[Any, Any]]) -> tuple[Any, Any]:
    """Return the changes downwards and upwards, added in quadrature.

    If the two sums differ by at most 10 %, both are replaced by their mean.
    """
    if not changes:
        return 0.0, 0.0
    minus, plus = (hypot(*sizes) for sizes in zip(*changes, strict=True))
    alike = absolute(plus - minus) <= ASYMMETRIC * at_least(plus, minus)
    middle = (minus + plus) / 2
    return where(alike, middle, minus), where(alike, middle, plus)


def _range(value: Any, moved: Any, sources: Sources) -> ErrorBar:
    """Return the range of the values at all points; at a corner, the standard uncertainty extends it."""
    size = 1 + 2 * len(sources.standard)
    interior = size << len(sources.ranges)  # the index of the first point inside an edge
    corners = _divided(moved[:interior], size)
    low, high = value, value
    parts: dict[str, Any] = dict.fromkeys((source.name for source in sources.entering), 0.0)
    for middle, *ends in corners:
        changes = _changes(middle, ends)
        minus, plus = _sides(changes)
        low, high = at_most(low, middle - minus), at_least(high, middle + plus)
        for source, change in zip(sources.standard, changes, strict=True):
            parts[source.name] += sum(change) / len(corners)
    edges_per_range = len(corners) // 2
    for source, edge in _edges([middle for middle, *_ in corners], moved[interior:], sources):
        least, most = reduce(at_most, edge), reduce(at_least, edge)
        low, high = at_most(low, least), at_least(high, most)
        parts[source.name] += (most - least) / edges_per_range
    return ErrorBar(Interval, {"low": low, "high": high}, parts)


def _edges(corners: Sequence[Any], interior: Any, sources: Sources) -> Iterator[tuple[Source, Sequence[Any]]]:
    """Iterate over the edges of the box of ranges: the range that moves along an edge, and the values on this edge.

    `corners`: the values at the corners; `interior`: those inside the edges, in the order of `_points_of`.
    """
    first = 0
    for number, (source, steps) in enumerate(zip(sources.ranges, _steps_of(sources), strict=True), 1):
        bit = len(corners) >> number  # in the number of a corner, 1 if this range is at its upper end
        for at_low, value in enumerate(corners):
            if not at_low & bit:
                yield source, [value, *interior[first : first + steps - 1], corners[at_low | bit]]
                first += steps - 1
