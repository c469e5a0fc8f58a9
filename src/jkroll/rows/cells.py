"""Columns of texts as SI numbers and as materials.

orjson reads all numbers at once, with the power of ten of the unit in the number's own text: so each is rounded once,
as in a one-liner. A cell that is no plain number with a decimal unit is read by itself.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Hashable, Mapping, Sequence
from functools import lru_cache
from math import isfinite
from types import MappingProxyType
from typing import Any, NamedTuple

import numpy
import orjson

from ..errors import JkrollError
from ..materials.library import Material, Materials
from ..quantities.errors import QuantityError
from ..quantities.nomenclature import INFINITY, NOMENCLATURE
from ..quantities.units import Unit, dimension_of, exponent_of
from ..quantities.values import Uncertain, has_uncertainty, unit_of, value_of
from ..scene.alternatives import measured_solid

Floats = numpy.ndarray[tuple[int, ...], numpy.dtype[numpy.float64]]

PLAIN = b"0123456789.eE+-, "
MAX_KEPT = 10_000  # texts whose meaning is remembered
_NUMBER = rb"[-+]?(?:0|[1-9][0-9]{0,19})(?:\.[0-9]{1,20})?(?:[eE][-+]?[0-9]{1,2})?"
_CELL = re.compile(rb"\s*(" + _NUMBER + rb")( ?[^\s0-9.,][^,]*)?\s*")
_POWER = re.compile(rb"e([+-]?[0-9]{1,3}),")
_TINY = re.compile(rb"[eE]-[0-9]{3}")
_HAS_UNIT = re.compile(r"[^\W\d_eEx⁰¹²³⁴⁵⁶⁷⁸⁹]|[%°]")  # the letters of a number are those of its power of ten
_NO_END = "?"  # of a range
_NO_SIDES: Mapping[str, int] = {}  # which can be pickled
_NO_VALUES = ("", "nan", "na", "n/a", "null", "none", "-", "--")  # cells without a value, as programs write them


class Column(NamedTuple):
    """The column of an input, with the unit of the cells that carry none, and the columns of its uncertainty.

    A range has no column but those of its ends, of which the first is the low one.
    """

    place: int
    name: str
    unit_text: str
    unit: Unit | None
    sides: Mapping[str, int] = _NO_SIDES  # the places of the parts of the uncertainty, by part as `Reading` has it
    error_unit: str = ""  # of the cells of ±; an empty text where it is that of the values

    @property
    def places(self) -> dict[str, int]:
        """The places of the columns whose cells make a value."""
        values = {} if self.is_range else {self.name: self.place}
        return values | {f"{self.name}_{part}": place for part, place in self.sides.items()}

    @property
    def is_range(self) -> bool:
        """True if a value is known by its ends."""
        return "low" in self.sides

    def joined(self, *cells: str) -> str:
        """Return the cells of a value as one: 25 and 5 as 25±5. Cells with units of their own keep them."""
        first, *others = (cell.strip() for cell in cells)
        is_single = _are_equal(first, *others) if self.is_range else not any(others)
        if is_single:
            return first
        is_bare = not self.error_unit and not any(map(_HAS_UNIT.search, (first, *others)))
        if not is_bare:
            first = _in_unit(first, self.unit_text)
            others = [_in_unit(cell, self.error_unit or self.unit_text) for cell in others]
        if "both" in self.sides:
            return f"({first}±{others[0]})" if is_bare else f"{first}±{others[0]}"
        if self.is_range:
            return f"{first or _NO_END} to {others[0] or _NO_END}"
        minus, plus = others[0].removeprefix("-") or "0", others[1].removeprefix("+") or "0"
        return f"{first} +{plus}/-{minus}"

    @property
    def exponent(self) -> int | None:
        """The unit as a power of ten of the SI unit; None if it is no power of ten, or if there is no unit."""
        if self.unit is None:
            return 0 if NOMENCLATURE[self.name].unit == "1" else None
        return exponent_of(self.unit)

    def read(self, text: str) -> float | Uncertain:
        """Return the SI value of a cell, with its uncertainty if it states one.

        A cell without a unit has that of the column.
        """
        if self.is_range and _NO_END in text.split():
            raise QuantityError(self.name, text, "is a range without an end")
        if text.lstrip().startswith("±"):
            raise QuantityError(self.name, text, "is an error bar without a value")
        if has_no_value(text):
            raise QuantityError(self.name, text, "is no number", "leave the cell empty if there is none")
        return value_of(text, self.name, self.unit)


def _in_unit(number: str, unit_text: str) -> str:
    """Return the text of a number with a unit, unless it has one."""
    return f"{number} {unit_text}" if number and unit_text and not _HAS_UNIT.search(number) else number


def _are_equal(first: str, second: str) -> bool:
    """Return whether two cells are the same, or the same number."""
    return first == second or (is_number(first) and is_number(second) and float(first) == float(second))


def has_no_value(text: str) -> bool:
    """Return whether a cell has no value, as programs write it."""
    return text.strip().casefold() in _NO_VALUES


def is_number(text: str) -> bool:
    """Return whether a text is a finite number as programs write it."""
    try:
        return isfinite(float(text))
    except ValueError:
        return False


class Numbers(NamedTuple):
    """A column: SI values, nan where there is none.

    Beside them stand the cells that are no numbers, and the values that have uncertainties.
    """

    values: Floats
    odd: Sequence[int] = ()
    uncertain: Mapping[int, Uncertain] = MappingProxyType({})


class Kept(dict[Any, Any]):
    """A memory of what keys mean, or of the errors about them, which take as long as a hundred rows to word.

    Unlike an lru_cache it can be pickled, as a table is sent to processes.
    """

    def __init__(self, meaning: Callable[[Any], Any]) -> None:
        """`meaning`: returns what a key means, or raises a JkrollError."""
        self.meaning = meaning

    def __missing__(self, key: Hashable) -> Any:
        try:
            meaning = self.meaning(key)
        except JkrollError as error:
            meaning = error.with_traceback(None)
        if len(self) >= MAX_KEPT:
            self.clear()
        self[key] = meaning
        return meaning


class Reader:
    """Reads a column, block after block."""

    def __init__(self, column: Column) -> None:
        """`column`: its name and unit."""
        self.column = column
        self._cache = Kept(self._value)

    def numbers(self, columns: Mapping[str, Sequence[bytes]]) -> Numbers:
        """Return the numbers of a block of cells, by the names of the columns."""
        cells = self._cells(columns)
        match = _CELL.fullmatch(next(filter(None, cells), b""))
        values = self._together(cells, (match and match[2]) or b"")
        return Numbers(values) if values is not None else self._of_many_kinds(cells)

    def _cells(self, columns: Mapping[str, Sequence[bytes]]) -> Sequence[bytes]:
        """Return the cells of the values, each with its uncertainty."""
        column = self.column
        if not column.sides:
            return columns[column.name]
        rows = zip(*(columns[name] for name in column.places), strict=True)
        return [column.joined(*(cell.decode("utf-8", "replace") for cell in row)).encode() for row in rows]

    def _together(self, cells: Sequence[bytes], unit: bytes) -> Floats | None:
        """Return the numbers of cells that are plain numbers with the same unit behind them, or empty; else None."""
        exponent = self.column.exponent if not unit else _exponent(unit, self.column.name)
        if exponent is None:
            return None
        text = b",".join(cells) + b","
        if unit:
            if unit in cells:  # without a number, which is no empty cell
                return None
            unit += b","
            if text.count(unit) + cells.count(b"") != len(cells):
                return None
            text = text.replace(unit, b",")
        return plain_numbers(text, exponent, len(cells), has_empty=not all(cells))

    def _of_many_kinds(self, cells: Sequence[bytes]) -> Numbers:
        """Return the numbers of cells of which some are no numbers, or have other units than others."""
        values = numpy.full(len(cells), numpy.nan)
        by_unit: dict[bytes, list[int]] = {}
        others: list[int] = []
        for place, cell in enumerate(cells):
            if match := _CELL.fullmatch(cell):
                by_unit.setdefault(match[2] or b"", []).append(place)
            elif cell and not cell.isspace():
                others.append(place)
        for unit, places in by_unit.items():
            numbers = self._together([cells[place] for place in places], unit)
            if numbers is None:
                others += places
            else:
                values[places] = numbers
        odd: list[int] = []
        uncertain: dict[int, Uncertain] = {}
        for place in others:
            value: float | Uncertain | JkrollError = self._cache[cells[place]]
            if isinstance(value, JkrollError):
                odd.append(place)
            elif isinstance(value, float):
                values[place] = value
            else:
                values[place], uncertain[place] = value.value, value
        return Numbers(values, odd, uncertain)

    def _value(self, cell: bytes) -> float | Uncertain:
        return self.column.read(cell.decode(errors="replace"))


@lru_cache(maxsize=MAX_KEPT)
def _exponent(unit_text: bytes, name: str) -> int | None:
    """Return the power of ten of a unit of a quantity; None for any other text."""
    try:
        text = unit_text.decode().strip()
        unit = None if has_uncertainty(text) else unit_of(text, name)
    except (QuantityError, UnicodeDecodeError):
        return None
    return exponent_of(unit) if unit and unit.dimension == dimension_of(NOMENCLATURE[name].unit) else None


def plain_numbers(text: bytes, exponent: int, count: int, *, has_empty: bool) -> Floats | None:
    """Return numbers, each with a comma behind it, times a power of ten; nan for an empty text, if there may be some.

    Returns None for any other text, for another count of numbers, and for a 0 that may be a number below the doubles.

    >>> plain_numbers(b"1,2.5,+1E2,5.0e-1,,", -9, 5, has_empty=True)
    array([1.0e-09, 2.5e-09, 1.0e-07, 5.0e-10,     nan])
    """
    if text.translate(None, PLAIN):
        return None
    text = b"," + text.replace(b"E", b"e")
    if b"+" in text and b"+-" not in text:
        text = text.replace(b",+", b",")
    suffix = b"e%d" % exponent if exponent else b""
    if suffix:
        for power in set(_POWER.findall(text)):  # a semicolon marks the end of what has its power already
            text = text.replace(b"e" + power + b",", b"E%d;" % (int(power) + exponent))
        text = text[:1] + text[1:].replace(b",", suffix + b",").replace(b";", b",")
    empty = b"," + suffix + b","
    while has_empty and empty in text:  # in a run of them, every other one is found
        text = text.replace(empty, b",null,")
    try:
        values = orjson.loads(b"[" + text[1:-1] + b"]")
    except orjson.JSONDecodeError:
        return None
    if len(values) != count:
        return None
    numbers = numpy.array(values, dtype=float)
    return None if not numbers.all() and _TINY.search(text) else numbers


# --- Materials --------------------------------------------------------------------------------------------------------

LABEL = Material("", {}, (), {}, (), (), "", "")  # placeholder for a name that is not a material: it has no properties

Indices = numpy.ndarray[tuple[int, ...], numpy.dtype[numpy.int64]]


class Lookup:
    """The materials of a column, with indices as they come: 0 is that of an empty cell."""

    def __init__(self, materials: Materials, otherwise: Material | None) -> None:
        """`otherwise`: the material of a row whose cell is empty."""
        self.known: list[Material | None] = [otherwise]
        self._cache = Kept(self._index)
        self._of_names = Kept(materials.__getitem__)

    def indices(self, cells: Sequence[bytes]) -> Indices:
        """Return the indices of the materials that cells name."""
        return numpy.array([*map(self._cache.__getitem__, cells)], dtype=numpy.int64)

    def material(self, text: str) -> Material:
        """Return the material of a name. Raises UnknownMaterial, UnclearMaterial or MaterialsFileError."""
        solid: Material | JkrollError = self._of_names[text]
        if isinstance(solid, JkrollError):
            raise solid.with_traceback(None)
        return solid

    def _index(self, cell: bytes) -> int:
        text = cell.decode(errors="replace")
        solid = self._of_names[text] if text.strip() else self.known[0]
        if isinstance(solid, JkrollError):
            solid = LABEL
        if solid not in self.known:
            self.known.append(solid)
        return self.known.index(solid)

    def kinds(self, indices: Indices) -> Indices:
        """Return a number for each row, which is the same for materials that can be one scene's."""
        kinds = [*map(_kind, self.known)]
        return numpy.array([*map(kinds.index, kinds)])[indices]

    def together(self, indices: Indices) -> Material | None:
        """Return the materials of rows of one kind as one material, whose properties are arrays.

        If they are all the same, it is returned as it is.
        """
        first = self.known[int(indices[0])]
        if first is None or not first.properties or _is_special(first) or (indices == indices[0]).all():
            return first
        solids = [solid.properties if solid else {} for solid in self.known]
        properties: Any = {
            name: numpy.array([of_solid.get(name, numpy.nan) for of_solid in solids])[indices]
            for name in first.properties
        }
        return LABEL._replace(properties=properties)


def _kind(material: Material | None) -> Hashable:
    """Return the names of the properties of a material; a special one is a kind by itself."""
    if material is None:
        return None
    return material.key if _is_special(material) else frozenset(material.properties)


def _is_special(material: Material) -> bool:
    """Return whether more follows from a material than from numbers: uncertainties, rigidity, forces measured on it."""
    more = material.uncertainties or material.displacement is not None or measured_solid(material)
    return bool(more) or INFINITY in material.properties.values()
