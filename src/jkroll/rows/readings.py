"""The grammar by which a header is read as an input, refused or passed through.

A header is a word with a unit, in any of a few notations: `radius [nm]`, `R2 (nm)`, `Load/nN`, `radius in nm`, `E_GPa`,
`gamma..mJ.m2.`. Words are compared by their letters and digits alone, so that `Young's modulus` and `youngsModulus` are
one; a symbol is compared as it is written, and its unit decides between the quantities that have it. What has the word
of an input and is no word with a unit is refused. All else passes through.
"""

import re
from collections.abc import Iterator, Mapping, Sequence
from functools import lru_cache
from itertools import combinations
from typing import NamedTuple

from ..quantities.nomenclature import NOMENCLATURE, header
from ..quantities.units import BadUnit, dimension_of, is_in_table, parse_unit
from ..text import ascii_text, composed
from . import words
from .sides import part_of, unit_alone
from .words import MATERIALS, key, symbol_of


class Reading(NamedTuple):
    """The meaning of a header: an input with the text of its unit; or, without a name, a column that passes through."""

    name: str = ""  # where there is a problem, of the input that it may be; "" for ± alone
    unit_text: str | None = None
    part: str = ""  # of the input's uncertainty: "both" sides, "minus", "plus", or the "low" or "high" end of a range
    is_symbol: bool = False  # without a unit: an input only if its cells have units
    problem: str = ""  # why the header is refused unless another column is this input
    meant: tuple[str, ...] = ()  # the headers that would be read, where that is certain

    @property
    def is_input(self) -> bool:
        """True for what is read."""
        return bool(self.name) and not self.problem


class _Split(NamedTuple):
    """A header as a word and what may be its unit; `is_explicit` if brackets, a mark or "in" says so."""

    word: str
    unit: str | None
    is_explicit: bool
    is_mangled: bool = False  # signs, or letters such as µ, may have become _ or .


_SPELT = str.maketrans({"’": "'", "‘": "'", "“": '"', "”": '"', "″": '"', "∕": "/", "⁄": "/", "₀": "0", "₁": "1", "₂": "2"})  # fmt: skip
_NO_BRACKETS = re.compile(r"[^\[\](){}<>]*")
_BRACKETS = re.compile(rf"({_NO_BRACKETS.pattern})[\[({{<](.*)[\])}}>][\s_.]*")
_MARK = re.compile(r"\s*[,/:;|]\s*|\s+in\s+")
_GAP = re.compile(r"[\s_.-]+|(?<=[a-z0-9])(?=[A-Z])")
_EDGES = " _.,:;/|-"
_JOINED = re.compile(r"[Ii]n(?=[A-Z])")
_IN = re.compile(rf"(?:in|IN)[\s_.]+|{_JOINED.pattern}")
_FACTORS = re.compile(r"^[\d\s.*/^+()−-]+|\s*[*/^+(−-][\d\s.()]*$|[⁰¹²³]+$")
_LONGEST = 120  # letters of a header that can be one


@lru_cache(maxsize=1000)
def reading_of(text: str) -> Reading:
    """Return the meaning of a header.

    >>> reading_of("R2 (nm)")[:2], reading_of("E [J]")[:2], reading_of("surface_energy_mJ_m2")[:2]
    (('radius2', 'nm'), ('energy', 'J'), ('surface_energy', 'mJ/m2'))
    >>> reading_of("± [nm]")[:3], reading_of("SD")[:3]
    (('', 'nm', 'both'), ('', None, 'both'))
    """
    return read(text, {})


def read(text: str, more: Mapping[str, str]) -> Reading:
    """Return the meaning of a header; `more`: further quantities by the keys of their words."""
    text = _normal(text)
    if not text or len(text) > _LONGEST:
        return Reading()
    known = {**words.meanings(), **more} if more else words.meanings()
    splits = [*_splits(text)]
    exact = next(filter(None, (_exact(split, known) for split in splits)), None)
    return exact or _of_part(text, more) or _refusal(splits, known) or Reading()


def _normal(text: str) -> str:
    """Return a header with one form of each quote, slash, index and blank."""
    return " ".join(composed(text).translate(_SPELT).split()).strip("\"' ")


def _splits(text: str) -> Iterator[_Split]:
    """Iterate over words and what may be their units: the whole, a unit in brackets, and each place where one may begin."""
    yield _Split(text.strip(" _."), None, is_explicit=True)
    if brackets := _BRACKETS.fullmatch(text):
        yield _Split(brackets[1].rstrip(_EDGES), _IN.sub("", brackets[2].strip()) or None, is_explicit=True)
    for pattern, is_explicit in ((_MARK, True), (_GAP, False)):
        for cut in reversed([*pattern.finditer(text)]):
            word, unit = text[: cut.start()].rstrip(_EDGES), text[cut.end() :].strip(" _.()[]{}")
            is_mangled = len(cut[0]) > 1 or text[-1] in "_." or bool(_JOINED.match(unit))
            if word and unit and _NO_BRACKETS.fullmatch(word):
                yield _Split(word, _IN.sub("", unit), is_explicit, is_mangled)


def _exact(split: _Split, known: Mapping[str, str]) -> Reading | None:
    """Return the meaning of a word, or of a symbol, with its unit; None if it is no input, or has another unit."""
    word, symbol = key(split.word), symbol_of(split.word)
    name = known.get(word, "")
    if name in MATERIALS:
        return Reading(name) if split.unit is None else None
    names = [name] if name else words.symbols().get(symbol, [])
    if not names or not (split.is_explicit or name or _may_follow_symbol(split)):
        return None
    doubt = words.DOUBTFUL.get(word if name else symbol)
    problem = doubt.problem if doubt else ""
    if split.unit is None:
        is_symbol = not (name or problem) and names[0] not in words.RATIOS
        return Reading(names[0], is_symbol=is_symbol, problem=problem, meant=_meant(symbol, names[0], "UNIT", problem))
    if not split.is_explicit and split.unit in words.INDICES:
        return None
    for each in names:
        unit_text = unit_for(split.unit, each, is_explicit=split.is_explicit)
        is_lost = split.is_mangled and not split.is_explicit and is_in_table(f"u{unit_text}")  # µm may have become m
        if unit_text and not is_lost:
            return Reading(each, unit_text, problem=problem, meant=_meant(symbol, each, unit_text, problem))
    return None


def _may_follow_symbol(split: _Split) -> bool:
    """Return whether what stands behind a symbol is no index, as in R_m, and the symbol is whole: E..GPa. may have been E*."""
    return len(words.squeezed(split.unit or "")) > 1 and split.word[0].isalpha() and not split.is_mangled


def _meant(symbol: str, name: str, unit_text: str, problem: str) -> tuple[str, ...]:
    """Return the headers that a doubtful one may mean. R: this program's is the reduced radius, that of tables often a sphere's."""
    if symbol == "R":
        return tuple(header(each, unit_text) for each in ("radius", "reduced_radius"))
    return (header(name, unit_text),) if problem and problem != words.SIZE else ()


def _of_part(text: str, more: Mapping[str, str]) -> Reading | None:
    """Return the meaning of a header of a part of an uncertainty; without a name if it is ± alone, None if it is none."""
    if (unit_text := unit_alone(text)) is not None:
        return Reading(unit_text=unit_text or None, part="both")
    found = part_of(text)
    reading = read(found.value, more) if found else Reading()
    if not found or not reading.is_input or reading.part or reading.name in MATERIALS:
        return None
    return Reading(reading.name, "%" if found.is_share else reading.unit_text, found.part)


# --- Refusals ---------------------------------------------------------------------------------------------------------


def _refusal(splits: Sequence[_Split], known: Mapping[str, str]) -> Reading | None:
    """Return the refusal of a header that has the word of an input and cannot be read; None if it passes through."""
    for split in sorted(splits, key=lambda split: len(split.word), reverse=True):
        core = split._replace(word=_FACTORS.sub("", split.word))
        if core != split and (reading := _exact(core, known)) and not reading.is_symbol:
            return Reading(reading.name, problem="a sign or a factor stands beside the word")
        word = _among(split.word, known)
        if word and not known[word]:
            return None  # another quantity
        if word == key(split.word) and word and split.unit:
            return _of_unit(split, word, known[word])
        word = word or _slip(split.word)
        if word and (found := _of_words(split, word, known[word])):
            return found
    return None


def _among(text: str, known: Mapping[str, str]) -> str:
    """Return the longest known word that others stand beside, or that is the whole; "" if there is none."""
    if key(text) in known:
        return key(text)
    tokens = re.findall(r"[a-z]+[12]?", _GAP.sub(" ", ascii_text(text).replace("'", "")).casefold())
    if not words.OTHERS.isdisjoint(tokens):
        return ""
    runs = ("".join(tokens[first:last]) for first, last in combinations(range(len(tokens) + 1), 2))
    return max((run for run in runs if run in known), key=len, default="")


def _slip(text: str) -> str:
    """Return the known word from which a text differs by a letter, or by the order of two; "" if there is none.

    >>> _slip("gama"), _slip("laod"), _slip("head")
    ('gamma', 'load', '')
    """
    found = (words.near().get(spelt, "") for spelt in words.lacking_a_letter(key(text)))
    return next(filter(None, found), "")


def _of_unit(split: _Split, word: str, name: str) -> Reading | None:
    """Return the refusal of the word of an input and what is not its unit; None for a label, or another quantity."""
    unit_text = split.unit or ""
    tail = re.findall(r"[a-z]+", _GAP.sub(" ", unit_text).casefold())
    is_label = name in MATERIALS or unit_text in words.INDICES or not words.LABELS.isdisjoint(tail)
    is_other = word in words.SHARED and not unit_for(unit_text.casefold(), name)
    if word in words.DOUBTFUL or ((is_label or is_other) and not split.is_explicit):
        return None
    meant = (with_unit(name),) if unit_text[0].isalpha() else ()
    return Reading(name, problem=f"what stands behind {name} is not its unit", meant=meant)


def _of_words(split: _Split, word: str, name: str) -> Reading | None:
    """Return the refusal of a word beside others, or with a slip; None if that is too little to tell."""
    is_slip = word == _slip(split.word)
    is_explicit = split.is_explicit and is_in_table(split.unit or "")
    unit_text = unit_for(split.unit, name, is_explicit=is_explicit) if split.unit and name not in MATERIALS else ""
    is_long = is_slip and len(word) > 4 and name not in MATERIALS
    is_told = (is_slip or word not in words.SHARED) if unit_text else (is_long and word not in words.SHARED)
    if not is_told or bool(split.unit) != bool(unit_text):
        return None
    if word in words.DOUBTFUL:
        return Reading(name, problem=words.DOUBTFUL[word].problem)
    is_last = is_slip or key(split.word).endswith(word)
    meant = header(name, unit_text) if unit_text and is_last else with_unit(name)
    return Reading(name, problem=f"it may be {name}", meant=(meant,))


def with_unit(name: str) -> str:
    """Return the header of an input, with the place of its unit if it needs one."""
    return f"{name} [UNIT]" if name not in MATERIALS and any(dimension_of(NOMENCLATURE[name].unit)) else name


# --- Units ------------------------------------------------------------------------------------------------------------


def fits(unit_text: str, name: str) -> bool:
    """Return whether a text is a unit of a quantity; - and 1 are those of a ratio."""
    unit = NOMENCLATURE[name].unit
    if unit == "1" and unit_text in ("1", "-"):
        return True
    try:
        return bool(unit and unit_text) and parse_unit(unit_text).dimension == dimension_of(unit)
    except BadUnit:
        return False


def unit_for(text: str, name: str, *, is_explicit: bool = False) -> str:
    """Return the unit of a quantity that a text means: as it is, or as programs and spreadsheets write a common one; else "".

    What is in no brackets is looked for in the shipped table alone: to load pint takes as long as many rows. Programs
    change capitals there, so that MN may be mN.
    """
    squeezed, is_known = words.squeezed(text), is_in_table(text)
    small = squeezed.casefold()
    is_clear = squeezed in words.common_units() or small not in words.small_units()
    units = [text] if is_explicit or (is_known and is_clear) or text in ("1", "-") else []
    if not (is_explicit and is_known):
        has_one_case = text.islower() or text.isupper()
        units += [words.common_units().get(squeezed, ""), words.small_units().get(small, "") if has_one_case else ""]
    return next((unit for unit in units if fits(unit, name)), "")


def named(text: str, name: str) -> tuple[str, str | None]:
    """Return the word of a header that means a quantity, whatever it is, and its unit; None if that is not in the header.

    >>> named("Kraft [nN]", "load"), named("F_nN", "load"), named("Size", "radius")
    (('kraft', 'nN'), ('f', 'nN'), ('size', None))
    """
    whole, *others = _splits(_normal(text))
    units = {unit_for(each.unit or "", name, is_explicit=each.is_explicit): each for each in others}
    unit_text = max(units, key=len, default="")
    return key(units[unit_text].word if unit_text else whole.word), unit_text or None
