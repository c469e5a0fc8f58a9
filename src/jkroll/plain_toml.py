"""TOML as materials files mostly are, read several times as fast: every line is a header, or a key and its value.

Lines of the most frequent forms are read by a pattern. The value in any other line is read by tomllib, alone: a line that is
complete means the same wherever it stands. A line that is none of these, and a key that is said twice, is left to a reading of
the whole by tomllib, with its words for what is wrong.
"""

import re
from typing import Any

MAX_ODD = 20_000  # what tomllib may cost: characters, and 30 for each call

_NAME = r"[A-Za-z0-9_-]+"
_ITEMS = r'(?:"[^"\\]*"[ \t]*,[ \t]*)*(?:"[^"\\]*"[ \t]*)?'
_HEADER = re.compile(rf'\[({_NAME})\.(?:({_NAME})|"([^"\\]*)")\][ \t]*(?:#.*)?')
_KEY = re.compile(rf"(?:({_NAME})\.)?({_NAME})[ \t]*=[ \t]*")
_VALUE = re.compile(rf'(?:"([^"\\]*)"|((?:0|[1-9][0-9]*)\.[0-9]+)|\[[ \t]*({_ITEMS})\])[ \t]*(?:#.*)?')
_ITEM = re.compile('"([^"]*)"')
_CONTROL = re.compile("[\x00-\x08\x0b-\x1f\x7f]")


class NotPlain(Exception):
    """A line that is not complete, or says something twice. `line` counts from 1."""

    def __init__(self, line: int) -> None:
        super().__init__(line)
        self.line = line


def read_plainly(text: str) -> dict[str, Any]:
    r"""What tomllib reads from a text, if every line is plain; else NotPlain.

    >>> read_plainly('[materials.ice]  # mine\ndensity = "1 g/cm3"')
    {'materials': {'ice': {'density': '1 g/cm3'}}}
    """
    text = text.replace("\r\n", "\n")
    if found := _CONTROL.search(text):
        raise NotPlain(text.count("\n", 0, found.start()) + 1)
    root: dict[str, Any] = {}
    groups: dict[str, dict[str, Any]] = {}  # what headers made of it
    dotted: dict[str, dict[str, Any]] = {}  # what keys of two parts made of the table of the last header
    table, odd = root, 0
    for number, line in enumerate(map(_stripped, text.split("\n")), 1):
        if not line or line[0] == "#":
            continue
        if key := _KEY.match(line):
            outer, name = key.groups()
            place = table
            if outer is not None:
                if outer not in dotted:
                    dotted[outer] = _new(table, outer, number)
                place = dotted[outer]
            if name in place:
                raise NotPlain(number)
            if value := _VALUE.fullmatch(line, key.end()):
                word, decimal, items = value.groups()
                place[name] = word if word is not None else float(decimal) if decimal else _ITEM.findall(items)
                continue
            odd += 30 + len(line)
            if odd > MAX_ODD:
                raise NotPlain(number)
            place[name] = _odd_value(line[key.end() :], number)
        elif header := _HEADER.fullmatch(line):
            group, bare, name = header.groups()
            if group not in groups:
                groups[group] = _new(root, group, number)
            table, dotted = _new(groups[group], bare or name, number), {}
        else:
            raise NotPlain(number)
    return root


def _new(table: dict[str, Any], name: str, number: int) -> dict[str, Any]:
    """A table by a name that a table does not have."""
    if name in table:
        raise NotPlain(number)
    made: dict[str, Any] = {}
    table[name] = made
    return made


def _stripped(line: str) -> str:
    return line.strip(" \t")


def _odd_value(text: str, number: int) -> Any:
    """The value that a text is, whatever TOML allows in a line."""
    import tomllib

    try:
        return tomllib.loads(f"value = {text}")["value"]
    except (ValueError, RecursionError):
        raise NotPlain(number) from None
