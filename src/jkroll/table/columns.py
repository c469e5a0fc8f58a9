"""The header of a table: the columns that are inputs, their units, and the columns that pass through."""

import re
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from math import gcd
from typing import TYPE_CHECKING, NamedTuple

from ..quantities.errors import BareNumber, QuantityError
from ..quantities.nomenclature import NOMENCLATURE, OPTION_WORDS, canonical
from ..quantities.parsing import split_number, unit_of
from ..quantities.ranges import value_of
from ..quantities.units import Unit, dimension_of, kind_of
from ..text import MAX_WORD, closest, quoted
from .errors import BadTable

if TYPE_CHECKING:
    from ..quantities.uncertain import Uncertain

MATERIALS = ("material", "material2")
INPUTS = ("radius", *(name for name, quantity in NOMENCLATURE.items() if quantity.option and quantity.unit))
DOUBT = "doubt"  # the limits of the model that a row exceeds, as codes
STATUS = "status"
ALIKE = 0.85  # how similar a header is to the name of an input to be taken for a mistake
_SYMBOLS = {NOMENCLATURE[name].symbol: name for name in INPUTS}
_HEADER = re.compile(r"([^\[\]]*?)\s*\[([^\[\]]*)\]")
_PER_CENT = re.compile(r"(.*?)((?:±|\+/?-)[^±]*%)?", re.DOTALL)  # 25±20 % of the value
_CUT = re.compile(r"[\s_(/,:\[]+|$")  # between a name and a unit


@dataclass(frozen=True)
class Column:
    """The column of an input, with the unit of the cells that carry none."""

    place: int
    name: str
    unit_text: str
    unit: Unit | None

    @cached_property
    def exponent(self) -> int | None:
        """The unit as a power of ten of the SI unit; None if it is no power of ten, or if there is no unit."""
        if self.unit is None:
            return 0 if NOMENCLATURE[self.name].unit == "1" else None
        return power_of_ten(self.unit)

    def read(self, text: str) -> "float | Uncertain":
        """Return the SI value of a cell, with its uncertainty if it states one. Its unit is its own or that of the column."""
        try:
            return value_of(text, self.name)
        except BareNumber:
            if not self.unit_text:
                raise
            number, per_cent = _PER_CENT.fullmatch(text.strip()).groups()  # type: ignore[union-attr]  # matches any line
            return value_of(f"{number} {self.unit_text}{per_cent or ''}", self.name)


def power_of_ten(unit: Unit) -> int | None:
    """Return the exponent of a unit that is a power of ten times the SI unit.

    >>> power_of_ten(unit_of("nm", "radius")), power_of_ten(unit_of("ft", "radius"))
    (-9, None)
    """
    common = gcd(unit.numerator, unit.denominator)
    above, below = str(unit.numerator // common), str(unit.denominator // common)
    return len(above) - len(below) if above.rstrip("0") == below.rstrip("0") == "1" else None


class Header(NamedTuple):
    """The columns of a table."""

    texts: tuple[str, ...]
    inputs: tuple[Column, ...]
    materials: tuple[tuple[str, int], ...]  # name and place of the columns that name materials

    @property
    def names(self) -> frozenset[str]:
        """The names of the inputs that have columns."""
        return frozenset({column.name for column in self.inputs} | {name for name, _ in self.materials})

    @property
    def passing(self) -> list[str]:
        """The columns that pass through though they have names of the nomenclature: a user may take them for inputs."""
        return [text for text in self.texts if split(text)[0] in NOMENCLATURE and split(text)[0] not in self.names]


def understood(texts: Sequence[str]) -> Header:
    """Return the columns of a header. Raises BadTable."""
    inputs: list[Column] = []
    materials: list[tuple[str, int]] = []
    seen: dict[str, str] = {}
    for place, text in enumerate(texts):
        name, unit_text = split(text)
        key = name if is_input(text) else text
        if key in seen:
            other = seen[key]
            both = f"two columns {quoted(text)}" if other == text else f"the columns {quoted(other)} and {quoted(text)}"
            raise BadTable(f"header: {both}, of which one must go")
        seen[key] = text
        if name in MATERIALS:
            if unit_text is not None:
                raise BadTable(f"header: {quoted(text)}: a material has no unit; write {name}")
            materials.append((name, place))
        elif name in INPUTS:
            inputs.append(_column(place, name, unit_text, text))
        elif name not in NOMENCLATURE and (guess := _meant(name, unit_text)) is not None:
            raise BadTable(
                f"header: {quoted(text)} is no input; did you mean {guess}? A column to pass through needs another name"
            )
    return Header(tuple(texts), tuple(inputs), tuple(materials))


def is_input(text: str) -> bool:
    """Return whether a header is that of an input."""
    return split(text)[0] in (*INPUTS, *MATERIALS)


def split(text: str) -> tuple[str, str | None]:
    """Split a header into a name, for which the word of an option may stand, and the text of a unit."""
    match = _HEADER.fullmatch(text.strip())
    word, unit_text = (match[1], match[2].strip()) if match else (text.strip(), None)
    return canonical(word), unit_text


def _column(place: int, name: str, unit_text: str | None, text: str) -> Column:
    """Return the column of an input. Without a unit its cells carry their own, or are plain numbers if it is a ratio."""
    wanted = dimension_of(NOMENCLATURE[name].unit)
    if not unit_text or (unit_text in ("1", "-") and not any(wanted)):
        return Column(place, name, "", None)
    try:
        unit = unit_of(unit_text, name)
        if unit.dimension != wanted:
            raise QuantityError(name, unit_text, f"is {kind_of(unit.dimension)}")
    except QuantityError as error:
        raise BadTable(f"header: {quoted(text)}: {quoted(unit_text)} {error.problem()}") from None
    return Column(place, name, unit_text, unit)


def _meant(name: str, unit_text: str | None) -> str | None:
    """Return the header that a mistaken one was probably meant to be, or None."""
    known = (*INPUTS, *MATERIALS)
    symbol = _SYMBOLS.get(name) if len(name) > 1 or unit_text else None  # a letter alone may mean anything
    for cut in _CUT.finditer(name, 0, MAX_WORD):  # no name of an input is as long
        plain = _plain(name[: cut.start()])
        meant = symbol or OPTION_WORDS.get(plain, plain)
        rest = name[cut.end() :].rstrip(")] ") or unit_text or ""
        if meant in known and _fits(rest, meant):
            return f"{meant} [{rest}]"
        if meant in known and (cut.end() == len(name) or not {*cut[0]}.isdisjoint("([/")):
            return meant + _example_unit(meant)
    guess = closest(_plain(name), known, ALIKE)
    return guess and guess + (f" [{unit_text}]" if unit_text else _example_unit(guess))


def _plain(text: str) -> str:
    return text.casefold().replace("-", "_").replace(" ", "_")


def _fits(unit_text: str, name: str) -> bool:
    """Return whether a text is a unit of a quantity."""
    try:
        return bool(unit_text) and unit_of(unit_text, name).dimension == dimension_of(NOMENCLATURE[name].unit)
    except QuantityError:
        return False


def _example_unit(name: str) -> str:
    """Return a unit for the header of a quantity, if it needs one: that of its example."""
    quantity = NOMENCLATURE[name]
    return f" [{split_number(quantity.example)[2]}]" if any(dimension_of(quantity.unit or "1")) else ""


def check_first(column: Column, texts: Sequence[str]) -> None:
    """Raise BadTable for a column that has a unit neither in its header nor in its first cell."""
    if column.unit is not None or column.exponent is not None:
        return
    first = next((text for text in texts if text.strip()), None)
    try:
        if first is not None:
            value_of(first, column.name)
    except BareNumber:
        example = _example_unit(column.name)
        raise BadTable(
            f"header: {quoted(column.name)} has no unit, and neither has its first cell {quoted(first or '')}; write {column.name}{example}"
        ) from None
    except QuantityError:
        pass  # a bad row, not a bad header
