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
from types import MappingProxyType
from typing import NamedTuple

from ..quantities.nomenclature import NOMENCLATURE
from ..quantities.units import is_in_table
from ..text import ascii_text, composed
from . import words
from .words import DOUBTFUL, MATERIALS, PARTS, SHARED, Doubt, key, squeezed, symbol_of, unit_for, with_unit


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
    unit: str
    is_explicit: bool = True
    is_mangled: bool = False  # signs, or letters such as µ, may have become _ or .


_SPELT = str.maketrans("’‘“”″∕⁄₀₁₂Ø⌀", '\'\'"""//012DD')
_BRACKETS = re.compile(r"([^\[\](){}<>]*)[\[({<](?:in[\s_.]+)?(.*)[\])}>][\s_.]*", re.IGNORECASE)
_MARK = re.compile(r"\s*[,/:;|]\s*|\s+in\s+")
_GAP = re.compile(r"(?:[\s_.-]+|(?<=[a-z0-9])(?=[A-Z]))(?:(?:in|IN)[\s_.]+|[Ii]n(?=[A-Z]))?")
_PLAIN_GAP = re.compile(r"[\s_.-]?(?:(?:in|IN)[\s_.])?")
_EDGES = " _.,:;/|-"
_FACTORS = r"^[\d\s.*/^+()−-]+|\s*[*/^+(−-][\d\s.()]*$|[⁰¹²³]+$"
_LONGEST = 120  # letters of a header that can be one
# Of an uncertainty. The patterns are made when a header is first held against them: most tables need none.
_SHARE = r"(?i)[\s_.,/]*[\[(]?(?:%|percent|pct)[\])]?"  # of the value
_ERROR = "|".join(
    [
        r"(?:standard|std?)[\s_.]*dev(?:iation)?\.?",
        *(word for word in PARTS if PARTS[word] == "both" and word.isalpha()),
    ]
)
_PART = (
    rf"(?i)^(?:u|σ|sigma)\s*\(([^()]+)\)|^(?:±|\+/?-)|^(?:σ|sigma|{_ERROR})(?:\s+of)?(?=$|[\s_(\[])"
    rf"|[\s_.]*(?:±|\+/?-)(?=$|[\s_.,/(\[])|[\s_.]+(?:{_ERROR}|{'|'.join(filter(str.isalpha, PARTS))})(?=$|[\s_.,/(\[])"
)


@lru_cache(maxsize=1000)
def reading_of(text: str) -> Reading:
    """Return the meaning of a header.

    >>> reading_of("R2 (nm)")[:2], reading_of("E [J]")[:2], reading_of("surface_energy_mJ_m2")[:2]
    (('radius2', 'nm'), ('energy', 'J'), ('surface_energy', 'mJ/m2'))
    >>> reading_of("± [nm]")[:3], reading_of("SD")[:3], reading_of("u(E) (%)")[:3]
    (('', 'nm', 'both'), ('', None, 'both'), ('youngs_modulus', '%', 'both'))
    """
    return read(text)


def read(text: str, more: Mapping[str, str] = MappingProxyType({})) -> Reading:
    """Return the meaning of a header; `more`: further quantities by the keys of their words."""
    text = _normal(text)
    if not text or len(text) > _LONGEST:
        return Reading()
    known = {**words.meanings(), **more} if more else words.meanings()
    splits = [*_splits(text)]
    exact = next(filter(None, (_exact(split, known) for split in splits)), None)
    return exact or _of_part(text, more) or _refusal(splits, known) or Reading()


def named(text: str, name: str) -> tuple[str, str | None]:
    """Return the word of a header that means a quantity, whatever it is, and its unit; None if it has none.

    >>> named("Kraft [nN]", "load"), named("F_nN", "load"), named("Size", "radius")
    (('kraft', 'nN'), ('f', 'nN'), ('size', None))
    """
    whole, *others = _splits(_normal(text))
    units = {unit_for(split.unit, name, is_explicit=split.is_explicit): split.word for split in others}
    unit_text = max(units, key=len, default="")
    return key(units[unit_text] if unit_text else whole.word), unit_text or None


def _normal(text: str) -> str:
    """Return a header with one form of each quote, slash, index and blank."""
    return " ".join(composed(text).translate(_SPELT).split()).strip("\"' ")


def _splits(text: str) -> Iterator[_Split]:
    """Iterate over words and what may be their units: none, one in brackets, and each place where one may begin."""
    yield _Split(text.strip(" _."), "")
    if brackets := _BRACKETS.fullmatch(text):
        yield _Split(brackets[1].rstrip(_EDGES), brackets[2].strip())
    for pattern in (_MARK, _GAP):
        for cut in reversed([*pattern.finditer(text)]):
            word, unit = text[: cut.start()].rstrip(_EDGES), text[cut.end() :].strip(" _.()[]{}")
            is_mangled = pattern is _GAP and (text[-1] in "_." or not _PLAIN_GAP.fullmatch(cut[0]))
            if word and unit and not re.search(r"[\[\](){}<>]", word):
                yield _Split(word, unit, pattern is _MARK, is_mangled)


def _exact(split: _Split, known: Mapping[str, str]) -> Reading | None:
    """Return the meaning of a word, or of a symbol, with its unit; None if it is no input, or has another unit."""
    word, (_, unit, is_explicit, is_mangled) = key(split.word), split
    name = known.get(word, "")
    if name in MATERIALS:
        return None if unit else Reading(name)
    if not name:  # a symbol is whole, and what stands behind it is no index as in R_m
        word = symbol_of(split.word)
        if not is_explicit and (is_mangled or len(squeezed(unit)) < 2 or not split.word[:1].isalpha()):
            return None
    names = [name] if name else words.symbols().get(word, [])
    if not names or (not is_explicit and unit in words.INDICES):
        return None
    doubt = DOUBTFUL.get(word, Doubt())
    if not unit:
        is_symbol = not name and not doubt.problem and names[0] not in words.RATIOS
        return Reading(names[0], None, "", is_symbol, doubt.problem, tuple(map(with_unit, doubt.meant)))
    for each in names:
        unit_text = unit_for(unit, each, is_explicit=is_explicit)
        is_lost = is_mangled and is_in_table(f"u{unit_text}")  # µm may have become m
        if unit_text and not is_lost:
            meant = tuple(with_unit(name, unit_text) for name in doubt.meant)
            return Reading(each, unit_text, problem=doubt.problem, meant=meant)
    return None


def _of_part(text: str, more: Mapping[str, str]) -> Reading | None:
    """Return the meaning of a header of a part of an uncertainty, without a name if it is ± alone, if it is one."""
    plain = re.sub(_SHARE, "", text)
    is_share = plain != text
    if (mark := re.search(_PART, plain)) is None:
        return None
    word = mark[0].strip(" _.").casefold()
    part = PARTS.get(word, "both")
    rest = (plain[: mark.start()] + (mark[1] or "") + plain[mark.end() :]).strip(" _.")
    if rest[:1] in ("", "[", "("):
        unit = "%" if is_share else rest[1:-1].strip()
        is_alone = part == "both" and word not in ("σ", "sigma", "se") and (unit or not word.startswith("err"))
        return Reading(unit_text=unit or None, part=part) if is_alone else None
    reading = read(rest, more)
    if not reading.is_input or reading.part or reading.name in MATERIALS:
        return None
    return Reading(reading.name, "%" if is_share else reading.unit_text, part)


# --- Refusals ---------------------------------------------------------------------------------------------------------


def _refusal(splits: Sequence[_Split], known: Mapping[str, str]) -> Reading | None:
    """Return the refusal of a header that has the word of an input and cannot be read; None if it passes through."""
    for split in sorted(splits, key=lambda split: len(split.word), reverse=True):
        bare = split._replace(word=re.sub(_FACTORS, "", split.word))
        if bare != split and (reading := _exact(bare, known)) and not reading.is_symbol:
            return Reading(reading.name, problem="a sign or a factor stands beside the word")
        word, is_slip = _word_in(split.word, known)
        if not word:
            continue
        name, is_shared = known[word], word in SHARED
        if not name:
            return None  # another quantity
        if split.unit and word == key(split.word):
            tail = re.findall(r"[a-z]+", _GAP.sub(" ", split.unit).casefold())
            is_label = name in MATERIALS or split.unit in words.INDICES or not words.LABELS.isdisjoint(tail)
            is_other = is_shared and not unit_for(split.unit.casefold(), name)
            if word in DOUBTFUL or ((is_label or is_other) and not split.is_explicit):
                return None
            unit = (with_unit(name),) if split.unit[0].isalpha() else ()
            return Reading(name, problem=f"what stands behind {name} is not its unit", meant=unit)
        is_explicit = split.is_explicit and is_in_table(split.unit)
        unit_text = "" if name in MATERIALS else unit_for(split.unit, name, is_explicit=is_explicit)
        is_telling = is_slip and len(word) > 4 and name not in MATERIALS and not is_shared
        if (unit_text and (is_slip or not is_shared)) or (is_telling and not split.unit):
            is_whole = unit_text and (is_slip or key(split.word).endswith(word))
            both = (name, f"{name}2") if not is_slip and f"{name}2" in NOMENCLATURE else (name,)  # of which sphere?
            remedies = (with_unit(each, unit_text) if is_whole else with_unit(each) for each in both)
            meant = () if word in DOUBTFUL else tuple(remedies)
            problem = DOUBTFUL[word].problem if word in DOUBTFUL else f"it may be {name}"
            return Reading(name, problem=problem, meant=meant)
    return None


def _word_in(text: str, known: Mapping[str, str]) -> tuple[str, bool]:
    """Return the known word that a text is, the longest beside others in it, or that from which it differs by a slip.

    The second value says if it is a slip: a letter, or the order of two.

    >>> [_word_in(text, words.meanings()) for text in ("tip load", "gama", "laod", "head")]
    [('load', False), ('gamma', True), ('load', True), ('', False)]
    """
    letters = key(text)
    if letters in known:
        return letters, False
    tokens = re.findall(r"[a-z]+[12]?", _GAP.sub(" ", ascii_text(text).replace("'", "")).casefold())
    if words.OTHERS.isdisjoint(tokens):
        runs = ("".join(tokens[first:last]) for first, last in combinations(range(len(tokens) + 1), 2))
        if longest := max((run for run in runs if run in known), key=len, default=""):
            return longest, False
    slips = (words.slips().get(spelt, "") for spelt in words.lacking_a_letter(letters))
    slip = next(filter(None, slips), "")
    return slip, bool(slip)
