"""Conversion of texts that users type to SI numbers: a strict grammar and exact arithmetic.

A text is one decimal number and a unit. Its value is computed as a ratio of integers and rounded to a double once. The
text may state an uncertainty, as in 25±5 mJ/m2, 25(5) mJ/m2, 25 mJ/m2 ± 20% and 20 to 30 mJ/m2: the value is then
`Measured` or an `Interval`.
"""

import re
from collections.abc import Callable, Mapping, Sequence
from contextlib import suppress
from functools import partial
from importlib import import_module
from math import isnan, nan
from typing import Any, Self, TypeGuard

from ..errors import BadRequest, JkrollError
from ..text import quoted, shown
from .nomenclature import INFINITY, NOMENCLATURE
from .units import (
    MAX_TEXT,
    SUPERSCRIPTS,
    BadUnit,
    Dimension,
    Unit,
    dimension_of,
    kind_of,
    normalized,
    parse_unit,
    power_of_ten,
)

# --- Invalid values ---------------------------------------------------------------------------------------------------

NO_UNIT = "has no unit"


class QuantityError(JkrollError):
    """Error raised for a text or a number that is not a value of its quantity."""

    def __init__(self, name: str, value: object, mistake: str, remedy: str = "", position: Sequence[int] = ()) -> None:
        """`mistake`: words to follow the value; `remedy`: what to type instead, by default an example.

        `position`: the index of a number in an array.
        """
        super().__init__(name, value, mistake, remedy, tuple(position))
        self.name, self.value, self.mistake, self.remedy, self.position = name, value, mistake, remedy, tuple(position)
        self.phrase = f"bad {name}"

    def problem(self) -> str:
        """Return the mistake and the remedy, without the name and the value."""
        remedy = self.remedy
        if not remedy and isinstance(self.value, str):
            remedy = f"expected {_expectation(self.name)}"
        return f"{self.mistake}; {remedy}" if remedy else self.mistake

    def __str__(self) -> str:
        value = quoted(self.value) if isinstance(self.value, str) else repr(self.value)
        where = f" at index {', '.join(map(str, self.position))}" if self.position else ""
        return f"{self.name}: {value}{where} {self.problem()}"


def _expectation(name: str) -> str:
    """Return the kind of value that a quantity accepts, with an example or its unit.

    >>> _expectation("radius2"), _expectation("stiffness")
    ('a length such as 1um, or plane', 'a value in N/m')
    """
    quantity = NOMENCLATURE[name]
    expected = "a number" if quantity.unit == "1" else f"a value in {quantity.unit}"
    if quantity.example:
        expected = f"{kind_of(dimension_of(quantity.unit))} such as {quantity.example}"
    return f"{expected}, or {quantity.infinity}" if quantity.infinity else expected


# --- Values with an uncertainty ---------------------------------------------------------------------------------------


class Uncertain:
    """A value in SI units with an uncertainty. `sides`: its two sides by name, below the value and above it."""

    kind = ""
    value: Any
    sides: dict[str, Any]

    @classmethod
    def of(cls, value: Any, **sides: Any) -> Self:
        """Return an uncertain value from numbers or arrays without checking them."""
        uncertain = cls.__new__(cls)
        uncertain.value, uncertain.sides = value, sides
        return uncertain

    @property
    def low(self) -> Any:
        """The lower end, or the value minus its uncertainty."""
        raise NotImplementedError

    @property
    def high(self) -> Any:
        """The upper end, or the value plus its uncertainty."""
        raise NotImplementedError

    def changed(self, change: Callable[[Any], Any]) -> Self:
        """Return the value after a proportional change, such as another unit or a factor."""
        changed = self.of(change(self.value), **{side: change(number) for side, number in self.sides.items()})
        return changed._swapped() if change(1.0) < 0 else changed

    def _swapped(self) -> Self:
        """Return the value with its sides in order again after a change of sign."""
        raise NotImplementedError

    def _shifted(self, number: float) -> Self:
        """Return the sum of the value and a number."""
        raise NotImplementedError

    def __add__(self, other: Any) -> Any:
        return self._shifted(other) if _is_exact(other) else NotImplemented

    def __sub__(self, other: Any) -> Any:
        return self._shifted(-other) if _is_exact(other) else NotImplemented

    def __rsub__(self, other: Any) -> Any:
        return (-self)._shifted(other) if _is_exact(other) else NotImplemented

    def __mul__(self, other: Any) -> Any:
        return self.changed(lambda number: number * other) if _is_exact(other) else NotImplemented

    def __truediv__(self, other: Any) -> Any:
        return self.changed(lambda number: number / other) if _is_exact(other) else NotImplemented

    def __neg__(self) -> Self:
        return self.changed(lambda number: -number)

    __radd__, __rmul__ = __add__, __mul__

    def __eq__(self, other: object) -> bool:
        return type(other) is type(self) and vars(other) == vars(self)

    def __hash__(self) -> int:
        return hash((self.value, *self.sides.values()))

    def __repr__(self) -> str:
        sides = ", ".join(f"{side}={number!r}" for side, number in self.sides.items())
        return f"{type(self).__name__}(value={self.value!r}, {sides})"


class Measured(Uncertain):
    """A value in SI units with a standard uncertainty; a side that is not given equals the other.

    >>> Measured(0.025, 0.005)
    Measured(value=0.025, minus=0.005, plus=0.005)
    """

    kind = "standard"

    def __init__(self, value: float, minus: float | None = None, plus: float | None = None) -> None:
        """Raise BadRequest for anything but numbers, and for a negative or missing uncertainty."""
        if minus is None and plus is None:
            raise BadRequest("Measured: the uncertainty is missing; write Measured(0.025, 0.005)")
        self.value = _checked_number("Measured", value)
        below = _checked_number("Measured", plus if minus is None else minus)
        above = _checked_number("Measured", minus if plus is None else plus)
        if min(below, above) < 0:
            raise BadRequest(f"Measured: {min(below, above)!r} is a negative uncertainty")
        self.sides = {"minus": below, "plus": above}

    def ufloat(self) -> Any:
        """Return the number as a `ufloat` of the package `uncertainties`. Raises BadRequest if the two sides differ."""
        if self.minus != self.plus:
            raise BadRequest(f"Measured: {self.minus!r} and {self.plus!r} differ; a ufloat has one uncertainty")
        return import_module("uncertainties").ufloat(self.value, self.plus)

    @property
    def minus(self) -> Any:
        """The uncertainty below the value."""
        return self.sides["minus"]

    @property
    def plus(self) -> Any:
        """The uncertainty above the value."""
        return self.sides["plus"]

    @property
    def low(self) -> Any:
        """The value minus its uncertainty."""
        return self.value - self.minus

    @property
    def high(self) -> Any:
        """The value plus its uncertainty."""
        return self.value + self.plus

    def _swapped(self) -> Self:
        return self.of(self.value, minus=-self.plus, plus=-self.minus)

    def _shifted(self, number: float) -> Self:
        return self.of(self.value + number, **self.sides)


class Interval(Uncertain):
    """A range of possible values in SI units, and a value within it.

    >>> Interval(0.025, 0.02, 0.03).sides
    {'low': 0.02, 'high': 0.03}
    """

    kind = "range"

    def __init__(self, value: float, low: float, high: float) -> None:
        """Raise BadRequest for anything but numbers, for ends in the wrong order, or a value outside them."""
        self.value, low, high = [_checked_number("Interval", number) for number in (value, low, high)]
        if not low <= self.value <= high:
            raise BadRequest(f"Interval: {self.value!r} does not lie in the range from {low!r} to {high!r}")
        self.sides = {"low": low, "high": high}

    @property
    def low(self) -> Any:
        """The lower end."""
        return self.sides["low"]

    @property
    def high(self) -> Any:
        """The upper end."""
        return self.sides["high"]

    def _swapped(self) -> Self:
        return self.of(self.value, low=self.high, high=self.low)

    def _shifted(self, number: float) -> Self:
        return self.of(self.value + number, low=self.low + number, high=self.high + number)


def _is_exact(other: object) -> bool:
    """Return whether a value is a number; raise BadRequest if it is uncertain."""
    if isinstance(other, Uncertain):
        remedy = "pass the inputs to solve(), which combines them; independent ± may also be added as ufloat()"
        raise BadRequest(f"two uncertain values are not assumed to be independent; {remedy}")
    return isinstance(other, int | float) and not isinstance(other, bool)


def _checked_number(owner: str, value: object) -> float:
    """Return a number as a float; raise BadRequest for anything else."""
    may_have_unit = any(hasattr(value, word) for word in ("attrs", "dims", "unit", "units"))
    dtype = getattr(value, "dtype", None)
    is_real = not isinstance(value, bool) and getattr(dtype, "kind", "f") in "fiu"  # not numpy's duration, for example
    number = nan
    if hasattr(value, "__float__") and is_real and not may_have_unit:
        with suppress(TypeError, ValueError, OverflowError):
            number = float(value)
    if isnan(number):
        problem = f"{quoted(str(value))} is not a number in SI units"
        raise BadRequest(f"{owner}: {problem}; a text with a unit, such as '25±5 mJ/m2', needs no {owner}()")
    return number


def is_uncertain(value: Any) -> TypeGuard[Uncertain]:
    """Return whether a value has an uncertainty."""
    return isinstance(value, Uncertain)


def middle(value: Any) -> Any:
    """Return an uncertain value without its uncertainty, or any other value unchanged."""
    return value.value if is_uncertain(value) else value


def ends_of(value: Any) -> tuple[Any, Any]:
    """Return the ends of an uncertain value; for any other value, the value twice."""
    return (value.low, value.high) if is_uncertain(value) else (value, value)


def with_sides(value: float, sides: Mapping[str, float]) -> float | Uncertain:
    """Return a value with those sides of its uncertainty that are not nan; without any, the value alone."""
    known = {side: number for side, number in sides.items() if not isnan(number)}
    if not known:
        return value
    return Interval(value, **known) if "low" in known else Measured(value, **known)


# --- Texts to numbers -------------------------------------------------------------------------------------------------

_Decimal = tuple[int, int]  # an integer and a power of ten
_UnitIn = Callable[[str], Unit]  # returns the unit that a text means; an empty text means the default unit, if any
_NUMBER = re.compile(r"([+-]?)([0-9]*)(?:\.([0-9]*))?(?:[eE]([+-]?[0-9]+))?")
_LETTER_AND_DIGITS = re.compile(r"([^\W\d_])([+-]?[0-9]+)")  # refused after a number: d1 in 1.25d1, but also m2 in 5m2
# The text after a number, if it has a second number: -6 nm in 5-6 nm, nm-6nm in 5nm-6nm
_SECOND = re.compile(r" ?(?:[-–—…] ?)+[0-9]| ?([^-–—…]+?) ?[-–—…] ?[0-9.]+ ?\1$")
_MARKS = ("±", "(", "+-", "+−", "/-", "/−", "/ -", "/ −", " to ")  # /- occurs in +/- and in +6/-4


def parse_quantity(text: str, name: str) -> float:
    """Return the value of a quantity in SI units from a text without an uncertainty, correctly rounded.

    >>> parse_quantity("0.1 µm", "radius")
    1e-07

    Raises a `QuantityError` that names the quantity, quotes the text and shows the right form.
    """
    value = value_of(text, name)
    if isinstance(value, float):
        return value
    raise QuantityError(name, text, "has an uncertainty: give the value alone")


def value_of(text: str, name: str, unit: Unit | None = None) -> float | Uncertain:
    """Return the value of a quantity in SI units from a text, with its uncertainty if it states one.

    >>> value_of("25±5 mJ/m2", "surface_energy")
    Measured(value=0.025, minus=0.005, plus=0.005)
    >>> value_of("20 to 30 nm", "radius")
    Interval(value=2.5e-08, low=2e-08, high=3e-08)

    `unit`: the default unit. Raises a `QuantityError` that names the quantity and says what to write instead.
    """
    quantity = NOMENCLATURE[name]
    if quantity.infinity and text.strip().lower() in (quantity.infinity, "inf", "infinity", "∞"):
        return INFINITY
    try:
        value = _read(normalized_value(text), partial(_unit_in, dimension=dimension_of(quantity.unit), default=unit))
    except BadUnit as error:
        raise _error_about(name, text, error) from None
    return checked(value, name, text)


def checked(value: float | Uncertain, name: str, text: str) -> float | Uncertain:
    """Return a value if its quantity accepts it, without an uncertainty of 0; else raise QuantityError."""
    limits = NOMENCLATURE[name].range
    if not limits.admits(middle(value)):
        raise QuantityError(name, text, limits.words)
    if isinstance(value, float):
        return value
    if isinstance(value, Measured) and limits.low == 0 and 2 * value.minus >= value.value:
        raise QuantityError(name, text, "has an uncertainty of half the value or more", "give a range: FROM to TO")
    if not (limits.admits(value.low) and limits.admits(value.high)):
        raise QuantityError(name, text, f"{limits.words} at both ends")
    return value.value if isinstance(value, Measured) and value.minus == value.plus == 0 else value


# These patterns are compiled on first use, since few texts need them and compiling takes as long as reading a material.
_POWER_OF_TEN = r"(?<=[0-9.)]) ?[*x] ?10(?:(?:\^|\*\*)\^?([+-]?[0-9]{1,3})|\^?([⁺⁻]?[⁰¹²³⁴⁵⁶⁷⁸⁹]{1,3}))(?![0-9])"
_TWO_POWERS = r"([+-]?[0-9.]+) ?(±|\+[0-9.]+ ?/ ?-) ?([0-9.]+)([eE][+-]?[0-9]+)"


def normalized_value(text: str) -> str:
    """Return a text with uniform signs, uncertainties and powers of ten. Raises a `BadUnit` for an ambiguous text.

    >>> normalized_value("1.2×10⁻⁷ m"), normalized_value("1E−07"), normalized_value("(1.00+/-0.05)e-07")
    ('1.2e-7 m', '1E-07', '(1.00±0.05)e-07')
    """
    text = normalized(text).replace("+/-", "±").replace("+-", "±")
    if "x" in text or "*" in text:
        text = re.sub(_POWER_OF_TEN, lambda power: f"e{power[1] or power[2].translate(SUPERSCRIPTS)}", text)
    if has_uncertainty(text) and ("e" in text or "E" in text):
        match = re.match(_TWO_POWERS, text)
        if match is not None:
            value, mark, side, power = match.groups()
            mistake = f"can be read as ({value}{mark}{side}){power} or as {value}{mark}({side}{power})"
            raise BadUnit(mistake, "write the one that is meant")
    return text


def unit_of(text: str, name: str) -> Unit:
    """Return the unit that a text means for a quantity; its dimension may differ from that of the quantity.

    Raises a `QuantityError` for a text that is not a unit.
    """
    try:
        return unit_meant(text, dimension_of(NOMENCLATURE[name].unit))
    except BadUnit as error:
        raise _error_about(name, text, error) from None


def unit_meant(text: str, dimension: Dimension) -> Unit:
    """Return the unit that a text means for a dimension; for an acceleration, g is standard gravity, not the gram."""
    if text == "g" and dimension == dimension_of("m/s^2"):
        return parse_unit("standard_gravity")
    return parse_unit(text)


def _unit_in(text: str, dimension: Dimension, default: Unit | None = None) -> Unit:
    """Return the unit that a text means, which must have the dimension; "" means the default. Raises a `BadUnit`."""
    if not text and default is not None:
        return default
    if not text and any(dimension):
        raise BadUnit(NO_UNIT)
    unit = unit_meant(text, dimension)
    _, _, dimension_of_unit = unit
    if dimension_of_unit != dimension:
        raise BadUnit(f"is {kind_of(dimension_of_unit)}")
    return unit


def has_uncertainty(text: str) -> bool:
    """Return whether a text may state an uncertainty or a range.

    >>> [has_uncertainty(text) for text in ("25±5 mJ/m2", "20 to 30 nm", "25 mJ/m2", "1e+3 nm")]
    [True, True, False, False]
    """
    return any(mark in text for mark in _MARKS)


def _error_about(name: str, text: str, error: BadUnit) -> QuantityError:
    """Return the error for a bad text, with the name of its quantity."""
    remedy = error.remedy([dimension_of(NOMENCLATURE[name].unit)])
    return QuantityError(name, text[:MAX_TEXT], str(error), remedy)


def split_number(text: str) -> tuple[_Decimal, str]:
    """Return the number at the beginning of a text, and the unit after it."""
    text = text.strip(" ").replace("..", "…")
    match = _NUMBER.match(text)
    assert match is not None  # every part of the pattern is optional
    sign, whole, fraction, exponent = match.groups()
    rest = text[match.end() :]
    digits = whole + (fraction or "")
    if not digits:
        raise BadUnit("does not begin with a number")
    if rest.startswith(","):
        raise BadUnit("has a comma: write a decimal point, and no thousands separators")
    if has_uncertainty(rest):
        raise BadUnit("has an uncertainty: give the value alone")
    if _SECOND.match(rest):
        remedy = "write 20 to 30 mJ/m2 for a range; on a command line, 20nm:100nm:9 is a list"
        raise BadUnit("has two numbers", remedy)
    power = _LETTER_AND_DIGITS.match(rest)
    if power is not None:
        if exponent:
            raise BadUnit("has two powers of ten", "write one, as in (25±5)e-3 J/m2")
        remedy = "write e for a power of ten, or a space before a unit"
        if power[1] in "dDqQ":  # as in Fortran
            remedy = f"write e for a power of ten, as in {text[: match.end()]}e{power[2]}"
        raise BadUnit(f"has {shown(power[0])} directly after the number", remedy)
    if exponent and len(exponent.lstrip("+-")) > 3:
        raise BadUnit("has an exponent of more than 3 digits")
    return (int(sign + digits), int(exponent or 0) - len(fraction or "")), rest.removeprefix(" ")


# --- Notations of uncertainties ---------------------------------------------------------------------------------------

_SIGNED = r"([+-]?[0-9.]+(?:[eE][+-]?[0-9]+)?)"
_END = r"((?:[eE][+-]?[0-9]{1,3})? ?[^±()]*)"  # a power of ten and a unit
_IN_BRACKETS = rf"\( ?{_SIGNED} ?± ?{_SIGNED} ?\){_END}"  # (25±5)e-3 J/m2
_LAST_DIGITS = rf"([+-]?(?:[0-9]+\.?[0-9]*|\.[0-9]+))\(([0-9]+)\){_END}"  # 25.0(50) mJ/m2
_TWO_SIDES = rf"{_SIGNED} ?\+ ?{_SIGNED} ?/ ?- ?{_SIGNED}( ?[^±()]*)"  # 25 +6/-4 mJ/m2


def _read(text: str, unit_in: _UnitIn) -> float | Uncertain:
    """Return the value of a text, with its uncertainty if it states one.

    The notations are those of the patterns above, and 25±5 nm, 25 nm ± 20% and 20 to 30 nm.
    """
    if not has_uncertainty(text):
        return _value(text, unit_in)
    if match := re.fullmatch(_IN_BRACKETS, text):
        value, side, end = match.groups()
        return _measured(_value(value + end, unit_in), _value(side + end, unit_in))
    if match := re.fullmatch(_LAST_DIGITS, text):
        value, digits, end = match.groups()
        decimals = len(value.partition(".")[2])
        side = f"{int(digits) / 10**decimals:.{decimals}f}"
        may_be_power = 2 * int(digits) > abs(float(value)) and not re.match(r"[eE][+-]?[0-9]", end)
        if may_be_power:  # as in 3.4(9), which is 3.4e9 in the paper
            raise BadUnit(f"can be read as {value}±{side} or as {value}e{digits}", "write the one that is meant")
        return _measured(_value(value + end, unit_in), _value(side + end, unit_in))
    if match := re.fullmatch(_TWO_SIDES, text):
        value, plus, minus, end = match.groups()
        return _measured(_value(value + end, unit_in), _value(minus + end, unit_in), _value(plus + end, unit_in))
    left, _, right = text.partition("±")
    if left and right and "±" not in right and not {"(", ")"}.intersection(text):
        return _plus_minus(left, right, unit_in)
    left, is_range, right = text.partition(" to ")
    if is_range:
        low, high = _value(_with_unit_of(right, left), unit_in), _value(right, unit_in)
        if low >= high:
            raise BadUnit("does not rise: write the smaller value first")
        centre = to_15_digits(low / 2 + high / 2)
        return Interval(min(max(low, centre), high), low, high)  # rounding may move the centre out of a narrow range
    if re.search(r"[^\d\s]\s*\(", text):
        raise BadUnit("has brackets in its unit", "leave them out, as in mJ/m2")
    raise BadUnit("has an uncertainty in an unknown form", "write it as in 25±5 mJ/m2 or 20 to 30 mJ/m2")


def _value(text: str, unit_in: _UnitIn) -> float:
    """Return the double nearest to a number with a unit, in SI units."""
    (mantissa, exponent), unit = split_number(text)
    numerator, denominator, _ = unit_in(unit)
    above, below = power_of_ten(exponent)
    try:
        value = mantissa * numerator * above / (denominator * below)  # a division of integers is rounded once
    except OverflowError:
        raise BadUnit("is too large for a double") from None
    if mantissa and not value:
        raise BadUnit("is too small for a double")
    return value


def _with_unit_of(other: str, text: str) -> str:
    """Return a number with its unit, or with the unit of another text if it has none."""
    _, unit = split_number(text)
    if unit:
        return text
    _, unit = split_number(other)
    return f"{text} {unit}"


def _plus_minus(left: str, right: str, unit_in: _UnitIn) -> Measured:
    """Return a value with an uncertainty that is given in a unit or in percent of the value."""
    (_, unit), (_, unit_of_side) = split_number(left), split_number(right)
    if unit_of_side.startswith("%"):
        if unit_of_side != "%" or unit_in(unit) == parse_unit("%"):
            raise BadUnit("has a % that can be read in two ways", "write 25 mJ/m2 ± 20%, or (17±1) %")
        value = _value(left, unit_in)
        return _measured(value, to_15_digits(abs(value) * _value(right, parse_unit)))
    if unit and not unit_of_side:
        raise BadUnit("has an uncertainty without a unit")
    return _measured(_value(_with_unit_of(right, left), unit_in), _value(right, unit_in))


def _measured(value: float, *sides: float) -> Measured:
    """Return a value with one uncertainty for both sides, or with one below and one above it."""
    if min(sides) < 0:
        raise BadUnit("has a negative uncertainty")
    return Measured(value, *sides)


def to_15_digits(number: float) -> float:
    """Return a number without the rounding error in its last digits: the middle of 0.1 and 0.2 is 0.15."""
    return float(f"{number:.15g}")
