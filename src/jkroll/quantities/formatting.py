"""Values as text: rounded, with a suitable prefix of the unit and with their uncertainty."""

import re
from collections.abc import Collection, Iterable, Mapping, Sequence
from math import floor, isinf, log10
from typing import NamedTuple

from ..text import first_of
from .nomenclature import INFINITY, NOMENCLATURE, header
from .units import RAISED, Unit, convert, power_of_ten
from .values import Measured, Uncertain, ends_of, middle, normalized_value

DIGITS = 6  # significant digits of a rounded value
RESULT_DIGITS = 4  # digits of a result in a table for readers
ROUND_DIGITS = 12  # digits that show a round value in full, but not its rounding error
_PLAIN = 10**DIGITS  # numbers from 1 to less than this one are written without an exponent
_ERRORS = 1e-14  # on a linear scale, a number below this fraction of the largest is written as 0
_NARROW = 0.05  # relative width; the ends of a narrower range have three digits
_PREFIXES = dict(
    zip(range(-24, 18, 3), ("y", "z", "a", "f", "p", "n", "µ", "m", "", "k", "M", "G", "T", "P"), strict=True)
)
_KNOWN = range(-12, 10)  # powers of ten written as a prefix in texts
_ON_AXES = range(-15, 13)  # powers of ten written as a prefix on axes, from f to T
# SI units that take a prefix
WITH_PREFIXES = ("m", "s", "N", "J", "Pa", "Hz", "rad", "m/s", "N m", "N/m", "J/m^2", "N m/rad")


class ShownUnit(NamedTuple):
    """A unit with its name in a text for readers."""

    text: str
    unit: Unit

    def convert(self, value: float) -> float:
        """Return the number of an SI value in this unit."""
        return convert(value, self.unit)


class Format:
    """The units and digits of written values, and the texts of inputs as typed."""

    def __init__(
        self,
        units: Mapping[str, ShownUnit] | None = None,  # by quantity: the unit to convert to
        digits: int | None = None,
        typed: Mapping[str, str] | None = None,  # inputs as typed; an empty text if an input has several values
    ) -> None:
        self.units, self.digits, self.typed = units or {}, digits, typed or {}

    def with_digits(self, digits: int) -> "Format":
        """Return a format with the same units, without typed inputs, and with a number of digits unless one is set."""
        return Format(self.units, self.digits or digits)

    def unit(self, name: str) -> str:
        """Return the unit of a quantity in output for programs."""
        return self.units[name].text if name in self.units else NOMENCLATURE[name].unit

    def changes(self, name: str) -> bool:
        """Return whether the numbers of a quantity are rounded, or converted to a chosen unit."""
        return name in self.units or self.digits is not None

    def number(self, name: str, value: float) -> float:
        """Return the number to write for an SI value: in its unit, with its digits."""
        if name in self.units:
            value = self.units[name].convert(value)
        value += 0.0  # -0.0 becomes 0.0
        return value if self.digits is None else float(f"{value:.{self.digits}g}")

    def header(self, name: str) -> str:
        """Return a column header: name and unit."""
        return header(name, self.unit(name))

    def rounded(self, name: str, value: float | str | Uncertain) -> tuple[str, str]:
        """Return a rounded value with any uncertainty, and its unit with a suitable prefix; a word has no unit."""
        if not isinstance(value, Uncertain):
            value = in_words(name, value)
        if isinstance(value, str):
            return value, ""
        unit = self.common_unit(name, [value])
        return self.in_unit(value, unit), unit.text

    def common_unit(self, name: str, values: Sequence[float | str | Uncertain | None]) -> ShownUnit:
        """Return the chosen unit of a quantity, or else that which suits the median of values; words are ignored."""
        if name in self.units:
            return self.units[name]
        si = NOMENCLATURE[name].unit
        sizes = _sizes(values)
        if si in ("", "1") or not sizes:
            return ShownUnit(pretty(si.removeprefix("1")), (1, 1, ()))
        power = _power(sizes[(len(sizes) - 1) // 2], si, self.digits or DIGITS)
        return ShownUnit(pretty(_multiple(si, power)), (*power_of_ten(power), ()))

    def in_unit(self, value: float | Uncertain, unit: ShownUnit) -> str:
        """Return a rounded value in a unit, with its uncertainty if it has one, without the name of the unit."""
        if isinstance(value, Measured):
            numbers = value.value, value.minus, value.plus
            return _plus_minus(*map(unit.convert, numbers))
        ends = [significant(unit.convert(end), self.digits or DIGITS) for end in ends_of(value)]
        return " to ".join(dict.fromkeys(ends))


def _sizes(values: Sequence[float | str | Uncertain | None]) -> list[float]:
    """Return the sorted sizes of values; 0, infinity, words and None are left out."""
    sizes = []
    for value in values:
        if value is not None and not isinstance(value, str):
            size = abs(middle(value))
            if size and not isinf(size):
                sizes.append(size)
    return sorted(sizes)


def _multiple(unit: str, power: int) -> str:
    """Return a unit times a power of ten: with a prefix if it is well known, otherwise with the power itself."""
    return _PREFIXES[power] + unit.removeprefix("1") if power in _KNOWN else f"1e{power} {unit}"


def _power(value: float, unit: str, digits: int) -> int:
    """Return the power of ten of the prefix that suits a value, rounded to significant digits; 0 without a prefix."""
    exponent = f"{value:.{digits - 1}e}".partition("e")[2]
    power = 3 * (int(exponent or 0) // 3)
    return power if unit in WITH_PREFIXES and power in _PREFIXES else 0


def significant(value: float, digits: int, *, zeros: bool = False) -> str:
    """Return a number rounded to significant digits; from 1 to a million it has no exponent.

    `zeros`: True to keep trailing zeros.
    >>> significant(2600.0, 3), significant(1234567.0, 3), significant(5.0, 3, zeros=True)
    ('2600', '1.23e6', '5.00')
    """
    text = f"{value:{'#' if zeros else ''}.{digits}g}".removesuffix(".")
    mantissa, has_exponent, exponent = text.partition("e")
    if not has_exponent:
        return text
    return f"{float(text):.0f}" if 1 <= abs(value) < _PLAIN else f"{mantissa}e{int(exponent)}"


def with_unit(number: str, unit: str) -> str:
    """Return the text of a number, a range or an uncertain value with its unit, which may include a power of ten.

    >>> with_unit("11.8", "nN"), with_unit("1.50", "1e-18 J"), with_unit("1–3", "1e-18 J"), with_unit("7", "")
    ('11.8 nN', '1.50e-18 J', '(1–3)e-18 J', '7')
    """
    if not unit.startswith("1e"):
        return f"{number} {unit}".strip()
    if not number.lstrip("-").replace(".", "").isdecimal():
        number = f"({number})"
    return f"{number}{unit.removeprefix('1')}"


def pretty(unit: str) -> str:
    """Return a unit with superscripts.

    >>> pretty("mJ/m^2"), pretty("m^-1")
    ('mJ/m²', 'm⁻¹')
    """
    return unit.replace("^2", "²").replace("^3", "³").replace("^-1", "⁻¹") if "^" in unit else unit


AS_USUAL = Format()


def amount(name: str, value: float | str | Uncertain, form: Format = AS_USUAL) -> str:
    """Return a value for a sentence, with its unit and any uncertainty; a typed input is returned as typed.

    >>> amount("yield_displacement", 2e-10)
    '200 pm'
    >>> from jkroll.quantities.values import value_of
    >>> texts = ("25±5 mJ/m2", "25 +6/-4 mJ/m2", "20 to 30 mJ/m2")
    >>> [amount("surface_energy", value_of(text, "surface_energy")) for text in texts]
    ['25.0 ± 5.0 mJ/m²', '25.0 +6.0/-4.0 mJ/m²', '20 to 30 mJ/m²']
    """
    typed = form.typed.get(name)
    return typed or with_unit(*form.rounded(name, value))


# Replacements that turn a typed value into a printed one: a space after the number, but none before a power of ten.
_AS_WRITTEN = {
    r" ?± ?": " ± ",
    r"(?<=[0-9.)])(?![eE][-+]?[0-9])(?=[^\W\d_]|[%°])": " ",
    r"\bangstroms?\b": "Å",
    r"\bu(?=[mgsNJP])": "µ",
}
_TYPED_POWER = r"(?<=[A-DF-Za-df-z])(?:\^|\*\*)?(-?[0-9]+)"


def as_typed(text: str) -> str:
    """Return a typed value with its unit as printed; a word is unchanged.

    >>> as_typed("2angstrom"), as_typed("0.03 J/m^2"), as_typed("1um"), as_typed("40%"), as_typed("plane")
    ('2 Å', '0.03 J/m²', '1 µm', '40 %', 'plane')
    >>> as_typed("25±5mJ/m2"), as_typed("25(5)mJ/m2"), as_typed("100nm +/- 5%"), as_typed("20 to 30 mJ/m2")
    ('25 ± 5 mJ/m²', '25(5) mJ/m²', '100 nm ± 5 %', '20 to 30 mJ/m²')
    """
    text = normalized_value(" ".join(text.split()))
    for typed, as_written in _AS_WRITTEN.items():
        text = re.sub(typed, as_written, text)
    return re.sub(_TYPED_POWER, lambda power: power[1].translate(RAISED), text)


def span(name: str, low: float, high: float, form: Format = AS_USUAL) -> str:
    """Return a range with its unit, for a sentence; see `from_to`.

    >>> span("pull_off_force", 1.437e-8, 1.5e-8), span("pull_off_force", 3.97e-7, 3.995e-7)
    ('14.4–15.0 nN', '397–400 nN')
    >>> span("sticking_speed", 0.6, 6.0), span("yield_force", 6.9e-10, 1.57e-9)
    ('0.6–6 m/s', '0.69–1.6 nN')
    >>> span("well_energy", 1e-18, 3e-18), span("atomic_spacing", 4e-10, 4e-10)
    ('(1–3)e-18 J', '400 pm')
    """
    unit = form.common_unit(name, [high if high > 0 else low])
    return with_unit(from_to(unit.convert(low), unit.convert(high), form.digits), unit.text)


def from_to(low: float, high: float, digits: int | None = None) -> str:
    """Return the text of a range; a single number if its ends are equal even with one more digit.

    The ends have two digits, or three if the range is narrow, unless `digits` is given.
    >>> from_to(14.37, 15.0), from_to(-1.0, 2.0), from_to(3.0, 3.0), from_to(1.02e6, 1.31e6), from_to(397.0, 399.5)
    ('14.4–15.0', '-1 to 2', '3', '(1.0–1.3)e6', '397–400')
    """
    if digits is None:
        digits = 3 if 0 < abs(high - low) < _NARROW * abs(high) else 2
    shift = _shift(max(abs(low), abs(high)))
    ends = low * 10.0**-shift, high * 10.0**-shift
    texts = _distinct(ends, digits)
    if low != high and len(texts) == 1:
        texts = _distinct(ends, digits + 1)
    text = (" to " if low < 0 else "–").join(texts)
    if not shift:
        return text
    return f"({text})e{shift}" if len(texts) > 1 else f"{text}e{shift}"


def _distinct(ends: Iterable[float], digits: int) -> list[str]:
    """Return the distinct ends of a range, rounded. Trailing zeros are dropped only if every end has them."""
    short, full = [], []
    for end in ends:
        short.append(significant(end, digits))
        full.append(significant(end, digits, zeros=end != 0))
    all_have_zeros = all(text != other for text, other in zip(short, full, strict=True))
    return [*dict.fromkeys(short if all_have_zeros else full)]


def _shift(size: float) -> int:
    """Return the power of ten to write after numbers of a size; 0 if they read well without one."""
    return 0 if size == 0 or 1e-3 <= size < 1e6 else floor(log10(size))


def _plus_minus(value: float, minus: float, plus: float) -> str:
    """Return a value with its standard uncertainty.

    The smaller side of the uncertainty that is not 0 has two digits, and all numbers end at the same decimal
    place. If the two sides differ, both are shown.
    """
    shift = _shift(abs(value))
    numbers = [number * 10.0**-shift for number in (value, minus, plus)]
    middle, below, above = rounded_at_error(numbers, min(filter(None, numbers[1:])))
    text = f"{middle} ± {above}" if above == below else f"{middle} +{above}/-{below}"
    return f"({text})e{shift}" if shift else text


def in_words(name: str, value: float | str) -> float | str:
    """Return the word for an infinite value, or any other value unchanged.

    >>> in_words("radius2", float("inf")), in_words("radius2", 1e-7)
    ('plane', 1e-07)
    """
    if value != INFINITY:
        return value
    return NOMENCLATURE[name].infinity or "infinite"


def texts_on_scale(
    unit: str, values: Sequence[float], digits: int = ROUND_DIGITS, *, is_log: bool
) -> tuple[list[str], str]:
    """Return the values on a scale, such as an axis, as texts, and their common unit.

    The common unit is empty if each text has a unit, or needs none.
    On a logarithmic scale, all texts have the same form: numbers with prefixed units, with exponents, or with neither.
    >>> texts_on_scale("Hz", [1e9, 1e12], is_log=True), texts_on_scale("J", [1e-18, 1e-15], is_log=True)
    ((['1 GHz', '1 THz'], ''), (['1e-18', '1e-15'], 'J'))
    >>> texts_on_scale("1", [0.01, 1000.0], is_log=True), texts_on_scale("1", [1000.0, 2e6], is_log=True)
    ((['0.01', '1000'], ''), (['1e3', '2e6'], ''))
    >>> texts_on_scale("kg/m^3", [10.0, 1000.0], is_log=True), texts_on_scale("N", [-1e-8, 0.0, 1e-8], is_log=False)
    ((['10', '1000'], 'kg/m³'), (['-10', '0', '10'], 'nN'))
    """
    if not is_log:
        return _on_linear_scale(unit, values, digits)
    texts = []
    if unit in WITH_PREFIXES and all(_power(value, unit, digits) in _ON_AXES for value in values):
        for value in values:
            power = _power(value, unit, digits)
            number = significant(convert(value, (*power_of_ten(power), ())), digits)
            texts.append(f"{number} {pretty(_PREFIXES[power] + unit)}")
        return texts, ""
    digits = min(digits, DIGITS)  # without prefixes, six digits show round values in full
    texts = [significant(value, digits) for value in values]
    if "e" in "".join(texts):
        texts = [_with_exponent(value, digits) for value in values]
    return texts, pretty(unit.removeprefix("1"))


def _on_linear_scale(unit: str, values: Sequence[float], digits: int) -> tuple[list[str], str]:
    """Return the values on a linear scale as texts, and the unit that suits the largest of them."""
    largest = max(map(abs, values), default=0.0)
    power = _power(largest, unit, 3)
    scale = (*power_of_ten(power), ())
    texts = []
    for value in values:
        exceeds_errors = abs(value) > _ERRORS * largest
        texts.append(significant(convert(value if exceeds_errors else 0.0, scale), digits))
    return texts, pretty(_multiple(unit, power))


def _with_exponent(value: float, digits: int) -> str:
    """Return a rounded number with an exponent; 0 has none."""
    if not value:
        return "0"
    mantissa, _, exponent = f"{value:.{digits - 1}e}".partition("e")
    if "." in mantissa:
        mantissa = mantissa.rstrip("0").rstrip(".")
    return f"{mantissa}e{int(exponent)}"


def first_symbols(names: list[str]) -> str:
    """Return the symbols of the first names in a list, and the number of the others."""
    return first_of([*map(symbol_of, names)])


def symbol_among(name: str, inputs: Collection[str]) -> str:
    """Return the symbol of a quantity, without the index of sphere 1 if sphere 2 has no value of its own among inputs.

    The radius keeps its index.
    """
    quantity, symbol = NOMENCLATURE[name], symbol_of(name)
    if quantity.sphere == 1 and quantity.twin not in inputs and name != "radius":
        return symbol.removesuffix("1")
    return symbol


def symbol_of(name: str) -> str:
    """Return the symbol of a quantity, or its name if it has none."""
    return NOMENCLATURE[name].symbol or name


def rounded_at_error(numbers: Iterable[float], error: float) -> list[str]:
    """Return numbers as texts, rounded at the second digit of an error.

    >>> rounded_at_error([61.7234, 0.24], 0.24), rounded_at_error([1749.6, -55.0], 190.0)
    (['61.72', '0.24'], ['1750', '-60'])
    """
    last = int(f"{error:.1e}".partition("e")[2]) - 1  # the power of ten of the second digit
    return [f"{round(number, -last) + 0.0:.{max(-last, 0)}f}" for number in numbers]  # + 0.0 makes a rounded -0 a 0
