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
from ..model.frame import EXCLUSIVE
from ..quantities.laws import LAWS
from ..quantities.nomenclature import NOMENCLATURE
from ..quantities.nomenclature import header as header_of
from ..quantities.units import PREFIXES, is_in_table
from ..quantities.values import NO_UNIT, QuantityError, unit_of, value_of
from ..text import ascii_text, composed, first_of, listed, quoted, shown
from . import words
from .cells import Column, has_no_value, is_number
from .words import MATERIALS, Meaning, fits, headed, key, spelt_out, squeezed, unit_for


class Reading(NamedTuple):
    """The meaning of a header: an input with the text of its unit; or, without a name, a column that passes through."""

    name: str = ""  # where there is a problem, of the input that it may be; "" for ± alone
    unit_text: str = ""
    part: str = ""  # of the input's uncertainty: "both" sides, "minus", "plus", the "low" or "high" end, or UNREAD
    is_symbol: bool = False  # without a unit: an input only if its cells have units
    problem: str = ""  # why the header is refused unless columns give what it may be
    meant: Sequence[str] = ()  # the headers that would be read, where that is certain
    names: Sequence[str] = ()  # the inputs that it may be of
    of: str = ""  # the header without what it says of the spread of a value
    otherwise: "Reading | None" = None  # of an UNREAD part: the meaning where that value is not read
    is_relative: bool = False  # of a part: it is of the value, even where that is in % itself
    coverage: float = 1.0  # the uncertainty in standard ones
    is_stated: bool = False  # by an option
    place: int = 0  # in a table
    text: str = ""  # the header, and the first cell below it that is not empty
    cell: str = ""

    @property
    def is_input(self) -> bool:
        """True for what is read."""
        return bool(self.name) and not self.problem


class _Split(NamedTuple):
    """A header as a word and what may be its unit."""

    word: str
    unit: str
    mark: str = "["  # the brackets, the mark or the "in" between them; empty where there is but a gap
    is_mangled: bool = False  # signs, or letters such as µ, may have become _ or .

    @property
    def is_explicit(self) -> bool:
        """True if a mark says that a unit follows."""
        return bool(self.mark)


_SPELT = str.maketrans(
    "’‘“”″∕⁄₀₁₂Ø⌀【〔「⟨«‹】〕」⟩»›\\", '\'\'"""//012DD[[[[[[]]]]]] ', "$\u00ad\u200b\u200c\u200d\u200e\u200f\ufeff"
)
UNREAD = "unread"
_SUFFIXES = ("", "%", "u", "in", "min")  # which are no units behind a word: a share, an uncertainty, inside, a minimum
_SIGNS = re.compile(r"(?<=[^\W_])\^?[+−⁺⁻-](?=$|[\s\[({<,/;:|])")  # behind a word, as in γ+ and γ- [mJ/m2]
_PLUS_MINUS = re.compile(r"\+\s?/?\s?[-−]")
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
_FACTOR_BEHIND = r"\s*(?:(?<![^\W\d_])x|[×*·/^+−-])\s*\(?\d[\d.,eE^+⁰¹²³⁴⁵⁶⁷⁸⁹⁻−-]*\)?$"  # as in radius (nm) x 10
_FACTOR_INSIDE = r"(?<![\w.^])\d[\d.]*[*·×]?(?=[^\W\d_])"  # as in w=2γ
_FACTOR = "a sign or a factor stands beside the word or its unit"
_LEFT_OVER = r"[\[(][\s_.,;%-]*[\])]|[\s_.,-]{2,}"  # where words were taken away
_SPREAD = "it may be an uncertainty of {0}, of which the columns are {0}_err, or {0}_minus and {0}_plus"
_NO_FACTOR = "it is an expanded uncertainty, and its coverage factor k is missing"
_NOT_USED = "a value has one column of ±, or two, of minus and plus; a range has those of its ends alone"
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
    text = _plain(text)
    if (unsigned := _SIGNS.sub("", text)) != text and (reading := reading_of(unsigned, measured)).is_input:
        otherwise = Reading() if reading.is_symbol or reading.part else Reading(reading.name, problem=_FACTOR)
        return Reading(
            reading.name, part=UNREAD, problem=_FACTOR, names=reading.names, of=unsigned, otherwise=otherwise
        )
    known = words.meanings(measured)
    splits = [*_splits(text)]
    exact = next(filter(None, (_exact(split, known) for split in splits)), None)
    if exact is not None:
        return exact
    of_part = _of_part(text, measured)
    if of_part.part not in ("", UNREAD):
        return of_part
    otherwise = _scaled(text, measured) or _refused(splits, known) or Reading()
    return of_part._replace(otherwise=otherwise) if of_part.part else otherwise._replace(of=of_part.of)


def _plain(text: str) -> str:
    """Return a header with one spelling of marks, blanks and brackets."""
    for mark, plain in _LATEX.items():
        text = re.sub(mark, plain, text)
    text = re.sub(_QUOTED, r"\2", " ".join(composed(text).translate(_SPELT).split()))
    return _PLUS_MINUS.sub("±", text)


def _splits(text: str) -> Iterator[_Split]:
    """Iterate over words and what may be their units: none, and what stands behind each place where one may begin."""
    yield _Split(text.strip(" _."), "")
    for cut in reversed([*_CUT.finditer(text)]):
        word, unit = text[: cut.start()].rstrip(_EDGES), text[cut.end() :].strip(" _.()[]{}<>")
        if word and (unit or cut[1]) and not re.search(r"[\[({<][^\])}>]*$", word):  # in brackets there may be none
            is_mangled = not cut[1] and (text[-1] in "_." or not _PLAIN_GAP.fullmatch(cut[0]))
            yield _Split(word, unit, cut[1] or "", is_mangled)


def _exact(split: _Split, known: Mapping[str, Meaning]) -> Reading | None:
    """Return the meaning of a word, or of a symbol, with its unit; None if it is no input, or has another unit."""
    word, unit, is_explicit, is_mangled = split.word, split.unit, split.is_explicit, split.is_mangled
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
    if unit == NOMENCLATURE[name].symbol and "[" not in split.mark:  # gravity (g) may be of any unit
        return None
    alike = [each for each in meaning.names if NOMENCLATURE[each].unit == NOMENCLATURE[name].unit]
    is_open = meaning.has_remedy and (meaning.problem or len(alike) > 1)
    meant = [headed(each, unit_text or "UNIT") for each in alike] if is_open else ()
    is_symbol = is_symbol and not unit and not meaning.problem and name not in words.RATIOS
    return Reading(name, unit_text, "", is_symbol, meaning.problem, meant, alike if is_open else ())


def _of_part(text: str, measured: str) -> Reading:
    """Return the meaning of a header that tells of the spread of a value, without a name if that is at its left.

    What is no certain form of an uncertainty is UNREAD. Of any other header, the reading has no part.
    """
    factor = re.search(words.COVERAGE, text)
    plain = re.sub(words.COVERAGE, "", text)
    bare = re.sub(words.PERCENT, "", plain)
    share = "%" if bare != plain else ""
    mark = re.search(words.PART, bare)
    if mark is None or re.search(words.LEVEL, plain):
        return _of_spread(text, measured)
    word = re.sub(r"\s+of$", "", mark[0].strip(" _.").casefold())
    part = words.PARTS.get(word, "both")
    rest = (bare[: mark.start()] + (mark[1] or "") + bare[mark.end() :]).strip(" _.")
    coverage = float(factor[1].replace(",", ".")) if factor else 1.0
    if not coverage or (re.search(words.EXPANDED, bare) and not factor):
        return _unread(rest, measured)._replace(problem=_NO_FACTOR)
    is_relative = re.fullmatch(words.RELATIVE, word, re.IGNORECASE) is not None
    is_certain = bool(share) or not is_relative
    in_brackets = re.fullmatch(r"[\[(](.*)[\])]|", rest)
    if in_brackets and _is_unit(unit := (in_brackets[1] or "").strip()):
        unit = share or unit
        is_certain &= part == "both" and word not in ("σ", "sigma", "se") and bool(unit or not word.startswith("err"))
        reading = Reading("", unit, "both") if is_certain else Reading("", unit, UNREAD, problem=_SPREAD)
        return reading._replace(coverage=coverage, is_relative=is_relative)
    reading = reading_of(rest, measured)
    is_certain &= reading.is_input and not reading.part and reading.name not in MATERIALS
    if not is_certain or (share and part != "both" and not fits(share, reading.name)):
        return _unread(rest, measured)
    of_symbol = words.symbols().get(spelt_out(rest), Meaning())
    read = Reading(reading.name, share or reading.unit_text, part, names=of_symbol.names, of=rest)
    return read._replace(coverage=coverage, is_relative=is_relative)


def _of_spread(text: str, measured: str) -> Reading:
    """Return the meaning of a header that tells of the spread of a value in a way that is not read."""
    if re.search(words.SPREAD, text):
        return _unread(text, measured, text)
    is_beside = re.search(words.SPREAD_BESIDE, text) or re.search(words.DIFFERENCE, text)
    reading = _unread(re.sub(words.DIFFERENCE, "", text), measured, text) if is_beside else Reading()
    return reading if reading.name else Reading()


def _unread(text: str, measured: str, whole: str = "") -> Reading:
    """Return the meaning of a header with words of a spread: UNREAD, of the input that the rest of it means.

    `whole`: the header itself, which is no rest of it.
    """
    rest = text
    for pattern in (words.SPREAD, words.SPREAD_BESIDE, words.FILLER, words.SHARE):
        rest = re.sub(_LEFT_OVER, " ", re.sub(pattern, " ", rest)).strip(" _.,;:-")
        for inner in (rest, rest.replace("(", "", 1).replace(")", "", 1)):  # as in SE(γ)
            reading = reading_of(inner, measured) if inner != whole else Reading()
            if reading.is_input and not reading.part and reading.name not in MATERIALS:
                names = words.symbols().get(spelt_out(inner), Meaning()).names
                return Reading(reading.name, reading.unit_text, UNREAD, problem=_SPREAD, names=names, of=inner)
    unit = rest.removeprefix("in ").strip("[]()/ ")
    if _is_unit(unit):
        return Reading(unit_text=unit, part=UNREAD, problem=_SPREAD)
    return Reading(of=rest)


def _is_unit(text: str) -> bool:
    """Return whether a text may be the unit of a column whose header names no input, or is none."""
    return text.strip() in ("", "1", "-") or is_in_table(text.strip())


def _scaled(text: str, measured: str) -> Reading | None:
    """Return the refusal of a header of an input with a factor behind it, as in radius (nm) x 10; None for others."""
    reading = reading_of(whole, measured) if (whole := re.sub(_FACTOR_BEHIND, "", text)) != text else Reading()
    is_input = reading.is_input and not reading.is_symbol
    return Reading(reading.name, problem=_FACTOR) if is_input else None


def _refused(splits: Sequence[_Split], known: Mapping[str, Meaning]) -> Reading | None:
    """Return the refusal of a header that has the word of an input and cannot be read; None if it passes through."""
    for split in sorted(splits, key=lambda split: len(split.word), reverse=True):
        unit = re.sub(_FACTOR_OF_UNIT, "", split.unit) or split.unit
        bare = split._replace(word=re.sub(_FACTORS, "", split.word), unit=unit)
        if bare != split and (reading := _exact(bare, known)) and not reading.is_symbol:
            return Reading(reading.name, problem=_FACTOR)
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
            of_body = names if split.is_explicit else names[:1]
            meant = [*map(headed, of_body)] if split.unit[0].isalpha() and all(map(words.is_like_unit, tail)) else []
            problem = f"what stands behind {name} is not its unit"
            return Reading(name, problem=problem, meant=meant, names=of_body)
        unit_text = unit_for(split.unit, name, is_explicit=split.is_explicit and is_in_table(split.unit))
        is_telling = is_slip and len(word) > 4 and name not in MATERIALS and not split.unit
        if (unit_text and is_slip) or ((unit_text or is_telling) and not is_shared):
            return _doubtful(split, word, meaning, names, unit_text, is_slip=is_slip)
    return None


def _doubtful(
    split: _Split, word: str, meaning: Meaning, names: Sequence[str], unit_text: str, *, is_slip: bool
) -> Reading:
    """Return the refusal of a header in which the word of an input stands beside others, or with a slip.

    What may make another quantity of it is no advice.
    """
    name, others = names[0], _beside(split.word, word)
    if re.search(_FACTOR_INSIDE, split.word):
        return Reading(name, problem=_FACTOR)
    problem, of_pair = meaning.problem or f"it may be {name}", words.PAIRS.get(name, "")
    is_neutral = others <= {
        *words.NEUTRAL,
        *PREFIXES,
        spelt_out(NOMENCLATURE[name].symbol.removesuffix("1")).casefold(),
    }
    if of_pair and not words.OF_PAIR.isdisjoint(others):
        names, problem, is_neutral = [name, of_pair], f"it may be {name} or {of_pair}", True
    if not meaning.has_remedy or not words.FUNCTIONS.isdisjoint(others):
        names = []
    is_whole = split.is_explicit if is_slip else key(split.word).endswith(word) and not split.is_mangled
    meant = [headed(each, (is_whole and unit_text) or "UNIT") for each in names if is_neutral]
    return Reading(name, problem=problem, meant=meant, names=names)


def _beside(text: str, word: str) -> set[str]:
    """Return the tokens of a text beside those of a word in it, or behind the first one, if that is its symbol."""
    tokens = _tokens(text)
    for first, last in combinations(range(len(tokens) + 1), 2):
        if "".join(tokens[first:last]) == word:
            return {*tokens[:first], *tokens[last:]}
    return {*tokens[1:]}


def _tokens(text: str) -> list[str]:
    """Return the words in a text, in small letters."""
    return re.findall(r"[a-z]+[12]?", _CUT.sub(" ", ascii_text(text).replace("'", "")).casefold())


def _word_in(text: str, known: Mapping[str, Meaning], unit: str) -> tuple[str, bool]:
    """Return the known word that a text is, one beside others in it, or that from which it differs by a slip.

    Of several, it is the longest, if possible of those that a unit fits. The second value says if it is a slip.
    """
    letters = key(text)
    if letters in known:
        return letters, False
    tokens = _tokens(text)
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
_HEADER_AND_INPUT = r"(.*)(?<!\(k)(?<!\(k )=(.*)"  # but for (k=2)
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
) -> Header:
    """Return the columns of a header, given the cells of its first rows.

    `stated`: what `--column` writes in place of headers; `given`: the inputs of options; `measured`: a quantity that
    columns have besides inputs. Raises BadTable.
    """
    for text in stated.keys() - {*map(typed, texts)}:
        columns_of_table = first_of([*map(_easy, texts)], _MAX_SAID)
        raise BadTable(f"--column: the table has no column {quoted(text)}; it has {columns_of_table}")
    heads = [meaning_of(text, [row[place] for row in rows], stated, measured) for place, text in enumerate(texts)]
    heads = [head._replace(place=place) for place, head in enumerate(_beside_others(heads, given))]
    inputs: dict[str, dict[str, Reading]] = {}  # by the part of the uncertainty, "" for the values
    for head in heads:
        if head.is_input and (other := inputs.setdefault(head.name, {}).setdefault(head.part, head)) is not head:
            raise _twice(other, head)
    used = {name: parts for name, group in inputs.items() if (parts := _used(name, group))}
    values = [head for parts in used.values() for part, head in parts.items() if part in ("", *_ENDS)]
    # A load decides on the approach, and radii on the reduced one; but γ leaves w of two solids open.
    groups = [each for each in EXCLUSIVE if "work_of_adhesion" not in each and not used.keys().isdisjoint(each)]
    held, known = {*used, *chain(*groups)}, {*used, *given}
    texts_of = {name: next(iter(parts.values())).text for name, parts in used.items()}
    heads = [_with_suffix(head, {**dict.fromkeys(given, ""), **texts_of}, measured) for head in heads]
    refused = [head for head in heads if head.problem and not _may_pass(head, held, known)]
    refused += [head for head in map(_with_problem, values) if head.problem]
    refused += [
        head._replace(problem=_NOT_USED, meant=())
        for name, parts in inputs.items()
        for part, head in parts.items()
        if name in known and part not in used.get(name, ())
    ]
    if refused:
        raise _refusal(sorted(refused, key=lambda head: head.place))
    columns = [_column(name, parts) for name, parts in used.items()]
    materials = tuple(column for column in columns if column.name in MATERIALS)
    return Header(tuple(texts), tuple(column for column in columns if column not in materials), materials)


def _with_suffix(head: Reading, known: Mapping[str, str], measured: str) -> Reading:
    """Return a head that is not read, with a problem if it is the word of a known input with more behind it.

    `known`: the headers of the inputs that columns give, and "" for those of options.
    """
    is_of_direction = re.match(_OF_DIRECTIONS, head.text) is not None
    if head.is_input or head.part or head.is_stated or is_of_direction or head.cell[:1].isalpha():
        return head
    for split in _splits(_plain(head.text)):
        if key(split.word) in words.meanings(measured):
            meaning = words.meanings(measured)[key(split.word)]
            if not meaning.names:
                return head  # another quantity
            names = [name for name in meaning.names if name in known and not meaning.problem]
        else:
            symbol = "" if split.is_explicit else _symbol(split.word)
            names = [name for name, text in known.items() if symbol and symbol in map(_symbol, _words(text))]
        if names and split.unit and not _is_told(split, names[0]):
            problem = head.problem if head.name == names[0] else f"what stands behind {names[0]} is not read"
            return head._replace(name=names[0], part=UNREAD, problem=problem, meant=())
    return head


def _words(text: str) -> list[str]:
    """Return what stands before each place in a header at which a unit may begin, and all of it."""
    return [split.word for split in _splits(_plain(text))]


def _symbol(word: str) -> str:
    """Return the symbol of an input, without the 1 of the first sphere; "" for another word."""
    symbol = spelt_out(word).removesuffix("1")
    return symbol if symbol in words.symbols() else ""


def _is_told(split: _Split, name: str) -> bool:
    """Return whether what stands behind the word of an input says that the column is of something else."""
    units = [each.unit for each in (split, *_splits(split.unit)) if each.unit not in _SUFFIXES]
    unit = max(filter(is_in_table, units), key=len, default="")
    is_of_other = bool(unit) and not fits(unit, name)
    return is_of_other or name in MATERIALS or not {*words.LABELS, *words.OTHERS}.isdisjoint(_tokens(split.unit))


def _may_pass(head: Reading, held: Collection[str], known: Collection[str]) -> bool:
    """Return whether a column that is not read may pass through, beside columns and options that give inputs.

    It may where these decide on what it may be. What tells more of a value that is read may not.
    """
    return head.name in held and head.part != UNREAD and {*head.names} <= {*held, *known}


def _twice(first: Reading, second: Reading) -> BadTable:
    """Return the error of two columns that say the same."""
    problem = f"header: of the columns {quoted(first.text)} and {quoted(second.text)} one must go"
    if typed(first.text) == typed(second.text):
        return BadTable(f"{problem}: rename it")
    options = " or ".join(_option(head.text, "") for head in (second, first))
    return BadTable(f"{problem}. Write {options} to pass it through")


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
    """Iterate over heads as the others make them mean."""
    is_of_two = "radius2" in given or any(head.is_input and head.name == "radius2" for head in heads)
    moduli = [head for head in heads if head.name in ("youngs_modulus", "youngs_modulus2")]
    direction = next((head.text for head in heads if moduli and re.match(_OF_DIRECTIONS, head.text)), None)
    values = {head.name: head for head in heads if head.is_input and not head.part}
    ends = [head for head in heads if head.is_input and head.part in _ENDS and values.keys().isdisjoint(head.names)]
    values = {head.name: head for head in ends} | values
    left = Reading()
    for head in heads:
        left = left if head.part else head
        if head.part or (head.of and not head.is_input):
            yield _of_value(head, left, values, given)
        elif direction is not None and head in moduli and not head.is_stated:
            yield head._replace(problem=f"{quoted(direction)} beside it says that it is along a direction", meant=())
        elif head.is_input and head.meant and not is_of_two:
            yield head._replace(problem="R may be the radius of a sphere or the reduced radius")
        elif other := _uncertain_instead(head, values):
            yield Reading(other, part=UNREAD, problem=_SPREAD.format(other), text=head.text, cell=head.cell)
        else:
            yield head


def _of_value(head: Reading, left: Reading, values: Mapping[str, Reading], given: Collection[str]) -> Reading:
    """Return a head that tells of the spread of a value, with the name of the input that the value is of.

    Without a name, it is of the column at its left. A symbol may be that of several inputs, of which one is read; and a
    column may have the name of another one, of which an option says what it means, with more behind it.
    """
    name, part = head.name, head.part
    if not head.of and not name:
        is_value = left.is_input and left.name not in MATERIALS and (part != UNREAD or is_number(head.cell or "0"))
        name = left.name if is_value and (head.unit_text in ("", "%") or fits(head.unit_text, left.name)) else ""
    elif name not in {*values, *given} and not head.is_stated:
        others = [each for each in head.names if each in values]
        name = others[0] if len(others) == 1 else name
        stems = _stems(head.of)
        for value in values.values():
            if value.is_stated and not stems.isdisjoint(_stems(value.text)):
                name, part = value.name, UNREAD
    if head.is_relative and name in values and values[name].unit_text == "%":
        part = UNREAD  # 5 % of 40 %, or 40 ± 5 %
    if part != UNREAD:
        return head._replace(name=name)
    if name not in {*values, *given}:
        return (head.otherwise or Reading())._replace(text=head.text, cell=head.cell)
    meant = [f"{_error_column(name, values)} (k=K)"] if head.problem == _NO_FACTOR and name in values else ()
    return head._replace(name=name, part=part, problem=(head.problem or _SPREAD).format(name), meant=meant)


def _error_column(name: str, values: Mapping[str, Reading]) -> str:
    """Return the header of the uncertainty of an input, in the unit of its values."""
    return headed(name, values[name].unit_text or "UNIT").replace(name, f"{name}_err", 1)


def _stems(text: str) -> set[str]:
    """Return the letters and digits of a header, and of what stands before its unit."""
    splits = [
        split for split in _splits(_plain(text)) if not split.unit or split.is_explicit or is_in_table(split.unit)
    ]
    return {re.sub(r"[\W_]+", "", split.word) for split in splits} - {""}


def _uncertain_instead(head: Reading, values: Mapping[str, Reading]) -> str:
    """Return the input whose uncertainty a head may be, as of Δγ, where it excludes the one that is read; else ""."""
    text = _plain(head.text)
    rest = re.sub(words.DIFFERENCE, "", text)
    is_difference = rest != text and head.is_input and not head.is_stated
    own = reading_of(rest).name if is_difference else ""
    return own if own in values and any({own, head.name} <= {*names} for names in EXCLUSIVE) else ""


def _used(name: str, heads: Mapping[str, Reading]) -> dict[str, Reading]:
    """Return the heads of the columns that make the values of an input, of those by part; the others pass through.

    Raises BadTable for one that an option states and that is not used, and for half a range.
    """
    shape = next((shape for shape in _SHAPES if heads.keys() >= {*shape}), ())
    others = [head for part, head in heads.items() if part not in shape]
    is_end = "" not in heads and not heads.keys().isdisjoint(_ENDS)
    if others and ((is_end and not shape) or any(head.is_stated for head in others)):
        raise BadTable(
            f"header: {quoted(others[0].text)} alone is no uncertainty of {name}: values have a column of ± beside "
            "them, or two, of minus and plus; a range has low and high alone"
        )
    return {part: heads[part] for part in shape}


def _column(name: str, parts: Mapping[str, Reading]) -> Column:
    """Return the column of an input; without a unit its cells carry their own, or they are a ratio. Raises BadTable."""
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
    sides = tuple((part, head.place) for part, head in parts.items() if part)
    first = next(iter(parts.values()))
    error_unit = error_unit if error_unit != unit_text else ""
    return Column(first.place, name, unit_text, unit, sides, error_unit, max(factors, default=1.0))


# --- What is refused --------------------------------------------------------------------------------------------------


def _refusal(heads: Sequence[Reading]) -> BadTable:
    """Return the error of columns that may be inputs and cannot be read."""
    ways = [*filter(None, map(_way, heads))]
    if any(head.problem == _UNIT for head in heads):
        return BadTable(f"header: the first row has units. Delete it, and write {' '.join(ways)}")
    texts: dict[str, list[str]] = {}  # by the problem
    for head in heads:
        cell = f" (first cell {quoted(head.cell)})" if head.cell else ""
        texts.setdefault(head.problem, []).append(f"{quoted(head.text)}{cell}")
    problems = [f"{listed(each)}: {problem}" for problem, each in texts.items()]
    passing = f"{' '.join(_option(head.text, '') for head in heads)} to pass {'them' if heads[1:] else 'it'} through"
    mark = " " if all(len(head.meant) < 2 for head in heads) else "; "  # options that can be typed together
    remedies = ", or ".join(filter(None, [mark.join(ways), passing]))
    return BadTable(f"header: {'; '.join(problems)}. Write {remedies}")


def _way(head: Reading) -> str:
    """Return what to write for a column that may be an input; "" where nothing is certain."""
    if head.meant:
        return " or ".join(_option(head.text, meant) for meant in head.meant)
    is_value = head.name and not head.part and head.problem != _FACTOR
    return f"a column {headed(head.name)} in place of {quoted(head.text)}" if is_value else ""


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
