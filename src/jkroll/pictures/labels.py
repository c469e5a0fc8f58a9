"""Place texts inside axes where they cover neither lines nor each other.

The places of everything else must be final: what is free is measured in pixels.
"""

from collections.abc import Iterator, Sequence
from itertools import pairwise
from typing import Any

from matplotlib.patheffects import withStroke  # type: ignore[import-not-found,unused-ignore]
from matplotlib.transforms import Bbox  # type: ignore[import-not-found,unused-ignore]

from .axes import Axis
from .maps import Map, Mark, Panel
from .page_axes import CONTOURS, PRINTED, typeset
from .styles import Style

_STEP = 1.5  # between points of lines that are to be kept free, in points of the page
_APART = 3.0  # the least distance of the texts of ticks, in points of the page
_ASIDE = 20.0  # times as far as it is from its line, a label may be from the middle
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
        first.get_window_extent().padded(_APART * axes.figure.dpi / 72).overlaps(second.get_window_extent())
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
        boxes.append(_box(axes.transData.transform(at), radius))
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
        text = axes.annotate(typeset(label), at, xytext=(0, 0), textcoords="offset points", zorder=5)
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
    covered = _covered(box.padded(1), lines)
    is_outside = box.x0 < frame.x0 or box.x1 > frame.x1 or box.y0 < frame.y0 or box.y1 > frame.y1
    return float(covered + 1000 * sum(box.overlaps(other) for other in boxes) + 10_000 * is_outside)


def _lines_of(axes: Any) -> Any:
    """Return points along all lines that are drawn on the axes, in pixels."""
    import numpy

    paths = [(line.get_path(), line.get_transform()) for line in axes.lines]
    paths += [(path, one.get_transform()) for one in axes.collections for path in one.get_paths() if _has_line(one)]
    step = _STEP * axes.figure.dpi / 72
    parts = [_dense(vertices, step) for path, transform in paths for vertices in _segments(path, transform)]
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


def _dense(vertices: Any, step: float) -> Any:
    """Return points along a line at most `step` apart."""
    import numpy

    if len(vertices) < 2:
        return numpy.empty((0, 2))
    lengths = numpy.concatenate([[0.0], numpy.cumsum(numpy.hypot(*numpy.diff(vertices, axis=0).T))])
    places = numpy.linspace(0, lengths[-1], max(2, int(lengths[-1] / step) + 1))
    return numpy.column_stack([numpy.interp(places, lengths, part) for part in vertices.T])


def _label_contours(
    axes: Any,
    contours: Any,
    labels: Sequence[str],
    middle: tuple[float, float],
    lines: Any,
    boxes: list[Any],
    style: Style,
) -> None:
    """Write each label horizontally onto its contour, at the free place nearest to the middle.

    It stands on a patch of paper, so that no hatch runs through it and its minus sign cannot be taken for the contour.
    """
    import numpy

    step = _STEP * axes.figure.dpi / 72
    parts = [
        numpy.concatenate([*(_dense(one, step) for one in _segments(path, contours.get_transform())), lines[:0]])
        for path in contours.get_paths()
    ]
    centre = axes.transData.transform(middle)
    for number, (label, own) in enumerate(zip(labels, parts, strict=True)):
        text = _on_paper(axes, label, style)
        half = text.get_window_extent().size / 2
        places = _places(own, centre, half, axes.get_window_extent())
        others = numpy.concatenate([*parts[:number], *parts[number + 1 :], lines[:0]])
        free = (
            place
            for obstacles, allowed in ((lines, own), (others, lines[:0]))  # of no line, or else of no other contour
            for place in places
            if _is_free(_box(place, half), obstacles, allowed, boxes)
        )
        if (place := next(free, None)) is None:
            text.remove()
        else:
            text.set_position(axes.transData.inverted().transform(place))
            boxes.append(_box(place, half))


def _on_paper(axes: Any, label: str, style: Style) -> Any:
    """Return a text on a patch of paper, which is placed later."""
    patch = {"boxstyle": "square,pad=0", "facecolor": style.paper, "linewidth": 0}
    return axes.text(0.5, 0.5, f" {typeset(label)} ", ha="center", va="center", zorder=3, bbox=patch)


def _places(own: Any, centre: Any, half: Any, frame: Any) -> Any:
    """Return the places at which a box on a line is within the frame, those nearest to the centre first.

    Where it must be, for the frame, the line runs through the box beside its middle.
    """
    import numpy

    inside = numpy.clip(own, frame.min + half, frame.max - half)
    on_line = (abs(own - inside) < half).all(axis=1)
    cost = numpy.hypot(*(inside - centre).T) + _ASIDE * numpy.hypot(*(inside - own).T)
    return inside[on_line][numpy.argsort(cost[on_line], kind="stable")]


def _is_free(box: Any, lines: Any, own: Any, boxes: Sequence[Any]) -> bool:
    """Return True if a box covers no text and no line but its own."""
    return not any(box.overlaps(other) for other in boxes) and _covered(box, lines) <= _covered(box, own)


def _covered(box: Any, points: Any) -> int:
    """Return how many points a box covers."""
    return int(((points > box.min) & (points < box.max)).all(axis=1).sum())


def _box(place: Any, half: Any) -> Any:
    """Return the box around a place."""
    return Bbox([place - half, place + half])
