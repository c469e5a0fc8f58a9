"""Materials as text: a table, plain lines, CSV, JSON or BibTeX."""

from collections.abc import Sequence
from typing import Any, TextIO

from ..materials.library import Material
from ..quantities.formatting import amount
from ..quantities.nomenclature import NOMENCLATURE, PROPERTIES, header
from ..text import json_text, say
from .citations import bibtex
from .records import Cell, write_records


def write_materials(chosen: Sequence[Material], out: TextIO, kind: str, *, whole: bool) -> None:
    """Write a list of materials in a format, or one of them with its notes and references."""
    if kind == "cite":
        entries = {entry["key"]: entry for material in chosen for entry in material.references}
        for entry in entries.values():
            say(bibtex(entry), out)
    elif kind == "json":
        objects = [as_object(material) for material in chosen]
        say(json_text(objects[0] if whole else objects, out), out)
    elif whole and kind == "table":
        _write_sheet(chosen[0], out)
    elif whole and kind == "plain":
        _write_lines(chosen[0], out)
    elif kind == "table":
        symbols = (NOMENCLATURE[name].symbol for name in PROPERTIES)
        write_records(["material", "also", *symbols, "source"], map(_table_row, chosen), kind, out)
    else:
        write_records(["material", *map(header, PROPERTIES)], map(_row, chosen), kind, out)


def as_object(material: Material) -> dict[str, Any]:
    """Return the JSON object of a material; a property that it does not have is null."""
    return {
        "name": material.name,
        "aliases": list(material.aliases),
        **{name: material.properties.get(name) for name in PROPERTIES},
        "notes": dict(material.notes),
        "references": [dict(entry) for entry in material.references],
        "source": material.title,
    }


def _row(material: Material) -> list[Cell]:
    return [material.name, *(material.properties.get(name) for name in PROPERTIES)]


def _table_row(material: Material) -> list[Cell]:
    amounts = [_amount(material, name) for name in PROPERTIES]
    return [material.name, ", ".join(material.aliases), *amounts, material.title]


def _amount(material: Material, name: str) -> str | None:
    return amount(name, material.properties[name]) if name in material.properties else None


def _write_lines(material: Material, out: TextIO) -> None:
    """Write a line `name value unit` for each property."""
    say(f"material {material.name}", out)
    for name, value in material.properties.items():
        say(f"{name} {value!r} {NOMENCLATURE[name].unit}".removesuffix(" 1"), out)


def _write_sheet(material: Material, out: TextIO) -> None:
    """Write the properties of a material with its aliases, notes and references."""
    aliases = f" (also {', '.join(material.aliases)})" if material.aliases else ""
    say(f"material {material.name}{aliases}", out)
    for name in PROPERTIES:
        say(f"{name:16}{_amount(material, name) or f'none in {material.title}'}", out)
    for name, note in material.notes.items():
        say(f"note            {NOMENCLATURE[name].sentence}: {note}", out)
    for entry in material.references:
        fields = (entry.get(key, "") for key in ("author", "title", "journal", "volume", "pages", "year"))
        say(f"reference       {', '.join(field for field in fields if field)}", out)
    say(f"source          {material.title}", out)
