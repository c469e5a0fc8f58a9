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

MAX_RANGES = 8  # in one problem, since every corner of their box is computed
ASYMMETRIC = 0.1  # relative difference of minus and plus above which both are given
STEPS = 64  # along each edge of the box of ranges; with sources of both kinds, in each decade of an edge
ROUNDING = 4e-15  # relative change of a value that may come from rounding


# --- Sources ----------------------------------------------------------------------------------------------------------


class Source(NamedTuple):
    """An uncertain value, and the inputs that share it and so move together."""

    names: tuple[str, ...]
    given: Uncertain


class Sources(NamedTuple):
    """The sources that enter a result."""

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
    def type(self) -> type[Uncertain]:
        """The type of a result's uncertainty: a range if any source is one."""
        return Interval if self.ranges else Measured

    @property
    def sides(self) -> set[str]:
        """The sides of a result's uncertainty: low and high, or minus and plus; empty without a source."""
        return {*_SIDES[self.type]} if self.entering else set()


_SIDES: Mapping[type[Uncertain], tuple[str, str]] = {Interval: ("low", "high"), Measured: ("minus", "plus")}


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
        value: Any = name
        if name in frame.data:
            material, of_material = frame.data[name]
            value = material.key, of_material
        names_of.setdefault(value, []).append(name)
    if "radius" in names_of and "radius2" not in frame.given:
        names_of["radius"].append("radius2")
    return [Source(tuple(names), frame.uncertainties[names[0]]) for names in names_of.values()]


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
    """Return the number of points at which quantities are computed, as their sources move. Raises a JkrollError."""
    sources = sources_of_results(frame, names)
    corners, interior = 1 << len(sources.ranges), sum(steps - 1 for steps in _steps_of(sources))
    return max((bool(sources.ranges) + 2 * len(sources.standard)) * corners + interior * corners // 2, 1)


def error_bars(
    frame: Frame, names: Iterable[str], made_of: Variant = itself, sources: Sources | None = None
) -> dict[str, ErrorBar]:
    """Return the uncertainties of quantities of a frame, or of a variant of it.

    Quantities without a finite value are left out, and so are quantities that no source changes. `sources`: the sources
    to move, by default all that enter the quantities.
    """
    middle, names = made_of(frame), [*names]
    columns = {name: column for name, column in middle.columns(names).items() if not column.is_empty}
    sources = sources or sources_of_results(middle, names)
    if not (sources.entering and columns):
        return {}
    moved = _at_points(frame, points_of(frame, sources), made_of, [*columns])
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


def _error_bar(column: Column, moved: Column, sources: Sources) -> ErrorBar | None:
    """Return the uncertainty of a column, from its values at all points; None if no row has an uncertainty."""
    value, parts = column.values, dict[str, Any]()
    if sources.ranges:
        sides = _range(value, moved.values, sources, parts)
    else:
        sides = _quadrature(value, moved.values, sources, parts)
    is_still = reduce(at_least, parts.values()) <= ROUNDING * absolute(value)
    lacks_value = (column.reasons != 0) | (absolute(value) == INFINITY)
    open_at = where(lacks_value, 0, _first(moved.reasons))
    is_open = is_still | lacks_value | (open_at != 0)
    if is_open is True:
        return ErrorBar(sources.type, {}, open_at=open_at) if open_at else None
    return ErrorBar(sources.type, {side: where(is_open, nan, end) for side, end in sides.items()}, parts, open_at)


def _largest(values: Any) -> float:
    """Return the largest element; a number itself."""
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
    """Return the points to which the sources move. The ξ of a material moves within its range at the point's radii."""
    if XI not in sources.given or XI not in frame.data:
        return _points_of(sources)
    shares = []
    for source in sources.entering:
        shares.append(source._replace(given=_SHARE) if XI in source.names else source)
    return [_at_share(frame, point) for point in _points_of(Sources(shares))]


_SHARE = Interval(0.5, 0.0, 1.0)  # the position within a range, on a logarithmic scale


def _at_share(frame: Frame, point: Mapping[str, Any]) -> dict[str, Any]:
    """Return a point that has ξ in place of its position within the range of the material's ξ."""
    radii = {name: point[name] for name in ("radius", "radius2") if name in point}
    displacement: Any = (frame.replace(**radii) if radii else frame).displacement
    return {**point, XI: displacement.low * (displacement.high / displacement.low) ** point[XI]}


def _points_of(sources: Sources) -> list[dict[str, Any]]:
    """Return the points of sources: those of each corner of the box of ranges, then those inside its edges.

    At a corner, each standard uncertainty moves to both of its ends, with the others at their middles. With ranges, the
    corner itself comes first; without them, the only corner is known.

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
        ratio = _ratio(source.given.low, source.given.high, otherwise=10.0)
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


def _quadrature(value: Any, moved: Any, sources: Sources, parts: dict[str, Any]) -> Mapping[str, Any]:
    """Return the two sides of a standard uncertainty, from the values at both ends of each source.

    `parts` gets the size of the change that each source causes.
    """
    changes = _changes(value, moved)
    for source, change in zip(sources.standard, changes, strict=True):
        parts[source.names[0]] = hypot(*change)
    minus, plus = _sides(changes)
    return {"minus": minus, "plus": plus}


def _changes(value: Any, moved: Any) -> list[tuple[Any, Any]]:
    """Return the changes of a value downwards and upwards for each source, from the values at both ends of each."""
    changes = []
    for one, other in _divided(moved, 2):
        low, high = at_most(one, other), at_least(one, other)
        changes.append((at_least(value - low, 0.0), at_least(high - value, 0.0)))
    return changes


def _sides(changes: Sequence[tuple[Any, Any]]) -> tuple[Any, Any]:
    """Return the changes downwards and upwards, added in quadrature; their mean if they differ by at most 10 %."""
    if not changes:
        return 0.0, 0.0
    minus, plus = (hypot(*sizes) for sizes in zip(*changes, strict=True))
    alike = absolute(plus - minus) <= ASYMMETRIC * at_least(plus, minus)
    middle = (minus + plus) / 2
    return where(alike, middle, minus), where(alike, middle, plus)


def _range(value: Any, moved: Any, sources: Sources, parts: dict[str, Any]) -> Mapping[str, Any]:
    """Return the least and the largest value at all points; a standard uncertainty extends the value at a corner.

    `parts` gets the mean width along the edges of each range, and the mean width of each standard uncertainty.
    """
    count, size = len(sources.ranges), 1 + 2 * len(sources.standard)
    corners, first = _divided(moved[: size << count], size), size << count
    least, most = value, value
    for middle, *ends in corners:
        changes = _changes(middle, ends)
        minus, plus = _sides(changes)
        least, most = at_most(least, middle - minus), at_least(most, middle + plus)
        for source, change in zip(sources.standard, changes, strict=True):
            parts[source.names[0]] = parts.get(source.names[0], 0.0) + sum(change) / len(corners)
    for number, (source, steps) in enumerate(zip(sources.ranges, _steps_of(sources), strict=True)):
        width: Any = 0
        for low_corner, high_corner in _edges(corners, count - 1 - number):
            edge = [low_corner[0], *moved[first : first + steps - 1], high_corner[0]]
            low, high = reduce(at_most, edge), reduce(at_least, edge)
            least, most, width = at_most(least, low), at_least(most, high), width + (high - low)
            first += steps - 1
        parts[source.names[0]] = width / (len(corners) / 2)
    return {"low": least, "high": most}


def _edges(corners: Sequence[Any], bit: int) -> Iterator[tuple[Any, Any]]:
    """Iterate over the pairs of corners that an edge connects. `bit`: that of the range in the number of a corner."""
    for number, corner in enumerate(corners):
        if not number >> bit & 1:
            yield corner, corners[number | 1 << bit]
