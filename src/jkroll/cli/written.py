"""Output of a call: its format, the units and digits of results, and the kinds of pictures."""

import sys
from collections.abc import Sequence

from ..errors import BadRequest
from ..quantities.formatting import Format
from ..quantities.nomenclature import NOMENCLATURE
from ..quantities.units import BadUnit, Unit, dimension_of, parse_unit
from ..quantities.values import error_about
from ..text import quoted
from .options import Call

FORMATS = ("bare", "json", "csv", "explain", "cite")
PICTURES = ("svg", "pdf", "png")


def format_name(call: Call) -> str:
    """Return the name of the output format: the one that was chosen, else a table on a terminal and plain lines in a pipe.

    A name of the output file that ends in .json chooses JSON.
    """
    chosen = [name for name in FORMATS if getattr(call, name)]
    if len(chosen) > 1:
        raise BadRequest(f"--{chosen[0]} and --{chosen[1]} exclude each other")
    if is_json(call.target):
        if chosen and chosen != ["json"]:
            raise BadRequest(f"-o {quoted(call.target or '')} and --{chosen[0]} exclude each other")
        return "json"
    if chosen:
        return chosen[0]
    return "table" if sys.stdout.isatty() else "plain"


def format_of(call: Call, quantities: Sequence[str]) -> Format:
    """Return the format of results; each unit of `--to` applies to the quantities of its dimension."""
    units: dict[str, tuple[str, Unit]] = {}
    for text in call.to.split(",") if call.to is not None else []:
        try:
            unit = parse_unit(text)
        except BadUnit as error:
            wanted = [dimension_of(NOMENCLATURE[name].unit) for name in quantities]
            raise error_about(
                "--to", text, error, wanted, f"expected a unit such as {NOMENCLATURE[quantities[0]].unit}"
            ) from None
        fitting = [
            name for name in quantities if text.strip() and dimension_of(NOMENCLATURE[name].unit) == unit.dimension
        ]
        if not fitting:
            units_of_results = ", ".join(dict.fromkeys(NOMENCLATURE[name].unit for name in quantities))
            raise BadRequest(f"--to: {quoted(text)} fits none of the results, which are in: {units_of_results}")
        if fitting[0] in units:
            raise BadRequest(
                f"--to: {quoted(units[fitting[0]][0])} and {quoted(text)} are units of one dimension; give one of them"
            )
        units |= dict.fromkeys(fitting, (" ".join(text.split()), unit))
    return Format(units, call.digits)


def no_picture(flag: str, path: str, remedy: str = "") -> BadRequest:
    """Return the error for a file name whose ending is not that of a picture; `remedy` says how else the numbers are written."""
    endings = f".{', .'.join(PICTURES[:-1])} or .{PICTURES[-1]}"
    return BadRequest(f"{flag}: {quoted(path)} does not end in {endings}{remedy}")


def ending(path: str) -> str:
    """Return the ending of a file name, in lower case and without its point.

    >>> ending("a/Map.SVG"), ending("svg")
    ('svg', '')
    """
    _, point, end = path.rpartition(".")
    return end.casefold() if point else ""


def is_json(target: str | None) -> bool:
    """Return whether an output file was named whose name says that it is JSON."""
    return target is not None and ending(target) == "json"
