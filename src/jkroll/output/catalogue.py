"""The materials as text: a table, plain lines, CSV, JSON or BibTeX."""

import csv
from collections.abc import Sequence
from typing import Any, TextIO

from ..materials.library import Material
from ..quantities.formatting import Format, amount
from ..quantities.nomenclature import NOMENCLATURE, PROPERTIES, header
from ..text import json_text, say


def write_materials(chosen: Sequence[Material], out: TextIO, kind: str, *, whole: bool) -> None:
    """Materials in a table, or one of them whole, in the format asked for."""
    if kind == "cite":
        from .explain import bibtex

        entries = {entry["key"]: entry for material in chosen for entry in material.references}
        for entry in entries.values():
            say(bibtex(entry), out)
    elif kind == "json":
        objects = [as_object(material) for material in chosen]
        say(json_text(objects[0] if whole else objects, out), out)
    elif kind == "csv":
        writer = csv.writer(out, lineterminator="\n")
        writer.writerow(["material", *map(header, PROPERTIES)])
        writer.writerows([material.name, *_cells(material, "")] for material in chosen)
    elif whole:
        _write_whole(chosen[0], out, people=kind == "table")
    elif kind == "table":
        from .table import write_rows

        rows = [
            [
                material.name,
                ", ".join(material.aliases),
                *(_people(material, name) for name in PROPERTIES),
                material.title,
            ]
            for material in chosen
        ]
        write_rows(["material", "also", *(NOMENCLATURE[name].symbol for name in PROPERTIES), "source"], rows, out)
    else:
        say("\t".join(["material", *map(header, PROPERTIES)]), out)
        for material in chosen:
            say("\t".join([material.name, *_cells(material, "-")]), out)


def as_object(material: Material) -> dict[str, Any]:
    """The JSON object of a material; a property it does not have is null."""
    return {
        "name": material.name,
        "aliases": list(material.aliases),
        **{name: material.properties.get(name) for name in PROPERTIES},
        "notes": dict(material.notes),
        "references": [dict(entry) for entry in material.references],
        "source": material.title,
    }


def _write_whole(material: Material, out: TextIO, *, people: bool) -> None:
    say(
        f"material {material.name}" + (f" (also {', '.join(material.aliases)})" if people and material.aliases else ""),
        out,
    )
    for name in PROPERTIES:
        if name in material.properties:
            unit = NOMENCLATURE[name].unit
            value = _people(material, name) if people else f"{material.properties[name]!r} {unit}".removesuffix(" 1")
            say(f"{name:16}{value}" if people else f"{name} {value}", out)
        elif people:
            say(f"{name:16}none in {material.title}", out)
    if people:
        for name, note in material.notes.items():
            say(f"note            {NOMENCLATURE[name].sentence}: {note}", out)
        for entry in material.references:
            fields = (entry.get(key, "") for key in ("author", "title", "journal", "volume", "pages", "year"))
            say(f"reference       {', '.join(field for field in fields if field)}", out)
        say(f"source          {material.title}", out)


def _people(material: Material, name: str) -> str:
    return amount(name, material.properties[name], Format()) if name in material.properties else "—"


def _cells(material: Material, absent: str) -> list[str]:
    return [repr(material.properties[name]) if name in material.properties else absent for name in PROPERTIES]
