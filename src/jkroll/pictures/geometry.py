"""The sketch of the geometry: two spheres in contact, with the symbols of sizes, forces and displacements."""

from math import acos, cos, pi, sin, sqrt
from typing import NamedTuple

import numpy

from ..quantities.markup import symbol
from ..quantities.nomenclature import NOMENCLATURE
from .picture import Arrow, Axis, Curve, Panel, Picture

_SHOWN = ("radius", "radius2", "contact_radius_at_load", "approach_at_load", "yield_displacement", "load",
    "yield_force", "yield_moment")  # fmt: skip
_INK = 5  # colour of all lines
_OUTLINE, _UNDEFORMED, _AXIS = "spheres in contact", "without deformation", "line of centres"
_POINTS = 181


class _Pair(NamedTuple):
    """The sizes of the sketch; the contact is at y = 0, with sphere 1 above it."""

    above: float  # radius of sphere 1
    below: float  # radius of body 2
    half: float  # radius of the contact circle
    lag: float  # distance from the line of centres back to the middle of the circle

    def heights(self) -> tuple[float, float]:
        """Return the heights of both centres."""
        return sqrt(self.above**2 - self.half**2), -sqrt(self.below**2 - self.half**2)

    def outlines(self) -> tuple[Curve, ...]:
        """Return the line of contact, the outlines of both spheres, and their caps without deformation."""
        curves = []
        for radius, height, side in zip((self.above, self.below), self.heights(), (-1, 1), strict=True):
            opening = acos(sqrt(radius**2 - self.half**2) / radius)
            arcs = (_OUTLINE, self.lag, opening, 2 * pi - opening), (_UNDEFORMED, 0.0, -opening, opening)
            for text, lag, first, last in arcs:
                angle = numpy.linspace(first, last, _POINTS)
                x, y = radius * numpy.sin(angle) - lag, height + side * radius * numpy.cos(angle)
                curves.append(Curve(text, x, y, _INK))
        contact = numpy.array([-self.half - self.lag, self.half - self.lag])
        return Curve(_OUTLINE, contact, 0 * contact, _INK), *curves


def sketch() -> Picture:
    """Return the sketch: the pair with its forces, and the contact enlarged. Their sizes are not in proportion."""
    whole, near = _Pair(0.9, 1.2, 0.36, 0.0), _Pair(2.2, 2.9, 1.15, 0.3)
    terms = (f"{symbol(name)}: {NOMENCLATURE[name].sentence.partition(';')[0]}" for name in _SHOWN)
    caption = (f"{'; '.join(terms)}.", "Not to scale.")
    panels = (
        _panel(whole, _forces(whole), "two spheres", ((-2.0, 2.0), (-2.75, 2.75))),
        _panel(near, _lengths(near), "the contact, enlarged", ((-2.0, 2.0), (-1.6, 1.6))),
    )
    return Picture("Symbols", panels, caption)


def _panel(pair: _Pair, arrows: tuple[Arrow, ...], title: str, ends: tuple[tuple[float, float], ...]) -> Panel:
    """Return a panel of a pair, without axes; `ends`: those of x and of y."""
    across, upwards = ends
    x, y = Axis("position_across", *across, is_log=False), Axis("position_upwards", *upwards, is_log=False)
    up, down = pair.heights()
    line = numpy.array([max(y.low, down - 0.15), min(y.high, up + 0.15)])
    curves = (*pair.outlines(), Curve(_AXIS, 0 * line, line, _INK))
    return Panel(x, y, curves, title=title, is_true_to_scale=True, has_axes=False, arrows=arrows)


def _forces(pair: _Pair) -> tuple[Arrow, ...]:
    """Return the arrows of the radii, the forces and the moment of a pair."""
    (up, down), (above, below) = pair.heights(), (pair.above, pair.below)
    across = (cos(2.6), sin(2.6))
    top, bottom = up + above, down - below
    return (
        Arrow((0, up), (above * across[0], up + above * across[1]), symbol("radius"), (-0.3, up + 0.42)),
        Arrow((0, down), (below * across[0], down - below * across[1]), symbol("radius2"), (-0.38, down - 0.5)),
        Arrow((0, top + 0.6), (0, top), symbol("load"), (0.22, top + 0.35)),
        Arrow((0, bottom - 0.6), (0, bottom), symbol("load"), (0.22, bottom - 0.35)),
        Arrow((0, up), (above + 0.6, up), symbol("yield_force"), (above + 0.42, up + 0.22)),
        Arrow((-0.5, top + 0.02), (0.62, top - 0.08), symbol("yield_moment"), (0.95, top + 0.1), bend=-0.35),
    )


def _lengths(pair: _Pair) -> tuple[Arrow, ...]:
    """Return the arrows of the radius of a contact, its lag and the approach, and the lines at which they end."""
    up, down = pair.heights()
    lowest, highest, low, right = up - pair.above, down + pair.below, -0.62, 1.62
    middle, end = -pair.lag, pair.half - pair.lag
    lines = (
        ((middle, low - 0.06), (middle, 0.7)),
        ((end, low - 0.06), (end, 0)),
        ((0, lowest), (right + 0.06, lowest)),
        ((0, highest), (right + 0.06, highest)),
    )
    return (
        Arrow((middle, low), (end, low), symbol("contact_radius_at_load"), ((middle + end) / 2, low - 0.2), ends=2),
        Arrow((middle, 0.62), (0, 0.62), symbol("yield_displacement"), (middle / 2, 0.84), ends=2),
        Arrow((right, lowest), (right, highest), symbol("approach_at_load"), (right + 0.2, 0.0), ends=2),
        *(Arrow(start, stop, ends=0) for start, stop in lines),
    )
