"""The header of a table: the columns that are inputs, with their units, those that pass through, and what is refused."""

import re
from collections.abc import Collection, Iterable, Mapping, Sequence
from contextlib import suppress
from types import MappingProxyType
from typing import NamedTuple

from ..errors import BadRequest, BadTable
from ..quantities.errors import QUANTITY_SYNONYMS, QuantityError
from ..quantities.laws import LAWS
from ..quantities.nomenclature import NOMENCLATURE
from ..quantities.nomenclature import header as header_of
from ..quantities.values import unit_of, value_of
from ..text import closest, first_of, quoted, shown
from .cells import Column, is_number
from .readings import Reading, fits, named, read, reading_of, unit_for, with_unit
from .sides import with_sides
from .words import MATERIALS, key

_MAX_SAID = 60  # columns that pass through and are named
_OF_DIRECTIONS = re.compile(r"\s*(G|nu|ν)_?(12|13|23|xy|xz|yz)(?![^\W_])", re.IGNORECASE)


class Header(NamedTuple):
    """The columns of a table."""

    texts: tuple[str, ...]
    inputs: tuple[Column, ...]
    materials: tuple[tuple[str, int], ...]  # name and place of the columns that name materials
    meanings: Mapping[str, Reading] = MappingProxyType({})  # what `--column` says of headers
    preamble: int = 0  # lines before the header that are passed over

    @property
    def names(self) -> frozenset[str]:
        """The names of the inputs that have columns."""
        return frozenset({column.name for column in self.inputs} | {name for name, _ in self.materials})

    def reading(self) -> str:
        """Return the sentence that says how the table is read."""
        materials = [_from(name, "", self.texts[place]) for name, place in self.materials]
        sentence = f"read: {', '.join([*materials, *map(self._reading_of, self.inputs)]) or 'no input'}"
        if self.preamble:
            lines = "a line" if self.preamble == 1 else f"{self.preamble} lines"
            sentence += f"; passed over: {lines} before the header"
        places = {place for _, place in self.materials}
        places = places.union(*(column.places.values() for column in self.inputs))
        others = [text for place, text in enumerate(self.texts) if place not in places and text.strip()]
        if not others:
            return sentence
        passing = [_easy(text) for text in dict.fromkeys(others)]
        count = f"{len(others)} columns: " if len(others) > _MAX_SAID else ""
        return f"{sentence}; passed through: {count}{first_of(passing, _MAX_SAID)}"

    def _reading_of(self, column: Column) -> str:
        """Return the name of an input with the headers that it is read from, if these are others."""
        heads = {side.part: _easy(self.texts[side.place]) for side in column.sides}
        if column.is_range:
            return f"{header_of(column.name, column.unit_text)} from {heads['low']} to {heads['high']}"
        value = _from(column.name, column.unit_text, self.texts[column.place])
        marks = {"both": "±", "minus": "−", "plus": "+"}
        return " ".join([value, *(f"{marks[part]} {head}" for part, head in heads.items())])


def _from(name: str, unit_text: str, text: str) -> str:
    """Return the name of an input with the header that it is read from, if that is another."""
    head = header_of(name, unit_text)
    return head if text.strip() in (head, name) else f"{head} from {_easy(text)}"


def _easy(text: str) -> str:
    """Return a header, in quotes if it has blanks besides that before a unit in brackets."""
    return shown(text) if " " not in text.strip().replace(" [", "[") and "(" not in text else f'"{shown(text)}"'


# --- What options say of columns --------------------------------------------------------------------------------------


def stated_meanings(names: Iterable[str], texts: Iterable[str], measured: str = "") -> dict[str, Reading]:
    """Return the meaning of columns that options say: of those that `--column` names and their uncertainties, and of those of a measured quantity."""
    chosen = column_options(texts, measured)
    more = {key(word): measured for word in (measured, NOMENCLATURE[measured].symbol)} if measured else {}
    for head, reading in chosen.items():
        if reading.name and not reading.part:
            more[named(head, reading.name)[0]] = reading.name
    found = {}
    for head in map(str.strip, names) if more else ():
        reading = read(head, more)
        if reading.is_input and (reading.name == measured or (reading.part and not reading_of(head).is_input)):
            found[head] = reading
    return found | chosen


def column_options(texts: Iterable[str], measured: str = "") -> dict[str, Reading]:
    """Return what the values of `--column` say of headers: 'R2 (nm)=radius2 [nm]', or 'T (K)=' for no input. Raises BadRequest.

    `measured`: a quantity that columns have besides inputs.
    """
    found: dict[str, Reading] = {}
    for text in texts:
        head, is_pair, meaning = text.rpartition("=")
        head = head.strip()
        if not is_pair or not head:
            raise BadRequest(f"--column: {quoted(text)} is not of the form HEADER=INPUT, as in 'R2 (nm)=radius2 [nm]'")
        reading = read(meaning, {key(measured): measured} if measured else {})
        if meaning.strip() and (not reading.is_input or reading.is_symbol or reading.meant):
            meant = reading.meant[0] if reading.meant else "a name with its unit, as in radius [nm]"
            problem = f": {reading.problem}" if reading.problem else ""
            raise BadRequest(f"--column: {quoted(meaning)} is not an input{problem}; did you mean {meant}?")
        if head in found:
            raise BadRequest(f"--column: {quoted(head)} is given more than once")
        if reading.name and reading.name not in MATERIALS and reading.unit_text is None:
            reading = reading._replace(unit_text=named(head, reading.name)[1])
        found[head] = reading
    return found


# --- What a table says ------------------------------------------------------------------------------------------------


def understood(
    texts: Sequence[str],
    rows: Sequence[Sequence[str]] = (),
    meanings: Mapping[str, Reading] = MappingProxyType({}),
    given: Collection[str] = (),
) -> Header:
    """Return the columns of a header, given the cells of its first rows and what some are said to mean. Raises BadTable.

    `given`: the inputs of options.
    """
    for text in meanings.keys() - {text.strip() for text in texts}:
        guess = closest(text, texts)
        meant = f"; did you mean {quoted(guess)}?" if guess else ""
        raise BadTable(f"--column: the table has no column {quoted(text)}{meant}")
    columns = [[row[place].strip() for row in rows] for place in range(len(texts))]
    readings = [_meaning(text, cells, meanings) for text, cells in zip(texts, columns, strict=True)]
    readings = [_beside(place, readings, texts, meanings, given) for place in range(len(texts))]
    _check_twice(texts, readings)
    names = {reading.name for reading in readings if reading.is_input and reading.part in ("", "low")}
    refused = {place: each for place, each in enumerate(readings) if each.problem and each.name not in names}
    if refused:
        raise _refusal(refused, texts, [*map(_first, columns)])
    inputs = {}
    materials: list[tuple[str, int]] = []
    parts: dict[str, dict[str, Column]] = {}  # the columns of the uncertainty of an input
    for place, reading in enumerate(readings):
        if reading.is_input and reading.name in MATERIALS:
            materials.append((reading.name, place))
        elif reading.is_input and reading.part:
            parts.setdefault(reading.name, {})[reading.part] = _column(place, reading)
        elif reading.is_input:
            inputs[reading.name] = _column(place, reading)
    for name, columns_of_parts in parts.items():
        if column := with_sides(inputs.get(name), columns_of_parts, dict(enumerate(texts)), meanings.keys()):
            inputs[name] = column
    return Header(tuple(texts), tuple(inputs.values()), tuple(materials), meanings)


def _meaning(text: str, cells: Sequence[str], meanings: Mapping[str, Reading]) -> Reading:
    """Return the meaning of a column: that of `--column`, else that of its header, if its cells can be of it."""
    if (stated := meanings.get(text.strip())) is not None:
        return stated
    reading, cell = reading_of(text), _first(cells)
    if reading.is_symbol and not reading.part and not _have_units(cells, reading.name):
        return Reading()
    if key(text) in ("model", "law") and cell.casefold() in LAWS:
        return Reading("model", problem="the law is an option: --model dmt")
    is_unread = reading.problem or not reading.name
    return Reading() if is_unread and cell[:1].isalpha() else reading


def _beside(
    place: int,
    readings: Sequence[Reading],
    texts: Sequence[str],
    meanings: Mapping[str, Reading],
    given: Collection[str],
) -> Reading:
    """Return the meaning of a column in the light of the others. ± alone is of the column at its left."""
    reading = readings[place]
    if texts[place].strip() in meanings:
        return reading
    if reading.part and not reading.name:
        left = readings[place - 1] if place else Reading()
        is_value = left.is_input and not left.part and left.name not in MATERIALS
        is_of_left = is_value and (reading.unit_text in (None, "%") or fits(reading.unit_text, left.name))
        return reading._replace(name=left.name) if is_of_left else Reading()
    if reading.name in ("youngs_modulus", "youngs_modulus2"):
        other = next(filter(_OF_DIRECTIONS.match, texts), "")
        problem = f"{quoted(other)} beside it says that it is the modulus along a direction"
        return reading._replace(problem=problem, meant=()) if other else reading
    is_of_spheres = "radius2" in given or any(each.is_input and each.name == "radius2" for each in readings)
    if reading.is_input and reading.meant and not reading.part and not is_of_spheres:
        return reading._replace(
            problem="R is the radius of a sphere or the reduced radius, half of it for equal spheres"
        )
    return reading


def _check_twice(texts: Sequence[str], readings: Sequence[Reading]) -> None:
    """Raise BadTable for the second column of one meaning, if it has a name."""
    seen: dict[tuple[str, str], str] = {}
    for text, reading in zip(texts, readings, strict=True):
        meaning = (reading.name, reading.part) if reading.is_input else (text, "passes")
        if meaning in seen and text.strip():
            other = seen[meaning]
            both = f"two columns {quoted(text)}" if other == text else f"the columns {quoted(other)} and {quoted(text)}"
            raise BadTable(f"header: {both}, of which one must go")
        seen[meaning] = text


def _refusal(refused: Mapping[int, Reading], texts: Sequence[str], cells: Sequence[str]) -> BadTable:
    """Return the error of columns that may be inputs and cannot be read."""
    problems, remedies = [], []
    for place, reading in refused.items():
        cell = f" (first cell {quoted(cells[place])})" if cells[place] else ""
        problems.append(f"{quoted(texts[place])}{cell}: {reading.problem}")
        remedies.append(" or ".join(_option(texts[place], each) for each in reading.meant or ("",)))
    if len(refused) == 1 and not reading.meant:
        remedies = [f"a column {with_unit(reading.name)} in its place"]
    passing = f", or {_option(texts[place], '')} to pass it through" if len(refused) == 1 else ""
    return BadTable(f"header: {'; '.join(problems)}. Write {' '.join(remedies)}{passing}")


def _option(text: str, meaning: str) -> str:
    """Return the option that says what a column means, in the quotes of a shell."""
    value = shown(f"{text.strip()}={meaning}")
    return f'--column "{value}"' if "'" in value else f"--column '{value}'"


# --- Units and error bars ---------------------------------------------------------------------------------------------


def _column(place: int, reading: Reading) -> Column:
    """Return the column of an input. Without a unit its cells carry their own, or are plain numbers if it is a ratio."""
    name, unit_text = reading.name, reading.unit_text
    if reading.part and unit_text == "%":
        return Column(place, name, "%", None)
    if not unit_text or (unit_text in ("1", "-") and NOMENCLATURE[name].unit == "1"):
        return Column(place, name, "", None)
    return Column(place, name, unit_text, unit_of(unit_text, name))


def check_units(header: Header, rows: Sequence[Sequence[str]]) -> None:
    """Raise BadTable for columns that have a unit neither in their header nor in their first cell; `rows`: the first ones."""
    problems, remedies = [], []
    is_row_of_units = False
    for column in header.inputs:
        first = _first([row[column.place] for row in rows])
        if not first or column.exponent is not None or column.unit is not None or _is_value(first, column.name):
            continue
        unit_text = unit_for(first.strip("[]() "), column.name)
        is_row_of_units |= bool(unit_text)
        parts = {column.place: "", **{side.place: f"_{side.part}" for side in column.sides}}
        for place, part in parts.items():
            text = header.texts[place]
            problems.append(f"{quoted(text)} has no unit, and neither has its first cell {quoted(first)}")
            remedies.append(_option(text, f"{column.name}{part} [{unit_text or 'UNIT'}]"))
    if is_row_of_units:
        raise BadTable(f"header: the first row has units. Delete it, and write {' '.join(remedies)}")
    if problems:
        passing = f", or {_option(text, '')} to pass it through" if len(problems) == 1 else ""
        raise BadTable(f"header: {'; '.join(problems)}. Write {' '.join(remedies)} with its unit{passing}")


def _is_value(cell: str, name: str) -> bool:
    """Return whether a cell says its unit, or is no value at all, which makes a bad row and no bad header."""
    try:
        value_of(cell, name)
    except QuantityError as error:
        return not error.is_bare and not unit_for(cell.strip("[]() "), name)
    return True


def check_inputs(header: Header, measured: str = "") -> None:
    """Raise BadTable for a table of which no column is an input, so that a row says nothing of a contact, or the measured quantity."""
    if measured in header.names or (header.names and not measured):
        return
    if all(map(is_number, header.texts)):
        raise BadTable(f"header: {quoted(header.texts[0])} is a number; begin with a line of the columns' names")
    if not measured:
        raise BadTable(
            "header: no column is an input; a row is a contact, and its inputs have columns such as radius [nm]. "
            f"Write {_option('HEADER', 'INPUT [UNIT]')}"
        )
    synonyms = {key(word): name for word, name in QUANTITY_SYNONYMS.items() if name == measured}
    likely = {text: reading for text in header.texts if (reading := read(text, synonyms)).name == measured}
    text, meaning = next(
        ((text, header_of(measured, reading.unit_text)) for text, reading in likely.items()),
        ("HEADER", f"{measured} [UNIT]"),
    )
    raise BadTable(f"header: no column has the measured {measured}; name it by {_option(text, meaning)}")


def is_input(text: str, meanings: Mapping[str, Reading] = MappingProxyType({})) -> bool:
    """Return whether a header may be that of an input; a symbol without a unit is one if its cells have units."""
    reading = meanings.get(text.strip()) or reading_of(text)
    return reading.is_input or bool(reading.part)


def holds_input(text: str, cell: str, meanings: Mapping[str, Reading]) -> bool:
    """Return whether a header and its cell are those of an input, or may be."""
    return bool(_meaning(text, [cell.strip()], meanings).name)


def _have_units(cells: Sequence[str], name: str) -> bool:
    """Return whether some cell is a value of an input with its unit, or the first is its unit."""
    for cell in dict.fromkeys(cells):
        with suppress(QuantityError):
            if cell and not is_number(cell) and value_of(cell, name) is not None:
                return True
    return fits(_first(cells).strip("[]() "), name)


def _first(cells: Sequence[str]) -> str:
    """Return the first cell that is not empty, or an empty text if there is none."""
    return next(filter(None, map(str.strip, cells)), "")
