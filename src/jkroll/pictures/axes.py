"""Axes of maps and curves: the range of a quantity, round values on it, and their texts."""

from collections.abc import Mapping, Sequence
from math import ceil, floor, log10
from types import MappingProxyType
from typing import Any, NamedTuple

import numpy

from ..quantities.nomenclature import NOMENCLATURE, Quantity, header

# The axes of figures that are no quantities of a scene.
_OF_FIGURES: Mapping[str, Quantity] = {
    "position_across": Quantity("x", "m", "position from the contact point"),
    "position_beside": Quantity("y", "m", "position perpendicular to the rolling direction"),
    "pressure_across": Quantity("p", "Pa", "pressure, tension negative"),
    "time_of_a_point": Quantity("t", "s", "time of a point"),
    "error": Quantity("", "1", "error in ulp/(1+κ)"),
}


class Axis(NamedTuple):
    """A quantity of the nomenclature, or one that only figures have, between two values."""

    name: str
    low: float
    high: float
    is_log: bool = True
    size: int = 0  # number of values; 0: the picture's default
    beside: Mapping[str, float] = MappingProxyType({})  # inputs that a value of this one needs
    chosen: tuple[float, ...] = ()  # the values, where they are not equally spaced

    def inputs(self, values: Any) -> dict[str, Any]:
        """Return the inputs of a scene at values on the axis."""
        return {**self.beside, self.name: values}

    def has(self, value: float) -> bool:
        """Return whether a value lies between the ends."""
        return self.low <= value <= self.high

    def header(self) -> str:
        """Return the column header of the values: name and unit."""
        return header(self.name, quantity_of(self.name).unit)

    def values(self) -> Any:
        """Return the values as an array, equally spaced along the axis unless they were chosen."""
        if self.chosen:
            return numpy.array(self.chosen)
        spaced = numpy.geomspace if self.is_log else numpy.linspace
        return spaced(self.low, self.high, self.size)

    def at_round_values(self, most: int) -> "Axis":
        """Return the axis with at most `most` values: its own if they are so few, else round ones."""
        if 0 < self.size <= most:
            return self
        digits = ((1, 2, 5), (1, 3), (1,))
        chosen = tuple(round_values(self.low, self.high, most, is_log=self.is_log, digits=digits))
        return self._replace(chosen=chosen, size=len(chosen))


def quantity_of(name: str) -> Quantity:
    """Return the meaning of the name of an axis."""
    return _OF_FIGURES.get(name) or NOMENCLATURE[name]


def described(name: str, unit: str = "") -> str:
    """Return a quantity as the title of an axis, with its symbol marked as mathematics.

    >>> described("load", "nN")
    'load; a pull is negative, ⟦P⟧ [nN]'
    """
    quantity = quantity_of(name)
    return quantity.sentence + (f", ⟦{quantity.symbol}⟧" if quantity.symbol else "") + bracketed(unit)


def bracketed(unit: str) -> str:
    """Return a unit as it stands behind a symbol, in brackets; empty for a number."""
    return f" [{unit}]" if unit not in ("", "1") else ""


def round_values(
    low: float, high: float, most: int, *, is_log: bool, digits: Sequence[Sequence[int]] = ((1, 2, 5), (1,))
) -> list[float]:
    """Return at most `most` round values between two: as many as fit of 1, 2 and 5 times powers of ten, or equal steps.

    `digits`: those of each decade of a logarithmic scale, the most first.

    >>> round_values(1e-9, 1e-8, 12, is_log=True), round_values(1e-9, 1e-6, 5, is_log=True)
    ([1e-09, 2e-09, 5e-09, 1e-08], [1e-09, 1e-08, 1e-07, 1e-06])
    >>> round_values(-1.0, 1.0, 5, is_log=False), round_values(-300.0, 600.0, 5, is_log=False)
    ([-1.0, -0.5, 0.0, 0.5, 1.0], [-200.0, 0.0, 200.0, 400.0, 600.0])
    """
    if is_log:
        decades = range(floor(log10(low)), ceil(log10(high)) + 1)
        step, least = ceil(len(decades) / most), 2 if high > 50 * low else 3
        some_decades = [decade for decade in decades if decade % step == 0]
        every = [*((several, decades) for several in digits), ((1,), some_decades)]
        for several, of_decades in every:
            values = [float(f"{digit}e{decade}") for decade in of_decades for digit in several]
            inside = [value for value in values if low * (1 - 1e-9) <= value <= high * (1 + 1e-9)]
            if least <= len(inside) <= most:
                return inside
    if not high > low:
        return [low]
    decade = floor(log10((high - low) / most))
    widths = (float(f"{digit}e{place}") for place in (decade, decade + 1) for digit in (1, 2, 5))
    for width in widths:
        places = range(ceil(low / width - 1e-9), floor(high / width + 1e-9) + 1)
        if 1 < len(places) <= most:
            return [float(f"{place * width:.12g}") for place in places]
    return [low, high]
