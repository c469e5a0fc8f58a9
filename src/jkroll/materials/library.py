"""Materials: the shipped file and the user's own, read, checked and laid over each other."""

import os
from collections.abc import Iterable, Mapping, Sequence
from functools import cache
from types import MappingProxyType
from typing import Any, NamedTuple

from ..errors import JkrollError
from ..quantities.errors import QuantityError
from ..quantities.nomenclature import NOMENCLATURE, PROPERTIES
from ..quantities.parsing import parse_quantity
from ..text import quoted, shown
from .file import MaterialsFileError, data_of

Path = str | os.PathLike[str]
MAX_NAME = 60

_HERE = os.path.dirname(os.path.abspath(__file__))
# The wheel carries the file beside this module; a checkout has it at the top level.
_PLACES = (os.path.join(folder, "materials.toml") for folder in (_HERE, os.path.join(_HERE, *[os.pardir] * 3)))
SHIPPED = next(path for path in _PLACES if os.path.exists(path))


class Material(NamedTuple):
    """A material: its properties in SI units, and where they come from."""

    name: str
    properties: Mapping[str, float]
    aliases: tuple[str, ...]
    notes: Mapping[str, str]  # on properties
    shadows: tuple[str, ...]  # what it took the place of
    references: tuple[Mapping[str, str], ...]
    title: str  # what the file calls itself: "Table 1"
    path: str


class _File(NamedTuple):
    """What a materials file says, of which only the form was looked at."""

    path: str
    title: str
    materials: Mapping[str, Any]
    references: Mapping[str, Any]


class _Entry(NamedTuple):
    """A material as a file has it, of which only the names were looked at."""

    name: str
    aliases: tuple[str, ...]
    file: _File
    shadows: tuple[str, ...] = ()


class Materials:
    """All materials that are known, by name or alias in any case. Of a material no more is read than is asked."""

    def __init__(self, paths: Iterable[Path] = ()) -> None:
        """Read the shipped file, then each of `paths`, whose materials shadow those before them."""
        self._entries: dict[str, _Entry] = {}
        self._made: dict[str, Material] = {}
        self._by_word: dict[str, str] = {}
        for path in dict.fromkeys((SHIPPED, *paths)):
            for entry in _entries(path):
                self._add(entry)

    def _add(self, entry: _Entry) -> None:
        """Add a material; one that takes a word from a material of another file says so."""
        for word in dict.fromkeys(word.casefold() for word in (entry.name, *entry.aliases)):
            before = self._entries.get(self._by_word.get(word, ""))
            if before is not None and before.file is not entry.file:
                note = f"{shown(entry.file.path)} shadows {shown(word)} of {shown(before.file.title)}"
                entry = entry._replace(shadows=(*entry.shadows, note))
                if before.name.casefold() == entry.name.casefold():
                    del self._entries[before.name]
                    self._by_word |= {alias.casefold(): entry.name for alias in before.aliases}
            self._by_word[word] = entry.name
        self._entries[entry.name] = entry

    def __getitem__(self, name: str) -> Material:
        """The material of a name or alias, in any case; UnknownMaterial with a suggestion if there is none.

        MaterialsFileError if its file says something of it that cannot be.
        """
        found = self._by_word.get(name.strip().casefold())
        if found is None:
            from ..text import closest

            guess = closest(name.strip().casefold(), self._by_word)
            raise UnknownMaterial(name, sorted(self._entries), guess and self._by_word[guess])
        return self._read(found)

    def _read(self, name: str) -> Material:
        if name not in self._made:
            self._made[name] = _material(self._entries[name])
        return self._made[name]

    @property
    def materials(self) -> Mapping[str, Material]:
        """All of them, by their names; MaterialsFileError if a file says something of one that cannot be."""
        return {name: self._read(name) for name in self._entries}

    @property
    def names(self) -> list[str]:
        """Their names."""
        return [*self._entries]

    @property
    def aliases(self) -> list[str]:
        """Their other names."""
        return [alias for entry in self._entries.values() for alias in entry.aliases]


def known_materials(*paths: Path) -> Materials:
    """The materials of the shipped file, which is read once, and of `paths`, which may have changed."""
    return Materials(paths) if paths else _shipped()


@cache
def _shipped() -> Materials:
    return Materials()


def read(path: Path) -> list[Material]:
    """Read and check one materials file whole; MaterialsFileError says what is wrong with it."""
    return [_material(entry) for entry in _entries(path)]


def _shipped_data() -> Mapping[str, Any]:
    """What the shipped file says: the wheel holds it as a module too, made when it was built; a checkout does not."""
    try:
        from .shipped import DATA  # type: ignore  # mypy does not see it, or sees it without types
    except ImportError:
        return data_of(SHIPPED)
    return dict(DATA)


class _Malformed(Exception):
    """Something in a materials file that is no material."""


def _entries(path: Path) -> list[_Entry]:
    """The materials of a file; MaterialsFileError if it is none."""
    name = os.fspath(path)
    data = _shipped_data() if name == SHIPPED else data_of(name)
    try:
        return _named(data, name)
    except _Malformed as error:
        raise MaterialsFileError(name, str(error)) from None


def _named(data: Mapping[str, Any], path: str) -> list[_Entry]:
    unknown = set(data) - {"title", "materials", "references"}
    if unknown:
        raise _Malformed(f"has an unknown key {quoted(min(unknown))}; expected [materials.NAME] tables")
    title = _string(data.get("title", shown(path)), "title")
    tables = (_table(data.get(name, {}), name) for name in ("materials", "references"))
    file = _File(path, title, *tables)
    seen: dict[str, str] = {}
    entries: list[_Entry] = []
    for name, table in file.materials.items():
        aliases = _list(_table(table, f"materials.{name}").get("aliases", []), f"{name}.aliases")
        words = tuple(_string(alias, f"{name}.aliases") for alias in aliases)
        for word in (name, *words):
            other = seen.setdefault(word.casefold(), name)
            if other != name:
                raise _Malformed(
                    f"{quoted(word)} names both {quoted(other)} and {quoted(name)}; case makes no difference"
                )
            if not is_material_name(word):
                raise _Malformed(f"{quoted(word)} is no name for a material; one begins with a letter and has no comma")
        entries.append(_Entry(name, words, file))
    return entries


_KEYS = {*PROPERTIES, "aliases", "notes", "references"}


def _material(entry: _Entry) -> Material:
    """A material with all that its file says of it; MaterialsFileError if that cannot be."""
    try:
        return _checked(entry)
    except _Malformed as error:
        raise MaterialsFileError(entry.file.path, str(error)) from None


def _checked(entry: _Entry) -> Material:
    name, aliases, file, shadows = entry
    table = file.materials[name]
    for key in table:
        if key not in _KEYS:
            from ..text import closest

            guess = closest(key, _KEYS)
            raise _Malformed(
                f"{quoted(name)} has an unknown key {quoted(key)}" + (f"; did you mean {guess}?" if guess else "")
            )
    properties = {key: _property(key, table[key], name) for key in PROPERTIES if key in table}
    notes = _texts(table.get("notes", {}), f"{name}.notes")
    if set(notes) - properties.keys():
        raise _Malformed(
            f"{quoted(name)} has a note on {quoted(min(set(notes) - properties.keys()))}, which it does not give"
        )
    cited = tuple(_reference(key, name, file) for key in _list(table.get("references", []), f"{name}.references"))
    return Material(
        name, MappingProxyType(properties), aliases, MappingProxyType(notes), shadows, cited, file.title, file.path
    )


def _reference(value: object, name: str, file: _File) -> Mapping[str, str]:
    """What a material cites."""
    key = _string(value, f"{name}.references")
    if key not in file.references:
        raise _Malformed(f"{quoted(name)} cites {quoted(key)}, which [references] does not have")
    return {"key": key, **_texts(file.references[key], f"references.{key}")}


def _property(key: str, value: object, name: str) -> float:
    """A property: a text with a unit, or, if it has no unit, a number."""
    if isinstance(value, (int, float)) and not isinstance(value, bool) and NOMENCLATURE[key].unit == "1":
        value = repr(value)
    try:
        return parse_quantity(_string(value, f"{name}.{key}"), key)
    except QuantityError as error:
        raise _Malformed(f"{shown(name)}: {error}") from None


def is_material_name(word: str) -> bool:
    """Whether a word can name a material: on a command line it must be told from a radius, and in a list from two.

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


def _table(value: object, where: str) -> Mapping[str, Any]:
    if not isinstance(value, dict):
        raise _Malformed(f"{shown(where)} is not a table")
    return value


def _texts(value: object, where: str) -> dict[str, str]:
    """A table of texts."""
    return {
        key: shown(text) if isinstance(text, str) else _string(text, f"{where}.{key}")
        for key, text in _table(value, where).items()
    }


def _list(value: object, where: str) -> list[Any]:
    if not isinstance(value, list):
        raise _Malformed(f"{shown(where)} is not a list")
    return value


def _string(value: object, where: str) -> str:
    if not isinstance(value, str):
        raise _Malformed(f"{shown(where)} is not a text in quotes")
    return shown(value)


MAX_KNOWN = 20


class UnknownMaterial(JkrollError):
    """A material that no file describes."""

    def __init__(self, name: str, known: Sequence[str], guess: str | None) -> None:
        super().__init__(name, tuple(known), guess)
        self.name, self.known, self.guess = name, tuple(known), guess

    def __str__(self) -> str:
        hint = f"did you mean {self.guess}? " if self.guess else ""
        return f"material: {quoted(self.name)} is not known; {hint}known are {', '.join(self.known[:MAX_KNOWN])}" + (
            f" and {len(self.known) - MAX_KNOWN} more" if len(self.known) > MAX_KNOWN else ""
        )
