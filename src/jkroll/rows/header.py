"""The header of a table: the columns that are inputs, with their units, those that pass through, what is refused."""

import re
from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from types import MappingProxyType
from typing import Any, NamedTuple

from ..errors import BadRequest, BadTable
from ..quantities.errors import QUANTITY_SYNONYMS, QuantityError
from ..quantities.laws import LAWS
from ..quantities.nomenclature import NOMENCLATURE
from ..quantities.nomenclature import header as header_of
from ..quantities.values import unit_of, value_of
from ..text import closest, first_of, quoted, shown
from .cells import Column, is_number
from .readings import Reading, named, reading_of
from .words import MATERIALS, fits, key, unit_for, with_unit

_MAX_SAID = 60  # columns that pass through and are named
_OF_DIRECTIONS = r"(?i)\s*(G|nu|ν)_?(12|13|23|xy|xz|yz)(?![^\W_])"
_MARKS = {"both": "± ", "minus": "− ", "plus": "+ ", "low": "from ", "high": "to "}
_ENDS = ("low", "high")
_SHAPES = (("", "both"), ("", "minus", "plus"), ("",), _ENDS)  # of the columns of a value, by part
_VALUE, _UNIT, _NO_UNIT = "value", "unit", "has no unit, and neither has its first cell"  # kinds of cells
_NO_MEANINGS: Mapping[str, Reading] = MappingProxyType({})


class Header(NamedTuple):
    """The columns of a table."""

    texts: tuple[str, ...]
    inputs: tuple[Column, ...]
    materials: tuple[Column, ...]  # that name them
    meanings: Mapping[str, Reading] = _NO_MEANINGS  # what `--column` says of headers
    preamble: int = 0  # lines before the header that are passed over

    @property
    def names(self) -> frozenset[str]:
        """The names of the inputs that have columns."""
        return frozenset(column.name for column in (*self.materials, *self.inputs))

    @property
    def places(self) -> dict[str, int]:
        """The places of the columns that are read."""
        return {name: place for column in (*self.inputs, *self.materials) for name, place in column.places.items()}

    def reading(self) -> str:
        """Return the sentence that says how the table is read."""
        sentence = f"read: {', '.join(map(self._from, (*self.materials, *self.inputs))) or 'no input'}"
        if self.preamble:
            lines = "a line" if self.preamble == 1 else f"{self.preamble} lines"
            sentence += f"; passed over: {lines} before the header"
        used = {*self.places.values()}
        others = [text for place, text in enumerate(self.texts) if place not in used and text.strip()]
        if others:
            count = f"{len(others)} columns: " if len(others) > _MAX_SAID else ""
            sentence += f"; passed through: {count}{first_of([*map(_easy, dict.fromkeys(others))], _MAX_SAID)}"
        return sentence

    def _from(self, column: Column) -> str:
        """Return the header of an input with those that it is read from, if they are others."""
        head, text = header_of(column.name, column.unit_text), self.texts[column.place]
        is_same = column.is_range or text.strip() in (head, column.name)
        sources = [f"{_MARKS[part]}{_easy(self.texts[place])}" for part, place in column.sides.items()]
        return " ".join([head, *([] if is_same else [f"from {_easy(text)}"]), *sources])


def _easy(text: str) -> str:
    """Return a header, in quotes if it has blanks besides that before a unit in brackets."""
    return shown(text) if " " not in text.strip().replace(" [", "[") and "(" not in text else f'"{shown(text)}"'


# --- What options say of columns --------------------------------------------------------------------------------------


def stated_meanings(texts: Iterable[str], names: Iterable[str] = (), measured: str = "") -> dict[str, Reading]:
    """Return what the values of `--column` say of headers: 'R2 (nm)=radius2 [nm]', or 'T (K)=' for no input.

    `names`: the headers of a table, among which the columns of uncertainties of what is said are said, too. `measured`:
    a quantity that columns have besides inputs. Raises BadRequest.
    """
    symbol = NOMENCLATURE[measured].symbol if measured else ""
    words = {word: measured for word in (key(measured), key(symbol)) if word}
    of_measured = tuple(words.items())
    meanings: dict[str, Reading] = {}
    for text in texts:
        head, is_pair, meaning = text.rpartition("=")
        head = head.strip()
        if not is_pair or not head:
            raise BadRequest(f"--column: {quoted(text)} is not of the form HEADER=INPUT, as in 'R2 (nm)=radius2 [nm]'")
        reading = reading_of(meaning, of_measured)
        if meaning.strip() and (not reading.is_input or reading.is_symbol or reading.meant):
            meant = reading.meant[0] if reading.meant else "a name with its unit, as in radius [nm]"
            problem = f": {reading.problem}" if reading.problem else ""
            raise BadRequest(f"--column: {quoted(meaning)} is not an input{problem}; did you mean {meant}?")
        if head in meanings:
            raise BadRequest(f"--column: {quoted(head)} is given more than once")
        word, unit_text = named(head, reading.name) if reading.name else ("", "")
        meanings[head] = reading._replace(unit_text=reading.unit_text or unit_text)
        words |= {word: reading.name} if word and not reading.part else {}
    for head in map(str.strip, names) if words else ():
        reading = reading_of(head, tuple(words.items()))
        if reading.is_input and (reading.name == measured or (reading.part and not reading_of(head).is_input)):
            meanings.setdefault(head, reading)
    return meanings


# --- What a table says ------------------------------------------------------------------------------------------------


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
        first = next(filter(None, cells), "")
        heads.append(meaning_of(text, cells, meanings)._replace(place=place, text=text, cell=first))
    heads = [*_beside_others(heads, meanings.keys(), given)]
    parts: dict[str, dict[str, Reading]] = {}  # of inputs, by the part of the uncertainty, "" for the values
    for head in heads:
        name, part = (head.name, head.part) if head.is_input else ("", head.text)
        other = parts.setdefault(name, {}).setdefault(part, head)
        if other is not head and head.text.strip():
            both = "two columns" if other.text == head.text else f"the columns {quoted(other.text)} and"
            raise BadTable(f"header: {both} {quoted(head.text)}, of which one must go")
    parts.pop("", None)
    known = {name for name, of_name in parts.items() if not {"", "low"}.isdisjoint(of_name)}
    refused = [head for head in heads if head.problem and head.name not in known]
    for of_name in parts.values():
        values = [head for part, head in of_name.items() if part == "" or (part in _ENDS and "" not in of_name)]
        refused += [head for head in map(_with_unit, values) if head.problem]
    if refused:
        raise _refusal(sorted(refused, key=lambda head: head.place))
    columns = [*filter(None, (_column(of_name, meanings.keys()) for of_name in parts.values()))]
    inputs = tuple(column for column in columns if column.name not in MATERIALS)
    materials = tuple(column for column in columns if column.name in MATERIALS)
    return Header(tuple(texts), inputs, materials, meanings)


def meaning_of(text: str, cells: Sequence[str], meanings: Mapping[str, Reading]) -> Reading:
    """Return the meaning of a column: that of `--column`, else that of its header, if its cells can be of it."""
    if (stated := meanings.get(text.strip())) is not None:
        return stated
    reading, cell = reading_of(text), next(filter(None, cells), "")
    if reading.is_symbol and not reading.part:
        kinds = {_kind(each, reading.name) for each in dict.fromkeys(cells) if not is_number(each)}
        return Reading() if kinds.isdisjoint((_VALUE, _UNIT)) else reading
    if key(text) in ("model", "law") and cell.casefold() in LAWS:
        return Reading(problem=f"the law is an option: --model {cell.casefold()}")
    return reading if reading.is_input or not cell[:1].isalpha() else Reading()


def _kind(cell: str, name: str) -> str:
    """Return the kind of a cell of an input: a value, a number that lacks a unit, a unit, or "" for no such."""
    try:
        value_of(cell, name)
    except QuantityError as error:
        return _NO_UNIT if error.is_bare else _UNIT if unit_for(cell.strip("[]() "), name) else ""
    return _VALUE


def _with_unit(head: Reading) -> Reading:
    """Return the head of an input, with a problem if neither it nor its first cell has the unit that it needs."""
    needs_unit = head.cell and not head.unit_text and NOMENCLATURE[head.name].unit not in ("", "1")
    if not needs_unit or (kind := _kind(head.cell, head.name)) not in (_NO_UNIT, _UNIT):
        return head
    part = f"_{head.part}" if head.part else ""
    meant = f"{head.name}{part} [{unit_for(head.cell.strip('[]() '), head.name) or 'UNIT'}]"
    return head._replace(problem=kind, meant=[meant])


def _beside_others(heads: Sequence[Reading], stated: Collection[str], given: Collection[str]) -> Iterator[Reading]:
    """Iterate over heads as the others make them mean. ± alone is of the column at its left.

    `stated`: the headers that options name, which mean what they say.
    """
    is_of_two = "radius2" in given or any(head.is_input and head.name == "radius2" for head in heads)
    moduli = [head for head in heads if head.name in ("youngs_modulus", "youngs_modulus2")]
    direction = next((head.text for head in heads if moduli and re.match(_OF_DIRECTIONS, head.text)), None)
    for left, head in zip([Reading(), *heads], heads, strict=False):
        changed: dict[str, Any] = {}
        if head.part and not head.name:
            is_value = left.is_input and not left.part and left.name not in MATERIALS
            is_of_left = is_value and (head.unit_text in ("", "%") or fits(head.unit_text, left.name))
            changed = {"name": left.name if is_of_left else ""}
        elif direction is not None and head in moduli and head.text.strip() not in stated:
            problem = f"{quoted(direction)} beside it says that it is the modulus along a direction"
            changed = {"problem": problem, "meant": ()}
        elif head.is_input and head.meant and not head.part and not is_of_two:
            problem = "R is the radius of a sphere or the reduced radius, half of it for equal spheres"
            changed = {"problem": problem}
        yield head._replace(**changed)


def _column(parts: Mapping[str, Reading], stated: Collection[str]) -> Column | None:
    """Return the column of an input with those of its uncertainty; None if they make none and pass through.

    `parts`: by the part of the uncertainty, "" for the values; `stated`: the headers that options name. Without a unit
    cells carry their own, or they are plain numbers of a ratio. Raises BadTable.
    """
    name = next(iter(parts.values())).name
    used = next((shape for shape in _SHAPES if parts.keys() >= {*shape}), ())
    if parts.keys() >= {"", "both", "minus", "plus"}:
        first, second = quoted(parts["both"].text), quoted(parts["minus"].text)
        raise BadTable(f"header: {first} and {second} are both uncertainties of {name}; one must go")
    left = [head.text for part, head in parts.items() if part not in used]
    if left and (any(text.strip() in stated for text in left) or ("" not in parts and parts.keys() & {*_ENDS})):
        raise BadTable(
            f"header: {quoted(left[0])} alone is no uncertainty of {name}: values have a column of ± beside them, or "
            "two, of minus and plus; a range has low and high alone"
        )
    if not used:
        return None
    of_ratio = ("1", "-") if NOMENCLATURE[name].unit == "1" else ()
    units = {part: "" if parts[part].unit_text in of_ratio else parts[part].unit_text for part in used}
    unit_text = units[used[0]] or (units["high"] if used == _ENDS else "")
    for part in used:
        if part != "both" and units[part] not in ("", unit_text):
            other = f", {unit_text}" if unit_text else "; that has none"
            raise BadTable(f"header: {quoted(parts[part].text)}: its unit must be that of the other column{other}")
    unit = unit_of(unit_text, name) if unit_text else None
    sides = {part: parts[part].place for part in used if part}
    error_unit = units.get("both", "")
    return Column(parts[used[0]].place, name, unit_text, unit, sides, error_unit if error_unit != unit_text else "")


# --- What is refused --------------------------------------------------------------------------------------------------


def _refusal(heads: Sequence[Reading]) -> BadTable:
    """Return the error of columns that may be inputs and cannot be read."""
    remedies = " ".join(" or ".join(_option(head.text, meant) for meant in head.meant or [""]) for head in heads)
    if any(head.problem == _UNIT for head in heads):
        return BadTable(f"header: the first row has units. Delete it, and write {remedies}")
    problems = [
        f"{quoted(head.text)} {_NO_UNIT} {quoted(head.cell)}"
        if head.problem == _NO_UNIT
        else f"{quoted(head.text)}{f' (first cell {quoted(head.cell)})' if head.cell else ''}: {head.problem}"
        for head in heads
    ]
    remedies += " with its unit" if any(head.problem == _NO_UNIT for head in heads) else ""
    if len(heads) == 1:
        [head] = heads
        if not head.meant:
            remedies = f"a column {with_unit(head.name)} in its place" if head.name else ""
        remedies = ", or ".join(filter(None, (remedies, f"{_option(head.text, '')} to pass it through")))
    return BadTable(f"header: {'; '.join(problems)}. Write {remedies}")


def _option(text: str, meaning: str) -> str:
    """Return the option that says what a column means, in the quotes of a shell."""
    value = shown(f"{text.strip()}={meaning}")
    return f'--column "{value}"' if "'" in value else f"--column '{value}'"


def check_inputs(header: Header, measured: str = "") -> None:
    """Raise BadTable for a table of which no column is an input, or none the measured quantity."""
    if measured in header.names or (header.names and not measured):
        return
    if all(map(is_number, header.texts)):
        raise BadTable(f"header: {quoted(header.texts[0])} is a number; begin with a line of the columns' names")
    if not measured:
        raise BadTable(
            "header: no column is an input; a row is a contact, and its inputs have columns such as radius [nm]. "
            f"Write {_option('HEADER', 'INPUT [UNIT]')}"
        )
    words = tuple((key(word), name) for word, name in QUANTITY_SYNONYMS.items() if name == measured)
    likely = ((text, reading) for text in header.texts if (reading := reading_of(text, words)).name == measured)
    text, reading = next(likely, ("HEADER", Reading(unit_text="UNIT")))
    option = _option(text, header_of(measured, reading.unit_text or None))
    raise BadTable(f"header: no column has the measured {measured}; name it by {option}")


def is_input(text: str, meanings: Mapping[str, Reading] = _NO_MEANINGS) -> bool:
    """Return whether a header may be that of an input; a symbol without a unit is one if its cells have units."""
    reading = meanings.get(text.strip()) or reading_of(text)
    return reading.is_input or bool(reading.part)
