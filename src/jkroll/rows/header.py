"""The header of a table: the columns that are inputs, their units, and the columns that pass through."""

import re
from collections.abc import Iterable, Iterator, Mapping, Sequence
from contextlib import suppress
from itertools import product
from math import isfinite, log10
from types import MappingProxyType
from typing import NamedTuple

from ..errors import BadRequest, JkrollError
from ..quantities.errors import BareNumber, QuantityError
from ..quantities.nomenclature import NOMENCLATURE, PROPERTIES, XI
from ..quantities.nomenclature import header as header_of
from ..quantities.units import BadUnit, Unit, dimension_of, exponent_of, kind_of
from ..quantities.values import Uncertain, error_about, parse_value, split_number, unit_of, value_of, written
from ..text import closest, first_of, listed, quoted, shown
from .readings import (
    INPUTS,
    MATERIALS,
    NO_INPUTS,
    Reading,
    fits,
    is_of_directions,
    may_be_input,
    measured_reading,
    reading_of,
    uncertainty_beside,
    unit_alone,
    unit_in_header,
)

_PLUS_MINUS = re.compile(r"±|\+/?[-−]")
_OF_VALUE = re.compile(r"(?:(?:±|\+/?-)[^±]*%)?$", re.DOTALL)  # as in 25±20 %
_BARE = re.compile(r"(?:[-+±()/.0-9\s]|(?<=[0-9.)])[eE](?=[-+0-9])|\bto\b)*")  # numbers without a unit
_EASY = re.compile(r"[\w*.-]+( \[[^\[\] ]*\])?")  # a header that needs no quotes in a sentence
_PARTS = "values have a column of ± beside them, or two, of minus and plus; a range has low and high alone"
_MAX_SAID = 8  # columns that pass through and are named
_NAMED = ("radius", *PROPERTIES, "load", XI)  # of which a symbol without a unit is named
_NO_END = "?"  # of a range
_NOTHING = ("nan", "na", "n/a", "null", "none", "-", "--")  # cells without a value, as programs write them
_PREFIXES = ("n", "u", "m", "", "k", "M", "G")


class BadTable(JkrollError):
    """Error raised for a header, a format or a file that makes no table of scenes."""


class BadRow(JkrollError):
    """Error raised for the first row that fails, with `--strict`. Its line is counted from the beginning of the block, or of the table."""

    exit_code = 1

    def __init__(self, line: int, status: str) -> None:
        super().__init__(line, status)
        self.line, self.status = line, status

    def __str__(self) -> str:
        return f"line {self.line}: {self.status}"


class Side(NamedTuple):
    """The column of a part of an input's uncertainty."""

    part: str  # as `Reading` has it
    place: int
    unit_text: str  # of the cells; an empty text where it is that of the values


class Column(NamedTuple):
    """The column of an input, with the unit of the cells that carry none, and the columns of its uncertainty.

    A range has no column but those of its ends, of which the first is the low one.
    """

    place: int
    name: str
    unit_text: str
    unit: Unit | None
    sides: tuple[Side, ...] = ()

    @property
    def places(self) -> dict[str, int]:
        """The places of the columns whose cells make a value."""
        own = {} if self.is_range else {self.name: self.place}
        return own | {f"{self.name}_{side.part}": side.place for side in self.sides}

    @property
    def is_range(self) -> bool:
        """True if a value is known by its ends."""
        return bool(self.sides) and self.sides[0].part == "low"

    def joined(self, *cells: str) -> str:
        """Return the cells of a value as one: 25 and 5 as 25±5. Cells with units of their own keep them."""
        first, *others = (cell.strip() for cell in cells)
        is_single = _are_equal(first, *others) if self.is_range else not any(others)
        if is_single:
            return first
        are_bare = all(map(_BARE.fullmatch, (first, *others)))
        if not self.is_range and len(others) == 1:
            unit_text = self.sides[0].unit_text
            if are_bare and not unit_text:
                return f"({first}±{others[0]})"
            return f"{self._with_unit(first)}±{_in_unit(others[0], unit_text or self.unit_text)}"
        if not are_bare:
            first, *others = map(self._with_unit, (first, *others))
        if self.is_range:
            return f"{first or _NO_END} to {others[0] or _NO_END}"
        minus, plus = others[0].removeprefix("-") or "0", others[1].removeprefix("+") or "0"
        return f"{first} +{plus}/-{minus}"

    def _with_unit(self, text: str) -> str:
        """Return numbers with the unit of the column, unless they have one."""
        of_value = _OF_VALUE.search(text)
        assert of_value is not None  # it matches any text
        number = text[: of_value.start()].strip()
        is_pair = bool(_PLUS_MINUS.search(number)) and not number.startswith("(")
        return _in_unit(number, self.unit_text, is_pair=is_pair) + of_value[0]

    @property
    def exponent(self) -> int | None:
        """The unit as a power of ten of the SI unit; None if it is no power of ten, or if there is no unit."""
        if self.unit is None:
            return 0 if NOMENCLATURE[self.name].unit == "1" else None
        return exponent_of(self.unit)

    def read(self, text: str) -> float | Uncertain:
        """Return the SI value of a cell, with its uncertainty if it states one. Its unit is its own or that of the column."""
        if self.is_range and _NO_END in text.split():
            raise QuantityError(self.name, text, "is a range without an end")
        if text.lstrip().startswith("±"):
            raise QuantityError(self.name, text, "is an error bar without a value")
        if text.strip().casefold() in _NOTHING:
            raise QuantityError(self.name, text, "is no number", "leave the cell empty if there is none")
        try:
            return value_of(self._with_unit(written(text)), self.name)
        except BadUnit as error:
            raise error_about(self.name, text, error) from None
        except BareNumber:
            if self.unit is None:
                raise
            raise QuantityError(self.name, text, f"is not a number of {self.unit_text}") from None


class Header(NamedTuple):
    """The columns of a table."""

    texts: tuple[str, ...]
    inputs: tuple[Column, ...]
    materials: tuple[tuple[str, int], ...]  # name and place of the columns that name materials
    alike: tuple[str, ...] = ()  # columns that pass through though they look like quantities
    meanings: Mapping[str, Reading] = MappingProxyType({})  # what `--column` says of headers
    unread: Mapping[str, str] = MappingProxyType({})  # columns that pass through, and the inputs that they may be
    preamble: int = 0  # lines before the header that are passed over

    @property
    def names(self) -> frozenset[str]:
        """The names of the inputs that have columns."""
        return frozenset({column.name for column in self.inputs} | {name for name, _ in self.materials})

    def reading(self) -> str:
        """Return the sentence that says how the table is read. What looks like an input, and then like a quantity, stands first among what passes through."""
        materials = [_from(name, "", self.texts[place]) for name, place in self.materials]
        read = [*materials, *map(self._reading_of, self.inputs)]
        places = {place for _, place in self.materials}
        places = places.union(*(column.places.values() for column in self.inputs))
        others = [text for place, text in enumerate(self.texts) if place not in places and text.strip()]
        sentence = f"read: {', '.join(read) or 'no input'}"
        if self.preamble:
            lines = "a line" if self.preamble == 1 else f"{self.preamble} lines"
            sentence += f"; passed over: {lines} before the header"
        if not others:
            return sentence
        passing = [_easy(text) for text in dict.fromkeys((*self.unread, *self.alike, *others)) if text.strip()]
        count = f"{len(others)} columns: " if len(others) > _MAX_SAID else ""
        return f"{sentence}; passed through: {count}{first_of(passing, _MAX_SAID)}"

    def advice(self) -> str:
        """Return the note on columns that may be inputs of which no other column is; an empty text if there are none."""
        meant = {text: meaning for text, meaning in self.unread.items() if meaning.partition(" ")[0] not in self.names}
        if not meant:
            return ""
        may_be = "is passed through; if it is an input" if len(meant) == 1 else "are passed through; if they are inputs"
        return f"note: {', '.join(map(_easy, meant))} {may_be}, write {_columns(meant)}"

    def _reading_of(self, column: Column) -> str:
        """Return the name of an input with the headers that it is read from, if these are others."""
        heads = {side.part: _easy(self.texts[side.place]) for side in column.sides}
        if column.is_range:
            return f"{header_of(column.name, column.unit_text)} from {heads['low']} to {heads['high']}"
        own = _from(column.name, column.unit_text, self.texts[column.place])
        marks = {"both": "±", "minus": "−", "plus": "+"}
        return " ".join([own, *(f"{marks[part]} {head}" for part, head in heads.items())])


def _from(name: str, unit_text: str, text: str) -> str:
    """Return the name of an input with the header that it is read from, if that is another."""
    head = header_of(name, unit_text)
    return head if text.strip() in (head, name) else f"{head} from {_easy(text)}"


def _easy(text: str) -> str:
    return shown(text) if _EASY.fullmatch(text) else f'"{shown(text)}"'


def stated_meanings(names: Iterable[str], texts: Iterable[str], measured: str = "") -> dict[str, Reading]:
    """Return the meaning of columns that options say: of those that `--column` names and their uncertainties, and of those of a measured quantity."""
    texts_of = [name.strip() for name in names]
    of_measured = {name: measured_reading(name, measured) for name in texts_of} if measured else {}
    chosen = column_options(texts, measured)
    found = {name: reading for name, reading in of_measured.items() if reading is not None} | chosen
    values = [(head, reading.name) for head, reading in chosen.items() if reading.name and not reading.part]
    for name, (head, of_value) in product(texts_of, values):
        if name not in found and (reading := uncertainty_beside(name, head, of_value)) is not None:
            found[name] = reading
    return found


def column_options(texts: Iterable[str], measured: str = "") -> dict[str, Reading]:
    """Return what the values of `--column` say of headers: 'R2 (nm)=radius2 [nm]', or 'T (K)=' for no input. Raises BadRequest.

    `measured`: a quantity that columns have besides inputs.
    """
    found: dict[str, Reading] = {}
    for text in texts:
        head, is_pair, meaning = text.rpartition("=")
        if not is_pair or not head.strip():
            raise BadRequest(f"--column: {quoted(text)} is not of the form HEADER=INPUT, as in 'R2 (nm)=radius2 [nm]'")
        reading = (measured and measured_reading(meaning, measured)) or reading_of(meaning)
        if meaning.strip() and (not reading.name or reading.is_symbol):
            meant = (
                f"; did you mean {_meant(reading.meant)}?"
                if reading.meant
                else "; write a name with its unit, as in radius [nm]"
            )
            raise BadRequest(f"--column: {quoted(meaning)} is not an input{meant}")
        if head.strip() in found:
            raise BadRequest(f"--column: {quoted(head)} is given more than once")
        if reading.name and reading.name not in MATERIALS and reading.unit_text is None:
            reading = reading._replace(unit_text=unit_in_header(head.strip(), reading.name))
        found[head.strip()] = reading if meaning.strip() else Reading()
    return found


def understood(
    texts: Sequence[str], rows: Sequence[Sequence[str]] = (), meanings: Mapping[str, Reading] = MappingProxyType({})
) -> Header:
    """Return the columns of a header, given the cells of its first rows and what some are said to mean. Raises BadTable."""
    _check_meanings(texts, meanings)
    _check_mistaken(texts, rows, meanings)
    of_directions = next(filter(is_of_directions, texts), "")
    inputs: list[Column] = []
    materials: list[tuple[str, int]] = []
    parts: dict[str, dict[str, int]] = {}  # the places of the parts of an input's uncertainty
    alike: list[str] = []
    unread: dict[str, str] = {}
    seen: dict[str, str] = {}
    at_left = ""  # the input of the column before
    for place, text in enumerate(texts):
        reading, may_be = _meaning(text, [row[place] for row in rows], at_left, of_directions, meanings)
        name = reading.name
        if name in MATERIALS:
            materials.append((name, place))
        elif reading.part:
            parts.setdefault(name, {})[reading.part] = place
        elif name:
            inputs.append(_column(place, name, reading.unit_text, text))
        elif reading.is_alike:
            alike.append(text)
        if may_be:
            unread[text] = may_be
        at_left = "" if name in MATERIALS or reading.part else name
        _check_new(text, f"{name} {reading.part}" if name else text, seen)
    others = [*alike, *_add_parts(parts, texts, inputs, meanings)]
    return Header(tuple(texts), tuple(inputs), tuple(materials), tuple(others), meanings, unread)


def _reading(text: str, meanings: Mapping[str, Reading]) -> Reading:
    """Return the meaning of a header: that of `--column`, else its own."""
    return meanings.get(text.strip()) or reading_of(text)


def _meaning(
    text: str, cells: Sequence[str], at_left: str, of_directions: str, meanings: Mapping[str, Reading]
) -> tuple[Reading, str]:
    """Return the meaning of a column, and what input it may be if it passes through. Raises BadTable.

    `cells`: of the first rows; `at_left`: the input of the column before, to which a unit alone belongs as its
    uncertainty; `of_directions`: a header of the table that says that moduli are those along directions.
    """
    reading = _reading(text, meanings)
    is_alone = unit_alone(text) is not None and not _is_text(_first(cells))
    if at_left and not reading.name and is_alone and text.strip() not in meanings:
        reading = Reading(at_left, part="both")
    name = reading.name
    if reading.is_symbol and not reading.part and not _have_units(name, cells) and not fits(_unit_of_row(cells), name):
        is_named = name.removesuffix("2") in _NAMED and _is_number(_first(cells))
        return Reading(is_alike=True), with_unit(name, cells) if is_named else ""
    if of_directions and name.removesuffix("2") == "youngs_modulus" and text.strip() not in meanings:
        problem = f"the modulus along a direction, as {quoted(of_directions)} beside it says?"
        raise _no_input(text, Reading(problem=problem), cells)
    if name in MATERIALS and reading.unit_text is not None:
        raise BadTable(f"header: {quoted(text)}: a material has no unit; write {name}")
    if reading.meant or reading.problem:
        raise _no_input(text, reading, cells)
    return reading, may_be_input(text) if not name and reading.is_alike and text.strip() not in meanings else ""


def _check_meanings(texts: Sequence[str], meanings: Mapping[str, Reading]) -> None:
    """Raise BadTable for the meaning of a column that the table does not have."""
    heads = {text.strip() for text in texts}
    for text in meanings:
        if text not in heads:
            guess = closest(text, texts)
            meant = f"; did you mean {quoted(guess)}?" if guess else ""
            raise BadTable(f"--column: the table has no column {quoted(text)}{meant}")


def _check_mistaken(texts: Sequence[str], rows: Sequence[Sequence[str]], meanings: Mapping[str, Reading]) -> None:
    """Raise BadTable for several columns that look like mistyped inputs, with what reads all of them."""
    readings = {place: _reading(text, meanings) for place, text in enumerate(texts)}
    meant = {
        texts[place]: _meant(reading.meant, [row[place] for row in rows])
        for place, reading in readings.items()
        if reading.meant
    }
    if len(meant) > 1:
        names = listed(map(quoted, meant))
        raise BadTable(f"header: {names} are not inputs; if they are meant as such, write {_columns(meant)}")


def _no_input(text: str, reading: Reading, cells: Sequence[str]) -> BadTable:
    """Return the error of a column that looks like a mistyped input."""
    meant = _meant(reading.meant, cells)
    is_wrong = f"; did you mean {meant}?" if meant else f": {reading.problem}"
    is_none = reading.problem in NO_INPUTS
    remedy = (
        f"--column {_column_option(text, '')} to pass it through"
        if is_none
        else _remedies({text: meant or "INPUT [UNIT]"})
    )
    return BadTable(f"header: {quoted(text)} is not an input{is_wrong} Write {remedy}")


def _check_new(text: str, key: str, seen: dict[str, str]) -> None:
    """Raise BadTable for the second column of one meaning, if it has a name. `seen`: the headers of before, by what they mean."""
    if key in seen and key.strip():
        other = seen[key]
        both = f"two columns {quoted(text)}" if other == text else f"the columns {quoted(other)} and {quoted(text)}"
        raise BadTable(f"header: {both}, of which one must go")
    seen[key] = text


def _add_parts(
    parts: Mapping[str, Mapping[str, int]], texts: Sequence[str], inputs: list[Column], meanings: Mapping[str, Reading]
) -> Iterator[str]:
    """Add the columns of uncertainties to those of their inputs, and iterate over the texts of those that make none. Raises BadTable."""
    for name, places in parts.items():
        own = {part: texts[place] for part, place in places.items()}
        if (found := _with_parts(name, places, own, inputs, meanings)) is not None:
            inputs[:] = [*(column for column in inputs if column.name != name), found]
            used = [own.pop(side.part) for side in found.sides]
            if second := own.get("minus", own.get("plus")):
                raise BadTable(
                    f"header: {quoted(used[0])} and {quoted(second)} are both uncertainties of {name}; one must go"
                )
        if lost := [text for text in own.values() if text.strip() in meanings]:
            raise BadTable(f"header: {quoted(lost[0])} is not an uncertainty of {name}: {_PARTS}")
        yield from own.values()


def _with_parts(
    name: str,
    places: Mapping[str, int],
    texts: Mapping[str, str],
    inputs: Sequence[Column],
    meanings: Mapping[str, Reading],
) -> Column | None:
    """Return the column of an input with those of its uncertainty; None if these make none. Raises BadTable."""
    base = next((column for column in inputs if column.name == name), None)
    kinds = ("both",) if "both" in places else ("minus", "plus") if base else ("low", "high")
    if not {*kinds} <= places.keys() or (base is None and kinds == ("both",)):
        return None
    units = {part: _unit_in(text, name, meanings) for part, text in texts.items()}
    if base is None:
        first = next(filter(None, (units[part] for part in kinds)), None)
        base = _column(places["low"], name, first, texts["low"])
    sides: list[Side] = []
    for part in kinds:
        unit_text = units[part] or base.unit_text
        if unit_text == base.unit_text:
            unit_text = ""
        elif len(kinds) > 1:
            own = f", {base.unit_text}" if base.unit_text else "; that has none"
            raise BadTable(f"header: {quoted(texts[part])}: its unit must be that of the other column{own}")
        elif unit_text != "%":
            _column(places[part], name, unit_text, texts[part])  # raises what is wrong with the unit
        sides.append(Side(part, places[part], unit_text))
    return base._replace(sides=tuple(sides))


def _unit_in(text: str, name: str, meanings: Mapping[str, Reading]) -> str | None:
    """Return the unit in the header of an input's uncertainty, which may be a mark alone."""
    reading = _reading(text, meanings)
    return _scale(reading.unit_text if reading.name else unit_alone(text), name)


def _scale(unit_text: str | None, name: str) -> str | None:
    """Return a unit; None where cells are plain numbers, or carry their own: there is none, or it is that of a ratio."""
    is_of_ratio = unit_text in ("1", "-") and NOMENCLATURE[name].unit == "1"
    return None if is_of_ratio else unit_text or None


def with_unit(name: str, cells: Sequence[str] = (), part: str = "") -> str:
    """Return the header of an input, or of a part of its uncertainty, with the likely unit of its cells if it needs one."""
    needs_unit = any(dimension_of(NOMENCLATURE[name].unit or "1"))
    return f"{name}{part} [{_likely_unit(name, cells)}]" if needs_unit else f"{name}{part}"


def _meant(text: str, cells: Sequence[str] = ()) -> str:
    """Return the header that was probably meant, with a unit."""
    return with_unit(text, cells) if text in INPUTS else text


def _remedies(meant: Mapping[str, str]) -> str:
    """Return what to write to read columns as what they may mean, and, if it is one, to pass it through."""
    passing = [f", or {_column_option(text, '')} to pass it through" for text in meant]
    return f"{_columns(meant)}{passing[0] if len(passing) == 1 else ''}"


def _columns(meant: Mapping[str, str]) -> str:
    """Return the options that read columns as what they may mean."""
    return " ".join(f"--column {_column_option(text, meaning)}" for text, meaning in meant.items())


def _column_option(text: str, meaning: str) -> str:
    """Return the value of `--column` in the quotes of a shell."""
    value = shown(f"{text.strip()}={meaning}")
    return f'"{value}"' if "'" in value else f"'{value}'"


def _have_units(name: str, cells: Sequence[str]) -> bool:
    """Return whether some cell is a value of an input, with its unit."""
    for cell in dict.fromkeys(cells):
        if cell.strip() and not _is_number(cell):
            with suppress(QuantityError):
                value_of(cell, name)
                return True
    return False


def _in_unit(number: str, unit_text: str, *, is_pair: bool = False) -> str:
    """Return a number with a unit, unless it has one. `is_pair`: whether it is a value and its error bar."""
    if not number or not unit_text or not _BARE.fullmatch(number):
        return number
    return f"({number}) {unit_text}" if is_pair else f"{number} {unit_text}"


def _are_equal(first: str, second: str) -> bool:
    """Return whether two cells are the same, or the same number."""
    return first == second or (_is_number(first) and _is_number(second) and float(first) == float(second))


def _first(cells: Sequence[str]) -> str:
    """Return the first cell that is not empty, or an empty text if there is none."""
    return next(filter(str.strip, cells), "")


def _unit_of_row(cells: Sequence[str]) -> str:
    """Return the first cell as a unit, which may stand in brackets."""
    return _first(cells).strip().strip("[]()")


def _is_text(cell: str) -> bool:
    """Return whether a cell is neither a number nor empty, as programs write that."""
    return cell.strip()[:1].isalpha() and cell.strip().casefold() not in _NOTHING


def _is_number(text: str) -> bool:
    try:
        return isfinite(float(text))
    except ValueError:
        return False


def holds_input(text: str, cell: str, meanings: Mapping[str, Reading]) -> bool:
    """Return whether a header and its cell are those of an input."""
    reading = _reading(text, meanings)
    return bool(reading.name) and (not reading.is_symbol or _have_units(reading.name, [cell]))


def is_input(text: str, meanings: Mapping[str, Reading] = MappingProxyType({})) -> bool:
    """Return whether a header may be that of an input; a symbol without a unit is one if its cells have units."""
    return unit_alone(text) is not None or bool(_reading(text, meanings).name)


def _column(place: int, name: str, unit_text: str | None, text: str) -> Column:
    """Return the column of an input. Without a unit its cells carry their own, or are plain numbers if it is a ratio."""
    scale = _scale(unit_text, name)
    if scale is None:
        return Column(place, name, "", None)
    try:
        unit = unit_of(scale, name)
        if unit.dimension != dimension_of(NOMENCLATURE[name].unit):
            raise QuantityError(name, scale, f"is {kind_of(unit.dimension)}")
    except QuantityError as error:
        raise BadTable(f"header: {quoted(text)}: {quoted(scale)} {error.problem()}") from None
    return Column(place, name, scale, unit)


def check_units(header: Header, rows: Sequence[Sequence[str]]) -> None:
    """Raise BadTable for columns that have a unit neither in their header nor in their first cell; `rows`: the first ones."""
    in_first_row: dict[str, str] = {}  # what columns mean whose units are a row of their own
    for column in header.inputs:
        cells = [row[column.place] for row in rows]
        first = _first(cells)
        if not first or column.unit is not None or column.exponent is not None:
            continue
        parts = {column.place: ""} | {side.place: f"_{side.part}" for side in column.sides}
        meant = {header.texts[place]: with_unit(column.name, cells, part) for place, part in parts.items()}
        try:
            value_of(first, column.name)
        except BareNumber:
            text, guess = header.texts[column.place], _likely_unit(column.name, cells)
            lacks = f"has no unit, and neither has its first cell {quoted(first)}. If it is in {guess}, write"
            raise BadTable(f"header: {quoted(text)} {lacks} {_remedies(meant)}") from None
        except QuantityError:
            if fits(_unit_of_row(cells), column.name):
                in_first_row |= meant  # else it is a bad row, not a bad header
    if in_first_row:
        raise BadTable(f"header: the first row has units. Delete it, and write {_remedies(in_first_row)}")


def _no_measured(header: Header, quantity: str) -> BadTable:
    """Return the error of a table without a column of the measured quantity, with the option that names one."""
    likely = (text for text in header.texts if unit_in_header(text, quantity) and not is_input(text, header.meanings))
    text = next(likely, "")
    columns = _columns({text: quantity} if text else {"HEADER": f"{quantity} [UNIT]"})
    return BadTable(f"header: no column has the measured {quantity}; name it by {columns}")


def check_inputs(header: Header, measured: str = "") -> None:
    """Raise BadTable for a table of which no column is an input, so that a row says nothing of a contact, or the measured quantity."""
    if measured in header.names or (header.names and not measured):
        return
    if not header.names and header.texts[0].startswith("#"):
        raise BadTable(
            "header: the first line is a comment; take out the lines before the columns' names, and the # before these"
        )
    if all(map(_is_number, header.texts)):
        raise BadTable(f"header: {quoted(header.texts[0])} is a number; begin with a line of the columns' names")
    if measured:
        raise _no_measured(header, measured)
    columns = _columns(header.unread or {"HEADER": "INPUT [UNIT]"})
    raise BadTable(
        f"header: no column is an input; a row is a contact, and its inputs have columns such as radius [nm]. Write {columns}"
    )


def _likely_unit(name: str, cells: Sequence[str]) -> str:
    """Return the unit that stands in the first cell, or that in which the geometric mean of the cells is nearest to the quantity's example."""
    if fits(unit := _unit_of_row(cells), name):
        return unit
    example = _example(name)
    if not example:
        return NOMENCLATURE[name].unit
    logarithms = [log10(abs(float(cell))) for cell in cells if _is_number(cell) and float(cell)]
    if not logarithms:
        return _likely_units(name)[0]
    wanted = log10(abs(parse_value(example, dimension_of(NOMENCLATURE[name].unit)))) - sum(logarithms) / len(logarithms)
    return min(
        _likely_units(name),
        key=lambda unit: abs(log10(parse_value(f"1 {unit}", dimension_of(NOMENCLATURE[name].unit))) - wanted),
    )


def _example(name: str) -> str:
    """Return a value of a quantity as it may be written, or of an input of its dimension; "" if there is none."""
    unit = NOMENCLATURE[name].unit
    return next((NOMENCLATURE[one].example for one in (name, *INPUTS) if NOMENCLATURE[one].unit == unit), "")


def _likely_units(name: str) -> Sequence[str]:
    """Return the units of a quantity from that of its example to that of SI, in steps of a thousand if prefixes make them.

    >>> _likely_units("youngs_modulus"), _likely_units("density")
    (['GPa', 'MPa', 'kPa', 'Pa'], ['g/cm3', 'kg/m^3'])
    """
    unit = NOMENCLATURE[name].unit
    own = split_number(_example(name))[2]
    prefix = own.removesuffix(unit)
    if prefix not in _PREFIXES:
        return [own, unit]
    first, last = _PREFIXES.index(prefix), _PREFIXES.index("")
    step = 1 if first < last else -1
    return [f"{_PREFIXES[place]}{unit}" for place in range(first, last + step, step)]
