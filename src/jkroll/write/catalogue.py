"""The materials and quantities as text: lists of them, and full sheets of single ones."""

from collections.abc import Callable, Collection, Iterable, Iterator, Mapping, Sequence
from functools import cache
from itertools import chain
from typing import Any, TextIO

from ..materials.library import ORIGIN, Material
from ..materials.sheet import EXACT, sheet_of, values_of_materials
from ..model.frame import DEFAULTS
from ..model.limits import LIMITS
from ..model.plan import arguments_of, depends_on, formula_of
from ..model.rows import Wanted
from ..physics.accuracy import accuracy_of
from ..quantities.formatting import AS_USUAL, amount, in_words, pretty
from ..quantities.nomenclature import (
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
from .answered import bar_object, numbers_of, write_measure
from .manual import without_variants
from .search import words_in
from .sources import bibtex, docstring_fields
from .writers import Cell, write_records


def write_materials(chosen: Sequence[Material], out: TextIO, output: str, *, named: bool) -> None:
    """Write materials in a format: a single `named` one in full, several with all their values."""
    is_one = named and len(chosen) == 1
    if output == "cite":
        entries: dict[str, Any] = {}
        for material in chosen:
            entries |= {entry["key"]: entry for entry in material.references}
        for entry in entries.values():
            say(bibtex(entry), out)
    elif output == "json":
        objects = [material_as_object(material) for material in chosen]
        say(json_text(objects[0] if is_one else objects, out), out)
    elif is_one and output == "table":
        _write_material(chosen[0], out)
    elif is_one and output == "plain":
        _write_lines(chosen[0], out)
    elif named and output == "table":
        _write_values(chosen, out)
    elif output == "table":
        _write_list(chosen, out)
    else:
        _write_rows(chosen, out, output)


def _write_rows(chosen: Sequence[Material], out: TextIO, output: str) -> None:
    """Write a row for each material, with columns for all uncertainties that occur."""
    bars = chain.from_iterable(material.uncertainties.values() for material in chosen)
    columns = Wanted(PROPERTIES, sides={*chain.from_iterable(bar.sides for bar in bars)})
    rows: list[list[Cell]] = []
    for material in chosen:
        numbers = numbers_of(material.measures)
        cells: list[Cell] = [in_words(key, numbers[key]) if key in numbers else None for key in columns.keys]
        rows.append([material.name, *cells, material.state or None, _keys(material) or None, material.title])
    write_records(["material", *columns.heads(header), "state", "references", "source"], rows, output, out)


def _write_values(chosen: Sequence[Material], out: TextIO) -> None:
    """Write a table of the properties of some materials."""
    leading, columns = values_of_materials(chosen)
    write_table(leading, columns, out)
    say(f"\n{_IN_FULL}", out)


def _write_list(chosen: Sequence[Material], out: TextIO) -> None:
    """Write a table of materials by sets, with the surface energy of each and the state that it belongs to."""
    measures = [material.measures.get("surface_energy") for material in chosen]
    ((head, energies, _),) = columns_of("surface_energy", {"γ": measures}, EXACT)
    rows: dict[str, list[tuple[str, str, str]]] = {}
    without: dict[str, list[str]] = {}
    for material, energy in zip(chosen, energies, strict=True):
        rows_of_set = rows.setdefault(material.title, [(material.title, "", "")])
        if "surface_energy" in material.properties:
            note, _, _ = material.notes.get("surface_energy", "").partition(";")
            rows_of_set.append((f"  {material.name}", energy, material.state or note or _keys(material)))
        else:
            without.setdefault(material.title, []).append(material.name)
    for title, names in without.items():
        rows[title].append(("  no γ (--gamma)", "–", ", ".join(names)))
    heads = ("material", head, "state, what to know of γ, or reference")
    write_texts(heads, [*chain.from_iterable(rows.values())], out)
    say(f"\n{_IN_FULL}; find some: jkroll materials WORD", out)


_IN_FULL = "in full: jkroll materials NAME"


def _keys(material: Material) -> str:
    return ", ".join(entry["key"] for entry in material.references)


def material_as_object(material: Material) -> dict[str, Any]:
    """Return the JSON object of a material; missing properties are null, a missing displacement is left out."""
    displacement = {}
    if material.displacement is not None:
        radius, measured = material.displacement.radius, material.displacement.measured
        displacement = {XI: {"radius": radius, "value": measured.value, **measured.sides}}
    properties = {name: in_words(name, value) for name, value in material.properties.items()}
    return {
        "name": material.name,
        "aliases": list(material.aliases),
        **{name: properties.get(name) for name in PROPERTIES},
        **displacement,
        "state": material.state,
        "uncertainties": {name: bar_object(name, bar) for name, bar in material.uncertainties.items()},
        "origins": {name: {**dict.fromkeys(ORIGIN, ""), **origin} for name, origin in material.origins.items()},
        "notes": dict(material.notes),
        "note_radii": {name: bar_object("radius", radii) for name, radii in material.note_radii.items()},
        "references": [dict(entry) for entry in material.references],
        "source": material.title,
    }


def _write_lines(material: Material, out: TextIO) -> None:
    """Write a line `name value unit` for each property and each side of its uncertainty, and its origin."""
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
    """Write a title, and a line for each known fact."""
    say(title, out)
    for head, text in facts:
        if text:
            say_wrapped(f"{head:{_INDENT - 1}} {text}", out, _INDENT)


_INDENT = 16  # indent of the texts in a sheet


# --- Quantities -------------------------------------------------------------------------------------------------------

_HEADS = ("name", "symbol", "unit", "option", "commands", "equation", "meaning")


def write_quantities(
    names: Sequence[str], out: TextIO, output: str, takers: Callable[[str], Sequence[str]], most: int | None = None
) -> None:
    """Write a list of quantities in a format, or a single one in full.

    `takers`: returns the commands that take an input; `most`: the number of quantities that a table describes.
    """
    if output == "json":
        objects = [quantity_as_object(name) for name in names]
        say(json_text(objects[0] if len(names) == 1 else objects, out), out)
    elif output in ("table", "plain") and len(names) == 1:
        _write_quantity(names[0], out, takers(names[0]))
    elif output == "table":
        groups = {"name": names[:most]} if len(names) < len(NOMENCLATURE) else groups_of_quantities()
        for title, members in groups.items():
            heads, *rows = quantity_table(title, members)
            write_texts(heads, rows, out)
            say("", out)
        others = names[len(names) if most is None else most :]
        if others:
            say_wrapped(f"and {len(others)} more: {', '.join(others)}", out)
    else:
        records = []
        for name in names:
            fields = {**quantity_as_object(name), "commands": " ".join(commands_of(name))}
            records.append([fields[head] for head in _HEADS])
        write_records(_HEADS, records, output, out)


def quantity_as_object(name: str) -> dict[str, Any]:
    """Return the JSON object of a quantity, with all that is known of it; other lists are views of it."""
    quantity, formula = NOMENCLATURE[name], formula_of(name)
    fields = docstring_fields(formula) if formula else {}
    sought = words_in(name)
    related = [other for other, words in _words_of_names().items() if _has_all(words, sought)]
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
        "follows_from": [argument for _, argument in arguments_of(name)] if formula else [],
        "source": fields.get("Source", quantity.reference),
        "valid": fields.get("Valid", ""),
        "accuracy": accuracy_of(formula.__name__) if formula else "",
        "meaning": quantity.sentence,
        "note": quantity.note,
        "variant_of": quantity.variant_of,
        "variants": [other for other in NOMENCLATURE if NOMENCLATURE[other].variant_of == name],
        "see_also": [other for other in related if other != name],
    }


@cache
def _words_of_names() -> Mapping[str, Sequence[str]]:
    """Return the words of each name of the nomenclature but those of variants."""
    return {name: words_in(name) for name in without_variants(NOMENCLATURE)}


def _has_all(words: Sequence[str], sought: Iterable[str]) -> bool:
    """Return whether each word sought begins one of some words."""
    return all(any(word.startswith(beginning) for word in words) for beginning in sought)


def commands_of(name: str) -> tuple[str, ...]:
    """Return the commands that show a quantity, or take it as an option."""
    takes = bool(NOMENCLATURE[name].option) or formula_of(name) is None
    commands = []
    for command, question in QUESTIONS.items():
        if name in question.quantities or (takes and name in depends_on(question.quantities)):
            commands.append(command)
    return tuple(commands)


def quantity_table(title: str, names: Iterable[str]) -> Iterator[tuple[str, str, str]]:
    """Iterate over the header and the rows of a list of quantities."""
    yield title, "symbol [unit]", "meaning"
    for name in names:
        quantity = NOMENCLATURE[name]
        variant = f", variant of {quantity.variant_of}" if quantity.variant_of else ""
        yield name, quantity.symbol + bracketed(pretty(quantity.unit)), quantity.sentence + variant


def groups_of_quantities() -> dict[str, list[str]]:
    """Return all quantities except variants, in groups of one screen; each is in the first group that it fits."""
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
    left = without_variants(NOMENCLATURE)
    shown = {}
    for title, members in groups.items():
        shown[title] = [name for name in left if name in members]
        left = [name for name in left if name not in members]
    return {title: members for title, members in shown.items() if members}


def _write_quantity(name: str, out: TextIO, takers: Sequence[str]) -> None:
    """Write a quantity in full, with a line for each fact. `takers`: the commands that take it as an input."""
    record = quantity_as_object(name)
    title, example = f"{record.pop('name')}: {record.pop('meaning')}", record.pop("example")
    is_word = example and not record["option"]
    record["option"] = f"a word: {example}" if is_word else f"{record['option']} {example}".strip()
    record["unit"] = pretty(record["unit"])
    shown_by = [command for command in record["commands"] if name in QUESTIONS[command].quantities]
    of_commands = {
        "default": amount(name, DEFAULTS[name]) if name in DEFAULTS else "",
        "shown by": ", ".join(shown_by) or ("" if takers else f"any, with --quantities {name}"),
        "taken by": ", ".join(takers),
    }
    facts: dict[str, str] = {}
    for key, text in record.items():
        if key == "commands":
            facts |= of_commands
        else:
            facts[key] = text if isinstance(text, str) else ", ".join(text)
    _write_sheet(title, ((f"  {key.replace('_', ' ')}", text) for key, text in facts.items()), out)
