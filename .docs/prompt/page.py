"""Draw pictures as SVG, in place of the program's module of this name: matplotlib, which it needs, is not in the page.

It draws axes, curves with their bands, contours and limits of maps, marks and sketches; hatches and the best ranges of
maps are left out.
"""

from collections.abc import Iterator, Sequence
from itertools import cycle
from math import ceil, floor, isfinite, log10
from re import sub
from textwrap import wrap
from typing import Any, NamedTuple
from xml.sax.saxutils import escape

import numpy

from jkroll.errors import missing_extra
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
    extent,
    is_flat,
    over,
    shown_values,
)
from jkroll.quantities.markup import plain

WIDTH, HEIGHT = 330, 250  # of axes
LEFT, RIGHT, TOP, BOTTOM = 88, 22, 30, 44  # around them
LINE = 15  # height of a line of text
LETTER = 6.0  # width of a letter, on average
COLUMNS = 2  # panels beside each other
DASHES = ("", "7 3", "7 3 2 3", "2 3", "7 3 2 3 2 3", "12 4")
TICKS, CONTOURS = 5, 9  # at most
CELLS = 121  # of a map, on each side


def draw(
    drawn: Picture, file_format: str, _: float | None, style: str, *, has_caption: bool = True, command: str = ""
) -> bytes:
    """Return a picture as the content of an SVG file, which a page scales to its width; others need matplotlib."""
    if file_format != "svg":
        with missing_extra("plot"):
            import matplotlib  # type: ignore[import-not-found,unused-ignore]  # noqa: F401
    look = STYLES[style]
    drawings = [_Axes(panel, look, f"panel{number}") for number, panel in enumerate(drawn.panels)]
    columns = min(len(drawings), COLUMNS)
    width, y = columns * (LEFT + WIDTH + RIGHT), LINE * bool(drawn.title)
    body = [_text(width / 2, LINE, drawn.title, "middle")] if drawn.title and has_caption else []
    for row in (drawings[first : first + columns] for first in range(0, len(drawings), columns)):
        for column, drawing in enumerate(row):
            x = column * (LEFT + WIDTH + RIGHT) + LEFT
            body.append(f'<g transform="translate({x},{y + TOP})">{"".join(drawing.parts())}</g>')
        y += max(drawing.height for drawing in row)
    said = [
        line for text in (" ".join(drawn.caption), *drawn.doubts) for line in wrap(plain(text), int(width / LETTER))
    ]
    for line in said if has_caption else ():
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
    """A line of a legend."""

    text: str
    line: str  # its look


class _Axes:
    """A panel, with the lines of its legend."""

    def __init__(self, panel: Panel, style: Style, name: str) -> None:
        self.panel, self.style, self.name = panel, style, name
        spans = [axis.high - axis.low for axis in (panel.x, panel.y)]
        self.high = round(WIDTH * spans[1] / spans[0]) if panel.is_true_to_scale else HEIGHT
        self.keys: dict[str, _Key] = {}
        self.inner = [*(self._field(panel.field) if panel.field else self._curves()), *self._arrows()]
        self.lines = [(n, key, line) for key in self.keys.values() for n, line in enumerate(wrap(key.text, 58))]
        self.height = TOP + self.high + BOTTOM + LINE * len(self.lines)

    def parts(self) -> Iterator[str]:
        """Iterate over the parts of the panel: what is inside of the axes, ticks, marks, legend."""
        yield f'<clipPath id="{self.name}"><rect width="{WIDTH}" height="{self.high}"/></clipPath>'
        yield f'<g clip-path="url(#{self.name})">{"".join(self.inner)}</g>'
        yield _text(WIDTH / 2, -10, self.panel.title, "middle")
        if self.panel.has_axes:
            yield f'<rect width="{WIDTH}" height="{self.high}" fill="none" stroke="{self.style.ink}"/>'
            yield from self._ticks()
        yield from self._marks()
        for number, (position, key, line) in enumerate(self.lines):
            y = self.high + BOTTOM + LINE * (number + 0.5)
            if position == 0:
                yield f'<path d="M0,{y - 4:g}h26" fill="none" {key.line}/>'
            yield _text(32, y, line)

    def place(self, x: Any, y: Any) -> tuple[Any, Any]:
        """Return the positions of values of both axes."""
        return WIDTH * _share(self.panel.x, x), self.high * (1 - _share(self.panel.y, y))

    def _path(self, x: Any, y: Any) -> str:
        parts, pen = [], "M"
        for point in zip(*self.place(numpy.asarray(x), numpy.asarray(y)), strict=True):
            is_known = all(map(isfinite, point))
            if is_known:
                parts.append(f"{pen}{min(max(point[0], -9e3), 9e3):.1f},{min(max(point[1], -9e3), 9e3):.1f}")
            pen = "L" if is_known else "M"
        return "".join(parts)

    def _curves(self) -> Iterator[str]:
        for curve in self.panel.curves:
            text = plain(": ".join(filter(None, (curve.text, curve.key))))
            colour = self.style.lines[curve.colour % len(self.style.lines)]
            dashes = DASHES[1] if curve.is_dashed else DASHES[len(self.keys) % len(DASHES)]
            key = self.keys.setdefault(text, _Key(text, _stroke(colour, dashes, 1.6)))
            if curve.band is not None:
                ends = [
                    numpy.clip(end, self.panel.y.low, self.panel.y.high) for end in (curve.band.low, curve.band.high)
                ]
                known = numpy.isfinite(ends[0]) & numpy.isfinite(ends[1])
                x, low, high = (values[known] for values in (curve.x, *ends))
                around = self._path([*x, *x[::-1]], [*low, *high[::-1]])
                yield f'<path d="{around}Z" fill="{colour}" opacity="0.22"/>'
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
        x, y = (axis._replace(size=CELLS) for axis in (self.panel.x, self.panel.y))
        scaled = numpy.log10 if field.is_log else numpy.asarray
        with numpy.errstate(invalid="ignore", divide="ignore"):
            values: Any = scaled(evaluate(field.frame, field.quantity, x, y))
        ends = Axis(field.quantity, *extent(field.values), is_log=field.is_log)
        levels = [] if is_flat(field.values) else _round_values(ends, CONTOURS)
        heights = [float(scaled(level)) for level in levels]
        colours = _between(self.style.bands, len(heights) + 1)
        for colour, row in self._cells(numpy.digitize(values, heights), numpy.isfinite(values)):
            yield f'<path d="{row}" fill="{colours[colour]}" shape-rendering="crispEdges"/>'
        for text, height in zip(field.in_words(levels)[0], heights, strict=True):
            yield from self._contour(values, height, _stroke(self.style.ink, "", 0.9), text)
        if field.printed:
            look = _stroke(self.style.ink, DASHES[1], 0.8)
            self.keys["printed"] = _Key("as printed", look)
            printed: Any = scaled(evaluate(field.frame, field.printed, x, y))
            for height in heights:
                yield from self._contour(printed, height, look, "")
        if not numpy.isfinite(values).all():
            self.keys["gaps"] = _Key(": ".join(["blank: no value", *field.gaps]), 'stroke="none"')
        here, dashes = over(field.frame, x, y), cycle(DASHES[1:])
        for region in field.regions:
            excess = numpy.where(numpy.isfinite(values), region.excess(here), numpy.nan)
            look = _stroke(self.style.hatch, next(dashes), 1.2)
            if lines := [*self._contour(excess, 0.0, look, "")]:
                self.keys[region.text] = _Key(plain(region.text), look)
                yield from lines

    def _cells(self, bands: Any, known: Any) -> Iterator[tuple[int, str]]:
        """Iterate over the bands of a field, each with the runs of cells that are in it."""
        across, up = (numpy.linspace(0, end, CELLS + 1) for end in (WIDTH, self.high))
        for band in range(int(bands.max()) + 1):
            path = []
            for row, inside in enumerate((bands == band) & known):
                (turns,) = numpy.nonzero(numpy.diff(numpy.concatenate([[0], inside.astype(int), [0]])))
                top, bottom = self.high - up[row + 1], self.high - up[row]
                path += [
                    f"M{across[first]:.1f},{top:.1f}H{across[last]:.1f}V{bottom:.1f}H{across[first]:.1f}Z"
                    for first, last in turns.reshape(-1, 2)
                ]
            yield band, "".join(path)

    def _contour(self, values: Any, level: float, look: str, text: str) -> Iterator[str]:
        """Draw the lines along which values on the cells are at a level, with a text at the middle of the axes."""
        lines = [
            (points[:, 0] * WIDTH / (CELLS - 1), self.high * (1 - points[:, 1] / (CELLS - 1)))
            for points in _lines(values, level)
        ]
        if not lines:
            return
        path = "M".join("L".join(f"{x:.1f},{y:.1f}" for x, y in zip(*line, strict=True)) for line in lines)
        yield f'<path d="M{path}" fill="none" {look}/>'
        if text:
            x, y = map(numpy.concatenate, zip(*lines, strict=True))
            middle = numpy.hypot(x - WIDTH / 2, y - self.high / 2).argmin()
            place = min(max(x[middle], 24), WIDTH - 24), min(max(y[middle] + 4, 14), self.high - 4)
            yield _text(*place, text, "middle", self._halo())

    def _ticks(self) -> Iterator[str]:
        ink = f'stroke="{self.style.ink}"'
        for axis, is_x in ((self.panel.x, True), (self.panel.y, False)):
            values = _round_values(axis, TICKS)
            texts, unit = axis.in_words(values, 6)
            for value, text in zip(values, texts, strict=True):
                if is_x:
                    x = WIDTH * _share(axis, value)
                    yield f'<path d="M{x:.1f},{self.high}v-5" {ink}/>{_text(x, self.high + 16, text, "middle")}'
                else:
                    y = self.high * (1 - _share(axis, value))
                    yield f'<path d="M0,{y:.1f}h5" {ink}/>{_text(-5, y + 4, text, "end")}'
            title = described(axis.name, unit)
            place = f"translate({WIDTH / 2},{self.high + 34})"
            if not is_x:
                place = f"translate({14 - LEFT},{self.high / 2}) rotate(-90)"
            yield f'<g transform="{place}">{_text(0, 0, title, "middle")}</g>'

    def _marks(self) -> Iterator[str]:
        for mark in self.panel.marks:
            x, y = self.place(
                self.panel.x.low if mark.x is None else mark.x, self.panel.y.low if mark.y is None else mark.y
            )
            yield f'<circle cx="{x:.1f}" cy="{y:.1f}" r="3" fill="{self.style.ink}"/>'
            if mark.y is None:  # those on one edge stand beside each other
                yield _text(x + 4, y - 8, mark.text, look=f'{self._halo()} transform="rotate(-90 {x + 4:.1f} {y - 8})"')
            else:
                is_right = x > WIDTH * 0.7
                yield _text(x + (-6 if is_right else 6), y - 5, mark.text, "end" if is_right else "start", self._halo())

    def _halo(self) -> str:
        """Return the look of a text on a map."""
        return f'stroke="{self.style.paper}" stroke-width="3" paint-order="stroke"'


def _share(axis: Axis, values: Any) -> Any:
    """Return where values lie between the ends of an axis, from 0 to 1."""
    scale = numpy.log if axis.is_log else numpy.asarray
    with numpy.errstate(invalid="ignore", divide="ignore"):
        return (scale(values) - scale(axis.low)) / (scale(axis.high) - scale(axis.low))


def _round_values(axis: Axis, most: int) -> list[float]:
    """Return at most so many round values of an axis, of a long logarithmic one some of the powers of ten."""
    decades = numpy.arange(ceil(log10(axis.low) - SAME), floor(log10(axis.high) + SAME) + 1) if axis.is_log else ()
    if len(decades) > most:
        return [float(f"1e{decade}") for decade in decades[:: ceil(len(decades) / most)]]
    return [float(value) for value in shown_values(axis._replace(size=0), most)]


def _lines(values: Any, level: float) -> list[Any]:
    """Return the lines along which values are at a level, in steps of the cells, by marching squares."""
    above, known = values > level, numpy.isfinite(values)
    whole = known[:-1, :-1] & known[1:, :-1] & known[:-1, 1:] & known[1:, 1:]
    count = above[:-1, :-1].astype(int) + above[:-1, 1:] + above[1:, 1:] + above[1:, :-1]
    neighbours: dict[tuple[float, float], list[tuple[float, float]]] = {}
    for row, column in zip(*numpy.nonzero(whole & (count > 0) & (count < 4)), strict=True):
        corners = [(row, column), (row, column + 1), (row + 1, column + 1), (row + 1, column)]
        points = []
        for first, second in zip(corners, corners[1:] + corners[:1], strict=True):
            if above[first] != above[second]:
                share = (level - values[first]) / (values[second] - values[first])
                y, x = (round(float(a + share * (b - a)), 6) for a, b in zip(first, second, strict=True))
                points.append((x, y))
        for one, other in zip(points[::2], points[1::2], strict=True):
            neighbours.setdefault(one, []).append(other)
            neighbours.setdefault(other, []).append(one)
    lines = []
    while neighbours:
        ends = (each for each, others in neighbours.items() if len(others) == 1)
        line = [next(ends, next(iter(neighbours)))]
        after_first = neighbours[line[0]]
        while others := neighbours.pop(line[-1], []):
            line += [each for each in others if each in neighbours][:1]
        lines.append(numpy.array(line + line[:1] * (len(line) > 2 and line[-1] in after_first)))
    return lines


def _between(colours: Sequence[str], count: int) -> list[str]:
    """Return colours at equal distances between the first and the last of a scale."""
    known = numpy.array([[int(each[n : n + 2], 16) for n in (1, 3, 5)] for each in colours])
    places, every = numpy.linspace(0, len(colours) - 1, count), numpy.arange(len(colours))
    mixed = numpy.stack([numpy.interp(places, every, part) for part in known.T], axis=1).round().astype(int)
    return [f"#{red:02x}{green:02x}{blue:02x}" for red, green, blue in mixed]


def _stroke(colour: str, dashes: str, width: float) -> str:
    return f'stroke="{colour}" stroke-width="{width:g}"' + (f' stroke-dasharray="{dashes}"' if dashes else "")


def _head(x: float, y: float, from_x: float, from_y: float, ink: str) -> str:
    """Return the head of an arrow at a point, away from another."""
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
    return sub(
        r"([^\W\d_])(?:_([^\W_]+)|(\d+))?",
        lambda match: f'<tspan font-style="italic">{match[1]}</tspan>{_index(match[2] or match[3])}',
        text,
    )


def _index(text: str | None) -> str:
    return f'<tspan dy="3" font-size="9">{text}</tspan><tspan dy="-3">\u200b</tspan>' if text else ""
