"""A column of texts as SI numbers: orjson reads them all at once, with the power of ten of the unit in the number's own text.

So each number is rounded once, as in a one-liner. A cell that orjson does not take for a number is read by itself.
"""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from math import isnan
from types import MappingProxyType
from typing import TYPE_CHECKING, NamedTuple

import numpy
import orjson

from ..quantities.errors import QuantityError
from ..quantities.nomenclature import NOMENCLATURE
from ..quantities.parsing import unit_of
from ..quantities.units import dimension_of
from .columns import Column, power_of_ten

if TYPE_CHECKING:
    from ..quantities.uncertain import Uncertain

Floats = numpy.ndarray[tuple[int, ...], numpy.dtype[numpy.float64]]
Mask = numpy.ndarray[tuple[int, ...], numpy.dtype[numpy.bool_]]

PLAIN = b"0123456789.eE+-, "
MAX_KEPT = 10_000  # texts whose value is remembered
PART = 16  # cells read together where some cell of the block is no number
_OWN_UNIT = re.compile(rb"[-+0-9.eE]+( ?[^\s0-9,][^,]*)")
_POWER = re.compile(rb"[+-]?[0-9]{1,3}")
_POWERS = re.compile(rb"e([+-]?[0-9]{1,3}),")
_DOUBLE_SIGN = re.compile(rb",\+[^0-9]")


class Numbers(NamedTuple):
    """A column: SI values, nan where there is none; the cells that are not empty, are no numbers, or have uncertainties."""

    values: Floats
    given: Mask | None  # None: all of them
    odd: Sequence[int] = ()
    uncertain: Mapping[int, Uncertain] = MappingProxyType({})


class Reader:
    """Reads a column, block after block."""

    def __init__(self, column: Column) -> None:
        """`column`: its name and unit."""
        self.column = column
        self._kept: dict[bytes, float | Uncertain] = {}
        self._own: tuple[bytes, bytes] | None = None

    def numbers(self, cells: Sequence[bytes]) -> Numbers:
        """Return the numbers of a block of cells."""
        values = self._together(cells)
        return Numbers(values, None) if values is not None else self._in_parts(cells)

    def _together(self, cells: Sequence[bytes]) -> Floats | None:
        """Return the numbers of cells that are all plain numbers, or all have the same unit; else None."""
        text = self._without_units(cells) if self.column.exponent is None else times_power(cells, self.column.exponent)
        return plain_numbers(text, len(cells)) if text is not None else None

    def _in_parts(self, cells: Sequence[bytes]) -> Numbers:
        """Return the numbers of cells some of which are empty, no numbers, or have units of their own."""
        values = numpy.full(len(cells), numpy.nan)
        given = numpy.ones(len(cells), dtype=bool)
        odd: list[int] = []
        uncertain: dict[int, Uncertain] = {}
        for start in range(0, len(cells), PART):
            part = cells[start : start + PART]
            together = self._together(part) if all(part) else None
            if together is not None:
                values[start : start + PART] = together
            else:
                for place, cell in enumerate(part, start):
                    try:
                        found = self._one(cell)
                    except (QuantityError, UnicodeDecodeError):
                        odd.append(place)
                        continue
                    if isinstance(found, float):
                        values[place] = found
                        given[place] = not isnan(found)
                    else:
                        values[place] = found.value
                        uncertain[place] = found
        return Numbers(values, None if given.all() else given, odd, uncertain)

    def _without_units(self, cells: Sequence[bytes]) -> bytes | None:
        """Return cells that all carry the same unit, with its power of ten in its place; else None."""
        if self._own is None or not cells[0].endswith(self._own[0]):
            match = _OWN_UNIT.fullmatch(cells[0].strip())
            try:
                unit = unit_of(match[1].decode(), self.column.name) if match else None
            except (QuantityError, UnicodeDecodeError):
                unit = None
            exponent = power_of_ten(unit) if unit is not None else None
            wanted = dimension_of(NOMENCLATURE[self.column.name].unit)
            if match is None or unit is None or exponent is None or unit.dimension != wanted:
                return None
            self._own = (match[1], b"e%d" % exponent if exponent else b"")
        unit_text, suffix = self._own
        text = b",".join(cells) + b","
        if text.count(unit_text + b",") != len(cells):
            return None
        return text.replace(unit_text + b",", suffix + b",")[:-1]

    def _one(self, cell: bytes) -> float | Uncertain:
        """Return the value of a cell, nan for an empty one."""
        value = self._kept.get(cell)
        if value is None:
            value = self._value(cell)
            if len(self._kept) < MAX_KEPT:
                self._kept[cell] = value
        return value

    def _value(self, cell: bytes) -> float | Uncertain:
        if not cell or cell.isspace():
            return numpy.nan
        if self.column.exponent is not None and _JSON_NUMBER.fullmatch(cell):
            return float(b"%be%d" % (cell, self.column.exponent))
        return self.column.read(cell.decode())


def times_power(cells: Sequence[bytes], exponent: int) -> bytes:
    """Return numbers between commas, times a power of ten in their own text.

    >>> times_power([b"1", b"2.5"], -9), times_power([b"+1E2", b"5.0e-1"], -9)
    (b'1e-9,2.5e-9', b'1E-7,5.0E-10')
    """
    text = b",".join(cells) + b","
    if b"E" in text:
        text = text.replace(b"E", b"e")
    if b"+" in text and not _DOUBLE_SIGN.search(b"," + text):
        text = (b"," + text).replace(b",+", b",")[1:]
    if exponent and b"e" in text:
        return _times_powers(text, len(cells), exponent)
    suffix = b"e%d" % exponent if exponent else b""
    return text.replace(b",", suffix + b",")[:-1] if suffix else text[:-1]


def _times_powers(text: bytes, count: int, exponent: int) -> bytes:
    """Return the same for numbers of which some have exponents of their own. Each ends with a comma."""
    powers = _POWERS.findall(text)
    if len(powers) != count:
        suffix = b"e%d" % exponent
        cells = text[:-1].split(b",")
        return b",".join([_scaled(cell, exponent) if b"e" in cell else cell + suffix for cell in cells])
    for power in {*powers}:  # an E marks what is replaced already
        text = text.replace(b"e" + power + b",", b"E%d," % (int(power) + exponent))
    return text[:-1]


def _scaled(cell: bytes, exponent: int) -> bytes:
    """Return a number with an exponent, times a power of ten; for anything else what is no number.

    >>> _scaled(b"1.5e+3", -9)
    b'1.5e-6'
    """
    mantissa, _, power = cell.partition(b"e")
    return b"%be%d" % (mantissa, int(power) + exponent) if _POWER.fullmatch(power) else b"?"


_JSON_NUMBER = re.compile(rb"-?[0-9]{1,20}(?:\.[0-9]{1,20})?")


def plain_numbers(text: bytes, count: int) -> Floats | None:
    """Return the numbers between commas; None if there is anything else between them, or not as many."""
    if text.translate(None, PLAIN):
        return None
    try:
        found = orjson.loads(b"[" + text + b"]")
    except orjson.JSONDecodeError:
        return None
    return numpy.array(found, dtype=float) if len(found) == count else None
