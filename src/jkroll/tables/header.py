"""The header of a table: input columns with their units, columns that pass through, and columns that are refused.

Each header is first read on its own, in `reading`. The headers together decide which input an uncertainty belongs to,
which columns an input makes redundant, and which columns qualify an input and so must not be ignored.
"""

import re
from collections.abc import Callable, Collection, Iterable, Iterator, Mapping, Sequence
from types import MappingProxyType
from typing import NamedTuple

from ..errors import BadRequest, BadTable
from ..model.frame import EXCLUSIVE
from ..quantities.laws import MODELS
from ..quantities.nomenclature import CONVERTED, NOMENCLATURE, of_sphere
from ..quantities.nomenclature import header as header_of
from ..quantities.values import NO_UNIT, QuantityError, unit_of, value_of
from ..text import first_of, listed, quoted, shown
from . import words
from .cells import Column, has_no_value, is_number
from .reading import (
    FACTOR,
    NO_FACTOR,
    SPREAD,
    UNREAD,
    Reading,
    means_other,
    normalized,
    reading_of,
    splits_of,
    stems_of,
    symbol_of,
    words_in,
)
from .unread import NOT_READ, Supply, decided_by, judged
from .words import MATERIALS, fits, headed, key, unit_for

_NOT_USED = "a value has one column of ±, or two for minus and plus; a range has columns of its ends only"
_MAX_LISTED = 60  # passed columns that are listed by name
_OF_DIRECTIONS = r"(?i)\s*((G|nu|ν)_?(12|13|23|xy|xz|yz)|E_?3)(?![^\W_])"
_MARKS = {"both": "± ", "minus": "− ", "plus": "+ ", "low": "from ", "high": "to "}
_HEADER_AND_INPUT = r"(.*)(?<!\(k)(?<!\(k )=(.*)"  # except (k=2)
_ENDS = ("low", "high")
_SHAPES = (("", "both"), ("", "minus", "plus"), ("",), _ENDS)  # the parts that columns of a value can have
_VALUE, _UNIT, _NO_UNIT = "value", "unit", "neither has a unit"  # sorts of cells


class Header(NamedTuple):
    """The columns of a table."""

    texts: tuple[str, ...]
    inputs: tuple[Column, ...]
    materials: tuple[Column, ...]  # columns with names of materials
    clauses: Mapping[int, str] = MappingProxyType({})  # the value used instead of a column that passes through

    @property
    def names(self) -> frozenset[str]:
        """The names of the inputs that have columns."""
        return frozenset(column.name for column in (*self.materials, *self.inputs))

    @property
    def positions(self) -> dict[str, int]:
        """The positions of all columns that are read, by name."""
        positions: dict[str, int] = {}
        for column in (*self.inputs, *self.materials):
            positions |= column.positions
        return positions

    def reading(self, *remarks: str) -> str:
        """Return the sentence that says how the table is read. `remarks`: on lines and units around the columns."""
        sentence = f"read: {', '.join(map(self._from, (*self.materials, *self.inputs))) or 'no input'}"
        sentence = "; ".join([sentence, *remarks])
        used = {*self.positions.values()}
        others = {position: text for position, text in enumerate(self.texts) if position not in used and text.strip()}
        passed = [_easy(text) + self._clause(position) for position, text in others.items()]
        if passed:
            sentence += f"; passed through: {first_of([*dict.fromkeys(passed)], _MAX_LISTED)}"
        return sentence

    def _clause(self, position: int) -> str:
        return f" ({self.clauses[position]})" if position in self.clauses else ""

    def _from(self, column: Column) -> str:
        """Return the header of an input, with its source in the table if that differs."""
        head, text = header_of(column.name, column.unit_text), self.texts[column.position]
        is_same = column.is_range or typed(text) in (head, column.name)
        sources = [f"{_MARKS[part]}{_easy(self.texts[position])}" for part, position in column.sides]
        return " ".join([head, *([] if is_same else [f"from {_easy(text)}"]), *sources])


def typed(text: str) -> str:
    """Return a header as it is shown and typed: on one line, with ordinary blanks."""
    return shown(" ".join(text.split()))


def _easy(text: str) -> str:
    """Return a header as it is shown; in quotes if it has blanks other than the one before a unit in brackets."""
    text = typed(text)
    return text if " " not in text.replace(" [", "[") and "(" not in text else f'"{text}"'


def stated_meanings(texts: Iterable[str], measured: str = "") -> dict[str, str]:
    """Return what `--column` puts in place of headers: radius2 [nm] for R2 (nm), or "" if a column is not an input.

    `texts`: the values of the option, as in 'R2 (nm)=radius2 [nm]'; `measured`: see `reading_of`. Raises BadRequest.
    """
    meanings: dict[str, str] = {}
    for text in texts:
        pair = re.fullmatch(_HEADER_AND_INPUT, text, re.DOTALL)
        head, meaning = map(typed, pair.groups() if pair else ("", ""))
        if not head:
            raise BadRequest(f"--column: {quoted(text)} is not of the form HEADER=INPUT, as in 'R2 (nm)=radius2 [nm]'")
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
    """Return the columns of a header, given the cells of its first rows.

    `stated`: headers that `--column` replaces; `given`: the inputs of options; `measured`: a quantity that columns may
    have in addition to inputs; `supply_of`: returns the inputs supplied without a column; `pass_rest`: True to pass all
    columns that are not read. Raises BadTable.
    """
    for text in stated.keys() - {*map(typed, texts)}:
        columns_of_table = first_of([*map(_easy, texts)], _MAX_LISTED)
        raise BadTable(f"--column: the table has no column {quoted(text)}; it has {columns_of_table}")
    heads = []
    for position, text in enumerate(texts):
        heads.append(meaning_of(text, [row[position] for row in rows], stated, measured))
    heads = [head._replace(position=position) for position, head in enumerate(_among_others(heads, given))]
    inputs: dict[str, dict[str, Reading]] = {}  # by part of the uncertainty, "" for the value
    for head in heads:
        if head.is_input:
            other = inputs.setdefault(head.name, {}).setdefault(head.part, head)
            if other is not head:
                raise _twice(other, head)
    used = {}
    for name, group in inputs.items():
        parts = _used(name, group)
        if parts:
            used[name] = parts
    used = {name: parts for name, parts in used.items() if not _is_doubled(name, used, rows)}
    values: list[Reading] = []
    for parts in used.values():
        values += [head for part, head in parts.items() if part in ("", *_ENDS)]
    held, known = {*used, *decided_by(used)}, {*used, *given}
    texts_of = {name: next(iter(parts.values())).text for name, parts in used.items()}
    heads = [_with_suffix(head, {**dict.fromkeys(given, ""), **texts_of}, measured) for head in heads]
    without_part = {head.name for head in heads if not head.part}
    held |= {name for name, other in CONVERTED.items() if other in without_part}  # a column of E lets one of G pass
    clauses: Mapping[str, str] = {}
    if supply_of is not None:
        supply = supply_of(used)
        clauses = supply.clauses
        heads = [judged(head, [row[head.position] for row in rows], supply) for head in heads]
    left = [head for head in heads if head.problem and not _may_pass(head, held, known)]
    refused = [] if pass_rest else [*left]
    refused += [head for head in map(_with_problem, values) if head.problem]
    for name, parts in inputs.items():
        if name in known:
            unused = [head for part, head in parts.items() if part not in used.get(name, ())]
            refused += [head._replace(problem=_NOT_USED, meant=()) for head in unused]
    if refused:
        raise _refusal(sorted(refused, key=lambda head: head.position))
    columns = [_column(name, parts) for name, parts in used.items()]
    materials = [column for column in columns if column.name in MATERIALS]
    others = [column for column in columns if column.name not in MATERIALS]
    passed = {head.position: clauses[head.name] for head in left if head.name in clauses}
    return Header(tuple(texts), tuple(others), tuple(materials), passed)


def _is_doubled(name: str, used: Mapping[str, Mapping[str, Reading]], rows: Sequence[Sequence[str]]) -> bool:
    """Return whether a diameter always comes with a radius, or G with E, so that its column can pass through.

    A column given by `--column` is always read.
    """
    parts, others = used[name], used.get(CONVERTED.get(name, ""), {})
    if not others or any(head.is_stated for head in parts.values()):
        return False
    own = [head.position for head in parts.values()]
    other = [head.position for head in others.values()]
    filled = [row for row in rows if not _are_empty(row, own)]
    return bool(filled) and not any(_are_empty(row, other) for row in filled)


def _are_empty(row: Sequence[str], positions: Iterable[int]) -> bool:
    """Return whether all cells of a row at some positions have no value."""
    return all(has_no_value(row[position]) for position in positions)


def _with_suffix(head: Reading, known: Mapping[str, str], measured: str) -> Reading:
    """Return an unread head, with a problem if it is the name of a known input with a suffix.

    `known`: the headers of inputs with columns, and "" for inputs of options.
    """
    is_of_direction = re.match(_OF_DIRECTIONS, head.text) is not None
    if head.is_input or head.part or head.is_stated or is_of_direction or head.cell[:1].isalpha():
        return head
    for split in splits_of(normalized(head.text)):
        if key(split.word) in words.meanings(measured):
            meaning = words.meanings(measured)[key(split.word)]
            if not meaning.names:
                return head  # another quantity
            names = [name for name in meaning.names if name in known and not meaning.problem]
        else:
            symbol = "" if split.is_explicit else symbol_of(split.word)
            names = []
            if symbol:
                names = [name for name, text in known.items() if symbol in map(symbol_of, words_in(text))]
        if names and split.unit and not means_other(split, names[0]):
            problem = head.problem if head.name == names[0] else f"the text after {names[0]} is not read"
            return head._replace(name=names[0], part=UNREAD, problem=problem, meant=())
    return head


def _may_pass(head: Reading, held: Collection[str], known: Collection[str]) -> bool:
    """Return whether an unread column may pass through, given the columns and options that supply inputs.

    It may pass if all that it could mean has another source. A column that qualifies a value must not be ignored.
    """
    return head.name in held and head.part != UNREAD and {*head.names} <= {*held, *known}


def _twice(first: Reading, second: Reading) -> BadTable:
    """Return the error for two columns with the same meaning."""
    problem = f"header: the columns {quoted(first.text)} and {quoted(second.text)} mean the same"
    if typed(first.text) == typed(second.text):
        return BadTable(f"{problem}: rename one")
    options = " or ".join(option_of(head.text, "") for head in (second, first))
    twin = NOMENCLATURE[first.name].twin
    of_2 = f", or {option_of(first.text, headed(twin, first.unit_text))} if it is of sphere 2" if twin else ""
    return BadTable(f"{problem}. Write {options} to pass one through{of_2}")


def meaning_of(text: str, cells: Sequence[str], stated: Mapping[str, str], measured: str) -> Reading:
    """Return the meaning of a column from `--column`, or else from its header if the cells agree with it."""
    cells = [cell.strip() for cell in cells if not has_no_value(cell)]
    cell = next(iter(cells), "")
    reading = reading_of(stated.get(typed(text), text), measured)._replace(is_stated=typed(text) in stated)
    if reading.is_symbol and not reading.part:
        kinds = {_kind(each, reading.name) for each in dict.fromkeys(cells) if not is_number(each)}
        reading = Reading() if kinds.isdisjoint((_VALUE, _UNIT)) else reading
    elif is_law(text) and cell.casefold() in MODELS and not reading.is_stated:
        reading = Reading(problem=f"the law is an option: --model {cell.casefold()}")
    elif cell[:1].isalpha() and not reading.is_input and not reading.is_stated:
        reading = Reading()
    return reading._replace(text=text, cell=cell)


def _kind(cell: str, name: str) -> str:
    """Return the sort of a cell of an input: a value, a number without its unit, a unit, or "" for other texts."""
    try:
        value_of(cell, name)
    except QuantityError as error:
        if error.mistake == NO_UNIT:
            return _NO_UNIT
        return _UNIT if unit_for(cell.strip("[]() "), name) else ""
    return _VALUE


def _with_problem(head: Reading) -> Reading:
    """Return the head of an input, with a problem if neither it nor its first cell has the unit it needs."""
    if not head.cell or head.unit_text or NOMENCLATURE[head.name].unit in ("", "1"):
        return head
    kind = _kind(head.cell, head.name)
    if kind not in (_NO_UNIT, _UNIT):
        return head
    part = f"_{head.part}" if head.part else ""
    meant = f"{head.name}{part} [{unit_for(head.cell.strip('[]() '), head.name) or 'UNIT'}]"
    return head._replace(problem=kind, meant=[meant])


def _among_others(heads: Sequence[Reading], given: Collection[str]) -> Iterator[Reading]:
    """Iterate over heads, each with its meaning in view of the other heads."""
    names = {*given, *(head.name for head in heads if head.is_input)}
    is_of_two = not names.isdisjoint(("radius2", "diameter2"))
    moduli = [head for head in heads if of_sphere(1, head.name) in ("youngs_modulus", "shear_modulus")]
    directional = [head.text for head in heads if re.match(_OF_DIRECTIONS, head.text)] if moduli else []
    values = {head.name: head for head in heads if head.is_input and not head.part}
    ends = [head for head in heads if head.is_input and head.part in _ENDS and values.keys().isdisjoint(head.names)]
    values = {head.name: head for head in ends} | values
    left = Reading()
    for head in heads:
        left = left if head.part else head
        if head.part or (head.of and not head.is_input):
            yield _of_value(head, left, values, given)
        elif directional and head in moduli and not head.is_stated:
            problem = f"with {quoted(directional[0])} in the table it may be a modulus along one direction"
            yield head._replace(problem=problem, meant=())
        elif head.is_input and head.meant and not is_of_two:
            yield head._replace(problem="R may be the radius of a sphere or the reduced radius")
        elif other := _uncertain_instead(head, values):
            yield Reading(other, part=UNREAD, problem=SPREAD.format(other), text=head.text, cell=head.cell)
        else:
            yield head


def _of_value(head: Reading, left: Reading, values: Mapping[str, Reading], given: Collection[str]) -> Reading:
    """Return a head about the spread of a value, with the name of the input that it belongs to.

    Without a name, it belongs to the column on its left. A symbol that could mean several inputs is accepted if only
    one of them is read. A head may also be the header of a column given by an option, with a suffix.
    """
    name, part = head.name, head.part
    if not head.of and not name:
        is_value = left.is_input and left.name not in MATERIALS and (part != UNREAD or is_number(head.cell or "0"))
        name = left.name if is_value and (head.unit_text in ("", "%") or fits(head.unit_text, left.name)) else ""
    elif name not in {*values, *given} and not head.is_stated:
        others = [each for each in head.names if each in values]
        name = others[0] if len(others) == 1 else name
        stems = stems_of(head.of)
        for value in values.values():
            if value.is_stated and not stems.isdisjoint(stems_of(value.text)):
                name, part = value.name, UNREAD
    if head.is_relative and name in values and values[name].unit_text == "%":
        part = UNREAD  # 5 % of 40 %, or 40 ± 5 %
    if part != UNREAD:
        return head._replace(name=name)
    if name not in {*values, *given}:
        return (head.otherwise or Reading())._replace(text=head.text, cell=head.cell)
    meant = [f"{_error_column(name, values)} (k=K)"] if head.problem == NO_FACTOR and name in values else ()
    return head._replace(name=name, part=part, problem=(head.problem or SPREAD).format(name), meant=meant)


def _error_column(name: str, values: Mapping[str, Reading]) -> str:
    """Return the header for the uncertainty of an input, in the unit of its values."""
    return headed(name, values[name].unit_text or "UNIT").replace(name, f"{name}_err", 1)


def _uncertain_instead(head: Reading, values: Mapping[str, Reading]) -> str:
    """Return the input that a head such as Δγ is an uncertainty of, if it excludes the input read; else ""."""
    text = normalized(head.text)
    rest = re.sub(words.DIFFERENCE, "", text)
    is_difference = rest != text and head.is_input and not head.is_stated
    own = reading_of(rest).name if is_difference else ""
    is_other = own in values and own != head.name  # the d of diameter is not a difference
    return own if is_other and any({own, head.name} <= {*names} for names in EXCLUSIVE) else ""


def _used(name: str, heads: Mapping[str, Reading]) -> dict[str, Reading]:
    """Return the heads of the columns that make the values of an input, by part; the others pass through.

    Raises BadTable for a column that an option states but that is not used, and for half a range.
    """
    shapes = [shape for shape in _SHAPES if heads.keys() >= {*shape}]
    shape = shapes[0] if shapes else ()
    others = [head for part, head in heads.items() if part not in shape]
    is_end = "" not in heads and not heads.keys().isdisjoint(_ENDS)
    if others and ((is_end and not shape) or any(head.is_stated for head in others)):
        raise BadTable(
            f"header: {quoted(others[0].text)} alone is not an uncertainty of {name}: values have a column of ±, or "
            "two for minus and plus; a range has low and high only"
        )
    return {part: heads[part] for part in shape}


def _column(name: str, parts: Mapping[str, Reading]) -> Column:
    """Return the column of an input; without a unit its cells state their own, or are ratios. Raises BadTable."""
    of_ratio = ("1", "-") if NOMENCLATURE[name].unit == "1" else ()
    units = {part: "" if head.unit_text in of_ratio else head.unit_text for part, head in parts.items()}
    factors = {head.coverage for part, head in parts.items() if part}
    error_unit = units.pop("both", "")
    unit_text = next(filter(None, units.values()), "")
    if not {*units.values()} <= {"", unit_text} or len(factors) > 1:
        columns = listed(quoted(head.text) for head in parts.values())
        what = "coverage factor" if len(factors) > 1 else "unit"
        raise BadTable(f"header: the columns {columns} must have the same {what}")
    unit = unit_of(unit_text, name) if unit_text else None
    sides = tuple((part, head.position) for part, head in parts.items() if part)
    first = next(iter(parts.values()))
    error_unit = error_unit if error_unit != unit_text else ""
    return Column(first.position, name, unit_text, unit, sides, error_unit, max(factors, default=1.0))


# --- Refused columns --------------------------------------------------------------------------------------------------


def _refusal(heads: Sequence[Reading]) -> BadTable:
    """Return the error for columns that may be inputs but cannot be read."""
    ways = [*filter(None, map(_way, heads))]
    if any(head.problem == _UNIT for head in heads):
        return BadTable(f"header: the first row has units. Delete it, and write {' '.join(ways)}")
    texts: dict[str, list[str]] = {}  # by the problem
    for head in heads:
        cell = f" (first cell {quoted(head.cell)})" if head.cell else ""
        texts.setdefault(head.problem, []).append(f"{quoted(head.text)}{cell}")
    problems = [f"{listed(each)}: {problem}" for problem, each in texts.items()]
    passing = f"{' '.join(option_of(head.text, '') for head in heads)} to pass {'them' if heads[1:] else 'it'} through"
    passing += " (--pass-rest passes all that is not read)" if heads[1:] else ""
    mark = " " if all(len(head.meant) < 2 for head in heads) else "; "  # options that can be typed together
    remedies = ", or ".join(filter(None, [mark.join(ways), passing]))
    return BadTable(f"header: {'; '.join(problems)}. Write {remedies}")


def _way(head: Reading) -> str:
    """Return what to write for a column that may be an input; "" if nothing is certain."""
    if head.meant:
        return " or ".join(option_of(head.text, meant) for meant in head.meant)
    if not head.name or head.part or head.problem == FACTOR or head.problem.startswith(NOT_READ):
        return ""
    return f"a column {' or '.join(map(headed, head.names or [head.name]))} instead of {quoted(head.text)}"


def option_of(text: str, meaning: str) -> str:
    """Return the option that gives a column its meaning, quoted for a shell."""
    value = f"{typed(text)}={meaning}"
    within = re.sub(r'([\\$`"])', r"\\\1", value)  # within double quotes
    return f'--column "{within}"' if "'" in value else f"--column '{value}'"


def check_inputs(header: Header, measured: str = "") -> None:
    """Raise BadTable for a table without an input column, or without the measured quantity."""
    if measured in header.names or (header.names and not measured):
        return
    if header.texts and all(map(is_number, header.texts)):
        raise BadTable(f"header: {quoted(header.texts[0])} is a number; begin with a line of the columns' names")
    if measured:
        raise BadTable(f"header: no column has the measured {measured}; write {option_of('HEADER', headed(measured))}")
    raise BadTable(
        "header: no column is an input; a row is a contact, and its inputs have columns such as radius [nm]. "
        f"Write {option_of('HEADER', 'INPUT [UNIT]')}"
    )


def is_law(text: str) -> bool:
    """Return whether a column with this header is refused if its cells are laws."""
    return key(text) in ("model", "law")


def is_input(text: str, measured: str = "") -> bool:
    """Return whether a header may be that of an input; a symbol without a unit needs cells with units."""
    reading = reading_of(text, measured)
    return reading.is_input or bool(reading.part)
