"""A column of texts as SI numbers: orjson reads them all at once, with the power of ten of the unit in the number's own text.

So each number is rounded once, as in a one-liner. What orjson does not take for plain numbers is read cell by cell.
"""

import re
import struct
from collections.abc import Sequence
from math import isnan
from typing import NamedTuple

import numpy
import orjson

from ..quantities.errors import QuantityError
from ..quantities.nomenclature import NOMENCLATURE
from ..quantities.parsing import unit_of
from ..quantities.units import dimension_of
from .columns import Column, power_of_ten

Floats = numpy.ndarray[tuple[int, ...], numpy.dtype[numpy.float64]]
Mask = numpy.ndarray[tuple[int, ...], numpy.dtype[numpy.bool_]]

PLAIN = b"0123456789.eE+-, "
MAX_KEPT = 10_000  # texts whose value is remembered
_OWN_UNIT = re.compile(rb"[-+0-9.eE]+( ?[^\s0-9,][^,]*)")


class Numbers(NamedTuple):
    """A column as it was read: SI values, nan where there is none; which cells were given; which could not be read."""

    values: Floats
    given: Mask | None  # None: all of them
    odd: list[int]


class Reader:
    """Reads one column, block after block."""

    def __init__(self, column: Column) -> None:
        """`column`: its name and unit."""
        self.column = column
        self._kept: dict[bytes, float] = {}
        self._own: tuple[bytes, bytes] | None = None

    def numbers(self, cells: Sequence[bytes]) -> Numbers:
        """The numbers of a block of cells."""
        exponent = self.column.exponent
        if exponent is None:
            text = self._without_units(cells)
        else:
            suffix = b"e%d" % exponent if exponent else b""
            text = (suffix + b",").join(cells) + suffix
            if exponent and text.count(b"e") != len(cells):
                text = b",".join([_scaled(cell, exponent) if b"e" in cell else cell + suffix for cell in cells])
        values = plain_numbers(text, len(cells)) if text is not None else None
        return Numbers(values, None, []) if values is not None else self._one_by_one(cells)

    def _without_units(self, cells: Sequence[bytes]) -> bytes | None:
        """Cells that carry a unit, with its power of ten in its place, if that is the same unit throughout."""
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

    def _one_by_one(self, cells: Sequence[bytes]) -> Numbers:
        """The same, a cell at a time: with empty ones, spellings and units of their own, and what cannot be read."""
        values = numpy.full(len(cells), numpy.nan)
        given = numpy.ones(len(cells), dtype=bool)
        odd: list[int] = []
        suffix = b"e%d" % (self.column.exponent or 0)
        for place, cell in enumerate(cells):
            value = self._kept.get(cell)
            if value is None:
                try:
                    value = self._value(cell, suffix)
                except (QuantityError, UnicodeDecodeError):
                    odd.append(place)
                    continue
                if len(self._kept) < MAX_KEPT:
                    self._kept[cell] = value
            values[place] = value
            given[place] = not isnan(value)
        return Numbers(values, None if given.all() else given, odd)

    def _value(self, cell: bytes, suffix: bytes) -> float:
        if not cell or cell.isspace():
            return numpy.nan
        if self.column.exponent is not None and _JSON_NUMBER.fullmatch(cell):
            return float(cell + suffix)
        return self.column.read(cell.decode())


def _scaled(cell: bytes, exponent: int) -> bytes:
    """A number with an exponent, times a power of ten; whatever is no such number becomes none.

    >>> _scaled(b"1.5e+3", -9)
    b'1.5e-6'
    """
    mantissa, _, power = cell.partition(b"e")
    return b"%be%d" % (mantissa, int(power) + exponent) if _POWER.fullmatch(power) else b"?"


_POWER = re.compile(rb"[+-]?[0-9]{1,3}")
_JSON_NUMBER = re.compile(rb"-?[0-9]{1,20}(?:\.[0-9]{1,20})?")


def plain_numbers(text: bytes, count: int) -> Floats | None:
    """Numbers between commas; None if there is anything else between them, or not as many."""
    if text.translate(None, PLAIN):
        return None
    values = numpy.empty(count)
    try:
        struct.pack_into(f"{count}d", values.data, 0, *orjson.loads(b"[" + text + b"]"))
    except (orjson.JSONDecodeError, struct.error):
        return None
    return values
