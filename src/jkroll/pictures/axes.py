"""Axes of maps and curves: the range of a quantity, its ticks, and round values for contours.

An axis is logarithmic or linear. A place on it is a fraction of its length.
"""

from collections.abc import Callable, Mapping
from math import ceil, floor, log10
from types import MappingProxyType
from typing import Any, NamedTuple

from ..quantities.formatting import engineering, pretty
from ..quantities.nomenclature import NOMENCLATURE, Quantity, header
from ..quantities.units import convert, parse_unit

# The axes of figures that are no quantities of a scene.
_OF_FIGURES: Mapping[str, Quantity] = {
    "position_across": Quantity("x", "m", "position from the contact point"),
    "position_beside": Quantity("y", "m", "position perpendicular to the rolling direction"),
    "pressure_across": Quantity("p", "Pa", "pressure, tension negative"),
    "time_of_a_point": Quantity("t", "s", "time of a point"),
    "error": Quantity("ulp/(1+κ)", "", "error"),
}
_SUPERSCRIPTS = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")
_FEW_DECADES = 1e8  # so long an axis has room for small ticks in each decade
_STEPS = (1, 2, 5)  # of a decade that has few ticks


class Tick(NamedTuple):
    """A marked value and its label."""

    value: float
    text: str


class Axis(NamedTuple):
    """A quantity of the nomenclature, or one that only figures have, between two values."""

    name: str
    low: float
    high: float
    is_log: bool = True
    size: int = 0  # number of values; 0: the picture's default
    beside: Mapping[str, float] = MappingProxyType({})  # inputs that a value of this one needs

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
        """Return the values as an array, equally spaced along the axis."""
        import numpy

        spaced = numpy.geomspace if self.is_log else numpy.linspace
        return spaced(self.low, self.high, self.size)

    def place(self, value: Any) -> Any:
        """Return the place of a value: 0 at the low end, 1 at the high end."""
        if not self.is_log:
            return (value - self.low) / (self.high - self.low)
        import numpy

        return (numpy.log10(value) - log10(self.low)) / (log10(self.high) - log10(self.low))

    def value(self, place: Any) -> Any:
        """Return the value at a place."""
        if not self.is_log:
            return self.low + (self.high - self.low) * place
        return self.low * (self.high / self.low) ** place

    def ticks(self, most: int) -> list[Tick]:
        """Return at most `most` labelled ticks at round values."""
        values = round_values(self.low, self.high, most, is_log=self.is_log)
        texts, _ = in_units(self.name, values, is_log=self.is_log)
        return [Tick(value, text) for value, text in zip(values, texts, strict=True)]

    def small_ticks(self, most: int) -> list[float]:
        """Return the values of the unlabelled ticks, of which the labelled ones are some.

        They are 2 to 9 of each decade, or the decades of a long axis; on a linear axis a quarter or a fifth of the way
        between `most` labelled ticks.
        """
        if not self.is_log:
            first, second = round_values(self.low, self.high, most, is_log=False)[:2]
            step = (second - first) / (4 if f"{second - first:e}".startswith("2") else 5)
            return [place * step for place in range(ceil(self.low / step), floor(self.high / step) + 1)]
        decades = range(floor(log10(self.low)), ceil(log10(self.high)))
        digits = range(2, 10) if self.high / self.low < _FEW_DECADES else (1,)
        values = (float(f"{digit}e{decade}") for decade in decades for digit in digits)
        return [value for value in values if self.low <= value <= self.high]

    def label(self, most: int = 8) -> str:
        """Return the title of the axis, with the unit if its ticks have none."""
        _, unit = in_units(self.name, [tick.value for tick in self.ticks(most)], is_log=self.is_log)
        return described(self.name, unit)


def quantity_of(name: str) -> Quantity:
    """Return the meaning of the name of an axis."""
    return _OF_FIGURES.get(name) or NOMENCLATURE[name]


def described(name: str, unit: str) -> str:
    """Return a quantity as the title of an axis.

    >>> described("load", "nN")
    'load, tension negative, P [nN]'
    """
    quantity = quantity_of(name)
    return f"{quantity.sentence}, {quantity.symbol}{bracketed(unit)}"


def bracketed(unit: str) -> str:
    """Return a unit as it stands behind a symbol, in brackets; empty for a number."""
    return f" [{unit}]" if unit not in ("", "1") else ""


def round_values(low: float, high: float, most: int, *, is_log: bool) -> list[float]:
    """Return at most `most` round values between two: powers of ten, or 1, 2 and 5 times them, or equal steps.

    >>> round_values(1e-9, 1e-6, 5, is_log=True), round_values(-1.0, 1.0, 5, is_log=False)
    ([1e-09, 1e-08, 1e-07, 1e-06], [-1.0, -0.5, 0.0, 0.5, 1.0])
    >>> round_values(-300.0, 600.0, 5, is_log=False)
    [-200.0, 0.0, 200.0, 400.0, 600.0]
    """
    if is_log:
        decades = range(ceil(log10(low) - 1e-9), floor(log10(high) + 1e-9) + 1)
        if len(decades) > 2 or high / low > 50:
            step = ceil(len(decades) / most)
            return [float(f"1e{decade}") for decade in decades if decade % step == 0]
        steps = [float(f"{digit}e{decade}") for decade in range(decades.start - 1, decades.stop) for digit in _STEPS]
        found = [value for value in steps if low * (1 - 1e-9) <= value <= high * (1 + 1e-9)]
        if 2 < len(found) <= most:
            return found
    if not high > low:
        return [low]
    rough = (high - low) / most
    decade = floor(log10(rough))
    factor = next(factor for factor in (1, 2, 5, 10, 20) if float(f"{factor}e{decade}") * most >= high - low)
    width = float(f"{factor}e{decade}")
    places = range(ceil(low / width - 1e-9), floor(high / width + 1e-9) + 1)
    values = [float(f"{place * width:.12g}") for place in places]
    if len(values) < 2 and most < 64:
        return round_values(low, high, 2 * most, is_log=False)
    step = ceil(len(values) / most)
    rounder = [value for place, value in zip(places, values, strict=True) if place % step == 0]  # 0 is among them
    return rounder if len(rounder) > 1 else values[::step]


def contour_values(low: float, high: float, most: int, *, is_log: bool) -> list[float]:
    """Return at most `most` values for contours: 1, 2 and 5 times powers of ten where they fit, else as `round_values` does.

    >>> contour_values(1e-9, 1e-8, 12, is_log=True), contour_values(1.0, 1e6, 12, is_log=True)[:3]
    ([1e-09, 2e-09, 5e-09, 1e-08], [1.0, 10.0, 100.0])
    """
    if is_log:
        decades = range(floor(log10(low)), ceil(log10(high)) + 1)
        values = [float(f"{digit}e{decade}") for decade in decades for digit in _STEPS]
        found = [value for value in values if low <= value <= high]
        if len(found) <= most:
            return found
    return round_values(low, high, most, is_log=is_log)


def in_units(name: str, values: list[float], largest: float = 0.0, *, is_log: bool) -> tuple[list[str], str]:
    """Return values as text, and the unit of them all: on a logarithmic scale empty where each has its own.

    >>> in_units("radius", [1e-9, 1e-7], is_log=True), in_units("density", [10.0, 1000.0], is_log=True)
    ((['1 nm', '100 nm'], ''), (['10', '1000'], 'kg/m³'))
    """
    if not is_log:
        return in_one_unit(name, values, largest)
    texts = with_units(name, values)
    return texts, "" if any(" " in text for text in texts) else pretty(quantity_of(name).unit)


def with_units(name: str, values: list[float]) -> list[str]:
    """Return values as text, each with the prefix that fits it; powers of ten where one has none.

    >>> with_units("radius", [1e-9, 1e-7]), with_units("n_grav", [1000.0, 1e6])
    (['1 nm', '100 nm'], ['1000', '10⁶'])
    """
    unit = quantity_of(name).unit

    def texts(digits: int) -> list[str]:
        found = []
        for value in values:
            number, shown = engineering(value, unit, digits)
            is_fitting = unit not in ("", "1") and (shown != unit or 1 <= abs(value) < 1000)
            found.append(f"{number} {pretty(shown)}" if is_fitting else power_of_ten(value))
        return found if all(" " in text for text in found) else [power_of_ten(value) for value in values]

    return _distinct(texts)


def in_one_unit(name: str, values: list[float], largest: float = 0.0) -> tuple[list[str], str]:
    """Return values as text in the unit whose prefix fits the largest of them, or a larger one, and that unit.

    >>> in_one_unit("load", [-1e-8, 0.0, 1e-8])
    (['-10', '0', '10'], 'nN')
    """
    largest = max([*values, largest], key=abs)
    unit = engineering(largest, quantity_of(name).unit, 3)[1]
    is_plain = unit in ("", quantity_of(name).unit)
    shown = values if is_plain else [convert(value, parse_unit(unit)) for value in values]
    return _distinct(lambda digits: [f"{value:.{digits}g}" for value in shown]), pretty(unit)


def _distinct(texts: Callable[[int], list[str]]) -> list[str]:
    """Return the texts of values with six digits, or with as many as make them differ."""
    return next((found for digits in range(6, 16) if len({*(found := texts(digits))}) == len(found)), texts(16))


def power_of_ten(value: float) -> str:
    """Return a value as text, as a power of ten where it is large or small.

    >>> power_of_ten(1e9), power_of_ten(0.01), power_of_ten(2e6)
    ('10⁹', '0.01', '2·10⁶')
    """
    if value == 0 or 1e-3 <= abs(value) < 1e4:
        return f"{value:g}"
    mantissa, _, exponent = f"{value:.3e}".partition("e")
    factor = mantissa.rstrip("0").rstrip(".")
    power = "10" + str(int(exponent)).translate(_SUPERSCRIPTS)
    return power if factor == "1" else f"{factor}·{power}"
