"""The meaning of a single header: an input with its unit, a part of an uncertainty, or a possible input.

A header is a word with a unit, in one of a few notations: `radius [nm]`, `R2 (nm)`, `Load/nN`, `radius in nm`, `E_GPa`,
`gamma..mJ.m2.`. Words are compared by letters and digits only, so `Young's modulus` equals `youngsModulus`. Symbols are
compared as written, or without regard to case if a unit follows; the unit then decides between quantities that share a
symbol. A header is refused if it names an input among other words and has a unit of that input, as `mean radius (nm)`.
`unread` judges the columns of other headers.
"""

import re
from collections.abc import Iterator, Mapping, Sequence
from functools import lru_cache
from itertools import combinations
from typing import NamedTuple

from ..quantities.nomenclature import NOMENCLATURE, of_sphere
from ..quantities.units import PREFIXES, SUPERSCRIPTS, is_in_table
from ..text import ascii_text, composed, quoted
from . import error_words, words
from .unit_spellings import fits, is_like_unit, squeezed, unit_for
from .words import MATERIALS, Meaning, headed, key, spelt_out


class Reading(NamedTuple):
    """The meaning of a header: an input and the text of its unit. Without name and part, the column is not read."""

    name: str = ""  # the input, or the likeliest one if there is a problem; "" for a lone ±
    unit_text: str = ""
    part: str = ""  # part of the uncertainty: "both" sides, "minus", "plus", "low" or "high" end; UNREAD if not read
    is_symbol: bool = False  # a symbol without a unit: an input only if its cells have units
    problem: str = ""  # the reason to refuse the header, unless another column gives the input
    meant: Sequence[str] = ()  # the headers to write instead, if they are certain
    names: Sequence[str] = ()  # the possible inputs
    of: str = ""  # the header without its words for a spread
    otherwise: "Reading | None" = None  # if the part is UNREAD: the meaning in a table without a column of the value
    is_relative: bool = False  # True if a word such as RSD says that the uncertainty is relative to the value
    coverage: float = 1.0  # the coverage factor of the uncertainty
    is_stated: bool = False  # True if `--column` gives the meaning
    position: int = 0  # the position of the column in the table
    text: str = ""  # the header
    cell: str = ""  # the first cell with a value

    @property
    def is_input(self) -> bool:
        """True if the header names an input and is not refused."""
        return bool(self.name) and not self.problem


class Split(NamedTuple):
    """A header divided into a word and a possible unit."""

    word: str
    unit: str
    mark: str = "["  # the bracket, mark or "in" between word and unit; empty for a gap
    is_mangled: bool = False  # True if signs, or letters such as µ, may have become _ or .

    @property
    def is_explicit(self) -> bool:
        """True if a mark shows that a unit follows."""
        return bool(self.mark)


_SPELT = str.maketrans(
    "’‘“”″∕⁄₀₁₂Ø⌀【〔「⟨«‹】〕」⟩»›\\", '\'\'"""//012DD[[[[[[]]]]]] ', "$\u00ad\u200b\u200c\u200d\u200e\u200f\ufeff"
)
UNREAD = "unread"
_SUFFIXES = ("", "%", "u", "in", "min")  # suffixes that are not units: percentage, uncertainty, inside, minimum
_SIGNS = re.compile(r"(?<=[^\W_])\^?[+−⁺⁻-](?=$|[\s\[({<,/;:|])")
_PLUS_MINUS = re.compile(r"\+\s?/?\s?[-−]")
_ACCENTS = "[\u0300\u0301\u0303\u0308\u0327]"  # of à, é, ñ, ö, ç
# As in $R_{1}$ [$\mu$m]; `_SPELT` then removes $ and replaces \ by a blank.
_LATEX = {r"\\mu\$?\s?": "µ", r"(?<=[_^])\{([^{}]*)\}": r"\1"}
# A unit may begin after a mark (the first group), or after a gap.
_CUT = re.compile(
    r"([\s_.-]*[,/:;|\[({<=@~–—•·]\s*(?:in[\s_.]+)?|\s+in\s+)"
    r"|(?:[\s_.-]+|(?<=[a-z0-9])(?=[A-Z]))(?:(?:in|IN)[\s_.]+|[Ii]n(?=[A-Z]))?"
)
_ACRONYM = r"(?<=[A-Z]{3})(?=[A-Z][a-z]{3})"  # as in DMTModulus
_PLAIN_GAP = re.compile(r"(?:[\s_.-]?|\s-\s)(?:(?:in|IN)[\s_.])?")
_QUOTED = r"^([\"'])\s*(.*?)\s*\1$"
_UNNAMED = r"^Unnamed: \d+$"  # pandas' name for an empty header
_EDGES = " _.,:;/|-·"
_FACTORS = r"^[\d\s.*/^+()−-]+|\s*[*/^+(−-][\d\s.()]*(?:(?<=\d)[eE][+-]?\d+)?$|[⁰¹²³]+$"
_FACTOR_BEHIND = r"\s*(?:(?<![^\W\d_])x|[×*·/^+−-])\s*\(?\d[\d.,eE^+⁰¹²³⁴⁵⁶⁷⁸⁹⁻−-]*\)?$"  # as in radius (nm) x 10
FACTOR_INSIDE = r"(?<![\w.^])\d[\d.]*[*·×]?(?=[^\W\d_])"  # as in w=2γ
FACTOR = "the name of the quantity or its unit has a sign or a factor"
_LEFT_OVER = r"[\[(][\s_.,;%-]*[\])]|[\s_.,-]{2,}"  # brackets and blanks around removed words
SPREAD = "it may be an uncertainty of {0}; if so, name it {0}_err, or {0}_minus and {0}_plus"
NO_FACTOR = "it is an expanded uncertainty, and its coverage factor k is missing"
FACTOR_OF_UNIT = r"^[x×*]?\s*\d[\d.]*\s*(?:[eE^×*]*\s*[-+−⁻]?[\d⁰¹²³⁴⁵⁶⁷⁸⁹]+\s*)*[×*·]?\s*"  # as in 10^-20 J
_PREFIXES = {"-12": "p", "-9": "n", "-6": "u", "-3": "m", "3": "k", "6": "M", "9": "G"}  # by the power of ten
_LONGEST = 120  # characters; a longer text is not the header of an input


@lru_cache(maxsize=1000)
def reading_of(text: str, measured: str = "") -> Reading:
    """Return the meaning of a header. `measured`: quantities, separated by commas, that are read in addition to inputs.

    >>> reading_of("R2 (nm)")[:2], reading_of("E [J]")[:2], reading_of("surface_energy_mJ_m2")[:2]
    (('radius2', 'nm'), ('energy', 'J'), ('surface_energy', 'mJ/m2'))
    """
    if len(text) > _LONGEST:
        return Reading()
    text = normalized(text)
    signed = _signed(text, measured)
    if signed is not None:
        return signed
    known = words.meanings(measured)
    splits = [*splits_of(text)]
    for split in splits:
        exact = _exact(split, known)
        if exact is not None:
            return exact
    of_part = _of_part(text, measured)
    if of_part.part not in ("", UNREAD):
        return of_part
    otherwise = _scaled(text, measured) or _refused(splits, known) or Reading()
    return of_part._replace(otherwise=otherwise) if of_part.part else otherwise._replace(of=of_part.of)


def _signed(text: str, measured: str) -> Reading | None:
    """Return the refusal of an input's header with a sign after a word, as in γ+ and γ- [mJ/m2]; else None."""
    unsigned = _SIGNS.sub("", text)
    reading = reading_of(unsigned, measured) if unsigned != text else Reading()
    if not reading.is_input:
        return None
    otherwise = Reading() if reading.is_symbol or reading.part else Reading(reading.name, problem=FACTOR)
    return Reading(reading.name, part=UNREAD, problem=FACTOR, names=reading.names, of=unsigned, otherwise=otherwise)


def normalized(text: str) -> str:
    """Return a header without accents, and with a single form of its marks, blanks and brackets; "" for Unnamed: 2."""
    text = decoded(text)
    for mark, plain in _LATEX.items():
        text = re.sub(mark, plain, text)
    text = re.sub(_QUOTED, r"\2", " ".join(without_accents(composed(text)).translate(_SPELT).split()))
    return _PLUS_MINUS.sub("±", re.sub(_UNNAMED, "", text))


def without_accents(text: str) -> str:
    """Return a text without the accents of à, é, ñ, ö and ç, and with ss for ß; rings and circumflexes stay (Å, â).

    >>> without_accents("Oberflächenenergie"), without_accents("densité"), without_accents("Stoßenergie (Å)")
    ('Oberflachenenergie', 'densite', 'Stossenergie (Å)')
    """
    if text.isascii():
        return text
    from unicodedata import normalize

    return normalize("NFC", re.sub(_ACCENTS, "", normalize("NFD", text))).replace("ß", "ss")


def decoded(text: str) -> str:
    r"""Return a header as it was before a program read its UTF-8 as cp1252 or Latin-1; other headers are unchanged.

    >>> decoded("Î³ (mJ/mÂ²)"), decoded("Ï\x81"), decoded("γ (eV/Å²)"), decoded("Å²")
    ('γ (mJ/m²)', 'ρ', 'γ (eV/Å²)', 'Å²')
    """
    if text.isascii() or "Å" in text:  # Å² would become another letter, and no Greek letter or unit is misread as Å
        return text
    try:
        return b"".join(letter.encode("latin-1" if letter <= "ÿ" else "cp1252") for letter in text).decode()
    except UnicodeError:
        return text


def splits_of(text: str) -> Iterator[Split]:
    """Iterate over the ways to divide a header: without a unit, and at each position where a unit may begin."""
    yield Split(text.strip(" _."), "")
    if len(text) > _LONGEST:
        return
    for cut in reversed([*_CUT.finditer(text)]):
        word, unit = text[: cut.start()].rstrip(_EDGES), text[cut.end() :].strip(" _.()[]{}<>")
        if word and (unit or cut[1]) and not re.search(r"[\[({<][^\])}>]*$", word):  # not within brackets
            is_mangled = not cut[1] and (text[-1] in "_." or not _PLAIN_GAP.fullmatch(cut[0]))
            yield Split(word, unit, cut[1] or "", is_mangled)


def _exact(split: Split, known: Mapping[str, Meaning]) -> Reading | None:
    """Return the meaning of a word or a symbol with its unit; None if it is not an input, or the unit does not fit."""
    word, unit, is_explicit, is_mangled = split.word, split.unit, split.is_explicit, split.is_mangled
    if not is_explicit and re.search(r"[\s_.][\[({<]", unit):
        return None  # the unit is at the end: N in P_n {N}
    if key(word) not in known and words.with_symbol(word) is None:
        word = words.without_body(word)
    meaning = known.get(key(word))
    stem, _, symbol = word.rpartition(" ")
    if meaning is None and is_explicit and key(stem) in known:  # as in Young's modulus E
        of_symbol = words.symbols().get(spelt_out(symbol), Meaning())
        if {*known[key(stem)].names} <= {*of_symbol.names}:
            meaning = known[key(stem)]
    is_symbol = meaning is None
    is_whole = not is_mangled or word[-1:].isdigit()  # E..GPa. may be E* or E'
    if is_symbol and (is_explicit or (is_whole and len(squeezed(unit)) > 1 and word[:1].isalpha())):
        meaning = words.with_symbol(word) if unit else words.symbols().get(spelt_out(word))
    if meaning is None or not meaning.names or (unit in words.INDICES and not is_explicit):
        return None
    name, unit_text = "", ""
    for possible in meaning.names:
        text_of_unit = unit_for(unit, possible, is_explicit=is_explicit) if unit else ""
        if text_of_unit or not unit:
            name, unit_text = possible, text_of_unit
            break
    if not name or (is_mangled and is_in_table(f"u{unit_text}")):  # µm may have become m
        return None
    is_of_capitals = unit.istitle() or f"{word}{unit}".isupper()  # mm may have become Mm, or pN may have become PN
    if is_of_capitals and not is_symbol and unit_text != unit_for(unit, name):
        return None
    if unit == NOMENCLATURE[name].symbol and "[" not in split.mark:  # in gravity (g), g is the symbol, not the unit
        return None
    alike = [each for each in meaning.names if NOMENCLATURE[each].unit == NOMENCLATURE[name].unit]
    is_open = meaning.has_remedy and (meaning.problem or len(alike) > 1)
    meant = [headed(each, unit_text or "UNIT") for each in alike] if is_open else ()
    is_symbol = is_symbol and not unit and not meaning.problem and name not in words.RATIOS
    return Reading(name, unit_text, "", is_symbol, meaning.problem, meant, alike if is_open else ())


def _of_part(text: str, measured: str) -> Reading:
    """Return the meaning of a header about a spread (an uncertainty or a range), without a name if it names no value.

    A notation that is not clearly an uncertainty is UNREAD. A header that is not about a spread has no part.
    """
    factor = re.search(error_words.COVERAGE, text)
    plain = re.sub(error_words.COVERAGE, "", text)
    bare = re.sub(error_words.PERCENT, "", plain)
    share = "%" if bare != plain else ""
    mark = re.search(error_words.PART, bare)
    if mark is None or re.search(error_words.LEVEL, plain):
        return _of_spread(text, measured)
    word = re.sub(rf"\s+{error_words.OF}$", "", mark[0].strip(" _.").casefold())
    part = error_words.PARTS.get(word, "both")
    rest = (bare[: mark.start()] + (mark[1] or "") + bare[mark.end() :]).strip(" _.")
    coverage = float(factor[1].replace(",", ".")) if factor else 1.0
    if not coverage or (re.search(error_words.EXPANDED, bare) and not factor):
        return _unread(rest, measured)._replace(problem=NO_FACTOR)
    is_relative = re.fullmatch(error_words.RELATIVE, word, re.IGNORECASE) is not None
    is_certain = bool(share) or not is_relative
    in_brackets = re.fullmatch(r"[\[(](.*)[\])]|", rest)
    if in_brackets and _is_unit(in_brackets[1] or ""):
        unit = share or (in_brackets[1] or "").strip()
        is_vague = word in ("σ", "sigma", "se") or (not unit and word.startswith(("err", "fehler")))
        is_certain &= part == "both" and not is_vague
        reading = Reading("", unit, "both") if is_certain else Reading("", unit, UNREAD, problem=SPREAD)
        return reading._replace(coverage=coverage, is_relative=is_relative)
    reading = reading_of(rest, measured)
    is_certain &= reading.is_input and not reading.part and reading.name not in MATERIALS
    if not is_certain or (share and part != "both" and not fits(share, reading.name)):
        return _unread(rest, measured)
    of_symbol = words.symbols().get(spelt_out(rest), Meaning())
    read = Reading(reading.name, share or reading.unit_text, part, names=of_symbol.names, of=rest)
    return read._replace(coverage=coverage, is_relative=is_relative)


def _of_spread(text: str, measured: str) -> Reading:
    """Return the meaning of a header about a spread that is not read; other headers have no name and no part."""
    if re.search(error_words.SPREAD, text):
        return _unread(text, measured, text)
    is_beside = re.search(error_words.SPREAD_BESIDE, text) or re.search(error_words.DIFFERENCE, text)
    reading = _unread(re.sub(error_words.DIFFERENCE, "", text), measured, text) if is_beside else Reading()
    return reading if reading.name else Reading()


def _unread(text: str, measured: str, whole: str = "") -> Reading:
    """Return the reading of a header about a spread: UNREAD, with the input or the unit that its other words give.

    If they give neither, the reading has no part: it only keeps the other words. `whole`: the whole header,
    which is not read again.
    """
    rest = text
    for pattern in (error_words.SPREAD, error_words.SPREAD_BESIDE, error_words.FILLER, error_words.SHARE):
        rest = re.sub(_LEFT_OVER, " ", re.sub(pattern, " ", rest)).strip(" _.,;:-")
        for word in (rest, rest.replace("(", "", 1).replace(")", "", 1)):  # as in SE(γ)
            reading = reading_of(word, measured) if word != whole else Reading()
            if reading.is_input and not reading.part and reading.name not in MATERIALS:
                names = words.symbols().get(spelt_out(word), Meaning()).names
                return Reading(reading.name, reading.unit_text, UNREAD, problem=SPREAD, names=names, of=word)
    unit = rest.removeprefix("in ").strip("[]()/ ")
    if _is_unit(unit):
        return Reading(unit_text=unit, part=UNREAD, problem=SPREAD)
    return Reading(of=rest)


def _is_unit(text: str) -> bool:
    """Return whether a text is empty, or may be the unit of a column whose header names no input."""
    return text.strip() in ("", "1", "-") or is_in_table(text.strip())


def _scaled(text: str, measured: str) -> Reading | None:
    """Return the refusal of an input's header with a factor at its end, as in radius (nm) x 10; else None."""
    whole = re.sub(_FACTOR_BEHIND, "", text)
    reading = reading_of(whole, measured) if whole != text else Reading()
    is_input = reading.is_input and not reading.is_symbol
    return Reading(reading.name, problem=FACTOR) if is_input else None


def _refused(splits: Sequence[Split], known: Mapping[str, Meaning]) -> Reading | None:
    """Return the refusal of a header that contains a word for an input but cannot be read; None if it may pass."""
    for split in sorted(splits, key=lambda split: len(split.word), reverse=True):
        with_factor = _with_factor(split, known)
        if with_factor is not None:
            return with_factor
        word, is_slip = _word_in(split.word, known, split.unit)
        word = word or (words.with_index(split.word) if split.unit else "")
        if not word:
            continue
        meaning = known[word]
        if not meaning.names:
            return None  # another quantity
        name, is_shared = meaning.names[0], word in words.SHARED
        if name == "radius" and words.is_of_asperity(plain_words(split.word)):
            name = "asperity_radius"
        behind = re.findall(r"[a-z]{3,}|(?<=[#(])[12]", split.unit.casefold())  # as in modulus of the wall, GPa
        sphere = words.sphere_of(words.tokens_of(split.word)) or words.sphere_of(behind)
        name = of_sphere(sphere, name) if sphere else name
        # A "large sphere" may be sphere 1 or 2, so its radius may be R1 or R2. Its other quantities are of sphere 1.
        is_size = name in ("radius", "diameter") and "1" not in split.word
        is_either = is_size and not _beside(split.word, word) <= words.NEUTRAL
        is_open = (not sphere or (sphere == 1 and is_either)) and not is_slip and NOMENCLATURE[name].sphere == 1
        names = [name, NOMENCLATURE[name].twin] if is_open else [name]
        if meaning.names[1:]:
            names = [of_sphere(sphere, each) if sphere else each for each in meaning.names]
        if split.unit and word == key(split.word):
            unit_words = re.findall(r"[a-z]+", _CUT.sub(" ", split.unit).casefold())
            is_label = name in MATERIALS or split.unit in words.INDICES or not words.LABELS.isdisjoint(unit_words)
            is_other = is_shared and not unit_for(split.unit.casefold(), name)
            if meaning.problem or ((is_label or is_other) and not split.is_explicit):
                return None
            of_body = names if split.is_explicit else names[:1]
            may_be_unit = split.unit[0].isalpha() and all(map(is_like_unit, unit_words))
            meant = [*map(headed, of_body)] if may_be_unit else []
            problem = f"the text after {quoted(split.word)} is not its unit"
            return Reading(name, problem=problem, meant=meant, names=of_body)
        unit_text = unit_for(split.unit, name, is_explicit=split.is_explicit and is_in_table(split.unit))
        is_telling = is_slip and len(word) > 4 and name not in MATERIALS and not split.unit
        if (unit_text and is_slip) or ((unit_text or is_telling) and not is_shared):
            return _doubtful(split, word, meaning, names, unit_text, is_slip=is_slip)
    return None


def _with_factor(split: Split, known: Mapping[str, Meaning]) -> Reading | None:
    """Return the refusal of an input's header whose word or unit has a factor, as in A [10^-20 J]; else None."""
    unit = re.sub(FACTOR_OF_UNIT, "", split.unit) or split.unit
    without_factor = split._replace(word=re.sub(_FACTORS, "", split.word), unit=unit)
    reading = _exact(without_factor, known) if without_factor != split else None
    if reading is None or reading.is_symbol:
        return None
    unit = _with_prefix(split.unit) if split.is_explicit and without_factor.word == split.word else ""
    meant = [headed(reading.name, unit)] if fits(unit, reading.name) else ()
    numbered = re.search(r"\(([12])\)$", split.word)  # as in R(2)
    name = of_sphere(int(numbered[1]), reading.name) if numbered else reading.name
    return Reading(name, problem=FACTOR, meant=meant)


def _with_prefix(unit: str) -> str:
    """Return the unit that a power of ten and a basic unit make, as nm for 10^-9 m; "" for any other text."""
    found = re.fullmatch(r"[x×]?10\^?([-−⁻]?[\d⁰¹²³⁴⁵⁶⁷⁸⁹]{1,2}) ?(m|N|J|Pa)", unit)
    prefix = _PREFIXES.get(found[1].translate(SUPERSCRIPTS).replace("−", "-"), "") if found else ""
    return f"{prefix}{found[2]}" if found and prefix else ""


def _doubtful(
    split: Split, word: str, meaning: Meaning, names: Sequence[str], unit_text: str, *, is_slip: bool
) -> Reading:
    """Return the refusal of a header in which a word for an input is misspelt, or stands next to other words.

    The refusal suggests no header if the other words may mean another quantity.
    """
    name, others = names[0], _beside(split.word, word)
    if re.search(FACTOR_INSIDE, split.word):
        return Reading(name, problem=FACTOR)
    problem, of_pair = meaning.problem or f"it may be {name}", words.PAIRS.get(name, "")
    is_neutral = others <= {
        *words.NEUTRAL,
        *PREFIXES,
        spelt_out(NOMENCLATURE[name].symbol.removesuffix("1")).casefold(),
    }
    is_difference = name == "surface_energy" and not others.isdisjoint(("d", "delta"))  # Δγ is w
    if of_pair and (is_difference or words.is_of_pair(others)):
        names, problem, is_neutral = [name, of_pair], f"it may be {name} or {of_pair}", True
    elif words.is_of_pair(others):
        names = names[:1]  # an equivalent diameter is not one of sphere 2
    if not meaning.has_remedy or not words.FUNCTIONS.isdisjoint(others):
        names = []
    is_last = key(split.word).endswith(word) and not split.is_mangled and not is_slip
    is_whole = split.is_explicit or is_last
    unit_meant = unit_text if is_whole and unit_text else "UNIT"
    meant = [headed(each, unit_meant) for each in names] if is_neutral else []
    return Reading(name, problem=problem, meant=meant, names=names)


def _beside(text: str, word: str) -> set[str]:
    """Return the words of a header other than a known word; a misspelt word is taken to be the first one."""
    tokens = plain_words(text)
    for first, last in combinations(range(len(tokens) + 1), 2):
        if "".join(tokens[first:last]) == word:
            return {*tokens[:first], *tokens[last:]}
    return {*tokens[1:]}


def plain_words(text: str) -> list[str]:
    """Return the words of a text in lower case; the only numbers are 1 and 2 directly after a word."""
    parted = re.sub(_ACRONYM, " ", _CUT.sub(" ", ascii_text(text).replace("'", "")))
    return re.findall(r"[a-z]+[12]?", parted.casefold())


def _word_in(text: str, known: Mapping[str, Meaning], unit: str) -> tuple[str, bool]:
    """Return the known word in a text, alone, among other words or misspelt, and whether it is misspelt.

    The word is "" if there is none. The longest known word counts, preferably among those that fit the unit.
    """
    letters = key(text)
    if letters in known:
        return letters, False
    tokens = plain_words(text)
    if words.OTHERS.isdisjoint(tokens):
        found, fitting = [], []
        for first, last in combinations(range(len(tokens) + 1), 2):
            word = "".join(tokens[first:last])
            if word in known:
                found.append(word)
                if unit and any(unit_for(unit, name) for name in known[word].names):
                    fitting.append(word)
        if found:
            return sorted(fitting or found, key=len)[-1], False
    slips = [*filter(None, map(words.slips().get, words.lacking_a_letter(letters)))]
    if not slips or letters[1:] == slips[0]:  # dgamma is Δγ
        return "", False
    return slips[0], True


# --- Comparison of headers --------------------------------------------------------------------------------------------


def words_in(text: str) -> list[str]:
    """Return a header, and the words before each position in it where a unit may begin."""
    return [split.word for split in splits_of(normalized(text))]


def symbol_of(word: str) -> str:
    """Return the symbol of an input, without the 1 of sphere 1; "" if the word is not a symbol of an input."""
    symbol = spelt_out(word).removesuffix("1")
    return symbol if symbol in words.symbols() else ""


def means_other(split: Split, name: str) -> bool:
    """Return whether the text after the name of an input shows that the column is another quantity.

    Any text does so after the name of a material.
    """
    units = [each.unit for each in (split, *splits_of(split.unit)) if each.unit not in _SUFFIXES]
    unit = max(filter(is_in_table, units), key=len, default="")
    is_of_other = bool(unit) and not fits(unit, name)
    return is_of_other or name in MATERIALS or not {*words.LABELS, *words.OTHERS}.isdisjoint(plain_words(split.unit))


def stems_of(text: str) -> set[str]:
    """Return the stems of a header: the letters and digits of the whole, and of the words before a unit."""
    stems = set()
    for split in splits_of(normalized(text)):
        if not split.unit or split.is_explicit or is_in_table(split.unit):
            stems.add(re.sub(r"[\W_]+", "", split.word))
    return stems - {""}


def unit_in(text: str, name: str) -> str:
    """Return the unit of a quantity in a header; "" if the header has no such unit."""
    for split in splits_of(normalized(text)):
        if split.unit and (unit := unit_for(split.unit, name, is_explicit=split.is_explicit)):
            return unit
    return ""
