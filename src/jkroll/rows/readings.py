"""The words of headers, and the grammar by which a header is read as an input, refused or passed through.

A header is a word with a unit, in any of a few notations: `radius [nm]`, `R2 (nm)`, `Load/nN`, `radius in nm`, `E_GPa`,
`gamma..mJ.m2.`. Words are compared by their letters and digits alone, so that `Young's modulus` and `youngsModulus` are
one; a symbol is compared as it is written, and its unit decides between the quantities that have it. What has the word
of an input and is no word with a unit is refused. All else passes through.
"""

import re
from collections.abc import Iterator, Mapping, Sequence
from functools import cache, lru_cache
from itertools import combinations
from typing import NamedTuple

from ..quantities.errors import QuantityError, expectation
from ..quantities.nomenclature import NOMENCLATURE, OPTION_WORDS, header
from ..quantities.units import SUPERSCRIPTS, BadUnit, dimension_of, is_in_table, kind_of, parse_unit
from ..quantities.values import unit_of
from ..text import ascii_text, composed, quoted

# --- Words ------------------------------------------------------------------------------------------------------------

MATERIALS = ("material", "material2")
INPUTS = ("radius", *(name for name, quantity in NOMENCLATURE.items() if quantity.option and quantity.unit))
SYNONYMS: Mapping[str, Sequence[str]] = {
    "youngs_modulus": ("young modulus", "youngs", "elastic modulus", "elasticity modulus", "modulus of elasticity", "E modulus"),
    "poisson_ratio": ("poissons", "poissons ratio", "poisson number"),
    "contact_modulus": ("E_star", "reduced modulus", "reduced Young's modulus", "effective Young's modulus"),
    "reduced_radius": ("effective radius",),
    "surface_energy": ("surface free energy",),
    "hamaker": ("Hamaker constant",),
    "density": ("mass density",),
    "load": ("applied load", "normal load"),
    "speed": ("velocity", "impact velocity", "impact speed", "collision velocity", "collision speed"),
    "energy": ("impact energy", "collision energy"),
    "gravity": ("gravitational acceleration",),
}  # fmt: skip
# Words that other quantities share, as in speed of sound and contact angle: they are inputs alone or with a unit.
_SHARED = ("energy", "speed", "velocity", "angle", "approach", "contacts", "monomers", "gravity", "cutoff", "xi", "z0")
_OTHERS = {"atomic", "ionic", "covalent", "metallic", "vdw", "bohr", "gyration", "current", "dislocation", "yield", "failure", "ultimate"}  # fmt: skip
# What stands behind a word where it is a label or a count: material_id, load case.
_LABELS = frozenset(
    """id ids no nr num number name names type types class classes case cases code codes key group category kind family
    label tag index step count counts cell rank source ref reference url doi note notes comment comments desc description
    quality flag status unit units method model formula cost price date color colour grade out ratio""".split()
)
_SIZES = ("r", "r1", "r2", "d", "d1", "d2", "diam", "dia", "diameter", "diameters", "durchmesser", "ø", "size")
_UNCLEAR = {
    "surfacetension": ("surface_energy", "it may be the tension of a liquid"),
    "modulus": ("youngs_modulus", "it may be another modulus"),
    "effectivemodulus": ("youngs_modulus", "it may be another modulus"),
}
_PARTS = {
    **dict.fromkeys(("±", "+/-", "err", "error", "std", "stdev", "sd", "sem", "se", "unc", "uncertainty"), "both"),
    "minus": "minus",
    "plus": "plus",
    **dict.fromkeys(("min", "low", "lower"), "low"),
    **dict.fromkeys(("max", "high", "upper"), "high"),
}
_COMMON_UNITS = """m cm mm um nm pm Pa kPa MPa GPa N mN uN nN pN J mJ aJ fJ zJ eV J/m2 mJ/m2 erg/cm2 N/m mN/m dyn/cm kg/m3
    g/cm3 g/cc m/s cm/s mm/s um/s km/s km/h m/s2 cm/s2""".split()
_UNCLEAR_IN_SMALL = ("mn", "mj")  # milli or mega?
_INDICES = ("in", "bar")  # in no brackets they may mean inside and mean
_RATIOS = ("poisson_ratio", "poisson_ratio2")  # the only ratios whose symbols have no other common meaning
_TOKENS = frozenset(token for name in INPUTS for token in name.split("_") if len(token) > 5)
_LONGEST = 120  # letters of a header that can be one
_WORD = re.compile(r"[^\W\d_][\w\s.'-]*")


def key(word: str) -> str:
    """Return the letters and digits of a word in small letters; "" for what is no word.

    >>> key("Young's modulus"), key("youngs_modulus"), key("γ"), key("2 gamma")
    ('youngsmodulus', 'youngsmodulus', 'gamma', '')
    """
    plain = word if word.isascii() else ascii_text(word)
    return re.sub(r"[\W_]+", "", plain).casefold() if _WORD.fullmatch(plain) else ""


@cache
def _words() -> dict[str, str]:
    """Return the inputs by the keys of the words that mean them, with 1 or 2 for the sphere."""
    words = {**{name: name for name in (*INPUTS, *MATERIALS)}, **OPTION_WORDS}
    words |= {word: name for name, others in SYNONYMS.items() for word in others}
    found = {key(word): name for word, name in words.items() if name in INPUTS or name in MATERIALS}
    for word, name in [*found.items()]:
        if f"{name}2" in NOMENCLATURE:
            found |= {f"{word}1": name, f"{word}2": f"{name}2"}
    return found


@cache
def _symbols() -> dict[str, list[str]]:
    """Return the inputs by their symbols, with Greek letters spelt out, and with the index of sphere 1 or without it."""
    found: dict[str, list[str]] = {}
    for name in INPUTS:
        symbol = _symbol(NOMENCLATURE[name].symbol)
        for spelt in dict.fromkeys((symbol, symbol.removesuffix("1"))):
            found.setdefault(spelt, []).append(name)
    found["E"].append("energy")
    found["Er"] = ["contact_modulus"]
    return found


def _symbol(word: str) -> str:
    """Return a symbol with Greek letters spelt out; one that is spelt with a capital, such as Rho, is the same."""
    spelt = ascii_text(word).replace(" ", "").replace("_", "")
    return spelt.lower() if spelt.rstrip("12") in ("Gamma", "Nu", "Rho", "Xi", "Tau", "Theta") else spelt


@cache
def _results() -> frozenset[str]:
    """Return the keys of quantities that are no inputs: they pass through."""
    return frozenset(key(name) for name in NOMENCLATURE) - _words().keys()


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
    squeezed, small = _squeezed(text), _squeezed(text).casefold()
    is_clear = is_explicit or squeezed in _spelt_units() or small not in (*_small_units(), *_UNCLEAR_IN_SMALL)
    is_known = is_in_table(text)
    if (is_explicit or (is_known and is_clear) or text in ("1", "-")) and fits(text, name):
        return text
    if is_explicit and is_known:
        return ""
    has_one_case = text.islower() or text.isupper()
    spelt = _spelt_units().get(squeezed) or (_small_units().get(small) if has_one_case else None)
    return spelt if spelt and fits(spelt, name) else ""


@cache
def _spelt_units() -> dict[str, str]:
    return {_squeezed(unit): unit for unit in _COMMON_UNITS} | {"Gpa": "GPa", "Mpa": "MPa", "Kpa": "kPa"}


@cache
def _small_units() -> dict[str, str]:
    """Return common units by their letters and digits in small letters, but for those that may be another then."""
    small = {squeezed.casefold(): unit for squeezed, unit in _spelt_units().items()}
    return {squeezed: unit for squeezed, unit in small.items() if squeezed not in _UNCLEAR_IN_SMALL}


def _squeezed(text: str) -> str:
    """Return the letters and digits of a unit.

    >>> _squeezed("mJ.m-2"), _squeezed("kg_per_m³")
    ('mJm2', 'kgm3')
    """
    plain = text.translate(SUPERSCRIPTS).replace("µ", "u").replace("μ", "u")
    return re.sub(r"[\W_]+|(?<![^\W_])per(?![^\W_])", "", plain)


# --- The grammar ------------------------------------------------------------------------------------------------------


class Reading(NamedTuple):
    """The meaning of a header: an input with the text of its unit; or, without a name, a column that passes through."""

    name: str = ""  # where there is a problem, of the input that it may be
    unit_text: str | None = None
    part: str = ""  # of the input's uncertainty: "both" sides, "minus", "plus", or the "low" or "high" end of a range
    is_symbol: bool = False  # without a unit: an input only if its cells have units
    is_alike: bool = False  # passes through, but looks like a quantity
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
_BRACKETS = re.compile(r"([^\[\](){}<>]*)[\[({<](.*)[\])}>][\s_.]*")
_MARK = re.compile(r"\s*[,/:;|]\s*|\s+in\s+")
_GAP = re.compile(r"[\s_.-]+|(?<=[a-z0-9])(?=[A-Z])")
_EDGES = " _.,:;/|-"
_JOINED = re.compile(r"[Ii]n(?=[A-Z])")
_IN = re.compile(rf"(?:in|IN)[\s_.]+|{_JOINED.pattern}")
_OF_PART = re.compile(
    rf"(.*?)(?:[\s_.]*(±|\+/?-)|[\s_.]+({'|'.join(filter(str.isalpha, _PARTS))}))(?=$|[\s_.,/(\[])(.*)", re.IGNORECASE
)
_ERROR = "|".join(["σ", "sigma", *(word for word, part in _PARTS.items() if part == "both" and word.isalpha())])
_PART_BEFORE = re.compile(  # as in u(R) [nm], or as in σ_E [GPa] and error of radius
    rf"(?:u|{_ERROR})\s*\(([^()]+)\)(.*)|(?:±\s*|(?:{_ERROR})(?:\s+of)?[\s_]+)([^\s_].*)", re.IGNORECASE
)
_ALONE = re.compile(r"(±|\+/?-|std|stdev|stddev|st_dev|std_dev|standard_deviation|sd|sem|unc|uncertainty|err|error)")
_OF_DIRECTIONS = re.compile(r"(G|nu|ν)_?(12|13|23|xy|xz|yz)(?![^\W_])", re.IGNORECASE)
_PER_CENT = ("%", "percent", "pct")
_SHARE = re.compile(r"[\s_.,/]*[\[(]?(?:%|percent|pct)[\])]?", re.IGNORECASE)  # of the value
_UNIT_LIKE = re.compile(r"(?:per|in|[numkcdgpafz]?(?:m|n|j|g|s|pa|ev|h|hr|sec|rad)|deg|erg|dyn|cc|angstrom|\d)+")
_FACTORS = re.compile(r"^[\d\s.*/^+()-]+|\s*[*/^+(-][\d\s.()]*$")


@lru_cache(maxsize=1000)
def reading_of(text: str) -> Reading:
    """Return the meaning of a header.

    >>> reading_of("R2 (nm)")[:2], reading_of("E [J]")[:2], reading_of("surface_energy_mJ_m2")[:2]
    (('radius2', 'nm'), ('energy', 'J'), ('surface_energy', 'mJ/m2'))
    """
    return read(text, {})


def read(text: str, more: Mapping[str, str]) -> Reading:
    """Return the meaning of a header; `more`: further quantities by the keys of their words."""
    text = " ".join(composed(text).translate(_SPELT).split()).strip("\"' ")
    if not text or len(text) > _LONGEST:
        return Reading()
    words = {**_words(), **more} if more else _words()
    splits = [*_splits(text)]
    exact = next(filter(None, (_exact(split, words) for split in splits)), None)
    if found := exact or _of_part(text, more) or _refusal(splits, words):
        return found
    is_alike = text.endswith((")", "]")) or not _TOKENS.isdisjoint(re.findall(r"[a-z]+", text.casefold()))
    return Reading(
        is_alike=is_alike or any(_symbol(each.word) in _symbols() or key(each.word) in words for each in splits)
    )


def _splits(text: str) -> Iterator[_Split]:
    """Iterate over what may be a word and its unit: the whole, a unit in brackets, and each place where a unit may begin, the last first."""
    yield _Split(text.strip(" _."), None, is_explicit=True)
    if brackets := _BRACKETS.fullmatch(text):
        yield _Split(brackets[1].rstrip(_EDGES), _IN.sub("", brackets[2].strip()) or None, is_explicit=True)
    for pattern, is_explicit in ((_MARK, True), (_GAP, False)):
        for cut in reversed([*pattern.finditer(text)]):
            word, unit = text[: cut.start()].rstrip(_EDGES), text[cut.end() :].strip(" _.()[]{}")
            is_mangled = len(cut[0]) > 1 or text[-1] in "_." or bool(_JOINED.match(unit))
            if word and unit:
                yield _Split(word, _IN.sub("", unit), is_explicit, is_mangled)


def _exact(split: _Split, words: Mapping[str, str]) -> Reading | None:
    """Return the meaning of a word, or of a symbol, with its unit; None if it is no input, or has another unit."""
    name = words.get(key(split.word), "")
    if name in MATERIALS:
        return Reading(name) if split.unit is None else None
    symbol = _symbol(split.word)
    names = [name] if name else [each for each in _symbols().get(symbol, ()) if _is_told_by_symbol(each)]
    if split.unit is None:
        return Reading(names[0], is_symbol=not name and names[0] not in _RATIOS, meant=_both(symbol)) if names else None
    if not split.is_explicit and (split.unit in _INDICES or not (name or _may_follow_symbol(split))):
        return None
    for each in names:
        unit_text = unit_for(split.unit, each, is_explicit=split.is_explicit)
        is_lost = split.is_mangled and not split.is_explicit and is_in_table(f"u{unit_text}")  # µm may have become m
        if unit_text and not is_lost:
            return Reading(each, unit_text, meant=_both(symbol, unit_text))
    return None


def _is_told_by_symbol(name: str) -> bool:
    """Return whether the symbol of an input, with its unit, means nothing else: that of a ratio has none."""
    return any(dimension_of(NOMENCLATURE[name].unit)) or name in _RATIOS


def _may_follow_symbol(split: _Split) -> bool:
    """Return whether what stands behind a symbol is no index, as in R_m, and the symbol is whole: E..GPa. may have been E*."""
    return len(_squeezed(split.unit or "")) > 1 and split.word[0].isalpha() and not split.is_mangled


def _both(symbol: str, unit_text: str = "") -> tuple[str, ...]:
    """Return both readings of R: this program's is the reduced radius, that of tables often a sphere's."""
    return tuple(header(name, unit_text) for name in ("radius", "reduced_radius")) if symbol == "R" else ()


def _of_part(text: str, more: Mapping[str, str]) -> Reading | None:
    """Return the meaning of a header that has a part of an input's uncertainty; None if it has none."""
    plain = _SHARE.sub("", text)
    if before := _PART_BEFORE.fullmatch(plain):
        word, part = before[1] + before[2] if before[1] else before[3], "both"
    elif behind := _OF_PART.fullmatch(plain):
        word, part = behind[1] + behind[4], _PARTS[(behind[2] or behind[3]).lower().replace("+-", "+/-")]
    else:
        return None
    reading = read(word, more)
    if not reading.is_input or reading.part or reading.name in MATERIALS:
        return None
    return Reading(reading.name, "%" if plain != text else reading.unit_text, part)


# --- Refusals ---------------------------------------------------------------------------------------------------------


def _refusal(splits: Sequence[_Split], words: Mapping[str, str]) -> Reading | None:
    """Return the refusal of a header that may be an input and cannot be read; None if it passes through."""
    named = [split.word for split in splits if key(split.word) in _results() or key(split.word) in words]
    if named and key(max(named, key=len)) in _results():
        return None
    for split in splits:
        name, problem = _UNCLEAR.get(key(split.word), ("", ""))
        if name and (split.unit is None or unit_for(split.unit, name, is_explicit=is_in_table(split.unit))):
            return Reading(name, problem=problem, meant=(f"{name} [{split.unit or 'UNIT'}]",))
    known = [split for split in splits if split.unit and key(split.word) in words]
    if known:
        return _of_word(max(known, key=lambda split: len(split.word)), words)
    if any(_is_size(split) for split in splits):
        return Reading("radius", problem="a radius is half of a diameter or a size, and r may be a distance")
    return next(filter(None, (_of_resemblance(split, words) for split in splits)), None)


def _is_size(split: _Split) -> bool:
    """Return whether a header is that of diameters, of sizes or of r, without a unit or with one of length."""
    last = split.word.casefold().replace("_", " ").split(" ")[-1]
    if split.unit is None:
        return split.word.casefold() in _SIZES
    return last in _SIZES and bool(unit_for(split.unit, "radius", is_explicit=is_in_table(split.unit)))


def _of_word(split: _Split, words: Mapping[str, str]) -> Reading | None:
    """Return the refusal of the word of an input and what cannot be read as its unit; None for a label or another quantity."""
    word, unit_text = key(split.word), split.unit or ""
    name = words[word]
    tail = re.findall(r"[a-z]+", _GAP.sub(" ", unit_text).casefold())
    if not split.is_explicit and (name in MATERIALS or unit_text in _INDICES or not _LABELS.isdisjoint(tail)):
        return None
    if name in MATERIALS:
        return Reading(name, problem="a material has no unit", meant=(name,))
    is_of_units = _UNIT_LIKE.fullmatch(_squeezed(unit_text).casefold())
    if word in _SHARED and not split.is_explicit and not is_of_units:
        return None
    meant = (with_unit(name),) if re.match(r"[^\W\d]", unit_text) else ()
    return Reading(name, problem=_wrong(split, name), meant=meant)


def _wrong(split: _Split, name: str) -> str:
    """Return what is wrong with the unit of a quantity."""
    unit_text = split.unit or ""
    if split.is_explicit and re.fullmatch(r"[^\W\d_][^\s()\[\]_]*", unit_text):
        try:
            kind = kind_of(unit_of(unit_text, name).dimension)
            return f"{quoted(unit_text)} is {kind}; expected {expectation(name)}"
        except QuantityError as error:
            return f"{quoted(unit_text)} {error.problem()}"
    if is_in_table(unit_text):
        return f"its unit is that of {kind_of(parse_unit(unit_text).dimension)}"
    return f"what stands behind {name} is not its unit"


def with_unit(name: str) -> str:
    """Return the header of an input, with the place of its unit if it needs one."""
    return f"{name} [UNIT]" if any(dimension_of(NOMENCLATURE[name].unit or "1")) else name


def _of_resemblance(split: _Split, words: Mapping[str, str]) -> Reading | None:
    """Return the refusal of a header that has the word of an input among others, a factor or a sign beside it, or a slip in it."""
    plain = ascii_text(split.word).strip()
    core = _FACTORS.sub("", plain)
    has_factor = core != plain
    factor = "a sign or a factor stands beside the word"
    if split.unit is None:
        name, slip = words.get(key(core), ""), _meant_by(key(split.word), words, 5)
        if has_factor and name and name not in MATERIALS:
            return Reading(name, problem=factor)
        return (
            Reading(slip, problem=f"it looks like a slip of the pen in {slip}", meant=(with_unit(slip),))
            if slip
            else None
        )
    tokens = re.findall(r"[a-z]+[12]?", _GAP.sub(" ", plain.replace("'", "")).casefold())
    if not _OTHERS.isdisjoint(tokens):
        return None
    runs = {"".join(tokens[first:last]): last - first for first, last in combinations(range(len(tokens) + 1), 2)}
    among = sorted((run for run in runs if run in words and run not in _SHARED), key=lambda run: -runs[run])
    of_symbol = _symbols().get(_symbol(core), ()) if has_factor else ()
    problems = dict.fromkeys(
        [*(words[run] for run in among), *of_symbol], factor if has_factor else "other words stand beside it"
    )
    if slip := _meant_by(key(split.word), words, 4):
        problems.setdefault(slip, f"it looks like a slip of the pen in {slip}")
    for name, problem in problems.items():
        is_explicit = split.is_explicit and is_in_table(split.unit)
        if name not in MATERIALS and (unit_text := unit_for(split.unit, name, is_explicit=is_explicit)):
            return Reading(name, problem=problem, meant=() if has_factor else (header(name, unit_text),))
    return None


def _meant_by(word: str, words: Mapping[str, str], least: int) -> str:
    """Return the input whose word of `least` letters or more differs by a slip of the pen; "" if there is none."""
    for known, name in words.items():
        is_told = known not in _SHARED or least < 5 <= len(known)
        if len(known) >= least and is_told and known != word and word and _is_slip(word, known):
            return name
    return ""


def _is_slip(word: str, known: str) -> bool:
    """Return whether two words differ by a letter, or by the order of two.

    >>> _is_slip("gama", "gamma"), _is_slip("laod", "load"), _is_slip("head", "load")
    (True, True, False)
    """
    if abs(len(word) - len(known)) > 1 or word.rstrip("12") == known.rstrip("12"):  # of another sphere
        return False
    same = next((place for place, pair in enumerate(zip(word, known, strict=False)) if pair[0] != pair[1]), len(word))
    first, second = word[same:], known[same:]
    is_swapped = first[:2] == second[1::-1] and first[2:] == second[2:]
    return first[1:] in (second[1:], second) or first == second[1:] or is_swapped


# --- Headers beside others --------------------------------------------------------------------------------------------


def unit_alone(text: str) -> str | None:
    """Return the unit, or "", of a header that is ± or SD alone: the uncertainty of the column at its left; None for others.

    >>> unit_alone("± [nm]"), unit_alone("+/-"), unit_alone("radius ±"), unit_alone("SD (nm)"), unit_alone("error")
    ('nm', '', None, 'nm', None)
    """
    text = text.strip()
    brackets = _BRACKETS.fullmatch(text)
    word, unit_text = (brackets[1], brackets[2].strip()) if brackets else (text, "")
    if not brackets and (mark := re.match(r"±|\+/?-", text)):
        word, unit_text = mark[0], text[mark.end() :].strip()
    word = re.sub(r"[\s_]+", "_", word.strip().replace(".", "")).casefold()
    if not _ALONE.fullmatch(word) or (word in ("err", "error") and not unit_text):  # which may be of anything
        return None
    return unit_text if not unit_text or unit_text in _PER_CENT or is_in_table(unit_text) or brackets else None


def is_of_directions(text: str) -> bool:
    """Return whether a header is that of an elastic constant which only a body with directions has: ν12, G_xy.

    >>> is_of_directions("nu12"), is_of_directions("G12_Pa"), is_of_directions("G1")
    (True, True, False)
    """
    return bool(_OF_DIRECTIONS.match(text.strip()))


def unit_in_header(text: str, name: str) -> str | None:
    """Return the unit of a quantity that stands in a header, whatever word does; None if there is none.

    >>> unit_in_header("Kraft [nN]", "load"), unit_in_header("F_nN", "load"), unit_in_header("Kraft [nm]", "load")
    ('nN', 'nN', None)
    """
    splits = sorted(_splits(composed(text).strip()), key=lambda split: -len(split.unit or ""))
    units = (unit_for(split.unit, name, is_explicit=split.is_explicit) for split in splits if split.unit)
    return next(filter(None, units), None)


def words_of(text: str) -> frozenset[str]:
    """Return the keys of what may be the word of a header."""
    return frozenset(filter(None, (key(split.word) for split in _splits(composed(text).strip()))))
