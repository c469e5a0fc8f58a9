"""The nomenclature as text: every name with its symbol, unit, option, commands, equation and meaning."""

from collections.abc import Sequence
from typing import Any, TextIO

from ..answers.questions import QUESTIONS
from ..quantities.errors import UnknownQuantity
from ..quantities.formatting import pretty
from ..quantities.nomenclature import NOMENCLATURE, RANGES, canonical
from ..scene.wiring import depends_on, formula_of, parameters_of, suffix_of
from ..text import first_of, json_text, say, say_wrapped
from .explain import docstring_fields
from .records import write_records

_HEADS = ("name", "symbol", "unit", "option", "commands", "equation", "meaning")
_MAX_NAMED = 3  # commands that are named; more of them are counted


def quantities_found(words: Sequence[str]) -> list[str]:
    """Return the quantity that the words name, else all whose entry has each of the words; UnknownQuantity if none has."""
    text = "_".join(words)
    if not words or canonical(text) in NOMENCLATURE:
        return [canonical(text)] if words else list(NOMENCLATURE)
    pieces = text.casefold().replace("-", "_").split("_")
    found = [name for name in NOMENCLATURE if all(piece in _searched(name) for piece in pieces)]
    if not found:
        raise UnknownQuantity(" ".join(words))
    return found


def write_quantities(names: Sequence[str], out: TextIO, kind: str) -> None:
    """Write a list of quantities in a format, or a single one in full."""
    if kind == "json":
        objects = [as_object(name) for name in names]
        say(json_text(objects[0] if len(names) == 1 else objects, out), out)
    elif kind in ("table", "plain") and len(names) == 1:
        _write_sheet(names[0], out)
    elif kind == "table":
        from .table import write_wrapped

        write_wrapped(("name", "symbol", "unit", "meaning"), [_table_row(name) for name in names], out)
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


def _searched(name: str) -> str:
    quantity = NOMENCLATURE[name]
    return f"{name} {quantity.symbol} {quantity.option} {quantity.sentence} {quantity.note}".casefold()


def _row(name: str) -> list[str]:
    quantity = NOMENCLATURE[name]
    commands = " ".join(commands_of(name))
    return [name, quantity.symbol, quantity.unit, quantity.option, commands, quantity.equation, quantity.sentence]


def _table_row(name: str) -> list[str]:
    """Return the cells of a list: the option and the equation stand behind the meaning."""
    quantity = NOMENCLATURE[name]
    equation = f", Eq {quantity.equation}" if quantity.equation else ""
    option = f"; {quantity.option}" if quantity.option else ""
    return [name, quantity.symbol, pretty(quantity.unit), f"{quantity.sentence}{equation}{option}"]


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
    }
    say(f"{name}: {quantity.sentence}", out)
    for head, text in facts.items():
        if text:
            say_wrapped(f"  {head:13} {text}", out, 16)
