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

from ..quantities.nomenclature import NOMENCLATURE
from ..quantities.units import is_in_table
from ..text import ascii_text, composed
from . import words
from .words import MATERIALS, Meaning, key, squeezed, symbol_of, unit_for, with_unit


class Reading(NamedTuple):
    """The meaning of a header: an input with the text of its unit; or, without a name, a column that passes through."""

    name: str = ""  # where there is a problem, of the input that it may be; "" for ± alone
    unit_text: str = ""
    part: str = ""  # of the input's uncertainty: "both" sides, "minus", "plus", or the "low" or "high" end of a range
    is_symbol: bool = False  # without a unit: an input only if its cells have units
    problem: str = ""  # why the header is refused unless another column is this input
    meant: Sequence[str] = ()  # the headers that would be read, where that is certain
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


_SPELT = str.maketrans("’‘“”″∕⁄₀₁₂Ø⌀", '\'\'"""//012DD')
# Where a unit may begin: behind a mark, which is the first group, or behind a gap.
_CUT = re.compile(
    r"([\s_.-]*[,/:;|\[({<]\s*(?:in[\s_.]+)?|\s+in\s+)"
    r"|(?:[\s_.-]+|(?<=[a-z0-9])(?=[A-Z]))(?:(?:in|IN)[\s_.]+|[Ii]n(?=[A-Z]))?"
)
_PLAIN_GAP = re.compile(r"[\s_.-]?(?:(?:in|IN)[\s_.])?")
_EDGES = " _.,:;/|-"
_FACTORS = r"^[\d\s.*/^+()−-]+|\s*[*/^+(−-][\d\s.()]*$|[⁰¹²³]+$"
_LONGEST = 120  # letters of a header that can be one
# Of an uncertainty. The patterns are made when a header is first held against them: most tables need none.
_SHARE = r"(?i)[\s_.,/]*[\[(]?(?:%|percent|pct)[\])]?"  # of the value
_ERROR = "|".join([r"(?:standard|std?)[\s_.]*dev(?:iation)?\.?", *words.ERRORS])
_PART = (
    rf"(?i)^(?:u|σ|sigma)\s*\(([^()]+)\)|^(?:±|\+/?-)|^(?:σ|sigma|{_ERROR})(?:\s+of)?(?=$|[\s_(\[])"
    rf"|[\s_.]*(?:±|\+/?-)(?=$|[\s_.,/(\[])|[\s_.]+(?:{_ERROR}|{'|'.join(words.PARTS)})(?=$|[\s_.,/(\[])"
)


@lru_cache(maxsize=1000)
def reading_of(text: str, more: tuple[tuple[str, str], ...] = ()) -> Reading:
    """Return the meaning of a header; `more`: keys of further words, with the quantities that they mean.

    >>> reading_of("R2 (nm)")[:2], reading_of("E [J]")[:2], reading_of("surface_energy_mJ_m2")[:2]
    (('radius2', 'nm'), ('energy', 'J'), ('surface_energy', 'mJ/m2'))
    >>> reading_of("± [nm]")[:3], reading_of("SD")[:3], reading_of("u(E) (%)")[:3]
    (('', 'nm', 'both'), ('', '', 'both'), ('youngs_modulus', '%', 'both'))
    """
    if len(text) > _LONGEST:
        return Reading()
    known = words.meanings() | {word: Meaning([name]) for word, name in more}
    splits = [*_splits(text)]
    exact = next(filter(None, (_exact(split, known) for split in splits)), None)
    return exact or _of_part(splits[0].word, more) or _refusal(splits, known) or Reading()


def named(text: str, name: str) -> tuple[str, str]:
    """Return the key of the word of a header that means a quantity, whatever it is, and its unit.

    >>> named("Kraft [nN]", "load"), named("F_nN", "load"), named("Size", "radius")
    (('kraft', 'nN'), ('f', 'nN'), ('size', ''))
    """
    whole, *others = _splits(text)
    units = {unit_for(split.unit, name, is_explicit=split.is_explicit): split.word for split in others}
    unit_text = max(units, key=len, default="")
    return key(units[unit_text] if unit_text else whole.word), unit_text


def _splits(text: str) -> Iterator[_Split]:
    """Iterate over words and what may be their units: none, and what stands behind each place where one may begin."""
    text = " ".join(composed(text).translate(_SPELT).split()).strip("\"' ")
    yield _Split(text.strip(" _."), "")
    for cut in reversed([*_CUT.finditer(text)]):
        word, unit = text[: cut.start()].rstrip(_EDGES), text[cut.end() :].strip(" _.()[]{}<>")
        if word and (unit or cut[1]) and not re.search(r"[\[\](){}<>]", word):  # in brackets there may be none
            is_mangled = not cut[1] and (text[-1] in "_." or not _PLAIN_GAP.fullmatch(cut[0]))
            yield _Split(word, unit, bool(cut[1]), is_mangled)


def _exact(split: _Split, known: Mapping[str, Meaning]) -> Reading | None:
    """Return the meaning of a word, or of a symbol, with its unit; None if it is no input, or has another unit."""
    word, unit, is_explicit, is_mangled = split
    meaning = known.get(key(word))
    is_symbol = meaning is None
    if is_symbol and (is_explicit or (not is_mangled and len(squeezed(unit)) > 1 and word[:1].isalpha())):
        meaning = words.symbols().get(symbol_of(word))
    if meaning is None or not meaning.names or (unit in words.INDICES and not is_explicit):
        return None
    units = ((each, unit_for(unit, each, is_explicit=is_explicit) if unit else "") for each in meaning.names)
    name, unit_text = next((pair for pair in units if pair[1] or not unit), ("", ""))
    if not name or (is_mangled and is_in_table(f"u{unit_text}")):  # µm may have become m
        return None
    alike = [each for each in meaning.names if NOMENCLATURE[each].unit == NOMENCLATURE[name].unit]
    is_open = meaning.has_remedy and (meaning.problem or len(alike) > 1)
    meant = [with_unit(each, unit_text or "UNIT") for each in alike] if is_open else ()
    is_symbol = is_symbol and not unit and not meaning.problem and name not in words.RATIOS
    return Reading(name, unit_text, "", is_symbol, meaning.problem, meant)


def _of_part(text: str, more: tuple[tuple[str, str], ...]) -> Reading | None:
    """Return the meaning of a header of a part of an uncertainty, without a name if it is ± alone, if it is one."""
    plain = re.sub(_SHARE, "", text)
    share = "%" if plain != text else ""
    if (mark := re.search(_PART, plain)) is None:
        return None
    word = mark[0].strip(" _.").casefold()
    part = words.PARTS.get(word, "both")
    rest = (plain[: mark.start()] + (mark[1] or "") + plain[mark.end() :]).strip(" _.")
    if rest[:1] in ("", "[", "("):
        unit = share or rest[1:-1].strip()
        is_alone = part == "both" and word not in ("σ", "sigma", "se") and (unit or not word.startswith("err"))
        return Reading(unit_text=unit, part=part) if is_alone else None
    reading = reading_of(rest, more)
    is_value = reading.is_input and not reading.part and reading.name not in MATERIALS
    return Reading(reading.name, share or reading.unit_text, part) if is_value else None


# --- Refusals ---------------------------------------------------------------------------------------------------------


def _refusal(splits: Sequence[_Split], known: Mapping[str, Meaning]) -> Reading | None:
    """Return the refusal of a header that has the word of an input and cannot be read; None if it passes through."""
    for split in sorted(splits, key=lambda split: len(split.word), reverse=True):
        bare = split._replace(word=re.sub(_FACTORS, "", split.word))
        if bare != split and (reading := _exact(bare, known)) and not reading.is_symbol:
            return Reading(reading.name, problem="a sign or a factor stands beside the word")
        word, is_slip = _word_in(split.word, known)
        if not word:
            continue
        meaning = known[word]
        if not meaning.names:
            return None  # another quantity
        name, is_shared = meaning.names[0], word in words.SHARED
        if split.unit and word == key(split.word):
            tail = re.findall(r"[a-z]+", _CUT.sub(" ", split.unit).casefold())
            is_label = name in MATERIALS or split.unit in words.INDICES or not words.LABELS.isdisjoint(tail)
            is_other = is_shared and not unit_for(split.unit.casefold(), name)
            if meaning.problem or ((is_label or is_other) and not split.is_explicit):
                return None
            unit = [with_unit(name)] if split.unit[0].isalpha() else []
            return Reading(name, problem=f"what stands behind {name} is not its unit", meant=unit)
        unit_text = unit_for(split.unit, name, is_explicit=split.is_explicit and is_in_table(split.unit))
        is_telling = is_slip and len(word) > 4 and name not in MATERIALS and not split.unit
        if (unit_text and is_slip) or ((unit_text or is_telling) and not is_shared):
            is_last = unit_text and (is_slip or key(split.word).endswith(word))
            is_of_either = not is_slip and NOMENCLATURE[name].sphere == 1
            names = [] if meaning.problem else [name, NOMENCLATURE[name].twin] if is_of_either else [name]
            meant = [with_unit(each, unit_text if is_last else "UNIT") for each in names]
            return Reading(name, problem=meaning.problem or f"it may be {name}", meant=meant)
    return None


def _word_in(text: str, known: Mapping[str, Meaning]) -> tuple[str, bool]:
    """Return the known word that a text is, the longest beside others in it, or that from which it differs by a slip.

    The second value says if it is a slip: a letter, or the order of two.

    >>> [_word_in(text, words.meanings()) for text in ("tip load", "gama", "laod", "head")]
    [('load', False), ('gamma', True), ('load', True), ('', False)]
    """
    letters = key(text)
    if letters in known:
        return letters, False
    tokens = re.findall(r"[a-z]+[12]?", _CUT.sub(" ", ascii_text(text).replace("'", "")).casefold())
    if words.OTHERS.isdisjoint(tokens):
        runs = ("".join(tokens[first:last]) for first, last in combinations(range(len(tokens) + 1), 2))
        if longest := max((run for run in runs if run in known), key=len, default=""):
            return longest, False
    slips = (words.slips().get(spelt, "") for spelt in words.lacking_a_letter(letters))
    slip = next(filter(None, slips), "")
    return slip, bool(slip)
