"""Materials by name: the shipped materials, and the materials in the user's files.

A file is TOML of limited size, so that it loads fast. A mistake in one material does not affect the others: the error
is raised when that material is used.
"""

import os
from collections.abc import ItemsView, Iterable, Iterator, Mapping, Sequence
from functools import cache
from importlib import import_module
from itertools import chain
from typing import Any, NamedTuple

from ..errors import BadRequest
from ..physics.elementary import cbrt, smaller_and_larger, sqrt
from ..quantities.nomenclature import ALIKE, PROPERTIES, XI, header, named, read_only
from ..quantities.values import Interval, QuantityError, Uncertain, ends_of, is_uncertain, middle, value_of
from ..text import closest, listed, quoted, shown

MAX_BYTES = 64_000  # the shipped file, with 40 materials and all their references, has 55 kB
MAX_NAME = 60

_HERE = os.path.dirname(os.path.abspath(__file__))
# A wheel has the file here; a checkout has it at the top level.
_PLACES = (os.path.join(folder, "materials.toml") for folder in (_HERE, os.path.join(_HERE, *[os.pardir] * 3)))
SHIPPED = next(path for path in _PLACES if os.path.exists(path))

Path = str | os.PathLike[str]


class MaterialsFileError(BadRequest):
    """Error raised for a materials file that cannot be read, or for a mistake in it."""

    def __init__(self, path: object, problem: str) -> None:
        super().__init__(f"materials file {quoted(str(path))}: {problem}", "bad materials file")


class UnknownMaterial(BadRequest):
    """Error raised for a material that no file describes."""


class UnclearMaterial(BadRequest):
    """Error raised for a name that may mean several materials."""

    @property
    def fault(self) -> str:
        """The message, so that a note counts the failed rows of each name: another name needs another remedy."""
        return str(self)


# --- Materials --------------------------------------------------------------------------------------------------------

ORIGIN = ("method", "law", "reference")  # keys for the method, the contact law and the reference of a property


class Displacement(NamedTuple):
    """A measured yield displacement with its range, and the radius of the identical spheres measured, in SI units."""

    measured: Interval
    radius: float

    def scaled(self, radius: Any) -> Interval:
        """Return the displacement of identical spheres of another radius.

        The range covers growth with the contact radius, as R^(2/3), and growth with the sphere radius.
        """
        scale = radius / self.radius
        least, most = smaller_and_larger(scale, cbrt(scale) * cbrt(scale))
        value, low, high = self.measured.value, self.measured.low, self.measured.high
        return Interval.of(value * sqrt(least * most), low=low * least, high=high * most)


class Material(NamedTuple):
    """A material: its properties in SI units, and their sources."""

    name: str
    title: str  # the title of its set: "Table 1 of D&T"
    path: str
    properties: Mapping[str, float] = read_only({})
    aliases: tuple[str, ...] = ()
    notes: Mapping[str, str] = read_only({})  # by property
    references: tuple[Mapping[str, str], ...] = ()
    state: str = ""  # "below 175 K"
    uncertainties: Mapping[str, Uncertain] = read_only({})  # by property
    origins: Mapping[str, Mapping[str, str]] = read_only({})  # by property: the fields of `ORIGIN` that the file states
    displacement: Displacement | None = None  # measured, to be scaled to the spheres of a contact
    note_radii: Mapping[str, Interval] = read_only({})  # by property: the radii to which a note applies, if not to all
    problem: str = ""  # the mistake in its file, which makes the material unusable

    @property
    def key(self) -> tuple[str, str]:
        """The file and the name, which identify a material even if its properties are replaced."""
        return self.path, self.name

    def __hash__(self) -> int:
        return hash(self.key)

    @property
    def words(self) -> dict[str, str]:
        """The name and the aliases as written, by their spellings in lower case."""
        return {word.casefold(): word for word in (*self.aliases, self.name)}

    @property
    def measures(self) -> dict[str, float | Uncertain]:
        """The properties with their uncertainties, and the measured yield displacement."""
        displacement = {} if self.displacement is None else {XI: self.displacement.measured}
        return {**self.properties, **self.uncertainties, **displacement}

    def _repr_html_(self) -> str:
        """Return the HTML for notebooks."""
        return self._repr_mimebundle_()["text/html"]

    def _repr_mimebundle_(self, **_: Any) -> dict[str, str]:
        """Return all forms that notebooks show and convert, with a row for each fact."""
        from ..quantities.shown import bundle
        from .sheet import parts_of_material

        return bundle(parts_of_material(self))

    def sources_of(self, name: str) -> list[Mapping[str, str]]:
        """Return the references of a property: its own, or else those that belong to no single property."""
        keys = {of: origin["reference"] for of, origin in self.origins.items() if "reference" in origin}
        if name in keys:
            return [entry for entry in self.references if entry["key"] == keys[name]]
        return [entry for entry in self.references if entry["key"] not in keys.values()]

    def missing_text(self, name: str) -> str:
        """Return the sentence on a missing property, with the note of the file if there is one."""
        note = self.notes.get(name)
        return f"{self.name}: {note}" if note else f"{self.name} has none in {self.title}"


# --- A file -----------------------------------------------------------------------------------------------------------


def data_of(path: str) -> Mapping[str, Any]:
    """Return the content of a TOML file. Raises BadRequest if it cannot be read, is too large or is not TOML."""
    try:
        with open(path, "rb") as file:
            content = file.read(MAX_BYTES + 1)
    except (OSError, ValueError) as error:  # a path cannot contain NUL
        raise BadRequest(getattr(error, "strerror", "") or "cannot be read") from None
    if len(content) > MAX_BYTES:
        raise BadRequest(f"is larger than {MAX_BYTES // 1000} kB")
    import tomllib

    try:
        return tomllib.loads(content.decode("utf-8-sig"))
    except UnicodeDecodeError:
        raise BadRequest("is not text in UTF-8: save it with this encoding") from None
    except (ValueError, RecursionError) as error:
        raise BadRequest(f"is not TOML: {shown(str(error))}") from None


_FORMS: Mapping[type, str] = {dict: "a table", list: "a list", str: "a text in quotes"}


def in_form(value: object, form: type, where: str) -> Any:
    """Return a value in the required form: table, list or text. `where`: the key. Raises BadRequest for others."""
    if not isinstance(value, form):
        raise BadRequest(f"{shown(where)} is not {_FORMS[form]}")
    return value


def texts(value: object, form: type, where: str) -> Any:
    """Return a text, or the texts of a list or a table, safe to print. Raises BadRequest for other values."""
    content = in_form(value, form, where)
    if form is dict:
        return {key: texts(text, str, f"{where}.{key}") for key, text in content.items()}
    if form is list:
        return tuple([texts(text, str, where) for text in content])
    return shown(content)


_RULE = f"begins with a letter, has no comma and {MAX_NAME} characters at most, and is not all or plane"


def is_material_name(word: str) -> bool:
    """Return whether a word can name a material: it must not look like a radius or a list.

    >>> is_material_name("SiO2"), is_material_name("100nm"), is_material_name("a,b"), is_material_name("all")
    (True, False, False, False)
    """
    is_word = word[:1].isalpha() and word == word.strip() and word.isprintable() and "," not in word
    return is_word and len(word) <= MAX_NAME and word.casefold() not in ("all", "plane")


def materials_in(path: str) -> list[Material]:
    """Return the materials of a file, including those with a mistake. Raises MaterialsFileError for other mistakes."""
    try:
        data = data_of(path)
        _refuse_unknown_keys("", data, ("title", "materials", "references"))
        title = texts(data.get("title", shown(path)), str, "title")
        tables = in_form(data.get("materials", {}), dict, "materials")
        references = in_form(data.get("references", {}), dict, "references")
        materials = [_read(name, table, title, path, references) for name, table in tables.items()]
        _check_names(materials)
    except BadRequest as error:
        raise MaterialsFileError(path, str(error)) from None
    return materials


def _check_names(materials: Sequence[Material]) -> None:
    """Raise BadRequest for a word that cannot name a material, or for a name that another material has, too.

    Several materials may share an alias, but not a name.
    """
    names = {material.name.casefold(): material.name for material in reversed(materials)}
    for material in materials:
        for key, word in material.words.items():
            if not is_material_name(word):
                raise BadRequest(f"{quoted(word, MAX_NAME)} cannot name a material; a name {_RULE}")
            other = names.get(key, material.name)
            if other != material.name:
                both = f"{quoted(other)} and {quoted(material.name)}"
                raise BadRequest(f"{quoted(word)} names both {both}; upper and lower case are the same")


_ABOUT: Mapping[str, type] = {"aliases": list, "references": list, "state": str, "source": str}


def _read(name: str, table: Any, title: str, path: str, references: Mapping[str, Any]) -> Material:
    """Return a material from its table; a mistake there becomes its problem. `title`: the default title of its set."""
    material = Material(name, title, path)
    try:
        in_form(table, dict, f"materials.{name}")
        about = {key: texts(table.get(key, form()), form, f"{name}.{key}") for key, form in _ABOUT.items()}
        material = material._replace(aliases=about["aliases"], title=about["source"] or title, state=about["state"])
        _refuse_unknown_keys(f"{name}.", table, (*PROPERTIES, XI, *_ABOUT, "notes"))
        notes, note_radii = _notes(name, table)
        values, origins = _values(name, table)
        displacement = _displacement(name, table, values.pop(XI, None))
        keys = dict.fromkeys(about["references"])
        keys |= dict.fromkeys([origin["reference"] for origin in origins.values() if "reference" in origin])
        for key in keys:
            if key not in references:
                raise BadRequest(f"{quoted(name)} cites {quoted(key)}, which is not in [references]")
        cited = [{"key": key, **texts(references[key], dict, f"references.{key}")} for key in keys]
        return material._replace(
            properties=read_only({key: middle(value) for key, value in values.items()}),
            notes=read_only(notes),
            note_radii=read_only(note_radii),
            references=tuple(cited),
            uncertainties=read_only({key: value for key, value in values.items() if is_uncertain(value)}),
            origins=read_only(origins),
            displacement=displacement,
        )
    except BadRequest as error:
        return material._replace(problem=str(error))


def _values(name: str, table: Mapping[str, Any]) -> tuple[dict[str, Any], dict[str, dict[str, str]]]:
    """Return the SI values of a material's properties and yield displacement, and their stated origins."""
    values, origins = {}, {}
    for key in (*PROPERTIES, XI):
        if key not in table:
            continue
        where, needed = f"{name}.{key}", ["value", "radius"] if key == XI else ["value"]
        has_fields = isinstance(table[key], dict)
        given = table[key] if has_fields else {"value": table[key]}
        _refuse_unknown_keys(f"{where}.", given, (*needed, *ORIGIN))
        for field in needed:
            if field not in given:
                raise BadRequest(f"{shown(where)} has no {field}")
        values[key] = _value(key, given["value"], name, where)
        if has_fields:
            stated = {field: given[field] for field in ORIGIN if given.get(field, "") != ""}
            origins[key] = texts(stated, dict, where)
    return values, origins


def _displacement(name: str, table: Mapping[str, Any], measured: Any) -> Displacement | None:
    """Return the measured yield displacement of a material with the radius of the spheres; None if there is none."""
    if measured is None:
        return None
    radius = _value("radius", table[XI]["radius"], name, f"{name}.{XI}.radius")
    if not isinstance(radius, float):
        raise BadRequest(f"{shown(name)}.{XI}: the radius of the spheres must be a single value")
    return Displacement(Interval(middle(measured), *ends_of(measured)), radius)


def _notes(name: str, table: Mapping[str, Any]) -> tuple[dict[str, str], dict[str, Interval]]:
    """Return the notes of a material by property, and the radii of those notes that concern only some sizes."""
    every = in_form(table.get("notes", {}), dict, f"{name}.notes")
    _refuse_unknown_keys(f"{name}.notes.", every, (*PROPERTIES, XI))
    notes, radii = {}, {}
    for key, given in every.items():
        where = f"{name}.notes.{key}"
        note = given if isinstance(given, dict) else {"note": given}
        _refuse_unknown_keys(f"{where}.", note, ("note", "radii"))
        if "note" not in note:
            raise BadRequest(f"{shown(where)} has no note")
        notes[key] = texts(note["note"], str, where)
        if "radii" in note:
            of_spheres = _value("radius", note["radii"], name, f"{where}.radii")
            if not isinstance(of_spheres, Interval):
                raise BadRequest(f"{shown(where)}.radii is not a range; write one such as '0.5 to 5 um'")
            radii[key] = of_spheres
    return notes, radii


def _refuse_unknown_keys(where: str, table: Mapping[str, Any], known: Sequence[str]) -> None:
    """Raise BadRequest for an unknown key of a table. `where`: the text before the key, empty for a whole file."""
    unknown = [key for key in table if key not in known]
    if unknown:
        guess = closest(named(unknown[0]), known)
        hint = f"; did you mean {guess}?" if guess else ""
        if not where and not guess and isinstance(table[unknown[0]], dict):
            hint = f"; a material has a table such as [materials.{shown(unknown[0])}]"
        raise BadRequest(f"{quoted(where + unknown[0])} is an unknown key{hint}")


def _value(key: str, value: object, name: str, where: str) -> float | Uncertain:
    """Return the SI value of a property, from a text, or from a number if the property has no unit."""
    is_number = isinstance(value, int | float) and not isinstance(value, bool)
    try:
        return value_of(repr(value) if is_number else texts(value, str, where), key)
    except QuantityError as error:
        raise BadRequest(f"{shown(name)}: {error}") from None
    except ValueError:  # Python does not write an integer of thousands of digits
        raise BadRequest(f"{shown(where)} has too many digits") from None


@cache
def shipped() -> Sequence[Material]:
    """Return the shipped materials. A wheel has them also as a module, which its build generates."""
    if os.path.dirname(SHIPPED) != _HERE:  # a checkout
        return materials_in(SHIPPED)
    from .shipped import MATERIALS  # type: ignore  # mypy does not find it, or finds it without types

    return [*MATERIALS]


# --- Materials by name ------------------------------------------------------------------------------------------------


class Materials:
    """All known materials, by name or alias in any case. The use of a name that several materials share is refused."""

    def __init__(self, paths: Path | Iterable[Path] = (), *, added: Path | Iterable[Path] = ()) -> None:
        """Read the shipped file, then `added`, and then the file or the files of `paths`.

        A material takes over its names from earlier files. But a material of `added` does not take over shipped names:
        such a name then means both materials.
        """
        self.overrides: list[str] = []  # sentences on the names taken over
        self._materials: dict[str, Material] = {}  # by name, case folded
        self._meanings: dict[str, list[Material]] = {}  # by name or alias, case folded
        taking = _decoded(paths)
        for path in dict.fromkeys((SHIPPED, *_decoded(added), *taking)):
            self._add(shipped() if path == SHIPPED else materials_in(path), takes=path in taking)

    def _add(self, materials: Sequence[Material], *, takes: bool) -> None:
        """Add the materials of a file, which take over earlier names. `takes`: True to take over even shipped names."""
        meanings: dict[str, list[Material]] = {}
        unshared: dict[str, Material] = {}  # by name, case folded: the materials that share their names with no other
        for material in materials:
            overrides: dict[str, None] = {}
            for key, word in material.words.items():
                shared = []
                for other in self._meanings.get(key, ()):
                    if takes or other.path != SHIPPED:
                        overrides[f"{shown(material.path)} overrides {shown(word)} of {other.title}"] = None
                    else:
                        shared.append(other)
                meanings.setdefault(key, shared).append(material)
            self.overrides += overrides
            key = material.name.casefold()
            if len(meanings[key]) == 1:
                unshared[key] = material
        for others in self._meanings.values():  # a material that takes over a name takes over the aliases of its owner
            others[:] = [unshared.get(other.name.casefold(), other) for other in others]
        self._materials |= unshared
        self._meanings |= meanings

    def __getitem__(self, word: str) -> Material:
        """Return a material by its name or alias, in any case.

        Raises UnknownMaterial, UnclearMaterial for a name that several materials share or extend (as ice-warm and
        ice-cold extend ice), and MaterialsFileError for a material with a mistake.
        """
        word = str(word)
        key = word.strip().casefold()
        meanings = self._meanings.get(key, [])
        states = [material for name, material in self._materials.items() if name.startswith(f"{key}-")]
        if len(meanings) == 1:
            (material,) = meanings
            if material.problem:
                raise MaterialsFileError(material.path, material.problem)
            return material
        several = meanings or states
        if len(several) > 1:
            raise _unclear(word, several)
        guess = states[0].name if states else closest(key, [*self.materials, *self.aliases], ALIKE)
        if guess:
            names = listed([material.name for material in self._meanings[guess.casefold()]], "or")
            remedy = f"; did you mean {names}? jkroll materials lists all"
        else:
            remedy = (
                ". Give its own numbers, as in jkroll pull-off 100nm --gamma 30mJ/m2 (an example), add it to a file "
                "(jkroll guide materials), or write one that jkroll materials lists"
            )
        raise UnknownMaterial(f"no material {quoted(word)}{remedy}", "unknown material")

    def __iter__(self) -> Iterator[str]:
        return iter(self.materials)

    def __len__(self) -> int:
        return len(self.materials)

    def __contains__(self, word: object) -> bool:
        return str(word).strip().casefold() in self._meanings

    def items(self) -> ItemsView[str, Material]:
        """Return the names and the materials, without those with a mistake."""
        return self.materials.items()

    def to_dict(self) -> dict[str, dict[str, float]]:
        """Return the properties of each material in SI units, by name."""
        return {name: {**material.properties} for name, material in self.items()}

    def to_pandas(self) -> Any:
        """Return a DataFrame with a row for each material: its properties in SI units, its state and its source."""
        rows = []
        for each in self.materials.values():
            properties = {header(name): each.properties.get(name) for name in PROPERTIES}
            rows.append({**properties, "state": each.state, "source": each.title})
        return import_module("pandas").DataFrame(rows, index=[*self])

    def _repr_html_(self) -> str:
        """Return the HTML for notebooks."""
        return self._repr_mimebundle_()["text/html"]

    def _repr_mimebundle_(self, **_: Any) -> dict[str, str]:
        """Return all forms that notebooks show and convert, with a row for each material."""
        from ..quantities.shown import bundle
        from .sheet import parts_of_materials

        return bundle(parts_of_materials([*self.materials.values()]))

    @property
    def materials(self) -> Mapping[str, Material]:
        """All materials by name, without those with a mistake."""
        return {material.name: material for material in self._materials.values() if not material.problem}

    @property
    def mistakes(self) -> list[MaterialsFileError]:
        """The errors of materials with a mistake."""
        return [MaterialsFileError(each.path, each.problem) for each in self._materials.values() if each.problem]

    @property
    def aliases(self) -> list[str]:
        """The aliases of all materials."""
        return [*dict.fromkeys(chain.from_iterable(material.aliases for material in self._materials.values()))]


def _decoded(paths: Path | Iterable[Path]) -> list[str]:
    """Return one path or several as texts. Raises MaterialsFileError for other objects."""
    is_path = isinstance(paths, str | bytes) or not isinstance(paths, Iterable)
    try:
        return [*map(os.fsdecode, [paths] if is_path else paths)]  # type: ignore[arg-type]
    except TypeError:
        raise MaterialsFileError(paths, 'is not a path; write Materials("mine.toml")') from None


def _unclear(word: str, materials: Sequence[Material]) -> UnclearMaterial:
    """Return the error for a name that materials share, with the surface energy and the state or set of each."""
    first, last, name = materials[0], materials[-1], quoted(word)
    is_shipped_and_added = first.path == SHIPPED and last.path != SHIPPED
    if is_shipped_and_added and word.strip().casefold() in last.words:
        title, file = first.title, shown(last.path)
        meanings = f"shipped ({title}) and also in {file}; rename it, or pass --materials {file}"
        return UnclearMaterial(f"material {name} is {meanings}", "unclear material")
    has_sets = len({material.title for material in materials}) > 1
    choices = [_choice(material, has_sets=has_sets) for material in materials]
    return UnclearMaterial(f"{name} names several materials; write {listed(choices, 'or')}", "unclear material")


def _choice(material: Material, *, has_sets: bool) -> str:
    """Return the name of a material with its surface energy and its state, or else with its note or its set."""
    from ..quantities.formatting import amount

    about = []
    if "surface_energy" in material.properties:
        about.append(amount("surface_energy", material.measures["surface_energy"]))
    if material.state:
        about.append(material.state)
    elif "surface_energy" in material.notes:
        about.append(material.notes["surface_energy"].partition(";")[0])
    elif has_sets:
        about.append(material.title)
    text = ", ".join(filter(None, about))
    return f"{material.name} ({text})" if text else material.name


@cache
def known_materials() -> Materials:
    """Return the shipped materials, which are read only once."""
    return Materials()


# --- The user's files -------------------------------------------------------------------------------------------------


def materials_of_user(option: str | None) -> Materials:
    """Return the known materials, including those of the user's files.

    Each of these files overrides the earlier ones: the file in the configuration directory, the file that the
    environment names, and the file of the option. Only the file of the option may replace shipped materials.
    """
    configuration = os.environ.get("XDG_CONFIG_HOME") or os.path.expanduser("~/.config")
    path = os.path.join(configuration, "jkroll", "materials.toml")
    added = [path] if os.path.lexists(path) else []
    added += filter(None, [os.environ.get("JKROLL_MATERIALS")])
    return Materials([] if option is None else option, added=added)
