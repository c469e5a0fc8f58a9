"""The quantities on the site: a page with the definition of each, and links to it from other pages."""

import re
from collections.abc import Iterator
from typing import Any

from typeset import mathml

from jkroll.quantities.formatting import pretty
from jkroll.quantities.nomenclature import NOMENCLATURE
from jkroll.write.catalogue import groups_of_quantities, quantity_as_object

PAGE = "all-quantities.md"
_FACTS = ("follows_from", "commands", "values", "source", "valid", "accuracy", "variants", "see_also")
_OF_NAMES = ("follows_from", "variants", "see_also")
_WORD = re.compile(r"(?<!\[)`(?:([a-z_0-9]+)|(--[a-z0-9-]+)(?: [^`]*)?)`(?!\])")
_OF_OPTIONS = {quantity.option: name for name, quantity in NOMENCLATURE.items() if quantity.option}


def quantities() -> str:
    """Return the page of all quantities: a table for each group, and a section with the facts on each quantity."""
    head = "# All quantities\n"
    words = "The symbols, names, units, options and formulas of all quantities, first as tables, then one by one.\n"
    return "\n".join([head, words, *_tables(), *_sections()])


def equations() -> str:
    """Return the page of the paper's numbered equations, each as the program has it."""
    rows = []
    for name, quantity in NOMENCLATURE.items():
        formula = quantity_as_object(name)["formula"]
        if quantity.equation and formula and not quantity.variant_of and quantity.sphere != 2:
            meaning = f"[{_escaped(quantity.sentence)}]({PAGE}#{name})"
            rows.append((int(quantity.equation), f"| {quantity.equation} | {mathml(formula)} | {meaning} |"))
    words = (
        "The equations of Dominik & Tielens 1995 by their numbers in the paper, as this program has them; where the "
        "printed ones differ, [the paper's errors](paper.md) say how.\n"
    )
    head = ["# Equations\n", words, "| Eq | equation | quantity |\n|---|---|---|"]
    return "\n".join([*head, *(row for _, row in sorted(rows))]) + "\n"


def shown_equation(formula: str, number: str) -> str:
    """Return a formula in a line of its own, with its number in the paper."""
    return f'<div class="equation">{mathml(formula, is_block=True)}<span>{f"({number})" if number else ""}</span></div>'


def with_links(text: str) -> str:
    """Return a text in which the names of quantities, and the options that give them, are links to their definitions.

    Headings stay as they are.
    """

    def linked(match: re.Match[str]) -> str:
        name = match[1] if match[1] in NOMENCLATURE else _OF_OPTIONS.get(match[2])
        return f"[{match[0]}]({PAGE}#{name})" if name else match[0]

    return "\n".join(line if line.startswith("#") else _WORD.sub(linked, line) for line in text.split("\n"))


def _tables() -> Iterator[str]:
    for title, names in groups_of_quantities().items():
        yield f"| {title} | symbol | unit | meaning | Eq |\n|---|---|---|---|---|"
        for name in names:
            quantity = NOMENCLATURE[name]
            symbol = "" if quantity.is_word else mathml(quantity.symbol)
            cells = [symbol, *map(_escaped, (pretty(quantity.unit), quantity.sentence, quantity.equation))]
            yield f"| [`{name}`](#{name}) | {' | '.join(cells)} |"
        yield ""


def _sections() -> Iterator[str]:
    """Iterate over the sections; a quantity of both spheres has one section, so that a search for γ finds one place."""
    for names in groups_of_quantities().values():
        for name in names:
            if NOMENCLATURE[name].sphere != 2:
                yield _section(name)


def _section(name: str) -> str:
    record = quantity_as_object(name)
    twin = NOMENCLATURE[name].twin
    both = [NOMENCLATURE[name], *([NOMENCLATURE[twin]] if twin else [])]
    symbols = ", ".join(quantity.symbol for quantity in both if quantity.symbol)
    title = f"{symbols}: {record['meaning']}" if symbols else record["meaning"]
    heads = " · ".join([_escaped(title), *(f"`{quantity.option}`" for quantity in both if quantity.option)])
    names = f"<code>{name}</code>"
    if twin:
        names += f', <code id="{twin}">{twin}</code>'
    unit = {"": "a word", "1": "a number"}.get(record["unit"], f"in {pretty(record['unit'])}")
    first = f"In Python and tables {names}, {unit}"
    equation = shown_equation(record["formula"], record["equation"]) if record["formula"] else ""
    facts = []
    for fact in _FACTS:
        text = _fact(fact, record[fact])
        if text:
            facts.append(f"- {fact.replace('_', ' ')}: {text}")
    return f"### {heads} {{#{name}}}\n\n{first}\n\n{equation}\n\n" + "\n".join(facts) + "\n"


def _fact(fact: str, known: Any) -> str:
    """Return a fact on a quantity as Markdown, with links; empty if nothing is known."""
    if fact == "commands":
        return ", ".join(f"[{command}](commands.md#{command})" for command in known)
    if fact == "variants":
        return ", ".join(f'<code id="{name}">{name}</code>' for name in known)
    if fact in _OF_NAMES:
        return ", ".join(f"[`{name}`](#{name})" for name in known)
    return _escaped(known)


def _escaped(text: str) -> str:
    """Return a text with the signs escaped that Markdown would take for marks."""
    return re.sub(r"([\\`*_\[\]|])", r"\\\1", text).replace("<", "&lt;")
