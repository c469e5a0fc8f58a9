"""The entries of a materials file: the materials with their names checked, and their tables as they stand."""

import os
from collections.abc import Mapping
from typing import Any, NamedTuple

from ..text import quoted, shown
from .file import MaterialsFileError, data_of

Path = str | os.PathLike[str]
MAX_NAME = 60

_HERE = os.path.dirname(os.path.abspath(__file__))
# A wheel has the file here, and a checkout at its top level.
_PLACES = (os.path.join(folder, "materials.toml") for folder in (_HERE, os.path.join(_HERE, *[os.pardir] * 3)))
SHIPPED = next(path for path in _PLACES if os.path.exists(path))


class File(NamedTuple):
    """A materials file, of which only the form has been checked."""

    path: str
    title: str
    materials: Mapping[str, Any]
    references: Mapping[str, Any]


class Entry(NamedTuple):
    """A material in a file, of which only the names have been checked."""

    name: str
    aliases: tuple[str, ...]
    file: File
    remarks: tuple[str, ...] = ()


def is_material_name(word: str) -> bool:
    """Return whether a word can name a material: it differs from a radius and from a list.

    >>> is_material_name("SiO2"), is_material_name("100nm"), is_material_name("a,b"), is_material_name("all")
    (True, False, False, False)
    """
    return (
        word[:1].isalpha()
        and word == word.strip()
        and len(word) <= MAX_NAME
        and word.isprintable()
        and "," not in word
        and word.casefold() not in ("all", "plane")
    )


class Malformed(Exception):
    """Error raised for something in a materials file that is not a material; the file is named where it is caught."""


def entries_of(path: Path) -> list[Entry]:
    """Return the materials of a file, with their names checked."""
    name = os.fspath(path)
    data = _shipped_data() if name == SHIPPED else data_of(name)
    try:
        return _entries_in(_form_of(data, name))
    except Malformed as error:
        raise MaterialsFileError(name, str(error)) from None


def _shipped_data() -> Mapping[str, Any]:
    """Return the content of the shipped file, which a wheel also holds as a module, made when it was built."""
    if os.path.dirname(SHIPPED) != _HERE:  # a checkout
        return data_of(SHIPPED)
    from .shipped import DATA  # type: ignore  # mypy does not find it, or finds it without types

    return dict(DATA)


def _form_of(data: Mapping[str, Any], path: str) -> File:
    """Check the outermost level of a file."""
    unknown = set(data) - {"title", "materials", "references"}
    if unknown:
        raise Malformed(f"has an unknown key {quoted(min(unknown))}; expected [materials.NAME] tables")
    title = string(data.get("title", shown(path)), "title")
    return File(path, title, *(table_of(data.get(name, {}), name) for name in ("materials", "references")))


def _entries_in(file: File) -> list[Entry]:
    """Check the names and aliases of all materials of a file."""
    seen: dict[str, str] = {}
    entries: list[Entry] = []
    for name, table in file.materials.items():
        aliases = strings(table_of(table, f"materials.{name}").get("aliases", []), f"{name}.aliases")
        for word in (name, *aliases):
            other = seen.setdefault(word.casefold(), name)
            if other != name:
                both = f"{quoted(other)} and {quoted(name)}"
                raise Malformed(f"{quoted(word)} names both {both}; case makes no difference")
            if not is_material_name(word):
                raise Malformed(f"{quoted(word)} cannot name a material; a name begins with a letter and has no comma")
        entries.append(Entry(name, aliases, file))
    return entries


def table_of(value: object, where: str) -> Mapping[str, Any]:
    """Return a value that is a table; Malformed if it is not."""
    if not isinstance(value, dict):
        raise Malformed(f"{shown(where)} is not a table")
    return value


def texts(value: object, where: str) -> dict[str, str]:
    """Return a table of texts."""
    return {key: string(text, f"{where}.{key}") for key, text in table_of(value, where).items()}


def strings(value: object, where: str) -> tuple[str, ...]:
    """Return a list of texts."""
    if not isinstance(value, list):
        raise Malformed(f"{shown(where)} is not a list")
    return tuple(string(text, where) for text in value)


def string(value: object, where: str) -> str:
    """Return a value that is a text, safe to print; Malformed if it is not a text."""
    if not isinstance(value, str):
        raise Malformed(f"{shown(where)} is not a text in quotes")
    return shown(value)
