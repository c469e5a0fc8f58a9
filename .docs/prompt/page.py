"""Draw pictures as SVG in the prompt, in place of `jkroll.pictures.page`: the prompt lacks matplotlib.

The names of limits are in the legend only.
"""

from collections.abc import Iterator, Sequence
from itertools import cycle, pairwise
from math import ceil, floor, isfinite, log10
from re import Match, sub
from textwrap import wrap
from typing import Any, NamedTuple
from xml.sax.saxutils import escape

import numpy

from jkroll.errors import missing_extra
from jkroll.pictures.bands import band_of, spacing
from jkroll.pictures.picture import (
    SAME,
    STYLES,
    Axis,
    Field,
    Panel,
    Picture,
    Style,
    described,
    evaluate,
    extended,
    extent,
    is_flat,
    over,
)
from jkroll.pictures.picture_as_text import shown_values
from jkroll.quantities.markup import plain
from jkroll.quantities.units import RAISED
from jkroll.text import NO_BREAK_SPACE, with_units_joined

WIDTH, HEIGHT = 330, 250  # of axes
LEFT, RIGHT, TOP, BOTTOM = 88, 22, 30, 44  # margins around the axes
LINE = 15  # height of a line of text
LETTER = 6.0  # width of a letter, on average
LEGEND_LETTERS = 58  # largest number of letters in a line of a legend
SLOPE = 0.87  # height of a sloping text above the axes, over its length
COLUMNS = 2  # largest number of panels in a row
DASHES = ("", "7 3", "7 3 2 3", "2 3", "7 3 2 3 2 3", "12 4")
DOTS = "1 2"  # dashes of a line that stands for measured points
TICKS, CONTOURS = 5, 9  # largest numbers: of ticks on an axis, of contours on a map
THIN, THICK = 0.9, 1.5  # widths of contours
MESH, FINE = 121, 401  # points along each side of a map: for its values, and to find the edge of a part without values
COARSE = 41  # points along each side for best ranges, if inputs have error bars
FARTHEST = 20.0  # an infinite end of a best range is drawn at least this far from every contour
FAR_OUTSIDE = 9e3  # largest coordinate of a line that leaves the axes
# The lines of a hatch in a square of size 1, by its sign; the more often the sign is repeated, the smaller the square.
HATCHES = {"|": "M.5,0v1", "-": "M0,.5h1", "/": "M-.5,.5l1,-1M0,1l1,-1M.5,1.5l1,-1", ".": "M.5,.5h0"}
HATCH = 20  # size of the square of a sign that is not repeated
ASIDE = 20  # cost of a distance from the contour, over that of a distance from the middle of the axes

_Point = tuple[float, float]


def draw(
    drawn: Picture, file_format: str, _: float | None, style: str, *, has_caption: bool = True, command: str = ""
) -> bytes:
    """Return a picture as the content of an SVG file, which a page scales to its width; PDF and PNG need matplotlib."""
    if file_format != "svg":
        with missing_extra("plot"):
            import matplotlib  # type: ignore[import-not-found,unused-ignore]  # noqa: F401
    look = STYLES[style]
    drawings = [_Axes(panel, look, f"panel{number}") for number, panel in enumerate(drawn.panels)]
    columns = min(len(drawings), COLUMNS)
    width, y = columns * (LEFT + WIDTH + RIGHT), LINE * bool(drawn.title)
    body = [_text(width / 2, LINE, drawn.title, "middle")] if drawn.title and has_caption else []
    for row in (drawings[first : first + columns] for first in range(0, len(drawings), columns)):
        top = max(drawing.top for drawing in row)
        for column, drawing in enumerate(row):
            x = column * (LEFT + WIDTH + RIGHT) + LEFT
            body.append(f'<g transform="translate({x},{y + top})">{"".join(drawing.parts())}</g>')
        y += top + max(drawing.height for drawing in row) + LINE
    for text in (" ".join(drawn.caption), *drawn.doubts) if has_caption else ():
        for line in _wrapped(text, int(width / LETTER)):
            y += LINE
            body.append(_text(8, y, line))
    title = plain(drawn.title or "; ".join(panel.title for panel in drawn.panels) or "picture")
    about = f"<title>{escape(title)}</title><desc>{escape(plain(' '.join(drawn.caption)))} {escape(command)}</desc>"
    size = f'viewBox="0 0 {width} {y + LINE}" width="{width}" height="{y + LINE}"'
    font = f'font-family="STIX Two Text, Times New Roman, serif" font-size="13" fill="{look.ink}"'
    paper = f'<rect width="100%" height="100%" fill="{look.paper}"/>'
    svg = f'<svg xmlns="http://www.w3.org/2000/svg" {size} role="img" {font}>{about}{paper}{"".join(body)}</svg>\n'
    return svg.encode()


class _Key(NamedTuple):
    """A text of a legend, and the SVG attributes of the line and the box before it; empty without a line or a box."""

    text: str
    line: str = ""
    box: str = ""

    def drawn(self, y: float) -> str:
        """Return the line and the box before the text, at a height."""
        box = f'<rect y="{y - 9:g}" width="26" height="10" {self.box}/>' if self.box else ""
        return box + (f'<path d="M0,{y - 4:g}h26" fill="none" {self.line}/>' if self.line else "")


class _Axes:
    """A panel, with the lines of its legend."""

    def __init__(self, panel: Panel, style: Style, name: str) -> None:
        self.panel, self.style, self.name = panel, style, name
        spans = [axis.high - axis.low for axis in (panel.x, panel.y)]
        self.high = round(WIDTH * spans[1] / spans[0]) if panel.is_true_to_scale else HEIGHT
        self.keys: dict[str, _Key] = {}
        self.taken: list[tuple[float, float, float]] = []  # of each text inside: x and y of its middle, half its width
        self.marks = [*self._marks()]
        self.texts: list[str] = []  # of contours
        on_top = [len(plain(mark.text)) for mark in panel.marks if mark.y is None]
        self.top = TOP + SLOPE * LETTER * max(on_top, default=0)
        self.inner = [*(self._field(panel.field) if panel.field else self._curves()), *self._arrows()]
        self.legend: list[tuple[_Key | None, str]] = []  # the lines of all texts, the first of each with its key
        for key in self.keys.values():
            for number, line in enumerate(_wrapped(key.text, LEGEND_LETTERS)):
                self.legend.append((key if number == 0 else None, line))
        self.height = self.high + BOTTOM + LINE * len(self.legend)

    def parts(self) -> Iterator[str]:
        """Iterate over the parts of the panel: the content of the axes, ticks, marks, legend."""
        yield f'<clipPath id="{self.name}"><rect width="{WIDTH}" height="{self.high}"/></clipPath>'
        yield f'<g clip-path="url(#{self.name})">{"".join(self.inner)}</g>'
        yield _text(WIDTH / 2, TOP - 10 - self.top, self.panel.title, "middle")
        if self.panel.has_axes:
            yield f'<rect width="{WIDTH}" height="{self.high}" fill="none" stroke="{self.style.ink}"/>'
            yield from self._ticks()
        yield from (*self.texts, *self.marks)
        for number, (key, line) in enumerate(self.legend):
            y = self.high + BOTTOM + LINE * (number + 0.5)
            yield (key.drawn(y) if key is not None else "") + _text(32, y, line)

    def place(self, x: Any, y: Any) -> tuple[Any, Any]:
        """Return the positions on the picture of values on both axes."""
        return WIDTH * _share(self.panel.x, x), self.high * (1 - _share(self.panel.y, y))

    def _path(self, x: Any, y: Any) -> str:
        """Return the line through points as path data, with a gap where a point has no place."""
        parts, pen = [], "M"
        for point in zip(*self.place(numpy.asarray(x), numpy.asarray(y)), strict=True):
            is_known = all(map(isfinite, point))
            if is_known:
                across, down = numpy.clip(point, -FAR_OUTSIDE, FAR_OUTSIDE)
                parts.append(f"{pen}{across:.1f},{down:.1f}")
            pen = "L" if is_known else "M"
        return "".join(parts)

    def _curves(self) -> Iterator[str]:
        for curve in self.panel.curves:
            text = ": ".join(filter(None, (curve.text, curve.key)))
            colour = self.style.lines[curve.colour % len(self.style.lines)]
            dashes = DASHES[1] if curve.is_dashed else DASHES[len(self.keys) % len(DASHES)]
            if curve.has_points:
                dashes = DOTS
            pale = f'fill="{colour}" opacity="0.22"' if curve.band else ""
            key = self.keys.setdefault(text, _Key(text, _stroke(colour, dashes, 1.6), pale))
            if curve.band is not None:
                ends = [
                    numpy.clip(end, self.panel.y.low, self.panel.y.high) for end in (curve.band.low, curve.band.high)
                ]
                known = numpy.isfinite(ends[0]) & numpy.isfinite(ends[1])
                x, low, high = (values[known] for values in (curve.x, *ends))
                around = self._path([*x, *x[::-1]], [*low, *high[::-1]])
                yield f'<path d="{around}Z" {pale}/>'
            if len(curve.x) == 1:
                ((x, y),) = zip(*self.place(curve.x, curve.y), strict=True)
                yield f'<circle cx="{x:.1f}" cy="{y:.1f}" r="3.5" fill="{colour}"/>'
            else:
                yield f'<path d="{self._path(curve.x, curve.y)}" fill="none" {key.line}/>'

    def _arrows(self) -> Iterator[str]:
        for arrow in self.panel.arrows:
            (x0, y0), (x1, y1) = self.place(*arrow.start), self.place(*arrow.stop)
            bend_x, bend_y = (x0 + x1) / 2 - arrow.bend * (y1 - y0), (y0 + y1) / 2 + arrow.bend * (x1 - x0)
            yield f'<path d="M{x0:.1f},{y0:.1f}Q{bend_x:.1f},{bend_y:.1f} {x1:.1f},{y1:.1f}" fill="none" '
            yield f"{_stroke(self.style.ink, '', 1)}/>"
            ends = [(x1, y1, bend_x, bend_y), (x0, y0, bend_x, bend_y)][: arrow.ends]
            yield from (_head(*end, self.style.ink) for end in ends)
            x, y = self.place(*arrow.text_at)
            yield _text(x, y + 4, arrow.text, "middle")

    def _field(self, field: Field) -> Iterator[str]:
        x, y = (axis._replace(size=MESH) for axis in (self.panel.x, self.panel.y))
        scaled: Any = numpy.log10 if field.is_log else numpy.asarray
        with numpy.errstate(invalid="ignore", divide="ignore"):
            values: Any = scaled(evaluate(field.frame, field.quantity, x, y))
        known, around = numpy.isfinite(values), extended(values)
        ends = Axis(field.quantity, *extent(field.values), is_log=field.is_log)
        levels = [] if is_flat(field.values) else _round_values(ends, CONTOURS)
        heights = [float(scaled(level)) for level in levels]
        bounds = [numpy.nanmin(around) - 1, *heights, numpy.nanmax(around) + 1]
        for colour, (low, high) in zip(_between(self.style.scale, len(bounds) - 1), pairwise(bounds), strict=True):
            inside = numpy.minimum(around - low, high - around)
            yield self._area(inside, f'fill="{colour}" shape-rendering="crispEdges"')
        regions = [*self._regions(field, known, over(field.frame, x, y))]
        step, bands = self._best(field, heights, scaled) if field.has_best and heights else (1, [])
        yield from (*bands, *regions)
        for position, (text, height) in enumerate(zip(field.in_words(levels)[0], heights, strict=True)):
            width = THICK if step > 1 and position % step == step // 2 else THIN
            yield self._contour(around, height, _stroke(self.style.ink, "", width))
            self._label(values, height, text)
        if field.printed:
            look = _stroke(self.style.ink, DASHES[1], 0.8)
            self.keys["printed"] = _Key("as printed", look)
            printed: Any = scaled(evaluate(field.frame, field.printed, x, y))
            for height in heights:
                yield self._contour(printed, height, look)
        if not known.all():
            x, y = (axis._replace(size=FINE) for axis in (x, y))
            missing = numpy.where(numpy.isfinite(evaluate(field.frame, field.quantity, x, y)), -0.5, 0.5)
            paper, edge = f'fill="{self.style.paper}"', _stroke(self.style.ink, "", 1)
            text = ": ".join(filter(None, ("no value", "; ".join(field.gaps))))
            self.keys["gaps"] = _Key(text, box=f"{paper} {edge}")
            yield self._area(missing, paper)
            yield self._contour(missing, 0.0, edge)

    def _regions(self, field: Field, known: Any, here: Any) -> Iterator[str]:
        """Iterate over the regions beyond limits of the model as SVG: hatched, or bounded by a line."""
        dashes = cycle(DASHES[1:])
        for number, region in enumerate(field.regions):
            excess = extended(numpy.where(known, region.excess(here), numpy.nan))
            if not (excess > 0).any():
                continue
            if region.hatch:
                name = f"{self.name}-hatch{number}"
                hatch = f'fill="url(#{name})"'
                self.keys[region.text] = _Key(region.text, box=f"{hatch} {_stroke(self.style.hatch, '', 0.6)}")
                yield _pattern(name, region.hatch, self.style.hatch)
                yield self._area(excess, hatch)
                yield self._contour(excess, 0.0, _stroke(self.style.ink, "1 2", 0.8))
            else:
                look = _stroke(self.style.ink, next(dashes), 1)
                self.keys[region.text] = _Key(region.text, look)
                yield self._contour(excess, 0.0, look)

    def _best(self, field: Field, heights: list[float], scaled: Any) -> tuple[int, list[str]]:
        """Return n if every n-th contour has a band, and the bands as SVG: where the best range includes its value.

        Without bands, n is 1.
        """
        size = COARSE if field.frame.uncertainties else MESH
        here = over(field.frame, *(axis._replace(size=size) for axis in (self.panel.x, self.panel.y)))
        best = band_of(here, field.quantity, (size, size))
        if best is None:
            return 1, []
        far = 2 * float(abs(numpy.array(heights)).max()) + FARTHEST
        with numpy.errstate(invalid="ignore", divide="ignore"):
            low, high = (extended(scaled(end).clip(-far, far)) for end in (best.low, best.high))
        inside = numpy.array([numpy.minimum(high - height, height - low) for height in heights])
        step = spacing(inside)
        if step == 0:
            return 1, []
        pale, edge = f'fill="{self.style.paper}" opacity="0.55"', _stroke(self.style.hatch, "", 0.5)
        drawn = []
        with_band = slice(step // 2, None, step)
        for excess, height in zip(inside[with_band], heights[with_band], strict=True):
            drawn.append(self._area(excess, pale))
            for end in (low, high):
                drawn.append(self._contour(numpy.where(abs(end) < far, end, numpy.nan), height, edge))
        line = _stroke(self.style.ink, "", THIN if step == 1 else THICK)
        self.keys["best"] = _Key(
            best.key_of_map(step, field.frame.law.short), line, f'fill="{self.style.paper}" {edge}'
        )
        return step, drawn

    def _area(self, values: Any, look: str) -> str:
        """Return the part of the axes in which values on a mesh are positive, as a path."""
        across, up = WIDTH / (values.shape[1] - 1), self.high / (values.shape[0] - 1)
        path = []
        for area in _areas(values):
            points = [f"{x * across:.1f},{self.high - y * up:.1f}" for x, y in area]
            path.append(f"M{'L'.join(points)}Z")
        return f'<path d="{"".join(path)}" {look}/>'

    def _contour(self, values: Any, level: float, look: str) -> str:
        """Return the lines along which values on a mesh are at a level, as a path."""
        lines = ["L".join(f"{x:.1f},{y:.1f}" for x, y in line.tolist()) for line in self._lines(values, level)]
        return f'<path d="M{"M".join(lines)}" fill="none" {look}/>' if lines else ""

    def _lines(self, values: Any, level: float) -> list[Any]:
        """Return the lines along which values on a mesh are at a level, as positions of points."""
        steps = numpy.array([WIDTH / (values.shape[1] - 1), -self.high / (values.shape[0] - 1)])
        return [points * steps + (0, self.high) for points in _lines(values, level)]

    def _label(self, values: Any, level: float, text: str) -> None:
        """Write a text on the lines along which values are at a level, at a free place near the middle of the axes."""
        lines = self._lines(values, level)
        if not lines:
            return
        points, half = numpy.concatenate(lines), LETTER * len(text) / 2
        places = points.clip((half + 4, LINE), (WIDTH - half - 4, self.high - LINE / 2))
        cost = numpy.hypot(*(places - (WIDTH / 2, self.high / 2)).T) + ASIDE * numpy.hypot(*(places - points).T)
        for x, y in places[cost.argsort(kind="stable")].tolist():
            if self._is_free(x, y + 4, half):
                self.taken.append((x, y + 4, half))
                self.texts.append(_text(x, y + 4, text, "middle", self._halo()))
                return

    def _is_free(self, x: float, y: float, half: float) -> bool:
        """Return whether a text is clear of the others; `half`: half its width."""
        return all(
            abs(x - other_x) > half + other_half + 2 or abs(y - other_y) > LINE
            for other_x, other_y, other_half in self.taken
        )

    def _ticks(self) -> Iterator[str]:
        ink = f'stroke="{self.style.ink}"'
        for axis, is_x in ((self.panel.x, True), (self.panel.y, False)):
            values = _round_values(axis, TICKS)
            texts, unit = axis.in_words(values, 6)
            for value, text in zip(values, map(_raised, texts), strict=True):
                if is_x:
                    x = WIDTH * _share(axis, value)
                    yield f'<path d="M{x:.1f},{self.high}v-5" {ink}/>{_text(x, self.high + 16, text, "middle")}'
                else:
                    y = self.high * (1 - _share(axis, value))
                    yield f'<path d="M0,{y:.1f}h5" {ink}/>{_text(-5, y + 4, text, "end")}'
            title = described(axis.name, _raised(unit))
            place = f"translate({WIDTH / 2},{self.high + 34})"
            if not is_x:
                place = f"translate({14 - LEFT},{self.high / 2}) rotate(-90)"
            yield f'<g transform="{place}">{_text(0, 0, title, "middle")}</g>'

    def _marks(self) -> Iterator[str]:
        """Iterate over the marks as SVG, each with its text above the axes, or next to its point at a free place."""
        ends = self.panel.x.low, self.panel.y.high
        points = [
            self.place(*((end if at is None else at) for at, end in zip((mark.x, mark.y), ends, strict=True)))
            for mark in self.panel.marks
        ]
        self.taken += [(x, y + 4, 3.0) for x, y in points]
        for mark, (x, y) in zip(self.panel.marks, points, strict=True):
            if mark.y is None:
                yield f'<path d="M{x:.1f},-4v8" stroke="{self.style.ink}"/>'
                yield _text(x, -8, mark.text, look=f'transform="rotate(-60 {x:.1f} -8)"')
                continue
            yield f'<circle cx="{x:.1f}" cy="{y:.1f}" r="3" fill="{self.style.ink}"/>'
            half = LETTER * len(plain(mark.text)) / 2
            places = [(x + side * (half + 8), y + down) for down in (-5, 16, 4) for side in (1, -1)]
            inside = [place for place in places if half < place[0] < WIDTH - half]
            place = next((place for place in inside if self._is_free(*place, half)), places[0])
            self.taken.append((*place, half))
            yield _text(*place, mark.text, "middle", self._halo())

    def _halo(self) -> str:
        """Return the attributes that surround a text on a map with the colour of the paper."""
        return f'stroke="{self.style.paper}" stroke-width="3" paint-order="stroke"'


def _share(axis: Axis, values: Any) -> Any:
    """Return where values lie between the ends of an axis, from 0 to 1."""
    scale = numpy.log if axis.is_log else numpy.asarray
    with numpy.errstate(invalid="ignore", divide="ignore"):
        return (scale(values) - scale(axis.low)) / (scale(axis.high) - scale(axis.low))


def _round_values(axis: Axis, most: int) -> list[float]:
    """Return at most `most` round values of an axis; for a long logarithmic axis, some of the powers of ten."""
    decades = numpy.arange(ceil(log10(axis.low) - SAME), floor(log10(axis.high) + SAME) + 1) if axis.is_log else ()
    if len(decades) > most:
        return [float(f"1e{decade}") for decade in decades[:: ceil(len(decades) / most)]]
    return [float(value) for value in shown_values(axis._replace(size=0), most)]


class _Squares(NamedTuple):
    """The squares between the points of a mesh, and how many corners of each have values above a level."""

    values: Any
    level: float
    above: Any  # for each point, True if its value is above the level
    count: Any  # for each square, the number of corners above the level; -1 if a corner has no value

    def cut(self) -> Iterator[tuple[list[_Point], list[_Point]]]:
        """Iterate over the squares that the level cuts: the outline of the part above it, and the points of the cut."""
        for row, column in zip(*numpy.nonzero((self.count > 0) & (self.count < 4)), strict=True):
            corners = [(row, column), (row, column + 1), (row + 1, column + 1), (row + 1, column)]
            outline, points = [], []
            for first, second in zip(corners, corners[1:] + corners[:1], strict=True):
                if self.above[first]:
                    outline.append((float(first[1]), float(first[0])))
                if self.above[first] != self.above[second]:
                    points.append(self._between(first, second))
                    outline.append(points[-1])
            yield outline, points

    def _between(self, first: tuple[int, int], second: tuple[int, int]) -> _Point:
        """Return the point between two corners at which linearly interpolated values are at the level."""
        share = (self.level - self.values[first]) / (self.values[second] - self.values[first])
        y, x = (round(float(a + share * (b - a)), 6) for a, b in zip(first, second, strict=True))
        return x, y


def _squares(values: Any, level: float) -> _Squares:
    above, known = values > level, numpy.isfinite(values)
    first, second = slice(None, -1), slice(1, None)
    corners = [(first, first), (first, second), (second, second), (second, first)]
    count = numpy.sum([above[corner] for corner in corners], axis=0)
    is_known = numpy.all([known[corner] for corner in corners], axis=0)
    return _Squares(values, level, above, numpy.where(is_known, count, -1))


def _areas(values: Any) -> Iterator[list[_Point]]:
    """Iterate over the outlines, in steps of the mesh, of the parts in which values are positive."""
    squares = _squares(values, 0.0)
    for row, inside in enumerate(squares.count == 4):
        (turns,) = numpy.nonzero(numpy.diff(numpy.concatenate([[0], inside.astype(int), [0]])))
        for first, last in turns.reshape(-1, 2).tolist():
            yield [(first, row), (last, row), (last, row + 1), (first, row + 1)]
    for outline, _ in squares.cut():
        yield outline


def _lines(values: Any, level: float) -> list[Any]:
    """Return the lines along which values are at a level, in steps of the mesh, by marching squares."""
    neighbours: dict[_Point, list[_Point]] = {}
    for _, points in _squares(values, level).cut():
        for one, other in zip(points[::2], points[1::2], strict=True):
            neighbours.setdefault(one, []).append(other)
            neighbours.setdefault(other, []).append(one)
    lines = []
    while neighbours:
        ends = (point for point, others in neighbours.items() if len(others) == 1)
        line = [next(ends, next(iter(neighbours)))]
        next_to_first = neighbours[line[0]]
        while others := neighbours.pop(line[-1], []):
            line += [point for point in others if point in neighbours][:1]
        if len(line) > 2 and line[-1] in next_to_first:  # a closed line
            line.append(line[0])
        lines.append(numpy.array(line))
    return lines


def _between(colours: Sequence[str], count: int) -> list[str]:
    """Return colours at equal distances between the first and the last of a scale."""
    known = numpy.array([[*bytes.fromhex(colour.removeprefix("#"))] for colour in colours])
    places, of_known = numpy.linspace(0, len(colours) - 1, count), numpy.arange(len(colours))
    mixed = numpy.stack([numpy.interp(places, of_known, part) for part in known.T], axis=1).round().astype(int)
    return [f"#{red:02x}{green:02x}{blue:02x}" for red, green, blue in mixed]


def _pattern(name: str, hatch: str, colour: str) -> str:
    """Return the pattern of a hatch, which is the denser the more often its sign is repeated."""
    size = HATCH / len(hatch)
    look = f'stroke="{colour}" stroke-width="{(1.4 if hatch[0] == "." else 0.6) / size:.3g}" stroke-linecap="round"'
    place = f'width="1" height="1" patternUnits="userSpaceOnUse" patternTransform="scale({size:.3g})"'
    return f'<pattern id="{name}" {place}><path d="{HATCHES[hatch[0]]}" {look}/></pattern>'


def _stroke(colour: str, dashes: str, width: float) -> str:
    return f'stroke="{colour}" stroke-width="{width:g}"' + (f' stroke-dasharray="{dashes}"' if dashes else "")


def _head(x: float, y: float, from_x: float, from_y: float, ink: str) -> str:
    """Return the head of an arrow at a point, pointing away from another point."""
    length = max(float(numpy.hypot(x - from_x, y - from_y)), 1e-9)
    along_x, along_y = 7 * (x - from_x) / length, 7 * (y - from_y) / length
    sides = [(x - along_x + sign * along_y / 3, y - along_y - sign * along_x / 3) for sign in (1, -1)]
    return f'<path d="M{x:.1f},{y:.1f}' + "".join(f"L{a:.1f},{b:.1f}" for a, b in sides) + f'Z" fill="{ink}"/>'


def _text(x: float, y: float, text: str, anchor: str = "start", look: str = "") -> str:
    """Return a text with its mathematics in italics and its indices below the line."""
    if not text:
        return ""
    body = sub("⟦([^⟦⟧]*)⟧", lambda match: _formula(match[1]), escape(text))
    return f'<text x="{x:.1f}" y="{y:.1f}" text-anchor="{anchor}" {look}>{body}</text>'


def _formula(text: str) -> str:
    """Return an escaped formula with its letters in italics and its indices below the line."""

    def in_italics(match: Match[str]) -> str:
        if not match[1]:  # an escaped sign
            return match[0]
        return f'<tspan font-style="italic">{match[1]}</tspan>{_index(match[2] or match[3])}'

    return sub(r"&\w+;|([^\W\d_])(?:_([A-Za-z]+|[α-ω])|(\d+))?", in_italics, text)


def _raised(text: str) -> str:
    """Return a number, or a unit, with true minus signs and its power of ten raised."""
    powers = sub(r"\b1e(-?\d+)", lambda match: f"10{match[1].translate(RAISED)}", text)
    powers = sub(r"(?<=\d)e(-?\d+)", lambda match: f"·10{match[1].translate(RAISED)}", powers)
    return powers.replace("-", "−")


def _wrapped(text: str, letters: int) -> list[str]:
    """Return the lines of a text, which end neither in a formula nor before a unit."""
    joined = sub("⟦[^⟧]*⟧", lambda match: match[0].replace(" ", NO_BREAK_SPACE), with_units_joined(text))
    return wrap(joined, letters, break_long_words=False, break_on_hyphens=False)


def _index(text: str | None) -> str:
    """Return an index below the line; an empty text without an index."""
    return f'<tspan dy="3" font-size="9">{text}</tspan><tspan dy="-3">\u200b</tspan>' if text else ""
