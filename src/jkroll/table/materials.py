"""Columns that name materials: each different text is looked up once."""

from collections.abc import Hashable, Sequence
from typing import Any

import numpy

from ..materials.library import Material, Materials, UnknownMaterial
from ..quantities.nomenclature import INFINITY
from .cells import Kept

UNKNOWN = -1  # number of what is no material, and of its kind

Codes = numpy.ndarray[tuple[int, ...], numpy.dtype[numpy.int64]]


class Lookup:
    """The materials of a column, numbered as they come: number 0 is that of an empty cell."""

    def __init__(self, materials: Materials, otherwise: Material | None) -> None:
        """`otherwise`: the material of a row whose cell is empty."""
        self.materials = materials
        self.known: list[Material | None] = [otherwise]
        self._numbers: dict[Hashable, int] = {_kind(otherwise): 0}  # of the kinds of materials
        self._kinds = [0]
        self._codes = Kept(self._code)

    def codes(self, cells: Sequence[bytes | str]) -> Codes:
        """Return the numbers of the materials that cells name; UNKNOWN for an unknown name."""
        return numpy.array([*map(self._codes.__getitem__, cells)], dtype=numpy.int64)

    def _code(self, cell: bytes | str) -> int:
        text = cell.decode(errors="replace") if isinstance(cell, bytes) else cell
        try:
            found = self.materials[text] if text.strip() else self.known[0]
        except UnknownMaterial:
            return UNKNOWN
        if found not in self.known:
            self.known.append(found)
            self._kinds.append(self._numbers.setdefault(_kind(found), len(self._numbers)))
        return self.known.index(found)

    def kinds(self, codes: Codes) -> Codes:
        """Return a number for each row, which is the same for materials that can be one scene's; UNKNOWN stays."""
        return numpy.array([*self._kinds, UNKNOWN])[codes]

    def together(self, codes: Codes) -> Material | None:
        """Return the materials of rows of one kind as one whose properties are arrays; a special one as it is."""
        first = self.known[int(codes[0])]
        if first is None or _is_special(first):
            return first
        properties: Any = {
            name: numpy.array([one.properties.get(name, numpy.nan) if one else numpy.nan for one in self.known])[codes]
            for name in first.properties
        }
        return Material("", properties, (), {}, (), (), "", "")


def _kind(material: Material | None) -> Hashable:
    """Return what materials of one kind have in common: the names of their properties; a special one is a kind by itself."""
    if material is None:
        return None
    return (material.path, material.name) if _is_special(material) else frozenset(material.properties)


def _is_special(material: Material) -> bool:
    """Return whether a material has uncertainties, or is rigid: more follows then than from a number."""
    return bool(material.uncertainties) or INFINITY in material.properties.values()
