"""Texts inside the axes of a page: the labels of contours, and the texts of marked points.

The places of everything else must be final: what is free is measured in pixels.
"""

from collections.abc import Sequence
from typing import Any

import numpy
from matplotlib.transforms import Bbox  # type: ignore[import-not-found,unused-ignore]

from ..quantities.markup import typeset
from .maps import Mark
from .styles import Style

_EDGE = 4.0  # points of the page inside the frame that its ticks take
_ASIDE = 20.0  # times as far as it is from its line, a label may be from the middle
_DIRECTIONS = ((0.7, 0.7), (0.7, -0.7), (-0.7, 0.7), (-0.7, -0.7), (1, 0), (-1, 0), (0, 1), (0, -1))  # the best first
_REACH = (4.0, 8.0, 14.0, 20.0, 30.0, 42.0)  # from a point to its text, in points of the page
_PATCH = {"boxstyle": "square,pad=0", "linewidth": 0}  # of paper, behind a text on lines
_NEAR = 8.0  # a text that is farther has a line to its point


def label_points(axes: Any, marks: Sequence[Mark], style: Style) -> list[Any]:
    """Draw marked points with their texts, where these cover least; return boxes that keep other texts off."""
    scale, lines = axes.figure.dpi / 72, _points_of_lines(axes)
    frame = axes.get_window_extent().padded(-_EDGE * scale)
    points = [(mark.text, (mark.x, mark.y)) for mark in marks if mark.x is not None and mark.y is not None]
    points.sort(key=lambda point: point[1], reverse=True)  # those on the right have the least room
    dots = [_box(axes.transData.transform(place), 3 * scale) for _, place in points]
    taken = [*dots]
    for (label, place), dot in zip(points, dots, strict=True):
        axes.plot(*place, "o", color=style.ink, markeredgecolor=style.paper, markersize=3.5, clip_on=False, zorder=4)
        text = axes.annotate(typeset(label), place, xytext=(0, 0), textcoords="offset points", zorder=5)
        others = [box for box in taken if box is not dot]

        def leader(way: tuple[float, float], text: Any = text, dot: Any = dot) -> list[Any]:
            """Return boxes along the line from the point to its text, if that is far, or nearer to another point."""
            box, centres = text.get_window_extent(), {id(each): (each.min + each.max) / 2 for each in dots}
            far = {
                key: numpy.hypot(*(numpy.clip(centre, box.min, box.max) - centre)) for key, centre in centres.items()
            }
            if max(map(abs, way)) <= _NEAR and far[id(dot)] == min(far.values()):
                return []
            steps = (numpy.array(text.get_position()) * share * scale for share in (0.3, 0.5, 0.7))
            return [_box(centres[id(dot)] + step, scale) for step in steps]

        def faults(way: tuple[float, float], text: Any = text, others: Any = others, dot: Any = dot) -> tuple[Any, ...]:
            """Return how much speaks against a place, the weightiest first."""
            _move(text, way, frame)
            box = text.get_window_extent()
            texts = sum(box.padded(scale).overlaps(other) for other in others) + box.overlaps(dot)
            crossed = sum(step.overlaps(other) for step in leader(way) for other in others)
            return (
                frame.padded(_EDGE * scale).count_contains(box.corners()) < 4,
                texts + crossed,
                _count(box.padded(1), lines) > 0,
            )

        best = min([(reach * right, reach * up) for reach in _REACH for right, up in _DIRECTIONS], key=faults)
        if any(faults(best)):  # no free place
            text.set_bbox({**_PATCH, "facecolor": style.paper})
        taken += [text.get_window_extent(), *leader(best)]
        if leader(best):
            arrow = {"arrowstyle": "-", "linewidth": 0.4, "color": style.ink, "shrinkA": 2, "shrinkB": 2}
            axes.annotate("", place, xytext=text.get_position(), textcoords="offset points", arrowprops=arrow)
    return [box.padded(3 * scale) for box in taken]


def _move(text: Any, way: tuple[float, float], frame: Any) -> None:
    """Put a text so far from its point, in points of the page, and to the side into the frame."""
    sides = [(step > 0) - (step < 0) for step in way]
    text.set(position=way, ha=("center", "left", "right")[sides[0]], va=("center", "bottom", "top")[sides[1]])
    box = text.get_window_extent()
    shift = max(frame.x0 - box.x0, 0) or min(frame.x1 - box.x1, 0)
    text.set_position((way[0] + shift * 72 / text.figure.dpi, way[1]))


def label_contours(
    axes: Any, contours: Any, texts: Sequence[str], middle: tuple[float, float], taken: list[Any], style: Style
) -> None:
    """Write each label horizontally onto its contour, at the free place nearest to the middle.

    It stands on a patch of paper, so that no hatch runs through it and its minus sign cannot be taken for the contour.
    Where it must be, for the frame, the line runs through it beside its middle. A contour without room has no label.
    """
    frame, centre, lines = axes.get_window_extent(), axes.transAxes.transform(middle), _points_of_lines(axes)
    paths = [axes.transData.transform(path.vertices) for path in contours.get_paths()]
    for number, (label, path) in enumerate(zip(texts, paths, strict=True)):
        text = axes.text(0.5, 0.5, f" {typeset(label)} ", ha="center", va="center", zorder=3)
        text.set_bbox({**_PATCH, "facecolor": style.paper})
        half = text.get_window_extent().size / 2
        inside = numpy.clip(path, frame.min + half, frame.max - half)
        is_on_line = (abs(path - inside) < half).all(axis=1)
        cost = numpy.hypot(*(inside - centre).T) + _ASIDE * numpy.hypot(*(inside - path).T)
        places = [_box(place, half) for place in inside[is_on_line][cost[is_on_line].argsort(kind="stable")]]
        others = numpy.concatenate([*paths[:number], *paths[number + 1 :], lines[:0]])
        free = [box for box in places if not _count(box, others) and not any(map(box.overlaps, taken))]
        clear = (box for box in free if _count(box, lines) <= _count(box, path))  # of other lines, such as borders
        if (box := next(clear, free[0] if free else None)) is None:
            text.remove()
        else:
            text.set_position(axes.transData.inverted().transform((box.min + box.max) / 2))
            taken.append(box)


def _points_of_lines(axes: Any) -> Any:
    """Return points along all lines on axes, in pixels. Those of contours are close to each other as they are."""
    paths = [line.get_transform().transform_path(line.get_path()) for line in axes.lines]
    parts = [path.interpolated(200 // max(1, len(path.vertices)) + 1).vertices for path in paths]
    contours = (drawing for drawing in axes.collections if not getattr(drawing, "filled", False))
    parts += [axes.transData.transform(path.vertices) for drawing in contours for path in drawing.get_paths()]
    return numpy.concatenate([*parts, numpy.empty((0, 2))])


def _count(box: Any, points: Any) -> int:
    """Return how many points a box covers."""
    return int(((points > box.min) & (points < box.max)).all(axis=1).sum())


def _box(place: Any, half: Any) -> Any:
    """Return the box around a place."""
    return Bbox([place - half, place + half])
