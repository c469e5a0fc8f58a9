"""Looks of regions, and of a page: colours of paper, ink and bands, and sizes of letters."""

from collections.abc import Mapping
from typing import NamedTuple

SIZE = 8.6  # of letters in points, whatever the width of the page: subscripts, 0.7 times as large, have 6
LETTER = 0.42  # width of a letter over its size, on average
DASHES = ("-", "--", "-.", ":", (0, (5, 1, 1, 1, 1, 1)), (0, (8, 2)))


Colour = tuple[float, float, float]


class Look(NamedTuple):
    """Look of a region: its sign in a terminal; on a page its hatch, or, without one, a line with ticks on its side."""

    sign: str
    hatch: str = ""


BORDER = "border"
# A pattern belongs to one limit on every map. No two patterns together look like a third.
LOOKS: Mapping[str, Look] = {
    "contact_radius_in_spacings": Look("x", hatch="...."),
    "displacement_ratio": Look("/", hatch="////"),
    "tabor_parameter": Look("|", hatch="||||"),
    "energy_over_yield": Look("^", hatch="----"),
    BORDER: Look("'"),
}


class Style(NamedTuple):
    """Colours of a page: paper, ink, hatches, the bands of a map from low to high, and curves.

    The lightness of the bands changes steadily, so that their order shows in grey and to the colour-blind, and ink can
    be read on each of them.
    """

    paper: str
    ink: str
    hatch: str
    bands: tuple[Colour, ...]
    lines: tuple[str, ...]

    def band(self, place: float) -> Colour:
        """Return the colour of a band between the lowest, 0, and the highest, 1: three numbers up to 1."""
        scaled = place * (len(self.bands) - 1)
        first = min(int(scaled), len(self.bands) - 2)
        ends = zip(self.bands[first], self.bands[first + 1], strict=True)
        red, green, blue = ((low + (high - low) * (scaled - first)) / 255 for low, high in ends)
        return red, green, blue


# ColorBrewer's GnBu without its ends, and a dark counterpart. The lines are Okabe and Ito's colours.
PAPER = Style(
    "#ffffff", "#000000", "#555555",
    ((232, 246, 226), (204, 235, 197), (168, 221, 181), (123, 204, 196), (78, 179, 211)),
    ("#0072b2", "#d55e00", "#009e73", "#cc79a7", "#56b4e9", "#000000"),
)  # fmt: skip
DARK = Style(
    "#12151c", "#f2f2f2", "#a0a4ad",
    ((24, 36, 66), (24, 58, 92), (26, 82, 110), (38, 108, 120), (66, 134, 126)),
    ("#56b4e9", "#e69f00", "#009e73", "#cc79a7", "#f0e442", "#f2f2f2"),
)  # fmt: skip
STYLES = {"paper": PAPER, "dark": DARK}
