"""The columns of a table to read and to add, from its header, first rows and options, and its blocks of rows.

This module opens no file: `opened` reads, and `run` writes.
"""

from collections.abc import Collection, Mapping, Sequence
from contextlib import suppress
from itertools import chain
from types import MappingProxyType
from typing import Any, NamedTuple

import numpy

from ..errors import BadRequest, BadTable, JkrollError, repeated_input
from ..materials.library import Material, Materials
from ..model.frame import EXCLUSIVE, Frame
from ..model.reasons import MissingInput, NotInLaw
from ..model.rows import BAD, SIDES, Numbers, Wanted, groups
from ..model.uncertainty import Sources, sources_of_results
from ..quantities.laws import LAWS, law_given
from ..quantities.nomenclature import NOMENCLATURE, PROPERTIES, XI, computed_as, header
from ..quantities.values import is_uncertain, value_of
from ..text import listed, quoted
from .cells import LABEL, Indices, Lookup
from .header import Header, check_inputs, is_input, is_law, option_of, stated_meanings, typed, understood
from .statistic_rows import LABEL_OF, are_kinds_of_data, rows_of_statistics
from .unread import Supply, offered
from .words import MATERIALS

_ALTERNATIVES = {"radius": ["radius", "diameter"], "surface_energy": ["surface_energy", "work_of_adhesion"]}
_MOST_OFFERED = 4  # maximum number of options in a clause on an input that the table lacks
_NO_ROWS: Any = numpy.empty(0)  # the values of an input before any row is read


class Asked(NamedTuple):
    """The request for a table: the inputs that options give to all rows, and the quantities to add."""

    inputs: Mapping[str, Any]  # texts by name; in Python, values in SI units and materials
    known: Materials
    explicit: Sequence[str] = ()  # the quantities requested by name
    offered: Sequence[str] = ()  # the quantities to add if the inputs suffice
    columns: Sequence[str] = ()  # the values of `--column`
    pass_rest: bool = False  # pass the columns that may be inputs but are not read
    infer: str = ""  # the unknown input
    measured: str = ""  # the quantity with measured values in a column; for a curve, several separated by commas
    doubt: bool = True  # add a column of doubts
    best: bool = False  # add columns of best ranges
    uncertainty: bool = False  # add columns of uncertainties even if the first rows have none

    @property
    def stated(self) -> Mapping[str, str]:
        """The meanings that `--column` gives headers."""
        return stated_meanings(self.columns, self.measured)

    def supply(self, columns: Collection[str]) -> Supply:
        """Return the inputs supplied without a column. `columns`: the inputs with a column."""
        names = [self.measured] if self.infer else [*self.explicit, *self.offered]
        return Supply.of(names, {*columns, self.infer}, self.inputs, self.known)

    def is_read(self, text: str) -> bool:
        """Return whether a header may be that of an input, of the measured quantity, or of a column of laws."""
        return is_law(text) or is_input(self.stated.get(typed(text), text), self.measured)


def header_of(source: Any, asked: Asked) -> Header:
    """Return the meaning of the columns of a table to convert. Raises BadTable, also for a table without an input."""
    header = understood(
        source.names,
        source.sample,
        source.stated,
        asked.inputs,
        asked.measured,
        asked.supply,
        pass_rest=asked.pass_rest,
    )
    check_inputs(header, asked.measured)
    return header


_OF_LAW = ("model", "profile")  # inputs whose values are words


class Table:
    """The columns of a table to read, the inputs that options give to all rows, and the columns to add.

    An input in a row takes precedence over an option.
    """

    def __init__(self, columns: Header, rows: Sequence[Sequence[str]], asked: Asked) -> None:
        """`rows`: the first rows. Raises BadTable, or an error of the options."""
        self.columns, self.asked = columns, asked
        self.labels = _labels(columns, rows, asked)
        self.positions = {**columns.positions, **self.labels}
        inputs, known = asked.inputs, asked.known
        self.spheres: dict[str, Material | None] = {}
        for name in MATERIALS:
            self.spheres[name] = _material(inputs[name], known) if name in inputs else None
        self.fixed: dict[str, Any] = {}  # the numbers that options give
        for name, value in inputs.items():
            if name not in (*MATERIALS, *_OF_LAW):
                self.fixed[name] = value_of(value, name) if isinstance(value, str) else value
        self.model = law_given(*map(inputs.get, _OF_LAW))
        self.law_words = LAWS[self.model].words if self.model is not None else {}  # text columns, the same in all rows
        self.lookups = {name: Lookup(known, solid) for name, solid in self.spheres.items()}
        self.given = columns.names | self.fixed.keys()
        cells = {}
        for name, position in self.positions.items():
            cells[name] = [row[position].encode() for row in rows]
        sample = TableBlock(self, Records(rows, cells))  # the lookups then know the materials of these rows
        # The messages on names in these rows that several materials share.
        self.unclear = frozenset(chain.from_iterable(lookup.unclear for lookup in self.lookups.values()))
        frames = self._frames(cells)
        self.rows = rows
        try:
            self.names, named = self._names(frames)
        except MissingInput as error:
            raise self._with_columns(error) from None
        self.sources = self._sources(sample)
        wanted = Wanted(self.names, named=named, sides=self._sides(), doubts=asked.doubt)
        self.wanted = wanted.with_best(self.names) if asked.best else wanted
        solids = chain.from_iterable(lookup.known for lookup in self.lookups.values())
        if any(solid and solid.displacement for solid in solids):
            self.given |= {XI}  # a material states the yield displacement
        # The empty frames, each with the quantities whose limits apply to the results.
        self.groups = [(frame.filled, frame.judged(self.names)) for frame in frames]
        for text in columns.texts:
            if text.strip() in self.added:
                raise BadTable(f"header: the table already has a column {quoted(text)}; rename it")

    def _sides(self) -> set[str]:
        """Return the sides of uncertainties for which results need columns."""
        if self.asked.uncertainty:
            return {*SIDES}
        sides: set[str] = set()
        for sources in self.sources:
            sides.update(sources.sides)
        for value in self.fixed.values():
            if is_uncertain(value):
                sides.update(value.sides)
        return sides

    def columns_for(self, name: str) -> str:
        """Return the clause on unread columns that may be an input that the table lacks; "" if there is none."""
        options: list[str] = []
        read = {*self.columns.positions.values()}
        for position, text in enumerate(self.columns.texts):
            if position not in read and text.strip() and typed(text) not in self.asked.stated:
                meanings = offered(text, [row[position] for row in self.rows], _ALTERNATIVES.get(name, [name]))
                options += [option_of(text, meaning) for meaning in meanings]
        if not options:
            return ""
        return f"a column that is not read may be one: write {listed(options[:_MOST_OFFERED], 'or')}"

    def _with_columns(self, error: MissingInput) -> JkrollError:
        """Return the error for a missing input, with the unread columns that may be this input."""
        clauses = [*filter(None, map(self.columns_for, error.missing))]
        return BadTable(f"{error}; {'; '.join(clauses)}") if clauses else error

    @property
    def added(self) -> list[str]:
        """The headers of all added columns."""
        return [*self.law_words, *self.wanted.heads(header), *self.wanted.last_keys()]

    def frame(self, given: Mapping[str, Any], solids: Mapping[str, Material | None]) -> Frame:
        """Return the frame of some inputs and of the materials in cells, completed by the options.

        For the inverse problem, it is an Inverse frame. Raises the errors of a frame.
        """
        of_row, spheres = {*map(computed_as, given)}, {**self.spheres, **solids}.values()
        fixed = {name: value for name, value in self.fixed.items() if computed_as(name) not in of_row}
        given = {**fixed, **given}
        measured = self.asked.measured
        if not measured:
            return Frame(given, *spheres, model=self.model)
        if measured not in given:
            raise BadRequest(f"{measured}: the row has no measured value", "no measured value")
        from ..model.inverse import Inverse  # only a table with an unknown input needs this module

        value = given.pop(measured)
        return Inverse([self.asked.infer], {measured: value}, Frame(given, *spheres, model=self.model))

    # --- Added columns ------------------------------------------------------------------------------------------------

    def _frames(self, cells: Mapping[str, Sequence[bytes]]) -> list[Frame]:
        """Return empty frames that together have all inputs.

        Each frame has only one of several inputs that exclude each other. Only the names of inputs matter here, not
        their values. If no name in a column of materials is known, the names are labels, unless the table then has no
        work of adhesion or infers an input.
        """
        columns = self.columns
        names = [column.name for column in columns.inputs]
        cases = dict.fromkeys(_without_exclusive(first, names, self.asked.measured) for first in names or [""])
        some = LABEL._replace(properties=dict.fromkeys(PROPERTIES, _NO_ROWS))
        solids, labels = dict[str, Material | None](), dict[str, Material | None]()
        if columns.materials:  # each row decides whether both spheres are of a solid with a displacement
            for name, solid in self.spheres.items():
                solids[name] = solid._replace(displacement=None) if solid else None
        for column in columns.materials:
            texts = {text for text in cells[column.name] if text.strip()}
            if texts and texts <= self.lookups[column.name].errors.keys():
                labels[column.name] = LABEL
            solids[column.name] = some

        def frames_of(solids: Mapping[str, Material | None]) -> list[Frame]:
            return [self.frame(dict.fromkeys(case, _NO_ROWS), solids) for case in cases]

        frames = frames_of(solids | labels)
        if labels and (self.asked.infer or frames[0].missing(["work_of_adhesion"])):
            return frames_of(solids)  # the rows then report unknown materials
        return frames

    def _names(self, frames: Sequence[Frame]) -> tuple[Sequence[str], Sequence[str]]:
        """Return the quantities that columns and options allow, and those of them that every row shows."""
        explicit, offered = self.asked.explicit, self.asked.offered
        if self.asked.infer:
            frames[0].check()
            return [self.asked.infer], [self.asked.infer]
        for name in explicit:
            self._check_explicit(name, frames)
        first, second = self.spheres.values()
        is_of_two = second not in (None, first) or any(NOMENCLATURE[name].sphere == 2 for name in self.given)
        shown: set[str] = set()
        for frame in frames:
            shown.update(filter(frame.shows_to_identical, frame.possible(offered)))
        shown -= self.given
        possible = []
        shown_in_all = [*explicit]
        for name in offered:
            quantity = NOMENCLATURE[name]
            if name in shown and not (is_of_two and quantity.of_identical):
                possible.append(name)
                if quantity.shown_with and not quantity.of_identical:
                    shown_in_all.append(name)  # some rows show the quantity, so all rows do
        names = [*dict.fromkeys((*explicit, *possible))]
        if not names:
            frames[0].plans(offered[0])  # raises MissingInput if an input is missing
            raise BadRequest("--quantities: known for identical spheres only, but the table describes sphere 2")
        return names, shown_in_all

    def _check_explicit(self, name: str, frames: Sequence[Frame]) -> None:
        """Raise an error if a quantity requested by name is an input, or lacks inputs in all frames."""
        if name in self.given:
            raise repeated_input(name)
        if not all(frame.missing([name]) for frame in frames):
            return
        try:
            frames[0].plans(name)
        except NotInLaw:
            return  # the column stays empty
        except MissingInput as error:
            unknown = [*chain.from_iterable(lookup.errors.values() for lookup in self.lookups.values())]
            if unknown:
                raise BadTable(f"{unknown[0]}; {error}") from None
            raise

    def _sources(self, block: "TableBlock") -> list[Sources]:
        """Return the sources of uncertainty of each group of rows with uncertain inputs."""
        sources = []
        for group in groups(block):
            with suppress(JkrollError):  # the status of bad rows has the reason
                frame = block.frame(group.given(group.rows), group.rows)
                if frame.uncertainties:
                    sources.append(sources_of_results(frame, self.names))
        return sources


def _material(given: str | Material, known: Materials) -> Material:
    """Return a material by its name; a given material is returned unchanged."""
    return known[given] if isinstance(given, str) else given


def _labels(columns: Header, rows: Sequence[Sequence[str]], asked: Asked) -> dict[str, int]:
    """Return the names and positions of columns that may label rows of statistics.

    Inputs and columns in `--column` are left out. So is a column that labels all first rows as means or extremes, since
    those rows are the data.
    """
    inputs: set[int] = set()
    for column in columns.inputs:
        inputs |= {*column.positions.values()}
    labels = {}
    for position, text in enumerate(columns.texts):
        is_free = position not in inputs and typed(text) not in asked.stated
        if is_free and not are_kinds_of_data([row[position].encode() for row in rows]):
            labels[f"{LABEL_OF}{position}"] = position
    return labels


def _without_exclusive(first: str, names: Sequence[str], measured: str) -> tuple[str, ...]:
    """Return the names that neither `first` nor an earlier name excludes; `measured` excludes none and stays."""
    chosen: set[str] = set()
    for name in (first, *names):
        others = chosen - {measured, name}
        is_excluded = any(name in group and not others.isdisjoint(group) for group in EXCLUSIVE)
        if name == measured or not is_excluded:
            chosen.add(name)
    return tuple(name for name in names if name in chosen)


# --- Rows -------------------------------------------------------------------------------------------------------------


class Records(NamedTuple):
    """A block of a table as columns of cells."""

    before: Any  # the text or the columns that the output has before the results
    cells: Mapping[str, Sequence[bytes]]  # by the name of the column
    odd: Mapping[int, JkrollError] = MappingProxyType({})  # records that are not rows, with the error
    starts: Sequence[int] = ()  # the first line of each record, counted in the block
    size: int = 0  # the number of lines


class TableBlock:
    """A block of rows of a table; rows whose materials have the same properties can share a frame."""

    def __init__(self, table: Table, records: Records) -> None:
        """`records`: the cells of the columns that the table reads."""
        self.table, self.cells, self.odd = table, records.cells, records.odd
        numbers: dict[str, Numbers] = {}
        for column in table.columns.inputs:
            numbers[column.name] = column.numbers(self.cells)
        self.numbers: Mapping[str, Numbers] = numbers
        self._check_header()
        self.indices = {name: table.lookups[name].indices(self.cells[name]) for name in MATERIALS if name in self.cells}
        are_rows = numpy.zeros(len(records.before), dtype=numpy.int64)
        self.statistics: dict[int, str] = {}
        for label in table.labels:
            rows = rows_of_statistics(self.cells[label], alone=bool(table.asked.infer))
            self.statistics |= dict.fromkeys(rows, label)
        are_rows[[*self.odd, *self.statistics]] = BAD
        marks = [table.lookups[name].marks(indices) for name, indices in self.indices.items()]
        self.size = len(are_rows)
        self.marks: Sequence[Any] = [are_rows, *marks]

    def _check_header(self) -> None:
        """Raise BadTable for a row that is a header with other units, or another order, than that of the table."""
        if not self.numbers:
            return
        first, *_ = self.numbers.values()
        texts, positions = self.table.columns.texts, self.table.columns.positions
        heads = {name: typed(texts[position]) for name, position in positions.items() if name not in MATERIALS}
        for row in first.odd:
            others = [typed(self.cells[name][row].decode(errors="replace")) for name in heads]
            if others != [*heads.values()] and all(is_input(text, self.table.asked.measured) for text in others):
                instead = f"{quoted(', '.join(others))} instead of {quoted(', '.join(heads.values()))}"
                raise BadTable(
                    f"a row below the header is another header: {instead}. Split the file there, and convert each part"
                )

    @property
    def half_bars(self) -> dict[int, JkrollError]:
        """The errors of rows with only one side of an uncertainty, by row. Results of such rows have no uncertainty."""
        errors: dict[int, JkrollError] = {}
        for column in self.table.columns.inputs:
            problem = (
                f"{column.name}: one side of its error bar is missing, so the results of this row have no error bars"
            )
            for row in column.half_bars(self.cells):
                errors[row] = BadRequest(problem, "half an error bar")
        return errors

    def frame(self, given: Mapping[str, Any], rows: Indices) -> Any:
        """Return the frame of rows of a group, from the values of their inputs."""
        solids = {name: self.table.lookups[name].together(indices[rows]) for name, indices in self.indices.items()}
        frame = self.table.frame(given, solids)
        if LABEL in solids.values() and frame.missing(self.table.names):
            raise BadRequest("unknown material")  # single rows report which one
        return frame

    def frame_of(self, row: int) -> Any:
        """Return the frame of a single row. Raises BadRequest, or the error of a cell or of the frame."""
        if row in self.odd:
            raise self.odd[row]
        if row in self.statistics:
            label = self.statistics[row]
            text = quoted(self.cells[label][row].decode(errors="replace").strip())
            head = typed(self.table.columns.texts[self.table.labels[label]])
            remedy = f"--column {quoted(f'{head}=')} if it is a label"
            raise BadRequest(f"{text}: a row of statistics is not a contact; {remedy}", "row of statistics")
        table = self.table
        cells = {name: column[row].decode(errors="replace") for name, column in self.cells.items()}
        given: dict[str, Any] = {}
        for column in table.columns.inputs:
            text = column.joined(*(cells[name] for name in column.positions))
            if text.strip():
                given[column.name] = column.value(text)
        solids = {name: table.lookups[name].known[indices[row]] for name, indices in self.indices.items()}
        frame = table.frame(given, solids)
        if frame.missing(table.names):
            for name in self.indices:
                error = table.lookups[name].errors.get(self.cells[name][row])
                if error is not None:
                    raise error
        return frame
