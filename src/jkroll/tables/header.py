"""The header of a table: columns of inputs with their units, columns that pass through, and columns that are refused.

`reading` reads each header by itself. This module compares the headers with each other: it finds the input to which
an uncertainty belongs, the columns that repeat an input, and the columns that change the meaning of an input. A header
that is refused because of other headers, or because of its cells, is refused here.
"""

import re
from collections.abc import Callable, Collection, Iterable, Iterator, Mapping, Sequence
from math import nan
from types import MappingProxyType
from typing import NamedTuple

from ..errors import BadRequest, BadTable
from ..quantities.formatting import significant
from ..quantities.laws import MODELS
from ..quantities.nomenclature import CONVERTED, NOMENCLATURE, of_sphere
from ..quantities.nomenclature import header as head_of
from ..quantities.values import NO_UNIT, QuantityError, middle, unit_of, value_of
from ..text import first_of, listed, quoted, shown
from . import words
from .cells import PLUS_MINUS, Column, has_no_value, is_number
from .error_columns import ENDS, with_owners
from .reading import (
    FACTOR,
    UNREAD,
    Reading,
    means_other,
    normalized,
    reading_of,
    splits_of,
    symbol_of,
    unit_in,
    words_in,
)
from .unit_spellings import unit_for
from .unread import NOT_READ, Supply, decided_by, judged
from .words import MATERIALS, headed, key

_NOT_USED = "a value takes one ± column, or a minus and a plus column; a range takes only a low and a high column"
_ROUNDED = 0.4  # largest difference between D/R and 2 that is due to rounding
_MAX_LISTED = 60  # maximum number of columns that a message names
# Elastic constants along single directions, such as G12, nu_xy and E3.
_OF_DIRECTIONS = r"(?i)\s*((G|nu|ν)_?(12|13|23|xy|xz|yz)|E_?3)(?![^\W_])"
_MARKS = {"both": "± ", "minus": "− ", "plus": "+ ", "low": "from ", "high": "to "}
_HEADER_AND_INPUT = r"(.*)(?<!\(k)(?<!\(k )=(.*)"  # the = of (k=2) is part of a header
_SHAPES = (("", "both"), ("", "minus", "plus"), ("",), ENDS)  # the parts whose columns together give one value
_Parts = Mapping[str, Reading]  # the columns of an input by part (see `Reading`); "" for the value
# Kinds of cells. The last is also the problem that a message states.
_VALUE, _UNIT, _NO_UNIT = "value", "unit", "no unit in the header or in the first cell"


class Header(NamedTuple):
    """The columns of a table, as its header gives them."""

    texts: tuple[str, ...]
    inputs: tuple[Column, ...]
    materials: tuple[Column, ...]  # columns with names of materials
    # For a passed column, by its position: the value used instead, as in "ρ is --density 2g/cm3".
    clauses: Mapping[int, str] = MappingProxyType({})

    @property
    def names(self) -> frozenset[str]:
        """The inputs with a column."""
        return frozenset(column.name for column in (*self.materials, *self.inputs))

    @property
    def positions(self) -> dict[str, int]:
        """The position of each column that is read, by name."""
        positions: dict[str, int] = {}
        for column in (*self.inputs, *self.materials):
            positions |= column.positions
        return positions

    def reading(self, *remarks: str) -> str:
        """Return the sentence that says how the table is read, with remarks on its layout."""
        sentence = f"read: {', '.join(map(self._from, (*self.materials, *self.inputs))) or 'no input'}"
        sentence = "; ".join([sentence, *remarks])
        used = {*self.positions.values()}
        passed: dict[str, None] = {}
        for position, text in enumerate(self.texts):
            if position not in used and text.strip():
                passed[_as_shown(text) + self._clause(position)] = None
        if passed:
            sentence += f"; passed through: {first_of([*passed], _MAX_LISTED)}"
        return sentence

    def _clause(self, position: int) -> str:
        return f" ({self.clauses[position]})" if position in self.clauses else ""

    def _from(self, column: Column) -> str:
        """Return the standard header of an input, that in the table if it differs, and those of its uncertainty."""
        text = self.texts[column.position]
        parts = [head_of(column.name, column.unit_text)]
        if not column.is_range and typed(text) not in (parts[0], column.name):
            parts.append(f"from {_as_shown(text)}")
        parts += [f"{_MARKS[part]}{_as_shown(self.texts[position])}" for part, position in column.sides]
        return " ".join(parts)


def typed(text: str) -> str:
    """Return a header as the user would type it: on one line, with ordinary blanks."""
    return shown(" ".join(text.split()))


def _as_shown(text: str) -> str:
    """Return a header as messages show it: in quotes if it is empty, or has a ( or a blank that is not before a [."""
    text = typed(text)
    if text and " " not in text.replace(" [", "[") and "(" not in text:
        return text
    return f'"{text}"'


def stated_meanings(texts: Iterable[str], measured: str = "") -> dict[str, str]:
    """Return the meaning that `--column` gives each header: radius2 [nm] for R2 (nm), or "" for a passed column.

    `texts`: the values of the option, as in 'R2 (nm)=radius2 [nm]'; `measured`: see `reading_of`. Raises BadRequest.
    """
    meanings: dict[str, str] = {}
    for text in texts:
        pair = re.fullmatch(_HEADER_AND_INPUT, text, re.DOTALL)
        if pair is None:
            raise BadRequest(f"--column: {quoted(text)} is not of the form HEADER=INPUT, as in 'R2 (nm)=radius2 [nm]'")
        head, meaning = map(typed, pair.groups())
        reading = reading_of(meaning, measured)
        if meaning and (not reading.is_input or reading.is_symbol or reading.meant):
            problem = f": {reading.problem}" if reading.problem else ""
            raise BadRequest(f"--column: {quoted(meaning)} is not an input{problem}; write one, as in radius [nm]")
        if head in meanings:
            raise BadRequest(f"--column: {quoted(head)} is given more than once")
        meanings[head] = meaning
    return meanings


def understood(
    texts: Sequence[str],
    rows: Sequence[Sequence[str]] = (),
    stated: Mapping[str, str] = MappingProxyType({}),
    given: Collection[str] = (),
    measured: str = "",
    supply_of: Callable[[Collection[str]], Supply] | None = None,
    *,
    pass_rest: bool = False,
) -> Header:
    """Return the meaning of the columns of a table, from their headers and the cells of the first rows.

    `stated`: the meanings that `--column` gives headers; `given`: the inputs given by options; `measured`: see
    `reading_of`; `supply_of`: returns the inputs supplied without a column; `pass_rest`: True to pass columns that
    may be inputs but are not read. Raises BadTable.
    """
    _check_stated(stated, texts)
    readings = []
    for position, text in enumerate(texts):
        readings.append(meaning_of(text, [row[position] for row in rows], stated, measured))
    readings = [*_in_context([*with_owners(readings, given)], given)]
    readings = [reading._replace(position=position) for position, reading in enumerate(readings)]
    inputs = _by_input(readings)
    used = _used_inputs(inputs, rows)
    known = dict.fromkeys(given, "")  # the header of each known input, "" for one given by an option
    values: list[Reading] = []
    for name, parts in used.items():
        known[name] = next(iter(parts.values())).text
        values += [reading for part, reading in parts.items() if part in ("", *ENDS)]
    readings = [_with_suffix(reading, known, measured) for reading in readings]
    held = _held(used, readings)
    clauses: Mapping[str, str] = {}
    if supply_of is not None:
        supply = supply_of(used)
        clauses = supply.clauses
        readings = _judged(readings, rows, supply)
    blocked = _blocked(readings, held, known)
    refused = [] if pass_rest else [*blocked]
    if refused and supply_of is not None:  # judge the other columns as if the refused ones were read
        likeliest = {reading.name for reading in refused if reading.name}
        readings = _judged(readings, rows, supply_of({*used, *likeliest}))
        refused = _blocked(readings, held, known)
    refused += [reading for reading in map(_with_problem, values) if reading.problem]
    refused += [] if pass_rest else _contradicting(inputs, used, rows)
    for name, columns in inputs.items():
        if name in known:
            refused += _unused(columns, used.get(name, {}))
    if refused:
        raise _refusal(sorted(refused, key=lambda reading: reading.position))
    numbers: list[Column] = []
    materials: list[Column] = []
    for name, parts in used.items():
        group = materials if name in MATERIALS else numbers
        group.append(_column(name, parts))
    passed = {reading.position: clauses[reading.name] for reading in blocked if reading.name in clauses}
    return Header(tuple(texts), tuple(numbers), tuple(materials), passed)


def _held(used: Collection[str], readings: Iterable[Reading]) -> set[str]:
    """Return the inputs that columns give or determine, and those that are converted to an input with a column."""
    held = {*used, *decided_by(used)}
    without_part = {reading.name for reading in readings if not reading.part}
    for name, other in CONVERTED.items():
        if other in without_part:
            held.add(name)  # a column of G may pass through if there is one of E
    return held


def _judged(readings: Iterable[Reading], rows: Sequence[Sequence[str]], supply: Supply) -> list[Reading]:
    """Return readings, each with a problem if its column is unread and may be a supplied input."""
    return [judged(reading, [row[reading.position] for row in rows], supply) for reading in readings]


def _check_stated(stated: Iterable[str], texts: Sequence[str]) -> None:
    """Raise BadTable if `--column` names a header that the table does not have."""
    typed_texts = {*map(typed, texts)}
    for text in stated:
        if text not in typed_texts:
            columns_of_table = first_of([*map(_as_shown, texts)], _MAX_LISTED)
            raise BadTable(f"--column: the table has no column {quoted(text)}; it has {columns_of_table}")


def _by_input(readings: Iterable[Reading]) -> dict[str, dict[str, Reading]]:
    """Return the columns of each input by part. Raises BadTable for two columns with the same meaning."""
    inputs: dict[str, dict[str, Reading]] = {}
    for reading in readings:
        if reading.is_input:
            other = inputs.setdefault(reading.name, {}).setdefault(reading.part, reading)
            if other is not reading:
                raise _twice(other, reading)
    return inputs


def _used_inputs(inputs: Mapping[str, _Parts], rows: Sequence[Sequence[str]]) -> dict[str, _Parts]:
    """Return the columns that give the values of each input, without inputs that repeat others. Raises BadTable."""
    used = {}
    for name, columns in inputs.items():
        parts = _used(name, columns)
        if parts:
            used[name] = parts
    return {name: parts for name, parts in used.items() if not _is_doubled(name, used, rows)}


def _unused(columns: _Parts, used: _Parts) -> list[Reading]:
    """Return the columns of an input that do not enter its values, each with the problem that it is not used."""
    unused = [reading for part, reading in columns.items() if part not in used]
    return [reading._replace(problem=_NOT_USED, meant=()) for reading in unused]


def _is_doubled(name: str, used: Mapping[str, _Parts], rows: Sequence[Sequence[str]]) -> bool:
    """Return whether an input may pass because it repeats another, as a diameter repeats a radius or G repeats E.

    An input repeats another if at least one of the first rows has it, and every such row also has the other input. A
    column given by `--column` is always read.
    """
    parts, others = used[name], used.get(CONVERTED.get(name, ""), {})
    if not others or any(reading.is_stated for reading in parts.values()):
        return False
    positions = [reading.position for reading in parts.values()]
    other_positions = [reading.position for reading in others.values()]
    filled = [row for row in rows if not _are_empty(row, positions)]
    return bool(filled) and not any(_are_empty(row, other_positions) for row in filled)


def _contradicting(inputs: Mapping[str, _Parts], used: Collection[str], rows: Sequence[Sequence[str]]) -> list[Reading]:
    """Return the columns of diameters that repeat a radius, but in some row are not twice the radius."""
    contradicting = []
    for name in ("diameter", "diameter2"):
        diameter = inputs.get(name, {}).get("")
        radius = inputs.get(CONVERTED[name], {}).get("")
        if name in used or diameter is None or radius is None:
            continue
        ratios = [_value_in(row, diameter) / _value_in(row, radius) for row in rows]
        others = [ratio for ratio in ratios if abs(ratio - 2) > _ROUNDED]
        if others:
            times = f"in a row it is {significant(others[0], 3)} times {quoted(radius.text)}, not twice"
            problem = f"{times}; to read it, write {option_of(radius.text, '')}"
            contradicting.append(diameter._replace(problem=problem, part=UNREAD))
    return contradicting


def _value_in(row: Sequence[str], reading: Reading) -> float:
    """Return the value of an input in a row, without its uncertainty; nan for a cell that is not a value."""
    try:
        return float(middle(_column(reading.name, {"": reading}).value(row[reading.position])))
    except QuantityError:
        return nan


def _are_empty(row: Sequence[str], positions: Iterable[int]) -> bool:
    """Return whether the cells of a row at these positions have no value."""
    return all(has_no_value(row[position]) for position in positions)


def _with_suffix(reading: Reading, known: Mapping[str, str], measured: str) -> Reading:
    """Return the reading, with a problem if unread text follows the name or the symbol of a known input.

    `known`: the header of each known input, "" for one given by an option.
    """
    is_of_direction = re.match(_OF_DIRECTIONS, reading.text) is not None
    if reading.is_input or reading.part or reading.is_stated or is_of_direction or reading.cell[:1].isalpha():
        return reading
    for split in splits_of(normalized(reading.text)):
        if key(split.word) in words.meanings(measured):
            meaning = words.meanings(measured)[key(split.word)]
            if not meaning.names:
                return reading  # another quantity
            names = [name for name in meaning.names if name in known and not meaning.problem]
        else:
            symbol = "" if split.is_explicit else symbol_of(split.word)
            names = _with_symbol(symbol, known) if symbol else []
        if names and split.unit and not means_other(split, names[0]):
            of_word = f"the text after {quoted(split.word)} is not read"
            problem = reading.problem if reading.name == names[0] else of_word
            return reading._replace(name=names[0], part=UNREAD, problem=problem, meant=())
    return reading


def _with_symbol(symbol: str, known: Mapping[str, str]) -> list[str]:
    """Return the known inputs whose headers contain this symbol."""
    names = []
    for name, text in known.items():
        if symbol in map(symbol_of, words_in(text)):
            names.append(name)
    return names


def _blocked(readings: Iterable[Reading], held: Collection[str], known: Collection[str]) -> list[Reading]:
    """Return the columns with a problem that may not pass through; `held`, `known`: see `_may_pass`."""
    return [reading for reading in readings if reading.problem and not _may_pass(reading, held, known)]


def _may_pass(reading: Reading, held: Collection[str], known: Collection[str]) -> bool:
    """Return whether a column with a problem may pass through, since other columns or options give its inputs.

    Its likeliest input must be in `held`, the inputs that columns give or determine. Its other possible inputs must be
    in `held` or in `known`, the inputs with columns or options. A column that changes the meaning of a value must not
    pass.
    """
    return reading.name in held and reading.part != UNREAD and {*reading.names} <= {*held, *known}


def _twice(first: Reading, second: Reading) -> BadTable:
    """Return the error for two columns that mean the same."""
    problem = f"header: the columns {quoted(first.text)} and {quoted(second.text)} mean the same"
    if typed(first.text) == typed(second.text):
        return BadTable(f"{problem}: rename one")
    options = " or ".join(option_of(reading.text, "") for reading in (second, first))
    twin = NOMENCLATURE[first.name].twin
    of_2 = f", or {option_of(first.text, headed(twin, first.unit_text))} if it is of sphere 2" if twin else ""
    return BadTable(f"{problem}. Write {options} to pass one through{of_2}")


def meaning_of(text: str, cells: Sequence[str], stated: Mapping[str, str], measured: str) -> Reading:
    """Return the meaning of a column from `--column`, or else from its header if the cells do not contradict it.

    `stated`: the meanings that `--column` gives headers; `measured`: see `reading_of`.
    """
    cells = [cell.strip() for cell in cells if not has_no_value(cell)]
    cell = cells[0] if cells else ""
    mark = PLUS_MINUS.match(cell)
    head = mark[0] if mark and not normalized(text) else text  # cells such as ±5 need no header
    reading = reading_of(stated.get(typed(text), head), measured)._replace(is_stated=typed(text) in stated)
    if reading.is_symbol and not reading.part:
        kinds = {_kind(each, reading.name) for each in dict.fromkeys(cells) if not is_number(each)}
        if kinds.isdisjoint((_VALUE, _UNIT)):
            reading = Reading()
    elif is_law(text) and cell.casefold() in MODELS and not reading.is_stated:
        reading = Reading(problem=f"the law is an option: --model {cell.casefold()}")
    elif cell[:1].isalpha() and not reading.is_input and not reading.is_stated:
        reading = Reading()
    return reading._replace(text=text, cell=cell)


def _kind(cell: str, name: str) -> str:
    """Return the kind of a cell of an input: a value, a number that lacks its unit, a unit, or "" for other text."""
    try:
        value_of(cell, name)
    except QuantityError as error:
        if error.mistake == NO_UNIT:
            return _NO_UNIT
        return _UNIT if unit_for(cell.strip("[]() "), name) else ""
    return _VALUE


def _with_problem(reading: Reading) -> Reading:
    """Return the reading of an input, with a problem if header and first cell lack a unit, or the cell is only a unit.

    Ratios need no unit; but a humidity above 1 is a percentage, and needs %.
    """
    if reading.name == "humidity" and not reading.unit_text and is_number(reading.cell) and float(reading.cell) > 1:
        return reading._replace(problem=_NO_UNIT, meant=["humidity [%]"])
    if not reading.cell or reading.unit_text or NOMENCLATURE[reading.name].unit in ("", "1"):
        return reading
    kind = _kind(reading.cell, reading.name)
    if kind not in (_NO_UNIT, _UNIT):
        return reading
    part = f"_{reading.part}" if reading.part else ""
    meant = f"{reading.name}{part} [{unit_for(reading.cell.strip('[]() '), reading.name) or 'UNIT'}]"
    return reading._replace(problem=kind, meant=[meant])


def _in_context(readings: Sequence[Reading], given: Collection[str]) -> Iterator[Reading]:
    """Iterate over readings, each revised in view of the other headers of the table."""
    names = {*given, *(reading.name for reading in readings if reading.is_input)}
    is_of_two = not names.isdisjoint(("radius2", "diameter2"))
    is_of_water = "humidity" in names and "contact_angle" not in names
    moduli = [reading for reading in readings if of_sphere(1, reading.name) in ("youngs_modulus", "shear_modulus")]
    directional = []
    if moduli:
        directional = [reading.text for reading in readings if re.match(_OF_DIRECTIONS, reading.text)]
    for reading in readings:
        if reading.part:
            yield reading
        elif directional and reading in moduli and not reading.is_stated:
            problem = f"with {quoted(directional[0])} in the table it may be a modulus along one direction"
            yield reading._replace(problem=problem, meant=())
        elif reading.name == "rolling_angle" and is_of_water and not reading.is_stated and _is_any_angle(reading.text):
            angles = [headed(name, reading.unit_text or "UNIT") for name in ("contact_angle", "rolling_angle")]
            yield reading._replace(problem="with a humidity it may be the contact angle of water", meant=angles)
        elif reading.is_input and reading.meant and not is_of_two:
            yield reading._replace(problem="R may be the radius of a sphere or the reduced radius")
        else:
            yield reading


def _is_any_angle(text: str) -> bool:
    """Return whether a header names an angle without saying which, as θ does."""
    return words.tokens_of(text)[:1] in (["theta"], ["angle"])


def _used(name: str, columns: _Parts) -> _Parts:
    """Return the columns of an input that together give its values; no columns if the value is missing.

    Raises BadTable for half a range, and for an unused column that `--column` gives.
    """
    shape = next((shape for shape in _SHAPES if columns.keys() >= {*shape}), ())
    others = [reading for part, reading in columns.items() if part not in shape]
    is_half_range = not shape and not columns.keys().isdisjoint(ENDS)
    if is_half_range or any(reading.is_stated for reading in others):
        raise BadTable(f"header: {quoted(others[0].text)} does not complete an uncertainty of {name}: {_NOT_USED}")
    return {part: columns[part] for part in shape}


def _column(name: str, parts: _Parts) -> Column:
    """Return the column of an input. Raises BadTable if the units or the coverage factors of its parts differ.

    Only a ± column may have a unit of its own.

    In a column without a unit, each cell states its own unit, or the input is a ratio.
    """
    of_ratio = ("1", "-") if NOMENCLATURE[name].unit == "1" else ()
    units: dict[str, str] = {}
    factors: set[float] = set()
    sides = []
    for part, reading in parts.items():
        units[part] = "" if reading.unit_text in of_ratio else reading.unit_text
        if part:
            factors.add(reading.coverage)
            sides.append((part, reading.position))
    error_unit = units.pop("both", "")
    unit_text = next(filter(None, units.values()), "")
    if not {*units.values()} <= {"", unit_text} or len(factors) > 1:
        columns = listed(quoted(reading.text) for reading in parts.values())
        subject = "coverage factor" if len(factors) > 1 else "unit"
        raise BadTable(f"header: the columns {columns} must have the same {subject}")
    unit = unit_of(unit_text, name) if unit_text else None
    first = next(iter(parts.values()))
    error_unit = error_unit if error_unit != unit_text else ""
    return Column(first.position, name, unit_text, unit, tuple(sides), error_unit, max(factors, default=1.0))


# --- Refused columns --------------------------------------------------------------------------------------------------


def _refusal(readings: Sequence[Reading]) -> BadTable:
    """Return the error for columns that may be inputs but cannot be read."""
    ways = [*filter(None, map(_way, readings))]
    if any(reading.problem == _UNIT for reading in readings):
        problem = "header: the row below holds units, not values"
        return BadTable(f"{problem}. Delete that row, and write {' '.join(ways)}")
    texts: dict[str, list[str]] = {}  # by problem
    for reading in readings:
        cell = f" (first cell {quoted(reading.cell)})" if reading.cell else ""
        texts.setdefault(reading.problem, []).append(f"{quoted(reading.text)}{cell}")
    problems = [f"{listed(headers)}: {problem}" for problem, headers in texts.items()]
    options = " ".join([option_of(reading.text, "") for reading in readings])
    if len(readings) > 1:
        passing = f"{options} to pass them through (--pass-rest passes all unread columns)"
    else:
        passing = f"{options} to pass it through"
    can_be_joined = all(len(reading.meant) < 2 for reading in readings)  # all options can be given together
    ways_in_words = (" " if can_be_joined else "; ").join(ways)
    remedies = ", or ".join(filter(None, [ways_in_words, passing]))
    return BadTable(f"header: {'; '.join(problems)}. Write {remedies}")


def _way(reading: Reading) -> str:
    """Return the options or the header to write for a column that may be an input; "" if there is none to suggest."""
    if reading.meant:
        return " or ".join(option_of(reading.text, meant) for meant in reading.meant)
    if not reading.name or reading.part or reading.problem == FACTOR or reading.problem.startswith(NOT_READ):
        return ""
    return f"a column {' or '.join(map(headed, reading.names or [reading.name]))} instead of {quoted(reading.text)}"


def option_of(text: str, meaning: str) -> str:
    """Return the option that gives a header its meaning, quoted for a shell."""
    value = f"{typed(text)}={meaning}"
    if "'" not in value:
        return f"--column '{value}'"
    escaped = re.sub(r'([\\$`"])', r"\\\1", value)
    return f'--column "{escaped}"'


def check_inputs(header: Header, measured: str = "") -> None:
    """Raise BadTable for a table without an input column, or without the measured quantity."""
    if measured in header.names or (header.names and not measured):
        return
    check_has_names(header)
    if measured:
        options = []
        used = {*header.positions.values()}
        for position, text in enumerate(header.texts):
            unit = unit_in(text, measured)
            if unit and position not in used:
                options.append(option_of(text, headed(measured, unit)))
        table = "" if options else f" (the table has {first_of([*map(_as_shown, header.texts)], _MAX_LISTED)})"
        ways = listed(options or [option_of("HEADER", headed(measured))], "or")
        raise BadTable(f"header: no column has the measured {measured}{table}; write {ways}")
    raise BadTable(
        "header: no column is an input; a row is a contact, and its inputs have columns such as radius [nm]. "
        f"Write {option_of('HEADER', 'INPUT [UNIT]')}"
    )


def check_has_names(header: Header) -> None:
    """Raise BadTable for a table whose header has only numbers."""
    if header.texts and all(map(is_number, header.texts)):
        number = quoted(header.texts[0])
        raise BadTable(f"the header is missing: {number} is a number; begin with a line of the columns' names")


def is_law(text: str) -> bool:
    """Return whether a header names a column of laws."""
    return key(text) in ("model", "law")


def is_input(text: str, measured: str = "") -> bool:
    """Return whether a column with this header may be read as an input, or as part of an uncertainty."""
    reading = reading_of(text, measured)
    return reading.is_input or bool(reading.part)
