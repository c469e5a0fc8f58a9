"""Materials by name: the shipped ones and those of the user's files, which take precedence.

The properties of a material are read and checked when it is asked for. A mistake in one material of a file does not keep a user
from the others.
"""

from collections.abc import Iterable, Mapping, Sequence
from functools import cache
from types import MappingProxyType
from typing import TYPE_CHECKING, Any, NamedTuple

from ..errors import JkrollError
from ..quantities.errors import QuantityError
from ..quantities.naming import named
from ..quantities.nomenclature import NOMENCLATURE, PROPERTIES
from ..quantities.ranges import value_of
from ..text import closest, first_of, quoted, shown
from .entries import SHIPPED, Entry, File, Malformed, Path, entries_of, string, strings, texts
from .file import MaterialsFileError

if TYPE_CHECKING:
    from ..quantities.uncertain import Uncertain

MAX_LISTED = 20


class Origin(NamedTuple):
    """The way in which a property was found: the method, the contact law assumed, and the key of the reference."""

    method: str = ""
    law: str = ""
    reference: str = ""


class Material(NamedTuple):
    """A material: its properties in SI units, and their sources."""

    name: str
    properties: Mapping[str, float]
    aliases: tuple[str, ...]
    notes: Mapping[str, str]  # by property or alias
    remarks: tuple[str, ...]  # on the name by which the material was found, and on materials that it replaces
    references: tuple[Mapping[str, str], ...]
    title: str  # of the set: "Table 1"
    path: str
    state: str = ""  # "below 175 K"
    uncertainties: Mapping[str, "Uncertain"] = MappingProxyType({})  # of properties that have one
    origins: Mapping[str, Origin] = MappingProxyType({})  # of properties whose origin is stated


class UnknownMaterial(JkrollError):
    """Error raised for a material that no file describes, or for the name of several states of one."""

    def __init__(self, name: str, known: Sequence[str], guess: str | None, states: Sequence[str] = ()) -> None:
        super().__init__(name, tuple(known), guess, tuple(states))
        self.name, self.known, self.guess, self.states = name, tuple(known), guess, tuple(states)

    def __str__(self) -> str:
        if self.states:
            return f"material: {quoted(self.name)} has no values of its own; its states are {', '.join(self.states)}"
        hint = f"did you mean {self.guess}? " if self.guess else ""
        return f"material: {quoted(self.name)} is not known; {hint}known are {first_of(self.known, MAX_LISTED)}"


class Materials:
    """All known materials, by name or alias in any case."""

    def __init__(self, paths: Iterable[Path] = ()) -> None:
        """Read the shipped file, then each of `paths`. A material shadows those of the same name in earlier files."""
        self._entries: dict[str, Entry] = {}
        self._read: dict[str, Material] = {}
        self._name_of: dict[str, str] = {}  # by name or alias, case folded
        for path in dict.fromkeys((SHIPPED, *paths)):
            for entry in entries_of(path):
                self._add(entry)

    def _add(self, entry: Entry) -> None:
        """Add a material, with a note on each name that it takes from a material of another file."""
        for word in dict.fromkeys(word.casefold() for word in (entry.name, *entry.aliases)):
            before = self._entries.get(self._name_of.get(word, ""))
            if before is not None and before.file is not entry.file:
                note = f"{shown(entry.file.path)} shadows {shown(word)} of {shown(before.file.title)}"
                entry = entry._replace(remarks=(*entry.remarks, note))
                if before.name.casefold() == entry.name.casefold():
                    del self._entries[before.name]
                    self._name_of |= {alias.casefold(): entry.name for alias in before.aliases}
            self._name_of[word] = entry.name
        self._entries[entry.name] = entry

    def __getitem__(self, word: str) -> Material:
        """Return the material of a name or alias, in any case.

        Raises UnknownMaterial, with a suggestion or the states of the material, and MaterialsFileError if something is wrong
        with it.
        """
        key = word.strip().casefold()
        name = self._name_of.get(key)
        if name is None:
            states = [known for known in self._entries if known.casefold().startswith(f"{key}-")]
            guess = None if states else closest(key, self._name_of)
            raise UnknownMaterial(word, sorted(self._entries), guess and self._name_of[guess], states)
        found = self._named(name)
        on_alias = [note for alias, note in found.notes.items() if alias.casefold() == key]
        return found._replace(remarks=(*found.remarks, *on_alias)) if on_alias else found

    def _named(self, name: str) -> Material:
        if name not in self._read:
            self._read[name] = _material(self._entries[name])
        return self._read[name]

    @property
    def materials(self) -> Mapping[str, Material]:
        """All materials by name; MaterialsFileError if something is wrong with one of them."""
        return {name: self._named(name) for name in self._entries}

    @property
    def names(self) -> list[str]:
        """The names of all materials."""
        return [*self._entries]

    @property
    def aliases(self) -> list[str]:
        """The other names of all materials."""
        return [alias for entry in self._entries.values() for alias in entry.aliases]


def known_materials(*paths: Path) -> Materials:
    """Return the shipped materials, which are read once, and those of `paths`, which are read anew."""
    return Materials(paths) if paths else _shipped()


@cache
def _shipped() -> Materials:
    return Materials()


def read(path: Path) -> list[Material]:
    """Read and check a materials file as a whole; MaterialsFileError says what is wrong with it."""
    return [_material(entry) for entry in entries_of(path)]


def _material(entry: Entry) -> Material:
    """Read and check a material; MaterialsFileError if something is wrong with it."""
    try:
        return _checked(entry)
    except Malformed as error:
        raise MaterialsFileError(entry.file.path, str(error)) from None


def _checked(entry: Entry) -> Material:
    name, aliases, file, remarks = entry
    table = file.materials[name]
    _refuse_unknown_keys(name, table, (*PROPERTIES, "aliases", "notes", "references", "state", "source"))
    properties: dict[str, float] = {}
    uncertainties: dict[str, Uncertain] = {}
    origins: dict[str, Origin] = {}
    for key in PROPERTIES:
        if key not in table:
            continue
        value = table[key]
        if isinstance(value, dict):
            origins[key] = _origin(f"{name}.{key}", value)
            value = value.get("value")
        found = _property(key, value, name)
        properties[key] = found if isinstance(found, float) else found.value
        if not isinstance(found, float):
            uncertainties[key] = found
    notes = texts(table.get("notes", {}), f"{name}.notes")
    for key in notes:
        if key not in properties and key not in aliases:
            raise Malformed(f"{quoted(name)} has a note on {quoted(key)}, which it does not give")
    general = strings(table.get("references", []), f"{name}.references")
    cited = dict.fromkeys([*general, *(origin.reference for origin in origins.values() if origin.reference)])
    return Material(
        name,
        MappingProxyType(properties),
        aliases,
        MappingProxyType(notes),
        remarks,
        tuple(_reference(key, name, file) for key in cited),
        string(table.get("source", file.title), f"{name}.source"),
        file.path,
        string(table.get("state", ""), f"{name}.state"),
        MappingProxyType(uncertainties),
        MappingProxyType(origins),
    )


def _origin(where: str, table: Mapping[str, Any]) -> Origin:
    """Return what the table of a property says besides the value."""
    _refuse_unknown_keys(where, table, ("value", *Origin._fields))
    return Origin(**texts({key: text for key, text in table.items() if key != "value"}, where))


def _refuse_unknown_keys(where: str, table: Mapping[str, Any], known: Sequence[str]) -> None:
    for key in table:
        if key not in known:
            guess = closest(named(key), known)
            hint = f"; did you mean {guess}?" if guess else ""
            raise Malformed(f"{quoted(where)} has an unknown key {quoted(key)}{hint}")


def _reference(key: str, name: str, file: File) -> Mapping[str, str]:
    """Return a reference that a material cites."""
    if key not in file.references:
        raise Malformed(f"{quoted(name)} cites {quoted(key)}, which [references] does not have")
    return {"key": key, **texts(file.references[key], f"references.{key}")}


def _property(key: str, value: object, name: str) -> "float | Uncertain":
    """Return the SI value of a property: a text with a unit or, for a property without a unit, a number."""
    if isinstance(value, (int, float)) and not isinstance(value, bool) and NOMENCLATURE[key].unit == "1":
        value = repr(value)
    text = string(value, f"{name}.{key}")
    try:
        return value_of(text, key)
    except QuantityError as error:
        raise Malformed(f"{shown(name)}: {error}") from None
