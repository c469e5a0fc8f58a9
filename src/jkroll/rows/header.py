"""The header of a table: the columns that are inputs, with their units, those that pass through, what is refused."""

import re
from collections.abc import Collection, Iterable, Mapping, Sequence
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
from .readings import Reading, named, read, reading_of
from .words import MATERIALS, fits, key, unit_for, with_unit

_MAX_SAID = 60  # columns that pass through and are named
_OF_DIRECTIONS = r"(?i)\s*(G|nu|ν)_?(12|13|23|xy|xz|yz)(?![^\W_])"
_MARKS = {"both": "± ", "minus": "− ", "plus": "+ ", "low": "from ", "high": "to "}
_ENDS = ("low", "high")
_SHAPES = (
    ("", "both"),
    ("", "minus", "plus"),
    ("",),
    _ENDS,
)  # of the columns of a value, by the part of its uncertainty
_VALUE, _BARE, _UNIT = "value", "bare number", "unit"  # kinds of cells
_NO_UNIT = "has no unit, and neither has its first cell"
_NO_MEANINGS: Mapping[str, Reading] = MappingProxyType({})


class Header(NamedTuple):
    """The columns of a table."""

    texts: tuple[str, ...]
    inputs: tuple[Column, ...]
    materials: tuple[tuple[str, int], ...]  # name and place of the columns that name materials
    meanings: Mapping[str, Reading] = _NO_MEANINGS  # what `--column` says of headers
    preamble: int = 0  # lines before the header that are passed over

    @property
    def names(self) -> frozenset[str]:
        """The names of the inputs that have columns."""
        return frozenset({column.name for column in self.inputs} | {name for name, _ in self.materials})

    @property
    def places(self) -> dict[str, int]:
        """The places of the columns that are read."""
        return {name: place for column in self.inputs for name, place in column.places.items()} | dict(self.materials)

    def reading(self) -> str:
        """Return the sentence that says how the table is read."""
        read_columns = [self._from(name, {"": place}) for name, place in self.materials]
        for column in self.inputs:
            places = dict(column.sides) if column.is_range else {"": column.place, **column.sides}
            read_columns.append(self._from(header_of(column.name, column.unit_text), places))
        sentence = f"read: {', '.join(read_columns) or 'no input'}"
        if self.preamble:
            lines = "a line" if self.preamble == 1 else f"{self.preamble} lines"
            sentence += f"; passed over: {lines} before the header"
        others = [text for place, text in enumerate(self.texts) if place not in self.places.values() and text.strip()]
        if others:
            count = f"{len(others)} columns: " if len(others) > _MAX_SAID else ""
            sentence += f"; passed through: {count}{first_of([*map(_easy, dict.fromkeys(others))], _MAX_SAID)}"
        return sentence

    def _from(self, head: str, places: Mapping[str, int]) -> str:
        """Return the header of an input with those that it is read from, if they are others; `places`: by the part."""
        texts = {part: self.texts[place] for part, place in places.items()}
        value = texts.pop("", head)
        is_same = value.strip() in (head, head.partition(" [")[0])
        sources = [f"{_MARKS[part]}{_easy(text)}" for part, text in texts.items()]
        return " ".join([head, *([] if is_same else [f"from {_easy(value)}"]), *sources])


def _easy(text: str) -> str:
    """Return a header, in quotes if it has blanks besides that before a unit in brackets."""
    return shown(text) if " " not in text.strip().replace(" [", "[") and "(" not in text else f'"{shown(text)}"'


# --- What options say of columns --------------------------------------------------------------------------------------


def stated_meanings(names: Iterable[str], texts: Iterable[str], measured: str = "") -> dict[str, Reading]:
    """Return the meaning of the columns that options name, and of those of their uncertainties."""
    chosen = column_options(texts, measured)
    more = {key(word): measured for word in (measured, NOMENCLATURE[measured].symbol)} if measured else {}
    more |= {named(head, each.name)[0]: each.name for head, each in chosen.items() if each.name and not each.part}
    for head in map(str.strip, names) if more else ():
        reading = read(head, more)
        if reading.is_input and (reading.name == measured or (reading.part and not reading_of(head).is_input)):
            chosen.setdefault(head, reading)
    return chosen


def column_options(texts: Iterable[str], measured: str = "") -> dict[str, Reading]:
    """Return what the values of `--column` say of headers: 'R2 (nm)=radius2 [nm]', or 'T (K)=' for no input.

    `measured`: a quantity that columns have besides inputs. Raises BadRequest.
    """
    meanings: dict[str, Reading] = {}
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
        if head in meanings:
            raise BadRequest(f"--column: {quoted(head)} is given more than once")
        if reading.name and reading.name not in MATERIALS and reading.unit_text is None:
            reading = reading._replace(unit_text=named(head, reading.name)[1])
        meanings[head] = reading
    return meanings


# --- What a table says ------------------------------------------------------------------------------------------------


class _Head(NamedTuple):
    """The head of a column: its place, its text, the first cell below it that is not empty, and its meaning."""

    place: int
    text: str
    cell: str
    reading: Reading


def understood(
    texts: Sequence[str],
    rows: Sequence[Sequence[str]] = (),
    meanings: Mapping[str, Reading] = _NO_MEANINGS,
    given: Collection[str] = (),
) -> Header:
    """Return the columns of a header, given the cells of its first rows and what some are said to mean.

    `given`: the inputs of options. Raises BadTable.
    """
    for text in meanings.keys() - {text.strip() for text in texts}:
        guess = closest(text, texts)
        meant = f"; did you mean {quoted(guess)}?" if guess else ""
        raise BadTable(f"--column: the table has no column {quoted(text)}{meant}")
    heads = []
    for place, text in enumerate(texts):
        cells = [row[place].strip() for row in rows]
        heads.append(_Head(place, text, next(filter(None, cells), ""), _meaning(text, cells, meanings)))
    is_of_two = "radius2" in given or any(head.reading.is_input and head.reading.name == "radius2" for head in heads)
    heads = [_among(head, heads, meanings, is_of_two=is_of_two) for head in heads]
    parts: dict[str, dict[str, _Head]] = {}  # of inputs, by the part of the uncertainty, "" for the values
    for head in heads:
        reading = head.reading
        name, part = (reading.name, reading.part) if reading.is_input else ("", head.text)
        other = parts.setdefault(name, {}).setdefault(part, head)
        if other is not head and head.text.strip():
            both = f"the columns {quoted(other.text)} and {quoted(head.text)}"
            both = f"two columns {quoted(head.text)}" if other.text == head.text else both
            raise BadTable(f"header: {both}, of which one must go")
    parts.pop("", None)
    known = {name for name, of_name in parts.items() if not {"", "low"}.isdisjoint(of_name)}
    refused = [head for head in heads if head.reading.problem and head.reading.name not in known]
    for of_name in parts.values():
        needed = [of_name[part] for part in ([""] if "" in of_name else _ENDS) if part in of_name]
        refused += [head for head in map(_without_unit, needed) if head.reading.problem]
    if refused:
        raise _refusal(sorted(refused))
    materials = tuple((name, parts.pop(name)[""].place) for name in [*parts] if name in MATERIALS)
    inputs = filter(None, (_column(of_name, meanings.keys()) for of_name in parts.values()))
    return Header(tuple(texts), tuple(inputs), materials, meanings)


def _meaning(text: str, cells: Sequence[str], meanings: Mapping[str, Reading]) -> Reading:
    """Return the meaning of a column: that of `--column`, else that of its header, if its cells can be of it."""
    if (stated := meanings.get(text.strip())) is not None:
        return stated
    reading, cell = reading_of(text), next(filter(None, cells), "")
    if reading.is_symbol and not reading.part:
        kinds = (_kind(each, reading.name) for each in dict.fromkeys(cells) if not is_number(each))
        return reading if any(kind in (_VALUE, _UNIT) for kind in kinds) else Reading()
    if key(text) in ("model", "law") and cell.casefold() in LAWS:
        return Reading("model", problem="the law is an option: --model dmt")
    is_unread = reading.problem or not reading.name
    return Reading() if is_unread and cell[:1].isalpha() else reading


def _kind(cell: str, name: str) -> str:
    """Return the kind of a cell of an input: a value, a number that lacks a unit, a unit, or "" for no such."""
    try:
        value_of(cell, name)
    except QuantityError as error:
        is_unit = not error.is_bare and unit_for(cell.strip("[]() "), name)
        return _UNIT if is_unit else _BARE if error.is_bare else ""
    return _VALUE


def _among(head: _Head, heads: Sequence[_Head], stated: Collection[str], *, is_of_two: bool) -> _Head:
    """Return a head in the light of the others. ± alone is of the column at its left.

    `stated`: the headers that options name; `is_of_two`: whether sphere 2 has a radius of its own.
    """
    reading = head.reading
    if head.text.strip() in stated:
        return head
    if reading.part and not reading.name:
        left = heads[head.place - 1].reading if head.place else Reading()
        is_value = left.is_input and not left.part and left.name not in MATERIALS
        is_of_left = is_value and (reading.unit_text in (None, "%") or fits(reading.unit_text, left.name))
        return head._replace(reading=reading._replace(name=left.name) if is_of_left else Reading())
    is_modulus = reading.name in ("youngs_modulus", "youngs_modulus2")
    if other := next((other for other in heads if is_modulus and re.match(_OF_DIRECTIONS, other.text)), None):
        problem = f"{quoted(other.text)} beside it says that it is the modulus along a direction"
        return head._replace(reading=reading._replace(problem=problem, meant=()))
    if reading.is_input and reading.meant and not reading.part and not is_of_two:
        problem = "R is the radius of a sphere or the reduced radius, half of it for equal spheres"
        return head._replace(reading=reading._replace(problem=problem))
    return head


def _column(parts: Mapping[str, _Head], stated: Collection[str]) -> Column | None:
    """Return the column of an input with those of its uncertainty; None if they make none and pass through.

    `parts`: by the part of the uncertainty, "" for the values; `stated`: the headers that options name. Without a unit
    cells carry their own, or they are plain numbers of a ratio. Raises BadTable.
    """
    shapes = [shape for shape in _SHAPES if parts.keys() >= {*shape}]
    used = shapes[0] if shapes else ()
    name = next(iter(parts.values())).reading.name
    left = [head.text for part, head in parts.items() if part not in used]
    if {*_SHAPES[:2]} <= {*shapes}:
        first, second = (quoted(parts[part].text) for part in ("both", "minus"))
        raise BadTable(f"header: {first} and {second} are both uncertainties of {name}; one must go")
    if left and (any(text.strip() in stated for text in left) or ("" not in parts and parts.keys() & {*_ENDS})):
        raise BadTable(
            f"header: {quoted(left[0])} alone is no uncertainty of {name}: values have a column of ± beside them, or "
            "two, of minus and plus; a range has low and high alone"
        )
    if not used:
        return None
    of_ratio = ("1", "-") if NOMENCLATURE[name].unit == "1" else ()
    units = {part: parts[part].reading.unit_text or "" for part in used}
    units = {part: "" if unit_text in of_ratio else unit_text for part, unit_text in units.items()}
    unit_text = units[used[0]] or (units["high"] if used == _ENDS else "")
    for part in used:
        if part != "both" and units[part] not in ("", unit_text):
            other = f", {unit_text}" if unit_text else "; that has none"
            raise BadTable(f"header: {quoted(parts[part].text)}: its unit must be that of the other column{other}")
    unit = unit_of(unit_text, name) if unit_text else None
    sides = {part: parts[part].place for part in used if part}
    error_unit = units.get("both", "")
    error_unit = "" if error_unit == unit_text else error_unit
    return Column(parts[used[0]].place, name, unit_text, unit, sides, error_unit)


# --- What is refused --------------------------------------------------------------------------------------------------


def _without_unit(head: _Head) -> _Head:
    """Return the head of an input, with a problem if neither it nor its first cell has the unit that it needs."""
    _, _, cell, reading = head
    name, part = reading.name, reading.part
    if not cell or reading.unit_text or name in MATERIALS or NOMENCLATURE[name].unit == "1":
        return head
    unit_text = unit_for(cell.strip("[]() "), name)
    meant = (f"{name}{'_' if part else ''}{part} [{unit_text or 'UNIT'}]",)
    problem = {_BARE: _NO_UNIT, _UNIT: _UNIT}.get(_kind(cell, name), "")
    return head._replace(reading=reading._replace(problem=problem, meant=meant))


def _refusal(heads: Sequence[_Head]) -> BadTable:
    """Return the error of columns that may be inputs and cannot be read."""
    problems, remedies, tail = [], [], ""
    for _, text, cell, reading in heads:
        remedies.append(" or ".join(_option(text, meant) for meant in reading.meant or ("",)))
        if reading.problem == _NO_UNIT:
            tail = " with its unit"
            problems.append(f"{quoted(text)} {_NO_UNIT} {quoted(cell)}")
        else:
            first = f" (first cell {quoted(cell)})" if cell else ""
            problems.append(f"{quoted(text)}{first}: {reading.problem}")
    if any(head.reading.problem == _UNIT for head in heads):
        return BadTable(f"header: the first row has units. Delete it, and write {' '.join(remedies)}")
    if len(heads) == 1 and not reading.meant:
        remedies = [f"a column {with_unit(reading.name)} in its place"]
    passing = f", or {_option(text, '')} to pass it through" if len(heads) == 1 else ""
    return BadTable(f"header: {'; '.join(problems)}. Write {' '.join(remedies)}{tail}{passing}")


def _option(text: str, meaning: str) -> str:
    """Return the option that says what a column means, in the quotes of a shell."""
    value = shown(f"{text.strip()}={meaning}")
    return f'--column "{value}"' if "'" in value else f"--column '{value}'"


def check_inputs(header: Header, measured: str = "") -> None:
    """Raise BadTable for a table of which no column is an input, or none the measured quantity.

    Its rows say nothing of a contact.
    """
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
    likely = [(text, reading.unit_text) for text in header.texts if (reading := read(text, synonyms)).name == measured]
    text, unit_text = likely[0] if likely else ("HEADER", "UNIT")
    option = _option(text, header_of(measured, unit_text))
    raise BadTable(f"header: no column has the measured {measured}; name it by {option}")


def is_input(text: str, meanings: Mapping[str, Reading] = _NO_MEANINGS) -> bool:
    """Return whether a header may be that of an input; a symbol without a unit is one if its cells have units."""
    reading = meanings.get(text.strip()) or reading_of(text)
    return reading.is_input or bool(reading.part)


def holds_input(text: str, cell: str, meanings: Mapping[str, Reading]) -> bool:
    """Return whether a header and its cell are those of an input, or may be."""
    return bool(_meaning(text, [cell.strip()], meanings).name)
