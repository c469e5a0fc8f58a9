"""Draw maps and curves in a terminal, to its width, on a canvas of character cells.

Colours are half-blocks where the terminal has colours, else signs in ASCII; curves are drawn in both.
"""

import os
from collections.abc import Iterable, Sequence
from itertools import groupby
from math import isnan
from operator import itemgetter
from typing import Any, NamedTuple, TextIO

from ..text import fitting, say, terminal_height, terminal_width, wrapped
from .axes import Axis
from .maps import Curve, Level, Map, Mark, Panel, Picture, Region, sampled
from .styles import LOOKS, Colour, blended

# --- Canvas -----------------------------------------------------------------------------------------------------------

NARROWEST = 20
# From dark to light, in greyscale too and for the colour-blind: matplotlib's cividis.
_DARK_TO_LIGHT: tuple[Colour, ...] = (
    (0, 34, 78), (18, 53, 112), (59, 73, 108), (87, 93, 109), (112, 113, 115), (138, 134, 120), (165, 156, 116),
    (195, 179, 105), (225, 204, 85), (254, 232, 56),
)  # fmt: skip
# The same for 256 colours, from blue through green to yellow; their cube has too few greys.
_OF_CUBE: tuple[Colour, ...] = (
    (0, 0, 95), (95, 0, 135), (0, 95, 135), (0, 135, 135), (0, 175, 135), (0, 215, 95), (95, 215, 95), (135, 215, 95),
    (175, 215, 95), (215, 215, 95), (255, 215, 95), (255, 255, 95), (255, 255, 215),
)  # fmt: skip
RAMP = " .:-~=+*oO#%@"
# Okabe and Ito's colours for the colour-blind, without those that are too light or too dark for some background.
LINES: tuple[Colour, ...] = ((0, 114, 178), (213, 94, 0), (0, 158, 115), (204, 121, 167), (86, 180, 233), (230, 159, 0))
CONTOUR = "_"
SIGNS = "*o+x#%abcdefghijklmnpqrs"  # of curves


class Screen(NamedTuple):
    """The size of a terminal and its number of colours, 0 for none."""

    width: int
    height: int
    colours: int


def screen_of(out: TextIO) -> Screen:
    """Return the screen behind a stream; the environment decides too: NO_COLOR, FORCE_COLOR, COLORTERM, TERM, COLUMNS."""
    is_plain = bool(os.environ.get("NO_COLOR")) or os.environ.get("TERM") == "dumb" or fitting("▀", out) != "▀"
    has_colour = not is_plain and (out.isatty() or bool(os.environ.get("FORCE_COLOR")))
    is_exact = os.environ.get("COLORTERM") in ("truecolor", "24bit")
    return Screen(
        max(terminal_width(), NARROWEST), terminal_height(), (2**24 if is_exact else 256) if has_colour else 0
    )


def shade(place: float, colours: int = 2**24) -> Colour:
    """Return a colour between the darkest, 0, and the lightest, 1, for a screen of so many colours."""
    if colours <= 256:
        return _OF_CUBE[round(place * (len(_OF_CUBE) - 1))]
    red, green, blue = map(round, blended(_DARK_TO_LIGHT, place))
    return red, green, blue


def ink_on(paper: Colour) -> Colour:
    """Return black or white, whichever can be read on a colour."""
    red, green, blue = paper
    return (0, 0, 0) if 0.299 * red + 0.587 * green + 0.114 * blue > 110 else (255, 255, 255)


class Canvas:
    """Cells of two pixels, one above the other, each with a colour or none.

    Above the pixels lies a layer of hatches, and above that a layer of letters: a cell shows the topmost character it
    has.
    """

    def __init__(self, width: int, height: int) -> None:
        """Create an empty canvas of so many cells."""
        self.width, self.height = width, height
        self.pixels: list[list[Colour | None]] = [[None] * width for _ in range(2 * height)]
        self.signs: list[list[str]] = [[" "] * width for _ in range(height)]  # in ASCII
        self.hatches: list[list[str]] = [[""] * width for _ in range(height)]
        self.inks: list[list[Colour | None]] = [[None] * width for _ in range(height)]  # of hatches
        self.letters: list[list[str]] = [[""] * width for _ in range(height)]

    def write(self, column: int, row: int, text: str) -> bool:
        """Write a text into a row if there is room beside other texts, or over the same letters; return True if there was."""
        end = column + len(text)
        if not (0 <= row < self.height and column >= 0 and end <= self.width):
            return False
        letters = self.letters[row]
        if any(letters[max(0, column - 1) : column] + letters[end : end + 1]):
            return False
        if any(old and old != new for old, new in zip(letters[column:end], text, strict=True)):
            return False
        letters[column:end] = text
        return True

    def hatch(self, column: int, row: int, sign: str, ink: Colour | None = None) -> None:
        """Put a hatch into a cell, in a colour, or in one that can be read on the cell."""
        self.hatches[row][column] = sign
        self.inks[row][column] = ink

    def lines(self, screen: Screen) -> list[str]:
        """Return the canvas as lines of text."""
        rows = range(self.height)
        return [self._coloured(row, screen.colours) if screen.colours else self._plain(row) for row in rows]

    def _texts(self, row: int) -> list[str]:
        """Return the topmost character of each cell of a row, "" where there is none."""
        return [letter or hatch for letter, hatch in zip(self.letters[row], self.hatches[row], strict=True)]

    def _plain(self, row: int) -> str:
        return "".join(text or sign for text, sign in zip(self._texts(row), self.signs[row], strict=True))

    def _coloured(self, row: int, colours: int) -> str:
        from rich.color import Color, ColorSystem
        from rich.style import Style

        def look(ink: Colour | None, paper: Colour | None) -> Style:
            """Return the style of an ink on a paper, each the terminal's own if it is None."""
            return Style.from_color(ink and Color.from_rgb(*ink), paper and Color.from_rgb(*paper))

        cells = []
        inks = [None if letter else ink for letter, ink in zip(self.letters[row], self.inks[row], strict=True)]
        pixels = self.pixels[2 * row], self.pixels[2 * row + 1]
        for text, ink, above, below in zip(self._texts(row), inks, *pixels, strict=True):
            if text:
                paper = above or below
                cells.append((text, look(ink or (paper and ink_on(paper)), paper)))
            elif above == below:
                cells.append((" ", look(None, above)))
            else:
                cells.append(("▀", look(above, below)) if above else ("▄", look(below, None)))
        system = ColorSystem.TRUECOLOR if colours > 256 else ColorSystem.EIGHT_BIT
        runs = groupby(cells, key=itemgetter(1))
        return "".join(style.render("".join(text for text, _ in run), color_system=system) for style, run in runs)


def stacked(labels: Sequence[tuple[int, str]], width: int) -> list[str]:
    """Return labels above their places, in as few lines as possible, with a tick beneath each.

    >>> stacked([(2, "quartz"), (5, "iron")], 20)
    ['  quartz            ', '     iron           ', '  |  |              ']
    """
    rows: list[str] = []
    for place, text in sorted(labels):
        start = max(0, min(place, width - len(text)))
        for number, row in enumerate(rows):
            if len(row.rstrip()) < start:
                rows[number] = row[:start] + text + row[start + len(text) :]
                break
        else:
            rows.append(" " * start + text + " " * (width - start - len(text)))
    ticks = [" "] * width
    for place, _ in labels:
        ticks[place] = "|"
    return [*rows, "".join(ticks)] if labels else []


# --- Pictures ---------------------------------------------------------------------------------------------------------

MAX_ROWS = 24
BAND_STEPS = len(RAMP) - 1  # contours between so many bands


def draw_map(drawn: Map, out: TextIO) -> None:
    """Draw a map: bands between labelled contours, hatched regions, and marks."""
    screen = screen_of(out)
    axis = _Frame(drawn.x, drawn.y, screen)
    levels = drawn.bands(BAND_STEPS)
    canvas = Canvas(axis.width, axis.height)
    _paint(canvas, drawn, levels, screen)
    legend = [
        f"{LOOKS[region.look].sign} {region.text}" if region.look is not None else region.text
        for region in _hatch(canvas, drawn)
    ]
    if drawn.has_gaps:
        legend.append("? no value" if not screen.colours else "blank: no value")
    if not screen.colours:
        _draw_contours(canvas, drawn.values, levels)
    for value, text in drawn.guides:
        _across(canvas, drawn.y, value, text)
    above = [(axis.column(mark.x), mark.text) for mark in drawn.marks if mark.x is not None and mark.y is None]
    _points(canvas, drawn.x, drawn.y, [mark for mark in drawn.marks if mark.y is not None])
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
        _points(canvas, panel.x, panel.y, panel.points)
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
        if region.look is None:
            seen.append(region)
            continue
        look = LOOKS[region.look]
        inside = _sampled(region.margin, canvas.width, canvas.height) < 0
        marked = known & (_edge(inside) & ~_edge(known) if look.is_line else inside)
        if marked.any():
            seen.append(region)
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


def _across(canvas: Canvas, y: Axis, value: float, text: str) -> None:
    """Draw a dotted line across at a value, with its text at the right end."""
    row = canvas.height - 1 - _cell(y, value, canvas.height)
    for column in range(0, canvas.width, 2):
        canvas.hatch(column, row, "-")
    canvas.write(canvas.width - len(text) - 2, row, f" {text} ")


def _points(canvas: Canvas, x: Axis, y: Axis, marks: Sequence[Mark]) -> None:
    """Draw marks, each with its text as near as there is room; a mark on the y axis alone goes to the right end."""
    places = [
        (
            canvas.width - 1 if mark.x is None else _cell(x, mark.x, canvas.width),
            canvas.height - 1 - _cell(y, y.low if mark.y is None else mark.y, canvas.height),
        )
        for mark in marks
    ]
    for column, row in places:
        canvas.letters[row][column] = "o"
    for (column, row), mark in zip(places, marks, strict=True):
        length = len(mark.text)
        near = max(0, min(column + 2, canvas.width - length))
        beside = (column, row, f"o {mark.text}"), (column - length - 1, row, f"{mark.text} o")
        for place in (*beside, *((near, row + by, mark.text) for by in (-1, 1, -2, 2))):
            if canvas.write(*place):
                break


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
