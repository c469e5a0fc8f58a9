"""The header of a table: the columns that are inputs, with their units, those that pass through, what is refused.

A header is a word with a unit, in any of a few notations: `radius [nm]`, `R2 (nm)`, `Load/nN`, `radius in nm`, `E_GPa`,
`gamma..mJ.m2.`. Words are compared by their letters and digits alone, so that `Young's modulus` and `youngsModulus` are
one; a symbol is compared as it is written, and its unit decides between the quantities that have it. What has the word
of an input and is no word with a unit is refused. All else passes through.
"""

import re
from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from functools import lru_cache
from itertools import chain, combinations
from types import MappingProxyType
from typing import NamedTuple

from ..errors import BadRequest, BadTable
from ..quantities.laws import LAWS
from ..quantities.nomenclature import NOMENCLATURE
from ..quantities.nomenclature import header as header_of
from ..quantities.units import is_in_table
from ..quantities.values import NO_UNIT, QuantityError, unit_of, value_of
from ..scene.scene import EXCLUSIVE
from ..text import ascii_text, composed, first_of, listed, quoted, shown
from . import words
from .cells import Column, has_no_value, is_number
from .words import MATERIALS, Meaning, fits, headed, key, spelt_out, squeezed, unit_for


class Reading(NamedTuple):
    """The meaning of a header: an input with the text of its unit; or, without a name, a column that passes through."""

    name: str = ""  # where there is a problem, of the input that it may be; "" for ± alone
    unit_text: str = ""
    part: str = ""  # of the input's uncertainty: "both" sides, "minus", "plus", or the "low" or "high" end of a range
    is_symbol: bool = False  # without a unit: an input only if its cells have units
    problem: str = ""  # why the header is refused unless columns give what it may be
    meant: Sequence[str] = ()  # the headers that would be read, where that is certain
    is_stated: bool = False  # by an option
    place: int = 0  # in a table
    text: str = ""  # the header, and the first cell below it that is not empty
    cell: str = ""

    @property
    def is_input(self) -> bool:
        """True for what is read."""
        return bool(self.name) and not self.problem


class _Split(NamedTuple):
    """A header as a word and what may be its unit; `is_explicit` if brackets, a mark or "in" says so."""

    word: str
    unit: str
    is_explicit: bool = True
    is_mangled: bool = False  # signs, or letters such as µ, may have become _ or .


_SPELT = str.maketrans(
    "’‘“”″∕⁄₀₁₂Ø⌀【〔「⟨«‹】〕」⟩»›\\", '\'\'"""//012DD[[[[[[]]]]]] ', "$\u00ad\u200b\u200c\u200d\u200e\u200f\ufeff"
)
_LATEX = {r"\\mu\$?\s?": "µ", r"(?<=[_^])\{([^{}]*)\}": r"\1"}  # $R_{1}$ [$\mu$m], with the marks above
# Where a unit may begin: behind a mark, which is the first group, or behind a gap.
_CUT = re.compile(
    r"([\s_.-]*[,/:;|\[({<=@~–—•·]\s*(?:in[\s_.]+)?|\s+in\s+)"
    r"|(?:[\s_.-]+|(?<=[a-z0-9])(?=[A-Z]))(?:(?:in|IN)[\s_.]+|[Ii]n(?=[A-Z]))?"
)
_PLAIN_GAP = re.compile(r"[\s_.-]?(?:(?:in|IN)[\s_.])?")
_QUOTED = r"^([\"'])\s*(.*?)\s*\1$"
_EDGES = " _.,:;/|-·"
_FACTORS = r"^[\d\s.*/^+()−-]+|\s*[*/^+(−-][\d\s.()]*(?:(?<=\d)[eE][+-]?\d+)?$|[⁰¹²³]+$"
_FACTOR_OF_UNIT = r"^[x×*]?\s*\d[\d.]*\s*(?:[eE^×*]*\s*[-+−⁻]?[\d⁰¹²³⁴⁵⁶⁷⁸⁹]+\s*)*[×*·]?\s*"  # as in 10^-20 J
_LONGEST = 120  # letters of a header that can be one


@lru_cache(maxsize=1000)
def reading_of(text: str, measured: str = "") -> Reading:
    """Return the meaning of a header; `measured`: a quantity that columns have besides inputs.

    >>> reading_of("R2 (nm)")[:2], reading_of("E [J]")[:2], reading_of("surface_energy_mJ_m2")[:2]
    (('radius2', 'nm'), ('energy', 'J'), ('surface_energy', 'mJ/m2'))
    """
    if len(text) > _LONGEST:
        return Reading()
    known = words.meanings(measured)
    splits = [*_splits(text)]
    exact = next(filter(None, (_exact(split, known) for split in splits)), None)
    return exact or _of_part(splits[0].word, measured) or _refused(splits, known) or Reading()


def _splits(text: str) -> Iterator[_Split]:
    """Iterate over words and what may be their units: none, and what stands behind each place where one may begin."""
    for mark, plain in _LATEX.items():
        text = re.sub(mark, plain, text)
    text = re.sub(_QUOTED, r"\2", " ".join(composed(text).translate(_SPELT).split()))
    yield _Split(text.strip(" _."), "")
    for cut in reversed([*_CUT.finditer(text)]):
        word, unit = text[: cut.start()].rstrip(_EDGES), text[cut.end() :].strip(" _.()[]{}<>")
        if word and (unit or cut[1]) and not re.search(r"[\[({<][^\])}>]*$", word):  # in brackets there may be none
            is_mangled = not cut[1] and (text[-1] in "_." or not _PLAIN_GAP.fullmatch(cut[0]))
            yield _Split(word, unit, bool(cut[1]), is_mangled)


def _exact(split: _Split, known: Mapping[str, Meaning]) -> Reading | None:
    """Return the meaning of a word, or of a symbol, with its unit; None if it is no input, or has another unit."""
    word, unit, is_explicit, is_mangled = split
    meaning = known.get(key(word))
    stem, _, symbol = word.rpartition(" ")
    if meaning is None and is_explicit and (named := known.get(key(stem))):  # as in Young's modulus E
        of_symbol = words.symbols().get(spelt_out(symbol), Meaning())
        meaning = named if {*named.names} <= {*of_symbol.names} else None
    is_symbol = meaning is None
    if is_symbol and (is_explicit or (not is_mangled and len(squeezed(unit)) > 1 and word[:1].isalpha())):
        meaning = words.symbols().get(spelt_out(word))
    if meaning is None or not meaning.names or (unit in words.INDICES and not is_explicit):
        return None
    units = ((each, unit_for(unit, each, is_explicit=is_explicit) if unit else "") for each in meaning.names)
    name, unit_text = next((pair for pair in units if pair[1] or not unit), ("", ""))
    if not name or (is_mangled and is_in_table(f"u{unit_text}")):  # µm may have become m
        return None
    is_of_capitals = unit.istitle() or f"{word}{unit}".isupper()  # mm may have become Mm, and pN PN
    if is_of_capitals and not is_symbol and unit_text != unit_for(unit, name):
        return None
    alike = [each for each in meaning.names if NOMENCLATURE[each].unit == NOMENCLATURE[name].unit]
    is_open = meaning.has_remedy and (meaning.problem or len(alike) > 1)
    meant = [headed(each, unit_text or "UNIT") for each in alike] if is_open else ()
    is_symbol = is_symbol and not unit and not meaning.problem and name not in words.RATIOS
    return Reading(name, unit_text, "", is_symbol, meaning.problem, meant)


def _of_part(text: str, measured: str) -> Reading | None:
    """Return the meaning of a header of a part of an uncertainty, without a name if it is ± alone, if it is one."""
    plain = re.sub(words.PERCENT, "", text)
    share = "%" if plain != text else ""
    if (mark := re.search(words.PART, plain)) is None:
        return None
    word = mark[0].strip(" _.").casefold()
    part = words.PARTS.get(word, "both")
    rest = (plain[: mark.start()] + (mark[1] or "") + plain[mark.end() :]).strip(" _.")
    if rest[:1] in ("", "[", "("):
        unit = share or rest[1:-1].strip()
        is_alone = part == "both" and word not in ("σ", "sigma", "se") and (unit or not word.startswith("err"))
        return Reading(unit_text=unit, part=part) if is_alone else None
    reading = reading_of(rest, measured)
    is_value = reading.is_input and not reading.part and reading.name not in MATERIALS
    return Reading(reading.name, share or reading.unit_text, part) if is_value else None


def _refused(splits: Sequence[_Split], known: Mapping[str, Meaning]) -> Reading | None:
    """Return the refusal of a header that has the word of an input and cannot be read; None if it passes through."""
    for split in sorted(splits, key=lambda split: len(split.word), reverse=True):
        unit = re.sub(_FACTOR_OF_UNIT, "", split.unit) or split.unit
        bare = split._replace(word=re.sub(_FACTORS, "", split.word), unit=unit)
        if bare != split and (reading := _exact(bare, known)) and not reading.is_symbol:
            return Reading(reading.name, problem="a sign or a factor stands beside the word or its unit")
        word, is_slip = _word_in(split.word, known, split.unit)
        word = word or (words.with_index(split.word) if split.unit else "")
        if not word:
            continue
        meaning = known[word]
        if not meaning.names:
            return None  # another quantity
        name, is_shared = meaning.names[0], word in words.SHARED
        names = [name, NOMENCLATURE[name].twin] if not is_slip and NOMENCLATURE[name].sphere == 1 else [name]
        if split.unit and word == key(split.word):
            tail = re.findall(r"[a-z]+", _CUT.sub(" ", split.unit).casefold())
            is_label = name in MATERIALS or split.unit in words.INDICES or not words.LABELS.isdisjoint(tail)
            is_other = is_shared and not unit_for(split.unit.casefold(), name)
            if meaning.problem or ((is_label or is_other) and not split.is_explicit):
                return None
            meant = [*map(headed, names if split.is_explicit else names[:1])] if split.unit[0].isalpha() else []
            return Reading(name, problem=f"what stands behind {name} is not its unit", meant=meant)
        unit_text = unit_for(split.unit, name, is_explicit=split.is_explicit and is_in_table(split.unit))
        is_telling = is_slip and len(word) > 4 and name not in MATERIALS and not split.unit
        if (unit_text and is_slip) or ((unit_text or is_telling) and not is_shared):
            is_beside = split.is_explicit if is_slip else key(split.word).endswith(word) and not split.is_mangled
            is_open = meaning.has_remedy and words.FUNCTIONS.isdisjoint(re.findall(r"[a-z]+", split.word.casefold()))
            meant = [headed(each, (is_beside and unit_text) or "UNIT") for each in names if is_open]
            return Reading(name, problem=meaning.problem or f"it may be {name}", meant=meant)
    return None


def _word_in(text: str, known: Mapping[str, Meaning], unit: str) -> tuple[str, bool]:
    """Return the known word that a text is, one beside others in it, or that from which it differs by a slip.

    Of several, it is the longest, if possible of those that a unit fits. The second value says if it is a slip.
    """
    letters = key(text)
    if letters in known:
        return letters, False
    tokens = re.findall(r"[a-z]+[12]?", _CUT.sub(" ", ascii_text(text).replace("'", "")).casefold())
    if words.OTHERS.isdisjoint(tokens):
        runs = ("".join(tokens[first:last]) for first, last in combinations(range(len(tokens) + 1), 2))
        if every := sorted((run for run in runs if run in known), key=len):
            fitting = [run for run in every if any(unit_for(unit, name) for name in known[run].names)] if unit else []
            return (fitting or every)[-1], False
    slip = next(filter(None, map(words.slips().get, words.lacking_a_letter(letters))), "")
    return slip, bool(slip)


# --- All headers of a table -------------------------------------------------------------------------------------------

_MAX_SAID = 60  # columns that pass through and are named
_OF_DIRECTIONS = r"(?i)\s*((G|nu|ν)_?(12|13|23|xy|xz|yz)|E_?3)(?![^\W_])"
_MARKS = {"both": "± ", "minus": "− ", "plus": "+ ", "low": "from ", "high": "to "}
_ENDS = ("low", "high")
_SHAPES = (("", "both"), ("", "minus", "plus"), ("",), _ENDS)  # of the columns of a value, by part
_VALUE, _UNIT, _NO_UNIT = "value", "unit", "neither has a unit"  # kinds of cells


class Header(NamedTuple):
    """The columns of a table."""

    texts: tuple[str, ...]
    inputs: tuple[Column, ...]
    materials: tuple[Column, ...]  # that name them

    @property
    def names(self) -> frozenset[str]:
        """The names of the inputs that have columns."""
        return frozenset(column.name for column in (*self.materials, *self.inputs))

    @property
    def places(self) -> dict[str, int]:
        """The places of the columns that are read."""
        return {name: place for column in (*self.inputs, *self.materials) for name, place in column.places.items()}

    def reading(self, preamble: int = 0) -> str:
        """Return the sentence that says how the table is read. `preamble`: lines above it that are passed over."""
        sentence = f"read: {', '.join(map(self._from, (*self.materials, *self.inputs))) or 'no input'}"
        if preamble:
            sentence += f"; lines passed over before the header: {preamble}"
        used = {*self.places.values()}
        if others := [text for place, text in enumerate(self.texts) if place not in used and text.strip()]:
            sentence += f"; passed through: {first_of([*map(_easy, dict.fromkeys(others))], _MAX_SAID)}"
        return sentence

    def _from(self, column: Column) -> str:
        """Return the header of an input with those that it is read from, if they are others."""
        head, text = header_of(column.name, column.unit_text), self.texts[column.place]
        is_same = column.is_range or typed(text) in (head, column.name)
        sources = [f"{_MARKS[part]}{_easy(self.texts[place])}" for part, place in column.sides]
        return " ".join([head, *([] if is_same else [f"from {_easy(text)}"]), *sources])


def typed(text: str) -> str:
    """Return a header as it is shown and typed: on one line, with plain blanks."""
    return shown(" ".join(text.split()))


def _easy(text: str) -> str:
    """Return a header as it is shown, in quotes if it has blanks besides that before a unit in brackets."""
    text = typed(text)
    return text if " " not in text.replace(" [", "[") and "(" not in text else f'"{text}"'


def stated_meanings(texts: Iterable[str], measured: str = "") -> dict[str, str]:
    """Return what `--column` writes in place of headers: radius2 [nm] for R2 (nm), or nothing for what is no input.

    `texts`: the values of the option, as in 'R2 (nm)=radius2 [nm]'; `measured`: as `reading_of` has it. Raises
    BadRequest.
    """
    meanings: dict[str, str] = {}
    for text in texts:
        head, is_pair, meaning = map(typed, text.rpartition("="))
        if not is_pair or not head:
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
) -> Header:
    """Return the columns of a header, given the cells of its first rows.

    `stated`: what `--column` writes in place of headers; `given`: the inputs of options; `measured`: a quantity that
    columns have besides inputs. Raises BadTable.
    """
    for text in stated.keys() - {*map(typed, texts)}:
        known = first_of([*map(_easy, texts)], _MAX_SAID)
        raise BadTable(f"--column: the table has no column {quoted(text)}; it has {known}")
    heads = [meaning_of(text, [row[place] for row in rows], stated, measured) for place, text in enumerate(texts)]
    heads = [head._replace(place=place) for place, head in enumerate(_beside_others(heads, given))]
    inputs: dict[str, dict[str, Reading]] = {}  # by the part of the uncertainty, "" for the values
    for head in heads:
        name, part = (head.name, head.part) if head.is_input else ("", head.text)
        other = inputs.setdefault(name, {}).setdefault(part, head)
        if other is not head and head.text.strip():
            raise BadTable(f"header: of the columns {quoted(other.text)} and {quoted(head.text)} one must go")
    inputs.pop("", None)
    used = {name: parts for name, group in inputs.items() if (parts := _used(name, group))}
    values = [head for parts in used.values() for part, head in parts.items() if part in ("", *_ENDS)]
    # A load decides on the approach, and radii on the reduced one; but γ leaves w of two solids open.
    groups = [names for names in EXCLUSIVE if "work_of_adhesion" not in names and not used.keys().isdisjoint(names)]
    held = {*used, *chain(*groups)}
    refused = [
        head for head in heads
        if head.problem and (head.name not in held or not {meant.split()[0] for meant in head.meant} <= {*held, *given})
    ]  # fmt: skip
    refused += [head for head in map(_with_problem, values) if head.problem]
    if refused:
        raise _refusal(sorted(refused, key=lambda head: head.place))
    columns = [_column(name, parts) for name, parts in used.items()]
    materials = tuple(column for column in columns if column.name in MATERIALS)
    return Header(tuple(texts), tuple(column for column in columns if column not in materials), materials)


def meaning_of(text: str, cells: Sequence[str], stated: Mapping[str, str], measured: str) -> Reading:
    """Return the meaning of a column: that of `--column`, else that of its header, if its cells can be of it."""
    cells = [cell.strip() for cell in cells if not has_no_value(cell)]
    cell = next(iter(cells), "")
    reading = reading_of(stated.get(typed(text), text), measured)._replace(is_stated=typed(text) in stated)
    if reading.is_symbol and not reading.part:
        kinds = {_kind(each, reading.name) for each in dict.fromkeys(cells) if not is_number(each)}
        reading = Reading() if kinds.isdisjoint((_VALUE, _UNIT)) else reading
    elif key(text) in ("model", "law") and cell.casefold() in LAWS and not reading.is_stated:
        reading = Reading(problem=f"the law is an option: --model {cell.casefold()}")
    elif cell[:1].isalpha() and not reading.is_input and not reading.is_stated:
        reading = Reading()
    return reading._replace(text=text, cell=cell)


def _kind(cell: str, name: str) -> str:
    """Return the kind of a cell of an input: a value, a number that lacks a unit, a unit, or "" for no such."""
    try:
        value_of(cell, name)
    except QuantityError as error:
        return _NO_UNIT if error.reason == NO_UNIT else _UNIT if unit_for(cell.strip("[]() "), name) else ""
    return _VALUE


def _with_problem(head: Reading) -> Reading:
    """Return the head of an input, with a problem if neither it nor its first cell has the unit that it needs."""
    needs_unit = head.cell and not head.unit_text and NOMENCLATURE[head.name].unit not in ("", "1")
    if not needs_unit or (kind := _kind(head.cell, head.name)) not in (_NO_UNIT, _UNIT):
        return head
    part = f"_{head.part}" if head.part else ""
    meant = f"{head.name}{part} [{unit_for(head.cell.strip('[]() '), head.name) or 'UNIT'}]"
    return head._replace(problem=kind, meant=[meant])


def _beside_others(heads: Sequence[Reading], given: Collection[str]) -> Iterator[Reading]:
    """Iterate over heads as the others make them mean. ± alone is of the column at its left."""
    is_of_two = "radius2" in given or any(head.is_input and head.name == "radius2" for head in heads)
    moduli = [head for head in heads if head.name in ("youngs_modulus", "youngs_modulus2")]
    direction = next((head.text for head in heads if moduli and re.match(_OF_DIRECTIONS, head.text)), None)
    for left, head in zip([Reading(), *heads], heads, strict=False):
        if head.part and not head.name:
            is_value = left.is_input and not left.part and left.name not in MATERIALS
            is_of_left = is_value and (head.unit_text in ("", "%") or fits(head.unit_text, left.name))
            yield head._replace(name=left.name if is_of_left else "")
        elif direction is not None and head in moduli and not head.is_stated:
            yield head._replace(problem=f"{quoted(direction)} beside it says that it is along a direction", meant=())
        elif head.is_input and head.meant and not head.part and not is_of_two:
            yield head._replace(problem="R may be the radius of a sphere or the reduced radius")
        else:
            yield head


def _used(name: str, heads: Mapping[str, Reading]) -> dict[str, Reading]:
    """Return the heads of the columns that make the values of an input, of those by part; the others pass through.

    Raises BadTable for one that an option states and that is not used, and for half a range.
    """
    shape = next((shape for shape in _SHAPES if heads.keys() >= {*shape}), ())
    others = [head for part, head in heads.items() if part not in shape]
    is_end = "" not in heads and not heads.keys().isdisjoint(_ENDS)
    if others and (is_end or any(head.is_stated for head in others)):
        raise BadTable(
            f"header: {quoted(others[0].text)} alone is no uncertainty of {name}: values have a column of ± beside "
            "them, or two, of minus and plus; a range has low and high alone"
        )
    return {part: heads[part] for part in shape}


def _column(name: str, parts: Mapping[str, Reading]) -> Column:
    """Return the column of an input; without a unit its cells carry their own, or they are a ratio. Raises BadTable."""
    of_ratio = ("1", "-") if NOMENCLATURE[name].unit == "1" else ()
    units = {part: "" if head.unit_text in of_ratio else head.unit_text for part, head in parts.items()}
    error_unit = units.pop("both", "")
    unit_text = next(filter(None, units.values()), "")
    if not {*units.values()} <= {"", unit_text}:
        columns = listed(quoted(head.text) for head in parts.values())
        raise BadTable(f"header: the columns {columns} must have the same unit")
    unit = unit_of(unit_text, name) if unit_text else None
    sides = tuple((part, head.place) for part, head in parts.items() if part)
    first = next(iter(parts.values()))
    return Column(first.place, name, unit_text, unit, sides, error_unit if error_unit != unit_text else "")


# --- What is refused --------------------------------------------------------------------------------------------------


def _refusal(heads: Sequence[Reading]) -> BadTable:
    """Return the error of columns that may be inputs and cannot be read."""
    ways = [
        " or ".join(_option(head.text, meant) for meant in head.meant)
        or f"a column {headed(head.name)} in place of {quoted(head.text)}"
        for head in heads if head.name
    ]  # fmt: skip
    if any(head.problem == _UNIT for head in heads):
        return BadTable(f"header: the first row has units. Delete it, and write {' '.join(ways)}")
    cells = [f" (first cell {quoted(head.cell)})" if head.cell else "" for head in heads]
    problems = [f"{quoted(head.text)}{cell}: {head.problem}" for head, cell in zip(heads, cells, strict=True)]
    passing = f"{' '.join(_option(head.text, '') for head in heads)} to pass {'them' if heads[1:] else 'it'} through"
    mark = " " if all(len(head.meant) == 1 for head in heads) else "; "  # options that can be typed together
    remedies = ", or ".join(filter(None, [mark.join(ways), passing]))
    return BadTable(f"header: {'; '.join(problems)}. Write {remedies}")


def _option(text: str, meaning: str) -> str:
    """Return the option that says what a column means, in the quotes of a shell."""
    value = f"{typed(text)}={meaning}"
    within = re.sub(r'([\\$`"])', r"\\\1", value)  # of double quotes
    return f'--column "{within}"' if "'" in value else f"--column '{value}'"


def check_inputs(header: Header, measured: str = "") -> None:
    """Raise BadTable for a table of which no column is an input, or none the measured quantity."""
    if measured in header.names or (header.names and not measured):
        return
    if header.texts and all(map(is_number, header.texts)):
        raise BadTable(f"header: {quoted(header.texts[0])} is a number; begin with a line of the columns' names")
    if measured:
        raise BadTable(f"header: no column has the measured {measured}; write {_option('HEADER', headed(measured))}")
    raise BadTable(
        "header: no column is an input; a row is a contact, and its inputs have columns such as radius [nm]. "
        f"Write {_option('HEADER', 'INPUT [UNIT]')}"
    )


def is_input(text: str, measured: str = "") -> bool:
    """Return whether a header may be that of an input; a symbol without a unit is one if its cells have units."""
    reading = reading_of(text, measured)
    return reading.is_input or bool(reading.part)
