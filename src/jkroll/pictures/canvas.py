"""A canvas of character cells: colours in half-blocks where the terminal has colours, else signs in ASCII; curves in both."""

import os
from collections.abc import Sequence
from itertools import groupby
from operator import itemgetter
from typing import NamedTuple, TextIO

from ..text import columns, fitting, rows

NARROWEST = 20
Colour = tuple[int, int, int]
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
    return Screen(max(columns(), NARROWEST), rows(), (2**24 if is_exact else 256) if has_colour else 0)


def shade(place: float, colours: int = 2**24) -> Colour:
    """Return a colour between the darkest, 0, and the lightest, 1, for a screen of so many colours."""
    if colours <= 256:
        return _OF_CUBE[round(place * (len(_OF_CUBE) - 1))]
    red, green, blue = map(round, blended(_DARK_TO_LIGHT, place))
    return red, green, blue


def blended(colours: Sequence[Colour], place: float) -> tuple[float, float, float]:
    """Return the colour at a place between the first, 0, and the last, 1, of equally spaced colours."""
    scaled = place * (len(colours) - 1)
    first = min(int(scaled), len(colours) - 2)
    red, green, blue = (
        low + (high - low) * (scaled - first) for low, high in zip(colours[first], colours[first + 1], strict=True)
    )
    return red, green, blue


def ink_on(paper: Colour) -> Colour:
    """Return black or white, whichever can be read on a colour."""
    red, green, blue = paper
    return (0, 0, 0) if 0.299 * red + 0.587 * green + 0.114 * blue > 110 else (255, 255, 255)


class Canvas:
    """Cells of two pixels, one above the other, each with a colour or none.

    Above the pixels lies a layer of hatches, and above that a layer of letters: a cell shows the topmost character it has.
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
        """Write a text into a row if there is room beside other texts; return True if there was."""
        if not (0 <= row < self.height and column >= 0 and column + len(text) <= self.width):
            return False
        if any(self.letters[row][max(0, column - 1) : column + len(text) + 1]):
            return False
        self.letters[row][column : column + len(text)] = text
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
