"""The header of a table: the columns that are inputs, their units, and the columns that pass through."""

import re
from collections.abc import Iterable, Iterator, Mapping, Sequence
from math import gcd, log10
from types import MappingProxyType
from typing import NamedTuple

from ..errors import BadRequest, JkrollError
from ..quantities.errors import BareNumber, QuantityError
from ..quantities.nomenclature import NOMENCLATURE
from ..quantities.units import Unit, dimension_of, kind_of
from ..quantities.values import Uncertain, parse_quantity, split_number, unit_of, value_of
from ..text import MAX_WORD, closest, first_of, quoted, shown
from .readings import MATERIALS, Reading, measured_reading, reading_of

_PER_CENT = re.compile(r"(.*?)((?:±|\+/?-)[^±]*%)?", re.DOTALL)  # 25±20 % of the value
_EASY = re.compile(r"[\w*.-]+( \[[^\[\] ]*\])?")  # a header that needs no quotes in a sentence
_PARTS = "values have a column of ± beside them, or two, of minus and plus; a range has low and high alone"
_MOST_SAID = 8  # columns that pass through and are named


class BadTable(JkrollError):
    """Error raised for a header, a format or a file that makes no table of scenes."""

    def __init__(self, problem: str) -> None:
        super().__init__(problem)
        self.problem = problem

    def __str__(self) -> str:
        return self.problem


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
        """Return the cells of a value as one: 25 and 5 as 25±5."""
        first, *others = (cell.strip() for cell in cells)
        if not any(others) and not (self.is_range and first):
            return first
        if self.is_range:
            return f"{first or '?'} to {others[0] or '?'}"
        if len(others) > 1:
            minus, plus = (cell.lstrip("+-") or "0" for cell in others)
            return f"{first} +{plus}/-{minus}"
        unit_text = self.sides[0].unit_text
        if unit_text in ("", "%"):
            return f"{first}±{others[0]}{unit_text}"
        return f"{first} {self.unit_text}±{others[0]} {unit_text}"

    @property
    def exponent(self) -> int | None:
        """The unit as a power of ten of the SI unit; None if it is no power of ten, or if there is no unit."""
        if self.unit is None:
            return 0 if NOMENCLATURE[self.name].unit == "1" else None
        return power_of_ten(self.unit)

    def read(self, text: str) -> float | Uncertain:
        """Return the SI value of a cell, with its uncertainty if it states one. Its unit is its own or that of the column."""
        try:
            return value_of(text, self.name)
        except BareNumber:
            if not self.unit_text:
                raise
            number, per_cent = _PER_CENT.fullmatch(text.strip()).groups()  # type: ignore[union-attr]  # matches any line
            return value_of(f"{number} {self.unit_text}{per_cent or ''}", self.name)


def power_of_ten(unit: Unit) -> int | None:
    """Return the exponent of a unit that is a power of ten times the SI unit.

    >>> power_of_ten(unit_of("nm", "radius")), power_of_ten(unit_of("ft", "radius"))
    (-9, None)
    """
    common = gcd(unit.numerator, unit.denominator)
    above, below = str(unit.numerator // common), str(unit.denominator // common)
    return len(above) - len(below) if above.rstrip("0") == below.rstrip("0") == "1" else None


class Header(NamedTuple):
    """The columns of a table."""

    texts: tuple[str, ...]
    inputs: tuple[Column, ...]
    materials: tuple[tuple[str, int], ...]  # name and place of the columns that name materials
    alike: tuple[str, ...] = ()  # columns that pass through though they look like quantities
    chosen: Mapping[str, Reading] = MappingProxyType({})  # what `--column` says of headers

    @property
    def names(self) -> frozenset[str]:
        """The names of the inputs that have columns."""
        return frozenset({column.name for column in self.inputs} | {name for name, _ in self.materials})

    def reading(self) -> str:
        """Return the sentence that says how the table is read. What looks like a quantity stands first among what passes through."""
        materials = [_from(name, "", self.texts[place]) for name, place in self.materials]
        read = [*materials, *map(self._reading_of, self.inputs)]
        places = {place for _, place in self.materials}
        places = places.union(*(column.places.values() for column in self.inputs))
        others = [text for place, text in enumerate(self.texts) if place not in places]
        sentence = f"read: {', '.join(read) or 'no input'}"
        if not others:
            return sentence
        passing = [_easy(text) for text in dict.fromkeys((*self.alike, *others))]
        count = f"{len(others)} columns: " if len(others) > _MOST_SAID else ""
        return f"{sentence}; passed through: {count}{first_of(passing, _MOST_SAID)}"

    def _reading_of(self, column: Column) -> str:
        """Return the name of an input with the headers that it is read from, if these are others."""
        heads = {side.part: _easy(self.texts[side.place]) for side in column.sides}
        if column.is_range:
            return f"{_head(column.name, column.unit_text)} from {heads['low']} to {heads['high']}"
        own = _from(column.name, column.unit_text, self.texts[column.place])
        marks = {"both": "±", "minus": "−", "plus": "+"}
        return " ".join([own, *(f"{marks[part]} {head}" for part, head in heads.items())])


def _from(name: str, unit_text: str, text: str) -> str:
    """Return the name of an input with the header that it is read from, if that is another."""
    head = _head(name, unit_text)
    return head if text.strip() in (head, name) else f"{head} from {_easy(text)}"


def _head(name: str, unit_text: str) -> str:
    return f"{name} [{unit_text}]" if unit_text else name


def _easy(text: str) -> str:
    return shown(text) if _EASY.fullmatch(text) else f'"{shown(text)}"'


def chosen(names: Iterable[str], texts: Iterable[str], measured: str = "") -> dict[str, Reading]:
    """Return the meaning of columns that options say: of those that `--column` names, and of those of a measured quantity."""
    of_measured = {name.strip(): measured_reading(name, measured) for name in names} if measured else {}
    found = {name: reading for name, reading in of_measured.items() if reading is not None}
    return found | choices(texts, measured)


def choices(texts: Iterable[str], measured: str = "") -> dict[str, Reading]:
    """Return what the values of `--column` say of headers: 'R2 (nm)=radius2 [nm]', or 'T (K)=' for no input. Raises BadRequest.

    `measured`: a quantity that columns have besides inputs.
    """
    found: dict[str, Reading] = {}
    for text in texts:
        head, is_pair, meaning = text.rpartition("=")
        if not is_pair or not head.strip():
            raise BadRequest(f"--column: {quoted(text)} is no choice; write HEADER=INPUT, as in 'R2 (nm)=radius2 [nm]'")
        reading = (measured and measured_reading(meaning, measured)) or reading_of(meaning)
        if meaning.strip() and (not reading.name or reading.is_symbol):
            meant = (
                f"; did you mean {reading.meant}?"
                if reading.meant
                else "; write a name with its unit, as in radius [nm]"
            )
            raise BadRequest(f"--column: {quoted(meaning)} is no input{meant}")
        if head.strip() in found:
            raise BadRequest(f"--column: {quoted(head)} is given more than once")
        found[head.strip()] = reading if meaning.strip() else Reading()
    return found


def understood(
    texts: Sequence[str], rows: Sequence[Sequence[str]] = (), chosen: Mapping[str, Reading] = MappingProxyType({})
) -> Header:
    """Return the columns of a header, given the cells of its first rows and what is chosen for some. Raises BadTable."""
    inputs: list[Column] = []
    materials: list[tuple[str, int]] = []
    parts: dict[str, dict[str, int]] = {}  # the places of the parts of an input's uncertainty
    alike: list[str] = []
    seen: dict[str, str] = {}
    if lacking := [text for text in chosen if text not in {text.strip() for text in texts}]:
        guess = closest(lacking[0], texts)
        meant = f"; did you mean {quoted(guess)}?" if guess else ""
        raise BadTable(f"--column: the table has no column {quoted(lacking[0])}{meant}")
    for place, text in enumerate(texts):
        reading = chosen.get(text.strip()) or reading_of(text)
        if reading.is_symbol and not reading.part and not _have_units(reading.name, [row[place] for row in rows]):
            reading = Reading(is_alike=True)
        name, unit_text = reading.name, reading.unit_text
        key = f"{name} {reading.part}" if name else text
        if key in seen:
            other = seen[key]
            both = f"two columns {quoted(text)}" if other == text else f"the columns {quoted(other)} and {quoted(text)}"
            raise BadTable(f"header: {both}, of which one must go")
        seen[key] = text
        if name in MATERIALS:
            if unit_text is not None:
                raise BadTable(f"header: {quoted(text)}: a material has no unit; write {name}")
            materials.append((name, place))
        elif reading.part:
            parts.setdefault(name, {})[reading.part] = place
        elif name:
            inputs.append(_column(place, name, unit_text, text))
        elif reading.meant or reading.problem:
            is_wrong = f"; did you mean {reading.meant}?" if reading.meant else f": {reading.problem}"
            remedy = (
                f"--column {_choice(text, reading.meant or 'INPUT [UNIT]')}, or {_choice(text, '')} to pass it through"
            )
            raise BadTable(f"header: {quoted(text)} is no input{is_wrong} Write {remedy}")
        elif reading.is_alike:
            alike.append(text)
    others = [*alike, *_add_parts(parts, texts, inputs, chosen)]
    return Header(tuple(texts), tuple(inputs), tuple(materials), tuple(others), chosen)


def _add_parts(
    parts: Mapping[str, Mapping[str, int]], texts: Sequence[str], inputs: list[Column], chosen: Mapping[str, Reading]
) -> Iterator[str]:
    """Add the columns of uncertainties to those of their inputs, and iterate over the texts of those that make none. Raises BadTable."""
    for name, places in parts.items():
        own = {part: texts[place] for part, place in places.items()}
        if (found := _with_parts(name, places, own, inputs, chosen)) is not None:
            inputs[:] = [*(column for column in inputs if column.name != name), found]
        elif lost := [text for text in own.values() if text.strip() in chosen]:
            raise BadTable(f"--column: {quoted(lost[0])} is no uncertainty of {name}: {_PARTS}")
        else:
            yield from own.values()


def _with_parts(
    name: str,
    places: Mapping[str, int],
    texts: Mapping[str, str],
    inputs: Sequence[Column],
    chosen: Mapping[str, Reading],
) -> Column | None:
    """Return the column of an input with those of its uncertainty; None if these make none. Raises BadTable."""
    base = next((column for column in inputs if column.name == name), None)
    kinds = ("both",) if "both" in places else ("minus", "plus") if base else ("low", "high")
    if {*kinds} != places.keys() or (base is None and kinds == ("both",)):
        return None
    readings = {part: chosen.get(text.strip()) or reading_of(text) for part, text in texts.items()}
    if base is None:
        first = next(filter(None, (readings[part].unit_text for part in kinds)), None)
        base = _column(places["low"], name, first, texts["low"])
    sides: list[Side] = []
    for part in kinds:
        unit_text = readings[part].unit_text or base.unit_text
        if unit_text == base.unit_text:
            unit_text = ""
        elif len(kinds) > 1:
            raise BadTable(
                f"header: {quoted(texts[part])}: its unit must be that of the other column, {base.unit_text}"
            )
        elif unit_text != "%":
            _column(places[part], name, unit_text, texts[part])  # raises what is wrong with the unit
        sides.append(Side(part, places[part], unit_text))
    return base._replace(sides=tuple(sides))


def _choice(text: str, meaning: str) -> str:
    """Return the value of `--column` in the quotes of a shell."""
    value = shown(f"{text.strip()}={meaning}")
    return f'"{value}"' if "'" in value else f"'{value}'"


def _have_units(name: str, cells: Sequence[str]) -> bool:
    """Return whether the first cell that is not empty is a value of an input, with its unit."""
    try:
        return any(value_of(cell, name) is not None for cell in [cell for cell in cells if cell.strip()][:1])
    except QuantityError:
        return False


def holds_input(text: str, cell: str, chosen: Mapping[str, Reading]) -> bool:
    """Return whether a header and its cell are those of an input."""
    reading = chosen.get(text.strip()) or reading_of(text)
    return bool(reading.name) and (not reading.is_symbol or _have_units(reading.name, [cell]))


def is_input(text: str, chosen: Mapping[str, Reading] = MappingProxyType({})) -> bool:
    """Return whether a header is that of an input; a symbol without a unit is one if its cells have units."""
    return bool((chosen.get(text.strip()) or reading_of(text)).name)


def _column(place: int, name: str, unit_text: str | None, text: str) -> Column:
    """Return the column of an input. Without a unit its cells carry their own, or are plain numbers if it is a ratio."""
    wanted = dimension_of(NOMENCLATURE[name].unit)
    if not unit_text or (unit_text in ("1", "-") and not any(wanted)):
        return Column(place, name, "", None)
    try:
        unit = unit_of(unit_text, name)
        if unit.dimension != wanted:
            raise QuantityError(name, unit_text, f"is {kind_of(unit.dimension)}")
    except QuantityError as error:
        raise BadTable(f"header: {quoted(text)}: {quoted(unit_text)} {error.problem()}") from None
    return Column(place, name, unit_text, unit)


def check_first(column: Column, texts: Sequence[str]) -> None:
    """Raise BadTable for a column that has a unit neither in its header nor in its first cell."""
    if column.unit is not None or column.exponent is not None:
        return
    first = next((text for text in texts if text.strip()), None)
    try:
        if first is not None:
            value_of(first, column.name)
    except BareNumber:
        unit_text = _likely_unit(column.name, first or "")
        cell = shown(first or "", MAX_WORD).strip()
        raise BadTable(
            f"header: {quoted(column.name)} has no unit, and neither has its first cell {quoted(first or '')}; "
            f"{cell}: {unit_text}? Write {column.name} [{unit_text}]"
        ) from None
    except QuantityError:
        pass  # a bad row, not a bad header


def _likely_unit(name: str, cell: str) -> str:
    """Return the SI unit of a quantity or that of its example, if it has one, in which a number is nearer to the example."""
    quantity = NOMENCLATURE[name]
    if not quantity.example:
        return quantity.unit
    example = parse_quantity(quantity.example, name)
    units = (split_number(quantity.example)[2], quantity.unit)
    return min(units, key=lambda unit: _distance(f"{cell} {unit}", name, example))


def _distance(text: str, name: str, example: float) -> float:
    """Return by how many powers of ten a value differs from an example."""
    try:
        return abs(log10(abs(parse_quantity(text, name) / example)))
    except (QuantityError, ValueError):
        return 0.0
