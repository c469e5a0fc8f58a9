"""Place texts inside axes where they cover neither lines nor each other.

The places of everything else must be final: what is free is measured in pixels.
"""

from collections.abc import Iterator, Sequence
from itertools import pairwise
from math import cos, sin
from typing import Any

from matplotlib.patheffects import withStroke  # type: ignore[import-not-found,unused-ignore]
from matplotlib.transforms import Bbox  # type: ignore[import-not-found,unused-ignore]

from ..quantities.nomenclature import INFINITY
from .axes import Axis
from .maps import Map, Mark, Panel
from .page_axes import CONTOURS, OUTLINE, PRINTED, typeset
from .styles import SMALL, Style

_STEP = 1.5  # between points of lines that are to be kept free, in points of the page
_PADDING = 1.5
_SPACING = 3  # between a contour and its label
# Directions from a point to its text, in the order of preference.
_DIRECTIONS = ((1, 1), (1, -1), (-1, 1), (-1, -1), (1, 0), (-1, 0), (0, 1), (0, -1))
_REACH = (4.0, 8.0, 14.0, 20.0)  # from a point to its text, in points of the page


def label_map(axes: Any, drawn: Map, style: Style) -> None:
    """Write the texts of contours and of marked points into a drawn map. A contour without room stays without a label."""
    lines = _lines_of(axes)
    boxes = _draw_points(axes, drawn.x, drawn.y, drawn.marks, style)
    labels = [level.text for level in drawn.levels()]
    for gid, middle in ((CONTOURS, (0.5, 0.5)), (PRINTED, (0.75, 0.5))):
        for contours in (one for one in axes.collections if one.get_gid() == gid):
            _label_contours(axes, contours, labels, middle, lines, boxes, style)
    _label_points(axes, drawn.x, drawn.y, drawn.marks, lines, boxes, style)


def thin_out(axes: Any) -> None:
    """Leave out every second text of the ticks across, and again, until they do not touch."""
    labels = [label for label in axes.get_xticklabels() if label.get_text()]
    while len(labels) > 2 and any(
        first.get_window_extent().padded(_PADDING * axes.figure.dpi / 72).overlaps(second.get_window_extent())
        for first, second in pairwise(labels)
    ):
        for label in labels[1::2]:
            label.set_visible(False)
        labels = labels[::2]


def label_panel(axes: Any, panel: Panel, style: Style) -> None:
    """Write the texts of marked points into a drawn panel."""
    lines = _lines_of(axes)
    boxes = _draw_points(axes, panel.x, panel.y, panel.points, style)
    _label_points(axes, panel.x, panel.y, panel.points, lines, boxes, style)


def _draw_points(axes: Any, x: Axis, y: Axis, marks: Sequence[Mark], style: Style) -> list[Any]:
    """Draw a dot at each marked point; return the boxes of the dots."""
    radius = 3 * axes.figure.dpi / 72
    boxes = []
    for _, at in _points(x, y, marks):
        axes.plot(*at, "o", zorder=4, markersize=3.5, color=style.ink, markeredgecolor=style.paper, markeredgewidth=0.6)
        boxes.append(_bounds(axes.transData.transform(at), (radius, radius)))
    return boxes


def _points(x: Axis, y: Axis, marks: Sequence[Mark]) -> Iterator[tuple[str, tuple[float, float]]]:
    """Iterate over the marks that are points: text and place."""
    for mark in marks:
        if mark.x is not None and mark.y is not None:
            yield mark.text, (float(x.place(mark.x)), float(y.place(mark.y)))


def _label_points(
    axes: Any, x: Axis, y: Axis, marks: Sequence[Mark], lines: Any, boxes: list[Any], style: Style
) -> None:
    """Write the text of each point on the side where it covers least, with a line to the point if it stands far off."""
    frame = axes.get_window_extent()
    places = [(right, up, reach) for reach in _REACH for right, up in _DIRECTIONS]
    for label, at in _points(x, y, marks):
        text = axes.annotate(typeset(label), at, xytext=(0, 0), textcoords="offset points", fontsize=SMALL, zorder=5)
        costs = []
        for place in places:
            _move(text, *place)
            costs.append(_cost(text.get_window_extent(), lines, boxes, frame))
        if min(costs) > 0:  # no free place: lines are kept off by a rim
            text.set_path_effects([withStroke(linewidth=2, foreground=style.paper)])
        best = places[costs.index(min(costs))]
        _move(text, *best)
        boxes.append(text.get_window_extent())
        if best[2] > _REACH[1]:
            leader = {"arrowstyle": "-", "linewidth": 0.4, "color": style.ink, "shrinkA": 0, "shrinkB": 2}
            axes.annotate("", at, xytext=text.get_position(), textcoords="offset points", arrowprops=leader)


def _move(text: Any, right: int, up: int, reach: float) -> None:
    """Put a text beside its point."""
    shorter = reach * (0.7 if right and up else 1.0)
    text.set(
        position=(right * shorter, up * shorter),
        ha={1: "left", 0: "center", -1: "right"}[right],
        va={1: "bottom", 0: "center", -1: "top"}[up],
    )


def _cost(box: Any, lines: Any, boxes: Sequence[Any], frame: Any) -> float:
    """Return how much a box covers: points of lines, other boxes, and the room beyond the frame."""
    x, y = lines.T
    covered = ((x > box.x0 - 1) & (x < box.x1 + 1) & (y > box.y0 - 1) & (y < box.y1 + 1)).sum()
    is_outside = box.x0 < frame.x0 or box.x1 > frame.x1 or box.y0 < frame.y0 or box.y1 > frame.y1
    return float(covered + 1000 * sum(box.overlaps(other) for other in boxes) + 10_000 * is_outside)


def _lines_of(axes: Any) -> Any:
    """Return points along all lines that are drawn on the axes, in pixels."""
    import numpy

    paths = [(line.get_path(), line.get_transform()) for line in axes.lines]
    paths += [(path, one.get_transform()) for one in axes.collections for path in one.get_paths() if _has_line(one)]
    step = _STEP * axes.figure.dpi / 72
    parts = [_dense(vertices, step)[0] for path, transform in paths for vertices in _segments(path, transform)]
    return numpy.concatenate([*parts, numpy.empty((0, 2))])


def _has_line(collection: Any) -> bool:
    """Return True if a collection draws lines, not areas alone."""
    return not getattr(collection, "filled", False) or len(collection.get_edgecolor()) == 1


def _segments(path: Any, transform: Any) -> list[Any]:
    """Return the connected lines of a path, in pixels."""
    import numpy

    if not len(path.vertices):
        return []
    vertices = transform.transform(path.vertices)
    starts: Any = [] if path.codes is None else numpy.flatnonzero(path.codes == path.MOVETO)[1:]
    return [part[numpy.isfinite(part).all(axis=1)] for part in numpy.split(vertices, starts)]


def _dense(vertices: Any, step: float) -> tuple[Any, Any]:
    """Return points along a line at most `step` apart, and their distances along the line."""
    import numpy

    if len(vertices) < 2:
        return numpy.empty((0, 2)), numpy.empty(0)
    lengths = numpy.concatenate([[0.0], numpy.cumsum(numpy.hypot(*numpy.diff(vertices, axis=0).T))])
    places = numpy.linspace(0, lengths[-1], max(2, int(lengths[-1] / step) + 1))
    return numpy.column_stack([numpy.interp(places, lengths, part) for part in vertices.T]), places


def _label_contours(
    axes: Any,
    contours: Any,
    labels: Sequence[str],
    middle: tuple[float, float],
    lines: Any,
    boxes: list[Any],
    style: Style,
) -> None:
    """Break each contour where its label covers least, nearest to the middle, and write it into the gap, or else beside the contour.

    Labels are horizontal: along a contour that falls, a minus sign would look like a piece of it.
    """
    import numpy

    scale = axes.figure.dpi / 72
    centre = axes.transData.transform(middle)
    places, texts = [], {}
    paths = [_segments(path, contours.get_transform()) for path in contours.get_paths()]
    for level, label, segments in zip(contours.levels, labels, paths, strict=True):
        texts[float(level)] = typeset(label)
        width, height = _size(axes, texts[float(level)])
        own = numpy.concatenate([_dense(vertices, _STEP * scale)[0] for vertices in segments] or [numpy.empty((0, 2))])
        found = [place for vertices in segments for place in _places(vertices, width, scale)]
        found.sort(key=lambda place: float(numpy.hypot(*(place[0] - centre))))
        half = width / 2 + 2 * _PADDING * scale, height / 2 + _PADDING * scale
        covered = [_covered(axes, place, half, lines, own, boxes) for place, _ in found]
        if covered and (least := min(covered)) < INFINITY:
            place, _ = found[covered.index(least)]
            places.append(axes.transData.inverted().transform(place))
            boxes.append(_bounds(place, half))
        else:
            _label_beside(axes, texts[float(level)], found, half, lines, boxes)
    if places:
        for text in axes.clabel(
            contours, fmt=texts, manual=places, fontsize=SMALL, inline_spacing=_SPACING, colors=style.ink
        ):
            text.set_rotation(0)


def _label_beside(
    axes: Any, text: str, found: Sequence[tuple[Any, float]], half: tuple[float, float], lines: Any, boxes: list[Any]
) -> None:
    """Write a label beside a contour, on the side and at the place where it covers least, if there is room."""
    import numpy

    outlines = [one.get_paths()[0] for one in axes.collections if one.get_gid() == OUTLINE]
    best: tuple[float, Any] = INFINITY, None
    for line, angle in found:
        across = numpy.array([-sin(angle), cos(angle)])
        reach = abs(across) @ half + 1
        for place in (line + reach * across, line - reach * across):
            at = axes.transData.inverted().transform(place)
            is_outside = outlines and not outlines[0].contains_point(at)
            covered = INFINITY if is_outside else _covered(axes, place, half, lines, lines[:0], boxes)
            best = min(best, (covered, place), key=lambda each: each[0])
    if best[0] < INFINITY:
        boxes.append(_bounds(best[1], half))
        axes.text(*axes.transData.inverted().transform(best[1]), text, ha="center", va="center", fontsize=SMALL)


def _size(axes: Any, text: str) -> tuple[float, float]:
    """Return the width and height of a text in pixels."""
    probe = axes.figure.text(0, 0, text, fontsize=SMALL)
    box = probe.get_window_extent()
    probe.remove()
    return box.width, box.height


def _places(vertices: Any, width: float, scale: float) -> list[tuple[Any, float]]:
    """Return places on a line at which it is nearly straight over the width of a label, and its angles there."""
    import numpy

    points, along = _dense(vertices, _STEP * scale)
    found = []
    for number in range(0, len(points), 2):
        first, last = numpy.searchsorted(along, [along[number] - width / 2, along[number] + width / 2])
        if first == 0 or last == len(points):
            continue
        across, up = points[last] - points[first]
        if numpy.hypot(across, up) > 0.95 * (along[last] - along[first]):
            found.append((points[number], float(numpy.arctan2(up, across))))
    return found


def _covered(axes: Any, place: Any, half: tuple[float, float], lines: Any, own: Any, boxes: Sequence[Any]) -> float:
    """Return how much a box covers of other lines than its own; infinite if it leaves the axes or covers another text."""
    bounds, frame = _bounds(place, half), axes.get_window_extent()
    is_outside = bounds.x0 < frame.x0 or bounds.x1 > frame.x1 or bounds.y0 < frame.y0 or bounds.y1 > frame.y1
    if is_outside or any(bounds.overlaps(box) for box in boxes):
        return INFINITY
    inside, of_own = (int((abs(points - place) < half).all(axis=1).sum()) for points in (lines, own))
    return inside - of_own


def _bounds(place: Any, half: tuple[float, float]) -> Any:
    """Return the box around a place."""
    return Bbox.from_extents(place[0] - half[0], place[1] - half[1], place[0] + half[0], place[1] + half[1])
