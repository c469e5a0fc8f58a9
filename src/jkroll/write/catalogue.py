"""Materials and quantities in each format: lists and rows, and sheets with all facts about a single one."""

from collections.abc import Callable, Collection, Iterable, Iterator, Mapping, Sequence
from functools import cache
from itertools import chain
from typing import Any, TextIO

from ..materials.library import ORIGIN, Material
from ..materials.sheet import SIX_DIGITS, sheet_of, values_of_materials
from ..model.limits import LIMITS
from ..model.plan import arguments_of, depends_on, formula_of
from ..model.rows import Wanted
from ..physics.accuracy import accuracy_of
from ..quantities.formatting import AS_USUAL, amount, in_words, pretty
from ..quantities.nomenclature import (
    DEFAULTS,
    NOMENCLATURE,
    OF_CURVES,
    OF_DEM,
    OF_MAUGIS,
    OF_SPHERE,
    OF_WATER,
    PROPERTIES,
    XI,
    bracketed,
    header,
)
from ..quantities.shown import columns_of
from ..report.questions import QUESTIONS
from ..text import json_text, say, say_wrapped, write_table, write_texts
from .answered import numbers_of, uncertainty_object, write_measure
from .manual import without_variants
from .search import words_in
from .sources import bibtex, docstring_fields
from .writers import Cell, write_records


def write_materials(chosen: Sequence[Material], out: TextIO, output: str, *, named: bool) -> None:
    """Write materials in a format. `named`: True if the user named them; a single one is written in full."""
    is_single = named and len(chosen) == 1
    if output == "cite":
        _write_references(chosen, out)
    elif output == "json" and is_single:
        say(json_text(material_as_object(chosen[0]), out), out)
    elif output == "json":
        say(json_text([material_as_object(material) for material in chosen], out), out)
    elif output == "table" and is_single:
        _write_material(chosen[0], out)
    elif output == "plain" and is_single:
        _write_lines(chosen[0], out)
    elif output == "table" and named:
        _write_values(chosen, out)
    elif output == "table":
        _write_list(chosen, out)
    else:
        _write_rows(chosen, out, output)


def _write_references(chosen: Iterable[Material], out: TextIO) -> None:
    """Write the BibTeX entries of materials, each once."""
    entries: dict[str, Mapping[str, str]] = {}
    for material in chosen:
        for entry in material.references:
            entries[entry["key"]] = entry
    for entry in entries.values():
        say(bibtex(entry), out)


def _write_rows(chosen: Sequence[Material], out: TextIO, output: str) -> None:
    """Write a row for each material, with columns for all uncertainties that occur."""
    sides: set[str] = set()
    for material in chosen:
        sides.update(*(bar.sides for bar in material.uncertainties.values()))
    columns = Wanted(PROPERTIES, sides=sides)
    rows: list[list[Cell]] = []
    for material in chosen:
        cells: dict[str, Cell] = dict.fromkeys(columns.keys)
        for key, number in numbers_of(material.measures).items():
            if key in cells:
                cells[key] = in_words(key, number)
        about = [material.state or None, _keys(material) or None, material.title]
        rows.append([material.name, *cells.values(), *about])
    write_records(["material", *columns.heads(header), "state", "references", "source"], rows, output, out)


def _write_values(chosen: Sequence[Material], out: TextIO) -> None:
    """Write a table of materials with all their properties."""
    leading, columns = values_of_materials(chosen)
    write_table(leading, columns, out)
    say(f"\n{_IN_FULL}", out)


def _write_list(chosen: Sequence[Material], out: TextIO) -> None:
    """Write a table of materials, grouped by set, with the surface energy of each and its state or a note."""
    measures = [material.measures.get("surface_energy") for material in chosen]
    ((head, energies, _),) = columns_of("surface_energy", {"γ": measures}, SIX_DIGITS)
    rows: dict[str, list[tuple[str, str, str]]] = {}
    without: dict[str, list[str]] = {}
    for material, energy in zip(chosen, energies, strict=True):
        rows_of_set = rows.setdefault(material.title, [(material.title, "", "")])
        if "surface_energy" in material.properties:
            note, _, _ = material.notes.get("surface_energy", "").partition(";")
            rows_of_set.append((f"  {material.name}", energy, material.state or note))
        else:
            without.setdefault(material.title, []).append(material.name)
    for title, names in without.items():
        rows[title].append(("  without γ", "–", ", ".join(names)))
    heads = ("material", head, "state, or note on γ")
    write_texts(heads, [*chain.from_iterable(rows.values())], out)
    say(f"\nγ is per surface, w = 2γ; D&T: Dominik & Tielens 1997\n{_IN_FULL}; find some: jkroll materials WORD", out)


_IN_FULL = "in full: jkroll materials NAME"


def _keys(material: Material) -> str:
    """Return the keys of the references of a material."""
    return ", ".join(entry["key"] for entry in material.references)


def material_as_object(material: Material) -> dict[str, Any]:
    """Return the JSON object of a material; missing properties are null, a missing displacement is left out."""
    properties: dict[str, Any] = dict.fromkeys(PROPERTIES)
    for name, value in material.properties.items():
        if name in properties:
            properties[name] = in_words(name, value)
    if material.displacement is not None:
        radius, measured = material.displacement.radius, material.displacement.measured
        properties[XI] = {"radius": radius, "value": measured.value, **measured.sides}
    origins = {}
    for name, origin in material.origins.items():
        origins[name] = {**dict.fromkeys(ORIGIN, ""), **origin}
    return {
        "name": material.name,
        "aliases": list(material.aliases),
        **properties,
        "state": material.state,
        "uncertainties": {name: uncertainty_object(name, bar) for name, bar in material.uncertainties.items()},
        "origins": origins,
        "notes": dict(material.notes),
        "note_radii": {name: uncertainty_object("radius", radii) for name, radii in material.note_radii.items()},
        "references": [*map(dict, material.references)],
        "source": material.title,
    }


def _write_lines(material: Material, out: TextIO) -> None:
    """Write name and state, and lines for each property: its value, the sides of its uncertainty, and its origin."""
    say(f"material {material.name}", out)
    if material.state:
        say(f"state {material.state}", out)
    for name, value in material.measures.items():
        write_measure(name, {name: value}, out, AS_USUAL)
        for field, text in material.origins.get(name, {}).items():
            say(f"{name}.{field} {text}", out)


def _write_material(material: Material, out: TextIO) -> None:
    """Write the properties of a material with its state, aliases, origins, notes and references."""
    title, facts = sheet_of(material)
    _write_sheet(title, facts, out)


def _write_sheet(title: str, facts: Iterable[tuple[str, str]], out: TextIO) -> None:
    """Write a title and a line for each fact that has a text."""
    say(title, out)
    for head, text in facts:
        if text:
            say_wrapped(f"{head:{_INDENT - 1}} {text}", out, _INDENT)


_INDENT = 16  # indent of the texts in a sheet


# --- Quantities -------------------------------------------------------------------------------------------------------

_HEADS = ("name", "symbol", "unit", "option", "commands", "equation", "meaning")


def write_quantities(
    names: Sequence[str],
    out: TextIO,
    output: str,
    commands_taking: Callable[[str], Sequence[str]],
    most: int | None = None,
) -> None:
    """Write quantities in a format; as a table or lines, a single one is written in full.

    `commands_taking`: returns the commands that take a quantity as an input; `most`: the number of quantities that a
    table describes; a line below the table names the others.
    """
    is_single = len(names) == 1
    if output == "json" and is_single:
        say(json_text(quantity_as_object(names[0]), out), out)
    elif output == "json":
        say(json_text([quantity_as_object(name) for name in names], out), out)
    elif output in ("table", "plain") and is_single:
        _write_quantity(names[0], out, commands_taking(names[0]))
    elif output == "table":
        _write_tables(names, out, len(names) if most is None else most)
    else:
        records = []
        for name in names:
            fields = {**quantity_as_object(name), "commands": " ".join(commands_of(name))}
            records.append([fields[head] for head in _HEADS])
        write_records(_HEADS, records, output, out)


def _write_tables(names: Sequence[str], out: TextIO, most: int) -> None:
    """Write the first quantities as a table and name the others; the list of all has a table for each group."""
    groups: Mapping[str, Iterable[str]] = {"name": names[:most]}
    if len(names) >= len(NOMENCLATURE):
        groups = groups_of_quantities()
    for title, members in groups.items():
        heads, *rows = quantity_table(title, members)
        write_texts(heads, rows, out)
        say("", out)
    others = names[most:]
    if others:
        say_wrapped(f"and {len(others)} more: {', '.join(others)}", out)


def quantity_as_object(name: str) -> dict[str, Any]:
    """Return the JSON object of a quantity."""
    quantity, formula = NOMENCLATURE[name], formula_of(name)
    fields: Mapping[str, str] = {}
    follows_from: list[str] = []
    accuracy = ""
    if formula:
        fields, accuracy = docstring_fields(formula), accuracy_of(formula.__name__)
        follows_from = [argument for _, argument in arguments_of(name)]
    return {
        "name": name,
        "symbol": quantity.symbol,
        "unit": quantity.unit,
        "option": quantity.option,
        "example": quantity.example,
        "values": quantity.range.words if quantity.example else "",
        "commands": list(commands_of(name)),
        "equation": quantity.equation,
        "formula": fields.get("formula", quantity.definition),
        "follows_from": follows_from,
        "source": fields.get("Source", quantity.reference),
        "valid": fields.get("Valid", ""),
        "accuracy": accuracy,
        "meaning": quantity.sentence,
        "note": quantity.note,
        "variant_of": quantity.variant_of,
        "variants": [other for other in NOMENCLATURE if NOMENCLATURE[other].variant_of == name],
        "see_also": _related(name),
    }


def _related(name: str) -> list[str]:
    """Return the other quantities, except variants, that have each word of a name as the beginning of a word."""
    prefixes = words_in(name)
    related = []
    for other, words in _words_of_names().items():
        if other != name and all(_is_prefix(prefix, words) for prefix in prefixes):
            related.append(other)
    return related


@cache
def _words_of_names() -> Mapping[str, Sequence[str]]:
    """Return the words in the name of each quantity that is not a variant."""
    return {name: words_in(name) for name in without_variants(NOMENCLATURE)}


def _is_prefix(prefix: str, words: Iterable[str]) -> bool:
    """Return whether one of the words begins with a prefix."""
    return any(word.startswith(prefix) for word in words)


def commands_of(name: str) -> tuple[str, ...]:
    """Return the commands that show a quantity by default, or whose results depend on it as an input."""
    is_input = bool(NOMENCLATURE[name].option) or formula_of(name) is None
    commands = []
    for command, question in QUESTIONS.items():
        if name in question.quantities or (is_input and name in depends_on(question.quantities)):
            commands.append(command)
    return tuple(commands)


def quantity_table(title: str, names: Iterable[str]) -> Iterator[tuple[str, str, str]]:
    """Iterate over the header and the rows of a table of quantities."""
    yield title, "symbol [unit]", "meaning"
    for name in names:
        quantity = NOMENCLATURE[name]
        meaning = quantity.sentence
        if quantity.variant_of:
            meaning += f", variant of {quantity.variant_of}"
        yield name, quantity.symbol + bracketed(pretty(quantity.unit)), meaning


def groups_of_quantities() -> dict[str, list[str]]:
    """Return all quantities except variants by the title of a group; each is in the first group that matches."""
    groups: dict[str, Collection[str]] = {}
    for sphere in (1, 2):
        groups[f"of sphere {sphere}"] = [name for name in NOMENCLATURE if NOMENCLATURE[name].sphere == sphere]
    groups["input"] = [name for name, quantity in NOMENCLATURE.items() if quantity.example]
    for command, question in QUESTIONS.items():
        groups[f"jkroll {command}"] = question.quantities
    groups |= {
        "of DEM": (*OF_DEM, "time_step"),
        "of a meniscus": OF_WATER,
        "limit": [limit.name for limit in LIMITS],
        "of Maugis' law": OF_MAUGIS,
        "of a true sphere": OF_SPHERE,
        "of measured curves": OF_CURVES,
        "further": NOMENCLATURE,
    }
    left, shown = without_variants(NOMENCLATURE), {}
    for title, members in groups.items():
        matching = [name for name in left if name in members]
        if matching:
            shown[title] = matching
        left = [name for name in left if name not in members]
    return shown


def _write_quantity(name: str, out: TextIO, taking: Sequence[str]) -> None:
    """Write a quantity in full, with a line for each fact. `taking`: the commands that take it as an input."""
    record = quantity_as_object(name)
    title, example = f"{record.pop('name')}: {record.pop('meaning')}", record.pop("example")
    if example and not record["option"]:
        record["option"] = f"a word: {example}"
    else:
        record["option"] = f"{record['option']} {example}".strip()
    record["unit"] = pretty(record["unit"])
    facts: list[tuple[str, str]] = []
    for key, value in record.items():
        if key == "commands":
            facts += _facts_of_use(name, value, taking)
        else:
            facts.append((key, value if isinstance(value, str) else ", ".join(value)))
    _write_sheet(title, [(f"  {key.replace('_', ' ')}", text) for key, text in facts], out)


def _facts_of_use(name: str, commands: Iterable[str], taking: Sequence[str]) -> Iterator[tuple[str, str]]:
    """Iterate over the default of a quantity, the commands that show it, and the commands that take it as an input."""
    if name in DEFAULTS:
        yield "default", (amount(name, DEFAULTS[name]) if DEFAULTS[name] else "0")
    computing = [command for command in commands if name in QUESTIONS[command].quantities]
    if computing:
        yield "shown by", ", ".join(computing)
    elif not taking:
        yield "shown by", f"any, with --quantities {name}"
    yield "taken by", ", ".join(taking)
