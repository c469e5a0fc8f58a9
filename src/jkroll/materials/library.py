"""Materials by name: the shipped ones and those of the user's files, which take precedence.

A file is TOML of a size that cannot keep a call waiting. A mistake in one material of a file does not keep a user from
the others: it is raised when that material is asked for.
"""

import os
import sys
from collections.abc import Iterable, Mapping, Sequence
from functools import cache, cached_property
from stat import S_ISREG
from types import MappingProxyType
from typing import Any, NamedTuple, TypeVar

from ..errors import BadRequest, JkrollError
from ..physics.elementary import cbrt, smaller_and_larger, sqrt
from ..quantities.errors import QuantityError
from ..quantities.nomenclature import NOMENCLATURE, PROPERTIES, XI, named
from ..quantities.values import Interval, Uncertain, ends_of, is_uncertain, middle, value_of
from ..text import closest, quoted, shown

MAX_BYTES = 64_000  # some 180 materials with all their references
MAX_DOTS = 100  # in a line: a dotted key costs time and memory with the square of its parts


class MaterialsFileError(JkrollError):
    """Error raised when a materials file cannot be read, or when something in it is not a material."""

    def __init__(self, path: str, problem: str) -> None:
        super().__init__(path, problem)
        self.path, self.problem, self.phrase = path, problem, "bad materials file"

    def __str__(self) -> str:
        return f"materials file {quoted(self.path)}: {self.problem}"


class Malformed(Exception):
    """Error raised for something in a materials file that is not a material; the file is named where it is caught."""


def data_of(path: str) -> dict[str, Any]:
    """Read a TOML file; Malformed if it cannot be read or exceeds the limits above."""
    try:
        if not S_ISREG(os.stat(path).st_mode):
            raise Malformed("is not a regular file")
        with open(path, "rb") as file:
            content = file.read(MAX_BYTES + 1)
    except OSError as error:
        raise Malformed(error.strerror or "cannot be read") from None
    except ValueError:
        raise Malformed("is not a path") from None
    if len(content) > MAX_BYTES:
        raise Malformed(f"is larger than {MAX_BYTES // 1000} kB")
    import tomllib

    try:
        text = content.decode("utf-8-sig")
        if any(line.count(".") > MAX_DOTS for line in text.split("\n")):
            raise Malformed(f"has a line of more than {MAX_DOTS} dots")
        return tomllib.loads(text)
    except UnicodeDecodeError:
        raise Malformed("is not UTF-8") from None
    except ValueError as error:
        raise Malformed(f"is not TOML: {shown(str(error))}") from None
    except RecursionError:
        raise Malformed("is not TOML: nested too deeply") from None


# --- Names and forms --------------------------------------------------------------------------------------------------

Path = str | os.PathLike[str]
MAX_NAME = 60

_HERE = os.path.dirname(os.path.abspath(__file__))
# A wheel has the file here, and a checkout at its top level.
_PLACES = (os.path.join(folder, "materials.toml") for folder in (_HERE, os.path.join(_HERE, *[os.pardir] * 3)))
SHIPPED = next(path for path in _PLACES if os.path.exists(path))

_OF_A_NAME = f"a name begins with a letter, has no comma and {MAX_NAME} characters at most, and is not all or plane"


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


_Kind = TypeVar("_Kind", dict[str, Any], list[Any], str)
_KINDS: Mapping[type, str] = {dict: "a table", list: "a list", str: "a text in quotes"}


def checked(value: object, kind: type[_Kind], where: str) -> _Kind:
    """Return a value that is a table, a list or a text; Malformed if it is none. `where`: its place in the file."""
    if not isinstance(value, kind):
        raise Malformed(f"{shown(where)} is not {_KINDS[kind]}")
    return value


def text_of(value: object, where: str) -> str:
    """Return a text, safe to print."""
    return shown(checked(value, str, where))


def texts_of(values: object, where: str) -> tuple[str, ...]:
    """Return the texts of a list."""
    return tuple(text_of(text, where) for text in checked(values, list, where))


def table_of_texts(values: object, where: str) -> dict[str, str]:
    """Return a table of texts."""
    return {key: text_of(text, f"{where}.{key}") for key, text in checked(values, dict, where).items()}


# --- Materials --------------------------------------------------------------------------------------------------------


ORIGIN = ("method", "law", "reference")  # of a property: how it was found, by which contact law, and where it stands


class Displacement(NamedTuple):
    """A yield displacement with its ends, in SI units, and the radius of the identical pairs that were measured."""

    measured: Interval
    radius: float

    def scaled(self, radius: Any) -> Interval:
        """Return the displacement of identical pairs of another radius.

        It is the range between its growth with the radius of the contact, as R^(2/3), and with that of the spheres.
        """
        scale = radius / self.radius
        least, most = smaller_and_larger(scale, cbrt(scale) * cbrt(scale))
        value, low, high = self.measured.value, self.measured.low, self.measured.high
        return Interval._make((value * sqrt(least * most), low * least, high * most, "range"))


class Material(NamedTuple):
    """A material: its properties in SI units, and their sources."""

    name: str
    properties: Mapping[str, float]
    aliases: tuple[str, ...]
    notes: Mapping[str, str]  # by property
    remarks: tuple[str, ...]  # on the names that it takes from materials of other files
    references: tuple[Mapping[str, str], ...]
    title: str  # of the set: "Table 1"
    path: str
    state: str = ""  # "below 175 K"
    uncertainties: Mapping[str, "Uncertain"] = MappingProxyType({})  # of properties that have one
    origins: Mapping[str, Mapping[str, str]] = MappingProxyType({})  # of properties: what is stated of `ORIGIN`
    displacement: Displacement | None = None  # from which that of a contact follows
    replaced: frozenset[str] = frozenset()  # properties with another value than its data have

    @property
    def key(self) -> tuple[str, str]:
        """The file and the name, by which a material is the same, whatever became of its properties in a scene."""
        return self.path, self.name

    @property
    def measures(self) -> dict[str, "float | Uncertain"]:
        """The properties with their error bars, and the yield displacement as it was measured."""
        displacement = {} if self.displacement is None else {XI: self.displacement.measured}
        return {**self.properties, **self.uncertainties, **displacement}

    def with_properties(self, values: Mapping[str, Any]) -> "Material":
        """Return the material with other values of properties, which are not its data; None takes one away."""
        properties = {name: value for name, value in {**self.properties, **values}.items() if value is not None}
        return self._replace(properties=properties, replaced=self.replaced | values.keys())

    def sources_of(self, name: str) -> list[Mapping[str, str]]:
        """Return the references of a property: its own, or else those that belong to no other property."""
        of_properties = {name: origin["reference"] for name, origin in self.origins.items() if "reference" in origin}
        if name in of_properties:
            return [entry for entry in self.references if entry["key"] == of_properties[name]]
        return [entry for entry in self.references if entry["key"] not in of_properties.values()]

    def lack_of(self, name: str) -> str:
        """Return that it has no value of a property, with what its file says of that."""
        note = self.notes.get(name)
        return f"{self.name}: {note}" if note else f"{self.name} has none in {self.title}"

    def __hash__(self) -> int:
        return hash(self.key)

    def __reduce__(self) -> tuple[Any, ...]:
        """Return what pickle and copy take: a read-only mapping has no pickle of its own."""
        return _of_fields, tuple(dict(field) if isinstance(field, MappingProxyType) else field for field in self)


def _of_fields(*fields: Any) -> Material:
    """Return a material whose mappings are read-only."""
    return Material._make(MappingProxyType(field) if isinstance(field, dict) else field for field in fields)


# --- A file: its names are read at once, and a material when it is used -----------------------------------------------


class Entry:
    """A material of a file, which is read when it is used."""

    def __init__(
        self, path: str, title: str, name: str, table: Mapping[str, Any], references: Mapping[str, Any]
    ) -> None:
        """`title`: of the file; `table`: what it says of the material; `references`: all that it has."""
        self.path, self.name, self.table, self.references = path, name, table, references
        self.title = shown(str(table.get("source", title)))
        self.aliases = texts_of(table.get("aliases", []), f"{name}.aliases")
        self.words = {word.casefold(): word for word in (*self.aliases, name)}  # that stand for it
        self.remarks: tuple[str, ...] = ()  # on those that it takes from materials of other files

    @property
    def key(self) -> str:
        """The name, in which case makes no difference."""
        return self.name.casefold()

    @cached_property
    def material(self) -> Material:
        """The material; MaterialsFileError if something is wrong with it."""
        try:
            return read(self)
        except Malformed as error:
            raise MaterialsFileError(self.path, str(error)) from None

    @property
    def mistake(self) -> MaterialsFileError | None:
        """The error of what is wrong with the material."""
        try:
            _ = self.material
        except MaterialsFileError as error:
            return error
        return None


def entries_in(path: str) -> list[Entry]:
    """Return the materials of a file, unread; MaterialsFileError if it is no materials file."""
    try:
        data = _shipped_data() if path == SHIPPED else data_of(path)
        if unknown := set(data) - {"title", "materials", "references"}:
            name = "NAME" if closest(key := min(unknown), ["materials"]) else shown(key)
            raise Malformed(f"has an unknown key {quoted(key)}; expected [materials.{name}] tables")
        title = text_of(data.get("title", shown(path)), "title")
        tables, references = (checked(data.get(name, {}), dict, name) for name in ("materials", "references"))
        entries = [
            Entry(path, title, name, checked(table, dict, f"materials.{name}"), references)
            for name, table in tables.items()
        ]
        _check_names(entries)
    except Malformed as error:
        raise MaterialsFileError(path, str(error)) from None
    return entries


def _shipped_data() -> Mapping[str, Any]:
    """Return the content of the shipped file, which a wheel also holds as a module, made when it was built."""
    if os.path.dirname(SHIPPED) != _HERE:  # a checkout
        return data_of(SHIPPED)
    from .shipped import DATA  # type: ignore  # mypy does not find it, or finds it without types

    return dict(DATA)


def _check_names(entries: Sequence[Entry]) -> None:
    """Raise Malformed for a name that cannot be one, or is another material's. Several may have one alias."""
    names: dict[str, str] = {}
    for entry in entries:
        names.setdefault(entry.key, entry.name)
    for entry in entries:
        for key, word in entry.words.items():
            if names.get(key, entry.name) != entry.name:
                both = f"{quoted(names[key])} and {quoted(entry.name)}"
                raise Malformed(f"{quoted(word)} names both {both}; case makes no difference")
            if not is_material_name(word):
                raise Malformed(f"{quoted(word, MAX_NAME)} cannot name a material; {_OF_A_NAME}")


def read(entry: Entry) -> Material:
    """Return the material of an entry; Malformed if something is wrong with it."""
    name, table = entry.name, entry.table
    _refuse_unknown_keys(name, table, (*PROPERTIES, XI, "aliases", "notes", "references", "state", "source"))
    values: dict[str, float | Uncertain] = {}
    origins: dict[str, dict[str, str]] = {}
    for key in (key for key in (*PROPERTIES, XI) if key in table):
        value, where = table[key], f"{name}.{key}"
        if key == XI or isinstance(value, dict):
            origins[key] = _origin(checked(value, dict, where), ("value", *(["radius"] if key == XI else [])), where)
            value, where = value["value"], f"{where}.value"
        values[key] = _value(key, value, name, where)
    displacement = None
    if (measured := values.pop(XI, None)) is not None:
        radius = _value("radius", table[XI]["radius"], f"{name}.{XI}", f"{name}.{XI}.radius")
        if not isinstance(radius, float):
            raise Malformed(f"{shown(name)}.{XI}: the radius of the spheres is a single one")
        displacement = Displacement(Interval(middle(measured), *ends_of(measured)), radius)
    notes = table_of_texts(table.get("notes", {}), f"{name}.notes")
    for key in notes:
        if key not in (*PROPERTIES, *table):
            raise Malformed(f"{quoted(name)} has a note on {quoted(key)}, which it does not give")
    general = texts_of(table.get("references", []), f"{name}.references")
    cited = dict.fromkeys([*general, *(origin["reference"] for origin in origins.values() if "reference" in origin)])
    text_of(table.get("source", ""), f"{name}.source")
    return Material(
        name,
        MappingProxyType({key: middle(value) for key, value in values.items()}),
        entry.aliases,
        MappingProxyType(notes),
        entry.remarks,
        tuple(_reference(key, name, entry.references) for key in cited),
        entry.title,
        entry.path,
        text_of(table.get("state", ""), f"{name}.state"),
        MappingProxyType({key: value for key, value in values.items() if is_uncertain(value)}),
        MappingProxyType(origins),
        displacement,
    )


def _origin(table: Mapping[str, Any], needed: Sequence[str], where: str) -> dict[str, str]:
    """Return what the table of a property says of its origin, beside what such a table needs."""
    _refuse_unknown_keys(where, table, (*needed, *ORIGIN))
    for key in needed:
        if key not in table:
            raise Malformed(f"{shown(where)} has no {key}")
    return table_of_texts({key: table[key] for key in ORIGIN if table.get(key, "") != ""}, where)


def _refuse_unknown_keys(where: str, table: Mapping[str, Any], known: Sequence[str]) -> None:
    for key in table:
        if key not in known:
            guess = closest(named(key), known)
            hint = f"; did you mean {guess}?" if guess else ""
            raise Malformed(f"{quoted(where)} has an unknown key {quoted(key)}{hint}")


def _reference(key: str, name: str, references: Mapping[str, Any]) -> Mapping[str, str]:
    """Return a reference that a material cites."""
    if key not in references:
        raise Malformed(f"{quoted(name)} cites {quoted(key)}, which [references] does not have")
    return {"key": key, **table_of_texts(references[key], f"references.{key}")}


def _value(key: str, value: object, name: str, where: str) -> float | Uncertain:
    """Return the SI value of a property: a text with a unit or, for a property without a unit, a number."""
    is_number = isinstance(value, int | float) and not isinstance(value, bool)
    try:
        text = repr(value) if is_number and NOMENCLATURE[key].unit == "1" else value
        return value_of(text_of(text, where), key)
    except QuantityError as error:
        raise Malformed(f"{shown(name)}: {error}") from None
    except ValueError:  # thousands of hexadecimal digits, which Python does not convert
        raise Malformed(f"{shown(where)} has too many digits") from None


# --- Materials by name ------------------------------------------------------------------------------------------------


class UnknownMaterial(JkrollError):
    """Error raised for a material that no file describes."""

    def __init__(self, name: str, guess: str | None) -> None:
        super().__init__(name, guess)
        self.name, self.guess, self.phrase = name, guess, "unknown material"

    def __str__(self) -> str:
        if self.guess:
            return f"no material {quoted(self.name)}; did you mean {self.guess}? jkroll materials lists all"
        return (
            f"no material {quoted(self.name)}. Give its own numbers, as in jkroll pull-off 100nm --gamma 30mJ/m2 (an "
            f"example), add it to a file (jkroll guide materials), or write one that jkroll materials lists"
        )


class UnclearMaterial(JkrollError):
    """Error raised for a name that stands for several materials."""

    def __init__(self, name: str, meanings: str) -> None:
        super().__init__(name, meanings)
        self.name, self.meanings, self.phrase = name, meanings, "unclear material"

    def __str__(self) -> str:
        return f"material {quoted(self.name)} is {self.meanings}"


class Materials:
    """All known materials, by name or alias in any case. A name that stands for several is refused when used."""

    def __init__(self, paths: Path | Iterable[Path] = (), *, added: Iterable[Path] = ()) -> None:
        """Read the shipped file, then `added`, then that of `paths`, or each of them.

        A material takes the names that it shares with those of earlier files, but one of `added` takes none of the
        shipped file: to use such a name is an error.
        """
        self.overrides: list[str] = []  # sentences on the names that were taken
        self.clashes: dict[str, UnclearMaterial] = {}  # errors of the names that were not, case folded
        self._entries: dict[str, Entry] = {}  # by name, case folded
        self._meanings: dict[str, list[Entry]] = {}  # of a name or alias, case folded
        is_one = isinstance(paths, str | bytes) or not isinstance(paths, Iterable)
        taking = [*map(path_of, [paths] if is_one else paths)]  # type: ignore[arg-type]
        for path in dict.fromkeys((SHIPPED, *map(path_of, added), *taking)):
            self._add(entries_in(path), takes=path in taking)

    def _add(self, entries: Iterable[Entry], *, takes: bool) -> None:
        """Add the materials of a file under all of their names, or, unless they may be taken, those not shipped."""
        meanings: dict[str, list[Entry]] = {}
        for entry in entries:
            if not takes:
                self._leave_out_shipped(entry)
            file = shown(entry.path)
            taken = ((word, other.title) for key, word in entry.words.items() for other in self._called(key))
            entry.remarks = tuple(dict.fromkeys(f"{file} overrides {shown(word)} of {title}" for word, title in taken))
            self.overrides += entry.remarks
            for key in entry.words:
                self.clashes.pop(key, None)
                meanings.setdefault(key, []).append(entry)
        for entry in (entry for entry in entries if entry.words):
            self._entries.pop(entry.key, None)  # its other names are now those of this one
            self._entries[entry.key] = entry
        self._meanings |= meanings

    def _leave_out_shipped(self, entry: Entry) -> None:
        """Take away the names that are shipped: all if that of the material is one, which has no other names then."""
        file = shown(entry.path)
        clashes = {
            key: UnclearMaterial(
                word, f"shipped ({other.title}) and also in {file}; rename it, or pass --materials {file}"
            )
            for key, word in entry.words.items()
            for other in self._called(key)[:1]
            if other.path == SHIPPED
        }
        if entry.key in clashes:
            clashes = dict.fromkeys(entry.words, clashes[entry.key])
        self.clashes |= clashes
        entry.words = {key: word for key, word in entry.words.items() if key not in clashes}

    def _called(self, key: str) -> list[Entry]:
        """Return the materials that a name stands for: what has the name of one has its other names, too."""
        return [self._entries[entry.key] for entry in self._meanings.get(key, ())]

    def __getitem__(self, word: str) -> Material:
        """Return the material of a name or alias, in any case.

        Raises UnknownMaterial, UnclearMaterial for a name that stands for several, and MaterialsFileError for a bad
        material.
        """
        word = str(word)
        key = word.strip().casefold()
        if clash := self.clashes.get(key):
            raise clash
        states = [entry for name, entry in self._entries.items() if name.startswith(f"{key}-")]
        meanings = self._called(key)
        if len(meanings) == 1:
            return meanings[0].material
        if len(several := meanings or states) > 1:
            raise UnclearMaterial(word, _choice([entry.material for entry in several]))
        guess = states[0].name if states else closest(key, [*self.names, *self.aliases])
        raise UnknownMaterial(word, guess)

    @property
    def materials(self) -> Mapping[str, Material]:
        """All materials by name, without those with which something is wrong."""
        return {entry.name: entry.material for entry in self._entries.values() if entry.mistake is None}

    @property
    def mistakes(self) -> list[MaterialsFileError]:
        """The errors of the materials with which something is wrong."""
        return [entry.mistake for entry in self._entries.values() if entry.mistake is not None]

    @property
    def names(self) -> list[str]:
        """The names of all materials."""
        return [entry.name for entry in self._entries.values()]

    @property
    def aliases(self) -> list[str]:
        """The other names of all materials."""
        return [*dict.fromkeys(alias for entry in self._entries.values() for alias in entry.aliases)]


def known_materials(*paths: Path) -> Materials:
    """Return the shipped materials, which are read once, and those of `paths`, which are read anew."""
    return Materials(paths) if paths else _shipped()


@cache
def _shipped() -> Materials:
    return Materials()


def _choice(materials: Sequence[Material]) -> str:
    """Return the materials that a name stands for, with surface energies and states, or sets where these differ."""
    from ..quantities.formatting import amount

    has_sets = len({material.title for material in materials}) > 1
    texts = []
    for material in materials:
        energy = material.properties.get("surface_energy")
        known = [amount("surface_energy", energy)] if energy is not None else []
        about = ", ".join(filter(None, [*known, material.state or (material.title if has_sets else "")]))
        texts.append(f"{material.name} ({about})" if about else material.name)
    return f"one of several; write {', '.join(texts[:-1])} or {texts[-1]}"


def path_of(path: Path) -> str:
    """Return a path as a text; raise MaterialsFileError for what is none."""
    try:
        return os.fsdecode(path)
    except TypeError:
        raise MaterialsFileError(str(path), "is not a path") from None


# --- Places of the user's files ---------------------------------------------------------------------------------------

ENVIRONMENT = "JKROLL_MATERIALS"


def materials_of_user(option: str | None) -> Materials:
    """Return the known materials with those of the user's files.

    By rising precedence these are the files of the configuration directory and of the environment, which may add
    materials but change no shipped one, and that of the option, which may.
    """
    if option == "":
        raise BadRequest("--materials is empty")
    configuration = os.path.join(configuration_directory(), "materials.toml")
    files = [configuration] if _exists(configuration) else []
    added = [path for path in (*files, os.environ.get(ENVIRONMENT)) if path and not _is_same(path, option)]
    return Materials(option or (), added=added) if added or option else known_materials()


def _is_same(path: str, other: str | None) -> bool:
    return other is not None and os.path.realpath(path) == os.path.realpath(other)


def _exists(path: str) -> bool:
    """Return whether something is at a path. What cannot be reached counts, to be reported as unreadable."""
    try:
        os.lstat(path)
    except (FileNotFoundError, NotADirectoryError, ValueError):
        return False
    except OSError:
        pass
    return True


def configuration_directory() -> str:
    """Return the user's configuration directory on this system, the same as platformdirs without its import."""
    if sys.platform == "win32":
        parent = os.environ.get("APPDATA") or os.path.expanduser("~")
    elif sys.platform == "darwin":
        parent = os.path.expanduser("~/Library/Application Support")
    else:
        parent = os.environ.get("XDG_CONFIG_HOME") or os.path.expanduser("~/.config")
    return os.path.join(parent, "jkroll")
