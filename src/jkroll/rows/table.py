"""The rows of a table: what its header, its first rows and the options ask for, and blocks of its cells as rows.

No file is opened here: `batch` reads and writes.
"""

from collections.abc import Callable, Collection, Mapping, Sequence
from contextlib import suppress
from types import MappingProxyType
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy

from ..errors import BadRequest, BadTable, JkrollError
from ..materials.library import Material, Materials, MaterialsFileError, UnclearMaterial, UnknownMaterial
from ..quantities.laws import DEFAULT_LAW, law_named
from ..quantities.nomenclature import INFINITY, NOMENCLATURE, PROPERTIES, XI, header
from ..quantities.values import Uncertain, is_uncertain, value_of
from ..scene.failures import MissingInput, NotInLaw
from ..scene.limits import LIMITS
from ..scene.scene import DEFAULTS, EXCLUSIVE, Scene
from ..scene.wiring import depends_on
from ..text import quoted
from .cells import LABEL, Column, Indices, Lookup, Numbers, Reader
from .columns import DOUBT, SIDES, STATUS, OddRow, Wanted, remarks_of
from .header import Header, check_inputs
from .rows import BAD, Block, groups
from .words import MATERIALS

if TYPE_CHECKING:
    from ..scene.uncertainty import Source, Sources

_RENAMED = {STATUS: "", "model": "", DOUBT: ", or write --no-doubt"}  # besides another name
_NO_ROWS: Any = numpy.empty(0)  # the values of an input where there is no row yet
Asked = tuple[Sequence[str], Sequence[str]]  # quantities by name, and those that may lack inputs


class Fill(NamedTuple):
    """The inputs, materials and law that the command line gives to all rows. What a row gives itself comes first."""

    fixed: Mapping[str, float | Uncertain]
    spheres: tuple[Material | None, Material | None]
    model: str | None
    known: Materials
    unknown: str = ""  # the input that `--infer` seeks
    measured: str = ""  # the quantity from which it follows, whose measured value each row has by `--measured`

    @classmethod
    def of(cls, inputs: Mapping[str, str], known: Materials, unknown: str = "", measured: str = "") -> "Fill":
        """Return what texts give by the names of inputs."""
        material, material2 = (known[inputs[name]] if name in inputs else None for name in MATERIALS)
        fixed = {name: value_of(text, name) for name, text in inputs.items() if name not in (*MATERIALS, "model")}
        model = law_named(inputs["model"]).name if "model" in inputs else None
        return cls(fixed, (material, material2), model, known, unknown, measured)

    def scene(self, given: Mapping[str, Any], *spheres: Material | None) -> Any:
        """Return the scene of inputs and of the materials of both spheres, or the problem of a measured one.

        Raises an error of the scene.
        """
        given = {**self.fixed, **given}
        if not self.unknown:
            return Scene(given, *spheres, model=self.model)
        if self.measured not in given:
            raise OddRow(f"{self.measured}: the row has no measured value", "no measured value")
        from ..scene.inverse import Problem  # for which a table without an unknown does not pay

        return Problem.of([self.unknown], [self.measured], given, *spheres, model=self.model)


class Table:
    """The input columns of a table, and the columns that are added to it."""

    assumed: Sequence[str] = ()  # inputs that nothing gives
    left_out: "Sequence[Source]" = ()  # sources of uncertainty in the first rows that enter no error bar

    def __init__(self, columns: Header, fill: Fill, wanted: Wanted, labels: Mapping[str, str]) -> None:
        """`labels`: names in the first rows that are, or may be, no material's, with their messages."""
        self.inputs, self.fill, self.wanted, self.labels = columns.inputs, fill, wanted, labels
        self.meanings, self.reading, self.texts = columns.meanings, columns.reading(), columns.texts
        self.places = columns.places
        self.said = {"model": fill.model} if fill.model is not None else {}  # columns of text, the same in all rows
        self.readers = [Reader(column) for column in self.inputs]
        self.lookups = {
            name: Lookup(fill.known, material) for name, material in zip(MATERIALS, fill.spheres, strict=True)
        }

    @property
    def added(self) -> list[str]:
        """The headers of all columns that are added."""
        return [*self.said, *self.wanted.heads(header), *remarks_of(self.wanted)]


class Records(NamedTuple):
    """A block of a table, taken apart."""

    before: Any  # what stands before the results of each row; blank lines above a row belong to it
    cells: Mapping[str, Sequence[bytes]]  # by the name of the column
    odd: Mapping[int, str] = MappingProxyType({})  # records that are no rows, and why
    starts: Sequence[int] = ()  # the line in the block at which each begins
    size: int = 0  # lines in the block
    rest: bytes = b""  # blank lines behind the last row
    numbers: Mapping[str, Numbers] = MappingProxyType({})  # columns that are numbers already


class TableBlock(Block):
    """Some rows of a table. Those whose materials have the same properties are alike."""

    def __init__(self, table: Table, records: Records) -> None:
        """`records`: the cells of the columns that the table reads."""
        self.table, self.cells, self.odd = table, records.cells, records.odd
        unread = [reader for reader in table.readers if reader.column.name not in records.numbers]
        numbers = {**records.numbers, **{reader.column.name: reader.numbers(self.cells) for reader in unread}}
        self.indices = {name: table.lookups[name].indices(self.cells[name]) for name in MATERIALS if name in self.cells}
        are_rows = numpy.zeros(len(records.before), dtype=numpy.int64)
        are_rows[[*self.odd]] = BAD
        kinds = [table.lookups[name].kinds(indices) for name, indices in self.indices.items()]
        super().__init__(len(are_rows), numbers, [are_rows, *kinds])

    def scene(self, given: Mapping[str, Any], rows: Indices) -> Any:
        """Return the scene of the inputs of rows that are alike."""
        spheres = dict(zip(MATERIALS, self.table.fill.spheres, strict=True))
        spheres |= {name: self.table.lookups[name].together(indices[rows]) for name, indices in self.indices.items()}
        scene = self.table.fill.scene(given, *spheres.values())
        if LABEL in spheres.values() and scene.missing(self.table.wanted.names):
            raise OddRow("names are no materials")  # each row by itself says which
        return scene

    def scene_of(self, row: int) -> Any:
        """Return the scene of a row by itself. Raises OddRow, or an error of the scene."""
        if row in self.odd:
            raise OddRow(self.odd[row])
        table, cells = self.table, {name: cells[row].decode(errors="replace") for name, cells in self.cells.items()}
        if all(cells[name].strip() == table.texts[place].strip() for name, place in table.places.items()):
            raise OddRow("the row repeats the header")
        texts: list[tuple[str, str, Callable[[str], Any]]] = [
            (column.name, column.joined(*(cells[name] for name in column.places)), column.read)
            for column in table.inputs
        ]
        texts += [(name, cells[name], table.lookups[name].material) for name in MATERIALS if name in cells]
        given: dict[str, Any] = dict(zip(MATERIALS, table.fill.spheres, strict=True))
        problems: list[JkrollError] = []
        labels: list[JkrollError] = []
        for name, text, read in texts:
            try:
                if text.strip():
                    given[name] = read(text)
            except (UnknownMaterial, UnclearMaterial, MaterialsFileError) as error:
                given[name] = LABEL
                labels.append(error)
            except JkrollError as error:
                problems.append(error)
        spheres = [given.pop(name) for name in MATERIALS]
        if not problems:
            scene = table.fill.scene(given, *spheres)
            if not labels or not scene.missing(table.wanted.names):
                return scene
        errors = [*labels, *problems]
        phrases = dict.fromkeys(error.phrase or str(error) for error in errors)
        raise OddRow("; ".join(map(str, errors)), "; ".join(phrases))


def table_of(
    columns: Header,
    rows: Sequence[Sequence[str]],
    fill: Fill,
    asked: Asked,
    *,
    doubt: bool,
    uncertainty: bool,
    alternatives: bool,
) -> Table:
    """Return the table that a header, the cells of its first rows and the options ask for.

    The first rows decide on the columns of uncertainties, unless `uncertainty` asks for all of them. Raises BadTable,
    or an error of the options.
    """
    check_inputs(columns, fill.measured)
    labels, aliases = _names_of_materials(columns, rows, fill.known)
    scenes, labels_left_out = _kinds(columns, rows, fill, labels)
    wanted = wanted_of(scenes, columns, fill, asked, doubts=doubt, labels=labels_left_out)
    if alternatives:
        wanted = wanted.with_alternatives(scenes, wanted.names)
    table = Table(columns, fill, wanted, labels and {**labels, **aliases})
    cells = {name: [row[place].encode() for row in rows] for name, place in table.places.items()}
    first = TableBlock(table, Records(rows, cells))
    sources = _sources_of(wanted, first)
    sides = {*SIDES} if uncertainty else {side for each in sources for side in each.sides}
    sides |= {side for value in fill.fixed.values() if is_uncertain(value) for side in value.sides}
    if sides:
        table.wanted = wanted.with_columns(sides=dict.fromkeys(wanted.keys, sides))
        table.left_out = [source for each in sources for source in each.left_out]
    solids = [solid for lookup in table.lookups.values() for solid in lookup.known if solid is not None]
    given = {*columns.names, *fill.fixed}
    given |= {XI} if any(solid.displacement is not None for solid in solids) else set()
    used = {
        name
        for scene in scenes
        for name in (scene.used() if fill.unknown else scene.inputs_of(*scene.possible(wanted.names)))
    }
    table.assumed = [name for name in DEFAULTS if name in used - given]
    taken = {*table.added}
    for text in columns.texts:
        if text.strip() in taken:
            remedy = _RENAMED.get(text.strip(), ", or leave it out of the results with --quantities")
            raise BadTable(f"header: the table already has a column {quoted(text)}; rename it{remedy}")
    return table


def _names_of_materials(
    columns: Header, rows: Sequence[Sequence[str]], known: Materials
) -> tuple[dict[str, str], dict[str, str]]:
    """Return the names in some rows that are no material's, and those that are another name of one.

    A name has a message where it stands for several materials, or for one with another name: it may be a label.
    """
    places = [column.place for column in columns.materials]
    cells = ((row[place].strip(), columns.texts[place].strip()) for place in places for row in rows)
    labels: dict[str, str] = {}
    aliases: dict[str, str] = {}
    for text in dict.fromkeys(text for text, head in cells if text not in ("", head)):
        try:
            name = known[text].name
        except UnclearMaterial as error:
            labels[text] = str(error)
        except UnknownMaterial:
            labels[text] = ""
        except JkrollError:
            continue
        else:
            if name.casefold() != text.casefold():
                aliases[text] = f"material {quoted(text)} is {name}"
    return labels, aliases


def wanted_of(
    scenes: Sequence[Any], columns: Header, fill: Fill, asked: Asked, *, doubts: bool, labels: Mapping[str, str]
) -> Wanted:
    """Return the quantities that columns and options allow, without uncertainties: those that some scene has.

    `labels`: names that are no material's, if the scenes leave out what they would give.
    """
    if fill.unknown:
        from .infer import Unknowns

        scenes[0].check()
        return Unknowns([fill.unknown], named=[fill.unknown], sides={}, doubts=doubts)
    explicit, offered = asked
    for name in explicit:
        if name in columns.names or name in fill.fixed:
            raise BadRequest(f"--quantities: {name} is an input here")
        lacks = [*filter(None, (_lack_of(name, scene) for scene in scenes))]
        if len(lacks) == len(scenes):
            texts = [message or f"no material {quoted(text)}" for text, message in labels.items()]
            if texts:
                raise BadTable("; ".join([texts[0], str(lacks[0])]))
            raise lacks[0]
    names_of_2 = {name for name in (*columns.names, *fill.fixed) if NOMENCLATURE[name].sphere == 2}
    is_of_two = bool(names_of_2) or fill.spheres[1] not in (None, fill.spheres[0])
    shown = {name for scene in scenes for name in scene.possible(offered) if scene.shows_to_identical(name)}
    shown -= {*columns.names, *(name for name in shown if is_of_two and NOMENCLATURE[name].of_identical)}
    possible = [name for name in offered if name in shown]
    names = tuple(dict.fromkeys((*explicit, *possible)))
    if not names:
        scenes[0].plan(offered[0])
        raise BadRequest("--quantities: these are known of identical spheres only, and the table describes sphere 2")
    # Where some cells are the reason why a quantity has a column, all rows have it.
    of_cells = [name for name in possible if NOMENCLATURE[name].shown_with and not NOMENCLATURE[name].of_identical]
    return Wanted(names, named=[*explicit, *of_cells], sides={}, doubts=doubts)


def _lack_of(name: str, scene: Any) -> MissingInput | None:
    """Return which inputs a scene lacks of a quantity that its law has, if it lacks some."""
    try:
        scene.plan(name)
    except MissingInput as error:
        return None if isinstance(error, NotInLaw) else error
    return None


def _kinds(
    columns: Header, rows: Sequence[Sequence[str]], fill: Fill, unknown: Mapping[str, str]
) -> tuple[list[Any], Mapping[str, str]]:
    """Return scenes of no rows that together have all inputs of the columns and options, and the labels that they lack.

    Of columns that exclude each other, a scene has one. What an input is matters, and not its values, but for one that
    is infinite in all of the first rows: from it follows more.

    `unknown`: names that are no material's. A column of such names has labels, unless they were meant as materials:
    without them, there is no work of adhesion, or it is not known whether there is.
    """
    of_names = {column.name: {row[column.place].strip() for row in rows} - {""} for column in columns.materials}
    labels = [name for name, texts in of_names.items() if texts and texts <= unknown.keys()]
    infinite = {column.name for column in columns.inputs if _is_infinite(column, rows)}
    spheres = dict(zip(MATERIALS, fill.spheres, strict=True))
    if columns.materials:  # each row says whether both spheres are of the solid that has a displacement
        spheres = {name: solid and solid._replace(displacement=None) for name, solid in spheres.items()}
    some = LABEL._replace(properties=dict.fromkeys(PROPERTIES, _NO_ROWS))
    names = [column.name for column in columns.inputs]
    cases = dict.fromkeys(_without_exclusive(first, names, fill.measured) for first in names or [""])

    def kinds(labels: Collection[str]) -> list[Any]:
        of_columns = {name: LABEL if name in labels else some for name in of_names}
        inputs = ({name: INFINITY if name in infinite else _NO_ROWS for name in case} for case in cases)
        return [fill.scene(given, *{**spheres, **of_columns}.values()) for given in inputs]

    scenes = kinds(labels)
    if labels and (fill.unknown or scenes[0].missing(["work_of_adhesion"])):
        return kinds([]), {}  # their rows will say that they are unknown
    return scenes, unknown if labels else {}


def idle_of(table: Table) -> list[str]:
    """Return the inputs of options on which no result of a table and no limit can depend.

    One that is infinite is left out: it may make a body rigid.
    """
    fill, wanted = table.fill, table.wanted
    quantities = [fill.measured] if fill.unknown else wanted.names
    law = [fill.model or DEFAULT_LAW]
    entering = depends_on(quantities, law)
    if wanted.doubts:
        entering |= depends_on([limit.name for limit in LIMITS if limit.touches & entering], law)
    return [name for name, value in fill.fixed.items() if name not in entering and value != INFINITY]


def _is_infinite(column: Column, rows: Sequence[Sequence[str]]) -> bool:
    """Return whether an input is infinite in each of some rows, so that more follows than from a number."""
    texts = {column.joined(*(row[place] for place in column.places.values())) for row in rows} - {""}
    with suppress(JkrollError):  # a bad cell, which its row will explain
        return bool(texts) and all(column.read(text) == INFINITY for text in texts)
    return False


def _without_exclusive(first: str, names: Sequence[str], measured: str) -> tuple[str, ...]:
    """Return names, the first one among them, without those that it or an earlier one excludes."""
    chosen: set[str] = set()
    for name in (first, *names):
        others = chosen - {measured, name}
        if name == measured or not any(name in group and not others.isdisjoint(group) for group in EXCLUSIVE):
            chosen.add(name)
    return tuple(name for name in names if name in chosen)


def _sources_of(wanted: Wanted, block: TableBlock) -> "list[Sources]":
    """Return the sources of uncertainty of results of some rows."""
    every = []
    for places, given in groups(block):
        with suppress(JkrollError):  # bad rows, which their status will explain
            every.append(wanted.sources_in(block.scene(given, places)))
    return [sources for sources in every if sources is not None]
