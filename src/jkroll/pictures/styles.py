"""Looks of regions, and of a page: colours of paper, ink and bands, and sizes of letters."""

from collections.abc import Mapping, Sequence
from types import MappingProxyType
from typing import Literal, NamedTuple

SIZE = 8.6  # of letters in points, whatever the width of the page: subscripts, 0.7 times as large, have 6
LETTER = 0.42  # width of a letter over its size, on average
DASHES = ("-", "--", "-.", ":", (0, (5, 1, 1, 1, 1, 1)), (0, (8, 2)))


Colour = tuple[int, int, int]


def blended(colours: Sequence[Colour], place: float) -> tuple[float, float, float]:
    """Return the colour at a place between the first, 0, and the last, 1, of equally spaced colours."""
    scaled = place * (len(colours) - 1)
    first = min(int(scaled), len(colours) - 2)
    red, green, blue = (
        low + (high - low) * (scaled - first) for low, high in zip(colours[first], colours[first + 1], strict=True)
    )
    return red, green, blue


class Look(NamedTuple):
    """The way in which a region is shown: its sign in a terminal; on a page its hatch or shade, and the line around it."""

    sign: str
    hatch: str = ""
    shade: float = 0.0  # opacity of the ink
    line: tuple[float, Literal["dotted", "dashdot"]] = (0.5, "dotted")  # width and dashes

    @property
    def is_line(self) -> bool:
        """True if only the line around the region is drawn."""
        return not (self.hatch or self.shade)


BORDER = "border"
# A pattern belongs to one limit on every map. No two patterns together look like a third, and no sign is one of the bands'.
LOOKS: Mapping[str, Look] = MappingProxyType(
    {
        "contact_radius_in_spacings": Look("x", hatch="...."),
        "displacement_ratio": Look("/", hatch="////"),
        "tabor_parameter": Look("|", hatch="||||"),
        "energy_over_yield": Look("^", shade=0.25),
        BORDER: Look("'", line=(0.9, "dashdot")),
    }
)


class Style(NamedTuple):
    """Colours of a page: paper, ink, hatches, the bands of a map from low to high, and curves.

    The lightness of the bands changes steadily, so that their order shows in grey and to the colour-blind, and ink can
    be read on each of them.
    """

    paper: str
    ink: str
    hatch: str
    bands: tuple[Colour, ...]
    lines: tuple[Colour, ...]

    def band(self, place: float) -> tuple[float, float, float]:
        """Return the colour of a band between the lowest, 0, and the highest, 1, as matplotlib takes it."""
        red, green, blue = blended(self.bands, place)
        return red / 255, green / 255, blue / 255

    def line(self, number: int) -> tuple[float, float, float]:
        """Return the colour of curves of one number, as matplotlib takes it."""
        red, green, blue = self.lines[number % len(self.lines)]
        return red / 255, green / 255, blue / 255


# ColorBrewer's GnBu without its ends, and a dark counterpart. The lines are Okabe and Ito's colours.
PAPER = Style(
    "#ffffff", "#000000", "#555555",
    ((232, 246, 226), (204, 235, 197), (168, 221, 181), (123, 204, 196), (78, 179, 211)),
    ((0, 114, 178), (213, 94, 0), (0, 158, 115), (204, 121, 167), (86, 180, 233), (0, 0, 0)),
)  # fmt: skip
DARK = Style(
    "#12151c", "#f2f2f2", "#a0a4ad",
    ((24, 36, 66), (24, 58, 92), (26, 82, 110), (38, 108, 120), (66, 134, 126)),
    ((86, 180, 233), (230, 159, 0), (0, 158, 115), (204, 121, 167), (240, 228, 66), (242, 242, 242)),
)  # fmt: skip
STYLES = {"paper": PAPER, "dark": DARK}
