"""The nomenclature as text: every name with its symbol, unit, option, commands, equation and meaning."""

import re
from collections.abc import Iterable, Sequence
from typing import Any, TextIO

from ..answers.questions import QUESTIONS
from ..quantities.errors import OTHER_WORDS, UnknownQuantity
from ..quantities.formatting import pretty
from ..quantities.naming import named, with_symbol
from ..quantities.nomenclature import NOMENCLATURE, RANGES
from ..scene.wiring import depends_on, formula_of, parameters_of, suffix_of
from ..text import first_of, json_text, say, say_wrapped
from .explain import docstring_fields
from .records import write_records

_HEADS = ("name", "symbol", "unit", "option", "commands", "equation", "meaning")
_MAX_NAMED = 3  # commands that are named; more of them are counted


def quantities_found(words: Sequence[str]) -> list[str]:
    """Return the quantities that the words name, else those whose entry has each of the words; UnknownQuantity if none has.

    Those that have them in their name stand first, variants last; a variant is left out where its quantity is found.
    """
    if not words:
        return list(NOMENCLATURE)
    text = "_".join(" ".join(words).split())
    if called_so := [named(text)] if named(text) in NOMENCLATURE else with_symbol(text):
        return called_so
    begun = _pieces(words)
    found = [
        name for name in NOMENCLATURE if begun and _has(_called(name) | _pieces([NOMENCLATURE[name].sentence]), begun)
    ]
    if not found and (meant := OTHER_WORDS.get(text.casefold())):
        return [meant]
    if not found:
        raise UnknownQuantity(" ".join(words))
    found.sort(key=lambda name: (bool(NOMENCLATURE[name].variant_of), not _has(_called(name), begun)))
    return _without_variants(found)


def _without_variants(names: Sequence[str]) -> list[str]:
    """Return names without the variants of quantities that are among them."""
    return [name for name in names if NOMENCLATURE[name].variant_of not in names]


def write_quantities(names: Sequence[str], out: TextIO, kind: str) -> None:
    """Write a list of quantities in a format, or a single one in full."""
    if kind == "json":
        objects = [as_object(name) for name in names]
        say(json_text(objects[0] if len(names) == 1 else objects, out), out)
    elif kind in ("table", "plain") and len(names) == 1:
        _write_sheet(names[0], out)
    elif kind == "table":
        from .table import write_wrapped

        rows = [_table_row(name) for name in _without_variants(names)]
        write_wrapped(("name", "symbol", "unit", "meaning"), rows, out)
    else:
        write_records(_HEADS, map(_row, names), kind, out)


def as_object(name: str) -> dict[str, Any]:
    """Return the JSON object of a quantity."""
    quantity = NOMENCLATURE[name]
    return {
        "name": name,
        "symbol": quantity.symbol,
        "unit": quantity.unit,
        "option": quantity.option,
        "example": quantity.example,
        "commands": list(commands_of(name)),
        "equation": quantity.equation,
        "formula": docstring_fields(formula_of(name))["formula"] if formula_of(name) else "",
        "meaning": quantity.sentence,
        "note": quantity.note,
    }


def commands_of(name: str) -> tuple[str, ...]:
    """Return the commands that show a quantity, or that take it as an option."""
    takes = bool(NOMENCLATURE[name].option) or formula_of(name) is None
    return tuple(
        command
        for command, question in QUESTIONS.items()
        if name in question.quantities or (takes and name in depends_on(question.quantities))
    )


def _is_akin(other: str, name: str) -> bool:
    """Return whether the name of another quantity has all words of a name, and is no variant."""
    return other != name and not NOMENCLATURE[other].variant_of and _has(_pieces([other]), _pieces([name]))


def _called(name: str) -> set[str]:
    """Return the words in the name, symbol and option of a quantity."""
    return _pieces([name, NOMENCLATURE[name].symbol, NOMENCLATURE[name].option])


def _pieces(texts: Iterable[str]) -> set[str]:
    """Return the words of texts, in lower case and without underscores and signs."""
    return set(re.findall(r"[^\W_]+", " ".join(texts).casefold()))


def _has(words: Iterable[str], begun: Iterable[str]) -> bool:
    """Return whether each text of `begun` begins one of the words."""
    return all(any(word.startswith(piece) for word in words) for piece in begun)


def _row(name: str) -> list[str]:
    quantity = NOMENCLATURE[name]
    commands = " ".join(commands_of(name))
    return [name, quantity.symbol, quantity.unit, quantity.option, commands, quantity.equation, quantity.sentence]


def _table_row(name: str) -> list[str]:
    """Return the cells of a list: the option and the equation stand behind the meaning."""
    quantity = NOMENCLATURE[name]
    variant = f", variant of {quantity.variant_of}" if quantity.variant_of else ""
    equation = f", Eq {quantity.equation}" if quantity.equation else ""
    option = f"; {quantity.option}" if quantity.option else ""
    return [name, quantity.symbol, pretty(quantity.unit), f"{quantity.sentence}{variant}{equation}{option}"]


def _write_sheet(name: str, out: TextIO) -> None:
    """Write what is known of a quantity, a line for each fact."""
    quantity = NOMENCLATURE[name]
    formula = formula_of(name)
    fields = docstring_fields(formula) if formula else {}
    option = f"{quantity.option} {quantity.example}" if quantity.option else ""
    facts = {
        "symbol": quantity.symbol,
        "unit": pretty(quantity.unit),
        "option": option or (f"a word: {quantity.example}" if quantity.example else ""),
        "values": RANGES[quantity.range].words if quantity.range and quantity.example else "",
        "commands": first_of(commands_of(name), _MAX_NAMED) or "any, with --quantities " + name,
        "equation": quantity.equation,
        "formula": fields.get("formula", ""),
        "follows from": ", ".join(parameter + suffix_of(name) for parameter in parameters_of(formula))
        if formula
        else "",
        "source": fields.get("Source", ""),
        "valid": fields.get("Valid", ""),
        "accuracy": fields.get("Accuracy", ""),
        "note": quantity.note,
        "variant of": quantity.variant_of,
        "variants": ", ".join(other for other in NOMENCLATURE if NOMENCLATURE[other].variant_of == name),
        "see also": ", ".join(other for other in NOMENCLATURE if _is_akin(other, name)),
    }
    say(f"{name}: {quantity.sentence}", out)
    for head, text in facts.items():
        if text:
            say_wrapped(f"  {head:13} {text}", out, 16)
