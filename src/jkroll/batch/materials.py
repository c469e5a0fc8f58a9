"""Columns that name materials: each different text is looked up once."""

from collections.abc import Sequence
from typing import Any

import numpy

from ..materials.library import Material, Materials, UnknownMaterial
from ..quantities.nomenclature import INFINITY, PROPERTIES
from .cells import Floats

MAX_KEPT = 10_000  # different texts that are remembered
UNKNOWN = -1

Codes = numpy.ndarray[tuple[int, ...], numpy.dtype[numpy.int64]]


class Lookup:
    """The materials of a column, numbered as they come: number 0 is that of an empty cell."""

    def __init__(self, materials: Materials, otherwise: Material | None) -> None:
        """`otherwise`: the material of a row whose cell is empty."""
        self.materials = materials
        self.known: list[Material | None] = [otherwise]
        self._codes: dict[bytes | str, int] = {b"": 0, "": 0}
        self._tables: dict[str, Floats] = {}
        self._kinds: Codes = numpy.zeros(0, dtype=numpy.int64)

    def codes(self, cells: Sequence[bytes | str]) -> Codes:
        """Return the numbers of the materials that cells name; UNKNOWN for an unknown name."""
        try:
            return numpy.array([self._codes[cell] for cell in cells], dtype=numpy.int64)
        except KeyError:
            return numpy.array([self._code(cell) for cell in cells], dtype=numpy.int64)

    def _code(self, cell: bytes | str) -> int:
        code = self._codes.get(cell)
        if code is None:
            text = cell.decode(errors="replace") if isinstance(cell, bytes) else cell
            try:
                found = self.materials[text] if text.strip() else self.known[0]
                code = self.known.index(found) if found in self.known else len(self.known)
                if code == len(self.known):
                    self.known.append(found)
                    self._tables.clear()
            except UnknownMaterial:
                code = UNKNOWN
            if len(self._codes) < MAX_KEPT:
                self._codes[cell] = code
        return code

    def kinds(self, codes: Codes) -> Codes:
        """Return a number for each row: the same for materials that have the same properties.

        A material with uncertainties, or a rigid one, has a number of its own.
        """
        self._fill()
        return self._kinds[codes]

    def together(self, codes: Codes) -> Material | None:
        """Return the materials of rows of one kind as one, whose properties are arrays; one of its own kind as it is."""
        self._fill()
        first = self.known[int(codes[0])]
        if first is None or _is_special(first):
            return first
        properties: Any = {name: self._tables[name][codes] for name in first.properties}
        return Material("", properties, (), {}, (), (), "", "")

    def _fill(self) -> None:
        if self._tables:
            return
        self._tables = {
            name: numpy.array([one.properties.get(name, numpy.nan) if one else numpy.nan for one in self.known])
            for name in PROPERTIES
        }
        self._kinds = numpy.array([_kind(one, code) for code, one in enumerate(self.known)], dtype=numpy.int64)


def _kind(material: Material | None, code: int) -> int:
    """Return the number of a kind of materials: which properties they have, as bits; above these, that of a special one."""
    if material is None:
        return 0
    if _is_special(material):
        return (2 << len(PROPERTIES)) + code
    return 1 + sum(2 << bit for bit, name in enumerate(PROPERTIES) if name in material.properties)


def _is_special(material: Material) -> bool:
    return bool(material.uncertainties) or INFINITY in material.properties.values()
