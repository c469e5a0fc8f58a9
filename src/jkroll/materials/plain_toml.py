"""TOML as materials files mostly are, read several times as fast: headers, and keys each with a value in its line.

Values of the most frequent forms are read by a pattern. Any other is read by tomllib, alone: a value that is complete means the
same wherever it stands. A list may go on to the next line that begins with its closing bracket. What is none of these, and a key
that is said twice, is left to a reading of the whole by tomllib, with its words for what is wrong.
"""

import re
from typing import Any

MAX_ODD = 4000  # what tomllib may cost: characters, and 30 for each call

_NAME = r"[A-Za-z0-9_-]+"
_TEXT = r"""(?:"[^"\\\n]*"|'[^'\n]*')"""
_ITEMS = rf"(?:{_TEXT}[ \t\n]*,[ \t\n]*)*(?:{_TEXT}[ \t\n]*)?"
_HEADER = re.compile(rf'\[({_NAME})\.(?:({_NAME})|"([^"\\]*)")(?:\.({_NAME}))?\][ \t]*(?:#.*)?')
_KEY = re.compile(rf"(?:({_NAME})\.)?({_NAME})[ \t]*=[ \t]*")
_PAIR = rf"{_NAME}[ \t]*=[ \t]*{_TEXT}[ \t]*"
_FORMS = rf"({_TEXT})|((?:0|[1-9][0-9]{{0,15}})(?:\.[0-9]+)?)|\[[ \t\n]*({_ITEMS})\]|\{{[ \t]*({_PAIR}(?:,[ \t]*{_PAIR})*)\}}"
_VALUE = re.compile(rf"(?:{_FORMS})[ \t]*(?:#.*)?")
_ITEM = re.compile(_TEXT)
_ENTRY = re.compile(rf"({_NAME})[ \t]*=[ \t]*({_TEXT})")
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
    return _Document(text.replace("\r\n", "\n")).read()


class _Document:
    """A text on the way to what it says."""

    def __init__(self, text: str) -> None:
        if found := _CONTROL.search(text):
            raise NotPlain(text.count("\n", 0, found.start()) + 1)
        self.lines = text.split("\n")
        self.numbered = enumerate(map(_stripped, self.lines), 1)
        self.root: dict[str, Any] = {}
        self.groups: dict[str, dict[str, Any]] = {}  # what headers made of it
        self.table = self.root  # of the last header
        self.dotted: dict[str, dict[str, Any]] = {}  # what keys of two parts made of that
        self.odd = 0

    def read(self) -> dict[str, Any]:
        """All that it says."""
        for number, line in self.numbered:
            if not line or line[0] == "#":
                continue
            if key := _KEY.match(line):
                outer, name = key.groups()
                place = self.table if outer is None else self._table_of_keys(outer, number)
                if name in place:
                    raise NotPlain(number)
                told = line[key.end() :]
                if told[:1] == "[" and "]" not in told:
                    told = self._list_from(number)
                value = _VALUE.fullmatch(told)
                place[name] = _value_of(number, *value.groups()) if value else self._odd_value(told, number)
            elif header := _HEADER.fullmatch(line):
                group, bare, quoted, part = header.groups()
                self._begin(group, bare or quoted, part, number)
            else:
                raise NotPlain(number)
        return self.root

    def _begin(self, group: str, name: str, part: str | None, number: int) -> None:
        """Begin the table of a header."""
        if group not in self.groups:
            self.groups[group] = _new(self.root, group, number)
        tables = self.groups[group]
        if part is not None and name not in tables:
            raise NotPlain(number)
        self.table = _new(tables, name, number) if part is None else _new(tables[name], part, number)
        self.dotted = {}

    def _table_of_keys(self, name: str, number: int) -> dict[str, Any]:
        """The table that keys of two parts make."""
        if name not in self.dotted:
            self.dotted[name] = _new(self.table, name, number)
        return self.dotted[name]

    def _list_from(self, number: int) -> str:
        """A list that begins in a line, with the lines to the one that ends it."""
        last = next((last for last, line in self.numbered if line[:1] == "]"), len(self.lines))
        first = self.lines[number - 1]
        return "\n".join([first[first.index("=") + 1 :], *self.lines[number:last]]).strip(" \t")

    def _odd_value(self, text: str, number: int) -> Any:
        """The value that a text is, whatever TOML allows for one."""
        import tomllib

        self.odd += 30 + len(text)
        if self.odd > MAX_ODD:
            raise NotPlain(number)
        try:
            (value,) = tomllib.loads(f"value = {text}").values()
        except (ValueError, RecursionError):  # it is none, or more than one
            raise NotPlain(number) from None
        return value


def _value_of(number: int, word: str | None, digits: str | None, items: str | None, pairs: str | None) -> Any:
    """The value of which a pattern found one of four forms."""
    if word is not None:
        return word[1:-1]
    if digits is not None:
        return float(digits) if "." in digits else int(digits)
    if items is not None:
        return [item[1:-1] for item in _ITEM.findall(items)]
    found = _ENTRY.findall(pairs or "")
    made = {name: text[1:-1] for name, text in found}
    if len(made) < len(found):
        raise NotPlain(number)
    return made


def _new(table: dict[str, Any], name: str, number: int) -> dict[str, Any]:
    """A table by a name that a table does not have."""
    if name in table:
        raise NotPlain(number)
    made: dict[str, Any] = {}
    table[name] = made
    return made


def _stripped(line: str) -> str:
    return line.strip(" \t")
