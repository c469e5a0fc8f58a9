"""Materials as text: a table for each set, plain lines, CSV, JSON or BibTeX."""

from collections.abc import Sequence
from typing import Any, TextIO

from ..materials.library import Material
from ..quantities.formatting import AS_USUAL, amount
from ..quantities.nomenclature import NOMENCLATURE, PROPERTIES, header
from ..text import json_text, say, say_wrapped
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
        _write_tables(chosen, out)
    else:
        write_records(["material", *map(header, PROPERTIES), "state", "source"], map(_row, chosen), kind, out)


def _write_tables(chosen: Sequence[Material], out: TextIO) -> None:
    """Write a table for each set of materials, with its title above."""
    symbols = [NOMENCLATURE[name].symbol for name in PROPERTIES]
    for number, title in enumerate(dict.fromkeys(material.title for material in chosen)):
        members = [material for material in chosen if material.title == title]
        if number:
            say("", out)
        say(title, out)
        write_records(["material", "also", *symbols], map(_table_row, members), "table", out)
    if any(material.uncertainties for material in chosen):
        say("", out)
        say("nominal values; states, uncertainties and origins: jkroll materials NAME", out)


def as_object(material: Material) -> dict[str, Any]:
    """Return the JSON object of a material; a property that it does not have is null."""
    return {
        "name": material.name,
        "aliases": list(material.aliases),
        **{name: material.properties.get(name) for name in PROPERTIES},
        "state": material.state,
        "uncertainties": {name: found.as_object() for name, found in material.uncertainties.items()},
        "origins": {name: origin._asdict() for name, origin in material.origins.items()},
        "notes": dict(material.notes),
        "references": [dict(entry) for entry in material.references],
        "source": material.title,
    }


def _row(material: Material) -> list[Cell]:
    values = [material.properties.get(name) for name in PROPERTIES]
    return [material.name, *values, material.state or None, material.title]


def _table_row(material: Material) -> list[Cell]:
    properties = material.properties
    amounts = [amount(name, properties[name]) if name in properties else None for name in PROPERTIES]
    return [material.name, ", ".join(material.aliases), *amounts]


def _write_lines(material: Material, out: TextIO) -> None:
    """Write a line `name value unit` for each property, and lines `name.field text` for what is known of it."""
    say(f"material {material.name}", out)
    if material.state:
        say(f"state {material.state}", out)
    for name, value in material.properties.items():
        say(f"{name} {value!r} {NOMENCLATURE[name].unit}".removesuffix(" 1"), out)
        if name in material.uncertainties:
            say(f"{name}.stated {' '.join(AS_USUAL.rounded(name, material.uncertainties[name]))}", out)
        for field, text in _origin(material, name):
            say(f"{name}.{field} {text}", out)


def _write_sheet(material: Material, out: TextIO) -> None:
    """Write the properties of a material with its state, aliases, origins, notes and references."""
    aliases = f" (also {', '.join(material.aliases)})" if material.aliases else ""
    say(f"material {material.name}{aliases}", out)
    if material.state:
        say_wrapped(f"state           {material.state}", out, _INDENT)
    for name in PROPERTIES:
        say_wrapped(f"{name:{_INDENT}}{_stated(material, name)}", out, _INDENT)
        for field, text in _origin(material, name):
            say_wrapped(f"  {field:14}{text}", out, _INDENT)
    for name, note in material.notes.items():
        about = NOMENCLATURE[name].sentence if name in NOMENCLATURE else name
        say_wrapped(f"note            {about}: {note}", out, _INDENT)
    for entry in material.references:
        label = f"{entry['key']}: " if material.origins else ""
        say_wrapped(
            f"reference       {label}{', '.join(entry[field] for field in _REFERENCE if entry.get(field))}",
            out,
            _INDENT,
        )
    say_wrapped(f"source          {material.title}", out, _INDENT)


_INDENT = 16  # of the texts of a sheet
_REFERENCE = ("author", "title", "journal", "volume", "pages", "year", "eprint", "doi", "url", "note")


def _stated(material: Material, name: str) -> str:
    """Return a property with its uncertainty, if it has one, and its unit."""
    if name not in material.properties:
        return f"none in {material.title}"
    return amount(name, material.uncertainties.get(name, material.properties[name]))


def _origin(material: Material, name: str) -> list[tuple[str, str]]:
    """Return the fields of the origin of a property, with their names."""
    origin = material.origins.get(name)
    return [(field, text) for field, text in origin._asdict().items() if text] if origin else []
