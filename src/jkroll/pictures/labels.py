"""Place texts inside axes: for marked points, contours, and bounds of regions. Sizes without a unit are in pixels."""

from collections.abc import Callable, Iterable, Sequence
from typing import Any, NamedTuple

import numpy
from matplotlib.transforms import Bbox  # type: ignore[import-not-found,unused-ignore]

from ..quantities.markup import typeset
from .picture import Mark, Style

_EDGE = 4.0  # width that the ticks take inside the frame, in points of the page
_APART = 2.0  # gap between two texts, or between a line and its name, in points of the page
_CLEAR = 4.0  # least distance of the name of a line from other lines with names, in points of the page
_ASIDE = 20.0  # weight of a distance from the contour, over that of a distance from the middle of the axes
_DOT = 3.0  # half the size of the dot of a mark, in points of the page
_STEP = 1.5  # between positions along a line, in points of the page
# Directions of a text from its dot, the best first.
_WAYS = ((0.7, 0.7), (0.7, -0.7), (-0.7, 0.7), (-0.7, -0.7), (1, 0), (-1, 0), (0, 1), (0, -1))
_REACH = (7.0, 11.0, 16.0, 22.0, 30.0, 42.0, 56.0, 75.0)  # distances of a text from its dot, in points of the page

Ground = Callable[[Any], str]  # colour of the picture in a box in pixels


class Bound(NamedTuple):
    """A line that bounds a region, with a name on the side of the region."""

    text: str
    paths: Sequence[Any]  # in data coordinates
    has: Callable[[Any], Any]  # True for positions, in pixels, that are in the region


class Labels:
    """The texts of axes, which avoid each other, the lines and the frame."""

    def __init__(self, axes: Any, style: Style, ground: Ground) -> None:
        self.axes, self.style, self.ground = axes, style, ground
        self.scale = axes.figure.dpi / 72
        self.frame = axes.get_window_extent().padded(-_EDGE * self.scale)
        self.drawn = _joined(map(self._dense, _paths_on(axes)))  # positions along all lines
        self.taken: list[Any] = []  # the boxes of dots and texts

    def of_marks(self, marks: Sequence[Mark]) -> None:
        """Draw a dot for each mark with two coordinates, its text at a free position, and a leader between them."""
        points = []
        for mark in marks:
            if mark.x is not None and mark.y is not None:
                points.append((mark.text, mark.x, mark.y))
        self.taken += [_box(self._pixels(point), _DOT * self.scale) for _, *point in points]
        steps = numpy.array([[reach * self.scale * numpy.array(way) for way in _WAYS] for reach in _REACH])
        steps = steps.reshape(-1, 2)
        for label, *point in sorted(points, key=lambda each: -each[1]):  # points on the right have the least room
            text, half = self._text(typeset(label), zorder=5)
            dot = self._pixels(point)
            middles = (dot + steps + half * numpy.sign(steps)).clip(self.frame.min + half, self.frame.max - half)
            boxes = [_box(middle, half) for middle in middles]
            free = self._free(boxes, _APART) or self._free(boxes, 0.5) or boxes
            box = min(free, key=lambda box: self._cost(box, dot))  # the first of the best boxes
            leader = numpy.array([dot, dot.clip(box.min, box.max)])
            ends = self.axes.transData.inverted().transform(leader)
            self.drawn = _joined([self.drawn, self._dense(leader)])
            self.axes.plot(*ends.T, color=self.style.ink, linewidth=0.4, zorder=3)
            look = {"color": self.style.ink, "markeredgecolor": self.style.paper, "markersize": 3.5, "zorder": 4}
            self.axes.plot(*point, "o", clip_on=False, **look)
            self._put(text, box)

    def _cost(self, box: Any, dot: Any) -> int:
        """Return the cost of a text in a box, with a leader from its dot.

        It is the sum of 3 if a line crosses the text, 1 if a line crosses the leader, and 2 for each other text or dot
        that the leader crosses.
        """
        leader = self._dense(numpy.array([dot, dot.clip(box.min, box.max)]))
        leader = leader[numpy.hypot(*(leader - dot).T) > 2 * _DOT * self.scale]
        crossed = sum(bool(other.count_contains(leader)) for other in self.taken)
        near = abs(self.drawn[None] - leader[:, None]).max(axis=2) < self.scale
        return 3 * int(box.padded(1).count_contains(self.drawn) > 0) + int(near.any()) + 2 * crossed

    def of_contours(self, texts: Sequence[str], contours: Sequence[Sequence[Any]]) -> int:
        """Write each label onto its contour, as near to the middle of the axes as possible; return how many have room.

        A label is horizontal, on a patch in the picture's colour there, so that no hatch runs through it and its minus
        sign cannot be taken for the contour.
        """
        count = 0
        every = [_joined(self._dense(self._pixels(path)) for path in paths) for paths in contours]
        middle = (self.frame.min + self.frame.max) / 2
        for label, own in zip(texts, every, strict=True):
            text, half = self._text(typeset(label), zorder=3)
            half = half + self.scale
            inside = own.clip(self.frame.min + half, self.frame.max - half)
            is_on_line = (abs(own - inside) < half - 2 * self.scale).all(axis=1)
            cost = numpy.hypot(*(inside - middle).T) + _ASIDE * numpy.hypot(*(inside - own).T)
            nearest = cost[is_on_line].argsort(kind="stable")
            boxes = [_box(position, half) for position in inside[is_on_line][nearest]]
            free = self._free(boxes)
            for lines in (self.drawn, _joined(every)):  # avoid all lines, or at least the other contours
                box = next((box for box in free if box.count_contains(lines) <= box.count_contains(own)), None)
                if box is not None:
                    break
            self._put(text, box)
            count += box is not None
        return count

    def of_bounds(self, bounds: Sequence[Bound]) -> None:
        """Write the name of each line next to it, in the region that it bounds, away from the lines of other regions.

        A line without room for its name has none.
        """
        every = [_joined(self._dense(self._pixels(path)) for path in bound.paths) for bound in bounds]
        for number, bound in enumerate(bounds):
            others = _joined([*every[:number], *every[number + 1 :]])
            text, half = self._text(typeset(bound.text), zorder=3)
            boxes = []
            for path in bound.paths:
                for box in self._free(self._next_to(self._dense(self._pixels(path)), half, bound.has)):
                    if bound.has(numpy.array([*box.corners(), (box.min + box.max) / 2])).all():
                        boxes.append(box)
            boxes = [box for box in boxes if not box.padded(_CLEAR * self.scale).count_contains(others)]
            crossings = [box.padded(1).count_contains(self.drawn) for box in boxes]
            self._put(text, boxes[int(numpy.argmin(crossings))] if boxes else None)

    def _next_to(self, path: Any, half: Any, has: Callable[[Any], Any]) -> Iterable[Any]:
        """Iterate over boxes in the frame next to a path, on the side of its region, from its middle outwards."""
        along = numpy.diff(path, axis=0)
        across = numpy.stack([-along[:, 1], along[:, 0]], axis=1)
        across /= numpy.maximum(numpy.hypot(*across.T), 1e-12)[:, None]
        middles = (path[1:] + path[:-1]) / 2
        across *= numpy.where(has(middles + self.scale * across), 1, -1)[:, None]
        reach = (abs(across) * half).sum(axis=1) + _APART * self.scale
        positions = middles + reach[:, None] * across
        for position in positions[abs(numpy.arange(len(positions)) - len(positions) / 2).argsort(kind="stable")]:
            if (position - half >= self.frame.min).all() and (position + half <= self.frame.max).all():
                yield _box(position, half)

    def _free(self, boxes: Iterable[Any], apart: float = _APART) -> list[Any]:
        """Return the boxes that are clear of the existing dots and texts."""
        return [box for box in boxes if not any(map(box.padded(apart * self.scale).overlaps, self.taken))]

    def _pixels(self, points: Any) -> Any:
        return self.axes.transData.transform(points)

    def _dense(self, points: Any) -> Any:
        """Return positions at equal distances along a line of points."""
        lengths = numpy.hypot(*numpy.diff(points, axis=0).T)
        along = numpy.concatenate([[0.0], numpy.cumsum(lengths)])
        steps = numpy.linspace(0, along[-1], int(along[-1] / (_STEP * self.scale)) + 2)
        return numpy.stack([numpy.interp(steps, along, of_axis) for of_axis in numpy.asarray(points).T], axis=1)

    def _text(self, label: str, zorder: int) -> tuple[Any, Any]:
        """Return a new text, centred on its position, and half its size."""
        text = self.axes.text(0.5, 0.5, label, ha="center", va="center", zorder=zorder)
        return text, text.get_window_extent().size / 2

    def _put(self, text: Any, box: Any) -> None:
        """Put a text into a box, on a patch in the picture's colour; remove the text if there is no box."""
        if box is None:
            text.remove()
            return
        middle = (box.min + box.max) / 2
        text.set_position(self.axes.transData.inverted().transform(middle))
        text.set_bbox({"boxstyle": "square,pad=0.05", "linewidth": 0, "facecolor": self.ground(box)})
        self.taken.append(box)


def _paths_on(axes: Any) -> Iterable[Any]:
    """Iterate over the lines on axes, in pixels, including those in collections without a fill."""
    for line in axes.lines:
        yield line.get_transform().transform_path(line.get_path()).vertices
    for collection in axes.collections:
        if not collection.get_facecolor().size:
            for path in collection.get_paths():
                yield axes.transData.transform(path.vertices)


def _joined(paths: Iterable[Any]) -> Any:
    return numpy.concatenate([*paths, numpy.empty((0, 2))])


def _box(middle: Any, half: Any) -> Any:
    """Return the box around its middle; `half`: half its width and height."""
    return Bbox([middle - half, middle + half])
