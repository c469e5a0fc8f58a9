"""Conversion of columns of texts to SI numbers and to materials.

orjson reads the cells of a block with the same unit at once. The power of ten of the unit is appended to the text of
each number, so each number is rounded only once, as on the command line. Cells with other text, or with a unit that is
not a power of ten of the SI unit, are read one by one. Numbers of a table in Python stay doubles (see `Doubles`).
"""

from __future__ import annotations

import re
from collections.abc import Hashable, Mapping, Sequence
from functools import lru_cache
from math import isfinite, isnan
from typing import Any, NamedTuple

import numpy
import orjson

from ..errors import JkrollError
from ..materials.library import Material, Materials, UnclearMaterial
from ..model.measured import is_smooth, measured_solid
from ..model.rows import Numbers
from ..quantities.nomenclature import INFINITY, NOMENCLATURE
from ..quantities.units import Unit, dimension_of, exponent_of
from ..quantities.values import QuantityError, Uncertain, has_uncertainty, is_uncertain, middle, unit_of, value_of
from ..text import quoted

Floats = numpy.ndarray[tuple[int, ...], numpy.dtype[numpy.float64]]

PLAIN = b"0123456789.eE+-, "
MAX_KEPT = 10_000  # number of cells whose meanings a cache keeps
_NUMBER = rb"[-+]?(?:0|[1-9][0-9]{0,19})(?:\.[0-9]{1,20})?(?:[eE][-+]?[0-9]{1,2})?"
# A number, with or without a unit; d1 in 1.25d1 is not a unit.
_CELL = re.compile(rb"\s*(" + _NUMBER + rb")((?![A-Za-z][-+]?[0-9]) ?[^\s0-9.,][^,]*)?\s*")
_NUMBER_FIRST = re.compile(r"^[-+]?(?:[0-9]+\.?[0-9]*|\.[0-9]+)(?:[eE][-+]?[0-9]+)?")
PLUS_MINUS = re.compile(r"^(?:±|\+/?-)\s*")
_POWER = rb"e([+-]?[0-9]{1,3})"
_TINY = re.compile(rb"[eE]-[0-9]{3}")
_HAS_UNIT = re.compile(r"[^\W\d_eEx⁰¹²³⁴⁵⁶⁷⁸⁹]|[%°]")  # a letter that is not part of a power of ten, or %, or °
_NO_VALUES = ("", "nan", "na", "n/a", "null", "none", "-", "--")  # cells without a value, as common programs write them


class Column(NamedTuple):
    """The column of an input, with the unit of its bare numbers and the columns of its uncertainty.

    A range has columns only for its two ends, and its `position` is that of the column of low ends.
    """

    position: int
    name: str
    unit_text: str
    unit: Unit | None
    # The part, as in `reading.Reading`, and the position of each column with an uncertainty or an end of a range.
    sides: tuple[tuple[str, int], ...] = ()
    error_unit: str = ""  # the unit of ± cells; empty if it is the unit of the values
    coverage: float = 1.0  # the coverage factor of the uncertainties, as in k = 2

    @property
    def positions(self) -> dict[str, int]:
        """The positions of the columns that together give a value, by names such as radius and radius_minus."""
        values = {} if self.is_range else {self.name: self.position}
        return values | {f"{self.name}_{part}": position for part, position in self.sides}

    @property
    def is_range(self) -> bool:
        """True if the columns are the two ends of a range."""
        return "low" in dict(self.sides)

    def joined(self, *cells: str) -> str:
        """Return the cells of one value as a single text, as (25±5) for 25 and 5. Units in the cells are kept.

        A cell with a mark for a missing value, such as nan, is returned instead of the value.
        """
        for cell in cells:
            if cell.strip() and has_no_value(cell):
                return cell
        first, *others = (PLUS_MINUS.sub("", cell.strip()) for cell in cells)
        is_single = first == others[0] if self.is_range else not any(others)
        if self.is_range and all(map(is_number, cells)):
            is_single = float(first) == float(others[0])  # 25 and 25.0
        if is_single:
            return first
        if self.coverage != 1:
            others = [_NUMBER_FIRST.sub(self._standard, cell) for cell in others]
        is_bare = not self.error_unit and not any(map(_HAS_UNIT.search, (first, *others)))
        if not is_bare:
            first = _in_unit(first, self.unit_text)
            others = [_in_unit(cell, self.error_unit or self.unit_text) for cell in others]
        if "both" in dict(self.sides):
            text = f"{first}±{others[0]}"
            return f"({text})" if is_bare else text
        if self.is_range:
            return f"{first or '?'} to {others[0] or '?'}"
        if not all(others):
            return first  # `half_bars` reports the row
        minus, plus = others[0].removeprefix("-"), others[1].removeprefix("+")
        return f"{first} +{plus}/-{minus}"

    def half_bars(self, columns: Mapping[str, Sequence[bytes]]) -> list[int]:
        """Return the rows of a block in which an uncertainty has a minus without a plus, or a plus without a minus."""
        sides = [columns[f"{self.name}_{part}"] for part, _ in self.sides if part in ("minus", "plus")]
        rows = []
        for row, (minus, plus) in enumerate(zip(*sides, strict=True)):
            if bool(minus.strip()) != bool(plus.strip()):
                rows.append(row)
        return rows

    def _standard(self, number: re.Match[str]) -> str:
        """Return the text of an expanded uncertainty divided by its coverage factor."""
        return repr(float(number[0]) / self.coverage)

    @property
    def exponent(self) -> int | None:
        """The n of a unit of 10^n SI units, and 0 for a ratio without a unit; None for anything else."""
        if self.unit is None:
            return 0 if NOMENCLATURE[self.name].unit == "1" else None
        return exponent_of(self.unit)

    def numbers(self, columns: Mapping[str, Sequence[bytes]]) -> Numbers:
        """Return the SI values of a block. `columns`: the cells of the block, by names as in `positions`."""
        cells = columns[self.name] if not self.sides else self._with_sides(columns)
        if isinstance(cells, Doubles) and self.exponent is not None:
            return Numbers(scaled(cells.values, self.exponent))
        values = None if self.exponent is None else plain_numbers(cells, self.exponent)
        return Numbers(values) if values is not None else self._of_mixed_cells(cells)

    def _with_sides(self, columns: Mapping[str, Sequence[bytes]]) -> list[bytes]:
        """Return a single cell for each row: a value with its uncertainty, or a range of two ends."""
        joined = []
        for row in zip(*(columns[name] for name in self.positions), strict=True):
            texts = [cell.decode(errors="replace") for cell in row]
            joined.append(self.joined(*texts).encode())
        return joined

    def _of_mixed_cells(self, cells: Sequence[bytes]) -> Numbers:
        """Return the numbers of any cells, including those with their own units, uncertainties or other text."""
        values = numpy.full(len(cells), numpy.nan)
        by_unit: dict[bytes | None, dict[int, bytes]] = {}
        others: list[int] = []
        for row, cell in enumerate(cells):
            if match := _CELL.fullmatch(cell):
                by_unit.setdefault(match[2], {})[row] = match[1]
            elif cell and not cell.isspace():
                others.append(row)
        for unit, texts in by_unit.items():
            exponent = _exponent(unit, self.name) if unit else self.exponent
            numbers = None if exponent is None else plain_numbers([*texts.values()], exponent)
            if numbers is None:
                others += texts
            else:
                values[[*texts]] = numbers
        odd: list[int] = []
        uncertain: dict[int, Uncertain] = {}
        for row in others:
            meaning = _meaning(self, cells[row])
            if isinstance(meaning, JkrollError):
                odd.append(row)
                continue
            if is_uncertain(meaning):
                uncertain[row] = meaning
            values[row] = middle(meaning)
        return Numbers(values, odd, uncertain)

    def value(self, text: str) -> float | Uncertain:
        """Return the SI value of a cell, with its uncertainty if the cell states one.

        A bare number is in the unit of the column.
        """
        if has_no_value(text):
            raise QuantityError(self.name, text, "is not a number", "leave the cell empty if there is none")
        return value_of(text, self.name, self.unit)


def _in_unit(number: str, unit_text: str) -> str:
    """Return the text of a number with a unit appended, unless the text already has a unit."""
    return f"{number} {unit_text}" if number and unit_text and not _HAS_UNIT.search(number) else number


def has_no_value(text: str) -> bool:
    """Return whether a cell is empty, or has a mark for a missing value, such as nan or --."""
    return text.strip().casefold() in _NO_VALUES


def is_number(text: str) -> bool:
    """Return whether a text is a finite number as Python's `float` reads it."""
    try:
        return isfinite(float(text))
    except ValueError:
        return False


@lru_cache(maxsize=MAX_KEPT)
def _meaning(column: Column, cell: bytes) -> float | Uncertain | JkrollError:
    """Return the value of a cell, or its error. Equal cells share the result, since errors take long to make."""
    try:
        return column.value(cell.decode(errors="replace"))
    except JkrollError as error:
        return error.with_traceback(None)


@lru_cache(maxsize=MAX_KEPT)
def _exponent(unit_text: bytes, name: str) -> int | None:
    """Return n if a text is a unit of a quantity and equal to 10^n SI units; None for any other text."""
    try:
        text = unit_text.decode().strip()
        unit = None if not text or has_uncertainty(text) else unit_of(text, name)
    except (QuantityError, UnicodeDecodeError):
        return None
    if unit is None:
        return None
    *_, dimension = unit
    return exponent_of(unit) if dimension == dimension_of(NOMENCLATURE[name].unit) else None


def cell_of(value: object) -> str:
    """Return a Python value as the text of a cell; None gives an empty cell."""
    if isinstance(value, bytes):
        return value.decode(errors="replace")
    return "" if value is None else str(value)


def cells_of(values: Any) -> list[bytes]:
    """Return a list of Python values, or an array of numbers, as the texts of cells."""
    if not len(values):
        return []
    is_list = isinstance(values, list)
    if not is_list or {*map(type, values)} <= {int, float, type(None)}:
        cells = orjson.dumps(values, option=orjson.OPT_SERIALIZE_NUMPY)[1:-1].split(b",")
        nulls = values.count(None) if is_list else 0
        if cells.count(b"null") == nulls:  # orjson also writes null for nan and infinity
            if not nulls:
                return cells
            return [b"" if cell == b"null" else cell for cell in cells]
    return [cell_of(value).encode() for value in values]


def plain_numbers(cells: Sequence[bytes], exponent: int) -> Floats | None:
    """Return the numbers of cells, times a power of ten; nan for an empty cell.

    Return None if a cell has any other text, also a number such as 007 or .5, which is not a number in JSON. Return
    None, too, if a 0 may stand for a number too small for a double.

    >>> plain_numbers([b"1", b"2.5", b"+1E2", b"5.0e-1", b""], -9)
    array([1.0e-09, 2.5e-09, 1.0e-07, 5.0e-10,     nan])
    """
    end = b"e%d," % exponent if exponent else b","
    text = (b"," + end.join(cells) + end).replace(b"E", b"e")
    if text.translate(None, PLAIN):
        return None
    if b"+" in text and b"+-" not in text:
        text = text.replace(b",+", b",")
    if exponent and text.count(b"e") > len(cells):  # some cells have powers of their own
        for power in set(re.findall(_POWER + end, text)):
            text = text.replace(b"e" + power + end, b"E%d," % (int(power) + exponent))
    values = _members(text)
    if len(values) != len(cells):  # some cells are empty or not numbers
        empty = b"," + end
        while empty in text:  # in a run of empty cells, each pass replaces every other cell
            text = text.replace(empty, b",null,")
        values = _members(text)
    if len(values) != len(cells):
        return None
    numbers = numpy.array(values, dtype=float)
    return None if not numbers.all() and _TINY.search(text) else numbers


def _members(text: bytes) -> list[Any]:
    """Return the members of a comma-separated text read as JSON; an empty list if it is not JSON."""
    try:
        members: list[Any] = orjson.loads(b"[" + text[1:-1] + b"]")
    except orjson.JSONDecodeError:
        return []
    return members


class Doubles(Sequence[bytes]):
    """Cells that are doubles in memory, with nan for an empty cell. A cell becomes text only when it is looked up.

    Reading numbers from texts would take twice as long as computing a contact. Unlike a number in a file, a double is
    rounded once more when it is multiplied by the unit's power of ten.
    """

    def __init__(self, values: Floats) -> None:
        self.values = values

    def __len__(self) -> int:
        """Return the number of cells."""
        return len(self.values)

    def __getitem__(self, row: Any) -> Any:
        """Return the text of a cell, or the texts of a slice."""
        if isinstance(row, slice):
            return [*map(self._text, self.values[row].tolist())]
        return self._text(float(self.values[row]))

    @staticmethod
    def _text(value: float) -> bytes:
        return b"" if isnan(value) else repr(value).encode()


def scaled(values: Floats, exponent: int) -> Floats:
    """Return numbers times a power of ten.

    Each product is rounded once for exponents from -22 to 22, since a double then holds the factor or divisor exactly.

    >>> scaled(numpy.array([100.0, numpy.nan]), -9)
    array([1.e-07,    nan])
    """
    return values / 10.0**-exponent if exponent < 0 else values * 10.0**exponent


# --- Materials --------------------------------------------------------------------------------------------------------

LABEL = Material("", "", "")  # without properties: for a cell with an error, and the base of combined materials

Indices = numpy.ndarray[tuple[int, ...], numpy.dtype[numpy.int64]]


class Lookup:
    """The materials of a column, numbered in order of appearance; number 0 is for empty cells."""

    def __init__(self, materials: Materials, otherwise: Material | None) -> None:
        """`otherwise`: the material for empty cells."""
        self.materials = materials
        self.known: list[Material | None] = [otherwise]
        self.errors: dict[bytes, JkrollError] = {}  # by cell, for cells that do not name a usable material
        self._indices: dict[bytes, int] = {}  # by cell

    def indices(self, cells: Sequence[bytes]) -> Indices:
        """Return the index of the material of each cell; a cell in `errors` has the index of LABEL."""
        if len(self._indices) > MAX_KEPT:
            self._indices.clear()
            self.errors.clear()
        for cell in dict.fromkeys(cells):
            if cell in self._indices:
                continue
            text = cell.decode(errors="replace")
            try:
                solid = self.materials[text] if text.strip() else self.known[0]
            except JkrollError as error:
                solid, self.errors[cell] = LABEL, error.with_traceback(None)
            if solid not in self.known:
                self.known.append(solid)
            self._indices[cell] = self.known.index(solid)
        return numpy.array([*map(self._indices.__getitem__, cells)], dtype=numpy.int64)

    @property
    def unclear(self) -> list[str]:
        """The messages on names that several materials share."""
        return [error.fault for error in self.errors.values() if isinstance(error, UnclearMaterial)]

    @property
    def remarks(self) -> list[str]:
        """Remarks on the names in `unclear`; if any cell has an error, also on the aliases in the column."""
        remarks = self.unclear
        if not self.errors:
            return remarks
        for cell, index in self._indices.items():
            text, solid = cell.decode(errors="replace").strip(), self.known[index]
            if text and solid not in (None, LABEL) and solid.name.casefold() != text.casefold():
                remarks.append(f"material {quoted(text)} is {solid.name}")
        return remarks

    def marks(self, indices: Indices) -> Indices:
        """Return a mark for each row; rows with the same mark can share a frame."""
        marks = [*map(_mark, self.known)]
        return numpy.array([*map(marks.index, marks)])[indices]

    def together(self, indices: Indices) -> Material | None:
        """Return the materials of rows with the same mark as one material, whose properties are arrays.

        A material that all of the rows share is returned unchanged; rows without a material have None.
        """
        first = self.known[int(indices[0])]
        if first is None or not first.properties or _is_special(first) or (indices == indices[0]).all():
            return first
        properties: Any = {}
        for name in first.properties:
            values = [solid.properties.get(name, numpy.nan) if solid else numpy.nan for solid in self.known]
            properties[name] = numpy.array(values)[indices]
        return LABEL._replace(properties=properties)


def _mark(material: Material | None) -> Hashable:
    """Return the names of a material's properties, or its key if its rows need a frame of their own."""
    if material is None:
        return None
    return material.key if _is_special(material) else frozenset(material.properties)


def _is_special(material: Material) -> bool:
    """Return whether the rows of a material need a frame of their own.

    They do if the material is uncertain, rigid or smooth, or if its rolling was measured.
    """
    if material.uncertainties or material.displacement is not None or INFINITY in material.properties.values():
        return True
    return bool(measured_solid(material)) or is_smooth(material)
