"""Draw maps and curves in a terminal, to its width."""

from collections.abc import Iterable
from math import isnan
from typing import Any, TextIO

from ..text import say, wrapped
from .axes import Axis
from .canvas import CONTOUR, LINES, RAMP, SIGNS, Canvas, Colour, Screen, screen_of, shade, stacked
from .maps import Curve, Level, Map, Mark, Panel, Picture, Region, sampled
from .styles import EVERYWHERE, LOOKS

MAX_ROWS = 24
BAND_STEPS = len(RAMP) - 1  # contours between so many bands


def draw_map(drawn: Map, out: TextIO) -> None:
    """Draw a map: bands between labelled contours, hatched regions, and marks."""
    screen = screen_of(out)
    axis = _Frame(drawn.x, drawn.y, screen)
    levels = drawn.bands(BAND_STEPS)
    canvas = Canvas(axis.width, axis.height)
    _paint(canvas, drawn, levels, screen)
    legend = [f"{LOOKS[region.look].sign} {region.text}".strip() for region in _hatch(canvas, drawn)]
    if drawn.has_gaps:
        legend.append("? no value" if not screen.colours else "blank: no value")
    if not screen.colours:
        _draw_contours(canvas, drawn.values, levels)
    for guide in drawn.guides:
        _across(canvas, drawn.y, guide)
    above = []
    for mark in drawn.marks:
        if mark.x is not None and mark.y is None:
            above.append((axis.column(mark.x), mark.text))
        else:
            _point(canvas, drawn.x, drawn.y, mark)
    _label(canvas, drawn.values, levels, "{}", 0.5)
    if drawn.printed is not None:
        _label(canvas, drawn.printed, levels, "({})", 0.8)
        legend.append("( ) as printed")
    _say([drawn.title], screen, out)
    for line in stacked(above, axis.width):
        say(" " * axis.margin + line, out)
    axis.say(canvas, out)
    for line in _scale(drawn, levels, screen):
        say(line, out)
    _say([*legend, *drawn.caption, *drawn.remarks], screen, out)


def draw_picture(drawn: Picture, out: TextIO) -> None:
    """Draw panels below each other, each with its curves, points and axes."""
    screen = screen_of(out)
    if drawn.title:
        say(drawn.title, out)
    for panel in drawn.panels:
        axis = _Frame(panel.x, panel.y, screen, is_true_to_scale=panel.is_true_to_scale)
        canvas = Canvas(axis.width, axis.height)
        for number, curve in enumerate(panel.curves):
            _trace(canvas, panel, curve, SIGNS[number % len(SIGNS)])
        for point in panel.points:
            _point(canvas, panel.x, panel.y, point)
        if panel.title:
            say(panel.title, out)
        axis.say(canvas, out)
        if len(panel.curves) > 1:
            for number, curve in enumerate(panel.curves):
                key = _key(curve.colour, SIGNS[number % len(SIGNS)], screen)
                for line in wrapped(curve.text, screen.width - 3):
                    say(f"{key} {line}", out)
                    key = "  "
    _say((*drawn.caption, *drawn.remarks), screen, out)


def _say(texts: Iterable[str], screen: Screen, out: TextIO) -> None:
    """Print texts in lines that fit the screen."""
    for text in texts:
        for line in wrapped(text, screen.width):
            say(line, out)


def _key(colour: int, sign: str, screen: Screen) -> str:
    """Return a sample of a curve's line, for the legend."""
    strip = Canvas(2, 1)
    for column in range(strip.width):
        strip.hatch(column, 0, sign, LINES[colour % len(LINES)])
    return strip.lines(screen)[0]


def _trace(canvas: Canvas, panel: Panel, curve: Curve, sign: str) -> None:
    """Draw a curve, without gaps between its points."""
    import numpy

    places = []
    for axis, values in ((panel.x, curve.x), (panel.y, curve.y)):
        is_inside = (values >= axis.low) & (values <= axis.high)
        places.append(axis.place(numpy.where(is_inside, values, numpy.nan)))
    colour = LINES[curve.colour % len(LINES)]
    steps = 16 * (canvas.width + canvas.height)
    fine = numpy.linspace(0, len(places[0]) - 1, steps)
    across, up = (numpy.interp(fine, numpy.arange(len(place)), place) for place in places)
    for x, y in zip(across.tolist(), up.tolist(), strict=True):
        if not (isnan(x) or isnan(y)):
            canvas.hatch(round(x * (canvas.width - 1)), round((1 - y) * (canvas.height - 1)), sign, colour)


class _Frame:
    """Axes on a screen: the ticks of y to the left, those of x below."""

    def __init__(self, x: Axis, y: Axis, screen: Screen, *, is_true_to_scale: bool = False) -> None:
        self.x, self.y, self.screen = x, y, screen
        self.height = max(8, min(MAX_ROWS, screen.height - 8, screen.width // 3))
        self.y_ticks = y.ticks(max(2, self.height // 2))
        self.margin = max((len(tick.text) for tick in self.y_ticks), default=0) + 1
        self.width = screen.width - self.margin - 1
        if is_true_to_scale:  # a cell is twice as high as it is wide
            self.width = min(self.width, round(2 * self.height * (x.high - x.low) / (y.high - y.low)))
        self.x_ticks = x.ticks(max(2, self.width // 9))

    def column(self, value: float) -> int:
        """Return the column of a value of x."""
        return _cell(self.x, value, self.width)

    def say(self, canvas: Canvas, out: TextIO) -> None:
        """Write the canvas with its axes."""
        texts = {canvas.height - 1 - _cell(self.y, tick.value, canvas.height): tick.text for tick in self.y_ticks}
        _say([self.y.label()], self.screen, out)
        for row, line in enumerate(canvas.lines(self.screen)):
            say(f"{texts.get(row, ''):>{self.margin - 1}} {line}", out)
        below = [" "] * (self.screen.width + 1)
        end = -1
        for tick in self.x_ticks:
            start = min(self.margin + self.column(tick.value) - len(tick.text) // 2, self.screen.width - len(tick.text))
            if start > end:
                below[start : start + len(tick.text)] = tick.text
                end = start + len(tick.text)
        say("".join(below).rstrip(), out)
        for line in wrapped(self.x.label(), self.screen.width):
            say(f"{line:^{self.screen.width}}".rstrip(), out)


def _cell(axis: Axis, value: float, count: int) -> int:
    """Return the number of the cell, among `count` along an axis, into which a value falls."""
    return min(max(round(float(axis.place(value)) * (count - 1)), 0), count - 1)


def _paint(canvas: Canvas, drawn: Map, levels: list[Level], screen: Screen) -> None:
    """Colour every pixel by its band; a pixel without a value gets no colour."""
    import numpy

    def bands(height: int) -> Any:
        values = _sampled(drawn.values, canvas.width, height)
        band = numpy.searchsorted([level.value for level in levels], values, side="right")
        return numpy.where(numpy.isnan(values), -1, band)

    colours = [_shade_of(band, levels, screen) for band in range(len(levels) + 1)]
    for row, line in enumerate(bands(2 * canvas.height).tolist()):
        canvas.pixels[row] = [colours[band] if band >= 0 else None for band in line]
    for row, line in enumerate(bands(canvas.height).tolist()):
        canvas.signs[row] = [RAMP[band] if band >= 0 else "?" for band in line]


def _sampled(values: Any, width: int, height: int) -> Any:
    """Return the values nearest to the middles of so many pixels, the highest row first."""
    return sampled(values, width, height)[::-1]


def _hatch(canvas: Canvas, drawn: Map) -> list[Region]:
    """Hatch the regions; where they overlap, their signs alternate with each other and with the band. Return those to be seen."""
    import numpy

    signs: list[list[str]] = [[""] * canvas.width for _ in range(canvas.height)]
    known = numpy.isfinite(_sampled(drawn.values, canvas.width, canvas.height))
    seen = []
    for region in drawn.regions:
        look = LOOKS[region.look]
        inside = _sampled(region.margin, canvas.width, canvas.height) < 0
        marked = known & (_edge(inside) & ~_edge(known) if look.is_line else inside)
        if region.look == EVERYWHERE or marked.any():
            seen.append(region)
        if region.look == EVERYWHERE:
            continue
        for row, line in enumerate(marked.tolist()):
            signs[row] = [here + look.sign * is_here for here, is_here in zip(signs[row], line, strict=True)]
    for row, line in enumerate(signs):
        for column, here in enumerate(line):
            turn = (row + column) % (len(here) + 1)
            if turn:
                canvas.hatch(column, row, here[turn - 1])
    return seen


def _edge(is_above: Any) -> Any:
    """Return True for cells whose neighbour to the right or below is on the other side."""
    import numpy

    edge = numpy.zeros(is_above.shape, bool)
    edge[:, :-1] |= is_above[:, :-1] != is_above[:, 1:]
    edge[:-1] |= is_above[:-1] != is_above[1:]
    return edge


def _across(canvas: Canvas, y: Axis, guide: Mark) -> None:
    """Draw a dotted line across, with its text at the right end."""
    if guide.y is not None:
        row = canvas.height - 1 - _cell(y, guide.y, canvas.height)
        for column in range(0, canvas.width, 2):
            canvas.hatch(column, row, "-")
        canvas.write(canvas.width - len(guide.text) - 2, row, f" {guide.text} ")


def _point(canvas: Canvas, x: Axis, y: Axis, mark: Mark) -> None:
    """Draw a mark with its text on the side that has room; a mark on the y axis alone goes to the right end."""
    column = canvas.width - 1 if mark.x is None else _cell(x, mark.x, canvas.width)
    row = canvas.height - 1 - _cell(y, y.low if mark.y is None else mark.y, canvas.height)
    if not canvas.write(column, row, f"o {mark.text}"):
        canvas.write(column - len(mark.text) - 1, row, f"{mark.text} o")


def _contours(canvas: Canvas, values: Any, levels: list[Level]) -> list[Any]:
    """Return True for the cells of each contour."""
    import numpy

    values = _sampled(values, canvas.width, canvas.height)
    known = numpy.isfinite(values)
    return [_edge(values >= level.value) & known & ~_edge(known) for level in levels]


def _draw_contours(canvas: Canvas, values: Any, levels: list[Level]) -> None:
    """Draw contours, over bands and hatches."""
    for contour in _contours(canvas, values, levels):
        for row, column in zip(*contour.nonzero(), strict=True):
            canvas.hatch(column, row, CONTOUR)


def _label(canvas: Canvas, values: Any, levels: list[Level], form: str, middle: float) -> None:
    """Label each contour, as near to a place in the middle row as there is room."""
    import numpy

    rows, columns = numpy.indices((canvas.height, canvas.width))
    distance = numpy.hypot(2 * (rows - (canvas.height - 1) / 2), columns - middle * (canvas.width - 1))
    for level, edge in zip(levels, _contours(canvas, values, levels), strict=True):
        places = numpy.argwhere(edge)
        text = form.format(level.text)
        for row, column in places[numpy.argsort(distance[edge], kind="stable")][:200].tolist():
            if canvas.write(column - len(text) // 2, row, text):
                break


def _scale(drawn: Map, levels: list[Level], screen: Screen) -> list[str]:
    """Return the scale: the bands in order with the values between them, wrapped to the width."""
    lines = [f"{drawn.heading}:"]
    length = len(lines[0])
    for band in range(len(levels) + 1):
        strip = Canvas(2, 1)
        strip.pixels = [[_shade_of(band, levels, screen)] * 2] * 2
        strip.signs = [[RAMP[band]] * 2]
        text = f" {levels[band].text}" if band < len(levels) else ""
        if length + 3 + len(text) > screen.width:
            lines.append("")
            length = 0
        lines[-1] += f" {strip.lines(screen)[0]}{text}"
        length += 3 + len(text)
    return lines


def _shade_of(band: int, levels: list[Level], screen: Screen) -> Colour:
    return shade(band / max(1, len(levels)), screen.colours)
