"""The header of a table: the columns that are inputs, with their units, those that pass through, and what is refused."""

from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from contextlib import suppress
from types import MappingProxyType
from typing import NamedTuple

from ..errors import BadRequest, BadTable
from ..quantities.errors import QUANTITY_SYNONYMS, BareNumber, QuantityError
from ..quantities.laws import LAWS
from ..quantities.nomenclature import NOMENCLATURE
from ..quantities.nomenclature import header as header_of
from ..quantities.units import dimension_of, kind_of
from ..quantities.values import unit_of, value_of
from ..text import closest, first_of, quoted, shown
from .cells import Column, Side, is_number
from .readings import (
    MATERIALS,
    Reading,
    fits,
    is_of_directions,
    key,
    read,
    reading_of,
    unit_alone,
    unit_for,
    unit_in_header,
    with_unit,
    words_of,
)

_PARTS = "values have a column of ± beside them, or two, of minus and plus; a range has low and high alone"
_MAX_SAID = 8  # columns that pass through and are named


class Header(NamedTuple):
    """The columns of a table."""

    texts: tuple[str, ...]
    inputs: tuple[Column, ...]
    materials: tuple[tuple[str, int], ...]  # name and place of the columns that name materials
    alike: tuple[str, ...] = ()  # columns that pass through though they look like quantities
    meanings: Mapping[str, Reading] = MappingProxyType({})  # what `--column` says of headers
    preamble: int = 0  # lines before the header that are passed over

    @property
    def names(self) -> frozenset[str]:
        """The names of the inputs that have columns."""
        return frozenset({column.name for column in self.inputs} | {name for name, _ in self.materials})

    def reading(self) -> str:
        """Return the sentence that says how the table is read. What looks like a quantity stands first among what passes through."""
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
        passing = [_easy(text) for text in dict.fromkeys((*self.alike, *others)) if text.strip()]
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
    of_measured = {key(measured): measured, key(NOMENCLATURE[measured].symbol): measured} if measured else {}
    values = {head: reading.name for head, reading in chosen.items() if reading.name and not reading.part}
    of_chosen = {word: name for head, name in values.items() for word in words_of(head)}
    found: dict[str, Reading] = {}
    for head in map(str.strip, names):
        reading = read(head, of_measured) if of_measured else Reading()
        if reading.name != measured:
            reading = read(head, of_chosen) if of_chosen else Reading()
            reading = reading if reading.part and not reading_of(head).is_input else Reading()
        if reading.is_input:
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
            reading = reading._replace(unit_text=unit_in_header(head, reading.name))
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
    cells = [*map(_first, columns)]
    readings = [_meaning(text, column, meanings) for text, column in zip(texts, columns, strict=True)]
    for place, text in enumerate(texts[1:], 1):  # ± alone is of the column at its left
        left, is_stated = readings[place - 1], text.strip() in meanings
        is_alone = unit_alone(text) is not None and not (
            readings[place].name or is_stated or cells[place][:1].isalpha()
        )
        if is_alone and left.is_input and not left.part and left.name not in MATERIALS:
            readings[place] = Reading(left.name, unit_alone(text) or None, "both")
    readings = [*_along_directions(texts, readings, meanings)]
    names = _names(readings)
    readings = [_of_sphere(reading, {*names, *given}) for reading in readings]
    names = _names(readings)
    inputs: list[Column] = []
    materials: list[tuple[str, int]] = []
    parts: dict[str, dict[str, int]] = {}  # the places of the parts of an input's uncertainty
    seen: dict[str, str] = {}
    alike = [text for text, reading in zip(texts, readings, strict=True) if reading.is_alike or reading.problem]
    refused = {
        text: (reading, cell)
        for text, reading, cell in zip(texts, readings, cells, strict=True)
        if reading.problem and reading.name not in names
    }
    for place, (text, reading) in enumerate(zip(texts, readings, strict=True)):
        name = reading.name
        if reading.is_input and name in MATERIALS:
            materials.append((name, place))
        elif reading.is_input and reading.part:
            parts.setdefault(name, {})[reading.part] = place
        elif reading.is_input:
            inputs.append(_column(place, name, reading.unit_text, text))
        _check_new(text, f"{name} {reading.part}" if reading.is_input else text, seen)
    if refused:
        raise _refusal(refused)
    for name, places in parts.items():
        alike += _add_parts(name, places, texts, readings, inputs, meanings)
    return Header(tuple(texts), tuple(inputs), tuple(materials), tuple(alike), meanings)


def _names(readings: Iterable[Reading]) -> set[str]:
    """Return the inputs that columns give."""
    return {reading.name for reading in readings if reading.is_input and reading.part in ("", "low")}


def _meaning(text: str, cells: Sequence[str], meanings: Mapping[str, Reading]) -> Reading:
    """Return the meaning of a column: that of `--column`, else that of its header, if its cells can be of it."""
    if (stated := meanings.get(text.strip())) is not None:
        return stated
    reading, cell = reading_of(text), _first(cells)
    if reading.is_symbol and not reading.part and not _have_units(cells, reading.name):
        return Reading(is_alike=True)
    if key(text) in ("model", "law") and cell.casefold() in LAWS:
        return Reading("model", problem="the law is an option: --model dmt")
    is_text = cell[:1].isalpha() and reading.name not in MATERIALS
    return Reading(is_alike=True) if reading.problem and is_text else reading


def _along_directions(
    texts: Sequence[str], readings: Sequence[Reading], meanings: Mapping[str, Reading]
) -> Iterator[Reading]:
    """Iterate over readings, with the refusal of moduli that are those along directions, as another column says."""
    other = next(filter(is_of_directions, texts), "")
    problem = f"{quoted(other)} beside it says that it is the modulus along a direction"
    for text, reading in zip(texts, readings, strict=True):
        is_modulus = reading.name.removesuffix("2") == "youngs_modulus" and text.strip() not in meanings
        yield reading._replace(problem=problem, meant=()) if other and is_modulus else reading


def _of_sphere(reading: Reading, names: Collection[str]) -> Reading:
    """Return R as the radius of sphere 1 where sphere 2 has one, else its refusal."""
    if reading.is_input and reading.meant and not reading.part and "radius2" not in names:
        both = "R is the radius of a sphere or the reduced radius, half of it for equal spheres"
        return reading._replace(problem=both)
    return reading


def _refusal(refused: Mapping[str, tuple[Reading, str]]) -> BadTable:
    """Return the error of columns that may be inputs and cannot be read."""
    problems = [
        f"{quoted(text)}{f' (first cell {quoted(cell)})' if cell else ''}: {reading.problem}"
        for text, (reading, cell) in refused.items()
    ]
    remedies = [
        " or ".join(_option(text, each) for each in reading.meant or ("",)) for text, (reading, _) in refused.items()
    ]
    if len(remedies) > 1:
        return BadTable(f"header: {_sentence('; '.join(problems))} Write {' '.join(remedies)}")
    ((text, (reading, _)),) = refused.items()
    remedy = remedies[0] if reading.meant else f"a column {with_unit(reading.name)} in its place"
    return BadTable(f"header: {_sentence(problems[0])} Write {remedy}, or {_option(text, '')} to pass it through")


def _sentence(text: str) -> str:
    """Return a text that ends as a sentence does."""
    return text if text.endswith("?") else f"{text}."


def _option(text: str, meaning: str) -> str:
    """Return the option that says what a column means, in the quotes of a shell."""
    value = shown(f"{text.strip()}={meaning}")
    return f'--column "{value}"' if "'" in value else f"--column '{value}'"


def _check_new(text: str, meaning: str, seen: dict[str, str]) -> None:
    """Raise BadTable for the second column of one meaning, if it has a name. `seen`: the headers of before, by what they mean."""
    if meaning in seen and meaning.strip():
        other = seen[meaning]
        both = f"two columns {quoted(text)}" if other == text else f"the columns {quoted(other)} and {quoted(text)}"
        raise BadTable(f"header: {both}, of which one must go")
    seen[meaning] = text


# --- Units and error bars ---------------------------------------------------------------------------------------------


def _column(place: int, name: str, unit_text: str | None, text: str) -> Column:
    """Return the column of an input. Without a unit its cells carry their own, or are plain numbers if it is a ratio."""
    if not unit_text or (unit_text in ("1", "-") and NOMENCLATURE[name].unit == "1"):
        return Column(place, name, "", None)
    try:
        unit = unit_of(unit_text, name)
        if unit.dimension != dimension_of(NOMENCLATURE[name].unit):
            raise QuantityError(name, unit_text, f"is {kind_of(unit.dimension)}")
    except QuantityError as error:
        raise BadTable(f"header: {quoted(text)}: {quoted(unit_text)} {error.problem()}") from None
    return Column(place, name, unit_text, unit)


def _add_parts(
    name: str,
    places: Mapping[str, int],
    texts: Sequence[str],
    readings: Sequence[Reading],
    inputs: list[Column],
    meanings: Mapping[str, Reading],
) -> list[str]:
    """Add the columns of an uncertainty to that of its input, and return the headers of those that make none. Raises BadTable."""
    base = next((column for column in inputs if column.name == name), None)
    kinds = ("both",) if "both" in places else ("minus", "plus") if base else ("low", "high")
    left = [texts[place] for part, place in places.items()]
    if {*kinds} <= places.keys() and (base or kinds == ("low", "high")):
        columns = {part: _side(places[part], name, readings[places[part]].unit_text, texts) for part in kinds}
        if base is None:
            first = columns["low"] if columns["low"].unit_text else columns["high"]
            base = first._replace(place=places["low"])
            inputs.append(base)
        sides = []
        for part, column in columns.items():
            if len(kinds) > 1 and column.unit_text not in ("", base.unit_text):
                stated = f", {base.unit_text}" if base.unit_text else "; that has none"
                raise BadTable(
                    f"header: {quoted(texts[column.place])}: its unit must be that of the other column{stated}"
                )
            sides.append(Side(part, column.place, "" if column.unit_text == base.unit_text else column.unit_text))
        inputs[inputs.index(base)] = base._replace(sides=tuple(sides))
        left = [texts[place] for part, place in places.items() if part not in kinds]
        if other := next(
            (texts[place] for part, place in places.items() if part not in kinds and part in ("minus", "plus")), ""
        ):
            used = quoted(texts[sides[0].place])
            raise BadTable(f"header: {used} and {quoted(other)} are both uncertainties of {name}; one must go")
    elif base is None and not {"low", "high"}.isdisjoint(places):
        raise BadTable(f"header: {quoted(left[0])} is one end of a range of {name}, and the other is missing: {_PARTS}")
    if lost := [text for text in left if text.strip() in meanings]:
        raise BadTable(f"header: {quoted(lost[0])} is not an uncertainty of {name}: {_PARTS}")
    return left


def _side(place: int, name: str, unit_text: str | None, texts: Sequence[str]) -> Column:
    """Return the column of a part of an uncertainty."""
    return Column(place, name, "%", None) if unit_text == "%" else _column(place, name, unit_text, texts[place])


def check_units(header: Header, rows: Sequence[Sequence[str]]) -> None:
    """Raise BadTable for columns that have a unit neither in their header nor in their first cell; `rows`: the first ones."""
    lacking: dict[str, tuple[str, str]] = {}  # what columns mean, and their first cells
    is_row_of_units = False
    for column in header.inputs:
        first = _first([row[column.place] for row in rows])
        if not first or column.unit is not None or column.exponent is not None:
            continue
        parts = {column.place: ""} | {side.place: f"_{side.part}" for side in column.sides}
        unit_text = unit_for(first.strip("[]() "), column.name)
        try:
            value_of(first, column.name)
        except BareNumber:
            pass
        except QuantityError:
            is_row_of_units |= bool(unit_text)
            if not unit_text:
                continue  # a bad row, not a bad header
        else:
            continue
        lacking |= {
            header.texts[place]: (f"{column.name}{part} [{unit_text or 'UNIT'}]", first)
            for place, part in parts.items()
        }
    if lacking:
        remedy = " ".join(_option(text, meaning) for text, (meaning, _) in lacking.items())
        if is_row_of_units:
            raise BadTable(f"header: the first row has units. Delete it, and write {remedy}")
        several = "; ".join(
            f"{quoted(text)} has no unit, and neither has its first cell {quoted(cell)}"
            for text, (_, cell) in lacking.items()
        )
        passing = f", or {_option(next(iter(lacking)), '')} to pass it through" if len(lacking) == 1 else ""
        raise BadTable(f"header: {several}. Write {remedy} with its unit{passing}")


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
    return unit_alone(text) is not None or (meanings.get(text.strip()) or reading_of(text)).is_input


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
