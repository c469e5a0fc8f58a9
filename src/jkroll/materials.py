"""Materials: the shipped file and the user's own, read, checked and laid over each other."""

import os
from collections.abc import Iterable, Mapping
from functools import cache
from stat import S_ISREG
from types import MappingProxyType
from typing import Any, NamedTuple

from .errors import MaterialsFileError, QuantityError, UnknownMaterial, quoted, shown
from .nomenclature import NOMENCLATURE
from .units import parse_quantity
from .wiring import PROPERTIES

Path = str | os.PathLike[str]
MAX_BYTES = 100_000  # some 200 materials with all their references
MAX_ODD_BYTES = 30_000  # of a file that is more than a key and a value in a line: tomllib takes 0.3 s a megabyte
MAX_SIGNS = 10_000  # of those that make tables, arrays and dotted keys: a hundred can take 0.1 MB of memory
MAX_NAME = 60
MAX_LINE = 2000
MAX_DOTS = 100  # in a line: a dotted key takes time and memory as the square of its parts

_HERE = os.path.dirname(__file__)
# The wheel carries the file beside this module; a checkout has it at the top level.
_PLACES = (os.path.join(folder, "materials.toml") for folder in (_HERE, os.path.dirname(os.path.dirname(_HERE))))
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


class Materials:
    """All materials that are known, by name or alias in any case."""

    def __init__(self, paths: Iterable[Path] = ()) -> None:
        """Read the shipped file, then each of `paths`, whose materials shadow those before them."""
        self.materials: dict[str, Material] = {}
        self._by_word: dict[str, str] = {}
        for path in dict.fromkeys((SHIPPED, *paths)):
            for material in read(path):
                self._add(material)

    def _add(self, material: Material) -> None:
        """Add a material; one that takes a word from a material of another file says so."""
        for word in dict.fromkeys(word.casefold() for word in (material.name, *material.aliases)):
            before = self.materials.get(self._by_word.get(word, ""))
            if before is not None and before.path != material.path:
                note = f"{shown(material.path)} shadows {shown(word)} of {shown(before.title)}"
                material = material._replace(shadows=(*material.shadows, note))
                if before.name.casefold() == material.name.casefold():
                    del self.materials[before.name]
            self._by_word[word] = material.name
        self.materials[material.name] = material

    def __getitem__(self, name: str) -> Material:
        """The material of a name or alias, in any case; UnknownMaterial with a suggestion if there is none."""
        found = self._by_word.get(name.strip().casefold())
        if found is None:
            from .suggestions import closest

            guess = closest(name.strip().casefold(), self._by_word)
            raise UnknownMaterial(name, sorted(self.materials), guess and self._by_word[guess])
        return self.materials[found]


def known_materials(*paths: Path) -> Materials:
    """The materials of the shipped file, which is read once, and of `paths`, which may have changed."""
    return Materials(paths) if paths else _shipped()


@cache
def _shipped() -> Materials:
    return Materials()


def read(path: Path) -> list[Material]:
    """Read and check one materials file; MaterialsFileError says what is wrong with it."""
    name = os.fspath(path)
    try:
        return _checked(_shipped_data() if name == SHIPPED else _data(name), name)
    except _Malformed as error:
        raise MaterialsFileError(name, str(error)) from None


def _shipped_data() -> Mapping[str, Any]:
    """What the shipped file says: the wheel holds it as a module too, made when it was built; a checkout does not."""
    try:
        from .shipped import DATA  # type: ignore  # mypy does not see it, or sees it without types
    except ImportError:
        return _data(SHIPPED)
    return dict(DATA)


def _data(path: str) -> Mapping[str, Any]:
    """What a TOML file says."""
    text = _text(path)
    from .plain_toml import NotPlain, read_plainly

    try:
        return read_plainly(text)
    except NotPlain as error:
        if len(text) > MAX_ODD_BYTES:
            lines = f"whose line {error.line} is not a key and a value of its own"
            raise MaterialsFileError(path, f"is larger than {MAX_ODD_BYTES // 1000} kB, {lines}") from None
    if any(len(line) > MAX_LINE or line.count(".") > MAX_DOTS for line in text.split("\n")):
        raise MaterialsFileError(path, f"has a line of more than {MAX_LINE} characters or {MAX_DOTS} dots")
    import tomllib

    try:
        return tomllib.loads(text)
    except (ValueError, RecursionError) as error:
        reason = "nested too deeply" if isinstance(error, RecursionError) else shown(str(error))
        raise MaterialsFileError(path, f"is not TOML: {reason}") from None


class _Malformed(Exception):
    """Something in a materials file that is no material."""


def _text(path: str) -> str:
    """The text of a regular file of at most MAX_BYTES."""
    try:
        if not S_ISREG(os.stat(path).st_mode):
            raise MaterialsFileError(path, "is not a regular file")
        with open(path, "rb") as file:
            content = file.read(MAX_BYTES + 1)
    except (OSError, ValueError) as error:
        raise MaterialsFileError(path, getattr(error, "strerror", None) or "is not a path") from None
    if len(content) > MAX_BYTES:
        raise MaterialsFileError(path, f"is larger than {MAX_BYTES // 1000} kB")
    if sum(map(content.count, (b"[", b"{", b"."))) > MAX_SIGNS:
        raise MaterialsFileError(path, f"has more than {MAX_SIGNS} brackets, braces and dots")
    try:
        return content.decode("utf-8-sig")
    except UnicodeDecodeError:
        raise MaterialsFileError(path, "is not UTF-8") from None


def _checked(data: Mapping[str, Any], path: str) -> list[Material]:
    unknown = set(data) - {"title", "materials", "references"}
    if unknown:
        raise _Malformed(f"has an unknown key {quoted(min(unknown))}; expected [materials.NAME] tables")
    title = _string(data.get("title", shown(path)), "title")
    bibliography = {
        key: {"key": key, **_texts(entry, f"references.{key}")}
        for key, entry in _table(data.get("references", {}), "references").items()
    }
    entries = _table(data.get("materials", {}), "materials")
    seen: dict[str, str] = {}
    for name, entry in entries.items():
        aliases = entry.get("aliases", []) if isinstance(entry, dict) else []
        for word in (name, *(aliases if isinstance(aliases, list) else [])):
            other = seen.setdefault(str(word).casefold(), name)
            if other != name:
                raise _Malformed(
                    f"{quoted(str(word))} names both {quoted(other)} and {quoted(name)}; case makes no difference"
                )
    return [
        _material(name, _table(entry, f"materials.{name}"), bibliography, title, path)
        for name, entry in entries.items()
    ]


_KEYS = {*PROPERTIES, "aliases", "notes", "references"}


def _material(
    name: str, entry: Mapping[str, Any], bibliography: Mapping[str, Mapping[str, str]], title: str, path: str
) -> Material:
    for key in entry:
        if key not in _KEYS:
            from .suggestions import closest

            guess = closest(key, _KEYS)
            raise _Malformed(
                f"{quoted(name)} has an unknown key {quoted(key)}" + (f"; did you mean {guess}?" if guess else "")
            )
    properties = {key: _property(key, entry[key], name) for key in PROPERTIES if key in entry}
    notes = _texts(entry.get("notes", {}), f"{name}.notes")
    if set(notes) - properties.keys():
        raise _Malformed(
            f"{quoted(name)} has a note on {quoted(min(set(notes) - properties.keys()))}, which it does not give"
        )
    aliases, references = (
        tuple(_string(item, f"{name}.{key}") for item in _list(entry.get(key, []), f"{name}.{key}"))
        for key in ("aliases", "references")
    )
    for word in (name, *aliases):
        if not is_material_name(word):
            raise _Malformed(f"{quoted(word)} is no name for a material; one begins with a letter and has no comma")
    missing = [key for key in references if key not in bibliography]
    if missing:
        raise _Malformed(f"{quoted(name)} cites {quoted(missing[0])}, which [references] does not have")
    cited = tuple(bibliography[key] for key in references)
    return Material(name, MappingProxyType(properties), aliases, MappingProxyType(notes), (), cited, title, path)


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
