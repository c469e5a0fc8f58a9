"""Materials for readers: the facts about a material, and a table of several materials."""

import re
from collections.abc import Sequence
from typing import TYPE_CHECKING

from ..quantities.formatting import DIGITS, Format, amount, symbol_among
from ..quantities.nomenclature import NOMENCLATURE, PROPERTIES, XI
from ..quantities.shown import Part, Table, columns_of
from ..text import TextColumn

if TYPE_CHECKING:
    from .library import Material

SIX_DIGITS = Format(digits=DIGITS)  # for values in a table
_REFERENCE = ("author", "title", "journal", "volume", "pages", "year", "eprint", "doi", "url", "note")


def values_of_materials(chosen: "Sequence[Material]") -> Table:
    """Return the names of materials, and the columns of their properties."""
    columns: list[TextColumn] = []
    for name in PROPERTIES:
        values = [material.measures.get(name) for material in chosen]
        columns += columns_of(name, {symbol_among(name, ()): values}, SIX_DIGITS)
    return [TextColumn("material", [material.name for material in chosen], is_right=False)], columns


def parts_of_materials(chosen: "Sequence[Material]") -> list[Part]:
    """Return a table of materials for a notebook, with their properties, state and source."""
    leading, columns = values_of_materials(chosen)
    columns.append(TextColumn("state", [each.state for each in chosen], is_right=False))
    columns.append(TextColumn("source", [each.title for each in chosen], is_right=False))
    return [(leading, columns)]


def parts_of_material(material: "Material") -> list[Part]:
    """Return a material for a notebook: its title, and a row for each fact."""
    title, facts = sheet_of(material)
    heads, texts = zip(*facts, strict=True)
    columns = [TextColumn("property", heads, is_right=False), TextColumn("value", texts, is_right=False)]
    return [title, (columns, [])]


def sheet_of(material: "Material") -> tuple[str, list[tuple[str, str]]]:
    """Return the title and the facts of a material: state, properties with their origins, notes and references."""
    facts = [("state", material.state)]
    for name, measure in {**dict.fromkeys(PROPERTIES), **material.measures}.items():
        text = f"none in {material.title}" if measure is None else amount(name, measure)
        if name == XI and material.displacement is not None:
            text += f", spheres of {amount('radius', material.displacement.radius)}"
        facts.append((name, text))
        for field, origin in material.origins.get(name, {}).items():
            facts.append((f"  {field}", origin))
    for name, note in material.notes.items():
        head = NOMENCLATURE[name].sentence
        if name in material.note_radii:
            head += f" (R = {amount('radius', material.note_radii[name])})"
        facts.append(("note", f"{head}: {note}"))
    for entry in material.references:
        words = ", ".join([entry[field] for field in _REFERENCE if entry.get(field)])
        text = re.sub("[{}]", "", words)  # the braces of BibTeX
        if material.origins:
            text = f"{entry['key']}: {text}"
        facts.append(("reference", text))
    facts.append(("source", material.title))
    title = f"material {material.name}"
    if material.aliases:
        title += f" (also {', '.join(material.aliases)})"
    return title, [(head, text) for head, text in facts if text]
